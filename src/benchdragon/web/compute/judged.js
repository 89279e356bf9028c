// A dance with what a check of its plan found: twin of `checked_dance` in player/scene.py. It takes the
// check's record, so that nobody checks a plan twice.

import { named, touchText } from "../made/findings.js";
import { inOneCoil } from "../made/verdict_text.js";
import { _ } from "../words.js";
import { bracketed, shown, vanishing } from "./answer.js";
import { rounded } from "./numbers.js";
import { occasion } from "./scene.js";

/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("./scene.js").Unpacked} Unpacked */
/** @typedef {import("../messages").Answer} Answer */
/** @typedef {import("../messages").Nearest} Nearest */
/** @typedef {import("../messages").ObstacleRecord} ObstacleRecord */
/** @typedef {import("../messages").Occasion} Occasion */
/** @typedef {import("../messages").Verdict} Verdict */

/**
 * The dance with what happens when, and its tightest pair, as the check found them. The verdict itself the
 * page has from elsewhere.
 * @param {Unpacked} dance of the same plan
 * @param {Verdict} verdict
 * @param {Obstacle[]} obstacles those of the plan
 * @returns {Unpacked}
 */
export function judgedDance(dance, verdict, obstacles) {
  const { frames, occasions, nearest } = dance.sent;
  const last = frames.start + frames.step * (frames.count - 1);
  const found = [
    ...answersOf(verdict, dance.sent),
    ...onTheSquare(verdict.obstacles.map((record, n) => ({ record, n, obstacle: obstacles[n] }))),
  ].filter(({ time }) => frames.start <= time && time <= last);
  const sent = {
    ...dance.sent,
    occasions: [...found, ...occasions].sort((a, b) => a.time - b.time),
    nearest: withTightest(nearest, verdict.clearance, [frames.start, last]),
  };
  return { ...dance, sent };
}

/** The same, with the tightest pair of all as the check found it, which looks closer. @param {Nearest} nearest @param {Answer | null} clearance @param {[number, number]} span s @returns {Nearest} */
function withTightest(nearest, clearance, [start, end]) {
  const { value, witness } = clearance ?? { value: null, witness: null };
  if (value === null || !witness || witness.time === null) return nearest;
  if (!(start <= witness.time && witness.time <= end)) return nearest;
  const found = structuredClone(nearest);
  const [a, b] = witness.benches;
  for (const [bench, other] of [[a, b], [b, a]]) {
    const seen = found.other[bench - 1] ? found.distance[bench - 1] : found.reach;
    if (!(value < seen)) continue;
    found.distance[bench - 1] = rounded(value, 5);
    found.time[bench - 1] = rounded(witness.time, 4);
    found.other[bench - 1] = other;
  } // prettier-ignore
  return found;
}

/** First contact, tightest moment and fastest moment of a check. @param {Verdict} verdict @param {Unpacked["sent"]} sent what the plan asks for */
function answersOf({ first_contact: contact, clearance, greatest_speed: speed }, sent) {
  const { margin, speed_limit: limit } = sent;
  const [near, fast] = [clearance?.witness, speed?.witness];
  /** @type {Occasion[]} */
  const found = [];
  if (contact?.witness) {
    const apart = numberOf(contact.witness.gap) > 0 && margin > 0;
    const say = () => (apart ? _("margin not kept") : _("first contact"));
    found.push(occasion("contact", numberOf(contact.value), say, contact.witness.benches));
  } else if (clearance && near && near.time !== null) {
    const bracket = bracketed(clearance);
    const gap = { gap: shown(bracket, false, margin) };
    const say = () => {
      if (vanishing(bracket)) return _("tightest moment: less than {gap} m", gap);
      return inOneCoil(near.benches)
        ? _("nearest with one bench between: {gap} m", gap)
        : _("tightest moment: {gap} m", gap);
    };
    found.push(occasion("tightest", near.time, say, near.benches));
  }
  if (speed && fast && fast.time !== null) {
    const most = shown(bracketed(speed), true, limit);
    const say = () => _("fastest moment: {speed} m/s", { speed: most });
    found.push(occasion("fastest", fast.time, say, fast.benches));
  }
  return found;
}

/** A number of a record, which has none for what is not finite. @param {number | null} value */
function numberOf(value) {
  return value ?? Infinity;
}

/** What was found about one of the plan's obstacles, and its number. @typedef {{ record: ObstacleRecord, obstacle: Obstacle, n: number }} Found */

/** When benches come too near to obstacles, and touch; the moment nearest to one that is clear. @param {Found[]} all */
function onTheSquare(all) {
  const found = all.flatMap((one) => (one.record.contact ? tooNear(one, one.record.contact) : []));
  const clear = all
    .filter(({ record }) => record.contact === null)
    .map((one) => ({ ...one, room: numberOf(one.record.distance.value) - one.obstacle.margin }))
    .sort((a, b) => a.room - b.room || a.n - b.n);
  for (const one of clear.slice(0, 1)) {
    const { record, obstacle } = one;
    const bracket = bracketed(record.distance);
    const gap = shown(bracket, false, obstacle.margin);
    const say = () => {
      const values = { name: named(obstacle), gap };
      if (vanishing(bracket))
        return obstacle.kind === "venue"
          ? _("nearest to the edge of {name}: less than {gap} m", values)
          : _("nearest to {name}: less than {gap} m", values);
      return obstacle.kind === "venue"
        ? _("nearest to the edge of {name}: {gap} m", values)
        : _("nearest to {name}: {gap} m", values);
    };
    found.push(...atObstacle(record.distance, one, say));
  }
  return found;
}

/** When a bench comes nearer to an obstacle than its margin; and when one touches it. @param {Found} found @param {Answer} contact */
function tooNear(found, contact) {
  const { record, obstacle } = found;
  const apart = contact.witness !== null && numberOf(contact.witness.gap) > 0;
  const told = apart
    ? atObstacle(contact, found, () => _("margin from {name} not kept", { name: named(obstacle) }))
    : [];
  const touch = apart ? record.distance : contact;
  const { witness } = touch;
  if (witness && record.distance.value === 0)
    told.push(...atObstacle(touch, found, () => touchText(witness.benches[0], obstacle)));
  return told;
}

/** What an answer says of an obstacle, at the time of its witness; none without one. @param {Answer} answer @param {Found} found @param {() => string} say */
function atObstacle({ witness, unit, value }, { obstacle, n }, say) {
  if (!witness || witness.time === null) return [];
  const kind = obstacle.kind === "venue" ? "venue" : "obstacle";
  const time = unit === "s" ? numberOf(value) : witness.time;
  return [occasion(kind, time, say, witness.benches, n)];
}
