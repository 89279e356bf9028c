// The paper's five questions as stories: the plans that answer them, and what is told of their dances. All
// numbers are computed when a story is opened.

import { clock } from "./axis.js";
import { contactTale, gapAt, stepOf, talesOf } from "./tales.js";
import { _, decimals, shortLength } from "./words.js";

/** @typedef {import("./messages").Answer} Answer */
/** @typedef {import("./messages").Preset} Preset */
/** @typedef {import("./messages").TurnShape} TurnShape */
/** @typedef {import("./messages").Verdict} Verdict */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./player.js").Player} Player */
/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./story.js").Tale} Tale */
/** A plan, and what is told of its dance; nothing where that has not happened. @typedef {{ plan: Plan, tale: (scene: Scene) => Tale | undefined }} Chapter */
/** @typedef {(question: string, plan: Plan) => Promise<any>} Ask */
/**
 * One of the paper's questions.
 * @typedef {object} PaperQuestion
 * @property {() => string} name
 * @property {(ask: Ask, preset: (name: string) => Plan) => Promise<Chapter[]>} chapters
 */

/** Question 1 asks for so long a walk, s. */
const WALK = 300;
/** Benches that the paper's tables tell of. */
const TABLED = [1, 51, 101, 151, 201];
/** Digits of what was found, and of a pitch that is walked with: a page shows no smaller gaps. */
const DIGITS = 6;
const MILLIMETRES = 3;
/** A line between two arcs of this radius, m, makes a shorter turn. */
const ARC = 1.8;
/** Ground on the picture's smaller side where a handle is shown, m. */
const ABOUT = 6;

/** @type {PaperQuestion[]} */
export const PAPER_QUESTIONS = [
  { name: () => _("1: positions and speeds for 300 s"), chapters: walkChapters },
  { name: () => _("2: how far it can coil in"), chapters: contactChapters },
  { name: () => _("3: why the pitch cannot be smaller"), chapters: pitchChapters },
  { name: () => _("4: the turn, and a shorter one"), chapters: turnChapters },
  { name: () => _("5: how fast the head may be"), chapters: speedChapters },
];

/** A value with so many digits, no smaller or no larger. @param {number} value @param {number} digits @param {"up" | "down"} way */
function cut(value, digits, way) {
  const unit = 10 ** digits;
  return (way === "up" ? Math.ceil(value * unit) : Math.floor(value * unit)) / unit;
}

/** A number of a record that must be there. @param {number | null | undefined} value */
function known(value) {
  return /** @type {number} */ (value);
}

/** @type {PaperQuestion["chapters"]} */
async function walkChapters(_ask, preset) {
  const plan = preset("spiral-in");
  plan.walk = { ...plan.walk, start: 0, end: WALK };
  return [{ plan, tale: () => ({ name: () => _("Positions and speeds"), steps: walkSteps(plan) }) }];
}

/** @param {Plan} plan @returns {Tale["steps"]} */
function walkSteps(plan) {
  return ({ scene }) => {
    const { benches, end, sent } = scene;
    const [first, last] = [0, WALK].map((time) => scene.stand(time, scene.room()));
    const away = (/** @type {import("./scene.js").Stand} */ { x, y }) =>
      decimals(Math.hypot(x[0] - sent.centre[0], y[0] - sent.centre[1]), 3);
    const told = (/** @type {number} */ handle) => ({
      handle,
      time: clock(end, 0),
      x: decimals(last.x[handle], 3),
      y: decimals(last.y[handle], 3),
      speed: decimals(last.v[handle], 4),
    });
    const tabled = TABLED.filter((bench) => bench <= benches);
    const whole = {
      benches,
      speed: decimals(first.v[0], 2),
      pitch: decimals(plan.route.pitch, 2),
      from: away(first),
      to: away(last),
      seconds: WALK,
      numbers: tabled.join(", "),
      speeds: tabled.map((bench) => decimals(last.v[bench - 1], 4)).join(", "),
    };
    const at = (/** @type {number} */ handle) => ({
      from: WALK,
      to: WALK,
      view: /** @type {const} */ ("close"),
      benches: [Math.min(handle + 1, benches)],
      ringed: { handle, text: `${told(handle).speed} m/s` },
      ground: ABOUT,
    });
    const head = _("{benches} benches coil in along a spiral. The head's front handle moves at {speed} m/s.", whole); // prettier-ignore
    const way = _("Coils are {pitch} m apart. In {seconds} s the head comes from {from} m to {to} m from the centre.", whole); // prettier-ignore
    const front = _("t = {time}: the head's front handle is at x = {x} m, y = {y} m and moves at {speed} m/s.", told(0)); // prettier-ignore
    const rear = _("The last handle, number {handle}, is at x = {x} m, y = {y} m and moves at {speed} m/s.", told(benches)); // prettier-ignore
    const all = _("The front handles of benches {numbers} move at {speeds} m/s.", whole);
    return [
      stepOf({ text: head, from: 0, to: 0.5 * WALK }),
      stepOf({ text: way, from: 0.5 * WALK, to: WALK }),
      stepOf({ text: front, ...at(0) }),
      stepOf({ text: rear, ...at(benches) }),
      stepOf({ text: all, from: WALK, to: WALK }),
    ];
  };
}

