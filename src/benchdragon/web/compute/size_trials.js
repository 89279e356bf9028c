// The kernels' search for the size that a plan may have: what they ask for is done here. Twin of
// solve/size_trials.py.

import { _ } from "../words.js";
import { Arena, doubles, withArena, withArenaAsync } from "./arena.js";
import {
  ANALYSIS_CONTACT_SEARCH,
  ANALYSIS_DISTANCE,
  ANALYSIS_TABLES,
  BOX,
  COURSE,
  CURVE,
  LOW_POINTS,
  ROUTE,
  SEARCH,
  SIZE_BRACKET,
  SIZE_SEARCH,
  SOLVE_SIZE_TRIALS,
  SPIRAL,
  WALK_SEARCH,
} from "./constants.js";
import { runSearch } from "./contact_search.js";
import { pairwiseSum } from "./dragon.js";
import { InputError, PlanError, UnsureError, WalkError } from "./errors.js";
import { firstRows } from "./lists.js";
import { checkedOff, isNowhere, originOf, seamsOf } from "./nearby.js";
import { general } from "./number_format.js";
import { ObstacleSearch } from "./obstacle_search.js";
import { touching } from "./obstacles.js";
import { TOLERANCE, kernelFamily, windowsOf } from "./size_family.js";
import { Tables } from "./tables.js";
import { silent, tick } from "./tick.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./size_family.js").Meeting} Meeting */
/** @typedef {import("./size_family.js").PlanFamily} PlanFamily */
/** @typedef {import("./tables.js").WalkTables} WalkTables */
/** @typedef {import("./tick.js").Progress} Progress */
/** The rows of a walk's route, none if there is no such walk, and between which it goes, m. @typedef {{ rows: Numbers, first: number, last: number }} SizedWalk */

const { MOST_EVALUATIONS, SLACK, WIDTH } = ANALYSIS_CONTACT_SEARCH;
const { PASSES, FAILS, UNDECIDED } = SIZE_BRACKET;
const { MOST_WIDENINGS, FEWEST } = SOLVE_SIZE_TRIALS;
const MEETING = 4; // numbers of one

/** Sizes are tried to so many times the plan's own where there are obstacles. */
export const { FAR } = SOLVE_SIZE_TRIALS;

/** A search for a size of a plan: its memory, and what the kernels ask for done by other kernels. */
export class SizeSearch {
  /**
   * @param {PlanFamily} family the walks among which a size is sought
   * @param {Progress} progress is told what is being tried
   */
  constructor(family, progress) {
    this.engine = family.engine;
    this.plans = family;
    this.progress = progress;
    this.margin = family.margin;
    /** Chains placed in searches of walks. */
    this.evaluations = 0;
    this.obstacles = family.plan.obstacles();
    /** The last size that failed by an obstacle alone, m, and when a bench came as near as it may.
     * @type {{ size: number, touch: Answer } | null} */
    this.blocked = null;
    const { walk, start, end } = family.walk(family.first);
    const [first, last] = [walk.headPosition(start), walk.headPosition(end)];
    /** @type {[number, number]} */
    this.ends = [first, Math.max(first, last)];
    this.origin = withArena(this.engine, (arena) =>
      originOf(walk.placement(arena, [first], { throws: false })),
    );
    this.arena = new Arena(this.engine);
    const made = kernelFamily(this.arena, family, walk);
    this.family = made.family;
    this.walk = made.walk;
    this.tables = this.#madeTables();
    this.state = this.arena.full([SIZE_BRACKET.STATE], 0);
    this.doubtful = this.arena.array("d", SIZE_BRACKET.MOST_TRIALS + SIZE_BRACKET.MOST_GROWTHS);
    this.meetings = this.arena.full([SIZE_SEARCH.MEETINGS, MEETING], SIZE_SEARCH.NOBODY);
    const handles = walk.dragon.benches + 1;
    const slots = Math.max(
      FEWEST,
      Math.min(SPIRAL.LANES, Math.floor(ANALYSIS_TABLES.PLACES / handles)),
    );
    this.at = this.arena.array("d", slots);
    this.places = this.arena.placements(handles, slots);
    this.boxes = this.arena.array("d", 2, BOX.BOX_COLUMNS);
  }

