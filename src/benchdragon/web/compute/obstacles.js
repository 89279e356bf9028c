// Benches and the square: when one first touches an obstacle, and the least distance kept to each. Twin of
// analysis/obstacles.py.

import { answered } from "./answer.js";
import { doubles, withArena, withArenaAsync } from "./arena.js";
import { SEARCH } from "./constants.js";
import { TOLERANCES, refined, upperEnd } from "./contact.js";
import { Obstacle } from "./obstacle.js";
import { ObstacleSearch } from "./obstacle_search.js";
import { silent } from "./tick.js";

/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */

/**
 * What was found about an obstacle, or the venue's edge, over a span of a walk.
 * @typedef {object} ObstacleAnswers
 * @property {Obstacle} obstacle which
 * @property {Answer | null} contact when a bench first touches it, leaves the venue, or comes nearer than
 *   the margin
 * @property {Answer} distance the least that benches keep from it, m; 0 where one touches it
 * @property {Answer | null} touch when a bench first touches it or leaves the venue, where `contact`
 *   speaks of the margin
 */

/** The head positions between which a bench (row, from 0) comes to touch, m. @typedef {{ lower: number, upper: number, bench: number }} Come */

/**
 * The least distance seen from the obstacle's boxes, m: by a bench of size k with its handle at s; or,
 * where k is -1, by bench number s as the dragon stands at the start.
 * @typedef {{ distance: number, k: number, s: number }} Nearest
 */

/**
 * When a bench first comes nearer to the obstacle than it may: empty if none does.
 *
 * The last is sure; those before it are grazes that rounding leaves open, "undecided". All is clear up to
 * the lower end of the first.
 * @param {ObstacleSearch} search
 * @returns {Promise<Answer[]>}
 */
export async function touching(search) {
  const { apart, bench } = search.atStart;
  const [head, last] = search.heads;
  const off = search.offAtStart;
  if (apart <= search.reach - off) {
    search.noteOff(off);
    return [search.answer(head, head, "found", bench)];
  }
  if (apart <= search.reach + off && head === last)
    return [search.answer(head, head, "undecided", bench)];
  const { grazes, sure } = await comes(search);
  const clear = sure.reduce((least, { lower }) => Math.min(least, lower), Infinity);
  const before = grazes.filter(({ lower }) => lower < clear);
  before.sort((a, b) => a.lower - b.lower || a.upper - b.upper || a.bench - b.bench);
  const answers = before.map((one) => search.answer(one.lower, one.upper, "undecided", one.bench));
  if (sure.length) {
    const soonest = sure.reduce((first, one) => (one.upper < first.upper ? one : first));
    answers.push(search.answer(clear, soonest.upper, "found", soonest.bench));
  }
  return answers;
}

/** Where the head is when benches graze and surely touch. @param {ObstacleSearch} search */
async function comes(search) {
  /** @type {Come[]} */
  const grazes = [];
  /** @type {Come[]} */
  const sure = [];
  for (const touch of await search.touches()) {
    const soonest = sure.reduce((least, { upper }) => Math.min(least, upper), Infinity);
    if (soonest < Infinity && touch.lower > frontOf(search, soonest, touch.bench) + search.off)
      continue;
    const [lower, upper] = search.headAt(touch.bench, touch.lower, touch.upper);
    (touch.sure ? sure : grazes).push({ lower, upper, bench: touch.bench });
  }
  return { grazes, sure };
}

/** Route position, m, of a bench's front handle with the head at one. @param {ObstacleSearch} search @param {number} head @param {number} bench */
function frontOf({ walk }, head, bench) {
  return withArena(walk.engine, (arena) => {
    return doubles(walk.placement(arena, [head], { throws: false }).s)[bench];
  });
}

/**
 * The least distance, m, that benches keep from an obstacle from start to end, s; 0 if they touch. Of the
 * venue it is the distance from its edge. The bracket is as wide as the first of `tolerances`, m, or
 * where a bench keeps one distance for a while as one of the others.
 * @param {Walk} walk
 * @param {Obstacle} obstacle
 * @param {number} start @param {number} end
 * @param {{ tolerances: number[], progress: Progress }} options
 */
