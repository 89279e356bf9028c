// @ts-nocheck
// Made from analysis/room.py by tools/make_twins.py; to make it again: make generate

import { withPeople } from "../compute/dragon.js";
import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";
import { firstSureContact } from "./contact.js";
import { obstacleAnswers } from "./obstacles.js";
import { shortage } from "./shortage.js";

const proveObstacle = () => null;
export const ASKED = py.dict([["benches", []], ["sway", ["sway"]], ["imprecision", ["imprecision"]], ["people", ["beside", "ahead"]]]);
const TEXTS = py.dict([["benches", N_("benches alone")], ["sway", N_("with sway")], ["imprecision", N_("with imprecision")], ["people", N_("with people")]]);
const TOLERANCES = [0.001];
export class Asked {
  constructor(key, value, source) {
    this.key = key;
    this.value = value;
    this.source = source;
  }
}
class RoomLevel {
  constructor(name, asked, margin, contact, obstacles, short = /** @type {any} */ (null)) {
    this.name = name;
    this.asked = asked;
    this.margin = margin;
    this.contact = contact;
    this.obstacles = obstacles;
    this.short = short;
  }
  get between() {
    let beside;
    beside = py.sum(py.list(this.asked).flatMap((one) => (((one.key === "beside")) ? [one.value] : [])));
    return py.round(py.add(this.margin, (2.0 * beside)), 9);
  }
  get first() {
    let known;
    known = [];
    known = py.extend(known, ((this.contact == null) ? [] : [[this.contact, null]]));
    known = py.extend(known, py.list(this.obstacles).flatMap((one) => (((one.contact != null)) ? [[one.contact, one.obstacle]] : [])));
    return py.min(known, (one) => [(py.at(one, 0).status === "undecided"), py.at(one, 0).value], null);
  }
  get kept() {
    let broken, contacts;
    contacts = [this.contact, ...py.iter(py.list(this.obstacles).map((one) => one.contact))];
    broken = py.set_of(py.list(contacts).flatMap((one) => (((one != null)) ? [(one.status !== "undecided")] : [])));
    return (py.has(broken, true) ? false : (py.truth(broken) ? null : true));
  }
}
export function levelsAsked(people) {
  return py.list(py.items(ASKED)).flatMap(([name, keys]) => ((py.list(keys).some((key) => py.truth(people[key]))) ? [name] : []));
}
export async function roomLevels(plan, walk, span, bare, levels, prove, progress) {
  let asked, each, end, found, level, line, margin, n, name, names, search, stands, until;
  names = levelsAsked(plan.people);
  level = new RoomLevel("benches", [], plan.limits.margin, ...py.iter(bare));
  if (py.truth(names)) {
    py.append(levels, level);
  }
  [each, line, end] = py.list([0.0, walk, py.at(_until(level, span), 1)]);
  for ([n, name] of py.iter(py.enumerate(names))) {
    progress((n / py.len(names)), _(py.at(TEXTS, name)));
    asked = _asked(plan.people, name);
    if ((name === "people")) {
      line = py.replaced(walk, { dragon: withPeople(walk.dragon, plan.people) });
    }
    else {
      each = py.extend(each, py.at(asked, 0).value);
    }
    until = _until(level, span);
    margin = py.add(plan.limits.margin, (2.0 * each));
    search = (py.truth(prove) ? _proved : null);
    found = (await firstSureContact(line, py.at(until, 0), py.at(until, 1), margin, search));
    stands = py.list(plan.obstacles()).map((one) => py.replaced(one, { margin: py.add(one.margin, each) }));
    level = new RoomLevel(name, asked, margin, found, (await _obstacles(line, stands, until, prove)));
    level = _measured(level, walk, end);
    py.append(levels, level);
  }
}
const _proved = () => null;
export function shownName(level) {
  return _(py.at(TEXTS, level.name));
}
export function askedText(level) {
  let one, said, text;
  said = [];
  for (one of py.iter(level.asked)) {
    text = _("{key} {value} m (assumption)");
    if (py.truth(one.source)) {
      text = _("{key} {value} m ({source})");
    }
    py.append(said, py.filled(text, { key: `people.${py.str(one.key)}`, value: `${py.format(one.value, `g`)}`, source: one.source }));
  }
  return py.join(_(", "), said);
}
export function withAllRoom(plan) {
  let more, people, walk;
  [walk, people] = py.list([plan.build(), plan.people]);
  if ((py.truth(people.beside) || py.truth(people.ahead))) {
    walk = py.replaced(walk, { dragon: withPeople(walk.dragon, people) });
  }
  more = py.add(people.sway, people.imprecision);
  return [walk, py.tuple(py.list(plan.obstacles()).map((one) => py.replaced(one, { margin: py.add(one.margin, more) })))];
}
function _asked(people, name) {
  let said;
  said = py.list(py.at(ASKED, name)).map((key) => [key, people[key], people.source[key]]);
  return py.tuple(py.list(said).flatMap((one) => ((py.truth(py.at(one, 1))) ? [new Asked(...py.iter(one))] : [])));
}
function _measured(level, walk, end) {
  let asked;
  if (((level.first == null) || (level.kept == null))) {
    return level;
  }
  asked = py.dict(py.list(level.asked).map((one) => [one.key, one.value]));
  return py.replaced(level, { short: shortage(walk, level.first, level.margin, asked, end) });
}
function _until(level, span) {
  let contacts, ends;
  contacts = [level.contact, ...py.iter(py.list(level.obstacles).map((one) => one.contact))];
  ends = py.list(contacts).flatMap((one) => ((((one != null) && (one.status !== "undecided"))) ? [one.upper] : []));
  return [py.at(span, 0), py.min([py.at(span, 1), ...py.iter(ends)])];
}
async function _obstacles(walk, stands, span, prove) {
  let answers, found, one;
  found = [];
  for (one of py.iter(stands)) {
    answers = (await obstacleAnswers(walk, one, py.at(span, 0), py.at(span, 1), TOLERANCES));
    py.append(found, (py.truth(prove) ? proveObstacle(walk, answers, ...py.iter(span)) : answers));
  }
  return py.tuple(found);
}
