// The player: a dance on a canvas, with a time axis, keys, gestures and a card for each bench.

import { chosenBefore, keepChoice } from "./address.js";
import { clock, toldTime } from "./axis.js";
import { Camera, listen } from "./camera.js";
import { scaleOf } from "./colours.js";
import { Drum } from "./drum.js";
import { extent, spread } from "./extent.js";
import { Face, ticked } from "./face.js";
import { Flight } from "./flight.js";
import { Hold } from "./hold.js";
import { pressed } from "./keys.js";
import { Loop } from "./loop.js";
import { meetingOf, nearnessText, passedText, tightestOf, touchOf } from "./nearby.js";
import { Boxes } from "./nearness.js";
import { Paper } from "./paper.js";
import { Square } from "./square.js";
import { elementAt, wayTo } from "./way.js";
import { _, language, speak } from "./words.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./colours.js").Kind} Kind */
/** @typedef {import("./nearness.js").Pair} Pair */

const THEMES = /** @type {const} */ (["auto", "light", "dark"]);
/** What stays for so long is at rest, ms: browsers refuse to write an address a hundred times in a row. */
export const REST = 180;
/** Frame times kept, ms. */
const TIMES_KEPT = 600;
/** Share of the picture's smaller side that a bench takes where a pair is shown. */
const PAIR_SHARE = 0.5;
/** A pair that is shown up to so many times as large stays as it is. */
const PAIR_LARGER = 2;
/** A dance that fills less of the canvas is drawn larger when another plan comes. */
const LEAST_FILLED = 0.5;
export class Player {
  /** @param {HTMLElement} root @param {Scene} scene */
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
    const [dressed, ground] = [chosenBefore("drawn") !== "plain", scene.sent.ground.length > 0];
    this.look = { trails: false, disc: true, route: true, dressed, ground };
    /** @type {number[]} */
    this.frameTimes = [];
    this.still = matchMedia("(prefers-reduced-motion: reduce)");
    this.scene = scene;
    this.stand = scene.room();
    this.boxes = new Boxes(scene);
    this.square = new Square(scene.sent);
    /** A photograph below all. @type {import("./paint.js").Picture["below"]} */
    this.below = null;
    /** The pair in the ring. @type {Pair | null} */
    this.ringed = null;
    this.face = new Face(this);
    this.paper = new Paper(
      this,
      () => (this.#fitted.length ? this.room(this.#fitted, this.boxes.half[0]) : null),
      () => this.#redrawn(),
    );
    this.#watch = new ResizeObserver(() => this.#resize());
    this.hold = new Hold(() => this.#freed());
    this.#attach();
    this.fit(spread(this.scene));
    document.addEventListener("keydown", (event) => pressed(this, event));
    this.#dark.addEventListener("change", () => this.#dressed());
  }

  /** @type {ResizeObserver} */
  #watch;

  /** What waits until no hand holds the picture or the time axis. @type {(() => void) | null} */
  #next = null;

  /** Show another dance once no hand holds the picture or the time axis, which it takes the place of: the newest alone. @param {() => void} show */
  whenFree(show) {
    this.#next = show;
    if (!this.hold.on) this.#freed();
  }

  #freed() {
    const next = this.#next;
    this.#next = null;
    next?.();
  }

  /** Show another dance, at the same time and place. @param {Scene} scene */
  show(scene) {
    const other = scene.sent.title.en !== this.scene.sent.title.en;
    this.scene = scene;
    this.stand = scene.room();
    this.boxes = new Boxes(scene);
    this.square = new Square(scene.sent);
    this.ringed = null;
    this.time = Math.min(Math.max(this.time, scene.start), scene.end);
    if (this.chosen >= scene.benches) this.chosen = -1;
    this.#newFace();
    if (!this.follows && (other || (this.#fitted.length && !this.#fits())))
      this.fit(spread(this.scene));
  }

  /** Whether the whole dance is in sight, and fills a good part of it. */
  #fits() {
    const [left, bottom, right, top] = this.room(spread(this.scene));
    const { width, height, scale } = this.camera;
    const [west, south] = this.camera.toGround(0, height);
    const [east, north] = this.camera.toGround(width, 0);
    const inside = left >= west && bottom >= south && right <= east && top <= north;
    return inside && scale * Math.max((right - left) / width, (top - bottom) / height) > LEAST_FILLED;
  }

  /** Another face, whose lists are open where they were, and which has the focus where it was. */
  #newFace() {
    const open = this.face.lists.map((list) => list.open);
    const way = wayTo(document.activeElement, this.root);
    const { story } = this.face;
    this.face = new Face(this);
    this.face.lists.forEach((list, n) => {
      list.open = open[n];
    });
    this.#attach();
    const { plan_sha256: hash } = this.scene.sent;
    const same = story.scene === this.scene || (hash && story.scene.sent.plan_sha256 === hash);
    if (same && story.tale && story.open) {
      this.face.tell(story.tale, story.at, story.paused);
      this.face.story.next = story.next;
    }
    if (way) elementAt(way, this.root)?.focus({ preventScroll: true });
  }

  /** Put the face onto the page. */
  #attach() {
    const { canvas, stage, axis, elements } = this.face;
    this.root.replaceChildren(...elements);
    this.hold.watch(canvas);
    this.hold.watch(axis.slider);
    this.face.showChosen(this.chosen);
    listen(canvas, this.camera, {
      moved: () => this.#touched(),
      tapped: (px, py) => this.onTapped(this.camera.toGround(px, py)),
      measured: (px, py, ended, began) => this.#measured(px, py, ended, began),
    });
    this.#watch.disconnect();
    this.#watch.observe(stage);
    this.#resize();
    this.#dressed();
    this.play(this.playing);
  }

