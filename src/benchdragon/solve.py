"""Inverse answers: how small or large one size of a plan may be for the walk to stay clear.

One mechanism for all of them. A walk is tried by the search that misses no contact. Where it fails,
the pair that meets there gives a smooth function of the size, its least distance around that moment,
whose root is where the search goes next; the answer is the root at which the whole walk passes.
"""

import math
import time as clock
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from benchdragon.answer import Answer, Witness
from benchdragon.clearance import low_pair, low_point
from benchdragon.contact import MOST_SAMPLED, SLACK, Hunt, first_contact, least_clearance
from benchdragon.errors import InputError, UnsureError, WalkError
from benchdragon.messages import N_, _
from benchdragon.motion import Walk
from benchdragon.plan import Plan
from benchdragon.plan_text import PlanError
from benchdragon.prove import prove_contact, prove_nearer, require_flint

Advance = Callable[[str], None]

# Brackets are at most so wide, m.
TOLERANCE = 1e-12
# Sizes tried at most; the contest's pitch takes 4.
MOST_TRIALS = 80
# How often a bracket is doubled until it can be proved.
MOST_WIDENINGS = 12
# What a size is multiplied by, at most so often, until a walk passes; and how many times smaller (or
# larger) than that sizes are of interest.
GROWTH, MOST_GROWTHS = 1.25, 40
FARTHEST = 100.0
# A pair that comes no nearer than this beyond the margin, m, is no hint where the limit lies.
NEARBY = 0.1
# Roots of a pair that fail one after another, because another pair decides, before halving.
MOST_FAILURES = 2
# The secant method: its first step, the least from which a slope is taken, when it has come to rest,
# and how far it may go at once, all relative; steps at most.
FIRST_STEP, SHARP, SETTLED, LONGEST_SECANT, MOST_SECANTS = 1e-5, 1e-7, 1e-15, 1.1, 40
# How near to a root of a pair, as a share of the bracket's width, counts likewise.
AT_REST = 1e-4
MOST_COUNT = 10_000


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


@dataclass(frozen=True)
class Meeting:
    """Benches i and j (rows, from 0) of a walk whose head stands at s, m, `left` before its end."""

    s: float
    left: float
    i: int
    j: int


@dataclass(frozen=True)
class Trial:
    """How a walk of one size went: whether it stays clear, and the pair that decides."""

    size: float
    clear: bool
    meeting: Meeting | None
    looks: int
    seconds: float


@dataclass
class Family:
    """The walks of a plan in which one size varies."""

    plan: Plan
    question: Question
    margin: float
    tolerance: float = TOLERANCE

    def walk(self, size: float) -> tuple[Walk, float, float]:
        """The walk of a size, and the times between which it must stay clear."""
        plan = self.plan
        for key in self.question.keys:
            plan = plan.with_value(key, size)
        walk = plan.build()
        return walk, *plan.span(walk)

    def trial(self, size: float) -> Trial:
        """Walk it; what cannot be walked, or decided, is not clear."""
        began = clock.perf_counter()
        meeting, looks, clear = None, 0, False
        try:
            walk, start, end = self.walk(size)
            contact = first_contact(walk, start, end, margin=self.margin)
            clear = contact is None
            if contact is not None and contact.witness is not None:
                meeting, looks = _meeting(walk, end, contact.witness), contact.looks
        except (WalkError, UnsureError, InputError, PlanError):
            clear = False
        return Trial(size, clear, meeting, looks, clock.perf_counter() - began)

    def tightest(self, size: float) -> Meeting | None:
        """About where which pair comes nearest in a walk; None if none comes near."""
        walk, start, end = self.walk(size)
        if 3 <= len(walk.dragon) <= MOST_SAMPLED:
            return self.low_meeting(walk, start, end)
        within = self.margin + NEARBY
        near = least_clearance(walk, start, end, within=within, tolerances=(math.inf,))
        return None if near.witness is None else _meeting(walk, end, near.witness)

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


def _meeting(walk: Walk, end: float, witness: Witness) -> Meeting:
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


@dataclass
class Limit:
    """The bracket of a limit: a size that passes, and one that does not or has not been tried."""

    family: Family
    good: float
    bad: float
    tried: bool = False
    looks: int = 0
    caution: float = 2.5
    failures: int = 0

    def between(self, size: float) -> bool:
        """Whether a size lies strictly inside the bracket."""
        return min(self.good, self.bad) < size < max(self.good, self.bad)

    def target(self, root: tuple[float, float, Meeting] | None) -> tuple[float, float]:
        """The size to try next, and by how much it lies on the safe side of the root (0: no root)."""
        if root is not None and self.failures < MOST_FAILURES:
            size, slope, _meeting = root
            shift = self.caution * SLACK / abs(slope) + 4.0 * math.ulp(size)
            shift = max(shift, 0.25 * self.family.tolerance)
            target = size + math.copysign(shift, self.family.question.sense)
            if self.between(target):
                return target, shift
        self.failures = 0
        if self.tried:
            return math.sqrt(self.good * self.bad), 0.0
        ahead = self.good * GROWTH**-self.family.question.sense
        return ahead if self.between(ahead) else self.bad, 0.0

    def closed(self) -> bool:
        """Whether the bracket is as narrow as wanted, or as doubles allow."""
        width = abs(self.good - self.bad)
        return self.tried and width <= max(TOLERANCE, self.family.tolerance, 4.0 * math.ulp(self.good))


