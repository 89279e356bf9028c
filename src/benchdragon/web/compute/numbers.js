// Lists of numbers as NumPy makes them: the same to the last bit.

const HALF_WAY = 6755399441055744; // 1.5 * 2 ** 52: what is added to it loses its fraction, half to even

/** The nearest whole number, of two the even one: `numpy.rint`. @param {number} value */
export function rint(value) {
  return Math.abs(value) < 2 ** 51 ? value + HALF_WAY - HALF_WAY : value;
}

/** So many numbers evenly from one to another: `numpy.linspace`. @param {number} start @param {number} end @param {number} count */
export function linspace(start, end, count) {
  const step = count > 1 ? (end - start) / (count - 1) : 0;
  const found = Float64Array.from({ length: count }, (_value, i) => i * step + start);
  if (count > 1) found[count - 1] = end;
  return found;
}

/** Rounded to so many decimals: `numpy.round`. @param {number} value @param {number} decimals */
export function rounded(value, decimals) {
  const scale = 10 ** decimals;
  return rint(value * scale) / scale;
}

const SHOWN = new Float64Array(1);
const STORED = new BigInt64Array(SHOWN.buffer);

/** The distance from a finite number to the next one away from zero, as Python's math.ulp. @param {number} value */
export function ulp(value) {
  SHOWN[0] = Math.abs(value);
  STORED[0] += 1n;
  return SHOWN[0] - Math.abs(value);
}

/** A finite number as a ratio of whole ones, exactly. @param {number} value @returns {[bigint, bigint]} */
export function integerRatio(value) {
  let [whole, halves] = [value, 0n];
  for (; !Number.isInteger(whole); whole *= 2) halves++; // which loses nothing
  return [BigInt(whole), 1n << halves];
}

/** The least number that all divide; for powers of two, which `integerRatio` gives. @param {bigint[]} all */
export function lcm(...all) {
  return all.reduce((a, b) => (a < b ? b : a));
}
