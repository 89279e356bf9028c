// Arrays of what is translated from Python, and the engine's entries that it calls: in the arena in
// which a page has something built.

import { arena, doubles, flat, withArena, withArenaAsync } from "./arena.js";
import { question } from "./budget.js";
import { Numbers } from "../engine.js";
import { py } from "./python.js";

/** Whether a value is an array of the engine. @param {unknown} value @returns {value is Numbers} */
export function isTable(value) {
  return value instanceof Numbers;
}

/**
 * What an entry of the engine gives. Lists of numbers are put into its memory, in groups too, and hold after
 * it what it left there.
 * @param {string} name
 * @param {any[]} values
 */
export function entry(name, ...values) {
  const { engine } = arena();
  return withArena(engine, (own) => {
    /** @type {Array<[any, Numbers]>} */
    const lists = [];
    /** @type {(one: any) => any} */
    const put = (one) => {
      if (typeof one !== "object" || one === null || isTable(one)) return one;
      if (!ArrayBuffer.isView(one))
        return Object.fromEntries(Object.entries(one).map(([field, of]) => [field, put(of)]));
      const list = one instanceof Float64Array ? own.vector(one) : own.whole(/** @type {any} */ (one));
      lists.push([one, list]);
      return list;
    };
    const found = engine.call(name, ...values.map(put));
    for (const [list, { view }] of lists) list.set(view);
    return found;
  });
}

/** An entry of the engine that gives one number, to be called. @param {string} name */
function entered(name) {
  return (/** @type {any[]} */ ...values) => entry(name, ...values)[0];
}

/** Room for chains of so many handles. @param {number} handles @param {number} slots */
export function emptyPlacements(handles, slots) {
  return arena().placements(handles, slots);
}

/** An array of one number throughout. @param {number | number[]} shape @param {number} value @param {import("../engine.js").Code} code */
function full(shape, value, code = "d") {
  const made = arena().array(code, ...[shape].flat());
  made.view.fill(/** @type {never} */ (code === "d" ? value : BigInt(value)));
  return made;
}

/** Zeros. @param {number | number[]} shape @param {import("../engine.js").Code} [code] */
export function zeros(shape, code) {
  return full(shape, 0, code);
}

/** Rows in the engine's memory, or a list of numbers. @param {any} values @param {import("../engine.js").Code} [code] */
export function array(values, code = "d") {
  if (isTable(values)) return copy(values);
  if (Array.isArray(values[0])) return arena().table(values, values[0].length);
  return code === "d" ? Float64Array.from(values) : BigInt64Array.from(values, BigInt);
}

/** The same numbers in another array. @param {any} table */
export function copy(table) {
  if (!isTable(table)) return table.slice();
  const made = arena().array("d", ...table.shape);
  doubles(made).set(doubles(table));
  return made;
}

/** The numbers of an array, row by row. @param {any} table @returns {any[]} */
export function tolist(table) {
  if (!isTable(table)) return Array.isArray(table) ? table : Array.from(table, Number);
  const [count, columns] = table.shape;
  const { code, view: own } = flat(table);
  const view = code === "d" ? /** @type {Float64Array} */ (own) : Float64Array.from(own, Number);
  if (columns === undefined) return [...view];
  return Array.from({ length: count }, (_row, n) => [...view.subarray(n * columns, (n + 1) * columns)]);
}

/** Where a number of an array is. @param {Numbers} table @param {number | number[]} at counted from the end where negative */
function placeOf({ shape }, at) {
  const [row, column = 0] = [at].flat();
  return (row < 0 ? row + shape[0] : row) * (shape[1] ?? 1) + column;
}

/** The same numbers in rows of so many. @param {any} table @param {number} _rows @param {number} columns */
function reshape(table, _rows, columns) {
  const all = tolist(table).flat();
  return arena().table(
    Array.from({ length: all.length / columns }, (_row, n) =>
      all.slice(n * columns, (n + 1) * columns),
    ),
    columns,
  );
}

/** A number of an array, or a row. @param {Numbers} table @param {number | number[]} at as in `placeOf` @returns {any} */
export function cell(table, at) {
  if (table.shape[1] !== undefined && !Array.isArray(at))
    return tolist(rows(table, at, at + 1 || undefined))[0];
  return Number(table.view[placeOf(table, at)]);
}

/** Set a number of an array. @param {Numbers} table @param {number | number[]} at @param {number} value */
function put(table, at, value) {
  table.view[placeOf(table, at)] = /** @type {never} */ (table.code === "d" ? value : BigInt(value));
}

/** Some rows of an array, which lie where they did. @param {Numbers} table @param {number} [start] @param {number} [end] */
function rows({ memory, address, code, shape: [count, ...shape] }, start = 0, end = count) {
  const [first, stop] = [start, end].map((n) => Math.min(Math.max(n < 0 ? n + count : n, 0), count));
  const size = shape.reduce((all, length) => all * length, 8);
  return new Numbers(memory, address + first * size, code, [Math.max(stop - first, 0), ...shape]);
}

/** What a question answers, its arrays in an arena of its own. @template T @param {() => Promise<T>} ask @returns {Promise<T>} */
function scoped(ask) {
  return question(() => withArenaAsync(arena().engine, ask));
}

/** Where a value comes in increasing numbers: after equal ones, or before. @param {ArrayLike<number> | Numbers} all @param {number} value @param {"left" | "right"} side */
export function searchsorted(all, value, side = "left") {
  const sorted = isTable(all) ? doubles(all) : all;
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
  {
    isTable,
    entry,
    entered,
    array,
    copy,
    tolist,
    full,
    zeros,
    empty: zeros,
    concatenate,
    cell,
    put,
    rows,
  },
  ofOne,
  { searchsorted, interp, reshape, scoped },
);
