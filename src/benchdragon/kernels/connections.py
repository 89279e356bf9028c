"""Shortest connections of two poses by arcs of one radius and lines, and programmes joined by them.

The shortest way from one pose to another whose curvature never exceeds 1 / radius is one of six kinds
(L. E. Dubins, 1957): arc, line, arc (LSL, RSR, LSR, RSL) or three arcs (LRL, RLR). Parts are rows as of
route_parts.py; none of them is a clothoid.
"""

import math

import numpy as np

from benchdragon.kernels import route_parts
from benchdragon.kernels.arrays import Table
from benchdragon.kernels.curve import COLUMNS, CurveKind, FloatArray, RouteRow
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import evaluate
from benchdragon.kernels.route_parts import (
    Pose,
    RoutePart,
    lay_rows,
    move_parts,
    part_end,
    part_start,
    put_part,
)


class JoiningWay(Numbered):
    """A way, one row of a table.

    The hands of its arcs, +1 to the left, 0 of a line; the sweeps of its arcs, rad, left positive, or
    the length of its line, m; and the whole length, m.
    """

    HANDS = 0
    SIZES = 3
    WHOLE = 6


WAY_COLUMNS = JoiningWay.WHOLE + 1
PIECES = 3
MOST_WAYS = 8


class ProgrammeStep(Numbered):
    """A step of a programme, one row.

    How many parts its formation has, where its centre lies, m (NaN: it begins where the one before it
    ends), and by how much it is turned, rad.
    """

    COUNT, X, Y, TURNED = range(4)


STEP_COLUMNS = len(ProgrammeStep)

# Sweeps, rad, this near to a full turn are 0 up to rounding; so are lines as short as this, m.
SWEEP_ROUNDING = 1e-13
# Crossings are found on polylines of chords about so long, m, and of so many at most.
CHORD, LEAST_CHORDS, MOST_CHORDS = 0.25, 8, 4000
# Chords of a polyline that one box bounds.
RUN = 32
FULL = 2.0 * math.pi


@kernel
def sweep_to(side: float, start: float, end: float) -> float:
    """From one heading to another turning to one side, rad."""
    sweep = (side * (end - start)) % FULL
    return 0.0 if sweep > FULL - SWEEP_ROUNDING * (1.0 + abs(start) + abs(end)) else side * sweep


@kernel
def between_circles(
    start: Pose, end: Pose, radius: float, first: float, last: float
) -> tuple[float, float]:
    """Between the centres of circles through two poses, m, and the heading from one to the other."""
    one, two = first * radius, last * radius
    x = (end.x - two * math.sin(end.heading)) - (start.x - one * math.sin(start.heading))
    y = (end.y + two * math.cos(end.heading)) - (start.y + one * math.cos(start.heading))
    return math.hypot(x, y), math.atan2(y, x)


@kernel
def set_way(
    ways: FloatArray, n: int, hands: tuple[float, float, float], sizes: tuple[float, float, float],
    radius: float,
) -> None:  # fmt: skip
    """Put a way among the n before it, the shortest first; of those as long the one that came first."""
    whole = 0.0
    for k in range(PIECES):
        length = abs(sizes[k]) * (radius if hands[k] != 0.0 else 1.0)
        whole += length if length > SWEEP_ROUNDING else 0.0
    while n > 0 and ways[n - 1, JoiningWay.WHOLE] > whole * route_parts.EQUAL:
        for column in range(WAY_COLUMNS):
            ways[n, column] = ways[n - 1, column]
        n -= 1
    for k in range(PIECES):
        ways[n, JoiningWay.HANDS + k], ways[n, JoiningWay.SIZES + k] = hands[k], sizes[k]
    ways[n, JoiningWay.WHOLE] = whole


