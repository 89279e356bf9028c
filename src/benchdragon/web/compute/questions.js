// What the planner's Worker answers: a table from the name of a question to the function for it.

import { TomlError, parse, stringify } from "../carried.js";
import { _ } from "../words.js";
import { withArenaAsync } from "./arena.js";
import { check } from "./check.js";
import { PlanError, WalkError } from "./errors.js";
import { judgedDance } from "./judged.js";
import { headSpeed, limited, margins, pace, turn } from "./long_questions.js";
import { checkedPlan } from "./plan.js";
import { verdictOf } from "./records.js";
import { danceOf } from "./scene.js";

/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("../engine.js").Engine} Engine */

/**
 * A question, and what its answer is made with.
 * @typedef {object} Asked
 * @property {Engine} engine
 * @property {string} version of the program
 * @property {Plan} plan
 * @property {Progress} progress
 */

const SIZES = ["pitch", "disc", "width", "length"];

/** Questions about a plan. @type {Record<string, (asked: Asked) => unknown>} */
export const QUESTIONS = {
  toml: ({ plan }) => stringify(plan.written()),
  verdict: judged,
  dance: danced,
  ...Object.fromEntries(
    SIZES.map((name) => [`limit/${name}`, (/** @type {Asked} */ asked) => limited(name, asked)]),
  ),
  "job/turn": turn,
  "job/speed": headSpeed,
  "job/pace": pace,
  "job/margins": margins,
};

/** What the quick check finds. @param {Asked} asked */
function checked({ engine, plan, progress }) {
  return withArenaAsync(engine, async (arena) => {
    const walk = plan.build(arena);
    const own = /** @type {any} */ (plan);
    return check(own, walk, plan.span(walk), { quick: true, progress });
  });
}

/** Whether the walk is safe. @param {Asked} asked */
async function judged(asked) {
  return verdictOf(await checked(asked), asked.version);
}

/** The dance as the player shows it; one that cannot be walked to its end as far as it can. @param {Asked} asked */
async function danced(asked) {
  const { engine, version, plan, progress } = asked;
  const dance = await danceOf(engine, plan, {}, progress);
  const told = { ...dance, sent: { ...dance.sent, version } };
  try {
    const shown = judgedDance(told, await checked(asked), version);
    return { ...shown, sent: { ...shown.sent, verdict: null } }; // which the page has from elsewhere
  } catch (error) {
    if (error instanceof WalkError) return told;
    throw error;
  }
}

/** The plan in the text of a plan file, with every key. @param {string} text */
export function openedPlan(text) {
  return checkedPlan(parsed(text)).data();
}

/** The tables in the text of a plan file. @param {string} text */
function parsed(text) {
  try {
    return parse(text.replace(/^\ufeff/, ""));
  } catch (error) {
    if (!(error instanceof TomlError)) throw error;
    const unread = _("this cannot be read");
    const values = { line: error.line, column: error.column, fault: unread };
    const fault = _("line {line}, column {column}: {fault}", values);
    throw new PlanError(_("{source} is not TOML: {fault}", { source: "plan", fault }));
  }
}
