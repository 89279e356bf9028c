// @ts-nocheck
// Made from analysis/beats.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";

const END_SHARE = 1e-06;
const SLOWEST = 20.0;
const FASTEST = 400.0;
class Run {
  constructor(start, end, period, bar, counted) {
    this.start = start;
    this.end = end;
    this.period = period;
    this.bar = bar;
    this.counted = counted;
  }
  *[Symbol.iterator]() {
    yield* [this.start, this.end, this.period, this.bar, this.counted];
  }
  beats() {
    return py.max(0, py.ceil(py.sub((py.sub(this.end, this.start) / this.period), END_SHARE)));
  }
}
class Score {
  constructor(tempo, byStep, runs, strokes) {
    this.tempo = tempo;
    this.by_step = byStep;
    this.runs = runs;
    this.strokes = strokes;
  }
  *[Symbol.iterator]() {
    yield* [this.tempo, this.by_step, this.runs, this.strokes];
  }
}
export function scoreOf(plan, start, end) {
  let bar, byStep, moments, one, period, runs, since, still, strokes, tempo;
  [bar, tempo] = py.list([plan.cues.bar, plan.cues.tempo]);
  byStep = (tempo == null);
  if ((tempo == null)) {
    tempo = py.min(py.max(((60.0 * _pace(plan)) / plan.people.step), SLOWEST), FASTEST);
  }
  runs = [];
  [since, period, still] = py.list([start, (60.0 / tempo), 0.0]);
  function upTo(until) {
    let counted;
    if ((since < until)) {
      counted = py.min(bar, py.floor((still / period)));
      if (py.truth(counted)) {
        py.append(runs, new Run(py.sub(since, (counted * period)), since, period, bar, true));
      }
      py.append(runs, new Run(since, until, period, bar, false));
      still = 0.0;
    }
  }
  moments = plan.moments();
  for (one of py.iter(py.list(moments).flatMap((one) => ((((start <= one.time) && (one.time <= end))) ? [one] : [])))) {
    if (((one.cue.kind === "tempo") && (one.cue.tempo != null))) {
      upTo(one.time);
      [period, since] = py.list([(60.0 / one.cue.tempo), py.max(one.time, since)]);
    }
    else {
      if ((one.until > one.time)) {
        upTo(one.time);
        [since, still] = py.list([py.min(one.until, end), py.sub(one.until, one.time)]);
      }
    }
  }
  upTo(end);
  strokes = py.list(moments).flatMap((one) => ((((one.cue.kind !== "note") && ((start <= one.time) && (one.time <= end)))) ? [one.time] : []));
  return new Score(tempo, byStep, py.tuple(runs), py.tuple(py.fromkeys(strokes)));
}
export function countedIn(score) {
  let first, lead;
  if ((!py.truth(score.runs) || py.truth(py.at(score.runs, 0).counted))) {
    return score;
  }
  first = py.at(score.runs, 0);
  lead = new Run(py.sub(first.start, (first.bar * first.period)), first.start, first.period, first.bar, true);
  return py.replaced(score, { runs: [lead, ...py.iter(score.runs)] });
}
function _pace(plan) {
  return py.max(py.list(plan.walk.profile).map(([_time, speed]) => speed), undefined, plan.walk.speed);
}
