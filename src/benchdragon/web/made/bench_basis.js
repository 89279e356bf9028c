// @ts-nocheck
// Made from explain/bench_basis.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { Halt, Landmark } from "./bench_text.js";
import { cueName } from "./cues.js";
import { named } from "./findings.js";
import { nearestBoxes } from "./obstacle_distance.js";

export function haltsOf(plan) {
  return py.tuple(py.list(plan.moments()).flatMap((moment) => (((py.has(["hold", "stop"], moment.cue.kind) && (py.truth(moment.cue.text) || py.truth(moment.cue.text_zh)))) ? [new Halt(moment.time, moment.until, cueName(moment.cue))] : [])));
}
export function landmarkOf(plan, found, ground) {
  let apart, best, edge, far, obstacle, side, which;
  best = new Landmark(py.dist(found.place, ground.peg));
  for (obstacle of py.iter(plan.obstacles())) {
    [far, which] = py.list(nearestBoxes(py.array([found.box]), obstacle));
    apart = py.max(py.sub(py.float(py.at(far, 0)), obstacle.radius), 0.0);
    if ((apart < best.apart)) {
      side = py.tolist(py.at(obstacle.boxes, py.int(py.at(which, 0))));
      edge = ((obstacle.kind === "venue") ? _edge(found, ground, side) : null);
      best = new Landmark(apart, named(obstacle), edge);
    }
  }
  return best;
}
function _edge(found, ground, side) {
  let inwards, x, y;
  [x, y] = py.list([py.at(side, 3), -py.at(side, 2)]);
  inwards = (py.add((x * py.sub(py.at(side, 0), py.at(found.box, 0))), (y * py.sub(py.at(side, 1), py.at(found.box, 1)))) < 0.0);
  return ground.edge((py.truth(inwards) ? [-x, -y] : [x, y]));
}
