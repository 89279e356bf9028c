// One thing on the square in the panel: its name, its sizes as numbers, the margin about it, and away with it.

import { make, wordButton } from "./elements.js";
import { NumberControl } from "./number_control.js";
import { MOST_LETTERS, namesTaken, withAt, withoutThing } from "./things.js";
import { _ } from "./words.js";

/** @typedef {import("./number_control.js").Field} Field */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./things.js").Thing} Thing */

/** A size larger than these, m, was mistyped: MOST_SQUARE of plans/answers.py, and less of what stands there. */
const MOST = { square: 2000, side: 200, radius: 50 };

/** @param {string} key @param {() => string} text @param {number} high @param {number} most @returns {Field} */
function length(key, text, high, most) {
  return { key, text, unit: "m", low: 0.1, high, step: 0.1, most };
}

/** @param {string} key @returns {Field} */
function direction(key) {
  return { key, text: () => _("direction"), unit: "\u00b0", low: -180, high: 180, step: 1, usual: 0 };
}

/** @param {string} key @param {() => string} text @returns {Field} */
function margin(key, text) {
  return { key, text, unit: "m", low: 0, high: 2, step: 0.05, most: MOST.radius, begin: 0.3 };
}

/** The numbers of a thing. @param {Thing} thing @returns {Field[]} */
function fieldsOf({ id, table: { kind, rectangle } }) {
  if (id === "venue") {
    const edge = margin("limits.venue_margin", () => _("how far to stay from its edge"));
    if (!rectangle) return [edge];
    return [
      length("venue.rectangle.0", () => _("length of the square"), 100, MOST.square),
      length("venue.rectangle.1", () => _("width of the square"), 100, MOST.square),
      direction("venue.angle"),
      edge,
    ];
  }
  if (!kind) return [];
  const sizes = {
    circle: [length(`${id}.radius`, () => _("radius"), 5, MOST.radius)],
    rectangle: [
      length(`${id}.size.0`, () => _("length"), 20, MOST.side),
      length(`${id}.size.1`, () => _("width"), 20, MOST.side),
      direction(`${id}.angle`),
    ],
  }[/** @type {string} */ (kind)];
  return [...(sizes ?? []), margin(`${id}.margin`, () => _("how far to stay from it"))];
}

/** How large a thing is, in words. @param {Thing["table"]} table */
function sizeText({ kind, radius, size, rectangle, points, boundary }) {
  const sides = rectangle ?? size;
  if (kind === "circle") return _("radius {value} m", { value: radius });
  if (sides) return _("{length} m by {width} m", { length: sides[0], width: sides[1] });
  const corners = points ?? boundary;
  return corners ? _("{count} corners", { count: corners.length }) : "";
}

/** What a thing is called, in a box. */
class NameBox {
  /** @param {string} id @param {(name: string) => void} changed */
  constructor(id, changed) {
    this.id = id;
    this.changed = changed;
    /** @type {Plan} */
    this.plan = {};
    this.box = make("input", {
      type: "text",
      autocomplete: "off",
      maxlength: String(MOST_LETTERS),
      onchange: () => this.#typed(),
    });
    this.asked = make("p", { class: "asked", role: "alert", hidden: true });
    const label = make(
      "label",
      { class: "called" },
      make("span", { class: "name" }, _("name")),
      this.box,
    );
    this.element = make("div", { class: "field" }, label, this.asked);
  }

  /** Take what was typed, in one line, unless something else is called so. */
  #typed() {
    const name = this.box.value.replace(/[\p{C}\p{Z}]+/gu, " ").trim();
    const taken = namesTaken(this.plan, this.id).has(name);
    this.#ask(
      taken ? _("Something else is called {name} already: choose another name.", { name }) : "",
    );
    if (!taken) this.changed(name);
  }

  /** @param {string} question */
  #ask(question) {
    this.asked.textContent = question;
    this.asked.hidden = !question;
    this.box.ariaInvalid = String(Boolean(question));
  }

  /** @param {Plan} plan @param {Thing} thing */
  show(plan, { table }) {
    const other = JSON.stringify(plan) !== JSON.stringify(this.plan);
    this.plan = plan;
    if (!other) return; // what was typed is still asked about
    this.box.value = table.name ?? "";
    this.#ask("");
  }
}

export class ThingRow {
  /**
   * @param {Thing} thing
   * @param {(plan: Plan, final: boolean) => void} changed
   * @param {(open: boolean) => void} chosen
   */
  constructor(thing, changed, chosen) {
    const { id } = thing;
    /** @type {Plan} */
    this.plan = {};
    const put = (
      /** @type {string} */ key,
      /** @type {unknown} */ value,
      /** @type {boolean} */ final,
    ) => changed(withAt(this.plan, key, value), final);
    this.called = new NameBox(id, (name) => put(`${id}.name`, name || null, true));
    this.controls = fieldsOf(thing).map((field) => new NumberControl(field, put));
    this.summary = make("summary");
    this.away = wordButton(_("delete"), thing.name, () => changed(withoutThing(this.plan, id), true));
    const named = id.startsWith("entrance") ? [] : [this.called.element];
    this.element = make(
      "details",
      { "data-thing": id, ontoggle: () => chosen(this.element.open) },
      this.summary,
      ...named,
      ...this.controls.map(({ element }) => element),
      this.away,
    );
  }

  /** @param {Plan} plan @param {Thing} thing */
  show(plan, thing) {
    this.plan = plan;
    const size = make("span", { class: "unit" }, sizeText(thing.table));
    this.summary.replaceChildren(make("span", {}, thing.name), size);
    this.away.title = this.away.ariaLabel = `${this.away.textContent}: ${thing.name}`;
    this.called.show(plan, thing);
    for (const control of this.controls) control.show(plan);
  }
}
