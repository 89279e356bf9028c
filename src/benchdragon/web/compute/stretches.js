// A walk cut where the head's acceleration jumps: `Stretches` of model/profile.py, one by one.

import { py } from "./python.js";

/** @typedef {import("../made/profile.js").SpeedProfile} SpeedProfile */

/**
 * One of them: its start and end, s; the distance walked from time 0 on, m, and the head's speed, m/s, at
 * both; its acceleration, m/s^2.
 * @typedef {{ times: [number, number], ways: [number, number], speeds: [number, number], rate: number }} PaceStretch
 */

/** The walk from start to end, s, in stretches of one acceleration. @param {SpeedProfile} profile @param {number} start @param {number} end @returns {PaceStretch[]} */
export function stretchesOf(profile, start, end) {
  const inner = profile.times.filter((/** @type {number} */ t) => start < t && t < end);
  return py.pairwise([start, ...inner, end]).map((/** @type {[number, number]} */ times) => {
    const [ways, speeds] = [times.map((t) => profile.distance(t)), times.map((t) => profile.speed(t))];
    return { times, ways, speeds, rate: profile.acceleration(times[0]) };
  });
}

/** What stretches are made of: `_along` of model/profile.py. @param {SpeedProfile} profile @param {Float64Array} times @returns {Float64Array[]} */
export function _along(profile, times) {
  const [ways, speeds] = [profile.distance, profile.speed].map((one) =>
    times.map((t) => one.call(profile, t)),
  );
  return [ways, speeds, times.slice(0, -1).map((t) => profile.acceleration(t))];
}
