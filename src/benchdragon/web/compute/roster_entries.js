// What each row of a list says: benches as the list numbers them, and their people. Twin of
// rosters/entries.py.

import { _ } from "../words.js";
import { ROSTERS_ENTRIES } from "./constants.js";
import { pythonRepr } from "./python_text.js";
import { ABOVE, LEFT } from "./roster_names.js";
import { DECIMALS, MADE_A_DAY, ROUNDED, clean, isDoubtful, isName, isSum } from "./roster_words.js";
import {
  namesOf,
  places,
  plain,
  simple,
  withPlaces,
  withoutDashes,
  withoutPhones,
} from "./roster_words.js";

/** @typedef {import("./roster_columns.js").Columns} Columns */
/** @typedef {import("./roster_words.js").Place} Place */
/** Somebody who carries a bench; what is not known is "".  @typedef {{ name: string, household: string, phone: string, remarks: string, home_phone: string }} Person */
/** A row with people: its number, from 1; the benches as it, or the row above, names them; and whether its householder is taken for who carries. @typedef {{ row: number, benches: Array<[Place, Place]>, people: Person[], householder: boolean }} Entry */
/** A row, or a part of it, that was not read, and why, in words; a sum is none of people. @typedef {{ row: number, why: string, isSum?: boolean }} Unread */

const { MOST_SHOWN } = ROSTERS_ENTRIES;

/**
 * What a block of columns says, row by row from `first`, counted from 0. A row without a number goes on about
 * the bench of the row above.
 * @param {string[][]} rows
 * @param {number} first
 * @param {Columns} block
 * @returns {Array<Entry | Unread>}
 */
export function entries(rows, first, block) {
  const head = first ? plainly(rows[first - 1]) : plainly([]);
  /** @type {Array<Entry | Unread>} */
  const found = [];
  /** @type {Array<[Place, Place]>} */
  let benches = [];
  let household = "";
  const numbers = rows.slice(first).flatMap((row) => cellsOf(row, [block.number]));
  const halved = new Set(numbers.flatMap(withPlaces));
  for (const [n, row] of repeated(rows, first, block).entries()) {
    const number = first + n + 1;
    if (!row.some(Boolean) || plainly(row) === head) continue;
    if (isSum(/** @type {string} */ (row.find(Boolean)))) {
      benches = [];
      found.push({ row: number, why: _("taken for a sum: {text}", { text: shown(row) }), isSum: true });
      continue;
    }
    if (!cellsOf(row, allOf(block)).some(Boolean)) continue;
    const [said] = cellsOf(row, [block.number]);
    if (said) {
      const told = isDoubtful(said, halved) ? null : places(said, halved);
      [benches, household] = [told ?? [], ""];
      if (!told) {
        found.push({ row: number, why: notANumber(said, row) });
        continue;
      }
    } else if (!benches.length) {
      found.push({ row: number, why: _("no number of a bench: {text}", { text: shown(row) }) });
      continue;
    }
    const { people: named, odd } = peopleOf(row, block, household);
    const owner = named.length || odd.length ? [] : householderOf(row, block);
    const people = named.length ? named : owner;
    const others = [...block.households, ...block.phones, ...block.remarks];
    if (!people.length && !odd.length && cellsOf(row, others).some(Boolean))
      odd.push(_("no name, only {text}", { text: shown(row) }));
    found.push(...odd.map((why) => ({ row: number, why })));
    household = people.find((one) => one.household)?.household ?? household;
    const householder = owner.length > 0;
    if (people.length) found.push({ row: number, benches, people, householder });
  }
  return found;
}

/** The rows from `first` on; 同上 and 同左 are what they say again. @param {string[][]} rows @param {number} first @param {Columns} block */
function repeated(rows, first, block) {
  const all = allOf(block);
  /** @type {Map<number, string>} */
  let above = new Map();
  return rows.slice(first).map((row) => {
    const said = [...row];
    const named = cellsOf(row, block.names).some((cell) => ABOVE.has(simple(cell)));
    for (const n of all) {
      const word = simple(said[n] ?? "");
      const whose = named && !word && [...block.households, ...block.phones].includes(n);
      if (ABOVE.has(word) || whose) {
        while (said.length <= n) said.push("");
        const told = block.names.includes(n) ? said[n] : "";
        said[n] = n === block.number ? "" : above.get(n) || told;
      } else if (LEFT.has(word) && n) said[n] = said[n - 1];
    }
    if (cellsOf(said, all).some(Boolean)) above = new Map(all.map((n) => [n, said[n] ?? ""]));
    return said;
  });
}

/** What rows that say the same have in common. @param {string[]} row */
function plainly(row) {
  return JSON.stringify(row.map(plain));
}

