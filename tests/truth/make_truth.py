"""A second road to the reference values, in 40-digit arithmetic, sharing nothing with the package.

A walk is a function from route position to point. Handles are found by stepping back until the
chord is as long as the link, and then inside that bracket; tangents are differences of points.
"""

import json
import sys
from collections.abc import Callable, Sequence
from typing import Any

import mpmath as mp

DIGITS = 40
BENCHES = 223
HEAD_LINK, BODY_LINK = "2.86", "1.65"
HANDLES = (0, 1, 51, 101, 151, 201, 223)
SPIRAL_TIMES = (0, 60, 120, 180, 240, 300)
TURN_TIMES = (-100, -50, 0, 14, 50, 100)
# Steps per link in the search: no chord of these walks rises and falls within so short a step.
STEPS = 24

Number = Any  # mpf and mpc: mpmath has no types
Point = Any
Points = Callable[[Number], Point]
Entry = tuple[str, str, str]


def arc_length(k: Number, theta: Number) -> Number:
    """Of r = k theta from the centre: the integral of k sqrt(1 + theta^2)."""
    root = mp.sqrt(1 + theta * theta)
    return k * (theta * root + mp.log(theta + root)) / 2


def angle_at(k: Number, length: Number) -> Number:
    return mp.findroot(lambda a: arc_length(k, a) - length, mp.sqrt(2 * length / k), solver="newton",
                       df=lambda a: k * mp.sqrt(1 + a * a))  # fmt: skip


def spiral_walk(pitch: str, start_theta: Number) -> Points:
    """Inward along r = k theta, clockwise, at `start_theta` when s = 0."""
    k = mp.mpf(pitch) / (2 * mp.pi)
    whole = arc_length(k, start_theta)

    def point(s: Number) -> Point:
        theta = angle_at(k, whole - s)
        return k * theta * mp.expj(theta)

    return point


def turn_sizes(pitch: str, radius: str, ratio: int) -> dict[str, Number | Point]:
    """Radii, centres and sweep of two tangent arcs between a spiral at `radius` and its half-turn twin.

    The centres lie on the normals at the ends A and -A; the arcs touch where the centres are r1 + r2
    apart. From |2 A + (r1 + r2) n| = r1 + r2, n being the unit normal at A towards the inside.
    """
    k, r = mp.mpf(pitch) / (2 * mp.pi), mp.mpf(radius)
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
    return {"k": k, "theta": theta, "start": start, "r1": r1, "r2": r2,
            "c1": c1, "c2": c2, "sweep": sweep, "length": both * sweep}  # fmt: skip


def turn_walk(pitch: str = "1.7", radius: str = "4.5", ratio: int = 2) -> Points:
    """In along the spiral, through the turn from s = 0, and out along the half-turned spiral."""
    size = turn_sizes(pitch, radius, ratio)
    k, whole = size["k"], arc_length(size["k"], size["theta"])
    first, both = size["r1"] * size["sweep"], size["length"]
    touch = size["c1"] + (size["c2"] - size["c1"]) * size["r1"] / (size["r1"] + size["r2"])

    def point(s: Number) -> Point:
        if s < 0:
            theta = angle_at(k, whole - s)
            return k * theta * mp.expj(theta)
        if s < first:
            return size["c1"] + (size["start"] - size["c1"]) * mp.expj(-s / size["r1"])
        if s < both:
            return size["c2"] + (touch - size["c2"]) * mp.expj((s - first) / size["r2"])
        theta = angle_at(k, whole + s - both)
        return -k * theta * mp.expj(theta)

    return point


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
    return mp.findroot(excess, (far, near), solver="anderson", tol=mp.mpf(10) ** (8 - 2 * DIGITS))


def tangent(point: Points, s: Number) -> Point:
    """Difference of two points 2e-18 m apart: right to about 20 digits, also where arcs meet."""
    h = mp.mpf(10) ** -18
    return (point(s + h) - point(s - h)) / (2 * h)


def handles(point: Points, head: Number, last: int) -> list[tuple[Point, Number]]:
    """Point and speed of handles 0..last, the head's speed being 1."""
    s, here, along, speed = head, point(head), tangent(point, head), mp.mpf(1)
    found = [(here, speed)]
    for i in range(last):
        s = place_behind(point, s, mp.mpf(BODY_LINK if i else HEAD_LINK))
        there, next_along = point(s), tangent(point, s)
        bench = here - there
        # The distance of the handles stays: (v t - v' t') . bench = 0.
        speed *= (along * mp.conj(bench)).real / (next_along * mp.conj(bench)).real
        here, along = there, next_along
        found.append((here, speed))
    return found


def _text(value: Number) -> str:
    return str(mp.nstr(value, 18))


def entries(point: Points, head: Number, numbers: Sequence[int]) -> dict[str, Entry]:
    found = handles(point, head, max(numbers))
    return {
        str(i): (_text(found[i][0].real), _text(found[i][0].imag), _text(found[i][1])) for i in numbers
    }


def spiral_entries(t: int | str, numbers: Sequence[int] = HANDLES) -> dict[str, Entry]:
    with mp.workdps(DIGITS):
        return entries(spiral_walk("0.55", 32 * mp.pi), mp.mpf(t), numbers)


def turn_entries(t: int | str, numbers: Sequence[int] = HANDLES) -> dict[str, Entry]:
    with mp.workdps(DIGITS):
        return entries(turn_walk(), mp.mpf(t), numbers)


def turn_summary() -> dict[str, str | tuple[str, str]]:
    with mp.workdps(DIGITS):
        size = turn_sizes("1.7", "4.5", 2)
        plain = {name: _text(size[name]) for name in ("r1", "r2", "sweep", "length", "theta")}
        centres = {name: (_text(size[name].real), _text(size[name].imag)) for name in ("c1", "c2")}
        return {**plain, **centres}


if __name__ == "__main__":
    truth = {
        "spiral_in_055": {str(t): spiral_entries(t) for t in SPIRAL_TIMES},
        "two_arc": turn_summary(),
        "two_arc_motion": {str(t): turn_entries(t) for t in TURN_TIMES},
    }
    json.dump(truth, sys.stdout, indent=1)
