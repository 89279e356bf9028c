"""When handles pass places of the route and speeds: roots of what is known at all times."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from typing import Self

import numpy as np
from scipy.optimize.elementwise import find_root

from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray, positions
from benchdragon.model.placement import Placement
from benchdragon.model.walk import SLICE_PLACES, Motion, Walk

# How exactly crossings are timed, s.
TOLERANCE = 1e-6


@dataclass(frozen=True)
class Crossings:
    """Crossings of handles, one a row.

    Attributes:
        handle: which, from 0.
        time: s.
        s: route position then, m.
        speed: then, m/s.
        bend: whether it is a place that is passed; else a speed.
        new: number of the span of places, or of speeds, that begins.
    """

    handle: IntArray
    time: FloatArray
    s: FloatArray
    speed: FloatArray
    bend: IntArray
    new: IntArray

    @classmethod
    def joined(cls, some: Sequence[Self]) -> Self:
        """All of these, by handle and then by time."""
        columns = [np.concatenate([getattr(one, f.name) for one in some]) for f in fields(cls)]
        order = np.lexsort((columns[1], columns[0]))
        return cls(*(column[order] for column in columns))

    def by_bench(self, count: int) -> list["Crossings"]:
        """Those of each of the first handles."""
        cuts = np.searchsorted(self.handle, np.arange(1, count))
        parts = [np.split(getattr(self, f.name), cuts) for f in fields(self)]
        return [Crossings(*columns) for columns in zip(*parts, strict=True)]

    def rows(self) -> Iterator[tuple[float, float, float, int, int]]:
        """Time, s, route position, m, speed, m/s, whether of a place, and what begins."""
        columns = (self.time, self.s, self.speed, self.bend, self.new)
        return zip(*(column.tolist() for column in columns), strict=True)


def crossings(walk: Walk, motion: Motion, places: FloatArray, gates: FloatArray) -> Crossings:
    """When front handles of benches pass route positions, m, or speeds, m/s, both ascending.

    Of what is passed between two times of the motion and passed back by the next nothing is known.
    """
    s, speed = motion.s[:, :-1], motion.speed[:, :-1]
    told = [_passed(s, places, 1), _passed(speed, gates, 0)]
    step, handle, bend, new, aim = (np.concatenate(column) for column in zip(*told, strict=True))
    low, high = motion.times[step], motion.times[step + 1]
    out = np.empty((3, len(step)))
    per = max(SLICE_PLACES // (len(walk.dragon) + 1), 1)
    order = np.argsort(handle, kind="stable")
    for first in range(0, len(order), per):
        some = order[first : first + per]
        out[:, some] = _roots(walk, handle[some], bend[some], aim[some], (low[some], high[some]))
    time, place, fast = out
    return Crossings(handle, time, place, fast, bend, new)


def _passed(
    values: FloatArray, gates: FloatArray, bend: int
) -> tuple[IntArray, IntArray, IntArray, IntArray, FloatArray]:
    """Which gates are passed in which steps of values (T, N): step, handle, `bend`, span, gate."""
    spans = np.searchsorted(gates, values, side="right")
    step, handle = np.nonzero(spans[1:] != spans[:-1])
    before, after = spans[step, handle], spans[step + 1, handle]
    count = np.abs(after - before)
    step, handle = np.repeat(step, count), np.repeat(handle, count)
    rising = np.repeat(after > before, count)
    nth = np.arange(len(step)) - np.repeat(np.cumsum(count) - count, count)
    before = np.repeat(before, count)
    new = np.where(rising, before + nth + 1, before - nth - 1)
    gate = gates[np.where(rising, new - 1, new)] if len(step) else np.empty(0)
    return step, handle, np.full(len(step), bend), new, gate


def _roots(
    walk: Walk,
    handle: IntArray,
    bend: IntArray,
    aim: FloatArray,
    bracket: tuple[FloatArray, FloatArray],
) -> FloatArray:
    """Time, s, route position, m, and speed, m/s, of crossings between two times each, (3, n)."""

    def off(times: FloatArray, handle: IntArray, bend: IntArray, aim: FloatArray) -> FloatArray:
        _times, s, speed = _states(walk, handle, times)
        return np.asarray(np.where(bend == 1, s, speed) - aim)

    found = find_root(off, bracket, args=(handle, bend, aim), tolerances={"xatol": TOLERANCE})
    return _states(walk, handle, found.x)


def _states(walk: Walk, handle: IntArray, times: FloatArray) -> FloatArray:
    """Times, s, and route position, m, and speed, m/s, of one handle at each of them, (3, n)."""
    line, each = walk.dragon.first(max(int(handle.max()), 1)), np.arange(len(times))
    placed = Placement(line, walk.route, walk.head_position(times))
    placed.check()
    row, u, _x, _y = placed.tables
    s = np.empty(len(times))
    positions(walk.route.rows, row[handle, each], u[handle, each], s)
    return np.array([times, s, placed.speed_ratio[each, handle] * walk.profile.speed(times)])
