// Marks on the ground along a route, and between which of them a front handle starts: the host of
// kernels/marks.py, as analysis/marks.py is, as far as sheets of benches need it.

import { _ } from "../words.js";
import { doubles, withArena } from "./arena.js";
import { ANALYSIS_MARKS, MARKS } from "./constants.js";
import { InputError } from "./errors.js";
import { decimals, general } from "./number_format.js";
import { rint } from "./numbers.js";
import { searchsorted } from "./arrays.js";

/** @typedef {import("../made/curves.js").Route} Route */

/** Where a front handle starts: so far, m, past mark number `n`, from 1, and before the next. @typedef {{ n: number, past: number }} MarkPlace */

const { AT_MARK, FARTHEST, MOST_MARKS } = ANALYSIS_MARKS;
// So finely, m, it is told how far a handle is past a mark.
const FINE = 0.01;

/** Marks so far apart, or as usual: 1 m, or as many decimetres more as MOST_MARKS want. */
export class Marks {
  /** @param {Route} route @param {number} low where the tail's last handle stands at first, m @param {number} start where the head's first stands then, m @param {number} high where that comes to, m @param {number | null} said how far apart they are to be, m */
  constructor(route, low, start, high, said) {
    const least = Math.ceil((10 * (high - low)) / MOST_MARKS) / 10;
    const every = said ?? Math.max(1, least);
    refuseMany(every, high - low, least);
    /** Along the route, m. */
    this.s = withArena(route.engine, (arena) => {
      const count = route.rows.shape[0];
      const room = Math.ceil((high - low) / every) + count + 4;
      const [lags, s] = [arena.array("d", 2 * count), arena.array("d", room)];
      const kinds = arena.array("q", room);
      const [laid] = route.engine.call("bd_marks_lay_marks", route.rows, low, start, high, every, lags, s, kinds); // prettier-ignore
      return [...doubles(s).subarray(0, laid)];
    });
    /** What most marks are apart, m. */
    this.usual = median(this.s.slice(1).map((s, n) => s - this.s[n]));
  }

  /**
   * Between which marks a front handle starts, m along the route. Null where the marks about it are not its
   * neighbours on the ground: where a closed line is walked again, it has those of the first round.
   * @param {number} s
   * @returns {MarkPlace | null}
   */
  place(s) {
    const last = this.s.length - 1;
    const n = Math.min(Math.max(searchsorted(this.s, s + MARKS.SAME_MARK, "right") - 1, 0), last);
    const past = rint((s - this.s[n]) / FINE) * FINE;
    if (Math.abs(past) < AT_MARK) return { n: n + 1, past: 0 };
    const gap = n < last ? this.s[n + 1] - this.s[n] : 0;
    if (n < last && this.s[n + 1] - s < AT_MARK) return { n: n + 2, past: 0 };
    return past < 0 || gap > FARTHEST * this.usual ? null : { n: n + 1, past };
  }
}

/** Refuse marks that are too many: as many m apart, on so much of the route, m; and what they want at least. @param {number} every @param {number} length @param {number} needed */
function refuseMany(every, length, needed) {
  if (length / every <= MOST_MARKS) return;
  throw new InputError(
    _(
      "marks each {every} m on {length} m of route are more than {most}: ask for at least {needed} m between them",
      { every: general(every), length: decimals(length, 1), most: MOST_MARKS, needed: general(needed) },
    ),
  );
}

/** @param {number[]} values */
function median(values) {
  const sorted = Float64Array.from(values).sort();
  const half = sorted.length >> 1;
  return sorted.length % 2 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}
