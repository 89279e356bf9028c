// What the planner's Worker answers: a table from the name of a question to the function for it.

import { TomlError, parse, stringify } from "../carried.js";
import { occasionsFound, tighten } from "../made/occasions.js";
import { verdictOf } from "../made/records.js";
import { _ } from "../words.js";
import { annex } from "./annex.js";
import { withArenaAsync } from "./arena.js";
import { briefing, ways } from "./briefing.js";
import { check } from "./check.js";
import { PLANS_TOML } from "./constants.js";
import { PlanError } from "./errors.js";
import { headSpeed, limited, margins, pace, shape, turn } from "./long_questions.js";
import { checked } from "./plan.js";
import { placed, proposed } from "./proposals.js";
import { SKETCH, danceOf } from "./scene.js";

/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("../messages").Verdict} Verdict */

/**
 * A question, and what its answer is made with.
 * @typedef {object} Asked
 * @property {Engine} engine
 * @property {string} version of the program
 * @property {Plan} plan there is none of questions about wishes
 * @property {Record<string, any>} [wishes]
 * @property {Verdict | null} [verdict] on the plan, where a question takes what is known of it
 * @property {Progress} progress
 */

const SIZES = ["pitch", "disc", "width", "length"];

/** Questions about a plan. @type {Record<string, (asked: Asked) => unknown>} */
export const QUESTIONS = {
  toml: ({ plan }) => stringify(plan.own()),
  verdict: judged,
  shape,
  sketch: (asked) => danced(asked, SKETCH),
  dance: (asked) => danced(asked),
  ...Object.fromEntries(
    SIZES.map((name) => [`limit/${name}`, (/** @type {Asked} */ asked) => limited(name, asked)]),
  ),
  "job/turn": turn,
  "job/speed": headSpeed,
  "job/pace": pace,
  "job/margins": margins,
  annex,
  sheets: briefing,
  ways,
  propose: proposed,
  place: placed,
};

/** Whether the walk is safe. @param {Asked} asked */
function judged({ engine, plan, progress }) {
  return withArenaAsync(engine, async (arena) => {
    const walk = plan.build(arena);
    const own = /** @type {any} */ (plan);
    return verdictOf(await check(own, walk, plan.span(walk), { progress }));
  });
}

/** The dance as the player shows it; one that cannot be walked to its end as far as it can. @param {Asked} asked @param {Partial<import("./scene.js").Shown>} [shown] how carefully */
async function danced({ engine, version, plan, verdict, progress }, shown = {}) {
  const { sent, ...lists } = await danceOf(engine, plan, shown, progress);
  const told = { ...lists, sent: { ...sent, version } };
  return verdict ? judgedDance(told, verdict, plan.obstacles()) : told;
}

/**
 * The dance with what happens when, and its tightest pair, as a check found them. The verdict itself the page
 * has from elsewhere.
 * @param {import("./scene.js").Unpacked} dance of the same plan
 * @param {Verdict} verdict
 * @param {import("./obstacle.js").Obstacle[]} obstacles those of the plan
 */
export function judgedDance({ sent, ...lists }, verdict, obstacles) {
  const { frames, nearest, margin, speed_limit: limit } = sent;
  const last = frames.start + frames.step * (frames.count - 1);
  /** @type {import("../messages").Occasion[]} */
  const seen = occasionsFound(verdict, obstacles, margin, limit);
  const found = seen.filter(({ time }) => frames.start <= time && time <= last);
  tighten(nearest, verdict.clearance, frames.start, last);
  const occasions = [...found, ...sent.occasions].sort((a, b) => a.time - b.time);
  return { ...lists, sent: { ...sent, occasions } };
}

/** The plan in the text of a plan file, with every key. @param {string} text */
export function openedPlan(text) {
  return checked(parsed(text)).data();
}

/** The tables in the text of a plan file. @param {string} text */
function parsed(text) {
  const { MOST_KEYS, MOST_ENTRIES } = PLANS_TOML;
  if (countOf(text, /[=[{]/g) > MOST_KEYS || countOf(text, /,/g) > MOST_ENTRIES)
    throw new PlanError(
      _("{source} is too long for a plan: at most {keys} keys and {entries} entries are read", {
        source: "plan",
        keys: MOST_KEYS,
        entries: MOST_ENTRIES,
      }),
    );
  try {
    return parse(text.replace(/^\ufeff/, ""));
  } catch (error) {
    if (!(error instanceof TomlError)) throw error;
    const values = { line: error.line, column: error.column, fault: whyUnread(error, text) };
    const fault = _("line {line}, column {column}: {fault}", values);
    throw new PlanError(_("{source} is not TOML: {fault}", { source: "plan", fault }));
  }
}

/** Why a text is not TOML: that a table is there twice is what befalls those who add lines to a plan. @param {TomlError} error @param {string} text */
function whyUnread(error, text) {
  const table = /^\s*\[([^[\]]+)\]/.exec(text.split("\n")[error.line - 1] ?? "");
  if (!table || !/redefine/.test(error.message)) return _("this cannot be read");
  const what = table[1].replaceAll(/["'\s]/g, "");
  return _("[{what}] is defined twice: delete this line, and move its keys below the first [{what}]", {
    what,
  });
}

/** How often a sign stands in a text. @param {string} text @param {RegExp} sign */
function countOf(text, sign) {
  let count = 0;
  for (const _found of text.matchAll(sign)) count++;
  return count;
}
