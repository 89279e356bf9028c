// A picture of a dance for chats that open neither links nor files: its title, how it stands, a code that opens it.

import { codePath } from "./code.js";

/** @typedef {import("./standing.js").MadeFile} MadeFile */

/** Width of the picture, of its edge and of its code, dots. */
const [WIDE, EDGE, CODE] = [1080, 48, 420];
/** The dance is so tall for its width, at most. */
const TALLEST = 1.1;
/** The largest kind of code, whose squares are then 4 dots wide. */
const MOST_VERSION = 20;
const [TITLE, TEXT] = ["700 54px", "400 36px"];
const LINE = 1.3;
/** What is not parted at the end of a line: a word with the space behind it, a Chinese sign. */
const PARTS = /\p{Script=Han}\p{P}*|[^\s\p{Script=Han}]+\s*|\s+/gu;

/** Lines of a text that are no wider than there is room for. @param {CanvasRenderingContext2D} ctx @param {string} text @param {number} room */
function linesOf(ctx, text, room) {
  const lines = [""];
  for (const [part] of text.matchAll(PARTS)) {
    const longer = lines[lines.length - 1] + part;
    if (ctx.measureText(longer.trimEnd()).width <= room) lines[lines.length - 1] = longer;
    else lines.push(part);
  }
  return lines;
}

/**
 * @typedef {object} Shown
 * @property {string} name of the file
 * @property {string} title
 * @property {HTMLCanvasElement} canvas the dance
 * @property {string} code what the code holds
 * @property {string} words what is to be done with it
 * @property {string} without what is said where it is too long for one
 */

/** Make the picture. @param {Shown} shown @returns {Promise<MadeFile>} */
export async function chatPicture({ name, title, canvas, code, words, without }) {
  const picture = document.createElement("canvas");
  const ctx = /** @type {CanvasRenderingContext2D} */ (picture.getContext("2d"));
  const room = WIDE - 2 * EDGE;
  const font = (/** @type {string} */ kind) => `${kind} ${getComputedStyle(document.body).fontFamily}`;
  ctx.font = font(TITLE);
  const heads = linesOf(ctx, title, room);
  const [head, text] = [TITLE, TEXT].map((kind) => LINE * Number.parseInt(kind.slice(4), 10));
  const tall = Math.min(canvas.height / canvas.width, TALLEST) * room;
  const found = codePath(code, "L", MOST_VERSION);
  const top = EDGE + heads.length * head + 0.5 * EDGE;
  picture.width = WIDE;
  picture.height = Math.ceil(top + tall + 0.5 * EDGE + CODE + 0.5 * EDGE);
  ctx.fillStyle = "#fff";
  ctx.fillRect(0, 0, picture.width, picture.height);
  ctx.fillStyle = "#15181d";
  ctx.textBaseline = "top";
  ctx.font = font(TITLE);
  heads.forEach((line, n) => ctx.fillText(line, EDGE, EDGE + n * head));
  const share = Math.min(room / canvas.width, tall / canvas.height);
  const [wide, high] = [share * canvas.width, share * canvas.height];
  ctx.drawImage(canvas, EDGE + 0.5 * (room - wide), top, wide, high);
  const below = top + tall + 0.5 * EDGE;
  const left = found ? EDGE + CODE : EDGE;
  ctx.font = font(TEXT);
  linesOf(ctx, found ? words : without, WIDE - EDGE - left).forEach((line, n) =>
    ctx.fillText(line, left, below + 0.5 * EDGE + n * text),
  );
  if (found) {
    ctx.translate(EDGE, below);
    ctx.scale(CODE / found.size, CODE / found.size);
    ctx.fill(new Path2D(found.path));
  }
  const data = await new Promise((done) => picture.toBlob(done, "image/png"));
  return { name: `${name}.png`, data };
}
