// Numbers as people type them, read as `benchdragon new` reads its answers (twin of cli/new_answers.py):
// "150cm", "1米5", "一米五", "0.8米/秒". What might be meant otherwise is no number: it is asked back.

import { PLAN_UNITS } from "./compute/plan_keys.js";
import { quantity } from "./made/units.js";
import { NUMERALS, numeral } from "./made/roster_words.js";

/** The units that may stand behind a number of a unit of the form. @type {Record<string, Record<string, number>>} */
const UNITS = {
  m: PLAN_UNITS.METRES,
  s: PLAN_UNITS.SECONDS,
  "m/s": { ...PLAN_UNITS.SPEEDS, 米: 1 },
  "m/s\u00b2": PLAN_UNITS.ACCELERATIONS,
  "\u00b0/s": PLAN_UNITS.ANGULAR_SPEEDS,
};
const NUMBER = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/;
const COUNTED = /(?:个人|人|个|条|桥|节|张|块|benches|bench)$/;
/** "1米5" is a metre and a half, "1米85" is 1.85 m. */
const METRES_AND = /^(\d+)(?:米|m)(\d{1,2})(?:公分|厘米|cm)?$/;
/** A number partly in digits and partly in words, or in two parts. */
const MIXED = new RegExp(`[0-9.][${NUMERALS}]|[${NUMERALS}][0-9.]|[0-9.]\\s+[0-9.]`);
/** The same unit at two numbers. */
const TWICE = /([^\d.]+)[\d.]+\1$/;
const ABOUT = /^(?:大约|大概|差不多|约|about)|(?:左右|上下)$/g;

/** A text as it is read: in half-width signs and Arabic digits, without spaces. @param {string} text */
function plainly(text) {
  const typed = text.replace(/\s/g, "").replace(/[。.,]+$/, "").replace(ABOUT, ""); // prettier-ignore
  return typed.replace(new RegExp(`[${NUMERALS}]+`, "g"), (word) => String(numeral(word) ?? word));
}

/**
 * The number in a unit of the form that a text says; null where it says none for sure.
 * @param {string} text
 * @param {string} unit "" of a count or a ratio
 * @returns {number | null}
 */
export function typedNumber(text, unit) {
  const said = text.normalize("NFKC").trim().toLowerCase().replaceAll("\u2212", "-");
  if (MIXED.test(said)) return null;
  const plain = unit ? plainly(said) : plainly(said).replace(COUNTED, "");
  const parts = unit === "m" ? METRES_AND.exec(plain) : null;
  const number = parts ? `${parts[1]}.${parts[2]}` : plain;
  try {
    if (TWICE.test(number)) return null;
    if (NUMBER.test(number)) return finite(Number(number));
    return finite(quantity(number, UNITS[unit] ?? {}));
  } catch {
    return null;
  }
}

/** @param {unknown} value */
function finite(value) {
  return typeof value === "number" && Number.isFinite(value) ? value : null;
}
