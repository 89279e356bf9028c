// The engine's question about a size of a plan: kernels/size_question.py, asked by the page. Twin of
// solve/size_question.py.

import { _ } from "../words.js";
import { doubles } from "./arena.js";
import { memory } from "./budget.js";
import {
  ANALYSIS_CONTACT_SEARCH,
  FAMILY,
  QUESTION,
  SIZE_BRACKET,
  SIZE_MEMORY,
  SIZE_QUESTION,
  SIZE_SEARCH,
  SOLVE_SIZE_QUESTION,
} from "./constants.js";
import { OwnQuestion } from "./engine_question.js";
import { UnsureError } from "./errors.js";
import { originAt } from "./nearby.js";
import { general } from "./number_format.js";
import { TOLERANCE, kernelFamily } from "./size_family.js";
import { beginnings, inColumns } from "./tables.js";

/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./size_family.js").Meeting} Meeting */
/** @typedef {import("./size_family.js").PlanFamily} PlanFamily */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */

const { MOST_EVALUATIONS, SLACK, WIDTH } = ANALYSIS_CONTACT_SEARCH;
const { FAILS } = SIZE_BRACKET;
const { MOST_WIDENINGS, MOVED } = SOLVE_SIZE_QUESTION;
const MEETING = 4; // numbers of one

/** Sizes are tried to so many times the plan's own where there are obstacles. */
export const { FAR } = SIZE_QUESTION;

/** What the engine is told of a question about a family, whose plan's own walk goes so far, m. @param {PlanFamily} family @param {Walk} walk @param {number} first @param {number} last */
function limitsOf({ margin, question, tolerance, first: planSize }, walk, first, last) {
  const [x, y] = originAt(walk, first);
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
    [SIZE_MEMORY.PLAN_SIZE, planSize],
  ]);
}

/**
 * What stands on the square, as the engine takes it; fixed if all walks have one route. Other routes are
 * laid where they are before a plan moves them: what stands is moved to there.
 * @param {Arena} arena
 * @param {PlanFamily} family
 * @param {boolean} fixed
 */
function squareOf(arena, { plan }, fixed) {
  const { route } = plan.tables;
  const moves = !fixed && (route.at !== null || route.turned !== 0);
  const given = plan.obstacles();
  const found = moves ? given.map((one) => route.unplaced(one)) : given;
  const things = found.map(({ sort, radius, margin, outline }, n) => {
    const most = Math.max(...given[n].outline.flat().map(Math.abs));
    return [sort, radius, margin, outline.length, moves ? MOVED * most : 0];
  });
  return {
    things: arena.table(things, SIZE_MEMORY.THING),
    outlines: arena.table(
      found.flatMap(({ outline }) => outline),
      2,
    ),
  };
}

/** A question about a size of a plan, open until it is freed. */
export class SizeQuestion extends OwnQuestion {
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
        const fixed = doubles(made.family.numbers)[FAMILY.ROUTE] === FAMILY.FIXED;
        const square = squareOf(arena, family, fixed);
        const room = arena.whole(beginnings());
        return open(made.family, made.walk, square, arena.vector(limits), room);
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
    this.obstacles = family.plan.obstacles();
  }

  /** A number of the state: a column of kernels/size_bracket.py. @param {number} column */
  stateAt(column) {
    return this.numbers(1)[column];
  }

  /** Chains placed in searches of walks. */
  get evaluations() {
    return this.numbers(0)[SIZE_MEMORY.MARCHED];
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
    for (let tried = NaN; ;) {
      const ending = await this.step();
      const now = this.stateAt(SIZE_BRACKET.NOW);
      if (now !== tried) this.progress(0, `${general(now, 9)} m`);
      if (ending !== QUESTION.MORE) return ending;
      tried = now;
    }
  }

  /** The obstacle by which alone a size failed last; null if by none. @param {number} size */
  blocked(size) {
    const figures = this.numbers(0);
    const same = figures[SIZE_MEMORY.BLOCKED] === size;
    return same ? this.obstacles[figures[SIZE_MEMORY.BLOCKED_BY]] : null;
  }

  /** The size of a bracket that does not pass; beyond one within rounding of an obstacle. @param {number} good @param {number} bad */
  async surelyBad(good, bad) {
    for (let widening = 0; widening < MOST_WIDENINGS; widening++) {
      if (this.blocked(bad) === null || this.numbers(0)[SIZE_MEMORY.SURELY]) return bad;
      bad += 2 * (bad - good);
      if ((await this.trial(bad)) !== FAILS) break;
    }
    throw new UnsureError(_("the bracket could not be established beside an obstacle"));
  }
}
