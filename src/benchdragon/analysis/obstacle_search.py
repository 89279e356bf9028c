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
from benchdragon.kernels import obstacle_search as ended
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.question import MORE
from benchdragon.kernels.time_of_impact import FIRST_TOUCH, LEAST
from benchdragon.kernels.walk_search import ASTRAY
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
            obstacle_memory.SORT: obstacle.sort,
            obstacle_memory.RADIUS: obstacle.radius,
            obstacle_memory.MARGIN: obstacle.margin,
            obstacle_memory.HEAD_FIRST: first,
            obstacle_memory.HEAD_LAST: last,
            obstacle_memory.LEAST_OFF: SLACK,
            obstacle_memory.WIDTH: WIDTH,
            obstacle_memory.MOST: MOST_EVALUATIONS,
            obstacle_memory.MOST_LEAST: MOST_LEAST_EVALUATIONS,
        }
        outline = np.array([(at[0] - x, at[1] - y) for at in obstacle.outline.tolist()])
        handle = kernel.open_obstacle(
            near.route.rows, dragon.links, dragon.sizes, outline, repeats_of(near), in_columns(named)
        )
        super().__init__(
            handle, kernel.step_obstacle, kernel.read_obstacle, np.zeros(obstacle_memory.FIGURES)
        )
        self._walk, self._obstacle, self._heads, self._origin = walk, obstacle, (first, last), origin
        self._times, self._began = HeadTimes(walk, first, start, end), began

    @property
    def evaluations(self) -> int:
        """Benches placed in searches."""
        return int(self.figures[obstacle_memory.MADE])

    def ways(self) -> FloatArray:
        """How each size of bench is walked, a row each: see kernels/obstacle_memory.py."""
        ways = np.empty((len(self._walk.dragon), obstacle_memory.WAYS))
        return ways[: kernel.read_ways(self._handle, ways)]

    def touches(self) -> list[Answer]:
        """When a bench first comes nearer to the obstacle than it may: empty if none does.

        The last is sure; those before it are grazes within rounding, "undecided". All is clear up to
        the lower end of the first.

        Raises:
            WalkError: if the dragon cannot walk on to the end.
            UnsureError: if it could not be shown that it can, or benches graze too often.
        """
        found = self._found(FIRST_TOUCH, 0.0)
        return [self._touch(row) for row in found]

    def least_distance(self, tolerances: Sequence[float]) -> Answer:
        """The least distance, m, in a bracket as wide as the first of `tolerances`, m, that can be.

        Raises:
            WalkError: if the dragon cannot walk on to the end.
            UnsureError: if it could not be shown that it can.
        """
        for n, tolerance in enumerate(tolerances):
            with refined(n):
                found = self._found(LEAST, tolerance)
                if self.figures[obstacle_memory.CLOSED_IN]:
                    return self._distance(found[0])
        found = self._found(LEAST, math.inf)
        return self._distance(found[0])

    def _found(self, goal: int, narrow: float) -> list[list[float]]:
        """Rows of touches or distances: see kernels/obstacle_memory.py."""
        kernel.seek_obstacle(self._handle, goal, narrow)
        while (ending := self.step()) == MORE:
            pass
        if ending == ASTRAY:
            raise self._stopped()
        if ending == ended.TOO_OFTEN:
            text = _("benches come within rounding of {name} too often to be followed on")
            raise UnsureError(text.format(name=self._obstacle.name))
        if ending == ended.TOO_FAR_OFF:
            checked_off(float(self.figures[obstacle_memory.ABOUT]))
        found = np.empty((int(self.figures[obstacle_memory.COUNT]), obstacle_memory.FOUND_COLUMNS))
        kernel.read_found(self._handle, 0, found)
        rows: list[list[float]] = found.tolist()
        return rows

    def _stopped(self) -> Exception:
        """Why a bench could not be followed past the end of what its search had shown."""
        error = self._walk.first_failure(np.linspace(*self._heads, SAMPLES))
        text = _("past s = {s} m it could not be shown that every bench follows without a leap")
        return error or UnsureError(text.format(s=f"{self.figures[obstacle_memory.SOUND]:.6g}"))

    def _touch(self, row: list[float]) -> Answer:
        """Times between which a touch begins, and how the bench then stands."""
        sure: Status = "found" if row[obstacle_memory.SURE] else "undecided"
        value, early, late, status = self._times.told(
            row[obstacle_memory.LOW_END], row[obstacle_memory.HIGH_END], sure
        )
        if status == "found" and late - early > NARROW:
            value = late  # a graze came before: then it surely touches
        return self._answer((value, early, late), "s", status, row)

    def _distance(self, row: list[float]) -> Answer:
        bracket = (
            row[obstacle_memory.VALUE],
            row[obstacle_memory.LOW_END],
            row[obstacle_memory.HIGH_END],
        )
        return self._answer(bracket, "m", "found", row)

    def _answer(
        self, bracket: tuple[float, float, float], unit: str, status: Status, row: list[float]
    ) -> Answer:
        assumed, made = assumed_within(float(self.figures[obstacle_memory.ABOUT])), self.evaluations
        seconds = clock.perf_counter() - self._began
        return Answer(*bracket, unit, status, self._witness(row), assumed, made, seconds)

    def _witness(self, row: list[float]) -> Witness:
        """How a bench stands to the obstacle.

        Where it stands wholly inside of one the gap is minus the distance. Of a bench outside of the
        venue the point is the corner that is farthest out, and the gap minus how far.
        """
        s, gap, bench = (
            row[obstacle_memory.HEAD],
            row[obstacle_memory.GAP],
            int(row[obstacle_memory.WHO]) + 1,
        )
        if math.isnan(gap):
            raise self._stopped()
        point = row[obstacle_memory.AT_X] + self._origin[0], row[obstacle_memory.AT_Y] + self._origin[1]
        feature, time = FEATURES[int(row[obstacle_memory.FEATURE])], self._times.at(s)
        return Witness(time, s, (bench,), point, gap, ((bench, feature),), None, self._obstacle.name)
