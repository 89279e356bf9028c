// What the permit annex calls its numbers, and how it lays them out.

import { decimalsTowards, general } from "./compute/number_format.js";
import { make, table as tableOf } from "./elements.js";
import { shown } from "./made/answer.js";
import { known, outward } from "./made/number_format.js";
import { N_, _, language } from "./words.js";

/** @typedef {import("./compute/annex.js").Told} Told */
/** What stands in a cell: a text, or null for a blank to be filled in. @typedef {string | null} Cell */

/** Figures about people, by their keys in the plan, and which of them are speeds. @type {Record<string, string>} */
export const PEOPLE = {
  beside: N_("room for bearers on each side of a bench"),
  ahead: N_("free room before the head's bench"),
  sway: N_("sway of benches to a side"),
  imprecision: N_("how far bearers stray"),
  steering: N_("how fast bearers steer back to the line"),
  step: N_("length of a step"),
  hurry_from: N_("speed from which one hurries"),
  run_from: N_("speed from which one runs"),
  most_speed: N_("greatest speed with a bench"),
};
/** Units of those that are no lengths. @type {Record<string, string>} */
const UNITS = { steering: "1/m", hurry_from: "m/s", run_from: "m/s", most_speed: "m/s" };
/** @type {Record<string, string>} */
const STATUS = {
  proved: N_("proved"),
  found: N_("found"),
  infeasible: N_("no solution"),
  undecided: N_("undecided"),
  unlimited: N_("unlimited"),
};
/** Reasons for posts; of some the number is a speed, which is rounded up. @type {Record<string, string>} */
const WHY = {
  venue: N_("benches nearest to the venue's edge: at least {value} m"),
  entrance: N_("entrance"),
  tightest: N_("benches nearest to one another: at least {value} m at {time}"),
  fastest: N_("fastest handle: {value} m/s at {time}"),
  run: N_("handles run: up to {value} m/s at {time}"),
  line: N_("along the line"),
};
const FASTEST = ["fastest", "run"];
/** @type {Record<string, string>} */
export const DEVIATIONS = {
  aside: N_("handles beside the line that is walked"),
  stray: N_("that line beside the route"),
  play: N_("pin play"),
  height: N_("heights of handles"),
  length: N_("lengths of benches"),
  width: N_("widths of benches"),
};

/** A length with two decimals, rounded up where less would not be true. @param {number} value @param {boolean} [up] */
export function metres(value, up = false) {
  return `${up ? decimalsTowards(value, 2, true) : value.toFixed(2)} m`;
}

/** What an answer surely is, its bracket, how it was established, and what was asked for. @param {Told} told @returns {Cell[]} */
export function answerRow({ name, found, asked, up }) {
  const limit = asked == null ? "–" : `${general(asked)} ${found.unit}`;
  const said = name[language()];
  if (!Number.isFinite(found.value))
    return [said, _("no pair counts"), "–", _(STATUS[found.status]), limit];
  const own = /** @type {any} */ (found);
  const sure = `${shown(own, up, asked)} ${found.unit}`;
  const bracket = outward(Number(found.lower), Number(found.upper));
  return [said, sure, bracket, _(STATUS[found.status]), limit];
}

/** Why there is a post. @param {{ why: string, value: number, time: number }} reason @param {import("./made/clock.js").Clock} clock */
export function reasonText({ why, value, time }, clock) {
  const values = {
    value: Number.isNaN(value) ? "" : known(value, value, "m", FASTEST.includes(why)),
    time: Number.isNaN(time) ? "" : clock.tell(time),
  };
  return _(WHY[why], values);
}

/** What a level of room adds, and where that comes from. @param {Array<{ key: string, value: number, source: string }>} asked */
export function askedText(asked) {
  const told = asked.map(({ key, value, source: said }) => {
    const source = said || _("assumption");
    const what = _(PEOPLE[key]);
    return _("{what} {value} m ({source})", { what, value: general(value), source });
  });
  return told.join(_("; ")) || "–";
}

/** Figures about people with their sources. @param {Record<string, any>} people @returns {Cell[][]} */
export function sourceRows(people) {
  return Object.keys(PEOPLE)
    .filter((key) => people[key])
    .map((key) => {
      const value = `${general(people[key])} ${UNITS[key] ?? "m"}`;
      return [_(PEOPLE[key]), value, people.source[key] || _("assumption")];
    });
}

/** A blank to be filled in by hand. */
export function blank() {
  return make("span", { class: "blank" });
}

/** A heading with what stands below it. @param {string} name @param {(Node | string)[]} content */
export function chapter(name, ...content) {
  return make("section", {}, make("h3", {}, name), ...content.map(block));
}

/** @param {Node | string} one */
function block(one) {
  return typeof one === "string" ? make("p", {}, one) : one;
}

/** A table with a head; cells that are not known are blanks. @param {string} name @param {string[]} heads @param {Cell[][]} rows @param {string} [kind] */
export function table(name, heads, rows, kind = "") {
  const filled = rows.map(([first, ...others]) => [
    first ?? "",
    ...others.map((text) => text ?? blank()),
  ]);
  return tableOf(heads, filled, { kind, name, named: true });
}
