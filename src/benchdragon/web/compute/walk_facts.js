// What sentences of a check rest on, of a walk: what in analysis/not_looked_at.py computes with arrays.

import { doubles, withArena } from "./arena.js";
import { ANALYSIS_NOT_LOOKED_AT, PLANS_ROUTES, RouteRow } from "./constants.js";

/** @typedef {import("./plan.js").Plan} CheckedPlan */
/** @typedef {import("./walk.js").Walk} Walk */

const { RUN_UP } = PLANS_ROUTES;

/** Whether a straight line that the plan does not draw leads to the start of the route. @param {Walk} walk */
export function runsOn({ route }) {
  return doubles(route.rows)[RouteRow.U_BACK] === -Infinity;
}

/** Where on the route begins what the plan gives, m: after the line before a drawn bend. @param {CheckedPlan} plan @param {Walk} walk */
export function givenFrom({ route }, walk) {
  const drawn = route.street || (route.kind === "drawn" && !route.closed);
  const begun = drawn && Math.abs(walk.route.joints[1] - RUN_UP) < ANALYSIS_NOT_LOOKED_AT.DUST;
  return begun ? RUN_UP : 0;
}

/** Where along the route each handle is at times, s, in m. @param {Walk} walk @param {number[]} times */
export function places(walk, ...times) {
  return withArena(walk.engine, (arena) =>
    times.map((time) => [...doubles(walk.motion(arena, [time], { throws: false }).s)]),
  );
}
