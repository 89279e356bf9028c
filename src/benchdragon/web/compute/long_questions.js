// Answers that are searched for, as records that pages take: the models of planner/messages.py.

import { answerOf, answerOrNone } from "../made/records.js";
import { bestTurn } from "../made/best_turn.js";
import { greatestHeadSpeed, slowed, withPace } from "../made/head_speed.js";
import { TurnRoute } from "../made/plan_routes.js";
import { withArena, withArenaAsync } from "./arena.js";
import { SOLVE_SIZE } from "./constants.js";
import { limit } from "./size.js";

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
export function headSpeed({ engine, plan, progress }) {
  return withArenaAsync(engine, async () =>
    answerOf(await greatestHeadSpeed(plan, undefined, progress), plan),
  );
}

/** A pace that slows down only where it must. @param {Asked} asked @returns {Promise<PaceFound>} */
export function pace({ engine, plan, progress }) {
  return withArenaAsync(engine, async () => {
    const found = await slowed(plan, progress);
    const { steady, seconds, saved } = found;
    return { plan: withPace(plan, found).data(), steady: answerOf(steady, plan), seconds, saved };
  });
}

/** The best turn. @param {Asked} asked @returns {Promise<TurnFound>} */
export function turn({ engine, plan, progress }) {
  return withArenaAsync(engine, async (arena) => {
    const wayBefore = plan.ownTurn(arena).way(TurnRoute.disc(plan.tables));
    const found = await bestTurn(plan, undefined, progress);
    return {
      plan: found.plan.data(),
      objective: answerOf(found.objective, plan),
      length: found.length,
      way: found.way,
      way_before: wayBefore,
      least_radius: found.turn.least_radius,
      head_speed: answerOrNone(found.head_speed, plan),
      clearance: answerOf(found.clearance, plan),
      active: found.active,
    };
  });
}

/** The plan's own turn. @param {Asked} asked @returns {TurnShape} */
export function shape({ engine, plan }) {
  return withArena(engine, (arena) => {
    const { length, least_radius } = plan.ownTurn(arena);
    return { length, least_radius };
  });
}
