// The player: a dance on a canvas, with a time axis, keys, gestures and a card for each bench.

import { chosenBefore, keepChoice } from "./address.js";
import { clock, occasionText } from "./axis.js";
import { Camera, listen } from "./camera.js";
import { scaleOf } from "./colours.js";
import { Drum } from "./drum.js";
import { Face, ticked } from "./face.js";
import { pressed } from "./keys.js";
import { Boxes } from "./nearness.js";
import { Square } from "./square.js";
import { _, language, shortLength, speak } from "./words.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./colours.js").Kind} Kind */
/** @typedef {import("./nearness.js").Pair} Pair */
/** @typedef {import("./square.js").Beside} Beside */

/** One turn of the loop lasts at most, s. */
const LONGEST_TURN = 0.1;
const THEMES = /** @type {const} */ (["auto", "light", "dark"]);
/** What stays for so long is at rest, ms: browsers refuse to write an address a hundred times in a row. */
export const REST = 180;
/** Dots of a printed picture for each CSS pixel. */
const PAPER_DENSITY = 3;
/** Frame times kept, ms. */
const TIMES_KEPT = 600;
/** A dance that fills less of the canvas is drawn larger when another plan comes. */
const LEAST_FILLED = 0.5;
/** So near to its time an event is here, s: the address gives times to a thousandth. */
const AT_EVENT = 1e-3;

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
    this.drum = new Drum();
    this.look = { trails: false, disc: true, route: true };
    /** @type {number[]} */
    this.frameTimes = [];
    this.still = matchMedia("(prefers-reduced-motion: reduce)");
    this.scene = scene;
    this.stand = scene.room();
    this.boxes = new Boxes(scene);
    this.square = new Square(scene.sent.obstacles, scene.sent.ground);
    /** The pair in the ring. @type {Pair | null} */
    this.ringed = null;
    this.face = new Face(this);
    this.#watch = new ResizeObserver(() => this.#resize());
    this.#attach();
    this.fit(this.#times());
    document.addEventListener("keydown", (event) => pressed(this, event));
    this.#dark.addEventListener("change", () => this.#dressed());
    this.#paper.addEventListener("change", () => this.#onPaper());
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
    this.square = new Square(scene.sent.obstacles, scene.sent.ground);
    this.ringed = null;
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
    if (this.#paper.matches) return;
    const box = this.face.stage.getBoundingClientRect();
    const [width, height] = [Math.max(box.width, 1), Math.max(box.height, 1)];
    const other = width !== this.camera.width || height !== this.camera.height;
    this.camera.resize(width, height);
    this.face.painter.resize(this.camera, devicePixelRatio || 1);
    if (other && this.#fitted.length) this.fit(this.#fitted);
    this.#touch();
  }

  #paper = matchMedia("print");
  /** The view of the screen while another is on paper. @type {Camera | null} */
  #screen = null;

  /** Draw what the canvas shows for paper, which has another shape and is light; or for the screen again. */
  #onPaper() {
    if (this.#paper.matches) {
      this.#screen = this.camera;
      this.camera = this.camera.paper(this.#fitted.length ? this.#room(this.#fitted) : null);
      this.face.painter.resize(this.camera, PAPER_DENSITY);
    } else if (this.#screen) {
      this.camera = this.#screen;
    }
    this.#resize();
    this.#dressed();
    this.#draw(); // a browser that prints takes no turn of the loop before
  }

  /** Light, dark, or as the system says. */
  nextTheme() {
    this.#theme = THEMES[(THEMES.indexOf(this.#theme) + 1) % THEMES.length];
    keepChoice("theme", this.#theme);
    this.#dressed();
  }

  #theme = THEMES.find((theme) => theme === chosenBefore("theme")) ?? "auto";
  #dark = matchMedia("(prefers-color-scheme: dark)");

  #dressed() {
    const asked = this.#theme === "dark" || (this.#theme === "auto" && this.#dark.matches);
    const dark = asked && !this.#paper.matches;
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    this.face.painter.dress();
    this.#touch();
  }

  translate() {
    speak(language() === "zh" ? "en" : "zh");
    keepChoice("lang", language());
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
    this.#touch();
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
    if (benches.length) this.#bring(benches[0] - 1);
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
    this.#resize(); // its card takes room
    if (this.chosen >= 0) this.#bring(this.chosen);
    this.#settled();
  }

  /** Have a bench in sight. @param {number} bench from 0 */
  #bring(bench) {
    this.#pose();
    const { x, y, radius } = this.boxes;
    if (!this.camera.bring(x[bench], y[bench], radius[bench])) return;
    this.#fitted = [];
    this.#touch();
  }

  /** @param {boolean} on */
  follow(on) {
    this.follows = on;
    if (on) this.#fitted = [];
    ticked(this.face.followBox, on);
    this.#touch();
  }

  /** The drum, if the dance has one. @param {boolean} on */
  beat(on) {
    if (!this.scene.sent.beats) return;
    this.drum.turn(on);
    this.face.showBeat(on);
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
    for (const [x, y] of this.square.corners()) {
      across.push(x);
      up.push(y);
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
    this.drum.play(this.scene.sent.beats, this.time, this.playing, this.speed, this.still.matches);
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

  /** @param {number} passed s @param {number} now ms */
  #advance(passed, now) {
    let seconds = passed * this.speed;
    if (this.still.matches) {
      // A picture a second instead of motion.
      if (now - this.#stillSince < 1000) return;
      this.#stillSince = now;
      seconds = this.speed;
    }
    const before = this.time;
    this.time += seconds;
    this.#sayEvents(before);
    if (this.time >= this.scene.end) {
      this.time = this.scene.end;
      this.play(false);
    }
  }

  #pose() {
    this.scene.stand(this.time, this.stand);
    this.boxes.place(this.stand);
  }

  /** The tightest pair; at rest at an event the event's own, which may be near by the chain alone. */
  #tightest() {
    const tightest = this.boxes.measure();
    if (this.playing) return tightest;
    const here = this.scene.sent.occasions.find(
      ({ time, benches }) => benches.length === 2 && Math.abs(time - this.time) < AT_EVENT,
    );
    return here ? this.boxes.pair(here.benches[0] - 1, here.benches[1] - 1) : tightest;
  }

  /** How near benches are to one another and to what stands on the square. @param {Pair | null} tightest @param {Beside | null} beside */
  #nearText(tightest, beside) {
    const own = tightestText(tightest, this.boxes);
    return beside ? `${own}; ${this.square.text(beside, this.boxes.touch)}` : own;
  }

  /** At rest at an event of an obstacle: how its bench stands to that. */
  #meeting() {
    if (this.playing) return null;
    const here = this.scene.sent.occasions.find(
      ({ time, obstacle }) => obstacle !== null && Math.abs(time - this.time) < AT_EVENT,
    );
    if (!here || here.obstacle == null) return null;
    return this.square.pair(this.boxes, here.benches[0] - 1, here.obstacle);
  }

  #draw() {
    this.#pose();
    const tightest = this.#tightest();
    this.ringed = this.playing ? this.boxes.held(tightest, this.ringed) : tightest;
    if (this.follows) {
      const bench = Math.max(this.chosen, 0);
      [this.camera.x, this.camera.y] = [this.boxes.x[bench], this.boxes.y[bench]];
    }
    const beside = this.square.measure(this.boxes);
    const scale = scaleOf(this.kind, this.scene, this.stand, this.boxes);
    const { scene, stand, boxes, square, camera, chosen, ruler, face } = this;
    const ringed = this.#meeting() ?? this.ringed;
    const drawn = { scene, stand, boxes, square, camera, chosen, ruler, ringed, scale };
    face.painter.paint({ ...drawn, ...this.look });
    this.#painted = this.time;
    face.axis.show(this.time, this.playing);
    face.clock.textContent = `t = ${clock(this.time, 2)}`;
    face.tight.textContent = this.#nearText(tightest, beside);
    face.card.show(stand, boxes, chosen);
    face.showLegend(scale);
    this.root.dataset.time = this.time.toFixed(3);
  }

  /** Tell of what has happened since a time, s, to those who cannot see it; joints are too many. @param {number} before */
  #sayEvents(before) {
    const passed = this.scene.sent.occasions.filter(
      ({ kind, time }) => kind !== "joint" && before < time && time <= this.time,
    );
    if (!passed.length) return;
    this.face.spoken.textContent = passed
      .map((one) => `t = ${clock(one.time)}. ${occasionText(one)}`)
      .join("; ");
  }

  /** Tell what the canvas shows to those who cannot see it. */
  #say() {
    const tightest = this.#tightest();
    const near = this.#nearText(tightest, this.square.measure(this.boxes));
    const text = `t = ${clock(this.time)}. ${near}`;
    this.face.canvas.setAttribute("aria-label", `${_("the dragon from above")}: ${text}`);
    this.face.spoken.textContent = text;
  }

  /** The page may have come to rest: once it has, tell it, and put it into the address. */
  #settled() {
    this.#pose();
    clearTimeout(this.#resting);
    this.#resting = setTimeout(() => {
      this.#say();
      this.onSettled?.();
    }, REST);
  }

  #resting = 0;

  /** Called when the page has come to rest. @type {(() => void) | undefined} */
  onSettled;
}

/** @param {Pair | null} pair @param {Boxes} boxes */
function tightestText(pair, { count, reach, touch }) {
  if (count < 3) return _("no pair counts");
  if (!pair) return _("no other coil within {reach}", { reach: shortLength(reach) });
  const benches = { a: pair.i + 1, b: pair.j + 1 };
  if (pair.distance <= touch) return _("benches {a} and {b} touch", benches);
  return _("tightest {gap}: benches {a} and {b}", { gap: shortLength(pair.distance), ...benches });
}
