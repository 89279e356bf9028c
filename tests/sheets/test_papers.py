"""The verb that writes all papers: its options, what is in the way, interruption."""

import json
import wave
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest

from benchdragon.__main__ import asked_language
from benchdragon.cli.main import run
from benchdragon.export.metronome import LENGTH, sound
from benchdragon.i18n import spoken_in
from benchdragon.progress import Progress
from benchdragon.sheets import papers
from benchdragon.sheets.briefing import Briefing
from benchdragon.sheets.options import Options
from tests.sheets.village import PLAN, village

BENCHES = ["--only", "benches"]


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> Path:
    """A folder with a plan whose check is recorded."""
    monkeypatch.chdir(tmp_path)
    village(tmp_path, PLAN.replace("benches = 8", "benches = 3"))
    assert run(["check", "ours.dragon.toml", "--record"]) == 0
    capfd.readouterr()
    return tmp_path


@pytest.fixture(scope="module")
def known() -> dict[str, bytes]:
    """The benches' papers without further options, once they were made."""
    return {}


def come(folder: Path, *options: str) -> dict[str, bytes]:
    """The papers that options come to."""
    line = ["sheets", "ours.dragon.toml", "--force", *options]
    with spoken_in(asked_language(line) or "en"):
        assert run(line) == 0
    found = {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*.*")
        if path.suffix in (".pdf", ".html", ".xlsx", ".wav")
    }
    for name in found:
        (folder / name).unlink()
    return found


@pytest.mark.parametrize(
    "added",
    [
        ["--paper", "quarter"], ["--paper", "lanyard"], ["--night"], ["--lang", "zh"],
        ["-o", "elsewhere"], ["--only", "overview"], ["--check", "--set", "walk.end=11"],
    ],
)  # fmt: skip
def test_an_option_has_an_effect(here: Path, known: dict[str, bytes], added: list[str]) -> None:
    if not known:
        known |= come(here, *BENCHES)
        assert come(here, *BENCHES) == known, "the same twice"
    assert come(here, *BENCHES, *added) != known


def test_papers_are_the_same_in_any_folder(
    here: Path, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    elsewhere = tmp_path_factory.mktemp("elsewhere")
    for name in ("ours.dragon.toml", "ours.checked.json"):
        (elsewhere / name).write_bytes((here / name).read_bytes())
    made = come(here, *BENCHES)
    monkeypatch.chdir(elsewhere)
    assert come(elsewhere, *BENCHES) == made


def test_all_papers_are_written_unless_some_are_named(here: Path) -> None:
    assert set(come(here)) == {f"sheets/{file}" for one in papers.PAPERS.values() for file in one.files}


def test_the_player_bears_the_number_that_all_papers_bear(here: Path) -> None:
    made = come(here, "--only", "player,timetable")
    number = json.loads((here / "ours.checked.json").read_text("utf-8"))["sha256"]
    assert f'"papers_sha256": "{number}"'.encode() in made["sheets/player.html"].replace(
        b'":"', b'": "'
    )


def test_the_track_of_the_drum_counts_a_bar_in(here: Path) -> None:
    track = come(here, "--only", "beat,timetable")["sheets/beat.wav"]
    with wave.open(BytesIO(track)) as made:
        rate, frames = made.getframerate(), made.getnframes()
        heard = np.frombuffer(made.readframes(frames), "<i2")
    period = 0.6  # of a step at 1 m/s
    assert frames == round((12.0 + 4 * period + LENGTH) * rate)
    for n in range(5):
        start = round(n * period * rate)
        wanted = sound("count" if n < 4 else "bar", rate)[:400]
        np.testing.assert_allclose(heard[start : start + 400], wanted, atol=1.0)


@pytest.mark.parametrize("added", [["--scale", "1:200"], ["--paper-size", "A2"]])
def test_an_option_of_the_chalk_plan_has_an_effect(here: Path, added: list[str]) -> None:
    assert come(here, "--only", "chalk", *added) != come(here, "--only", "chalk")


@pytest.mark.parametrize(
    ("paper", "added", "said"),
    [
        ("overview", ["--night"], "--night goes with benches alone"),
        ("chalk", ["--phones"], "--phones goes with benches / overview alone"),
        ("benches", ["--scale", "1:200"], "--scale goes with chalk alone"),
    ],
)
def test_an_option_of_papers_that_are_not_written_is_refused(
    here: Path, paper: str, added: list[str], said: str, capfd: pytest.CaptureFixture[str]
) -> None:
    assert run(["sheets", "ours.dragon.toml", "--only", paper, *added]) == 2
    assert said in capfd.readouterr().err
    assert not (here / "sheets").exists()


def test_quiet_is_silent(here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    village(here, PLAN.replace("address", "# address"))
    assert run(["sheets", "ours.dragon.toml", *BENCHES, "--check"]) == 0
    assert "No QR codes" in capfd.readouterr().err
    assert run(["sheets", "ours.dragon.toml", *BENCHES, "--force", "--quiet"]) == 0
    assert capfd.readouterr().err == ""


def test_what_is_there_is_not_overwritten_unless_asked(
    here: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    (here / "sheets").mkdir()
    (here / "sheets" / "benches.pdf").write_text("mine", "utf-8")
    assert run(["sheets", "ours.dragon.toml"]) == 2
    assert "--force" in capfd.readouterr().err
    assert [path.name for path in (here / "sheets").iterdir()] == ["benches.pdf"]
    assert (here / "sheets" / "benches.pdf").read_text("utf-8") == "mine"


def test_an_unknown_paper_is_named(here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["sheets", "ours.dragon.toml", "--only", "benches,chart"]) == 2
    said = capfd.readouterr().err
    assert "'chart'" in said
    assert "overview" in said
    assert not (here / "sheets").exists()


def test_an_interruption_leaves_whole_papers_alone_and_names_them(
    here: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def interrupted(_briefing: Briefing, _folder: Path, _options: Options, _told: Progress) -> None:
        raise KeyboardInterrupt

    stopped = {
        "overview": papers.PAPERS["overview"],
        "player": papers.Paper("player", ("player.html",), interrupted),
    }
    monkeypatch.setattr(papers, "PAPERS", stopped)
    assert run(["sheets", "ours.dragon.toml"]) == 130
    assert [path.name for path in (here / "sheets").iterdir()] == ["overview.pdf"]
    assert (here / "sheets" / "overview.pdf").read_bytes().rstrip().endswith(b"%%EOF")
    said = capfd.readouterr().err
    assert f"were not made: {Path('sheets/overview.pdf')}\n" in said
    assert "player.html" not in said
    monkeypatch.setattr(papers, "PAPERS", {"player": stopped["player"]})
    assert run(["sheets", "ours.dragon.toml"]) == 130
    assert "whole, and" not in capfd.readouterr().err
