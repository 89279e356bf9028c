// Tables of plans before they are checked: what is laid over a base, what is set, and keys without an
// effect. Twin of plans/toml.py.

import { _ } from "../words.js";
import { PlanError } from "./errors.js";
import { BUILT_IN_PLANS, DRAWN_KEYS, FORMATION_SIZES, TURN_KEYS } from "./plan_keys.js";
import { pythonRepr, pythonText } from "./python_text.js";

/** @typedef {Record<string, any>} Tables */

/**
 * A key that has no effect beside what a plan chooses: `because` is "KEY = VALUE" of the choice.
 * Or, where that is `missing`, without it.
 * Its `path` leads to it, table by table; a name may hold dots.
 * @typedef {{ path: Array<string | number>, beside: string, because: string, missing?: boolean }} Idle
 */

// Tables of which some keys have no effect beside others.
const CHOOSING = ["dragon", "route", "disc", "turn", "walk", "venue", "limits"];
const ALL_SIZES = new Set(Object.values(FORMATION_SIZES).flat());

/** The dotted key. @param {Idle} idle */
export function idleKey({ path }) {
  return path.join(".");
}

/** In a sentence. @param {Idle} idle */
export function idleText(idle) {
  const { because, missing } = idle;
  const key = idleKey(idle);
  if (missing)
    return _("{key} has no effect without one of {because}: take it out, or say one of them", {
      key,
      because,
    });
  return _("{key} has no effect beside {because}: take it out", { key, because });
}

