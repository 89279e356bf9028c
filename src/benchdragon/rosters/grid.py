"""A list of names as rows of texts: workbooks by calamine, tables of text in the encodings in use."""

import csv
import io
import re
from collections.abc import Iterable, Iterator, Sequence
from datetime import date, datetime
from pathlib import Path

from python_calamine import (
    CalamineError,
    CalamineSheet,
    CalamineWorkbook,
    PasswordError,
    SheetTypeEnum,
    SheetVisibleEnum,
    load_workbook,
)

from benchdragon.decoding import readings
from benchdragon.errors import InputError, reason
from benchdragon.i18n import _
from benchdragon.rosters.extent import (
    MOST_CELLS,
    MOST_COLUMNS,
    MOST_ROWS,
    MOST_SIGNS,
    locked,
    measure,
    too_large,
    torn,
)
from benchdragon.rosters.words import MOST_TITLES, heading

# Bytes of a file.
MOST_BYTES = 20_000_000
ENDINGS = (".xlsx", ".xlsm", ".ods", ".csv", ".tsv", ".txt")
# What files start with: of zip (XLSX, ODS), and of old and of locked workbooks.
ZIP, OLE = b"PK\x03\x04", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
MOST_NAMES = 10
# What parts the columns of a table of text, and what ends the number where nothing does.
MARKS = "\t,;"
# Chinese marks part names too: they part columns only below a row of headings that they part.
CHINESE_MARKS = "，；"
NUMBER_END = re.compile(r"(?<=\S)[\s:：，]+")
# A cell between quotation marks, which may be unclosed, and such a mark alone, which repeats the cell
# above.
QUOTED = {
    mark: re.compile(
        rf'(?:^|(?<=[{mark}\r\n]))"(?:(?=[ \t]*(?:[{mark}\r\n]|\Z))|[^"]*(?:""[^"]*)*(?:"|\Z))'
    )
    for mark in (*MARKS, *CHINESE_MARKS)
}
ABOVE = "\u3003"
# Two or four bytes of a sign, in GB18030 or Big5, and those of their common signs: bytes as signs.
PAIRS = re.compile(r"[\x81-\xfe](?:[0-9][\x81-\xfe][0-9]|[\x40-\xfe])")
GB_COMMON = re.compile(r"[\xa1-\xa3\xb0-\xf7][\xa1-\xfe]")
BIG5_COMMON = re.compile(r"[\xa1-\xa3\xa4-\xc6][\x40-\x7e\xa1-\xfe]")
# Of the signs of a text in Big5 so many in 10 are common, and of what is all but UTF-8 in 5.
COMMON, ALL_BUT = 9, 4
# Signs of texts that no text has.
NO_TEXT = re.compile("[\0-\x08\x0e-\x19\x1b-\x1f]")

Rows = list[list[str]]


def read_rows(path: Path, sheet: str = "") -> Rows:
    """The cells of a list as texts, every row of the file, from its first row and column.

    Cells that are merged downwards say the same in each row.

    Raises:
        InputError: for a file, or a sheet, that cannot be read, and beyond the limits.
    """
    data = _bytes(path)
    if data.startswith(OLE):
        if "EncryptedPackage".encode("utf-16-le") in data:
            raise InputError(locked(path.name))
        text = _("{file} is an old workbook (XLS): save it as XLSX")
        raise InputError(text.format(file=path.name))
    if data.startswith(ZIP):
        return limited(_workbook_rows(data, path.name, sheet), path.name)
    if path.suffix.lower() in (".xlsx", ".xlsm", ".ods"):
        raise InputError(torn(path.name))
    if sheet:
        text = _("{file} has no sheets: leave people.sheet out")
        raise InputError(text.format(file=path.name))
    return limited(text_rows(decoded(data, path.name), path.name), path.name)


def _bytes(path: Path) -> bytes:
    if path.suffix.lower() not in ENDINGS:
        text = _("{file}: lists of names are read from {endings} files")
        raise InputError(text.format(file=path.name, endings=", ".join(ENDINGS)))
    try:
        if not path.is_file():
            raise InputError(_("there is no file {file} beside the plan").format(file=path.name))
        if path.stat().st_size > MOST_BYTES:
            raise too_large(path.name)
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path.name}: {reason(error)}") from None
    if not data.strip():
        raise InputError(_("{file} is empty").format(file=path.name))
    return data


def limited(rows: Rows, name: str) -> Rows:
    """The same rows.

    Raises:
        InputError: where there are none, or more than are read.
    """
    if len(rows) > MOST_ROWS or sum(map(len, rows)) > MOST_ROWS * MOST_COLUMNS:
        raise too_large(name)
    filled = [(column, cell) for row in rows for column, cell in enumerate(row) if cell]
    if not filled:
        raise InputError(_("{file} is empty").format(file=name))
    if len(filled) > MOST_CELLS or any(c >= MOST_COLUMNS or len(t) > MOST_SIGNS for c, t in filled):
        raise too_large(name)
    return rows


