// What a plan draws on the ground before its dance is computed.

import { between, gateIn, opening, ringOf } from "./made/rings.js";
import { danceFrame, Frame, hasSpiral, RECTANGLE, spiralPoint } from "./grip_kinds.js";
import { entrancesOf, restsOf, streetOf } from "./things.js";

/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {[number, number]} Point */

/** Entrances, and where the head rests, are drawn so large, m. */
const ENTRANCE = 0.5;
/** The gate of a street whose width nobody said is so wide, m. */
const GATE = 6;

/** Points of a circle. @param {Point} centre @param {number} radius @returns {Point[]} */
function circle([x, y], radius) {
  return Array.from({ length: 73 }, (_point, n) => {
    const angle = (n * Math.PI) / 36;
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
  });
}

/** The edge of a square, as lines that entrances and the street leave of it. @param {Plan} plan @param {Point[]} corners @returns {Point[][]} */
function edgeLines(plan, corners) {
  const ring = ringOf(corners);
  const gate = streetOf(plan).length
    ? gateIn(ring, [...streetOf(plan), danceFrame(plan).origin], plan.route.street.width ?? GATE)
    : null;
  const gates = entrancesOf(plan).map(([x, y, width]) => width && opening(ring, [x, y], width));
  const spans = [gate, ...gates].filter(Boolean);
  return spans.length ? between(ring, spans) : [ring];
}

/** Lines, on the ground, that a plan draws before its dance is computed. @param {Plan} plan @returns {Point[][]} */
export function sketchOf(plan) {
  const { route, disc, venue, obstacle } = plan;
  const frame = danceFrame(plan);
  /** @type {Point[][]} */
  const lines = [];
  if (disc?.radius) lines.push(circle(frame.origin, disc.radius));
  if (route.kind === "spiral-in" && hasSpiral(plan)) {
    const [first, last] = [(disc?.radius ?? 0) / route.pitch, route.start_turn];
    const count = Math.max(Math.ceil(48 * (last - first)), 0);
    lines.push(
      Array.from({ length: count + 1 }, (_point, n) => frame.ground(spiralPoint(plan, last - n / 48))),
    );
  }
  const rectangle = (/** @type {Point} */ centre, /** @type {Point} */ size, angle = 0) => {
    const own = new Frame(centre, angle);
    return RECTANGLE.slice(4).map(([a, b]) => own.ground([0.5 * a * size[0], 0.5 * b * size[1]]));
  };
  const outline = (/** @type {Point[]} */ points, closed = true) =>
    lines.push(closed ? [...points, points[0]] : points);
  const edge = venue?.rectangle
    ? rectangle(venue.centre ?? [0, 0], venue.rectangle, venue.angle)
    : venue?.boundary;
  if (edge) lines.push(...edgeLines(plan, edge));
  for (const one of obstacle ?? []) {
    if (one.kind === "circle") lines.push(circle(one.centre, one.radius));
    else if (one.kind === "rectangle") outline(rectangle(one.centre, one.size, one.angle));
    else outline(one.points, one.kind === "polygon");
  }
  for (const [x, y, width] of entrancesOf(plan))
    lines.push(circle([x, y], width ? 0.5 * width : ENTRANCE));
  if (streetOf(plan).length) outline(streetOf(plan), false);
  for (const [, { place }] of restsOf(plan)) if (place) lines.push(circle(place, ENTRANCE));
  if (route.kind === "drawn" && route.points)
    outline(
      route.points.map((/** @type {Point} */ point) => frame.ground(point)),
      route.closed,
    );
  return lines;
}
