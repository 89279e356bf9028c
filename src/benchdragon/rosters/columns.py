"""The meaning of a list's columns, from their headings or else from their cells."""

import itertools
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.rosters.names import like_people
from benchdragon.rosters.words import (
    MOST_TITLES,
    Kind,
    heading,
    is_name,
    is_other,
    names_of,
    places,
    plain,
    without_phones,
)

# Rows that are examined without headings, and names that make a column one of people.
MOST_LOOKED_AT, LEAST_NAMES = 50, 2
# Signs of a heading that is repeated.
MOST_HEADING = 40


@dataclass
class Columns:
    """The columns of one block of a list, counted from 0; lists may stand side by side in blocks."""

    number: int = -1
    names: list[int] = field(default_factory=list)
    households: list[int] = field(default_factory=list)
    phones: list[int] = field(default_factory=list)
    remarks: list[int] = field(default_factory=list)


@dataclass(frozen=True)
class Layout:
    """How a list is set.

    Attributes:
        first: the row after the headings, counted from 0.
        blocks: what the columns hold.
        unread: columns with something in them that are not read, by their headings or letters.
        guessed: whether there were no headings.
        householders: whether there is no column of names, so that householders are the bearers.
    """

    first: int
    blocks: tuple[Columns, ...]
    unread: tuple[str, ...]
    guessed: bool
    householders: bool = False


def layout(rows: Sequence[Sequence[str]], name: str) -> Layout:
    """How the rows of a list are set.

    Raises:
        InputError: where no numbers with names are found, and where names stand in a column whose
            heading does not say whether those carry: that is asked for and never guessed.
    """
    for number, row in enumerate(rows[:MOST_TITLES]):
        blocks, unread = _blocks(row)
        if not blocks:
            continue
        nameless = [n for n in range(_width(rows[number:])) if not (n < len(row) and row[n])]
        householders = any(block.names == block.households for block in blocks)
        _refuse_names(rows, number + 1, [*unread, *nameless], householders, name)
        others = (
            _("{column} (row {row})").format(column=letters(n), row=row_of)
            for n, row_of in _first_rows(rows, number + 1, nameless)
        )
        told = (*(row[n] for n in unread), *others)
        return Layout(number + 1, tuple(blocks), told, False, householders)
    _refuse_half(rows, name)
    found = _guessed(rows)
    if found is None:
        text = _(
            "{file}: no column of bench numbers with names beside it was found; write a first row such "
            "as: 桥号, 姓名, 户主, 电话, 备注 (bench, name, household, phone, remarks)"
        )
        raise InputError(text.format(file=name))
    (block,) = found.blocks
    taken = (block.number, *block.names, *block.phones)
    left = [n for n in range(_width(rows)) if n not in taken]
    _refuse_names(rows, found.first, left, False, name)
    return found


def _refuse_half(rows: Sequence[Sequence[str]], name: str) -> None:
    """Raise InputError for headings that do not name the column of numbers, or of bearers."""
    for number, row in enumerate(rows[:MOST_TITLES], start=1):
        filled = [cell for cell in row if cell]
        kinds = {kind[0] for cell in filled if (kind := heading(cell))}
        if len(filled) < LEAST_NAMES or any(map(places, filled)):
            continue
        text = ""
        if "number" in kinds:
            text = _(
                "{file}: row {row} has headings, but none that is known for those who carry ({said}): "
                "write 姓名 (name) over their column"
            )
        elif kinds & {"name", "household"}:
            text = _(
                "{file}: row {row} has headings, but none that is known for the numbers of benches "
                "({said}): write 桥号 (bench) over their column"
            )
        if text:
            raise InputError(text.format(file=name, row=number, said=", ".join(filled)[:MOST_HEADING]))


