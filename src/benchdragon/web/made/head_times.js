// @ts-nocheck
// Made from analysis/head_times.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";

export class HeadTimes {
  constructor(walk, start, since = -Infinity, until = Infinity) {
    this.walk = walk;
    this.start = start;
    this.since = since;
    this.until = until;
  }
  at(s) {
    return ((s <= this.start) ? this.since : py.max(this.walk.time_at(s), this.since));
  }
  told(lower, upper, status, leads = /** @type {any} */ (null)) {
    let early, late, value;
    [value, early, late] = py.list(this.bracketed(lower, upper, leads));
    if ((late <= this.until)) {
      return [value, early, late, status];
    }
    return [py.min(value, this.until), py.min(early, this.until), this.until, "undecided"];
  }
  bracketed(lower, upper, leads = /** @type {any} */ (null)) {
    let ahead, behind, early, late;
    [behind, ahead] = py.list(py.or(leads, () => [this._drift(lower, -1.0), this._drift(upper, 1.0)]));
    early = this.not_after(lower, py.min(behind, 0.0));
    late = this.not_before(upper, py.max(ahead, 0.0));
    return [py.min(py.max(this.at((0.5 * py.add(lower, upper))), early), late), early, late];
  }
  _drift(s, side) {
    let doubt, drift;
    if (!py.isfinite(s)) {
      return 0.0;
    }
    [drift, doubt] = py.list(py.entry("bd_double_double_head_drift", this.walk.route.rows, s));
    return py.add(drift, (side * doubt));
  }
  not_after(s, shift = 0.0) {
    let step, t;
    t = this.at(s);
    step = (py.isfinite(t) ? py.ulp(t) : 0.0);
    while (((t > this.since) && (this._lead(t, s, shift) > 0))) {
      [t, step] = py.list([py.sub(t, step), (2.0 * step)]);
    }
    return py.max(t, this.since);
  }
  not_before(s, shift = 0.0) {
    let step, t;
    t = this.at(s);
    step = (py.isfinite(t) ? py.ulp(t) : 0.0);
    while (((s > this.start) && (t < Infinity) && (this._lead(t, s, shift) < 0))) {
      [t, step] = py.list([py.add(t, step), (2.0 * step)]);
    }
    return t;
  }
  _lead(t, s, shift) {
    let walk;
    walk = this.walk;
    if (!py.isfinite(t)) {
      return py.sub(py.add(walk.start, py.float(walk.profile.distance(t))), s);
    }
    return walk.profile.past(t, [s, shift, -walk.start]);
  }
}
