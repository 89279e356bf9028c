"""Obstacles: their sides as boxes without width, and the points where no bench may be."""

import math

from benchdragon.kernels.arrays import IntVector, Table
from benchdragon.kernels.box import Box
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.numbered import Numbered


class ObstacleKind(Numbered):
    """Kinds of obstacles.

    They are a circle about its outline's one point, what has an inside, a line, the edge of a venue.
    """

    CIRCLE, BODY, LINE, VENUE = range(4)


@entry
def fill_boxes(kind: int, outline: Table, out: Table) -> None:
    """Fill `out` with the sides, or the centre, as boxes without width, (.., BOX_COLUMNS)."""
    corners = outline.shape[0]
    for n in range(out.shape[0]):
        m = (n + 1) % corners
        dx, dy = outline[m, 0] - outline[n, 0], outline[m, 1] - outline[n, 1]
        length = math.hypot(dx, dy)
        out[n, Box.CX] = 0.5 * (outline[n, 0] + outline[m, 0])
        out[n, Box.CY] = 0.5 * (outline[n, 1] + outline[m, 1])
        out[n, Box.UX], out[n, Box.UY] = 1.0, 0.0
        if kind != ObstacleKind.CIRCLE:
            out[n, Box.UX], out[n, Box.UY] = dx / length, dy / length
        out[n, Box.HALF_LENGTH], out[n, Box.HALF_WIDTH] = 0.5 * length, 0.0


@kernel
def sides(kind: int, corners: int) -> int:
    """The number of boxes of an outline with so many corners."""
    return corners - 1 if kind == ObstacleKind.LINE else corners


@kernel
def forbids(kind: int, outline: FloatArray, radius: float, x: float, y: float) -> bool:
    """Whether a point, m, lies where no bench may be: inside the obstacle, or outside the venue.

    Inside a polygon a ray to the right crosses an odd number of sides.
    """
    if kind == ObstacleKind.CIRCLE:
        return math.hypot(x - outline[0, 0], y - outline[0, 1]) <= radius
    corners, odd = outline.shape[0], False
    for n in range(corners if kind != ObstacleKind.LINE else 0):
        ax, ay = outline[n, 0], outline[n, 1]
        bx, by = outline[(n + 1) % corners, 0], outline[(n + 1) % corners, 1]
        if (ay > y) != (by > y):
            beyond = (x - ax) * abs(by - ay) < (bx - ax) * (y - ay) * (1.0 if by > ay else -1.0)
            odd = odd != beyond
    return odd != (kind == ObstacleKind.VENUE)


@entry
def forbidden(kind: int, outline: Table, radius: float, points: Table, out: IntVector) -> None:
    """Fill `out` with 1 for each of points, m, (P, 2), that lies where no bench may be, else 0."""
    for n in range(points.shape[0]):
        out[n] = 1 if forbids(kind, outline, radius, points[n, 0], points[n, 1]) else 0
