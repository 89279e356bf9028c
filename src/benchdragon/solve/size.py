"""Inverse answers: how small or large one size of a plan may be for the walk to stay clear.

Each is found by a bracketed secant method: continuous collision detection decides whether the walk of a
size passes; if not, the separation of the active pair near its contact is a smooth function of the
size, whose root is tried next. The answer is the root at which the whole walk passes.
"""

import itertools
import math
import time as clock
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from benchdragon import budget
from benchdragon.analysis.contact_search import stand_alone
from benchdragon.analysis.head_times import HeadTimes
from benchdragon.analysis.obstacles import obstacle_answers, touching
from benchdragon.analysis.proof import (
    Claim,
    assumed,
    prove_contact,
    prove_nearer,
    prove_obstacle,
    require_flint,
)
from benchdragon.errors import InputError, UnsureError, not_negative, of_kind
from benchdragon.i18n import _
from benchdragon.kernels.size_bracket import Bracket, SizeVerdict
from benchdragon.kernels.size_question import FAR
from benchdragon.kernels.size_search import SizeStep
from benchdragon.model.answer import Answer, Status, Witness
from benchdragon.plans.schema import Plan
from benchdragon.plans.toml import PlanError
from benchdragon.progress import Progress, silent
from benchdragon.solve.size_family import TOLERANCE, PlanFamily, meeting_of, question
from benchdragon.solve.size_question import SizeQuestion

# How often a bracket is doubled until it can be proved.
MOST_WIDENINGS = 12
MOST_COUNT = 10_000
# Width of the bracket of a size, m, while its slider is dragged.
QUICK_SIZE = 1e-5


@budget.question()
def limit(
    plan: Plan,
    name: str,
    *,
    margin: float | None = None,
    tolerance: float = TOLERANCE,
    prove: bool = False,
    progress: Progress = silent,
    claims: list[Claim] | None = None,
) -> Answer:
    """The size of `plan` next to which a walk stops staying clear: see QUESTIONS for the names.

    Args:
        plan: all other sizes, and a first one of this: if it does not pass, safer ones are tried.
        name: "pitch", "disc", "width" or "length".
        margin: distance, m, that benches must keep; None: the plan's own.
        tolerance: how wide the bracket may be, m; no narrower than 1e-12 can be had.
        prove: whether both ends of the bracket are established again by `proof`, which widens it.
        progress: is called with the share done and the size being tried.
        claims: the proved claims are added to it: that the walk at one end of the bracket stays clear,
            and that two benches come too near at the other.

    Returns:
        The limit, m. Its bracket: at one end the whole walk stays clear, at the other a pair comes
        nearer than the margin, a bench touches an obstacle or leaves the venue (or the dragon cannot
        walk). Sizes beyond were not tried; see
        `feasible_sizes`. Status "infeasible": no size passes; "unlimited": all that were tried do,
        to a hundredth (or hundred times) of the plan's; "undecided": sizes in the bracket
        could not be decided, as the last of `assumptions` says. The witness is the pair that decides.

    Raises:
        InputError: for an unknown name, or a head that walks to the centre of a spiral, where no bench
            can follow whatever its size; for a proof on a route with a part that cannot be proved.
        PlanError: for a plan without that size.
        MissingExtraError: for a proof without python-flint.
        UnsureError: if the bracket could not be proved.

    Examples:
        >>> plan = bd.read_plan("spiral-in", {"disc.radius": 4.5, "dragon.benches": 40})
        >>> round(bd.limit(plan, "width").value, 6)
        0.40287
    """
    if prove:
        require_flint()
    began, answer = clock.perf_counter(), found_limit(plan, name, margin, tolerance, progress)
    if not prove or answer.status != "found":
        return answer
    family = _family(plan, name, margin, tolerance)
    return _proved(family, answer, progress, began, [] if claims is None else claims)


