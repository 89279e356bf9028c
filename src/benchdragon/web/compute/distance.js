// How near benches come to one another: clearance at an instant, over all pairs that count. Twin of
// analysis/distance.py.

import { nearness } from "../made/distance.js";
import { withArena, within } from "./arena.js";
import { BOX } from "./constants.js";

/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./walk.js").Placement} Placement */
/** @typedef {[number, number]} Point */

/**
 * How near two benches are: see `Nearness` there.
 * @typedef {object} Nearness
 * @property {[number, number]} benches their numbers, 1..N, the smaller first
 * @property {number} distance true distance, m; where they overlap, the gap
 * @property {number} gap signed gap by the separating axis theorem, m
 * @property {[Point, Point]} points the point of each bench that is nearest to the other, m
 * @property {[[number, string], [number, string]]} features what meets
 */

/**
 * The rectangles of all benches of placement number `index`, (N, BOX_COLUMNS) of kernels/box.py.
 * @param {Arena} arena which holds them
 * @param {Placement} placed
 * @param {number} [index]
 */
export function boxes(arena, placed, index = 0) {
  if (placed.status[index]) throw placed.failure(index);
  const out = arena.array("d", placed.dragon.benches, BOX.BOX_COLUMNS);
  arena.engine.call("bd_box_boxes_at", placed.dragon.sizes, placed.x, placed.y, index, out);
  return out;
}

/** How near benches i and j (rows, from 0) of a walk are with the head at s, m. @param {import("./walk.js").Walk} walk @param {number} s @param {number} i @param {number} j @returns {Nearness} */
export function nearnessAt(walk, s, i, j) {
  return withArena(walk.engine, (arena) => {
    const table = boxes(arena, walk.placement(arena, [s], { throws: false }));
    return within(arena, () => nearness(table, i, j));
  });
}
