"""How far benches stray, while their front handle walks a step, from a straight way between its ends.

A second bound is how far the band that they cover reaches beside a stretch of the route. Both hold for
the whole step and stretch, not only at samples.
"""

import math

import numpy as np

from benchdragon.kernels import motion_bounds as bounds
from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import FloatArray, place
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.motion_bounds import BenchBound, HandleBound, bound_bench, heading_bound
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import locate
from benchdragon.kernels.swept_boxes import walks_on

# Corners of a bench at the two ends of a step.
CORNERS = 8


class Slab(Numbered):
    """Columns of a table of slabs, one row a cell of the route."""

    X, Y = 0, 1  # where the cell begins, m
    ALONG_X, ALONG_Y = 2, 3  # direction of its chord; of the route, if it has no length
    LOW, HIGH = 4, 5  # range along the chord of all that lies square to the route in it, m
    AROUND = 6  # upper bound of how far the route, and covered points, leave chord and hulls, m
    SWING = 7  # no less than the route turns by in it in all, up to a quarter turn, rad


SLAB_COLUMNS = len(Slab)


@entry
@allocates
def strays(rows: Table, link: Vector, sizes: Table, k: int, places: Placements, out: Vector) -> None:
    """Fill out[n] for the step from slot 2n to slot 2n + 1 of `places`, of benches of sizes k.

    It bounds how far, m, any of a bench's points is on the way from where it would be, had it gone
    straight and evenly from its place at one end to that at the other; infinite where the bench is not
    certain to walk on without a leap. A point whose acceleration is at most M is within M h^2 / 8 of
    the straight way; one that travels D, within D / 2 of its ends.
    """
    handles, bench = np.empty((2, bounds.HANDLE_COLUMNS)), np.empty(bounds.BENCH_COLUMNS)
    for n in range(out.shape[0]):
        out[n] = math.inf
        a = 2 * n
        if places.u[0, a] == places.u[0, a + 1] and places.row[0, a] == places.row[0, a + 1]:
            out[n] = 0.0
        elif walks_on(rows, places, a, link, handles):
            bound_bench(handles, 0, sizes, k, bench)
            h = handles[0, HandleBound.PATH]
            out[n] = min(
                0.125 * bench[BenchBound.POINT_ACCELERATION] * h * h, 0.5 * bench[BenchBound.TRAVEL]
            )


@entry
@allocates
def band_sides(
    rows: Table, ends: Table, hulls: Table, stretches: Table, near: float, out: float, sides: Table
) -> int:
    """Fill sides[n] with bounds of how far a band reaches left and right of a route, m, in cell n.

    The band is what hulls cover of lines square to the route, up to `out` metres, where they stand.

    Args:
        rows: of the route.
        ends: route positions between which each cell lies, m, (n, 2), ascending.
        hulls: x and y of the eight corners of each, m, (count, 16).
        stretches: route positions between which each hull counts, m, (count, 2).
        near: upper bound of the distance of covered points from their hull, m. If it is 0, sides of
            cells without length are how far hulls reach there, up to rounding.
        out: greatest reach, m.
        sides: (n, 2).

    Returns:
        How many pairs of hull and cell were compared.
    """
    slabs, seen = np.empty((ends.shape[0], SLAB_COLUMNS)), np.empty((2, CORNERS))
    for n in range(ends.shape[0]):
        set_slab(rows, ends[n, 0], ends[n, 1], near, out, slabs, n)
        sides[n, 0] = sides[n, 1] = 0.0
    pairs = 0
    for k in range(hulls.shape[0]):
        n = first_cell(ends, stretches[k, 0])
        while n < ends.shape[0] and ends[n, 0] <= stretches[k, 1]:
            raise_sides(hulls, k, slabs, n, seen, sides)
            n += 1
            pairs += 1
    for n in range(ends.shape[0]):
        around, swing, pad = slabs[n, Slab.AROUND], slabs[n, Slab.SWING], -slabs[n, Slab.LOW]
        for side in range(2):
            reach = math.hypot(sides[n, side], pad) + around
            if swing < 0.5 * math.pi:
                reach = min(reach, (sides[n, side] + around) / math.cos(swing))
            sides[n, side] = min(reach, out + around)
    return pairs


@kernel
def set_slab(
    rows: FloatArray, low: float, high: float, near: float, out: float, slabs: FloatArray, n: int
) -> None:
    """Fill slabs[n] with what holds all that lies square to the route between low and high, m.

    A way of length L that turns by at most T in all, up to half a turn, is within L / 2 sin(T / 2) of
    its chord: the extreme is the corner of a way that turns at its middle alone. Length and chord would
    give a closer bound, but on a nearly straight route rounding takes their difference.
    """
    j, u, _ = locate(rows, low)
    next_j, next_u, _ = locate(rows, high)
    x, y, tx, ty = place(rows, j, u)
    next_x, next_y, _, _ = place(rows, next_j, next_u)
    chord = math.hypot(next_x - x, next_y - y)
    if chord > 0.0:
        tx, ty = (next_x - x) / chord, (next_y - y) / chord
    turn = heading_bound(rows, j, u, next_j, next_u)
    around = 0.5 * (high - low) * math.sin(0.5 * min(turn, math.pi)) + near
    swing = min(turn, 0.5 * math.pi)
    pad = around + (out + around) * math.sin(swing)
    slabs[n, Slab.X], slabs[n, Slab.Y], slabs[n, Slab.ALONG_X], slabs[n, Slab.ALONG_Y] = x, y, tx, ty
    slabs[n, Slab.LOW] = -pad
    slabs[n, Slab.HIGH] = chord + pad
    slabs[n, Slab.AROUND] = around
    slabs[n, Slab.SWING] = swing


@kernel
def first_cell(ends: FloatArray, s: float) -> int:
    """Number of the first cell that does not end before route position s, m."""
    low, high = 0, ends.shape[0]
    while low < high:
        middle = (low + high) // 2
        if ends[middle, 1] < s:
            low = middle + 1
        else:
            high = middle
    return low


@kernel
def raise_sides(
    hulls: FloatArray, k: int, slabs: FloatArray, n: int, seen: FloatArray, sides: FloatArray
) -> None:
    """Raise sides[n] to how far hull k reaches to the left and right within slab n, m."""
    tx = slabs[n, Slab.ALONG_X]
    ty = slabs[n, Slab.ALONG_Y]
    low = slabs[n, Slab.LOW]
    high = slabs[n, Slab.HIGH]
    left, right = 0.0, 0.0
    for i in range(CORNERS):
        dx, dy = hulls[k, 2 * i] - slabs[n, Slab.X], hulls[k, 2 * i + 1] - slabs[n, Slab.Y]
        seen[0, i], seen[1, i] = dx * tx + dy * ty, dy * tx - dx * ty
        left, right = max(left, seen[1, i]), max(right, -seen[1, i])
    if left <= sides[n, 0] and right <= sides[n, 1]:
        return
    for i in range(CORNERS):
        x, y = seen[0, i], seen[1, i]
        if low <= x <= high:
            raise_side(sides, n, y)
        for j in range(i):
            for border in (low, high):  # where hulls cross the slab's ends
                if (x < border) != (seen[0, j] < border):
                    raise_side(sides, n, y + (border - x) / (seen[0, j] - x) * (seen[1, j] - y))


@kernel
def raise_side(sides: FloatArray, n: int, y: float) -> None:
    """Raise a side to a point so far to the left, m."""
    sides[n, 0], sides[n, 1] = max(sides[n, 0], y), max(sides[n, 1], -y)
