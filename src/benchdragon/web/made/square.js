// @ts-nocheck
// Made from plans/square.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { Obstacle, rectangleOutline } from "./obstacle.js";
import { Fault, Faults, KeyedError } from "./source.js";

export class VenueTable {
  build(margin) {
    let angle, name, outline;
    name = py.or(this.name, () => "venue");
    if ((this.boundary != null)) {
      return Obstacle.venue(name, this.boundary, margin);
    }
    if ((this.rectangle == null)) {
      return null;
    }
    angle = py.radians(py.or(this.angle, () => 0.0));
    outline = rectangleOutline(name, py.or(this.centre, () => [0.0, 0.0]), this.rectangle, angle);
    return Obstacle.venue(name, outline, margin);
  }
}
class ObstacleTable {
  
}
export class CircleTable extends ObstacleTable {
  build(name, margin) {
    return Obstacle.circle(name, this.centre, this.radius, margin);
  }
}
export class RectangleTable extends ObstacleTable {
  build(name, margin) {
    return Obstacle.rectangle(name, this.centre, this.size, py.radians(this.angle), margin);
  }
}
export class PolygonTable extends ObstacleTable {
  build(name, margin) {
    return Obstacle.polygon(name, this.points, margin);
  }
}
export class LineTable extends ObstacleTable {
  build(name, margin) {
    return Obstacle.line(name, this.points, margin);
  }
}
export function builtObstacles(venue, tables, limits) {
  let edge, faults, found, kept, margin, n, name, one, table, taken, text;
  faults = new Faults();
  found = [];
  taken = py.dict([]);
  margin = ((limits.venue_margin == null) ? limits.margin : limits.venue_margin);
  edge = faults.tried("venue", () => venue.build(margin));
  if ((edge != null)) {
    py.append(found, edge);
    py.set(taken, edge.name, "venue");
  }
  for ([n, table] of py.iter(py.enumerate(tables))) {
    name = py.or(table.name, () => `obstacle ${py.str((n + 1))}`);
    if (py.has(taken, name)) {
      text = _("two things are called {name}: {first} and {second}");
      text = py.filled(text, { name: name, first: py.at(taken, name), second: `obstacle.${py.str(n)}` });
      py.append(faults.found, new Fault(`obstacle.${py.str(n)}.name`, text));
    }
    py.setdefault(taken, name, `obstacle.${py.str(n)}`);
    kept = ((table.margin == null) ? limits.margin : table.margin);
    one = faults.tried(`obstacle.${py.str(n)}`, ((of, given0, given1) => () => of.build(given0, given1))(table, name, kept));
    found = py.extend(found, ((one == null) ? [] : [one]));
  }
  if (py.truth(faults.found)) {
    throw new KeyedError(faults.found);
  }
  return py.tuple(found);
}
