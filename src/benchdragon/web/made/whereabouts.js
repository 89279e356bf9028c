// @ts-nocheck
// Made from explain/whereabouts.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { named } from "./findings.js";
import { wayOut } from "./ground.js";
import { nearestBoxes } from "./obstacle_distance.js";

const BESIDE = 5.0;
export function whereabouts(plan, ground, place) {
  let _far, _n, at, edges, name, things;
  things = py.sorted(py.list(_things(plan, place)).map(([n, [at, name]]) => [py.dist(at, place), n, at, name]));
  edges = _edges(plan, ground, place);
  if ((py.truth(things) && ((py.at(py.at(things, 0), 0) <= BESIDE) || !py.truth(edges)))) {
    [_far, _n, at, name] = py.list(py.at(things, 0));
    return py.filled(_("from {thing} {offset}"), { thing: name, offset: offset(ground, at, place) });
  }
  if (py.truth(edges)) {
    return edges;
  }
  return py.filled(_("from where the peg stood {offset}"), { offset: offset(ground, ground.peg, place) });
}
export function offset(ground, start, end) {
  let back, forward, left, right, toX, toY, x, y;
  [[x, y], [toX, toY]] = py.list([ground.seen_at(start), ground.seen_at(end)]);
  [right, forward, left, back] = py.list(ground.way_names);
  return py.filled(_("{x} m {way_x} and {y} m {way_y}"), { x: `${py.format(py.abs(py.sub(toX, x)), `.1f`)}`, way_x: ((toX >= x) ? right : left), y: `${py.format(py.abs(py.sub(toY, y)), `.1f`)}`, way_y: ((toY >= y) ? forward : back) });
}
export function venueOf(plan) {
  return py.next(py.list(plan.obstacles()).flatMap((one) => (((one.kind === "venue")) ? [one] : [])), null);
}
function* _things(plan, place) {
  let k, n, obstacle, x, y;
  n = 0;
  for (obstacle of py.iter(plan.obstacles())) {
    if ((obstacle.kind !== "venue")) {
      yield [n, [_nearestPoint(obstacle, place), named(obstacle)]];
      n = py.extend(n, 1);
    }
  }
  for ([k, [x, y]] of py.iter(py.enumerate(plan.event.places, 1))) {
    yield [n, [[x, y], py.filled(_("entrance {n}"), { n: k })]];
    n = py.extend(n, 1);
  }
}
function _nearestPoint(obstacle, place) {
  let _far, along, half, side, spot, u, v, which, x, y;
  spot = py.array([[py.at(place, 0), py.at(place, 1), 1.0, 0.0, 0.0, 0.0]]);
  [_far, which] = py.list(nearestBoxes(spot, obstacle));
  side = py.tolist(py.at(obstacle.boxes, py.int(py.at(which, 0))));
  [x, y, u, v] = py.list([py.at(side, 0), py.at(side, 1), py.at(side, 2), py.at(side, 3)]);
  half = py.at(side, 4);
  along = py.min(py.max(py.add((py.sub(py.at(place, 0), x) * u), (py.sub(py.at(place, 1), y) * v)), -half), half);
  return [py.add(x, (along * u)), py.add(y, (along * v))];
}
function _edges(plan, ground, place) {
  let back, edgeX, edgeY, forward, found, left, met, right, text, venue, x, y;
  venue = venueOf(plan);
  found = ((venue == null) ? [] : py.list(ground.ways).map((way) => wayOut(venue.outline, place, way)));
  met = py.list(found).flatMap((one) => (((one != null)) ? [[py.at(one, 0), ground.edge_name(ground.edge(py.at(one, 1)))]] : []));
  if ((py.len(met) < py.len(ground.ways))) {
    return "";
  }
  [right, forward, left, back] = py.list(met);
  [[x, edgeX], [y, edgeY]] = py.list([py.min(right, left), py.min(forward, back)]);
  text = _("{x} m from the {edge_x} and {y} m from the {edge_y}");
  return py.filled(text, { x: `${py.format(x, `.1f`)}`, edge_x: edgeX, y: `${py.format(y, `.1f`)}`, edge_y: edgeY });
}
