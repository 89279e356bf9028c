// What stands on the square: twin of model/obstacle.py and plans/square.py.

import { _ } from "../words.js";
import { doubles, wholes } from "./arena.js";
import { checkedSize } from "../made/base_curve.js";
import { radians } from "./curve.js";
import { BOX, CURVE, MODEL_OBSTACLE, OBSTACLE } from "./constants.js";
import { Fault, Faults, InputError, KeyedError, finite, notNegative } from "./errors.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {[number, number]} Point */
/** @typedef {"circle" | "rectangle" | "polygon" | "line" | "venue"} ObstacleKind */

/** Something that stands still, and that no bench may touch; or the edge of the venue. */
export class Obstacle {
  /**
   * @param {string} name what people call it
   * @param {ObstacleKind} kind
   * @param {Point[]} outline its corners in order, m; of a circle the centre
   * @param {number} radius of a circle, m; else 0
   * @param {number} margin the distance that benches must keep, m
   */
  constructor(name, kind, outline, radius, margin) {
    this.name = name;
    this.kind = kind;
    this.outline = outline;
    this.radius = radius;
    this.margin = notNegative("margin", margin, "m");
  }

  /** What its kind is to the kernels. */
  get sort() {
    const { CIRCLE, BODY, LINE, VENUE } = OBSTACLE;
    return { circle: CIRCLE, rectangle: BODY, polygon: BODY, line: LINE, venue: VENUE }[this.kind];
  }

  /** Its corners, counted from an origin, m, (P, 2). @param {Arena} arena @param {Point} [origin] */
  corners(arena, [fromX, fromY] = [0, 0]) {
    return arena.table(
      this.outline.map(([x, y]) => [x - fromX, y - fromY]),
      2,
    );
  }

  /** Its sides, or its centre, as boxes without width: (sides, BOX_COLUMNS) of kernels/box.py. @param {Arena} arena */
  boxes(arena) {
    const count = this.outline.length - (this.kind === "line" ? 1 : 0);
    const made = arena.array("d", count, BOX.BOX_COLUMNS);
    arena.engine.call("bd_obstacle_fill_boxes", this.sort, this.corners(arena), made);
    return made;
  }

  /** Which of points, m, the first two columns, lie where none may: inside it, or outside the venue. @param {Arena} arena @param {Numbers} points */
  forbids(arena, points) {
    const out = arena.array("q", points.shape[0]);
    const corners = this.corners(arena);
    arena.engine.call("bd_obstacle_forbidden", this.sort, corners, this.radius, points, out);
    return wholes(out).map((flag) => flag === 1);
  }

  /**
   * How far each box of benches is from the nearest of its own, m; which box. A radius lies within, and
   * whether a bench stands where none may is not asked.
   * @param {Arena} arena
   * @param {Numbers} table boxes of benches, (N, BOX_COLUMNS) of kernels/box.py
   */
  nearest(arena, table) {
    const [count] = table.shape;
    const [out, which] = [arena.array("d", count), arena.array("q", count)];
    const [boxes, near] = [this.boxes(arena), arena.array("d", 2, BOX.BOX_COLUMNS)];
    arena.engine.call("bd_standing_distances_to", table, boxes, near, out, which);
    return { apart: doubles(out).slice(), which: wholes(which), boxes };
  }

  /** The same turned about the origin by an angle, rad, and then moved, m. @param {number} turned @param {Point} by */
  moved(turned, by) {
    const [c, s] = [Math.cos(turned), Math.sin(turned)];
    const outline = this.outline.map(
      ([x, y]) => /** @type {Point} */ ([x * c - y * s + by[0], x * s + y * c + by[1]]),
    );
    return new Obstacle(this.name, this.kind, outline, this.radius, this.margin);
  }
}

/**
 * The corners of a rectangle in going round, m.
 * @param {string} name
 * @param {Point} centre
 * @param {Point} size along its own axes, m
 * @param {number} angle rad
 */
function rectangleOutline(name, centre, size, angle) {
  const [[x, y]] = checkedPoints(name, [centre], 1);
  const [a, b] = checkedPoints(`${name}: size`, [size], 1)[0].map(
    (side) => 0.5 * checkedSize(`${name}: size`, side),
  );
  const turned = finite(`${name}: angle`, angle);
  const [c, s] = [Math.cos(turned), Math.sin(turned)];
  /** @type {Point[]} */
  const corners = [[a, b], [-a, b], [-a, -b], [a, -b]]; // prettier-ignore
  const ends = corners.map(([u, v]) => /** @type {Point} */ ([x + u * c - v * s, y + u * s + v * c]));
  return checkedPoints(name, ends, 4, true);
}

/**
 * The corners of a polygon, m; a last one that repeats the first is left out.
 * @param {string} name
 * @param {Point[]} points
 */
function closedOutline(name, points) {
  const corners = checkedPoints(name, points, 3, true);
  const crossing = crossingSides(corners);
  if (crossing)
    throw new InputError(
      _("{name}: its sides {i} and {j} cross or touch: an outline must not meet itself", {
        name,
        i: crossing[0] + 1,
        j: crossing[1] + 1,
      }),
    );
  const twice = corners.reduce((sum, [x, y], i) => {
    const [nextX, nextY] = corners[(i + 1) % corners.length];
    return sum + x * (nextY - y) - y * (nextX - x);
  }, 0);
  if (0.5 * Math.abs(twice) < MODEL_OBSTACLE.LEAST_SIDE ** 2)
    throw new InputError(_("{name}: it has no area", { name }));
  return corners;
}

