// What of a plan can be taken hold of in the picture, where it lies, and what becomes of the plan with it
// elsewhere. Lengths in metres, angles in degrees to the left.

import { fieldOf } from "./plan_form.js";
import {
  entrancesOf,
  hasSquare,
  meanOf,
  obstacleName,
  obstaclesOf,
  restName,
  restsOf,
  streetOf,
} from "./things.js";
import { _, decimals } from "./words.js";

/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {[number, number]} Point */

/**
 * A place of the plan that can be moved.
 * @typedef {object} Grip
 * @property {string} id the same for the same place of other plans
 * @property {string} name
 * @property {Point} at
 * @property {"size" | "place" | "angle"} kind a place has two numbers, x and y
 * @property {number} value of a place x
 * @property {string} text the value, for people
 * @property {(to: Point, free: boolean) => Plan} moved the plan with it at a point, or as near as it may
 *   be; not free: at a round value
 * @property {(right: number, up: number) => Plan} stepped the plan with it so many steps further
 */

/** Round values: whole multiples of these; and of these where it is moved freely. */
const SNAP = { pitch: 0.005, turns: 0.25, radius: 0.05, place: 0.1, side: 0.1, angle: 5 };
const FREE = { pitch: 0.0001, turns: 0.01, radius: 0.001, place: 0.001, side: 0.001, angle: 0.1 };
/** @typedef {keyof typeof SNAP} Quantity */
/** Digits of a value after the point. */
const DIGITS = { pitch: 4, turns: 2, radius: 3, place: 3, side: 3, angle: 1 };
/** Sides of a rectangle and radii of circles on the square are at least so long. */
const LEAST = 0.1;
/** Outlines with more corners than this are changed in the plan file. */
const MOST_CORNERS = 40;
/** Where on its edge the disc is held, and how far behind the head the outermost coil, turns. */
const DISC_AT = -Math.PI / 4;
const COIL_BEHIND = 0.5;
/** Coils beyond the disc at which the pitch of a spiral with a turn is held. */
const COILS_OUT = 2;
/** Outlines and circles have grips of their own from so much of the lever's length on: smaller ones are moved
 * as they are, lest their grips lie over one another. */
const LEAST_SIDE = 0.7;
const LEAST_RADIUS = 0.3;
/** A disc of a turn that the plan does not say. */
const USUAL_DISC = 4.5;
/** @param {number} value @param {Quantity} quantity @param {boolean} [free] */
function rounded(value, quantity, free = false) {
  const step = (free ? FREE : SNAP)[quantity];
  return Number((Math.round(value / step) * step).toFixed(DIGITS[quantity]));
}

/** @param {Point} point @param {boolean} free @returns {Point} */
export function roundedPoint([x, y], free) {
  return [rounded(x, "place", free), rounded(y, "place", free)];
}

/** The plan with other values in one of its tables or lists. @param {Plan} plan @param {(copy: Plan) => object} part @param {object} values @returns {Plan} */
function changed(plan, part, values) {
  const copy = structuredClone(plan);
  Object.assign(part(copy), values);
  return copy;
}

/** @param {number} metres */
const metresText = (metres) => `${decimals(metres, 3).replace(/0$/, "")} m`;
/** @param {Point} point */
const pointText = ([x, y]) => `x ${metresText(x)}, y ${metresText(y)}`;

/** How a frame lies on the ground: its origin, and its direction, rad. */
export class Frame {
  /** @param {Point} origin @param {number} degrees */
  constructor(origin, degrees) {
    this.origin = origin;
    const angle = (degrees * Math.PI) / 180;
    this.c = Math.cos(angle);
    this.s = Math.sin(angle);
  }

  /** @param {Point} point of the frame @returns {Point} on the ground */
  ground([u, v]) {
    const { origin, c, s } = this;
    return [origin[0] + u * c - v * s, origin[1] + u * s + v * c];
  }

