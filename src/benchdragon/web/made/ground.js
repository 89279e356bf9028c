// @ts-nocheck
// Made from analysis/ground.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";

const LEAST_EDGE = 0.15;
const UNTURNED = 1e-09;
const CORNER = 1e-06;
const NORTH = [N_("due east"), N_("due north"), N_("due west"), N_("due south")];
const VENUE = [N_("to the right"), N_("forward"), N_("to the left"), N_("back")];
const NORTH_EDGES = [N_("eastern edge"), N_("northern edge"), N_("western edge"), N_("southern edge")];
const EDGES = [N_("right edge"), N_("far edge"), N_("left edge"), N_("near edge")];
const AXES = [N_("the way x points"), N_("the way y points"), N_("against x"), N_("against y")];
export class Ground {
  constructor(peg, turned = 0.0, north = false, venue = false) {
    this.peg = peg;
    this.turned = turned;
    this.north = north;
    this.venue = venue;
  }
  static measured(peg, north, edges) {
    if ((py.truth(north) || !py.truth(edges))) {
      return new this(peg, 0.0, north);
    }
    return new this(peg, baseAngle(py.at(edges, 0)), false, true);
  }
  get ways() {
    let c, s;
    [c, s] = py.list([py.cos(this.turned), py.sin(this.turned)]);
    return [[c, s], [-s, c], [-c, -s], [s, -c]];
  }
  get way_names() {
    let againstX, againstY, x, y;
    [x, y, againstX, againstY] = py.list((py.truth(this.north) ? NORTH : (py.truth(this.venue) ? VENUE : AXES)));
    return [_(x), _(y), _(againstX), _(againstY)];
  }
  edge(out) {
    let along;
    along = py.list(this.ways).map(([u, v]) => py.add((u * py.at(out, 0)), (v * py.at(out, 1))));
    return py.index(along, py.max(along));
  }
  edge_name(edge) {
    return _(py.at((py.truth(this.north) ? NORTH_EDGES : EDGES), edge));
  }
  get y_name() {
    if (py.truth(this.north)) {
      return _("N (y axis)");
    }
    return (py.truth(this.venue) ? _("forward (y)") : _("y axis"));
  }
  get legend() {
    if (py.truth(this.north)) {
      return _("x and y are measured from the peg: x east, y north.");
    }
    if (py.truth(this.venue)) {
      return _("x and y are measured from the peg along the venue's edges: x to the right, y forward, as one sees it who stands at the near edge and faces the square; to the left and back they are negative.");
    }
    return _("x and y are measured from the peg: on the drawings x to the right, y up.");
  }
  get ways_legend() {
    if ((py.truth(this.north) || !py.truth(this.venue))) {
      return "";
    }
    return _("To the right, forward, to the left and back: as one sees it who stands at the near edge and faces the square.");
  }
  get y_word() {
    return (py.truth(this.north) ? _("N") : (py.truth(this.venue) ? _("forward") : "y"));
  }
  seen_at(place) {
    let _against, ux, uy, vx, vy, x, y;
    [x, y] = py.list([py.sub(py.at(place, 0), py.at(this.peg, 0)), py.sub(py.at(place, 1), py.at(this.peg, 1))]);
    [[ux, uy], [vx, vy], ..._against] = py.list(this.ways);
    return [py.add((x * ux), (y * uy)), py.add((x * vx), (y * vy))];
  }
}
class Side {
  constructor(ax, ay, bx, by) {
    this.ax = ax;
    this.ay = ay;
    this.bx = bx;
    this.by = by;
  }
  *[Symbol.iterator]() {
    yield* [this.ax, this.ay, this.bx, this.by];
  }
  along() {
    return [py.sub(this.bx, this.ax), py.sub(this.by, this.ay)];
  }
  swept() {
    return py.sub((this.ax * this.by), (this.bx * this.ay));
  }
  right() {
    return (!py.eq((this.ay > 0.0), (this.by > 0.0)) && py.eq((this.swept() > 0.0), (this.by > this.ay)));
  }
  out(turned) {
    let length, x, y;
    [x, y] = py.list(this.along());
    length = (turned * py.hypot(x, y));
    return [(y / length), (-x / length)];
  }
  apart() {
    let share, x, y;
    [x, y] = py.list(this.along());
    share = py.min(py.max((-py.add((this.ax * x), (this.ay * y)) / py.add((x * x), (y * y))), 0.0), 1.0);
    return py.hypot(py.add(this.ax, (share * x)), py.add(this.ay, (share * y)));
  }
  ahead(u, v) {
    let beyond, far, share, squarely, x, y;
    [x, y] = py.list(this.along());
    squarely = py.sub((u * y), (v * x));
    if ((squarely === 0.0)) {
      return null;
    }
    [far, share] = py.list([(this.swept() / squarely), (py.sub((this.ax * v), (this.ay * u)) / squarely)]);
    beyond = (CORNER / py.hypot(x, y));
    return (((far >= 0.0) && ((-beyond <= share) && (share <= (1.0 + beyond)))) ? far : null);
  }
}
export function wayOut(outline, place, way = /** @type {any} */ (null)) {
  let far, least, met, near, off, sides, there, turned, u, v;
  off = py.list(py.tolist(py.asarray(outline))).map(([x, y]) => [py.sub(x, py.at(place, 0)), py.sub(y, py.at(place, 1))]);
  sides = py.list(py.pairwise([...py.iter(off), py.at(off, 0)])).map(([one, other]) => new Side(...py.iter(one), ...py.iter(other)));
  if ((py.mod(py.sum(py.list(sides).map((one) => one.right())), 2) === 0)) {
    return null;
  }
  turned = py.copysign(1.0, py.sum(py.list(sides).map((one) => one.swept())));
  if ((way == null)) {
    near = py.min(sides, (one) => one.apart());
    return [near.apart(), near.out(turned)];
  }
  [u, v] = py.list(way);
  met = py.list(sides).flatMap((one) => ((((far = one.ahead(u, v)) != null)) ? [[far, one.out(turned)]] : []));
  least = py.min(py.list(met).map(([far, _out]) => far));
  there = py.list(met).flatMap(([far, out]) => (((far <= py.add(least, CORNER))) ? [out] : []));
  return [least, py.max(there, (out) => py.add((py.at(out, 0) * u), (py.at(out, 1) * v)))];
}
function edgeLengths(ground, edges) {
  let across, ahead, ax, ay, bx, by, lengths, met, other, px, py_, qx, qy, side, ux, uy;
  lengths = [];
  for ([ux, uy] of py.iter(ground.ways)) {
    met = [];
    for ([[ax, ay], [bx, by]] of py.iter(py.zip(edges, [...py.iter(py.slice(edges, 1, null)), py.at(edges, 0)]))) {
      [px, py_, qx, qy] = py.list([py.sub(ax, py.at(ground.peg, 0)), py.sub(ay, py.at(ground.peg, 1)), py.sub(bx, ax), py.sub(by, ay)]);
      across = py.sub((ux * qy), (uy * qx));
      [side, other] = py.list([py.sub((ux * py_), (uy * px)), py.sub((ux * py.add(py_, qy)), (uy * py.add(px, qx)))]);
      if ((py.truth(across) && !py.eq((side < 0.0), (other < 0.0)))) {
        py.append(met, (py.sub((px * qy), (py_ * qx)) / across));
      }
    }
    ahead = py.list(met).flatMap((one) => (((one >= 0.0)) ? [one] : []));
    if ((py.mod(py.len(ahead), 2) === 0)) {
      return null;
    }
    py.append(lengths, py.min(ahead));
  }
  return lengths;
}
export function pegLine(ground, edges) {
  let a, b, c, d, first, fourth, lengths, second, third;
  lengths = edgeLengths(ground, edges);
  if ((lengths == null)) {
    return "";
  }
  [first, second, third, fourth] = py.list(py.list(lengths).map((one) => `${py.format(one, `.2f`)}`));
  [a, b, c, d] = py.list(ground.way_names);
  return py.filled(_("From the peg to the venue's edge it is {first} m {a}, {second} m {b}, {third} m {c}, {fourth} m {d}. Find the peg's place by these lengths, and the directions with it."), { first: first, second: second, third: third, fourth: fourth, a: a, b: b, c: c, d: d });
}
export function ownPeg(plan, route) {
  if ((plan.chalk.peg != null)) {
    return plan.chalk.peg;
  }
  return (!py.eq(route.centre, [0.0, 0.0]) ? route.centre : py.or(plan.route.at, () => [0.0, 0.0]));
}
function baseAngle(outline) {
  let ends, lengths, n, sides, turned;
  ends = py.zip(outline, [...py.iter(py.slice(outline, 1, null)), py.at(outline, 0)]);
  sides = py.list(ends).map(([[a, b], [c, d]]) => [py.sub(c, a), py.sub(d, b)]);
  lengths = py.list(sides).map(([x, y]) => py.round(py.hypot(x, y), 9));
  n = py.index(lengths, py.max(lengths));
  if ((py.at(lengths, n) < (LEAST_EDGE * py.sum(lengths)))) {
    return 0.0;
  }
  turned = py.remainder(py.atan2(py.at(py.at(sides, n), 1), py.at(py.at(sides, n), 0)), (0.5 * Math.PI));
  return ((py.abs(turned) < UNTURNED) ? 0.0 : turned);
}
