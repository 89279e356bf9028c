// @ts-nocheck
// Made from solve/size_question.py by tools/make_twins.py; to make it again: make generate

import { memory as budgetMemory } from "../compute/budget.js";
import { EngineQuestion } from "../compute/engine_question.js";
import { UnsureError } from "../compute/error_kinds.js";
import { originAt } from "../compute/nearby.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { beginnings, inColumns } from "./bench_tables.js";
import { Meeting, kernelFamily } from "./size_family.js";

const SLACK = 1e-13;
const WIDTH = 1e-13;
const MOST_EVALUATIONS = 200000;
const TOLERANCE = 1e-12;
const MOVED = 1.7763568394002505e-15;
const MOST_WIDENINGS = 30;
function limitsOf(family, walk, first, last) {
  let named, x, y;
  [x, y] = py.list(originAt(walk, first));
  named = py.dict([[0, family.margin], [1, SLACK], [2, WIDTH], [3, MOST_EVALUATIONS], [4, x], [5, y], [6, budgetMemory()], [7, family.question.sense], [8, py.max(TOLERANCE, family.tolerance)], [9, first], [10, py.max(first, last)], [11, family.first]]);
  return inColumns(named);
}
function squareOf(family, fixed) {
  let corners, given, most, moves, one, outline, route, thing, things;
  [route, given] = py.list([family.plan.route, family.plan.obstacles()]);
  moves = (!py.truth(fixed) && ((route.at != null) || (route.turned !== 0.0)));
  things = [];
  corners = [];
  for (thing of py.iter(given)) {
    most = py.max(py.list(py.tolist(thing.walls)).flatMap((point) => py.list(point).map((value) => py.abs(value))));
    one = (py.truth(moves) ? route.unplaced(thing) : thing);
    outline = py.tolist(one.walls);
    py.append(things, [one.sort, one.radius, one.margin, py.len(outline), (py.truth(moves) ? (MOVED * most) : 0.0)]);
    corners = py.extend(corners, outline);
  }
  return ({ things: py.reshape(py.array(things, "d"), -1, 5), outlines: py.reshape(py.array(corners, "d"), -1, 2) });
}
export class SizeQuestion extends EngineQuestion {
  constructor(family, progress) {
    let doubts, end, figures, handle, laid, limits, meetings, own, square, start, state, walk;
    [walk, start, end] = py.list(family.walk(family.first));
    limits = limitsOf(family, walk, ...py.iter(py.tolist(walk.head_position([start, end]))));
    [own, laid] = py.list(kernelFamily(family, walk));
    square = squareOf(family, py.eq(py.at(own.numbers, 1), 0));
    handle = py.entry("bd_size_question_open_size", own, laid, square, limits, beginnings())[0];
    [state, doubts] = py.list([py.zeros(24), py.empty(py.add(80, 40))]);
    [meetings, figures] = py.list([py.full([4, 4], -1.0), py.zeros(16)]);
    super(handle, py.entered("bd_size_question_step_size"), py.entered("bd_size_question_read_size"), figures, state, doubts, meetings);
    this.state = state;
    this._doubts = doubts;
    this._meetings = meetings;
    this.progress = progress;
  }
  get evaluations() {
    return py.int(py.at(this.figures, 2));
  }
  get doubts() {
    let doubts;
    doubts = py.tolist(py.slice(this._doubts, null, py.int(py.at(this.state, 16))));
    return doubts;
  }
  get in_doubt() {
    let high, low;
    [low, high] = py.list(py.sorted(py.list([5, 6]).map((column) => py.float(py.at(this.state, column)))));
    return py.list(this.doubts).some((size) => ((low < size) && (size < high)));
  }
  get guide() {
    let i, j, left, s;
    [s, left, i, j] = py.list(py.tolist(py.at(this._meetings, 1)));
    return (py.eq(i, -1.0) ? null : new Meeting(s, left, py.int(i), py.int(j)));
  }
  async limit(size) {
    return (await this._sought(0, size));
  }
  async trial(size) {
    (await this._sought(3, size));
    return py.int(py.at(this.figures, 3));
  }
  async _sought(stage, size, good = NaN) {
    let ending, now, tried;
    py.entry("bd_size_question_seek_size", this._handle, stage, size, good)[0];
    [ending, tried] = py.list([8, NaN]);
    while (py.eq(ending, 8)) {
      ending = (await this.step());
      if (!py.eq((now = py.float(py.at(this.state, 20))), tried)) {
        this.progress(0.0, `${py.format(now, `.9g`)} m`);
        tried = now;
      }
    }
    return ending;
  }
  blocked(size) {
    return (py.eq(py.at(this.figures, 12), size) ? py.int(py.at(this.figures, 13)) : null);
  }
  async surely_bad(good, bad) {
    let _widening;
    for (_widening of py.iter(py.range(MOST_WIDENINGS))) {
      if (((this.blocked(bad) == null) || py.truth(py.at(this.figures, 14)))) {
        return bad;
      }
      bad = py.extend(bad, (2.0 * py.sub(bad, good)));
      if (!py.eq((await this.trial(bad)), 1)) {
        break;
      }
    }
    throw new UnsureError(_("the bracket could not be established beside an obstacle"));
  }
}
