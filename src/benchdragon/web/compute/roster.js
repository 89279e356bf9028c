// A roster from a list of names: who carries which bench, and what is odd about the list. Twin of
// rosters/reading.py.

import { _, language } from "../words.js";
import { ROSTERS_ENTRIES, ROSTERS_READING } from "./constants.js";
import { InputError } from "./errors.js";
import { layout, letters } from "./roster_columns.js";
import { entries } from "./roster_entries.js";
import { likeTwo } from "./roster_names.js";
import { plain } from "./roster_words.js";

/** @typedef {import("./roster_columns.js").Layout} Layout */
/** @typedef {import("./roster_entries.js").Entry} Entry */
/** @typedef {import("./roster_entries.js").Person} Person */
/** @typedef {import("./roster_entries.js").Unread} Unread */
/** @typedef {import("./roster_words.js").Place} Place */

/**
 * How a village numbers the benches of a dragon.
 * @typedef {object} Numbering
 * @property {number} count of benches
 * @property {boolean} countHead whether the head's bench is number 1; else 1 is the next
 * @property {(bench: number) => string} called what a bench (number, from 1) is called
 */

/** A person at a bench, and the row that says so. @typedef {{ bench: number, person: Person, row: number }} Seat */

/** The people of each bench that has any, by its number, 1 being the head's; and what is odd about the list, in words. @typedef {{ benches: Map<number, Person[]>, notes: string[] }} Roster */

const { MOST_PEOPLE, MOST_NOTES, MOST_A_BENCH, MOST_LISTED } = ROSTERS_READING;
/** Chinese signs without a dot between them of which hardly a name has so many: of two people, perhaps. */
const SEVERAL = /^[\u3400-\u4dbf\u4e00-\u9fff\u{20000}-\u{3ffff}]{5,}$/u;

/** Who carries which bench, as the rows of a list say it; `name` is the list's. @param {string[][]} rows @param {string} name @param {Numbering} numbering @returns {Roster} */
export function readRoster(rows, name, numbering) {
  const found = layout(rows, name);
  const told = found.blocks.flatMap((block) => entries(rows, found.first, block));
  const said = told.flatMap((one) => ("people" in one ? [one] : []));
  const unread = told.flatMap((one) => ("why" in one ? [one] : []));
  const { seats, odd, taken } = seated(said, numbering, name);
  const { kept, notes: twice } = once(seats, numbering, name);
  /** @type {Map<number, Person[]>} */
  const benches = new Map();
  for (const { bench, person } of [...kept].sort((a, b) => a.bench - b.bench)) {
    const there = benches.get(bench);
    if (there) there.push(person);
    else benches.set(bench, [person]);
  }
  // First what decides who is printed where; last benches of nobody.
  const notes = [
    ...who(found),
    ...some(ofUnread(unread, false)),
    ...some(taken),
    ...some(odd),
    ...some(twice),
    ...some(atTwo(kept, numbering)),
    ...some(apart(said, numbering)),
    ...ofColumns(found),
    ...some(ofUnread(unread, true)),
    ...holes(benches, numbering),
  ];
  return { benches, notes: [...new Set(notes)] };
}

/** What of a list's columns decides who carries. @param {Layout} found */
function who({ guessed, householders, blocks: [block] }) {
  const said = [];
  if (guessed)
    said.push(
      _("there is no row of headings: column {number} is read as numbers, {names} as names", {
        number: letters(block.number),
        names: listed(block.names.map(letters)),
      }),
    );
  if (householders)
    said.push(_("there is no column of names: householders are read as those who carry"));
  return said;
}

/** @param {Layout} found */
function ofColumns({ unread }) {
  const { MOST_SHOWN } = ROSTERS_ENTRIES;
  const columns = listed(unread.map((name) => Array.from(name).slice(0, MOST_SHOWN).join("")));
  return unread.length ? [_("columns that are not read: {columns}", { columns })] : [];
}

/** @param {Unread[]} unread @param {boolean} sums */
function ofUnread(unread, sums) {
  return unread
    .filter(({ isSum = false }) => isSum === sums)
    .map(({ row, why }) => _("row {row} was not read: {why}", { row, why }));
}

/** Who sits where as rows say it, and what of them is odd. @param {Entry[]} said @param {Numbering} numbering @param {string} name */
function seated(said, numbering, name) {
  /** @type {Seat[]} */
  const seats = [];
  const odd = [];
  const taken = [];
  for (const entry of said) {
    const { benches, beyond } = benchesOf(entry, numbering);
    taken.push(...householderOf(entry));
    odd.push(...ofEntry(entry, numbering));
    if (beyond.length) odd.push(stranger(entry, beyond, numbering));
    if (seats.length + benches.length * entry.people.length > MOST_PEOPLE) {
      const values = { file: name, most: MOST_PEOPLE };
      throw new InputError(_("{file} names more than {most} people", values));
    }
    if (benches.length > 1) odd.push(shared(entry, benches, numbering));
    seats.push(...seatsOf(entry, benches));
  }
  return { seats, odd, taken };
}

