// Roots of many functions at once by Chandrupatla's method, step by step as SciPy's `find_root`.

/** Values of functions at places. @typedef {(places: Float64Array, which: number[]) => ArrayLike<number>} Values */

const LEAST = 2 ** -1022; // the smallest normal number
const ROUNDING = 4 * 2 ** -52;

/** Where one function is known: x1 was looked at last, x2 is on the other side of its root. */
class Bracket {
  /** @param {number} x1 @param {number} x2 @param {number} f1 @param {number} f2 */
  constructor(x1, x2, f1, f2) {
    this.x1 = x1;
    this.x2 = x2;
    this.f1 = f1;
    this.f2 = f2;
    this.x3 = x2;
    this.f3 = f2;
    this.share = 0.5;
  }

  /** The end that is nearer to the root, as far as is known. */
  get best() {
    return Math.abs(this.f1) < Math.abs(this.f2) ? this.x1 : this.x2;
  }

  /** Where to look next. */
  get next() {
    return this.x1 + this.share * (this.x2 - this.x1);
  }

  /** @param {number} x @param {number} f its value there */
  look(x, f) {
    [this.x3, this.f3] = [this.x2, this.f2];
    if (Math.sign(f) === Math.sign(this.f1)) [this.x3, this.f3] = [this.x1, this.f1];
    else [this.x2, this.f2] = [this.x1, this.f1];
    [this.x1, this.f1] = [x, f];
  }

  /** Whether the root is known; else where in the bracket to look next. @param {number} tolerance of places */
  settled(tolerance) {
    const { x1, x2, f1, f2 } = this;
    if (Math.min(Math.abs(f1), Math.abs(f2)) <= LEAST || Math.sign(f1) === Math.sign(f2)) return true;
    const wide = Math.abs(x2 - x1);
    const near = Math.abs(this.best) * ROUNDING + tolerance;
    if (wide < near) return true;
    const edge = (0.5 * near) / wide;
    this.share = Math.min(Math.max(this.#share, edge), 1 - edge);
    return false;
  }

  /** Where in the bracket a quadratic through three places says that the root is; else its middle. */
  get #share() {
    const { x1, x2, x3, f1, f2, f3 } = this;
    const xi = (x1 - x2) / (x3 - x2);
    const phi = (f1 - f2) / (f3 - f2);
    const alpha = (x3 - x1) / (x2 - x1);
    if (!(1 - Math.sqrt(1 - xi) < phi && phi < Math.sqrt(xi))) return 0.5;
    return ((f1 / (f1 - f2)) * f3) / (f3 - f2) - (((alpha * f1) / (f3 - f1)) * f2) / (f2 - f3);
  }
}

/**
 * A root of each function between a low and a high place, at which it has different signs.
 * @param {Values} values
 * @param {ArrayLike<number>} low
 * @param {ArrayLike<number>} high
 * @param {number} tolerance of places
 */
export function rootsOf(values, low, high, tolerance) {
  const all = Array.from(low, (_place, n) => n);
  const [first, last] = [low, high].map((places) => values(Float64Array.from(places), all));
  const brackets = all.map((n) => new Bracket(low[n], high[n], first[n], last[n]));
  let open = all.filter((n) => !brackets[n].settled(tolerance));
  while (open.length) {
    const places = Float64Array.from(open, (n) => brackets[n].next);
    const found = values(places, open);
    open.forEach((n, i) => brackets[n].look(places[i], found[i]));
    open = open.filter((n) => !brackets[n].settled(tolerance));
  }
  return Float64Array.from(brackets, ({ best }) => best);
}
