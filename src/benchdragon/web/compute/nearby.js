// Searches near the dance, whatever its coordinates: of analysis/nearby.py what places a walk.

import { doubles, withArena } from "./arena.js";
import { ANALYSIS_NEARBY } from "./constants.js";
import { rint } from "./numbers.js";

/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {[number, number]} Point m */

const { FAR, SPREADS } = ANALYSIS_NEARBY;

/** @type {Point} */
const NOWHERE = [0, 0];

/** From where a walk is searched that begins with its head at s, m, in whole metres. @param {Walk} walk @param {number} s @returns {Point} */
export function originAt(walk, s) {
  const [xs, ys] = withArena(walk.engine, (arena) => {
    const { x, y } = walk.placement(arena, [s], { throws: false });
    return [x, y].map((table) => doubles(table).filter(Number.isFinite));
  });
  if (!xs.length) return NOWHERE;
  const most = (/** @type {Float64Array} */ list) => list.reduce((a, b) => Math.max(a, b));
  const least = (/** @type {Float64Array} */ list) => list.reduce((a, b) => Math.min(a, b));
  const far = Math.max(most(xs), most(ys), -least(xs), -least(ys));
  const spread = Math.max(most(xs) - least(xs), most(ys) - least(ys));
  return far <= Math.max(FAR, SPREADS * spread) ? NOWHERE : [rint(xs[0]), rint(ys[0])];
}

/** Throw a WalkError if the dragon cannot stand at a time, s. @param {Walk} walk @param {number} time */
export function mustStand(walk, time) {
  withArena(walk.engine, (arena) => walk.motion(arena, [time]));
}
