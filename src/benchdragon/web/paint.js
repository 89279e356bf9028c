// Draws a dance at one instant onto a canvas: ground, route, benches to scale, what is tight.

import { shade, shades, TOUCH } from "./colours.js";
import { Covered } from "./covered.js";
import { Dress } from "./dragon.js";
import { Beside, numberHeight, numberTags, overlap } from "./labels.js";
import {
  drawNorth,
  drawRuler,
  drawScaleBar,
  FONT,
  halfWidth,
  lettering,
  patternOf,
  writeLabel,
} from "./notes.js";
import { _, language, shortLength } from "./words.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./scene.js").Stand} Stand */
/** @typedef {import("./nearness.js").Boxes} Boxes */
/** @typedef {import("./nearness.js").Pair} Pair */
/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./square.js").Square} Square */
/** @typedef {import("./square.js").Beside} BesideObstacle */
/** @typedef {import("./colours.js").Scale} Scale */
/** @typedef {import("./labels.js").Tag} Tag */
/** @typedef {import("./story.js").Told} Told */
/** @typedef {import("./labels.js").Ring} Ring */

/**
 * What is to be drawn.
 * @typedef {object} Picture
 * @property {Scene} scene
 * @property {Stand} stand
 * @property {Boxes} boxes
 * @property {Square} square
 * @property {Pair | BesideObstacle | Told | null} ringed
 * @property {Camera} camera
 * @property {Scale | null} scale
 * @property {number} chosen number of the chosen bench from 0, or -1
 * @property {boolean} trails
 * @property {boolean} disc
 * @property {boolean} route
 * @property {boolean} ground whether the ground that the dance covers is drawn
 * @property {boolean} dressed whether benches are drawn as a dragon's, where colours tell nothing else
 * @property {boolean} north whether an arrow says that up is north
 * @property {[number, number][]} ruler two points on the ground, or none
 * @property {{ paint(ctx: CanvasRenderingContext2D, camera: Camera): void } | null} below a photograph, or none
 */

/** Colours of a theme, read from the style sheet. @typedef {Record<"ground" | "ink" | "quiet" | "faint" | "body" | "head" | "disc" | "obstacle" | "edge" | "mark" | "trail" | "wood" | "grain" | "cloth" | "gold" | "lantern" | "glow" | "rib" | "horn" | "outline", string>} Inks */

const HEAD_NAMES = /** @type {const} */ ([
  "ground",
  "ink",
  "quiet",
  "faint",
  "body",
  "head",
  "disc",
  "obstacle",
  "edge",
  "mark",
  "trail",
  "wood",
  "grain",
  "cloth",
  "gold",
  "lantern",
  "glow",
  "rib",
  "horn",
  "outline",
]);
/** How much of its colour the ground that the dance covers has. */
const GROUND = 0.1;
/** Seconds of trail, and points drawn of it. */
const TRAIL = 20;
const TRAIL_POINTS = 80;
/** Half width of a head, CSS pixels, from which its brow is drawn to scale. */
const SMALLEST_BROW = 3;
/** CSS pixels of a bench from which handles are drawn. */
const HANDLES_FROM = 70;
/** Labels of a ring are no farther from it, CSS pixels. */
const ABOUT = 500;
/** How much of its colour what touches has over a drawn dragon, which stays to be seen. */
const TOUCH_OVER = 0.84;
/** What a label costs that hides the benches it tells of: more than any others. */
const OF_THE_PAIR = 1000;
/** And one that hides the name of what stands on the square: more than as many benches as there is room for. */
const OF_A_NAME = 200;
/** @param {Element} element @returns {Inks} */
function inks(element) {
  const style = getComputedStyle(element);
  const found = HEAD_NAMES.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]);
  return /** @type {Inks} */ (Object.fromEntries(found));
}

