// Draws a dance at one instant onto a canvas: ground, route, benches to scale, what is tight.

import { shade, shades, TOUCH } from "./colours.js";
import { Beside, LABEL_HEIGHT, numberHeight, numberTags } from "./labels.js";
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
/** @typedef {import("./labels.js").Ring} Ring */

/**
 * What is to be drawn.
 * @typedef {object} Picture
 * @property {Scene} scene
 * @property {Stand} stand
 * @property {Boxes} boxes
 * @property {Square} square
 * @property {Pair | BesideObstacle | null} ringed
 * @property {Camera} camera
 * @property {Scale | null} scale
 * @property {number} chosen number of the chosen bench from 0, or -1
 * @property {boolean} trails
 * @property {boolean} disc
 * @property {boolean} route
 * @property {[number, number][]} ruler two points on the ground, or none
 */

/** Colours of a theme, read from the style sheet. @typedef {Record<"ground" | "ink" | "quiet" | "faint" | "body" | "head" | "disc" | "obstacle" | "edge" | "mark" | "trail", string>} Inks */

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
]);
/** Seconds of trail, and points drawn of it. */
const TRAIL = 20;
const TRAIL_POINTS = 80;
/** CSS pixels of a bench from which handles are drawn. */
const HANDLES_FROM = 70;
/** What a label costs that hides the benches it tells of: more than any others. */
const OF_THE_PAIR = 1000;
const FONT =
  '"Noto Sans SC", "PingFang SC", "Microsoft YaHei", "Noto Sans CJK SC", system-ui, sans-serif';

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
    this.hatch = this.#hatching();
    this.dots = this.#dotting();
    this.beside = new Beside();
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

  /** Lines at an angle, for what touches. */
  #hatching() {
    const tile = document.createElement("canvas");
    [tile.width, tile.height] = [6, 6];
    const ctx = /** @type {CanvasRenderingContext2D} */ (tile.getContext("2d"));
    ctx.strokeStyle = "#000";
    ctx.lineWidth = 1.6;
    ctx.beginPath();
    for (const shift of [-6, 0, 6]) {
      ctx.moveTo(shift, 6);
      ctx.lineTo(shift + 6, 0);
    }
    ctx.stroke();
    return /** @type {CanvasPattern} */ (ctx.createPattern(tile, "repeat"));
  }

  /** Dots, for what stands on the square. */
  #dotting() {
    const tile = document.createElement("canvas");
    [tile.width, tile.height] = [6, 6];
    const ctx = /** @type {CanvasRenderingContext2D} */ (tile.getContext("2d"));
    ctx.fillStyle = "#000";
    ctx.beginPath();
    ctx.arc(3, 3, 1, 0, 2 * Math.PI);
    ctx.fill();
    return /** @type {CanvasPattern} */ (ctx.createPattern(tile, "repeat"));
  }

  /** @param {Picture} picture */
  paint(picture) {
    const { ctx, canvas } = this;
    const { camera } = picture;
    const density = canvas.width / camera.width;
    ctx.setTransform(density, 0, 0, density, 0, 0);
    ctx.fillStyle = this.inks.ground;
    ctx.fillRect(0, 0, camera.width, camera.height);
    picture.square.paint(ctx, camera, this.inks, this.dots);
    if (picture.route) this.#route(picture, density);
    if (picture.disc) this.#disc(picture);
    if (picture.trails) this.#trails(picture);
    const seen = this.#seen(picture.boxes, camera);
    this.#benches(picture, seen);
    this.#chosen(picture);
    this.#touches(picture);
    this.#handles(picture, seen);
    picture.square.name(ctx, camera, this.inks, FONT);
    const ring = picture.ringed && ringOf(picture.ringed, picture.camera);
    this.#numbers(picture, seen, ring);
    if (picture.ringed && ring) this.#ring(picture, seen, picture.ringed, ring);
    this.#scaleBar(camera);
    this.#ruler(picture);
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
  #benches({ boxes, camera, scale }, seen) {
    const { ctx } = this;
    /** @type {Map<string, number[]>} */
    const groups = new Map();
    const colours = scale ? shades(scale) : [];
    for (const i of seen) {
      const colour = this.#colour(scale, colours, i);
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

  /** @param {Scale | null} scale @param {string[]} colours of the scale @param {number} i */
  #colour(scale, colours, i) {
    return scale ? colours[shade(scale, scale.value(i))] : i ? this.inks.body : this.inks.head;
  }

  /** The head's outline, and its brow. @param {Boxes} boxes @param {Camera} camera */
  #head(boxes, camera) {
    const { ctx } = this;
    ctx.beginPath();
    this.#outline(boxes, camera, 0);
    ctx.strokeStyle = this.inks.head;
    ctx.lineWidth = Math.max(0.05 * camera.scale, 2.5);
    ctx.stroke();
    const size = Math.max(boxes.wide[0], 6 / camera.scale);
    ctx.beginPath();
    ctx.moveTo(...camera.toScreen(...boxes.point(0, boxes.half[0] + 1.6 * size, 0)));
    ctx.lineTo(...camera.toScreen(...boxes.point(0, boxes.half[0], size)));
    ctx.lineTo(...camera.toScreen(...boxes.point(0, boxes.half[0], -size)));
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

  /** @param {Picture} picture @param {number[]} seen @param {Ring | null} ring */
  #numbers({ boxes, camera, chosen }, seen, ring) {
    const { ctx } = this;
    ctx.font = `600 ${numberHeight(camera)}px ${FONT}`;
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    ctx.lineWidth = 3;
    ctx.lineJoin = "round";
    ctx.strokeStyle = this.inks.ground;
    ctx.fillStyle = this.inks.ink;
    for (const { i, x, y } of numberTags(boxes, seen, chosen, camera, ring)) {
      ctx.strokeText(String(i + 1), x, y);
      ctx.fillText(String(i + 1), x, y);
    }
    ctx.lineJoin = "miter";
  }

  /** Benches that touch: colour, and hatch. @param {Picture} picture */
  #touches({ boxes, camera, square }) {
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
    ctx.fill();
    ctx.fillStyle = this.hatch;
    ctx.fill();
    ctx.strokeStyle = this.inks.ink;
    ctx.lineWidth = 1;
    ctx.stroke();
  }

  /** A ring about the chosen bench, which keeps its colour however small it is. @param {Picture} picture */
  #chosen({ boxes, camera, chosen, scale }) {
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
    ctx.fillStyle = this.#colour(scale, scale ? shades(scale) : [], chosen);
    ctx.fill();
    ctx.lineJoin = "miter";
  }

  /** A pair's ring, and beside it what it is. @param {Picture} picture @param {number[]} seen @param {Pair | BesideObstacle} ringed @param {Ring} ring */
  #ring({ boxes, camera, square }, seen, ringed, ring) {
    const { ctx } = this;
    ctx.strokeStyle = this.inks.mark;
    ctx.lineWidth = 2.5;
    ctx.beginPath();
    ctx.arc(ring.x, ring.y, ring.radius, 0, 2 * Math.PI);
    ctx.moveTo(...camera.toScreen(...ringed.from));
    ctx.lineTo(...camera.toScreen(...ringed.to));
    ctx.stroke();
    const gap =
      ringed.distance < -boxes.touch
        ? _("overlap {depth}", { depth: shortLength(-ringed.distance) })
        : shortLength(Math.max(ringed.distance, 0));
    const other = "j" in ringed ? ringed.j + 1 : square.obstacles[ringed.obstacle].name[language()];
    const text = `${gap}  (${ringed.i + 1}, ${other})`;
    const hidden = (/** @type {Tag} */ tag) => hides(tag, boxes, camera, ringed, seen);
    const tag = this.beside.place(ring, this.#halfWidth(text), hidden, camera);
    this.#leader(ring, tag);
    this.#label(text, tag.x, tag.y, camera);
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

  /** Half the width of a label, CSS pixels. @param {string} text */
  #halfWidth(text) {
    this.ctx.font = `600 14px ${FONT}`;
    return 0.5 * this.ctx.measureText(text).width + 6;
  }

  /** A label that stays on the canvas. @param {string} text @param {number} x @param {number} y @param {Camera} camera */
  #label(text, x, y, camera) {
    const { ctx } = this;
    const half = this.#halfWidth(text);
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    const left = Math.min(Math.max(x, half + 4), camera.width - half - 4);
    const top = Math.min(Math.max(y, 16), camera.height - 16);
    ctx.fillStyle = this.inks.ground;
    ctx.globalAlpha = 0.88;
    ctx.fillRect(left - half, top - LABEL_HEIGHT / 2, 2 * half, LABEL_HEIGHT);
    ctx.globalAlpha = 1;
    ctx.fillStyle = this.inks.mark;
    ctx.fillText(text, left, top);
  }

  /** @param {Camera} camera */
  #scaleBar(camera) {
    const { ctx } = this;
    const most = Math.min(160, 0.3 * camera.width) / camera.scale;
    const unit = 10 ** Math.floor(Math.log10(most));
    const metres = (most >= 5 * unit ? 5 : most >= 2 * unit ? 2 : 1) * unit;
    const [x, y] = [16, camera.height - 14];
    ctx.fillStyle = this.inks.ground;
    ctx.globalAlpha = 0.88;
    ctx.fillRect(x - 8, y - 26, metres * camera.scale + 16, 34);
    ctx.globalAlpha = 1;
    ctx.strokeStyle = this.inks.ink;
    ctx.lineWidth = 2;
    ctx.beginPath();
    ctx.moveTo(x, y - 6);
    ctx.lineTo(x, y);
    ctx.lineTo(x + metres * camera.scale, y);
    ctx.lineTo(x + metres * camera.scale, y - 6);
    ctx.stroke();
    ctx.fillStyle = this.inks.ink;
    ctx.font = `600 13px ${FONT}`;
    ctx.textAlign = "left";
    ctx.textBaseline = "alphabetic";
    ctx.fillText(metres < 1 ? `${Math.round(100 * metres)} cm` : `${metres} m`, x + 4, y - 8);
  }

  /** @param {Picture} picture */
  #ruler({ ruler, camera }) {
    if (ruler.length < 2) return;
    const { ctx } = this;
    const [a, b] = ruler.map((point) => camera.toScreen(...point));
    ctx.strokeStyle = this.inks.ink;
    ctx.lineWidth = 2;
    ctx.setLineDash([4, 3]);
    ctx.beginPath();
    ctx.moveTo(...a);
    ctx.lineTo(...b);
    ctx.stroke();
    ctx.setLineDash([]);
    const length = Math.hypot(ruler[1][0] - ruler[0][0], ruler[1][1] - ruler[0][1]);
    this.#label(shortLength(length), 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]) - 16, camera);
  }
}

/** The ring about where a pair is nearest; none outside the picture. @param {Pair | BesideObstacle} pair @param {Camera} camera @returns {Ring | null} */
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
 * @param {Pair | BesideObstacle} pair
 * @param {number[]} seen
 */
function hides({ x, y, half, tall }, boxes, camera, pair, seen) {
  const [east, north] = camera.toGround(x, y);
  const [a, b] = [half / camera.scale, tall / camera.scale];
  const hidden = seen.filter((i) => boxes.meets(i, east, north, a, b));
  const own = hidden.filter((i) => i === pair.i || ("j" in pair && i === pair.j));
  return hidden.length + OF_THE_PAIR * own.length;
}
