// Curves and the route that joins them: twin of model/base_curve.py and model/curves.py.
//
// A curve is a part as kernels/route_parts.py has it: eight numbers, checked here.

import { _ } from "../words.js";
import { doubles, withArena } from "./arena.js";
import { CURVE, MODEL_BASE_CURVE, MODEL_CURVES, ROUTE_PARTS } from "./constants.js";
import { InputError, finite, positive } from "./errors.js";
import { general } from "./number_format.js";

/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {[number, number]} Point */
/** @typedef {number[]} Part */
/** @typedef {{ x: number, y: number, heading: number }} Pose */

const NOWHERE = { x: 0, y: 0, heading: 0 };

/** @param {number} angle degrees */
export function radians(angle) {
  return angle * (Math.PI / 180);
}

/** @param {number} angle rad */
export function degrees(angle) {
  return angle * (180 / Math.PI);
}

/** `value` if it may be a length or a radius, m. @param {string} name @param {number} value */
export function checkedSize(name, value) {
  if (positive(name, value, "m") > CURVE.MOST_METRES)
    throw new InputError(
      _("{name} must be at most {most} m, not {value} m", {
        name,
        most: general(CURVE.MOST_METRES),
        value: general(value),
      }),
    );
  return value;
}

/** `value` if it may be a pitch or a radius, m. @param {string} name @param {number} value */
function checkedBend(name, value) {
  if (positive(name, value, "m") < MODEL_BASE_CURVE.LEAST_METRES)
    throw new InputError(
      _("{name} must be at least {least} m, not {value} m", {
        name,
        least: general(MODEL_BASE_CURVE.LEAST_METRES),
        value: general(value),
      }),
    );
  return checkedSize(name, value);
}

/** Refuse a start or centre (m) and a heading (rad) that cannot be. @param {Point} point @param {number} heading */
function checkPose(point, heading) {
  for (const value of point)
    if (Math.abs(finite("start", value, "m")) > CURVE.MOST_METRES)
      throw new InputError(_("a start or centre must lie within 1e8 m of the origin"));
  finite("heading", heading, "rad");
}

/**
 * A curve of sizes as kernels/route_parts.py has them, in place, checked.
 * @param {number} kind
 * @param {number[]} sizes size, and where the kind has them first, last and hand
 * @param {Point} [start] of a spiral the centre, m
 * @param {number} [heading] of a spiral the polar axis, rad
 */
export function partOf(kind, [size, first = 0, last = 0, hand = 0], start = [0, 0], heading = 0) {
  return checkedPart([kind, ...start, heading, size, first, last, hand]);
}

/** The spiral from one radius, m, to another. @param {number} pitch m @param {number} from @param {number} to @param {boolean} mirrored */
export function spiralBetween(pitch, from, to, mirrored) {
  const k = checkedBend("pitch", pitch) / (2 * Math.PI);
  return partOf(CURVE.SPIRAL, [pitch, from / k, to / k, mirrored ? -1 : 1]);
}

/** The same part, if there are such curves: for all that are made or moved. @param {Part} part @returns {Part} */
export function checkedPart(part) {
  const [kind, x, y, heading, size, first, last] = part;
  checkPose([x, y], heading);
  switch (kind) {
    case CURVE.LINE:
      checkedSize("length", size);
      break;
    case CURVE.ARC:
      checkedBend("radius", size);
      if (finite("sweep", first, "rad") === 0)
        throw new InputError(_("the angle of an arc must not be 0"));
      checkedSize("length", size * Math.abs(first));
      break;
    case CURVE.SPIRAL:
      checkSpiral(checkedBend("pitch", size) / (2 * Math.PI), first, last);
      break;
    case CURVE.CLOTHOID:
      checkBent(_("a clothoid"), size, first, last);
      break;
    default:
      checkWinding(first, last);
      checkBent(_("a logarithmic spiral"), size, first, last);
  }
  return part;
}

/** @param {number} k radius gained per radian, m @param {number} first @param {number} last angles, rad */
function checkSpiral(k, first, last) {
  if (first === last) throw new InputError(_("a spiral must end at another angle than it starts at"));
  const outer = Math.max(finite("start_angle", first, "rad"), finite("end_angle", last, "rad"));
  checkedSize("radius", outer * k);
  // The arc to the centre is at least this, and hardly more where it matters.
  checkedSize("length", 0.5 * k * outer * outer);
}

