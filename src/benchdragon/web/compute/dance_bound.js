// Which parts of a random dance on an inward spiral must be searched: a bound in closed form. Twin of
// solve/dance_bound.py.

import { CURVE, SOLVE_DANCE_BOUND } from "./constants.js";
import { doubles } from "./arena.js";
import { greatest } from "./dragon.js";
import { evenly, least } from "./lists.js";
import { between, greatestAbout, leastAbout } from "./smooth.js";

/** @typedef {import("../made/curves.js").Route} Route */
/** @typedef {import("./dragon.js").Dragon} Dragon */
/** @typedef {import("./strayed.js").Offset} Offset */
/** Head positions, m, between which the first `count` benches must be searched for contacts. @typedef {{ start: number, end: number, count: number }} Part */

const { STRETCH, MOST_ANGLE, MOST_ASIDE, MOST_WAY, GRID, STEEPER, ACROSS, ALONG, APART, ALIKE } =
  SOLVE_DANCE_BOUND;
const { SPARE, SPARE_ANGLE } = SOLVE_DANCE_BOUND;
/** So much of the route, in links of the whole dragon, a line that strays is known behind its head. */
export const { WAYS } = SOLVE_DANCE_BOUND;

/**
 * A function that tells the parts of a dance outside which no two non-adjacent benches come as near as so
 * many metres: see `open_parts` there.
 * @param {Route} route
 * @param {Dragon} dragon
 * @param {Float64Array} aside
 * @param {Offset | null} offset
 * @param {[number, number]} span
 * @returns {(wanted: number) => Part[]}
 */
export function openParts(route, dragon, aside, offset, span) {
  const row = doubles(route.rows).slice(0, CURVE.COLUMNS);
  const count = dragon.benches;
  const whole = [{ start: span[0], end: span[1], count }];
  const spiral = route.rows.shape[0] === 1 && row[CURVE.KIND] === CURVE.SPIRAL;
  if (!spiral || row[CURVE.U_END] >= row[CURVE.U_START] || count < 3) return () => whole;
  const bound = new Bound(route, row, dragon, aside, offset, span);
  if (!bound.holds) return () => whole;
  const stretches = Math.max(1, Math.trunc((span[1] - span[0]) / (STRETCH * least(dragon.link))));
  const borders = evenly(span[0], span[1], stretches + 1);
  return (wanted) => joined(borders, bound.openBenches(borders, wanted));
}

/** Parts made of neighbouring stretches with about as many open benches, where there are any. @param {number[]} ends @param {number[]} counts */
function joined(ends, counts) {
  /** @type {Part[]} */
  const parts = [];
  counts.forEach((count, n) => {
    const last = parts[parts.length - 1];
    const beside = last && last.end === ends[n] && count > 0;
    if (beside && Math.max(count, last.count) <= ALIKE * Math.min(count, last.count)) {
      last.end = ends[n + 1];
      last.count = Math.max(count, last.count);
    } else if (count) parts.push({ start: ends[n], end: ends[n + 1], count });
  });
  return parts;
}

/** Sums of a list, from 0 on. @param {Float64Array} values */
function summed(values) {
  const sums = new Float64Array(values.length + 1);
  values.forEach((value, i) => (sums[i + 1] = sums[i] + value));
  return sums;
}

/** The greatest of sizes. @param {Float64Array} values */
function greatestSize(values) {
  return values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
}

