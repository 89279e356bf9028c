"""Routes from what a plan says of their parts, in balls: no double was computed between.

Twins of kernels/route_parts.py and kernels/turn_families.py in ball arithmetic.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from flint import arb, fmpq

from benchdragon.errors import InputError
from benchdragon.kernels.curve import CurveKind, FloatArray, RouteRow
from benchdragon.proofs.ball_route import BallRoute, Pair, Row, stored_row

# What a stored double stands for: itself, or the shortest decimal that names it.
Reading = Callable[[float], Fraction]
ZERO = arb(0)


def ball(number: Fraction) -> arb:
    """A fraction as a ball."""
    return arb(fmpq(number.numerator, number.denominator))


def as_stored(value: float) -> Fraction:
    """A double as it is."""
    return Fraction(value)


def as_written(value: float) -> Fraction:
    """The shortest decimal that names a double: the number that a plan file says.

    A plan file whose number has another digit behind it is refused before: see plans/digits.py.
    """
    return Fraction(repr(value))


@dataclass(frozen=True)
class Part:
    """A curve as a plan says it: the columns SIZE, FIRST and LAST of kernels/route_parts.py."""

    size: arb
    first: arb = ZERO
    last: arb = ZERO


@dataclass(frozen=True)
class Start:
    """Where a route begins: the start point, m, and the heading, rad, of its first curve.

    None is what the curve has by itself: a spiral about the origin with its axis along x, and all else
    at the origin along x.
    """

    point: Pair | None = None
    heading: arb | None = None


NOWHERE = Start()


def route_of(
    parts: Sequence[Part], rows: FloatArray, start: Start = NOWHERE, turned: arb = ZERO,
    at: Pair = (ZERO, ZERO), lead: arb | None = None,
) -> BallRoute:  # fmt: skip
    """The route of these parts, which stored rows have as well, up to their rounding.

    Args:
        parts: in walking order.
        rows: stored ones: kinds, hands, and into how many rows each part is cut.
        start: of the first part.
        turned: the whole is turned by it about the origin, rad,
        at: and then moved by this, m.
        lead: route position at which the first part ends, m, where it does not begin at 0.
    """
    numbers = rows[:, RouteRow.PART].astype(int).tolist()
    made = []
    for j, i in enumerate(numbers):
        made.append(_row(parts[i], rows, j, j - numbers.index(i), numbers.count(i)))
    first = _placed(_begun(made[0], start), turned, at)
    s = arb(0) if lead is None else lead - replace(first, s=arb(0)).position(first.end)
    made[0] = replace(first, s=s)
    return BallRoute(made)


def _row(part: Part, rows: FloatArray, j: int, n: int, count: int) -> Row:
    """Row number j, the n-th of `count` of its part."""
    row, size, first, last = stored_row(rows, j), part.size, part.first, part.last
    if row.kind == CurveKind.SPIRAL:
        return replace(row, p=size / (2 * arb.pi()), start=first, end=last)
    if row.kind == CurveKind.ARC:
        return replace(row, p=(1 if first > 0 else -1) / size, end=size * abs(first))
    if row.kind == CurveKind.CLOTHOID:
        change, length = (last - first) / size, size / count
        return replace(row, p=first + change * length * n, q=change, end=length)
    if row.kind == CurveKind.LOG_SPIRAL:
        return replace(row, p=first, q=(first - last) / last / size, end=size)
    return replace(row, end=size)


def _begun(row: Row, start: Start) -> Row:
    """The first row with its own place, and then moved to a start."""
    row = replace(row, x=arb(0), y=arb(0), angle=arb(0))
    if start.heading is not None:
        _x, _y, tx, ty = row.pose(row.start)
        row = replace(row, angle=start.heading - arb.atan2(ty, tx))
    if start.point is not None:
        x, y, *_tangent = row.pose(row.start)
        row = replace(row, x=start.point[0] - x, y=start.point[1] - y)
    return row


def _placed(row: Row, turned: arb, at: Pair) -> Row:
    """A row turned about the origin, and then moved."""
    sine, cosine = turned.sin_cos()
    x, y = cosine * row.x - sine * row.y, sine * row.x + cosine * row.y
    return replace(row, x=x + at[0], y=y + at[1], angle=row.angle + turned)


@dataclass(frozen=True)
class Bridge:
    """What a turn leads to: see kernels/turn_families.py."""

    x: arb
    y: arb
    swing: arb


def bridge_between(pitch: arb, entry: arb, exit_: arb) -> Bridge:
    """What a turn between the spirals at these radii, m, leads to."""
    k = pitch / (2 * arb.pi())
    a, b = entry / k, exit_ / k
    (sine_a, cosine_a), (sine_b, cosine_b) = a.sin_cos(), b.sin_cos()
    dx, dy = -exit_ * cosine_b - entry * cosine_a, -exit_ * sine_b - entry * sine_a
    s, c = (a + a.atan() + arb.pi()).sin_cos()
    return Bridge(c * dx + s * dy, c * dy - s * dx, b + b.atan() - a - a.atan())


def two_arcs(bridge: Bridge, ratio: arb, guide: Sequence[float]) -> list[Part]:
    """The two arcs of a turn with radii of this ratio; `guide`: their lengths, m, to rounding."""
    s, c = bridge.swing.sin_cos()
    square = bridge.x * bridge.x + bridge.y * bridge.y
    a = -4 * ratio * (bridge.swing / 2).sin() ** 2
    half = bridge.y * (ratio + c) - bridge.x * s
    radius = square / ((half * half - a * square).sqrt() - half)
    one, two = -1 / (ratio * radius), 1 / radius
    way = arb.atan2(bridge.y + c / two - 1 / one, bridge.x - s / two) - arb.pi() / 2
    return [_arc(way, one, guide[0]), _arc(bridge.swing - way, two, guide[1])]


def line_between(bridge: Bridge, radii: Pair, guide: Sequence[float]) -> list[Part]:
    """An arc to the right, a line, and an arc to the left, of these radii, m."""
    first, last = radii
    s, c = bridge.swing.sin_cos()
    x, y = bridge.x - last * s, bridge.y + last * c + first
    reach = last + first
    straight = (x * x + y * y - reach * reach).sqrt()
    way = arb.atan2(y, x) - arb.atan2(reach, straight)
    line = Part(straight)
    return [_arc(way, -1 / first, guide[0]), line, _arc(bridge.swing - way, 1 / last, guide[2])]


def _arc(turn: arb, bend: arb, length: float) -> Part:
    """An arc of this curvature, 1/m, that turns by `turn`, rad, up to full turns."""
    full = 2 * arb.pi()
    rounds = round(float((length * bend - turn) / full))
    sweep = turn + rounds * full
    if abs(float(sweep / bend) - length) > 1e-6 or not math.isfinite(float(sweep)):
        raise InputError(f"an arc of {length!r} m was not found again")
    return Part(abs(1 / bend), sweep)
