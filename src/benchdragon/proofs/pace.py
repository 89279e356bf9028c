"""How fast handles are in a cell: never faster than a bound, by their headings alone.

The speed ratio of two handles of a bench is that of the cosines of the angles between bench and route
at both. These angles are enclosed over a cell from what they are at its start and from how fast they
change: where bench and route turn alike, they hardly do. So are the speeds, from both ends of the cell,
at which they are known to rounding: that gives a bound that is wrong by the square of its length alone.
Near a smooth greatest speed cells may then be as long as they are far from it; where a handle crosses
a joint, at which that change jumps, only the cell that holds the joint need be short.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from weakref import WeakKeyDictionary

from flint import arb

from benchdragon.proofs.ball_route import BallRoute
from benchdragon.proofs.chain import Chain, Handle
from benchdragon.proofs.motion import over_kink

# How often angles are enclosed from how fast they change, and that from the angles.
ROUNDS = 5


@dataclass(frozen=True)
class Pace:
    """A handle over a cell, by the head's way.

    Attributes:
        speed: metres a metre of the head's way.
        change: its derivative by the head's way, 1/m.
    """

    speed: arb
    change: arb


@dataclass(frozen=True)
class Course:
    """The route's headings, rad, and curvatures, 1/m, where a handle is over a cell."""

    heading: arb
    bend: arb


@dataclass(frozen=True)
class Still:
    """All handles and benches of a chain, enclosed to rounding.

    Attributes:
        headings: of the route at all handles, rad.
        benches: headings of all benches, rad.
        speeds: of all handles with the head at 1 m/s, m/s.
    """

    headings: Sequence[arb]
    benches: Sequence[arb]
    speeds: Sequence[arb]

    @classmethod
    def of(cls, chain: Chain, route: BallRoute, links: Sequence[arb]) -> "Still":
        """Those of a chain; kept, as it ends one cell and begins the next."""
        if (known := KEPT.get(chain)) is not None:
            return known
        headings = [course(route, one, one).heading for one in chain.handles]
        benches = [_bench_heading(chain, k, link) for k, link in enumerate(links)]
        speeds = [arb(1)]
        for k, bench in enumerate(benches):
            ahead, behind = (_cosine_sine(headings[n] - bench)[0] for n in (k, k + 1))
            speeds.append(speeds[-1] * ahead / behind)
        found = KEPT[chain] = cls(headings, benches, speeds)
        return found


KEPT: WeakKeyDictionary[Chain, Still] = WeakKeyDictionary()


def paces(a: Chain, b: Chain, route: BallRoute, links: Sequence[arb]) -> Iterator[Pace]:
    """All handles between two chains, from the head's on.

    With angles p and q between bench and route at the front and the rear handle, and u = cos p / cos q
    the ratio of their speeds, the bench turns by (sin p - u sin q) / link a metre of the front handle's
    way, p by as much less than the route bends, and log u changes by tan q dq - tan p dp. Infinite, or
    no number, where an angle may be right; the change is, where a handle may cross a kink.
    """
    share = (b.handles[0].s - a.handles[0].s).union(arb(0))
    first, last = (Still.of(chain, route, links) for chain in (a, b))
    at = first.headings
    growth, lead = arb(0), Pace(arb(1), arb(0))
    front = course(route, a.handles[0], b.handles[0])
    yield lead
    for k, link in enumerate(links):
        rear, bench = course(route, a.handles[k + 1], b.handles[k + 1]), first.benches[k]
        swung = arb(0, ((_way(a, b, k) + _way(a, b, k + 1)) / link).asin().abs_upper())
        ahead, behind = (one.heading - bench - swung for one in (front, rear))
        speed = arb(0, math.inf)
        for _round in range(ROUNDS):
            (c, s), (rear_c, rear_s) = _cosine_sine(ahead), _cosine_sine(behind)
            ratio = c / rear_c
            turning = (s - ratio * rear_s) / link
            opens, rear_opens = (
                lead.speed * (front.bend - turning),
                lead.speed * (ratio * rear.bend - turning),
            )
            relative = growth + rear_s / rear_c * rear_opens - s / c * opens
            speed = _both(speed, lead.speed * ratio)
            speed = _both(speed, first.speeds[k + 1] + share * relative * speed)
            speed = _both(speed, last.speeds[k + 1] - share * relative * speed)
            ahead = _both(ahead, at[k] - bench + share * opens)
            behind = _both(behind, at[k + 1] - bench + share * rear_opens)
        growth, lead, front = relative, Pace(speed, relative * speed), rear
        yield lead


