// @ts-nocheck
// Made from plans/routes.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { _fitted } from "../compute/fitting.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { joined, programme } from "./connections.js";
import { Line, Route, Spiral } from "./curves.js";
import { formationOf, linksBelow, refuseTight, wholeDragonOn } from "./formation_tables.js";
import { Fault, Faults, KeyedError } from "./source.js";

const MOST_CURVES = 10000;
const TRAIL = 1000.0;
const FITS = 0.001;
const RUN_UP = 1.0;
const FOLDS = 0.001;
const FINE = 0.5;
const OUT_TO = 0.1;
function _at(key, text) {
  return new KeyedError([new Fault(key, text)]);
}
function _extent(plan) {
  return ((plan.chain == null) ? 0.0 : plan.chain.extent);
}
function _longestLink(plan) {
  return ((plan.chain == null) ? 0.0 : plan.chain.longest_link);
}
class RouteTable {
  get once() {
    return true;
  }
  get after_street() {
    return false;
  }
  whole(plan) {
    let begun, route;
    [route, begun] = py.list(this.build(plan));
    return [this.placed(route), begun];
  }
  last_position(walk) {
    return walk.route.length;
  }
  gated(edge, _route, _plan) {
    return edge;
  }
  placed(route) {
    if (((this.at == null) && (this.turned === 0.0))) {
      return route;
    }
    return route.moved(py.radians(this.turned), py.or(this.at, () => [0.0, 0.0]));
  }
  unplaced(obstacle) {
    let c, s, turned, x, y;
    turned = -py.radians(this.turned);
    [[x, y], c, s] = py.list([py.or(this.at, () => [0.0, 0.0]), py.cos(turned), py.sin(turned)]);
    return obstacle.moved(turned, [py.sub((s * y), (c * x)), py.sub((-s * x), (c * y))]);
  }
  links_below() {
    return Infinity;
  }
}
class Drawn {
  constructor(points, pieces, closed, within) {
    this.points = points;
    this.pieces = pieces;
    this.closed = closed;
    this.within = within;
  }
  *[Symbol.iterator]() {
    yield* [this.points, this.pieces, this.closed, this.within];
  }
}
class Drawing {
  
}
function _along(drawing, link, closed, key) {
  let drawn, kink, least, pieces, points;
  least = py.max(py.or(drawing.least_radius, () => 0.0), ((0.5 * link) * (1.0 + FOLDS)));
  kink = py.radians(drawing.joint_kink);
  if (!(py.truth(drawing.points) || py.truth(drawing.piece))) {
    throw _at(key, _("a drawn route needs points, or a file beside the plan"));
  }
  [points, pieces] = py.list([py.tuple(py.or(drawing.points, () => [])), py.tuple(py.or(drawing.piece, () => []))]);
  drawn = new Drawn(points, pieces, closed, drawing.drawn_within);
  return _fitted(drawn, drawing.smooth, drawing.deviation, least, drawing.joint_gap, kink);
}
function _onALine(route) {
  let before, heading, x, y;
  if ((py.at(route.curves, 0) instanceof Line)) {
    return [route, 0.0];
  }
  [[x, y], heading] = py.list(route.start_pose);
  before = [py.sub(x, (RUN_UP * py.cos(heading))), py.sub(y, (RUN_UP * py.sin(heading)))];
  return [new Route([new Line(RUN_UP, before, heading), ...py.iter(route.curves)]), RUN_UP];
}
export class StreetTable extends Drawing {
  before(route, link) {
    let begun, street;
    refuseTight("route.street.radius", this.radius, link);
    [street, begun] = py.list(_onALine(_along(this, link, false, "route.street").route));
    return [joined(street, route, this.radius), begun];
  }
}
class AfterStreet extends RouteTable {
  get once() {
    return (this.street == null);
  }
  get after_street() {
    return (this.street != null);
  }
  whole(plan) {
    let begun, route;
    [route, begun] = py.list(this.build(plan));
    if ((this.street == null)) {
      return [this.placed(route), begun];
    }
    return this.street.before(this.placed(route), _longestLink(plan));
  }
  gated(edge, route, plan) {
    let behind, count, far, heading, poses, way, x, y;
    if ((this.street == null)) {
      return edge;
    }
    count = py.ceil((route.length / FINE));
    poses = py.empty([(count + 1), 4]);
    py.entry("bd_route_evaluate", route.rows, py.array(py.list(py.range((count + 1))).map((n) => ((route.length * n) / count))), poses);
    [[x, y], heading] = py.list(route.start_pose);
    far = _extent(plan);
    behind = [py.sub(x, (far * py.cos(heading))), py.sub(y, (far * py.sin(heading)))];
    way = [behind, ...py.iter(py.list(py.tolist(poses)).map(([u, v, _heading, _bend]) => [u, v]))];
    return edge.gated(way, this.street.width);
  }
}
export class SpiralInRoute extends AfterStreet {
  build(plan) {
    let end, k, start, text;
    k = (this.pitch / (2.0 * Math.PI));
    end = ((plan.disc.radius != null) ? (plan.disc.radius / k) : 0.0);
    start = ((2.0 * Math.PI) * this.start_turn);
    if ((end >= start)) {
      text = _("disc.radius ({disc} m) must be smaller than the radius of start_turn ({start} m)");
      throw _at("disc.radius", py.filled(text, { disc: `${py.format(plan.disc.radius, `g`)}`, start: `${py.format((start * k), `g`)}` }));
    }
    return [new Route([new Spiral(this.pitch, start, end, undefined, undefined, !py.truth(this.clockwise))]), 0.0];
  }
}
export class TurnRoute extends AfterStreet {
  get once() {
    return ((this.street == null) && (this.rounds === 1));
  }
  build(plan) {
    let back, outer, route, trail, turn;
    [turn, trail] = py.list([this.turn(plan), py.add(_extent(plan), TRAIL)]);
    if (py.truth(this.once)) {
      route = turn.route(undefined, trail);
    }
    else {
      [outer, back] = py.list([this._outer(turn, plan), this._back(turn, plan)]);
      route = turn.rounds(this.rounds, outer, back, trail, (this.street != null));
    }
    return [route, py.float(py.at(route.joints, 1))];
  }
  _outer(turn, plan) {
    let least, square, text;
    if ((this.outer_radius == null)) {
      square = py.add((turn.exit_radius ** 2), ((_extent(plan) * this.pitch) / Math.PI));
      return (py.ceil((py.sqrt(square) / OUT_TO)) * OUT_TO);
    }
    least = py.max(turn.entry_radius, turn.exit_radius);
    if ((this.outer_radius <= least)) {
      text = _("route.outer_radius ({outer} m) must be larger than that of the turn, {least} m");
      throw _at("route.outer_radius", py.filled(text, { outer: `${py.format(this.outer_radius, `g`)}`, least: `${py.format(least, `g`)}` }));
    }
    return this.outer_radius;
  }
  _back(turn, plan) {
    if ((this.back_radius == null)) {
      return py.max(turn.least_radius, (0.25 * this.pitch));
    }
    refuseTight("route.back_radius", this.back_radius, _longestLink(plan));
    return this.back_radius;
  }
  turn(plan) {
    let disc, link, name, text, turn;
    disc = TurnRoute.disc(plan);
    try {
      turn = plan.turn.build(this.pitch, disc);
    } catch (error) {
      if (error instanceof InputError) {
        throw _at("turn", py.str(error));
      } else
      throw error;
    }
    for (name of py.iter(["entry_radius", "exit_radius"])) {
      if ((turn[name] > disc)) {
        text = _("turn.{name} ({radius} m) must not exceed disc.radius ({disc} m)");
        throw _at(`turn.${py.str(name)}`, py.filled(text, { name: name, radius: `${py.format(turn[name], `g`)}`, disc: `${py.format(disc, `g`)}` }));
      }
    }
    if ((turn.extent > py.add(disc, FITS))) {
      text = _("the turn reaches {reach} m from the centre, out of a disc of {disc} m");
      throw _at("turn", py.filled(text, { reach: `${py.format(turn.extent, `.4g`)}`, disc: `${py.format(disc, `g`)}` }));
    }
    link = _longestLink(plan);
    if (((2.0 * turn.least_radius) <= link)) {
      throw _at("turn", py.filled(_("a bench with {link} m between its handles cannot follow a bend of {radius} m radius: it must be wider than {least} m"), { link: `${py.format(link, `g`)}`, radius: `${py.format(turn.least_radius, `.4g`)}`, least: `${py.format((0.5 * link), `g`)}` }));
    }
    return turn;
  }
  static disc(plan) {
    return ((plan.disc.radius == null) ? 4.5 : plan.disc.radius);
  }
  last_position(walk) {
    return walk.head_where_tail(py.float(py.at(walk.route.joints, -2)));
  }
}
export class PartsRoute extends AfterStreet {
  build(_plan) {
    let curves, faults, heading, point, tried;
    faults = new Faults();
    tried = py.list(py.enumerate(this.part)).map(([i, part]) => faults.tried(`route.part.${py.str(i)}`, ((of) => () => of.build())(part)));
    curves = py.list(tried).flatMap((curve) => (((curve != null)) ? [curve] : []));
    if (py.truth(faults.found)) {
      throw new KeyedError(faults.found);
    }
    if (((this.start != null) || (this.heading != null))) {
      [point, heading] = py.list(py.at(curves, 0).start_pose);
      if ((this.heading != null)) {
        heading = py.radians(this.heading);
      }
      py.set(curves, 0, py.at(curves, 0).moved(py.or(this.start, () => point), heading));
    }
    return [Route.joined(curves), 0.0];
  }
}
export class FormationRoute extends AfterStreet {
  build(plan) {
    let route;
    route = formationOf(this, "route", _longestLink(plan)).build();
    return [route, _wholeDragonOn(route, plan)];
  }
  links_below() {
    return linksBelow(this);
  }
}
export class ProgrammeRoute extends AfterStreet {
  build(plan) {
    let faults, keys, link, route, tried;
    [faults, link] = py.list([new Faults(), _longestLink(plan)]);
    faults.tried("route.radius", ((given0, given1, given2) => () => refuseTight(given0, given1, given2))("route.radius", this.radius, link));
    keys = py.list(py.range(py.len(this.formation))).map((i) => `route.formation.${py.str(i)}`);
    tried = py.list(py.zip(keys, this.formation)).map(([key, one]) => faults.tried(key, ((of, given0, given1) => () => of.step(given0, given1))(one, key, link)));
    if (py.truth(faults.found)) {
      throw new KeyedError(faults.found);
    }
    route = programme(py.list(tried).flatMap((step) => (((step != null)) ? [step] : [])), this.radius);
    return [route, _wholeDragonOn(route, plan)];
  }
  links_below() {
    return py.min([(2.0 * this.radius), ...py.iter(py.list(this.formation).map((one) => linksBelow(one)))]);
  }
}
export class DrawnRoute extends RouteTable {
  build(plan) {
    let around, laps, route;
    route = this.fit(_longestLink(plan)).route;
    if (!py.truth(this.closed)) {
      return _onALine(route);
    }
    laps = py.ceil((_extent(plan) / route.length));
    if ((((laps + 1) * py.len(route.curves)) > MOST_CURVES)) {
      throw _at("route", py.filled(_("the dragon goes round the drawing {laps} times, with {count} bends a round: too many; draw it larger, or allow a larger deviation"), { laps: laps, count: py.len(route.curves) }));
    }
    around = py.tuple(py.list(py.range((laps + 1))).flatMap((_lap) => py.list(route.curves).map((curve) => curve)));
    return [new Route(around), (laps * route.length)];
  }
  fit(link) {
    return _along(this, link, this.closed, "route");
  }
}
function _wholeDragonOn(route, plan) {
  if (((plan.walk.position != null) || (plan.chain == null))) {
    return 0.0;
  }
  return wholeDragonOn(route, plan.chain);
}
