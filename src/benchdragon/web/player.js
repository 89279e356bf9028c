// The player: a dance on a canvas, with a time axis, keys, gestures and a card for each bench.

import { clock } from "./axis.js";
import { Camera, listen } from "./camera.js";
import { KINDS, scaleOf } from "./colours.js";
import { Face, FRAME, ticked } from "./face.js";
import { Boxes } from "./nearness.js";
import { _, language, shortLength, speak } from "./words.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./colours.js").Kind} Kind */

/** One turn of the loop lasts at most, s. */
const LONGEST_TURN = 0.1;
const THEMES = /** @type {const} */ (["auto", "light", "dark"]);
/** The page speaks to screen readers this often while it plays, ms. */
const SPOKEN_EACH = 5000;
/** What stays for so long is at rest, ms: browsers refuse to write an address a hundred times in a row. */
export const REST = 180;
/** Frame times kept, ms. */
const TIMES_KEPT = 600;
/** A dance that fills less of the canvas is drawn larger when another plan comes. */
const LEAST_FILLED = 0.5;

export class Player {
  /**
   * @param {HTMLElement} root
   * @param {Scene} scene
   */
  constructor(root, scene) {
    this.root = root;
    this.camera = new Camera();
    this.time = scene.start;
    this.playing = false;
    this.speed = 1;
    this.chosen = -1;
    this.follows = false;
    this.ruling = false;
    /** @type {[number, number][]} */
    this.ruler = [];
    /** @type {Kind} */
    this.kind = "plain";
    this.look = { trails: false, disc: true, route: true };
    /** @type {number[]} */
    this.frameTimes = [];
    this.still = matchMedia("(prefers-reduced-motion: reduce)");
    this.scene = scene;
    this.stand = scene.room();
    this.boxes = new Boxes(scene);
    this.face = new Face(this);
    this.#watch = new ResizeObserver(() => this.#resize());
    this.#attach();
    this.fit(this.#times());
    document.addEventListener("keydown", (event) => this.#key(event));
    this.#dark.addEventListener("change", () => this.#dressed());
    requestAnimationFrame((now) => this.#turn(now));
  }

  /** @type {ResizeObserver} */
  #watch;

  /** Show another dance, at the same time and place. @param {Scene} scene */
  show(scene) {
    const other = scene.sent.title.en !== this.scene.sent.title.en;
    this.scene = scene;
    this.stand = scene.room();
    this.boxes = new Boxes(scene);
    this.time = Math.min(Math.max(this.time, scene.start), scene.end);
    if (this.chosen >= scene.benches) this.chosen = -1;
    this.#newFace();
    if (!this.follows && (other || (this.#fitted.length && !this.#fits()))) this.fit(this.#times());
  }

  /** Whether the whole dance is in sight, and fills a good part of it. */
  #fits() {
    const [left, bottom, right, top] = this.#room(this.#times());
    const { width, height, scale } = this.camera;
    const [west, south] = this.camera.toGround(0, height);
    const [east, north] = this.camera.toGround(width, 0);
    const inside = left >= west && bottom >= south && right <= east && top <= north;
    return inside && scale * Math.max((right - left) / width, (top - bottom) / height) > LEAST_FILLED;
  }

  /** Another face, whose lists are open where they were. */
  #newFace() {
    const open = this.face.lists.map((list) => list.open);
    this.face = new Face(this);
    this.face.lists.forEach((list, n) => {
      list.open = open[n];
    });
    this.#attach();
  }

  /** Put the face onto the page. */
  #attach() {
    const { canvas, stage, elements } = this.face;
    this.root.replaceChildren(...elements);
    this.face.showChosen(this.chosen);
    listen(canvas, this.camera, {
      moved: () => this.#touched(),
      tapped: (px, py) =>
        this.choose(this.boxes.at(...this.camera.toGround(px, py), 12 / this.camera.scale)),
      measured: (px, py, ended, began) => this.#measured(px, py, ended, began),
    });
    this.#watch.disconnect();
    this.#watch.observe(stage);
    this.#resize();
    this.#dressed();
    this.play(this.playing);
  }

  #resize() {
    const box = this.face.stage.getBoundingClientRect();
    const density = devicePixelRatio || 1;
    const { canvas } = this.face;
    [canvas.width, canvas.height] = [
      Math.max(Math.round(box.width * density), 1),
      Math.max(Math.round(box.height * density), 1),
    ];
    const [width, height] = [Math.max(box.width, 1), Math.max(box.height, 1)];
    const other = width !== this.camera.width || height !== this.camera.height;
    this.camera.resize(width, height);
    if (other && this.#fitted.length) this.fit(this.#fitted);
    this.#touch();
  }

  /** Light, dark, or as the system says. */
  nextTheme() {
    this.#theme = THEMES[(THEMES.indexOf(this.#theme) + 1) % THEMES.length];
    this.#dressed();
  }

  /** @type {typeof THEMES[number]} */
  #theme = "auto";
  #dark = matchMedia("(prefers-color-scheme: dark)");

  #dressed() {
    const dark = this.#theme === "dark" || (this.#theme === "auto" && this.#dark.matches);
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    this.face.painter.dress();
    this.#touch();
  }

  translate() {
    speak(language() === "zh" ? "en" : "zh");
    this.#newFace();
    this.onTranslated?.();
  }

  /** Called when the page has changed its language. @type {(() => void) | undefined} */
  onTranslated;

  /** @param {boolean} on */
  play(on) {
    if (on && this.time >= this.scene.end) this.time = this.scene.start;
    this.playing = on;
    this.face.showPlaying(on);
    if (!on) this.#settled();
  }

  /** @param {number} seconds */
  step(seconds) {
    this.play(false);
    this.jump(this.time + seconds);
  }

  /** Go to a time, s; and to the first of some benches, where it is not in sight. @param {number} time @param {number[]} [benches] */
  jump(time, benches = []) {
    this.time = Math.min(Math.max(time, this.scene.start), this.scene.end);
    this.#touch();
    if (benches.length) {
      this.#pose();
      const bench = benches[0] - 1;
      const [px, py] = this.camera.toScreen(this.boxes.x[bench], this.boxes.y[bench]);
      if (px < 0 || py < 0 || px > this.camera.width || py > this.camera.height) {
        this.#fitted = [];
        [this.camera.x, this.camera.y] = [this.boxes.x[bench], this.boxes.y[bench]];
      }
    }
    if (!this.playing) this.#settled();
  }

  /** To the event before or after. @param {1 | -1} way */
  event(way) {
    const ahead = this.scene.sent.occasions.filter(({ time }) => way * (time - this.time) > 1e-6);
    ahead.sort((a, b) => way * (a.time - b.time));
    if (ahead.length) this.jump(ahead[0].time, ahead[0].benches);
  }

  /** @param {number} bench from 0; -1: none */
  choose(bench) {
    this.chosen = Math.min(Math.max(bench, -1), this.scene.benches - 1);
    this.face.showChosen(this.chosen);
    this.#touch();
    this.#settled();
  }

  /** @param {boolean} on */
  follow(on) {
    this.follows = on;
    if (on) this.#fitted = [];
    ticked(this.face.followBox, on);
    this.#touch();
  }

  /** @param {boolean} on */
  rule(on) {
    this.ruling = on;
    if (!on) this.ruler = [];
    ticked(this.face.ruleBox, on);
    this.face.canvas.classList.toggle("ruling", on);
    this.#touch();
  }

  /** @param {Kind} kind */
  paintBy(kind) {
    this.kind = kind;
    this.face.kinds.value = kind;
    this.#touch();
  }

  /** @param {"trails" | "disc" | "route"} what @param {boolean} on */
  see(what, on) {
    this.look[what] = on;
    if (what === "trails") ticked(this.face.trailBox, on);
    this.#touch();
  }

  /** @param {number} factor */
  zoom(factor) {
    this.camera.zoom(factor, 0.5 * this.camera.width, 0.5 * this.camera.height);
    this.#touched();
  }

  /** Show the whole dragon as it stands, or as it does at some times, and the disc. @param {number[]} [times] */
  fit(times = [this.time]) {
    this.#fitted = times;
    this.camera.fit(...this.#room(times));
    this.#touch();
  }

  /** Ground that the dragon takes at some times, and the disc: left, bottom, right, top. @param {number[]} times @returns {[number, number, number, number]} */
  #room(times) {
    const { disc, centre } = this.scene.sent;
    const room = this.boxes.half[0] * 2;
    /** @type {number[]} */
    const across = [];
    /** @type {number[]} */
    const up = [];
    for (const time of times) {
      const { x, y } = this.scene.stand(time, this.stand);
      across.push(Math.min(...x), Math.max(...x));
      up.push(Math.min(...y), Math.max(...y));
    }
    if (disc !== null) {
      across.push(centre[0] - disc, centre[0] + disc);
      up.push(centre[1] - disc, centre[1] + disc);
    }
    return [
      Math.min(...across) - room,
      Math.min(...up) - room,
      Math.max(...across) + room,
      Math.max(...up) + room,
    ];
  }

  /** Times whose places the camera was fitted to, and is again when the page changes its size. @type {number[]} */
  #fitted = [];

  /** Times spread over the whole dance. */
  #times() {
    const { start, end } = this.scene;
    return Array.from({ length: 9 }, (_unused, n) => start + (n / 8) * (end - start));
  }

  /** A gesture moved the camera: stop following. */
  #touched() {
    this.#fitted = [];
    if (this.follows) this.follow(false);
    this.#touch();
  }

