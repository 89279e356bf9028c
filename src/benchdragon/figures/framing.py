"""Which part of the ground a picture shows: where the route bends; what lies far about it is an inset.

A dragon that comes along a line of hundreds of metres to coil up in twenty would else be drawn with a
coil of a few per cent of the picture.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
import numpy.typing as npt

from benchdragon.kernels.curve import FloatArray
from benchdragon.model.base_curve import Point
from benchdragon.model.curves import Route

# Points along the route, m apart, and at most so many.
ROUTE_STEP = 0.1
MOST_ROUTE_POINTS = 200_000
# Of a frame's side the core takes at least so much; all is shown where all leaves it as much.
CORE_SHARE = 0.625
# The bends that count hold so much of all that the route turns by.
TURNING_SHARE = 0.9
# Of a picture's shorter side, the longer side of an inset; it is at most so many times as long as wide.
INSET_SHARE, INSET_ASPECT = 0.36, 3.0
# Between an inset and the picture's edges, as a share of the picture.
INSET_GAP = 0.02


@dataclass(frozen=True)
class Area:
    """A rectangle of the ground, m.

    Args:
        middle: (x, y).
        width: along x.
        height: along y.
    """

    middle: Point
    width: float
    height: float

    @classmethod
    def around(cls, points: FloatArray, room: float) -> Self:
        """The least rectangle about `points`, m, (n, 2), and `room` m on all sides of it."""
        low, high = points.min(axis=0), points.max(axis=0)
        (x, y), (width, height) = 0.5 * (low + high), high - low + 2.0 * room
        return cls((float(x), float(y)), float(width), float(height))

    def across(self, aspect: float) -> float:
        """The width, m, of a picture that shows it all and is `aspect` times as wide as high."""
        return max(self.width, self.height * aspect)

    def filled(self, aspect: float, share: float = 1.0) -> Self:
        """The ground of a picture of that aspect that has it in the middle, and gives it `share`."""
        across = self.across(aspect) / share
        return replace(self, width=across, height=across / aspect)

    def beyond(self, points: FloatArray) -> FloatArray:
        """How far `points`, m, (n, 2), lie outside, m, (n, 2): 0 within."""
        half = 0.5 * np.array([self.width, self.height])
        off = points - np.array(self.middle)
        outside: FloatArray = off - np.clip(off, -half, half)
        return outside

    @property
    def limits(self) -> tuple[Point, Point]:
        """From where to where it reaches along x, and along y."""
        (x, y), half, tall = self.middle, 0.5 * self.width, 0.5 * self.height
        return (x - half, x + half), (y - tall, y + tall)


@dataclass(frozen=True)
class Framing:
    """What pictures of a dance show.

    Args:
        core: where the dragon bends, where it touches, the disc.
        whole: all that the dragon covers.
    """

    core: Area
    whole: Area

    def cut(self, aspect: float) -> bool:
        """Whether all would leave the core too little of a picture of that aspect."""
        return self.core.across(aspect) < CORE_SHARE * self.whole.across(aspect)

    def frame(self, aspect: float, handles: FloatArray) -> Area:
        """The ground of a picture of that aspect, of a dragon with `handles` at (N + 1, 2), m.

        All, or the core; or as far from the core as is needed to see the handle nearest to it.
        """
        if not self.cut(aspect):
            return self.whole.filled(aspect)
        outside = self.core.beyond(handles[~np.isnan(handles[:, 0])])
        dx, dy = outside[np.abs(outside).max(axis=1).argmin()] if len(outside) else (0.0, 0.0)
        x, y = self.core.middle
        moved = replace(self.core, middle=(x + float(dx), y + float(dy)))
        return moved.filled(aspect, CORE_SHARE)


def framing(
    route: Route, spans: FloatArray, room: float, kept: Sequence[Point] = (), rest: float = 0.0
) -> Framing:
    """What pictures of a dragon on a route show.

    Args:
        route: what it stays on.
        spans: from its tail to its head, m along the route, (n, 2).
        room: about all that is shown, m.
        kept: points that stay in sight too, m.
        rest: room about the core, m.
    """
    s = route_positions(float(spans.min()), float(spans.max()))
    covered = np.any((spans[:, :1] <= s) & (s <= spans[:, 1:]), axis=0)
    points, extra = route.point(s), np.array(kept, dtype=np.float64).reshape(-1, 2)
    whole = Area.around(np.concatenate([points[covered], extra]), room)
    bends = bending(route, s, covered, max(whole.width, whole.height))
    core = np.concatenate([points[bends], extra])
    return Framing(Area.around(core, rest) if len(core) else whole, whole)


def bending(
    route: Route, s: FloatArray, covered: npt.NDArray[np.bool_], side: float
) -> npt.NDArray[np.bool_]:
    """Which of the route positions `s`, evenly spread, m, lie where the dragon bends.

    There the route turns more sharply than a circle that fills a frame of `side` m; stretches that
    turn little beside the others do not count.
    """
    change = np.diff(route.heading(s), append=route.heading(s[-1:]))
    turned = np.abs((change + math.pi) % (2.0 * math.pi) - math.pi)
    sharp = covered & (turned * side > 2.0 * (s[1] - s[0]))
    stretch = np.cumsum(sharp & ~np.roll(sharp, 1))
    totals = np.bincount(stretch, np.where(sharp, turned, 0.0))
    order = np.argsort(-totals, kind="stable")
    enough = np.searchsorted(np.cumsum(totals[order]), TURNING_SHARE * totals.sum()) + 1
    bends: npt.NDArray[np.bool_] = sharp & np.isin(stretch, order[:enough])
    return bends


def route_positions(start: float, end: float) -> FloatArray:
    """Route positions from one to another, m, near enough to draw what lies there."""
    count = int(min(max((end - start) / ROUTE_STEP, 2), MOST_ROUTE_POINTS))
    return np.linspace(start, end, count)


def inset(
    framed: Framing, frame: Area, points: FloatArray, free: Sequence[Point]
) -> tuple[Area, tuple[float, float, float, float]]:
    """The ground that an inset shows, and the inset's place in a picture of `frame`.

    Args:
        framed: what is shown.
        frame: the ground of the picture.
        points: of the route, m, (n, 2).
        free: corners that may be taken, as (0 or 1, 0 or 1): left or right, below or above.

    Returns:
        The ground, and left, bottom, width, height as shares of the picture; it lies in the corner
        under which there is least of the route.
    """
    corners = [point for area in (framed.whole, frame) for point in zip(*area.limits, strict=True)]
    ground = Area.around(np.array(corners), 0.0)
    long = max(ground.width, ground.height)
    least = long / INSET_ASPECT
    ground = replace(ground, width=max(ground.width, least), height=max(ground.height, least))
    unit = INSET_SHARE * min(frame.width, frame.height) / long
    wide, tall = unit * ground.width / frame.width, unit * ground.height / frame.height
    (x0, _x1), (y0, _y1) = frame.limits
    at = (points - np.array([x0, y0])) / np.array([frame.width, frame.height])
    places = [
        (
            INSET_GAP + (1.0 - wide - 2.0 * INSET_GAP) * right,
            INSET_GAP + (1.0 - tall - 2.0 * INSET_GAP) * above,
        )
        for right, above in free
    ]
    hidden = [
        int(((at >= place) & (at <= np.array(place) + np.array([wide, tall]))).all(axis=1).sum())
        for place in places
    ]
    left, bottom = places[int(np.argmin(hidden))]
    return ground, (left, bottom, wide, tall)
