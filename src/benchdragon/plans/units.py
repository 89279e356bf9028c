"""Numbers with units, as plans and command lines say them."""

import math
import re

from benchdragon.i18n import _
from benchdragon.plans.digits import measured
from benchdragon.plans.signs import narrow

# What may stand behind a number, and what it is worth in the first unit.
METRES = {
    "m": 1.0, "cm": 0.01, "mm": 0.001, "km": 1000.0, "米": 1.0, "公尺": 1.0, "厘米": 0.01, "公分": 0.01,
    "毫米": 0.001,
}  # fmt: skip
SECONDS = {
    "s": 1.0,
    "min": 60.0,
    "h": 3600.0,
    "ms": 0.001,
    "秒": 1.0,
    "分": 60.0,
    "分钟": 60.0,
    "小时": 3600.0,
}
DEGREES = {"deg": 1.0, "°": 1.0, "rad": 180.0 / math.pi, "turn": 360.0, "turns": 360.0, "圈": 360.0}
SPEEDS = {
    "m/s": 1.0, "km/h": 1.0 / 3.6, "cm/s": 0.01, "m/min": 1.0 / 60.0, "米/秒": 1.0, "米每秒": 1.0,
    "米/分": 1.0 / 60.0, "米/分钟": 1.0 / 60.0, "米每分钟": 1.0 / 60.0,
}  # fmt: skip
ACCELERATIONS = {"m/s^2": 1.0, "m/s²": 1.0, "cm/s^2": 0.01, "cm/s²": 0.01, "米/秒²": 1.0}
ANGULAR_SPEEDS = {"deg/s": 1.0, "°/s": 1.0, "rad/s": 180.0 / math.pi, "度/秒": 1.0}
UNITS = METRES | SECONDS | DEGREES | SPEEDS | ACCELERATIONS | ANGULAR_SPEEDS
# The signs between the ends of a range and its step, on command lines and in Python.
RANGE = ".."
# Beyond it no double holds a whole number.
MOST_BITS = 1023
# Of a number with its unit; to look for both in a very long text would take hours.
MOST_SIGNS = 100
# A number with its unit; the 2 of "m/s^2" belongs to the unit.
QUANTITY = re.compile(r"([-+]?[0-9.]+(?:e[-+]?\d+)?)\s*([^\s\d.+^-]+(?:\^\d)?)", re.IGNORECASE)


def quantity(text: object, units: dict[str, float]) -> object:
    """A number in the first of `units` from text such as "3 min 12 s"; other things unchanged.

    Raises:
        ValueError: for text without a known unit, for true and false, which are no numbers, and for
            whole numbers that no double holds.
    """
    if isinstance(text, bool):
        raise ValueError(_("expected a number, not {text}").format(text=str(text).lower()))
    if _vast(text):
        raise ValueError(_("expected a number with fewer digits"))
    if not isinstance(text, str) or len(units) == 0:
        return text
    if len(text) > MOST_SIGNS:
        said = _("expected a number, or text with a unit, in at most {most} signs, not {count}")
        raise ValueError(said.format(most=MOST_SIGNS, count=len(text)))
    plain = narrow(text)
    pieces = [] if QUANTITY.sub("", plain).strip() else QUANTITY.findall(plain)
    # The sign of the first number is that of the whole: -1 min 30 s is 90 s before.
    signs = [number[0] for number, _unit in pieces]
    wrong = ValueError(
        _("expected a number, or text with a unit of {units}, not {text}").format(
            units=", ".join(units), text=repr(text)
        )
    )
    if not pieces or any(sign in "+-" for sign in signs[1:]) or any(u not in units for _n, u in pieces):
        raise wrong
    try:
        size = sum(measured(number, units[unit]) for number, unit in pieces)
    except ValueError:
        raise wrong from None
    return -size if signs[0] == "-" else size


def _vast(value: object) -> bool:
    """Whether it is a whole number that no double holds."""
    return isinstance(value, int) and value.bit_length() > MOST_BITS
