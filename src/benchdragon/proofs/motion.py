"""How handles move between two chains: by how much at most, with what speed and acceleration.

Speeds are metres a metre of the head's way. A box is all places that a handle may have between both.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from flint import arb

from benchdragon.kernels.curve import FloatArray
from benchdragon.proofs.ball_route import BallRoute
from benchdragon.proofs.chain import Chain, Handle

# Roundings of doubles, m or rad: coordinates are taken relative to a place near the dance.
SLACK = 1e-9
# Places between a rear handle and its front one at which the way between is looked over; if these do
# not show it, so many more.
LOOKED = (64, 512)


def moves(a: Chain, b: Chain) -> FloatArray:
    """How far each handle goes between two chains, m, (handles,), at most; NaN if it goes back."""
    if a is b:  # the dragon stands
        return np.array([2.0 * handle.error for handle in a.handles])
    found = []
    for one, other in zip(a.handles, b.handles, strict=True):
        errors = one.error + other.error
        way = other.s - one.s
        found.append(float(way.upper()) + errors if way > errors else np.nan)
    farthest: FloatArray = np.nextafter(np.array(found), np.inf)
    return farthest


def follows(a: Chain, b: Chain, links: FloatArray, way: FloatArray) -> bool:
    """Whether each handle surely follows the one before, without a leap, from one chain to the next.

    The angle between a bench and the route stays under a right angle at both its handles while they go
    from place to place: so, by the intermediate value theorem, there is a place one link behind, and
    only one there.
    """
    turned = b.turned - a.turned + SLACK
    bench = np.stack([a.x[:-1] - a.x[1:], a.y[:-1] - a.y[1:]], axis=1) / links[:, np.newaxis]
    swing = way[:-1] + way[1:] + SLACK
    if not (swing < links).all() or not (turned >= 0.0).all():
        return False
    swung = np.arcsin(swing / links)
    for tangent, own in ((a.tangent[:-1], turned[:-1]), (a.tangent[1:], turned[1:])):
        across = bench[:, 0] * tangent[:, 1] - bench[:, 1] * tangent[:, 0]
        angle = np.arctan2(np.abs(across), (bench * tangent).sum(axis=1))  # arccos is steep near 1
        if not (angle + swung + own + 1e-6 < 0.5 * np.pi).all():
            return False
    return True


def nearest(a: Chain, b: Chain, route: BallRoute, links: FloatArray, way: FloatArray) -> bool:
    """Whether no place between a handle and the one before it is ever a link away from that.

    So the handle stands at the nearest place one link behind. Where the route turns by less than a
    right angle between the two that is sure; else the way between is looked over.
    """
    turns = b.turned[:-1] - a.turned[1:] + SLACK
    return all(
        any(_nearer_between(a, b, route, float(links[k]), way, k, places) for places in LOOKED)
        for k in np.flatnonzero(turns >= 0.5 * np.pi).tolist()
    )


def _nearer_between(
    a: Chain, b: Chain, route: BallRoute, link: float, way: FloatArray, k: int, places: int
) -> bool:
    """The same of one bench, whose front handle is number k, at so many places between."""
    at = np.linspace(a.s[k + 1], b.s[k], places + 1)
    x, y, turned = _looked_over(route, a, at, k)
    half = 0.5 * float(at[1] - at[0]) + SLACK
    apart = np.hypot(x - a.x[k], y - a.y[k])
    sure = apart + half + way[k] + SLACK < link
    # Near the rear handle, where the distance is nearly a link, it grows as long as the angle is acute.
    bench = (a.x[k] - a.x[k + 1]) / link, (a.y[k] - a.y[k + 1]) / link
    tangent = a.tangent[k + 1]
    across = bench[0] * tangent[1] - bench[1] * tangent[0]
    angle = np.arctan2(abs(across), bench[0] * tangent[0] + bench[1] * tangent[1])
    off = way[k] + (at - at[0]) + SLACK
    swung = np.arcsin(np.minimum(off / link, 1.0))
    acute = angle + swung + turned + 1e-6 < 0.5 * np.pi
    first = int(np.argmin(acute)) if not acute.all() else len(acute)
    return bool(sure[max(first - 1, 0) :].all()) and first > 0


def _looked_over(
    route: BallRoute, a: Chain, at: FloatArray, k: int
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Places at route positions between handles, and what the heading has turned through to there."""
    points = [_pose_at(route, a.handles[k + 1], s) for s in at.tolist()]
    x, y, turned = np.array(points).T
    return x - a.origin[0], y - a.origin[1], turned - a.turned[k + 1] + SLACK


