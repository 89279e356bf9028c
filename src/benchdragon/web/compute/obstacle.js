// What stands on the square, as kernels see it; and which sides of an outline meet.

import { arena as here, wholes } from "./arena.js";
import { BOX, ObstacleKind } from "./constants.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {[number, number]} Point */
/** @typedef {import("../made/obstacle.js").Obstacle} Obstacle */
/** @typedef {"circle" | "rectangle" | "polygon" | "line" | "venue"} ObstacleKind */

/** What kernels know of an obstacle: twin of `Standing` in model/obstacle.py. */
export class Standing {
  /** @type {ObstacleKind} */
  kind = "line";
  /** Its corners in order, m; of a circle the centre. @type {Point[]} */
  outline = [];
  /** Of a circle, m; else 0. */
  radius = 0;
  /** Of a venue with a gate what that leaves of its outline, m. @type {Point[] | null} */
  open = null;

  /** What benches must not touch of it, m. */
  get walls() {
    return this.open ?? this.outline;
  }

  /** What its kind is to the kernels: an edge with a gate is a chain of lines. */
  get sort() {
    const { CIRCLE, BODY, LINE, VENUE } = ObstacleKind;
    if (this.open) return LINE;
    return { circle: CIRCLE, rectangle: BODY, polygon: BODY, line: LINE, venue: VENUE }[this.kind];
  }

  /** Its corners, m, (P, 2). @param {Arena} arena */
  corners(arena) {
    return arena.table(this.walls, 2);
  }

  /** Its sides, or its centre, as boxes without width: (sides, BOX_COLUMNS) of kernels/box.py. */
  get boxes() {
    const arena = here();
    const count = this.walls.length - (this.sort === ObstacleKind.LINE ? 1 : 0);
    const made = arena.array("d", count, BOX.BOX_COLUMNS);
    arena.engine.call("bd_obstacle_fill_boxes", this.sort, this.corners(arena), made);
    return made;
  }

  /** Which of points, m, the first two columns, lie where none may: inside it, or outside the venue. @param {Numbers} points */
  forbids(points) {
    const arena = here();
    const out = arena.array("q", points.shape[0]);
    const corners = this.corners(arena);
    arena.engine.call("bd_obstacle_forbidden", this.sort, corners, this.radius, points, out);
    return wholes(out).map((flag) => flag === 1);
  }
}

/** Two sides of a closed outline that meet though they are no neighbours, or fold back; null if none. @param {Point[]} corners @returns {[number, number] | null} */
export function _crossing(corners) {
  const count = corners.length;
  const end = (/** @type {number} */ i) => corners[(i + 1) % count];
  for (let i = 0; i < count; i++) {
    const j = (i + 1) % count;
    const [ax, ay] = [end(i)[0] - corners[i][0], end(i)[1] - corners[i][1]];
    const [bx, by] = [end(j)[0] - corners[j][0], end(j)[1] - corners[j][1]];
    if (ax * by - ay * bx === 0 && ax * bx + ay * by < 0) return [i, j];
  }
  for (let i = 0; i < count; i++)
    for (let j = i + 2; j < count; j++)
      if (j - i !== count - 1 && doMeet(corners[i], end(i), corners[j], end(j))) return [i, j];
  return null;
}

/** Whether two segments share a point. @param {Point} a @param {Point} b @param {Point} c @param {Point} d */
export function doMeet(a, b, c, d) {
  for (const k of [0, 1])
    if (Math.max(a[k], b[k]) < Math.min(c[k], d[k]) || Math.max(c[k], d[k]) < Math.min(a[k], b[k]))
      return false;
  const sides = [sideOf(a, b, c) * sideOf(a, b, d), sideOf(c, d, a) * sideOf(c, d, b)];
  return sides[0] <= 0 && sides[1] <= 0;
}

/** On which side of a line from a to b a point lies: -1, 0, 1. @param {Point} a @param {Point} b @param {Point} c */
function sideOf(a, b, c) {
  return Math.sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}