export class Painter {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.ctx = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    /** @type {Inks} */
    this.inks = inks(canvas);
    /** @type {Scene | null} */
    this.routeOf = null;
    this.routePath = new Path2D();
    this.hatch = patternOf("lines");
    this.dots = patternOf("dots");
    this.beside = new Beside();
    /** The ground that a dance covers. @type {Covered | null} */
    this.covered = null;
  }

  /** @param {Camera} camera @param {number} density dots for each CSS pixel */
  resize({ width, height }, density) {
    this.canvas.width = Math.max(Math.round(width * density), 1);
    this.canvas.height = Math.max(Math.round(height * density), 1);
  }

  /** Read the theme again. */
  dress() {
    this.inks = inks(this.canvas);
  }

  /** @param {Picture} picture */
  paint(picture) {
    const { ctx, canvas } = this;
    const { camera } = picture;
    const density = canvas.width / camera.width;
    ctx.setTransform(density, 0, 0, density, 0, 0);
    ctx.fillStyle = this.inks.ground;
    ctx.fillRect(0, 0, camera.width, camera.height);
    picture.below?.paint(ctx, camera);
    if (picture.ground) this.#ground(picture);
    else this.covered = null;
    picture.square.paint(ctx, camera, this.inks, this.dots);
    if (picture.route) this.#route(picture, density);
    if (picture.disc) this.#disc(picture);
    if (picture.trails) this.#trails(picture);
    const seen = this.#seen(picture.boxes, camera);
    this.#benches(picture, seen);
    this.#chosen(picture);
    this.#touches(picture);
    this.#handles(picture, seen);
    const names = picture.square.name(ctx, camera, this.inks, FONT);
    const ring = picture.ringed && ringOf(picture.ringed, picture.camera);
    this.#numbers(picture, seen, ring, names);
    if (picture.ringed && ring) this.#ring(picture, seen, picture.ringed, ring, names);
    drawScaleBar(ctx, camera, this.inks);
    if (picture.north) drawNorth(ctx, camera, this.inks);
    drawRuler(ctx, camera, this.inks, picture.ruler);
  }

  /** Whether more of the picture is still to be painted. */
  get unfinished() {
    return this.covered !== null && !this.covered.done;
  }

  /** The ground that the dance covers: as outlines where those are known, else painted by and by. @param {Picture} picture */
  #ground({ scene, square, camera }) {
    const { ctx, inks } = this;
    ctx.globalAlpha = GROUND;
    if (square.ground.length) square.cover(ctx, camera, inks);
    else {
      if (this.covered?.scene !== scene || this.covered.colour !== inks.edge)
        this.covered = new Covered(scene, inks.edge);
      if (!this.covered.done) this.covered.paint();
      this.covered.draw(ctx, camera);
    }
    ctx.globalAlpha = 1;
  }

  /** @param {Picture} picture @param {number} density */
  #route({ scene, camera }, density) {
    if (this.routeOf !== scene) {
      this.routeOf = scene;
      this.routePath = new Path2D();
      for (const { start, step, nodes } of scene.stretches) {
        const fine = Math.max(Math.ceil(step / 0.25), 1);
        for (let n = 0; n <= (nodes - 1) * fine; n++) {
          const [x, y] = scene.point(start + (n * step) / fine);
          if (n || start !== scene.stretches[0].start) this.routePath.lineTo(x, y);
          else this.routePath.moveTo(x, y);
        }
      }
    }
    const { ctx } = this;
    const k = camera.scale * density;
    ctx.setTransform(
      k,
      0,
      0,
      -k,
      (0.5 * camera.width - camera.x * camera.scale) * density,
      (0.5 * camera.height + camera.y * camera.scale) * density,
    );
    ctx.strokeStyle = this.inks.faint;
    ctx.lineWidth = 1 / camera.scale;
    ctx.stroke(this.routePath);
    ctx.setTransform(density, 0, 0, density, 0, 0);
  }

  /** @param {Picture} picture */
  #disc({ scene, camera }) {
    if (scene.sent.disc === null) return;
    const { ctx } = this;
    const [x, y] = camera.toScreen(...scene.sent.centre);
    ctx.strokeStyle = this.inks.disc;
    ctx.lineWidth = 2;
    ctx.setLineDash([8, 5]);
    ctx.beginPath();
    ctx.arc(x, y, scene.sent.disc * camera.scale, 0, 2 * Math.PI);
    ctx.stroke();
    ctx.setLineDash([]);
  }

  /** The way that the head and the chosen bench came in the last seconds. @param {Picture} picture */
  #trails({ scene, stand, camera, chosen }) {
    const { ctx } = this;
    ctx.strokeStyle = this.inks.trail;
    ctx.lineCap = "round";
    for (const handle of new Set([0, Math.max(chosen, 0)])) {
      const back = Math.max(stand.v[handle], 0.05) * TRAIL;
      for (let n = 0; n < TRAIL_POINTS; n++) {
        const [from, to] = [n, n + 1].map((m) => stand.s[handle] - back * (1 - m / TRAIL_POINTS));
        if (from < scene.stretches[0].start) continue;
        ctx.globalAlpha = (n + 1) / TRAIL_POINTS;
        ctx.lineWidth = Math.max(0.12 * camera.scale, 3);
        ctx.beginPath();
        ctx.moveTo(...camera.toScreen(...scene.point(from)));
        ctx.lineTo(...camera.toScreen(...scene.point(to)));
        ctx.stroke();
      }
    }
    ctx.globalAlpha = 1;
    ctx.lineCap = "butt";
  }

  /** Put the outline of a bench into the path. @param {Boxes} boxes @param {Camera} camera @param {number} i */
  #outline(boxes, camera, i) {
    const { ctx } = this;
    const px = 0.5 * camera.width + (boxes.x[i] - camera.x) * camera.scale;
    const py = 0.5 * camera.height - (boxes.y[i] - camera.y) * camera.scale;
    const ax = boxes.ux[i] * boxes.half[i] * camera.scale;
    const ay = -boxes.uy[i] * boxes.half[i] * camera.scale;
    const bx = -boxes.uy[i] * boxes.wide[i] * camera.scale;
    const by = -boxes.ux[i] * boxes.wide[i] * camera.scale;
    ctx.moveTo(px + ax + bx, py + ay + by);
    ctx.lineTo(px - ax + bx, py - ay + by);
    ctx.lineTo(px - ax - bx, py - ay - by);
    ctx.lineTo(px + ax - bx, py + ay - by);
    ctx.closePath();
  }

  /** Benches that the canvas shows. @param {Boxes} boxes @param {Camera} camera */
  #seen(boxes, camera) {
    const right = (0.5 * camera.width) / camera.scale;
    const top = (0.5 * camera.height) / camera.scale;
    const seen = [];
    for (let i = 0; i < boxes.count; i++) {
      const room = boxes.radius[i];
      if (
        Math.abs(boxes.x[i] - camera.x) < right + room &&
        Math.abs(boxes.y[i] - camera.y) < top + room
      )
        seen.push(i);
    }
    return seen;
  }

  /** @param {Picture} picture @param {number[]} seen */
  #benches(picture, seen) {
    const { ctx } = this;
    const { boxes, camera, scale } = picture;
    if (this.#dresses(picture)) {
      this.#dressOf(boxes).paint(ctx, boxes, camera, this.inks, seen);
      return;
    }
    /** @type {Map<string, number[]>} */
    const groups = new Map();
    const colours = scale ? shades(scale) : [];
    for (const i of seen) {
      const colour = this.#colour(picture, colours, i);
      const group = groups.get(colour);
      if (group) group.push(i);
      else groups.set(colour, [i]);
    }
    ctx.strokeStyle = this.inks.ink;
    ctx.lineWidth = Math.min(Math.max(0.02 * camera.scale, 0.4), 1.5);
    for (const [colour, group] of groups) {
      ctx.fillStyle = colour;
      ctx.beginPath();
      for (const i of group) this.#outline(boxes, camera, i);
      ctx.fill();
      ctx.stroke();
    }
    this.#head(boxes, camera);
  }

  /** Whether benches are drawn as a dragon's: large enough, and without colours that tell something. @param {Picture} picture */
  #dresses({ boxes, camera, scale, dressed }) {
    return dressed && !scale && this.#dressOf(boxes).shows(camera);
  }

  /** @type {{boxes: Boxes, dress: Dress} | null} */
  #dressed = null;

  /** What benches of these sizes are drawn of. @param {Boxes} boxes */
  #dressOf(boxes) {
    if (this.#dressed?.boxes !== boxes) this.#dressed = { boxes, dress: new Dress(boxes) };
    return this.#dressed.dress;
  }

  /** @param {Picture} picture @param {string[]} colours of the scale @param {number} i */
  #colour({ scale, dressed }, colours, i) {
    if (scale) return colours[shade(scale, scale.value(i))];
    return i === 0 ? this.inks.head : dressed ? this.inks.cloth : this.inks.body;
  }

  /** The head's outline, and its brow. @param {Boxes} boxes @param {Camera} camera */
  #head(boxes, camera) {
    const { ctx } = this;
    ctx.beginPath();
    this.#outline(boxes, camera, 0);
    ctx.strokeStyle = this.inks.head;
    ctx.lineWidth = Math.min(Math.max(0.05 * camera.scale, 2.5), 4);
    ctx.stroke();
    // Large enough to be seen, it lies inside the bench.
    const small = boxes.wide[0] * camera.scale < SMALLEST_BROW;
    const size = small ? 6 / camera.scale : boxes.wide[0];
    const tip = boxes.half[0] + (small ? 1.6 * size : 0);
    ctx.beginPath();
    ctx.moveTo(...camera.toScreen(...boxes.point(0, tip, 0)));
    ctx.lineTo(...camera.toScreen(...boxes.point(0, tip - 1.6 * size, size)));
    ctx.lineTo(...camera.toScreen(...boxes.point(0, tip - 1.6 * size, -size)));
    ctx.closePath();
    ctx.fillStyle = this.inks.head;
    ctx.fill();
  }

  /** Handles, when benches are large enough. @param {Picture} picture @param {number[]} seen */
  #handles({ boxes, camera, stand }, seen) {
    const { ctx } = this;
    if (2 * boxes.half[0] * camera.scale < HANDLES_FROM) return;
    ctx.fillStyle = this.inks.ink;
    ctx.beginPath();
    for (const i of seen) {
      const [x, y] = camera.toScreen(stand.x[i], stand.y[i]);
      const radius = Math.max(0.0275 * camera.scale, 1.2);
      ctx.moveTo(x + radius, y);
      ctx.arc(x, y, radius, 0, 2 * Math.PI);
    }
    ctx.fill();
  }

  /** @param {Picture} picture @param {number[]} seen @param {Ring | null} ring @param {Tag[]} names of what stands on the square */
  #numbers({ boxes, camera, chosen }, seen, ring, names) {
    const { ctx } = this;
    ctx.font = lettering(numberHeight(camera), camera);
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    ctx.lineWidth = 3;
    ctx.lineJoin = "round";
    ctx.strokeStyle = this.inks.ground;
    ctx.fillStyle = this.inks.ink;
    for (const { i, x, y } of numberTags(boxes, seen, chosen, camera, ring, names)) {
      ctx.strokeText(String(i + 1), x, y);
      ctx.fillText(String(i + 1), x, y);
    }
    ctx.lineJoin = "miter";
  }

  /** Benches that touch: colour, and hatch. @param {Picture} picture */
  #touches(picture) {
    const { boxes, camera, square } = picture;
    const { ctx } = this;
    ctx.beginPath();
    let any = false;
    for (let i = 0; i < boxes.count; i++) {
      if (boxes.nearest[i] > boxes.touch && !square.touching.has(i)) continue;
      this.#outline(boxes, camera, i);
      any = true;
    }
    if (!any) return;
    ctx.fillStyle = TOUCH;
    ctx.globalAlpha = this.#dresses(picture) ? TOUCH_OVER : 1;
    ctx.fill();
    ctx.globalAlpha = 1;
    ctx.fillStyle = this.hatch;
    ctx.fill();
    ctx.strokeStyle = this.inks.ink;
    ctx.lineWidth = 1;
    ctx.stroke();
  }

  /** A ring about the chosen bench, which keeps its colour however small it is. @param {Picture} picture */
  #chosen(picture) {
    const { boxes, camera, chosen, scale } = picture;
    if (chosen < 0) return;
    const { ctx } = this;
    ctx.beginPath();
    this.#outline(boxes, camera, chosen);
    ctx.lineJoin = "round";
    ctx.strokeStyle = this.inks.ground;
    ctx.lineWidth = 9;
    ctx.stroke();
    ctx.strokeStyle = this.inks.ink;
    ctx.lineWidth = 5;
    ctx.stroke();
    ctx.fillStyle = this.#colour(picture, scale ? shades(scale) : [], chosen);
    ctx.fill();
    ctx.lineJoin = "miter";
    if (this.#dresses(picture)) this.#dressOf(boxes).paint(ctx, boxes, camera, this.inks, [chosen]);
  }

  /** A pair's ring, and beside it what it is. @param {Picture} picture @param {number[]} seen @param {Pair | BesideObstacle | Told} ringed @param {Ring} ring @param {Tag[]} names */
  #ring({ boxes, camera, square }, seen, ringed, ring, names) {
    const { ctx } = this;
    ctx.strokeStyle = this.inks.mark;
    ctx.lineWidth = 2.5;
    ctx.beginPath();
    ctx.arc(ring.x, ring.y, ring.radius, 0, 2 * Math.PI);
    ctx.moveTo(...camera.toScreen(...ringed.from));
    ctx.lineTo(...camera.toScreen(...ringed.to));
    ctx.stroke();
    const text = ringText(ringed, boxes, square);
    const near = seen.filter((i) => {
      const [x, y] = camera.toScreen(boxes.x[i], boxes.y[i]);
      return Math.hypot(x - ring.x, y - ring.y) < ring.radius + ABOUT + boxes.radius[i] * camera.scale;
    });
    const hidden = (/** @type {Tag} */ tag) =>
      hides(tag, boxes, camera, ringed, near) +
      OF_A_NAME * names.filter((name) => overlap(tag, name)).length;
    const tag = this.beside.place(ring, halfWidth(ctx, camera, text), hidden, camera);
    this.#leader(ring, tag);
    writeLabel(ctx, camera, this.inks, text, tag.x, tag.y);
  }

  /** A line from a ring to its label. @param {Ring} ring @param {Tag} tag */
  #leader({ x, y, radius }, tag) {
    const { ctx } = this;
    const dx = Math.min(Math.max(x, tag.x - tag.half), tag.x + tag.half) - x;
    const dy = Math.min(Math.max(y, tag.y - tag.tall), tag.y + tag.tall) - y;
    const share = radius / Math.max(Math.hypot(dx, dy), radius);
    ctx.lineWidth = 1.5;
    ctx.beginPath();
    ctx.moveTo(x + share * dx, y + share * dy);
    ctx.lineTo(x + dx, y + dy);
    ctx.stroke();
  }
}

