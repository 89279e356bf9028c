"""Inverse answers: how small or large one size of a plan may be for the walk to stay clear.

One mechanism for all of them. A walk is tried by the search that misses no contact. Where it fails,
the pair that meets there gives a smooth function of the size, its least distance around that moment,
whose root is where the search goes next; the answer is the root at which the whole walk passes.
"""

import itertools
import math
import time as clock
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from benchdragon.analysis.contact_search import SLACK, ContactSearch
from benchdragon.analysis.proof import (
    assumed,
    prove_contact,
    prove_nearer,
    require_enclosed,
    require_flint,
)
from benchdragon.errors import InputError, UnsureError, of_kind
from benchdragon.i18n import _
from benchdragon.model.answer import Answer, Status, Witness
from benchdragon.plans.schema import Plan
from benchdragon.plans.toml import PlanError
from benchdragon.progress import Progress, silent
from benchdragon.solve.size_trials import (
    TOLERANCE,
    Family,
    Meeting,
    Trial,
    meeting_of,
    question,
    root_near,
)

# Sizes tried at most; the contest's pitch takes 4.
MOST_TRIALS = 80
# How often a bracket is doubled until it can be proved.
MOST_WIDENINGS = 12
# What a size is multiplied by, at most so often, until a walk passes; and how many times smaller (or
# larger) than that sizes are of interest.
GROWTH, MOST_GROWTHS = 1.25, 40
FARTHEST = 100.0
# Roots of a pair that fail one after another, because another pair decides, before halving.
MOST_FAILURES = 2
# Sizes tried beside some that could not be decided, on both sides in turn, before giving up.
MOST_BESIDE = 12
MOST_COUNT = 10_000


@dataclass
class Limit:
    """The bracket of a limit: a size that passes, and one that does not or has not been tried.

    Both are decided; `unsure` are sizes that were tried and could not be.
    """

    family: Family
    good: float
    bad: float
    tried: bool = False
    evaluations: int = 0
    caution: float = 2.5
    failures: int = 0
    unsure: list[float] = field(default_factory=list)
    beside: int = 0

    @property
    def doubts(self) -> list[float]:
        """The undecided sizes in the bracket, from the one next to the size that does not pass."""
        return sorted(filter(self.between, self.unsure), reverse=self.bad > self.good)

    def between(self, size: float) -> bool:
        """Whether a size lies strictly inside the bracket."""
        return min(self.good, self.bad) < size < max(self.good, self.bad)

    def target(self, root: tuple[float, float, Meeting] | None) -> tuple[float, float]:
        """The size to try next, and by how much it lies on the safe side of the root (0: no root)."""
        if self.doubts:
            return self._beside_doubts(), 0.0
        if root is not None and self.failures < MOST_FAILURES:
            size, slope, _meeting = root
            shift = self.caution * SLACK / abs(slope) + 4.0 * math.ulp(size)
            shift = max(shift, 0.25 * self.family.tolerance)
            target = size + math.copysign(shift, self.family.question.sense)
            if self.between(target):
                return target, shift
        self.failures = 0
        return self._ahead(self.good), 0.0

    def _ahead(self, size: float) -> float:
        """A size from `size` on towards the one that does not pass."""
        if self.tried:
            return math.sqrt(size * self.bad)
        ahead = size * GROWTH**-self.family.question.sense
        return ahead if self.between(ahead) else self.bad

    def _beside_doubts(self) -> float:
        """A size on the one side, then on the other, of those that could not be decided."""
        self.beside += 1
        doubts = self.doubts
        return self._ahead(doubts[0]) if self.beside % 2 else math.sqrt(doubts[-1] * self.good)

    def closed(self) -> bool:
        """Whether the bracket is as narrow as wanted, or as doubles allow."""
        width = abs(self.good - self.bad)
        return self.tried and width <= max(TOLERANCE, self.family.tolerance, 4.0 * math.ulp(self.good))


