// Where a walk only repeats itself, so that no search need look there again. Twin of analysis/rounds.py.

import { doubles, withArena } from "./arena.js";
import { ANALYSIS_ROUNDS, CURVE, ROUNDING } from "./constants.js";
import { seamsOf } from "./nearby.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {[number, number]} Span of route positions, m */

/**
 * Part of a route, from position low to high, m, that is the same `period` metres farther on, or everywhere
 * where that is 0; `missed` is how far places some rounds apart may be from one another, m.
 * @typedef {{ low: number, high: number, period: number, missed: number }} Repeat
 */

/** A row of a route by the columns that matter. @typedef {{ kind: number, start: number, length: number, back: number, x: number, y: number, angle: number, p: number, q: number }} Row */

const { SPARE, WORTH, MOST_MISSED, MOST_GAPS, MOST_FOLD, TURN } = ANALYSIS_ROUNDS;
const BENDS = [CURVE.LINE, CURVE.ARC, CURVE.CLOTHOID];

/** @param {Numbers} rows @returns {Row[]} */
function rowsOf(rows) {
  const view = doubles(rows);
  return Array.from({ length: rows.shape[0] }, (_row, j) => {
    const at = (/** @type {number} */ column) => view[j * CURVE.COLUMNS + column];
    return {
      kind: at(CURVE.KIND), start: at(CURVE.S_START), length: at(CURVE.LENGTH), back: at(CURVE.U_BACK),
      x: at(CURVE.X), y: at(CURVE.Y), angle: at(CURVE.ANGLE), p: at(CURVE.P), q: at(CURVE.Q),
    }; // prettier-ignore
  });
}

/** A number for the shape of each row, the same for the same; -1 for what is not looked at. @param {Row[]} rows */
function shapesOf(rows) {
  /** @type {Map<string, number>} */
  const known = new Map();
  return rows.map(({ kind, length, p, q }) => {
    if (!BENDS.includes(kind)) return -1;
    const key = [kind, length, p, q].join();
    const number = known.get(key) ?? known.size;
    known.set(key, number);
    return number;
  });
}

/** An angle, rad, within half a turn. @param {number} angle */
function wrapped(angle) {
  const from = angle + Math.PI;
  return from - TURN * Math.floor(from / TURN) - Math.PI;
}

/** Whether a route goes on smoothly where each row starts. @param {Row[]} rows */
function smoothOf(rows) {
  return rows.map(({ kind, angle }, j) => {
    if (!j) return true;
    const { kind: before, angle: from, length, p, q } = rows[j - 1];
    if (!BENDS.includes(kind) || !BENDS.includes(before)) return false;
    return Math.abs(wrapped(angle - (from + length * (p + 0.5 * q * length)))) <= ROUNDING.KINK;
  });
}

/** After how many rows a route of these shapes may come again, the fewest first. @param {number[]} shapes */
function periodsOf(shapes) {
  /** @type {Map<number, number>} */
  const last = new Map();
  /** @type {Set<number>} */
  const gaps = new Set();
  for (const [j, shape] of shapes.entries()) {
    const before = last.get(shape);
    if (shape >= 0 && before !== undefined) gaps.add(j - before);
    last.set(shape, j);
  }
  /** @type {Set<number>} */
  const periods = new Set();
  for (const gap of [...gaps].sort((a, b) => a - b).slice(0, MOST_GAPS))
    for (let fold = 1; fold <= MOST_FOLD && 2 * fold * gap <= shapes.length; fold++)
      periods.add(fold * gap);
  return [...periods].sort((a, b) => a - b);
}

/**
 * Rows from which to which a number of them, the third, comes again and again, the fewest first.
 *
 * Rows that are `used` alone are not told again. A kink is not the same as any other.
 * @param {Row[]} rows
 * @param {boolean[]} used
 * @returns {Generator<[number, number, number]>}
 */
function* runs(rows, used) {
  const [shapes, smooth] = [shapesOf(rows), smoothOf(rows)];
  for (const period of periodsOf(shapes)) {
    const same = (/** @type {number} */ j) =>
      j >= period && shapes[j] >= 0 && shapes[j] === shapes[j - period];
    if (!rows.some((_row, j) => same(j) && !used[j])) continue;
    let first = -1;
    for (let j = period; j <= rows.length; j++) {
      const goes = j < rows.length && same(j);
      const joined = goes && first >= 0 && smooth[j] && smooth[j - period];
      if (first >= 0 && !joined) yield [first - period, j - 1, period];
      if (!joined) first = goes ? j : -1;
    }
  }
}

