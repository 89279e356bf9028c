// What colours mean: speed, clearance or acceleration of a bench.

import { _, decimals } from "./words.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./scene.js").Stand} Stand */
/** @typedef {import("./nearness.js").Boxes} Boxes */

/**
 * What a colour stands for.
 * @typedef {object} Scale
 * @property {string} name
 * @property {number} low
 * @property {number} high
 * @property {string} unit
 * @property {string[]} colours from low to high
 * @property {(bench: number) => number} value
 */

/** Seen alike by colour-blind people: cividis, and a line from dark orange over white to blue. */
const EVEN = ["#00204c", "#213d6b", "#555b6c", "#7b7a77", "#a59c74", "#d3c064", "#ffe945"];
const SIGNED = ["#a6480a", "#d98a4a", "#f2d4bb", "#f7f7f7", "#bcd5ea", "#5a9bd0", "#14518f"];
const NEAR = ["#b2182b", "#ef8a62", "#fddbc7", "#d1e5f0", "#67a9cf", "#2166ac"];

export const TOUCH = "#e6004c";
const STEPS = 48;

export const KINDS = /** @type {const} */ (["plain", "speed", "clearance", "acceleration"]);
/** @typedef {typeof KINDS[number]} Kind */

/** @param {Kind} kind */
export function kindName(kind) {
  return {
    plain: _("none"),
    speed: _("speed"),
    clearance: _("clearance"),
    acceleration: _("acceleration"),
  }[kind];
}

/**
 * The scale of a kind for a scene; null for plain benches.
 * @param {Kind} kind
 * @param {Scene} scene
 * @param {Stand} stand
 * @param {Boxes} boxes
 * @returns {Scale | null}
 */
export function scaleOf(kind, scene, stand, boxes) {
  if (kind === "speed") {
    const [low, high] = roundRange(...scene.speedRange);
    return {
      name: _("speed of the front handle"),
      low,
      high,
      unit: "m/s",
      colours: EVEN,
      value: (i) => stand.v[i],
    };
  }
  if (kind === "acceleration") {
    const most = roundUp(scene.greatestChange);
    const name = _("change of speed of the front handle");
    return { name, low: -most, high: most, unit: "m/s²", colours: SIGNED, value: (i) => stand.a[i] };
  }
  if (kind === "clearance") {
    const high = scene.sent.nearest.reach;
    return {
      name: _("clearance to the nearest bench"),
      low: 0,
      high,
      unit: "m",
      colours: NEAR,
      value: (i) => boxes.nearest[i],
    };
  }
  return null;
}

/** A range of at least a hundredth with round ends. @param {number} low @param {number} high @returns {[number, number]} */
function roundRange(low, high) {
  const middle = 0.5 * (low + high);
  const half = Math.max(0.5 * (high - low), 0.005);
  const unit = 10 ** Math.floor(Math.log10(half));
  return [
    Math.max(Math.floor((middle - half) / unit) * unit, 0),
    Math.ceil((middle + half) / unit) * unit,
  ];
}

/** @param {number} value */
function roundUp(value) {
  const most = Math.max(value, 0.01);
  const unit = 10 ** Math.floor(Math.log10(most));
  return Math.ceil(most / unit - 1e-9) * unit;
}

/** Number of the colour of a value, 0..STEPS - 1. @param {Scale} scale @param {number} value */
export function shade(scale, value) {
  const share = (value - scale.low) / (scale.high - scale.low);
  return Math.round(Math.min(Math.max(share, 0), 1) * (STEPS - 1));
}

/** All colours of a scale. @param {Scale} scale */
export function shades(scale) {
  return Array.from({ length: STEPS }, (_unused, n) => mixed(scale.colours, n / (STEPS - 1)));
}

/** @param {string[]} colours @param {number} share */
function mixed(colours, share) {
  const along = share * (colours.length - 1);
  const first = Math.min(Math.floor(along), colours.length - 2);
  const [a, b] = [colours[first], colours[first + 1]].map((colour) =>
    [1, 3, 5].map((at) => Number.parseInt(colour.slice(at, at + 2), 16)),
  );
  return `rgb(${a.map((part, n) => Math.round(part + (along - first) * (b[n] - part))).join(" ")})`;
}

/** The ends of a scale in words. @param {Scale} scale @returns {[string, string]} */
export function endTexts(scale) {
  const digits = Math.max(0, 1 - Math.floor(Math.log10(scale.high - scale.low)));
  return [decimals(scale.low, digits), `${decimals(scale.high, digits)} ${scale.unit}`];
}
