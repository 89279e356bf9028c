// A route along points that were drawn, through them or with corners rounded: twin of surveys/fitting.py.

import { _ } from "../words.js";
import { withArena } from "./arena.js";
import { boundToChord, circleHeadings, g1Clothoids } from "./clothoids.js";
import { CURVE, ROUTE_PARTS, SURVEYS_CORNERS, SURVEYS_FITTING, SURVEYS_LINES } from "./constants.js";
import { Corners, bendRadii, roundedCorners, shapesOf } from "./corners.js";
import { Route } from "./curves.js";
import { InputError } from "./errors.js";
import { general } from "./number_format.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./curves.js").Part} Part */
/** @typedef {[number, number]} Point */
/** @typedef {{ points: Point[], closed: boolean, off: number }} DrawnPoints off: how far they may lie from what was drawn, m */
/** @typedef {{ parts: Part[], bound: number }} Along parts, and how far they lie from the line at most, m */

const { SHARES, ROUNDING, SLACK } = SURVEYS_FITTING;
const { MOST_CURVES, SAME } = SURVEYS_LINES;

/** Points, those that repeat the one before left out. @param {Point[]} points @param {boolean} closed */
export function withoutRepeats(points, closed) {
  const apart = (/** @type {Point} */ a, /** @type {Point} */ b) =>
    Math.hypot(a[0] - b[0], a[1] - b[1]);
  const kept = points.filter(
    (point, n) => n === points.length - 1 || apart(points[n + 1], point) > SAME,
  );
  while (closed && kept.length > 1 && apart(kept[0], kept[kept.length - 1]) <= SAME) kept.pop();
  return kept;
}

/**
 * The parts of the route along a line of points.
 * @param {Engine} engine
 * @param {DrawnPoints} line
 * @param {string} smooth "none": through every point by clothoids; "G1": corners rounded by arcs; "G2": by clothoids
 * @param {number} deviation the most by which route and line may differ, m
 * @param {number} leastRadius that every bend must have, m
 */
export function fitted(engine, line, smooth, deviation, leastRadius) {
  const { points, closed } = line;
  const wanted = closed ? 3 : 2;
  if (points.length < wanted)
    throw new InputError(
      _("a drawn line needs {wanted} different points at least, not {count}", {
        wanted,
        count: points.length,
      }),
    );
  const { parts, bound } =
    smooth === "none"
      ? throughPoints(engine, line)
      : roundedLine(engine, line, smooth === "G2", deviation);
  if (bound > deviation)
    throw new InputError(
      _(
        'the route keeps within {bound} m of the drawing, not within the deviation of {deviation} m: allow more, or round its corners by route.smooth = "G1"',
        { bound: general(bound, 3), deviation: general(deviation) },
      ),
    );
  checkBends(engine, parts, deviation, leastRadius);
  return parts;
}

/** The curvatures of a line, arc or clothoid at its ends, 1/m, their size. @param {Part} part */
function bendsOf(part) {
  const size = part[ROUTE_PARTS.SIZE];
  if (part[ROUTE_PARTS.PART_KIND] === CURVE.LINE) return [0, 0];
  if (part[ROUTE_PARTS.PART_KIND] === CURVE.ARC) return [1 / size, 1 / size];
  return [Math.abs(part[ROUTE_PARTS.FIRST]), Math.abs(part[ROUTE_PARTS.LAST])];
}

/** Refuse a route of which some bend is tighter than wanted. @param {Engine} engine @param {Part[]} parts @param {number} deviation @param {number} wanted */
function checkBends(engine, parts, deviation, wanted) {
  const bends = parts.map((part) => Math.max(...bendsOf(part)));
  const most = Math.max(...bends);
  const radius = most ? 1 / most : Infinity;
  withArena(engine, (arena) => {
    const route = new Route(arena, parts); // which refuses gaps and kinks
    if (radius >= wanted) return;
    const worst = bends.indexOf(most);
    const [first, last] = bendsOf(parts[worst]);
    const s = last > first ? route.joints[worst + 1] : route.joints[worst];
    const [x, y] = route.point(Math.min(s, route.length));
    throw new InputError(
      _(
        "at ({x}, {y}) m, s = {s} m, the route bends with a radius of {radius} m, and {wanted} m is wanted: allow a larger deviation than {deviation} m, or draw the bend wider",
        {
          x: x.toFixed(4),
          y: y.toFixed(4),
          s: s.toFixed(4),
          radius: general(radius, 4),
          wanted: general(wanted),
          deviation: general(deviation),
        },
      ),
    );
  });
}

/** Through every point, by clothoids that meet with the headings of circles through neighbours. @param {Engine} engine @param {DrawnPoints} line @returns {Along} */
function throughPoints(engine, { points, closed, off }) {
  const headings = circleHeadings(points, closed);
  /** @type {Array<[number, number, number]>} */
  const poses = points.map(([x, y], n) => [x, y, headings[n]]);
  const parts = g1Clothoids(closed ? [...poses, poses[0]] : poses);
  return { parts, bound: off + Math.max(...parts.map((part) => boundToChord(engine, part))) };
}

