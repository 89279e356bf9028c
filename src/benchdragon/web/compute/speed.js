// The greatest speed, acceleration or turning rate over a whole walk: kernels/peak_question.py, asked by
// the page. Twin of analysis/speed.py.

import { QUANTITIES } from "../made/quantities.js";
import { Rounds, repeats } from "../made/rounds.js";
import { _ } from "../words.js";
import { answered, now } from "./answer.js";
import { OverBudgetError, allow } from "./budget.js";
import {
  ANALYSIS_SPEED,
  DRIVE,
  MODEL_ANSWER,
  PEAK_MEMORY,
  PEAK_QUESTION,
  QUESTION,
} from "./constants.js";
import { OwnQuestion } from "./engine_question.js";
import { InputError, UnsureError, inOrder } from "./errors.js";
import { evenly, least } from "./lists.js";
import { general, pythonFloat } from "./number_format.js";
import { stretchesOf, timeOnStretch } from "./stretches.js";
import { silent } from "./tick.js";

/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./answer.js").Witness} Witness */
/** @typedef {import("./stretches.js").PaceStretch} PaceStretch */
/** @typedef {import("../made/quantities.js").Quantity} Quantity */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {{ tolerance?: number, limit?: number, progress?: Progress }} PeakOptions */

/** A quantity, the width of its bracket, as a share, and its limit. @typedef {[Quantity, number, number]} Asked */

/**
 * The greatest of a quantity: never more than `upper`, surely `least`; seen at `time`, s, with the head at s, m, on handle
 * or bench `row` (from 0), at `point`, m.
 * @typedef {{ value: number, upper: number, time: number, s: number, row: number, evaluations: number,
 *   least: number, point: [number, number] }} Peak
 */

const { TOLERANCE, LEAST_TOLERANCE, PLACES, ROOM, TOLD } = ANALYSIS_SPEED;
const { STEP, DONE, FALLEN } = PEAK_QUESTION;

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
  const stretches = stretchesOf(walk.profile, start, end).map(({ ways: [a, b], ...rest }) => {
    return /** @type {PaceStretch} */ ({ ...rest, ways: [a + walk.start, b + walk.start] });
  });
  const found = await peakOver(walk, quantity, stretches, options);
  const witness = { ...witnessOf(walk, quantity, found), time: found.time };
  const { value, least: sure, upper, evaluations } = found;
  const seconds = now() - began;
  return answered(value, sure, upper, quantity.unit, { witness, evaluations, seconds });
}

/** The greatest speed of any handle from start to end, s: `greatest`. @param {Walk} walk @param {number} start @param {number} end @param {PeakOptions} options */
export function greatestSpeed(walk, start, end, options) {
  return greatest(walk, QUANTITIES.get("speed"), start, end, options);
}

/**
 * The greatest of a quantity while a head at 1 m/s walks from position first to last, m.
 * @param {Walk} walk
 * @param {Quantity} quantity
 * @param {number} first @param {number} last
 * @param {PeakOptions} [options]
 */
export function greatestOf(walk, quantity, first, last, options = {}) {
  return peakOver(walk, quantity, steadily(first, last), options);
}

/** A way, m, walked at 1 m/s. @param {number} first @param {number} last @returns {PaceStretch[]} */
export function steadily(first, last) {
  return [{ times: [first, last], ways: [first, last], speeds: [1, 1], rate: 0 }];
}

/** @param {Walk} walk @param {Quantity} quantity @param {PaceStretch[]} stretches @param {PeakOptions} options */
async function peakOver(walk, quantity, stretches, options) {
  const { tolerance = TOLERANCE, limit = Infinity, progress = silent } = options;
  return (await sought(walk, stretches, [[quantity, tolerance, limit]], progress)).peak;
}

/**
 * A question about a walk whose head is driven so: see `sought`.
 * @param {Walk} walk
 * @param {PaceStretch[]} drives
 * @param {Asked[]} [asked]
 * @param {number} [head]
 */