def limit(
    plan: Plan,
    name: str,
    *,
    margin: float | None = None,
    tolerance: float = TOLERANCE,
    prove: bool = False,
    progress: Progress = silent,
) -> Answer:
    """The size of `plan` next to which a walk stops staying clear: see QUESTIONS for the names.

    Args:
        plan: all other sizes, and a first one of this: if it does not pass, safer ones are tried.
        name: "pitch", "disc", "width" or "length".
        margin: distance, m, that benches must keep; None: the plan's own.
        tolerance: how wide the bracket may be, m; no narrower than 1e-12 can be had.
        prove: whether both ends of the bracket are established again by `proof`, which widens it.
        progress: is told what is being tried.

    Returns:
        The limit, m. Its bracket: at one end the whole walk stays clear, at the other a pair comes
        nearer than the margin (or the dragon cannot walk). Sizes beyond were not tried; see
        `feasible_sizes`. Status "infeasible": no size passes; "unlimited": all that were tried do,
        to a hundredth (or hundred times) of the plan's; "undecided": sizes in the bracket
        could not be decided, as the last of `assumptions` says. The witness is the pair that decides.

    Raises:
        InputError: for an unknown name, or a head that walks to the centre of a spiral, where no bench
            can follow whatever its size; for a proof on a route with a part that cannot be proved.
        PlanError: for a plan without that size.
        MissingExtraError: for a proof without python-flint.
        UnsureError: if the bracket could not be proved.
    """
    began = clock.perf_counter()
    family = _family(plan, name, margin, tolerance)
    if prove:
        require_enclosed(family.walk(family.first)[0].route)
        require_flint()
    answer = _limit(family, progress, began)
    return _proved(family, answer, progress, began) if prove and answer.status == "found" else answer


def _proved(family: Family, answer: Answer, progress: Progress, began: float) -> Answer:
    """The answer with a bracket both ends of which are proved."""
    near = answer.witness
    if near is None or len(near.benches) != 2:
        raise UnsureError(_("only an answer that two benches decide can be proved"))
    i, j = (number - 1 for number in near.benches)
    half = 0.5 * (answer.upper - answer.lower)
    for _trial in range(MOST_WIDENINGS):
        good, bad = (answer.value + side * family.question.sense * half for side in (1.0, -1.0))
        progress(0.0, _("proving at {size} m").format(size=f"{good:.16g}"))
        walk, start, end = family.walk(good)
        _below, meeting = family.low_point(bad, meeting_of(walk, end, near))
        if prove_nearer(family.walk(bad)[0], meeting.s, i, j, family.margin) and (
            prove_contact(walk, start, end, margin=family.margin) is None
        ):
            seconds = clock.perf_counter() - began
            return replace(
                answer, lower=min(good, bad), upper=max(good, bad), status="proved",
                assumptions=assumed(), seconds=seconds,
            )  # fmt: skip
        half *= 2.0
    raise UnsureError(_("the bracket could not be proved"))


def _limit(family: Family, progress: Progress, began: float) -> Answer:
    sense = family.question.sense
    family.walk(family.first)  # raises where the plan itself is wrong
    good, failed, unsure = _first_clear(family, progress)
    if good is None:
        status: Status = "undecided" if unsure else "infeasible"
        texts = _assumed(family, unsure)
        return Answer(math.nan, -math.inf, math.inf, "m", status, None, texts)
    bracket = Limit(family, good, good * FARTHEST**-sense, unsure=unsure)
    if failed is None:
        meeting, at = family.tightest(good), good
    else:
        meeting, at = family.deepest(failed, None), failed.size
        bracket.bad, bracket.tried = at, True
    for _trial in range(MOST_TRIALS):
        root = None if meeting is None else root_near(family, meeting, at)
        size, shift = bracket.target(root)
        progress(0.0, f"{size:.9g} m")
        trial = family.trial(size)
        bracket.evaluations += trial.evaluations
        if trial.clear is None:
            bracket.unsure.append(size)
        elif trial.clear:
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
        if bracket.closed() or (bracket.doubts and bracket.beside >= MOST_BESIDE):
            return _limit_answer(bracket, bracket.good, meeting, began)
    return _limit_answer(bracket, bracket.good, meeting, began).with_status("undecided")


def _family(plan: Plan, name: str, margin: float | None, tolerance: float = TOLERANCE) -> Family:
    """The walks among which a limit is sought; not such as must fail whatever their size."""
    of_kind("plan", plan, Plan)
    family = Family(plan, question(name), plan.limits.margin if margin is None else margin, tolerance)
    centre = plan.disc.radius is None and plan.walk.end is None
    if name != "disc" and plan.route.kind == "spiral-in" and centre:
        raise InputError(_("say how far in the head comes: set disc.radius=4.5, for example"))
    return family


def _first_clear(family: Family, progress: Progress) -> tuple[float | None, Trial | None, list[float]]:
    """A size that passes, from the plan's own towards the safe side, if there is one.

    And the last that did not, and those that could not be decided.
    """
    size, failed = family.first, None
    unsure: list[float] = []
    for _growth in range(MOST_GROWTHS):
        progress(0.0, f"{size:.9g} m")
        trial = family.trial(size)
        if trial.clear:
            return size, failed, unsure
        if trial.clear is None:
            unsure.append(size)
        else:
            failed = trial
        size *= GROWTH**family.question.sense
    return None, failed, unsure


