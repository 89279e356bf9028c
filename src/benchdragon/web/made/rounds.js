// @ts-nocheck
// Made from analysis/rounds.py by tools/make_twins.py; to make it again: make generate

import { emptyPlacements } from "../compute/arrays.js";
import { py } from "../compute/python.js";
import { seamsOf } from "./nearby.js";

const REPEAT = 4;
export function repeats(rows) {
  return _repeats(rows, py.empty([0, 2]), 0.0);
}
export function returns(rows, reach) {
  return _repeats(rows, seamsOf(rows), reach);
}
function _repeats(rows, seams, reach) {
  let known;
  known = py.empty([py.add((4 * py.len(rows)), 64), REPEAT]);
  return py.slice(known, null, py.entry("bd_rounds_find_repeats", rows, seams, reach, known)[0]);
}
export class Rounds {
  constructor(walk, known) {
    this._walk = walk;
    this._known = known;
  }
  new(first, last) {
    let at, count, links, missed, places, rows, spans;
    [rows, links, spans] = py.list([this._walk.route.rows, this._walk.dragon.links, py.empty([(py.len(this._known) + 1), 2])]);
    [at, places] = py.list([py.empty(1), emptyPlacements((py.len(links) + 1), 1)]);
    [count, missed] = py.list(py.entry("bd_rounds_spans_left", rows, links, this._known, first, last, at, places, spans));
    return [py.list(py.tolist(py.slice(spans, null, count))).map(([start, end]) => [start, end]), missed];
  }
}
