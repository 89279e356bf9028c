"""Marks on the ground along a route, and the lengths by which a peg and a tape find each of them.

Two base points stand as far from the peg as the farthest mark, at right angles; each mark lies where
its lengths from the peg and from one of them meet. None rests on another mark, so that errors do not
add up; the length from the mark before it is a check.
"""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, Self

import numpy as np

from benchdragon import budget
from benchdragon.analysis.ground import Ground
from benchdragon.errors import InputError, as_number, brief, finite, in_order, of_kind
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.marks import SAME_MARK, lay_marks
from benchdragon.model.base_curve import Point
from benchdragon.model.curves import Route
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.plans.chalk import LEAST_EVERY

# Marks of one plan.
MOST_MARKS = 5_000
# Rounding of lengths, m, and of angles, degrees.
LENGTH_STEP, ANGLE_STEP = 0.005, 0.01
# Marks farther apart than this, in usual distances, have others of an earlier round between them.
FARTHEST = 1.5
# A place nearer to a mark along the line, m, is at it.
AT_MARK = 0.01
# As far as that, m, the peg may be from the nearest mark.
LONGEST_TAPE = 200.0
Kind = Literal["step", "joint", "end", "start"]
# In the order of kernels/marks.py.
KINDS: tuple[Kind, ...] = ("step", "joint", "end", "start")


@dataclass(frozen=True)
class Trail:
    """What the dragon covers of its route, and where marks on it have a meaning.

    Attributes:
        route: the whole of it.
        low: where the tail's last handle stands at first, m along the route.
        start: where the head's first handle stands then, m along the route.
        high: where that comes to, m along the route.

    Examples:
        >>> walk = bd.read_plan("spiral-in", {"dragon.benches": 5}).build()
        >>> trail = bd.Trail.of(walk, 0.0, 10.0)
        >>> trail.start, trail.high
        (0.0, 10.0)
    """

    route: Route
    low: float
    start: float
    high: float

    @classmethod
    def of(cls, walk: Walk, start: float, end: float) -> Self:
        """The trail of a walk from one time to another, s.

        Raises:
            InputError: if `walk` is not a Walk, or the end comes before the start.
            WalkError: if the dragon cannot stand at the start.
        """
        of_kind("walk", walk, Walk)
        in_order(start, end)
        head, last = walk.head_position([start, end]).tolist()
        tail = walk.motion([start]).s[0, -1]
        return cls(walk.route, float(tail), head, min(last, walk.route.length))

    @property
    def usual_every(self) -> float:
        """How far apart marks usually are: 1 m, or as many decimetres more as MOST_MARKS requires."""
        return max(1.0, _least_every(self.high - self.low))

    def every(self, said: float | None) -> float:
        """How far apart marks are, m: as a plan says, or as they usually are."""
        return self.usual_every if said is None else said

    def marked(self, every: float) -> tuple[FloatArray, list[Kind]]:
        """Positions of the marks along the route, m, ascending, and what each is for.

        From the start of the head each way, joints and ends besides. Of two that are CLOSE together
        one is kept. Where a closed line is walked again, the marks of the first round serve again;
        start and ends are always marked.

        Raises:
            InputError: for marks that are too near, or too many.
        """
        check_every(every)
        _check_count(every, self.high - self.low)
        rows, span = self.route.rows, self.high - self.low
        room = math.ceil(span / every) + len(rows) + 4
        s, kinds = np.empty(room), np.empty(room, dtype=np.int64)
        lags = np.empty(2 * len(rows))
        count = lay_marks(rows, self.low, self.start, self.high, every, lags, s, kinds)
        return s[:count], [KINDS[kind] for kind in kinds[:count].tolist()]


def check_every(every: float) -> None:
    """Refuse a distance between marks that is less than LEAST_EVERY, m.

    Raises:
        InputError: then.
    """
    if not LEAST_EVERY <= every < math.inf:
        raise InputError(
            _("marks must be at least {least} m apart, not {value} m").format(
                least=f"{LEAST_EVERY:g}", value=f"{every:g}"
            )
        )


def _least_every(length: float) -> float:
    """The least distance between marks, m, in decimetres, of which a length, m, has not too many."""
    return math.ceil(10.0 * length / MOST_MARKS) / 10.0


def _check_count(every: float, length: float) -> None:
    if length / every > MOST_MARKS:
        raise InputError(
            _(
                "marks each {every} m on {length} m of route are more than {most}: ask for at least "
                "{needed} m between them"
            ).format(
                every=f"{every:g}",
                length=f"{length:.1f}",
                most=MOST_MARKS,
                needed=f"{_least_every(length):g}",
            )
        )


