// Which columns of a list hold what: by their headings, else by what stands in them. Twin of
// rosters/columns.py.

import { _ } from "../words.js";
import { ROSTERS_COLUMNS, ROSTERS_WORDS } from "./constants.js";
import { InputError } from "./errors.js";
import { likePeople } from "./roster_names.js";
import { heading, isName, isOther, namesOf, places, plain, withoutPhones } from "./roster_words.js";

/** The columns of one block of a list, counted from 0; lists may stand side by side in blocks. @typedef {{ number: number, names: number[], households: number[], phones: number[], remarks: number[] }} Columns */

/**
 * How a list is set.
 * @typedef {object} Layout
 * @property {number} first the row after the headings, counted from 0
 * @property {Columns[]} blocks what the columns hold
 * @property {string[]} unread columns with something in them that are not read, by their headings or letters
 * @property {boolean} guessed whether there were no headings
 * @property {boolean} householders whether there is no column of names, so that householders are the bearers
 */

const { MOST_LOOKED_AT, LEAST_NAMES, MOST_HEADING } = ROSTERS_COLUMNS;
const { MOST_TITLES } = ROSTERS_WORDS;
const LISTS = /** @type {const} */ ({
  name: "names",
  household: "households",
  phone: "phones",
  remarks: "remarks",
});

/** @returns {Columns} */
function noColumns() {
  return { number: -1, names: [], households: [], phones: [], remarks: [] };
}

/** How the rows of a list are set. @param {string[][]} rows @param {string} name @returns {Layout} */
export function layout(rows, name) {
  for (const [number, row] of rows.slice(0, MOST_TITLES).entries()) {
    const { blocks, unread } = blocksOf(row);
    if (!blocks.length) continue;
    const nameless = counted(width(rows.slice(number))).filter((n) => !row[n]);
    const householders = blocks.some(({ names, households }) => names.join() === households.join());
    refuseNames(rows, number + 1, [...unread, ...nameless], householders, name);
    const others = nameless.flatMap((n) => {
      const first = rows.findIndex((one, at) => at > number && one[n]);
      const values = { column: letters(n), row: first + 1 };
      return first < 0 ? [] : [_("{column} (row {row})", values)];
    });
    const told = [...unread.map((n) => row[n]), ...others];
    return { first: number + 1, blocks, unread: told, guessed: false, householders };
  }
  refuseHalf(rows, name);
  const found = guessed(rows);
  if (found) {
    const [{ number, names, phones }] = found.blocks;
    const left = counted(width(rows)).filter((n) => ![number, ...names, ...phones].includes(n));
    refuseNames(rows, found.first, left, false, name);
    return found;
  }
  throw new InputError(
    _(
      "{file}: no column of bench numbers with names beside it was found; write a first row such as: 桥号, 姓名, 户主, 电话, 备注 (bench, name, household, phone, remarks)",
      { file: name },
    ),
  );
}

/** Refuse headings that do not say which column holds the numbers, or which those who carry. @param {string[][]} rows @param {string} name */
function refuseHalf(rows, name) {
  for (const [n, row] of rows.slice(0, MOST_TITLES).entries()) {
    const filled = row.filter(Boolean);
    const kinds = filled.flatMap((cell) => heading(cell)?.kind ?? []);
    if (filled.length < LEAST_NAMES || filled.some((cell) => places(cell))) continue;
    const said = cut(filled.join(", "));
    const values = { file: name, row: n + 1, said };
    if (kinds.includes("number"))
      throw new InputError(
        _(
          "{file}: row {row} has headings, but none that is known for those who carry ({said}): write 姓名 (name) over their column",
          values,
        ),
      );
    if (kinds.includes("name") || kinds.includes("household"))
      throw new InputError(
        _(
          "{file}: row {row} has headings, but none that is known for the numbers of benches ({said}): write 桥号 (bench) over their column",
          values,
        ),
      );
  }
}

