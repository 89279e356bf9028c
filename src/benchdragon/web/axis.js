// The time axis: clearance over time, what happens when, and where we are.

import { draw, make, signButton } from "./elements.js";
import { _, decimals, language, shortLength } from "./words.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./messages").Occasion} Occasion */

/** What marks look like; joints are small ones. */
export const SIGNS = {
  contact: "\u2716",
  tightest: "\u25b2",
  fastest: "\u26a1\ufe0e",
  joint: "",
  end: "\u25a0",
  obstacle: "\u25c6",
  venue: "\u2b13",
  cue: "\u25bc",
};

/** A film's frame, s. */
export const FRAME = 1 / 25;

/** Time as people read it. @param {number} time s @param {number} digits */
export function clock(time, digits = 1) {
  return `${decimals(time, digits)} s`;
}

/** A time after the same as the papers of the dance tell it, if it has any. @param {Scene} scene @param {number} time s @param {string} said as it is said here */
export function toldTime({ papers }, time, said) {
  return papers ? `${papers.tell(time)} · ${said}` : said;
}

/** @param {Occasion} occasion */
export function occasionText(occasion) {
  return occasion.text[language()];
}

/** A mark is so wide, and takes so much room beside others, CSS pixels. */
const [MARK_WIDE, MARK_ROOM] = [24, 17];
/** A tick takes so much room, CSS pixels. */
const TICK_ROOM = 84;
/** A finger that lands so far beside a mark means it, and one that moved no farther tapped, CSS pixels. */
const FINGER = 22;
const STEADY = 10;
/** Nearer to an end of the axis its text stands inside, CSS pixels. */
const TICK_EDGE = 20;

/** The least step of 1, 2 or 5 that is no smaller than another. @param {number} least s */
function roundStep(least) {
  const unit = 10 ** Math.floor(Math.log10(least));
  return (least <= unit ? 1 : least <= 2 * unit ? 2 : least <= 5 * unit ? 5 : 10) * unit;
}

export class Axis {
  /**
   * @param {Scene} scene
   * @param {(time: number, benches?: number[]) => void} jump
   */
  constructor(scene, jump) {
    this.scene = scene;
    this.slider = make("input", {
      type: "range",
      min: String(scene.start),
      max: String(scene.end),
      step: "any",
      value: String(scene.start),
      "aria-label": _("time"),
      oninput: () => jump(this.slider.valueAsNumber),
    });
    this.#onTaps(jump);
    this.ticks = make("div", { class: "ticks", "aria-hidden": "true" });
    this.played = make("div", { class: "played" });
    this.element = make(
      "div",
      { class: "axis" },
      this.#curve(),
      this.played,
      this.slider,
      ...this.#marks(jump),
      this.#ends(),
      this.ticks,
    );
    new ResizeObserver(() => this.#tick(this.element.clientWidth)).observe(this.element);
  }

  /** Share of the whole time, 0..1. @param {number} time */
  #share(time) {
    const { start, end } = this.scene;
    return end > start ? Math.min(Math.max((time - start) / (end - start), 0), 1) : 0;
  }

