// A search along a walk for pairs of benches: the engine's question about it, and its answers. Twin of
// analysis/contact_search.py.

import { atMost } from "../made/number_format.js";
import { _ } from "../words.js";
import { answered, now } from "./answer.js";
import { withArena } from "./arena.js";
import { OverBudgetError, aside, asideMost, left, memory } from "./budget.js";
import {
  ANALYSIS_CONTACT_SEARCH,
  ANALYSIS_TABLES,
  CONTACT_MEMORY,
  FAMILY,
  NEARNESS,
  QUESTION,
  WALK_SEARCH,
} from "./constants.js";
import { boxes, nearness, nearnessOf } from "./distance.js";
import { EngineQuestion } from "./engine_question.js";
import { InputError, UnsureError, finite, notNegative } from "./errors.js";
import { HeadTimes } from "../made/head_times.js";
import { checkedOff, originOf, seenFrom } from "./nearby.js";
import { general } from "./number_format.js";
import { newSpans } from "./rounds.js";
import { beginnings, inColumns, tooManyKinds } from "./tables.js";

/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./answer.js").Status} Status */
/** @typedef {import("./answer.js").Witness} Witness */
/** @typedef {import("./distance.js").Nearness} Nearness */
/** @typedef {import("./rounds.js").Span} Span */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */

const { SLACK, WIDTH, MOST_EVALUATIONS, MOST_LEAST_EVALUATIONS, REFINING, REFINING_ON, SAMPLES_AHEAD } =
  ANALYSIS_CONTACT_SEARCH;
const { UNKNOWN } = FAMILY;
const told = CONTACT_MEMORY;
/** Widths of brackets of clearances, m: the first that can be. @type {number[]} */
export const TOLERANCES = ANALYSIS_CONTACT_SEARCH.TOLERANCES;

/** What answers rest on whose distances may be off by so much, m. @param {number} off */
export function assumedWithin(off) {
  const values = { slack: atMost(off) };
  return [_("computed distances are within {slack} m of the exact ones", values)];
}

/** Check two times, s. @param {number} start @param {number} end */
export function inOrder(start, end) {
  if (finite("end", end, "s") >= finite("start", start, "s")) return;
  const values = { end: general(end), start: general(start) };
  throw new InputError(_("the end ({end} s) must not come before the start ({start} s)", values));
}

/** So many numbers that rise by even factors from one to another. @param {number} low @param {number} high @param {number} count */
function geometric(low, high, count) {
  const [a, b] = [Math.log10(low), Math.log10(high)];
  return Array.from({ length: count }, (_number, n) => {
    if (n === 0 || n === count - 1) return n ? high : low;
    return 10 ** (a + ((b - a) * n) / (count - 1));
  });
}

/** Chains of so many handles that the question at hand may still march, in one step. @param {number} handles */
export function mostEvaluations(handles) {
  return Math.trunc(Math.min(Math.max(left() / (WALK_SEARCH.SEARCHED * handles), 1), MOST_EVALUATIONS));
}

/** From where a walk is searched that begins with its head at s, m. @param {Walk} walk @param {number} s */
function originAt(walk, s) {
  return withArena(walk.engine, (arena) => originOf(walk.placement(arena, [s], { throws: false })));
}

/**
 * How two benches stand at a time, s, with the head at s, seen from an origin, m.
 * @param {Nearness} near @param {[number, number]} origin @param {number} time @param {number} s
 * @returns {Witness}
 */
function witnessOf({ benches, distance, points, features }, origin, time, s) {
  const [x, y] = points[benches.indexOf(features[0][0])];
  /** @type {[number, number]} */
  const point = [x + origin[0], y + origin[1]];
  return { time, s, benches, point, gap: distance, features, handle: null, obstacle: null };
}

/** A search along a walk from one head position to another. */
export class ContactSearch extends EngineQuestion {
  /**
   * @param {Walk} walk
   * @param {[number, number]} ends head positions, m
   * @param {number} margin distance that benches must keep, m
   * @param {Progress} progress
   * @param {[number, number]} within the times at which it begins and ends, s
   * @param {Span[]} spans of the head's way, m, that are searched: the whole, or what repeats nothing
   * @param {number[]} tolerances widths of brackets of the least distance, m: the first that can be
   */
  constructor(walk, [start, end], margin, progress, [since, until], spans, tolerances) {
    const origin = originAt(walk, start);
    let seen = walk;
    const limits = inColumns([
      [told.MARGIN, margin],
      [told.LEAST_OFF, SLACK],
      [told.WIDTH, WIDTH],
      [told.MOST, MOST_EVALUATIONS],
      [told.MOST_LEAST, MOST_LEAST_EVALUATIONS],
      [told.BYTES, memory()],
      [told.BEGIN, start],
      [told.END, end],
      [told.MOST_KINDS, ANALYSIS_TABLES.MOST_SIZES],
      [told.REFINING, asideMost(REFINING)],
      [told.REFINING_ON, asideMost(REFINING_ON)],
    ]);
    super(
      walk.engine,
      "bd_contact_question_*_contact",
      (arena, open, kept) => {
        seen = seenFrom(kept, walk, origin);
        const { dragon, route } = seen;
        const handle = open({
          rows: route.rows,
          links: dragon.links,
          sizes: dragon.sizes,
          lever: arena.vector([dragon.lever]),
          spans: arena.table(spans, 2),
          limits: arena.vector(limits),
          tolerances: arena.vector(tolerances),
          beginnings: arena.whole(beginnings()),
        });
        if (handle < 0) throw tooManyKinds(dragon.sizes);
        return handle;
      },
      [[told.FIGURES], [NEARNESS.NEARNESS]],
    );
    this.origin = origin;
    /** As given, but with coordinates counted from `origin`. */
    this.walk = seen;
    this.ends = [start, end];
    this.progress = progress;
    /** When the head comes to positions of the search. */
    this.times = new HeadTimes(seen, start, since, until);
    this.began = now();
  }

