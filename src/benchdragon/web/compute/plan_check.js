// The check of what a plan says: twin of the tables in plans/ and of plans/faults.py, made from the same
// models (plan_keys.js).

import { checkCue, timeOfDay } from "../made/cues.js";
import { EventTable, entrance } from "../made/event.js";
import { webAddress } from "../made/people.js";
import { quantity } from "../made/units.js";
import { FormationTable, StepTable } from "../made/formation_tables.js";
import {
  ArcPart,
  ClothoidPart,
  DragonTable,
  LinePart,
  LogSpiralPart,
  SpiralPart,
  TurnTable,
  WalkTable,
  oneLine,
} from "../made/tables.js";
import {
  DrawnRoute,
  FormationRoute,
  PartsRoute,
  ProgrammeRoute,
  SpiralInRoute,
  StreetTable,
  TurnRoute,
} from "../made/plan_routes.js";
import { CircleTable, LineTable, PolygonTable, RectangleTable, VenueTable } from "../made/square.js";
import { _ } from "../words.js";
import { PLANS_SOURCE } from "./constants.js";
import { Fault } from "./errors.js";
import { PLAN_TABLES, PLAN_UNITS } from "./plan_keys.js";
import { pythonFloat } from "./number_format.js";
import { ValueError, py } from "./python.js";
import { sha256 } from "./sha256.js";
import { asciiJson, nearestName, pythonJson, pythonText } from "./python_text.js";

/**
 * What may stand under a key: see tools/make_plan_keys.py.
 * @typedef {object} Spec
 * @property {string} type float, int, bool, text, choice, list, tuple, table or union
 * @property {boolean} [none] whether it may be null
 * @property {boolean} [required]
 * @property {any} [default]
 * @property {string} [units] name of the units of text with numbers, "" for none
 * @property {number} [ge] @property {number} [gt] @property {number} [le]
 * @property {number} [least] the least that is not 0
 * @property {number} [fewest] entries @property {number} [most] entries or letters
 * @property {string} [check] of a text or a list
 * @property {boolean} [day] whether it may be a date of TOML
 * @property {any[]} [values] of a choice
 * @property {any} [of] spec of a list's entries, or those of a tuple's
 * @property {string} [table] @property {Record<string, string>} [tables] by kind
 */

/** What tables do, by their names: those that are built. @type {Record<string, { prototype: object }>} */
const DOING = {
  ...{ ArcPart, ClothoidPart, LinePart, LogSpiralPart, SpiralPart },
  ...{ DragonTable, TurnTable, WalkTable, FormationTable, StepTable },
  ...{ EventTable, CircleTable, LineTable, PolygonTable, RectangleTable, VenueTable },
  ...{ DrawnRoute, FormationRoute, PartsRoute, ProgrammeRoute, SpiralInRoute, StreetTable, TurnRoute },
};

const NUMBER_TEXT = /^\s*[-+]?(?:\d[\d_]*\.?\d*|\.\d+)(?:e[-+]?\d+)?\s*$/i;
const [TRUTHS, UNTRUTHS] = [
  ["1", "on", "t", "true", "y", "yes"],
  ["0", "off", "f", "false", "n", "no"],
];
/** Checks of texts and lists, by their names. @type {Record<string, (value: any) => any>} */
const CHECKS = { entrance, one_line: oneLine, time_of_day: timeOfDay, web_address: webAddress };
// Letters of a value that are told.
const MOST_TOLD = 60;

/** A value that is not what was wanted. */
class Unwanted extends Error {
  /** @param {string} wanted @param {unknown} came @param {string} [step] */
  constructor(wanted, came, step = "") {
    super(wanted);
    this.came = came;
    this.step = step;
  }
}

/** Checks a plan, and gathers what is wrong. */
class Check {
  /** @type {Fault[]} */
  faults = [];

