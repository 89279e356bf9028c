// What one bench does, in plain sentences for those who carry it. Twin of explain/bench_text.py.

import { _, language } from "../words.js";
import { ANALYSIS_BENCH_NEARNESS, EXPLAIN_BENCH_TEXT } from "./constants.js";
import { degrees } from "./curves.js";
import { seenFrom, wayNames } from "./ground.js";
import { decimals, general, known } from "./number_format.js";
import { rint, rounded } from "./numbers.js";

/** @typedef {import("./bench_walks.js").BenchWalk} BenchWalk */
/** @typedef {import("./bench_walks.js").Pace} Pace */
/** @typedef {import("./bench_walks.js").Stretch} Stretch */
/** @typedef {import("./bench_nearness.js").Tightest} Tightest */
/** @typedef {import("./bends.js").Turning} Turning */
/** @typedef {import("./clock.js").Clock} Clock */
/** @typedef {import("./ground.js").Ground} Ground */
/** @typedef {import("./briefing.js").Halt} Halt */

/** What is nearest to a bench when the dance starts, and how far, m; without a name it is the peg. Of the venue the edge there: of those to the right, forward, to the left, back. @typedef {{ apart: number, name: string, edge: number | null }} Landmark */

/**
 * What sentences about benches rest on, beside what each does.
 * @typedef {object} Basis
 * @property {Clock} clock
 * @property {Record<string, any>} people the table of the plan, filled
 * @property {Ground} ground from which places are told
 * @property {Halt[]} halts what the plan says the head stands for
 * @property {boolean} coiled whether the dance ends inside
 */

/**
 * What one bench does, in the language in use.
 * @typedef {object} BenchText
 * @property {string} quick all of it in a dozen words
 * @property {string[]} place where it starts: chalk coordinates, steps from a landmark, the way there
 * @property {string[]} stretches what it does from when to when, a sentence each
 * @property {string[]} paces from which speeds on one hurries, runs or waits; of paces in it alone
 * @property {string} tightest when a bench of another coil comes nearest
 * @property {string[]} people who is before, behind and beside, and where to go when the dance is over
 * @property {string} times what times in it are
 */

const { REACH } = ANALYSIS_BENCH_NEARNESS;
const { MOST_TURNS, MOST_PACES, LEAST_ANGLE, ROUND, QUARTERS } = EXPLAIN_BENCH_TEXT;

/** @type {Record<Pace, () => string>} */
const PACES = {
  wait: () => _("wait"),
  walk: () => _("keep walking"),
  hurry: () => _("hurry"),
  run: () => _("run"),
};
/** @type {Record<Turning, () => string>} */
const TURNS = {
  left: () => _("turn left"),
  right: () => _("turn right"),
  straight: () => _("straight on"),
};
/** How far it turns, by quarters of a round. */
const FAR = [
  () => _("a little"),
  () => _("a quarter round"),
  () => _("half round"),
  () => _("three quarters round"),
];
/** @type {Record<import("./bench_nearness.js").Side, () => string>} */
const SIDES = {
  left: () => _("on your left"),
  right: () => _("on your right"),
  front: () => _("in front of you"),
  rear: () => _("behind you"),
};
/** The same as others read of a bench. @type {Record<import("./bench_nearness.js").Side, () => string>} */
const ITS_SIDES = {
  left: () => _("on its left"),
  right: () => _("on its right"),
  front: () => _("in front of it"),
  rear: () => _("behind it"),
};

/**
 * What one bench of a plan does; `called` says what people call the bench of a number.
 * @param {Basis} basis
 * @param {BenchWalk} found
 * @param {Landmark} landmark
 * @param {(bench: number) => string} called
 * @returns {BenchText}
 */
export function benchText(basis, found, landmark, called) {
  const { clock, people } = basis;
  return {
    quick: quickLine(found, clock, basis.halts),
    place: [...placeLines(basis, found, landmark), comingLine(found)],
    stretches: found.stretches.map((one) => stretchLine(one, basis)),
    paces: paceLines(people, found),
    tightest: tightestLine(found.tightest, clock, called),
    people: [...peopleLines(found, called), afterLine(basis, found)],
    times: timesLine(found, clock),
  };
}

/** What a bench does in a dozen words, and what it waits for. @param {BenchWalk} found @param {Clock} clock @param {Halt[]} halts */
function quickLine({ stretches }, clock, halts) {
  const said = [...quickTurns(stretches), ...quickPaces(stretches, clock, halts)];
  const all = said.join(_("; "));
  const text = _("{all}.", { all });
  return text.slice(0, 1).toUpperCase() + text.slice(1);
}

/** To which sides it turns: one after another, or how often. @param {Stretch[]} stretches */
function quickTurns(stretches) {
  const bent = stretches.map(({ turning }) => turning).filter((turning) => turning !== "straight");
  const sides = bent.filter((side, n) => side !== bent[n - 1]);
  if (!sides.length) return [_("straight on all the way")];
  if (sides.length === 1 && bent.length === stretches.length)
    return [sides[0] === "left" ? _("bend left all the way") : _("bend right all the way")];
  if (sides.length <= MOST_TURNS) return [sides.map((side) => TURNS[side]()).join(_(", then "))];
  const count = (/** @type {Turning} */ wanted) => sides.filter((side) => side === wanted).length;
  return [
    _("{left} times left and {right} times right", { left: count("left"), right: count("right") }),
  ];
}

