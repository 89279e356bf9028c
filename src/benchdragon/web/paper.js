// The dance on paper: drawn to a scale that stands beside it, with what tells whose picture it is.

import { Camera } from "./camera.js";
import { fileName } from "./names.js";
import { _, decimals } from "./words.js";

/** @typedef {import("./player.js").Player} Player */
/** @typedef {[number, number, number, number]} Ground left, bottom, right, top, m */

/** CSS pixels of a millimetre of paper. */
const MM = 96 / 25.4;
/** The picture on a sheet of A4 upright is so wide, and at most so tall, also above a bench's card, mm. */
const WIDTH = 186;
const [HEIGHT, ABOVE_CARD] = [175, 105];
/** Below the ground the scale bar has its room, mm. */
const STRIP = 12;
/** Metres on the ground to a metre of paper: the least at which the ground fits is taken. */
const SCALES = [
  1, 2, 5, 10, 20, 25, 50, 75, 100, 150, 200, 250, 300, 400, 500, 750, 1000, 1500, 2000, 2500, 5000,
];
/** Dots of a printed picture for each CSS pixel: a power of two, for Chromium takes a third for 21/64. */
const DENSITY = 4;

/** The scale at which ground fits onto paper that is so tall, mm. @param {Ground} ground @param {number} tall */
export function scaleOf([left, bottom, right, top], tall) {
  const least = 1000 * Math.max((right - left) / WIDTH, (top - bottom) / tall);
  return SCALES.find((scale) => scale >= least) ?? 10 ** Math.ceil(Math.log10(least));
}

/** A view of ground at a scale. @param {Ground} ground @param {number} scale */
function viewOf([left, bottom, right, top], scale) {
  const camera = new Camera();
  camera.scale = (1000 * MM) / scale;
  camera.x = 0.5 * (left + right);
  camera.y = 0.5 * (bottom + top) - (0.5 * STRIP * scale) / 1000;
  camera.resize(Math.floor(WIDTH * MM), Math.ceil((top - bottom) * camera.scale + STRIP * MM));
  return camera;
}

/** A player's page while it is printed. */
export class Paper {
  /** Whether it is. */
  on = false;
  /** The view of the screen meanwhile. @type {Camera | null} */
  #screen = null;
  /** The page's title, which browsers call a printed file by. */
  #title = "";

  /**
   * @param {Player} player
   * @param {() => Ground | null} whole ground that it shows as a whole, if it does
   * @param {() => void} redraw
   */
  constructor(player, whole, redraw) {
    this.player = player;
    this.whole = whole;
    this.redraw = redraw;
    const media = matchMedia("print");
    // Not every browser tells both, nor in the same order.
    media.addEventListener("change", () => this.#turn(media.matches));
    addEventListener("beforeprint", () => this.#turn(true));
    addEventListener("afterprint", () => this.#turn(false));
  }

  /** @param {boolean} on */
  #turn(on) {
    if (on === this.on) return;
    this.on = on;
    const { player } = this;
    const { canvas, painter } = player.face;
    if (on) {
      this.#screen = player.camera;
      player.camera = this.#view();
      painter.resize(player.camera, DENSITY);
      const { title, benches } = player.scene.sent;
      this.#title = document.title;
      document.title = fileName(title.en, title.zh, benches.length.length);
    } else if (this.#screen) {
      player.camera = this.#screen;
      document.title = this.#title;
    }
    canvas.style.width = on ? `${player.camera.width}px` : "";
    canvas.style.height = on ? `${player.camera.height}px` : "";
    this.redraw();
  }

  /** What is drawn; what is said of it is put beside it. */
  #view() {
    const { camera, chosen, face } = this.player;
    const ground = this.whole() ?? [
      ...camera.toGround(0, camera.height),
      ...camera.toGround(camera.width, 0),
    ];
    const scale = scaleOf(ground, chosen < 0 ? HEIGHT : ABOVE_CARD);
    face.onPaper.textContent = this.#words(scale);
    return viewOf(ground, scale);
  }

  /** @param {number} scale */
  #words(scale) {
    const { benches, start, end, fastest } = this.player.scene;
    const speed = decimals(Math.max(...fastest.speed), 3);
    return [
      _("Scale 1:{scale} on A4, printed at 100 %, not fitted to the page.", { scale }),
      _("{benches} benches; {seconds} s; fastest handle {speed} m/s.", {
        benches,
        seconds: decimals(end - start, 1),
        speed,
      }),
      _("Printed on {date}.", { date: today() }),
    ].join(" ");
  }
}

/** The date here. */
function today() {
  const now = new Date();
  const two = (/** @type {number} */ value) => String(value).padStart(2, "0");
  return `${now.getFullYear()}-${two(now.getMonth() + 1)}-${two(now.getDate())}`;
}
