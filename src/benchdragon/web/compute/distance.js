// How near benches come to one another: clearance at an instant, over all pairs that count. Twin of
// analysis/distance.py.

import { Arena, doubles, withArena, wholes } from "./arena.js";
import { ANALYSIS_DISTANCE, BOX, GRID, SPIRAL } from "./constants.js";
import { firstRows } from "./lists.js";
import { emptyGrid } from "./tables.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./walk.js").Placement} Placement */
/** @typedef {import("./walk.js").Walk} Walk */
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
const ENDS = ["front", "rear"];
const FLANKS = ["left", "right"];
// Reach, m, within which the tightest pairs are first looked for.
const FIRST_LOOK = 0.25;

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

/**
 * How near the benches in rows i and j of `boxes` are.
 * @param {Engine} engine
 * @param {Numbers} table
 * @param {number} i @param {number} j
 * @returns {Nearness}
 */
export function nearness(engine, table, i, j) {
  const [distance] = engine.call("bd_box_box_distance", table, i, j);
  const [gap] = engine.call("bd_box_box_gap", table, i, j);
  const [mine, which] = engine.call("bd_box_nearest_corner", table, i, j);
  const [owner, other] = mine ? [i, j] : [j, i];
  const [x, y] = engine.call("bd_box_corner", table, owner, which);
  const [point, feature] = foot(engine, table, other, x, y);
  /** @type {Point} */
  const corner = [x, y];
  const here = distance <= 0 ? corner : point;
  const ordered = Boolean(mine) === i < j;
  return {
    benches: [Math.min(i, j) + 1, Math.max(i, j) + 1],
    distance,
    gap,
    points: ordered ? [corner, here] : [here, corner],
    features: [
      [owner + 1, CORNERS[which]],
      [other + 1, feature],
    ],
  };
}

/**
 * The point of box j nearest to (x, y), and whether it lies on a side or at a corner.
 * @param {Engine} engine
 * @param {Numbers} table
 * @param {number} j @param {number} x @param {number} y
 * @returns {[Point, string]}
 */
function foot(engine, table, j, x, y) {
  const [along, across] = engine.call("bd_box_offset", table, j, x, y);
  const box = doubles(table).subarray(j * BOX.BOX_COLUMNS, (j + 1) * BOX.BOX_COLUMNS);
  const [half, wide] = [box[BOX.HALF_LENGTH], box[BOX.HALF_WIDTH]];
  const a = Math.min(Math.max(along, -half), half);
  const b = Math.min(Math.max(across, -wide), wide);
  const [ux, uy] = [box[BOX.UX], box[BOX.UY]];
  /** @type {Point} */
  const point = [box[BOX.CX] + a * ux - b * uy, box[BOX.CY] + a * uy + b * ux];
  const [end, flank] = [ENDS[Number(along < 0)], FLANKS[Number(across < 0)]];
  if (Math.abs(along) > half && Math.abs(across) > wide) return [point, `${end} ${flank}`];
  return [point, Math.abs(along) - half > Math.abs(across) - wide ? end : flank];
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

/** To so many decimals as count where pairs are put in order, as a whole number. @param {number} distance */
function rounded(distance) {
  const scaled = distance * 10 ** ANALYSIS_DISTANCE.TIE;
  const up = 2 ** 52 * Math.sign(scaled);
  return Math.abs(scaled) < 2 ** 52 ? scaled + up - up : scaled;
}

/**
 * The `count` pairs of benches with the smallest distance at time number `index`, tightest first.
 *
 * Neighbours do not count. Fewer come back where the dragon has fewer pairs. Equal distances come in the
 * order of the benches.
 * @param {Placement} placed
 * @param {number} [index]
 * @param {number} [count]
 * @returns {Nearness[]}
 */
export function tightestPairs(placed, index = 0, count = 1) {
  const { engine } = placed.arena;
  return withArena(engine, (arena) => {
    const table = boxes(arena, placed, index);
    const benches = table.shape[0];
    const wanted = Math.min(count, ((benches - 1) * (benches - 2)) / 2);
    let reach = FIRST_LOOK;
    /** @type {Array<[number, number, number]>} */
    let known = [];
    for (;;) {
      known = distancesOf(table, reach, engine);
      if (known.filter(([, , distance]) => distance <= reach).length >= wanted) break;
      reach *= 2;
    }
    known.sort(([i, j, d], [k, l, e]) => rounded(d) - rounded(e) || i - k || j - l);
    return known.slice(0, wanted).map(([i, j]) => nearness(engine, table, i, j));
  });
}

/**
 * The pairs within reach, m, and more, each with its distance, m.
 * @param {Numbers} table
 * @param {number} reach
 * @param {Engine} engine
 * @returns {Array<[number, number, number]>}
 */
function distancesOf(table, reach, engine) {
  return withArena(engine, (arena) => {
    const pairs = pairsWithin(arena, table, reach);
    const [first, second] = [0, 1].map((n) => arena.whole(pairs.map((pair) => pair[n])));
    const [gap, distance] = [arena.array("d", pairs.length), arena.array("d", pairs.length)];
    engine.call("bd_box_pair_distances", table, first, second, gap, distance);
    const apart = doubles(distance);
    return pairs.map(([i, j], p) => [i, j, apart[p]]);
  });
}

/**
 * A low distance with the head between first and last, m; where, and of which benches (rows).
 *
 * It is looked for at some head positions, and about the least of them: a hint, no bound. Minus a depth
 * inside; infinite where the dragon stands nowhere.
 * @param {Walk} walk
 * @param {number} first @param {number} last
 */
export function lowPair({ engine, route, dragon }, first, last) {
  return withArena(engine, (arena) =>
    engine.call(
      "bd_low_points_low_pair", route.rows, dragon.links, dragon.sizes, first, last,
      arena.array("d", SPIRAL.LANES), arena.placements(dragon.benches + 1, SPIRAL.LANES),
      arena.array("d", 2, BOX.BOX_COLUMNS),
    ),
  ); // prettier-ignore
}
