// @ts-nocheck
// Made from model/dragon.py by tools/make_twins.py; to make it again: make generate

import { InputError, brief } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { notNegative, positive } from "./errors.js";

const LONGEST_BENCH = 10000.0;
const MOST_BENCHES = 1000000;
const _SIZES = ["length", "width", "front_inset", "rear_inset"];
export function faultOf(i, sizes) {
  let _width, check, front, label, length, name, rear, text, value;
  for ([name, value] of py.iter(py.zip(_SIZES, sizes))) {
    check = (py.has(["length", "width"], name) ? positive : notNegative);
    label = py.filled(_("bench {number}: {size}"), { number: (i + 1), size: name });
    try {
      check(label, value, "m");
    } catch (error) {
      if (error instanceof InputError) {
        return [i, name, py.str(error)];
      } else
      throw error;
    }
    if ((value > LONGEST_BENCH)) {
      text = _("{name} must be at most {most} m, not {value} m");
      return [i, name, py.filled(text, { name: label, most: `${py.format(LONGEST_BENCH, `g`)}`, value: `${py.format(value, `g`)}` })];
    }
  }
  [length, _width, front, rear] = py.list(py.list(sizes).map((value) => `${py.format(value, `g`)}`));
  text = _("bench {number}: its insets ({front} m and {rear} m) leave no link in a length of {length} m");
  return [i, "length", py.filled(text, { number: (i + 1), front: front, rear: rear, length: length })];
}
export function countText(count) {
  let text;
  text = _("a dragon has 1 to {most} benches, not {count}");
  return py.filled(text, { most: MOST_BENCHES, count: brief(count) });
}
