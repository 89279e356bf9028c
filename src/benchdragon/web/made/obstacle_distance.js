// @ts-nocheck
// Made from analysis/obstacle_distance.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";

const BOX_COLUMNS = 6;
export function nearestBoxes(table, obstacle) {
  let out, which;
  [out, which] = py.list([py.empty(py.len(table)), py.empty(py.len(table), "q")]);
  py.entry("bd_obstacle_contact_distances_to", table, obstacle.boxes, py.empty([2, BOX_COLUMNS]), out, which);
  return [out, which];
}
