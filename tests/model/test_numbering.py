"""One numbering in all that people read: benches 1..N, handles 0..N; the contest's names beside."""

import re
from pathlib import Path

import pytest
from babel.messages.pofile import read_po
from python_calamine import CalamineWorkbook

from benchdragon.cli.main import run
from benchdragon.i18n import LOCALE_FOLDER
from benchdragon.model.numbering import handle_names, handle_place, numbering_text

SOURCES = Path(__file__).parents[2] / "src" / "benchdragon"
CATALOGUE = LOCALE_FOLDER / "zh_CN" / "LC_MESSAGES" / "benchdragon.po"
BENCHES = 40
SMALL = ["--set", f"dragon.benches={BENCHES}", "--quiet"]
COMMANDS = {
    "motion": ["motion", "turn", "--at", "14", "--explain"],
    "motion of some": ["motion", "turn", "--at", "14", "--only", "0,3,40"],
    "check": ["check", "turn", "--explain"],
    "speed": ["solve", "speed", "turn", "--explain"],
    "pitch": ["solve", "pitch", "spiral-in", "--set", "disc.radius=4.5", "--explain"],
    "margins": ["margins", "spiral-in", "--set", "disc.radius=4.5", "--draws", "3", "--aside", "0.02",
                "--height", "0.1", "--explain"],
    "fold": ["motion", "spiral-in", "--at", "432.77"],
}  # fmt: skip
# Numbers of benches, and of handles, as sentences and tables of each language give them.
BENCH = {
    "en": re.compile(r"\b[Bb]ench(?:es)? (\d+)(?: and (\d+))?"),
    "zh": re.compile(r"第 (\d+) 节(?:与第 (\d+) 节)?"),
}
HANDLE = {"en": re.compile(r"\b[Hh]andle (\d+)"), "zh": re.compile(r"(\d+) 号把手")}


def numbers_of(pattern: re.Pattern[str], text: str) -> set[int]:
    return {int(number) for found in pattern.findall(text) for number in flat(found) if number}


def flat(found: str | tuple[str, ...]) -> tuple[str, ...]:
    return (found,) if isinstance(found, str) else found


def test_the_contests_names_stand_beside_our_numbers(spoken: str) -> None:
    names, places = handle_names(224), [handle_place(i, 223) for i in range(224)]
    body = {"en": "Body {}", "zh": "第{}节龙身"}[spoken]
    between = {"en": "between benches {} and {}", "zh": "第 {} 节与第 {} 节板凳之间"}[spoken]
    for i in range(1, 222):
        assert names[i] == body.format(i)
        assert places[i] == between.format(i, i + 1)
    ends = {
        "en": ["front of bench 1", "rear of bench 223", "Head", "Tail", "Tail (rear)"],
        "zh": ["第 1 节板凳前端", "第 223 节板凳后端", "龙头", "龙尾", "龙尾（后）"],
    }[spoken]
    assert [places[0], places[-1], names[0], *names[-2:]] == ends
    assert handle_place(1, 1) == {"en": "rear of bench 1", "zh": "第 1 节板凳后端"}[spoken]


@pytest.mark.parametrize("name", COMMANDS)
def test_what_is_printed_counts_benches_from_1_and_handles_from_0(
    name: str, spoken: str, capsys: pytest.CaptureFixture[str]
) -> None:
    run([*COMMANDS[name], *SMALL, "--lang", spoken])
    captured = capsys.readouterr()
    said = captured.out + captured.err
    benches, handles = (numbers_of(kind[spoken], said) for kind in (BENCH, HANDLE))
    assert benches | handles
    assert benches <= set(range(1, BENCHES + 1))
    assert handles <= set(range(BENCHES + 1))
    assert not re.search(r"\bbody \d|第 \d+ 个把手|第 \d+ 节龙身", said)
    assert (numbering_text() in said) == name.startswith("motion")  # where handles are listed


def test_a_table_on_the_screen_has_the_contests_names(
    spoken: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["motion", "turn", "--at", "14", "--only", "0,3,39,40", *SMALL, "--lang", spoken]) == 0
    rows = [
        line.split("\t")[1:3]
        for line in capsys.readouterr().out.splitlines()
        if line.startswith("14\t")
    ]
    names = handle_names(BENCHES + 1)
    assert rows == [[str(i), names[i]] for i in (0, 3, 39, 40)]


def test_spreadsheets_have_a_sheet_of_numbers(tmp_path: Path, spoken: str) -> None:
    options = ["--at", "14", "--only", "0,3,40"]
    run(["motion", "turn", *options, "-o", str(tmp_path), "--format", "xlsx", *SMALL, "--lang", spoken])
    (path,) = tmp_path.iterdir()
    book = CalamineWorkbook.from_path(path)
    assert book.sheet_names[-1] == {"en": "Numbering", "zh": "编号"}[spoken]
    head, *rows = book.get_sheet_by_name(book.sheet_names[-1]).to_python()
    assert head[-1] == numbering_text()
    names = handle_names(BENCHES + 1)
    assert [row[:3] for row in rows] == [[names[i], i, handle_place(i, BENCHES)] for i in (0, 3, 40)]
    labels = [row[0] for row in book.get_sheet_by_index(0).to_python()[1:]]
    assert [str(label).removesuffix("x (m)").removesuffix("y (m)").strip() for label in labels] == [
        names[i] for i in (0, 3, 40) for _axis in ("x", "y")
    ]


def test_chinese_texts_number_benches_and_handles_alike() -> None:
    """第 {n} 节 for a bench, {n} 号把手 for a handle: never 第 {n} 个把手, which would count from 1."""
    with CATALOGUE.open("rb") as source:
        messages = [(str(m.id), str(m.string)) for m in read_po(source, locale="zh_CN") if m.id]
    for wanted, form in (
        (r"\b[Bb]ench(?:es)? (\{\w+\})", "第 {} 节"),
        (r"\b[Hh]andle (\{(?:i|handle)\})", "{} 号把手"),
    ):
        found = [(i, s, re.findall(wanted, i)) for i, s in messages if re.search(wanted, i)]
        assert len(found) > 3
        for english, chinese, names in found:
            for name in names:
                assert form.format(name) in chinese, english
    for english, chinese in messages:
        assert not re.search(r"第 ?(\{\w+\}|\d+) ?[个号块](把手|板凳)", chinese), english


def test_only_one_place_makes_the_contests_names() -> None:
    makers = [
        path.relative_to(SOURCES).as_posix()
        for path in SOURCES.rglob("*.py")
        if "Body {" in path.read_text("utf-8")
    ]
    assert makers == ["model/numbering.py"]
    pages = [path for path in (SOURCES / "web").glob("*.js") if "Body {" in path.read_text("utf-8")]
    assert pages == []
