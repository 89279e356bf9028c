"""A pocket calculator that reads explanations, for tests of them."""

import itertools
import math
import re

import pytest

# What a calculator can work out, at the end of a text, and a number at the beginning of one.
WRITTEN = re.compile(r"(?:^|(?<=[\s:：;；,，。]))((?:asinh|atan|sin|cos|[-0-9.+*/()√²·^|π\s])+)$")
RESULT = re.compile(r"(-?[0-9.]*[0-9])")
FUNCTIONS = {name: getattr(math, name) for name in ("asinh", "atan", "sin", "cos", "sqrt", "pi")}


def calculated(written: str) -> float | None:
    """What a written sum comes to; None for what is none."""
    text = re.sub(r"\|([^|]*)\|", r"abs(\1)", written.strip())
    for sign, meaning in (("√(", "sqrt("), ("²", "**2"), ("·", "*"), ("^", "**"), ("π", "pi")):
        text = text.replace(sign, meaning)
    if not re.search(r"[0-9)][\s*/+-]+[0-9(a-z]|[a-z]\(|\*\*", text):
        return None
    try:
        return float(eval(text, {"__builtins__": {}, "abs": abs}, FUNCTIONS))
    except SyntaxError:  # the end of a formula in letters
        return None


def sums(lines: list[str]) -> list[tuple[str, float, float]]:
    """All sums in some lines: as written, what they come to, and what the line says they do."""
    found = []
    for line in lines:
        sides = re.split(r" [=≈] ", line)
        for left, right in itertools.pairwise(sides):
            written, result = WRITTEN.search(left), RESULT.match(right)
            value = calculated(written.group(1)) if written and result else None
            if value is not None and result is not None:
                found.append((left, value, float(result.group(1))))
    return found


def agree(lines: list[str], least: int) -> None:
    """Hold all sums in some lines to a calculator; there must be at least so many."""
    found = sums(lines)
    assert len(found) >= least, lines
    for written, value, result in found:
        assert result == pytest.approx(value, rel=2e-6, abs=3e-6), written


def chinese_or_not(lines: list[str], language: str) -> None:
    """Words come in the language in use, and no line is left in the other."""
    assert lines
    for line in lines:
        has = bool(re.search(r"[\u4e00-\u9fff]", line))
        words = re.search(r"[A-Za-z]{4,} [a-z]{2,}", re.sub("benchdragon check spiral-in", "", line))
        assert not has if language == "en" else has or not words, line