/** @param {string} kind @param {number} length m @param {number} a curvature at the start, 1/m @param {number} b at the end */
function checkBent(kind, length, a, b) {
  checkedSize("length", length);
  const ends = [finite("start_curvature", a, "1/m"), finite("end_curvature", b, "1/m")];
  const turn = length * Math.max(...ends.map(Math.abs)); // or less
  if (turn > CURVE.MOST_TURN)
    throw new InputError(
      _("{kind} may sweep at most {most} rad, not {value} rad", {
        kind,
        most: general(CURVE.MOST_TURN),
        value: general(turn),
      }),
    );
}

/** @param {number} a curvature at the start, 1/m @param {number} b at the end */
function checkWinding(a, b) {
  const most = MODEL_CURVES.MOST_WINDING;
  if (b === 0 || !(1 / most <= a / b && a / b <= most))
    throw new InputError(
      _(
        "the curvatures of a logarithmic spiral must have the same sign and differ by a factor of at most {most}, not be {start} and {end} 1/m",
        { most: general(most), start: general(a), end: general(b) },
      ),
    );
}

/** The first parts of a table. @param {Numbers} table @param {number} count @returns {Part[]} */
export function partsOf(table, count) {
  const [view, columns] = [doubles(table), ROUTE_PARTS.PART_COLUMNS];
  return Array.from({ length: count }, (_part, i) =>
    Array.from(view.subarray(i * columns, (i + 1) * columns)),
  );
}

/**
 * The rows of a route of these parts; those from the one number to before the other are moved to where
 * the one before each ends, the first part to `start`. And the parts as they then lie.
 * @param {Arena} arena
 * @param {Part[]} parts
 * @param {[number, number]} [moved]
 * @param {Pose} [start]
 * @returns {{ rows: Numbers, parts: Part[] }}
 */
export function laidRows(arena, parts, moved = [0, 0], start = NOWHERE) {
  const { engine } = arena;
  const table = arena.table(parts, ROUTE_PARTS.PART_COLUMNS);
  try {
    const [count] = engine.call("bd_route_parts_row_count", table);
    const rows = arena.full([count, CURVE.COLUMNS], 0);
    engine.call("bd_route_parts_lay_rows", table, start, ...moved, rows);
    return { rows, parts: partsOf(table, parts.length) };
  } finally {
    arena.drop(table);
  }
}

/**
 * These parts, those from number `first` to before `stop` moved to where the one before ends.
 * @param {Engine} engine
 * @param {Part[]} parts
 * @param {number} first
 * @param {number} stop
 * @param {Pose} [start] where part 0 is moved to, if it is
 */
export function joinedParts(engine, parts, first, stop, start) {
  return withArena(engine, (arena) => {
    const laid = laidRows(arena, parts, [first, stop], start).parts;
    return parts.map((part, i) => (first <= i && i < stop ? checkedPart(laid[i]) : part));
  });
}

/** The pose at which a part starts. @param {Engine} engine @param {Part} part @returns {Pose} */
export function startPose(engine, part) {
  return withArena(engine, (arena) => {
    const { rows } = laidRows(arena, [part]);
    const [x, y, heading] = engine.call("bd_route_parts_start_pose", rows, 0);
    return { x, y, heading };
  });
}

/** Curves joined end to end in walking order. */
export class Route {
  /**
   * @param {Arena} arena which holds `rows`
   * @param {Part[]} parts at least one; each starts where the one before it ends
   */
  constructor(arena, parts) {
    if (!parts.length) throw new InputError(_("a route needs at least one curve"));
    this.engine = arena.engine;
    this.parts = parts;
    /** The curve as kernels see it, (pieces, COLUMNS). */
    this.rows = laidRows(arena, parts).rows;
    const view = doubles(this.rows);
    const last = view.length - CURVE.COLUMNS;
    /** Exact length from start to end, m. */
    this.length = view[last + CURVE.S_START] + view[last + CURVE.LENGTH];
    /** How far it runs on behind its start, m: 0 or infinite. */
    this.extension = Number.isFinite(view[CURVE.U_BACK]) ? 0 : Infinity;
    /** Whether that is on a straight line. */
    this.straight = view[CURVE.U_BACK] === -Infinity;
    /** Route positions of the curves' ends, m, from 0 to the length. */
    this.joints = this.#joints(view);
    this.#checkJoints();
  }