@dataclass(frozen=True)
class Marks:
    """Marks and how to find them.

    Attributes:
        s: along the route, m, (M,); the first is 0 m of the cumulative length.
        points: exact places, m, (M, 2).
        kinds: what each is for, (M,).
        ground: the peg and the base line that they are measured from.
        bases: the base points, m, (2, 2), as far from the peg as `reach`.
        reach: m.

    Examples:
        >>> walk = bd.read_plan("spiral-in", {"dragon.benches": 5}).build()
        >>> marks = bd.placed_marks(bd.Trail.of(walk, 0.0, 10.0), 1.0, (0.0, 0.0))
        >>> marks.points.shape[1]
        2
    """

    s: FloatArray
    points: FloatArray
    kinds: tuple[Kind, ...]
    ground: Ground
    bases: FloatArray
    reach: float

    def __len__(self) -> int:
        """Number of marks."""
        return len(self.s)

    @property
    def peg(self) -> Point:
        """Where the peg stands, m."""
        return self.ground.peg

    @property
    def north(self) -> bool:
        """Whether y points north, so that angles are bearings; else they are from the x axis."""
        return self.ground.north

    @cached_property
    def way(self) -> FloatArray:
        """From the first mark along the route, m, (M,)."""
        way: FloatArray = self.s - self.s[0]
        return way

    @cached_property
    def usual(self) -> float:
        """The usual distance between marks along the route, m."""
        return usual_gap(self.s.tolist())

    @cached_property
    def offsets(self) -> FloatArray:
        """From the peg along the base line and to its left, m, (M, 2)."""
        return self.ground.seen(self.points)

    @cached_property
    def arms(self) -> FloatArray:
        """The base points as `offsets`, m, (2, 2)."""
        return self.ground.seen(self.bases)

    @cached_property
    def radius(self) -> FloatArray:
        """From the peg, m, (M,)."""
        return as_lengths(self.offsets)

    @cached_property
    def angle(self) -> FloatArray:
        """As `angles_of`, at the peg, (M,)."""
        return angles_of(self.offsets, north=self.north)

    @cached_property
    def before(self) -> FloatArray:
        """Straight from the mark before, m, (M,); 0 for the first."""
        apart = np.diff(self.points, axis=0, prepend=self.points[:1])
        return as_lengths(apart)

    @cached_property
    def from_base(self) -> FloatArray:
        """Straight from each base point, m, (M, 2)."""
        apart = self.points[:, None] - self.bases
        return as_lengths(apart)

    @cached_property
    def errors(self) -> FloatArray:
        """Greatest error of places by rounded lengths from the peg and each base point, m, (M, 2).

        To first order: two lengths with errors e at a right angle give an error of √2 e, and a larger
        one the closer they are to parallel.
        """
        to_peg, to_base = -self.offsets[:, None], self.arms - self.offsets[:, None]
        long = as_lengths(to_peg) * self.from_base
        cross = to_peg[..., 0] * to_base[..., 1] - to_peg[..., 1] * to_base[..., 0]
        dot = (to_peg * to_base).sum(axis=-1)
        with np.errstate(divide="ignore", invalid="ignore"):
            sine, cosine = np.abs(cross / long), np.abs(dot / long)
            error = 0.5 * LENGTH_STEP * np.sqrt(2.0 * (1.0 + cosine)) / sine
        found: FloatArray = np.where(np.isnan(error), 0.5 * LENGTH_STEP, error)
        return found

    @cached_property
    def base(self) -> list[int]:
        """From which base point each mark is measured: that which errs less, 0 or 1."""
        chosen: list[int] = np.argmin(self.errors, axis=1).tolist()
        return chosen

    @cached_property
    def cross(self) -> FloatArray:
        """From that base point, m, (M,)."""
        cross: FloatArray = self.from_base[np.arange(len(self)), self.base]
        return cross

    @property
    def on_left(self) -> list[bool]:
        """Whether each mark is on the left of who looks from the peg to its base point, (M,)."""
        arms = self.arms[self.base]
        left: list[bool] = (
            arms[:, 0] * self.offsets[:, 1] - arms[:, 1] * self.offsets[:, 0] > 0.0
        ).tolist()
        return left

    @property
    def tape_error(self) -> float:
        """The greatest that rounding the lengths from peg and base points makes, m."""
        return float(self.errors.min(axis=1).max())

    @property
    def angle_error(self) -> float:
        """The greatest that rounding radii and angles makes, m."""
        return math.hypot(0.5 * LENGTH_STEP, math.radians(0.5 * ANGLE_STEP) * float(self.radius.max()))

    @property
    def grid_error(self) -> float:
        """The greatest that rounding x and y makes, m."""
        return math.sqrt(0.5) * LENGTH_STEP


def as_lengths(vectors: FloatArray) -> FloatArray:
    """Lengths of vectors, (..., 2), m."""
    long: FloatArray = np.hypot(vectors[..., 0], vectors[..., 1])
    return long


def angles_of(off: FloatArray, *, north: bool) -> FloatArray:
    """Directions of (n, 2) as degrees from 0 to 360.

    Clockwise from y, which is north; or counter-clockwise from x.
    """
    x, y = off.T
    turned = np.arctan2(x, y) if north else np.arctan2(y, x)
    degrees: FloatArray = np.degrees(turned) % 360.0
    return degrees


