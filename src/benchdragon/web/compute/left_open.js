// What a check leaves open once contact is decided: it takes too much work, or rounding hides it. Twin of
// analysis/left_open.py.

import { Answer, Witness } from "../made/answer.js";
import { DEAR, HIDDEN, openFinding } from "../made/left_open.js";
import { fastestHandle } from "../made/speed.js";
import { doubles, withArena } from "./arena.js";
import { OverBudgetError, allow } from "./budget.js";
import { ANALYSIS_LEFT_OPEN, MODEL_ANSWER } from "./constants.js";
import { UnsureError } from "./errors.js";

/** @typedef {import("../made/findings.js").Finding} Finding */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("./walk.js").Walk} Walk */

const { REST } = ANALYSIS_LEFT_OPEN;

/**
 * Answer a question with work of its own: what takes its errors, and adds what stays open to `found`: if a
 * verdict needs it, without `asked` none does. `limit` is that of what is limited, in SI units.
 * @param {Finding[]} found
 * @param {Obstacle | string | null} [asked] an obstacle, a level of room, or what is limited, by name
 * @param {number} [limit]
 */
export function toldIfOpen(found, asked = null, limit = 0) {
  allow(REST);
  return (/** @type {unknown} */ error) => {
    if (!(error instanceof OverBudgetError || error instanceof UnsureError)) throw error;
    allow(REST); // for what is known without a search
    if (asked !== null)
      found.push(openFinding(asked, limit, error instanceof OverBudgetError ? DEAR : HIDDEN));
  };
}

/** What is known of the greatest speed of a handle, m/s, without a search: that at the start, s. @param {Walk} walk @param {number} start @returns {Answer} */
export function speedAtStart(walk, start) {
  return withArena(walk.engine, (arena) => {
    const motion = walk.motion(arena, [start]);
    const row = fastestHandle(doubles(motion.ratio));
    const value = motion.speed[row];
    const point = [doubles(motion.x)[row], doubles(motion.y)[row]];
    const bench = Math.min(row + 1, walk.dragon.benches);
    const witness = new Witness(start, motion.headS[0], [bench], point, NaN, [], row);
    const low = value * (1 - MODEL_ANSWER.ROUNDING);
    return new Answer(value, low, Infinity, "m/s", "undecided", witness);
  });
}
