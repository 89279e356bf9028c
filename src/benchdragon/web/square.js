// What stands on the square: how near benches are to it, and how it is drawn.

import { overlap } from "./labels.js";
import { _, language, shortLength } from "./words.js";

/** @typedef {import("./messages").DrawnObstacle} DrawnObstacle */
/** @typedef {import("./nearness.js").Boxes} Boxes */
/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./paint.js").Inks} Inks */
/** @typedef {import("./labels.js").Tag} Tag */
/** @typedef {[number, number]} Point */

/**
 * How near a bench is to an obstacle (numbers from 0): distance, m, 0 where it touches or stands where
 * none may, and the points of both where they are nearest.
 * @typedef {{i: number, obstacle: number, distance: number, from: [number, number], to: [number, number]}} Beside
 */

/** A name, whether it stands within what it names, and the upright rectangle about that, m. @typedef {{ text: string, inner: boolean, left: number, right: number, top: number, bottom: number }} Named */

/** Benches times sides that are looked at for each picture: some milliseconds. */
const MOST_SIDES = 400_000;
/** Names are written in a picture of no more obstacles. */
const MOST_NAMES = 40;
const NAME_SIZE = 13;
/** From what is named to its name, above or below and beside; from an edge to its own, CSS pixels. */
const [ABOVE, BESIDE, WITHIN] = [3, 5, 6];
/** Rings that stand for entrances, and posts beside them, CSS pixels. */
const ENTRANCE = 7;
const POST = 4;
/** Posts nearer to an entrance than so many times its width are its own. */
const POSTED = 0.75;

/** What an entrance is called, with its width, m, if that is known. @param {number} n its number, from 0 @param {number} [width] */
function entranceName(n, width) {
  return width ? _("entrance {n}: {width} m", { n: n + 1, width }) : _("entrance {n}", { n: n + 1 });
}

/** An obstacle's sides, of an edge with a gate those beside it; of a circle its centre, as a side without length. @param {DrawnObstacle} one @returns {[Point, Point][]} */
function sidesOf({ kind, points, open = [] }) {
  if (kind === "circle") return [[points[0], points[0]]];
  const closed = open.length ? open : [...points, points[0]];
  const corners = kind === "line" ? points : closed;
  return corners.slice(1).map((end, n) => [corners[n], end]);
}

export class Square {
  /** @param {import("./messages").Dance} sent whose `ground` is outlines of what the dance covers */
  constructor({ obstacles, ground, entrances }) {
    this.obstacles = obstacles;
    this.ground = ground;
    this.entrances = entrances ?? [];
    this.sides = obstacles.map(sidesOf);
    /** Where edges end beside gates and entrances, m. */
    this.posts = obstacles.flatMap(({ left = [] }) =>
      left.flatMap((line) => [line[0], line[line.length - 1]]),
    );
    const count = this.sides.reduce((sum, { length }) => sum + length, 0);
    /** How many sides there are in all. */
    this.count = count;
    /** Benches that touch something now, numbers from 0. @type {Set<number>} */
    this.touching = new Set();
  }

  /**
   * Find the benches that touch; the bench nearest to an obstacle. Null where there are none, or too many.
   * @param {Boxes} boxes
   * @returns {Beside | null}
   */
  measure(boxes) {
    this.touching.clear();
    if (!this.count || this.count * boxes.count > MOST_SIDES) return null;
    /** @type {Beside | null} */
    let best = null;
    for (let n = 0; n < this.obstacles.length; n++) {
      for (let i = 0; i < boxes.count; i++) {
        const far = Math.max(best ? best.distance : Infinity, boxes.touch);
        const found = this.#near(boxes, i, n, far);
        if (!found) continue;
        if (found.distance <= boxes.touch) this.touching.add(i);
        if (!best || found.distance < best.distance) best = found;
      }
    }
    return best;
  }

  /** How near a bench is to an obstacle (numbers from 0). @param {Boxes} boxes @param {number} i @param {number} n */
  pair(boxes, i, n) {
    return this.#near(boxes, i, n, Infinity);
  }

