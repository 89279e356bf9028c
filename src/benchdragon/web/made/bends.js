// @ts-nocheck
// Made from analysis/bends.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";

const TURNINGS = py.dict([[1, "left"], [-1, "right"]]);
export class Bends {
  constructor(at, sides, turned) {
    this.at = at;
    this.sides = sides;
    this.turned = turned;
  }
  *[Symbol.iterator]() {
    yield* [this.at, this.sides, this.turned];
  }
  static of(route) {
    let at, count, rows, sides, turned;
    rows = py.len(route.rows);
    [at, sides, turned] = py.list([py.empty((2 * rows)), py.empty((2 * rows), "q"), py.empty(rows)]);
    count = py.entry("bd_bends_find_bends", route.rows, at, sides, turned)[0];
    return new this(py.slice(at, null, count), py.slice(sides, null, count), turned);
  }
  turning(s) {
    return turningOf(py.at(this.sides, (py.searchsorted(this.at, s) - 1)));
  }
}
export function turningOf(side) {
  return py.get(TURNINGS, py.int(side), "straight");
}
