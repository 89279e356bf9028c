"""How places are measured on the ground: from a peg, along a base line and to the left of it.

All papers of a dance give places in the same way. The base line runs along the venue's longest edge, so
that a tape laid from edge to edge finds it; where the plan's survey knows north, it runs due east.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple, Self

import numpy as np

from benchdragon.i18n import N_, _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.base_curve import Point
from benchdragon.model.curves import Route
from benchdragon.plans.schema import Plan

# An edge shorter than this share of the way round the venue is one of many of a bent edge, and a base
# line turned by less than this, rad, is not turned.
LEAST_EDGE, UNTURNED = 0.15, 1e-9
# A place nearer than this to two edges, m, is at their corner.
CORNER = 1e-6
# The ways x and y point and against them, by what tells them on the ground.
NORTH = (N_("due east"), N_("due north"), N_("due west"), N_("due south"))
VENUE = (N_("to the right"), N_("forward"), N_("to the left"), N_("back"))
# Edges of the venue by the way out over them, as `NORTH` and `VENUE`.
NORTH_EDGES = (N_("eastern edge"), N_("northern edge"), N_("western edge"), N_("southern edge"))
EDGES = (N_("right edge"), N_("far edge"), N_("left edge"), N_("near edge"))
AXES = (N_("the way x points"), N_("the way y points"), N_("against x"), N_("against y"))


@dataclass(frozen=True)
class Ground:
    """Where papers measure from.

    Attributes:
        peg: where the peg stands, m of the plan.
        turned: of the base line, along which x runs, from the plan's x axis, rad.
        north: whether y points north.
        venue: whether the base line runs along the venue's edge.
    """

    peg: Point
    turned: float = 0.0
    north: bool = False
    venue: bool = False

    @classmethod
    def of(cls, plan: Plan, route: Route) -> Self:
        """That of a plan."""
        edges = [one.outline.tolist() for one in plan.obstacles() if one.kind == "venue"]
        return cls.measured(own_peg(plan, route), plan.survey.north, edges)

    @classmethod
    def measured(cls, peg: Point, north: bool, edges: Sequence[Sequence[Point]]) -> Self:
        """That of a plan with its peg there, m, and with a venue of such edges, corner by corner."""
        if north or not edges:
            return cls(peg, 0.0, north)
        return cls(peg, base_angle(edges[0]), False, True)

    @property
    def ways(self) -> tuple[Point, ...]:
        """Unit vectors of the plan: the ways x and y point, and against them."""
        c, s = math.cos(self.turned), math.sin(self.turned)
        return ((c, s), (-s, c), (-c, -s), (s, -c))

    @property
    def way_names(self) -> tuple[str, str, str, str]:
        """The same in words, in the language in use."""
        x, y, against_x, against_y = NORTH if self.north else VENUE if self.venue else AXES
        return _(x), _(y), _(against_x), _(against_y)

    def edge(self, out: Sequence[float] | FloatArray) -> int:
        """Over which edge of the venue a way leads out: to the right, forward, to the left, back."""
        along = [u * out[0] + v * out[1] for u, v in self.ways]
        return along.index(max(along))

    def edge_name(self, edge: int) -> str:
        """The name of that edge, in the language in use."""
        return _((NORTH_EDGES if self.north else EDGES)[edge])

    @property
    def y_name(self) -> str:
        """The label of an arrow along y."""
        if self.north:
            return _("N (y axis)")
        return _("forward (y)") if self.venue else _("y axis")

    @property
    def legend(self) -> str:
        """The meaning of x and y, in a sentence."""
        if self.north:
            return _("x and y are measured from the peg: x east, y north.")
        if self.venue:
            return _(
                "x and y are measured from the peg along the venue's edges: x to the right, y forward, "
                "as one sees it who stands at the near edge and faces the square; to the left and back "
                "they are negative."
            )
        return _("x and y are measured from the peg: on the drawings x to the right, y up.")

    @property
    def ways_legend(self) -> str:
        """What the ways' names mean, in a sentence; "" where they say it themselves."""
        if self.north or not self.venue:
            return ""
        return _(
            "To the right, forward, to the left and back: as one sees it who stands at the near edge "
            "and faces the square."
        )

    @property
    def y_word(self) -> str:
        """The meaning of y in a word, for small maps."""
        return _("N") if self.north else _("forward") if self.venue else "y"

    def seen(self, points: Sequence[Point] | FloatArray) -> FloatArray:
        """Places of the plan, (n, 2), as measured on the ground: x and y from the peg, m, (n, 2)."""
        off = np.asarray(points, dtype=float) - np.array(self.peg)
        found: FloatArray = off @ np.array(self.ways[:2]).T
        return found

    def seen_at(self, place: Point) -> Point:
        """One of them."""
        x, y = place[0] - self.peg[0], place[1] - self.peg[1]
        (ux, uy), (vx, vy), *_against = self.ways
        return x * ux + y * uy, x * vx + y * vy


