"""The distance of a whole dance from the obstacles on its square, at any pose of the dance."""

import math

import numpy as np

from benchdragon.kernels import box
from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.box import Box, box_distance, box_gap, half_diagonal, offset, place_box
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.obstacle import forbids

# Neighbouring boxes that are bounded by one circle.
GROUP = 16
# Steps towards the farthest corner by which the centre of the smallest circle is found: the circle is
# then wider than the smallest by a share of at most 1 / CIRCLE_STEPS.
CIRCLE_STEPS = 1_000


class Circle(Numbered):
    """Columns of a table of circles: centre and radius, m."""

    X, Y, RADIUS = range(3)


@entry
def lay_boxes(
    rows: Table, link: Vector, sizes: Table, k: int, at: Vector, places: Placements, first: int,
    out: Table,
) -> bool:  # fmt: skip
    """Fill out[first + n] with a bench of sizes k whose front handle is at[n] along the route, m.

    `places` is scratch for so many chains of one bench. Whether it can stand at all of them.
    """
    sound = place_chain(rows, link, at, 0, at.shape[0], places)
    for n in range(at.shape[0]):
        place_box(sizes, k, 0, places.x, places.y, n, out, first + n)
    return sound


@entry
def bound_groups(boxes: Table, circles: Table) -> None:
    """Fill circles[g] with one about the g-th GROUP of boxes; the last box is no part of any."""
    last = boxes.shape[0] - 1
    for g in range(circles.shape[0]):
        first, end = GROUP * g, min(GROUP * (g + 1), last)
        x, y, radius = 0.0, 0.0, 0.0
        for i in range(first, end):
            x += boxes[i, Box.CX] / (end - first)
            y += boxes[i, Box.CY] / (end - first)
        for i in range(first, end):
            far = math.hypot(boxes[i, Box.CX] - x, boxes[i, Box.CY] - y)
            radius = max(radius, far + half_diagonal(boxes, i))
        circles[g, Circle.X], circles[g, Circle.Y], circles[g, Circle.RADIUS] = x, y, radius


@entry
def pose_clearance(
    boxes: Table, circles: Table, sides: Table, sort: int, outline: Table, radius: float, x: float,
    y: float, angle: float, most: float,
) -> float:  # fmt: skip
    """The least distance of boxes at a pose from an obstacle or the venue's edge, m, or `most`.

    It is minus the depth of an overlap; minus the distance if all boxes stand where none may be.

    Args:
        boxes: about the dance's origin, one touching the next; the last is scratch.
        circles: as `bound_groups` fills them.
        sides: of the obstacle, boxes without width.
        sort: its kind, as in kernels/obstacle.py.
        outline: its corners, m, (P, 2).
        radius: of a circle, m; else 0.
        x: of the dance's origin, m.
        y: the same.
        angle: by which the dance is turned to the left, rad.
        most: what is farther off counts as so far, m.
    """
    c, s = math.cos(angle), math.sin(angle)
    last, least = boxes.shape[0] - 1, most + radius
    for k in range(sides.shape[0]):
        dx, dy = sides[k, Box.CX] - x, sides[k, Box.CY] - y
        ux, uy = sides[k, Box.UX], sides[k, Box.UY]
        boxes[last, Box.CX], boxes[last, Box.CY] = c * dx + s * dy, c * dy - s * dx
        boxes[last, Box.UX], boxes[last, Box.UY] = c * ux + s * uy, c * uy - s * ux
        boxes[last, Box.HALF_LENGTH] = sides[k, Box.HALF_LENGTH]
        boxes[last, Box.HALF_WIDTH] = sides[k, Box.HALF_WIDTH]
        least = nearest_of_groups(boxes, circles, least)
    apart = least - radius
    cx, cy = boxes[0, Box.CX], boxes[0, Box.CY]
    if apart > 0.0 and forbids(sort, outline, radius, x + c * cx - s * cy, y + s * cx + c * cy):
        return -apart
    return apart


@kernel
def nearest_of_groups(boxes: FloatArray, circles: FloatArray, least: float) -> float:
    """The distance of the last box from the nearest of the others, m, if that is less than `least`."""
    last = boxes.shape[0] - 1
    for g in range(circles.shape[0]):
        reach = least + circles[g, Circle.RADIUS]
        if beyond(boxes, last, circles[g, Circle.X], circles[g, Circle.Y], reach):
            continue
        for i in range(GROUP * g, min(GROUP * (g + 1), last)):
            long, wide = boxes[i, Box.HALF_LENGTH], boxes[i, Box.HALF_WIDTH]
            reach = least + math.sqrt(long * long + wide * wide)
            if beyond(boxes, last, boxes[i, Box.CX], boxes[i, Box.CY], reach):
                continue
            if box_gap(boxes, i, last) < least:  # it is no larger than the distance
                least = min(least, box_distance(boxes, i, last))
    return least


@kernel
def beyond(boxes: FloatArray, n: int, x: float, y: float, reach: float) -> bool:
    """Whether a point is farther from box n than a reach, m: by squares, for roots take their time."""
    along, across = offset(boxes, n, x, y)
    ahead = max(abs(along) - boxes[n, Box.HALF_LENGTH], 0.0)
    aside = max(abs(across) - boxes[n, Box.HALF_WIDTH], 0.0)
    return reach <= 0.0 or ahead * ahead + aside * aside >= reach * reach


@entry
def extent(boxes: Table, angle: float, out: Vector) -> None:
    """Fill out with the least and greatest x, then y, of all boxes but the last, turned, m."""
    c, s = math.cos(angle), math.sin(angle)
    out[0] = out[2] = math.inf
    out[1] = out[3] = -math.inf
    for i in range(boxes.shape[0] - 1):
        for k in range(4):
            px, py = box.corner(boxes, i, k)
            x, y = c * px - s * py, c * py + s * px
            out[0], out[1] = min(out[0], x), max(out[1], x)
            out[2], out[3] = min(out[2], y), max(out[3], y)


@entry
@allocates
def smallest_circle(boxes: Table, out: Vector) -> None:
    """Fill out with centre and radius of a circle about all boxes but the last, m.

    The centre goes towards the farthest corner by ever shorter steps (Badoiu and Clarkson, 2003): after
    n of them the circle is wider than the smallest by a share of at most 1 / n.
    """
    corners = np.empty((4 * (boxes.shape[0] - 1), 2))
    for i in range(boxes.shape[0] - 1):
        for k in range(4):
            corners[4 * i + k, 0], corners[4 * i + k, 1] = box.corner(boxes, i, k)
    x, y, square = corners[0, 0], corners[0, 1], 0.0
    for n in range(CIRCLE_STEPS):
        far, square = 0, -1.0
        for i in range(corners.shape[0]):
            dx, dy = corners[i, 0] - x, corners[i, 1] - y
            if dx * dx + dy * dy > square:
                far, square = i, dx * dx + dy * dy
        if n < CIRCLE_STEPS - 1:
            x += (corners[far, 0] - x) / (n + 2)
            y += (corners[far, 1] - y) / (n + 2)
    out[Circle.X], out[Circle.Y], out[Circle.RADIUS] = x, y, math.sqrt(square)
