// The leader's table: who carries each bench, where it starts, what comes nearest; on paper and as a file.

import { make } from "./elements.js";
import { BENCH_NEARNESS } from "./compute/constants.js";
import { decimals, general } from "./compute/number_format.js";
import { Sayings } from "./sayings.js";
import { SheetMaps, readable } from "./sheet_map.js";
import { _, language } from "./words.js";

/** @typedef {import("./compute/briefing.js").Briefing} Briefing */
/** @typedef {import("./name_list.js").NameList} NameList */
/** @typedef {import("./sheets.js").Built} Built */
/** @typedef {import("./sheets.js").Looks} Looks */

// Tightest moments that are listed, of different benches, and how far apart they are at least, m:
// MOST_TIGHT and TIGHT_APART of sheets/overview.py.
const [MOST_TIGHT, TIGHT_APART] = [3, 3];
// The columns of what a bench does and of who comes nearest, and what stands there for nobody.
const [WHAT, TIGHTEST, NONE] = [3, 4, "-"];
const { REACH } = BENCH_NEARNESS;
// What a spreadsheet takes for a formula.
const FORMULA = /^[=+\-@\t\r]/;
const NUMBER = /^-?\d+(\.\d+)?$/;

/** What stands above the columns. */
function headings() {
  return [
    _("bench"),
    _("people"),
    _("starts from the peg: x, y (m)"),
    _("what it does"),
    _("tightest"),
  ];
}

/** A row for each bench. @param {Sayings} said @param {boolean} phones */
function rowsOf(said, phones) {
  const { ground } = said;
  const { benches } = said.briefing;
  return benches.map(({ bench, place, tightest }) => ({
    bench: said.called(bench),
    people: said.remarked(bench, phones),
    place: ground.seen_at(place).map((/** @type {number} */ far) => decimals(far, 2)),
    quick: said.text(bench, (other) => said.called(other)).quick,
    tightest: tightest ? said.tightest(bench) : NONE,
  }));
}

/** The tightest moments, each told of one bench. @param {Sayings} said */
function tightestLines(said) {
  const found = said.briefing.benches.flatMap(({ bench, tightest }) =>
    tightest ? [{ ...tightest, bench, other: tightest.bench }] : [],
  );
  found.sort((a, b) => a.upper - b.upper || a.bench - b.bench);
  const told = new Set();
  /** @type {Array<[number, number]>} */
  const places = [];
  return found.flatMap(({ bench, other, place: [x, y] }) => {
    if (places.length >= MOST_TIGHT || told.has(bench) || told.has(other)) return [];
    if (places.some((one) => Math.hypot(x - one[0], y - one[1]) < TIGHT_APART)) return [];
    told.add(bench).add(other);
    places.push([x, y]);
    return [_("{bench}: {tightest}", { bench: said.called(bench), tightest: said.tightest(bench) })];
  });
}

/** The table and what stands above it. @param {Briefing} briefing @param {NameList} names @param {Looks} looks @returns {Built} */
export function overviewSheet(briefing, { people: carriers, notes }, { phones, date, foot }) {
  const said = new Sayings(briefing, carriers);
  const maps = new SheetMaps(briefing, "a4");
  const { title, verdict, people } = briefing;
  const tight = tightestLines(said);
  const rows = rowsOf(said, phones);
  const alike = rows.length > 1 && rows.every(({ quick }) => quick === rows[0].quick);
  const starts = maps.starts((bench) => said.called(bench));
  const sheet = make(
    "article",
    { class: "overview" },
    make("h2", {}, title[language()] || _("Overview")),
    make("p", {}, verdict[language()]),
    make("p", {}, said.basis.clock.legend),
    make("p", {}, checkedLine(said, date)),
    ...(people.count_head
      ? []
      : [make("p", {}, _("In the verdict bench 1 is the head's, bench 2 the next."))]),
    ...listOf(_("Tightest moments between coils"), tight),
    ...listOf(_("Notes on the list of names"), notes),
    make("h3", {}, _("Where each bench starts")),
    make("p", {}, said.ground.legend),
    starts,
    make("h3", {}, _("Benches")),
    ...(alike ? [make("p", {}, _("All benches: {what}", { what: rows[0].quick }))] : []),
    ...dashLine(rows),
    tableOf(rows, alike),
    make("footer", {}, foot),
  );
  return { pages: [maps.shared(), sheet], settle: async () => readable(starts) };
}

/** What a dash in the last column means, where only some benches have one. @param {ReturnType<typeof rowsOf>} rows */
function dashLine(rows) {
  const near = rows.filter(({ tightest }) => tightest !== NONE);
  if (!near.length || near.length === rows.length) return [];
  const values = { dash: NONE, reach: general(REACH) };
  return [
    make("p", {}, _("{dash}: no bench of another coil comes within about {reach} m of it.", values)),
  ];
}

/** The table; what all benches do alike stands above it. @param {ReturnType<typeof rowsOf>} rows @param {boolean} alike */
function tableOf(rows, alike) {
  const near = rows.some(({ tightest }) => tightest !== NONE);
  const kept = (/** @type {string[]} */ cells) =>
    cells.filter((_cell, n) => !(alike && n === WHAT) && (near || n !== TIGHTEST));
  const body = rows.map(({ bench, people, place, quick, tightest }) => {
    const names = people.join(_(", ")) || _("(nobody)");
    const [head, ...cells] = kept([bench, names, place.join(", "), quick, tightest]);
    return make(
      "tr",
      {},
      make("th", { scope: "row" }, head),
      ...cells.map((text) => make("td", {}, text)),
    );
  });
  const heads = kept(headings()).map((text) => make("th", { scope: "col" }, text));
  return make(
    "table",
    alike ? { class: "alike" } : {},
    make("thead", {}, make("tr", {}, ...heads)),
    make("tbody", {}, ...body),
  );
}

/** When it was checked, and how many benches and people there are: who is named at several counts once. @param {Sayings} said @param {string} date */
function checkedLine({ briefing, people }, date) {
  const everybody = [...people.values()].flat();
  const persons = everybody.map((one) => [one.name, one.household, one.phone].join("\0"));
  return _("Checked on {date}; {benches} benches, {people} people in the list of names.", {
    date,
    benches: briefing.benches.length,
    people: new Set(persons).size,
  });
}

/** @param {string} name @param {string[]} lines */
function listOf(name, lines) {
  if (!lines.length) return [];
  return [make("h3", {}, name), ...lines.map((line) => make("p", {}, line))];
}

/** The table as a file for spreadsheets: commas, and the mark by which they know UTF-8. @param {Briefing} briefing @param {NameList} names @param {Looks} looks */
export function overviewTable(briefing, { people }, { phones }) {
  const said = new Sayings(briefing, people);
  const [bench, carriers, , does, tightest] = headings();
  const rows = rowsOf(said, phones).map((row) => [
    row.bench, row.people.join(_(", ")), ...row.place, row.quick, row.tightest === NONE ? "" : row.tightest,
  ]); // prettier-ignore
  const whole = [[bench, carriers, "x (m)", "y (m)", does, tightest], ...rows];
  const text = whole.map((row) => `${row.map(cell).join(",")}\r\n`).join("");
  return new Blob([`\ufeff${text}`], { type: "text/csv" });
}

/** @param {string} text */
function cell(text) {
  const plain = FORMULA.test(text) && !NUMBER.test(text) ? `'${text}` : text;
  return `"${plain.replaceAll('"', '""')}"`;
}
