"""The greatest speed, acceleration or turning rate over a whole walk, and how fast the head may walk.

All of them are bracketed by bounds that hold between evaluations, at whatever speed the head walks: cut
where its acceleration jumps, a walk is searched over the head's place (see kernels/speed_search.py).
"""

import math
import time as clock
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from benchdragon import budget
from benchdragon.analysis.asked import asked_of
from benchdragon.analysis.engine_question import EngineQuestion
from benchdragon.analysis.rounds import Rounds, Span, repeats
from benchdragon.budget import OverBudgetError
from benchdragon.errors import InputError, UnsureError, in_order, of_kind
from benchdragon.i18n import N_, _
from benchdragon.kernels import drive
from benchdragon.kernels import speed_memory as told
from benchdragon.kernels import speed_question as kernel
from benchdragon.kernels import speed_search as peak
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.drive import DriveRate
from benchdragon.kernels.question import QuestionEnding
from benchdragon.kernels.speed_memory import SpeedTold
from benchdragon.kernels.speed_question import FIRST_CHAIN_STEP, SpeedEnding
from benchdragon.model.answer import ROUNDING, Answer, Witness
from benchdragon.model.profile import SpeedProfile, Stretches
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent

# The bracket's width, as a share of the value; rounding allows no narrower than the least.
TOLERANCE, LEAST_TOLERANCE = 1e-10, 1e-12
# The same for accelerations and turning rates, whose bounds close more slowly.
RATE_TOLERANCE = 1e-6
# Limits of the engine, in the order of kernels/speed_memory.py: 24 MB of cells at a time, the clock is
# read every 20 ms, and the coarse bound's cost, steps and loss (design/coarse_bound.py).
ROOM = (500_000, 1_024, 5_000_000, 100_000, 24.0, 0.8, 0.1, ROUNDING)
# Handles placed at a time when the place is sought where a dragon does not stand.
PLACES = 1_000_000
# Work for reporting a bracket that was not closed, as a share of a question's work.
TOLD = 0.001


@dataclass(frozen=True)
class Quantity:
    """A limited quantity: its number in the kernels, and the power of a steady head speed in it."""

    name: str
    kind: int
    power: int
    unit: str
    text: str


QUANTITIES = {
    quantity.name: quantity
    for quantity in (
        Quantity("speed", DriveRate.SPEEDS, 1, "m/s", N_("speed of a handle")),
        Quantity("turning_rate", DriveRate.TURNING, 1, "rad/s", N_("turning rate of a bench")),
        Quantity(
            "lateral_acceleration", DriveRate.ACROSS, 2, "m/s^2", N_("lateral acceleration of a handle")
        ),
        Quantity(
            "total_acceleration", DriveRate.TOTAL, 2, "m/s^2", N_("total acceleration of a handle")
        ),
        Quantity(
            "acceleration", DriveRate.ALONG, 2, "m/s^2", N_("acceleration of a handle along the route")
        ),
    )
}


@dataclass(frozen=True)
class Peak:
    """The greatest value of a quantity: never more than `upper`, and surely as much as `least`.

    It was seen at `time`, s, with the head at s, m, on handle or bench `row` (from 0), at `point`, m.
    """

    value: float
    upper: float
    time: float
    s: float
    row: int
    evaluations: int
    least: float = 0.0
    point: tuple[float, float] = (math.nan, math.nan)


def greatest_speed(
    walk: Walk | Plan, start: float | None = None, end: float | None = None, *,
    tolerance: float = TOLERANCE, progress: Progress = silent,
) -> Answer:  # fmt: skip
    """The greatest speed of any handle from start to end (s), m/s, over continuous time.

    Of a plan or a walk: over the whole of it unless start and end are given. See `greatest`.

    Raises:
        InputError: for an end before the start, or a tolerance that is not between 1e-12 and 1.
        WalkError: if the dragon cannot stand at some time that was sampled.

    Examples:
        >>> speed = bd.greatest_speed(bd.read_plan("turn"), 0.0, 20.0)
        >>> round(speed.value, 6), speed.witness.handle
        (1.604793, 3)
    """
    walk, start, end = asked_of(walk, start, end)
    return greatest(walk, QUANTITIES["speed"], start, end, tolerance=tolerance, progress=progress)


