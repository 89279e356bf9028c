"""Which parts of a random dance on an inward spiral must be searched: a bound in closed form.

On r = b theta a point has the excess sigma = r - b phi, phi counted on from turn to turn: 0 on the
spiral, one pitch more for the same point seen from one turn farther in (kernels/spiral_bound.py). A
handle a metres outward of the spiral has the excess a, up to second order. Bounds on the excess of
benches follow from their handles; pair by pair they exclude that neighbouring turns come near each
other (design/imprecision.py shows how little is left to be searched).
"""

import math
from typing import NamedTuple

from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.curve import (
    CurveKind,
    FloatArray,
    RouteRow,
    curvature,
    parameter_at,
    place,
    spiral_length,
)
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.stray_line import offset_at

# Stretches into which a walk is divided, each bounded at once, are about so long, in shortest links.
STRETCH_LINKS = 2.5
# Beyond these the bound is not tried: angle between bench and route, rad; how far handles are off the
# route, in its radii of curvature; a link's way along it, in links.
MOST_BENCH_ANGLE, MOST_ASIDE, MOST_WAY = 0.9, 0.3, 1.5
# The length of route, in links of the whole dragon, on which a straying line is known behind its head.
WAYS = 1.1
# Table of a line that strays, m; how much steeper it may be between; how far it is from what is
# tabulated, across and along, m.
GRID, STEEPER, LINE_ACROSS, LINE_ALONG = 0.25, 1.02, 1e-5, 0.1
# Entries of a table of the route's radius lie at most so far apart, m.
RADII_APART = 0.5
# Stretches are searched together whose open benches differ by this factor at most.
ALIKE = 1.3
# Allowance for rounding, m and rad.
SPARE_LENGTH, SPARE_ANGLE = 1e-6, 1e-3


class BoundFact(Numbered):
    """Numbers of a bound, a row of floats."""

    B = 0  # pitch / 2 pi, m
    FIRST = 1  # head positions, m
    LAST = 2
    OUTWARD = 3  # +1 where left is outward, else -1
    LOW = 4  # route position of the first radius, m
    GRID_LOW = 5  # and of the first entry of the line's table
    MOST = 6  # how far any handle is off the route, m
    MOST_STRAY = 7  # and the line alone
    SLOPE = 8  # of the line, at most
    SLACK = 9  # angle between polar angles of two benches and of their handles, rad


FACTS = len(BoundFact)


class Bound(NamedTuple):
    """Bounds on benches beside an inward spiral while the head walks; offsets outward."""

    facts: Vector
    radius: Vector  # of the route, about the spiral's centre, m
    stray: Vector  # of the line, outward, m; none if it does not stray
    more: Vector  # how much farther out it may lie than one turn farther out, m
    aside: Vector  # of handles, outward, m
    apart: Vector  # of a bench's handles, across, at most, m
    ways: Vector  # of a link along the route, at most, m
    nearest: Vector  # of a handle behind the head along the route, m
    farthest: Vector
    ahead: Vector  # polar angles of a bench's points off its front handle, rad
    behind: Vector  # and off its rear one
    out: Vector  # excess of a bench in a stretch, m
    dip: Vector
    low: Vector  # radius of a handle in a stretch, m
    high: Vector


@kernel
def bounds(rows: FloatArray, benches: int) -> bool:
    """Whether a route is a single inward spiral, with benches enough to touch."""
    return (
        rows.shape[0] == 1
        and rows[0, RouteRow.KIND] == CurveKind.SPIRAL
        and rows[0, RouteRow.U_END] < rows[0, RouteRow.U_START]
        and benches > 2
    )


@kernel
def table_sizes(first: float, last: float, links: float) -> tuple[int, int]:
    """Entries of the tables of radii and of a line that strays, with a dragon that is so long, m."""
    radii = 2 + int((last - first + MOST_WAY * links + 1.0) / RADII_APART)
    return radii, math.ceil((last - first + WAYS * links + LINE_ALONG) / GRID)


@kernel
def stretch_count(first: float, last: float, shortest: float) -> int:
    """Into how many stretches a walk is divided."""
    return max(1, int((last - first) / (STRETCH_LINKS * shortest)))


@kernel
def greatest_size(values: FloatArray) -> float:
    """The greatest of sizes."""
    most = 0.0
    for n in range(values.shape[0]):
        most = max(most, abs(values[n]))
    return most


