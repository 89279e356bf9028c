"""The skeleton of the contest's five questions: it runs as it is, and whole when it is filled in."""

import json
from pathlib import Path

import nbformat
import pytest

import benchdragon as bd
from benchdragon.cli.main import run
from benchdragon.i18n import spoken_in
from benchdragon.paper.starter import notebook, script

# What a student would write in the places of what is to be done.
SOLVED = {
    "16 * pitch, 0.0, 1.0  # TODO: true at 0 s alone": "1.0, 1.0, 1.0\n"
    '    m = bd.read_plan("spiral-in").motion(times)\n    x, y, speed = m.x, m.y, m.speed',
    "    speed[:, 0] = 1.0\n": '    m = bd.read_plan("turn").motion(times)\n'
    "    x, y, speed = m.x, m.y, m.speed\n",
    "contact = NOT_YET": "contact = 412.473838",
    "\npitch = NOT_YET": "\npitch = 0.450337",
    "length = NOT_YET": "length = 13.6212",
    "head_speed = NOT_YET": "head_speed = 1.246266",
}  # fmt: skip


def ran(code: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> list[str]:
    """What a script says, run in a folder."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        exec(compile(code, "contest.py", "exec"), {"__name__": "__main__"})
    return capsys.readouterr().out.splitlines()


def test_the_skeleton_runs_and_earns_next_to_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said = ran(script(), tmp_path, capsys)
    names = ["result1", "contact", "result2", "pitch", "turn-length", "result4", "head-speed"]
    assert [line.split(":")[0] for line in said] == names
    assert {line.split(": ")[1] for line in said} == {"0 of 100 points", "0.1 of 100 points"}
    assert bd.compare(tmp_path / "result1.xlsx").score == 303 / 202272


def test_filled_in_it_earns_all_points(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code = script()
    for todo, done in SOLVED.items():
        assert code.count(todo) == 1, todo
        code = code.replace(todo, done)
    said = ran(code, tmp_path, capsys)
    assert [line for line in said if ": 100 of 100 points" not in line] == []


def test_script_and_notebook_hold_the_same_in_both_languages() -> None:
    codes = []
    for language in ("en", "zh"):
        with spoken_in(language):
            book, text = json.loads(notebook()), script()
        nbformat.validate(book)
        told = [cell["source"] for cell in book["cells"] if cell["cell_type"] == "markdown"]
        codes.append([cell["source"] for cell in book["cells"] if cell["cell_type"] == "code"])
        assert all(code in text for code in codes[-1])
        assert all(f"# {line}" in text for part in told for line in part.splitlines() if line)
        assert ("板凳龙" in told[0]) == (language == "zh")
    assert codes[0] == codes[1]


def test_the_verb_writes_either_and_no_other_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, text in (("contest.py", script()), ("contest.ipynb", notebook())):
        assert run(["starter", "-o", str(tmp_path / name)]) == 0
        assert (tmp_path / name).read_text("utf-8") == text
    assert run(["starter", "-o", str(tmp_path / "contest.py")]) == 2
    assert run(["starter", "-o", str(tmp_path / "contest.txt")]) == 2
    assert "expected a name that ends in .py, .ipynb" in capsys.readouterr().err
