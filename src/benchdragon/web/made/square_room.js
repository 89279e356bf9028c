// @ts-nocheck
// Made from solve/square.py by tools/make_twins.py; to make it again: make generate

import { emptyPlacements } from "../compute/arrays.js";
import { InputError, UnsureError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { places } from "../compute/walk_facts.js";
import { _ } from "../words.js";
import { kindsOf } from "./bench_tables.js";
import { withAllRoom } from "./room_levels.js";

const BOX_COLUMNS = 6;
const GROUP = 16;
const STEP = 0.1;
const MOST_BOXES = 20000;
const DIGITS = 3;
const SPREAD = 1.2207440846057596;
const STREWN = 600;
const STARTS = 4;
const APART = 0.1;
const EDGE = 0.02;
const SHORTEST = 0.01;
const TRIALS = 600;
const PULL = 0.0001;
const WAYS = [[-1.0, -1.0, -1.0], [-1.0, -1.0, 0.0], [-1.0, -1.0, 1.0], [-1.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [-1.0, 0.0, 1.0], [-1.0, 1.0, -1.0], [-1.0, 1.0, 0.0], [-1.0, 1.0, 1.0], [0.0, -1.0, -1.0], [0.0, -1.0, 0.0], [0.0, -1.0, 1.0], [0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [0.0, 1.0, -1.0], [0.0, 1.0, 0.0], [0.0, 1.0, 1.0], [1.0, -1.0, -1.0], [1.0, -1.0, 0.0], [1.0, -1.0, 1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [1.0, 1.0, -1.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0]];
export class Square {
  constructor(plan, step = STEP) {
    [this.plan, this._danced] = py.list([plan, plan.without_street()]);
    [this.walk, this.obstacles] = py.list(withAllRoom(this._danced));
    if ((!py.truth(this.obstacles) || (this.venue.kind !== "venue"))) {
      throw new InputError(_("the plan has no venue to be placed in: add [venue]"));
    }
    this.step = step;
    this.evaluations = 0;
  }
  get venue() {
    return py.at(this.obstacles, 0);
  }
  _boxes_() {
    return laidBoxes(this.walk, this._danced.span(this.walk), this.step);
  }
  get boxes() {
    return py.keep(this, "boxes", this._boxes_());
  }
  _circles_() {
    let found;
    found = py.empty([py.ceil(((py.at(this.boxes.shape, 0) - 1) / GROUP)), (2 + 1)]);
    py.entry("bd_pose_clearance_bound_groups", this.boxes, found);
    return found;
  }
  get circles() {
    return py.keep(this, "circles", this._circles_());
  }
  __standing_() {
    return py.list(this.obstacles).map((one) => [one.boxes, py.array(py.tolist(one.outline)), one]);
  }
  get _standing() {
    return py.keep(this, "_standing", this.__standing_());
  }
  _middle_() {
    let highX, highY, lowX, lowY;
    [lowX, highX, lowY, highY] = py.list(this.extent(0.0));
    return [(0.5 * py.add(lowX, highX)), (0.5 * py.add(lowY, highY))];
  }
  get middle() {
    return py.keep(this, "middle", this._middle_());
  }
  extent(turned) {
    let found, out;
    out = py.empty(4);
    py.entry("bd_pose_clearance_extent", this.boxes, py.radians(turned), out);
    found = py.tolist(out);
    return found;
  }
  circle() {
    let found, out;
    out = py.empty(3);
    py.entry("bd_pose_clearance_smallest_circle", this.boxes, out);
    found = py.tolist(out);
    return found;
  }
  at(pose) {
    let turned, x, y;
    [x, y, turned] = py.list(this.placed(pose));
    return this.plan.with_values(py.dict([["route.at", [x, y]], ["route.turned", turned]]));
  }
  placed(pose) {
    let a, at, b, c, s, turned, x, y;
    [x, y, turned] = py.list(pose);
    [c, s] = py.list([py.cos(py.radians(turned)), py.sin(py.radians(turned))]);
    [a, b] = py.list(this.middle);
    at = [(py.round(py.add(py.sub(x, (c * a)), (s * b)), DIGITS) + 0.0), (py.round(py.sub(py.sub(y, (s * a)), (c * b)), DIGITS) + 0.0)];
    return [py.at(at, 0), py.at(at, 1), py.mod(py.round(py.mod(turned, 360.0), DIGITS), 360.0)];
  }
  room(pose) {
    let apart, one, outline, room, sides, turned, x, y;
    this.evaluations = py.extend(this.evaluations, 1);
    [x, y, turned] = py.list(this.placed(pose));
    room = Infinity;
    for ([sides, outline, one] of py.iter(this._standing)) {
      apart = py.entry("bd_pose_clearance_pose_clearance", this.boxes, this.circles, sides, one.sort, outline, one.radius, x, y, py.radians(turned), py.add(room, one.margin))[0];
      room = py.min(room, py.sub(apart, one.margin));
    }
    return room;
  }
  roomiest(progress) {
    let crowded, ends, far, low, n, pose, poses, shares, size, starts, steps;
    [low, size] = py.list(this._ranges);
    shares = py.list(py.range(STREWN)).map((n) => py.list(py.range(3)).map((k) => py.mod((0.5 + (n / (SPREAD ** (k + 1.0)))), 1.0)));
    poses = py.list(shares).map((share) => py.list(py.range(3)).map((k) => py.add(py.at(low, k), (py.at(size, k) * py.at(share, k)))));
    crowded = [];
    for ([n, pose] of py.iter(py.enumerate(poses))) {
      py.append(crowded, this.crowding(pose));
      progress(((0.5 * (n + 1)) / STREWN), "");
    }
    starts = [];
    for (n of py.iter(py.sorted(py.range(STREWN), (n) => [py.at(crowded, n), n]))) {
      far = py.list(starts).map((m) => py.max(py.list(py.range(3)).map((k) => py.abs(py.sub(py.at(py.at(shares, n), k), py.at(py.at(shares, m), k))))));
      if (((py.len(starts) < STARTS) && (py.min([1.0, ...py.iter(far)]) > APART))) {
        py.append(starts, n);
      }
    }
    steps = py.list(size).map((one) => (EDGE * one));
    ends = [];
    for (n of py.iter(starts)) {
      py.append(ends, descended(this, py.at(poses, n), steps));
      progress((0.5 + ((0.5 * py.len(ends)) / py.len(starts))), "");
    }
    return py.at(py.min(ends), 1);
  }
  crowding(pose) {
    let away, low, size;
    [low, size] = py.list(this._ranges);
    away = py.list(py.range(2)).map((k) => py.sub(py.sub(py.at(pose, k), py.at(low, k)), (0.5 * py.at(size, k))));
    return py.sub((PULL * py.hypot(py.at(away, 0), py.at(away, 1))), this.room(pose));
  }
  __ranges_() {
    let xs, ys;
    [xs, ys] = py.list(py.list([0, 1]).map((k) => py.list(py.tolist(this.venue.outline)).map((corner) => py.at(corner, k))));
    return [[py.min(xs), py.min(ys), 0.0], [py.sub(py.max(xs), py.min(xs)), py.sub(py.max(ys), py.min(ys)), 360.0]];
  }
  get _ranges() {
    return py.keep(this, "_ranges", this.__ranges_());
  }
}
function descended(crowded, pose, steps, trials = TRIALS) {
  let best, better, found, low, share, there, tried, way, ways;
  [low, share, ways, tried] = py.list([crowded.crowding(pose), 1.0, py.list(WAYS), 1]);
  best = py.list(pose);
  while (((share > SHORTEST) && (tried < trials))) {
    better = null;
    for (way of py.iter(ways)) {
      there = py.list(py.range(3)).map((k) => py.add(py.at(best, k), ((share * py.at(steps, k)) * py.at(way, k))));
      found = crowded.crowding(there);
      tried = py.extend(tried, 1);
      if ((found < low)) {
        [low, best, better] = py.list([found, there, way]);
        break;
      }
    }
    if ((better == null)) {
      share = (share * 0.5);
    }
    else {
      ways = [better, ...py.iter(py.list(ways).flatMap((way) => ((!py.eq(way, better)) ? [way] : [])))];
    }
  }
  return [low, best];
}
function laidBoxes(walk, span, step) {
  let _width, at, boxes, first, front, fronts, k, kind, kinds, length, link, long, numbers, rear, scratch, stretches, ways;
  [kind, kinds] = py.list(kindsOf(walk.dragon.sizes));
  ways = py.list(py.zip(...py.iter(py.list(places(walk, ...py.iter(span))).map((one) => py.slice(one, null, -1)))));
  numbers = py.tolist(kind);
  stretches = py.list(py.range(py.at(kinds.sizes.shape, 1))).map((k) => _merged(py.list(py.zip(ways, numbers)).flatMap(([way, number]) => ((py.eq(number, k)) ? [way] : []))));
  long = py.sum(py.list(stretches).flatMap((some) => py.list(some).map(([low, high]) => py.sub(high, low))));
  step = py.max(step, (long / MOST_BOXES));
  fronts = py.list(stretches).map((some) => py.list(some).flatMap(([low, high]) => py.list(_steps(low, high, step)).map((s) => s)));
  boxes = py.zeros([(py.sum(py.list(fronts).map((one) => py.len(one))) + 1), BOX_COLUMNS]);
  first = 0;
  for ([k, at] of py.iter(py.enumerate(fronts))) {
    [length, _width, front, rear] = py.list(py.list(py.tolist(kinds.sizes)).map((row) => py.at(row, k)));
    scratch = emptyPlacements(2, py.len(at));
    link = py.array([py.sub(py.sub(length, front), rear)]);
    if (!py.truth(py.entry("bd_pose_clearance_lay_boxes", walk.route.rows, link, kinds.sizes, k, py.array(at), scratch, first, boxes)[0])) {
      throw py.or(walk.first_failure(walk.head_position(span)), () => new UnsureError(_("a bench finds no place somewhere on its way: use gentler bends or shorter benches")));
    }
    first = py.extend(first, py.len(at));
  }
  return boxes;
}
function _merged(spans) {
  let found, high, low;
  found = [];
  for ([low, high] of py.iter(py.sorted(spans))) {
    if ((py.truth(found) && (low <= py.at(py.at(found, -1), 1)))) {
      py.set(found, -1, [py.at(py.at(found, -1), 0), py.max(py.at(py.at(found, -1), 1), high)]);
    }
    else {
      py.append(found, [low, high]);
    }
  }
  return found;
}
function _steps(low, high, step) {
  let count;
  count = py.max(1, py.ceil((py.sub(high, low) / step)));
  return py.list(py.range((count + 1))).map((n) => py.add(low, ((py.sub(high, low) * n) / count)));
}
