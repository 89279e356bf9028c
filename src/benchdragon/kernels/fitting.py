"""A route along drawn points: through them by clothoids, or corners rounded; and its deviation.

Parts are rows as of route_parts.py. The bounds are derived in docs/en/drawn.md.
"""

import math

import numpy as np

from benchdragon.kernels import route_parts
from benchdragon.kernels.angles import NEAREST
from benchdragon.kernels.arrays import Table
from benchdragon.kernels.curve import COLUMNS, CurveKind, FloatArray, RouteRow, clothoid_chord
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import IntArray, evaluate
from benchdragon.kernels.route_parts import Pose, RoutePart, lay_rows, part_end, row_count
from benchdragon.kernels.status import FitStatus, Smoothing

# Newton's method for the shape of a clothoid: 4 steps are usual; half steps where it would overshoot.
MOST_NEWTON_STEPS = 60
# The remaining ordinate of the end, as a share of the chord, at which it stops, and that is accepted.
CLOSE, CLOSED = 1e-14, 1e-12
# A clothoid is this many times longer than its chord at most; one that doubles back is longer.
LEAST_SHARE = 1e-3
# Headings that are off their chord by less, rad, are those of a line.
STRAIGHT_HEADING = 1e-12
# Nodes of the quadrature over one clothoid, which turns by some 10 rad at most.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(40)
FITTING_NODES = 0.5 * (1.0 + _NODES)
FITTING_WEIGHTS = 0.5 * _WEIGHTS
# A point of a clothoid lies within this of its exact place, as a share of its length: rounding.
CLOTHOID_ROUNDING = 1e-13
# Steps at which a curve is compared with its chord; a bound of what lies between them is added.
CURVE_STEPS = 64

# Shares of the deviation that leaving out points may take; bends take the rest. All are tried.
SHARES = (0.0, 0.125, 0.25, 0.5, 0.75)
# Places are computed to within this, m, a metre of coordinates: it is added to bounds.
PLACE_ROUNDING = 1e-14
# Share of the deviation that sums of shares of it may lose.
SLACK = 1e-9
# Share of a corner that clothoids turn; the arc between them turns the rest.
EASED_SHARE = 0.5
# A corner that turns by less than this, rad, is straight; by more, a hairpin that no bend rounds.
LEAST_TURN, MOST_CORNER = 1e-12, math.pi - 1e-6
# A line between two bends that is shorter than this, m, is left out.
LEAST_LINE = 1e-10
# The widest bend, m: wider ones are as good as straight, and circles over 1e8 m are not allowed.
MOST_RADIUS = 1e6
# Share of the first and of the last side of an open line that stays straight.
STRAIGHT_END = 0.1


class PolylineSide(Numbered):
    """A side of a polyline and the corner at its end, one row.

    Its start, m; its length, m, and heading, rad; the angle by which the corner turns, rad; of a bend
    of radius 1 m there, how far before the corner it begins, its distance from the corner, and the
    angle by which each of its clothoids turns, rad; the side's distance from the drawing, m; the radius
    of the bend, infinite where the corner does not turn.
    """

    X, Y, LENGTH, HEADING, TURN, TANGENT, REACH, EASED, STRAY, RADIUS = range(10)


SIDE_COLUMNS = len(PolylineSide)


@kernel
def folded(angle: float) -> float:
    """An angle, rad, folded into -pi..pi."""
    return angle - 2.0 * math.pi * ((angle / (2.0 * math.pi) + NEAREST) - NEAREST)


@kernel
def integrals(a: float, change: float, phi0: float) -> tuple[float, float, float]:
    """Integrals along a chord: of the heading's sine, the slope of that by a, and of its cosine.

    The heading is a (t^2 - t) + change t + phi0 for t from 0 to 1.
    """
    sine, slope, cosine = 0.0, 0.0, 0.0
    for n in range(FITTING_NODES.shape[0]):
        t, weight = FITTING_NODES[n], FITTING_WEIGHTS[n]
        bend = t * t - t
        heading = a * bend + change * t + phi0
        c = weight * math.cos(heading)
        sine += weight * math.sin(heading)
        slope += c * bend
        cosine += c
    return sine, slope, cosine


