"""Point, tangent and curvature of one piece of a route: one `if kind` for all kinds.

A route is a table of floats, one row a piece, its columns named below. Each kind has a natural
parameter u: the polar angle theta for spirals, arc length for the others. It keeps full precision
where arc length would have to be inverted.
"""

import math

import numpy as np
import numpy.typing as npt

from benchdragon.kernels.angles import sincos, sincos_of
from benchdragon.kernels.arrays import Table
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.numbered import Numbered

FloatArray = npt.NDArray[np.float64]


class CurveKind(Numbered):
    """Kinds of curves."""

    LINE = 0.0
    ARC = 1.0
    CLOTHOID = 2.0
    SPIRAL = 3.0
    LOG_SPIRAL = 4.0


class RouteRow(Numbered):
    """Columns of a route, one row a piece."""

    KIND = 0  # one of the five above
    PART = 1  # number of the curve, from 0, that the row belongs to (a clothoid may fill several rows)
    S_START = 2  # route position of the row's start, m
    LENGTH = 3  # m
    U_START = 4  # parameter at the start
    U_END = 5  # parameter at the end
    U_BACK = 6  # parameter up to which a follower may stand: U_START, or infinite on an extension
    X = 7  # start point; of a spiral the centre, m
    Y = 8
    ANGLE = 9  # heading at the start; of a spiral the polar axis, rad
    P = 10  # curvature at the start, 1/m; spiral: pitch / 2 pi, m
    # Clothoid: change of curvature per metre, 1/m^2; spiral: +1, or -1 if mirrored; logarithmic spiral:
    # change of the radius of curvature per metre, as a share of what it is at the start, 1/m.
    Q = 11
    AXIS_X = 12  # cosine and sine of ANGLE
    AXIS_Y = 13


COLUMNS = len(RouteRow)

# A clothoid row turns by at most this, rad. With the 12 nodes below the quadrature is then exact
# to rounding (design/clothoid_quadrature.py); doubling it costs 1e-13 m.
CLOTHOID_TURN = 2.0
# Sizes and coordinates, m: beyond it doubles no longer hold a micrometre.
MOST_METRES = 1e8
# A clothoid or a logarithmic spiral may turn by this, rad, in all; more would fill the memory with rows
# of the one, and with the other take too long to search.
MOST_TURN = 1e4
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)
NODES = 0.5 * (1.0 + _NODES)
WEIGHTS = 0.5 * _WEIGHTS

# Below this half angle, rad, sin(x)/x comes from its series; the next term is 1e-18.
SERIES_ANGLE = 1e-3
# Newton from above on a convex function: 6 steps reach rounding from any theta, 40 is never met.
MAX_NEWTON = 40


@kernel
def sinc(x: float, sine: float) -> float:
    """sin(x) / x, smooth through 0; `sine` is that of x."""
    if abs(x) < SERIES_ANGLE:
        z = x * x
        return 1.0 - z / 6.0 * (1.0 - z / 20.0 * (1.0 - z / 42.0))
    return sine / x


@entry
def walks_up(rows: Table, j: int) -> float:
    """+1 where u grows in the walking direction, -1 on an inward spiral."""
    return 1.0 if rows[j, RouteRow.U_END] >= rows[j, RouteRow.U_START] else -1.0


@kernel
def clothoid_chord(u: float, curvature: float, change: float) -> tuple[float, float]:
    """The vector from the start, where the heading is 0, to the point after arc length u, m.

    Quadrature of the unit tangent.
    """
    x = 0.0
    y = 0.0
    for node, weight in zip(NODES, WEIGHTS):  # noqa: B905 - numba has no zip(strict=)
        s = u * node
        sine, cosine = sincos(s * (curvature + 0.5 * change * s))
        x += weight * cosine
        y += weight * sine
    return u * x, u * y


@kernel
def log_spiral_turn(rows: FloatArray, j: int, u: float) -> tuple[float, float]:
    """The angle turned through by arc length u, rad, and its ratio to what curvature P alone turns.

    It is the integral of the curvature P / (1 + Q u): P / Q log(1 + Q u).
    """
    gained = rows[j, RouteRow.Q] * u
    share = 1.0 if gained == 0.0 else math.log1p(gained) / gained
    return rows[j, RouteRow.P] * u * share, share


