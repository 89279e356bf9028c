"""Which parts of a random dance on an inward spiral must be searched: a bound in closed form.

On r = b theta a point has the excess sigma = r - b phi, phi counted on from turn to turn: 0 on the
spiral, one pitch more for the same point seen from one turn farther in (kernels/spiral_bound.py). A
handle a metres outward of the spiral has the excess a, but for second order. Bounds on the excess of
benches follow from their handles, and tell, pair by pair, that neighbouring turns cannot come near each
other (design/imprecision.py shows how little is left to be searched).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from benchdragon.kernels import curve as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray
from benchdragon.model.curves import Route
from benchdragon.model.dragon import Dragon

# Stretches into which a walk is divided, each bounded at once, are about so long, in shortest links.
STRETCH = 2.5
# Beyond these the bound is not tried: angle between bench and route, rad; how far handles are off the
# route, in its radii of curvature; a link's way along it, in links.
MOST_ANGLE, MOST_ASIDE, MOST_WAY = 0.9, 0.3, 1.5
# So much of the route, in links of the whole dragon, a line that strays is known behind its head.
WAYS = 1.1
# Table of a line that strays, m; how much steeper it may be between; how far it is from what is
# tabulated, across and along, m.
GRID, STEEPER, ACROSS, ALONG = 0.25, 1.02, 1e-5, 0.1
# Entries of a table of the route's radius lie so far apart, m.
APART = 0.5
# Stretches are searched together whose open benches differ by this factor at most.
ALIKE = 1.3
# What is left for rounding, m and rad.
SPARE, SPARE_ANGLE = 1e-6, 1e-3

Offset = Callable[[FloatArray], tuple[FloatArray, FloatArray]]


@dataclass(frozen=True)
class Part:
    """Head positions, m, between which the first `count` benches must be searched for contacts."""

    start: float
    end: float
    count: int

    def mapped(self, place: Callable[[float], float]) -> "Part":
        """The same part with its head positions counted along another line."""
        return Part(place(self.start), place(self.end), self.count)


def open_parts(
    route: Route,
    dragon: Dragon,
    aside: FloatArray,
    offset: Offset | None,
    span: tuple[float, float],
    wanted: float,
) -> tuple[Part, ...]:
    """Parts of a dance outside which no two non-adjacent benches come as near as `wanted`, m.

    Handle i walks aside[i] metres to the left of a line (on it if `aside` is empty) that runs
    offset(s)[0] to the left of the route at route position s, with slope offset(s)[1]. The head walks
    over `span`, m. Where the bound does not hold, as on routes that are no single inward spiral, a part
    has all benches.
    """
    row, count = route.rows[0], len(dragon)
    spiral = len(route.rows) == 1 and row[kernel.KIND] == kernel.SPIRAL
    if not spiral or row[kernel.U_END] >= row[kernel.U_START] or count < 3:
        return (Part(*span, count),)
    bound = _Bound(route, dragon, aside, offset, span)
    if not bound.holds:
        return (Part(*span, count),)
    stretches = max(1, int((span[1] - span[0]) / (STRETCH * float(dragon.links.min()))))
    borders = np.linspace(*span, stretches + 1)
    return _joined(borders, bound.open_benches(borders[:-1], borders[1:], wanted))


def _joined(borders: FloatArray, counts: IntArray) -> tuple[Part, ...]:
    """Parts made of neighbouring stretches with about as many open benches, where there are any."""
    parts: list[Part] = []
    ends = borders.tolist()
    for n, count in enumerate(counts.tolist()):
        last = parts[-1] if parts and parts[-1].end == ends[n] else None
        if count and last and max(count, last.count) <= ALIKE * min(count, last.count):
            parts[-1] = Part(last.start, ends[n + 1], max(count, last.count))
        elif count:
            parts.append(Part(ends[n], ends[n + 1], count))
    return tuple(parts)


class _Bound:
    """Bounds on benches beside an inward spiral while the head walks over a span; offsets outward."""

    def __init__(
        self,
        route: Route,
        dragon: Dragon,
        aside: FloatArray,
        offset: Offset | None,
        span: tuple[float, float],
    ) -> None:
        self._route, self._end, row = route, span[1], route.rows[0]
        self._sizes, self._links = dragon.sizes, dragon.links
        self._b, self._centre = float(row[kernel.P]), row[[kernel.X, kernel.Y]]
        (x, y), heading = route.point(span[1]) - self._centre, float(route.heading(span[1]))
        outward = math.copysign(1.0, y * math.cos(heading) - x * math.sin(heading))
        self._aside = outward * aside if aside.size else np.zeros(len(dragon) + 1)
        # Between entries the radius lies above the line: its second derivative is at most b^2 / r^3.
        low = span[0] - MOST_WAY * float(dragon.links.sum()) - 1.0
        self._places = np.linspace(low, span[1], 2 + int((span[1] - low) / APART))
        away = route.point(self._places) - self._centre
        self._radius = np.hypot(away[:, 0], away[:, 1])
        least = max(float(self._radius[-1]), SPARE)
        above = 0.125 * APART**2 * self._b**2 / least**3
        self._most_stray, self._slope = 0.0, 0.0
        self._grid, self._stray = np.zeros(0), np.zeros(0)
        if offset is not None:
            low = span[0] - WAYS * float(dragon.links.sum()) - ALONG
            self._grid = np.arange(low, span[1], GRID)
            stray, slope = offset(self._grid)
            self._stray, self._slope = outward * stray, STEEPER * float(np.abs(slope).max())
            self._most_stray = float(np.abs(stray).max()) + self._slope * GRID + ACROSS
        self._most = float(np.abs(self._aside).max()) + self._most_stray + above
        self.holds = self._follows(float(np.abs(route.curvature(span[1]))))
        if self.holds:
            self._prepare()

    def _follows(self, bend: float) -> bool:
        """Whether all benches surely follow; bounds on the way along the route to each handle.

        The chord of a curve beside the route and the step aside to the next handle are sides of the
        triangle whose third is the link; the angle between them is nearly right.
        """
        links = self._links
        self._apart = np.abs(np.diff(self._aside)) + self._slope * MOST_WAY * links
        most = np.abs(self._aside[:-1]) + self._most_stray
        if self._most * bend > MOST_ASIDE:
            return False
        roughly = np.append(0.0, np.cumsum(links - self._apart)[:-1]) / (1.0 + self._most * bend)
        local = np.abs(self._route.curvature(self._end - roughly))
        bent = local / (1.0 - self._most * local)
        angle = 0.5 * bent * MOST_WAY * links
        chord = 1.0 - angle**2 / 6.0  # of an arc, at least
        longest = self._apart * angle + np.hypot(links, self._apart * angle)
        shortest = np.sqrt(np.maximum(links**2 - self._apart**2, 0.0)) - self._apart * angle
        self._ways = longest / (np.maximum(chord, SPARE) * (1.0 - most * local))
        self._nearest = np.append(0.0, np.cumsum(shortest / (1.0 + most * local)))
        self._farthest = np.append(0.0, np.cumsum(self._ways))
        if self._stray.size and self._farthest[-1] > WAYS * float(links.sum()):
            return False
        tilted = angle + self._apart / links
        return bool((self._ways < MOST_WAY * links).all() and (tilted < MOST_ANGLE).all())

    def _radii(self, s: FloatArray) -> FloatArray:
        return np.asarray(np.interp(s, self._places, self._radius))

    def _prepare(self) -> None:
        """How far the polar angles of points of a bench are off its handles, and where turns stray."""
        links, (_length, width, front, rear) = self._links, self._sizes
        low = self._radii(self._end - self._nearest[:-1]) - self._most
        radius, half = np.maximum(low, SPARE), 0.5 * width
        span = np.hypot(links + np.maximum(front, rear), half)
        body, ahead, behind = (
            np.where(size < radius, np.arcsin(np.minimum(size / radius, 1.0)), math.pi)
            + self._most * self._b / radius**2
            + SPARE_ANGLE
            for size in (span, np.hypot(front, half), np.hypot(rear, half))
        )
        self._slack, self._ahead, self._behind = 2.0 * float(body.max()), ahead, behind
        if self._stray.size:
            from scipy.ndimage import minimum_filter1d  # slow to import

            theta = self._radii(self._grid) / self._b
            near, far = (
                0.5 * self._b * (u * np.hypot(1.0, u) + np.arcsinh(u))
                for u in (theta, theta + 2.0 * math.pi)
            )
            beside = (
                self._slack * (self._b * float(theta.max()) + 4.0 * math.pi * self._b) + 2.0 * ALONG
            )
            lowest = minimum_filter1d(self._stray, 5 + 2 * int(beside / GRID), mode="nearest")
            outer = np.maximum((self._grid - (far - near) - self._grid[0]) / GRID, 0.0)
            self._more = self._stray - lowest[outer.astype(np.int64)] + 2.0 * self._slope * GRID

    def open_benches(self, starts: FloatArray, ends: FloatArray, wanted: float) -> IntArray:
        """How many benches from the head hold all pairs that may come near in each stretch."""
        first, last = starts[:, np.newaxis] - ALONG, ends[:, np.newaxis] + ALONG
        low = self._radii(last - self._nearest) - self._most
        high = self._radii(first - self._farthest) + self._most
        out, dip, edge = self._excess(low, high)
        pitch, count = 2.0 * math.pi * self._b, len(self._links)
        if not edge > 0.0:
            return np.full(len(starts), count)
        out += self._strays(first, last)
        room = wanted * math.hypot(1.0, self._b / edge) + SPARE
        # On one turn: polar angle of the link between, against what both reach towards each other.
        between = np.diff(self._nearest)[1:-1] / (high[:, 2:-1] + self._b)
        shut = (between > self._behind[:-2] + self._ahead[2:]).all(axis=1)
        shut &= out.max(axis=1) - dip.min(axis=1) + room < 2.0 * pitch
        # One turn farther out: so far along the route at least, and at most.
        slack = self._slack
        most = (2.0 * math.pi + slack) * (high[:, 1:] + (1.0 + slack) * pitch + self._b)
        least = (2.0 * math.pi - slack) * low[:, 1:]
        found = np.zeros(len(starts), dtype=np.int64)
        farthest, nearest = most.max(axis=0), least.min(axis=0)
        for d in range(2, count):
            low_way = self._nearest[d:-1] - self._nearest[1:-d]
            high_way = self._farthest[d:-1] - self._farthest[1:-d]
            rows = np.flatnonzero(
                (low_way <= farthest[: count - d]) & (high_way >= nearest[: count - d])
            )
            if rows.size:
                near = out[:, rows] - dip[:, rows + d] + room >= pitch
                near &= (low_way[rows] <= most[:, rows]) & (high_way[rows] >= least[:, rows])
                found = np.maximum(found, np.where(near, rows + d + 1, 0).max(axis=1))
        return np.where(shut, found, count)

    def _excess(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray, float]:
        """Greatest and least excess of each bench, m, but for the line's; the least radius of any.

        At distance t from the foot of the centre on the line of two handles, p from the centre, the
        excess has the second derivative p^2 / r^3 + 2 b p t / r^4: positive, at most 1 / p + b / p^2.
        """
        b, links, (_length, width, front, rear) = self._b, self._links, self._sizes
        # From the middle of the handles to the foot, and from there to the farther handle, at most.
        apart = b * self._ways / np.maximum(low[..., :-1], SPARE) + self._apart + SPARE
        far = apart * high[..., 1:] / links + 0.5 * links
        p = np.sqrt(np.maximum(low[..., :-1] ** 2 - far**2, 0.0))
        edge = float((p - 0.5 * width).min())
        if edge <= 0.0 or (p <= 2.0 * b * (far + np.maximum(front, rear)) / p).any():
            return far, far, 0.0
        p -= 0.5 * width
        bend, gradient = 1.0 / p + b / p**2, np.hypot(1.0, b / p)
        at, after = self._aside[:-1], self._aside[1:]
        tilt, steep = (at - after) / links, self._slope * self._ways / links
        rest = 0.5 * width * gradient + np.maximum(front, rear) * steep + SPARE
        rest += self._most * (gradient - 1.0 + self._slope**2) + 0.5 * self._most**2 * bend
        before = np.maximum(front * tilt + 0.5 * bend * front * (links + front), 0.0)
        behind = np.maximum(-rear * tilt + 0.5 * bend * rear * (links + rear), 0.0)
        dip = np.minimum(at, after) - 0.125 * bend * links**2
        dip = np.minimum(dip, np.minimum(at + front * tilt, after - rear * tilt))
        return np.maximum(at + before, after + behind) + rest, dip - rest, edge

    def _strays(self, first: FloatArray, last: FloatArray) -> FloatArray:
        """How much farther out the line may lie under each bench than one turn farther out, m."""
        if not self._stray.size:
            return np.zeros((len(first), len(self._links)))
        from scipy.ndimage import maximum_filter1d

        low, high = first - self._farthest[1:], last - self._nearest[:-1]
        size = 3 + int(float((high - low).max()) / GRID)
        highest = maximum_filter1d(self._more, size, mode="nearest")
        middle = (0.5 * (low + high) - self._grid[0]) / GRID
        return np.asarray(highest[np.clip(middle.astype(np.int64), 0, len(highest) - 1)])
