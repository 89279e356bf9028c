// The head's speed over time, and the distance walked by then: twin of model/profile.py.

import { _ } from "../words.js";
import { MODEL_PROFILE } from "./constants.js";
import { InputError, finite, notNegative } from "./errors.js";
import { general } from "./number_format.js";

/**
 * One stretch of a walk cut where the head's acceleration jumps.
 * @typedef {object} PaceStretch
 * @property {[number, number]} times s, its start and end
 * @property {[number, number]} ways distance walked from time 0 on, m
 * @property {[number, number]} speeds of the head, m/s
 * @property {number} rate its acceleration, m/s^2
 */

/** How many of increasing numbers are at most a value. @param {ArrayLike<number>} sorted @param {number} value */
export function countUpTo(sorted, value) {
  let low = 0;
  let high = sorted.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** How many of increasing numbers are below a value. @param {ArrayLike<number>} sorted @param {number} value */
function countBelow(sorted, value) {
  let low = 0;
  let high = sorted.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Head speed over time, linear between knots and constant beyond the first and the last. */
export class Profile {
  /** @param {number[]} times of the knots, s, increasing @param {number[]} speeds at the knots, m/s */
  constructor(times, speeds) {
    this.times = times;
    this.speeds = speeds;
    this.#check();
    this.slopes = [0];
    this.sums = [0];
    for (let n = 1; n < times.length; n++) {
      const span = times[n] - times[n - 1];
      this.slopes.push((speeds[n] - speeds[n - 1]) / span);
      this.sums.push(this.sums[n - 1] + 0.5 * (speeds[n] + speeds[n - 1]) * span);
    }
    this.slopes.push(0);
  }

  /** The same speed, m/s, at all times. @param {number} speed */
  static constant(speed) {
    return new Profile([0], [speed]);
  }

  #check() {
    const { times, speeds } = this;
    if (times.length !== speeds.length || !times.length)
      throw new InputError(
        _("a speed profile needs as many times as speeds, at least one, not {a} and {b}", {
          a: times.length,
          b: speeds.length,
        }),
      );
    for (const t of times) finite("profile", t, "s");
    for (const v of speeds)
      if (notNegative("speed", v, "m/s") > MODEL_PROFILE.MOST_SPEED)
        throw new InputError(_("speed must be at most 100 m/s, not {v} m/s", { v: general(v) }));
    if (times.some((t, n) => n > 0 && t <= times[n - 1]))
      throw new InputError(_("the times of a speed profile must increase"));
  }

  /** Head speed at a time, m/s: as `numpy.interp`. @param {number} t */
  speed(t) {
    const { times, speeds } = this;
    const n = countUpTo(times, t);
    if (n === 0) return speeds[0];
    if (n === times.length) return speeds[n - 1];
    return this.slopes[n] * (t - times[n - 1]) + speeds[n - 1];
  }

  /** Rate of change of the head's speed at a time, m/s^2; at a knot that of the span after it. @param {number} t */
  acceleration(t) {
    return this.slopes[countUpTo(this.times, t)];
  }

  /** Distance walked from time 0 to a time, m; negative before 0. @param {number} t */
  distance(t) {
    return this.#fromFirst(t) - this.#fromFirst(0);
  }

  /** The walk from start to end, s, in stretches of one acceleration. @param {number} start @param {number} end */
  stretches(start, end) {
    const times = [start, ...this.times.filter((t) => start < t && t < end), end];
    /** @type {PaceStretch[]} */
    const found = [];
    for (let n = 1; n < times.length; n++) {
      const [a, b] = [times[n - 1], times[n]];
      found.push({
        times: [a, b],
        ways: [this.distance(a), this.distance(b)],
        speeds: [this.speed(a), this.speed(b)],
        rate: this.acceleration(a),
      });
    }
    return found;
  }

  /**
   * The first time, s, by which `distance` (m, from time 0) is walked: inverse of `distance`.
   * Infinite where the head stops for good before; minus infinite where it never started after.
   * @param {number} distance
   */
  time(distance) {
    const wanted = distance + this.#fromFirst(0);
    const { times, speeds, sums, slopes } = this;
    const n = countBelow(sums, wanted);
    if (n === 0 || n === times.length) {
      const knot = n === 0 ? 0 : n - 1;
      const ahead = wanted - sums[knot];
      if (ahead && !speeds[knot]) return ahead > 0 ? Infinity : -Infinity;
      return times[knot] + (ahead ? ahead / speeds[knot] : 0);
    }
    const ahead = wanted - sums[n - 1];
    const speed = speeds[n - 1];
    // The stable root of slope t^2 / 2 + speed t = ahead.
    const root = Math.sqrt(Math.max(speed * speed + 2 * slopes[n] * ahead, 0));
    return Math.min(times[n - 1] + (2 * ahead) / (speed + root), times[n]);
  }

  /** @param {number} t */
  #fromFirst(t) {
    const knot = Math.max(countUpTo(this.times, t) - 1, 0);
    const dt = t - this.times[knot];
    const slope = dt < 0 ? 0 : this.slopes[knot + 1];
    // Who stands does not move in an infinite time either.
    const speed = this.speeds[knot] + (slope === 0 ? 0 : 0.5 * slope * dt);
    return this.sums[knot] + (speed === 0 ? 0 : speed * dt);
  }
}

/**
 * When the head comes to `way` on a stretch, s: `Stretches.time`.
 * @param {PaceStretch} stretch
 * @param {number} way m
 */
export function timeOnStretch({ times, ways, speeds }, way) {
  const ahead = way - ways[0];
  if (ahead <= 0) return times[0];
  const [slow, fast] = speeds;
  const share = Math.min(ahead / (ways[1] - ways[0]), 1);
  const speed = Math.sqrt(slow * slow + share * (fast * fast - slow * slow));
  return Math.min(times[0] + (2 * ahead) / (slow + speed), times[1]);
}