def _workbook_rows(data: bytes, name: str, sheet: str) -> Rows:
    measure(data, name)
    try:
        book = load_workbook(io.BytesIO(data))
        found = _chosen(book, name, sheet)
        rows = [[_said(cell) for cell in row] for row in found.to_python(skip_empty_area=False)]
        merged = found.merged_cell_ranges or []
    except PasswordError as error:
        raise InputError(locked(name)) from error
    except (CalamineError, ValueError, OverflowError, OSError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(torn(name)) from error
    for (top, left), (bottom, _right) in merged:
        for row in rows[top + 1 : bottom + 1]:
            if left < len(row) and left < len(rows[top]):
                row[left] = row[left] or rows[top][left]
    return rows


def _chosen(book: CalamineWorkbook, name: str, sheet: str) -> CalamineSheet:
    """The sheet of that name, or the only one with anything in it that can be seen."""
    names = [
        one.name
        for one in book.sheets_metadata
        if one.typ == SheetTypeEnum.WorkSheet and one.visible == SheetVisibleEnum.Visible
    ]
    listed = ", ".join(names[:MOST_NAMES]) + (", ..." if len(names) > MOST_NAMES else "")
    if sheet:
        if sheet not in book.sheet_names:
            text = _("{file} has no sheet called {sheet}; it has {names}")
            raise InputError(text.format(file=name, sheet=repr(sheet)[:60], names=listed))
        return book.get_sheet_by_name(sheet)
    filled = [found for one in names if (found := book.get_sheet_by_name(one)).height]
    if not filled:
        raise InputError(_("{file} is empty").format(file=name))
    if len(filled) > 1:
        text = _("{file} has several sheets: choose one by the key people.sheet: {names}")
        raise InputError(text.format(file=name, names=listed))
    return filled[0]


def _said(cell: object) -> str:
    """A cell as it reads; whole numbers without decimals, days as 2026-03-05."""
    if isinstance(cell, bool):
        return str(cell).upper()
    if isinstance(cell, float):
        return str(int(cell)) if cell.is_integer() else repr(cell)
    if isinstance(cell, datetime):
        cell = cell.date()
    if isinstance(cell, date):
        return cell.isoformat()
    return str(cell).strip()


def text_rows(text: str, name: str) -> Rows:
    """Rows of a table of text; where no sign parts its columns, a line is a number and names.

    Raises:
        InputError: for a table that is none, and beyond the limits.
    """
    first = [next((sign for sign in line if sign in MARKS), "") for line in text.splitlines()]
    mark, columns = _chinese_mark(text.splitlines()[:MOST_TITLES])
    if not mark:
        mark = max(MARKS, key=first.count)
    if mark not in first and not columns:
        return _within([NUMBER_END.split(line, maxsplit=1) for line in text.splitlines()], name)
    closed = QUOTED[mark].sub(lambda found: _closed(found, text, name), text)
    rows = _within(_cells(closed, mark, name), name)
    # Of a number and names alone all that follows is names.
    return [[row[0], mark.join(row[1:])] if columns == 2 and row else row for row in rows]


def _cells(text: str, mark: str, name: str) -> Iterator[list[str]]:
    """The cells of a table whose columns a sign parts, row by row."""
    try:
        yield from csv.reader(io.StringIO(text, newline=""), delimiter=mark)
    except csv.Error:
        raise InputError(_("{file} is no table of text").format(file=name)) from None


def _closed(found: re.Match[str], text: str, name: str) -> str:
    """A cell without its quotation marks, or the sign for 同上; InputError for an unclosed mark."""
    if found[0] == '"':
        return ABOVE
    if len(found[0]) == 1 or not found[0].endswith('"') or found[0].count('"') % 2:
        said = _("{file} is no table of text: the quotation mark in line {line} is never closed")
        raise InputError(said.format(file=name, line=text.count("\n", 0, found.start()) + 1))
    return found[0]


def _chinese_mark(lines: Sequence[str]) -> tuple[str, int]:
    """The Chinese comma or semicolon that alone parts a row of headings, and into how many; else ""."""
    for mark in CHINESE_MARKS:
        for line in lines:
            cells = line.split(mark)
            known = sum(heading(cell) is not None for cell in cells)
            if known > 1 and not any(sign in line for sign in MARKS):
                return mark, len(cells)
    return "", 0


def _within(rows: Iterable[list[str]], name: str) -> Rows:
    found = []
    for number, row in enumerate(rows):
        if number >= MOST_ROWS:
            raise too_large(name)
        found.append([cell.strip() for cell in row])
    return found


def decoded(data: bytes, name: str) -> str:
    """Text in UTF-8, UTF-16 with its mark, GB18030 or Big5.

    Raises:
        InputError: for bytes that are no text in any of them.
    """
    for text in readings(data, _legacy(data, name)):
        if is_text(text, name):
            return text
    said = _(
        "{file} is no table of text in UTF-8, GB18030 or Big5: save it as XLSX, or as CSV in UTF-8"
    )
    raise InputError(said.format(file=name))


def is_text(text: str, name: str) -> bool:
    """Whether it may be text.

    Raises:
        InputError: for text with a control character.
    """
    found = NO_TEXT.search(text)
    if found is None or "\0" in text:
        return found is None
    said = _("{file}: line {line} has a control sign ({sign}), which no text has: delete it")
    line = text.count("\n", 0, found.start()) + 1
    raise InputError(said.format(file=name, line=line, sign=f"U+{ord(found[0]):04X}"))


def _legacy(data: bytes, name: str) -> Iterator[str]:
    """Encodings of bytes that are not UTF-8: Big5 where its common signs are more, and GB18030.

    Raises:
        InputError: for UTF-8 with a few broken bytes, which no other encoding reads correctly.
    """
    whole = data.decode("utf-8", "replace")
    torn, sound = whole.count("\ufffd"), sum(sign > "\x7f" for sign in whole)
    if torn and sound - torn > ALL_BUT * torn:
        said = _(
            "{file}: line {line} is torn: what stands there is no UTF-8, as the rest is; save it anew"
        )
        line = whole.count("\n", 0, whole.index("\ufffd")) + 1
        raise InputError(said.format(file=name, line=line))
    pairs = PAIRS.findall(data.decode("latin-1"))
    big5 = sum(BIG5_COMMON.fullmatch(one) is not None for one in pairs)
    gb = sum(GB_COMMON.fullmatch(one) is not None for one in pairs)
    if big5 > gb and 10 * big5 >= COMMON * len(pairs):
        yield "big5hkscs"
    yield "gb18030"
