// @ts-nocheck
// Made from analysis/crowd.py by tools/make_twins.py; to make it again: make generate

import { awayAt } from "../compute/crowd.js";
import { py } from "../compute/python.js";
import { groundLeft } from "../compute/swept.js";
import { N_ } from "../words.js";
import { sure } from "./answer.js";
import { gatesOf } from "./entrances.js";
import { Finding } from "./findings.js";
import { leastDistance } from "./obstacles.js";
import { areaOf, holds, ringOf, roundRing } from "./rings.js";

export const DISTANCE = 2.0;
const LEVELS = [[7.1, N_("critical even where nobody moves")], [5.6, N_("dangerous forces begin")], [3.6, N_("people are touched against their will")], [2.0, N_("walking is slowed")], [0.0, N_("people can walk about")]];
const MOST = 3.6;
const FLOWS = [60.0, 82.0];
const TOLERANCES = [0.001];
const STEP = 0.25;
const MOST_LOOKS = 20000;
const APART = 10.0;
const WHIP = 2.0;
class Crowd {
  constructor(people, ground, way) {
    this.people = people;
    this.ground = ground;
    this.way = way;
  }
  get density() {
    if (((this.people == null) || (this.ground == null))) {
      return null;
    }
    if (!py.truth(this.people)) {
      return 0.0;
    }
    return ((this.ground > 0.0) ? (this.people / this.ground) : Infinity);
  }
}
class Entrance {
  constructor(gate, nearest, inside, shut) {
    this.gate = gate;
    this.nearest = nearest;
    this.inside = inside;
    this.shut = shut;
  }
}
class WaysOut {
  constructor(width, free, unknown, flows, minutes) {
    this.width = width;
    this.free = free;
    this.unknown = unknown;
    this.flows = flows;
    this.minutes = minutes;
  }
}
export function distanceOf(plan) {
  return ((plan.event.distance == null) ? DISTANCE : plan.event.distance);
}
export function withinLines(lines) {
  return py.sum(py.list(lines).map((line) => areaOf(line)));
}
export function crowdOf(plan, lines, edge) {
  let ground, obstacles, people, standing, venues;
  [people, obstacles] = py.list([plan.event.spectators, plan.obstacles()]);
  venues = py.list(obstacles).flatMap((one) => (((one.kind === "venue")) ? [py.tolist(one.outline)] : []));
  if (!py.truth(venues)) {
    return new Crowd(people, null, null);
  }
  standing = py.list(obstacles).flatMap((one) => ((py.has(["circle", "rectangle", "polygon"], one.kind)) ? [_ring(one)] : []));
  ground = groundLeft(py.at(venues, 0), [...py.iter(lines), ...py.iter(standing)]);
  return new Crowd(people, ground, py.max(py.sub(edge, distanceOf(plan)), 0.0));
}
function _ring(obstacle) {
  let corners;
  corners = py.tolist(obstacle.outline);
  if ((obstacle.kind === "circle")) {
    return roundRing(py.at(corners, 0), obstacle.radius);
  }
  return ringOf(corners);
}
export function densityText(density) {
  return py.next(py.list(LEVELS).flatMap(([least, text]) => (((density >= least)) ? [text] : [])));
}
export async function entrancesOf(plan, walk, span, lines, fastest) {
  return py.scoped(async () => {
    let end, found, gate, inside, near, places, shut, start;
    [[start, end], found] = py.list([span, []]);
    for (gate of py.iter(gatesOf(plan))) {
      near = (await leastDistance(walk, gate.shape, start, end, TOLERANCES));
      places = [gate.place, ...py.iter(_ring(gate.shape))];
      inside = py.list(lines).some((line) => py.list(places).some((place) => py.truth(holds(line, place))));
      shut = (py.truth(inside) ? _shut(walk, span, gate.shape, distanceOf(plan), fastest) : []);
      py.append(found, new Entrance(gate, near, inside, shut));
    }
    return found;
  });
}
export function waysOut(entrances, people) {
  let flows, free, known;
  known = py.list(entrances).flatMap((one) => (((one.gate.width != null)) ? [one] : []));
  free = py.sum(py.list(known).flatMap((one) => ((!py.truth(one.inside)) ? [py.or(one.gate.width, () => 0.0)] : [])));
  flows = py.list(FLOWS).map((flow) => (free * flow));
  return new WaysOut((py.truth(known) ? py.sum(py.list(known).map((one) => py.or(one.gate.width, () => 0.0))) : null), free, py.tuple(py.list(py.enumerate(entrances, 1)).flatMap(([n, one]) => (((one.gate.width == null)) ? [n] : []))), py.tuple(flows), ((people == null) ? null : py.tuple(py.list(flows).map((flow) => ((flow > 0.0) ? (people / flow) : Infinity)))));
}
function _shut(walk, span, shape, near, fastest) {
  let count, end, found, half, since, start, time;
  [start, end] = py.list(span);
  count = py.min(py.max(py.ceil((py.sub(end, start) / STEP)), 1), MOST_LOOKS);
  half = ((0.5 * py.sub(end, start)) / count);
  found = [];
  for (time of py.iter(py.tolist(py.linspace(start, end, (count + 1))))) {
    if ((awayAt(walk, time, shape) > py.add(near, ((WHIP * fastest) * half)))) {
      continue;
    }
    since = ((py.truth(found) && (py.sub(py.sub(time, half), py.at(py.at(found, -1), 1)) <= APART)) ? py.at(py.pop(found), 0) : py.sub(time, half));
    py.append(found, [py.max(since, start), py.min(py.add(time, half), end)]);
  }
  return py.tuple(found);
}
export function eventFindings(plan, crowd, entrances, clock) {
  return [...py.iter(_entranceFindings(plan, entrances, clock)), ...py.iter(_crowdFindings(crowd))];
}
function _entranceFindings(plan, entrances, clock) {
  let away, found, line, n, one, sentence, words;
  [found, line] = py.list([[], distanceOf(plan)]);
  for ([n, one] of py.iter(py.enumerate(entrances, 1))) {
    if (!py.truth(one.inside)) {
      continue;
    }
    sentence = N_("entrance {n} lies inside the spectators' line, {away} m from the ground that benches cover, and is shut by them ({times}): move the entrance, the dance, or the line");
    if (!py.truth(one.shut)) {
      sentence = N_("entrance {n} lies inside the spectators' line, {away} m from the ground that benches cover, which goes round it: move the entrance, the dance, or the line");
    }
    away = sure(one.nearest, false);
    words = py.dict([["n", py.str(n)], ["away", `${py.format(away, `.2f`)}`], ["times", shutText(one, clock)]]);
    py.append(found, new Finding("entrance", null, [], away, line, sentence, words));
  }
  return found;
}
export function shutText(entrance, clock) {
  let times;
  times = py.list(entrance.shut).map(([since, until]) => `${py.str(clock.tell(since))}–${py.str(clock.tell(until))}`);
  return py.join("; ", times);
}
function _crowdFindings(crowd) {
  let density, sentence, words;
  density = crowd.density;
  if (((density == null) || (density < MOST))) {
    return [];
  }
  sentence = N_("{people} spectators on {ground} m² outside their line are {density} a square metre: {level}; let fewer in, or take a larger square");
  words = py.dict([["people", py.str(crowd.people)], ["ground", `${py.format(crowd.ground, `.0f`)}`], ["density", `${py.format(density, `.1f`)}`], ["level", densityText(density)]]);
  if (py.eq(density, Infinity)) {
    sentence = N_("there is no ground for {people} spectators: their line takes all of the venue");
  }
  return [new Finding("crowd", null, [], density, MOST, sentence, words)];
}
