// What can be told of a dance: why it ends where two benches touch, or where it is tightest; how a bench
// meets what stands on the square, or leaves it.

import { clock } from "./axis.js";
import { Boxes } from "./nearness.js";
import { Square } from "./square.js";
import { _, decimals, language, shortLength } from "./words.js";

/** @typedef {import("./player.js").Player} Player */
/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./story.js").Step} Step */
/** @typedef {import("./story.js").Tale} Tale */
/** @typedef {import("./messages").Occasion} Occasion */
/** @typedef {"touch" | "margin" | "near"} Meeting */
/** @typedef {Record<string, string | number>} Values */

/** Ground on the picture's smaller side where all is close, m, and so many gaps more. */
const CLOSE = 0.9;
const GAPS = 3;
/** So long before what happens the whole dance is shown, the pair, and all in slow motion, s. */
const BEFORE = [20, 4, 0.8];
/** So long after a contact benches that overlap are shown, and after the tightest moment those that part, s. */
const AFTER = 0.5;
const PARTED = 4;
/** How long steps take, s. */
const LENGTHS = [6, 6, 8, 4, 6];

/** A step, with what it does not say. @param {Partial<Step> & Pick<Step, "text" | "from" | "to">} step @returns {Step} */
export function stepOf(step) {
  return {
    seconds: 6,
    view: "whole",
    benches: [],
    obstacle: null,
    ringed: null,
    ground: CLOSE,
    ...step,
  };
}

/** The tales of a dance, the most serious first. @param {Scene} scene @returns {Tale[]} */
export function talesOf(scene) {
  const { occasions } = scene.sent;
  const pairs = (/** @type {Occasion["kind"]} */ kind) =>
    occasions.filter((one) => one.kind === kind && one.benches.length === 2).slice(0, 1);
  const met = metOf(scene);
  const serious = met?.meeting === "touch";
  return [
    ...pairs("contact").map(contactTale),
    ...(met && serious ? [meetingTale(met.about, met.meeting)] : []),
    ...pairs("tightest").map(tightestTale),
    ...(met && !serious ? [meetingTale(met.about, met.meeting)] : []),
  ];
}

/** How a bench meets an obstacle, or the venue's edge, first of all that is worst; null if there is none. @param {Scene} scene */
function metOf(scene) {
  const { occasions, obstacles } = scene.sent;
  const boxes = new Boxes(scene);
  const square = new Square(scene.sent);
  const found = occasions.flatMap((about) => {
    if (about.obstacle == null) return [];
    boxes.place(scene.stand(about.time, scene.room()));
    const near = square.pair(boxes, about.benches[0] - 1, about.obstacle);
    if (!near) return [];
    const { margin } = obstacles[about.obstacle];
    const meeting = near.distance <= boxes.touch ? "touch" : margin && near.distance <= margin + boxes.touch ? "margin" : "near"; // prettier-ignore
    return [{ about, meeting: /** @type {Meeting} */ (meeting) }];
  });
  const worst = (/** @type {Meeting} */ meeting) => found.find((one) => one.meeting === meeting);
  return worst("touch") ?? worst("margin") ?? worst("near") ?? null;
}

/** Times of the steps up to what happens, s, and of the one after it. @param {Scene} scene @param {number} time @param {number} after */
function timesOf(scene, time, after) {
  const within = (/** @type {number} */ at) => Math.min(Math.max(at, scene.start), scene.end);
  return [...BEFORE.map((early) => within(time - early)), time, time, within(time + after)];
}

/**
 * Steps that go from the whole dance to where something happens.
 * @param {string[]} texts
 * @param {number[]} times one more than texts
 * @param {Step["view"][]} views
 * @param {Pick<Step, "benches" | "obstacle" | "ground">} about
 */
function approach(texts, times, views, about) {
  return texts.map((text, n) =>
    stepOf({ ...about, text, from: times[n], to: times[n + 1], seconds: LENGTHS[n], view: views[n] }),
  );
}

/** How far apart two benches are at a time, m. @param {Player} player @param {number[]} benches from 1 @param {number} time */
export function gapAt({ scene, boxes, stand }, [a, b], time) {
  boxes.place(scene.stand(time, stand));
  return boxes.distance(a - 1, b - 1);
}

/** What all tales of a pair say. @param {Player} player @param {Occasion} about */
function pairWords(player, { time, benches }) {
  const { scene } = player;
  const least = Math.max(gapAt(player, benches, time), 0);
  const pair = { a: benches[0], b: benches[1] };
  const words = { ...pair, gap: shortLength(least), time: clock(time, 2) };
  const seconds = decimals(time - Math.max(time - BEFORE[0], scene.start), 0);
  const ground = CLOSE + GAPS * least;
  return {
    words,
    opening: { benches: scene.benches, seconds, ...pair },
    shown: { benches, obstacle: null, ground },
  };
}

/** Why it ends where two benches touch. @param {Occasion} about @returns {Tale} */
export function contactTale(about) {
  const steps = (/** @type {Player} */ player) => {
    const { scene, boxes } = player;
    const { words, opening, shown } = pairWords(player, about);
    const later = about.time + AFTER;
    const over = later <= scene.end && gapAt(player, about.benches, later) < -boxes.touch;
    const texts = contactTexts(words, opening).slice(0, over ? 5 : 4);
    const views = /** @type {const} */ (["whole", "pair", "close", "close", "close"]);
    return approach(texts, timesOf(scene, about.time, AFTER), [...views], shown);
  };
  return { name: () => _("Why it ends here"), steps };
}

