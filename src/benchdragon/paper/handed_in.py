"""The contest's workbooks from anyone's arrays: result1, result2 and result4, in its layout."""

from pathlib import Path

import numpy as np
import numpy.typing as npt

from benchdragon.errors import InputError, of_kind
from benchdragon.export.tables import write_contest_xlsx, write_moment_xlsx
from benchdragon.files import refuse_existing
from benchdragon.i18n import N_, _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.arrays import as_numbers
from benchdragon.paper.workbook import HANDLES

# The times for which the contest asks, s.
TIMES = {"result1": np.arange(0.0, 301.0), "result4": np.arange(-100.0, 101.0)}
SERIES = N_("{name} must be of shape ({times}, {handles}), a row each second, not {shape}")
MOMENT = N_("{name} must be of shape ({handles},), a number for each handle, not {shape}")


def write_result1(
    path: Path | str, x: npt.ArrayLike, y: npt.ArrayLike, speed: npt.ArrayLike, *, force: bool = False
) -> Path:
    """Write what the contest's question 1 asks for: all handles each second from 0 s to 300 s.

    Args:
        path: of the .xlsx file, for example result1.xlsx.
        x: of every handle, m, (301, 224): the front handles of 223 benches, then the tail's rear one.
            NaN leaves a cell empty.
        y: of the same shape, m.
        speed: of the same shape, m/s.
        force: whether a file that is there already is replaced.

    Returns:
        `path`.

    Raises:
        InputError: for arrays of another shape, numbers that are infinite, another ending of the path.
        BenchDragonError: for a file that is there already.

    Examples:
        >>> found = bd.read_plan("spiral-in").motion(np.arange(0.0, 301.0))
        >>> bd.write_result1(folder / "result1.xlsx", found.x, found.y, found.speed).name
        'result1.xlsx'
    """
    return _write_series("result1", path, (x, y, speed), force)


def write_result2(
    path: Path | str, x: npt.ArrayLike, y: npt.ArrayLike, speed: npt.ArrayLike, *, force: bool = False
) -> Path:
    """Write what the contest's question 2 asks for: all handles at the moment of first contact.

    Args:
        path: of the .xlsx file, for example result2.xlsx.
        x: of every handle, m, (224,), or (1, 224) as a motion of one time has it; NaN leaves a cell
            empty.
        y: of the same shape, m.
        speed: of the same shape, m/s.
        force: whether a file that is there already is replaced.

    Returns:
        `path`.

    Raises:
        InputError: as of `write_result1`.
        BenchDragonError: for a file that is there already.

    Examples:
        >>> late = bd.read_plan("spiral-in").motion(413.0)
        >>> path = bd.write_result2(folder / "late.xlsx", late.x, late.y, late.speed)
        >>> bd.compare(path).mistake
        'time'
    """
    tables = _tables((x, y, speed), MOMENT, (HANDLES,), (1, HANDLES))
    write_moment_xlsx(_place(path, force), tables)
    return Path(path)


def write_result4(
    path: Path | str, x: npt.ArrayLike, y: npt.ArrayLike, speed: npt.ArrayLike, *, force: bool = False
) -> Path:
    """Write what the contest's question 4 asks for: all handles each second from -100 s to 100 s.

    Args:
        path: of the .xlsx file, for example result4.xlsx.
        x: of every handle, m, (201, 224); NaN leaves a cell empty.
        y: of the same shape, m.
        speed: of the same shape, m/s.
        force: whether a file that is there already is replaced.

    Returns:
        `path`.

    Raises:
        InputError: as of `write_result1`.
        BenchDragonError: for a file that is there already.

    Examples:
        >>> bd.write_result4(folder / "result4.xlsx", [1.0], [1.0], [1.0])
        Traceback (most recent call last):
            ...
        benchdragon.errors.InputError: x must be of shape (201, 224), a row each second, not (1,)
    """
    return _write_series("result4", path, (x, y, speed), force)


def _write_series(name: str, path: Path | str, given: tuple[npt.ArrayLike, ...], force: bool) -> Path:
    times = TIMES[name]
    tables = _tables(given, SERIES, (len(times), HANDLES))
    write_contest_xlsx(_place(path, force), times, tables)
    return Path(path)


def _tables(
    given: tuple[npt.ArrayLike, ...], text: str, shape: tuple[int, ...], *others: tuple[int, ...]
) -> list[FloatArray]:
    """x, y and speed, as arrays of the first shape, without infinite numbers."""
    found = []
    for name, values in zip(("x", "y", "speed"), given, strict=True):
        table = as_numbers(name, values)
        if table.shape not in (shape, *others):
            words = {"times": shape[0], "handles": HANDLES, "shape": table.shape}
            raise InputError(_(text).format(name=name, **words))
        if np.isinf(table).any():
            text = _("{name} must be finite; NaN leaves a cell empty")
            raise InputError(text.format(name=name))
        found.append(table.reshape(shape))
    return found


def _place(path: Path | str, force: bool) -> Path:
    """Where the workbook goes."""
    of_kind("path", path := Path(path) if isinstance(path, str) else path, Path)
    if path.suffix != ".xlsx":
        raise InputError(_("path must end in .xlsx, not {path}").format(path=path))
    refuse_existing([path], force)
    return path
