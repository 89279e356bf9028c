// How near benches are to one another at an instant; neighbours in the chain do not count.

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./scene.js").Stand} Stand */

/**
 * Two benches (numbers from 0), their distance, m (minus the depth where they overlap), and the points
 * where they are nearest.
 * @typedef {{i: number, j: number, distance: number, from: [number, number], to: [number, number]}} Pair
 */

/**
 * Benches near one another in the chain stay near whatever it does: 0.90 m apart on a line and 0.85 m
 * in a bend, say. A pair counts as of another coil if it is nearer than this share of its distance in a
 * straight chain; along a circle that takes more than half a turn.
 */
const OF_STRAIGHT = 0.5;
/** A pair that was shown before stays until it is farther apart than another by more than this share. */
const HOLD = 0.2;

/** Benches as rectangles: centres, directions, half lengths and half widths, m. */
export class Boxes {
  /** @param {Scene} scene */
  constructor(scene) {
    const sizes = scene.sent.benches;
    const array = () => new Float64Array(scene.benches);
    this.count = scene.benches;
    this.x = array();
    this.y = array();
    this.ux = array();
    this.uy = array();
    this.half = Float64Array.from(sizes.length, (length) => 0.5 * length);
    this.wide = Float64Array.from(sizes.width, (width) => 0.5 * width);
    this.inset = Float64Array.from(sizes.front_inset);
    this.rear = Float64Array.from(sizes.rear_inset);
    /** How far behind the head's front handle each handle is in a straight chain, m. */
    this.behind = new Float64Array(scene.handles);
    scene.links.forEach((link, i) => {
      this.behind[i + 1] = this.behind[i] + link;
    });
    this.radius = this.half.map((half, i) => Math.hypot(half, this.wide[i]));
    this.stride = 0;
    /** Benches no farther apart, m, count as touching: a page shows places no better. */
    this.reach = scene.sent.nearest.reach;
    this.touch = scene.sent.frames.largest_error;
    /** Pairs as near as this, m, count however the chain runs. */
    this.always = Math.max(this.touch, scene.sent.margin);
    /** Distance of each bench to its nearest, m; infinite beyond the reach. */
    this.nearest = array();
    this.other = new Int32Array(scene.benches);
  }

  /** Put the benches where a stand has their handles. @param {Stand} stand */
  place(stand) {
    this.stride = 0;
    for (let i = 0; i < this.count; i++) {
      const dx = stand.x[i] - stand.x[i + 1];
      const dy = stand.y[i] - stand.y[i + 1];
      const link = Math.hypot(dx, dy);
      const shift = this.inset[i] - this.half[i];
      this.ux[i] = dx / link;
      this.uy[i] = dy / link;
      this.x[i] = stand.x[i] + shift * this.ux[i];
      this.y[i] = stand.y[i] + shift * this.uy[i];
      if (i > 0) {
        const apart = Math.hypot(this.x[i] - this.x[i - 1], this.y[i] - this.y[i - 1]);
        this.stride = Math.max(this.stride, apart);
      }
    }
  }

  /**
   * Fill `nearest` and `other` for benches within `reach`, m; the tightest pair of two coils, if there is
   * one.
   * @returns {Pair | null}
   */
  measure() {
    const { reach } = this;
    this.nearest.fill(Infinity);
    this.other.fill(-1);
    let [best, first, second] = [Infinity, -1, -1];
    const widest = this.radius.reduce((a, b) => Math.max(a, b), 0);
    for (let i = 0; i + 2 < this.count; i++) {
      const far = this.radius[i] + widest + reach;
      for (let j = i + 2; j < this.count;) {
        const apart = Math.hypot(this.x[j] - this.x[i], this.y[j] - this.y[i]);
        if (apart > far) {
          // No centre comes nearer than by a stride a bench.
          j += Math.max(1, Math.floor((apart - far) / this.stride));
          continue;
        }
        const distance = this.distance(i, j);
        if (distance < reach) {
          if (distance < this.nearest[i]) [this.nearest[i], this.other[i]] = [distance, j];
          if (distance < this.nearest[j]) [this.nearest[j], this.other[j]] = [distance, i];
          if (distance < best && this.#apart(i, j, distance)) [best, first, second] = [distance, i, j];
        }
        j++;
      }
    }
    return first < 0 ? null : this.pair(first, second);
  }

  /** Whether benches i < j at a distance, m, are of two coils, or too near. @param {number} i @param {number} j @param {number} distance */
  #apart(i, j, distance) {
    const straight = this.behind[j] - this.behind[i + 1] - this.rear[i] - this.inset[j];
    return distance <= this.always || distance < OF_STRAIGHT * straight;
  }

  /**
   * The pair to show while time runs: the one shown before, unless it is clearly farther apart than another.
   * @param {Pair | null} tightest
   * @param {Pair | null} before
   */
  held(tightest, before) {
    if (!tightest || !before) return tightest;
    const distance = this.distance(before.i, before.j);
    // What touches is shown whatever was shown before.
    const most = tightest.distance > this.touch ? (1 + HOLD) * tightest.distance : this.touch;
    const stays = distance <= Math.min(most, this.reach) && this.#apart(before.i, before.j, distance);
    return stays ? this.pair(before.i, before.j) : tightest;
  }

