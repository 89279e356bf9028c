"""Swept boxes: what benches of one size cover while their front handle walks through a cell.

And whether they surely walk through it, without a leap.
"""

import math

import numpy as np

from benchdragon.kernels import box
from benchdragon.kernels import motion_bounds as bounds
from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.box import Box, corner, offset, place_box
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import FloatArray, RouteRow, place, turning_bound
from benchdragon.kernels.entries import allocates, kernel
from benchdragon.kernels.motion_bounds import (
    BenchBound,
    HandleBound,
    bound_bench,
    bound_handles,
    heading_bound,
    path_bound,
)
from benchdragon.kernels.route import IntArray, step_back
from benchdragon.kernels.status import Status

# Below this turning between two handles, rad, the chord grows all the way from one to the other.
SQUARE = 0.5 * math.pi - 2e-3
# Nearer than this share of the link is surely nearer than the link.
SHORT = 1.0 - 1e-8
# Pieces into which the way between two handles may be cut to show that the chord grows along it.
MOST_CHORD_PIECES = 200
# Route positions are sure to this, m; a handle so near a border counts for both cells.
EDGE = 1e-7
# The greatest error of a distance that is allowed, m: cells of the route leave out pairs that are
# farther apart than the reach by EDGE.
MOST_OFF = 0.25 * EDGE


@kernel
def follows(rows: FloatArray, places: Placements, a: int, b: int, link: float) -> bool:
    """Whether handle 1 surely follows handle 0 without a leap while that walks from slot a to slot b.

    So it is when, for every front place, the distance to the places behind either surely grows or
    surely stays below the link, all the way back to the rear handle's first place: then the nearest
    place one link away moves continuously.
    """
    front, u = places.row[0, b], places.u[0, b]
    rear, end = places.row[1, a], places.u[1, a]
    path = path_bound(rows, places.row[0, a], places.u[0, a], front, u)
    if heading_bound(rows, rear, end, front, u) < SQUARE:
        return True
    x, y = places.x[0, b], places.y[0, b]
    j, v, piece = front, u, 0.125 * link
    for _ in range(MOST_CHORD_PIECES):
        if j > rear and v == rows[j, RouteRow.U_START]:
            j -= 1
            v = rows[j, RouteRow.U_END]
        w = step_back(rows, j, v, piece)
        last = j == rear and (w - end) * (v - end) <= 0.0
        if last:
            w = end
        if heading_bound(rows, j, w, front, u) < SQUARE or grows(rows, j, v, w, x, y, path, link):
            if last:
                return True
            v = w
            piece = min(2.0 * piece, 0.125 * link)
        else:
            piece *= 0.5
    return False


@kernel
def grows(
    rows: FloatArray, j: int, v: float, w: float, x: float, y: float, path: float, link: float
) -> bool:
    """Whether the distance from every front place to the places from v back to w behaves.

    The front place is (x, y) or up to `path` metres behind it. Behaving is growing, or staying short.
    Seen from a place, the front lies at an angle to the route; by its cosine the distance changes with
    the way back, and it varies by what the route turns and by what the front place shifts.
    """
    px, py, tx, ty = place(rows, j, v)
    dx, dy = x - px, y - py
    chord, back = math.hypot(dx, dy), path_bound(rows, j, w, j, v)
    if chord + path + back < SHORT * link:
        return True
    if path + back >= chord:
        return False
    angle = math.acos(min(1.0, max(-1.0, (dx * tx + dy * ty) / chord)))
    varies = turning_bound(rows, j, v, w) + math.asin((path + back) / chord)
    if angle + varies < SQUARE:
        return True
    return chord + path + back * (abs(0.5 * math.pi - angle) + varies) < SHORT * link


