// @ts-nocheck
// Made from analysis/findings.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { givenFrom, runsOn } from "../compute/walk_facts.js";
import { N_, _ } from "../words.js";
import { keeps, shown } from "./answer.js";
import { known, seconds } from "./number_format.js";
import { handleWords } from "./numbering.js";
import { QUANTITIES, givenLimits } from "./speed.js";

const ROUNDING = 1e-11;
const NAMELESS = py.pattern("obstacle (\\p{Nd}+)", "");
const NAMELESS_VENUE = "venue";
class Kind {
  constructor(code, text) {
    this.code = code;
    this.text = text;
  }
}
const KINDS = py.dict([["contact", new Kind("BD101", N_("two benches touch"))], ["margin", new Kind("BD102", N_("two benches come nearer than the margin"))], ["walk", new Kind("BD103", N_("a bench cannot follow"))], ["route", new Kind("BD104", N_("the route is shorter than the dragon"))], ["sway", new Kind("BD105", N_("benches have no room to sway"))], ["imprecision", new Kind("BD106", N_("benches have no room for imprecision"))], ["people", new Kind("BD107", N_("people have no room beside or before a bench"))], ["speed", new Kind("BD201", N_("a handle is faster than the limit"))], ["acceleration", new Kind("BD202", N_("a handle accelerates along the route by more than the limit"))], ["lateral_acceleration", new Kind("BD203", N_("a handle's lateral acceleration exceeds the limit"))], ["total_acceleration", new Kind("BD204", N_("a handle's total acceleration exceeds the limit"))], ["turning_rate", new Kind("BD205", N_("a bench's turning rate exceeds the limit"))], ["head_acceleration", new Kind("BD206", N_("the head changes its speed by more than the limit"))], ["most_speed", new Kind("BD207", N_("a handle is faster than a bench can be carried"))], ["venue", new Kind("BD301", N_("a bench leaves the venue"))], ["venue_margin", new Kind("BD302", N_("a bench comes nearer to the venue's edge than its margin"))], ["obstacle", new Kind("BD303", N_("a bench touches an obstacle"))], ["obstacle_margin", new Kind("BD304", N_("a bench comes nearer to an obstacle than its margin"))], ["entrance", new Kind("BD401", N_("an entrance lies inside the spectators' line"))], ["crowd", new Kind("BD402", N_("too many spectators for the ground outside their line"))]]);
export class Finding {
  constructor(kind, time, benches, value, limit, sentence, words, decided = true, obstacle = "") {
    this.kind = kind;
    this.time = time;
    this.benches = benches;
    this.value = value;
    this.limit = limit;
    this.sentence = sentence;
    this.words = words;
    this.decided = decided;
    this.obstacle = obstacle;
  }
  get code() {
    return py.at(KINDS, this.kind).code;
  }
  get text() {
    let words;
    words = py.dict(py.list(this.words).flatMap((name) => (((name !== "called")) ? [[name, this.said(name)]] : [])));
    return py.filled(_(this.sentence), { ...py.object(words) });
  }
  said(name) {
    return py.filled(_(py.at(this.words, name)), { ...py.object(this.words) });
  }
}
export function allFindings(plan, walk, span, contact, obstacles, peaks, room) {
  let limits;
  limits = givenLimits(plan);
  return [...py.iter(_routeFindings(plan, walk, py.at(span, 0))), ...py.iter(_contactFindings(contact, plan.limits.margin)), ...py.iter(py.list(obstacles).flatMap((answers) => py.list(_obstacleFindings(answers)).map((found) => found))), ...py.iter(_headFindings(walk, span, plan.limits.head_acceleration)), ...py.iter(py.list(peaks).flatMap((name) => ((py.has(limits, name)) ? py.list(_limitFindings(name, py.at(peaks, name), py.at(limits, name))).map((found) => found) : []))), ...py.iter(_carryingFindings(plan, py.at(peaks, "speed"))), ...py.iter(_roomFindings(room))];
}
function _routeFindings(plan, walk, start) {
  let dragon, length, sentence, words;
  length = py.sub(walk.route.length, givenFrom(plan, walk));
  dragon = extent(walk);
  if ((!py.truth(runsOn(walk)) || (dragon <= length))) {
    return [];
  }
  sentence = N_("the route is {route} m long, the dragon {dragon} m: it is never wholly on the route");
  if ((plan.route.kind === "drawn")) {
    sentence = N_("the drawn route is {route} m long, the dragon {dragon} m: it is never wholly on the route; where the drawing is in another unit, say so by survey.unit");
  }
  words = py.dict([["route", known(length, length, "m", false)], ["dragon", known(dragon, dragon, "m", true)]]);
  return [new Finding("route", start, [py.len(walk.dragon.length)], length, dragon, sentence, words)];
}
function _contactFindings(contact, margin) {
  let a, b, decided, gap, kind, near, sentence, words;
  if (((contact == null) || (contact.witness == null))) {
    return [];
  }
  near = contact.witness;
  decided = (contact.status !== "undecided");
  kind = (((near.gap > 0.0) || (py.truth(margin) && !py.truth(decided))) ? "margin" : "contact");
  sentence = py.at(py.dict([["contact", N_("benches {a} and {b} touch at t = {t} s")], ["margin", N_("benches {a} and {b} come nearer than {margin} m at t = {t} s")]]), kind);
  if (!py.truth(decided)) {
    sentence = N_("benches {a} and {b} come to {margin} m of one another at t = {t} s, too exactly to tell on which side");
  }
  [a, b] = py.list(near.benches);
  words = py.dict([["a", py.str(a)], ["b", py.str(b)], ["t", seconds(contact.value)], ["margin", `${py.format(margin, `g`)}`]]);
  gap = py.max(near.gap, 0.0);
  return [new Finding(kind, contact.value, near.benches, gap, margin, sentence, words, decided)];
}
const OBSTACLE_SENTENCES = py.dict([["obstacle", N_("bench {bench} touches {name} at t = {t} s")], ["obstacle_margin", N_("bench {bench} comes nearer than {margin} m to {name} at t = {t} s")], ["obstacle at first", N_("bench {bench} touches {name}, or stands inside, from the start on: {t} s")], ["venue at first", N_("bench {bench} stands outside {name} from the start on: {t} s")], ["venue", N_("bench {bench} leaves {name} at t = {t} s")], ["venue_margin", N_("bench {bench} comes nearer than {margin} m to the edge of {name} at t = {t} s")]]);
function _obstacleFindings(answers) {
  let found;
  found = _obstacleFinding(answers, answers.contact, answers.obstacle.margin);
  return [...py.iter(found), ...py.iter(_obstacleFinding(answers, answers.touch, 0.0))];
}
function _obstacleFinding(answers, contact, margin) {
  let bench, decided, gap, kind, name, near, sentence, words;
  if (((contact == null) || (contact.witness == null))) {
    return [];
  }
  [near, decided] = py.list([contact.witness, (contact.status !== "undecided")]);
  kind = ((answers.obstacle.kind === "venue") ? "venue" : "obstacle");
  kind = py.extend(kind, (((near.gap > 0.0) || (py.truth(margin) && !py.truth(decided))) ? "_margin" : ""));
  sentence = py.at(OBSTACLE_SENTENCES, kind);
  if (!py.truth(decided)) {
    sentence = N_("bench {bench} comes to {margin} m of {name} at t = {t} s, too exactly to tell on which side");
  }
  if ((py.truth(decided) && (py.eq(contact.lower, contact.upper) && py.eq(contact.upper, contact.value)) && (near.gap <= 0.0))) {
    sentence = py.at(OBSTACLE_SENTENCES, `${py.str(kind)} at first`);
  }
  [bench] = py.list(near.benches);
  words = py.dict([["bench", py.str(bench)], ["t", seconds(contact.value)], ["margin", `${py.format(margin, `g`)}`]]);
  words = py.merge(words, nameWords(answers.obstacle));
  [gap, name] = py.list([py.max(near.gap, 0.0), answers.obstacle.name]);
  return [new Finding(kind, contact.value, near.benches, gap, margin, sentence, words, decided, name)];
}
const ROOM_SENTENCES = py.dict([["sway", N_("benches {a} and {b} have no room to sway at t = {t} s: {asked}")], ["imprecision", N_("benches {a} and {b} have no room for imprecision at t = {t} s: {asked}")], ["people", N_("the people of benches {a} and {b} have no room at t = {t} s: {asked}")], ["sway at", N_("bench {a} has no room to sway at {name} at t = {t} s: {asked}")], ["imprecision at", N_("bench {a} has no room for imprecision at {name} at t = {t} s: {asked}")], ["people at", N_("the people of bench {a} have no room at {name} at t = {t} s: {asked}")]]);
const ASKED_FOR = N_("{margin} m are asked for");
const SHORT = N_("{key} asks for {wanted} m; at t = {when} s, when these two are {apart} m apart, there is room for {there} m");
function _roomFindings(room) {
  if ((!py.truth(room) || (py.at(room, 0).first != null))) {
    return [];
  }
  return py.list(py.slice(room, 1, null)).flatMap((level) => py.list(_roomFinding(level)).map((found) => found));
}
function _shortWords(short) {
  let cut;
  cut = py.dict(py.list(["apart", "there"]).map((name) => [name, py.floor(py.round((1000.0 * short[name]), 6))]));
  return py.dict([["key", `people.${py.str(short.key)}`], ["wanted", `${py.format(short.wanted, `g`)}`], ["when", seconds(short.time)], ...py.items(py.dict(py.list(py.items(cut)).map(([name, value]) => [name, `${py.format((value / 1000.0), `g`)}`])))]);
}
function _roomFinding(level) {
  let contact, decided, gap, margin, name, near, obstacle, sentence, words;
  if (((level.first == null) || (py.at(level.first, 0).witness == null))) {
    return [];
  }
  [contact, obstacle] = py.list(level.first);
  [near, decided] = py.list([py.at(level.first, 0).witness, (contact.status !== "undecided")]);
  margin = ((obstacle == null) ? level.margin : obstacle.margin);
  sentence = py.at(ROOM_SENTENCES, ((obstacle == null) ? level.name : `${py.str(level.name)} at`));
  if (!py.truth(decided)) {
    sentence = N_("whether the margin of {margin} m at bench {a} is kept at t = {t} s is too close to tell");
  }
  words = py.dict([["a", py.str(py.at(near.benches, 0))], ["b", py.str(py.at(near.benches, -1))]]);
  words = py.merge(words, py.dict([["t", seconds(contact.value)], ["margin", `${py.format(margin, `g`)}`]]));
  words = py.merge(words, ((obstacle == null) ? py.dict([]) : nameWords(obstacle)));
  words = py.merge(words, ((level.short == null) ? py.dict([["asked", ASKED_FOR]]) : py.dict([["asked", SHORT], ...py.items(_shortWords(level.short))])));
  [gap, name] = py.list([py.max(near.gap, 0.0), ((obstacle == null) ? "" : obstacle.name)]);
  return [new Finding(level.name, contact.value, near.benches, gap, margin, sentence, words, decided, name)];
}
function _carryingFindings(plan, peak) {
  let found, most, sentence;
  most = plan.people.most_speed;
  found = ((most == null) ? [] : _limitFindings("speed", peak, most));
  sentence = N_("handle {handle} ({where}) moves at {value} m/s at t = {t} s; a bench can be carried at {limit} m/s at most");
  return py.list(found).map((one) => py.replaced(one, { kind: "most_speed", sentence: (py.truth(one.decided) ? sentence : one.sentence) }));
}
export function nameWords(obstacle) {
  let nameless;
  nameless = NAMELESS.fullmatch(obstacle.name);
  if ((py.truth(nameless) && (obstacle.kind !== "venue"))) {
    return py.dict([["name", N_("obstacle {n}")], ["n", py.at(nameless, 1)]]);
  }
  if (((obstacle.kind === "venue") && py.eq(obstacle.name, NAMELESS_VENUE))) {
    return py.dict([["name", N_("the venue")]]);
  }
  return py.dict([["name", N_("{called}")], ["called", obstacle.name]]);
}
export function named(obstacle) {
  let words;
  words = nameWords(obstacle);
  return py.filled(_(py.at(words, "name")), { ...py.object(words) });
}
export function shownName(obstacle) {
  return (py.has(nameWords(obstacle), "called") ? obstacle.name : named(obstacle));
}
export function touchText(bench, obstacle) {
  let text;
  text = _("bench {bench} touches {name}");
  if ((obstacle.kind === "venue")) {
    text = _("bench {bench} leaves {name}");
  }
  return py.filled(text, { bench: bench, name: named(obstacle) });
}
function _headFindings(walk, span, limit) {
  let sentence, time, value, words;
  [value, time] = py.list(steepest(walk, span));
  if ((value <= (limit * (1.0 + ROUNDING)))) {
    return [];
  }
  sentence = N_("the head changes its speed by {value} m/s^2 from t = {t} s on, the limit being {limit} m/s^2");
  words = py.dict([["t", seconds(time)]]);
  words = py.merge(words, py.dict([["value", known(value, value, "m/s^2", true, limit)], ["limit", `${py.format(limit, `g`)}`]]));
  return [new Finding("head_acceleration", time, [1], value, limit, sentence, words)];
}
function steepest(walk, span) {
  let rates, stretches;
  stretches = walk.profile.stretches(py.at(span, 0), py.at(span, 1));
  rates = py.list(py.tolist(stretches.rates)).map((rate) => py.abs(rate));
  return [py.max(rates), py.at(py.at(py.tolist(stretches.times), py.index(rates, py.max(rates))), 0)];
}
function extent(walk) {
  return walk.dragon.extent;
}
function _toldApart(value, limit) {
  let digits;
  digits = py.next(py.list(py.range(6, 17)).flatMap((n) => ((!py.eq(`${py.format(value, `.${py.str(n)}g`)}`, `${py.format(limit, `.${py.str(n)}g`)}`)) ? [n] : [])), 6);
  return py.dict([["value", `${py.format(value, `.${py.str(digits)}g`)}`], ["limit", `${py.format(limit, `.6g`)}`]]);
}
function _limitFindings(name, peak, limit) {
  let decided, kept, near, quantity, sentence, words;
  [near, quantity] = py.list([peak.witness, py.at(QUANTITIES, name)]);
  kept = keeps(peak, limit);
  if ((py.truth(kept) || (near == null))) {
    return [];
  }
  sentence = N_("whether the {what} keeps to {limit} {unit} is undecided: {value} {unit} was reached");
  if ((kept === false)) {
    sentence = N_("{what} at bench {bench} is {value} {unit} at t = {t} s, the limit being {limit} {unit}");
  }
  if (((kept === false) && (name === "speed"))) {
    sentence = N_("handle {handle} ({where}) moves at {value} m/s at t = {t} s, the limit being {limit} m/s");
  }
  else {
    if (((kept === false) && (near.handle != null))) {
      sentence = N_("{what} is {value} {unit} at handle {handle} ({where}) at t = {t} s, the limit being {limit} {unit}");
    }
  }
  words = py.dict([["what", quantity.text], ["unit", quantity.unit], ...py.items(handleWords(py.or(near.handle, () => 0), py.at(near.benches, 0))), ["t", seconds(py.or(near.time, () => 0.0))], ...py.items(_toldApart(peak.value, limit))]);
  if ((kept === false)) {
    words = py.merge(words, py.dict([["value", shown(peak, true, limit)], ["limit", `${py.format(limit, `g`)}`]]));
  }
  decided = (kept != null);
  return [new Finding(name, near.time, near.benches, peak.value, limit, sentence, words, decided)];
}
