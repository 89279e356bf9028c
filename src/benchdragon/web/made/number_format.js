// @ts-nocheck
// Made from number_format.py by tools/make_twins.py; to make it again: make generate

import { decimals, decimalsTowards } from "../compute/number_format.js";
import { py } from "../compute/python.js";

const TIME_DECIMALS = 2;
const DECIMALS = 3;
const SMALL_DECIMALS = 6;
const MOST_DECIMALS = 15;
const DUST = 1e-06;
const BESIDE = 1e-09;
export function outward(low, high, count = 4) {
  let highest, lowest;
  [lowest, highest] = py.list([decimalsTowards(low, count, false), decimalsTowards(high, count, true)]);
  return `${py.str(lowest)}..${py.str(highest)}`;
}
export function known(low, high, unit, up, limit = /** @type {any} */ (null)) {
  let count, least, text, value;
  value = (py.truth(up) ? high : low);
  if (!py.isfinite(value)) {
    return "-";
  }
  if ((py.eq(low, high) && (high === 0.0))) {
    return "0";
  }
  count = ((unit === "s") ? TIME_DECIMALS : DECIMALS);
  while ((py.truth(count) && (py.sub(high, low) > (10.0 ** -count)))) {
    count = (count - 1);
  }
  least = (10.0 ** (1 - count));
  while (((unit !== "s") && ((0.0 < value) && (value < least)) && (py.sub(high, low) <= (0.1 * least)) && (count < SMALL_DECIMALS))) {
    [count, least] = py.list([(count + 1), (0.1 * least)]);
  }
  text = _cut(value, count, up);
  if (((limit == null) || (py.abs(py.sub(value, limit)) <= BESIDE))) {
    return text;
  }
  while (((count < MOST_DECIMALS) && ((py.sub(py.float(text), limit) * py.sub(value, limit)) < 0.0))) {
    count = py.extend(count, 1);
    text = _cut(value, count, up);
  }
  return text;
}
function _cut(value, count, up) {
  let scale, whole;
  scale = (10.0 ** count);
  whole = (py.truth(up) ? py.ceil(py.sub((value * scale), DUST)) : py.floor(py.add((value * scale), DUST)));
  return decimals((whole / scale), count);
}
export function seconds(time) {
  return known(time, time, "s", false);
}
export function atMost(value) {
  let digit, power, text;
  text = `${py.format(value, `.1e`)}`;
  if ((py.float(text) >= value)) {
    return text;
  }
  [digit, power] = py.list(py.split(text, "e"));
  return `${py.format(py.float(`${py.format((py.float(digit) + 0.1), `.1f`)}e${py.str(power)}`), `.1e`)}`;
}
export function finiteOrNone(value) {
  return (py.isfinite(value) ? value : null);
}
export function roundedUp(metres) {
  return `${py.format((py.ceil(((100.0 * metres) + 0.2)) / 100.0), `.2f`)}`;
}
