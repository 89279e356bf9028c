"""The greatest speed, acceleration or turning rate over a whole walk, and how fast the head may walk.

All of them are bracketed by bounds that hold between evaluations, at whatever speed the head walks: cut
where its acceleration jumps, a walk is searched over the head's place (see kernels/peak.py).
"""

import math
import time as clock
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from benchdragon import budget
from benchdragon.analysis.engine_question import EngineQuestion
from benchdragon.analysis.rounds import Rounds, Span, repeats
from benchdragon.budget import OverBudgetError
from benchdragon.errors import InputError, UnsureError, in_order, of_kind
from benchdragon.i18n import N_, _
from benchdragon.kernels import drive, peak
from benchdragon.kernels import peak_memory as told
from benchdragon.kernels import peak_question as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.peak_question import STEP
from benchdragon.kernels.question import MORE
from benchdragon.kernels.route import IntArray
from benchdragon.model.answer import ROUNDING, Answer, Witness
from benchdragon.model.profile import SpeedProfile, Stretches
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent

# The bracket's width, as a share of the value; rounding allows no narrower than the least.
TOLERANCE, LEAST_TOLERANCE = 1e-10, 1e-12
# The same for accelerations and turning rates, whose bounds close more slowly.
RATE_TOLERANCE = 1e-6
# What the engine goes by, in the order of kernels/peak_memory.py: 24 MB of cells at a time, a look at
# the clock every 20 ms, and the coarse bound's cost, steps and loss (design/coarse_bound.py).
ROOM = (500_000, 1_024, 5_000_000, 100_000, 24.0, 0.8, 0.1, ROUNDING)
# Handles placed at a time where it is looked for why a dragon does not stand.
PLACES = 1_000_000
# What it may take to tell of a bracket that was not closed, as a share of a question's work.
TOLD = 0.001


@dataclass(frozen=True)
class Quantity:
    """What is limited: its number in the kernels, and its power of the speed of a steady head."""

    name: str
    kind: int
    power: int
    unit: str
    text: str


QUANTITIES = {
    quantity.name: quantity
    for quantity in (
        Quantity("speed", drive.SPEEDS, 1, "m/s", N_("speed of a handle")),
        Quantity("turning_rate", drive.TURNING, 1, "rad/s", N_("turning rate of a bench")),
        Quantity(
            "lateral_acceleration", drive.ACROSS, 2, "m/s^2", N_("lateral acceleration of a handle")
        ),
        Quantity("total_acceleration", drive.TOTAL, 2, "m/s^2", N_("total acceleration of a handle")),
        Quantity(
            "acceleration", drive.ALONG, 2, "m/s^2", N_("acceleration of a handle along the route")
        ),
    )
}


