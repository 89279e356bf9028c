// Formations as routes of given sizes: twin of model/formations.py and plans/formations.py.

import { _ } from "../words.js";
import { withArena } from "./arena.js";
import { ROUTE, Status } from "./constants.js";
import {
  Route,
  arcPart,
  checkedPart,
  endPose,
  joinedParts,
  linePart,
  radians,
  spiralBetween,
} from "./curves.js";
import { InputError, finite, keyed } from "./errors.js";
import { general } from "./number_format.js";
import { Placement } from "./walk.js";

/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./curves.js").Part} Part */
/** @typedef {import("./dragon.js").Dragon} Dragon */
/** @typedef {Record<string, any>} Sizes */
/** @typedef {{ least: number, most: number, unit: string }} Limits */

/**
 * @typedef {object} FormationKind
 * @property {Sizes} defaults each size and `clockwise`, as they are if nothing is said
 * @property {Record<string, Limits>} sizes
 * @property {string[]} tightest the sizes of which the smallest makes its tightest bend
 * @property {Array<(sizes: Sizes) => [string, number, string]>} smaller sizes that must be smaller than others
 * @property {(engine: Engine, sizes: Sizes) => Part[]} build
 */

/** A size of a formation that cannot be. */
class FormationSizeError extends InputError {
  /** @param {string} size its name @param {string} text */
  constructor(size, text) {
    super(text);
    this.size = size;
  }
}

/** @param {number} least @param {number} most @param {string} [unit] */
const between = (least, most, unit = "m") => ({ least, most, unit });
const COIL_SIZES = {
  pitch: between(0.1, 100),
  outer_radius: between(1, 1000),
  inner_radius: between(0.5, 1000),
};
const ROUNDS_SIZE = between(1, 20, "");
/** @type {FormationKind["smaller"]} */
const COILED = [
  ({ outer_radius }) => ["inner_radius", outer_radius, "outer_radius"],
  ({ outer_radius }) => ["pitch", outer_radius, "outer_radius"],
];

/** @type {Record<string, FormationKind>} */
const FORMATION_KINDS = {
  "coil-in": {
    defaults: { pitch: 0.8, outer_radius: 12, inner_radius: 3, clockwise: true },
    sizes: COIL_SIZES,
    tightest: ["inner_radius"],
    smaller: COILED,
    build: (_engine, { pitch, outer_radius, inner_radius, clockwise }) => [
      coilPart(pitch, outer_radius, inner_radius, clockwise),
    ],
  },
  "coil-out": {
    defaults: { pitch: 0.8, inner_radius: 3, outer_radius: 12, clockwise: true },
    sizes: COIL_SIZES,
    tightest: ["inner_radius"],
    smaller: COILED,
    build: (_engine, { pitch, outer_radius, inner_radius, clockwise }) => [
      coilPart(pitch, inner_radius, outer_radius, clockwise),
    ],
  },
  "double-door": {
    defaults: { pitch: 0.8, outer_radius: 9, inner_radius: 2.5, between: 2, clockwise: true },
    sizes: { ...COIL_SIZES, between: between(0, 1000) },
    tightest: ["inner_radius"],
    smaller: COILED,
    build: doubleDoor,
  },
  "figure-eight": {
    defaults: { radius: 40, rounds: 1, clockwise: true },
    sizes: { radius: between(0.5, 1000), rounds: ROUNDS_SIZE },
    tightest: ["radius"],
    smaller: [],
    build: figureEight,
  },
  "three-plum-blossoms": {
    defaults: { radius: 18, waist: 6, rounds: 1, clockwise: true },
    sizes: { radius: between(0.5, 1000), waist: between(0.5, 1000), rounds: ROUNDS_SIZE },
    tightest: ["waist", "radius"],
    // Petals whose centres lie 3 ** 0.5 * (radius + waist) apart must not meet.
    smaller: [({ waist }) => ["radius", (waist * Math.sqrt(3)) / (2 - Math.sqrt(3)), "6.46 * waist"]],
    build: threePlumBlossoms,
  },
  "straight-dragon": {
    defaults: { length: 300 },
    sizes: { length: between(1, 10_000) },
    tightest: [],
    smaller: [],
    build: (_engine, { length }) => [linePart(length, [-0.5 * length, 0])],
  },
  "tail-swing": {
    defaults: { swing: 4.5, radius: 5, swings: 6, run: 260, clockwise: true },
    sizes: {
      swing: between(0.1, 1000),
      radius: between(0.5, 1000),
      swings: between(1, 100, ""),
      run: between(0, 10_000),
    },
    tightest: ["radius"],
    smaller: [({ radius }) => ["swing", 2 * radius, "2 * radius"]],
    build: tailSwing,
  },
};

