"""The greatest constant head speed, and a speed profile that slows down only where it must."""

import math
import time as clock
from dataclasses import dataclass, replace

import numpy as np

from benchdragon import budget
from benchdragon.analysis.proof import assumed
from benchdragon.analysis.speed import (
    QUANTITIES,
    RATE_TOLERANCE,
    TOLERANCE,
    PeakQuestion,
    failure_within,
    given_limits,
    sought,
    witness_of,
)
from benchdragon.analysis.speed_proof import SpeedClaim, head_speeds, prove_speed
from benchdragon.errors import InputError, UnsureError, of_kind, positive
from benchdragon.i18n import _
from benchdragon.kernels import head_speed
from benchdragon.kernels import speed_question as kernel
from benchdragon.kernels.speed_question import SpeedEnding
from benchdragon.model.answer import Answer
from benchdragon.model.profile import MOST_SPEED, SpeedProfile
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent

# A pace stays below what is allowed by this share, far above rounding.
PRUDENCE = 1e-9
# Knots of a pace at most: a plan file takes twice as many.
MOST_KNOTS = 5000
# Parts of a step between two knots of a pace over which bounds are made.
FINER = 8
# Digits of a start, s, behind the point: later digits are rounding.
DIGITS = 12
# Handles bounded between two reports of progress.
AT_ONCE = 1_000_000
EVEN = SpeedProfile.constant(1.0)


@dataclass(frozen=True)
class Pace:
    """A head that slows down only where it must.

    Attributes:
        profile: its speed over time; at time 0 the head stands where the plan says.
        steady: the greatest constant speed that keeps the same limits, m/s.
        seconds: how long the walk takes.
        saved: by how much less than at the steady speed, s.

    Examples:
        >>> pace = bd.slowed(bd.read_plan("turn", {"walk.speed": 1.5, "dragon.benches": 9}))
        >>> pace.steady.unit
        'm/s'
    """

    profile: SpeedProfile
    steady: Answer
    seconds: float
    saved: float


def _limits_of(plan: Plan) -> dict[str, float]:
    """The limits that a head speed must keep, by the names of their quantities."""
    found = given_limits(plan)
    if not found:
        raise InputError(
            _("the plan has no limit that a head speed could keep: set limits.speed=2, for example")
        )
    return found


@budget.question()
def prove_head_speed(
    plan: Plan, *, progress: Progress = silent, claims: list[SpeedClaim] | None = None
) -> Answer:
    """`greatest_head_speed`, proved: that of a plan that limits the handles' speeds alone.

    The bracket: at its lower end no handle is ever faster than the limit, at its upper end one is. All
    numbers count as they are written. The proved claim is added to `claims`.

    Raises:
        InputError: without that limit, or with others; for a number that the plan holds rounded.
        MissingExtraError: without python-flint.
        UnsureError: if it could not be shown.
        WalkError: if the dragon cannot walk all the way.
    """
    limit = plan.limits.speed
    if limit is None or len(_limits_of(plan)) > 1:
        text = _("a head speed can be proved where the plan limits speeds alone: set limits.speed")
        raise InputError(text)
    found, walk = greatest_head_speed(plan, progress=progress), plan.build()
    near = found.witness
    if near is None or near.handle is None:
        raise UnsureError(_("there is no speed that could be proved"))
    claim = prove_speed(walk, *plan.span(walk), near.s, plan=plan, progress=progress)
    if claims is not None:
        claims.append(claim)
    lower, upper = head_speeds(limit, claim)
    told = *found.assumptions, assumed(walk, plan)
    return replace(found, value=lower, lower=lower, upper=upper, status="proved", assumptions=told)