@kernel
def log_spiral_chord(rows: FloatArray, j: int, u: float) -> tuple[float, float]:
    """The vector as of `clothoid_chord`: the integral of the unit tangent, in closed form.

    As a complex number, with the start at 0 and walked towards 1, it is
    ((1 + Q u) e^(i turn) - 1) / (Q + i P). What would cancel is written as e^(i turn) - 1 =
    i turn sinc(turn / 2) e^(i turn / 2).
    """
    turn, share = log_spiral_turn(rows, j, u)
    size = math.hypot(rows[j, RouteRow.P], rows[j, RouteRow.Q])
    bend, gain = rows[j, RouteRow.P] / size, rows[j, RouteRow.Q] / size
    s, c = sincos_of(0.5 * turn)
    chord = bend * share * sinc(0.5 * turn, s)
    a = gain * (1.0 - 2.0 * s * s) - chord * s
    b = gain * (2.0 * s * c) + chord * c
    return u * (gain * a + bend * b), u * (gain * b - bend * a)


@kernel
def turned(rows: FloatArray, j: int, x: float, y: float) -> tuple[float, float]:
    """The vector that is (x, y) were the ANGLE of row j 0."""
    c, s = rows[j, RouteRow.AXIS_X], rows[j, RouteRow.AXIS_Y]
    return c * x - s * y, s * x + c * y


@kernel
def bent_chord(rows: FloatArray, j: int, u: float) -> tuple[float, float, float, float]:
    """The vector from the start of a row to parameter u, m, and the unit tangent, were ANGLE 0.

    For all kinds but spirals.
    """
    kind = rows[j, RouteRow.KIND]
    if kind == CurveKind.LINE:
        return u, 0.0, 1.0, 0.0
    if kind == CurveKind.ARC:
        half = 0.5 * rows[j, RouteRow.P] * u
        s, c = sincos_of(half)
        chord = u * sinc(half, s)
        return chord * c, chord * s, 1.0 - 2.0 * s * s, 2.0 * s * c
    if kind == CurveKind.LOG_SPIRAL:
        x, y = log_spiral_chord(rows, j, u)
        turn, _share = log_spiral_turn(rows, j, u)
    else:
        x, y = clothoid_chord(u, rows[j, RouteRow.P], rows[j, RouteRow.Q])
        turn = u * (rows[j, RouteRow.P] + 0.5 * rows[j, RouteRow.Q] * u)
    ty, tx = sincos_of(turn)
    return x, y, tx, ty


@kernel
def unit(x: float, y: float) -> tuple[float, float]:
    """A vector whose length is 1 up to rounding, normalized by one step of Newton's method."""
    share = 1.5 - 0.5 * (x * x + y * y)
    return x * share, y * share


@kernel
def place(rows: FloatArray, j: int, u: float) -> tuple[float, float, float, float]:
    """Point (m) and unit tangent in the walking direction, (x, y, tx, ty), at parameter u of row j."""
    if rows[j, RouteRow.KIND] == CurveKind.SPIRAL:
        s, c = sincos_of(rows[j, RouteRow.Q] * u)
        c, s = turned(rows, j, c, s)
        scale = walks_up(rows, j) / math.sqrt(1.0 + u * u)
        r = rows[j, RouteRow.P] * u
        turn = rows[j, RouteRow.Q] * u
        tx, ty = unit(scale * (c - turn * s), scale * (s + turn * c))
        return rows[j, RouteRow.X] + r * c, rows[j, RouteRow.Y] + r * s, tx, ty
    x, y, tx, ty = bent_chord(rows, j, u)
    x, y = turned(rows, j, x, y)
    tx, ty = unit(*turned(rows, j, tx, ty))
    return rows[j, RouteRow.X] + x, rows[j, RouteRow.Y] + y, tx, ty