/** Refuse people in columns that are not read: whether they carry is not for us to guess. Where householders would be the bearers, any words there may be the names of others (`allWords`). @param {string[][]} rows @param {number} first @param {number[]} columns @param {boolean} allWords @param {string} name */
function refuseNames(rows, first, columns, allWords, name) {
  const head = first ? rows[first - 1] : [];
  for (const n of columns) {
    const said = head[n] ?? "";
    if (isOther(said) || (said && heading(said))) continue;
    const cells = rows.slice(first).flatMap((row) => row[n] || []);
    const people = cells.filter((cell) => namesOf(cell).some(likePeople)).length;
    const words = allWords && said && mostly(cells, holdsNames);
    if (!words && (people < (said ? 1 : LEAST_NAMES) || 2 * people <= cells.length)) continue;
    const values = { file: name, column: letters(n), heading: cut(said) };
    throw new InputError(
      said
        ? _(
            "{file}: names stand in column {column}, whose heading, {heading}, is not known: write 姓名 (name) in its place if those carry, 户主 (household) if the benches are theirs, 备注 (remarks) if neither",
            values,
          )
        : _(
            "{file}: names stand in column {column}, which has no heading: write over it 姓名 (name) if those carry, 户主 (household) if the benches are theirs, 备注 (remarks) if neither",
            values,
          ),
    );
  }
}

/** @param {string} text */
function cut(text) {
  return Array.from(text).slice(0, MOST_HEADING).join("");
}

/** The numbers from 0 on. @param {number} count */
function counted(count) {
  return Array.from({ length: count }, (_one, n) => n);
}

/** @param {string[][]} rows */
function width(rows) {
  return rows.reduce((most, row) => Math.max(most, row.length), 0);
}

/** @param {string[][]} rows @param {number[]} columns */
function filled(rows, columns) {
  return columns.filter((n) => rows.some((row) => row[n]));
}

/** What the columns hold if a row is one of headings, and the columns that it calls otherwise. @param {string[]} row */
function blocksOf(row) {
  const blocks = [noColumns()];
  /** @type {number[]} */
  const unread = [];
  let [rank, numbered] = [0, ""];
  for (const [n, cell] of row.entries()) {
    const known = cell ? heading(cell) : null;
    const block = blocks[blocks.length - 1];
    if (!known) {
      if (cell) unread.push(n);
    } else if (known.kind !== "number") block[LISTS[known.kind]].push(n);
    else if (block.number < 0 || plain(cell) === numbered) {
      if (block.number >= 0) blocks.push(noColumns());
      blocks[blocks.length - 1].number = n;
      [rank, numbered] = [known.rank, plain(cell)];
    } else if (known.rank < rank) {
      unread.push(block.number);
      block.number = n;
      [rank, numbered] = [known.rank, plain(cell)];
    } else unread.push(n);
  }
  for (const block of blocks) if (!block.names.length) block.names = [...block.households];
  const whole = blocks.every(({ number, names }) => number >= 0 && names.length);
  return whole ? { blocks, unread } : { blocks: [], unread: [] };
}

/** Columns by what stands in them: the first with numbers, then the names, phones anywhere. @param {string[][]} rows @returns {Layout | null} */
function guessed(rows) {
  const looked = rows.filter((row) => row.some(Boolean)).slice(0, MOST_LOOKED_AT);
  const columns = counted(width(looked));
  const cells = columns.map((n) => looked.flatMap((row) => row[n] || []));
  const number = columns.find((n) => mostly(cells[n], (cell) => places(cell) !== null));
  if (number === undefined) return null;
  const names = columns.find((n) => n > number && mostly(cells[n], holdsNames));
  if (names === undefined) return null;
  const phones = columns.filter((n) => n !== number && mostly(cells[n], isPhone));
  const others = counted(width(rows)).filter((n) => ![number, names, ...phones].includes(n));
  const first = rows.findIndex((row) => number < row.length && places(row[number]) !== null);
  const unread = filled(rows.slice(first), others).map(letters);
  const block = { ...noColumns(), number, names: [names], phones };
  return { first, blocks: [block], unread, guessed: true, householders: false };
}

/** @param {string[]} cells @param {(cell: string) => boolean} wanted */
function mostly(cells, wanted) {
  return cells.length > 0 && 2 * cells.filter(wanted).length > cells.length;
}

/** @param {string} cell */
function holdsNames(cell) {
  const names = namesOf(cell);
  return names.length > 0 && names.every(isName) && places(cell) === null;
}

/** @param {string} cell */
function isPhone(cell) {
  const [rest, phones] = withoutPhones(cell);
  return phones.length > 0 && !/\p{L}/u.test(rest);
}

/** What spreadsheets call a column, counted from 0. @param {number} column */
export function letters(column) {
  let text = "";
  for (let left = column + 1; left; left = Math.floor((left - 1) / 26))
    text = String.fromCharCode(65 + ((left - 1) % 26)) + text;
  return text;
}
