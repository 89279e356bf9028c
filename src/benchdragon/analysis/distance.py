"""How near benches come to one another: clearance at an instant, over all pairs that count.

Neighbours share a handle and lie at different heights, so they overlap by construction; every other
pair counts, from |i - j| = 2 on.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from benchdragon.errors import not_negative, of_kind, whole
from benchdragon.i18n import N_
from benchdragon.kernels import box as kernel
from benchdragon.kernels import local_minima
from benchdragon.kernels import nearness as near
from benchdragon.kernels.box import Box
from benchdragon.kernels.chain import Placements, empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.grid import filled_grid, pairs_near
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.spiral import LANES
from benchdragon.kernels.status import Status
from benchdragon.model.placement import Placement
from benchdragon.model.walk import Walk

CORNERS = (N_("front left"), N_("rear left"), N_("rear right"), N_("front right"))
# Features of a bench that may meet: see kernels/nearness.py.
FEATURES = (
    *(N_("front"), N_("rear"), N_("left"), N_("right")),
    *(CORNERS[0], CORNERS[3], CORNERS[1], CORNERS[2]),
)
# Pairs listed at most; each is described in a few hundred bytes.
MOST_PAIRS = 100_000
# Distances that agree to so many decimals, m, count as equal when pairs are put in order.
TIE = 12
# Benches no farther apart than this, m, touch.
TOUCHING = 1e-9


@dataclass(frozen=True)
class Nearness:
    """How near two benches are.

    Attributes:
        benches: their numbers, 1..N, the smaller first.
        distance: true distance, m; where they overlap, the gap.
        gap: signed gap by the separating axis theorem, m; never above the distance, negative inside.
        points: the point of each bench that is nearest to the other, m; of overlapping benches the
            deepest corner twice.
        features: what meets: the corner of one bench, and the side or the corner of the other, each
            with the number of its bench.

    Examples:
        >>> (near,) = bd.tightest_pairs(bd.read_plan("spiral-in").motion(300.0))
        >>> near.benches, round(near.distance, 4)
        ((1, 22), 0.1207)
    """

    benches: tuple[int, int]
    distance: float
    gap: float
    points: tuple[tuple[float, float], tuple[float, float]]
    features: tuple[tuple[int, str], tuple[int, str]]


def boxes(placed: Placement, index: int) -> FloatArray:
    """The rectangles of all benches of placement number `index`, (N, BOX_COLUMNS) of kernels/box.py.

    Raises:
        WalkError: if the dragon cannot stand there.
    """
    of_kind("placed", placed, Placement)
    if placed.status[whole("index", index, 0, len(placed.status) - 1)]:
        raise placed.failure(index)
    dragon = placed.dragon
    out = np.empty((len(dragon), kernel.BOX_COLUMNS))
    x, y = placed.x[index : index + 1].T, placed.y[index : index + 1].T
    kernel.boxes_at(dragon.sizes, np.ascontiguousarray(x), np.ascontiguousarray(y), 0, out)
    return out


def nearness(table: FloatArray, i: int, j: int) -> Nearness:
    """How near the benches in rows i and j of `boxes` are."""
    row = np.empty(near.NEARNESS)
    near.nearness(table, i, j, row)
    return nearness_of(row.tolist())


def nearness_of(row: list[float]) -> Nearness:
    """The `Nearness` of a row of kernels/nearness.py."""
    first, second, distance, gap, x, y, there_x, there_y, *meets = row
    owner, corner, other, feature = (int(one) for one in meets)
    return Nearness(
        (int(first) + 1, int(second) + 1), distance, gap, ((x, y), (there_x, there_y)),
        ((owner + 1, CORNERS[corner]), (other + 1, FEATURES[feature])),
    )  # fmt: skip


def nearness_at(walk: Walk, s: float, i: int, j: int) -> Nearness:
    """How near benches i and j (rows, from 0) of a walk are with the head at s, m."""
    return nearness(boxes(walk.placement(s, throw=False), 0), i, j)


def pairs_within(table: FloatArray, reach: float) -> tuple[IntArray, IntArray]:
    """Rows of all pairs that are not neighbours and may be within `reach` metres: a superset."""
    radius = np.hypot(table[:, Box.HALF_LENGTH], table[:, Box.HALF_WIDTH])
    widest, places = float(radius.max()), np.ascontiguousarray(table[:, [Box.CX, Box.CY]])
    grid = filled_grid(places, widest + reach)
    first, second = pairs_near(grid, places, places, 0, 2.0 * widest + reach)
    apart = np.hypot(*(places[first] - places[second]).T)
    keep = (second - first >= 2) & (apart <= radius[first] + radius[second] + reach)
    return first[keep], second[keep]


def tightest_pairs(placed: Placement, index: int = 0, count: int = 1) -> list[Nearness]:
    """The `count` pairs of benches with the smallest distance at time number `index`, tightest first.

    Neighbours do not count. Fewer come back where the dragon has fewer pairs. Equal distances come in
    the order of the benches. Cost grows nearly linearly in benches.

    Raises:
        InputError: for a count outside 1..MOST_PAIRS.
        WalkError: if the dragon cannot stand there.

    Examples:
        >>> pairs = bd.tightest_pairs(bd.read_plan("spiral-in").motion([0.0, 300.0]), 1, count=2)
        >>> [near.benches for near in pairs]
        [(1, 22), (3, 24)]
    """
    whole("count", count, 1, MOST_PAIRS)
    table = boxes(placed, index)
    wanted = min(count, (len(table) - 1) * (len(table) - 2) // 2)
    reach = 0.25
    while True:
        first, second = pairs_within(table, reach)
        gap, distance = np.empty(len(first)), np.empty(len(first))
        kernel.pair_distances(table, first, second, gap, distance)
        if (distance <= reach).sum() >= wanted:
            break
        reach *= 2.0
    order = np.lexsort((second, first, np.round(distance, TIE)))[:wanted]
    return [nearness(table, int(first[p]), int(second[p])) for p in order]


def touching(placed: Placement, index: int = 0) -> IntArray:
    """Rows of all benches that touch or overlap a non-adjacent bench at time number `index`.

    Raises:
        WalkError: if the dragon cannot stand there.
    """
    table = boxes(placed, index)
    first, second = pairs_within(table, TOUCHING)
    gap, distance = np.empty(len(first)), np.empty(len(first))
    kernel.pair_distances(table, first, second, gap, distance)
    meet = distance <= TOUCHING
    return np.union1d(first[meet], second[meet])


def pair_distances(placed: Placement, i: int, j: int) -> FloatArray:
    """Distance of benches i and j (rows, from 0) at each placement, m, (T,); minus a depth.

    Infinite where the dragon does not stand.
    """
    out = np.empty(len(placed.head_s))
    x, y = np.ascontiguousarray(placed.x.T), np.ascontiguousarray(placed.y.T)
    kernel.distances_along(placed.dragon.sizes, x, y, i, j, out)
    return out


def nearest_each(
    placed: Placement, reach: float = 1.0, straight: float = -math.inf
) -> tuple[FloatArray, IntArray]:
    """Each bench's distance to the nearest bench that is no neighbour, m, and that bench's number.

    Both are (T, N). Beyond `reach`, m, they are infinite and 0; the distance is minus the depth where
    benches overlap, and NaN at times at which the dragon does not stand. Only pairs count that are
    farther apart than `straight`, m, where the whole dragon stands in a straight line.

    Raises:
        InputError: for a negative reach.
    """
    not_negative("reach", reach, "m")
    shape = len(placed.head_s), len(placed.dragon)
    distance, partner = np.full(shape, np.nan), np.full(shape, -1, dtype=np.int64)
    x, y = np.ascontiguousarray(placed.x.T), np.ascontiguousarray(placed.y.T)
    for t in np.flatnonzero(placed.status == Status.OK).tolist():
        kernel.nearest_each(placed.dragon.sizes, x, y, t, reach, straight, distance, partner)
    return distance, partner + 1


def low_point(
    walk: Walk, i: int, j: int, low: float, high: float, shrinks: int = local_minima.SHRINKS
) -> tuple[float, float]:
    """The least distance of benches i < j (rows, from 0) with the head between low and high, m; where.

    It is sampled, not bounded; infinite where the dragon stands nowhere; minus the depth of an overlap.
    """
    rows, dragon = walk.route.rows, walk.dragon
    return local_minima.local_minimum(
        rows, dragon.links, dragon.sizes, i, j, low, high, shrinks, *_scratch(j + 2)
    )


def _scratch(handles: int) -> tuple[FloatArray, Placements, FloatArray]:
    """Scratch arrays for `low_point` of a dragon with so many handles."""
    return np.empty(LANES), empty_placements(handles, LANES), np.empty((2, kernel.BOX_COLUMNS))


def clearances(placed: Placement, indices: Sequence[int] | None = None) -> FloatArray:
    """Smallest distance over all pairs that are not neighbours at each time, m, (T,).

    Negative where benches overlap (the gap then), infinite for a dragon of one or two benches. A
    check with room for people asks for at least that room.

    Examples:
        >>> bd.clearances(bd.read_plan("spiral-in").motion([0.0, 300.0])).round(4)
        array([0.1693, 0.1207])
    """
    of_kind("placed", placed, Placement)
    chosen = range(len(placed.head_s)) if indices is None else indices
    tightest = (tightest_pairs(placed, index) for index in chosen)
    return np.array([pairs[0].distance if pairs else np.inf for pairs in tightest])
