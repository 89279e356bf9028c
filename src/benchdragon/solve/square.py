"""A dance on its square: how much room it has at any pose, and the pose with the most.

What the dance and its people cover is boxes, laid closely along the benches' ways. A move of the dance
moves all of them as one body.
"""

import itertools
import math
from collections.abc import Sequence
from functools import cached_property
from typing import Protocol

import numpy as np

from benchdragon.analysis.not_looked_at import places
from benchdragon.analysis.room import with_all_room
from benchdragon.analysis.tables import kinds_of
from benchdragon.errors import InputError, UnsureError
from benchdragon.i18n import _
from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.pose_clearance import (
    GROUP,
    Circle,
    bound_groups,
    extent,
    lay_boxes,
    pose_clearance,
    smallest_circle,
)
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress

# Boxes lie so far apart along the route, m, and are so many at most; a corner between two of them is
# farther out by no more than a quarter of that.
STEP, MOST_BOXES = 0.1, 20_000
# Poses are rounded to so many decimals of a metre and of a degree: benches cannot be placed more
# accurately.
DIGITS = 3
# Root of y^4 = y + 1: the fractions of multiples of its powers, upside down, spread points evenly in
# three dimensions.
SPREAD = 1.2207440846057595
# Sample poses, the best of them that are refined, and the least distance of those, as a share of the
# ranges.
STREWN, STARTS, APART = 600, 4, 0.1
# First steps of a descent as a share of the ranges, its shortest as a share of these, and trials.
EDGE, SHORTEST, TRIALS = 0.02, 0.01, 600
# Of poses with equal room that nearer to the middle of the square is better: by so much for each metre.
PULL = 1e-4
# The ways of a descent: all that change some of x, y and the angle by a step.
WAYS = [way for way in itertools.product((-1.0, 0.0, 1.0), repeat=3) if any(way)]

# The middle of what a dance covers, x and y, m, and how far it is turned to the left, degrees.
Pose = Sequence[float]


class Crowded(Protocol):
    """Where a dance has more room or less."""

    def crowding(self, pose: Pose) -> float:
        """How much room it lacks at a pose, m; negative where it has more than it needs."""


class Square:
    """Where a dance may be placed, and how much room it has there.

    A street that leads to it stays where it is: only the dance is placed.

    Args:
        plan: with the dance at its origin, not turned.
        step: between boxes along the route, m.

    Raises:
        InputError: for a plan without a venue.
    """

    def __init__(self, plan: Plan, step: float = STEP) -> None:
        self.plan, self._danced = plan, plan.without_street()
        self.walk, self.obstacles = with_all_room(self._danced)
        if not self.obstacles or self.venue.kind != "venue":
            raise InputError(_("the plan has no venue to be placed in: add [venue]"))
        self.step = step
        self.evaluations = 0

    @property
    def venue(self) -> Obstacle:
        """The edge."""
        return self.obstacles[0]

    @cached_property
    def boxes(self) -> FloatArray:
        """What the dance and its people cover at its origin, and a row of scratch."""
        return laid_boxes(self.walk, self._danced.span(self.walk), self.step)

    @cached_property
    def circles(self) -> FloatArray:
        """Circles about groups of neighbouring boxes."""
        found = np.empty((math.ceil((self.boxes.shape[0] - 1) / GROUP), Circle.RADIUS + 1))
        bound_groups(self.boxes, found)
        return found

    @cached_property
    def _standing(self) -> list[tuple[FloatArray, FloatArray, Obstacle]]:
        """The sides and the corners of each obstacle and of the edge, and these themselves."""
        return [(one.boxes, np.array(one.outline.tolist()), one) for one in self.obstacles]

    @cached_property
    def middle(self) -> tuple[float, float]:
        """The middle of what the dance covers, m."""
        low_x, high_x, low_y, high_y = self.extent(0.0)
        return 0.5 * (low_x + high_x), 0.5 * (low_y + high_y)

    def extent(self, turned: float) -> list[float]:
        """From where to where the dance reaches along x, then y, turned by so many degrees, m."""
        out = np.empty(4)
        extent(self.boxes, math.radians(turned), out)
        found: list[float] = out.tolist()
        return found

    def circle(self) -> list[float]:
        """Centre and radius of the smallest circle about the dance, m."""
        out = np.empty(3)
        smallest_circle(self.boxes, out)
        found: list[float] = out.tolist()
        return found

    def at(self, pose: Pose) -> Plan:
        """The plan with its dance at a pose, rounded."""
        x, y, turned = self.placed(pose)
        return self.plan.with_values({"route.at": [x, y], "route.turned": turned})

    def placed(self, pose: Pose) -> tuple[float, float, float]:
        """A pose as a plan gives it: route.at, m, and route.turned, degrees, rounded."""
        x, y, turned = pose
        c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
        a, b = self.middle
        # + 0.0 makes -0.0 a 0.0
        at = round(x - c * a + s * b, DIGITS) + 0.0, round(y - s * a - c * b, DIGITS) + 0.0
        return at[0], at[1], round(turned % 360.0, DIGITS) % 360.0

    def room(self, pose: Pose) -> float:
        """How much more than its margin the dance keeps from what is nearest, m; negative inside."""
        self.evaluations += 1
        x, y, turned = self.placed(pose)
        room = math.inf
        for sides, outline, one in self._standing:
            apart = pose_clearance(
                self.boxes, self.circles, sides, one.sort, outline, one.radius, x, y,
                math.radians(turned), room + one.margin,
            )  # fmt: skip
            room = min(room, apart - one.margin)
        return room

    def roomiest(self, progress: Progress) -> list[float]:
        """The pose with the most room, by descent from the best sample poses on the square."""
        low, size = self._ranges
        shares = [[(0.5 + n / SPREAD ** (k + 1.0)) % 1.0 for k in range(3)] for n in range(STREWN)]
        poses = [[low[k] + size[k] * share[k] for k in range(3)] for share in shares]
        crowded = []
        for n, pose in enumerate(poses):
            crowded.append(self.crowding(pose))
            progress(0.5 * (n + 1) / STREWN, "")
        starts: list[int] = []
        for n in sorted(range(STREWN), key=lambda n: (crowded[n], n)):
            far = [max(abs(shares[n][k] - shares[m][k]) for k in range(3)) for m in starts]
            if len(starts) < STARTS and min([1.0, *far]) > APART:
                starts.append(n)
        steps = [EDGE * one for one in size]
        ends = []
        for n in starts:
            ends.append(descended(self, poses[n], steps))
            progress(0.5 + 0.5 * len(ends) / len(starts), "")
        return min(ends)[1]

    def crowding(self, pose: Pose) -> float:
        """Minus the room, m, and PULL for each metre from the middle of the square."""
        low, size = self._ranges
        away = [pose[k] - low[k] - 0.5 * size[k] for k in range(2)]
        return PULL * math.hypot(away[0], away[1]) - self.room(pose)

    @cached_property
    def _ranges(self) -> tuple[list[float], list[float]]:
        """The least of x, y and the angle, and how far each ranges."""
        xs, ys = ([corner[k] for corner in self.venue.outline.tolist()] for k in (0, 1))
        return [min(xs), min(ys), 0.0], [max(xs) - min(xs), max(ys) - min(ys), 360.0]


