// Low points of a function of several unknowns within ranges: all over them, then nearby. Twin of
// solve/minima.py, with differential evolution, a trust region of quadratic models in place of COBYQA, and
// Nelder and Mead's simplex.
//
// A point is a list of numbers, ranges are pairs of numbers; where both are the same the unknown stays.

import { SOLVE_MINIMA } from "./constants.js";
import { dot, identity, leastQuadratic, times, updated } from "./quadratic.js";
import { PCG64 } from "./random.js";

/** @typedef {number[]} Point */
/** @typedef {(x: Point) => number} Score */
/** @typedef {Array<[number, number]>} Ranges */
/** Called after each evaluation: lets go, and may throw. @typedef {() => Promise<unknown>} Pause */
/** A point and its score. @typedef {{ x: Point, score: number }} Scored */
/** @typedef {import("./quadratic.js").Matrix} Matrix */
/** What is known about a point, slopes of all values and rooms, and how far differences were taken. @typedef {{ here: Figures, slopes: Matrix, bends: Matrix, curvature: Matrix, width: number }} Model */
/** What is known at a point: values the greatest of which is to be small, and rooms none of which may be negative. @typedef {{ values: number[], rooms: number[] }} Figures */

const { MEMBERS, GENERATIONS, SPREAD, SIMPLEX } = SOLVE_MINIMA;
// Seeds of the searches all over the ranges: twice as many as Python's, which end in other valleys.
const SEEDS = [1, 2, 3, 4];
// Differential evolution as SciPy's: shares of a step, between which it is drawn for each generation, and
// the chance that an unknown is taken from it.
const STEPS = [0.5, 1];
const CROSSED = 0.7;
// The trust region: its first and last radius, of unknowns from 0 to 1, how much of what a model promises
// must come true to go on and to dare more, and what it is then multiplied by.
const [FIRST_REGION, LAST_REGION] = [0.05, 1e-7];
const [KEPT, GOOD, NARROWER, WIDER] = [0.1, 0.7, 0.3, 2];
// Differences are taken over so much of the region, and no less.
const [DIFFERENCE, LEAST_DIFFERENCE] = [0.1, 1e-6];
// What a room that is exceeded by all of itself costs, in shares of the value; what is left of each; and how
// much the slope of the value is taken to change at first over the whole range of an unknown.
const [PENALTY, LEFT, CURVED] = [20, 1e-9, 0.1];
// The curvature along what the greatest value is to become, which has none.
const FLAT = 0.01;
// When the simplex has come to rest.
const [FINE_POINT, FINE_SCORE] = [1e-5, 1e-6];

/** The same point but for one number. @param {Point} x @param {number} k @param {number} value */
function replaced(x, k, value) {
  return x.map((one, n) => (n === k ? value : one));
}

/** The unknowns that may vary, as numbers from 0 to 1. */
class Unknowns {
  /** @param {Ranges} ranges @param {Point} [fixed] what the others are */
  constructor(ranges, fixed = ranges.map(([low]) => low)) {
    this.ranges = ranges;
    this.fixed = fixed;
    this.free = ranges.flatMap(([low, high], n) => (high > low ? [n] : []));
  }

  /** @param {Point} z @returns {Point} */
  point(z) {
    const x = [...this.fixed];
    this.free.forEach((n, k) => {
      const [low, high] = this.ranges[n];
      x[n] = low + (high - low) * z[k];
    });
    return x;
  }

  /** @param {Point} x @returns {Point} */
  shares(x) {
    return this.free.map((n) => {
      const [low, high] = this.ranges[n];
      return (x[n] - low) / (high - low);
    });
  }
}

/**
 * Low points that are found all over the ranges by one search after another, and their scores.
 * @param {Score} score
 * @param {Ranges} ranges
 * @param {(share: number) => Promise<unknown>} pause told how far it is
 */
export async function lowPoints(score, ranges, pause) {
  const unknowns = new Unknowns(ranges);
  const found = [];
  for (const [n, seed] of SEEDS.entries()) {
    const told = (/** @type {number} */ share) => pause((n + share) / SEEDS.length);
    const value = (/** @type {Point} */ z) => score(unknowns.point(z));
    const evolution = new Evolution(value, unknowns.free.length, new PCG64(seed));
    const best = await evolution.evolve(told);
    found.push({ x: unknowns.point(best.x), score: best.score });
  }
  return found;
}

