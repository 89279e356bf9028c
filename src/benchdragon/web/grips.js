// Grips on the picture: what of the plan can be dragged, or moved by arrow keys.

import { draw, make } from "./elements.js";
import { gripsOf } from "./grip_kinds.js";
import { sketchOf } from "./sketch.js";
import { _ } from "./words.js";

/** @typedef {import("./grip_kinds.js").Grip} Grip */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./player.js").Player} Player */

/**
 * The page whose plan is changed.
 * @typedef {object} Host
 * @property {Plan} plan
 * @property {Player | null} player
 * @property {(plan: Plan, final: boolean) => void} change
 */

/** Shift makes arrow keys go so many steps. */
const LARGER = 10;
/** Grips stay so long after a finger touched the picture, ms. */
const LINGER = 5000;
/** The lever that turns the dance, CSS pixels. */
const ARM = 90;
/** @type {Record<string, [number, number]>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** A grip that is being moved, held so far from its middle, m. @typedef {{ grip: Grip, began: Plan, from: [number, number] }} Drag */

export class Grips {
  /** @param {Host} host @param {HTMLElement} stage where the player is */
  constructor(host, stage) {
    this.host = host;
    this.stage = stage;
    this.lines = draw("path", { class: "sketch" });
    const sketch = draw("svg", { "aria-hidden": "true" }, this.lines);
    this.element = make("div", { class: "grips", role: "region" }, sketch);
    /** @type {Map<string, { element: HTMLElement, told: HTMLElement, grip: Grip }>} */
    this.shown = new Map();
    /** @type {Drag | null} */
    this.drag = null;
    /** What else is drawn in the picture, on the ground. @type {(plan: Plan) => [number, number][][]} */
    this.marks = () => [];
    this.#listen();
  }

  #listen() {
    addEventListener("pointermove", (event) => {
      if (event.pointerType === "mouse" && !this.drag) this.#reveal(this.#over(event));
    });
    addEventListener("pointerdown", (event) => {
      if (event.pointerType !== "mouse" && this.#over(event)) this.linger();
    });
    addEventListener("keydown", (event) => event.key === "Escape" && this.#restore(event), true);
    this.element.addEventListener("focusin", () => this.follow());
    addEventListener("scroll", () => this.follow(), { capture: true, passive: true });
    addEventListener("resize", () => this.follow());
  }

  #leaving = 0;

  /** Show the grips for a while. */
  linger() {
    this.#reveal(true);
    clearTimeout(this.#leaving);
    this.#leaving = setTimeout(() => this.drag || this.#reveal(false), LINGER);
  }

  /** Have the focus on a grip. @param {string} id */
  take(id) {
    this.renew();
    this.shown.get(id)?.element.focus({ preventScroll: true });
  }

  /** The picture, if there is one. */
  get #canvas() {
    return this.stage.querySelector("canvas");
  }

  /** Whether a pointer is over the picture. @param {PointerEvent} event */
  #over({ target }) {
    return target instanceof Node && (target === this.#canvas || this.element.contains(target));
  }

  /** @param {boolean} on */
  #reveal(on) {
    this.element.classList.toggle("seen", on);
    if (on) this.follow();
  }

