// What a check found, as moments of the dance that the player shows: twin of `_answers` and `_with_tightest`
// in player/scene.py, from the verdict as it is sent.

import { _, both } from "../words.js";
import { named } from "./findings.js";
import { general } from "./number_format.js";
import { rounded } from "./numbers.js";

/** @typedef {import("../messages").Answer} Answer */
/** @typedef {import("../messages").Dance} Dance */
/** @typedef {import("../messages").Nearest} Nearest */
/** @typedef {import("../messages").ObstacleRecord} ObstacleRecord */
/** @typedef {import("../messages").Occasion} Occasion */
/** @typedef {import("../messages").Verdict} Verdict */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** An obstacle, what was found about it, and its number. @typedef {{ obstacle: Obstacle, found: ObstacleRecord, n: number }} Told */
/** @typedef {{ en: string, zh: string }} Words */

/**
 * A dance with what a check of the same plan found.
 * @param {Dance} dance
 * @param {Verdict} verdict
 * @param {Obstacle[]} obstacles of the plan
 * @returns {Dance}
 */
export function withFindings(dance, verdict, obstacles) {
  const { start, step, count } = dance.frames;
  const last = start + step * (count - 1);
  const told = verdict.obstacles.map((found, n) => ({ obstacle: obstacles[n], found, n }));
  const found = [
    ...answerOccasions(verdict, dance.margin),
    ...told.flatMap(tooNear),
    ...nearestOf(told.filter((one) => !one.found.contact)),
  ].filter(({ time }) => start <= time && time <= last);
  const occasions = [...found, ...dance.occasions].sort((a, b) => a.time - b.time);
  const { clearance } = verdict;
  const nearest = clearance ? withTightest(dance.nearest, clearance, start, last) : dance.nearest;
  return { ...dance, occasions, nearest };
}

/** First contact, tightest moment and fastest moment. @param {Verdict} verdict @param {number} margin @returns {Occasion[]} */
function answerOccasions({ first_contact: contact, clearance, greatest_speed: speed }, margin) {
  const near = clearance?.witness;
  const fast = speed?.witness;
  /** @type {Occasion[]} */
  const found = [];
  if (contact?.witness) {
    const apart = (contact.witness.gap ?? 0) > 0 && margin > 0;
    const text = both(() => (apart ? _("margin not kept") : _("first contact")));
    found.push(occasion("contact", contact.value ?? 0, text, contact.witness.benches));
  } else if (clearance && near && near.time !== null) {
    const gap = general(100 * (clearance.value ?? 0), 3);
    const text = both(() => _("tightest moment: {gap} cm", { gap }));
    found.push(occasion("tightest", near.time, text, near.benches));
  }
  if (speed && fast && fast.time !== null) {
    const text = both(() => _("fastest moment: {speed} m/s", { speed: general(speed.value ?? 0, 4) }));
    found.push(occasion("fastest", fast.time, text, fast.benches));
  }
  return found;
}

/** When a bench comes nearer to an obstacle than its margin, and when one touches it. @param {Told} told @returns {Occasion[]} */
function tooNear(told) {
  const { obstacle, found } = told;
  const { contact, distance } = found;
  if (!contact) return [];
  const apart = contact.witness !== null && (contact.witness.gap ?? 0) > 0;
  const kept = both(() => _("margin from {name} not kept", { name: named(obstacle) }));
  const occasions = apart ? atObstacle(contact, told, kept) : [];
  const touch = apart ? distance : contact;
  if (touch.witness && distance.value === 0) {
    const [bench] = touch.witness.benches;
    occasions.push(...atObstacle(touch, told, touchWords(bench, obstacle)));
  }
  return occasions;
}

/** That a bench touches an obstacle or leaves the venue. @param {number} bench @param {Obstacle} obstacle */
function touchWords(bench, obstacle) {
  const says = () => {
    const values = { bench, name: named(obstacle) };
    if (obstacle.kind === "venue") return _("bench {bench} leaves {name}", values);
    return _("bench {bench} touches {name}", values);
  };
  return both(says);
}

/** The moment nearest to what is cleared with least to spare. @param {Told[]} clear @returns {Occasion[]} */
function nearestOf(clear) {
  const room = (/** @type {Told} */ { found }) => (found.distance.value ?? 0) - (found.margin ?? 0);
  const [told] = clear.sort((a, b) => room(a) - room(b));
  if (!told) return [];
  const { obstacle, found } = told;
  const says = () => {
    const values = { name: named(obstacle), gap: general(100 * (found.distance.value ?? 0), 4) };
    if (obstacle.kind === "venue") return _("nearest to the edge of {name}: {gap} cm", values);
    return _("nearest to {name}: {gap} cm", values);
  };
  return atObstacle(found.distance, told, both(says));
}

/** What an answer says of an obstacle, at the time of its witness; none without one.
 * @param {Answer} answer @param {Told} told @param {Words} text @returns {Occasion[]} */
function atObstacle({ witness, unit, value }, { obstacle, n }, text) {
  if (!witness || witness.time === null) return [];
  const time = unit === "s" && value !== null ? value : witness.time;
  const kind = obstacle.kind === "venue" ? "venue" : "obstacle";
  return [occasion(kind, time, text, witness.benches, n)];
}

/** @param {Occasion["kind"]} kind @param {number} time @param {Words} text @param {number[]} benches @param {number | null} [obstacle] @returns {Occasion} */
function occasion(kind, time, text, benches, obstacle = null) {
  return { kind, time, text, benches, obstacle };
}

/** The same, with the tightest pair of all as the check found it, which looks closer.
 * @param {Nearest} nearest @param {Answer} clearance @param {number} start @param {number} last @returns {Nearest} */
function withTightest(nearest, { value, witness }, start, last) {
  if (!witness || witness.time === null || value === null) return nearest;
  if (witness.time < start || witness.time > last) return nearest;
  const found = structuredClone(nearest);
  const [a, b] = witness.benches;
  for (const [bench, other] of [
    [a, b],
    [b, a],
  ]) {
    const i = bench - 1;
    if (value >= (found.other[i] ? found.distance[i] : found.reach)) continue;
    found.distance[i] = rounded(value, 5);
    found.time[i] = rounded(witness.time, 4);
    found.other[i] = other;
  }
  return found;
}
