// The greatest speed, acceleration or turning rate over a whole walk. Twin of analysis/speed.py.
//
// All of them are bracketed by bounds that hold between evaluations, at whatever speed the head walks:
// cut where its acceleration jumps, a walk is searched over the head's place (see kernels/peak.py).

import { _ } from "../words.js";
import { answered, now } from "./answer.js";
import { Arena, doubles, withArena, withArenaAsync } from "./arena.js";
import { OverBudgetError, allow, spend } from "./budget.js";
import {
  ANALYSIS_SPEED,
  ANALYSIS_TABLES,
  BENCH_CELLS,
  DRIVE,
  Ended,
  MODEL_ANSWER,
  PEAK,
  REGIONS,
  STEP_BOUNDS,
} from "./constants.js";
import { inOrder } from "./contact_search.js";
import { InputError, UnsureError } from "./errors.js";
import { evenly, firstRows, grown, least } from "./lists.js";
import { general, pythonFloat } from "./number_format.js";
import { countBelow, timeOnStretch } from "./profile.js";
import { seamsOf } from "./nearby.js";
import { Rounds, repeats } from "./rounds.js";
import { fillWhole, setWhole, wholeAt } from "./tables.js";
import { silent, tick } from "./tick.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./answer.js").Witness} Witness */
/** @typedef {import("./profile.js").PaceStretch} PaceStretch */
/** @typedef {import("./quantities.js").Quantity} Quantity */
/** @typedef {import("./rounds.js").Span} Span */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {{ tolerance?: number, limit?: number, progress?: Progress }} PeakOptions */

/**
 * The greatest of a quantity: never more than `upper`, surely `least`; seen at `time`, s, with the head at s, m, on handle
 * or bench `row` (from 0).
 * @typedef {{ value: number, upper: number, time: number, s: number, row: number, evaluations: number,
 *   least: number }} Peak
 */

/** Cells of a route, and the kind of each bench there. @typedef {{ group: Numbers, cells: Cells }} MadeCells */
/** @typedef {Record<"borders" | "bends" | "fastest" | "off" | "benches", Numbers>} Cells */
/** @typedef {{ parts: Numbers, marks: Numbers }} Heap */

const { TOLERANCE, LEAST_TOLERANCE, STEP, MOST_OPEN, OPEN, COARSE_STEP, COARSE_CELL } = ANALYSIS_SPEED;
const { BOUNDED } = ANALYSIS_SPEED;
const { FINEST_CELL, CELL_COST, LEAST_LOSS, MOST_LOSS, SAMPLES, MOST_CELLS, BUDGET } = ANALYSIS_SPEED;

/**
 * The greatest of a quantity from start to end, s, in its unit, over continuous time.
 *
 * The bracket is `tolerance` times the answer wide (wider where the greatest value lasts, infinite across
 * a kink of the route). Given a `limit`, a value that surely keeps to it has a bracket of 1 % of the value
 * or of the limit.
 * @param {Walk} walk
 * @param {Quantity} quantity
 * @param {number} start @param {number} end
 * @param {PeakOptions} [options]
 * @returns {Promise<Answer>}
 */
export async function greatest(walk, quantity, start, end, options = {}) {
  const began = now();
  inOrder(start, end);
  const stretches = walk.profile.stretches(start, end).map((one) => moved(one, walk.start));
  const found = await peakOver(walk, quantity, stretches, options);
  const witness = { ...witnessOf(walk, quantity, found), time: found.time };
  const { value, least: sure, upper, evaluations } = found;
  return answered(value, sure, upper, quantity.unit, {
    witness,
    evaluations,
    seconds: now() - began,
  });
}

/**
 * The greatest of a quantity while a head at 1 m/s walks from position first to last, m.
 * @param {Walk} walk
 * @param {Quantity} quantity
 * @param {number} first @param {number} last
 * @param {PeakOptions} [options]
 */
