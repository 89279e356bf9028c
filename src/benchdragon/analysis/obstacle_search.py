"""The search of a walk for benches that come near an obstacle.

Where a bench stands is told by the route position of its own front handle, whatever the others do. So
each size of bench is searched once, along the stretches of route that its benches walk: a bench that
follows another of its size comes to nothing new beyond where that one stood at the start
(kernels/standing.py). What is found there is then told of the head, and in time.
"""

import math
import time as clock
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from benchdragon import budget
from benchdragon.analysis.contact_search import (
    MOST_EVALUATIONS,
    MOST_LEAST_EVALUATIONS,
    SLACK,
    WIDTH,
    assumed_within,
)
from benchdragon.analysis.distance import CORNERS, boxes, nearness
from benchdragon.analysis.head_times import HeadTimes
from benchdragon.analysis.nearby import NOWHERE, checked_off, errors_at, origin_of, seams_of, seen_from
from benchdragon.analysis.obstacle_distance import box_distances, nearest_boxes
from benchdragon.analysis.rounds import PLACED, Rounds, returns
from benchdragon.analysis.tables import kinds_of
from benchdragon.errors import UnsureError, in_order, of_kind
from benchdragon.i18n import _
from benchdragon.kernels import search as steps
from benchdragon.kernels import standing as kernel
from benchdragon.kernels.box import CX, CY, corner
from benchdragon.kernels.curve import KIND, SPIRAL, U_END, U_START, FloatArray, P
from benchdragon.kernels.doubts import UNIT
from benchdragon.kernels.drift import head_drift
from benchdragon.kernels.links import link_of
from benchdragon.kernels.rounding import HALF_UNIT, still_error
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.search import FALLEN, FOUND
from benchdragon.kernels.walk_search import ASTRAY
from benchdragon.model.answer import Answer, Status, Witness
from benchdragon.model.base_curve import Point
from benchdragon.model.dragon import Dragon
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.placement import Placement
from benchdragon.model.walk import Walk

# Spans of route that are searched in one call: some hundredths of a second.
SPANS = 2_000
# What a bench beside a box of an obstacle costs, in handles placed.
BENCH = 16
# Head positions at which it is looked why benches could not be followed.
SAMPLES = 65
# Grazes of one bench that are passed over to see whether it touches; along a wall one each STRETCH.
MOST_GRAZES = 1_000
# Brackets of touches that are wider than this, s, began with a graze.
NARROW = 1e-6
# Roundings of a route position, of the lengths that it is counted by.
COUNTED = 24.0
# Newton steps for the head position at which a handle comes to a place; about five are needed.
MOST_STEPS = 100


@dataclass(frozen=True)
class Touch:
    """Where a bench (row, from 0) comes to an obstacle: its front handle between lower and upper, m."""

    bench: int
    lower: float
    upper: float
    sure: bool


