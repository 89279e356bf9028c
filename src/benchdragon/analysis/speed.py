"""The greatest speed, acceleration or turning rate over a whole walk, and how fast the head may walk.

All of them are bracketed by bounds that hold between evaluations, at whatever speed the head walks: cut
where its acceleration jumps, a walk is searched over the head's place (see kernels/drive.py).
"""

import math
import sys
import time as clock
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from benchdragon.errors import InputError, UnsureError, in_order, of_kind
from benchdragon.i18n import N_, _
from benchdragon.kernels import drive, pacing, speed_bounds, step_bounds
from benchdragon.kernels.chain import rates
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.regions import EDGE
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
# First steps of the head, as a share of the shortest link; halvings of a step at most.
STEP, DEPTH = 0.1, 50
# Handles times steps that are halved at once; more are left, and the bracket stays wider, where a
# walk keeps its greatest value for long.
MOST_OPEN = 5_000_000
# What is never greater than this, in SI units, counts as nothing.
NOTHING = 1e-9
# The bracket's width where a limit is kept, as a share of the value, and of the limit at most.
ROUGHLY, LITTLE = 1e-2, 1e-2
# Steps of the coarse bound, and its cells, as shares of the shortest link; the share of a walk that the
# first ones may leave undecided before finer ones are tried; what a cell costs, in handles bounded
# (design/coarse_bound.py).
COARSE_STEPS, COARSE_CELLS, ROUGH, CELL_COST = (0.8, 0.2, 0.05), (0.05, 0.025, 0.0125), 0.25, 3.0
# Handles times head positions at a time: 60 MB.
PLACES = 1_000_000


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
    """The greatest of a quantity: never more than `upper`.

    It was seen at `time`, s, with the head at s, m, on handle or bench `row` (from 0).
    """

    value: float
    upper: float
    time: float
    s: float
    row: int
    evaluations: int


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
    the quantity changes (kernels/drive.py). Given a `limit`, a value that surely keeps to it has a
    bracket of 1 % of the value or of the limit. The witness names the first handle that reaches it, or
    the bench, and its place.

    Raises:
        InputError: for an end before the start, or a tolerance that is not between 1e-12 and 1.
        WalkError: if the dragon cannot stand at some time that was looked at.
    """
    began = clock.perf_counter()
    of_kind("walk", walk, Walk)
    in_order(start, end)
    stretches = walk.profile.stretches(start, end).moved(walk.start)
    peak = _Search(walk, quantity, tolerance, limit).over(stretches, progress)
    witness = replace(witness_of(walk, quantity, peak), time=peak.time)
    return Answer(
        peak.value, peak.value, peak.upper, quantity.unit, "found", witness, (), peak.evaluations,
        clock.perf_counter() - began,
    )  # fmt: skip


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
    search = _Search(walk, QUANTITIES["speed"], TOLERANCE, math.inf)
    handles, fine = len(walk.dragon) + 1, np.linspace(first, last, steps * finer + 1)
    found = np.zeros((steps, handles, pacing.HULL_COLUMNS))
    found[:, :, pacing.GROWTH_LOW], found[:, :, pacing.GROWTH_HIGH] = math.inf, -math.inf
    per = max(1, PLACES // handles)
    for n in range(0, steps * finer, per):
        at = fine[n : n + per + 1]
        slots = np.arange(len(at) - 1)
        places = search.places(at)
        pacing.widen(walk.route.rows, walk.dragon.links, places, slots, (n + slots) // finer, found)
    return fine[::finer], found


def witness_of(walk: Walk, quantity: Quantity, peak: Peak) -> Witness:
    """Where a peak comes about: handle or bench, and when a head at the walk's own speed is there."""
    motion, row = walk.placement([peak.s]), peak.row
    if quantity.kind == drive.SPEEDS:
        row = fastest_handle(motion.speed_ratio[0])
    point = float(motion.x[0, row]), float(motion.y[0, row])
    time = walk.time_at(peak.s)
    return Witness(
        time if math.isfinite(time) else None, peak.s, (min(row + 1, len(walk.dragon)),), point,
        math.nan, handle=None if quantity.kind == drive.TURNING else row,
    )  # fmt: skip


def fastest_handle(speeds: FloatArray) -> int:
    """The first handle that comes to the greatest of these speeds but for rounding.

    On one arc all handles are equally fast: rounding alone would name now this one and now that.
    """
    return int((speeds >= speeds.max() * (1.0 - ROUNDING)).argmax())


