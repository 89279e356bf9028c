"""How fast the head may walk: the greatest constant speed, and a pace that slows only where it must."""

import math
import time as clock
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from benchdragon.answer import Answer
from benchdragon.errors import InputError, UnsureError
from benchdragon.kernels.curve import FloatArray
from benchdragon.leader import MOST_SPEED, SpeedProfile
from benchdragon.messages import _
from benchdragon.motion import Walk
from benchdragon.plan import Plan
from benchdragon.speeds import (
    QUANTITIES,
    TOLERANCE,
    Peak,
    Quantity,
    ceilings,
    greatest_of,
    part_of,
    witness_of,
)

Advance = Callable[[float, str], None]

# A pace stays below what is allowed by this share, far above rounding.
PRUDENCE = 1e-9
# Knots of a pace at most: a plan file takes twice as many.
MOST_KNOTS = 5000
# Rounding of a speed that was seen, relative: some 1e-14 after 200 benches, room for ten times as much.
ROUNDING = 1e-13


@dataclass(frozen=True)
class Pace:
    """A head that slows down only where it must.

    Attributes:
        profile: its speed over time; at time 0 the head stands where the plan says.
        steady: the greatest constant speed that keeps the same limits, m/s.
        seconds: how long the walk takes.
        saved: by how much less than at the steady speed, s.
    """

    profile: SpeedProfile
    steady: Answer
    seconds: float
    saved: float


def given_limits(plan: Plan) -> dict[str, float]:
    """The plan's limits on what benches do, by the name of the quantity, in SI units."""
    limits = plan.limits
    rate = limits.turning_rate
    given = {
        "speed": limits.speed,
        "acceleration": limits.acceleration,
        "turning_rate": None if rate is None else math.radians(rate),
    }
    return {name: value for name, value in given.items() if value is not None}


def _limits_of(plan: Plan) -> dict[str, float]:
    """The same, of a plan that has some."""
    found = given_limits(plan)
    if not found:
        raise InputError(
            _("the plan has no limit that a head speed could keep: set limits.speed=2, for example")
        )
    return found


def greatest_head_speed(
    plan: Plan, *, tolerance: float = TOLERANCE, advance: Advance | None = None
) -> Answer:
    """The greatest constant head speed, m/s, with which the plan's whole walk keeps its limits.

    Limits are those on handles' speeds and accelerations and on benches' turning rates, over
    continuous time. The witness is the handle (its bench, leading it: handle i leads bench i + 1)
    or bench of the limit that decides, its time that of a head at the plan's own speed.

    Raises:
        InputError: without a limit.
        WalkError: if the dragon cannot walk all the way.
    """
    began = clock.perf_counter()
    limits = _limits_of(plan)
    walk = plan.build()
    first, last = walk.head_position(plan.span(walk)).tolist()
    speeds: dict[str, tuple[float, float, float]] = {}
    peaks: dict[str, Peak] = {}
    for name, allowed in limits.items():
        quantity = QUANTITIES[name]
        tell = part_of(advance, _(quantity.text), len(limits))
        peak = greatest_of(walk, quantity, first, last, tolerance=tolerance, advance=tell)
        peaks[name] = peak
        speeds[name] = (
            _head_speed(quantity, allowed, peak.upper),
            _head_speed(quantity, allowed, peak.value),
            _head_speed(quantity, allowed, peak.value / (1.0 + ROUNDING)),
        )
    active = min(speeds, key=lambda name: speeds[name][1])
    lower, (_low, value, upper) = min(low for low, *_rest in speeds.values()), speeds[active]
    if lower > MOST_SPEED:  # what is limited hardly occurs
        return Answer(MOST_SPEED, MOST_SPEED, upper, "m/s", "unlimited")
    return Answer(
        value if lower > 0.0 else math.nan,
        lower,
        upper,
        "m/s",
        "found" if lower > 0.0 else "undecided",
        witness_of(walk, peaks[active]),
        (_assumed(QUANTITIES[active], limits[active]),),
        sum(peak.looks for peak in peaks.values()),
        clock.perf_counter() - began,
    )


def _head_speed(quantity: Quantity, allowed: float, peak: float) -> float:
    return float((allowed / peak) ** (1.0 / quantity.power)) if peak > 0.0 else math.inf


