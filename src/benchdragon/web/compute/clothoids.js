// Clothoids between poses: twin of surveys/clothoids.py.

import { _ } from "../words.js";
import { withArena } from "./arena.js";
import { SURVEYS_CLOTHOIDS } from "./constants.js";
import { Route, clothoidPart, linePart } from "./curves.js";
import { InputError } from "./errors.js";
import { linspace, rint } from "./numbers.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./curves.js").Part} Part */
/** @typedef {[number, number]} Point */
/** @typedef {[number, number, number]} PoseRow x, y, heading */

const { MOST_STEPS, CLOSE, ROUNDING, STEPS, STRAIGHT } = SURVEYS_CLOTHOIDS;

/** Nodes and weights of Gauss and Legendre on 0..1. @param {number} count */
function gaussLegendre(count) {
  const nodes = new Float64Array(count);
  const weights = new Float64Array(count);
  for (let i = 0; i < count; i++) {
    let x = -Math.cos((Math.PI * (i + 0.75)) / (count + 0.5));
    let slope = 1;
    for (let step = 0; step < 10; step++) {
      let [before, value] = [1, x];
      for (let n = 2; n <= count; n++)
        [before, value] = [value, ((2 * n - 1) * x * value - (n - 1) * before) / n];
      slope = (count * (x * value - before)) / (x * x - 1);
      x -= value / slope;
    }
    nodes[i] = 0.5 * (1 + x);
    weights[i] = 1 / ((1 - x * x) * slope * slope);
  }
  return { nodes, weights };
}

const GAUSS = gaussLegendre(40);

/** An angle, rad, folded into -pi..pi. @param {number} angle */
export function foldedAngle(angle) {
  return angle - 2 * Math.PI * rint(angle / (2 * Math.PI));
}

/** The integral over 0..1 of a function of the share and of the heading there. @param {number} a @param {number} change @param {number} phi0 @param {(heading: number, share: number) => number} of */
function integral(a, change, phi0, of) {
  let sum = 0;
  GAUSS.nodes.forEach((t, n) => {
    sum += of(a * (t * t - t) + change * t + phi0, t) * GAUSS.weights[n];
  });
  return sum;
}

/**
 * A clothoid from each pose to the next, the one that winds least; one that is straight is a line.
 * @param {PoseRow[]} poses m and rad
 * @returns {Part[]}
 */
export function g1Clothoids(poses) {
  return poses.slice(1).map(([endX, endY, endHeading], n) => {
    const [x, y, heading] = poses[n];
    const chord = Math.hypot(endX - x, endY - y);
    const numbers = { first: n + 1, second: n + 2 };
    if (!(chord > 0)) throw new InputError(_("points {first} and {second} are in one place", numbers));
    const along = Math.atan2(endY - y, endX - x);
    const [phi0, phi1] = [foldedAngle(heading - along), foldedAngle(endHeading - along)];
    const change = phi1 - phi0;
    const bend = shapeOf(phi0, phi1);
    if (bend === null)
      throw new InputError(
        _(
          "no gentle curve leads from point {first} to point {second}: the line doubles back there",
          numbers,
        ),
      );
    const length = chord / integral(bend, change, phi0, (at) => Math.cos(at));
    if (Math.max(Math.abs(phi0), Math.abs(phi1)) <= STRAIGHT) return linePart(length, [x, y], heading);
    return clothoidPart(length, (change - bend) / length, (change + bend) / length, [x, y], heading);
  });
}

/** A of a clothoid, by Newton's method from the shape of a gentle one; null where none is gentle. @param {number} phi0 @param {number} phi1 */
function shapeOf(phi0, phi1) {
  const change = phi1 - phi0;
  const ordinate = (/** @type {number} */ of) => integral(of, change, phi0, (at) => Math.sin(at));
  let a = 3 * (phi0 + phi1);
  let left = ordinate(a);
  for (let step = 0; step < MOST_STEPS && Math.abs(left) > CLOSE; step++) {
    const slope = integral(a, change, phi0, (at, t) => Math.cos(at) * (t * t - t));
    let move = -left / (slope === 0 ? 1 : slope);
    let tried = ordinate(a + move);
    for (let half = 1; half < MOST_STEPS && Math.abs(tried) > Math.abs(left); half++) {
      move *= 0.5;
      tried = ordinate(a + move);
    }
    [a, left] = [a + move, tried];
  }
  const share = integral(a, change, phi0, (at) => Math.cos(at));
  return Math.abs(left) > 1e-12 || share < 1e-3 ? null : a;
}

/** At each point the heading, rad, of the circle through it and both its neighbours. @param {Point[]} points @param {boolean} closed */
export function circleHeadings(points, closed) {
  const ring = closed ? [points[points.length - 1], ...points, points[0]] : points;
  const heading = (/** @type {Point} */ [x, y], /** @type {Point} */ [toX, toY]) =>
    Math.atan2(toY - y, toX - x);
  const along = ring.slice(1).map((point, n) => heading(ring[n], point));
  if (along.length === 1) return [along[0], along[0]];
  // The angle between a chord and the tangent at its end is the one at the far point over that chord.
  const inner = along.slice(1).map((next, n) => {
    const turn = foldedAngle(next - along[n]);
    const over = heading(ring[n], ring[n + 2]);
    return along[n] + (Math.abs(turn) < Math.PI ? foldedAngle(next - over) : 0);
  });
  if (closed) return inner;
  const last = 2 * along[along.length - 1] - inner[inner.length - 1];
  return [2 * along[0] - inner[0], ...inner, last];
}

/** A bound on how far a curve and the chord between its ends lie from each other, either way, m. @param {Engine} engine @param {Part} part */
export function boundToChord(engine, part) {
  return withArena(engine, (arena) => {
    const route = new Route(arena, [part]);
    const { length } = route;
    const found = route.evaluate(linspace(0, length, STEPS + 1));
    const [x0, y0] = found;
    const [dx, dy] = [found[4 * STEPS] - x0, found[4 * STEPS + 1] - y0];
    let worst = 0;
    for (let n = 0; n <= STEPS; n++) {
      const [x, y] = [found[4 * n] - x0, found[4 * n + 1] - y0];
      const at = Math.min(Math.max((x * dx + y * dy) / (dx * dx + dy * dy), 0), 1);
      worst = Math.max(worst, Math.hypot(x - at * dx, y - at * dy));
    }
    const bend = Math.max(Math.abs(found[3]), Math.abs(found[4 * STEPS + 3]));
    return worst + 0.125 * bend * (length / STEPS) ** 2 + ROUNDING * length;
  });
}