@dataclass(frozen=True)
class _Part:
    """Head positions, m, between which the links' handles need a look: no value is above the bound."""

    start: float
    end: float
    links: FloatArray
    bound: float


class _Search:
    """Branch and bound over the head's position, stretch by stretch of its drive."""

    def __init__(self, walk: Walk, quantity: Quantity, tolerance: float, limit: float) -> None:
        if not LEAST_TOLERANCE <= tolerance <= 1.0:
            raise InputError(
                _("tolerance must lie between {least} and 1, not at {value}").format(
                    least=f"{LEAST_TOLERANCE:g}", value=tolerance
                )
            )
        self.walk, self.quantity, self.tolerance, self.limit = walk, quantity, tolerance, limit
        self.seen, self.where, self.row, self.upper, self.evaluations = -1.0, 0.0, 0, 0.0, 0
        self.stretch = 0
        self._stretches = walk.profile.stretches(0.0, 0.0)
        self._links = walk.dragon.links
        self._per = max(3, PLACES // (len(walk.dragon) + 1))

    def over(self, stretches: Stretches, progress: Progress) -> Peak:
        """The greatest value on these stretches of the walk, their ways being route positions."""
        self._stretches = stretches
        first, last = stretches.ways.ravel()[[0, -1]].tolist()
        parts = self._parts(first, last)
        for n, part in enumerate(self._worthwhile(parts)):
            self._links = part.links
            for at, which in self._grids(part.start, part.end, STEP):
                self._search(at[:-1], at[1:], which, self._bounds(at, np.arange(len(which)), which))
                if last > first:
                    done = (float(at[-1]) - part.start) / (part.end - part.start)
                    progress((n + done) / len(parts), "")
        time = self._stretches.time(self.stretch, self.where)
        return Peak(self.seen, max(self.upper, self.seen), time, self.where, self.row, self.evaluations)

    def _enough(self) -> float:
        """What no bound need be drawn tighter than."""
        if self.seen > self.limit:
            return self.seen * (1.0 + self.tolerance)
        if self.limit < math.inf:
            return min(max(self.seen * (1.0 + ROUGHLY), LITTLE * self.limit), self.limit)
        return max(self.seen * (1.0 + self.tolerance), NOTHING)

    def _parts(self, first: float, last: float) -> list["_Part"]:
        """Where the greatest value may be."""
        whole = _Part(first, last, self.walk.dragon.links, math.inf)
        if self.quantity.kind != drive.SPEEDS or not coarse_bound_pays(self.walk, last - first):
            return [whole]
        for share in COARSE_CELLS:
            cells = _CoarseBound(self.walk, first, last, share)
            parts = list(self._open_parts(cells, whole, COARSE_STEPS[0]))
            # Where the head is fastest all along, as on a spiral inward, no cell may be loose.
            if self.row or sum(part.end - part.start for part in parts) <= ROUGH * (last - first):
                break
        for step in COARSE_STEPS[1:]:
            coarse = self._worthwhile(parts)
            parts = [finer for part in coarse for finer in self._open_parts(cells, part, step)]
        return parts

    def _worthwhile(self, parts: list["_Part"]) -> Iterator["_Part"]:
        """The parts that may still hold a greater value than is seen, the most promising ones first."""
        for part in sorted(parts, key=lambda part: -part.bound):
            if part.bound > self._enough():
                yield part
            else:
                self.upper = max(self.upper, part.bound)

    def _open_parts(self, cells: "_CoarseBound", part: "_Part", step: float) -> Iterator["_Part"]:
        """What the coarse bound leaves undecided of a part, in steps of `step` shortest links."""
        links = self.walk.dragon.links
        for at, which in self._grids(part.start, part.end, step):
            handles, bounds = self._undecided(cells, at, which)
            borders = np.flatnonzero(np.diff(np.concatenate([[0], handles > 0, [0]])))
            for a, b in borders.reshape(-1, 2):
                short = links[: max(int(handles[a:b].max()) - 1, 1)]
                yield _Part(float(at[a]), float(at[b]), short, float(bounds[a:b].max()))

    def _grids(self, first: float, last: float, step: float) -> Iterator[tuple[FloatArray, IntArray]]:
        """Head positions in steps of at most `step` shortest links, as many as fit the memory.

        And the stretch that each step between two of them belongs to.
        """
        ways = self._stretches.ways
        inside = np.flatnonzero((ways[:, 0] <= last) & (ways[:, 1] >= first))
        low, high = np.clip(ways[inside], first, last).T
        counts = np.ceil((high - low) / (step * float(self.walk.dragon.links.min())))
        counts = np.maximum(counts.astype(np.int64), 1)
        shares = np.concatenate([np.arange(count) / count for count in counts])
        which = np.repeat(np.arange(len(inside)), counts)
        grid = np.append(low[which] + shares * (high - low)[which], high[-1])
        for n in range(0, len(which), self._per - 1):
            yield grid[n : n + self._per], inside[which[n : n + self._per - 1]]

    def _drives(self, a: FloatArray, b: FloatArray, which: IntArray) -> FloatArray:
        """The head's drive from a to b, m, on these stretches, (steps, DRIVE_COLUMNS)."""
        ways, squares = self._stretches.ways[which], np.square(self._stretches.speeds[which])
        out = np.empty((len(which), drive.DRIVE_COLUMNS))
        for column, at, none in ((drive.FROM, a, 0.0), (drive.TO, b, 1.0)):
            share = np.full(len(which), none)
            length = ways[:, 1] - ways[:, 0]
            np.divide(at - ways[:, 0], length, out=share, where=length > 0.0)
            share = np.clip(share, 0.0, 1.0)
            out[:, column] = squares[:, 0] + share * (squares[:, 1] - squares[:, 0])
        out[:, drive.RATE] = self._stretches.rates[which]
        return out

    def _undecided(
        self, cells: "_CoarseBound", at: FloatArray, which: IntArray
    ) -> tuple[IntArray, FloatArray]:
        """Handles from the head on that may exceed what is seen, in each step, and bounds on all.

        0 where none may.
        """
        motion = self.walk.placement(at)
        self.evaluations += len(at)
        speeds = np.sqrt(self._drives(at[:-1], at[1:], which)[:, : drive.RATE])
        rows = motion.speed_ratio.argmax(axis=1)
        rows = np.column_stack([rows[:-1], rows[1:]])
        ratios = motion.speed_ratio.max(axis=1)
        values = np.column_stack([ratios[:-1], ratios[1:]]) * speeds
        self._note(at, np.arange(len(which)), which, values, rows)
        most = speeds.max(axis=1)
        wanted = max(self._enough() / step_bounds.ROUNDED_UP, self.seen)
        steps = cells.steps(motion.s.T, wanted / np.maximum(most, sys.float_info.min))
        self.upper = max(
            self.upper, step_bounds.ROUNDED_UP * float((steps[:, speed_bounds.SETTLED] * most).max())
        )
        return steps[:, speed_bounds.OPEN].astype(np.int64), step_bounds.ROUNDED_UP * steps[
            :, speed_bounds.MOST
        ] * most

    def _search(self, a: FloatArray, b: FloatArray, which: IntArray, bounds: FloatArray) -> None:
        """Look through steps from a to b, m, halving those that may hold a greater value."""
        for _depth in range(DEPTH):
            open_ = bounds > self._enough()
            self.upper = max(self.upper, float(bounds[~open_].max(initial=0.0)))
            if not open_.any() or open_.sum() * len(self.walk.dragon) > MOST_OPEN:
                break
            a, b, which, bounds = self._halved(a[open_], b[open_], which[open_])
        self.upper = max(self.upper, float(bounds.max(initial=0.0)))

    def _halved(self, a: FloatArray, b: FloatArray, which: IntArray) -> tuple[Any, ...]:
        """The halves of steps from a to b, m: from where, to where, on which stretch, bounds."""
        middle, per = 0.5 * (a + b), self._per // 3
        halves = [
            self._halves(a[n : n + per], middle[n : n + per], b[n : n + per], which[n : n + per])
            for n in range(0, len(a), per)
        ]
        starts, stops = np.column_stack([a, middle]).ravel(), np.column_stack([middle, b]).ravel()
        return starts, stops, np.repeat(which, 2), np.concatenate(halves)

    def _halves(self, a: FloatArray, middle: FloatArray, b: FloatArray, which: IntArray) -> FloatArray:
        slots = np.arange(len(a))[:, np.newaxis] * 3 + np.arange(2)
        return self._bounds(np.column_stack([a, middle, b]).ravel(), slots.ravel(), np.repeat(which, 2))

    def _bounds(self, at: FloatArray, slots: IntArray, which: IntArray) -> FloatArray:
        """The most that is reached from at[slots[n]] to the next; what is seen at both is kept."""
        rows, links, kind = self.walk.route.rows, self._links, self.quantity.kind
        places = self.places(at)
        drives, bounds = self._drives(at[slots], at[slots + 1], which), np.empty(len(slots))
        drive.ceilings(rows, links, places, slots, drives, kind, bounds)
        self._note(at, slots, which, *values_at(rows, links, places, slots, drives, kind))
        return bounds

    def places(self, at: FloatArray) -> step_bounds.Placements:
        """The dragon with its head at these positions, m."""
        places = step_bounds.empty_placements(len(self._links) + 1, len(at))
        if not step_bounds.place_chain(self.walk.route.rows, self._links, at, 0, len(at), places):
            raise self._failure(at)
        self.evaluations += len(at)
        return places

    def _failure(self, at: FloatArray) -> Exception:
        """Why the dragon does not stand at one of these positions, m."""
        error = self.walk.first_failure(np.sort(at))
        return error or UnsureError(_("it could not be shown that the dragon stands all along"))

    def _note(
        self, at: FloatArray, slots: IntArray, which: IntArray, values: FloatArray, rows: IntArray
    ) -> None:
        """Keep the greatest of the values at the ends of steps, (steps, 2)."""
        n, end = divmod(int(np.argmax(values)), 2)
        if values[n, end] > self.seen:
            self.seen, self.row, self.stretch = float(values[n, end]), int(rows[n, end]), int(which[n])
            self.where = float(at[slots[n] + end])


def values_at(
    rows: FloatArray,
    links: FloatArray,
    places: step_bounds.Placements,
    slots: IntArray,
    drives: FloatArray,
    kind: int,
) -> tuple[FloatArray, IntArray]:
    """The greatest of a quantity at both ends of each step, (steps, 2), and its handle or bench."""
    change, turn = np.empty(places.u.shape), np.empty((len(links), places.u.shape[1]))
    if kind not in {drive.SPEEDS, drive.ACROSS}:
        rates(rows, links, *places[:5], change, turn)
    values, where = np.empty((len(slots), 2)), np.empty((len(slots), 2), dtype=np.int64)
    drive.greatest_at_ends(rows, places, change, turn, slots, drives, kind, values, where)
    return values, where


def coarse_bound_pays(walk: Walk, way: float) -> bool:
    """Whether the coarse bound costs less than evaluations along the whole `way` of the head, m."""
    links = walk.dragon.links
    cells = len(np.unique(links)) * (way + float(links.sum())) / COARSE_CELLS[0]
    return CELL_COST * cells < len(links) * way / STEP


class _CoarseBound:
    """The greatest speed ratios in cells of the route, for the benches of each link: see the kernel."""

    def __init__(self, walk: Walk, first: float, last: float, share: float) -> None:
        links, self._group = np.unique(walk.dragon.links, return_inverse=True)
        s = walk.placement([first, last]).s[:, :-1]
        self._cell = share * float(links[0])
        self._low = math.floor(s[0, -1] / self._cell)
        count = math.floor(last / self._cell) + 1 - self._low
        self._ratios = np.full((len(links), count), math.inf)
        for g in range(len(links)):
            members = np.flatnonzero(self._group == g)
            back, ahead = (float(s[0, members[-1]]) - EDGE, float(s[1, members[0]]) + EDGE)
            a = max(math.floor(back / self._cell) - self._low, 0)
            b = min(math.floor(ahead / self._cell) + 1 - self._low, count)
            borders = np.clip((np.arange(a, b + 1) + self._low) * self._cell, s[0, -1], last)
            link = walk.dragon.links[members[0] : members[0] + 1]
            places = step_bounds.empty_placements(2, len(borders))
            step_bounds.place_chain(walk.route.rows, link, borders, 0, len(borders), places)
            speed_bounds.cell_ratios(walk.route.rows, link, places, self._ratios[g, a:b])

    def steps(self, s: FloatArray, limits: FloatArray) -> FloatArray:
        """What they say of the steps between positions s, m, (handles, T), (T - 1, STEP_COLUMNS)."""
        out = np.empty((len(limits), speed_bounds.STEP_COLUMNS))
        speed_bounds.bound_steps(s, self._group, self._ratios, self._cell, self._low, limits, out)
        return out


def given_limits(plan: Plan) -> dict[str, float]:
    """The plan's limits on what benches do, by the name of the quantity, in SI units."""
    given = {name: getattr(plan.limits, name) for name in QUANTITIES}
    if given["turning_rate"] is not None:
        given["turning_rate"] = math.radians(given["turning_rate"])
    return {name: value for name, value in given.items() if value is not None}