def _pose_at(route: BallRoute, rear: Handle, s: float) -> tuple[float, float, float]:
    """Point and turning at a route position ahead of a handle, to rounding."""
    j = rear.j
    while j + 1 < len(route.rows) and float(route.rows[j + 1].s) <= s:
        j += 1
    row = route.rows[j]
    u = rear.u if j == rear.j else row.start
    for _step in range(60):
        off = arb(s) - row.position(u)
        u = (u + row.way * off / row.stretch(u)).mid()
        if abs(off) < 1e-12:
            break
    x, y, _tx, _ty = row.pose(u)
    return float(x), float(y), row.turned + row.turning(float(u))


@dataclass(frozen=True)
class Drive:
    """A handle in its box: place, m, speed and acceleration by the head's way, enclosed."""

    place: tuple[arb, arb]
    speed: tuple[arb, arb]
    acceleration: tuple[arb, arb]


def drives(a: Chain, b: Chain, route: BallRoute, links: Sequence[arb], count: int) -> list[Drive]:
    """The first handles between two chains.

    By the derivatives of |front - rear| = link. Infinite where an angle may be right.
    """
    found: list[Drive] = []
    along, rate = arb(1), arb(0)  # speed and its change along the route
    for k in range(count):
        place, tangent, bend = _box(route, a.handles[k], b.handles[k])
        if k:
            front = found[-1]
            dx, dy = (front.place[n] - place[n] for n in (0, 1))
            link = links[k - 1]
            behind = (dx * tangent[0] + dy * tangent[1]) / link
            along = (dx * front.speed[0] + dy * front.speed[1]) / (link * behind)
            speed = along * tangent[0], along * tangent[1]
            vx, vy = (front.speed[n] - speed[n] for n in (0, 1))
            turning = vx * vx + vy * vy
            pull = dx * front.acceleration[0] + dy * front.acceleration[1]
            across = bend * along * along * (dy * tangent[0] - dx * tangent[1])
            rate = (pull + turning - across) / (link * behind)
        speed = along * tangent[0], along * tangent[1]
        square = bend * along * along
        acceleration = (
            rate * tangent[0] - square * tangent[1],
            rate * tangent[1] + square * tangent[0],
        )
        found.append(Drive(place, speed, acceleration))
    return found


def _box(route: BallRoute, one: Handle, other: Handle) -> tuple[tuple[arb, arb], tuple[arb, arb], arb]:
    """All points, tangents and curvatures from a handle's place to its next, enclosed."""
    boxes = []
    for j in range(one.j, other.j + 1):
        row = route.rows[j]
        low = one.u if j == one.j else row.start
        high = other.u if j == other.j else row.end
        u = low.union(high) + arb(0, (one.error + other.error) / float(row.stretch(low).lower()))
        boxes.append((*row.pose(u), row.bend(u)))
    x, y, tx, ty, bend = (_hull(values) for values in zip(*boxes, strict=True))
    if over_kink(route, one, other):  # where the speed jumps, and no second derivative is
        bend = arb(0, np.inf)
    return (x, y), (tx, ty), bend


def over_kink(route: BallRoute, one: Handle, other: Handle) -> bool:
    """Whether a handle may go over a kink from its place to its next."""
    error = one.error + other.error
    inside = any(route.rows[j].kink for j in range(one.j + 1, other.j + 1))
    at_start = route.rows[one.j].kink and not one.s - route.rows[one.j].s > error
    ahead = other.j + 1 < len(route.rows) and route.rows[other.j + 1].kink
    return inside or at_start or (ahead and not route.rows[other.j + 1].s - other.s > error)


def _hull(values: Sequence[arb]) -> arb:
    whole = values[0]
    for value in values[1:]:
        whole = whole.union(value)
    return whole