@budget.question()
def greatest_head_speed(
    plan: Plan, *, tolerance: float = TOLERANCE, progress: Progress = silent
) -> Answer:
    """The greatest constant head speed, m/s, with which the plan's whole walk keeps its limits.

    Limits are those on handles' speeds and accelerations and on benches' turning rates, over
    continuous time. The value is the bracket's lower end: what surely keeps all of them. The witness
    is the handle (the first that reaches the greatest speed) or the bench of the limit that decides,
    its time that of a head at the plan's own speed. `tolerance` is that of the greatest speed
    ratio; turning rates and accelerations have at least 1e-6.

    Raises:
        InputError: without a limit.
        WalkError: if the dragon cannot walk all the way.

    Examples:
        >>> round(bd.greatest_head_speed(bd.read_plan("turn")).value, 6)
        1.246266
    """
    began = clock.perf_counter()
    of_kind("plan", plan, Plan)
    limits = _limits_of(plan)
    walk = plan.build()
    first, last = walk.head_position(plan.span(walk)).tolist()
    asked = [
        (QUANTITIES[name], tolerance if name == "speed" else max(tolerance, RATE_TOLERANCE), allowed)
        for name, allowed in limits.items()
    ]
    found = sought(walk, EVEN.stretches(first, last), asked, progress, MOST_SPEED)
    if found.decides is None:  # what is limited hardly occurs
        return Answer(MOST_SPEED, MOST_SPEED, math.inf, "m/s", "unlimited")
    text = _("what decides: {quantity}, at most {value} {unit}").format(
        quantity=_(found.decides.text),
        value=f"{limits[found.decides.name]:.6g}",
        unit=found.decides.unit,
    )
    value = found.lower if found.lower > 0.0 else math.nan
    return Answer(
        value, found.lower, found.upper, "m/s", "found" if found.lower > 0.0 else "undecided",
        witness_of(walk, found.decides, found.peak), (text,), found.peak.evaluations,
        clock.perf_counter() - began,
    )  # fmt: skip


@budget.question()
def slowed(plan: Plan, *, progress: Progress = silent) -> Pace:
    """A pace at the plan's own head speed that slows down only where a limit would be exceeded.

    Between evaluations none exceeds a limit either: over each step of the head the pace keeps
    to what a bound on all of them allows (see kernels/head_speed.py). The head changes its speed by at
    most limits.head_acceleration.

    Raises:
        InputError: without a limit, or with a plan that has a profile already, or cues that hold it.
        WalkError: if the dragon cannot walk all the way.
        UnsureError: if that could not be decided, or if no pace was found to keep the limits.

    Examples:
        >>> pace = bd.slowed(bd.read_plan("turn", {"walk.speed": 1.5, "dragon.benches": 9}))
        >>> f"{min(pace.profile.speeds):.2f} m/s, {pace.saved:.0f} s saved"
        '1.24 m/s, 24 s saved'
    """
    of_kind("plan", plan, Plan)
    if plan.walk.profile:
        raise InputError(_("the plan has a speed profile of its own: take walk.profile out"))
    if any(cue.kind in ("hold", "stop") for cue in plan.cues.cue):
        raise InputError(_("cues hold the head: seek the speeds without them, then put them in again"))
    steady = greatest_head_speed(plan, progress=progress)
    if steady.status == "undecided":
        raise UnsureError(_("it could not be shown that the dragon stands all along"))
    walk = plan.build()
    first, last = walk.head_position(plan.span(walk)).tolist()
    if not first < last:
        raise InputError(_("the walk has no length: set walk.start and walk.end apart"))
    even = min(steady.lower, plan.walk.speed)
    times, speeds = _fastest(plan, walk, first, last, progress)
    whole = (last - first) / even
    if times[-1] >= whole:
        times, speeds = [0.0, whole], [even, even]
    profile = SpeedProfile(tuple(times), tuple(speeds))
    zero = profile.time(walk.start - first)  # at time 0 the head stands at walk.start
    profile = SpeedProfile(tuple(t - zero for t in times), tuple(speeds))
    return Pace(profile, steady, times[-1], whole - times[-1])


