// @ts-nocheck
// Made from analysis/timetable.py by tools/make_twins.py; to make it again: make generate

import { mustStand } from "../compute/nearby.js";
import { py } from "../compute/python.js";
import { places } from "../compute/walk_facts.js";
import { N_, _ } from "../words.js";
import { Bends } from "./bends.js";
import { cueName } from "./cues.js";
import { Spiral } from "./curves.js";
import { inOrder } from "./errors.js";
import { named } from "./findings.js";
import { Obstacle } from "./obstacle.js";
import { nearestBoxes } from "./obstacle_distance.js";

const askedOf = (of, start, end, walk = of) => [walk, start, end];
const asTable = (rows) => rows;
const MOST_JOINTS = 60;
const FINE = 0.1;
const MOST_LOOKS = 50000;
const NEAR = 1e-06;
const FINER = 21;
const BENDS = py.dict([[["left", "right"], N_("left bend becomes right bend")], [["right", "left"], N_("right bend becomes left bend")], [["straight", "left"], N_("straight becomes left bend")], [["straight", "right"], N_("straight becomes right bend")], [["left", "straight"], N_("left bend becomes straight")], [["right", "straight"], N_("right bend becomes straight")]]);
class Passing {
  constructor(kind, name, s, way, point, head, until, tail) {
    this.kind = kind;
    this.name = name;
    this.s = s;
    this.way = way;
    this.point = point;
    this.head = head;
    this.until = until;
    this.tail = tail;
  }
}
export function timetable(plan, walk = /** @type {any} */ (null), start = /** @type {any} */ (null), end = /** @type {any} */ (null)) {
  let first, joints, last, rows, span, time;
  [walk, start, end] = py.list(askedOf(plan, start, end, walk));
  inOrder(start, end);
  for (time of py.iter([start, end])) {
    mustStand(walk, time);
  }
  [span, [first, last]] = py.list([[start, end], py.tolist(walk.head_position([start, end]))]);
  rows = [_passing(walk, span, "start", _("the head sets out"), first)];
  joints = _joints(plan, walk, last);
  if ((py.len(joints) <= MOST_JOINTS)) {
    rows = py.extend(rows, py.list(joints).map(([name, s]) => _passing(walk, span, "joint", name, s)));
  }
  rows = py.extend(rows, py.list(plan.moments()).map((one) => _cue(walk, span, one, first)));
  rows = py.extend(rows, _beside(plan, walk, span));
  py.append(rows, _passing(walk, span, "end", _("the head at the end"), last));
  rows = py.sorted(rows, (row) => [row.s, (row.kind === "end"), py.or(row.head, () => 0.0)]);
  return py.tuple(py.list(rows).flatMap((row) => ((((row.head != null) || (row.tail != null))) ? [row] : [])));
}
function _joints(plan, walk, last) {
  let before, begun, behind, bends, ended, found, joints, n, name, numbered, often, rounds, s;
  [bends, joints] = py.list([Bends.of(walk.route), py.tolist(py.slice(walk.route.joints, 1, -1))]);
  found = [];
  often = py.dict([]);
  rounds = 1;
  for ([n, s] of py.iter(py.enumerate(joints, 1))) {
    [before, behind] = py.list([bends.turning(py.sub(s, NEAR)), bends.turning(py.add(s, NEAR))]);
    name = (!py.eq(before, behind) ? _(py.at(BENDS, [before, behind])) : "");
    if ((plan.route.kind === "turn")) {
      [ended, begun] = py.list([py.at(walk.route.curves, (n - 1)), py.at(walk.route.curves, n)]);
      name = py.or(_inRounds(ended, begun, rounds), () => name);
      rounds = py.extend(rounds, (((ended instanceof Spiral) && !py.truth(ended.inward)) ? 1 : 0));
    }
    if ((py.truth(name) && (s < last))) {
      py.set(often, name, (py.get(often, name, 0) + 1));
      py.append(found, [name, py.at(often, name), s]);
    }
  }
  numbered = _("{name} ({n})");
  return py.list(found).map(([name, n, s]) => [((py.at(often, name) > 1) ? py.filled(numbered, { name: name, n: n }) : name), s]);
}
function _inRounds(ended, begun, rounds) {
  if ((ended instanceof Spiral)) {
    return (py.truth(ended.inward) ? _("the turn begins") : _("the head goes back"));
  }
  if ((begun instanceof Spiral)) {
    return (py.truth(begun.inward) ? py.filled(_("round {n} begins"), { n: rounds }) : _("the turn ends"));
  }
  return "";
}
function _passing(walk, span, kind, name, s) {
  let _flat, first, head, x, y;
  first = py.float(py.at(walk.head_position([py.at(span, 0)]), 0));
  head = ((s > first) ? _within(walk.time_at(s), span) : (py.eq(s, first) ? py.at(span, 0) : null));
  head = ((kind === "end") ? py.at(span, 1) : head);
  [[x, y, ..._flat]] = py.list(py.tolist(_spots(walk.route, [py.min(s, walk.route.length)])));
  return new Passing(kind, name, s, py.sub(s, first), [x, y], head, head, _tailTime(walk, s, span));
}
function _within(time, span) {
  return (((py.at(span, 0) <= time) && (time <= py.at(span, 1))) ? time : null);
}
function _tailTime(walk, s, span) {
  let begins, ends;
  [begins, ends] = py.list(py.list(places(walk, ...py.iter(span))).map((handles) => py.at(handles, -1)));
  if (!((begins <= s) && (s <= py.add(ends, NEAR)))) {
    return null;
  }
  return py.min(py.max(walk.time_at(walk.head_where_tail(py.min(s, ends))), py.at(span, 0)), py.at(span, 1));
}
function _cue(walk, span, one, first) {
  let place, until;
  place = _passing(walk, span, "cue", cueName(one.cue), py.add(first, one.way));
  until = py.min(one.until, py.at(span, 1));
  return new Passing("cue", place.name, place.s, one.way, place.point, one.time, until, place.tail);
}
function* _beside(plan, walk, span) {
  let entrance, first, last, looks, n, name, obstacle, place, s, tail, ways;
  [first, last] = py.list(py.list(py.tolist(walk.head_position(span))).map((s) => py.min(s, walk.route.length)));
  looks = _even(first, last, FINE);
  for (obstacle of py.iter(plan.obstacles())) {
    if ((obstacle.kind === "venue")) {
      for (s of py.iter(_entered(walk.route, obstacle, looks))) {
        name = py.filled(_("entrance of {name}"), { name: named(obstacle) });
        yield _passing(walk, span, "entrance", name, s);
      }
    }
    else {
      name = py.filled(_("the head nearest to {name}"), { name: named(obstacle) });
      yield _passing(walk, span, "obstacle", name, _nearest(_apart(walk.route, obstacle), looks));
    }
  }
  tail = py.at(py.at(places(walk, py.at(span, 0)), 0), -1);
  ways = [...py.iter(py.slice(_even(tail, first, FINE), null, -1)), ...py.iter(looks)];
  for ([n, place] of py.iter(py.enumerate(plan.event.places, 1))) {
    name = py.filled(_("the dragon's way nearest to entrance {n}"), { n: n });
    entrance = new Obstacle("", "circle", asTable([place]));
    yield _passing(walk, span, "entrance", name, _nearest(_apart(walk.route, entrance), ways));
  }
}
function _even(first, last, step) {
  let count;
  count = py.max(2, py.min(MOST_LOOKS, (py.ceil((py.sub(last, first) / step)) + 1)));
  return py.list(py.linspace(first, last, count)).map((s) => py.float(s));
}
function _spots(route, looks) {
  let found;
  found = py.empty([py.len(looks), 4]);
  py.entry("bd_route_evaluate", route.rows, py.array(looks), found);
  return py.array(py.list(py.tolist(found)).map(([x, y, ..._turned]) => [x, y, 1.0, 0.0, 0.0, 0.0]));
}
function _entered(route, venue, looks) {
  let found, left, middle, n, outside, right, seen, within;
  function out(some) {
    return py.list(venue.forbids(_spots(route, some))).map((one) => py.bool(one));
  }
  [found, seen] = py.list([[], out(looks)]);
  for ([n, [left, right]] of py.iter(py.enumerate(py.pairwise(seen)))) {
    if ((py.truth(left) && !py.truth(right))) {
      [outside, within] = py.list([py.at(looks, n), py.at(looks, (n + 1))]);
      while ((py.sub(within, outside) > NEAR)) {
        middle = (0.5 * py.add(outside, within));
        if (py.truth(py.at(out([middle]), 0))) {
          outside = middle;
        }
        else {
          within = middle;
        }
      }
      py.append(found, within);
    }
  }
  return found;
}
function _apart(route, obstacle) {
  function apart(looks) {
    let _which, far, found;
    [far, _which] = py.list(nearestBoxes(_spots(route, looks), obstacle));
    found = py.tolist(far);
    return found;
  }
  return apart;
}
function _nearest(apart, looks) {
  let away, high, low, n;
  while (true) {
    away = apart(looks);
    n = py.index(away, py.min(away));
    [low, high] = py.list([py.at(looks, py.max((n - 1), 0)), py.at(looks, py.min((n + 1), (py.len(looks) - 1)))]);
    if ((py.sub(high, low) <= NEAR)) {
      return py.at(looks, n);
    }
    looks = py.list(py.linspace(low, high, FINER)).map((s) => py.float(s));
  }
}
