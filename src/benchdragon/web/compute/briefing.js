// What the benches' sheets are made from: the plan as it was checked, and what each bench does. Twin of
// sheets/briefing.py.

import { cueName } from "../made/cues.js";
import { named, shownName } from "../made/findings.js";
import { Ground } from "../made/ground.js";
import { benchWalks } from "../made/bench_walks.js";
import { sentence } from "../made/check.js";
import { Trail, among, usualGap } from "../made/marks.js";
import { part } from "../made/stages.js";
import { _, both, language } from "../words.js";
import { copied, rowOf, withArena, withArenaAsync, within } from "./arena.js";
import { check } from "./check.js";
import { BOX } from "./constants.js";
import { InputError } from "./errors.js";
import { linspace } from "./numbers.js";
import { py } from "./python.js";
import { places } from "./walk_facts.js";

/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("../made/bench_walks.js").BenchWalk} BenchWalk */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./questions.js").Asked} Asked */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {import("../messages").Words} Words */
/** @typedef {[number, number]} Point */

/** A landmark, and how far a bench is from it, m, null: the peg; of the venue which edge: see `Landmark` of explain/bench_text.py. @typedef {{ apart: number, name: Words | null, edge: number | null }} Near */

/** A time, s, in which the head stands, and what the plan says it stands for. @typedef {{ start: number, end: number, said: Words }} Halt */

/**
 * The dance as maps show it.
 * @typedef {object} Ways
 * @property {number} low where along the route `points` begin, m
 * @property {number} high and where they end
 * @property {number[][]} s where along the route each front handle is at the start, and at the end, m
 * @property {number[][]} ends x and y there, m, and the heading, rad: one after another at the start, and at the end
 * @property {Array<{ kind: import("./obstacle.js").ObstacleKind, points: Point[], radius: number, shown: Words }>} obstacles
 * @property {Point[]} entrances where people come in, m
 */

/**
 * What sheets are made from. `points` are those of the route, m: x, y, one after another.
 * @typedef {object} Briefing
 * @property {string} sha256 of the plan
 * @property {Words} title
 * @property {Words} verdict a sentence
 * @property {BenchWalk[]} benches the head's first
 * @property {Near[]} landmarks near the place where each starts
 * @property {Array<[number, number] | null>} marks the mark, from 1, at or behind which each starts, and how far, m
 * @property {Ground} ground from which places are told
 * @property {number} start of the dance, s
 * @property {string} clock the time of day then; ""
 * @property {Record<string, any>} people the table of the plan, filled
 * @property {Halt[]} halts
 * @property {boolean} coiled whether the dance ends inside
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
    const report = await check(own, walk, span, { progress: part(progress, 0, 0.3) });
    if (report.findings.length)
      throw new InputError(
        _("Sheets are made of a plan that is safe alone. {verdict}", { verdict: sentence(report) }),
      );
    const told = part(progress, 0.3, 1, _("what each bench does"));
    const facts = await briefed(arena, plan, walk, span, told);
    return { ...facts, verdict: both(() => sentence(report)) };
  });
}

/**
 * The same of any walk over a span, s, whether it is safe or not.
 * @param {Arena} arena
 * @param {Plan} plan
 * @param {Walk} walk
 * @param {[number, number]} span
 * @param {Progress} progress
 */
export async function briefed(arena, plan, walk, span, progress) {
  const benches = await benchWalks(plan, walk, span, 0, progress);
  const s = places(walk, ...span);
  const { people, cues, chalk, route, survey, event } = plan;
  const { points, low, high } = wayOf(walk, s);
  const obstacles = plan.obstacles();
  const edges = obstacles.filter(({ kind }) => kind === "venue").map(({ outline }) => outline);
  const ground = Ground.measured(chalk.peg ?? ownPeg(walk, route.at), survey.crs !== null, edges);
  const ends = s.map((at) => endsOf(walk, at));
  return {
    sha256: plan.sha256,
    title: both(() => plan.title(language())),
    benches,
    landmarks: landmarksOf(arena, obstacles, benches, ground),
    marks: marksOf(walk, span, s[0], chalk.every),
    ground,
    start: span[0],
    clock: String(cues.clock),
    people,
    halts: haltsOf(plan),
    coiled: route.kind === "spiral-in",
    points,
    ways: { low, high, s, ends, obstacles: obstacles.map(shown), entrances: event.entrances },
  };
}

/** @param {Plan} plan @returns {Halt[]} */
function haltsOf(plan) {
  return plan
    .moments()
    .filter(({ cue: { kind, text, text_zh: chinese } }) => {
      return (kind === "hold" || kind === "stop") && (text || chinese);
    })
    .map(({ cue, time, until }) => ({ start: time, end: until, said: both(() => cueName(cue)) }));
}

/** The centre of the route's first spiral, else where the plan puts the route's origin, m. @param {Walk} walk @param {Point | null} at @returns {Point} */
function ownPeg({ route: { centre } }, at) {
  return centre[0] || centre[1] ? centre : (at ?? [0, 0]);
}

/** @param {Walk} walk @param {[number, number]} span @param {number[]} starts where front handles stand at first, m @param {number | null} every m between marks; null: as usual */
function marksOf(walk, [start, end], starts, every) {
  const [head, last] = [start, end].map((time) => walk.headPosition(time));
  const high = Math.min(last, walk.route.length);
  const trail = new Trail(walk.route, starts[starts.length - 1], head, high);
  const places = withArena(walk.engine, (arena) =>
    within(arena, () => py.tolist(trail.marked(trail.every(every))[0])),
  );
  const usual = usualGap(places);
  return starts
    .slice(0, -1)
    .map((s) => /** @type {[number, number] | null} */ (among(places, usual, s)));
}

/** What is nearest to each bench when the dance starts: see `_steps_line` of explain/bench_text.py. @param {Arena} arena @param {Obstacle[]} obstacles @param {BenchWalk[]} benches @param {Ground} ground @returns {Near[]} */
function landmarksOf(arena, obstacles, benches, ground) {
  const [x, y] = ground.peg;
  /** @type {Near[]} */
  const best = benches.map(({ place }) => {
    return { apart: Math.hypot(place[0] - x, place[1] - y), name: null, edge: null };
  });
  const boxes = benches.map(({ box }) => box);
  const table = arena.table(boxes, BOX.BOX_COLUMNS);
  for (const obstacle of obstacles) {
    const found = obstacle.nearest(arena, table);
    const name = both(() => named(obstacle));
    best.forEach((one, k) => {
      const apart = Math.max(found.apart[k] - obstacle.radius, 0);
      if (!(apart < one.apart)) return;
      const venue = obstacle.kind === "venue";
      const edge = venue ? edgeOf(boxes[k], copied(rowOf(found.boxes, found.which[k])), ground) : null;
      best[k] = { apart, name, edge };
    });
  }
  return best;
}

/** Which way out over a side of the venue is nearest: to the right, forward, to the left, back. @param {ArrayLike<number>} box of a bench @param {ArrayLike<number>} side @param {Ground} ground */
function edgeOf(box, side, ground) {
  const out = [side[BOX.UY], -side[BOX.UX]];
  const away = [side[BOX.CX] - box[BOX.CX], side[BOX.CY] - box[BOX.CY]];
  const hand = out[0] * away[0] + out[1] * away[1] < 0 ? -1 : 1;
  return ground.edge([hand * out[0], hand * out[1]]);
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

/** @param {Obstacle} obstacle */
function shown(obstacle) {
  const { kind, outline, radius } = obstacle;
  return { kind, points: outline, radius, shown: both(() => shownName(obstacle)) };
}
