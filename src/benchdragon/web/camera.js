// What part of the ground the canvas shows, and the gestures that move it.

/** What is brought into sight is so far from the picture's edge, CSS pixels. */
const EDGE = 12;

export class Camera {
  constructor() {
    this.x = 0;
    this.y = 0;
    /** CSS pixels a metre. */
    this.scale = 20;
    this.width = 1;
    this.height = 1;
  }

  /** @param {number} width @param {number} height CSS pixels */
  resize(width, height) {
    this.width = width;
    this.height = height;
  }

  /** What shows a box of ground, m. @param {number} left @param {number} bottom @param {number} right @param {number} top */
  view(left, bottom, right, top) {
    const scale = Math.min(this.width / (right - left), this.height / (top - bottom));
    return {
      x: 0.5 * (left + right),
      y: 0.5 * (bottom + top),
      scale: Math.min(Math.max(scale, 0.01), 4000),
    };
  }

  /** Show a box of ground, m. @param {number} left @param {number} bottom @param {number} right @param {number} top */
  fit(left, bottom, right, top) {
    Object.assign(this, this.view(left, bottom, right, top));
  }

  /** @param {number} x @param {number} y m @returns {[number, number]} CSS pixels */
  toScreen(x, y) {
    return [
      0.5 * this.width + (x - this.x) * this.scale,
      0.5 * this.height - (y - this.y) * this.scale,
    ];
  }

  /** @param {number} px @param {number} py CSS pixels @returns {[number, number]} m */
  toGround(px, py) {
    return [
      this.x + (px - 0.5 * this.width) / this.scale,
      this.y - (py - 0.5 * this.height) / this.scale,
    ];
  }

  /** Zoom about a point of the canvas. @param {number} factor @param {number} px @param {number} py */
  zoom(factor, px, py) {
    const [x, y] = this.toGround(px, py);
    this.scale = Math.min(Math.max(this.scale * factor, 0.01), 4000);
    const [nx, ny] = this.toGround(px, py);
    this.x += x - nx;
    this.y += y - ny;
  }

  /**
   * Pan no farther than it takes to show what lies about a point; whether that was anything.
   * @param {number} x
   * @param {number} y
   * @param {number} radius m
   */
  bring(x, y, radius) {
    const [px, py] = this.toScreen(x, y);
    const inside = (/** @type {number} */ at, /** @type {number} */ size) => {
      const room = Math.min(radius * this.scale + EDGE, 0.5 * size);
      return Math.min(Math.max(at, room), size - room);
    };
    const [dx, dy] = [inside(px, this.width) - px, inside(py, this.height) - py];
    this.pan(dx, dy);
    return dx !== 0 || dy !== 0;
  }

  /** @param {number} dx @param {number} dy CSS pixels */
  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }
}

/**
 * What gestures on a canvas ask for.
 * @typedef {object} Hands
 * @property {() => void} moved the camera moved
 * @property {(px: number, py: number) => void} tapped
 * @property {(px: number, py: number, ended: boolean, began: boolean) => boolean} measured a ruler is
 *   drawn; false: dragging pans
 */

/** A finger may move so far, CSS pixels, and still tap. */
const TAP = 8;

/**
 * Pan by dragging, zoom by wheel and by two fingers, tap.
 * @param {HTMLElement} canvas
 * @param {Camera} camera
 * @param {Hands} hands
 */
export function listen(canvas, camera, hands) {
  /** @type {Map<number, {x: number, y: number}>} */
  const down = new Map();
  let travelled = 0;
  let fingers = 0;
  let tapped = false;

  /** @param {PointerEvent} event */
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    down.set(event.pointerId, at(event));
    if (down.size === 1) [travelled, fingers] = [0, 1];
    fingers = Math.max(fingers, down.size);
    const { x, y } = at(event);
    if (down.size === 1) hands.measured(x, y, false, true);
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = down.get(event.pointerId);
    if (!before) return;
    const now = at(event);
    travelled += Math.hypot(now.x - before.x, now.y - before.y);
    const others = [...down].filter(([id]) => id !== event.pointerId).map(([, point]) => point);
    down.set(event.pointerId, now);
    if (others.length) {
      const [other] = others;
      const was = Math.hypot(before.x - other.x, before.y - other.y);
      const is = Math.hypot(now.x - other.x, now.y - other.y);
      if (was > 0 && is > 0) camera.zoom(is / was, 0.5 * (now.x + other.x), 0.5 * (now.y + other.y));
      camera.pan(0.5 * (now.x - before.x), 0.5 * (now.y - before.y));
      hands.moved();
    } else if (!hands.measured(now.x, now.y, false, false) && travelled > TAP) {
      camera.pan(now.x - before.x, now.y - before.y);
      hands.moved();
    }
  });
  /** @param {PointerEvent} event */
  const up = (event) => {
    if (!down.delete(event.pointerId)) return;
    const { x, y } = at(event);
    const measured = hands.measured(x, y, true, false);
    tapped = event.type === "pointerup" && !measured && fingers === 1 && travelled <= TAP;
  };
  // Not before the click: what a tap opens would be clicked at.
  canvas.addEventListener("click", (event) => {
    const box = canvas.getBoundingClientRect();
    if (tapped) hands.tapped(event.clientX - box.left, event.clientY - box.top);
    tapped = false;
  });
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const box = canvas.getBoundingClientRect();
      const notch = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 30;
      const factor = Math.exp(-0.0015 * notch * event.deltaY);
      camera.zoom(factor, event.clientX - box.left, event.clientY - box.top);
      hands.moved();
    },
    { passive: false },
  );
}
