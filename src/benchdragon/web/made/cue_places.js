// @ts-nocheck
// Made from plans/cue_places.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { Fault, KeyedError } from "./source.js";

const STEP = 0.1;
const ALIKE = 1e-06;
const MOST_SAMPLES = 100000;
const BESIDE = 10.0;
const HALVINGS = 44;
export function headsOf(cues, route, first, last) {
  let at, begun, cue, found, key, n, span, text;
  begun = _begun(route.rows, first);
  found = [];
  for ([n, cue] of py.iter(py.enumerate(cues))) {
    key = `cues.cue.${py.str(n)}`;
    if (((cue.round != null) && (cue.round > py.len(begun)))) {
      text = py.filled(_("the dance has {count} rounds"), { count: py.len(begun) });
      throw new KeyedError([new Fault(`${py.str(key)}.round`, text)]);
    }
    if (((cue.place == null) && (cue.round == null))) {
      py.append(found, cue.head);
      continue;
    }
    span = [first, last];
    if ((cue.round != null)) {
      span = [py.at(begun, (cue.round - 1)), py.min([last, ...py.iter(py.slice(begun, cue.round, (cue.round + 1)))])];
    }
    if (((cue.place != null) && (py.at(span, 0) > last))) {
      text = py.filled(_("the walk ends before round {round} begins"), { round: cue.round });
      throw new KeyedError([new Fault(`${py.str(key)}.round`, text)]);
    }
    at = ((cue.place == null) ? py.at(span, 0) : _nearest(cue.place, route.rows, span, `${py.str(key)}.place`));
    py.append(found, py.max(py.sub(at, first), 0.0));
  }
  return found;
}
function _begun(rows, first) {
  let ahead, inward, spirals;
  spirals = py.list(py.tolist(rows)).flatMap((row) => ((py.eq(py.at(row, 0), 3.0)) ? [row] : []));
  inward = py.list(spirals).flatMap((row) => (((py.at(row, 5) < py.at(row, 4))) ? [row] : []));
  ahead = py.list(inward).flatMap((row) => (((py.at(row, 2) >= first)) ? [py.at(row, 2)] : []));
  return (py.eq(py.len(ahead), py.len(inward)) ? ahead : [first, ...py.iter(ahead)]);
}
function _away(place, rows, ways) {
  let poses;
  poses = py.empty([py.len(ways), 4]);
  py.entry("bd_route_evaluate", rows, py.array(py.list(ways)), poses);
  return py.list(py.tolist(poses)).map(([x, y, _heading, _bend]) => py.hypot(py.sub(x, py.at(place, 0)), py.sub(y, py.at(place, 1))));
}
function _nearest(place, rows, span, key) {
  let away, best, count, ends, high, low, lows, near, step, text, ways;
  low = py.max(py.at(span, 0), py.at(py.at(py.tolist(rows), 0), 2));
  high = py.max(py.at(span, 1), low);
  count = py.max(2, py.min(MOST_SAMPLES, py.ceil((py.sub(high, low) / STEP))));
  step = (py.sub(high, low) / count);
  ways = py.add(py.list(py.range(count)).map((n) => py.add(low, (step * n))), [high]);
  away = _away(place, rows, ways);
  near = py.add(py.min(away), step);
  lows = py.list(py.range((count + 1))).flatMap((n) => ((((py.at(away, n) <= near) && (py.at(away, n) <= py.min(py.at(away, py.max((n - 1), 0)), py.at(away, py.min((n + 1), count)))))) ? [n] : []));
  ends = py.list(lows).map((n) => _descended(place, rows, py.at(ways, n), step, [low, high]));
  best = py.min(py.list(ends).map(([distance, _way]) => distance));
  if ((best > BESIDE)) {
    text = py.filled(_("the head comes no nearer to that place than {away} m"), { away: `${py.format(best, `.1f`)}` });
    throw new KeyedError([new Fault(key, text)]);
  }
  return py.next(py.list(ends).flatMap(([distance, way]) => (((distance <= py.add(best, ALIKE))) ? [way] : [])));
}
function _descended(place, rows, way, step, span) {
  let _halving, high, low, middle;
  [low, high] = py.list([py.max(py.at(span, 0), py.sub(way, step)), py.min(py.at(span, 1), py.add(way, step))]);
  for (_halving of py.iter(py.range(HALVINGS))) {
    middle = (0.5 * py.add(low, high));
    if (py.truth(_approaches(place, rows, middle))) {
      low = middle;
    }
    else {
      high = middle;
    }
  }
  return [py.at(_away(place, rows, [high]), 0), high];
}
function _approaches(place, rows, way) {
  let _bend, heading, pose, x, y;
  pose = py.empty([1, 4]);
  py.entry("bd_route_evaluate", rows, py.array([way]), pose);
  [[x, y, heading, _bend]] = py.list(py.tolist(pose));
  return (py.add((py.sub(x, py.at(place, 0)) * py.cos(heading)), (py.sub(y, py.at(place, 1)) * py.sin(heading))) < 0.0);
}
