// A guided story of half a minute: steps of a tale, each with its sentence, its time and its view.

import { drawnSign, make, signButton } from "./elements.js";
import { Flight } from "./flight.js";
import { _ } from "./words.js";

/** @typedef {import("./player.js").Player} Player */
/** @typedef {import("./flight.js").View} View */
/** @typedef {import("./square.js").Beside} Beside */

/**
 * A step of a story.
 * @typedef {object} Step
 * @property {string} text
 * @property {number} from time of the dance, s
 * @property {number} to
 * @property {number} seconds how long it takes
 * @property {"whole" | "disc" | "pair" | "close"} view
 * @property {number[]} benches that it is about, from 1: a pair, one beside the obstacle or of the handle, or none
 * @property {number | null} obstacle from 0, that it is about
 * @property {Ringed | null} ringed the handle that it is about
 * @property {number} ground on the picture's smaller side where all is close, m
 */
/** A handle that a step is about, number from 0, and what its ring says. @typedef {{ handle: number, text: string }} Ringed */
/**
 * What can be told of a dance: its name, and its steps, both in the language in use.
 * @typedef {{ name: () => string, steps: (player: Player) => Step[] }} Tale
 */
/** What a handle's ring is drawn with: see `Beside` of square.js.
 * @typedef {{ i: number, distance: number, from: [number, number], to: [number, number], text: string }} Told */

/** So much of the disc's radius is shown of the ground about the centre. */
const ROOM = 1.5;
/** The view goes after what it shows so slowly, s. */
const CALM = 0.3;
/** Where motion is unwanted, a story shows so many pictures a second. */
const STILL = 1;
const PLAYING = "M7 4v16l13-8z";
const PAUSED = "M6 4h4v16H6zM14 4h4v16h-4z";
const BACK = "M16 4v16L5 12z";
const ON = "M8 4v16l11-8z";

export class Story {
  /** @param {Player} player */
  constructor(player) {
    this.player = player;
    this.scene = player.scene;
    /** What is told. @type {Tale | null} */
    this.tale = null;
    /** What comes after the last step, if anything does. @type {(() => void) | null} */
    this.next = null;
    /** @type {Step[]} */
    this.steps = [];
    this.at = -1;
    this.elapsed = 0;
    this.paused = false;
    /** @type {Flight | null} */
    this.flight = null;
    this.texts = make("div", { class: "captions" });
    this.place = make("span", { class: "place" });
    this.pauseButton = signButton(drawnSign(PAUSED), _("pause the story"), () => this.pause());
    this.element = make(
      "section",
      { class: "story", hidden: true, "aria-label": _("story") },
      this.texts,
      make(
        "div",
        { class: "steps" },
        this.place,
        signButton(drawnSign(BACK), _("the step before"), () => this.go(this.at - 1)),
        this.pauseButton,
        signButton(drawnSign(ON), _("the next step"), () => this.go(this.at + 1)),
        signButton("\u2715", _("end the story"), () => this.end()),
      ),
    );
  }

  /** Whether the story is told now. */
  get open() {
    return this.at >= 0;
  }

  /** Whether it moves by itself now. */
  get runs() {
    return this.open && !this.paused;
  }

