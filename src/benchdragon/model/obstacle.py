"""Obstacles and the venue's edge, from which benches keep their distance.

To every search an obstacle is boxes without width, its sides, or without length either, a circle's
centre. Benches move without a leap, so that none comes inside without crossing a side: only where the
dragon stands at first, it is asked besides on which side.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, Self

import numpy as np
import numpy.typing as npt

from benchdragon.errors import InputError, brief, finite, not_negative
from benchdragon.i18n import _
from benchdragon.kernels import obstacle as kernel
from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.curve import MOST_METRES, FloatArray
from benchdragon.kernels.obstacle import ObstacleKind
from benchdragon.model.arrays import as_numbers, as_table
from benchdragon.model.base_curve import Point, checked_size
from benchdragon.model.rings import gate_in, length_of, ring_of, stretch

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

Kind = Literal["circle", "rectangle", "polygon", "line", "venue"]
# What kinds are to the kernels.
SORTS = {
    "circle": ObstacleKind.CIRCLE,
    "rectangle": ObstacleKind.BODY,
    "polygon": ObstacleKind.BODY,
    "line": ObstacleKind.LINE,
    "venue": ObstacleKind.VENUE,
}
# Greatest number of corners of one outline: each is tested for each stretch of the route.
MOST_CORNERS = 5_000
# Shorter sides, m, are input errors.
LEAST_SIDE = 1e-6


class Standing:
    """An obstacle as the kernels take it.

    Attributes:
        kind: see `Obstacle`, as all others.
    """

    kind: Kind
    outline: FloatArray
    radius: float
    open: FloatArray | None

    @property
    def sort(self) -> int:
        """What its kind is to the kernels: an edge with a gate is a chain of lines."""
        return SORTS[self.kind if self.open is None else "line"]

    @property
    def walls(self) -> FloatArray:
        """What benches must not touch of it: its outline, or what a gate leaves of that, m, (P, 2)."""
        return self.outline if self.open is None else self.open

    @cached_property
    def boxes(self) -> FloatArray:
        """Its sides, or its centre, as boxes without width: (sides, BOX_COLUMNS) of kernels/box.py."""
        out = np.empty((kernel.sides(self.sort, len(self.walls)), BOX_COLUMNS))
        kernel.fill_boxes(self.sort, self.walls, out)
        out.flags.writeable = False
        return out

    def forbids(self, points: FloatArray) -> npt.NDArray[np.bool_]:
        """Which points, m, (P, 2), are forbidden: inside it, or outside the venue; (P,)."""
        out = np.empty(len(points), dtype=np.int64)
        points = np.ascontiguousarray(points)
        kernel.forbidden(self.sort, self.walls, self.radius, points, out)
        return out.astype(np.bool_)


@dataclass(frozen=True, eq=False)
class Obstacle(Standing):
    """Something that stands still, and that no bench may touch; or the edge of the venue.

    Use `circle`, `rectangle`, `polygon`, `line` and `venue`, which check what they are given: points
    as lists, as an array, or as a polygon or a line of shapely.

    Attributes:
        name: of the obstacle.
        kind: "venue" is an edge that no bench may cross outwards, "line" one without an inside.
        outline: its corners in order, m, (P, 2), the last joined to the first except for a line; of a
            circle the centre.
        radius: of a circle, m; else 0.
        margin: the distance that benches must keep, m.
        open: of a venue with a gate, what that leaves of its outline, from one post to the other, m.

    Examples:
        >>> well = bd.Obstacle.circle("well", (3.0, 4.0), 0.5, margin=0.3)
        >>> bd.Obstacle.polygon("stage", [(0, 0), (4, 0), (4, 2)]).outline.shape
        (3, 2)
    """

    name: str
    kind: Kind
    outline: FloatArray
    radius: float = 0.0
    margin: float = 0.0
    open: FloatArray | None = None

    def __post_init__(self) -> None:
        not_negative("margin", self.margin, "m")
        object.__setattr__(self, "outline", as_numbers(f"{self.name}: outline", self.outline))
        self.outline.flags.writeable = False

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Obstacle):
            return NotImplemented
        pairs = (self.outline, other.outline), (self.walls, other.walls)
        numbers = self.radius, self.margin
        alike = (self.name, self.kind, *numbers) == (other.name, other.kind, other.radius, other.margin)
        return alike and all(np.array_equal(one, its) for one, its in pairs)

    def __hash__(self) -> int:
        return hash((self.name, self.kind, self.radius, self.margin, self.outline.tobytes()))

    @classmethod
    def circle(cls, name: str, centre: Point, radius: float, margin: float = 0.0) -> Self:
        """A round obstacle: a well, a post.

        Raises:
            InputError: for a centre or a radius that cannot be.
        """
        return cls(name, "circle", _points(name, [centre], 1), checked_size("radius", radius), margin)

    @classmethod
    def rectangle(
        cls, name: str, centre: Point, size: tuple[float, float], angle: float = 0.0,
        margin: float = 0.0,
    ) -> Self:  # fmt: skip
        """A rectangle: its size along its own axes, m, and its angle, rad.

        Raises:
            InputError: for a centre, sizes or an angle that cannot be.
        """
        return cls(name, "rectangle", rectangle_outline(name, centre, size, angle), 0.0, margin)

    @classmethod
    def polygon(cls, name: str, points: "npt.ArrayLike | BaseGeometry", margin: float = 0.0) -> Self:
        """Any polygon that does not cross itself, its corners in order; it closes by itself.

        Raises:
            InputError: for fewer than three corners, sides of no length, or sides that cross.
        """
        return cls(name, "polygon", closed_outline(name, points), 0.0, margin)

    @classmethod
    def line(cls, name: str, points: "npt.ArrayLike | BaseGeometry", margin: float = 0.0) -> Self:
        """A chain of straight lines: a rope, a kerb. It may cross itself.

        Raises:
            InputError: for fewer than two points, or sides of no length.
        """
        return cls(name, "line", _points(name, points, 2), 0.0, margin)

    @classmethod
    def venue(cls, name: str, points: "npt.ArrayLike | BaseGeometry", margin: float = 0.0) -> Self:
        """The edge of the venue, which no bench may cross: a polygon.

        Raises:
            InputError: as `polygon`.
        """
        return cls(name, "venue", closed_outline(name, points), 0.0, margin)

    def moved(self, turned: float, by: Point) -> "Obstacle":
        """The same turned about the origin by an angle, rad, and then moved, m."""
        outline, walls = _turned(self.outline, turned, by), _turned(self.walls, turned, by)
        left = None if self.open is None else walls
        return Obstacle(self.name, self.kind, outline, self.radius, self.margin, left)

    def gated(self, way: Sequence[Point], width: float) -> "Obstacle":
        """A venue with a gate, `width` m wide, where a way from outside first crosses its edge.

        The same where it does not, or begins inside.
        """
        ring = ring_of(self.outline.tolist())
        gate = gate_in(ring, way, width)
        if gate is None:
            return self
        chain = as_table(stretch(ring, gate[1], gate[0] + length_of(ring)))
        return Obstacle(self.name, self.kind, self.outline, self.radius, self.margin, chain)


def _turned(points: FloatArray, turned: float, by: Point) -> FloatArray:
    """Points turned about the origin by an angle, rad, and then moved, m."""
    c, s = math.cos(turned), math.sin(turned)
    turns = [(c * x - s * y, s * x + c * y) for x, y in points.tolist()]
    return as_table([(x + by[0], y + by[1]) for x, y in turns])


def rectangle_outline(name: str, centre: Point, size: tuple[float, float], angle: float) -> FloatArray:
    """The corners of a rectangle in going round, m, (4, 2)."""
    [sides], [middle] = (
        _points(f"{name}: size", [size], 1).tolist(),
        _points(name, [centre], 1).tolist(),
    )
    a, b = [0.5 * checked_size(f"{name}: size", side) for side in sides]
    turned = finite(f"{name}: angle", angle)
    c, s = math.cos(turned), math.sin(turned)
    corners = [(a, b), (-a, b), (-a, -b), (a, -b)]
    ends = [(middle[0] + x * c - y * s, middle[1] + x * s + y * c) for x, y in corners]
    return _points(name, ends, 4, closed=True)


def closed_outline(name: str, points: "npt.ArrayLike | BaseGeometry") -> FloatArray:
    """The corners of a polygon, m, (P, 2); a last one that repeats the first is left out.

    Raises:
        InputError: for an invalid polygon, naming the sides that cross.
    """
    corners = _points(name, points, 3, closed=True)
    crossing = _crossing(corners)
    if crossing is not None:
        i, j = crossing
        text = _("{name}: its sides {i} and {j} cross or touch: an outline must not meet itself")
        raise InputError(text.format(name=name, i=i + 1, j=j + 1))
    ring = corners.tolist()
    ways = zip(ring, [*ring[1:], ring[0]], strict=True)
    area = 0.5 * abs(sum(x * (to_y - y) - y * (to_x - x) for (x, y), (to_x, to_y) in ways))
    if area < LEAST_SIDE * LEAST_SIDE:
        raise InputError(_("{name}: it has no area").format(name=name))
    return corners


def _points(
    name: str, points: "npt.ArrayLike | BaseGeometry", least: int, *, closed: bool = False
) -> FloatArray:
    """Points as an array, (P, 2); repeated ones refused, except a closed outline's last."""
    table = as_numbers(f"{name}: points", _drawn_points(name, points)).tolist()
    if np.shape(table)[1:] != (2,):
        text = _("{name}: expected a list of points [x, y], not {value}")
        raise InputError(text.format(name=name, value=brief(points)))
    if not all(abs(value) <= MOST_METRES for point in table for value in point):
        raise InputError(_("{name}: points must lie within 1e8 m of the origin").format(name=name))
    if closed and len(table) > 1 and table[0] == table[-1]:
        table = table[:-1]
    if not least <= len(table) <= MOST_CORNERS:
        text = _("{name}: expected {least} to {most} points, not {count}")
        raise InputError(text.format(name=name, least=least, most=MOST_CORNERS, count=len(table)))
    ahead = [*table[1:], table[0]] if closed else table[1:]
    for i, (one, other) in enumerate(zip(table, ahead, strict=False), start=1):
        if math.dist(one, other) < LEAST_SIDE:
            text = _("{name}: points {i} and {j} are the same")
            raise InputError(text.format(name=name, i=i, j=i % len(table) + 1))
    return as_table(table)