/** What the head stands for between two times, s; "" if the plan does not say. @param {number} start @param {number} end @param {Halt[]} halts */
function waitedFor(start, end, halts) {
  const met = halts.filter((one) => one.start < end && start < one.end);
  return met.map(({ said }) => said[language()]).join(_("; "));
}

/** A pace with its times, and what is waited for. @param {{ pace: Pace, start: number, end: number }} run @param {Clock} clock @param {Halt[]} halts */
function quickPace({ pace, start, end }, clock, halts) {
  const what = pace === "wait" ? waitedFor(start, end, halts) : "";
  const values = { pace: PACES[pace](), start: clock.tell(start), end: clock.tell(end), what };
  return what
    ? _("{pace} from {start} to {end}: {what}", values)
    : _("{pace} from {start} to {end}", values);
}

/** At what paces it goes: one after another with their times, or how often. @param {Stretch[]} stretches @param {Clock} clock @param {Halt[]} halts */
function quickPaces(stretches, clock, halts) {
  /** @type {Array<{ pace: Pace, start: number, end: number }>} */
  const runs = [];
  for (const { pace, start, end } of stretches) {
    const last = runs[runs.length - 1];
    if (last?.pace === pace) last.end = end;
    else runs.push({ pace, start, end });
  }
  if (runs.length === 1 && runs[0].pace === "walk") return [_("keep walking, without a stop")];
  if (runs.length === 1) return [_("{pace} all the time", { pace: PACES[runs[0].pace]() })];
  const timed = runs.filter(({ pace }) => pace !== "walk");
  if (timed.length <= MOST_PACES) {
    const told = timed.map((run) => quickPace(run, clock, halts));
    const first = runs[0].pace === "walk" ? [PACES.walk()] : [];
    const last = runs[runs.length - 1].pace === "walk" ? [PACES.walk()] : [];
    return [...first, ...told, ...last.map((pace) => _("then {pace}", { pace }))];
  }
  /** @type {Pace[]} */
  const names = ["hurry", "run", "wait"];
  const counts = names.map((name) => runs.filter(({ pace }) => pace === name).length);
  const said = names.map((name, n) =>
    counts[n] ? [_("{pace}, {count} times", { pace: PACES[name](), count: counts[n] })] : [],
  );
  return [PACES.walk(), ...said.flat()];
}

/** What the paces of a bench mean, but for walking, which everybody knows. @param {Record<string, number>} people @param {BenchWalk} found */
function paceLines({ hurry_from: hurry, run_from: run }, { stretches }) {
  const used = new Set(stretches.map(({ pace }) => pace));
  const said = [];
  if (used.has("hurry")) said.push(_("Hurry means {speed} m/s or more.", { speed: general(hurry) }));
  if (used.has("run")) said.push(_("Run means {speed} m/s or more.", { speed: general(run) }));
  if (used.has("wait")) said.push(_("Wait means to stand still."));
  return said;
}

/** Where a bench starts: how far from the peg, and steps from a landmark. @param {Basis} basis @param {BenchWalk} found @param {Landmark} landmark */
function placeLines({ ground, people }, { place }, landmark) {
  const [x, y] = seenFrom(ground, place);
  const [dx, dy] = [place[0] - ground.peg[0], place[1] - ground.peg[1]];
  const radius = decimals(settled(Math.hypot(dx, dy)), 2);
  const steps = stepsLine(landmark, people.step, ground.north);
  if (ground.venue) {
    const ways = wayNames(ground);
    const values = {
      x: decimals(settled(Math.abs(x)), 2),
      way_x: ways[x >= 0 ? 0 : 2],
      y: decimals(settled(Math.abs(y)), 2),
      way_y: ways[y >= 0 ? 1 : 3],
      radius,
    };
    const where = _(
      "Your front handle starts {x} m {way_x} and {y} m {way_y} from the peg: {radius} m from it.",
      values,
    );
    return [where, steps];
  }
  const direction = ground.north ? Math.atan2(x, y) : Math.atan2(y, x);
  const angle = rint(((degrees(direction) % 360) + 360) % 360) % 360;
  const values = { x: decimals(settled(x), 2), y: decimals(settled(y), 2), radius, angle };
  const where = ground.north
    ? _(
        "Your front handle starts at x = {x} m (east), y = {y} m (north) from the peg: {radius} m from it on a bearing of {angle}° from north.",
        values,
      )
    : _(
        "Your front handle starts at x = {x} m, y = {y} m from the peg: {radius} m from it at {angle}° from the x axis.",
        values,
      );
  return [where, steps];
}

