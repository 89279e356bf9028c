"""What each bench does in a dance: where it starts, how it turns and how fast, what comes nearest."""

import heapq
import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np

from benchdragon import budget
from benchdragon.analysis.bench_nearness import Side, Tightest, TightestSearch, beside
from benchdragon.analysis.bends import Bends, Turning
from benchdragon.analysis.crossings import Crossings, crossings
from benchdragon.analysis.distance import boxes
from benchdragon.errors import InputError, brief, in_order, of_kind
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.walk import SLICE_PLACES, Motion, Walk
from benchdragon.plans.schema import Plan

Pace = Literal["wait", "walk", "hurry", "run"]
PACES: tuple[Pace, ...] = ("wait", "walk", "hurry", "run")

# A handle slower than this, m/s, waits.
STILL = 0.05
# Stretches shorter than this, s, nobody can follow: each is joined to the longer of its neighbours.
SHORTEST = 1.0
# Times at which all benches are looked at, s apart; farther where benches times times exceed the most
# that are kept (8 bytes each).
STEP = 0.125
MOST_KEPT = 20_000_000

__all__ = ["BenchWalk", "Pace", "Side", "Stretch", "Tightest", "Turning", "bench_walks"]


@dataclass(frozen=True)
class Stretch:
    """A time in which a bench keeps turning one way at one pace.

    Attributes:
        start: s.
        end: s.
        turning: to which side its front handle's route bends.
        pace: of its front handle.
        way: how far that handle goes, m.
        angle: by how much the route turns under that handle, rad, left positive.
        speeds: the least and the greatest of that handle seen, m/s.
    """

    start: float
    end: float
    turning: Turning
    pace: Pace
    way: float
    angle: float
    speeds: tuple[float, float]


@dataclass(frozen=True)
class BenchWalk:
    """What one bench does.

    Attributes:
        bench: its number, from 1, the head's.
        place: where its front handle is when the dance starts, m.
        heading: of the bench then, rad.
        box: its rectangle then, a row of kernels/box.py.
        stretches: one after another, from the start of the dance to its end.
        tightest: None where no bench of another coil comes within the distance looked for.
        before: number of the bench before it; None for the head.
        behind: number of the bench behind it; None for the tail.
        left: number of the bench on its left at the end; None where none is near.
        right: the same on its right.
    """

    bench: int
    place: tuple[float, float]
    heading: float
    box: tuple[float, ...]
    stretches: tuple[Stretch, ...]
    tightest: Tightest | None
    before: int | None
    behind: int | None
    left: int | None = None
    right: int | None = None


@budget.question()
def bench_walks(
    plan: Plan, walk: Walk, span: tuple[float, float], *, apart: float = 0.0
) -> tuple[BenchWalk, ...]:
    """What each bench of a plan's walk does over a span, s, the head's first.

    Turnings change where the front handle passes a place at which the route changes its side, paces
    where its speed passes STILL, `people.hurry_from` and `people.run_from` between times STEP apart:
    both to `crossings.TOLERANCE` seconds. Stretches shorter than SHORTEST are joined to a neighbour.
    `apart`, m, is what no two benches that are not neighbours come nearer than, if that is known: see
    `Tightest` for what is established without.

    Raises:
        InputError: for what is no plan or no walk, or an end before the start.
        WalkError: if the dragon cannot stand at some time.
    """
    of_kind("plan", plan, Plan)
    of_kind("walk", walk, Walk)
    start, end = _span(span)
    bends, times = Bends.of(walk.route), _times(walk, start, end)
    gates = _gates(plan)
    count = len(walk.dragon)
    speeds, passed = np.empty((count, len(times))), list[Crossings]()
    near = TightestSearch(walk, apart)
    for first, motion in _slices(walk, times):
        speeds[:, first : first + len(motion.times)] = motion.speed[:, :-1].T
        passed.append(crossings(walk, motion, bends.at, gates))
        near.look(motion)
    ends = [walk.motion([time]) for time in (start, end)]
    whole = _Whole(bends, gates, times, speeds, (ends[0].s[0], ends[1].s[0]))
    tightest, sides = near.found(), beside(ends[1])
    first_boxes = boxes(ends[0], 0).tolist()
    bounds = Crossings.joined(passed).by_bench(count)
    return tuple(
        BenchWalk(
            k + 1, (float(ends[0].x[0, k]), float(ends[0].y[0, k])), float(ends[0].heading[0, k]),
            tuple(first_boxes[k]), whole.stretches(k, bounds[k]), tightest[k], k or None,
            k + 2 if k + 1 < count else None, *sides[k],
        )
        for k in range(count)
    )  # fmt: skip


def _span(span: tuple[float, float]) -> tuple[float, float]:
    """Start and end, s, if they are two times in order."""
    try:
        start, end = span
    except (TypeError, ValueError):
        text = _("span must be a pair of times, not {value}")
        raise InputError(text.format(value=brief(span))) from None
    in_order(start, end)
    return start, end


def _gates(plan: Plan) -> FloatArray:
    """Speeds from which the next pace begins, m/s, (3,), ascending."""
    run = max(plan.people.run_from, STILL)
    return np.array([STILL, min(max(plan.people.hurry_from, STILL), run), run])


