"""Workbooks in the layout of the contest's templates, made right or wrong on purpose."""

from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

import numpy as np
import xlsxwriter

from benchdragon.kernels.curve import FloatArray
from benchdragon.paper.compare import Comparison
from benchdragon.paper.workbook import MOST_METRES, Workbook
from benchdragon.plans.schema import read_plan

# How the fixture `compared` is called.
Compared = Callable[..., Comparison]
# The contest's times, and some of them that are enough to show a mistake, s.
ALL_TIMES = {"result1": np.arange(0.0, 301.0), "result4": np.arange(-100.0, 101.0)}
TIMES = {"result1": np.arange(270.0, 301.0), "result4": np.arange(-15.0, 16.0)}
PLANS = {"result1": "spiral-in", "result2": "spiral-in", "result4": "turn"}
CONTACT = 412.4738376821147
NAMES = ["龙头", *(f"第{i}节龙身" for i in range(1, 222)), "龙尾", "龙尾（后）"]


@cache
def values(result: str, *settings: str) -> FloatArray:
    """What result1 or result4 holds at TIMES, x, y and speed: (3, T, 224)."""
    return values_at(result, TIMES[result], *settings)


def values_at(result: str, times: Sequence[float] | FloatArray, *settings: str) -> FloatArray:
    """The same at any times; of result2 at one."""
    motion = read_plan(PLANS[result], settings).build().motion(times)
    return np.stack([motion.x, motion.y, motion.speed])


def write_series(
    path: Path,
    table: FloatArray,
    times: Sequence[float] | FloatArray,
    *,
    sheets: tuple[str, str] = ("位置", "速度"),
    decimals: int = 6,
) -> Path:
    """Write result1 or result4: a sheet of positions, a sheet of speeds, one column a time."""
    book = xlsxwriter.Workbook(path, {"nan_inf_to_errors": True})
    x, y, speed = np.round(table, decimals)
    places = [(f"{name}{axis} (m)", row) for n, name in enumerate(NAMES)
              for axis, row in (("x", x[:, n]), ("y", y[:, n]))]  # fmt: skip
    speeds = [(f"{name} {' ' * (0 < n < 222)}(m/s)", speed[:, n]) for n, name in enumerate(NAMES)]
    for title, rows in zip(sheets, (places, speeds), strict=True):
        sheet = book.add_worksheet(title)
        sheet.write_row(0, 1, [f"{t:g} s" for t in times])
        for i, (label, row) in enumerate(rows, start=1):
            sheet.write_string(i, 0, label)
            for j, value in enumerate(row.tolist(), start=1):
                if value == value:
                    sheet.write_number(i, j, value)
    book.close()
    return path


def write_moment(path: Path, table: FloatArray) -> Path:
    """Write result2: a row a handle."""
    book = xlsxwriter.Workbook(path)
    sheet = book.add_worksheet("Sheet1")
    sheet.write_row(0, 1, ["横坐标x (m)", "纵坐标y (m)", "速度 (m/s)"])
    for i, (name, row) in enumerate(zip(NAMES, np.round(table[:, 0], 6).T, strict=True), start=1):
        sheet.write_row(i, 0, [name, *row.tolist()])
    book.close()
    return path


def held(
    table: FloatArray, times: Sequence[float] | FloatArray | None = None, decimals: int = 6
) -> Workbook:
    """What is read of such files, without writing them: of result2 where there are no times."""
    numbers = np.round(table, decimals)
    assert not (np.abs(numbers) > MOST_METRES).any(), "no number of these would be read"
    return Workbook(None if times is None else np.asarray(times, dtype=float), numbers, crossed=False)
