// What a check did not look at, because the plan does not say it: twin of analysis/not_looked_at.py.

import { _ } from "../words.js";
import { doubles, withArena } from "./arena.js";
import { ANALYSIS_NOT_LOOKED_AT, PLANS_ROUTES } from "./constants.js";
import { known } from "./number_format.js";
import { levelsAsked } from "./room.js";

/** @typedef {import("./check.js").CheckedPlan} CheckedPlan */
/** @typedef {import("./walk.js").Walk} Walk */
/** What the sentences tell. @typedef {{ way: string, first: number, last: number }} Behind */
/** Something that was not looked at, in a sentence and in few words. @typedef {{ kind: string, text: () => string, brief: () => string }} NotLookedAt */

const { DUST } = ANALYSIS_NOT_LOOKED_AT;
const { RUN_UP } = PLANS_ROUTES;

/** In a sentence. @type {Record<string, (words?: Behind) => string>} */
const TEXTS = {
  street: () =>
    _(
      "the plan gives no edge, wall or house along the drawn route (venue, obstacle): whether the dance keeps off them was not looked at",
    ),
  square: () =>
    _(
      "the plan gives neither an edge of the square nor anything that stands on it (venue, obstacle): whether the dance keeps off them was not looked at",
    ),
  venue: () =>
    _("the plan gives no edge of the square (venue): whether the dance stays inside was not looked at"),
  people: () =>
    _(
      "the plan asks for no room for people (people.beside, people.ahead, people.sway, people.imprecision): only the benches themselves were looked at",
    ),
  speed: () =>
    _(
      "the plan gives no greatest speed (limits.speed, people.most_speed): speeds were computed, and compared with nothing",
    ),
  behind: (words) =>
    _(
      "at the start {way} m of the dragon, benches {first} to {last}, stand on a straight line behind the start of the route, which the plan does not draw: whether there is such a way was not looked at",
      words,
    ),
  "still behind": (words) =>
    _(
      "when the walk ends, {way} m of the dragon, benches {first} to {last}, have not yet come to the route that the plan draws",
      words,
    ),
};

/** In few words. @type {Record<string, (words?: Behind) => string>} */
const BRIEF = {
  street: () => _("walls and houses along the route"),
  square: () => _("the square"),
  venue: () => _("the edge of the square"),
  people: () => _("room for people"),
  speed: () => _("limits of speed"),
  behind: (words) => _("the ground behind the start, {way} m", words),
  "still behind": (words) => _("the route of benches {first} to {last}", words),
};

/**
 * What a check of a plan's walk from a start to an end, s, does not look at.
 * @param {CheckedPlan} plan
 * @param {Walk} walk
 * @param {[number, number]} span
 * @returns {NotLookedAt[]}
 */
export function notLookedAt(plan, walk, [start, end]) {
  const { route, people, limits } = plan.tables;
  const standing = plan.obstacles();
  const kinds = [];
  if (!standing.length) kinds.push(route.kind === "drawn" ? "street" : "square");
  else if (standing.every(({ kind }) => kind !== "venue")) kinds.push("venue");
  if (!levelsAsked(people).length) kinds.push("people");
  if (limits.speed === null && people.most_speed === null) kinds.push("speed");
  const found = kinds.map((kind) => told(kind));
  if (!runsOn(walk)) return found;
  for (const [kind, time] of /** @type {const} */ ([["behind", start], ["still behind", end]])) {
    const words = behind(plan, walk, time);
    if (words) found.push(told(kind, words));
  } // prettier-ignore
  return found;
}

/** @param {string} kind @param {Behind} [words] @returns {NotLookedAt} */
function told(kind, words) {
  return { kind, text: () => TEXTS[kind](words), brief: () => BRIEF[kind](words) };
}

/** Whether a straight line that the plan does not draw leads to the start of the route. @param {Walk} walk */
export function runsOn({ route }) {
  return route.straight;
}

/** Where on the route begins what the plan gives, m: after the line before a drawn bend. @param {CheckedPlan} plan @param {Walk} walk */
export function givenFrom({ tables: { route } }, walk) {
  const drawn = route.kind === "drawn" && !route.closed;
  return drawn && Math.abs(walk.route.joints[1] - RUN_UP) < DUST ? RUN_UP : 0;
}

/** How much of the dragon stands behind what the plan gives of the route at a time, s; null where nothing does. @param {CheckedPlan} plan @param {Walk} walk @param {number} time @returns {Behind | null} */
function behind(plan, walk, time) {
  const given = givenFrom(plan, walk);
  return withArena(walk.engine, (arena) => {
    const s = doubles(walk.motion(arena, [time], { throws: false }).s);
    const first = s.findIndex((place, n) => n > 0 && place < given - DUST);
    if (first < 0) return null;
    const way = given - s[s.length - 1];
    return { way: known(way, way, "m", true), first, last: s.length - 1 };
  });
}
