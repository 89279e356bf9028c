// People are not exact: how likely benches touch when handles stray, pins have play, benches vary. Twin of
// solve/tolerance.py; the same random numbers, so that each dance needs the same pitch.

import { _ } from "../words.js";
import { withArena } from "./arena.js";
import { hold, question } from "./budget.js";
import { atMost, chance } from "./chance.js";
import { SOLVE_RANDOM_DANCE, SOLVE_TOLERANCE } from "./constants.js";
import { WAYS, openParts } from "./dance_bound.js";
import { Dragon } from "./dragon.js";
import { InputError, UnsureError, WalkError, notNegative } from "./errors.js";
import { general } from "./number_format.js";
import { builtDragon } from "./plan.js";
import { PCG64 } from "./random.js";
import { CannotFollowError, GRAZE, RandomDance, nearestOf } from "./random_dance.js";
import { limit } from "./size.js";
import { Spline, between, smoothed } from "./smooth.js";
import { strayed } from "./strayed.js";
import { silent, tick } from "./tick.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./random_dance.js").Hint} Hint */
/** @typedef {import("./strayed.js").Offset} Offset */
/** @typedef {import("./tick.js").Progress} Progress */
/** How far from exact a dance is: standard deviations, m: see `Deviations` there. @typedef {Record<"aside" | "stray" | "play" | "height" | "length" | "width", number>} Deviations */

/**
 * What dances drawn at random need: for each the smallest pitch with which it stays clear.
 * @typedef {object} Tolerance
 * @property {number} exact the smallest pitch without deviations, m
 * @property {number[]} needed m, in increasing order
 * @property {number} hits dances that touch at the plan's own pitch
 */

const { STRAY_LENGTH, STRAY_ENTRIES, TOLERANCE, MOST_TRIALS, LEAST_SLOPE, MOST_SLOPE } =
  SOLVE_TOLERANCE;
const { UNWALKABLE, LONGEST_STEP, NARROWEST, WIDEST, LIKELY, MOST_DRAWS, CONFIDENCE } = SOLVE_TOLERANCE;
const { NODE } = SOLVE_RANDOM_DANCE;
/** Chances of touching for which a pitch is told. @type {number[]} */
export const RISKS = SOLVE_TOLERANCE.RISKS;
/** @type {Deviations} */
const EXACT = { aside: 0, stray: 0, play: 0, height: 0, length: 0, width: 0 };
/** What a practised troupe may keep to, all at once: the last of CASES. @type {Deviations} */
export const ALL = { aside: 0.02, stray: 0.02, play: 0.01, height: 0.1, length: 0.02, width: 0.005 };

/** @param {Partial<Deviations>} said @returns {Deviations} */
function checkedDeviations(said) {
  const whole = { ...EXACT, ...said };
  for (const [name, value] of Object.entries(whole))
    if (notNegative(name, value, "m") > 1)
      throw new InputError(_("{name} must be at most 1 m", { name }));
  return whole;
}

/** One dance drawn at random: what is added to the plan's sizes and places, m. */
class Draw {
  /** @type {Map<number, { dice: PCG64, noise: number[] }>} */
  #streams = new Map();

  /** @param {Deviations} deviations @param {number} seed @param {number} number from 0 */
  constructor(deviations, seed, number) {
    this.deviations = deviations;
    this.seed = seed;
    this.number = number;
  }

