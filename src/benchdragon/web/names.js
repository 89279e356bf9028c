// What files of a dance are called: after the dance and how many benches dance it.

import { language } from "./words.js";

/** @typedef {import("./plan_form.js").Plan} Plan */

/** Letters that a title leaves to a file's name: with the rest, under any system's 255 bytes. */
const MOST_LETTERS = 60;

/**
 * A name for files, without what file systems or command lines take for something else.
 * @param {string} en what the dance is called, if it is
 * @param {string} zh the same in Chinese
 * @param {number} benches
 */
export function fileName(en, zh, benches) {
  const told = language() === "zh" ? zh || en : en || zh;
  const words = (told || "dance").normalize("NFC").match(/[\p{L}\p{M}\p{N}]+/gu) ?? ["dance"];
  const name = Array.from(words.join("-")).slice(0, MOST_LETTERS).join("");
  return `${name}-${benches}`;
}

/** The name for files of a plan. @param {Plan} plan */
export function planName({ meta, dragon }) {
  /** @type {{ count?: number }[]} */
  const own = dragon.bench?.length ? dragon.bench : [{ count: dragon.benches }];
  const benches = own.reduce((sum, { count = 1 }) => sum + count, 0);
  return fileName(meta.title, meta.title_zh, benches);
}
