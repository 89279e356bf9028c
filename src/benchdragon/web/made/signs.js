// @ts-nocheck
// Made from plans/signs.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";

export const TIME_OF_DAY = py.pattern("([01]?[0-9]|2[0-3]):([0-5][0-9])(?::([0-5][0-9]))?", "");
export function narrow(text) {
  return py.join("", py.list(text).map((sign) => py.or(_narrow(sign), () => ((sign === "　") ? " " : sign))));
}
function _narrow(sign) {
  return ((("！" <= sign) && (sign <= "～")) ? py.normalize("NFKC", sign) : "");
}
