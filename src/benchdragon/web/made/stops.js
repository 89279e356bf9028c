// @ts-nocheck
// Made from analysis/stops.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { _ } from "../words.js";

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
function stopsText(stops, clock = /** @type {any} */ (null)) {
  let ends, seconds, text, times;
  if (!py.truth(stops)) {
    return _("the head does not stop");
  }
  function tell(time) {
    return ((clock == null) ? `${py.format(time, `.6g`)} s` : clock.tell(time));
  }
  ends = _("{start} to {end}");
  times = py.join(_(", "), py.list(stops).map((one) => py.filled(ends, { start: tell(one.start), end: tell(one.end) })));
  seconds = py.sum(py.list(stops).map((one) => py.sub(one.end, one.start)));
  text = _("stops of the head: {count}, {seconds} s in all ({times})");
  return py.filled(text, { count: py.len(stops), seconds: `${py.format(seconds, `.6g`)}`, times: times });
}
export function stopsSentence(stops, clock) {
  let text;
  text = py.filled(_("{all}."), { all: stopsText(stops, clock) });
  return py.add(py.upper(py.slice(text, null, 1)), py.slice(text, 1, null));
}
