"""The engine's question about a size of a plan: kernels/size_question.py, asked by Python."""

import math

import numpy as np

from benchdragon import budget
from benchdragon.analysis.contact_search import MOST_EVALUATIONS, SLACK, WIDTH
from benchdragon.analysis.engine_question import EngineQuestion
from benchdragon.analysis.nearby import origin_at
from benchdragon.analysis.tables import beginnings, in_columns
from benchdragon.errors import UnsureError
from benchdragon.i18n import _
from benchdragon.kernels import size_bracket as bracket
from benchdragon.kernels import size_memory as told_of
from benchdragon.kernels import size_question as kernel
from benchdragon.kernels import size_search as search
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.family import PlanNumber, RouteKind
from benchdragon.kernels.question import QuestionEnding
from benchdragon.kernels.size_bracket import Bracket, SizeVerdict
from benchdragon.kernels.size_memory import SizeGiven, SizeTold
from benchdragon.kernels.size_question import SizeQuestionGoal
from benchdragon.kernels.size_search import KnownMeeting, SizeGoal, SizeStep
from benchdragon.model.walk import Walk
from benchdragon.progress import Progress
from benchdragon.solve.size_family import TOLERANCE, Meeting, PlanFamily, kernel_family

# What moving a corner may round it by, as a share of its greatest coordinate.
MOVED = 16.0 * 2.0**-53
# How often a bracket is widened until a bench surely touches an obstacle at its end.
MOST_WIDENINGS = 30


def limits_of(family: PlanFamily, walk: Walk, first: float, last: float) -> FloatArray:
    """The limits of a question about a family as the engine takes them; `walk` is the plan's own."""
    x, y = origin_at(walk, first)
    named = {
        SizeGiven.MARGIN: family.margin,
        SizeGiven.LEAST_OFF: SLACK,
        SizeGiven.WIDTH: WIDTH,
        SizeGiven.MOST: MOST_EVALUATIONS,
        SizeGiven.ORIGIN_X: x,
        SizeGiven.ORIGIN_Y: y,
        SizeGiven.BYTES: budget.memory(),
        SizeGiven.SAFER: family.question.sense,
        SizeGiven.NARROW: max(TOLERANCE, family.tolerance),
        SizeGiven.BEGIN: first,
        SizeGiven.END: max(first, last),
        SizeGiven.PLAN_SIZE: family.first,
    }
    return in_columns(named)


def square_of(family: PlanFamily, fixed: bool) -> told_of.Square:
    """The obstacles as the engine takes them; `fixed` if all walks have one route.

    Other routes are built before a plan moves them: the obstacles are moved back to there.
    """
    route, given = family.plan.route, family.plan.obstacles()
    moves = not fixed and (route.at is not None or route.turned != 0.0)
    things: list[tuple[float, ...]] = []
    corners: list[list[float]] = []
    for thing in given:
        most = max(abs(value) for point in thing.walls.tolist() for value in point)
        one = route.unplaced(thing) if moves else thing
        outline = one.walls.tolist()
        things.append((one.sort, one.radius, one.margin, len(outline), MOVED * most if moves else 0.0))
        corners += outline
    return told_of.Square(
        np.array(things, dtype=np.float64).reshape(-1, told_of.THING_COLUMNS),
        np.array(corners, dtype=np.float64).reshape(-1, 2),
    )


class SizeQuestion(EngineQuestion):
    """A question about a size of a plan, open until it is closed, as by `with`.

    Args:
        family: the walks among which a size is sought.
        progress: is called with the share done and the size being tried.

    Attributes:
        state: of the search, by the names in kernels/size_bracket.py.
    """

    def __init__(self, family: PlanFamily, progress: Progress) -> None:
        walk, start, end = family.walk(family.first)
        limits = limits_of(family, walk, *walk.head_position([start, end]).tolist())
        own, laid = kernel_family(family, walk)
        square = square_of(family, own.numbers[PlanNumber.ROUTE] == RouteKind.FIXED)
        handle = kernel.open_size(own, laid, square, limits, beginnings())
        state, doubts = (
            np.zeros(bracket.BRACKET_NUMBERS),
            np.empty(bracket.MOST_TRIALS + bracket.MOST_GROWTHS),
        )
        meetings, figures = (
            np.full((search.MEETINGS, 4), search.NO_MEETING),
            np.zeros(told_of.SIZE_FIGURES),
        )
        super().__init__(handle, kernel.step_size, kernel.read_size, figures, state, doubts, meetings)
        self.state, self._doubts, self._meetings, self.progress = state, doubts, meetings, progress

    @property
    def evaluations(self) -> int:
        """Chains placed in searches of walks."""
        return int(self.figures[SizeTold.MARCHED])

    @property
    def doubts(self) -> list[float]:
        """The sizes that were tried and could not be decided, m."""
        doubts: list[float] = self._doubts[: int(self.state[Bracket.DOUBTS])].tolist()
        return doubts

    @property
    def in_doubt(self) -> bool:
        """Whether such sizes lie in the bracket."""
        low, high = sorted(float(self.state[column]) for column in (Bracket.GOOD, Bracket.BAD))
        return any(low < size < high for size in self.doubts)

    @property
    def guide(self) -> Meeting | None:
        """The pair that decides, or the last active pair."""
        s, left, i, j = self._meetings[KnownMeeting.GUIDE].tolist()
        return None if i == search.NO_MEETING else Meeting(s, left, int(i), int(j))

    def limit(self, size: float) -> int:
        """Find the limit next to the first size that passes, from `size` on; return the exit status."""
        return self._sought(SizeGoal.GROW, size)

    def border(self, good: float, bad: float) -> tuple[float, bool]:
        """The last size that passes from one that does towards one that does not.

        And whether that is where the border was found.
        """
        found = self._sought(SizeGoal.BORDER, bad, good) == SizeStep.FOUND and not self.in_doubt
        return float(self.state[Bracket.GOOD]), found

    def trial(self, size: float) -> int:
        """How the walk of a size goes: PASSES, FAILS or UNDECIDED of kernels/size_bracket.py.

        One that is too long to be searched is undecided too.
        """
        self._sought(SizeQuestionGoal.ALONE, size)
        return int(self.figures[SizeTold.RESULT])

    def _sought(self, stage: int, size: float, good: float = math.nan) -> int:
        """Let the engine step until it has the answer; return its exit status."""
        kernel.seek_size(self._handle, stage, size, good)
        ending, tried = QuestionEnding.MORE, math.nan
        while ending == QuestionEnding.MORE:
            ending = self.step()
            if (now := float(self.state[Bracket.NOW])) != tried:
                self.progress(0.0, f"{now:.9g} m")
                tried = now
        return ending

    def blocked(self, size: float) -> int | None:
        """Number, from 0, of the only obstacle that the last failing size touches; None without one."""
        return (
            int(self.figures[SizeTold.BLOCKED_BY]) if self.figures[SizeTold.BLOCKED] == size else None
        )

    def surely_bad(self, good: float, bad: float) -> float:
        """The size of a bracket that does not pass; beyond one that is within rounding of an obstacle.

        Raises:
            UnsureError: if no such size was found.
        """
        for _widening in range(MOST_WIDENINGS):
            if self.blocked(bad) is None or self.figures[SizeTold.SURELY]:
                return bad
            bad += 2.0 * (bad - good)
            if self.trial(bad) != SizeVerdict.FAILS:
                break
        raise UnsureError(_("the bracket could not be established beside an obstacle"))
