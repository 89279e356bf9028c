// A dragon's sizes: twin of model/dragon.py.

import { countText, faultOf } from "../made/dragon.js";
import { arena, copied } from "./arena.js";
import { BOX, MODEL_DRAGON } from "./constants.js";
import { InputError } from "./errors.js";

/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {"length" | "width" | "front_inset" | "rear_inset"} SizeName */
/** @typedef {Record<SizeName, Float64Array>} SizeColumns */

/** @type {SizeName[]} */
const SIZE_NAMES = ["length", "width", "front_inset", "rear_inset"];

/** Sizes that cannot be: bench (a row, from 0), size and sentence of each, benches of the same sizes once. */
export class SizeError extends InputError {
  /** @param {Array<[number, string, string]>} faults */
  constructor(faults) {
    super(faults[0][2]);
    this.faults = faults;
  }
}

/** Benches in walking order, bench 1 the head; their sizes in m, one entry a bench. */
export class Dragon {
  /**
   * @param {Arena} arena which holds `sizes` and `links`
   * @param {SizeColumns} columns
   */
  constructor(arena, { length, width, front_inset, rear_inset }) {
    this.length = length;
    this.width = width;
    this.front_inset = front_inset;
    this.rear_inset = rear_inset;
    /** Number of benches; `size` is how much Python counts in it. */
    this.benches = this.size = length.length;
    if (this.benches < 1 || this.benches > MODEL_DRAGON.MOST_BENCHES)
      throw new InputError(countText(this.benches));
    /** Length, width, front inset and rear inset for kernels, (4, benches). @type {Numbers} */
    this.sizes = arena.table([length, width, front_inset, rear_inset], this.benches);
    /** Between the holes of each bench for kernels, m, (benches,). @type {Numbers} */
    this.links = arena.array("d", this.benches);
    arena.engine.call("bd_links_links_of", this.sizes, this.links);
    this.link = copied(this.links);
    this.#check();
  }

  /**
   * Head, equal bodies, tail.
   * @param {Arena} arena
   * @param {Record<"benches" | "head_length" | "body_length" | "tail_length" | "width" | "front_inset"
   *   | "rear_inset", number>} sizes
   */
  static uniform(arena, sizes) {
    const { benches } = sizes;
    if (!(benches >= 1 && benches <= MODEL_DRAGON.MOST_BENCHES))
      throw new InputError(countText(benches));
    const all = (/** @type {number} */ value) => new Float64Array(benches).fill(value);
    const length = all(sizes.body_length);
    length[benches - 1] = sizes.tail_length;
    length[0] = sizes.head_length;
    const others = [sizes.width, sizes.front_inset, sizes.rear_inset];
    const [width, front_inset, rear_inset] = others.map(all);
    return new Dragon(arena, { length, width, front_inset, rear_inset });
  }

  /** The most that any point of a bench moves when both its handles move by at most 1. */
  get lever() {
    let most = 0;
    for (let i = 0; i < this.benches; i++) {
      const insets = 2 * Math.max(this.front_inset[i], this.rear_inset[i]);
      most = Math.max(most, 1 + (insets + this.width[i]) / this.link[i]);
    }
    return most;
  }

  /** The largest distance between a bench's two holes, m. */
  get longest_link() {
    return this.link.reduce((most, link) => Math.max(most, link));
  }

  /** From handle to handle, m: summed as NumPy sums, in pairs. */
  get extent() {
    return pairwiseSum(this.link);
  }

  #check() {
    /** @type {any[]} */
    const faults = [];
    const seen = new Set();
    for (let i = 0; i < this.benches && faults.length < MODEL_DRAGON.MOST_FAULTS; i++) {
      if (this.#sound(i)) continue;
      const sizes = SIZE_NAMES.map((name) => this[name][i]);
      if (!seen.has(sizes.join())) faults.push(faultOf(i, sizes));
      seen.add(sizes.join());
    }
    if (faults.length) throw new SizeError(faults);
  }

  /** @param {number} i */
  #sound(i) {
    const [length, width, front, rear] = SIZE_NAMES.map((name) => this[name][i]);
    const most = BOX.LONGEST_BENCH;
    return (
      length > 0 && length <= most && width > 0 && width <= most &&
      front >= 0 && front <= most && rear >= 0 && rear <= most && this.link[i] >= BOX.SHORTEST_LINK
    ); // prettier-ignore
  }
}

/** The dragon with room for bearers on both sides of all benches, and before the head's bench. @param {Dragon} dragon @param {{ beside: number, ahead: number }} people */
export function withPeople(dragon, { beside, ahead }) {
  const [length, front_inset] = [dragon.length.slice(), dragon.front_inset.slice()];
  length[0] += ahead;
  front_inset[0] += ahead;
  const width = dragon.width.map((wide) => wide + 2 * beside);
  return new Dragon(arena(), { length, width, front_inset, rear_inset: dragon.rear_inset });
}

/**
 * The sum of numbers, in the order in which NumPy adds: the same to the last bit.
 * @param {Float64Array} values
 * @returns {number}
 */
function pairwiseSum(values) {
  const n = values.length;
  if (n < 8) return values.reduce((sum, value) => sum + value, 0);
  if (n > 128) {
    const half = (n >> 1) - ((n >> 1) % 8);
    return pairwiseSum(values.subarray(0, half)) + pairwiseSum(values.subarray(half));
  }
  const r = values.slice(0, 8);
  const whole = n - (n % 8);
  for (let i = 8; i < whole; i += 8) for (let k = 0; k < 8; k++) r[k] += values[i + k];
  let sum = r[0] + r[1] + (r[2] + r[3]) + (r[4] + r[5] + (r[6] + r[7]));
  for (let i = whole; i < n; i++) sum += values[i];
  return sum;
}