@dataclass(frozen=True)
class Peak:
    """The greatest of a quantity: never more than `upper`, and surely as much as `least`.

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
    walk: Walk, start: float, end: float, *, tolerance: float = TOLERANCE, progress: Progress = silent,
) -> Answer:  # fmt: skip
    """The greatest speed of any handle from start to end (s), m/s, over continuous time.

    See `greatest`.

    Raises:
        InputError: for an end before the start, or a tolerance that is not between 1e-12 and 1.
        WalkError: if the dragon cannot stand at some time that was looked at.
    """
    return greatest(walk, QUANTITIES["speed"], start, end, tolerance=tolerance, progress=progress)


@budget.question()
def greatest(
    walk: Walk, quantity: Quantity, start: float, end: float, *, tolerance: float = TOLERANCE,
    limit: float = math.inf, progress: Progress = silent,
) -> Answer:  # fmt: skip
    """The greatest of a quantity from start to end (s), in its unit, over continuous time.

    Where the head's acceleration or a curvature jumps, what is just before and just after counts. The
    bracket is `tolerance` times the answer wide (wider where the greatest value lasts, infinite across
    a kink of the route): its lower end was seen, its upper end is exceeded by nobody, by a bound on how
    the quantity changes (kernels/drive.py). Both have room for rounding (kernels/rate_rounding.py).
    Given a `limit`, a value that surely keeps to it has a bracket of 1 % of the value or of the limit.
    The witness names the first handle that reaches it, or the bench, and its place.

    Raises:
        InputError: for an end before the start, or a tolerance that is not between 1e-12 and 1.
        WalkError: if the dragon cannot stand at some time that was looked at.
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
        WalkError: if the dragon cannot stand at some position that was looked at.
    """
    stretches = SpeedProfile.constant(1.0).stretches(first, last)
    return sought(walk, stretches, [(quantity, tolerance, limit)], progress).peak


@dataclass(frozen=True)
class Found:
    """What the engine found: a greatest value, or that of the limit that decides on a head speed.

    Then that speed lies between `lower` and `upper`, m/s; `decides` is None if nothing limits it.
    """

    peak: Peak
    lower: float
    upper: float
    decides: Quantity | None


# Quantities, with the widths of their brackets, as shares, and their limits.
Asked = Iterable[tuple[Quantity, float, float]]


class PeakQuestion(EngineQuestion):
    """A question about a walk, kernels/peak_question.py, whose head is driven so, as `sought` says."""

    def __init__(self, walk: Walk, drives: Stretches, asked: Asked = (), head: float = 0.0) -> None:
        links, tolerances = walk.dragon.links, np.zeros(drive.QUANTITIES)
        limits = np.full(drive.QUANTITIES, math.inf)
        for quantity, tolerance, limit in asked:
            if not LEAST_TOLERANCE <= tolerance <= 1.0:
                raise InputError(
                    _("tolerance must lie between {least} and 1, not at {value}").format(
                        least=f"{LEAST_TOLERANCE:g}", value=tolerance
                    )
                )
            tolerances[quantity.kind], limits[quantity.kind] = tolerance, limit
        kinds, group = np.unique(links, return_inverse=True)
        driven = peak.Drives(drives.ways, np.square(drives.speeds), np.ascontiguousarray(drives.rates))
        numbers = np.array([float(links.sum()), head, *ROOM])
        handle = kernel.open_peak(
            walk.route.rows, links, kinds, group.astype(np.int64), driven, tolerances, limits, numbers
        )
        super().__init__(handle, kernel.step_peak, kernel.read_peak, np.zeros(told.FIGURES))

    def bound(self, *asked: Any) -> int:
        """Fill tables of a pace, as `bound_peak` says; how that ended."""
        return kernel.bound_peak(self._handle, *asked)


def sought(
    walk: Walk, stretches: Stretches, asked: Asked, progress: Progress, head: float = 0.0
) -> Found:
    """Seek the greatest of a quantity on stretches of a walk, their ways being route positions.

    Or the greatest head speed, up to `head`, m/s, that keeps several limits; its stretch is of 1 m/s.

    Raises:
        InputError: for a tolerance that is not between 1e-12 and 1.
        WalkError: if the dragon cannot stand at some position that was looked at.
    """
    quantities, ending = list(QUANTITIES.values()), MORE
    drives, kept = _new(walk, stretches)
    with PeakQuestion(walk, drives, asked, head) as question:
        figures = question.figures
        while ending == MORE:
            try:
                ending = question.step()
            except OverBudgetError:
                if not figures[told.GIVEN_UP]:
                    raise
                ending = kernel.DONE
                budget.allow(TOLD)
            name = quantities[int(figures[told.QUANTITY])].text if head else ""
            progress(float(figures[told.SHARE]), name and _(name))
    if ending == kernel.FALLEN:
        raise failure_within(walk, float(figures[told.LOW]), float(figures[told.HIGH]))
    value, least, most, s, row, x, y, stretch, placed, lower, upper, decides = figures[
        told.VALUE : told.QUANTITY
    ].tolist()
    time = stretches.time(int(kept[int(stretch)]), s)
    seen = Peak(value, most, time, s, int(row), int(placed), least, (x, y))
    return Found(seen, lower, upper, quantities[int(decides)] if decides >= 0.0 else None)


def _new(walk: Walk, stretches: Stretches) -> tuple[Stretches, IntArray]:
    """The parts of stretches on which something new may be seen, and the number of each one's stretch.

    Who keeps one speed does what was done one round before.
    """
    ways, kept = list[Span](), list[int]()
    rounds = Rounds(walk, repeats(walk.route.rows))
    steady = (stretches.rates == 0.0).tolist()
    for n, (first, last) in enumerate(stretches.ways.tolist()):
        spans = rounds.new(first, last)[0] if steady[n] else [(first, last)]
        ways += spans
        kept += [n] * len(spans)
    times, _ways, speeds, rates = (table[kept] for table in stretches)
    return Stretches(times, np.array(ways), speeds, rates), np.array(kept)


def witness_of(walk: Walk, quantity: Quantity, found: Peak) -> Witness:
    """Where a peak comes about: handle or bench, and when a head at the walk's own speed is there."""
    time, row = walk.time_at(found.s), found.row
    return Witness(
        time if math.isfinite(time) else None, found.s, (min(row + 1, len(walk.dragon)),), found.point,
        math.nan, handle=None if quantity.kind == drive.TURNING else row,
    )  # fmt: skip


def fastest_handle(speeds: FloatArray) -> int:
    """The first handle that comes to the greatest of these speeds but for rounding.

    On one arc all handles are equally fast: rounding alone would name now this one and now that.
    """
    return int((speeds >= speeds.max() * (1.0 - ROUNDING)).argmax())


def failure_within(walk: Walk, low: float, high: float) -> Exception:
    """Why a dragon does not stand with its head somewhere in low..high, m."""
    end, step = min(high, walk.route.length), STEP * float(walk.dragon.links.min())
    count, per = math.ceil(max(end - low, 0.0) / step), max(2, PLACES // (len(walk.dragon) + 1))
    for n in range(0, count + 1, per - 1):
        error = walk.first_failure(np.minimum(low + step * np.arange(n, n + per), max(low, end)))
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
