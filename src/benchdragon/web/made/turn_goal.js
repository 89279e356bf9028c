// @ts-nocheck
// Made from solve/turn_goal.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";
import { finite, positive } from "./errors.js";
import { TurnRoute } from "./plan_routes.js";

const DEEPEST = 0.3;
const WIDEST = 0.75;
const LONGEST_EASE = 4.0;
const WIDER = 1.001;
const OBJECTIVES = py.dict([["length", N_("shortest turn")], ["way", N_("shortest path inside the disc")], ["speed", N_("greatest head speed")], ["disc", N_("smallest disc")], ["acceleration", N_("least peak total acceleration")]]);
export class TurnGoal {
  constructor(objective = "way", leastRadius = 0.0, longest = Infinity, longestWay = Infinity) {
    this.objective = objective;
    this.least_radius = leastRadius;
    this.longest = longest;
    this.longest_way = longestWay;
    this.__post_init__();
  }
  __post_init__() {
    let name, text;
    if (!py.has(OBJECTIVES, this.objective)) {
      text = _("expected one of {known}, not {name}");
      throw new InputError(py.filled(text, { known: py.join(", ", OBJECTIVES), name: this.objective }));
    }
    finite("least_radius", this.least_radius, "m");
    for (name of py.iter(["longest", "longest_way"])) {
      if (py.isfinite(this[name])) {
        positive(name, this[name], "m");
      }
    }
  }
}
export class TurnFamily {
  constructor(plan, goal) {
    let route, text;
    route = plan.route;
    if (!(route instanceof TurnRoute)) {
      throw new InputError(_("a best turn is sought for plans whose route is a turn"));
    }
    if (!py.truth(route.once)) {
      text = _("a best turn is sought for a coil that is walked once: take out {keys}");
      throw new InputError(py.filled(text, { keys: "route.rounds, route.street" }));
    }
    this.plan = plan;
    this.goal = goal;
    [this.pitch, this.disc] = py.list([route.pitch, TurnRoute.disc(plan)]);
    this.obstacles = py.list(plan.obstacles()).map((obstacle) => route.unplaced(obstacle));
    this.dragon = plan.dragon.build();
    this.narrowest = py.max(((WIDER * 0.5) * this.dragon.longest_link), goal.least_radius);
  }
  get bounds() {
    let disc, ease, inner, joints, radius, table;
    [table, disc] = py.list([this.plan.turn, this.disc]);
    joints = py.list([table.entry_radius, table.exit_radius]).map((radius) => ((radius == null) ? [(DEEPEST * disc), disc] : [radius, radius]));
    radius = [this.narrowest, py.max((WIDEST * disc), (1.01 * this.narrowest))];
    inner = py.at(py.dict([["arc-arc", [[py.log(0.2), py.log(5.0)]]], ["arc-line-arc", [radius, radius]], ["arc-arc-arc", [radius, [(-1.0 / this.narrowest), (1.0 / this.narrowest)], radius]]]), table.family);
    ease = ((this.goal.objective === "acceleration") ? [[0.0, LONGEST_EASE]] : []);
    return [...py.iter(joints), ...py.iter(inner), ...py.iter(ease)];
  }
  table(x) {
    let entry, exit, family, inner, said;
    family = this.plan.turn.family;
    [entry, exit, ...inner] = py.list(x);
    said = py.dict([["entry_radius", entry], ["exit_radius", exit]]);
    if ((this.goal.objective === "acceleration")) {
      py.set(said, "ease", py.pop(inner));
    }
    if ((family === "arc-arc")) {
      return py.dict([...py.items(said), ["ratio", py.exp(py.at(inner, 0))]]);
    }
    if ((family === "arc-arc-arc")) {
      py.set(said, "curvature", py.pop(inner, 1));
    }
    return py.dict([...py.items(said), ["radii", [py.at(inner, 0), py.at(inner, 1)]]]);
  }
  with_turn(x) {
    return this.plan.with_values(py.dict(py.list(py.items(this.table(x))).map(([name, value]) => [`turn.${py.str(name)}`, value])));
  }
}