@kernel
def set_clothoid(poses: FloatArray, n: int, parts: FloatArray) -> FitStatus:
    """Let part n lead from pose n (x, y, heading) to the next: a clothoid, or a line.

    Of the many that meet both poses it is the one that winds least (Bertolazzi and Frego, G1 fitting
    with clothoids, 2015): with phi0 and phi1 the headings from the chord, the heading along it is
    A t^2 + (phi1 - phi0 - A) t + phi0 for t from 0 to 1, and the integral of its sine is 0.
    """
    dx, dy = poses[n + 1, 0] - poses[n, 0], poses[n + 1, 1] - poses[n, 1]
    chord, along = math.hypot(dx, dy), math.atan2(dy, dx)
    if not chord > 0.0:
        return FitStatus.ONE_PLACE
    phi0, phi1 = folded(poses[n, 2] - along), folded(poses[n + 1, 2] - along)
    change, a = phi1 - phi0, 3.0 * (phi0 + phi1)
    left, slope, share = integrals(a, change, phi0)
    for _step in range(MOST_NEWTON_STEPS):
        if abs(left) <= CLOSE:
            break
        move, before = -left / (slope if slope != 0.0 else 1.0), left
        for _half in range(MOST_NEWTON_STEPS):
            left, slope, share = integrals(a + move, change, phi0)
            if abs(left) <= abs(before):
                break
            move *= 0.5
        a += move
    if abs(left) > CLOSED or share < LEAST_SHARE:
        return FitStatus.DOUBLES_BACK
    straight = max(abs(phi0), abs(phi1)) <= STRAIGHT_HEADING
    kind, length = CurveKind.LINE if straight else CurveKind.CLOTHOID, chord / share
    add(parts, n, kind, length, poses[n, 0], poses[n, 1], poses[n, 2])
    if not straight:
        parts[n, RoutePart.FIRST] = (change - a) / length
        parts[n, RoutePart.LAST] = (change + a) / length
    return FitStatus.OK


@kernel
def add(
    parts: FloatArray, n: int, kind: float, size: float, x: float, y: float, heading: float
) -> None:
    """Let part n be of a kind and a size, m, and begin in a pose."""
    parts[n] = 0.0
    parts[n, RoutePart.KIND], parts[n, RoutePart.SIZE] = kind, size
    parts[n, RoutePart.X], parts[n, RoutePart.Y] = x, y
    parts[n, RoutePart.ANGLE] = heading


@entry
def g1_clothoids(poses: Table, parts: Table) -> tuple[FitStatus, int]:
    """Fill `parts` with a clothoid from each pose (x, y, heading) to the next; the status, and where.

    A clothoid that is straight is a line.
    """
    for n in range(poses.shape[0] - 1):
        status = set_clothoid(poses, n, parts)
        if status != FitStatus.OK:
            return status, n
    return FitStatus.OK, 0


@kernel
def toward(points: FloatArray, a: int, b: int) -> float:
    """The heading from one point of a ring to another, rad."""
    i, j = a % points.shape[0], b % points.shape[0]
    return math.atan2(points[j, 1] - points[i, 1], points[j, 0] - points[i, 0])


@kernel
def set_headings(points: FloatArray, closed: bool, poses: FloatArray) -> None:
    """Fill in the heading at each point, rad: that of the circle through it and both its neighbours.

    At the ends of an open line it is that of the circle of the point beside it.
    """
    last = points.shape[0] - 1
    for n in range(0 if closed else 1, last + 1 if closed else last):
        along, ahead = toward(points, n - 1, n), toward(points, n, n + 1)
        poses[n, 2] = along
        # The angle between a chord and the tangent at its end is the one at the far point over it.
        if abs(folded(ahead - along)) < math.pi:
            poses[n, 2] += folded(ahead - toward(points, n - 1, n + 1))
    if closed:
        poses[last + 1, 2] = poses[0, 2]
    else:
        first, end = toward(points, 0, 1), toward(points, last - 1, last)
        poses[0, 2] = 2.0 * first - poses[1, 2] if last > 1 else first
        poses[last, 2] = 2.0 * end - poses[last - 1, 2] if last > 1 else end


@kernel
@allocates
def bound_to_chord(parts: FloatArray) -> float:
    """A bound on how far one part and the chord between its ends lie from each other, either way, m.

    Between two places h metres apart the curve keeps within k h^2 / 8 of its own chord, if its
    curvature is at most k, and on that chord the distance from a segment is greatest at an end. And
    since the curve leads from one end of the segment to the other, some point of it stands abreast
    of each point of the segment.
    """
    rows = np.zeros((row_count(parts), COLUMNS))
    lay_rows(parts, Pose(0.0, 0.0, 0.0), 0, 0, rows)
    length = rows[-1, RouteRow.S_START] + rows[-1, RouteRow.LENGTH]
    s, found = np.empty(CURVE_STEPS + 1), np.empty((CURVE_STEPS + 1, 4))
    for n in range(CURVE_STEPS):
        s[n] = n * (length / CURVE_STEPS)
    s[CURVE_STEPS] = length
    evaluate(rows, s, found)
    worst = 0.0
    for n in range(CURVE_STEPS + 1):
        worst = max(worst, off_segment(found, n, 0, CURVE_STEPS))
    bend = max(abs(found[0, 3]), abs(found[CURVE_STEPS, 3]))
    return worst + 0.125 * bend * (length / CURVE_STEPS) ** 2 + CLOTHOID_ROUNDING * length


