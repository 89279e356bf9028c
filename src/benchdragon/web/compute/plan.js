// A whole plan: what it says, its hash, its walk and its span. Twin of plans/schema.py.

import { countText } from "../made/dragon.js";
import { Paced, outside, paced } from "../made/cues.js";
import { builtObstacles } from "../made/square.js";
import { drop, dropReplaced, idleKeys } from "../made/idle.js";
import { _, language } from "../words.js";
import { arena as arenaHere, within } from "./arena.js";
import { MODEL_DRAGON, PLANS_SOURCE } from "./constants.js";
import { Dragon, SizeError } from "./dragon.js";
import { Fault, Faults, InputError, KeyedError, PlanError, keyed } from "./errors.js";
import { withHolds } from "./holds.js";
import { checkedTables, filledTable, jsonOfTable, withoutDefaults } from "./plan_check.js";
import { setValue, withBase } from "./plan_tables.js";
import { SpeedProfile } from "../made/profile.js";
import { py } from "./python.js";
import { sha256 } from "./sha256.js";
import { Walk } from "./walk.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("../made/cues.js").Moment} Moment */
/** @typedef {import("../made/curves.js").Route} Route */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {Record<string, any>} Tables */

// What of a plan does not count for its hash, or only where it is said.
const ASIDE = ["meta", "venue", "obstacle", "survey", "people", "cues", "chalk", "event", "base"];
// What of the people's table decides whether a dance is safe.
const DECIDING = ["beside", "ahead", "sway", "imprecision", "most_speed"];
const SIZE_KEYS = ["length", "width", "front_inset", "rear_inset"];

/** A plan that was checked: `checkedPlan` makes it. */
export class Plan {
  /** @type {Paced | null} */
  #pace = null;
  /** @type {Obstacle[] | null} */
  #obstacles = null;
  #hash = "";

  /** @param {Tables} said what it says, in metres, seconds and degrees @param {string} source its name, in errors */
  constructor(said, source) {
    /** Only what is said, table by table; null counts as not said. */
    this.said = said;
    this.source = source;
    /** Every key, those left out as by default: `model_dump(by_alias=True)`. */
    this.tables = filledTable("Plan", said);
    /** Tables that sentences read as in Python. */
    this.limits = this.tables.limits;
    this.people = this.tables.people;
    this.cues = this.tables.cues;
    this.walk = this.tables.walk;
    this.disc = this.tables.disc;
    this.turn = this.tables.turn;
    this.route = this.tables.route;
  }

  /** Name of everything that the plan says, titles and notes left out. */
  get sha256() {
    this.#hash ||= sha256(jsonOfTable("Plan", this.#counted()));
    return this.#hash;
  }