export function greatestOf(walk, quantity, first, last, options = {}) {
  /** @type {PaceStretch} */
  const whole = { times: [first, last], ways: [first, last], speeds: [1, 1], rate: 0 };
  return peakOver(walk, quantity, [whole], options);
}

/** @param {PaceStretch} stretch @param {number} way m @returns {PaceStretch} */
function moved({ ways: [a, b], ...rest }, way) {
  return { ...rest, ways: [a + way, b + way] };
}

/**
 * @param {Walk} walk
 * @param {Quantity} quantity
 * @param {PaceStretch[]} stretches
 * @param {PeakOptions} options
 */
async function peakOver(
  walk,
  quantity,
  stretches,
  { tolerance = TOLERANCE, limit = Infinity, progress = silent },
) {
  if (!(tolerance >= LEAST_TOLERANCE && tolerance <= 1)) {
    const values = { least: general(LEAST_TOLERANCE), value: pythonFloat(tolerance) };
    throw new InputError(_("tolerance must lie between {least} and 1, not at {value}", values));
  }
  const arena = new Arena(walk.engine);
  try {
    const search = new PeakSearch(arena, walk, quantity, tolerance, limit, stretches);
    return await search.over(progress);
  } finally {
    arena.free();
  }
}

/**
 * Where a peak comes about: handle or bench, and when a head at the walk's own speed is there.
 * @param {Walk} walk
 * @param {Quantity} quantity
 * @param {Peak} found
 * @returns {Witness}
 */
export function witnessOf(walk, quantity, found) {
  return withArena(walk.engine, (arena) => {
    const placed = walk.placement(arena, [found.s]);
    const speeds = quantity.kind === DRIVE.SPEEDS;
    const row = speeds ? fastestHandle(doubles(placed.ratio)) : found.row;
    const time = walk.timeAt(found.s);
    return {
      time: Number.isFinite(time) ? time : null,
      s: found.s,
      benches: [Math.min(row + 1, walk.dragon.benches)],
      point: [doubles(placed.x)[row], doubles(placed.y)[row]],
      gap: NaN,
      features: [],
      handle: quantity.kind === DRIVE.TURNING ? null : row,
      obstacle: null,
    };
  });
}

/** The first handle that comes to the greatest of these speeds but for rounding. @param {Float64Array} speeds */
export function fastestHandle(speeds) {
  const most = speeds.reduce((a, b) => Math.max(a, b)) * (1 - MODEL_ANSWER.ROUNDING);
  return speeds.findIndex((speed) => speed >= most);
}

/**
 * Where on stretches something new may be seen: who keeps one speed does what was done one round before.
 * @param {Walk} walk
 * @param {PaceStretch[]} stretches
 * @returns {Array<{ ways: Span, of: PaceStretch }>}
 */
function newStretches(walk, stretches) {
  const rounds = new Rounds(walk, repeats(walk.route.rows));
  return stretches.flatMap((of) => {
    const spans = of.rate === 0 ? rounds.new(of.ways[0], of.ways[1]).spans : [of.ways];
    return spans.map(([first, last]) => ({ ways: /** @type {Span} */ ([first, last]), of }));
  });
}

