import re
import runpy
import shutil
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest
from PIL import Image

from benchdragon.cli.main import run
from benchdragon.plans.schema import read_plan

ROOT = Path(__file__).parent.parent
PLANS = sorted((ROOT / "examples").glob("*.dragon.toml"))
READMES = ["README.md", "README.zh-CN.md"]
SCRIPTS = sorted((ROOT / "examples").glob("*.py"))


def test_there_are_examples() -> None:
    assert len(PLANS) >= 5
    assert SCRIPTS


@pytest.mark.parametrize("path", PLANS, ids=lambda path: path.name)
def test_an_example_plan_walks_from_its_start_to_its_end(path: Path, tmp_path: Path) -> None:
    plan = read_plan(str(path))
    assert plan.title("en") != plan.title("zh")
    assert run(["motion", str(path), "-o", str(tmp_path), "--format", "csv", "--quiet"]) == 0
    walk = plan.build()
    assert plan.walk.start is not None
    assert plan.walk.end is not None
    assert walk.motion([plan.walk.start, plan.walk.end]).chord_error < 1e-12


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.name)
def test_an_example_script_runs(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    runpy.run_path(str(path), run_name="__main__")
    assert capsys.readouterr().out


def shell_lines(page: str) -> list[str]:
    """The command lines of a page's shell blocks that call the program."""
    blocks = page.split("```sh\n")[1:]
    lines = [line for block in blocks for line in block.split("```")[0].splitlines()]
    return [line.split("#")[0].strip() for line in lines if line.startswith("benchdragon ")]


# Commands that answer "not safe" or "undecided", and say so by how they end.
ENDINGS = {
    "benchdragon check spiral-in": 1,
    "benchdragon solve pitch spiral-in --set disc.radius=4.5 --method traversal": 5,
}


def python_blocks(page: str) -> list[str]:
    """The Python blocks of a page."""
    return [block.split("```")[0] for block in page.split("```python\n")[1:]]


# Of commands that take seconds, what makes their work less, not their answer another.
TURN = "benchdragon solve turn turn --set turn.family=arc-line-arc --set walk.speed=1.3"
LESS = {
    "benchdragon margins": "--draws 3 --set dragon.benches=60",
    "benchdragon check spiral-in --set disc.radius=4.5": "--set dragon.benches=60",
    "benchdragon check examples/01_parade.dragon.toml --prove": "--set walk.end=185",
    "benchdragon view turn -o out/turn.mp4": "--fps 4",
    f"{TURN} --prove": "--within 3",
}


def test_every_command_of_the_manual_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    commands = shell_lines((ROOT / "docs/en/commands.md").read_text("utf-8"))
    assert len(commands) > 40
    assert all(any(command.startswith(start) for command in commands) for start in LESS)
    for command in commands:
        less = " ".join(words for start, words in LESS.items() if command.startswith(start))
        assert run([*command.split()[1:], *less.split()]) == ENDINGS.get(command, 0), command


@pytest.mark.parametrize("name", [*READMES, "docs/en/api.md", "docs/zh/api.md"])
def test_every_line_of_python_on_a_page_prints_what_is_promised(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    names: dict[str, object] = {}
    assert python_blocks((ROOT / name).read_text("utf-8"))
    for block in python_blocks((ROOT / name).read_text("utf-8")):
        exec(compile(block, name, "exec"), names)
        printed = capsys.readouterr().out.splitlines()
        promised = [line.split("# ")[1] for line in block.splitlines() if "print(" in line]
        assert printed == promised


def test_both_readmes_show_the_same_few_commands_of_the_manual() -> None:
    texts = [(ROOT / name).read_text("utf-8") for name in READMES]
    assert shell_lines(texts[0]) == shell_lines(texts[1])
    manual = shell_lines((ROOT / "docs/en/commands.md").read_text("utf-8"))
    assert 4 < len(shell_lines(texts[0])) < 10
    assert set(shell_lines(texts[0])) <= set(manual)


@pytest.mark.parametrize("name", READMES)
def test_a_readme_is_read_at_once_and_leads_to_what_is_there(name: str) -> None:
    text = (ROOT / name).read_text("utf-8")
    assert len(text.splitlines()) <= 80
    links = re.findall(r"\]\(([^)]+)\)", text)
    assert len(links) > 20
    assert [link for link in links if not (ROOT / link).is_file()] == []
    language = "zh" if "zh" in name else "en"
    assert {link.split("/")[1] for link in links if link.startswith("docs/")} == {language}


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_moving_picture_is_small_and_what_the_readme_says_draws_it(language: str) -> None:
    (readme,) = (name for name in READMES if ("zh" in name) == (language == "zh"))
    said = re.search(r"`benchdragon (view [^`]+)`", (ROOT / readme).read_text("utf-8"))
    assert said is not None
    words = said[1].split()
    asked = dict(pairwise(words))
    path = ROOT / "docs" / language / "dance.gif"
    assert path.stat().st_size < 400_000
    with Image.open(path) as picture:
        frames = (float(asked["--end"]) - float(asked["--start"])) / float(asked["--speed-up"])
        assert picture.n_frames == frames * float(asked["--fps"]) + 1  # type: ignore[attr-defined]
        assert "x".join(map(str, picture.size)) == asked["--size"]
    assert " ".join(words) in (ROOT / "Makefile").read_text("utf-8")


def test_the_package_says_its_version_and_names() -> None:
    import benchdragon

    for name in benchdragon.__all__:
        assert getattr(benchdragon, name).__name__ == name
    with pytest.raises(AttributeError, match="nothing"):
        getattr(benchdragon, "nothing")  # noqa: B009
    done = subprocess.run(
        [sys.executable, "-m", "benchdragon", "--version"], capture_output=True, text=True, check=True
    )
    assert benchdragon.__version__ in done.stdout


@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_command_of_the_walk_through_works(
    language: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    commands = shell_lines((ROOT / "docs" / language / "terminal.md").read_text("utf-8"))
    assert len(commands) >= 4
    for command in commands:
        less = ["--benches", "12"] if command.startswith("benchdragon new") else []
        assert run([*command.split()[1:], *less, "--quiet"]) == 0, command
    assert (tmp_path / "sheets" / "benches.pdf").exists()
