// Shortest connections of two poses (L. E. Dubins, 1957), and programmes joined by them: twin of
// model/connections.py.

import { _ } from "../words.js";
import { withArena } from "./arena.js";
import { MODEL_CONNECTIONS } from "./constants.js";
import { Route, arcPart, endPose, joinedParts, linePart, startPose } from "./curves.js";
import { InputError, positive } from "./errors.js";
import { movedPart, turnedParts } from "./formations.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./curves.js").Part} Part */
/** @typedef {import("./curves.js").Pose} Pose */
/** @typedef {{ parts: Part[], length: number }} Connection */
/** Sweeps of its arcs, rad, left positive, and the length of its line, m, or null. */
/** @typedef {{ sweeps: number[], line: number | null }} Way */
/** A formation of a programme: its parts, and where it is danced, m and rad. */
/** @typedef {{ parts: Part[], at: [number, number] | null, turned: number }} Step */
/** Points along a route, and boxes of runs of them. */
/** @typedef {{ points: Float64Array, runs: Array<{ from: number, to: number, box: number[] }> }} Polyline */

const FULL_CIRCLE = 2 * Math.PI;

/** @param {Pose} pose @param {number} radius @param {number} side @returns {[number, number]} */
function circleCentre({ x, y, heading }, radius, side) {
  return [x - side * radius * Math.sin(heading), y + side * radius * Math.cos(heading)];
}

/** From one heading to another turning to one side, rad. @param {number} side @param {number} start @param {number} end */
function sweepTo(side, start, end) {
  let sweep = (side * (end - start)) % FULL_CIRCLE;
  if (sweep < 0) sweep += FULL_CIRCLE;
  const most = FULL_CIRCLE - MODEL_CONNECTIONS.ROUNDING * (1 + Math.abs(start) + Math.abs(end));
  return sweep > most ? 0 : side * sweep;
}

/** @param {Pose} start @param {Pose} end @param {number} radius */
function waysWithLine(start, end, radius) {
  /** @type {Way[]} */
  const found = [];
  for (const first of [1, -1])
    for (const last of [1, -1]) {
      const [x, y] = circleCentre(start, radius, first);
      const [toX, toY] = circleCentre(end, radius, last);
      const [apart, toward] = [Math.hypot(toX - x, toY - y), Math.atan2(toY - y, toX - x)];
      const line2 = apart * apart - (first === last ? 0 : 4 * radius * radius);
      if (line2 < 0) continue;
      const line = Math.sqrt(line2);
      const aslant = first === last ? 0 : first * Math.atan2(2 * radius, line);
      let heading = toward + aslant;
      // One circle: no line, and no heading of it.
      if (apart < MODEL_CONNECTIONS.ROUNDING * radius) heading = start.heading;
      const sweeps = [sweepTo(first, start.heading, heading), sweepTo(last, heading, end.heading)];
      found.push({ sweeps, line });
    }
  return found;
}

/** @param {Pose} start @param {Pose} end @param {number} radius */
function waysOfArcs(start, end, radius) {
  /** @type {Way[]} */
  const found = [];
  for (const side of [1, -1]) {
    const [x, y] = circleCentre(start, radius, side);
    const [toX, toY] = circleCentre(end, radius, side);
    const [apart, toward] = [Math.hypot(toX - x, toY - y), Math.atan2(toY - y, toX - x)];
    const height2 = 16 * radius * radius - apart * apart;
    if (height2 < 0) continue;
    for (const hand of [1, -1]) {
      const slant = hand * Math.atan2(Math.sqrt(height2), apart);
      // Headings where the first arc meets the second, and the second the third.
      const one = toward + slant + side * 0.5 * Math.PI;
      const two = toward + Math.PI - slant + side * 0.5 * Math.PI;
      const sweeps = [
        sweepTo(side, start.heading, one),
        sweepTo(-side, one, two),
        sweepTo(side, two, end.heading),
      ];
      found.push({ sweeps, line: null });
    }
  }
  return found;
}

/** The pieces of a way that have a length, in place. @param {Engine} engine @param {Pose} start @param {Way} way @param {number} radius */
function connection(engine, start, { sweeps, line }, radius) {
  const { ROUNDING } = MODEL_CONNECTIONS;
  const arcs = sweeps.map((sweep) =>
    radius * Math.abs(sweep) > ROUNDING ? arcPart(radius, sweep) : null,
  );
  const middle = line !== null && line > ROUNDING ? linePart(line) : null;
  const pieces = line === null ? arcs : [arcs[0], middle, arcs[1]];
  const parts = pieces.filter((piece) => piece !== null);
  if (!parts.length) return { parts, length: 0 };
  const first = movedPart(engine, parts[0], [start.x, start.y], start.heading);
  const laid = joinedParts(engine, [first, ...parts.slice(1)], 1, parts.length);
  const length = withArena(engine, (arena) =>
    laid.reduce((sum, part) => sum + new Route(arena, [part]).length, 0),
  );
  return { parts: laid, length };
}

/** The ways of Dubins' six kinds from one pose to another, the shortest first. @param {Engine} engine @param {Pose} start @param {Pose} end @param {number} radius m */
export function connections(engine, start, end, radius) {
  positive("radius", radius, "m");
  const ways = [...waysWithLine(start, end, radius), ...waysOfArcs(start, end, radius)];
  const found = ways.map((way) => connection(engine, start, way, radius));
  return found.sort((one, other) => one.length - other.length);
}