@entry
def connections(start: Pose, end: Pose, radius: float, ways: Table) -> int:
    """Fill `ways`, (MOST_WAYS, WAY_COLUMNS), with those of all six kinds, shortest first: how many."""
    n, a, b = 0, start.heading, end.heading
    for first in (1.0, -1.0):
        for last in (1.0, -1.0):
            apart, toward = between_circles(start, end, radius, first, last)
            square = apart * apart - (0.0 if first == last else 4.0 * radius * radius)
            if square < 0.0:
                continue
            line = math.sqrt(square)
            heading = toward + (0.0 if first == last else first * math.atan2(2.0 * radius, line))
            if apart < SWEEP_ROUNDING * radius:
                heading = a  # one circle: no line, and no heading of it
            sizes = sweep_to(first, a, heading), line, sweep_to(last, heading, b)
            set_way(ways, n, (first, 0.0, last), sizes, radius)
            n += 1
    for side in (1.0, -1.0):
        apart, toward = between_circles(start, end, radius, side, side)
        square = 16.0 * radius * radius - apart * apart
        if square < 0.0:
            continue
        for hand in (1.0, -1.0):
            slant = hand * math.atan2(math.sqrt(square), apart)
            # Headings where the first arc meets the second, and the second the third.
            one = toward + slant + side * 0.5 * math.pi
            two = toward + math.pi - slant + side * 0.5 * math.pi
            sizes = sweep_to(side, a, one), sweep_to(-side, one, two), sweep_to(side, two, b)
            set_way(ways, n, (side, -side, side), sizes, radius)
            n += 1
    return n


@entry
@allocates
def way_parts(start: Pose, ways: Table, n: int, radius: float, parts: Table) -> int:
    """Fill `parts`, (PIECES, PART_COLUMNS), with the pieces of way n that have a length: how many."""
    row, pose, count = np.empty((1, COLUMNS)), start, 0
    for k in range(PIECES):
        size, arc = ways[n, JoiningWay.SIZES + k], ways[n, JoiningWay.HANDS + k] != 0.0
        if abs(size) * (radius if arc else 1.0) > SWEEP_ROUNDING:
            parts[count] = 0.0
            parts[count, RoutePart.KIND] = CurveKind.ARC if arc else CurveKind.LINE
            parts[count, RoutePart.SIZE] = radius if arc else size
            parts[count, RoutePart.FIRST] = size if arc else 0.0
            pose = put_part(parts, count, pose, row)
            count += 1
    return count


@kernel
@allocates
def polyline(parts: FloatArray, points: FloatArray) -> int:
    """Fill `points`, (n, 2), m, with points along parts, MOST_CHORDS + 1 at most; returns how many."""
    rows = np.empty((parts.shape[0], COLUMNS))
    lay_rows(parts, Pose(0.0, 0.0, 0.0), 0, 0, rows)
    length = rows[-1, RouteRow.S_START] + rows[-1, RouteRow.LENGTH]
    count = min(MOST_CHORDS, max(LEAST_CHORDS, math.ceil(length / CHORD)))
    s, found = np.empty(count + 1), np.empty((count + 1, 4))
    for n in range(count):
        s[n] = n * (length / count)
    s[count] = length
    evaluate(rows, s, found)
    for n in range(count + 1):
        points[n, 0], points[n, 1] = found[n, 0], found[n, 1]
    return count + 1


@kernel
def runs_meet(one: FloatArray, i: int, other: FloatArray, j: int) -> bool:
    """Whether the boxes of RUN chords of two polylines meet, from the points i and j on."""
    for k in range(2):
        low, high, their_low, their_high = math.inf, -math.inf, math.inf, -math.inf
        for n in range(i, min(i + RUN + 1, one.shape[0])):
            low, high = min(low, one[n, k]), max(high, one[n, k])
        for n in range(j, min(j + RUN + 1, other.shape[0])):
            their_low, their_high = min(their_low, other[n, k]), max(their_high, other[n, k])
        if low > their_high or their_low > high:
            return False
    return True


