// What papers are made from: the plan as it was checked, and what each bench does.

import { countedIn, scoreOf } from "../made/beats.js";
import { haltsOf, landmarkOf } from "../made/bench_basis.js";
import { edgeLeft } from "../made/entrances.js";
import { shownName } from "../made/findings.js";
import { Ground, ownPeg } from "../made/ground.js";
import { benchWalks } from "../made/bench_walks.js";
import { sentence } from "../made/check.js";
import { chalkPlan } from "../made/chalk.js";
import { Trail } from "../made/chalk_line.js";
import { timetable } from "../made/timetable.js";
import { timetableText } from "../made/timetable_text.js";
import { overviewText } from "../made/overview_text.js";
import { part } from "../made/stages.js";
import { _, both, language } from "../words.js";
import { doubles, withArena, withArenaAsync, within } from "./arena.js";
import { check } from "./check.js";
import { InputError } from "./errors.js";
import { linspace } from "./numbers.js";
import { places } from "./walk_facts.js";

/** @typedef {import("../made/bench_walks.js").BenchWalk} BenchWalk */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./questions.js").Asked} Asked */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {{ head: number | null, until: number | null, tail: number | null }} Passing */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {import("../messages").Words} Words */
/** @typedef {import("../made/bench_text.js").Halt} Halt */
/** @typedef {import("../made/bench_text.js").Landmark} Landmark */
/** @typedef {{ name: string, columns: string[], rows: string[][], lines: string[] }} TimetableText */
/** @typedef {Record<"verdict" | "tightest" | "coming" | "leaving" | "room" | "starts", string[]>} OverviewText */
/** @typedef {[number, number]} Point */

/**
 * The chalk plan, as analysis/chalk.py says.
 * @typedef {{ stake: Point, place: Point, spokes: number, reach: number, wheel: number, chord: number }} Star
 * @typedef {{ start: Point, end: Point, place: Point, way: Point, length: number, swing: number }} Leg
 * @typedef {{ s: number, point: Point, star: number, tape: number, along: number, aside: number, out: boolean, kind: string }} Tick
 * @typedef {{ obstacle: number, star: number, tapes: number[] }} Met
 * @typedef {{ stars: Star[], legs: Leg[], ticks: Tick[], met: Met[], allowed: number, stray: number }} ChalkPlan
 */

/**
 * The dance as maps show it.
 * @typedef {object} Ways
 * @property {number} low where along the route `points` begin, m
 * @property {number} high and where they end
 * @property {number[][]} s where along the route each front handle is at the start, and at the end, m
 * @property {number[][]} ends x and y there, m, and the heading, rad: one after another at the start, and at the end
 * @property {Array<{ kind: import("./obstacle.js").ObstacleKind, points: Point[], left: Point[][], radius: number, shown: Words }>} obstacles `left`: what gates and entrances leave of the venue's edge
 * @property {Point[]} entrances where people come in, m
 */

/**
 * What sheets are made from. `points` are those of the route, m: x, y, one after another.
 * @typedef {object} Briefing
 * @property {string} sha256 of the plan
 * @property {Words} title
 * @property {Record<"en" | "zh", OverviewText>} overview
 * @property {BenchWalk[]} benches the head's first
 * @property {Record<"en" | "zh", Landmark[]>} landmarks near the place where each starts
 * @property {ChalkPlan | null} chalk tapes and ticks of the chalk line; null for too many
 * @property {Point[]} venue its edge, corner by corner, m; none
 * @property {Ground} ground from which places are told
 * @property {number} start of the dance, s
 * @property {string} clock the time of day then; ""
 * @property {Record<string, any>} people the table of the plan, filled
 * @property {Record<"en" | "zh", Halt[]>} halts
 * @property {boolean} coiled whether the dance ends inside
 * @property {Record<"en" | "zh", TimetableText>} timetable
 * @property {Array<[number | null, number | null, number | null]>} seconds since the start when the head comes to each place of it, when it sets out again after a stop, when the tail passes
 * @property {import("../messages").Beats} beats of the drum, with the bar that counts in
 * @property {number} end of the dance, s
 * @property {Ways} ways
 * @property {Float64Array} points
 */

// Points of a map's route at most, and how far apart they are, m, where that are fewer.
const MOST_POINTS = 3000;
const APART = 0.1;

/** What sheets of a plan are made from; only a plan that is safe has any. @param {Asked} asked @returns {Promise<Briefing>} */
export function briefing({ engine, plan, progress }) {
  return withArenaAsync(engine, async (arena) => {
    const walk = plan.build(arena);
    const span = plan.span(walk);
    const own = /** @type {any} */ (plan);
    const report = await safeReport(own, walk, span, part(progress, 0, 0.3));
    const told = part(progress, 0.3, 1, _("what each bench does"));
    const facts = await briefed(plan, walk, span, told);
    const { benches, ground } = facts;
    const overview = withArena(engine, (own) =>
      within(own, () => both(() => overviewText(report, benches, ground))),
    );
    return { ...facts, overview };
  });
}