def _assumed(quantity: Quantity, allowed: float) -> str:
    return _("what decides: {quantity}, at most {value} {unit}").format(
        quantity=_(quantity.text), value=f"{allowed:.6g}", unit=quantity.unit
    )


def slowed(plan: Plan, *, advance: Advance | None = None) -> Pace:
    """A pace at the plan's own head speed that slows down only where a limit would be exceeded.

    Between looks no handle or bench exceeds a limit either: over each step of the head the pace keeps
    to what a bound on all of them allows. The head changes its speed by at most
    limits.head_acceleration.

    Raises:
        InputError: without a limit of speed or turning rate, with one of acceleration, or with a
            plan that has a profile already.
        WalkError: if the dragon cannot walk all the way.
        UnsureError: if that could not be decided.
    """
    if plan.limits.acceleration is not None:
        raise InputError(_("a pace that slows down keeps no limits.acceleration: take it out"))
    if plan.walk.profile:
        raise InputError(_("the plan has a profile of its own: take walk.profile out"))
    steady = greatest_head_speed(plan, advance=advance)
    if steady.status == "undecided":
        raise UnsureError(_("it could not be shown that the dragon stands all along"))
    walk = plan.build()
    first, last = walk.head_position(plan.span(walk)).tolist()
    at, allowed = _coarser(*_allowed(walk, _limits_of(plan), first, last))
    speeds = np.minimum(np.append(allowed, math.inf), np.append(math.inf, allowed))
    speeds = _eased(np.minimum(speeds, plan.walk.speed), np.diff(at), plan.limits.head_acceleration)
    times = np.concatenate([[0.0], np.cumsum(2.0 * np.diff(at) / (speeds[1:] + speeds[:-1]))])
    profile = _profile(times, speeds)
    zero = profile.time(walk.start - first)  # at time 0 the head stands at walk.start
    profile = SpeedProfile(tuple(t - zero for t in profile.times), profile.speeds)
    seconds = float(times[-1])
    even = (last - first) / min(steady.lower, plan.walk.speed)
    return Pace(profile, steady, seconds, even - seconds)


def _allowed(
    walk: Walk, limits: dict[str, float], first: float, last: float
) -> tuple[FloatArray, FloatArray]:
    """Head positions, m, and the greatest head speed allowed in each step between them, m/s."""
    allowed: FloatArray | None = None
    for name, limit in limits.items():
        quantity = QUANTITIES[name]
        at, bounds = ceilings(walk, quantity, first, last)
        these = (1.0 - PRUDENCE) * (limit / bounds) ** (1.0 / quantity.power)
        allowed = these if allowed is None else np.minimum(allowed, these)
    if allowed is None:
        raise AssertionError("_limits_of refuses a plan without limits")
    return at, allowed


def _coarser(at: FloatArray, allowed: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Steps joined, the least speed of each kept, until a profile has not too many knots."""
    every = math.ceil(len(allowed) / MOST_KNOTS)
    starts = np.arange(0, len(allowed), every)
    return np.append(at[starts], at[-1]), np.minimum.reduceat(allowed, starts)


def _eased(speeds: FloatArray, steps: FloatArray, acceleration: float) -> FloatArray:
    """The greatest speeds not above these that change by at most `acceleration`, m/s^2."""
    squares = speeds**2
    for n in range(1, len(squares)):
        squares[n] = min(squares[n], squares[n - 1] + 2.0 * acceleration * steps[n - 1])
    for n in range(len(squares) - 2, -1, -1):
        squares[n] = min(squares[n], squares[n + 1] + 2.0 * acceleration * steps[n])
    return np.asarray(np.sqrt(squares))


def _profile(times: FloatArray, speeds: FloatArray) -> SpeedProfile:
    """The profile through these knots, without those inside a stretch of one speed."""
    same = speeds[1:] == speeds[:-1]
    inner = np.append(False, same) & np.append(same, False)
    return SpeedProfile(tuple(times[~inner]), tuple(speeds[~inner]))


def with_pace(plan: Plan, pace: Pace) -> Plan:
    """The same plan walked at a pace."""
    knots = list(zip(pace.profile.times, pace.profile.speeds, strict=True))
    times = {"start": knots[0][0]}
    if plan.walk.end is not None:
        times["end"] = knots[0][0] + pace.seconds
    walk = plan.walk.model_copy(update={"profile": knots, **times})
    return plan.model_copy(update={"walk": walk})
