// What stretches of a walk are made of, time by time: `_along` of model/profile.py, which has arrays.

/** @typedef {import("../made/profile.js").SpeedProfile} SpeedProfile */

/** Ways walked by times, m, and speeds then; accelerations after all times but the last. @param {SpeedProfile} profile @param {Float64Array} times @returns {Float64Array[]} */
export function _along(profile, times) {
  const [ways, speeds] = [profile.distance, profile.speed].map((one) =>
    times.map((t) => one.call(profile, t)),
  );
  return [ways, speeds, times.slice(0, -1).map((t) => profile.acceleration(t))];
}
