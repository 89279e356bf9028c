// The least of a quadratic function under linear constraints, within a box: by ascent in one multiplier after
// another (Hildreth's method), for few unknowns.

/** @typedef {number[][]} Matrix */

const MOST_ROUNDS = 300;
const SETTLED = 1e-13;

/** @param {number[]} a @param {number[]} b */
export function dot(a, b) {
  return a.reduce((sum, one, k) => sum + one * b[k], 0);
}

/** A matrix times a vector. @param {Matrix} matrix @param {number[]} x */
export function times(matrix, x) {
  return matrix.map((row) => dot(row, x));
}

/** So many times the identity. @param {number} size @param {number} by @returns {Matrix} */
export function identity(size, by) {
  return Array.from({ length: size }, (_row, i) => {
    return Array.from({ length: size }, (_one, k) => (i === k ? by : 0));
  });
}

/** The inverse of a symmetric positive definite matrix. @param {Matrix} matrix */
function inverse(matrix) {
  const size = matrix.length;
  const rows = identity(size, 1).map((row, i) => [...matrix[i], ...row]);
  for (let k = 0; k < size; k++) {
    const pivot = rows[k].map((one) => one / rows[k][k]);
    for (let i = 0; i < size; i++) {
      const by = rows[i][k];
      rows[i] = i === k ? pivot : rows[i].map((one, c) => one - by * pivot[c]);
    }
  }
  return rows.map((row) => row.slice(size));
}

/**
 * The point d between low and high at which gradient . d + d . curvature d / 2 is least, rows d + rooms being
 * nowhere negative, or costing `caps` times what they lack; and the multipliers of the rows.
 * @param {Matrix} curvature symmetric, positive definite
 * @param {number[]} gradient
 * @param {Matrix} rows
 * @param {number[]} rooms
 * @param {number[]} caps infinite for rows that must not be negative
 * @param {number[]} low @param {number[]} high
 */
export function leastQuadratic(curvature, gradient, rows, rooms, caps, low, high) {
  const size = gradient.length;
  const unit = identity(size, 1);
  const all = [...rows, ...unit, ...unit.map((row) => row.map((one) => -one))];
  const left = [...rooms, ...low.map((one) => -one), ...high];
  const back = inverse(curvature);
  const pulled = all.map((row) => times(back, row));
  let d = times(back, gradient).map((one) => -one);
  const multipliers = all.map(() => 0);
  for (let round = 0; round < MOST_ROUNDS; round++) {
    let most = 0;
    for (const [i, row] of all.entries()) {
      const stiff = dot(row, pulled[i]);
      if (stiff <= 0) continue;
      const cap = caps[i] ?? Infinity;
      const wanted = multipliers[i] - (dot(row, d) + left[i]) / stiff;
      const change = Math.min(Math.max(wanted, 0), cap) - multipliers[i];
      multipliers[i] += change;
      d = d.map((one, k) => one + change * pulled[i][k]);
      most = Math.max(most, Math.abs(change) * Math.sqrt(stiff));
    }
    if (most <= SETTLED) break;
  }
  const step = d.map((one, k) => Math.min(Math.max(one, low[k]), high[k]));
  return { step, multipliers: multipliers.slice(0, rows.length) };
}

/**
 * A curvature that agrees with how a gradient changed along a step, kept positive: the update of Broyden,
 * Fletcher, Goldfarb and Shanno, damped as Powell does.
 * @param {Matrix} curvature
 * @param {number[]} step
 * @param {number[]} change of the gradient
 */
export function updated(curvature, step, change) {
  const before = times(curvature, step);
  const bent = dot(step, before);
  if (!(bent > 0)) return curvature;
  const seen = dot(step, change);
  const share = seen >= 0.2 * bent ? 1 : (0.8 * bent) / (bent - seen);
  const taken = change.map((one, k) => share * one + (1 - share) * before[k]);
  const along = dot(step, taken);
  return curvature.map((row, i) =>
    row.map((one, k) => one - (before[i] * before[k]) / bent + (taken[i] * taken[k]) / along),
  );
}
