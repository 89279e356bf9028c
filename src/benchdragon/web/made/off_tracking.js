// @ts-nocheck
// Made from analysis/off_tracking.py by tools/make_twins.py; to make it again: make generate

import { emptyPlacements } from "../compute/arrays.js";
import { spend as budgetSpend } from "../compute/budget.js";
import { py } from "../compute/python.js";
import { notNegative } from "./errors.js";

const askedOf = (of, start, end, walk = of) => [walk, start, end];
const OFF_COLUMNS = 6;
const Status = { OK: 0, BEFORE_ROUTE: 1, AFTER_ROUTE: 2, ROUTE_TOO_SHORT: 3, FOLDED: 4, LINK_OVER_DIAMETER: 5 };
const whole = (_name, value) => value;
export const LEAST_GAIN = 0.05;
export const MOST_GAIN = 1.0;
const STEP = 0.1;
const PLACES = 10.0;
class BenchOffTracking {
  constructor(left, leftAt, leftError, right, rightAt, rightError) {
    this.left = left;
    this.left_at = leftAt;
    this.left_error = leftError;
    this.right = right;
    this.right_at = rightAt;
    this.right_error = rightError;
  }
  *[Symbol.iterator]() {
    yield* [this.left, this.left_at, this.left_error, this.right, this.right_at, this.right_error];
  }
}
class OffTracking {
  constructor(gain, benches) {
    this.gain = gain;
    this.benches = benches;
  }
  *[Symbol.iterator]() {
    yield* [this.gain, this.benches];
  }
  farthest(first = 1) {
    if (!py.truth(this.benches)) {
      return Infinity;
    }
    whole("first", first, 1, py.len(this.benches));
    return py.max(py.list(py.slice(this.benches, (first - 1), null)).map((one) => py.max(py.add(one.left, one.left_error), py.add(one.right, one.right_error))));
  }
}
export function offTracking(walk, gain, start = /** @type {any} */ (null), end = /** @type {any} */ (null)) {
  let benches, failure, first, last, links, places, rows, seen, status, step, steps;
  [walk, start, end] = py.list(askedOf(walk, start, end));
  gain = notNegative("gain", gain);
  [first, last] = py.list(py.tolist(walk.head_position([start, end])));
  failure = walk.first_failure(py.array([first, last]));
  if ((failure != null)) {
    throw failure;
  }
  [rows, links] = py.list([walk.route.rows, walk.dragon.links]);
  step = (STEP * py.min(...py.iter(py.tolist(links)), ((gain === 0.0) ? Infinity : (1.0 / gain))));
  steps = py.max(py.ceil(((0.5 * py.sub(last, first)) / step)), 1);
  budgetSpend((((3.0 * PLACES) * py.len(links)) * steps));
  places = emptyPlacements((py.len(links) + 1), 1);
  py.entry("bd_chain_march", rows, links, py.array([first]), 0, 1, places);
  seen = py.empty([py.len(links), OFF_COLUMNS]);
  status = py.entry("bd_off_tracking_see_offsets", rows, links, places, first, last, steps, gain, seen)[0];
  benches = (py.eq(status, Status.OK) ? py.list(py.tolist(seen)).map((row) => new BenchOffTracking(...py.iter(row))) : []);
  return new OffTracking(gain, py.tuple(benches));
}
