// @ts-nocheck
// Made from solve/course.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { places } from "../compute/walk_facts.js";

const SHORT = 60.0;
class Course {
  constructor(rounds, way, seconds, out, inside) {
    this.rounds = rounds;
    this.way = way;
    this.seconds = seconds;
    this.out = out;
    this.inside = inside;
  }
  get short() {
    return (this.seconds < SHORT);
  }
}
export function courseOf(plan) {
  let angles, begun, end, ended, inside, out, points, rounds, start, turns, walk, x, y;
  walk = plan.build();
  [start, end] = py.list(plan.span(walk));
  [begun, ended] = py.list(places(walk, start, end));
  [x, y] = py.list(py.or(plan.route.at, () => [0.0, 0.0]));
  points = py.list(begun).map((s) => py.tolist(walk.route.point(s)));
  angles = py.list(points).map(([u, v]) => py.atan2(py.sub(v, y), py.sub(u, x)));
  turns = py.list(py.pairwise(angles)).map(([before, after]) => py.remainder(py.sub(after, before), (2.0 * Math.PI)));
  out = (plan.route.kind === "turn");
  rounds = (py.abs(py.sum(turns)) / (2.0 * Math.PI));
  inside = py.and(out, () => py.and(!py.truth(plan.route.after_street), () => (start >= 0.0)));
  return new Course(rounds, py.sub(py.at(ended, 0), py.at(begun, 0)), py.sub(end, start), out, inside);
}
