"""Numbers of Python modules as pages have them."""

import math
from typing import Any

import pytest

from tests.scripts import script

TOOL: Any = script("tools/make_constants.py")


@pytest.mark.parametrize(
    ("value", "text"),
    [(3, "3"), (0.5, "0.5"), (1e-9, "1e-9"), (1e8, "100000000"), (math.inf, "Infinity"), (-2.0, "-2")],
)
def test_a_number_is_one_of_javascript(value: float, text: str) -> None:
    assert TOOL.number(value) == text


def test_texts_and_truths_are_left_out() -> None:
    assert TOOL.literal(True) is None
    assert TOOL.literal("text") is None
    assert TOOL.literal((0.5, 2)) == "[0.5, 2]"


def test_numbers_that_no_script_names_are_left_out() -> None:
    assert TOOL.declared("kernels.curve", {"CURVE": {"COLUMNS", "rows"}}) == [
        "export const CURVE = { COLUMNS: 14 };\n"
    ]
    assert TOOL.declared("kernels.curve", {"BOX": {"COLUMNS"}}) == []


def test_a_class_of_names_is_one_with_those_that_it_follows() -> None:
    assert TOOL.declared("kernels.bends", {"Bend": set()}) == [
        "export const Bend = { LEFT: 1, AHEAD: 0, RIGHT: -1 };\n"
    ]
    (hull,) = TOOL.declared("kernels.box_hierarchy", {"Hull": set()})
    assert hull.startswith("export const Hull = { CX: 0,")
    assert "HALF_WIDTH: 5, RADIUS: 6" in hull
