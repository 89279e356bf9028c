"""The ground that a dance covers: a polygon with a bound on its error, what holds it, its widest place.

The convex hull of each step of a bench (swept_steps.py) contains the bench up to a distance `stray`,
and nothing farther than `fill` from it. The polygon is the union of the hulls, widened by the greatest
stray: motion bounds guarantee that it contains everything, not samples.
"""

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt
import shapely
from shapely.geometry.base import BaseGeometry

from benchdragon import budget
from benchdragon.analysis.asked import asked_of
from benchdragon.analysis.swept_steps import Steps, walked_steps
from benchdragon.analysis.swept_width import Widest, widest_place
from benchdragon.errors import InputError, UnsureError, WalkError, finite, in_order, not_negative
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.methods import Method
from benchdragon.model.answer import Answer
from benchdragon.model.base_curve import Point
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, part, silent

if TYPE_CHECKING:
    from benchdragon.figures import plots

# The error that may be asked for, m, and what is taken unless one is.
LEAST_ERROR, MOST_ERROR, ERROR = 1e-4, 1.0, 0.01
MOST_MARGIN = 1e3
# Error of the ground in pictures, m: it would not be seen finer.
DRAWN = 0.05
# Hulls that are joined at a time: neighbours along the route overlap much.
GROUP = 48
# Of the error, what corners may be smoothed by; an end of a ring may be smoothed twice.
SMOOTHED_SHARE, SMOOTHED_TWICE = 0.04, 2.0
# Segments of a quarter circle in what is widened, by so much more that no chord cuts in; and how far it
# may reach then.
QUARTER, WIDENED, REACHED = 64, 1.0002, 1.005

# A polygon, or several.
Shape = BaseGeometry


class Rings(NamedTuple):
    """Closed lines, m, (n, 2) each, the last point the first: around the outside, and around holes.

    Examples:
        >>> area = bd.read_plan("spiral-in", {"dragon.benches": 5}).swept_area(0.0, 10.0)
        >>> len(area.outlines.outer), len(area.outlines.holes)
        (1, 0)
    """

    outer: tuple[FloatArray, ...]
    holes: tuple[FloatArray, ...]


@dataclass(frozen=True)
class BoundingRectangle:
    """The smallest rectangle, at any angle, that holds an area.

    Attributes:
        corners: in going round, m, (4, 2); it holds all that is covered.
        width: its longer side, m.
        height: its shorter side, m.
        angle: of the longer side to the x axis, rad, 0 to pi.
        area: m2, with a bracket for what the smallest one that holds the ground covered has.

    Examples:
        >>> held = bd.read_plan("spiral-in", {"dragon.benches": 5}).enclosing(0.0, 10.0)
        >>> held.rectangle.width >= held.rectangle.height
        True
    """

    corners: FloatArray
    width: float
    height: float
    angle: float
    area: Answer


@dataclass(frozen=True)
class BoundingCircle:
    """The smallest circle that holds an area.

    Attributes:
        centre: m.
        radius: m; the circle of its upper end holds all that is covered.

    Examples:
        >>> held = bd.read_plan("spiral-in", {"dragon.benches": 5}).enclosing(0.0, 10.0)
        >>> round(held.circle.radius.value, 2)
        8.15
    """

    centre: Point
    radius: Answer


class Enclosing(NamedTuple):
    """What holds a whole dance, tail included.

    Examples:
        >>> held = bd.read_plan("spiral-in", {"dragon.benches": 5}).enclosing(0.0, 10.0)
        >>> sorted(held._fields)
        ['circle', 'rectangle']
    """

    rectangle: BoundingRectangle
    circle: BoundingCircle


