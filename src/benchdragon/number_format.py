"""Numbers as readers see them."""

import decimal
import math


def decimals(value: float, count: int = 6) -> str:
    """So many decimals, without the sign of a zero."""
    return f"{value:z.{count}f}"


def figures(value: float, *, up: bool) -> str:
    """Five significant figures, rounded up or down: to the side on which what is said stays true."""
    rounding = decimal.ROUND_CEILING if up else decimal.ROUND_FLOOR
    return f"{decimal.Context(prec=5, rounding=rounding).create_decimal(repr(value)):f}"


def finite_or_none(value: float) -> float | None:
    """A number for JSON, which knows no infinity."""
    return value if math.isfinite(value) else None


def decimals_or_dash(value: float, count: int = 4) -> str:
    """A number, or a dash where there is none."""
    return decimals(value, count) if math.isfinite(value) else "-"
