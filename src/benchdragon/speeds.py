"""The greatest speed of any handle over a whole walk, bracketed by bounds that hold between looks."""

import math
import time as clock
from collections.abc import Callable

import numpy as np

from benchdragon.answer import Answer, Witness
from benchdragon.errors import InputError, in_order
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.sweep import empty_places, fastest, stand
from benchdragon.messages import _
from benchdragon.motion import Walk

Advance = Callable[[float], None]

# The bracket's width, as a share of the greatest speed.
TOLERANCE = 1e-3
# First steps of the head, as a share of the shortest link; halvings of a step at most.
STEP, DEPTH = 0.15, 24
# Handles times head positions at a time: 60 MB.
PLACES = 1_000_000


def greatest_speed(
    walk: Walk,
    start: float,
    end: float,
    *,
    tolerance: float = TOLERANCE,
    advance: Advance | None = None,
) -> Answer:
    """The greatest speed of any handle from start to end (s), m/s, over continuous time.

    The bracket is at most `tolerance` times the answer wide: its lower end is a speed that was seen,
    its upper end one that no handle exceeds, by a bound on how speeds change (kernels/sweep.py). The
    witness names the handle's bench (handle i leads bench i + 1) and its place.

    Raises:
        InputError: for an end before the start, or a tolerance that is not between 1e-9 and 1.
        WalkError: if the dragon cannot stand at some time that was looked at.
    """
    began = clock.perf_counter()
    if not 1e-9 <= tolerance <= 1.0:
        raise InputError(
            _("tolerance must lie between 1e-9 and 1, not at {value}").format(value=tolerance)
        )
    in_order(start, end)
    first, last = walk.head_position([start, end]).tolist()
    step = STEP * float(walk.dragon.links.min())
    count = max(1, math.ceil((last - first) / step))
    grid = np.linspace(first, last, count + 1)
    per = max(1, PLACES // (len(walk.dragon) + 1))
    best = _Fastest(walk, tolerance)
    for n in range(0, count, per):
        at = grid[n : n + per + 1]
        best.search(at[:-1], at[1:])
        if advance:
            advance(min(1.0, (n + per) / count))
    return best.answer(start, clock.perf_counter() - began)


class _Fastest:
    """The greatest speed seen so far, and what no handle exceeds."""

    def __init__(self, walk: Walk, tolerance: float) -> None:
        self.walk, self.tolerance = walk, tolerance
        self.seen, self.where, self.handle, self.upper, self.looks = -1.0, 0.0, 0, 0.0, 0

    def search(self, a: FloatArray, b: FloatArray) -> None:
        """Look through steps from a to b, m, halving those that may hold a greater speed."""
        for _depth in range(DEPTH):
            bounds = self._bounds(a, b)
            open_ = bounds > self.seen * (1.0 + self.tolerance)
            self.upper = max(self.upper, float(bounds[~open_].max(initial=0.0)))
            if not open_.any():
                return
            a, b, bounds = a[open_], b[open_], bounds[open_]
            middle = 0.5 * (a + b)
            a, b = np.concatenate([a, middle]), np.concatenate([middle, b])
        self.upper = max(self.upper, float(bounds.max(initial=0.0)))

    def _bounds(self, a: FloatArray, b: FloatArray) -> FloatArray:
        """The most that any handle's speed reaches in each step; what is seen there is kept."""
        out = np.empty(len(a))
        per = max(1, PLACES // (len(self.walk.dragon) + 1) // 2)
        for n in range(0, len(a), per):
            out[n : n + per] = self._some_bounds(a[n : n + per], b[n : n + per])
        return out

    def _some_bounds(self, a: FloatArray, b: FloatArray) -> FloatArray:
        walk = self.walk
        at = np.column_stack([a, b]).ravel()
        places = empty_places(len(walk.dragon) + 1, len(at))
        if not stand(walk.route.rows, walk.dragon.links, at, 0, len(at), places):
            Walk(walk.dragon, walk.route).motion(at)  # raises
        self.looks += len(at)
        bounds, handle = np.empty(len(a)), np.empty(len(a), dtype=np.int64)
        slots = np.arange(0, len(at), 2)
        fastest(walk.route.rows, walk.dragon.links, places, slots, bounds, handle)
        speeds = self._head_speeds(at)
        ratio = places.ratio.max(axis=0)
        n = int(np.argmax(ratio * speeds))
        if ratio[n] * speeds[n] > self.seen:
            self.seen, self.where = float(ratio[n] * speeds[n]), float(at[n])
            self.handle = int(np.argmax(places.ratio[:, n]))
        return bounds * self._most_head_speeds(a, b)

    def _head_speeds(self, at: FloatArray) -> FloatArray:
        profile = self.walk.profile
        times = np.array([profile.time(s - self.walk.start) for s in at.tolist()])
        return profile.speed(np.where(np.isfinite(times), times, profile.times[-1]))

    def _most_head_speeds(self, a: FloatArray, b: FloatArray) -> FloatArray:
        """The head's greatest speed in each step: at an end, or at a knot of its profile between."""
        most = np.maximum(self._head_speeds(a), self._head_speeds(b))
        knots = self.walk.start + self.walk.profile.distance(self.walk.profile.times)
        for s, speed in zip(knots.tolist(), self.walk.profile.speeds, strict=True):
            most = np.where((a <= s) & (s <= b), np.maximum(most, speed), most)
        return most

    def answer(self, start: float, seconds: float) -> Answer:
        """What came out."""
        walk = self.walk
        time = max(walk.profile.time(self.where - walk.start), start)
        motion = Walk(walk.dragon, walk.route).motion([self.where])
        point = float(motion.x[0, self.handle]), float(motion.y[0, self.handle])
        bench = min(self.handle + 1, len(walk.dragon))
        witness = Witness(time, self.where, (bench,), point, math.nan)
        upper = max(self.upper, self.seen)
        return Answer(self.seen, self.seen, upper, "m/s", "found", witness, (), self.looks, seconds)
