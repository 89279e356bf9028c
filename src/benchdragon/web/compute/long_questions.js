// Answers that are searched for, as records that pages take: the models of planner/messages.py.

import { finiteOrNone } from "../made/number_format.js";
import { answerOf, answerOrNone } from "../made/records.js";
import { foundLimit } from "../made/size.js";
import { part } from "../made/stages.js";
import {
  ALL,
  Deviations,
  Draw,
  RISKS,
  Tolerance,
  exactPitch,
  neededPitch,
  touches,
} from "../made/tolerance.js";
import { _ } from "../words.js";
import { bestTurn } from "../made/best_turn.js";
import { greatestHeadSpeed, slowed, withPace } from "../made/head_speed.js";
import { TurnRoute } from "../made/plan_routes.js";
import { withArena, withArenaAsync } from "./arena.js";
import { SOLVE_SIZE } from "./constants.js";

/** @typedef {import("../messages").Answer} Answer */
/** @typedef {import("../messages").PaceFound} PaceFound */
/** @typedef {import("../messages").TurnFound} TurnFound */
/** @typedef {import("../messages").TurnShape} TurnShape */
/** @typedef {import("./questions.js").Asked} Asked */

const { QUICK_SIZE } = SOLVE_SIZE;
/** How many random dances are walked. */
const DRAWS = 100;

/** How small or large one size may be. @param {string} name @param {Asked} asked @returns {Promise<Answer>} */
export function limited(name, { engine, plan, progress }) {
  return withArenaAsync(engine, async () =>
    answerOf(await foundLimit(plan, name, undefined, QUICK_SIZE, progress), plan),
  );
}

/** How much room imprecise people need, with all deviations together. @param {Asked} asked @returns {Promise<import("../messages").MarginsFound>} */
export function margins({ engine, plan, progress }) {
  return withArenaAsync(engine, async () => {
    const found = await tolerance(plan, ALL, DRAWS, 1, part(progress, 0, 1, _("random dances")));
    const [share, lower, upper] = found.touching();
    return {
      draws: DRAWS,
      exact: finiteOrNone(found.exact),
      pitch: plan.value("route.pitch"),
      chance: share,
      chance_lower: lower,
      chance_upper: upper,
      pitch_for: RISKS.map((risk) => ({ risk, pitch: finiteOrNone(found.pitch_for(risk)) })),
    };
  });
}

/**
 * What so many random dances need: `tolerance` of solve/tolerance.py, one after another.
 * @param {import("./plan.js").Plan} plan
 * @param {number[]} by how far from exact they are
 * @param {number} draws
 * @param {number} seed
 * @param {(share: number, text: string) => void} progress
 */
export async function tolerance(plan, by, draws, seed, progress) {
  const deviations = new Deviations(...by);
  const exact = await exactPitch(plan, () => progress(0, ""));
  const needed = [];
  let hits = 0;
  for (let number = 0; number < draws; number++) {
    progress(number / draws, "");
    const draw = new Draw(deviations, seed, number);
    needed.push(await neededPitch(plan, draw, exact));
    hits += Number(await touches(plan, draw));
  }
  progress(1, "");
  needed.sort((a, b) => a - b);
  return new Tolerance(deviations, seed, exact, needed, hits);
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
    const wayBefore = plan.ownTurn(arena).way(TurnRoute.disc(plan));
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
