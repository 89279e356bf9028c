"""The contest's workbooks as others write them: result1, result2 and result4, read from .xlsx files.

Rows are known by their labels and columns by their headers, wherever they stand: half or full width,
in Chinese or English, with titles above, numbers as text, sheets in any order.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from itertools import zip_longest
from pathlib import Path
from typing import Any, Literal, get_args
from unicodedata import normalize

import numpy as np

from benchdragon.errors import InputError, reason
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.rosters.extent import Limits, locked, measure, torn

Quantity = Literal["x", "y", "speed"]
QUANTITIES: tuple[Quantity, ...] = get_args(Quantity)
# Handles of the contest's dragon.
HANDLES = 224
# What is read: bytes of the file, and times.
MOST_BYTES, MOST_TIMES = 32 * 2**20, 1001
# Larger numbers are input errors, s and m.
MOST_SECONDS, MOST_METRES = 1e4, 1e6
# Columns in which labels are sought: an index may stand before them.
LABEL_COLUMNS = 3

# What .xlsx files begin with, and workbooks under a password.
ZIP, OLE = b"PK", b"\xd0\xcf\x11\xe0"
ENCRYPTED = "EncryptedPackage".encode("utf-16-le")

LABEL = re.compile(
    r"(?P<head>龙头|head)|(?:第(?P<body>\d{1,3})节龙身|body(?P<number>\d{1,3}))"
    r"|(?P<rear>龙尾\(?后\)?|tail\(rear\))|(?P<tail>龙尾|tail)"
)
BODY = re.compile(r"第\d{1,3}节龙身|body\d{1,3}")
MOST_NAMES = 5
TIME = re.compile(
    r"(?:t|第|时间|时刻|time)?[=:]?([-+]?\d+(?:\.\d*)?)(?:\(?(?:s|秒|sec|seconds?)\)?)?(?:时|末)?"
)
REST = re.compile(
    r"(?:前?把手)?(?:[横纵]坐标)?[xy]?(?:坐标|速度|速率|speed|velocity|v)?(?:\(?m(?:/s)?\)?)?"
)
# What the headers of result2 say, in the order of looking.
COLUMNS: dict[Quantity, tuple[str, ...]] = {
    "speed": ("速度", "速率", "speed", "veloc", "m/s"),
    "x": ("x", "横"),
    "y": ("y", "纵"),
}
V = re.compile(r"v(?![a-z])")
AXES: tuple[Quantity, ...] = ("x", "y")
SHEETS: dict[Quantity, tuple[str, ...]] = {
    "x": ("位置", "坐标", "position"),
    "speed": ("速度", "速率", "speed", "veloc"),
}

Rows = Sequence[Sequence[Any]]
# Rows of a quantity by handle.
Found = dict[Quantity, dict[int, FloatArray]]
# Columns that stand without a header: so many are the contest's times, s.
HEADLESS = {301: np.arange(0.0, 301.0), 201: np.arange(-100.0, 101.0)}


@dataclass(frozen=True, eq=False)
class Workbook:
    """What a workbook holds.

    Attributes:
        times: of its columns, s, (T,); None for result2, which is of one moment.
        values: x, y (m) and speed (m/s), (3, T, 224); NaN where a cell holds no number.
        crossed: whether positions stand in a sheet that is called speeds, or the reverse.
        remarks: what was taken for granted, and what was not read.
    """

    times: FloatArray | None
    values: FloatArray
    crossed: bool
    remarks: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class _Sheet:
    """What a sheet holds.

    Attributes:
        name: of the sheet.
        times: of its columns, s, in increasing order; None for one moment.
        rows: handle, quantity that the label names (None: none), numbers.
        remarks: as in Workbook.
    """

    name: str
    times: FloatArray | None
    rows: list[tuple[int, Quantity | None, FloatArray]]
    remarks: tuple[str, ...]

    @property
    def told(self) -> list[Quantity]:
        """What its name says that it holds, "x" for positions; nothing if it says neither."""
        return [kind for kind, words in SHEETS.items() if any(w in _plain(self.name) for w in words)]

    @property
    def axes(self) -> set[Quantity]:
        """The axes that its labels name."""
        return {axis for _handle, axis, _numbers in self.rows if axis in AXES}


def read_workbook(path: Path) -> Workbook:
    """Read a workbook in the layout of result1, result2 or result4.

    Raises:
        InputError: for a file that is none, or is larger than such a workbook can be.
    """
    found = [read for name, rows in _sheets(path) if (read := _table(name, rows))]
    if not (chosen := [sheet for sheet in found if sheet.times is not None] or found[:1]):
        said = _(
            "{path}: no sheet is laid out as those of result1, result2 and result4: rows 龙头, "
            "第1节龙身, ... (or Head, Body 1, ...), and columns of times, or x, y and speed"
        )
        raise InputError(said.format(path=path))
    own = [sheet.times for sheet in chosen if sheet.times is not None]
    times = np.unique(np.concatenate(own)) if own else None
    values = np.full((3, 1 if times is None else len(times), HANDLES), np.nan)
    remarks, crossed = [text for sheet in chosen for text in sheet.remarks], False
    for sheet in reversed(chosen):  # the first sheet has the last word
        rows = _speeds(sheet) if (wrong := _mislabelled(sheet, chosen)) else _quantities(sheet)
        remarks += [_("the rows of the speeds are labelled as positions")] if wrong else []
        crossed |= _crossed(sheet, rows)
        own_times = sheet.times
        at = slice(None) if own_times is None or times is None else np.searchsorted(times, own_times)
        for quantity, handles in rows.items():
            for handle, numbers in handles.items():
                values[QUANTITIES.index(quantity), at, handle] = numbers
    if np.isnan(values).all():
        raise InputError(_("{path}: the workbook holds no numbers").format(path=path))
    return Workbook(times, values, crossed, tuple(dict.fromkeys(remarks)))


def _crossed(sheet: _Sheet, rows: Found) -> bool:
    """Whether a sheet is named after the other quantity."""
    held: Quantity = "x" if rows.get("x") or rows.get("y") else "speed"
    return bool(sheet.told) and held not in sheet.told


def _mislabelled(sheet: _Sheet, sheets: Sequence[_Sheet]) -> bool:
    """Whether rows are labelled as positions where speeds stand: another sheet holds the positions."""
    if sheet.times is None or not sheet.axes or "x" in sheet.told:
        return False
    others = [other for other in sheets if other is not sheet]
    if "speed" in sheet.told:
        return any(other.axes and "speed" not in other.told for other in others)
    places = next((other for other in sheets if other.axes and "speed" not in other.told), sheet)
    return places is not sheet and sheet.axes <= places.axes and all(other.axes for other in others)


def _speeds(sheet: _Sheet) -> Found:
    """The rows of a sheet of speeds that are labelled as positions are."""
    handles = {handle for handle, _axis, _numbers in sheet.rows}
    if len(sheet.rows) == HANDLES > len(handles):  # labels as they stand in the other sheet, cut off
        return {"speed": {n: numbers for n, (_handle, _axis, numbers) in enumerate(sheet.rows)}}
    held = _quantities(sheet)
    both = {handle: (held["x"].get(handle), held["y"].get(handle)) for handle in handles}
    return {"speed": {handle: _size(*pair) for handle, pair in both.items()}}


def _size(x: FloatArray | None, y: FloatArray | None) -> FloatArray:
    """A speed of which one row is given, or the same in both, or its two components."""
    if x is None or y is None or np.array_equal(x, y, equal_nan=True):
        found = y if x is None else x
        assert found is not None, "a handle has a row"
        return found
    return np.hypot(x, y)


def _quantities(sheet: _Sheet) -> Found:
    """Rows by quantity and handle, as labelled; of two positions that name no axis x comes first."""
    found: Found = {"x": {}, "y": {}, "speed": {}}
    places = sheet.told == ["x"] and not sheet.axes
    for handle, quantity, numbers in sheet.rows:
        place: Quantity = "y" if handle in found["x"] else "x"
        found[place if places else quantity or "speed"].setdefault(handle, numbers)
    return found


def _sheets(path: Path) -> list[tuple[str, Rows]]:
    """Names and rows of all sheets."""
    from python_calamine import CalamineError, CalamineWorkbook

    content = _content(path)
    measure(content, str(path), LIMITS)
    try:
        with CalamineWorkbook.from_filelike(BytesIO(content)) as book:
            names = book.sheet_names
            return [(name, book.get_sheet_by_name(name).to_python()) for name in names]
    except (CalamineError, OSError, ValueError, OverflowError):
        raise InputError(torn(str(path))) from None


def _content(path: Path) -> bytes:
    """The bytes of a file that begins as an .xlsx workbook does."""
    try:
        large = path.stat().st_size > MOST_BYTES
        content = path.read_bytes() if path.is_file() and not large else b""
    except OSError as error:
        raise InputError(f"{path}: {reason(error)}") from None
    except ValueError:  # signs that no name of a file holds
        raise InputError(f"{str(path)!r}: {_('there is no such file or folder')}") from None
    if large:
        raise _too_large(str(path))
    if content.startswith(OLE) and ENCRYPTED in content:
        raise InputError(locked(str(path)))
    if not content.startswith(ZIP):
        raise InputError(_("{path} is no .xlsx workbook: save it as one").format(path=path))
    return content


def _too_large(name: str) -> InputError:
    text = _(
        "{file} is too large for a workbook of the contest: at most {megabytes} MB, {rows} rows, "
        "{columns} columns, {cells} cells of a sheet and {signs} signs in a cell are read"
    )
    most = LIMITS._asdict() | {"megabytes": MOST_BYTES // 2**20}
    return InputError(text.format(file=name, **most))


# More than the contest's numbers at MOST_TIMES times, and little enough to be read.
LIMITS = Limits(2000, 2000, 700_000, 500, _too_large)


def _plain(cell: object) -> str:
    """A cell's text, half width, in small letters and without spaces."""
    text = normalize("NFKC", f"{cell:g}" if isinstance(cell, float) else str(cell))
    return "".join(text.lower().split()).replace("−", "-")


