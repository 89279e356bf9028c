// The timetable: when head and tail pass each place, where the head stops, how the drum goes; on paper and as
// files.

import { csvFile } from "./csv.js";
import { make, table } from "./elements.js";
import { _, language } from "./words.js";

/** @typedef {import("./compute/briefing.js").Briefing} Briefing */
/** @typedef {import("./name_list.js").NameList} NameList */
/** @typedef {import("./sheets.js").Built} Built */
/** @typedef {import("./sheets.js").Looks} Looks */

// The cell of a place that nothing passes: NONE of explain/timetable_text.py.
const NONE = "-";

/** The table and the sentences above it. @param {Briefing} briefing @param {NameList} _names @param {Looks} looks @returns {Built} */
export function timetableSheet({ title, timetable }, _names, { foot }) {
  const { name, columns, rows, lines } = timetable[language()];
  const sheet = make(
    "article",
    { class: "overview timetable" },
    make("h2", {}, title[language()] || _("Timetable")),
    ...lines.map((line) => make("p", {}, line)),
    make("h3", {}, name),
    table(columns, rows, { named: true }),
    make("footer", {}, foot),
  );
  return { pages: [sheet] };
}

/** The same as a file for spreadsheets, with times as seconds since the start of the dance too. @param {Briefing} briefing */
export function timetableTable({ timetable, seconds }) {
  const { columns, rows, lines } = timetable[language()];
  const more = [
    _("head (s from the start)"),
    _("sets out again after a stop (s from the start)"),
    _("tail (s from the start)"),
  ];
  const told = (/** @type {number | null} */ time) => (time === null ? "" : time.toFixed(1));
  return csvFile([
    [...columns, ...more],
    ...rows.map((row, n) => [
      ...row.map((text) => (text === NONE ? "" : text)),
      ...seconds[n].map(told),
    ]),
    ...lines.map((line) => [line]),
  ]);
}