  /** Standard normal numbers, the same for the same draw and part, however many are asked for. @param {number} part @param {number} count */
  noise(part, count) {
    const stream = this.#streams.get(part) ?? {
      dice: new PCG64(this.seed, [this.number, part]),
      noise: [],
    };
    this.#streams.set(part, stream);
    while (stream.noise.length < count) stream.noise.push(stream.dice.normal());
    return Float64Array.from(stream.noise.slice(0, count));
  }

  /** The benches of this dance, seen from above. @param {Arena} arena @param {Dragon} plain */
  dragon(arena, plain) {
    const { deviations, number } = this;
    const noise = [0, 1, 2, 3].map((part) => this.noise(part, plain.benches));
    const length = plain.length.map((one, i) => one + deviations.length * noise[0][i]);
    const width = plain.width.map((one, i) => one + deviations.width * noise[1][i]);
    const rear_inset = plain.rear_inset.map((rear, i) => {
      const link = length[i] - plain.front_inset[i] - rear;
      const height = deviations.height * noise[3][i];
      const level = Math.sqrt(Math.max(link * link - height * height, 0)) - link;
      // Pins with play move the benches, not their edges: the rear inset takes it up.
      return rear - (deviations.play * noise[2][i] + level);
    });
    try {
      return new Dragon(arena, { length, width, front_inset: plain.front_inset, rear_inset });
    } catch (error) {
      if (!(error instanceof InputError)) throw error;
      throw new InputError(
        _("dance {number} has a bench that cannot be: {why}; make the deviations smaller", {
          number: number + 1,
          why: error.message,
        }),
      );
    }
  }

  /** How far aside the trodden line lies, as a smooth function of route position from low to end, m. @param {number} low @param {number} end @returns {Offset} */
  offset(low, end) {
    const step = STRAY_LENGTH / STRAY_ENTRIES;
    hold((NODE * (end - low)) / step);
    // A Gaussian filter of spread w leaves noise a deviation of (4 pi w^2)^(-1/4).
    const [spread, edge] = [STRAY_ENTRIES / Math.sqrt(2), 4 * STRAY_ENTRIES];
    const rough = this.noise(5, Math.ceil((end - low) / step) + 2 * edge);
    const scale = this.deviations.stray * (4 * Math.PI * spread ** 2) ** 0.25;
    const smooth = smoothed(rough, spread).slice(edge, -edge + 2);
    const curve = new Spline(
      smooth.map((one) => scale * one),
      step,
    );
    return (s) => {
      const [value, slope] = curve.at(end - s);
      return [value, -slope];
    };
  }
}

/**
 * One dance of a plan, drawn at random, from the start of its walk to the end.
 * @param {Arena} arena which holds it
 * @param {Plan} plan
 * @param {Draw} draw
 */
function randomDance(arena, plan, draw) {
  const walk = plan.build(arena);
  const dragon = draw.dragon(arena, walk.dragon);
  const { route } = walk;
  const [start, end] = plan.span(walk).map((time) => walk.headPosition(time));
  const { deviations } = draw;
  const beside = deviations.aside || deviations.stray;
  const noise = beside ? draw.noise(4, dragon.benches + 1) : new Float64Array(0);
  const aside = noise.map((one) => deviations.aside * one);
  if (!deviations.stray) {
    const open = openParts(route, dragon, aside, null, [start, end]);
    return new RandomDance(arena, dragon, route.rows, aside, [start, end], kept(open));
  }
  const low = start - WAYS * dragon.extent - STRAY_LENGTH;
  const offset = draw.offset(low, end);
  const { rows, ways } = strayed(arena, route, offset, low, end);
  const place = (/** @type {number} */ s) => between(s, ways.drawn, ways.along);
  const open = openParts(route, dragon, aside, offset, [start, end]);
  const mapped = (/** @type {number} */ wanted) =>
    open(wanted).map((part) => ({ ...part, start: place(part.start), end: place(part.end) }));
  return new RandomDance(arena, dragon, rows, aside, [place(start), place(end)], kept(mapped));
}

/** A function that keeps what it told. @template T @param {(value: number) => T} make */
function kept(make) {
  /** @type {Map<number, T>} */
  const known = new Map();
  return (/** @type {number} */ value) => {
    const found = known.get(value) ?? make(value);
    known.set(value, found);
    return found;
  };
}

/** Whether an error says that a dance cannot be walked. @param {unknown} error */
function fails(error) {
  return error instanceof WalkError || error instanceof CannotFollowError;
}

