// The plan as controls: a slider and a number for each size.

import { choice, make } from "./elements.js";
import { MOST_LENGTH, MOST_WIDTH } from "./made/answers.js";
import { DanceKind } from "./dance_kind.js";
import { NumberControl } from "./number_control.js";
import { _, language } from "./words.js";

/** @typedef {import("./messages").Preset} Preset */
/**
 * A plan as plain data; values stand under dotted names.
 * @typedef {Record<string, any>} Plan
 */

/** @typedef {import("./number_control.js").Field} Field */
/** @typedef {import("./number_control.js").Put} Put */

/** @param {Plan} plan */
const sized = (plan) => !plan.dragon.bench?.length;
/** @param {Plan} plan */
const spiral = (plan) => ["spiral-in", "turn"].includes(plan.route.kind);
/** @param {Plan} plan */
const turning = (plan) => plan.route.kind === "turn";
/** @param {Plan} plan */
const again = (plan) => turning(plan) && plan.route.rounds > 1;
/** Whether a plan's dance turns once, with no street before it. @param {Plan} plan */
export const turnsOnce = (plan) => turning(plan) && !again(plan) && !plan.route.street;
/** @param {Plan} plan */
const goesBack = (plan) => again(plan) || (turning(plan) && plan.route.street);
/** @param {Plan} plan */
const steady = (plan) => !plan.walk.profile?.length;
/** @param {Plan} plan */
const twoArcs = (plan) => turning(plan) && plan.turn.family === "arc-arc";
/** @param {Plan} plan */
const threePieces = (plan) => turning(plan) && plan.turn.family !== "arc-arc";
/** @param {Plan} plan */
const threeArcs = (plan) => turning(plan) && plan.turn.family === "arc-arc-arc";

/**
 * Numbers that belong together; `first` names what stands above them.
 * @type {{name: () => string, first?: "parts" | "family", fields: Field[], when?: (plan: Plan) => boolean}[]}
 */
