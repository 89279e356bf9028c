// Answers: a number with the bracket that was established, how, and what shows it. Twin of
// model/answer.py.

import { MODEL_ANSWER } from "./constants.js";
import { atMost, known } from "./number_format.js";

const { ROUNDING } = MODEL_ANSWER;

/** @typedef {"proved" | "found" | "infeasible" | "undecided" | "unlimited"} Status */

/**
 * Where and when an answer comes about.
 * @typedef {object} Witness
 * @property {number | null} time s; null where time has no part in it
 * @property {number} s route position of the head's handle then, m
 * @property {number[]} benches the two benches, or the one, 1..N
 * @property {[number, number]} point where they meet or are nearest (the corner's side), m
 * @property {number} gap how far they then are apart, m; minus a depth where they overlap; NaN for one bench
 * @property {Array<[number, string]>} features what meets: the corner of one bench, and the side or
 *   corner of the other
 * @property {number | null} handle of an answer about a handle its number, 0..N: the first of those that
 *   come to the same; the bench is the one that it leads, the last bench for handle N
 * @property {string | null} obstacle of an answer about an obstacle its name; the gap is then the
 *   distance from it, m
 */

/**
 * A solved number.
 * @typedef {object} Answer
 * @property {number} value the best estimate
 * @property {number} lower with upper, the bracket that was established
 * @property {number} upper
 * @property {string} unit of the three
 * @property {Status} status
 * @property {Witness | null} witness what shows it
 * @property {string[]} assumptions what it rests on
 * @property {number} evaluations how many times the dragon was placed to find it
 * @property {number} seconds how long that took
 */

/**
 * An answer that was found.
 * @param {number} value @param {number} lower @param {number} upper @param {string} unit
 * @param {Partial<Answer>} [more]
 * @returns {Answer}
 */
export function answered(value, lower, upper, unit, more = {}) {
  const rest = { witness: null, assumptions: [], evaluations: 0, seconds: 0, ...more };
  return { value, lower, upper, unit, status: "found", ...rest };
}

/** The time now, for how long something took, s. */
export function now() {
  return performance.now() / 1000;
}

/** Whether rounding hides all of a distance that may be more than 0: its upper end is told. @param {Pick<Answer, "value" | "lower" | "upper">} answer */
export function vanishing({ value, lower, upper }) {
  return lower <= 0 && 0 <= value && value <= upper - value && upper > 0;
}

/** The upper or lower end of the bracket; the value where rounding alone lies between them. @param {Pick<Answer, "value" | "lower" | "upper">} answer @param {boolean} up */
export function sure({ value, lower, upper }, up) {
  const end = up ? upper : lower;
  const near = Math.abs(end - value) <= ROUNDING * Math.abs(value);
  return near || !Number.isFinite(end) ? value : end;
}

/** An answer of a record, its bracket as numbers; a record has none for what is not finite. @param {import("../messages").Answer} answer */
export function bracketed({ value, lower, upper, unit }) {
  const [number, low, high] = [value ?? Infinity, lower ?? -Infinity, upper ?? Infinity];
  return { value: number, lower: low, upper: high, unit };
}

/** What is surely true of it, in the digits that are known: see `known`. @param {Pick<Answer, "value" | "lower" | "upper" | "unit">} answer @param {boolean} up @param {number | null} [limit] */
export function shown(answer, up, limit = null) {
  if (!up && answer.unit === "m" && vanishing(answer)) return atMost(answer.upper);
  return known(sure(answer, false), sure(answer, true), answer.unit, up, limit);
}

/** The most that keeps to a limit, but for rounding. @param {number} limit */
export function mostOf(limit) {
  return limit * (1 + ROUNDING);
}

/** Whether the number is at most a limit, but for rounding; null where that is open. @param {Answer} answer @param {number} limit */
export function keeps({ lower, upper }, limit) {
  if (lower > mostOf(limit)) return false;
  return upper <= mostOf(limit) ? true : null;
}
