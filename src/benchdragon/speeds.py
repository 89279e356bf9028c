"""The greatest speed, acceleration or turning rate over a whole walk, and how fast the head may walk.

All of them are bracketed by bounds that hold between looks. With a head that walks steadily at v
they are v, v^2 and v times what the route makes of a head at 1 m/s.
"""

import math
import sys
import time as clock
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from benchdragon.answer import Answer, Witness
from benchdragon.errors import InputError, in_order
from benchdragon.kernels import sieve, sweep
from benchdragon.kernels.cells import EDGE
from benchdragon.kernels.chain import rates
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray
from benchdragon.leader import SpeedProfile
from benchdragon.messages import N_, _
from benchdragon.motion import Walk

Advance = Callable[[float], None]

# The bracket's width, as a share of the value; rounding allows no narrower than the least.
TOLERANCE, LEAST_TOLERANCE = 1e-10, 1e-12
# First steps of the head, as a share of the shortest link; halvings of a step at most.
STEP, DEPTH = 0.1, 50
# Handles times steps that are halved at once; more are left, and the bracket stays wider, where a
# walk keeps its greatest value for long.
MOST_OPEN = 5_000_000
# What is never greater than this, in SI units for a head at 1 m/s, counts as nothing.
NOTHING = 1e-9
# A ceiling may lie so much above what is seen at the ends of its step, relative, before that is halved,
# and so often.
LOOSE, MOST_HALVINGS = 1e-4, 10
# Steps of a sieve, and its cells, as shares of the shortest link; the share of a walk that the first
# ones may let through before finer ones are tried; what a cell costs, in handles bounded
# (design/sieve.py).
SIEVE_STEPS, SIEVE_CELLS, ROUGH, CELL_COST = (0.8, 0.2, 0.05), (0.05, 0.025, 0.0125), 0.25, 3.0
# Handles times head positions at a time: 60 MB.
PLACES = 1_000_000


@dataclass(frozen=True)
class Quantity:
    """What is limited, for a head at 1 m/s: its column in the kernels, and its power of head speed."""

    name: str
    column: int
    power: int
    unit: str
    text: str


QUANTITIES = {
    quantity.name: quantity
    for quantity in (
        Quantity("speed", sweep.SPEED, 1, "m/s", N_("speed of a handle")),
        Quantity("acceleration", sweep.FORCE, 2, "m/s^2", N_("acceleration of a handle")),
        Quantity("turning_rate", sweep.SWAY, 1, "rad/s", N_("turning rate of a bench")),
    )
}


@dataclass(frozen=True)
class Peak:
    """The greatest of a quantity: never more than `upper`.

    It was seen with the head at s, m, on handle or bench `row` (from 0).
    """

    value: float
    upper: float
    s: float
    row: int
    looks: int


def greatest_speed(
    walk: Walk,
    start: float,
    end: float,
    *,
    tolerance: float = TOLERANCE,
    advance: Advance | None = None,
) -> Answer:
    """The greatest speed of any handle from start to end (s), m/s, over continuous time.

    The bracket is `tolerance` times the answer wide (wider where
    the greatest speed lasts): its lower end is a speed that was seen,
    its upper end one that no handle exceeds, by a bound on how speeds change (kernels/sweep.py). The
    witness names the handle's bench (handle i leads bench i + 1) and its place.

    Raises:
        InputError: for an end before the start, or a tolerance that is not between 1e-12 and 1.
        WalkError: if the dragon cannot stand at some time that was looked at.
    """
    began = clock.perf_counter()
    in_order(start, end)
    first, last = walk.head_position([start, end]).tolist()
    search = _Search(walk, QUANTITIES["speed"], tolerance, walk.profile)
    peak = search.over(first, last, advance)
    witness = witness_of(walk, peak)
    if witness.time is None:  # the head stands there all along
        witness = replace(witness, time=start)
    seconds = clock.perf_counter() - began
    return Answer(peak.value, peak.value, peak.upper, "m/s", "found", witness, (), peak.looks, seconds)


def greatest_of(
    walk: Walk,
    quantity: Quantity,
    first: float,
    last: float,
    *,
    tolerance: float = TOLERANCE,
    advance: Advance | None = None,
) -> Peak:
    """The greatest of a quantity while a head at 1 m/s walks from position first to last, m.

    The bracket is `tolerance` times the value wide; infinite across a kink of the route. Where the
    route's curvature jumps accelerations jump, and their bracket is some tenth of the value wide.

    Raises:
        InputError: for a tolerance that is not between 1e-12 and 1.
        WalkError: if the dragon cannot stand at some position that was looked at.
    """
    return _Search(walk, quantity, tolerance, None).over(first, last, advance)


