"""Oriented rectangles: signed gap, true distance, and where two of them are nearest.

A table of boxes has one row a bench, its columns named below; the kernels take the table and two
row numbers, so that no box is ever copied.
"""

import math

import numpy as np

from benchdragon.kernels.arrays import IntTable, IntVector, Table, Vector
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.links import link_of
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import IntArray


class Box(Numbered):
    """Columns of a table of boxes, one row a bench."""

    CX = 0  # centre, m
    CY = 1
    UX = 2  # unit vector along the bench, towards its front
    UY = 3
    HALF_LENGTH = 4  # m
    HALF_WIDTH = 5


BOX_COLUMNS = len(Box)
# m; the longest that is still a bench and the shortest link that chords of 1e-12 m can resolve.
LONGEST_BENCH, SHORTEST_LINK = 1e4, 1e-3

# Corners in going round: front left, rear left, rear right, front right.
ALONG = np.array([1.0, -1.0, -1.0, 1.0])
ACROSS = np.array([1.0, 1.0, -1.0, -1.0])


@kernel
def place_box(
    sizes: FloatArray, n: int, i: int, x: FloatArray, y: FloatArray, t: int, out: FloatArray, k: int
) -> None:
    """Fill row k of `out` with a box of sizes n, whose handles stand at x[i..i+1, t], y[i..i+1, t].

    `sizes` has four rows: length, width, front inset, rear inset, m.
    """
    link = link_of(sizes, n)
    ux, uy = (x[i, t] - x[i + 1, t]) / link, (y[i, t] - y[i + 1, t]) / link
    ahead = sizes[2, n] - 0.5 * sizes[0, n]
    out[k, Box.CX], out[k, Box.CY] = x[i, t] + ahead * ux, y[i, t] + ahead * uy
    out[k, Box.UX], out[k, Box.UY] = ux, uy
    out[k, Box.HALF_LENGTH], out[k, Box.HALF_WIDTH] = 0.5 * sizes[0, n], 0.5 * sizes[1, n]


@kernel
def set_box(
    sizes: FloatArray, i: int, x: FloatArray, y: FloatArray, t: int, out: FloatArray, k: int
) -> None:
    """Fill row k of `out` with the box of bench i of a dragon with these sizes: see place_box."""
    place_box(sizes, i, i, x, y, t, out, k)


@entry
def boxes_at(sizes: Table, x: Table, y: Table, t: int, out: Table) -> None:
    """Fill `out`, (benches, BOX_COLUMNS), with the boxes of all benches at time number t."""
    for i in range(out.shape[0]):
        set_box(sizes, i, x, y, t, out, i)


@kernel
def box_gap(boxes: Table, i: int, j: int) -> float:
    """Signed gap of two boxes, m: the largest separation along their four axes; negative inside.

    Never larger than the distance, and negative exactly when the boxes overlap.
    """
    dx, dy = boxes[j, Box.CX] - boxes[i, Box.CX], boxes[j, Box.CY] - boxes[i, Box.CY]
    ux, uy, vx, vy = boxes[i, Box.UX], boxes[i, Box.UY], boxes[j, Box.UX], boxes[j, Box.UY]
    c, s = abs(ux * vx + uy * vy), abs(ux * vy - uy * vx)
    a, b = boxes[i, Box.HALF_LENGTH], boxes[i, Box.HALF_WIDTH]
    p, q = boxes[j, Box.HALF_LENGTH], boxes[j, Box.HALF_WIDTH]
    along_i = abs(dx * ux + dy * uy) - a - p * c - q * s
    across_i = abs(dy * ux - dx * uy) - b - p * s - q * c
    along_j = abs(dx * vx + dy * vy) - p - a * c - b * s
    across_j = abs(dy * vx - dx * vy) - q - a * s - b * c
    return max(along_i, across_i, along_j, across_j)


@kernel
def corner(boxes: Table, i: int, k: int) -> tuple[float, float]:
    """Corner k of box i, m."""
    a, b = ALONG[k] * boxes[i, Box.HALF_LENGTH], ACROSS[k] * boxes[i, Box.HALF_WIDTH]
    ux, uy = boxes[i, Box.UX], boxes[i, Box.UY]
    return boxes[i, Box.CX] + a * ux - b * uy, boxes[i, Box.CY] + a * uy + b * ux