def slower(a: Chain, b: Chain, route: BallRoute, links: Sequence[arb], most: arb) -> bool:
    """Whether no handle is ever faster than `most` between two chains, the head at 1 m/s."""
    way = b.handles[0].s - a.handles[0].s
    ends = (Still.of(chain, route, links).speeds for chain in (a, b))
    return all(
        greatest(pace, first, last, way) <= most
        for pace, first, last in zip(paces(a, b, route, links), *ends, strict=True)
    )


def greatest(pace: Pace, first: arb, last: arb, way: arb) -> arb:
    """A speed that is not exceeded over a cell of this length, m, with such speeds at its ends."""
    low, high = pace.change.lower(), pace.change.upper()
    if not pace.change.is_finite():
        return pace.speed.upper()
    if low >= 0 or high <= 0:
        return first.max(last)
    return (high * last - low * first - low * high * way) / (high - low)


def course(route: BallRoute, one: Handle, other: Handle) -> Course:
    """All headings and curvatures from a handle's place to its next, enclosed."""
    found: list[Course] = []
    for j in range(one.j, other.j + 1):
        row = route.rows[j]
        low = one.u if j == one.j else row.start
        high = other.u if j == other.j else row.end
        u = low.union(high) + arb(0, (one.error + other.error) / float(row.stretch(low).lower()))
        bend = row.bend(u)
        heading = row.heading(u.mid()) + row.way * bend * row.stretch(u) * (u - u.mid())
        if found:  # a heading is known up to full turns
            full = 2 * arb.pi()
            heading -= full * round(float((heading - found[0].heading) / full))
        found.append(Course(heading, bend))
    whole = found[0]
    for each in found[1:]:
        whole = Course(whole.heading.union(each.heading), whole.bend.union(each.bend))
    if over_kink(route, one, other):  # where the speed jumps, and has no derivative
        whole = Course(whole.heading, arb(0, math.inf))
    return whole


def _bench_heading(chain: Chain, k: int, link: arb) -> arb:
    """The heading of bench number k, rad, enclosed to rounding."""
    front, rear = chain.handles[k : k + 2]
    dx, dy = front.pose[0] - rear.pose[0], front.pose[1] - rear.pose[1]
    return arb.atan2(dy, dx) + arb(0, float((2 * (front.error + rear.error) / link).upper()))


def _way(a: Chain, b: Chain, k: int) -> arb:
    """How far handle number k goes from one chain to the next, m, at most."""
    one, other = a.handles[k], b.handles[k]
    return other.s - one.s + one.error + other.error


def _cosine_sine(angle: arb) -> tuple[arb, arb]:
    """Both of an enclosed angle, wide only where they are steep."""
    off, (s, c) = arb(angle.rad()), angle.mid().sin_cos()
    bow, (wide_s, wide_c) = off * off / 2, angle.sin_cos()
    near = c + arb(0, (abs(s) * off + bow).upper()), s + arb(0, (abs(c) * off + bow).upper())
    return _both(near[0], wide_c), _both(near[1], wide_s)


def _both(one: arb, other: arb) -> arb:
    """What is in both of two enclosures; the first where the other is none."""
    if not other.is_finite():
        return one
    return one.intersection(other) if one.is_finite() else other