/** Differential evolution, each member replaced at once by what is better. */
class Evolution {
  /** @param {Score} score of numbers from 0 to 1 @param {number} count of them @param {PCG64} dice */
  constructor(score, count, dice) {
    this.score = score;
    this.count = count;
    this.dice = dice;
    const members = 2 ** Math.ceil(Math.log2(MEMBERS * Math.max(count, 1)));
    /** The best is the first. @type {Scored[]} */
    this.members = this.#spread(members).map((x) => ({ x, score: Infinity }));
  }

  /** Points whose unknowns are each spread evenly. @param {number} members */
  #spread(members) {
    /** @type {Point[]} */
    const points = Array.from({ length: members }, () => []);
    for (let k = 0; k < this.count; k++)
      this.#shuffled(members).forEach((place, m) => {
        points[m].push((place + this.dice.double()) / members);
      });
    return points;
  }

  /** The numbers from 0 on in any order. @param {number} count */
  #shuffled(count) {
    const order = Array.from({ length: count }, (_place, n) => n);
    for (let n = count - 1; n > 0; n--) {
      const m = this.#below(n + 1);
      [order[n], order[m]] = [order[m], order[n]];
    }
    return order;
  }

  /** @param {number} count */
  #below(count) {
    return Math.min(Math.floor(this.dice.double() * count), count - 1);
  }

  /** The best member in the end. @param {(share: number) => Promise<unknown>} pause */
  async evolve(pause) {
    const { members } = this;
    const work = (GENERATIONS + 1) * members.length;
    for (let m = 0; m < members.length; m++) {
      members[m].score = this.score(members[m].x);
      this.#promote(m);
      await pause((m + 1) / work);
    }
    for (let generation = 1; generation <= GENERATIONS && !this.#settled; generation++) {
      const step = STEPS[0] + (STEPS[1] - STEPS[0]) * this.dice.double();
      for (let m = 0; m < members.length; m++) {
        const x = this.#trial(m, step);
        const score = this.score(x);
        if (score <= members[m].score) {
          members[m] = { x, score };
          this.#promote(m);
        }
        await pause((generation * members.length + m + 1) / work);
      }
    }
    return members[0];
  }

  /** Put a member first if it is the best. @param {number} m */
  #promote(m) {
    const { members } = this;
    if (members[m].score < members[0].score) [members[0], members[m]] = [members[m], members[0]];
  }

  /** Whether all members have about one score. */
  get #settled() {
    const scores = this.members.map(({ score }) => score);
    const mean = scores.reduce((sum, score) => sum + score, 0) / scores.length;
    const square = scores.reduce((sum, score) => sum + (score - mean) ** 2, 0) / scores.length;
    return Math.sqrt(square) <= SPREAD * Math.abs(mean);
  }

  /** A member that steps from the best, crossed with member m. @param {number} m @param {number} step */
  #trial(m, step) {
    const { members, dice } = this;
    const [one, other] = this.#shuffled(members.length).filter((n) => n !== m);
    const always = this.#below(this.count);
    return members[m].x.map((own, k) => {
      if (k !== always && dice.double() >= CROSSED) return own;
      const z = members[0].x[k] + step * (members[one].x[k] - members[other].x[k]);
      return z < 0 || z > 1 ? dice.double() : z;
    });
  }
}

/**
 * A low point near x at which none of the rooms is negative: a quadratic model of the value and linear ones of
 * the rooms are trusted within a region that narrows where they fail.
 * @param {(x: Point) => Figures} figures
 * @param {Ranges} ranges
 * @param {Point} x
 * @param {number} most evaluations, but for those of the last model
 * @param {Pause} pause
 */
export async function constrainedPoint(figures, ranges, x, most, pause) {
  const unknowns = new Unknowns(ranges, x);
  const start = unknowns.shares(x).map((share) => Math.min(Math.max(share, 0), 1));
  const region = new Region(async (z) => {
    const found = figures(unknowns.point(z));
    await pause();
    return found;
  });
  return unknowns.point(await region.lowest(start, most));
}

/** A region of numbers from 0 to 1 in which models are trusted. */
class Region {
  /** @param {(z: Point) => Promise<Figures>} figures */
  constructor(figures) {
    this.figures = figures;
    this.evaluations = 0;
    this.radius = FIRST_REGION;
    this.scale = 1;
  }

