"""Off-tracking: how far handles leave the route where bearers follow the bench before them.

The head's handle keeps to the route. Each handle behind it is drawn along its bench; sideways its
bearers take back a share of its offset from the route for each metre walked, the steering gain. Bearers
of gain 0 only follow, as trailers do (a pursuit curve); the greater it is, the better they keep to the
route. With P the front handle of a bench, u its unit vector forwards, n that to its left, d its link, e
how far left of the route its rear handle is, and ' the derivative by the head's route position, the
bench's heading a obeys

    a' = (n . P' + gain e u . P') / d,

for the rear handle's velocity is that of P along the bench, and -gain e u . P' across it.
"""

import math

import numpy as np

from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import FloatArray, RouteRow, curvature, place, stretch, walks_up
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import FOLD_COSINE, locate
from benchdragon.kernels.status import Status

# Newton's method takes one or two steps to the nearest point of the route, which hardly moves. Where
# the offset is near the radius of a bend, steps are at most so many times the distance along the route.
NEAREST_STEPS = 20
LONGEST = 20.0
# Steps along the route shorter than this, m, end it; so far off the route a handle is still on it.
NEAR_ENOUGH = 1e-10


class Off(Numbered):
    """Columns of what is seen of each handle."""

    LEFT = 0  # how far left of the route it came, m, not negative
    LEFT_AT = 1  # where the head was then, m
    LEFT_ERROR = 2  # of LEFT, m: see `see_offsets`
    RIGHT = 3
    RIGHT_AT = 4
    RIGHT_ERROR = 5


OFF_COLUMNS = len(Off)


class Rear(Numbered):
    """Columns of rear handles, one row a bench: the nearest point of the route, and how far that is."""

    ROW = 0
    U = 1
    OFFSET = 2  # m, left positive
    BEFORE = 3  # what it was a step before


REAR_COLUMNS = len(Rear)


@kernel
def slide(rows: FloatArray, j: int, u: float, way: float) -> tuple[int, float]:
    """Row and parameter some way along the route, m, to first order; not beyond the end of a row."""
    sign = walks_up(rows, j)
    v = u + sign * way / stretch(rows, j, u)
    if sign * (v - rows[j, RouteRow.U_END]) > 0.0:
        if j + 1 < rows.shape[0]:
            return j + 1, rows[j + 1, RouteRow.U_START]
        return j, rows[j, RouteRow.U_END]
    back = rows[j, RouteRow.U_BACK] if j == 0 else rows[j, RouteRow.U_START]
    if sign * (v - back) < 0.0:
        return (j - 1, rows[j - 1, RouteRow.U_END]) if j else (j, back)
    return j, v


@kernel
def nearest_point(rows: FloatArray, j: int, u: float, x: float, y: float) -> tuple[int, float, float]:
    """The nearest point of the route to (x, y), from one near it: row, parameter; the offset, m."""
    offset = 0.0
    for _step in range(NEAREST_STEPS):
        px, py, tx, ty = place(rows, j, u)
        along, offset = (x - px) * tx + (y - py) * ty, (y - py) * tx - (x - px) * ty
        way = along / max(1.0 - curvature(rows, j, u) * offset, 1.0 / LONGEST)
        if abs(way) < NEAR_ENOUGH:
            break
        j, u = slide(rows, j, u, way)
    return j, u, offset


@kernel
def headings_change(
    rows: FloatArray, links: FloatArray, s: float, gain: float, angles: FloatArray, rear: FloatArray,
    again: bool, change: FloatArray,
) -> Status:  # fmt: skip
    """Fill change[i], the derivative of each bench's heading, 1/m, and `rear`.

    The nearest point of the route is sought from where it was before; `again`, from that of the handle
    before, too: who cuts a bend by more than its radius comes near what lies behind the bend at once.
    Folded is a bench that its front handle draws square to it: bearers can follow no farther.
    """
    j, u, status = locate(rows, s)
    x, y, dx, dy = place(rows, j, u)
    for i in range(links.shape[0]):
        ux, uy = math.cos(angles[i]), math.sin(angles[i])
        x, y = x - links[i] * ux, y - links[i] * uy
        row, v, offset = nearest_point(rows, int(rear[i, Rear.ROW]), rear[i, Rear.U], x, y)
        if again:
            j, u, other = nearest_point(rows, j, u, x, y)
            if abs(other) < abs(offset):
                row, v, offset = j, u, other
            j, u = row, v
        rear[i, Rear.ROW], rear[i, Rear.U], rear[i, Rear.OFFSET] = row, v, offset
        along, across = ux * dx + uy * dy, ux * dy - uy * dx
        if along <= FOLD_COSINE * math.hypot(dx, dy):
            return Status.FOLDED
        back = gain * offset * along
        change[i] = (across + back) / links[i]
        dx, dy = along * ux + back * uy, along * uy - back * ux
    return status


