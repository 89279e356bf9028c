// Who comes nearest to each bench over a walk, and who stands beside it. Twin of
// analysis/bench_nearness.py.

import { doubles, withArena, wholes } from "./arena.js";
import { ANALYSIS_BENCH_NEARNESS, BOX, SPIRAL } from "./constants.js";
import { boxes, nearness, pairsWithin } from "./distance.js";
import { nearestEach } from "./nearness.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./walk.js").Motion} Motion */
/** @typedef {import("./walk.js").Placement} Placement */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {"left" | "right" | "front" | "rear"} Side */

/**
 * When a bench of another coil comes nearest: one that is farther away than STRAIGHT in a line.
 * @typedef {object} Tightest
 * @property {number} time s
 * @property {number} bench number of the other
 * @property {Side} side on which side of this bench it then is
 * @property {number} lower no such bench comes nearer than this at any time, m
 * @property {number} upper so near that one is then, m
 * @property {[number, number]} place where this bench's front handle then is, m
 */

/** How near the nearest benches are at some times, m, and their numbers: (times, benches). @typedef {{ distance: Float64Array, partner: Int32Array, headS: number[], times: number[] }} Looks */

const { REACH, BESIDE, STRAIGHT, LEVEL, SHRINKS } = ANALYSIS_BENCH_NEARNESS;

/** Looks through a walk, slice by slice, for the tightest moment of each bench. */
export class TightestSearch {
  /** @param {Walk} walk what is looked at @param {number} apart what benches are known never to come nearer than, m */
  constructor(walk, apart) {
    const { benches } = walk.dragon;
    this.walk = walk;
    this.apart = apart;
    this.least = new Float64Array(benches).fill(Infinity);
    this.floor = new Float64Array(benches).fill(Infinity);
    this.partner = new Int32Array(benches);
    /** Where the head is before, at and after the tightest moment, m. @type {number[][]} */
    this.about = [];
    /** When it is there before and after, s. @type {number[][]} */
    this.when = [];
  }

  /** What is seen at the times of a motion; the next of one slice begins with the last of them. @param {Motion} motion @returns {Looks} */
  seen(motion) {
    const { distance, partner } = nearestEach(motion, REACH, STRAIGHT);
    const found = doubles(distance).slice();
    this.#sink(motion, found);
    return {
      distance: found,
      partner: Int32Array.from(wholes(partner), (n) => n + 1),
      headS: [...motion.headS],
      times: [...motion.times],
    };
  }

  /** Lower what nothing comes nearer than between these times. @param {Motion} motion @param {Float64Array} distance */
  #sink(motion, distance) {
    const { count, walk } = motion;
    const { benches, lever } = walk.dragon;
    const known = distance.map((far) => Math.min(far, REACH));
    if (count < 2) return known.forEach((far, k) => (this.floor[k] = Math.min(this.floor[k], far)));
    const s = doubles(motion.s);
    const moved = new Float64Array(benches);
    for (let t = 0; t + 1 < count; t++) {
      let farthest = 0;
      for (let k = 0; k < benches; k++) {
        const [at, next] = [k * count + t, (k + 1) * count + t];
        moved[k] = lever * Math.max(s[at + 1] - s[at], s[next + 1] - s[next]);
        farthest = Math.max(farthest, moved[k]);
      }
      for (let k = 0; k < benches; k++) {
        const apart = known[(t + 1) * benches + k] + known[t * benches + k];
        this.floor[k] = Math.min(this.floor[k], 0.5 * (apart - moved[k] - farthest));
      }
    }
  }

  /** Take what was seen in a slice; the next begins with the last time of it. @param {Looks} looks */
  look({ distance, partner, headS, times }) {
    const { benches } = this.walk.dragon;
    for (let k = 0; k < benches; k++) {
      let least = Infinity;
      for (let at = k; at < distance.length; at += benches) least = Math.min(least, distance[at]);
      if (!(least < this.least[k] - LEVEL)) continue;
      let t = 0;
      while (!(distance[t * benches + k] <= least + LEVEL)) t++;
      this.least[k] = least;
      this.partner[k] = partner[t * benches + k];
      const around = [Math.max(t - 1, 0), t, Math.min(t + 1, headS.length - 1)];
      this.about[k] = around.map((n) => headS[n]);
      this.when[k] = [times[around[0]], times[around[2]]];
    }
  }

  /** The tightest moment of bench k (a row, from 0); null where nothing comes within REACH. @param {number} k @returns {Tightest | null} */
  tightest(k) {
    if (!this.partner[k]) return null;
    const { walk } = this;
    const other = this.partner[k] - 1;
    const [low, level, high] = this.about[k];
    const [i, j] = [Math.min(k, other), Math.max(k, other)];
    const [least, where] = low < high ? lowPoint(walk, i, j, low, high) : [Infinity, level];
    const head = least < this.least[k] - LEVEL ? where : level;
    return withArena(walk.engine, (arena) => {
      const placed = walk.placement(arena, [head]);
      const table = boxes(arena, placed);
      const near = nearness(walk.engine, table, k, other);
      const upper = Math.max(near.distance, 0);
      const lower = Math.min(Math.max(this.floor[k], this.apart, 0), upper);
      const side = sideOf(walk.engine, table, k, near.points[Number(other > k)]);
      const [first, last] = this.when[k];
      // Where the head stops for good, rounding may put its place beyond all that it comes to.
      const time = Math.min(Math.max(walk.timeAt(head), first), last);
      const [x, y] = [placed.x, placed.y].map((row) => doubles(row)[k]);
      return { time, bench: other + 1, side, lower, upper, place: [x, y] };
    });
  }
}

