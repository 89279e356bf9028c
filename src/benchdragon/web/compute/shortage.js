// How far a pair of benches, or a bench and what stands still, is apart: of analysis/shortage.py what fills
// arrays.

import { nearestBoxes } from "../made/obstacle_distance.js";
import { doubles, withArena, within } from "./arena.js";
import { BOX, Box } from "./constants.js";
import { boxes } from "./distance.js";

/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("./walk.js").Walk} Walk */

/** A pair of benches (rows), or one and an obstacle, at some times, s. */
export class _Seen {
  /** @param {Walk} walk @param {number[]} times @param {number[]} rows @param {Obstacle | null} obstacle */
  constructor(walk, times, rows, obstacle) {
    this.engine = walk.engine;
    this.obstacle = obstacle;
    this.headed = rows[0] === 0;
    this.count = rows.length;
    /** Boxes of the pair at the first time, at the next, and so on. */
    this.boards = withArena(walk.engine, (arena) => {
      const motion = walk.motion(arena, times);
      return times.flatMap((_time, t) =>
        withArena(walk.engine, (own) => {
          const table = doubles(boxes(own, motion, t));
          return rows.flatMap((row) => [
            ...table.subarray(row * BOX.BOX_COLUMNS, (row + 1) * BOX.BOX_COLUMNS),
          ]);
        }),
      );
    });
  }

  /** How far the two are apart at each time with so much room on both sides and ahead, m. @param {number} beside @param {number} ahead @returns {number[]} */
  apart(beside, ahead) {
    return withArena(this.engine, (own) => {
      const table = own.array("d", this.boards.length / BOX.BOX_COLUMNS, BOX.BOX_COLUMNS);
      const view = doubles(table);
      view.set(this.boards);
      for (let at = 0; at < view.length; at += BOX.BOX_COLUMNS) view[at + Box.HALF_WIDTH] += beside;
      for (let at = 0; this.headed && at < view.length; at += this.count * BOX.BOX_COLUMNS) {
        view[at + Box.HALF_LENGTH] += 0.5 * ahead;
        view[at + Box.CX] += 0.5 * ahead * view[at + Box.UX];
        view[at + Box.CY] += 0.5 * ahead * view[at + Box.UY];
      }
      return [
        ...(this.obstacle === null ? pairsApart(own, table) : apartFrom(own, table, this.obstacle)),
      ];
    });
  }
}

/** How far boxes are apart, of which each two that follow one another are a pair, m. @param {Arena} arena @param {Numbers} table */
function pairsApart(arena, table) {
  const count = table.shape[0] / 2;
  const [first, second] = [0, 1].map((k) =>
    arena.whole(Array.from({ length: count }, (_pair, t) => 2 * t + k)),
  );
  const [gap, out] = [arena.array("d", count), arena.array("d", count)];
  arena.engine.call("bd_box_pair_distances", table, first, second, gap, out);
  return doubles(out).slice();
}

/** How far boxes are from an obstacle, m. @param {Arena} arena @param {Numbers} table @param {Obstacle} obstacle */
function apartFrom(arena, table, obstacle) {
  const [[apart], forbidden] = within(arena, () => [
    nearestBoxes(table, obstacle),
    obstacle.forbids(table),
  ]);
  return doubles(apart).map((distance, t) => (forbidden[t] ? -Infinity : distance - obstacle.radius));
}
