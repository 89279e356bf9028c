// @ts-nocheck
// Made from analysis/chalk.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { Crossing, Line } from "./chalk_line.js";
import { positive } from "./errors.js";

const LEAST_STRAY = 0.05;
const SAME = 0.02;
const SPOKES = [8, 12, 16];
const SHARE = 0.5;
const LEG = 50.0;
const MOST_ASIDE = 4.0;
const MOST_TICKS = 2000;
const MOST_WAY = 20000.0;
const WHEEL = 10.0;
const ARM = 5.0;
class Star {
  constructor(stake, place, spokes, reach, wheel, chord) {
    this.stake = stake;
    this.place = place;
    this.spokes = spokes;
    this.reach = reach;
    this.wheel = wheel;
    this.chord = chord;
  }
}
class Leg {
  constructor(start, end, place, way, length, swing) {
    this.start = start;
    this.end = end;
    this.place = place;
    this.way = way;
    this.length = length;
    this.swing = swing;
  }
}
class Tick {
  constructor(s, point, star, tape, along, aside, out, kind) {
    this.s = s;
    this.point = point;
    this.star = star;
    this.tape = tape;
    this.along = along;
    this.aside = aside;
    this.out = out;
    this.kind = kind;
  }
  *[Symbol.iterator]() {
    yield* [this.s, this.point, this.star, this.tape, this.along, this.aside, this.out, this.kind];
  }
}
class Met {
  constructor(obstacle, star, tapes) {
    this.obstacle = obstacle;
    this.star = star;
    this.tapes = tapes;
  }
  *[Symbol.iterator]() {
    yield* [this.obstacle, this.star, this.tapes];
  }
}
class ChalkPlan {
  constructor(stars, legs, ticks, met, allowed, stray) {
    this.stars = stars;
    this.legs = legs;
    this.ticks = ticks;
    this.met = met;
    this.allowed = allowed;
    this.stray = stray;
  }
}
export function chalkPlan(trail, link, peg, said = /** @type {any} */ (null), obstacles = []) {
  let allowed, found, ground, legs, line, met, n, once, star, stars, stray, street, tapes, text, ticks, told;
  allowed = ((said == null) ? (SHARE * positive("link", link, "m")) : said);
  ground = _ground(peg);
  if (!((LEAST_STRAY <= allowed) && (allowed < Infinity))) {
    text = _("the chalk line may stray by at least {least} m between ticks, not {value} m");
    throw new InputError(py.filled(text, { least: `${py.format(LEAST_STRAY, `g`)}`, value: `${py.format(allowed, `g`)}` }));
  }
  if ((py.sub(trail.high, trail.low) > MOST_WAY)) {
    return null;
  }
  line = new Line(trail, ground.peg);
  stars = py.list(py.range(py.len(line.stakes))).map((n) => _star(line, n, ground, allowed));
  found = _crossings(line, trail, stars, ground.turned);
  found = _filled(line, found, allowed);
  if ((py.len(found) > MOST_TICKS)) {
    return null;
  }
  stray = py.max([0.0, ...py.iter(py.list(py.pairwise(found)).map(([one, after]) => line.stray(one.s, after.s)))]);
  ticks = _ticks(line, stars, found, ground);
  legs = [];
  told = py.list(ticks).flatMap((one) => (((one.star >= 0)) ? [one] : []));
  for (street of py.iter(_streets(ticks))) {
    told = py.extend(told, _along(street, legs, ground));
  }
  once = _once(py.sorted(told, (one) => one.s));
  for ([n, star] of py.iter(py.enumerate(stars))) {
    once = _inAndOut(once, n, star.spokes);
  }
  met = [];
  for (n of py.iter(py.range(-1, py.len(stars)))) {
    tapes = ((n < 0) ? _tapes(legs) : _spokes(py.at(stars, n), ground.turned, once, n));
    met = py.extend(met, _met(obstacles, n, tapes));
  }
  return new ChalkPlan(py.tuple(stars), py.tuple(legs), py.tuple(once), py.tuple(met), allowed, stray);
}
const _ground = (ground) => ground;
function _star(line, n, ground, allowed) {
  let chord, enough, reach, spokes, stake, wheel;
  [reach, stake] = py.list([line.reach(n), py.at(line.stakes, n)]);
  enough = py.list(SPOKES).flatMap((spokes) => (((((0.125 * reach) * (((2.0 * Math.PI) / spokes) ** 2)) <= allowed)) ? [spokes] : []));
  spokes = (py.truth(enough) ? py.at(enough, 0) : py.at(SPOKES, -1));
  wheel = py.min(py.max(py.float(py.floor(reach)), 1.0), WHEEL);
  chord = ((2.0 * wheel) * py.sin((Math.PI / spokes)));
  return new Star(stake, ground.seen_at(stake), spokes, reach, wheel, chord);
}
function _crossings(line, trail, stars, turned) {
  let before, found, kept, n, onTape, one, star;
  found = [new Crossing(trail.low, 0, "tail"), new Crossing(trail.high, 0, "end")];
  if (((trail.low < trail.start) && (trail.start < trail.high))) {
    py.append(found, new Crossing(trail.start, 0, "head"));
  }
  for ([n, star] of py.iter(py.enumerate(stars))) {
    found = py.extend(found, line.crossings(n, star.spokes, turned));
  }
  if (py.truth(trail.route.kinks)) {
    found = py.extend(found, py.list(line.joints(trail.low, trail.high)).map((s) => new Crossing(s, 0, "")));
  }
  kept = [];
  for (one of py.iter(py.sorted(found, (one) => one.s))) {
    if ((py.truth(kept) && (py.sub(one.s, py.at(kept, -1).s) < SAME))) {
      before = py.pop(kept);
      onTape = (py.truth(one.tape) ? one : before);
      py.append(kept, new Crossing(onTape.s, onTape.tape, py.or(before.kind, () => one.kind)));
    }
    else {
      py.append(kept, one);
    }
  }
  return kept;
}
function _filled(line, found, allowed) {
  let after, kept, one;
  kept = [py.at(found, 0)];
  for ([one, after] of py.iter(py.pairwise(found))) {
    if ((py.len(kept) <= MOST_TICKS)) {
      kept = py.extend(kept, py.list(_between(line, one.s, after.s, allowed)).map((s) => new Crossing(s, 0, "")));
      py.append(kept, after);
    }
  }
  return kept;
}
function _between(line, a, b, allowed) {
  let at, bent, ends, found, n, parts;
  found = [];
  [at, n, ends] = py.list([a, 0, [...py.iter(line.joints(a, b)), b]]);
  while ((n < py.len(ends))) {
    while ((((n + 1) < py.len(ends)) && (line.stray(at, py.at(ends, (n + 1))) <= allowed))) {
      n = py.extend(n, 1);
    }
    bent = py.ceil(py.sqrt((line.stray(at, py.at(ends, n)) / allowed)));
    parts = py.max(bent, py.ceil((py.sub(py.at(ends, n), at) / LEG)));
    found = py.extend(found, py.list(py.range(1, parts)).map((k) => py.add(at, ((py.sub(py.at(ends, n), at) * k) / parts))));
    if ((n < (py.len(ends) - 1))) {
      py.append(found, py.at(ends, n));
    }
    [at, n] = py.list([py.at(ends, n), (n + 1)]);
  }
  return found;
}
function _ticks(line, stars, found, ground) {
  let _bend, _heading, along, angle, aside, c, off, offTape, one, s, seen, share, spokes, stake, star, tape, ticks, x, y;
  ticks = [];
  seen = line.seen(py.list(found).map((one) => one.s));
  for ([one, [x, y, _heading, _bend]] of py.iter(py.zip(found, seen))) {
    star = line.star(one.s);
    if ((star < 0)) {
      py.append(ticks, new Tick(one.s, [x, y], star, 0, 0.0, 0.0, false, one.kind));
      continue;
    }
    [stake, spokes] = py.list([py.at(stars, star).stake, py.at(stars, star).spokes]);
    off = [py.sub(x, py.at(stake, 0)), py.sub(y, py.at(stake, 1))];
    share = ((py.sub(py.atan2(py.at(off, 1), py.at(off, 0)), ground.turned) * spokes) / (2.0 * Math.PI));
    tape = py.or(one.tape, () => (py.mod(py.floor((share + 0.5)), spokes) + 1));
    angle = py.add(ground.turned, (((2.0 * Math.PI) * (tape - 1)) / spokes));
    [c, s] = py.list([py.cos(angle), py.sin(angle)]);
    [along, aside] = py.list([py.add((c * py.at(off, 0)), (s * py.at(off, 1))), py.sub((c * py.at(off, 1)), (s * py.at(off, 0)))]);
    offTape = (py.truth(one.tape) ? 0.0 : aside);
    py.append(ticks, new Tick(one.s, [x, y], star, tape, along, offTape, false, one.kind));
  }
  return ticks;
}
function _streets(ticks) {
  let found, free, one;
  found = [];
  free = false;
  for (one of py.iter(ticks)) {
    if (((one.star < 0) && py.truth(free))) {
      py.append(py.at(found, -1), one);
    }
    else {
      if ((one.star < 0)) {
        py.append(found, [one]);
      }
    }
    free = (one.star < 0);
  }
  return found;
}
function _along(street, legs, ground) {
  let at, first, found, last, leg, place, to;
  found = [];
  [at, first] = py.list([0, true]);
  while ((at < (py.len(street) - 1))) {
    to = (at + 1);
    while ((((to + 1) < py.len(street)) && py.truth(_reaches(street, at, (to + 1))))) {
      to = py.extend(to, 1);
    }
    last = (py.truth(first) ? null : py.at(legs, -1));
    leg = _leg(py.at(street, at).point, py.at(street, to).point, last, ground);
    py.append(legs, leg);
    found = py.extend(found, py.list(py.slice(street, at, to)).map((one) => _beside(one, leg, py.len(legs))));
    [at, first] = py.list([to, false]);
  }
  if (py.truth(found)) {
    return [...py.iter(found), _beside(py.at(street, at), py.at(legs, -1), py.len(legs))];
  }
  place = ground.seen_at(py.at(street, 0).point);
  py.append(legs, new Leg(py.at(street, 0).point, py.at(street, 0).point, place, [1.0, 0.0], 0.0, NaN));
  return [_beside(py.at(street, 0), py.at(legs, -1), py.len(legs))];
}
function _reaches(street, at, to) {
  let far, u, v, x, y;
  [[x, y], [u, v]] = py.list([py.at(street, at).point, py.at(street, to).point]);
  far = py.hypot(py.sub(u, x), py.sub(v, y));
  if (!((SAME < far) && (far <= LEG))) {
    return false;
  }
  return py.list(py.slice(street, (at + 1), to)).every((one) => ((py.abs(py.sub((py.sub(u, x) * py.sub(py.at(one.point, 1), y)), (py.sub(v, y) * py.sub(py.at(one.point, 0), x)))) <= (MOST_ASIDE * far)) && ((0.0 <= py.add((py.sub(u, x) * py.sub(py.at(one.point, 0), x)), (py.sub(v, y) * py.sub(py.at(one.point, 1), y)))) && (py.add((py.sub(u, x) * py.sub(py.at(one.point, 0), x)), (py.sub(v, y) * py.sub(py.at(one.point, 1), y))) <= (far * far)))));
}
function _leg(start, end, last, ground) {
  let cross, far, place, swing, there, turn, way;
  [place, there] = py.list([ground.seen_at(start), ground.seen_at(end)]);
  far = py.dist(start, end);
  way = [(py.sub(py.at(there, 0), py.at(place, 0)) / far), (py.sub(py.at(there, 1), py.at(place, 1)) / far)];
  swing = NaN;
  if ((last != null)) {
    cross = py.sub((py.at(last.way, 0) * py.at(way, 1)), (py.at(last.way, 1) * py.at(way, 0)));
    turn = py.atan2(cross, py.add((py.at(last.way, 0) * py.at(way, 0)), (py.at(last.way, 1) * py.at(way, 1))));
    swing = ((2.0 * ARM) * py.sin((0.5 * turn)));
  }
  return new Leg(start, end, place, way, far, swing);
}
function _beside(tick, leg, number) {
  let along, aside, far, ux, uy, x, y;
  far = py.max(leg.length, SAME);
  [ux, uy] = py.list([(py.sub(py.at(leg.end, 0), py.at(leg.start, 0)) / far), (py.sub(py.at(leg.end, 1), py.at(leg.start, 1)) / far)]);
  [x, y] = py.list([py.sub(py.at(tick.point, 0), py.at(leg.start, 0)), py.sub(py.at(tick.point, 1), py.at(leg.start, 1))]);
  [along, aside] = py.list([py.add((ux * x), (uy * y)), py.sub((ux * y), (uy * x))]);
  return new Tick(tick.s, tick.point, -1, number, along, aside, false, tick.kind);
}
function _once(ticks) {
  let again, kept, one;
  kept = [];
  for (one of py.iter(ticks)) {
    again = py.list(kept).flatMap((other) => (((py.dist(other.point, one.point) < SAME)) ? [other] : []));
    if ((py.truth(one.kind) || !py.truth(again))) {
      py.append(kept, one);
    }
  }
  return kept;
}
function _inAndOut(ticks, star, spokes) {
  let away, last, nearest, own;
  own = py.list(ticks).flatMap((one) => ((py.eq(one.star, star)) ? [one] : []));
  away = py.list(own).map((one) => py.hypot(one.along, one.aside));
  last = py.index(away, py.min(away));
  if ((py.min(last, py.sub((py.len(own) - 1), last)) < spokes)) {
    return py.list(ticks);
  }
  nearest = py.at(own, last).s;
  return py.list(ticks).map((one) => py.replaced(one, { out: py.or(one.out, () => (py.eq(one.star, star) && (one.s > nearest))) }));
}
function _tapes(legs) {
  return py.list(py.enumerate(legs, 1)).map(([n, leg]) => [n, leg.start, leg.end]);
}
function _spokes(star, turned, ticks, number) {
  let angle, far, found, reached, tape, x, y;
  found = [];
  [x, y] = py.list(star.stake);
  for (tape of py.iter(py.range(1, (star.spokes + 1)))) {
    angle = py.add(turned, (((2.0 * Math.PI) * (tape - 1)) / star.spokes));
    reached = py.list(ticks).flatMap((one) => (((py.eq(one.star, number) && py.eq(one.tape, tape))) ? [one.along] : []));
    far = py.max([0.0, ...py.iter(reached)]);
    py.append(found, [tape, star.stake, [py.add(x, (far * py.cos(angle))), py.add(y, (far * py.sin(angle)))]]);
  }
  return found;
}
function _met(obstacles, star, tapes) {
  let found, n, one, there;
  found = [];
  for ([n, one] of py.iter(py.enumerate(obstacles))) {
    if ((one.kind !== "venue")) {
      there = py.list(tapes).flatMap(([tape, start, end]) => ((py.truth(_isMet(one, start, end))) ? [tape] : []));
      if (py.truth(there)) {
        py.append(found, new Met(n, star, py.tuple(there)));
      }
    }
  }
  return found;
}
function _isMet(one, start, end) {
  let corners, ends, sides;
  corners = py.list(py.tolist(one.outline)).map(([x, y]) => [x, y]);
  ends = [...py.iter(py.slice(corners, 1, null)), ...py.iter(((one.kind === "line") ? [] : py.slice(corners, null, 1)))];
  sides = py.zip(corners, ends);
  return py.list(sides).some(([a, b]) => (_apart(start, end, a, b) <= one.radius));
}
function _apart(a, b, c, d) {
  let over;
  over = !py.eq((_left(a, b, c) < 0.0), (_left(a, b, d) < 0.0));
  if ((py.truth(over) && !py.eq((_left(c, d, a) < 0.0), (_left(c, d, b) < 0.0)))) {
    return 0.0;
  }
  return py.min(_away(a, b, c), _away(a, b, d), _away(c, d, a), _away(c, d, b));
}
function _left(a, b, c) {
  return py.sub((py.sub(py.at(b, 0), py.at(a, 0)) * py.sub(py.at(c, 1), py.at(a, 1))), (py.sub(py.at(b, 1), py.at(a, 1)) * py.sub(py.at(c, 0), py.at(a, 0))));
}
function _away(a, b, c) {
  let long, share, u, v;
  [u, v] = py.list([py.sub(py.at(b, 0), py.at(a, 0)), py.sub(py.at(b, 1), py.at(a, 1))]);
  long = py.add((u * u), (v * v));
  share = ((long > 0.0) ? (py.add((py.sub(py.at(c, 0), py.at(a, 0)) * u), (py.sub(py.at(c, 1), py.at(a, 1)) * v)) / long) : 0.0);
  share = py.min(py.max(share, 0.0), 1.0);
  return py.hypot(py.sub(py.sub(py.at(c, 0), py.at(a, 0)), (share * u)), py.sub(py.sub(py.at(c, 1), py.at(a, 1)), (share * v)));
}
