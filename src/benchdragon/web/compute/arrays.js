// Arrays of what is translated from Python, and the engine's entries that it calls: in the arena in
// which a page has something built.

import { doubles, flat } from "./arena.js";
import { Numbers } from "../engine.js";
import { py } from "./python.js";

/** @typedef {import("./arena.js").Arena} Arena */

/** @type {Arena | null} */
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

/** Whether a value is an array of the engine. @param {unknown} value @returns {value is Numbers} */
export function isTable(value) {
  return value instanceof Numbers;
}

/** What an entry of the engine gives; lists of numbers are put into its memory. @param {string} name @param {any[]} values */
export function entry(name, ...values) {
  const given = values.map((one) => (one instanceof Float64Array ? arena().vector(one) : one));
  return arena().engine.call(name, ...given);
}

/** Room for chains of so many handles. @param {number} handles @param {number} slots */
export function emptyPlacements(handles, slots) {
  return arena().placements(handles, slots);
}

/** Zeros. @param {number | number[]} shape */
export function zeros(shape) {
  return arena().full([shape].flat(), 0);
}

/** Rows in the engine's memory, or a list of numbers. @param {any[]} values */
export function array(values) {
  return Array.isArray(values[0]) ? arena().table(values, values[0].length) : Float64Array.from(values);
}

/** The same numbers in another array. @param {Numbers} table */
export function copy(table) {
  const made = arena().array("d", ...table.shape);
  doubles(made).set(doubles(table));
  return made;
}

/** The numbers of an array, row by row. @param {any} table @returns {any[]} */
export function tolist(table) {
  if (!isTable(table)) return [...table];
  const [count, columns] = table.shape;
  const view = doubles(flat(table));
  if (columns === undefined) return [...view];
  return Array.from({ length: count }, (_row, n) => [...view.subarray(n * columns, (n + 1) * columns)]);
}

/** A number of an array. @param {Numbers} table @param {number | number[]} at counted from the end where negative */
export function cell(table, at) {
  const [row, column = 0] = [at].flat();
  const columns = table.shape[1] ?? 1;
  return doubles(table)[(row < 0 ? row + table.shape[0] : row) * columns + column];
}

/** Where a value comes in increasing numbers: after equal ones, or before. @param {ArrayLike<number>} sorted @param {number} value @param {"left" | "right"} side */
export function searchsorted(sorted, value, side = "left") {
  let [low, high] = [0, sorted.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (side === "right" ? sorted[middle] <= value : sorted[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** A value between increasing places by straight lines, as at the last of them beyond. @param {number} x @param {ArrayLike<number>} xs @param {ArrayLike<number>} values */
function interp(x, xs, values) {
  const n = searchsorted(xs, x, "right");
  if (n === 0 || n === xs.length) return values[n && n - 1];
  return ((values[n] - values[n - 1]) / (xs[n] - xs[n - 1])) * (x - xs[n - 1]) + values[n - 1];
}

// Of NumPy's functions what they give for one number.
const ofOne = {
  asarray: (/** @type {any} */ value) => value,
  maximum: Math.max,
  where: (/** @type {boolean} */ test, /** @type {any} */ a, /** @type {any} */ b) => (test ? a : b),
};
const concatenate = (/** @type {any[]} */ tables) => array(tables.flatMap(tolist));
Object.assign(
  py,
  { isTable, entry, array, copy, tolist, zeros, empty: zeros, concatenate, cell },
  ofOne,
  { searchsorted, interp },
);
