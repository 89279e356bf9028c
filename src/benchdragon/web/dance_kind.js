// What kind of dance a plan is: coiling in, in and out, or a formation by its name, with its sizes.

import { choice, held, make } from "./elements.js";
import { NumberControl } from "./number_control.js";
import { _, language } from "./words.js";

/** @typedef {import("./messages").NamedFormation} NamedFormation */
/** @typedef {import("./number_control.js").Put} Put */
/** @typedef {import("./plan_form.js").Plan} Plan */

/** What a coil begins with where another dance had none: its pitch, m, and turns. */
const PITCH = 1.8;
const TURNS = 12;
/** Sizes may be so many times as large on their slider as they usually are. */
const LARGER = 3;

/** The kind of a plan's dance, as the choice has it. @param {Plan} plan */
const kindOf = ({ route: { kind, name } }) => (kind === "formation" ? `${kind}.${name}` : kind);

/** A plan with another kind of dance, where the one before was danced. @param {Plan} plan @param {string} chosen @returns {Plan} */
function withKind(plan, chosen) {
  const [kind, name] = chosen.split(".");
  const { at, turned, street, pitch = PITCH, rounds } = plan.route;
  const own = {
    "spiral-in": { pitch, start_turn: TURNS },
    turn: { pitch, ...(rounds > 1 ? { rounds } : {}) },
    formation: { name },
  }[kind];
  const { start: _start, end: _end, position: _position, ...walk } = plan.walk;
  const { cues: _cues, ...others } = plan; // their places are on the way of the dance before
  const route = { kind, ...own, ...(at ? { at } : {}), ...(turned ? { turned } : {}) };
  const disc = kind === "formation" ? {} : plan.disc;
  return { ...others, route: { ...route, ...(street ? { street } : {}) }, disc, turn: {}, walk };
}

export class DanceKind {
  /** @param {(plan: Plan, final: boolean) => void} changed */
  constructor(changed) {
    /** @type {Plan} */
    this.plan = {};
    this.changed = changed;
    /** @type {NamedFormation[]} */
    this.formations = held("formations");
    const names = this.formations.map(({ name, title }) => [`formation.${name}`, title[language()]]);
    this.choice = choice(
      _("kind of dance"),
      [
        ["turn", _("coil in and out again")],
        ["spiral-in", _("coil in")],
        .../** @type {[string, string][]} */ (names),
        ["", _("another, from the plan file")],
      ],
      "",
      (kind) => kind && changed(withKind(this.plan, kind), true),
    );
    this.sizes = make("div");
    /** @type {NumberControl[]} */
    this.controls = [];
    const name = make("span", { class: "name" }, _("kind of dance"));
    this.element = make("div", {}, make("label", { class: "field" }, name, this.choice), this.sizes);
  }

  /** The formation whose sizes are shown. */
  #shown = "";

  /** @param {Plan} plan */
  show(plan) {
    this.plan = plan;
    const kind = kindOf(plan);
    this.choice.value = kind;
    if (!this.choice.value) this.choice.value = "";
    const name = plan.route.kind === "formation" ? plan.route.name : "";
    if (name !== this.#shown) this.#rebuild(name);
    for (const control of this.controls) control.show(plan);
  }

  /** @param {string} name of a formation, or "" */
  #rebuild(name) {
    this.#shown = name;
    const sizes = this.formations.find((one) => one.name === name)?.sizes ?? [];
    /** @type {Put} */
    const put = (key, value, final) => {
      const route = { ...this.plan.route, [key.split(".")[1]]: value };
      this.changed({ ...this.plan, route }, final);
    };
    this.controls = sizes.map(({ name: size, text, least, most, unit, usual }) => {
      const [high, step] = [Math.min(most, LARGER * usual), unit ? 0.1 : 1];
      const told = { key: `route.${size}`, text: () => text[language()], unit, low: least, high, step };
      return new NumberControl({ ...told, usual, whole: !unit }, put);
    });
    this.sizes.replaceChildren(...this.controls.map(({ element }) => element));
  }
}