  /** The tables that the hash is of. */
  #counted() {
    const own = Object.entries(this.tables).filter(([name]) => !ASIDE.includes(name));
    const data = Object.fromEntries(own.map(([name, of]) => [name, copyOf(of)]));
    if (data.limits.venue_margin === null) delete data.limits.venue_margin;
    const { at } = data.route;
    if (at === null || (at[0] === 0 && at[1] === 0)) delete data.route.at;
    if (data.route.turned === 0) delete data.route.turned;
    const { venue, obstacle, people, cues } = this.#notDefault();
    if (venue) data.venue = this.tables.venue;
    if (obstacle) data.obstacle = this.tables.obstacle;
    if (people) {
      const needs = Object.entries(people).filter(([name]) => DECIDING.includes(name));
      if (needs.length) data.people = Object.fromEntries(needs);
    }
    if (cues) data.cues = cues;
    return data;
  }

  /** What is not as by default. @returns {Tables} */
  #notDefault() {
    return withoutDefaults("Plan", this.tables);
  }

  /** What to call it in the language in use. */
  get title() {
    const { title, title_zh } = this.tables.meta;
    return language() === "zh" ? title_zh || title : title || title_zh;
  }

  /** Of the cues what is not as by default; null if nothing is. @returns {Tables | null} */
  get saidCues() {
    return this.#notDefault().cues ?? null;
  }

  /** Whether it says anything of people or cues: then papers are made of it. */
  get hasPapers() {
    const { people, cues } = this.#notDefault();
    return Boolean(people ?? cues);
  }

  /**
   * Every key that has an effect, those left out as by default, as plain data: the same plan.
   * Of the people, the cues, the marks and the event only what is said.
   * @returns {Tables}
   */
  data() {
    const { base: _base, ...tables } = this.tables;
    const data = withoutNulls(tables);
    const own = this.#notDefault();
    for (const name of ["people", "cues", "chalk", "event"]) {
      if (own[name]) data[name] = own[name];
      else delete data[name];
    }
    drop(data, idleKeys(data));
    return data;
  }

  /** What plan files need to say it: `Plan.toml`, as plain data; null never stands in it. @returns {Tables} */
  written() {
    const { base: _base, ...own } = this.#notDefault();
    return withoutNulls(own);
  }

  /**
   * The same plan with other values under keys such as route.pitch or route.part.0.length.
   * What the plan says for choices that they replace goes with it.
   * @param {Record<string, unknown>} values
   */
  withValues(values) {
    const data = withoutNulls(this.said);
    for (const [key, value] of Object.entries(values)) setValue(data, key, value);
    dropReplaced(data, Object.keys(values));
    return checkedPlan(data, this.source);
  }

  /** The same for a dict of Python. @param {Map<string, unknown>} values */
  with_values(values) {
    return this.withValues(py.object(values));
  }

  /** The same plan without its venue and its obstacles. */
  without_square() {
    const { venue: _venue, obstacle: _obstacle, ...data } = withoutNulls(this.said);
    if (data.limits) delete data.limits.venue_margin;
    return checkedPlan(data, this.source);
  }

  /** The number under a dotted key: `Plan.value`. @param {string} key @returns {number} */
  value(key) {
    const [table, name = ""] = key.split(/\.(.*)/s);
    const at = this.tables[table]?.[name] ?? null;
    const said = { ...this.said, [table]: { ...this.said[table], [name]: at ?? 0 } };
    const idle = idleKeys(said).filter((/** @type {any} */ one) => one.key === key);
    let because = idle.length ? idle[0].because : "";
    if (table === "route" && !(name in this.tables.route))
      because = `route.kind = "${this.tables.route.kind}"`;
    if (because) {
      const text = _("this needs {key}, which means nothing beside {because}: choose another plan", {
        key,
        because,
      });
      throw new PlanError(text);
    }
    if (typeof at !== "number") throw new PlanError(_("the plan does not say {key}: set it", { key }));
    return at;
  }

  /** What it says of the dragon, which is built of it. */
  get dragon() {
    const { dragon } = this.tables;
    return { ...dragon, build: () => builtDragon(arenaHere(), dragon) };
  }

  /** The head's speed over time. */
  profile() {
    return this.pace(arenaHere().engine).profile;
  }

  /** The same with one value. @param {string} key @param {unknown} value */
  with_value(key, value) {
    return this.withValues({ [key]: value });
  }

  /** When the dance starts, s. */
  get start() {
    return this.tables.walk.start ?? 0;
  }

  /** The head's speed over time without cues. */
  #plainProfile() {
    const { profile, speed } = this.tables.walk;
    const knots = profile.length ? profile : [[0, speed]];
    try {
      return new SpeedProfile(
        knots.map((/** @type {number[]} */ [t]) => t),
        knots.map((/** @type {number[]} */ [, v]) => v),
      );
    } catch (error) {
      if (!(error instanceof InputError)) throw error;
      throw keyed(profile.length ? "walk.profile" : "walk.speed", error.message);
    }
  }

  /** @param {Engine | null} engine */
  #paced(engine) {
    const { cues, limits } = this.tables;
    const profile = this.#plainProfile();
    const plain = !cues.cue.length && cues.acceleration === null;
    if (plain) this.#pace ??= new Paced(profile, this.start, []);
    else if (!this.#pace) {
      const own = engine ?? arenaHere().engine;
      this.#pace = paced(
        cues,
        profile,
        this.start,
        limits,
        (/** @type {[any, any, any, any, any]} */ ...asked) => withHolds(own, ...asked),
      );
    }
    return this.#pace;
  }

  /** The head's speed with all that holds it, which the engine makes once. @param {Engine | null} [engine] */
  pace(engine = null) {
    const faults = new Faults();
    const found = faults.tried("walk", () => this.#paced(engine));
    if (!found) throw this.#wrong(faults.found);
    return found;
  }

  /** All cues in their times and places, one after another. @returns {Moment[]} */
  moments() {
    return this.cues.cue.length ? this.pace().moments(this.cues) : [];
  }

  /**
   * How far the head walks from time 0, as without cues, to the start; to the end; at most; m. To the end
   * only if the plan says one, else not a number: `Plan.ways`.
   * @param {Engine | null} [engine]
   * @returns {[number, number, number]}
   */
  ways(engine = null) {
    const pace = this.pace(engine);
    const { end } = this.tables.walk;
    const begin = this.#plainProfile().distance(this.start);
    const most = begin + pace.way(Infinity);
    if (end === null) return [begin, pace.end < Infinity ? most : NaN, most];
    return [begin, begin + pace.way(end), most];
  }

  /**
   * The walk that the plan describes.
   * @param {Arena} [arena] which holds its arrays
   * @returns {Walk}
   */
  build(arena = arenaHere()) {
    const faults = new Faults();
    const dragon = faults.tried("dragon", () => builtDragon(arena, this.tables.dragon));
    const placed = faults.tried("route", () => this.#placed(arena, dragon));
    const pace = faults.tried("walk", () => this.#paced(arena.engine));
    faults.tried("obstacle", () => this.#builtObstacles());
    if (!dragon || !placed || !pace || faults.found.length) throw this.#wrong(faults.found);
    const [route, began] = placed;
    let position = this.tables.walk.position ?? began;
    // The dance starts where it does without cues.
    if (this.tables.cues.cue.length) position += this.ways()[0] - pace.profile.distance(this.start);
    const walk = faults.tried("walk.position", () => new Walk(dragon, route, pace.profile, position));
    if (!walk) throw this.#wrong(faults.found);
    return walk;
  }

  /** The route on the square, and where on it the head stands at time 0, m. @param {Arena} arena @param {Dragon | null} chain @returns {[Route, number]} */
  #placed(arena, chain) {
    return within(arena, () => {
      const [built, start] = this.route.build({ ...this.tables, chain });
      return [this.route.placed(built), start];
    });
  }

  /** The turn of its route, checked: its own walk's, or whatever the benches. @param {Arena} arena @returns {import("../made/turns.js").Turn} */
  ownTurn(arena) {
    return within(arena, () => this.route.turn({ ...this.tables, chain: null }));
  }

  #builtObstacles() {
    this.#obstacles ??= builtObstacles(this.tables.venue, this.tables.obstacle, this.limits);
    return this.#obstacles;
  }

  /** The venue's edge, if the plan says one, then the obstacles in it. @returns {Obstacle[]} */
  obstacles() {
    const faults = new Faults();
    const found = faults.tried("obstacle", () => this.#builtObstacles());
    if (!found) throw this.#wrong(faults.found);
    return found;
  }

  /**
   * Start and end of the whole walk, s: as the plan says, else as its route's kind says.
   * @param {Walk} walk
   * @returns {[number, number]}
   */
  span(walk) {
    const { start } = this;
    let { end } = this.tables.walk;
    if (end === null) {
      end = walk.time_at(this.route.last_position(walk));
      if (this.tables.cues.cue.length) end = Math.min(end, this.pace().end);
    }
    if (!Number.isFinite(end)) {
      const text = _("the head never comes to the end of its walk: set walk.end");
      throw this.#wrong([new Fault("walk", text)]);
    }
    const way = walk.headPosition(end) - walk.headPosition(start);
    const wrong = outside(this.moments(), start, end, way);
    if (wrong.length) throw this.#wrong(wrong);
    return [start, end];
  }

  /** @param {Fault[]} faults */
  #wrong(faults) {
    return new PlanError(faultSentences(faults, this.source));
  }
}

/** What is wrong, a line each, with the plan's name. @param {Fault[]} faults @param {string} source */
function faultSentences(faults, source) {
  const said = faults.slice(0, PLANS_SOURCE.MOST_FAULTS).map((fault) => `${source}: ${fault}`);
  if (faults.length > PLANS_SOURCE.MOST_FAULTS)
    said.push(_("and {count} more", { count: faults.length - PLANS_SOURCE.MOST_FAULTS }));
  return said.join("\n");
}

/** The dragon of a plan's table: `DragonTable.build`. @param {Arena} arena @param {Tables} table */
export function builtDragon(arena, table) {
  try {
    if (!table.bench.length) return Dragon.uniform(arena, /** @type {any} */ (table));
    const count = table.bench.reduce(
      (/** @type {number} */ sum, /** @type {Tables} */ one) => sum + one.count,
      0,
    );
    if (count > MODEL_DRAGON.MOST_BENCHES) throw new InputError(countText(count));
    const all = table.bench.flatMap((/** @type {Tables} */ one) => Array(one.count).fill(one));
    const [length, width, front_inset, rear_inset] = SIZE_KEYS.map((name) =>
      Float64Array.from(all, (one) => one[name]),
    );
    return new Dragon(arena, { length, width, front_inset, rear_inset });
  } catch (error) {
    if (!(error instanceof SizeError)) throw error;
    const keys = new Map();
    for (const [bench, size, text] of error.faults) {
      const key = sizeKey(table, bench, size);
      if (!keys.has(key)) keys.set(key, new Fault(key, text));
    }
    throw new KeyedError([...keys.values()]);
  }
}

/** The key that says a size of a bench (a row, from 0). @param {Tables} table @param {number} bench @param {string} size */
function sizeKey(table, bench, size) {
  if (table.bench.length) {
    let [entry, upTo] = [0, table.bench[0].count];
    while (upTo <= bench) upTo += table.bench[++entry].count;
    return `dragon.bench.${entry}.${size}`;
  }
  const place = bench === 0 ? "head_" : bench === table.benches - 1 ? "tail_" : "body_";
  return `dragon.${size === "length" ? place : ""}${size}`;
}

/** A copy of plain data. @template T @param {T} value @returns {T} */
function copyOf(value) {
  return structuredClone(value);
}

/** A copy of plain data without the keys that hold null. @param {any} value @returns {any} */
function withoutNulls(value) {
  if (Array.isArray(value)) return value.map(withoutNulls);
  if (typeof value !== "object" || value === null) return value;
  const kept = Object.entries(value).filter(([, of]) => of !== null && of !== undefined);
  return Object.fromEntries(kept.map(([key, of]) => [key, withoutNulls(of)]));
}

/**
 * The plan in parsed TOML or JSON; `source` is named in errors.
 * @param {Tables} data
 * @param {string} [source]
 * @returns {Plan}
 */
export function checkedPlan(data, source = "plan") {
  const tables = "base" in data ? withBase(data, source) : { ...data };
  const { route } = tables;
  if (typeof route === "object" && route !== null && "part" in route && !("kind" in route))
    tables.route = { ...route, kind: "parts" };
  const idle = idleKeys(tables).map((/** @type {any} */ one) => new Fault(one.key, one.text));
  const files = ["venue", "route"].filter((name) => typeof tables[name]?.file === "string");
  const outside = files.map((name) => new Fault(`${name}.file`, fileText(tables[name].file)));
  const { said, faults } = checkedTables(tables);
  const found = [...outside, ...faults, ...idle];
  if (found.length) throw new PlanError(faultSentences(found, source));
  return new Plan(said, source);
}

/** @param {string} name of a file beside a plan */
function fileText(name) {
  return _("this page does not read files that plans name, such as {name}: the command line does", {
    name,
  });
}