def _drawn_points(name: str, points: Any) -> Any:
    """The points of a polygon or a line of shapely; anything else as it is.

    Raises:
        InputError: for a polygon with holes, and shapes of several parts.
    """
    if not hasattr(points, "geom_type"):
        return points
    if points.geom_type not in ("Polygon", "LineString", "LinearRing") or len(
        getattr(points, "interiors", ())
    ):
        text = _("{name}: expected a polygon without holes, or a line, not {value}")
        raise InputError(text.format(name=name, value=brief(points)))
    return np.asarray(getattr(points, "exterior", points).coords)[:, :2]


def _crossing(corners: FloatArray) -> tuple[int, int] | None:
    """Two sides of a closed outline that meet though they are no neighbours; None if none do."""
    import shapely  # only outlines need it

    ends = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
    sides = np.array([shapely.LineString(side) for side in ends])
    first, second = shapely.STRtree(sides).query(sides, predicate="intersects")
    apart = (second - first) % len(sides)
    meet = (first < second) & (apart != 1) & (apart != len(sides) - 1)
    back = _folds_back(ends)
    if back is not None:
        return back
    if not meet.any():
        return None
    n = int(np.argmax(meet))
    return int(first[n]), int(second[n])


def _folds_back(ends: FloatArray) -> tuple[int, int] | None:
    """Two neighbouring sides of which the second runs back along the first."""
    ways = ends[:, 1] - ends[:, 0]
    onward = np.roll(ways, -1, axis=0)
    cross = ways[:, 0] * onward[:, 1] - ways[:, 1] * onward[:, 0]
    back = (cross == 0.0) & ((ways * onward).sum(axis=1) < 0.0)
    if not back.any():
        return None
    n = int(np.argmax(back))
    return n, (n + 1) % len(ends)
