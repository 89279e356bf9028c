// @ts-nocheck
// Made from plans/idle.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { _ } from "../words.js";

class Idle {
  constructor(path, beside, because, missing = false) {
    this.path = path;
    this.beside = beside;
    this.because = because;
    this.missing = missing;
  }
  get key() {
    return py.join(".", py.list(this.path).map((one) => py.str(one)));
  }
  get text() {
    let text;
    if (py.truth(this.missing)) {
      text = _("{key} has no effect without one of {because}: take it out, or say one of them");
      return py.filled(text, { key: this.key, because: this.because });
    }
    text = _("{key} has no effect beside {because}: take it out");
    return py.filled(text, { key: this.key, because: this.because });
  }
}
const FAMILIES = py.dict([["ratio", ["arc-arc"]], ["radii", ["arc-line-arc", "arc-arc-arc"]], ["curvature", ["arc-arc-arc"]]]);
const FORMATION_SIZES = py.dict([["coil-in", ["pitch", "outer_radius", "inner_radius", "clockwise"]], ["coil-out", ["pitch", "inner_radius", "outer_radius", "clockwise"]], ["figure-eight", ["radius", "rounds", "clockwise"]], ["three-plum-blossoms", ["radius", "waist", "rounds", "clockwise"]], ["double-door", ["pitch", "outer_radius", "inner_radius", "between", "clockwise"]], ["straight-dragon", ["length"]], ["tail-swing", ["swing", "radius", "swings", "run", "clockwise"]]]);
const ALL_SIZES = py.set_of(["between", "clockwise", "inner_radius", "length", "outer_radius", "pitch", "radius", "rounds", "run", "swing", "swings", "waist"]);
const DRAWN = py.dict([["points", ["piece", "file", "layer", "joint_gap", "joint_kink"]], ["piece", ["points", "file", "layer"]], ["file", ["points", "piece"]]]);
const CHOOSING = ["dragon", "route", "disc", "turn", "walk", "venue", "limits"];
export function idleKeys(data, latest = []) {
  let family, found, i, idle, kind, one, others, route, strays, tables, turn;
  tables = py.dict(py.list(CHOOSING).map((name) => [name, _said(py.get(data, name))]));
  [route, turn] = py.list([py.at(tables, "route"), py.at(tables, "turn")]);
  kind = (py.has(route, "part") ? "parts" : py.get(route, "kind"));
  found = [];
  if (py.has(["parts", "drawn", "spiral-in", "formation", "programme"], kind)) {
    idle = py.list(turn).map((name) => ["turn", name]);
    idle = py.extend(idle, ((kind !== "spiral-in") ? py.list(py.at(tables, "disc")).map((name) => ["disc", name]) : []));
    found = py.extend(found, py.list(idle).map((path) => new Idle(path, "route.kind", `route.kind = "${py.str(kind)}"`)));
  }
  if ((kind === "turn")) {
    family = py.get(turn, "family", "arc-arc");
    strays = py.list(py.items(FAMILIES)).flatMap(([name, families]) => (((py.has(turn, name) && !py.has(families, family))) ? [name] : []));
    found = py.extend(found, py.list(strays).map((name) => new Idle(["turn", name], "turn.family", `turn.family = "${py.str(family)}"`)));
    found = py.extend(found, _idleBack(route));
  }
  if ((kind === "formation")) {
    found = py.extend(found, _idleSizes(route, ["route"]));
  }
  if (((kind === "programme") && (py.is(py.get(route, "formation"), "list")))) {
    for ([i, one] of py.iter(py.enumerate(py.at(route, "formation")))) {
      found = py.extend(found, _idleSizes(_said(one), ["route", "formation", i]));
    }
  }
  found = py.extend(found, ((kind === "drawn") ? _idleDrawing(route, "route", latest) : []));
  found = py.extend(found, _idleDrawing(_said(py.get(route, "street")), "route.street", latest));
  if ((py.truth(py.get(py.at(tables, "walk"), "profile")) && py.has(py.at(tables, "walk"), "speed"))) {
    py.append(found, new Idle(["walk", "speed"], "walk.profile", "walk.profile"));
  }
  if (py.truth(py.get(py.at(tables, "dragon"), "bench"))) {
    others = py.list(py.at(tables, "dragon")).flatMap((name) => (((name !== "bench")) ? [["dragon", name]] : []));
    found = py.extend(found, py.list(others).map((path) => new Idle(path, "dragon.bench", "[[dragon.bench]]")));
  }
  return py.add(found, _idleOnTheSquare(py.at(tables, "venue"), py.at(tables, "limits")));
}
function _idleOnTheSquare(venue, limits) {
  let found, others;
  found = [];
  if (py.has(venue, "boundary")) {
    others = py.list(["rectangle", "centre", "angle"]).flatMap((name) => ((py.has(venue, name)) ? [["venue", name]] : []));
    found = py.extend(found, py.list(others).map((path) => new Idle(path, "venue.boundary", "venue.boundary")));
  }
  else {
    if ((!py.has(venue, "rectangle") && !py.has(venue, "file"))) {
      others = py.list(["centre", "angle"]).flatMap((name) => ((py.has(venue, name)) ? [["venue", name]] : []));
      others = py.extend(others, (py.truth(py.get(venue, "name")) ? [["venue", "name"]] : []));
      others = py.extend(others, (py.has(limits, "venue_margin") ? [["limits", "venue_margin"]] : []));
      found = py.extend(found, py.list(others).map((path) => new Idle(path, "venue", "venue.rectangle, venue.boundary, venue.file", true)));
    }
  }
  if ((py.has(venue, "layer") && !py.has(venue, "file"))) {
    py.append(found, new Idle(["venue", "layer"], "venue", "venue.file", true));
  }
  return found;
}
function _idleBack(route) {
  let because, names, rounds, strays, street;
  [rounds, street] = py.list([py.get(route, "rounds"), py.has(route, "street")]);
  if (((py.is(rounds, "int")) && (rounds > 1))) {
    return [];
  }
  names = (py.truth(street) ? ["back_radius"] : ["back_radius", "outer_radius"]);
  because = (py.truth(street) ? "route.rounds" : "route.rounds, route.street");
  strays = py.list(names).flatMap((name) => ((py.has(route, name)) ? [name] : []));
  return py.list(strays).map((name) => new Idle(["route", name], "route.rounds", because, true));
}
function _idleDrawing(table, where, latest) {
  let chosen, idle, ways;
  ways = py.sorted(DRAWN, (name) => !py.has(latest, `${py.str(where)}.${py.str(name)}`));
  chosen = py.next(py.list(ways).flatMap((name) => ((py.has(table, name)) ? [name] : [])), "");
  idle = py.list(py.get(DRAWN, chosen, [])).flatMap((name) => ((py.has(table, name)) ? [[...py.iter(py.split(where, ".")), name]] : []));
  return py.list(idle).map((path) => new Idle(path, `${py.str(where)}.${py.str(chosen)}`, `${py.str(where)}.${py.str(chosen)}`));
}
function _idleSizes(table, path) {
  let because, beside, own, strays;
  own = py.get(FORMATION_SIZES, py.str(py.get(table, "name")));
  strays = ((own == null) ? [] : py.list(table).flatMap((name) => (((py.has(ALL_SIZES, name) && !py.has(own, name))) ? [name] : [])));
  beside = py.join(".", py.list([...py.iter(path), "name"]).map((one) => py.str(one)));
  because = `${py.str(beside)} = "${py.str(py.get(table, "name"))}"`;
  return py.list(strays).map((name) => new Idle([...py.iter(path), name], beside, because));
}
function _said(table) {
  if (!(py.is(table, "dict"))) {
    return py.dict([]);
  }
  return py.dict(py.list(py.items(table)).flatMap(([name, value]) => (((value != null)) ? [[name, value]] : [])));
}
export function drop(data, idle) {
  let folder, one, table;
  for (one of py.iter(idle)) {
    table = data;
    for (folder of py.iter(py.slice(one.path, null, -1))) {
      table = py.at(table, folder);
    }
    py.pop(table, py.at(one.path, -1));
  }
}
export function dropReplaced(data, keys) {
  let made;
  made = py.set_of(keys);
  drop(data, py.list(idleKeys(data, keys)).flatMap((idle) => (((py.has(made, idle.beside) && !py.has(made, idle.key))) ? [idle] : [])));
}
