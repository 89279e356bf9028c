import json
from pathlib import Path

import numpy as np
import pytest

from benchdragon.__main__ import asked_language
from benchdragon.cli.main import run
from benchdragon.i18n import spoken_in
from tests.paper.workbooks import CONTACT, TIMES, values, values_at, write_moment, write_series


@pytest.fixture
def right(tmp_path: Path) -> str:
    return str(write_moment(tmp_path / "right.xlsx", values_at("result2", [CONTACT])))


@pytest.fixture
def late(tmp_path: Path) -> str:
    return str(write_moment(tmp_path / "late.xlsx", values_at("result2", [413.0])))


def test_a_right_workbook_ends_with_0(
    right: str, capsys: pytest.CaptureFixture[str], spoken: str
) -> None:
    assert run(["compare", right]) == 0
    out = capsys.readouterr().out
    assert ("AGREES\n  all numbers agree\n" if spoken == "en" else "一致\n  所有数值都一致\n") in out
    assert "100.0 %" in out
    assert out.splitlines()[-1] == ("Points: 100 of 100" if spoken == "en" else "得分：100（满分 100）")
    assert len(out.splitlines()) == 7


def test_a_wrong_workbook_ends_with_1_and_its_mistake(
    late: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["compare", late, "--lang", "en"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert "DOES NOT AGREE" in lines
    assert lines[-5] == (
        "  the moment is 413.000000 s, not that of first contact, 412.473838 s: it is the first one "
        "after it in steps of 1 s"
    )
    assert lines[-4].startswith("  what that leaves unexplained is ")
    assert lines[-3] == "  671 of 672 numbers are off by more than 1e-06"
    assert lines[-2] == ("first departure: x of Head at t = 412.473838 s is 1.60786, exactly 1.209931")


def test_language_and_quiet_have_an_effect(late: str, capsys: pytest.CaptureFixture[str]) -> None:
    told = []
    for options in (["--lang", "en"], ["--lang", "zh"], ["--lang", "en", "--quiet"]):
        with spoken_in(asked_language(["compare", late, *options]) or "en"):
            assert run(["compare", late, *options]) == 1
        told.append(capsys.readouterr())
    plain, chinese, quiet = told
    assert "DOES NOT AGREE" in plain.out
    assert "不一致" in chinese.out
    assert (quiet.out, quiet.err) == (plain.out, "")


def test_json_says_all_of_it(late: str, right: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["compare", late, "--json"]) == 1
    (answer,) = json.loads(capsys.readouterr().out)["graded"]
    assert (answer["mistake"], answer["result"], answer["agrees"]) == ("time", "result2", False)
    assert answer["first_departure"]["time"] == pytest.approx(CONTACT, abs=1e-9)
    assert 0.5 < answer["largest_place"] < 0.6
    assert answer["places"]["largest"] == answer["largest_place"]
    assert answer["speeds"]["largest"] == answer["largest_speed"] > 1e-5
    assert run(["compare", right, "--json"]) == 0
    (answer,) = json.loads(capsys.readouterr().out)["graded"]
    assert (answer["mistake"], answer["first_departure"], answer["remarks"]) == (None, None, [])


def test_what_a_workbook_is_to_be_can_be_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = str(write_series(tmp_path / "a.xlsx", values("result4"), TIMES["result4"]))
    for result, mistake in (("result1", "swapped"), ("result4", None), ("result2", "swapped")):
        assert run(["compare", path, "--as", result, "--json"]) == 1  # most times are missing
        assert json.loads(capsys.readouterr().out)["graded"][0]["mistake"] == mistake


def test_empty_cells_and_a_wide_tolerance(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table = values_at("result2", [CONTACT])
    table[2, 0, 7] = np.nan
    path = tmp_path / "a.xlsx"
    write_moment(path, np.where(np.isnan(table), 1e300, table))
    assert run(["compare", str(path), "--lang", "en"]) == 1
    out = capsys.readouterr().out
    assert "  1 of the 672 cells that the contest asks for are empty" in out
    assert "first departure: speed of Body 7 at t = 412.473838 s is empty, exactly 0.9" in out
    write_moment(path, values_at("result2", [412.48]))
    assert run(["compare", str(path), "--tolerance", "0.01", "--quiet"]) == 0


def test_workbooks_and_numbers_are_graded_together(
    right: str, late: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["compare", right, "contact=412.473838", "--lang", "en"]) == 0
    assert capsys.readouterr().out.endswith("figures that agree: 9\nPoints: 100 of 100\n")
    assert run(["compare", "head=1,2", "pitch=0.43", right, "--json"]) == 1
    whole = json.loads(capsys.readouterr().out)
    assert [one["score"] for one in whole["graded"]] == [0.0, 0.0, 1.0]
    assert (whole["agrees"], whole["score"]) == (False, pytest.approx(1.0 / 3.0))
    assert whole["graded"][1]["finding"].endswith("only when the head reaches the disc")
    assert run(["compare", late, "--json"]) == 1
    whole = json.loads(capsys.readouterr().out)
    assert whole["score"] == pytest.approx(1.0 / 672.0)


def test_an_answer_that_is_no_number_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    for given in ("pitch=", "pitch=wide", "pitch=1,", "pitch=nan"):
        assert run(["compare", given, "--lang", "en"]) == 2
        assert "pitch must be a number, or several with commas" in capsys.readouterr().err
