// @ts-nocheck
// Made from analysis/obstacle_search.py by tools/make_twins.py; to make it again: make generate

import { refined } from "../compute/budget.js";
import { EngineQuestion } from "../compute/engine_question.js";
import { UnsureError } from "../compute/error_kinds.js";
import { mustStand, originAt } from "../compute/nearby.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { Answer, Witness } from "./answer.js";
import { inColumns } from "./bench_tables.js";
import { assumedWithin } from "./contact_search.js";
import { FEATURES } from "./distance.js";
import { inOrder } from "./errors.js";
import { HeadTimes } from "./head_times.js";
import { checkedOff, seenFrom } from "./nearby.js";
import { returns } from "./rounds.js";

const SLACK = 1e-13;
const WIDTH = 1e-13;
const MOST_EVALUATIONS = 200000;
const MOST_LEAST_EVALUATIONS = 2000;
const SAMPLES = 65;
const NARROW = 1e-06;
function repeatsOf(walk) {
  let _insets, lengths, squares, widths;
  [lengths, widths, ..._insets] = py.list(py.tolist(walk.dragon.sizes));
  squares = py.list(py.zip(lengths, widths)).map(([a, b]) => py.add((a * a), (b * b)));
  return returns(walk.route.rows, py.sqrt(py.max(squares)));
}
export class ObstacleSearch extends EngineQuestion {
  constructor(walk, obstacle, start, end) {
    let began, dragon, first, handle, last, named, near, origin, outline, x, y;
    inOrder(start, end);
    [began, [first, last]] = py.list([py.perf_counter(), py.tolist(walk.head_position([start, end]))]);
    mustStand(walk, start);
    mustStand(walk, end);
    [origin, dragon] = py.list([originAt(walk, first), walk.dragon]);
    [near, [x, y]] = py.list([seenFrom(walk, origin), origin]);
    named = py.dict([[0, obstacle.sort], [1, obstacle.radius], [2, obstacle.margin], [3, first], [4, last], [5, SLACK], [6, WIDTH], [7, MOST_EVALUATIONS], [8, MOST_LEAST_EVALUATIONS]]);
    outline = py.array(py.list(py.tolist(obstacle.walls)).map((at) => [py.sub(py.at(at, 0), x), py.sub(py.at(at, 1), y)]));
    handle = py.entry("bd_obstacle_question_open_obstacle", near.route.rows, dragon.links, dragon.sizes, outline, repeatsOf(near), inColumns(named))[0];
    super(handle, py.entered("bd_obstacle_question_step_obstacle"), py.entered("bd_obstacle_question_read_obstacle"), py.zeros(28));
    [this._walk, this._obstacle, this._heads, this._origin] = py.list([walk, obstacle, [first, last], origin]);
    [this._times, this._began] = py.list([new HeadTimes(walk, first, start, end), began]);
  }
  get evaluations() {
    return py.int(py.at(this.figures, 2));
  }
  async touches() {
    let found;
    found = (await this._found(0, 0.0));
    return py.list(found).map((row) => this._touch(row));
  }
  async least_distance(tolerances) {
    let found, n, tolerance;
    for ([n, tolerance] of py.iter(py.enumerate(tolerances))) {
      {
        const caught = refined(n);
        try {
          found = (await this._found(2, tolerance));
          if (py.truth(py.at(this.figures, 5))) {
            return this._distance(py.at(found, 0));
          }
        } catch (error) {
          caught(error);
        } finally {
          caught.ended?.();
        }
      }
    }
    found = (await this._found(2, Infinity));
    return this._distance(py.at(found, 0));
  }
  async _found(goal, narrow) {
    let ending, found, rows, text;
    py.entry("bd_obstacle_question_seek_obstacle", this._handle, goal, narrow)[0];
    while (py.eq((ending = (await this.step())), 8)) {
      
    }
    if (py.eq(ending, 10)) {
      throw this._stopped();
    }
    if (py.eq(ending, 30)) {
      text = _("benches come within rounding of {name} too often to be followed on");
      throw new UnsureError(py.filled(text, { name: this._obstacle.name }));
    }
    if (py.eq(ending, 31)) {
      checkedOff(py.float(py.at(this.figures, 3)));
    }
    found = py.empty([py.int(py.at(this.figures, 6)), 10]);
    py.entry("bd_obstacle_question_read_found", this._handle, 0, found)[0];
    rows = py.tolist(found);
    return rows;
  }
  _stopped() {
    let error, text;
    error = this._walk.first_failure(py.linspace(...py.iter(this._heads), SAMPLES));
    text = _("past s = {s} m it could not be shown that every bench follows without a leap");
    return py.or(error, () => new UnsureError(py.filled(text, { s: `${py.format(py.at(this.figures, 4), `.6g`)}` })));
  }
  _touch(row) {
    let early, late, status, sure, value;
    sure = (py.truth(py.at(row, 5)) ? "found" : "undecided");
    [value, early, late, status] = py.list(this._times.told(py.at(row, 1), py.at(row, 2), sure));
    if (((status === "found") && (py.sub(late, early) > NARROW))) {
      value = late;
    }
    return this._answer([value, early, late], "s", status, row);
  }
  _distance(row) {
    let bracket;
    bracket = [py.at(row, 0), py.at(row, 1), py.at(row, 2)];
    return this._answer(bracket, "m", "found", row);
  }
  _answer(bracket, unit, status, row) {
    let assumed, made, seconds;
    [assumed, made] = py.list([assumedWithin(py.float(py.at(this.figures, 3))), this.evaluations]);
    seconds = py.sub(py.perf_counter(), this._began);
    return new Answer(...py.iter(bracket), unit, status, this._witness(row), assumed, made, seconds);
  }
  _witness(row) {
    let bench, feature, gap, point, s, time;
    [s, gap, bench] = py.list([py.at(row, 4), py.at(row, 8), (py.int(py.at(row, 3)) + 1)]);
    if (py.isnan(gap)) {
      throw this._stopped();
    }
    point = [py.add(py.at(row, 6), py.at(this._origin, 0)), py.add(py.at(row, 7), py.at(this._origin, 1))];
    [feature, time] = py.list([py.at(FEATURES, py.int(py.at(row, 9))), this._times.at(s)]);
    return new Witness(time, s, [bench], point, gap, [[bench, feature]], null, this._obstacle.name);
  }
}
