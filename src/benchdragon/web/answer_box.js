// A question of `benchdragon new` on the page: its boxes, and beside them what is asked back.

import { InputError } from "./compute/error_kinds.js";
import { TAP, make, textButton } from "./elements.js";
import { _ } from "./words.js";

/** @typedef {typeof import("./made/answers.js").QUESTIONS[number]} Question */

/** What says that a radius follows, which the box says already. */
const ROUND = /^\s*(?:r|半径)?/i;
/** What says both sides of a square in one box. */
const BOTH = /[x×*乘宽,，]/i;

export class AnswerBox {
  /** Which of its choices is taken. */
  #chosen = 0;

  /** @param {Question} question @param {() => void} changed called when it has another answer */
  constructor(question, changed) {
    this.question = question;
    this.changed = changed;
    /** Whether somebody answered it, or the plan of the page: else it is answered as usual. */
    this.typed = this.kept = false;
    /** The corners of a square that the plan of the page has, which may stay as it is. @type {unknown} */
    this.corners = null;
    /** @type {HTMLInputElement[]} */
    this.boxes = [];
    this.id = `wish-${question.name}`;
    this.element = make("fieldset", { class: "question" });
    this.asked = make("p", { id: `${this.id}-asked`, class: "asked", role: "alert", hidden: true });
    this.build();
  }

  /** Its boxes with what they hold, in the language in use. */
  build() {
    const held = this.boxes.map(({ value }) => value);
    const names = this.#names();
    this.boxes = names.map((name, n) => this.#box(name, held[n] ?? ""));
    const choices = this.#choices().map((text, n) => this.#radio(text, n));
    const rows = this.boxes.map((box, n) => {
      const name = names.length > 1 ? [make("span", { "aria-hidden": "true" }, names[n])] : [];
      return make("label", { class: "box" }, ...name, box, make("span", { class: "unit" }, this.#unit));
    });
    this.element.replaceChildren(
      make("legend", {}, this.#text),
      make("div", { class: "choices", hidden: !choices.length }, ...choices),
      make("div", { class: "boxes", hidden: !rows.length }, ...rows),
      this.asked,
    );
    this.#choose(this.#chosen);
    this.#ask("");
  }

  /** @param {string} name @param {string} value */
  #box(name, value) {
    const count = this.question.kind === "count";
    const box = make("input", {
      type: "text",
      inputmode: count ? "numeric" : "decimal",
      autocomplete: "off",
      "aria-label": name,
      "aria-describedby": this.asked.id,
      onchange: () => this.#typed(),
    });
    box.value = value;
    return box;
  }

  /** @param {string} text @param {number} n */
  #radio(text, n) {
    const onchange = () => {
      this.#choose(n);
      this.#typed();
    };
    const input = make("input", { type: "radio", name: this.id, value: String(n), onchange });
    return make("label", { class: "tick" }, input, text);
  }

  get #text() {
    const { kind, text } = this.question;
    if (kind === "square") return _("How large is the square?");
    return kind === "carry" ? _("Do the bearers walk beside their bench or under it?") : _(text);
  }

  #choices() {
    const kept = this.corners ? [_("as it is on the page")] : [];
    if (this.question.kind === "square") return [_("with four corners"), _("round"), ...kept];
    return this.question.kind === "carry" ? [_("beside it"), _("under it")] : [];
  }

  #names() {
    const { kind, label } = this.question;
    if (kind === "square") return [_("length"), _("width"), _("from its middle to its edge")];
    return kind === "carry" ? [] : [_(label)];
  }

  get #unit() {
    const { kind } = this.question;
    if (kind === "count") return "";
    return kind === "speed" ? _("m/s") : _("m");
  }

  /** @param {number} n */
  #choose(n) {
    this.#chosen = n;
    for (const radio of this.element.querySelectorAll('input[type="radio"]'))
      /** @type {HTMLInputElement} */ (radio).checked =
        /** @type {HTMLInputElement} */ (radio).value === String(n);
    if (this.question.kind !== "square") return;
    this.boxes.forEach(({ parentElement: row }, at) =>
      row?.toggleAttribute("hidden", n !== (at < 2 ? 0 : 1)),
    );
  }

  /** Somebody answered: what is asked back for that must not move what a tap that ends it is meant for. */
  #typed() {
    this.typed = this.text !== "";
    this.changed();
    setTimeout(() => (this.text || !this.asked.hidden) && this.read(), TAP);
  }

  /** What was answered, as `new` takes it; "" if nothing was. */
  get text() {
    const [first, second, radius] = this.boxes.map(({ value }) => value.trim());
    if (this.question.kind === "carry") return String(this.#chosen + 1);
    if (this.question.kind !== "square") return first;
    if (this.#chosen === 2) return this.#text;
    if (this.#chosen) return radius && radius.replace(ROUND, "r");
    return first && second ? `${first}x${second}` : BOTH.test(first) ? first : "";
  }

  /** Answer it as usual, unless it is answered. @param {string} answer */
  fill(answer) {
    if (!this.typed && !this.kept) this.#show(answer);
  }

  /** Answer it as a plan does, unless somebody did. @param {unknown} answer */
  keep(answer) {
    this.corners = Array.isArray(answer) && Array.isArray(answer[0]) ? answer : null;
    if (!this.corners && this.#chosen === 2) this.#chosen = 0;
    if (this.typed || !(typeof answer === "number" || Array.isArray(answer))) return;
    this.kept = true;
    if (this.corners) this.#chosen = 2;
    else this.#show(answer);
  }

  /** Answer it so. @param {unknown} answer */
  take(answer) {
    this.typed = true;
    this.#show(answer);
  }

  /** @param {any} answer a text, a number, or length and width */
  #show(answer) {
    const { kind } = this.question;
    if (kind === "carry" && typeof answer === "number") this.#choose(answer);
    if (kind === "carry" || answer === this.corners) return;
    const round = kind === "square" && !Array.isArray(answer);
    (round ? ["", "", answer] : [answer].flat()).forEach(
      (one, n) => (this.boxes[n].value = String(one)),
    );
    if (kind === "square") this.#choose(round ? 1 : 0);
  }

  /** The answer, or why there is none. @returns {any} */
  get known() {
    const { question, text } = this;
    if (question.kind === "square" && this.#chosen === 2) return this.corners;
    try {
      return text ? question.answer(_(question.label), text) : new InputError(_("Not answered yet."));
    } catch (error) {
      if (error instanceof InputError) return error;
      throw error;
    }
  }

  /** The answer, which its boxes show as it was understood; undefined where it is asked back. @returns {any} */
  read() {
    const { known } = this;
    const refused = known instanceof InputError;
    if (!refused) this.#show(known);
    this.#ask(refused ? known.message : "");
    return refused ? undefined : known;
  }

  /** Ask back, beside what was typed; "": ask no more. @param {string} text */
  #ask(text) {
    this.asked.textContent = text;
    this.asked.hidden = !text;
    for (const box of this.boxes) box.ariaInvalid = String(Boolean(text));
    const { kind, most } = this.question;
    if (text && kind === "length" && Number(this.text) > most) this.#offer(this.text);
  }

  /** A bare number that is no length in metres: one tap makes it centimetres. @param {string} number */
  #offer(number) {
    const text = `${number} cm`;
    const take = () => {
      this.boxes[0].value = text;
      this.#typed();
      this.focus();
    };
    this.asked.append(textButton(text, take));
  }

  focus() {
    const seen = this.boxes.find((box) => !box.parentElement?.hidden);
    (seen ?? this.element.querySelector("input"))?.focus();
  }
}