/** @param {Columns} block */
function allOf({ number, names, households, phones, remarks }) {
  return [number, ...names, ...households, ...phones, ...remarks];
}

/** @param {string[]} row @param {number[]} columns */
function cellsOf(row, columns) {
  return columns.map((n) => row[n] ?? "");
}

/** What a row says, without phones. @param {string[]} row */
function shown(row) {
  const text = clean(row.map((cell) => withoutPhones(cell)[0]).join(" "));
  const signs = Array.from(text);
  return signs.length <= MOST_SHOWN ? text : `${signs.slice(0, MOST_SHOWN).join("")}…`;
}

/** @param {string} said @param {string[]} row */
function notANumber(said, row) {
  if (MADE_A_DAY.test(said))
    return _(
      "the spreadsheet made a day of the bench's number ({text}): format the column as text",
      { text: said },
    ); // prettier-ignore
  if (places(said))
    return _(
      "{said} may be several benches, or a place at one: write {benches}, or the bench alone",
      { said, benches: withoutDashes(said) },
    ); // prettier-ignore
  const [head, ...rest] = said.split("，");
  if (rest.length && places(head) && row.filter(Boolean).length === 1)
    return _("the comma behind {number} is a Chinese one (，): type an English one (,)", {
      number: clean(head),
    });
  const values = { said: pythonRepr(shown([said])), text: shown(row) };
  return _("{said} is no number of a bench: {text}", values);
}

/** The people of a row, and what of it was not understood. @param {string[]} row @param {Columns} block @param {string} above the household of the row above */
function peopleOf(row, block, above) {
  const [remarks, hidden] = opened(cellsOf(row, block.remarks));
  const [said, more] = opened(cellsOf(row, block.households));
  const household = said || above;
  const { own: columns, home: homes } = phoneColumns(block);
  const home = [...cellsOf(row, homes).flatMap(phonesOf), ...more].join(" ");
  /** @type {Person[]} */
  const people = [];
  const odd = cellsOf(row, block.phones)
    .filter((cell) => ROUNDED.test(cell))
    .map(() => _("the spreadsheet rounded a phone number: format the column as text"));
  for (const [n, cell] of cellsOf(row, block.names).entries()) {
    const [rest, phones] = withoutPhones(cell);
    const own = [...cellsOf(row, columns[n]).flatMap(phonesOf), ...phones, ...(n ? [] : hidden)];
    const names = namesOf(rest);
    odd.push(
      ...names
        .filter((name) => !isName(name))
        .map((name) => _("{text} is no name", { text: shown([name]) })),
    );
    for (const [k, name] of names.entries()) {
      const told = own.length === names.length ? own[k] : own.join(" ");
      const phone = told || (name === household ? home : "");
      if (isName(name)) people.push({ name, household, phone, remarks, home_phone: home });
    }
  }
  return { people, odd };
}

/** The columns of phones of each column of names, and those of the household or of all together. @param {Columns} block */
function phoneColumns({ names, households, phones }) {
  /** @type {number[][]} */
  const own = names.map(() => []);
  /** @type {number[]} */
  const home = [];
  if (phones.length === names.length && names.length > 1) return { own: phones.map((n) => [n]), home };
  for (const phone of phones) {
    const before = names.filter((n) => n < phone).length;
    const headed = names.length > 1 || households.some((n) => n < phone);
    if (before > 1 || (!before && headed)) home.push(phone);
    else own[0].push(phone);
  }
  return { own, home };
}

/** Who carries where a row leaves the names blank, but says whose household it is. @param {string[]} row @param {Columns} block @returns {Person[]} */
function householderOf(row, block) {
  if (cellsOf(row, block.names).some(Boolean)) return [];
  const [household, hidden] = opened(cellsOf(row, block.households));
  const [remarks, more] = opened(cellsOf(row, block.remarks));
  const phones = [...cellsOf(row, block.phones).filter(Boolean), ...hidden, ...more];
  const phone = [...new Set(phones)].join(" ");
  return namesOf(household)
    .filter(isName)
    .map((name) => ({ name, household, phone, remarks, home_phone: "" }));
}

/** The texts of cells without the phones in them, and these. @param {string[]} cells @returns {[string, string[]]} */
function opened(cells) {
  const split = cells.filter(Boolean).map(withoutPhones);
  return [clean(split.map(([text]) => text).join(" ")), split.flatMap(([, phones]) => phones)];
}

/** The numbers of a cell of phones; all of it where none is told apart. @param {string} cell */
function phonesOf(cell) {
  const [rest, phones] = withoutPhones(cell.replace(DECIMALS, ""));
  if (!rest.replace(/^[ ,;、，；/]+|[ ,;、，；/]+$/gu, "")) return phones;
  return cell ? [clean(cell)] : [];
}
