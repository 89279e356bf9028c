// Numbers as sentences hold them: twin of Python's formats.

/** As `f"{value:g}"`, with so many significant figures. @param {number} value @param {number} [figures] */
export function general(value, figures = 6) {
  if (!Number.isFinite(value)) return pythonFloat(value);
  if (value === 0) return Object.is(value, -0) ? "-0" : "0";
  const [digits, exponent] = value.toExponential(figures - 1).split("e");
  const power = Number(exponent);
  if (power < -4 || power >= figures) return `${trimmed(digits)}e${signed(power)}`;
  return trimmed(value.toFixed(Math.max(figures - 1 - power, 0)));
}

/** As `repr(value)` of a float. @param {number} value */
export function pythonFloat(value) {
  if (Number.isNaN(value)) return "nan";
  if (!Number.isFinite(value)) return value > 0 ? "inf" : "-inf";
  if (Object.is(value, -0)) return "-0.0";
  const [digits, exponent] = value.toExponential().split("e");
  const power = Number(exponent);
  if (value !== 0 && (power < -4 || power >= 16)) return `${digits}e${signed(power)}`;
  const text = spelled(digits, power);
  return text.includes(".") ? text : `${text}.0`;
}

/** Digits such as 1.25 times a power of ten, without an exponent. @param {string} digits @param {number} power */
function spelled(digits, power) {
  const sign = digits.startsWith("-") ? "-" : "";
  const bare = digits.replace("-", "").replace(".", "");
  if (power < 0) return `${sign}0.${"0".repeat(-power - 1)}${bare}`;
  const whole = bare.slice(0, power + 1).padEnd(power + 1, "0");
  const rest = bare.slice(power + 1);
  return `${sign}${whole}${rest && `.${rest}`}`;
}

/** @param {string} digits */
function trimmed(digits) {
  return digits.includes(".") ? digits.replace(/\.?0+$/, "") : digits;
}

/** @param {number} power */
function signed(power) {
  return `${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(2, "0")}`;
}
