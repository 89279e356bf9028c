"""Continuous collision detection of benches and one obstacle: see kernels/obstacle_memory.py."""

import math
import time as clock
from collections.abc import Sequence

import numpy as np

from benchdragon.analysis.contact import refined
from benchdragon.analysis.contact_search import (
    MOST_EVALUATIONS,
    MOST_LEAST_EVALUATIONS,
    SLACK,
    WIDTH,
    assumed_within,
)
from benchdragon.analysis.distance import FEATURES
from benchdragon.analysis.engine_question import EngineQuestion
from benchdragon.analysis.head_times import HeadTimes
from benchdragon.analysis.nearby import checked_off, must_stand, origin_at, seen_from
from benchdragon.analysis.rounds import returns
from benchdragon.analysis.tables import in_columns
from benchdragon.errors import UnsureError, in_order, of_kind
from benchdragon.i18n import _
from benchdragon.kernels import obstacle_memory
from benchdragon.kernels import obstacle_question as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.obstacle_memory import ObstacleFound, ObstacleGiven, ObstacleTold
from benchdragon.kernels.obstacle_search import ObstacleEnding
from benchdragon.kernels.question import QuestionEnding
from benchdragon.kernels.time_of_impact import Goal
from benchdragon.kernels.walk_search import WalkEnding
from benchdragon.model.answer import Answer, Status, Witness
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk

# Head positions at which a failure to follow benches is examined.
SAMPLES = 65
# Brackets of touches that are wider than this, s, began with a graze.
NARROW = 1e-6


def repeats_of(walk: Walk) -> FloatArray:
    """The parts of a route that lead back to where it was, as the engine takes them."""
    lengths, widths, *_insets = walk.dragon.sizes.tolist()
    squares = (a * a + b * b for a, b in zip(lengths, widths, strict=True))
    return returns(walk.route.rows, math.sqrt(max(squares)))


