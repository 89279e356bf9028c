// What the permit annex tells of a dance: the crowd and what it has, posts, distances, and the chance that
// imprecise people come too near.

import { peakText, sentence } from "../made/check.js";
import { Clock } from "../made/clock.js";
import {
  crowdOf,
  densityText,
  distanceOf,
  entrancesOf,
  eventFindings,
  shutText,
  waysOut,
  withinLines,
} from "../made/crowd.js";
import { shownName } from "../made/findings.js";
import { chanceOf } from "../made/imprecise.js";
import { LEAST_GAIN, MOST_GAIN, offTracking } from "../made/off_tracking.js";
import { marshalPosts } from "../made/posts.js";
import { lengthOf, outermost } from "../made/rings.js";
import { shownName as levelName } from "../made/room_levels.js";
import { givenLimits } from "../made/speed.js";
import { sure } from "../made/answer.js";
import { part } from "../made/stages.js";
import { _, both } from "../words.js";
import { OverBudgetError } from "./budget.js";
import { withArenaAsync } from "./arena.js";
import { safeReport } from "./briefing.js";
import { py } from "./python.js";
import { sweptArea } from "./swept.js";

/** @typedef {import("./questions.js").Asked} Asked */
/** @typedef {import("./swept.js").Ring} Ring */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {import("../messages").Words} Words */
/** @typedef {import("../messages").Answer} Answer */
/** @typedef {[number, number]} Point */

/** An answer about something, and what the plan asks for: a limit, if `up`. @typedef {{ name: Words, found: Answer, asked: number | null, up: boolean }} Told */
/** A post for marshals: see `Post` of analysis/posts.py. @typedef {{ point: Point, reasons: Array<{ why: string, value: number, time: number }> }} Post */
/** How wide an entrance is, m; when benches are nearest to it, s, which, and how near, m; when it is shut, in figures. @typedef {{ width: number | null, time: number | null, bench: number, away: number, inside: boolean, shut: string }} Entrance */
/** A level of room for people: see `RoomLevel` of analysis/room.py. @typedef {{ name: Words, asked: Array<{ key: string, value: number, source: string }>, between: number, kept: boolean | null }} Level */

/**
 * What the annex tells beside the briefing.
 * @typedef {object} AnnexFacts
 * @property {string} version of the program
 * @property {Words} verdict a sentence, by the clock of papers
 * @property {Array<{ code: string, text: Words }>} findings about spectators
 * @property {{ people: number | null, ground: number | null, way: number | null, density: number | null, level: Words | null }} crowd
 * @property {{ width: number | null, free: number, unknown: number[], flows: number[], minutes: number[] | null }} exits ways out: see `WaysOut` of analysis/crowd.py
 * @property {Entrance[]} entrances
 * @property {{ margin: number, given: boolean, error: number, area: number, within: number, length: number, rectangle: { width: number, height: number }, outlines: Ring[], lines: Ring[], round: boolean }} ground `round`: whether benches go round some that they leave free
 * @property {Post[]} posts
 * @property {{ count: number, length: number, head: number, body: number, width: number }} dragon m
 * @property {{ way: number, end: number }} head how far it walks, m, and until when, s
 * @property {Told[]} clearances
 * @property {Told[]} speeds
 * @property {Level[]} room
 * @property {{ deviations: Record<string, number>, draws: number, hits: number, shown: boolean, most: number }} chance
 * @property {number} margin that benches keep from one another, m
 * @property {{ first: number, off: Array<{ gain: number, far: number | null }>, beside: number }} tail its first bench; how far any bench leaves the line, m, where bearers steer back with a gain, 1/m: the plan's, else the least and the greatest; infinite where benches fold, null where that takes too much work; and how far people stand and sway beside it, m
 * @property {Record<string, any>} event the table of the plan, filled
 */

/** Error of the ground that is covered, m. */
const ERROR = 0.05;
/** Benches of the tail, of which it is told how they walk and who stands there. */
const TAIL = 10;

/** What the annex of a plan tells; only a plan that is safe has one. @param {Asked} asked @returns {Promise<AnnexFacts>} */
export function annex({ engine, version, plan, progress }) {
  return withArenaAsync(engine, async (arena) => {
    const walk = plan.build(arena);
    const span = plan.span(walk);
    const report = await safeReport(plan, walk, span, part(progress, 0, 0.3));
    const ground = await onTheGround(plan, walk, report, progress);
    return { version, ...ground, ...dance(plan, walk, report) };
  });
}

