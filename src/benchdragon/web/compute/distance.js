// How near benches come to one another: clearance at an instant, over all pairs that count. Twin of
// analysis/distance.py.

import { doubles, withArena } from "./arena.js";
import { BOX, NEARNESS } from "./constants.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("../engine.js").Numbers} Numbers */
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

export const CORNERS = ["front left", "rear left", "rear right", "front right"];
// What of a bench may meet: see kernels/nearness.py.
export const FEATURES = [
  "front",
  "rear",
  "left",
  "right",
  CORNERS[0],
  CORNERS[3],
  CORNERS[1],
  CORNERS[2],
];

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

/** How near the benches in rows i and j of `boxes` are. @param {Engine} engine @param {Numbers} table @param {number} i @param {number} j */
export function nearness(engine, table, i, j) {
  return withArena(engine, (arena) => {
    const row = arena.array("d", NEARNESS.NEARNESS);
    engine.call("bd_nearness_nearness", table, i, j, row);
    return nearnessOf(doubles(row));
  });
}

/** What a row of kernels/nearness.py tells. @param {Float64Array} row @returns {Nearness} */
export function nearnessOf(row) {
  const [first, second, distance, gap, x, y, thereX, thereY, owner, corner, other, feature] = row;
  return {
    benches: [first + 1, second + 1],
    distance,
    gap,
    points: [[x, y], [thereX, thereY]],
    features: [[owner + 1, CORNERS[corner]], [other + 1, FEATURES[feature]]],
  }; // prettier-ignore
}
