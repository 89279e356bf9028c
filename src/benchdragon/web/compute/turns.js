// Turns from an inward spiral to its half-turned outward twin: twin of model/turns.py and TurnTable.

import { _ } from "../words.js";
import { doubles, withArena } from "./arena.js";
import { CURVE, PLANS_TABLES, ROUTE_PARTS, TURN_FAMILIES, TurnStatus } from "./constants.js";
import { Route, checkedPart, joinedParts, laidRows, partsOf } from "./curves.js";
import { InputError, finite, positive } from "./errors.js";
import { general, pythonFloat } from "./number_format.js";

/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./curves.js").Part} Part */
/** A piece of a turn: its length, m, and its curvature at both ends, 1/m, left positive. */
/** @typedef {[number, number, number]} Piece */
/** @typedef {{ pitch: number, entry: number, exit: number }} Joints radii of the joints, m */

/** A turn made of lines, arcs and clothoids between the spirals. */
export class Turn {
  /** @param {Engine} engine @param {Joints} joints @param {Piece[]} pieces in walking order */
  constructor(engine, joints, pieces) {
    this.engine = engine;
    this.joints = joints;
    this.pieces = pieces;
    positive("pitch", joints.pitch, "m");
    positive("entry_radius", joints.entry, "m");
    positive("exit_radius", joints.exit, "m");
    this.#parts(joints.pitch, joints.pitch).slice(1, -1).forEach(checkedPart);
  }

  /** Parts of the route: the first spiral is `lead` metres long, the last one `trail`. @param {number} lead @param {number} trail */
  #parts(lead, trail) {
    return withArena(this.engine, (arena) => {
      const count = this.pieces.length + 2;
      const parts = arena.array("d", count, ROUTE_PARTS.PART_COLUMNS);
      const { pitch, entry, exit } = this.joints;
      const pieces = arena.table(this.pieces, 3);
      this.engine.call("bd_turn_families_turn_parts", pitch, entry, exit, lead, trail, pieces, parts);
      return partsOf(parts, count);
    });
  }

  /** Length of the turn itself, m. */
  get length() {
    return this.pieces.reduce((sum, [length]) => sum + length, 0);
  }

  /** The radius of its tightest bend, m. */
  get leastRadius() {
    return 1 / Math.max(...this.pieces.map(([, a, b]) => Math.max(Math.abs(a), Math.abs(b))));
  }

  /** The rows of `route` alone, for searches that try many turns. @param {Arena} arena @param {number} lead @param {number} trail m */
  rows(arena, lead, trail) {
    const parts = this.#parts(lead, trail);
    return laidRows(arena, parts, [1, parts.length - 1]).rows;
  }

  /** The whole way inside a disc of this radius, m: the spirals inside it, and the turn. @param {number} radius m */
  way(radius) {
    const { pitch, entry, exit } = this.joints;
    const k = pitch / (2 * Math.PI);
    const along = (/** @type {number} */ r) => this.engine.call("bd_curve_spiral_length", k, r / k)[0];
    const spirals = [entry, exit].map((joint) =>
      radius - joint > TURN_FAMILIES.NOTHING ? along(radius) - along(joint) : 0,
    );
    return spirals[0] + spirals[1] + this.length;
  }

  /** How far its curves reach from the centre of the spirals, m. */
  get extent() {
    const { pitch } = this.joints;
    return withArena(this.engine, (arena) => reachOf(arena, this.rows(arena, pitch, pitch)));
  }

  /** In along the spiral for `lead` metres, the turn, and out for `trail` metres. @param {Arena} arena @param {number} trail @param {number} [lead] */
  route(arena, trail, lead = TURN_FAMILIES.LEAD) {
    const parts = this.#parts(positive("lead", lead, "m"), positive("trail", trail, "m"));
    const checked = parts.map(checkedPart);
    return new Route(arena, joinedParts(this.engine, checked, 1, parts.length - 1));
  }
}

/** How far a turn reaches from the centre, m, by the rows of its route. @param {Arena} arena @param {Numbers} rows */
function reachOf({ engine }, rows) {
  const [count, columns] = rows.shape;
  const start = (/** @type {number} */ row) => doubles(rows)[row * columns + CURVE.S_START];
  const [first, last] = [start(1), start(count - 1)];
  return engine.call("bd_route_parts_farthest", rows, first, last, TURN_FAMILIES.LOOK)[0];
}

