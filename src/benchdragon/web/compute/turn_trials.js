// Turns that a search tries: what is sought of them, their unknowns, and how sampling judges them. Twin of
// solve/turn_trials.py.

import { _ } from "../words.js";
import { doubles, withArena } from "./arena.js";
import { hold, spend } from "./budget.js";
import { BOX, CURVE, SEARCH, SOLVE_TURN, SOLVE_TURN_TRIALS } from "./constants.js";
import { radians } from "./curves.js";
import { greatest } from "./dragon.js";
import { InputError, finite, positive } from "./errors.js";
import { evenly } from "./lists.js";
import { seamsOf } from "./nearby.js";
import { linkLength } from "./numbers.js";
import { Obstacle } from "./obstacle.js";
import { builtDragon } from "./plan.js";
import { discOf } from "./plan_routes.js";
import { QUANTITIES, givenLimits } from "./quantities.js";
import { searchRoom } from "./tables.js";
import { builtTurn, reachOf } from "./turns.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./arena.js").Placements} Placements */
/** @typedef {import("./dragon.js").Dragon} Dragon */
/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./quantities.js").Quantity} Quantity */
/** @typedef {import("./quantities.js").QuantityName} QuantityName */
/** @typedef {"length" | "way" | "speed" | "disc" | "acceleration"} Objective */
/** What a turn comes to, by name, in SI units. @typedef {Record<string, number>} Figures */
/** What a turn comes to; of speeds and the like in each part of it, of the disc to each of its ends. @typedef {{ figures: Figures, peaks: Record<string, number[]> }} Tried */

/**
 * What is sought of a turn, and what it must keep besides the plan's limits.
 * @typedef {object} TurnGoal
 * @property {Objective} [objective]
 * @property {number} [least_radius] of any bend, m
 * @property {number} [longest] length of the turn itself, m
 * @property {number} [longest_way] whole way inside the disc, m
 */

const { JUDGED, PLACED } = SOLVE_TURN_TRIALS;
const { BENCHES, CLEAR_BENCHES, CLEAR_STEP, NOWHERE, DEEPEST, WIDEST, LONGEST_EASE, WIDER } =
  SOLVE_TURN_TRIALS;
/** Worth of the worst of a limit that is exceeded by all of itself; by what share one may be exceeded. */
export const { WORSE, EXCEEDED } = SOLVE_TURN_TRIALS;
// Parts of the head's way through a turn, each with a greatest speed of its own: what is greatest of all has
// edges, where one part takes over from another, and so none of them may hide another.
const PARTS = 12;
/** How far the head goes at a time, m: in the search all over the family and in the local one. @type {number[]} */
export const STEPS = SOLVE_TURN_TRIALS.STEPS;

/** @type {Record<Objective, () => string>} */
const OBJECTIVES = {
  length: () => _("shortest turn"),
  way: () => _("shortest path inside the disc"),
  speed: () => _("greatest head speed"),
  disc: () => _("smallest disc"),
  acceleration: () => _("least peak total acceleration"),
};

/** A goal, checked, with what it leaves out. @param {TurnGoal} goal @returns {Required<TurnGoal>} */
export function wholeGoal(goal) {
  const { objective = "way", least_radius = 0, longest = Infinity, longest_way = Infinity } = goal;
  if (!(objective in OBJECTIVES)) {
    const values = { known: Object.keys(OBJECTIVES).join(", "), name: objective };
    throw new InputError(_("wanted one of {known}, not {name}", values));
  }
  finite("least_radius", least_radius, "m");
  for (const [name, value] of Object.entries({ longest, longest_way }))
    if (Number.isFinite(value)) positive(name, value, "m");
  return { objective, least_radius, longest, longest_way };
}

/** Boxes that stand, with scratch for as many: `standing.scratch_for`. @param {Arena} arena @param {Numbers} boxes */
function standingScratch(arena, boxes) {
  const [count] = boxes.shape;
  const [first, second, number] = [0, 1, 2].map(() => arena.array("q", count));
  const near = arena.array("d", Math.max(count, 2), BOX.BOX_COLUMNS);
  return { boxes, near, number, first, second, members: arena.whole([0]) };
}