@kernel
def off_segment(points: FloatArray, n: int, a: int, b: int) -> float:
    """The distance of point n from the segment between points a and b of a ring, m."""
    i, j = a % points.shape[0], b % points.shape[0]
    dx, dy = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1]
    x, y = points[n, 0] - points[i, 0], points[n, 1] - points[i, 1]
    size, along = dx * dx + dy * dy, x * dx + y * dy
    if along <= 0.0:
        return math.hypot(x, y)
    return math.hypot(x - dx, y - dy) if along >= size else abs(x * dy - y * dx) / math.sqrt(size)


@kernel
@allocates
def through_points(
    points: FloatArray, closed: bool, off: float, parts: FloatArray
) -> tuple[FitStatus, int, float]:
    """Through every point, by clothoids that meet with the headings of circles through neighbours."""
    count = points.shape[0]
    poses = np.empty((count + closed, 3))
    for n in range(count + closed):
        poses[n, 0], poses[n, 1] = points[n % count, 0], points[n % count, 1]
    set_headings(points, closed, poses)
    status, where = g1_clothoids(poses, parts)
    if status != FitStatus.OK:
        return status, where, off
    worst = 0.0
    for n in range(count + closed - 1):
        worst = max(worst, bound_to_chord(parts[n : n + 1]))
    return status, count + closed - 1, off + worst


@kernel
def farthest_point(points: FloatArray, far: int) -> int:
    """The point farthest from the first; given `far`, the one farthest from the line to that."""
    best, most = 0, 0.0
    dx, dy = points[far, 0] - points[0, 0], points[far, 1] - points[0, 1]
    for n in range(points.shape[0]):
        x, y = points[n, 0] - points[0, 0], points[n, 1] - points[0, 1]
        away = abs(x * dy - y * dx) if far else math.hypot(x, y)
        if away > most * route_parts.EQUAL:
            best, most = n, away
    return best


@kernel
@allocates
def simplified(
    points: FloatArray, closed: bool, tolerance: float, kept: IntArray, strays: FloatArray
) -> int:
    """Choose points to keep, and bound how far sides between them stray, m; returns how many sides.

    `kept` ends with the point at which the last side ends; of a closed line that is one after the last.

    Ramer, Douglas and Peucker: a side replaces what lies between its ends if every point there is
    within `tolerance` of it. The distance from a segment is convex, so that what lies between the
    points is as near; and what is replaced leads from one end of the side to the other, so that some
    point of it stands abreast of each point of the side: the bound holds either way.
    """
    size = points.shape[0]
    ends = np.empty(size + 4, np.int64)  # a stack of where the sides that are not settled yet end
    a, depth, count = 0, 1, 0
    ends[0] = size if closed else size - 1
    if closed:
        far = farthest_point(points, 0)
        third = farthest_point(points, far)
        for cut in (max(far, third), min(far, third)):
            if 0 < cut < ends[depth - 1]:
                ends[depth] = cut
                depth += 1
    while depth:
        b, worst, most, middle = ends[depth - 1], 0.0, 0.0, a + 1
        for n in range(a + 1, b):
            away = off_segment(points, n, a, b)
            worst = max(worst, away)
            if away > most * route_parts.EQUAL:
                most, middle = away, n
        j = b % size
        apart = points[a, 0] != points[j, 0] or points[a, 1] != points[j, 1]
        if worst <= tolerance and (b - a == 1 or apart):
            kept[count], strays[count] = a, worst
            count += 1
            a = b
            depth -= 1
        else:
            ends[depth] = middle
            depth += 1
    kept[count] = a
    return count