/** Whether benches of one dance come nearer than the plan's margin, or one cannot follow. @param {Engine} engine @param {Plan} plan @param {Draw} draw */
function touches(engine, plan, draw) {
  const { margin } = plan.tables.limits;
  try {
    return withArena(engine, (arena) => {
      const dance = randomDance(arena, plan, draw);
      return dance.lowMeeting(margin).distance <= margin || dance.touch(margin) !== null;
    });
  } catch (error) {
    if (fails(error)) return true;
    throw error;
  }
}

/** One dance, tried with several pitches. */
class Trials {
  /** Where benches came nearest, or touched where they were not looked for. @type {Hint[]} */
  hints = [];

  /** @param {Engine} engine @param {Plan} plan @param {Draw} draw */
  constructor(engine, plan, draw) {
    this.engine = engine;
    this.plan = plan;
    this.draw = draw;
  }

  /**
   * A low distance of benches less the margin, m; NaN where a bench cannot follow. Above TOLERANCE it is that
   * of places evaluated here and there, unless it is to be `sure`.
   * @param {number} pitch @param {boolean} sure
   */
  room(pitch, sure) {
    try {
      return withArena(this.engine, (arena) => {
        const plan = this.plan.withValues({ "route.pitch": pitch });
        return this.#roomOf(randomDance(arena, plan, this.draw), sure);
      });
    } catch (error) {
      if (fails(error)) return NaN;
      throw error;
    }
  }

  /** @param {RandomDance} dance @param {boolean} sure */
  #roomOf(dance, sure) {
    const { margin } = this.plan.tables.limits;
    const known = this.hints.map((hint) => dance.meetingNear(hint));
    if (!known.length || nearestOf(known).distance >= margin) known.push(dance.lowMeeting(margin));
    const low = nearestOf(known);
    this.hints = [dance.hint(low), ...this.hints.slice(1)];
    const left = low.distance - margin;
    if (left < 0 || !(sure || left <= TOLERANCE)) return left;
    const place = dance.touch(margin);
    if (place === null) return left;
    const hint = dance.hint(place);
    this.hints.push(hint);
    return Math.min(dance.meetingNear(hint).distance - margin, -GRAZE);
  }
}

/**
 * The pitch, m, next to which a dance stops keeping the plan's margin, sought from a guess.
 *
 * With that pitch no pair comes nearer than the margin; with one smaller by TOLERANCE some pair does, or a
 * bench cannot follow. Pitches beyond are not tried.
 * @param {Engine} engine
 * @param {Plan} plan
 * @param {Draw} draw
 * @param {number} guess
 * @param {() => Promise<unknown>} pause
 */
async function neededPitch(engine, plan, draw, guess, pause) {
  const trials = new Trials(engine, plan, draw);
  const { aside, stray } = draw.deviations;
  let [touching, clear, slope] = [0, Infinity, 1];
  let [a, fa, b] = [NaN, NaN, guess + LIKELY * Math.hypot(aside, stray)];
  for (let trial = 0; trial < MOST_TRIALS; trial++) {
    if (!(NARROWEST * guess < b && b < WIDEST * guess)) break;
    // Lines that stray are drawn by arcs, whose number leaps with the pitch, and distances with it.
    const sure = 0 < b - touching && b - touching <= TOLERANCE;
    const fb = trials.room(b, sure);
    await pause();
    if (!(fb >= 0)) {
      touching = Math.max(touching, b);
      if (clear <= b) clear = Infinity;
    } else if ((sure || fb <= TOLERANCE) && b > touching) clear = Math.min(clear, b);
    if (clear - touching <= TOLERANCE) return clear;
    if (Number.isFinite(fb) && Number.isFinite(fa) && b !== a)
      slope = Math.min(Math.max((fb - fa) / (b - a), LEAST_SLOPE), MOST_SLOPE);
    [a, fa, b] = [b, fb, nextPitch(b, fb, slope, touching, clear)];
  }
  throw new UnsureError(
    _("no pitch near {guess} m was found with which dance {number} is just free of contact", {
      guess: general(guess, 4),
      number: draw.number + 1,
    }),
  );
}