/** Asks the kernels for the greatest of a quantity, window by window of the head's way. */
class PeakSearch {
  /**
   * @param {Arena} arena which holds what lasts as long as the search
   * @param {Walk} walk
   * @param {Quantity} quantity
   * @param {number} tolerance @param {number} limit
   * @param {PaceStretch[]} stretches their ways being route positions
   */
  constructor(arena, walk, quantity, tolerance, limit, stretches) {
    this.arena = arena;
    this.engine = walk.engine;
    this.walk = walk;
    this.stretches = newStretches(walk, stretches);
    const shortest = least(walk.dragon.link);
    this.step = STEP * shortest;
    const cell_step = COARSE_STEP * shortest;
    this.aim = { quantity: quantity.kind, tolerance, limit, cell_step, step: this.step };
    this.drives = {
      ways: arena.table(this.stretches.map(({ ways }) => ways), 2),
      squares: arena.table(this.stretches.map(({ of: { speeds: [a, b] } }) => [a * a, b * b]), 2),
      rates: arena.vector(this.stretches.map(({ of: { rate } }) => rate)),
    }; // prettier-ignore
    this.batch = {
      parts: arena.array("d", PEAK.SLOTS, PEAK.PART_COLUMNS),
      marks: arena.array("q", PEAK.SLOTS, PEAK.PART_COLUMNS),
      slots: arena.array("q", PEAK.SLOTS, 2),
      at: arena.array("d", PEAK.SLOTS),
      drive: arena.array("d", DRIVE.DRIVE_COLUMNS),
    };
    this.chains = chainsFor(arena, walk.dragon.benches + 1, walk.route.rows);
    this.notes = arena.full([PEAK.NOTES], 0);
    doubles(this.notes)[PEAK.SEEN] = -1;
    this.counts = fillWhole(arena.array("q", PEAK.COUNTS), 0n);
  }

