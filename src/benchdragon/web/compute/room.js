// Room for people: whether a walk stays clear with sway, imprecision and bearers beside the benches. Twin
// of analysis/room.py.
//
// Level upon level, each by the search that finds contacts of benches, with its own margin and sizes.

import { _ } from "../words.js";
import { withArenaAsync } from "./arena.js";
import { ANALYSIS_ROOM } from "./constants.js";
import { firstSureContact } from "./contact.js";
import { Dragon } from "./dragon.js";
import { obstacleAnswers, withMargin } from "./obstacles.js";
import { shortage } from "./shortage.js";
import { Walk } from "./walk.js";

/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./check.js").CheckedPlan} CheckedPlan */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("./obstacles.js").ObstacleAnswers} ObstacleAnswers */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {"benches" | "sway" | "imprecision" | "people"} LevelName */
/** @typedef {"sway" | "imprecision" | "beside" | "ahead"} Need */
/** What people ask for, m, and where that comes from. @typedef {Partial<Record<Need, number>> & { source?: Partial<Record<Need, string>> }} People */
/** What a level asks for: m, and its source, "" for an assumption. @typedef {{ key: Need, value: number, source: string }} Asked */

/** What breaks a level, and the obstacle, if it is one. @typedef {{ contact: Answer, obstacle: Obstacle | null }} Known */

/**
 * Whether a walk keeps the room that one level, and all before it, ask for.
 * @typedef {object} RoomLevel
 * @property {LevelName} name
 * @property {Asked[]} asked what it asks for beyond the one before it
 * @property {number} margin that two benches that are not neighbours must keep, m
 * @property {Answer | null} contact when two of them first come nearer than that
 * @property {ObstacleAnswers[]} obstacles
 * @property {Known | null} first what breaks it first, surely if anything does
 * @property {boolean | null} kept null where rounding leaves that open
 * @property {import("./shortage.js").Shortage | null} short of what the pair that breaks it first has too little
 */

/** @type {Record<LevelName, Need[]>} */
const ASKED = {
  benches: [],
  sway: ["sway"],
  imprecision: ["imprecision"],
  people: ["beside", "ahead"],
};

/** What a level is called, in the language in use. @param {LevelName} name */
export function levelName(name) {
  return {
    benches: _("benches alone"),
    sway: _("with sway"),
    imprecision: _("with imprecision"),
    people: _("with people"),
  }[name];
}

/** The levels for which there is something asked for. @param {People} people */
export function levelsAsked(people) {
  const names = /** @type {LevelName[]} */ (Object.keys(ASKED));
  return names.filter((name) => ASKED[name].some((key) => people[key]));
}

/**
 * Find the levels of room that a plan asks for, benches alone first; none if it asks for none.
 *
 * Two benches that each sway, or stray, come nearer by twice that; to what stands still, by once. Each
 * level is searched from the start of the span, s, until the one before it is broken. `bare` is what was
 * found of benches alone.
 * @param {CheckedPlan} plan
 * @param {Walk} walk
 * @param {[number, number]} span
 * @param {{ contact: Answer | null, obstacles: ObstacleAnswers[] }} bare
 * @param {Progress} progress
 * @param {Progress} alive is told that a level is still searched
 * @param {RoomLevel[]} levels to which each is added
 * @returns {Promise<void>}
 */
export function roomLevels(plan, walk, span, bare, progress, alive, levels) {
  return withArenaAsync(walk.engine, async (arena) => {
    const names = levelsAsked(plan.tables.people);
    if (names.length) levels.push(levelOf("benches", [], plan.tables.limits.margin, bare));
    let [each, line] = [0, walk];
    for (const [n, name] of names.entries()) {
      progress(n / names.length, levelName(name));
      const asked = askedOf(plan.tables.people, name);
      if (name === "people") line = withPeople(arena, walk, plan.tables.people);
      else each += asked[0].value;
      const until = untilBroken(levels[levels.length - 1], span);
      const margin = plan.tables.limits.margin + 2 * each;
      const contact = await firstSureContact(line, ...until, { margin, progress: alive });
      const stands = plan.obstacles().map((one) => withMargin(one, one.margin + each));
      const options = { tolerances: ANALYSIS_ROOM.TOLERANCES, progress: alive };
      const obstacles = [];
      for (const one of stands) obstacles.push(await obstacleAnswers(line, one, ...until, options));
      const level = levelOf(name, asked, margin, { contact, obstacles });
      levels.push(measured(level, walk, untilBroken(levels[0], span)[1]));
    }
  });
}

/**
 * @param {LevelName} name
 * @param {Asked[]} asked
 * @param {number} margin
 * @param {{ contact: Answer | null, obstacles: ObstacleAnswers[] }} found
 * @returns {RoomLevel}
 */
function levelOf(name, asked, margin, { contact, obstacles }) {
  const known = knownOf(contact, obstacles);
  const undecided = (/** @type {Known} */ one) => one.contact.status === "undecided";
  /** @type {Known | null} */
  let first = null;
  for (const one of known) {
    const sooner =
      first &&
      (Number(undecided(one)) - Number(undecided(first)) || one.contact.value - first.contact.value);
    if (sooner === null || sooner < 0) first = one;
  }
  const broken = known.some((one) => !undecided(one));
  const kept = broken ? false : known.length ? null : true;
  return { name, asked, margin, contact, obstacles, first, kept, short: null };
}

/** The level with what is missing where it is surely broken, looked at until the end, s. @param {RoomLevel} level @param {Walk} walk @param {number} end @returns {RoomLevel} */
function measured(level, walk, end) {
  const { first, kept, margin } = level;
  if (first === null || kept === null) return level;
  const asked = Object.fromEntries(level.asked.map(({ key, value }) => [key, value]));
  return { ...level, short: shortage(walk, first, margin, asked, end) };
}

/** What breaks a level: contacts of benches, then those with what stands. @param {Answer | null} contact @param {ObstacleAnswers[]} obstacles */
function knownOf(contact, obstacles) {
  /** @type {Known[]} */
  const known = contact === null ? [] : [{ contact, obstacle: null }];
  for (const { contact: met, obstacle } of obstacles)
    if (met !== null) known.push({ contact: met, obstacle });
  return known;
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
  return ASKED[name].flatMap((key) => {
    const value = people[key];
    return value ? [{ key, value, source: people.source?.[key] ?? "" }] : [];
  });
}

/** From the start of a span, s, until a level is surely broken, or to its end. @param {RoomLevel} level @param {[number, number]} span @returns {[number, number]} */
function untilBroken({ contact, obstacles }, [start, end]) {
  const ends = knownOf(contact, obstacles)
    .filter(({ contact: { status } }) => status !== "undecided")
    .map(({ contact: { upper } }) => upper);
  return [start, Math.min(end, ...ends)];
}
