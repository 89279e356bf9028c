"""The kernels' search for the size that a plan may have: what they ask for is done here."""

import math

import numpy as np

from benchdragon.analysis import distance
from benchdragon.analysis.contact_search import MOST_EVALUATIONS, SLACK, WIDTH, run_search
from benchdragon.analysis.nearby import NOWHERE, checked_off, origin_of, seams_of
from benchdragon.analysis.obstacle_search import ObstacleSearch
from benchdragon.analysis.obstacles import touching
from benchdragon.analysis.tables import PLACES, Tables
from benchdragon.errors import InputError, UnsureError, WalkError
from benchdragon.i18n import _
from benchdragon.kernels import search as steps
from benchdragon.kernels import size_bracket as bracket
from benchdragon.kernels import size_search as kernel
from benchdragon.kernels.box import BOX_COLUMNS, nearest_pair
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.course import AT, SOUND
from benchdragon.kernels.curve import COLUMNS, LENGTH, S_START, FloatArray
from benchdragon.kernels.family import falls_soon, set_walk
from benchdragon.kernels.low_points import SHRINKS, low_pair, low_point
from benchdragon.kernels.rounding import bench_errors
from benchdragon.kernels.route import END_SLACK
from benchdragon.kernels.route_parts import settle_rows
from benchdragon.kernels.spiral import LANES
from benchdragon.kernels.step_bounds import place_chain
from benchdragon.kernels.walk_search import ASTRAY
from benchdragon.model.answer import Answer
from benchdragon.plans.toml import PlanError
from benchdragon.progress import Progress
from benchdragon.solve.size_family import TOLERANCE, Meeting, PlanFamily, kernel_family

# How often a bracket is widened until a bench surely touches an obstacle at its end.
MOST_WIDENINGS = 30
# Sizes are tried to so many times the plan's own where there are obstacles.
FAR = 10.0
# Head positions at which a pair is looked at, at least.
FEWEST = 4


