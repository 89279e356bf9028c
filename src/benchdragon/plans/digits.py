"""Whether plans hold their numbers as written: a double is named by its shortest decimal.

A number with at most 15 digits is the shortest decimal of its double, and comes back as it was written.
One with more may not: it is kept beside its double, for proofs.
"""

import math
import re
from collections.abc import Iterator
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from typing import Any

from benchdragon.plans.signs import narrow

# Decimals with this many signs, point and sign included, have a double of their own.
SHORT = 15
# One with more signs is taken to name no double, and a text is refused where it is checked: a million
# digits take half a minute.
LONG = 1100
# In these tables of a plan texts are numbers with units; elsewhere they are words.
MEASURED = ("dragon", "route", "disc", "turn", "walk", "limits", "venue", "obstacle", "cues")
# What a unit is worth, where no decimal says it; 0: nor any fraction.
FRACTIONS = {1.0 / 3.6: Fraction(5, 18), 1.0 / 60.0: Fraction(1, 60), 180.0 / math.pi: Fraction(0)}
# Units that move the point: text with them is as exact as without.
POINTS = {0.01: -2, 0.001: -3, 1000.0: 3}


class Rounded(float):
    """A double that stands for a number with more digits than it has.

    Attributes:
        text: the number as it was written.
    """

    text: str


def number(text: str) -> float:
    """The double of a number as TOML writes it; a `Rounded` where it does not name it."""
    value = float(text)
    if len(text) <= SHORT or not math.isfinite(value):
        return value
    try:
        exact = len(text) <= LONG and Decimal(text) == Decimal(repr(value))
    except InvalidOperation:  # an exponent of 19 digits
        exact = False
    if exact:
        return value
    rounded = Rounded(value)
    rounded.text = text
    return rounded


def measured(number: str, worth: float) -> float:
    """The size of a number in a unit worth so much: the nearest double where that moves the point."""
    if worth not in POINTS:
        return abs(float(number)) * worth
    digits, _e, power = number.lower().partition("e")
    return abs(float(f"{digits}e{int(power or 0) + POINTS[worth]}"))


def rounded_numbers(
    data: dict[str, Any], pattern: re.Pattern[str], units: dict[str, float]
) -> list[tuple[str, str]]:
    """The numbers in a plan's tables whose double stands for another: as written, and as kept.

    Args:
        data: tables as they were read.
        pattern: of a number and its unit.
        units: what each is worth.
    """
    found: list[tuple[str, str]] = []
    for value in _leaves([data[name] for name in MEASURED if name in data]):
        if isinstance(value, Rounded):
            found.append((value.text, repr(float(value))))
        elif (
            isinstance(value, str) and len(value) <= LONG and not pattern.sub("", narrow(value)).strip()
        ):
            pieces = pattern.findall(narrow(value))
            if pieces and all(unit in units for _number, unit in pieces):
                found += _rounded_quantity(value, pieces, units)
    return list(dict.fromkeys(found))


def _rounded_quantity(
    text: str, pieces: list[tuple[str, str]], units: dict[str, float]
) -> Iterator[tuple[str, str]]:
    """The same of a number with units."""
    try:
        kept = sum(measured(size, units[unit]) for size, unit in pieces)
        if not math.isfinite(kept) or any(float(size) == 0.0 and _says(size) for size, _unit in pieces):
            return
        exact = sum(abs(Fraction(size)) * _worth(units[unit]) for size, unit in pieces)
    except ValueError:  # no number: the plan's own check says so
        return
    if exact != Fraction(repr(kept)):
        yield text, repr(kept)


def _says(size: str) -> bool:
    """Whether a number has another digit than 0."""
    return any(sign in "123456789" for sign in size.lower().partition("e")[0])


def _worth(unit: float) -> Fraction:
    return FRACTIONS.get(unit, Fraction(repr(unit)))


def _leaves(value: Any) -> Iterator[Any]:
    """All values in tables and lists."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for one in value:
            yield from _leaves(one)
    else:
        yield value
