// A photograph of the square below the dance: it stays on this device, kept with the plans that it lay under;
// two points and their distance give its scale.

import { fileInput, make, textButton } from "./elements.js";
import { forgetPhoto, keepPhoto, photoUnder } from "./kept_photos.js";
import { NumberControl } from "./number_control.js";
import { _ } from "./words.js";

/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./placing.js").Placing} Placing */
/** @typedef {import("./player.js").Player} Player */
/** @typedef {[number, number]} Point */

/** Dots of the longer side at most: phones draw it with each picture of the dance. */
const MOST = 1600;
/** How well it is kept, of 1; and with so many plans, those shown last. */
const QUALITY = 0.85;
const MOST_PLANS = 200;

/** @typedef {{ player: Player | null, placing: Placing }} Host */

/** What plans of one square have in common, one of these at least. @param {import("./plan_form.js").Plan} plan */
const squareOf = ({ meta, venue, obstacle }) =>
  [meta?.title, venue?.rectangle, venue?.boundary, obstacle?.length && obstacle].map((one) =>
    one ? JSON.stringify(one) : "",
  );

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
    /** Turned to the left so far, degrees. */
    this.turned = 0;
    /** The plan above it: its hash, and what others of its square have in common with it. */
    this.plan = "";
    this.square = squareOf({});
    /** As it is kept; null where it cannot be. @type {import("./kept_photos.js").KeptPhoto | null} */
    this.kept = null;
    /** What is under way with those that are kept, one after another. @type {Promise<unknown>} */
    this.keeping = Promise.resolve();
    this.element = make("div");
  }

  /** The dance of a plan is shown: a photograph of another square goes, that of this one comes. @param {import("./plan_form.js").Plan} plan @param {string} hash */
  about(plan, hash) {
    const square = squareOf(plan);
    if (!square.some((one, n) => one && one === this.square[n])) this.#put(null, null);
    [this.square, this.plan] = [square, hash];
    if (this.picture) this.#keep();
    else this.keeping = this.keeping.then(() => this.#bring(hash));
  }

  /** Show the photograph that is kept with a plan, if that is still shown. @param {string} hash */
  async #bring(hash) {
    const kept = await photoUnder(hash);
    const picture = kept && (await createImageBitmap(kept.picture));
    if (!kept || this.picture || this.plan !== hash) return;
    Object.assign(this, kept.pose);
    this.#put(picture, kept);
  }

  /** Have a picture, and what is kept of it, below the dance; null: none. @param {ImageBitmap | null} picture @param {Photo["kept"]} kept */
  #put(picture, kept) {
    const had = this.picture;
    [this.picture, this.kept] = [picture, kept];
    if (had || picture) this.#show();
  }

  /** Keep it as it lies now, with the plan above it. */
  #keep() {
    const { kept, middle, scale, points, strength, turned, plan } = this;
    if (!kept) return;
    kept.pose = { middle, scale, points, strength, turned };
    kept.plans = [...kept.plans.filter((one) => one !== plan), plan].slice(-MOST_PLANS);
    this.keeping = this.keeping.then(async () => {
      const id = await keepPhoto(kept);
      if (id !== null) kept.id = id;
      else if (this.kept === kept) this.kept = null;
      this.#tell();
    });
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
      (_key, strength, final) => {
        this.strength = Math.min(Math.max(strength ?? 0, 0), 1);
        this.#show(final);
      },
    );
    this.turn = new NumberControl(
      {
        key: "turned",
        text: () => _("turned to the left"),
        unit: "\u00b0",
        low: -180,
        high: 180,
        step: 1,
      },
      (_key, degrees, final) => this.#turn(degrees ?? 0, final),
    );
    this.where = make("p", { class: "source", role: "status" });
    this.more = make(
      "div",
      {},
      this.where,
      make(
        "div",
        { class: "row" },
        textButton(_("two points and their distance"), () => this.#measure()),
        textButton(_("move it"), () => this.#move()),
        textButton(_("take it away"), () => this.#remove()),
      ),
      this.span.element,
      this.turn.element,
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
    this.turn?.show({ turned: this.turned });
    if (!this.where) return;
    this.where.textContent = this.kept
      ? _(
          "It stays on this device, kept with this plan until you take it away: it is in no file, and is not sent.",
        )
      : _(
          "This browser does not keep it: it is gone once this page is closed. It is in no file, and is not sent.",
        );
  }

  /** Show it as it is now. @param {boolean} [final] whether it is kept so */
  #show(final = false) {
    const { player } = this.host;
    this.#tell();
    if (final) this.#keep();
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
    const blob = await encoded(picture);
    this.#remove();
    const { x, y, width, height, scale } = player.camera;
    this.middle = [x, y];
    this.scale = Math.min(width / picture.width, height / picture.height) / scale;
    this.turned = 0;
    this.#put(picture, blob && { picture: blob, pose: {}, plans: [] });
    this.#keep();
  }

  /** Take it away, from this device, too. */
  #remove() {
    const { kept } = this;
    this.keeping = this.keeping.then(() => kept?.id && forgetPhoto(kept.id));
    this.points = [];
    this.#put(null, null);
  }

  /** Ask for two of its points. */
  #measure() {
    this.host.placing.begin({
      name: _("two points and their distance"),
      says: () => _("Tap two points of the photograph whose distance you know."),
      taps: 2,
      done: (points) => {
        this.points = points;
        this.#show(true);
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
        this.#show(true);
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
    this.#show(true);
  }

  /** Turn it about its middle. @param {number} degrees to the left, in all @param {boolean} final */
  #turn(degrees, final) {
    const by = ((degrees - this.turned) * Math.PI) / 180;
    const [x, y] = this.middle;
    this.points = this.points.map(([u, v]) => [
      x + Math.cos(by) * (u - x) - Math.sin(by) * (v - y),
      y + Math.sin(by) * (u - x) + Math.cos(by) * (v - y),
    ]);
    this.turned = degrees;
    this.#show(final);
  }

  /** Draw it, on a screen alone. @param {CanvasRenderingContext2D} ctx @param {Camera} camera */
  paint(ctx, camera) {
    const { picture, scale, middle, turned } = this;
    if (!picture || this.host.player?.paper.on) return;
    const [x, y] = camera.toScreen(...middle);
    const [wide, tall] = [picture.width, picture.height].map((dots) => dots * scale * camera.scale);
    ctx.save();
    ctx.globalAlpha = this.strength;
    ctx.translate(x, y);
    ctx.rotate((-turned * Math.PI) / 180);
    ctx.drawImage(picture, -0.5 * wide, -0.5 * tall, wide, tall);
    ctx.restore();
  }
}

/** A picture as it is kept, without what its file told besides; null where that cannot be. @param {ImageBitmap} picture @returns {Promise<Blob | null>} */
function encoded(picture) {
  const canvas = make("canvas", { width: String(picture.width), height: String(picture.height) });
  canvas.getContext("2d")?.drawImage(picture, 0, 0);
  return new Promise((done) => canvas.toBlob(done, "image/jpeg", QUALITY));
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
