// Whether a dance in and out again ends too soon: before its tail has left the turn. Twin of
// analysis/unfinished.py.

import { _ } from "../words.js";
import { ANALYSIS_UNFINISHED } from "./constants.js";
import { decimals } from "./number_format.js";
import { lastPosition } from "./plan_routes.js";

/** The way that the head still has to walk until the tail is out, m, and the end of the walk with which it is, s, in tenths; null where the head never comes so far. @typedef {{ way: number, end: number | null }} Unfinished */

const { NEARLY, TENTHS, DUST } = ANALYSIS_UNFINISHED;

/**
 * What a plan's walk in and out again lacks when it ends at a time, s; null where it lacks nothing.
 * @param {{ tables: Record<string, any> }} plan
 * @param {import("./walk.js").Walk} walk
 * @param {number} end
 * @returns {Unfinished | null}
 */
export function unfinished({ tables }, walk, end) {
  if (tables.route.kind !== "turn") return null;
  const last = lastPosition(tables, walk);
  const way = last - walk.headPosition(end);
  if (way <= NEARLY) return null;
  const time = walk.timeAt(last);
  const enough = last < walk.route.length && Number.isFinite(time);
  return { way, end: enough ? Math.ceil(TENTHS * time - DUST) / TENTHS : null };
}

/** The same in words, in the language in use. @param {Unfinished} found */
export function unfinishedText({ way, end }) {
  if (end === null)
    return _("the dance ends before the tail is out of the turn: the head lacks {way} m", {
      way: decimals(way, 1),
    });
  return _("the dance ends before the tail is out of the turn: let the walk end at {end} s or later", {
    end: decimals(end, 1),
  });
}