  /**
   * The value in the units that count; undefined, and a fault, where it cannot be.
   * @param {Spec} spec
   * @param {unknown} value
   * @param {string} where dotted key
   * @returns {any}
   */
  value(spec, value, where) {
    if (spec.none && value === null) return null;
    try {
      return this.#checked(spec, value, where);
    } catch (error) {
      if (error instanceof ValueError) this.#add(where, `${where}: ${error.message}`);
      else if (error instanceof Unwanted) this.#unwanted(where + error.step, error);
      else throw error;
    }
    return undefined;
  }

  /** @param {string} where @param {Unwanted} error */
  #unwanted(where, error) {
    const json = pythonJson(error.came);
    const letters = Array.from(json);
    const came = letters.length <= MOST_TOLD ? json : `${letters.slice(0, MOST_TOLD - 3).join("")}...`;
    const wanted = error.message.replaceAll(" or ", ", ");
    this.#add(where, _("{where}: expected {wanted}, not {came}", { where, wanted, came }));
  }

  /** @param {string} where @param {string} text */
  #add(where, text) {
    this.faults.push(new Fault(where, text));
  }

  /** @param {Spec} spec @param {unknown} value @param {string} where */
  #checked(spec, value, where) {
    switch (spec.type) {
      case "float":
        return floatOf(spec, value);
      case "int":
        return wholeOf(spec, value);
      case "bool":
        return truthOf(value);
      case "text":
        return textOf(spec, value);
      case "choice":
        return choiceOf(spec, value);
      case "table":
        return this.table(/** @type {string} */ (spec.table), value, where);
      case "union":
        return this.#union(spec, value, where);
      default:
        return this.#entries(spec, value, where);
    }
  }

  /** @param {Spec} spec @param {unknown} value @param {string} where */
  #entries(spec, value, where) {
    if (!Array.isArray(value)) throw new Unwanted(_("a list"), value);
    if (spec.type === "list") {
      if (spec.most !== undefined && value.length > spec.most) throw tooLong(spec.most, value);
      const before = this.faults.length;
      const found = value.map((one, i) => this.value(spec.of, one, `${where}.${i}`));
      if (spec.fewest !== undefined && value.length < spec.fewest)
        throw new Unwanted(_("at least {min_length} entries", { min_length: spec.fewest }), value);
      return spec.check && this.faults.length === before ? CHECKS[spec.check](found) : found;
    }
    const specs = /** @type {Spec[]} */ (spec.of);
    if (value.length > specs.length) throw tooLong(specs.length, value);
    return specs.map((one, i) => {
      if (i < value.length) return this.value(one, value[i], `${where}.${i}`);
      this.#missing(`${where}.${i}`);
      return undefined;
    });
  }

  /** @param {Spec} spec @param {unknown} value @param {string} where */
  #union(spec, value, where) {
    const tables = /** @type {Record<string, string>} */ (spec.tables);
    if (!isTable(value)) throw new Unwanted(_("a table"), value);
    if (!("kind" in value)) throw new Unwanted(_("a table with the key kind"), value);
    const { kind } = value;
    if (typeof kind !== "string" || !Object.hasOwn(tables, kind)) {
      const known = Object.keys(tables).map((name) => `'${name}'`);
      throw new Unwanted(known.join(", "), pythonText(kind), ".kind");
    }
    return this.table(tables[kind], value, where);
  }

  /**
   * @param {string} name of the table
   * @param {unknown} value
   * @param {string} where
   */
  table(name, value, where) {
    if (!isTable(value)) throw new Unwanted(_("a table"), value);
    const keys = PLAN_TABLES[name];
    const before = this.faults.length;
    const inside = (/** @type {string} */ key) => (where ? `${where}.${key}` : key);
    /** @type {Record<string, any>} */
    const found = {};
    for (const [key, spec] of Object.entries(keys)) {
      if (Object.hasOwn(value, key)) found[key] = this.value(spec, value[key], inside(key));
      else if (spec.required) this.#missing(inside(key));
    }
    for (const key of Object.keys(value))
      if (!Object.hasOwn(keys, key)) this.#unknown(key, Object.keys(keys), inside);
    if (name === "CueTable" && this.faults.length === before) checkCue(found);
    return found;
  }

  /** @param {string} where */
  #missing(where) {
    this.#add(where, _("{where} is missing", { where }));
  }

  /** @param {string} key @param {string[]} known keys @param {(key: string) => string} inside */
  #unknown(key, known, inside) {
    const where = inside(key);
    // Of those that are only counted, what they might mean is not looked for.
    const near = this.faults.length < PLANS_SOURCE.MOST_FAULTS ? nearestName(key, known) : "";
    const hint = near && _("; did you mean {name}?", { name: inside(near) });
    this.#add(where, _("{where} is not a known key", { where }) + hint);
  }
}

