// @ts-nocheck
// Made from rosters/extent.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";

const MOST_ROWS = 20000;
const MOST_COLUMNS = 100;
const MOST_CELLS = 100000;
const MOST_SIGNS = 1000;
export function torn(name) {
  let text;
  text = _("{file} is torn, or no workbook: open it in a spreadsheet and save it again");
  return py.filled(text, { file: name });
}
export function tooLarge(name) {
  return new InputError(py.filled(_("{file} is too large for a list of names: at most {rows} rows, {columns} columns, {cells} cells and {signs} signs in a cell are read; save the list alone"), { file: name, rows: MOST_ROWS, columns: MOST_COLUMNS, cells: MOST_CELLS, signs: MOST_SIGNS }));
}
