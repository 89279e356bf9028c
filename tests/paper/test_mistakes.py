"""Workbooks made wrong on purpose: each mistake is named, whatever single cells hold."""

from pathlib import Path

import numpy as np
import pytest

from benchdragon.model.numbering import handle_names
from benchdragon.paper.compare import compare
from tests.paper.workbooks import (
    CONTACT,
    TIMES,
    Compared,
    values,
    values_at,
)
from tests.paper.wrong_workbooks import (
    AT_CONTACT,
    ENTRIES,
    MISTAKES,
    MOMENTS,
    PAIRS,
    ROUNDED,
    UNKNOWN,
    gradient,
    not_yet_in,
    shifted,
    slip,
    spoilt,
    turned,
    with_speeds,
)

WORKBOOKS = Path(__file__).parents[1] / "cases" / "workbooks"


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_made_on_purpose_is_named(compared: Compared, name: str) -> None:
    result, make, mistake, amount, sentence = MISTAKES[name]
    found = compared(make(), TIMES[result], name=f"{result}.xlsx")
    assert (found.result, found.mistake, found.agrees) == (result, mistake, False)
    assert sentence in found.finding
    assert found.amount == (None if amount is None else pytest.approx(amount, abs=1e-6))
    assert found.residual < ROUNDED.get(name, 5e-7)
    assert found.first_departure is not None
    assert max(found.largest_place or 0.0, found.largest_speed or 0.0) > 1e-5


@pytest.mark.parametrize("name", MISTAKES)
def test_wrong_cells_beside_a_mistake_hide_nothing(compared: Compared, name: str) -> None:
    """Each mistake with one to three cells that hold anything: it is named, and they beside it."""
    result, make, mistake, amount, sentence = MISTAKES[name]
    wrong, cells = spoilt(make(), sum(map(ord, name)))
    found = compared(wrong, TIMES[result], name=f"{result}.xlsx")
    assert (found.result, found.mistake) == (result, mistake)
    assert sentence in found.finding
    assert found.amount == (None if amount is None else pytest.approx(amount, abs=1e-6))
    assert found.residual < ROUNDED.get(name, 5e-7)
    said = [text for text in found.remarks if text.startswith("beside that, ")]
    assert len(said) == len(cells)
    for axis, row, handle in cells:
        quantity, bench = ("x", "y", "speed")[axis], handle_names(224)[handle]
        start = f"beside that, {quantity} of {bench} at t = {TIMES[result][row]:g} s is "
        assert any(text.startswith(start) for text in said)


@pytest.mark.parametrize("name", MOMENTS)
def test_wrong_cells_hide_nothing_of_one_moment(compared: Compared, name: str) -> None:
    make, mistake, amount = MOMENTS[name]
    for seed in range(3):
        share = np.random.default_rng(seed).uniform()
        wrong, cells = spoilt(make(share), seed)
        found = compared(wrong, name="result2.xlsx")
        wanted = amount(share)
        assert found.mistake == mistake
        assert found.amount == (None if wanted is None else pytest.approx(wanted, abs=1e-6, rel=1e-7))
        assert found.beside == len(cells)
        assert found.residual < 5e-7


def test_two_wrong_speeds_among_equal_ones_are_no_rounding(compared: Compared) -> None:
    wrong = with_speeds(values("result1"), np.ones((31, 224)))
    wrong[2, 21, 98], wrong[2, 1, 140] = -1742.09, 847.0
    found = compared(wrong, TIMES["result1"])
    assert (found.mistake, found.finding) == ("handle", "all speeds are the head's")
    assert found.beside == 2


CARRIED: dict[str, tuple[str | None, float | None, str, str]] = {
    "b1_zeros/result1": (
        "entry", 13740.0,
        "not yet in, outside the first point of the spiral, are 0: 13740 cells", "",
    ),
    "b2_line/result1": (
        "entry", None, "benches that are not yet in wait on the line x = 8.8",
        "only the positions show it",
    ),
    "b4_far_format/result1": (None, None, "all numbers that are there agree", ""),
    "b5_backward_head_1/result1": (
        "differences", 1.0, "the speeds are backward differences of positions with a step of 1 s", "",
    ),
    "b7_typo/result2": (
        "time", 413.0 - CONTACT, "the moment is 413.000000 s",
        "beside that, x of Body 48 at t = 412.473838 s is 104.398714, where 4.398714 is expected",
    ),
    "b9_micro/result2": ("time", -1e-6, "-1.0e-06 s off that of first contact", ""),
}  # fmt: skip


