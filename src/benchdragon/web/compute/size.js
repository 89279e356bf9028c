// Inverse answers: how small or large one size of a plan may be for the walk to stay clear. Twin of
// solve/size.py; what is proved, the command line proves.

import { standAlone } from "../made/contact_search.js";
import { touching } from "../made/obstacles.js";
import { _ } from "../words.js";
import { withArenaAsync } from "./arena.js";
import { answered, now } from "./answer.js";
import { question as asOne } from "./budget.js";
import { SIZE_BRACKET, SIZE_SEARCH, SOLVE_SIZE } from "./constants.js";
import { InputError, PlanError, notNegative } from "./errors.js";
import { HeadTimes } from "../made/head_times.js";
import { linspace } from "./numbers.js";
import { general, pythonFloat } from "./number_format.js";
import { PlanFamily, TOLERANCE, question } from "./size_family.js";
import { FAR, SizeQuestion } from "./size_question.js";
import { silent } from "./tick.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./answer.js").Witness} Witness */
/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./tick.js").Progress} Progress */

/**
 * Sizes from low to high, m, between which all that were tried were safe; just beyond the borders a walk
 * fails.
 * @typedef {{ low: number, high: number, tried: number, borders: number[] }} Span
 */

/** What trying sizes of a range came to. @typedef {{ spans: Span[], step: number, undecided: number[] }} FeasibleSizes */

/** A size that was tried, m, and how that ended. @typedef {[number, number]} Trial */

const { PASSES, FAILS, UNDECIDED } = SIZE_BRACKET;
const { MOST_COUNT } = SOLVE_SIZE;

/**
 * The size of a plan next to which a walk stops staying clear: see QUESTIONS for the names.
 *
 * At one end of the bracket, `tolerance` metres wide, the whole walk stays clear, at the other a pair comes
 * nearer than `margin` (the plan's own if null), a bench touches an obstacle or leaves the venue, or the
 * dragon cannot walk. Status "infeasible": no size passes; "unlimited": all that were tried do;
 * "undecided": sizes in the bracket could not be decided.
 * @param {Engine} engine
 * @param {Plan} plan
 * @param {string} name
 * @param {{ margin?: number | null, tolerance?: number, progress?: Progress }} [options]
 * @returns {Promise<Answer>}
 */
export async function limit(engine, plan, name, options = {}) {
  const { margin = null, tolerance = TOLERANCE, progress = silent } = options;
  const began = now();
  return asOne(async () => {
    const family = familyOf(engine, plan, name, margin, tolerance);
    return withArenaAsync(engine, () =>
      searched(family, progress, (search) => sought(family, search, began)),
    );
  });
}

/**
 * What `use` makes of a search for a size.
 * @template T
 * @param {PlanFamily} family
 * @param {Progress} progress
 * @param {(search: SizeQuestion) => Promise<T>} use
 */
async function searched(family, progress, use) {
  /** @type {SizeQuestion | null} */
  let search = null;
  try {
    search = new SizeQuestion(family, progress);
    return await use(search);
  } finally {
    search?.free();
    family.free();
  }
}

/** @param {PlanFamily} family @param {SizeQuestion} search @param {number} began */
async function sought(family, search, began) {
  const ending = await search.limit(family.first);
  const { doubts } = search;
  const [good, found] = [search.stateAt(SIZE_BRACKET.GOOD), search.stateAt(SIZE_BRACKET.VALUE)];
  const told = () => ({
    assumptions: assumed(family, doubts),
    evaluations: search.evaluations,
    seconds: now() - began,
  });
  if (ending === SIZE_SEARCH.INFEASIBLE) {
    const status = doubts.length ? "undecided" : "infeasible";
    return answered(NaN, -Infinity, Infinity, "m", { status, ...told() });
  }
  const unsure = ending === SIZE_SEARCH.EXHAUSTED || search.inDoubt;
  const [assumptions, unlimited] = [told(), ending === SIZE_SEARCH.UNLIMITED];
  const tried = search.stateAt(SIZE_BRACKET.BAD);
  const bad = unlimited ? tried : await search.surelyBad(good, tried);
  /** @type {import("./answer.js").Status} */
  const status = unsure ? "undecided" : unlimited ? "unlimited" : "found";
  const [lower, upper] = [Math.min(good, bad), Math.max(good, bad)];
  const value = Math.min(Math.max(found, lower), upper);
  return answered(value, lower, upper, "m", {
    status,
    witness: await witnessOf(family, search, bad),
    ...assumptions,
  });
}

/** The walks among which a limit is sought; not such as must fail whatever their size. @param {Engine} engine @param {Plan} plan @param {string} name @param {number | null} margin @param {number} [tolerance] */
function familyOf(engine, plan, name, margin, tolerance) {
  const { limits, disc, walk, route } = plan.tables;
  const kept = notNegative("margin", margin ?? limits.margin, "m");
  const family = new PlanFamily(engine, plan, question(name), kept, tolerance);
  const centre = disc.radius === null && walk.end === null;
  if (name !== "disc" && route.kind === "spiral-in" && centre)
    throw new InputError(_("say how far in the head comes: set disc.radius=4.5, for example"));
  return family;
}