@kernel
def offset(boxes: Table, j: int, x: float, y: float) -> tuple[float, float]:
    """Point (x, y) in box j's own frame, m: ahead of its centre, and to its left."""
    dx, dy = x - boxes[j, Box.CX], y - boxes[j, Box.CY]
    ux, uy = boxes[j, Box.UX], boxes[j, Box.UY]
    return dx * ux + dy * uy, dy * ux - dx * uy


@kernel
def corner_distance(boxes: FloatArray, i: int, k: int, j: int) -> float:
    """Distance from corner k of box i to box j, m; inside, minus the depth below the nearest side."""
    x, y = corner(boxes, i, k)
    along, across = offset(boxes, j, x, y)
    ahead, aside = abs(along) - boxes[j, Box.HALF_LENGTH], abs(across) - boxes[j, Box.HALF_WIDTH]
    if ahead <= 0.0 or aside <= 0.0:
        return max(ahead, aside)
    return math.hypot(ahead, aside)


@kernel
def box_distance(boxes: Table, i: int, j: int) -> float:
    """True distance of two boxes, m; where they overlap, the gap, which is negative.

    Two convex polygons that are apart are nearest at a corner of one of them.
    """
    gap = box_gap(boxes, i, j)
    if gap <= 0.0:
        return gap
    nearest = math.inf
    for k in range(4):
        nearest = min(nearest, corner_distance(boxes, i, k, j), corner_distance(boxes, j, k, i))
    return nearest


@kernel
def nearest_corner(boxes: Table, i: int, j: int) -> tuple[bool, int]:
    """Where two boxes are nearest: whether at a corner of i (else of j), and at which corner.

    If they overlap, it is the corner that lies deepest inside the other; if none lies inside, the one
    that lies nearest to it.
    """
    best, mine, which = math.inf, True, 0
    for k in range(4):
        apart = corner_distance(boxes, i, k, j)
        if apart < best:
            best, mine, which = apart, True, k
        apart = corner_distance(boxes, j, k, i)
        if apart < best:
            best, mine, which = apart, False, k
    return mine, which


@entry
def pair_distances(
    boxes: Table, first: IntVector, second: IntVector, gap: Vector, distance: Vector
) -> None:
    """Fill gap[p] and distance[p] for the pairs of boxes (first[p], second[p])."""
    for p in range(first.shape[0]):
        gap[p] = box_gap(boxes, first[p], second[p])
        distance[p] = box_distance(boxes, first[p], second[p])


@entry
@allocates
def distances_along(sizes: Table, x: Table, y: Table, i: int, j: int, out: Vector) -> None:
    """Fill out[t] with the distance of benches i and j at each time; minus the depth of an overlap."""
    boxes = np.empty((2, BOX_COLUMNS))
    for t in range(out.shape[0]):
        set_box(sizes, i, x, y, t, boxes, 0)
        set_box(sizes, j, x, y, t, boxes, 1)
        out[t] = box_distance(boxes, 0, 1)


@kernel
def inside(sides: FloatArray, first: int, last: int, x: float, y: float) -> bool:
    """Whether (x, y) lies inside sides first to last - 1, boxes without width that close a polygon.

    A ray to the right then crosses an odd number of them.
    """
    odd = False
    for n in range(first, last):
        rise = sides[n, Box.HALF_LENGTH] * sides[n, Box.UY]
        if (sides[n, Box.CY] - rise > y) != (sides[n, Box.CY] + rise > y):
            odd = odd != (
                sides[n, Box.CX] + (y - sides[n, Box.CY]) * sides[n, Box.UX] / sides[n, Box.UY] > x
            )
    return odd


@kernel
def half_diagonal(boxes: FloatArray, i: int) -> float:
    """The radius of the circle around box i, m."""
    a, b = boxes[i, Box.HALF_LENGTH], boxes[i, Box.HALF_WIDTH]
    return math.sqrt(a * a + b * b)


@kernel
def radii(sizes: FloatArray, out: FloatArray) -> float:
    """Fill out with the radius of the circle around each bench, m; the greatest of them."""
    greatest = 0.0
    for i in range(out.shape[0]):
        out[i] = 0.5 * math.sqrt(sizes[0, i] * sizes[0, i] + sizes[1, i] * sizes[1, i])
        greatest = max(greatest, out[i])
    return greatest


@kernel
def in_a_line(sizes: FloatArray, front: FloatArray, rear: FloatArray) -> None:
    """Fill `front` and `rear` with how far behind the head's front hole bench ends lie in a line, m."""
    hole = 0.0
    for i in range(front.shape[0]):
        front[i] = hole - sizes[2, i]
        rear[i] = front[i] + sizes[0, i]
        hole = rear[i] - sizes[3, i]


