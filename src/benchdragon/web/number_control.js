// A number of the plan as a slider and a box, into which people type as they speak: "150cm", "1米5".

import { make } from "./elements.js";
import { numberIn } from "./made/answers.js";
import { _ } from "./words.js";

/** @typedef {import("./plan_form.js").Plan} Plan */

/**
 * A number of the plan.
 * @typedef {object} Field
 * @property {string} key
 * @property {() => string} text
 * @property {string} unit
 * @property {number} low of the slider; the number may lie beyond
 * @property {number} high
 * @property {number} step
 * @property {number} [begin] what it begins with where the plan leaves it open; without it, it may not
 * @property {number} [usual] what it is where it says something and nothing was said
 * @property {number} [most] a number beyond it was mistyped
 * @property {boolean} [whole] whether it is a count
 * @property {(plan: Plan) => boolean} [when] whether it says anything
 */

/** Puts a value under a key of a plan, for the time being or for good. @typedef {(key: string, value: unknown, final: boolean) => void} Put */

/** What a key stands for in a plan; undefined where it does not say. @param {Plan} plan @param {string} key */
export function valueOf(plan, key) {
  return key.split(".").reduce((/** @type {any} */ at, name) => at?.[name], plan);
}

/** One number: a slider, a box, and where the plan may leave it open a tick. */
export class NumberControl {
  /** @param {Field} field @param {(key: string, value: number | null, final: boolean) => void} changed */
  constructor(field, changed) {
    this.field = field;
    this.changed = changed;
    /** @type {Plan} */
    this.plan = {};
    const name = field.text();
    const slid = (/** @type {boolean} */ final) => () =>
      changed(field.key, this.slider.valueAsNumber, final);
    this.slider = make("input", {
      type: "range",
      min: String(field.low),
      max: String(field.high),
      step: String(field.step),
      "aria-label": name,
      oninput: slid(false),
      onchange: slid(true),
    });
    this.asked = make("p", { class: "asked", role: "alert", hidden: true });
    this.box = make("input", {
      type: "text",
      inputmode: "decimal",
      autocomplete: "off",
      "aria-label": name,
      onchange: () => this.#typed(),
    });
    this.open =
      field.begin !== undefined &&
      make("input", {
        type: "checkbox",
        "aria-label": _("set {name}", { name }),
        onchange: () =>
          changed(field.key, this.open && this.open.checked ? (field.begin ?? 0) : null, true),
      });
    const label = make("span", { class: "name" }, ...(this.open ? [this.open] : []), name);
    this.element = make(
      "div",
      { class: "field" },
      label,
      this.slider,
      make("span", { class: "box" }, this.box, make("span", { class: "unit" }, field.unit)),
      this.asked,
    );
  }

  /** Somebody typed into the box: take it, or ask back. */
  #typed() {
    const { field, box } = this;
    const empty = !box.value.trim();
    const number = empty ? this.#value : numberIn(box.value, field.unit);
    this.#ask(number === null ? this.#unread() : this.#doubted(number));
    if (!this.asked.hidden) return;
    if (empty) this.show(this.plan);
    else this.changed(field.key, number, true);
  }

  /** What is asked where the text is no number for sure. */
  #unread() {
    const { unit, low } = this.field;
    const example = `${numberText(this.#value ?? low)} ${unit}`.trim();
    return _("“{text}” may be read in more than one way: write for example {example}", {
      text: this.box.value.trim(),
      example,
    });
  }

  /** What is asked of a number that was hardly meant; "" of others. @param {number} number */
  #doubted(number) {
    const { most, whole } = this.field;
    const values = { number: numberText(number), most: most ?? Infinity };
    if (whole && !Number.isInteger(number)) return _("{number} is no whole number", values);
    if (number <= (most ?? Infinity)) return "";
    return _("{number} m is more than {most} m: are centimetres meant? Write {number} cm", values);
  }

  /** Ask back, beside what was typed; "": ask no more. @param {string} question */
  #ask(question) {
    this.asked.textContent = question;
    this.asked.hidden = !question;
    this.box.ariaInvalid = String(Boolean(question));
  }

  /** What the plan says; null where it leaves it open. @returns {number | null} */
  get #value() {
    const value = valueOf(this.plan, this.field.key) ?? this.field.usual;
    return typeof value === "number" ? value : null;
  }

  /** @param {Plan} plan */
  show(plan) {
    const asking = !this.asked.hidden && valueOf(this.plan, this.field.key);
    this.plan = plan;
    const value = this.#value;
    this.element.hidden = this.field.when ? !this.field.when(plan) : false;
    if (this.open) this.open.checked = value !== null;
    this.slider.disabled = this.box.disabled = value === null;
    if (value !== null && this.slider.valueAsNumber !== value) this.slider.value = numberText(value);
    if (asking === value) return; // what was typed is still asked about
    this.box.value = value === null ? "" : numberText(value);
    this.#ask("");
  }
}

/** @param {number} value */
function numberText(value) {
  return String(Number(value.toFixed(9)));
}
