// How fast the head may walk: the greatest constant speed, and a pace that slows only where it must. Twin of
// solve/head_speed.py and of `hulls` in analysis/speed.py.

import { _ } from "../words.js";
import { answered, now } from "./answer.js";
import { Arena, copied, doubles, withArenaAsync } from "./arena.js";
import { expect, hold, question, spend } from "./budget.js";
import { ANALYSIS_SPEED, MODEL_PROFILE, PACING, SOLVE_HEAD_SPEED } from "./constants.js";
import { InputError, UnsureError } from "./errors.js";
import { evenly, firstRows, least } from "./lists.js";
import { general } from "./number_format.js";
import { Profile } from "./profile.js";
import { QUANTITIES, givenLimits } from "./quantities.js";
import { failureWithin, greatestOf, scratchFor, witnessOf } from "./speed.js";
import { part } from "./stages.js";
import { silent, tick } from "./tick.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./quantities.js").Quantity} Quantity */
/** @typedef {import("./quantities.js").QuantityName} QuantityName */
/** @typedef {import("./speed.js").Peak} Peak */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */

/**
 * A head that slows down only where it must.
 * @typedef {object} Pace
 * @property {Profile} profile its speed over time; at time 0 the head stands where the plan says
 * @property {Answer} steady the greatest constant speed that keeps the same limits, m/s
 * @property {number} seconds how long the walk takes
 * @property {number} saved by how much less than at the steady speed, s
 */

/** A limit and what is seen of it with the head at 1 m/s. @typedef {{ quantity: Quantity, allowed: number, peak: Peak }} Decisive */

/** Head positions, m, and the greatest speeds there, m/s. @typedef {{ at: number[], speeds: number[] }} Fastest */

const { PRUDENCE, MOST_KNOTS, FINER, ROUNDING } = SOLVE_HEAD_SPEED;
const { BOUNDED, STEP, TOLERANCE, RATE_TOLERANCE } = ANALYSIS_SPEED;
const { MOST_SPEED } = MODEL_PROFILE;
// Handles times head positions that are placed at a time: memory of a page is never given back.
const PLACES = 100_000;

/** The limits that a head speed must keep, by the names of their quantities. @param {Plan} plan */
function limitsOf(plan) {
  const found = givenLimits(plan.tables.limits);
  if (!Object.keys(found).length)
    throw new InputError(
      _("the plan has no limit that a head speed could keep: set limits.speed=2, for example"),
    );
  return found;
}

/**
 * The walk of a plan, and between which positions its head walks, m.
 * @param {Arena} arena
 * @param {Plan} plan
 */
function spanned(arena, plan) {
  const walk = plan.build(arena);
  const [start, end] = plan.span(walk);
  return { walk, first: walk.headPosition(start), last: walk.headPosition(end) };
}

/**
 * The greatest constant head speed, m/s, with which the plan's whole walk keeps its limits.
 *
 * The value is the bracket's lower end: what surely keeps all of them. The witness is the handle or the
 * bench of the limit that decides, its time that of a head at the plan's own speed. `tolerance` is that of
 * the greatest speed ratio; turning rates and accelerations have at least 1e-6.
 * @param {Engine} engine
 * @param {Plan} plan
 * @param {{ tolerance?: number, progress?: Progress }} [options]
 * @returns {Promise<Answer>}
 */
export function greatestHeadSpeed(engine, plan, options = {}) {
  return question(() => steadySpeed(engine, plan, options));
}

/** @param {Engine} engine @param {Plan} plan @param {{ tolerance?: number, progress?: Progress }} options @returns {Promise<Answer>} */
async function steadySpeed(engine, plan, options) {
  const { tolerance = TOLERANCE, progress = silent } = options;
  const began = now();
  const limits = Object.entries(limitsOf(plan));
  return withArenaAsync(engine, async (arena) => {
    const { walk, first, last } = spanned(arena, plan);
    const found = new Bracket();
    for (const [n, [name, allowed]] of limits.entries()) {
      const quantity = QUANTITIES[/** @type {QuantityName} */ (name)];
      const width = name === "speed" ? tolerance : Math.max(tolerance, RATE_TOLERANCE);
      const told = part(progress, n / limits.length, (n + 1) / limits.length, quantity.text());
      // Who keeps to this allows more than those before.
      const limit = allowed / found.lower ** quantity.power;
      const asked = { tolerance: width, limit, progress: told };
      const peak = await greatestOf(walk, quantity, first, last, asked);
      found.evaluations += peak.evaluations;
      if (peak.upper > limit) found.narrow({ quantity, allowed, peak });
      if (found.lower === 0) break;
    }
    return found.answer(walk, began);
  });
}

/** The greatest head speed, m/s, as far as limits were looked at, and the one that decides. */
class Bracket {
  lower = MOST_SPEED;
  upper = Infinity;
  evaluations = 0;
  /** @type {Decisive | null} */
  decisive = null;

