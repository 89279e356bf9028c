// A route along points that were drawn, through them or with corners rounded, by the kernels; and what
// is wrong with it, in the words of surveys/fitting.py.

import { _ } from "../words.js";
import { withArena } from "./arena.js";
import { FitStatus, ROUTE_PARTS, SURVEYS_LINES, Smoothing } from "./constants.js";
import { Route, checkedPart, partsOf } from "./curves.js";
import { InputError } from "./errors.js";
import { general } from "./number_format.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./curves.js").Part} Part */
/** @typedef {[number, number]} Point */
/** @typedef {{ points: Point[], closed: boolean, off: number }} DrawnPoints off: how far they may lie from what was drawn, m */

/** Points, those that repeat the one before left out. @param {Point[]} points @param {boolean} closed */
export function withoutRepeats(points, closed) {
  const apart = (/** @type {Point} */ a, /** @type {Point} */ b) =>
    Math.hypot(a[0] - b[0], a[1] - b[1]) > SURVEYS_LINES.SAME;
  const kept = points.filter((point, n) => n === points.length - 1 || apart(points[n + 1], point));
  while (closed && kept.length > 1 && !apart(kept[0], kept[kept.length - 1])) kept.pop();
  return kept;
}

/**
 * The parts of the route along a line of points.
 * @param {Engine} engine
 * @param {DrawnPoints} line
 * @param {string} smooth "none": through every point by clothoids; "G1": corners rounded by arcs; "G2": by clothoids
 * @param {number} deviation the most by which route and line may differ, m
 * @param {number} leastRadius that every bend must have, m
 * @returns {Part[]}
 */
export function fitted(engine, { points, closed, off }, smooth, deviation, leastRadius) {
  const wanted = closed ? 3 : 2;
  if (points.length < wanted)
    throw new InputError(
      _("a drawn line needs {wanted} different points at least, not {count}", {
        wanted,
        count: points.length,
      }),
    );
  if (smooth !== "none" && points.length > SURVEYS_LINES.MOST_CURVES)
    throw new InputError(_("the arcs of the drawing need too many chords: allow a larger deviation"));
  return withArena(engine, (arena) => {
    const out = arena.array("d", 4 * points.length, ROUTE_PARTS.PART_COLUMNS);
    const how = Smoothing[/** @type {keyof typeof Smoothing} */ (smooth.toUpperCase())];
    const [status, n, bound] = engine.call(
      "bd_fitting_fit_points", arena.table(points, 2), closed, how, deviation, off, out,
    ); // prettier-ignore
    if (status !== FitStatus.OK) throw unfit(status, n, points, deviation, bound);
    const parts = partsOf(out, n).map(checkedPart);
    if (bound > deviation)
      throw new InputError(
        _(
          'the route keeps within {bound} m of the drawing, not within the deviation of {deviation} m: allow more, or round its corners by route.smooth = "G1"',
          { bound: general(bound, 3), deviation: general(deviation) },
        ),
      );
    checkBends(new Route(arena, parts), deviation, leastRadius);
    return parts;
  });
}

/** Why there is no such route. @param {number} status @param {number} n point at which @param {Point[]} points @param {number} deviation @param {number} off */
function unfit(status, n, points, deviation, off) {
  const near = { first: n + 1, second: n + 2 };
  const texts = {
    [FitStatus.ONE_PLACE]: () => _("points {first} and {second} are in one place", near),
    [FitStatus.DOUBLES_BACK]: () =>
      _(
        "no gentle curve leads from point {first} to point {second}: the line doubles back there",
        near,
      ),
    [FitStatus.NO_ROOM]: () =>
      _(
        "a deviation of {deviation} m leaves nothing to round corners with: the drawing itself is known to {off} m",
        { deviation: general(deviation), off: general(off, 3) },
      ),
    [FitStatus.HAIRPIN]: () =>
      _("at ({x}, {y}) m the drawing doubles straight back: no bend rounds that", {
        x: general(points[n][0]),
        y: general(points[n][1]),
      }),
  };
  return new InputError(texts[status]());
}

/** Refuse a route of which some bend is tighter than wanted. @param {Route} route @param {number} deviation @param {number} wanted */
function checkBends(route, deviation, wanted) {
  const [bend, s] = route.engine.call("bd_route_parts_tightest_bend", route.rows);
  if (!bend || 1 / bend >= wanted) return;
  const [x, y] = route.point(Math.min(s, route.length));
  throw new InputError(
    _(
      "at ({x}, {y}) m, s = {s} m, the route bends with a radius of {radius} m, and {wanted} m is wanted: allow a larger deviation than {deviation} m, or draw the bend wider",
      {
        x: x.toFixed(4),
        y: y.toFixed(4),
        s: s.toFixed(4),
        radius: general(1 / bend, 4),
        wanted: general(wanted),
        deviation: general(deviation),
      },
    ),
  );
}
