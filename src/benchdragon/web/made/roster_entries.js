// @ts-nocheck
// Made from rosters/entries.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { ABOVE, LEFT } from "./roster_names.js";
import { Person } from "./roster_people.js";
import { DECIMALS, MADE_A_DAY, ROUNDED, clean, doubtful, isName, isSum, namesOf, places, plain, simple, withPlaces, withoutDashes, withoutPhones } from "./roster_words.js";

const MOST_SHOWN = 40;
export class Entry {
  constructor(row, benches, people, householder) {
    this.row = row;
    this.benches = benches;
    this.people = people;
    this.householder = householder;
  }
}
export class Unread {
  constructor(row, why, isSum = false) {
    this.row = row;
    this.why = why;
    this.is_sum = isSum;
  }
}
export function* entries(rows, first, block) {
  let benches, found, halved, head, household, number, numbers, odd, others, owner, people, row, said;
  head = (py.truth(first) ? py.list(py.at(rows, (first - 1))).map((cell) => plain(cell)) : []);
  benches = [];
  household = "";
  numbers = py.list(py.slice(rows, first, null)).map((row) => py.at(_cells(row, [block.number]), 0));
  halved = py.frozenset(py.list(numbers).flatMap((cell) => py.list(withPlaces(cell)).map((bench) => bench)));
  for ([number, row] of py.iter(_repeated(rows, first, block))) {
    if ((!py.list(row).some((one) => py.truth(one)) || py.eq(py.list(row).map((cell) => plain(cell)), head))) {
      continue;
    }
    if (py.truth(isSum(py.next(py.list(row).flatMap((cell) => ((py.truth(cell)) ? [cell] : [])))))) {
      benches = [];
      yield new Unread(number, py.filled(_("taken for a sum: {text}"), { text: _shown(row) }), true);
      continue;
    }
    if (!py.list(_cells(row, _all(block))).some((one) => py.truth(one))) {
      continue;
    }
    [said] = py.list(_cells(row, [block.number]));
    if (py.truth(said)) {
      found = (py.truth(doubtful(said, halved)) ? null : places(said, halved));
      [benches, household] = py.list([py.tuple(py.or(found, () => [])), ""]);
      if ((found == null)) {
        yield new Unread(number, _notANumber(said, row));
        continue;
      }
    }
    else {
      if (!py.truth(benches)) {
        yield new Unread(number, py.filled(_("no number of a bench: {text}"), { text: _shown(row) }));
        continue;
      }
    }
    [people, odd] = py.list(_people(row, block, household));
    owner = ((py.truth(people) || py.truth(odd)) ? [] : _householder(row, block));
    others = [...py.iter(block.households), ...py.iter(block.phones), ...py.iter(block.remarks)];
    if ((!(py.truth(people) || py.truth(odd) || py.truth(owner)) && py.list(_cells(row, others)).some((one) => py.truth(one)))) {
      odd = [py.filled(_("no name, only {text}"), { text: _shown(row) })];
    }
    people = py.or(people, () => owner);
    yield* py.iter(py.list(odd).map((text) => new Unread(number, text)));
    household = py.next(py.list(people).map((one) => one.household), household);
    if (py.truth(people)) {
      yield new Entry(number, benches, people, py.bool(owner));
    }
  }
}
function* _repeated(rows, first, block) {
  let above, n, named, number, row, said, told, whose, word;
  above = py.dict([]);
  for ([number, row] of py.iter(py.enumerate(py.slice(rows, first, null), (first + 1)))) {
    said = py.list(row);
    named = py.list(_cells(row, block.names)).some((cell) => py.has(ABOVE, simple(cell)));
    for (n of py.iter(_all(block))) {
      word = ((n < py.len(said)) ? simple(py.at(said, n)) : "");
      whose = py.and(named, () => py.and(!py.truth(word), () => py.has([...py.iter(block.households), ...py.iter(block.phones)], n)));
      if ((py.has(ABOVE, word) || py.truth(whose))) {
        said = py.extend(said, py.times([""], py.sub((n + 1), py.len(said))));
        told = (py.has(block.names, n) ? py.at(said, n) : "");
        py.set(said, n, (py.eq(n, block.number) ? "" : py.or(py.get(above, n, ""), () => told)));
      }
      else {
        if ((py.has(LEFT, word) && py.truth(n))) {
          py.set(said, n, py.at(said, (n - 1)));
        }
      }
    }
    if (py.list(_cells(said, _all(block))).some((one) => py.truth(one))) {
      above = py.dict(py.zip(_all(block), _cells(said, _all(block))));
    }
    yield [number, said];
  }
}
function _all(block) {
  return [block.number, ...py.iter(block.names), ...py.iter(block.households), ...py.iter(block.phones), ...py.iter(block.remarks)];
}
function _cells(row, columns) {
  return py.list(columns).map((n) => ((n < py.len(row)) ? py.at(row, n) : ""));
}
function _shown(row) {
  let text;
  text = clean(py.join(" ", py.list(row).map((cell) => py.at(withoutPhones(cell), 0))));
  return ((py.len(text) <= MOST_SHOWN) ? text : (py.slice(text, null, MOST_SHOWN) + "…"));
}
function _notANumber(said, row) {
  let _rest, comma, head, text;
  if (py.truth(MADE_A_DAY.fullmatch(said))) {
    text = _("the spreadsheet made a day of the bench's number ({text}): format the column as text");
    return py.filled(text, { text: said });
  }
  if (py.truth(places(said))) {
    text = _("{said} may be several benches, or a place at one: write {benches}, or the bench alone");
    return py.filled(text, { said: said, benches: withoutDashes(said) });
  }
  [head, comma, _rest] = py.list(py.partition(said, "，"));
  if ((py.truth(comma) && py.truth(places(head)) && (py.sum(py.list(row).map((one) => py.bool(one))) === 1))) {
    text = _("the comma behind {number} is a Chinese one (，): type an English one (,)");
    return py.filled(text, { number: clean(head) });
  }
  text = _("{said} is no number of a bench: {text}");
  return py.filled(text, { said: py.repr(_shown([said])), text: _shown(row) });
}
function _people(row, block, household) {
  let atHome, beside, cell, columns, each, hidden, home, homes, more, n, names, odd, own, people, phones, remarks, rest, said;
  [remarks, hidden] = py.list(_open(_cells(row, block.remarks)));
  [said, more] = py.list(_open(_cells(row, block.households)));
  household = py.or(said, () => household);
  [columns, homes] = py.list(_phoneColumns(block));
  atHome = py.list(_cells(row, homes)).flatMap((cell) => py.list(_phones(cell)).map((phone) => phone));
  home = py.join(" ", [...py.iter(atHome), ...py.iter(more)]);
  people = [];
  odd = py.list(_cells(row, block.phones)).flatMap((cell) => ((py.truth(ROUNDED.fullmatch(cell))) ? [_("the spreadsheet rounded a phone number: format the column as text")] : []));
  for ([n, [cell, beside]] of py.iter(py.enumerate(py.zip(_cells(row, block.names), columns)))) {
    [rest, phones] = py.list(withoutPhones(cell));
    own = py.list(_cells(row, beside)).flatMap((one) => py.list(_phones(one)).map((phone) => phone));
    own = py.extend(own, [...py.iter(phones), ...py.iter(((n === 0) ? hidden : []))]);
    names = namesOf(rest);
    odd = py.extend(odd, py.list(names).flatMap((name) => ((!py.truth(isName(name))) ? [py.filled(_("{text} is no name"), { text: _shown([name]) })] : [])));
    each = (py.eq(py.len(own), py.len(names)) ? own : py.times([py.join(" ", own)], py.len(names)));
    people = py.extend(people, py.list(py.zip(names, each)).flatMap(([name, phone]) => ((py.truth(isName(name))) ? [new Person(name, household, py.or(phone, () => (py.eq(name, household) ? home : "")), remarks, home)] : [])));
  }
  return [py.tuple(people), odd];
}
function _phoneColumns(block) {
  let before, headed, home, own, phone;
  if ((py.eq(py.len(block.phones), py.len(block.names)) && (py.len(block.names) > 1))) {
    return [py.list(block.phones).map((n) => [n]), []];
  }
  own = py.list(block.names).map((_column) => []);
  home = [];
  for (phone of py.iter(block.phones)) {
    before = py.sum(py.list(block.names).map((n) => (n < phone)));
    headed = ((py.len(block.names) > 1) || py.list(block.households).some((n) => (n < phone)));
    if (((before > 1) || (!py.truth(before) && py.truth(headed)))) {
      py.append(home, phone);
    }
    else {
      py.append(py.at(own, 0), phone);
    }
  }
  return [own, home];
}
function _householder(row, block) {
  let hidden, household, more, phone, remarks;
  if (py.list(_cells(row, block.names)).some((one) => py.truth(one))) {
    return [];
  }
  [household, hidden] = py.list(_open(_cells(row, block.households)));
  [remarks, more] = py.list(_open(_cells(row, block.remarks)));
  phone = py.join(" ", py.fromkeys([...py.iter(py.list(_cells(row, block.phones)).filter((one) => py.truth(one))), ...py.iter(hidden), ...py.iter(more)]));
  return py.tuple(py.list(namesOf(household)).flatMap((name) => ((py.truth(isName(name))) ? [new Person(name, household, phone, remarks)] : [])));
}
function _open(cells) {
  let split;
  split = py.list(cells).flatMap((cell) => ((py.truth(cell)) ? [withoutPhones(cell)] : []));
  return [clean(py.join(" ", py.list(split).map(([text, _phones]) => text))), py.tuple(py.list(split).flatMap(([_t, ps]) => py.list(ps).map((p) => p)))];
}
function _phones(cell) {
  let phones, rest;
  [rest, phones] = py.list(withoutPhones(DECIMALS.sub("", cell)));
  return (!py.truth(py.strip(rest, " ,;、，；/")) ? phones : (py.truth(cell) ? [clean(cell)] : []));
}
