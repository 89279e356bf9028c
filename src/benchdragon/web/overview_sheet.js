// The leader's table: who carries each bench, where it starts, what comes nearest; on paper and as a file.

import { make, table } from "./elements.js";
import { BENCH_NEARNESS } from "./compute/constants.js";
import { csvFile } from "./csv.js";
import { decimals, general } from "./compute/number_format.js";
import { Sayings } from "./sayings.js";
import { SheetMaps, readable } from "./sheet_map.js";
import { _, language } from "./words.js";

/** @typedef {import("./compute/briefing.js").Briefing} Briefing */
/** @typedef {import("./name_list.js").NameList} NameList */
/** @typedef {import("./sheets.js").Built} Built */
/** @typedef {import("./sheets.js").Looks} Looks */

// The columns of what a bench does and of who comes nearest, and what stands there for nobody.
const [WHAT, TIGHTEST, NONE] = [3, 4, "-"];
const { REACH } = BENCH_NEARNESS;

/** What stands above the columns. */
function headings() {
  return [_("bench"), _("people"), _("where it starts"), _("what it does"), _("tightest")];
}

/** A row for each bench. @param {Sayings} said @param {boolean} phones */
function rowsOf(said, phones) {
  const { benches, overview } = said.briefing;
  return benches.map(({ bench, place, tightest }, n) => ({
    bench: said.called(bench),
    people: said.remarked(bench, phones),
    place: said.ground.seen_at(place).map((/** @type {number} */ far) => decimals(far, 2)),
    start: overview[language()].starts[n],
    quick: said.text(bench, (other) => said.called(other)).quick,
    tightest: tightest ? said.tightest(bench) : NONE,
  }));
}

/** The table and what stands above it. @param {Briefing} briefing @param {NameList} names @param {Looks} looks @returns {Built} */
export function overviewSheet(briefing, { people: carriers, notes }, { phones, date, foot }) {
  const said = new Sayings(briefing, carriers);
  const maps = new SheetMaps(briefing, "a4");
  const { title, overview } = briefing;
  const { verdict, tightest, coming, leaving, room } = overview[language()];
  const rows = rowsOf(said, phones);
  const alike = rows.length > 1 && rows.every(({ quick }) => quick === rows[0].quick);
  const starts = maps.starts((bench) => said.called(bench));
  const sheet = make(
    "article",
    { class: "overview" },
    make("h2", {}, title[language()] || _("Overview")),
    ...listOf(_("Verdict"), [...verdict, checkedLine(said, date)]),
    ...listOf(_("Tightest moments between coils"), tightest),
    ...listOf(_("Coming and leaving"), [...coming, ...leaving]),
    ...listOf(_("Room for people"), room),
    ...listOf(_("Notes on the list of names"), notes),
    make("h3", {}, _("Where each bench starts")),
    ...[said.ground.ways_legend].filter(Boolean).map((line) => make("p", {}, line)),
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
  const body = rows.map(({ bench, people, start, quick, tightest }) => {
    const names = people.join(_(", ")) || _("(nobody)");
    return kept([bench, names, start, quick, tightest]);
  });
  return table(kept(headings()), body, { kind: alike ? "alike" : "", named: true });
}

/** When it was checked, and how many benches and people there are: who is named at several counts once. @param {Sayings} said @param {string} date */
function checkedLine(said, date) {
  const known = { date, benches: said.briefing.benches.length, people: said.persons };
  if (!known.people)
    return _("Checked on {date}; {benches} benches. There is no list of names yet.", known);
  return _("Checked on {date}; {benches} benches, {people} people in the list of names.", known);
}

/** @param {string} name @param {string[]} lines */
function listOf(name, lines) {
  if (!lines.length) return [];
  return [make("h3", {}, name), ...lines.map((line) => make("p", {}, line))];
}

/** The table as a file for spreadsheets. @param {Briefing} briefing @param {NameList} names @param {Looks} looks */
export function overviewTable(briefing, { people }, { phones }) {
  const said = new Sayings(briefing, people);
  const [bench, carriers, , does, tightest] = headings();
  const rows = rowsOf(said, phones).map((row) => [
    row.bench, row.people.join(_(", ")), ...row.place, row.quick, row.tightest === NONE ? "" : row.tightest,
  ]); // prettier-ignore
  return csvFile([[bench, carriers, "x (m)", "y (m)", does, tightest], ...rows]);
}
