"""One plan, one text: page, `check`, player and papers tell each number in the same digits."""

import json
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from benchdragon.analysis.check import Report, check, sentence
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.records import verdict_of
from benchdragon.cli.check import print_report
from benchdragon.errors import BenchDragonError
from benchdragon.i18n import spoken_in
from benchdragon.plans.presets import presets
from benchdragon.plans.schema import checked
from benchdragon.plans.toml import CONTEST
from benchdragon.player.scene import Span, checked_dance
from tests.engine.recording import node
from tests.planner.random_plans import Tables
from tests.planner.twins import asked
from tests.planner.verdicts import limited, there

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")

# A number in a text, as it is written there.
NUMBER = r"(-?\d+(?:\.\d+)?)"
# What texts say of the same: benches from one another, from what stands, the fastest handle, m and m/s.
GAPS = (
    rf"^least clearance: {NUMBER} m", rf"tightest {NUMBER} m", rf"between them, which keep {NUMBER} m",
    rf"tightest moment: {NUMBER} m", rf"nearest with one bench between: {NUMBER} m",
)  # fmt: skip
SPEEDS = (
    rf"^greatest speed of a handle: {NUMBER} m/s", rf"fastest moment: {NUMBER} m/s",
    rf"fastest handle {NUMBER} m/s", rf"moves at {NUMBER} m/s",
)  # fmt: skip
TOLD = {"gap": GAPS, "speed": SPEEDS}
# Times in the walk, s.
TIMES = (rf"t = {NUMBER} s", rf"(?:,|touch|bench) at {NUMBER} s", rf"first contact: {NUMBER} s")


def plans() -> dict[str, Tables]:
    """The contest's plans and short ones of villages, examples and random ones."""
    files = (ROOT / "examples").glob("*.toml")
    read = {path.name: tomllib.loads(path.read_text("utf-8")) for path in files}
    found = {name: data for name, data in read.items() if "drawn" not in name}
    plans = [(one.name, one.plan) for one in presets()]
    short = {name: plan.data() for name, plan in plans if name in CONTEST or plan.dragon.benches < 150}
    return found | short | {f"{seed}": limited(seed) for seed in range(400, 428)}


def few(report: Report) -> Span:
    """The whole dance, with few looks."""
    return Span(report.start, report.end, shares=(0.5,), times=60)


def said(report: Report, capsys: pytest.CaptureFixture[str]) -> Iterator[tuple[str, str]]:
    """Where something is said of a report by Python, and what."""
    capsys.readouterr()
    print_report(report)
    yield "check", capsys.readouterr().out
    yield "sentence", sentence(report)
    yield "papers", sentence(report, Clock("", report.start))
    dance = checked_dance(report, few(report))
    yield "player", "\n".join(one.text.en for one in dance.occasions)


def numbers(text: str, patterns: tuple[str, ...]) -> set[str]:
    return {found for one in patterns for found in re.findall(one, text, re.MULTILINE)}


@pytest.fixture(scope="module")
def judged() -> list[tuple[str, Report, Any]]:
    """Plans with what Python and the page find."""
    known = plans()
    twins = there(list(known.values()))
    pairs = []
    for (name, data), twin in zip(known.items(), twins, strict=True):
        try:
            report = check(checked(json.loads(json.dumps(data)), "plan"))
        except BenchDragonError:
            continue
        pairs.append((name, report, twin["found"]["verdict"]))
    assert len(pairs) >= 30
    return pairs


def test_every_text_tells_a_number_in_the_same_digits(
    judged: list[tuple[str, Report, Any]], capsys: pytest.CaptureFixture[str]
) -> None:
    seen = 0
    for name, report, _twin in judged:
        texts_of = dict(said(report, capsys))
        for what, patterns in TOLD.items():
            texts = {where: numbers(text, patterns) for where, text in texts_of.items()}
            different = {number for found in texts.values() for number in found}
            assert len(different) <= 1, (name, what, texts)
            seen += len([found for found in texts.values() if found])
    assert seen > 100


def test_the_page_says_what_python_says(judged: list[tuple[str, Report, Any]]) -> None:
    for name, report, twin in judged:
        own = verdict_of(report).model_dump(mode="json")
        assert twin["sentence"] == own["sentence"], name
        assert [one["text"] for one in twin["findings"]] == [one["text"] for one in own["findings"]]


def test_a_verdict_has_one_unit_of_length_and_times_in_hundredths(
    judged: list[tuple[str, Report, Any]], capsys: pytest.CaptureFixture[str]
) -> None:
    for name, report, _twin in judged[::3]:
        for where, text in said(report, capsys):
            assert " cm" not in text, (name, where)
            for time in numbers(text, TIMES):
                assert re.fullmatch(r"0|-?\d+\.\d\d", time), (name, where, time)


def test_benches_of_one_coil_are_not_called_tightest(judged: list[tuple[str, Report, Any]]) -> None:
    near = 0
    for _name, report, twin in judged:
        witness = report.clearance.witness
        if report.safe and witness is not None and abs(witness.benches[0] - witness.benches[1]) == 2:
            near += 1
            with spoken_in("en"):
                assert "tightest" not in sentence(report)
            assert "with one between them" in twin["sentence"]["en"]
    assert near > 3


def test_the_players_of_page_and_python_tell_the_same(
    judged: list[tuple[str, Report, Any]],
) -> None:
    some = judged[::4]
    questions = [
        {"plan": report.plan.data(), "judge": True,
         "shown": {"start": report.start, "end": report.end, "shares": [0.5], "times": 60}}
        for _name, report, _twin in some
    ]  # fmt: skip
    for (name, report, _twin), twin in zip(some, asked("dances.mjs", questions), strict=True):
        dance = checked_dance(report, few(report))
        own, page = (
            [one["text"]["en"] for one in sent["occasions"] if one["kind"] not in ("joint", "cue")]
            for sent in (dance.model_dump(mode="json"), twin["sent"])
        )
        assert own == page, name
