// The ground that a dance covers as polygons, and the spectators' line about it: of analysis/swept.py and
// analysis/crowd.py what GEOS does there, and Clipper here, in whole numbers of UNITS to a metre.

import { Clipper64, ClipperOffset } from "../carried_shapes.js";
import { areaOf } from "../made/rings.js";
import { _ } from "../words.js";
import { walkedSteps } from "./swept_steps.js";
import { part } from "../made/stages.js";
import { tick } from "./tick.js";

/** @typedef {import("../carried_shapes.js").Path} Path */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {[number, number]} Point */
/** A closed line, m: the last point is the first. @typedef {Point[]} Ring */
/** Closed lines around the outside, and around holes. @typedef {{ outer: Ring[], holes: Ring[] }} Rings */
/** The ground covered: see `SweptArea` of analysis/swept.py. @typedef {{ area: number, error: number, outlines: Rings, lines: Rings, rectangle: { width: number, height: number } }} SweptArea */

const UNITS = 1e4;
/** What rounding to whole numbers moves a corner by at most, m, all times together; and by how much arcs cut in. */
const [ROUNDED, CHORD] = [6 / UNITS, 1e-3];
/** What outlines may be smoothed by, m, the ground's and then that from which the spectators' line is made. */
const [SMOOTH, SMOOTHER] = [0.002, 0.008];
/** Hulls that are joined at a time: neighbours along the route overlap much. */
const GROUP = 48;
/** Clipper's ClipType, FillRule, JoinType and EndType. */
const [UNION, DIFFERENCE, NON_ZERO, ROUND, POLYGON] = [2, 3, 1, 3, 0];
/** What a corner that is cut off may stick out, in lengths: Clipper does not ask where all are round. */
const MITRE = 2;

/**
 * The ground that benches cover over a span, s.
 * @param {Walk} walk
 * @param {[number, number]} span
 * @param {number} margin how far spectators keep from it, m
 * @param {number} error m; nothing of the polygon is farther from what is covered than what comes back
 * @param {Progress} progress
 * @returns {Promise<SweptArea>}
 */
export async function sweptArea(walk, span, margin, error, progress) {
  const following = part(progress, 0, 0.5, _("following the benches"));
  const { corners, stray, needless } = await walkedSteps(walk, span, error, following);
  const near = new Near(corners[0][0]);
  const joining = part(progress, 0.5, 1, _("joining what they cover"));
  const least = stray + ROUNDED + CHORD + SMOOTH;
  const ground = widened(smoothed(await joined(near, corners, joining), SMOOTH), least);
  const line = margin
    ? widened(smoothed(ground, SMOOTHER), margin + ROUNDED + CHORD + SMOOTHER)
    : ground;
  const outlines = near.rings(ground);
  return {
    area: areaWithin(outlines),
    error: needless + least + ROUNDED + SMOOTH,
    outlines,
    lines: near.rings(line),
    rectangle: rectangleAbout(outlines.outer.flat()),
  };
}

/** The area within a venue's edge and outside all that is taken, m2. @param {Ring} edge @param {Ring[]} taken */
export function groundLeft(edge, taken) {
  const near = new Near(edge[0]);
  const clipper = new Clipper64();
  clipper.addSubject([near.path(edge)]);
  clipper.addClip(taken.map((ring) => near.path(ring)));
  return areaWithin(near.rings(solved(clipper, DIFFERENCE)));
}

/** @param {Rings} rings */
function areaWithin({ outer, holes }) {
  const sum = (/** @type {Ring[]} */ rings) =>
    rings.reduce((/** @type {number} */ all, ring) => all + areaOf(ring), 0);
  return sum(outer) - sum(holes);
}

/** Places near one as Clipper has them: whole numbers, counted from there. */
class Near {
  /** @param {Point} origin m */
  constructor([x, y]) {
    this.x = x;
    this.y = y;
  }

  /** A polygon, whichever way its corners go round. @param {Point[]} corners m @returns {Path} */
  path(corners) {
    const found = corners.map(([x, y]) => ({
      x: Math.round((x - this.x) * UNITS),
      y: Math.round((y - this.y) * UNITS),
    }));
    return twiceArea(found) < 0 ? found.reverse() : found;
  }

  /** @param {Path[]} paths @returns {Rings} */
  rings(paths) {
    const placed = (/** @type {Path} */ path) =>
      [...path, path[0]].map(
        ({ x, y }) => /** @type {Point} */ ([this.x + x / UNITS, this.y + y / UNITS]),
      );
    return {
      outer: paths.filter((path) => twiceArea(path) > 0).map(placed),
      holes: paths.filter((path) => twiceArea(path) < 0).map(placed),
    };
  }
}