/** @type {PaperQuestion["chapters"]} */
async function contactChapters(_ask, preset) {
  return [{ plan: preset("spiral-in"), tale: (scene) => talesOf(scene)[0] }];
}

/** @type {PaperQuestion["chapters"]} */
async function pitchChapters(ask, preset) {
  const base = preset("question-3");
  const found = /** @type {Answer} */ (await ask("limit/pitch", base));
  const [lower, upper] = [known(found.lower), known(found.upper)];
  const at = (/** @type {number} */ pitch) => ({ ...base, route: { ...base.route, pitch } });
  const [less, enough] = [at(cut(lower, MILLIMETRES, "down")), at(cut(upper, MILLIMETRES, "up"))];
  return [
    { plan: less, tale: (scene) => failingTale(scene, less) },
    { plan: enough, tale: (scene) => smallestTale(scene, enough, [lower, upper]) },
  ];
}

/** The contact of a plan that does not reach its disc. @param {Scene} scene @param {Plan} plan @returns {Tale | undefined} */
function failingTale({ sent }, plan) {
  const about = sent.occasions.find(({ kind }) => kind === "contact");
  if (!about) return undefined;
  const { name, steps } = contactTale(about);
  const words = () => ({
    pitch: decimals(plan.route.pitch, MILLIMETRES),
    radius: decimals(sent.disc ?? 0, 1),
    time: clock(about.time, 2),
  });
  const text = () =>
    _(
      "With a pitch of {pitch} m the head does not come to the disc of {radius} m: benches touch at {time}.",
      words(),
    );
  return {
    name,
    steps: (player) => steps(player).map((one, n) => (n ? one : { ...one, text: text() })),
  };
}

/** How two benches only just pass. @param {Scene} scene @param {Plan} plan @param {[number, number]} bracket m @returns {Tale | undefined} */
function smallestTale({ sent }, plan, [lower, upper]) {
  const about = sent.occasions.find(({ kind }) => kind === "tightest");
  if (!about) return undefined;
  const steps = (/** @type {Player} */ player) => {
    const { scene, boxes, stand } = player;
    const { time, benches } = about;
    boxes.place(scene.stand(scene.end, stand));
    const end = boxes.measure();
    const least = Math.max(gapAt(player, benches, time), 0);
    const { from } = boxes.pair(benches[0] - 1, benches[1] - 1);
    const words = {
      lower: decimals(lower, DIGITS),
      upper: decimals(upper, DIGITS),
      pitch: decimals(plan.route.pitch, MILLIMETRES),
      a: benches[0],
      b: benches[1],
      away: decimals(Math.hypot(from[0] - sent.centre[0], from[1] - sent.centre[1]), 2),
      time: clock(time, 2),
      gap: shortLength(least),
      room: shortLength(end ? Math.max(end.distance, 0) : boxes.reach),
    };
    const near = { benches, ground: 0.9 };
    const texts = [
      _("The smallest pitch with which the head comes to the disc lies between {lower} m and {upper} m. This dance has {pitch} m.", words), // prettier-ignore
      _("Benches {a} and {b} only just pass, {away} m from the centre, before the head is at the disc.", words), // prettier-ignore
      _("In slow motion: what is left between them shrinks."),
      _("t = {time}: {gap} is left between benches {a} and {b}, the least of the dance.", words),
      _("When the head is at the disc, there are {room} again: checking only there gives too small a pitch.", words), // prettier-ignore
    ];
    return [
      stepOf({ text: texts[0], from: Math.max(time - 20, scene.start), to: time - 4 }),
      stepOf({ text: texts[1], from: time - 4, to: time - 0.8, view: "pair", ...near }),
      stepOf({ text: texts[2], from: time - 0.8, to: time, seconds: 8, view: "close", ...near }),
      stepOf({ text: texts[3], from: time, to: time, seconds: 4, view: "close", ...near }),
      stepOf({ text: texts[4], from: time, to: scene.end, view: "disc" }),
    ];
  };
  return { name: () => _("The smallest pitch"), steps };
}

/** @type {PaperQuestion["chapters"]} */
async function turnChapters(ask, preset) {
  const plan = preset("turn");
  const even = { ...plan, turn: { ...plan.turn, ratio: 1 } };
  const { ratio: _ratio, ...rest } = plan.turn;
  const line = { ...plan, turn: { ...rest, family: "arc-line-arc", radii: [ARC, ARC] } };
  /** @type {TurnShape[]} */
  const shapes = [];
  for (const one of [plan, even, line]) shapes.push(await ask("shape", one));
  return [
    { plan, tale: () => paperTurnTale(plan, shapes[0], shapes[1]) },
    { plan: line, tale: (scene) => lineTurnTale(scene, shapes[2], shapes[0]) },
  ];
}