  /** The greatest value. @param {Progress} progress @returns {Promise<Peak>} */
  async over(progress) {
    const windows = this.#parts().flatMap(([first, last]) => {
      const borders = this.#windows(first, last);
      return borders.slice(1).map((high, n) => /** @type {Span} */ ([borders[n], high]));
    });
    try {
      for (const [n, window] of windows.entries())
        await this.#through(...window, (share) => progress((n + share) / windows.length, ""));
    } catch (error) {
      if (!(error instanceof OverBudgetError && doubles(this.notes)[PEAK.SEEN] >= 0)) throw error;
      doubles(this.notes)[PEAK.UPPER] = Infinity;
      allow(ANALYSIS_SPEED.TOLD);
    }
    const [seen, where, upper, sure] = doubles(this.notes);
    const [row, when, evaluations] = [PEAK.ROW, PEAK.WHEN, PEAK.EVALUATIONS].map((column) =>
      wholeAt(this.counts, column),
    );
    const time = timeOnStretch(this.stretches[when].of, where);
    const most = Math.max(upper, seen);
    return { value: seen, upper: most, time, s: where, row, evaluations, least: sure };
  }

  /** Spans of the way, m, without a gap in them. */
  #parts() {
    /** @type {Span[]} */
    const parts = [];
    for (const { ways: [low, high] } of this.stretches) {
      const last = parts[parts.length - 1];
      if (last && low <= last[1]) last[1] = high;
      else parts.push([low, high]);
    } // prettier-ignore
    return parts;
  }

  /** Borders of parts of the way, m, whose cells fit the memory; one part if cells do not pay. @param {number} first @param {number} last */
  #windows(first, last) {
    const { dragon } = this.walk;
    if (!coarseBoundPays(this.walk, last - first)) return [first, last];
    const finest = FINEST_CELL * least(dragon.link);
    const kinds = new Set(dragon.link).size;
    const fits = Math.max((MOST_CELLS / kinds) * finest - dragon.extent, dragon.extent);
    const count = Math.ceil((last - first) / fits);
    const borders = Array.from({ length: count }, (_border, n) => first + (last - first) * (n / count));
    return [...borders, last];
  }

  /** Search the head's way from low to high, m. @param {number} low @param {number} high @param {(share: number) => void} progress */
  async #through(low, high, progress) {
    const closing = new Closing(this.aim.tolerance, progress);
    const coarse = coarseBoundPays(this.walk, high - low);
    await withArenaAsync(this.engine, async (arena) => {
      const made = coarse
        ? await this.#cells(arena, low, high)
        : noCells(arena, this.walk.dragon.benches);
      const ends = this.stretches.map(({ ways }) => ways[1]);
      if (coarse) {
        // What is seen at some places spares bounds at most others.
        const parts = evenly(low, high, SAMPLES).map((at) => ({
          stretch: Math.min(countBelow(ends, at), ends.length - 1),
          start: at,
          end: at,
        }));
        await this.#seek(parts, false, made, closing);
      }
      const within = (/** @type {number} */ at) => Math.min(Math.max(at, low), high);
      const parts = this.stretches
        .map(({ ways: [a, b] }, stretch) => ({ a, b, stretch }))
        .filter(({ a, b }) => a <= high && b >= low)
        .map(({ a, b, stretch }) => ({ stretch, start: within(a), end: within(b) }));
      await this.#seek(parts, coarse, made, closing);
    });
    progress(1);
  }

  /**
   * A heap in which parts of stretches, m, wait, all of them ascending.
   * @param {Arena} arena
   * @param {Array<{ stretch: number, start: number, end: number }>} parts
   * @param {boolean} byCells
   * @returns {Heap}
   */
  #waiting(arena, parts, byCells) {
    const room = parts.length + OPEN;
    const heap = {
      parts: arena.array("d", room, PEAK.PART_COLUMNS),
      marks: arena.array("q", room, PEAK.PART_COLUMNS),
    };
    setWhole(this.counts, PEAK.OPEN, parts.length);
    const view = doubles(heap.parts);
    parts.forEach(({ stretch, start, end }, n) => {
      const at = n * PEAK.PART_COLUMNS;
      view[at + PEAK.BOUND] = Infinity;
      view[at + PEAK.START] = start;
      view[at + PEAK.END] = end;
      setWhole(heap.marks, at + PEAK.STRETCH, stretch);
      setWhole(heap.marks, at + PEAK.LINKS, this.walk.dragon.benches);
      setWhole(heap.marks, at + PEAK.BY_CELLS, Number(byCells));
    });
    return heap;
  }

  /**
   * Look through what waits until the bracket is closed, or too much waits.
   * @param {Array<{ stretch: number, start: number, end: number }>} parts
   * @param {boolean} byCells
   * @param {MadeCells} made
   * @param {Closing} closing
   */
  async #seek(parts, byCells, { group, cells }, closing) {
    const { dragon, route } = this.walk;
    const [low, high] = [parts[0].start, parts[parts.length - 1].end];
    await withArenaAsync(this.engine, async (arena) => {
      let heap = this.#waiting(arena, parts, byCells);
      const most = heap.parts.shape[0] + (high - low) / this.step + MOST_OPEN / dragon.benches;
      for (;;) {
        const [ended] = this.engine.call(
          "bd_peak_seek_peak", route.rows, dragon.links, group, cells, this.aim, this.drives, heap,
          this.batch, this.chains, this.notes, this.counts, BUDGET,
        ); // prettier-ignore
        spend(BOUNDED * BUDGET);
        if (ended === Ended.FALLEN) throw failureWithin(this.walk, low, high);
        if (ended === Ended.DONE || (ended === Ended.ROOM && heap.parts.shape[0] > most)) break;
        if (ended === Ended.ROOM)
          heap = { parts: grown(arena, heap.parts), marks: grown(arena, heap.marks) };
        closing.tell(doubles(this.notes)[PEAK.SEEN], doubles(heap.parts)[PEAK.BOUND]);
        await tick();
      }
      const bounds = doubles(heap.parts);
      const notes = doubles(this.notes);
      for (let n = 0; n < wholeAt(this.counts, PEAK.OPEN); n++) {
        const bound = bounds[n * PEAK.PART_COLUMNS + PEAK.BOUND];
        notes[PEAK.UPPER] = Math.max(notes[PEAK.UPPER], bound);
      }
    });
  }

  /**
   * The cells that the dragon walks through while its head walks from low to high, m.
   * @param {Arena} arena which holds them
   * @param {number} low @param {number} high
   * @returns {Promise<MadeCells>}
   */
  async #cells(arena, low, high) {
    const { link } = this.walk.dragon;
    const placed = this.walk.placement(arena, evenly(low, high, SAMPLES), { throws: false });
    if (placed.firstFailed >= 0) throw failureWithin(this.walk, low, high);
    const links = [...new Set(link)].sort((a, b) => a - b);
    const group = Array.from(link, (one) => links.indexOf(one));
    const s = doubles(placed.s);
    const spans = links.map((_link, g) => [
      s[group.lastIndexOf(g) * SAMPLES] - REGIONS.EDGE,
      s[group.indexOf(g) * SAMPLES + SAMPLES - 1] + REGIONS.EDGE,
    ]);
    const start = s[link.length * SAMPLES];
    // Where nobody is faster than the head nothing may be lost on the way to the tail.
    const fastest = doubles(placed.ratio).reduce((a, b) => Math.max(a, b));
    const loss = fastest <= 1 + MODEL_ANSWER.ROUNDING ? LEAST_LOSS : MOST_LOSS / link.length;
    const kinds = { links: arena.table(links.map((one) => [one]), 1), spans: arena.table(spans, 2) }; // prettier-ignore
    return {
      group: arena.whole(group),
      cells: await this.#cut(arena, kinds, links[0], start, high, loss),
    };
  }

  /**
   * Cells from start to end, m.
   * @param {Arena} arena
   * @param {{ links: Numbers, spans: Numbers }} kinds
   * @param {number} shortest m
   * @param {number} start @param {number} end
   * @param {number} loss
   * @returns {Promise<Cells>}
   */
  async #cut(arena, kinds, shortest, start, end, loss) {
    const count = kinds.links.shape[0];
    const longest = COARSE_CELL * shortest;
    const cuts = { end, longest, shortest: FINEST_CELL * shortest, loss };
    const reached = arena.vector([start, longest]);
    const done = fillWhole(arena.array("q", 2), 0n);
    let made = emptyCells(arena, 2 * Math.ceil((end - start) / longest), count);
    const shop = workshopFor(arena, count, this.chains.errors.seams);
    for (;;) {
      const [ended] = this.engine.call(
        "bd_bench_cells_cut_cells", this.walk.route.rows, kinds, shop, cuts, made, reached, done, BUDGET,
      ); // prettier-ignore
      spend(BOUNDED * BUDGET);
      if (ended === Ended.DONE) break;
      if (ended === Ended.ROOM) made = eachOf(made, (table) => grown(arena, table));
      else await tick();
    }
    const whole = wholeAt(done, BENCH_CELLS.CELLS) + 1;
    return eachOf(made, (table) => firstRows(table, whole));
  }
}

