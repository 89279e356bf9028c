"""Dragons and routes on which searches and bounds are tried, and searches that may be looked into."""

import math
import weakref
from collections.abc import Iterator
from dataclasses import dataclass

import pytest

from benchdragon import Arc, Bench, Clothoid, Dragon, Line, LogSpiral, Route, Spiral, Walk
from benchdragon.analysis.contact_search import SLACK, ContactSearch
from benchdragon.kernels import contact_steps, memory, question, workspace
from benchdragon.kernels.contact_memory import BASE, ContactGiven, ContactTold, Hunt
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.question import QuestionEnding, Told
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.search_room import RoomEnding
from benchdragon.kernels.search_start import begin_walk
from benchdragon.kernels.time_of_impact import Ending, Note
from benchdragon.kernels.walk_search import WalkGoal
from benchdragon.kernels.workspace import Course, WalkTally
from benchdragon.progress import silent
from tests.solve.asked_in_python import in_python

BENCHES = [Bench(1.6, 0.4, 0.1, 0.2), *[Bench(1.1, 0.3, 0.1, 0.1)] * 5]
ROUTES = {
    "spiral": (Route((Spiral(0.9, 40.0, 8.0),)), 12.0),
    "arc": (Route.joined([Line(12.0), Arc(1.6, 5.0), Line(9.0)]), 14.0),
    "joint": (Route.joined([Line(12.0), Arc(1.6, 1.0), Arc(2.0, -1.5), Line(9.0)]), 12.9),
    "clothoid": (Route.joined([Line(12.0), Clothoid(3.0, 0.0, 0.6), Arc(1.0 / 0.6, 3.0)]), 15.5),
    "logarithmic spiral": (Route.joined([Line(12.0), LogSpiral(5.0, 0.1, 0.8), Arc(1.25, 3.0)]), 16.5),
    "kink": (
        Route((Line(12.0), Line(9.0).moved((12.0, 0.0), 0.4)), kinks=True),
        11.97,
    ),
}

SMOOTH = [name for name in ROUTES if name != "kink"]


@dataclass(frozen=True)
class Step:
    """A step of the head, m, and the pairs of benches (rows from 0) that may come within reach."""

    start: float
    end: float
    first: IntArray
    second: IntArray


class Searched:
    """A search of a walk between two head positions, m, in Python: one may look into its room."""

    def __init__(
        self, walk: Walk, start: float, end: float, margin: float = 0.0, slack: float = SLACK
    ) -> None:
        with pytest.MonkeyPatch.context() as patch:
            in_python(patch)
            self.asked = ContactSearch(walk, start, end, margin, silent, slack=slack)
        handle = self.asked._handle
        self.asked._close.detach()
        weakref.finalize(
            self, getattr(question.close_question, "__wrapped__", question.close_question), handle
        )
        self.block, self._margin = memory.recall(handle), margin

    @property
    def hunt(self) -> Hunt:
        """What lies in its block, for now."""
        return memory.group_at(Hunt, self.block + BASE)

    @property
    def room(self) -> workspace.Workspace:
        """What it works on, for now; made for the margin, if nothing was begun."""
        if not self.hunt.figures[ContactTold.READY]:
            self.begin(self._margin)
        return self.hunt.room

    def begin(self, reach: float) -> None:
        """Look for all pairs that come within reach, m, from the start on."""
        assert contact_steps.begun(self.block, reach) == RoomEnding.ROOMY

    def go(self, start: float, end: float) -> None:
        """Let it begin at head position start, m, and end at `end`, both within the first ones."""
        self.room.course.way[Course.GOAL], self.hunt.figures[ContactTold.BEGUN] = end, start
        assert contact_steps.begun_again(self.block) == RoomEnding.ROOMY

    def steps(self) -> Iterator[Step]:
        """The steps in which pairs may come within reach, in order.

        Raises:
            WalkError: after the last of them, if the dragon cannot walk on to the end.
        """
        if not self.hunt.figures[ContactTold.READY]:
            self.begin(self._margin)
        with pytest.MonkeyPatch.context() as patch:
            in_python(patch)
            while self.asked.find(WalkGoal.SEEK) == Ending.FOUND:
                meeting, count = self.room.meeting, int(self.room.course.tally[WalkTally.PAIRS])
                start, end = self.room.course.way[[Course.STEP_START, Course.STEP_END]].tolist()
                yield Step(start, end, meeting.first[:count].copy(), meeting.second[:count].copy())

    def search(self, goal: int, note: FloatArray, tolerance: float = 0.0) -> int:
        """Search on for a goal of kernels/time_of_impact.py; how that ended; `note` tells more."""
        if not self.hunt.figures[ContactTold.READY]:
            self.begin(self._margin)
        self.hunt.note[:] = note
        self.hunt.figures[ContactTold.LEFT] = self.hunt.limits[ContactGiven.MOST]
        ending = QuestionEnding.MORE
        while ending == QuestionEnding.MORE:
            slack = tolerance or float(self.hunt.limits[ContactGiven.LEAST_OFF])
            ending = contact_steps.searched_on(self.block, goal, slack, math.inf, Told.SPENT)
        note[:] = self.hunt.note
        return ending

    def pair(self, note: FloatArray) -> tuple[int, int]:
        """The benches (rows, from 0) of a note."""
        contact_steps.set_pair(self.hunt, float(note[Note.PAIR]))
        first, second = self.hunt.figures[[ContactTold.FIRST_BENCH, ContactTold.SECOND_BENCH]].tolist()
        return int(first), int(second)


def begun_without_spans(
    walk: workspace.Walk, room: workspace.Workspace, start: float, end: float, reach: float
) -> bool:
    """Begin a search that knows of no span in which benches keep apart."""
    begun = begin_walk(walk, room, start, end, reach)
    assert (room.ground.spans[:, 0] < room.ground.spans[:, 1]).any()
    room.ground.spans[:] = math.inf, -math.inf
    return begun


def searched(
    dragon: Dragon, route: Route, span: tuple[float, float], reach: float, slack: float = 1e-13
) -> Searched:
    """A search of a walk that has looked for all steps in which pairs may come within reach."""
    found = Searched(Walk(dragon, route), *span, slack=slack)
    found.begin(reach)
    assert all(step.start < step.end for step in found.steps())
    return found