/** The paper's turn. @param {Plan} plan @param {TurnShape} own @param {TurnShape} even with arcs of one radius @returns {Tale} */
function paperTurnTale(plan, own, even) {
  const steps = (/** @type {Player} */ { scene }) => {
    const over = known(own.length) / plan.walk.speed;
    const words = {
      radius: decimals(scene.sent.disc ?? 0, 1),
      large: decimals(known(own.least_radius) * plan.turn.ratio, 3),
      small: decimals(known(own.least_radius), 3),
      length: decimals(known(own.length), 3),
      even: decimals(known(even.length), 3),
    };
    const texts = [
      _("The head comes to the disc of {radius} m. In it it must turn onto a spiral that leads out again.", words), // prettier-ignore
      _("Two arcs with radii of {large} m and {small} m make an S, {length} m long.", words),
      _("With two equal arcs it is {even} m long: another ratio of the radii makes it no shorter.", words), // prettier-ignore
    ];
    return [
      stepOf({ text: texts[0], from: -20, to: 0 }),
      stepOf({ text: texts[1], from: 0, to: over, seconds: 10, view: "disc" }),
      stepOf({ text: texts[2], from: over, to: over, view: "disc" }),
    ];
  };
  return { name: () => _("The turn"), steps };
}

/** A turn with a line between its arcs. @param {Scene} scene @param {TurnShape} own @param {TurnShape} before that of the paper @returns {Tale | undefined} */
function lineTurnTale({ sent }, own, before) {
  const about = sent.occasions.find(({ kind }) => kind === "tightest");
  if (!about) return undefined;
  const steps = (/** @type {Player} */ player) => {
    const { time, benches } = about;
    const over = known(own.length);
    const words = {
      radius: decimals(known(own.least_radius), 3),
      length: decimals(over, 3),
      saved: decimals(known(before.length) - over, 3),
      gap: shortLength(Math.max(gapAt(player, benches, time), 0)),
      a: benches[0],
      b: benches[1],
      time: clock(time, 2),
    };
    const texts = [
      _("A line between two arcs of {radius} m does: {length} m, shorter by {saved} m.", words),
      _("No benches touch on the way: {a} and {b} come nearest, at {time}, and keep {gap}.", words),
    ];
    return [
      stepOf({ text: texts[0], from: 0, to: over, seconds: 10, view: "disc" }),
      stepOf({ text: texts[1], from: time - 4, to: time, view: "pair", benches }),
    ];
  };
  return { name: () => _("A shorter turn"), steps };
}

/** @type {PaperQuestion["chapters"]} */
async function speedChapters(ask, preset) {
  const base = preset("turn");
  const { value, lower } = /** @type {Answer} */ (await ask("job/speed", base));
  const plan = { ...base, walk: { ...base.walk, speed: cut(known(lower), DIGITS, "down") } };
  const { greatest_speed: most } = /** @type {Verdict} */ (await ask("verdict", plan));
  const witness = most?.witness;
  if (!witness || witness.time === null || witness.handle === null) return [];
  const fastest = { time: witness.time, handle: witness.handle, speed: known(most.value) };
  const tale = () => ({
    name: () => _("How fast the head may be"),
    steps: speedSteps(plan, known(value), fastest),
  });
  return [{ plan, tale }];
}

/** @param {Plan} plan @param {number} value the greatest speed of the head, m/s @param {{ time: number, handle: number, speed: number }} fastest @returns {Tale["steps"]} */
function speedSteps(plan, value, { time, handle, speed }) {
  return ({ scene }) => {
    const bench = Math.min(handle + 1, scene.benches);
    const words = {
      limit: decimals(plan.limits.speed, 2),
      speed: decimals(plan.walk.speed, DIGITS),
      value: decimals(value, DIGITS),
      handle,
      bench,
      time: clock(time, 2),
      most: decimals(speed, 4),
    };
    const near = {
      benches: [bench],
      ringed: { handle, text: _("handle {handle}", words) },
      ground: ABOUT,
      view: /** @type {const} */ ("close"),
    };
    const texts = [
      _("No handle may be faster than {limit} m/s. Here the head moves at {speed} m/s.", words),
      _("In the narrower bend the handles behind it must be faster than the head.", words),
      _("In slow motion: handle {handle}, at the front of bench {bench}, gets faster.", words),
      _("t = {time}: it moves at {most} m/s, and no handle is ever faster.", words),
      _("So {value} m/s is the greatest speed of the head: with more, that handle exceeds {limit} m/s.", words), // prettier-ignore
    ];
    return [
      stepOf({ text: texts[0], from: time - 20, to: time - 5 }),
      stepOf({ text: texts[1], from: time - 5, to: time - 0.8, view: "disc" }),
      stepOf({ text: texts[2], from: time - 0.8, to: time, seconds: 8, ...near }),
      stepOf({ text: texts[3], from: time, to: time, seconds: 5, ...near }),
      stepOf({ text: texts[4], from: time, to: time + 5, view: "disc" }),
    ];
  };
}