def rounded(value: float, step: float) -> float:
    """The multiple of `step` nearest to a value."""
    return round(round(value / step) * step, 6)


@budget.question()
def placed_marks(
    trail: Trail, every: float, peg: Point | Ground, *, obstacles: tuple[Obstacle, ...] = ()
) -> Marks:
    """The marks of a trail.

    Args:
        trail: where the dragon goes.
        every: m between marks along the route.
        peg: where the peg stands, m, so that the base line runs along x; or peg and base line.
        obstacles: where no base point should be; the venue's edge, within which they should.

    Raises:
        InputError: if `trail` is not a Trail, the peg is no point or too far away, and as
            `Trail.marked`.

    Examples:
        >>> walk = bd.read_plan("spiral-in", {"dragon.benches": 5}).build()
        >>> marks = bd.placed_marks(bd.Trail.of(walk, 0.0, 10.0), 1.0, (0.0, 0.0))
        >>> marks.kinds[-1]
        'end'
    """
    of_kind("trail", trail, Trail, "Trail.of(walk, start, end) makes one")
    check_every(as_number("every", every))
    ground = peg if isinstance(peg, Ground) else Ground(_peg(peg))
    s, kinds = trail.marked(every)
    points = trail.route.point(s)
    far = _farthest(points, ground.peg)
    reach, bases = _bases(ground, max(1, math.ceil(far)), obstacles)
    return Marks(s, points, tuple(kinds), ground, bases, reach)


def between(marks: Marks, s: float) -> tuple[int, float] | None:
    """The mark that a place along the route, m, is at or behind: its number, from 1, and how far, m.

    None where the marks about it are not its neighbours on the ground: where a closed line is walked
    again, it has those of the first round.
    """
    return among(marks.s, marks.usual, s)


def among(places: FloatArray | Sequence[float], usual: float, s: float) -> tuple[int, float] | None:
    """The same of marks at these places along the route, m, most of them `usual` apart, m."""
    last = len(places) - 1
    n = min(max(int(np.searchsorted(places, s + SAME_MARK, side="right")) - 1, 0), last)
    past = rounded(s - places[n], 0.01)
    if abs(past) < AT_MARK:
        return n + 1, 0.0
    gap = places[n + 1] - places[n] if n < last else 0.0
    if n < last and places[n + 1] - s < AT_MARK:
        return n + 2, 0.0
    return None if past < 0.0 or gap > FARTHEST * usual else (n + 1, past)


def usual_gap(places: Sequence[float]) -> float:
    """The usual distance of marks at these places along the route, m: the median, m; 0 for one mark."""
    gaps = sorted(b - a for a, b in itertools.pairwise(places)) or [0.0]
    half = len(gaps) // 2
    return gaps[half] if len(gaps) % 2 else 0.5 * (gaps[half - 1] + gaps[half])


def nearest_mark(marks: Marks, point: Point) -> tuple[int, float]:
    """The mark that is nearest to a place, m: its number, from 1, and how far it is, m."""
    away = as_lengths(marks.points - np.array(point))
    n = int(np.argmin(away))
    return n + 1, float(away[n])


def check_marks(trail: Trail, every: float, peg: Point) -> None:
    """Refuse marks of a trail that are too many, and a peg from which no tape reaches any of them."""
    _farthest(trail.route.point(trail.marked(every)[0]), _peg(peg))


def _farthest(points: FloatArray, peg: Point) -> float:
    """How far the farthest of marks is from the peg, m, if a tape reaches the nearest."""
    away = as_lengths(points - np.array(peg))
    if away.min() > LONGEST_TAPE:
        text = _("the peg is {far} m from the nearest mark, farther than {most} m: no tape reaches it")
        raise InputError(text.format(far=f"{away.min():.0f}", most=f"{LONGEST_TAPE:g}"))
    return float(away.max())


def _peg(peg: Point) -> Point:
    """The peg as a point, m, if it is one."""
    try:
        x, y = peg
    except (TypeError, ValueError):
        text = _("peg must be a pair (x, y), not {value}")
        raise InputError(text.format(value=brief(peg))) from None
    return finite("peg x", x, "m"), finite("peg y", y, "m")


def _bases(ground: Ground, most: int, obstacles: tuple[Obstacle, ...]) -> tuple[float, FloatArray]:
    """How far from the peg both base points can stand, whole m, and where, m of the plan, (2, 2).

    As far as possible up to `most`, the first of them along the base line or at the next right angles
    to it; obstacles are ignored if no place has a metre.
    """
    ways, first = np.concatenate([ground.ways, ground.ways]), 1 if ground.north else 0
    for reach in range(most, 0, -1):
        for quarter in range(first, first + 4):
            bases = np.array(ground.peg) + reach * ways[quarter : quarter + 2]
            if not any(one.forbids(bases).any() for one in obstacles):
                return reach, bases
    return most, np.array(ground.peg) + most * ways[first : first + 2]
