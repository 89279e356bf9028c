// @ts-nocheck
// Made from analysis/tables.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";

const MOST_SIZES = 2000;
const MOST_CELLS = 2000000;
const PLACES = 1000000;
const A_CELL = 64;
const AT_FIRST = 1000000;
const PAIRS = 1000;
const MEMBERS = 256;
const DOUBTS = 64;
export function inColumns(told) {
  return py.array(py.list(py.range(py.len(told))).map((n) => py.at(told, n)), "d");
}
export function beginnings() {
  let named;
  named = py.dict([[0, A_CELL], [1, AT_FIRST], [2, PAIRS], [3, MEMBERS], [4, DOUBTS], [5, MOST_CELLS], [6, PLACES]]);
  return py.array(py.list(py.range(7)).map((n) => py.at(named, n)), "q");
}
export function tooManyKinds(sizes) {
  let text;
  text = _("contacts can be searched for at most {most} different sizes, not {count}");
  return new InputError(py.filled(text, { most: MOST_SIZES, count: py.len(py.set_of([...py.iter(py.zip(...py.iter(py.tolist(sizes))))])) }));
}
export function kindsOf(sizes) {
  let benches, count, found, group, kind, most;
  benches = py.at(sizes.shape, 1);
  most = py.min(MOST_SIZES, benches);
  [found, kind] = py.list([py.empty([4, most]), py.empty(benches, "q")]);
  group = py.empty(most, "q");
  count = py.entry("bd_kinds_find_kinds", sizes, found, kind, group)[0];
  if ((count > most)) {
    throw tooManyKinds(sizes);
  }
  return [kind, ({ sizes: py.array(py.list(py.tolist(found)).map((row) => py.slice(row, null, count))), group: py.slice(group, null, count) })];
}
export function walkTables(walk) {
  let ahead, benches, dragon, kind, kinds, link;
  dragon = walk.dragon;
  [kind, kinds] = py.list(kindsOf(dragon.sizes));
  ahead = [0.0];
  for (link of py.iter(py.slice(py.tolist(dragon.links), null, -1))) {
    py.append(ahead, py.add(py.at(ahead, -1), link));
  }
  benches = ({ links: dragon.links, sizes: dragon.sizes, kind: kind, ahead: py.array(ahead), lever: py.array([dragon.lever]) });
  return ({ rows: walk.route.rows, benches: benches, kinds: kinds });
}
