// Lines that run aside of a route, as rows of arcs. Twin of `strayed` in solve/random_dance.py.

import { hold, spend } from "./budget.js";
import { CURVE, ROUTE, SOLVE_RANDOM_DANCE } from "./constants.js";
import { evenly } from "./lists.js";
import { stopped } from "./random_dance.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("../made/curves.js").Route} Route */
/** How far to the left of a route a line runs at a route position, m, and its slope there. @typedef {(s: number) => [number, number]} Offset */
/** Positions along a route and along a line, in pairs, m. @typedef {{ drawn: number[], along: number[] }} Ways */

const { ARC_LENGTH, CHANGE, LEAST_PART, BEHIND, NODE, NODE_WORK } = SOLVE_RANDOM_DANCE;

/**
 * A line that runs aside of a route from route position low to end, m.
 * @param {Arena} arena which holds the rows
 * @param {Route} route
 * @param {Offset} off
 * @param {number} low @param {number} end
 * @returns {{ rows: Numbers, ways: Ways }}
 */
export function strayed(arena, route, off, low, end) {
  if (end > route.length + ROUTE.END_SLACK) throw stopped(route.length);
  const drawn = nodesOf(route, low, end);
  const places = route.evaluate(drawn);
  /** @type {Array<[number, number]>} */
  const points = [];
  const headings = drawn.map((s, n) => {
    const [x, y, heading, bend] = places.subarray(4 * n, 4 * n + 4);
    const [aside, slope] = off(s);
    points.push([x - aside * Math.sin(heading), y + aside * Math.cos(heading)]);
    return heading + Math.atan2(slope, 1 - aside * bend);
  });
  const rows = biarcs(points, headings);
  const along = rows.filter((_row, n) => n % 2 === 1).map((row) => row[CURVE.S_START]);
  const last = rows[rows.length - 1];
  along.push(last[CURVE.S_START] + last[CURVE.LENGTH]);
  return { rows: arena.table(rows, CURVE.COLUMNS), ways: { drawn, along } };
}

/** Positions along a route between which arcs are fitted, joints among them, m. @param {Route} route @param {number} low @param {number} end */
function nodesOf(route, low, end) {
  const first = route.extension ? low : Math.max(low, 0);
  const count = (end - first) / (0.1 * ARC_LENGTH);
  hold(NODE * count);
  spend(NODE_WORK * count);
  const inner = Array.from(route.joints.slice(1, -1)).filter((s) => s > first + LEAST_PART && s < end);
  let ends = [first, ...inner];
  ends = ends.filter((s, n) => n === 0 || s - ends[n - 1] >= LEAST_PART);
  if (ends.length > 1 && end - ends[ends.length - 1] < LEAST_PART) ends.pop();
  ends.push(end);
  const nodes = [first];
  for (let n = 1; n < ends.length; n++) {
    const [a, b] = [ends[n - 1], ends[n]];
    const parts = 2 + Math.trunc((b - a) * densityOf(route, a, b));
    nodes.push(...evenly(a, b, parts).slice(1));
  }
  return nodes;
}

/** How many arcs a metre are wanted between two positions, on the whole. @param {Route} route @param {number} a @param {number} b */
function densityOf(route, a, b) {
  const fine = evenly(a, b, 3 + Math.trunc((b - a) / (0.1 * ARC_LENGTH))).slice(1, -1);
  const places = route.evaluate(fine);
  const bends = fine.map((_s, n) => places[4 * n + 3]);
  if (fine.length < 3) return 1 / ARC_LENGTH;
  const dense = fine.map((_s, n) => {
    const [before, after] = [Math.max(n - 1, 0), Math.min(n + 1, fine.length - 1)];
    const change = Math.abs((bends[after] - bends[before]) / (fine[after] - fine[before]));
    return Math.max(1 / ARC_LENGTH, Math.cbrt(change / CHANGE));
  });
  return dense.reduce((sum, one) => sum + one, 0) / dense.length;
}

/** Rows of two arcs between each two points (m), with these headings there, rad. @param {Array<[number, number]>} points @param {number[]} headings */
function biarcs(points, headings) {
  const begin = headings[0];
  const [x, y] = points[0];
  const rows = [lineBefore([x - BEHIND * Math.cos(begin), y - BEHIND * Math.sin(begin)], begin)];
  for (let n = 1; n < points.length; n++) {
    const [p, q] = [points[n - 1], points[n]];
    const middle = middleOf(p, q, headings[n - 1], headings[n]);
    const first = halfTurn(p, middle, headings[n - 1]);
    const heading = headings[n - 1] + 2 * first;
    rows.push(arcFrom(p, middle, headings[n - 1], first));
    rows.push(arcFrom(middle, q, heading, halfTurn(middle, q, heading)));
  }
  let s = 0;
  for (const row of rows) {
    row[CURVE.S_START] = s;
    s += row[CURVE.LENGTH];
  }
  return rows;
}

/** Where two arcs between points with headings meet. @param {[number, number]} p @param {[number, number]} q @param {number} a @param {number} b @returns {[number, number]} */
function middleOf(p, q, a, b) {
  const [vx, vy] = [q[0] - p[0], q[1] - p[1]];
  const [bothX, bothY] = [Math.cos(a) + Math.cos(b), Math.sin(a) + Math.sin(b)];
  const [apartX, apartY] = [Math.cos(a) - Math.cos(b), Math.sin(a) - Math.sin(b)];
  const along = vx * bothX + vy * bothY;
  const size = vx * vx + vy * vy;
  const d = size / (along + Math.sqrt(along * along + (apartX * apartX + apartY * apartY) * size));
  return [0.5 * (p[0] + q[0] + d * apartX), 0.5 * (p[1] + q[1] + d * apartY)];
}

/** The angle from a heading to the chord between two points, rad. @param {[number, number]} p @param {[number, number]} q @param {number} heading */
function halfTurn(p, q, heading) {
  const [dx, dy] = [q[0] - p[0], q[1] - p[1]];
  const [c, s] = [Math.cos(heading), Math.sin(heading)];
  return Math.atan2(dy * c - dx * s, dx * c + dy * s);
}

/** @param {number} kind @param {[number, number]} start @param {number} heading @param {number} length */
function rowOf(kind, [x, y], heading, length) {
  const row = new Float64Array(CURVE.COLUMNS);
  row[CURVE.KIND] = kind;
  row[CURVE.X] = x;
  row[CURVE.Y] = y;
  row[CURVE.ANGLE] = heading;
  row[CURVE.LENGTH] = length;
  row[CURVE.U_END] = length;
  row[CURVE.AXIS_X] = Math.cos(heading);
  row[CURVE.AXIS_Y] = Math.sin(heading);
  return row;
}

/** The line that runs on behind the first arc. @param {[number, number]} start @param {number} heading */
function lineBefore(start, heading) {
  const row = rowOf(CURVE.LINE, start, heading, BEHIND);
  row[CURVE.U_BACK] = -Infinity;
  return row;
}

/** @param {[number, number]} p @param {[number, number]} q @param {number} heading @param {number} half of its turn, rad */
function arcFrom(p, q, heading, half) {
  const chord = Math.hypot(q[0] - p[0], q[1] - p[1]);
  const straight = half === 0 ? 1 : Math.sin(half) / half;
  const row = rowOf(CURVE.ARC, p, heading, chord / straight);
  row[CURVE.P] = (2 * Math.sin(half)) / chord;
  return row;
}