/** With corners rounded: of several ways to share the deviation that with the widest bends. @param {Engine} engine @param {DrawnPoints} line @param {boolean} smooth @param {number} deviation @returns {Along} */
function roundedLine(engine, { points, closed, off: drawn }, smooth, deviation) {
  if (points.length > MOST_CURVES)
    throw new InputError(_("the arcs of the drawing need too many chords: allow a larger deviation"));
  const far = points.reduce((most, [x, y]) => Math.max(most, Math.abs(x), Math.abs(y)), 0);
  const off = drawn + ROUNDING * (1 + far);
  const left = (1 - SLACK) * (deviation - off);
  if (left <= 0)
    throw new InputError(
      _(
        "a deviation of {deviation} m leaves nothing to round corners with: the drawing itself is known to {off} m",
        { deviation: general(deviation), off: general(off, 3) },
      ),
    );
  const ways = SHARES.map((share) => {
    const { kept, strays } = simplified(points, closed, share * left);
    const corners = new Corners(kept, closed);
    if (corners.turns.some((turn) => Math.abs(turn) > SURVEYS_CORNERS.MOST_CORNER))
      return { corners, strays, shape: null, bends: [], least: -1 };
    const shape = shapesOf(engine, corners.turns, smooth);
    const bends = bendRadii(corners, shape, allowedReach(strays, left));
    return { corners, strays, shape, bends, least: Math.min(...bends) };
  });
  const best = ways.reduce((one, other) => (other.least > one.least ? other : one));
  if (!best.shape) throw hairpin(best.corners);
  const { corners, strays, shape, bends } = best;
  const around = withNext(strays);
  const bounds = bends.map(
    (radius, n) => around[n] + (Number.isFinite(radius) ? radius : 0) * shape.reach[n],
  );
  return { parts: roundedCorners(engine, corners, shape, bends), bound: off + Math.max(...bounds) };
}

/** The greater of each and the next. @param {number[]} strays */
function withNext(strays) {
  return strays.map((stray, n) => Math.max(stray, strays[(n + 1) % strays.length]));
}

/** What the bend at the end of each side may add to what its two sides stray already, m. @param {number[]} strays @param {number} left */
function allowedReach(strays, left) {
  return withNext(strays).map((stray) => left - stray);
}

/** @param {Corners} corners */
function hairpin({ turns, points }) {
  const sizes = turns.map(Math.abs);
  const [x, y] = points[sizes.indexOf(Math.max(...sizes)) + 1];
  return new InputError(
    _("at ({x}, {y}) m the drawing doubles straight back: no bend rounds that", {
      x: general(x),
      y: general(y),
    }),
  );
}

/**
 * Which of points to keep, and how far each side between them strays, m: by Ramer, Douglas and Peucker.
 * @param {Point[]} points
 * @param {boolean} closed
 * @param {number} tolerance m
 */
function simplified(points, closed, tolerance) {
  const ring = closed ? [...points, points[0]] : points;
  const last = ring.length - 1;
  const cuts = closed ? ringCuts(points, last) : [0, last];
  const stack = cuts.slice(1).map((cut, n) => [cuts[n], cut]);
  /** @type {Array<[number, number]>} */
  const sides = [];
  for (let pair = stack.pop(); pair; pair = stack.pop()) {
    const [a, b] = pair;
    let [worst, middle] = [0, a + 1];
    for (let n = a + 1; n < b; n++) {
      const away = distanceTo(ring[n], ring[a], ring[b]);
      if (away > worst) [worst, middle] = [away, n];
    }
    const apart = ring[a][0] !== ring[b][0] || ring[a][1] !== ring[b][1];
    if (worst <= tolerance && (b - a === 1 || apart)) sides.push([a, worst]);
    else stack.push([a, middle], [middle, b]);
  }
  sides.sort(([a], [b]) => a - b);
  const kept = sides.map(([a]) => ring[a]);
  return { kept: closed ? kept : [...kept, ring[last]], strays: sides.map(([, away]) => away) };
}

/** Where a closed line is cut at first: at its first point, the farthest, and the one farthest aside. @param {Point[]} points @param {number} last */
function ringCuts(points, last) {
  const [x0, y0] = points[0];
  const away = points.map(([x, y]) => Math.hypot(x - x0, y - y0));
  const far = away.indexOf(Math.max(...away));
  const [dx, dy] = [points[far][0] - x0, points[far][1] - y0];
  const aside = points.map(([x, y]) => Math.abs((x - x0) * dy - (y - y0) * dx));
  return [...new Set([0, far, aside.indexOf(Math.max(...aside)), last])].sort((a, b) => a - b);
}

/** How far a point lies from the segment between a and b, m. @param {Point} point @param {Point} a @param {Point} b */
function distanceTo([x, y], [ax, ay], [bx, by]) {
  const [dx, dy, px, py] = [bx - ax, by - ay, x - ax, y - ay];
  const size = dx * dx + dy * dy;
  const at = size ? Math.min(Math.max((px * dx + py * dy) / size, 0), 1) : 0;
  return Math.hypot(px - at * dx, py - at * dy);
}
