// Whether a walk is safe: first contact, least clearance, speeds and accelerations against limits. Twin of
// analysis/check.py; what is proved, the command line proves.

import { keeps } from "../made/answer.js";
import { allFindings, named } from "../made/findings.js";
import { notLookedAt } from "../made/not_looked_at.js";
import { levelsAsked } from "../made/room_levels.js";
import { _ } from "../words.js";
import { mostOf, now } from "./answer.js";
import { question } from "./budget.js";
import { ANALYSIS_SPEED } from "./constants.js";
import { TOLERANCES, firstSureContact, leastClearance, seenClearance } from "./contact.js";
import { speedAtStart, toldIfOpen } from "./left_open.js";
import { obstacleAnswers } from "./obstacles.js";
import { QUANTITIES, givenLimits } from "./quantities.js";
import { roomLevels } from "./room.js";
import { greatest } from "./speed.js";
import { stages } from "./stages.js";
import { stopsOf } from "./stops.js";
import { silent } from "./tick.js";
import { unfinished } from "./walk_facts.js";

/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("../made/findings.js").Finding} Finding */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("./obstacles.js").ObstacleAnswers} ObstacleAnswers */
/** @typedef {import("./quantities.js").QuantityName} QuantityName */
/** @typedef {import("../made/room_levels.js").RoomLevel} RoomLevel */
/** @typedef {import("./stops.js").Stop} Stop */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */

/**
 * What a check asks of a plan.
 * @typedef {object} CheckedPlan
 * @property {string} sha256
 * @property {{ limits: Limits, route: any, people: import("./room.js").People & { most_speed: number | null },
 *   cues: { cue: unknown[] } }} tables
 * @property {() => Obstacle[]} obstacles the venue's edge, if the plan says one, then what stands in it
 */

/** A plan's limits. @typedef {Record<QuantityName, number | null> & { head_acceleration: number, margin: number }} Limits */

/**
 * What a check found: see `Report` there.
 * @typedef {object} Report
 * @property {CheckedPlan} plan
 * @property {Walk} walk that of the plan
 * @property {number} start of the walk, s
 * @property {number} end of the walk, s; the answers but the first speak of it up to a contact
 * @property {Answer | null} first_contact when two non-adjacent benches first touch, or come nearer than the margin
 * @property {Answer} clearance the least that they keep, m; 0 where they touch
 * @property {Answer} greatest_speed the greatest of any handle, m/s
 * @property {Partial<Record<QuantityName, Answer>>} peaks the greatest of what else is limited, in SI units
 * @property {Finding[]} findings empty if the walk is safe
 * @property {ObstacleAnswers[]} obstacles
 * @property {RoomLevel[]} room level upon level; empty where the plan asks for none
 * @property {Stop[] | null} stops of the head; null for a plan without cues
 * @property {number} seconds how long the check took
 * @property {import("../made/unfinished.js").Unfinished | null} unfinished what the walk lacks where it ends before the tail is out of the turn
 * @property {boolean} proved nothing is, and nothing was to be: `unproved`
 * @property {never[]} unproved
 * @property {boolean} safe whether nothing was found
 * @property {boolean} decided whether no question was left open that could change that
 * @property {ReturnType<typeof notLookedAt>} not_looked_at what the plan does not say, so that nobody looked at it
 */

/**
 * Check the whole walk of a plan against its margin and its limits.
 * @param {CheckedPlan} plan
 * @param {Walk} walk that of the plan
 * @param {[number, number]} span start and end of the walk, s
 * @param {{ progress?: Progress }} [options]
 * @returns {Promise<Report>}
 */
export function check(plan, walk, span, options = {}) {
  return question(() => checked(plan, walk, span, options));
}

/** @param {CheckedPlan} plan @param {Walk} walk @param {[number, number]} span @param {{ progress?: Progress }} options @returns {Promise<Report>} */
async function checked(plan, walk, [start, end], { progress = silent }) {
  const began = now();
  const asked = levelsAsked(plan.tables.people);
  let reached = 0;
  const heard = (/** @type {number} */ share, /** @type {string} */ text) =>
    progress((reached = share), text);
  // Told by what does not know how far it is, so that it can be given up.
  const alive = () => progress(reached, "");
  const stage = stages(heard, asked.length ? 6 : 5);
  const { contact, clearance } = await nearnessOf(plan, walk, [start, end], stage);
  /** @type {[number, number]} */
  const span = [start, contact === null || contact.witness === null ? end : contact.upper];
  /** @type {Finding[]} */
  const left = [];
  const speed = await greatestSpeed(plan, walk, span, stage(_("greatest speed")), alive);
  const peaks = await limitedPeaks(plan, walk, span, left, stage(_("other limits")), alive);
  const stands = { tolerances: TOLERANCES, progress: alive };
  const obstacles = await obstaclesOf(plan, walk, span, stands, left, stage(_("obstacles")));
  const bare = { contact, obstacles };
  /** @type {RoomLevel[]} */
  const room = [];
  if (asked.length) {
    const heard = stage(_("room for people"));
    const levels = () => roomLevels(plan, walk, [start, end], bare, heard, alive, room);
    await toldIfOpen(left, levels, asked[asked.length - 1]);
  }
  const all = { speed, ...peaks };
  const findings = [...allFindings(plan, walk, span, contact, obstacles, all, room), ...left];
  const stops = plan.tables.cues.cue.length ? stopsOf(walk, start, end) : null;
  const seconds = now() - began;
  return {
    plan, walk, start, end, first_contact: contact, clearance, greatest_speed: speed, peaks, findings,
    obstacles, room, stops, seconds,
    proved: false,
    unproved: [],
    safe: !findings.length,
    decided: !findings.length || findings.some((one) => one.decided),
    unfinished: unfinished(plan, walk, end),
    not_looked_at: notLookedAt(plan, walk, start, end),
  }; // prettier-ignore
}

