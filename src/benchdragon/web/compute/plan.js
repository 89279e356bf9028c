// A whole plan in a page: what it says, and what it builds in an arena. The rest is made from plans/schema.py.

import { idleKeys } from "../made/idle.js";
import { Plan as MadePlan } from "../made/plan.js";
import { Fault, Source } from "../made/source.js";
import { withBase } from "../made/toml.js";
import { _ } from "../words.js";
import { arena as here, withArena, within } from "./arena.js";
import { PlanError } from "./errors.js";
import { checkedTables, filledTable, plain, withoutDefaults } from "./plan_check.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {Record<string, any>} Tables */
/**
 * What is made from Python, and the tables, by their names.
 * @typedef {{ obstacles: () => import("./obstacle.js").Obstacle[], moments: () => import("../made/cues.js").Moment[],
 *   span: (walk: import("./walk.js").Walk) => [number, number], [name: string]: any }} Made
 */

/** A plan that was checked: `checked` makes it. Its tables stand in it by their names. */
export class Plan extends /** @type {new () => Made} */ (/** @type {any} */ (MadePlan)) {
  /** @type {[Arena, import("./dragon.js").Dragon] | null} */
  #built = null;
  /** @type {Tables} */
  #said;

  /** @param {Tables} said what it says, in metres, seconds and degrees @param {string} source its name, in errors */
  constructor(said, source) {
    super();
    this.#said = said;
    Object.assign(this, filledTable("Plan", said), { _source: new Source(source) });
  }

  /** Only what is said; null counts as not said. @returns {Tables} */
  said() {
    return plain(this.#said, false);
  }

  /** What is not as by default. @returns {Tables} */
  own() {
    const { base: _base, ...own } = withoutDefaults("Plan", this);
    return plain(own, false);
  }

  /** Every key, those left out as by default. @param {boolean} [withNull] @returns {Tables} */
  whole(withNull = true) {
    const { base: _base, ...tables } = filledTable("Plan", this);
    return plain(tables, withNull);
  }

  /** @param {Tables} data */
  _changed(data) {
    return checked(data, this._source.name);
  }

  /** The dragon, in the arena in which the plan is built. */
  get _dragon() {
    if (this.#built?.[0] !== here()) this.#built = [here(), this.dragon.build()];
    return this.#built?.[1];
  }

  /** The walk that the plan describes. @param {Arena} [arena] which holds its arrays @returns {import("./walk.js").Walk} */
  build(arena = here()) {
    return within(arena, () => super.build());
  }

  /** The head's speed with all that holds it, which the engine makes once. @param {Engine | null} [engine] @returns {any} */
  pace(engine = null) {
    const told = () => super.pace();
    return engine ? withArena(engine, (arena) => within(arena, told)) : told();
  }

  /** See `Plan.ways` of plans/schema.py. @param {Engine} engine @returns {[number, number, number]} */
  ways(engine) {
    this.pace(engine);
    return super.ways();
  }

  /** The turn of its route, checked whatever the benches. @param {Arena} arena @returns {import("../made/turns.js").Turn} */
  ownTurn(arena) {
    return within(arena, () => this.route.turn({ disc: this.disc, turn: this.turn, chain: null }));
  }
}

/**
 * The plan in parsed TOML or JSON; `source` is named in errors.
 * @param {Tables} data
 * @param {string} [source]
 * @returns {Plan}
 */
export function checked(data, source = "plan") {
  const tables = plain(withBase(data, null, source));
  const { route } = tables;
  if (typeof route === "object" && route !== null && "part" in route && !("kind" in route))
    tables.route = { ...route, kind: "parts" };
  const idle = idleKeys(tables).map((/** @type {any} */ one) => new Fault(one.key, one.text));
  const named = { venue: tables.venue, route: tables.route, "route.street": tables.route?.street };
  const outside = Object.entries(named)
    .filter(([, table]) => typeof table?.file === "string")
    .map(([name, { file }]) => new Fault(`${name}.file`, fileText(file)));
  const { said, faults } = checkedTables(tables);
  const found = [...outside, ...faults, ...idle];
  if (found.length) throw new PlanError(new Source(source).sentences(found));
  return new Plan(said, source);
}

/** @param {string} name of a file beside a plan */
function fileText(name) {
  return _("this page does not read files that plans name, such as {name}: the command line does", {
    name,
  });
}
