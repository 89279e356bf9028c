// @ts-nocheck
// Made from rosters/columns.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { likePeople } from "./roster_names.js";
import { heading, isName, isOther, namesOf, places, plain, withoutPhones } from "./roster_words.js";

const MOST_TITLES = 30;
const MOST_LOOKED_AT = 50;
const LEAST_NAMES = 2;
const MOST_HEADING = 40;
class Columns {
  constructor(number = -1, names = py.list(), households = py.list(), phones = py.list(), remarks = py.list()) {
    this.number = number;
    this.names = names;
    this.households = households;
    this.phones = phones;
    this.remarks = remarks;
  }
}
class Layout {
  constructor(first, blocks, unread, guessed, householders = false) {
    this.first = first;
    this.blocks = blocks;
    this.unread = unread;
    this.guessed = guessed;
    this.householders = householders;
  }
}
export function layout(rows, name) {
  let block, blocks, found, householders, left, nameless, number, others, row, taken, text, told, unread;
  for ([number, row] of py.iter(py.enumerate(py.slice(rows, null, MOST_TITLES)))) {
    [blocks, unread] = py.list(_blocks(row));
    if (!py.truth(blocks)) {
      continue;
    }
    nameless = py.list(py.range(_width(py.slice(rows, number, null)))).flatMap((n) => ((!((n < py.len(row)) && py.truth(py.at(row, n)))) ? [n] : []));
    householders = py.list(blocks).some((block) => py.eq(block.names, block.households));
    _refuseNames(rows, (number + 1), [...py.iter(unread), ...py.iter(nameless)], householders, name);
    others = py.list(_firstRows(rows, (number + 1), nameless)).map(([n, rowOf]) => py.filled(_("{column} (row {row})"), { column: letters(n), row: rowOf }));
    told = [...py.iter(py.list(unread).map((n) => py.at(row, n))), ...py.iter(others)];
    return new Layout((number + 1), py.tuple(blocks), told, false, householders);
  }
  _refuseHalf(rows, name);
  found = _guessed(rows);
  if ((found == null)) {
    text = _("{file}: no column of bench numbers with names beside it was found; write a first row such as: 桥号, 姓名, 户主, 电话, 备注 (bench, name, household, phone, remarks)");
    throw new InputError(py.filled(text, { file: name }));
  }
  [block] = py.list(found.blocks);
  taken = [block.number, ...py.iter(block.names), ...py.iter(block.phones)];
  left = py.list(py.range(_width(rows))).flatMap((n) => ((!py.has(taken, n)) ? [n] : []));
  _refuseNames(rows, found.first, left, false, name);
  return found;
}
function _refuseHalf(rows, name) {
  let filled, kind, kinds, number, row, text;
  for ([number, row] of py.iter(py.enumerate(py.slice(rows, null, MOST_TITLES), 1))) {
    filled = py.list(row).flatMap((cell) => ((py.truth(cell)) ? [cell] : []));
    kinds = py.set_of(py.list(filled).flatMap((cell) => ((py.truth((kind = heading(cell)))) ? [py.at(kind, 0)] : [])));
    if (((py.len(filled) < LEAST_NAMES) || py.list(py.list(filled).map((one) => places(one))).some((one) => py.truth(one)))) {
      continue;
    }
    text = "";
    if (py.has(kinds, "number")) {
      text = _("{file}: row {row} has headings, but none that is known for those who carry ({said}): write 姓名 (name) over their column");
    }
    else {
      if (py.truth(py.both(kinds, py.set_of(["name", "household"])))) {
        text = _("{file}: row {row} has headings, but none that is known for the numbers of benches ({said}): write 桥号 (bench) over their column");
      }
    }
    if (py.truth(text)) {
      throw new InputError(py.filled(text, { file: name, row: number, said: py.slice(py.join(", ", filled), null, MOST_HEADING) }));
    }
  }
}
function _refuseNames(rows, first, columns, allWords, name) {
  let cells, head, n, people, said, text, words;
  head = (py.truth(first) ? py.at(rows, (first - 1)) : []);
  for (n of py.iter(columns)) {
    said = ((n < py.len(head)) ? py.at(head, n) : "");
    cells = py.list(py.slice(rows, first, null)).flatMap((row) => ((((n < py.len(row)) && py.truth(py.at(row, n)))) ? [py.at(row, n)] : []));
    if ((py.truth(isOther(said)) || py.truth((py.truth(said) ? heading(said) : null)))) {
      continue;
    }
    people = py.sum(py.list(cells).map((cell) => py.list(py.list(namesOf(cell)).map((one) => likePeople(one))).some((one) => py.truth(one))));
    words = py.and(allWords, () => py.and(said, () => _mostly(cells, _holdsNames)));
    if ((!py.truth(words) && ((people < (py.truth(said) ? 1 : LEAST_NAMES)) || ((2 * people) <= py.len(cells))))) {
      continue;
    }
    text = _("{file}: names stand in column {column}, which has no heading: write over it 姓名 (name) if those carry, 户主 (household) if the benches are theirs, 备注 (remarks) if neither");
    if (py.truth(said)) {
      text = _("{file}: names stand in column {column}, whose heading, {heading}, is not known: write 姓名 (name) in its place if those carry, 户主 (household) if the benches are theirs, 备注 (remarks) if neither");
    }
    throw new InputError(py.filled(text, { file: name, column: letters(n), heading: py.slice(said, null, MOST_HEADING) }));
  }
}
function _width(rows) {
  return py.max(py.list(rows).map((one) => py.len(one)), undefined, 0);
}
function _filled(rows, columns) {
  return py.list(columns).flatMap((n) => ((py.list(rows).some((row) => ((n < py.len(row)) && py.truth(py.at(row, n))))) ? [n] : []));
}
function* _firstRows(rows, first, columns) {
  let column, found, n;
  for (column of py.iter(columns)) {
    found = py.list(py.range(first, py.len(rows))).flatMap((n) => ((((column < py.len(py.at(rows, n))) && py.truth(py.at(py.at(rows, n), column)))) ? [n] : []));
    for (n of py.iter(py.islice(found, 1))) {
      yield [column, (n + 1)];
    }
  }
}
function _blocks(row) {
  let block, blocks, cell, kind, known, n, numbered, of, rank, unread, whole;
  blocks = [new Columns()];
  unread = [];
  [rank, numbered] = py.list([0, ""]);
  for ([n, cell] of py.iter(py.enumerate(row))) {
    known = (py.truth(cell) ? heading(cell) : null);
    if ((known == null)) {
      unread = py.extend(unread, (py.truth(cell) ? [n] : []));
      continue;
    }
    [kind, of] = py.list(known);
    if ((kind !== "number")) {
      py.append(_column(py.at(blocks, -1), kind), n);
    }
    else {
      if (((py.at(blocks, -1).number < 0) || py.eq(plain(cell), numbered))) {
        if ((py.at(blocks, -1).number >= 0)) {
          py.append(blocks, new Columns());
        }
        [py.at(blocks, -1).number, rank, numbered] = py.list([n, of, plain(cell)]);
      }
      else {
        if ((of < rank)) {
          py.append(unread, py.at(blocks, -1).number);
          [py.at(blocks, -1).number, rank, numbered] = py.list([n, of, plain(cell)]);
        }
        else {
          py.append(unread, n);
        }
      }
    }
  }
  for (block of py.iter(blocks)) {
    block.names = py.or(block.names, () => py.list(block.households));
  }
  whole = py.list(blocks).every((block) => ((block.number >= 0) && py.truth(block.names)));
  return (py.truth(whole) ? [blocks, unread] : [[], []]);
}
function _column(block, kind) {
  let lists;
  lists = py.dict([["name", block.names], ["household", block.households], ["phone", block.phones], ["remarks", block.remarks]]);
  return py.at(lists, kind);
}
function _guessed(rows) {
  let block, cells, columns, first, lookedAt, names, number, others, phones, unread;
  lookedAt = py.slice(py.list(rows).flatMap((row) => ((py.list(row).some((one) => py.truth(one))) ? [row] : [])), null, MOST_LOOKED_AT);
  columns = py.range(_width(lookedAt));
  cells = py.list(columns).map((n) => py.list(lookedAt).flatMap((row) => ((((n < py.len(row)) && py.truth(py.at(row, n)))) ? [py.at(row, n)] : [])));
  number = py.next(py.list(columns).flatMap((n) => ((py.truth(_mostly(py.at(cells, n), (cell) => py.bool(places(cell))))) ? [n] : [])), null);
  if ((number == null)) {
    return null;
  }
  names = py.next(py.list(columns).flatMap((n) => ((((n > number) && py.truth(_mostly(py.at(cells, n), _holdsNames)))) ? [n] : [])), null);
  if ((names == null)) {
    return null;
  }
  phones = py.list(columns).flatMap((n) => (((!py.eq(n, number) && py.truth(_mostly(py.at(cells, n), _isPhone)))) ? [n] : []));
  block = new Columns(number, [names], undefined, phones);
  others = py.list(py.range(_width(rows))).flatMap((n) => ((!py.has([number, names, ...py.iter(phones)], n)) ? [n] : []));
  first = py.next(py.list(py.enumerate(rows)).flatMap(([n, row]) => ((((number < py.len(row)) && py.truth(places(py.at(row, number))))) ? [n] : [])));
  unread = py.tuple(py.list(_filled(py.slice(rows, first, null), others)).map((n) => letters(n)));
  return new Layout(first, [block], unread, true);
}
function _mostly(cells, wanted) {
  return (py.bool(cells) && ((2 * py.sum(py.list(cells).map((one) => wanted(one)))) > py.len(cells)));
}
function _holdsNames(cell) {
  let names;
  names = namesOf(cell);
  return (py.bool(names) && py.list(py.list(names).map((one) => isName(one))).every((one) => py.truth(one)) && !py.truth(places(cell)));
}
function _isPhone(cell) {
  let phones, rest;
  [rest, phones] = py.list(withoutPhones(cell));
  return (py.bool(phones) && !py.list(rest).some((sign) => py.isalpha(sign)));
}
export function letters(column) {
  let rest, text;
  text = "";
  column = py.extend(column, 1);
  while (py.truth(column)) {
    [column, rest] = py.list(py.divmod((column - 1), 26));
    text = py.add(py.chr(py.add(py.ord("A"), rest)), text);
  }
  return text;
}
