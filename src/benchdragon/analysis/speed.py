"""The greatest speed, acceleration or turning rate over a whole walk, and how fast the head may walk.

All of them are bracketed by bounds that hold between evaluations, at whatever speed the head walks: cut
where its acceleration jumps, a walk is searched over the head's place (see kernels/peak.py).
"""

import math
import time as clock
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from benchdragon import budget
from benchdragon.analysis.nearby import seams_of
from benchdragon.analysis.rounds import Rounds, Span, repeats
from benchdragon.analysis.tables import PLACES
from benchdragon.budget import OverBudgetError
from benchdragon.errors import InputError, UnsureError, in_order, of_kind
from benchdragon.i18n import N_, _
from benchdragon.kernels import bench_cells as cells
from benchdragon.kernels import drive, pacing, peak
from benchdragon.kernels.chain import Placements, empty_placements, rates
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.regions import EDGE
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.status import Ended
from benchdragon.kernels.step_bounds import place_chain
from benchdragon.model.answer import ROUNDING, Answer, Witness
from benchdragon.model.dragon import Dragon
from benchdragon.model.profile import SpeedProfile, Stretches
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, part, silent

# The bracket's width, as a share of the value; rounding allows no narrower than the least.
TOLERANCE, LEAST_TOLERANCE = 1e-10, 1e-12
# The same for accelerations and turning rates, whose bounds close more slowly.
RATE_TOLERANCE = 1e-6
# First steps of the head that chains bound, as a share of the shortest link.
STEP = 0.1
# Handles times parts of the way that may wait; more are left, and the bracket stays wider, where a walk
# keeps its greatest value for long. And the parts that there is room for at first.
MOST_OPEN, OPEN = 5_000_000, 1_024
# Steps of the coarse bound, and its longest and shortest cells, as shares of the shortest link; what
# their cost is, in handles bounded (design/coarse_bound.py).
COARSE_STEP, COARSE_CELL, FINEST_CELL, CELL_COST = 0.8, 0.4, 0.0125, 24.0
# What it may lose, as a share: in a cell, where no handle is faster than the head at any of so many
# places, as then the least loss hides that all along; elsewhere from the head to the tail.
LEAST_LOSS, MOST_LOSS, SAMPLES = 1e-9, 0.1, 4
# Cells times links that are made at a time: 24 MB. The way is searched in windows of so many.
MOST_CELLS = 500_000
# Handles placed, or cells made, between two looks at the clock: some 20 ms.
BUDGET = 100_000
# What each of these costs, in handles placed.
BOUNDED = 4
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

    It was seen at `time`, s, with the head at s, m, on handle or bench `row` (from 0).
    """

    value: float
    upper: float
    time: float
    s: float
    row: int
    evaluations: int
    least: float = 0.0


def greatest_speed(
    walk: Walk,
    start: float,
    end: float,
    *,
    tolerance: float = TOLERANCE,
    progress: Progress = silent,
) -> Answer:
    """The greatest speed of any handle from start to end (s), m/s, over continuous time.

    See `greatest`.

    Raises:
        InputError: for an end before the start, or a tolerance that is not between 1e-12 and 1.
        WalkError: if the dragon cannot stand at some time that was looked at.
    """
    return greatest(walk, QUANTITIES["speed"], start, end, tolerance=tolerance, progress=progress)


@budget.question()
def greatest(
    walk: Walk,
    quantity: Quantity,
    start: float,
    end: float,
    *,
    tolerance: float = TOLERANCE,
    limit: float = math.inf,
    progress: Progress = silent,
) -> Answer:
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
    found = _Search(walk, quantity, tolerance, limit).over(stretches, progress)
    witness = replace(witness_of(walk, quantity, found), time=found.time)
    return Answer(
        found.value, found.least, found.upper, quantity.unit, "found", witness, (), found.evaluations,
        clock.perf_counter() - began,
    )  # fmt: skip


@budget.question()
def greatest_of(
    walk: Walk,
    quantity: Quantity,
    first: float,
    last: float,
    *,
    tolerance: float = TOLERANCE,
    limit: float = math.inf,
    progress: Progress = silent,
) -> Peak:
    """The greatest of a quantity while a head at 1 m/s walks from position first to last, m.

    The bracket is as that of `greatest`.

    Raises:
        InputError: for a tolerance that is not between 1e-12 and 1.
        WalkError: if the dragon cannot stand at some position that was looked at.
    """
    stretches = SpeedProfile.constant(1.0).stretches(first, last)
    return _Search(walk, quantity, tolerance, limit).over(stretches, progress)


def hulls(
    walk: Walk, first: float, last: float, steps: int, finer: int
) -> tuple[FloatArray, FloatArray]:
    """Head positions from first to last, m, (steps + 1,), and what bounds every handle between them.

    The bounds, (steps, handles, pacing.HULL_COLUMNS), are those of `finer` parts of each step together.

    Raises:
        WalkError: if the dragon cannot stand at one of the positions.
    """
    handles = len(walk.dragon) + 1
    budget.hold(8 * steps * (handles * pacing.HULL_COLUMNS + finer))
    budget.expect(BOUNDED * steps * finer * handles)
    fine = np.linspace(first, last, steps * finer + 1)
    found = np.zeros((steps, handles, pacing.HULL_COLUMNS))
    found[:, :, pacing.GROWTH_LOW], found[:, :, pacing.GROWTH_HIGH] = math.inf, -math.inf
    per, scratch, even = (
        max(1, PLACES // handles),
        drive.scratch_for(handles),
        np.array([1.0, 1.0, 0.0]),
    )
    for n in range(0, steps * finer, per):
        at = fine[n : n + per + 1]
        budget.spend(BOUNDED * len(at) * handles)
        slots, places = np.arange(len(at) - 1), empty_placements(handles, len(at))
        if not place_chain(walk.route.rows, walk.dragon.links, at, 0, len(at), places):
            raise failure_within(walk, first, last)
        which = (n + slots) // finer
        pacing.widen(walk.route.rows, walk.dragon.links, places, slots, which, even, scratch, found)
    return fine[::finer], found


def witness_of(walk: Walk, quantity: Quantity, found: Peak) -> Witness:
    """Where a peak comes about: handle or bench, and when a head at the walk's own speed is there."""
    motion, row = walk.placement([found.s]), found.row
    if quantity.kind == drive.SPEEDS:
        row = fastest_handle(motion.speed_ratio[0])
    point = float(motion.x[0, row]), float(motion.y[0, row])
    time = walk.time_at(found.s)
    return Witness(
        time if math.isfinite(time) else None, found.s, (min(row + 1, len(walk.dragon)),), point,
        math.nan, handle=None if quantity.kind == drive.TURNING else row,
    )  # fmt: skip


