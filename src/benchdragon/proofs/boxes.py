"""Benches and sides of obstacles as rectangles in doubles, to SLACK, and how far apart pairs are."""

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
import numpy.typing as npt
from scipy.spatial import KDTree

from benchdragon.kernels.curve import FloatArray
from benchdragon.proofs.chain import Chain
from benchdragon.proofs.motion import SLACK
from benchdragon.proofs.sizes import Sizes

IntArray = npt.NDArray[np.int64]
# Corners: in front or behind (of the front and rear handle), and left or right.
CORNERS = ((0, 1), (0, -1), (1, -1), (1, 1))
# Axes along which two rectangles may be separated: whose normal (0 the first, 1 the second; 2: from a
# corner to the nearest of the other), and which (0 along the rectangle, 1 across). Coils lie side by
# side: across comes first.
LINES = ((0, 1), (1, 1), (0, 0), (1, 0), (2, 0))


@dataclass(frozen=True)
class Boxes:
    """Rectangles: arrays of one shape (..., N).

    Attributes:
        x: of the middle, m, as y.
        y: m.
        ahead_x: of the unit vector along the rectangle, as ahead_y.
        ahead_y: the same.
        long: half of the length, m.
        wide: half of the width, m.
    """

    x: FloatArray
    y: FloatArray
    ahead_x: FloatArray
    ahead_y: FloatArray
    long: FloatArray
    wide: FloatArray

    @classmethod
    def of(cls, chains: Sequence[Chain], sizes: Sizes) -> "Boxes":
        """The benches of some chains, (chains, N)."""
        links, front, rear, width = sizes.numbers
        x, y = (np.stack([getattr(chain, name) for chain in chains]) for name in ("x", "y"))
        dx, dy = (at[:, :-1] - at[:, 1:] for at in (x, y))
        size = np.hypot(
            dx, dy
        )  # not the link: places are rounded, and a longer line would see wider gaps
        ahead_x, ahead_y = dx / size, dy / size
        off = 0.5 * (front - rear)  # the middle, from that of both handles
        x, y = (0.5 * (at[:, :-1] + at[:, 1:]) + off * on for at, on in ((x, ahead_x), (y, ahead_y)))
        long, wide = 0.5 * (links + front + rear), 0.5 * width
        return cls(x, y, ahead_x, ahead_y, np.tile(long, (len(x), 1)), np.tile(wide, (len(x), 1)))

    @classmethod
    def between(cls, start: FloatArray, end: FloatArray) -> "Boxes":
        """Those without width between points, m, (N, 2)."""
        (x, y), (dx, dy) = 0.5 * (start + end).T, (start - end).T
        size = np.hypot(dx, dy)
        some = np.where(size > 0.0, size, 1.0)
        ahead_x, ahead_y = np.where(size > 0.0, dx / some, 1.0), np.where(size > 0.0, dy / some, 0.0)
        return cls(x, y, ahead_x, ahead_y, 0.5 * size, np.zeros(len(size)))

    @property
    def ends(self) -> tuple[FloatArray, FloatArray]:
        """The middles of the front and the rear side, m, (..., N, 2)."""
        middle = np.stack([self.x, self.y], -1)
        half = self.long[..., None] * np.stack([self.ahead_x, self.ahead_y], -1)
        return middle + half, middle - half

    @property
    def corners(self) -> FloatArray:
        """In the order of CORNERS, m, (..., N, 4, 2)."""
        ends, half = self.ends, self.wide[..., None] * np.stack([-self.ahead_y, self.ahead_x], -1)
        return np.stack([ends[end] + side * half for end, side in CORNERS], -2)

    @property
    def first(self) -> "Boxes":
        """Those of the first chain, of several."""
        return Boxes(*(getattr(self, field.name)[0] for field in fields(self)))

    def at(self, i: IntArray) -> "Boxes":
        """Rectangles number i of the last axis."""
        return Boxes(*(getattr(self, field.name)[..., i] for field in fields(self)))

    def extent(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """How far they reach along unit vectors (x, y) from their middles, m."""
        along, across = self.ahead_x * x + self.ahead_y * y, self.ahead_x * y - self.ahead_y * x
        reached: FloatArray = self.long * np.abs(along) + self.wide * np.abs(across)
        return reached


def reach(way: FloatArray, sizes: Sizes) -> FloatArray:
    """How far any point of each bench moves while its handles go so far, m, (N,), at most."""
    links, front, rear, width = sizes.numbers
    ahead, behind = way[:-1], way[1:]
    over = np.maximum(front * ahead + front * behind + links * ahead, rear * (ahead + behind))
    over = np.maximum(over, rear * (ahead + behind) + links * behind)
    result: FloatArray = (over + 0.5 * width * (ahead + behind)) / links * (1.0 + 1e-12)
    return result


def near_pairs(boxes: Boxes, room: FloatArray, margin: float) -> IntArray:
    """Pairs of non-adjacent benches, of boxes (N,), that could come within `margin`, (n, 2), i < j.

    `room` is how far each moves. All others are farther apart than that by their circles alone.
    """
    middle, radius = np.stack([boxes.x, boxes.y], 1), _radius(boxes, room)
    pairs = KDTree(middle).query_pairs(2.0 * radius.max() + margin, output_type="ndarray")
    i, j = np.sort(pairs, axis=1).T
    apart = np.hypot(*(middle[i] - middle[j]).T)
    keep = (j > i + 1) & (apart <= radius[i] + radius[j] + margin)
    return np.stack([i[keep], j[keep]], 1)


def near_sides(boxes: Boxes, sides: Boxes, room: FloatArray, margin: float) -> IntArray:
    """The same of benches and sides, (n, 2): the number of the bench, and of the side."""
    x, y = boxes.x[:, None] - sides.x, boxes.y[:, None] - sides.y
    along = np.clip(sides.ahead_x * x + sides.ahead_y * y, -sides.long, sides.long)
    off = np.hypot(x - along * sides.ahead_x, y - along * sides.ahead_y)
    return np.argwhere(off <= _radius(boxes, room)[:, None] + margin)


def _radius(boxes: Boxes, room: FloatArray) -> FloatArray:
    """Of circles about benches' middles that hold each while it moves so far, m."""
    result: FloatArray = np.hypot(boxes.long, boxes.wide) + room + SLACK
    return result


@dataclass(frozen=True)
class Gaps:
    """How pairs of rectangles are apart along L lines, as seen in doubles.

    Attributes:
        size: m, (L, ..., n): a lower bound of the distance.
        x: of the unit vector from one towards the other, as y; (L, ..., n).
        y: the same.
    """

    size: FloatArray
    x: FloatArray
    y: FloatArray


def gaps(one: Boxes, other: Boxes, lines: Sequence[tuple[int, int]] = LINES) -> Gaps:
    """How pairs of rectangles, (..., n) each, are apart along some of LINES."""
    found = [_line((one, other), *which) for which in lines]
    shape = np.broadcast(one.x, other.x).shape  # of sides there is one for both chains
    x, y = (
        np.stack([np.broadcast_to(v, shape) for v in values]) for values in zip(*found, strict=True)
    )
    apart = (other.x - one.x) * x + (other.y - one.y) * y
    sign = np.where(apart >= 0.0, 1.0, -1.0)
    return Gaps(np.abs(apart) - one.extent(x, y) - other.extent(x, y), sign * x, sign * y)


def _line(boxes: tuple[Boxes, Boxes], normal: int, axis: int) -> tuple[FloatArray, FloatArray]:
    """One of LINES, as unit vectors, x and y, (..., n)."""
    if normal == 2:
        return _to_corner(*boxes)
    x, y = boxes[normal].ahead_x, boxes[normal].ahead_y
    return (x, y) if axis == 0 else (-y, x)


def _to_corner(one: Boxes, other: Boxes) -> tuple[FloatArray, FloatArray]:
    """Unit vectors from a corner to the nearest of the other rectangle, x and y, (..., n)."""
    between = other.corners[..., None, :, :] - one.corners[..., :, None, :]
    between = between.reshape(*between.shape[:-3], 16, 2)
    apart = np.hypot(between[..., 0], between[..., 1])
    nearest = apart.argmin(-1)[..., None]
    near = np.take_along_axis(between, nearest[..., None], -2)[..., 0, :]
    size = np.maximum(np.take_along_axis(apart, nearest, -1)[..., 0], 1e-300)
    return near[..., 0] / size, near[..., 1] / size