/**
 * Points, of which none is repeated, but for a closed outline's last.
 * @param {string} name
 * @param {Point[]} points
 * @param {number} least how many
 * @param {boolean} [closed]
 */
function checkedPoints(name, points, least, closed = false) {
  if (points.some((point) => point.some((value) => !(Math.abs(value) <= CURVE.MOST_METRES))))
    throw new InputError(_("{name}: points must lie within 1e8 m of the origin", { name }));
  const last = points[points.length - 1];
  const repeats = closed && points.length > 1 && last.every((value, k) => value === points[0][k]);
  const table = repeats ? points.slice(0, -1) : points;
  const most = MODEL_OBSTACLE.MOST_CORNERS;
  const count = table.length;
  if (!(least <= count && count <= most))
    throw new InputError(
      _("{name}: wanted {least} to {most} points, not {count}", { name, least, most, count }),
    );
  const sides = closed ? count : count - 1;
  for (let i = 0; i < sides; i++) {
    const [[x, y], [toX, toY]] = [table[i], table[(i + 1) % count]];
    if (Math.hypot(toX - x, toY - y) < MODEL_OBSTACLE.LEAST_SIDE)
      throw new InputError(
        _("{name}: points {i} and {j} are the same", { name, i: i + 1, j: ((i + 1) % count) + 1 }),
      );
  }
  return table;
}

/** Two sides of a closed outline that meet though they are no neighbours, or fold back; null if none. @param {Point[]} corners @returns {[number, number] | null} */
function crossingSides(corners) {
  const count = corners.length;
  const end = (/** @type {number} */ i) => corners[(i + 1) % count];
  for (let i = 0; i < count; i++) {
    const j = (i + 1) % count;
    const [ax, ay] = [end(i)[0] - corners[i][0], end(i)[1] - corners[i][1]];
    const [bx, by] = [end(j)[0] - corners[j][0], end(j)[1] - corners[j][1]];
    if (ax * by - ay * bx === 0 && ax * bx + ay * by < 0) return [i, j];
  }
  for (let i = 0; i < count; i++)
    for (let j = i + 2; j < count; j++)
      if (j - i !== count - 1 && doMeet(corners[i], end(i), corners[j], end(j))) return [i, j];
  return null;
}

/** Whether two segments share a point. @param {Point} a @param {Point} b @param {Point} c @param {Point} d */
function doMeet(a, b, c, d) {
  for (const k of [0, 1])
    if (Math.max(a[k], b[k]) < Math.min(c[k], d[k]) || Math.max(c[k], d[k]) < Math.min(a[k], b[k]))
      return false;
  const sides = [sideOf(a, b, c) * sideOf(a, b, d), sideOf(c, d, a) * sideOf(c, d, b)];
  return sides[0] <= 0 && sides[1] <= 0;
}

/** On which side of a line from a to b a point lies: -1, 0, 1. @param {Point} a @param {Point} b @param {Point} c */
function sideOf(a, b, c) {
  return Math.sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

/** @param {Record<string, any>} table of an obstacle, filled @param {string} name @param {number} margin */
function builtObstacle(table, name, margin) {
  switch (table.kind) {
    case "circle": {
      const centre = checkedPoints(name, [table.centre], 1);
      return new Obstacle(name, "circle", centre, checkedSize("radius", table.radius), margin);
    }
    case "rectangle": {
      const outline = rectangleOutline(name, table.centre, table.size, radians(table.angle));
      return new Obstacle(name, "rectangle", outline, 0, margin);
    }
    case "polygon":
      return new Obstacle(name, "polygon", closedOutline(name, table.points), 0, margin);
    default:
      return new Obstacle(name, "line", checkedPoints(name, table.points, 2), 0, margin);
  }
}

/** The edge, from which benches keep `margin`, m; null if the plan says none. @param {Record<string, any>} venue @param {number} margin */
function builtVenue(venue, margin) {
  const name = venue.name || "venue";
  if (venue.boundary !== null)
    return new Obstacle(name, "venue", closedOutline(name, venue.boundary), 0, margin);
  if (venue.rectangle === null) return null;
  const angle = radians(venue.angle ?? 0);
  const outline = rectangleOutline(name, venue.centre ?? [0, 0], venue.rectangle, angle);
  return new Obstacle(name, "venue", closedOutline(name, outline), 0, margin);
}

/**
 * The edge of the venue, if there is one, then what stands on it.
 * @param {Record<string, any>} data a plan's tables, filled
 * @returns {Obstacle[]}
 */
export function builtObstacles({ venue, obstacle: tables, limits }) {
  const faults = new Faults();
  const edge = faults.tried("venue", () => builtVenue(venue, limits.venue_margin ?? limits.margin));
  const found = edge ? [edge] : [];
  const taken = new Map(edge ? [[edge.name, "venue"]] : []);
  tables.forEach((/** @type {Record<string, any>} */ table, /** @type {number} */ n) => {
    const name = table.name || `obstacle ${n + 1}`;
    const first = taken.get(name);
    if (first !== undefined) {
      const second = `obstacle.${n}`;
      const text = _("two things are called {name}: {first} and {second}", { name, first, second });
      faults.found.push(new Fault(`${second}.name`, text));
    } else taken.set(name, `obstacle.${n}`);
    const made = faults.tried(`obstacle.${n}`, () =>
      builtObstacle(table, name, table.margin ?? limits.margin),
    );
    if (made) found.push(made);
  });
  if (faults.found.length) throw new KeyedError(faults.found);
  return found;
}