@kernel
def note(offset: float, before: float, s: float, first: int, seen: FloatArray) -> None:
    """Keep the greatest offset to a side, whose columns begin with `first`, and what is beside it."""
    if offset > max(seen[first], NEAR_ENOUGH):
        seen[first], seen[first + 1], seen[first + 2] = offset, s, offset - before
    elif before == seen[first] and before > 0.0:
        seen[first + 2] = max(seen[first + 2], before - offset)


@kernel
def note_all(rear: FloatArray, s: float, seen: FloatArray) -> None:
    """Keep the greatest offsets to each side, where the head is then, and how fast they change."""
    for i in range(rear.shape[0]):
        offset, before = rear[i, Rear.OFFSET], rear[i, Rear.BEFORE]
        note(offset, before, s, Off.LEFT, seen[i])
        note(-offset, -before, s, Off.RIGHT, seen[i])
        rear[i, Rear.BEFORE] = offset


@kernel
def stand_on_route(
    places: Placements, first: float, angles: FloatArray, rear: FloatArray, seen: FloatArray
) -> None:
    """Fill the headings of benches whose handles are all on the route, and what is seen of them."""
    for i in range(angles.shape[0]):
        x, y = places.x[i, 0] - places.x[i + 1, 0], places.y[i, 0] - places.y[i + 1, 0]
        angles[i] = math.atan2(y, x)
        rear[i, Rear.ROW], rear[i, Rear.U] = places.row[i + 1, 0], places.u[i + 1, 0]
        seen[i, Off.LEFT] = seen[i, Off.LEFT_ERROR] = seen[i, Off.RIGHT] = seen[i, Off.RIGHT_ERROR] = (
            0.0
        )
        seen[i, Off.LEFT_AT] = seen[i, Off.RIGHT_AT] = first


@kernel
@allocates
def walk_off(
    rows: Table, links: Vector, places: Placements, first: float, last: float, steps: int, gain: float,
    seen: Table,
) -> Status:  # fmt: skip
    """See offsets while the head walks from `first` to `last`, m, at the ends of so many steps."""
    count, h = links.shape[0], (last - first) / steps
    rear = np.zeros((count, REAR_COLUMNS))
    angles, tried, change, mean = np.empty(count), np.empty(count), np.zeros(count), np.zeros(count)
    stand_on_route(places, first, angles, rear, seen)
    status = Status.OK
    for step in range(steps):
        for stage in range(4):
            share = 0.0 if stage == 0 else h if stage == 3 else 0.5 * h
            for i in range(count):
                tried[i] = angles[i] + share * change[i]
            at = min(first + h * step + share, last)
            status = headings_change(rows, links, at, gain, tried, rear, stage == 0, change)
            if status != Status.OK:
                return status
            if stage == 0:
                note_all(rear, at, seen)
            for i in range(count):
                mean[i] += change[i] / (6.0 if stage in (0, 3) else 3.0)
        for i in range(count):
            angles[i] += h * mean[i]
            mean[i] = change[i] = 0.0
    status = headings_change(rows, links, last, gain, angles, rear, True, change)
    note_all(rear, last, seen)
    return status


@entry
@allocates
def see_offsets(
    rows: Table, links: Vector, places: Placements, first: float, last: float, steps: int, gain: float,
    seen: Table,
) -> Status:  # fmt: skip
    """Fill seen[i] for the rear handle of each bench while the head walks from `first` to `last`, m.

    All handles are on the route at first, in slot 0 of `places`. In so many steps of the classical
    Runge-Kutta method of order 4, then in twice as many, at whose ends offsets are seen. Errors are by
    how much that changes them, and by how much the step before and after the greatest one does. `seen`
    has OFF_COLUMNS columns; the gain is in 1/m.
    """
    rough = np.empty((links.shape[0], OFF_COLUMNS))
    status = walk_off(rows, links, places, first, last, steps, gain, rough)
    if status == Status.OK:
        status = walk_off(rows, links, places, first, last, 2 * steps, gain, seen)
    for i in range(links.shape[0]):
        seen[i, Off.LEFT_ERROR] += abs(seen[i, Off.LEFT] - rough[i, Off.LEFT])
        seen[i, Off.RIGHT_ERROR] += abs(seen[i, Off.RIGHT] - rough[i, Off.RIGHT])
    return status
