// Words and measures on the picture: labels, the scale bar, the ruler.

import { _, shortLength } from "./words.js";

/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./paint.js").Inks} Inks */

export const FONT =
  '"Noto Sans SC", "PingFang SC", "Microsoft YaHei", "Noto Sans CJK SC", system-ui, sans-serif';
/** Pictures of which the smaller side is longer, CSS pixels, have larger letters, up to so many times. */
const PLAIN_SIDE = 720;
const MOST_LARGER = 1.5;
/** Height of a label, CSS pixels, in a picture of plain size. */
const LABEL = 22;

/** How much larger letters are than in a picture of plain size. @param {Camera} camera */
export function larger({ width, height }) {
  return Math.min(Math.max(Math.min(width, height) / PLAIN_SIDE, 1), MOST_LARGER);
}

/** Height of a label, CSS pixels. @param {Camera} camera */
export function labelHeight(camera) {
  return LABEL * larger(camera);
}

/** @param {number} size CSS pixels @param {Camera} camera */
export function lettering(size, camera) {
  return `600 ${size * larger(camera)}px ${FONT}`;
}

/** Half the width of a label, CSS pixels. @param {CanvasRenderingContext2D} ctx @param {Camera} camera @param {string} text */
export function halfWidth(ctx, camera, text) {
  ctx.font = lettering(14, camera);
  return 0.5 * ctx.measureText(text).width + 6;
}

/** Write a label that stays on the canvas. @param {CanvasRenderingContext2D} ctx @param {Camera} camera @param {Inks} inks @param {string} text @param {number} x @param {number} y */
export function writeLabel(ctx, camera, inks, text, x, y) {
  const half = halfWidth(ctx, camera, text);
  const tall = labelHeight(camera) / 2;
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  const left = Math.min(Math.max(x, half + 4), camera.width - half - 4);
  const top = Math.min(Math.max(y, tall + 5), camera.height - tall - 5);
  ctx.fillStyle = inks.ground;
  ctx.globalAlpha = 0.9;
  ctx.beginPath();
  ctx.roundRect(left - half, top - tall, 2 * half, 2 * tall, 5);
  ctx.fill();
  ctx.globalAlpha = 1;
  ctx.fillStyle = inks.mark;
  ctx.fillText(text, left, top);
}

/** @param {CanvasRenderingContext2D} ctx @param {Camera} camera @param {Inks} inks */
export function drawScaleBar(ctx, camera, inks) {
  const most = Math.min(160, 0.3 * camera.width) / camera.scale;
  const unit = 10 ** Math.floor(Math.log10(most));
  const metres = (most >= 5 * unit ? 5 : most >= 2 * unit ? 2 : 1) * unit;
  const [x, y] = [16, camera.height - 14];
  const bar = new Path2D(`M${x} ${y - 6}V${y}H${x + metres * camera.scale}V${y - 6}`);
  const text = metres < 1 ? `${Number((100 * metres).toPrecision(1))} cm` : `${metres} m`;
  ctx.font = lettering(13, camera);
  ctx.textAlign = "left";
  ctx.textBaseline = "alphabetic";
  ctx.lineJoin = "round";
  // What lies below is seen beside it: a square's edge often does.
  [ctx.strokeStyle, ctx.lineWidth] = [inks.ground, 6];
  ctx.stroke(bar);
  ctx.strokeText(text, x + 4, y - 8);
  [ctx.strokeStyle, ctx.lineWidth] = [inks.ink, 2];
  ctx.stroke(bar);
  ctx.fillStyle = inks.ink;
  ctx.fillText(text, x + 4, y - 8);
  ctx.lineJoin = "miter";
}

/** An arrow to the north, which is up, in the upper left corner. @param {CanvasRenderingContext2D} ctx @param {Camera} camera @param {Inks} inks */
export function drawNorth(ctx, camera, inks) {
  ctx.fillStyle = inks.ink;
  ctx.beginPath();
  ctx.moveTo(24, 10);
  ctx.lineTo(33, 46);
  ctx.lineTo(24, 38);
  ctx.lineTo(15, 46);
  ctx.closePath();
  ctx.fill();
  ctx.font = lettering(14, camera);
  ctx.textAlign = "center";
  ctx.textBaseline = "top";
  ctx.fillText(_("N"), 24, 50);
}

/** A measured line and its length. @param {CanvasRenderingContext2D} ctx @param {Camera} camera @param {Inks} inks @param {[number, number][]} ruler two points on the ground, or none */
export function drawRuler(ctx, camera, inks, ruler) {
  if (ruler.length < 2) return;
  const [a, b] = ruler.map((point) => camera.toScreen(...point));
  ctx.strokeStyle = inks.ink;
  ctx.lineWidth = 2;
  ctx.setLineDash([4, 3]);
  ctx.beginPath();
  ctx.moveTo(...a);
  ctx.lineTo(...b);
  ctx.stroke();
  ctx.setLineDash([]);
  const length = Math.hypot(ruler[1][0] - ruler[0][0], ruler[1][1] - ruler[0][1]);
  const [x, y] = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]) - 16];
  writeLabel(ctx, camera, inks, shortLength(length), x, y);
}

/** A small pattern: lines at an angle, for what touches; dots, for what stands on the square. @param {"lines" | "dots"} kind */
export function patternOf(kind) {
  const tile = document.createElement("canvas");
  [tile.width, tile.height] = [6, 6];
  const ctx = /** @type {CanvasRenderingContext2D} */ (tile.getContext("2d"));
  ctx.lineWidth = 1.6;
  ctx.beginPath();
  if (kind === "dots") ctx.arc(3, 3, 1, 0, 2 * Math.PI);
  else {
    for (const shift of [-6, 0, 6]) {
      ctx.moveTo(shift, 6);
      ctx.lineTo(shift + 6, 0);
    }
  }
  if (kind === "dots") ctx.fill();
  else ctx.stroke();
  return /** @type {CanvasPattern} */ (ctx.createPattern(tile, "repeat"));
}
