"""Walks of a plan in which one size varies, and the kernels' search for the size that it may have."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import assert_never

import numpy as np

from benchdragon.analysis import distance
from benchdragon.analysis.contact_search import MOST_EVALUATIONS, SLACK, WIDTH, run_search, slack_at
from benchdragon.analysis.obstacles import ObstacleSearch, touching
from benchdragon.analysis.tables import PLACES, Tables, kinds_of, walk_tables
from benchdragon.errors import InputError, UnsureError, WalkError
from benchdragon.i18n import N_, _
from benchdragon.kernels import family as sizes_of
from benchdragon.kernels import search as steps
from benchdragon.kernels import size_bracket as bracket
from benchdragon.kernels import size_search as kernel
from benchdragon.kernels.box import BOX_COLUMNS, nearest_pair
from benchdragon.kernels.course import AT, SOUND, Benches
from benchdragon.kernels.course import Walk as KernelWalk
from benchdragon.kernels.curve import COLUMNS, LENGTH, MOST_METRES, S_START, FloatArray
from benchdragon.kernels.family import falls_soon, set_walk
from benchdragon.kernels.low_points import SHRINKS, low_pair, low_point
from benchdragon.kernels.route import END_SLACK
from benchdragon.kernels.route_parts import PART_COLUMNS
from benchdragon.kernels.spiral import LANES
from benchdragon.kernels.step_bounds import empty_placements, place_chain
from benchdragon.kernels.turn_families import ARCS, MOST_PIECES
from benchdragon.kernels.walk_search import ASTRAY
from benchdragon.model.answer import Answer, Witness
from benchdragon.model.walk import Walk
from benchdragon.plans.routes import (
    FITS,
    DrawnRoute,
    FormationRoute,
    PartsRoute,
    ProgrammeRoute,
    SpiralInRoute,
    TurnRoute,
)
from benchdragon.plans.schema import Plan
from benchdragon.plans.tables import LEAST, LEAST_PITCH, ROOMY
from benchdragon.plans.toml import PlanError
from benchdragon.progress import Progress

# Brackets are at most so wide, m.
TOLERANCE = 1e-12
# How often a bracket is widened until a bench surely touches an obstacle at its end.
MOST_WIDENINGS = 30
# Head positions at which a pair is looked at, at least.
FEWEST = 4


@dataclass(frozen=True)
class Question:
    """A size of a plan whose limit is sought.

    Attributes:
        name: what the command line calls it.
        keys: the plan's keys that hold it.
        sense: +1 where larger sizes are safer, -1 where smaller ones are.
        text: what the answer is, in words.
        what: the kernels' number of it.
    """

    name: str
    keys: tuple[str, ...]
    sense: float
    text: str
    what: int


QUESTIONS = {
    question.name: question
    for question in (
        Question("pitch", ("route.pitch",), 1.0, N_("smallest pitch"), sizes_of.PITCH),
        Question("disc", ("disc.radius",), 1.0, N_("smallest disc radius"), sizes_of.DISC),
        Question("width", ("dragon.width",), -1.0, N_("widest bench"), sizes_of.WIDTH),
        Question(
            "length",
            ("dragon.body_length", "dragon.tail_length"),
            -1.0,
            N_("longest bench"),
            sizes_of.BENCH,
        ),
    )
}


def question(name: str) -> Question:
    """The question of that name.

    Raises:
        InputError: if there is none.
    """
    if not isinstance(name, str) or name not in QUESTIONS:
        raise InputError(
            _("wanted one of {known}, not {name}").format(known=", ".join(QUESTIONS), name=name)
        )
    return QUESTIONS[name]


@dataclass(frozen=True)
class Meeting:
    """Benches i and j (rows, from 0) of a walk whose head stands at s, m, `left` before its end."""

    s: float
    left: float
    i: int
    j: int

    def windows(self, links: FloatArray, first: float, last: float) -> Iterator[tuple[float, float]]:
        """Spans of head positions near it, in a walk from first to last, m.

        What is near is within one and a half links. The walk may be that of another size: then it is
        as far from its start as the meeting, and as far from its end.
        """
        near = 1.5 * float(max(links[self.i], links[self.j]))
        yield max(first, self.s - near), min(last, self.s + near)
        other = last - self.left
        if abs(other - self.s) > 0.1 * near:
            yield max(first, other - near), min(last, other + near)


@dataclass
class PlanFamily:
    """The walks of a plan in which one size varies."""

    plan: Plan
    question: Question
    margin: float
    tolerance: float = TOLERANCE
    _last: tuple[float, tuple[Walk, float, float]] | None = field(
        default=None, init=False, repr=False, compare=False
    )

    def __post_init__(self) -> None:
        """Let the head of a formation start where it does with the plan's own benches.

        Raises:
            InputError: for sizes of formations, which the kernels do not know.
        """
        if not isinstance(self.plan.route, FormationRoute | ProgrammeRoute):
            return
        if self.question.name == "pitch":
            raise InputError(
                _(
                    "the smallest pitch of a formation is not sought: see by a sweep over its pitch "
                    "what clearance each leaves"
                )
            )
        if self.plan.walk.position is None:
            self.plan = self.plan.with_value("walk.position", self.plan.build().start)

    @property
    def first(self) -> float:
        """The plan's own size, from which the search begins."""
        return self.plan.value(self.question.keys[0])

    def walk(self, size: float) -> tuple[Walk, float, float]:
        """The walk of a size, and the times between which it must stay clear.

        The last one is kept: who shows a size asks for its walk several times.
        """
        if self._last is None or self._last[0] != size:
            plan = self.plan
            for key in self.question.keys:
                plan = plan.with_value(key, size)
            walk = plan.build()
            self._last = size, (walk, *plan.span(walk))
        return self._last[1]

    def low_point(self, size: float, meeting: Meeting) -> tuple[float, Meeting]:
        """The least distance of a pair near a meeting, less the margin, m, and the meeting there.

        In the walk of another size that is as far from the start, or from the end: whichever is nearer
        to touching.
        """
        try:
            walk, start, end = self.walk(size)
        except (InputError, PlanError):
            return math.nan, meeting
        first, last = walk.head_position([start, end]).tolist()
        least, where = min(
            distance.low_point(walk, meeting.i, meeting.j, low, high)
            for low, high in meeting.windows(walk.dragon.links, first, last)
        )
        room = least - self.margin if math.isfinite(least) else math.nan
        return room, replace(meeting, s=where, left=last - where)