  /** @param {Point} z */
  #at(z) {
    this.evaluations++;
    return this.figures(z);
  }

  /** @param {Point} z where to begin @param {number} most evaluations */
  async lowest(z, most) {
    const first = await this.#at(z);
    this.scale = Math.abs(greatest(first.values)) || 1;
    let model = await this.#modelAt(z, first, identity(z.length, CURVED));
    while (this.radius > LAST_REGION && this.evaluations < most) {
      const { here } = model;
      const { step, promised, multipliers } = this.#best(z, model);
      const next = z.map((share, k) => Math.min(Math.max(share + step[k], 0), 1));
      const there = promised > 0 ? await this.#at(next) : here;
      const gained = this.#merit(here) - this.#merit(there);
      if (promised <= 0 || !(gained >= KEPT * promised)) {
        this.radius *= NARROWER;
        if (model.width > this.radius) model = await this.#modelAt(z, here, model.curvature);
        continue;
      }
      if (gained > GOOD * promised) this.radius = Math.min(WIDER * this.radius, FIRST_REGION);
      const ahead = await this.#modelAt(next, there, model.curvature);
      const before = pulled(model, multipliers);
      const change = pulled(ahead, multipliers).map((one, k) => one - before[k]);
      const moved = next.map((share, k) => share - z[k]);
      z = next;
      model = { ...ahead, curvature: updated(model.curvature, moved, change) };
    }
    return z;
  }

  /** What is to be small: a share of the value, and what is exceeded. @param {Figures} figures */
  #merit({ values, rooms }) {
    return greatest(values) / this.scale + PENALTY * lackOf(rooms);
  }

  /**
   * How all figures change about a point; not towards where it is hopeless.
   * @param {Point} z @param {Figures} here @param {Matrix} curvature
   * @returns {Promise<Model>}
   */
  async #modelAt(z, here, curvature) {
    const width = Math.max(DIFFERENCE * this.radius, LEAST_DIFFERENCE);
    const slopes = here.values.map(() => /** @type {number[]} */ ([]));
    const bends = here.rooms.map(() => /** @type {number[]} */ ([]));
    for (const k of z.keys()) {
      let [low, high] = [Math.max(z[k] - width, 0), Math.min(z[k] + width, 1)];
      let [a, b] = [await this.#at(replaced(z, k, low)), await this.#at(replaced(z, k, high))];
      if (isHopeless(a)) [low, a] = [z[k], here];
      if (isHopeless(b)) [high, b] = [z[k], here];
      const over = high > low ? high - low : Infinity;
      slopes.forEach((row, n) => row.push((b.values[n] - a.values[n]) / over / this.scale));
      bends.forEach((row, n) => row.push((b.rooms[n] - a.rooms[n]) / over));
    }
    return { here, slopes, bends, curvature, width: this.radius };
  }

  /**
   * The step that a model likes best, and by how much it promises to lower the merit. One more unknown is by
   * how much the greatest value rises.
   * @param {Point} z @param {Model} model
   */
  #best(z, { here, slopes, bends, curvature }) {
    const [top, size] = [greatest(here.values), z.length];
    const below = here.values.map((value) => (top - value) / this.scale);
    const rooms = here.rooms.map((room) => room - LEFT);
    const rows = [
      ...slopes.map((row) => [...row.map((one) => -one), 1]),
      ...bends.map((row) => [...row, 0]),
    ];
    const curved = [...curvature.map((row) => [...row, 0]), [...z.map(() => 0), FLAT]];
    const caps = [...slopes.map(() => Infinity), ...bends.map(() => PENALTY)];
    const low = [...z.map((share) => Math.max(-this.radius, -share)), -1];
    const high = [...z.map((share) => Math.min(this.radius, 1 - share)), 1];
    const rise = [...z.map(() => 0), 1];
    const found = leastQuadratic(curved, rise, rows, [...below, ...rooms], caps, low, high);
    const step = found.step.slice(0, size);
    const risen = greatest(slopes.map((row, n) => dot(row, step) - below[n]));
    const lack = lackOf(here.rooms) - lackOf(here.rooms.map((room, n) => room + dot(bends[n], step)));
    const promised = PENALTY * lack - risen - 0.5 * dot(step, times(curvature, step));
    return { step, promised, multipliers: found.multipliers };
  }
}

/** @param {number[]} values */
function greatest(values) {
  return values.reduce((most, value) => Math.max(most, value), -Infinity);
}