/** Twice the area within, less than 0 where it goes round clockwise. @param {Path} path */
function twiceArea(path) {
  let sum = 0;
  for (let i = path.length - 1, j = 0; j < path.length; i = j++)
    sum += (path[i].x - path[j].x) * (path[i].y + path[j].y);
  return sum;
}

/** The union of the hulls of corners. @param {Near} near @param {Point[][]} corners @param {Progress} progress */
async function joined(near, corners, progress) {
  const groups = [];
  for (let first = 0; first < corners.length; first += GROUP) {
    const some = corners.slice(first, first + GROUP);
    groups.push(...union(some.map((one) => hullOf(near.path(one)))));
    progress((0.8 * first) / corners.length, "");
    await tick();
  }
  return union(groups);
}

/** @param {Path[]} paths */
function union(paths) {
  const clipper = new Clipper64();
  clipper.addSubject(paths);
  return solved(clipper, UNION);
}

/** @param {Clipper64} clipper @param {number} kind */
function solved(clipper, kind) {
  /** @type {Path[]} */
  const found = [];
  clipper.execute(kind, NON_ZERO, found);
  return found;
}

/** Polygons with fewer corners, none of whose sides moves by more than so far, m (Douglas and Peucker). @param {Path[]} paths @param {number} by */
function smoothed(paths, by) {
  return paths.map((path) => {
    const half = Math.floor(path.length / 2);
    const [there, back] = [path.slice(0, half + 1), [...path.slice(half), path[0]]];
    return [there, back].flatMap((side) => thinned(side, by * UNITS).slice(0, -1));
  });
}

/** A line without the corners that are so near to what is left of it. @param {Path} line @param {number} by @returns {Path} */
function thinned(line, by) {
  const keep = new Uint8Array(line.length);
  keep[0] = keep[line.length - 1] = 1;
  const waiting = [[0, line.length - 1]];
  for (let pair = waiting.pop(); pair; pair = waiting.pop()) {
    const [first, last] = pair;
    let [most, at] = [by, 0];
    for (let i = first + 1; i < last; i++) {
      const away = awayFrom(line[first], line[last], line[i]);
      if (away > most) [most, at] = [away, i];
    }
    if (!at) continue;
    keep[at] = 1;
    waiting.push([first, at], [at, last]);
  }
  return line.filter((_corner, i) => keep[i]);
}

/** How far a point is from a side. @param {Path[0]} a @param {Path[0]} b @param {Path[0]} point */
function awayFrom(a, b, { x, y }) {
  const [u, v] = [b.x - a.x, b.y - a.y];
  const square = u * u + v * v;
  const share = square ? Math.min(Math.max(((x - a.x) * u + (y - a.y) * v) / square, 0), 1) : 0;
  return Math.hypot(a.x + share * u - x, a.y + share * v - y);
}

/** All that is within so far, m, of polygons. @param {Path[]} paths @param {number} by */
function widened(paths, by) {
  const offset = new ClipperOffset(MITRE, CHORD * UNITS);
  offset.addPaths(paths, ROUND, POLYGON);
  /** @type {Path[]} */
  const found = [];
  offset.execute(by * UNITS, found);
  return found;
}

/** The convex hull of points, counter-clockwise (Andrew's monotone chain). @param {Path} points @returns {Path} */
function hullOf(points) {
  const sorted = [...points].sort((a, b) => a.x - b.x || a.y - b.y);
  const half = (/** @type {Path} */ some) => {
    /** @type {Path} */
    const found = [];
    for (const c of some) {
      for (;;) {
        const [a, b] = found.slice(-2);
        if (!b || (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0) break;
        found.pop();
      }
      found.push(c);
    }
    return found.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

/** The sides of the smallest rectangle, at any angle, that holds points: one lies along their hull. @param {Point[]} points m */
function rectangleAbout(points) {
  const hull = hullOf(points.map(([x, y]) => ({ x, y })));
  let [width, height] = [Infinity, Infinity];
  hull.forEach((a, n) => {
    const b = hull[(n + 1) % hull.length];
    const long = Math.hypot(b.x - a.x, b.y - a.y);
    const [u, v] = [(b.x - a.x) / long, (b.y - a.y) / long];
    const along = extent(hull, u, v);
    const across = extent(hull, -v, u);
    if (along * across < width * height) [width, height] = [along, across];
  });
  return { width: Math.max(width, height), height: Math.min(width, height) };
}

/** How far points reach along a way. @param {Path} points @param {number} u @param {number} v */
function extent(points, u, v) {
  let [low, high] = [Infinity, -Infinity];
  for (const { x, y } of points) {
    const at = u * x + v * y;
    [low, high] = [Math.min(low, at), Math.max(high, at)];
  }
  return high - low;
}
