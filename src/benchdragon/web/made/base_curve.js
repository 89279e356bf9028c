// @ts-nocheck
// Made from model/base_curve.py by tools/make_twins.py; to make it again: make generate

import { Curve } from "../compute/curve.js";
import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { finite, positive } from "./errors.js";
import { Pose } from "./poses.js";

const MOST_METRES = 100000000.0;
const NOWHERE = new Pose(0.0, 0.0, 0.0);
const LEAST_METRES = 1e-06;
export function laidRows(parts, start = NOWHERE, moved = [0, 0]) {
  let rows;
  rows = py.zeros([py.entry("bd_route_parts_row_count", parts)[0], 14]);
  py.entry("bd_route_parts_lay_rows", parts, start, ...py.iter(moved), rows);
  return rows;
}
export class OneCurve extends Curve {
  get kind() {
    return this.constructor.kind;
  }
  get parts() {
    return py.array([this._part()], "d");
  }
  moved(point, heading) {
    let parts;
    checkPose(point, heading);
    parts = this.parts;
    laidRows(parts, new Pose(...py.iter(point), heading), [0, 1]);
    return py.type(this)._from(py.at(py.tolist(parts), 0));
  }
}
export function kernelPose(pose) {
  return new Pose(...py.iter(py.at(pose, 0)), py.at(pose, 1));
}
export function checkPose(point, heading) {
  let value;
  if (!py.eq(py.shape(point), [2])) {
    throw new InputError(py.filled(_("a start or centre must be a pair (x, y), not {value}"), { value: point }));
  }
  for (value of py.iter(point)) {
    if ((py.abs(finite("start", value, "m")) > MOST_METRES)) {
      throw new InputError(_("a start or centre must lie within 1e8 m of the origin"));
    }
  }
  finite("heading", heading, "rad");
}
export function checkedBend(name, value) {
  let text;
  if ((positive(name, value, "m") < LEAST_METRES)) {
    text = _("{name} must be at least {least} m, not {value} m");
    throw new InputError(py.filled(text, { name: name, least: `${py.format(LEAST_METRES, `g`)}`, value: `${py.format(value, `g`)}` }));
  }
  return checkedSize(name, value);
}
export function checkedSize(name, value) {
  let text;
  if ((positive(name, value, "m") > MOST_METRES)) {
    text = _("{name} must be at most {most} m, not {value} m");
    throw new InputError(py.filled(text, { name: name, most: `${py.format(MOST_METRES, `g`)}`, value: `${py.format(value, `g`)}` }));
  }
  return value;
}
