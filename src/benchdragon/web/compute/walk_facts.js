// What sentences of a check rest on, of a walk: what in analysis/findings.py, not_looked_at.py and
// unfinished.py computes with arrays.

import { Unfinished } from "../made/unfinished.js";
import { doubles, withArena } from "./arena.js";
import { ANALYSIS_NOT_LOOKED_AT, ANALYSIS_UNFINISHED, CURVE, PLANS_ROUTES } from "./constants.js";
import { stretchesOf } from "./stretches.js";

/** @typedef {import("./plan.js").Plan} CheckedPlan */
/** @typedef {import("./walk.js").Walk} Walk */

const { RUN_UP } = PLANS_ROUTES;

/** By how much the head changes its speed at most, m/s^2, and from when on, s. @param {Walk} walk @param {[number, number]} span */
export function steepest(walk, [start, end]) {
  const stretches = stretchesOf(walk.profile, start, end);
  const value = stretches.reduce((most, { rate }) => Math.max(most, Math.abs(rate)), 0);
  const found = stretches.find(({ rate }) => Math.abs(rate) === value);
  return [value, found ? found.times[0] : start];
}

/** How long the dragon is from its first handle to its last, m. @param {Walk} walk */
export function extent({ dragon }) {
  return dragon.extent;
}

/** Whether a straight line that the plan does not draw leads to the start of the route. @param {Walk} walk */
export function runsOn({ route }) {
  return doubles(route.rows)[CURVE.U_BACK] === -Infinity;
}

/** Where on the route begins what the plan gives, m: after the line before a drawn bend. @param {CheckedPlan} plan @param {Walk} walk */
export function givenFrom({ tables: { route } }, walk) {
  const drawn = route.kind === "drawn" && !route.closed;
  const begun = drawn && Math.abs(walk.route.joints[1] - RUN_UP) < ANALYSIS_NOT_LOOKED_AT.DUST;
  return begun ? RUN_UP : 0;
}

/** Where along the route each handle is at times, s, in m. @param {Walk} walk @param {number[]} times */
export function places(walk, ...times) {
  return withArena(walk.engine, (arena) =>
    times.map((time) => [...doubles(walk.motion(arena, [time], { throws: false }).s)]),
  );
}

/** What a plan's walk in and out again lacks when it ends at a time, s; null where it lacks nothing. @param {CheckedPlan} plan @param {Walk} walk @param {number} end */
export function unfinished({ tables }, walk, end) {
  const { NEARLY, TENTHS, DUST } = ANALYSIS_UNFINISHED;
  if (tables.route.kind !== "turn") return null;
  const last = tables.route.last_position(walk);
  const way = last - walk.headPosition(end);
  if (way <= NEARLY) return null;
  const time = walk.time_at(last);
  const enough = last < walk.route.length && Number.isFinite(time);
  return new Unfinished(way, enough ? Math.ceil(TENTHS * time - DUST) / TENTHS : null);
}
