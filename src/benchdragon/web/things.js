// What stands on the square, in a plan: added, named, given sizes, deleted. Each makes a plan of its own.

import { SOLVE_WISHES } from "./compute/constants.js";
import { _ } from "./words.js";

/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {[number, number]} Point */
/** What can be put onto the square; its edge takes the place of the one before. @typedef {"well" | "stage" | "tree" | "shape" | "entrance" | "street" | "rest" | "edge"} Sort */

/** Letters of a name: MOST_LETTERS of plans/square.py. */
export const MOST_LETTERS = 80;
/** So many corners are round where all are as far from their middle, to so much, m. */
const ROUND = 12;
const ALIKE = 0.005;

/** A place is in a street that is so near, m. */
const BESIDE = 3;

/** A rest is so long at first, s. */
const REST = 60;

/** What is put onto the square: on its button, what it is called then, and its table at a centre, or at `corners`; whether these are points of an open line. @type {Record<Sort, { button: () => string, name: () => string, corners?: boolean, open?: boolean, made: (points: Point[]) => object }>} */
export const SORTS = {
  well: {
    button: () => _("well"),
    name: () => _("well"),
    made: ([centre]) => ({ kind: "circle", centre, radius: 0.6 }),
  },
  stage: {
    button: () => _("stage"),
    name: () => _("stage"),
    made: ([centre]) => ({ kind: "rectangle", centre, size: [8, 4] }),
  },
  tree: {
    button: () => _("tree"),
    name: () => _("tree"),
    made: ([centre]) => ({ kind: "circle", centre, radius: 0.4 }),
  },
  shape: {
    button: () => _("own shape"),
    name: () => _("obstacle"),
    corners: true,
    made: (points) => ({ kind: "polygon", points }),
  },
  entrance: { button: () => _("entrance"), name: () => _("entrance"), made: ([at]) => at },
  street: {
    button: () => _("street"),
    name: () => _("street"),
    corners: true,
    open: true,
    made: (points) => ({ points }),
  },
  rest: {
    button: () => _("rest"),
    name: () => _("rest"),
    made: ([place]) => ({ kind: "hold", place, hold: REST, text: _("rest") }),
  },
  edge: {
    button: () => _("draw its edge"),
    name: () => _("square"),
    corners: true,
    made: (boundary) => ({ boundary }),
  },
};

/** What stands on the square: its table, and a plan of it alone, by which it is drawn. @typedef {{ id: string, table: Record<string, any>, name: string, alone: Plan }} Thing */

/** Whether a value is a point, or two sizes: what stands in an address may be anything. @param {any} value @returns {value is Point} */
const isPoint = (value) => Array.isArray(value) && value.length === 2 && value.every(Number.isFinite);

/** The points that a value is; none where it is something else. @param {any} value @returns {Point[]} */
export function pointsOf(value) {
  return Array.isArray(value) && value.every(isPoint) ? value : [];
}

/** Whether a plan says an edge of its square. @param {Plan} plan */
export function hasSquare({ venue }) {
  return isPoint(venue?.rectangle) || pointsOf(venue?.boundary).length > 0;
}

/** Whether a value is an obstacle that can be drawn. @param {any} one */
function isObstacle(one) {
  if (one?.kind === "circle") return isPoint(one.centre) && Number.isFinite(one.radius);
  if (one?.kind === "rectangle") return isPoint(one.centre) && isPoint(one.size);
  return pointsOf(one?.points).length > 0;
}

/** The obstacles of a plan; none where one is something else. @param {Plan} plan @returns {Record<string, any>[]} */
export function obstaclesOf({ obstacle }) {
  return Array.isArray(obstacle) && obstacle.every(isObstacle) ? obstacle : [];
}

/** Whether a value is an entrance: a place, and how wide it is, or not. @param {any} value */
const isEntrance = (value) =>
  Array.isArray(value) && [2, 3].includes(value.length) && value.every(Number.isFinite);

/** The entrances of a plan: x, y, m, and how wide, if that is known; none where one is something else. @param {Plan} plan @returns {number[][]} */
export function entrancesOf({ event }) {
  const entrances = event?.entrances;
  return Array.isArray(entrances) && entrances.every(isEntrance) ? entrances : [];
}

/** The street of a plan, if it is one that can be drawn. @param {Plan} plan @returns {Point[]} */
export function streetOf({ route }) {
  return pointsOf(route?.street?.points);
}

