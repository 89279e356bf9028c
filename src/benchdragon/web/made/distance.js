// @ts-nocheck
// Made from analysis/distance.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { N_ } from "../words.js";

const CORNERS = [N_("front left"), N_("rear left"), N_("rear right"), N_("front right")];
export const FEATURES = [N_("front"), N_("rear"), N_("left"), N_("right"), N_("front left"), N_("front right"), N_("rear left"), N_("rear right")];
class Nearness {
  constructor(benches, distance, gap, points, features) {
    this.benches = benches;
    this.distance = distance;
    this.gap = gap;
    this.points = points;
    this.features = features;
  }
}
export function nearness(table, i, j) {
  let row;
  row = py.empty(12);
  py.entry("bd_nearness_nearness", table, i, j, row);
  return nearnessOf(py.tolist(row));
}
export function nearnessOf(row) {
  let corner, distance, feature, first, gap, meets, other, owner, second, thereX, thereY, x, y;
  [first, second, distance, gap, x, y, thereX, thereY, ...meets] = py.list(row);
  [owner, corner, other, feature] = py.list(py.list(meets).map((one) => py.int(one)));
  return new Nearness([(py.int(first) + 1), (py.int(second) + 1)], distance, gap, [[x, y], [thereX, thereY]], [[(owner + 1), py.at(CORNERS, corner)], [(other + 1), py.at(FEATURES, feature)]]);
}
