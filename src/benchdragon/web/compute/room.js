// Room for people: whether a walk stays clear with sway, imprecision and bearers beside the benches. Twin
// of analysis/room.py.
//
// Level upon level, each by the search that finds contacts of benches, with its own margin and sizes.

import { firstSureContact } from "../made/contact.js";
import { obstacleAnswers } from "../made/obstacles.js";
import { ASKED, RoomLevel, levelsAsked, shownName } from "../made/room_levels.js";
import { withArenaAsync } from "./arena.js";
import { ANALYSIS_ROOM } from "./constants.js";
import { Dragon } from "./dragon.js";
import { py } from "./python.js";
import { shortage } from "./shortage.js";
import { Walk } from "./walk.js";

/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./plan.js").Plan} CheckedPlan */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("../made/obstacles.js").ObstacleAnswers} ObstacleAnswers */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {"benches" | "sway" | "imprecision" | "people"} LevelName */
/** @typedef {"sway" | "imprecision" | "beside" | "ahead"} Need */
/** What people ask for, m, and where that comes from. @typedef {Partial<Record<Need, number>> & { source?: Partial<Record<Need, string>> }} People */
/** What a level asks for: m, and its source, "" for an assumption. @typedef {{ key: Need, value: number, source: string }} Asked */

/** What breaks a level, and the obstacle, if it is one. @typedef {{ contact: Answer, obstacle: Obstacle | null }} Known */
/** What was found of benches, and of what stands. @typedef {{ contact: Answer | null, obstacles: ObstacleAnswers[] }} Found */

/**
 * Find the levels of room that a plan asks for, benches alone first; none if it asks for none.
 *
 * Two benches that each sway, or stray, come nearer by twice that; to what stands still, by once. Each
 * level is searched from the start of the span, s, until the one before it is broken. `bare` is what was
 * found of benches alone.
 * @param {CheckedPlan} plan
 * @param {Walk} walk
 * @param {[number, number]} span
 * @param {[Answer | null, ObstacleAnswers[]]} bare
 * @param {RoomLevel[]} levels to which each is added
 * @param {{ progress: Progress }} options
 * @returns {Promise<void>}
 */
export function roomLevels(plan, walk, span, bare, levels, { progress }) {
  return withArenaAsync(walk.engine, async (arena) => {
    const names = levelsAsked(plan.tables.people);
    if (names.length) levels.push(new RoomLevel("benches", [], plan.tables.limits.margin, ...bare));
    let [each, line] = [0, walk];
    for (const [n, name] of names.entries()) {
      progress(n / names.length, shownName({ name }));
      const asked = askedOf(plan.tables.people, name);
      if (name === "people") line = withPeople(arena, walk, plan.tables.people);
      else each += asked[0].value;
      const until = untilBroken(levels[levels.length - 1], span);
      const margin = plan.tables.limits.margin + 2 * each;
      const contact = await firstSureContact(line, ...until, margin);
      const stands = plan.obstacles().map((one) => py.replaced(one, { margin: one.margin + each }));
      const tolerances = ANALYSIS_ROOM.TOLERANCES;
      const obstacles = [];
      for (const one of stands) obstacles.push(await obstacleAnswers(line, one, ...until, tolerances));
      const level = new RoomLevel(name, asked, margin, contact, obstacles);
      const { first } = level;
      if (first !== null && level.kept !== null) {
        const [values, last] = [
          asked.map(({ key, value }) => [key, value]),
          untilBroken(levels[0], span)[1],
        ];
        const known = { contact: first[0], obstacle: first[1] };
        level.short = shortage(walk, known, margin, Object.fromEntries(values), last);
      }
      levels.push(level);
    }
  });
}

/** The walk with room for bearers on both sides of all benches, and before the head's bench. @param {Arena} arena @param {Walk} walk @param {People} people */
function withPeople(arena, { dragon, route, profile, start }, { beside = 0, ahead = 0 }) {
  const [length, front_inset] = [dragon.length.slice(), dragon.front_inset.slice()];
  length[0] += ahead;
  front_inset[0] += ahead;
  const width = dragon.width.map((wide) => wide + 2 * beside);
  const { rear_inset } = dragon;
  const line = new Dragon(arena, { length, width, front_inset, rear_inset });
  return new Walk(line, route, profile, start);
}

/** @param {People} people @param {LevelName} name @returns {Asked[]} */
function askedOf(people, name) {
  return ASKED.get(name).flatMap((/** @type {Need} */ key) => {
    const value = people[key];
    return value ? [{ key, value, source: people.source?.[key] ?? "" }] : [];
  });
}

/** From the start of a span, s, until a level is surely broken, or to its end. @param {Found} level @param {[number, number]} span @returns {[number, number]} */
function untilBroken({ contact, obstacles }, [start, end]) {
  const known = [contact, ...obstacles.map((one) => one.contact)].flatMap((one) => one ?? []);
  const ends = known.flatMap(({ status, upper }) => (status === "undecided" ? [] : [upper]));
  return [start, Math.min(end, ...ends)];
}
