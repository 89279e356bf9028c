// What plans are made of in a page: benches from their tables, a base of those that come with it.

import { countText } from "../made/dragon.js";
import { _ } from "../words.js";
import { arena } from "./arena.js";
import { MODEL_DRAGON } from "./constants.js";
import { Dragon } from "./dragon.js";
import { InputError, PlanError, brief } from "./error_kinds.js";
import { BUILT_IN_PLANS } from "./plan_keys.js";

/** The dragon of a plan's table. @param {any} table */
export function _built(table) {
  if (!table.bench.length) return Dragon.uniform(arena(), table);
  const count = table.bench.reduce((/** @type {number} */ sum, /** @type {any} */ one) => sum + one.count, 0); // prettier-ignore
  if (count > MODEL_DRAGON.MOST_BENCHES) throw new InputError(countText(count));
  const all = table.bench.flatMap((/** @type {any} */ one) => Array(one.count).fill(one));
  const [length, width, front_inset, rear_inset] = ["length", "width", "front_inset", "rear_inset"].map(
    (name) => Float64Array.from(all, (one) => one[name]),
  );
  return new Dragon(arena(), { length, width, front_inset, rear_inset });
}

/** The tables of a base: a plan that comes with the page. @param {unknown} base @param {null} _folder @param {string} source */
export function _below(base, _folder, source) {
  if (typeof base === "string" && Object.hasOwn(BUILT_IN_PLANS, base))
    return structuredClone(BUILT_IN_PLANS[base]);
  const names = Object.keys(BUILT_IN_PLANS).join(", ");
  throw new PlanError(
    _("{source}: base must be one of {names} or the name of a file beside it, not {base}", {
      source,
      names,
      base: typeof base === "string" ? brief(base) : String(base),
    }),
  );
}
