// Where words stand on the picture: benches' numbers that can be read, and labels beside what they tell of.

import { labelHeight, larger } from "./notes.js";

/** @typedef {import("./nearness.js").Boxes} Boxes */
/** @typedef {import("./camera.js").Camera} Camera */

/** Height of benches' numbers, CSS pixels. */
const SMALLEST_NUMBER = 11;
const LARGEST_NUMBER = 15;
/** Every so many benches have a number, so that each has so many CSS pixels of the chain; all have, or few. */
const NUMBERED = [1, 5, 10, 50, 100, 500, 1000, 5000];
const ROOM_FOR_ALL = 44;
const ROOM_FOR_FEW = 150;
/** From a ring to its label, CSS pixels. */
const LEADERS = [16, 40, 80, 130, 200, 300];
/** Sides of a ring that its label may stand on. */
const SIDES = 16;
/** Height of what lies over the top and the bottom of the picture, CSS pixels. */
const OVERLAY = 56;
/** Width of the button in the corner at the top right, CSS pixels. */
const CORNER = 84;
/** A label stays on its side of the ring until another would hide so many benches fewer. */
const STEADY = 3;

/** A rectangle on the canvas: its middle and half its sides, CSS pixels. @typedef {{x: number, y: number, half: number, tall: number}} Tag */

/** A circle on the canvas, CSS pixels. @typedef {{x: number, y: number, radius: number}} Ring */

/** @param {Tag} a @param {Tag} b */
export function overlap(a, b) {
  return Math.abs(a.x - b.x) < a.half + b.half && Math.abs(a.y - b.y) < a.tall + b.tall;
}

/** Height of benches' numbers, CSS pixels, in a picture of plain size. @param {Camera} camera */
export function numberHeight({ scale }) {
  return Math.min(Math.max(0.225 * scale, SMALLEST_NUMBER), LARGEST_NUMBER);
}

/**
 * Benches whose numbers are written, and where: the chosen one, the head, and round numbers, as many as
 * find room outside the ring.
 * @param {Boxes} boxes
 * @param {number[]} seen
 * @param {number} chosen
 * @param {Camera} camera
 * @param {Ring | null} ring
 * @param {Tag[]} names that stand there already
 */
export function numberTags(boxes, seen, chosen, camera, ring, names) {
  const size = numberHeight(camera) * larger(camera);
  const link = (boxes.behind[boxes.count] / boxes.count) * camera.scale;
  const each = NUMBERED.findIndex(
    (n) => n * link >= (n > 1 ? ROOM_FOR_FEW : ROOM_FOR_ALL) * larger(camera),
  );
  const steps = each < 0 ? [] : NUMBERED.slice(each);
  const rank = (/** @type {number} */ i) =>
    i === chosen
      ? NUMBERED.length + 1
      : i
        ? steps.filter((step) => !((i + 1) % step)).length - 1
        : NUMBERED.length;
  const ranked = seen.map((i) => ({ i, rank: rank(i) })).filter((one) => one.rank >= 0);
  ranked.sort((a, b) => b.rank - a.rank);
  /** @type {(Tag & {i: number})[]} */
  const tags = [];
  for (const { i } of ranked) {
    const [x, y] = camera.toScreen(boxes.x[i], boxes.y[i]);
    const half = 0.33 * size * String(i + 1).length + 2;
    const tag = { i, x, y, half, tall: 0.6 * size };
    if (!inRing(tag, ring) && ![...names, ...tags].some((other) => overlap(tag, other))) tags.push(tag);
  }
  return tags;
}

/** @param {Tag} tag @param {Ring | null} ring */
function inRing({ x, y, half, tall }, ring) {
  if (!ring) return false;
  const [dx, dy] = [Math.abs(x - ring.x) - half, Math.abs(y - ring.y) - tall];
  return Math.hypot(Math.max(dx, 0), Math.max(dy, 0)) < ring.radius;
}

/** Puts the label of a ring beside it, where it hides least, and keeps it on that side. */
export class Beside {
  /** The side and the distance taken last. */
  #last = 0;

  /**
   * @param {Ring} ring CSS pixels
   * @param {number} half of the label's width, CSS pixels
   * @param {(tag: Tag) => number} hidden how many benches a label would hide
   * @param {Camera} camera
   * @returns {Tag}
   */
  place(ring, half, hidden, camera) {
    const tags = LEADERS.flatMap((leader) => sides(ring, leader, half, labelHeight(camera) / 2));
    const costs = tags.map((tag) => hidden(tag) + outside(tag, camera));
    const best = costs.indexOf(Math.min(...costs));
    if (costs[this.#last] > costs[best] + STEADY) this.#last = best;
    return tags[this.#last];
  }
}

/** Labels on all sides of a ring, above it first. @param {Ring} ring @param {number} leader @param {number} half @param {number} tall @returns {Tag[]} */
function sides({ x, y, radius }, leader, half, tall) {
  return Array.from({ length: SIDES }, (_unused, n) => {
    const angle = (2 * Math.PI * n) / SIDES;
    const [right, down] = [Math.sin(angle), -Math.cos(angle)];
    const far = radius + leader;
    return {
      x: x + far * right + half * Math.sign(Math.round(right)),
      y: y + far * down + tall * Math.sign(Math.round(down)),
      half,
      tall,
    };
  });
}

/** What it costs that a label leaves the picture, or comes under what lies over it. @param {Tag} tag @param {Camera} camera */
function outside({ x, y, half, tall }, { width, height }) {
  if (x < half || y < tall || x > width - half || y > height - tall) return 1e6;
  if (x > width - half - CORNER && y < tall + OVERLAY) return 1e6;
  return y < tall + OVERLAY || y > height - tall - OVERLAY ? 10 : 0;
}