  /** The same, if it is no farther than `far`, m; else null. @param {Boxes} boxes @param {number} i @param {number} n @param {number} far @returns {Beside | null} */
  #near(boxes, i, n, far) {
    const { radius, points } = this.obstacles[n];
    const middle = boxes.point(i, 0, 0);
    /** @type {Beside | null} */
    let best = null;
    for (const [a, b] of this.sides[n]) {
      const centre = Math.hypot(0.5 * (a[0] + b[0]) - middle[0], 0.5 * (a[1] + b[1]) - middle[1]);
      const reach = 0.5 * Math.hypot(b[0] - a[0], b[1] - a[1]) + boxes.radius[i] + radius;
      if (centre - reach > Math.min(far, best ? best.distance : Infinity)) continue;
      const [from, to] = nearest(boxes, i, a, b);
      const apart = Math.hypot(to[0] - from[0], to[1] - from[1]);
      const distance = Math.max(apart - radius, 0);
      if (best && distance >= best.distance) continue;
      const share = apart > 0 ? Math.min(radius / apart, 1) : 0;
      /** @type {Point} */
      const edge = [to[0] + share * (from[0] - to[0]), to[1] + share * (from[1] - to[1])];
      best = { i, obstacle: n, distance, from, to: edge };
    }
    if (this.#forbids(n, middle))
      best = { i, obstacle: n, distance: 0, from: middle, to: best ? best.to : points[0] };
    return best;
  }

  /** Whether a point lies where none may. @param {number} n @param {Point} point */
  #forbids(n, [x, y]) {
    const { kind, open } = this.obstacles[n];
    if (kind === "line" || kind === "circle" || open?.length) return false;
    let inside = false;
    for (const [a, b] of this.sides[n]) {
      if (a[1] > y !== b[1] > y && x < a[0] + ((y - a[1]) / (b[1] - a[1])) * (b[0] - a[0]))
        inside = !inside;
    }
    return kind === "venue" ? !inside : inside;
  }

  /** Corners of upright rectangles about all of it, m. @returns {Point[]} */
  corners() {
    const found = this.obstacles.flatMap(({ points, radius }) =>
      points.flatMap(
        ([x, y]) =>
          /** @type {Point[]} */ ([
            [x - radius, y - radius],
            [x + radius, y + radius],
          ]),
      ),
    );
    return [...found, ...this.entrances.map(([x, y]) => /** @type {Point} */ ([x, y]))];
  }

  /** In words how near the nearest bench is. @param {Beside | null} near @param {number} touch m */
  text(near, touch) {
    if (!near) return "";
    const { kind, name } = this.obstacles[near.obstacle];
    const words = { bench: near.i + 1, name: name[language()], gap: shortLength(near.distance) };
    if (near.distance > touch)
      return kind === "venue" ? _("{gap} to the edge of {name}", words) : _("{gap} to {name}", words);
    return kind === "venue"
      ? _("bench {bench} leaves {name}", words)
      : _("bench {bench} touches {name}", words);
  }

  /** Draw the ground that the dance covers. @param {CanvasRenderingContext2D} ctx @param {Camera} camera @param {Inks} inks */
  cover(ctx, camera, inks) {
    ctx.beginPath();
    for (const ring of this.ground) chain(ctx, camera, ring, true);
    ctx.fillStyle = inks.edge;
    ctx.fill("evenodd");
  }

  /**
   * Draw it.
   * @param {CanvasRenderingContext2D} ctx
   * @param {Camera} camera
   * @param {Inks} inks
   * @param {CanvasPattern} dots
   */
  paint(ctx, camera, inks, dots) {
    for (const one of this.obstacles) {
      shade(ctx, camera, one, inks.quiet);
      ctx.beginPath();
      if (one.left?.length) for (const line of one.left) chain(ctx, camera, line, false);
      else outline(ctx, camera, one);
      if (one.kind !== "line" && one.kind !== "venue") {
        ctx.fillStyle = inks.obstacle;
        ctx.fill();
        ctx.fillStyle = dots;
        ctx.fill();
      }
      ctx.strokeStyle =
        one.kind === "venue" ? inks.edge : one.kind === "line" ? inks.obstacle : inks.ink;
      ctx.lineWidth = one.kind === "venue" ? 3 : one.kind === "line" ? 4 : 1.2;
      ctx.stroke();
    }
    for (const post of this.posts) disc(ctx, camera.toScreen(...post), POST, inks.edge, inks.edge);
    for (const [x, y, width = 0] of this.entrances) {
      const at = camera.toScreen(x, y);
      const posted = this.posts.some(([u, v]) => Math.hypot(u - x, v - y) < POSTED * width);
      if (!posted) disc(ctx, at, 0.5 * width * camera.scale, null, inks.edge);
      disc(ctx, at, ENTRANCE, inks.ground, inks.edge);
    }
  }

  /** Names, and the upright rectangles about what they name. @param {Camera} camera @returns {Named[]} */
  #names(camera) {
    const { scale } = camera;
    const entrances = this.entrances.map(([x, y, width], n) => ({
      text: entranceName(n, width),
      inner: false,
      left: x - ENTRANCE / scale,
      right: x + ENTRANCE / scale,
      top: y + ENTRANCE / scale,
      bottom: y - ENTRANCE / scale,
    }));
    const obstacles = this.obstacles.map(({ kind, name, points, radius }) => {
      const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
      const [left, right] = [Math.min(...xs) - radius, Math.max(...xs) + radius];
      const [bottom, top] = [Math.min(...ys) - radius, Math.max(...ys) + radius];
      return { text: name[language()], inner: kind === "venue", left, right, top, bottom };
    });
    return [...obstacles, ...entrances];
  }

  /** Write the names, beside what they name, and none on another: one that finds no place is left out; where they stand. @param {CanvasRenderingContext2D} ctx @param {Camera} camera @param {Inks} inks @param {string} font @returns {Tag[]} */
  name(ctx, camera, inks, font) {
    const across = this.corners().map(([x]) => x);
    if (!across.length || this.obstacles.length > MOST_NAMES) return [];
    const middle = 0.5 * (Math.min(...across) + Math.max(...across));
    ctx.font = `600 ${NAME_SIZE}px ${font}`;
    ctx.lineWidth = 4;
    ctx.lineJoin = "round";
    ctx.strokeStyle = inks.ground;
    ctx.fillStyle = inks.ink;
    [ctx.textAlign, ctx.textBaseline] = ["center", "middle"];
    /** @type {Tag[]} */
    const tags = [];
    for (const named of this.#names(camera)) {
      const half = 0.5 * ctx.measureText(named.text).width;
      const places = placesOf(named, half, middle, camera);
      const tag = places.find((place) => !tags.some((other) => overlap(place, other)));
      if (!tag) continue;
      ctx.strokeText(named.text, tag.x, tag.y);
      ctx.fillText(named.text, tag.x, tag.y);
      tags.push(tag);
    }
    ctx.lineJoin = "miter";
    return tags;
  }
}

