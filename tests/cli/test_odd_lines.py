"""Odd command lines: each ends with a documented code and one sentence, none with a traceback."""

import json
import re
from collections.abc import Iterator
from pathlib import Path

import click
import pytest

from benchdragon.cli.main import run
from benchdragon.i18n import _, use_language
from tests.cli.verbs import VERBS, options

ROOT = Path(__file__).parents[2]
# The least that each verb wants; its plan is put in.
LINES = {
    "motion": ["motion", "PLAN", "--at", "3"],
    "check": ["check", "PLAN"],
    "solve": ["solve"],
    "solve pitch": ["solve", "pitch", "PLAN"],
    "solve disc": ["solve", "disc", "PLAN"],
    "solve width": ["solve", "width", "PLAN"],
    "solve length": ["solve", "length", "PLAN"],
    "solve speed": ["solve", "speed", "PLAN"],
    "solve turn": ["solve", "turn", "PLAN"],
    "solve place": ["solve", "place", "PLAN"],
    "solve square": ["solve", "square", "PLAN"],
    "margins": ["margins", "PLAN"],
    "sweep": ["sweep", "PLAN", "--vary", "route.pitch=0.5,0.6", "-o", "x"],
    "atlas": ["atlas", "x", "-o", "x.html"],
    "survey": ["survey", "PLAN"],
    "compare": ["compare", "result1.xlsx"],
    "starter": ["starter", "-o", "x.py"],
    "verify": ["verify", "certificate.json"],
    "view": ["view", "PLAN", "-o", "x.html"],
    "planner": ["planner", "PLAN", "-o", "x.html"],
    "area": ["area", "PLAN", "-o", "x.dxf"],
    "timetable": ["timetable", "PLAN"],
    "sheets": ["sheets", "PLAN", "--only", "overview", "-o", "x.html"],
    "reproduce": ["reproduce"],
    "formations": ["formations"],
    "schema": ["schema"],
    "doctor": ["doctor"],
    "help": ["help"],
    "completion": ["completion"],
    "plan": ["plan", "PLAN"],
    "new": [
        "new",
        "-o",
        "x.toml",
        "--benches",
        "4",
        "--bench-length",
        "1.5",
        "--bench-width",
        "0.2",
        "--radius",
        "9",
    ],
}
WITH_PLAN = [verb for verb, line in LINES.items() if "PLAN" in line and verb != "plan"]
FILES = {
    "empty": b"",
    "zeros": bytes(100),
    "mark-alone": b"\xef\xbb\xbf",
    "utf-16": "schema = 1".encode("utf-16"),
    "latin-1": "schema = 1 # °".encode("latin-1"),
    "torn": b"schema = 1\n[rou",
    "deep": b"schema = " + b"[" * 9000,
    "digits": b"schema = " + b"9" * 5000,
    "json": b'{"schema": 1}',
    "other-toml": b'[project]\nname = "x"',
    "next-year": b'schema = 2\n[route]\nkind = "turn"',
    "surrogate": b'schema = 1\n[route]\nkind = "\\uD800"',
}
SETTINGS = [
    "", "=", "route.pitch", "route.pitch=nan", "route.pitch=1e-300", "route.pitch=60 kg",
    "route.pitch=[",
    "route.pitch=true", "dragon.benches=0", "dragon.benches=1e9", "wak.speed=1", "龙=1", "\ud800=1",
    "..=1",
    "route=1", "schema.x=1", "route.pitch=" + "9" * 5000, "walk.profile=[[0,1],[0,1]]",
    "route.part.0=1",
]  # fmt: skip
TIMES = [
    "",
    "x",
    "1:02:03:04",
    "0:300:1",
    "9..0",
    "0..1e9",
    "1e999",
    "NaN",
    "٣",
    "1,,2",
    "3 kg",
    "\ud800",
]
# Values that no option of a type takes.
VALUES = {
    click.Choice: ["x", "", "龙"],
    click.IntRange: ["x", "", "1.5", "-1", "1e9", "9" * 5000],
    click.FloatRange: ["x", "", "-1", "1e999", "-inf"],
}
MORE = [
    [], ["dance"], ["--nosuch"], ["--lang"], ["--lang", "de"], ["motion"], ["solve"],
    *(["solve", question] for question in ("pitch", "disc", "width", "length", "speed", "turn")),
    ["solve", "--lang", "de"], ["solve", "--json", "pitch"],
    ["solve", "--", "--nosuch"], ["solve", ""], ["solve", "龙"], ["solve", "turn", "pitch", "turn"],
    ["solve", "colour", "turn"], ["view", "turn"], ["view", "turn", "-o", "x.txt"], ["check", "a", "b"],
    ["area", "turn", "-o", "x.txt"], ["area", "turn", "-o", "x.svg", "--format", "svg,xlsx"],
    ["area", "turn", "--margin", "2 kg"], ["area", "turn", "--error", "0"],
    ["area", "turn", "--error", ""],
    ["area", "turn", "-o", "x.svg", "--scale", "200"],
    ["area", "turn", "-o", "x.svg", "--scale", "1:0"],
    ["area", "turn", "-o", "x.svg", "--scale", "1:x"],
    ["view", "turn", "-o", "x.avi"], ["view", "turn", "-o", ".png"],
    ["view", "turn", "-o", "x.png", "--sheet", "0x0"],
    ["view", "turn", "-o", "x.png", "--size", "1"],
    ["view", "turn", "-o", "x.png", "--span", "9"], ["view", "turn", "-o", "x.png", "--fps", "9"],
    ["motion", "turn", "--at", "3", "--only", "-1"], ["motion", "turn", "--at", "3", "--only", "x,"],
    ["motion", "turn", "--at", "0..9", "-o", "x", "--format", "exe"],
    ["motion", "turn", "--at", "3", "-o", ""],
    ["motion", "turn", "--at", "3", "-o", "/dev/null/x"], ["check", "turn", "-o", "/dev/null"],
    ["check", "turn", "-o", "x", "--format", ""], ["solve", "pitch", "turn", "--range", "2..1..0"],
    ["solve", "pitch", "turn", "--range", "x"], ["solve", "speed", "turn", "--pace", "-o", "x"],
    ["margins", "turn", "-o", "/dev/null/x"], ["reproduce", "-o", "/dev/null/x"],
    ["doctor", "x"], ["schema", "x"], ["formations", "x"],
    ["completion"], ["completion", "csh"], ["help", "chek"],
    ["motion", "/dev/null", "--at", "3"], ["motion", "/", "--at", "3"],
    ["motion", "x" * 5000, "--at", "3"],
    ["motion", "", "--at", "3"], ["view", "turn", "-o", ""],
    ["planner", "-o", ""], ["planner", "-o", "x.txt"], ["planner", "--force"],
    ["compare"], ["compare", ""], ["compare", "/"], ["compare", "/dev/null"], ["compare", "x" * 5000],
    *(["compare", f"{name}.toml"] for name in FILES), ["compare", "a.xlsx", "b.xlsx"],
    ["compare", "pitch="], ["compare", "pitch=x"], ["compare", "=0.4"], ["compare", "龙=0.4"],
    ["compare", "head=1"],
    ["compare", "龙.xlsx"], ["compare", "\ud800"],
    ["verify"], ["verify", ""], ["verify", "/"], ["verify", "/dev/null"], ["verify", "x" * 5000],
    *(["verify", f"{name}.toml"] for name in FILES), ["verify", "a.json", "b.json"],
    ["verify", "龙.json"], ["verify", "\ud800"],
]  # fmt: skip