/** What rooms lack. @param {number[]} rooms */
function lackOf(rooms) {
  return rooms.reduce((sum, room) => sum + Math.max(LEFT - room, 0), 0);
}

/** Whether a room is exceeded by all of itself, as where nothing can be told. @param {Figures} figures */
function isHopeless({ rooms }) {
  return rooms.some((room) => room <= -1);
}

/** The slope of what multipliers make of the values and rooms. @param {Model} model @param {number[]} multipliers */
function pulled({ slopes, bends }, multipliers) {
  const count = slopes.length;
  return slopes[0].map((_one, k) => {
    const up = slopes.reduce((sum, row, n) => sum + multipliers[n] * row[k], 0);
    return bends.reduce((sum, row, n) => sum - multipliers[count + n] * row[k], up);
  });
}

/**
 * A low point downhill from x by Nelder and Mead's simplex, which goes over edges too.
 * @param {Score} score
 * @param {Ranges} ranges
 * @param {Point} x
 * @param {number} most evaluations
 * @param {Pause} pause
 */
export async function downhillPoint(score, ranges, x, most, pause) {
  const free = ranges.flatMap(([low, high], n) => (high > low ? [n] : []));
  const point = (/** @type {Point} */ z) => {
    const whole = [...x];
    free.forEach((n, k) => (whole[n] = Math.min(Math.max(z[k], ranges[n][0]), ranges[n][1])));
    return whole;
  };
  const start = free.map((n) => x[n]);
  const corners = free.map((n, k) => {
    const step = SIMPLEX * (ranges[n][1] - ranges[n][0]);
    return replaced(start, k, start[k] + (start[k] + step <= ranges[n][1] ? step : -step));
  });
  const simplex = new Simplex((z) => score(point(z)), most, pause);
  return point(await simplex.lowest([start, ...corners]));
}

/** Nelder and Mead's simplex, as SciPy moves it. */
class Simplex {
  /** @param {Score} score @param {number} most evaluations @param {Pause} pause */
  constructor(score, most, pause) {
    this.score = score;
    this.most = most;
    this.pause = pause;
    this.evaluations = 0;
    /** The lowest is the first. @type {Scored[]} */
    this.corners = [];
  }

  /** @param {Point} x @returns {Promise<Scored>} */
  async #at(x) {
    this.evaluations++;
    const score = this.score(x);
    await this.pause();
    return { x, score };
  }

  /** The lowest point that is found from these corners on. @param {Point[]} corners */
  async lowest(corners) {
    for (const x of corners) this.corners.push(await this.#at(x));
    this.#sort();
    while (this.evaluations < this.most && !this.#rests) {
      await this.#move();
      this.#sort();
    }
    return this.corners[0].x;
  }

  #sort() {
    this.corners.sort((a, b) => a.score - b.score);
  }

  /** Whether its corners lie as near together as wanted, and about as low. */
  get #rests() {
    const [best, ...others] = this.corners;
    return others.every(
      ({ x, score }) =>
        Math.abs(score - best.score) <= FINE_SCORE &&
        x.every((one, k) => Math.abs(one - best.x[k]) <= FINE_POINT),
    );
  }

  async #move() {
    const { corners } = this;
    const last = corners.length - 1;
    const [worst, best] = [corners[last], corners[0]];
    const middle = best.x.map((_one, k) => {
      return corners.slice(0, last).reduce((sum, { x }) => sum + x[k], 0) / last;
    });
    const along = (/** @type {number} */ far) =>
      this.#at(middle.map((one, k) => one + far * (one - worst.x[k])));
    const mirrored = await along(1);
    if (mirrored.score < best.score) {
      const farther = await along(2);
      corners[last] = farther.score < mirrored.score ? farther : mirrored;
    } else if (mirrored.score < corners[last - 1].score) corners[last] = mirrored;
    else {
      const outside = mirrored.score < worst.score;
      const nearer = await along(outside ? 0.5 : -0.5);
      const better = outside ? nearer.score <= mirrored.score : nearer.score < worst.score;
      if (better) corners[last] = nearer;
      else await this.#shrink();
    }
  }

  async #shrink() {
    const [best, ...others] = this.corners;
    for (const [n, { x }] of others.entries())
      this.corners[n + 1] = await this.#at(x.map((one, k) => best.x[k] + 0.5 * (one - best.x[k])));
  }
}
