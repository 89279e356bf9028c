// Places in the picture are asked for and tapped: what is said meanwhile, and how it ends.

import { _crossing, doMeet } from "./compute/obstacle.js";
import { make, textButton } from "./elements.js";
import { roundedPoint } from "./grip_kinds.js";
import { _ } from "./words.js";

/** @typedef {import("./grips.js").Grips} Grips */
/** @typedef {import("./player.js").Player} Player */
/** @typedef {[number, number]} Point */

/** The first corner is tapped again within so many CSS pixels. */
const NEAR = 22;
/** Arms of the cross in the middle of the picture, CSS pixels. */
const ARM = 12;
/** Sides of what is placed in the middle, so that its corners can be taken hold of: CSS pixels, and m. */
const SIDE = 100;
const LEAST_SIDE = 2;

/** @typedef {{ player: Player | null, grips: Grips, root: HTMLElement }} Host */

/**
 * What places are asked for.
 * @typedef {object} Wish
 * @property {string} name
 * @property {(taps: number) => string} says what to do after so many taps
 * @property {number} taps how many places; Infinity: corners, until their outline is closed
 * @property {boolean} [middle] whether the middle of the picture would do
 * @property {boolean} [open] whether the corners are points of a line, which is not closed
 * @property {(points: Point[]) => void} done
 */

export class Placing {
  /** @param {Host} host */
  constructor(host) {
    this.host = host;
    /** @type {Wish | null} */
    this.wish = null;
    /** What was tapped so far. @type {Point[]} */
    this.points = [];
    this.bar = make("div", { class: "placing", role: "group", hidden: true });
    host.grips.element.append(this.bar);
    addEventListener("keydown", (event) => this.#key(event), true);
  }

  /** Who had the focus before. @type {Element | null} */
  #from = null;
  /** What taps in the picture do at other times. @type {Player["onTapped"] | null} */
  #tap = null;

  /** Ask for places. @param {Wish} wish */
  begin(wish) {
    const { player, root } = this.host;
    if (!player) return; // no picture, and no button then
    this.end();
    [this.wish, this.points] = [wish, []];
    this.#from = document.activeElement;
    this.#tap = player.onTapped;
    player.onTapped = (at) => this.#tapped(roundedPoint(at, !wish.middle));
    player.rule(false);
    for (const list of player.face.lists) list.open = false; // they lie over the picture
    root.classList.add("adding");
    this.bar.ariaLabel = wish.name;
    const said = make("p", { "aria-live": "polite" });
    this.bar.replaceChildren(
      said,
      textButton(_("in the middle"), () => this.#middle()),
      textButton(_("done"), () => this.#close()),
      textButton(_("give up"), () => this.#giveUp()),
    );
    this.bar.hidden = false;
    this.#show();
    player.face.stage.scrollIntoView({ block: "nearest" });
    const button = wish.middle ? this.bar.children[1] : this.bar.lastElementChild;
    /** @type {HTMLElement} */ (button).focus({ preventScroll: true });
  }

  /** Ask for nothing any more. */
  end() {
    const { player, grips, root } = this.host;
    if (!this.wish) return;
    this.wish = null;
    if (player && this.#tap) player.onTapped = this.#tap;
    root.classList.remove("adding");
    this.bar.hidden = true;
    grips.renew();
  }

  #giveUp() {
    this.end();
    if (this.#from instanceof HTMLElement) this.#from.focus({ preventScroll: true });
  }

  /** Say what to do, and draw what was done. @param {string} [trouble] */
  #show(trouble = "") {
    const { wish, points, bar } = this;
    if (!wish) return;
    const [said, middle, done] = bar.children;
    said.textContent = trouble || wish.says(points.length);
    /** @type {HTMLElement} */ (middle).hidden = !wish.middle || points.length > 0;
    /** @type {HTMLElement} */ (done).hidden = points.length < (wish.open ? 2 : 3);
    this.host.grips.renew();
  }

  /** What is drawn of it on the ground: a cross in the middle of the picture, and sides so far. @returns {Point[][]} */
  get lines() {
    const { player } = this.host;
    const { points } = this;
    if (!player) return [];
    const { x, y, scale } = player.camera;
    const arm = ARM / scale;
    if (!points.length)
      return [
        [[x - arm, y], [x + arm, y]],
        [[x, y - arm], [x, y + arm]],
      ]; // prettier-ignore
    const [[u, v]] = points;
    const near = (0.5 * NEAR) / scale;
    return [points, [[u, v - near], [u + near, v], [u, v + near], [u - near, v], [u, v - near]]]; // prettier-ignore
  }

  /** @param {Point} at */
  #tapped(at) {
    const { wish, points, host } = this;
    const reach = NEAR / (host.player?.camera.scale ?? 1);
    const [first, last] = [points[0], points[points.length - 1]];
    const again = points.length > 2 && Math.hypot(at[0] - first[0], at[1] - first[1]) <= reach;
    if (again && !wish?.open) return this.#close();
    if (last && at[0] === last[0] && at[1] === last[1]) return;
    const meets =
      !wish?.open && points.slice(0, -2).some((from, n) => doMeet(from, points[n + 1], last, at));
    if (meets) return this.#show(_("That side would cross another: tap elsewhere."));
    points.push(at);
    if (points.length === wish?.taps) this.#placed(points);
    else this.#show();
  }

  /** Close the outline. */
  #close() {
    if (this.wish?.open || !_crossing(this.points)) return this.#placed(this.points);
    this.points = [];
    this.#show(_("Its sides would cross: tap its corners anew, in going round."));
  }

  /** Place it in the middle of the picture. */
  #middle() {
    const { wish, host } = this;
    if (!host.player || !wish) return;
    const { x, y, scale } = host.player.camera;
    const half = 0.5 * Math.max(Math.ceil(SIDE / scale), LEAST_SIDE);
    const corners = /** @type {Point[]} */ ([[-1, -1], [1, -1], [1, 1], [-1, 1]]); // prettier-ignore
    const shape = corners.map(([a, b]) => roundedPoint([x + a * half, y + b * half], false));
    this.#placed(wish.taps === 1 ? [roundedPoint([x, y], false)] : shape);
  }

  /** @param {Point[]} points */
  #placed(points) {
    const { wish } = this;
    this.end();
    wish?.done(points);
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (!this.wish || event.key !== "Escape") return;
    event.stopPropagation();
    event.preventDefault();
    this.#giveUp();
  }
}
