// Numbers without any rounding, as Python's fractions: what doubles, sums, products and quotients of
// them are exactly.

const SHOWN = new Float64Array(1);
const STORED = new BigInt64Array(SHOWN.buffer);

/** The distance from a finite number to the next one away from zero, as Python's math.ulp. @param {number} value */
export function ulp(value) {
  SHOWN[0] = Math.abs(value);
  STORED[0] += 1n;
  return SHOWN[0] - Math.abs(value);
}

/** One whole number over another, which is positive; not in lowest terms. */
export class Exact {
  /** @param {bigint} over @param {bigint} under */
  constructor(over, under) {
    this.over = over;
    this.under = under;
  }

  /** @param {number} value finite */
  static of(value) {
    let [whole, halves] = [value, 0];
    for (; !Number.isInteger(whole); whole *= 2) halves++; // which loses nothing
    return new Exact(BigInt(whole), 1n << BigInt(halves));
  }

  /** @param {Exact} other @returns {Exact} */
  plus(other) {
    if (this.under < other.under) return other.plus(this);
    // Powers of two divide each other: sums of many stay short.
    const share = this.under % other.under === 0n ? this.under / other.under : 0n;
    if (share) return new Exact(this.over + other.over * share, this.under);
    const over = this.over * other.under + other.over * this.under;
    return new Exact(over, this.under * other.under);
  }

  /** @param {Exact} other */
  minus(other) {
    return this.plus(new Exact(-other.over, other.under));
  }

  /** @param {Exact} other */
  times(other) {
    return new Exact(this.over * other.over, this.under * other.under);
  }

  /** Half of it. */
  half() {
    return new Exact(this.over, 2n * this.under);
  }

  /** Divided by a positive one. @param {Exact} other */
  by(other) {
    return new Exact(this.over * other.under, this.under * other.over);
  }

  /** -1, 0 or 1. */
  get sign() {
    return this.over < 0n ? -1 : Number(this.over > 0n);
  }
}
