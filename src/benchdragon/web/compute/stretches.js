// Stretches of a dance that people can follow: `_followed` of analysis/bench_walks.py.

import { ANALYSIS_BENCH_WALKS } from "./constants.js";

/** A stretch before it is told: when it starts, s, route position and speed there, turning and pace. @typedef {{ time: number, s: number, speed: number, turning: number, pace: number }} Piece */

const { SHORTEST } = ANALYSIS_BENCH_WALKS;

/** @param {Piece} one @param {Piece} other */
function areAlike(one, other) {
  return one.turning === other.turning && one.pace === other.pace;
}

/**
 * Stretches none of which is shorter than SHORTEST, if there are several. The shortest, of several the first,
 * goes to the longer of its neighbours, again and again.
 * @param {Piece[]} pieces
 * @param {number} end s
 */
export function followed(pieces, end) {
  const line = new Line(
    pieces.filter((one, n) => n === 0 || !areAlike(one, pieces[n - 1])),
    end,
  );
  for (let n = line.shortest(); n !== null; n = line.shortest()) {
    const [low, high] = [line.before[n], line.after[n]];
    if (low < 0 || (high < line.lasts.length && line.lasts[high] > line.lasts[low]))
      line.join(n, high, line.pieces[high]);
    else line.join(low, n, line.pieces[low]);
  }
  return line.left;
}

/** Stretches one after another; neighbours are joined, and the first of them keeps its place. */
class Line {
  /** @param {Piece[]} pieces @param {number} end */
  constructor(pieces, end) {
    this.pieces = pieces;
    this.count = pieces.length;
    this.starts = [...pieces.map(({ time }) => time), end];
    this.lasts = pieces.map(({ time }, n) => this.starts[n + 1] - time);
    this.before = this.starts.map((_start, n) => n - 1);
    this.after = pieces.map((_piece, n) => n + 1);
    this.there = pieces.map(() => true);
    this.queue = new Queue();
    this.lasts.forEach((last, n) => this.queue.put(last, n));
  }

  /** The stretches that are there still. */
  get left() {
    return this.pieces.filter((_piece, n) => this.there[n]);
  }

  /** The shortest stretch, if it is too short and not the only one. */
  shortest() {
    while (this.count > 1) {
      const first = this.queue.first();
      if (!first || first[0] >= SHORTEST) return null;
      const [last, n] = this.queue.take();
      if (this.there[n] && last === this.lasts[n]) return n;
    }
    return null;
  }

  /** Join two neighbours to a stretch like one of them, and it to neighbours that are alike. @param {number} low @param {number} high @param {Piece} like */
  join(low, high, { turning, pace }) {
    const { pieces, lasts } = this;
    pieces[low] = { ...pieces[low], turning, pace };
    this.there[high] = false;
    this.count--;
    const after = this.after[high];
    this.after[low] = after;
    this.before[after] = low;
    lasts[low] = this.starts[after] - this.starts[low];
    this.queue.put(lasts[low], low);
    const neighbours = [[this.before[low], low], [low, after]]; // prettier-ignore
    for (const [one, other] of neighbours)
      if (one >= 0 && other < lasts.length && areAlike(pieces[one], pieces[other]))
        this.join(one, other, pieces[one]);
  }
}

/** Stretches, the shortest first, of several as long the one of the least number: a heap. */
class Queue {
  /** @type {Array<[number, number]>} */
  #rows = [];

  first() {
    return this.#rows[0];
  }

  /** @param {number} last @param {number} n */
  put(last, n) {
    const rows = this.#rows;
    rows.push([last, n]);
    for (let at = rows.length - 1; at > 0;) {
      const up = (at - 1) >> 1;
      if (!this.#goesFirst(at, up)) return;
      [rows[at], rows[up]] = [rows[up], rows[at]];
      at = up;
    }
  }

  /** @returns {[number, number]} */
  take() {
    const rows = this.#rows;
    const first = rows[0];
    const last = /** @type {[number, number]} */ (rows.pop());
    if (rows.length) rows[0] = last;
    for (let at = 0; 2 * at + 1 < rows.length;) {
      let down = 2 * at + 1;
      if (down + 1 < rows.length && this.#goesFirst(down + 1, down)) down++;
      if (!this.#goesFirst(down, at)) break;
      [rows[at], rows[down]] = [rows[down], rows[at]];
      at = down;
    }
    return first;
  }

  /** @param {number} one @param {number} other */
  #goesFirst(one, other) {
    const [[a, n], [b, m]] = [this.#rows[one], this.#rows[other]];
    return a < b || (a === b && n < m);
  }
}
