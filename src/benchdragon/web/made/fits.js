// @ts-nocheck
// Made from surveys/fitting.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { Absorbed } from "./absorbed.js";
import { Route, curvesOf } from "./curves.js";
import { unfit } from "./unfit.js";

const PART_COLUMNS = 8;
const Smoothing = { NONE: 0, G1: 1, G2: 2 };
const FitStatus = { OK: 0, ONE_PLACE: 1, DOUBLES_BACK: 2, NO_ROOM: 3, HAIRPIN: 4 };
class Fit {
  constructor(route, deviation, leastRadius, s, absorbed) {
    this.route = route;
    this.deviation = deviation;
    this.least_radius = leastRadius;
    this.s = s;
    this.absorbed = absorbed;
  }
}
export function checkFewest(count, closed) {
  let text, wanted;
  wanted = (py.truth(closed) ? 3 : 2);
  if ((count < wanted)) {
    text = _("a drawn line needs {wanted} different points at least, not {count}");
    throw new InputError(py.filled(text, { wanted: wanted, count: count }));
  }
}
export function rounded(points, off, closed, smooth, deviation) {
  let bound, how, joints, n, parts, status, text, x, y;
  parts = py.empty([(4 * py.len(points)), PART_COLUMNS]);
  how = py.at(Smoothing, py.upper(smooth));
  [status, n, bound] = py.list(py.entry("bd_fitting_fit_points", points, closed, how, deviation, off, parts));
  if (py.has([FitStatus.ONE_PLACE, FitStatus.DOUBLES_BACK], status)) {
    throw unfit(status, n);
  }
  if (py.eq(status, FitStatus.NO_ROOM)) {
    text = _("a deviation of {deviation} m leaves nothing to round corners with: the drawing itself is known to {off} m");
    throw new InputError(py.filled(text, { deviation: `${py.format(deviation, `g`)}`, off: `${py.format(bound, `.3g`)}` }));
  }
  if (py.eq(status, FitStatus.HAIRPIN)) {
    [x, y] = py.list(py.at(py.tolist(points), n));
    text = _("at ({x}, {y}) m the drawing doubles straight back: no bend rounds that");
    throw new InputError(py.filled(text, { x: `${py.format(x, `.6g`)}`, y: `${py.format(y, `.6g`)}` }));
  }
  joints = (((smooth !== "none") || !py.truth(closed)) ? (n - 1) : n);
  return _fit(curvesOf(py.slice(parts, null, n)), bound, new Absorbed(joints));
}
function _fit(curves, deviation, absorbed) {
  let bend, route, s;
  route = new Route(curves);
  [bend, s] = py.list(py.entry("bd_route_parts_tightest_bend", route.rows));
  return new Fit(route, deviation, (py.truth(bend) ? (1.0 / bend) : Infinity), s, absorbed);
}
export function checkedFit(fit, deviation, leastRadius) {
  let text, x, y;
  if ((fit.deviation > deviation)) {
    text = _("the route keeps within {bound} m of the drawing, not within the deviation of {deviation} m: allow more, or round its corners by route.smooth = \"G1\"");
    throw new InputError(py.filled(text, { bound: `${py.format(fit.deviation, `.3g`)}`, deviation: `${py.format(deviation, `g`)}` }));
  }
  if ((fit.least_radius < leastRadius)) {
    [x, y] = py.list(py.tolist(fit.route.point(py.min(fit.s, fit.route.length))));
    throw new InputError(py.filled(_("at ({x}, {y}) m, s = {s} m, the route bends with a radius of {radius} m, and {wanted} m is required: allow a larger deviation than {deviation} m, or draw the bend wider"), { x: `${py.format(x, `.4f`)}`, y: `${py.format(y, `.4f`)}`, s: `${py.format(fit.s, `.4f`)}`, radius: `${py.format(fit.least_radius, `.4g`)}`, wanted: `${py.format(leastRadius, `g`)}`, deviation: `${py.format(deviation, `g`)}` }));
  }
  return fit;
}