class ObstacleSearch(EngineQuestion):
    """A search of a walk from one time to another for benches that come near an obstacle.

    Args:
        walk: the walk that is searched.
        obstacle: an obstacle, or the venue's edge.
        start: s; the dragon must be able to stand there, and at the end.
        end: s.

    Raises:
        InputError: for an end before the start.
        WalkError: if the dragon cannot stand at either.
    """

    def __init__(self, walk: Walk, obstacle: Obstacle, start: float, end: float) -> None:
        of_kind("walk", walk, Walk)
        of_kind("obstacle", obstacle, Obstacle)
        in_order(start, end)
        began, (first, last) = clock.perf_counter(), walk.head_position([start, end]).tolist()
        must_stand(walk, start)
        must_stand(walk, end)
        origin, dragon = origin_at(walk, first), walk.dragon
        near, (x, y) = seen_from(walk, origin), origin
        named = {
            ObstacleGiven.SORT: obstacle.sort,
            ObstacleGiven.RADIUS: obstacle.radius,
            ObstacleGiven.MARGIN: obstacle.margin,
            ObstacleGiven.HEAD_FIRST: first,
            ObstacleGiven.HEAD_LAST: last,
            ObstacleGiven.LEAST_OFF: SLACK,
            ObstacleGiven.WIDTH: WIDTH,
            ObstacleGiven.MOST: MOST_EVALUATIONS,
            ObstacleGiven.MOST_LEAST: MOST_LEAST_EVALUATIONS,
        }
        outline = np.array([(at[0] - x, at[1] - y) for at in obstacle.walls.tolist()])
        handle = kernel.open_obstacle(
            near.route.rows, dragon.links, dragon.sizes, outline, repeats_of(near), in_columns(named)
        )
        super().__init__(
            handle,
            kernel.step_obstacle,
            kernel.read_obstacle,
            np.zeros(obstacle_memory.OBSTACLE_FIGURES),
        )
        self._walk, self._obstacle, self._heads, self._origin = walk, obstacle, (first, last), origin
        self._times, self._began = HeadTimes(walk, first, start, end), began

    @property
    def evaluations(self) -> int:
        """Benches placed in searches."""
        return int(self.figures[ObstacleTold.MADE])

    def ways(self) -> FloatArray:
        """How each size of bench is walked, a row each: see kernels/obstacle_memory.py."""
        ways = np.empty((len(self._walk.dragon), obstacle_memory.SIZE_WAY_COLUMNS))
        return ways[: kernel.read_ways(self._handle, ways)]

    def touches(self) -> list[Answer]:
        """When a bench first comes nearer to the obstacle than it may: empty if none does.

        The last is sure; those before it are grazes within rounding, "undecided". All is clear up to
        the lower end of the first.

        Raises:
            WalkError: if the dragon cannot walk on to the end.
            UnsureError: if it could not be shown that it can, or benches graze too often.
        """
        found = self._found(Goal.FIRST_TOUCH, 0.0)
        return [self._touch(row) for row in found]

    def least_distance(self, tolerances: Sequence[float]) -> Answer:
        """The least distance, m, in a bracket as wide as the first of `tolerances`, m, that can be.

        Raises:
            WalkError: if the dragon cannot walk on to the end.
            UnsureError: if it could not be shown that it can.
        """
        for n, tolerance in enumerate(tolerances):
            with refined(n):
                found = self._found(Goal.LEAST, tolerance)
                if self.figures[ObstacleTold.CLOSED_IN]:
                    return self._distance(found[0])
        found = self._found(Goal.LEAST, math.inf)
        return self._distance(found[0])

    def _found(self, goal: int, narrow: float) -> list[list[float]]:
        """Rows of touches or distances: see kernels/obstacle_memory.py."""
        kernel.seek_obstacle(self._handle, goal, narrow)
        while (ending := self.step()) == QuestionEnding.MORE:
            pass
        if ending == WalkEnding.ASTRAY:
            raise self._stopped()
        if ending == ObstacleEnding.TOO_OFTEN:
            text = _("benches come within rounding of {name} too often to be followed on")
            raise UnsureError(text.format(name=self._obstacle.name))
        if ending == ObstacleEnding.TOO_FAR_OFF:
            checked_off(float(self.figures[ObstacleTold.ABOUT]))
        found = np.empty((int(self.figures[ObstacleTold.COUNT]), obstacle_memory.FOUND_COLUMNS))
        kernel.read_found(self._handle, 0, found)
        rows: list[list[float]] = found.tolist()
        return rows

    def _stopped(self) -> Exception:
        """Why a bench could not be followed past the end of what its search had shown."""
        error = self._walk.first_failure(np.linspace(*self._heads, SAMPLES))
        text = _("past s = {s} m it could not be shown that every bench follows without a leap")
        return error or UnsureError(text.format(s=f"{self.figures[ObstacleTold.SOUND]:.6g}"))

    def _touch(self, row: list[float]) -> Answer:
        """Times between which a touch begins, and how the bench then stands."""
        sure: Status = "found" if row[ObstacleFound.SURE] else "undecided"
        value, early, late, status = self._times.told(
            row[ObstacleFound.LOW_END], row[ObstacleFound.HIGH_END], sure
        )
        if status == "found" and late - early > NARROW:
            value = late  # a graze came before: then it surely touches
        return self._answer((value, early, late), "s", status, row)

    def _distance(self, row: list[float]) -> Answer:
        bracket = (row[ObstacleFound.VALUE], row[ObstacleFound.LOW_END], row[ObstacleFound.HIGH_END])
        return self._answer(bracket, "m", "found", row)

    def _answer(
        self, bracket: tuple[float, float, float], unit: str, status: Status, row: list[float]
    ) -> Answer:
        assumed, made = assumed_within(float(self.figures[ObstacleTold.ABOUT])), self.evaluations
        seconds = clock.perf_counter() - self._began
        return Answer(*bracket, unit, status, self._witness(row), assumed, made, seconds)

    def _witness(self, row: list[float]) -> Witness:
        """How a bench stands to the obstacle.

        Where it stands wholly inside of one the gap is minus the distance. Of a bench outside of the
        venue the point is the corner that is farthest out, and the gap minus how far.
        """
        s, gap, bench = (
            row[ObstacleFound.HEAD],
            row[ObstacleFound.GAP],
            int(row[ObstacleFound.WHO]) + 1,
        )
        if math.isnan(gap):
            raise self._stopped()
        point = row[ObstacleFound.AT_X] + self._origin[0], row[ObstacleFound.AT_Y] + self._origin[1]
        feature, time = FEATURES[int(row[ObstacleFound.FEATURE])], self._times.at(s)
        return Witness(time, s, (bench,), point, gap, ((bench, feature),), None, self._obstacle.name)
