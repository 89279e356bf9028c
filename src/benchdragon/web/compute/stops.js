// Where the head stands, by its speed alone: handles stand when it does, and at no other time. Twin of
// analysis/stops.py.

import { stretchesOf } from "./stretches.js";

/** @typedef {import("./walk.js").Walk} Walk */
/** A time, s, in which the head stands, and its route position, m. @typedef {{ start: number, end: number, s: number }} Stop */

/**
 * All times within a span, s, in which the head stands; a moment is none.
 * @param {Walk} walk
 * @param {number} start @param {number} end
 */
export function stopsOf(walk, start, end) {
  /** @type {Stop[]} */
  const found = [];
  for (const { times, speeds } of stretchesOf(walk.profile, start, end)) {
    const [t, u] = times;
    if (speeds[0] || speeds[1] || u <= t) continue;
    const last = found[found.length - 1];
    if (last?.end === t) last.end = u;
    else found.push({ start: t, end: u, s: walk.headPosition(t) });
  }
  return found;
}