/** Whether the head of a plan comes by a place in its street. @param {Plan} plan @param {Point} place */
export function besideStreet(plan, [x, y]) {
  const street = streetOf(plan);
  return street.some(([u, v], n) => {
    const [dx, dy] = n ? [street[n - 1][0] - u, street[n - 1][1] - v] : [0, 0];
    const share = ((x - u) * dx + (y - v) * dy) / (dx * dx + dy * dy || 1);
    const at = Math.min(Math.max(share, 0), 1);
    return Math.hypot(u + at * dx - x, v + at * dy - y) <= BESIDE;
  });
}

/** Where the head of a plan rests, by the numbers of its cues. @param {Plan} plan @returns {[number, Record<string, any>][]} */
export function restsOf({ cues }) {
  const all = Array.isArray(cues?.cue) ? [...cues.cue.entries()] : [];
  return all.filter(([, one]) => one?.kind === "hold" && (isPoint(one.place) || one.round));
}

/** What a rest is called. @param {Record<string, any>} cue */
export function restName({ text, text_zh, round }) {
  const own = text || text_zh;
  return round ? _("rest before round {n}", { n: round }) : own || _("rest");
}

/** All that stands on the square of a plan, its edge first; the street to it, and where the head rests. @param {Plan} plan @returns {Thing[]} */
export function thingsOf(plan) {
  const { venue, route } = plan;
  /** @type {Thing[]} */
  const found = [];
  if (hasSquare(plan)) {
    const name = venue.name || _("the venue");
    found.push({ id: "venue", table: venue, name, alone: { route: {}, venue } });
  }
  for (const [n, table] of obstaclesOf(plan).entries()) {
    const name = obstacleName(table, n);
    found.push({ id: `obstacle.${n}`, table, name, alone: { route: {}, obstacle: [table] } });
  }
  for (const [n, one] of entrancesOf(plan).entries()) {
    const name = _("entrance {n}", { n: n + 1 });
    const alone = { route: {}, event: { entrances: [one] } };
    found.push({ id: `entrance.${n}`, table: { width: one[2] }, name, alone });
  }
  if (streetOf(plan).length) {
    const alone = { route: { street: route.street } };
    found.push({ id: "route.street", table: route.street, name: _("street"), alone });
  }
  for (const [n, table] of restsOf(plan)) {
    const alone = { route: {}, cues: { cue: [table] } };
    found.push({ id: `cues.cue.${n}`, table, name: restName(table), alone });
  }
  return found;
}

/** What an obstacle is called. @param {Record<string, any>} one @param {number} n its number, from 0 */
export function obstacleName({ name }, n) {
  return name || _("obstacle {n}", { n: n + 1 });
}

/** What the other things of a plan are called there: no two may be called alike. @param {Plan} plan @param {string} [but] the id of one that does not count */
export function namesTaken(plan, but) {
  const { venue } = plan;
  /** @type {[string, string][]} */
  const names = obstaclesOf(plan).map(({ name }, n) => [`obstacle.${n}`, name || `obstacle ${n + 1}`]);
  if (hasSquare(plan)) names.push(["venue", venue.name || "venue"]);
  return new Set(names.filter(([id]) => id !== but).map(([, name]) => name));
}

/** A plan with something more on its square. @param {Plan} plan @param {Sort} sort @param {Point[]} points its centre, or its corners @returns {{ plan: Plan, id: string }} */
export function withThing(plan, sort, points) {
  const copy = structuredClone(plan);
  const made = SORTS[sort].made(points);
  if (sort === "entrance") {
    const entrances = [...(copy.event?.entrances ?? []), made];
    copy.event = { ...copy.event, entrances };
    return { plan: copy, id: `entrance.${entrances.length - 1}` };
  }
  if (sort === "street") return { plan: withStreet(copy, made), id: "route.street" };
  if (sort === "rest")
    return { plan: withRests(copy, [made]), id: `cues.cue.${copy.cues.cue.length - 1}` };
  if (sort === "edge") {
    const { rectangle: _rectangle, centre: _centre, angle: _angle, ...kept } = copy.venue;
    copy.venue = { ...kept, ...made };
    return { plan: copy, id: "venue" };
  }
  const taken = namesTaken(plan);
  const word = SORTS[sort].name();
  let name = word;
  for (let n = 2; taken.has(name); n++) name = `${word} ${n}`;
  copy.obstacle = [...(copy.obstacle ?? []), { ...made, name }];
  return { plan: copy, id: `obstacle.${copy.obstacle.length - 1}` };
}

/** A plan whose dance begins in a street: when and where it began and ended before says nothing then. @param {Plan} plan @param {object} street @returns {Plan} */
function withStreet(plan, street) {
  const { start: _start, end: _end, position: _position, ...walk } = plan.walk;
  return { ...plan, walk, route: { ...plan.route, street } };
}