def ceilings(
    walk: Walk, quantity: Quantity, first: float, last: float
) -> tuple[FloatArray, FloatArray]:
    """Head positions from first to last, m, and what the quantity exceeds in no step between them.

    For a head at 1 m/s; one bound fewer than positions.

    Raises:
        WalkError: if the dragon cannot stand at one of the positions.
    """
    search = _Search(walk, quantity, TOLERANCE, None)
    blocks = [(at, search.ceilings(at, *bounds)) for at, *bounds in search.blocks(first, last)]
    at, ceilings = ([block[n] for block in blocks] for n in range(2))
    return np.append(np.concatenate([some[:-1] for some in at]), last), np.concatenate(ceilings)


def witness_of(walk: Walk, peak: Peak) -> Witness:
    """Where a peak comes about: its bench, and when a head at the walk's own speed is there."""
    motion = Walk(walk.dragon, walk.route).motion([peak.s])
    point = float(motion.x[0, peak.row]), float(motion.y[0, peak.row])
    time = walk.profile.time(peak.s - walk.start)
    benches = (min(peak.row + 1, len(walk.dragon)),)
    return Witness(time if math.isfinite(time) else None, peak.s, benches, point, math.nan)


def part_of(
    advance: Callable[[float, str], None] | None, text: str, parts: int = 1
) -> Callable[[float], None]:
    """What turns the growing share of one search of `parts` into advances under a text."""
    done = 0.0

    def tell(share: float) -> None:
        nonlocal done
        if advance is not None and share > done:
            advance((share - done) / parts, text)
            done = share

    return tell


@dataclass(frozen=True)
class _Part:
    """Head positions, m, between which the links' handles need a look: no value is above the bound."""

    start: float
    end: float
    links: FloatArray
    bound: float