@kernel
def centres(boxes: FloatArray, cx: FloatArray, cy: FloatArray) -> None:
    """Fill cx and cy with the centres of the first boxes, m: columns of their own are read faster."""
    for i in range(cx.shape[0]):
        cx[i], cy[i] = boxes[i, Box.CX], boxes[i, Box.CY]


@kernel
def nearest_of(
    boxes: FloatArray, radius: FloatArray, cx: FloatArray, cy: FloatArray, least: float
) -> tuple[float, int, int]:
    """The least distance of any two non-adjacent boxes, m, if it is below `least`; and which two.

    Most pairs are culled by the circles around them. `cx` and `cy` are scratch.
    """
    widest, first, second = 0.0, 0, 0
    centres(boxes, cx, cy)
    for i in range(radius.shape[0]):
        widest = max(widest, radius[i])
    for i in range(2, radius.shape[0]):
        far = (radius[i] + widest + least) ** 2
        for j in range(i - 1):
            dx, dy = cx[j] - cx[i], cy[j] - cy[i]
            apart = dx * dx + dy * dy
            if apart < far:
                near = radius[i] + radius[j] + least
                if apart < near * near and near > 0.0 and box_gap(boxes, i, j) < least:
                    distance = box_distance(boxes, i, j)
                    if distance < least:
                        least, first, second = distance, j, i
    return least, first, second


@entry
@allocates
def nearest_pair(sizes: Table, x: Table, y: Table) -> tuple[float, int, int, int]:
    """The least distance of two non-adjacent benches at any time, m; the time's number, both benches.

    It is minus the depth of an overlap. x and y are (handles, times). All pairs are covered; the
    distance is computed only for those whose circles come nearer than the least so far.
    """
    count = sizes.shape[1]
    boxes = np.empty((count, BOX_COLUMNS))
    cx, cy, radius = np.empty(count), np.empty(count), np.empty(count)
    radii(sizes, radius)
    least, when, first, second = math.inf, 0, 0, 0
    for t in range(x.shape[1]):
        boxes_at(sizes, x, y, t, boxes)
        distance, i, j = nearest_of(boxes, radius, cx, cy, least)
        if distance < least:
            least, when, first, second = distance, t, i, j
    return least, when, first, second


@entry
def least_distance(sizes: Table, x: Table, y: Table) -> float:
    """The least distance alone, m: see nearest_pair."""
    return nearest_pair(sizes, x, y)[0]


@entry
@allocates
def nearest_each(
    sizes: Table, x: Table, y: Table, t: int, reach: float, straight: float, distance: Table,
    partner: IntTable,
) -> None:  # fmt: skip
    """Fill row t with each bench's least distance to a non-adjacent one, m, and with that one's number.

    Beyond `reach`, m, they are infinite and -1; overlaps count minus their depth. x and y are (handles,
    times). Only pairs count that are farther apart than `straight`, m, in the straightened chain.
    """
    count = sizes.shape[1]
    boxes = np.empty((count, BOX_COLUMNS))
    boxes_at(sizes, x, y, t, boxes)
    cx, cy, apart, radius = np.empty(count), np.empty(count), np.empty(count), np.empty(count)
    centres(boxes, cx, cy)
    widest = radii(sizes, radius) + reach
    front, rear = np.empty(count), np.empty(count)
    in_a_line(sizes, front, rear)
    for i in range(count):
        distance[t, i], partner[t, i] = math.inf, -1
    for i in range(2, count):
        for j in range(i - 1):  # without a branch, so that it becomes SIMD
            apart[j] = (cx[j] - cx[i]) ** 2 + (cy[j] - cy[i]) ** 2
        far = (radius[i] + widest) ** 2
        for j in range(i - 1):
            if apart[j] <= far and front[i] - rear[j] > straight:
                most = min(max(distance[t, i], distance[t, j]), reach)
                near = radius[i] + radius[j] + most
                if near > 0.0 and apart[j] <= near * near and box_gap(boxes, j, i) <= most:
                    meet(box_distance(boxes, j, i), i, j, t, reach, distance, partner)


@kernel
def meet(
    apart: float, i: int, j: int, t: int, reach: float, distance: FloatArray, partner: IntArray
) -> None:
    """Record in row t that benches i and j are `apart` metres apart, if that is less than before."""
    if apart <= reach and apart < distance[t, i]:
        distance[t, i], partner[t, i] = apart, j
    if apart <= reach and apart < distance[t, j]:
        distance[t, j], partner[t, j] = apart, i
