"""How places are measured on the ground: from a peg, along a base line and to the left of it.

All papers of a dance give places in the same way. The base line runs along the venue's longest edge, so
that a tape laid from edge to edge finds it; where the plan's survey knows north, it runs due east.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
import shapely

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


def way_out(
    outline: FloatArray, place: Point, way: FloatArray | None = None
) -> tuple[float, FloatArray] | None:
    """How far a venue's edge is from a place within it: going one way, else the nearest of it.

    Args:
        outline: of the venue, m, (n, 2).
        place: m.
        way: a unit vector, (2,).

    Returns:
        The distance, m, and the unit vector out over the side that is met, at a right angle to it; None
        from a place outside.
    """
    here, venue = shapely.Point(place), shapely.Polygon(outline)
    if not venue.contains(here):
        return None
    sides = np.roll(outline, -1, axis=0) - outline
    outs = np.column_stack([sides[:, 1], -sides[:, 0]]) / np.hypot(*sides.T)[:, np.newaxis]
    outs = outs if venue.exterior.is_ccw else -outs
    lines = shapely.linestrings(np.stack([outline, outline + sides], axis=1))
    if way is None:
        apart = shapely.distance(lines, here)
        return float(apart.min()), outs[int(np.argmin(apart))]
    start, longer = np.array(place), venue.length * way  # than any way out
    met = here.distance(shapely.LineString([start, start + longer]).intersection(venue.exterior))
    # At a corner, or along an edge, it is left over the side that it crosses most squarely.
    there = shapely.Point(start + met * way)
    crossed = np.where(shapely.distance(lines, there) <= CORNER, outs @ way, -1.0)
    return met, outs[int(np.argmax(crossed))]


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
