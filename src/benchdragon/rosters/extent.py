"""How much a workbook holds, before its reader makes room for it.

The reader allocates memory for every cell between the first and the last, and aborts the process if
there is none: two cells in far corners of a sheet are enough. Untrusted files are therefore measured
first.
"""

import io
import lzma
import re
import struct
import zipfile
import zlib
from collections.abc import Callable
from typing import NamedTuple
from xml.parsers import expat

from benchdragon.errors import InputError
from benchdragon.i18n import _

# Bytes of all parts of a workbook together, and their number.
MOST_UNPACKED = 100_000_000
MOST_PARTS = 2000
MOST_DEPTH = 200
# Of a list: rows and columns with any cell filled, cells of all sheets, characters of a cell.
MOST_ROWS, MOST_COLUMNS, MOST_CELLS, MOST_SIGNS = 20_000, 100, 100_000, 1000
# Declared numbers of texts, formats and merged cells in a part.
COUNTS, MOST_COUNTED, NONSENSE = ("count", "uniqueCount"), 1_000_000, 1_000_000_000
CHUNK = 1 << 16
# What the standard library raises for archives that are not sound.
BROKEN = (
    zipfile.BadZipFile, zlib.error, lzma.LZMAError, struct.error, EOFError, OSError, ValueError,
    RuntimeError,
)  # fmt: skip
# Rows and cells of XLSX and of OpenDocument.
ROWS, CELLS = ("row", "table-row"), ("c", "table-cell", "covered-table-cell")
PLACE = re.compile(r"([A-Z]{1,3})([0-9]{1,7})")


class Limits(NamedTuple):
    """How much a workbook may hold, and the error of one beyond that.

    Attributes:
        rows: with any cell filled.
        columns: with any cell filled.
        cells: of a sheet.
        signs: of a cell.
        beyond: the error, by the file's name.
    """

    rows: int
    columns: int
    cells: int
    signs: int
    beyond: Callable[[str], InputError]


def measure(data: bytes, name: str, limits: Limits | None = None) -> None:
    """Check that the parts of a workbook are sound and within limits, those of a list if none are said.

    Raises:
        InputError: if not.
    """
    limits = limits or Limits(MOST_ROWS, MOST_COLUMNS, MOST_CELLS, MOST_SIGNS, too_large)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            parts = archive.infolist()
            if len(parts) > MOST_PARTS:
                raise limits.beyond(name)
            left = MOST_UNPACKED
            for part in parts:
                if part.flag_bits & 1:
                    raise InputError(locked(name))
                text = _unpacked(archive, part, left)
                if text is None:
                    raise limits.beyond(name)
                left -= len(text)
                if text[:100].lstrip(b"\xef\xbb\xbf \r\n\t").startswith(b"<") and not _drawing(part):
                    _Extent(name, limits).read(text)
    except InputError:
        raise
    except BROKEN as error:
        raise InputError(torn(name)) from error


def _drawing(part: zipfile.ZipInfo) -> bool:
    """Whether a part is a picture as old spreadsheets write them, which need not be XML."""
    return part.filename.startswith("xl/drawings/") and part.filename.endswith(".vml")


def _unpacked(archive: zipfile.ZipFile, part: zipfile.ZipInfo, left: int) -> bytes | None:
    """What a part holds, whatever it says of its size; None where that is more than so many bytes."""
    chunks, size = [], 0
    with archive.open(part) as packed:
        while chunk := packed.read(CHUNK):
            chunks.append(chunk)
            size += len(chunk)
            if size > left:
                return None
    return b"".join(chunks)


def torn(name: str) -> str:
    """The error of a workbook that is not whole."""
    text = _("{file} is torn, or no workbook: open it in a spreadsheet and save it again")
    return text.format(file=name)


def locked(name: str) -> str:
    """The error of a workbook under a password."""
    return _("{file} is locked by a password: save it without one").format(file=name)


def too_large(name: str) -> InputError:
    """The error of a list beyond the limits."""
    return InputError(
        _(
            "{file} is too large for a list of names: at most {rows} rows, {columns} columns, {cells} "
            "cells and {signs} signs in a cell are read; save the list alone"
        ).format(file=name, rows=MOST_ROWS, columns=MOST_COLUMNS, cells=MOST_CELLS, signs=MOST_SIGNS)
    )