/**
 * The first contact, and the least clearance until then.
 * @param {CheckedPlan} plan
 * @param {Walk} walk
 * @param {[number, number]} span
 * @param {ReturnType<typeof stages>} stage
 * @returns {Promise<{ contact: Answer | null, clearance: Answer }>}
 */
async function nearnessOf(plan, walk, [start, end], stage) {
  const { margin } = plan.tables.limits;
  const progress = stage(_("searching for contact"));
  const contact = await firstSureContact(walk, start, end, { margin, progress });
  const near = contact?.witness ?? null;
  if (contact !== null && contact.status !== "undecided" && near !== null && !(near.gap > 0))
    return { contact, clearance: { ...contact, value: 0, lower: 0, upper: 0, unit: "m" } };
  const until = contact === null || near === null ? end : contact.upper;
  const told = { progress: stage(_("clearance")) };
  const known = await toldIfOpen([], () => leastClearance(walk, start, until, told));
  const floor = contact === null ? margin : 0;
  return { contact, clearance: known ?? (await seenClearance(walk, start, until, floor)) };
}

/**
 * What is found about the venue's edge and each obstacle over a span of the walk, s.
 * @param {CheckedPlan} plan
 * @param {Walk} walk
 * @param {[number, number]} span
 * @param {{ tolerances: number[], progress: Progress }} options those of each
 * @param {Finding[]} left
 * @param {Progress} progress
 */
async function obstaclesOf(plan, walk, span, options, left, progress) {
  const known = plan.obstacles();
  const found = [];
  for (const [n, obstacle] of known.entries()) {
    progress(n / known.length, named(obstacle));
    const answers = () => obstacleAnswers(walk, obstacle, ...span, options);
    const told = await toldIfOpen(left, answers, obstacle);
    if (told !== null) found.push(told);
  }
  return found;
}

/** The greatest speed over a span of the walk, s, asked again where its bracket holds a limit. @param {CheckedPlan} plan @param {Walk} walk @param {[number, number]} span @param {Progress} told @param {Progress} alive */
async function greatestSpeed({ tables: { limits, people } }, walk, span, told, alive) {
  const asked = async () => {
    let speed = await greatest(walk, QUANTITIES.speed, ...span, {
      tolerance: ANALYSIS_SPEED.TOLERANCE,
      progress: told,
    });
    for (const limit of [limits.speed, people.most_speed])
      if (limit !== null && keeps(speed, limit) === null)
        speed = await greatest(walk, QUANTITIES.speed, ...span, {
          limit: mostOf(limit),
          progress: alive,
        });
    return speed;
  };
  return (await toldIfOpen([], asked)) ?? speedAtStart(walk, span[0]);
}

/**
 * The greatest of each quantity but speed that the plan limits, over a span of the walk, s.
 * @param {CheckedPlan} plan
 * @param {Walk} walk
 * @param {[number, number]} span
 * @param {Finding[]} left
 * @param {Progress} progress
 * @param {Progress} alive
 */
async function limitedPeaks(plan, walk, span, left, progress, alive) {
  const limits = Object.entries(givenLimits(plan.tables.limits)).filter(([name]) => name !== "speed");
  /** @type {Partial<Record<QuantityName, Answer>>} */
  const peaks = {};
  for (const [n, [name, limit]] of limits.entries()) {
    const quantity = QUANTITIES[/** @type {QuantityName} */ (name)];
    const tolerance = ANALYSIS_SPEED.RATE_TOLERANCE;
    const options = { tolerance, limit: mostOf(limit), progress: alive };
    const asked = () => greatest(walk, quantity, ...span, options);
    const peak = await toldIfOpen(left, asked, quantity.name, Number(limit));
    if (peak !== null) peaks[quantity.name] = peak;
    progress((n + 1) / limits.length, "");
  }
  return peaks;
}
