// Taps of several fingers on the picture: two undo, three redo; and what else fingers and keys do here.

import { _ } from "./words.js";

/** Fingers that stay so near, CSS pixels, and so short, ms, tap. */
const NEAR = 12;
const SHORT = 400;

/**
 * Hear taps of two and three fingers.
 * @param {HTMLElement} element in which the picture is
 * @param {(fingers: number) => void} tapped
 */
export function onFingerTaps(element, tapped) {
  /** @type {Map<number, { x: number, y: number }>} */
  const down = new Map();
  let [fingers, since, still] = [0, 0, true];
  const touches = (/** @type {PointerEvent} */ event) =>
    event.pointerType === "touch" && event.target instanceof HTMLCanvasElement;
  element.addEventListener("pointerdown", (event) => {
    if (!touches(event)) return;
    if (!down.size) [fingers, since, still] = [0, event.timeStamp, true];
    down.set(event.pointerId, { x: event.clientX, y: event.clientY });
    fingers = Math.max(fingers, down.size);
  });
  element.addEventListener("pointermove", (event) => {
    const began = down.get(event.pointerId);
    if (began && Math.hypot(event.clientX - began.x, event.clientY - began.y) > NEAR) still = false;
  });
  const up = (/** @type {PointerEvent} */ event) => {
    if (!down.delete(event.pointerId) || down.size) return;
    const whole = event.type === "pointerup" && event.timeStamp - since <= SHORT;
    if (whole && still && fingers > 1) tapped(fingers);
  };
  element.addEventListener("pointerup", up);
  element.addEventListener("pointercancel", up);
}

/** What keys and fingers do on this page, beside what they do to the player. @returns {[string, string][]} */
export function helpRows() {
  return [
    [_("Ctrl Z, two fingers tap"), _("undo")],
    [_("Ctrl Y, three fingers tap"), _("redo")],
    [_("drag a grip in the picture"), _("change the plan; Alt: without round values; Esc: as it was")],
    [_("arrows on a grip"), _("change the plan step by step; Shift: ten steps")],
  ];
}