  /** Whether grips or marks are there to be seen. */
  get #seen() {
    return this.element.matches(".seen, .marked, :focus-within");
  }

  /** Have the grips where they belong in the picture, the first time and while they are seen: it may have moved. */
  follow() {
    if (this.#seen || !this.#placed) this.#place();
  }

  /** Where the picture was when grips were placed. */
  #placed = "";

  /** Show grips and marks anew, where they belong. */
  renew() {
    this.#placed = "";
    this.#place();
  }

  #place() {
    const { player } = this.host;
    const canvas = this.#canvas;
    if (!player || !canvas) return;
    const box = canvas.getBoundingClientRect();
    const { x, y, scale } = player.camera;
    const now = [x, y, scale, box.left, box.top, box.width, box.height].join();
    if (now === this.#placed) return;
    this.#placed = now;
    Object.assign(this.element.style, {
      left: `${box.left}px`,
      top: `${box.top}px`,
      width: `${box.width}px`,
      height: `${box.height}px`,
    });
    this.show(this.host.plan);
  }

  /** Show the grips of a plan. @param {Plan} plan */
  show(plan) {
    const { player } = this.host;
    this.element.ariaLabel = _("what can be dragged in the picture");
    if (!player) return;
    const { camera } = player;
    const grips = gripsOf(plan, ARM / camera.scale, this.drag?.began);
    for (const grip of grips) this.#update(grip, camera);
    const ids = new Set(grips.map(({ id }) => id));
    for (const [id, { element }] of this.shown) {
      if (ids.has(id)) continue;
      element.remove();
      this.shown.delete(id);
    }
    const chain = (/** @type {[number, number][]} */ line) =>
      `M${line.map((point) => camera.toScreen(...point).map((at) => at.toFixed(1))).join("L")}`;
    const lines = this.drag ? sketchOf(plan) : this.marks(plan);
    this.lines.setAttribute("d", lines.map(chain).join(""));
    this.element.classList.toggle("marked", lines.length > 0);
  }

  /** @param {Grip} grip @param {Player["camera"]} camera */
  #update(grip, camera) {
    const entry = this.shown.get(grip.id) ?? this.#made(grip);
    entry.grip = grip;
    const { element, told } = entry;
    const [x, y] = camera.toScreen(...grip.at);
    Object.assign(element.style, { left: `${x}px`, top: `${y}px` });
    element.classList.toggle("left", x > 0.6 * camera.width);
    const inside = x >= 0 && y >= 0 && x <= camera.width && y <= camera.height;
    element.hidden = !inside && element !== document.activeElement;
    element.ariaLabel = element.title = grip.name;
    element.ariaValueNow = String(grip.value);
    element.ariaValueText = grip.text;
    if (told.textContent !== grip.text) told.textContent = grip.text;
  }

  /** The element of a new grip. @param {Grip} grip */
  #made(grip) {
    const told = make("span", { class: "value" });
    const dot = make("span", { class: "dot" });
    const element = make("div", { role: "slider", tabindex: "0", class: `grip ${grip.kind}` });
    element.dataset.grip = grip.id;
    element.append(dot, told);
    const entry = { element, told, grip };
    element.addEventListener("pointerdown", (event) => this.#began(event, entry.grip));
    element.addEventListener("pointermove", (event) => this.#moved(event));
    element.addEventListener("pointerup", () => this.#ended());
    element.addEventListener("pointercancel", () => this.#ended());
    element.addEventListener("keydown", (event) => this.#key(event, entry.grip));
    element.addEventListener("keyup", () => this.#settle());
    element.addEventListener("blur", () => this.#settle());
    this.shown.set(grip.id, entry);
    this.element.append(element);
    return entry;
  }

  /** Where a pointer is on the ground: by the place and the camera that the picture has now, both. @param {PointerEvent} event @param {Player} player */
  #ground({ clientX, clientY }, { face, camera }) {
    const box = face.canvas.getBoundingClientRect();
    return camera.toGround(clientX - box.left, clientY - box.top);
  }

  /** @param {PointerEvent} event @param {Grip} grip */
  #began(event, grip) {
    const { player, plan } = this.host;
    if (!player || event.button !== 0 || this.drag) return;
    event.preventDefault(); // no text is selected
    const element = /** @type {HTMLElement} */ (event.currentTarget);
    element.focus({ preventScroll: true });
    element.setPointerCapture(event.pointerId);
    const [x, y] = this.#ground(event, player);
    this.drag = { grip, began: plan, from: [x - grip.at[0], y - grip.at[1]] };
    element.classList.add("held");
  }

  /** @param {PointerEvent} event */
  #moved(event) {
    const { player } = this.host;
    if (!this.drag || !player) return;
    const { grip, from } = this.drag;
    const [x, y] = this.#ground(event, player);
    this.#change(grip.moved([x - from[0], y - from[1]], event.altKey));
  }

  /** @param {Plan} plan */
  #change(plan) {
    if (JSON.stringify(plan) === JSON.stringify(this.host.plan)) return;
    this.#unsettled = true;
    this.host.change(plan, false);
  }

  /** Whether the plan was changed by what has not come to its end. */
  #unsettled = false;

  /** What was changed is one step from now on. */
  #settle() {
    if (!this.#unsettled || this.drag) return;
    this.#unsettled = false;
    this.host.change(this.host.plan, true);
  }

  #ended() {
    if (!this.drag) return;
    this.#release();
    this.#settle();
    this.show(this.host.plan);
  }

  #release() {
    this.drag = null;
    for (const { element } of this.shown.values()) element.classList.remove("held");
  }

  /** Let go, and have the plan as it was. @param {KeyboardEvent} event */
  #restore(event) {
    if (!this.drag) return;
    event.stopPropagation();
    event.preventDefault();
    const { began } = this.drag;
    this.#release();
    this.#unsettled = false;
    this.host.change(began, false);
  }

  /** @param {KeyboardEvent} event @param {Grip} grip */
  #key(event, grip) {
    const way = ARROWS[event.key];
    if (!way || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation(); // they are keys of the player as well
    const steps = event.shiftKey ? LARGER : 1;
    this.#change(grip.stepped(steps * way[0], steps * way[1]));
  }
}
