// With which values of one size a dance can be walked: tried here and there, and its borders sought.

/** What is known of a value: "open" where it could not be decided, "none" where there is no such dance.
 * @typedef {"safe" | "unsafe" | "open" | "none"} State */
/** Neighbouring values, of which all that were tried came to the same. @typedef {{ from: number, to: number, state: State }} Piece */
/**
 * Values from low to high, and how finely they matter.
 * @typedef {{ low: number, high: number, step: number }} Range
 */
/**
 * Who knows.
 * @typedef {object} Known
 * @property {(value: number) => Promise<State>} judge
 * @property {() => Promise<{ lower: number, upper: number } | null>} limit between which values the dance
 *   stops staying clear, sought from the plan's own; null where that is not known
 */

/** How many values are tried before borders are sought: from the plan's own outwards. */
const TRIED = 13;
/** After a value that took so long, ms, none is tried beyond. */
const SLOW = 1000;

/** A multiple of the step that lies near a value, among the range. @param {number} value @param {Range} range */
function onGrid(value, { low, high, step }) {
  const near = low + Math.round((value - low) / step) * step;
  return Number(Math.min(Math.max(near, low), high).toFixed(9));
}

/** @param {Range} range */
function firstValues(range) {
  const { low, high } = range;
  const values = Array.from({ length: TRIED }, (_value, n) =>
    onGrid(low + (n / (TRIED - 1)) * (high - low), range),
  );
  return [...new Set(values)];
}

/** Try values one after another, as long as that is quick. @param {number[]} values @param {Known} known */
async function tries(values, { judge }) {
  /** @type {[number, State][]} */
  const tried = [];
  for (const value of values) {
    const began = performance.now();
    tried.push([value, await judge(value)]);
    if (performance.now() - began > SLOW) break;
  }
  return tried;
}

/**
 * The pieces of a range about a value, as far as that is quickly found. Every end of a piece that is safe
 * was tried itself, and is safe.
 * @param {Range} range
 * @param {number} own the plan's value
 * @param {Known} known
 * @returns {Promise<Piece[]>}
 */
export async function walkable(range, own, known) {
  const values = firstValues(range);
  const [below, above] = [
    values.filter((value) => value <= own),
    values.filter((value) => value > own),
  ];
  const tried = (await tries(below.reverse(), known)).reverse();
  tried.push(...(await tries(above, known)));
  /** @type {Piece[]} */
  const pieces = [];
  let from = tried[0][0];
  for (const [n, [value, state]] of tried.entries()) {
    const next = tried[n + 1];
    if (next && next[1] === state) continue;
    const border = next ? await borderOf([value, state], next, range, known) : value;
    pieces.push({ from, to: border, state });
    from = border;
  }
  return pieces;
}

/** Where one state ends and another begins. @param {[number, State]} one @param {[number, State]} other @param {Range} range @param {Known} known */
async function borderOf(one, other, range, known) {
  if (one[1] !== "safe" && other[1] !== "safe") return 0.5 * (one[0] + other[0]);
  const [[good], [bad]] = one[1] === "safe" ? [one, other] : [other, one];
  return (await limited(good, bad, range, known)) ?? bisected(good, bad, range, known);
}

/** The limit, if it lies between and what is walked there is safe. @param {number} good @param {number} bad @param {Range} range @param {Known} known */
async function limited(good, bad, { step }, { judge, limit }) {
  const found = await limit();
  if (!found) return null;
  const value = limitValue(found, good > bad, step);
  const between = Math.min(good, bad) <= value && value <= Math.max(good, bad);
  return between && (await judge(value)) === "safe" ? value : null;
}

/**
 * The end of a limit's bracket that keeps clear, rounded to what people read, to the safe side.
 * @param {{ lower: number, upper: number }} bracket
 * @param {boolean} above whether larger values keep clear
 * @param {number} step
 */
function limitValue({ lower, upper }, above, step) {
  const digits = digitsOf(step) + 1;
  const unit = 10 ** -digits;
  const value = above ? Math.ceil(upper / unit) * unit : Math.floor(lower / unit) * unit;
  return Number(value.toFixed(digits));
}

/** Digits after the point that a step has, at least two. @param {number} step */
function digitsOf(step) {
  return Math.max(2, Math.ceil(-Math.log10(step)) - 1);
}

/** @param {number} good @param {number} bad @param {Range} range @param {Known} known */
async function bisected(good, bad, range, known) {
  while (Math.abs(good - bad) > 1.5 * range.step) {
    const middle = onGrid(0.5 * (good + bad), range);
    if ((await known.judge(middle)) === "safe") good = middle;
    else bad = middle;
  }
  return good;
}

/** The spans in which the dance can be walked. @param {Piece[]} pieces @returns {[number, number][]} */
export function spansOf(pieces) {
  return pieces.filter(({ state }) => state === "safe").map(({ from, to }) => [from, to]);
}