class _Extent:
    """Rows, columns and cells of one part of an XLSX or ODS file, as they would be expanded."""

    def __init__(self, name: str, limits: Limits) -> None:
        self._name, self._limits = name, limits
        self._depth = self._cells = self._row = self._column = 0
        self._row_cells = self._last_column = self._signs = 0
        self._row_repeated = self._cell_repeated = 1
        self._filled = self._formula = self._within_formula = self._told = False
        self._parser = expat.ParserCreate(namespace_separator="}")
        self._parser.buffer_text = True
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._text
        self._parser.StartDoctypeDeclHandler = self._refuse

    def read(self, text: bytes) -> None:
        """Go through a part."""
        try:
            self._parser.Parse(text, True)
        except (expat.ExpatError, LookupError) as error:
            raise InputError(torn(self._name)) from error

    def _refuse(self, *_declared: object) -> None:
        raise InputError(torn(self._name))

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        tag = tag.rpartition("}")[2]
        self._depth += 1
        if self._depth > MOST_DEPTH:
            raise self._limits.beyond(self._name)
        for key in COUNTS:
            if key in attributes and _number(attributes[key]) > MOST_COUNTED:
                raise InputError(torn(self._name))
        if tag in CELLS or tag == "si":
            self._start_text(attributes)
        if tag == "table":
            self._row = 0
        elif tag in ROWS:
            self._column = self._last_column = self._row_cells = 0
            self._row_repeated = _repeated(attributes, "number-rows-repeated")
            self._row = _number(attributes["r"]) if "r" in attributes else self._row + 1
        elif tag in CELLS:
            self._start_cell(attributes)
        elif tag in ("v", "is", "p"):
            self._filled = True
        elif tag == "f":
            self._formula = self._within_formula = True

    def _start_cell(self, attributes: dict[str, str]) -> None:
        """Where a cell stands."""
        self._cell_repeated = _repeated(attributes, "number-columns-repeated")
        self._column += self._cell_repeated
        if "r" in attributes:
            place = PLACE.fullmatch(attributes["r"])
            if place is None:
                raise InputError(torn(self._name))
            self._column, self._row = _letters(place[1]), int(place[2])

    def _start_text(self, attributes: dict[str, str]) -> None:
        """Begin a cell, or a text that cells share."""
        self._signs, self._filled = 0, any(key.endswith("value") for key in attributes)
        self._formula = any(key.endswith("}formula") for key in attributes)
        self._told = attributes.get("t") == "str" or any("}value-type" in key for key in attributes)

    def _text(self, text: str) -> None:
        self._signs += len(text)
        self._told = self._told or not (self._within_formula or text.isspace())

    def _end(self, tag: str) -> None:
        tag = tag.rpartition("}")[2]
        self._depth -= 1
        if tag == "si" and self._signs > self._limits.signs:
            raise self._limits.beyond(self._name)
        if tag == "f":
            self._within_formula = False
        if tag in CELLS and self._formula and not self._told:
            raise InputError(self._untold())
        if tag in CELLS and self._filled:
            self._last_column = self._column
            self._row_cells += self._cell_repeated
            self._check(self._row_cells, self._signs)
        elif tag in ROWS:
            self._row += self._row_repeated - 1
            if self._row_cells:
                self._cells += self._row_cells * self._row_repeated
                self._check(self._cells, 0)

    def _untold(self) -> str:
        """The error of a formula whose value was not saved: its cell would read as empty."""
        text = _(
            "{file}: the cell in row {row}, column {column} is a formula without a value: open the "
            "file in a spreadsheet and save it again"
        )
        return text.format(file=self._name, row=self._row, column=self._column)

    def _check(self, cells: int, signs: int) -> None:
        within = self._row <= self._limits.rows and self._last_column <= self._limits.columns
        if not within or cells > self._limits.cells or signs > self._limits.signs:
            raise self._limits.beyond(self._name)


def _repeated(attributes: dict[str, str], key: str) -> int:
    """How often OpenDocument repeats what these are attributes of."""
    said = [_number(value) for name, value in attributes.items() if name.rpartition("}")[2] == key]
    return max(said, default=1)


def _number(text: str) -> int:
    """A count as files say it; nonsense counts as more than any limit."""
    return int(text) if text.isascii() and text.isdigit() and len(text) < 10 else NONSENSE


def _letters(text: str) -> int:
    """The number of a column, from 1."""
    number = 0
    for letter in text:
        number = 26 * number + ord(letter) - ord("A") + 1
    return number