def _limit_answer(bracket: Limit, value: float, meeting: Meeting | None, began: float) -> Answer:
    family = bracket.family
    lower, upper = sorted((bracket.good, bracket.bad))
    witness = _witness(family, bracket.bad, meeting)
    return Answer(
        min(max(value, lower), upper), lower, upper, "m", "undecided" if bracket.doubts else "found",
        witness, _assumed(family, bracket.unsure), bracket.evaluations, clock.perf_counter() - began,
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
    search = ContactSearch(walk, first, last, family.margin, silent, since=start)
    return search.witness(min(meeting.s, last), meeting.i, meeting.j)


def _assumed(family: Family, unsure: Sequence[float]) -> tuple[str, ...]:
    texts = (
        _("benches keep {margin} m").format(margin=f"{family.margin:g}"),
        _("sizes beyond the bracket were not tried"),
    )
    return (*texts, undecided_text(unsure)) if unsure else texts


def undecided_text(sizes: Sequence[float]) -> str:
    """That sizes, m, could not be decided."""
    text = _("{count} of the sizes tried, from {low} m to {high} m, are undecided")
    return text.format(count=len(sizes), low=f"{min(sizes):.6g}", high=f"{max(sizes):.6g}")


@dataclass(frozen=True)
class Span:
    """Sizes from low to high, m, between which all `tried` that were tried were safe.

    `borders` are those of its ends that were searched for: just beyond, a walk fails.
    """

    low: float
    high: float
    tried: int
    borders: tuple[float, ...]


@dataclass(frozen=True)
class FeasibleSizes:
    """What trying sizes of a range came to.

    Attributes:
        spans: of safe sizes, in order.
        step: between sizes tried, m.
        undecided: sizes that could not be decided, m.
    """

    spans: tuple[Span, ...]
    step: float
    undecided: tuple[float, ...]


def feasible_sizes(
    plan: Plan,
    name: str,
    low: float,
    high: float,
    count: int = 50,
    *,
    margin: float | None = None,
    progress: Progress = silent,
) -> FeasibleSizes:
    """The sizes between low and high (m) with which the walk stays clear, tried at `count` places.

    Where a span borders on sizes that do not pass, the border is found as by `limit`; where on ones
    that could not be decided, it is the last that passes. What lies between sizes tried is not known.

    Raises:
        InputError: as `limit`; for an empty range, or a count outside 2..10,000.
    """
    _check_range(low, high, count)
    family, trials = _family(plan, name, margin), []
    for n, size in enumerate(np.linspace(low, high, count).tolist()):
        progress(n / count, f"{size:.9g} m")
        trials.append(family.trial(size))
    undecided = tuple(trial.size for trial in trials if trial.clear is None)
    return FeasibleSizes(tuple(_spans(family, trials)), (high - low) / (count - 1), undecided)


def _check_range(low: float, high: float, count: int) -> None:
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


def _spans(family: Family, trials: Sequence[Trial]) -> Iterator[Span]:
    """Runs of trials that pass, and how far beyond their ends sizes still do."""
    for clear, run in itertools.groupby(range(len(trials)), key=lambda n: trials[n].clear):
        if clear:
            members = list(run)
            ends = _edge(family, trials, members[0], -1), _edge(family, trials, members[-1], 1)
            tried = (trials[members[0]].size, trials[members[-1]].size)
            borders = tuple(end for end, size in zip(ends, tried, strict=True) if end != size)
            yield Span(*ends, len(members), borders)


def _edge(family: Family, trials: Sequence[Trial], n: int, side: int) -> float:
    """How far sizes are safe from trial number n, which passes, to one side of it."""
    if not 0 <= n + side < len(trials) or trials[n + side].clear is None:
        return trials[n].size
    return _border(family, trials[n].size, trials[n + side].size)


def _border(family: Family, good: float, bad: float) -> float:
    """The size between one that passes and one that does not, from the passing side."""
    bracket = Limit(family, good, bad, tried=True)
    while not bracket.closed():
        trial = family.trial(bracket.bad)
        root = None if trial.meeting is None else root_near(family, trial.meeting, bracket.bad)
        size, shift = bracket.target(root)
        passes = family.trial(size).clear
        if passes is None:
            break
        if passes:
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
