// Tables of plans before they are checked: what is laid over a base, what is set. Twin of plans/toml.py.

import { dropReplaced } from "../made/idle.js";
import { _ } from "../words.js";
import { PlanError } from "./errors.js";
import { BUILT_IN_PLANS } from "./plan_keys.js";
import { pythonRepr } from "./python_text.js";

/** @typedef {Record<string, any>} Tables */

/** @param {unknown} value @returns {value is Tables} */
function isPlain(value) {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/**
 * Set the value under a dotted key, in which the parts of a list have numbers from 0.
 * @param {Tables} data
 * @param {string} key
 * @param {unknown} value
 */
export function setValue(data, key, value) {
  const folders = key.split(".");
  const last = /** @type {string} */ (folders.pop());
  const at = folders.reduce((/** @type {any} */ table, name) => {
    const slot = slotOf(table, name, key);
    if (!Array.isArray(table) && !(slot in table)) table[slot] = {};
    if (typeof table[slot] !== "object" || table[slot] === null) throw nowhere(key);
    return table[slot];
  }, data);
  at[slotOf(at, last, key)] = value;
}

/** @param {any} at @param {string} name @param {string} key */
function slotOf(at, name, key) {
  if (!Array.isArray(at)) return name;
  const i = /^-?\d+$/.test(name) ? Number(name) : NaN;
  if (!(i >= -at.length && i < at.length)) throw nowhere(key);
  return i < 0 ? i + at.length : i;
}

/** @param {string} key */
function nowhere(key) {
  return new PlanError(_("there is no {key} to set", { key }));
}

/**
 * The tables of a plan laid over those of the built-in plan that its `base` names; all, if it has none.
 * @param {Tables} data
 * @param {string} source name of the plan, in errors
 * @returns {Tables}
 */
export function withBase(data, source) {
  const { base, ...own } = data;
  if (!("base" in data)) return own;
  if (typeof base !== "string" || !Object.hasOwn(BUILT_IN_PLANS, base)) {
    const names = Object.keys(BUILT_IN_PLANS).join(", ");
    throw new PlanError(
      _("{source}: base must be one of {names} or the name of a file beside it, not {base}", {
        source,
        names,
        base: typeof base === "string" ? pythonRepr(base) : String(base),
      }),
    );
  }
  const below = structuredClone(BUILT_IN_PLANS[base]);
  const laid = Object.entries(own).map(([name, table]) => laidOver(below, name, table));
  // Not by assignment: a stranger's table may be called __proto__.
  const merged = Object.fromEntries([
    ...Object.entries(below),
    ...laid.map(({ name, table }) => [name, table]),
  ]);
  dropReplaced(
    merged,
    laid.flatMap(({ keys }) => keys),
  );
  return merged;
}

/** A plan's own table over that of its base, and the keys that it lays over it. @param {Tables} below @param {string} name @param {any} table */
function laidOver(below, name, table) {
  const before = Object.hasOwn(below, name) ? below[name] : undefined;
  if (name === "obstacle" && Array.isArray(table) && Array.isArray(before))
    return { name, table: [...before, ...table], keys: [] };
  if (!isPlain(table)) return { name, table, keys: [] };
  const keys = Object.keys(table).map((key) => `${name}.${key}`);
  if (isPlain(before) && !isAnother(name, before, table))
    return { name, table: { ...before, ...table }, keys };
  return { name, table, keys: [...keys, `${name}.kind`] };
}

/** Whether a table replaces that of the base as a whole. @param {string} name @param {Tables} before @param {Tables} table */
function isAnother(name, before, table) {
  const kind = (/** @type {Tables} */ one) => ("part" in one ? "parts" : one.kind);
  const own = kind(table);
  return name === "venue" || (own !== undefined && own !== null && own !== kind(before));
}
