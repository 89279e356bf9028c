// The time axis: clearance over time, what happens when, and where we are.

import { draw, make } from "./elements.js";
import { _, decimals, language, shortLength } from "./words.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./messages").Occasion} Occasion */

/** What marks look like; joints are small ones. */
const SIGNS = {
  contact: "\u2716",
  tightest: "\u25b2",
  fastest: "\u26a1\ufe0e",
  joint: "",
  end: "\u25a0",
  obstacle: "\u25c6",
  venue: "\u2b13",
  cue: "\u25bc",
};

/** Time as people read it. @param {number} time s @param {number} digits */
export function clock(time, digits = 1) {
  return `${decimals(time, digits)} s`;
}

/** @param {Occasion} occasion */
export function occasionText(occasion) {
  return occasion.text[language()];
}

export class Axis {
  /**
   * @param {Scene} scene
   * @param {(time: number) => void} jump
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
    this.played = make("div", { class: "played" });
    this.element = make(
      "div",
      { class: "axis" },
      this.#curve(),
      this.played,
      this.slider,
      ...this.#marks(jump),
    );
  }

  /** Share of the whole time, 0..1. @param {number} time */
  #share(time) {
    const { start, end } = this.scene;
    return end > start ? Math.min(Math.max((time - start) / (end - start), 0), 1) : 0;
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
    const svg = draw(
      "svg",
      { viewBox: "0 0 1000 100", preserveAspectRatio: "none", role: "img", "aria-label": name },
      area,
    );
    if (margin > 0)
      svg.append(draw("line", { x1: "0", x2: "1000", y1: height(margin), y2: height(margin) }));
    return svg;
  }

  /** @param {(time: number) => void} jump */
  #marks(jump) {
    return this.scene.sent.occasions.map((occasion) => {
      const name = `${occasionText(occasion)} (${clock(occasion.time, 2)})`;
      const mark = make(
        "button",
        {
          type: "button",
          class: `mark ${occasion.kind}`,
          title: name,
          "aria-label": name,
          tabindex: "-1",
          onclick: () => jump(occasion.time),
        },
        SIGNS[occasion.kind],
      );
      mark.style.left = `${100 * this.#share(occasion.time)}%`;
      return mark;
    });
  }

  /** @param {number} time @param {boolean} runs then nothing is said: screen readers read each value */
  show(time, runs) {
    this.played.style.width = `${100 * this.#share(time)}%`;
    if (runs) return;
    this.slider.value = String(time);
    this.slider.setAttribute("aria-valuetext", clock(time));
  }
}