def _refuse_names(
    rows: Sequence[Sequence[str]], first: int, columns: Sequence[int], all_words: bool, name: str
) -> None:
    """Refuse people in columns that are not read: whether they carry is not for us to guess.

    Where householders would be the bearers, any words there may be the names of others (`all_words`).

    Raises:
        InputError: for the first such column.
    """
    head = rows[first - 1] if first else ()
    for n in columns:
        said = head[n] if n < len(head) else ""
        cells = [row[n] for row in rows[first:] if n < len(row) and row[n]]
        if is_other(said) or (heading(said) if said else None):
            continue
        people = sum(any(map(like_people, names_of(cell))) for cell in cells)
        words = all_words and said and _mostly(cells, _holds_names)
        if not words and (people < (1 if said else LEAST_NAMES) or 2 * people <= len(cells)):
            continue
        text = _(
            "{file}: names stand in column {column}, which has no heading: write over it 姓名 (name) "
            "if those carry, 户主 (household) if the benches are theirs, 备注 (remarks) if neither"
        )
        if said:
            text = _(
                "{file}: names stand in column {column}, whose heading, {heading}, is not known: write "
                "姓名 (name) in its place if those carry, 户主 (household) if the benches are theirs, "
                "备注 (remarks) if neither"
            )
        raise InputError(text.format(file=name, column=letters(n), heading=said[:MOST_HEADING]))


def _width(rows: Sequence[Sequence[str]]) -> int:
    return max(map(len, rows), default=0)


def _filled(rows: Sequence[Sequence[str]], columns: Sequence[int]) -> list[int]:
    return [n for n in columns if any(n < len(row) and row[n] for row in rows)]


def _first_rows(
    rows: Sequence[Sequence[str]], first: int, columns: Sequence[int]
) -> Iterator[tuple[int, int]]:
    """Columns, from 0, in which something stands from a row on, and the first such row, from 1."""
    for column in columns:
        found = (n for n in range(first, len(rows)) if column < len(rows[n]) and rows[n][column])
        for n in itertools.islice(found, 1):
            yield column, n + 1


def _blocks(row: Sequence[str]) -> tuple[list[Columns], list[int]]:
    """What the columns hold if a row is one of headings, and the columns that it calls otherwise."""
    blocks = [Columns()]
    unread: list[int] = []
    rank, numbered = 0, ""
    for n, cell in enumerate(row):
        known = heading(cell) if cell else None
        if known is None:
            unread += [n] if cell else []
            continue
        kind, of = known
        if kind != "number":
            _column(blocks[-1], kind).append(n)
        elif blocks[-1].number < 0 or plain(cell) == numbered:
            if blocks[-1].number >= 0:
                blocks.append(Columns())
            blocks[-1].number, rank, numbered = n, of, plain(cell)
        elif of < rank:
            unread.append(blocks[-1].number)
            blocks[-1].number, rank, numbered = n, of, plain(cell)
        else:
            unread.append(n)
    for block in blocks:
        block.names = block.names or list(block.households)
    whole = all(block.number >= 0 and block.names for block in blocks)
    return (blocks, unread) if whole else ([], [])


def _column(block: Columns, kind: Kind) -> list[int]:
    lists = {
        "name": block.names, "household": block.households,
        "phone": block.phones, "remarks": block.remarks,
    }  # fmt: skip
    return lists[kind]


def _guessed(rows: Sequence[Sequence[str]]) -> Layout | None:
    """Columns by their cells: the first with numbers, then the names, phones anywhere."""
    looked_at = [row for row in rows if any(row)][:MOST_LOOKED_AT]
    columns = range(_width(looked_at))
    cells = [[row[n] for row in looked_at if n < len(row) and row[n]] for n in columns]
    number = next((n for n in columns if _mostly(cells[n], lambda cell: bool(places(cell)))), None)
    if number is None:
        return None
    names = next((n for n in columns if n > number and _mostly(cells[n], _holds_names)), None)
    if names is None:
        return None
    phones = [n for n in columns if n != number and _mostly(cells[n], _is_phone)]
    block = Columns(number, [names], phones=phones)
    others = [n for n in range(_width(rows)) if n not in (number, names, *phones)]
    first = next(n for n, row in enumerate(rows) if number < len(row) and places(row[number]))
    unread = tuple(letters(n) for n in _filled(rows[first:], others))
    return Layout(first, (block,), unread, True)


def _mostly(cells: Sequence[str], wanted: Callable[[str], bool]) -> bool:
    return bool(cells) and 2 * sum(map(wanted, cells)) > len(cells)


def _holds_names(cell: str) -> bool:
    names = names_of(cell)
    return bool(names) and all(map(is_name, names)) and not places(cell)


def _is_phone(cell: str) -> bool:
    rest, phones = without_phones(cell)
    return bool(phones) and not any(sign.isalpha() for sign in rest)


def letters(column: int) -> str:
    """The letters of a spreadsheet's column, counted from 0."""
    text = ""
    column += 1
    while column:
        column, rest = divmod(column - 1, 26)
        text = chr(ord("A") + rest) + text
    return text
