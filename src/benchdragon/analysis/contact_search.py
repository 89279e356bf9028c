"""Continuous collision detection of pairs of benches along a walk: the engine's question and answers.

Time enters through the head's route position alone, so that all searches run over that and hold for
any speed. No interval is skipped because its ends are clear: it is skipped by a lower bound of
separation over the interval (kernels/separation_bounds.py, design/first_contact.py).
"""

import math
import time as clock
from collections.abc import Sequence

import numpy as np

from benchdragon import budget
from benchdragon.analysis import tables
from benchdragon.analysis.distance import Nearness, nearness_at, nearness_of
from benchdragon.analysis.engine_question import EngineQuestion
from benchdragon.analysis.head_times import HeadTimes
from benchdragon.analysis.nearby import checked_off, must_stand, origin_at, seen_from
from benchdragon.analysis.rounds import Rounds, Span, repeats
from benchdragon.errors import UnsureError, in_order, not_negative, of_kind
from benchdragon.i18n import _
from benchdragon.kernels import contact_memory as told
from benchdragon.kernels import contact_question as kernel
from benchdragon.kernels.contact_memory import ContactEnding, ContactGiven, ContactTold
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.family import UNKNOWN
from benchdragon.kernels.nearness import NEARNESS
from benchdragon.kernels.question import QuestionEnding
from benchdragon.model.answer import Answer, Status, Witness
from benchdragon.model.base_curve import Point
from benchdragon.model.walk import Walk
from benchdragon.number_format import at_most
from benchdragon.progress import Progress

# Least error assumed of computed distances, m, so that grazes end; where the bound on their rounding is
# larger (kernels/rounding.py) that counts. A larger one widens brackets.
SLACK = 1e-13
# Intervals narrower than this, m, are not bisected: contact times get no sharper.
WIDTH = 1e-13
# Chains marched in one step of a search; a graze takes some hundred.
MOST_EVALUATIONS = 200_000
# Chains marched in one step for one of these; where benches keep the same distance for a while no
# number would do for the last.
MOST_LEAST_EVALUATIONS = 2000
# Least clearances are bracketed to the first of these, m, that benches which keep one distance for a
# while allow.
TOLERANCES = (1e-12, 1e-8, 1e-5, 1e-3)
# What the first of these may take beside a question, as a share of its work, and each of the others:
# those are for benches that keep one distance, and a bracket is refined while that is cheap.
REFINING, REFINING_ON = 0.25, 0.05
# Growth of the steps ahead in which the place is sought at which a walk could not be continued.
FARTHER_AHEAD = 1.25


def assumed_within(off: float) -> tuple[str, ...]:
    """The assumption of answers whose distances may be off by so much, m."""
    text = _("computed distances are within {slack} m of the exact ones")
    return (text.format(slack=at_most(off)),)


def witness_of(near: Nearness, origin: Point, time: float, s: float) -> Witness:
    """How two benches stand at a time, s, with the head at s, seen from an origin, m."""
    owner = near.features[0][0]
    x, y = near.points[near.benches.index(owner)]
    return Witness(time, s, near.benches, (x + origin[0], y + origin[1]), near.distance, near.features)