/** @param {Values} words @param {Values} opening */
function contactTexts(words, opening) {
  return [
    _(
      "{benches} benches from above, at true size. In {seconds} s, benches {a} and {b} touch.",
      opening,
    ),
    _(
      "Benches {a} and {b} are not adjacent in the line, but they meet. The ring is where they are nearest.",
      words,
    ),
    _("In slow motion: what is left between them shrinks to nothing.", words),
    _("t = {time}: bench {a} meets bench {b}. This is the first contact.", words),
    _("Half a second later they would overlap. No dragon walks beyond {time}.", words),
  ];
}

/** Where it is tightest. @param {Occasion} about @returns {Tale} */
function tightestTale(about) {
  const steps = (/** @type {Player} */ player) => {
    const { scene } = player;
    const { words, opening, shown } = pairWords(player, about);
    const texts = tightestTexts(words, opening).slice(0, scene.end > about.time ? 5 : 4);
    const views = /** @type {const} */ (["whole", "pair", "close", "close", "pair"]);
    return approach(texts, timesOf(scene, about.time, PARTED), [...views], shown);
  };
  return { name: () => _("The tightest moment"), steps };
}

/** @param {Values} words @param {Values} opening */
function tightestTexts(words, opening) {
  return [
    _("{benches} benches from above, at true size. In {seconds} s it is tightest.", opening),
    _("Benches {a} and {b} come near one another. The ring is where they are nearest.", words),
    _("In slow motion: what is left between them shrinks.", words),
    _("t = {time}: {gap} is left between benches {a} and {b}, the least of the dance.", words),
    _("They part again. At every other time there is at least as much room.", words),
  ];
}

/** How a bench meets an obstacle, or leaves the venue. @param {Occasion} about @param {Meeting} meeting @returns {Tale} */
function meetingTale(about, meeting) {
  const number = /** @type {number} */ (about.obstacle);
  const steps = (/** @type {Player} */ { scene, boxes, stand, square }) => {
    boxes.place(scene.stand(about.time, stand));
    const least = square.pair(boxes, about.benches[0] - 1, number)?.distance ?? 0;
    const { kind, margin, name } = scene.sent.obstacles[number];
    const words = {
      benches: scene.benches,
      bench: about.benches[0],
      name: name[language()],
      gap: shortLength(least),
      margin: shortLength(margin),
      time: clock(about.time, 2),
      seconds: decimals(about.time - Math.max(about.time - BEFORE[0], scene.start), 0),
    };
    const parts = meeting === "near" && scene.end > about.time;
    const texts = (kind === "venue" ? edgeTexts : obstacleTexts)(meeting, words);
    const all = parts ? [...texts, _("At every other time there is at least as much room.")] : texts;
    const views = /** @type {const} */ (["whole", "pair", "close", "close", "pair"]);
    const shown = {
      benches: about.benches.slice(0, 1),
      obstacle: number,
      ground: CLOSE + GAPS * least,
    };
    return approach(all, timesOf(scene, about.time, PARTED), [...views], shown);
  };
  return { name: () => meetingName(about, meeting), steps };
}

/** @param {Occasion} about @param {Meeting} meeting */
function meetingName({ kind }, meeting) {
  if (meeting !== "touch")
    return kind === "venue" ? _("Nearest to the edge") : _("Nearest to an obstacle");
  return kind === "venue" ? _("Where it leaves the venue") : _("Where it touches an obstacle");
}

/** @param {Meeting} meeting @param {Values} words */
function obstacleTexts(meeting, words) {
  const opening = {
    touch: _(
      "{benches} benches from above, at true size. In {seconds} s, bench {bench} touches {name}.",
      words,
    ),
    margin: _(
      "{benches} benches from above, at true size. In {seconds} s, bench {bench} comes too near to {name}.",
      words,
    ),
    near: _(
      "{benches} benches from above, at true size. In {seconds} s, bench {bench} is nearest to {name}.",
      words,
    ),
  };
  const end = {
    touch: _("t = {time}: bench {bench} touches {name}. It cannot go on like this.", words),
    margin: _("t = {time}: {gap} is left to {name}, and the plan wants {margin}.", words),
    near: _(
      "t = {time}: {gap} is left between bench {bench} and {name}, the least of the dance.",
      words,
    ),
  };
  return [
    opening[meeting],
    _("Bench {bench} comes up to {name}. The ring is where they are nearest.", words),
    meeting === "touch"
      ? _("In slow motion: what is left between them shrinks to nothing.")
      : _("In slow motion: what is left between them shrinks."),
    end[meeting],
  ];
}

/** @param {Meeting} meeting @param {Values} words */
function edgeTexts(meeting, words) {
  const opening = {
    touch: _(
      "{benches} benches from above, at true size. In {seconds} s, bench {bench} leaves {name}.",
      words,
    ),
    margin: _(
      "{benches} benches from above, at true size. In {seconds} s, bench {bench} comes too near to the edge of {name}.",
      words,
    ),
    near: _(
      "{benches} benches from above, at true size. In {seconds} s, bench {bench} is nearest to the edge of {name}.",
      words,
    ),
  };
  const end = {
    touch: _(
      "t = {time}: bench {bench} leaves {name}. There is not enough room for this dance.",
      words,
    ),
    margin: _("t = {time}: {gap} is left to the edge of {name}, and the plan wants {margin}.", words),
    near: _(
      "t = {time}: {gap} is left between bench {bench} and the edge of {name}, the least of the dance.",
      words,
    ),
  };
  return [
    opening[meeting],
    _("Bench {bench} comes up to the edge of {name}. The ring is where they are nearest.", words),
    meeting === "touch"
      ? _("In slow motion: what is left between them shrinks to nothing.")
      : _("In slow motion: what is left between them shrinks."),
    end[meeting],
  ];
}
