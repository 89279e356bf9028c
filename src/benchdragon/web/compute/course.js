// The route as cubics between nodes: the host of `draw_stretch`, kernels/drawn_route.py, as `course` of
// player/frames.py is.

import { doubles, withArena } from "./arena.js";
import { DRAWN_ROUTE, PLAYER_FRAMES } from "./constants.js";
import { linspace, rounded } from "./numbers.js";

/** @typedef {import("../made/curves.js").Route} Route */

const { MOST_NODES } = DRAWN_ROUTE;

/** Borders, m, with more of them evenly in between, so that none are farther apart than that. @param {number[]} borders @param {number} longest */
export function spread([first, ...others], longest) {
  const edges = [first];
  for (const border of others) {
    const before = edges[edges.length - 1];
    const parts = Math.max(Math.ceil((border - before) / longest), 1);
    edges.push(...linspace(before, border, parts + 1).subarray(1));
  }
  return edges;
}

/**
 * The route from position low to high, m, in cubics within STRETCH_ERROR; x of all nodes first.
 * @param {Route} route
 * @param {number} low
 * @param {number} high
 */
export function course(route, low, high) {
  const joints = Array.from(route.joints).filter((joint) => low < joint && joint < high);
  const edges = spread([low, ...joints, high], PLAYER_FRAMES.STRETCH);
  const origin = /** @type {[number, number]} */ (route.point(high).map((value) => rounded(value, 3)));
  /** @type {number[][]} */
  const columns = [[], [], []];
  let error = 0;
  const stretches = withArena(route.engine, (arena) => {
    const table = arena.array("d", 3, MOST_NODES + 1);
    return edges.slice(1).map((edge, n) => {
      const [nodes, off] = route.engine.call("bd_drawn_route_draw_stretch", route.rows, edges[n], edge, ...origin, table); // prettier-ignore
      const at = (/** @type {number} */ k) => k * (MOST_NODES + 1);
      columns.forEach((own, k) => own.push(...doubles(table).subarray(at(k), at(k) + nodes)));
      error = Math.max(error, off);
      return { start: edges[n], step: (edge - edges[n]) / (nodes - 1), nodes };
    });
  });
  return { stretches, origin, nodes: Float32Array.from(columns.flat()), error };
}
