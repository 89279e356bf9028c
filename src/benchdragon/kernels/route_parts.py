"""The rows of a route from a short table of its parts, in place or moved to where others end.

Parts are a table of floats as well, one row a curve as a plan gives it, its columns named below.
"""

import math
from typing import NamedTuple

from benchdragon.kernels import curve
from benchdragon.kernels.angles import sincos_of
from benchdragon.kernels.arrays import Table
from benchdragon.kernels.curve import (
    CurveKind,
    FloatArray,
    RouteRow,
    curvature,
    heading,
    length_at,
    place,
)
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import locate


class RoutePart(Numbered):
    """Columns of parts of a route, one row a part."""

    KIND = 0  # as KIND of a row
    X = 1  # start point; of a spiral the centre, m
    Y = 2
    ANGLE = 3  # heading at the start; of a spiral the polar axis, rad
    SIZE = 4  # length; of an arc the radius, of a spiral the pitch, m
    FIRST = 5  # curvature at the start, 1/m; of an arc the sweep, of a spiral the first theta, rad
    LAST = 6  # curvature at the end, 1/m; of a spiral the last theta, rad
    HAND = 7  # of a spiral: +1, or -1 if mirrored


PART_COLUMNS = len(RoutePart)

# Values greater by no more than this factor are equal; of equals all engines take the first.
EQUAL = 1.0 + 1e-9
# The most places at which a route's reach is sampled; a turn has some 1e3.
MOST_REACH_PLACES = 1e6


class Pose(NamedTuple):
    """A point, m, and the heading there, rad."""

    x: float
    y: float
    heading: float


@kernel
def cuts(parts: FloatArray, i: int) -> int:
    """Rows that part i fills: a clothoid several, if it turns too far for one quadrature."""
    if parts[i, RoutePart.KIND] != CurveKind.CLOTHOID:
        return 1
    turn = parts[i, RoutePart.SIZE] * max(abs(parts[i, RoutePart.FIRST]), abs(parts[i, RoutePart.LAST]))
    return max(1, math.ceil(turn / curve.CLOTHOID_TURN))


@entry
def row_count(parts: Table) -> int:
    """Rows that these parts fill."""
    count = 0
    for i in range(parts.shape[0]):
        count += cuts(parts, i)
    return count


@entry
def lay_rows(parts: Table, start: Pose, first: int, stop: int, rows: Table) -> None:
    """Fill the rows of a route of these parts; rows has as many as `row_count` says.

    Parts first..stop-1 are moved, in `parts` as well, to where the one before them ends; part 0 to
    `start`.
    """
    j = 0
    s = 0.0
    pose = start
    for i in range(parts.shape[0]):
        write_row(parts, i, rows, j, s)
        if first <= i < stop:
            move_row(rows, j, pose)
            parts[i, RoutePart.X] = rows[j, RouteRow.X]
            parts[i, RoutePart.Y] = rows[j, RouteRow.Y]
            parts[i, RoutePart.ANGLE] = rows[j, RouteRow.ANGLE]
        count = cuts(parts, i)
        piece = rows[j, RouteRow.LENGTH]
        for n in range(1, count):
            bend = parts[i, RoutePart.FIRST] + rows[j, RouteRow.Q] * piece * n
            continue_clothoid(rows, j + n, s + piece * n, bend)
        j += count
        s += piece * (count - 1) + piece
        pose = end_pose(rows, j - 1)


@kernel
def set_axis(rows: FloatArray, j: int) -> None:
    """Fill the cosine and sine of row j's ANGLE."""
    rows[j, RouteRow.AXIS_Y], rows[j, RouteRow.AXIS_X] = sincos_of(rows[j, RouteRow.ANGLE])


