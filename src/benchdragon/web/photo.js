// A photograph of the square below the dance: it stays in this page, and two points and their distance give
// its scale.

import { fileInput, make, textButton } from "./elements.js";
import { NumberControl } from "./number_control.js";
import { _ } from "./words.js";

/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./placing.js").Placing} Placing */
/** @typedef {import("./player.js").Player} Player */
/** @typedef {[number, number]} Point */

/** Dots of the longer side at most: phones draw it with each picture of the dance. */
const MOST = 1600;

/** @typedef {{ player: Player | null, placing: Placing }} Host */

export class Photo {
  /** @param {Host} host */
  constructor(host) {
    this.host = host;
    /** @type {ImageBitmap | null} */
    this.picture = null;
    /** Its middle on the ground, and metres of a dot. @type {Point} */
    this.middle = [0, 0];
    this.scale = 1;
    /** Two points of it on the ground. @type {Point[]} */
    this.points = [];
    this.strength = 0.6;
    this.element = make("div");
  }

  /** The controls, in the language in use. */
  controls() {
    const input = fileInput((file) => this.#open(file), { accept: "image/*" });
    this.trouble = make("p", { class: "odd", role: "alert", hidden: true });
    this.span = new NumberControl(
      {
        key: "span",
        text: () => _("distance between the two points"),
        unit: "m",
        low: 0.1,
        high: 100,
        step: 0.1,
        when: () => this.points.length === 2,
      },
      (_key, metres) => this.#stretch(metres ?? 0),
    );
    this.shade = new NumberControl(
      { key: "strength", text: () => _("how strong it is"), unit: "", low: 0.1, high: 1, step: 0.05 },
      (_key, strength) => {
        this.strength = Math.min(Math.max(strength ?? 0, 0), 1);
        this.#show();
      },
    );
    this.more = make(
      "div",
      {},
      make("p", { class: "source" }, _("It stays in this page: it is neither saved nor sent.")),
      make(
        "div",
        { class: "row" },
        textButton(_("two points and their distance"), () => this.#measure()),
        textButton(_("move it"), () => this.#move()),
        textButton(_("take it away"), () => this.#remove()),
      ),
      this.span.element,
      this.shade.element,
    );
    this.element = make(
      "div",
      {},
      make(
        "div",
        { class: "row" },
        textButton(_("a photograph below"), () => input.click()),
        input,
      ),
      this.trouble,
      this.more,
    );
    this.#tell();
    return this.element;
  }

  /** Have the controls say how it is now. */
  #tell() {
    const [a, b] = this.points;
    const span = b ? Number(Math.hypot(b[0] - a[0], b[1] - a[1]).toFixed(3)) : 0;
    if (this.more) this.more.hidden = !this.picture;
    this.span?.show({ span });
    this.shade?.show({ strength: this.strength });
  }

  /** Show it as it is now. */
  #show() {
    const { player } = this.host;
    this.#tell();
    if (!player) return;
    player.below = this.picture && this;
    player.zoom(1); // drawn anew; from now on the picture stays where it is
  }

  /** @param {File} file */
  async #open(file) {
    const { player } = this.host;
    if (!player) return; // no dance yet, which is drawn over it
    const picture = await read(file);
    if (this.trouble) {
      this.trouble.hidden = picture !== null;
      this.trouble.textContent = _("This browser cannot read {name} as a picture.", {
        name: file.name,
      });
    }
    if (!picture) return;
    const { x, y, width, height, scale } = player.camera;
    this.picture = picture;
    this.middle = [x, y];
    this.scale = Math.min(width / picture.width, height / picture.height) / scale;
    this.points = [];
    this.#show();
  }

  #remove() {
    this.picture = null;
    this.points = [];
    this.#show();
  }

  /** Ask for two of its points. */
  #measure() {
    this.host.placing.begin({
      name: _("two points and their distance"),
      says: () => _("Tap two points of the photograph whose distance you know."),
      taps: 2,
      done: (points) => {
        this.points = points;
        this.#show();
        this.span?.box.focus();
        this.span?.box.select();
      },
    });
  }

  /** Ask where it is to be. */
  #move() {
    this.host.placing.begin({
      name: _("move it"),
      says: () => _("Tap a point of the photograph, then where it belongs."),
      taps: 2,
      done: ([from, to]) => {
        const shifted = (/** @type {Point} */ [x, y]) =>
          /** @type {Point} */ ([x + to[0] - from[0], y + to[1] - from[1]]);
        this.middle = shifted(this.middle);
        this.points = this.points.map(shifted);
        this.#show();
      },
    });
  }

  /** Have its two points so far from one another, about the middle between them. @param {number} metres */
  #stretch(metres) {
    const [a, b] = this.points;
    const factor = metres / Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (!(factor > 0)) return this.#show();
    const [x, y] = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    const grown = (/** @type {Point} */ [u, v]) =>
      /** @type {Point} */ ([x + factor * (u - x), y + factor * (v - y)]);
    this.middle = grown(this.middle);
    this.points = this.points.map(grown);
    this.scale *= factor;
    this.#show();
  }

  /** Draw it, on a screen alone. @param {CanvasRenderingContext2D} ctx @param {Camera} camera */
  paint(ctx, camera) {
    const { picture, scale, middle } = this;
    if (!picture || this.host.player?.paper.on) return;
    const [x, y] = camera.toScreen(...middle);
    const [wide, tall] = [picture.width, picture.height].map((dots) => dots * scale * camera.scale);
    ctx.globalAlpha = this.strength;
    ctx.drawImage(picture, x - 0.5 * wide, y - 0.5 * tall, wide, tall);
    ctx.globalAlpha = 1;
  }
}

/** The picture in a file, made smaller where it is large; null where there is none. @param {File} file */
async function read(file) {
  try {
    const whole = await createImageBitmap(file);
    const share = MOST / Math.max(whole.width, whole.height);
    if (share >= 1) return whole;
    const [resizeWidth, resizeHeight] = [whole.width, whole.height].map((dots) =>
      Math.ceil(dots * share),
    );
    return await createImageBitmap(whole, { resizeWidth, resizeHeight, resizeQuality: "high" });
  } catch (error) {
    if (error instanceof DOMException) return null;
    throw error;
  }
}
