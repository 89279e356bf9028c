// @ts-nocheck
// Made from analysis/records.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { both } from "../words.js";
import { peakText, sentence } from "./check.js";
import { shownName } from "./findings.js";
import { finiteOrNone } from "./number_format.js";
import { shownName as levelName } from "./room_levels.js";

const __version__ = "0.1.0";
function _finiteOrNone(value) {
  return ((py.is(value, "float")) ? finiteOrNone(value) : value);
}
export function answerOf(found, plan) {
  return ({ value: _finiteOrNone(found.value), lower: _finiteOrNone(found.lower), upper: _finiteOrNone(found.upper), unit: found.unit, status: found.status, witness: ((found.witness == null) ? null : _witness(found.witness)), assumptions: py.list(found.assumptions), evaluations: found.evaluations, seconds: _finiteOrNone(found.seconds), plan_sha256: plan.sha256, version: __version__ });
}
function _witness(near) {
  return ({ time: _finiteOrNone(near.time), s: _finiteOrNone(near.s), benches: py.list(near.benches), point: near.point, gap: _finiteOrNone(near.gap), features: py.list(near.features), handle: near.handle, obstacle: near.obstacle });
}
export function answerOrNone(found, plan) {
  return ((found == null) ? null : answerOf(found, plan));
}
export function verdictOf(report) {
  let plan;
  plan = report.plan;
  return ({ safe: report.safe, decided: report.decided, proved: report.proved, unproved: py.list(report.unproved).map((one) => ({ kind: one.kind, text: _inBoth(one) })), sentence: both(() => sentence(report)), start: _finiteOrNone(report.start), end: _finiteOrNone(report.end), first_contact: answerOrNone(report.first_contact, plan), clearance: answerOf(report.clearance, plan), greatest_speed: answerOf(report.greatest_speed, plan), peaks: py.list(py.items(report.peaks)).map(([name, peak]) => _limitedPeak(name, peak, plan)), obstacles: py.list(report.obstacles).map((found) => _obstacle(found, plan)), room: py.list(report.room).map((level) => _room(level, plan)), findings: py.list(report.findings).map((found) => _finding(found)), not_looked_at: py.list(report.not_looked_at).map((one) => ({ kind: one.kind, text: _inBoth(one) })), stops: _stops(report), seconds: _finiteOrNone(report.seconds), plan_sha256: plan.sha256, version: __version__ });
}
function _inBoth(one) {
  return both(() => one.text);
}
function _stops(report) {
  let stops;
  stops = report.stops;
  return ((stops == null) ? null : py.list(stops).map((one) => ({ start: _finiteOrNone(one.start), end: _finiteOrNone(one.end), s: _finiteOrNone(one.s) })));
}
function _finding(found) {
  return ({ code: found.code, kind: found.kind, decided: found.decided, text: both(() => found.text), time: _finiteOrNone(found.time), benches: py.list(found.benches), value: _finiteOrNone(found.value), limit: _finiteOrNone(found.limit), obstacle: py.or(found.obstacle, () => null) });
}
function _obstacle(found, plan) {
  let obstacle;
  obstacle = found.obstacle;
  return ({ name: obstacle.name, shown: both(() => shownName(obstacle)), kind: obstacle.kind, margin: _finiteOrNone(obstacle.margin), contact: answerOrNone(found.contact, plan), touch: answerOrNone(found.touch, plan), distance: answerOf(found.distance, plan) });
}
function _room(level, plan) {
  let first, obstacle;
  [first, obstacle] = py.list(py.or(level.first, () => [null, null]));
  return ({ name: level.name, text: both(() => levelName(level)), asked: py.list(level.asked).map((one) => ({ key: one.key, value: _finiteOrNone(one.value), source: py.or(one.source, () => null) })), margin: _finiteOrNone(level.margin), kept: level.kept, first: answerOrNone(first, plan), obstacle: ((obstacle == null) ? null : obstacle.name) });
}
function _limitedPeak(name, peak, plan) {
  return ({ name: name, text: both(() => peakText(name)), peak: answerOf(peak, plan) });
}
