"""The reference implementation in mpmath: walks, handles, speeds and distances, in any precision.

It shares nothing with the package. A walk is a function from route position to point, m. Handles are
found by stepping back until the chord is as long as the link, and then inside that bracket; tangents
are differences of points; benches are four corners.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import mpmath as mp

# Steps per link in the search: no chord of these walks rises and falls within so short a step.
STEPS = 24
MOST_SECANTS = 60
# Of Newton's method in floats, from a good first guess.
FLOAT_STEPS = 5

Number = Any  # mpf and mpc: mpmath has no types
Point = Any
Points = Callable[[Number], Point]
Corners = Sequence[Point]


class Bench(NamedTuple):
    """Sizes of a bench, m, as decimal text or as floats."""

    length: str | float
    width: str | float = "0.30"
    front: str | float = "0.275"
    rear: str | float = "0.275"

    @property
    def link(self) -> Number:
        return mp.mpf(self.length) - mp.mpf(self.front) - mp.mpf(self.rear)


def contest_dragon(benches: int = 223) -> list[Bench]:
    return [Bench("3.41")] + [Bench("2.20")] * (benches - 1)


def arc_length(k: Number, theta: Number) -> Number:
    """Of r = k theta from the centre: the integral of k sqrt(1 + theta^2)."""
    root = mp.sqrt(1 + theta * theta)
    return k * (theta * root + mp.log(theta + root)) / 2


def angle_at(k: Number, length: Number) -> Number:
    """The inverse of `arc_length` by Newton's method, whose last step squares a small error.

    It begins in floats, where a few steps leave their rounding alone.
    """
    turns, rough = float(length / k), math.sqrt(2.0 * float(length / k))
    for _step in range(FLOAT_STEPS):
        root = math.hypot(1.0, rough)
        rough -= (0.5 * (rough * root + math.asinh(rough)) - turns) / root
    theta, enough = mp.mpf(rough), mp.mpf(10) ** (-mp.mp.dps // 2 - 4)
    step = enough
    while abs(step) >= enough:
        step = (arc_length(k, theta) - length) / (k * mp.sqrt(1 + theta * theta))
        theta -= step
    return theta


def spiral_walk(pitch: Number | str, theta: Number) -> Points:
    """Inward along r = k theta, clockwise, at angle `theta` when s = 0."""
    k = mp.mpf(pitch) / (2 * mp.pi)
    whole = arc_length(k, theta)

    def point(s: Number) -> Point:
        angle = angle_at(k, whole - s)
        return k * angle * mp.expj(angle)

    return point


def turn_sizes(pitch: Number | str, radius: Number | str, ratio: Number) -> dict[str, Number | Point]:
    """Radii, centres and sweep of two tangent arcs between a spiral at `radius` and its half-turn twin.

    The centres lie on the normals at the ends A and -A; the arcs touch where the centres are r1 + r2
    apart. From |2 A + (r1 + r2) n| = r1 + r2, n being the unit normal at A towards the inside.
    """
    k, r, ratio = mp.mpf(pitch) / (2 * mp.pi), mp.mpf(radius), mp.mpf(ratio)
    theta = r / k
    start = r * mp.expj(theta)
    tangent = -(1 + 1j * theta) * mp.expj(theta) / mp.sqrt(1 + theta * theta)
    normal = -1j * tangent
    both = -(abs(start) ** 2) / (start * mp.conj(normal)).real
    r1, r2 = both * ratio / (ratio + 1), both / (ratio + 1)
    c1, c2 = start + r1 * normal, -start - r2 * normal
    touch = c1 + (c2 - c1) * r1 / both
    sweep = mp.arg((start - c1) / (touch - c1))
    sweep += 2 * mp.pi if sweep < 0 else 0
    return {"k": k, "theta": theta, "start": start, "r1": r1, "r2": r2, "touch": touch,
            "c1": c1, "c2": c2, "sweep": sweep, "length": both * sweep}  # fmt: skip


def turn_walk(pitch: Number | str, radius: Number | str, ratio: Number) -> Points:
    """In along the spiral, through the turn from s = 0, and out along the half-turned spiral."""
    size = turn_sizes(pitch, radius, ratio)
    k, whole = size["k"], arc_length(size["k"], size["theta"])
    first, both = size["r1"] * size["sweep"], size["length"]

    def point(s: Number) -> Point:
        if s < 0:
            theta = angle_at(k, whole - s)
            return k * theta * mp.expj(theta)
        if s < first:
            return size["c1"] + (size["start"] - size["c1"]) * mp.expj(-s / size["r1"])
        if s < both:
            return size["c2"] + (size["touch"] - size["c2"]) * mp.expj((s - first) / size["r2"])
        theta = angle_at(k, whole + s - both)
        return -k * theta * mp.expj(theta)

    return point


def root(function: Callable[[Number], Number], a: Number, b: Number) -> Number:
    """A root near a and b by the secant method.

    Each error is about the last one to the power 1.6: none is left after a step of two thirds of the
    digits.

    Raises:
        ArithmeticError: if it does not settle.
    """
    fa, fb, enough = function(a), function(b), mp.mpf(10) ** (-2 * mp.mp.dps // 3)
    for _step in range(MOST_SECANTS):
        if fb == fa:
            break
        a, fa, b = b, fb, b - fb * (b - a) / (fb - fa)
        if abs(b - a) < enough:
            return b
        fb = function(b)
    raise ArithmeticError(f"no root near {mp.nstr(b, 20)}")


def place_behind(point: Points, s: Number, link: Number) -> Number:
    """The largest position below s whose point is one link away."""
    here = point(s)

    def excess(b: Number) -> Number:
        return abs(point(b) - here) - link

    near, far = s, s - link  # a chord is never longer than its arc
    while excess(far) < 0:
        near, far = far, far - link / STEPS
    if near == s:
        return far
    return root(excess, far, near)


def places(point: Points, dragon: Sequence[Bench], head: Number, last: int) -> list[Number]:
    """Route positions of handles 0..last, m."""
    s = [mp.mpf(head)]
    for bench in dragon[:last]:
        s.append(place_behind(point, s[-1], bench.link))
    return s


def tangent(point: Points, s: Number) -> Point:
    """Difference of two points: right to 9 in 20 digits where curves meet, to more elsewhere."""
    h = mp.mpf(10) ** (-9 * mp.mp.dps // 20)
    return (point(s + h) - point(s - h)) / (2 * h)


def speeds(point: Points, at: Sequence[Number]) -> list[Number]:
    """Speeds of handles at route positions `at`, the head's speed being 1."""
    here, along, found = point(at[0]), tangent(point, at[0]), [mp.mpf(1)]
    for s in at[1:]:
        there, next_along = point(s), tangent(point, s)
        bench = here - there
        # The distance of the handles stays: (v t - v' t') . bench = 0.
        change = (along * mp.conj(bench)).real / (next_along * mp.conj(bench)).real
        found.append(found[-1] * change)
        here, along = there, next_along
    return found


