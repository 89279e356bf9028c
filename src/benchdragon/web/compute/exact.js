// Numbers without any rounding, as Python's fractions: what doubles, sums, products and quotients of
// them are exactly.

const BITS = 52n;
const SHOWN = new Float64Array(1);
const STORED = new BigInt64Array(SHOWN.buffer);

/** The distance from a finite number to the next one away from zero, as Python's math.ulp. @param {number} value */
export function ulp(value) {
  SHOWN[0] = Math.abs(value);
  STORED[0] += 1n;
  return SHOWN[0] - Math.abs(value);
}

/** A whole number times a power of two; what is not finite has none. */
class Dyadic {
  /** @param {bigint} whole @param {bigint} power of two, never above 0 */
  constructor(whole, power) {
    this.whole = whole;
    this.power = power;
  }

  /** @param {number} value finite */
  static of(value) {
    SHOWN[0] = value;
    const bits = STORED[0];
    const stored = (bits >> BITS) & 0x7ffn;
    const fraction = bits & ((1n << BITS) - 1n);
    const whole = stored ? fraction | (1n << BITS) : fraction;
    const power = (stored || 1n) - 1023n - BITS;
    const sized = bits < 0n ? -whole : whole;
    return power > 0n ? new Dyadic(sized << power, 0n) : new Dyadic(sized, power);
  }

  /** @param {Dyadic} other */
  plus(other) {
    const power = this.power < other.power ? this.power : other.power;
    const whole = (this.whole << (this.power - power)) + (other.whole << (other.power - power));
    return new Dyadic(whole, power);
  }

  /** @param {Dyadic} other */
  times(other) {
    return new Dyadic(this.whole * other.whole, this.power + other.power);
  }
}

const ONE = Dyadic.of(1);

/** A quotient of such numbers; what it is divided by is positive. */
export class Exact {
  /** @param {Dyadic} over @param {Dyadic} under */
  constructor(over, under = ONE) {
    this.over = over;
    this.under = under;
  }

  /** @param {number} value finite */
  static of(value) {
    return new Exact(Dyadic.of(value));
  }

  /** @param {Exact} other */
  plus(other) {
    if (this.under === other.under) return new Exact(this.over.plus(other.over), this.under);
    const over = this.over.times(other.under).plus(other.over.times(this.under));
    return new Exact(over, this.under.times(other.under));
  }

  /** @param {Exact} other */
  minus(other) {
    return this.plus(new Exact(new Dyadic(-other.over.whole, other.over.power), other.under));
  }

  /** @param {Exact} other */
  times(other) {
    const under = this.under === ONE ? other.under : this.under.times(other.under);
    return new Exact(this.over.times(other.over), under);
  }

  /** Half of it. */
  half() {
    return new Exact(new Dyadic(this.over.whole, this.over.power - 1n), this.under);
  }

  /** Divided by a positive one without a divisor of its own. @param {Exact} other */
  by(other) {
    return new Exact(this.over, this.under.times(other.over));
  }

  /** -1, 0 or 1. */
  get sign() {
    const { whole } = this.over;
    return whole < 0n ? -1 : Number(whole > 0n);
  }
}
