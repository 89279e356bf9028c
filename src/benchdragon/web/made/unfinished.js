// @ts-nocheck
// Made from analysis/unfinished.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { _ } from "../words.js";

const NEARLY = 0.01;
const TENTHS = 10.0;
const DUST = 1e-06;
export class Unfinished {
  constructor(way, end) {
    this.way = way;
    this.end = end;
  }
  get text() {
    let text;
    if ((this.end == null)) {
      return this.told;
    }
    text = _("the dance ends before the tail is out of the turn: let the walk end at {end} s or later");
    return py.filled(text, { end: `${py.format(this.end, `.1f`)}` });
  }
  get told() {
    let text;
    text = _("the dance ends before the tail is out of the turn: the head lacks {way} m");
    return py.filled(text, { way: `${py.format(this.way, `.1f`)}` });
  }
}
export function unfinished(plan, walk, end) {
  let enough, last, time, way;
  if ((plan.route.kind !== "turn")) {
    return null;
  }
  last = plan.route.last_position(walk);
  way = py.sub(last, py.float(py.at(walk.head_position([end]), 0)));
  if ((way <= NEARLY)) {
    return null;
  }
  time = walk.time_at(last);
  enough = ((last < walk.route.length) && py.isfinite(time));
  return new Unfinished(way, (py.truth(enough) ? (py.ceil(py.sub((TENTHS * time), DUST)) / TENTHS) : null));
}
