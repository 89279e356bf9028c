// Corners of a polyline, rounded by arcs, or by clothoids with an arc between: twin of surveys/corners.py.

import { foldedAngle } from "./clothoids.js";
import { SURVEYS_CORNERS } from "./constants.js";
import { arcPart, clothoidPart, endPose, linePart } from "./curves.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./curves.js").Part} Part */
/** @typedef {[number, number]} Point */
/** Bends for corners, of radius 1 m: see `Shapes` of surveys/corners.py. */
/** @typedef {{ tangent: number[], reach: number[], eased: number[] }} Shapes */

const { EASED, LEAST_TURN, LEAST_LINE, MOST_RADIUS, STRAIGHT_END } = SURVEYS_CORNERS;

/** The sides of a polyline, and how much it turns after each; at an open end not at all. */
export class Corners {
  /** @param {Point[]} points @param {boolean} closed */
  constructor(points, closed) {
    this.closed = closed;
    this.points = closed ? [...points, points[0]] : points;
    const steps = this.points
      .slice(1)
      .map(([x, y], n) => [x - this.points[n][0], y - this.points[n][1]]);
    this.lengths = steps.map(([dx, dy]) => Math.hypot(dx, dy));
    this.headings = steps.map(([dx, dy]) => Math.atan2(dy, dx));
    const { length } = steps;
    this.turns = this.headings.map((heading, n) =>
      closed || n < length - 1 ? foldedAngle(this.headings[(n + 1) % length] - heading) : 0,
    );
  }
}

/** Of corners that turn by so much, rad; `smooth` bends begin and end with a clothoid. @param {Engine} engine @param {number[]} turns @param {boolean} smooth @returns {Shapes} */
export function shapesOf(engine, turns, smooth) {
  const half = turns.map((turn) => 0.5 * Math.abs(turn));
  const eased = half.map((angle) => (smooth ? EASED * angle : 0));
  /** @type {Shapes} */
  const found = { tangent: [], reach: [], eased };
  half.forEach((angle, n) => {
    let [x, y] = [Math.sin(eased[n]), Math.cos(eased[n])];
    if (eased[n] > 0) {
      const end = endPose(engine, clothoidPart(2 * eased[n], 0, 1));
      [x, y] = [end.x, end.y + y];
    }
    // The centre of the arc is at (x - sin, y) from the start of the bend, along the side and across it.
    found.tangent.push(x - Math.sin(eased[n]) + y * Math.tan(angle));
    // y / cos(half) - 1, without cancelling: y is 1 and a little more.
    found.reach.push((y - 1 + 2 * Math.sin(0.5 * angle) ** 2) / Math.cos(angle));
  });
  return found;
}

/**
 * The radius of the bend at the end of each side, m: infinite where it does not turn.
 * @param {Corners} corners
 * @param {Shapes} shape
 * @param {number[]} reach what each bend may add, m
 */
export function bendRadii(corners, shape, reach) {
  const { turns, lengths, closed } = corners;
  const count = turns.length;
  const wanted = shape.reach.map((own, n) =>
    Math.min(own > 0 ? reach[n] / own : Infinity, MOST_RADIUS),
  );
  const tangent = turns.map((turn, n) => (Math.abs(turn) > LEAST_TURN ? shape.tangent[n] : 0));
  const room = [...lengths];
  if (!closed) for (const n of new Set([0, count - 1])) room[n] *= 1 - STRAIGHT_END;
  const fair = room.map((length, n) => {
    const both = tangent[(n + count - 1) % count] + tangent[n];
    return both > 0 ? length / both : Infinity;
  });
  const found = wanted.map((most, n) =>
    tangent[n] === 0 ? Infinity : Math.min(most, fair[n], fair[(n + 1) % count]),
  );
  return widenedRadii(found, wanted, tangent, room);
}

/** Each, the narrowest first, takes what its neighbours leave. @param {number[]} found @param {number[]} wanted @param {number[]} tangent @param {number[]} room */
function widenedRadii(found, wanted, tangent, room) {
  const count = found.length;
  const length = tangent.map((own, n) => (own > 0 && Number.isFinite(found[n]) ? found[n] * own : 0));
  const order = found.map((_radius, n) => n).sort((a, b) => compared(found[a], found[b]) || a - b);
  for (const n of order) {
    if (tangent[n] === 0) continue;
    const [before, after] = [(n + count - 1) % count, (n + 1) % count];
    const left = count > 1 ? Math.min(room[n] - length[before], room[after] - length[after]) : 0;
    length[n] = Math.max(length[n], Math.min(wanted[n] * tangent[n], left));
  }
  return tangent.map((own, n) => (own > 0 ? length[n] / own : Infinity));
}

/** @param {number} a @param {number} b */
function compared(a, b) {
  return a === b ? 0 : a < b ? -1 : 1;
}

/** Lines and bends of these radii, m. @param {Engine} engine @param {Corners} corners @param {Shapes} shape @param {number[]} bends */
export function roundedCorners(engine, { points, headings, lengths, turns, closed }, shape, bends) {
  const tangent = bends.map((radius, n) => (Number.isFinite(radius) ? radius : 0) * shape.tangent[n]);
  const count = bends.length;
  /** @type {Part[]} */
  const found = [];
  bends.forEach((radius, n) => {
    const begin = n || closed ? tangent[(n + count - 1) % count] : 0;
    const [c, s] = [Math.cos(headings[n]), Math.sin(headings[n])];
    const left = lengths[n] - begin - tangent[n];
    const [x, y] = points[n];
    if (left > LEAST_LINE) found.push(linePart(left, [x + begin * c, y + begin * s], headings[n]));
    if (tangent[n] > 0) {
      const [cx, cy] = points[n + 1];
      /** @type {Point} */
      const at = [cx - tangent[n] * c, cy - tangent[n] * s];
      found.push(...bendParts(engine, radius, turns[n], shape.eased[n], at, headings[n]));
    }
  });
  return found;
}

/** An arc, or clothoid, arc and clothoid, that begins at a pose. @param {Engine} engine @param {number} radius @param {number} turn @param {number} eased @param {Point} at @param {number} heading */
function bendParts(engine, radius, turn, eased, at, heading) {
  if (eased === 0) return [arcPart(radius, turn, at, heading)];
  const side = turn < 0 ? -1 : 1;
  const [bend, length] = [side / radius, 2 * radius * eased];
  const first = clothoidPart(length, 0, bend, at, heading);
  const one = endPose(engine, first);
  const middle = arcPart(radius, turn - 2 * side * eased, [one.x, one.y], one.heading);
  const two = endPose(engine, middle);
  return [first, middle, clothoidPart(length, bend, 0, [two.x, two.y], two.heading)];
}
