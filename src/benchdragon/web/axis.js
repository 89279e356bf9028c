// The time axis: clearance over time, what happens when, and where we are.

import { make } from "./elements.js";
import { _, decimals, language, shortLength } from "./words.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./wire").Occasion} Occasion */

const SVG = "http://www.w3.org/2000/svg";
/** What marks look like; joints are small ones. */
const SIGNS = { contact: "\u2716", tightest: "\u25b2", fastest: "\u26a1\ufe0e", joint: "", end: "\u25a0" };

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
      type: "range", min: String(scene.start), max: String(scene.end), step: "any", value: String(scene.start),
      "aria-label": _("time"), oninput: () => jump(this.slider.valueAsNumber),
    });
    this.played = make("div", { class: "played" });
    this.element = make("div", { class: "axis" }, this.#curve(), this.played, this.slider, ...this.#marks(jump));
  }

  /** Share of the whole time, 0..1. @param {number} time */
  #share(time) {
    const { start, end } = this.scene;
    return end > start ? Math.min(Math.max((time - start) / (end - start), 0), 1) : 0;
  }

  #curve() {
    const { tightness, nearest, margin } = this.scene.sent;
    const svg = document.createElementNS(SVG, "svg");
    svg.setAttribute("viewBox", "0 0 1000 100");
    svg.setAttribute("preserveAspectRatio", "none");
    svg.setAttribute("role", "img");
    svg.setAttribute("aria-label", _("distance of the tightest pair over time, from 0 below to {most} above", { most: shortLength(nearest.reach) }));
    const height = (/** @type {number} */ distance) => (100 - (95 * Math.min(Math.max(distance, 0), nearest.reach)) / nearest.reach).toFixed(2);
    const points = tightness.distance.map((distance, n) => `${(1000 * this.#share(tightness.start + n * tightness.step)).toFixed(2)},${height(distance)}`);
    const last = points.length ? points[points.length - 1].split(",")[0] : "0";
    const area = document.createElementNS(SVG, "polygon");
    area.setAttribute("points", `0,100 ${points.join(" ")} ${last},100`);
    svg.append(area);
    if (margin > 0) {
      const line = document.createElementNS(SVG, "line");
      for (const [name, value] of [["x1", "0"], ["x2", "1000"], ["y1", height(margin)], ["y2", height(margin)]]) line.setAttribute(name, value);
      svg.append(line);
    }
    return svg;
  }

  /** @param {(time: number) => void} jump */
  #marks(jump) {
    return this.scene.sent.occasions.map((occasion) => {
      const name = `${occasionText(occasion)} (${clock(occasion.time, 2)})`;
      const mark = make("button", {
        type: "button", class: `mark ${occasion.kind}`, title: name, "aria-label": name, tabindex: "-1",
        onclick: () => jump(occasion.time),
      }, SIGNS[occasion.kind]);
      mark.style.left = `${100 * this.#share(occasion.time)}%`;
      return mark;
    });
  }

  /** @param {number} time */
  show(time) {
    this.slider.value = String(time);
    this.slider.setAttribute("aria-valuetext", clock(time));
    this.played.style.width = `${100 * this.#share(time)}%`;
  }
}