@budget.question()
def found_limit(
    plan: Plan, name: str, margin: float | None = None, tolerance: float = TOLERANCE,
    progress: Progress = silent,
) -> Answer:  # fmt: skip
    """`limit` as it is found, without a proof."""
    began, family = clock.perf_counter(), _family(plan, name, margin, tolerance)
    with SizeQuestion(family, progress) as search:  # raises where the plan itself is wrong
        ending = search.limit(family.first)
        return _limit_answer(family, search, ending, began)


def _proved(
    family: PlanFamily, answer: Answer, progress: Progress, began: float, claims: list[Claim]
) -> Answer:
    """The answer with both ends of its bracket proved; the proved claims are added to `claims`."""
    near = answer.witness
    if near is None or len(near.benches) != 2:
        raise UnsureError(_("only an answer that two benches decide can be proved"))
    i, j = sorted(number - 1 for number in near.benches)
    half = 0.5 * (answer.upper - answer.lower)
    for _trial in range(MOST_WIDENINGS):
        good, bad = (answer.value + side * family.question.sense * half for side in (1.0, -1.0))
        progress(0.0, _("proving at {size} m").format(size=f"{good:.16g}"))
        walk, _start, end = family.walk(good)
        _below, meeting = family.low_point(bad, meeting_of(walk, end, near))
        worse, *span = family.walk(bad)
        nearer = prove_nearer(
            worse, (span[0], span[1]), meeting.s, (i, j), family.margin, family.sized(bad)
        )
        shown = [] if nearer is None else _clear(family, good, progress)
        if nearer is not None and shown:
            claims += [*shown, family.said(nearer, bad)]
            told = *answer.assumptions, assumed(walk, family.sized(good))
            return replace(
                answer, lower=min(good, bad), upper=max(good, bad), status="proved",
                assumptions=told, seconds=clock.perf_counter() - began,
            )  # fmt: skip
        half *= 2.0
    raise UnsureError(_("the bracket could not be proved"))


def _clear(family: PlanFamily, size: float, progress: Progress) -> list[Claim]:
    """Claims that prove the walk of a size clear of contact and obstacles; none if that fails."""
    (walk, start, end), plan, claims = family.walk(size), family.sized(size), list[Claim]()
    contact = prove_contact(
        walk, start, end, margin=family.margin, progress=progress, claims=claims, plan=plan
    )
    if contact is not None:
        return []
    for obstacle in plan.obstacles():
        found = obstacle_answers(walk, obstacle, start, end)
        if prove_obstacle(walk, found, start, end, claims=claims, plan=plan).contact is not None:
            return []
    return [family.said(claim, size) for claim in claims]


def _limit_answer(family: PlanFamily, search: SizeQuestion, ending: int, began: float) -> Answer:
    """The answer of a search for a limit, by its exit status."""
    good, bad, value = (
        float(search.state[column]) for column in (Bracket.GOOD, Bracket.BAD, Bracket.VALUE)
    )
    texts, evaluations = _assumed(family, search.doubts), search.evaluations
    seconds = clock.perf_counter() - began
    if ending == SizeStep.INFEASIBLE:
        none: Status = "undecided" if search.doubts else "infeasible"
        return Answer(math.nan, -math.inf, math.inf, "m", none, None, texts, evaluations, seconds)
    unsure = ending == SizeStep.EXHAUSTED or search.in_doubt
    bad = bad if ending == SizeStep.UNLIMITED else search.surely_bad(good, bad)
    status: Status = "undecided" if unsure else "unlimited" if ending == SizeStep.UNLIMITED else "found"
    lower, upper = sorted((good, bad))
    witness = _witness(family, search, bad)
    value = min(max(value, lower), upper)
    return Answer(value, lower, upper, "m", status, witness, texts, evaluations, seconds)


def _family(plan: Plan, name: str, margin: float | None, tolerance: float = TOLERANCE) -> PlanFamily:
    """The walks among which a limit is sought; not such as must fail whatever their size."""
    of_kind("plan", plan, Plan)
    kept = not_negative("margin", plan.limits.margin if margin is None else margin, "m")
    family = PlanFamily(plan, question(name), kept, tolerance)
    centre = plan.disc.radius is None and plan.walk.end is None
    if name != "disc" and plan.route.kind == "spiral-in" and centre:
        raise InputError(_("say how far in the head comes: set disc.radius=4.5, for example"))
    return family