/** Judges turns of a plan's family by sampling. */
export class TurnEvaluator {
  /**
   * @param {Arena} arena which holds what lasts
   * @param {Plan} plan
   * @param {Required<TurnGoal>} goal
   */
  constructor(arena, plan, goal) {
    const { route } = plan.tables;
    if (route.kind !== "turn")
      throw new InputError(_("a best turn is sought for plans whose route is a turn"));
    this.engine = arena.engine;
    this.plan = plan;
    this.goal = goal;
    /** What sampling is corrected by: the exact figure is so many times the sampled one. @type {Figures} */
    this.factors = {};
    this.step = STEPS[0];
    this.evaluations = 0;
    this.disc = discOf(plan.tables);
    this.obstacles = plan.obstacles().map((obstacle) => unplaced(obstacle, route));
    const dragon = builtDragon(arena, plan.tables.dragon);
    this.few = dragon.first(arena, Math.min(BENCHES, dragon.benches));
    this.more = dragon.first(arena, Math.min(CLEAR_BENCHES, dragon.benches));
    this.narrowest = Math.max(WIDER * 0.5 * greatest(dragon.link), goal.least_radius);
    this.limits = Object.entries(givenLimits(plan.tables.limits));
    this.search = searchRoom(arena, 2, 1, 1);
    this.standing = this.obstacles.map((obstacle) => standingScratch(arena, obstacle.boxes(arena)));
  }

  /** The figure that is to be small. */
  get sought() {
    const { objective } = this.goal;
    return objective === "acceleration" ? "total_acceleration" : objective;
  }

  /** Quantities that a turn is judged by: speed, what is limited, and what is sought. */
  get quantities() {
    const wanted = new Set(["speed", this.sought, ...this.limits.map(([name]) => name)]);
    return Object.values(QUANTITIES).filter(({ name }) => wanted.has(name));
  }

  /** Ranges of the unknowns: joints, what the family has, and the clothoids' length if free. */
  get bounds() {
    const { turn } = this.plan.tables;
    const { disc, narrowest } = this;
    /** @type {Array<[number, number]>} */
    const joints = [turn.entry_radius, turn.exit_radius].map((radius) =>
      radius === null ? [DEEPEST * disc, disc] : [radius, radius],
    );
    /** @type {[number, number]} */
    const radius = [narrowest, Math.max(WIDEST * disc, 1.01 * narrowest)];
    /** @type {Record<string, Array<[number, number]>>} */
    const inner = {
      "arc-arc": [[Math.log(0.2), Math.log(5)]],
      "arc-line-arc": [radius, radius],
      "arc-arc-arc": [radius, [-1 / narrowest, 1 / narrowest], radius],
    };
    /** @type {Array<[number, number]>} */
    const ease = this.goal.objective === "acceleration" ? [[0, LONGEST_EASE]] : [];
    return [...joints, ...inner[turn.family], ...ease];
  }

  /** What the unknowns say in a plan's [turn]. @param {number[]} x */
  table(x) {
    const { family } = this.plan.tables.turn;
    const [entry_radius, exit_radius, ...inner] = x;
    /** @type {Record<string, unknown>} */
    const said = { entry_radius, exit_radius };
    if (this.goal.objective === "acceleration") said.ease = inner.pop();
    if (family === "arc-arc") return { ...said, ratio: Math.exp(inner[0]) };
    if (family === "arc-arc-arc") [said.curvature] = inner.splice(1, 1);
    return { ...said, radii: inner };
  }

  /** The turn of these unknowns: throws an InputError if there is none. @param {number[]} x */
  turn(x) {
    const { route, turn } = this.plan.tables;
    return builtTurn(this.engine, { ...turn, ...this.table(x) }, route.pitch, this.disc);
  }

  /**
   * What a turn comes to, null if there is none; clearance only if the rest is within limits, or `complete`.
   * @param {number[]} x @param {boolean} complete
   * @returns {Figures | null}
   */
  figures(x, complete) {
    return this.tried(x, complete)?.figures ?? null;
  }

  /**
   * The same, with what the greatest of each quantity is in each part of the turn, and the radii of all.
   * @param {number[]} x @param {boolean} complete
   * @returns {Tried | null}
   */
  tried(x, complete) {
    this.evaluations++;
    const turn = this.#turnOrNull(x);
    if (!turn) return null;
    return withArena(this.engine, (arena) => {
      const rows = turn.rows(arena, 1, 1000);
      const { length, leastRadius: radius, joints } = turn;
      /** @type {Record<string, number[]>} */
      const peaks = { disc: [reachOf(arena, rows), joints.entry, joints.exit] };
      /** @type {Figures} */
      const figures = { length, way: turn.way(this.disc), disc: Math.max(...peaks.disc), radius };
      if (radius < 0.98 * this.narrowest) return { figures, peaks };
      Object.assign(peaks, this.#rates(arena, rows));
      for (const { name } of this.quantities) figures[name] = Math.max(...peaks[name]);
      const kept = Object.values(this.rooms(figures)).every((room) => room >= 0);
      if (!complete && !kept) return { figures, peaks };
      figures.clearance = this.#clearance(arena, rows);
      if (this.obstacles.length) figures.obstacles = this.#obstacleRoom(arena, rows);
      return { figures, peaks };
    });
  }

  /** @param {number[]} x */
  #turnOrNull(x) {
    try {
      return this.turn(x);
    } catch (error) {
      if (error instanceof InputError) return null;
      throw error;
    }
  }

