"""A roster from a list of names: who carries which bench, and what is odd about the list."""

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from benchdragon.errors import InputError
from benchdragon.i18n import _, language
from benchdragon.rosters.columns import Layout, layout, letters
from benchdragon.rosters.entries import MOST_SHOWN, Entry, Ranges, Unread, entries
from benchdragon.rosters.grid import read_rows
from benchdragon.rosters.names import like_two
from benchdragon.rosters.roster import Person, Roster
from benchdragon.rosters.words import Place, plain

# People of a list, and notes of one kind about it.
MOST_PEOPLE, MOST_NOTES = 50_000, 100
# Chinese signs without a dot between them of which hardly a name has so many: of two people, perhaps.
SEVERAL = re.compile("[\u3400-\u4dbf\u4e00-\u9fff\U00020000-\U0003ffff]{5,}")
# People at a bench, and words of a list within a note.
MOST_A_BENCH, MOST_LISTED = 200, 30


@dataclass(frozen=True)
class Numbering:
    """How a village numbers the benches of a dragon.

    Attributes:
        count: of benches.
        count_head: whether the head's bench is number 1; else 1 is the next.
        called: the name of a bench (number, from 1) in the language in use.
    """

    count: int
    count_head: bool
    called: Callable[[int], str]

    def bench(self, place: Place) -> int:
        """The number, from 1, of the bench at a place of the list; it may be beyond the dragon."""
        if place.end:
            return 1 if place.end == "head" else self.count
        return place.number if self.count_head else place.number + 1


@dataclass(frozen=True)
class _Seat:
    """A person at a bench, and the row that says so."""

    bench: int
    person: Person
    row: int


def read_roster(path: Path, numbering: Numbering, sheet: str = "") -> Roster:
    """Who carries which bench, as a list of names (XLSX, ODS, CSV) says it.

    Columns are found by their headings (桥号, 姓名, 户主, 电话, 备注, or English ones), else by their
    cells. What was not understood is in the notes of the roster, by its row.

    Raises:
        InputError: for a file that cannot be read as a list, and beyond the limits.
    """
    return roster_of(read_rows(path, sheet), path.name, numbering)


def roster_of(rows: Sequence[Sequence[str]], name: str, numbering: Numbering) -> Roster:
    """The same of a list of some name, as the texts of its cells, row by row.

    Raises:
        InputError: where it holds no numbers with names, and beyond the limits.
    """
    found = layout(rows, name)
    told = [one for block in found.blocks for one in entries(rows, found.first, block)]
    said = [one for one in told if isinstance(one, Entry)]
    unread = [one for one in told if isinstance(one, Unread)]
    seats: list[_Seat] = []
    taken: list[str] = []
    odd: list[str] = []
    for entry in said:
        benches, beyond = _benches(entry.benches, numbering)
        taken += _householders(entry)
        odd += _of_entry(entry, numbering)
        if beyond:
            odd.append(_stranger(entry, beyond, numbering))
        if len(seats) + len(benches) * len(entry.people) > MOST_PEOPLE:
            text = _("{file} names more than {most} people")
            raise InputError(text.format(file=name, most=MOST_PEOPLE))
        if len(benches) > 1:
            odd.append(_shared(entry, benches, numbering))
        seats += _seated(entry, benches)
    kept, twice = _once(seats, numbering, name)
    found_benches: dict[int, tuple[Person, ...]] = {}
    for seat in sorted(kept, key=lambda seat: seat.bench):
        found_benches[seat.bench] = (*found_benches.get(seat.bench, ()), seat.person)
    # First the notes that decide who is printed where; last, always listed, benches without people.
    notes = [*_who(found), *first_notes(_unread(unread, sums=False)), *first_notes(taken)]
    notes += [*first_notes(odd), *first_notes(twice), *first_notes(_at_two(kept, numbering))]
    notes += [*first_notes(_apart(said, numbering)), *_columns(found)]
    notes += [*first_notes(_unread(unread, sums=True)), *_holes(found_benches, numbering)]
    return Roster(found_benches, tuple(dict.fromkeys(notes)))


def _who(found: Layout) -> Iterator[str]:
    """Notes on the columns that decide who carries."""
    if found.guessed:
        block = found.blocks[0]
        number = letters(block.number)
        text = _("there is no row of headings: column {number} is read as numbers, {names} as names")
        yield text.format(number=number, names=_listed(map(letters, block.names)))
    if found.householders:
        yield _("there is no column of names: householders are read as those who carry")


