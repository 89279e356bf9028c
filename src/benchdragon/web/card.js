// A bench's own card: what it does now, its largest, its tightest, its neighbours.

import { clock } from "./axis.js";
import { make, signButton } from "./elements.js";
import { _, decimals, shortLength } from "./words.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./scene.js").Stand} Stand */
/** @typedef {import("./nearness.js").Boxes} Boxes */

/** @param {number} bench number from 1 @param {number} benches */
export function benchName(bench, benches) {
  if (bench === 1) return _("Bench 1 (head)");
  return bench === benches ? _("Bench {bench} (tail)", { bench }) : _("Bench {bench}", { bench });
}

export class Card {
  /**
   * @param {(bench: number) => void} choose a bench, from 0; -1 for none
   * @param {(time: number) => void} jump
   */
  constructor(choose, jump) {
    this.choose = choose;
    this.jump = jump;
    this.element = make("aside", { class: "card", hidden: true, "aria-label": _("bench") });
    /** @type {Record<string, HTMLElement>} */
    this.cells = {};
  }

  /** @param {Scene} scene @param {number} bench from 0, or -1 */
  open(scene, bench) {
    this.element.hidden = bench < 0;
    if (bench < 0) return;
    const { nearest, benches } = scene.sent;
    const near = nearest.distance[bench];
    const now = (/** @type {string} */ name) => (this.cells[name] = make("dd"));
    const at = (/** @type {string} */ text, /** @type {number} */ time) =>
      make("dd", {}, text, " ", make("button", { type: "button", onclick: () => this.jump(time) }, clock(time)));
    const far = _("never within {reach}", { reach: shortLength(nearest.reach) });
    const other = { gap: shortLength(Math.max(near, 0)), other: nearest.other[bench] };
    this.element.replaceChildren(
      make("header", {}, make("h2", {}, benchName(bench + 1, scene.benches)), signButton("\u2715", _("close"), () => this.choose(-1))),
      make("dl", {},
        make("dt", {}, _("front handle now")), now("front"),
        make("dt", {}, _("rear handle now")), now("rear"),
        make("dt", {}, _("its largest")), at(`${decimals(scene.fastest.speed[bench], 3)} m/s`, scene.fastest.time[bench]),
        make("dt", {}, _("nearest now")), now("nearest"),
        make("dt", {}, _("its tightest moment")), near < 0 ? make("dd", {}, far) : at(_("{gap} to bench {other}", other), nearest.time[bench]),
        make("dt", {}, _("size")), make("dd", {}, `${decimals(benches.length[bench], 2)} m \u00d7 ${decimals(benches.width[bench], 2)} m`),
      ),
      make("nav", {}, ...this.#neighbours(scene, bench)),
    );
  }

  /** @param {Scene} scene @param {number} bench */
  #neighbours(scene, bench) {
    const found = [];
    if (bench > 0) found.push(make("button", { type: "button", onclick: () => this.choose(bench - 1) }, `\u2190 ${_("Bench {bench}", { bench })}`));
    if (bench + 1 < scene.benches) found.push(make("button", { type: "button", onclick: () => this.choose(bench + 1) }, `${_("Bench {bench}", { bench: bench + 2 })} \u2192`));
    return found;
  }

  /** What changes from instant to instant. @param {Stand} stand @param {Boxes} boxes @param {number} bench */
  show(stand, boxes, bench) {
    if (bench < 0) return;
    this.cells.front.textContent = handleText(stand, bench);
    this.cells.rear.textContent = handleText(stand, bench + 1);
    const other = boxes.other[bench];
    const gap = boxes.nearest[bench];
    this.cells.nearest.textContent =
      other < 0 ? "\u2013" : gap > 0 ? _("{gap} to bench {other}", { gap: shortLength(gap), other: other + 1 }) : _("touches bench {other}", { other: other + 1 });
  }
}

/** @param {Stand} stand @param {number} handle */
function handleText(stand, handle) {
  return `${decimals(stand.v[handle], 3)} m/s, ${decimals(stand.a[handle], 3)} m/s\u00b2`;
}
