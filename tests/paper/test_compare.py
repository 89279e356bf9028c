"""Workbooks beside the exact values: right ones agree, and what is off is counted and found."""

import json
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest

import benchdragon as bd
from benchdragon.errors import InputError
from benchdragon.kernels.curve import FloatArray
from benchdragon.paper.compare import Comparison, Result, compare
from tests.paper.workbooks import (
    ALL_TIMES,
    CONTACT,
    TIMES,
    Compared,
    values,
    values_at,
    write_moment,
    write_series,
)
from tests.paper.wrong_workbooks import (
    turned,
)

AT_CONTACT = values_at("result2", [CONTACT])


@pytest.mark.parametrize("result", ["result1", "result4"])
def test_right_workbooks_agree(compared: Compared, result: str) -> None:
    times = ALL_TIMES[result]
    found = compared(values_at(result, times), times)
    assert_agrees(found, result)
    assert (found.places.cells, found.places.agreeing) == (448 * len(times),) * 2
    assert (found.speeds.cells, found.speeds.agreeing) == (224 * len(times),) * 2


def test_a_right_moment_agrees(compared: Compared) -> None:
    for moment in (CONTACT, 412.473838):
        found = compared(values_at("result2", [moment]))
        assert_agrees(found, "result2")


def assert_agrees(found: Comparison, result: str) -> None:
    assert (found.result, found.mistake, found.agrees) == (result, None, True)
    assert (found.first_departure, found.amount, found.remarks) == (None, None, ())
    for largest in (found.largest_place, found.largest_speed):
        assert largest is not None
        assert largest < 1e-6


@pytest.mark.xdist_group("paper")  # whose results it shares
def test_what_reproduce_writes_agrees(folder: Path) -> None:
    for result in ("result1", "result2", "result4"):
        assert_agrees(compare(folder / f"{result}.xlsx"), result)


def test_sheets_with_each_others_name_are_swapped(tmp_path: Path) -> None:
    names = ("速度", "位置")
    path = write_series(tmp_path / "a.xlsx", values("result1"), TIMES["result1"], sheets=names)
    found = compare(path)
    assert (found.mistake, found.agrees) == ("swapped", False)
    assert found.largest_place is not None
    assert found.largest_place < 1e-6
    assert found.finding.startswith("the names of the sheets are swapped")


def test_a_file_that_is_another_one_than_it_says_is_swapped(compared: Compared, tmp_path: Path) -> None:
    times = ALL_TIMES["result4"]
    turn = values_at("result4", times)
    found = compared(turn, times, name="result1.xlsx")
    assert (found.result, found.mistake) == ("result1", "swapped")
    assert found.residual < 5e-7
    assert_agrees(compared(turn, times, name="result1.xlsx", result="result4"), "result4")
    moment = write_moment(tmp_path / "Result 4 (2).xlsx", AT_CONTACT)
    found = compare(moment)
    assert (found.result, found.mistake) == ("result2", "swapped")
    assert found.finding == "the workbook is laid out as result2, not as result4"
    assert_agrees(compare(moment, result="result2"), "result2")


def test_empty_cells_and_missing_times_are_counted(compared: Compared) -> None:
    times = ALL_TIMES["result1"]
    table = values_at("result1", times)
    table[:, 5, 3] = np.nan
    found = compared(table, times)
    assert (found.mistake, found.agrees) == (None, False)
    assert (found.places.empty, found.speeds.empty) == (2, 1)
    assert found.remarks == ("3 of the 202272 cells that the contest asks for are empty",)
    assert found.finding == "all numbers that are there agree"
    first = found.first_departure
    assert first is not None
    assert (first.time, first.handle, first.quantity, first.theirs) == (5.0, 3, "x", None)
    assert first.exact == pytest.approx(values_at("result1", [5.0])[0, 0, 3], abs=1e-12)
    found = compared(table[:, ::60], times[::60])
    assert (found.places.cells, found.places.empty) == (6 * 448, 295 * 448)