def _number(cell: object) -> float:
    """The number in a cell; NaN if it holds none."""
    try:
        number = float(cell if isinstance(cell, int | float) else _plain(cell))
    except (ValueError, OverflowError):
        return float("nan")
    return number if abs(number) <= MOST_METRES and not isinstance(cell, bool) else float("nan")


def _time(cell: object) -> float | None:
    found = TIME.fullmatch(_plain(cell)) if not isinstance(cell, bool) else None
    return float(found[1]) if found and abs(float(found[1])) <= MOST_SECONDS else None


def _handle(cell: object) -> tuple[int, str] | None:
    """The handle that a label names, and what the label says behind it."""
    text = _plain(cell) if isinstance(cell, str) else ""
    found = LABEL.match(text)
    if found is None or not REST.fullmatch(text, found.end()):
        return None
    number = found["body"] or found["number"]
    if number:
        handle = int(number)
    else:
        handle = 0 if found["head"] else HANDLES - 1 if found["rear"] else HANDLES - 2
    bodies = 0 < handle < HANDLES - 2
    return (handle, text[found.end() :]) if bodies or not number else None


def _table(name: str, rows: Rows) -> _Sheet | None:
    """What a sheet holds; None if it is no table."""
    column, labels = _labels(rows)
    across: Rows = list(zip_longest(*rows[:LABEL_COLUMNS], fillvalue=""))
    if len(_labels(across)[1]) > len(labels):  # handles stand in columns, times in rows
        rows = list(zip_longest(*rows, fillvalue=""))
        column, labels = _labels(rows)
    if not labels:
        return None
    first = min(labels)
    header = next(
        (row for row in reversed(rows[:first]) if any(_plain(cell) for cell in row[column + 1 :])), ()
    )
    times = {j: t for j, cell in enumerate(header) if j > column and (t := _time(cell)) is not None}
    if len(times) > MOST_TIMES:
        raise InputError(_("at most {most} times are compared").format(most=MOST_TIMES))
    remarks = _strangers(rows, column)
    moment = _moment_columns(header, column)
    if not times and len(moment) < 2:
        times, moment = _headless(rows, labels, column)
        remarks += [_("no row says what the columns hold; they were taken for the contest's, in order")]
    if times:
        clock, held = _series(rows, labels, times)
        return _Sheet(name, clock, held, tuple(remarks))
    if len(moment) < 2:
        return None
    columns: list[tuple[int, Quantity | None, FloatArray]] = [
        (handle, quantity, np.array([_cell(rows[i], j)]))
        for quantity, j in moment.items()
        for i, (handle, _rest) in labels.items()
    ]
    return _Sheet(name, None, columns, tuple(remarks))