@dataclass(frozen=True, eq=False)
class SweptArea:
    """The ground that benches cover.

    Attributes:
        walk: what was walked.
        start: s.
        end: s.
        margin: how far spectators keep from it, m.
        polygon: contains all that any bench covers from start to end, m.
        error: m; nothing of the polygon is farther from what is covered.
        steps: what it is made of.

    Examples:
        >>> plan = bd.read_plan("spiral-in", {"dragon.benches": 5})
        >>> area = plan.swept_area(0.0, 10.0, margin=1.0)
        >>> area.error <= 0.02, area.spectators.area > area.area
        (True, True)
    """

    walk: Walk
    start: float
    end: float
    margin: float
    polygon: Shape
    error: float
    steps: Steps = field(repr=False)

    plot = plots.plot_area if TYPE_CHECKING else Method("plot_area")

    @property
    def area(self) -> float:
        """Of the polygon, m2: not less than what is covered."""
        return float(self.polygon.area)

    @cached_property
    def spectators(self) -> Shape:
        """The polygon widened by the margin: outside it, all is farther than that from what is covered.

        Nothing of it is farther than REACHED times the margin from the polygon.
        """
        return _widened(self.polygon, self.margin) if self.margin else self.polygon

    @property
    def outlines(self) -> Rings:
        """The outlines of the polygon, those around holes apart."""
        return rings(self.polygon)

    @property
    def lines(self) -> Rings:
        """The spectators' lines, those within holes apart."""
        return rings(self.spectators)

    @cached_property
    def widest(self) -> Widest:
        """Where the band along the route is widest, across the route."""
        return widest_place(self.walk, self.steps)

    @cached_property
    def enclosing(self) -> Enclosing:
        """The smallest rectangle and the smallest circle that hold it."""
        hull = shapely.convex_hull(self.polygon)
        return Enclosing(_rectangle(hull, self.error), _circle(hull, self.error))


@budget.question()
def swept_area(
    walk: Walk | Plan, start: float | None = None, end: float | None = None, *,
    margin: float = 0.0, error: float = ERROR, progress: Progress = silent,
) -> SweptArea:  # fmt: skip
    """The ground that benches cover from start to end, s, both included.

    Args:
        walk: of which walk, or plan.
        start: s; None: where it starts.
        end: s; None: where it ends. The same as start for one instant.
        margin: how far spectators keep from it, m, 0 to 1000.
        error: of the polygon, m, 0.0001 to 1: see `SweptArea`.
        progress: is called with the share done.

    Raises:
        InputError: for times, a margin or an error that cannot be; if the area takes more than
            `swept_steps.MOST_STEPS` steps.
        WalkError: where the dragon cannot stand.
        UnsureError: where it is not sure that a bench follows its route without a leap.

    Examples:
        >>> plan = bd.read_plan("spiral-in", {"dragon.benches": 5})
        >>> area = bd.swept_area(plan, 0.0, 10.0, margin=1.0)
        >>> round(area.area)
        9
    """
    walk, start, end = asked_of(walk, start, end)
    in_order(start, end)
    if not_negative("margin", margin, "m") > MOST_MARGIN:
        raise InputError(_("margin must be at most 1000 m, not {value} m").format(value=f"{margin:g}"))
    if not LEAST_ERROR <= finite("error", error, "m") <= MOST_ERROR:
        text = _("error must be from {least} to {most} m, not {value} m")
        raise InputError(
            text.format(least=f"{LEAST_ERROR:g}", most=f"{MOST_ERROR:g}", value=f"{error:g}")
        )
    progress(0.0, _("following the benches"))
    steps = walked_steps(walk, start, end, error)
    joined = _joined(steps, part(progress, 0.3, 1.0, _("joining what they cover")))
    smoothing = SMOOTHED_SHARE * error
    least = steps.widest_stray + SMOOTHED_TWICE * smoothing
    polygon = _widened(shapely.simplify(joined, smoothing), least)
    bound = steps.needless + SMOOTHED_TWICE * smoothing + REACHED * least
    return SweptArea(walk, start, end, margin, polygon, bound, steps)


@budget.question()
def enclosing(
    walk: Walk | Plan, start: float | None = None, end: float | None = None, *,
    error: float = ERROR, progress: Progress = silent,
) -> Enclosing:  # fmt: skip
    """The smallest rectangle, at any angle, and circle that hold all benches from start to end, s.

    Of a plan or a walk: over the whole of it unless start and end are given.

    Raises:
        InputError, WalkError, UnsureError: as `swept_area`.

    Examples:
        >>> held = bd.enclosing(bd.read_plan("spiral-in", {"dragon.benches": 5}), 0.0, 10.0)
        >>> held.rectangle.corners.shape
        (4, 2)
    """
    return swept_area(walk, start, end, error=error, progress=progress).enclosing