  /** The step that is told now, if it is about something in the picture. @returns {Step | null} */
  get #about() {
    const step = this.open ? this.steps[this.at] : null;
    return step && step.view !== "whole" && step.view !== "disc" ? step : null;
  }

  /** The step's pair, numbers from 0. @returns {[number, number] | null} */
  get pair() {
    const [a, b] = this.#about?.benches ?? [];
    return b ? [a - 1, b - 1] : null;
  }

  /** What the step is about beside a pair: how a bench stands to an obstacle, or a handle. @returns {Beside | Told | null} */
  get met() {
    const about = this.#about;
    if (!about) return null;
    const { boxes, square, stand } = this.player;
    const { benches, obstacle, ringed } = about;
    if (obstacle !== null) return square.pair(boxes, benches[0] - 1, obstacle);
    if (!ringed) return null;
    /** @type {[number, number]} */
    const here = [stand.x[ringed.handle], stand.y[ringed.handle]];
    return { i: benches[0] - 1, distance: Infinity, from: here, to: here, text: ringed.text };
  }

  /** Begin, or go on where another story of the same dance was. @param {Tale} tale @param {number} [at] @param {boolean} [paused] */
  begin(tale, at = 0, paused = false) {
    const { player } = this;
    player.play(false);
    if (player.follows) player.follow(false);
    this.tale = tale;
    this.next = null;
    this.steps = tale.steps(player);
    this.texts.replaceChildren(...this.steps.map(({ text }) => make("p", {}, text)));
    this.element.setAttribute("aria-label", tale.name());
    this.element.hidden = false;
    this.go(at);
    if (paused) this.pause(true);
    this.pauseButton.focus({ preventScroll: true });
    this.element.scrollIntoView({ block: "nearest" });
  }

  /** Go to a step, from its beginning. @param {number} step */
  go(step) {
    if (step === this.steps.length && this.next) return this.next();
    this.at = Math.min(Math.max(step, 0), this.steps.length - 1);
    this.elapsed = 0;
    const { text } = this.steps[this.at];
    [...this.texts.children].forEach((one, n) => one.classList.toggle("now", n === this.at));
    this.place.textContent = `${this.at + 1} / ${this.steps.length}`;
    this.player.face.spoken.textContent = text;
    this.pause(false);
    this.flight = new Flight(this.player.camera, this.#goal());
    this.#put();
  }

  /** Hold it, or go on. @param {boolean} [paused] */
  pause(paused = !this.paused) {
    if (!paused && this.#ended() && this.elapsed) return this.go(0);
    this.paused = paused;
    this.player.wake();
    const name = paused ? _("go on with the story") : _("pause the story");
    this.pauseButton.replaceChildren(drawnSign(paused ? PLAYING : PAUSED));
    this.pauseButton.title = name;
    this.pauseButton.setAttribute("aria-label", name);
  }

  /** Whether the last step is over. */
  #ended() {
    return this.at === this.steps.length - 1 && this.elapsed >= this.steps[this.at].seconds;
  }

  /** Leave it, at the time that it shows. */
  end() {
    if (!this.open) return;
    const inside = this.element.contains(document.activeElement);
    this.at = -1;
    this.element.hidden = true;
    this.player.face.showStory(false);
    if (inside) this.player.face.canvas.focus();
    this.player.settled();
  }

  /** What the step shows: a view for each instant. @returns {() => View} */
  #goal() {
    const { camera } = this.player;
    const { view, from, to, ground, benches } = this.steps[this.at];
    if (view === "whole" || view === "disc") {
      const { disc, centre } = this.player.scene.sent;
      const [[x, y], r] = [centre, ROOM * (disc ?? 0)];
      if (view === "disc" && r) return () => camera.view(x - r, y - r, x + r, y + r);
      const box = this.player.room([from, to]);
      return () => camera.view(...box);
    }
    const [a, b] = [benches[0] - 1, (benches[1] ?? benches[0]) - 1];
    return () => {
      const { boxes } = this.player;
      const met = this.met ?? boxes.pair(a, b);
      const side = Math.min(camera.width, camera.height);
      const scale = view === "pair" ? this.player.pairScale(a, b) : side / ground;
      return { x: 0.5 * (met.from[0] + met.to[0]), y: 0.5 * (met.from[1] + met.to[1]), scale };
    };
  }

  /** Have the dance at the time of the story. */
  #put() {
    const { from, to, seconds } = this.steps[this.at];
    const still = this.player.still.matches;
    const elapsed = still ? Math.ceil(STILL * this.elapsed) / STILL : this.elapsed;
    this.player.put(from + (to - from) * Math.min(elapsed / seconds, 1));
  }

  /** Go on. @param {number} passed s */
  turn(passed) {
    if (!this.runs) return;
    this.elapsed += passed;
    this.#put();
    this.#look(passed);
    if (this.elapsed < this.steps[this.at].seconds) return;
    if (this.#ended() && !this.next) this.pause(true);
    else this.go(this.at + 1);
  }

  /** Fly to what the step shows, then keep it in sight. @param {number} passed s */
  #look(passed) {
    const { camera, still } = this.player;
    if (still.matches) glide(camera, this.#goal()(), 1);
    else if (this.flight?.step(camera, passed)) this.flight = null;
    else if (!this.flight) glide(camera, this.#goal()(), 1 - Math.exp(-passed / CALM));
  }
}

/** Move a camera a share of the way to a view. @param {View} camera @param {View} goal @param {number} share */
function glide(camera, goal, share) {
  camera.x += share * (goal.x - camera.x);
  camera.y += share * (goal.y - camera.y);
  camera.scale *= (goal.scale / camera.scale) ** share;
}
