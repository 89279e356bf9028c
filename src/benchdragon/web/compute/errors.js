// Everything that can go wrong, in words: twin of errors.py, and of Fault and Faults in plans/source.py.

import { advice } from "../made/advice.js";
import { _ } from "../words.js";
import { ERRORS, PLANS_SOURCE } from "./constants.js";
import { general, pythonFloat } from "./number_format.js";
import { pythonRepr } from "./python_text.js";

export class BenchDragonError extends Error {}

/** A value that cannot be used: what was wanted, and what came. */
export class InputError extends BenchDragonError {}

/** A question that could not be decided within the budget. */
export class UnsureError extends BenchDragonError {}

/** What was sought is not there. */
export class NoSolutionError extends InputError {}

/** A plan that cannot be read or used: where, what was wanted, and what came. */
export class PlanError extends BenchDragonError {}

/** A dragon that cannot stand on its route. */
export class WalkError extends BenchDragonError {
  /**
   * @param {number} status how it failed
   * @param {number} bench 1..N; 0 for the head's handle
   * @param {number} s route position of that bench's front handle, m
   * @param {number} head route position of the head's handle, m
   * @param {string} size of the route, or of the bench's link, in words
   * @param {number | null} [t] s; null where no walk says when
   */
  constructor(status, bench, s, head, size, t = null) {
    super();
    this.status = status;
    this.bench = bench;
    this.s = s;
    this.head = head;
    this.size = size;
    this.t = t;
  }

  /** The same error at a time, s; one that never comes stays untold. @param {number} t */
  at(t) {
    const when = Number.isFinite(t) ? t : null;
    return new WalkError(this.status, this.bench, this.s, this.head, this.size, when);
  }

  /** What went wrong, with advice, in the language in use. */
  get message() {
    return advice(this);
  }
}

/** What is wrong under a dotted key of a plan; "" is the whole plan. */
export class Fault {
  /** @param {string} key @param {string} text */
  constructor(key, text) {
    this.key = key;
    this.text = text;
  }

  toString() {
    const { key, text } = this;
    const said = text.startsWith(key) ? text : `${key}: ${text}`;
    const signs = Array.from(key.slice(0, 2 * PLANS_SOURCE.MOST_SIGNS + 2));
    if (signs.length <= PLANS_SOURCE.MOST_SIGNS) return said;
    return said.replaceAll(key, () => `${signs.slice(0, PLANS_SOURCE.MOST_SIGNS).join("")}...`);
  }
}

/** What is wrong with a plan when it is built. */
export class KeyedError extends InputError {
  /** @param {Fault[]} faults */
  constructor(faults) {
    super(faults.join("\n"));
    this.faults = faults;
  }
}

/** The error of one key. @param {string} key @param {string} text */
export function keyed(key, text) {
  return new KeyedError([new Fault(key, text)]);
}

/** Gathers what is wrong while parts of a plan are built, so that all can be said at once. */
export class Faults {
  /** @type {Fault[]} */
  found = [];

  /**
   * What `make` makes of the key; null, and a fault, where it cannot.
   * @template T
   * @param {string} key
   * @param {() => T} make
   * @returns {T | null}
   */
  tried(key, make) {
    try {
      return make();
    } catch (error) {
      if (error instanceof KeyedError) this.found.push(...error.faults);
      else if (error instanceof InputError) this.found.push(new Fault(key, error.message));
      else throw error;
    }
    return null;
  }
}

/** A text as Python writes it, cut short. @param {string} text */
export function brief(text) {
  return Array.from(pythonRepr(text)).slice(0, ERRORS.MOST_SHOWN).join("");
}

/** @param {number} value @param {string} unit */
function withUnit(value, unit) {
  return `${pythonFloat(value)} ${unit}`.trim();
}

/** `value`, if it is a finite number. @param {string} name @param {number} value @param {string} [unit] */
export function finite(name, value, unit = "") {
  if (!Number.isFinite(value))
    throw new InputError(
      _("{name} must be finite, not {value}", { name, value: withUnit(value, unit) }),
    );
  return value;
}

/** Check two times, s. @param {number} start @param {number} end */
export function inOrder(start, end) {
  if (finite("end", end, "s") >= finite("start", start, "s")) return;
  const values = { end: general(end), start: general(start) };
  throw new InputError(_("the end ({end} s) must not come before the start ({start} s)", values));
}

/** `value`, if it is finite and above 0. @param {string} name @param {number} value @param {string} [unit] */
export function positive(name, value, unit = "") {
  if (finite(name, value, unit) <= 0)
    throw new InputError(
      _("{name} must be positive, not {value}", { name, value: withUnit(value, unit) }),
    );
  return value;
}

/** `value`, if it is finite and at least 0. @param {string} name @param {number} value @param {string} [unit] */
export function notNegative(name, value, unit = "") {
  if (finite(name, value, unit) < 0)
    throw new InputError(
      _("{name} must not be negative, but is {value}", { name, value: withUnit(value, unit) }),
    );
  return value;
}