/** @param {unknown} value @returns {value is Tables} */
function isPlain(value) {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** What a table says; null counts as not said. @param {unknown} table @returns {Tables} */
function saidIn(table) {
  if (!isPlain(table)) return {};
  return Object.fromEntries(
    Object.entries(table).filter(([, value]) => value !== null && value !== undefined),
  );
}

/** Whether a list or a text is there and not empty, as Python asks. @param {any} value */
function isFull(value) {
  if (Array.isArray(value) || typeof value === "string") return value.length > 0;
  return isPlain(value) ? Object.keys(value).length > 0 : Boolean(value);
}

/**
 * The keys of a plan's tables that have no effect beside others; null counts as not said.
 * Of several ways to say a drawing that under `latest` keys, just said, is chosen.
 * @param {Tables} data
 * @param {string[]} [latest]
 * @returns {Idle[]}
 */
export function idleKeys(data, latest = []) {
  const tables = Object.fromEntries(CHOOSING.map((name) => [name, saidIn(data[name])]));
  const { walk, dragon } = tables;
  const found = [...idleBesideRoute(tables, latest)];
  if (isFull(walk.profile) && "speed" in walk)
    found.push({ path: ["walk", "speed"], beside: "walk.profile", because: "walk.profile" });
  if (isFull(dragon.bench))
    for (const name of Object.keys(dragon).filter((one) => one !== "bench"))
      found.push({ path: ["dragon", name], beside: "dragon.bench", because: "[[dragon.bench]]" });
  return [...found, ...idleOnTheSquare(tables.venue, tables.limits)];
}

/** @param {Tables} tables @param {string[]} latest @returns {Idle[]} */
function idleBesideRoute({ route, turn, disc }, latest) {
  const kind = "part" in route ? "parts" : route.kind;
  const because = `route.kind = "${pythonText(kind)}"`;
  if (kind === "spiral-in") return idleIn("turn", turn, because);
  if (kind === "turn") return idleOfTurn(turn);
  const found = ["parts", "drawn", "formation", "programme"].includes(kind)
    ? [...idleIn("turn", turn, because), ...idleIn("disc", disc, because)]
    : [];
  if (kind === "formation") return [...found, ...idleSizes(route, ["route"])];
  if (kind === "drawn") return [...found, ...idleDrawn(route, latest)];
  if (kind !== "programme" || !Array.isArray(route.formation)) return found;
  const sizes = route.formation.map((/** @type {unknown} */ one, /** @type {number} */ i) =>
    idleSizes(saidIn(one), ["route", "formation", i]),
  );
  return [...found, ...sizes.flat()];
}

/** All keys of a table that means nothing beside the kind of a route. @param {string} name @param {Tables} table @param {string} because @returns {Idle[]} */
function idleIn(name, table, because) {
  return Object.keys(table).map((key) => ({ path: [name, key], beside: "route.kind", because }));
}

/** @param {Tables} turn @returns {Idle[]} */
function idleOfTurn(turn) {
  const family = turn.family ?? "arc-arc";
  const because = `turn.family = "${pythonText(family)}"`;
  return Object.keys(TURN_KEYS)
    .filter((name) => name in turn && !TURN_KEYS[name].includes(family))
    .map((name) => ({ path: ["turn", name], beside: "turn.family", because }));
}

/** @param {Tables} route @param {string[]} latest @returns {Idle[]} */
function idleDrawn(route, latest) {
  const ways = Object.keys(DRAWN_KEYS);
  const first = ways.find((name) => name in route && latest.includes(`route.${name}`));
  const chosen = first ?? ways.find((name) => name in route);
  if (chosen === undefined) return [];
  const idle = DRAWN_KEYS[chosen].filter((name) => name in route);
  const because = `route.${chosen}`;
  return idle.map((name) => ({ path: ["route", name], beside: because, because }));
}

/** @param {Tables} venue @param {Tables} limits @returns {Idle[]} */
function idleOnTheSquare(venue, limits) {
  const idle = idleAtTheEdge(venue, limits);
  if ("layer" in venue && !("file" in venue))
    idle.push({ path: ["venue", "layer"], beside: "venue", because: "venue.file", missing: true });
  return idle;
}

/** @param {Tables} venue @param {Tables} limits @returns {Idle[]} */
function idleAtTheEdge(venue, limits) {
  const inVenue = (/** @type {string[]} */ names) =>
    names.filter((name) => name in venue).map((name) => ["venue", name]);
  if ("boundary" in venue) {
    const because = "venue.boundary";
    return inVenue(["rectangle", "centre", "angle"]).map((path) => ({
      path,
      beside: because,
      because,
    }));
  }
  if ("rectangle" in venue || "file" in venue) return [];
  const others = inVenue(["centre", "angle"]);
  if (isFull(venue.name)) others.push(["venue", "name"]);
  if ("venue_margin" in limits) others.push(["limits", "venue_margin"]);
  const because = "venue.rectangle, venue.boundary, venue.file";
  return others.map((path) => ({ path, beside: "venue", because, missing: true }));
}

/** @param {Tables} table @param {Array<string | number>} path @returns {Idle[]} */
function idleSizes(table, path) {
  const name = String(table.name);
  if (!Object.hasOwn(FORMATION_SIZES, name)) return [];
  const own = FORMATION_SIZES[name];
  const strays = Object.keys(table).filter((size) => ALL_SIZES.has(size) && !own.includes(size));
  const beside = [...path, "name"].join(".");
  const because = `${beside} = "${pythonText(table.name)}"`;
  return strays.map((size) => ({ path: [...path, size], beside, because }));
}

/** Take keys out of a plan's tables. @param {Tables} data @param {Idle[]} idle */
export function dropKeys(data, idle) {
  for (const { path } of idle) {
    const table = path.slice(0, -1).reduce((/** @type {any} */ at, folder) => at[folder], data);
    delete table[path[path.length - 1]];
  }
}

/** Take out what has no effect beside the choices under `keys`, just made. @param {Tables} data @param {string[]} keys */
export function dropReplaced(data, keys) {
  const made = new Set(keys);
  const idle = idleKeys(data, keys);
  dropKeys(
    data,
    idle.filter((one) => made.has(one.beside) && !made.has(idleKey(one))),
  );
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