/** Where a name may stand, best first: above what it names, towards the middle of all; an edge's within it. @param {Named} named @param {number} half of its width, CSS pixels @param {number} middle x of the middle of all, m @param {Camera} camera @returns {Tag[]} */
function placesOf({ inner, left, right, top, bottom }, half, middle, camera) {
  const tall = 0.5 * NAME_SIZE;
  const [[west, up], [east, down]] = [camera.toScreen(left, top), camera.toScreen(right, bottom)];
  if (inner) {
    const [from, to] = [west + WITHIN + half, east - WITHIN - half];
    const [high, low] = [up + WITHIN + tall, down - WITHIN - tall];
    return [from, to].flatMap((x) => [high, low].map((y) => ({ x, y, half, tall })));
  }
  const sides = [west + half, east - half];
  if (0.5 * (left + right) > middle) sides.reverse();
  const rows = [up - ABOVE - tall, down + ABOVE + tall];
  const beside = [east + BESIDE + half, west - BESIDE - half];
  return [
    ...rows.flatMap((y) => sides.map((x) => ({ x, y, half, tall }))),
    ...beside.map((x) => ({ x, y: 0.5 * (up + down), half, tall })),
  ];
}

/** Shade where benches would come nearer to an obstacle than they may: a margin about it, of the venue within. @param {CanvasRenderingContext2D} ctx @param {Camera} camera @param {DrawnObstacle} one @param {string} colour */
function shade(ctx, camera, one, colour) {
  if (!one.margin) return;
  ctx.save();
  ctx.beginPath();
  outline(ctx, camera, one);
  if (one.kind === "venue") ctx.clip();
  ctx.globalAlpha = 0.3;
  ctx.strokeStyle = colour;
  ctx.lineWidth = 2 * one.margin * camera.scale;
  ctx.lineJoin = ctx.lineCap = "round";
  ctx.stroke();
  ctx.restore();
}