/** Room for a batch's chains of so many handles, on a route. @param {Arena} arena @param {number} handles @param {Numbers} rows */
function chainsFor(arena, handles, rows) {
  const { SLOTS } = PEAK;
  return {
    places: arena.placements(handles, SLOTS),
    change: arena.full([handles, SLOTS], 0),
    turn: arena.full([handles, SLOTS], 0),
    scratch: scratchFor(arena, handles),
    errors: errorsFor(arena, handles, SLOTS, seamsOf(arena, rows)),
  };
}

/** What rounding may have moved: `rate_rounding.errors_for`. @param {Arena} arena @param {number} handles @param {number} slots @param {Numbers} seams */
function errorsFor(arena, handles, slots, seams) {
  return {
    seams,
    lanes: arena.full([handles], 0),
    along: arena.full([handles], 0),
    ratio: arena.full([handles, slots], 0),
    change: arena.full([handles, slots], 0),
    turn: arena.full([handles, slots], 0),
    bend: arena.full([handles, slots], 0),
    sought: arena.full([handles, slots], 0),
    sided: arena.full([slots], 1),
    most: arena.full([slots], 0),
  };
}

/** Scratch for a chain of so many handles: `drive.scratch_for`. @param {Arena} arena @param {number} handles */
export function scratchFor(arena, handles) {
  return {
    table: arena.array("d", handles, STEP_BOUNDS.HANDLE_COLUMNS),
    bend: arena.array("d", handles, 2),
    rates: arena.array("d", handles, 2),
    crossing: arena.array("q", DRIVE.MOST_JUMPS),
    sides: arena.array("d", DRIVE.MOST_JUMPS + 1, 4),
    most: arena.array("d", handles),
    beside: arena.full([2], 0),
  };
}

