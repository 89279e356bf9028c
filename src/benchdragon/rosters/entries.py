"""What each row of a list says: benches as the list numbers them, and their people."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from benchdragon.i18n import _
from benchdragon.rosters.columns import Columns
from benchdragon.rosters.names import ABOVE, LEFT
from benchdragon.rosters.roster import Person
from benchdragon.rosters.words import (
    DECIMALS,
    MADE_A_DAY,
    ROUNDED,
    Place,
    clean,
    doubtful,
    is_name,
    is_sum,
    names_of,
    places,
    plain,
    simple,
    with_places,
    without_dashes,
    without_phones,
)

Ranges = tuple[tuple[Place, Place], ...]
# Signs of a cell that a note repeats.
MOST_SHOWN = 40


@dataclass(frozen=True)
class Entry:
    """A row with people.

    Attributes:
        row: its number in the file, from 1.
        benches: as it names them, or as the row above it does.
        people: who carries them.
        householder: whether it has no names, so that its householder is taken for who carries.
    """

    row: int
    benches: Ranges
    people: tuple[Person, ...]
    householder: bool


@dataclass(frozen=True)
class Unread:
    """A row, or a part of it, that was not read, and why, in words; a sum is none of people."""

    row: int
    why: str
    is_sum: bool = False


def entries(rows: Sequence[Sequence[str]], first: int, block: Columns) -> Iterator[Entry | Unread]:
    """What a block of columns says, row by row from `first`, counted from 0.

    A row without a number goes on about the bench of the row above.
    """
    head = [plain(cell) for cell in rows[first - 1]] if first else []
    benches: Ranges = ()
    household = ""
    numbers = [_cells(row, [block.number])[0] for row in rows[first:]]
    halved = frozenset(bench for cell in numbers for bench in with_places(cell))
    for number, row in _repeated(rows, first, block):
        if not any(row) or [plain(cell) for cell in row] == head:
            continue
        if is_sum(next(cell for cell in row if cell)):
            benches = ()
            yield Unread(number, _("taken for a sum: {text}").format(text=_shown(row)), is_sum=True)
            continue
        if not any(_cells(row, _all(block))):
            continue
        (said,) = _cells(row, [block.number])
        if said:
            found = None if doubtful(said, halved) else places(said, halved)
            benches, household = tuple(found or ()), ""
            if found is None:
                yield Unread(number, _not_a_number(said, row))
                continue
        elif not benches:
            yield Unread(number, _("no number of a bench: {text}").format(text=_shown(row)))
            continue
        people, odd = _people(row, block, household)
        owner = () if people or odd else _householder(row, block)
        others = [*block.households, *block.phones, *block.remarks]
        if not (people or odd or owner) and any(_cells(row, others)):
            odd = [_("no name, only {text}").format(text=_shown(row))]
        people = people or owner
        yield from (Unread(number, text) for text in odd)
        household = next((one.household for one in people), household)
        if people:
            yield Entry(number, benches, people, bool(owner))


def _repeated(
    rows: Sequence[Sequence[str]], first: int, block: Columns
) -> Iterator[tuple[int, Sequence[str]]]:
    """The rows from `first` on, by their numbers from 1; 同上 and 同左 are what they say again."""
    above: dict[int, str] = {}
    for number, row in enumerate(rows[first:], start=first + 1):
        said = list(row)
        named = any(simple(cell) in ABOVE for cell in _cells(row, block.names))
        for n in _all(block):
            word = simple(said[n]) if n < len(said) else ""
            whose = named and not word and n in (*block.households, *block.phones)
            if word in ABOVE or whose:
                said += [""] * (n + 1 - len(said))
                told = said[n] if n in block.names else ""
                said[n] = "" if n == block.number else above.get(n, "") or told
            elif word in LEFT and n:
                said[n] = said[n - 1]
        if any(_cells(said, _all(block))):
            above = dict(zip(_all(block), _cells(said, _all(block)), strict=True))
        yield number, said


def _all(block: Columns) -> list[int]:
    return [block.number, *block.names, *block.households, *block.phones, *block.remarks]


def _cells(row: Sequence[str], columns: Sequence[int]) -> list[str]:
    return [row[n] if n < len(row) else "" for n in columns]


def _shown(row: Sequence[str]) -> str:
    """What a row says, without phones."""
    text = clean(" ".join(without_phones(cell)[0] for cell in row))
    return text if len(text) <= MOST_SHOWN else text[:MOST_SHOWN] + "…"


def _not_a_number(said: str, row: Sequence[str]) -> str:
    if MADE_A_DAY.fullmatch(said):
        text = _("the spreadsheet made a day of the bench's number ({text}): format the column as text")
        return text.format(text=said)
    if places(said):
        text = _(
            "{said} may be several benches, or a place at one: write {benches}, or the bench alone"
        )
        return text.format(said=said, benches=without_dashes(said))
    head, comma, _rest = said.partition("，")
    if comma and places(head) and sum(map(bool, row)) == 1:
        text = _("the comma behind {number} is a Chinese one (，): type an English one (,)")
        return text.format(number=clean(head))
    text = _("{said} is no number of a bench: {text}")
    return text.format(said=repr(_shown([said])), text=_shown(row))


def _people(row: Sequence[str], block: Columns, household: str) -> tuple[tuple[Person, ...], list[str]]:
    """The people of a row, and what of it was not understood."""
    remarks, hidden = _open(_cells(row, block.remarks))
    said, more = _open(_cells(row, block.households))
    household = said or household
    columns, homes = _phone_columns(block)
    at_home = [phone for cell in _cells(row, homes) for phone in _phones(cell)]
    home = " ".join([*at_home, *more])
    people: list[Person] = []
    odd = [
        _("the spreadsheet rounded a phone number: format the column as text")
        for cell in _cells(row, block.phones) if ROUNDED.fullmatch(cell)
    ]  # fmt: skip
    for n, (cell, beside) in enumerate(zip(_cells(row, block.names), columns, strict=True)):
        rest, phones = without_phones(cell)
        own = [phone for one in _cells(row, beside) for phone in _phones(one)]
        own += [*phones, *(hidden if n == 0 else ())]
        names = names_of(rest)
        odd += [
            _("{text} is no name").format(text=_shown([name])) for name in names if not is_name(name)
        ]
        each = own if len(own) == len(names) else [" ".join(own)] * len(names)
        people += [
            Person(name, household, phone or (home if name == household else ""), remarks, home)
            for name, phone in zip(names, each, strict=True)
            if is_name(name)
        ]
    return tuple(people), odd


def _phone_columns(block: Columns) -> tuple[list[list[int]], list[int]]:
    """The columns of phones of each column of names, and those of the household or of all together."""
    if len(block.phones) == len(block.names) > 1:
        return [[n] for n in block.phones], []
    own: list[list[int]] = [[] for _column in block.names]
    home: list[int] = []
    for phone in block.phones:
        before = sum(n < phone for n in block.names)
        headed = len(block.names) > 1 or any(n < phone for n in block.households)
        if before > 1 or (not before and headed):
            home.append(phone)
        else:
            own[0].append(phone)
    return own, home


def _householder(row: Sequence[str], block: Columns) -> tuple[Person, ...]:
    """Who carries where a row leaves the names blank, but says whose household it is."""
    if any(_cells(row, block.names)):
        return ()
    household, hidden = _open(_cells(row, block.households))
    remarks, more = _open(_cells(row, block.remarks))
    phone = " ".join(dict.fromkeys([*filter(None, _cells(row, block.phones)), *hidden, *more]))
    return tuple(
        Person(name, household, phone, remarks) for name in names_of(household) if is_name(name)
    )


def _open(cells: Sequence[str]) -> tuple[str, tuple[str, ...]]:
    """The texts of cells without the phones in them, and these."""
    split = [without_phones(cell) for cell in cells if cell]
    return clean(" ".join(text for text, _phones in split)), tuple(p for _t, ps in split for p in ps)


def _phones(cell: str) -> tuple[str, ...]:
    """The numbers of a cell of phones; all of it where none is recognised."""
    rest, phones = without_phones(DECIMALS.sub("", cell))
    return phones if not rest.strip(" ,;、，；/") else ((clean(cell),) if cell else ())