@kernel
def radius_at(bound: Bound, s: float) -> float:
    """The route's radius at s, m, from the table."""
    radius, last = bound.radius, bound.radius.shape[0] - 1
    at = (
        (s - bound.facts[BoundFact.LOW])
        * last
        / (bound.facts[BoundFact.LAST] - bound.facts[BoundFact.LOW])
    )
    n = min(max(int(at), 0), last - 1)
    return radius[n] + min(max(at - n, 0.0), 1.0) * (radius[n + 1] - radius[n])


@kernel
def prepare(
    bound: Bound, rows: FloatArray, links: FloatArray, sizes: FloatArray, aside: FloatArray,
    noise: FloatArray, stray: float, first: float, last: float,
) -> bool:  # fmt: skip
    """Fill a bound for the head's way from first to last; whether it holds, as where benches follow."""
    facts, whole = bound.facts, 0.0
    for i in range(links.shape[0]):
        whole += links[i]
    facts[BoundFact.B], facts[BoundFact.FIRST], facts[BoundFact.LAST] = rows[0, RouteRow.P], first, last
    facts[BoundFact.LOW] = first - MOST_WAY * whole - 1.0
    facts[BoundFact.GRID_LOW] = first - WAYS * whole - LINE_ALONG
    u = parameter_at(rows, 0, last)
    x, y, tx, ty = place(rows, 0, u)
    facts[BoundFact.OUTWARD] = math.copysign(
        1.0, (y - rows[0, RouteRow.Y]) * tx - (x - rows[0, RouteRow.X]) * ty
    )
    above = tabulate(bound, rows, noise, stray)
    for i in range(bound.aside.shape[0]):
        bound.aside[i] = facts[BoundFact.OUTWARD] * aside[i] if aside.shape[0] else 0.0
    facts[BoundFact.MOST] = greatest_size(bound.aside) + facts[BoundFact.MOST_STRAY] + above
    if not follow(bound, rows, links, abs(curvature(rows, 0, u))):
        return False
    spread(bound, links, sizes)
    compare_turns(bound)
    return True


@kernel
def tabulate(bound: Bound, rows: FloatArray, noise: FloatArray, stray: float) -> float:
    """Fill the tables of radii and of the line; by how much the radius lies above its, at most, m."""
    facts, radius, table = bound.facts, bound.radius, bound.stray
    low, last, steepest = facts[BoundFact.LOW], radius.shape[0] - 1, 0.0
    for n in range(last + 1):
        u = parameter_at(rows, 0, low + (facts[BoundFact.LAST] - low) * n / last)
        radius[n] = facts[BoundFact.B] * u
    for n in range(table.shape[0]):
        value, slope = offset_at(noise, facts[BoundFact.LAST] - (facts[BoundFact.GRID_LOW] + n * GRID))
        table[n], steepest = facts[BoundFact.OUTWARD] * stray * value, max(steepest, abs(stray * slope))
    facts[BoundFact.SLOPE], facts[BoundFact.MOST_STRAY] = STEEPER * steepest, 0.0
    if table.shape[0]:
        facts[BoundFact.MOST_STRAY] = greatest_size(table) + facts[BoundFact.SLOPE] * GRID + LINE_ACROSS
    # Between entries the radius lies above the line: its second derivative is at most b^2 / r^3.
    return 0.125 * RADII_APART**2 * facts[BoundFact.B] ** 2 / max(radius[last], SPARE_LENGTH) ** 3


@kernel
def follow(bound: Bound, rows: FloatArray, links: FloatArray, bend: float) -> bool:
    """Whether all benches surely follow; bounds on the way along the route to each handle.

    The chord of a curve beside the route and the step aside to the next handle are sides of the
    triangle whose third is the link; the angle between them is nearly right. `bend`: the greatest, 1/m.
    """
    facts, aside, nearest, farthest = bound.facts, bound.aside, bound.nearest, bound.farthest
    most, slope, count = facts[BoundFact.MOST], facts[BoundFact.SLOPE], links.shape[0]
    if most * bend > MOST_ASIDE:
        return False
    roughly, whole, sound = 0.0, 0.0, True
    nearest[0] = farthest[0] = 0.0
    for i in range(count):
        link = links[i]
        apart = abs(aside[i + 1] - aside[i]) + slope * MOST_WAY * link
        u = parameter_at(rows, 0, facts[BoundFact.LAST] - roughly / (1.0 + most * bend))
        local = abs(curvature(rows, 0, u))
        angle = 0.5 * local / (1.0 - most * local) * MOST_WAY * link
        chord = 1.0 - angle**2 / 6.0  # of an arc, at least
        longest = apart * angle + math.hypot(link, apart * angle)
        shortest = math.sqrt(max(link**2 - apart**2, 0.0)) - apart * angle
        off = abs(aside[i]) + facts[BoundFact.MOST_STRAY]
        bound.apart[i] = apart
        bound.ways[i] = longest / (max(chord, SPARE_LENGTH) * (1.0 - off * local))
        nearest[i + 1] = nearest[i] + shortest / (1.0 + off * local)
        farthest[i + 1] = farthest[i] + bound.ways[i]
        sound = sound and bound.ways[i] < MOST_WAY * link and angle + apart / link < MOST_BENCH_ANGLE
        roughly, whole = roughly + link - apart, whole + link
    return sound and not (bound.stray.shape[0] and farthest[count] > WAYS * whole)