/** @param {unknown} value @returns {value is Record<string, unknown>} */
function isTable(value) {
  return (
    typeof value === "object" && value !== null && !Array.isArray(value) && !(value instanceof Date)
  );
}

/** @param {number} most @param {unknown} value */
function tooLong(most, value) {
  return new Unwanted(_("at most {max_length} entries", { max_length: most }), value);
}

/** @param {Spec} spec @param {unknown} value */
function floatOf(spec, value) {
  let number = spec.units === undefined ? value : quantity(value, PLAN_UNITS[spec.units] ?? {});
  if (typeof number === "string" && NUMBER_TEXT.test(number))
    number = Number(number.replaceAll("_", ""));
  if (typeof number !== "number") throw new Unwanted(_("a number"), number);
  if (!Number.isFinite(number)) throw new Unwanted(_("a finite number"), number);
  inRange(spec, number);
  const { least } = spec;
  if (least !== undefined && 0 < number && number < least)
    throw new ValueError(
      _("expected at least {least}, not {value}", {
        least: pythonFloat(least),
        value: pythonFloat(number),
      }),
    );
  return number;
}

/** @param {Spec} spec @param {unknown} value */
function wholeOf(spec, value) {
  if (typeof value !== "number" || !Number.isInteger(value))
    throw new Unwanted(_("a whole number"), value);
  inRange(spec, value);
  return value;
}

/** @param {Spec} spec @param {number} value */
function inRange({ type, le, ge, gt }, value) {
  const shown = (/** @type {number} */ limit) => (type === "int" ? String(limit) : pythonFloat(limit));
  if (le !== undefined && value > le) throw new Unwanted(_("at most {le}", { le: shown(le) }), value);
  if (ge !== undefined && value < ge) throw new Unwanted(_("at least {ge}", { ge: shown(ge) }), value);
  if (gt !== undefined && value <= gt)
    throw new Unwanted(_("more than {gt}", { gt: shown(gt) }), value);
}

/** @param {unknown} value */
function truthOf(value) {
  const said = typeof value === "boolean" ? String(value) : String(value).toLowerCase();
  const plain = typeof value === "boolean" || typeof value === "string" || value === 0 || value === 1;
  if (plain && TRUTHS.includes(said)) return true;
  if (plain && UNTRUTHS.includes(said)) return false;
  throw new Unwanted(_("true or false"), value);
}

/** @param {Spec} spec @param {unknown} value */
function textOf(spec, value) {
  const said = spec.day && value instanceof Date ? value.toISOString() : value;
  if (typeof said !== "string") throw new Unwanted(_("text"), value);
  if (spec.most !== undefined && Array.from(said).length > spec.most)
    throw new ValueError(`String should have at most ${spec.most} characters`);
  return spec.check === undefined ? said : CHECKS[spec.check](said);
}

/** @param {Spec} spec @param {unknown} value */
function choiceOf(spec, value) {
  const values = /** @type {unknown[]} */ (spec.values);
  if (values.includes(value)) return value;
  if (value === true && values.includes(1)) return 1; // as Python has it
  const known = values.map((one) => (typeof one === "string" ? `'${one}'` : String(one)));
  throw new Unwanted(known.join(", "), value);
}

/**
 * What a plan says, in metres, seconds and degrees, and what is wrong with it.
 * @param {Record<string, unknown>} data
 */
export function checkedTables(data) {
  const check = new Check();
  const said = check.value({ type: "table", table: "Plan" }, data, "");
  return { said, faults: check.faults };
}

/**
 * Everything that counts in a table: what is said, and the defaults of what is not.
 * @param {string} name of the table
 * @param {Record<string, any>} said as checked
 * @returns {Record<string, any>}
 */