/** What needs the ground that is covered, and random dances. @param {any} plan @param {Walk} walk @param {any} report @param {Progress} progress */
async function onTheGround(plan, walk, report, progress) {
  /** @type {[number, number]} */
  const span = [report.start, report.end];
  const clock = clockOf(plan, report);
  const margin = distanceOf(plan);
  const told = part(progress, 0.3, 0.5, _("ground covered"));
  const swept = await sweptArea(walk, span, margin, ERROR, told);
  const lines = outermost(swept.lines.outer);
  progress(0.5, _("entrances"));
  const fastest = report.greatest_speed.upper;
  const entrances = await entrancesOf(plan, walk, span, lines, fastest);
  const venue = report.obstacles.find((/** @type {any} */ one) => one.obstacle.kind === "venue");
  const crowd = crowdOf(plan, lines, venue ? sure(venue.distance, false) : 0);
  const posts = marshalPosts(report, lines, plan.event.places);
  const found = eventFindings(plan, crowd, entrances, clock);
  const chance = await chanceOf(plan, part(progress, 0.6, 1, _("random dances")));
  const { density } = crowd;
  return {
    findings: found.map((/** @type {any} */ one) => ({ code: one.code, text: both(() => one.text) })),
    crowd: {
      ...crowd,
      density,
      level: density == null ? null : both(() => _(densityText(density))),
    },
    exits: waysOut(entrances, plan.event.spectators),
    entrances: entrances.map((/** @type {any} */ one) => entranceTold(one, clock)),
    ground: {
      margin,
      given: plan.event.distance != null,
      error: swept.error,
      area: swept.area,
      within: withinLines(lines),
      length: lines.reduce(
        (/** @type {number} */ all, /** @type {Ring} */ one) => all + lengthOf(one),
        0,
      ),
      rectangle: swept.rectangle,
      outlines: [...swept.outlines.outer, ...swept.outlines.holes],
      lines: [...swept.lines.outer, ...swept.lines.holes],
      round: swept.lines.holes.length > 0,
    },
    posts,
    chance: { ...chance, shown: chance.shown, most: chance.draws ? chance.most : 1 },
  };
}

/** What plan and check know by themselves. @param {any} plan @param {Walk} walk @param {any} report */
function dance(plan, walk, report) {
  const { length, width, benches: count, link } = walk.dragon;
  const [from, to] = [report.start, report.end].map((time) => walk.headPosition(time));
  const clock = clockOf(plan, report);
  const limits = givenLimits(plan);
  const limit = (/** @type {string} */ name) => py.get(limits, name);
  return {
    verdict: both(() => sentence(report, clock)),
    dragon: {
      count,
      length: link.reduce((sum, one) => sum + one),
      head: length[0],
      body: length[Math.min(1, count - 1)],
      width: width.reduce((most, one) => Math.max(most, one)),
    },
    head: { way: to - from, end: report.end },
    clearances: [
      told(
        both(() => _("benches from one another")),
        report.clearance,
        plan.limits.margin,
        false,
      ),
      ...report.obstacles.map(clearanceTold),
    ],
    speeds: [
      told(
        both(() => _("fastest handle")),
        report.greatest_speed,
        limit("speed"),
        true,
      ),
      ...py.items(report.peaks).map((/** @type {[string, Answer]} */ [name, peak]) =>
        told(
          both(() => peakText(name)),
          peak,
          limit(name),
          true,
        ),
      ),
    ],
    room: report.room.map((/** @type {any} */ one) => ({
      name: both(() => levelName(one)),
      asked: one.asked,
      between: one.between,
      kept: one.kept,
    })),
    margin: plan.limits.margin,
    tail: tailOf(plan, walk, report),
    event: plan.event,
  };
}

/** How far any bench leaves the line; null where that takes too much work. @param {Walk} walk @param {number} gain @param {any} report */
function farthest(walk, gain, report) {
  try {
    return offTracking(walk, gain, report.start, report.end).farthest();
  } catch (error) {
    if (error instanceof OverBudgetError) return null;
    throw error;
  }
}

/** The tail, and how far benches leave the line. @param {any} plan @param {Walk} walk @param {any} report */
function tailOf(plan, walk, report) {
  const first = Math.max(walk.dragon.benches - TAIL, 0) + 1;
  const { steering } = plan.people;
  const gains = steering == null ? [LEAST_GAIN, MOST_GAIN] : [steering];
  const { beside, sway, imprecision } = plan.people;
  return {
    first,
    off: gains.map((gain) => ({ gain, far: farthest(walk, gain, report) })),
    beside: beside + sway + imprecision,
  };
}

/** How papers tell times. @param {any} plan @param {any} report */
function clockOf(plan, report) {
  return new Clock(String(plan.cues.clock), report.start);
}

/** @param {Words} name @param {Answer} found @param {number | null} asked @param {boolean} up @returns {Told} */
function told(name, found, asked, up) {
  return { name, found, asked, up };
}

/** What benches keep from an obstacle. @param {any} one */
function clearanceTold({ obstacle, distance }) {
  const name = both(() =>
    obstacle.kind === "venue"
      ? _("benches from the edge of {name}", { name: shownName(obstacle) })
      : _("benches from {name}", { name: shownName(obstacle) }),
  );
  return told(name, distance, obstacle.margin, false);
}

/** @param {any} entrance @param {Clock} clock @returns {Entrance} */
function entranceTold(entrance, clock) {
  const { gate, nearest, inside } = entrance;
  const { time = null, benches = [0] } = nearest.witness ?? {};
  return {
    width: gate.width,
    time,
    bench: benches[0],
    away: sure(nearest, false),
    inside,
    shut: shutText(entrance, clock),
  };
}