/** A coil about the origin whose outer end lies on the axis of x. @param {number} pitch @param {number} startRadius @param {number} endRadius @param {boolean} clockwise */
function coilPart(pitch, startRadius, endRadius, clockwise) {
  const mirrored = endRadius < startRadius !== clockwise;
  const winding = (Math.max(startRadius, endRadius) * 2 * Math.PI) / pitch;
  return spiralBetween(pitch, startRadius, endRadius, {
    rotation: 0 + (mirrored ? winding : -winding),
    mirrored,
  });
}

/** All of them, each moved to where the one before it ends. @param {Engine} engine @param {Part[]} parts */
function joined(engine, parts) {
  return joinedParts(engine, parts, 1, parts.length);
}

/** @param {Engine} engine @param {Part} part @param {[number, number]} start @param {number} heading */
export function movedPart(engine, part, [x, y], heading) {
  return joinedParts(engine, [part], 0, 1, { x, y, heading })[0];
}

/** @param {Engine} engine @param {Sizes} sizes */
function doubleDoor(engine, { pitch, outer_radius, inner_radius, between: apart, clockwise }) {
  const out = coilPart(pitch, inner_radius, outer_radius, clockwise);
  const into = coilPart(pitch, outer_radius, inner_radius, clockwise);
  // Turned about its centre so that it leaves along the axis of x, then moved to the left.
  const half = outer_radius + 0.5 * apart;
  const leaving = turnedParts([out], -endPose(engine, out).heading, [-half, 0]);
  const { x } = endPose(engine, leaving[0]);
  return joined(engine, [...leaving, linePart(-2 * x), into]);
}

/** Parts turned about the origin by an angle, rad, and then moved, m. @param {Part[]} parts @param {number} turned @param {[number, number]} by */
export function turnedParts(parts, turned, by) {
  const [c, s] = [Math.cos(turned), Math.sin(turned)];
  return parts.map(([kind, x, y, angle, ...sizes]) =>
    checkedPart([kind, c * x - s * y + by[0], s * x + c * y + by[1], angle + turned, ...sizes]),
  );
}

/** @param {Engine} engine @param {Sizes} sizes */
function figureEight(engine, { radius, rounds, clockwise }) {
  const side = clockwise ? -1 : 1;
  const tip = (1 + Math.sqrt(2)) * radius;
  const [half, whole] = [0.75 * Math.PI * side, -1.5 * Math.PI * side];
  const first = arcPart(radius, half, [tip, 0], 0.5 * Math.PI * side);
  const turn = [linePart(2 * radius), arcPart(radius, whole), linePart(2 * radius)];
  const round = [...turn, arcPart(radius, -whole)];
  const rest = Array.from({ length: rounds - 1 }, () => round).flat();
  return joined(engine, [first, ...rest, ...turn, arcPart(radius, half)]);
}

/** @param {Engine} engine @param {Sizes} sizes */
function threePlumBlossoms(engine, { radius, waist, rounds, clockwise }) {
  const side = clockwise ? -1 : 1;
  const petal = arcPart(radius, radians(240) * side);
  const bend = arcPart(waist, -radians(120) * side);
  const half = arcPart(radius, radians(120) * side);
  const first = movedPart(engine, half, [2 * radius + waist, 0], 0.5 * Math.PI * side);
  const inner = Array.from({ length: 3 * rounds - 1 }, () => [petal, bend]).flat();
  return joined(engine, [first, bend, ...inner, half]);
}