export function filledTable(name, said) {
  const keys = Object.entries(PLAN_TABLES[name]);
  const made = keys.map(([key, spec]) => [
    key,
    inside(spec, key in said ? said[key] : spec.default, filledTable),
  ]);
  return Object.assign(
    Object.create(DOING[name]?.prototype ?? Object.prototype),
    Object.fromEntries(made),
  );
}

/** A value of a spec, its tables as `made` makes them. @param {Spec} spec @param {any} value @param {(name: string, table: any) => any} made @returns {any} */
function inside(spec, value, made) {
  if (value === null) return null;
  const name = tableOf(spec, value);
  if (name) return made(name, value);
  return spec.type === "list"
    ? value.map((/** @type {any} */ one) => inside(spec.of, one, made))
    : value;
}

/** The name of the table that a value of a spec is; undefined if it is none. @param {Spec} spec @param {any} value */
function tableOf(spec, value) {
  return spec.table ?? spec.tables?.[value.kind];
}

/**
 * What of a filled table is not as by default: `model_dump(exclude_defaults=True)`.
 * @param {string} name
 * @param {Record<string, any>} table
 * @returns {Record<string, any>}
 */
export function withoutDefaults(name, table) {
  const keys = Object.entries(PLAN_TABLES[name]);
  const own = keys.filter(([key, spec]) => spec.required || !isDefault(spec, table[key]));
  return Object.fromEntries(own.map(([key, spec]) => [key, inside(spec, table[key], withoutDefaults)]));
}

/** Whether a value is the one of who says nothing, be it -0. @param {Spec} spec @param {any} value */
function isDefault(spec, value) {
  const plain = (/** @type {any} */ one) => jsonOf(spec, one).replace(/-(0\.0)(?!\d)/g, "$1");
  return plain(value) === plain(inside(spec, spec.default, filledTable));
}

/**
 * As `json.dumps(value, sort_keys=True)`: floats are floats, even where they are whole.
 * @param {Spec} spec
 * @param {any} value
 * @returns {string}
 */
function jsonOf(spec, value) {
  if (value === null || value === undefined) return "null";
  switch (spec.type) {
    case "float":
      return pythonFloat(value);
    case "list":
      return `[${value.map((/** @type {any} */ one) => jsonOf(spec.of, one)).join(", ")}]`;
    case "tuple":
      return `[${spec.of.map((/** @type {Spec} */ one, /** @type {number} */ i) => jsonOf(one, value[i])).join(", ")}]`;
    case "table":
    case "union":
      return jsonOfTable(/** @type {string} */ (tableOf(spec, value)), value);
    default:
      return typeof value === "string" ? asciiJson(value) : String(value);
  }
}

/** The same of a table, of the keys that it has. @param {string} name @param {Record<string, any>} table @returns {string} */
function jsonOfTable(name, table) {
  const keys = py.keys(table).sort();
  const said = (/** @type {string} */ key) => jsonOf(PLAN_TABLES[name][key], py.at(table, key));
  return `{${keys.map((/** @type {string} */ key) => `"${key}": ${said(key)}`).join(", ")}}`;
}

/** The hash of a plan's tables. @param {Record<string, any>} data */
export function _hashed(data) {
  return sha256(jsonOfTable("Plan", data));
}

// Tables within tables that are copied: no plan has so many.
const DEEPEST = 30;

/**
 * A copy of plain data, its dicts as objects; without the keys that hold null unless they are wanted.
 * @param {any} value @param {boolean} [withNull] @param {number} [deep] @returns {any}
 */
export function plain(value, withNull = true, deep = 0) {
  if (deep > DEEPEST) return value;
  if (Array.isArray(value)) return value.map((one) => plain(one, withNull, deep + 1));
  if (!isTable(value)) return value;
  /** @type {[string, any][]} */
  const all = py.items(value);
  const kept = all.filter(([, of]) => withNull || (of !== null && of !== undefined));
  return Object.fromEntries(kept.map(([key, of]) => [key, plain(of, withNull, deep + 1)]));
}
