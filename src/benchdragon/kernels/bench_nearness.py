"""The tightest moment of each bench over a walk, and the benches beside it."""

import math

import numpy as np

from benchdragon.kernels.arrays import IntTable, Table, Vector
from benchdragon.kernels.bench_walks import LEVEL_DISTANCES, NOBODY, BenchRow, Known, Line
from benchdragon.kernels.box import Box, boxes_at, corner, nearest_corner, nearest_each, offset, set_box
from benchdragon.kernels.box import box_distance as apart
from benchdragon.kernels.chain import march
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.local_minima import local_minimum
from benchdragon.kernels.nearness import foot
from benchdragon.kernels.numbered import Numbered

# How far away other benches are searched for, m: over the walk, and at its end for those beside.
REACH, BESIDE_REACH = 1.5, 1.5
# Benches that are farther apart than this, m, along the straightened dragon belong to another coil once
# they come within REACH: they are then nearer than half of that, which takes a bend of more than half a
# turn. Closer ones are next in line and near at all times, of no use to a bearer.
OTHER_COIL = 2.0 * REACH
# How often the range of times around a least distance is narrowed.
TIME_SHRINKS = 6


class TightMoment(Numbered):
    """Columns of tightest moments.

    The number of the other bench, 0 for none; its side, a `NearSide`; bounds of its distance, m; the
    head's position then, m; numbers of the times before and after; the place of the bench's front
    handle, m.
    """

    OTHER, WHERE, LOWER, UPPER, HEAD, EARLY, LATE, PLACE_X, PLACE_Y = range(9)


TIGHTEST_COLUMNS = len(TightMoment)


class Neighbour(Numbered):
    """Columns of the nearest bench: its distance, m, the time, s, and its number."""

    NEAR, WHEN, NUMBER = range(3)


NEAR_COLUMNS = len(Neighbour)


class NearSide(Numbered):
    """The side on which the nearest bench is."""

    ON_LEFT, ON_RIGHT, AT_FRONT, AT_REAR = range(4)


@kernel
def side_of(boxes: FloatArray, k: int, x: float, y: float) -> int:
    """The side of box k on which a point outside it lies."""
    along, across = offset(boxes, k, x, y)
    if abs(along) - boxes[k, Box.HALF_LENGTH] > abs(across) - boxes[k, Box.HALF_WIDTH]:
        return NearSide.AT_FRONT if along > 0.0 else NearSide.AT_REAR
    return NearSide.ON_LEFT if across > 0.0 else NearSide.ON_RIGHT


@kernel
def nearest_side(boxes: FloatArray) -> int:
    """The side of box 0 on which the point of box 1 lies that is nearest to it, or deepest in it."""
    mine, which = nearest_corner(boxes, 0, 1)
    x, y = corner(boxes, 0 if mine else 1, which)
    if mine and apart(boxes, 0, 1) > 0.0:
        x, y, _feature = foot(boxes, 1, x, y)
    return side_of(boxes, 0, x, y)


