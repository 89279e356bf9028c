// A list of names in a workbook (XLSX) as rows of texts, the browser being who reads XML. Twin of
// rosters/grid.py, which has them from a library.

import { unzipSync } from "../carried_zip.js";
import { _ } from "../words.js";
import { ROSTERS_EXTENT } from "./constants.js";
import { InputError } from "./errors.js";
import { pythonFloat } from "./number_format.js";
import { py } from "./python.js";
import { checkFile, isEmpty, rowsOf, textOf } from "./roster_grid.js";
import { tooLarge, torn as tornText } from "../made/roster_limits.js";
import { limited } from "../made/roster_rows.js";

const { MOST_UNPACKED, MOST_PARTS, MOST_ROWS, MOST_COLUMNS } = ROSTERS_EXTENT;

/** A sheet of a file, by its name; "" where a file has no sheets. @typedef {{ name: string, rows: string[][] }} Sheet */
/** How a cell shows its number. @typedef {"number" | "day" | "length"} Shown */

const BOOK = "xl/workbook.xml";
// What zip files start with.
const ZIP = [0x50, 0x4b, 0x03, 0x04];
const PLACE = /^([A-Z]{1,3})([0-9]{1,7})$/;
// Numbers of formats that every workbook has, for days and times of day, and for lengths of time.
const DAYS = [14, 15, 16, 17, 18, 19, 20, 21, 22, 45, 47];
const LENGTHS = [46];
// In a format, what is no sign of it: texts, single signs, colours and conditions.
const QUOTED = /"[^"]*"|[\\_*]./gu;
const LENGTH = /\[(?:h+|m+|s+)\]/i;
const BRACKETS = /\[[^\]]*\]/g;
const MILLISECONDS = 1000;
const DAY = 86_400 * MILLISECONDS;
// The last day that workbooks know.
const LAST_DAY = 2958465.999999;

/** The sheets of a file that can be seen and have anything in them. @param {ArrayBuffer} data @param {string} name @returns {Sheet[]} */
export function sheetsOf(data, name) {
  const bytes = new Uint8Array(data);
  checkFile(bytes, name);
  if (ZIP.every((byte, n) => bytes[n] === byte)) {
    const parts = unpacked(bytes, name);
    if (BOOK in parts) return new Book(parts, name).sheets();
    if (!("content.xml" in parts)) throw torn(name);
  }
  const text = textOf(bytes, name);
  if (/\.xls[xm]$/i.test(name)) throw torn(name);
  return [{ name: "", rows: rowsOf(text, name) }];
}

/** What is said of a workbook that is not whole. @param {string} name */
function torn(name) {
  return new InputError(tornText(name));
}

/** The parts of a workbook that are XML, by their names. @param {Uint8Array} bytes @param {string} name */
function unpacked(bytes, name) {
  let [size, count] = [0, 0];
  const filter = (/** @type {{ name: string, originalSize: number }} */ part) => {
    size += part.originalSize;
    if (++count > MOST_PARTS || size > MOST_UNPACKED) throw tooLarge(name);
    return /\.(xml|rels)$/i.test(part.name);
  };
  try {
    return unzipSync(bytes, { filter });
  } catch (error) {
    throw error instanceof InputError ? error : torn(name);
  }
}

/** All elements of a name within one. @param {Element} element @param {string} name */
function all(element, name) {
  return [...element.getElementsByTagNameNS("*", name)];
}

/** What an element reads, but for how it is spoken. @param {Element} element */
function textIn(element) {
  return all(element, "t")
    .filter(({ parentElement }) => parentElement?.localName !== "rPh")
    .map(({ textContent }) => textContent)
    .join("");
}

class Book {
  /** @param {Record<string, Uint8Array>} parts @param {string} name */
  constructor(parts, name) {
    this.parts = parts;
    this.name = name;
    this.book = this.#read(BOOK);
    this.from1904 = all(this.book, "workbookPr").some((one) =>
      ["1", "true"].includes(one.getAttribute("date1904") ?? ""),
    );
    this.texts = this.#all("xl/sharedStrings.xml", "si").map(textIn);
    this.shown = this.#formats();
  }

