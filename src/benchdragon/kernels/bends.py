"""Where a route bends left and right, and by how much it has turned."""

import math

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.curve import FloatArray, RouteRow, curvature, heading
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import locate

# Curvatures below this, 1/m, are straight: what rounding leaves of a line.
STRAIGHT = 1e-6


class Bend(Numbered):
    """To which side a route bends."""

    LEFT = 1
    AHEAD = 0
    RIGHT = -1


@kernel
def side_of(bend: float) -> int:
    """To which side a curvature bends, 1/m."""
    if abs(bend) <= STRAIGHT:
        return Bend.AHEAD
    return Bend.LEFT if bend > 0.0 else Bend.RIGHT


@entry
def find_bends(rows: Table, at: Vector, sides: IntVector, turned: Vector) -> int:
    """Cut a route where it changes the side to which it bends; into how many spans.

    at[n] becomes the route position at which span n begins, m, that of the first minus infinite, and
    sides[n] to which side it bends; both have two numbers a row. turned[j] becomes by how much the
    route has turned by the start of row j, rad, left positive, kinks included. The curvature of no row
    changes its sign but a clothoid's, which is linear.
    """
    count = 0
    for j in range(rows.shape[0]):
        turned[j] = 0.0
        if j > 0:
            before = heading(rows, j - 1, rows[j - 1, RouteRow.U_END])
            kink = heading(rows, j, rows[j, RouteRow.U_START]) - before
            kink -= math.tau * math.floor(kink / math.tau + 0.5)
            turned[j] = (
                turned[j - 1] + before - heading(rows, j - 1, rows[j - 1, RouteRow.U_START]) + kink
            )
        first = curvature(rows, j, rows[j, RouteRow.U_START])
        last = curvature(rows, j, rows[j, RouteRow.U_END])
        turns = first * last < 0.0 and min(abs(first), abs(last)) > STRAIGHT
        for n in range(2 if turns else 1):
            side = side_of(first if n == 0 and (turns or abs(first) > abs(last)) else last)
            if count == 0 or side != sides[count - 1]:
                way = rows[j, RouteRow.LENGTH] * first / (first - last) if n == 1 else 0.0
                at[count] = rows[j, RouteRow.S_START] + way if count else -math.inf
                sides[count] = side
                count += 1
    return count


@kernel
def turned_by(rows: FloatArray, turned: FloatArray, s: float) -> float:
    """By how much the route has turned from its start to position s, m: rad, left positive."""
    j, u, _status = locate(rows, s)
    return turned[j] + heading(rows, j, u) - heading(rows, j, rows[j, RouteRow.U_START])
