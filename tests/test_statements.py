"""What README and manual say of the paper and of the program, in both languages, held to what is so."""

import re
from itertools import pairwise
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
READMES = {"en": "README.md", "zh": "README.zh-CN.md"}


def page(name: str, language: str) -> str:
    """A page in a language, formulas as plain text; "README" or a name in the manual."""
    path = READMES[language] if name == "README" else f"docs/{language}/{name}.md"
    return re.sub(r"\$\s*|\\(?=theta)|(?<=[a-z])_(?=[0-9])", "", (ROOT / path).read_text("utf-8"))


def paragraph(text: str, beginning: str) -> str:
    """The paragraph, or point of a list, that begins so."""
    found = re.search(rf"^(?:\* )?{re.escape(beginning)}.*?(?=\n\n|\n\* |\Z)", text, re.DOTALL | re.M)
    assert found is not None, beginning
    return found[0]


ERRATA = {
    ("README", "en"): "Errata to the paper",
    ("README", "zh"): "论文中的笔误",
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


@pytest.mark.parametrize("language", READMES)
@pytest.mark.parametrize("name", ["README", "errors"])
def test_the_papers_pitch_tells_no_step(name: str, language: str) -> None:
    lines = page(name, language).splitlines()
    said = " ".join(a + b for a, b in pairwise(lines) if "0.452" in a + b)
    assert "0.002 m" in said
    assert "0.004 m" in said
