// @ts-nocheck
// Made from plans/schema.py by tools/make_twins.py; to make it again: make generate

import { InputError, PlanError } from "../compute/error_kinds.js";
import { _hashed } from "../compute/plan_check.js";
import { py } from "../compute/python.js";
import { Walk } from "../compute/walk.js";
import { _ } from "../words.js";
import { headsOf } from "./cue_places.js";
import { Paced, outside, paced } from "./cues.js";
import { drop, dropReplaced, idleKeys } from "./idle.js";
import { DECIDING } from "./people.js";
import { Fault, Faults } from "./source.js";
import { builtObstacles } from "./square.js";
import { setValue } from "./toml.js";

const ASIDE = ["meta", "venue", "obstacle", "survey", "people", "cues", "chalk", "event"];
const SQUARE = ["venue", "obstacle"];
const LATER = [["street", null], ["rounds", 1], ["outer_radius", null], ["back_radius", null]];
export class Plan {
  _sha256_() {
    let data, limits, name, needs, own, route, usual;
    [data, own] = py.list([this.whole(), this.own()]);
    for (name of py.iter(ASIDE)) {
      if ((!py.has(SQUARE, name) || !py.has(own, name))) {
        py.pop(data, name);
      }
    }
    [limits, route] = py.list([py.at(data, "limits"), py.at(data, "route")]);
    if ((py.at(limits, "venue_margin") == null)) {
      py.pop(limits, "venue_margin");
    }
    if (py.has([null, [0.0, 0.0]], py.at(route, "at"))) {
      py.pop(route, "at");
    }
    for ([name, usual] of py.iter([["turned", 0.0], ...py.iter(LATER)])) {
      if ((py.has(route, name) && py.eq(py.at(route, name), usual))) {
        py.pop(route, name);
      }
    }
    needs = py.dict(py.list(py.items(py.get(own, "people", py.dict([])))).flatMap(([name, of]) => ((py.has(DECIDING, name)) ? [[name, of]] : [])));
    if (py.truth(needs)) {
      py.set(data, "people", needs);
    }
    if (py.has(own, "cues")) {
      py.set(data, "cues", py.at(own, "cues"));
    }
    return _hashed(data);
  }
  get sha256() {
    return py.keep(this, "sha256", this._sha256_());
  }
  __dragon_() {
    return this.dragon.build();
  }
  get _dragon() {
    return py.keep(this, "_dragon", this.__dragon_());
  }
  get chain() {
    try {
      return this._dragon;
    } catch (error) {
      if (error instanceof InputError) {
        return null;
      } else
      throw error;
    }
  }
  title(language) {
    let chinese, english;
    [english, chinese] = py.list([this.meta.title, this.meta.title_zh]);
    return ((language === "zh") ? py.or(chinese, () => english) : py.or(english, () => chinese));
  }
  value(key) {
    let _dot, at, idle, name, table, tables, text;
    [table, _dot, name] = py.list(py.partition(key, "."));
    at = py.get(py.get(this, table, null), name, null);
    tables = this.said();
    py.set(tables, table, py.dict([...py.items(py.get(tables, table, py.dict([]))), [name, py.or(at, () => 0.0)]]));
    idle = py.list(idleKeys(tables)).flatMap((one) => ((py.eq(one.key, key)) ? [one.because] : []));
    if (((table === "route") && !py.has(py.vars(this.route), name))) {
      idle = [`route.kind = "${py.str(this.route.kind)}"`];
    }
    if (py.truth(idle)) {
      text = _("this needs {key}, which means nothing beside {because}: choose another plan");
      throw new PlanError(py.filled(text, { key: key, because: py.at(idle, 0) }));
    }
    if (!(py.is(at, "int") || py.is(at, "float"))) {
      throw new PlanError(py.filled(_("the plan does not say {key}: set it"), { key: key }));
    }
    return py.float(at);
  }
  data() {
    let data, name, own;
    [data, own] = py.list([this.whole(false), this.own()]);
    for (name of py.iter(["people", "cues", "chalk", "event"])) {
      py.set(data, name, py.get(own, name));
      if (!py.has(own, name)) {
        py.pop(data, name);
      }
    }
    drop(data, idleKeys(data));
    return data;
  }
  with_value(key, value) {
    return this.with_values(py.dict([[key, value]]));
  }
  with_values(values) {
    let data, key, value;
    data = this.said();
    for ([key, value] of py.iter(py.items(values))) {
      setValue(data, key, value);
    }
    dropReplaced(data, py.list(values));
    return this._changed(data);
  }
  without_square() {
    let data, name;
    data = this.said();
    for (name of py.iter(SQUARE)) {
      py.pop(data, name, null);
    }
    py.pop(py.get(data, "limits", py.dict([])), "venue_margin", null);
    return this._changed(data);
  }
  without_street() {
    let data, name, table;
    if (!py.truth(this.route.after_street)) {
      return this;
    }
    data = this.said();
    for ([table, name] of py.iter([["route", "street"], ["walk", "start"], ["walk", "end"]])) {
      py.pop(py.get(data, table, py.dict([])), name, null);
    }
    py.pop(py.get(data, "walk", py.dict([])), "position", null);
    py.pop(data, "cues", null);
    return this._changed(data);
  }
  span(walk = /** @type {any} */ (null)) {
    let end, pace, text, wrong;
    [end, pace] = py.list([this.walk.end, this.pace()]);
    if ((end == null)) {
      walk = ((walk == null) ? this.build() : walk);
      end = walk.time_at(this.route.last_position(walk));
      end = (py.truth(this.cues.cue) ? py.min(end, pace.end) : end);
    }
    if (!py.isfinite(end)) {
      text = _("the head never comes to the end of its walk: set walk.end");
      throw this._wrong([new Fault("walk", text)]);
    }
    if (py.truth((wrong = outside(this.moments(), this.start, end, pace.way(end))))) {
      throw this._wrong(wrong);
    }
    return [this.start, end];
  }
  get start() {
    return ((this.walk.start == null) ? 0.0 : this.walk.start);
  }
  moments() {
    return (py.truth(this.cues.cue) ? this.pace().moments(this.cues) : []);
  }
  profile() {
    return this.pace().profile;
  }
  pace() {
    let faults, pace;
    faults = new Faults();
    pace = faults.tried("walk", () => this._pace);
    if ((pace == null)) {
      throw this._wrong(faults.found);
    }
    return pace;
  }
  __pace_() {
    let profile;
    profile = this.walk.build();
    if ((!py.truth(this.cues.cue) && (this.cues.acceleration == null))) {
      return new Paced(profile, this.start, []);
    }
    return paced(this.cues, this._heads(profile), profile, this.start, this.limits);
  }
  get _pace() {
    return py.keep(this, "_pace", this.__pace_());
  }
  get _goes_by_route() {
    return py.list(this.cues.cue).some((cue) => ((cue.place != null) || (cue.round != null)));
  }
  _heads(profile) {
    let begun, end, first, last, route, walk;
    if (!py.truth(this._goes_by_route)) {
      return py.list(this.cues.cue).map((cue) => cue.head);
    }
    [route, begun] = py.list(this._placed);
    walk = new Walk(this._dragon, route, profile, this._at_zero(begun));
    [first, end] = py.list([py.float(py.at(walk.head_position([this.start]), 0)), this.walk.end]);
    last = ((end == null) ? this.route.last_position(walk) : py.float(py.at(walk.head_position([end]), 0)));
    return headsOf(this.cues.cue, route, first, py.min(last, route.length));
  }
  _at_zero(begun) {
    return ((this.walk.position == null) ? begun : this.walk.position);
  }
  ways() {
    let begin, end, most, pace;
    [pace, end] = py.list([this.pace(), this.walk.end]);
    begin = py.float(this.walk.build().distance(this.start));
    most = py.add(begin, pace.way(Infinity));
    if ((end == null)) {
      return [begin, ((pace.end < Infinity) ? most : NaN), most];
    }
    return [begin, py.add(begin, pace.way(end)), most];
  }
  build() {
    let begun, dragon, faults, pace, placed, position, route, told, walk;
    faults = new Faults();
    dragon = faults.tried("dragon", () => this._dragon);
    placed = faults.tried("route", () => this._placed);
    told = py.and(this._goes_by_route, () => ((dragon == null) || (placed == null)));
    pace = (py.truth(told) ? null : faults.tried("walk", () => this._pace));
    faults.tried("obstacle", () => this._obstacles);
    if (((dragon == null) || (placed == null) || (pace == null) || py.truth(faults.found))) {
      throw this._wrong(faults.found);
    }
    [route, begun] = py.list(placed);
    position = this._at_zero(begun);
    if (py.truth(this.cues.cue)) {
      position = py.extend(position, py.sub(py.at(this.ways(), 0), py.float(pace.profile.distance(this.start))));
    }
    walk = faults.tried("walk.position", () => new Walk(dragon, route, pace.profile, position));
    if ((walk == null)) {
      throw this._wrong(faults.found);
    }
    return walk;
  }
  obstacles() {
    let faults, found;
    faults = new Faults();
    found = faults.tried("obstacle", () => this._obstacles);
    if ((found == null)) {
      throw this._wrong(faults.found);
    }
    return found;
  }
  __obstacles_() {
    let _start, found, route;
    found = builtObstacles(this.venue, this.obstacle, this.limits);
    if ((!py.truth(this.route.after_street) || !py.truth(found) || (py.at(found, 0).kind !== "venue"))) {
      return found;
    }
    try {
      [route, _start] = py.list(this._placed);
    } catch (error) {
      if (error instanceof InputError) {
        return found;
      } else
      throw error;
    }
    return [this.route.gated(py.at(found, 0), route, this), ...py.iter(py.slice(found, 1, null))];
  }
  get _obstacles() {
    return py.keep(this, "_obstacles", this.__obstacles_());
  }
  get _placed() {
    return this.route.whole(this);
  }
  _wrong(faults) {
    return new PlanError(this._source.sentences(faults));
  }
}
