"""Who comes nearest to each bench over a walk, and who stands beside it."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from benchdragon.analysis.distance import boxes, low_point, nearest_each, nearness, pairs_within
from benchdragon.kernels import box as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray
from benchdragon.model.placement import Placement
from benchdragon.model.walk import Motion, Walk

Side = Literal["left", "right", "front", "rear"]

# How far other benches are looked for, m, at all times; and at the end for those beside.
REACH, BESIDE = 1.5, 1.5
# Benches farther apart than this, m, in a straight line are of another coil once they come within
# REACH: nearer than half of that, which takes a bend of more than half a turn. The others are next in
# line and near at all times, which tells a bearer nothing.
STRAIGHT = 2.0 * REACH
# Distances that differ by less than this, m, count as equal, and the sooner is told: in a steady coil
# they stay the same for long, and rounding must not choose the moment.
LEVEL = 1e-6
# How often the time about a least distance is narrowed.
SHRINKS = 6


@dataclass(frozen=True)
class Tightest:
    """When a bench of another coil comes nearest: one that is farther away than STRAIGHT in a line.

    Attributes:
        time: s.
        bench: number of the other.
        side: on which side of this bench it then is.
        lower: no such bench comes nearer than this at any time, m.
        upper: so near that one is then, m.
        place: where this bench's front handle then is, m.
    """

    time: float
    bench: int
    side: Side
    lower: float
    upper: float
    place: tuple[float, float]


class TightestSearch:
    """Looks through a walk, slice by slice, for the tightest moment of each bench.

    Between two times a point of a bench goes no farther than `Dragon.lever` times what the faster of
    its handles goes along the route. So benches that are a and b apart at these times, whose points go
    no farther than p and q in between, are never nearer than (a + b - p - q)/2.

    Args:
        walk: what is looked at.
        apart: what benches are known never to come nearer than, m.
    """

    def __init__(self, walk: Walk, apart: float) -> None:
        count = len(walk.dragon)
        self.walk, self.apart = walk, apart
        self._least, self._floor = np.full(count, math.inf), np.full(count, math.inf)
        self._partner = np.zeros(count, dtype=np.int64)
        self._about, self._when = np.zeros((count, 3)), np.zeros((count, 2))

    def look(self, motion: Motion) -> None:
        """Look at the times of a motion; the next begins with the last of them."""
        distance, partner = nearest_each(motion, REACH, STRAIGHT)
        known = np.minimum(distance, REACH)
        self._floor = np.minimum(self._floor, self._between(motion, known))
        least = distance.min(axis=0)
        nearer = np.flatnonzero(least < self._least - LEVEL)
        at = np.argmax(distance[:, nearer] <= least[nearer] + LEVEL, axis=0)
        self._least[nearer], self._partner[nearer] = least[nearer], partner[at, nearer]
        before, after = np.maximum(at - 1, 0), np.minimum(at + 1, len(motion.times) - 1)
        self._about[nearer] = motion.head_s[np.column_stack([before, at, after])]
        self._when[nearer] = motion.times[np.column_stack([before, after])]

    def _between(self, motion: Motion, known: FloatArray) -> FloatArray:
        """What nothing comes nearer to each bench than between these times, m, (N,)."""
        if len(known) < 2:
            return np.asarray(known.min(axis=0))
        goes = np.diff(motion.s, axis=0)
        moved = self.walk.dragon.lever * np.maximum(goes[:, :-1], goes[:, 1:])
        farthest = moved.max(axis=1, keepdims=True)
        return np.asarray((0.5 * (known[1:] + known[:-1] - moved - farthest)).min(axis=0))

    def found(self) -> list[Tightest | None]:
        """The tightest moment of each bench; None where nothing comes within REACH."""
        return [self._tightest(k) for k in range(len(self._least))]

    def _tightest(self, k: int) -> Tightest | None:
        if not self._partner[k]:
            return None
        other, (low, head, high) = int(self._partner[k]) - 1, self._about[k].tolist()
        i, j = sorted((k, other))
        least, where = (
            low_point(self.walk, i, j, low, high, SHRINKS) if low < high else (math.inf, head)
        )
        head = where if least < self._least[k] - LEVEL else head
        placed = self.walk.placement([head])
        table, place = boxes(placed, 0), (float(placed.x[0, k]), float(placed.y[0, k]))
        near = nearness(table, k, other)
        upper = max(near.distance, 0.0)
        lower = min(max(float(self._floor[k]), self.apart, 0.0), upper)
        first, last = self._when[k].tolist()
        # Where the head stops for good, rounding may put its place beyond all that it comes to.
        time = min(max(self.walk.time_at(head), first), last)
        side = side_of(table, k, near.points[other > k])
        return Tightest(time, other + 1, side, lower, upper, place)


def side_of(table: FloatArray, k: int, point: tuple[float, float]) -> Side:
    """On which side of the bench in row k of `boxes` a point lies that is outside of it."""
    along, across = kernel.offset(table, k, *point)
    ends = abs(along) - float(table[k, kernel.HALF_LENGTH])
    if ends > abs(across) - float(table[k, kernel.HALF_WIDTH]):
        return "front" if along > 0.0 else "rear"
    return "left" if across > 0.0 else "right"


def beside(placed: Placement) -> list[tuple[int | None, int | None]]:
    """The numbers of the benches next to each on its left and on its right, at the first position.

    Of each line of benches that passes, no neighbours and no more than BESIDE metres away, that is the
    one most abreast, and of these the one of the nearest line; None where there is none.
    """
    table = boxes(placed, 0)
    first, second = pairs_within(table, BESIDE)
    mine, other = np.concatenate([first, second]), np.concatenate([second, first])
    apart = table[other][:, [kernel.CX, kernel.CY]] - table[mine][:, [kernel.CX, kernel.CY]]
    ux, uy = table[mine, kernel.UX], table[mine, kernel.UY]
    along, across = apart[:, 0] * ux + apart[:, 1] * uy, apart[:, 1] * ux - apart[:, 0] * uy
    level = np.abs(along) <= table[mine, kernel.HALF_LENGTH] + 0.5 * table[other, kernel.HALF_LENGTH]
    near = np.abs(across) <= BESIDE + table[mine, kernel.HALF_WIDTH] + table[other, kernel.HALF_WIDTH]
    sides = [
        _nearest(mine[rows], other[rows], np.abs(along[rows]), np.abs(across[rows]), len(table))
        for rows in (level & near & (across > 0.0), level & near & (across < 0.0))
    ]
    return list(zip(*sides, strict=True))


def _nearest(
    mine: IntArray, other: IntArray, along: FloatArray, across: FloatArray, count: int
) -> list[int | None]:
    """The number of the other that is beside each bench, of those on one side of it."""
    rows = np.lexsort((other, mine))
    next_to = (np.diff(mine[rows]) == 0) & (np.diff(other[rows]) == 1)
    gains = np.diff(along[rows])
    abreast = np.ones(len(rows), dtype=np.bool_)
    abreast[1:] &= ~(next_to & (gains > 0.0))
    abreast[:-1] &= ~(next_to & (gains < 0.0))
    rows = rows[abreast]
    rows = rows[np.lexsort((across[rows], mine[rows]))]
    found: list[int | None] = [None] * count
    benches, at = np.unique(mine[rows], return_index=True)
    for bench, row in zip(benches.tolist(), rows[at].tolist(), strict=True):
        found[bench] = int(other[row]) + 1
    return found
