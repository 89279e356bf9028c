// Kinds of errors, and how a value is shown in them: what errors.py says with what Python has of its own.

import { ERRORS } from "./constants.js";
import { pythonFloat } from "./number_format.js";
import { pythonRepr } from "./python_text.js";

export class BenchDragonError extends Error {
  /** @param {unknown} [said] what is wrong, unless the kind of error says that itself */
  constructor(said) {
    super(typeof said === "string" ? said : undefined);
  }
}

/** A value that cannot be used: what was wanted, and what came. */
export class InputError extends BenchDragonError {}

/** A question that could not be decided within the budget. */
export class UnsureError extends BenchDragonError {}

/** What was sought is not there. */
export class NoSolutionError extends InputError {}

/** A plan that cannot be read or used: where, what was wanted, and what came. */
export class PlanError extends BenchDragonError {}

/** A text as Python writes it, cut short. @param {string} text */
export function brief(text) {
  return Array.from(pythonRepr(text)).slice(0, ERRORS.MOST_SHOWN).join("");
}

/** @param {number} value @param {string} unit */
export function _with(value, unit) {
  return `${pythonFloat(value)} ${unit}`.trim();
}
