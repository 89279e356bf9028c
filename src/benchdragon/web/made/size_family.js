// @ts-nocheck
// Made from solve/size_family.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";
import { inColumns, kindsOf, walkTables } from "./bench_tables.js";
import { FormationRoute, ProgrammeRoute, SpiralInRoute, TurnRoute } from "./plan_routes.js";

const LEAST_PITCH = 0.001;
const LEAST = 1e-06;
const MOST_METRES = 100000000.0;
const ROOMY = 0.9;
const FITS = 0.001;
const MOST_TURN_PIECES = 7;
const PART_COLUMNS = 8;
const ARCS = 3;
const TOLERANCE = 1e-12;
class Question {
  constructor(name, keys, sense, text, what) {
    this.name = name;
    this.keys = keys;
    this.sense = sense;
    this.text = text;
    this.what = what;
  }
}
export const QUESTIONS = py.dict([["pitch", new Question("pitch", ["route.pitch"], 1.0, N_("smallest pitch"), 0)], ["disc", new Question("disc", ["disc.radius"], 1.0, N_("smallest disc radius"), 1)], ["width", new Question("width", ["dragon.width"], -1.0, N_("widest bench"), 2)], ["length", new Question("length", ["dragon.body_length", "dragon.tail_length"], -1.0, N_("longest bench"), 3)]]);
export function question(name) {
  let text;
  if ((!(py.is(name, "str")) || !py.has(QUESTIONS, name))) {
    text = _("expected one of {known}, not {name}");
    throw new InputError(py.filled(text, { known: py.join(", ", QUESTIONS), name: name }));
  }
  return py.at(QUESTIONS, name);
}
export class Meeting {
  constructor(s, left, i, j) {
    this.s = s;
    this.left = left;
    this.i = i;
    this.j = j;
  }
}
export class PlanFamily {
  constructor(plan, question, margin, tolerance = TOLERANCE, _last = /** @type {any} */ (null)) {
    this.plan = plan;
    this.question = question;
    this.margin = margin;
    this.tolerance = tolerance;
    this._last = _last;
    this.__post_init__();
  }
  __post_init__() {
    let route, text, walk;
    route = this.plan.route;
    if ((!py.truth(route.once) && py.has(["pitch", "disc"], this.question.name))) {
      text = _("this size is sought for a coil that is walked once: take out {keys}");
      throw new InputError(py.filled(text, { keys: "route.rounds, route.street" }));
    }
    if ((py.truth(route.once) && !(route instanceof FormationRoute || route instanceof ProgrammeRoute))) {
      return null;
    }
    if ((this.question.name === "pitch")) {
      throw new InputError(_("the smallest pitch of a formation is not sought: see by a sweep over its pitch what clearance each leaves"));
    }
    walk = this.plan.build();
    if (!py.truth(route.once)) {
      this.plan = this.plan.with_value("walk.end", py.at(this.plan.span(walk), 1));
    }
    if ((this.plan.walk.position == null)) {
      this.plan = this.plan.with_value("walk.position", walk.start);
    }
  }
  get first() {
    return this.plan.value(py.at(this.question.keys, 0));
  }
  sized(size) {
    return this.plan.with_values(py.fromkeys(this.question.keys, size));
  }
  walk(size) {
    let plan, walk;
    if (((this._last == null) || !py.eq(py.at(this._last, 0), size))) {
      plan = this.sized(size);
      walk = plan.build();
      this._last = [size, [walk, ...py.iter(plan.span(walk))]];
    }
    return py.at(this._last, 1);
  }
}
function kernelNumbers(plan, question) {
  let beginWay, clockwise, disc, endWay, kind, mostWay, numbers, pitch, radii, route, start, turn, walk;
  [route, turn, walk] = py.list([plan.route, plan.turn, plan.walk]);
  [beginWay, endWay, mostWay] = py.list(plan.ways());
  [pitch, disc] = py.list([NaN, _orNan(plan.disc.radius)]);
  [kind, start, clockwise] = py.list([0, NaN, true]);
  if (!py.truth(route.once)) {
    
  }
  else {
    if ((route instanceof SpiralInRoute)) {
      [kind, pitch, start] = py.list([1, route.pitch, route.start_turn]);
      clockwise = route.clockwise;
    }
    else {
      if ((route instanceof TurnRoute)) {
        [kind, pitch, disc] = py.list([2, route.pitch, TurnRoute.disc(plan)]);
      }
    }
  }
  radii = py.or(turn.radii, () => [NaN, NaN]);
  numbers = py.dict([[0, question.what], [1, kind], [2, pitch], [3, disc], [4, start], [5, (py.truth(clockwise) ? 1.0 : -1.0)], [6, ((turn.family === "arc-arc") ? 0 : 1)], [7, _orNan(turn.entry_radius)], [8, _orNan(turn.exit_radius)], [9, turn.ratio], [10, py.at(radii, 0)], [11, py.at(radii, 1)], [12, ((turn.family === "arc-arc-arc") ? turn.curvature : 0.0)], [13, turn.ease], [14, _orNan(walk.position)], [15, beginWay], [16, endWay], [17, mostWay], [18, (py.eq(question.what, 0) ? LEAST_PITCH : LEAST)], [19, _mostSize(plan, question)], [20, ROOMY], [21, FITS]]);
  return inColumns(numbers);
}
function _mostSize(plan, question) {
  let insets;
  if (!py.eq(question.what, 3)) {
    return MOST_METRES;
  }
  insets = py.add(plan.dragon.front_inset, plan.dragon.rear_inset);
  return py.min(MOST_METRES, py.sub(py.add(plan.route.links_below(), insets), TOLERANCE));
}
function _orNan(value) {
  return ((value == null) ? NaN : value);
}
export function kernelFamily(family, walk) {
  let allOf, benches, kind, kinds, made, mark, marked, name, own, row, share, sizes;
  [name, sizes, benches] = py.list([family.question.name, walk.dragon.sizes, walkTables(walk).benches]);
  allOf = py.get(py.dict([["width", 0], ["length", 1]]), name, py.len(walk.dragon));
  share = py.list(py.range(py.len(walk.dragon))).map((n) => ((n < allOf) ? 0.0 : 1.0));
  marked = py.tolist(sizes);
  row = ((name === "width") ? 1 : 0);
  mark = (py.max(py.at(marked, row)) + 1.0);
  py.set(marked, row, py.list(py.enumerate(py.at(marked, row))).map(([n, size]) => ((n >= allOf) ? mark : size)));
  [kind, kinds] = py.list(kindsOf(py.array(marked)));
  own = ({ links: benches.links, sizes: benches.sizes, kind: kind, ahead: benches.ahead, lever: benches.lever });
  made = ({ numbers: kernelNumbers(family.plan, family.question), parts: py.empty([(MOST_TURN_PIECES + 2), PART_COLUMNS]), arcs: py.empty([ARCS, 2]), pieces: py.empty([MOST_TURN_PIECES, 3]), sizes: sizes, share: py.array(share) });
  return [made, ({ rows: walk.route.rows, benches: own, kinds: kinds })];
}
