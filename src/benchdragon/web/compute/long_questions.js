// Answers that are searched for, as records that pages take: twins of `limited`, `best`, `head_speed` and
// `paced` in studio/tasks.py.

import { withArena } from "./arena.js";
import { greatestHeadSpeed, slowed, withPace } from "./head_speed.js";
import { discOf, turnOf } from "./plan_routes.js";
import { answerOf } from "./records.js";
import { limit } from "./size.js";
import { bestTurn } from "./turn.js";

/** @typedef {import("../messages").Answer} Answer */
/** @typedef {import("../messages").PaceFound} PaceFound */
/** @typedef {import("../messages").TurnFound} TurnFound */
/** @typedef {import("./questions.js").Asked} Asked */

/** How wide the bracket of a size may be, m, while its slider is dragged. */
const SIZE = 1e-5;

/** What all answers about a plan carry. @param {Asked} asked */
function stampOf({ plan, version }) {
  return { plan_sha256: plan.sha256, version };
}

/** How small or large one size may be. @param {string} name @param {Asked} asked @returns {Promise<Answer>} */
export async function limited(name, asked) {
  const { engine, plan, progress } = asked;
  return answerOf(await limit(engine, plan, name, { tolerance: SIZE, progress }), stampOf(asked));
}

/** How fast the head may walk. @param {Asked} asked @returns {Promise<Answer>} */
export async function headSpeed(asked) {
  const { engine, plan, progress } = asked;
  return answerOf(await greatestHeadSpeed(engine, plan, { progress }), stampOf(asked));
}

/** A pace that slows down only where it must. @param {Asked} asked @returns {Promise<PaceFound>} */
export async function pace(asked) {
  const { engine, plan, progress } = asked;
  const found = await slowed(engine, plan, { progress });
  const { steady, seconds, saved } = found;
  return {
    plan: withPace(plan, found).data(),
    steady: answerOf(steady, stampOf(asked)),
    seconds,
    saved,
  };
}

/** The best turn. @param {Asked} asked @returns {Promise<TurnFound>} */
export async function turn(asked) {
  const { engine, plan, progress } = asked;
  const found = await bestTurn(engine, plan, {}, { progress });
  const stamp = stampOf(asked);
  return {
    plan: found.plan.data(),
    objective: answerOf(found.objective, stamp),
    length: found.length,
    way: found.way,
    way_before: wayOf(asked),
    least_radius: found.turn.leastRadius,
    head_speed: found.headSpeed && answerOf(found.headSpeed, stamp),
    clearance: answerOf(found.clearance, stamp),
    active: found.active,
  };
}

/** The way inside the disc of the plan's own turn, m. @param {Asked} asked */
function wayOf({ engine, plan: { tables } }) {
  return withArena(engine, (arena) => turnOf(arena, tables, null).way(discOf(tables)));
}
