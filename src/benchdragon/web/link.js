// A plan in an address: what it changes in a preset, as short as browsers make it, with a checksum.

import { sha256 } from "./compute/sha256.js";
import { isTable, planOf, planText } from "./plan_form.js";

/** @typedef {import("./messages").Preset} Preset */
/** @typedef {import("./plan_form.js").Plan} Plan */

/** Bytes of the checksum, which stand first: presets of another version of the page may be other plans. */
const SUM = 4;
/** What a link may unfold to, bytes; and bytes of it that are unfolded at a time. */
const MOST_BYTES = 4_000_000;
const PIECE = 1024;

/** Links of plans. @type {WeakMap<Plan, Promise<string>>} */
const links = new WeakMap();

/** A plan as text for an address. @param {Plan} plan @param {Preset[]} presets */
export function linkText(plan, presets) {
  const known = links.get(plan);
  if (known) return known;
  const made = packed(plan, presets);
  links.set(plan, made);
  return made;
}

/** @param {Plan} plan @param {Preset[]} presets */
async function packed(plan, presets) {
  const text = planText(plan);
  const told = [
    ["", {}],
    ...presets.map(({ name, plan: preset }) => [name, tabled(planText(preset))]),
  ].map(([name, from]) => JSON.stringify([name, changes(from, tabled(text))]));
  const shortest = told.reduce((one, other) => (other.length < one.length ? other : one));
  const stream = new Blob([shortest]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  const bytes = [...sumOf(text), ...new Uint8Array(await new Response(stream).arrayBuffer())];
  return btoa(bytes.map((byte) => String.fromCharCode(byte)).join(""))
    .replaceAll("+", "-")
    .replaceAll("/", "_")
    .replaceAll("=", "");
}

/** @param {string} text */
const tabled = (text) => JSON.parse(text);

/** The checksum of a plan's text. @param {string} text */
function sumOf(text) {
  const digits = sha256(text);
  return Array.from({ length: SUM }, (_unused, n) =>
    Number.parseInt(digits.slice(2 * n, 2 * n + 2), 16),
  );
}

/** What of a table is other in another, whole lists among it; null: it is not there (RFC 7396). @param {Record<string, any>} from @param {Record<string, any>} to @returns {Record<string, any>} */
function changes(from, to) {
  const found = Object.keys(from)
    .filter((key) => !Object.hasOwn(to, key))
    .map((key) => [key, null]);
  for (const [key, value] of Object.entries(to)) {
    const before = Object.hasOwn(from, key) ? from[key] : undefined;
    if (JSON.stringify(before) === JSON.stringify(value)) continue;
    found.push([key, isTable(before) && isTable(value) ? changes(before, value) : value]);
  }
  return Object.fromEntries(found);
}

/** A table with such changes. @param {unknown} from @param {unknown} patch @returns {unknown} */
function changed(from, patch) {
  if (!isTable(patch)) return patch;
  const found = new Map(isTable(from) ? Object.entries(from) : []);
  for (const [key, value] of Object.entries(patch)) {
    if (value === null) found.delete(key);
    else found.set(key, changed(found.get(key), value));
  }
  return Object.fromEntries(found);
}

/**
 * What such a text holds: the plan, or null; and what it says, as far as it is whole.
 * @param {string} text
 * @param {Preset[]} presets
 * @returns {Promise<{ plan: Plan | null, says: string }>}
 */
export async function readLink(text, presets) {
  const bytes = bytesOf(text);
  if (!bytes) return { plan: null, says: text };
  const { says, whole } = await unfolded(bytes.subarray(SUM));
  const plan = whole ? planIn(says, bytes.subarray(0, SUM), presets) : null;
  return { plan, says: says || text };
}

/** @param {string} text it may have been cut anywhere @returns {Uint8Array | null} */
function bytesOf(text) {
  const whole = text.length % 4 === 1 ? text.slice(0, -1) : text;
  try {
    return Uint8Array.from(atob(whole.replaceAll("-", "+").replaceAll("_", "/")), (sign) =>
      sign.charCodeAt(0),
    );
  } catch (error) {
    if (error instanceof DOMException) return null;
    throw error;
  }
}

/** The text in bytes, as far as it can be told, and whether that is all of it. @param {Uint8Array} bytes */
async function unfolded(bytes) {
  let at = 0;
  // A few at a time: a link of some kilobytes may unfold to gigabytes.
  const pieces = new ReadableStream({
    pull(controller) {
      if (at >= bytes.length) return controller.close();
      controller.enqueue(bytes.slice(at, (at += PIECE)));
    },
  });
  const reader = pieces.pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  const decoder = new TextDecoder();
  let [says, size] = ["", 0];
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) return { says, whole: true };
      size += value.length;
      if (size > MOST_BYTES) break;
      says += decoder.decode(value, { stream: true });
    }
    await reader.cancel();
  } catch (error) {
    if (!(error instanceof TypeError)) throw error; // which says that the bytes are damaged
  }
  return { says, whole: false };
}

/** @param {string} says @param {Uint8Array} sum @param {Preset[]} presets */
function planIn(says, sum, presets) {
  try {
    const [name, patch] = JSON.parse(says);
    const preset = presets.find((one) => one.name === name);
    if (name && !preset) return null;
    const data = changed(preset ? tabled(planText(preset.plan)) : {}, patch);
    const text = planText(/** @type {Plan} */ (data));
    return sumOf(text).every((byte, n) => byte === sum[n]) ? planOf(data) : null;
  } catch (error) {
    // No JSON, no list, or tables in tables without end.
    if ([SyntaxError, TypeError, RangeError].some((kind) => error instanceof kind)) return null;
    throw error;
  }
}