class _Search:
    """Branch and bound over the head's position."""

    def __init__(
        self, walk: Walk, quantity: Quantity, tolerance: float, profile: SpeedProfile | None
    ) -> None:
        if not LEAST_TOLERANCE <= tolerance <= 1.0:
            raise InputError(
                _("tolerance must lie between {least} and 1, not at {value}").format(
                    least=f"{LEAST_TOLERANCE:g}", value=tolerance
                )
            )
        self.walk, self.quantity, self.tolerance, self.profile = walk, quantity, tolerance, profile
        self.seen, self.where, self.row, self.upper, self.looks = -1.0, 0.0, 0, 0.0, 0
        self._links = walk.dragon.links
        self._per = max(3, PLACES // (len(walk.dragon) + 1))

    def over(self, first: float, last: float, advance: Advance | None) -> Peak:
        """The greatest value with the head between first and last, m."""
        parts = self._parts(first, last)
        for n, part in enumerate(self._worthwhile(parts)):
            self._links = part.links
            for at, bounds, _ends in self.blocks(part.start, part.end):
                self._search(at[:-1], at[1:], bounds)
                if advance and last > first:
                    done = (float(at[-1]) - part.start) / (part.end - part.start)
                    advance((n + done) / len(parts))
        if advance and last > first:
            advance(1.0)
        return Peak(self.seen, max(self.upper, self.seen), self.where, self.row, self.looks)

    def _parts(self, first: float, last: float) -> list["_Part"]:
        """Where the greatest value may be."""
        whole = _Part(first, last, self.walk.dragon.links, math.inf)
        if self.quantity.column != sweep.SPEED or not sieve_pays(self.walk, last - first):
            return [whole]
        for share in SIEVE_CELLS:
            cells = _Sieve(self.walk, first, last, share)
            parts = list(self._open_parts(cells, whole, SIEVE_STEPS[0]))
            # Where the head is fastest all along, as on a spiral inward, no cell may be loose.
            if self.row or sum(part.end - part.start for part in parts) <= ROUGH * (last - first):
                break
        for step in SIEVE_STEPS[1:]:
            coarse = self._worthwhile(parts)
            parts = [finer for part in coarse for finer in self._open_parts(cells, part, step)]
        return parts

    def _worthwhile(self, parts: list["_Part"]) -> Iterator["_Part"]:
        """The parts that may still hold a greater value than is seen, the most promising ones first."""
        for part in sorted(parts, key=lambda part: -part.bound):
            if part.bound > max(self.seen * (1.0 + self.tolerance), NOTHING):
                yield part
            else:
                self.upper = max(self.upper, part.bound)

    def _open_parts(self, cells: "_Sieve", part: "_Part", step: float) -> Iterator["_Part"]:
        """What a sieve lets through of a part of the walk, in steps of `step` shortest links."""
        links = self.walk.dragon.links
        for at in self._grids(part.start, part.end, step):
            handles, bounds = self._sifted(cells, at)
            borders = np.flatnonzero(np.diff(np.concatenate([[0], handles > 0, [0]])))
            for a, b in borders.reshape(-1, 2):
                short = links[: max(int(handles[a:b].max()) - 1, 1)]
                yield _Part(float(at[a]), float(at[b]), short, float(bounds[a:b].max()))

    def _grids(self, first: float, last: float, step: float) -> Iterator[FloatArray]:
        """Head positions in steps of `step` shortest links, as many as fit the memory."""
        count = max(1, math.ceil((last - first) / (step * float(self.walk.dragon.links.min()))))
        grid = np.linspace(first, last, count + 1)
        for n in range(0, count, self._per - 1):
            yield grid[n : n + self._per]

    def _sifted(self, cells: "_Sieve", at: FloatArray) -> tuple[IntArray, FloatArray]:
        """Handles from the head on that may exceed what is seen, in each step, and bounds on all.

        0 where none may.
        """
        motion = Walk(self.walk.dragon, self.walk.route).motion(at)
        factors, most = np.ones(len(at)), np.ones(len(at) - 1)
        if self.profile is not None:
            factors = self._head_speeds(self.profile, at)
            most = self._most_head_speeds(self.profile, at, np.arange(len(at) - 1), factors)
        self.looks += len(at)
        self._note(at, motion.speed_ratio.T, factors)
        wanted = self.seen * max(1.0, (1.0 + self.tolerance) / sweep.ROUNDED_UP)
        steps = cells.steps(motion.s.T, max(wanted, NOTHING) / np.maximum(most, sys.float_info.min))
        self.upper = max(self.upper, sweep.ROUNDED_UP * float((steps[:, sieve.SETTLED] * most).max()))
        return steps[:, sieve.OPEN].astype(np.int64), sweep.ROUNDED_UP * steps[:, sieve.MOST] * most

    def blocks(self, first: float, last: float) -> Iterator[tuple[FloatArray, ...]]:
        """First steps, as many as fit the memory.

        Head positions, m; the most that is reached between each two; the greater at both of them.
        """
        for at in self._grids(first, last, STEP):
            yield at, *self._bounds(at, np.arange(len(at) - 1))

    def ceilings(self, at: FloatArray, bounds: FloatArray, ends: FloatArray) -> FloatArray:
        """The bounds between neighbours in `at`, made tighter by halving where they are loose."""
        out, which = np.zeros(len(bounds)), np.arange(len(bounds))
        a, b = at[:-1], at[1:]
        for _halving in range(MOST_HALVINGS):
            loose = bounds > ends * (1.0 + LOOSE)
            np.maximum.at(out, which[~loose], bounds[~loose])
            which = np.repeat(which[loose], 2)
            if not len(which):
                return out
            a, b, bounds, ends = self.halved(a[loose], b[loose])
        np.maximum.at(out, which, bounds)
        return out

    def _search(self, a: FloatArray, b: FloatArray, bounds: FloatArray) -> None:
        """Look through steps from a to b, m, halving those that may hold a greater value."""
        for _depth in range(DEPTH):
            open_ = bounds > max(self.seen * (1.0 + self.tolerance), NOTHING)
            self.upper = max(self.upper, float(bounds[~open_].max(initial=0.0)))
            if not open_.any() or open_.sum() * len(self.walk.dragon) > MOST_OPEN:
                break
            a, b, bounds, _ends = self.halved(a[open_], b[open_])
        self.upper = max(self.upper, float(bounds.max(initial=0.0)))

    def halved(self, a: FloatArray, b: FloatArray) -> tuple[FloatArray, ...]:
        """The halves of steps from a to b, m: from where, to where, and see `blocks`."""
        middle, per = 0.5 * (a + b), self._per // 3
        parts = [
            self._halves(*(edge[n : n + per] for edge in (a, middle, b))) for n in range(0, len(a), per)
        ]
        starts, stops = np.column_stack([a, middle]).ravel(), np.column_stack([middle, b]).ravel()
        bounds, ends = (np.concatenate([part[n] for part in parts]) for n in range(2))
        return starts, stops, bounds, ends

    def _halves(
        self, a: FloatArray, middle: FloatArray, b: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        slots = np.arange(len(a))[:, np.newaxis] * 3 + np.arange(2)
        return self._bounds(np.column_stack([a, middle, b]).ravel(), slots.ravel())

    def _bounds(self, at: FloatArray, slots: IntArray) -> tuple[FloatArray, FloatArray]:
        """The most that is reached from at[slots[n]] to the next, and at both; what is seen is kept."""
        rows, links = self.walk.route.rows, self._links
        places = sweep.empty_places(len(links) + 1, len(at))
        if not sweep.stand(rows, links, at, 0, len(at), places):
            Walk(self.walk.dragon, self.walk.route).motion(at)  # raises
        self.looks += len(at)
        bounds = np.empty(len(slots))
        sweep.ceilings(rows, links, places, slots, self.quantity.column, bounds)
        values = self._values(places)
        factors = np.ones(len(at))
        if self.profile is not None:
            factors = self._head_speeds(self.profile, at)
            bounds *= self._most_head_speeds(self.profile, at, slots, factors)
        greatest = self._note(at, values, factors)
        return bounds, np.maximum(greatest[slots], greatest[slots + 1])

    def _note(self, at: FloatArray, values: FloatArray, factors: FloatArray) -> FloatArray:
        """The greatest value at each head position, what is seen being kept."""
        greatest: FloatArray = values.max(axis=0) * factors
        n = int(np.argmax(greatest))
        if greatest[n] > self.seen:
            self.seen, self.where = float(greatest[n]), float(at[n])
            self.row = int(np.argmax(values[:, n]))
        return greatest

    def _values(self, places: sweep.Places) -> FloatArray:
        """The quantity at each slot, (handles or benches, slots)."""
        if self.quantity.column == sweep.SPEED:
            return places.ratio
        rows, links = self.walk.route.rows, self._links
        change, turn = np.empty(places.u.shape), np.empty((len(links), places.u.shape[1]))
        rates(
            rows, links, places.row, places.u, places.x, places.y, places.ratio, change, turn
        )  # fmt: skip
        if self.quantity.column == sweep.SWAY:
            return np.abs(turn)
        out = np.empty(change.shape)
        sweep.forces(rows, places, change, out)
        return out

    def _head_speeds(self, profile: SpeedProfile, at: FloatArray) -> FloatArray:
        if len(profile.times) == 1:
            return np.full(len(at), profile.speeds[0])
        times = np.array([profile.time(s - self.walk.start) for s in at.tolist()])
        return profile.speed(np.clip(times, profile.times[0], profile.times[-1]))

    def _most_head_speeds(
        self, profile: SpeedProfile, at: FloatArray, slots: IntArray, speeds: FloatArray
    ) -> FloatArray:
        """The head's greatest speed in each step: at an end, or at a knot of its profile between."""
        a, b = at[slots], at[slots + 1]
        most = np.maximum(speeds[slots], speeds[slots + 1])
        knots = self.walk.start + profile.distance(profile.times)
        for s, speed in zip(knots.tolist(), profile.speeds, strict=True):
            most = np.where((a <= s) & (s <= b), np.maximum(most, speed), most)
        return most


def sieve_pays(walk: Walk, way: float) -> bool:
    """Whether a sieve costs less than a look along the whole `way` of the head, m."""
    links = walk.dragon.links
    cells = len(np.unique(links)) * (way + float(links.sum())) / SIEVE_CELLS[0]
    return CELL_COST * cells < len(links) * way / STEP


class _Sieve:
    """The greatest speed ratios in cells of the route, for the benches of each link: see the kernel."""

    def __init__(self, walk: Walk, first: float, last: float, share: float) -> None:
        links, self._group = np.unique(walk.dragon.links, return_inverse=True)
        s = Walk(walk.dragon, walk.route).motion([first, last]).s[:, :-1]
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
            places = sweep.empty_places(2, len(borders))
            sweep.stand(walk.route.rows, link, borders, 0, len(borders), places)
            sieve.cell_ratios(walk.route.rows, link, places, self._ratios[g, a:b])

    def steps(self, s: FloatArray, limits: FloatArray) -> FloatArray:
        """What they say of the steps between positions s, m, (handles, T), (T - 1, STEP_COLUMNS)."""
        out = np.empty((len(limits), sieve.STEP_COLUMNS))
        sieve.bound_steps(s, self._group, self._ratios, self._cell, self._low, limits, out)
        return out
