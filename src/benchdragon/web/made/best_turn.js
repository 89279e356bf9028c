// @ts-nocheck
// Made from solve/turn.py by tools/make_twins.py; to make it again: make generate

import { InputError, NoSolutionError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { Answer } from "./answer.js";
import { leastClearance } from "./contact.js";
import { greatestHeadSpeed } from "./head_speed.js";
import { leastDistance } from "./obstacles.js";
import { QUANTITIES, givenLimits, greatestOf } from "./speed.js";
import { part, silent } from "./stages.js";
import { TurnFamily, TurnGoal } from "./turn_goal.js";
import { SOUGHT, TurnQuestion } from "./turn_question.js";

const EXCEEDED = 1e-07;
const PRUDENCE = 1e-08;
const SEARCHED = 0.7;
const NARROWINGS = 8;
const DEEP = 0.001;
const ACTIVE = 0.002;
const RATE = 1e-07;
const DISTANCE = 1e-05;
class BestTurn {
  constructor(plan, turn, objective, length, way, headSpeed, clearance, active) {
    this.plan = plan;
    this.turn = turn;
    this.objective = objective;
    this.length = length;
    this.way = way;
    this.head_speed = headSpeed;
    this.clearance = clearance;
    this.active = active;
  }
}
export async function bestTurn(plan, goal = /** @type {any} */ (null), progress = silent) {
  return py.scoped(async () => {
    let began, family, question, seen, wished;
    wished = ((goal == null) ? new TurnGoal() : goal);
    if (((wished.objective === "speed") && (plan.limits.speed == null))) {
      throw new InputError(_("the plan has no limit of speed: set limits.speed=2, for example"));
    }
    plan.profile();
    [family, began] = py.list([new TurnFamily(plan, wished), py.perf_counter()]);
    question = new TurnQuestion(family);
    try {
      seen = (await question.best(part(progress, 0.0, SEARCHED), _("global search")));
      return (await _settled(family, question, seen, part(progress, SEARCHED, 1.0), began));
    } finally {
      question.free();
    }
  });
}
async function _settled(family, question, seen, progress, began) {
  let best, exact, narrowing;
  for (narrowing of py.iter(py.range(NARROWINGS))) {
    if (!py.truth(seen.allowed)) {
      break;
    }
    [best, exact] = py.list((await _exact(family, question, seen, began)));
    if ((exact == null)) {
      return best;
    }
    question.correct(seen.figures, exact, (PRUDENCE * (4.0 ** narrowing)));
    seen = (await question.near(seen.x, part(progress, (narrowing / NARROWINGS), 1.0), _("local search")));
  }
  throw new NoSolutionError(_("no turn of this family was found that keeps the limits"));
}
async function _exact(family, question, seen, began) {
  let active, answer, best, bracket, clearance, disc, exact, exceeds, goal, most, plan, speed, turn, unit, value;
  [plan, goal] = py.list([family.with_turn(seen.x), family.goal]);
  [exact, clearance] = py.list((await _exactFigures(plan, seen.figures, _judged(family))));
  exceeds = question.exceeded(exact);
  [value, unit] = py.list([py.at(exact, py.at(SOUGHT, goal.objective)), "m"]);
  if ((goal.objective === "disc")) {
    plan = plan.with_value("disc.radius", value);
  }
  speed = ((plan.limits.speed != null) ? (await greatestHeadSpeed(plan)) : null);
  bracket = [value, -Infinity, value];
  if ((goal.objective === "acceleration")) {
    [most, unit] = py.list([(value * (plan.walk.speed ** 2)), "m/s^2"]);
    bracket = [most, -Infinity, most];
  }
  else {
    if (((goal.objective === "speed") && (speed != null))) {
      [bracket, unit] = py.list([[speed.value, speed.lower, Infinity], "m/s"]);
    }
  }
  answer = new Answer(...py.iter(bracket), unit, "found", null, [_("best that was found in this family; better ones may exist")], question.tried, py.sub(py.perf_counter(), began));
  [turn, disc] = py.list([plan.turn.build(family.pitch, family.disc), py.or(plan.disc.radius, () => family.disc)]);
  active = py.tuple(py.list(py.items(exceeds)).flatMap(([name, over]) => ((((over >= -ACTIVE) && !py.eq(name, goal.objective))) ? [name] : [])));
  best = new BestTurn(plan, turn, answer, turn.length, turn.way(disc), speed, clearance, active);
  return [best, ((py.max(py.values(exceeds), undefined, 0.0) > EXCEEDED) ? exact : null)];
}
function _judged(family) {
  let limited, sought;
  sought = py.at(SOUGHT, family.goal.objective);
  limited = givenLimits(family.plan);
  return py.list(py.items(QUANTITIES)).flatMap(([name, rate]) => (((py.has(limited, name) || py.eq(rate.kind, sought))) ? [name] : []));
}
async function _exactFigures(plan, seen, rates) {
  let clearance, distance, end, exact, first, lacking, last, name, obstacle, quantity, start, walk, within;
  [walk, exact] = py.list([plan.build(), [...py.iter(seen)]]);
  [first, last] = py.list([py.float(py.at(walk.route.joints, 1)), walk.head_where_tail(py.float(py.at(walk.route.joints, -2)))]);
  for (name of py.iter(rates)) {
    quantity = py.at(QUANTITIES, name);
    py.set(exact, quantity.kind, (await greatestOf(walk, quantity, first, last, RATE)).upper);
  }
  [start, end] = py.list([walk.time_at(first), walk.time_at(last)]);
  within = py.max((-1.2 * py.at(seen, 5)), plan.limits.margin, 0.05);
  clearance = (await leastClearance(walk, start, end, within, [DISTANCE]));
  py.set(exact, 5, -_sure(clearance));
  lacking = [];
  for (obstacle of py.iter(plan.obstacles())) {
    distance = (await leastDistance(walk, obstacle, start, end, [DISTANCE]));
    py.append(lacking, py.sub(obstacle.margin, _sure(distance)));
  }
  py.set(exact, 6, py.max(lacking, undefined, NaN));
  return [exact, clearance];
}
function _sure(distance) {
  return ((distance.value > 0.0) ? distance.lower : -DEEP);
}
