"""Where on the square a dance fits best: farthest from the venue's edge and from every obstacle.

What the dance and its people cover is drawn once, as a region of the plane; moving the dance moves
the region. A global search uses distances of the region, a local one the exact least distances
(analysis/obstacles.py), which the answer gives. The result is checked as any plan is.
"""

import math
import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from benchdragon import budget
from benchdragon.analysis.check import Report, check, sentence
from benchdragon.analysis.obstacles import ObstacleAnswers, obstacle_answers
from benchdragon.analysis.room import with_all_room
from benchdragon.analysis.swept import enclosing, swept_area
from benchdragon.errors import InputError, UnsureError, WalkError, of_kind
from benchdragon.i18n import _, both
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.turn_question import spread
from benchdragon.model.answer import Answer
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.outline import shape_of
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan
from benchdragon.plans.toml import PlanError
from benchdragon.progress import Progress, part, silent

# Error of the ground that the dance covers, m.
ROUGH = 0.05
# The result is rounded to so many decimals of a metre and of a degree: benches cannot be placed more
# accurately.
DIGITS = 3
# Widths of brackets of the answer's distances, m: the first that can be reached.
TOLERANCES = (1e-12, 1e-8, 1e-5)
# Share of the time that the global search takes.
SEARCHED = 0.6
# Sample places on the square, the best of them that are refined, and the least distance of those, as a
# share of the ranges.
STREWN, STARTS, APART = 600, 4, 0.1
# Edges of a descent's first simplex: as shares of the ranges, then m, m and degrees; trials of each.
SIMPLEX, FINE, LOCAL = 0.02, (0.04, 0.04, 0.2), 200


@dataclass(frozen=True)
class PlacedDance:
    """A dance where it fits best on the square.

    Attributes:
        plan: the plan with route.at and route.turned as found.
        at: where the origin of the dance lies, m.
        turned: how far the dance is turned to the left, degrees.
        room: how much more than its margin benches and their people keep from each obstacle and the
            venue's edge, m; "infeasible" where no place was found at which they do, negative or 0 then.
        obstacles: the exact answers about each and the benches alone, for the whole walk.
        report: what a check says of the plan there; None where no place was found.
    """

    plan: Plan
    at: tuple[float, float]
    turned: float
    room: Answer
    obstacles: tuple[ObstacleAnswers, ...]
    report: Report | None

    @property
    def passes(self) -> bool:
        """Whether a place was found at which the plan passes the check."""
        return self.report is not None and self.report.safe

    def as_json(self) -> dict[str, Any]:
        """Everything as plain data: the room, where, least distances, and what the check says."""
        distances = {answers.obstacle.name: answers.distance.as_json() for answers in self.obstacles}
        where = {"at": list(self.at), "turned": self.turned}
        judged = None if self.report is None else verdict_json(self.report)
        return {**self.room.as_json(), **where, "distances": distances, "check": judged}


def verdict_json(report: Report) -> dict[str, Any]:
    """The verdict of a check, in short, as plain data."""
    said = both(lambda: sentence(report))
    return {
        "safe": report.safe, "decided": report.decided, "sentence": {"en": said.en, "zh": said.zh},
    }  # fmt: skip


@budget.question()
def best_place(plan: Plan, *, progress: Progress = silent) -> PlacedDance:
    """Where on its square a plan's dance fits best: with the most room to edge and obstacles.

    The search is the same each time; that no place is better is not shown.

    Raises:
        InputError: for a plan without a venue, or a walk too long to be drawn.
        WalkError: if the dragon cannot walk.
    """
    of_kind("plan", plan, Plan)
    began = clock.perf_counter()
    if not any(obstacle.kind == "venue" for obstacle in plan.obstacles()):
        raise InputError(_("the plan has no venue to be placed in: add [venue]"))
    square = Square(plan.with_values({"route.at": [0.0, 0.0], "route.turned": 0.0}))
    rough = square.roughly(part(progress, 0.0, SEARCHED, _("trying positions")))
    progress(SEARCHED, _("exact figures"))
    best = rough
    if square.crowding(rough) < ROUGH:
        fine = downhill(square.exact_crowding, rough, np.array(FINE))
        best = min(rough, fine, key=square.exact_crowding)
    return square.placed(best, clock.perf_counter() - began)