def descended(
    crowded: Crowded, pose: Pose, steps: Sequence[float], trials: int = TRIALS
) -> tuple[float, list[float]]:
    """The least crowding downhill from a pose, and where: steps are halved where none goes down.

    Compass search (Kolda, Lewis and Torczon, 2003) over all sign vectors, the last good one first.
    """
    low, share, ways, tried = crowded.crowding(pose), 1.0, list(WAYS), 1
    best = list(pose)
    while share > SHORTEST and tried < trials:
        better = None
        for way in ways:
            there = [best[k] + share * steps[k] * way[k] for k in range(3)]
            found = crowded.crowding(there)
            tried += 1
            if found < low:
                low, best, better = found, there, way
                break
        if better is None:
            share *= 0.5
        else:
            ways = [better, *(way for way in ways if way != better)]
    return low, best


def laid_boxes(walk: Walk, span: tuple[float, float], step: float) -> FloatArray:
    """Boxes of all that benches cover over a span, s, each `step` m of the route; and a row of scratch.

    Raises:
        WalkError: where the dragon cannot stand.
        UnsureError: where a bench alone finds no place.
    """
    kind, kinds = kinds_of(walk.dragon.sizes)
    ways = list(zip(*(one[:-1] for one in places(walk, *span)), strict=True))
    numbers = kind.tolist()
    stretches = [
        _merged([way for way, number in zip(ways, numbers, strict=True) if number == k])
        for k in range(kinds.sizes.shape[1])
    ]
    long = sum(high - low for some in stretches for low, high in some)
    step = max(step, long / MOST_BOXES)
    fronts = [[s for low, high in some for s in _steps(low, high, step)] for some in stretches]
    boxes = np.zeros((sum(map(len, fronts)) + 1, BOX_COLUMNS))
    first = 0
    for k, at in enumerate(fronts):
        length, _width, front, rear = (row[k] for row in kinds.sizes.tolist())
        scratch = empty_placements(2, len(at))
        link = np.array([length - front - rear])
        if not lay_boxes(walk.route.rows, link, kinds.sizes, k, np.array(at), scratch, first, boxes):
            raise walk.first_failure(walk.head_position(span)) or UnsureError(
                _("a bench finds no place somewhere on its way: use gentler bends or shorter benches")
            )
        first += len(at)
    return boxes


def _merged(spans: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """The union of spans (from, to) as spans that are apart, ascending."""
    found: list[tuple[float, float]] = []
    for low, high in sorted(spans):
        if found and low <= found[-1][1]:
            found[-1] = found[-1][0], max(found[-1][1], high)
        else:
            found.append((low, high))
    return found


def _steps(low: float, high: float, step: float) -> list[float]:
    """Positions from one to another, both included, at most `step` apart."""
    count = max(1, math.ceil((high - low) / step))
    return [low + (high - low) * n / count for n in range(count + 1)]
