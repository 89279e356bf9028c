// Whether a walk is safe: made/check.js, as one question. What is proved, the command line proves.

import { checked } from "../made/check.js";
import { question } from "./budget.js";
import { silent } from "./tick.js";

/**
 * Check the whole walk of a plan against its margin and its limits.
 * @param {import("./plan.js").Plan} plan
 * @param {import("./walk.js").Walk} walk that of the plan
 * @param {[number, number]} span start and end of the walk, s
 * @param {{ progress?: import("./tick.js").Progress }} [options]
 */
export function check(plan, walk, span, { progress = silent } = {}) {
  return question(() => checked(plan, walk, span, progress));
}
