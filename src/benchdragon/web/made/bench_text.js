// @ts-nocheck
// Made from explain/bench_text.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";
import { known } from "./number_format.js";

const REACH = 1.5;
const MOST_TURNS = 3;
const MOST_PACES = 4;
const LEAST_ANGLE = 5.0;
const ROUND = 360.0;
const QUARTERS = 4;
const WALKING = N_("keep walking");
const PACES = py.dict([["wait", N_("wait")], ["walk", N_("keep walking")], ["hurry", N_("hurry")], ["run", N_("run")]]);
const TURNS = py.dict([["left", N_("turn left")], ["right", N_("turn right")], ["straight", N_("straight on")]]);
const FAR = [N_("a little"), N_("a quarter round"), N_("half round"), N_("three quarters round")];
const ALL_THE_WAY = py.dict([["left", N_("bend left all the way")], ["right", N_("bend right all the way")]]);
const SIDES = py.dict([["left", N_("on your left")], ["right", N_("on your right")], ["front", N_("in front of you")], ["rear", N_("behind you")]]);
const ITS_SIDES = py.dict([["left", N_("on its left")], ["right", N_("on its right")], ["front", N_("in front of it")], ["rear", N_("behind it")]]);
export class Halt {
  constructor(start, end, what) {
    this.start = start;
    this.end = end;
    this.what = what;
  }
  *[Symbol.iterator]() {
    yield* [this.start, this.end, this.what];
  }
}
class BenchText {
  constructor(quick, place, stretches, paces, tightest, people, times) {
    this.quick = quick;
    this.place = place;
    this.stretches = stretches;
    this.paces = paces;
    this.tightest = tightest;
    this.people = people;
    this.times = times;
  }
  get lines() {
    return [this.quick, ...py.iter(this.place), ...py.iter(this.stretches), ...py.iter(this.paces), this.tightest, ...py.iter(this.people), this.times];
  }
}
export class Basis {
  constructor(clock, people, ground, halts, coiled) {
    this.clock = clock;
    this.people = people;
    this.ground = ground;
    this.halts = halts;
    this.coiled = coiled;
  }
}
export class Landmark {
  constructor(apart, name = "", edge = /** @type {any} */ (null)) {
    this.apart = apart;
    this.name = name;
    this.edge = edge;
  }
}
export function benchLines(basis, found, landmark, called) {
  let clock, halts, people;
  [clock, halts, people] = py.list([basis.clock, basis.halts, basis.people]);
  return new BenchText(quickLine(found, clock, halts), [...py.iter(placeLines(basis, found, landmark)), _comingLine(found)], py.tuple(py.list(found.stretches).map((one) => _stretchLine(one, clock, halts, people.step))), _paceLines(people, found), tightestLine(found.tightest, clock, called), [...py.iter(peopleLines(found, called)), _afterLine(basis, found)], _timesLine(found, clock));
}
function quickLine(found, clock, halts = []) {
  let said, text;
  said = [...py.iter(_quickTurns(found.stretches)), ...py.iter(_quickPaces(found.stretches, clock, halts))];
  text = py.filled(_("{all}."), { all: py.join(_("; "), said) });
  return py.add(py.upper(py.slice(text, null, 1)), py.slice(text, 1, null));
}
function _quickTurns(stretches) {
  let bent, sides, text;
  bent = py.list(stretches).flatMap((one) => (((one.turning !== "straight")) ? [one.turning] : []));
  sides = py.list(py.groupby(bent)).map(([side, _same]) => side);
  if (!py.truth(sides)) {
    return [_("straight on all the way")];
  }
  if (((py.len(sides) === 1) && py.eq(py.len(bent), py.len(stretches)))) {
    return [_(py.at(ALL_THE_WAY, py.at(sides, 0)))];
  }
  if ((py.len(sides) <= MOST_TURNS)) {
    return [py.join(_(", then "), py.list(sides).map((side) => _(py.at(TURNS, side))))];
  }
  text = _("{left} times left and {right} times right");
  return [py.filled(text, { left: py.count(sides, "left"), right: py.count(sides, "right") })];
}
function _waitedFor(start, end, halts) {
  return py.join(_("; "), py.list(halts).flatMap((one) => ((((one.start < end) && (start < one.end))) ? [one.what] : [])));
}
function _quickPaces(stretches, clock, halts) {
  let counts, first, last, runs, text, timed;
  runs = py.list(py.groupby(stretches, (one) => one.pace)).map(([pace, some]) => [pace, py.list(some)]);
  if (((py.len(runs) === 1) && (py.at(py.at(runs, 0), 0) === "walk"))) {
    return [_("keep walking, without a stop")];
  }
  if ((py.len(runs) === 1)) {
    return [py.filled(_("{pace} all the time"), { pace: _(py.at(PACES, py.at(py.at(runs, 0), 0))) })];
  }
  timed = py.list(runs).flatMap(([pace, some]) => (((pace !== "walk")) ? [_quickPace(pace, some, clock, halts)] : []));
  if ((py.len(timed) <= MOST_PACES)) {
    first = ((py.at(py.at(runs, 0), 0) === "walk") ? [_(WALKING)] : []);
    last = ((py.at(py.at(runs, -1), 0) === "walk") ? [py.filled(_("then {pace}"), { pace: _(WALKING) })] : []);
    return [...py.iter(first), ...py.iter(timed), ...py.iter(last)];
  }
  counts = py.dict(py.list(["hurry", "run", "wait"]).map((name) => [name, py.sum(py.list(runs).map(([pace, _some]) => py.eq(pace, name)))]));
  text = _("{pace}, {count} times");
  return [_(WALKING), ...py.iter(py.list(py.items(counts)).flatMap(([name, count]) => ((py.truth(count)) ? [py.filled(text, { pace: _(py.at(PACES, name)), count: count })] : [])))];
}
function _quickPace(pace, some, clock, halts) {
  let end, start, text, what;
  [start, end] = py.list([py.at(some, 0).start, py.at(some, -1).end]);
  what = ((pace === "wait") ? _waitedFor(start, end, halts) : "");
  text = (py.truth(what) ? _("{pace} from {start} to {end}: {what}") : _("{pace} from {start} to {end}"));
  return py.filled(text, { pace: _(py.at(PACES, pace)), start: clock.tell(start), end: clock.tell(end), what: what });
}
function _paceLines(people, found) {
  let means, used;
  means = py.dict([["hurry", py.filled(_("Hurry means {speed} m/s or more."), { speed: `${py.format(people.hurry_from, `g`)}` })], ["run", py.filled(_("Run means {speed} m/s or more."), { speed: `${py.format(people.run_from, `g`)}` })], ["wait", _("Wait means to stand still.")]]);
  used = py.set_of(py.list(found.stretches).map((one) => one.pace));
  return py.tuple(py.list(py.items(means)).flatMap(([pace, text]) => ((py.has(used, pace)) ? [text] : [])));
}
function placeLines(basis, found, landmark) {
  let angle, ground, radius, steps, text, ways, where, x, y;
  [ground, steps] = py.list([basis.ground, _stepsLine(basis, landmark)]);
  [[x, y], radius] = py.list([ground.seen_at(found.place), py.dist(found.place, ground.peg)]);
  if (py.truth(ground.venue)) {
    ways = ground.way_names;
    where = py.filled(_("Your front handle starts {x} m {way_x} and {y} m {way_y} from the peg: {radius} m from it."), { x: `${py.format(_settled(py.abs(x)), `.2f`)}`, way_x: py.at(ways, ((x >= 0.0) ? 0 : 2)), y: `${py.format(_settled(py.abs(y)), `.2f`)}`, way_y: py.at(ways, ((y >= 0.0) ? 1 : 3)), radius: `${py.format(_settled(radius), `.2f`)}` });
    return [where, steps];
  }
  text = N_("Your front handle starts at x = {x} m, y = {y} m from the peg: {radius} m from it at {angle}° from the x axis.");
  if (py.truth(ground.north)) {
    text = N_("Your front handle starts at x = {x} m (east), y = {y} m (north) from the peg: {radius} m from it on a bearing of {angle}° from north.");
  }
  angle = py.mod(py.round(py.mod(py.degrees((py.truth(ground.north) ? py.atan2(x, y) : py.atan2(y, x))), 360.0)), 360);
  where = py.filled(_(text), { x: `${py.format(_settled(x), `z.2f`)}`, y: `${py.format(_settled(y), `z.2f`)}`, radius: `${py.format(_settled(radius), `.2f`)}`, angle: angle });
  return [where, steps];
}
function _steps(way, step) {
  return py.round(_settled((way / step)));
}
function _settled(value) {
  return py.round(value, 6);
}
function _stepsLine(basis, landmark) {
  let steps, text, told;
  steps = _steps(landmark.apart, basis.people.step);
  told = (py.truth(steps) ? py.str(steps) : _("less than 1"));
  if (!py.truth(landmark.name)) {
    return py.filled(_("At the start your front handle is {steps} steps from the peg."), { steps: told });
  }
  if ((landmark.edge == null)) {
    text = _("At the start your bench is {steps} steps from {name}.");
    return py.filled(text, { steps: told, name: landmark.name });
  }
  text = _("At the start your bench is {steps} steps from the {edge} of {name}.");
  return py.filled(text, { steps: told, edge: basis.ground.edge_name(landmark.edge), name: landmark.name });
}
export function doing(one) {
  if ((one.pace === "wait")) {
    return _(py.at(PACES, one.pace));
  }
  return py.filled(_("{turn}, {pace}"), { turn: _(py.at(TURNS, one.turning)), pace: _(py.at(PACES, one.pace)) });
}
function _stretchLine(one, clock, halts, step) {
  let angle, quarters, text, times, what;
  times = py.dict([["start", clock.tell(one.start)], ["end", clock.tell(one.end)]]);
  if ((one.pace === "wait")) {
    what = _waitedFor(one.start, one.end, halts);
    text = (py.truth(what) ? _("{start} to {end}: wait: {what}.") : _("{start} to {end}: wait."));
    return py.filled(text, { ...py.object(times), what: what });
  }
  angle = py.abs(py.degrees(one.angle));
  quarters = py.round(_settled(((angle * QUARTERS) / ROUND)));
  text = _("{start} to {end}: {pace}, {turn}; {way} m, {steps} steps.");
  if (((one.turning !== "straight") && (quarters >= QUARTERS))) {
    text = _("{start} to {end}: {pace}, {turn}, {rounds} times round; {way} m, {steps} steps.");
  }
  else {
    if (((one.turning !== "straight") && (angle >= LEAST_ANGLE))) {
      text = _("{start} to {end}: {pace}, {turn}, {far}; {way} m, {steps} steps.");
    }
  }
  return py.filled(text, { ...py.object(times), pace: _(py.at(PACES, one.pace)), turn: _(py.at(TURNS, one.turning)), far: _(py.at(FAR, py.mod(quarters, QUARTERS))), rounds: `${py.format((angle / ROUND), `.1f`)}`, way: `${py.format(_settled(one.way), `.0f`)}`, steps: _steps(one.way, step) });
}
export function tightestLine(near, clock, called, its = false) {
  let gap, side, text, time;
  if ((near == null)) {
    text = _("No bench of another coil comes within about {reach} m of you.");
    if (py.truth(its)) {
      text = _("No bench of another coil comes within about {reach} m of it.");
    }
    return py.filled(text, { reach: `${py.format(REACH, `g`)}` });
  }
  text = _("Tightest at {time}: {bench}, in another coil, comes as near as {gap} m, {side}.");
  gap = known(near.upper, near.upper, "m", false);
  [time, side] = py.list([clock.tell(near.time), _(py.at((py.truth(its) ? ITS_SIDES : SIDES), near.side))]);
  return py.filled(text, { time: time, bench: called(near.bench), gap: gap, side: side });
}
export function peopleLines(found, called) {
  let said;
  said = [];
  if ((found.before != null)) {
    py.append(said, py.filled(_("Before you: {bench}."), { bench: called(found.before) }));
  }
  if ((found.behind != null)) {
    py.append(said, py.filled(_("Behind you: {bench}."), { bench: called(found.behind) }));
  }
  if ((found.left != null)) {
    py.append(said, py.filled(_("At the end on your left: {bench}."), { bench: called(found.left) }));
  }
  if ((found.right != null)) {
    py.append(said, py.filled(_("At the end on your right: {bench}."), { bench: called(found.right) }));
  }
  return py.tuple(said);
}
function _timesLine(found, clock) {
  let text;
  if ((found.behind != null)) {
    return clock.legend;
  }
  text = _("{times} Here they are of your front handle, in the timetable of your last handle.");
  return py.filled(text, { times: clock.legend });
}
function _comingLine(found) {
  if ((found.before == null)) {
    return _("Coming in: lead all of them along the chalk line, slowly.");
  }
  return _("Coming in: follow the bench before you along the chalk line.");
}
function _afterLine(basis, found) {
  if (py.truth(basis.coiled)) {
    return _("Afterwards: stand until your pin is pulled; the tail goes first.");
  }
  if ((found.before == null)) {
    return _("Afterwards: lead all of them out where the leader says.");
  }
  return _("Afterwards: follow the bench before you out.");
}
