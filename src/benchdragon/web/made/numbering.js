// @ts-nocheck
// Made from model/numbering.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { N_ } from "../words.js";

export function handleWords(handle, benches) {
  let numbers, where;
  where = N_("between benches {a} and {b}");
  if ((handle === 0)) {
    where = N_("front of bench 1");
  }
  else {
    if (py.eq(handle, benches)) {
      where = N_("rear of bench {bench}");
    }
  }
  numbers = py.dict([["a", handle], ["b", (handle + 1)], ["bench", benches], ["handle", handle]]);
  return py.dict([["where", where], ...py.items(py.dict(py.list(py.items(numbers)).map(([name, value]) => [name, py.str(value)])))]);
}