  /** @param {string} path */
  #read(path) {
    const part = this.parts[path];
    const text = part ? new TextDecoder().decode(part) : "";
    const document = new DOMParser().parseFromString(text, "application/xml");
    if (/<!DOCTYPE/i.test(text) || document.querySelector("parsererror")) throw torn(this.name);
    return document.documentElement;
  }

  /** All elements of a name in a part, which may be missing. @param {string} path @param {string} name */
  #all(path, name) {
    return path in this.parts ? all(this.#read(path), name) : [];
  }

  /** How cells show their numbers, style by style. @returns {Shown[]} */
  #formats() {
    const own = new Map(
      this.#all("xl/styles.xml", "numFmt").map((one) => [
        Number(one.getAttribute("numFmtId")),
        shownAs(one.getAttribute("formatCode") ?? ""),
      ]),
    );
    const styles = this.#all("xl/styles.xml", "cellXfs").flatMap((one) => all(one, "xf"));
    return styles.map((style) => {
      const format = Number(style.getAttribute("numFmtId"));
      if (LENGTHS.includes(format)) return "length";
      return own.get(format) ?? (DAYS.includes(format) ? "day" : "number");
    });
  }

  /** @returns {Sheet[]} */
  sheets() {
    const parts = new Map(
      this.#all("xl/_rels/workbook.xml.rels", "Relationship")
        .filter((one) => one.getAttribute("Type")?.endsWith("/worksheet"))
        .map((one) => [one.getAttribute("Id"), partOf(one.getAttribute("Target") ?? "")]),
    );
    const found = all(this.book, "sheet").flatMap((sheet) => {
      const id = [...sheet.attributes].find(({ localName }) => localName === "id")?.value ?? "";
      const path = parts.get(id);
      const seen = (sheet.getAttribute("state") ?? "visible") === "visible";
      return path && seen ? [{ name: sheet.getAttribute("name") ?? "", rows: this.#rows(path) }] : [];
    });
    const filled = found.filter(({ rows }) => rows.length);
    if (!filled.length) throw isEmpty(this.name);
    return filled.map((one) => ({ ...one, rows: limited(one.rows, this.name) }));
  }

  /** The cells of a sheet from its first row and column; joined cells say the same in each row. @param {string} path */
  #rows(path) {
    const sheet = this.#read(path);
    /** @type {string[][]} */
    const rows = [];
    let [row, width] = [-1, 0];
    for (const line of all(sheet, "row")) {
      row = line.hasAttribute("r") ? Number(line.getAttribute("r")) - 1 : row + 1;
      let column = -1;
      for (const cell of all(line, "c")) {
        const place = cell.getAttribute("r");
        if (place) [row, column] = this.#place(place);
        else column += 1;
        const said = this.#said(cell, row, column);
        if (said === null) continue;
        if (!(row >= 0 && row < MOST_ROWS && column < MOST_COLUMNS)) throw tooLarge(this.name);
        while (rows.length <= row) rows.push([]);
        rows[row][column] = py.strip(said);
        width = Math.max(width, column + 1);
      }
    }
    const whole = rows.map((cells) => Array.from({ length: width }, (_none, n) => cells[n] ?? ""));
    for (const joined of all(sheet, "mergeCell")) this.#join(whole, joined.getAttribute("ref") ?? "");
    return whole;
  }

  /** Row and column of a place such as B3, from 0. @param {string} text @returns {[number, number]} */
  #place(text) {
    const found = PLACE.exec(text);
    if (!found) throw torn(this.name);
    const column = [...found[1]].reduce((sum, sign) => 26 * sum + sign.charCodeAt(0) - 64, 0);
    return [Number(found[2]) - 1, column - 1];
  }

  /** Say in all rows of joined cells what the first says. @param {string[][]} rows @param {string} area */
  #join(rows, area) {
    const [[top, left], [bottom]] = (area.includes(":") ? area : `${area}:${area}`)
      .split(":")
      .map((place) => this.#place(place));
    for (const row of rows.slice(top + 1, bottom + 1))
      if (left < row.length) row[left] ||= rows[top][left];
  }

  /** What a cell says; null where there is nothing in it. @param {Element} cell @param {number} row @param {number} column */
  #said(cell, row, column) {
    const kind = cell.getAttribute("t") ?? "n";
    const value = all(cell, "v")[0]?.textContent ?? null;
    if (all(cell, "f").length && kind !== "str" && !value?.trim()) throw this.#untold(row, column);
    if (kind === "inlineStr") return all(cell, "is").map(textIn)[0] ?? null;
    if (value === null) return null;
    if (kind === "s") return this.#shared(value);
    if (kind === "b") return value === "1" ? "TRUE" : "FALSE";
    if (kind === "e") return "";
    if (kind === "d") return value.slice(0, "2026-03-05".length);
    if (kind !== "n") return value;
    const style = this.shown[Number(cell.getAttribute("s") ?? 0)] ?? "number";
    return this.#numberSaid(Number(value), style);
  }

  /** @param {string} number of a text that cells share */
  #shared(number) {
    const text = this.texts[Number(number)];
    if (text === undefined) throw torn(this.name);
    return text;
  }

  /** What is said of a formula whose value was not saved: its cell would read as empty. @param {number} row @param {number} column */
  #untold(row, column) {
    return new InputError(
      _(
        "{file}: the cell in row {row}, column {column} is a formula without a value: open the file in a spreadsheet and save it again",
        { file: this.name, row: row + 1, column: column + 1 },
      ),
    );
  }

  /** A number as its cell shows it: whole ones without decimals, days as 2026-03-05. @param {number} value @param {Shown} shown */
  #numberSaid(value, shown) {
    if (!Number.isFinite(value)) throw torn(this.name);
    if (shown === "length") return lengthText(value);
    if (shown === "day") return dayText(value, this.from1904);
    return numberText(value);
  }
}