/** What each bench does in a plan's walk, whether it is safe or not. @param {Asked} asked @returns {Promise<BenchWalk[]>} */
export function ways({ engine, plan, progress }) {
  return withArenaAsync(engine, async (arena) => {
    const walk = plan.build(arena);
    return benchWalks(plan, walk, plan.span(walk), 0, progress);
  });
}

/** The check of a plan, if nothing was found. @param {any} plan @param {Walk} walk @param {[number, number]} span @param {Progress} progress */
export async function safeReport(plan, walk, span, progress) {
  const report = await check(plan, walk, span, { progress });
  if (report.findings.length)
    throw new InputError(
      _("Sheets are made of a plan that is safe alone. {verdict}", { verdict: sentence(report) }),
    );
  return report;
}

/**
 * The same of any walk over a span, s, whether it is safe or not.
 * @param {Plan} plan
 * @param {Walk} walk
 * @param {[number, number]} span
 * @param {Progress} progress
 */
export async function briefed(plan, walk, span, progress) {
  const benches = await benchWalks(plan, walk, span, 0, progress);
  const s = places(walk, ...span);
  const { people, cues, route, survey, event } = plan;
  const near = (/** @type {BenchWalk} */ one) =>
    withArena(walk.engine, (own) => within(own, () => landmarkOf(plan, one, ground)));
  const { points, low, high } = wayOf(walk, s);
  const obstacles = plan.obstacles();
  const edges = obstacles.filter(({ kind }) => kind === "venue").map(({ outline }) => outline);
  const ground = Ground.measured(ownPeg(plan, walk.route), survey.crs !== null, edges);
  const ends = s.map((at) => endsOf(walk, at));
  return {
    sha256: plan.sha256,
    title: both(() => plan.title(language())),
    benches,
    landmarks: both(() => benches.map(near)),
    chalk: chalkOf(plan, walk, span, s[0], ground),
    venue: edges[0] ?? [],
    ground,
    start: span[0],
    clock: String(cues.clock),
    people,
    halts: both(() => haltsOf(plan)),
    coiled: route.kind === "spiral-in",
    points,
    ...withArena(walk.engine, (own) => within(own, () => timed(plan, walk, span, ground))),
    beats: countedIn(scoreOf(plan, ...span)),
    end: span[1],
    ways: {
      ...{ low, high, s, ends, entrances: event.places },
      obstacles: obstacles.map((/** @type {Obstacle} */ one) => shown(one, plan)),
    },
  };
}

/** When head and tail pass each place. @param {Plan} plan @param {Walk} walk @param {[number, number]} span @param {Ground} ground */
function timed(plan, walk, span, ground) {
  const [start, end] = span;
  const passings = both(() => timetable(plan, walk, start, end));
  const since = (/** @type {number | null} */ time) => (time === null ? null : time - start);
  const seconds = passings.en.map((/** @type {Passing} */ { head, until, tail }) => {
    const held = head !== null && until !== null && head < until && until < end;
    return [head, held ? until : null, tail].map(since);
  });
  const told = both(() => timetableText(plan, walk, span, ground, passings[language()]));
  return { timetable: told, seconds };
}

/** @param {Plan} plan @param {Walk} walk @param {[number, number]} span @param {number[]} starts where handles stand at first, m @param {Ground} ground @returns {ChalkPlan | null} */
function chalkOf(plan, walk, [start, end], starts, ground) {
  const [head, last] = [start, end].map((time) => walk.headPosition(time));
  const high = Math.min(last, walk.route.length);
  const trail = new Trail(walk.route, starts[starts.length - 1], head, high);
  const link = Math.min(...doubles(walk.dragon.links));
  return withArena(walk.engine, (arena) =>
    within(arena, () => chalkPlan(trail, link, ground, plan.chalk.stray, plan.obstacles())),
  );
}

/** The route from where the tail starts to where the head ends. @param {Walk} walk @param {number[][]} s */
function wayOf({ route }, s) {
  const low = s.flat().reduce((least, one) => Math.min(least, one));
  const high = s.flat().reduce((most, one) => Math.max(most, one));
  const count = Math.min(Math.max(Math.ceil((high - low) / APART), 2), MOST_POINTS);
  const found = route.evaluate(linspace(low, high, count));
  return { low, high, points: found.filter((_number, i) => i % 4 < 2) };
}

/** x, y, m, and heading, rad, of front handles. @param {Walk} walk @param {number[]} s */
function endsOf({ route }, s) {
  const found = route.evaluate(s.slice(0, -1));
  return s.slice(0, -1).flatMap((_s, k) => [...found.subarray(4 * k, 4 * k + 3)]);
}

/** @param {Obstacle} obstacle @param {Plan} plan */
function shown(obstacle, plan) {
  const { kind, outline, radius } = obstacle;
  const left = kind === "venue" ? edgeLeft(plan) : [];
  return { kind, points: outline, left, radius, shown: both(() => shownName(obstacle)) };
}