/** How many steps the bench is from the nearest landmark when the dance starts. @param {Landmark} landmark @param {number} step @param {boolean} north */
function stepsLine({ apart, name, edge }, step, north) {
  const count = stepsOf(apart, step);
  const steps = count ? String(count) : _("less than 1");
  if (!name) return _("At the start your front handle is {steps} steps from the peg.", { steps });
  if (edge === null) return _("At the start your bench is {steps} steps from {name}.", { steps, name });
  const values = { steps, edge: edgeName(edge, north), name };
  return _("At the start your bench is {steps} steps from the {edge} of {name}.", values);
}

/** What an edge of the venue is called by the way that it lies. @param {number} edge @param {boolean} north */
function edgeName(edge, north) {
  const names = north
    ? [_("eastern edge"), _("northern edge"), _("western edge"), _("southern edge")]
    : [_("right edge"), _("far edge"), _("left edge"), _("near edge")];
  return names[edge];
}

/** How many steps a way is, m. @param {number} way @param {number} step */
function stepsOf(way, step) {
  return rint(settled(way / step));
}

/** A value of which rounding does not decide to which whole number it is nearer. @param {number} value */
function settled(value) {
  return rounded(value, 6);
}

/** What a bench does in one stretch, and what it waits for. @param {Stretch} one @param {Basis} basis */
function stretchLine(one, { clock, people: { step }, halts }) {
  const times = { start: clock.tell(one.start), end: clock.tell(one.end) };
  if (one.pace === "wait") {
    const what = waitedFor(one.start, one.end, halts);
    return what
      ? _("{start} to {end}: wait: {what}.", { ...times, what })
      : _("{start} to {end}: wait.", times);
  }
  const angle = Math.abs(degrees(one.angle));
  const quarters = rint(settled((angle * QUARTERS) / ROUND));
  const values = {
    ...times,
    pace: PACES[one.pace](),
    turn: TURNS[one.turning](),
    far: FAR[quarters % QUARTERS](),
    rounds: decimals(angle / ROUND, 1),
    way: decimals(settled(one.way), 0),
    steps: stepsOf(one.way, step),
  };
  if (one.turning !== "straight" && quarters >= QUARTERS)
    return _("{start} to {end}: {pace}, {turn}, {rounds} times round; {way} m, {steps} steps.", values);
  if (one.turning !== "straight" && angle >= LEAST_ANGLE)
    return _("{start} to {end}: {pace}, {turn}, {far}; {way} m, {steps} steps.", values);
  return _("{start} to {end}: {pace}, {turn}; {way} m, {steps} steps.", values);
}

/** When a bench of another coil comes nearest, which, on which side and how near: to those who carry it, or with `its` to others. @param {Tightest | null} near @param {Clock} clock @param {(bench: number) => string} called */
export function tightestLine(near, clock, called, its = false) {
  const reach = general(REACH);
  if (!near)
    return its
      ? _("No bench of another coil comes within about {reach} m of it.", { reach })
      : _("No bench of another coil comes within about {reach} m of you.", { reach });
  return _("Tightest at {time}: {bench}, in another coil, comes as near as {gap} m, {side}.", {
    time: clock.tell(near.time),
    bench: called(near.bench),
    gap: known(near.upper, near.upper, "m", false),
    side: (its ? ITS_SIDES : SIDES)[near.side](),
  });
}

/** Who is before and behind a bench, and who stands beside it at the end. @param {BenchWalk} found @param {(bench: number) => string} called */
function peopleLines({ before, behind, left, right }, called) {
  const said = [];
  if (before !== null) said.push(_("Before you: {bench}.", { bench: called(before) }));
  if (behind !== null) said.push(_("Behind you: {bench}.", { bench: called(behind) }));
  if (left !== null) said.push(_("At the end on your left: {bench}.", { bench: called(left) }));
  if (right !== null) said.push(_("At the end on your right: {bench}.", { bench: called(right) }));
  return said;
}

/** What times are; on the tail's sheet also that the timetable counts its last handle. @param {BenchWalk} found @param {Clock} clock */
function timesLine({ behind }, { legend: times }) {
  if (behind !== null) return times;
  return _("{times} Here they are of your front handle, in the timetable of your last handle.", {
    times,
  });
}

/** How to come to where one starts. @param {BenchWalk} found */
function comingLine({ before }) {
  if (before === null) return _("Coming in: lead all of them along the chalk line, slowly.");
  return _("Coming in: follow the bench before you along the chalk line.");
}

/** Where to go when the dance is over: who has coiled in cannot follow the head out. @param {Basis} basis @param {BenchWalk} found */
function afterLine({ coiled }, { before }) {
  if (coiled) return _("Afterwards: stand until your pin is pulled; the tail goes first.");
  if (before === null) return _("Afterwards: lead all of them out where the leader says.");
  return _("Afterwards: follow the bench before you out.");
}

/** Where a front handle starts by the chalk plan's marks: `mark_line` of sheets/benches.py. @param {import("./marks.js").MarkPlace | null} place */
export function markLine(place) {
  if (!place) return "";
  const { n, past } = place;
  if (!past) return _("Your front handle starts at mark {n} of the chalk plan.", { n });
  return _(
    "Your front handle starts between marks {n} and {next} of the chalk plan, {past} m past mark {n} along the line.",
    { n, next: n + 1, past: decimals(past, 2) },
  );
}