  /** @param {Point} point on the ground @returns {Point} of the frame */
  own([x, y]) {
    const [dx, dy] = [x - this.origin[0], y - this.origin[1]];
    return [dx * this.c + dy * this.s, dy * this.c - dx * this.s];
  }
}

/** Where the dance lies. @param {Plan} plan */
export function danceFrame({ route }) {
  return new Frame(route.at ?? [0, 0], route.turned ?? 0);
}

/**
 * A grip of one number.
 * @param {{ id: string, name: string, kind?: "size" | "angle", quantity: Quantity, value: number,
 *   text: string, at: Point, low: number, high: number, read: (to: Point) => number,
 *   put: (value: number) => Plan }} told `read` makes a value of a point
 * @returns {Grip}
 */
function sizeGrip({ kind = "size", quantity, low, high, read, put, ...told }) {
  // What lies beyond the usual already may stay there.
  const [least, most] = [Math.min(low, told.value), Math.max(high, told.value)];
  const set = (/** @type {number} */ value) => put(Math.min(Math.max(value, least), most));
  return {
    ...told,
    kind,
    moved: (to, free) => set(rounded(read(to), quantity, free)),
    stepped: (right, up) => set(rounded(told.value + (right + up) * SNAP[quantity], quantity, true)),
  };
}

/** A grip of a point on the ground. @param {string} id @param {string} name @param {Point} at @param {(to: Point) => Plan} put @returns {Grip} */
function placeGrip(id, name, at, put) {
  const step = SNAP.place;
  return {
    id,
    name,
    at,
    kind: "place",
    value: at[0],
    text: pointText(at),
    moved: (to, free) => put(roundedPoint(to, free)),
    stepped: (right, up) => put(roundedPoint([at[0] + right * step, at[1] + up * step], true)),
  };
}

/** A grip of a number of the form. @param {Plan} plan @param {string} key @param {string} id @param {string} name @param {Quantity} quantity @param {Point} at @param {(to: Point) => number} read */
function keyGrip(plan, key, id, name, quantity, at, read) {
  const [table, own] = key.split(".");
  const { unit, low, high } = fieldOf(key);
  const value = plan[table][own];
  const put = (/** @type {number} */ to) => changed(plan, (copy) => copy[table], { [own]: to });
  const said = unit === "m" ? metresText(value) : decimals(value, 2);
  return sizeGrip({ id, name, quantity, value, text: said, at, low, high, read, put });
}

/** Whether the plan says where its spiral runs: one in the address may leave that out. @param {Plan} plan */
export function hasSpiral({ route }) {
  const known = typeof route.pitch === "number";
  if (route.kind === "spiral-in") return known && typeof route.start_turn === "number";
  return known && route.kind === "turn";
}

/** Turns from the centre at which the pitch is held. @param {Plan} plan */
function coilOf({ route, disc }) {
  if (route.kind === "spiral-in") return Math.max(route.start_turn - COIL_BEHIND, COIL_BEHIND);
  return Math.ceil((disc?.radius ?? USUAL_DISC) / route.pitch) + COILS_OUT;
}

/** A point of the spiral, in its frame. @param {Plan} plan @param {number} turns @returns {Point} */
export function spiralPoint({ route }, turns) {
  const [radius, angle] = [turns * route.pitch, 2 * Math.PI * turns];
  const hand = route.clockwise === false ? -1 : 1;
  return [radius * Math.cos(angle), hand * radius * Math.sin(angle)];
}

/** Turns from the centre of the spiral's point that is nearest to one along its ray. @param {Plan} plan @param {Point} point */
function turnsAt({ route }, [x, y]) {
  const angle = Math.atan2(route.clockwise === false ? -y : y, x) / (2 * Math.PI);
  return angle + Math.round(Math.hypot(x, y) / route.pitch - angle);
}

