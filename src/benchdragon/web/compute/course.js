// The route as cubics between nodes: twin of `course` in player/frames.py.

import { PLAYER_FRAMES } from "./constants.js";
import { linspace, rounded, unwrapped } from "./numbers.js";

/** @typedef {import("./curves.js").Route} Route */

/**
 * Nodes of one stretch of the route: x, y (m, from the origin) and heading, one list after another.
 * @typedef {{ start: number, step: number, nodes: Float32Array, error: number }} Stretched
 */

/** @typedef {[number, number]} Point */

/**
 * The route from position low to high, m, in cubics within STRETCH_ERROR.
 * @param {Route} route
 * @param {number} low
 * @param {number} high
 */
export function course(route, low, high) {
  const joints = Array.from(route.joints).filter((joint) => low < joint && joint < high);
  const edges = [low];
  for (const border of [...joints, high]) {
    const before = edges[edges.length - 1];
    const parts = Math.max(Math.ceil((border - before) / PLAYER_FRAMES.STRETCH), 1);
    edges.push(...linspace(before, border, parts + 1).subarray(1));
  }
  const [x, y] = route.point(high);
  /** @type {Point} */
  const origin = [rounded(x, 3), rounded(y, 3)];
  const found = edges.slice(1).map((edge, n) => stretched(route, edges[n], edge, origin));
  return {
    stretches: found.map(({ start, step, nodes }) => ({ start, step, nodes: nodes.length / 3 })),
    origin,
    nodes: joinedNodes(found),
    error: found.reduce((worst, { error }) => Math.max(worst, error), 0),
  };
}

/** Nodes of all stretches: x of all first. @param {Stretched[]} found */
function joinedNodes(found) {
  const count = found.reduce((sum, { nodes }) => sum + nodes.length / 3, 0);
  const all = new Float32Array(3 * count);
  let at = 0;
  for (const { nodes } of found) {
    const own = nodes.length / 3;
    for (let k = 0; k < 3; k++) all.set(nodes.subarray(k * own, (k + 1) * own), k * count + at);
    at += own;
  }
  return all;
}

/**
 * One stretch with as many nodes as its cubics need.
 * @param {Route} route
 * @param {number} low
 * @param {number} high
 * @param {Point} origin
 * @returns {Stretched}
 */
function stretched(route, low, high, origin) {
  const inside = (high - low) * 1e-9; // headings at a joint are those of this side
  for (let count = 2; ; count = 2 * count - 1) {
    const exact = route.evaluate(linspace(low + inside, high - inside, count));
    const headings = unwrapped(exact.filter((_value, i) => i % 4 === 2));
    const nodes = new Float32Array(3 * count);
    for (let n = 0; n < count; n++) {
      nodes[n] = exact[4 * n] - origin[0];
      nodes[count + n] = exact[4 * n + 1] - origin[1];
      nodes[2 * count + n] = headings[n];
    }
    const step = (high - low) / (count - 1);
    const error = courseError(route, { start: low, step, nodes, error: 0 }, high, origin);
    if (error <= PLAYER_FRAMES.STRETCH_ERROR || count > 4096) return { start: low, step, nodes, error };
  }
}

/** The largest distance of a stretch from the route, m, as looked at. @param {Route} route @param {Stretched} stretch @param {number} high @param {Point} origin */
function courseError(route, { start, step, nodes }, high, [ox, oy]) {
  const count = nodes.length / 3;
  const at = linspace(start, high, 4 * (count - 1) + 1);
  const exact = route.evaluate(at);
  let worst = 0;
  at.forEach((s, i) => {
    const along = (s - start) / step;
    const n = Math.min(Math.max(Math.trunc(along), 0), count - 2);
    const f = along - n;
    const [rest, blend] = [1 - f, f * f * (3 - 2 * f)];
    const reach = step * f * rest;
    const [h0, h1] = [nodes[2 * count + n], nodes[2 * count + n + 1]];
    const [x0, y0] = [nodes[n], nodes[count + n]];
    const x = ox + x0 + blend * (nodes[n + 1] - x0) + reach * (rest * Math.cos(h0) - f * Math.cos(h1));
    const y =
      oy + y0 + blend * (nodes[count + n + 1] - y0) + reach * (rest * Math.sin(h0) - f * Math.sin(h1));
    worst = Math.max(worst, Math.hypot(x - exact[4 * i], y - exact[4 * i + 1]));
  });
  return worst;
}
