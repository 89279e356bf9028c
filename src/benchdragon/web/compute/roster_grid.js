// A list of names as rows of texts: tables of text in the encodings in use. What differs in the page from
// `read_rows` of rosters/grid.py; roster_book.js reads workbooks.

import { _ } from "../words.js";
import { ROSTERS_GRID } from "./constants.js";
import { InputError } from "./errors.js";
import { tooLarge } from "../made/roster_limits.js";
import { decoded, isText, limited, textRows } from "../made/roster_rows.js";

// What files start with: of zip (XLSX, ODS), and of old and of locked workbooks.
const WORKBOOKS = [
  [0x50, 0x4b, 0x03, 0x04],
  [0xd0, 0xcf, 0x11, 0xe0],
];
const ENDINGS = /\.(csv|tsv|txt|xlsx|xlsm|ods|xls)$/i;

/** Check what a file with a list is called, and how large it is. @param {Uint8Array} bytes @param {string} name */
export function checkFile(bytes, name) {
  if (!ENDINGS.test(name))
    throw new InputError(
      _("{file}: lists of names are read from {endings} files", {
        file: name,
        endings: ".xlsx, .xlsm, .csv, .tsv, .txt",
      }),
    );
  if (bytes.length > ROSTERS_GRID.MOST_BYTES) throw tooLarge(name);
  if (!bytes.length) throw isEmpty(name);
}

/** The text of a file with a list. @param {Uint8Array} bytes @param {string} name */
export function textOf(bytes, name) {
  if (WORKBOOKS.some((sign) => sign.every((byte, n) => bytes[n] === byte)))
    throw new InputError(
      _(
        "{file} is a workbook of a kind that this page does not read: save it as XLSX, or copy its rows and paste them here",
        { file: name },
      ),
    );
  return decoded(bytes, name);
}

/** What is said of a list without anything in it. @param {string} name */
export function isEmpty(name) {
  return new InputError(_("{file} is empty", { file: name }));
}

/** The cells of a list, row by row. @param {string} text @param {string} name @returns {string[][]} */
export function rowsOf(text, name) {
  if (text.length > ROSTERS_GRID.MOST_BYTES) throw tooLarge(name);
  isText(text, name);
  return limited(textRows(text, name), name);
}