def fastest_handle(speeds: FloatArray) -> int:
    """The first handle that comes to the greatest of these speeds but for rounding.

    On one arc all handles are equally fast: rounding alone would name now this one and now that.
    """
    return int((speeds >= speeds.max() * (1.0 - ROUNDING)).argmax())


class _Search:
    """Asks the kernels for the greatest of a quantity, window by window of the head's way."""

    def __init__(self, walk: Walk, quantity: Quantity, tolerance: float, limit: float) -> None:
        if not LEAST_TOLERANCE <= tolerance <= 1.0:
            raise InputError(
                _("tolerance must lie between {least} and 1, not at {value}").format(
                    least=f"{LEAST_TOLERANCE:g}", value=tolerance
                )
            )
        shortest = float(walk.dragon.links.min())
        self.walk, self.step = walk, STEP * shortest
        self._aim = peak.Aim(quantity.kind, tolerance, limit, COARSE_STEP * shortest, self.step)
        self._batch = peak.empty_batch()
        self._chains = peak.chains_for(len(walk.dragon) + 1, seams_of(walk.route.rows))
        self._notes, self._counts = np.zeros(peak.NOTES), np.zeros(peak.COUNTS, dtype=np.int64)
        self._notes[peak.SEEN] = -1.0

    def over(self, stretches: Stretches, progress: Progress) -> Peak:
        """The greatest value on these stretches of the walk, their ways being route positions."""
        ways, kept = self._new(stretches)
        rates = np.ascontiguousarray(stretches.rates[kept])
        drives = peak.Drives(ways, np.square(stretches.speeds[kept]), rates)
        begins = [0, *(np.flatnonzero(ways[1:, 0] > ways[:-1, 1]) + 1).tolist(), len(ways)]
        windows = [
            window
            for first, last in pairwise(begins)
            for window in pairwise(self._windows(float(ways[first, 0]), float(ways[last - 1, 1])))
        ]
        for n, (low, high) in enumerate(windows):
            told = part(progress, n / len(windows), (n + 1) / len(windows), "")
            try:
                self._through(low, high, drives, told)
            except OverBudgetError:
                if self._notes[peak.SEEN] < 0.0:
                    raise
                self._notes[peak.UPPER] = math.inf
                budget.allow(TOLD)
                break
        seen, where, upper, sure, _sided = self._notes.tolist()
        _open, row, stretch, evaluations = self._counts.tolist()
        time = stretches.time(int(kept[stretch]), where)
        return Peak(seen, max(upper, seen), time, where, row, evaluations, sure)

    def _new(self, stretches: Stretches) -> tuple[FloatArray, IntArray]:
        """Where on the stretches something new may be seen, m, (n, 2), and the number of each stretch.

        Who keeps one speed does what was done one round before.
        """
        ways, kept = list[Span](), list[int]()
        rounds = Rounds(self.walk, repeats(self.walk.route.rows))
        steady = (stretches.rates == 0.0).tolist()
        for n, (first, last) in enumerate(stretches.ways.tolist()):
            spans = rounds.new(first, last)[0] if steady[n] else [(first, last)]
            ways += spans
            kept += [n] * len(spans)
        return np.array(ways), np.array(kept)

    def _windows(self, first: float, last: float) -> list[float]:
        """Borders of parts of the way, m, whose cells fit the memory; one part if cells do not pay."""
        links = self.walk.dragon.links
        length = float(links.sum())
        if not coarse_bound_pays(self.walk, last - first):
            return [first, last]
        finest = FINEST_CELL * float(links.min())
        fits = max(MOST_CELLS / len(np.unique(links)) * finest - length, length)
        count = math.ceil((last - first) / fits)
        return [first + (last - first) * (n / count) for n in range(count)] + [last]

    def _through(self, low: float, high: float, drives: peak.Drives, progress: Progress) -> None:
        """Search the head's way from low to high, m."""
        ways, told = drives.ways, _Closing(self._aim.tolerance, progress)
        made = _no_cells(len(self.walk.dragon))
        coarse = coarse_bound_pays(self.walk, high - low)
        if coarse:
            made = self._cells(low, high)
            # What is seen at some places spares bounds at most others.
            at = np.linspace(low, high, SAMPLES)
            stretches = np.minimum(np.searchsorted(ways[:, 1], at), len(ways) - 1)
            self._seek(self._waiting(stretches, at, at, by_cells=False), made, drives, told)
        inside = np.flatnonzero((ways[:, 0] <= high) & (ways[:, 1] >= low))
        starts, ends = np.clip(ways[inside], low, high).T
        self._seek(self._waiting(inside, starts, ends, by_cells=coarse), made, drives, told)
        progress(1.0, "")

    def _waiting(
        self, stretches: IntArray, starts: FloatArray, ends: FloatArray, *, by_cells: bool
    ) -> peak.Heap:
        """A heap in which parts of these stretches, m, wait, all of them ascending."""
        count = self._counts[peak.OPEN] = len(stretches)
        heap = peak.empty_heap(count + OPEN)
        heap.parts[:count, peak.BOUND] = math.inf
        heap.parts[:count, peak.START], heap.parts[:count, peak.END] = starts, ends
        heap.marks[:count, peak.STRETCH] = stretches
        heap.marks[:count, peak.LINKS] = len(self.walk.dragon)
        heap.marks[:count, peak.BY_CELLS] = int(by_cells)
        return heap

    def _seek(
        self,
        heap: peak.Heap,
        made: tuple[IntArray, cells.Cells],
        drives: peak.Drives,
        told: "_Closing",
    ) -> None:
        """Look through what waits in the heap until the bracket is closed, or too much waits."""
        count = self._counts[peak.OPEN]
        low, high = float(heap.parts[0, peak.START]), float(heap.parts[count - 1, peak.END])
        most = len(heap.parts) + (high - low) / self.step + MOST_OPEN / len(self.walk.dragon)
        while True:
            ended = peak.seek_peak(
                self.walk.route.rows, self.walk.dragon.links, *made, self._aim, drives, heap,
                self._batch, self._chains, self._notes, self._counts, BUDGET,
            )  # fmt: skip
            budget.spend(BOUNDED * BUDGET)
            if ended == Ended.FALLEN:
                raise failure_within(self.walk, low, high)
            if ended == Ended.DONE or (ended == Ended.ROOM and len(heap.parts) > most):
                break
            if ended == Ended.ROOM:
                heap = peak.Heap(*(np.concatenate([table, np.empty_like(table)]) for table in heap))
            told(float(self._notes[peak.SEEN]), float(heap.parts[0, peak.BOUND]))
        left = heap.parts[: self._counts[peak.OPEN], peak.BOUND]
        self._notes[peak.UPPER] = max(self._notes[peak.UPPER], float(left.max(initial=0.0)))

    def _cells(self, low: float, high: float) -> tuple[IntArray, cells.Cells]:
        """The cells that the dragon walks through while its head walks from low to high, m.

        And the kind of each bench there.
        """
        placed = self.walk.placement(np.linspace(low, high, SAMPLES), throw=False)
        if placed.status.any():
            raise failure_within(self.walk, low, high)
        links, group = np.unique(self.walk.dragon.links, return_inverse=True)
        members = [np.flatnonzero(group == g)[[-1, 0]] for g in range(len(links))]
        spans = [[placed.s[0, last] - EDGE, placed.s[-1, first] + EDGE] for last, first in members]
        kinds = cells.Kinds(links[:, np.newaxis].copy(), np.array(spans))
        # Where nobody is faster than the head nothing may be lost on the way to the tail.
        slower = placed.speed_ratio.max() <= 1.0 + ROUNDING
        loss = LEAST_LOSS if slower else MOST_LOSS / len(group)
        return group.astype(np.int64), self._cut(kinds, float(placed.s[0, -1]), high, loss)

    def _cut(self, kinds: cells.Kinds, start: float, end: float, loss: float) -> cells.Cells:
        """Cells from start to end, m."""
        shortest, count = float(kinds.links[0, 0]), len(kinds.links)
        longest, least = (share * shortest for share in (COARSE_CELL, FINEST_CELL))
        cuts = cells.Cuts(end, longest, least, loss)
        reached, done = np.array([start, longest]), np.zeros(2, dtype=np.int64)
        made = cells.empty_cells(2 * math.ceil((end - start) / longest), count)
        shop = cells.workshop_for(count, self._chains.errors.seams)
        while True:
            ended = cells.cut_cells(
                self.walk.route.rows, kinds, shop, cuts, made, reached, done, BUDGET
            )
            budget.spend(BOUNDED * BUDGET)
            if ended == Ended.DONE:
                break
            if ended == Ended.ROOM:
                made = cells.Cells(*(np.concatenate([table, np.empty_like(table)]) for table in made))
        whole = int(done[cells.CELLS]) + 1
        return cells.Cells(*(table[:whole] for table in made))


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


