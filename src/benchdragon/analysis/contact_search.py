"""A search along a walk for pairs of benches: its steps, the kernels' search of each, and its answers.

Time enters through the head's route position alone, so that all searches run over that and hold for
any speed. No bench is assumed clear because it was looked at: what is passed over is clear by a bound
that holds in between (kernels/pair_bounds.py, design/first_contact.py).
"""

import math
import time as clock
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from benchdragon import budget
from benchdragon.analysis.distance import boxes, nearness
from benchdragon.analysis.head_times import HeadTimes
from benchdragon.analysis.nearby import checked_off, errors_at, origin_of, seen_from
from benchdragon.analysis.rounds import Rounds, Span, repeats
from benchdragon.analysis.tables import Tables, walk_tables
from benchdragon.errors import UnsureError, in_order, not_negative, of_kind
from benchdragon.i18n import _
from benchdragon.kernels import cells, course
from benchdragon.kernels import search as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.family import UNKNOWN
from benchdragon.kernels.question import MORE
from benchdragon.kernels.route import END_SLACK, IntArray
from benchdragon.kernels.walk_search import ASTRAY, CALL, CROWDED, SEARCHED, SEEK, search_walk
from benchdragon.model.answer import Answer, Status, Witness
from benchdragon.model.base_curve import Point
from benchdragon.model.placement import Placement
from benchdragon.model.walk import Walk
from benchdragon.number_format import at_most
from benchdragon.progress import Progress

# What computed distances count as off by at least, m, so that grazes end; where the bound on their
# rounding is larger (kernels/rounding.py) that counts. A larger one widens brackets.
SLACK = 1e-13
# Parts of a step narrower than this, m, are not halved: contact times get no sharper.
WIDTH = 1e-13
# Chains marched in one step of a search; a graze takes some hundred.
MOST_EVALUATIONS = 200_000
# Chains marched in one step for one of these; where benches keep the same distance for a while no
# number would do for the last.
MOST_LEAST_EVALUATIONS = 2000
# Places looked at for why a walk could not be followed.
SAMPLES_AHEAD = 65


def assumed_within(off: float) -> tuple[str, ...]:
    """What answers rest on whose distances may be off by so much, m."""
    text = _("computed distances are within {slack} m of the exact ones")
    return (text.format(slack=at_most(off)),)


def most_evaluations(handles: int) -> int:
    """Chains of so many handles that the question at hand may still march, in one step."""
    return int(min(max(budget.left() / (SEARCHED * handles), 1.0), MOST_EVALUATIONS))


def run_search(
    tables: Tables,
    goal: int,
    limits: tuple[float, float, float, int],
    note: FloatArray,
    tell: Callable[[int], None] = lambda _ending: None,
) -> int:
    """Search on for `goal`, in wider room where it is wanted; how that ended.

    `limits` and `note` are those of kernels/walk_search.py; `tell` hears how each call ended.
    """
    margin, slack, width, most = limits
    handles = len(tables.walk.benches.links) + 1
    while True:
        known, marched, most = (
            tables.work,
            note[kernel.EVALUATIONS],
            min(most, most_evaluations(handles)),
        )
        ending = search_walk(tables.walk, tables.room, goal, margin, slack, width, most, note)
        marched = float(note[kernel.EVALUATIONS] - marched) * int(tables.course.tally[course.PLACED])
        budget.spend(CALL + SEARCHED * marched + max(tables.work - known, 0.0))
        tell(ending)
        if ending == CROWDED:
            tables.widen()
        elif ending != MORE:
            return ending


@dataclass(frozen=True)
class Step:
    """A step of the head, m, and the pairs of benches (rows from 0) that may come within reach."""

    start: float
    end: float
    first: IntArray
    second: IntArray


