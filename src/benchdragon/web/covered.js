// The ground that a dance covers, as a picture: all benches at many moments, one over another. It may miss a
// sliver that a corner passes between two of them, and is no outline with a bound on its error, such as
// `benchdragon area` gives.

import { Boxes } from "./nearness.js";

/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./scene.js").Scene} Scene */

/** From one moment to the next no handle goes farther, m, as long as there are no more moments than MOST. */
const WAY = 0.05;
const MOST = 6000;
/** Where a bench's front handle is on the route says how the bench lies: of benches of one size one for each
 * CELL, m, is painted, whoever comes first. */
const CELL = 0.5 * WAY;
/** Dots of the picture's longer side. */
const DOTS = 1600;
/** Moments at which the dance is looked at to find how much ground it takes. */
const LOOKED = 200;
/** It is painted for so long at a time, ms. */
const SLICE = 8;

/** Ground that benches take at some moments, with room about it: left, bottom, right, top, m. @param {Scene} scene @param {number} room m */
function roomOf(scene, room) {
  const stand = scene.room();
  let [left, bottom, right, top] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let n = 0; n <= LOOKED; n++) {
    const { x, y } = scene.stand(scene.start + (n / LOOKED) * (scene.end - scene.start), stand);
    for (let i = 0; i < x.length; i++) {
      [left, right] = [Math.min(left, x[i]), Math.max(right, x[i])];
      [bottom, top] = [Math.min(bottom, y[i]), Math.max(top, y[i])];
    }
  }
  return [left - room, bottom - room, right + room, top + room];
}

export class Covered {
  /** @param {Scene} scene @param {string} colour */
  constructor(scene, colour) {
    this.scene = scene;
    this.colour = colour;
    this.boxes = new Boxes(scene);
    this.stand = scene.room();
    const longest = this.boxes.radius.reduce((most, one) => Math.max(most, one), 0);
    const [left, bottom, right, top] = roomOf(scene, 2 * longest);
    /** Its upper left corner, m. */
    this.corner = { left, top };
    const [wide, tall] = [right - left, top - bottom];
    /** Dots a metre. */
    this.scale = DOTS / Math.max(wide, tall);
    this.canvas = document.createElement("canvas");
    this.canvas.width = Math.ceil(wide * this.scale);
    this.canvas.height = Math.ceil(tall * this.scale);
    const wanted = ((scene.end - scene.start) * scene.speedRange[1]) / WAY;
    /** How many moments are painted. */
    this.count = Math.min(Math.max(Math.ceil(wanted) + 1, 2), MOST);
    /** How many are painted by now. */
    this.painted = 0;
    const { length, width, front_inset: front, rear_inset: rear } = scene.sent.benches;
    /** Each bench's cells that are painted: those of its size. @type {Set<number>[]} */
    this.seen = [];
    /** @type {Map<string, Set<number>>} */
    const sizes = new Map();
    for (let i = 0; i < scene.benches; i++) {
      const size = [length[i], width[i], front[i], rear[i]].join();
      const seen = sizes.get(size) ?? new Set();
      sizes.set(size, seen);
      this.seen.push(seen);
    }
  }

  /** Whether all is painted. */
  get done() {
    return this.painted === this.count;
  }

  /** Go on painting for a while. */
  paint() {
    const ctx = /** @type {CanvasRenderingContext2D} */ (this.canvas.getContext("2d"));
    ctx.fillStyle = this.colour;
    const { scale, corner } = this;
    ctx.setTransform(scale, 0, 0, -scale, -corner.left * scale, corner.top * scale);
    const { start, end } = this.scene;
    const until = performance.now() + SLICE;
    while (!this.done && performance.now() < until) {
      const time = start + (this.painted++ / (this.count - 1)) * (end - start);
      this.boxes.place(this.scene.stand(time, this.stand));
      ctx.beginPath();
      for (let i = 0; i < this.boxes.count; i++) {
        const cell = Math.floor(this.stand.s[i] / CELL);
        if (this.seen[i].has(cell)) continue;
        this.seen[i].add(cell);
        this.#outline(ctx, i);
      }
      ctx.fill();
    }
  }

  /** @param {CanvasRenderingContext2D} ctx @param {number} i */
  #outline(ctx, i) {
    const { half, wide } = this.boxes;
    ctx.moveTo(...this.boxes.point(i, half[i], wide[i]));
    ctx.lineTo(...this.boxes.point(i, -half[i], wide[i]));
    ctx.lineTo(...this.boxes.point(i, -half[i], -wide[i]));
    ctx.lineTo(...this.boxes.point(i, half[i], -wide[i]));
    ctx.closePath();
  }

  /** Put what is painted by now onto the picture. @param {CanvasRenderingContext2D} ctx @param {Camera} camera */
  draw(ctx, camera) {
    const [x, y] = camera.toScreen(this.corner.left, this.corner.top);
    const size = camera.scale / this.scale;
    ctx.drawImage(this.canvas, x, y, this.canvas.width * size, this.canvas.height * size);
  }
}
