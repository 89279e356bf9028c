// @ts-nocheck
// Made from model/curves.py by tools/make_twins.py; to make it again: make generate

import { Curve } from "../compute/curve.js";
import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";
import { OneCurve, checkPose, checkedBend, checkedSize, laidRows } from "./base_curve.js";
import { finite, notNegative } from "./errors.js";

const JOINT_GAP = 1e-09;
const JOINT_KINK = 1e-09;
const MOST_WINDING = 10000.0;
export class Line extends OneCurve {
  static called = N_("a line");
  get called() {
    return this.constructor.called;
  }
  static kind = 0.0;
  get kind() {
    return this.constructor.kind;
  }
  constructor(lengthM, start = [0.0, 0.0], startHeading = 0.0) {
    super();
    this.length_m = lengthM;
    this.start = start;
    this.start_heading = startHeading;
    this.__post_init__();
  }
  __post_init__() {
    checkedSize("length", this.length_m);
    checkPose(this.start, this.start_heading);
  }
  _part() {
    return [this.kind, ...py.iter(this.start), this.start_heading, this.length_m, 0.0, 0.0, 0.0];
  }
  static _from(part) {
    let _kind, _rest, heading, length, x, y;
    [_kind, x, y, heading, length, ..._rest] = py.list(part);
    return new this(length, [x, y], heading);
  }
}
export class Arc extends OneCurve {
  static called = N_("an arc");
  get called() {
    return this.constructor.called;
  }
  static kind = 1.0;
  get kind() {
    return this.constructor.kind;
  }
  constructor(radius, sweep = 0.0, start = [0.0, 0.0], startHeading = 0.0) {
    super();
    this.radius = radius;
    this.sweep = sweep;
    this.start = start;
    this.start_heading = startHeading;
    this.__post_init__();
  }
  __post_init__(degrees, many) {
    checkedBend("radius", this.radius);
    if ((degrees != null)) {
      this["sweep"] = py.radians(finite("degrees", degrees));
    }
    if ((finite("sweep", this.sweep, "rad") === 0.0)) {
      throw new InputError(_("the angle of an arc must not be 0"));
    }
    checkedSize("length", (this.radius * py.abs(this.sweep)));
    checkPose(this.start, this.start_heading);
  }
  get centre() {
    let side, x, y;
    side = py.add(this.start_heading, py.copysign((0.5 * Math.PI), this.sweep));
    [x, y] = py.list(this.start);
    return [py.add(x, (this.radius * py.cos(side))), py.add(y, (this.radius * py.sin(side)))];
  }
  _part() {
    return [this.kind, ...py.iter(this.start), this.start_heading, this.radius, this.sweep, 0.0, 0.0];
  }
  static _from(part) {
    let _kind, _rest, heading, radius, sweep, x, y;
    [_kind, x, y, heading, radius, sweep, ..._rest] = py.list(part);
    return new this(radius, sweep, [x, y], heading, undefined, true);
  }
}
export class Spiral extends OneCurve {
  static called = N_("a spiral");
  get called() {
    return this.constructor.called;
  }
  static kind = 3.0;
  get kind() {
    return this.constructor.kind;
  }
  constructor(pitch, startAngle, endAngle, centre = [0.0, 0.0], rotation = 0.0, mirrored = false) {
    super();
    this.pitch = pitch;
    this.start_angle = startAngle;
    this.end_angle = endAngle;
    this.centre = centre;
    this.rotation = rotation;
    this.mirrored = mirrored;
    this.__post_init__();
  }
  __post_init__() {
    let angle, name, outer, text;
    checkedBend("pitch", this.pitch);
    for ([name, angle] of py.iter([["start_angle", this.start_angle], ["end_angle", this.end_angle]])) {
      if ((finite(name, angle, "rad") < 0.0)) {
        text = _("{name} must not be negative, but is {value}");
        throw new InputError(py.filled(text, { name: name, value: `${py.format(angle, `g`)} rad` }));
      }
    }
    if (py.eq(this.start_angle, this.end_angle)) {
      throw new InputError(_("a spiral must end at another angle than it starts at"));
    }
    checkedSize("radius", (py.max(this.start_angle, this.end_angle) * this.k));
    outer = py.max(this.start_angle, this.end_angle);
    checkedSize("length", (((0.5 * this.k) * outer) * outer));
    checkPose(this.centre, this.rotation);
  }
  static between(pitch, startRadius, endRadius, centre = [0.0, 0.0], rotation = 0.0, mirrored = false) {
    let k, name, radius;
    k = (checkedBend("pitch", pitch) / (2.0 * Math.PI));
    for ([name, radius] of py.iter([["start_radius", startRadius], ["end_radius", endRadius]])) {
      notNegative(name, radius, "m");
    }
    return new this(pitch, (startRadius / k), (endRadius / k), centre, rotation, mirrored);
  }
  get inward() {
    return (this.end_angle < this.start_angle);
  }
  get k() {
    return (this.pitch / (2.0 * Math.PI));
  }
  _part() {
    let angles, hand;
    angles = [this.start_angle, this.end_angle];
    hand = (py.truth(this.mirrored) ? -1.0 : 1.0);
    return [this.kind, ...py.iter(this.centre), this.rotation, this.pitch, ...py.iter(angles), hand];
  }
  static _from(part) {
    let _kind, end, hand, pitch, rotation, start, x, y;
    [_kind, x, y, rotation, pitch, start, end, hand] = py.list(part);
    return new this(pitch, start, end, [x, y], rotation, (hand < 0.0));
  }
}
class BentCurve extends OneCurve {
  constructor(lengthM, startCurvature, endCurvature, start = [0.0, 0.0], startHeading = 0.0) {
    super();
    this.length_m = lengthM;
    this.start_curvature = startCurvature;
    this.end_curvature = endCurvature;
    this.start = start;
    this.start_heading = startHeading;
    this.__post_init__();
  }
  __post_init__() {
    checkedSize("length", this.length_m);
    finite("start_curvature", this.start_curvature, "1/m");
    finite("end_curvature", this.end_curvature, "1/m");
    checkPose(this.start, this.start_heading);
  }
  _check_turn() {
    let text, turn;
    turn = (this.length_m * py.max(py.abs(this.start_curvature), py.abs(this.end_curvature)));
    if ((turn > 10000.0)) {
      text = _("{kind} may sweep at most {most} rad, not {value} rad");
      throw new InputError(py.filled(text, { kind: _(this.called), most: `${py.format(10000.0, `g`)}`, value: `${py.format(turn, `g`)}` }));
    }
  }
  _part() {
    let bends;
    bends = [this.start_curvature, this.end_curvature];
    return [this.kind, ...py.iter(this.start), this.start_heading, this.length_m, ...py.iter(bends), 0.0];
  }
  static _from(part) {
    let _hand, _kind, end, heading, length, start, x, y;
    [_kind, x, y, heading, length, start, end, _hand] = py.list(part);
    return new this(length, start, end, [x, y], heading);
  }
}
export class Clothoid extends BentCurve {
  static called = N_("a clothoid");
  get called() {
    return this.constructor.called;
  }
  static kind = 2.0;
  get kind() {
    return this.constructor.kind;
  }
  __post_init__() {
    super.__post_init__();
    this._check_turn();
  }
}
export class LogSpiral extends BentCurve {
  static called = N_("a logarithmic spiral");
  get called() {
    return this.constructor.called;
  }
  static kind = 4.0;
  get kind() {
    return this.constructor.kind;
  }
  __post_init__() {
    let a, b, text;
    super.__post_init__();
    [a, b] = py.list([this.start_curvature, this.end_curvature]);
    if (((b === 0.0) || !(((1.0 / MOST_WINDING) <= (a / b)) && ((a / b) <= MOST_WINDING)))) {
      text = _("the curvatures of a logarithmic spiral must have the same sign and differ by a factor of at most {most}, not be {start} and {end} 1/m");
      throw new InputError(py.filled(text, { most: `${py.format(MOST_WINDING, `g`)}`, start: `${py.format(a, `g`)}`, end: `${py.format(b, `g`)}` }));
    }
    this._check_turn();
  }
}
const CURVES = py.dict([[0.0, Line], [1.0, Arc], [3.0, Spiral], [2.0, Clothoid], [4.0, LogSpiral]]);
export function curvesOf(parts) {
  return py.tuple(py.list(py.tolist(parts)).map((part) => py.at(CURVES, py.at(part, 0))._from(part)));
}
const _checkedCurves = (curves) => curves;
export function joinedCurves(curves, first, stop) {
  let parts;
  parts = py.array(py.list(curves).map((curve) => curve._part()), "d");
  laidRows(parts, undefined, [first, stop]);
  return [...py.iter(py.slice(curves, null, first)), ...py.iter(curvesOf(py.slice(parts, first, stop))), ...py.iter(py.slice(curves, stop, null))];
}
export class Route extends Curve {
  constructor(curves, kinks = false) {
    super();
    this.curves = curves;
    this.kinks = kinks;
    this.__post_init__();
  }
  __post_init__() {
    this["curves"] = _checkedCurves(this.curves);
    this._check_joints();
  }
  static joined(curves) {
    let checked;
    checked = _checkedCurves(curves);
    return new this(joinedCurves(checked, 1, py.len(checked)));
  }
  moved(turned, by) {
    let parts;
    checkPose(by, turned);
    parts = this.parts;
    py.entry("bd_route_parts_move_parts", parts, turned, ...py.iter(by));
    return new Route(curvesOf(parts), this.kinks);
  }
  seen_from(origin) {
    let near, rows;
    near = new Route(this.curves, this.kinks);
    { const all = py.copy(this.rows); py.keep(near, "rows", all); rows = all; }
    py.entry("bd_route_parts_settle_rows", rows, ...py.iter(origin));
    return near;
  }
  get parts() {
    return py.array(py.list(this.curves).map((curve) => curve._part()), "d");
  }
  _joints_() {
    let others, rows, starts;
    rows = py.tolist(this.rows);
    others = py.zip(py.slice(rows, 1, null), rows);
    starts = py.list(others).flatMap(([row, last]) => ((!py.eq(py.at(row, 1), py.at(last, 1))) ? [py.at(row, 2)] : []));
    return py.array([0.0, ...py.iter(starts), this.length]);
  }
  get joints() {
    return py.keep(this, "joints", this._joints_());
  }
  get centre() {
    return py.next(py.list(this.curves).flatMap((curve) => (((curve instanceof Spiral)) ? [curve.centre] : [])), [0.0, 0.0]);
  }
  _check_joints() {
    let gap, i, kink, off, text;
    off = py.zeros([(py.len(this.curves) - 1), 2]);
    py.entry("bd_route_parts_misfits", this.rows, off);
    for ([i, [gap, kink]] of py.iter(py.enumerate(py.tolist(off), 1))) {
      if ((gap > JOINT_GAP)) {
        text = _("curves {first} and {second} do not meet: they are {gap} m apart; Route.joined moves each to where the one before it ends");
        throw new InputError(py.filled(text, { first: i, second: (i + 1), gap: `${py.format(gap, `.6g`)}` }));
      }
      if (((kink > JOINT_KINK) && !py.truth(this.kinks))) {
        text = _("curves {first} and {second} meet at a kink of {kink} degrees; allow kinks or rotate one of them, as Route.joined does");
        throw new InputError(py.filled(text, { first: i, second: (i + 1), kink: `${py.format(py.degrees(kink), `.6g`)}` }));
      }
    }
  }
}
