// @ts-nocheck
// Made from plans/units.py by tools/make_twins.py; to make it again: make generate

import { ValueError, py } from "../compute/python.js";
import { _vast } from "../compute/python_text.js";
import { _ } from "../words.js";
import { measured } from "./digits.js";
import { narrow } from "./signs.js";

const MOST_SIGNS = 100;
const QUANTITY = py.pattern("([-+]?[0-9.]+(?:e[-+]?\\p{Nd}+)?)[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]*([^\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000\\p{Nd}.+^-]+(?:\\^\\p{Nd})?)", "i");
export function quantity(text, units) {
  let pieces, plain, said, signs, size, wrong;
  if ((py.is(text, "bool"))) {
    throw new ValueError(py.filled(_("expected a number, not {text}"), { text: py.lower(py.str(text)) }));
  }
  if (py.truth(_vast(text))) {
    throw new ValueError(_("expected a number with fewer digits"));
  }
  if ((!(py.is(text, "str")) || (py.len(units) === 0))) {
    return text;
  }
  if ((py.len(text) > MOST_SIGNS)) {
    said = _("expected a number, or text with a unit, in at most {most} signs, not {count}");
    throw new ValueError(py.filled(said, { most: MOST_SIGNS, count: py.len(text) }));
  }
  plain = narrow(text);
  pieces = (py.truth(py.strip(QUANTITY.sub("", plain))) ? [] : QUANTITY.findall(plain));
  signs = py.list(pieces).map(([number, _unit]) => py.at(number, 0));
  wrong = new ValueError(py.filled(_("expected a number, or text with a unit of {units}, not {text}"), { units: py.join(", ", units), text: py.repr(text) }));
  if ((!py.truth(pieces) || py.list(py.slice(signs, 1, null)).some((sign) => py.has("+-", sign)) || py.list(pieces).some(([_n, u]) => !py.has(units, u)))) {
    throw wrong;
  }
  try {
    size = py.sum(py.list(pieces).map(([number, unit]) => measured(number, py.at(units, unit))));
  } catch (error) {
    if (error instanceof ValueError) {
      throw wrong;
    } else
    throw error;
  }
  return ((py.at(signs, 0) === "-") ? -size : size);
}
