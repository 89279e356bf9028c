// @ts-nocheck
// Made from model/connections.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { Route, curvesOf } from "./curves.js";
import { positive } from "./errors.js";

export class Step {
  constructor(formation, at = /** @type {any} */ (null), turned = 0.0) {
    this.formation = formation;
    this.at = at;
    this.turned = turned;
    this.__post_init__();
  }
  __post_init__() {
    if (((this.at == null) && (this.turned !== 0.0))) {
      throw new InputError(_("turned has no effect without at: this formation begins as the one before it ends"));
    }
  }
}
export function programme(steps, radius) {
  let given, out, parts, table;
  positive("radius", radius, "m");
  if (!py.truth(steps)) {
    throw new InputError(_("a programme needs at least one formation"));
  }
  parts = py.list(steps).map((step) => step.formation.build().parts);
  table = py.array(py.list(py.enumerate(py.zip(parts, steps))).map(([n, [own, step]]) => [py.len(own), ...py.iter(((py.truth(n) && (step.at == null)) ? [NaN, 0.0] : py.or(step.at, () => [0.0, 0.0]))), step.turned]));
  given = py.concatenate(parts);
  out = py.empty([py.add(py.len(given), (3 * py.len(steps))), 8]);
  return new Route(curvesOf(py.slice(out, null, py.entry("bd_connections_programme", given, table, radius, out)[0])));
}
