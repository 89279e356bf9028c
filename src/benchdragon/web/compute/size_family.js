// The walks of a plan in which one size varies, for the page and for the kernels. Twin of
// solve/size_family.py.

import { _ } from "../words.js";
import { TurnRoute } from "../made/plan_routes.js";
import { Arena, doubles, withArena } from "./arena.js";
import { within } from "./arrays.js";
import {
  CURVE,
  FAMILY,
  PLANS_ROUTES,
  PLANS_TABLES,
  ROUTE_PARTS,
  SOLVE_SIZE_FAMILY,
  TURN_FAMILIES,
} from "./constants.js";
import { greatest } from "./dragon.js";
import { InputError } from "./errors.js";
import { kindsOf, walkTables } from "./tables.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {"pitch" | "disc" | "width" | "length"} SizeName */
/** A walk and the times between which it must stay clear, s. @typedef {{ walk: Walk, start: number, end: number }} Spanned */
/** What kernels know of a family: see kernels/family.py. @typedef {Record<"numbers" | "parts" | "arcs" | "pieces" | "sizes" | "share", Numbers>} KernelFamily */

/**
 * A size of a plan whose limit is sought.
 * @typedef {object} Question
 * @property {SizeName} name what the command line calls it
 * @property {string[]} keys the plan's keys that hold it
 * @property {number} sense 1 where larger sizes are safer, -1 where smaller ones are
 * @property {() => string} text what the answer is, in the language in use
 * @property {number} what the kernels' number of it
 */

/** Benches i and j (rows, from 0) with the head at s, m, `left` before the walk's end. @typedef {{ s: number, left: number, i: number, j: number }} Meeting */

/** Brackets are at most so wide, m. */
export const { TOLERANCE } = SOLVE_SIZE_FAMILY;

const LENGTHS = ["dragon.body_length", "dragon.tail_length"];

/** @type {Record<SizeName, Question>} */
export const QUESTIONS = {
  pitch: asked("pitch", ["route.pitch"], 1, () => _("smallest pitch"), FAMILY.PITCH),
  disc: asked("disc", ["disc.radius"], 1, () => _("smallest disc radius"), FAMILY.DISC),
  width: asked("width", ["dragon.width"], -1, () => _("widest bench"), FAMILY.WIDTH),
  length: asked("length", LENGTHS, -1, () => _("longest bench"), FAMILY.BENCH),
};

/** @param {SizeName} name @param {string[]} keys @param {number} sense @param {() => string} text @param {number} what @returns {Question} */
function asked(name, keys, sense, text, what) {
  return { name, keys, sense, text, what };
}

/** The question of that name. @param {string} name */
export function question(name) {
  const known = Object.keys(QUESTIONS);
  if (!known.includes(name))
    throw new InputError(_("wanted one of {known}, not {name}", { known: known.join(", "), name }));
  return QUESTIONS[/** @type {SizeName} */ (name)];
}

/**
 * Spans of head positions near a meeting, in a walk from first to last, m: it may be that of another size.
 * @param {Meeting} meeting
 * @param {Float64Array} link of each bench, m
 * @param {number} first @param {number} last
 * @returns {Array<[number, number]>}
 */
export function windowsOf({ s, left, i, j }, link, first, last) {
  const near = 1.5 * Math.max(link[i], link[j]);
  const around = (/** @type {number} */ at) =>
    /** @type {[number, number]} */ ([Math.max(first, at - near), Math.min(last, at + near)]);
  const other = last - left;
  return Math.abs(other - s) > 0.1 * near ? [around(s), around(other)] : [around(s)];
}

/** The walks of a plan in which one size varies. */
export class PlanFamily {
  /** @type {Arena | null} */
  #arena = null;
  /** @type {{ size: number, spanned: Spanned } | null} */
  #last = null;

  /**
   * @param {Engine} engine
   * @param {Plan} plan
   * @param {Question} sought
   * @param {number} margin distance, m, that benches keep
   * @param {number} [tolerance] how wide the bracket may be, m
   */
  constructor(engine, plan, sought, margin, tolerance = TOLERANCE) {
    this.engine = engine;
    this.plan = plan;
    this.question = sought;
    this.margin = margin;
    this.tolerance = tolerance;
    this.#fixFormation();
  }

