// @ts-nocheck
// Made from plans/tables.py by tools/make_twins.py; to make it again: make types

import { brief } from "../compute/errors.js";
import { ValueError, py } from "../compute/python.js";
import { _ } from "../words.js";

export function oneLine(text) {
  if ((py.truth(text) && (py.isspace(text) || !py.isprintable(text)))) {
    throw new ValueError(py.filled(_("wanted text that can be printed on one line, not {text}"), { text: brief(text) }));
  }
  return text;
}
