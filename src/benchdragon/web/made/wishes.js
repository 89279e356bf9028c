// @ts-nocheck
// Made from solve/wishes.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { checked } from "../compute/plan.js";
import { py } from "../compute/python.js";
import { N_, _, both } from "../words.js";

const MOST_BENCHES = 500;
const MOST_BEARERS = 8;
const MOST_ROUNDS = 20;
const asNumber = (_name, value) => value;
const NAME = "benchdragon new";
const SHOULDERS = 0.5;
const SWAY = 0.05;
const IMPRECISION = 0.1;
const MARGIN = 0.05;
const VENUE_MARGIN = 0.5;
const ELBOWS = 0.5;
const AGAIN = 2;
const CORNERS = 90;
const TITLE = N_("A bench dragon on our square");
export class Wishes {
  constructor(benches, length, width, headLength = 2.0, inset = 0.15, rectangle = /** @type {any} */ (null), radius = /** @type {any} */ (null), bearers = 2, carry = "beside", speed = 0.8, mostSpeed = 1.5, kind = /** @type {any} */ (null), roster = "", sway = SWAY, imprecision = IMPRECISION, measured = py.frozenset(), obstacles = [], boundary = /** @type {any} */ (null), rounds = 1, street = /** @type {any} */ (null)) {
    this.benches = benches;
    this.length = length;
    this.width = width;
    this.head_length = headLength;
    this.inset = inset;
    this.rectangle = rectangle;
    this.radius = radius;
    this.bearers = bearers;
    this.carry = carry;
    this.speed = speed;
    this.most_speed = mostSpeed;
    this.kind = kind;
    this.roster = roster;
    this.sway = sway;
    this.imprecision = imprecision;
    this.measured = measured;
    this.obstacles = obstacles;
    this.boundary = boundary;
    this.rounds = rounds;
    this.street = street;
    this.__post_init__();
  }
  __post_init__() {
    let name, names;
    names = ["benches", "length", "width", "head_length", "inset", "bearers", "speed", "rounds"];
    for (name of py.iter([...py.iter(names), "sway", "imprecision"])) {
      asNumber(name, this[name]);
    }
  }
  get stray() {
    return py.add(this.sway, this.imprecision);
  }
  get between() {
    return py.add(MARGIN, (2.0 * this.stray));
  }
  get beside() {
    if ((this.carry === "beside")) {
      return SHOULDERS;
    }
    return py.max(0.0, roundedUp((0.5 * py.sub(SHOULDERS, this.width)), 0.01));
  }
  get venue() {
    if ((this.rectangle != null)) {
      return py.dict([["rectangle", py.list(this.rectangle)]]);
    }
    return py.dict([["boundary", py.list(this.corners).map((corner) => py.list(corner))]]);
  }
  get corners() {
    let length, width;
    if ((this.rectangle != null)) {
      [length, width] = py.list(this.rectangle);
      return [[0.0, 0.0], [length, 0.0], [length, width], [0.0, width]];
    }
    return ((this.boundary == null) ? _round(py.or(this.radius, () => 0.0)) : this.boundary);
  }
  plan(kind, pitch, disc, ahead) {
    let data, people, rounds, said, sources, title;
    rounds = ((kind === "turn") ? py.min(this.rounds, AGAIN) : 1);
    title = both(() => _(TITLE));
    people = py.dict([["beside", this.beside], ["ahead", ahead], ["sway", this.sway], ["imprecision", this.imprecision], ["most_speed", this.most_speed]]);
    sources = py.dict(py.list(py.sorted(this.measured)).map((name) => [name, _("measured by the troupe")]));
    people = py.merge(people, (py.truth(sources) ? py.dict([["source", sources]]) : py.dict([])));
    data = py.dict([["schema", 1], ["meta", py.dict([["title", title.en], ["title_zh", title.zh]])], ["dragon", py.dict([["benches", this.benches], ["width", this.width], ["head_length", this.head_length], ["body_length", this.length], ["tail_length", this.length], ["front_inset", this.inset], ["rear_inset", this.inset]])], ["route", py.union(py.dict([["kind", kind], ["pitch", pitch]]), ((rounds > 1) ? py.dict([["rounds", rounds]]) : py.dict([])))], ["disc", py.dict([["radius", disc]])], ["walk", py.dict([["speed", this.speed]])], ["limits", py.dict([["speed", this.most_speed], ["margin", MARGIN], ["venue_margin", VENUE_MARGIN]])], ["venue", this.venue], ["people", py.union(people, (py.truth(this.roster) ? py.dict([["roster", this.roster]]) : py.dict([])))]]);
    said = py.union(data, (py.truth(this.obstacles) ? py.dict([["obstacle", py.list(this.obstacles).map((one) => py.dict(one))]]) : py.dict([])));
    return checked(said, NAME);
  }
}
function _round(radius) {
  let angles;
  angles = py.list(py.range(CORNERS)).map((n) => (((2.0 * Math.PI) * n) / CORNERS));
  return py.list(angles).map((angle) => [(py.round((radius * py.cos(angle)), 3) + 0.0), (py.round((radius * py.sin(angle)), 3) + 0.0)]);
}
export function roundedUp(value, step) {
  return py.round((py.ceil(((value / step) - 1e-09)) * step), 6);
}
export function roundedDown(value, step) {
  return py.round((py.floor(((value / step) + 1e-09)) * step), 6);
}
export function refuse(wishes) {
  let behind, text;
  if ((py.count([wishes.rectangle, wishes.radius, wishes.boundary], null) !== 2)) {
    throw new InputError(_("say how large the square is: its rectangle, its radius or its corners"));
  }
  if (!((2 <= wishes.benches) && (wishes.benches <= MOST_BENCHES))) {
    text = _("a dance is proposed for 2 to {most} benches, not {count}");
    throw new InputError(py.filled(text, { most: MOST_BENCHES, count: wishes.benches }));
  }
  if (!((1 <= wishes.bearers) && (wishes.bearers <= MOST_BEARERS))) {
    text = _("a bench is carried by 1 to {most} people, not {count}");
    throw new InputError(py.filled(text, { most: MOST_BEARERS, count: wishes.bearers }));
  }
  if (((wishes.rounds > 1) && (wishes.kind === "spiral-in"))) {
    throw new InputError(_("a dance that coils in alone has no rounds: ask for either"));
  }
  if (!((1 <= wishes.rounds) && (wishes.rounds <= MOST_ROUNDS))) {
    text = _("a dance coils in and out 1 to {most} times, not {count}");
    throw new InputError(py.filled(text, { most: MOST_ROUNDS, count: wishes.rounds }));
  }
  behind = ((wishes.carry === "beside") ? py.ceil((wishes.bearers / 2)) : wishes.bearers);
  if (((behind * ELBOWS) > wishes.length)) {
    text = _("a bench of {length} m has no room for {count} bearers behind one another");
    throw new InputError(py.filled(text, { length: `${py.format(wishes.length, `g`)}`, count: behind }));
  }
}