class _Closing:
    """Tells how far a bracket is closed, from the first one that is told to `tolerance`."""

    def __init__(self, tolerance: float, progress: Progress) -> None:
        self._tolerance, self._progress, self._first, self._share = tolerance, progress, 0.0, 0.0

    def __call__(self, lower: float, upper: float) -> None:
        gap = upper / lower - 1.0 if lower > 0.0 else math.inf
        if self._tolerance < gap < math.inf:
            gap = math.log(gap / self._tolerance)
            self._first = self._first or gap
            self._share = max(self._share, 1.0 - gap / self._first)
        self._progress(self._share, "")


def _no_cells(benches: int) -> tuple[IntArray, cells.Cells]:
    """No cells, and a kind for each bench."""
    return np.zeros(benches, dtype=np.int64), cells.empty_cells(0, 1)


def greatest_at(rows: FloatArray, dragon: Dragon, places: Placements, quantity: Quantity) -> FloatArray:
    """The greatest of a quantity in each slot with the head at 1 m/s, (slots,); rows of a route."""
    change = np.empty(places.u.shape)
    turn, values = np.empty((len(dragon), places.u.shape[1])), np.empty(places.u.shape[1])
    rates(rows, dragon.links, *places[:5], change, turn)
    drive.greatest_in_slots(rows, places, change, turn, 1.0, 0.0, quantity.kind, values)
    return values


def coarse_bound_pays(walk: Walk, way: float) -> bool:
    """Whether the coarse bound costs less than evaluations along the whole `way` of the head, m."""
    links = walk.dragon.links
    count = len(np.unique(links)) * (way + float(links.sum())) / COARSE_CELL
    return CELL_COST * count < len(links) * way / STEP


def given_limits(plan: Plan) -> dict[str, float]:
    """The plan's limits on what benches do, by the name of the quantity, in SI units."""
    given = {name: getattr(plan.limits, name) for name in QUANTITIES}
    if given["turning_rate"] is not None:
        given["turning_rate"] = math.radians(given["turning_rate"])
    return {name: value for name, value in given.items() if value is not None}
