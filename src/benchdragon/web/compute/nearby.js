// Searches near the dance, whatever its coordinates, and what rounding leaves unsure there: the twin of
// analysis/nearby.py.

import { atMost } from "../made/number_format.js";
import { _ } from "../words.js";
import { doubles } from "./arena.js";
import { within } from "./arrays.js";
import { ANALYSIS_NEARBY, REGIONS, ROUNDING } from "./constants.js";
import { UnsureError } from "./errors.js";
import { rint } from "./numbers.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./walk.js").Placement} Placement */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {[number, number]} Point m */

const { FAR, SPREADS } = ANALYSIS_NEARBY;
const { MOST_OFF } = REGIONS;

/** @type {Point} */
const NOWHERE = [0, 0];

/** Whether a point is the origin. @param {Point} point */
function isNowhere([x, y]) {
  return x === NOWHERE[0] && y === NOWHERE[1];
}

/**
 * From where a dragon is searched, in whole metres: of its placements the first says it.
 * @param {Placement} placed
 * @returns {Point}
 */
export function originOf({ x, y, count }) {
  const [xs, ys] = [x, y].map((table) =>
    Array.from(doubles(table).filter((at, n) => n % count === 0 && Number.isFinite(at))),
  );
  if (!xs.length) return NOWHERE;
  const most = (/** @type {number[]} */ list) => list.reduce((a, b) => Math.max(a, b));
  const least = (/** @type {number[]} */ list) => list.reduce((a, b) => Math.min(a, b));
  const far = Math.max(most(xs), most(ys), -least(xs), -least(ys));
  const spread = Math.max(most(xs) - least(xs), most(ys) - least(ys));
  return far <= Math.max(FAR, SPREADS * spread) ? NOWHERE : [rint(xs[0]), rint(ys[0])];
}

/** The same walk with its coordinates counted from an origin, m. @param {Arena} arena @param {Walk} walk @param {Point} origin */
export function seenFrom(arena, walk, origin) {
  return isNowhere(origin) ? walk : walk.on(within(arena, () => walk.route.seen_from(origin)));
}

/** The seams of a route of these rows, (rows, SEAM_COLUMNS). @param {Arena} arena @param {Numbers} rows */
export function seamsOf(arena, rows) {
  const seams = arena.array("d", rows.shape[0], ROUNDING.SEAM_COLUMNS);
  arena.engine.call("bd_rounding_find_seams", rows, seams);
  return seams;
}

/** What distances may be off by, m; throws if that is too much for a search to see all pairs. @param {number} off */
export function checkedOff(off) {
  if (!(off > MOST_OFF)) return off;
  const values = { off: atMost(off), most: atMost(MOST_OFF) };
  throw new UnsureError(
    _("rounding may hide {off} m of distances; a search allows for {most} m", values),
  );
}
