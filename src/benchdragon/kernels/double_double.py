"""Error of a computed head's place along the route, in double-double arithmetic (T. J. Dekker 1971).

The kernels find the head's parameter from its route position s by double arithmetic. Its exact position
differs from s by some units in the last place of s and of the lengths that it is found from.
Double-doubles give the difference: searches shift their brackets by it instead of taking it for an
error.

Factors are split so short that their products are exact; whether a compiler contracts these into fused
operations makes no difference.
"""

import math

from benchdragon.kernels.arrays import Table
from benchdragon.kernels.curve import CurveKind, FloatArray, RouteRow, walks_up
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.links import difference
from benchdragon.kernels.rounding import HALF_UNIT
from benchdragon.kernels.route import locate

SPLITTER = 134217729.0  # 2^27 + 1
# The remaining error: in half-units of the term with the logarithm, and as a share of the lengths.
LOG_UNITS, LEFT = 4.0, 2.0**-70

# A double-double: the sum of two doubles, the second below rounding of the first.
Double = tuple[float, float]


@kernel
def veltkamp_split(x: float) -> Double:
    """x as a sum of two numbers of half as many digits."""
    grown = SPLITTER * x
    high = grown - (grown - x)
    return high, x - high


@kernel
def dd_add(a: Double, b: Double) -> Double:
    """The sum of two double-doubles."""
    whole, lost = difference(a[0], -b[0])
    return difference(whole, -(lost + (a[1] + b[1])))


@kernel
def dd_multiply(a: Double, b: float) -> Double:
    """The product of a double-double and a double."""
    high, low = veltkamp_split(a[0])
    left, right = veltkamp_split(b)
    whole, lost = difference(high * left, -(high * right + low * left))
    return difference(whole, -(lost + (low * right + a[1] * b)))


@kernel
def dd_sqrt(a: Double) -> Double:
    """The square root of a double-double: one step of Newton's method from that of its first number."""
    root = math.sqrt(a[0])
    square = dd_multiply((root, 0.0), root)
    rest = dd_add(a, (-square[0], -square[1]))
    return difference(root, -0.5 * (rest[0] + rest[1]) / root)


@kernel
def spiral_way(k: float, theta: float) -> Double:
    """Arc length of r = k theta from the centre, m: k / 2 (theta sqrt(1 + theta^2) + asinh theta)."""
    square = dd_multiply((theta, 0.0), theta)
    root = dd_sqrt(dd_add(square, (1.0, 0.0)))
    way = dd_add(dd_multiply(root, theta), (math.asinh(theta), 0.0))
    return dd_multiply(way, 0.5 * k)


@kernel
def way_to(rows: FloatArray, j: int, u: float) -> Double:
    """Arc length from the start of row j to parameter u, m; negative on an extension."""
    if rows[j, RouteRow.KIND] != CurveKind.SPIRAL:
        return u, 0.0
    start = spiral_way(rows[j, RouteRow.P], rows[j, RouteRow.U_START])
    end = spiral_way(rows[j, RouteRow.P], u)
    ahead = dd_add(end, (-start[0], -start[1]))
    sign = walks_up(rows, j)
    return sign * ahead[0], sign * ahead[1]


@kernel
def way_doubt(rows: FloatArray, j: int, u: float) -> float:
    """The error bound of `way_to`, m."""
    if rows[j, RouteRow.KIND] != CurveKind.SPIRAL:
        return 0.0
    theta = max(u, rows[j, RouteRow.U_START], rows[j, RouteRow.U_END])
    k = rows[j, RouteRow.P]
    return LOG_UNITS * HALF_UNIT * k * math.asinh(theta) + LEFT * k * (1.0 + theta) * (1.0 + theta)


@entry
def head_drift(rows: Table, s: float) -> tuple[float, float]:
    """How far ahead of route position s its computed place lies, m; and the error bound of that, m.

    The exact route position is counted from the start of the first row along all rows.
    """
    last, u, _status = locate(rows, s)
    at, doubt = (-s, 0.0), way_doubt(rows, last, u)
    at = dd_add((rows[0, RouteRow.S_START], 0.0), at)
    for j in range(last):
        at = dd_add(at, way_to(rows, j, rows[j, RouteRow.U_END]))
        doubt += way_doubt(rows, j, rows[j, RouteRow.U_END])
    at = dd_add(at, way_to(rows, last, u))
    return at[0] + at[1], doubt + LEFT * abs(s)
