// Smooth lines through numbers as SciPy draws them: Gaussian filters, cubic splines, and filters of extremes.

/** Noise smoothed by a Gaussian of this spread, in entries; as many entries at each end are not to be used. @param {Float64Array} values @param {number} spread */
export function smoothed(values, spread) {
  const reach = Math.floor(4 * spread + 0.5);
  const weights = Float64Array.from({ length: 2 * reach + 1 }, (_one, n) =>
    Math.exp((-0.5 / (spread * spread)) * (n - reach) ** 2),
  );
  const whole = weights.reduce((sum, one) => sum + one, 0);
  return values.map((_one, i) => {
    let sum = 0;
    for (let n = -reach; n <= reach; n++) {
      const at = Math.min(Math.max(i + n, 0), values.length - 1);
      sum += (weights[n + reach] / whole) * values[at];
    }
    return sum;
  });
}

/**
 * The greatest of `size` values about each, those beyond the ends like the last ones.
 * @param {Float64Array} values @param {number} size
 */
export function greatestAbout(values, size) {
  const [count, before] = [values.length, Math.floor(size / 2)];
  const at = (/** @type {number} */ n) => values[Math.min(Math.max(n, 0), count - 1)];
  const found = new Float64Array(count);
  /** @type {number[]} */
  const falling = []; // numbers of values in the window each of which is greater than all after it
  let head = 0;
  for (let n = -before; n < count - before + size - 1; n++) {
    while (falling.length > head && at(falling[falling.length - 1]) <= at(n)) falling.pop();
    falling.push(n);
    const middle = n - size + 1 + before;
    if (middle < 0) continue;
    while (falling[head] < n - size + 1) head++;
    if (middle < count) found[middle] = at(falling[head]);
  }
  return found;
}

/** The least of `size` values about each. @param {Float64Array} values @param {number} size an odd number */
export function leastAbout(values, size) {
  const turned = values.map((one) => -one);
  return greatestAbout(turned, size).map((one) => -one);
}

/** A cubic spline through values at even steps from 0, its ends without knots: `CubicSpline`. */
export class Spline {
  /** @param {Float64Array} values at least four @param {number} step */
  constructor(values, step) {
    this.values = values;
    this.step = step;
    this.slopes = this.#solved();
  }

  /** Slopes at the values, by elimination. */
  #solved() {
    const { values, step } = this;
    const last = values.length - 1;
    const rise = (/** @type {number} */ n) => (values[n + 1] - values[n]) / step;
    const [above, right] = [new Float64Array(last + 1), new Float64Array(last + 1)];
    [above[0], right[0]] = [2, 0.5 * (5 * rise(0) + rise(1))];
    for (let n = 1; n < last; n++) {
      const by = 4 - above[n - 1];
      above[n] = 1 / by;
      right[n] = (3 * (rise(n - 1) + rise(n)) - right[n - 1]) / by;
    }
    const end = 0.5 * (rise(last - 2) + 5 * rise(last - 1));
    right[last] = (end - 2 * right[last - 1]) / (1 - 2 * above[last - 1]);
    for (let n = last - 1; n >= 0; n--) right[n] -= above[n] * right[n + 1];
    return right;
  }

  /** Its value and slope at a place. @param {number} x @returns {[number, number]} */
  at(x) {
    const { values, slopes, step } = this;
    const n = Math.min(Math.max(Math.floor(x / step), 0), values.length - 2);
    const t = x - n * step;
    const rise = (values[n + 1] - values[n]) / step;
    const [a, b] = [slopes[n], slopes[n + 1]];
    const cubic = (a + b - 2 * rise) / (step * step);
    const square = (rise - a) / step - cubic * step;
    const value = values[n] + t * (a + t * (square + t * cubic));
    return [value, a + t * (2 * square + 3 * t * cubic)];
  }
}

/** Between values at increasing places, straight on: `numpy.interp`. @param {number} x @param {ArrayLike<number>} places @param {ArrayLike<number>} values */
export function between(x, places, values) {
  let [low, high] = [0, places.length - 1];
  if (x <= places[0]) return values[0];
  if (x >= places[high]) return values[high];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (places[middle] <= x) low = middle;
    else high = middle;
  }
  const slope = (values[high] - values[low]) / (places[high] - places[low]);
  return slope * (x - places[low]) + values[low];
}