/** The part that a workbook calls so. @param {string} target */
function partOf(target) {
  return target.startsWith("/") ? target.slice(1) : `xl/${target}`;
}

/** How a cell of a format shows its number. @param {string} format @returns {Shown} */
function shownAs(format) {
  const [first] = format.replace(QUOTED, "").split(";");
  if (LENGTH.test(first)) return "length";
  return /[dmhys]|am?\/p/i.test(first.replace(BRACKETS, "").replace(/general/i, "")) ? "day" : "number";
}

/** A number, without decimals if it is whole. @param {number} value */
function numberText(value) {
  return Number.isInteger(value) ? String(BigInt(value)) : pythonFloat(value);
}

/** Hours, minutes and seconds, as Python has them. @param {number} value ms */
function clockText(value) {
  const two = (/** @type {number} */ part) => String(Math.floor(part)).padStart(2, "0");
  const seconds = value / MILLISECONDS;
  const text = `${two(seconds / 3600)}:${two((seconds / 60) % 60)}:${two(seconds % 60)}`;
  const rest = value % MILLISECONDS;
  return rest ? `${text}.${String(rest).padStart(3, "0")}000` : text;
}

/** A day as a number of days, or within the first one a time. @param {number} value days @param {boolean} from1904 */
function dayText(value, from1904) {
  if (value > LAST_DAY) return numberText(value);
  if (value < 1) return clockText(Math.round(Math.max(value, 0) * DAY));
  // Workbooks count a day too many before March 1900.
  const days = from1904 ? value + 1462 : value < 60 ? value + 1 : value;
  const first = Date.UTC(1899, 11, 30);
  return new Date(first + Math.round(days * DAY)).toISOString().slice(0, 10);
}

/** A length of time as Python has it. @param {number} value days */
function lengthText(value) {
  const days = Math.floor(value);
  const clock = clockText(Math.round((value - days) * DAY)).replace(/^0/, "");
  return days ? `${days} day${Math.abs(days) === 1 ? "" : "s"}, ${clock}` : clock;
}