/** Why there is no turn. @param {number} status @param {Record<string, string>} values */
function turnReason(status, values) {
  switch (status) {
    case TurnStatus.TOO_NEAR:
      return _(
        "the turn must begin and end farther out than {least} m at this pitch, not at {value} m",
        values,
      );
    case TurnStatus.NO_ARCS:
      return _("no two arcs of this ratio join the spirals there");
    case TurnStatus.NO_LINE:
      return _(
        "radii of {a} m and {b} m leave no line between the arcs: smaller ones are needed",
        values,
      );
    case TurnStatus.NO_CIRCLE:
      return _("no circle of the middle curvature is tangent to both arcs");
    case TurnStatus.NOT_EASED:
      return _("no turn eased like this joins the spirals there");
    default:
      return _("clothoids of {ease} m leave no room for the arcs", values);
  }
}

/**
 * The turn that a kernel makes, or the reason why it cannot.
 * @param {Engine} engine
 * @param {string} entry of the kernels
 * @param {Joints} joints
 * @param {number[]} numbers of the family; ease, m, the last
 * @param {[number, number]} [radii]
 */
function madeTurn(engine, entry, joints, numbers, radii = [NaN, NaN]) {
  const ease = numbers[numbers.length - 1];
  positive("pitch", joints.pitch, "m");
  positive("entry_radius", joints.entry, "m");
  positive("entry_radius", joints.exit, "m");
  const { pitch, entry: first, exit: last } = joints;
  return withArena(engine, (arena) => {
    const arcs = arena.array("d", TURN_FAMILIES.ARCS, 2);
    const table = arena.array("d", TURN_FAMILIES.MOST_PIECES, 3);
    const [count, status] = engine.call(entry, pitch, first, last, ...numbers, arcs, table);
    if (status !== TurnStatus.OK)
      throw new InputError(
        turnReason(status, {
          least: general((TURN_FAMILIES.LEAST_THETA * pitch) / (2 * Math.PI), 3),
          value: general(Math.min(first, last)),
          a: general(radii[0]),
          b: general(radii[1]),
          ease: pythonFloat(ease),
        }),
      );
    const view = doubles(table);
    const pieces = Array.from(
      { length: count },
      (_piece, i) => /** @type {Piece} */ (Array.from(view.subarray(3 * i, 3 * i + 3))),
    );
    return new Turn(engine, joints, pieces);
  });
}

/** The turn of two arcs with radii r1 : r2 = ratio. @param {Engine} engine @param {Joints} joints @param {number} ratio @param {number} [ease] m */
export function twoArcs(engine, joints, ratio, ease = 0) {
  positive("ratio", ratio);
  return madeTurn(engine, "bd_turn_families_two_arcs", joints, [ratio, ease]);
}

/**
 * The turn of an arc, a line or a second arc, and a third arc.
 * @param {Engine} engine
 * @param {Joints} joints
 * @param {[number, number]} radii of the first arc (to the right) and of the last (to the left), m
 * @param {number} bend curvature of what lies between, 1/m, left positive; 0 is a line
 * @param {number} ease length of clothoids before, between and after these, m
 */
export function threePieces(engine, joints, radii, bend, ease) {
  const [first, last] = radii.map((radius) => positive("radii", radius, "m"));
  const numbers = [first, finite("bend", bend, "1/m"), last, ease];
  return madeTurn(engine, "bd_turn_families_three_pieces", joints, numbers, [first, last]);
}

/**
 * The turn between spirals of this pitch, m, in a disc of this radius, m: `TurnTable.build`.
 * @param {Engine} engine
 * @param {Record<string, any>} table
 * @param {number} pitch
 * @param {number} disc
 */
export function builtTurn(engine, table, pitch, disc) {
  const entry = table.entry_radius ?? disc;
  const joints = { pitch, entry, exit: table.exit_radius ?? entry };
  if (table.family === "arc-arc") return twoArcs(engine, joints, table.ratio, table.ease);
  let { radii } = table;
  if (radii === null) {
    const least = Math.min(twoArcs(engine, joints, 1).leastRadius, 0.5 * disc);
    radii = [PLANS_TABLES.ROOMY * least, PLANS_TABLES.ROOMY * least];
  }
  const bend = table.family === "arc-arc-arc" ? table.curvature : 0;
  return threePieces(engine, joints, radii, bend, table.ease);
}