def _times(walk: Walk, start: float, end: float) -> FloatArray:
    """Times from start to end, s, STEP apart or more, and those at which the head's speed bends."""
    most = max(MOST_KEPT // len(walk.dragon), 2)
    count = min(math.ceil((end - start) / STEP), most)
    knots = [time for time in walk.profile.times if start < time < end][:most]
    return np.union1d(np.linspace(start, end, count + 1 if end > start else 1), knots)


def _slices(walk: Walk, times: FloatArray) -> Iterator[tuple[int, Motion]]:
    """The motion in slices that need bounded memory, each from the last time of the one before it."""
    per = max(SLICE_PLACES // (len(walk.dragon) + 1), 2)
    for first in range(0, max(len(times) - 1, 1), per):
        yield first, walk.motion(times[first : first + per + 1])


# A stretch before it is told: when it starts, s, route position and speed there, turning and pace.
Piece = tuple[float, float, float, int, int]


@dataclass(frozen=True)
class _Whole:
    """A dance of which stretches are told: times looked at, (T,), and speeds of benches, (N, T)."""

    bends: Bends
    gates: FloatArray
    times: FloatArray
    speeds: FloatArray
    ends: tuple[FloatArray, FloatArray]  # route positions of handles at the start and at the end

    def stretches(self, k: int, bounds: Crossings) -> tuple[Stretch, ...]:
        """The stretches of bench k (a row, from 0), whose bounds these are."""
        speed, s = self.speeds[k], (float(self.ends[0][k]), float(self.ends[1][k]))
        turning = int(np.searchsorted(self.bends.at, s[0], side="right"))
        pace = int(np.searchsorted(self.gates, speed[0], side="right"))
        pieces: list[Piece] = [(float(self.times[0]), s[0], float(speed[0]), turning, pace)]
        for time, way, fast, bend, new in bounds.rows():
            turning, pace = (new, pace) if bend else (turning, new)
            pieces.append((time, way, fast, turning, pace))
        end = float(self.times[-1])
        pieces = _followed(self._one_each(pieces), end)
        last = (end, s[1], float(speed[-1]), 0, 0)
        angles = self.bends.angle(np.array([piece[1] for piece in (*pieces, last)]))
        return tuple(
            self._stretch(k, one, after, float(angles[n + 1] - angles[n]))
            for n, (one, after) in enumerate(zip(pieces, [*pieces[1:], last], strict=True))
        )

    def _one_each(self, pieces: list[Piece]) -> list[Piece]:
        """The same, each turning under the number of the first that is alike."""
        sides = self.bends.turnings
        return [(*piece[:3], sides.index(sides[piece[3]]), piece[4]) for piece in pieces]

    def _stretch(self, k: int, one: Piece, after: Piece, angle: float) -> Stretch:
        low = int(np.searchsorted(self.times, one[0], side="left"))
        high = int(np.searchsorted(self.times, after[0], side="right"))
        seen = [*self.speeds[k, low:high].tolist(), one[2], after[2]]
        return Stretch(
            one[0], after[0], self.bends.turnings[one[3]], PACES[one[4]], after[1] - one[1], angle,
            (min(seen), max(seen)),
        )  # fmt: skip


def _followed(pieces: list[Piece], end: float) -> list[Piece]:
    """Stretches that people can follow: none shorter than SHORTEST, if there are several.

    The shortest, of several the first, goes to the longer of its neighbours, again and again.
    """
    line = _Line(_unlike(pieces), end)
    while (n := line.shortest()) is not None:
        low, high = line.before[n], line.after[n]
        if low < 0 or (high < len(line.lasts) and line.lasts[high] > line.lasts[low]):
            line.join(n, high, line.pieces[high])
        else:
            line.join(low, n, line.pieces[low])
    return line.left


class _Line:
    """Stretches one after another; neighbours are joined, and the first of them keeps its place."""

    def __init__(self, pieces: list[Piece], end: float) -> None:
        self.pieces, self.count = pieces[:], len(pieces)
        starts = [*(piece[0] for piece in pieces), end]
        self.starts, self.lasts = starts, [b - a for a, b in pairwise(starts)]
        self.before = list(range(-1, len(pieces)))
        self.after = list(range(1, len(pieces) + 1))
        self.there = [True] * len(pieces)
        self.queue = [(last, n) for n, last in enumerate(self.lasts)]
        heapq.heapify(self.queue)

    @property
    def left(self) -> list[Piece]:
        """The stretches that are there still."""
        return [piece for piece, there in zip(self.pieces, self.there, strict=True) if there]

    def shortest(self) -> int | None:
        """The shortest stretch, if it is too short and not the only one."""
        while self.count > 1 and self.queue[0][0] < SHORTEST:
            last, n = heapq.heappop(self.queue)
            if self.there[n] and last == self.lasts[n]:
                return n
        return None

    def join(self, low: int, high: int, like: Piece) -> None:
        """Join two neighbours to a stretch like one of them, and it to neighbours that are alike."""
        self.pieces[low] = (*self.pieces[low][:3], *like[3:])
        self.there[high], self.count = False, self.count - 1
        self.after[low] = after = self.after[high]
        self.before[after] = low
        self.lasts[low] = self.starts[after] - self.starts[low]
        heapq.heappush(self.queue, (self.lasts[low], low))
        for one, other in ((self.before[low], low), (low, after)):
            if one >= 0 and other < len(self.lasts) and self.pieces[one][3:] == self.pieces[other][3:]:
                self.join(one, other, self.pieces[one])


def _unlike(pieces: list[Piece]) -> list[Piece]:
    """The same, those that are alike joined."""
    return [piece for n, piece in enumerate(pieces) if n == 0 or piece[3:] != pieces[n - 1][3:]]
