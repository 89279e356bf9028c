// Sliders' tracks marked where the dance can be walked: found out of the one that somebody comes near, while
// nothing else is asked. All of them would keep a processor busy for a quarter of a minute after each change.

import { make } from "./elements.js";
import { valueOf } from "./number_control.js";
import { withValue } from "./plan_form.js";
import { PageFault, Refusal } from "./standing.js";
import { spansOf, walkable } from "./walkable.js";
import { _, language } from "./words.js";

/** @typedef {import("./messages").Verdict} Verdict */
/** @typedef {import("./number_control.js").NumberControl} NumberControl */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./plan_form.js").PlanForm} PlanForm */
/** @typedef {import("./standing.js").Aside} Aside */
/** @typedef {import("./standing.js").Answers} Answers */
/** @typedef {import("./walkable.js").Piece} Piece */

/** A plan is left alone for so long before its tracks are looked into, ms. */
const IDLE = 700;
/** Questions that answer exactly how far a size may go. @type {Record<string, string>} */
const LIMITS = {
  "route.pitch": "limit/pitch",
  "disc.radius": "limit/disc",
  "dragon.width": "limit/width",
  "dragon.body_length": "limit/length",
};

/**
 * The marks of one slider.
 * @typedef {object} Track
 * @property {NumberControl} control
 * @property {HTMLElement} bar
 * @property {HTMLElement} text
 */
/** What was found of a slider, and of which plans: they differ in its size alone. @typedef {{ base: string, pieces: Piece[] }} Found */

/** A plan but for one size. @param {Plan} plan @param {NumberControl} control */
function baseOf(plan, { field }) {
  return JSON.stringify(withValue(plan, field.key, field.low));
}

export class Tracks {
  /**
   * @param {Answers} answers
   * @param {() => boolean} busy whether something else is under way
   */
  constructor(answers, busy) {
    this.answers = answers;
    this.busy = busy;
    /** @type {Track[]} */
    this.tracks = [];
    /** @type {Map<string, Found>} */
    this.found = new Map();
    /** The slider that somebody came near last. */
    this.near = "";
    /** @type {Plan} */
    this.plan = {};
    /** Who answers now. @type {Aside | null} */
    this.aside = null;
    this.later = 0;
  }

  /** Mark the sliders of a form. @param {PlanForm} form */
  attach(form) {
    this.tracks = form.controls.flat().map((control) => {
      const bar = make("div", { class: "track", "aria-hidden": "true" });
      const text = make("span", { class: "walkable", id: `walkable-${control.field.key}` });
      control.element.append(bar, text);
      control.slider.setAttribute("aria-describedby", text.id);
      for (const sign of ["pointerenter", "focusin"])
        control.element.addEventListener(sign, () => this.#come(control.field.key));
      return { control, bar, text };
    });
  }

  /** Somebody came near a slider. @param {string} key */
  #come(key) {
    this.near = key;
    if (!this.aside) this.#wait();
  }

  /** Another plan is on the page: give up what is under way at once. @param {Plan} plan */
  show(plan) {
    this.#stop();
    this.plan = plan;
    for (const track of this.tracks) this.#draw(track);
    this.#wait();
  }

