// @ts-nocheck
// Made from analysis/entrances.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { Obstacle } from "./obstacle.js";
import { between, lengthOf, nearestOn, opening, ringOf, stretch } from "./rings.js";

const POST = 0.001;
class Gate {
  constructor(place, width, span, shape) {
    this.place = place;
    this.width = width;
    this.span = span;
    this.shape = shape;
  }
}
export function gatesOf(plan) {
  let pairs, rings;
  rings = py.list(_venue(plan)).map((edge) => ringOf(py.tolist(edge.outline)));
  pairs = py.zip(plan.event.places, plan.event.widths);
  return py.list(pairs).map(([place, width]) => _gate(place, width, rings));
}
function _venue(plan) {
  return py.list(plan.obstacles()).flatMap((one) => (((one.kind === "venue")) ? [one] : []));
}
function _gate(place, width, rings) {
  let half, ring, span;
  if ((width == null)) {
    return new Gate(place, null, null, Obstacle.circle("", place, POST));
  }
  half = (0.5 * width);
  for (ring of py.iter(rings)) {
    span = opening(ring, place, width);
    if ((span != null)) {
      return new Gate(place, width, span, Obstacle.line("", stretch(ring, ...py.iter(span))));
    }
  }
  return new Gate(place, width, null, Obstacle.circle("", place, half));
}
export function edgeLeft(plan) {
  let begin, edge, end, posts, ring, spans;
  for (edge of py.iter(_venue(plan))) {
    ring = ringOf(py.tolist(edge.outline));
    spans = py.list(gatesOf(plan)).flatMap((gate) => (((gate.span != null)) ? [gate.span] : []));
    if ((edge.open != null)) {
      posts = py.tolist(edge.open);
      [begin, end] = py.list([py.at(nearestOn(ring, py.at(posts, -1)), 1), py.at(nearestOn(ring, py.at(posts, 0)), 1)]);
      py.append(spans, [begin, ((end > begin) ? end : py.add(end, lengthOf(ring)))]);
    }
    return between(ring, spans);
  }
  return [];
}