  /** @param {number} px @param {number} py @param {boolean} ended @param {boolean} began */
  #measured(px, py, ended, began) {
    if (!this.ruling) return false;
    const here = this.camera.toGround(px, py);
    if (began) this.ruler = [here];
    else if (this.ruler.length && !ended) this.ruler = [this.ruler[0], here];
    this.#touch();
    return true;
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const target = /** @type {Element | null} */ (
      event.target instanceof Element ? event.target : null
    );
    const typing = target?.closest(
      "select, textarea, dialog, input:not([type=range], [type=checkbox])",
    );
    const other = target?.closest("input") && !this.root.contains(target); // a slider of the plan
    if (typing || other || event.ctrlKey || event.metaKey || event.altKey) return;
    const space = event.key === " " && !target?.closest("button, summary, input");
    const action = space ? () => this.play(!this.playing) : this.#keys[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  /** @type {Record<string, () => void>} */
  #keys = {
    ArrowLeft: () => this.step(-1),
    ArrowRight: () => this.step(1),
    ",": () => this.step(-FRAME),
    ".": () => this.step(FRAME),
    Home: () => this.jump(this.scene.start),
    End: () => this.jump(this.scene.end),
    p: () => this.event(-1),
    n: () => this.event(1),
    "+": () => this.zoom(1.4),
    "=": () => this.zoom(1.4),
    "-": () => this.zoom(1 / 1.4),
    0: () => this.fit(),
    "[": () => this.choose(Math.max(this.chosen - 1, 0)),
    "]": () => this.choose(this.chosen + 1),
    f: () => this.follow(!this.follows),
    t: () => this.see("trails", !this.look.trails),
    r: () => this.rule(!this.ruling),
    c: () => this.paintBy(KINDS[(KINDS.indexOf(this.kind) + 1) % KINDS.length]),
    Escape: () => this.choose(-1),
  };

  /** Something changed: draw at the next turn of the loop. */
  #touch() {
    this.#painted = NaN;
  }

  /** Time that is on the canvas; NaN, which is no time, where that is out of date. */
  #painted = NaN;
  #before = 0;

  /** One turn of the loop. @param {number} now ms */
  #turn(now) {
    const passed = Math.min((now - this.#before) / 1000, LONGEST_TURN);
    if (this.playing) this.#advance(passed, now);
    if (this.#painted !== this.time || this.playing) {
      const began = performance.now();
      this.#draw();
      this.frameTimes.push(performance.now() - began);
      if (this.frameTimes.length > TIMES_KEPT) this.frameTimes.shift();
    }
    this.#before = now;
    requestAnimationFrame((next) => this.#turn(next));
  }

  #stillSince = 0;
  #spokenAt = 0;

  /** @param {number} passed s @param {number} now ms */
  #advance(passed, now) {
    let seconds = passed * this.speed;
    if (this.still.matches) {
      // A picture a second instead of motion.
      if (now - this.#stillSince < 1000) return;
      this.#stillSince = now;
      seconds = this.speed;
    }
    this.time += seconds;
    if (this.time >= this.scene.end) {
      this.time = this.scene.end;
      this.play(false);
    }
    if (now - this.#spokenAt > SPOKEN_EACH) this.#say(now);
  }

  #pose() {
    this.scene.stand(this.time, this.stand);
    this.boxes.place(this.stand);
  }

  #draw() {
    this.#pose();
    const tightest = this.boxes.measure();
    if (this.follows) {
      const bench = Math.max(this.chosen, 0);
      [this.camera.x, this.camera.y] = [this.boxes.x[bench], this.boxes.y[bench]];
    }
    const scale = scaleOf(this.kind, this.scene, this.stand, this.boxes);
    const { scene, stand, boxes, camera, chosen, ruler, face } = this;
    face.painter.paint({ scene, stand, boxes, camera, chosen, ruler, tightest, scale, ...this.look });
    this.#painted = this.time;
    face.axis.show(this.time);
    face.clock.textContent = `t = ${clock(this.time, 2)}`;
    face.tight.textContent = tightestText(tightest, this.boxes);
    face.card.show(stand, boxes, chosen);
    face.showLegend(scale);
    this.root.dataset.time = this.time.toFixed(3);
  }

  /** Tell what the canvas shows to those who cannot see it. @param {number} now ms */
  #say(now) {
    this.#spokenAt = now;
    const tightest = this.boxes.measure();
    const text = `t = ${clock(this.time)}. ${tightestText(tightest, this.boxes)}`;
    this.face.canvas.setAttribute("aria-label", `${_("the dragon from above")}: ${text}`);
    this.face.spoken.textContent = text;
  }

  /** The page may have come to rest: once it has, tell it, and put it into the address. */
  #settled() {
    this.#pose();
    clearTimeout(this.#resting);
    this.#resting = setTimeout(() => {
      this.#say(performance.now());
      this.onSettled?.();
    }, REST);
  }

  #resting = 0;

  /** Called when the page has come to rest. @type {(() => void) | undefined} */
  onSettled;
}

/** @param {import("./nearness.js").Pair | null} pair @param {Boxes} boxes */
function tightestText(pair, { count, reach, touch }) {
  if (count < 3) return _("no pair counts");
  if (!pair) return _("all benches more than {reach} apart", { reach: shortLength(reach) });
  const benches = { a: pair.i + 1, b: pair.j + 1 };
  if (pair.distance <= touch) return _("benches {a} and {b} touch", benches);
  return _("tightest {gap}: benches {a} and {b}", { gap: shortLength(pair.distance), ...benches });
}
