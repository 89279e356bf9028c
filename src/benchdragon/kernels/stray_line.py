"""A line that strays from a route, smoothly and at random, as rows of arcs: see kernels/curve.py.

How far aside it lies is white noise, a number each LATTICE metres back from where the head ends,
weighed by a Gaussian. So places d apart are correlated by exp(-d^2 / (2 STRAY_LENGTH^2)), and a line is
the same however far its route goes back.
"""

import math

from benchdragon.kernels.curve import (
    COLUMNS,
    CurveKind,
    FloatArray,
    RouteRow,
    bend_slope,
    curvature,
    heading,
    parameter_at,
    place,
)
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.random_numbers import Random, normal_at
from benchdragon.kernels.route import row_at
from benchdragon.kernels.route_parts import Pose

# Over this the line strays smoothly, m; the spread of the Gaussian that makes it so. Numbers are so
# near that where they stand does not show, to 1e-16, and weighed so far that 1e-10 is left.
STRAY_LENGTH = 10.0
SPREAD = STRAY_LENGTH / math.sqrt(2.0)
TO_A_SPREAD, LATTICE_REACH = 2, 14
LATTICE = SPREAD / TO_A_SPREAD
# The factor that makes the deviation of the sum 1.
SCALE = (TO_A_SPREAD * math.sqrt(math.pi)) ** -0.5
# Arcs are between points so far apart, m, or nearer where the curvature changes: by so much in a
# metre, 1/m, an arc keeps within 1e-5 m of the line meant. Points nearer than LEAST_PART to one another
# are not told apart; behind its start the line runs on straight.
ARC_LENGTH, ARC_CHANGE, LEAST_PART, BEHIND = 2.0, 3e-3, 1e-3, 1.0


@kernel
def noise_count(way: float) -> int:
    """The number of noise values that a line needs whose head ends at `way`, m."""
    return int(way / LATTICE) + 2 * LATTICE_REACH + 2


@kernel
def fill_noise(seed: int, dance: int, out: FloatArray) -> None:
    """The noise of a dance's line."""
    for n in range(out.shape[0]):
        out[n] = normal_at(seed, dance, Random.STRAY, n)


@kernel
def offset_at(noise: FloatArray, back: float) -> tuple[float, float]:
    """The line's offset to the left, in standard deviations, `back` metres before the head's end.

    The second result is its change along the route, 1/m.
    """
    n, x, value, slope = math.floor(back / LATTICE), back / LATTICE, 0.0, 0.0
    for k in range(1, 2 * LATTICE_REACH + 1):
        d = (x - (n - LATTICE_REACH + k)) / TO_A_SPREAD
        weighed = noise[n + k] * math.exp(-0.5 * d * d)
        value += weighed
        slope += weighed * d
    return SCALE * value, SCALE * slope / SPREAD


@kernel
def before(rows: FloatArray, s: float, low: float) -> float:
    """The point of the route before that at s, m, between which one pair of arcs will do."""
    j = row_at(rows, s - LEAST_PART)
    start = rows[j, RouteRow.S_START]
    border = max(start, low) if j > 0 else low
    near = parameter_at(rows, j, s - start)
    far = parameter_at(rows, j, max(s - ARC_LENGTH, border) - start)
    change = max(bend_slope(rows, j, near), bend_slope(rows, j, far))
    step = ARC_LENGTH if change * ARC_LENGTH**3 <= ARC_CHANGE else (ARC_CHANGE / change) ** (1.0 / 3.0)
    return border if s - step < border + LEAST_PART else s - step


@kernel
def lay_points(rows: FloatArray, low: float, end: float, out: FloatArray, most: int) -> int:
    """Points from `low` to `end`, m, to fit arcs between, and joints; returns how many, up to `most`.

    They fill `out` if there are as many as it holds.
    """
    s, count = end, 1
    if out.shape[0]:
        out[out.shape[0] - 1] = end
    while s > low and count < most:
        s = before(rows, s, low)
        count += 1
        if count <= out.shape[0]:
            out[out.shape[0] - count] = s
    return count