  /** Room for searches of walks as long as that of the plan; others widen it. */
  #madeTables() {
    const tail = this.ends[0] - 1.5 * pairwiseSum(doubles(this.walk.benches.links));
    return new Tables(this.engine, this.walk, ...this.ends, this.margin + SLACK, tail);
  }

  /** Give all back. */
  free() {
    this.tables.free();
    this.arena.free();
    this.plans.free();
  }

  /** A number of the state: a column of kernels/size_bracket.py. @param {number} column */
  told(column) {
    return doubles(this.state)[column];
  }

  /** The sizes that were tried and could not be decided, m. */
  get doubts() {
    return Array.from(doubles(this.doubtful).subarray(0, this.told(SIZE_BRACKET.DOUBTS)));
  }

  /** Whether such sizes lie in the bracket. */
  get inDoubt() {
    const [good, bad] = [this.told(SIZE_BRACKET.GOOD), this.told(SIZE_BRACKET.BAD)];
    const [low, high] = [Math.min(good, bad), Math.max(good, bad)];
    return this.doubts.some((size) => low < size && size < high);
  }

  /** The pair that decides, or was last gone by. */
  get guide() {
    return this.#meeting(SIZE_SEARCH.GUIDE);
  }

  /** @param {number} row @returns {Meeting | null} */
  #meeting(row) {
    const at = MEETING * row;
    const [s, left, i, j] = doubles(this.meetings).subarray(at, at + MEETING);
    return i === SIZE_SEARCH.NOBODY ? null : { s, left, i, j };
  }

  /** @param {number} row @param {number[]} numbers the first of a meeting's */
  #meet(row, ...numbers) {
    doubles(this.meetings).set(numbers, MEETING * row);
  }

  /** Seek the limit next to the first size that passes, from `size` on; how that ended. @param {number} size */
  limit(size) {
    this.#open(SIZE_SEARCH.GROW, size);
    return this.#sought();
  }

  /**
   * The last size that passes from one that does towards one that does not; whether the border is there.
   * @param {number} good @param {number} bad
   */
  async border(good, bad) {
    this.#open(SIZE_SEARCH.BORDER, bad);
    const state = doubles(this.state);
    [state[SIZE_BRACKET.GOOD], state[SIZE_BRACKET.BAD], state[SIZE_BRACKET.TRIED]] = [good, bad, 1];
    const found = (await this.#sought()) === SIZE_SEARCH.FOUND && !this.inDoubt;
    return { size: this.told(SIZE_BRACKET.GOOD), found };
  }

  /** @param {number} stage @param {number} size */
  #open(stage, size) {
    const state = doubles(this.state).fill(0);
    const { question, tolerance } = this.plans;
    state[SIZE_BRACKET.SENSE] = question.sense;
    state[SIZE_BRACKET.TOLERANCE] = Math.max(TOLERANCE, tolerance);
    state[SIZE_BRACKET.SLACK] = SLACK;
    state[SIZE_BRACKET.CAUTION] = SIZE_BRACKET.FIRST_CAUTION;
    state[SIZE_BRACKET.STAGE] = stage;
    state[SIZE_BRACKET.SIZE] = size;
    const meetings = doubles(this.meetings);
    for (let row = 0; row < SIZE_SEARCH.MEETINGS; row++)
      meetings[MEETING * row + SIZE_SEARCH.MEET_FRONT] = SIZE_SEARCH.NOBODY;
  }

  /** Do what the kernels ask for until they have what they seek; how that ended. */
  async #sought() {
    for (let value = 0; ;) {
      const [asked] = this.engine.call(
        "bd_size_search_next_task", this.state, this.doubtful, this.meetings, value,
      ); // prettier-ignore
      const size = this.told(SIZE_BRACKET.NOW);
      if (asked === SIZE_SEARCH.WALK) value = await this.trial(size);
      else if (asked === SIZE_SEARCH.LOW_PAIR) value = this.#lowPair(size);
      else if (asked === SIZE_SEARCH.DISTANCE) value = this.#distance(size);
      else return asked;
      await tick();
    }
  }

  /** @param {number} size @returns {SizedWalk} */
  #walkOf(size) {
    const [count, first, last] = this.engine.call(
      "bd_family_set_walk", this.family, this.walk, this.at, this.places, size,
    ); // prettier-ignore
    if (count >= 0) {
      const rows = firstRows(this.walk.rows, count);
      if (!isNowhere(this.origin) && count)
        this.engine.call("bd_route_parts_settle_rows", rows, ...this.origin);
      return { rows, first, last };
    }
    this.arena.drop(this.walk.rows);
    this.walk = { ...this.walk, rows: this.arena.full([-count, CURVE.COLUMNS], 0) };
    this.tables.free();
    this.tables = this.#madeTables();
    return this.#walkOf(size);
  }

  /** Fill GUIDE with a pair that comes near in the walk of a size; how near less the margin, m. @param {number} size */
  #lowPair(size) {
    const { rows, first, last } = this.#walkOf(size);
    const { kind, links, sizes } = this.walk.benches;
    if (!rows.size || kind.size < 3 || kind.size > ANALYSIS_DISTANCE.MOST_SAMPLED) return Infinity;
    const [least, s, i, j] = this.engine.call(
      "bd_low_points_low_pair", rows, links, sizes, first, last, this.at, this.places, this.boxes,
    ); // prettier-ignore
    this.#meet(SIZE_SEARCH.GUIDE, s, last - s, i, j);
    return least - this.margin;
  }

  /** How near the ROOTED pair comes by its meeting in the walk of a size, less the margin, m. @param {number} size */
  #distance(size) {
    const { rows, first, last } = this.#walkOf(size);
    const meeting = this.#meeting(SIZE_SEARCH.ROOTED);
    if (!rows.size || meeting === null) return NaN;
    const { links, sizes } = this.walk.benches;
    let [least, where] = [Infinity, Infinity];
    for (const [low, high] of windowsOf(meeting, doubles(links), first, last)) {
      const [distance, s] = this.engine.call(
        "bd_low_points_low_point", rows, links, sizes, meeting.i, meeting.j, low, high,
        LOW_POINTS.SHRINKS, this.at, this.places, this.boxes,
      ); // prettier-ignore
      if (distance < least || (distance === least && s < where)) [least, where] = [distance, s];
    }
    this.#meet(SIZE_SEARCH.ROOTED, where, last - where);
    return Number.isFinite(least) ? least - this.margin : NaN;
  }

  /** How the walk of a size goes: one that is too long to be searched is undecided too. @param {number} size */
  async trial(size) {
    this.progress(0, `${general(size, 9)} m`);
    try {
      return (await this.#isBlocked(size)) ? this.#failedAlone() : await this.#tried(size);
    } catch (error) {
      if (error instanceof UnsureError) return UNDECIDED;
      throw error;
    }
  }

  /**
   * Whether a bench comes nearer to an obstacle than it may in the walk of a size, or within rounding of
   * that. Sizes over FAR times the plan's own, or below that share of it, are taken for blocked.
   * @param {number} size
   */
  async #isBlocked(size) {
    if (!this.obstacles.length) return false;
    const times = size / this.plans.first;
    if (!(1 / FAR <= times && times <= FAR)) return true;
    try {
      const { walk, start, end } = this.plans.walk(size);
      for (const obstacle of this.obstacles) {
        const found = await withArenaAsync(this.engine, async (arena) => {
          const search = new ObstacleSearch(arena, walk, obstacle, start, end, silent);
          const touches = await touching(search);
          this.evaluations += search.evaluations;
          return touches;
        });
        if (!found.length) continue;
        this.blocked = { size, touch: found[found.length - 1] };
        return true;
      }
    } catch (error) {
      // There is no such walk, or benches cannot follow: `#tried` finds out.
      if (![InputError, PlanError, WalkError].some((kind) => error instanceof kind)) throw error;
    }
    return false;
  }

  /** The size of a bracket that does not pass; beyond one within rounding of an obstacle. @param {number} good @param {number} bad */
  async surelyBad(good, bad) {
    for (let widening = 0; widening < MOST_WIDENINGS; widening++) {
      const { blocked } = this;
      if (blocked === null || blocked.size !== bad || blocked.touch.status === "found") return bad;
      bad += 2 * (bad - good);
      if ((await this.trial(bad)) !== FAILS) break;
    }
    throw new UnsureError(_("the bracket could not be established beside an obstacle"));
  }

  /** @param {number} size */
  async #tried(size) {
    const { rows, first, last } = this.#walkOf(size);
    if (!rows.size) return this.#failedAlone();
    doubles(this.at)[0] = first;
    const { links } = this.walk.benches;
    const [stands] = this.engine.call(
      "bd_step_bounds_place_chain", rows, links, this.at, 0, 1, this.places,
    ); // prettier-ignore
    if (!stands) return this.#failedAlone();
    if (first === last) return this.#standing(rows, first);
    this.tables.aim({ ...this.walk, rows }, first, last, this.margin + SLACK);
    this.tables.begin();
    return this.#searched(last);
  }

  /** That a walk fails in which no two benches met. */
  #failedAlone() {
    doubles(this.meetings)[MEETING * SIZE_SEARCH.FAILED + SIZE_SEARCH.MEET_FRONT] = SIZE_SEARCH.NOBODY;
    return FAILS;
  }

  /** How a dragon that stands still passes, which is placed in the first slot. @param {Numbers} rows @param {number} s */
  #standing(rows, s) {
    return withArena(this.engine, (arena) => {
      const [x, y] = [this.places.x, this.places.y].map((table) => {
        const [handles, slots] = table.shape;
        const column = arena.array("d", handles, 1);
        const [from, to] = [doubles(table), doubles(column)];
        for (let n = 0; n < handles; n++) to[n] = from[n * slots];
        return column;
      });
      const { links, sizes } = this.walk.benches;
      const [apart, , i, j] = this.engine.call("bd_box_nearest_pair", sizes, x, y);
      const [errors, lanes] = [links.size + 1, links.size].map((size) => arena.array("d", size));
      const off = arena.array("d", links.size);
      this.engine.call(
        "bd_rounding_bench_errors", rows, links, sizes, seamsOf(arena, rows), this.places, 0, -1, lanes,
        errors, off,
      ); // prettier-ignore
      if (apart > this.margin - Math.max(SLACK, doubles(off)[i] + doubles(off)[j])) return PASSES;
      this.#meet(SIZE_SEARCH.FAILED, s, 0, i, j);
      return FAILS;
    });
  }

  /** How the walk goes for which the tables are made. @param {number} last m */
  async #searched(last) {
    return withArenaAsync(this.engine, async (arena) => {
      const { tables } = this;
      const noted = arena.full([SEARCH.NOTES], 0);
      /** @type {import("./contact_search.js").Limits} */
      const limits = [this.margin, SLACK, WIDTH, MOST_EVALUATIONS];
      const tell = () => {};
      const ending = await runSearch(tables, SEARCH.FIRST_TOUCH, limits, noted, tell);
      const note = doubles(noted);
      const state = doubles(this.state);
      state[SIZE_BRACKET.SLACK] = Math.max(state[SIZE_BRACKET.SLACK], checkedOff(note[SEARCH.OFF]));
      this.evaluations += note[SEARCH.EVALUATIONS];
      if (ending === SEARCH.CLEAR) {
        const length = endOf(tables.walk.rows);
        return last > length + ROUTE.END_SLACK ? this.#failedAlone() : PASSES;
      }
      if (ending === WALK_SEARCH.ASTRAY || ending === SEARCH.FALLEN) return this.#fallen(ending, note);
      const count = this.walk.benches.kind.size;
      const j = note[SEARCH.PAIR] % count;
      const s = note[SEARCH.UPPER];
      this.#meet(SIZE_SEARCH.FAILED, s, last - s, (note[SEARCH.PAIR] - j) / count, j);
      return FAILS;
    });
  }

  /** What a walk comes to that could not be searched further. @param {number} ending @param {Float64Array} note */
  #fallen(ending, note) {
    const { tables } = this;
    const known = Math.min(tables.way(COURSE.AT), tables.way(COURSE.SOUND));
    const sound = ending === SEARCH.FALLEN ? note[SEARCH.LOWER] : known;
    const [falls] = this.engine.call(
      "bd_family_falls_soon", tables.walk.rows, this.walk.benches.links, sound, this.at, this.places,
    ); // prettier-ignore
    return falls ? this.#failedAlone() : UNDECIDED;
  }
}

/** The length of a route of these rows, m. @param {Numbers} rows */
function endOf(rows) {
  const view = doubles(rows);
  const last = view.length - CURVE.COLUMNS;
  return view[last + CURVE.S_START] + view[last + CURVE.LENGTH];
}
