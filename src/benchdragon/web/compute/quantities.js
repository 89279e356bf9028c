// What of benches is limited. Twin of QUANTITIES and given_limits of analysis/speed.py.

import { _ } from "../words.js";
import { DRIVE } from "./constants.js";

/** @typedef {"speed" | "turning_rate" | "lateral_acceleration" | "total_acceleration" | "acceleration"} QuantityName */

/**
 * What is limited: its number in the kernels, its power of the speed of a steady head, its unit, and what it
 * is called in the language in use.
 * @typedef {{ name: QuantityName, kind: number, power: number, unit: string, text: () => string }} Quantity
 */

/** @type {Array<[QuantityName, number, number, string, () => string]>} */
const TOLD = [
  ["speed", DRIVE.SPEEDS, 1, "m/s", () => _("speed of a handle")],
  ["turning_rate", DRIVE.TURNING, 1, "rad/s", () => _("turning rate of a bench")],
  ["lateral_acceleration", DRIVE.ACROSS, 2, "m/s^2", () => _("lateral acceleration of a handle")],
  ["total_acceleration", DRIVE.TOTAL, 2, "m/s^2", () => _("total acceleration of a handle")],
  ["acceleration", DRIVE.ALONG, 2, "m/s^2", () => _("acceleration of a handle along the route")],
];

/** In the order in which limits are told, and of their numbers. */
export const QUANTITIES = /** @type {Record<QuantityName, Quantity>} */ (
  Object.fromEntries(
    TOLD.map(([name, kind, power, unit, text]) => [name, { name, kind, power, unit, text }]),
  )
);

/**
 * The plan's limits on what benches do, by the name of the quantity, in SI units.
 * @param {Record<QuantityName, number | null>} limits those of the plan
 */
export function givenLimits(limits) {
  /** @type {Partial<Record<QuantityName, number>>} */
  const given = {};
  for (const { name } of Object.values(QUANTITIES)) {
    const limit = limits[name] ?? null;
    if (limit !== null) given[name] = name === "turning_rate" ? limit * (Math.PI / 180) : limit;
  }
  return given;
}
