// How near benches come to one another: clearance at an instant, over all pairs that count. Twin of
// analysis/distance.py.

import { doubles, withArena, wholes } from "./arena.js";
import { BOX, GRID, NEARNESS } from "./constants.js";
import { firstRows } from "./lists.js";
import { emptyGrid } from "./tables.js";

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

/**
 * Rows of all pairs that are not neighbours and may be within `reach` metres: a superset.
 * @param {Arena} arena
 * @param {Numbers} table
 * @param {number} reach m
 * @returns {Array<[number, number]>}
 */
export function pairsWithin(arena, table, reach) {
  const [view, count] = [doubles(table), table.shape[0]];
  const column = (/** @type {number} */ c) =>
    Float64Array.from({ length: count }, (_row, i) => view[i * BOX.BOX_COLUMNS + c]);
  const [x, y, half, wide] = [BOX.CX, BOX.CY, BOX.HALF_LENGTH, BOX.HALF_WIDTH].map(column);
  const radius = half.map((length, i) => Math.hypot(length, wide[i]));
  const widest = radius.reduce((a, b) => Math.max(a, b));
  const places = arena.array("d", count, 2);
  const middles = doubles(places);
  for (let i = 0; i < count; i++) [middles[2 * i], middles[2 * i + 1]] = [x[i], y[i]];
  const grid = emptyGrid(arena, count, widest + reach);
  arena.engine.call("bd_grid_put_known", grid, places);
  const near = pairsNear(arena, grid, places, places, 0, 2 * widest + reach);
  return near.filter(
    ([i, j]) => j - i >= 2 && Math.hypot(x[i] - x[j], y[i] - y[j]) <= radius[i] + radius[j] + reach,
  );
}

/**
 * Pairs of places, from number `start` on, and others that are within reach: `grid.pairs_near`.
 * @param {Arena} arena
 * @param {ReturnType<typeof emptyGrid>} grid
 * @param {Numbers} others @param {Numbers} places
 * @param {number} start @param {number} reach
 * @returns {Array<[number, number]>}
 */
function pairsNear(arena, grid, others, places, start, reach) {
  const found = arena.array("q", others.shape[0]);
  let most = Math.min(GRID.PAIRS_A_PLACE * (places.shape[0] - start), GRID.PAIRS_AT_FIRST);
  for (;;) {
    const [first, second] = [arena.array("q", most), arena.array("q", most)];
    const [count] = arena.engine.call(
      "bd_grid_pairs_within", grid, others, places, start, reach, found, first, second,
    ); // prettier-ignore
    if (count <= most) {
      const [i, j] = [first, second].map((list) => wholes(firstRows(list, count)));
      return i.map((one, n) => [one, j[n]]);
    }
    most = count;
  }
}
