// Formations and programmes of them as parts of a route: what the models say of their sizes
// (plan_keys.js), what the kernels make of them, and whether a dragon fits on it.

import { _ } from "../words.js";
import { withArena } from "./arena.js";
import { CONNECTIONS, FORMATIONS as ROOM, ROUTE, ROUTE_PARTS, Status } from "./constants.js";
import { checkedPart, laidRows, partsOf } from "./curves.js";
import { InputError, keyed } from "./errors.js";
import { general } from "./number_format.js";
import { FORMATIONS } from "./plan_keys.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./curves.js").Part} Part */
/** @typedef {import("./curves.js").Route} Route */
/** @typedef {import("./dragon.js").Dragon} Dragon */
/** A formation of a programme: its parts, and where it is danced, m and rad. */
/** @typedef {{ parts: Part[], at: [number, number] | null, turned: number }} Step */

/**
 * What the kernels and checks of sizes want to know: see model/formations.py.
 * @typedef {object} Formation
 * @property {number} kind
 * @property {boolean | null} clockwise by default
 * @property {Record<string, { default: number, least: number, most: number, unit: string }>} sizes
 * @property {Array<[string, number, string, string]>} smaller
 * @property {string[]} tightest
 */

/** The sizes of a formation, m, checked. @param {Record<string, any>} table @param {string} key */
function checkedSizes(table, key) {
  const formation = table.name;
  const { sizes, smaller } = FORMATIONS[formation];
  /** @type {Record<string, number>} */
  const own = {};
  for (const [name, size] of Object.entries(sizes)) {
    const { least, most, unit } = size;
    own[name] = table[name] ?? size.default;
    if (!(least <= own[name] && own[name] <= most))
      throw keyed(
        `${key}.${name}`,
        _("{name} of {formation} must lie in {least} .. {most}, not at {value}", {
          name,
          formation,
          value: `${general(own[name])} ${unit}`.trim(),
          least: general(least),
          most: `${general(most)} ${unit}`.trim(),
        }),
      );
  }
  for (const [name, factor, other, than] of smaller) {
    const most = factor * own[other];
    if (own[name] < most) continue;
    throw keyed(
      `${key}.${name}`,
      _("{name} of {formation} ({value} m) must be smaller than {than} ({most} m)", {
        ...{ name, formation, than },
        value: general(own[name]),
        most: general(most),
      }),
    );
  }
  return own;
}

/**
 * The parts of a formation under a dotted key of a plan whose longest link is `link`, m.
 * @param {Engine} engine
 * @param {Record<string, any>} table name and sizes; those that are null are as the formation has them
 * @param {string} key
 * @param {number} link
 * @returns {Part[]}
 */
export function builtFormation(engine, table, key, link) {
  const { kind, clockwise, tightest } = FORMATIONS[table.name];
  const sizes = checkedSizes(table, key);
  return withArena(engine, (arena) => {
    const given = arena.vector(Object.values(sizes));
    const out = arena.array("d", ROOM.MOST_PARTS, ROUTE_PARTS.PART_COLUMNS);
    const hand = table.clockwise ?? clockwise ?? false;
    const [count] = engine.call("bd_formations_formation_parts", kind, given, hand, out);
    const parts = partsOf(out, count);
    const [bend] = engine.call("bd_route_parts_tightest_bend", laidRows(arena, parts).rows);
    const least = Math.min(...tightest.map((name) => sizes[name]));
    if (tightest.length)
      refuseTight(`${key}.${tightest.find((name) => sizes[name] === least)}`, 1 / bend, link);
    return parts;
  });
}

/** Refuse bends of a radius, m, that a bench with a link, m, cannot follow; the key widens them. @param {string} key @param {number} radius @param {number} link */
export function refuseTight(key, radius, link) {
  if (2 * radius > link) return;
  const text = _(
    "{key}: a bench with {link} m between its handles cannot follow a bend of {radius} m radius: it must be wider than {least} m, so make {key} larger",
    { key, link: general(link), radius: general(radius, 4), least: general(0.5 * link) },
  );
  throw keyed(key, text);
}

/** Refuse a formation that is turned without being put anywhere. @param {Record<string, any>} step */
export function checkStep({ at, turned }) {
  if (at === null && turned !== 0)
    throw new InputError(
      _("turned has no effect without at: this formation begins as the one before it ends"),
    );
}

/** The parts of formations one after another, and of connections of a radius, m, between them. @param {Engine} engine @param {Step[]} steps @param {number} radius */
export function programme(engine, steps, radius) {
  const columns = ROUTE_PARTS.PART_COLUMNS;
  return withArena(engine, (arena) => {
    const given = arena.table(steps.flatMap(({ parts }) => parts), columns); // prettier-ignore
    const placed = steps.map(({ parts, at, turned }, n) => {
      return [parts.length, ...(at ?? [n ? NaN : 0, 0]), turned];
    });
    const table = arena.table(placed, CONNECTIONS.STEP_COLUMNS);
    const out = arena.array("d", given.shape[0] + CONNECTIONS.PIECES * steps.length, columns);
    const [count] = engine.call("bd_connections_programme", given, table, radius, out);
    return partsOf(out, count).map(checkedPart);
  });
}

/** The head's route position, m, with the tail's rear handle where the route starts. @param {Route} route @param {Dragon} dragon */
export function wholeDragonOn(route, dragon) {
  const [head, tail, status] = withArena(route.engine, (arena) => {
    const places = arena.placements(dragon.benches + 1, 1);
    const at = arena.array("d", 1);
    return route.engine.call(
      "bd_low_points_whole_dragon", route.rows, dragon.links, at, places,
    ); // prettier-ignore
  });
  if (status === Status.ROUTE_TOO_SHORT || tail < -ROUTE.END_SLACK)
    throw keyed(
      "route",
      _(
        "the dragon, {dragon} m long, does not fit on a route of {route} m, at whose start its tail stands at time 0: make the sizes larger, take fewer benches, or set walk.position",
        { dragon: general(dragon.extent), route: general(route.length) },
      ),
    );
  return head;
}