def rings(shape: Shape) -> Rings:
    """The outlines of an area, those around holes apart."""
    parts = shapely.get_parts(shape)
    return Rings(
        tuple(np.asarray(part.exterior.coords) for part in parts),
        tuple(np.asarray(ring.coords) for part in parts for ring in part.interiors),
    )


def drawn_ground(walk: Walk, start: float, end: float) -> tuple[FloatArray, ...]:
    """The outlines of the ground covered, as pictures show it, to DRAWN: closed lines, (n, 2) each, m.

    Those around the outside go counter-clockwise, those around holes clockwise. None where it cannot be
    computed or would take too long: `swept_area` says why.
    """
    try:
        polygon = swept_area(walk, start, end, error=DRAWN).polygon
    except (InputError, UnsureError, WalkError):
        return ()
    outlines = rings(shapely.orient_polygons(polygon))
    return (*outlines.outer, *outlines.holes)


def _joined(steps: Steps, progress: Progress) -> Shape:
    """The union of the hulls of all steps."""
    groups, count = [], len(steps.kind)
    for first in range(0, count, GROUP):
        hulls = hulls_of(steps.corners[first : first + GROUP])
        groups.append(shapely.union_all(hulls))
        progress(0.8 * first / count, "")
    joined: Shape = shapely.union_all(groups)
    progress(1.0, "")
    return joined


def hulls_of(corners: FloatArray) -> npt.NDArray[np.object_]:
    """The convex hulls of rows of points, (n, ..., 2)."""
    points = corners.reshape(len(corners), -1, 2)
    return np.asarray(shapely.convex_hull(shapely.multipoints(points)))


def _widened(shape: Shape, least: float) -> Shape:
    """All that is within `least`, m, of a shape, and nothing farther than REACHED times that."""
    wide: Shape = shapely.buffer(shape, WIDENED * least, quad_segs=QUARTER)
    return wide


def _rectangle(hull: Shape, error: float) -> BoundingRectangle:
    """The smallest rectangle about a convex polygon: it has a side along one of the polygon's.

    A rectangle about what is covered, widened by the error on all sides, holds the polygon. Its sides
    are at most as long as the covered ground is in any direction.
    """
    corners = shapely.get_coordinates(hull)
    sides = np.diff(corners, axis=0)
    angles = np.unique(np.arctan2(sides[:, 1], sides[:, 0]) % (0.5 * math.pi)).tolist()
    seen = np.ascontiguousarray(corners.T)
    along, across = min(map(_axes, angles), key=lambda axes: np.ptp(axes @ seen, axis=1).prod())
    if np.ptp(along @ seen) < np.ptp(across @ seen):
        along, across = across, -along
    axes = np.array([along, across])
    low, high = (axes @ seen).min(axis=1), (axes @ seen).max(axis=1)
    made = np.array([high, (low[0], high[1]), low, (high[0], low[1])]) @ axes
    width, height = (high - low).tolist()
    longest = 2.0 * float(shapely.minimum_bounding_radius(hull))
    area = width * height
    least = max(0.0, area - 4.0 * error * longest - 4.0 * error * error)
    angle = math.atan2(along[1], along[0]) % math.pi
    return BoundingRectangle(made, width, height, angle, Answer(area, least, area, "m2", "found"))


def _axes(angle: float) -> FloatArray:
    """Unit vectors at an angle, rad, and square to it, (2, 2)."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, s], [-s, c]])


def _circle(hull: Shape, error: float) -> BoundingCircle:
    """The smallest circle about a polygon; about what is covered it is smaller by at most the error."""
    middle = shapely.centroid(shapely.minimum_bounding_circle(hull))
    off = shapely.get_coordinates(hull) - np.array([middle.x, middle.y])
    radius, least = float(np.hypot(*off.T).max()), float(shapely.minimum_bounding_radius(hull)) - error
    return BoundingCircle(
        (middle.x, middle.y), Answer(radius, max(0.0, min(least, radius)), radius, "m", "found")
    )