  #resize() {
    if (this.paper.on) return;
    const box = this.face.stage.getBoundingClientRect();
    const [width, height] = [Math.max(box.width, 1), Math.max(box.height, 1)];
    const other = width !== this.camera.width || height !== this.camera.height;
    this.camera.resize(width, height);
    this.face.painter.resize(this.camera, devicePixelRatio || 1);
    if (other && this.#fitted.length) this.fit(this.#fitted);
    this.#touch();
  }

  /** Draw at once, for paper or for the screen again: a browser that prints takes no turn of the loop before. */
  #redrawn() {
    this.#resize();
    this.#dressed();
    this.#draw();
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
    const dark = asked && !this.paper.on;
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

  /** What a tap at a place of the ground, m, does. @param {[number, number]} at */
  onTapped = (at) => this.choose(this.boxes.at(...at, 12 / this.camera.scale));

  /** What else keys do on the page. @returns {[string, string][]} */
  more = () => [];

  /** Called when the page has changed its language. @type {(() => void) | undefined} */
  onTranslated;

  /** @param {boolean} on */
  play(on) {
    if (on) this.face.story.end();
    if (on && this.time >= this.scene.end) this.time = this.scene.start;
    this.playing = on;
    this.face.showPlaying(on);
    this.#touch();
    if (!on) this.settled();
  }

  /** @param {number} seconds */
  step(seconds) {
    this.play(false);
    this.jump(this.time + seconds);
  }

  /** Go to a time, s; and to the pair of benches that meet then, or to a bench that is not in sight. @param {number} time @param {number[]} [benches] */
  jump(time, benches = []) {
    this.face.story.end();
    this.put(time);
    const [a, b] = benches.map((bench) => bench - 1);
    if (benches.length === 2 && !this.follows) this.#near(a, b);
    else if (benches.length) this.#bring(a);
    if (!this.playing) this.settled();
  }

  /** Have the dance at a time, s. @param {number} time */
  put(time) {
    this.time = Math.min(Math.max(time, this.scene.start), this.scene.end);
    this.pose();
    this.#touch();
  }

  /** @type {Flight | null} */
  #flight = null;

