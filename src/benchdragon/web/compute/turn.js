// Better turns: a global search over a family, then a local one, then exact figures of what it found. Twin of
// solve/turn.py, but for fronts of turns, which the command line finds.

import { _ } from "../words.js";
import { answered, now } from "./answer.js";
import { withArenaAsync } from "./arena.js";
import { question } from "./budget.js";
import { SOLVE_MINIMA, SOLVE_TURN } from "./constants.js";
import { leastClearance } from "./contact.js";
import { InputError, NoSolutionError } from "./errors.js";
import { greatestHeadSpeed } from "./head_speed.js";
import { constrainedPoint, downhillPoint, lowPoints } from "./minima.js";
import { leastDistance } from "./obstacles.js";
import { QUANTITIES } from "./quantities.js";
import { greatestOf } from "./speed.js";
import { part } from "./stages.js";
import { silent, tick } from "./tick.js";
import { EXCEEDED, STEPS, TurnEvaluator, WORSE, wholeGoal } from "./turn_trials.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./turn_trials.js").Figures} Figures */
/** @typedef {import("./turn_trials.js").TurnGoal} TurnGoal */
/** @typedef {import("./turns.js").Turn} Turn */

/**
 * The best turn that was found.
 * @typedef {object} BestTurn
 * @property {Plan} plan the plan with this turn
 * @property {Turn} turn the turn itself
 * @property {Answer} objective its value; no bound on better ones is known
 * @property {number} length of the turn itself, m
 * @property {number} way whole way inside the disc, m
 * @property {Answer | null} headSpeed the greatest constant head speed under the plan's limits; null without
 *   a limit
 * @property {Answer} clearance the least over the whole manoeuvre
 * @property {string[]} active names of the limits that it just keeps: keys of `TurnEvaluator.rooms`
 */

const { SEARCHED, NARROWINGS, PRUDENCE, DEEP, ACTIVE, HOPELESS } = SOLVE_TURN;
const { LOCAL } = SOLVE_MINIMA;
// Rounds of a local search, as long as each is better than the one before by some share.
const [ROUNDS, BETTER] = [6, 1e-6];
const EXACT = 1e-6; // of speeds, as a share
const CLEAR = [1e-5]; // of distances, m

/**
 * The best turn of the plan's family for a wish, under the plan's limits.
 *
 * Limits are limits.speed with the head at walk.speed (or as fast as it may, if that is the wish), those of
 * accelerations and turning rates, limits.margin over the whole manoeuvre, until the tail is out, and the
 * margins of the venue and of obstacles. Joints that the plan says stay. The search is the same each time;
 * that nothing better exists is not shown.
 * @param {Engine} engine
 * @param {Plan} plan
 * @param {TurnGoal} [goal]
 * @param {{ progress?: Progress }} [options]
 * @returns {Promise<BestTurn>}
 */
export function bestTurn(engine, plan, goal = {}, { progress = silent } = {}) {
  const began = now();
  const wished = wholeGoal(goal);
  if (wished.objective === "speed" && plan.tables.limits.speed === null)
    throw new InputError(_("the plan has no limit of speed: set limits.speed=2, for example"));
  plan.pace(engine); // a wrong one is told before the search, not after it
  const ask = async (/** @type {import("./arena.js").Arena} */ arena) => {
    const search = new TurnSearch(new TurnEvaluator(arena, plan, wished), progress);
    const starts = await search.globalStarts();
    return search.settled(starts, began);
  };
  return question(() => withArenaAsync(engine, ask));
}

/** A search for a turn: what judges turns, and who is told how far it is. */
class TurnSearch {
  /** @param {TurnEvaluator} evaluator @param {Progress} progress */
  constructor(evaluator, progress) {
    this.evaluator = evaluator;
    this.progress = progress;
    this.done = SEARCHED;
  }

