"""The engine's question about a size of a plan: kernels/size_question.py, asked by Python.

What is known of obstacles is answered here: they are looked at size by size, as the engine asks.
"""

import math

import numpy as np

from benchdragon import budget
from benchdragon.analysis.contact_search import MOST_EVALUATIONS, SLACK, WIDTH
from benchdragon.analysis.engine_question import EngineQuestion
from benchdragon.analysis.nearby import origin_of
from benchdragon.analysis.obstacle_search import ObstacleSearch
from benchdragon.analysis.tables import beginnings
from benchdragon.errors import InputError, UnsureError, WalkError
from benchdragon.i18n import _
from benchdragon.kernels import size_bracket as bracket
from benchdragon.kernels import size_memory as told_of
from benchdragon.kernels import size_question as kernel
from benchdragon.kernels import size_search as search
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.question import MORE
from benchdragon.model.answer import Answer
from benchdragon.model.walk import Walk
from benchdragon.plans.toml import PlanError
from benchdragon.progress import Progress
from benchdragon.solve.size_family import TOLERANCE, Meeting, PlanFamily, kernel_family

# How often a bracket is widened until a bench surely touches an obstacle at its end.
MOST_WIDENINGS = 30
# Sizes are tried to so many times the plan's own where there are obstacles.
FAR = 10.0


def limits_of(family: PlanFamily, walk: Walk, first: float, last: float) -> FloatArray:
    """What the engine is told of a question about a family, whose plan's own `walk` goes so far, m."""
    placed = walk.placement(first, throw=False)
    x, y = origin_of(placed.x, placed.y)
    named = {
        told_of.MARGIN: family.margin,
        told_of.LEAST_OFF: SLACK,
        told_of.WIDTH: WIDTH,
        told_of.MOST: MOST_EVALUATIONS,
        told_of.ORIGIN_X: x,
        told_of.ORIGIN_Y: y,
        told_of.BYTES: budget.memory(),
        told_of.SAFER: family.question.sense,
        told_of.NARROW: max(TOLERANCE, family.tolerance),
        told_of.BEGIN: first,
        told_of.END: max(first, last),
    }
    return np.array([named[n] for n in range(told_of.LIMITS)])


class SizeQuestion(EngineQuestion):
    """A question about a size of a plan, open until it is closed, as by `with`.

    Args:
        family: the walks among which a size is sought.
        progress: is told what is being tried.

    Attributes:
        state: of the search, by the names in kernels/size_bracket.py.
        blocked: the last size that failed by an obstacle alone, m, and when a bench touched it, or
            came within rounding of it.
    """

    def __init__(self, family: PlanFamily, progress: Progress) -> None:
        self._progress, self._plans, self._obstacles = progress, family, family.plan.obstacles()
        self.blocked: tuple[float, Answer] | None = None
        self._marched = 0  # beside obstacles
        self.state = np.zeros(bracket.STATE)
        self._doubts = np.empty(bracket.MOST_TRIALS + bracket.MOST_GROWTHS)
        self._meetings = np.full((search.MEETINGS, 4), search.NOBODY)
        walk, start, end = family.walk(family.first)
        limits = limits_of(family, walk, *walk.head_position([start, end]).tolist())
        handle = kernel.open_size(*kernel_family(family, walk), limits, beginnings())
        told = np.zeros(told_of.FIGURES), self.state, self._doubts, self._meetings
        super().__init__(handle, kernel.step_size, kernel.read_size, *told)

    @property
    def evaluations(self) -> int:
        """Chains placed in searches of walks."""
        return self._marched + int(self.figures[told_of.MARCHED])

    @property
    def doubts(self) -> list[float]:
        """The sizes that were tried and could not be decided, m."""
        doubts: list[float] = self._doubts[: int(self.state[bracket.DOUBTS])].tolist()
        return doubts

    @property
    def in_doubt(self) -> bool:
        """Whether such sizes lie in the bracket."""
        low, high = sorted(self.state[[bracket.GOOD, bracket.BAD]].tolist())
        return any(low < size < high for size in self.doubts)

    @property
    def guide(self) -> Meeting | None:
        """The pair that decides, or was last gone by."""
        s, left, i, j = self._meetings[search.GUIDE].tolist()
        return None if i == search.NOBODY else Meeting(s, left, int(i), int(j))

    def limit(self, size: float) -> int:
        """Seek the limit next to the first size that passes, from `size` on; how that ended."""
        return self._sought(search.GROW, size)

    def border(self, good: float, bad: float) -> tuple[float, bool]:
        """The last size that passes from one that does towards one that does not.

        And whether that is where the border was found.
        """
        found = self._sought(search.BORDER, bad, good) == search.FOUND and not self.in_doubt
        return float(self.state[bracket.GOOD]), found

    def trial(self, size: float) -> int:
        """How the walk of a size goes: PASSES, FAILS or UNDECIDED of kernels/size_bracket.py.

        One that is too long to be searched is undecided too.
        """
        self._sought(kernel.ALONE, size)
        return int(self.figures[told_of.RESULT])

    def _sought(self, stage: int, size: float, good: float = math.nan) -> int:
        """Let the engine step until it has what is sought; how that ended."""
        kernel.seek_size(self._handle, stage, size, good)
        ending, known = MORE, kernel.UNKNOWN
        while ending in (MORE, search.WALK):
            ending = self.step(known)
            known = self.known(float(self.state[bracket.NOW])) if ending == search.WALK else known
        return ending

    def known(self, size: float) -> int:
        """What is known of the walk of a size without the engine: that it fails, or nothing."""
        self._progress(0.0, f"{size:.9g} m")
        try:
            return bracket.FAILS if self._is_blocked(size) else kernel.UNKNOWN
        except UnsureError:
            return bracket.UNDECIDED

    def _is_blocked(self, size: float) -> bool:
        """Whether a bench comes nearer to an obstacle than it may in the walk of a size.

        Or within rounding of that: see `surely_bad`. Obstacles stay where they are, so that sizes over
        FAR times the plan's own, or below that share of it, are taken for blocked without a look.
        """
        if not self._obstacles:
            return False
        if not 1.0 / FAR <= size / self._plans.first <= FAR:
            return True
        try:
            walk, start, end = self._plans.walk(size)
            for obstacle in self._obstacles:
                with ObstacleSearch(walk, obstacle, start, end) as beside:
                    found = beside.touches()
                self._marched += beside.evaluations
                if found:
                    self.blocked = size, found[-1]
                    return True
        except (InputError, PlanError, WalkError):
            return False  # there is no such walk, or benches cannot follow: the engine finds out
        return False

    def surely_bad(self, good: float, bad: float) -> float:
        """The size of a bracket that does not pass; beyond one that is within rounding of an obstacle.

        Raises:
            UnsureError: if no such size was found.
        """
        for _widening in range(MOST_WIDENINGS):
            if self.blocked is None or self.blocked[0] != bad or self.blocked[1].status == "found":
                return bad
            bad += 2.0 * (bad - good)
            if self.trial(bad) != bracket.FAILS:
                break
        raise UnsureError(_("the bracket could not be established beside an obstacle"))