export function leastDistance(walk, obstacle, start, end, { tolerances, progress }) {
  return searched(walk, obstacle, start, end, progress, async (search) => {
    const { apart, bench } = search.atStart;
    /** @type {Nearest} */
    let best = { distance: apart, k: -1, s: bench };
    const stretches = apart <= obstacle.radius ? [] : search.stretches;
    for (const { k, spans } of stretches) {
      const note = search.note({ [SEARCH.NEAREST]: best.distance });
      search.look(k, spans, note);
      best = nearer(best, k, doubles(note));
    }
    let floor = best.distance;
    for (const [n, tolerance] of tolerances.entries()) {
      const found = await refined(n, () => lowered(search, stretches, best, tolerance));
      if (found !== null) [best, floor] = [found.best, found.floor];
      if (found?.closed || (found && best.distance <= obstacle.radius))
        return distanceAnswer(search, best, floor);
    }
    const last = await lowered(search, stretches, best, Infinity);
    return distanceAnswer(search, last.best, last.floor);
  });
}

/** @param {Nearest} best @param {number} k @param {Float64Array} note @returns {Nearest} */
function nearer(best, k, note) {
  const distance = note[SEARCH.NEAREST];
  return distance < best.distance ? { distance, k, s: note[SEARCH.UPPER] } : best;
}

/**
 * `best`, or what is lower; what nothing is nearer than, m; and whether that was established.
 * @param {ObstacleSearch} search
 * @param {import("./obstacle_search.js").Stretch[]} stretches
 * @param {Nearest} best
 * @param {number} tolerance
 */
async function lowered(search, stretches, best, tolerance) {
  let [floor, closed] = [Infinity, true];
  for (const { k, spans } of stretches) {
    const known = { [SEARCH.NEAREST]: best.distance, [SEARCH.FLOOR]: Infinity, [SEARCH.PAIR]: -1 };
    const note = search.note(known);
    const told = await search.run(k, SEARCH.LEAST, spans, tolerance, note);
    closed &&= told.every(([ending]) => ending === SEARCH.CLEAR);
    best = nearer(best, k, doubles(note));
    floor = Math.min(floor, doubles(note)[SEARCH.FLOOR]);
  }
  return { best, floor: Math.min(floor, best.distance - tolerance), closed };
}

/** @param {ObstacleSearch} search @param {Nearest} best @param {number} floor */
function distanceAnswer(search, best, floor) {
  search.noteOff(search.offAtStart);
  const { off } = search;
  const { radius } = search.obstacle;
  let [bench, [head]] = [best.s, search.heads];
  if (best.k >= 0) {
    bench = search.benchAt(best.k, best.s);
    [, head] = search.headAt(bench, best.s, best.s);
  }
  const gap = best.distance - radius;
  const lower = Math.max(Math.min(floor, best.distance) - radius - off, 0);
  const witness = search.witness(head, bench);
  const upper = upperEnd(gap, off);
  return answered(Math.max(gap, 0), lower, upper, "m", { witness, ...search.told() });
}

/**
 * The least distance that benches keep from an obstacle, and when one comes nearer than it may, from
 * start to end, s. A contact that is sure is told before one that is not.
 * @param {Walk} walk
 * @param {Obstacle} obstacle
 * @param {number} start @param {number} end
 * @param {{ tolerances?: number[], progress?: Progress }} [options] progress is told that it goes on
 * @returns {Promise<ObstacleAnswers>}
 */
export async function obstacleAnswers(
  walk,
  obstacle,
  start,
  end,
  { tolerances = TOLERANCES, progress = silent } = {},
) {
  const distance = await leastDistance(walk, obstacle, start, end, { tolerances, progress });
  if (distance.lower > obstacle.margin) return { obstacle, contact: null, distance, touch: null };
  const answers = await searched(walk, obstacle, start, end, progress, touching);
  const contact = answers[answers.length - 1] ?? null;
  const near = contact?.witness ?? null;
  if (distance.value > 0 || near === null || near.gap <= 0)
    return { obstacle, contact, distance, touch: null };
  const bare = await searched(walk, withMargin(obstacle, 0), start, end, progress, touching);
  return { obstacle, contact, distance, touch: bare[bare.length - 1] ?? null };
}

/** The same obstacle from which benches keep another distance, m. @param {Obstacle} obstacle @param {number} margin */
export function withMargin({ name, kind, outline, radius }, margin) {
  return new Obstacle(name, kind, outline, radius, margin);
}

/**
 * What `use` makes of a search.
 * @template T
 * @param {Walk} walk
 * @param {Obstacle} obstacle
 * @param {number} start @param {number} end s
 * @param {Progress} progress
 * @param {(search: ObstacleSearch) => Promise<T>} use
 */
function searched(walk, obstacle, start, end, progress, use) {
  return withArenaAsync(walk.engine, (arena) =>
    use(new ObstacleSearch(arena, walk, obstacle, start, end, progress)),
  );
}
