// @ts-nocheck
// Made from model/connections.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { kernelPose, laidRows } from "./base_curve.js";
import { Route, Spiral, curvesOf } from "./curves.js";
import { positive } from "./errors.js";

const ENTRIES = 24;
const SAMPLES = 48;
export class Step {
  constructor(formation, at = /** @type {any} */ (null), turned = 0.0) {
    this.formation = formation;
    this.at = at;
    this.turned = turned;
    this.__post_init__();
  }
  __post_init__() {
    if (((this.at == null) && (this.turned !== 0.0))) {
      throw new InputError(_("turned has no effect without at: this formation begins as the one before it ends"));
    }
  }
}
export function programme(steps, radius) {
  let given, out, parts, table;
  positive("radius", radius, "m");
  if (!py.truth(steps)) {
    throw new InputError(_("a programme needs at least one formation"));
  }
  parts = py.list(steps).map((step) => step.formation.build().parts);
  table = py.array(py.list(py.enumerate(py.zip(parts, steps))).map(([n, [own, step]]) => [py.len(own), ...py.iter(((py.truth(n) && (step.at == null)) ? [NaN, 0.0] : py.or(step.at, () => [0.0, 0.0]))), step.turned]));
  given = py.concatenate(parts);
  out = py.empty([py.add(py.len(given), (3 * py.len(steps))), 8]);
  return new Route(curvesOf(py.slice(out, null, py.entry("bd_connections_programme", given, table, radius, out)[0])));
}
export function joined(before, after, radius) {
  let _whole, first, parts;
  positive("radius", radius, "m");
  first = _entered(before, py.at(after.curves, 0), radius);
  [parts, _whole] = py.list(_shortest(before.end_pose, first.start_pose, radius));
  return new Route([...py.iter(before.curves), ...py.iter(curvesOf(parts)), first, ...py.iter(py.slice(after.curves, 1, null))]);
}
function _entered(before, curve, radius) {
  let begun, turns, ways;
  if ((!(curve instanceof Spiral) || !py.truth(curve.inward))) {
    return curve;
  }
  turns = py.list(py.range(ENTRIES)).map((n) => py.add(curve.start_angle, (((2.0 * Math.PI) * n) / ENTRIES)));
  begun = py.list(turns).map((angle) => py.replaced(curve, { start_angle: angle }));
  ways = py.list(begun).map((one) => _around(before.end_pose, one, radius));
  return py.at(begun, py.index(ways, py.min(ways)));
}
function _around(start, spiral, radius) {
  let away, near, parts, poses, u, v, whole;
  [parts, whole] = py.list(_shortest(start, spiral.start_pose, radius));
  if (py.truth(py.len(parts))) {
    poses = py.empty([SAMPLES, 4]);
    py.entry("bd_route_evaluate", laidRows(parts), py.array(py.list(py.range(SAMPLES)).map((n) => ((whole * n) / SAMPLES))), poses);
    [[u, v], near] = py.list([spiral.centre, py.sub((spiral.start_angle * spiral.k), (0.25 * spiral.pitch))]);
    away = py.list(py.tolist(poses)).map(([x, y, _heading, _bend]) => py.hypot(py.sub(x, u), py.sub(y, v)));
    if ((py.min(away) < near)) {
      return Infinity;
    }
  }
  return py.add(whole, spiral.length);
}
function _shortest(start, end, radius) {
  let count, parts, ways;
  ways = py.empty([8, 7]);
  parts = py.empty([3, 8]);
  py.entry("bd_connections_connections", kernelPose(start), kernelPose(end), radius, ways)[0];
  count = py.entry("bd_connections_way_parts", kernelPose(start), ways, 0, radius, parts)[0];
  return [py.slice(parts, null, count), py.float(py.at(ways, [0, 6]))];
}