@budget.question()
def greatest(
    walk: Walk, quantity: Quantity, start: float, end: float, *, tolerance: float = TOLERANCE,
    limit: float = math.inf, progress: Progress = silent,
) -> Answer:  # fmt: skip
    """The greatest of a quantity from start to end (s), in its unit, over continuous time.

    Where the head's acceleration or a curvature jumps, what is just before and just after counts. The
    bracket is `tolerance` times the answer wide (wider where the greatest value lasts, infinite across
    a kink of the route): its lower end was seen, its upper end is never exceeded, by a Lipschitz bound
    of the quantity (kernels/drive.py). Both have room for rounding (kernels/rate_rounding.py). Given a
    `limit`, a value that surely keeps to it has a bracket of 1 % of the value or of the limit. The
    witness names the first handle that reaches it, or the bench, and its place.

    Raises:
        InputError: for an end before the start, or a tolerance that is not between 1e-12 and 1.
        WalkError: if the dragon cannot stand at some time that was sampled.
    """
    began = clock.perf_counter()
    of_kind("walk", walk, Walk)
    in_order(start, end)
    stretches = walk.profile.stretches(start, end).moved(walk.start)
    found = sought(walk, stretches, [(quantity, tolerance, limit)], progress).peak
    witness = replace(witness_of(walk, quantity, found), time=found.time)
    return Answer(
        found.value, found.least, found.upper, quantity.unit, "found", witness, (), found.evaluations,
        clock.perf_counter() - began,
    )  # fmt: skip


@budget.question()
def greatest_of(
    walk: Walk, quantity: Quantity, first: float, last: float, *, tolerance: float = TOLERANCE,
    limit: float = math.inf, progress: Progress = silent,
) -> Peak:  # fmt: skip
    """The greatest of a quantity while a head at 1 m/s walks from position first to last, m.

    The bracket is as that of `greatest`.

    Raises:
        InputError: for a tolerance that is not between 1e-12 and 1.
        WalkError: if the dragon cannot stand at some position that was sampled.
    """
    stretches = SpeedProfile.constant(1.0).stretches(first, last)
    return sought(walk, stretches, [(quantity, tolerance, limit)], progress).peak


@dataclass(frozen=True)
class Found:
    """The engine's answer: a greatest value, or that of the limit that decides on a head speed.

    Then that speed lies between `lower` and `upper`, m/s; `decides` is None if nothing limits it.
    """

    peak: Peak
    lower: float
    upper: float
    decides: Quantity | None


# Quantities, with the widths of their brackets, as shares, and their limits.
Asked = Iterable[tuple[Quantity, float, float]]


class PeakQuestion(EngineQuestion):
    """A question about a walk, kernels/speed_question.py, whose head is driven so, as `sought` says."""

    def __init__(self, walk: Walk, drives: Stretches, asked: Asked = (), head: float = 0.0) -> None:
        tolerances, limits = [0.0] * drive.QUANTITIES, [math.inf] * drive.QUANTITIES
        for quantity, tolerance, limit in asked:
            if not LEAST_TOLERANCE <= tolerance <= 1.0:
                text = _("tolerance must lie between {least} and 1, not at {value}")
                raise InputError(text.format(least=f"{LEAST_TOLERANCE:g}", value=tolerance))
            tolerances[quantity.kind] = tolerance
            limits[quantity.kind] = limit
        links = walk.dragon.links.tolist()
        kinds = sorted(set(links))
        numbers = {link: n for n, link in enumerate(kinds)}
        group = np.array([numbers[link] for link in links], dtype=np.int64)
        squares = np.array([(slow * slow, fast * fast) for slow, fast in drives.speeds.tolist()])
        driven = peak.Drives(np.array(drives.ways), squares, np.array(drives.rates))
        handle = kernel.open_peak(
            walk.route.rows, walk.dragon.links, np.array(kinds), group, driven, np.array(tolerances),
            np.array(limits), np.array([walk.dragon.extent, head, *ROOM]),
        )  # fmt: skip
        super().__init__(handle, kernel.step_peak, kernel.read_peak, np.zeros(told.SPEED_FIGURES))

    def bound(
        self, at: FloatArray, first: int, last: int, square: float, limits: FloatArray,
        most: FloatArray, table: FloatArray,
    ) -> int:  # fmt: skip
        """Fill tables of a pace as `bound_peak` does; return its exit status."""
        return kernel.bound_peak(self._handle, at, first, last, square, limits, most, table)