/** What shows that a size does not pass; null where no pair does, or there is no such walk. @param {PlanFamily} family @param {SizeQuestion} found @param {number} size @returns {Promise<Witness | null>} */
async function witnessOf(family, found, size) {
  const [meeting, thing] = [found.guide, found.blocked(size)];
  const spanned = meeting || thing ? walkOrNull(family, size) : null;
  if (!spanned) return null;
  const { walk, start, end } = spanned;
  if (thing) return (await touching(walk, thing, start, end)).at(-1)?.witness ?? null;
  if (!meeting) return null;
  const [first, last] = [walk.headPosition(start), walk.headPosition(end)];
  const times = new HeadTimes(walk, first, start);
  return standAlone(walk, times, Math.min(meeting.s, last), meeting.i, meeting.j);
}

/** @param {PlanFamily} family @param {number} size */
function walkOrNull(family, size) {
  try {
    return family.walk(size);
  } catch (error) {
    if (error instanceof InputError || error instanceof PlanError) return null;
    throw error;
  }
}

/** @param {PlanFamily} family @param {number[]} unsure */
function assumed({ plan, margin }, unsure) {
  const texts = [
    _("benches keep {margin} m", { margin: general(margin) }),
    _("sizes beyond the bracket were not tried"),
  ];
  if (plan.obstacles().length)
    texts.push(
      _(
        "the venue and obstacles count: other sizes may be safe as well, --range tries them; none over {far} times the plan's own was tried, and none that much smaller",
        { far: general(FAR) },
      ),
    );
  return unsure.length ? [...texts, undecidedText(unsure)] : texts;
}

/** That sizes, m, could not be decided. @param {number[]} sizes */
function undecidedText(sizes) {
  return _("{count} of the sizes tried, from {low} m to {high} m, are undecided", {
    count: sizes.length,
    low: general(Math.min(...sizes)),
    high: general(Math.max(...sizes)),
  });
}

/**
 * The sizes between low and high (m) with which the walk stays clear, tried at `count` places.
 *
 * Where a span borders on sizes that do not pass, the border is found as by `limit`; where on ones that
 * could not be decided, it is the last that passes. What lies between sizes tried is not known.
 * @param {Engine} engine
 * @param {Plan} plan
 * @param {string} name
 * @param {number} low @param {number} high
 * @param {{ count?: number, margin?: number | null, tolerance?: number, progress?: Progress }} [options]
 * @returns {Promise<FeasibleSizes>}
 */
export async function feasibleSizes(engine, plan, name, low, high, options = {}) {
  const { count = 50, margin = null, tolerance = TOLERANCE, progress = silent } = options;
  checkRange(low, high, count);
  const family = familyOf(engine, plan, name, margin, tolerance);
  const tryEach = async (/** @type {SizeQuestion} */ search) => {
    /** @type {Trial[]} */
    const trials = [];
    for (const [n, size] of linspace(low, high, count).entries()) {
      progress(n / count, `${general(size, 9)} m`);
      trials.push([size, await search.trial(size)]);
    }
    const undecided = trials.filter(([, ended]) => ended === UNDECIDED).map(([size]) => size);
    const spans = [];
    for (const [first, last] of runs(trials)) spans.push(await spanOf(search, trials, first, last));
    return { spans, step: (high - low) / (count - 1), undecided };
  };
  return asOne(() => searched(family, silent, tryEach), count);
}

/** @param {number} low @param {number} high @param {number} count */
function checkRange(low, high, count) {
  if (!(0 < low && low < high && high < Infinity))
    throw new InputError(
      _("wanted a range from a positive size to a larger one, not {low} to {high} m", {
        low: pythonFloat(low),
        high: pythonFloat(high),
      }),
    );
  if (!(2 <= count && count <= MOST_COUNT))
    throw new InputError(
      _("count must lie between 2 and {most}, not at {count}", { most: MOST_COUNT, count }),
    );
}

/** The first and last number of each run of trials that pass. @param {Trial[]} trials */
function runs(trials) {
  /** @type {Array<[number, number]>} */
  const found = [];
  trials.forEach(([, ended], n) => {
    const last = found[found.length - 1];
    if (ended === PASSES && last?.[1] === n - 1) last[1] = n;
    else if (ended === PASSES) found.push([n, n]);
  });
  return found;
}

/** A run of sizes that pass, and how far beyond its ends sizes still do. @param {SizeQuestion} search @param {Trial[]} trials @param {number} first @param {number} last @returns {Promise<Span>} */
async function spanOf(search, trials, first, last) {
  const edges = [await edge(search, trials, first, -1), await edge(search, trials, last, 1)];
  const [low, high] = edges.map(({ size }) => size);
  const borders = edges.filter(({ found }) => found).map(({ size }) => size);
  return { low, high, tried: last - first + 1, borders };
}

/** How far sizes are safe to one side of trial n, which passes; whether a walk fails just beyond. @param {SizeQuestion} search @param {Trial[]} trials @param {number} n @param {number} side */
async function edge(search, trials, n, side) {
  const beside = trials[n + side];
  if (!beside || beside[1] !== FAILS) return { size: trials[n][0], found: false };
  return search.border(trials[n][0], beside[0]);
}
