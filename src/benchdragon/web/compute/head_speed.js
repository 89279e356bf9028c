// How fast the head may walk: the greatest constant speed, and a pace that slows only where it must. Twin of
// solve/head_speed.py.

import { QUANTITIES, givenLimits } from "../made/quantities.js";
import { _ } from "../words.js";
import { answered, now } from "./answer.js";
import { copied, withArenaAsync } from "./arena.js";
import { expect, question, spend } from "./budget.js";
import { ANALYSIS_SPEED, MODEL_PROFILE, PACING, PEAK_QUESTION, SOLVE_HEAD_SPEED } from "./constants.js";
import { InputError, UnsureError } from "./errors.js";
import { evenly, least } from "./lists.js";
import { py } from "./python.js";
import { general } from "./number_format.js";
import { SpeedProfile } from "../made/profile.js";
import { failureWithin, peakQuestion, sought, steadily, witnessOf } from "./speed.js";
import { silent, tick } from "./tick.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */

/**
 * A head that slows down only where it must.
 * @typedef {object} Pace
 * @property {SpeedProfile} profile its speed over time; at time 0 the head stands where the plan says
 * @property {Answer} steady the greatest constant speed that keeps the same limits, m/s
 * @property {number} seconds how long the walk takes
 * @property {number} saved by how much less than at the steady speed, s
 */

const { AT_ONCE, PRUDENCE, MOST_KNOTS, FINER } = SOLVE_HEAD_SPEED;
const { TOLERANCE, RATE_TOLERANCE } = ANALYSIS_SPEED;
const { BOUNDED, FALLEN, STEP } = PEAK_QUESTION;
const { MOST_SPEED } = MODEL_PROFILE;

/** The limits that a head speed must keep, by the names of their quantities. @param {Plan} plan */
function limitsOf(plan) {
  const found = givenLimits(plan);
  if (!found.size)
    throw new InputError(
      _("the plan has no limit that a head speed could keep: set limits.speed=2, for example"),
    );
  return found;
}

/**
 * The walk of a plan, and between which positions its head walks, m.
 * @param {import("./arena.js").Arena} arena
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
  const limits = limitsOf(plan);
  return withArenaAsync(engine, async (arena) => {
    const { walk, first, last } = spanned(arena, plan);
    const asked = [...QUANTITIES.values()]
      .filter(({ name }) => limits.has(name))
      .map((quantity) => {
        const width = quantity.name === "speed" ? tolerance : Math.max(tolerance, RATE_TOLERANCE);
        return /** @type {import("./speed.js").Asked} */ ([quantity, width, limits.get(quantity.name)]);
      });
    const found = await sought(walk, steadily(first, last), asked, progress, MOST_SPEED);
    const { peak, lower, upper, decides } = found;
    // What is limited hardly occurs.
    if (!decides) return answered(MOST_SPEED, MOST_SPEED, upper, "m/s", { status: "unlimited" });
    const value = general(limits.get(decides.name));
    const values = { quantity: _(decides.text), value, unit: decides.unit };
    return answered(lower > 0 ? lower : NaN, lower, upper, "m/s", {
      status: lower > 0 ? "found" : "undecided",
      witness: witnessOf(walk, decides, peak),
      assumptions: [_("what decides: {quantity}, at most {value} {unit}", values)],
      evaluations: peak.evaluations,
      seconds: now() - began,
    });
  });
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
    let { times, speeds } = await fastestOver(plan, walk, first, last, progress);
    const whole = (last - first) / even;
    if (times[times.length - 1] >= whole) {
      times = [0, whole];
      speeds = [even, even];
    }
    const plain = new SpeedProfile(times, speeds);
    const zero = plain.time(walk.start - first); // at time 0 the head stands at walk.start
    const profile = new SpeedProfile(
      plain.times.map((/** @type {number} */ t) => t - zero),
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

/**
 * Times, s, and the greatest speeds then, m/s, between which limits are kept too.
 * @param {Plan} plan
 * @param {Walk} walk
 * @param {number} first @param {number} last m
 * @param {Progress} progress
 */
function fastestOver(plan, walk, first, last, progress) {
  const { engine, dragon } = walk;
  const step = STEP * least(dragon.link);
  const steps = Math.max(1, Math.ceil(Math.min((last - first) / step, MOST_KNOTS - 1)));
  const cost = BOUNDED * FINER * (dragon.benches + 1);
  expect(cost * steps);
  const fine = evenly(first, last, steps * FINER + 1);
  const per = Math.max(1, Math.floor(AT_ONCE / ((dragon.benches + 1) * FINER)));
  return withArenaAsync(engine, async (arena) => {
    const [most, table] = [arena.array("d", steps), arena.array("d", steps, PACING.NODES, 2)];
    const [at, limits] = [arena.vector(fine), arena.vector(allLimits(plan))];
    const square = plan.tables.walk.speed ** 2;
    const question = peakQuestion(walk, steadily(first, last));
    try {
      for (let n = 0; n < steps; n += per) {
        const end = Math.min(n + per, steps);
        spend(cost * (end - n));
        const { handle } = question;
        if (question.call("bound", handle, at, n, end, square, limits, most, table) === FALLEN)
          throw failureWithin(walk, first, last);
        progress(end / steps, _("other limits"));
        await tick();
      }
    } finally {
      question.free();
    }
    const ends = arena.vector(fine.filter((_s, n) => n % FINER === 0));
    const [times, speeds] = [arena.array("d", steps + 1), arena.array("d", steps + 1)];
    const [count] = engine.call("bd_pacing_find_pace", table, most, ends, times, speeds);
    if (count < 0) {
      const s = general(fine[(-1 - count) * FINER]);
      throw new UnsureError(
        _("no speed of the head was found that keeps the limits at {s} m of the route", { s }),
      );
    }
    const [all, fastest] = [times, speeds].map((found) => Array.from(copied(found)).slice(0, count));
    return { times: all, speeds: fastest };
  });
}

/** What is limited, in the order of kernels/pacing.py; infinite where nothing limits it. @param {Plan} plan */
function allLimits(plan) {
  const given = limitsOf(plan);
  const limits = [...QUANTITIES.keys()].map((name) => given.get(name) ?? Infinity);
  return [...limits, plan.tables.limits.head_acceleration].map((limit) => (1 - PRUDENCE) * limit);
}

/** The same plan walked at a pace. @param {Plan} plan @param {Pace} pace */
export function withPace(plan, { profile: { times, speeds }, seconds }) {
  const knots = py.zip(times, speeds);
  /** @type {Record<string, unknown>} */
  const values = { "walk.profile": knots, "walk.start": times[0] };
  if (plan.tables.walk.end !== null) values["walk.end"] = times[0] + seconds;
  return plan.withValues(values);
}
