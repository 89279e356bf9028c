// @ts-nocheck
// Made from plans/digits.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";

const POINTS = py.dict([[0.01, -2], [0.001, -3], [1000.0, 3]]);
export function measured(number, worth) {
  let _e, digits, power;
  if (!py.has(POINTS, worth)) {
    return (py.abs(py.float(number)) * worth);
  }
  [digits, _e, power] = py.list(py.partition(py.lower(number), "e"));
  return py.abs(py.float(`${py.str(digits)}e${py.str(py.add(py.int(py.or(power, () => 0)), py.at(POINTS, worth)))}`));
}