# Handles of the contest's dragon: 223 benches; what each of them has: x, y and a speed.
ASKED = {"result1": 301 * 224 * 3, "result2": 224 * 3, "result4": 201 * 224 * 3}


@pytest.mark.parametrize(
    ("result", "times", "held"),
    [
        ("result1", np.arange(-100.0, 101.0), 101),
        ("result1", np.arange(0.0, 400.0), 301),
        ("result1", np.arange(0.5, 300.0), 0),
        ("result4", np.arange(0.0, 301.0), 101),
        ("result4", np.arange(-100.0, 101.0, 0.5), 201),
    ],
)
def test_the_cells_that_the_contest_asks_for_are_counted(
    compared: Compared, result: Result, times: FloatArray, held: int
) -> None:
    """Whatever other times a workbook holds, the contest asks for its own."""
    found = compared(np.ones((3, len(times), 224)), times, result=result, tolerance=1e3)
    empty = ASKED[result] - held * 224 * 3
    assert found.places.asked + found.speeds.asked == ASKED[result]
    assert found.places.empty + found.speeds.empty == empty
    text = f"{empty} of the {ASKED[result]} cells that the contest asks for are empty"
    assert (text in found.remarks) == bool(empty)


def test_result2_asks_for_224_handles(compared: Compared) -> None:
    found = compared(AT_CONTACT)
    assert found.places.asked + found.speeds.asked == ASKED["result2"]


def test_the_first_departure_is_the_earliest_then_of_the_first_handle(compared: Compared) -> None:
    table = values("result1").copy()
    table[0, 20, 0] += 1.0
    table[2, 7, 9] += 1.0
    table[1, 7, 5] += 1e-4
    table[2, 7, 5] += 1e-4
    found = compared(table, TIMES["result1"])
    first = found.first_departure
    assert first is not None
    assert (first.time, first.handle, first.quantity) == (277.0, 5, "y")
    assert first.theirs == round(table[1, 7, 5], 6)
    assert (found.places.handle, found.places.time) == (0, 290.0)
    assert (found.speeds.handle, found.speeds.time) == (9, 277.0)
    assert found.largest_speed == pytest.approx(1.0, abs=1e-6)


def test_the_tolerance_decides_what_is_off(tmp_path: Path) -> None:
    path = write_series(tmp_path / "a.xlsx", values("result1"), TIMES["result1"], decimals=4)
    assert compare(path).mistake == "rounding"
    assert compare(path, tolerance=1e-4).mistake is None
    for tolerance in (0.0, float("nan")):
        with pytest.raises(InputError, match="tolerance must be"):
            compare(path, tolerance=tolerance)


def test_wrong_arguments_are_refused(tmp_path: Path) -> None:
    any_: object = "result3"
    for wrong in (None, 1.0, object(), ["a.xlsx"]):
        with pytest.raises(InputError, match="path must be a Path, not"):
            compare(wrong)  # type: ignore[arg-type]
    for wrong in (None, "x", object(), [1.0]):
        with pytest.raises(InputError, match="tolerance must be"):
            compare("a.xlsx", tolerance=wrong)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="result must be one of result1, result2, result4, not"):
        compare("a.xlsx", result=any_)  # type: ignore[arg-type]
    path = write_series(tmp_path / "a.xlsx", values("result1")[:, :1], [900.0])
    with pytest.raises(InputError, match="none of its times lies in the walk"):
        compare(path)


def test_a_comparison_is_plain_data(tmp_path: Path) -> None:
    found = bd.compare(write_moment(tmp_path / "a.xlsx", turned(AT_CONTACT, 1.0)))
    assert isinstance(found, bd.Comparison)
    record = json.loads(json.dumps(asdict(found)))
    assert {"largest_place", "largest_speed", "first_departure", "mistake"} < set(record)
    assert record["first_departure"]["quantity"] == "x"