export function peakQuestion({ engine, dragon, route }, drives, asked = [], head = 0) {
  const tolerances = new Float64Array(DRIVE.QUANTITIES);
  const limits = new Float64Array(DRIVE.QUANTITIES).fill(Infinity);
  for (const [{ kind }, tolerance, limit] of asked) {
    if (!(tolerance >= LEAST_TOLERANCE && tolerance <= 1)) {
      const values = { least: general(LEAST_TOLERANCE), value: pythonFloat(tolerance) };
      throw new InputError(_("tolerance must lie between {least} and 1, not at {value}", values));
    }
    [tolerances[kind], limits[kind]] = [tolerance, limit];
  }
  const kinds = Array.from(new Set(dragon.link)).sort((a, b) => a - b);
  return new OwnQuestion(
    engine,
    "bd_peak_question_*_peak",
    (arena, open) => {
      const driven = {
        ways: arena.table(drives.map(({ ways }) => ways), 2),
        squares: arena.table(drives.map(({ speeds: [a, b] }) => [a * a, b * b]), 2),
        rates: arena.vector(drives.map(({ rate }) => rate)),
      }; // prettier-ignore
      const group = arena.whole(Array.from(dragon.link, (link) => kinds.indexOf(link)));
      const numbers = arena.vector([dragon.extent, head, ...ROOM]);
      return open(
        route.rows, dragon.links, arena.vector(kinds), group, driven, arena.vector(tolerances),
        arena.vector(limits), numbers,
      ); // prettier-ignore
    },
    [[PEAK_MEMORY.FIGURES]],
  );
}

/**
 * Seek the greatest of a quantity on stretches of a walk, their ways being route positions; or the greatest
 * head speed, up to `head`, m/s, that keeps several limits, and which of them decides.
 * @param {Walk} walk
 * @param {PaceStretch[]} stretches
 * @param {Asked[]} asked
 * @param {Progress} progress
 * @param {number} [head]
 * @returns {Promise<{ peak: Peak, lower: number, upper: number, decides: Quantity | null }>}
 */
export async function sought(walk, stretches, asked, progress, head = 0) {
  const quantities = [...QUANTITIES.values()];
  // Who keeps one speed does what was done one round before.
  const parts = stretches.flatMap((of) => {
    const spans =
      of.rate === 0 ? new Rounds(walk, repeats(walk.route.rows)).new(...of.ways)[0] : [of.ways];
    return spans.map((/** @type {[number, number]} */ ways) => ({ of, part: { ...of, ways } }));
  });
  const drives = parts.map(({ part }) => part);
  const question = peakQuestion(walk, drives, asked, head);
  const told = (/** @type {number} */ column) => question.numbers(0)[column];
  try {
    let ending = QUESTION.MORE;
    while (ending === QUESTION.MORE) {
      try {
        ending = await question.step();
      } catch (error) {
        if (!(error instanceof OverBudgetError && told(PEAK_MEMORY.GIVEN_UP))) throw error;
        ending = DONE;
        allow(TOLD);
      }
      progress(told(PEAK_MEMORY.SHARE), head ? _(quantities[told(PEAK_MEMORY.QUANTITY)].text) : "");
    }
    if (ending === FALLEN) throw failureWithin(walk, told(PEAK_MEMORY.LOW), told(PEAK_MEMORY.HIGH));
    const [value, sure, most, s, row, x, y, stretch, evaluations, lower, upper, decides] = question
      .numbers(0)
      .subarray(PEAK_MEMORY.VALUE);
    const time = timeOnStretch(parts[stretch].of, s);
    const peak = { value, upper: most, time, s, row, evaluations, least: sure };
    return {
      peak: { ...peak, point: [x, y] },
      lower,
      upper,
      decides: decides < 0 ? null : quantities[decides],
    };
  } finally {
    question.free();
  }
}

/**
 * Where a peak comes about: handle or bench, and when a head at the walk's own speed is there.
 * @param {Walk} walk
 * @param {Quantity} quantity
 * @param {Peak} found
 * @returns {Witness}
 */
export function witnessOf(walk, quantity, { s, row, point }) {
  const time = walk.time_at(s);
  return {
    time: Number.isFinite(time) ? time : null,
    s,
    benches: [Math.min(row + 1, walk.dragon.benches)],
    point,
    gap: NaN,
    features: [],
    handle: quantity.kind === DRIVE.TURNING ? null : row,
    obstacle: null,
  };
}

/** The first handle that comes to the greatest of these speeds but for rounding. @param {Float64Array} speeds */
export function fastestHandle(speeds) {
  const most = speeds.reduce((a, b) => Math.max(a, b)) * (1 - MODEL_ANSWER.ROUNDING);
  return speeds.findIndex((speed) => speed >= most);
}

/** Why a dragon does not stand with its head somewhere in low..high, m. @param {Walk} walk @param {number} low @param {number} high */
export function failureWithin(walk, low, high) {
  const count = Math.max(Math.ceil((high - low) / (STEP * least(walk.dragon.link))), 1);
  const at = evenly(low, high, count + 1);
  const per = Math.max(2, Math.floor(PLACES / (walk.dragon.benches + 1)));
  for (let n = 0; n < count; n += per - 1) {
    const error = walk.first_failure(at.slice(n, n + per));
    if (error !== null) return error;
  }
  return new UnsureError(_("it could not be shown that the dragon stands all along"));
}