@kernel
def set_sides(
    points: FloatArray, closed: bool, kept: IntArray, strays: FloatArray, smooth: Smoothing,
    sides: FloatArray,
) -> int:  # fmt: skip
    """Fill the sides of a polyline and the shapes of bends for its corners; the sharpest corner."""
    count, size, sharpest = sides.shape[0], points.shape[0], 0
    for n in range(count):
        a, b = kept[n], kept[n + 1] % size
        sides[n, PolylineSide.X], sides[n, PolylineSide.Y] = points[a, 0], points[a, 1]
        sides[n, PolylineSide.LENGTH] = math.hypot(
            points[b, 0] - points[a, 0], points[b, 1] - points[a, 1]
        )
        sides[n, PolylineSide.HEADING], sides[n, PolylineSide.STRAY] = toward(points, a, b), strays[n]
    for n in range(count):
        sides[n, PolylineSide.TURN] = folded(
            sides[(n + 1) % count, PolylineSide.HEADING] - sides[n, PolylineSide.HEADING]
        )
        if n == count - 1 and not closed:
            sides[n, PolylineSide.TURN] = 0.0
        if (
            abs(sides[n, PolylineSide.TURN])
            > abs(sides[sharpest, PolylineSide.TURN]) * route_parts.EQUAL
        ):
            sharpest = n
        half = 0.5 * abs(sides[n, PolylineSide.TURN])
        eased = EASED_SHARE * half if smooth == Smoothing.G2 else 0.0
        x, y = math.sin(eased), math.cos(eased)
        if eased > 0.0:
            x, end = clothoid_chord(2.0 * eased, 0.0, 0.5 / eased)
            y += end
        # The arc's centre is at (x - sin, y) from the start of the bend, along the side and across.
        sides[n, PolylineSide.TANGENT] = x - math.sin(eased) + y * math.tan(half)
        # y / cos(half) - 1, without cancelling: y is 1 and a little more.
        sides[n, PolylineSide.REACH] = (y - 1.0 + 2.0 * math.sin(0.5 * half) ** 2) / math.cos(half)
        sides[n, PolylineSide.EASED] = eased
    return sharpest


@kernel
@allocates
def set_radii(sides: FloatArray, closed: bool, left: float) -> float:
    """Fill in the radius of the bend at the end of each side, m; returns the least of them.

    Each is as large as its sides allow, and the deviation `left`, m, less the strays of the sides:
    where two bends need more than a side holds, they share it so that both get the same radius; then
    each, the narrowest first, takes what its neighbours leave.
    """
    count = sides.shape[0]
    wanted, tangent, room, fair = np.empty((4, count))
    for n in range(count):
        side, after = sides[n], sides[(n + 1) % count]
        reach = left - max(side[PolylineSide.STRAY], after[PolylineSide.STRAY])
        wide, bends = side[PolylineSide.REACH], abs(side[PolylineSide.TURN]) > LEAST_TURN
        wanted[n] = min(reach / wide, MOST_RADIUS) if wide > 0.0 else MOST_RADIUS
        tangent[n] = side[PolylineSide.TANGENT] if bends else 0.0
        end = not closed and (n == 0 or n == count - 1)
        room[n] = side[PolylineSide.LENGTH] * (1.0 - STRAIGHT_END if end else 1.0)
    for n in range(count):
        both = tangent[n - 1] + tangent[n]
        fair[n] = room[n] / both if both > 0.0 else math.inf
    radii = np.empty(count)
    for n in range(count):
        radii[n] = min(wanted[n], fair[n], fair[(n + 1) % count]) if tangent[n] else math.inf
    taken = np.zeros(count)
    for n in range(count):
        if tangent[n]:
            taken[n] = radii[n] * tangent[n]
    least = math.inf
    for n in np.argsort(radii, kind="mergesort"):  # which keeps the order of equals
        if tangent[n]:
            left, then = 0.0, (n + 1) % count
            if count > 1:
                left = min(room[n] - taken[n - 1], room[then] - taken[then])
            taken[n] = max(taken[n], min(wanted[n] * tangent[n], left))
    for n in range(count):
        sides[n, PolylineSide.RADIUS] = taken[n] / tangent[n] if tangent[n] else math.inf
        least = min(least, sides[n, PolylineSide.RADIUS])
    return least


