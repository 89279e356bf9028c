"""What the manual says of the paper and of the program, in both languages, held to what is so."""

import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest

import benchdragon
from benchdragon import greatest_head_speed, read_plan
from tests.test_docs import blocks, source

ROOT = Path(__file__).parent.parent
LANGUAGES = ("en", "zh")


def page(name: str, language: str) -> str:
    """A page in a language, formulas as plain text."""
    text = (ROOT / "docs" / language / f"{name}.md").read_text("utf-8")
    return re.sub(r"\$\s*|\\(?=theta)|(?<=[a-z])_(?=[0-9])", "", text)


def paragraph(text: str, beginning: str) -> str:
    """The paragraph, or point of a list, that begins so."""
    found = re.search(rf"^(?:\* )?{re.escape(beginning)}.*?(?=\n\n|\n\* |\Z)", text, re.DOTALL | re.M)
    assert found is not None, beginning
    return found[0]


ERRATA = {
    ("exact", "en"): "Errata to the paper",
    ("exact", "zh"): "论文中的笔误",
    ("ten-minutes", "en"): "**Errata.**",
    ("ten-minutes", "zh"): "**笔误**",
}


@pytest.mark.parametrize(("name", "language"), ERRATA)
def test_the_errata_say_what_holds_on_each_arc_and_leave_the_third_equation_be(
    name: str, language: str
) -> None:
    said = paragraph(page(name, language), ERRATA[name, language])
    assert "theta = theta0 - t/r1" in said
    assert "theta = theta0 + t/r2" in said
    assert "(5)" in said
    assert "(3)" not in said  # printed for the way out, and right there


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", ["exact", "errors"])
def test_the_papers_pitch_tells_no_step(name: str, language: str) -> None:
    lines = page(name, language).splitlines()
    said = " ".join(a + b for a, b in pairwise(lines) if "0.452" in a + b)
    assert "0.002 m" in said
    assert "0.004 m" in said


def texts() -> Iterator[tuple[str, str]]:
    """All that people read in English and Chinese, the program's own words and code's among it."""
    folders = [ROOT / name for name in ("src/benchdragon", "docs", "design", "benchmarks")]
    for path in [*ROOT.glob("*.md"), *(path for folder in folders for path in folder.rglob("*"))]:
        if path.suffix in {".md", ".py", ".po", ".js"} and "_build" not in path.parts:
            yield path.name, path.read_text("utf-8")


@pytest.mark.parametrize(
    "claim",
    [
        r"\btests?\b[^.\n]{0,20}\bprov(?:e|es|ed|ing)\b",  # a test can fail; it proves nothing
        r"\bprov(?:ed|en) by (?:a |the )?tests?\b",
        r"测试[^。\n]{0,6}证明|由测试证明",
        r"[0-9]+ ?位(?:精度|算术|的?球算术)",  # digits of which base?
        r"100 位(?!二进制)|40 位(?!十进制)",
    ],
)
def test_no_text_claims_what_is_not_so(claim: str) -> None:
    assert [(name, found) for name, text in texts() for found in re.findall(claim, text)] == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_number_of_evaluations_is_quoted(language: str) -> None:
    counted = r"\b(?:some|about) [0-9][0-9,]* (?:evaluations|looks)|[0-9百千]+ ?次求值"
    assert re.findall(counted, page("exact", language)) == []


def test_the_bracket_of_the_greatest_head_speed_is_as_narrow_as_is_said() -> None:
    found = greatest_head_speed(read_plan("turn"))
    assert found.upper - found.lower == pytest.approx(1e-10, rel=0.5)
    for language in LANGUAGES:
        assert "1e-10 m/s" in page("exact", language)


def test_in_which_sense_the_turn_is_as_short_as_can_be(capsys: pytest.CaptureFixture[str]) -> None:
    """The manual's own cell: the paper's arcs, deeper joints, and a line; another page quotes it."""
    (cell,) = (
        code for code in blocks(source("en", "question-4.md"), "{code-cell}") if "4.45 m" in code
    )
    exec(cell, {name: getattr(benchdragon, name) for name in benchdragon.__all__})
    rows = [line.split()[:4] for line in capsys.readouterr().out.splitlines()[1:]]
    (turn, path, apart, head), deep, deeper, line = ([float(number) for number in row] for row in rows)
    assert turn == path == 13.6212
    assert deeper[0] < deep[0] < turn
    assert deeper[1] > deep[1] > path
    assert deeper[3] < deep[3] < head
    assert line[0] < turn
    assert line[1] < path
    assert line[3] > head
    assert min(apart, deep[2], deeper[2], line[2]) > 0.2
    for language in LANGUAGES:
        quoted = page("exact", language)
        for number in (f"{turn} m", f"{deeper[0]} m", f"{deeper[1]} m", f"{deeper[2]:.3f} m"):
            assert number in quoted.replace("\n ", ""), number
        assert f"{deeper[3]:.3f} m/s" in quoted
