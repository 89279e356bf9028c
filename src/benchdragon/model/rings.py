"""Closed lines on the ground: how long they are, what they hold, which of their points is nearest.

A ring is a list of points, m, of which the last is the first.
"""

import math
from collections.abc import Sequence
from itertools import pairwise

from benchdragon.model.base_curve import Point

Ring = Sequence[Point]
# A corner that is so near to an end of a stretch, m, is none of its own.
NEAR = 1e-6
# Corners of a circle that stands for what is round.
ROUND = 64


def outermost(rings: Sequence[Ring]) -> list[Ring]:
    """Those of some rings that do not cross which lie within no other of them."""
    return [
        ring for ring in rings if not any(holds(other, ring[0]) for other in rings if other is not ring)
    ]


def length_of(ring: Ring) -> float:
    """How long a ring is, m."""
    return sum(math.dist(a, b) for a, b in pairwise(ring))


def area_of(ring: Ring) -> float:
    """The area within a ring, m2, whichever way it goes round."""
    (x, y), *_others = ring
    twice = [(ax - x) * (by - y) - (bx - x) * (ay - y) for (ax, ay), (bx, by) in pairwise(ring)]
    return 0.5 * abs(sum(twice))


def holds(ring: Ring, place: Point) -> bool:
    """Whether a place lies within a ring: to the right of it the ring passes an odd number of times."""
    x, y = place
    crossed = [
        (ax, ay)
        for (ax, ay), (bx, by) in pairwise(ring)
        if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax)
    ]
    return len(crossed) % 2 == 1


def nearest_on(ring: Ring, place: Point) -> tuple[float, float]:
    """How far a ring is from a place, m, and how far along the ring its nearest point is, m."""
    x, y = place
    nearest, found, passed = math.inf, 0.0, 0.0
    for (ax, ay), (bx, by) in pairwise(ring):
        way = math.hypot(bx - ax, by - ay)
        if way > 0.0:
            ahead = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / way
            along = min(max(ahead, 0.0), way)
            away = math.hypot(ax + along / way * (bx - ax) - x, ay + along / way * (by - ay) - y)
            if away < nearest:
                nearest, found = away, passed + along
        passed += way
    return nearest, found


def place_on(ring: Ring, along: float) -> Point:
    """The place so far along a ring, m."""
    left = along
    for (ax, ay), (bx, by) in pairwise(ring):
        way = math.hypot(bx - ax, by - ay)
        if 0.0 < way and left <= way:
            return (ax + left / way * (bx - ax), ay + left / way * (by - ay))
        left -= way
    return ring[-1]


def stretch(ring: Ring, begin: float, end: float) -> list[Point]:
    """The points of a ring from one way along it to another, m.

    Either may lie a whole round before the ring begins, or beyond its end.
    """
    whole, passed, corners = length_of(ring), 0.0, []
    for a, b in pairwise(ring):
        corners += [(passed + lap, a) for lap in (-whole, 0.0, whole)]
        passed += math.dist(a, b)
    inner = [a for along, a in sorted(corners) if begin + NEAR < along < end - NEAR]
    return [place_on(ring, begin % whole), *inner, place_on(ring, end % whole)]


def ring_of(outline: Sequence[Point]) -> list[Point]:
    """The ring of an outline's corners."""
    return [*outline, outline[0]]


def round_ring(centre: Point, radius: float) -> list[Point]:
    """A ring of ROUND corners about a circle: it holds all of that."""
    x, y = centre
    far = radius / math.cos(math.pi / ROUND)
    turns = [2.0 * math.pi * n / ROUND for n in range(ROUND)]
    found = [(x + far * math.cos(turn), y + far * math.sin(turn)) for turn in turns]
    return [*found, found[0]]


def opening(ring: Ring, place: Point, width: float) -> tuple[float, float] | None:
    """What an entrance so wide, m, opens of a ring: from one way along it to another, m.

    None of one farther from it than half its width, or wider than the ring is long.
    """
    away, along = nearest_on(ring, place)
    half = 0.5 * width
    return (along - half, along + half) if away <= half and width < length_of(ring) else None


def gate_in(ring: Ring, way: Sequence[Point], width: float) -> tuple[float, float] | None:
    """What a gate so wide, m, opens of a ring, as `opening`, where a way from outside crosses it."""
    if width >= length_of(ring) or holds(ring, way[0]):
        return None
    for here, there in pairwise(way):
        hits = _crossings(ring, here, there)
        if hits:
            _share, at = min(hits)
            return at - 0.5 * width, at + 0.5 * width
    return None


def between(ring: Ring, spans: Sequence[tuple[float, float]]) -> list[list[Point]]:
    """The lines of a ring between some spans of it, m."""
    whole, found = length_of(ring), []
    laid = sorted((begin % whole, begin % whole + end - begin) for begin, end in spans)
    reach = max((end for _begin, end in laid), default=0.0) - whole
    for begin, end in laid:
        if begin > reach:
            found.append(stretch(ring, reach, begin))
        reach = max(reach, end)
    return found


def _crossings(ring: Sequence[Point], here: Point, there: Point) -> list[tuple[float, float]]:
    """Where a segment meets a ring: as a share of the segment, and as the way along the ring, m."""
    found, passed = [], 0.0
    for one, other in pairwise(ring):
        side = math.dist(one, other)
        met = _met(here, there, one, other)
        found += [] if met is None else [(met[0], passed + met[1] * side)]
        passed += side
    return found


def _met(here: Point, there: Point, one: Point, other: Point) -> tuple[float, float] | None:
    """Where two segments meet, as shares of both; None where they do not."""
    ax, ay, bx, by = there[0] - here[0], there[1] - here[1], other[0] - one[0], other[1] - one[1]
    dx, dy, across = one[0] - here[0], one[1] - here[1], ax * by - ay * bx
    if across == 0.0:
        return None
    share, other_share = (dx * by - dy * bx) / across, (dx * ay - dy * ax) / across
    return (share, other_share) if 0.0 <= share <= 1.0 and 0.0 <= other_share <= 1.0 else None
