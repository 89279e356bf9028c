// @ts-nocheck
// Made from model/turns.py by tools/make_twins.py; to make it again: make generate

import { InputError, brief } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";
import { checkedBend, checkedSize, laidRows } from "./base_curve.js";
import { Arc, Route, Spiral, curvesOf, joinedCurves } from "./curves.js";
import { finite, notNegative, positive } from "./errors.js";

const asNumbers = (_name, values) => values;
const PART_COLUMNS = 8;
const NEGLIGIBLE = 1e-09;
const REACH_LOOK = 0.02;
const LEAD = 100.0;
const TRAIL = 1000.0;
const ARCS = 3;
const MOST_TURN_PIECES = 7;
const TurnStatus = { OK: 0, TOO_NEAR: 1, NO_ARCS: 2, NO_LINE: 3, NO_CIRCLE: 4, NOT_EASED: 5, NO_ROOM: 6 };
const LEAST_THETA = 0.5;
export class Turn {
  constructor(pitch, entryRadius, exitRadius, pieces) {
    this.pitch = pitch;
    this.entry_radius = entryRadius;
    this.exit_radius = exitRadius;
    this.pieces = pieces;
    this.__post_init__();
  }
  __post_init__() {
    let name, text;
    checkedBend("pitch", this.pitch);
    for (name of py.iter(["entry_radius", "exit_radius"])) {
      checkedSize(name, this[name]);
    }
    if (!py.eq(py.slice(py.shape(asNumbers("pieces", this.pieces)), 1, null), [3])) {
      text = _("pieces must be triples (length, curvature, curvature), not {value}");
      throw new InputError(py.filled(text, { value: brief(this.pieces) }));
    }
    curvesOf(py.slice(this._parts(this.pitch, this.pitch), 1, -1));
  }
  _parts(lead, trail) {
    let parts, pieces;
    parts = py.empty([(py.len(this.pieces) + 2), PART_COLUMNS]);
    pieces = py.array(this.pieces, "d");
    py.entry("bd_turn_families_turn_parts", this.pitch, this.entry_radius, this.exit_radius, lead, trail, pieces, parts);
    return parts;
  }
  rows(lead, trail) {
    let parts;
    parts = this._parts(lead, trail);
    return laidRows(parts, undefined, [1, (py.len(parts) - 1)]);
  }
  get length() {
    return py.sum(py.list(this.pieces).map((piece) => py.at(piece, 0)));
  }
  get least_radius() {
    let bend;
    bend = py.max(py.list(this.pieces).map(([_length, a, b]) => py.max(py.abs(a), py.abs(b))));
    return (py.truth(bend) ? (1.0 / bend) : Infinity);
  }
  way(radius) {
    let joint, k, spirals;
    checkedSize("radius", radius);
    [k, spirals] = py.list([(this.pitch / (2.0 * Math.PI)), 0.0]);
    for (joint of py.iter([this.entry_radius, this.exit_radius])) {
      if ((py.sub(radius, joint) > NEGLIGIBLE)) {
        spirals = py.extend(spirals, py.sub(py.entry("bd_curve_spiral_length", k, (radius / k))[0], py.entry("bd_curve_spiral_length", k, (joint / k))[0]));
      }
    }
    return py.add(spirals, this.length);
  }
  get extent() {
    return reach(this.rows(this.pitch, this.pitch));
  }
  _curves_() {
    return py.slice(this.route(this.pitch, this.pitch).curves, 1, -1);
  }
  get curves() {
    return py.keep(this, "curves", this._curves_());
  }
  route(lead = LEAD, trail = TRAIL) {
    let curves, parts;
    parts = this._parts(positive("lead", lead, "m"), positive("trail", trail, "m"));
    curves = curvesOf(parts);
    return new Route(joinedCurves(curves, 1, (py.len(curves) - 1)));
  }
  rounds(count, outer, bend, trail = TRAIL, begun = false) {
    let again, back, inward, middle, once, outward, scale, start;
    scale = ((2.0 * Math.PI) / this.pitch);
    start = (checkedSize("outer", outer) * scale);
    inward = new Spiral(this.pitch, start, (this.entry_radius * scale));
    outward = new Spiral(this.pitch, (this.exit_radius * scale), start, [0.0, 0.0], Math.PI);
    once = this.route(LEAD, trail).curves;
    middle = py.slice(once, 1, -1);
    back = wayBack(outward, inward, checkedBend("bend", bend));
    again = py.list(py.range((count - 1))).flatMap((_round) => py.list([...py.iter(middle), outward, ...py.iter(back), inward]).map((curve) => curve));
    return new Route([(py.truth(begun) ? inward : py.at(once, 0)), ...py.iter(again), ...py.iter(middle), py.at(once, -1)]);
  }
}
function wayBack(outward, inward, bend) {
  let dx, dy, goal, heading, joint, rightX, rightY, there, u, v, wide, x, y;
  [[x, y], heading] = py.list(outward.end_pose);
  [[u, v], goal] = py.list(inward.start_pose);
  [rightX, rightY] = py.list([py.sin(goal), -py.cos(goal)]);
  [dx, dy] = py.list([py.sub(py.add(x, (bend * py.sin(heading))), u), py.sub(py.sub(y, (bend * py.cos(heading))), v)]);
  wide = (py.sub(py.add((dx * dx), (dy * dy)), (bend * bend)) / (2.0 * py.sub(py.add((dx * rightX), (dy * rightY)), bend)));
  joint = py.atan2(py.sub((wide * rightX), dx), py.sub(dy, (wide * rightY)));
  there = [py.add(x, (bend * py.sub(py.sin(heading), py.sin(joint)))), py.sub(y, (bend * py.sub(py.cos(heading), py.cos(joint))))];
  return [new Arc(bend, -py.mod(py.sub(heading, joint), (2.0 * Math.PI)), [x, y], heading), new Arc(wide, -py.mod(py.sub(joint, goal), (2.0 * Math.PI)), there, joint)];
}
function reach(rows) {
  return py.entry("bd_route_parts_farthest", rows, py.float(py.at(rows, [1, 2])), py.float(py.at(rows, [-1, 2])), REACH_LOOK)[0];
}
const REASONS = py.dict([[1, N_("the turn must begin and end farther out than {least} m at this pitch, not at {value} m")], [2, N_("no two arcs of this ratio join the spirals there")], [3, N_("radii of {a} m and {b} m leave no line between the arcs: smaller ones are needed")], [4, N_("no circle of the middle curvature is tangent to both arcs")], [5, N_("no turn eased like this joins the spirals there")], [6, N_("clothoids of {ease} m leave no room for the arcs")]]);
export function twoArcs(pitch, entryRadius, exitRadius, ratio, ease = 0.0) {
  let arcs, count, joints, pieces, status;
  joints = _checkedJoints(pitch, entryRadius, exitRadius);
  ease = notNegative("ease", ease, "m");
  [arcs, pieces] = py.list([py.empty([ARCS, 2]), py.empty([MOST_TURN_PIECES, 3])]);
  [count, status] = py.list(py.entry("bd_turn_families_two_arcs", ...py.iter(joints), positive("ratio", ratio), ease, arcs, pieces));
  return _made(joints, py.slice(pieces, null, count), status, ease);
}
export function threePieces(pitch, entryRadius, exitRadius, radii, bend = 0.0, ease = 0.0) {
  let arcs, count, first, joints, last, pieces, status;
  joints = _checkedJoints(pitch, entryRadius, exitRadius);
  if (!py.eq(py.shape(asNumbers("radii", radii)), [2])) {
    throw new InputError(py.filled(_("radii must be a pair, not {value}"), { value: brief(radii) }));
  }
  [first, last] = py.list(py.list(radii).map((radius) => positive("radii", radius, "m")));
  [bend, ease] = py.list([finite("bend", bend, "1/m"), notNegative("ease", ease, "m")]);
  [arcs, pieces] = py.list([py.empty([ARCS, 2]), py.empty([MOST_TURN_PIECES, 3])]);
  [count, status] = py.list(py.entry("bd_turn_families_three_pieces", ...py.iter(joints), first, bend, last, ease, arcs, pieces));
  return _made(joints, py.slice(pieces, null, count), status, ease, [first, last]);
}
function _checkedJoints(pitch, entryRadius, exitRadius) {
  let entry, leave;
  [entry, leave] = py.list([checkedSize("entry_radius", entryRadius), checkedSize("exit_radius", exitRadius)]);
  return [checkedBend("pitch", pitch), entry, leave];
}
function _made(joints, pieces, status, ease, radii = [NaN, NaN]) {
  let ends, least, pitch;
  if (!py.eq(status, TurnStatus.OK)) {
    [pitch, ...ends] = py.list(joints);
    least = ((LEAST_THETA * pitch) / (2.0 * Math.PI));
    throw new InputError(py.filled(_(py.at(REASONS, status)), { least: `${py.format(least, `.3g`)}`, value: `${py.format(py.min(ends), `.6g`)}`, a: `${py.format(py.at(radii, 0), `.6g`)}`, b: `${py.format(py.at(radii, 1), `.6g`)}`, ease: `${py.format(ease, `g`)}` }));
  }
  return new Turn(...py.iter(joints), py.tuple(py.list(py.tolist(pieces)).map(([length, a, b]) => [length, a, b])));
}