def downhill(score: Callable[[FloatArray], float], x: FloatArray, edges: FloatArray) -> FloatArray:
    """A low point downhill from x by Nelder and Mead's simplex, whose edges are so long at first."""
    from scipy.optimize import minimize  # slow to import

    result = minimize(
        score, x, method="Nelder-Mead",
        options={
            "initial_simplex": np.vstack([x, x + np.diag(edges)]), "maxfev": LOCAL, "xatol": 1e-5,
            "fatol": 1e-6,
        },
    )  # fmt: skip
    return np.asarray(result.x)


@dataclass(frozen=True)
class Enough:
    """What a dance without a place on its square needs: a larger square, or fewer benches.

    Attributes:
        rectangle: length and width of an empty square, m, rounded up to decimetres: the dance fits on
            it, its people and the margin to the edge included; None where the check refuses the dance
            without any square, too.
        benches: so many of the plan's have a place on its own square, which `best_place` found, and
            pass the check there; None where no number of them was found to, or where the plan says each
            its own size.
        alone: what a check says of the dance without its square.
    """

    rectangle: tuple[float, float] | None
    benches: int | None
    alone: Report

    def as_json(self) -> dict[str, Any]:
        """Everything as plain data."""
        sides = None if self.rectangle is None else list(self.rectangle)
        return {"rectangle": sides, "benches": self.benches, "check": verdict_json(self.alone)}


@budget.question()
def enough_room(plan: Plan, *, progress: Progress = silent) -> Enough:
    """What a dance needs for which `best_place` found no place: a larger square, or fewer benches.

    Raises:
        InputError, WalkError, UnsureError: as `best_place` and `swept_area`.
    """
    of_kind("plan", plan, Plan)
    alone = check(plan.without_square())
    rectangle = _rectangle(plan) if alone.safe else None
    return Enough(rectangle, _benches_placed(plan, progress), alone)


def _rectangle(plan: Plan) -> tuple[float, float]:
    """Length and width of an empty square on which a plan's dance fits, m."""
    walk, obstacles = with_all_room(plan)
    box = enclosing(walk, *plan.span(walk), error=ROUGH).rectangle
    edge = next((one.margin for one in obstacles if one.kind == "venue"), 0.0)
    sides = sorted(math.ceil(10.0 * (side + 2.0 * edge)) / 10.0 for side in (box.width, box.height))
    return sides[1], sides[0]


def _benches_placed(plan: Plan, progress: Progress) -> int | None:
    """How many of a plan's benches have a place on its square, by halving; None if none were found."""
    if plan.dragon.bench:
        return None
    fits, not_fit = 0, plan.dragon.benches
    while not_fit - fits > 1:
        progress(1.0 - (not_fit - fits) / plan.dragon.benches, _("fewer benches"))
        middle = (fits + not_fit) // 2
        if _has_place(plan.with_value("dragon.benches", middle)):
            fits = middle
        else:
            not_fit = middle
    return fits or None


def _has_place(plan: Plan) -> bool:
    """Whether a plan's dance has a place and passes the check there; not where it cannot walk."""
    try:
        return best_place(plan).passes
    except (PlanError, WalkError, UnsureError):
        return False


