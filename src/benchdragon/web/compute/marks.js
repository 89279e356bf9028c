// Marks on the ground along a route, and between which of them a front handle starts. Twin of
// analysis/marks.py, as far as sheets of benches need it.

import { _ } from "../words.js";
import { ANALYSIS_MARKS, CURVE, ROUTE_PARTS } from "./constants.js";
import { InputError } from "./errors.js";
import { decimals, general } from "./number_format.js";
import { rint, rounded } from "./numbers.js";
import { countUpTo } from "./profile.js";

/** @typedef {import("./curves.js").Route} Route */

/** Where a front handle starts: so far, m, past mark number `n`, from 1, and before the next. @typedef {{ n: number, past: number }} MarkPlace */

const { ALWAYS, AT_MARK, CLOSE, CLOSE_SHARE, FARTHEST, MOST_MARKS, SAME_MARK } = ANALYSIS_MARKS;
/** A mark's first reason: which of two in one place is kept. */
const RANK = { step: 0, joint: 1, end: 2, start: 3 };
// So finely, m, it is told how far a handle is past a mark.
const FINE = 0.01;

/** Marks so far apart, or as usual: 1 m, or as many decimetres more as MOST_MARKS want. */
export class Marks {
  /** @param {Route} route @param {number} low where the tail's last handle stands at first, m @param {number} start where the head's first stands then, m @param {number} high where that comes to, m @param {number | null} said how far apart they are to be, m */
  constructor(route, low, start, high, said) {
    this.route = route;
    this.low = low;
    const least = Math.ceil((10 * (high - low)) / MOST_MARKS) / 10;
    const every = said ?? Math.max(1, least);
    refuseMany(every, high - low, least);
    /** Along the route, m. */
    this.s = this.#marked(every, start, high);
    /** What most marks are apart, m. */
    this.usual = median(this.s.slice(1).map((s, n) => s - this.s[n]));
  }

  /** From the start of the head each way, joints and ends besides; of two close together one. @param {number} every @param {number} start @param {number} high */
  #marked(every, start, high) {
    const { low, route } = this;
    /** @type {Map<number, keyof RANK>} */
    const found = new Map();
    const last = Math.floor((high - start) / every);
    for (let n = Math.ceil((low - start) / every); n <= last; n++) found.set(start + every * n, "step");
    for (const s of route.joints) if (low < s && s < high) found.set(s, "joint");
    found.set(low, "end").set(high, "end").set(start, "start");
    const places = [...found.keys()].sort((a, b) => a - b);
    const again = this.#again(places);
    /** @type {number[]} */
    const kept = [];
    const rank = (/** @type {number} */ s) => RANK[/** @type {keyof RANK} */ (found.get(s))];
    const close = Math.min(CLOSE, CLOSE_SHARE * every);
    for (const [n, s] of places.entries()) {
      if (again[n] && rank(s) < ALWAYS) continue;
      const before = kept[kept.length - 1];
      const least = kept.length ? Math.min(rank(s), rank(before)) : 0;
      if (kept.length && s - before <= SAME_MARK + (least >= ALWAYS ? 0 : close)) {
        if (rank(s) <= rank(before)) continue;
        kept.pop();
      }
      kept.push(s);
    }
    return kept;
  }

  /** Whether the ground at positions, m, was walked the same way before. @param {number[]} places */
  #again(places) {
    const again = places.map(() => false);
    for (const lag of lagsOf(this.route)) {
      const before = places.map((s) => Math.max(s - lag, this.low));
      const [here, there] = [this.route.evaluate(places), this.route.evaluate(before)];
      places.forEach((s, n) => {
        if (s - lag >= this.low && apartAt(here, there, n) <= SAME_MARK) again[n] = true;
      });
    }
    return again;
  }

  /**
   * Between which marks a front handle starts, m along the route. Null where the marks about it are not its
   * neighbours on the ground: where a closed line is walked again, it has those of the first round.
   * @param {number} s
   * @returns {MarkPlace | null}
   */
  place(s) {
    const last = this.s.length - 1;
    const n = Math.min(Math.max(countUpTo(this.s, s + SAME_MARK) - 1, 0), last);
    const past = rint((s - this.s[n]) / FINE) * FINE;
    if (Math.abs(past) < AT_MARK) return { n: n + 1, past: 0 };
    const gap = n < last ? this.s[n + 1] - this.s[n] : 0;
    if (n < last && this.s[n + 1] - s < AT_MARK) return { n: n + 2, past: 0 };
    return past < 0 || gap > FARTHEST * this.usual ? null : { n: n + 1, past };
  }
}

/** Refuse marks that are too many: as many m apart, on so much of the route, m; and what they want at least. @param {number} every @param {number} length @param {number} needed */
function refuseMany(every, length, needed) {
  if (length / every <= MOST_MARKS) return;
  throw new InputError(
    _(
      "marks each {every} m on {length} m of route are more than {most}: ask for at least {needed} m between them",
      { every: general(every), length: decimals(length, 1), most: MOST_MARKS, needed: general(needed) },
    ),
  );
}

/** After how many m a place may come again: whole circles, or between joints in one place. @param {Route} route */
function lagsOf(route) {
  const lags = route.parts.flatMap((part) => {
    const [radius, sweep] = part.slice(ROUTE_PARTS.PART_ANGLE + 1);
    const closed = part[0] === CURVE.ARC && Math.abs(sweep) > 2 * Math.PI;
    return closed ? [2 * Math.PI * radius] : [];
  });
  lags.push(...roundsOf(route));
  return [...new Set(lags.map((lag) => rounded(lag, 9)))];
}

/** How far it is from each joint to the next in the same place, if there is one, m. @param {Route} route */
function roundsOf(route) {
  const { joints } = route;
  const found = route.evaluate(joints);
  const [x, y] = [0, 1].map((column) => Array.from(joints, (_s, n) => found[4 * n + column]));
  const order = x.map((_place, n) => n).sort((a, b) => x[a] - x[b]);
  const next = new Map();
  order.forEach((a, i) => {
    for (let j = i + 1; j < order.length && x[order[j]] - x[a] <= SAME_MARK; j++) {
      const [one, other] = [Math.min(a, order[j]), Math.max(a, order[j])];
      const gap = joints[other] - joints[one];
      const near = Math.hypot(x[one] - x[other], y[one] - y[other]) <= SAME_MARK;
      if (near && gap > SAME_MARK) next.set(one, Math.min(gap, next.get(one) ?? Infinity));
    }
  });
  return [...next.values()];
}

/** How far apart two positions are on the ground, m, and in heading, rad: the greater. @param {Float64Array} here @param {Float64Array} there @param {number} n */
function apartAt(here, there, n) {
  const [x, y, heading] = [0, 1, 2].map((column) => here[4 * n + column] - there[4 * n + column]);
  const within = ((heading + Math.PI) % (2 * Math.PI)) - Math.PI;
  const turned = Math.abs(within < -Math.PI ? within + 2 * Math.PI : within);
  return Math.max(Math.hypot(x, y), turned);
}

/** @param {number[]} values */
function median(values) {
  const sorted = Float64Array.from(values).sort();
  const half = sorted.length >> 1;
  return sorted.length % 2 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}