def _fastest(
    plan: Plan, walk: Walk, first: float, last: float, progress: Progress
) -> tuple[list[float], list[float]]:
    """Times, s, and the greatest speeds then, m/s, between which limits are kept too."""
    link, handles = min(walk.dragon.links.tolist()), len(walk.dragon) + 1
    steps = max(1, math.ceil(min((last - first) / (kernel.FIRST_CHAIN_STEP * link), MOST_KNOTS - 1)))
    budget.expect(kernel.BOUNDED * steps * FINER * handles)
    given = {**_limits_of(plan), "head": plan.limits.head_acceleration}
    limits = [(1.0 - PRUDENCE) * given.get(name, math.inf) for name in (*QUANTITIES, "head")]
    most, table = np.empty(steps), np.empty((steps, head_speed.SPEED_NODES, 2))
    at = np.linspace(first, last, steps * FINER + 1)
    per = max(1, AT_ONCE // (handles * FINER))
    with PeakQuestion(walk, EVEN.stretches(first, last)) as question:
        for n in range(0, steps, per):
            end = min(n + per, steps)
            budget.spend(kernel.BOUNDED * (end - n) * FINER * handles)
            square = plan.walk.speed**2
            if question.bound(at, n, end, square, np.array(limits), most, table) == SpeedEnding.FALLEN:
                raise failure_within(walk, first, last)
            progress(end / steps, _("other limits"))
            question.rest()
    ends = np.array([at[n * FINER] for n in range(steps + 1)])
    times, speeds = np.empty(steps + 1), np.empty(steps + 1)
    count = head_speed.find_pace(table, most, ends, times, speeds)
    if count < 0:
        text = _("no speed of the head was found that keeps the limits at {s} m of the route")
        raise UnsureError(text.format(s=f"{ends[-1 - count]:.6g}"))
    return times[:count].tolist(), speeds[:count].tolist()


def with_pace(plan: Plan, pace: Pace) -> Plan:
    """The same plan walked at a pace."""
    knots = list(zip(pace.profile.times, pace.profile.speeds, strict=True))
    values = {"walk.profile": knots, "walk.start": knots[0][0]}
    if plan.walk.end is not None:
        values["walk.end"] = knots[0][0] + pace.seconds
    return plan.with_values(values)


def with_head_speed(plan: Plan, speed: float) -> Plan:
    """The same dance with its head at another constant speed, m/s.

    The head begins and ends where it did, so that all marks on the ground stay; what it stands for
    lasts as long as before.

    Raises:
        InputError: for a speed that cannot be, a plan with a speed profile, or with cues given by their
            times.
        WalkError: if the dragon cannot walk on.
    """
    if plan.walk.profile:
        raise InputError(_("the plan has a speed profile of its own: take walk.profile out"))
    positive("speed", speed, "m/s")
    if any(cue.at is not None for cue in plan.cues.cue):
        text = _("cues by time (at) would come elsewhere: write head instead, how far the head is then")
        raise InputError(text)
    if speed > MOST_SPEED:
        text = _("at most {most} m/s can be walked, not {speed} m/s")
        raise InputError(text.format(most=f"{MOST_SPEED:g}", speed=f"{speed:g}"))
    walk = plan.build()
    start, end = plan.span(walk)
    last = float(walk.head_position([end])[0])
    begun = round(start * plan.walk.speed / speed, DIGITS)
    moved = plan.with_table(
        "walk", speed=speed, start=None if plan.walk.start is None else begun, end=None
    )
    if plan.walk.end is None:
        return moved
    stands = [one for one in plan.moments() if one.cue.kind in ("hold", "stop") and one.time <= end]
    held = next((one for one in stands if end <= one.until), None)
    if held is None:
        later = moved.build().time_at(last)
    else:  # it stands there for as long as before
        (there,) = [one for one in moved.moments() if one.number == held.number]
        later = there.time + end - held.time
    return moved.with_table("walk", end=round(later, DIGITS))
