// What people read, in English or Chinese: English sentences are the keys.

/** @type {Record<string, string>} */
let chinese = {};
/** @type {"en" | "zh"} */
let spoken = "en";

/** @param {Record<string, string>} table Chinese for each English sentence. */
export function useWords(table) {
  chinese = table;
}

/** @param {"en" | "zh"} language */
export function speak(language) {
  spoken = language;
  if ("document" in globalThis) document.documentElement.lang = language === "zh" ? "zh-CN" : "en";
}

/** @returns {"en" | "zh"} */
export function language() {
  return spoken;
}

/**
 * A sentence in the language in use.
 * @param {string} text
 * @param {Record<string, string | number>} [values] what stands for {name}.
 */
export function _(text, values = {}) {
  const said = spoken === "zh" ? (chinese[text] ?? text) : text;
  return said.replace(/\{(\w+)\}/g, (whole, name) => String(values[name] ?? whole));
}

/** A sentence that is only kept here, and said later. @param {string} text */
export function N_(text) {
  return text;
}

/**
 * The same words in both languages.
 * @template T
 * @param {() => T} say
 * @returns {{ en: T, zh: T }}
 */
export function both(say) {
  const before = spoken;
  try {
    const [en, zh] = /** @type {const} */ (["en", "zh"]).map((each) => {
      spoken = each;
      return say();
    });
    return { en, zh };
  } finally {
    spoken = before;
  }
}

/**
 * A number with so many decimals, and a true minus sign.
 * @param {number} value
 * @param {number} digits
 */
export function decimals(value, digits) {
  const text = value.toFixed(digits);
  return Number(text) === 0 ? (0).toFixed(digits) : text.replace("-", "\u2212");
}

/**
 * A length for people: centimetres below a metre.
 * @param {number} metres
 */
export function shortLength(metres) {
  return metres < 1 ? `${decimals(100 * metres, 1)} cm` : `${decimals(metres, 2)} m`;
}
