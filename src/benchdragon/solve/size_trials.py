"""Walks of a plan in which one size varies: how each went, and near which size a pair just touches."""

import math
import time as clock
from dataclasses import dataclass, field, replace

from benchdragon.analysis.contact import MOST_SAMPLED, first_contact, least_clearance
from benchdragon.analysis.distance import low_pair, low_point
from benchdragon.errors import InputError, UnsureError, WalkError
from benchdragon.i18n import N_, _
from benchdragon.model.answer import Witness
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan
from benchdragon.plans.toml import PlanError

# Brackets are at most so wide, m.
TOLERANCE = 1e-12
# A pair that comes no nearer than this beyond the margin, m, is no hint where the limit lies.
NEARBY = 0.1
# The secant method: its first step, the least from which a slope is taken, when it has come to rest,
# and how far it may go at once, all relative; steps at most.
FIRST_STEP, SHARP, SETTLED, LONGEST_SECANT, MOST_SECANTS = 1e-5, 1e-7, 1e-15, 1.1, 40
# How near to a root of a pair, as a share of the bracket's width, counts likewise.
AT_REST = 1e-4


@dataclass(frozen=True)
class Question:
    """A size of a plan whose limit is sought.

    Attributes:
        name: what the command line calls it.
        keys: the plan's keys that hold it.
        sense: +1 where larger sizes are safer, -1 where smaller ones are.
        text: what the answer is, in words.
    """

    name: str
    keys: tuple[str, ...]
    sense: float
    text: str


QUESTIONS = {
    question.name: question
    for question in (
        Question("pitch", ("route.pitch",), 1.0, N_("smallest pitch")),
        Question("disc", ("disc.radius",), 1.0, N_("smallest disc radius")),
        Question("width", ("dragon.width",), -1.0, N_("widest bench")),
        Question("length", ("dragon.body_length", "dragon.tail_length"), -1.0, N_("longest bench")),
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


@dataclass(frozen=True)
class Trial:
    """How a walk of one size went: whether it stays clear, and the pair that decides.

    `clear` is None where that could not be decided.
    """

    size: float
    clear: bool | None
    meeting: Meeting | None
    evaluations: int
    seconds: float


@dataclass
class Family:
    """The walks of a plan in which one size varies."""

    plan: Plan
    question: Question
    margin: float
    tolerance: float = TOLERANCE
    _last: tuple[float, tuple[Walk, float, float]] | None = field(
        default=None, init=False, repr=False, compare=False
    )

    @property
    def first(self) -> float:
        """The plan's own size, from which the search begins."""
        return self.plan.value(self.question.keys[0])

    def walk(self, size: float) -> tuple[Walk, float, float]:
        """The walk of a size, and the times between which it must stay clear.

        The last one is kept: searches ask for a walk several times before they try another size.
        """
        if self._last is None or self._last[0] != size:
            plan = self.plan
            for key in self.question.keys:
                plan = plan.with_value(key, size)
            walk = plan.build()
            self._last = size, (walk, *plan.span(walk))
        return self._last[1]

    def trial(self, size: float) -> Trial:
        """Walk it; what cannot be walked is not clear."""
        began = clock.perf_counter()
        meeting, evaluations, clear = None, 0, None
        try:
            walk, start, end = self.walk(size)
            contact = first_contact(walk, start, end, margin=self.margin)
            clear = contact is None
            if contact is not None and contact.witness is not None:
                meeting, evaluations = meeting_of(walk, end, contact.witness), contact.evaluations
        except (WalkError, InputError, PlanError):
            clear = False
        except UnsureError:
            clear = None
        return Trial(size, clear, meeting, evaluations, clock.perf_counter() - began)

    def tightest(self, size: float) -> Meeting | None:
        """About where which pair comes nearest in a walk; None if none comes near."""
        walk, start, end = self.walk(size)
        if 3 <= len(walk.dragon) <= MOST_SAMPLED:
            return self.low_meeting(walk, start, end)
        within = self.margin + NEARBY
        near = least_clearance(walk, start, end, within=within, tolerances=(math.inf,))
        return None if near.witness is None else meeting_of(walk, end, near.witness)

    def deepest(self, failed: Trial, before: Meeting | None) -> Meeting | None:
        """The pair to go by after a failure: the deepest, or the first if that was gone by before."""
        if failed.meeting is None:  # nothing met: there may be no such walk
            return None
        walk, start, end = self.walk(failed.size)
        if len(walk.dragon) > MOST_SAMPLED:
            return failed.meeting
        deepest = self.low_meeting(walk, start, end)
        if deepest is None or (before and (deepest.i, deepest.j) == (before.i, before.j)):
            return failed.meeting
        return deepest

    def low_meeting(self, walk: Walk, start: float, end: float) -> Meeting | None:
        """About where which pair is nearest or deepest between two times; None if none comes near."""
        first, last = walk.head_position([start, end]).tolist()
        distance, s, i, j = low_pair(walk, first, last)
        return Meeting(s, last - s, i, j) if distance <= self.margin + NEARBY else None

    def low_point(self, size: float, meeting: Meeting) -> tuple[float, Meeting]:
        """The least distance of a pair near a meeting, less the margin, m, and the meeting there.

        What is near is within one and a half links, as far as the walk goes. In the walk of another
        size that is as far from the start, or from the end: whichever is nearer to touching.
        """
        try:
            walk, start, end = self.walk(size)
        except (InputError, PlanError):
            return math.nan, meeting
        first, last = walk.head_position([start, end]).tolist()
        dragon = walk.dragon
        near = 1.5 * float(max(dragon.links[meeting.i], dragon.links[meeting.j]))
        centres = [meeting.s]
        if abs(last - meeting.left - meeting.s) > 0.1 * near:
            centres.append(last - meeting.left)
        least, where = min(
            low_point(walk, meeting.i, meeting.j, max(first, centre - near), min(last, centre + near))
            for centre in centres
        )
        distance = least - self.margin if math.isfinite(least) else math.nan
        return distance, replace(meeting, s=where, left=last - where)


def meeting_of(walk: Walk, end: float, witness: Witness) -> Meeting:
    """About where benches meet, as a witness says, in a walk until `end`, s."""
    i, j = (number - 1 for number in witness.benches)
    return Meeting(witness.s, float(walk.head_position([end])[0]) - witness.s, i, j)


def root_near(family: Family, meeting: Meeting, size: float) -> tuple[float, float, Meeting] | None:
    """The size, near `size`, at which the meeting's pair just keeps the margin; slope there, and where.

    The secant method on the pair's least distance near the meeting, m per unit of size; None if it
    does not come to rest.
    """
    a, b = size, size * (1.0 + family.question.sense * FIRST_STEP)
    slope = math.nan
    fa, meeting = family.low_point(a, meeting)
    for _step in range(MOST_SECANTS):
        fb, meeting = family.low_point(b, meeting)
        if not math.isfinite(fb) or fb == fa or b <= 0.0:
            return None
        if abs(b - a) > SHARP * abs(a):
            slope = (fb - fa) / (b - a)
        a, fa, b = b, fb, min(max(b - fb / slope, b / LONGEST_SECANT), b * LONGEST_SECANT)
        if abs(b - a) <= max(SETTLED * abs(a), AT_REST * family.tolerance):
            return b, slope, meeting
    return None