  /** Go near a pair of benches, numbers from 0. @param {number} a @param {number} b */
  #near(a, b) {
    const { from, to } = this.boxes.pair(a, b);
    const least = this.pairScale(a, b);
    const scale = Math.min(Math.max(this.camera.scale, least), PAIR_LARGER * least);
    const goal = { x: 0.5 * (from[0] + to[0]), y: 0.5 * (from[1] + to[1]), scale };
    this.#fitted = [];
    this.#flight = new Flight(this.camera, () => goal);
    if (this.still.matches) this.#flight.cut(this.camera);
  }

  /** CSS pixels a metre at which a pair of benches is well seen. @param {number} a @param {number} b */
  pairScale(a, b) {
    const longest = 2 * Math.max(this.boxes.half[a], this.boxes.half[b]);
    return (PAIR_SHARE * Math.min(this.camera.width, this.camera.height)) / longest;
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
    this.settled();
  }

  /** Have a bench in sight. @param {number} bench from 0 */
  #bring(bench) {
    this.pose();
    this.#flight = null;
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

  /** @param {"trails" | "disc" | "route" | "dressed" | "ground"} what @param {boolean} on */
  see(what, on) {
    this.look[what] = on;
    if (what === "trails") ticked(this.face.trailBox, on);
    if (what === "dressed") {
      ticked(this.face.dressBox, on);
      keepChoice("drawn", on ? "dragon" : "plain");
    }
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
    this.#flight = null;
    this.camera.fit(...this.room(times));
    this.#touch();
  }

  /** Ground that the dragon takes at some times, and what stands there: left, bottom, right, top. @param {number[]} times @param {number} room about all that, m */
  room(times, room = 2 * this.boxes.half[0]) {
    return extent(this.scene, this.stand, this.square, times, room);
  }

  /** Times whose places the camera was fitted to, and is again when the page changes its size. @type {number[]} */
  #fitted = [];

  /** A gesture moved the camera: stop following. */
  #touched() {
    this.#fitted = [];
    this.#flight = null;
    if (this.face.story.runs) this.face.story.pause(true);
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
    this.wake();
  }

  #loop = new Loop((passed, now) => this.#turn(passed, now));

  /** Turn the loop until nothing moves any more. */
  wake() {
    this.#loop.wake();
  }

  /** Whether the canvas is out of date, or not painted to its end. */
  get #stale() {
    return this.#painted !== this.time || this.face.painter.unfinished;
  }

  /** Whether something moves by itself, or is still to be drawn. */
  get #moves() {
    return this.playing || this.face.story.runs || this.#flight !== null || this.#stale;
  }

  /** Time that is on the canvas; NaN, which is no time, where that is out of date. */
  #painted = NaN;
  /** One turn of the loop; whether it goes on. @param {number} passed s @param {number} now ms */
  #turn(passed, now) {
    if (this.playing) this.#advance(passed, now);
    this.face.story.turn(passed);
    this.#fly(passed);
    this.drum.play(this.scene.sent.beats, this.time, this.playing, this.speed, this.still.matches);
    if (this.#stale) {
      const began = performance.now();
      this.#draw();
      this.frameTimes.push(performance.now() - began);
      if (this.frameTimes.length > TIMES_KEPT) this.frameTimes.shift();
    }
    return this.#moves;
  }

  /** @param {number} passed s */
  #fly(passed) {
    if (!this.#flight) return;
    if (this.#flight.step(this.camera, passed)) this.#flight = null;
    this.#touch();
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
    const happened = passedText(this, before);
    if (happened) this.face.spoken.textContent = happened;
    if (this.time >= this.scene.end) {
      this.time = this.scene.end;
      this.play(false);
    }
  }

  /** Put the benches where they are now. */
  pose() {
    this.scene.stand(this.time, this.stand);
    this.boxes.place(this.stand);
  }

  #draw() {
    this.pose();
    const tightest = tightestOf(this);
    this.ringed = this.playing ? this.boxes.held(tightest, this.ringed) : tightest;
    if (this.follows) {
      const bench = Math.max(this.chosen, 0);
      [this.camera.x, this.camera.y] = [this.boxes.x[bench], this.boxes.y[bench]];
    }
    const beside = this.square.measure(this.boxes);
    const scale = scaleOf(this.kind, this.scene, this.stand, this.boxes);
    const { scene, stand, boxes, square, camera, chosen, ruler, face, below } = this;
    const ringed = meetingOf(this) ?? touchOf(this, beside) ?? this.ringed;
    const drawn = { scene, stand, boxes, square, camera, chosen, ruler, ringed, scale, below };
    face.painter.paint({ ...drawn, ...this.look, north: this.paper.on && scene.sent.north === true });
    this.#painted = this.time;
    face.axis.show(this.time, this.playing || face.story.runs);
    face.clock.textContent = toldTime(this.scene, this.time, `t = ${clock(this.time, 2)}`);
    face.tight.textContent = nearnessText(this, tightest, beside);
    face.card.show(stand, boxes, chosen);
    face.showLegend(scale);
    this.root.dataset.time = this.time.toFixed(3);
    this.onDrawn?.();
  }

  /** Called when the picture was drawn. @type {(() => void) | undefined} */
  onDrawn;

  /** Tell what the canvas shows to those who cannot see it. */
  #say() {
    const near = nearnessText(this, tightestOf(this), this.square.measure(this.boxes));
    const text = `${toldTime(this.scene, this.time, `t = ${clock(this.time)}`)}. ${near}`;
    this.face.canvas.setAttribute("aria-label", `${_("the dragon from above")}: ${text}`);
    this.face.spoken.textContent = text;
  }

  /** The page may have come to rest: once it has, tell it, and put it into the address. */
  settled() {
    this.pose();
    clearTimeout(this.#resting);
    this.#resting = setTimeout(() => {
      if (!this.face.story.open) this.#say();
      this.onSettled?.();
    }, REST);
  }

  #resting = 0;

  /** Called when the page has come to rest. @type {(() => void) | undefined} */
  onSettled;
}
