// The least of a quadratic function under linear constraints, within a box: by an interior-point method, for
// few unknowns.

/** @typedef {number[][]} Matrix */

// Steps at most; how near to a border each goes; how much nearer to all borders each is to come; when products
// of rooms and multipliers are small enough; the least room at first; the curvature of what is lacking.
const [MOST_ROUNDS, NEAR, CENTRED, SETTLED, INSIDE, SOFT] = [60, 0.995, 0.1, 1e-13, 1e-3, 1e-8];

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

/** The solution of a system whose matrix is symmetric and positive definite. @param {Matrix} matrix @param {number[]} right */
function solved(matrix, right) {
  const size = right.length;
  const rows = matrix.map((row, i) => Float64Array.from([...row, right[i]]));
  for (let k = 0; k < size; k++)
    for (let i = k + 1; i < size; i++) {
      const by = rows[i][k] / rows[k][k];
      if (by) for (let c = k; c <= size; c++) rows[i][c] -= by * rows[k][c];
    }
  const found = Array(size).fill(0);
  for (let k = size - 1; k >= 0; k--) {
    let rest = rows[k][size];
    for (let c = k + 1; c < size; c++) rest -= rows[k][c] * found[c];
    found[k] = rest / rows[k][k];
  }
  return found;
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
  const soft = caps.flatMap((cap, i) => (cap < Infinity ? [i] : []));
  const zeros = soft.map(() => 0);
  // What soft rows lack are unknowns too.
  const lacks = (/** @type {number} */ i) => soft.map((one) => Number(one === i));
  const unit = identity(size + soft.length, 1);
  const bent = unit.map((row, i) =>
    i < size ? [...curvature[i], ...zeros] : row.map((one) => SOFT * one),
  );
  const slope = [...gradient, ...soft.map((i) => caps[i])];
  const all = [
    ...rows.map((row, i) => [...row, ...lacks(i)]),
    ...unit,
    ...unit.slice(0, size).map((row) => row.map((one) => -one)),
  ];
  const left = [...rooms, ...low.map((one) => -one), ...zeros, ...high];
  const { x, multipliers } = innerPoint(bent, slope, all, left);
  const step = low.map((one, k) => Math.min(Math.max(x[k], one), high[k]));
  return { step, multipliers: multipliers.slice(0, rows.length) };
}

/**
 * The least of slope . x + x . bent x / 2 where all x + left is nowhere negative: by steps from inside.
 * @param {Matrix} bent @param {number[]} slope @param {Matrix} all @param {number[]} left
 */
function innerPoint(bent, slope, all, left) {
  let x = slope.map(() => 0);
  let [room, pull] = [left.map((one) => Math.max(one, INSIDE)), left.map(() => 1)];
  for (let round = 0; round < MOST_ROUNDS; round++) {
    const wanted = (CENTRED * dot(room, pull)) / room.length;
    const off = times(all, x).map((one, i) => one + left[i] - room[i]);
    const push = room.map((one, i) => (wanted - pull[i] * (one + off[i])) / one);
    const right = times(bent, x).map((one, k) => {
      return all.reduce((sum, row, i) => sum + row[k] * (pull[i] + push[i]), -one - slope[k]);
    });
    const moved = solved(stiffened(bent, all, room.map((one, i) => pull[i] / one)), right); // prettier-ignore
    const wider = times(all, moved).map((one, i) => one + off[i]);
    const change = push.map((one, i) => one - (pull[i] * (wider[i] - off[i])) / room[i]);
    const far = Math.min(1, NEAR * Math.min(reach(room, wider), reach(pull, change)));
    x = x.map((one, k) => one + far * moved[k]);
    room = room.map((one, i) => one + far * wider[i]);
    pull = pull.map((one, i) => one + far * change[i]);
    if (dot(room, pull) <= SETTLED && off.every((one) => Math.abs(one) <= SETTLED)) break;
  }
  return { x, multipliers: pull };
}

/** A matrix with so much of each row squared added. @param {Matrix} bent @param {Matrix} all @param {number[]} weights */
function stiffened(bent, all, weights) {
  const made = bent.map((row) => [...row]);
  all.forEach((row, i) => {
    const used = row.flatMap((one, k) => (one ? [k] : []));
    for (const k of used) for (const c of used) made[k][c] += weights[i] * row[k] * row[c];
  });
  return made;
}

/** How far a list may go along another until one of its numbers is 0. @param {number[]} from @param {number[]} along */
function reach(from, along) {
  return along.reduce((far, one, i) => (one < 0 ? Math.min(far, -from[i] / one) : far), Infinity);
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