/** Bounds on benches beside an inward spiral while the head walks over a span; offsets outward. */
class Bound {
  /**
   * @param {Route} route
   * @param {Float64Array} row of the spiral
   * @param {Dragon} dragon
   * @param {Float64Array} aside
   * @param {Offset | null} offset
   * @param {[number, number]} span
   */
  constructor(route, row, dragon, aside, offset, [start, end]) {
    this.route = route;
    this.dragon = dragon;
    this.end = end;
    this.b = row[CURVE.P];
    this.centre = [row[CURVE.X], row[CURVE.Y]];
    const [x, y, heading, bend] = route.evaluate([end]);
    const [dx, dy] = [x - this.centre[0], y - this.centre[1]];
    const side = dy * Math.cos(heading) - dx * Math.sin(heading);
    const outward = side < 0 || Object.is(side, -0) ? -1 : 1;
    this.aside = aside.length
      ? aside.map((one) => outward * one)
      : new Float64Array(dragon.benches + 1);
    const above = this.#tabulated(start - MOST_WAY * dragon.extent - 1);
    this.mostStray = 0;
    this.slope = 0;
    this.grid0 = 0;
    this.stray = new Float64Array(0);
    this.more = new Float64Array(0);
    if (offset) this.#strayed(start - WAYS * dragon.extent - ALONG, offset, outward);
    this.most = greatestSize(this.aside) + this.mostStray + above;
    this.holds = this.#follows(Math.abs(bend));
    if (this.holds) this.#prepare();
  }