@kernel
def beside(rows: FloatArray, s: float, noise: FloatArray, stray: float, back: float) -> Pose:
    """The pose of the line beside route position s, `back` metres before the head's end."""
    aside, slope = offset_at(noise, back)
    j = row_at(rows, s)
    u = parameter_at(rows, j, s - rows[j, RouteRow.S_START])
    x, y, tx, ty = place(rows, j, u)
    turned = math.atan2(stray * slope, 1.0 - stray * aside * curvature(rows, j, u))
    return Pose(x - stray * aside * ty, y + stray * aside * tx, heading(rows, j, u) + turned)


@kernel
def write_bend(
    line: FloatArray, j: int, kind: float, start: Pose, bend: float, s: float, length: float
) -> None:
    """Row j of a line, at s, m."""
    for column in range(COLUMNS):
        line[j, column] = 0.0
    line[j, RouteRow.KIND] = kind
    line[j, RouteRow.X] = start.x
    line[j, RouteRow.Y] = start.y
    line[j, RouteRow.ANGLE] = start.heading
    line[j, RouteRow.P] = bend
    line[j, RouteRow.S_START] = s
    line[j, RouteRow.LENGTH] = length
    line[j, RouteRow.U_END] = length
    line[j, RouteRow.AXIS_X], line[j, RouteRow.AXIS_Y] = (
        math.cos(start.heading),
        math.sin(start.heading),
    )


@kernel
def arc_to(line: FloatArray, j: int, start: Pose, x: float, y: float) -> Pose:
    """Row j of a line, which has those before it, from a pose to (x, y); the pose there."""
    c, s = math.cos(start.heading), math.sin(start.heading)
    dx, dy = x - start.x, y - start.y
    half, chord = math.atan2(dy * c - dx * s, dx * c + dy * s), math.hypot(dx, dy)
    length = chord * half / math.sin(half) if half != 0.0 else chord
    at = line[j - 1, RouteRow.S_START] + line[j - 1, RouteRow.LENGTH]
    write_bend(line, j, CurveKind.ARC, start, 2.0 * math.sin(half) / chord, at, length)
    return Pose(x, y, start.heading + 2.0 * half)


@kernel
def middle_of(p: Pose, q: Pose) -> tuple[float, float]:
    """Where two arcs between poses meet, m."""
    vx, vy = q.x - p.x, q.y - p.y
    a, b, c, d = math.cos(p.heading), math.sin(p.heading), math.cos(q.heading), math.sin(q.heading)
    along, apart = vx * (a + c) + vy * (b + d), (a - c) * (a - c) + (b - d) * (b - d)
    size = vx * vx + vy * vy
    far = size / (along + math.sqrt(along * along + apart * size))
    return 0.5 * (p.x + q.x + far * (a - c)), 0.5 * (p.y + q.y + far * (b - d))


@kernel
def lay_line(
    rows: FloatArray,
    points: FloatArray,
    noise: FloatArray,
    stray: float,
    line: FloatArray,
    along: FloatArray,
) -> None:
    """Fill the rows of the line beside a route, one and two for each two points, and `along`.

    `along`: each point's position on the line, m. `stray`: the standard deviation of its offset, m.
    """
    last = points.shape[0] - 1
    begun = beside(rows, points[0], noise, stray, points[last] - points[0])
    x, y = begun.x - BEHIND * math.cos(begun.heading), begun.y - BEHIND * math.sin(begun.heading)
    write_bend(line, 0, CurveKind.LINE, Pose(x, y, begun.heading), 0.0, 0.0, BEHIND)
    line[0, RouteRow.U_BACK], along[0] = -math.inf, BEHIND
    for n in range(1, last + 1):
        pose = beside(rows, points[n], noise, stray, points[last] - points[n])
        x, y = middle_of(begun, pose)
        half = arc_to(line, 2 * n - 1, begun, x, y)
        arc_to(line, 2 * n, half, pose.x, pose.y)
        along[n] = line[2 * n, RouteRow.S_START] + line[2 * n, RouteRow.LENGTH]
        begun = pose


@kernel
def between(x: float, places: FloatArray, values: FloatArray) -> float:
    """The value at x of a line through values at increasing places; beyond them, that at the end."""
    low, high = 0, places.shape[0] - 1
    if x >= places[high]:
        return values[high]
    while high - low > 1:
        middle = (low + high) // 2
        if places[middle] <= x:
            low = middle
        else:
            high = middle
    share = (x - places[low]) / (places[high] - places[low])
    return values[low] + max(share, 0.0) * (values[high] - values[low])