def _headless(
    rows: Rows, labels: dict[int, tuple[int, str]], column: int
) -> tuple[dict[int, float], dict[Quantity, int]]:
    """Times by column, or columns of result2, where no header says them: as many as the contest has."""
    width = max(len(rows[i]) for i in labels)
    held = [j for j in range(column + 1, width) if any(np.isfinite(_cell(rows[i], j)) for i in labels)]
    if len(held) == len(QUANTITIES):
        return {}, dict(zip(QUANTITIES, held, strict=True))
    clock = HEADLESS.get(len(held))
    return ({} if clock is None else dict(zip(held, clock.tolist(), strict=True))), {}


def _strangers(rows: Rows, column: int) -> list[str]:
    """A sentence on rows of bodies that the contest's dragon does not have."""
    cells = [row[column] for row in rows if column < len(row) and isinstance(row[column], str)]
    found = [cell for cell in cells if LABEL.match(_plain(cell)) and _handle(cell) is None]
    names = [str(cell).strip() for cell in found if BODY.match(_plain(cell))]
    text = _("rows that the contest does not ask for were not read: {names}")
    return [text.format(names=", ".join(names[:MOST_NAMES]))] if names else []


def _labels(rows: Rows) -> tuple[int, dict[int, tuple[int, str]]]:
    """The column that names most handles, and by row which, and the rest of the label."""
    best: tuple[int, dict[int, tuple[int, str]]] = (0, {})
    for column in range(LABEL_COLUMNS):
        found = {
            i: label
            for i, row in enumerate(rows)
            if column < len(row) and (label := _handle(row[column])) is not None
        }
        if len(found) > len(best[1]):
            best = column, found
    return best


def _series(
    rows: Rows, labels: dict[int, tuple[int, str]], times: dict[int, float]
) -> tuple[FloatArray, list[tuple[int, Quantity | None, FloatArray]]]:
    """A sheet whose columns are times, in increasing order; the first of equal ones counts."""
    clock, order = np.unique(list(times.values()), return_index=True)
    columns = [list(times)[n] for n in order]
    found: list[tuple[int, Quantity | None, FloatArray]] = []
    for i, (handle, rest) in labels.items():
        axis = next((axis for axis in AXES if any(sign in rest for sign in COLUMNS[axis])), None)
        found.append((handle, axis, np.array([_cell(rows[i], j) for j in columns])))
    return clock, found


def _moment_columns(header: Sequence[object], column: int) -> dict[Quantity, int]:
    """Which columns of result2 hold x, y and speed."""
    found: dict[Quantity, int] = {}
    for j, cell in enumerate(header):
        text = _plain(cell)
        told = next((name for name, words in COLUMNS.items() if any(w in text for w in words)), None)
        told = "speed" if V.match(text) else told
        if j > column and told:
            found.setdefault(told, j)
    return found


def _cell(row: Sequence[object], column: int) -> float:
    return _number(row[column]) if column < len(row) else float("nan")