/** A plan, the page's own copy, with more rests. @param {Plan} plan @param {object[]} rests @returns {Plan} */
function withRests(plan, rests) {
  plan.cues = { ...plan.cues, cue: [...(plan.cues?.cue ?? []), ...rests] };
  if (plan.walk.end) plan.walk.end = null; // the dance takes longer
  return plan;
}

/** A plan whose head rests before each further round in which it does not yet. @param {Plan} plan @returns {Plan} */
export function withRounds(plan) {
  const rested = restsOf(plan).map(([, { round }]) => round);
  const further = Array.from({ length: plan.route.rounds - 1 }, (_round, n) => n + 2);
  const rests = further.filter((round) => !rested.includes(round));
  return withRests(
    structuredClone(plan),
    rests.map((round) => ({ kind: "hold", round, hold: REST })),
  );
}

/** A plan with a square about some ground, in whole metres. @param {Plan} plan @param {[number, number, number, number]} ground left, bottom, right, top, m */
export function withSquare(plan, [left, bottom, right, top]) {
  const copy = structuredClone(plan);
  const middle = (/** @type {number} */ low, /** @type {number} */ high) =>
    Number((0.5 * (low + high)).toFixed(1));
  const taken = namesTaken(plan);
  copy.venue = {
    rectangle: [Math.ceil(right - left), Math.ceil(top - bottom)],
    centre: [middle(left, right), middle(bottom, top)],
    ...(taken.has(_("square")) ? {} : { name: _("square") }),
  };
  return copy;
}

/** The radius of a round square, m; null of others. @param {Record<string, any>} venue */
export function radiusOf({ boundary }) {
  const corners = pointsOf(boundary);
  if (corners.length < ROUND) return null;
  const [x, y] = meanOf(corners);
  const far = corners.map(([u, v]) => Math.hypot(u - x, v - y));
  const [least, most] = [Math.min(...far), Math.max(...far)];
  return most - least < ALIKE ? Number(most.toFixed(2)) : null;
}

/** A plan whose square has another size, about the same middle. @param {Plan} plan @param {number | Point} size length and width, or a radius, m @returns {Plan} */
export function withSize(plan, size) {
  const { boundary, ...venue } = plan.venue;
  const centre = boundary
    ? meanOf(boundary).map((at) => Number(at.toFixed(2)))
    : (venue.centre ?? [0, 0]);
  if (typeof size !== "number") return { ...plan, venue: { ...venue, rectangle: size, centre } };
  const corners = Array.from({ length: SOLVE_WISHES.CORNERS }, (_corner, n) => {
    const angle = (2 * Math.PI * n) / SOLVE_WISHES.CORNERS;
    const [x, y] = [centre[0] + size * Math.cos(angle), centre[1] + size * Math.sin(angle)];
    return [Number(x.toFixed(3)), Number(y.toFixed(3))];
  });
  return withThing(plan, "edge", /** @type {Point[]} */ (corners)).plan;
}

/** The middle of points. @param {Point[]} points @returns {Point} */
export function meanOf(points) {
  const sum = (/** @type {0 | 1} */ k) => points.reduce((all, point) => all + point[k], 0);
  return [sum(0) / points.length, sum(1) / points.length];
}

/** A plan without a thing of its square. @param {Plan} plan @param {string} id */
export function withoutThing(plan, id) {
  const copy = structuredClone(plan);
  const [table, n] = id.split(".");
  if (table === "route") {
    delete copy.route.street;
    if (!(copy.route.rounds > 1)) delete copy.route.outer_radius;
  } else if (table === "cues") {
    copy.cues.cue.splice(Number(id.split(".")[2]), 1);
    if (!copy.cues.cue.length) delete copy.cues.cue;
  } else if (table === "venue") {
    delete copy.venue;
    delete copy.limits.venue_margin;
  } else if (table === "obstacle") {
    copy.obstacle.splice(Number(n), 1);
    if (!copy.obstacle.length) delete copy.obstacle;
  } else {
    copy.event.entrances.splice(Number(n), 1);
    if (!copy.event.entrances.length) delete copy.event.entrances;
    if (!Object.keys(copy.event).length) delete copy.event;
  }
  return copy;
}

/** A plan with another value at a place of its data, such as obstacle.0.size.1; null: without it. @param {Plan} plan @param {string} key @param {unknown} value @returns {Plan} */
export function withAt(plan, key, value) {
  const copy = structuredClone(plan);
  const names = key.split(".");
  const last = /** @type {string} */ (names.pop());
  const table = names.reduce((/** @type {any} */ at, name) => (at[name] ??= {}), copy);
  if (value === null && Array.isArray(table)) table.splice(Number(last), 1);
  else if (value === null) delete table[last];
  else table[last] = value;
  return copy;
}