def with_plan(verb: str, plan: str) -> list[str]:
    return [plan if word == "PLAN" else word for word in LINES[verb]]


def wrong_options() -> Iterator[list[str]]:
    """Each option of each verb with what its type does not take, without a value, and misspelt."""
    for verb, command in VERBS.items():
        line = with_plan(verb, "turn")
        yield [*line, "--no-such-option"]
        for name, option in options(command).items():
            if not option.is_flag:
                yield [*line, name]
                yield from ([*line, name, value] for value in VALUES.get(type(option.type), []))


def odd_lines() -> list[list[str]]:
    lines = [with_plan(verb, f"{name}.toml") for verb in WITH_PLAN for name in [*FILES, "missing"]]
    lines += [[*with_plan(verb, "turn"), "--set", text] for verb in WITH_PLAN for text in SETTINGS]
    lines += [["motion", "turn", "--at", text] for text in TIMES]
    lines += [
        [*with_plan("view", "turn"), option, text] for option in ("--start", "--end") for text in TIMES
    ]
    return [*lines, *MORE, *wrong_options()]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where the command lines are run, among files that are no plans."""
    for name, content in FILES.items():
        (tmp_path / f"{name}.toml").write_bytes(content)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def documented_codes() -> set[int]:
    """The exit codes of the manual."""
    table = (ROOT / "docs" / "en" / "commands.md").read_text("utf-8").split("| exit code |")[1]
    cells = re.findall(r"^\| ([0-9, ]+) \|", table, re.MULTILINE)
    return {int(code) for cell in cells for code in cell.split(",")}


def test_the_manual_names_every_exit_code() -> None:
    assert documented_codes() == {0, 1, 2, 3, 4, 5, 6, 70, 129, 130, 141, 143}


def test_there_are_hundreds_of_odd_lines() -> None:
    lines = odd_lines()
    assert len({tuple(line) for line in lines}) == len(lines) > 400
    assert all(any(line[: len(words)] == words for line in lines) for words in map(str.split, VERBS))


@pytest.mark.parametrize("language", ["en", "zh"])
def test_an_odd_line_is_refused_in_one_sentence(
    folder: Path, capsys: pytest.CaptureFixture[str], language: str
) -> None:
    before = sorted(folder.iterdir())
    use_language(language)
    sign = {_("Error: {text}").split("{")[0].strip(), "Usage:" if language == "en" else "用法"}
    faults = []
    for line in odd_lines():
        code = run(as_json(line))
        out, err = capsys.readouterr()
        told = [text for text in err.splitlines() if text.startswith(tuple(sign))]
        if code not in {2, 3} or out or not told or "Traceback" in err or len(err) > 1500 + 5000:
            faults.append((" ".join(line)[:80], code, out[:80], err[:200]))
    use_language("en")
    assert faults == []
    assert sorted(folder.iterdir()) == before


def as_json(line: list[str]) -> list[str]:
    """A line with --json right behind its verb, if that takes it."""
    for count in (2, 1):
        verb = VERBS.get(" ".join(line[:count]))
        if verb is not None and "--json" in options(verb):
            return [*line[:count], "--json", *line[count:]]
    return line


@pytest.mark.parametrize(
    "line",
    [
        ["motion", "turn", "--at", "3"],
        ["motion", "turn", "--at", "3", "-o", "out", "--format", "csv"],
        ["motion", "spiral-in", "--at", "900", "--keep-going"],
        ["check", "spiral-in", "--set", "walk.end=9", "--set", "dragon.benches=3"],
        ["check", "spiral-in", "--set", "walk.end=9", "--set", "dragon.benches=3", "-o", "out"],
        ["view", "turn", "-o", "x.png", "--set", "dragon.benches=3"],
        ["doctor"],
    ],
)
def test_with_json_nothing_but_json_is_printed(
    folder: Path, capsys: pytest.CaptureFixture[str], line: list[str]
) -> None:
    code = run([*line, "--json"])
    assert isinstance(json.loads(capsys.readouterr().out), dict)
    assert code in documented_codes()
