// Lists of numbers as NumPy makes them, and arrays of kernels cut.

import { Numbers } from "../engine.js";

/** So many numbers from low to high in even steps: `numpy.linspace`. @param {number} low @param {number} high @param {number} count */
export function evenly(low, high, count) {
  const step = (high - low) / (count - 1);
  return Array.from({ length: count }, (_number, n) => (n === count - 1 ? high : n * step + low));
}

/** The least of a list of numbers. @param {Float64Array} values */
export function least(values) {
  return values.reduce((a, b) => Math.min(a, b), Infinity);
}

/** The first rows of a table; they are freed with it. @param {Numbers} table @param {number} count */
export function firstRows(table, count) {
  return new Numbers(table.memory, table.address, table.code, [count, ...table.shape.slice(1)]);
}