  /** How much nearer benches near the turn might come to obstacles, m; negative: they may not. @param {Arena} arena @param {Numbers} rows */
  #obstacleRoom(arena, rows) {
    const [first, last] = endsOf(rows);
    const from = first - this.few.extent;
    const count = 2 * Math.ceil((last - from) / (2 * CLEAR_STEP));
    hold(PLACED * count);
    const at = evenly(from, last, count);
    spend(JUDGED * count * this.standing.reduce((sum, { boxes }) => sum + boxes.shape[0], 0));
    const out = arena.array("d", at.length, 4);
    this.engine.call("bd_route_evaluate", rows, arena.vector(at), out);
    const spans = arena.table(at.filter((_s, n) => n % 2 === 0).map((s, n) => [s, at[2 * n + 1]]), 2); // prettier-ignore
    let least = Infinity;
    for (const [n, obstacle] of this.obstacles.entries()) {
      if (obstacle.forbids(arena, out).some(Boolean)) return -1;
      for (const sizes of differentSizes(this.few)) {
        const link = arena.vector([linkLength(sizes[0], sizes[2], sizes[3])]);
        const seams = seamsOf(arena, rows);
        const bench = { rows, link, sizes: arena.table(sizes.map((size) => [size]), 1), seams }; // prettier-ignore
        const note = arena.full([SEARCH.NOTES], 0);
        doubles(note)[SEARCH.NEAREST] = Infinity;
        this.engine.call(
          "bd_standing_look_along", bench, this.standing[n], this.search, spans, note,
        ); // prettier-ignore
        const near = doubles(note)[SEARCH.NEAREST];
        least = Math.min(least, near - obstacle.radius - obstacle.margin);
      }
    }
    return least + (this.factors.obstacles ?? 0);
  }

  /** The greatest of each quantity with the head at 1 m/s in each part of its way. @param {Arena} arena @param {Numbers} rows @returns {Record<string, number[]>} */
  #rates(arena, rows) {
    const places = this.#places(arena, rows, this.few, this.step);
    const told = this.quantities.map(({ name }) => [name, Array(PARTS).fill(Infinity)]);
    if (!places) return Object.fromEntries(told);
    const { row, u, x, y, ratio } = places;
    const [handles, slots] = u.shape;
    const [change, turn] = [arena.array("d", handles, slots), arena.array("d", handles - 1, slots)];
    const values = arena.array("d", slots);
    const { links } = this.few;
    this.engine.call("bd_chain_rates", rows, links, row, u, x, y, ratio, change, turn);
    const most = this.quantities.map(({ name, kind }) => {
      this.engine.call("bd_drive_greatest_in_slots", rows, places, change, turn, 1, 0, kind, values);
      const factor = this.factors[name] ?? 1;
      return [name, partsOf(doubles(values)).map((some) => greatest(some) * factor)];
    });
    return Object.fromEntries(most);
  }

  /** @param {Arena} arena @param {Numbers} rows */
  #clearance(arena, rows) {
    const places = this.#places(arena, rows, this.more, CLEAR_STEP);
    if (!places) return -1;
    const { sizes } = this.more;
    const [near] = this.engine.call("bd_box_least_distance", sizes, places.x, places.y);
    return near + (this.factors.clearance ?? 0);
  }

  /**
   * The dragon from where its head enters the turn to where its tail has left it; null if it cannot stand.
   * @param {Arena} arena @param {Numbers} rows @param {Dragon} dragon @param {number} step m
   * @returns {Placements | null}
   */
  #places(arena, rows, dragon, step) {
    const [first, out] = endsOf(rows);
    const last = out + dragon.extent;
    const count = Math.ceil((last - first) / step) + 1;
    hold(PLACED * count * (dragon.benches + 1));
    const at = arena.vector(evenly(first, last, count));
    spend(JUDGED * (dragon.benches + 1) * count);
    const places = arena.placements(dragon.benches + 1, at.size);
    const [stands] = this.engine.call(
      "bd_step_bounds_place_chain", rows, dragon.links, at, 0, at.size, places,
    ); // prettier-ignore
    return stands ? places : null;
  }

  /** What is left of each limit, as a share of it; negative where it is exceeded. @param {Figures} found */
  rooms(found) {
    const { goal, narrowest, plan } = this;
    const width = this.few.width[0];
    /** @type {Figures} */
    const rooms = { radius: found.radius / narrowest - 1 };
    if (goal.objective !== "disc") rooms.disc = 1 - found.disc / this.disc;
    if (Number.isFinite(goal.longest)) rooms.length = 1 - found.length / goal.longest;
    if (Number.isFinite(goal.longest_way)) rooms.way = 1 - found.way / goal.longest_way;
    for (const [name, limit] of this.limits) {
      if (name === this.sought) continue;
      const { power } = QUANTITIES[/** @type {QuantityName} */ (name)];
      const peak = (found[name] ?? Infinity) * plan.tables.walk.speed ** power;
      rooms[name] = 1 - peak / limit;
    }
    if ("clearance" in found) rooms.clearance = (found.clearance - plan.tables.limits.margin) / width;
    if ("obstacles" in found) rooms.obstacles = found.obstacles / width;
    return Object.fromEntries(Object.entries(rooms).map(([name, room]) => [name, Math.max(room, -1)]));
  }

  /** The rooms of `rooms`, those with parts for each part. @param {Tried} tried @param {string[]} names */
  roomsOfParts({ figures, peaks }, names) {
    const whole = this.rooms(figures);
    const limits = Object.fromEntries(this.limits);
    return names.flatMap((name) => {
      if (name === "disc") return peaks.disc.map((reach) => 1 - reach / this.disc);
      if (!(name in peaks)) return [whole[name]];
      const { power } = QUANTITIES[/** @type {QuantityName} */ (name)];
      const allowed = limits[name] / this.plan.tables.walk.speed ** power;
      // Near a fold speeds run away as one over a root: their squares upside down are nearly straight.
      return peaks[name].map((peak) =>
        peak < SOLVE_TURN.HOPELESS ? 0.5 * ((allowed / Math.max(peak, 0.1 * allowed)) ** 2 - 1) : -1,
      );
    });
  }

  /** What the parts of a figure are where there is no turn. @param {string} name @returns {number[]} */
  hopeless(name) {
    return Array(name === "disc" ? 3 : PARTS).fill(SOLVE_TURN.HOPELESS);
  }

  /** What is to be small, in parts. @param {Tried} tried */
  valuesOfParts({ figures, peaks }) {
    return peaks[this.sought] ?? [figures[this.sought]];
  }

  /** What the global search makes small: the objective, or how far limits are exceeded. @param {number[]} x */
  score(x) {
    const found = this.figures(x, false);
    // Small radii and short clothoids are likelier to exist.
    if (!found) return NOWHERE * (1 + x.slice(2).reduce((sum, one) => sum + Math.abs(one), 0));
    const rooms = Object.values(this.rooms(found));
    const exceeded = -rooms.reduce((sum, room) => sum + Math.min(room + EXCEEDED, 0), 0);
    return exceeded > 0 ? WORSE * (1 + exceeded) : found[this.sought];
  }
}