class Square:
    """Where a dance may be placed, and how much room it has there.

    A place is where the middle of what the dance covers lies, m, and how far it is turned, degrees.

    Args:
        plan: with the dance at its origin.
    """

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.walk, self.obstacles = with_all_room(plan)
        self.span = plan.span(self.walk)
        self.evaluations = 0

    @cached_property
    def region(self) -> BaseGeometry:
        """What the dance and its people cover at its origin, and up to ROUGH more."""
        region = swept_area(self.walk, *self.span, error=ROUGH).polygon
        shapely.prepare(region)
        return region

    @cached_property
    def middle(self) -> tuple[float, float]:
        """The middle of what the dance covers, m."""
        low_x, low_y, high_x, high_y = self.region.bounds
        return 0.5 * (low_x + high_x), 0.5 * (low_y + high_y)

    def roughly(self, progress: Progress) -> FloatArray:
        """The place with the most room, by descent from the best sample places on the square."""
        outline = self.obstacles[0].outline
        low, size = np.append(outline.min(axis=0), 0.0), np.append(np.ptp(outline, axis=0), 360.0)
        powers = spread(len(low)) ** -np.arange(1.0, len(low) + 1.0)
        shares = (0.5 + np.arange(STREWN)[:, np.newaxis] * powers) % 1.0
        crowded = np.empty(STREWN)
        for n, place in enumerate(low + size * shares):
            crowded[n] = self.crowding(place)
            progress(0.5 * (n + 1) / STREWN, "")
        starts: list[FloatArray] = []
        for share in shares[np.argsort(crowded, kind="stable")]:
            if len(starts) < STARTS and all(np.abs(share - other).max() > APART for other in starts):
                starts.append(share)
        ends = []
        for share in starts:
            ends.append(downhill(self.crowding, low + size * share, SIMPLEX * size))
            progress(0.5 + 0.5 * len(ends) / STARTS, "")
        return downhill(self.crowding, min(ends, key=self.crowding), SIMPLEX * size)

    def pose(self, place: FloatArray) -> tuple[tuple[float, float], float]:
        """A place as a plan gives it: route.at, m, and route.turned, degrees, rounded."""
        x, y, turned = place.tolist()
        c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
        a, b = self.middle
        # + 0.0 makes -0.0 a 0.0
        at = round(x - c * a + s * b, DIGITS) + 0.0, round(y - s * a - c * b, DIGITS) + 0.0
        return at, round(turned % 360.0, DIGITS) % 360.0

    def at(self, place: FloatArray) -> Plan:
        """The plan with its dance at a place."""
        at, turned = self.pose(place)
        return self.plan.with_values({"route.at": list(at), "route.turned": turned})

    def crowding(self, place: FloatArray) -> float:
        """The objective: minus the least room seen, m; positive where there is none."""
        self.evaluations += 1
        at, turned = self.pose(place)
        moved = self.plan.route.model_copy(update={"at": at, "turned": turned})
        return -min(_room(self.region, moved.unplaced(obstacle)) for obstacle in self.obstacles)

    def exact_crowding(self, place: FloatArray) -> float:
        """The same by exact least distances, wherever the dance lies clear of all."""
        seen = self.crowding(place)
        if seen >= ROUGH:
            return seen
        found = self._answers(*with_all_room(self.at(place)), (1e-6,))
        return -min(answers.distance.lower - answers.obstacle.margin for answers in found)

    def _answers(
        self, walk: Walk, obstacles: Sequence[Obstacle], tolerances: Sequence[float]
    ) -> tuple[ObstacleAnswers, ...]:
        return tuple(
            obstacle_answers(walk, obstacle, *self.span, tolerances=tolerances)
            for obstacle in obstacles
        )

    def placed(self, place: FloatArray, seconds: float) -> PlacedDance:
        """The exact answers at a place."""
        plan, (at, turned) = self.at(place), self.pose(place)
        found = self._answers(*with_all_room(plan), TOLERANCES)
        tightest = min(found, key=lambda answers: answers.distance.value - answers.obstacle.margin)
        margin, near = tightest.obstacle.margin, tightest.distance
        rooms = (near.value - margin, near.lower - margin, near.upper - margin)
        room = replace(
            near, value=rooms[0], lower=rooms[1], upper=rooms[2],
            status="found" if rooms[1] >= 0.0 and near.lower > 0.0 else "infeasible",
            assumptions=(*near.assumptions, _("best that was found; better positions may exist")),
            evaluations=self.evaluations, seconds=seconds,
        )  # fmt: skip
        alone = self._answers(plan.build(), plan.obstacles(), TOLERANCES)
        report = None if room.status == "infeasible" else check(plan)
        return PlacedDance(plan, at, turned, room, alone, report)


def _room(region: BaseGeometry, obstacle: Obstacle) -> float:
    """How much more than its margin a region keeps from an obstacle, m; negative where it meets it."""
    shape = shape_of(obstacle)
    if obstacle.kind == "venue":
        if shapely.contains_properly(shape, region):
            return float(shapely.distance(shapely.boundary(shape), region)) - obstacle.margin
        return -math.sqrt(float(region.difference(shape).area)) - obstacle.margin
    apart = float(shapely.distance(region, shape)) - obstacle.radius
    if apart > 0.0:
        return apart - obstacle.margin
    deep = region.intersection(shape.buffer(max(obstacle.radius, ROUGH)))
    return -math.sqrt(float(deep.area)) - obstacle.margin
