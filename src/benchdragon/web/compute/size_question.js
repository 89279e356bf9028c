// The engine's question about a size of a plan: kernels/size_question.py, asked by the page. Twin of
// solve/size_question.py.

import { _ } from "../words.js";
import { withArena } from "./arena.js";
import { memory } from "./budget.js";
import {
  ANALYSIS_CONTACT_SEARCH,
  QUESTION,
  SIZE_BRACKET,
  SIZE_MEMORY,
  SIZE_QUESTION,
  SIZE_SEARCH,
  SOLVE_SIZE_QUESTION,
} from "./constants.js";
import { EngineQuestion } from "./engine_question.js";
import { InputError, PlanError, UnsureError, WalkError } from "./errors.js";
import { originOf } from "./nearby.js";
import { general } from "./number_format.js";
import { ObstacleSearch } from "./obstacles.js";
import { TOLERANCE, kernelFamily } from "./size_family.js";
import { beginnings, inColumns } from "./tables.js";
import { silent } from "./tick.js";

/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./size_family.js").Meeting} Meeting */
/** @typedef {import("./size_family.js").PlanFamily} PlanFamily */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */

const { MOST_EVALUATIONS, SLACK, WIDTH } = ANALYSIS_CONTACT_SEARCH;
const { FAILS, UNDECIDED } = SIZE_BRACKET;
const { MOST_WIDENINGS } = SOLVE_SIZE_QUESTION;
const MEETING = 4; // numbers of one

/** Sizes are tried to so many times the plan's own where there are obstacles. */
export const { FAR } = SOLVE_SIZE_QUESTION;

/** What the engine is told of a question about a family, whose plan's own walk goes so far, m. @param {PlanFamily} family @param {Walk} walk @param {number} first @param {number} last */
function limitsOf({ engine, margin, question, tolerance }, walk, first, last) {
  const [x, y] = withArena(engine, (arena) =>
    originOf(walk.placement(arena, [first], { throws: false })),
  );
  return inColumns([
    [SIZE_MEMORY.MARGIN, margin],
    [SIZE_MEMORY.LEAST_OFF, SLACK],
    [SIZE_MEMORY.WIDTH, WIDTH],
    [SIZE_MEMORY.MOST, MOST_EVALUATIONS],
    [SIZE_MEMORY.ORIGIN_X, x],
    [SIZE_MEMORY.ORIGIN_Y, y],
    [SIZE_MEMORY.BYTES, memory()],
    [SIZE_MEMORY.SAFER, question.sense],
    [SIZE_MEMORY.NARROW, Math.max(TOLERANCE, tolerance)],
    [SIZE_MEMORY.BEGIN, first],
    [SIZE_MEMORY.END, Math.max(first, last)],
  ]);
}

/** A question about a size of a plan, open until it is freed. */
export class SizeQuestion extends EngineQuestion {
  /**
   * @param {PlanFamily} family the walks among which a size is sought
   * @param {Progress} progress is told what is being tried
   */
  constructor(family, progress) {
    const { walk, start, end } = family.walk(family.first);
    const limits = limitsOf(family, walk, walk.headPosition(start), walk.headPosition(end));
    super(
      family.engine,
      "bd_size_question_*_size",
      (arena, open) => {
        const made = kernelFamily(arena, family, walk);
        return open(made.family, made.walk, arena.vector(limits), arena.whole(beginnings()));
      },
      [
        [SIZE_MEMORY.FIGURES],
        [SIZE_BRACKET.STATE],
        [SIZE_BRACKET.MOST_TRIALS + SIZE_BRACKET.MOST_GROWTHS],
        [SIZE_SEARCH.MEETINGS, MEETING],
      ],
    );
    this.plans = family;
    this.progress = progress;
    /** Chains placed beside obstacles. */
    this.marched = 0;
    this.obstacles = family.plan.obstacles();
    /** The last size that failed by an obstacle alone, m, and when a bench came as near as it may.
     * @type {{ size: number, touch: Answer } | null} */
    this.blocked = null;
  }

  /** A number of the state: a column of kernels/size_bracket.py. @param {number} column */
  stateAt(column) {
    return this.numbers(1)[column];
  }

  /** Chains placed in searches of walks. */
  get evaluations() {
    return this.marched + this.numbers(0)[SIZE_MEMORY.MARCHED];
  }

  /** The sizes that were tried and could not be decided, m. */
  get doubts() {
    return Array.from(this.numbers(2).subarray(0, this.stateAt(SIZE_BRACKET.DOUBTS)));
  }

  /** Whether such sizes lie in the bracket. */
  get inDoubt() {
    const [good, bad] = [this.stateAt(SIZE_BRACKET.GOOD), this.stateAt(SIZE_BRACKET.BAD)];
    const [low, high] = [Math.min(good, bad), Math.max(good, bad)];
    return this.doubts.some((size) => low < size && size < high);
  }

  /** The pair that decides, or was last gone by. @returns {Meeting | null} */
  get guide() {
    const at = MEETING * SIZE_SEARCH.GUIDE;
    const [s, rest, i, j] = this.numbers(3).subarray(at, at + MEETING);
    return i === SIZE_SEARCH.NOBODY ? null : { s, left: rest, i, j };
  }

  /** Seek the limit next to the first size that passes, from `size` on; how that ended. @param {number} size */
  limit(size) {
    return this.#sought(SIZE_SEARCH.GROW, size);
  }

  /**
   * The last size that passes from one that does towards one that does not; whether the border is there.
   * @param {number} good @param {number} bad
   */
  async border(good, bad) {
    const ending = await this.#sought(SIZE_SEARCH.BORDER, bad, good);
    const found = ending === SIZE_SEARCH.FOUND && !this.inDoubt;
    return { size: this.stateAt(SIZE_BRACKET.GOOD), found };
  }

  /** How the walk of a size goes: one that is too long to be searched is undecided too. @param {number} size */
  async trial(size) {
    await this.#sought(SIZE_QUESTION.ALONE, size);
    return this.numbers(0)[SIZE_MEMORY.RESULT];
  }

  /** Let the engine step until it has what is sought; how that ended. @param {number} stage @param {number} size @param {number} [good] */
  async #sought(stage, size, good = NaN) {
    this.call("seek", this.handle, stage, size, good);
    for (let known = SIZE_QUESTION.UNKNOWN; ;) {
      const ending = await this.step(known);
      if (ending === SIZE_SEARCH.WALK) known = await this.#known(this.stateAt(SIZE_BRACKET.NOW));
      else if (ending !== QUESTION.MORE) return ending;
    }
  }

  /** What is known of the walk of a size without the engine: that it fails, or nothing. @param {number} size */
  async #known(size) {
    this.progress(0, `${general(size, 9)} m`);
    try {
      return (await this.#isBlocked(size)) ? FAILS : SIZE_QUESTION.UNKNOWN;
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
        const search = new ObstacleSearch(walk, obstacle, start, end, silent);
        const touch = await search.touch().finally(() => search.free());
        this.marched += search.evaluations;
        if (touch === null) continue;
        this.blocked = { size, touch };
        return true;
      }
    } catch (error) {
      // There is no such walk, or benches cannot follow: the engine finds out.
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
}