@kernel
@allocates
def rounded_sides(sides: FloatArray, closed: bool, parts: FloatArray) -> tuple[int, float]:
    """Fill `parts` with lines and bends; returns how many, and their distance from the drawing, m.

    The parts of a closed line begin where the bend at the end of its last side ends.
    """
    count, k, bound, row = sides.shape[0], 0, 0.0, np.empty((1, COLUMNS))
    last, begin = sides[count - 1], 0.0
    if closed and last[PolylineSide.RADIUS] < math.inf:
        begin = last[PolylineSide.RADIUS] * last[PolylineSide.TANGENT]
    for n in range(count):
        side, after = sides[n], sides[(n + 1) % count]
        radius = side[PolylineSide.RADIUS] if side[PolylineSide.RADIUS] < math.inf else 0.0
        tangent, heading = radius * side[PolylineSide.TANGENT], side[PolylineSide.HEADING]
        c, s, length = math.cos(heading), math.sin(heading), side[PolylineSide.LENGTH]
        x, y = side[PolylineSide.X], side[PolylineSide.Y]
        stray = max(side[PolylineSide.STRAY], after[PolylineSide.STRAY])
        bound, left = max(bound, stray + radius * side[PolylineSide.REACH]), length - begin - tangent
        if left > LEAST_LINE:
            add(parts, k, CurveKind.LINE, left, x + begin * c, y + begin * s, heading)
            k += 1
        if tangent > 0.0:
            x, y = after[PolylineSide.X], after[PolylineSide.Y]
            start = Pose(x - tangent * c, y - tangent * s, heading)
            k = add_bend(
                parts, k, radius, side[PolylineSide.TURN], side[PolylineSide.EASED], start, row
            )
        begin = tangent
    return k, bound


@kernel
def add_bend(
    parts: FloatArray, n: int, radius: float, turn: float, eased: float, start: Pose, row: FloatArray
) -> int:
    """Add to n parts an arc, or clothoid, arc and clothoid, from a pose on; returns the new number."""
    if eased == 0.0:
        add(parts, n, CurveKind.ARC, radius, start.x, start.y, start.heading)
        parts[n, RoutePart.FIRST] = turn
        return n + 1
    side = math.copysign(1.0, turn)
    length = 2.0 * radius * eased
    add(parts, n, CurveKind.CLOTHOID, length, start.x, start.y, start.heading)
    parts[n, RoutePart.LAST] = side / radius
    pose = part_end(parts, n, row)
    add(parts, n + 1, CurveKind.ARC, radius, pose.x, pose.y, pose.heading)
    parts[n + 1, RoutePart.FIRST] = turn - 2.0 * side * eased
    pose = part_end(parts, n + 1, row)
    add(parts, n + 2, CurveKind.CLOTHOID, length, pose.x, pose.y, pose.heading)
    parts[n + 2, RoutePart.FIRST] = side / radius
    return n + 3


@kernel
@allocates
def rounded_line(
    points: FloatArray, closed: bool, smooth: Smoothing, deviation: float, off: float, parts: FloatArray
) -> tuple[FitStatus, int, float]:
    """A route with rounded corners: of several shares of the deviation, that of the widest bends."""
    size, far = points.shape[0], 0.0
    for n in range(size):
        far = max(far, abs(points[n, 0]), abs(points[n, 1]))
    rounding = PLACE_ROUNDING * (1.0 + far)
    off += rounding
    left = (1.0 - SLACK) * (deviation - off)
    if left <= 0.0:
        return FitStatus.NO_ROOM, 0, off
    kept, strays = np.empty(size + 1, np.int64), np.empty(size + 1)
    best, widest = 0.0, -2.0
    for share in SHARES:
        tolerance = max(share * left, rounding)
        count = simplified(points, closed, tolerance, kept, strays)
        sides = np.empty((count, SIDE_COLUMNS))
        sharpest = set_sides(points, closed, kept, strays, smooth, sides)
        hairpin = abs(sides[sharpest, PolylineSide.TURN]) > MOST_CORNER
        least = -1.0 if hairpin else set_radii(sides, closed, left)
        if least > widest:
            best, widest = tolerance, least
    count = simplified(points, closed, best, kept, strays)
    sides = np.empty((count, SIDE_COLUMNS))
    sharpest = set_sides(points, closed, kept, strays, smooth, sides)
    if abs(sides[sharpest, PolylineSide.TURN]) > MOST_CORNER:
        return FitStatus.HAIRPIN, kept[sharpest + 1] % size, off
    set_radii(sides, closed, left)
    made, bound = rounded_sides(sides, closed, parts)
    return FitStatus.OK, made, off + bound


@entry
@allocates
def fit_points(
    points: Table, closed: bool, smooth: Smoothing, deviation: float, off: float, parts: Table
) -> tuple[FitStatus, int, float]:
    """Fill `parts` with those of a route along different points, (P, 2), m, four a point at most.

    Returns the status; the number of parts, or of the point at which it failed; and a bound on how far
    they lie from the drawing, m, which includes `off`, that of the points.
    """
    if smooth == Smoothing.NONE:
        return through_points(points, closed, off, parts)
    return rounded_line(points, closed, smooth, deviation, off, parts)