def limit(
    plan: Plan,
    name: str,
    *,
    margin: float | None = None,
    end: float | None = None,
    tolerance: float = TOLERANCE,
    prove: bool = False,
    advance: Advance | None = None,
) -> Answer:
    """The size of `plan` next to which a walk stops staying clear: see QUESTIONS for the names.

    Args:
        plan: all other sizes, and a first one of this: if it does not pass, safer ones are tried.
        name: "pitch", "disc", "width" or "length".
        margin: distance, m, that benches must keep; None: the plan's own.
        end: the least safe size that is of interest, m.
        tolerance: how wide the bracket may be, m; no narrower than 1e-12 can be had.
        prove: whether both ends of the bracket are established again by `prove`, which widens it.
        advance: is told what is being tried.

    Returns:
        The limit, m. Its bracket: at one end the whole walk stays clear, at the other a pair comes
        nearer than the margin (or the dragon cannot walk). Sizes beyond were not tried; see
        `walkable_sizes`. Status "infeasible": no size passes; "unlimited": all that were tried do,
        to `end` or a hundredth (or hundred times) of the plan's. The witness is the pair that decides.

    Raises:
        InputError: for an unknown name, or a plan without that size.
        MissingExtraError: for a proof without python-flint.
        UnsureError: if the bracket could not be proved.
    """
    began = clock.perf_counter()
    tell = advance or (lambda _text: None)
    family = Family(plan, question(name), plan.limits.margin if margin is None else margin, tolerance)
    if name == "disc" and plan.route.kind == "parts":
        raise InputError(_("the disc plays no part in a route of parts"))
    if prove:
        require_flint()
    answer = _limit(family, end, tell, began)
    return _proved(family, answer, tell, began) if prove and answer.status == "found" else answer


def _proved(family: Family, answer: Answer, tell: Advance, began: float) -> Answer:
    """The answer with a bracket both ends of which are proved."""
    near = answer.witness
    if near is None or len(near.benches) != 2:
        raise UnsureError(_("only a limit at which two benches meet can be proved"))
    i, j = (number - 1 for number in near.benches)
    half = 0.5 * (answer.upper - answer.lower)
    for _trial in range(MOST_WIDENINGS):
        good, bad = (answer.value + side * family.question.sense * half for side in (1.0, -1.0))
        tell(_("proving at {size} m").format(size=f"{good:.16g}"))
        walk, start, end = family.walk(good)
        _below, meeting = family.low_point(bad, _meeting(walk, end, near))
        if prove_nearer(family.walk(bad)[0], meeting.s, i, j, family.margin) and (
            prove_contact(walk, start, end, margin=family.margin) is None
        ):
            seconds = clock.perf_counter() - began
            return replace(
                answer, lower=min(good, bad), upper=max(good, bad), status="proved", seconds=seconds
            )
        half *= 2.0
    raise UnsureError(_("the bracket could not be proved"))


def _limit(family: Family, end: float | None, tell: Advance, began: float) -> Answer:
    plan = family.plan
    sense = family.question.sense
    family.walk(plan.value(family.question.keys[0]))  # raises where the plan itself is wrong
    good, failed = _first_clear(family, plan.value(family.question.keys[0]), tell)
    if good is None:
        return Answer(math.nan, -math.inf, math.inf, "m", "infeasible", None, _assumed(family))
    bracket = Limit(family, good, good * FARTHEST**-sense if end is None else end)
    if failed is None:
        meeting, at = family.tightest(good), good
    else:
        meeting, at = family.deepest(failed, None), failed.size
        bracket.bad, bracket.tried = at, True
    for _trial in range(MOST_TRIALS):
        root = None if meeting is None else root_near(family, meeting, at)
        size, shift = bracket.target(root)
        tell(f"{size:.9g} m")
        trial = family.trial(size)
        bracket.looks += trial.looks
        if trial.clear:
            bracket.good, bracket.failures = size, 0
            below = size - math.copysign(2.0 * shift, sense)
            if shift and root and family.low_point(below, root[2])[0] < -SLACK:
                bracket.bad, bracket.tried = below, True
                return _limit_answer(bracket, root[0], root[2], began)
            if not bracket.tried and size == bracket.bad:
                return _limit_answer(bracket, size, None, began).with_status("unlimited")
            meeting, at = (family.tightest(size), size) if not shift else (None, size)
        else:
            if shift and meeting == trial.meeting:
                bracket.caution *= 4.0
            bracket.bad, bracket.tried = size, True
            bracket.failures += 1
            meeting, at = family.deepest(trial, meeting), size
        if bracket.closed():
            return _limit_answer(bracket, bracket.good, meeting, began)
    return _limit_answer(bracket, bracket.good, meeting, began).with_status("undecided")


