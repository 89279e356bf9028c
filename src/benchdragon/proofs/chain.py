"""The dragon with its head at a route position: each handle's exact place, enclosed.

Each handle is followed to a point of the route that is known with 128 bits, by a Newton step from a
computed place, which is a guess alone. How far the exact handle stands from that point, along the
route, is bounded with the bound of the handle before: the distance of the two points differs from the
link by what is enclosed, and along the route it grows at least as fast as the smallest cosine of the
angle between bench and route that errors allow.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from flint import arb

from benchdragon.kernels.curve import FloatArray
from benchdragon.proofs.ball_route import BallRoute, Row

# Roundings of the few products that bound an error, and what cosines change by within one.
ROUNDED_UP = 1.0 + 1e-6
COSINE_SLACK = 1e-9
# Errors that could change a cosine by more are no errors of rounding, m.
MOST_ERROR = 1e-15
# Newton steps to a handle, and rows passed meanwhile.
MOST_STEPS = 12


class UnprovedError(Exception):
    """A step of a proof failed; the text names it for developers."""


@dataclass(frozen=True)
class Handle:
    """A point of the route near an exact handle.

    Attributes:
        j: number of its row.
        u: its parameter there, exact.
        s: its route position, m.
        pose: point, m, and unit tangent.
        error: how far along the route the exact handle may be from it, m.
    """

    j: int
    u: arb
    s: arb
    pose: tuple[arb, arb, arb, arb]
    error: float


@dataclass(frozen=True, eq=False)
class Chain:
    """All handles with the head at one route position.

    Attributes:
        handles: from the head's to the tail's.
        origin: near the dance, m.
        s: route positions, m, as doubles, (handles,).
        turned: what the heading has turned through from the route's start, either way, rad, (handles,).
        x: of places relative to `origin`, m, as doubles.
        y: the same.
        tangent: (handles, 2).
    """

    handles: Sequence[Handle]
    origin: tuple[float, float]
    s: FloatArray
    turned: FloatArray
    x: FloatArray
    y: FloatArray
    tangent: FloatArray

    @classmethod
    def of(cls, route: BallRoute, handles: Sequence[Handle], origin: tuple[float, float]) -> "Chain":
        """Handles on a route, about such an origin, m."""
        s = np.array([float(one.s) for one in handles])
        turned = np.array([_turned(route.rows[one.j], one) for one in handles])
        x, y = (np.array([float(one.pose[n] - origin[n]) for one in handles]) for n in (0, 1))
        tangent = np.array([[float(one.pose[2]), float(one.pose[3])] for one in handles])
        return cls(handles, origin, s, turned, x, y, tangent)

    def first(self, benches: int) -> "Chain":
        """That of so many benches from the head on."""
        some = slice(benches + 1)
        places = self.s[some], self.turned[some], self.x[some], self.y[some]
        return Chain(self.handles[some], self.origin, *places, self.tangent[some])


def _turned(row: Row, handle: Handle) -> float:
    turning = row.turning(float(handle.u))
    return row.turned + (turning if (float(handle.u) - float(row.start)) * row.way >= 0.0 else -turning)


def enclosed_chain(
    route: BallRoute, links: Sequence[arb], s: arb, guess: tuple[Sequence[int], FloatArray],
    origin: tuple[float, float],
) -> Chain:  # fmt: skip
    """The chain with its head at route position s, m, near computed rows and parameters.

    Raises:
        UnprovedError: where no handle could be shown to stand near its guess.
    """
    rows, at = guess
    handles = [_head(route, s, int(rows[0]), float(at[0]))]
    for link, j, u in zip(links, rows[1:], at[1:].tolist(), strict=True):
        handles.append(follower(route, handles[-1], link, int(j), u))
    return Chain.of(route, handles, origin)


def _head(route: BallRoute, s: arb, j: int, guess: float) -> Handle:
    u = arb(guess)
    for _step in range(MOST_STEPS):
        row = route.rows[j]
        off = row.position(u) - s
        if abs(off) < 1e-30:
            return Handle(j, u, s, row.pose(u), _size(off))
        u = (u - row.way * off / row.stretch(u)).mid()
        j, u = _within(route, j, u)
    raise UnprovedError(f"the head is not at {float(s)!r} m of the route")


def follower(route: BallRoute, front: Handle, link: arb, j: int, guess: float) -> Handle:
    """The handle one link behind another."""
    u = arb(guess)
    x, y, front_x, front_y = front.pose
    for _step in range(MOST_STEPS):
        row = route.rows[j]
        pose = row.pose(u)
        dx, dy = x - pose[0], y - pose[1]
        apart = (dx * dx + dy * dy).sqrt()
        off = apart - link
        behind = (dx * pose[2] + dy * pose[3]) / apart
        if abs(off) < 1e-25:
            ahead = abs(float((dx * front_x + dy * front_y) / apart)) + COSINE_SLACK
            error = (_size(off) + min(ahead, 1.0) * front.error) / (float(behind) - COSINE_SLACK)
            if not 0.0 <= error * ROUNDED_UP <= MOST_ERROR:
                break
            return Handle(j, u, row.position(u), pose, error * ROUNDED_UP)
        u = (u + row.way * off / (behind * row.stretch(u))).mid()
        j, u = _within(route, j, u)
    raise UnprovedError(f"no handle near parameter {guess!r} of row {j} is {float(link)!r} m behind")


def _within(route: BallRoute, j: int, u: arb) -> tuple[int, arb]:
    """The row of a point that a step has led to, and its parameter there, not beyond an end."""
    row = route.rows[j]
    if not math.isfinite(float(u)):
        raise UnprovedError("a step has led to no point")
    if (u - row.start) * row.way < 0 and not math.isinf(row.back):
        if j == 0:
            raise UnprovedError("a handle stands before the start of the route")
        before = route.rows[j - 1]
        beyond = row.length(row.start) * row.way - row.length(u) * row.way
        return j - 1, (before.end - before.way * beyond / before.stretch(before.end)).mid()
    if (u - row.end) * row.way > 0 and j + 1 < len(route.rows):
        after = route.rows[j + 1]
        beyond = (row.length(u) - row.length(row.end)) * row.way
        return j + 1, (after.start + after.way * beyond / after.stretch(after.start)).mid()
    return j, u


def _size(value: arb) -> float:
    """A float that is surely at least |value|."""
    return math.nextafter(float(value.abs_upper()), math.inf)
