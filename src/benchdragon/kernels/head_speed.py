"""The fastest pace of a head under limits: how square speed and acceleration may go together.

Over a step of the head at which every handle's ratio w, rate g = d log w / dsigma and curvature are
bounded, each limit allows a convex set of (q, a), q the square of the head's speed and a its
acceleration, and 0 lies in it: limits bound |w (a + g q)|, w^2 q |curvature|, and the root of both
squares. Since q is straight over a step, keeping to the set at both ends keeps to it all the way. A
pass back from the end finds from which q the rest can be walked, a pass ahead takes the most.
"""

import math

import numpy as np

from benchdragon.kernels import motion_bounds
from benchdragon.kernels.arrays import Stack, Vector
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.drive import DriveRate, Scratch, bound_step
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.motion_bounds import HandleBound
from benchdragon.kernels.numbered import Numbered


class HandleHull(Numbered):
    """Columns of the bounds on a handle over a step.

    They are w, the turning rate of the bench before it, g, curvature.
    """

    FAST = 0
    TURNING_RATE = 1
    GROWTH_LOW = 2
    GROWTH_HIGH = 3
    BEND = 4


HANDLE_HULL_COLUMNS = len(HandleHull)


class HeadLimit(DriveRate):
    """Limits in the order of drive's rates, SI units, infinite where there is none; then the head's."""

    HEAD = 5


# Squares of speed at which the least and the greatest acceleration allowed are tabled, a step.
SPEED_NODES = 65
# Halvings of a square of speed.
SPEED_HALVINGS = 52


@kernel
def widen(
    rows: FloatArray, links: FloatArray, places: Placements, a: int, even: FloatArray, scratch: Scratch,
    hull: FloatArray,
) -> None:  # fmt: skip
    """Widen a hull, (handles, HULL_COLUMNS), by the step from slot a to the next.

    `even` is the drive of a steady head at 1 m/s, see drive.py.
    """
    table = scratch.table
    bound_step(rows, links, places, a, a + 1, even, DriveRate.ALONG, scratch)
    for i in range(hull.shape[0]):
        bent = motion_bounds.magnitude(table[i, HandleBound.RIGHT], table[i, HandleBound.LEFT])
        hull[i, HandleHull.FAST] = max(
            hull[i, HandleHull.FAST], motion_bounds.ROUNDED_UP * table[i, HandleBound.SPEED]
        )
        hull[i, HandleHull.TURNING_RATE] = max(
            hull[i, HandleHull.TURNING_RATE],
            motion_bounds.ROUNDED_UP * table[i, HandleBound.TURNING_RATE],
        )
        hull[i, HandleHull.GROWTH_LOW] = min(
            hull[i, HandleHull.GROWTH_LOW], table[i, HandleBound.GROWTH_LOW]
        )
        hull[i, HandleHull.GROWTH_HIGH] = max(
            hull[i, HandleHull.GROWTH_HIGH], table[i, HandleBound.GROWTH_HIGH]
        )
        hull[i, HandleHull.BEND] = max(hull[i, HandleHull.BEND], bent)


@kernel
def find_hull(
    rows: FloatArray, links: FloatArray, places: Placements, parts: int, even: FloatArray,
    scratch: Scratch, hull: FloatArray,
) -> None:  # fmt: skip
    """Fill a hull with the bounds from the first slot to the last of so many parts of a step."""
    for i in range(hull.shape[0]):
        hull[i, HandleHull.FAST] = hull[i, HandleHull.TURNING_RATE] = hull[i, HandleHull.BEND] = 0.0
        hull[i, HandleHull.GROWTH_LOW], hull[i, HandleHull.GROWTH_HIGH] = math.inf, -math.inf
    for k in range(parts):
        widen(rows, links, places, k, even, scratch, hull)


@kernel
def allowed(hull: FloatArray, limits: FloatArray, square: float) -> tuple[float, float]:
    """Least and greatest acceleration of the head with this square of its speed; empty if (1, -1)."""
    low, high = -limits[HeadLimit.HEAD], limits[HeadLimit.HEAD]
    for i in range(hull.shape[0]):
        fast = hull[i, HandleHull.FAST]
        across = fast * fast * square * hull[i, HandleHull.BEND]
        over = fast * fast * square > limits[DriveRate.SPEEDS] ** 2 or across > min(
            limits[DriveRate.ACROSS], limits[DriveRate.TOTAL]
        )
        if over or hull[i, HandleHull.TURNING_RATE] ** 2 * square > limits[DriveRate.TURNING] ** 2:
            return 1.0, -1.0
        most = (
            min(
                limits[DriveRate.ALONG],
                math.sqrt(max(limits[DriveRate.TOTAL] ** 2 - across * across, 0.0)),
            )
            / fast
        )
        low = max(low, -most - hull[i, HandleHull.GROWTH_LOW] * square)
        high = min(high, most - hull[i, HandleHull.GROWTH_HIGH] * square)
    return (low, high) if low <= high else (1.0, -1.0)