/** Values one after another in PARTS lists. @param {Float64Array} values */
function partsOf(values) {
  const border = (/** @type {number} */ n) => Math.round((n * values.length) / PARTS);
  return Array.from({ length: PARTS }, (_part, n) => values.subarray(border(n), border(n + 1)));
}

/** Where a turn begins and ends, m. @param {Numbers} rows of its route */
function endsOf(rows) {
  const view = doubles(rows);
  const [count, columns] = rows.shape;
  return [1, count - 1].map((row) => view[row * columns + CURVE.S_START]);
}

/** The sizes of benches, each kind once. @param {Dragon} dragon */
function differentSizes({ length, width, front_inset, rear_inset }) {
  const kinds = new Map();
  length.forEach((one, i) => {
    const sizes = [one, width[i], front_inset[i], rear_inset[i]];
    kinds.set(sizes.join(), sizes);
  });
  return /** @type {number[][]} */ ([...kinds.values()]);
}

/** An obstacle as it lies to the route before that is moved to its place. @param {Obstacle} obstacle @param {{ at: [number, number] | null, turned: number }} route */
function unplaced(obstacle, { at, turned }) {
  const back = -radians(turned);
  const [x, y] = at ?? [0, 0];
  const [c, s] = [Math.cos(back), Math.sin(back)];
  return obstacle.moved(back, [s * y - c * x, -s * x - c * y]);
}
