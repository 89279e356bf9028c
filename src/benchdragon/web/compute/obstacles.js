// Benches and the square: when one first touches an obstacle, and the least distance kept to each. The
// engine's question of kernels/obstacle_question.py, asked by the page. Twin of analysis/obstacles.py and
// analysis/obstacle_search.py.

import { Obstacle } from "../made/obstacle.js";
import { _ } from "../words.js";
import { answered, now } from "./answer.js";
import { doubles, withArena } from "./arena.js";
import { within } from "./arrays.js";
import {
  ANALYSIS_CONTACT_SEARCH,
  ANALYSIS_OBSTACLE_SEARCH,
  BESIDE,
  BESIDE_SEARCH,
  QUESTION,
  SEARCH,
  WALK_SEARCH,
} from "./constants.js";
import { TOLERANCES, assumedWithin, inOrder, refined } from "./contact_search.js";
import { FEATURES } from "./distance.js";
import { EngineQuestion } from "./engine_question.js";
import { UnsureError } from "./errors.js";
import { HeadTimes } from "../made/head_times.js";
import { evenly } from "./lists.js";
import { checkedOff, originOf, seenFrom } from "./nearby.js";
import { general } from "./number_format.js";
import { returns } from "./rounds.js";
import { silent } from "./tick.js";

/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./answer.js").Witness} Witness */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */
/** Of what was found, by columns of kernels/beside.py. @typedef {ArrayLike<number>} Found */

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

const { SAMPLES, NARROW } = ANALYSIS_OBSTACLE_SEARCH;
const { MOST_EVALUATIONS, MOST_LEAST_EVALUATIONS, SLACK, WIDTH } = ANALYSIS_CONTACT_SEARCH;

/** The parts of a walk's route that lead back to where it was, as the engine takes them. @param {Arena} arena @param {Walk} walk */
function repeatsOf(arena, { dragon, route }) {
  const view = doubles(dragon.sizes);
  const reaches = dragon.link.map((_link, i) => Math.hypot(view[i], view[dragon.benches + i]));
  return returns(arena, route.rows, Math.max(...reaches));
}

/** A search of a walk from one time to another, s, for what comes near one obstacle. */
export class ObstacleSearch extends EngineQuestion {
  /**
   * @param {Walk} walk
   * @param {Obstacle} obstacle
   * @param {number} start @param {number} end s; the dragon must be able to stand at both
   * @param {Progress} progress is told that it goes on
   */
  constructor(walk, obstacle, start, end, progress) {
    inOrder(start, end);
    const began = now();
    /** Head positions, m. @type {[number, number]} */
    const heads = [walk.headPosition(start), walk.headPosition(end)];
    const origin = withArena(walk.engine, (arena) => originOf(walk.placement(arena, heads)));
    super(
      walk.engine,
      "bd_obstacle_question_*_obstacle",
      (arena, open) => {
        const near = seenFrom(arena, walk, origin);
        const told = {
          [BESIDE.SORT]: obstacle.sort,
          [BESIDE.RADIUS]: obstacle.radius,
          [BESIDE.MARGIN]: obstacle.margin,
          [BESIDE.HEAD_FIRST]: heads[0],
          [BESIDE.HEAD_LAST]: heads[1],
          [BESIDE.LEAST_OFF]: SLACK,
          [BESIDE.WIDTH]: WIDTH,
          [BESIDE.MOST]: MOST_EVALUATIONS,
          [BESIDE.MOST_LEAST]: MOST_LEAST_EVALUATIONS,
        };
        const { links, sizes } = walk.dragon;
        const outline = obstacle.corners(arena, origin);
        const asked = arena.vector(Object.values(told)); // in the order of their columns
        return open(near.route.rows, links, sizes, outline, repeatsOf(arena, near), asked);
      },
      [[BESIDE.FIGURES]],
    );
    this.walk = walk;
    this.obstacle = obstacle;
    this.heads = heads;
    this.origin = origin;
    this.times = new HeadTimes(walk, heads[0], start, end);
    this.progress = progress;
    this.began = began;
    this.evaluations = 0;
  }