/** The number, from 1, of the bench at a place of the list; it may be beyond the dragon. @param {Place} place @param {Numbering} numbering */
function benchAt({ number, end }, { count, countHead }) {
  if (end) return end === "head" ? 1 : count;
  return countHead ? number : number + 1;
}

/** The benches of a row, each once, and ranges of numbers that the dragon does not have. @param {Entry} entry @param {Numbering} numbering */
function benchesOf(entry, numbering) {
  const { count } = numbering;
  /** @type {Set<number>} */
  const inside = new Set();
  /** @type {Array<[number, number]>} */
  const beyond = [];
  for (const ends of entry.benches) {
    const [low, high] = ends.map((end) => benchAt(end, numbering)).sort((a, b) => a - b);
    for (let bench = Math.max(low, 1); bench <= Math.min(high, count); bench++) inside.add(bench);
    if (low < 1) beyond.push([low, Math.min(high, 0)]);
    if (high > count) beyond.push([Math.max(low, count + 1), high]);
  }
  return { benches: [...inside], beyond };
}

/** People of a row at its benches: as many to each, in order, or else all of them at each. @param {Entry} entry @param {number[]} benches @returns {Seat[]} */
function seatsOf(entry, benches) {
  const { people, row } = entry;
  if (!isDealt(entry, benches))
    return benches.flatMap((bench) => people.map((person) => ({ bench, person, row })));
  const each = people.length / benches.length;
  return people.map((person, n) => ({ bench: benches[Math.floor(n / each)], person, row }));
}

/** @param {Entry} entry @param {number[]} benches */
function isDealt({ people }, benches) {
  return people.length > 1 && benches.length > 1 && people.length % benches.length === 0;
}

/** @param {Entry} entry @param {number[]} benches @param {Numbering} numbering */
function shared(entry, benches, numbering) {
  const values = { row: entry.row, names: names(entry.people), benches: calledAll(benches, numbering) };
  if (entry.people.length === 1) return _("row {row}: {names} stands at each of {benches}", values);
  if (isDealt(entry, benches)) return _("row {row}: {names} are dealt to {benches} in order", values);
  return _("row {row}: {names} stand at each of {benches}", values);
}

/** @param {Entry} entry */
function householderOf({ row, people, householder }) {
  if (!householder) return [];
  const values = { row, names: names(people) };
  return [_("row {row}: no name: the householder, {names}, is read as who carries", values)];
}

/** What of a row was read otherwise than it may have been meant. @param {Entry} entry @param {Numbering} numbering */
function ofEntry({ row, benches, people }, { countHead }) {
  const said = [];
  if (!countHead && benches.flat().some(({ number, end }) => !number && !end))
    said.push(_("row {row}: bench 0 is taken for the head", { row }));
  for (const { name } of people)
    if (Array.from(name).length === 1)
      said.push(
        _("row {row}: {name} is a name of one sign: part names by 、 and not by spaces", { row, name }),
      );
    else if (SEVERAL.test(name) || likeTwo(name))
      said.push(
        _("row {row}: {name} is taken for one person: if they are several, part their names by 、", {
          row,
          name,
        }),
      );
  return said;
}

/** @param {Entry} entry @param {Array<[number, number]>} beyond @param {Numbering} numbering */
function stranger({ row, people }, beyond, numbering) {
  const benches = listed(beyond.map(([low, high]) => span(low, high, numbering)));
  const values = { row, count: numbering.count, benches, names: names(people) };
  return _("row {row}: the dragon of {count} benches has no {benches}: {names}", values);
}

/** Seats without those that a row says again; what that row adds is kept. @param {Seat[]} seats @param {Numbering} numbering @param {string} name */
function once(seats, numbering, name) {
  /** @type {Map<number, Seat[]>} */
  const found = new Map();
  /** @type {Map<string, number[]>} */
  const namesakes = new Map();
  const notes = [];
  for (const seat of seats) {
    const { bench, person, row } = seat;
    const there = found.get(bench) ?? [];
    found.set(bench, there);
    const key = `${bench} ${plain(person.name)}`;
    const alike = namesakes.get(key) ?? [];
    namesakes.set(key, alike);
    const at = alike.find((n) => isSame(there[n].person, person));
    if (at === undefined) {
      alike.push(there.length);
      there.push(seat);
    } else {
      const first = there[at];
      there[at] = { bench, person: fuller(first.person, person), row: first.row };
      const values = { name: person.name, bench: numbering.called(bench), first: first.row, row };
      notes.push(_("{name} is named twice at {bench}: in rows {first} and {row}", values));
    }
    if (there.length > MOST_A_BENCH) {
      const values = { file: name, most: MOST_A_BENCH, bench: numbering.called(bench) };
      throw new InputError(_("{file} names more than {most} people at {bench}", values));
    }
  }
  return { kept: [...found.values()].flat(), notes };
}

/** Whether two entries of one name may be the same person. @param {Person} one @param {Person} other */
function isSame(one, other) {
  const may = (/** @type {string} */ a, /** @type {string} */ b) => a === b || !(a && b);
  return may(one.household, other.household) && may(one.phone, other.phone);
}

