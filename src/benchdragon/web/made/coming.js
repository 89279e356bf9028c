// @ts-nocheck
// Made from explain/coming.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { places } from "../compute/walk_facts.js";
import { _ } from "../words.js";
import { named } from "./findings.js";
import { wayOut } from "./ground.js";
import { nearestBoxes } from "./obstacle_distance.js";
import { offset, venueOf, whereabouts } from "./whereabouts.js";

const FAR = 20.0;
const MET = 0.001;
export function comingLines(plan, walk, span, ground) {
  let first, last, square;
  [first, last] = py.list(places(walk, ...py.iter(span)));
  square = new Square(plan, walk, ground);
  return [[...py.iter(_coming(square, py.at(first, -1), py.at(first, 0)))], [...py.iter(_leaving(square, py.at(last, 0), py.at(last, -1)))]];
}
class Square {
  constructor(plan, walk, ground) {
    this.plan = plan;
    this.walk = walk;
    this.ground = ground;
  }
  *[Symbol.iterator]() {
    yield* [this.plan, this.walk, this.ground];
  }
  pose(s) {
    let _curvature, heading, out, x, y;
    out = py.empty([1, 4]);
    py.entry("bd_route_evaluate", this.walk.route.rows, py.array([py.min(s, this.walk.route.length)]), out);
    [[x, y, heading, _curvature]] = py.list(py.tolist(out));
    return [[x, y], [py.cos(heading), py.sin(heading)]];
  }
  told(place) {
    return whereabouts(this.plan, this.ground, place);
  }
}
function* _coming(square, tail, head) {
  let ahead, blocked, entrance, free, n, place, text, walking, way;
  [place, ahead] = py.list(square.pose(tail));
  text = _("To line up, the head comes to where the tail starts ({place}) and walks slowly along the line to where the head starts ({start}); the others follow. Then each bench stands where its sheet says. The check says nothing of this walk, nor of leaving.");
  yield py.filled(text, { place: square.told(place), start: square.told(py.at(square.pose(head), 0)) });
  [way, walking] = py.list([py.sub(head, tail), square.plan.walk]);
  text = _("From the one place to the other it is {way} m: {minutes} min at the speed of the dance. Have all in line before it starts.");
  if (py.truth(walking.profile)) {
    text = _("From the one place to the other it is {way} m. Have all in line before it starts.");
  }
  yield py.filled(text, { way: `${py.format(way, `.0f`)}`, minutes: py.ceil(((way / walking.speed) / 60.0)) });
  blocked = _("Back along the line from where the tail starts, {name} is in the way after {far} m: come to the line from the side.");
  free = _("Back along the line from where the tail starts it is {far} m to the {edge} of {venue}.");
  yield* py.iter(_straightOn(square, place, [-py.at(ahead, 0), -py.at(ahead, 1)], blocked, free));
  for ([n, entrance] of py.iter(_nearestEntrance(square.plan, place))) {
    text = _("Entrance {n} is nearest to where the tail starts: from the entrance {far}.");
    yield py.filled(text, { n: n, far: offset(square.ground, entrance, place) });
  }
}
function* _leaving(square, head, tail) {
  let ahead, blocked, coiled, entrance, free, n, place, text;
  coiled = (square.plan.route.kind === "spiral-in");
  text = _("At the end the head stands here: {place}. It goes on from there.");
  if (py.truth(coiled)) {
    text = _("At the end the head stands inside: {place}. Pull the pins from the tail on, and walk out bench by bench.");
  }
  yield py.filled(text, { place: square.told(py.at(square.pose(head), 0)) });
  [place, ahead] = py.list(square.pose((py.truth(coiled) ? tail : head)));
  if (py.truth(coiled)) {
    yield* py.iter(_nearestEdge(square, place));
  }
  else {
    blocked = _("Straight on from there {name} is in the way, {far} m ahead: bend away before it, no more sharply than in the dance. The plan says nothing of that way.");
    free = _("Straight on from there it is {far} m to the {edge} of {venue}, met here: {place}. The plan says nothing of that way: open the edge there, or bend before it no more sharply than in the dance.");
    yield* py.iter(_straightOn(square, place, ahead, blocked, free));
  }
  for ([n, entrance] of py.iter(_nearestEntrance(square.plan, place))) {
    text = _("Entrance {n} is then nearest to the head: {far} from it.");
    if (py.truth(coiled)) {
      text = _("Entrance {n} is then nearest to the tail: {far} from it.");
    }
    yield py.filled(text, { n: n, far: offset(square.ground, place, entrance) });
  }
}
function* _straightOn(square, start, way, blocked, free) {
  let far, found, met, out, venue, within;
  venue = venueOf(square.plan);
  found = ((venue == null) ? null : wayOut(venue.outline, start, way));
  met = _inTheWay(square, start, way, ((found == null) ? FAR : py.at(found, 0)));
  if ((met != null)) {
    yield py.filled(blocked, { name: py.at(met, 1), far: `${py.format(py.at(met, 0), `.1f`)}` });
  }
  else {
    if (((venue != null) && (found != null))) {
      [far, out] = py.list(found);
      within = [py.add(py.at(start, 0), (py.sub(far, MET) * py.at(way, 0))), py.add(py.at(start, 1), (py.sub(far, MET) * py.at(way, 1)))];
      yield py.filled(free, { edge: square.ground.edge_name(square.ground.edge(out)), venue: named(venue), far: `${py.format(far, `.1f`)}`, place: square.told(within) });
    }
  }
}
function _inTheWay(square, start, way, far) {
  let aside, at, found, gap, one, people, widths;
  [people, widths] = py.list([square.plan.people, py.tolist(square.walk.dragon.width)]);
  aside = py.add(py.add(py.add((0.5 * py.max(widths)), people.beside), people.sway), people.imprecision);
  found = [];
  for (one of py.iter(square.plan.obstacles())) {
    at = ((one.kind !== "venue") ? 0.0 : far);
    while ((at < far)) {
      gap = py.sub(py.sub(_apart(one, [py.add(py.at(start, 0), (at * py.at(way, 0))), py.add(py.at(start, 1), (at * py.at(way, 1)))]), aside), one.margin);
      if ((gap <= MET)) {
        py.append(found, [at, named(one)]);
        break;
      }
      at = py.extend(at, gap);
    }
  }
  return py.min(found, undefined, null);
}
function _apart(obstacle, place) {
  let _which, far;
  [far, _which] = py.list(nearestBoxes(py.array([[py.at(place, 0), py.at(place, 1), 1.0, 0.0, 0.0, 0.0]]), obstacle));
  return py.sub(py.float(py.at(far, 0)), obstacle.radius);
}
function _nearestEntrance(plan, place) {
  let known;
  known = py.list(py.enumerate(plan.event.places, 1)).map(([n, one]) => [py.dist(one, place), n, one]);
  return py.list(py.slice(py.sorted(known), null, 1)).map(([_far, n, [x, y]]) => [n, [x, y]]);
}
function* _nearestEdge(square, tail) {
  let edge, found, text, venue;
  venue = venueOf(square.plan);
  found = ((venue == null) ? null : wayOut(venue.outline, tail));
  if (((venue != null) && (found != null))) {
    text = _("The nearest edge to the tail is then the {edge} of {venue}: {far} m away.");
    edge = square.ground.edge_name(square.ground.edge(py.at(found, 1)));
    yield py.filled(text, { edge: edge, venue: named(venue), far: `${py.format(py.at(found, 0), `.1f`)}` });
  }
}
