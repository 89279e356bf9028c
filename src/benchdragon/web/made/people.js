// @ts-nocheck
// Made from plans/people.py by tools/make_twins.py; to make it again: make generate

import { brief } from "../compute/error_kinds.js";
import { ValueError, py } from "../compute/python.js";
import { N_, _, both } from "../words.js";
import { oneLine } from "./tables.js";

const UNITS = py.dict([["bench", N_("bench {n}")], ["qiao", N_("qiao {n}")], ["jie", N_("jie {n}")]]);
const ADDRESS = py.pattern("[Hh][Tt][Tt][Pp][Ss]?://[^ /?#@:\\\\][^ /?#@\\\\]*(?:[/?#][^ \\\\]*)?|[^ \\\\/:?#][^ \\\\:?#]*(?:[?#][^ \\\\]*)?", "");
export function webAddress(text) {
  let said;
  if ((py.truth(oneLine(text)) && !py.truth(ADDRESS.fullmatch(text)))) {
    said = _("expected a web address (http:// or https://) or a relative file name, without spaces, not {text}");
    throw new ValueError(py.filled(said, { text: brief(text) }));
  }
  return text;
}
class Village {
  constructor(head, between, tail, before) {
    this.head = head;
    this.between = between;
    this.tail = tail;
    this.before = before;
  }
}
export const DECIDING = ["beside", "ahead", "sway", "imprecision", "most_speed"];
export function called(people, bench, count) {
  if ((!py.truth(people.count_head) && (bench === 1))) {
    return _("the head");
  }
  if ((!py.truth(people.count_head) && py.eq(bench, count))) {
    return _("the tail");
  }
  return py.filled(_(py.at(UNITS, people.unit)), { n: (py.truth(people.count_head) ? bench : (bench - 1)) });
}
export function village(people, count) {
  if (((people.unit === "bench") && py.truth(people.count_head))) {
    return null;
  }
  return new Village(both(() => called(people, 1, count)), both(() => _(py.at(UNITS, people.unit))), both(() => called(people, count, count)), (py.truth(people.count_head) ? 0 : 1));
}
