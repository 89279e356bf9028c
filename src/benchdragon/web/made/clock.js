// @ts-nocheck
// Made from analysis/clock.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { TIME_OF_DAY } from "./signs.js";

const DAY = 86400.0;
export class Clock {
  constructor(said, start) {
    this.said = said;
    this.start = start;
  }
  tell(time) {
    let found, hours, more, past, seconds;
    found = TIME_OF_DAY.fullmatch(this.said);
    if (!py.truth(found)) {
      return minutes(py.sub(time, this.start));
    }
    [hours, past, more] = py.list(py.list(found.groups()).map((part) => py.int(py.or(part, () => 0))));
    seconds = py.mod(_whole(py.sub(py.add(py.add(py.add((3600 * hours), (60 * past)), more), time), this.start)), py.int(DAY));
    return `${py.str(py.div(seconds, 3600))}:${py.format(py.mod(py.div(seconds, 60), 60), `02d`)}:${py.format(py.mod(seconds, 60), `02d`)}`;
  }
  get legend() {
    if (!py.truth(this.said)) {
      return _("Times are minutes and seconds since the dance starts.");
    }
    return py.filled(_("Times are times of day; the dance starts at {clock}."), { clock: this.said });
  }
}
function minutes(seconds) {
  let whole;
  whole = _whole(seconds);
  return `${py.str(py.div(whole, 60))}:${py.format(py.mod(whole, 60), `02d`)}`;
}
export function lasting(seconds) {
  let rest, text, whole;
  [whole, rest] = py.list(py.divmod(_whole(seconds), 60));
  text = (py.truth(whole) ? _("{minutes} min {seconds} s") : _("{seconds} s"));
  return py.filled(text, { minutes: whole, seconds: rest });
}
function _whole(seconds) {
  return py.floor((seconds + 0.5));
}
