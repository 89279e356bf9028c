// Texts as Python writes them: values in sentences, JSON for hashes, and near misses of names.

import { pythonFloat } from "./number_format.js";

const ESCAPES = /** @type {Record<string, string>} */ ({
  "\n": "\\n",
  "\r": "\\r",
  "\t": "\\t",
  "\\": "\\\\",
});

/** As `repr(text)`. @param {string} text */
export function pythonRepr(text) {
  const quote = text.includes("'") && !text.includes('"') ? '"' : "'";
  const inner = Array.from(text, (sign) => (sign === quote ? `\\${sign}` : shownSign(sign)));
  return `${quote}${inner.join("")}${quote}`;
}

/** @param {string} sign */
function shownSign(sign) {
  if (sign in ESCAPES) return ESCAPES[sign];
  if (isPrintable(sign)) return sign;
  const code = /** @type {number} */ (sign.codePointAt(0));
  if (code < 0x100) return `\\x${code.toString(16).padStart(2, "0")}`;
  if (code < 0x10000) return `\\u${code.toString(16).padStart(4, "0")}`;
  return `\\U${code.toString(16).padStart(8, "0")}`;
}

/** As `text.isprintable()`. @param {string} text */
export function isPrintable(text) {
  return !/[\p{C}\p{Zl}\p{Zp}]|(?! )\p{Zs}/u.test(text);
}

/** Whether it is a whole number that no double holds. @param {unknown} value */
export function _vast(value) {
  return typeof value === "bigint";
}

/** As `json.dumps(value, ensure_ascii=False)`; whole numbers are written without a point. @param {unknown} value @returns {string} */
export function pythonJson(value) {
  if (Array.isArray(value)) return `[${value.map(pythonJson).join(", ")}]`;
  if (typeof value === "number")
    return Number.isInteger(value) && Math.abs(value) < 1e16 ? String(value) : jsonFloat(value);
  if (typeof value === "object" && value !== null && !(value instanceof Date)) {
    const entries = Object.entries(value);
    return `{${entries.map(([key, of]) => `${JSON.stringify(key)}: ${pythonJson(of)}`).join(", ")}}`;
  }
  return JSON.stringify(value instanceof Date ? String(value.toISOString()) : (value ?? null));
}

/** As `str(value)` of what a TOML file may hold, but for texts inside others. @param {unknown} value */
export function pythonText(value) {
  if (typeof value === "string") return value;
  return { null: "None", true: "True", false: "False" }[pythonJson(value)] ?? pythonJson(value);
}

/** A float as JSON of Python has it. @param {number} value */
function jsonFloat(value) {
  if (Number.isNaN(value)) return "NaN";
  return Number.isFinite(value) ? pythonFloat(value) : value > 0 ? "Infinity" : "-Infinity";
}

/** A text as `json.dumps` has it: nothing beyond ASCII. @param {string} text */
export function asciiJson(text) {
  const escape = (/** @type {string} */ unit) =>
    `\\u${unit.charCodeAt(0).toString(16).padStart(4, "0")}`;
  return JSON.stringify(text).replace(/[\u007f-\uffff]/g, escape);
}

/** The best of `difflib.get_close_matches(word, known, 1)`; "" if none is near. @param {string} word @param {string[]} known */
export function nearestName(word, known) {
  let [best, found] = [0.6, ""];
  for (const name of known) {
    const share = (2 * matches(name, word)) / (name.length + word.length);
    if (share > best || (share === best && share >= 0.6 && name > found)) [best, found] = [share, name];
  }
  return found;
}

/** How many signs match, as `difflib.SequenceMatcher` counts them. @param {string} one @param {string} other @returns {number} */
function matches(one, other) {
  let [size, first, second] = [0, 0, 0];
  for (let i = 0; i < one.length; i++)
    for (let j = 0; j < other.length; j++) {
      let k = 0;
      while (i + k < one.length && j + k < other.length && one[i + k] === other[j + k]) k++;
      if (k > size) [size, first, second] = [k, i, j];
    }
  if (!size) return 0;
  const before = matches(one.slice(0, first), other.slice(0, second));
  return before + size + matches(one.slice(first + size), other.slice(second + size));
}
