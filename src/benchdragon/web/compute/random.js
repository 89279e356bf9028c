// Random numbers as NumPy's default_rng draws them: SeedSequence, PCG64, and normal numbers by the ziggurat.

const WORD = 0xffffffffn;
const STATE = (1n << 128n) - 1n;
const LONG = (1n << 64n) - 1n;
const MULTIPLIER = 0x2360ed051fc65da44385df649fccf645n;
// Of SeedSequence: how many words its pool has, and what they are mixed with.
const POOL = 4;
const MIXED_IN = { start: 0x43b0d7e5, times: 0x931e8875 };
const MIXED_OUT = { start: 0x8b51f9dd, times: 0x58f38ded };
const [LEFT, RIGHT] = [0xca01f9dd, 0x4973f715];
// The ziggurat: its layers, where the last begins, and the bits of a place in a layer.
const LAYERS = 256;
const LAST = 3.6541528853610088;
const PLACES = 2 ** 52;

/** The words of a whole number that is not negative, the lowest first. @param {number} value */
function wordsOf(value) {
  const words = [];
  for (let rest = BigInt(value); rest > 0n || !words.length; rest >>= 32n)
    words.push(Number(rest & WORD));
  return words;
}

/** Mixes words with a factor that changes each time. @param {{ start: number, times: number }} numbers */
function hasher({ start, times }) {
  let factor = start;
  return (/** @type {number} */ value) => {
    const mixed = value ^ factor;
    factor = Math.imul(factor, times) >>> 0;
    const spread = Math.imul(mixed, factor) >>> 0;
    return (spread ^ (spread >>> 16)) >>> 0;
  };
}

/** @param {number} x @param {number} y */
function mix(x, y) {
  const mixed = (Math.imul(LEFT, x) - Math.imul(RIGHT, y)) >>> 0;
  return (mixed ^ (mixed >>> 16)) >>> 0;
}

/** The pool of SeedSequence(seed, spawn_key=key). @param {number} seed @param {number[]} key */
function poolOf(seed, key) {
  const words = wordsOf(seed);
  while (key.length && words.length < POOL) words.push(0);
  const entropy = [...words, ...key.flatMap(wordsOf)];
  const hash = hasher(MIXED_IN);
  const pool = Array.from({ length: POOL }, (_word, i) => hash(entropy[i] ?? 0));
  for (let from = 0; from < POOL; from++)
    for (let to = 0; to < POOL; to++) if (from !== to) pool[to] = mix(pool[to], hash(pool[from]));
  for (const word of entropy.slice(POOL))
    for (let to = 0; to < POOL; to++) pool[to] = mix(pool[to], hash(word));
  return pool;
}

/** Layers of the normal ziggurat: their widths, how much of each lies under the curve, and its heights. */
function layers() {
  const height = (/** @type {number} */ x) => Math.exp(-0.5 * x * x);
  const area = 0.004928673233974655; // of each
  const [widths, heights] = [new Float64Array(LAYERS), new Float64Array(LAYERS)];
  const inside = new Float64Array(LAYERS);
  let x = LAST;
  const base = area / height(LAST);
  [widths[0], heights[0], inside[0]] = [base, 1, LAST / base];
  [widths[LAYERS - 1], heights[LAYERS - 1]] = [LAST, height(LAST)];
  for (let i = LAYERS - 2; i > 0; i--) {
    const nearer = Math.sqrt(-2 * Math.log(area / x + height(x)));
    inside[i + 1] = nearer / x;
    [widths[i], heights[i]] = [nearer, height(nearer)];
    x = nearer;
  }
  return { widths, heights, inside };
}

const { widths, heights, inside } = layers();

/** A stream of random numbers: `numpy.random.default_rng(SeedSequence(seed, spawn_key=key))`. */
export class PCG64 {
  /** @param {number} seed whole, from 0 @param {number[]} [key] likewise */
  constructor(seed, key = []) {
    const hash = hasher(MIXED_OUT);
    const pool = poolOf(seed, key);
    const words = Array.from({ length: 8 }, (_word, i) => BigInt(hash(pool[i % POOL])));
    const [a, b, c, d] = [0, 2, 4, 6].map((i) => words[i] | (words[i + 1] << 32n));
    this.increment = ((((c << 64n) | d) << 1n) | 1n) & STATE;
    this.state = (this.increment + ((a << 64n) | b)) & STATE;
    this.#step();
  }

  #step() {
    this.state = (this.state * MULTIPLIER + this.increment) & STATE;
  }

  /** The next 64 bits. */
  #bits() {
    this.#step();
    const folded = (this.state >> 64n) ^ (this.state & LONG);
    const by = this.state >> 122n;
    return ((folded >> by) | (folded << (64n - by))) & LONG;
  }

  /** A number from 0 to 1, as likely anywhere. */
  double() {
    return Number(this.#bits() >> 11n) / 2 ** 53;
  }

  /** A standard normal number. */
  normal() {
    for (;;) {
      const bits = this.#bits();
      const layer = Number(bits & 0xffn);
      const place = Number((bits >> 9n) & 0xfffffffffffffn);
      const x = (place / PLACES) * widths[layer];
      const sign = (bits >> 8n) & 1n ? -1 : 1;
      if (place < Math.floor(inside[layer] * PLACES)) return sign * x;
      if (layer === 0) return this.#beyond(place);
      const [low, high] = [heights[layer], heights[layer - 1]];
      if ((high - low) * this.double() + low < Math.exp(-0.5 * x * x)) return sign * x;
    }
  }

  /** A normal number in the tail. @param {number} place whose ninth bit is the sign */
  #beyond(place) {
    for (;;) {
      const x = -Math.log1p(-this.double()) / LAST;
      const y = -Math.log1p(-this.double());
      if (2 * y > x * x) return Math.floor(place / 256) % 2 ? -(LAST + x) : LAST + x;
    }
  }

  /** So many standard normal numbers. @param {number} count */
  normals(count) {
    return Float64Array.from({ length: count }, () => this.normal());
  }
}
