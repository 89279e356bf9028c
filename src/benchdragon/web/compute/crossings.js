// When handles pass places of the route and speeds: roots of what is known at all times. Twin of
// analysis/crossings.py.

import { doubles, withArena } from "./arena.js";
import { ANALYSIS_CROSSINGS } from "./constants.js";
import { countUpTo } from "./profile.js";
import { rootsOf } from "./roots.js";
import { Placement } from "./walk.js";

/** @typedef {import("./walk.js").Motion} Motion */
/** @typedef {import("./walk.js").Walk} Walk */

/**
 * A handle passes a place, or a speed.
 * @typedef {object} Crossing
 * @property {number} handle which, from 0
 * @property {number} time s
 * @property {number} s route position then, m
 * @property {number} speed then, m/s
 * @property {boolean} bend whether it is a place that is passed; else a speed
 * @property {number} next number of the span of places, or of speeds, that begins
 */

/** That a handle passes something between times number `step` and the next. @typedef {{ handle: number, step: number, bend: boolean, next: number, aim: number }} Passed */

const { TOLERANCE } = ANALYSIS_CROSSINGS;
// Handles times crossings that are placed at a time: memory of a page is never given back.
const PLACES = 100_000;

/**
 * When front handles of benches pass route positions, m, or speeds, m/s, both ascending. Of what is passed
 * between two times of the motion and passed back by the next nothing is known.
 * @param {Walk} walk
 * @param {Motion} motion
 * @param {number[]} places
 * @param {number[]} gates
 * @returns {Crossing[]}
 */
export function crossings(walk, motion, places, gates) {
  const told = [
    ...passed(motion, doubles(motion.s), places, true),
    ...passed(motion, motion.speed, gates, false),
  ].sort((a, b) => a.handle - b.handle);
  const per = Math.max(Math.floor(PLACES / (walk.dragon.benches + 1)), 1);
  /** @type {Crossing[]} */
  const found = [];
  for (let first = 0; first < told.length; first += per)
    found.push(...rooted(walk, motion, told.slice(first, first + per)));
  return found;
}

/**
 * Which gates are passed in which steps of values, (handles, T).
 * @param {Motion} motion
 * @param {Float64Array} values
 * @param {number[]} gates
 * @param {boolean} bend
 */
function passed({ count, dragon }, values, gates, bend) {
  /** @type {Passed[]} */
  const found = [];
  for (let handle = 0; handle < dragon.benches; handle++) {
    let before = countUpTo(gates, values[handle * count]);
    for (let step = 0; step + 1 < count; step++) {
      const after = countUpTo(gates, values[handle * count + step + 1]);
      for (let next = before + 1; next <= after; next++)
        found.push({ handle, step, bend, next, aim: gates[next - 1] });
      for (let next = before - 1; next >= after; next--)
        found.push({ handle, step, bend, next, aim: gates[next] });
      before = after;
    }
  }
  return found;
}

/** @param {Walk} walk @param {Motion} motion @param {Passed[]} told @returns {Crossing[]} */
function rooted(walk, motion, told) {
  /** @param {Float64Array} times @param {number[]} which */
  const off = (times, which) => {
    const some = which.map((n) => told[n]);
    return statesOf(walk, some, times).map(([s, speed], i) => (some[i].bend ? s : speed) - some[i].aim);
  };
  const [low, high] = [0, 1].map((later) => told.map(({ step }) => motion.times[step + later]));
  const times = rootsOf(off, low, high, TOLERANCE);
  return statesOf(walk, told, times).map(([s, speed], i) => {
    const { handle, bend, next } = told[i];
    return { handle, time: times[i], s, speed, bend, next };
  });
}

/**
 * Route position, m, and speed, m/s, of one handle at each time.
 * @param {Walk} walk
 * @param {Passed[]} told
 * @param {Float64Array} times
 * @returns {number[][]}
 */
function statesOf(walk, told, times) {
  const last = told.reduce((most, { handle }) => Math.max(most, handle), 1);
  return withArena(walk.engine, (arena) => {
    const dragon = walk.dragon.first(arena, last);
    const headS = Array.from(times, (time) => walk.headPosition(time));
    const placed = new Placement(arena, dragon, walk.route, headS);
    placed.check();
    const at = told.map(({ handle }, i) => handle * times.length + i);
    const [rows, u] = [/** @type {BigInt64Array} */ (placed.row.view), doubles(placed.u)];
    const [row, along] = [
      arena.whole(at.map((n) => Number(rows[n]))),
      arena.vector(at.map((n) => u[n])),
    ];
    const out = arena.array("d", times.length);
    walk.engine.call("bd_route_positions", walk.route.rows, row, along, out);
    const [s, ratio] = [doubles(out), doubles(placed.ratio)];
    return at.map((n, i) => [s[i], ratio[n] * walk.profile.speed(times[i])]);
  });
}
