// A route along points that were drawn: what of surveys/fitting.py and lines.py pages need to say.

import { checkFewest, checkedFit, rounded } from "../made/fits.js";
import { _ } from "../words.js";
import { arena } from "./arena.js";
import { SURVEYS_LINES } from "./constants.js";
import { Fault, KeyedError } from "./errors.js";

/** @typedef {[number, number]} Point */

/** Points, those that repeat the one before left out. @param {Point[]} points @param {boolean} closed */
function withoutRepeats(points, closed) {
  const apart = (/** @type {Point} */ a, /** @type {Point} */ b) =>
    Math.hypot(a[0] - b[0], a[1] - b[1]) > SURVEYS_LINES.SAME;
  const kept = points.filter((point, n) => n === points.length - 1 || apart(points[n + 1], point));
  while (closed && kept.length > 1 && !apart(kept[0], kept[kept.length - 1])) kept.pop();
  return kept;
}

/**
 * The route along a drawing of points: see `fitted` in surveys/fitting.py.
 * @param {{ points: Point[], pieces: unknown[], closed: boolean, within: number }} drawn
 * @param {string} smooth
 * @param {number} deviation m
 * @param {number} leastRadius m
 */
export function _fitted({ points, pieces, closed, within }, smooth, deviation, leastRadius) {
  if (pieces.length)
    throw new KeyedError([
      new Fault(
        "route",
        _(
          "this page does not compute routes of surveyed pieces: the command line does, by benchdragon check",
        ),
      ),
    ]);
  const kept = withoutRepeats(points, closed);
  checkFewest(kept.length, closed);
  const fit = rounded(arena().table(kept, 2), within, closed, smooth, deviation);
  return checkedFit(fit, deviation, leastRadius);
}