@kernel
def polar(size: float, radius: float, off: float) -> float:
    """A bound of how far polar angles of points so far from a handle, m, are from its own, rad."""
    return (math.asin(size / radius) if size < radius else math.pi) + off / radius**2 + SPARE_ANGLE


@kernel
def spread(bound: Bound, links: FloatArray, sizes: FloatArray) -> None:
    """Fill how far the polar angles of points of a bench are off its handles."""
    facts, most, body = bound.facts, bound.facts[BoundFact.MOST], 0.0
    off = most * facts[BoundFact.B]
    for i in range(links.shape[0]):
        radius = max(radius_at(bound, facts[BoundFact.LAST] - bound.nearest[i]) - most, SPARE_LENGTH)
        half, front, rear = 0.5 * sizes[1, i], sizes[2, i], sizes[3, i]
        body = max(body, polar(math.hypot(links[i] + max(front, rear), half), radius, off))
        bound.ahead[i] = polar(math.hypot(front, half), radius, off)
        bound.behind[i] = polar(math.hypot(rear, half), radius, off)
    facts[BoundFact.SLACK] = 2.0 * body


@kernel
def compare_turns(bound: Bound) -> None:
    """Fill by how much the line may lie farther out than one turn farther out."""
    facts, stray, b, count = bound.facts, bound.stray, bound.facts[BoundFact.B], bound.stray.shape[0]
    if count == 0:
        return
    turn = 2.0 * math.pi
    widest = max(radius_at(bound, facts[BoundFact.GRID_LOW]), 0.0)
    near = 2 + int((facts[BoundFact.SLACK] * (widest + 2.0 * turn * b) + 2.0 * LINE_ALONG) / GRID)
    for n in range(count):
        theta = radius_at(bound, facts[BoundFact.GRID_LOW] + n * GRID) / b
        outer = n - (spiral_length(b, theta + turn) - spiral_length(b, theta)) / GRID
        middle, lowest = int(max(outer, 0.0)), math.inf
        for m in range(max(middle - near, 0), min(middle + near, count - 1) + 1):
            lowest = min(lowest, stray[m])
        bound.more[n] = stray[n] - lowest + 2.0 * facts[BoundFact.SLOPE] * GRID


@kernel
def fill_excess(bound: Bound, links: FloatArray, sizes: FloatArray, first: float, last: float) -> float:
    """Fill the greatest and least excess of benches in a stretch; the least radius of any, m, or 0.

    At distance t from the foot of the centre on the line of two handles, p from the centre, the
    excess has the second derivative p^2 / r^3 + 2 b p t / r^4: positive, at most 1 / p + b / p^2.
    """
    facts, b, most, edge = bound.facts, bound.facts[BoundFact.B], bound.facts[BoundFact.MOST], math.inf
    for i in range(links.shape[0] + 1):
        bound.low[i] = radius_at(bound, last - bound.nearest[i]) - most
        bound.high[i] = radius_at(bound, first - bound.farthest[i]) + most
    for i in range(links.shape[0]):
        link, width, front, rear = links[i], sizes[1, i], sizes[2, i], sizes[3, i]
        low, way, longer = bound.low[i], bound.ways[i], max(front, rear)
        # From the middle of the handles to the foot, and from there to the farther handle, at most.
        apart = b * way / max(low, SPARE_LENGTH) + bound.apart[i] + SPARE_LENGTH
        far = apart * bound.high[i + 1] / link + 0.5 * link
        foot = math.sqrt(max(low**2 - far**2, 0.0))
        p = foot - 0.5 * width
        if p <= 0.0 or foot * foot <= 2.0 * b * (far + longer):
            return 0.0
        edge = min(edge, p)
        bend, gradient = 1.0 / p + b / p**2, math.hypot(1.0, b / p)
        at, after = bound.aside[i], bound.aside[i + 1]
        tilt, steep = (at - after) / link, facts[BoundFact.SLOPE] * way / link
        rest = 0.5 * width * gradient + longer * steep + SPARE_LENGTH
        rest += most * (gradient - 1.0 + facts[BoundFact.SLOPE] ** 2) + 0.5 * most**2 * bend
        ahead = max(front * tilt + 0.5 * bend * front * (link + front), 0.0)
        behind = max(-rear * tilt + 0.5 * bend * rear * (link + rear), 0.0)
        dip = min(at, after) - 0.125 * bend * link**2
        bound.out[i] = max(at + ahead, after + behind) + rest
        bound.dip[i] = min(dip, at + front * tilt, after - rear * tilt) - rest
    return edge