  /** The route of these parts, each moved to where the one before it ends. @param {Arena} arena @param {Part[]} parts */
  static joined(arena, parts) {
    if (!parts.length) throw new InputError(_("a route needs at least one curve"));
    return new Route(arena, joinedParts(arena.engine, parts, 1, parts.length));
  }

  /** The same in another arena. @param {Arena} arena */
  in(arena) {
    return new Route(arena, this.parts);
  }

  /**
   * The same turned about the origin by an angle, rad, and then moved, m.
   * @param {Arena} arena
   * @param {number} turned
   * @param {Point} by
   */
  moved(arena, turned, by) {
    checkPose(by, turned);
    const table = arena.table(this.parts, ROUTE_PARTS.PART_COLUMNS);
    arena.engine.call("bd_route_parts_move_parts", table, turned, ...by);
    const parts = partsOf(table, this.parts.length).map(checkedPart);
    arena.drop(table);
    return new Route(arena, parts);
  }

  /**
   * The same, the numbers that kernels see counted from an origin, m, near the dance.
   * @param {Arena} arena
   * @param {Point} origin
   */
  seenFrom(arena, origin) {
    const rows = arena.array("d", ...this.rows.shape);
    doubles(rows).set(doubles(this.rows));
    arena.engine.call("bd_route_parts_settle_rows", rows, ...origin);
    /** @type {Route} */
    const near = Object.create(this);
    near.rows = rows;
    return near;
  }

  /** Centre of the first spiral, else the origin, m. @returns {Point} */
  get centre() {
    const spiral = this.parts.find(([kind]) => kind === CURVE.SPIRAL);
    return spiral ? [spiral[ROUTE_PARTS.PART_X], spiral[ROUTE_PARTS.PART_Y]] : [0, 0];
  }

  /**
   * x, y (m), heading (rad) and curvature (1/m) at route positions, m: four numbers each, row by row.
   * @param {ArrayLike<number>} positions
   */
  evaluate(positions) {
    return withArena(this.engine, (arena) => {
      const out = arena.array("d", positions.length, 4);
      this.engine.call("bd_route_evaluate", this.rows, arena.vector(positions), out);
      const found = doubles(out).slice();
      const off = found.findIndex((value, i) => i % 4 === 0 && Number.isNaN(value));
      if (off >= 0)
        throw new InputError(
          _("s must lie between {low} and {high} m, not at {value} m", {
            low: general(0 - this.extension),
            high: general(this.length, 12),
            value: general(positions[off / 4], 12),
          }),
        );
      return found;
    });
  }

  /** Point of a route position, m. @param {number} s @returns {Point} */
  point(s) {
    const [x, y] = this.evaluate([s]);
    return [x, y];
  }

  /** @param {Float64Array} view of its rows */
  #joints(view) {
    const found = [];
    for (let row = 0, part = -1; row < view.length; row += CURVE.COLUMNS) {
      if (view[row + CURVE.PART] !== part) found.push(view[row + CURVE.S_START]);
      part = view[row + CURVE.PART];
    }
    return Float64Array.of(...found, this.length);
  }

  #checkJoints() {
    const off = withArena(this.engine, (arena) => {
      const out = arena.full([this.parts.length - 1, 2], 0);
      this.engine.call("bd_route_parts_misfits", this.rows, out);
      return doubles(out).slice();
    });
    for (let i = 0; i < off.length; i += 2) {
      const numbers = { first: i / 2 + 1, second: i / 2 + 2 };
      if (off[i] > MODEL_CURVES.JOINT_GAP)
        throw new InputError(
          _("curves {first} and {second} do not meet: they are {gap} m apart", {
            ...numbers,
            gap: general(off[i]),
          }),
        );
      if (off[i + 1] > MODEL_CURVES.JOINT_KINK)
        throw new InputError(
          _(
            "curves {first} and {second} meet at a kink of {kink} degrees; allow kinks or rotate one of them",
            { ...numbers, kink: general(degrees(off[i + 1])) },
          ),
        );
    }
  }
}
