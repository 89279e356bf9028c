// A bench's own card: what it does now, its largest, its tightest, its neighbours.

import { clock, toldTime } from "./axis.js";
import { make, signButton, textButton } from "./elements.js";
import { _, decimals, language, shortLength } from "./words.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./scene.js").Stand} Stand */
/** @typedef {import("./nearness.js").Boxes} Boxes */

/** What its village calls a bench; "" where the plan does not say how that counts. @param {Scene} scene @param {number} bench number from 1 */
function villageName({ benches, sent: { village } }, bench) {
  if (!village) return "";
  const { head, between, tail, before } = village;
  const said = bench === 1 ? head : bench === benches ? tail : between;
  return said[language()].replace("{n}", String(bench - before));
}

/** The same, or else the plan's number. @param {Scene} scene @param {number} bench number from 1 */
export function shortName(scene, bench) {
  return villageName(scene, bench) || _("Bench {bench}", { bench });
}

/** What a bench is called: by its village too. @param {Scene} scene @param {number} bench number from 1 */
function benchName(scene, bench) {
  const name = villageName(scene, bench);
  if (name) return _("{name} (bench {bench} of the plan)", { name, bench });
  const { benches } = scene;
  if (bench === 1) return _("Bench 1 (head)");
  return bench === benches ? _("Bench {bench} (tail)", { bench }) : _("Bench {bench}", { bench });
}

export class Card {
  /**
   * @param {(bench: number) => void} choose a bench, from 0; -1 for none
   * @param {(time: number, benches: number[]) => void} jump to a time, with some benches in sight
   */
  constructor(choose, jump) {
    this.choose = choose;
    this.jump = jump;
    /** @type {Scene | null} */
    this.scene = null;
    this.element = make("aside", { class: "card", hidden: true, "aria-label": _("bench") });
    /** @type {Record<string, HTMLElement>} */
    this.cells = {};
  }

  /** @param {Scene} scene @param {number} bench from 0, or -1 */
  open(scene, bench) {
    this.element.hidden = bench < 0;
    this.scene = scene;
    if (bench < 0) return;
    const { nearest, benches } = scene.sent;
    const now = (/** @type {string} */ name) => (this.cells[name] = make("dd"));
    const at = (/** @type {string} */ text, /** @type {number} */ time) =>
      make(
        "dd",
        {},
        text,
        " ",
        textButton(toldTime(scene, time, clock(time)), () => this.jump(time, [bench + 1])),
      );
    const far = _("never within {reach}", { reach: shortLength(nearest.reach) });
    const other = nearest.other[bench];
    this.element.replaceChildren(
      make(
        "header",
        {},
        make("h2", {}, benchName(scene, bench + 1)),
        signButton("\u2715", _("close"), () => this.choose(-1)),
      ),
      make(
        "dl",
        {},
        make("dt", {}, _("front handle")),
        now("front"),
        make("dt", {}, _("rear handle")),
        now("rear"),
        make("dt", {}, _("change of speed")),
        now("change"),
        make("dt", {}, _("its fastest moment")),
        at(speedText(scene.fastest.speed[bench]), scene.fastest.time[bench]),
        make("dt", {}, _("nearest")),
        now("nearest"),
        make("dt", {}, _("its tightest moment")),
        other
          ? at(nearText(scene, nearest.distance[bench], other), nearest.time[bench])
          : make("dd", {}, far),
        make("dt", {}, _("size")),
        make(
          "dd",
          {},
          `${decimals(benches.length[bench], 2)} m \u00d7 ${decimals(benches.width[bench], 2)} m`,
        ),
      ),
      make("nav", {}, ...this.#neighbours(scene, bench)),
    );
  }

  /** @param {Scene} scene @param {number} bench */
  #neighbours(scene, bench) {
    const found = [];
    const button = (/** @type {number} */ other, /** @type {string} */ text) =>
      textButton(text, () => this.choose(other));
    if (bench > 0) found.push(button(bench - 1, `\u2190 ${shortName(scene, bench)}`));
    if (bench + 1 < scene.benches)
      found.push(button(bench + 1, `${shortName(scene, bench + 2)} \u2192`));
    return found;
  }

  /** What changes from instant to instant. @param {Stand} stand @param {Boxes} boxes @param {number} bench */
  show(stand, boxes, bench) {
    if (bench < 0 || !this.scene) return;
    this.cells.front.textContent = speedText(stand.v[bench]);
    this.cells.rear.textContent = speedText(stand.v[bench + 1]);
    this.cells.change.textContent = `${decimals(stand.a[bench], 3)} m/s\u00b2`;
    const other = boxes.other[bench] + 1;
    this.cells.nearest.textContent = other
      ? nearText(this.scene, boxes.nearest[bench], other, boxes.touch)
      : "\u2013";
  }
}

/** @param {number} speed m/s */
function speedText(speed) {
  return `${decimals(speed, 3)} m/s`;
}

/** @param {Scene} scene @param {number} gap m @param {number} other number of the other bench @param {number} [touch] m */
function nearText(scene, gap, other, touch = 0) {
  const name = villageName(scene, other) || _("bench {bench}", { bench: other });
  return gap > touch
    ? _("{gap} to {name}", { gap: shortLength(gap), name })
    : _("touches {name}", { name });
}