def _witness(family: PlanFamily, found: SizeQuestion, size: float) -> Witness | None:
    """The witness that a size does not pass; None without a pair, or without such a walk."""
    meeting, number = found.guide, found.blocked(size)
    if meeting is None and number is None:
        return None
    try:
        walk, start, end = family.walk(size)
    except (InputError, PlanError):
        return None
    if number is not None:
        touches = touching(walk, family.plan.obstacles()[number], start, end)
        return touches[-1].witness if touches else None
    if meeting is None:
        return None
    first, last = walk.head_position([start, end]).tolist()
    times = HeadTimes(walk, first, start)
    return stand_alone(walk, times, min(meeting.s, last), meeting.i, meeting.j)


def _assumed(family: PlanFamily, unsure: Sequence[float]) -> tuple[str, ...]:
    texts = [
        _("benches keep {margin} m").format(margin=f"{family.margin:g}"),
        _("sizes beyond the bracket were not tried"),
    ]
    if family.plan.obstacles():
        text = _(
            "the venue and obstacles count: other sizes may be safe as well, --range tries them; none "
            "over {far} times the plan's own was tried, and none that much smaller"
        )
        texts.append(text.format(far=f"{FAR:g}"))
    return (*texts, undecided_text(unsure)) if unsure else tuple(texts)


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
    """The result of trying sizes of a range.

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
    that could not be decided, it is the last that passes. Sizes between those tried are not covered.

    Raises:
        InputError: as `limit`; for an empty range, or a count outside 2..10,000.
    """
    _check_range(low, high, count)
    family, trials = _family(plan, name, margin), []
    with budget.question(count), SizeQuestion(family, silent) as search:
        for n, size in enumerate(np.linspace(low, high, count).tolist()):
            progress(n / count, f"{size:.9g} m")
            trials.append((size, search.trial(size)))
        undecided = tuple(size for size, result in trials if result == SizeVerdict.UNDECIDED)
        return FeasibleSizes(tuple(_spans(search, trials)), (high - low) / (count - 1), undecided)


def _check_range(low: float, high: float, count: int) -> None:
    if not 0.0 < low < high < math.inf:
        text = _("expected a range from a positive size to a larger one, not {low} to {high} m")
        raise InputError(text.format(low=low, high=high))
    if not 2 <= count <= MOST_COUNT:
        text = _("count must lie between 2 and {most}, not at {count}")
        raise InputError(text.format(most=MOST_COUNT, count=count))


def _spans(search: SizeQuestion, trials: Sequence[tuple[float, int]]) -> Iterator[Span]:
    """Runs of sizes that pass, and how far beyond their ends sizes still do."""
    for passes, run in itertools.groupby(
        range(len(trials)), key=lambda n: trials[n][1] == SizeVerdict.PASSES
    ):
        if passes:
            members = list(run)
            edges = _edge(search, trials, members[0], -1), _edge(search, trials, members[-1], 1)
            low, high = (size for size, _found in edges)
            yield Span(low, high, len(members), tuple(size for size, found in edges if found))


def _edge(
    search: SizeQuestion, trials: Sequence[tuple[float, int]], n: int, side: int
) -> tuple[float, bool]:
    """How far sizes are safe to one side of trial n, which passes; whether a walk fails just beyond."""
    if not 0 <= n + side < len(trials) or trials[n + side][1] != SizeVerdict.FAILS:
        return trials[n][0], False
    return search.border(trials[n][0], trials[n + side][0])


def smallest_pitch(plan: Plan, *, margin: float | None = None) -> Answer:
    """The smallest pitch, m, with which the head comes to the disc and no benches touch.

    See `limit`, of which this is the question "pitch".

    Examples:
        >>> round(bd.smallest_pitch(bd.read_plan("spiral-in", {"disc.radius": 4.5})).value, 9)
        0.450337393
    """
    return limit(plan, "pitch", margin=margin)