@entry
def find_tightest(
    line: Line, heads: Vector, first: int, stop: int, least: float, known: Known, boxes: Table,
    out: Table,
) -> None:  # fmt: skip
    """Fill the rows of `out` of benches first <= k < stop with their tightest moments.

    `heads` are all sampled head positions, m. `least` is the lower bound known for the distance of any
    two non-adjacent benches, m.
    """
    at, places, benches = known.at, known.places, known.benches
    for k in range(first, stop):
        other, n = int(benches[k, BenchRow.PARTNER]), int(benches[k, BenchRow.AT])
        out[k, TightMoment.OTHER] = other + 1
        if other == NOBODY:
            continue
        early, late = max(n - 1, 0), min(n + 1, heads.shape[0] - 1)
        i, j, head = min(k, other), max(k, other), heads[n]
        if heads[early] < heads[late]:
            lowest, where = local_minimum(
                line.rows, line.links, line.sizes, i, j, heads[early], heads[late], TIME_SHRINKS, at,
                places,
                boxes,
            )  # fmt: skip
            if lowest < benches[k, BenchRow.NEAREST] - LEVEL_DISTANCES:
                head = where
        at[0] = head
        march(line.rows, line.links[: j + 1], at, 0, 1, places)
        set_box(line.sizes, k, places.x, places.y, 0, boxes, 0)
        set_box(line.sizes, other, places.x, places.y, 0, boxes, 1)
        upper = max(apart(boxes, 0, 1), 0.0)
        out[k, TightMoment.WHERE] = nearest_side(boxes)
        out[k, TightMoment.UPPER] = upper
        out[k, TightMoment.HEAD] = head
        out[k, TightMoment.LOWER] = min(max(benches[k, BenchRow.FLOOR], least, 0.0), upper)
        out[k, TightMoment.EARLY], out[k, TightMoment.LATE] = early, late
        out[k, TightMoment.PLACE_X], out[k, TightMoment.PLACE_Y] = places.x[k, 0], places.y[k, 0]


@entry
def find_beside(sizes: Table, x: Table, y: Table, boxes: Table, beside: IntTable) -> None:
    """Fill `beside`, (benches, 2), with the number of the bench next to each on its left and right.

    The dragon stands as in the first column of x and y, (handles, times). Of each run of consecutive
    non-adjacent benches that passes at most BESIDE_REACH metres away, the one most abreast counts, and
    of these the one of the nearest run; 0 if there is none. `boxes` receives those of all benches.
    """
    boxes_at(sizes, x, y, 0, boxes)
    for k in range(boxes.shape[0]):
        for side in range(2):
            beside[k, side] = most_abreast(boxes, k, 1.0 if side == 0 else -1.0)


@kernel
def most_abreast(boxes: FloatArray, k: int, hand: float) -> int:
    """The number of the bench beside bench k on its left (hand 1) or right (-1), 0 if none is."""
    best, found = math.inf, 0
    last, offset_of_last, away, stands = -2, 0.0, 0.0, False
    for j in range(boxes.shape[0]):
        if abs(j - k) < 2:
            continue
        along, across = offset(boxes, k, boxes[j, Box.CX], boxes[j, Box.CY])
        along, across = abs(along), hand * across
        level = along <= boxes[k, Box.HALF_LENGTH] + 0.5 * boxes[j, Box.HALF_LENGTH]
        beside = BESIDE_REACH + boxes[k, Box.HALF_WIDTH] + boxes[j, Box.HALF_WIDTH]
        if not level or not 0.0 < across <= beside:
            continue
        follows = j == last + 1
        if stands and not (follows and along < offset_of_last) and away < best:
            best, found = away, last + 1
        stands = not (follows and along > offset_of_last)
        last, offset_of_last, away = j, along, across
    if stands and away < best:
        return last + 1
    return found


@entry
@allocates
def see_near(
    sizes: Table, x: Table, y: Table, times: Vector, reach: float, near: Table, least: Vector
) -> None:
    """Update `near`, (benches, NEAR_COLUMNS), with the nearest bench to each at these times, s.

    A row changes only if a non-adjacent bench is nearer than its NEAR. least[t] becomes the distance of
    the nearest pair, at most `reach`, m; NaN if the dragon cannot be placed. x and y are (handles,
    times).
    """
    count, last = sizes.shape[1], times.shape[0]
    distance, partner = np.empty((last, count)), np.empty((last, count), dtype=np.int64)
    for t in range(last):
        least[t] = reach
        if x[count, t] != x[count, t]:
            least[t] = math.nan
            continue
        nearest_each(sizes, x, y, t, reach, -math.inf, distance, partner)
        for k in range(count):
            least[t] = min(least[t], distance[t, k])
            if distance[t, k] < near[k, Neighbour.NEAR]:
                near[k, Neighbour.NEAR], near[k, Neighbour.WHEN] = distance[t, k], times[t]
                near[k, Neighbour.NUMBER] = partner[t, k] + 1