def _columns(found: Layout) -> Iterator[str]:
    if found.unread:
        text = _("columns that are not read: {columns}")
        yield text.format(columns=_listed(name[:MOST_SHOWN] for name in found.unread))


def _unread(found: Sequence[Unread], sums: bool) -> Iterator[str]:
    text = _("row {row} was not read: {why}")
    return (text.format(row=one.row, why=one.why) for one in found if one.is_sum == sums)


def _benches(said: Ranges, numbering: Numbering) -> tuple[list[int], list[tuple[int, int]]]:
    """The benches of a row, each once, and ranges of numbers that the dragon does not have."""
    inside: dict[int, None] = {}
    beyond: list[tuple[int, int]] = []
    for ends in said:
        low, high = sorted(map(numbering.bench, ends))
        inside |= dict.fromkeys(range(max(low, 1), min(high, numbering.count) + 1))
        if low < 1:
            beyond.append((low, min(high, 0)))
        if high > numbering.count:
            beyond.append((max(low, numbering.count + 1), high))
    return list(inside), beyond


def _seated(entry: Entry, benches: Sequence[int]) -> list[_Seat]:
    """People of a row at its benches: as many to each, in order, or else all of them at each."""
    if not _dealt(entry, benches):
        return [_Seat(bench, person, entry.row) for bench in benches for person in entry.people]
    each = len(entry.people) // len(benches)
    return [_Seat(benches[n // each], person, entry.row) for n, person in enumerate(entry.people)]


def _dealt(entry: Entry, benches: Sequence[int]) -> bool:
    return len(entry.people) > 1 and len(benches) > 1 and len(entry.people) % len(benches) == 0


def _shared(entry: Entry, benches: Sequence[int], numbering: Numbering) -> str:
    text = _("row {row}: {names} stand at each of {benches}")
    if len(entry.people) == 1:
        text = _("row {row}: {names} stands at each of {benches}")
    elif _dealt(entry, benches):
        text = _("row {row}: {names} are dealt to {benches} in order")
    return text.format(row=entry.row, names=_names(entry.people), benches=_called(benches, numbering))


def _householders(entry: Entry) -> Iterator[str]:
    if entry.householder:
        told = _("row {row}: no name: the householder, {names}, is read as who carries")
        yield told.format(row=entry.row, names=_names(entry.people))


def _of_entry(entry: Entry, numbering: Numbering) -> Iterator[str]:
    """Notes on a row that may have been misread."""
    ends = (place for pair in entry.benches for place in pair)
    if not numbering.count_head and any(not place.number and not place.end for place in ends):
        yield _("row {row}: bench 0 is taken for the head").format(row=entry.row)
    text = _("row {row}: {name} is a name of one sign: part names by 、 and not by spaces")
    long = _("row {row}: {name} is taken for one person: if they are several, part their names by 、")
    for person in entry.people:
        if len(person.name) == 1:
            yield text.format(row=entry.row, name=person.name)
        elif SEVERAL.fullmatch(person.name) or like_two(person.name):
            yield long.format(row=entry.row, name=person.name)


def _stranger(entry: Entry, beyond: Sequence[tuple[int, int]], numbering: Numbering) -> str:
    benches = _listed(_span(low, high, numbering) for low, high in beyond)
    text = _("row {row}: the dragon of {count} benches has no {benches}: {names}")
    return text.format(
        row=entry.row, count=numbering.count, benches=benches, names=_names(entry.people)
    )


def _once(seats: Sequence[_Seat], numbering: Numbering, name: str) -> tuple[list[_Seat], list[str]]:
    """Seats without those that a row says again; what that row adds is kept."""
    found: dict[int, list[_Seat]] = {}
    namesakes: dict[tuple[int, str], list[int]] = {}
    notes = []
    text = _("{name} is named twice at {bench}: in rows {first} and {row}")
    for seat in seats:
        there = found.setdefault(seat.bench, [])
        alike = namesakes.setdefault((seat.bench, plain(seat.person.name)), [])
        at = next((n for n in alike if _same(there[n].person, seat.person)), None)
        if at is None:
            alike.append(len(there))
            there.append(seat)
        else:
            first = there[at]
            there[at] = _Seat(seat.bench, _fuller(first.person, seat.person), first.row)
            called = numbering.called(seat.bench)
            notes.append(
                text.format(name=seat.person.name, bench=called, first=first.row, row=seat.row)
            )
        if len(there) > MOST_A_BENCH:
            said = _("{file} names more than {most} people at {bench}")
            called = numbering.called(seat.bench)
            raise InputError(said.format(file=name, most=MOST_A_BENCH, bench=called))
    return [seat for there in found.values() for seat in there], notes


def _same(one: Person, other: Person) -> bool:
    """Whether two entries of one name may be the same person."""
    pairs = ((one.household, other.household), (one.phone, other.phone))
    return all(a == b or not (a and b) for a, b in pairs)


def _fuller(one: Person, other: Person) -> Person:
    """What two entries about one person say."""
    remarks = one.remarks if other.remarks in one.remarks else f"{one.remarks} {other.remarks}".strip()
    pairs = ((one.household, other.household), (one.phone, other.phone))
    household, phone = (a or b for a, b in pairs)
    return Person(one.name, household, phone, remarks, one.home_phone or other.home_phone)


def _at_two(seats: Sequence[_Seat], numbering: Numbering) -> Iterator[str]:
    """People whom two rows name at different benches; of one name, but other households, are others."""
    named: dict[str, list[_Seat]] = {}
    for seat in seats:
        named.setdefault(plain(seat.person.name), []).append(seat)
    text = _("{name} is named at {benches}: in rows {rows}")
    for found in named.values():
        for group in _alike(found):
            rows = sorted({seat.row for seat in group})
            benches = sorted({seat.bench for seat in group})
            if len(rows) > 1 and len(benches) > 1:
                yield text.format(
                    name=group[0].person.name, benches=_called(benches, numbering),
                    rows=_listed(map(str, rows)),
                )  # fmt: skip


def _apart(said: Sequence[Entry], numbering: Numbering) -> Iterator[str]:
    """Benches that several rows name by themselves, where that may be a slip.

    It may be one where the rows do not follow one another or say it by another word, and where most
    benches have one row alone.
    """
    rows: dict[int, list[Entry]] = {}
    for entry in said:
        benches, _beyond = _benches(entry.benches, numbering)
        if len(benches) == 1:
            rows.setdefault(benches[0], []).append(entry)
    text = _("{bench} is in rows {rows}: all of their people are taken for it")
    seldom = 2 * sum(len(found) > 1 for found in rows.values()) < len(rows)
    for bench, found in sorted(rows.items()):
        if any(
            after.row - before.row > 1 or after.benches != before.benches or seldom
            for before, after in pairwise(found)
        ):
            listed = _listed(str(entry.row) for entry in found)
            yield text.format(bench=numbering.called(bench), rows=listed)


def _alike(seats: Sequence[_Seat]) -> list[list[_Seat]]:
    """Seats of one name by household, or else phone: all of them together if one has neither."""
    groups: dict[str, list[_Seat]] = {seat.person.household or seat.person.phone: [] for seat in seats}
    if "" in groups:
        return [list(seats)]
    for seat in seats:
        for mark in {seat.person.household, seat.person.phone} & groups.keys():
            groups[mark].append(seat)
    return [groups[mark] for mark in sorted(groups)]


def _holes(benches: dict[int, tuple[Person, ...]], numbering: Numbering) -> list[str]:
    empty = [bench for bench in range(1, numbering.count + 1) if bench not in benches]
    text = _("nobody is named for {benches}")
    return [text.format(benches=_called(empty, numbering))] if empty else []


def _called(benches: Sequence[int], numbering: Numbering) -> str:
    """Names of benches, those in a row as a range."""
    spans: list[list[int]] = []
    for bench in sorted(benches):
        if spans and bench == spans[-1][1] + 1:
            spans[-1][1] = bench
        else:
            spans.append([bench, bench])
    told: list[str] = []
    for low, high in spans:
        pair = high - low == 1
        told += (
            [numbering.called(low), numbering.called(high)] if pair else [_span(low, high, numbering)]
        )
    return _listed(told)


def _span(low: int, high: int, numbering: Numbering) -> str:
    if low == high:
        return numbering.called(low)
    return _("{first} to {last}").format(first=numbering.called(low), last=numbering.called(high))


def _names(people: Sequence[Person]) -> str:
    return _listed(person.name for person in people)


def _listed(words: Iterable[str]) -> str:
    """Words one after the other, as the language in use parts them."""
    found = list(words)
    shown = found[:MOST_LISTED]
    if len(found) > MOST_LISTED:
        shown.append(_("and {count} more").format(count=len(found) - MOST_LISTED))
    return ("、" if language() == "zh" else ", ").join(shown)


def first_notes(notes: Iterable[str]) -> list[str]:
    """Notes on a list of names; of very many the first, and how many more there are."""
    found = list(notes)
    if len(found) <= MOST_NOTES:
        return found
    return [*found[:MOST_NOTES], _("and {count} more").format(count=len(found) - MOST_NOTES)]