/** The pitch to try next, m: where the room would be half of TOLERANCE, or just not any more. @param {number} pitch @param {number} room @param {number} slope @param {number} touching @param {number} clear */
function nextPitch(pitch, room, slope, touching, clear) {
  let ahead = pitch + (0.5 * TOLERANCE - room) / slope;
  if (Number.isNaN(room)) ahead = UNWALKABLE * pitch;
  else if (clear < Infinity) ahead = clear - Math.max(0.9 * TOLERANCE, room / slope);
  // Where a bound clears most of a walk the distances seen are far from the least.
  ahead = Math.min(Math.max(ahead, (1 - LONGEST_STEP) * pitch), (1 + LONGEST_STEP) * pitch);
  if (touching < ahead && ahead < clear) return ahead;
  return 0.5 * (touching + Math.min(clear, Math.max(pitch, touching)));
}

/** @param {Engine} engine @param {Plan} plan @param {Progress} progress */
async function exactPitch(engine, plan, progress) {
  const { route, disc, walk } = plan.tables;
  if (route.kind === "spiral-in" && disc.radius === null && walk.end === null)
    throw new InputError(_("say how far in the head comes: set disc.radius=4.5, for example"));
  const benches = withArena(engine, (arena) => builtDragon(arena, plan.tables.dragon).benches);
  if (benches < 3)
    throw new InputError(_("no benches of this dragon can touch: no two are non-adjacent"));
  const found = await limit(engine, plan.withoutSquare(), "pitch", { progress });
  if (found.status === "found" || found.status === "unlimited") return found.value;
  throw new UnsureError(_("no pitch was found with which this dragon is free of contact"));
}

/**
 * The pitch that each of so many random dances needs, and how many touch at the plan's own.
 *
 * Each pitch is one next to which the dance stops keeping the plan's margin, sought from the exact one. Benches
 * alone are asked about: the venue and obstacles do not count.
 * @param {Engine} engine
 * @param {Plan} plan
 * @param {Partial<Deviations>} deviations
 * @param {{ draws?: number, seed?: number, progress?: Progress }} [options]
 * @returns {Promise<Tolerance>}
 */
export async function tolerance(engine, plan, deviations, options = {}) {
  const { draws = 100, seed = 1, progress = silent } = options;
  const whole = checkedDeviations(deviations);
  if (!(Number.isInteger(draws) && 1 <= draws && draws <= MOST_DRAWS))
    throw new InputError(
      _("{name} must be a whole number from {least} to {most}, not {value}", {
        name: "draws",
        least: 1,
        most: MOST_DRAWS,
        value: draws,
      }),
    );
  const exact = await exactPitch(engine, plan, () => progress(0, ""));
  const needed = [];
  let hits = 0;
  for (let number = 0; number < draws; number++) {
    const draw = new Draw(whole, seed, number);
    const pause = () => {
      progress(number / draws, "");
      return tick();
    };
    needed.push(await question(() => neededPitch(engine, plan, draw, exact, pause)));
    hits += Number(await question(async () => touches(engine, plan, draw)));
    progress((number + 1) / draws, "");
  }
  return { exact, needed: needed.sort((a, b) => a - b), hits };
}

/** Share of the dances that touch at the plan's own pitch, and bounds of the probability. @param {Tolerance} found @param {number} [confidence] */
export function touching({ needed, hits }, confidence = CONFIDENCE) {
  return chance(hits, needed.length, confidence);
}

/**
 * A pitch, m, at which the dance touches with at most that probability, with that confidence; infinite where
 * the draws are too few to say.
 * @param {Tolerance} found
 * @param {number} risk
 * @param {number} [confidence]
 */
export function pitchFor({ needed }, risk, confidence = CONFIDENCE) {
  const count = needed.length;
  let allowed = -1;
  while (allowed + 1 < count && atMost(allowed + 1, count, risk) <= 1 - confidence) allowed++;
  return allowed < 0 ? Infinity : needed[count - 1 - allowed];
}