/** Where a route of these rows has one shape again and again, wherever that leads. @param {Numbers} table @returns {Repeat[]} */
export function repeats(table) {
  const rows = rowsOf(table);
  const ends = rows.map(({ start, length }) => start + length);
  /** @type {Repeat[]} */
  const found = [];
  for (const [j, { kind, start, back }] of rows.entries()) {
    if (kind !== CURVE.LINE && kind !== CURVE.ARC) continue;
    const low = j === 0 && !Number.isFinite(back) ? -Infinity : start;
    found.push({ low, high: ends[j], period: 0, missed: 0 });
  }
  const used = rows.map(() => false);
  for (const [first, last, period] of runs(rows, used)) {
    used.fill(true, first + period, last + 1);
    const way = rows[first + period].start - rows[first].start;
    found.push({ low: rows[first].start, high: ends[last], period: way, missed: 0 });
  }
  return found;
}

/** Where a route of these rows leads back to where it was, for what reaches so far from it, m. @param {Engine} engine @param {Numbers} table @param {number} reach @returns {Repeat[]} */
export function returns(engine, table, reach) {
  const rows = rowsOf(table);
  const ends = rows.map(({ start, length }) => start + length);
  const seams = withArena(engine, (arena) => doubles(seamsOf(arena, table)).slice());
  const { GAP, TILT, SEAM_COLUMNS } = ROUNDING;
  const joints = ends.map((end, j) => {
    const at = j * SEAM_COLUMNS;
    return seams[at + GAP] + seams[at + TILT] * (end + reach);
  });
  /** @type {Repeat[]} */
  const found = [];
  for (const [j, { kind, start, p }] of rows.entries())
    if (kind === CURVE.ARC && p !== 0)
      found.push({ low: start, high: ends[j], period: TURN / Math.abs(p), missed: 0 });
  const used = rows.map(() => false);
  for (const [first, last, period] of runs(rows, used)) {
    let [missed, copy] = [0, first + period];
    for (; copy <= last; copy++) {
      const from = first + ((copy - first) % period);
      const [a, b] = [rows[copy], rows[from]];
      const turned = Math.abs(wrapped(a.angle - b.angle));
      const apart = Math.abs(a.x - b.x) + Math.abs(a.y - b.y);
      const off = apart + turned * (a.length + reach) + joints[copy] + joints[from];
      if (off > MOST_MISSED) break;
      missed = Math.max(missed, off);
    }
    if (copy === first + period) continue;
    used.fill(true, first + period, copy);
    const way = rows[first + period].start - rows[first].start;
    found.push({ low: rows[first].start, high: ends[copy - 1], period: way, missed });
  }
  return found;
}

/** What of the ways of a dragon is new, on a route of which parts repeat. */
export class Rounds {
  /** @param {Walk} walk @param {Repeat[]} known */
  constructor(walk, known) {
    this.length = walk.dragon.extent;
    this.worth = WORTH * this.length;
    const saved = (/** @type {Repeat} */ { low, high, period }) => high - low - period;
    const long = known.filter((one) => saved(one) > this.worth);
    /** Where the head stands from which on all benches do where it repeats. @type {Array<{ head: number, one: Repeat }>} */
    this.begun = [];
    for (const one of long.sort((a, b) => (saved(a) === saved(b) ? 0 : saved(b) - saved(a)))) {
      if (this.begun.some((whole) => this.#covers(whole, one))) continue;
      const { low } = one;
      const head = Number.isFinite(low) ? walk.headWhereTail(low + SPARE) : low;
      this.begun.push({ head, one });
    }
  }

  /** Whether what is left out for a repeat surely holds what would be for another. @param {{ head: number, one: Repeat }} longer @param {Repeat} one */
  #covers({ head, one: longer }, one) {
    const soonest = one.low + this.length + one.period;
    return head + longer.period <= soonest && one.high <= longer.high;
  }

  /**
   * The spans of the head's way from first to last, m, that repeat nothing before them there; and what
   * places may be off by from those some rounds before, m.
   * @param {number} first @param {number} last
   */
  new(first, last) {
    let missed = 0;
    /** @type {Span[]} */
    const skips = [];
    for (const { head, one } of this.begun) {
      const start = Math.max(head, first) + one.period + SPARE;
      const end = Math.min(one.high, last);
      if (!(end - start > this.worth)) continue;
      skips.push([start, end]);
      missed += one.missed;
    }
    /** @type {Span[]} */
    const spans = [];
    let at = first;
    for (const [start, end] of skips.sort(([a, b], [c, d]) => a - c || b - d)) {
      if (start > at) spans.push([at, start]);
      at = Math.max(at, end >= last ? end : end - SPARE);
    }
    if (at < last || !spans.length) spans.push([at, last]);
    return { spans, missed };
  }
}
