// How places are measured on the ground: from a peg, along a base line and to the left of it. Twin of
// analysis/ground.py.

import { _ } from "../words.js";
import { ANALYSIS_GROUND } from "./constants.js";
import { rint, rounded } from "./numbers.js";

/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {[number, number]} Point */

/**
 * Where papers measure from.
 * @typedef {object} Ground
 * @property {Point} peg where the peg stands, m of the plan
 * @property {number} turned of the base line, along which x runs, from the plan's x axis, rad
 * @property {boolean} north whether y points north
 * @property {boolean} venue whether the base line runs along the venue's edge
 */

const { LEAST_EDGE, UNTURNED } = ANALYSIS_GROUND;

/** That of a plan, whose peg stands there. @param {Point} peg @param {boolean} north @param {Obstacle[]} obstacles @returns {Ground} */
export function groundOf(peg, north, obstacles) {
  const edge = obstacles.find(({ kind }) => kind === "venue");
  if (north || !edge) return { peg, turned: 0, north, venue: false };
  return { peg, turned: baseAngle(edge.outline), north, venue: true };
}

/** By how much the longest edge of a venue is turned from the nearer axis, rad; 0 for a bent edge. @param {Point[]} outline */
function baseAngle(outline) {
  const sides = outline.map(([x, y], n) => {
    const [toX, toY] = outline[(n + 1) % outline.length];
    return [toX - x, toY - y];
  });
  const lengths = sides.map(([x, y]) => Math.hypot(x, y));
  const told = lengths.map((length) => rounded(length, 9));
  const n = told.indexOf(told.reduce((most, length) => Math.max(most, length)));
  if (lengths[n] < LEAST_EDGE * lengths.reduce((sum, length) => sum + length, 0)) return 0;
  const [quarter, angle] = [0.5 * Math.PI, Math.atan2(sides[n][1], sides[n][0])];
  const turned = angle - quarter * rint(angle / quarter);
  return Math.abs(turned) < UNTURNED ? 0 : turned;
}

/** Unit vectors of the plan: the ways x and y point, and against them. @param {Ground} ground @returns {Point[]} */
export function waysOf({ turned }) {
  const [c, s] = [Math.cos(turned), Math.sin(turned)];
  return [[c, s], [-s, c], [-c, -s], [s, -c]]; // prettier-ignore
}

/** The same in words, in the language in use. @param {Ground} ground */
export function wayNames({ north, venue }) {
  if (north) return [_("due east"), _("due north"), _("due west"), _("due south")];
  if (venue) return [_("to the right"), _("forward"), _("to the left"), _("back")];
  return [_("the way x points"), _("the way y points"), _("against x"), _("against y")];
}

/** What x and y are, in a sentence. @param {Ground} ground */
export function groundLegend({ north, venue }) {
  if (north) return _("x and y are measured from the peg: x east, y north.");
  if (venue)
    return _(
      "x and y are measured from the peg along the venue's edges: x to the right, y forward, as one sees it who stands at the near edge and faces the square; to the left and back they are negative.",
    );
  return _("x and y are measured from the peg: on the drawings x to the right, y up.");
}

/** What an arrow along y is called, for small maps. @param {Ground} ground */
export function yWord({ north, venue }) {
  if (north) return _("N");
  return venue ? _("forward") : "y";
}

/** A place of the plan as measured on the ground: x and y from the peg, m. @param {Ground} ground @param {Point} point @returns {Point} */
export function seenFrom(ground, [x, y]) {
  const [offX, offY] = [x - ground.peg[0], y - ground.peg[1]];
  const [along, across] = waysOf(ground).map(([u, v]) => offX * u + offY * v);
  return [along, across];
}
