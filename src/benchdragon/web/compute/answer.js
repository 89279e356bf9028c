// Answers: a number with the bracket that was established, how, and what shows it. Twin of
// model/answer.py.

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

/** An answer of a record, its bracket as numbers; a record has none for what is not finite. @param {import("../messages").Answer} answer */
export function bracketed({ value, lower, upper, unit }) {
  const [number, low, high] = [value ?? Infinity, lower ?? -Infinity, upper ?? Infinity];
  return { value: number, lower: low, upper: high, unit };
}