  /** Fill the table of radii; by how much the radius lies above it at most, m. @param {number} low */
  #tabulated(low) {
    this.places = evenly(low, this.end, 2 + Math.trunc((this.end - low) / APART));
    const found = this.route.evaluate(this.places);
    const [x, y] = this.centre;
    this.radius = this.places.map((_s, n) => Math.hypot(found[4 * n] - x, found[4 * n + 1] - y));
    const nearest = Math.max(this.radius[this.radius.length - 1], SPARE);
    return (0.125 * APART ** 2 * this.b ** 2) / nearest ** 3;
  }

  /** Fill the table of a line that strays. @param {number} low @param {Offset} offset @param {number} outward */
  #strayed(low, offset, outward) {
    const count = Math.ceil((this.end - low) / GRID);
    this.grid0 = low;
    const found = Array.from({ length: count }, (_place, n) => offset(low + n * GRID));
    this.stray = Float64Array.from(found, ([stray]) => outward * stray);
    this.slope = STEEPER * greatestSize(Float64Array.from(found, ([, slope]) => slope));
    this.mostStray = greatestSize(this.stray) + this.slope * GRID + ACROSS;
  }

  /** Whether all benches surely follow; bounds on the way along the route to each handle. @param {number} bend 1/m */
  #follows(bend) {
    const { link: links, benches } = this.dragon;
    const { aside, slope, mostStray, most } = this;
    this.apart = links.map((link, i) => Math.abs(aside[i + 1] - aside[i]) + slope * MOST_WAY * link);
    if (most * bend > MOST_ASIDE) return false;
    const { apart } = this;
    const roughly = summed(links.map((link, i) => link - apart[i]));
    const places = Array.from(links, (_link, i) => this.end - roughly[i] / (1 + most * bend));
    const found = this.route.evaluate(places);
    const [ways, shortest] = [new Float64Array(benches), new Float64Array(benches)];
    let sound = true;
    for (let i = 0; i < benches; i++) {
      const link = links[i];
      const local = Math.abs(found[4 * i + 3]);
      const angle = 0.5 * (local / (1 - most * local)) * MOST_WAY * link;
      const chord = Math.max(1 - angle ** 2 / 6, SPARE);
      const longest = apart[i] * angle + Math.hypot(link, apart[i] * angle);
      const short = Math.sqrt(Math.max(link ** 2 - apart[i] ** 2, 0)) - apart[i] * angle;
      ways[i] = longest / (chord * (1 - (Math.abs(aside[i]) + mostStray) * local));
      shortest[i] = short / (1 + most * local);
      sound &&= ways[i] < MOST_WAY * link && angle + apart[i] / link < MOST_ANGLE;
    }
    this.ways = ways;
    this.nearest = summed(shortest);
    this.farthest = summed(ways);
    return sound && !(this.stray.length && this.farthest[benches] > WAYS * this.dragon.extent);
  }

  /** @param {number} s */
  #radiusAt(s) {
    return between(s, this.places ?? [], this.radius ?? []);
  }

  /** How far the polar angles of points of a bench are off its handles, and where turns stray. */
  #prepare() {
    const { link, width, front_inset, rear_inset, benches } = this.dragon;
    const nearest = /** @type {Float64Array} */ (this.nearest);
    this.ahead = new Float64Array(benches);
    this.behind = new Float64Array(benches);
    let body = 0;
    for (let i = 0; i < benches; i++) {
      const radius = Math.max(this.#radiusAt(this.end - nearest[i]) - this.most, SPARE);
      const off = (/** @type {number} */ size) =>
        (size < radius ? Math.asin(Math.min(size / radius, 1)) : Math.PI) +
        (this.most * this.b) / radius ** 2 +
        SPARE_ANGLE;
      const half = 0.5 * width[i];
      body = Math.max(body, off(Math.hypot(link[i] + Math.max(front_inset[i], rear_inset[i]), half)));
      this.ahead[i] = off(Math.hypot(front_inset[i], half));
      this.behind[i] = off(Math.hypot(rear_inset[i], half));
    }
    this.slack = 2 * body;
    if (this.stray.length) this.#compareTurns();
  }

  /** Fill by how much the line may lie farther out than one turn farther out. */
  #compareTurns() {
    const { b, stray, slack = 0, slope } = this;
    const thetas = stray.map((_one, n) => this.#radiusAt(this.grid0 + n * GRID) / b);
    const along = (/** @type {number} */ u) => 0.5 * b * (u * Math.hypot(1, u) + Math.asinh(u));
    const beside = slack * (b * greatest(thetas) + 4 * Math.PI * b) + 2 * ALONG;
    const lowest = leastAbout(stray, 5 + 2 * Math.trunc(beside / GRID));
    this.more = stray.map((one, n) => {
      const turn = along(thetas[n] + 2 * Math.PI) - along(thetas[n]);
      const outer = Math.max((n * GRID - turn) / GRID, 0);
      return one - lowest[Math.trunc(outer)] + 2 * slope * GRID;
    });
  }

  /** How many benches from the head hold all pairs that may come near in each stretch. @param {number[]} borders @param {number} wanted */
  openBenches(borders, wanted) {
    const count = this.dragon.benches;
    const stretches = borders.slice(1).map((last, n) => this.#excess(borders[n] - ALONG, last + ALONG));
    const edge = stretches.reduce((least, one) => Math.min(least, one.edge), Infinity);
    if (!(edge > 0)) return stretches.map(() => count);
    this.#addStrays(borders, stretches);
    const room = wanted * Math.hypot(1, this.b / edge) + SPARE;
    return stretches.map((one) => (this.#isShut(one, room) ? this.#found(one, room) : count));
  }

  /** Whether benches on one turn, or two turns apart, keep apart. @param {Excess} stretch @param {number} room m */
  #isShut({ high, out, dip }, room) {
    const { nearest = out, ahead = out, behind = out, b } = this;
    for (let i = 0; i + 2 < out.length; i++) {
      const angle = (nearest[i + 2] - nearest[i + 1]) / (high[i + 2] + b);
      if (!(angle > behind[i] + ahead[i + 2])) return false;
    }
    return greatest(out) - least(dip) + room < 2 * 2 * Math.PI * b;
  }

  /** How many benches hold all pairs one turn apart that may come near. @param {Excess} stretch @param {number} room m */
  #found({ low, high, out, dip }, room) {
    const { nearest = out, farthest = out, slack = 0, b } = this;
    const pitch = 2 * Math.PI * b;
    const count = out.length;
    let found = 0;
    for (let i = 0; i + 2 < count; i++) {
      const most = (2 * Math.PI + slack) * (high[i + 1] + (1 + slack) * pitch + b);
      const nearWay = (2 * Math.PI - slack) * low[i + 1];
      for (let j = i + 2; j < count; j++) {
        if (nearest[j] - nearest[i + 1] > most) break;
        if (farthest[j] - farthest[i + 1] < nearWay) continue;
        if (out[i] - dip[j] + room >= pitch) found = Math.max(found, j + 1);
      }
    }
    return found;
  }

  /**
   * Greatest and least excess of each bench, m, but for the line's; the least radius of any.
   * @param {number} first @param {number} last m
   * @returns {Excess}
   */
  #excess(first, last) {
    const { b, aside, apart: parts, slope, most, dragon, nearest, farthest, ways } = this;
    const { link, width, front_inset, rear_inset, benches } = dragon;
    if (!parts || !nearest || !farthest || !ways) throw new Error("benches do not follow");
    const low = nearest.map((way) => this.#radiusAt(last - way) - most);
    const high = farthest.map((way) => this.#radiusAt(first - way) + most);
    const [out, dip] = [new Float64Array(benches), new Float64Array(benches)];
    let edge = Infinity;
    for (let i = 0; i < benches; i++) {
      const [front, rear, half] = [front_inset[i], rear_inset[i], 0.5 * width[i]];
      const apart = (b * ways[i]) / Math.max(low[i], SPARE) + parts[i] + SPARE;
      const far = (apart * high[i + 1]) / link[i] + 0.5 * link[i];
      const foot = Math.sqrt(Math.max(low[i] ** 2 - far ** 2, 0));
      const steepest = (2 * b * (far + Math.max(front, rear))) / foot;
      edge = Math.min(edge, foot <= steepest || !(foot > 0) ? 0 : foot - half);
      const p = foot - half;
      const [bend, gradient] = [1 / p + b / p ** 2, Math.hypot(1, b / p)];
      const [at, after] = [aside[i], aside[i + 1]];
      const tilt = (at - after) / link[i];
      const steep = (slope * ways[i]) / link[i];
      const rest =
        half * gradient + Math.max(front, rear) * steep + SPARE +
        most * (gradient - 1 + slope ** 2) + 0.5 * most ** 2 * bend; // prettier-ignore
      const before = Math.max(front * tilt + 0.5 * bend * front * (link[i] + front), 0);
      const behind = Math.max(-rear * tilt + 0.5 * bend * rear * (link[i] + rear), 0);
      const sunk = Math.min(at, after) - 0.125 * bend * link[i] ** 2;
      out[i] = Math.max(at + before, after + behind) + rest;
      dip[i] = Math.min(sunk, at + front * tilt, after - rear * tilt) - rest;
    }
    return { low, high, out, dip, edge };
  }

  /** Add how much farther out the line may lie under each bench than one turn farther out, m. @param {number[]} borders @param {Excess[]} stretches */
  #addStrays(borders, stretches) {
    if (!this.stray.length) return;
    const { nearest, farthest, more, grid0 } = this;
    if (!nearest || !farthest) return;
    const ends = stretches.map((_one, n) => [borders[n] - ALONG, borders[n + 1] + ALONG]);
    const lows = ends.map(([first]) => farthest.subarray(1).map((way) => first - way));
    const highs = ends.map(([, last]) => nearest.subarray(0, -1).map((way) => last - way));
    const widest = Math.max(...lows.map((low, n) => greatest(highs[n].map((s, i) => s - low[i]))));
    const highestMore = greatestAbout(more, 3 + Math.trunc(widest / GRID));
    stretches.forEach(({ out }, n) => {
      out.forEach((_one, i) => {
        const middle = Math.trunc((0.5 * (lows[n][i] + highs[n][i]) - grid0) / GRID);
        out[i] += highestMore[Math.min(Math.max(middle, 0), more.length - 1)];
      });
    });
  }
}

/** Least and greatest radius of handles, greatest and least excess of benches, and the least radius of any, m. @typedef {{ low: Float64Array, high: Float64Array, out: Float64Array, dip: Float64Array, edge: number }} Excess */