// prettier-ignore
const GROUPS = [
  {
    name: () => _("Dragon"),
    fields: [
      { key: "dragon.benches", text: () => _("number of benches"),
        unit: "", low: 2, high: 400, step: 1, whole: true, when: sized },
      { key: "dragon.head_length", text: () => _("length of the head"),
        unit: "m", low: 0.8, high: 5, step: 0.01, most: MOST_LENGTH, when: sized },
      { key: "dragon.body_length", text: () => _("length of a bench"),
        unit: "m", low: 0.8, high: 4, step: 0.01, most: MOST_LENGTH, when: sized },
      { key: "dragon.width", text: () => _("width of a bench"),
        unit: "m", low: 0.1, high: 0.8, step: 0.01, most: MOST_WIDTH, when: sized },
    ],
  },
  {
    name: () => _("Route"),
    first: "parts",
    fields: [
      { key: "route.pitch", text: () => _("spiral pitch"),
        unit: "m", low: 0.3, high: 3, step: 0.002, when: spiral },
      { key: "route.start_turn", text: () => _("turns at the start"),
        unit: "", low: 4, high: 30, step: 0.25, when: (plan) => plan.route.kind === "spiral-in" },
      { key: "route.rounds", text: () => _("rounds in and out"),
        unit: "", low: 1, high: 8, step: 1, usual: 1, whole: true, when: turning },
      { key: "route.outer_radius", text: () => _("goes back at radius"),
        unit: "m", low: 2, high: 30, step: 0.1, begin: 10, when: goesBack },
      { key: "route.back_radius", text: () => _("radius of the bend back"),
        unit: "m", low: 0.5, high: 5, step: 0.05, begin: 2, when: again },
      { key: "disc.radius", text: () => _("radius of the turning disc"),
        unit: "m", low: 1, high: 10, step: 0.05, begin: 4.5, when: spiral },
    ],
  },
  {
    name: () => _("Turn"),
    first: "family",
    when: turning,
    fields: [
      { key: "turn.ratio", text: () => _("ratio of the radii"),
        unit: "", low: 0.5, high: 4, step: 0.01, usual: 2, when: twoArcs },
      { key: "turn.radii.0", text: () => _("first radius"),
        unit: "m", low: 1, high: 5, step: 0.01, begin: 2, when: threePieces },
      { key: "turn.radii.1", text: () => _("last radius"),
        unit: "m", low: 1, high: 5, step: 0.01, begin: 2, when: threePieces },
      { key: "turn.curvature", text: () => _("curvature of the middle arc"),
        unit: "1/m", low: -0.5, high: 0.5, step: 0.005, usual: 0, when: threeArcs },
      { key: "turn.entry_radius", text: () => _("leaves the spiral at radius"),
        unit: "m", low: 1, high: 10, step: 0.01, begin: 4.5 },
      { key: "turn.exit_radius", text: () => _("joins the other at radius"),
        unit: "m", low: 1, high: 10, step: 0.01, begin: 4.5 },
      { key: "turn.ease", text: () => _("clothoids between"), unit: "m", low: 0, high: 2, step: 0.01 },
    ],
  },
  {
    name: () => _("Walk and limits"),
    fields: [
      { key: "walk.speed", text: () => _("head speed"),
        unit: "m/s", low: 0.1, high: 3, step: 0.01, when: steady },
      { key: "limits.margin", text: () => _("margin to keep between benches"),
        unit: "m", low: 0, high: 0.5, step: 0.005 },
      { key: "limits.speed", text: () => _("greatest speed of a handle"),
        unit: "m/s", low: 0.2, high: 4, step: 0.05, begin: 2 },
      { key: "limits.acceleration", text: () => _("greatest acceleration along the route"),
        unit: "m/s\u00b2", low: 0.05, high: 5, step: 0.05, begin: 1 },
      { key: "limits.lateral_acceleration", text: () => _("greatest lateral acceleration"),
        unit: "m/s\u00b2", low: 0.05, high: 5, step: 0.05, begin: 1 },
      { key: "limits.total_acceleration", text: () => _("greatest total acceleration"),
        unit: "m/s\u00b2", low: 0.05, high: 5, step: 0.05, begin: 1 },
      { key: "limits.turning_rate", text: () => _("greatest turning rate of a bench"),
        unit: "\u00b0/s", low: 5, high: 180, step: 1, begin: 60 },
      { key: "limits.head_acceleration", text: () => _("greatest change of the head's speed"),
        unit: "m/s\u00b2", low: 0.05, high: 2, step: 0.05 },
    ],
  },
];

/** The number of the form under a key. @param {string} key */
export function fieldOf(key) {
  const found = GROUPS.flatMap(({ fields }) => fields).find((field) => field.key === key);
  if (!found) throw new RangeError(key);
  return found;
}

/** A plan as text, the same for the same plan: keys in order, without those that say nothing. @param {Plan} plan */
export function planText(plan) {
  const said = (/** @type {object} */ table) =>
    Object.entries(table)
      .filter(([, value]) => value !== null && value !== undefined)
      .sort(([one], [other]) => (one < other ? -1 : 1));
  return JSON.stringify(plan, (_key, value) =>
    isTable(value) ? Object.fromEntries(said(value)) : value,
  );
}

/** Whether a value of a plan is a table. @param {unknown} value @returns {value is Record<string, unknown>} */
export function isTable(value) {
  return value instanceof Object && !Array.isArray(value);
}

const TABLES = ["dragon", "route", "disc", "turn", "walk", "limits"];

/** Data as a plan, as far as this page needs it to be one; null if it is none. @param {unknown} data @returns {Plan | null} */
export function planOf(data) {
  return isTable(data) && TABLES.every((name) => isTable(data[name])) ? fitting(data) : null;
}

/** The plan in the text of one; null if it holds none. @param {string} text */
export function textPlan(text) {
  try {
    return planOf(JSON.parse(text));
  } catch (error) {
    if (error instanceof SyntaxError || error instanceof TypeError) return null;
    throw error;
  }
}