  /** Let the head of a formation start where it does with the plan's own benches. */
  #fixFormation() {
    const { route, walk } = this.plan.tables;
    if (route.kind !== "formation" && route.kind !== "programme") return;
    if (this.question.name === "pitch")
      throw new InputError(
        _(
          "the smallest pitch of a formation is not sought: see by a sweep over its pitch what clearance each leaves",
        ),
      );
    if (walk.position !== null) return;
    const arena = new Arena(this.engine);
    try {
      this.plan = this.plan.withValues({ "walk.position": this.plan.build(arena).start });
    } finally {
      arena.free();
    }
  }

  /** The plan's own size, from which the search begins. */
  get first() {
    return this.plan.value(this.question.keys[0]);
  }

  /** The walk of a size: the last one is kept until another is asked for. @param {number} size @returns {Spanned} */
  walk(size) {
    if (this.#last?.size === size) return this.#last.spanned;
    this.free();
    const plan = this.plan.withValues(Object.fromEntries(this.question.keys.map((key) => [key, size])));
    this.#arena = new Arena(this.engine);
    const walk = plan.build(this.#arena);
    const [start, end] = plan.span(walk);
    this.#last = { size, spanned: { walk, start, end } };
    return this.#last.spanned;
  }

  /** Give the last walk back. */
  free() {
    this.#arena?.free();
    this.#arena = null;
    this.#last = null;
  }
}

/** The greatest size that a plan may have, m: longer benches cannot follow its formations. @param {Engine} engine @param {Plan} plan @param {Question} sought */
function mostSize(engine, { tables }, sought) {
  if (sought.what !== FAMILY.BENCH) return CURVE.MOST_METRES;
  const { front_inset: front, rear_inset: rear } = tables.dragon;
  const below = withArena(engine, (arena) => within(arena, () => tables.route.links_below()));
  return Math.min(CURVE.MOST_METRES, below + front + rear - TOLERANCE);
}

/** @param {number | null} value */
function orNaN(value) {
  return value ?? NaN;
}

/** What the kernels are told of a plan, a number a column: see kernels/family.py. @param {import("../engine.js").Engine} engine @param {Plan} plan @param {Question} sought */
function kernelNumbers(engine, plan, sought) {
  const { route, turn, walk, disc } = plan.tables;
  const [begin, end, most] = plan.ways(engine);
  const [spiral, turning] = [route.kind === "spiral-in", route.kind === "turn"];
  const [first, last] = turn.radii ?? [NaN, NaN];
  const numbers = new Float64Array(FAMILY.NUMBERS);
  /** @type {Array<[number, number]>} */
  const told = [
    [FAMILY.WHAT, sought.what],
    [FAMILY.ROUTE, spiral ? FAMILY.SPIRAL_IN : turning ? FAMILY.TURN : FAMILY.FIXED],
    [FAMILY.PITCH_SIZE, spiral || turning ? route.pitch : NaN],
    [FAMILY.DISC_RADIUS, turning ? TurnRoute.disc(plan.tables) : orNaN(disc.radius)],
    [FAMILY.START_TURN, spiral ? route.start_turn : NaN],
    [FAMILY.HANDED, spiral && !route.clockwise ? -1 : 1],
    [FAMILY.TURN_FAMILY, turn.family === "arc-arc" ? FAMILY.ARC_ARC : FAMILY.THREE_PIECES],
    [FAMILY.ENTRY_RADIUS, orNaN(turn.entry_radius)],
    [FAMILY.EXIT_RADIUS, orNaN(turn.exit_radius)],
    [FAMILY.RATIO, turn.ratio],
    [FAMILY.FIRST_RADIUS, first],
    [FAMILY.LAST_RADIUS, last],
    [FAMILY.BEND, turn.family === "arc-arc-arc" ? turn.curvature : 0],
    [FAMILY.EASE, turn.ease],
    [FAMILY.POSITION, orNaN(walk.position)],
    [FAMILY.BEGIN_WAY, begin],
    [FAMILY.END_WAY, end],
    [FAMILY.MOST_WAY, most],
    [FAMILY.LEAST_SIZE, sought.name === "pitch" ? PLANS_TABLES.LEAST_PITCH : PLANS_TABLES.LEAST],
    [FAMILY.MOST_SIZE, mostSize(engine, plan, sought)],
    [FAMILY.ROOMY, PLANS_TABLES.ROOMY],
    [FAMILY.FITS, PLANS_ROUTES.FITS],
  ];
  for (const [column, value] of told) numbers[column] = value;
  return numbers;
}

/** A copy of an array. @param {Arena} arena @param {Numbers} array */
function copyIn(arena, array) {
  const made = arena.array("d", ...array.shape);
  doubles(made).set(doubles(array));
  return made;
}

/** The sizes of benches, those that vary marked: benches alike of which one alone varies are two kinds. @param {Arena} arena @param {Numbers} sizes @param {SizeName} name @param {Float64Array} share */
function markedSizes(arena, sizes, name, share) {
  const made = copyIn(arena, sizes);
  const row = name === "width" ? 1 : 0;
  const values = doubles(made).subarray(row * share.length, (row + 1) * share.length);
  const mark = greatest(values) + 1;
  share.forEach((varies, i) => {
    if (varies > 0) values[i] = mark;
  });
  return made;
}

/**
 * A family as kernels want it, and room for its walks; `walk` is one of them.
 * @param {Arena} arena which holds both
 * @param {PlanFamily} family
 * @param {Walk} walk
 * @returns {{ family: KernelFamily, walk: import("./tables.js").WalkTables }}
 */
export function kernelFamily(arena, { plan, question: sought }, walk) {
  const { name } = sought;
  const { benches: count, sizes } = walk.dragon;
  const share = new Float64Array(count);
  if (name === "width") share.fill(1);
  else if (name === "length") share.fill(1, 1);
  const marked = { sizes: markedSizes(arena, sizes, name, share), benches: count };
  const { kind, kinds } = kindsOf(arena, marked);
  const { links, ahead, lever } = walkTables(arena, walk).benches;
  const benches = {
    links: copyIn(arena, links),
    sizes: copyIn(arena, sizes),
    kind,
    ahead,
    lever,
  };
  const { MOST_PIECES, ARCS } = TURN_FAMILIES;
  const made = {
    numbers: arena.vector(kernelNumbers(arena.engine, plan, sought)),
    parts: arena.array("d", MOST_PIECES + 2, ROUTE_PARTS.PART_COLUMNS),
    arcs: arena.array("d", ARCS, 2),
    pieces: arena.array("d", MOST_PIECES, 3),
    sizes: copyIn(arena, sizes),
    share: arena.vector(share),
  };
  return { family: made, walk: { rows: copyIn(arena, walk.route.rows), benches, kinds } };
}
