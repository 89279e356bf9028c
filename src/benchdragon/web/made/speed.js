// @ts-nocheck
// Made from analysis/speed.py by tools/make_twins.py; to make it again: make generate

import { OverBudgetError, allow as budgetAllow } from "../compute/budget.js";
import { EngineQuestion } from "../compute/engine_question.js";
import { InputError, UnsureError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";
import { Answer, Witness } from "./answer.js";
import { inOrder } from "./errors.js";
import { SpeedProfile, Stretches } from "./profile.js";
import { Rounds, repeats } from "./rounds.js";
import { silent } from "./stages.js";

const askedOf = (of, start, end, walk = of) => [walk, start, end];
const FIRST_CHAIN_STEP = 0.1;
const ROUNDING = 1e-11;
const TOLERANCE = 1e-10;
const LEAST_TOLERANCE = 1e-12;
const ROOM = [500000, 1024, 5000000, 100000, 24.0, 0.8, 0.1, 1e-11];
const PLACES = 1000000;
const TOLD = 0.001;
export class Quantity {
  constructor(name, kind, power, unit, text) {
    this.name = name;
    this.kind = kind;
    this.power = power;
    this.unit = unit;
    this.text = text;
  }
}
export const QUANTITIES = py.dict([["speed", new Quantity("speed", 0, 1, "m/s", N_("speed of a handle"))], ["turning_rate", new Quantity("turning_rate", 1, 1, "rad/s", N_("turning rate of a bench"))], ["lateral_acceleration", new Quantity("lateral_acceleration", 2, 2, "m/s^2", N_("lateral acceleration of a handle"))], ["total_acceleration", new Quantity("total_acceleration", 3, 2, "m/s^2", N_("total acceleration of a handle"))], ["acceleration", new Quantity("acceleration", 4, 2, "m/s^2", N_("acceleration of a handle along the route"))]]);
class Peak {
  constructor(value, upper, time, s, row, evaluations, least = 0.0, point = [NaN, NaN]) {
    this.value = value;
    this.upper = upper;
    this.time = time;
    this.s = s;
    this.row = row;
    this.evaluations = evaluations;
    this.least = least;
    this.point = point;
  }
}
export async function greatestSpeed(walk, start = /** @type {any} */ (null), end = /** @type {any} */ (null), tolerance = TOLERANCE, progress = silent) {
  [walk, start, end] = py.list(askedOf(walk, start, end));
  return (await greatest(walk, py.at(QUANTITIES, "speed"), start, end, tolerance, undefined, progress));
}
export async function greatest(walk, quantity, start, end, tolerance = TOLERANCE, limit = Infinity, progress = silent) {
  return py.scoped(async () => {
    let began, found, stretches, witness;
    began = py.perf_counter();
    inOrder(start, end);
    stretches = walk.profile.stretches(start, end).moved(walk.start);
    found = (await sought(walk, stretches, [[quantity, tolerance, limit]], progress)).peak;
    witness = py.replaced(witnessOf(walk, quantity, found), { time: found.time });
    return new Answer(found.value, found.least, found.upper, quantity.unit, "found", witness, [], found.evaluations, py.sub(py.perf_counter(), began));
  });
}
export async function greatestOf(walk, quantity, first, last, tolerance = TOLERANCE, limit = Infinity, progress = silent) {
  return py.scoped(async () => {
    let stretches;
    stretches = SpeedProfile.constant(1.0).stretches(first, last);
    return (await sought(walk, stretches, [[quantity, tolerance, limit]], progress)).peak;
  });
}
class Found {
  constructor(peak, lower, upper, decides) {
    this.peak = peak;
    this.lower = lower;
    this.upper = upper;
    this.decides = decides;
  }
}
export class PeakQuestion extends EngineQuestion {
  constructor(walk, drives, asked = [], head = 0.0) {
    let driven, group, handle, kinds, limit, limits, links, numbers, quantity, squares, text, tolerance, tolerances;
    [tolerances, limits] = py.list([py.times([0.0], 5), py.times([Infinity], 5)]);
    for ([quantity, tolerance, limit] of py.iter(asked)) {
      if (!((LEAST_TOLERANCE <= tolerance) && (tolerance <= 1.0))) {
        text = _("tolerance must lie between {least} and 1, not at {value}");
        throw new InputError(py.filled(text, { least: `${py.format(LEAST_TOLERANCE, `g`)}`, value: tolerance }));
      }
      py.set(tolerances, quantity.kind, tolerance);
      py.set(limits, quantity.kind, limit);
    }
    links = py.tolist(walk.dragon.links);
    kinds = py.sorted(py.set_of(links));
    numbers = py.dict(py.list(py.enumerate(kinds)).map(([n, link]) => [link, n]));
    group = py.array(py.list(links).map((link) => py.at(numbers, link)), "q");
    squares = py.array(py.list(py.tolist(drives.speeds)).map(([slow, fast]) => [(slow * slow), (fast * fast)]));
    driven = ({ ways: py.array(drives.ways), squares: squares, rates: py.array(drives.rates) });
    handle = py.entry("bd_speed_question_open_peak", walk.route.rows, walk.dragon.links, py.array(kinds), group, driven, py.array(tolerances), py.array(limits), py.array([walk.dragon.extent, head, ...py.iter(ROOM)]))[0];
    super(handle, py.entered("bd_speed_question_step_peak"), py.entered("bd_speed_question_read_peak"), py.zeros(27));
  }
  bound(at, first, last, square, limits, most, table) {
    return py.entry("bd_speed_question_bound_peak", this._handle, at, first, last, square, limits, most, table)[0];
  }
}
export async function sought(walk, stretches, asked, progress, head = 0.0) {
  let decides, drives, ending, found, kept, least, lower, most, number, placed, quantities, question, row, s, seen, share, stretch, time, upper, value, x, y;
  [quantities, ending] = py.list([py.list(py.values(QUANTITIES)), 8]);
  [drives, kept] = py.list(_new(walk, stretches));
  question = new PeakQuestion(walk, drives, asked, head);
  try {
    while (py.eq(ending, 8)) {
      try {
        ending = (await question.step());
      } catch (error) {
        if (error instanceof OverBudgetError) {
          if (!py.truth(py.at(question.figures, 16))) {
            throw error;
          }
          ending = 1;
          budgetAllow(TOLD);
        } else
        throw error;
      }
      [share, number] = py.list(question.tell(15, 14));
      progress(share, (py.truth(head) ? _(py.at(quantities, py.int(number)).text) : ""));
    }
    if (py.eq(ending, 2)) {
      throw failureWithin(walk, ...py.iter(question.tell(17, 18)));
    }
    found = question.tell(...py.iter(py.range(2, 14)));
  } finally {
    question.free();
  }
  [value, least, most, s, row, x, y, stretch, placed, lower, upper, decides] = py.list(found);
  time = stretches.time(py.at(kept, py.int(stretch)), s);
  seen = new Peak(value, most, time, s, py.int(row), py.int(placed), least, [x, y]);
  return new Found(seen, lower, upper, ((decides >= 0.0) ? py.at(quantities, py.int(decides)) : null));
}
function _new(walk, stretches) {
  let change, fast, first, kept, last, n, of, parts, rates, rounds, spans, speeds, times, ways;
  [times, ways, speeds, rates] = py.list(py.list(stretches).map((table) => py.tolist(table)));
  rounds = new Rounds(walk, repeats(walk.route.rows));
  parts = [];
  kept = [];
  for ([n, [first, last]] of py.iter(py.enumerate(ways))) {
    spans = ((py.at(rates, n) === 0.0) ? py.at(rounds.new(first, last), 0) : [[first, last]]);
    parts = py.extend(parts, spans);
    kept = py.extend(kept, py.times([n], py.len(spans)));
  }
  [of, fast, change] = py.list(py.list([times, speeds, rates]).map((table) => py.array(py.list(kept).map((n) => py.at(table, n)))));
  return [new Stretches(of, py.array(parts), fast, change), kept];
}
export function witnessOf(walk, quantity, found) {
  let row, time;
  [time, row] = py.list([walk.time_at(found.s), found.row]);
  return new Witness((py.isfinite(time) ? time : null), found.s, [py.min((row + 1), py.len(walk.dragon))], found.point, NaN, undefined, (py.eq(quantity.kind, 1) ? null : row));
}
export function fastestHandle(speeds) {
  let most;
  most = (py.max(speeds) * (1.0 - ROUNDING));
  return py.next(py.list(py.enumerate(speeds)).flatMap(([n, speed]) => (((speed >= most)) ? [n] : [])));
}
export function failureWithin(walk, low, high) {
  let at, count, end, error, n, per, step;
  [end, step] = py.list([py.max(low, py.min(high, walk.route.length)), (FIRST_CHAIN_STEP * py.min(py.tolist(walk.dragon.links)))]);
  [count, per] = py.list([py.ceil((py.sub(end, low) / step)), py.max(2, py.div(PLACES, (py.len(walk.dragon) + 1)))]);
  for (n of py.iter(py.range(0, (count + 1), (per - 1)))) {
    at = py.list(py.range(n, py.add(n, per))).map((k) => py.min(py.add(low, (step * k)), end));
    error = walk.first_failure(py.array(at));
    if ((error != null)) {
      return error;
    }
  }
  if (((error = walk.first_failure(py.array([high]))) != null)) {
    return error;
  }
  return new UnsureError(_("it could not be shown that the dragon stands all along"));
}
export function givenLimits(plan) {
  let given;
  given = py.dict(py.list(QUANTITIES).map((name) => [name, plan.limits[name]]));
  if ((py.at(given, "turning_rate") != null)) {
    py.set(given, "turning_rate", py.radians(py.at(given, "turning_rate")));
  }
  return py.dict(py.list(py.items(given)).flatMap(([name, value]) => (((value != null)) ? [[name, value]] : [])));
}
