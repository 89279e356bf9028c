"""Numbers as readers see them."""

import decimal
import math

# More than any float has before its point and we show behind it.
DIGITS = 340
# Significant figures of sizes.
FIGURES = 5
# Decimals of what a check found: of times, s; of all else in SI units; of small numbers, which have two
# figures; and beside a limit.
TIME_DECIMALS, DECIMALS, SMALL_DECIMALS, MOST_DECIMALS = 2, 3, 6, 15
# By what rounding may differ between two machines, in the last decimal shown and beside a limit.
DUST, BESIDE = 1e-6, 1e-9


def decimals(value: float, count: int = 6) -> str:
    """So many decimals, without the sign of a zero."""
    return f"{value:z.{count}f}"


def decimals_towards(value: float, count: int = 4, *, up: bool) -> str:
    """So many decimals, rounded up or down: the side on which a statement stays true; "-" for none."""
    if not math.isfinite(value):
        return "-"
    rounding = decimal.ROUND_CEILING if up else decimal.ROUND_FLOOR
    context = decimal.Context(prec=DIGITS, rounding=rounding)
    exact = decimal.Decimal(repr(float(value)))
    return f"{exact.quantize(decimal.Decimal(1).scaleb(-count), context=context):zf}"


def outward(low: float, high: float, count: int = 4) -> str:
    """A range, its ends rounded outwards."""
    lowest, highest = decimals_towards(low, count, up=False), decimals_towards(high, count, up=True)
    return f"{lowest}..{highest}"


def figures(value: float, *, up: bool) -> str:
    """FIGURES significant figures, rounded up or down: to the side on which a statement stays true."""
    rounding = decimal.ROUND_CEILING if up else decimal.ROUND_FLOOR
    return f"{decimal.Context(prec=FIGURES, rounding=rounding).create_decimal(repr(value)):f}"


def known(low: float, high: float, unit: str, *, up: bool, limit: float | None = None) -> str:
    """What is surely true of a number in a bracket, in the digits that are known, for all texts.

    That is "at least" the lower end, or with `up` "at most" the upper one. It has DECIMALS: fewer where
    the bracket is wider than the last of them; more where it would have less than two figures, or would
    lie beyond the `limit` and the number does not, or the other way.
    """
    value = high if up else low
    if not math.isfinite(value):
        return "-"
    if low == high == 0.0:
        return "0"
    count = TIME_DECIMALS if unit == "s" else DECIMALS
    while count and high - low > 10.0**-count:
        count -= 1
    least = 10.0 ** (1 - count)
    while unit != "s" and 0.0 < value < least and high - low <= 0.1 * least and count < SMALL_DECIMALS:
        count, least = count + 1, 0.1 * least
    text = _cut(value, count, up)
    if limit is None or abs(value - limit) <= BESIDE:
        return text
    while count < MOST_DECIMALS and (float(text) - limit) * (value - limit) < 0.0:
        count += 1
        text = _cut(value, count, up)
    return text


def _cut(value: float, count: int, up: bool) -> str:
    """So many decimals, rounded up or down, apart from DUST."""
    scale = 10.0**count
    whole = math.ceil(value * scale - DUST) if up else math.floor(value * scale + DUST)
    return decimals(whole / scale, count)


def seconds(time: float) -> str:
    """A time in the walk, s, formatted as in all texts."""
    return known(time, time, "s", up=False)


def at_most(value: float) -> str:
    """Two digits and a power of ten, rounded up."""
    text = f"{value:.1e}"
    if float(text) >= value:
        return text
    digit, power = text.split("e")
    return f"{float(f'{float(digit) + 0.1:.1f}e{power}'):.1e}"


def finite_or_none(value: float) -> float | None:
    """A number for JSON, which knows no infinity."""
    return value if math.isfinite(value) else None


def decimals_or_dash(value: float, count: int = 4) -> str:
    """A number, or a dash where there is none."""
    return decimals(value, count) if math.isfinite(value) else "-"


def rounded_up(metres: float) -> str:
    """Metres in whole centimetres, not less, and one more for what places are rounded by."""
    return f"{math.ceil(100.0 * metres + 0.2) / 100.0:.2f}"