/**
 * The least distance of benches i < j (rows, from 0) with the head between low and high, m; where:
 * `low_point` of analysis/distance.py.
 * @param {Walk} walk @param {number} i @param {number} j @param {number} low @param {number} high
 */
function lowPoint({ engine, route, dragon }, i, j, low, high) {
  return withArena(engine, (arena) =>
    engine.call(
      "bd_low_points_low_point", route.rows, dragon.links, dragon.sizes, i, j, low, high, SHRINKS,
      arena.array("d", SPIRAL.LANES), arena.placements(j + 2, SPIRAL.LANES),
      arena.array("d", 2, BOX.BOX_COLUMNS),
    ),
  ); // prettier-ignore
}

/**
 * On which side of the bench in row k of `boxes` a point lies that is outside of it.
 * @param {Engine} engine
 * @param {Numbers} table
 * @param {number} k
 * @param {[number, number]} point
 * @returns {Side}
 */
function sideOf(engine, table, k, [x, y]) {
  const [along, across] = engine.call("bd_box_offset", table, k, x, y);
  const box = doubles(table).subarray(k * BOX.BOX_COLUMNS, (k + 1) * BOX.BOX_COLUMNS);
  const ends = Math.abs(along) - box[BOX.HALF_LENGTH];
  if (ends > Math.abs(across) - box[BOX.HALF_WIDTH]) return along > 0 ? "front" : "rear";
  return across > 0 ? "left" : "right";
}

/** A bench that passes another: rows of both, and how far it is off along that and across, m. @typedef {{ mine: number, other: number, along: number, across: number }} Passing */

/**
 * The numbers of the benches next to each on its left and on its right, at the first position: of each
 * line of benches that passes, no neighbours and no more than BESIDE metres away, the one most abreast,
 * and of these the one of the nearest line; null where there is none.
 * @param {Placement} placed
 * @returns {Array<[number | null, number | null]>}
 */
export function beside(placed) {
  const { benches } = placed.dragon;
  return withArena(placed.arena.engine, (arena) => {
    const table = boxes(arena, placed);
    const pairs = pairsWithin(arena, table, BESIDE);
    const view = doubles(table);
    const both = [...pairs, ...pairs.map(([i, j]) => [j, i])];
    const all = both.flatMap(([mine, other]) => passing(view, mine, other));
    const [left, right] = [1, -1].map((hand) =>
      nearest(all.filter(({ across }) => Math.sign(across) === hand), benches),
    ); // prettier-ignore
    return left.map((number, k) => [number, right[k]]);
  });
}

/** How one bench passes another, if it is level with it and near. @param {Float64Array} view of `boxes` @param {number} mine @param {number} other @returns {Passing[]} */
function passing(view, mine, other) {
  const [own, its] = [mine, other].map((row) => {
    return view.subarray(row * BOX.BOX_COLUMNS, (row + 1) * BOX.BOX_COLUMNS);
  });
  const [x, y] = [its[BOX.CX] - own[BOX.CX], its[BOX.CY] - own[BOX.CY]];
  const [ux, uy] = [own[BOX.UX], own[BOX.UY]];
  const [along, across] = [x * ux + y * uy, y * ux - x * uy];
  const level = Math.abs(along) <= own[BOX.HALF_LENGTH] + 0.5 * its[BOX.HALF_LENGTH];
  const near = Math.abs(across) <= BESIDE + own[BOX.HALF_WIDTH] + its[BOX.HALF_WIDTH];
  return level && near ? [{ mine, other, along, across }] : [];
}

/** The number of the other that is beside each bench, of those on one side of it. @param {Passing[]} found @param {number} count @returns {Array<number | null>} */
function nearest(found, count) {
  const rows = found.sort((a, b) => a.mine - b.mine || a.other - b.other);
  const abreast = rows.filter((row, n) => {
    const [before, after] = [rows[n - 1], rows[n + 1]];
    const gains = (/** @type {Passing} */ one, /** @type {Passing} */ next) => {
      const follows = one.mine === next.mine && next.other - one.other === 1;
      return follows ? Math.abs(next.along) - Math.abs(one.along) : 0;
    };
    return !(before && gains(before, row) > 0) && !(after && gains(row, after) < 0);
  });
  abreast.sort((a, b) => a.mine - b.mine || Math.abs(a.across) - Math.abs(b.across));
  /** @type {Array<number | null>} */
  const numbers = new Array(count).fill(null);
  for (const { mine, other } of abreast) numbers[mine] ??= other + 1;
  return numbers;
}
