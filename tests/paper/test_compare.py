"""Workbooks made wrong on purpose: each mistake is named, and right ones agree."""

import json
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest

import benchdragon as bd
from benchdragon.errors import InputError
from benchdragon.kernels.curve import FloatArray
from benchdragon.paper.compare import Comparison, compare
from benchdragon.paper.differences import Scheme, difference_speeds
from benchdragon.plans.schema import read_plan
from tests.paper.workbooks import (
    ALL_TIMES,
    CONTACT,
    PLANS,
    TIMES,
    values,
    values_at,
    write_moment,
    write_series,
)

AT_CONTACT = values_at("result2", [CONTACT])


def turned(table: FloatArray, angle: float, *, mirror: bool = False) -> FloatArray:
    """All points turned about the centre, after they were mirrored in the x axis."""
    points = (table[0] + (-1j if mirror else 1j) * table[1]) * np.exp(1j * angle)
    return np.stack([points.real, points.imag, table[2]])


def with_speeds(table: FloatArray, speeds: FloatArray) -> FloatArray:
    return np.stack([table[0], table[1], speeds])


def gradient(table: FloatArray) -> FloatArray:
    """With speeds as NumPy's gradient of the positions in columns a second apart."""
    return with_speeds(table, np.hypot(np.gradient(table[0], axis=0), np.gradient(table[1], axis=0)))


def stepped(result: str, scheme: Scheme, step: float) -> FloatArray:
    """With speeds as differences with a step of their own, s."""
    walk = read_plan(PLANS[result]).build()
    return with_speeds(values(result), difference_speeds(walk, TIMES[result], step, scheme))


def shifted(table: FloatArray, shift: int, first: int = 0) -> FloatArray:
    """Rows from handle number `first` on hold a handle farther back; the last rows that of the tail."""
    rows = np.clip(np.arange(224) + shift, 0, 223)
    rows[:first] = np.arange(first)
    return table[:, :, rows]


def crossed_sheets() -> FloatArray:
    """The rows of speeds in the sheet of positions, as far as they go, and the reverse."""
    table = values("result1")
    wrong = np.full(table.shape, np.nan)
    wrong[0, :, :112], wrong[1, :, :112] = table[2, :, ::2], table[2, :, 1::2]
    wrong[2, :, ::2], wrong[2, :, 1::2] = table[0, :, :112], table[1, :, :112]
    return wrong


