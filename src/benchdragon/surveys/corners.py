"""Corners of a polyline, rounded: by arcs, or by clothoids with an arc between them."""

import math
from dataclasses import dataclass

import numpy as np

from benchdragon.kernels.curve import FloatArray
from benchdragon.model.curves import AnyCurve, Arc, Clothoid, Line
from benchdragon.surveys.clothoids import folded

# Share of a corner that clothoids turn; the arc between them turns the rest.
EASED = 0.5
# A corner that turns by less than this, rad, is none.
LEAST_TURN = 1e-12
# A line between two bends that is shorter than this, m, is left out.
LEAST_LINE = 1e-10
# Wider bends are as good as straight, m; circles of over 1e8 m are none.
MOST_RADIUS = 1e6
# Share of the first and of the last side of an open line that stays straight.
STRAIGHT_END = 0.1
# A turn by more than this, rad, is a hairpin: no bend rounds it.
MOST_CORNER = math.pi - 1e-6


@dataclass(frozen=True)
class Shapes:
    """Bends for corners, of radius 1 m.

    Attributes:
        tangent: from the corner to where the bend begins, (C,).
        reach: from the corner to the nearest point of the bend, (C,), the most by which they differ.
        eased: angle that each clothoid turns, rad, (C,), 0 without.
    """

    tangent: FloatArray
    reach: FloatArray
    eased: FloatArray


def shapes(turns: FloatArray, smooth: bool) -> Shapes:
    """Of corners that turn by so much, rad; `smooth` bends begin and end with a clothoid."""
    half = 0.5 * np.abs(turns)
    eased = EASED * half if smooth else np.zeros_like(half)
    x, y = np.sin(eased), np.cos(eased)
    for n, angle in enumerate(eased.tolist()):
        if angle > 0.0:
            (end_x, end_y), _heading = Clothoid(2.0 * angle, 0.0, 1.0).end_pose
            x[n], y[n] = end_x, end_y + y[n]
    # The centre of the arc is at (cx, cy) from the start of the bend, along the side and across it.
    cx, cy = x - np.sin(eased), y
    return Shapes(cx + cy * np.tan(half), _reach(cy, half), eased)


def _reach(cy: FloatArray, half: FloatArray) -> FloatArray:
    """cy / cos(half) - 1, without cancelling: cy is 1 and a little more."""
    return (cy - 1.0 + 2.0 * np.sin(0.5 * half) ** 2) / np.cos(half)


@dataclass(frozen=True)
class Corners:
    """The sides of a polyline, (S,), and how much it turns after each; at an open end not at all."""

    points: FloatArray
    lengths: FloatArray
    headings: FloatArray
    turns: FloatArray

    @classmethod
    def of(cls, points: FloatArray, closed: bool) -> "Corners":
        """Those of points (P, 2)."""
        ring = np.vstack([points, points[:1]]) if closed else points
        step = np.diff(ring, axis=0)
        headings = np.arctan2(step[:, 1], step[:, 0])
        turns = folded(np.roll(headings, -1) - headings)
        if not closed:
            turns[-1] = 0.0
        return cls(ring, np.hypot(step[:, 0], step[:, 1]), headings, turns)

    @property
    def closed(self) -> bool:
        """Whether the last side leads to the first."""
        return bool(np.all(self.points[0] == self.points[-1]))


def radii(corners: Corners, shape: Shapes, reach: FloatArray) -> FloatArray:
    """The radius of the bend at the end of each side, m, (S,): infinite where it does not turn.

    Each is as large as its `reach` allows, m, and its sides: where two bends want more than a side
    holds, they share it so that both get the same radius; then each, the narrowest first, takes
    what its neighbours leave.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        wanted = np.where(shape.reach > 0.0, reach / shape.reach, np.inf)
    wanted = np.minimum(wanted, MOST_RADIUS)
    tangent = np.where(np.abs(corners.turns) > LEAST_TURN, shape.tangent, 0.0)
    before = np.roll(tangent, 1)
    room = corners.lengths.copy()
    if not corners.closed:
        room[[0, -1]] *= 1.0 - STRAIGHT_END
    both = before + tangent
    with np.errstate(divide="ignore", invalid="ignore"):
        fair = np.where(both > 0.0, room / both, np.inf)
    found = np.minimum(wanted, np.minimum(fair, np.roll(fair, -1)))
    found[tangent == 0.0] = np.inf
    return _widened(found, wanted, tangent, room)


def _widened(
    found: FloatArray, wanted: FloatArray, tangent: FloatArray, room: FloatArray
) -> FloatArray:
    count = len(found)
    length = np.where(tangent > 0.0, np.where(np.isfinite(found), found, 0.0) * tangent, 0.0)
    for n in np.argsort(found, kind="stable").tolist():
        if tangent[n] == 0.0:
            continue
        after = (n + 1) % count
        left = min(room[n] - length[n - 1], room[after] - length[after]) if count > 1 else 0.0
        length[n] = max(length[n], min(wanted[n] * tangent[n], left))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(tangent > 0.0, length / tangent, np.inf)


def rounded(corners: Corners, shape: Shapes, bends: FloatArray) -> list[AnyCurve]:
    """Lines and bends of these radii, m: (S,).

    A closed one begins where the bend at the end of its last side ends.
    """
    tangent = np.where(np.isfinite(bends), bends, 0.0) * shape.tangent
    found: list[AnyCurve] = []
    for n, (x, y) in enumerate(corners.points[:-1].tolist()):
        begin = float(tangent[n - 1]) if n or corners.closed else 0.0
        heading = float(corners.headings[n])
        left = float(corners.lengths[n] - begin - tangent[n])
        if left > LEAST_LINE:
            start = x + begin * math.cos(heading), y + begin * math.sin(heading)
            found.append(Line(left, start, heading))
        if tangent[n] > 0.0:
            back = -float(tangent[n])
            corner = corners.points[n + 1].tolist()
            at = corner[0] + back * math.cos(heading), corner[1] + back * math.sin(heading)
            found += _bend(float(bends[n]), float(corners.turns[n]), float(shape.eased[n]), at, heading)
    return found


def _bend(
    radius: float, turn: float, eased: float, at: tuple[float, float], heading: float
) -> list[AnyCurve]:
    """An arc, or clothoid, arc and clothoid, that begins at a pose."""
    if eased == 0.0:
        return [Arc(radius, turn, at, heading)]
    side = math.copysign(1.0, turn)
    bend, length = side / radius, 2.0 * radius * eased
    first = Clothoid(length, 0.0, bend, at, heading)
    middle = Arc(radius, turn - 2.0 * side * eased, *first.end_pose)
    return [first, middle, Clothoid(length, bend, 0.0, *middle.end_pose)]
