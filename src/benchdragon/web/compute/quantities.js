// What of benches is limited. Twin of QUANTITIES and given_limits of analysis/speed.py.

import { _ } from "../words.js";
import { DRIVE } from "./constants.js";

/** @typedef {"speed" | "turning_rate" | "lateral_acceleration" | "total_acceleration" | "acceleration"} QuantityName */

/**
 * What is limited: its number in the kernels, its power of the speed of a steady head, its unit, and what it
 * is called in the language in use.
 * @typedef {{ name: QuantityName, kind: number, power: number, unit: string, text: () => string }} Quantity
 */

/** In the order in which limits are told. @type {Record<QuantityName, Quantity>} */
export const QUANTITIES = {
  speed: {
    name: "speed",
    kind: DRIVE.SPEEDS,
    power: 1,
    unit: "m/s",
    text: () => _("speed of a handle"),
  },
  turning_rate: {
    name: "turning_rate",
    kind: DRIVE.TURNING,
    power: 1,
    unit: "rad/s",
    text: () => _("turning rate of a bench"),
  },
  lateral_acceleration: {
    name: "lateral_acceleration",
    kind: DRIVE.ACROSS,
    power: 2,
    unit: "m/s^2",
    text: () => _("lateral acceleration of a handle"),
  },
  total_acceleration: {
    name: "total_acceleration",
    kind: DRIVE.TOTAL,
    power: 2,
    unit: "m/s^2",
    text: () => _("total acceleration of a handle"),
  },
  acceleration: {
    name: "acceleration",
    kind: DRIVE.ALONG,
    power: 2,
    unit: "m/s^2",
    text: () => _("acceleration of a handle along the route"),
  },
};

/**
 * The plan's limits on what benches do, by the name of the quantity, in SI units.
 * @param {Record<QuantityName, number | null>} limits those of the plan
 * @returns {Partial<Record<QuantityName, number>>}
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