Mistaken = tuple[str, Callable[[], FloatArray], str, float | None, str]
MISTAKES: dict[str, Mistaken] = {
    "turned by 90 degrees": (
        "result1", lambda: turned(values("result1"), np.pi / 2), "rotated", np.pi / 2,
        "rotated about the spiral's centre by 90.000000 degrees",
    ),
    "turn turned": (
        "result4", lambda: turned(values("result4"), -0.3), "rotated", -0.3, "by -17.188734 degrees",
    ),
    "anticlockwise": (
        "result1", lambda: turned(values("result1"), 0.0, mirror=True), "mirrored", 0.0,
        "at 0.000000 degrees to the x axis",
    ),
    "x for y": (
        "result1", lambda: values("result1")[[1, 0, 2]], "mirrored", np.pi / 4, "x and y are exchanged",
    ),
    "result4 as result1": (
        "result1", lambda: values_at("result4", TIMES["result1"] - 100.0), "swapped", None,
        "result1 and result4 are swapped",
    ),
    "result1 as result4": (
        "result4", lambda: values_at("result1", TIMES["result4"] + 100.0), "swapped", None,
        "result1 and result4 are swapped",
    ),
    "sheets exchanged": (
        "result1", crossed_sheets, "swapped", None, "positions and speeds are swapped",
    ),
    "gradient": (
        "result1", lambda: gradient(values("result1")), "differences", 1.0,
        "central differences of the workbook's own positions",
    ),
    "forward": (
        "result4", lambda: stepped("result4", "forward", 0.1), "differences", 0.1,
        "forward differences of positions with a step of 0.1 s",
    ),
    "backward": (
        "result1", lambda: stepped("result1", "backward", 0.1), "differences", 0.1,
        "backward differences of positions with a step of 0.1 s",
    ),
    "rear for front": (
        "result1", lambda: shifted(values("result1"), 1), "handle", 1.0,
        "the row of handle i holds handle i + 1",
    ),
    "one late": (
        "result4", lambda: shifted(values("result4"), -1), "handle", -1.0, "holds handle i - 1",
    ),
    "one body early": (
        "result4", lambda: shifted(values("result4"), 1, 1), "handle", 1.0,
        "the row of handle i holds handle i + 1, from the first body on",
    ),
    "tail first": (
        "result1", lambda: values("result1")[:, :, ::-1], "handle", None,
        "in reverse order, tail first",
    ),
    "a second late": (
        "result1", lambda: values_at("result1", TIMES["result1"] + 1.0), "time", 1.0,
        "the column of t holds the moment t + 1.000000 s",
    ),
    "another clock": (
        "result4", lambda: values_at("result4", 0.9 * TIMES["result4"] - 5.0), "time", -5.0,
        "the column of t holds the moment 0.900000 t - 5.000000 s",
    ),
    "speeds a second late": (
        "result1",
        lambda: with_speeds(values("result1"), values_at("result1", TIMES["result1"] + 1.0)[2]),
        "time", 1.0, "t + 1 s",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_made_on_purpose_is_named(tmp_path: Path, name: str) -> None:
    result, make, mistake, amount, sentence = MISTAKES[name]
    found = compare(write_series(tmp_path / f"{result}.xlsx", make(), TIMES[result]))
    assert (found.result, found.mistake, found.agrees) == (result, mistake, False)
    assert sentence in found.finding
    assert found.amount == (None if amount is None else pytest.approx(amount, abs=1e-6))
    assert found.residual < 5e-7
    assert found.first_departure is not None
    assert max(found.largest_place or 0.0, found.largest_speed or 0.0) > 1e-5


@pytest.mark.parametrize(
    ("moment", "sentence"),
    [
        (413.0, "the first one after it in steps of 1 s"),
        (412.5, "the first one after it in steps of 0.5 s"),
        (412.48, "the first one after it in steps of 0.02 s"),
        (412.0, "not that of first contact, 412.473838 s"),
        (442.59, "the end point alone was looked at"),
    ],
)
def test_another_moment_than_that_of_first_contact_is_told(
    tmp_path: Path, moment: float, sentence: str
) -> None:
    found = compare(write_moment(tmp_path / "a.xlsx", values_at("result2", [moment])))
    assert (found.result, found.mistake, found.unit) == ("result2", "time", "s")
    assert found.amount == pytest.approx(moment - CONTACT, abs=2e-6 if moment < 440.0 else 1e-3)
    assert f"the moment is {moment:.2f}" in found.finding
    assert sentence in found.finding


@pytest.mark.parametrize("seed", range(20))
def test_every_angle_is_recovered(tmp_path: Path, seed: int) -> None:
    angle = np.random.default_rng(seed).uniform(-np.pi, np.pi)
    found = compare(write_moment(tmp_path / "a.xlsx", turned(AT_CONTACT, angle)))
    assert (found.mistake, found.unit) == ("rotated", "rad")
    assert found.amount == pytest.approx(angle, abs=1e-6)
    found = compare(write_moment(tmp_path / "a.xlsx", turned(AT_CONTACT, angle, mirror=True)))
    assert found.mistake == "mirrored"
    assert found.amount == pytest.approx(angle / 2.0, abs=1e-6)


@pytest.mark.parametrize("seed", range(20))
def test_every_moment_is_recovered(tmp_path: Path, seed: int) -> None:
    moment = np.random.default_rng(seed).uniform(0.0, 440.0)
    found = compare(write_moment(tmp_path / "a.xlsx", values_at("result2", [moment])))
    assert found.mistake == "time"
    assert found.amount == pytest.approx(moment - CONTACT, abs=3e-6)


@pytest.mark.parametrize("result", ["result1", "result4"])
def test_right_workbooks_agree(tmp_path: Path, result: str) -> None:
    times = ALL_TIMES[result]
    found = compare(write_series(tmp_path / "a.xlsx", values_at(result, times), times))
    assert_agrees(found, result)
    assert (found.places.cells, found.places.agreeing) == (448 * len(times),) * 2
    assert (found.speeds.cells, found.speeds.agreeing) == (224 * len(times),) * 2


def test_a_right_moment_agrees(tmp_path: Path) -> None:
    for moment in (CONTACT, 412.473838):
        found = compare(write_moment(tmp_path / "a.xlsx", values_at("result2", [moment])))
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


def noisy(size: float) -> FloatArray:
    table = values("result1")
    return table + np.random.default_rng(1).normal(0.0, size, table.shape)


def slip() -> FloatArray:
    table = values("result1").copy()
    table[1, 20, 7] *= -1.0
    return table


def drifting() -> FloatArray:
    """Handles that stand the farther off along the route the farther back they are, as by bisection."""
    walk, table = read_plan("spiral-in").build(), values("result1")
    points = walk.route.point(walk.motion(TIMES["result1"]).s - 2e-8 * np.arange(224))
    return np.stack([points[..., 0], points[..., 1], table[2]])


UNKNOWN: dict[str, tuple[Callable[[], FloatArray], str]] = {
    "noise": (lambda: noisy(1e-3), "numbers are off by more than 1e-06"),
    "large noise": (lambda: noisy(1.0), "20832 of 20832 numbers are off"),
    "one slip": (slip, "1 of 20832 numbers are off by more than 1e-06"),
    "lengths for links": (
        lambda: values("result1", "dragon.front_inset=0", "dragon.rear_inset=0"),
        "3.4100 m apart and those of all others 2.2000 m: these are the lengths of the benches",
    ),
    "holes too far in": (
        lambda: values("result1", "dragon.front_inset=0.3", "dragon.rear_inset=0.3"),
        "2.8100 m apart and those of all others 1.6000 m; the links are 2.86 / 1.65 m",
    ),
    "another pitch": (lambda: values("result1", "route.pitch=0.5"), "numbers are off"),
    "errors that add up": (drifting, "near the tail: errors of single benches add up"),
    "four decimals": (lambda: np.round(values("result1"), 4), "the numbers are rounded to 4 decimals"),
}


@pytest.mark.parametrize("name", UNKNOWN)
def test_what_fits_no_mistake_is_called_unknown(tmp_path: Path, name: str) -> None:
    make, remark = UNKNOWN[name]
    found = compare(write_series(tmp_path / "a.xlsx", make(), TIMES["result1"]))
    assert (found.mistake, found.amount, found.agrees) == ("unknown", None, False)
    assert found.finding == "no known mistake explains what is off"
    assert any(remark in said for said in found.remarks)


def test_two_mistakes_at_once_are_both_told(tmp_path: Path) -> None:
    wrong = turned(gradient(values("result1")), 1.0)
    found = compare(write_series(tmp_path / "a.xlsx", wrong, TIMES["result1"]))
    assert found.mistake == "rotated"
    assert found.residual > 1e-4
    assert any(said.startswith("beside that, numbers are off by up to") for said in found.remarks)
    assert "the speeds are central differences of the workbook's own positions" in found.remarks


def test_a_mistake_in_one_sheet_alone_is_told(tmp_path: Path) -> None:
    table = values("result1")
    wrong = with_speeds(table, shifted(table, 1)[2])
    found = compare(write_series(tmp_path / "a.xlsx", wrong, TIMES["result1"]))
    assert (found.mistake, found.amount) == ("handle", 1.0)
    assert "only the speeds show it" in found.remarks
    wrong = with_speeds(shifted(table, 1), table[2])
    found = compare(write_series(tmp_path / "a.xlsx", wrong, TIMES["result1"]))
    assert "only the positions show it" in found.remarks


def test_sheets_with_each_others_name_are_swapped(tmp_path: Path) -> None:
    names = ("速度", "位置")
    path = write_series(tmp_path / "a.xlsx", values("result1"), TIMES["result1"], sheets=names)
    found = compare(path)
    assert (found.mistake, found.agrees) == ("swapped", False)
    assert found.largest_place is not None
    assert found.largest_place < 1e-6
    assert found.finding.startswith("the names of the sheets are swapped")


def test_a_file_that_is_another_one_than_it_says_is_swapped(tmp_path: Path) -> None:
    times = ALL_TIMES["result4"]
    turn = write_series(tmp_path / "result1.xlsx", values_at("result4", times), times)
    found = compare(turn)
    assert (found.result, found.mistake) == ("result1", "swapped")
    assert found.residual < 5e-7
    assert_agrees(compare(turn, result="result4"), "result4")
    moment = write_moment(tmp_path / "Result 4 (2).xlsx", AT_CONTACT)
    found = compare(moment)
    assert (found.result, found.mistake) == ("result2", "swapped")
    assert found.finding == "the workbook is laid out as result2, not as result4"
    assert_agrees(compare(moment, result="result2"), "result2")


def test_empty_cells_and_missing_times_are_counted(tmp_path: Path) -> None:
    times = ALL_TIMES["result1"]
    table = values_at("result1", times)
    table[:, 5, 3] = np.nan
    found = compare(write_series(tmp_path / "a.xlsx", table, times))
    assert (found.mistake, found.agrees) == (None, False)
    assert (found.places.empty, found.speeds.empty) == (2, 1)
    assert found.remarks == ("3 of the 202272 cells that the contest asks for are empty",)
    first = found.first_departure
    assert first is not None
    assert (first.time, first.handle, first.quantity, first.theirs) == (5.0, 3, "x", None)
    assert first.exact == pytest.approx(values_at("result1", [5.0])[0, 0, 3], abs=1e-12)
    found = compare(write_series(tmp_path / "b.xlsx", table[:, ::60], times[::60]))
    assert (found.places.cells, found.places.empty) == (6 * 448, 295 * 448)


def test_the_first_departure_is_the_earliest_then_of_the_first_handle(tmp_path: Path) -> None:
    table = values("result1").copy()
    table[0, 20, 0] += 1.0
    table[2, 7, 9] += 1.0
    table[1, 7, 5] += 1e-4
    table[2, 7, 5] += 1e-4
    found = compare(write_series(tmp_path / "a.xlsx", table, TIMES["result1"]))
    first = found.first_departure
    assert first is not None
    assert (first.time, first.handle, first.quantity) == (277.0, 5, "y")
    assert first.theirs == round(table[1, 7, 5], 6)
    assert (found.places.handle, found.places.time) == (0, 290.0)
    assert (found.speeds.handle, found.speeds.time) == (9, 277.0)
    assert found.largest_speed == pytest.approx(1.0, abs=1e-6)


def test_the_tolerance_decides_what_is_off(tmp_path: Path) -> None:
    path = write_series(tmp_path / "a.xlsx", values("result1"), TIMES["result1"], decimals=4)
    assert compare(path).mistake == "unknown"
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