@kernel
def write_row(parts: FloatArray, i: int, rows: FloatArray, j: int, s: float) -> None:
    """Row j, at route position s, for part i; for a clothoid that is cut the first of its rows."""
    kind = parts[i, RoutePart.KIND]
    size = parts[i, RoutePart.SIZE]
    first = parts[i, RoutePart.FIRST]
    last = parts[i, RoutePart.LAST]
    rows[j, RouteRow.KIND] = kind
    rows[j, RouteRow.PART] = i
    rows[j, RouteRow.S_START] = s
    rows[j, RouteRow.X] = parts[i, RoutePart.X]
    rows[j, RouteRow.Y] = parts[i, RoutePart.Y]
    rows[j, RouteRow.ANGLE] = parts[i, RoutePart.ANGLE]
    rows[j, RouteRow.P] = first
    rows[j, RouteRow.Q] = 0.0
    rows[j, RouteRow.U_START] = 0.0
    rows[j, RouteRow.LENGTH] = size
    if kind == CurveKind.SPIRAL:
        rows[j, RouteRow.P] = size / (2.0 * math.pi)
        rows[j, RouteRow.Q] = parts[i, RoutePart.HAND]
        rows[j, RouteRow.U_START] = first
        rows[j, RouteRow.U_END] = last
        rows[j, RouteRow.LENGTH] = length_at(rows, j, last)
    elif kind == CurveKind.ARC:
        rows[j, RouteRow.P] = math.copysign(1.0 / size, first)
        rows[j, RouteRow.LENGTH] = size * abs(first)
    elif kind == CurveKind.CLOTHOID:
        rows[j, RouteRow.LENGTH] = size / cuts(parts, i)
        rows[j, RouteRow.Q] = (last - first) / size
    elif kind == CurveKind.LOG_SPIRAL:
        rows[j, RouteRow.Q] = (first - last) / last / size
    if kind != CurveKind.SPIRAL:
        rows[j, RouteRow.U_END] = rows[j, RouteRow.LENGTH]
    set_axis(rows, j)
    rows[j, RouteRow.U_BACK] = rows[j, RouteRow.U_START]
    if j == 0:
        rows[j, RouteRow.U_BACK] = extension_end(kind, first, last)


@kernel
def extension_end(kind: float, first: float, last: float) -> float:
    """U_BACK of a route's first row: a line runs on straight behind it, an inward spiral outward."""
    if kind == CurveKind.LINE:
        return -math.inf
    if kind == CurveKind.SPIRAL:
        return math.inf if last < first else first
    return 0.0


@kernel
def continue_clothoid(rows: FloatArray, j: int, s: float, bend: float) -> None:
    """Row j of a clothoid where row j - 1 of it ends, at s and with this curvature."""
    for column in range(curve.COLUMNS):
        rows[j, column] = rows[j - 1, column]
    pose = end_pose(rows, j - 1)
    rows[j, RouteRow.X], rows[j, RouteRow.Y], rows[j, RouteRow.ANGLE] = pose.x, pose.y, pose.heading
    set_axis(rows, j)
    rows[j, RouteRow.S_START] = s
    rows[j, RouteRow.P] = bend
    rows[j, RouteRow.U_BACK] = 0.0


@kernel
def move_row(rows: FloatArray, j: int, pose: Pose) -> None:
    """Let row j begin at a pose."""
    if rows[j, RouteRow.KIND] != CurveKind.SPIRAL:
        rows[j, RouteRow.X], rows[j, RouteRow.Y], rows[j, RouteRow.ANGLE] = pose.x, pose.y, pose.heading
        set_axis(rows, j)
        return
    old = start_pose(rows, j)
    turn = pose.heading - old.heading
    s, c = sincos_of(turn)
    dx, dy = rows[j, RouteRow.X] - old.x, rows[j, RouteRow.Y] - old.y
    rows[j, RouteRow.X] = pose.x + c * dx - s * dy
    rows[j, RouteRow.Y] = pose.y + s * dx + c * dy
    rows[j, RouteRow.ANGLE] += turn
    set_axis(rows, j)


@kernel
def pose_at(rows: FloatArray, j: int, u: float) -> Pose:
    """The pose at parameter u of row j."""
    x, y, _, _ = place(rows, j, u)
    return Pose(x, y, heading(rows, j, u))


@entry
def start_pose(rows: Table, j: int) -> Pose:
    """The pose at the start of row j."""
    return pose_at(rows, j, rows[j, RouteRow.U_START])


@entry
def end_pose(rows: Table, j: int) -> Pose:
    """The pose at the end of row j."""
    return pose_at(rows, j, rows[j, RouteRow.U_END])


