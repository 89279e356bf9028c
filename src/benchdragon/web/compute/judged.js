// A dance with what a check of its plan found: twin of `checked_dance` in player/scene.py.

import { _ } from "../words.js";
import { named } from "./findings.js";
import { general } from "./number_format.js";
import { rounded } from "./numbers.js";
import { verdictOf } from "./records.js";
import { occasion } from "./scene.js";

/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./check.js").Report} Report */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("./obstacles.js").ObstacleAnswers} ObstacleAnswers */
/** @typedef {import("./scene.js").Unpacked} Unpacked */
/** @typedef {import("../messages").Nearest} Nearest */
/** @typedef {import("../messages").Occasion} Occasion */

/**
 * The dance with its verdict, what happens when, and its tightest pair as the check found it.
 * @param {Unpacked} dance of the same plan
 * @param {Report} report
 * @param {string} version of the program
 * @returns {Unpacked}
 */
export function judgedDance(dance, report, version) {
  const { frames, occasions, nearest } = dance.sent;
  const last = frames.start + frames.step * (frames.count - 1);
  const found = answersOf(report).filter(({ time }) => frames.start <= time && time <= last);
  const sent = {
    ...dance.sent,
    verdict: verdictOf(report, version),
    occasions: [...found, ...occasions].sort((a, b) => a.time - b.time),
    nearest: withTightest(nearest, report.clearance, [frames.start, last]),
  };
  return { ...dance, sent };
}

/** The same, with the tightest pair of all as the check found it, which looks closer. @param {Nearest} nearest @param {Answer} clearance @param {[number, number]} span s @returns {Nearest} */
function withTightest(nearest, { value, witness }, [start, end]) {
  if (!witness || witness.time === null || !(start <= witness.time && witness.time <= end))
    return nearest;
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

/** First contact, tightest moment and fastest moment of a check, and what happens on the square. @param {Report} report */
function answersOf(report) {
  const { contact, clearance, speed } = report;
  const [near, fast] = [clearance.witness, speed.witness];
  /** @type {Occasion[]} */
  const found = [];
  if (contact?.witness) {
    const apart = contact.witness.gap > 0 && report.plan.tables.limits.margin > 0;
    const say = () => (apart ? _("margin not kept") : _("first contact"));
    found.push(occasion("contact", contact.value, say, contact.witness.benches));
  } else if (near && near.time !== null) {
    const gap = general(100 * clearance.value, 3);
    found.push(
      occasion("tightest", near.time, () => _("tightest moment: {gap} cm", { gap }), near.benches),
    );
  }
  if (fast && fast.time !== null && Number.isFinite(fast.time)) {
    const most = general(speed.value, 4);
    const say = () => _("fastest moment: {speed} m/s", { speed: most });
    found.push(occasion("fastest", fast.time, say, fast.benches));
  }
  return [...found, ...onTheSquare(report.obstacles)];
}

/** When benches come too near to obstacles, and touch; the moment nearest to one that is clear. @param {ObstacleAnswers[]} answers */
function onTheSquare(answers) {
  const found = answers.flatMap((one, n) => (one.contact ? tooNear(one, one.contact, n) : []));
  const clear = answers
    .map(({ contact, distance, obstacle }, n) => ({
      contact,
      n,
      room: distance.value - obstacle.margin,
    }))
    .filter(({ contact }) => contact === null)
    .sort((a, b) => a.room - b.room || a.n - b.n);
  for (const { n } of clear.slice(0, 1)) {
    const { distance, obstacle } = answers[n];
    const gap = general(100 * distance.value, 4);
    const say = () => {
      const values = { name: named(obstacle), gap };
      return obstacle.kind === "venue"
        ? _("nearest to the edge of {name}: {gap} cm", values)
        : _("nearest to {name}: {gap} cm", values);
    };
    found.push(...atObstacle(distance, obstacle, n, say));
  }
  return found;
}

/** When a bench comes nearer to obstacle number n than its margin; and when one touches it. @param {ObstacleAnswers} answers @param {Answer} contact @param {number} n */
function tooNear({ obstacle, distance }, contact, n) {
  const apart = contact.witness !== null && contact.witness.gap > 0;
  const found = apart
    ? atObstacle(contact, obstacle, n, () =>
        _("margin from {name} not kept", { name: named(obstacle) }),
      )
    : [];
  const touch = apart ? distance : contact;
  const { witness } = touch;
  if (witness && distance.value === 0)
    found.push(...atObstacle(touch, obstacle, n, () => touchText(witness.benches[0], obstacle)));
  return found;
}

/** That a bench (number, from 1) touches an obstacle or leaves the venue, in words. @param {number} bench @param {Obstacle} obstacle */
function touchText(bench, obstacle) {
  const values = { bench, name: named(obstacle) };
  return obstacle.kind === "venue"
    ? _("bench {bench} leaves {name}", values)
    : _("bench {bench} touches {name}", values);
}

/** What an answer says of obstacle number n, at the time of its witness; none without one. @param {Answer} answer @param {Obstacle} obstacle @param {number} n @param {() => string} say */
function atObstacle({ witness, unit, value }, obstacle, n, say) {
  if (!witness || witness.time === null) return [];
  const kind = obstacle.kind === "venue" ? "venue" : "obstacle";
  return [occasion(kind, unit === "s" ? value : witness.time, say, witness.benches, n)];
}
