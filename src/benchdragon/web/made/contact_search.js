// @ts-nocheck
// Made from analysis/contact_search.py by tools/make_twins.py; to make it again: make generate

import { asideMost as budgetAsideMost, memory as budgetMemory } from "../compute/budget.js";
import { nearnessAt } from "../compute/distance.js";
import { EngineQuestion } from "../compute/engine_question.js";
import { UnsureError } from "../compute/error_kinds.js";
import { mustStand, originAt } from "../compute/nearby.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { Answer, Witness } from "./answer.js";
import { beginnings as tablesBeginnings, inColumns as tablesInColumns, tooManyKinds as tablesTooManyKinds } from "./bench_tables.js";
import { nearnessOf } from "./distance.js";
import { inOrder, notNegative } from "./errors.js";
import { HeadTimes } from "./head_times.js";
import { checkedOff, seenFrom } from "./nearby.js";
import { atMost } from "./number_format.js";
import { Rounds, repeats } from "./rounds.js";

const NEARNESS = 12;
const UNKNOWN = 1e-06;
const SLACK = 1e-13;
const WIDTH = 1e-13;
const MOST_EVALUATIONS = 200000;
const MOST_LEAST_EVALUATIONS = 2000;
export const TOLERANCES = [1e-12, 1e-08, 1e-05, 0.001];
const REFINING = 0.25;
const REFINING_ON = 0.05;
const FARTHER_AHEAD = 1.25;
export function assumedWithin(off) {
  let text;
  text = _("computed distances are within {slack} m of the exact ones");
  return [py.filled(text, { slack: atMost(off) })];
}
function witnessOf(near, origin, time, s) {
  let owner, x, y;
  owner = py.at(py.at(near.features, 0), 0);
  [x, y] = py.list(py.at(near.points, py.index(near.benches, owner)));
  return new Witness(time, s, near.benches, [py.add(x, py.at(origin, 0)), py.add(y, py.at(origin, 1))], near.distance, near.features);
}
class ContactSearch extends EngineQuestion {
  constructor(walk, start, end, margin, progress, since = -Infinity, spans = [], until = Infinity, tolerances = [], slack = /** @type {any} */ (null)) {
    let asked, dragon, figures, handle, limits, near, origin, seen, ways;
    origin = originAt(walk, start);
    [seen, ways] = py.list([seenFrom(walk, origin), py.or(spans, () => [[start, end]])]);
    slack = ((slack == null) ? SLACK : slack);
    [dragon, limits] = py.list([walk.dragon, _limits(margin, slack, start, end)]);
    asked = ({ rows: seen.route.rows, links: dragon.links, sizes: dragon.sizes, lever: py.array([dragon.lever]), spans: py.array(ways), limits: limits, tolerances: py.array(tolerances, "d"), beginnings: tablesBeginnings() });
    handle = py.entry("bd_contact_question_open_contact", asked)[0];
    if ((handle < 0)) {
      throw tablesTooManyKinds(dragon.sizes);
    }
    [near, figures] = py.list([py.empty(NEARNESS), py.zeros(28)]);
    super(handle, py.entered("bd_contact_question_step_contact"), py.entered("bd_contact_question_read_contact"), figures, near);
    this.walk = seen;
    this.origin = origin;
    this._near = near;
    this.start = start;
    this.end = end;
    this.progress = progress;
    this.spans = ways;
    this.slack = slack;
    this.times = new HeadTimes(seen, start, since, until);
    this._began = py.perf_counter();
  }
  async find(goal, said = [0.0]) {
    let at, ending, text;
    py.entry("bd_contact_question_seek_contact", this._handle, goal, py.array(said, "d"))[0];
    while (py.eq((ending = (await this.step())), 8)) {
      [at] = py.list(this.tell(2));
      this.progress((py.sub(at, this.start) / py.sub(this.end, this.start)), "");
    }
    if (py.eq(ending, 30)) {
      throw this.stopped(...py.iter(this.tell(11, 12)));
    }
    if (py.eq(ending, 31)) {
      throw new UnsureError(_("it could not be shown that the dragon stands all along"));
    }
    if (py.eq(ending, 32)) {
      text = _("the walk is too long to be searched: more than {most} cells of its route");
      throw new UnsureError(py.filled(text, { most: 2000000 }));
    }
    if (py.eq(ending, 33)) {
      checkedOff(this.off);
    }
    return ending;
  }
  stopped(sound, until) {
    let ahead, at, error, reach, text;
    [reach, at, ahead] = py.list([py.max(py.sub(py.min(until, this.end), sound), UNKNOWN), [sound], UNKNOWN]);
    while ((ahead < reach)) {
      py.append(at, py.add(sound, ahead));
      ahead = (ahead * FARTHER_AHEAD);
    }
    error = this.walk.first_failure(py.array([...py.iter(at), py.add(sound, reach)]));
    if (((error != null) && (error.head <= py.add(sound, (2.0 * UNKNOWN))))) {
      return error;
    }
    text = _("past t = {t} s it could not be shown that every bench follows without a leap");
    return new UnsureError(py.filled(text, { t: `${py.format(this.times.at(sound), `.6g`)}` }));
  }
  get off() {
    return py.max(py.float(py.at(this.figures, 7)), this.slack);
  }
  witness() {
    let s;
    [s] = py.list(this.tell(4));
    return witnessOf(nearnessOf(py.tolist(this._near)), this.origin, this.times.at(s), s);
  }
  answer(bracket, unit, status, seen = true) {
    let marched, seconds, witness;
    witness = (py.truth(seen) ? this.witness() : null);
    [marched, seconds] = py.list([py.int(py.at(this.figures, 8)), py.sub(py.perf_counter(), this._began)]);
    return new Answer(...py.iter(bracket), unit, status, witness, assumedWithin(this.off), marched, seconds);
  }
  moment(status) {
    let ahead, behind, early, known, late, lower, upper, value;
    [early, late, behind, ahead] = py.list(this.tell(3, 4, 26, 27));
    [value, lower, upper, known] = py.list(this.times.told(early, late, status, [behind, ahead]));
    return this.answer([value, lower, upper], "s", known);
  }
}
function _limits(margin, slack, start, end) {
  let named;
  named = py.dict([[0, margin], [1, slack], [2, WIDTH], [3, MOST_EVALUATIONS], [4, MOST_LEAST_EVALUATIONS], [5, budgetMemory()], [6, start], [7, end], [8, 2000], [9, budgetAsideMost(REFINING)], [10, budgetAsideMost(REFINING_ON)]]);
  return tablesInColumns(named);
}
export function standAlone(walk, times, s, i, j) {
  let origin;
  origin = originAt(walk, times.start);
  return witnessOf(nearnessAt(seenFrom(walk, origin), s, i, j), origin, times.at(s), s);
}
export function contactSearch(walk, start, end, margin, progress, whole = false, tolerances = TOLERANCES) {
  let a, b, spans;
  notNegative("margin", margin, "m");
  inOrder(start, end);
  [a, b] = py.list(py.tolist(walk.head_position([start, end])));
  spans = (py.truth(whole) ? [[a, b]] : py.at(new Rounds(walk, repeats(walk.route.rows)).new(a, b), 0));
  mustStand(walk, start);
  return new ContactSearch(walk, a, b, margin, progress, start, spans, end, tolerances);
}
