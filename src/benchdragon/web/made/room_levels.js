// @ts-nocheck
// Made from analysis/room.py by tools/make_twins.py; to make it again: make types

import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";

export const ASKED = py.dict([["benches", []], ["sway", ["sway"]], ["imprecision", ["imprecision"]], ["people", ["beside", "ahead"]]]);
const TEXTS = py.dict([["benches", N_("benches alone")], ["sway", N_("with sway")], ["imprecision", N_("with imprecision")], ["people", N_("with people")]]);
export class Asked {
  constructor(key, value, source) {
    this.key = key;
    this.value = value;
    this.source = source;
  }
}
export class RoomLevel {
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
export function shownName(level) {
  return _(py.at(TEXTS, level.name));
}