class SizeSearch:
    """A search for a size of a plan: its memory, and what the kernels ask for done by other kernels.

    Args:
        family: the walks among which a size is sought.
        progress: is told what is being tried.

    Attributes:
        state: of the search, by the names in kernels/size_bracket.py.
        evaluations: chains placed in searches of walks.
        blocked: the last size that failed by an obstacle alone, m, and when a bench touched it, or
            came within rounding of it.
    """

    def __init__(self, family: PlanFamily, progress: Progress) -> None:
        self._progress, self._margin = progress, family.margin
        self._settings = family.question.sense, max(TOLERANCE, family.tolerance)
        self.evaluations = 0
        self._plans, self._obstacles = family, family.plan.obstacles()
        self.blocked: tuple[float, Answer] | None = None
        walk, start, end = family.walk(family.first)
        first, last = walk.head_position([start, end]).tolist()
        self._ends = first, max(first, last)
        placed = walk.placement(first, throw=False)
        self._origin = origin_of(placed.x, placed.y)
        self._family, self._walk = kernel_family(family, walk)
        self._tables = self._made_tables()
        self.state = np.zeros(bracket.STATE)
        self._doubts = np.empty(bracket.MOST_TRIALS + bracket.MOST_GROWTHS)
        self._meetings = np.full((kernel.MEETINGS, 4), kernel.NOBODY)
        handles = len(walk.dragon) + 1
        slots = max(FEWEST, min(LANES, PLACES // handles))
        self._scratch = (np.empty(slots), empty_placements(handles, slots))
        self._boxes = np.empty((2, BOX_COLUMNS))

    def _made_tables(self) -> Tables:
        """Room for searches of walks as long as that of the plan; others widen it."""
        tail = self._ends[0] - 1.5 * float(self._walk.benches.links.sum())
        return Tables(self._walk, *self._ends, self._margin + SLACK, tail)

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
        return _meeting(self._meetings[kernel.GUIDE])

    def limit(self, size: float) -> int:
        """Seek the limit next to the first size that passes, from `size` on; how that ended."""
        self._open(kernel.GROW, size)
        return self._sought()

    def border(self, good: float, bad: float) -> tuple[float, bool]:
        """The last size that passes from one that does towards one that does not.

        And whether that is where the border was found.
        """
        self._open(kernel.BORDER, bad)
        self.state[[bracket.GOOD, bracket.BAD, bracket.TRIED]] = good, bad, 1.0
        found = self._sought() == kernel.FOUND and not self.in_doubt
        return float(self.state[bracket.GOOD]), found

    def _open(self, stage: int, size: float) -> None:
        self.state[:] = 0.0
        self.state[[bracket.SENSE, bracket.TOLERANCE]] = self._settings
        self.state[[bracket.SLACK, bracket.CAUTION]] = SLACK, bracket.FIRST_CAUTION
        self.state[[bracket.STAGE, bracket.SIZE]] = stage, size
        self._meetings[:, kernel.MEET_FRONT] = kernel.NOBODY

    def _sought(self) -> int:
        """Do what the kernels ask for until they have what they seek; how that ended."""
        tasks, value = {kernel.WALK: self.trial, kernel.LOW_PAIR: self._low_pair}, 0.0
        tasks[kernel.DISTANCE] = self._distance
        while True:
            asked = kernel.next_task(self.state, self._doubts, self._meetings, value)
            if asked not in tasks:
                return asked
            value = tasks[asked](float(self.state[bracket.NOW]))

    def _walk_of(self, size: float) -> tuple[FloatArray, float, float]:
        """The rows of the route of a size, none if there is no such walk; between which it goes, m."""
        at, places = self._scratch
        rows, first, last = set_walk(self._family, self._walk, at, places, size)
        if rows < 0:
            self._walk = self._walk._replace(rows=np.zeros((-rows, COLUMNS)))
            self._tables = self._made_tables()
            return self._walk_of(size)
        if self._origin != NOWHERE and rows:
            settle_rows(self._walk.rows[:rows], *self._origin)
        return self._walk.rows[:rows], first, last

    def _low_pair(self, size: float) -> float:
        """Fill GUIDE with a pair that comes near in the walk of a size; how near less the margin, m."""
        rows, first, last = self._walk_of(size)
        benches = self._walk.benches
        if not len(rows) or not 3 <= len(benches.kind) <= distance.MOST_SAMPLED:
            return math.inf
        least, s, i, j = low_pair(
            rows, benches.links, benches.sizes, first, last, *self._scratch, self._boxes
        )
        self._meetings[kernel.GUIDE] = s, last - s, i, j
        return least - self._margin

    def _distance(self, size: float) -> float:
        """How near the ROOTED pair comes by its meeting in the walk of a size, less the margin, m."""
        rows, first, last = self._walk_of(size)
        meeting = _meeting(self._meetings[kernel.ROOTED])
        if not len(rows) or meeting is None:
            return math.nan
        benches, (i, j) = self._walk.benches, (meeting.i, meeting.j)
        least, s = min(
            low_point(
                rows, benches.links, benches.sizes, i, j, low, high, SHRINKS, *self._scratch,
                self._boxes,
            )
            for low, high in meeting.windows(benches.links, first, last)
        )  # fmt: skip
        self._meetings[kernel.ROOTED, : kernel.MEET_FRONT] = s, last - s
        return least - self._margin if math.isfinite(least) else math.nan

    def trial(self, size: float) -> int:
        """How the walk of a size goes: PASSES, FAILS or UNDECIDED of kernels/size_bracket.py.

        One that is too long to be searched is undecided too.
        """
        self._progress(0.0, f"{size:.9g} m")
        try:
            return self._failed_alone() if self._is_blocked(size) else self._tried(size)
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
                search = ObstacleSearch(walk, obstacle, start, end)
                found = touching(search)
                self.evaluations += search.evaluations
                if found:
                    self.blocked = size, found[-1]
                    return True
        except (InputError, PlanError, WalkError):
            return False  # there is no such walk, or benches cannot follow: `_tried` finds out
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

    def _tried(self, size: float) -> int:
        rows, first, last = self._walk_of(size)
        if not len(rows):
            return self._failed_alone()
        (at, places), tables = self._scratch, self._tables
        at[0] = first
        if not place_chain(rows, self._walk.benches.links, at, 0, 1, places):
            return self._failed_alone()
        if first == last:
            return self._standing(rows, first)
        tables.aim(self._walk._replace(rows=rows), first, last, self._margin + SLACK)
        tables.begin()
        return self._searched(last)

    def _failed_alone(self) -> int:
        """That a walk fails in which no two benches met."""
        self._meetings[kernel.FAILED, kernel.MEET_FRONT] = kernel.NOBODY
        return bracket.FAILS

    def _standing(self, rows: FloatArray, s: float) -> int:
        """How a dragon that stands still passes, which is placed in the first slot."""
        places = self._scratch[1]
        x, y = (np.ascontiguousarray(column[:, :1]) for column in (places.x, places.y))
        benches = self._walk.benches
        apart, _time, i, j = nearest_pair(benches.sizes, x, y)
        (lanes, off), errors = np.empty((2, len(benches.kind))), np.empty(len(places.x))
        seams = seams_of(rows)
        bench_errors(rows, benches.links, benches.sizes, seams, places, 0, -1, lanes, errors, off)
        if apart > self._margin - max(SLACK, float(off[i] + off[j])):
            return bracket.PASSES
        self._meetings[kernel.FAILED] = s, 0.0, i, j
        return bracket.FAILS

    def _searched(self, last: float) -> int:
        """How the walk goes for which the tables are made."""
        note, tables = np.zeros(steps.NOTES), self._tables
        ending = run_search(
            tables, steps.FIRST_TOUCH, (self._margin, SLACK, WIDTH, MOST_EVALUATIONS), note
        )
        off = checked_off(float(note[steps.OFF]))
        self.state[bracket.SLACK] = max(float(self.state[bracket.SLACK]), off)
        self.evaluations += int(note[steps.EVALUATIONS])
        if ending == steps.CLEAR:
            rows = tables.walk.rows
            length = float(rows[-1, S_START] + rows[-1, LENGTH])
            return self._failed_alone() if last > length + END_SLACK else bracket.PASSES
        if ending in (ASTRAY, steps.FALLEN):
            return self._fallen(ending, note)
        i, j = divmod(int(note[steps.PAIR]), len(self._walk.benches.kind))
        s = float(note[steps.UPPER])
        self._meetings[kernel.FAILED] = s, last - s, i, j
        return bracket.FAILS

    def _fallen(self, ending: int, note: FloatArray) -> int:
        """What a walk comes to that could not be searched further."""
        way, (at, places) = self._tables.course.way, self._scratch
        sound = float(note[steps.LOWER]) if ending == steps.FALLEN else min(way[[AT, SOUND]].tolist())
        rows, links = self._tables.walk.rows, self._walk.benches.links
        falls = falls_soon(rows, links, sound, at, places)
        return self._failed_alone() if falls else bracket.UNDECIDED


def _meeting(row: FloatArray) -> Meeting | None:
    if row[kernel.MEET_FRONT] == kernel.NOBODY:
        return None
    s, left, i, j = row.tolist()
    return Meeting(s, left, int(i), int(j))
