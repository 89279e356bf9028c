// What a village calls its benches: twin of `called` in plans/people.py, and of `_village` in
// player/scene.py.

import { _, both } from "../words.js";

/** @typedef {Record<string, any>} People the table of a plan, filled */

/** What a bench is called after its number, with {n} for that. @param {People} people @param {Record<string, number>} [values] */
function unitName({ unit }, values) {
  if (unit === "qiao") return _("qiao {n}", values);
  return unit === "jie" ? _("jie {n}", values) : _("bench {n}", values);
}

/** What the village calls a bench (number, from 1) of so many, in the language in use. @param {People} people @param {number} bench @param {number} count */
export function called(people, bench, count) {
  if (!people.count_head && bench === 1) return _("the head");
  if (!people.count_head && bench === count) return _("the tail");
  return unitName(people, { n: people.count_head ? bench : bench - 1 });
}

/** What the village calls so many benches, where that is not what the plan calls them; else null. @param {People} people @param {number} count */
export function villageOf(people, count) {
  if (people.unit === "bench" && people.count_head) return null;
  return {
    head: both(() => called(people, 1, count)),
    between: both(() => unitName(people)),
    tail: both(() => called(people, count, count)),
    before: people.count_head ? 0 : 1,
  };
}