/** Grips of a spiral and its disc. @param {Plan} plan @param {Plan} began the plan when the drag began: coils are counted in it */
function spiralGrips(plan, began) {
  const { route, disc } = plan;
  if (!hasSpiral(plan)) return [];
  const frame = danceFrame(plan);
  const far = (/** @type {Point} */ to) => Math.hypot(...frame.own(to));
  const coil = coilOf(began);
  const outer = frame.ground(spiralPoint(plan, coil));
  const wide = _("distance between the coils");
  const found = [keyGrip(plan, "route.pitch", "pitch", wide, "pitch", outer, (to) => far(to) / coil)];
  if (route.kind === "spiral-in") {
    const head = frame.ground(spiralPoint(plan, route.start_turn));
    const read = (/** @type {Point} */ to) => turnsAt(plan, frame.own(to));
    found.push(
      keyGrip(plan, "route.start_turn", "start", _("where the head starts"), "turns", head, read),
    );
  }
  const radius = disc?.radius;
  if (typeof radius === "number") {
    const [x, y] = frame.origin;
    /** @type {Point} */
    const edge = [x + radius * Math.cos(DISC_AT), y + radius * Math.sin(DISC_AT)];
    found.push(keyGrip(plan, "disc.radius", "disc", _("edge of the disc"), "radius", edge, far));
  }
  return found;
}

/** Grips that move and turn the whole dance, where there is a square to move it on. @param {Plan} plan @param {number} arm how far from the centre it is turned */
function danceGrips(plan, arm) {
  const { route, venue, obstacle } = plan;
  const square = venue?.boundary || venue?.rectangle || obstacle?.length;
  if (!square && !route.at && !route.turned) return [];
  const frame = danceFrame(plan);
  const put = (/** @type {object} */ values) => changed(plan, (copy) => copy.route, values);
  const turned = route.turned ?? 0;
  const read = (/** @type {Point} */ [x, y]) => {
    const angle = (Math.atan2(y - frame.origin[1], x - frame.origin[0]) * 180) / Math.PI;
    return angle + 360 * Math.round((turned - angle) / 360);
  };
  return [
    placeGrip("at", _("place of the dance"), frame.origin, (at) => put({ at })),
    sizeGrip({
      id: "turned",
      name: _("direction of the dance"),
      kind: "angle",
      quantity: "angle",
      value: turned,
      text: `${decimals(turned, 1)}\u00b0`,
      at: frame.ground([arm, 0]),
      low: -360,
      high: 360,
      read,
      put: (turned) => put({ turned }),
    }),
  ];
}

/** Grips of points that a list of the plan holds. @param {string} id @param {string} name @param {Point[]} points on the ground @param {boolean} closed @param {number} arm @param {(points: Point[]) => Plan} put @returns {Grip[]} */
function outlineGrips(id, name, points, closed, arm, put) {
  const long = (/** @type {Point} */ from, /** @type {Point} */ to) =>
    Math.hypot(to[0] - from[0], to[1] - from[1]) >= LEAST_SIDE * arm;
  if (points.length > MOST_CORNERS || !points.some((point) => long(point, points[0]))) return [];
  const corners = points.map((at, n) =>
    placeGrip(`${id}.${n}`, _("corner {n} of {name}", { n: n + 1, name }), at, (to) =>
      put(points.map((point, k) => (k === n ? to : point))),
    ),
  );
  const sides = points.slice(0, closed ? undefined : -1).flatMap((from, n) => {
    const next = (n + 1) % points.length;
    if (!long(from, points[next])) return [];
    /** @type {Point} */
    const middle = [0.5 * (from[0] + points[next][0]), 0.5 * (from[1] + points[next][1])];
    return placeGrip(`${id}.${n}+`, _("side {n} of {name}", { n: n + 1, name }), middle, ([x, y]) => {
      const [dx, dy] = [x - middle[0], y - middle[1]];
      return put(points.map((point, k) => (k === n || k === next ? shifted(point, dx, dy) : point)));
    });
  });
  return [...sides, ...corners];
}

/** @param {Point} point @param {number} dx @param {number} dy @returns {Point} */
function shifted([x, y], dx, dy) {
  return roundedPoint([x + dx, y + dy], true);
}