  /** What the engine tells, by the columns of kernels/contact_memory.py. */
  get figures() {
    return this.numbers(0);
  }

  /** A number that the engine tells: a column of kernels/contact_memory.py. @param {number} column */
  figure(column) {
    return this.numbers(0)[column];
  }

  /** What distances that mattered so far may be off by, m. */
  get off() {
    return Math.max(this.figure(told.OFF_BY), SLACK);
  }

  /** Search on for a goal of kernels/contact_question.py; how that ended. @param {number} goal @param {number} [within] m */
  async find(goal, within = 0) {
    withArena(this.engine, (arena) => this.call("seek", this.handle, goal, arena.vector([within])));
    const [start, end] = this.ends;
    let ending;
    while ((ending = await this.step()) === QUESTION.MORE)
      this.progress((this.figure(told.WALKED) - start) / (end - start), "");
    if (ending === told.STOPPED)
      throw this.#stopped(this.figure(told.SOUND_TO), this.figure(told.UNTIL));
    if (ending === told.UNSHOWN)
      throw new UnsureError(_("it could not be shown that the dragon stands all along"));
    if (ending === told.ENDLESS) {
      const values = { most: ANALYSIS_TABLES.MOST_CELLS };
      throw new UnsureError(
        _("the walk is too long to be searched: more than {most} cells of its route", values),
      );
    }
    if (ending === told.BLURRED) checkedOff(this.off);
    return ending;
  }

  /** Why the walk could not be followed past head position `sound`, looked for up to `until`. @param {number} sound @param {number} until */
  #stopped(sound, until) {
    // A bench may stand square to the route for a tenth of a millimetre only, and then leap.
    const reach = Math.max(Math.min(until, this.ends[1]) - sound, UNKNOWN);
    const ahead = geometric(UNKNOWN, reach, SAMPLES_AHEAD).map((far) => sound + far);
    const error = this.walk.firstFailure([sound, ...ahead]);
    if (error !== null && error.head <= sound + 2 * UNKNOWN) return error;
    const t = general(this.times.at(sound));
    return new UnsureError(
      _("past t = {t} s it could not be shown that every bench follows without a leap", { t }),
    );
  }

  /** How the benches stand that were found. */
  witness() {
    const s = this.figure(told.LATE);
    return witnessOf(nearnessOf(this.numbers(1)), this.origin, this.times.at(s), s);
  }

  /** An answer of a value, the ends of its bracket and a unit; with a witness if it was `seen`. @param {[number, number, number]} bracket @param {string} unit @param {Status} status */
  answer([value, lower, upper], unit, status, seen = true) {
    const [evaluations, seconds] = [this.figure(told.MARCHED), now() - this.began];
    const witness = seen ? this.witness() : null;
    const rest = { assumptions: assumedWithin(this.off), evaluations, seconds };
    return answered(value, lower, upper, unit, { status, witness, ...rest });
  }

  /** When the benches come to stand as was found. @param {Status} status */
  moment(status) {
    const [early, late] = [this.figure(told.EARLY), this.figure(told.LATE)];
    const [behind, ahead] = [this.figure(told.EARLY_LEAD), this.figure(told.LATE_LEAD)];
    const [value, lower, upper, known] = this.times.told(early, late, status, [behind, ahead]);
    return this.answer([value, lower, upper], "s", known);
  }
}

/** How benches i and j (rows, from 0) of a walk stand with the head at s, m, without a search. @param {Walk} walk @param {HeadTimes} times @param {number} s @param {number} i @param {number} j */
export function standAlone(walk, times, s, i, j) {
  const origin = originAt(walk, times.start);
  return withArena(walk.engine, (arena) => {
    const placed = seenFrom(arena, walk, origin).placement(arena, [s], { throws: false });
    return witnessOf(nearness(walk.engine, boxes(arena, placed), i, j), origin, times.at(s), s);
  });
}

/**
 * A search of the walk from start to end, s, for which the dragon must stand at the start: of the whole of it,
 * or but of what repeats nothing before it (see rounds.js).
 * @param {Walk} walk
 * @param {number} start @param {number} end s
 * @param {number} margin m
 * @param {Progress} progress
 * @param {{ whole?: boolean, tolerances?: number[] }} [options]
 */
export function contactSearch(walk, start, end, margin, progress, options = {}) {
  notNegative("margin", margin, "m");
  inOrder(start, end);
  const [a, b] = [walk.headPosition(start), walk.headPosition(end)];
  const { whole = false, tolerances = TOLERANCES } = options;
  /** @type {Span[]} */
  const spans = whole ? [[a, b]] : newSpans(walk, a, b);
  withArena(walk.engine, (arena) => walk.motion(arena, [start])); // throws where it cannot stand there
  return new ContactSearch(walk, [a, b], margin, progress, [start, end], spans, tolerances);
}

/**
 * What a pass makes that refines a bracket to the tolerance of number n; null where that is too dear.
 * @template T
 * @param {number} n
 * @param {() => Promise<T>} pass
 */
export async function refined(n, pass) {
  try {
    return await aside(n ? REFINING_ON : REFINING, pass);
  } catch (error) {
    if (error instanceof OverBudgetError) return null;
    throw error;
  }
}
