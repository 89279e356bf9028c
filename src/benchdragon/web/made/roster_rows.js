// @ts-nocheck
// Made from rosters/grid.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _cells, readings } from "../compute/roster_text.js";
import { _ } from "../words.js";
import { tooLarge } from "./roster_limits.js";
import { heading } from "./roster_words.js";

const MOST_ROWS = 20000;
const MOST_COLUMNS = 100;
const MOST_CELLS = 100000;
const MOST_SIGNS = 1000;
const MOST_TITLES = 30;
const MARKS = "\t,;";
const CHINESE_MARKS = "，；";
const NUMBER_END = py.pattern("(?<=[^\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000])[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000:：，]+", "");
const QUOTED = py.dict([["\t", py.pattern("(?:^|(?<=[\t\\r\\n]))\"(?:(?=[ \\t]*(?:[\t\\r\\n]|(?![\\s\\S])))|[^\"]*(?:\"\"[^\"]*)*(?:\"|(?![\\s\\S])))", "")], [",", py.pattern("(?:^|(?<=[,\\r\\n]))\"(?:(?=[ \\t]*(?:[,\\r\\n]|(?![\\s\\S])))|[^\"]*(?:\"\"[^\"]*)*(?:\"|(?![\\s\\S])))", "")], [";", py.pattern("(?:^|(?<=[;\\r\\n]))\"(?:(?=[ \\t]*(?:[;\\r\\n]|(?![\\s\\S])))|[^\"]*(?:\"\"[^\"]*)*(?:\"|(?![\\s\\S])))", "")], ["，", py.pattern("(?:^|(?<=[，\\r\\n]))\"(?:(?=[ \\t]*(?:[，\\r\\n]|(?![\\s\\S])))|[^\"]*(?:\"\"[^\"]*)*(?:\"|(?![\\s\\S])))", "")], ["；", py.pattern("(?:^|(?<=[；\\r\\n]))\"(?:(?=[ \\t]*(?:[；\\r\\n]|(?![\\s\\S])))|[^\"]*(?:\"\"[^\"]*)*(?:\"|(?![\\s\\S])))", "")]]);
const ABOVE = "〃";
const PAIRS = py.pattern("[\\x81-\\xfe](?:[0-9][\\x81-\\xfe][0-9]|[\\x40-\\xfe])", "");
const GB_COMMON = py.pattern("[\\xa1-\\xa3\\xb0-\\xf7][\\xa1-\\xfe]", "");
const BIG5_COMMON = py.pattern("[\\xa1-\\xa3\\xa4-\\xc6][\\x40-\\x7e\\xa1-\\xfe]", "");
const COMMON = 9;
const ALL_BUT = 4;
const NO_TEXT = py.pattern("[\u0000-\b\u000e-\u0019\u001b-\u001f]", "");
export function limited(rows, name) {
  let filled;
  if (((py.len(rows) > MOST_ROWS) || (py.sum(py.list(rows).map((one) => py.len(one))) > (MOST_ROWS * MOST_COLUMNS)))) {
    throw tooLarge(name);
  }
  filled = py.list(rows).flatMap((row) => py.list(py.enumerate(row)).flatMap(([column, cell]) => ((py.truth(cell)) ? [[column, cell]] : [])));
  if (!py.truth(filled)) {
    throw new InputError(py.filled(_("{file} is empty"), { file: name }));
  }
  if (((py.len(filled) > MOST_CELLS) || py.list(filled).some(([c, t]) => ((c >= MOST_COLUMNS) || (py.len(t) > MOST_SIGNS))))) {
    throw tooLarge(name);
  }
  return rows;
}
export function textRows(text, name) {
  let closed, columns, first, mark, rows;
  first = py.list(py.splitlines(text)).map((line) => py.next(py.list(line).flatMap((sign) => ((py.has(MARKS, sign)) ? [sign] : [])), ""));
  [mark, columns] = py.list(_chineseMark(py.slice(py.splitlines(text), null, MOST_TITLES)));
  if (!py.truth(mark)) {
    mark = py.max(MARKS, (given) => py.count(first, given));
  }
  if ((!py.has(first, mark) && !py.truth(columns))) {
    return _within(py.list(py.splitlines(text)).map((line) => py.split(NUMBER_END, line, 1)), name);
  }
  closed = py.at(QUOTED, mark).sub((found) => _closed(found, text, name), text);
  rows = _within(_cells(closed, mark, name), name);
  return py.list(rows).map((row) => (((columns === 2) && py.truth(row)) ? [py.at(row, 0), py.join(mark, py.slice(row, 1, null))] : row));
}
function _closed(found, text, name) {
  let said;
  if ((py.at(found, 0) === "\"")) {
    return ABOVE;
  }
  if (((py.len(py.at(found, 0)) === 1) || !py.endswith(py.at(found, 0), "\"") || py.truth(py.mod(py.count(py.at(found, 0), "\""), 2)))) {
    said = _("{file} is no table of text: the quotation mark in line {line} is never closed");
    throw new InputError(py.filled(said, { file: name, line: (py.count(text, "\n", 0, found.start()) + 1) }));
  }
  return py.at(found, 0);
}
function _chineseMark(lines) {
  let cells, known, line, mark;
  for (mark of py.iter(CHINESE_MARKS)) {
    for (line of py.iter(lines)) {
      cells = py.split(line, mark);
      known = py.sum(py.list(cells).map((cell) => (heading(cell) != null)));
      if (((known > 1) && !py.list(MARKS).some((sign) => py.has(line, sign)))) {
        return [mark, py.len(cells)];
      }
    }
  }
  return ["", 0];
}
function _within(rows, name) {
  let found, number, row;
  found = [];
  for ([number, row] of py.iter(py.enumerate(rows))) {
    if ((number >= MOST_ROWS)) {
      throw tooLarge(name);
    }
    py.append(found, py.list(row).map((cell) => py.strip(cell)));
  }
  return found;
}
export function decoded(data, name) {
  let said, text;
  for (text of py.iter(readings(data, _legacy(data, name)))) {
    if (py.truth(isText(text, name))) {
      return text;
    }
  }
  said = _("{file} is no table of text in UTF-8, GB18030 or Big5: save it as XLSX, or as CSV in UTF-8");
  throw new InputError(py.filled(said, { file: name }));
}
export function isText(text, name) {
  let found, line, said;
  found = NO_TEXT.search(text);
  if (((found == null) || py.has(text, "\u0000"))) {
    return (found == null);
  }
  said = _("{file}: line {line} has a control sign ({sign}), which no text has: delete it");
  line = (py.count(text, "\n", 0, found.start()) + 1);
  throw new InputError(py.filled(said, { file: name, line: line, sign: `U+${py.format(py.ord(py.at(found, 0)), `04X`)}` }));
}
function* _legacy(data, name) {
  let big5, gb, line, pairs, said, sound, torn, whole;
  whole = py.decode(data, "utf-8", "replace");
  [torn, sound] = py.list([py.count(whole, "�"), py.sum(py.list(whole).map((sign) => (sign > "")))]);
  if ((py.truth(torn) && (py.sub(sound, torn) > (ALL_BUT * torn)))) {
    said = _("{file}: line {line} is torn: what stands there is no UTF-8, as the rest is; save it anew");
    line = (py.count(whole, "\n", 0, py.index(whole, "�")) + 1);
    throw new InputError(py.filled(said, { file: name, line: line }));
  }
  pairs = PAIRS.findall(py.decode(data, "latin-1"));
  big5 = py.sum(py.list(pairs).map((one) => (BIG5_COMMON.fullmatch(one) != null)));
  gb = py.sum(py.list(pairs).map((one) => (GB_COMMON.fullmatch(one) != null)));
  if (((big5 > gb) && ((10 * big5) >= (COMMON * py.len(pairs))))) {
    yield "big5hkscs";
  }
  yield "gb18030";
}
