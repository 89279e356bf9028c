// One thing on the square in the panel: its name, its sizes as numbers, the margin about it, and away with it.

import { make, wordButton } from "./elements.js";
import { InputError } from "./compute/error_kinds.js";
import { QUESTIONS } from "./made/answers.js";
import { NumberControl } from "./number_control.js";
import {
  MOST_LETTERS,
  namesTaken,
  pointsOf,
  radiusOf,
  withAt,
  withoutThing,
  withSize,
} from "./things.js";
import { _ } from "./words.js";

/** @typedef {import("./number_control.js").Field} Field */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./things.js").Thing} Thing */

/** A size larger than these, m, was mistyped. */
const MOST = { side: 200, radius: 50, far: 1000 };
/** What the width of an entrance begins with, m. */
const WIDE = 3;
/** How `benchdragon new` reads the size of a square. */
const SQUARE = QUESTIONS.filter(({ kind }) => kind === "square")[0];

/** @param {string} key @param {() => string} text @param {number} high @param {number} most @returns {Field} */
function length(key, text, high, most) {
  return { key, text, unit: "m", low: 0.1, high, step: 0.1, most };
}

/** The two numbers of a place, as the plan counts them. @param {string} key @returns {Field[]} */
function place(key) {
  const texts = [() => _("to the right (x)"), () => _("ahead (y)")];
  const more = { unit: "m", low: -50, high: 50, step: 0.1, most: MOST.far };
  return texts.map((text, n) => ({ key: `${key}.${n}`, text, ...more }));
}

/** @param {string} key @returns {Field} */
function direction(key) {
  return { key, text: () => _("direction"), unit: "\u00b0", low: -180, high: 180, step: 1, usual: 0 };
}

/** @param {string} key @param {() => string} text @returns {Field} */
function margin(key, text) {
  return { key, text, unit: "m", low: 0, high: 2, step: 0.05, most: MOST.radius, begin: 0.3 };
}

/** How long the head rests. @param {string} key @returns {Field} */
function restField(key) {
  return { key, text: () => _("for how long"), unit: "s", low: 5, high: 600, step: 5 };
}

/** A size of the street. @param {string} name @param {() => string} text @param {number} usual @param {number} high @returns {Field} */
function streetField(name, text, usual, high) {
  return { ...length(`route.street.${name}`, text, high, MOST.side), usual };
}

/** How wide an entrance is, if that is known, and where. @param {string} key @returns {Field[]} */
function entranceFields(key) {
  const wide = length(`${key}.2`, () => _("how wide it is"), 20, MOST.side);
  return [{ ...wide, begin: WIDE }, ...place(key)];
}

/** The numbers of a thing. @param {Thing} thing @returns {Field[]} */
function fieldsOf({ id, table: { kind, rectangle, ...held } }) {
  if (id === "venue") {
    const edge = margin("limits.venue_margin", () => _("how far to stay from its edge"));
    return rectangle ? [direction("venue.angle"), edge] : [edge];
  }
  if (id === "route.street")
    return [
      streetField("width", () => _("width of the way in"), 6, 20),
      streetField("radius", () => _("radius of its last bends"), 3, 10),
      streetField("deviation", () => _("how far to cut its corners"), 1, 5),
    ];
  if (id.startsWith("cues"))
    return [restField(`${id}.hold`), ...(held.place ? place(`${id}.place`) : [])];
  if (!kind) return entranceFields(`event.${id.replace(".", "s.")}`);
  const sizes = {
    circle: [length(`${id}.radius`, () => _("radius"), 5, MOST.radius), ...place(`${id}.centre`)],
    rectangle: [
      length(`${id}.size.0`, () => _("length"), 20, MOST.side),
      length(`${id}.size.1`, () => _("width"), 20, MOST.side),
      direction(`${id}.angle`),
      ...place(`${id}.centre`),
    ],
  }[/** @type {string} */ (kind)];
  return [...(sizes ?? []), margin(`${id}.margin`, () => _("how far to stay from it"))];
}

/** Whether a thing has a name of its own. @param {Thing} thing */
const isNamed = ({ id, table }) => !/^(entrance|route)/.test(id) && !table.round;

/** How large a thing is, in words. @param {Thing["table"]} table */
function sizeText({ kind, radius, size, rectangle, points, boundary, hold, width: wide }) {
  if (hold) return `${hold} s`;
  if (wide && !points) return _("{width} m wide", { width: wide });
  const [length, width] = rectangle ?? size ?? [];
  const round = kind === "circle" ? radius : radiusOf({ boundary });
  if (length && width) return _("{length} m by {width} m", { length, width });
  if (round) return _("radius {value} m", { value: round });
  const corners = pointsOf(points ?? boundary);
  return corners.length ? _("{count} corners", { count: corners.length }) : "";
}