@kernel
@allocates
def sweep_cells(
    rows: Table, links: Vector, sizes: Table, k: int, places: Placements, slots: IntVector,
    targets: IntVector, hulls: Table, sound: Vector,
) -> None:  # fmt: skip
    """Widen hulls[targets[n]], empty where NaN, to hold every bench of the sizes in column k in cell n.

    `places` are the two handles of such a bench with the front one at the cell's borders, which are
    slots[n] and the next. sound[n] is 1, or 0 where it is not sure that the bench can walk through;
    one that cannot stand at both borders is not held.
    """
    handles, bench = np.empty((2, bounds.HANDLE_COLUMNS)), np.empty(bounds.BENCH_COLUMNS)
    ends = np.empty((2, box.BOX_COLUMNS))
    for n in range(slots.shape[0]):
        a, c = slots[n], targets[n]
        sound[n] = 1.0 if walks_on(rows, places, a, links, handles) else 0.0
        if places.failed[0, a] != Status.OK or places.failed[0, a + 1] != Status.OK:
            continue
        bound_bench(handles, 0, sizes, k, bench)
        h = handles[0, HandleBound.PATH]
        bulge = min(
            0.125 * bench[BenchBound.POINT_ACCELERATION] * h * h, 0.5 * bench[BenchBound.TRAVEL]
        )
        widen(sizes, k, places, a, bulge, hulls, c, ends)


@kernel
def walks_on(
    rows: FloatArray, places: Placements, a: int, links: FloatArray, handles: FloatArray
) -> bool:
    """Whether one bench surely walks from slot a to the next; `handles` gets bounds if it stands."""
    if places.failed[0, a] != Status.OK or places.failed[0, a + 1] != Status.OK:
        return False
    bound_handles(rows, links, places, a, a + 1, handles)
    return handles[1, HandleBound.SPEED] < math.inf and follows(rows, places, a, a + 1, links[0])


@kernel
def widen(
    sizes: FloatArray, k: int, places: Placements, a: int, bulge: float, hulls: FloatArray, c: int,
    ends: FloatArray,
) -> None:  # fmt: skip
    """Make hull c hold the bench of sizes k as in slots a and a + 1, and `bulge` metres more.

    `ends` is scratch, (2, BOX_COLUMNS).
    """
    place_box(sizes, k, 0, places.x, places.y, a, ends, 0)
    place_box(sizes, k, 0, places.x, places.y, a + 1, ends, 1)
    if math.isnan(hulls[c, Box.CX]):
        ux, uy = ends[0, Box.UX] + ends[1, Box.UX], ends[0, Box.UY] + ends[1, Box.UY]
        size = math.hypot(ux, uy)
        hulls[c, Box.UX], hulls[c, Box.UY] = ux / size, uy / size
        hulls[c, Box.CX], hulls[c, Box.CY] = ends[0, Box.CX], ends[0, Box.CY]
        hulls[c, Box.HALF_LENGTH] = hulls[c, Box.HALF_WIDTH] = 0.0
    low_x, high_x = -hulls[c, Box.HALF_LENGTH], hulls[c, Box.HALF_LENGTH]
    low_y, high_y = -hulls[c, Box.HALF_WIDTH], hulls[c, Box.HALF_WIDTH]
    for end in range(2):
        for n in range(4):
            x, y = corner(ends, end, n)
            along, across = offset(hulls, c, x, y)
            low_x, high_x = min(low_x, along - bulge), max(high_x, along + bulge)
            low_y, high_y = min(low_y, across - bulge), max(high_y, across + bulge)
    ux, uy = hulls[c, Box.UX], hulls[c, Box.UY]
    ahead, aside = 0.5 * (low_x + high_x), 0.5 * (low_y + high_y)
    hulls[c, Box.CX] += ahead * ux - aside * uy
    hulls[c, Box.CY] += ahead * uy + aside * ux
    hulls[c, Box.HALF_LENGTH], hulls[c, Box.HALF_WIDTH] = 0.5 * (high_x - low_x), 0.5 * (high_y - low_y)


@kernel
def first_behind(s: FloatArray, t: int, ahead: float, start: int, end: int) -> int:
    """The first of benches start..end-1 whose front handle is not ahead of `ahead` at time t."""
    left, right = start, end
    while left < right:
        middle = (left + right) // 2
        if s[middle, t] > ahead:
            left = middle + 1
        else:
            right = middle
    return left


@kernel
def add_pair(first: IntArray, second: IntArray, since: int, found: int, i: int, j: int) -> int:
    """Record pair (i, j) unless it is there since number `since`; returns the number of pairs."""
    for p in range(since, min(found, first.shape[0])):
        if second[p] == j:
            return found
    if found < first.shape[0]:
        first[found], second[found] = i, j
    return found + 1