@kernel
def part_start(parts: FloatArray, i: int, row: FloatArray) -> Pose:
    """The pose at the start of part i; `row` is scratch, (1, COLUMNS)."""
    write_row(parts, i, row, 0, 0.0)
    return start_pose(row, 0)


@kernel
def part_end(parts: FloatArray, i: int, row: FloatArray) -> Pose:
    """The pose at the end of part i, which fills one row; `row` is scratch, (1, COLUMNS)."""
    write_row(parts, i, row, 0, 0.0)
    return end_pose(row, 0)


@kernel
def put_part(parts: FloatArray, i: int, pose: Pose, row: FloatArray) -> Pose:
    """Let part i, which fills one row, begin at a pose; the pose at its end."""
    write_row(parts, i, row, 0, 0.0)
    move_row(row, 0, pose)
    parts[i, RoutePart.X], parts[i, RoutePart.Y] = row[0, RouteRow.X], row[0, RouteRow.Y]
    parts[i, RoutePart.ANGLE] = row[0, RouteRow.ANGLE]
    return end_pose(row, 0)


@entry
def move_parts(parts: Table, turned: float, x: float, y: float) -> None:
    """Turn parts about the origin by an angle, rad, and then move them, m."""
    c, s = math.cos(turned), math.sin(turned)
    for i in range(parts.shape[0]):
        at_x, at_y = parts[i, RoutePart.X], parts[i, RoutePart.Y]
        parts[i, RoutePart.X], parts[i, RoutePart.Y] = c * at_x - s * at_y + x, s * at_x + c * at_y + y
        parts[i, RoutePart.ANGLE] += turned


@entry
def settle_rows(rows: Table, x: float, y: float) -> None:
    """Let (x, y) be the origin of a route's rows, and each row begin where the one before it ends.

    Far from the origin rounding leaves gaps between rows; here they are closed.
    """
    rows[0, RouteRow.X] -= x
    rows[0, RouteRow.Y] -= y
    for j in range(1, rows.shape[0]):
        end_x, end_y, _, _ = place(rows, j - 1, rows[j - 1, RouteRow.U_END])
        rows[j, RouteRow.X] = rows[j, RouteRow.Y] = 0.0
        start_x, start_y, _, _ = place(rows, j, rows[j, RouteRow.U_START])
        rows[j, RouteRow.X], rows[j, RouteRow.Y] = end_x - start_x, end_y - start_y


@entry
def misfits(rows: Table, out: Table) -> None:
    """Fill out[i] with the gap, m, and the kink, rad, between parts i and i + 1."""
    for j in range(1, rows.shape[0]):
        if rows[j, RouteRow.PART] == rows[j - 1, RouteRow.PART]:
            continue
        i = int(rows[j, RouteRow.PART]) - 1
        before, after = end_pose(rows, j - 1), start_pose(rows, j)
        out[i, 0] = math.hypot(after.x - before.x, after.y - before.y)
        kink = after.heading - before.heading
        out[i, 1] = abs(kink - 2.0 * math.pi * math.floor(kink / (2.0 * math.pi) + 0.5))


@entry
def tightest_bend(rows: Table) -> tuple[float, float]:
    """The greatest curvature at either end of any row, in size, 1/m; and at which route position, m."""
    most, there, where = 0.0, 0.0, 0.0
    for j in range(rows.shape[0]):
        for n in range(2):
            bend = abs(curvature(rows, j, rows[j, RouteRow.U_END if n else RouteRow.U_START]))
            most = max(most, bend)
            if bend > there * EQUAL:
                there, where = bend, rows[j, RouteRow.S_START] + n * rows[j, RouteRow.LENGTH]
    return most, where


@entry
def farthest(rows: Table, first: float, last: float, step: float) -> float:
    """The greatest distance from the origin, m, of places `step` m or less apart, `first` to `last`.

    There are MOST_REACH_PLACES at most.
    """
    count = math.ceil(min((last - first) / step, MOST_REACH_PLACES)) + 1
    most = 0.0
    for n in range(count + 1):
        j, u, _status = locate(rows, first + (last - first) * n / count)
        x, y, _, _ = place(rows, j, u)
        most = max(most, math.hypot(x, y))
    return most
