// A list of names as rows of texts: tables of text in the encodings in use. Twin of rosters/grid.py, but for
// workbooks, which roster_book.js reads.

import { _ } from "../words.js";
import { ROSTERS_EXTENT, ROSTERS_GRID, ROSTERS_WORDS } from "./constants.js";
import { InputError } from "./errors.js";
import { heading, stripped } from "./roster_words.js";

const { MOST_ROWS, MOST_COLUMNS, MOST_CELLS, MOST_SIGNS } = ROSTERS_EXTENT;
// What files start with: of zip (XLSX, ODS), and of old and of locked workbooks.
const WORKBOOKS = [
  [0x50, 0x4b, 0x03, 0x04],
  [0xd0, 0xcf, 0x11, 0xe0],
];
const ENDINGS = /\.(csv|tsv|txt|xlsx|xlsm|ods|xls)$/i;
// What parts the columns of a table of text, and what ends the number where nothing does.
const MARKS = ["\t", ",", ";"];
// Chinese marks part names too: they part columns only below a row of headings that they part.
const CHINESE_MARKS = ["，", "；"];
const NUMBER_END = /(?<=\S)[\s:：，]+/u;
const LINE_END = /\r\n|[\n\r\v\f\x1c-\x1e\x85\u2028\u2029]/u;
// A cell between quotation marks, which may be left open, and such a mark alone: what stands above.
const quoted = (/** @type {string} */ mark) =>
  new RegExp(
    `(?:^|(?<=[${mark}\\r\\n]))"(?:(?=[ \\t]*(?:[${mark}\\r\\n]|$))|[^"]*(?:""[^"]*)*(?:"|$))`,
    "gu",
  );
const ABOVE = "\u3003";
// Bytes of a sign of two, after those of four, in GB18030 or Big5.
const [DIGIT_0, DIGIT_9, FIRST, LAST] = [0x30, 0x39, 0x81, 0xfe];
// Signs of texts that no text has.
const NO_TEXT = /[\0-\x08\x0e-\x19\x1b-\x1f]/u;

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
  const marked = (bytes[0] === 0xff && bytes[1] === 0xfe) || (bytes[0] === 0xfe && bytes[1] === 0xff);
  const wide = bytes[0] === 0xff ? "utf-16le" : "utf-16be";
  const read = marked ? null : decoded(bytes, "utf-8");
  if (read !== null && isText(read, name)) return read;
  for (const encoding of marked ? [wide] : double(bytes, name)) {
    const text = decoded(bytes, encoding);
    if (text !== null && isText(text, name)) return text;
  }
  throw new InputError(
    _("{file} is no table of text in UTF-8, GB18030 or Big5: save it as XLSX, or as CSV in UTF-8", {
      file: name,
    }),
  );
}

/** Encodings that bytes may have which are not sound UTF-8: Big5 where its common signs are more. @param {Uint8Array} bytes @param {string} name */
function double(bytes, name) {
  const { COMMON, ALL_BUT } = ROSTERS_GRID;
  const whole = new TextDecoder("utf-8").decode(bytes);
  const torn = whole.split("\ufffd").length - 1;
  const sound = Array.from(whole).filter((sign) => sign > "\x7f").length;
  if (torn && sound - torn > ALL_BUT * torn) {
    const line = whole.slice(0, whole.indexOf("\ufffd")).split("\n").length;
    throw new InputError(
      _("{file}: line {line} is torn: what stands there is no UTF-8, as the rest is; save it anew", {
        file: name,
        line,
      }),
    );
  }
  const { pairs, gb, big5 } = commonSigns(bytes);
  return big5 > gb && 10 * big5 >= COMMON * pairs ? ["big5", "gb18030"] : ["gb18030"];
}

/** How many signs of more than a byte there are, and how many are common ones of GB18030 and of Big5. @param {Uint8Array} bytes */
function commonSigns(bytes) {
  const within = (/** @type {number} */ byte, low = FIRST, high = LAST) => low <= byte && byte <= high;
  let [pairs, gb, big5] = [0, 0, 0];
  for (let n = 0; n < bytes.length; n++) {
    const [lead, trail] = [bytes[n], bytes[n + 1]];
    if (!within(lead)) continue;
    if (
      within(trail, DIGIT_0, DIGIT_9) &&
      within(bytes[n + 2]) &&
      within(bytes[n + 3], DIGIT_0, DIGIT_9)
    ) {
      pairs++;
      n += 3;
    } else if (within(trail, 0x40)) {
      pairs++;
      n++;
      const high = within(trail, 0xa1);
      if (high && (within(lead, 0xa1, 0xa3) || within(lead, 0xb0, 0xf7))) gb++;
      if ((high || within(trail, 0x40, 0x7e)) && within(lead, 0xa1, 0xc6)) big5++;
    }
  }
  return { pairs, gb, big5 };
}

/** @param {Uint8Array} bytes @param {string} encoding */
function decoded(bytes, encoding) {
  try {
    return new TextDecoder(encoding, { fatal: true }).decode(bytes);
  } catch (error) {
    if (error instanceof TypeError) return null;
    throw error;
  }
}

