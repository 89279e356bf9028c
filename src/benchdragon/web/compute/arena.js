// Arrays for kernels that are given back together.

import { Numbers } from "../engine.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("../engine.js").Code} Code */

/**
 * What `chain.march` fills: arrays (handles, slots), and how each slot ended, (2, slots).
 * @typedef {{ row: Numbers, u: Numbers, x: Numbers, y: Numbers, ratio: Numbers, tx: Numbers, ty: Numbers,
 *   failed: Numbers }} Placements
 */

/** The arena in which something is built. @type {Arena | null} */
let here = null;

/** What `make` makes, its arrays in an arena. @template T @param {Arena} arena @param {() => T} make not async @returns {T} */
export function within(arena, make) {
  const before = here;
  here = arena;
  try {
    return make();
  } finally {
    here = before;
  }
}

/** The arena in which something is built. */
export function arena() {
  if (!here) throw new TypeError("nowhere to put arrays: see `within`");
  return here;
}

/** Arrays in the engine's memory, until the arena is freed. */
export class Arena {
  /** @param {Engine} engine */
  constructor(engine) {
    this.engine = engine;
    /** @type {Set<Numbers>} */
    this.arrays = new Set();
  }

  /** Room for an array; what stands in it is not said. @param {Code} code @param {number[]} shape */
  array(code, ...shape) {
    const made = this.engine.array(code, shape);
    this.arrays.add(made);
    return made;
  }

  /** An array of one number throughout. @param {number[]} shape @param {number} value */
  full(shape, value) {
    const made = this.array("d", ...shape);
    made.view.fill(/** @type {never} */ (value));
    return made;
  }

  /** A list of numbers. @param {ArrayLike<number>} values */
  vector(values) {
    const made = this.array("d", values.length);
    /** @type {Float64Array} */ (made.view).set(values);
    return made;
  }

  /** A list of whole numbers. @param {ArrayLike<number>} values */
  whole(values) {
    const made = this.array("q", values.length);
    /** @type {BigInt64Array} */ (made.view).set(Array.from(values, BigInt));
    return made;
  }

  /** Rows of as many numbers each. @param {ArrayLike<number>[]} rows @param {number} columns */
  table(rows, columns) {
    const made = this.array("d", rows.length, columns);
    const view = /** @type {Float64Array} */ (made.view);
    rows.forEach((row, i) => view.set(row, i * columns));
    return made;
  }

  /** Room for chains of so many handles at so many positions of the head: see kernels/chain.py.
   * @param {number} handles
   * @param {number} slots
   * @returns {Placements}
   */
  placements(handles, slots) {
    const table = () => this.array("d", handles, slots);
    return {
      row: this.array("q", handles, slots),
      u: table(),
      x: table(),
      y: table(),
      ratio: table(),
      tx: table(),
      ty: table(),
      failed: this.array("q", 2, slots),
    };
  }

  /** Give back some of its arrays before the others. @param {Numbers[]} arrays */
  drop(...arrays) {
    for (const array of arrays) if (this.arrays.delete(array)) this.engine.free(array);
  }

  /** Give all back; none of them is to be used any more. */
  free() {
    this.engine.free(...this.arrays);
    this.arrays.clear();
  }
}

/**
 * What `use` makes with arrays that are given back when it ends, however it ends.
 * @template T
 * @param {Engine} engine
 * @param {(arena: Arena) => T} use not async: see `withArenaAsync`
 * @returns {T}
 */
export function withArena(engine, use) {
  const arena = new Arena(engine);
  try {
    return use(arena);
  } finally {
    arena.free();
  }
}

/**
 * The same for what lets go on its way; until it ends all that is built lies in that arena. A Worker answers
 * one question at a time: of two at once the second would end the first one's arena.
 * @template T
 * @param {Engine} engine
 * @param {(arena: Arena) => Promise<T>} use
 * @returns {Promise<T>}
 */
export async function withArenaAsync(engine, use) {
  const before = here;
  const own = (here = new Arena(engine));
  try {
    return await use(own);
  } finally {
    own.free();
    here = before;
  }
}

/** The numbers of an array of float64, for now: see `Numbers.view`. @param {Numbers} array */
export function doubles(array) {
  return /** @type {Float64Array} */ (array.view);
}

/** A copy of an array of float64, which stays. @param {Numbers} array */
export function copied(array) {
  return doubles(array).slice();
}

/** A copy of an array of int64 as numbers. @param {Numbers} array */
export function wholes(array) {
  return Array.from(/** @type {BigInt64Array} */ (array.view), Number);
}

/** The same array as one row; it is freed with the first. @param {Numbers} array */
export function flat(array) {
  return new Numbers(array.memory, array.address, array.code, [array.size]);
}

/** Row i of a table, as an array of its own; it is freed with the table. @param {Numbers} table @param {number} i */
export function rowOf(table, i) {
  const [, ...shape] = table.shape;
  const size = shape.reduce((all, length) => all * length, 1);
  return new Numbers(table.memory, table.address + 8 * i * size, table.code, shape);
}