  /** Take in a limit that is exceeded at the lower end. @param {Decisive} limited */
  narrow({ quantity, allowed, peak }) {
    this.lower = headSpeed(quantity, allowed, peak.upper);
    const most = headSpeed(quantity, allowed, peak.least / (1 + ROUNDING));
    if (most >= this.upper && this.decisive !== null) return;
    this.upper = most;
    this.decisive = { quantity, allowed, peak };
  }

  /** The answer, sought since `began`. @param {Walk} walk @param {number} began */
  answer(walk, began) {
    const { lower, upper, decisive, evaluations } = this;
    // What is limited hardly occurs.
    if (!decisive) return answered(MOST_SPEED, MOST_SPEED, upper, "m/s", { status: "unlimited" });
    const { quantity, allowed, peak } = decisive;
    return answered(lower > 0 ? lower : NaN, lower, upper, "m/s", {
      status: lower > 0 ? "found" : "undecided",
      witness: witnessOf(walk, quantity, peak),
      assumptions: [assumed(quantity, allowed)],
      evaluations,
      seconds: now() - began,
    });
  }
}

/** @param {Quantity} quantity @param {number} allowed @param {number} peak */
function headSpeed({ power }, allowed, peak) {
  return peak > 0 ? (allowed / peak) ** (1 / power) : Infinity;
}

/** @param {Quantity} quantity @param {number} allowed */
function assumed({ text, unit }, allowed) {
  const values = { quantity: text(), value: general(allowed), unit };
  return _("what decides: {quantity}, at most {value} {unit}", values);
}

/**
 * A pace at the plan's own head speed that slows down only where a limit would be exceeded.
 *
 * Between evaluations none exceeds a limit either: over each step of the head the pace keeps to what a bound
 * on all of them allows (see kernels/pacing.py). The head changes its speed by at most
 * limits.head_acceleration.
 * @param {Engine} engine
 * @param {Plan} plan
 * @param {{ progress?: Progress }} [options]
 * @returns {Promise<Pace>}
 */
export function slowed(engine, plan, { progress = silent } = {}) {
  return question(() => slowedWhereItMust(engine, plan, progress));
}

/** @param {Engine} engine @param {Plan} plan @param {Progress} progress @returns {Promise<Pace>} */
async function slowedWhereItMust(engine, plan, progress) {
  refuseHeld(plan);
  const steady = await greatestHeadSpeed(engine, plan, { progress });
  if (steady.status === "undecided")
    throw new UnsureError(_("it could not be shown that the dragon stands all along"));
  return withArenaAsync(engine, async (arena) => {
    const { walk, first, last } = spanned(arena, plan);
    if (!(first < last))
      throw new InputError(_("the walk has no length: set walk.start and walk.end apart"));
    const even = Math.min(steady.lower, plan.tables.walk.speed);
    const fastest = await fastestOver(plan, walk, first, last, progress);
    let { speeds } = fastest;
    let times = timesOf(fastest);
    const whole = (last - first) / even;
    if (times[times.length - 1] >= whole)
      [times, speeds] = [
        [0, whole],
        [even, even],
      ];
    const plain = profileOf(times, speeds);
    const zero = plain.time(walk.start - first); // at time 0 the head stands at walk.start
    const profile = new Profile(
      plain.times.map((t) => t - zero),
      plain.speeds,
    );
    const seconds = times[times.length - 1];
    return { profile, steady, seconds, saved: whole - seconds };
  });
}

/** Refuse a plan whose head has a pace of its own. @param {Plan} plan */
function refuseHeld({ tables: { walk, cues } }) {
  if (walk.profile.length)
    throw new InputError(_("the plan has a speed profile of its own: take walk.profile out"));
  if (cues.cue.some((/** @type {{ kind: string }} */ { kind }) => kind === "hold" || kind === "stop"))
    throw new InputError(_("cues hold the head: seek the speeds without them, then put them in again"));
}

/** When the head is where, s, from its first position on. @param {Fastest} fastest */
function timesOf({ at, speeds }) {
  const times = [0];
  for (let n = 1; n < at.length; n++)
    times.push(times[n - 1] + (2 * (at[n] - at[n - 1])) / (speeds[n] + speeds[n - 1]));
  return times;
}

/**
 * Head positions, and the greatest speeds there between which limits are kept too.
 * @param {Plan} plan
 * @param {Walk} walk
 * @param {number} first @param {number} last m
 * @param {Progress} progress
 * @returns {Promise<Fastest>}
 */
