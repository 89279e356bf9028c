"""Where on the square a dance fits best: farthest from the venue's edge and from every obstacle.

A global search uses the room of boxes along the benches' ways (square.py), a local one the exact least
distances (analysis/obstacles.py), which the answer gives. The result is checked as any plan is.
"""

import math
import time as clock
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from benchdragon import budget
from benchdragon.analysis.check import Report, check, sentence
from benchdragon.analysis.obstacles import ObstacleAnswers, obstacle_answers
from benchdragon.analysis.room import with_all_room
from benchdragon.analysis.swept import enclosing
from benchdragon.errors import UnsureError, WalkError, of_kind
from benchdragon.i18n import _, both
from benchdragon.model.answer import Answer
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan
from benchdragon.plans.toml import PlanError
from benchdragon.progress import Progress, part, silent
from benchdragon.solve.square import Pose, Square, descended

# A pose that lacks no more room than this, m, is examined by exact distances; the ground from which the
# size of a square is computed has this error.
ROUGH = 0.05
# Widths of brackets of the answer's distances, m: the first that can be reached.
TOLERANCES = (1e-12, 1e-8, 1e-5)
# Share of the time that the global search takes.
SEARCHED = 0.6
# First steps of the exact descent, m, m and degrees, and its trials.
FINE, LOCAL = (0.04, 0.04, 0.2), 200


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

    Examples:
        >>> plan = bd.read_plan("spiral-in", {"dragon.benches": 4, "route.start_turn": 9,
        ...                                   "disc.radius": 2.9, "venue.rectangle": [14, 14]})
        >>> placed = plan.best_place()
        >>> placed.room.value > 0.0
        True
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

    Examples:
        >>> plan = bd.read_plan("spiral-in", {"dragon.benches": 4, "route.start_turn": 9,
        ...                                   "disc.radius": 2.9, "venue.rectangle": [14, 14]})
        >>> bd.best_place(plan).report.safe
        True
    """
    of_kind("plan", plan, Plan)
    began = clock.perf_counter()
    square = Square(plan.with_values({"route.at": [0.0, 0.0], "route.turned": 0.0}))
    best = square.roomiest(part(progress, 0.0, SEARCHED, _("trying positions")))
    progress(SEARCHED, _("exact figures"))
    if square.room(best) > -ROUGH:
        exact = Exact(square)
        best = descended(exact, best, FINE, LOCAL)[1]
    return _placed(square, best, clock.perf_counter() - began)


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


class Exact:
    """The room of a dance at poses on its square by exact least distances."""

    def __init__(self, square: Square) -> None:
        self._square = square

    def crowding(self, pose: Pose) -> float:
        """Minus the room, m: exact wherever the dance lies clear of all."""
        seen = self._square.room(pose)
        if seen <= -ROUGH:
            return -seen
        plan = self._square.at(pose).without_street()
        found = _answers(plan, *with_all_room(plan), (1e-6,))
        return -min(answers.distance.lower - answers.obstacle.margin for answers in found)


def _answers(
    plan: Plan, walk: Walk, obstacles: Sequence[Obstacle], tolerances: Sequence[float]
) -> tuple[ObstacleAnswers, ...]:
    return tuple(
        obstacle_answers(walk, obstacle, *plan.span(walk), tolerances=tolerances)
        for obstacle in obstacles
    )


def _placed(square: Square, pose: Pose, seconds: float) -> PlacedDance:
    """The exact answers at a pose."""
    plan, (x, y, turned) = square.at(pose), square.placed(pose)
    found = _answers(plan, *with_all_room(plan), TOLERANCES)
    tightest = min(found, key=lambda answers: answers.distance.value - answers.obstacle.margin)
    margin, near = tightest.obstacle.margin, tightest.distance
    rooms = (near.value - margin, near.lower - margin, near.upper - margin)
    room = replace(
        near, value=rooms[0], lower=rooms[1], upper=rooms[2],
        status="found" if rooms[1] >= 0.0 and near.lower > 0.0 else "infeasible",
        assumptions=(*near.assumptions, _("best that was found; better positions may exist")),
        evaluations=square.evaluations, seconds=seconds,
    )  # fmt: skip
    alone = _answers(plan, plan.build(), plan.obstacles(), TOLERANCES)
    report = None if room.status == "infeasible" else check(plan)
    return PlacedDance(plan, (x, y), turned, room, alone, report)
