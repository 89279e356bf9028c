"""Memory for searches along walks: what kernels/walk_search.py works on, made and made wider.

Nothing is filled before it is needed: untouched memory of the system costs nothing.
"""

import math

import numpy as np

from benchdragon import budget
from benchdragon.errors import InputError, UnsureError
from benchdragon.hosts.serving import empty, empty_whole, placed
from benchdragon.i18n import _
from benchdragon.kernels import cells, course
from benchdragon.kernels import search as steps
from benchdragon.kernels.beginning import CELL_SHARE, begin_walk
from benchdragon.kernels.cells import Grids, Ground, Kinds
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.course import Benches, Block, Course, Crowd, Meeting, Room
from benchdragon.kernels.curve import LENGTH, S_START, FloatArray
from benchdragon.kernels.grid import empty_grid
from benchdragon.kernels.kinds import find_kinds
from benchdragon.kernels.own_room import WIDER
from benchdragon.kernels.rounding import SEAM_COLUMNS
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.spiral import LANES
from benchdragon.kernels.walk_search import work_done
from benchdragon.model.walk import Walk

# Different sizes of benches whose contacts can be searched: each is boxed in each cell.
MOST_SIZES = 2_000
# Cells of a route: 1e6 cells need 100 MB.
MOST_CELLS = 2_000_000
# Handles times head positions that are placed at a time: 60 MB.
PLACES = 1_000_000
# At first there is room for so many parts of cells and pairs of boxes a cell, and for no more than so
# many in all; for so many pairs in a step, members of it, cells in doubt. Each is widened on demand.
A_CELL, AT_FIRST = 64, 1_000_000
PAIRS, MEMBERS, DOUBTS = 1_000, 256, 64


def kinds_of(sizes: FloatArray) -> tuple[IntArray, Kinds]:
    """The kind of each bench of these sizes, (4, benches), and the kinds.

    Raises:
        InputError: if they are too many.
    """
    benches = sizes.shape[1]
    most = min(MOST_SIZES, benches)
    found, kind = np.empty((4, most)), np.empty(benches, dtype=np.int64)
    group = np.empty(most, dtype=np.int64)
    count = find_kinds(sizes, found, kind, group)
    if count > most:
        raise InputError(
            _("contacts can be searched for at most {most} different sizes, not {count}").format(
                most=MOST_SIZES, count=np.unique(sizes, axis=1).shape[1]
            )
        )
    return kind, Kinds(np.ascontiguousarray(found[:, :count]), group[:count])


def walk_tables(walk: Walk) -> course.Walk:
    """A dragon on its route, as kernels want them.

    Raises:
        InputError: if its benches are of too many kinds.
    """
    dragon = walk.dragon
    kind, kinds = kinds_of(dragon.sizes)
    ahead = np.concatenate([[0.0], np.cumsum(dragon.links[:-1])])
    benches = Benches(dragon.links, dragon.sizes, kind, ahead, np.array([dragon.lever]))
    return course.Walk(walk.route.rows, benches, kinds)


