"""Workbooks from anyone's arrays: read again they hold them, and what cannot be one is refused."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import benchdragon as bd
from benchdragon.kernels.curve import FloatArray
from benchdragon.paper.workbook import read_workbook

WRITERS = {"result1": bd.write_result1, "result2": bd.write_result2, "result4": bd.write_result4}
SHAPES = {"result1": (301, 224), "result2": (224,), "result4": (201, 224)}
STARTS = {"result1": 0.0, "result4": -100.0}


def drawn(result: str) -> FloatArray:
    """Any x, y and speed, with an empty cell."""
    found = np.random.default_rng(1).uniform(-9.0, 9.0, (3, *SHAPES[result]))
    found[1, ..., 7] = np.nan
    return found


@pytest.mark.parametrize("result", ["result1", "result2", "result4"])
def test_a_workbook_holds_the_arrays_to_six_decimals(result: str, tmp_path: Path, spoken: str) -> None:
    del spoken  # whose language no cell depends on
    tables = drawn(result)
    path = WRITERS[result](tmp_path / f"{result}.xlsx", *tables)
    found = read_workbook(path)
    wanted = tables.reshape(3, -1, 224)
    assert np.allclose(found.values, wanted, rtol=0.0, atol=5.1e-7, equal_nan=True)
    if result in STARTS:
        assert found.times is not None
        assert found.times.tolist() == [STARTS[result] + n for n in range(SHAPES[result][0])]
    assert (found.times is None) == (result == "result2")


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda x: x.T, r"x must be of shape \(301, 224\), a row each second, not \(224, 301\)"),
        (lambda x: x[0], r"x must be of shape \(301, 224\), a row each second, not \(224,\)"),
        (lambda x: x / 0.0, "x must be finite; NaN leaves a cell empty"),
        (lambda x: x.astype(str), "x must be numbers, not "),
    ],
)
@pytest.mark.filterwarnings("ignore:divide by zero")
def test_arrays_that_cannot_be_a_workbook_are_refused(
    change: Callable[[Any], Any], sentence: str, tmp_path: Path
) -> None:
    x, y, speed = np.abs(drawn("result1"))
    with pytest.raises(bd.InputError, match=sentence):
        bd.write_result1(tmp_path / "result1.xlsx", change(x), y, speed)
    with pytest.raises(bd.InputError, match="y must be of shape"):
        bd.write_result2(tmp_path / "result2.xlsx", x[0], y[:2], speed[0])
    assert list(tmp_path.iterdir()) == []


def test_a_file_is_replaced_only_if_that_is_asked(tmp_path: Path) -> None:
    first, second = drawn("result2"), drawn("result2") + 1.0
    path = bd.write_result2(str(tmp_path / "a.xlsx"), *first)
    with pytest.raises(bd.BenchDragonError, match="there already"):
        bd.write_result2(path, *second)
    bd.write_result2(path, *second, force=True)
    assert np.nanmin(read_workbook(path).values - second[:, None]) > -1e-6
    with pytest.raises(bd.InputError, match=r"path must end in \.xlsx, not .*a\.csv"):
        bd.write_result2(tmp_path / "a.csv", *first)
    with pytest.raises(bd.InputError, match="path must be a Path, not 3"):
        bd.write_result2(3, *first)  # type: ignore[arg-type]


def test_a_motion_of_one_moment_is_a_workbook(tmp_path: Path) -> None:
    motion = bd.read_plan("spiral-in").motion(412.473838)
    path = bd.write_result2(tmp_path / "result2.xlsx", motion.x, motion.y, motion.speed)
    assert bd.compare(path).agrees