  /** When a bench first surely comes nearer than it may, or a graze if none does; null if neither. */
  async touch() {
    const row = await this.#found(SEARCH.FIRST_TOUCH, 0);
    if (row === null) return null;
    const sure = row[BESIDE.SURE] ? "found" : "undecided";
    const [value, early, late, status] = withArena(this.engine, (arena) =>
      within(arena, () => this.times.told(row[BESIDE.LOW_END], row[BESIDE.HIGH_END], sure)),
    );
    const grazed = status === "found" && late - early > NARROW; // then it surely touches at the end
    return answered(grazed ? late : value, early, late, "s", { status, ...this.#told(row) });
  }

  /** The least distance, m, in a bracket as wide as the first of `tolerances`, m, that can be. @param {number[]} tolerances */
  async leastDistance(tolerances) {
    for (const [n, tolerance] of tolerances.entries()) {
      const row = await refined(n, () => this.#found(SEARCH.LEAST, tolerance));
      if (row && this.numbers(0)[BESIDE.CLOSED_IN]) return this.#distance(row);
    }
    return this.#distance(/** @type {Found} */ (await this.#found(SEARCH.LEAST, Infinity)));
  }

  /** The last row of what is sought: see kernels/beside.py. @param {number} goal @param {number} narrow m @returns {Promise<Found | null>} */
  async #found(goal, narrow) {
    this.call("seek", this.handle, goal, narrow);
    let ending = await this.step();
    for (; ending === QUESTION.MORE; ending = await this.step()) this.progress(0, "");
    if (ending === WALK_SEARCH.ASTRAY) throw this.#stopped();
    if (ending === BESIDE_SEARCH.TOO_OFTEN) {
      const values = { name: this.obstacle.name };
      throw new UnsureError(
        _("benches come within rounding of {name} too often to be followed on", values),
      );
    }
    const figures = this.numbers(0);
    this.evaluations = figures[BESIDE.MADE];
    if (ending === BESIDE_SEARCH.TOO_FAR_OFF) checkedOff(figures[BESIDE.ABOUT]);
    const count = figures[BESIDE.COUNT];
    if (!count) return null;
    return withArena(this.engine, (arena) => {
      const row = arena.array("d", 1, BESIDE.FOUND_COLUMNS);
      this.engine.call("bd_obstacle_question_read_found", this.handle, count - 1, row);
      return doubles(row).slice();
    });
  }

  /** Why a bench could not be followed past the end of what its search had shown. */
  #stopped() {
    const error = this.walk.firstFailure(evenly(...this.heads, SAMPLES));
    const values = { s: general(this.numbers(0)[BESIDE.SOUND]) };
    return (
      error ??
      new UnsureError(
        _("past s = {s} m it could not be shown that every bench follows without a leap", values),
      )
    );
  }

  /** @param {Found} row */
  #distance(row) {
    const ends = [BESIDE.VALUE, BESIDE.LOW_END, BESIDE.HIGH_END].map((column) => row[column]);
    return answered(ends[0], ends[1], ends[2], "m", this.#told(row));
  }

  /** What an answer rests on, what it took, and how a bench then stands to the obstacle. @param {Found} row */
  #told(row) {
    const assumptions = assumedWithin(this.numbers(0)[BESIDE.ABOUT]);
    const [witness, seconds] = [this.#witness(row), now() - this.began];
    return { witness, assumptions, evaluations: this.evaluations, seconds };
  }

  /**
   * How a bench stands to the obstacle. Where it stands wholly inside of one the gap is minus the distance;
   * of a bench outside of the venue the point is the corner that is farthest out, the gap minus how far.
   * @param {Found} row
   * @returns {Witness}
   */
  #witness(row) {
    const [s, gap, bench] = [row[BESIDE.HEAD], row[BESIDE.GAP], row[BESIDE.WHO] + 1];
    if (Number.isNaN(gap)) throw this.#stopped();
    return {
      time: this.times.at(s),
      s,
      benches: [bench],
      point: [row[BESIDE.AT_X] + this.origin[0], row[BESIDE.AT_Y] + this.origin[1]],
      gap,
      features: [[bench, FEATURES[row[BESIDE.FEATURE]]]],
      handle: null,
      obstacle: this.obstacle.name,
    };
  }
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
  const search = new ObstacleSearch(walk, obstacle, start, end, progress);
  return search.leastDistance(tolerances).finally(() => search.free());
}

/**
 * When a bench first comes nearer to an obstacle than it may, from start to end, s; null if none does.
 * @param {Walk} walk
 * @param {Obstacle} obstacle
 * @param {number} start @param {number} end
 * @param {Progress} progress
 */
export function touched(walk, obstacle, start, end, progress) {
  const search = new ObstacleSearch(walk, obstacle, start, end, progress);
  return search.touch().finally(() => search.free());
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
  const contact = await touched(walk, obstacle, start, end, progress);
  const near = contact?.witness ?? null;
  if (distance.value > 0 || near === null || near.gap <= 0)
    return { obstacle, contact, distance, touch: null };
  const bare = withMargin(obstacle, 0);
  return { obstacle, contact, distance, touch: await touched(walk, bare, start, end, progress) };
}

/** The same obstacle from which benches keep another distance, m. @param {Obstacle} obstacle @param {number} margin */
export function withMargin({ name, kind, outline, radius }, margin) {
  return new Obstacle(name, kind, outline, radius, margin);
}
