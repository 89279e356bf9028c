"""Lines of a drawing, in metres near the dance: corners with bulges, or curves as surveyed."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.kernels.curve import MOST_METRES, FloatArray
from benchdragon.model.curves import AnyCurve, Arc, Clothoid, Line

# Limits of untrusted files: bytes of one file, corners of one line, lines of one file.
MOST_BYTES = 50_000_000
MOST_CORNERS = 100_000
MOST_LINES = 10_000
# A route of more parts takes too long to search.
MOST_CURVES = 10_000
# Curves that have no exact form here are replaced by chords that keep within this of them, m.
FLATTENED = 1e-3
# Corners nearer to one another than this are one corner, m.
SAME = 1e-9
# Lines whose corners agree to so many decimals of a metre are one line drawn twice.
ROUNDED = 6
# tan(sweep / 4) of what counts as straight.
STRAIGHT = 1e-12


@dataclass(frozen=True)
class DrawnLine:
    """A line of a drawing.

    Attributes:
        name: its layer, or what else the file calls it; "" where it has no name.
        corners: (P, 3), x and y of each corner, m, and the bulge of what leads to the next one:
            tan of a quarter of the arc's angle, left positive, 0 for a straight line; (0, 3) where
            `curves` say it all. Of an open line the last bulge says nothing.
        curves: as surveyed, in order, with gaps and kinks as they are.
        closed: whether it ends where it starts; the last corner leads back to the first.
        off: how far what is here may lie from what the file says, m.
        hidden: whether its layer is off.
    """

    name: str
    corners: FloatArray
    curves: tuple[AnyCurve, ...] = ()
    closed: bool = False
    off: float = 0.0
    hidden: bool = False

    @property
    def bent(self) -> bool:
        """Whether any part of it is curved by itself, and not a chord between points."""
        return bool(self.curves) or bool(np.any(np.abs(self.corners[:, 2]) > STRAIGHT))

    def pieces(self) -> tuple[AnyCurve, ...]:
        """Its parts: lines and arcs between the corners, or the curves as surveyed."""
        return self.curves or curves_of(self.corners, self.closed)

    def points(self, tolerance: float = FLATTENED) -> tuple[FloatArray, float]:
        """Corners (P, 2) of chords that stand for it, m, and a bound on how far they lie from it, m."""
        if not self.bent:
            return self.corners[:, :2].copy(), self.off
        points, off = chords(self.pieces(), tolerance)
        if self.closed and math.dist(points[0], points[-1]) <= tolerance:
            points = points[:-1]
        return points, self.off + off


def corners_of(points: Sequence[Sequence[float]] | FloatArray, closed: bool = False) -> FloatArray:
    """Corners without bulges, (P, 3), of points (P, 2), those that repeat the one before left out.

    Raises:
        InputError: for more than MOST_CORNERS, or for what is not finite.
    """
    given = np.asarray(points, np.float64).reshape(-1, np.shape(points)[-1] if len(points) else 2)
    _check_count(len(given))
    if not np.isfinite(given).all():
        raise InputError(_("every coordinate must be a finite number"))
    corners = np.zeros((len(given), 3))
    corners[:, : given.shape[1]] = given
    return _without_repeats(corners, closed)


def _check_count(count: float) -> None:
    if not count <= MOST_CORNERS:
        text = _("a line may have {most} points at most, not {count}")
        raise InputError(text.format(most=MOST_CORNERS, count=f"{count:.10g}"))


def _without_repeats(corners: FloatArray, closed: bool) -> FloatArray:
    """Of corners in one place the last counts: its bulge is that of what leads on."""
    steps = np.hypot(*np.diff(corners[:, :2], axis=0).T)
    kept = corners[np.append(steps > SAME, True)] if len(corners) else corners
    while closed and len(kept) > 1 and math.dist(kept[0, :2], kept[-1, :2]) <= SAME:
        kept = kept[:-1]
    return kept


def curves_of(corners: FloatArray, closed: bool) -> tuple[AnyCurve, ...]:
    """Lines and arcs that lead from corner to corner (P, 3)."""
    ends = np.vstack([corners[1:], corners[:1]]) if closed else corners[1:]
    return tuple(_curve(*a, *b[:2]) for a, b in zip(corners.tolist(), ends.tolist(), strict=False))


def _curve(x: float, y: float, bulge: float, end_x: float, end_y: float) -> AnyCurve:
    chord = math.hypot(end_x - x, end_y - y)
    heading = math.atan2(end_y - y, end_x - x)
    if abs(bulge) <= STRAIGHT:
        return Line(chord, (x, y), heading)
    sweep = 4.0 * math.atan(bulge)
    radius = 0.25 * chord * (1.0 + bulge * bulge) / abs(bulge)
    if radius > MOST_METRES:
        bend = math.copysign(1.0 / radius, bulge)
        return Clothoid(radius * abs(sweep), bend, bend, (x, y), heading - 0.5 * sweep)
    return Arc(radius, sweep, (x, y), heading - 0.5 * sweep)


def chords(curves: Sequence[AnyCurve], tolerance: float) -> tuple[FloatArray, float]:
    """Points (P, 2) whose chords keep within `tolerance` of curves, and how far they lie at most, m.

    A curve whose curvature is at most k keeps within k h^2 / 8 of a chord over h metres of it, since
    its second derivative by arc length is at most k; gaps between curves are bridged by chords.

    Raises:
        InputError: for more than MOST_CORNERS points, before any is computed.
    """
    bends = np.array([most_bend(curve) for curve in curves])
    lengths = np.array([curve.length for curve in curves])
    counts = np.maximum(1.0, np.ceil(lengths * np.sqrt(bends / (8.0 * tolerance))))
    _check_count(float(counts.sum()) + len(curves))
    off = float((0.125 * bends * (lengths / counts) ** 2).max(initial=0.0))
    found = [
        curve.point(np.linspace(0.0, curve.length, count + 1))
        for curve, count in zip(curves, counts.astype(np.int64).tolist(), strict=True)
    ]
    kept = _without_repeats(corners_of(np.concatenate(found)), False)
    return kept[:, :2].copy(), off


def most_bend(curve: AnyCurve) -> float:
    """The greatest absolute curvature of a line, arc or clothoid, 1/m: it is at one of its ends."""
    return float(np.abs(curve.curvature([0.0, curve.length])).max())


def once(lines: Sequence[DrawnLine]) -> list[DrawnLine]:
    """Lines without those that lie on another of their layer just like them, either way round."""
    found: dict[object, DrawnLine] = {}
    for line in lines:
        there = line.corners.round(ROUNDED)
        back = turned_round(there)
        if line.closed:
            back[-1:, 2] = -there[-1:, 2]
            there, back = _from_least(there), _from_least(back)
        else:
            there[-1:, 2] = 0.0
        key = min((way + 0.0).tobytes() for way in (there, back))  # of -0.0, too
        found.setdefault((line.name, line.closed, line.curves, key), line)
    return list(found.values())


def _from_least(ring: FloatArray) -> FloatArray:
    """Corners of a closed line, beginning with that farthest to the left, and of these the lowest."""
    return np.roll(ring, -int(np.lexsort((ring[:, 1], ring[:, 0]))[0]), axis=0)


def chained(lines: Sequence[DrawnLine], gap: float) -> list[DrawnLine]:
    """Lines whose ends meet within `gap`, m, joined end to end, turned round where they must be.

    Ends at which more than two lines meet are not joined, as the continuation is ambiguous.
    """
    left = [line for line in lines if not line.closed and not line.curves]
    found = [line for line in lines if line.closed or line.curves]
    ends = _Ends(left, gap)
    while (start := ends.first_free()) is not None:
        found.append(ends.chain_from(start))
    return found


class _Ends:
    """Which ends of open lines meet; lines are taken out as chains of them are found."""

    def __init__(self, lines: Sequence[DrawnLine], gap: float) -> None:
        self.lines, self.gap = lines, gap
        self.free = [True] * len(lines)
        places = np.array([line.corners[end, :2] for line in lines for end in (0, -1)])
        self.partner = _partners(places.reshape(-1, 2), gap)

    def first_free(self) -> int | None:
        """A line that begins a chain, else any that is left: then it is part of a ring."""
        left = [n for n, free in enumerate(self.free) if free]
        loose = (n for n in left if self.partner[2 * n] < 0 or self.partner[2 * n + 1] < 0)
        return next(loose, left[0] if left else None)

    def chain_from(self, start: int) -> DrawnLine:
        """The chain that begins with a line."""
        backwards = self.partner[2 * start] >= 0 > self.partner[2 * start + 1]
        enter = 2 * start + backwards
        taken: list[FloatArray] = []
        first, off = enter, 0.0
        while True:
            n = enter // 2
            self.free[n] = False
            line = self.lines[n]
            off = max(off, line.off)
            taken.append(line.corners if enter % 2 == 0 else turned_round(line.corners))
            leave = enter ^ 1
            enter = self.partner[leave]
            if enter < 0 or not self.free[enter // 2]:
                break
        closed = enter == first and len(taken) + (len(taken[0]) > 2) > 1
        return self._one(start, taken, closed, off)

    def _one(self, start: int, taken: list[FloatArray], closed: bool, off: float) -> DrawnLine:
        corners = [*taken[0]]
        for more in taken[1:]:
            corners[-1] = np.array([*corners[-1][:2], more[0, 2]])
            corners += [*more[1:]]
        if closed:
            corners = corners[:-1]
        ends = [*pairwise(taken), *([(taken[-1], taken[0])] if closed else [])]
        shift = max((math.dist(a[-1, :2], b[0, :2]) for a, b in ends), default=0.0)
        return replace(self.lines[start], corners=np.array(corners), closed=closed, off=off + shift)


def turned_round(corners: FloatArray) -> FloatArray:
    """The corners of an open line, (P, 3), from its end to its start."""
    back = corners[::-1].copy()
    back[:-1, 2] = -corners[::-1][1:, 2]
    back[-1:, 2] = 0.0
    return back


def _partners(places: FloatArray, gap: float) -> list[int]:
    """For each end the one other end within `gap`, m; -1 for none and for several."""
    from scipy.spatial import KDTree  # takes long to import, and few need it

    if not len(places):
        return []
    # Each end is its own nearest; of a third one it is enough to know that it is there.
    found = KDTree(places).query(places, k=3, distance_upper_bound=gap)
    distances, numbers = np.asarray(found[0]).tolist(), np.asarray(found[1]).tolist()
    partners = []
    for n, (far, near) in enumerate(zip(distances, numbers, strict=True)):
        others = [m for away, m in zip(far, near, strict=True) if m != n and away <= gap]
        partners.append(others[0] if len(others) == 1 else -1)
    return partners