/**
 * The parts of formations one after another, with connections between those that do not meet.
 * @param {Engine} engine
 * @param {Step[]} steps
 * @param {number} radius of the connections' arcs, m
 */
export function programme(engine, steps, radius) {
  positive("radius", radius, "m");
  /** @type {Part[][]} */
  const routes = [];
  for (const { parts, at, turned } of steps) {
    if (at === null && routes.length) {
      const before = lastOf(routes);
      const { x, y, heading } = endPose(engine, lastOf(before));
      const first = movedPart(engine, parts[0], [x, y], heading);
      routes.push(joinedParts(engine, [first, ...parts.slice(1)], 1, parts.length));
    } else routes.push(turnedParts(parts, turned, at ?? [0, 0]));
  }
  const found = [...routes[0]];
  for (let n = 1; n < routes.length; n++) {
    if (steps[n].at !== null) found.push(...fitting(engine, routes[n - 1], routes[n], radius).parts);
    found.push(...routes[n]);
  }
  return joinedParts(engine, found, 1, found.length);
}

/** @template T @param {T[]} list */
function lastOf(list) {
  return list[list.length - 1];
}

/** The connection of two routes that crosses them least often; of several the shortest. @param {Engine} engine @param {Part[]} before @param {Part[]} after @param {number} radius */
function fitting(engine, before, after, radius) {
  const start = endPose(engine, lastOf(before));
  const found = connections(engine, start, startPose(engine, after[0]), radius);
  const others = [before, after].map((parts) => polyline(engine, parts, 0));
  const crossed = found.map(({ parts }) => {
    if (!parts.length) return 0;
    const way = polyline(engine, parts, 1); // at its ends it touches them
    return others.reduce((sum, other) => sum + crossings(way, other), 0);
  });
  return found[crossed.indexOf(Math.min(...crossed))];
}

/** Points along a route, but so many at each end. @param {Engine} engine @param {Part[]} parts @param {number} spared @returns {Polyline} */
function polyline(engine, parts, spared) {
  const points = withArena(engine, (arena) => {
    const route = new Route(arena, parts);
    const { MOST_CHORDS, CHORD } = MODEL_CONNECTIONS;
    const count = Math.min(MOST_CHORDS, Math.max(8, Math.ceil(route.length / CHORD)));
    const s = Array.from({ length: count + 1 }, (_s, i) =>
      i === count ? route.length : i * (route.length / count),
    );
    const found = route.evaluate(s);
    return Float64Array.from({ length: 2 * (count + 1) }, (_x, i) => found[4 * (i >> 1) + (i & 1)]);
  });
  const kept = points.slice(2 * spared, points.length - 2 * spared);
  return { points: kept, runs: runsOf(kept) };
}

/** A polyline in parts of RUN chords, each with its box. @param {Float64Array} points */
function runsOf(points) {
  const chords = points.length / 2 - 1;
  const runs = [];
  for (let from = 0; from < Math.max(1, chords); from += MODEL_CONNECTIONS.RUN) {
    const to = Math.min(from + MODEL_CONNECTIONS.RUN, chords);
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (let i = from; i <= to; i++)
      for (const k of [0, 1]) {
        box[k] = Math.min(box[k], points[2 * i + k]);
        box[k + 2] = Math.max(box[k + 2], points[2 * i + k]);
      }
    runs.push({ from, to, box });
  }
  return runs;
}

/** How many chords of two polylines cross each other. @param {Polyline} one @param {Polyline} other */
function crossings(one, other) {
  let count = 0;
  for (const a of one.runs)
    for (const b of other.runs) {
      // Where the boxes of two runs lie apart, no chord of the one crosses one of the other.
      const near = [0, 1].every((k) => a.box[k] <= b.box[k + 2] && b.box[k] <= a.box[k + 2]);
      if (!near) continue;
      for (let i = a.from; i < a.to; i++)
        for (let j = b.from; j < b.to; j++) if (doCross(one.points, i, other.points, j)) count++;
    }
  return count;
}

/** Whether each chord's ends lie on different sides of the other. @param {Float64Array} p @param {number} i @param {Float64Array} q @param {number} j */
function doCross(p, i, q, j) {
  const [ax, ay, bx, by] = [p[2 * i], p[2 * i + 1], p[2 * i + 2], p[2 * i + 3]];
  const [cx, cy, dx, dy] = [q[2 * j], q[2 * j + 1], q[2 * j + 2], q[2 * j + 3]];
  const [ux, uy, vx, vy] = [dx - cx, dy - cy, bx - ax, by - ay];
  const across = (ux * (ay - cy) - uy * (ax - cx)) * (ux * (by - cy) - uy * (bx - cx));
  if (!(across < 0)) return false;
  return (vx * (cy - ay) - vy * (cx - ax)) * (vx * (dy - ay) - vy * (dx - ax)) < 0;
}

/** Refuse a formation that is turned without being put anywhere. @param {Record<string, any>} step */
export function checkStep({ at, turned }) {
  if (at === null && turned !== 0)
    throw new InputError(
      _("turned has no effect without at: this formation begins as the one before it ends"),
    );
}
