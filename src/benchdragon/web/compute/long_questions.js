// Answers that are searched for, as records that pages take: the models of planner/messages.py.

import { answerOf, answerOrNone } from "../made/records.js";
import { TurnRoute } from "../made/plan_routes.js";
import { withArena } from "./arena.js";
import { within } from "./arrays.js";
import { SOLVE_SIZE } from "./constants.js";
import { greatestHeadSpeed, slowed, withPace } from "./head_speed.js";
import { limit } from "./size.js";
import { bestTurn } from "./turn.js";

/** @typedef {import("../messages").Answer} Answer */
/** @typedef {import("../messages").PaceFound} PaceFound */
/** @typedef {import("../messages").TurnFound} TurnFound */
/** @typedef {import("../messages").TurnShape} TurnShape */
/** @typedef {import("./questions.js").Asked} Asked */

const { QUICK_SIZE } = SOLVE_SIZE;

/** How small or large one size may be. @param {string} name @param {Asked} asked @returns {Promise<Answer>} */
export async function limited(name, asked) {
  const { engine, plan, progress } = asked;
  return answerOf(await limit(engine, plan, name, { tolerance: QUICK_SIZE, progress }), plan);
}

/** How fast the head may walk. @param {Asked} asked @returns {Promise<Answer>} */
export async function headSpeed(asked) {
  const { engine, plan, progress } = asked;
  return answerOf(await greatestHeadSpeed(engine, plan, { progress }), plan);
}

/** A pace that slows down only where it must. @param {Asked} asked @returns {Promise<PaceFound>} */
export async function pace(asked) {
  const { engine, plan, progress } = asked;
  const found = await slowed(engine, plan, { progress });
  const { steady, seconds, saved } = found;
  return {
    plan: withPace(plan, found).data(),
    steady: answerOf(steady, plan),
    seconds,
    saved,
  };
}

/** The best turn. @param {Asked} asked @returns {Promise<TurnFound>} */
export async function turn(asked) {
  const { engine, plan, progress } = asked;
  const found = await bestTurn(engine, plan, {}, { progress });
  return {
    plan: found.plan.data(),
    objective: answerOf(found.objective, plan),
    length: found.length,
    way: found.way,
    way_before: wayOf(asked),
    least_radius: found.turn.least_radius,
    head_speed: answerOrNone(found.headSpeed, plan),
    clearance: answerOf(found.clearance, plan),
    active: found.active,
  };
}

/** The plan's own turn. @param {Asked} asked @returns {TurnShape} */
export function shape({ engine, plan }) {
  return withArena(engine, (arena) => {
    const { length, least_radius } = plan.turn(arena);
    return { length, least_radius };
  });
}

/** The way inside the disc of the plan's own turn, m. @param {Asked} asked */
function wayOf({ engine, plan }) {
  return withArena(engine, (arena) =>
    within(arena, () => plan.turn(arena).way(TurnRoute.disc(plan.tables))),
  );
}