/** What a ring's label says. @param {Pair | BesideObstacle | Told} ringed @param {Boxes} boxes @param {Square} square */
function ringText(ringed, boxes, square) {
  if ("text" in ringed) return ringed.text;
  const gap =
    ringed.distance < -boxes.touch
      ? _("overlap {depth}", { depth: shortLength(-ringed.distance) })
      : shortLength(Math.max(ringed.distance, 0));
  const other = "j" in ringed ? ringed.j + 1 : square.obstacles[ringed.obstacle].name[language()];
  return `${gap}  (${ringed.i + 1}, ${other})`;
}

/** The ring about where a pair is nearest; none outside the picture. @param {Pair | BesideObstacle | Told} pair @param {Camera} camera @returns {Ring | null} */
function ringOf({ from, to }, camera) {
  const [[x0, y0], [x1, y1]] = [camera.toScreen(...from), camera.toScreen(...to)];
  const [x, y] = [0.5 * (x0 + x1), 0.5 * (y0 + y1)];
  const radius = 0.5 * Math.hypot(x1 - x0, y1 - y0) + 12;
  const across = x >= -radius && x <= camera.width + radius;
  return across && y >= -radius && y <= camera.height + radius ? { x, y, radius } : null;
}

/**
 * How many benches a label would hide, those of the pair many times.
 * @param {Tag} tag
 * @param {Boxes} boxes
 * @param {Camera} camera
 * @param {Pair | BesideObstacle | Told} pair
 * @param {number[]} seen
 */
function hides({ x, y, half, tall }, boxes, camera, pair, seen) {
  const [east, north] = camera.toGround(x, y);
  const [a, b] = [half / camera.scale, tall / camera.scale];
  const hidden = seen.filter((i) => boxes.meets(i, east, north, a, b));
  const own = hidden.filter((i) => i === pair.i || ("j" in pair && i === pair.j));
  return hidden.length + OF_THE_PAIR * own.length;
}