/** What two entries about one person say. @param {Person} one @param {Person} other */
function fuller(one, other) {
  const told = one.remarks.includes(other.remarks);
  return {
    name: one.name,
    household: one.household || other.household,
    phone: one.phone || other.phone,
    home_phone: one.home_phone || other.home_phone,
    remarks: told ? one.remarks : `${one.remarks} ${other.remarks}`.trim(),
  };
}

/** People whom two rows name at different benches; of one name, but other households, are others. @param {Seat[]} seats @param {Numbering} numbering */
function atTwo(seats, numbering) {
  /** @type {Map<string, Seat[]>} */
  const named = new Map();
  for (const seat of seats) {
    const key = plain(seat.person.name);
    const there = named.get(key);
    if (there) there.push(seat);
    else named.set(key, [seat]);
  }
  return [...named.values()].flatMap(alikeGroups).flatMap((group) => {
    const rows = [...new Set(group.map(({ row }) => row))].sort((a, b) => a - b);
    const benches = [...new Set(group.map(({ bench }) => bench))].sort((a, b) => a - b);
    if (rows.length < 2 || benches.length < 2) return [];
    const values = { name: group[0].person.name, benches: calledAll(benches, numbering) };
    return [_("{name} is named at {benches}: in rows {rows}", { ...values, rows: listed(rows.map(String)) })];
  }); // prettier-ignore
}

/** Seats of one name by household, or else phone: all of them together if one has neither. @param {Seat[]} seats */
function alikeGroups(seats) {
  /** @type {Map<string, Seat[]>} */
  const groups = new Map(
    seats.map(({ person }) => [person.household || person.phone, /** @type {Seat[]} */ ([])]),
  );
  if (groups.has("")) return [seats];
  for (const seat of seats)
    for (const mark of new Set([seat.person.household, seat.person.phone]))
      groups.get(mark)?.push(seat);
  return [...groups.keys()].sort().map((mark) => groups.get(mark) ?? []);
}

/** Benches that several rows name by themselves, where that may be a slip: see `_apart` of rosters/reading.py. @param {Entry[]} said @param {Numbering} numbering */
function apart(said, numbering) {
  /** @type {Map<number, typeof said>} */
  const rows = new Map();
  for (const entry of said) {
    const { benches } = benchesOf(entry, numbering);
    if (benches.length === 1) rows.set(benches[0], [...(rows.get(benches[0]) ?? []), entry]);
  }
  const word = (/** @type {typeof said[number]} */ entry) => JSON.stringify(entry.benches);
  const seldom = 2 * [...rows.values()].filter((found) => found.length > 1).length < rows.size;
  return [...rows].sort(([a], [b]) => a - b).flatMap(([bench, found]) => {
    const apart = (/** @type {typeof said[number]} */ one, /** @type {number} */ n) =>
      n > 0 &&
      (one.row - found[n - 1].row > 1 ||
        word(one) !== word(found[n - 1]) ||
        seldom);
    if (!found.some(apart)) return [];
    const values = { bench: numbering.called(bench), rows: listed(found.map(({ row }) => String(row))) };
    return [_("{bench} is in rows {rows}: all of their people are taken for it", values)];
  }); // prettier-ignore
}

/** @param {Map<number, Person[]>} benches @param {Numbering} numbering */
function holes(benches, numbering) {
  const all = Array.from({ length: numbering.count }, (_one, n) => n + 1);
  const empty = all.filter((bench) => !benches.has(bench));
  if (!empty.length) return [];
  return [_("nobody is named for {benches}", { benches: calledAll(empty, numbering) })];
}

/** What benches are called, those in a row as a range. @param {number[]} benches @param {Numbering} numbering */
function calledAll(benches, numbering) {
  /** @type {Array<[number, number]>} */
  const spans = [];
  for (const bench of [...benches].sort((a, b) => a - b)) {
    const last = spans[spans.length - 1];
    if (last && bench === last[1] + 1) last[1] = bench;
    else spans.push([bench, bench]);
  }
  const told = spans.flatMap(([low, high]) =>
    high - low === 1 ? [numbering.called(low), numbering.called(high)] : [span(low, high, numbering)],
  );
  return listed(told);
}

/** @param {number} low @param {number} high @param {Numbering} numbering */
function span(low, high, numbering) {
  if (low === high) return numbering.called(low);
  return _("{first} to {last}", { first: numbering.called(low), last: numbering.called(high) });
}

/** @param {Person[]} people */
function names(people) {
  return listed(people.map(({ name }) => name));
}

/** Words one after the other, as the language in use parts them. @param {string[]} words */
function listed(words) {
  return [...words.slice(0, MOST_LISTED), ...more(words.length - MOST_LISTED)].join(
    language() === "zh" ? "、" : ", ",
  );
}

/** @param {string[]} notes */
function some(notes) {
  return [...notes.slice(0, MOST_NOTES), ...more(notes.length - MOST_NOTES)];
}

/** That there are so many more, if there are any. @param {number} count */
function more(count) {
  return count > 0 ? [_("and {count} more", { count })] : [];
}