def corners(front: Point, rear: Point, bench: Bench) -> list[Point]:
    """Of a bench with its handles there: front left, rear left, rear right, front right."""
    ahead = (front - rear) / abs(front - rear)
    nose, end = front + mp.mpf(bench.front) * ahead, rear - mp.mpf(bench.rear) * ahead
    left = 1j * ahead * mp.mpf(bench.width) / 2
    return [nose + left, end + left, end - left, nose - left]


def separations(a: Corners, b: Corners) -> list[list[Number]]:
    """How far the 4 corners of one rectangle lie outside each of the other's sides, m: 8 rows."""
    out = []
    for sides, others in ((a, b), (b, a)):
        for n in range(4):
            side = sides[(n + 1) % 4] - sides[n]
            outward = -1j * side / abs(side)
            out.append([((corner - sides[n]) * mp.conj(outward)).real for corner in others])
    return out


def gap(a: Corners, b: Corners) -> Number:
    """The signed gap by the separating axis theorem, m: of all sides, the one that parts them most."""
    return max(min(row) for row in separations(a, b))


def _from_side(corner: Point, start: Point, end: Point) -> Number:
    side = end - start
    share = ((corner - start) * mp.conj(side)).real / abs(side) ** 2
    return abs(corner - start - min(max(share, 0), 1) * side)


def distance(a: Corners, b: Corners) -> Number:
    """The true distance of two rectangles, m: of a corner from a side; 0 where they overlap."""
    if gap(a, b) <= 0:
        return mp.mpf(0)
    pairs = ((a, b), (b, a))
    return min(_from_side(p, q[n - 1], q[n]) for one, q in pairs for p in one for n in range(4))


def pair_corners(
    point: Points, dragon: Sequence[Bench], head: Number, pair: tuple[int, int]
) -> tuple[Corners, Corners]:
    """Corners of two benches, numbered from 1, with the head's handle at route position `head`."""
    s = places(point, dragon, head, max(pair))
    first, second = (corners(point(s[n - 1]), point(s[n]), dragon[n - 1]) for n in pair)
    return first, second


def pair_gap(point: Points, dragon: Sequence[Bench], head: Number, pair: tuple[int, int]) -> Number:
    return gap(*pair_corners(point, dragon, head, pair))
