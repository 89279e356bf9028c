// What a check leaves open once contact is decided: it takes too much work, or rounding hides it. Twin of
// analysis/left_open.py.

import { _ } from "../words.js";
import { answered } from "./answer.js";
import { doubles, withArena } from "./arena.js";
import { OverBudgetError, allow } from "./budget.js";
import { ANALYSIS_LEFT_OPEN, MODEL_ANSWER } from "./constants.js";
import { UnsureError } from "./errors.js";
import { named } from "./findings.js";
import { general } from "./number_format.js";
import { Obstacle } from "./obstacle.js";
import { QUANTITIES } from "./quantities.js";
import { fastestHandle } from "./speed.js";

/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./findings.js").Finding} Finding */
/** @typedef {import("./findings.js").Kind} Kind */
/** @typedef {import("./quantities.js").QuantityName} QuantityName */
/** @typedef {import("./room.js").LevelName} LevelName */
/** @typedef {import("./walk.js").Walk} Walk */

const { REST } = ANALYSIS_LEFT_OPEN;

/**
 * What `ask` answers with work of its own; null where that stays open, which is then added to `found`: if a
 * verdict needs it, without `asked` none does. `limit` is that of what is limited, in SI units.
 * @template T
 * @param {Finding[]} found
 * @param {() => Promise<T>} ask
 * @param {Obstacle | Kind | LevelName | null} [asked]
 * @param {number} [limit]
 * @returns {Promise<T | null>}
 */
export async function toldIfOpen(found, ask, asked = null, limit = 0) {
  allow(REST);
  try {
    return await ask();
  } catch (error) {
    if (!(error instanceof OverBudgetError || error instanceof UnsureError)) throw error;
    allow(REST); // for what is known without a search
    if (asked !== null) found.push(open(asked, limit, error instanceof OverBudgetError));
    return null;
  }
}

/** @param {Obstacle | Kind | LevelName} asked @param {number} limit @param {boolean} dear @returns {Finding} */
function open(asked, limit, dear) {
  const why = () => (dear ? _("that takes more work than a question may") : _("rounding hides it"));
  const rest = { time: null, benches: [], value: 0, decided: false };
  if (asked instanceof Obstacle) {
    const text = () =>
      _("whether benches keep their distance from {name} is open: {why}", {
        name: named(asked),
        why: why(),
      });
    const kind = asked.kind === "venue" ? "venue" : "obstacle";
    return { ...rest, kind, limit: asked.margin, text, obstacle: asked };
  }
  const kind = /** @type {Kind} */ (asked);
  if (asked in QUANTITIES) {
    const { text: what, unit } = QUANTITIES[/** @type {QuantityName} */ (asked)];
    const text = () =>
      _("whether the {what} keeps to {limit} {unit} is open: {why}", {
        what: what(),
        unit,
        limit: general(limit),
        why: why(),
      });
    return { ...rest, kind, limit, text, obstacle: null };
  }
  const text = () => _("whether there is room for people is open: {why}", { why: why() });
  return { ...rest, kind, limit, text, obstacle: null };
}

/** What is known of the greatest speed of a handle, m/s, without a search: that at the start, s. @param {Walk} walk @param {number} start @returns {Answer} */
export function speedAtStart(walk, start) {
  return withArena(walk.engine, (arena) => {
    const motion = walk.motion(arena, [start]);
    const row = fastestHandle(doubles(motion.ratio));
    const value = motion.speed[row];
    const [x, y] = [doubles(motion.x)[row], doubles(motion.y)[row]];
    const benches = [Math.min(row + 1, walk.dragon.benches)];
    const place = { time: start, s: motion.headS[0], benches, point: /** @type {[number, number]} */ ([x, y]) }; // prettier-ignore
    return answered(value, value * (1 - MODEL_ANSWER.ROUNDING), Infinity, "m/s", {
      status: "undecided",
      witness: { ...place, gap: NaN, features: [], handle: row, obstacle: null },
    });
  });
}
