"""No zero that is shown has a sign: neither a number's own, nor one left over from rounding."""

import math
import re
from decimal import Decimal
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from python_calamine import CalamineWorkbook

from benchdragon.cli.main import run
from benchdragon.explain.text import number
from benchdragon.export.film_scene import clock_text
from benchdragon.number_format import decimals, decimals_or_dash, decimals_towards, known, outward
from tests.test_docs import LANGUAGES, blocks, source

SIGNED_ZERO = re.compile(r"(?<![\w.)])[-\N{MINUS SIGN}]0(?:\.0*)?(?![\d.eE])")


@given(st.one_of(st.floats(-1e-5, 1e-5), st.floats(allow_nan=False)), st.integers(0, 9))
def test_a_number_that_reads_as_zero_has_no_sign(value: float, count: int) -> None:
    for text in (
        decimals(value, count),
        decimals_or_dash(value, count),
        decimals_towards(value, count, up=True),
        decimals_towards(value, count, up=False),
    ):
        assert not SIGNED_ZERO.fullmatch(text), value


@given(st.floats(-1e6, 1e6), st.integers(0, 6))
def test_a_number_rounded_to_one_side_lies_there_and_less_than_a_digit_away(
    value: float, count: int
) -> None:
    low, high = (Decimal(decimals_towards(value, count, up=up)) for up in (False, True))
    exact = Decimal(repr(value))
    assert low <= exact <= high
    assert high - low <= Decimal(1).scaleb(-count)


def test_a_range_is_rounded_outwards_and_what_is_exact_stays() -> None:
    assert outward(0.50598, 0.5101542) == "0.5059..0.5102"
    assert outward(0.51, 0.51, 2) == "0.51..0.51"
    assert outward(-math.inf, math.inf) == "-..-"


def test_explanations_and_films_show_no_signed_zero() -> None:
    for value in (-0.0, -1e-30, -1e-12):
        assert number(value) == "0"
        assert clock_text(value) == "t = 0.0 s"


@pytest.mark.parametrize(
    "command",
    [
        "motion spiral-in --at=-0",  # the head is at (8.8, -3e-14)
        "motion spiral-in --at=-0 --json --only 1",
        "motion spiral-in --at 0 --explain",
        "check spiral-in --set walk.start=-0.0 --set walk.end=5 --set limits.speed=0.5",
        "solve speed spiral-in --set walk.end=10 --set limits.speed=1",
    ],
)
def test_the_terminal_shows_no_signed_zero(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    run([*command.split(), "--quiet"])
    printed = capsys.readouterr().out
    assert "0" in printed
    assert SIGNED_ZERO.findall(printed) == []


def test_files_hold_no_signed_zero(tmp_path: Path) -> None:
    command = "motion spiral-in --at=-0 --only 0,1 --format xlsx,csv --quiet -o"
    assert run([*command.split(), str(tmp_path)]) == 0
    for sheet in CalamineWorkbook.from_path(tmp_path / "motion.xlsx").sheet_names[:2]:
        rows = CalamineWorkbook.from_path(tmp_path / "motion.xlsx").get_sheet_by_name(sheet).to_python()
        assert rows[0] == ["", "0 s"]
        assert all(not SIGNED_ZERO.fullmatch(f"{row[1]:.6f}") for row in rows[1:])
    assert SIGNED_ZERO.findall((tmp_path / "motion.csv").read_text("utf-8-sig")) == []


def test_a_page_shows_no_signed_zero(tmp_path: Path) -> None:
    assert run(["view", "spiral-in", "--start=-0", "--end", "3", "-o", str(tmp_path / "a.html")]) == 0
    words = re.sub(
        r"<(script|style).*?</\1>", " ", (tmp_path / "a.html").read_text("utf-8"), flags=re.S
    )
    assert SIGNED_ZERO.findall(re.sub(r"<[^>]*>", " ", words)) == []


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", ["question-1.md", "question-2.md", "question-4.md"])
def test_tables_of_positions_in_the_manual_drop_the_sign(name: str, language: str) -> None:
    tables = [cell for cell in blocks(source(language, name), "{code-cell}") if "12.6f" in cell]
    assert tables
    assert all("z12.6f" in cell for cell in tables)


@pytest.mark.parametrize(
    ("low", "high", "unit", "up", "shown"),
    [
        (1.165743, 1.165743, "m", False, "1.165"),
        (1.165743, 1.165743, "m", True, "1.166"),
        (0.44, 0.44, "m", False, "0.440"),
        (0.44 - 1e-13, 0.44 + 1e-13, "m", False, "0.440"),
        (0.2785, 0.2794, "m", False, "0.278"),
        (0.2784, 0.2796, "m", False, "0.27"),
        (0.2784, 1.5, "m", False, "0"),
        (0.000127, 0.000127, "m", False, "0.00012"),
        (0.0, 1e-13, "m", False, "0.000"),
        (0.0, 0.0, "m", False, "0"),
        (412.4738376, 412.4738376, "s", False, "412.47"),
        (-0.001, -0.001, "s", False, "-0.01"),
        (2.0, 2.0 + 1e-12, "m/s", True, "2.000"),
        (1.0, math.inf, "m/s", True, "-"),
    ],
)
def test_what_is_known_is_told_to_the_safe_side_and_no_more(
    low: float, high: float, unit: str, up: bool, shown: str
) -> None:
    assert known(low, high, unit, up=up) == shown


@pytest.mark.parametrize(
    ("value", "limit", "up", "shown"),
    [
        (1.60479, 1.6048, True, "1.6048"),
        (1.6049, 1.6048, True, "1.605"),
        (0.0503, 0.0502, False, "0.0503"),
        (0.0501, 0.0502, False, "0.050"),
        (2.0 + 1e-12, 2.0, True, "2.000"),
    ],
)
def test_a_text_lies_on_the_side_of_a_limit_on_which_the_number_does(
    value: float, limit: float, up: bool, shown: str
) -> None:
    assert known(value, value, "m", up=up, limit=limit) == shown
