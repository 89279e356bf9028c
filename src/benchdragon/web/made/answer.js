// @ts-nocheck
// Made from model/answer.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { atMost, known } from "./number_format.js";

export function keeps(self, limit) {
  let most;
  most = (limit * (1.0 + ROUNDING));
  if ((self.lower > most)) {
    return false;
  }
  return ((self.upper <= most) ? true : null);
}
export function shown(self, up, limit = /** @type {any} */ (null)) {
  if ((!py.truth(up) && (self.unit === "m") && py.truth(vanishing(self)))) {
    return atMost(self.upper);
  }
  return known(sure(self, false), sure(self, true), self.unit, up, limit);
}
export function vanishing(self) {
  return (((self.lower <= 0.0) && (0.0 <= self.value) && (self.value <= py.sub(self.upper, self.value))) && (self.upper > 0.0));
}
export function sure(self, up) {
  let end, near;
  end = (py.truth(up) ? self.upper : self.lower);
  near = (py.abs(py.sub(end, self.value)) <= (ROUNDING * py.abs(self.value)));
  return ((py.truth(near) || !py.isfinite(end)) ? self.value : end);
}
const ROUNDING = 1e-11;
export class Witness {
  constructor(time, s, benches, point, gap, features = [], handle = /** @type {any} */ (null), obstacle = /** @type {any} */ (null)) {
    this.time = time;
    this.s = s;
    this.benches = benches;
    this.point = point;
    this.gap = gap;
    this.features = features;
    this.handle = handle;
    this.obstacle = obstacle;
  }
}
export class Answer {
  constructor(value, lower, upper, unit, status, witness = /** @type {any} */ (null), assumptions = [], evaluations = 0, seconds = 0.0) {
    this.value = value;
    this.lower = lower;
    this.upper = upper;
    this.unit = unit;
    this.status = status;
    this.witness = witness;
    this.assumptions = assumptions;
    this.evaluations = evaluations;
    this.seconds = seconds;
  }
}