@kernel
def parted(one: FloatArray, i: int, other: FloatArray, j: int) -> bool:
    """Whether the ends of chord j lie on different sides of the line through chord i."""
    x, y = one[i, 0], one[i, 1]
    dx, dy = one[i + 1, 0] - x, one[i + 1, 1] - y
    before = dx * (other[j, 1] - y) - dy * (other[j, 0] - x)
    return before * (dx * (other[j + 1, 1] - y) - dy * (other[j + 1, 0] - x)) < 0.0


@kernel
def crossings(one: FloatArray, other: FloatArray) -> int:
    """How many chords of two polylines, (n, 2) and (m, 2), m, cross each other."""
    count, most, their_most = 0, one.shape[0] - 1, other.shape[0] - 1
    for a in range(0, most, RUN):
        for b in range(0, their_most, RUN):
            if runs_meet(one, a, other, b):
                for i in range(a, min(a + RUN, most)):
                    for j in range(b, min(b + RUN, their_most)):
                        if parted(one, i, other, j) and parted(other, j, one, i):
                            count += 1
    return count


@kernel
@allocates
def fitting_way(before: FloatArray, after: FloatArray, radius: float, way: FloatArray) -> int:
    """Fill `way` with the pieces of the connection that crosses two routes least often: how many.

    Of several connections it is the shortest.
    """
    ways, row = np.empty((MOST_WAYS, WAY_COLUMNS)), np.empty((1, COLUMNS))
    start = part_end(before, before.shape[0] - 1, row)
    count = connections(start, part_start(after, 0, row), radius, ways)
    one, other = np.empty((MOST_CHORDS + 1, 2)), np.empty((MOST_CHORDS + 1, 2))
    ones, others, own = polyline(before, one), polyline(after, other), np.empty((MOST_CHORDS + 1, 2))
    best, least = 0, -1
    for n in range(count):
        pieces, crossed = way_parts(start, ways, n, radius, way), 0
        if pieces:
            inner = own[1 : polyline(way[:pieces], own) - 1]  # at its ends it touches them
            crossed = crossings(inner, one[:ones]) + crossings(inner, other[:others])
        if least < 0 or crossed < least:
            best, least = n, crossed
    return way_parts(start, ways, best, radius, way)


@kernel
def add_parts(out: FloatArray, count: int, parts: FloatArray) -> int:
    """Add parts to those there are; returns how many there are then."""
    for i in range(parts.shape[0]):
        for column in range(route_parts.PART_COLUMNS):
            out[count + i, column] = parts[i, column]
    return count + parts.shape[0]


@entry
@allocates
def programme(parts: Table, steps: Table, radius: float, out: Table) -> int:
    """Fill `out` with formations one after another and their connections; returns the number of parts.

    `parts` are those of all formations as they are about the origin; they are moved. `out` has room for
    them, and for PIECES more a step.
    """
    row, way = np.empty((1, COLUMNS)), np.empty((PIECES, route_parts.PART_COLUMNS))
    before, begin, count = 0, 0, 0
    for k in range(steps.shape[0]):
        end = begin + int(steps[k, ProgrammeStep.COUNT])
        if math.isnan(steps[k, ProgrammeStep.X]):
            pose = part_end(parts, begin - 1, row)
            for i in range(begin, end):
                pose = put_part(parts, i, pose, row)
        else:
            there = parts[begin:end]
            move_parts(
                there,
                steps[k, ProgrammeStep.TURNED],
                steps[k, ProgrammeStep.X],
                steps[k, ProgrammeStep.Y],
            )
            if k:
                pieces = fitting_way(parts[before:begin], there, radius, way)
                count = add_parts(out, count, way[:pieces])
        count = add_parts(out, count, parts[begin:end])
        before, begin = begin, end
    pose = part_end(out, 0, row)
    for i in range(1, count):
        pose = put_part(out, i, pose, row)
    return count
