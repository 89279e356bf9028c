"""When another bench is nearest to each over a walk, and who stands beside it."""

import math

import numpy as np

from benchdragon.kernels import box
from benchdragon.kernels.arrays import IntTable, Table, Vector
from benchdragon.kernels.bench_walks import AT, FLOOR, LEVEL, NEAREST, NOBODY, PARTNER, Known, Line
from benchdragon.kernels.box import box_distance as apart
from benchdragon.kernels.box import boxes_at, corner, nearest_corner, nearest_each, offset, set_box
from benchdragon.kernels.chain import march
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.local_minima import local_minimum
from benchdragon.kernels.nearness import foot

# How far other benches are looked for, m, at all times; and at the end for those beside.
REACH, BESIDE = 1.5, 1.5
# Benches farther apart than this, m, in a straight line are of another coil once they come within
# REACH: nearer than half of that, which takes a bend of more than half a turn. The others are next in
# line and near at all times, which tells a bearer nothing.
STRAIGHT = 2.0 * REACH
# How often the time about a least distance is narrowed.
SHRINKS = 6
# Columns of tightest moments: number of the other bench, 0 for none; its side, of those below; bounds
# of how near it comes, m; where the head then is, m; numbers of the times before and after; and where
# the bench's front handle is, m.
OTHER, WHERE, LOWER, UPPER, HEAD, EARLY, LATE, PLACE_X, PLACE_Y = 0, 1, 2, 3, 4, 5, 6, 7, 8
TIGHTEST_COLUMNS = 9
# Columns of what is nearest to a bench: how near, m, when, s, and its number.
NEAR, WHEN, NUMBER, NEAR_COLUMNS = 0, 1, 2, 3
ON_LEFT, ON_RIGHT, AT_FRONT, AT_REAR = 0, 1, 2, 3


@kernel
def side_of(boxes: FloatArray, k: int, x: float, y: float) -> int:
    """On which side of box k a point lies that is outside of it."""
    along, across = offset(boxes, k, x, y)
    if abs(along) - boxes[k, box.HALF_LENGTH] > abs(across) - boxes[k, box.HALF_WIDTH]:
        return AT_FRONT if along > 0.0 else AT_REAR
    return ON_LEFT if across > 0.0 else ON_RIGHT


@kernel
def nearest_side(boxes: FloatArray) -> int:
    """On which side of box 0 that point of box 1 lies which is nearest to it, or deepest in it."""
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

    `heads` are all head positions that were looked at, m. No two benches that are not neighbours come
    nearer than `least`, m, as far as that is known.
    """
    at, places, benches = known.at, known.places, known.benches
    for k in range(first, stop):
        other, n = int(benches[k, PARTNER]), int(benches[k, AT])
        out[k, OTHER] = other + 1
        if other == NOBODY:
            continue
        early, late = max(n - 1, 0), min(n + 1, heads.shape[0] - 1)
        i, j, head = min(k, other), max(k, other), heads[n]
        if heads[early] < heads[late]:
            lowest, where = local_minimum(
                line.rows, line.links, line.sizes, i, j, heads[early], heads[late], SHRINKS, at, places,
                boxes,
            )  # fmt: skip
            if lowest < benches[k, NEAREST] - LEVEL:
                head = where
        at[0] = head
        march(line.rows, line.links[: j + 1], at, 0, 1, places)
        set_box(line.sizes, k, places.x, places.y, 0, boxes, 0)
        set_box(line.sizes, other, places.x, places.y, 0, boxes, 1)
        upper = max(apart(boxes, 0, 1), 0.0)
        out[k, WHERE], out[k, UPPER], out[k, HEAD] = nearest_side(boxes), upper, head
        out[k, LOWER] = min(max(benches[k, FLOOR], least, 0.0), upper)
        out[k, EARLY], out[k, LATE] = early, late
        out[k, PLACE_X], out[k, PLACE_Y] = places.x[k, 0], places.y[k, 0]


@entry
def find_beside(sizes: Table, x: Table, y: Table, boxes: Table, beside: IntTable) -> None:
    """Fill `beside`, (benches, 2), with the number of the bench next to each on its left and right.

    At the first placement of x and y, (handles, times). Of each line of benches that passes, no
    neighbours and no more than BESIDE metres away, that is the one most abreast, and of these the one
    of the nearest line; 0 where there is none. `boxes` become those of all benches.
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
        along, across = offset(boxes, k, boxes[j, box.CX], boxes[j, box.CY])
        along, across = abs(along), hand * across
        level = along <= boxes[k, box.HALF_LENGTH] + 0.5 * boxes[j, box.HALF_LENGTH]
        beside = BESIDE + boxes[k, box.HALF_WIDTH] + boxes[j, box.HALF_WIDTH]
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
    """Note in `near`, (benches, NEAR_COLUMNS), who comes nearest to each at these times, s, and when.

    Only what is nearer than what stands there counts, and no neighbour. least[t] becomes the distance
    of the tightest pair, at most `reach`, m; NaN where the dragon does not stand. x and y are (handles,
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
            if distance[t, k] < near[k, NEAR]:
                near[k, NEAR], near[k, WHEN] = distance[t, k], times[t]
                near[k, NUMBER] = partner[t, k] + 1
