"""Numbers as readers see them."""

import decimal
import math

# More than any float has before its point and we show behind it.
DIGITS = 340


def decimals(value: float, count: int = 6) -> str:
    """So many decimals, without the sign of a zero."""
    return f"{value:z.{count}f}"


def decimals_towards(value: float, count: int = 4, *, up: bool) -> str:
    """So many decimals, rounded up or down: the side on which what is said stays true; "-" for none."""
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
    """Five significant figures, rounded up or down: to the side on which what is said stays true."""
    rounding = decimal.ROUND_CEILING if up else decimal.ROUND_FLOOR
    return f"{decimal.Context(prec=5, rounding=rounding).create_decimal(repr(value)):f}"


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
