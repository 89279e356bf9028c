// @ts-nocheck
// Made from analysis/speed.py by tools/make_twins.py; to make it again: make types

import { py } from "../compute/python.js";
import { N_ } from "../words.js";

export class Quantity {
  constructor(name, kind, power, unit, text) {
    this.name = name;
    this.kind = kind;
    this.power = power;
    this.unit = unit;
    this.text = text;
  }
}
export const QUANTITIES = py.dict([["speed", new Quantity("speed", 0, 1, "m/s", N_("speed of a handle"))], ["turning_rate", new Quantity("turning_rate", 1, 1, "rad/s", N_("turning rate of a bench"))], ["lateral_acceleration", new Quantity("lateral_acceleration", 2, 2, "m/s^2", N_("lateral acceleration of a handle"))], ["total_acceleration", new Quantity("total_acceleration", 3, 2, "m/s^2", N_("total acceleration of a handle"))], ["acceleration", new Quantity("acceleration", 4, 2, "m/s^2", N_("acceleration of a handle along the route"))]]);
export function givenLimits(plan) {
  let given;
  given = py.dict(py.list(QUANTITIES).map((name) => [name, plan.limits[name]]));
  if ((py.at(given, "turning_rate") != null)) {
    py.set(given, "turning_rate", py.radians(py.at(given, "turning_rate")));
  }
  return py.dict(py.list(py.items(given)).flatMap(([name, value]) => (((value != null)) ? [[name, value]] : [])));
}