/** Draw a disc, filled or not, on the screen. @param {CanvasRenderingContext2D} ctx @param {Point} at @param {number} radius CSS pixels @param {string | null} fill @param {string} edge */
function disc(ctx, at, radius, fill, edge) {
  ctx.beginPath();
  ctx.arc(...at, radius, 0, 2 * Math.PI);
  if (fill) ctx.fillStyle = fill;
  if (fill) ctx.fill();
  ctx.strokeStyle = edge;
  ctx.lineWidth = fill ? 3 : 1.2;
  ctx.stroke();
}

/** Put an obstacle's outline into the path. @param {CanvasRenderingContext2D} ctx @param {Camera} camera @param {DrawnObstacle} one */
function outline(ctx, camera, { kind, points, radius }) {
  if (kind !== "circle") {
    chain(ctx, camera, points, kind !== "line");
    return;
  }
  const [x, y] = camera.toScreen(...points[0]);
  ctx.moveTo(x + radius * camera.scale, y);
  ctx.arc(x, y, radius * camera.scale, 0, 2 * Math.PI);
}

/** @param {CanvasRenderingContext2D} ctx @param {Camera} camera @param {Point[]} points @param {boolean} closed */
function chain(ctx, camera, points, closed) {
  points.forEach((point, n) => {
    const at = camera.toScreen(...point);
    if (n) ctx.lineTo(...at);
    else ctx.moveTo(...at);
  });
  if (closed) ctx.closePath();
}

/** Points of a bench and of a side where they are nearest; the same twice where they meet. @param {Boxes} boxes @param {number} i @param {Point} a @param {Point} b @returns {[Point, Point]} */
function nearest(boxes, i, a, b) {
  const [p, q] = [boxes.offset(i, ...a), boxes.offset(i, ...b)];
  const [half, wide] = [boxes.half[i], boxes.wide[i]];
  const inside = clipped(p, q, half, wide);
  if (inside !== null) {
    const at = boxes.point(i, p[0] + inside * (q[0] - p[0]), p[1] + inside * (q[1] - p[1]));
    return [at, at];
  }
  let least = Infinity;
  /** @type {[Point, Point]} */
  let found = [a, a];
  const tell = (/** @type {Point} */ mine, /** @type {Point} */ its) => {
    const far = Math.hypot(mine[0] - its[0], mine[1] - its[1]);
    if (far < least) [least, found] = [far, [mine, its]];
  };
  for (const end of [p, q]) tell([bounded(end[0], -half, half), bounded(end[1], -wide, wide)], end);
  const [dx, dy] = [q[0] - p[0], q[1] - p[1]];
  const square = dx * dx + dy * dy;
  for (let n = 0; n < 4 && square > 0; n++) {
    /** @type {Point} */
    const corner = [n === 0 || n === 3 ? half : -half, n < 2 ? wide : -wide];
    const share = bounded(((corner[0] - p[0]) * dx + (corner[1] - p[1]) * dy) / square, 0, 1);
    tell(corner, [p[0] + share * dx, p[1] + share * dy]);
  }
  return [boxes.point(i, ...found[0]), boxes.point(i, ...found[1])];
}

/** @param {number} value @param {number} low @param {number} high */
function bounded(value, low, high) {
  return Math.min(Math.max(value, low), high);
}

/** Middle of what of a line lies in an upright rectangle about the origin, as a share of it; null if nothing. @param {Point} p @param {Point} q @param {number} half @param {number} wide */
function clipped(p, q, half, wide) {
  let [from, to] = [0, 1];
  for (const [n, most] of [
    [0, half],
    [1, wide],
  ]) {
    const way = q[n] - p[n];
    if (way === 0) {
      if (Math.abs(p[n]) > most) return null;
      continue;
    }
    const [one, two] = [(-most - p[n]) / way, (most - p[n]) / way];
    from = Math.max(from, Math.min(one, two));
    to = Math.min(to, Math.max(one, two));
  }
  return from <= to ? 0.5 * (from + to) : null;
}
