// A verdict in one sentence. Twin of what analysis/check.py says of a report.

import { _ } from "../words.js";
import { shown, sure, vanishing } from "./answer.js";
import { isDecided } from "./check.js";
import { ANALYSIS_CHECK } from "./constants.js";
import { named } from "./findings.js";
import { general, seconds } from "./number_format.js";
import { QUANTITIES, givenLimits } from "./quantities.js";
import { levelName } from "./room.js";
import { unfinishedText } from "./unfinished.js";

/** @typedef {import("./check.js").Report} Report */
/** @typedef {import("./findings.js").Finding} Finding */
/** @typedef {import("./obstacles.js").ObstacleAnswers} ObstacleAnswers */
/** @typedef {import("./quantities.js").QuantityName} QuantityName */

/** What the greatest of a limited quantity is called, in the language in use. @param {QuantityName} name */
export function peakText(name) {
  return _("greatest {what}", { what: QUANTITIES[name].text() });
}

/** A verdict in one sentence, in the language in use. @param {Report} report */
export function sentence(report) {
  const { findings } = report;
  if (!findings.length) return _("Safe: {tightest}", { tightest: keptText(report) });
  let finding = briefly(soonest(findings));
  const count = findings.length;
  if (count > 1) finding = _("{finding} (one of {count} findings)", { finding, count });
  if (!isDecided(report)) return _("Undecided: {finding}", { finding });
  return _("Not safe: {finding}", { finding });
}

/** What is told first: what is decided, what touches, and of that the soonest. @param {Finding[]} findings */
function soonest(findings) {
  const order = (/** @type {Finding} */ { decided, kind, time }) => {
    const touch = briefText(kind, {}) !== null;
    return [Number(!decided), Number(!touch), touch ? (time ?? Infinity) : 0];
  };
  return findings.reduce((first, one) => {
    const [a, b] = [order(first), order(one)];
    const differs = a.findIndex((value, n) => value !== b[n]);
    return differs >= 0 && b[differs] < a[differs] ? one : first;
  });
}

/**
 * What is found of benches and obstacles, in the fewest words; null of anything else.
 * @param {Finding["kind"]} kind
 * @param {Record<string, string | number>} words
 */
function briefText(kind, words) {
  switch (kind) {
    case "contact":
      return _("benches {a} and {b} touch at {t} s", words);
    case "margin":
      return _("benches {a} and {b} come nearer than the {margin} m asked for at {t} s", words);
    case "obstacle":
      return _("bench {a} touches {name} at {t} s", words);
    case "obstacle_margin":
      return _("bench {a} comes nearer than {margin} m to {name} at {t} s", words);
    case "venue":
      return _("bench {a} leaves {name} at {t} s", words);
    case "venue_margin":
      return _("bench {a} comes nearer than {margin} m to the edge of {name} at {t} s", words);
    case "sway":
      return _("benches {a} and {b} have no room to sway at {t} s", words);
    case "imprecision":
      return _("benches {a} and {b} have no room for imprecision at {t} s", words);
    case "people":
      return _("the people of benches {a} and {b} have no room at {t} s", words);
    default:
      return null;
  }
}

/** A finding in few words, in the language in use. @param {Finding} found */
function briefly({ kind, decided, time, obstacle, benches, limit, text }) {
  if (!decided || time === null) return text();
  if (obstacle && (kind === "sway" || kind === "imprecision" || kind === "people")) return text();
  const words = {
    a: benches[0],
    b: benches[benches.length - 1],
    t: seconds(time),
    margin: general(limit),
    name: obstacle ? named(obstacle) : "",
  };
  return briefText(kind, words) ?? text();
}

/** What a safe walk keeps: the tightest place, and margin and speed beside what was asked for. @param {Report} report */
function keptText(report) {
  const { limits } = report.plan.tables;
  const said = [tightestText(report)];
  if (limits.margin) said.push(_("{margin} m were asked for", { margin: general(limits.margin) }));
  said.push(...keptFrom(report));
  if (report.room.length) {
    const levels = report.room.slice(1).map(({ name }) => levelName(name)).join(_(", ")); // prettier-ignore
    said.push(_("room is kept {levels}", { levels }));
  }
  if (limits.speed !== null)
    said.push(
      _("fastest handle {speed} m/s of {limit} m/s allowed", {
        speed: shown(report.speed, true, limits.speed),
        limit: general(limits.speed),
      }),
    );
  const given = givenLimits(limits);
  for (const [name, peak] of Object.entries(report.peaks)) {
    const quantity = /** @type {QuantityName} */ (name);
    const limit = Number(given[quantity]);
    said.push(
      _("{what} at most {most} {unit} of {limit} {unit} allowed", {
        what: QUANTITIES[quantity].text(),
        most: shown(peak, true, limit),
        limit: general(limit),
        unit: peak.unit,
      }),
    );
  }
  if (report.unfinished !== null) said.push(unfinishedText(report.unfinished));
  if (report.notLookedAt.length) {
    const what = report.notLookedAt.map(({ brief }) => brief()).join(_(", "));
    said.push(_("not looked at: {what}", { what }));
  }
  return said.join(_("; "));
}

/** The tightest moment of a safe walk; benches of one coil come as near as the bends want. @param {Report} report */
function tightestText({ clearance, plan }) {
  const { witness } = clearance;
  if (witness === null || witness.time === null || witness.benches.length !== 2)
    return _("no two benches come near one another");
  const [a, b] = witness.benches;
  const gap = shown(clearance, false, plan.tables.limits.margin);
  const words = { gap, a, b, t: seconds(witness.time) };
  if (vanishing(clearance))
    return _("tightest less than {gap} m, bench {a} with bench {b}, at {t} s", words);
  return inOneCoil(witness.benches)
    ? _("none come nearer than two with one between them, which keep {gap} m in the bends", words)
    : _("tightest {gap} m, bench {a} with bench {b}, at {t} s", words);
}

/** Whether two benches have one between them: no plan but that of the benches keeps them apart. @param {number[]} benches */
export function inOneCoil([a, b]) {
  return Math.abs(a - b) === ANALYSIS_CHECK.AFTER_NEXT;
}

/** The least distance from the venue's edge, and from the obstacle that leaves the least room. @param {Report} report */
function keptFrom({ obstacles }) {
  const venue = obstacles.filter(({ obstacle }) => obstacle.kind === "venue");
  const stands = obstacles.filter(({ obstacle }) => obstacle.kind !== "venue");
  const left = (/** @type {ObstacleAnswers} */ { distance, obstacle }) =>
    sure(distance, false) - obstacle.margin;
  const near = [...stands].sort((a, b) => left(a) - left(b)).slice(0, 1);
  return [...venue, ...near].map((one) => {
    const { margin } = one.obstacle;
    const kept = fromText(one, stands.length);
    if (!margin) return kept;
    return _("{kept} ({margin} m asked for)", { kept, margin: general(margin) });
  });
}

/** @param {ObstacleAnswers} answers @param {number} count of obstacles */
function fromText({ obstacle, distance }, count) {
  const gap = shown(distance, false, obstacle.margin);
  const words = { gap, name: named(obstacle), count };
  if (vanishing(distance))
    return obstacle.kind === "venue"
      ? _("less than {gap} m from the edge of {name}", words)
      : _("less than {gap} m from {name}", words);
  if (obstacle.kind === "venue") return _("at least {gap} m from the edge of {name}", words);
  if (count > 1) return _("at least {gap} m from {name}, the narrowest of {count} obstacles", words);
  return _("at least {gap} m from {name}", words);
}
