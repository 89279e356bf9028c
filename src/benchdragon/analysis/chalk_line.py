"""The line that a dragon covers, and where it crosses spokes about the places that it turns about."""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np

from benchdragon.errors import in_order, of_kind
from benchdragon.kernels.arrays import Table
from benchdragon.kernels.curve import CurveKind, RouteRow, parameter_at
from benchdragon.kernels.route import evaluate, positions
from benchdragon.model.base_curve import Point
from benchdragon.model.curves import Route
from benchdragon.model.walk import Walk

# A usual tape, m: a route that turns about the peg within it has spokes there though it is no spiral.
TAPE = 30.0
# Ticks nearer than this along the route, or on the ground, m, are one; centres nearer than that too.
SAME = 0.02
# Between samples of a route that is no spiral, m; halvings of a bracket, to below a nanometre.
STEP, HALVINGS = 0.05, 30
# A piece is seen to its end so far before it, m, where the next one begins.
BEFORE = 1e-7


@dataclass(frozen=True)
class Trail:
    """What the dragon covers of its route.

    Attributes:
        route: the whole of it.
        low: where the tail's last handle stands at first, m along the route.
        start: where the head's first handle stands then, m along the route.
        high: where that comes to, m along the route.

    Examples:
        >>> walk = bd.read_plan("spiral-in", {"dragon.benches": 5}).build()
        >>> trail = bd.Trail.of(walk, 0.0, 10.0)
        >>> trail.start, trail.high
        (0.0, 10.0)
    """

    route: Route
    low: float
    start: float
    high: float

    @classmethod
    def of(cls, walk: Walk, start: float, end: float) -> Self:
        """The trail of a walk from one time to another, s.

        Raises:
            InputError: if `walk` is not a Walk, or the end comes before the start.
            WalkError: if the dragon cannot stand at the start.
        """
        of_kind("walk", walk, Walk)
        in_order(start, end)
        head, last = walk.head_position([start, end]).tolist()
        tail = walk.motion([start]).s[0, -1]
        return cls(walk.route, float(tail), head, min(last, walk.route.length))


class Piece(NamedTuple):
    """What the dragon covers of a row of its route: from low to high, m; its star, -1 for none."""

    row: int
    low: float
    high: float
    star: int


class Crossing(NamedTuple):
    """A place along the route, m, on a spoke of its star, from 1, or on none, 0; and what it is for."""

    s: float
    tape: int
    kind: str


