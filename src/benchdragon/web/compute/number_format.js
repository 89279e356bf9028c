// Numbers as sentences hold them: Python's formats, half of the last
// digit rounded to even as there.

import { NUMBER_FORMAT } from "./constants.js";

const { FIGURES } = NUMBER_FORMAT;

/** @param {number} value @returns {string | null} what is said of a number that is not finite */
function unlimited(value) {
  if (Number.isFinite(value)) return null;
  return Number.isNaN(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

/**
 * |value| times a power of ten, rounded to a whole number: of two as near the even one, as Python does.
 * @param {number} value finite
 * @param {number} digits the power
 */
function wholeOf(value, digits) {
  let [whole, halves] = [Math.abs(value), 0n];
  for (; !Number.isInteger(whole); whole *= 2) halves++; // which loses nothing
  const scale = 10n ** BigInt(Math.abs(digits));
  const over = BigInt(whole) * (digits < 0 ? 1n : scale);
  const under = (digits < 0 ? scale : 1n) << halves;
  const [found, twice] = [over / under, 2n * (over % under)];
  return twice > under || (twice === under && found & 1n) ? found + 1n : found;
}

/** So many decimals, without the sign of a zero: "z.6f". @param {number} value @param {number} count */
export function decimals(value, count = 6) {
  const whole = wholeOf(Number.isFinite(value) ? value : 0, count);
  return unlimited(value) ?? pointed(whole, count, value < 0);
}

/** A whole number with a point before its last digits. @param {bigint} whole @param {number} count @param {boolean} less whether it is below 0 */
function pointed(whole, count, less) {
  const text = String(whole).padStart(count + 1, "0");
  const point = text.length - count;
  const said = count ? `${text.slice(0, point)}.${text.slice(point)}` : text;
  return less && whole ? `-${said}` : said;
}

/**
 * The first digits of a number that is not 0, and the power of ten of the first of them.
 * @param {number} value @param {number} count @returns {[string, number]}
 */
function digitsOf(value, count) {
  let power = Number(value.toExponential().split("e")[1]);
  let text = String(wholeOf(value, count - 1 - power));
  if (text.length < count) text = String(wholeOf(value, count - 1 - --power));
  if (text.length > count) [text, power] = [text.slice(0, count), power + 1];
  return [text, power];
}

/** @param {string} digits @param {number} power */
function raised(digits, power) {
  const point = digits.length > 1 ? `${digits[0]}.${digits.slice(1)}` : digits;
  return `${point}e${signed(power)}`;
}

/** Decimals and a power of ten: ".1e". @param {number} value @param {number} count of decimals */
export function powered(value, count) {
  const none = unlimited(value);
  if (none) return none;
  const [digits, power] = value ? digitsOf(value, count + 1) : ["0".repeat(count + 1), 0];
  return (value < 0 || Object.is(value, -0) ? "-" : "") + raised(digits, power);
}

/** So many digits at most, and a power of ten where that is shorter: ".6g". @param {number} value @param {number} count */
export function general(value, count = 6) {
  const none = unlimited(value);
  const sign = value < 0 || Object.is(value, -0) ? "-" : "";
  if (none || !value) return none ?? `${sign}0`;
  const [digits, power] = digitsOf(value, count);
  const shown = digits.replace(/0+$/, "");
  if (power < -4 || power >= count) return sign + raised(shown, power);
  if (power < 0) return `${sign}0.${"0".repeat(-power - 1)}${shown}`;
  const whole = shown.slice(0, power + 1).padEnd(power + 1, "0");
  return shown.length > power + 1 ? `${sign}${whole}.${shown.slice(power + 1)}` : sign + whole;
}

/** So many decimals, rounded up or down: to the side on which what is said stays true; "-" for none. @param {number} value @param {number} count @param {boolean} up */
export function decimalsTowards(value, count, up) {
  if (!Number.isFinite(value)) return "-";
  const [shortest, exponent] = Math.abs(value).toExponential().split("e");
  const digits = shortest.replace(".", "");
  const shift = Number(exponent) - digits.length + 1 + count;
  const [over, under] = [10n ** BigInt(Math.max(shift, 0)), 10n ** BigInt(Math.max(-shift, 0))];
  const cut = (BigInt(digits) * over) % under;
  const whole = (BigInt(digits) * over) / under + (cut && up === value > 0 ? 1n : 0n);
  return pointed(whole, count, value < 0);
}

/** Five significant figures, rounded up or down: to the side on which what is said stays true. @param {number} value @param {boolean} up */
export function figures(value, up) {
  const [shortest, exponent] = Math.abs(value).toExponential().split("e");
  const digits = shortest.replace(".", "");
  const sign = value < 0 ? "-" : "";
  const own = pythonFloat(value);
  const few = own.split("e")[0].replace(/^-?[0.]*|\./g, "").length <= FIGURES;
  if (few) return own.includes("e") ? spelled(sign + shortest, Number(exponent)) : own;
  const more = digits.length > FIGURES && up === value > 0 ? 1 : 0;
  const kept = Number(digits.padEnd(FIGURES, "0").slice(0, FIGURES)) + more;
  const power = Number(exponent) + (kept < 10 ** FIGURES ? 0 : 1);
  const whole = String(kept).slice(0, FIGURES);
  return spelled(`${sign}${whole[0]}.${whole.slice(1)}`, power);
}

/** As `repr(value)` of a float. @param {number} value */
export function pythonFloat(value) {
  const none = unlimited(value);
  if (none || Object.is(value, -0)) return none ?? "-0.0";
  const [digits, exponent] = value.toExponential().split("e");
  const power = Number(exponent);
  if (value !== 0 && (power < -4 || power >= 16)) return `${digits}e${signed(power)}`;
  const text = spelled(digits, power);
  return text.includes(".") ? text : `${text}.0`;
}

/** Digits such as 1.25 times a power of ten, without an exponent. @param {string} digits @param {number} power */
function spelled(digits, power) {
  const sign = digits.startsWith("-") ? "-" : "";
  const bare = digits.replace("-", "").replace(".", "");
  if (power < 0) return `${sign}0.${"0".repeat(-power - 1)}${bare}`;
  const whole = bare.slice(0, power + 1).padEnd(power + 1, "0");
  const rest = bare.slice(power + 1);
  return `${sign}${whole}${rest && `.${rest}`}`;
}

/** @param {number} power */
function signed(power) {
  return `${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(2, "0")}`;
}