/** Room for so many cells. @param {Arena} arena @param {number} count @param {number} kinds @returns {Cells} */
function emptyCells(arena, count, kinds) {
  const rows = count + 1;
  return {
    borders: arena.array("d", rows),
    bends: arena.array("d", rows),
    fastest: arena.array("d", rows),
    off: arena.array("d", rows),
    benches: arena.array("d", rows, kinds, BENCH_CELLS.CELL_COLUMNS),
  };
}

/** A workshop for so many links. @param {Arena} arena @param {number} kinds @param {Numbers} seams */
function workshopFor(arena, kinds, seams) {
  const slots = 2 * (kinds + 1);
  return {
    places: arena.placements(2, slots),
    bounds: arena.array("d", 2, STEP_BOUNDS.HANDLE_COLUMNS),
    rears: arena.array("d", slots),
    held: fillWhole(arena.array("q", kinds), 0n),
    change: arena.full([2, slots], 0),
    turn: arena.full([2, slots], 0),
    errors: errorsFor(arena, 2, slots, seams),
  };
}

/** No cells, and a kind for each bench. @param {Arena} arena @param {number} benches @returns {MadeCells} */
function noCells(arena, benches) {
  return { group: fillWhole(arena.array("q", benches), 0n), cells: emptyCells(arena, 0, 1) };
}

/** @param {Cells} cells @param {(table: Numbers) => Numbers} make @returns {Cells} */
function eachOf({ borders, bends, fastest, off, benches }, make) {
  const made = [borders, bends, fastest, off, benches].map(make);
  return { borders: made[0], bends: made[1], fastest: made[2], off: made[3], benches: made[4] };
}

/** Why a dragon does not stand with its head somewhere in low..high, m. @param {Walk} walk @param {number} low @param {number} high */
export function failureWithin(walk, low, high) {
  const count = Math.max(Math.ceil((high - low) / (STEP * least(walk.dragon.link))), 1);
  const at = evenly(low, high, count + 1);
  const per = Math.max(2, Math.floor(ANALYSIS_TABLES.PLACES / (walk.dragon.benches + 1)));
  for (let n = 0; n < count; n += per - 1) {
    const error = walk.firstFailure(at.slice(n, n + per));
    if (error !== null) return error;
  }
  return new UnsureError(_("it could not be shown that the dragon stands all along"));
}

/** Tells how far a bracket is closed, from the first one that is told to `tolerance`. */
class Closing {
  /** @param {number} tolerance @param {(share: number) => void} progress */
  constructor(tolerance, progress) {
    this.tolerance = tolerance;
    this.progress = progress;
    this.first = 0;
    this.share = 0;
  }

  /** @param {number} lower @param {number} upper */
  tell(lower, upper) {
    const gap = lower > 0 ? upper / lower - 1 : Infinity;
    if (this.tolerance < gap && gap < Infinity) {
      const left = Math.log(gap / this.tolerance);
      this.first ||= left;
      this.share = Math.max(this.share, 1 - left / this.first);
    }
    this.progress(this.share);
  }
}

/** Whether the coarse bound costs less than evaluations along the whole `way` of the head, m. @param {Walk} walk @param {number} way */
function coarseBoundPays({ dragon }, way) {
  const kinds = new Set(dragon.link).size;
  const count = (kinds * (way + dragon.extent)) / COARSE_CELL;
  return CELL_COST * count < (dragon.benches * way) / STEP;
}
