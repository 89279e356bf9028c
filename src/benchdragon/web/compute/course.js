// The route as cubics between nodes: the host of `draw_stretch`, kernels/drawn_route.py, as `course` of
// player/frames.py is.

import { copied, doubles, withArena } from "./arena.js";
import { DRAWN_ROUTE, FOLLOWING } from "./constants.js";
import { rounded } from "./numbers.js";

/** @typedef {import("../made/curves.js").Route} Route */

const MOST_NODES = DRAWN_ROUTE.MOST_STRETCH_NODES;

/**
 * The route from position low to high, m, in cubics within STRETCH_ERROR; x of all nodes first.
 * @param {Route} route
 * @param {number} low
 * @param {number} high
 */
export function course(route, low, high) {
  const { engine, rows } = route;
  const origin = /** @type {[number, number]} */ (route.point(high).map((value) => rounded(value, 3)));
  /** @type {number[][]} */
  const columns = [[], [], []];
  let error = 0;
  const stretches = withArena(engine, (arena) => {
    const [table, joints] = [arena.array("d", 3, MOST_NODES + 1), arena.vector(route.joints)];
    const room = Math.ceil((high - low) / FOLLOWING.LONGEST) + joints.size + 2;
    const [links, at, edges] = [0, 1, room].map((length) => arena.array("d", length));
    const [count] = engine.call("bd_following_find_edges", rows, joints, links, low, high, at, arena.placements(2, 1), edges); // prettier-ignore
    return Array.from(copied(edges).subarray(1, count), (edge, n) => {
      const start = doubles(edges)[n];
      const [nodes, off] = engine.call("bd_drawn_route_draw_stretch", rows, start, edge, ...origin, table); // prettier-ignore
      const first = (/** @type {number} */ k) => k * (MOST_NODES + 1);
      columns.forEach((own, k) => own.push(...doubles(table).subarray(first(k), first(k) + nodes)));
      error = Math.max(error, off);
      return { start, step: (edge - start) / (nodes - 1), nodes };
    });
  });
  return { stretches, origin, nodes: Float32Array.from(columns.flat()), error };
}