function fastestOver(plan, walk, first, last, progress) {
  const step = STEP * least(walk.dragon.link);
  const steps = Math.max(1, Math.ceil(Math.min((last - first) / step, MOST_KNOTS - 1)));
  const handles = walk.dragon.benches + 1;
  hold(8 * steps * (handles * PACING.HULL_COLUMNS + FINER));
  expect(BOUNDED * steps * FINER * handles);
  const fine = evenly(first, last, steps * FINER + 1);
  const at = fine.filter((_s, n) => n % FINER === 0);
  return withArenaAsync(walk.engine, async (arena) => {
    const most = arena.array("d", steps);
    const table = arena.array("d", steps, PACING.NODES, 2);
    const limits = arena.vector(allLimits(plan));
    const asked = { limits, square: plan.tables.walk.speed ** 2 };
    const per = Math.max(1, Math.floor(PLACES / (handles * FINER)));
    for (let n = 0; n < steps; n += per) {
      const count = Math.min(per, steps - n);
      spend(BOUNDED * (count * FINER + 1) * handles);
      progress(n / steps, _("other limits"));
      tabulated(walk, fine.slice(n * FINER, (n + count) * FINER + 1), asked, {
        most: rowsOf(most, n, count),
        table: rowsOf(table, n, count),
      });
      await tick();
    }
    const lengths = arena.vector(at.slice(1).map((s, n) => s - at[n]));
    const found = arena.array("d", steps + 1);
    walk.engine.call("bd_pacing_fastest_pace", table, most, lengths, found);
    const squares = Array.from(copied(found));
    refuseStanding(at, squares);
    return { at, speeds: squares.map(Math.sqrt) };
  });
}

/** What is limited, in the order of kernels/pacing.py; infinite where nothing limits it. @param {Plan} plan */
function allLimits(plan) {
  const given = limitsOf(plan);
  const names = /** @type {QuantityName[]} */ (Object.keys(QUANTITIES));
  const limits = names.map((name) => given[name] ?? Infinity);
  return [...limits, plan.tables.limits.head_acceleration].map((limit) => (1 - PRUDENCE) * limit);
}

/** So many rows of a table from one on; they are freed with it. @param {Numbers} table @param {number} first @param {number} count */
function rowsOf(table, first, count) {
  const rows = firstRows(table, count);
  const [, ...rest] = table.shape;
  rows.address += 8 * first * rest.reduce((all, length) => all * length, 1);
  return rows;
}

/**
 * Fill `most` and `table` as `pacing.tabulate` does, of steps each of which has FINER parts, bounded together.
 * @param {Walk} walk
 * @param {number[]} fine borders of the parts, m
 * @param {{ limits: Numbers, square: number }} asked
 * @param {{ most: Numbers, table: Numbers }} filled
 */
function tabulated(walk, fine, { limits, square }, { most, table }) {
  const { engine, dragon, route } = walk;
  const handles = dragon.benches + 1;
  const arena = new Arena(engine);
  try {
    const [at, places] = [arena.vector(fine), arena.placements(handles, fine.length)];
    const [stands] = engine.call(
      "bd_step_bounds_place_chain", route.rows, dragon.links, at, 0, fine.length, places,
    ); // prettier-ignore
    if (!stands) throw failureWithin(walk, fine[0], fine[fine.length - 1]);
    const slots = Array.from({ length: fine.length - 1 }, (_slot, n) => n);
    const which = slots.map((n) => Math.floor(n / FINER));
    const hulls = emptyHulls(arena, most.size, handles);
    engine.call(
      "bd_pacing_widen", route.rows, dragon.links, places, arena.whole(slots), arena.whole(which),
      arena.vector([1, 1, 0]), scratchFor(arena, handles), hulls,
    ); // prettier-ignore
    engine.call("bd_pacing_tabulate", hulls, limits, square, most, table);
  } finally {
    arena.free();
  }
}

/** Bounds on so many handles over so many steps, of nothing yet. @param {Arena} arena @param {number} steps @param {number} handles */
function emptyHulls(arena, steps, handles) {
  const { HULL_COLUMNS, GROWTH_LOW, GROWTH_HIGH } = PACING;
  const hulls = arena.full([steps, handles, HULL_COLUMNS], 0);
  const view = doubles(hulls);
  for (let n = 0; n < view.length; n += HULL_COLUMNS) {
    view[n + GROWTH_LOW] = Infinity;
    view[n + GROWTH_HIGH] = -Infinity;
  }
  return hulls;
}

/** @param {number[]} at head positions, m @param {number[]} squares of the greatest speeds there */
function refuseStanding(at, squares) {
  if (squares.every((square) => square !== 0)) return;
  const slowest = squares.reduce((n, square, m) => (square < squares[n] ? m : n), 0);
  throw new UnsureError(
    _("no speed of the head was found that keeps the limits at {s} m of the route", {
      s: general(at[slowest]),
    }),
  );
}

/** The profile through these knots, without those inside a stretch of one speed. @param {number[]} times @param {number[]} speeds */
function profileOf(times, speeds) {
  const kept = speeds.map((speed, n) => speeds[n - 1] !== speed || speeds[n + 1] !== speed);
  const chosen = (/** @type {number} */ _value, /** @type {number} */ n) => kept[n];
  return new Profile(times.filter(chosen), speeds.filter(chosen));
}

/** The same plan walked at a pace. @param {Plan} plan @param {Pace} pace */
export function withPace(plan, { profile: { times, speeds }, seconds }) {
  const knots = times.map((time, n) => [time, speeds[n]]);
  /** @type {Record<string, unknown>} */
  const values = { "walk.profile": knots, "walk.start": times[0] };
  if (plan.tables.walk.end !== null) values["walk.end"] = times[0] + seconds;
  return plan.withValues(values);
}
