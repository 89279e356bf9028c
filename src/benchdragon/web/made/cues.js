// @ts-nocheck
// Made from plans/cues.py by tools/make_twins.py; to make it again: make generate

import { brief } from "../compute/error_kinds.js";
import { ValueError, py } from "../compute/python.js";
import { N_, _, language } from "../words.js";
import { Hold, HoldError, withHolds } from "./holds.js";
import { TIME_OF_DAY, narrow } from "./signs.js";
import { Fault, KeyedError } from "./source.js";

const SAME_PLACE = 1e-09;
const PRUDENCE = 1e-09;
const END_SLACK = 1e-06;
const NAMES = py.dict([["beat", N_("drum")], ["hold", N_("hold")], ["stop", N_("stop")], ["start", N_("start")], ["tempo", N_("tempo")], ["note", N_("note")]]);
const TROUBLE = py.dict([["overlap", N_("the head still stands for another cue then: set them farther apart")], ["room", N_("to stand there the head would have to brake harder than {rate} m/s^2: set it later")], ["unreachable", N_("the head never comes there")], ["outside", N_("that is before the dance starts, at {start} s")], ["over", N_("the dance is over by then: the head has stopped, and no start comes after")]]);
const MIDNIGHT = py.pattern("24:00(?::00)?", "");
export function timeOfDay(text) {
  text = narrow(text);
  if (py.truth(MIDNIGHT.fullmatch(text))) {
    return "0:00";
  }
  if ((py.truth(text) && !py.truth(TIME_OF_DAY.fullmatch(text)))) {
    throw new ValueError(py.filled(_("expected a time of day such as 18:30, not {text}"), { text: brief(text) }));
  }
  return text;
}
export function checkCue(cue) {
  let name, placed, text;
  placed = ((cue.place != null) || (cue.round != null));
  if ((py.count([(cue.at != null), (cue.head != null), placed], true) !== 1)) {
    text = _("a cue needs one of these: at (a time), head (a way), place or round");
    throw new ValueError(text);
  }
  if (((cue.kind === "start") && (cue.at == null))) {
    throw new ValueError(_("a start needs at, a time: the head stands until then"));
  }
  for (name of py.iter(["hold", "tempo"])) {
    if (!py.eq((cue[name] != null), py.eq(cue.kind, name))) {
      text = _("a cue needs {name} if its kind is {name}, and else has none");
      throw new ValueError(py.filled(text, { name: name }));
    }
  }
}
export function cueName(cue) {
  let own;
  own = ((language() === "zh") ? py.or(cue.text_zh, () => cue.text) : py.or(cue.text, () => cue.text_zh));
  return py.or(own, () => _(py.at(NAMES, cue.kind)));
}
export class Moment {
  constructor(number, cue, time, way, until) {
    this.number = number;
    this.cue = cue;
    this.time = time;
    this.way = way;
    this.until = until;
  }
}
export class Paced {
  constructor(profile, start, standings, heads = []) {
    this.profile = profile;
    this.start = start;
    this.standings = standings;
    this.heads = heads;
  }
  get end() {
    let last;
    last = (py.truth(this.standings) ? py.at(this.standings, -1) : null);
    return (((last == null) || (last.end < Infinity)) ? Infinity : last.start);
  }
  way(time) {
    return py.float(py.sub(this.profile.distance(time), this.profile.distance(this.start)));
  }
  moments(cues) {
    let cue, found, head, held, n, time, until, way;
    held = py.dict(py.list(this.standings).map((one) => [one.number, one]));
    found = [];
    for ([n, cue] of py.iter(py.enumerate(cues.cue))) {
      if (py.has(held, n)) {
        [time, way, until] = py.list([py.at(held, n).start, py.at(held, n).way, py.at(held, n).end]);
      }
      else {
        head = py.at(this.heads, n);
        time = this._time(cue.at, head);
        way = ((head == null) ? this.way(time) : head);
        until = time;
      }
      py.append(found, new Moment(n, cue, time, way, until));
    }
    return py.tuple(py.sorted(found, (one) => [one.time, one.number]));
  }
  _time(at, head) {
    let here;
    if ((head == null)) {
      return ((at == null) ? 0.0 : at);
    }
    here = py.list(this.standings).flatMap((one) => (((py.abs(py.sub(one.way, head)) <= SAME_PLACE)) ? [one.start] : []));
    if (py.truth(here)) {
      return py.at(here, 0);
    }
    return py.max(this.profile.time(py.add(head, py.float(this.profile.distance(this.start)))), this.start);
  }
}
export function paced(cues, heads, profile, start, limits) {
  let asked, found, holding, holds, rate, standings, starts, stood, text, times;
  rate = ((cues.acceleration == null) ? limits.head_acceleration : cues.acceleration);
  if ((rate > limits.head_acceleration)) {
    text = _("at most limits.head_acceleration, {limit} m/s^2, is allowed, not {rate}");
    text = py.filled(text, { limit: `${py.format(limits.head_acceleration, `g`)}`, rate: `${py.format(rate, `g`)}` });
    throw new KeyedError([new Fault("cues.acceleration", text)]);
  }
  holding = py.list(py.enumerate(cues.cue)).flatMap(([n, cue]) => ((py.has(["hold", "stop"], cue.kind)) ? [n] : []));
  asked = py.list(holding).map((n) => py.at(cues.cue, n));
  holds = py.list(py.zip(holding, asked)).map(([n, cue]) => new Hold(py.at(heads, n), cue.at, py.or(cue.hold, () => Infinity)));
  starts = py.list(py.enumerate(cues.cue)).flatMap(([n, cue]) => ((((cue.kind === "start") && (cue.at != null))) ? [[n, cue.at]] : []));
  times = py.list(starts).map(([_number, time]) => time);
  try {
    [found, stood] = py.list(withHolds(profile, start, holds, times, (rate * (1.0 - PRUDENCE))));
  } catch (error) {
    if (error instanceof HoldError) {
      text = py.filled(_(py.at(TROUBLE, error.trouble)), { rate: `${py.format(rate, `g`)}`, start: `${py.format(start, `g`)}` });
      throw new KeyedError([new Fault(`cues.cue.${py.str(py.at(holding, error.number))}`, text)]);
    } else
    throw error;
  }
  _refuseIdle(starts, py.set_of(py.list(stood).flatMap((one) => ((py.eq(py.at(holds, one.number).seconds, Infinity)) ? [one.end] : []))));
  standings = py.tuple(py.list(stood).map((one) => py.replaced(one, { number: py.at(holding, one.number) })));
  return new Paced(found, start, standings, heads);
}
function _refuseIdle(starts, used) {
  let faults, n, seen, text, time;
  text = _("the head does not stand and wait then: a start needs a stop before it, and its own");
  seen = py.set_of();
  faults = [];
  for ([n, time] of py.iter(starts)) {
    if ((!py.has(used, time) || py.has(seen, time))) {
      py.append(faults, new Fault(`cues.cue.${py.str(n)}`, text));
    }
    py.add(seen, time);
  }
  if (py.truth(faults)) {
    throw new KeyedError(faults);
  }
}
export function outside(moments, start, end, way) {
  let byPlace, byTime;
  byTime = _("that is not within the dance, which lasts from {start} s to {end} s");
  byTime = py.filled(byTime, { start: `${py.format(start, `g`)}`, end: `${py.format(end, `.6g`)}` });
  byPlace = _("that is not within the dance, in which the head walks {way} m");
  byPlace = py.filled(byPlace, { way: `${py.format(way, `.6g`)}` });
  return py.list(moments).flatMap((one) => ((!((start <= one.time) && (one.time <= py.add(end, END_SLACK)))) ? [new Fault(`cues.cue.${py.str(one.number)}`, ((one.cue.at == null) ? byPlace : byTime))] : []));
}