class Tables:
    """What a search along a walk works on.

    Args:
        walk: what is searched.
        first: head positions, m, between which it is; the dragon must be able to stand at the first.
        last: likewise.
        reach: distance of benches, m, within which pairs are wanted.
        tail: about the route position of the last bench with the head at `first`, m, or less.

    Attributes:
        ground: the cells of the route.
        grids: where they are.
        block: dragons at the borders of steps.
        crowd: all benches at one of them.
        course: where the walk stands.
        meeting: pairs of a step.
        search: what a step is searched in.
    """

    def __init__(self, walk: course.Walk, first: float, last: float, reach: float, tail: float) -> None:
        self.walk, self._span, self._reach = walk, (first, last), reach
        self._rows = len(walk.rows)
        benches, end = len(walk.benches.kind), float(walk.rows[-1, S_START] + walk.rows[-1, LENGTH])
        cell = CELL_SHARE * float(walk.benches.links.min())
        self._wanted = max(math.floor(min(last, end) / cell) - math.floor(tail / cell), 0) + 2
        self._cells = min(self._wanted, MOST_CELLS)
        most = min(A_CELL * self._cells, AT_FIRST)
        self._parts, self._pairs, self._doubts = most, most, DOUBTS
        self._bench_pairs, self._members = PAIRS, min(MEMBERS, benches)
        handles = benches + 1
        slots = max(2, min(LANES, PLACES // handles))
        self.block = placed(
            Block(np.empty(slots), empty_placements(handles, slots), np.empty((handles, slots)))
        )
        self.course = Course(np.empty(course.COURSE), np.zeros(course.TALLY, dtype=np.int64))
        self.crowd = placed(
            Crowd(
                np.empty((benches, cells.HULL_COLUMNS)),
                empty_grid(benches, self._side()),
                np.empty(benches, dtype=np.int64),
            )
        )
        self._begun = first
        self._make_meeting()
        self._make_ground()

    def begin(self) -> None:
        """Begin the walk at its first position: nothing is known yet of the route ahead.

        Raises:
            UnsureError: if it could not be shown that the dragon stands there.
        """
        if not begin_walk(self.walk, self.room, *self._span, self._reach):
            raise UnsureError(_("it could not be shown that the dragon stands all along"))

    def _make_ground(self) -> None:
        """Room for the route ahead."""
        groups, rows = int(self.walk.kinds.group.max()) + 1, self._rows
        boxes = groups * self._cells + self._parts
        budget.hold(
            8
            * (
                boxes * (cells.HULL_COLUMNS + cells.TREE_COLUMNS + 1)
                + 4 * self._pairs
                + self._cells * groups * (groups + 2)
            )
        )
        self.ground = Ground(
            np.zeros(cells.COUNTS, dtype=np.int64),
            empty(cells.MEASURES),
            empty(groups, cells.WAYS + groups),
            empty(groups * groups * rows, 2),
            empty_whole(self._cells, groups * groups),
            empty(self._cells, 2),
            empty(boxes, cells.HULL_COLUMNS),
            empty_whole(boxes, cells.TREE_COLUMNS),
            empty_whole(self._pairs, 2),
            empty_whole(boxes),
            empty_whole(self._pairs, 2),
            empty_whole(self._doubts, 2),
            empty(rows, SEAM_COLUMNS),
        )
        whole = groups * self._cells
        self.grids = Grids(
            placed(empty_grid(self._cells, self._side())),
            placed(empty_grid(whole, self._side())),
            empty_whole(whole),
        )

    def _side(self) -> float:
        """That of the squares of grids, m: about how far benches are looked for."""
        return 2.0 * float(np.hypot(*self.walk.kinds.sizes[:2]).max()) + self._reach

    def _make_meeting(self) -> None:
        """Room for the pairs of a step, and to search it."""
        count, pairs = len(self.walk.benches.kind), self._bench_pairs
        first, second, mine, other = (np.empty(pairs, dtype=np.int64) for _list in range(4))
        place = np.full(count, -1, dtype=np.int64)
        self.meeting = placed(
            Meeting(first, second, mine, other, np.empty(count, dtype=np.int64), place)
        )
        self.search = placed(steps.room(count + 1, self._members, pairs))

    @property
    def room(self) -> Room:
        """All of it but the walk, as kernels take it."""
        return Room(
            self.ground, self.grids, self.block, self.crowd, self.course, self.meeting, self.search
        )

    @property
    def work(self) -> float:
        """What it took to come to know the route and to place dragons so far, in handles placed."""
        return float(work_done(self.room, len(self.walk.benches.kind)))

    def go(self, start: float, end: float) -> None:
        """Let the walk begin at head position start, m, and end at `end`, both within the first one.

        What is known of the route stays known.
        """
        self._begun = start
        self.course.way[course.GOAL] = min(end, float(self.ground.measures[cells.END]))
        self.again()

    def again(self) -> None:
        """Let the walk begin once more where it last began."""
        way = self.course.way
        way[: course.GOAL] = way[course.GOAL + 1 :] = self._begun
        self.course.tally[:] = 0

    def widen(self) -> None:
        """Make room where it did not do: for the step at hand, or for the route, which begins anew.

        Raises:
            UnsureError: if the route has too many cells.
        """
        if self._enlarge():
            at, goal = self.course.way[[course.AT, course.GOAL]].tolist()
            self.begin()
            self.course.way[[course.AT, course.UPTO, course.KNOWN, course.SOUND]] = at
            self.course.way[course.GOAL] = goal

    def _enlarge(self) -> bool:
        """Make room where it did not do; whether that is room for the route, nothing known of it.

        Raises:
            UnsureError: if the route has too many cells.
        """
        counts, tally = self.ground.counts, self.course.tally
        self._enlarge_cells()
        whole = len(self.ground.groups) * len(self.ground.middles)
        wanted = {
            "_parts": counts[cells.ROWS] - whole,
            "_pairs": max(counts[cells.ENTRIES], counts[cells.NEAR]),
            "_doubts": counts[cells.DOUBTS],
        }
        short = {name: int(count) for name, count in wanted.items() if count > getattr(self, name)}
        for name, count in short.items():
            setattr(self, name, WIDER * count)
        if short or self._cells > len(self.ground.middles):
            self._make_ground()
            return True
        members = min(2 * int(tally[course.PAIRS]), len(self.walk.benches.kind))
        self._bench_pairs = max(self._bench_pairs, WIDER * int(tally[course.PAIRS]))
        self._members = max(self._members, members)
        kept = self.meeting
        self._make_meeting()
        for old, new in ((kept.first, self.meeting.first), (kept.second, self.meeting.second)):
            new[: len(old)] = old
        return False

    def _enlarge_cells(self) -> None:
        """Count on more cells if all are used."""
        if int(self.ground.counts[cells.CELLS]) < self._cells or self._wanted == self._cells:
            return
        if self._cells == MOST_CELLS:
            raise UnsureError(
                _("the walk is too long to be searched: more than {most} cells of its route").format(
                    most=MOST_CELLS
                )
            )
        self._cells = min(WIDER * self._cells, MOST_CELLS)

    def aim(self, walk: course.Walk, first: float, last: float, reach: float) -> None:
        """Work on another walk from now on, of as many benches of as many kinds: to be begun.

        Its route may be of another length and fill other rows, if not more.
        """
        self.walk, self._span, self._reach, self._begun = walk, (first, last), reach, first
        self._wanted = MOST_CELLS + 1  # it is not known how many cells the route has
        self._make_ground()