class ContactSearch(EngineQuestion):
    """A search along a walk from one head position to another.

    Args:
        walk: the walk that is searched.
        start: head position at which the search starts, m.
        end: head position at which it ends, m.
        margin: distance that benches must keep, m.
        progress: is called with the share done.
        since: the time at which it begins, s.
        spans: of the head's way, m, that are searched: the whole of it, or what repeats nothing.
        until: the time at which it ends, s.
        tolerances: widths of brackets of the least distance, m: the first that can be.
        slack: least error assumed of computed distances, m; None: SLACK.

    Attributes:
        walk: as given, but with coordinates counted from `origin`.
        origin: near the dance, m.
        times: when the head comes to positions of the search.
    """

    def __init__(
        self, walk: Walk, start: float, end: float, margin: float, progress: Progress,
        since: float = -math.inf, spans: Sequence[Span] = (), until: float = math.inf,
        tolerances: Sequence[float] = (), slack: float | None = None,
    ) -> None:  # fmt: skip
        origin = origin_at(walk, start)
        seen, ways = seen_from(walk, origin), spans or [(start, end)]
        slack = SLACK if slack is None else slack
        dragon, limits = walk.dragon, _limits(margin, slack, start, end)
        asked = told.ContactAsked(
            seen.route.rows, dragon.links, dragon.sizes, np.array([dragon.lever]), np.array(ways),
            limits, np.array(tolerances, dtype=np.float64), tables.beginnings(),
        )  # fmt: skip
        handle = kernel.open_contact(asked)
        if handle < 0:
            raise tables.too_many_kinds(dragon.sizes)
        near, figures = np.empty(NEARNESS), np.zeros(told.CONTACT_FIGURES)
        super().__init__(handle, kernel.step_contact, kernel.read_contact, figures, near)
        self.walk, self.origin, self._near = seen, origin, near
        self.start, self.end, self.progress, self.spans, self.slack = start, end, progress, ways, slack
        self.times = HeadTimes(seen, start, since, until)
        self._began = clock.perf_counter()

    def find(self, goal: int, said: Sequence[float] = (0.0,)) -> int:
        """Continue the search for a goal of kernels/contact_question.py; return its exit status.

        Raises:
            WalkError: if the dragon cannot walk on.
            UnsureError: if it could not be shown that it can, or rounding hides too much.
        """
        kernel.seek_contact(self._handle, goal, np.array(said, dtype=np.float64))
        while (ending := self.step()) == QuestionEnding.MORE:
            (at,) = self.tell(ContactTold.WALKED)
            self.progress((at - self.start) / (self.end - self.start), "")
        if ending == ContactEnding.STOPPED:
            raise self.stopped(*self.tell(ContactTold.SOUND_TO, ContactTold.UNTIL))
        if ending == ContactEnding.UNSHOWN:
            raise UnsureError(_("it could not be shown that the dragon stands all along"))
        if ending == ContactEnding.ENDLESS:
            text = _("the walk is too long to be searched: more than {most} cells of its route")
            raise UnsureError(text.format(most=tables.MOST_CELLS))
        if ending == ContactEnding.BLURRED:
            checked_off(self.off)
        return ending

    def stopped(self, sound: float, until: float) -> Exception:
        """Why the walk could not be followed past head position `sound`, sought up to `until`."""
        # A bench may stand square to the route for a tenth of a millimetre only, and then leap.
        reach, at, ahead = max(min(until, self.end) - sound, UNKNOWN), [sound], UNKNOWN
        while ahead < reach:
            at.append(sound + ahead)
            ahead *= FARTHER_AHEAD
        error = self.walk.first_failure(np.array([*at, sound + reach]))
        if error is not None and error.head <= sound + 2.0 * UNKNOWN:
            return error
        text = _("past t = {t} s it could not be shown that every bench follows without a leap")
        return UnsureError(text.format(t=f"{self.times.at(sound):.6g}"))

    @property
    def off(self) -> float:
        """Error bound of the distances that mattered so far, m."""
        return max(float(self.figures[ContactTold.OFF_BY]), self.slack)

    def witness(self) -> Witness:
        """The witness: how the benches found are placed."""
        (s,) = self.tell(ContactTold.LATE)
        return witness_of(nearness_of(self._near.tolist()), self.origin, self.times.at(s), s)

    def answer(
        self, bracket: tuple[float, float, float], unit: str, status: Status, seen: bool = True
    ) -> Answer:
        """An answer of a value, the ends of its bracket and a unit; with a witness if it was `seen`."""
        witness = self.witness() if seen else None
        marched, seconds = int(self.figures[ContactTold.MARCHED]), clock.perf_counter() - self._began
        return Answer(*bracket, unit, status, witness, assumed_within(self.off), marched, seconds)

    def moment(self, status: Status) -> Answer:
        """The time at which the benches are placed as found."""
        early, late, behind, ahead = self.tell(
            ContactTold.EARLY, ContactTold.LATE, ContactTold.EARLY_LEAD, ContactTold.LATE_LEAD
        )
        value, lower, upper, known = self.times.told(early, late, status, (behind, ahead))
        return self.answer((value, lower, upper), "s", known)


def _limits(margin: float, slack: float, start: float, end: float) -> FloatArray:
    """The question's limits, as arguments of the engine."""
    named = {
        ContactGiven.MARGIN: margin,
        ContactGiven.LEAST_OFF: slack,
        ContactGiven.WIDTH: WIDTH,
        ContactGiven.MOST: MOST_EVALUATIONS,
        ContactGiven.MOST_LEAST: MOST_LEAST_EVALUATIONS,
        ContactGiven.BYTES: budget.memory(),
        ContactGiven.BEGIN: start,
        ContactGiven.END: end,
        ContactGiven.MOST_KINDS: tables.MOST_SIZES,
        ContactGiven.REFINING: budget.aside_most(REFINING),
        ContactGiven.REFINING_ON: budget.aside_most(REFINING_ON),
    }
    return tables.in_columns(named)


def stand_alone(walk: Walk, times: HeadTimes, s: float, i: int, j: int) -> Witness:
    """How benches i and j (rows, from 0) of a walk stand with the head at s, m, without a search."""
    origin = origin_at(walk, times.start)
    return witness_of(nearness_at(seen_from(walk, origin), s, i, j), origin, times.at(s), s)


def contact_search(
    walk: Walk, start: float, end: float, margin: float, progress: Progress, *, whole: bool = False,
    tolerances: Sequence[float] = TOLERANCES,
) -> ContactSearch:  # fmt: skip
    """A search of the walk from start to end, s; the dragon must stand at the start.

    It covers the whole walk, or only the parts that do not repeat earlier ones (see `rounds`).

    Raises:
        InputError: for a negative margin or an end before the start.
        WalkError: if the dragon cannot stand at the start.
    """
    of_kind("walk", walk, Walk)
    not_negative("margin", margin, "m")
    in_order(start, end)
    a, b = walk.head_position([start, end]).tolist()
    spans = [(a, b)] if whole else Rounds(walk, repeats(walk.route.rows)).new(a, b)[0]
    must_stand(walk, start)
    return ContactSearch(walk, a, b, margin, progress, start, spans, end, tolerances)
