// What every curve and every route can tell: twin of `Curve` in model/base_curve.py.

import { _ } from "../words.js";
import { doubles, withArena } from "./arena.js";
import { arena } from "./arena.js";
import { entry, zeros } from "./arrays.js";
import { CURVE, RouteRow } from "./constants.js";
import { InputError } from "./errors.js";
import { general } from "./number_format.js";

/** @typedef {import("../engine.js").Numbers} Numbers */

/** @param {number} angle degrees */
export function radians(angle) {
  return angle * (Math.PI / 180);
}

/** Where a curve runs, at any arc length; its rows lie in the arena in which they were first asked for. */
export class Curve {
  /** Which evaluates it. @type {import("../engine.js").Engine} */
  engine = arena().engine;

  /** Its parts as a plan says them. @returns {Numbers} */
  get parts() {
    throw new TypeError("a curve without parts");
  }

  /** The curve as kernels see it, (pieces, COLUMNS). @returns {Numbers} */
  get rows() {
    const { parts } = this;
    const rows = zeros([entry("bd_route_parts_row_count", parts)[0], CURVE.COLUMNS]);
    entry("bd_route_parts_lay_rows", parts, { x: 0, y: 0, heading: 0 }, 0, 0, rows);
    Object.defineProperty(this, "rows", { value: rows, configurable: true });
    return rows;
  }

  /** Exact length from start to end, m. */
  get length() {
    const view = doubles(this.rows);
    const last = view.length - CURVE.COLUMNS;
    return view[last + RouteRow.S_START] + view[last + RouteRow.LENGTH];
  }

  /** How far it runs on behind its start, m: 0 or infinite. */
  get extension() {
    return Number.isFinite(doubles(this.rows)[RouteRow.U_BACK]) ? 0 : Infinity;
  }

  /** Point and heading of the start. @returns {[[number, number], number]} */
  get start_pose() {
    const [x, y, heading] = entry("bd_route_parts_start_pose", this.rows, 0);
    return [[x, y], heading];
  }

  /** Point and heading of the end. @returns {[[number, number], number]} */
  get end_pose() {
    const [x, y, heading] = entry("bd_route_parts_end_pose", this.rows, this.rows.shape[0] - 1);
    return [[x, y], heading];
  }

  /**
   * x, y (m), heading (rad) and curvature (1/m) at route positions, m: four numbers each, row by row.
   * @param {ArrayLike<number>} positions
   */
  evaluate(positions) {
    return withArena(this.engine, (arena) => {
      const out = arena.array("d", positions.length, 4);
      this.engine.call("bd_route_evaluate", this.rows, arena.vector(positions), out);
      const found = doubles(out).slice();
      const off = found.findIndex((value, i) => i % 4 === 0 && Number.isNaN(value));
      if (off >= 0)
        throw new InputError(
          _("s must lie between {low} and {high} m, not at {value} m", {
            low: general(0 - this.extension),
            high: general(this.length, 12),
            value: general(positions[off / 4], 12),
          }),
        );
      return found;
    });
  }

  /** Point of a route position, m. @param {number} s @returns {[number, number]} */
  point(s) {
    const [x, y] = this.evaluate([s]);
    return [x, y];
  }
}