/** The plan with another value under a key. @param {Plan} plan @param {string} key @param {unknown} value @returns {Plan} */
export function withValue(plan, key, value) {
  const copy = structuredClone(plan);
  const [table, name, place] = key.split(".");
  copy[table] ??= {};
  if (place === undefined) copy[table][name] = value;
  else if (value === null) copy[table][name] = null;
  else {
    const pair = copy[table][name] ?? [value, value];
    pair[Number(place)] = value;
    copy[table][name] = pair;
  }
  if (key === "route.rounds") copy.walk.end = null; // it ends where the last round does
  if (key === "dragon.body_length" && copy.dragon.tail_length === plan.dragon.body_length)
    copy.dragon.tail_length = value;
  return fitting(copy);
}

// Tables, and keys of routes, that mean something beside some routes, families and walks alone.
const CHOSEN = ["disc", "turn", "walk", "route.outer_radius", "route.back_radius"];

/** The plan without what has no effect beside its choices, which readers of plans refuse. @param {Plan} plan @returns {Plan} */
export function fitting(plan) {
  const copy = structuredClone(plan);
  if (!turning(copy)) copy.turn = {};
  for (const { key, usual, when } of GROUPS.flatMap(({ fields }) => fields)) {
    const [table, name] = key.split(".");
    if (!when || !(CHOSEN.includes(table) || CHOSEN.includes(key))) continue;
    if (table === "route" && copy.route.kind === "formation") continue; // these are sizes of its own
    if (!when(copy)) delete copy[table][name];
    else if (usual !== undefined) copy[table][name] ??= usual;
  }
  return copy;
}

export class PlanForm {
  /**
   * @param {Preset[]} presets
   * @param {(plan: Plan, final: boolean) => void} changed
   */
  constructor(presets, changed) {
    this.presets = presets;
    this.changed = changed;
    /** @type {Plan} */
    this.plan = {};
    /** @type {Put} */
    const told = (key, value, final) => changed(withValue(this.plan, key, value), final);
    this.controls = GROUPS.map((group) => group.fields.map((field) => new NumberControl(field, told)));
    this.preset = choice(
      _("begin with"),
      [
        ["", _("choose one")],
        ...presets.map(
          ({ name, title }) => /** @type {[string, string]} */ ([name, title[language()]]),
        ),
      ],
      "",
      (name) => this.#take(name),
    );
    this.source = make("p", { class: "source" });
    this.family = choice(
      _("kind of turn"),
      [
        ["arc-arc", _("two arcs")],
        ["arc-line-arc", _("arc, line, arc")],
        ["arc-arc-arc", _("three arcs")],
      ],
      "arc-arc",
      (family) => told("turn.family", family, true),
    );
    this.parts = make(
      "p",
      { class: "source" },
      _("The route of this plan is a list of parts: change it in the plan file."),
    );
    const name = make("span", { class: "name" }, _("kind of turn"));
    const kind = make("label", { class: "field" }, name, this.family);
    this.kind = new DanceKind((plan, final) => changed(fitting(plan), final));
    const first = { parts: [this.kind.element, this.parts], family: [kind] };
    this.groups = GROUPS.map((group, n) =>
      make(
        "fieldset",
        {},
        make("legend", {}, group.name()),
        ...(group.first ? first[group.first] : []),
        ...this.controls[n].map(({ element }) => element),
      ),
    );
    this.element = make(
      "form",
      { class: "form", onsubmit: (event) => event.preventDefault() },
      make("label", { class: "field" }, make("span", { class: "name" }, _("begin with")), this.preset),
      this.source,
      ...this.groups,
    );
  }

  /** Take the plan of a preset. @param {string} name */
  #take(name) {
    const found = this.presets.find((preset) => preset.name === name);
    if (found) this.changed(structuredClone(/** @type {Plan} */ (found.plan)), true);
  }

  /** @param {Plan} plan */
  show(plan) {
    this.plan = plan;
    const same = this.presets.find((preset) => planText(preset.plan) === planText(plan));
    this.preset.value = same?.name ?? "";
    if (same) this.source.textContent = same.source[language()];
    this.source.hidden = !same;
    this.parts.hidden = !["parts", "programme"].includes(plan.route.kind);
    this.kind.show(plan);
    this.family.value = plan.turn?.family ?? "arc-arc";
    GROUPS.forEach((group, n) => {
      this.groups[n].hidden = group.when ? !group.when(plan) : false;
      for (const control of this.controls[n]) control.show(plan);
    });
  }
}
