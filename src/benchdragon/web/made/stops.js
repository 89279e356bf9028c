// @ts-nocheck
// Made from analysis/stops.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";

class Stop {
  constructor(start, end, s) {
    this.start = start;
    this.end = end;
    this.s = s;
  }
  *[Symbol.iterator]() {
    yield* [this.start, this.end, this.s];
  }
}
export function stopsOf(walk, start, end) {
  let cut, found, speeds, t, u;
  cut = walk.profile.stretches(start, end);
  found = [];
  for ([[t, u], speeds] of py.iter(py.zip(py.tolist(cut.times), py.tolist(cut.speeds)))) {
    if ((py.list(speeds).some((one) => py.truth(one)) || (u <= t))) {
      continue;
    }
    if ((py.truth(found) && py.eq(py.at(found, -1).end, t))) {
      py.set(found, -1, py.replaced(py.at(found, -1), { end: u }));
    }
    else {
      py.append(found, new Stop(t, u, py.float(py.at(walk.head_position([t]), 0))));
    }
  }
  return py.tuple(found);
}
