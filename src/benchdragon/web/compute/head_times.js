// When the head comes to a route position, so that brackets of times are sure: the twin of
// analysis/head_times.py.

import { Exact, ulp } from "./exact.js";

/** @typedef {import("./answer.js").Status} Status */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {import("./walk.js").Profile} Profile */

/**
 * How far a profile's head walks from its first knot to a finite time, without any rounding.
 * @param {Profile} profile
 * @param {number} t s
 */
function exactFromFirst({ times, speeds }, t) {
  const last = times.length - 1;
  if (t <= times[0]) return Exact.of(t).minus(Exact.of(times[0])).times(Exact.of(speeds[0]));
  let walked = Exact.of(0);
  if (t > times[last]) walked = Exact.of(t).minus(Exact.of(times[last])).times(Exact.of(speeds[last]));
  for (let n = 0; n < last && t > times[n]; n++) {
    const [a, b, v, w] = [times[n], times[n + 1], speeds[n], speeds[n + 1]].map(Exact.of);
    if (t >= times[n + 1]) {
      walked = walked.plus(v.plus(w).half().times(b.minus(a)));
      continue;
    }
    const gone = Exact.of(t).minus(a);
    const gained = w.minus(v).times(gone).half().by(b.minus(a));
    walked = walked.plus(v.plus(gained).times(gone));
  }
  return walked;
}

/** Times of a search along a walk. */
export class HeadTimes {
  /**
   * @param {Walk} walk what is searched
   * @param {number} start the head position at which the search begins, m
   * @param {number} since the time at which it does, s
   * @param {number} until the time at which it ends, s
   */
  constructor(walk, start, since = -Infinity, until = Infinity) {
    this.walk = walk;
    this.start = start;
    this.since = since;
    this.until = until;
  }

  /** The first time of the search, s, at which the head stands at s. @param {number} s */
  at(s) {
    return s <= this.start ? this.since : Math.max(this.walk.timeAt(s), this.since);
  }

  /**
   * `bracketed`, within the search: what may come but after its end is undecided.
   * @param {number} lower @param {number} upper @param {Status} status @param {[number, number]} [leads]
   * @returns {[number, number, number, Status]}
   */
  told(lower, upper, status, leads) {
    const [value, early, late] = this.bracketed(lower, upper, leads);
    const { until } = this;
    if (late <= until) return [value, early, late, status];
    return [Math.min(value, until), Math.min(early, until), until, "undecided"];
  }

  /**
   * About when the head is between two positions, m, and a time before and one after that, s.
   *
   * At the second it has surely come no farther than where the kernels place it for `lower`, at the third
   * at least to where they do for `upper`: see `drift.head_drift`, where `leads` are not known, m.
   * @param {number} lower @param {number} upper @param {[number, number]} [leads] @returns {[number, number, number]}
   */
  bracketed(lower, upper, leads = [this.#drift(lower, -1), this.#drift(upper, 1)]) {
    const early = this.notAfter(lower, Math.min(leads[0], 0));
    const late = this.notBefore(upper, Math.max(leads[1], 0));
    return [Math.min(Math.max(this.at(0.5 * (lower + upper)), early), late), early, late];
  }

  /** How far ahead of s, m, the kernels place the head for it: at most (side 1), at least (-1). @param {number} s @param {number} side */
  #drift(s, side) {
    if (!Number.isFinite(s)) return 0;
    const { engine, route } = this.walk;
    const [drift, doubt] = engine.call("bd_drift_head_drift", route.rows, s);
    return drift + side * doubt;
  }

  /** A time at which the head has come no farther than s + shift; not before the search begins. @param {number} s @param {number} [shift] */
  notAfter(s, shift = 0) {
    let t = this.at(s);
    let step = Number.isFinite(t) ? ulp(t) : 0;
    while (t > this.since && this.#lead(t, s, shift) > 0) [t, step] = [t - step, 2 * step];
    return Math.max(t, this.since);
  }

  /** A time at which the head has come at least as far as s + shift. @param {number} s @param {number} [shift] */
  notBefore(s, shift = 0) {
    let t = this.at(s);
    let step = Number.isFinite(t) ? ulp(t) : 0;
    while (s > this.start && t < Infinity && this.#lead(t, s, shift) < 0)
      [t, step] = [t + step, 2 * step];
    return t;
  }

  /** Whether the head stands past s + shift at time t (1), before (-1) or there (0): not rounded. @param {number} t @param {number} s @param {number} shift */
  #lead(t, s, shift) {
    const { profile, start } = this.walk;
    if (!Number.isFinite(t)) return Math.sign(this.walk.headPosition(t) - s);
    const walked = exactFromFirst(profile, t).minus(exactFromFirst(profile, 0));
    return Exact.of(start).plus(walked).minus(Exact.of(s)).minus(Exact.of(shift)).sign;
  }
}
