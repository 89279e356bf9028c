"""Where a walk only repeats itself, so that no search need look there again.

How benches stand to one another, and what follows, depends on the route under them alone. On a line
or an arc that is the same wherever they stand, and where parts of a route come again in the same order
it is what it was one round before. That holds exactly, and answers speak of exact places: rounding adds
nothing. Where a round leads back to where it began, what stands still is as near as before, too, but
for what the round misses that place by. design/rounds.py shows what that saves.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from benchdragon.analysis.nearby import seams_of
from benchdragon.kernels.curve import (
    ANGLE,
    ARC,
    CLOTHOID,
    KIND,
    LENGTH,
    LINE,
    S_START,
    U_BACK,
    FloatArray,
    P,
    Q,
    X,
    Y,
)
from benchdragon.kernels.rounding import GAP, KINK, TILT
from benchdragon.kernels.route import IntArray
from benchdragon.model.walk import Walk

# What is searched beyond a whole round, m: more than rounding moves where one ends.
SPARE = 1e-6
# What is left out is at least so many times as long as the benches: a search that begins anew costs.
WORTH = 2.0
# A round leads back to where it began if it misses that by less, m; distances count as off by twice it.
MOST_MISSED = 1e-4
# What one bench beside something that stands still may be off by of itself, m: roundings of its place,
# a thousandfold where it is all but folded.
PLACED = 1e-10
# Periods of a route that are looked for: so many different ways from a row to the next of its shape,
# and so many times each, as a circuit of so many equal sides takes.
MOST_GAPS, MOST_FOLD = 64, 24
TURN = 2.0 * math.pi

Span = tuple[float, float]


@dataclass(frozen=True)
class Repeat:
    """Part of a route, from position low to high, m, that is the same `period` metres farther on.

    Attributes:
        period: 0 where it is the same everywhere.
        missed: how far places one or more rounds apart may be from one another, m.
    """

    low: float
    high: float
    period: float
    missed: float = 0.0


def _shapes(rows: FloatArray) -> IntArray:
    """A number for the shape of each row, the same for the same; -1 for what is not looked at."""
    shapes = rows[:, [KIND, LENGTH, P, Q]]
    number = np.unique(shapes, axis=0, return_inverse=True)[1].reshape(-1)
    return np.where(np.isin(rows[:, KIND], (LINE, ARC, CLOTHOID)), number, -1)


def _wrapped(angles: FloatArray) -> FloatArray:
    """Angles, rad, within half a turn."""
    return np.remainder(angles + math.pi, TURN) - math.pi


def _swings(rows: FloatArray) -> FloatArray:
    """By how much the route turns where each row starts, rad: 0 at the first, infinite if unknown."""
    length = rows[:, LENGTH]
    ends = rows[:, ANGLE] + length * (rows[:, P] + 0.5 * rows[:, Q] * length)
    swings = np.append(0.0, _wrapped(rows[1:, ANGLE] - ends[:-1]))
    known = np.isin(rows[:, KIND], (LINE, ARC, CLOTHOID))
    swings[1:][~(known[1:] & known[:-1])] = math.inf
    return swings


def _periods(shapes: IntArray) -> list[int]:
    """After how many rows a route of these shapes may come again, the fewest first."""
    order = np.argsort(shapes, kind="stable")
    again = (np.diff(shapes[order]) == 0) & (shapes[order][1:] >= 0)
    gaps = np.unique(np.diff(order)[again])[:MOST_GAPS]
    times = np.unique(np.outer(gaps, np.arange(1, MOST_FOLD + 1)))
    return [int(one) for one in times if one <= len(shapes) // 2]


def _runs(rows: FloatArray, used: npt.NDArray[np.bool_]) -> Iterator[tuple[int, int, int]]:
    """Rows from which to which a number of them, the third, comes again and again, the fewest first.

    Rows that are `used` alone are not told again. A kink is not the same as any other: rounding may
    have made it.
    """
    shapes, smooth = _shapes(rows), np.abs(_swings(rows)) <= KINK
    for period in _periods(shapes):
        same = (shapes[period:] == shapes[:-period]) & (shapes[period:] >= 0)
        if not (same & ~used[period:]).any():
            continue
        joined = same & smooth[period:] & smooth[:-period]
        joined[1:] &= same[:-1]
        joined[0] = False
        firsts = np.flatnonzero(same & ~joined).tolist()
        lasts = np.flatnonzero(same & ~np.append(joined[1:], False)).tolist()
        for first, last in zip(firsts, lasts, strict=True):
            yield first, last + period, period


def repeats(rows: FloatArray) -> list[Repeat]:
    """Where a route of these rows has one shape again and again, wherever that leads."""
    starts, ends = rows[:, S_START].copy(), rows[:, S_START] + rows[:, LENGTH]
    starts[0] = -math.inf if math.isinf(rows[0, U_BACK]) else starts[0]
    bent = np.flatnonzero(np.isin(rows[:, KIND], (LINE, ARC))).tolist()
    found = [Repeat(float(starts[j]), float(ends[j]), 0.0) for j in bent]
    used = np.zeros(len(rows), dtype=np.bool_)
    for first, last, period in _runs(rows, used):
        used[first + period : last + 1] = True
        way = float(rows[first + period, S_START] - rows[first, S_START])
        found.append(Repeat(float(rows[first, S_START]), float(ends[last]), way))
    return found


def returns(rows: FloatArray, reach: float) -> list[Repeat]:
    """Where a route of these rows leads back to where it was, for what reaches so far from it, m."""
    starts, length, ends = rows[:, S_START], rows[:, LENGTH], rows[:, S_START] + rows[:, LENGTH]
    arcs = np.flatnonzero((rows[:, KIND] == ARC) & (rows[:, P] != 0.0)).tolist()
    found = [Repeat(float(starts[j]), float(ends[j]), TURN / abs(float(rows[j, P]))) for j in arcs]
    used, seams = np.zeros(len(rows), dtype=np.bool_), seams_of(rows)
    joints = seams[:, GAP] + seams[:, TILT] * (ends + reach)
    for first, last, period in _runs(rows, used):
        copies = np.arange(first + period, last + 1)
        firsts = first + (copies - first) % period
        turned = np.abs(_wrapped(rows[copies, ANGLE] - rows[firsts, ANGLE]))
        missed = np.abs(rows[copies][:, [X, Y]] - rows[firsts][:, [X, Y]]).sum(axis=1)
        missed += turned * (length[copies] + reach) + joints[copies] + joints[firsts]
        near = int(np.append(missed > MOST_MISSED, True).argmax())
        if near:
            used[copies[:near]] = True
            way, most = float(starts[first + period] - starts[first]), float(missed[:near].max())
            found.append(Repeat(float(starts[first]), float(ends[copies[near - 1]]), way, most))
    return found


class Rounds:
    """What of the ways of a dragon is new, on a route of which parts repeat as is `known`."""

    def __init__(self, walk: Walk, known: Sequence[Repeat]) -> None:
        self._length = float(walk.dragon.links.sum())
        self._worth = WORTH * self._length
        long = [one for one in known if one.high - one.low - one.period > self._worth]
        self._begun: list[tuple[float, Repeat]] = []
        for one in sorted(long, key=lambda one: one.low - one.high + one.period):
            if not any(self._covers(*whole, one) for whole in self._begun):
                low = one.low  # from where on the head stands where all benches do
                head = low if math.isinf(low) else walk.head_where_tail(low + SPARE)
                self._begun.append((head, one))

    def _covers(self, head: float, longer: Repeat, one: Repeat) -> bool:
        """Whether what is left out for a repeat surely holds what would be for another."""
        soonest = one.low + self._length + one.period
        return head + longer.period <= soonest and one.high <= longer.high

    def new(self, first: float, last: float) -> tuple[list[Span], float]:
        """The spans of the head's way from first to last, m, that repeat nothing before them there.

        And what places may be off by from those some rounds before, m.
        """
        skips, missed = [], 0.0
        for head, one in self._begun:
            start, end = max(head, first) + one.period + SPARE, min(one.high, last)
            if end - start > self._worth:
                skips.append((start, end))
                missed += one.missed
        spans, at = list[Span](), first
        for start, end in sorted(skips):
            if start > at:
                spans.append((at, start))
            at = max(at, end if end >= last else end - SPARE)
        if at < last or not spans:
            spans.append((at, last))
        return spans, missed
