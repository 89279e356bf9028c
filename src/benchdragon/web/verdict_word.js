// A verdict in a word, and one short fact: what stands in a fixed place above the picture.

import { make } from "./elements.js";
import { N_, _, decimals, language } from "./words.js";

/** @typedef {import("./messages").Verdict} Verdict */
/** @typedef {import("./telling.js").State} State */

/** What touches, of all kinds of findings; and what is only too fast. */
export const TOUCHES = ["contact", "obstacle"];
const FAST = /speed|acceleration|turning_rate/;
/** States that have a verdict, the best first. @type {State[]} */
const STATES = ["safe", "open", "tight", "unsafe"];

/** What was not looked at, in few words. @type {Record<string, string>} */
const NOT_CHECKED = {
  street: N_("walls and houses along the route"),
  square: N_("the square"),
  venue: N_("the edge of the square"),
  people: N_("room for people"),
  speed: N_("limits of speed"),
};

/** What was not looked at. @param {Verdict} found */
export function notChecked({ not_looked_at: open }) {
  return open.map(({ kind, text }) => (kind in NOT_CHECKED ? _(NOT_CHECKED[kind]) : text[language()]));
}

/** How much was not looked at, where a dance is said to be safe. @param {Verdict} found */
export function markText({ safe, not_looked_at: open }) {
  return safe && open.length ? _("{count} not checked", { count: open.length }) : "";
}

/** @param {Verdict} found @returns {State} */
export function stateOf({ safe, decided, findings }) {
  if (safe) return "safe";
  if (!decided) return "open";
  return findings.some((one) => one.decided && TOUCHES.includes(one.kind)) ? "unsafe" : "tight";
}

/** How bad a verdict is: 0 where the dance is safe. @param {Verdict} found */
export function badness(found) {
  return STATES.indexOf(stateOf(found));
}

/** @param {Verdict} found */
export function wordOf(found) {
  const state = stateOf(found);
  if (state === "safe") return _("fits");
  if (state === "open") return _("not decided");
  if (state === "unsafe") return _("touches");
  const decided = found.findings.filter((one) => one.decided);
  return decided.every(({ kind }) => FAST.test(kind)) ? _("too fast") : _("too tight");
}

/** How near benches come to one another, rounded down; "" where none do or they touch. @param {Verdict} found */
export function nearestText({ clearance }) {
  const least = clearance?.lower;
  if (!least || least <= 0) return "";
  const centimetres = Math.floor(100 * least + 1e-9);
  if (!centimetres) return _("benches less than {gap} m apart", { gap: "0.01" });
  return _("benches are {gap} m apart at the nearest", { gap: decimals(centimetres / 100, 2) });
}

/** What touches first. @param {Verdict} found */
function touchText({ findings, obstacles }) {
  const first = findings.find((one) => one.decided && TOUCHES.includes(one.kind));
  const [a, b] = first?.benches ?? [0, 0];
  const name = obstacles.find((one) => one.name === first?.obstacle)?.shown[language()];
  return name ? _("bench {bench}, {name}", { bench: a, name }) : _("benches {a} and {b}", { a, b });
}

/** What stands beside the word: what was not looked at, and on wide screens one fact. @param {Verdict} found */
export function besideWord(found) {
  const fact = stateOf(found) === "unsafe" ? touchText(found) : nearestText(found);
  const mark = make("span", { class: "unchecked" }, markText(found));
  return [...(mark.textContent ? [mark] : []), make("span", { class: "fact" }, fact)];
}