def meeting_of(walk: Walk, end: float, witness: Witness) -> Meeting:
    """About where benches meet, as a witness says, in a walk until `end`, s."""
    i, j = (number - 1 for number in witness.benches)
    return Meeting(witness.s, float(walk.head_position([end])[0]) - witness.s, i, j)


def kernel_numbers(plan: Plan, question: Question) -> FloatArray:
    """What the kernels are told of a plan: see kernels/family.py."""
    route, turn, profile, walk = plan.route, plan.turn, plan.profile(), plan.walk
    pitch, disc = math.nan, _or_nan(plan.disc.radius)
    kind, least = sizes_of.FIXED, LEAST_PITCH if question.what == sizes_of.PITCH else LEAST
    start, clockwise = math.nan, True
    if isinstance(route, SpiralInRoute):
        kind, pitch, start = sizes_of.SPIRAL_IN, route.pitch, route.start_turn
        clockwise = route.clockwise
    elif isinstance(route, TurnRoute):
        kind, pitch, disc = sizes_of.TURN, route.pitch, route.disc(plan)
    elif not isinstance(route, PartsRoute | DrawnRoute | FormationRoute | ProgrammeRoute):
        assert_never(route)
    radii = turn.radii or (math.nan, math.nan)
    numbers = {
        sizes_of.WHAT: question.what,
        sizes_of.ROUTE: kind,
        sizes_of.PITCH_SIZE: pitch,
        sizes_of.DISC_RADIUS: disc,
        sizes_of.START_TURN: start,
        sizes_of.HANDED: 1.0 if clockwise else -1.0,
        sizes_of.TURN_FAMILY: sizes_of.ARC_ARC if turn.family == "arc-arc" else sizes_of.THREE_PIECES,
        sizes_of.ENTRY_RADIUS: _or_nan(turn.entry_radius),
        sizes_of.EXIT_RADIUS: _or_nan(turn.exit_radius),
        sizes_of.RATIO: turn.ratio,
        sizes_of.FIRST_RADIUS: radii[0],
        sizes_of.LAST_RADIUS: radii[1],
        sizes_of.BEND: turn.curvature if turn.family == "arc-arc-arc" else 0.0,
        sizes_of.EASE: turn.ease,
        sizes_of.POSITION: _or_nan(walk.position),
        sizes_of.BEGIN_WAY: float(profile.distance(walk.start or 0.0)),
        sizes_of.END_WAY: math.nan if walk.end is None else float(profile.distance(walk.end)),
        sizes_of.MOST_WAY: float(profile.distance(math.inf)),
        sizes_of.LEAST_SIZE: least,
        sizes_of.MOST_SIZE: MOST_METRES,
        sizes_of.ROOMY: ROOMY,
        sizes_of.FITS: FITS,
    }
    return np.array([numbers[n] for n in range(sizes_of.NUMBERS)], dtype=np.float64)


