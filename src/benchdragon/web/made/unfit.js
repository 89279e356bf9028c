// @ts-nocheck
// Made from surveys/clothoids.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";

const FitStatus = { OK: 0, ONE_PLACE: 1, DOUBLES_BACK: 2, NO_ROOM: 3, HAIRPIN: 4 };
export function unfit(status, n) {
  let text;
  text = py.at(py.dict([[FitStatus.ONE_PLACE, N_("points {first} and {second} are in one place")], [FitStatus.DOUBLES_BACK, N_("no gentle curve leads from point {first} to point {second}: the line doubles back there")]]), status);
  return new InputError(py.filled(_(text), { first: (n + 1), second: (n + 2) }));
}
