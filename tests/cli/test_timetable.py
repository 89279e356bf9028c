"""`benchdragon timetable`: the rows of the paper, in a terminal and as JSON."""

import json
from pathlib import Path

import pytest

from benchdragon.analysis.ground import Ground
from benchdragon.analysis.timetable import timetable
from benchdragon.cli.main import run
from benchdragon.explain.timetable_text import timetable_text
from benchdragon.i18n import spoken_in
from benchdragon.plans.schema import Plan, read_plan

SETTINGS = (
    "dragon.benches=4", "walk.end=30", "route.start_turn=6", "cues.clock=18:30",
    'cues.cue=[{kind="hold", head=9, hold=3, text="bow", text_zh="拜庙"}]',
)  # fmt: skip
LINE = ["timetable", "spiral-in", *(word for setting in SETTINGS for word in ("--set", setting))]


@pytest.fixture(scope="module")
def plan() -> Plan:
    return read_plan("spiral-in", SETTINGS)


@pytest.mark.parametrize(("language", "word"), [("en", "bow"), ("zh", "拜庙")])
def test_a_terminal_shows_the_rows_of_the_paper(
    plan: Plan, capsys: pytest.CaptureFixture[str], language: str, word: str
) -> None:
    walk = plan.build()
    with spoken_in(language):
        assert run(LINE) == 0
        span = plan.span(walk)
        passings, ground = timetable(plan, walk, *span), Ground.of(plan, walk.route)
        text = timetable_text(plan, walk, span, ground, passings)
    lines = capsys.readouterr().out.splitlines()
    shown = [line.split("\t") for line in lines if "\t" in line]
    assert shown[1:] == [[cell.replace("\n", "; ") for cell in row] for row in text.rows]
    assert lines[-len(text.lines) :] == list(text.lines)
    assert word in [row[0] for row in text.rows]
    assert any("18:30:10" in cell for row in text.rows for cell in row)


def test_as_json_the_rows_are_numbers(plan: Plan, capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*LINE, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    walk = plan.build()
    passings = timetable(plan, walk, *plan.span(walk))
    assert [one["name"] for one in found["places"]] == [one.name for one in passings]
    for shown, one in zip(found["places"], passings, strict=True):
        assert (shown["head"], shown["until"], shown["tail"]) == (one.head, one.until, one.tail)
        assert shown["point"] == list(one.point)
    assert [round(one["end"] - one["start"], 9) for one in found["stops"]] == [3.0]
    assert (found["clock"], found["plan_sha256"]) == ("18:30", plan.sha256)


def test_what_is_no_plan_is_refused_in_a_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["timetable", str(tmp_path / "none.toml")]) == 3
    assert "none.toml" in capsys.readouterr().err