/** The size of a square, as it is typed. @param {Thing["table"]} venue */
function typedSize(venue) {
  const radius = radiusOf(venue);
  return venue.rectangle ? venue.rectangle.join("x") : radius === null ? "" : `r${radius}`;
}

/** A text of a thing, in a box. */
class TextBox {
  /**
   * @param {string} name
   * @param {(text: string) => Plan} read a plan with what was typed; an InputError says why it cannot be
   * @param {(plan: Plan, final: boolean) => void} changed
   */
  constructor(name, read, changed) {
    this.read = read;
    this.changed = changed;
    this.shown = "";
    this.box = make("input", {
      type: "text",
      autocomplete: "off",
      maxlength: String(MOST_LETTERS),
      onchange: () => this.#typed(),
    });
    this.asked = make("p", { class: "asked", role: "alert", hidden: true });
    const label = make("label", { class: "called" }, make("span", { class: "name" }, name), this.box);
    this.element = make("div", { class: "field" }, label, this.asked);
  }

  /** Take what was typed, or ask back. */
  #typed() {
    try {
      const plan = this.read(this.box.value);
      this.#ask("");
      this.changed(plan, true);
      this.box.value = this.shown;
    } catch (error) {
      if (!(error instanceof InputError)) throw error;
      this.#ask(error.message);
    }
  }

  /** @param {string} question */
  #ask(question) {
    this.asked.textContent = question;
    this.asked.hidden = !question;
    this.box.ariaInvalid = String(Boolean(question));
  }

  /** @param {string} text what the plan says */
  show(text) {
    if (text === this.shown) return; // what was typed is still asked about
    this.shown = this.box.value = text;
    this.#ask("");
  }
}

export class ThingRow {
  /**
   * @param {Thing} thing
   * @param {(plan: Plan, final: boolean) => void} changed
   * @param {() => void} drawn asks for another edge of the square
   * @param {(open: boolean) => void} chosen
   */
  constructor(thing, changed, drawn, chosen) {
    const { id } = thing;
    this.id = id;
    /** @type {Plan} */
    this.plan = {};
    const put = (
      /** @type {string} */ key,
      /** @type {unknown} */ value,
      /** @type {boolean} */ final,
    ) => changed(withAt(this.plan, key, value), final);
    this.called = new TextBox(_("name"), (text) => this.#named(text), changed);
    this.size = new TextBox(
      _("length x width; r12 if it is round"),
      (text) => this.#sized(text),
      changed,
    );
    this.controls = fieldsOf(thing).map((field) => new NumberControl(field, put));
    this.summary = make("summary");
    this.away = wordButton(_("delete"), thing.name, () => changed(withoutThing(this.plan, id), true));
    const edge = make("button", { type: "button", onclick: drawn });
    edge.append(_("draw its edge"));
    this.element = make(
      "details",
      { "data-thing": id, ontoggle: () => chosen(this.element.open) },
      this.summary,
      ...(isNamed(thing) ? [this.called.element] : []),
      ...(id === "venue" ? [this.size.element] : []),
      ...this.controls.map(({ element }) => element),
      make("div", { class: "row" }, ...(id === "venue" ? [edge] : []), this.away),
    );
  }

  /** The plan with the thing called so, in one line, unless something else is. @param {string} text */
  #named(text) {
    const name = text.replace(/[\p{C}\p{Z}]+/gu, " ").trim();
    if (namesTaken(this.plan, this.id).has(name))
      throw new InputError(
        _("Something else is called {name} already: choose another name.", { name }),
      );
    return withAt(
      this.plan,
      `${this.id}.${this.id.startsWith("cues") ? "text" : "name"}`,
      name || null,
    );
  }

  /** The plan with a square of this size. @param {string} text */
  #sized(text) {
    if (!text.trim()) return this.plan;
    return withSize(this.plan, SQUARE.answer(_(SQUARE.label), text));
  }

  /** @param {Plan} plan @param {Thing} thing */
  show(plan, { table, name }) {
    this.plan = plan;
    this.summary.replaceChildren(
      make("span", {}, name),
      make("span", { class: "unit" }, sizeText(table)),
    );
    this.away.title = this.away.ariaLabel = `${this.away.textContent}: ${name}`;
    this.called.show(table.name ?? table.text ?? "");
    this.size.show(typedSize(table));
    for (const control of this.controls) control.show(plan);
  }
}
