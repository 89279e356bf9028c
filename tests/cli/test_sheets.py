"""The verb that makes all papers: what the page holds, what is in the way, browsers, interruption."""

import json
import os
import wave
from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchdragon.__main__ import asked_language
from benchdragon.cli.main import run
from benchdragon.export.metronome import LENGTH, sound
from benchdragon.i18n import spoken_in
from benchdragon.planner import printing
from benchdragon.plans.schema import read_plan
from benchdragon.progress import Progress
from tests.browser.village import PLAN, village
from tests.player.test_page import Parsed

LIST = "桥号,姓名,户主,电话,备注\n龙头,张三,张家,138-0000-0001,wet paint\n1,王五,王家,,\n99,钱七,,,\n"


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a plan that has a list of names."""
    monkeypatch.chdir(tmp_path)
    village(tmp_path, PLAN.replace("benches = 8", "benches = 3") + 'roster = "names.csv"\n')
    (tmp_path / "names.csv").write_text(LIST, "utf-8")
    return tmp_path


def come(*options: str) -> str:
    """The page that options come to."""
    line = ["sheets", "ours.dragon.toml", "--force", *options]
    with spoken_in(asked_language(line) or "en"):
        assert run(line) == 0
    return Path("papers.html").read_text("utf-8")


def held(page: str, name: str) -> Any:
    return json.loads(Parsed(page).one("script", id=name)[1])


def test_the_page_holds_the_plan_its_names_and_all_papers(here: Path) -> None:
    page = come()
    assert come() == page, "the same twice"
    assert held(page, "plan") == read_plan("ours.dragon.toml").data()
    wanted = held(page, "papers")
    people, notes = wanted["names"]["people"], wanted["names"]["notes"]
    assert [(bench, [one["name"] for one in there]) for bench, there in people] == [
        (1, ["张三"]), (2, ["王五"]),
    ]  # fmt: skip
    assert people[0][1][0]["household"] == "张家"
    assert people[0][1][0]["remarks"] == "wet paint"
    assert any("has no qiao 99" in note for note in notes)
    assert "138-0000" not in page, "phones stay in the list"
    del wanted["names"]
    assert wanted == {
        "only": [], "paper": "a4", "households": False, "night": False, "phones": False,
    }  # fmt: skip


@pytest.mark.parametrize(
    ("added", "name", "value"),
    [
        (["--only", "overview"], "only", ["overview"]),
        (["--paper", "quarter"], "paper", "quarter"),
        (["--paper", "lanyard"], "paper", "lanyard"),
        (["--by", "household"], "households", True),
        (["--night"], "night", True),
        (["--phones"], "phones", True),
    ],
)
def test_an_option_is_what_the_page_opens_with(
    here: Path, added: list[str], name: str, value: object
) -> None:
    page = come(*added)
    assert held(page, "papers")[name] == value
    assert ("138-0000-0001" in page) == (name == "phones")


def test_the_page_is_in_the_language_asked_for_and_about_the_plan_as_it_is_set(here: Path) -> None:
    page = come("--lang", "zh", "--set", "walk.end=11")
    assert held(page, "language") == "zh"
    assert held(page, "plan")["walk"]["end"] == 11
    assert any("99" in note and "桥" in note for note in held(page, "papers")["names"]["notes"])


def test_papers_are_of_the_plan_and_the_list_as_they_are_now(here: Path) -> None:
    come()
    (here / "names.csv").write_text(LIST.replace("王五", "赵六"), "utf-8")
    page = come("-o", "papers.html")
    assert "赵六" in page
    assert "王五" not in page


def test_a_plan_that_names_nobody_has_papers_without_names(here: Path) -> None:
    village(here)
    assert held(come(), "papers")["names"] is None


def test_a_built_in_plan_has_papers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(["sheets", "turn", "--set", "dragon.benches=5", "-o", "a/turn.html", "--quiet"]) == 0
    assert held(Path("a/turn.html").read_text("utf-8"), "papers")["only"] == []


def test_a_plan_that_is_not_safe_has_no_papers(here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    line = ["sheets", "ours.dragon.toml", "--pdf", "out", "--set", "limits.speed=0.1"]
    assert run(line) == 1
    out, said = capfd.readouterr()
    assert "NOT SAFE" in out
    assert "No papers were written: only a plan that is safe has any." in said
    assert not (here / "papers.html").exists()
    assert list((here / "out").iterdir()) == []


@pytest.mark.parametrize(
    ("paper", "added", "said"),
    [
        ("overview", ["--night"], "--night goes with benches alone"),
        ("beat", ["--phones"], "--phones goes with benches / overview alone"),
        ("benches,chart", [], "'chart'"),
        ("benches", ["-o", "papers.pdf"], "expected a name that ends in .html"),
    ],
)
def test_what_cannot_be_meant_is_refused(
    here: Path, paper: str, added: list[str], said: str, capfd: pytest.CaptureFixture[str]
) -> None:
    assert run(["sheets", "ours.dragon.toml", "--only", paper, *added]) == 2
    told = capfd.readouterr().err
    assert told.count("\n") == 1
    assert said in told
    assert not (here / "papers.html").exists()


def test_quiet_is_silent(here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    village(here, PLAN.replace("address", "# address"))
    assert run(["sheets", "ours.dragon.toml"]) == 0
    assert "No QR codes" in capfd.readouterr().err
    assert run(["sheets", "ours.dragon.toml", "--force", "--quiet"]) == 0
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize("there", ["papers.html", "out/overview.pdf"])
def test_what_is_there_is_not_overwritten_unless_asked(
    here: Path, there: str, capfd: pytest.CaptureFixture[str]
) -> None:
    (here / "out").mkdir()
    (here / there).write_text("mine", "utf-8")
    assert run(["sheets", "ours.dragon.toml", "--pdf", "out"]) == 2
    assert "--force" in capfd.readouterr().err
    assert (here / there).read_text("utf-8") == "mine"
    assert (there == "papers.html") == (here / "papers.html").exists()


def browser(here: Path, monkeypatch: pytest.MonkeyPatch, script: str) -> None:
    """Have a script be the only browser of this machine."""
    (here / "bin").mkdir()
    if script:
        path = here / "bin" / "chromium"
        path.write_text(f"#!/bin/sh\n{script}\n", "utf-8")
        path.chmod(0o755)
    monkeypatch.setenv("PATH", f"{here / 'bin'}{os.pathsep}/bin" if script else str(here / "bin"))
    monkeypatch.setattr(printing, "CHROMIUMS", ("chromium",))
    monkeypatch.setattr(printing, "FIREFOXES", ())
    monkeypatch.setattr(printing, "PLACES", ())


def test_without_a_browser_there_is_the_page_and_how_to_print_it(
    here: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    browser(here, monkeypatch, "")
    assert run(["sheets", "ours.dragon.toml", "--pdf", "out", "--quiet"]) == 6
    said = capfd.readouterr().err
    assert said.count("\n") == 1
    assert "install Chromium, Chrome, Edge or Firefox; or open papers.html in any browser" in said
    assert (here / "papers.html").exists()
    assert list((here / "out").iterdir()) == []


@pytest.mark.parametrize(
    ("script", "said"),
    [
        ("echo 'no display' >&2; exit 3", "chromium did not print: no display"),
        ("exit 3", "chromium did not print: 3"),
        (
            "echo 'DevTools listening on ws://127.0.0.1:9/devtools/browser/x' >&2; sleep 60",
            "chromium did not print: it is gone, or does not answer",
        ),
    ],
)
def test_a_browser_that_fails_is_told_in_a_sentence(
    here: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
    script: str,
    said: str,
) -> None:
    browser(here, monkeypatch, script)
    assert run(["sheets", "ours.dragon.toml", "--pdf", "out", "--quiet"]) == 6
    told = capfd.readouterr().err
    assert told.count("\n") == 1
    assert said in told
    assert list((here / "out").iterdir()) == []


def test_an_interruption_leaves_whole_papers_alone_and_names_them(
    here: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def interrupted(_name: str, _page: Path, files: Mapping[str, Path], _told: Progress) -> None:
        files["benches"].write_bytes(b"%PDF")
        raise KeyboardInterrupt

    monkeypatch.setattr(printing, "print_papers", interrupted)
    assert run(["sheets", "ours.dragon.toml", "--pdf", "out"]) == 130
    assert [path.name for path in (here / "out").iterdir()] == ["benches.pdf"]
    said = capfd.readouterr().err
    assert f"were not made: papers.html, {Path('out/benches.pdf')}\n" in said


def test_the_track_of_the_drum_counts_a_bar_in(here: Path) -> None:
    come("--only", "beat", "--pdf", "out")
    with wave.open(BytesIO((here / "out" / "beat.wav").read_bytes())) as made:
        rate, frames = made.getframerate(), made.getnframes()
        heard = np.frombuffer(made.readframes(frames), "<i2")
    period = 0.6  # of a step at 1 m/s
    assert frames == round((12.0 + 4 * period + LENGTH) * rate)
    for n in range(5):
        start = round(n * period * rate)
        wanted = sound("count" if n < 4 else "bar", rate)[:400]
        np.testing.assert_allclose(heard[start : start + 400], wanted, atol=1.0)