  /** What the curve is, and where it ends: its name and its ends are told with the curve too. */
  #ends() {
    const { reach } = this.scene.sent.nearest;
    return make(
      "div",
      { class: "ends", "aria-hidden": "true" },
      make("span", {}, _("clearance up to {most}", { most: shortLength(reach) })),
    );
  }

  /** Where fingers tap the slider near a mark, go to its event: the nearest mark's. @param {(time: number, benches?: number[]) => void} jump */
  #onTaps(jump) {
    let began = NaN;
    this.slider.addEventListener("pointerdown", ({ clientX }) => {
      began = clientX;
    });
    this.slider.addEventListener("pointerup", ({ pointerType, clientX, clientY }) => {
      if (pointerType === "mouse" || !(Math.abs(clientX - began) <= STEADY)) return;
      const found = this.#markAt(clientX, clientY);
      if (found) jump(found.time, found.benches);
    });
  }

  /** The event whose mark is nearest to a place on the axis, if a finger there means it. @param {number} x @param {number} y @returns {Occasion | null} */
  #markAt(x, y) {
    const marks = [...this.element.querySelectorAll(".mark")];
    const away = marks.map((mark) => {
      const { left, right, top, bottom } = mark.getBoundingClientRect();
      return [Math.abs(x - 0.5 * (left + right)), Math.abs(y - 0.5 * (top + bottom))];
    });
    let best = -1;
    away.forEach(([across, up], n) => {
      const nearer = best < 0 || Math.hypot(across, up) < Math.hypot(...away[best]);
      if (across <= FINGER && nearer) best = n;
    });
    return best < 0 ? null : this.scene.sent.occasions[best];
  }

  /** Ticks with round times, as many as find room. @param {number} width CSS pixels */
  #tick(width) {
    const { start, end } = this.scene;
    const step = roundStep(((end - start) * TICK_ROOM) / Math.max(width, TICK_ROOM));
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const ticks = [];
    for (let n = Math.ceil(start / step - 1e-9); n * step <= end + 1e-9 * step; n++) {
      const tick = make("span", {}, clock(n * step, digits));
      const share = this.#share(n * step);
      tick.style.left = `${100 * share}%`;
      const edge = TICK_EDGE / Math.max(width, 1);
      tick.className = share < edge ? "first" : share > 1 - edge ? "last" : "";
      ticks.push(tick);
    }
    this.ticks.replaceChildren(...ticks);
    this.#part(width);
  }

  /** Have marks of the upper row stand beside one another, not on. @param {number} width CSS pixels */
  #part(width) {
    const marks = /** @type {HTMLElement[]} */ ([
      ...this.element.querySelectorAll(".mark:not(.joint, .cue)"),
    ]);
    const at = (/** @type {HTMLElement} */ mark) => (parseFloat(mark.style.left) / 100) * width;
    let free = -Infinity;
    marks.sort((one, other) => at(one) - at(other));
    const places = marks.map((mark) => (free = Math.max(at(mark), free) + MARK_ROOM) - MARK_ROOM);
    let most = width;
    for (let n = marks.length - 1; n >= 0; n--) {
      const place = Math.min(places[n], most);
      most = place - MARK_ROOM;
      marks[n].style.marginLeft = `${place - at(marks[n]) - 0.5 * MARK_WIDE}px`;
    }
  }

  #curve() {
    const { tightness, nearest, margin } = this.scene.sent;
    const height = (/** @type {number} */ distance) =>
      (100 - 95 * Math.sqrt(Math.min(Math.max(distance, 0), nearest.reach) / nearest.reach)).toFixed(2);
    const points = tightness.distance.map(
      (distance, n) =>
        `${(1000 * this.#share(tightness.start + n * tightness.step)).toFixed(2)},${height(distance)}`,
    );
    const last = points.length ? points[points.length - 1].split(",")[0] : "0";
    const area = draw("polygon", { points: `0,100 ${points.join(" ")} ${last},100` });
    const name = _("clearance over time, from 0 below to {most} above", {
      most: shortLength(nearest.reach),
    });
    const about = { preserveAspectRatio: "none", role: "img", "aria-label": name };
    const svg = draw("svg", { viewBox: "0 0 1000 100", ...about }, area);
    if (margin > 0)
      svg.append(draw("line", { x1: "0", x2: "1000", y1: height(margin), y2: height(margin) }));
    return svg;
  }

  /** @param {(time: number, benches?: number[]) => void} jump */
  #marks(jump) {
    return this.scene.sent.occasions.map((occasion) => {
      const name = `${occasionText(occasion)} (${toldTime(this.scene, occasion.time, clock(occasion.time, 2))})`;
      const go = () => jump(occasion.time, occasion.benches);
      const how = { class: `mark ${occasion.kind}`, tabindex: "-1" };
      const mark = signButton(SIGNS[occasion.kind], name, go, how);
      mark.style.left = `${100 * this.#share(occasion.time)}%`;
      return mark;
    });
  }

  /** @param {number} time @param {boolean} runs then nothing is said: screen readers read each value that is set */
  show(time, runs) {
    this.played.style.width = `${100 * this.#share(time)}%`;
    if (runs) return;
    this.slider.value = String(time);
    const text = clock(time);
    if (this.slider.getAttribute("aria-valuetext") !== text)
      this.slider.setAttribute("aria-valuetext", text);
  }
}