@kernel
def tabulate(hull: FloatArray, limits: FloatArray, square: float, table: FloatArray) -> float:
    """The greatest square of speed allowed in the step of a hull, not above `square`.

    Fills table, (NODES, 2), with the accelerations allowed from 0 to there. Between two nodes straight
    lines stay inside of what is allowed, as that is convex.
    """
    low, high = 0.0, square
    least, greatest = allowed(hull, limits, square)
    if least <= greatest:
        low = square
    for _ in range(SPEED_HALVINGS):
        if low == square:
            break
        middle = 0.5 * (low + high)
        least, greatest = allowed(hull, limits, middle)
        if least <= greatest:
            low = middle
        else:
            high = middle
    for k in range(SPEED_NODES):
        table[k, 0], table[k, 1] = allowed(hull, limits, min(low * k / (SPEED_NODES - 1), low))
    return low


@kernel
def between(table: FloatArray, n: int, most: float, square: float, side: int) -> float:
    """The least (side 0) or greatest (side 1) acceleration allowed in step n with a square of speed."""
    place = min(square / most, 1.0) * (SPEED_NODES - 1) if most > 0.0 else 0.0
    k = min(int(place), SPEED_NODES - 2)
    share = place - k
    return float((1.0 - share) * table[n, k, side] + share * table[n, k + 1, side])


@kernel
def passable(table: FloatArray, n: int, most: float, start: float, end: float, length: float) -> bool:
    """Whether the head may go through step n with these squares of speed at its start and end."""
    rate = 0.5 * (end - start) / length
    low = max(between(table, n, most, start, 0), between(table, n, most, end, 0))
    high = min(between(table, n, most, start, 1), between(table, n, most, end, 1))
    return start <= most and end <= most and low <= rate <= high


@kernel
def fastest_end(
    table: FloatArray, n: int, most: float, start: float, known: float, end: float, length: float
) -> float:
    """The greatest square of speed at the end of step n, from `known`, which is passable, to `end`."""
    if passable(table, n, most, start, end, length):
        return end
    for _ in range(SPEED_HALVINGS):
        middle = 0.5 * (known + end)
        if passable(table, n, most, start, middle, length):
            known = middle
        else:
            end = middle
    return known


@kernel
def way_on(table: FloatArray, n: int, most: float, start: float, end: float, length: float) -> float:
    """A square of speed at the end of step n, at most `end`, that is passable; -1 if none was found."""
    if passable(table, n, most, start, end, length):
        return end
    low, high = 0.0, min(end, start + 2.0 * length * between(table, n, most, start, 1))
    for _ in range(SPEED_HALVINGS):  # the greatest that keeps what acceleration is allowed at most
        middle = 0.5 * (low + high)
        if 0.5 * (middle - start) / length <= between(table, n, most, middle, 1):
            low = middle
        else:
            high = middle
    return low if passable(table, n, most, start, low, length) else -1.0


@kernel
def controllable(
    table: FloatArray, most: FloatArray, lengths: FloatArray, starts: FloatArray, ends: FloatArray
) -> None:
    """Fill starts with squares of speed from which the rest can be walked, ends with how to go on.

    starts is (steps + 1,), ends (steps,): from starts[n] the head may go on to ends[n].
    """
    steps = lengths.shape[0]
    starts[steps] = most[steps - 1]
    for n in range(steps - 1, -1, -1):
        top = min(most[n], most[max(n - 1, 0)])
        end = min(starts[n + 1], most[n])
        starts[n], ends[n] = top, way_on(table, n, most[n], top, end, lengths[n])
        if ends[n] >= 0.0:
            continue
        starts[n], ends[n] = 0.0, 0.0
        for _ in range(SPEED_HALVINGS):
            middle = 0.5 * (starts[n] + top)
            known = way_on(table, n, most[n], middle, end, lengths[n])
            if known >= 0.0:
                starts[n], ends[n] = middle, known
            else:
                top = middle


@kernel
def fastest_pace(
    table: FloatArray, most: FloatArray, lengths: FloatArray, starts: FloatArray, ends: FloatArray,
    squares: FloatArray,
) -> None:  # fmt: skip
    """Fill squares, (steps + 1,), with the squares of the head's speed at the ends of the steps.

    What is passable is convex: of a way on from a greater square a share is one from a smaller.
    """
    controllable(table, most, lengths, starts, ends)
    squares[0] = starts[0]
    for n in range(len(lengths)):
        known = ends[n] * squares[n] / starts[n] if starts[n] > 0.0 else 0.0
        end = min(starts[n + 1], most[n])
        squares[n + 1] = fastest_end(table, n, most[n], squares[n], known, end, lengths[n])


@entry
@allocates
def find_pace(table: Stack, most: Vector, at: Vector, times: Vector, speeds: Vector) -> int:
    """Fill times, s, and speeds, m/s, (steps + 1,), with the knots of the fastest pace.

    Returns how many, or -1 - n if no speed was found for the start of step n. The head comes to at[0]
    at time 0; knots inside a stretch of one speed are left out.
    """
    steps = len(most)
    lengths = at[1:] - at[:-1]
    squares = np.empty(steps + 1)
    fastest_pace(table, most, lengths, np.empty(steps + 1), np.empty(steps), squares)
    for n in range(steps + 1):
        if squares[n] == 0.0:
            return -1 - n
        speeds[n] = math.sqrt(squares[n])
    time, before, count = 0.0, speeds[0], 1
    times[0] = 0.0
    for n in range(steps):
        now = speeds[n + 1]
        time += 2.0 * lengths[n] / (now + before)
        if n + 1 == steps or not before == now == speeds[n + 2]:
            times[count], speeds[count], count = time, now, count + 1
        before = now
    return count