class Side(NamedTuple):
    """A side of a venue from corner to corner, m, as seen from a place."""

    ax: float
    ay: float
    bx: float
    by: float

    def along(self) -> Point:
        """From its first corner to its second, m."""
        return self.bx - self.ax, self.by - self.ay

    def swept(self) -> float:
        """Twice the area between it and the place, m^2: positive where it goes round it to the left."""
        return self.ax * self.by - self.bx * self.ay

    def right(self) -> bool:
        """Whether it lies on the way that x points from the place; of two at a corner one does."""
        return (self.ay > 0.0) != (self.by > 0.0) and (self.swept() > 0.0) == (self.by > self.ay)

    def out(self, turned: float) -> Point:
        """The unit vector out over it, of a venue that goes round to the left (1) or right (-1)."""
        x, y = self.along()
        length = turned * math.hypot(x, y)
        return y / length, -x / length

    def apart(self) -> float:
        """How far it is from the place, m."""
        x, y = self.along()
        share = min(max(-(self.ax * x + self.ay * y) / (x * x + y * y), 0.0), 1.0)
        return math.hypot(self.ax + share * x, self.ay + share * y)

    def ahead(self, u: float, v: float) -> float | None:
        """How far it is going one way, a unit vector, m; None if it is not met."""
        x, y = self.along()
        squarely = u * y - v * x
        if squarely == 0.0:
            return None
        far, share = self.swept() / squarely, (self.ax * v - self.ay * u) / squarely
        beyond = CORNER / math.hypot(x, y)
        return far if far >= 0.0 and -beyond <= share <= 1.0 + beyond else None


def way_out(
    outline: FloatArray | Sequence[Point], place: Point, way: Sequence[float] | FloatArray | None = None
) -> tuple[float, Point] | None:
    """How far a venue's edge is from a place within it: going one way, else the nearest of it.

    Args:
        outline: of the venue, m, its corners in order.
        place: m.
        way: a unit vector.

    Returns:
        The distance, m, and the unit vector out over the side that is met, at a right angle to it; None
        from a place outside. At a corner the side is met that is crossed most squarely.
    """
    off = [(x - place[0], y - place[1]) for x, y in np.asarray(outline).tolist()]
    sides = [Side(*one, *other) for one, other in pairwise([*off, off[0]])]
    if sum(one.right() for one in sides) % 2 == 0:
        return None
    turned = math.copysign(1.0, sum(one.swept() for one in sides))
    if way is None:
        near = min(sides, key=lambda one: one.apart())
        return near.apart(), near.out(turned)
    u, v = way
    met = [(far, one.out(turned)) for one in sides if (far := one.ahead(u, v)) is not None]
    least = min(far for far, _out in met)
    there = [out for far, out in met if far <= least + CORNER]
    return least, max(there, key=lambda out: out[0] * u + out[1] * v)


def edge_lengths(ground: Ground, edges: Sequence[Point]) -> list[float] | None:
    """From the peg to a venue's edge the ways x and y point and against them, m; None from outside it.

    Args:
        ground: the peg and the base line.
        edges: the venue's outline, corner by corner, m.
    """
    lengths: list[float] = []
    for ux, uy in ground.ways:
        met: list[float] = []
        for (ax, ay), (bx, by) in zip(edges, [*edges[1:], edges[0]], strict=True):
            px, py, qx, qy = ax - ground.peg[0], ay - ground.peg[1], bx - ax, by - ay
            across = ux * qy - uy * qx
            side, other = ux * py - uy * px, ux * (py + qy) - uy * (px + qx)
            if across and (side < 0.0) != (other < 0.0):
                met.append((px * qy - py * qx) / across)
        ahead = [one for one in met if one >= 0.0]
        if len(ahead) % 2 == 0:
            return None
        lengths.append(min(ahead))
    return lengths


def peg_line(ground: Ground, edges: Sequence[Point]) -> str:
    """How far the peg is from a venue's edge each way, in the language in use; "" from outside it."""
    lengths = edge_lengths(ground, edges)
    if lengths is None:
        return ""
    first, second, third, fourth = (f"{one:.2f}" for one in lengths)
    a, b, c, d = ground.way_names
    return _(
        "From the peg to the venue's edge it is {first} m {a}, {second} m {b}, {third} m {c}, "
        "{fourth} m {d}. Find the peg's place by these lengths, and the directions with it."
    ).format(first=first, second=second, third=third, fourth=fourth, a=a, b=b, c=c, d=d)


def own_peg(plan: Plan, route: Route) -> Point:
    """Where the plan says, m; else the centre of the route's first spiral, else the route's origin."""
    if plan.chalk.peg is not None:
        return plan.chalk.peg
    return route.centre if route.centre != (0.0, 0.0) else plan.route.at or (0.0, 0.0)


def base_angle(outline: Sequence[Point]) -> float:
    """By how much the longest edge of a venue is turned from the nearer axis, rad; within ±π/4.

    0 for a bent edge, which has none that is long.
    """
    ends = zip(outline, [*outline[1:], outline[0]], strict=True)
    sides = [(c - a, d - b) for (a, b), (c, d) in ends]
    lengths = [round(math.hypot(x, y), 9) for x, y in sides]
    n = lengths.index(max(lengths))
    if lengths[n] < LEAST_EDGE * sum(lengths):
        return 0.0
    turned = math.remainder(math.atan2(sides[n][1], sides[n][0]), 0.5 * math.pi)
    return 0.0 if abs(turned) < UNTURNED else turned
