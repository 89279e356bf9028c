"""A contest workbook beside the exact values, and what it would hold if a mistake had been made."""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
import numpy.typing as npt

from benchdragon.kernels.curve import FloatArray
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan

ComplexArray = npt.NDArray[np.complex128]
BoolArray = npt.NDArray[np.bool_]
Mistake = Literal[
    "rotated", "mirrored", "swapped", "differences", "handle", "time", "entry", "size", "unit",
    "rounding", "cells", "unknown",
]  # fmt: skip

# Positions and speeds, as parts of the arrays.
SHEETS = (slice(0, 2), slice(2, 3))
# Decimals that the contest asks for, and the fewest that are recognised; half a unit of the last one,
# with some room, is what rounding does.
DECIMALS, FEWEST_DECIMALS, HALF = 6, 0, 0.501
# Cells agree within this many times what rounding does.
WITHIN = 1.2
# Numbers are rounded if so large a share of them is, but not if so many are the same one.
ROUNDED = 0.98
# Where the head was is sought among so many times of the walk, at so many of the workbook's, for these
# handles; of a workbook of one moment, for all.
GRID, SAMPLES, HANDLES_SEEN = 6000, 101, (0, 1, 2, 3, 25, 60, 100, 150, 200, 223)


@dataclass(frozen=True, eq=False)
class Case:
    """A workbook beside the exact values.

    Attributes:
        plan: what the workbook is about.
        walk: that of the plan.
        other: the walk of the contest's other part.
        span: start and end of `walk`, s.
        times: of the columns, s, (T,); other_times: those of the same columns of the other part's
            workbook.
        theirs, ours: x, y (m) and speed (m/s), (3, T, 224), NaN where there is nothing.
        moment: whether the workbook is of one moment, that of first contact.
        tolerance: of cells of each quantity, m and m/s, (3, 1, 1).
    """

    plan: Plan
    walk: Walk
    other: Walk
    span: tuple[float, float]
    times: FloatArray
    other_times: FloatArray
    theirs: FloatArray
    ours: FloatArray
    moment: bool
    tolerance: FloatArray

    @cached_property
    def decimals(self) -> tuple[int, int]:
        """To how many decimals positions, and speeds, are rounded: 0 to 6."""
        return _decimals(self.theirs[:2]), _decimals(self.theirs[2:])

    @cached_property
    def rounding(self) -> FloatArray:
        """What rounding does to each quantity at most, m and m/s, (3, 1, 1)."""
        places, speeds = self.decimals
        return HALF * 10.0 ** -np.array([places, places, speeds], dtype=float)[:, None, None]

    @cached_property
    def outside(self) -> BoolArray:
        """Which handles are not yet where the spiral of the first part begins, (T, 224)."""
        if self.plan.route.kind != "spiral-in":
            return np.zeros(self.ours.shape[1:], dtype=bool)
        return np.asarray(self.walk.motion(self.times, throw=False).s < -1e-6)

    @cached_property
    def behind(self) -> FloatArray:
        """What handles behind the dragon's last one would hold, were it longer, (3, T, 2)."""
        count = self.ours.shape[2]
        longer = self.plan.with_value("dragon.benches", count + 1).build()
        return values_of(longer, self.times)[:, :, count:]

    @cached_property
    def headings(self) -> FloatArray:
        """Which way each handle goes, rad, (T, 224)."""
        return self.headings_at(self.walk.motion(self.times, throw=False).s)

    @cached_property
    def clocks(self) -> FloatArray:
        """When the walk comes nearest to theirs, s, (2, T); NaN where that is not known.

        First the median of what handles tell, which one cell that is off does not move; then what
        the head tells, which near the centre knows it alone.
        """
        clock = np.linspace(*self.span, GRID)
        grid, theirs = self._forwards(clock), complex_of(self.theirs)
        seen = np.arange(theirs.shape[1]) if self.moment else np.array(HANDLES_SEEN)
        row, column = np.nonzero(np.isfinite(theirs[:, seen]))
        rows = np.unique(row)
        kept = np.isin(row, rows[:: 1 + rows.size // SAMPLES])
        row, handle = row[kept], seen[column[kept]]
        wanted = theirs[row, handle]
        times = np.array(
            [clock[np.nanargmin(np.abs(grid[:, h] - z))] for h, z in zip(handle, wanted, strict=True)]
        )
        for _step in range(4):  # Newton's, as if handles went straight on
            motion, own = self.walk.motion(times, throw=False), (np.arange(times.size), handle)
            velocities = motion.speed[own] * np.exp(1j * self.headings_at(motion.s[own]))
            moving = np.where(np.abs(velocities) > 0.0, velocities, np.inf)
            ahead = (wanted - motion.x[own] - 1j * motion.y[own]) / moving
            times = np.clip(times + np.nan_to_num(ahead.real), *self.span)
        found = np.full((2, theirs.shape[0]), np.nan)
        inside = (self.span[0] < times) & (times < self.span[1])
        for n in np.unique(row[inside]):
            found[0, n] = np.median(times[inside & (row == n)])
        first = inside & (handle == 0)
        found[1, row[first]] = times[first]
        return found

    def _forwards(self, clock: FloatArray) -> ComplexArray:
        """Where handles are as long as they go forwards: near the centre they stand where they were."""
        motion = self.walk.motion(clock, throw=False)
        back = motion.s < np.fmax.accumulate(motion.s, axis=0)
        return np.where(back, np.nan, motion.x + 1j * motion.y)

    def headings_at(self, s: FloatArray) -> FloatArray:
        """Which way the route goes at s, rad; NaN where there is no s."""
        return np.where(np.isnan(s), np.nan, self.walk.route.heading(np.nan_to_num(s)))


@dataclass(frozen=True, eq=False)
class Guess:
    """What a workbook would hold.

    Attributes:
        mistake: its name.
        values: x, y, speed as in Case; NaN where nothing is predicted.
        text: the mistake in words.
        amount: how large it is, in `unit`: an angle, a time, a length, a factor, a number.
        slack: error of the prediction itself, m and m/s.
        beside: what else it takes for granted, in words.
    """

    mistake: Mistake
    values: FloatArray
    text: str
    amount: float | None = None
    unit: str | None = None
    slack: float = 0.0
    beside: tuple[str, ...] = ()


def _decimals(values: FloatArray) -> int:
    """The least number of decimals that nearly all numbers but zeros have."""
    known = values[np.isfinite(values) & (values != 0.0)]
    for count in range(FEWEST_DECIMALS, DECIMALS):
        rounded = np.abs(known - np.round(known, count)) <= 1e-9
        if rounded.size and rounded.mean() >= ROUNDED:
            same = np.unique(known, return_counts=True)[1].max()
            return count if same <= ROUNDED * known.size else DECIMALS
    return DECIMALS


def complex_of(values: FloatArray) -> ComplexArray:
    """x and y as complex numbers."""
    return np.asarray(values[0] + 1j * values[1])


def with_points(points: ComplexArray, speed: FloatArray) -> FloatArray:
    """x, y and speed as in Case."""
    return np.stack([points.real, points.imag, speed])


def values_of(walk: Walk, times: FloatArray) -> FloatArray:
    """x, y (m) and speed (m/s) of all handles, (3, T, 224); NaN where the dragon cannot stand."""
    motion = walk.motion(times, throw=False)
    return np.stack([motion.x, motion.y, motion.speed])
