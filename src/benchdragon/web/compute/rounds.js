// Where a walk only repeats itself, so that no search need look there again: see kernels/rounds.py. Twin of
// analysis/rounds.py.

import { doubles, withArena } from "./arena.js";
import { ROUNDING, ROUNDS, SPANS } from "./constants.js";
import { firstRows } from "./lists.js";
import { seamsOf } from "./nearby.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {[number, number]} Span of route positions, m */

/** What repeats of a route, with seams where it leads back. @param {Arena} arena @param {Numbers} rows @param {Numbers} seams @param {number} reach */
function found(arena, rows, seams, reach) {
  const known = arena.array("d", 4 * rows.shape[0] + ROUNDS.ROOM, SPANS.REPEAT);
  const [count] = arena.engine.call("bd_rounds_find_repeats", rows, seams, reach, known);
  return firstRows(known, count);
}

/** Where a route of these rows leads back to where it was, for what reaches so far from it, m. @param {Arena} arena @param {Numbers} rows @param {number} reach */
export function returns(arena, rows, reach) {
  return found(arena, rows, seamsOf(arena, rows), reach);
}

/**
 * The spans of the head's way from first to last, m, that repeat nothing before them there.
 * @param {Walk} walk @param {number} first @param {number} last
 * @returns {Span[]}
 */
export function newSpans({ engine, route, dragon }, first, last) {
  return withArena(engine, (arena) => {
    const none = arena.array("d", 0, ROUNDING.SEAM_COLUMNS);
    const known = found(arena, route.rows, none, 0);
    const spans = arena.array("d", known.shape[0] + 1, 2);
    const [count] = engine.call(
      "bd_rounds_spans_left", route.rows, dragon.links, known, first, last, arena.array("d", 1),
      arena.placements(dragon.benches + 1, 1), spans,
    ); // prettier-ignore
    const view = doubles(spans);
    return Array.from({ length: count }, (_span, n) => [view[2 * n], view[2 * n + 1]]);
  });
}