def _or_nan(value: float | None) -> float:
    return math.nan if value is None else value


def kernel_family(family: PlanFamily, walk: Walk) -> tuple[sizes_of.Family, KernelWalk]:
    """A family as kernels want it, and room for its walks; `walk` is one of them."""
    name, dragon, rows = family.question.name, walk.dragon, walk.route.rows
    share = np.zeros(len(dragon))
    if name == "width":
        share[:] = 1.0
    elif name == "length":
        share[1:] = 1.0
    row = 1 if name == "width" else 0
    marked = dragon.sizes.copy()  # benches of the same sizes of which one alone varies are two kinds
    marked[row, share > 0.0] = marked[row].max() + 1.0
    kind, kinds = kinds_of(marked)
    benches = walk_tables(walk).benches
    own = Benches(
        benches.links.copy(), benches.sizes.copy(), kind, benches.ahead.copy(), benches.lever.copy()
    )
    made = sizes_of.Family(
        kernel_numbers(family.plan, family.question),
        np.empty((MOST_PIECES + 2, PART_COLUMNS)),
        np.empty((ARCS, 2)),
        np.empty((MOST_PIECES, 3)),
        dragon.sizes,
        share,
    )
    return made, KernelWalk(rows.copy(), own, kinds)


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
        return Tables(self._walk, *self._ends, self._margin + SLACK, tail, logs=False)

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
            result = self._tried(size)
            return self._tried_obstacles(size) if result == bracket.PASSES else result
        except UnsureError:
            return bracket.UNDECIDED

    def _tried_obstacles(self, size: float) -> int:
        """How the walk of a size goes whose benches keep clear of one another.

        One that comes within rounding of an obstacle fails: see `surely_bad`.
        """
        walk, start, end = self._plans.walk(size)
        for obstacle in self._obstacles:
            try:
                search = ObstacleSearch(walk, obstacle, start, end)
                found = touching(search)
            except WalkError:
                return self._failed_alone()
            self.evaluations += search.evaluations
            if found:
                self.blocked = size, found[-1]
                return self._failed_alone()
        return bracket.PASSES

    def surely_bad(self, good: float, bad: float) -> float:
        """The size of a bracket that does not pass; beyond one that is within rounding of an obstacle.

        Raises:
            UnsureError: if no such size was found.
        """
        for _widening in range(MOST_WIDENINGS):
            if self.blocked is None or self.blocked[0] != bad or self.blocked[1].status == "found":
                return bad
            bad += 2.0 * (bad - good)
            if self.trial(bad) == bracket.PASSES:
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
        extent = float(np.abs([places.x[:, 0], places.y[:, 0]]).max())
        slack = slack_at(extent)
        if first == last:
            return self._standing(first, slack)
        tables.aim(self._walk._replace(rows=rows), first, last, self._margin + slack)
        tables.begin()
        return self._searched(last, slack)

    def _failed_alone(self) -> int:
        """That a walk fails in which no two benches met."""
        self._meetings[kernel.FAILED, kernel.MEET_FRONT] = kernel.NOBODY
        return bracket.FAILS

    def _standing(self, s: float, slack: float) -> int:
        """How a dragon that stands still passes, which is placed in the first slot."""
        places = self._scratch[1]
        x, y = (np.ascontiguousarray(column[:, :1]) for column in (places.x, places.y))
        apart, _time, i, j = nearest_pair(self._walk.benches.sizes, x, y)
        if apart > self._margin - slack:
            return bracket.PASSES
        self._meetings[kernel.FAILED] = s, 0.0, i, j
        return bracket.FAILS

    def _searched(self, last: float, slack: float) -> int:
        """How the walk goes for which the tables are made."""
        note, tables = np.zeros(steps.NOTES), self._tables
        ending = run_search(
            tables, steps.FIRST_TOUCH, (self._margin, slack, WIDTH, MOST_EVALUATIONS), note
        )
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
