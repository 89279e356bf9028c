// @ts-nocheck
// Made from analysis/posts.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { sure } from "./answer.js";
import { lengthOf, nearestOn, placeOn } from "./rings.js";
import { runningStretches } from "./running.js";

const APART = 5.0;
const EVERY = 25.0;
const JOINED = 3.0;
const FASTER = 1.02;
const MOST_RUNS = 5;
class Reason {
  constructor(why, value = NaN, time = NaN) {
    this.why = why;
    this.value = value;
    this.time = time;
  }
}
class Post {
  constructor(point, reasons) {
    this.point = point;
    this.reasons = reasons;
  }
}
export function marshalPosts(report, lines, entrances = []) {
  let n, near, place, reason, wanted;
  wanted = py.list(lines).map((_line) => []);
  for ([place, reason] of py.iter(_places(report, entrances))) {
    near = py.list(lines).map((line) => nearestOn(line, place));
    n = py.index(near, py.min(near));
    py.append(py.at(wanted, n), [py.at(py.at(near, n), 1), reason]);
  }
  return py.tuple(py.list(py.zip(lines, wanted)).flatMap(([line, some]) => py.list(_spaced(some, lengthOf(line))).map(([along, reasons]) => new Post(placeOn(line, along), reasons))));
}
function* _places(report, entrances) {
  let fastest, near, nearest, one, place, run;
  for (one of py.iter(report.obstacles)) {
    nearest = one.distance.witness;
    if (((one.obstacle.kind === "venue") && (nearest != null))) {
      yield [nearest.point, new Reason("venue", sure(one.distance, false))];
    }
  }
  for (place of py.iter(entrances)) {
    yield [place, new Reason("entrance")];
  }
  [near, fastest] = py.list([report.clearance.witness, report.greatest_speed.witness]);
  if (((near != null) && (near.time != null))) {
    yield [near.point, new Reason("tightest", sure(report.clearance, false), near.time)];
  }
  if (((fastest != null) && (fastest.time != null) && py.truth(_fastestStandsOut(report)))) {
    yield [fastest.point, new Reason("fastest", sure(report.greatest_speed, true), fastest.time)];
  }
  for (run of py.iter(_runs(report))) {
    yield [run.point, new Reason("run", run.speed, run.time)];
  }
}
function _fastestStandsOut(report) {
  let cut, speeds;
  cut = report.walk.profile.stretches(report.start, report.end);
  speeds = py.list(py.tolist(cut.speeds)).flatMap((ends) => py.list(ends).flatMap((speed) => (((speed > 0.0)) ? [speed] : [])));
  return (report.greatest_speed.value > (FASTER * py.min(speeds, undefined, Infinity)));
}
function _runs(report) {
  let fastest, found, near, others, runFrom;
  [fastest, runFrom] = py.list([report.greatest_speed, report.plan.people.run_from]);
  if ((fastest.upper < runFrom)) {
    return [];
  }
  found = runningStretches(report.walk, report.start, report.end, runFrom);
  near = fastest.witness;
  others = py.list(found).flatMap((one) => ((((near == null) || (py.dist(one.point, near.point) > APART))) ? [one] : []));
  return py.slice(others, null, MOST_RUNS);
}
function _spaced(wanted, length) {
  let along, end, ends, found, joined, parts, reason, reasons;
  joined = [];
  for ([along, reason] of py.iter(py.sorted(wanted, (one) => py.at(one, 0)))) {
    if ((py.truth(joined) && (py.sub(along, py.at(py.at(joined, -1), 0)) <= JOINED))) {
      py.append(py.at(py.at(joined, -1), 1), reason);
    }
    else {
      py.append(joined, [along, [reason]]);
    }
  }
  if (((py.len(joined) > 1) && (py.sub(py.add(py.at(py.at(joined, 0), 0), length), py.at(py.at(joined, -1), 0)) <= JOINED))) {
    py.extend(py.at(py.at(joined, 0), 1), py.at(py.pop(joined), 1));
  }
  if (!py.truth(joined)) {
    joined = [[0.0, [new Reason("line")]]];
  }
  found = [];
  ends = [...py.iter(py.list(py.slice(joined, 1, null)).map(([along, _reasons]) => along)), py.add(py.at(py.at(joined, 0), 0), length)];
  for ([[along, reasons], end] of py.iter(py.zip(joined, ends))) {
    py.append(found, [along, py.tuple(reasons)]);
    parts = py.ceil((py.sub(end, along) / EVERY));
    found = py.extend(found, py.list(py.range(1, parts)).map((k) => [py.mod(py.add(along, ((k * py.sub(end, along)) / parts)), length), [new Reason("line")]]));
  }
  return found;
}