@pytest.mark.parametrize("name", CARRIED)
def test_workbooks_of_others_get_their_names(name: str) -> None:
    mistake, amount, sentence, remark = CARRIED[name]
    found = compare(WORKBOOKS / f"{name}.xlsx")
    assert (found.mistake, found.result) == (mistake, name.rpartition("/")[2])
    assert found.amount == (None if amount is None else pytest.approx(amount, abs=1e-7))
    assert sentence in found.finding
    assert remark in (*found.remarks, "")
    assert found.beside == remark.startswith("beside that, ")
    assert found.residual < 5e-7


@pytest.mark.parametrize("change", ENTRIES)
def test_benches_that_are_not_yet_in_are_seen(compared: Compared, change: str) -> None:
    found = compared(not_yet_in(change), np.arange(21.0))
    assert (found.mistake, found.agrees) == ("entry", False)
    assert ENTRIES[change] in found.finding


@pytest.mark.parametrize("name", PAIRS)
def test_two_mistakes_are_both_named(compared: Compared, name: str) -> None:
    result, make, mistake, sentences = PAIRS[name]
    wrong, _cells = spoilt(make(), sum(map(ord, name)))
    found = compared(wrong, TIMES[result], name=f"{result}.xlsx")
    assert found.mistake == mistake
    for sentence in sentences:
        assert any(sentence in text for text in (found.finding, *found.remarks))


def test_single_wrong_cells_rows_and_columns_are_told(compared: Compared) -> None:
    table, times = values("result1"), TIMES["result1"]
    row, column = table.copy(), table.copy()
    row[:, :, 9] += 0.5
    column[:, 7] += 0.5
    for wrong, text in (
        (slip(), "1 of 20832 numbers are off; all others agree"),
        (row, "93 of 20832 numbers are off, all of Body 9; all others agree"),
        (column, "672 of 20832 numbers are off, all at t = 277 s; all others agree"),
    ):
        found = compared(wrong, times)
        assert (found.mistake, found.finding) == ("cells", text)
        assert found.residual < 5e-7
    assert any(said.startswith("beside that, ") for said in found.remarks)


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
    compared: Compared, moment: float, sentence: str
) -> None:
    found = compared(values_at("result2", [moment]))
    assert (found.result, found.mistake, found.unit) == ("result2", "time", "s")
    assert found.amount == pytest.approx(moment - CONTACT, abs=2e-6 if moment < 440.0 else 1e-3)
    assert f"the moment is {moment:.2f}" in found.finding
    assert sentence in found.finding


@pytest.mark.parametrize("seed", range(20))
def test_every_angle_is_recovered(compared: Compared, seed: int) -> None:
    angle = np.random.default_rng(seed).uniform(-np.pi, np.pi)
    found = compared(turned(AT_CONTACT, angle))
    assert (found.mistake, found.unit) == ("rotated", "rad")
    assert found.amount == pytest.approx(angle, abs=1e-6)
    found = compared(turned(AT_CONTACT, angle, mirror=True))
    assert found.mistake == "mirrored"
    assert found.amount == pytest.approx(angle / 2.0, abs=1e-6)


@pytest.mark.parametrize("seed", range(20))
def test_every_moment_is_recovered(compared: Compared, seed: int) -> None:
    moment = np.random.default_rng(seed).uniform(0.0, 440.0)
    found = compared(values_at("result2", [moment]))
    assert found.mistake == "time"
    assert found.amount == pytest.approx(moment - CONTACT, abs=3e-6)


@pytest.mark.parametrize("name", UNKNOWN)
def test_what_fits_no_mistake_is_called_unknown(compared: Compared, name: str) -> None:
    make, remark = UNKNOWN[name]
    found = compared(make(), TIMES["result1"])
    assert (found.mistake, found.amount, found.agrees) == ("unknown", None, False)
    assert found.finding == "no known mistake explains what is off"
    assert any(remark in said for said in found.remarks)


def test_two_mistakes_at_once_are_both_told(compared: Compared) -> None:
    wrong = turned(gradient(values("result1")), 1.0)
    found = compared(wrong, TIMES["result1"])
    assert found.mistake == "rotated"
    assert found.residual < 5e-7
    text = "the speeds are central differences of the workbook's own positions, 1 s apart"
    assert text in found.remarks


def test_a_mistake_in_one_sheet_alone_is_told(compared: Compared) -> None:
    table = values("result1")
    wrong = with_speeds(table, shifted(table, 1)[2])
    found = compared(wrong, TIMES["result1"])
    assert (found.mistake, found.amount) == ("handle", 1.0)
    assert "only the speeds show it" in found.remarks
    wrong = with_speeds(shifted(table, 1), table[2])
    found = compared(wrong, TIMES["result1"])
    assert "only the positions show it" in found.remarks