@dataclass
class ObstacleSearch:
    """A search of a walk from one time to another for what comes near one obstacle.

    The dragon must be able to stand at both.

    Attributes:
        walk: as given, but with coordinates counted from `origin`.
        obstacle: likewise.
        origin: near the dance, m.
        slack: what computed distances count as off by at least, m.
        off: what those that mattered so far may be off by, m.
    """

    walk: Walk
    obstacle: Obstacle
    start: float
    end: float
    origin: Point = field(init=False)
    slack: float = field(default_factory=lambda: SLACK)
    off: float = 0.0
    evaluations: int = 0
    began: float = field(default_factory=clock.perf_counter)

    def __post_init__(self) -> None:
        of_kind("walk", self.walk, Walk)
        of_kind("obstacle", self.obstacle, Obstacle)
        in_order(self.start, self.end)
        self.heads = self.walk.head_position([self.start, self.end])
        self.placed = self.walk.placement(self.heads)  # raises where the dragon cannot stand
        self.origin = origin_of(self.placed.x[0], self.placed.y[0])
        if self.origin != NOWHERE:
            self.walk = seen_from(self.walk, self.origin)
            outline = self.obstacle.outline - np.array(self.origin)
            self.obstacle = replace(self.obstacle, outline=outline)
            self.placed = self.walk.placement(self.heads)
        self.kind, self.kinds = kinds_of(self.walk.dragon.sizes)
        self._seams = seams_of(self.walk.route.rows)
        self._stretches = self._new_stretches()
        self._standing = kernel.scratch_for(self.obstacle.boxes)
        count = len(self.obstacle.boxes) + 1
        self._search = steps.room(2, count, count)
        self._times = HeadTimes(self.walk, float(self.heads[0]), self.start, self.end)

    @property
    def reach(self) -> float:
        """Distance from the obstacle's boxes at which a bench is as near as it may be, m."""
        return self.obstacle.margin + self.obstacle.radius

    @cached_property
    def at_start(self) -> tuple[float, int, int]:
        """The least distance of a bench from a box at the start, m: which bench and box, from 0.

        Minus infinity where a bench stands where none may.
        """
        out, which = box_distances(self.placed, 0, self.obstacle)
        bench = int(np.argmin(out))
        return float(out[bench]), bench, int(which[bench])

    @cached_property
    def off_at_start(self) -> float:
        """What the least of these distances may be off by, m."""
        _errors, off = errors_at(self.walk, float(self.heads[0]), 0)
        boxes_here = self.obstacle.boxes
        still = max(still_error(boxes_here, n) for n in range(len(boxes_here)))
        return max(self.slack, float(off.max()) + still)

    def stretches(self) -> Iterator[tuple[int, IntArray, FloatArray]]:
        """For each size of bench: its number, its benches, and the span of route of each, m, (n, 2).

        A bench is followed to where the one of its size before it stood at the start, and no farther;
        and where its way comes to where it was, no more (see `rounds`): it then has several spans.
        """
        return iter(self._stretches)

    def _new_stretches(self) -> list[tuple[int, IntArray, FloatArray]]:
        """What `stretches` gives; where rounds are left out, distances are off by what those miss."""
        s, route, found = self.placed.s[:, :-1], self.walk.route, []
        known = returns(route.rows, float(np.hypot(*self.kinds.sizes[:2]).max()))
        for k, sizes in enumerate(self.kinds.sizes.T):
            rounds = Rounds(replace(self.walk, dragon=Dragon.of_sizes(*sizes)), known)
            benches = np.flatnonzero(self.kind == k)
            ends = np.minimum(s[1, benches], np.append(math.inf, s[0, benches[:-1]]))
            spans = list[tuple[int, float, float]]()
            for bench, end in zip(benches.tolist(), ends.tolist(), strict=True):
                if end > (start := float(s[0, bench])):
                    new, missed = rounds.new(start, end)
                    spans += [(bench, *span) for span in new]
                    self.slack = max(self.slack, 2.0 * missed + PLACED if missed else 0.0)
            table = np.array(spans).reshape(-1, 3)
            found.append((k, table[:, 0].astype(np.int64), np.ascontiguousarray(table[:, 1:])))
        self.off = max(self.off, self.slack if self.slack > SLACK else 0.0)
        return found

    def run(
        self, k: int, goal: int, spans: FloatArray, tolerance: float, note: FloatArray
    ) -> FloatArray:
        """Search spans for benches of size k; what is told of each span that was searched.

        Raises:
            WalkError: where the bench cannot walk on.
            UnsureError: where it could not be shown that it can.
        """
        bench, told = self._bench(k), []
        most = MOST_LEAST_EVALUATIONS if goal == steps.LEAST else MOST_EVALUATIONS
        limits = self.reach, tolerance or self.slack, WIDTH, most
        for first in range(0, len(spans), SPANS):
            some = spans[first : first + SPANS]
            found = np.empty((len(some), kernel.SPAN_COLUMNS))
            before = note[steps.EVALUATIONS]
            ending = kernel.search_spans(
                bench, self._standing, self._search, goal, some, *limits, note, found
            )
            self.note_off(float(note[steps.OFF]))
            made = int(note[steps.EVALUATIONS] - before)
            self.evaluations += made
            budget.spend(BENCH * (made + len(some)) * len(self.obstacle.boxes))
            told.append(found)
            if ending in (ASTRAY, FALLEN):
                raise self._stopped(note)
            if goal == steps.LEAST and ending == FOUND:
                break
        return np.concatenate(told) if told else np.empty((0, kernel.SPAN_COLUMNS))

    def note_off(self, off: float) -> None:
        """Take note of what a distance that matters may be off by, m.

        Raises:
            UnsureError: if that is too much for a search to see all that is near.
        """
        self.off = max(self.off, off if off <= self.slack else checked_off(off))

    def look(self, k: int, spans: FloatArray, note: FloatArray) -> None:
        """Lower the least distance that is known by what is seen at the ends of spans."""
        kernel.look_along(self._bench(k), self._standing, self._search, spans, note)

    def _bench(self, k: int) -> kernel.Bench:
        sizes = np.ascontiguousarray(self.kinds.sizes[:, k : k + 1])
        link, rows = np.array([link_of(sizes, 0)]), self.walk.route.rows
        return kernel.Bench(rows, link, sizes, self._seams)

    def _stopped(self, note: FloatArray) -> Exception:
        """Why a bench could not be followed past the end of what its search had shown."""
        first, last = self.heads.tolist()
        error = self.walk.first_failure(np.linspace(first, last, SAMPLES))
        text = _("past s = {s} m it could not be shown that every bench follows without a leap")
        return error or UnsureError(text.format(s=f"{note[steps.LOWER]:.6g}"))

    def head_at(self, bench: int, lower: float, upper: float) -> tuple[float, float]:
        """Head positions, m, between which a bench's front handle surely goes from lower to upper."""
        if bench == 0:
            return max(lower, float(self.heads[0])), min(upper, float(self.heads[1]))
        line, ends = self.walk.dragon.first(bench), self.heads.tolist()
        for _pass in range(2):  # by what errors are at the ends, then by what they are there
            off = [self._handle_off(line, head) for head in ends]
            before, _at = self._bracket(line, lower - off[0])
            _at, after = self._bracket(line, upper + off[1])
            ends = [before, after]
        return before, after

    def _handle_off(self, line: Dragon, head: float) -> float:
        """What the last handle of some benches may be off by along the route, m, as positions tell it.

        The head's own place, the way of errors through the chain, and the lengths that positions are
        counted by.
        """
        rows = self.walk.route.rows
        errors, _off = errors_at(replace(self.walk, dragon=line), head)
        drift, doubt = head_drift(rows, head)
        spirals = rows[rows[:, KIND] == SPIRAL]
        outmost = np.hypot(1.0, np.abs(spirals[:, [U_START, U_END]]).max(axis=1, initial=0.0))
        counted = abs(head) + float((spirals[:, P] * outmost * outmost).sum())
        return self.slack + float(errors[-1]) + abs(drift) + doubt + COUNTED * HALF_UNIT * counted

    def _bracket(self, line: Dragon, s: float) -> tuple[float, float]:
        """Head positions, m, between which the last handle of the first benches comes to s."""
        low, high = (float(head) for head in self.heads)
        guess, fine = 0.5 * (low + high), 4.0 * UNIT * max(abs(low), abs(high), 1.0)
        for step in range(MOST_STEPS):
            if high - low <= 2.0 * fine:
                break
            if not low < guess < high:
                guess = 0.5 * (low + high)
            placed = Placement(line, self.walk.route, guess)
            ahead, ratio = float(placed.s[0, -1]) - s, float(placed.speed_ratio[0, -1])
            if ahead >= 0.0:
                high = guess
            else:
                low = guess
            side = (-fine if ahead >= 0.0 else fine) if step % 4 < 3 else 0.0
            guess = guess - ahead / ratio + side if step % 8 < 7 else 0.5 * (low + high)
        return low, high

    def answer(self, lower: float, upper: float, status: Status, bench: int) -> Answer:
        """A time between those at which the head is at lower and at upper; how a bench then stands."""
        value, early, late, status = self._times.told(lower, upper, status)
        if status == "found" and late - early > NARROW:
            value = late  # a graze came before: then it surely touches
        seconds = clock.perf_counter() - self.began
        witness = self.witness(upper, bench)
        return Answer(
            value, early, late, "s", status, witness, assumed_within(max(self.off, self.slack)),
            self.evaluations, seconds,
        )  # fmt: skip

    def witness(self, s: float, bench: int) -> Witness:
        """How a bench (row, from 0) stands to the obstacle with the head at s.

        Where it stands wholly inside of one the gap is minus the distance. Of a bench outside of the
        venue the point is the corner that is farthest out, and the gap minus how far.
        """
        placed = self.walk.placement(s, throw=False)
        table = np.vstack([boxes(placed, 0)[bench], self.obstacle.boxes])
        _distance, which = nearest_boxes(table[:1], self.obstacle)
        near = nearness(table, 0, 1 + int(which[0]))
        gap = (near.gap if near.distance <= 0.0 else near.distance) - self.obstacle.radius
        if gap > 0.0 and self.obstacle.forbids(table[:1, [CX, CY]])[0]:
            gap = -gap
        point, feature = near.points[0], dict(near.features)[1]
        out_there = self._farthest_out(table) if self.obstacle.kind == "venue" else None
        if out_there is not None:
            point, gap, feature = out_there
        time, name = self._times.at(s), self.obstacle.name
        point = point[0] + self.origin[0], point[1] + self.origin[1]
        return Witness(time, s, (bench + 1,), point, gap, ((bench + 1, feature),), None, name)

    def _farthest_out(self, table: FloatArray) -> tuple[Point, float, str] | None:
        """The corner of the box in row 0 that is farthest beyond the venue's edge, the other rows.

        Where it is, minus how far out, m, and which it is; None where none is out.
        """
        corners = [corner(table, 0, k) for k in range(len(CORNERS))]
        beyond = self.obstacle.forbids(np.array(corners))
        found = [
            (-min(kernel.centre_distance(table, n, *corners[k]) for n in range(1, len(table))), k)
            for k in np.flatnonzero(beyond).tolist()
        ]
        if not found:
            return None
        gap, k = min(found)
        return corners[k], gap, CORNERS[k]

    def touches(self) -> list[Touch]:
        """Where benches first come nearer than they may, each in its own span; soonest ones first.

        And where they graze before, within rounding. A graze that runs into a touch is its beginning.
        """
        found: list[tuple[float, Touch]] = []
        for k, benches, spans in self.stretches():
            for n, lower, upper, sure in self._touched(k, spans):
                touch = Touch(int(benches[n]), lower, upper, sure)
                found.append((lower - float(self.placed.s[0, benches[n]]), touch))
        return [touch for _ahead, touch in sorted(found, key=lambda each: each[0])]

    def _touched(self, k: int, spans: FloatArray) -> list[tuple[int, float, float, bool]]:
        """Which spans are touched in, between which positions, m, and whether surely; grazes too."""
        found: dict[int, list[tuple[float, float, bool]]] = {}
        left, rows = spans.copy(), np.arange(len(spans))
        for _graze in range(MOST_GRAZES):
            told = self.run(k, steps.FIRST_TOUCH, left[rows], 0.0, np.zeros(steps.NOTES))
            for n, (ending, lower, upper) in zip(rows.tolist(), told.tolist(), strict=True):
                if ending != steps.CLEAR:
                    before = found.setdefault(n, [])
                    joined = bool(before) and lower <= before[-1][1]
                    first = before.pop()[0] if joined else lower
                    before.append((first, upper, ending == FOUND))
            grazed = told[:, kernel.ENDING] == steps.GRAZE
            rows = rows[grazed]
            left[rows, 0] = told[grazed, kernel.SPAN_UPPER]
            rows = rows[left[rows, 0] < left[rows, 1]]
            if not rows.size:
                return [(n, *touch) for n, touches in found.items() for touch in touches]
        raise UnsureError(
            _("benches come within rounding of {name} too often to be followed on").format(
                name=self.obstacle.name
            )
        )

    def bench_at(self, k: int, s: float) -> int:
        """The first bench of size k that walks over s with its front handle."""
        for kind, benches, spans in self.stretches():
            if kind == k:
                over = np.flatnonzero((spans[:, 0] <= s) & (s <= spans[:, 1]))
                return int(benches[over[0]])
        raise IndexError(k)
