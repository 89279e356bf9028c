// @ts-nocheck
// Made from rosters/reading.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _, language } from "../words.js";
import { layout, letters } from "./roster_columns.js";
import { Entry, Unread, entries } from "./roster_entries.js";
import { likeTwo } from "./roster_names.js";
import { Person, Roster } from "./roster_people.js";
import { plain } from "./roster_words.js";

const MOST_SHOWN = 40;
const MOST_PEOPLE = 50000;
const MOST_NOTES = 100;
const SEVERAL = py.pattern("[㐀-䶿一-鿿𠀀-𿿿]{5,}", "");
const MOST_A_BENCH = 200;
const MOST_LISTED = 30;
export class Numbering {
  constructor(count, countHead, called) {
    this.count = count;
    this.count_head = countHead;
    this.called = called;
  }
  bench(place) {
    if (py.truth(place.end)) {
      return ((place.end === "head") ? 1 : this.count);
    }
    return (py.truth(this.count_head) ? place.number : (place.number + 1));
  }
}
class _Seat {
  constructor(bench, person, row) {
    this.bench = bench;
    this.person = person;
    this.row = row;
  }
}
export function rosterOf(rows, name, numbering) {
  let benches, beyond, entry, found, foundBenches, kept, notes, odd, said, seat, seats, taken, text, told, twice, unread;
  found = layout(rows, name);
  told = py.list(found.blocks).flatMap((block) => py.list(entries(rows, found.first, block)).map((one) => one));
  said = py.list(told).flatMap((one) => (((one instanceof Entry)) ? [one] : []));
  unread = py.list(told).flatMap((one) => (((one instanceof Unread)) ? [one] : []));
  seats = [];
  taken = [];
  odd = [];
  for (entry of py.iter(said)) {
    [benches, beyond] = py.list(_benches(entry.benches, numbering));
    taken = py.extend(taken, _householders(entry));
    odd = py.extend(odd, _ofEntry(entry, numbering));
    if (py.truth(beyond)) {
      py.append(odd, _stranger(entry, beyond, numbering));
    }
    if ((py.add(py.len(seats), (py.len(benches) * py.len(entry.people))) > MOST_PEOPLE)) {
      text = _("{file} names more than {most} people");
      throw new InputError(py.filled(text, { file: name, most: MOST_PEOPLE }));
    }
    if ((py.len(benches) > 1)) {
      py.append(odd, _shared(entry, benches, numbering));
    }
    seats = py.extend(seats, _seated(entry, benches));
  }
  [kept, twice] = py.list(_once(seats, numbering, name));
  foundBenches = py.dict([]);
  for (seat of py.iter(py.sorted(kept, (seat) => seat.bench))) {
    py.set(foundBenches, seat.bench, [...py.iter(py.get(foundBenches, seat.bench, [])), seat.person]);
  }
  notes = [...py.iter(_who(found)), ...py.iter(firstNotes(_unread(unread, false))), ...py.iter(firstNotes(taken))];
  notes = py.extend(notes, [...py.iter(firstNotes(odd)), ...py.iter(firstNotes(twice)), ...py.iter(firstNotes(_atTwo(kept, numbering)))]);
  notes = py.extend(notes, [...py.iter(firstNotes(_apart(said, numbering))), ...py.iter(_columns(found))]);
  notes = py.extend(notes, [...py.iter(firstNotes(_unread(unread, true))), ...py.iter(_holes(foundBenches, numbering))]);
  return new Roster(foundBenches, py.tuple(py.fromkeys(notes)));
}
function* _who(found) {
  let block, number, text;
  if (py.truth(found.guessed)) {
    block = py.at(found.blocks, 0);
    number = letters(block.number);
    text = _("there is no row of headings: column {number} is read as numbers, {names} as names");
    yield py.filled(text, { number: number, names: _listed(py.list(block.names).map((one) => letters(one))) });
  }
  if (py.truth(found.householders)) {
    yield _("there is no column of names: householders are read as those who carry");
  }
}
function* _columns(found) {
  let text;
  if (py.truth(found.unread)) {
    text = _("columns that are not read: {columns}");
    yield py.filled(text, { columns: _listed(py.list(found.unread).map((name) => py.slice(name, null, MOST_SHOWN))) });
  }
}
function _unread(found, sums) {
  let text;
  text = _("row {row} was not read: {why}");
  return py.list(found).flatMap((one) => ((py.eq(one.is_sum, sums)) ? [py.filled(text, { row: one.row, why: one.why })] : []));
}
function _benches(said, numbering) {
  let beyond, ends, high, inside, low;
  inside = py.dict([]);
  beyond = [];
  for (ends of py.iter(said)) {
    [low, high] = py.list(py.sorted(py.list(ends).map((one) => numbering.bench(one))));
    inside = py.merge(inside, py.fromkeys(py.range(py.max(low, 1), (py.min(high, numbering.count) + 1))));
    if ((low < 1)) {
      py.append(beyond, [low, py.min(high, 0)]);
    }
    if ((high > numbering.count)) {
      py.append(beyond, [py.max(low, (numbering.count + 1)), high]);
    }
  }
  return [py.list(inside), beyond];
}
function _seated(entry, benches) {
  let each;
  if (!py.truth(_dealt(entry, benches))) {
    return py.list(benches).flatMap((bench) => py.list(entry.people).map((person) => new _Seat(bench, person, entry.row)));
  }
  each = py.div(py.len(entry.people), py.len(benches));
  return py.list(py.enumerate(entry.people)).map(([n, person]) => new _Seat(py.at(benches, py.div(n, each)), person, entry.row));
}
function _dealt(entry, benches) {
  return ((py.len(entry.people) > 1) && (py.len(benches) > 1) && (py.mod(py.len(entry.people), py.len(benches)) === 0));
}
function _shared(entry, benches, numbering) {
  let text;
  text = _("row {row}: {names} stand at each of {benches}");
  if ((py.len(entry.people) === 1)) {
    text = _("row {row}: {names} stands at each of {benches}");
  }
  else {
    if (py.truth(_dealt(entry, benches))) {
      text = _("row {row}: {names} are dealt to {benches} in order");
    }
  }
  return py.filled(text, { row: entry.row, names: _names(entry.people), benches: _called(benches, numbering) });
}
function* _householders(entry) {
  let told;
  if (py.truth(entry.householder)) {
    told = _("row {row}: no name: the householder, {names}, is read as who carries");
    yield py.filled(told, { row: entry.row, names: _names(entry.people) });
  }
}
function* _ofEntry(entry, numbering) {
  let ends, long, person, text;
  ends = py.list(entry.benches).flatMap((pair) => py.list(pair).map((place) => place));
  if ((!py.truth(numbering.count_head) && py.list(ends).some((place) => (!py.truth(place.number) && !py.truth(place.end))))) {
    yield py.filled(_("row {row}: bench 0 is taken for the head"), { row: entry.row });
  }
  text = _("row {row}: {name} is a name of one sign: part names by 、 and not by spaces");
  long = _("row {row}: {name} is taken for one person: if they are several, part their names by 、");
  for (person of py.iter(entry.people)) {
    if ((py.len(person.name) === 1)) {
      yield py.filled(text, { row: entry.row, name: person.name });
    }
    else {
      if ((py.truth(SEVERAL.fullmatch(person.name)) || py.truth(likeTwo(person.name)))) {
        yield py.filled(long, { row: entry.row, name: person.name });
      }
    }
  }
}
function _stranger(entry, beyond, numbering) {
  let benches, text;
  benches = _listed(py.list(beyond).map(([low, high]) => _span(low, high, numbering)));
  text = _("row {row}: the dragon of {count} benches has no {benches}: {names}");
  return py.filled(text, { row: entry.row, count: numbering.count, benches: benches, names: _names(entry.people) });
}
function _once(seats, numbering, name) {
  let alike, at, called, first, found, namesakes, notes, said, seat, text, there;
  found = py.dict([]);
  namesakes = py.dict([]);
  notes = [];
  text = _("{name} is named twice at {bench}: in rows {first} and {row}");
  for (seat of py.iter(seats)) {
    there = py.setdefault(found, seat.bench, []);
    alike = py.setdefault(namesakes, [seat.bench, plain(seat.person.name)], []);
    at = py.next(py.list(alike).flatMap((n) => ((py.truth(_same(py.at(there, n).person, seat.person))) ? [n] : [])), null);
    if ((at == null)) {
      py.append(alike, py.len(there));
      py.append(there, seat);
    }
    else {
      first = py.at(there, at);
      py.set(there, at, new _Seat(seat.bench, _fuller(first.person, seat.person), first.row));
      called = numbering.called(seat.bench);
      py.append(notes, py.filled(text, { name: seat.person.name, bench: called, first: first.row, row: seat.row }));
    }
    if ((py.len(there) > MOST_A_BENCH)) {
      said = _("{file} names more than {most} people at {bench}");
      called = numbering.called(seat.bench);
      throw new InputError(py.filled(said, { file: name, most: MOST_A_BENCH, bench: called }));
    }
  }
  return [py.list(py.values(found)).flatMap((there) => py.list(there).map((seat) => seat)), notes];
}
function _same(one, other) {
  let pairs;
  pairs = [[one.household, other.household], [one.phone, other.phone]];
  return py.list(pairs).every(([a, b]) => (py.eq(a, b) || !(py.truth(a) && py.truth(b))));
}
function _fuller(one, other) {
  let household, pairs, phone, remarks;
  remarks = (py.has(one.remarks, other.remarks) ? one.remarks : py.strip(`${py.str(one.remarks)} ${py.str(other.remarks)}`));
  pairs = [[one.household, other.household], [one.phone, other.phone]];
  [household, phone] = py.list(py.list(pairs).map(([a, b]) => py.or(a, () => b)));
  return new Person(one.name, household, phone, remarks, py.or(one.home_phone, () => other.home_phone));
}
function* _atTwo(seats, numbering) {
  let benches, found, group, named, rows, seat, text;
  named = py.dict([]);
  for (seat of py.iter(seats)) {
    py.append(py.setdefault(named, plain(seat.person.name), []), seat);
  }
  text = _("{name} is named at {benches}: in rows {rows}");
  for (found of py.iter(py.values(named))) {
    for (group of py.iter(_alike(found))) {
      rows = py.sorted(py.set_of(py.list(group).map((seat) => seat.row)));
      benches = py.sorted(py.set_of(py.list(group).map((seat) => seat.bench)));
      if (((py.len(rows) > 1) && (py.len(benches) > 1))) {
        yield py.filled(text, { name: py.at(group, 0).person.name, benches: _called(benches, numbering), rows: _listed(py.list(rows).map((one) => py.str(one))) });
      }
    }
  }
}
function* _apart(said, numbering) {
  let _beyond, bench, benches, entry, found, listed, rows, seldom, text;
  rows = py.dict([]);
  for (entry of py.iter(said)) {
    [benches, _beyond] = py.list(_benches(entry.benches, numbering));
    if ((py.len(benches) === 1)) {
      py.append(py.setdefault(rows, py.at(benches, 0), []), entry);
    }
  }
  text = _("{bench} is in rows {rows}: all of their people are taken for it");
  seldom = ((2 * py.sum(py.list(py.values(rows)).map((found) => (py.len(found) > 1)))) < py.len(rows));
  for ([bench, found] of py.iter(py.sorted(py.items(rows)))) {
    if (py.list(py.pairwise(found)).some(([before, after]) => ((py.sub(after.row, before.row) > 1) || !py.eq(after.benches, before.benches) || py.truth(seldom)))) {
      listed = _listed(py.list(found).map((entry) => py.str(entry.row)));
      yield py.filled(text, { bench: numbering.called(bench), rows: listed });
    }
  }
}
function _alike(seats) {
  let groups, mark, seat;
  groups = py.dict(py.list(seats).map((seat) => [py.or(seat.person.household, () => seat.person.phone), []]));
  if (py.has(groups, "")) {
    return [py.list(seats)];
  }
  for (seat of py.iter(seats)) {
    for (mark of py.iter(py.both(py.set_of([seat.person.household, seat.person.phone]), py.keys(groups)))) {
      py.append(py.at(groups, mark), seat);
    }
  }
  return py.list(py.sorted(groups)).map((mark) => py.at(groups, mark));
}
function _holes(benches, numbering) {
  let empty, text;
  empty = py.list(py.range(1, (numbering.count + 1))).flatMap((bench) => ((!py.has(benches, bench)) ? [bench] : []));
  text = _("nobody is named for {benches}");
  return (py.truth(empty) ? [py.filled(text, { benches: _called(empty, numbering) })] : []);
}
function _called(benches, numbering) {
  let bench, high, low, pair, spans, told;
  spans = [];
  for (bench of py.iter(py.sorted(benches))) {
    if ((py.truth(spans) && py.eq(bench, (py.at(py.at(spans, -1), 1) + 1)))) {
      py.set(py.at(spans, -1), 1, bench);
    }
    else {
      py.append(spans, [bench, bench]);
    }
  }
  told = [];
  for ([low, high] of py.iter(spans)) {
    pair = (py.sub(high, low) === 1);
    told = py.extend(told, (py.truth(pair) ? [numbering.called(low), numbering.called(high)] : [_span(low, high, numbering)]));
  }
  return _listed(told);
}
function _span(low, high, numbering) {
  if (py.eq(low, high)) {
    return numbering.called(low);
  }
  return py.filled(_("{first} to {last}"), { first: numbering.called(low), last: numbering.called(high) });
}
function _names(people) {
  return _listed(py.list(people).map((person) => person.name));
}
function _listed(words) {
  let found, shown;
  found = py.list(words);
  shown = py.slice(found, null, MOST_LISTED);
  if ((py.len(found) > MOST_LISTED)) {
    py.append(shown, py.filled(_("and {count} more"), { count: py.sub(py.len(found), MOST_LISTED) }));
  }
  return py.join(((language() === "zh") ? "、" : ", "), shown);
}
function firstNotes(notes) {
  let found;
  found = py.list(notes);
  if ((py.len(found) <= MOST_NOTES)) {
    return found;
  }
  return [...py.iter(py.slice(found, null, MOST_NOTES)), py.filled(_("and {count} more"), { count: py.sub(py.len(found), MOST_NOTES) })];
}
