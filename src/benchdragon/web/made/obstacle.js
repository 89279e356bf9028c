// @ts-nocheck
// Made from model/obstacle.py by tools/make_twins.py; to make it again: make generate

import { InputError, brief } from "../compute/error_kinds.js";
import { Standing, _crossing } from "../compute/obstacle.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { checkedSize } from "./base_curve.js";
import { finite, notNegative } from "./errors.js";
import { gateIn, lengthOf, ringOf, stretch } from "./rings.js";

const asNumbers = (_name, values) => values;
const MOST_METRES = 100000000.0;
const asTable = (rows) => rows;
const MOST_CORNERS = 5000;
const LEAST_SIDE = 1e-06;
export class Obstacle extends Standing {
  constructor(name, kind, outline, radius = 0.0, margin = 0.0, open = /** @type {any} */ (null)) {
    super();
    this.name = name;
    this.kind = kind;
    this.outline = outline;
    this.radius = radius;
    this.margin = margin;
    this.open = open;
    this.__post_init__();
  }
  __post_init__() {
    notNegative("margin", this.margin, "m");
    this["outline"] = asNumbers(`${py.str(this.name)}: outline`, this.outline);
  }
  static circle(name, centre, radius, margin = 0.0) {
    return new this(name, "circle", _points(name, [centre], 1), checkedSize("radius", radius), margin);
  }
  static rectangle(name, centre, size, angle = 0.0, margin = 0.0) {
    return new this(name, "rectangle", rectangleOutline(name, centre, size, angle), 0.0, margin);
  }
  static polygon(name, points, margin = 0.0) {
    return new this(name, "polygon", closedOutline(name, points), 0.0, margin);
  }
  static line(name, points, margin = 0.0) {
    return new this(name, "line", _points(name, points, 2), 0.0, margin);
  }
  static venue(name, points, margin = 0.0) {
    return new this(name, "venue", closedOutline(name, points), 0.0, margin);
  }
  moved(turned, by) {
    let left, outline, walls;
    [outline, walls] = py.list([_turned(this.outline, turned, by), _turned(this.walls, turned, by)]);
    left = ((this.open == null) ? null : walls);
    return new Obstacle(this.name, this.kind, outline, this.radius, this.margin, left);
  }
  gated(way, width) {
    let chain, gate, ring;
    ring = ringOf(py.tolist(this.outline));
    gate = gateIn(ring, way, width);
    if ((gate == null)) {
      return this;
    }
    chain = asTable(stretch(ring, py.at(gate, 1), py.add(py.at(gate, 0), lengthOf(ring))));
    return new Obstacle(this.name, this.kind, this.outline, this.radius, this.margin, chain);
  }
}
function _turned(points, turned, by) {
  let c, s, turns;
  [c, s] = py.list([py.cos(turned), py.sin(turned)]);
  turns = py.list(py.tolist(points)).map(([x, y]) => [py.sub((c * x), (s * y)), py.add((s * x), (c * y))]);
  return asTable(py.list(turns).map(([x, y]) => [py.add(x, py.at(by, 0)), py.add(y, py.at(by, 1))]));
}
export function rectangleOutline(name, centre, size, angle) {
  let a, b, c, corners, ends, middle, s, sides, turned;
  [[sides], [middle]] = py.list([py.tolist(_points(`${py.str(name)}: size`, [size], 1)), py.tolist(_points(name, [centre], 1))]);
  [a, b] = py.list(py.list(sides).map((side) => (0.5 * checkedSize(`${py.str(name)}: size`, side))));
  turned = finite(`${py.str(name)}: angle`, angle);
  [c, s] = py.list([py.cos(turned), py.sin(turned)]);
  corners = [[a, b], [-a, b], [-a, -b], [a, -b]];
  ends = py.list(corners).map(([x, y]) => [py.sub(py.add(py.at(middle, 0), (x * c)), (y * s)), py.add(py.add(py.at(middle, 1), (x * s)), (y * c))]);
  return _points(name, ends, 4, true);
}
function closedOutline(name, points) {
  let area, corners, crossing, i, j, ring, text, ways;
  corners = _points(name, points, 3, true);
  crossing = _crossing(corners);
  if ((crossing != null)) {
    [i, j] = py.list(crossing);
    text = _("{name}: its sides {i} and {j} cross or touch: an outline must not meet itself");
    throw new InputError(py.filled(text, { name: name, i: (i + 1), j: (j + 1) }));
  }
  ring = py.tolist(corners);
  ways = py.zip(ring, [...py.iter(py.slice(ring, 1, null)), py.at(ring, 0)]);
  area = (0.5 * py.abs(py.sum(py.list(ways).map(([[x, y], [toX, toY]]) => py.sub((x * py.sub(toY, y)), (y * py.sub(toX, x)))))));
  if ((area < (LEAST_SIDE * LEAST_SIDE))) {
    throw new InputError(py.filled(_("{name}: it has no area"), { name: name }));
  }
  return corners;
}
function _points(name, points, least, closed = false) {
  let ahead, i, one, other, table, text;
  table = py.tolist(asNumbers(`${py.str(name)}: points`, _drawnPoints(name, points)));
  if (!py.eq(py.slice(py.shape(table), 1, null), [2])) {
    text = _("{name}: expected a list of points [x, y], not {value}");
    throw new InputError(py.filled(text, { name: name, value: brief(points) }));
  }
  if (!py.list(table).every((point) => py.list(point).every((value) => (py.abs(value) <= MOST_METRES)))) {
    throw new InputError(py.filled(_("{name}: points must lie within 1e8 m of the origin"), { name: name }));
  }
  if ((py.truth(closed) && (py.len(table) > 1) && py.eq(py.at(table, 0), py.at(table, -1)))) {
    table = py.slice(table, null, -1);
  }
  if (!((least <= py.len(table)) && (py.len(table) <= MOST_CORNERS))) {
    text = _("{name}: expected {least} to {most} points, not {count}");
    throw new InputError(py.filled(text, { name: name, least: least, most: MOST_CORNERS, count: py.len(table) }));
  }
  ahead = (py.truth(closed) ? [...py.iter(py.slice(table, 1, null)), py.at(table, 0)] : py.slice(table, 1, null));
  for ([i, [one, other]] of py.iter(py.enumerate(py.zip(table, ahead), 1))) {
    if ((py.dist(one, other) < LEAST_SIDE)) {
      text = _("{name}: points {i} and {j} are the same");
      throw new InputError(py.filled(text, { name: name, i: i, j: (py.mod(i, py.len(table)) + 1) }));
    }
  }
  return asTable(table);
}
const _drawnPoints = (_name, points) => points;
