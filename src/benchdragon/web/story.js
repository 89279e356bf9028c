// A guided story of half a minute: why a dance ends where two benches touch, or where it is tightest.

import { clock } from "./axis.js";
import { make, drawnSign, signButton } from "./elements.js";
import { Flight } from "./flight.js";
import { _, decimals, shortLength } from "./words.js";

/** @typedef {import("./player.js").Player} Player */
/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./messages").Occasion} Occasion */
/** @typedef {import("./flight.js").View} View */

/**
 * A step of a story.
 * @typedef {object} Step
 * @property {string} text
 * @property {number} from time of the dance, s
 * @property {number} to
 * @property {number} seconds how long it takes
 * @property {"whole" | "pair" | "close"} view
 * @property {number} ground on the picture's smaller side where all is close, m
 */

/** Ground on the picture's smaller side where all is close, m, and so many gaps more. */
const CLOSE = 0.9;
const GAPS = 3;
/** So long after a contact benches that overlap are shown, and after the tightest moment those that part, s. */
const AFTER = 0.5;
const PARTED = 4;
/** The view goes after its pair so slowly, s. */
const CALM = 0.3;
/** Where motion is unwanted, a story shows so many pictures a second. */
const STILL = 1;
const PLAYING = "M7 4v16l13-8z";
const PAUSED = "M6 4h4v16H6zM14 4h4v16h-4z";
const BACK = "M16 4v16L5 12z";
const ON = "M8 4v16l11-8z";

/** What a dance's story is about: its first contact, or its tightest moment; null if it has neither. @param {Scene} scene @returns {Occasion | null} */
function subject({ sent: { occasions } }) {
  const of = (/** @type {string} */ kind) =>
    occasions.find((one) => one.kind === kind && one.benches.length === 2);
  return of("contact") ?? of("tightest") ?? null;
}

/** What the story of a dance is called; "" if it has none. @param {Scene} scene */
export function storyName(scene) {
  const about = subject(scene);
  if (!about) return "";
  return about.kind === "contact" ? _("Why it ends here") : _("The tightest moment");
}

/** @param {Player} player @param {Occasion} about @returns {Step[]} */
function stepsOf({ scene, boxes, stand }, { kind, time, benches: [a, b] }) {
  const pair = { a, b };
  const within = (/** @type {number} */ at) => Math.min(Math.max(at, scene.start), scene.end);
  const gapAt = (/** @type {number} */ at) => {
    boxes.place(scene.stand(at, stand));
    return boxes.distance(a - 1, b - 1);
  };
  const least = Math.max(gapAt(time), 0);
  const gap = shortLength(least);
  const before = time - within(time - 20);
  const words = { ...pair, gap, time: clock(time, 2) };
  const opening = { benches: scene.benches, seconds: decimals(before, 0), ...pair };
  const touches = kind === "contact";
  const texts = touches ? contactTexts(words, opening) : tightestTexts(words, opening);
  const times = [
    within(time - 20),
    within(time - 4),
    within(time - 0.8),
    time,
    time,
    within(time + (touches ? AFTER : PARTED)),
  ];
  const views = /** @type {const} */ (["whole", "pair", "close", "close", touches ? "close" : "pair"]);
  const lengths = [6, 6, 8, 4, 6];
  const steps = texts.map((text, n) => ({
    text,
    from: times[n],
    to: times[n + 1],
    seconds: lengths[n],
    view: views[n],
    ground: CLOSE + GAPS * least,
  }));
  const after = touches
    ? time + AFTER <= scene.end && gapAt(time + AFTER) < -boxes.touch
    : scene.end > time;
  return after ? steps : steps.slice(0, -1);
}

/** @param {Record<string, string | number>} words @param {Record<string, string | number>} opening */
function contactTexts(words, opening) {
  return [
    _(
      "{benches} benches from above, at true size. In {seconds} s, benches {a} and {b} touch.",
      opening,
    ),
    _(
      "Benches {a} and {b} are not adjacent in the line, but they meet. The ring is where they are nearest.",
      words,
    ),
    _("In slow motion: what is left between them shrinks to nothing.", words),
    _("t = {time}: bench {a} meets bench {b}. This is the first contact.", words),
    _("Half a second later they would overlap. No dragon walks beyond {time}.", words),
  ];
}

/** @param {Record<string, string | number>} words @param {Record<string, string | number>} opening */
function tightestTexts(words, opening) {
  return [
    _("{benches} benches from above, at true size. In {seconds} s it is tightest.", opening),
    _("Benches {a} and {b} come near one another. The ring is where they are nearest.", words),
    _("In slow motion: what is left between them shrinks.", words),
    _("t = {time}: {gap} is left between benches {a} and {b}, the least of the dance.", words),
    _("They part again. At every other time there is at least as much room.", words),
  ];
}

export class Story {
  /** @param {Player} player */
  constructor(player) {
    this.player = player;
    this.scene = player.scene;
    this.about = subject(player.scene);
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
      { class: "story", hidden: true, "aria-label": storyName(player.scene) || _("story") },
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

  /** The story's pair, numbers from 0, where its step is about that. @returns {[number, number] | null} */
  get pair() {
    if (!this.about || !this.open || this.steps[this.at].view === "whole") return null;
    return [this.about.benches[0] - 1, this.about.benches[1] - 1];
  }

  /** Begin, or go on where another story of the same dance was. @param {number} [at] @param {boolean} [paused] */
  begin(at = 0, paused = false) {
    const { player, about } = this;
    if (!about) return;
    player.play(false);
    if (player.follows) player.follow(false);
    this.steps = stepsOf(player, about);
    this.texts.replaceChildren(...this.steps.map(({ text }) => make("p", {}, text)));
    this.element.hidden = false;
    this.go(at);
    if (paused) this.pause(true);
    this.pauseButton.focus();
  }

  /** Go to a step, from its beginning. @param {number} step */
  go(step) {
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
    const step = this.steps[this.at];
    if (step.view === "whole") {
      const box = this.player.room([step.from, step.to]);
      return () => camera.view(...box);
    }
    const pair = /** @type {[number, number]} */ (this.pair);
    return () => {
      const { from, to } = this.player.boxes.pair(...pair);
      const side = Math.min(camera.width, camera.height);
      const scale = step.view === "pair" ? this.player.pairScale(...pair) : side / step.ground;
      return { x: 0.5 * (from[0] + to[0]), y: 0.5 * (from[1] + to[1]), scale };
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
    if (this.#ended()) this.pause(true);
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
