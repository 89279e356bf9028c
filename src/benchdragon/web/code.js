// QR codes, drawn.

import { encode } from "./carried_code.js";
import { draw } from "./elements.js";

/** White squares about a code. */
const QUIET = 4;

/**
 * The dark squares of a QR code as a path, and how many squares it has on a side; null where the text is too
 * long for the largest kind that is wanted.
 * @param {string} text
 * @param {"L" | "M"} least how much of it may be hidden at least
 * @param {number} maxVersion the largest kind
 */
export function codePath(text, least, maxVersion) {
  let found;
  try {
    found = encode(text, { ecc: least, boostEcc: true, maxVersion, border: QUIET });
  } catch (error) {
    if (error instanceof RangeError) return null;
    throw error;
  }
  const { size, data } = found;
  const squares = data.flatMap((row, y) => row.map((dark, x) => (dark ? `M${x} ${y}h1v1h-1z` : "")));
  return { size, path: squares.join("") };
}

/**
 * A QR code; null where the text is too long.
 * @param {string} text @param {"L" | "M"} least @param {number} maxVersion see codePath
 * @param {string} name for those who cannot see it
 */
export function drawnCode(text, least, maxVersion, name) {
  const found = codePath(text, least, maxVersion);
  if (!found) return null;
  const { size, path } = found;
  const about = { viewBox: `0 0 ${size} ${size}`, class: "code", role: "img", "aria-label": name };
  return draw("svg", about, draw("path", { d: path }));
}