  /**
   * Distance of two benches, m; minus the depth where they overlap.
   * @param {number} i
   * @param {number} j
   */
  distance(i, j) {
    const gap = Math.max(this.#gap(i, j), this.#gap(j, i));
    if (gap <= 0) return gap;
    return Math.sqrt(Math.min(this.#cornerDistance(i, j), this.#cornerDistance(j, i)));
  }

  /** Largest separation along the sides of bench i. @param {number} i @param {number} j */
  #gap(i, j) {
    const dx = this.x[j] - this.x[i];
    const dy = this.y[j] - this.y[i];
    const cos = Math.abs(this.ux[i] * this.ux[j] + this.uy[i] * this.uy[j]);
    const sin = Math.abs(this.ux[i] * this.uy[j] - this.uy[i] * this.ux[j]);
    const along = Math.abs(dx * this.ux[i] + dy * this.uy[i]);
    const across = Math.abs(dy * this.ux[i] - dx * this.uy[i]);
    return Math.max(
      along - this.half[i] - this.half[j] * cos - this.wide[j] * sin,
      across - this.wide[i] - this.half[j] * sin - this.wide[j] * cos,
    );
  }

  /** Least squared distance of bench j's corners from bench i. @param {number} i @param {number} j */
  #cornerDistance(i, j) {
    let least = Infinity;
    for (let n = 0; n < 4; n++) {
      const [x, y] = this.corner(j, n);
      const [along, across] = this.offset(i, x, y);
      const a = Math.max(Math.abs(along) - this.half[i], 0);
      const b = Math.max(Math.abs(across) - this.wide[i], 0);
      least = Math.min(least, a * a + b * b);
    }
    return least;
  }

  /** Corner n of a bench: front left first, going round. @param {number} i @param {number} n @returns {[number, number]} */
  corner(i, n) {
    const along = n === 0 || n === 3 ? this.half[i] : -this.half[i];
    const across = n < 2 ? this.wide[i] : -this.wide[i];
    return this.point(i, along, across);
  }

  /** @param {number} i @param {number} along @param {number} across @returns {[number, number]} */
  point(i, along, across) {
    return [
      this.x[i] + along * this.ux[i] - across * this.uy[i],
      this.y[i] + along * this.uy[i] + across * this.ux[i],
    ];
  }

  /** A point as seen from a bench: along it, and across it to the left. @param {number} i @param {number} x @param {number} y @returns {[number, number]} */
  offset(i, x, y) {
    const dx = x - this.x[i];
    const dy = y - this.y[i];
    return [dx * this.ux[i] + dy * this.uy[i], dy * this.ux[i] - dx * this.uy[i]];
  }

  /** Where two benches are nearest. @param {number} i @param {number} j @returns {Pair} */
  pair(i, j) {
    /** @type {Pair} */
    const found = { i, j, distance: this.distance(i, j), from: [0, 0], to: [0, 0] };
    let least = Infinity;
    for (const [mine, its] of [
      [i, j],
      [j, i],
    ]) {
      for (let n = 0; n < 4; n++) {
        const corner = this.corner(its, n);
        const [along, across] = this.offset(mine, ...corner);
        const a = Math.min(Math.max(along, -this.half[mine]), this.half[mine]);
        const b = Math.min(Math.max(across, -this.wide[mine]), this.wide[mine]);
        const foot = this.point(mine, a, b);
        const far = Math.hypot(foot[0] - corner[0], foot[1] - corner[1]);
        if (far < least) {
          least = far;
          [found.from, found.to] = mine === i ? [foot, corner] : [corner, foot];
        }
      }
    }
    return found;
  }

  /** Whether bench i meets an upright rectangle: its middle and half its sides, m. @param {number} i @param {number} x @param {number} y @param {number} a @param {number} b */
  meets(i, x, y, a, b) {
    const [dx, dy] = [x - this.x[i], y - this.y[i]];
    const [cos, sin] = [Math.abs(this.ux[i]), Math.abs(this.uy[i])];
    const [half, wide] = [this.half[i], this.wide[i]];
    return (
      Math.abs(dx) < a + half * cos + wide * sin &&
      Math.abs(dy) < b + half * sin + wide * cos &&
      Math.abs(dx * this.ux[i] + dy * this.uy[i]) < half + a * cos + b * sin &&
      Math.abs(dy * this.ux[i] - dx * this.uy[i]) < wide + a * sin + b * cos
    );
  }

  /** The bench at a point, or within `slack` of it, m; -1 if there is none. @param {number} x @param {number} y @param {number} slack */
  at(x, y, slack) {
    let [best, found] = [slack, -1];
    for (let i = 0; i < this.count; i++) {
      const [along, across] = this.offset(i, x, y);
      const far = Math.max(Math.abs(along) - this.half[i], Math.abs(across) - this.wide[i]);
      if (far < best) [best, found] = [far, i];
    }
    return found;
  }
}
