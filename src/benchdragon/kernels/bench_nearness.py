"""The tightest moment of each bench over a walk, and the benches beside it."""

import math

import numpy as np

from benchdragon.kernels.arrays import IntTable, Table, Vector
from benchdragon.kernels.bench_walks import LEVEL_DISTANCES, NOBODY, BenchRow, Known, Line
from benchdragon.kernels.box import (
    BOX_COLUMNS,
    Box,
    box_gap,
    boxes_at,
    centres,
    corner,
    nearest_corner,
    offset,
    radii,
    set_box,
)
from benchdragon.kernels.box import box_distance as apart
from benchdragon.kernels.chain import march
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.local_minima import local_minimum
from benchdragon.kernels.nearness import foot
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import IntArray

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
    count = sizes.shape[1]
    boxes = np.empty((count, BOX_COLUMNS))
    cx, cy, squares, radius = np.empty(count), np.empty(count), np.empty(count), np.empty(count)
    widest = radii(sizes, radius)
    pair = np.zeros(2, dtype=np.int64)  # what was nearest at the time before is likely to be so again
    for t in range(times.shape[0]):
        if x[count, t] != x[count, t]:
            least[t] = math.nan
            continue
        boxes_at(sizes, x, y, t, boxes)
        centres(boxes, cx, cy)
        least[t] = reach
        if pair[0] < pair[1]:
            least[t] = min(reach, apart(boxes, pair[0], pair[1]))
        most = least[t]
        for k in range(count):
            most = max(most, min(near[k, Neighbour.NEAR], reach))
        for i in range(2, count):
            for j in range(i - 1):  # without a branch, so that it becomes SIMD
                squares[j] = (cx[j] - cx[i]) ** 2 + (cy[j] - cy[i]) ** 2
            far = (radius[i] + widest + max(most, 0.0)) ** 2
            for j in range(i - 1):
                if squares[j] <= far:
                    see_pair(boxes, i, j, most, times[t], near, least[t : t + 1], pair)


@kernel
def see_pair(
    boxes: FloatArray, i: int, j: int, most: float, time: float, near: FloatArray, least: FloatArray,
    pair: IntArray,
) -> None:  # fmt: skip
    """Update rows i and j of `near` at a time, s, and the least distance then, m, with its pair.

    Distances above `most`, m, do not count.
    """
    most = min(most, max(near[i, Neighbour.NEAR], near[j, Neighbour.NEAR], least[0]))
    if box_gap(boxes, j, i) > most:
        return
    distance = apart(boxes, j, i)
    if distance > most:
        return
    if distance <= least[0]:
        least[0], pair[0], pair[1] = distance, j, i
    keep_nearer(near, i, j, distance, time)
    keep_nearer(near, j, i, distance, time)


@kernel
def keep_nearer(near: FloatArray, k: int, other: int, distance: float, time: float) -> None:
    """Update the row of bench k with bench `other`, if that is nearer than any before."""
    if distance < near[k, Neighbour.NEAR]:
        near[k, Neighbour.NEAR], near[k, Neighbour.WHEN] = distance, time
        near[k, Neighbour.NUMBER] = other + 1
