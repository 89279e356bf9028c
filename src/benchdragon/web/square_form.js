// The square in the panel: its edge by numbers, what is put onto it, and the list of all that stands there.

import { make } from "./elements.js";
import { spread } from "./extent.js";
import { sketchOf } from "./sketch.js";
import { ThingRow } from "./thing_row.js";
import { hasSquare, SORTS, streetOf, thingsOf, withRounds, withSquare, withThing } from "./things.js";
import { _ } from "./words.js";

/** @typedef {import("./grips.js").Grips} Grips */
/** @typedef {import("./placing.js").Placing} Placing */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./player.js").Player} Player */
/** @typedef {import("./things.js").Sort} Sort */
/** @typedef {import("./things.js").Thing} Thing */
/** @typedef {[number, number]} Point */

/** What is put onto the square by a button each. @type {Sort[]} */
const ADDED = ["well", "stage", "tree", "shape", "entrance", "street", "rest"];
/** Ground left free about the dance in a new square, m. */
const ABOUT = 1.5;

/**
 * The page whose plan is changed.
 * @typedef {{ plan: Plan, player: Player | null, grips: Grips, placing: Placing,
 *   photo: import("./photo.js").Photo,
 *   change: (plan: Plan, final: boolean) => void }} Host
 */

export class SquareForm {
  /** @param {Host} host */
  constructor(host) {
    this.host = host;
    /** The id of the thing that is shown in the picture. */
    this.chosen = "";
    /** @type {Map<string, ThingRow>} */
    this.rows = new Map();
    const { grips, placing } = host;
    placing.end();
    grips.marks = (plan) => (placing.wish ? placing.lines : this.#outline(plan));
    this.begin = make(
      "button",
      { type: "button", onclick: () => this.#addSquare() },
      `+ ${_("square")}`,
    );
    const buttons = ADDED.map((sort) =>
      make(
        "button",
        { type: "button", "data-add": sort, onclick: () => this.#ask(sort) },
        `+ ${SORTS[sort].button()}`,
      ),
    );
    const street = ADDED.indexOf("street");
    this.street = buttons[street];
    this.between = make(
      "button",
      { type: "button", onclick: () => host.change(withRounds(host.plan), true) },
      `+ ${_("rest between the rounds")}`,
    );
    this.adding = make(
      "div",
      { class: "row adders", role: "group", "aria-label": _("put onto the square") },
      this.begin,
      ...buttons,
      this.between,
    );
    this.list = make("div", { class: "things" });
    this.element = make(
      "fieldset",
      {},
      make("legend", {}, _("The square")),
      this.adding,
      this.list,
      host.photo.controls(),
    );
  }

  /** What the rows are made for: the ids and kinds of things. */
  #made = "";

  /** @param {Plan} plan */
  show(plan) {
    const things = thingsOf(plan);
    this.begin.hidden = hasSquare(plan);
    this.street.hidden = plan.route.kind === "drawn" || streetOf(plan).length > 0;
    this.between.hidden = !(plan.route.kind === "turn" && plan.route.rounds > 1);
    const made = JSON.stringify(things.map(({ id, table }) => [id, table.kind, !table.rectangle]));
    if (made !== this.#made) this.#rebuild(things);
    this.#made = made;
    for (const thing of things) this.rows.get(thing.id)?.show(plan, thing);
  }

  /** @param {Thing[]} things */
  #rebuild(things) {
    const held = this.list.contains(document.activeElement);
    if (!things.some(({ id }) => id === this.chosen)) this.chosen = "";
    this.rows = new Map(
      things.map((thing) => {
        const row = new ThingRow(
          thing,
          (plan, final) => this.host.change(plan, final),
          () => this.#ask("edge"),
          (open) => this.#toggled(thing.id, open),
        );
        row.element.open = thing.id === this.chosen;
        return [thing.id, row];
      }),
    );
    this.list.replaceChildren(...[...this.rows.values()].map(({ element }) => element));
    if (held) this.adding.querySelector("button")?.focus({ preventScroll: true });
  }

  /** A row was opened or closed. @param {string} id @param {boolean} open */
  #toggled(id, open) {
    if (open && id !== this.chosen) this.#choose(id);
    else if (!open && id === this.chosen) this.#choose("");
  }

  /** Show a thing in the picture, and its row alone open; "": none. @param {string} id */
  #choose(id) {
    this.chosen = id;
    for (const [other, { element }] of this.rows) element.open = other === id;
    const { player, grips } = this.host;
    const [lines] = this.#outline(this.host.plan);
    if (player && id === "venue") player.fit(spread(player.scene));
    else if (player && lines) bring(player, lines);
    grips.renew();
    if (id) grips.linger();
  }

  /** The outline of the thing that is chosen. @param {Plan} plan */
  #outline(plan) {
    const thing = thingsOf(plan).find(({ id }) => id === this.chosen);
    return thing ? sketchOf(thing.alone) : [];
  }

  /** Ask where something is to be put. @param {Sort} sort */
  #ask(sort) {
    const { button, name, corners, open } = SORTS[sort];
    const says = (/** @type {number} */ taps) => {
      if (sort === "rest") return _("Tap in the picture where the head is to stand for a while.");
      if (open && !taps)
        return _("Tap where the head sets out, then each bend, and where the street ends.");
      if (open) return _("Tap the next bend, or press done where the street ends.");
      if (!corners) return _("Tap in the picture where the {name} is.", { name: name() });
      if (taps < 3) return _("Tap its corners in the picture, one after another.");
      return _("Tap the next corner, or the first again to close it.");
    };
    const done = (/** @type {Point[]} */ points) => this.#placed(sort, points);
    this.host.placing.begin({
      name: button(), says, taps: corners ? Infinity : 1, middle: !open, open, done,
    }); // prettier-ignore
  }

  /** Something was put onto the square: choose it, and have it ready to be dragged. @param {Sort} sort @param {Point[]} points */
  #placed(sort, points) {
    const { plan, id } = withThing(this.host.plan, sort, points);
    this.host.change(plan, true);
    this.#choose(id);
    this.host.grips.take(id);
  }

  /** A square about the dance. */
  #addSquare() {
    const { player, plan } = this.host;
    if (!player) return; // no dance, and no button then
    this.host.change(withSquare(plan, player.room(spread(player.scene), ABOUT)), true);
    this.#choose("venue");
    this.rows.get("venue")?.summary.focus();
  }
}

/** Have an outline in sight. @param {Player} player @param {Point[]} outline */
function bring(player, outline) {
  const [xs, ys] = [outline.map(([x]) => x), outline.map(([, y]) => y)];
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const radius = 0.5 * Math.max(right - left, high - low);
  if (player.camera.bring(0.5 * (left + right), 0.5 * (low + high), radius)) player.zoom(1);
}
