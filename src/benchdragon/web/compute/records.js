// What a check found as plain data, in the shape of `--json`: twin of analysis/records.py. SI units;
// numbers that are not finite come as null. What readers read comes in both languages, but for the
// assumptions of an answer: those are in the language in which it was sought.

import { shownName } from "../made/findings.js";
import { shownName as levelName } from "../made/room_levels.js";
import { peakText, sentence } from "../made/verdict_text.js";
import { _, both } from "../words.js";
import { finiteOrNull } from "./number_format.js";

/** @typedef {import("../messages").Answer} AnswerRecord */
/** @typedef {import("../messages").Finding} FindingRecord */
/** @typedef {import("../messages").ObstacleRecord} ObstacleRecord */
/** @typedef {import("../messages").RoomRecord} RoomRecord */
/** @typedef {import("../messages").Verdict} Verdict */
/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./check.js").Report} Report */
/** @typedef {import("./errors.js").WalkError} WalkError */
/** @typedef {import("./quantities.js").QuantityName} QuantityName */
/** The plan's hash and the package's version, which all answers carry. @typedef {{ plan_sha256: string, version: string }} Stamp */

/** The record of an answer about a plan. @param {Answer} found @param {Stamp} stamp @returns {AnswerRecord} */
export function answerOf(found, stamp) {
  const { value, lower, upper, unit, status, witness, assumptions, evaluations, seconds } = found;
  const [low, high] = [finiteOrNull(lower), finiteOrNull(upper)];
  return {
    value: finiteOrNull(value),
    lower: low,
    upper: high,
    unit,
    status,
    witness: witness && {
      ...witness,
      time: witness.time === null ? null : finiteOrNull(witness.time),
      gap: finiteOrNull(witness.gap),
    },
    assumptions,
    evaluations,
    seconds,
    ...stamp,
  };
}

/** The record of an answer that may be missing. @param {Answer | null} found @param {Stamp} stamp */
function answerOrNull(found, stamp) {
  return found && answerOf(found, stamp);
}

/** The record of a check. @param {Report} report @param {string} version of the package @returns {Verdict} */
export function verdictOf(report, version) {
  const { plan, start, end, clearance, peaks } = report;
  const stamp = { plan_sha256: plan.sha256, version };
  return {
    safe: report.safe,
    decided: report.decided,
    proved: false,
    unproved: [],
    sentence: both(() => sentence(report)),
    start,
    end,
    first_contact: answerOrNull(report.first_contact, stamp),
    clearance: answerOf(clearance, stamp),
    greatest_speed: answerOf(report.greatest_speed, stamp),
    peaks: Object.entries(peaks).map(([name, peak]) => ({
      name,
      text: both(() => peakText(/** @type {QuantityName} */ (name))),
      peak: answerOf(peak, stamp),
    })),
    obstacles: report.obstacles.map((found) => obstacleRecord(found, stamp)),
    room: report.room.map((level) => roomRecord(level, stamp)),
    findings: report.findings.map(findingRecord),
    not_looked_at: report.not_looked_at.map((/** @type {any} */ one) => ({
      kind: one.kind,
      text: both(() => one.text),
    })),
    stops: report.stops,
    seconds: report.seconds,
    ...stamp,
  };
}

/** @param {import("../made/findings.js").Finding} found @returns {FindingRecord} */
function findingRecord(found) {
  const { code, kind, decided, time, benches, value, limit, obstacle } = found;
  return {
    code,
    kind,
    decided,
    text: both(() => found.text),
    time,
    benches,
    value: finiteOrNull(value),
    limit: finiteOrNull(limit),
    obstacle: obstacle || null,
  };
}

/** @param {import("./obstacles.js").ObstacleAnswers} found @param {Stamp} stamp @returns {ObstacleRecord} */
function obstacleRecord({ obstacle, contact, touch, distance }, stamp) {
  return {
    name: obstacle.name,
    shown: both(() => shownName(obstacle)),
    kind: obstacle.kind,
    margin: obstacle.margin,
    contact: answerOrNull(contact, stamp),
    touch: answerOrNull(touch, stamp),
    distance: answerOf(distance, stamp),
  };
}

/** @param {import("../made/room_levels.js").RoomLevel} level @param {Stamp} stamp @returns {RoomRecord} */
function roomRecord(level, stamp) {
  const { name, asked, margin, kept, first } = level;
  return {
    name,
    text: both(() => levelName(level)),
    asked: asked.map((/** @type {any} */ { key, value, source }) => ({
      key,
      value,
      source: source || null,
    })),
    margin,
    kept,
    first: first && answerOf(first[0], stamp),
    obstacle: first?.[1] ? first[1].name : null,
  };
}