@dataclass
class ContactSearch:
    """A search along a walk from one head position to another.

    Attributes:
        walk: as given, but with coordinates counted from `origin`.
        spans: of the head's way, m, that are searched: the whole of it, or what repeats nothing.
        origin: near the dance, m.
        slack: what computed distances count as off by at least, m.
        off: what those that mattered so far may be off by, m.
    """

    walk: Walk
    start: float  # head positions, m
    end: float
    margin: float
    progress: Progress
    since: float = -math.inf  # the time at which it begins, s
    spans: Sequence[Span] = ()
    until: float = math.inf  # the time at which it ends, s
    origin: Point = field(init=False)
    slack: float = field(default_factory=lambda: SLACK)
    off: float = 0.0
    evaluations: int = 0
    began: float = field(default_factory=clock.perf_counter)

    def __post_init__(self) -> None:
        placed = self.placement(self.start)
        self.origin = origin_of(placed.x, placed.y)
        self.walk = seen_from(self.walk, self.origin)
        self.spans = self.spans or [(self.start, self.end)]
        self._tables: Tables | None = None
        self._near, self._span = 0.0, 0

    def begin(self, reach: float) -> None:
        """Look for all pairs that come within reach, m, from the start on."""
        self._near = reach + self.slack
        self._begin_span(0)

    def again(self) -> None:
        """Begin once more with what was begun."""
        if self._span:
            self._begin_span(0)
        else:
            self.tables.again()

    def _begin_span(self, n: int) -> None:
        self._span, (first, last) = n, self.spans[n]
        tail = float(self.placement(first).s[0, -2])
        self._tables = Tables(walk_tables(self.walk), first, last, self._near, tail)
        self._tables.begin()

    @property
    def tables(self) -> Tables:
        """What it works on; made for the margin, if nothing was begun."""
        if self._tables is None:
            self.begin(self.margin)
        assert self._tables is not None
        return self._tables

    def steps(self) -> Iterator[Step]:
        """The steps in which pairs may come within reach, in order; what lies between is clear.

        Raises:
            WalkError: after the last of them, if the dragon cannot walk on to the end.
            UnsureError: likewise, if it could not be shown that it can.
        """
        note = np.zeros(kernel.NOTES)
        while self._run(SEEK, note, 0.0) == kernel.FOUND:
            yield self.step

    @property
    def step(self) -> Step:
        """The step at hand."""
        way, tally, meeting = *self.tables.course, self.tables.meeting
        count = int(tally[course.PAIRS])
        # Copies: views would keep all the room alive as long as the step.
        first, second = meeting.first[:count].copy(), meeting.second[:count].copy()
        return Step(float(way[course.STEP_START]), float(way[course.STEP_END]), first, second)

    def search(self, goal: int, note: FloatArray, tolerance: float = 0.0) -> int:
        """Search on for `goal`; how that ended: CLEAR, at the very end, or as kernels/search.py says.

        `note` is that of the kernels' search; `tolerance` is that of LEAST, m.

        Raises:
            WalkError: if the dragon cannot walk on.
            UnsureError: if it could not be shown that it can.
        """
        before = note[kernel.EVALUATIONS]
        ending = self._run(goal, note, tolerance)
        self.evaluations += int(note[kernel.EVALUATIONS] - before)
        if ending == kernel.FALLEN:
            end = float(self.tables.course.way[course.STEP_END])
            raise self.stopped(float(note[kernel.LOWER]), end)
        return ending

    def _run(self, goal: int, note: FloatArray, tolerance: float) -> int:
        """Search until it has come to something."""
        most = MOST_LEAST_EVALUATIONS if tolerance else MOST_EVALUATIONS
        limits = self.margin, tolerance or self.slack, WIDTH, most
        ending = run_search(self.tables, goal, limits, note, self._tell)
        while ending == kernel.CLEAR and self._span + 1 < len(self.spans):
            self._begin_span(self._span + 1)
            ending = run_search(self.tables, goal, limits, note, self._tell)
        self.note_off(float(note[kernel.OFF]))
        if ending == ASTRAY:
            raise self._astray()
        if ending == kernel.CLEAR and self.end > self.walk.route.length + END_SLACK:
            raise self.stopped(self.walk.route.length, self.end)
        return ending

    def _tell(self, ending: int) -> None:
        """Tell how far a call has come."""
        if ending == MORE:
            at = float(self.tables.course.way[course.AT])
            self.progress((at - self.start) / (self.end - self.start), "")

    def _astray(self) -> Exception:
        """Why benches were not shown to follow."""
        at, sound = self.tables.course.way[[course.AT, course.SOUND]].tolist()
        if at < sound:
            return self.stopped(at, sound)
        return self.stopped(sound, sound + 2.0 * float(self.tables.ground.measures[cells.CELL]))

    def stopped(self, sound: float, until: float) -> Exception:
        """Why the walk could not be followed past head position `sound`, looked for up to `until`."""
        # A bench may stand square to the route for a tenth of a millimetre only, and then leap.
        ahead = np.geomspace(UNKNOWN, max(min(until, self.end) - sound, UNKNOWN), SAMPLES_AHEAD)
        error = self.walk.first_failure(np.concatenate([[sound], sound + ahead]))
        if error is not None and error.head <= sound + 2.0 * UNKNOWN:
            return error
        return UnsureError(
            _("past t = {t} s it could not be shown that every bench follows without a leap").format(
                t=f"{self.times.at(sound):.6g}"
            )
        )

    def placement(self, s: npt.ArrayLike) -> Placement:
        """The dragon with its head at s, whether it can stand there or not."""
        return self.walk.placement(s, throw=False)

    def witness(self, s: float, i: int, j: int) -> Witness:
        """How benches i and j (rows, from 0) stand with the head at s."""
        near = nearness(boxes(self.placement(s), 0), i, j)
        owner = near.features[0][0]
        x, y = near.points[near.benches.index(owner)]
        point = x + self.origin[0], y + self.origin[1]
        return Witness(self.times.at(s), s, near.benches, point, near.distance, near.features)

    def note_off(self, off: float) -> None:
        """Take note of what a distance that matters may be off by, m.

        Raises:
            UnsureError: if that is too much for a search to see all pairs.
        """
        self.off = max(self.off, off if off <= self.slack else checked_off(off))

    def off_at(self, s: float, i: int, j: int) -> float:
        """What the distance of benches i and j (rows, from 0) may be off by with the head at s, m."""
        _errors, off = errors_at(self.walk, s)
        return max(self.slack, float(off[i] + off[j]))

    def pair(self, note: FloatArray) -> tuple[int, int]:
        """The benches (rows, from 0) of a kernel's note."""
        i, j = divmod(int(note[kernel.PAIR]), len(self.walk.dragon))
        return i, j

    def answer_at(self, lower: float, upper: float, status: Status, i: int, j: int) -> Answer:
        """A time between those at which the head is at lower and at upper, benches i and j meeting."""
        value, early, late, status = self.times.told(lower, upper, status)
        seconds = clock.perf_counter() - self.began
        witness = self.witness(upper, i, j)
        return Answer(
            value, early, late, "s", status, witness, self.assumed(), self.evaluations, seconds
        )

    def assumed(self) -> tuple[str, ...]:
        """What answers rest on."""
        return assumed_within(max(self.off, self.slack))

    @property
    def times(self) -> HeadTimes:
        """When the head comes to positions of the search."""
        return HeadTimes(self.walk, self.start, self.since, self.until)


def contact_search(
    walk: Walk,
    start: float,
    end: float,
    margin: float,
    progress: Progress,
    *,
    whole: bool = False,
) -> ContactSearch:
    """A search of the walk from start to end (s), for which the dragon must stand at the start.

    Of the whole of it, or but of what repeats nothing before it: see `rounds`.
    """
    of_kind("walk", walk, Walk)
    not_negative("margin", margin, "m")
    in_order(start, end)
    walk.motion([start])  # raises where the dragon cannot stand at the start
    a, b = walk.head_position([start, end]).tolist()
    spans = [(a, b)] if whole else Rounds(walk, repeats(walk.route.rows)).new(a, b)[0]
    return ContactSearch(walk, a, b, margin, progress, start, spans, end)