@kernel
def add_strays(bound: Bound, first: float, last: float) -> None:
    """Add how much farther out the line may lie under each bench than one turn farther out, m."""
    more, end, low = bound.more, bound.more.shape[0] - 1, bound.facts[BoundFact.GRID_LOW]
    if end < 0:
        return
    for i in range(bound.out.shape[0]):
        begin = min(max(int((first - bound.farthest[i + 1] - low) / GRID) - 1, 0), end)
        stop, most = (last - bound.nearest[i] - low) / GRID + 2.0, -math.inf
        for n in range(begin, min(max(int(stop), begin), end) + 1):
            most = max(most, more[n])
        bound.out[i] += most


@kernel
def is_shut(bound: Bound, room: float) -> bool:
    """Whether benches on one turn, or two turns apart, keep apart in a stretch."""
    nearest, count, b = bound.nearest, bound.out.shape[0], bound.facts[BoundFact.B]
    most, least = bound.out[0], bound.dip[0]
    for i in range(count):
        most, least = max(most, bound.out[i]), min(least, bound.dip[i])
        if i < count - 2:
            # The polar angle of the link between, against what both reach towards each other.
            between = (nearest[i + 2] - nearest[i + 1]) / (bound.high[i + 2] + b)
            if not between > bound.behind[i] + bound.ahead[i + 2]:
                return False
    return most - least + room < 4.0 * math.pi * b


@kernel
def open_benches(
    bound: Bound, links: FloatArray, sizes: FloatArray, start: float, end: float, wanted: float
) -> int:
    """The number of benches from the head that hold all pairs that may come near in a stretch."""
    count, b, slack = links.shape[0], bound.facts[BoundFact.B], bound.facts[BoundFact.SLACK]
    edge = fill_excess(bound, links, sizes, start - LINE_ALONG, end + LINE_ALONG)
    if not edge > 0.0:
        return count
    add_strays(bound, start - LINE_ALONG, end + LINE_ALONG)
    room, pitch = wanted * math.hypot(1.0, b / edge) + SPARE_LENGTH, 2.0 * math.pi * b
    if not is_shut(bound, room):
        return count
    found, nearest, farthest = 0, bound.nearest, bound.farthest
    for i in range(count - 2):
        # One turn farther out: so far along the route at least, and at most.
        most = (2.0 * math.pi + slack) * (bound.high[i + 1] + (1.0 + slack) * pitch + b)
        least, reach = (2.0 * math.pi - slack) * bound.low[i + 1], bound.out[i] + room - pitch
        for j in range(i + 2, count):
            if nearest[j] - nearest[i + 1] > most:
                break
            if j >= found and farthest[j] - farthest[i + 1] >= least and reach >= bound.dip[j]:
                found = j + 1
    return found


@kernel
def fill_parts(bound: Bound, links: FloatArray, sizes: FloatArray, wanted: float, parts: Table) -> int:
    """Fill the parts of the head's way that must be searched: from, to, m, and the first benches.

    Outside them no two non-adjacent benches come as near as `wanted`, m. As many rows as stretches.
    """
    first, last, count = bound.facts[BoundFact.FIRST], bound.facts[BoundFact.LAST], parts.shape[0]
    found, end = 0, first
    for n in range(count):
        start, end = end, first + (last - first) * (n + 1) / count
        benches = open_benches(bound, links, sizes, start, end, wanted)
        if benches == 0:
            continue
        before = parts[found - 1, 2] if found and parts[found - 1, 1] == start else 0.0
        if before and max(benches, before) <= ALIKE * min(benches, before):
            parts[found - 1, 1], parts[found - 1, 2] = end, max(benches, before)
        else:
            parts[found, 0], parts[found, 1], parts[found, 2] = start, end, benches
            found += 1
    return found