  #stop() {
    clearTimeout(this.later);
    const { aside } = this;
    this.aside = null;
    aside?.close();
  }

  #wait() {
    clearTimeout(this.later);
    this.later = setTimeout(() => {
      if (this.busy() || document.hidden) this.#wait();
      else this.#work();
    }, IDLE);
  }

  /** What was found of a slider, if it holds for the plan. @param {NumberControl} control */
  #known(control) {
    const found = this.found.get(control.field.key);
    return found && found.base === baseOf(this.plan, control) ? found.pieces : null;
  }

  /** The slider to look into, if there is one. */
  #next() {
    const track = this.tracks.find(({ control }) => control.field.key === this.near);
    if (!track || track.control.element.hidden || track.control.slider.disabled) return null;
    return this.#known(track.control) ? null : track;
  }

  async #work() {
    if (this.aside || !this.#next()) return;
    const aside = this.answers.aside();
    this.aside = aside;
    try {
      for (let track = this.#next(); track; track = this.#next()) await this.#look(track, aside);
    } catch (error) {
      const given = error instanceof DOMException && error.name === "AbortError";
      if (!given) throw error;
    }
    if (this.aside === aside) this.#stop(); // its memory is given back
  }

  /** @param {Track} track @param {Aside} aside */
  async #look(track, aside) {
    const { field } = track.control;
    const { plan } = this;
    const base = baseOf(plan, track.control);
    const judge = (/** @type {number} */ value) => judged(aside, withValue(plan, field.key, value));
    /** @type {ReturnType<typeof bracket> | null} */
    let asked = null;
    const limit = () => (asked ??= bracket(aside, this.#limitOf(field.key), plan));
    const pieces = await walkable(field, valueOf(plan, field.key), { judge, limit });
    if (this.aside !== aside) return;
    this.found.set(field.key, { base, pieces });
    this.#draw(track);
  }

  /** The question for how far a size may go, if it means what the slider does. @param {string} key */
  #limitOf(key) {
    const { body_length: body, tail_length: tail } = this.plan.dragon;
    const name = key === "dragon.body_length" && body !== tail ? "" : (LIMITS[key] ?? "");
    return this.answers.has(name) ? name : "";
  }

  /** @param {Track} track */
  #draw({ control, bar, text }) {
    const { field, slider } = control;
    const pieces = slider.disabled ? null : this.#known(control);
    const told = pieces ? spansText(pieces, field) : "";
    if (text.textContent !== told) text.textContent = told;
    const share = (/** @type {number} */ value) => (value - field.low) / (field.high - field.low);
    bar.replaceChildren(
      ...(pieces ?? []).map(({ from, to, state }) => {
        const piece = make("span", { class: state });
        piece.style.left = `${100 * share(from)}%`;
        piece.style.width = `${100 * (share(to) - share(from))}%`;
        return piece;
      }),
    );
  }
}

/** Whether a plan is safe. @param {Aside} aside @param {Plan} plan */
async function judged(aside, plan) {
  try {
    const { decided, safe } = /** @type {Verdict} */ (await aside.ask({ question: "verdict", plan }));
    return decided ? (safe ? "safe" : "unsafe") : "open";
  } catch (error) {
    if (error instanceof Refusal && !(error instanceof PageFault)) return "none";
    throw error;
  }
}

/** Between which sizes the limit lies; null if that is not known. @param {Aside} aside @param {string} question @param {Plan} plan */
async function bracket(aside, question, plan) {
  if (!question) return null;
  try {
    const { status, lower, upper } = await aside.ask({ question, plan });
    return status === "found" ? { lower, upper } : null;
  } catch (error) {
    if (error instanceof Refusal && !(error instanceof PageFault)) return null;
    throw error;
  }
}

/** @param {number} value */
function numberText(value) {
  return String(Number(value.toFixed(4))).replace("-", "\u2212");
}

/** Where a dance can be walked, in words. @param {Piece[]} pieces @param {import("./number_control.js").Field} field */
function spansText(pieces, { low, high, unit }) {
  const [first, last] = [pieces[0].from, pieces[pieces.length - 1].to];
  const told = (/** @type {number} */ from, /** @type {number} */ to) => ({
    from: numberText(from),
    to: numberText(to),
    unit,
  });
  const texts = spansOf(pieces).map(([from, to]) => {
    const values = told(from, to);
    if (from <= first && to >= last) return _("can be walked with all that was tried");
    if (to >= last) return _("can be walked from {from} {unit}", values);
    if (from <= first) return _("can be walked up to {to} {unit}", values);
    return _("can be walked from {from} to {to} {unit}", values);
  });
  if (!texts.length) texts.push(_("cannot be walked with any that was tried"));
  if (first > low || last < high) texts.push(_("tried: {from} to {to} {unit}", told(first, last)));
  return texts.join(language() === "zh" ? "\uff1b" : "; ").trim();
}
