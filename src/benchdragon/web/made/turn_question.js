// @ts-nocheck
// Made from solve/turn_question.py by tools/make_twins.py; to make it again: make generate

import { hold as budgetHold } from "../compute/budget.js";
import { EngineQuestion } from "../compute/engine_question.js";
import { py } from "../compute/python.js";
import { QUANTITIES, givenLimits } from "./speed.js";

const BOX_COLUMNS = 6;
const PRUDENCE = 1e-08;
const EXCEEDED = 1e-07;
const FAMILIES = py.dict([["arc-arc", 0], ["arc-line-arc", 1], ["arc-arc-arc", 2]]);
export const SOUGHT = py.dict([["way", 10], ["length", 9], ["disc", 7], ["speed", 0], ["acceleration", 3]]);
const LIMITS = py.dict([[8, "radius"], [7, "disc"], [9, "length"], [10, "way"], [0, "speed"], [1, "turning_rate"], [2, "lateral_acceleration"], [3, "total_acceleration"], [4, "acceleration"], [5, "clearance"], [6, "obstacles"]]);
class Seen {
  constructor(x, figures, exceeds) {
    this.x = x;
    this.figures = figures;
    this.exceeds = exceeds;
  }
  *[Symbol.iterator]() {
    yield* [this.x, this.figures, this.exceeds];
  }
  get allowed() {
    return (this.exceeds <= EXCEEDED);
  }
}
function toldOfLimits(family) {
  let goal, known, limit, name, plan;
  [plan, goal] = py.list([family.plan, family.goal]);
  known = py.dict([[0, py.at(FAMILIES, plan.turn.family)], [1, ((goal.objective === "acceleration") ? NaN : plan.turn.ease)], [2, family.pitch], [3, family.disc], [4, family.narrowest], [7, plan.walk.speed], [5, goal.longest], [6, goal.longest_way], [8, plan.limits.margin], [9, py.at(SOUGHT, goal.objective)]]);
  for ([name, limit] of py.iter(py.items(givenLimits(plan)))) {
    if (!py.eq(py.at(QUANTITIES, name).kind, py.at(SOUGHT, goal.objective))) {
      py.set(known, py.add(10, py.at(QUANTITIES, name).kind), limit);
    }
  }
  return py.array(py.list(py.range(15)).map((column) => py.get(known, column, Infinity)));
}
function _side(obstacle) {
  return py.get(py.dict([["venue", -1.0], ["line", 0.0], ["circle", 0.0]]), obstacle.kind, 1.0);
}
export class TurnQuestion extends EngineQuestion {
  constructor(family) {
    let border, found, handle, high, keep, kind, low, obstacle, seen, sizes, standing;
    [low, high] = py.list(py.list([0, 1]).map((n) => py.array(py.list(family.bounds).map((pair) => py.at(pair, n)))));
    standing = [];
    border = [0];
    for (obstacle of py.iter(family.obstacles)) {
      standing = py.extend(standing, py.tolist(obstacle.boxes));
      py.append(border, py.len(standing));
    }
    keep = py.list(family.obstacles).map((one) => [py.add(one.radius, one.margin), _side(one)]);
    budgetHold(((8 * BOX_COLUMNS) * py.len(standing)));
    sizes = py.array(py.list(py.tolist(family.dragon.sizes)).map((row) => py.slice(row, null, 40)));
    handle = py.entry("bd_turn_question_open_turn", toldOfLimits(family), low, high, sizes, py.slice(family.dragon.links, null, 40), py.reshape(py.array(standing), -1, BOX_COLUMNS), py.array(border, "q"), py.reshape(py.array(keep), -1, 2))[0];
    [found, seen] = py.list([py.zeros(py.len(low)), py.zeros(11)]);
    super(handle, py.entered("bd_turn_question_step_turn"), py.entered("bd_turn_question_read_turn"), py.zeros(7), found, seen);
    this._found_at = found;
    this._seen = seen;
    this.factors = py.add(py.times([(1.0 + PRUDENCE)], 5), py.times([1.0], py.sub(11, 5)));
    for (kind of py.iter([5, 6])) {
      py.set(this.factors, kind, 0.0);
    }
  }
  get tried() {
    return py.int(py.at(this.figures, 3));
  }
  async best(progress, text) {
    return (await this._sought(0, py.tolist(this._found_at), progress, text));
  }
  async near(x, progress, text) {
    return (await this._sought(1, x, progress, text));
  }
  async _sought(what, x, progress, text) {
    let exceeds;
    py.entry("bd_turn_question_seek_turn", this._handle, what, py.array(x), py.array(this.factors))[0];
    while (py.eq((await this.step()), 8)) {
      progress(py.float(py.at(this.figures, 4)), text);
    }
    exceeds = py.float(py.at(this.figures, 2));
    return new Seen(py.tolist(this._found_at), py.tolist(this._seen), exceeds);
  }
  correct(seen, exact, prudence) {
    let kind, one, other;
    for ([kind, [one, other]] of py.iter(py.enumerate(py.zip(seen, exact)))) {
      if ((!py.isfinite(one) || !py.isfinite(other))) {
        continue;
      }
      if ((kind < 5)) {
        py.set(this.factors, kind, ((other / one) * (1.0 + prudence)));
      }
      else {
        if (py.has([5, 6], kind)) {
          py.set(this.factors, kind, py.max(py.add(py.sub(other, one), prudence), 0.0));
        }
      }
    }
  }
  exceeded(exact) {
    let exceeds, shares;
    exceeds = py.zeros(11);
    py.entry("bd_turn_question_judge_turn", this._handle, py.array(exact), exceeds)[0];
    shares = py.tolist(exceeds);
    return py.dict(py.list(py.items(LIMITS)).flatMap(([kind, name]) => (((py.at(shares, kind) > -1.0)) ? [[name, py.at(shares, kind)]] : [])));
  }
}
