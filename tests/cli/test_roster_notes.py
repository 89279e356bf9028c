"""Mistakes of a list of names are told on the screen, a handful at most."""

from pathlib import Path

import pytest

from benchdragon.cli.main import run
from benchdragon.cli.options import MOST_TOLD

PLAN = """
schema = 1
[dragon]
benches = 9
[[route.part]]
kind = "line"
length = 20
[people]
roster = "names.csv"
"""
SHEETS = ["sheets", "mine.dragon.toml", "--only", "overview", "-o", "papers.html"]
LINES = [["check", "mine.dragon.toml"], SHEETS]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.dragon.toml").write_text(PLAN, "utf-8")
    rows = ["桥号,姓名", "1,张三", "1,张三", "99,周九", "甲,吴十", "2,李四", "3,李四"]
    (tmp_path / "names.csv").write_text("\n".join(rows), "utf-8")
    return tmp_path


@pytest.mark.parametrize("line", LINES)
def test_each_mistake_is_told_in_a_sentence(
    folder: Path, line: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([*line, "--lang", "en"]) == 0
    told = capsys.readouterr().err
    for words in ("named twice at bench 1", "no bench 99", "'甲' is no number", "nobody is named for"):
        assert told.count(words) == 1
    assert "more: see the overview" not in told
    assert run([*line, *(["--force"] if "-o" in line else []), "--quiet"]) == 0
    assert "List of names" not in capsys.readouterr().err


def test_of_many_mistakes_a_handful_is_told_and_the_benches_that_nobody_carries(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rows = ["桥号,姓名", *(f"{100 + n},某{n}" for n in range(20))]
    (folder / "names.csv").write_text("\n".join(rows), "utf-8")
    assert run(["check", "mine.dragon.toml", "--lang", "en"]) == 0
    told = capsys.readouterr().err
    assert told.count("List of names: ") == MOST_TOLD + 1
    assert "nobody is named for bench 1 to bench 9" in told
    assert f"and {21 - MOST_TOLD} more: see the overview" in told


def test_a_list_that_is_not_there_is_told_and_refused_only_for_papers(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "names.csv").unlink()
    assert run(["check", "mine.dragon.toml"]) == 0
    assert "names.csv" in capsys.readouterr().err
    assert run(SHEETS) == 3