  /** The best turns that are found all over the family. */
  async globalStarts() {
    const { evaluator } = this;
    const told = part(this.progress, 0, SEARCHED, _("global search"));
    const found = await lowPoints(
      (x) => evaluator.score(x),
      evaluator.bounds,
      (share) => {
        told(share, "");
        return tick();
      },
    );
    const starts = found.filter(({ score }) => score < WORSE).map(({ x }) => x);
    if (!starts.length) throw this.#none();
    return starts;
  }

  #none() {
    return new NoSolutionError(_("no turn of this family was found that keeps the limits"));
  }

  /** @param {string} text */
  #pause(text) {
    this.progress(this.done, text);
    return tick();
  }

  /** The local optimum near the best of these, by exact figures. @param {number[][]} starts @param {number} began */
  async settled(starts, began) {
    const { evaluator } = this;
    [, evaluator.step] = STEPS;
    const ends = [];
    for (const start of starts) ends.push(await this.#local(start));
    let x = this.#best(ends);
    for (let narrowing = 0; narrowing < NARROWINGS; narrowing++) {
      this.done = SEARCHED + ((1 - SEARCHED) * (narrowing + 1)) / (NARROWINGS + 1);
      x = await this.#local(x);
      await this.#pause(_("exact figures"));
      const { best, exceeded } = await this.#exact(x, began, PRUDENCE * 2 ** narrowing);
      if (!exceeded) return best;
    }
    throw this.#none();
  }

  /** The point of the best score. @param {number[][]} points */
  #best(points) {
    const scores = points.map((x) => this.evaluator.score(x));
    return points[scores.indexOf(Math.min(...scores))];
  }

  /** A local optimum within limits, and downhill from there, over the edges where one takes over. @param {number[]} x */
  async #local(x) {
    const { evaluator } = this;
    const names = Object.keys(evaluator.rooms(this.#complete(x)));
    const figures = (/** @type {number[]} */ point) => {
      const found = this.#tried(point);
      const values = evaluator.valuesOfParts(found);
      return { values, rooms: evaluator.roomsOfParts(found, names) };
    };
    const pause = () => this.#pause(_("local search"));
    const { bounds } = evaluator;
    const score = (/** @type {number[]} */ point) => evaluator.score(point);
    for (let round = 0; round < ROUNDS; round++) {
      const before = score(x);
      const found = await constrainedPoint(figures, bounds, x, LOCAL, pause);
      const best = this.#best([x, found]);
      x = this.#best([best, await downhillPoint(score, bounds, best, LOCAL, pause)]);
      if (!(before - score(x) > BETTER * Math.abs(before))) break;
    }
    return x;
  }

  /** All figures; of a turn that does not exist, hopeless ones. @param {number[]} x */
  #complete(x) {
    return this.#tried(x).figures;
  }

  /** The same with parts. @param {number[]} x @returns {import("./turn_trials.js").Tried} */
  #tried(x) {
    const { evaluator } = this;
    const names = ["length", "way", "disc", ...evaluator.quantities.map(({ name }) => name)];
    const bad = Object.fromEntries(names.map((name) => [name, HOPELESS]));
    /** @type {Figures} */
    const none = { ...bad, radius: 0, clearance: -1 };
    if (evaluator.obstacles.length) none.obstacles = -1;
    const found = evaluator.tried(x, true);
    const peaks = Object.fromEntries(names.slice(2).map((name) => [name, evaluator.hopeless(name)]));
    return { figures: { ...none, ...found?.figures }, peaks: { ...peaks, ...found?.peaks } };
  }

  /**
   * The turn's exact figures, and whether one exceeds a limit; the evaluator is corrected by them.
   * @param {number[]} x @param {number} began @param {number} prudence
   * @returns {Promise<{ best: BestTurn, exceeded: boolean }>}
   */
  async #exact(x, began, prudence) {
    const { evaluator } = this;
    const sampled = this.#complete(x);
    const said = Object.entries(evaluator.table(x)).map(([key, value]) => [`turn.${key}`, value]);
    let plan = evaluator.plan.withValues(Object.fromEntries(said));
    const { exact, clearance } = await this.#exactFigures(plan, sampled);
    const rooms = evaluator.rooms(exact);
    this.#correct(sampled, exact, prudence);
    if (evaluator.goal.objective === "disc") plan = plan.withValues({ "disc.radius": exact.disc });
    const limited = plan.tables.limits.speed !== null;
    const headSpeed = limited ? await greatestHeadSpeed(evaluator.engine, plan) : null;
    const turn = evaluator.turn(x);
    const best = {
      plan,
      turn,
      objective: this.#objective(exact, headSpeed, began),
      length: turn.length,
      way: turn.way(plan.tables.disc.radius ?? evaluator.disc),
      headSpeed,
      clearance,
      active: Object.keys(rooms).filter((name) => rooms[name] <= ACTIVE),
    };
    return { best, exceeded: Object.values(rooms).some((room) => room < -EXCEEDED) };
  }

  /** @param {Figures} exact @param {Answer | null} headSpeed @param {number} began */
  #objective(exact, headSpeed, began) {
    const { goal, plan, sought, evaluations } = this.evaluator;
    let [value, unit] = [exact[sought], "m"];
    if (goal.objective === "speed") [value, unit] = [headSpeed?.value ?? NaN, "m/s"];
    else if (goal.objective === "acceleration")
      [value, unit] = [value * plan.tables.walk.speed ** 2, "m/s^2"];
    const assumptions = [_("best that was found in this family; better ones may exist")];
    return answered(value, value, value, unit, { assumptions, evaluations, seconds: now() - began });
  }

  /** Sampled figures made exact, on the safe side, and the least clearance. @param {Plan} plan @param {Figures} sampled */
  #exactFigures(plan, sampled) {
    const { engine } = this.evaluator;
    // How far to look for the least clearance, m: somewhat farther than what sampling saw.
    const within = Math.max(1.2 * sampled.clearance, plan.tables.limits.margin, 0.05);
    return withArenaAsync(engine, async (arena) => {
      const walk = plan.build(arena);
      const { joints } = walk.route;
      const [first, last] = [joints[1], walk.headWhereTail(joints[joints.length - 2])];
      /** @type {Figures} */
      const exact = { ...sampled };
      for (const quantity of this.#judged(sampled)) {
        const peak = await greatestOf(walk, quantity, first, last, { tolerance: EXACT });
        exact[quantity.name] = peak.upper;
      }
      const [start, end] = [walk.timeAt(first), walk.timeAt(last)];
      const clearance = await leastClearance(walk, start, end, { within, tolerances: CLEAR });
      const rooms = [];
      for (const obstacle of plan.obstacles())
        rooms.push(
          sure(
            await leastDistance(walk, obstacle, start, end, { tolerances: CLEAR, progress: silent }),
          ) - obstacle.margin,
        );
      if (rooms.length) exact.obstacles = Math.min(...rooms);
      exact.clearance = sure(clearance);
      return { exact, clearance };
    });
  }

  /** Which of the sampled figures can be made exact: speeds and what else is limited or sought. @param {Figures} sampled */
  #judged(sampled) {
    return Object.values(QUANTITIES).filter(({ name }) => (sampled[name] ?? HOPELESS) < HOPELESS);
  }

  /** Tell the judge by how much sampling flatters a turn like this, and somewhat more. @param {Figures} sampled @param {Figures} exact @param {number} prudence */
  #correct(sampled, exact, prudence) {
    const { factors } = this.evaluator;
    for (const { name } of this.#judged(sampled)) {
      const change = (exact[name] / sampled[name]) * (1 + prudence);
      factors[name] = (factors[name] ?? 1) * change;
    }
    for (const name of ["clearance", "obstacles"])
      if (name in exact) {
        const less = Math.min(exact[name] - sampled[name] - prudence, 0);
        factors[name] = (factors[name] ?? 0) + less;
      }
  }
}

/** At most a distance, m; where benches touch, as if they were DEEP in one another. @param {Answer} distance */
function sure({ value, lower }) {
  return value > 0 ? lower : -DEEP;
}
