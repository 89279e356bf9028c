// @ts-nocheck
// Made from solve/head_speed.py by tools/make_twins.py; to make it again: make generate

import { expect as budgetExpect, spend as budgetSpend } from "../compute/budget.js";
import { InputError, UnsureError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { Answer } from "./answer.js";
import { SpeedProfile } from "./profile.js";
import { PeakQuestion, QUANTITIES, failureWithin, givenLimits, sought, witnessOf } from "./speed.js";
import { silent } from "./stages.js";

const TOLERANCE = 1e-10;
const RATE_TOLERANCE = 1e-06;
const MOST_SPEED = 100.0;
const PRUDENCE = 1e-09;
const MOST_KNOTS = 5000;
const FINER = 8;
const AT_ONCE = 1000000;
const EVEN = new SpeedProfile([0.0], [1.0]);
class Pace {
  constructor(profile, steady, seconds, saved) {
    this.profile = profile;
    this.steady = steady;
    this.seconds = seconds;
    this.saved = saved;
  }
}
function _limitsOf(plan) {
  let found;
  found = givenLimits(plan);
  if (!py.truth(found)) {
    throw new InputError(_("the plan has no limit that a head speed could keep: set limits.speed=2, for example"));
  }
  return found;
}
export async function greatestHeadSpeed(plan, tolerance = TOLERANCE, progress = silent) {
  return py.scoped(async () => {
    let asked, began, first, found, last, limits, text, value, walk;
    began = py.perf_counter();
    limits = _limitsOf(plan);
    walk = plan.build();
    [first, last] = py.list(py.tolist(walk.head_position(plan.span(walk))));
    asked = py.list(py.items(limits)).map(([name, allowed]) => [py.at(QUANTITIES, name), ((name === "speed") ? tolerance : py.max(tolerance, RATE_TOLERANCE)), allowed]);
    found = (await sought(walk, EVEN.stretches(first, last), asked, progress, MOST_SPEED));
    if ((found.decides == null)) {
      return new Answer(MOST_SPEED, MOST_SPEED, Infinity, "m/s", "unlimited");
    }
    text = py.filled(_("what decides: {quantity}, at most {value} {unit}"), { quantity: _(found.decides.text), value: `${py.format(py.at(limits, found.decides.name), `.6g`)}`, unit: found.decides.unit });
    value = ((found.lower > 0.0) ? found.lower : NaN);
    return new Answer(value, found.lower, found.upper, "m/s", ((found.lower > 0.0) ? "found" : "undecided"), witnessOf(walk, found.decides, found.peak), [text], found.peak.evaluations, py.sub(py.perf_counter(), began));
  });
}
export async function slowed(plan, progress = silent) {
  return py.scoped(async () => {
    let even, first, last, profile, speeds, steady, times, walk, whole, zero;
    if (py.truth(plan.walk.profile)) {
      throw new InputError(_("the plan has a speed profile of its own: take walk.profile out"));
    }
    if (py.list(plan.cues.cue).some((cue) => py.has(["hold", "stop"], cue.kind))) {
      throw new InputError(_("cues hold the head: seek the speeds without them, then put them in again"));
    }
    steady = (await greatestHeadSpeed(plan, undefined, progress));
    if ((steady.status === "undecided")) {
      throw new UnsureError(_("it could not be shown that the dragon stands all along"));
    }
    walk = plan.build();
    [first, last] = py.list(py.tolist(walk.head_position(plan.span(walk))));
    if (!(first < last)) {
      throw new InputError(_("the walk has no length: set walk.start and walk.end apart"));
    }
    even = py.min(steady.lower, plan.walk.speed);
    [times, speeds] = py.list((await _fastest(plan, walk, first, last, progress)));
    whole = (py.sub(last, first) / even);
    if ((py.at(times, -1) >= whole)) {
      [times, speeds] = py.list([[0.0, whole], [even, even]]);
    }
    profile = new SpeedProfile(py.tuple(times), py.tuple(speeds));
    zero = profile.time(py.sub(walk.start, first));
    profile = new SpeedProfile(py.tuple(py.list(times).map((t) => py.sub(t, zero))), py.tuple(speeds));
    return new Pace(profile, steady, py.at(times, -1), py.sub(whole, py.at(times, -1)));
  });
}
async function _fastest(plan, walk, first, last, progress) {
  let at, count, end, ends, given, handles, limits, link, most, n, per, question, speeds, square, steps, table, text, times;
  [link, handles] = py.list([py.min(py.tolist(walk.dragon.links)), (py.len(walk.dragon) + 1)]);
  steps = py.max(1, py.ceil(py.min((py.sub(last, first) / (0.1 * link)), (MOST_KNOTS - 1))));
  budgetExpect((((4.0 * steps) * FINER) * handles));
  given = py.dict([...py.items(_limitsOf(plan)), ["head", plan.limits.head_acceleration]]);
  limits = py.list([...py.iter(QUANTITIES), "head"]).map((name) => ((1.0 - PRUDENCE) * py.get(given, name, Infinity)));
  [most, table] = py.list([py.empty(steps), py.empty([steps, 65, 2])]);
  at = py.linspace(first, last, ((steps * FINER) + 1));
  per = py.max(1, py.div(AT_ONCE, (handles * FINER)));
  question = new PeakQuestion(walk, EVEN.stretches(first, last));
  try {
    for (n of py.iter(py.range(0, steps, per))) {
      end = py.min(py.add(n, per), steps);
      budgetSpend((((4.0 * py.sub(end, n)) * FINER) * handles));
      square = (plan.walk.speed ** 2);
      if (py.eq(question.bound(at, n, end, square, py.array(limits), most, table), 2)) {
        throw failureWithin(walk, first, last);
      }
      progress((end / steps), _("other limits"));
      (await question.rest());
    }
  } finally {
    question.free();
  }
  ends = py.array(py.list(py.range((steps + 1))).map((n) => py.at(at, (n * FINER))));
  [times, speeds] = py.list([py.empty((steps + 1)), py.empty((steps + 1))]);
  count = py.entry("bd_head_speed_find_pace", table, most, ends, times, speeds)[0];
  if ((count < 0)) {
    text = _("no speed of the head was found that keeps the limits at {s} m of the route");
    throw new UnsureError(py.filled(text, { s: `${py.format(py.at(ends, py.sub(-1, count)), `.6g`)}` }));
  }
  return [py.tolist(py.slice(times, null, count)), py.tolist(py.slice(speeds, null, count))];
}
export function withPace(plan, pace) {
  let knots, values;
  knots = py.list(py.zip(pace.profile.times, pace.profile.speeds));
  values = py.dict([["walk.profile", knots], ["walk.start", py.at(py.at(knots, 0), 0)]]);
  if ((plan.walk.end != null)) {
    py.set(values, "walk.end", py.add(py.at(py.at(knots, 0), 0), pace.seconds));
  }
  return plan.with_values(values);
}