/** Whether it may be text; a single sign that no text has is told. @param {string} text @param {string} name */
function isText(text, name) {
  const found = NO_TEXT.exec(text);
  if (!found) return true;
  if (text.includes("\0")) return false;
  const line = text.slice(0, found.index).split("\n").length;
  const code = found[0].charCodeAt(0).toString(16).toUpperCase().padStart(4, "0");
  throw new InputError(
    _("{file}: line {line} has a control sign ({sign}), which no text has: delete it", {
      file: name,
      line,
      sign: `U+${code}`,
    }),
  );
}

/** What is said of a list beyond the limits. @param {string} name */
export function tooLarge(name) {
  return new InputError(
    _(
      "{file} is too large for a list of names: at most {rows} rows, {columns} columns, {cells} cells and {signs} signs in a cell are read; save the list alone",
      { file: name, rows: MOST_ROWS, columns: MOST_COLUMNS, cells: MOST_CELLS, signs: MOST_SIGNS },
    ),
  );
}

/** What is said of a list without anything in it. @param {string} name */
export function isEmpty(name) {
  return new InputError(_("{file} is empty", { file: name }));
}

/** The cells of a list, row by row; where no sign parts its columns, a line is a number and names. @param {string} text @param {string} name */
export function rowsOf(text, name) {
  if (text.length > ROSTERS_GRID.MOST_BYTES) throw tooLarge(name);
  isText(text, name);
  const lines = text.split(LINE_END);
  if (lines[lines.length - 1] === "") lines.pop();
  const first = lines.map((line) => Array.from(line).find((sign) => MARKS.includes(sign)) ?? "");
  const counts = MARKS.map((mark) => first.filter((sign) => sign === mark).length);
  const most = Math.max(...counts);
  const chinese = chineseMark(lines.slice(0, ROSTERS_WORDS.MOST_TITLES));
  const mark = chinese.mark || (most ? MARKS[counts.indexOf(most)] : "");
  const rows = mark ? tableRows(closed(text, mark, name), mark) : lines.map((line) => parted(line));
  // Of a number and names alone all that follows is names.
  if (chinese.columns === 2)
    for (const row of rows) if (row.length) row.splice(1, row.length, row.slice(1).join(mark));
  return limited(
    rows.map((row) => row.map(stripped)),
    name,
  );
}

/** A table with the sign for 同上 where a quotation mark stands alone; one that is left open would swallow all rows below it. @param {string} text @param {string} mark @param {string} name */
function closed(text, mark, name) {
  return text.replace(quoted(mark), (found, /** @type {number} */ at) => {
    if (found === '"') return ABOVE;
    const marks = found.split('"').length - 1;
    if (found.endsWith('"') && marks % 2 === 0) return found;
    const line = text.slice(0, at).split("\n").length;
    throw new InputError(
      _("{file} is no table of text: the quotation mark in line {line} is never closed", {
        file: name,
        line,
      }),
    );
  });
}

/** The Chinese comma or semicolon that alone parts a row of headings, and into how many; else "". @param {string[]} lines */
function chineseMark(lines) {
  for (const mark of CHINESE_MARKS)
    for (const line of lines) {
      const cells = line.split(mark);
      const known = cells.filter((cell) => heading(cell)).length;
      if (known > 1 && !MARKS.some((sign) => line.includes(sign)))
        return { mark, columns: cells.length };
    }
  return { mark: "", columns: 0 };
}

/** A line as a number and what is behind it. @param {string} line */
function parted(line) {
  const found = NUMBER_END.exec(line);
  if (!found) return [line];
  return [line.slice(0, found.index), line.slice(found.index + found[0].length)];
}

/** Rows of a table, whose cells may stand between quotes, as Python's csv reads them. @param {string} text @param {string} mark */
function tableRows(text, mark) {
  /** @type {string[][]} */
  const rows = [];
  /** @type {string[]} */
  let row = [];
  let [cell, quoted, begun] = ["", false, false];
  const endCell = () => {
    row.push(cell);
    [cell, begun] = ["", false];
  };
  const endRow = () => {
    if (row.length || begun) endCell();
    rows.push(row);
    row = [];
  };
  for (let n = 0; n < text.length; n++) {
    const sign = text[n];
    if (quoted) {
      if (sign !== '"') cell += sign;
      else if (text[n + 1] === '"') cell += text[++n];
      else quoted = false;
    } else if (sign === '"' && !begun) [quoted, begun] = [true, true];
    else if (sign === mark) endCell();
    else if (isLineEnd(sign)) {
      if (sign === "\r" && text[n + 1] === "\n") n++;
      endRow();
    } else [cell, begun] = [cell + sign, true];
  }
  if (row.length || begun) endRow();
  return rows;
}

/** @param {string | undefined} sign */
function isLineEnd(sign) {
  return sign === "\n" || sign === "\r";
}

/** The same rows, if they are no more than are read. @param {string[][]} rows @param {string} name */
export function limited(rows, name) {
  const cells = rows.reduce((count, row) => count + row.length, 0);
  if (rows.length > MOST_ROWS || cells > MOST_ROWS * MOST_COLUMNS) throw tooLarge(name);
  const filled = rows.flatMap((row) => [...row.entries()].filter(([, cell]) => cell));
  if (!filled.length) throw isEmpty(name);
  const wide = ([n, cell] = [0, ""]) => n >= MOST_COLUMNS || Array.from(cell).length > MOST_SIGNS;
  if (filled.length > MOST_CELLS || filled.some(wide)) throw tooLarge(name);
  return rows;
}
