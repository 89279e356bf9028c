// @ts-nocheck
// Made from plans/formations.py by tools/make_twins.py; to make it again: make generate

import { emptyPlacements } from "../compute/arrays.js";
import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { Step } from "./connections.js";
import { FORMATIONS, SizeError } from "./formations.js";
import { Fault, KeyedError } from "./source.js";

const Status = { OK: 0, BEFORE_ROUTE: 1, AFTER_ROUTE: 2, ROUTE_TOO_SHORT: 3, FOLDED: 4, LINK_OVER_DIAMETER: 5 };
const END_SLACK = 1e-09;
export class FormationTable {
  
}
export function formationOf(table, key, link) {
  let made;
  try {
    made = py.at(FORMATIONS, table.name).of(py.vars(table));
  } catch (error) {
    if (error instanceof SizeError) {
      throw new KeyedError([new Fault(`${py.str(key)}.${py.str(error.size)}`, py.str(error))]);
    } else
    throw error;
  }
  if (py.truth(made.narrowest)) {
    refuseTight(`${py.str(key)}.${py.str(made.narrowest)}`, made.least_radius, link);
  }
  return made;
}
export function linksBelow(table) {
  let made;
  made = formationOf(table, "route", 0.0);
  return (py.truth(made.narrowest) ? (2.0 * made.least_radius) : Infinity);
}
export function refuseTight(key, radius, link) {
  let text;
  if (((2.0 * radius) <= link)) {
    text = _("{key}: a bench with {link} m between its handles cannot follow a bend of {radius} m radius: it must be wider than {least} m, so make {key} larger");
    throw new KeyedError([new Fault(key, py.filled(text, { key: key, link: `${py.format(link, `g`)}`, radius: `${py.format(radius, `.4g`)}`, least: `${py.format((0.5 * link), `g`)}` }))]);
  }
}
export function wholeDragonOn(route, dragon) {
  let head, places, status, tail, text;
  places = emptyPlacements((py.len(dragon.links) + 1), 1);
  [head, tail, status] = py.list(py.entry("bd_local_minima_whole_dragon", route.rows, dragon.links, py.empty(1), places));
  if ((py.eq(status, Status.ROUTE_TOO_SHORT) || (tail < -END_SLACK))) {
    text = py.filled(_("the dragon, {dragon} m long, does not fit on a route of {route} m, at whose start its tail stands at time 0: make the sizes larger, take fewer benches, or set walk.position"), { dragon: `${py.format(dragon.extent, `.6g`)}`, route: `${py.format(route.length, `.6g`)}` });
    throw new KeyedError([new Fault("route", text)]);
  }
  return head;
}
export class StepTable extends FormationTable {
  step(key, link) {
    let made;
    made = formationOf(this, key, link);
    try {
      return new Step(made, this.at, py.radians(this.turned));
    } catch (error) {
      if (error instanceof InputError) {
        throw new KeyedError([new Fault(`${py.str(key)}.turned`, py.str(error))]);
      } else
      throw error;
    }
  }
}
