// @ts-nocheck
// Made from analysis/bench_walks.py by tools/make_twins.py; to make it again: make generate

import { _handles, _nearest, _seen } from "../compute/bench_walks.js";
import { InputError, brief } from "../compute/error_kinds.js";
import { ValueError, py } from "../compute/python.js";
import { _ } from "../words.js";
import { Bends, turningOf } from "./bends.js";
import { inOrder } from "./errors.js";
import { part, silent } from "./stages.js";

const BOX_COLUMNS = 6;
const PACES = ["wait", "walk", "hurry", "run"];
const SIDES = ["left", "right", "front", "rear"];
const STILL = 0.05;
const STEP = 0.125;
const MOST_LOOKED = 20000000;
class Stretch {
  constructor(start, end, turning, pace, way, angle, speeds) {
    this.start = start;
    this.end = end;
    this.turning = turning;
    this.pace = pace;
    this.way = way;
    this.angle = angle;
    this.speeds = speeds;
  }
}
class Tightest {
  constructor(time, bench, side, lower, upper, place) {
    this.time = time;
    this.bench = bench;
    this.side = side;
    this.lower = lower;
    this.upper = upper;
    this.place = place;
  }
}
export class BenchWalk {
  constructor(bench, place, heading, box, stretches, tightest, before, behind, left = /** @type {any} */ (null), right = /** @type {any} */ (null)) {
    this.bench = bench;
    this.place = place;
    this.heading = heading;
    this.box = box;
    this.stretches = stretches;
    this.tightest = tightest;
    this.before = before;
    this.behind = behind;
    this.left = left;
    this.right = right;
  }
}
export async function benchWalks(plan, walk = /** @type {any} */ (null), span = /** @type {any} */ (null), apart = 0.0, progress = silent) {
  return py.scoped(async () => {
    let _at, _boxes, _sides, at, bends, boxes, count, dragon, end, known, line, nearest, rows, sides, start, stretches, tightest, times;
    walk = ((walk == null) ? plan.build() : walk);
    [start, end] = py.list(_span(((span == null) ? plan.span(walk) : span)));
    [times, bends] = py.list([_times(walk, start, end), Bends.of(walk.route)]);
    [rows, dragon] = py.list([walk.route.rows, walk.dragon]);
    line = ({ rows: rows, links: dragon.links, sizes: dragon.sizes, bends: bends.at, sides: bends.sides, gates: _gates(plan) });
    known = (await _seen(walk, line, times, part(progress, 0.0, 0.8)));
    stretches = _stretches(bends, line, end, known);
    nearest = (await _nearest(walk, line, times, apart, known, part(progress, 0.8, 1.0)));
    tightest = py.list(nearest).map((row) => _tightest(walk, times, row));
    [[at, boxes, _sides], [_at, _boxes, sides]] = py.list(py.list([start, end]).map((time) => _stood(dragon, ...py.iter(_handles(walk, time)))));
    count = py.len(dragon);
    return py.tuple(py.list(py.range(count)).map((k) => new BenchWalk((k + 1), py.at(at, k), py.atan2(py.sub(py.at(py.at(at, k), 1), py.at(py.at(at, (k + 1)), 1)), py.sub(py.at(py.at(at, k), 0), py.at(py.at(at, (k + 1)), 0))), py.tuple(py.at(boxes, k)), py.tuple(py.at(stretches, k)), py.at(tightest, k), py.or(k, () => null), (((k + 1) < count) ? (k + 2) : null), ...py.iter(py.at(sides, k)))));
  });
}
function _span(span) {
  let end, start, text;
  try {
    [start, end] = py.list(span);
  } catch (error) {
    if (error instanceof TypeError || error instanceof ValueError) {
      text = _("span must be a pair of times, not {value}");
      throw new InputError(py.filled(text, { value: brief(span) }));
    } else
    throw error;
  }
  inOrder(start, end);
  return [start, end];
}
function _gates(plan) {
  let run;
  run = py.max(plan.people.run_from, STILL);
  return py.array([STILL, py.min(py.max(plan.people.hurry_from, STILL), run), run]);
}
function _times(walk, start, end) {
  let count, even, knots;
  count = py.min(py.ceil((py.sub(end, start) / STEP)), py.max(py.div(MOST_LOOKED, py.len(walk.dragon)), 2));
  knots = py.list(walk.profile.times).flatMap((time) => ((((start < time) && (time < end))) ? [time] : []));
  even = ((end > start) ? py.tolist(py.linspace(start, end, (count + 1))) : [start]);
  return py.array(py.sorted(py.set_of([...py.iter(even), ...py.iter(knots)])));
}
function _stretches(bends, line, end, known) {
  let angle, bench, found, out, pace, row, speeds, start, stretch, turning, until, way;
  out = py.empty([py.len(known.pieces), 9]);
  found = py.list(py.range(py.len(line.links))).map((_bench) => []);
  for (row of py.iter(py.tolist(py.slice(out, null, py.entry("bd_bench_walks_tell_stretches", line.rows, bends.turned, end, known, out)[0])))) {
    [bench, start, until, turning, pace, way, angle, ...speeds] = py.list(row);
    stretch = new Stretch(start, until, turningOf(turning), py.at(PACES, py.int(pace)), way, angle, [py.at(speeds, 0), py.at(speeds, 1)]);
    py.append(py.at(found, py.int(bench)), stretch);
  }
  return found;
}
function _tightest(walk, times, row) {
  let early, head, late, lower, other, side, time, upper, x, y;
  [other, side, lower, upper, head, early, late, x, y] = py.list(row);
  if (!py.truth(other)) {
    return null;
  }
  time = py.min(py.max(walk.time_at(head), py.at(times, py.int(early))), py.at(times, py.int(late)));
  return new Tightest(py.float(time), py.int(other), py.at(SIDES, py.int(side)), lower, upper, [x, y]);
}
function _stood(dragon, x, y) {
  let at, count, found, table;
  count = py.len(dragon);
  [table, found] = py.list([py.empty([count, BOX_COLUMNS]), py.empty([count, 2], "q")]);
  py.entry("bd_bench_nearness_find_beside", dragon.sizes, x, y, table, found);
  at = py.list(py.zip(py.tolist(x), py.tolist(y))).map(([ax, ay]) => [py.at(ax, 0), py.at(ay, 0)]);
  return [at, py.tolist(table), py.list(py.tolist(found)).map(([left, right]) => [py.or(left, () => null), py.or(right, () => null)])];
}
