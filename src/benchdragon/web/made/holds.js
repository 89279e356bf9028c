// @ts-nocheck
// Made from model/holds.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { SpeedProfile } from "./profile.js";

const HOLD_COUNTS = 4;
const HOLD_COLUMNS = 3;
const KNOT_COLUMNS = 3;
const STOOD_COLUMNS = 4;
const TROUBLES = ["overlap", "room", "unreachable", "outside", "over"];
const KNOTS = 6;
export class Hold {
  constructor(way = /** @type {any} */ (null), at = /** @type {any} */ (null), seconds = Infinity) {
    this.way = way;
    this.at = at;
    this.seconds = seconds;
  }
}
export class HoldError extends InputError {
  constructor(number, trouble) {
    super(trouble);
    this.number = number;
    this.trouble = trouble;
  }
}
class Standing {
  constructor(number, way, start, end) {
    this.number = number;
    this.way = way;
    this.start = start;
    this.end = end;
  }
}
export function withHolds(profile, start, holds, starts, rate) {
  let asked, count, counts, held, knots, pieces, room, speeds, stood, times, trouble;
  [pieces, count] = py.list([_pieces(profile, start), py.len(holds)]);
  asked = py.list(holds).map((hold) => [_orInf(hold.way), _orInf(hold.at), hold.seconds]);
  [room, counts] = py.list([(KNOTS * (py.add(py.len(pieces), count) + 1)), py.zeros(HOLD_COUNTS, "q")]);
  py.set(counts, 3, 1);
  while (py.truth(py.at(counts, 3))) {
    held = ({ pieces: py.array(pieces), starts: py.array(py.sorted(starts), "d"), holds: py.reshape(py.array(asked, "d"), -1, HOLD_COLUMNS), knots: py.empty([room, KNOT_COLUMNS]), stood: py.empty([count, STOOD_COLUMNS]), waiting: py.empty(count, "q"), counts: counts });
    trouble = py.entry("bd_holds_hold_head", held, start, rate)[0];
    room = (room * 2);
  }
  if (!py.eq(trouble, 0)) {
    throw new HoldError(py.int(py.at(counts, 2)), py.at(TROUBLES, (trouble - 1)));
  }
  knots = py.tolist(py.slice(held.knots, null, py.at(counts, 0)));
  stood = py.list(py.tolist(held.stood)).map(([number, way, since, until]) => new Standing(py.int(number), way, since, until));
  [times, speeds] = py.list([py.list(knots).map(([time, _way, _speed]) => time), py.list(knots).map(([_time, _way, speed]) => speed)]);
  return [new SpeedProfile(py.tuple(times), py.tuple(speeds)), stood];
}
function _pieces(profile, start) {
  let _rates, a, b, end, first, found, since, speeds, square, times, until, v, w, ways;
  end = py.max(py.at(profile.times, -1), start);
  [times, ways, speeds, _rates] = py.list(profile.stretches(start, end));
  [first, found] = py.list([py.at(ways, [0, 0]), []]);
  for ([[since, until], [a, b], [v, w]] of py.iter(py.zip(py.tolist(times), py.tolist(ways), py.tolist(speeds)))) {
    py.append(found, [py.sub(a, first), py.sub(b, first), (v * v), (w * w), ((b > a) ? 0.0 : py.sub(until, since))]);
  }
  square = (py.float(profile.speed(end)) ** 2);
  return [...py.iter(found), [py.at(py.at(found, -1), 1), Infinity, square, square, 0.0]];
}
function _orInf(value) {
  return ((value == null) ? Infinity : value);
}
