// Where a route bends left and right, and by how much it has turned. Twin of analysis/bends.py.

import { withArena } from "./arena.js";
import { ANALYSIS_BENDS } from "./constants.js";
import { Route } from "./curves.js";
import { rint } from "./numbers.js";
import { countUpTo } from "./profile.js";

/** @typedef {"left" | "right" | "straight"} Turning */

const { STRAIGHT } = ANALYSIS_BENDS;
const [HEADING, CURVATURE, COLUMNS] = [2, 3, 4]; // of Route.evaluate

/** A route cut where it changes the side to which it bends. */
export class Bends {
  /** @param {Route} route */
  constructor(route) {
    this.route = route;
    /** Route positions at which it does, m, increasing. @type {number[]} */
    this.at = [];
    /** To which side it bends before, between and behind these. @type {Turning[]} */
    this.turnings = [];
    /** Where its parts start, m. */
    this.joints = route.joints.slice(0, -1);
    /** Its heading there, rad, that of the part. */
    this.starts = headings(route, this.joints);
    /** By how much it has turned by then, rad, left positive, kinks included. */
    this.turned = this.#turned(route.parts.map((part, i) => this.#side(part, this.joints[i])));
  }

  /** Note to which sides a part bends; its headings at its ends, rad. @param {number[]} part @param {number} start */
  #side(part, start) {
    return withArena(this.route.engine, (arena) => {
      const one = new Route(arena, [part]);
      const ends = one.evaluate([0, one.length]);
      const both = (/** @type {number} */ column) => [ends[column], ends[COLUMNS + column]];
      for (const [way, turning] of sides(both(CURVATURE), one.length)) {
        if (turning === this.turnings.at(-1)) continue;
        if (this.turnings.length) this.at.push(start + way);
        this.turnings.push(turning);
      }
      return both(HEADING);
    });
  }

  /** @param {number[][]} faced headings at the ends of the parts, rad */
  #turned(faced) {
    let sum = 0;
    return faced.map(([first], n) => {
      if (n) {
        const [before, last] = faced[n - 1];
        const kink = first - last;
        sum += last - before + (kink - 2 * Math.PI * rint(kink / (2 * Math.PI)));
      }
      return sum;
    });
  }

  /** By how much the route has turned from its start to positions, m: rad, left positive. @param {number[]} positions */
  angle(positions) {
    const faced = headings(this.route, positions);
    return positions.map((s, n) => {
      const part = Math.max(countUpTo(this.joints, s) - 1, 0);
      return this.turned[part] + faced[n] - this.starts[part];
    });
  }
}

/** @param {Route} route @param {ArrayLike<number>} positions */
function headings(route, positions) {
  const found = route.evaluate(positions);
  return Array.from(positions, (_s, n) => found[COLUMNS * n + HEADING]);
}

/**
 * To which side a part bends, of these curvatures at its ends, and from where on, m.
 * @param {number[]} curvatures
 * @param {number} length m
 * @returns {Array<[number, Turning]>}
 */
function sides([first, last], length) {
  if (first * last < 0 && Math.min(Math.abs(first), Math.abs(last)) > STRAIGHT)
    return [
      [0, side(first)],
      [(length * first) / (first - last), side(last)],
    ];
  return [[0, side(Math.abs(first) > Math.abs(last) ? first : last)]];
}

/** @param {number} curvature @returns {Turning} */
function side(curvature) {
  if (Math.abs(curvature) <= STRAIGHT) return "straight";
  return curvature > 0 ? "left" : "right";
}