def sought(
    walk: Walk, stretches: Stretches, asked: Asked, progress: Progress, head: float = 0.0
) -> Found:
    """Seek the greatest of a quantity on stretches of a walk, their ways being route positions.

    Or the greatest head speed, up to `head`, m/s, that keeps several limits; its stretch is of 1 m/s.

    Raises:
        InputError: for a tolerance that is not between 1e-12 and 1.
        WalkError: if the dragon cannot stand at some position that was sampled.
    """
    quantities, ending = list(QUANTITIES.values()), QuestionEnding.MORE
    drives, kept = _new(walk, stretches)
    with PeakQuestion(walk, drives, asked, head) as question:
        while ending == QuestionEnding.MORE:
            try:
                ending = question.step()
            except OverBudgetError:
                if not question.figures[SpeedTold.GIVEN_UP]:
                    raise
                ending = SpeedEnding.DONE
                budget.allow(TOLD)
            share, number = question.tell(SpeedTold.SHARE, SpeedTold.QUANTITY)
            progress(share, _(quantities[int(number)].text) if head else "")
        if ending == SpeedEnding.FALLEN:
            raise failure_within(walk, *question.tell(SpeedTold.LOW, SpeedTold.HIGH))
        found = question.tell(*range(SpeedTold.VALUE, SpeedTold.QUANTITY))
    value, least, most, s, row, x, y, stretch, placed, lower, upper, decides = found
    time = stretches.time(kept[int(stretch)], s)
    seen = Peak(value, most, time, s, int(row), int(placed), least, (x, y))
    return Found(seen, lower, upper, quantities[int(decides)] if decides >= 0.0 else None)


def _new(walk: Walk, stretches: Stretches) -> tuple[Stretches, list[int]]:
    """The parts of stretches with new motion, and the number of each one's stretch."""
    times, ways, speeds, rates = (table.tolist() for table in stretches)
    rounds = Rounds(walk, repeats(walk.route.rows))
    parts: list[Span] = []
    kept: list[int] = []
    for n, (first, last) in enumerate(ways):
        spans = rounds.new(first, last)[0] if rates[n] == 0.0 else [(first, last)]
        parts += spans
        kept += [n] * len(spans)
    of, fast, change = (np.array([table[n] for n in kept]) for table in (times, speeds, rates))
    return Stretches(of, np.array(parts), fast, change), kept


def witness_of(walk: Walk, quantity: Quantity, found: Peak) -> Witness:
    """Where a peak occurs: handle or bench, and when a head at the walk's own speed is there."""
    time, row = walk.time_at(found.s), found.row
    return Witness(
        time if math.isfinite(time) else None, found.s, (min(row + 1, len(walk.dragon)),), found.point,
        math.nan, handle=None if quantity.kind == DriveRate.TURNING else row,
    )  # fmt: skip


def fastest_handle(speeds: Sequence[float]) -> int:
    """The first handle whose speed is the greatest up to rounding.

    On one arc all handles are equally fast: otherwise rounding would decide.
    """
    most = max(speeds) * (1.0 - ROUNDING)
    return next(n for n, speed in enumerate(speeds) if speed >= most)


def failure_within(walk: Walk, low: float, high: float) -> Exception:
    """Why a dragon does not stand with its head somewhere in low..high, m."""
    end, step = (
        max(low, min(high, walk.route.length)),
        FIRST_CHAIN_STEP * min(walk.dragon.links.tolist()),
    )
    count, per = math.ceil((end - low) / step), max(2, PLACES // (len(walk.dragon) + 1))
    for n in range(0, count + 1, per - 1):
        at = [min(low + step * k, end) for k in range(n, n + per)]
        error = walk.first_failure(np.array(at))
        if error is not None:
            return error
    if (error := walk.first_failure(np.array([high]))) is not None:
        return error
    return UnsureError(_("it could not be shown that the dragon stands all along"))


def given_limits(plan: Plan) -> dict[str, float]:
    """The plan's limits on what benches do, by the name of the quantity, in SI units."""
    given = {name: getattr(plan.limits, name) for name in QUANTITIES}
    if given["turning_rate"] is not None:
        given["turning_rate"] = math.radians(given["turning_rate"])
    return {name: value for name, value in given.items() if value is not None}