class Line:
    """A trail as its pieces, with the stakes about which it turns."""

    def __init__(self, trail: Trail, peg: Point) -> None:
        self._rows: Table = trail.route.rows
        self._table = trail.route.rows.tolist()
        self._trail = trail
        self.stakes: list[Point] = []
        self._reach: list[float] = []
        own = [self._own(j) for j in range(len(self._table))]
        pieces = [self._piece(j, star) for j, star in enumerate(own)]
        self.pieces = [one for one in pieces if one.low < one.high]
        if not self.stakes and self._turns_about(peg):
            self.stakes.append(peg)
            self._reach.append(TAPE)
        self.pieces = [one._replace(star=self._star(one)) for one in self.pieces]

    def seen(self, places: Sequence[float]) -> list[list[float]]:
        """x and y, m, heading, rad, and curvature, 1/m, at route positions, m."""
        out = np.empty((len(places), 4))
        evaluate(self._rows, np.array(places), out)
        found: list[list[float]] = out.tolist()
        return found

    def star(self, s: float) -> int:
        """The star of a place, m along the route; -1 for none."""
        return next((one.star for one in self.pieces if s <= one.high), self.pieces[-1].star)

    def stray(self, a: float, b: float) -> float:
        """How far at most the line between two places, m along the route, is from straight, m.

        On each piece the bend is sharpest at an end of it.
        """
        ends: list[float] = []
        for one in self.pieces:
            low, high = max(a, one.low), min(b, one.high)
            if low < high:
                ends += [low, max(low, high - BEFORE)]
        most = max([0.0, *[abs(bend) for _x, _y, _heading, bend in self.seen(ends)]])
        return 0.125 * (b - a) ** 2 * most

    def joints(self, a: float, b: float) -> list[float]:
        """Where parts of the route meet between two places, m along the route."""
        return [
            after.low
            for one, after in itertools.pairwise(self.pieces)
            if self._part(one) != self._part(after) and a < after.low < b
        ]

    def crossings(self, star: int, spokes: int, turned: float) -> list[Crossing]:
        """Where the line crosses the spokes of a star, the first turned from x by that, rad."""
        found: list[Crossing] = []
        for one in self.pieces:
            if one.star == star:
                if self._own_centre(one.row, star):
                    found += self._of_spiral(one, spokes, turned)
                else:
                    found += self._of_any(one, spokes, turned)
        return found

    def reach(self, star: int) -> float:
        """How far the line goes from a stake, m."""
        return max(self._away(one, self.stakes[star]) for one in self.pieces if one.star == star)

    def _part(self, piece: Piece) -> float:
        part: float = self._table[piece.row][RouteRow.PART]
        return part

    def _piece(self, j: int, star: int) -> Piece:
        row, trail = self._table[j], self._trail
        low = trail.low if j == 0 else max(trail.low, row[RouteRow.S_START])
        return Piece(j, low, min(trail.high, row[RouteRow.S_START] + row[RouteRow.LENGTH]), star)

    def _centre(self, j: int) -> Point | None:
        """About what a row turns by itself: a spiral, or an arc of whole turns."""
        row = self._table[j]
        if row[RouteRow.KIND] == CurveKind.SPIRAL:
            return row[RouteRow.X], row[RouteRow.Y]
        bend = row[RouteRow.P]
        if row[RouteRow.KIND] != CurveKind.ARC or abs(bend) * row[RouteRow.LENGTH] < 2.0 * math.pi:
            return None
        heading = row[RouteRow.ANGLE]
        x, y = row[RouteRow.X] - math.sin(heading) / bend, row[RouteRow.Y] + math.cos(heading) / bend
        return x, y

    def _own(self, j: int) -> int:
        """The star about whose stake a row turns by itself; a stake that is new is noted."""
        centre, piece = self._centre(j), self._piece(j, -1)
        if centre is None or piece.low >= piece.high:
            return -1
        for n, stake in enumerate(self.stakes):
            if math.dist(stake, centre) < SAME:
                self._reach[n] = max(self._reach[n], self._away(piece, centre))
                return n
        self.stakes.append(centre)
        self._reach.append(self._away(piece, centre))
        return len(self.stakes) - 1

    def _own_centre(self, j: int, star: int) -> bool:
        """Whether a row is a spiral about that stake."""
        row = self._table[j]
        if row[RouteRow.KIND] != CurveKind.SPIRAL:
            return False
        return math.dist((row[RouteRow.X], row[RouteRow.Y]), self.stakes[star]) < 1e-9

    def _star(self, piece: Piece) -> int:
        """The star of a piece: about whose stake it turns, or within whose reach it lies."""
        if piece.star >= 0:
            return piece.star
        for n, stake in enumerate(self.stakes):
            if self._away(piece, stake) <= self._reach[n] + SAME:
                return n
        return -1

    def _samples(self, piece: Piece) -> list[float]:
        count = math.ceil((piece.high - piece.low) / STEP) + 1
        step = (piece.high - piece.low) / count
        return [*[piece.low + step * n for n in range(count)], piece.high]

    def _away(self, piece: Piece, stake: Point) -> float:
        """The greatest distance of the samples of a piece from a stake, m."""
        return max(math.hypot(x - stake[0], y - stake[1]) for x, y, _h, _k in self._sampled(piece))

    def _sampled(self, piece: Piece) -> list[list[float]]:
        return self.seen(self._samples(piece))

    def _turns_about(self, peg: Point) -> bool:
        """Whether all of it lies within a tape from the peg, and turns about it once at least."""
        turned, before = 0.0, math.nan
        for one in self.pieces:
            for x, y, _heading, _bend in self._sampled(one):
                off = x - peg[0], y - peg[1]
                if not SAME < math.hypot(off[0], off[1]) <= TAPE:
                    return False
                angle = math.atan2(off[1], off[0])
                if not math.isnan(before):
                    turned += math.remainder(angle - before, 2.0 * math.pi)
                before = angle
        return abs(turned) >= 2.0 * math.pi - 1e-6

    def _of_spiral(self, piece: Piece, spokes: int, turned: float) -> list[Crossing]:
        """The crossings of a spiral about the stake, in closed form: its parameter is the angle."""
        row = self._table[piece.row]
        ends = [
            parameter_at(self._rows, piece.row, s - row[RouteRow.S_START])
            for s in (piece.low, piece.high)
        ]
        angles: list[float] = []
        tapes: list[int] = []
        for n in range(spokes):
            first = row[RouteRow.Q] * (turned + 2.0 * math.pi * n / spokes - row[RouteRow.ANGLE])
            low = math.ceil((min(ends) - first) / (2.0 * math.pi))
            high = math.floor((max(ends) - first) / (2.0 * math.pi))
            for k in range(low, high + 1):
                angles.append(first + 2.0 * math.pi * k)
                tapes.append(n + 1)
        if not angles:
            return []
        out = np.empty(len(angles))
        at = np.array([piece.row for _angle in angles], np.int64)
        positions(self._rows, at, np.array(angles), out)
        return [Crossing(s, tape, "") for s, tape in zip(out.tolist(), tapes, strict=True)]

    def _of_any(self, piece: Piece, spokes: int, turned: float) -> list[Crossing]:
        """The crossings of any piece: brackets between samples, halved."""
        places, points = self._samples(piece), self._sampled(piece)
        lows: list[float] = []
        highs: list[float] = []
        tapes: list[int] = []
        for n in range(spokes):
            angle = turned + 2.0 * math.pi * n / spokes
            sides = [self._side(piece.star, angle, one) for one in points]
            for i in range(len(sides) - 1):
                ahead = self._ahead(piece.star, angle, points[i])
                if (sides[i] < 0.0) != (sides[i + 1] < 0.0) and ahead > 0.0:
                    lows.append(places[i])
                    highs.append(places[i + 1])
                    tapes.append(n + 1)
        if not lows:
            return []
        for _half in range(HALVINGS):
            middles = [0.5 * (a + b) for a, b in zip(lows, highs, strict=True)]
            at, start = self.seen(middles), self.seen(lows)
            for i, tape in enumerate(tapes):
                angle = turned + 2.0 * math.pi * (tape - 1) / spokes
                below = self._side(piece.star, angle, start[i]) < 0.0
                if (self._side(piece.star, angle, at[i]) < 0.0) == below:
                    lows[i] = middles[i]
                else:
                    highs[i] = middles[i]
        return [Crossing(s, tape, "") for s, tape in zip(lows, tapes, strict=True)]

    def _side(self, star: int, angle: float, at: Sequence[float]) -> float:
        """How far a place is to the left of a spoke, m."""
        x, y = self.stakes[star]
        return math.cos(angle) * (at[1] - y) - math.sin(angle) * (at[0] - x)

    def _ahead(self, star: int, angle: float, at: Sequence[float]) -> float:
        """How far a place is along a spoke, m."""
        x, y = self.stakes[star]
        return math.cos(angle) * (at[0] - x) + math.sin(angle) * (at[1] - y)