@kernel
def heading(rows: FloatArray, j: int, u: float) -> float:
    """Heading, rad, continuous along the piece (not folded into one turn)."""
    if rows[j, RouteRow.KIND] == CurveKind.SPIRAL:
        back = 0.0 if walks_up(rows, j) > 0.0 else math.pi
        return rows[j, RouteRow.ANGLE] + rows[j, RouteRow.Q] * (u + math.atan(u)) + back
    if rows[j, RouteRow.KIND] == CurveKind.LOG_SPIRAL:
        return rows[j, RouteRow.ANGLE] + log_spiral_turn(rows, j, u)[0]
    return rows[j, RouteRow.ANGLE] + u * (rows[j, RouteRow.P] + 0.5 * rows[j, RouteRow.Q] * u)


@kernel
def curvature(rows: Table, j: int, u: float) -> float:
    """Curvature, 1/m, left positive."""
    if rows[j, RouteRow.KIND] == CurveKind.SPIRAL:
        z = 1.0 + u * u
        return (
            walks_up(rows, j)
            * rows[j, RouteRow.Q]
            * (1.0 + z)
            / (rows[j, RouteRow.P] * z * math.sqrt(z))
        )
    if rows[j, RouteRow.KIND] == CurveKind.LOG_SPIRAL:
        return rows[j, RouteRow.P] / (1.0 + rows[j, RouteRow.Q] * u)
    return rows[j, RouteRow.P] + rows[j, RouteRow.Q] * u


@kernel
def bend_slope(rows: FloatArray, j: int, u: float) -> float:
    """How fast the curvature changes along row j at parameter u, in size, 1/m^2."""
    if rows[j, RouteRow.KIND] == CurveKind.SPIRAL:
        z = 1.0 + u * u
        return abs(u) * (z + 3.0) / (rows[j, RouteRow.P] * rows[j, RouteRow.P] * z * z * z)
    if rows[j, RouteRow.KIND] == CurveKind.LOG_SPIRAL:
        gained = 1.0 + rows[j, RouteRow.Q] * u
        return abs(rows[j, RouteRow.P] * rows[j, RouteRow.Q]) / (gained * gained)
    return abs(rows[j, RouteRow.Q])


@kernel
def stretch(rows: Table, j: int, u: float) -> float:
    """Metres of arc per unit of parameter; on a spiral it grows with u."""
    if rows[j, RouteRow.KIND] == CurveKind.SPIRAL:
        return rows[j, RouteRow.P] * math.sqrt(1.0 + u * u)
    return 1.0


@kernel
def turning_bound(rows: FloatArray, j: int, u: float, v: float) -> float:
    """At least the angle, rad, through which the heading swings anywhere between u and v."""
    width = abs(v - u)
    if rows[j, RouteRow.KIND] == CurveKind.SPIRAL:
        nearest = min(u, v)
        return width * (1.0 + 1.0 / (1.0 + nearest * nearest))
    return width * max(abs(curvature(rows, j, u)), abs(curvature(rows, j, v)))


@entry
def spiral_length(k: float, theta: float) -> float:
    """Arc length of r = k theta from the centre, m."""
    return 0.5 * k * (theta * math.sqrt(1.0 + theta * theta) + math.asinh(theta))


@kernel
def spiral_angle(k: float, length: float) -> float:
    """The theta at which a spiral is `length` metres long: Newton on a convex function, from above."""
    theta = min(math.sqrt(2.0 * length / k), length / k)
    for _ in range(MAX_NEWTON):  # pragma: no branch - it always breaks
        step = (spiral_length(k, theta) - length) / (k * math.sqrt(1.0 + theta * theta))
        theta -= step
        if abs(step) <= 4e-16 * theta:
            break
    return theta


@kernel
def length_at(rows: FloatArray, j: int, u: float) -> float:
    """Arc length, m, from the row's start to parameter u; negative on an extension."""
    if rows[j, RouteRow.KIND] == CurveKind.SPIRAL:
        k = rows[j, RouteRow.P]
        ahead = spiral_length(k, u) - spiral_length(k, rows[j, RouteRow.U_START])
        return walks_up(rows, j) * ahead
    return u


@entry
def parameter_at(rows: Table, j: int, length: float) -> float:
    """The parameter at an arc length from the row's start; inverse of `length_at`."""
    if rows[j, RouteRow.KIND] == CurveKind.SPIRAL:
        k = rows[j, RouteRow.P]
        from_centre = spiral_length(k, rows[j, RouteRow.U_START]) + walks_up(rows, j) * length
        return spiral_angle(k, max(from_centre, 0.0))
    return length
