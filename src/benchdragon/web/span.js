// The time span of the walk as controls: from when to when it is danced, and judged.

import { make } from "./elements.js";
import { NumberControl } from "./number_control.js";
import { withValue } from "./plan_form.js";
import { _ } from "./words.js";

/** @typedef {import("./number_control.js").Field} Field */
/** @typedef {import("./number_control.js").Put} Put */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./scene.js").Scene} Scene */

/** A slider lets a dance start so long before its time 0, s; its number may say more. */
const BEFORE = 120;
const STEP = 1;

/** A field that begins at a time of the dance that is shown. @param {string} key @param {() => string} text @param {() => number} begin @returns {Field} */
function timeField(key, text, begin) {
  return {
    key,
    text,
    unit: "s",
    low: -BEFORE,
    high: BEFORE,
    step: STEP,
    get begin() {
      return begin();
    },
  };
}

export class Span {
  /** @param {(plan: Plan, final: boolean) => void} changed */
  constructor(changed) {
    /** @type {Plan} */
    this.plan = {};
    /** Start and end of the dance that is shown, s. @type {[number, number]} */
    this.danced = [0, 0];
    /** End of the whole dance, as far as it was seen, s; and of which it is. */
    this.whole = { of: "", end: 0 };
    /** @type {Put} */
    const told = (key, value, final) => changed(withValue(this.plan, key, value), final);
    this.start = new NumberControl(
      timeField("walk.start", () => _("the walk starts at"), () => this.danced[0]), told,
    ); // prettier-ignore
    this.end = new NumberControl(
      timeField("walk.end", () => _("the walk ends at"), () => this.danced[1]), told,
    ); // prettier-ignore
    this.element = make(
      "fieldset",
      { class: "form" },
      make("legend", {}, _("Time span")),
      this.start.element,
      this.end.element,
    );
  }

  /** The dance of a plan is shown. @param {Scene} scene @param {Plan} plan */
  dance(scene, plan) {
    this.danced = [Math.round(scene.start), Math.floor(scene.end)];
    const of = baseOf(plan);
    const end = this.whole.of === of ? Math.max(this.whole.end, scene.end) : scene.end;
    this.whole = { of, end };
    this.show(this.plan);
  }

  /** @param {Plan} plan */
  show(plan) {
    this.plan = plan;
    const { start, end } = plan.walk;
    const first = start ?? this.danced[0];
    const last = Math.max(Math.floor(this.whole.end), end ?? first);
    limit(this.start, Math.min(-BEFORE, first), Math.max(last, first));
    limit(this.end, first, Math.max(last, first + STEP));
    this.start.show(plan);
    this.end.show(plan);
  }
}

/** What a slider goes from and to. @param {NumberControl} control @param {number} low @param {number} high */
function limit({ slider }, low, high) {
  [slider.min, slider.max] = [String(Math.floor(low)), String(Math.ceil(high))];
}

/** A plan but for its span. @param {Plan} plan */
function baseOf(plan) {
  const { start: _start, end: _end, ...walk } = plan.walk;
  return JSON.stringify({ ...plan, walk });
}