/** @param {Engine} engine @param {Sizes} sizes */
function tailSwing(engine, { swing, radius, swings, run, clockwise }) {
  const side = clockwise ? -1 : 1;
  const angle = Math.acos(1 - (0.5 * swing) / radius);
  /** @type {[number, number]} */
  const start = [-swings * radius * Math.sin(angle) - run, -0.5 * side * swing];
  const bends = Array.from({ length: swings + 1 }, (_bend, n) => {
    const half = n === 0 || n === swings ? 1 : 2;
    return arcPart(radius, half * angle * (n % 2 ? -side : side));
  });
  const lines = run > 0 ? [linePart(run)] : [];
  const [first, ...rest] = joined(engine, [...lines, ...bends, ...lines]);
  return joined(engine, [movedPart(engine, first, start, 0), ...rest]);
}

/**
 * The sizes of a formation, those that are not said as it has them, checked.
 * @param {Record<string, any>} table name and sizes; null counts as not said
 * @returns {Sizes}
 */
function formationSizes(table) {
  const formation = table.name;
  const { defaults, sizes, smaller } = FORMATION_KINDS[formation];
  const own = Object.fromEntries(
    Object.entries(defaults).map(([name, value]) => [name, table[name] ?? value]),
  );
  for (const [name, { least, most, unit }] of Object.entries(sizes)) {
    const value = finite(name, own[name], unit);
    const shown = { name, formation, value: `${general(value)} ${unit}`.trim() };
    if (!(least <= value && value <= most))
      throw new FormationSizeError(
        name,
        _("{name} of {formation} must lie in {least} .. {most}, not at {value}", {
          ...shown,
          least: general(least),
          most: `${general(most)} ${unit}`.trim(),
        }),
      );
  }
  for (const must of smaller) {
    const [name, most, than] = must(own);
    if (own[name] >= most)
      throw new FormationSizeError(
        name,
        _("{name} of {formation} ({value} m) must be smaller than {than} ({most} m)", {
          name,
          formation,
          value: general(own[name]),
          than,
          most: general(most),
        }),
      );
  }
  return own;
}

/**
 * The parts of a formation under a dotted key of a plan whose longest link is `link`, m.
 * @param {Engine} engine
 * @param {Record<string, any>} table
 * @param {string} key
 * @param {number} link
 */
export function builtFormation(engine, table, key, link) {
  const kind = FORMATION_KINDS[table.name];
  /** @type {Sizes} */
  let sizes;
  try {
    sizes = formationSizes(table);
  } catch (error) {
    if (error instanceof FormationSizeError) throw keyed(`${key}.${error.size}`, error.message);
    throw error;
  }
  const parts = kind.build(engine, sizes);
  if (kind.tightest.length) {
    const least = Math.min(...kind.tightest.map((name) => sizes[name]));
    const narrowest = kind.tightest.find((name) => sizes[name] === least);
    refuseTight(`${key}.${narrowest}`, leastRadius(engine, parts), link);
  }
  return parts;
}

/** The radius of the tightest bend of parts, m: of lines, arcs and Archimedean spirals. @param {Engine} engine @param {Part[]} parts */
function leastRadius(engine, parts) {
  const bend = withArena(engine, (arena) =>
    Math.max(
      ...parts.map((part) => {
        const route = new Route(arena, [part]);
        const found = route.evaluate([0, route.length]);
        return Math.max(Math.abs(found[3]), Math.abs(found[7]));
      }),
    ),
  );
  return bend > 0 ? 1 / bend : Infinity;
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

/**
 * The head's route position, m, with the tail's rear handle where the route starts.
 * @param {Route} route
 * @param {Dragon} dragon
 */
export function wholeDragonOn(route, dragon) {
  return withArena(route.engine, (arena) => {
    const places = arena.placements(dragon.benches + 1, 1);
    const at = arena.array("d", 1);
    const [head] = route.engine.call(
      "bd_low_points_head_where_tail", route.rows, dragon.links, 0, at, places,
    ); // prettier-ignore
    const placed = new Placement(arena, dragon, route, [head]);
    const tail = /** @type {number} */ (placed.s.view[dragon.benches]);
    if (placed.status[0] === Status.ROUTE_TOO_SHORT || tail < -ROUTE.END_SLACK)
      throw keyed(
        "route",
        _(
          "the dragon, {dragon} m long, does not fit on a route of {route} m, at whose start its tail stands at time 0: make the sizes larger, take fewer benches, or set walk.position",
          { dragon: general(dragon.extent), route: general(route.length) },
        ),
      );
    return head;
  });
}
