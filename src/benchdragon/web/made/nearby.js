// @ts-nocheck
// Made from analysis/nearby.py by tools/make_twins.py; to make it again: make generate

import { UnsureError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { atMost } from "./number_format.js";

const MOST_OFF = 2.5e-08;
const SEAM_COLUMNS = 2;
const NOWHERE = [0.0, 0.0];
export function seenFrom(walk, origin) {
  return (py.eq(origin, NOWHERE) ? walk : py.replaced(walk, { route: walk.route.seen_from(origin) }));
}
export function seamsOf(rows) {
  let seams;
  seams = py.empty([py.len(rows), SEAM_COLUMNS]);
  py.entry("bd_rounding_find_seams", rows, seams);
  return seams;
}
export function checkedOff(off) {
  let text;
  if ((off > MOST_OFF)) {
    text = _("rounding may hide {off} m of distances; a search allows for {most} m");
    throw new UnsureError(py.filled(text, { off: atMost(off), most: atMost(MOST_OFF) }));
  }
  return off;
}