def question(name: str) -> Question:
    """The question of that name.

    Raises:
        InputError: if there is none.
    """
    if name not in QUESTIONS:
        raise InputError(
            _("wanted one of {known}, not {name}").format(known=", ".join(QUESTIONS), name=name)
        )
    return QUESTIONS[name]


def _first_clear(family: Family, size: float, tell: Advance) -> tuple[float | None, Trial | None]:
    """A size that passes, from `size` towards the safe side, if there is one; the last that did not."""
    failed = None
    for _growth in range(MOST_GROWTHS):
        tell(f"{size:.9g} m")
        trial = family.trial(size)
        if trial.clear:
            return size, failed
        failed = trial
        size *= GROWTH**family.question.sense
    return None, failed


def _limit_answer(bracket: Limit, value: float, meeting: Meeting | None, began: float) -> Answer:
    family = bracket.family
    lower, upper = sorted((bracket.good, bracket.bad))
    witness = _witness(family, bracket.bad, meeting)
    return Answer(
        min(max(value, lower), upper), lower, upper, "m", "found", witness,
        _assumed(family), bracket.looks, clock.perf_counter() - began,
    )  # fmt: skip


def _witness(family: Family, size: float, meeting: Meeting | None) -> Witness | None:
    """What shows that a size does not pass; None where no pair does, or there is no such walk."""
    if meeting is None:
        return None
    try:
        walk, start, end = family.walk(size)
    except (InputError, PlanError):
        return None
    first, last = walk.head_position([start, end]).tolist()
    hunt = Hunt(walk, first, last, family.margin, lambda _share: None)
    return hunt.witness(min(meeting.s, last), meeting.i, meeting.j)


def _assumed(family: Family) -> tuple[str, ...]:
    return (
        _("benches keep {margin} m").format(margin=f"{family.margin:g}"),
        _("sizes beyond the bracket were not tried"),
    )


@dataclass(frozen=True)
class Span:
    """Sizes from low to high, m, between which every size tried was walkable."""

    low: float
    high: float


def walkable_sizes(
    plan: Plan,
    name: str,
    low: float,
    high: float,
    count: int = 50,
    *,
    margin: float | None = None,
    advance: Advance | None = None,
) -> list[Span]:
    """The sizes between low and high (m) with which the walk stays clear, tried at `count` places.

    The borders are found as by `limit`. Narrower spans than a step can be missed.

    Raises:
        InputError: for an unknown name, an empty range, or a count outside 2..10,000.
    """
    if not 0.0 < low < high < math.inf:
        raise InputError(
            _("wanted a range from a positive size to a larger one, not {low} to {high} m").format(
                low=low, high=high
            )
        )
    if not 2 <= count <= MOST_COUNT:
        raise InputError(
            _("count must lie between 2 and {most}, not at {count}").format(
                most=MOST_COUNT, count=count
            )
        )
    family = Family(plan, question(name), plan.limits.margin if margin is None else margin)
    tell = advance or (lambda _text: None)
    sizes = np.linspace(low, high, count).tolist()
    clear = []
    for size in sizes:
        tell(f"{size:.9g} m")
        clear.append(family.trial(size).clear)
    spans, since = [], sizes[0] if clear[0] else None
    for a, b, was, now in zip(sizes, sizes[1:], clear, clear[1:], strict=False):
        if was == now:
            continue
        border = _border(family, *((b, a) if now else (a, b)))
        if now:
            since = border
        elif since is not None:
            spans.append(Span(since, border))
            since = None
    return spans if since is None else [*spans, Span(since, sizes[-1])]


def _border(family: Family, good: float, bad: float) -> float:
    """The size between one that passes and one that does not, from the passing side."""
    bracket = Limit(family, good, bad, tried=True)
    while not bracket.closed():
        trial = family.trial(bracket.bad)
        root = None if trial.meeting is None else root_near(family, trial.meeting, bracket.bad)
        size, shift = bracket.target(root)
        if family.trial(size).clear:
            bracket.good = size
            if shift:
                return size
        else:
            bracket.caution *= 4.0 if shift else 1.0
            bracket.bad = size
    return bracket.good


def smallest_pitch(plan: Plan, *, margin: float | None = None) -> Answer:
    """The smallest spiral pitch, m, with which the head comes to the disc and no benches touch.

    See `limit`, of which this is the question "pitch".
    """
    return limit(plan, "pitch", margin=margin)