/** Sides and corners of a rectangle: which of its two sizes each changes, and to which side. */
export const RECTANGLE = /** @type {const} */ ([
  [1, 0], [0, 1], [-1, 0], [0, -1], [1, 1], [-1, 1], [-1, -1], [1, -1],
]); // prettier-ignore

/**
 * Grips of a rectangle: what lies opposite stays.
 * @param {string} id
 * @param {string} name
 * @param {{ centre: Point, size: Point, angle: number }} told
 * @param {number} arm
 * @param {(centre: Point, size: Point) => Plan} put
 * @returns {Grip[]}
 */
function rectangleGrips(id, name, { centre, size, angle }, arm, put) {
  if (Math.max(...size) < LEAST_SIDE * arm) return [];
  const frame = new Frame(centre, angle);
  return RECTANGLE.map((sides, n) => {
    /** @param {Point} change of both sizes @param {boolean} free */
    const grown = (change, free) => {
      const grownSize = /** @type {Point} */ (
        size.map((side, k) =>
          sides[k] ? Math.max(rounded(side + change[k], "side", free), LEAST) : side,
        )
      );
      const by = sides.map((side, k) => 0.5 * side * (grownSize[k] - size[k]));
      return put(roundedPoint(frame.ground([by[0], by[1]]), true), grownSize);
    };
    const at = frame.ground([0.5 * sides[0] * size[0], 0.5 * sides[1] * size[1]]);
    const corner = sides[0] !== 0 && sides[1] !== 0;
    return {
      id: `${id}.${n}`,
      name: corner
        ? _("corner {n} of {name}", { n: n - 3, name })
        : _("side {n} of {name}", { n: n + 1, name }),
      at,
      kind: "place",
      value: size[sides[0] ? 0 : 1],
      text: `${metresText(size[0])} \u00d7 ${metresText(size[1])}`,
      moved: (to, free) => {
        const [u, v] = frame.own(to);
        return grown([sides[0] * u - 0.5 * size[0], sides[1] * v - 0.5 * size[1]], free);
      },
      stepped: (right, up) => {
        const [u, v] = new Frame([0, 0], angle).own([right * SNAP.side, up * SNAP.side]);
        return grown([sides[0] * u, sides[1] * v], true);
      },
    };
  });
}

/** Grips of the venue's edge. @param {Plan} plan @param {number} arm @returns {Grip[]} */
function venueGrips(plan, arm) {
  const { venue } = plan;
  if (!hasSquare(plan)) return [];
  const name = venue.name || _("the venue");
  const set = (/** @type {object} */ values) => changed(plan, (copy) => copy.venue, values);
  if (venue.rectangle) {
    const told = { centre: venue.centre ?? [0, 0], size: venue.rectangle, angle: venue.angle ?? 0 };
    return rectangleGrips("venue", name, told, arm, (centre, rectangle) => set({ centre, rectangle }));
  }
  const corners = /** @type {Point[]} */ (venue.boundary);
  if (corners.length <= MOST_CORNERS)
    return outlineGrips("venue", name, corners, true, arm, (boundary) => set({ boundary }));
  // A round square is moved as it is, by a point of its edge.
  const [[u, v]] = corners;
  const moved = (/** @type {Point} */ [x, y]) => corners.map((at) => shifted(at, x - u, y - v));
  return [
    placeGrip("venue", _("place of {name}", { name }), corners[0], (to) =>
      set({ boundary: moved(to) }),
    ),
  ];
}

