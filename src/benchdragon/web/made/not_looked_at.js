// @ts-nocheck
// Made from analysis/not_looked_at.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { givenFrom, places, runsOn } from "../compute/walk_facts.js";
import { N_, _ } from "../words.js";
import { known } from "./number_format.js";
import { levelsAsked } from "./room_levels.js";

const DUST = 1e-06;
const TEXTS = py.dict([["street", N_("the plan gives no edge, wall or house along the drawn route (venue, obstacle): whether the dance avoids them was not checked")], ["square", N_("the plan gives neither an edge of the square nor anything that stands on it (venue, obstacle): whether the dance avoids them was not checked")], ["venue", N_("the plan gives no edge of the square (venue): whether the dance stays inside was not checked")], ["people", N_("the plan asks for no room for people (people.beside, people.ahead, people.sway, people.imprecision): only the benches themselves were checked")], ["speed", N_("the plan gives no greatest speed (limits.speed, people.most_speed): speeds were computed, and compared with nothing")], ["behind", N_("at the start {way} m of the dragon, benches {first} to {last}, stand on a straight line behind the start of the route, which the plan does not draw: whether there is such a way was not checked")], ["still behind", N_("when the walk ends, {way} m of the dragon, benches {first} to {last}, have not yet come to the route that the plan draws")]]);
const BRIEF = py.dict([["street", N_("walls and houses along the route")], ["square", N_("the square")], ["venue", N_("the edge of the square")], ["people", N_("room for people")], ["speed", N_("limits of speed")], ["behind", N_("the ground behind the start, {way} m")], ["still behind", N_("the route of benches {first} to {last}")]]);
class NotLookedAt {
  constructor(kind, words = py.dict()) {
    this.kind = kind;
    this.words = words;
  }
  get text() {
    return py.filled(_(py.at(TEXTS, this.kind)), { ...py.object(this.words) });
  }
  get brief() {
    return py.filled(_(py.at(BRIEF, this.kind)), { ...py.object(this.words) });
  }
}
export function notLookedAt(plan, walk, start, end) {
  let found, kind, kinds, s, standing, words;
  standing = plan.obstacles();
  kinds = [];
  if (!py.truth(standing)) {
    py.append(kinds, ((plan.route.kind === "drawn") ? "street" : "square"));
  }
  else {
    if (py.list(standing).every((one) => (one.kind !== "venue"))) {
      py.append(kinds, "venue");
    }
  }
  if (!py.truth(levelsAsked(plan.people))) {
    py.append(kinds, "people");
  }
  if (((plan.limits.speed == null) && (plan.people.most_speed == null))) {
    py.append(kinds, "speed");
  }
  found = py.list(kinds).map((kind) => new NotLookedAt(kind));
  if (py.truth(runsOn(walk))) {
    for ([kind, s] of py.iter(py.zip(["behind", "still behind"], places(walk, start, end)))) {
      words = _behind(s, givenFrom(plan, walk));
      found = py.extend(found, (py.truth(words) ? [new NotLookedAt(kind, words)] : []));
    }
  }
  return py.tuple(found);
}
function _behind(s, given) {
  let benches, last, way;
  benches = py.list(py.enumerate(s)).flatMap(([n, place]) => (((py.truth(n) && (place < py.sub(given, DUST)))) ? [n] : []));
  if (!py.truth(benches)) {
    return py.dict([]);
  }
  way = py.sub(given, py.at(s, -1));
  last = py.str((py.len(s) - 1));
  return py.dict([["way", known(way, way, "m", true)], ["first", py.str(py.at(benches, 0))], ["last", last]]);
}
