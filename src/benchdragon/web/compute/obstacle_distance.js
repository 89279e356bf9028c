// How far benches stand from an obstacle at one placement. Twin of analysis/obstacle_distance.py.

import { doubles, wholes } from "./arena.js";
import { BOX } from "./constants.js";
import { boxes } from "./distance.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("./walk.js").Placement} Placement */

/**
 * How far each box of benches is from the nearest of an obstacle's boxes, m; which box.
 *
 * An obstacle's radius lies within, and whether a bench stands where none may is not asked.
 * @param {Arena} arena
 * @param {Numbers} table boxes of benches, (N, BOX_COLUMNS) of kernels/box.py
 * @param {Numbers} standing those of the obstacle
 */
export function nearestBoxes(arena, table, standing) {
  const [count] = table.shape;
  const [out, which] = [arena.array("d", count), arena.array("q", count)];
  const near = arena.array("d", 2, BOX.BOX_COLUMNS);
  arena.engine.call("bd_standing_distances_to", table, standing, near, out, which);
  return { apart: doubles(out).slice(), which: wholes(which) };
}

/**
 * How far each bench is from an obstacle's boxes at one placement, m; which box. Minus infinity where a
 * bench stands where none may.
 * @param {Arena} arena
 * @param {Placement} placed
 * @param {Obstacle} obstacle
 * @param {Numbers} standing its boxes
 */
export function boxDistances(arena, placed, obstacle, standing) {
  const table = boxes(arena, placed);
  const { apart, which } = nearestBoxes(arena, table, standing);
  const view = doubles(table);
  apart.forEach((_distance, i) => {
    const at = i * BOX.BOX_COLUMNS;
    if (obstacle.forbids([view[at + BOX.CX], view[at + BOX.CY]])) apart[i] = -Infinity;
  });
  return { apart, which };
}