/** Grips of what stands on the square. @param {Plan} plan @param {number} arm @returns {Grip[]} */
function obstacleGrips(plan, arm) {
  return obstaclesOf(plan).flatMap((one, n) => {
    const id = `obstacle.${n}`;
    const name = obstacleName(one, n);
    const set = (/** @type {object} */ values) => changed(plan, (copy) => copy.obstacle[n], values);
    const placed = _("place of {name}", { name });
    if (one.points) {
      const middle = meanOf(one.points);
      const move = (/** @type {Point} */ [x, y]) =>
        one.points.map((/** @type {Point} */ point) => shifted(point, x - middle[0], y - middle[1]));
      const closed = one.kind === "polygon";
      return [
        ...outlineGrips(id, name, one.points, closed, arm, (points) => set({ points })),
        placeGrip(id, placed, middle, (to) => set({ points: move(to) })),
      ];
    }
    const place = placeGrip(id, placed, one.centre, (centre) => set({ centre }));
    if (one.kind === "circle")
      return one.radius < LEAST_RADIUS * arm
        ? [place]
        : [place, circleGrip(`${id}.radius`, name, one, set)];
    const told = { centre: one.centre, size: one.size, angle: one.angle ?? 0 };
    return [...rectangleGrips(id, name, told, arm, (centre, size) => set({ centre, size })), place];
  });
}

/** The edge of a round obstacle. @param {string} id @param {string} name @param {Record<string, any>} one @param {(values: object) => Plan} set */
function circleGrip(id, name, { centre, radius }, set) {
  return sizeGrip({
    id,
    name: _("radius of {name}", { name }),
    quantity: "side",
    value: radius,
    text: metresText(radius),
    at: [centre[0] + radius, centre[1]],
    low: LEAST,
    high: Infinity,
    read: ([x, y]) => Math.hypot(x - centre[0], y - centre[1]),
    put: (to) => set({ radius: to }),
  });
}

/** Grips of where people come in. @param {Plan} plan @returns {Grip[]} */
function entranceGrips(plan) {
  return entrancesOf(plan).map(([x, y, ...width], n) =>
    placeGrip(`entrance.${n}`, _("entrance {n}", { n: n + 1 }), [x, y], (to) =>
      changed(plan, (copy) => copy.event.entrances, { [n]: [...to, ...width] }),
    ),
  );
}

/** Grips of the points of a drawn route or of a street, and of where the head rests. @param {Plan} plan @returns {Grip[]} */
function wayGrips(plan) {
  const { kind, points = [] } = plan.route;
  const frame = danceFrame(plan);
  /** @param {string} id @param {string} name @param {Point} at @param {(copy: Plan) => object} part @param {string | number} key @param {(to: Point) => Point} [own] */
  const held = (id, name, at, part, key, own = (to) => to) =>
    placeGrip(id, name, at, (to) => changed(plan, part, { [key]: own(to) }));
  const few = (/** @type {Point[]} */ line) => (line.length > MOST_CORNERS ? [] : line);
  const inDance = (/** @type {Point} */ to) => roundedPoint(frame.own(to), true);
  const drawn = few(kind === "drawn" ? (points ?? []) : []).map((point, n) => {
    const name = _("point {n} of the route", { n: n + 1 });
    return held(`drawn.${n}`, name, frame.ground(point), (copy) => copy.route.points, n, inDance);
  });
  const street = few(streetOf(plan)).map((point, n) => {
    const name = _("point {n} of the street", { n: n + 1 });
    return held(`route.street.${n}`, name, point, (copy) => copy.route.street.points, n);
  });
  const rests = restsOf(plan)
    .filter(([, { place }]) => place)
    .map(([n, one]) => {
      const name = _("place of {name}", { name: restName(one) });
      return held(`cues.cue.${n}`, name, one.place, (copy) => copy.cues.cue[n], "place");
    });
  return [...drawn, ...street, ...rests];
}

/**
 * All grips of a plan; of what lies one over the other the last is on top.
 * @param {Plan} plan
 * @param {number} arm length of the lever that turns the dance
 * @param {Plan} [began] the plan when the drag under way began
 * @returns {Grip[]}
 */
export function gripsOf(plan, arm, began = plan) {
  return [
    ...venueGrips(plan, arm),
    ...obstacleGrips(plan, arm),
    ...entranceGrips(plan),
    ...wayGrips(plan),
    ...danceGrips(plan, arm),
    ...spiralGrips(plan, began),
  ];
}
