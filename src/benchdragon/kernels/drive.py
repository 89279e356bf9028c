"""Speeds, turning rates and accelerations of a dragon, by the drive of its head.

While the head's acceleration a is constant, the square q of its speed follows a straight line over its
place sigma, dq / dsigma = 2 a. With w = ds_i / dsigma and g = d log w / dsigma, handle i has the speed
w sqrt(q), the acceleration w (a + g q) along the route and w^2 q times the curvature across it.

Where a handle crosses a joint at which the curvature jumps, g jumps for all handles behind it. What
they have just before and just after counts, and nothing in between: a step over such joints is bounded
side by side, each side with its own curvatures.
"""

import math
from typing import NamedTuple

from benchdragon.kernels import motion_bounds as bounds
from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import FloatArray, RouteRow, curvature, stretch
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.motion_bounds import HandleBound
from benchdragon.kernels.numbered import Numbered


class DriveRate(Numbered):
    """Bounded quantities: speeds and accelerations of handles, turning rates of benches."""

    SPEEDS = 0
    TURNING = 1
    ACROSS = 2
    TOTAL = 3
    ALONG = 4


QUANTITIES = len(DriveRate)


class DriveStep(Numbered):
    """Columns of a drive, one row a step of the head."""

    FROM = 0  # square of the head's speed at the step's start, m^2/s^2
    TO = 1  # at its end
    RATE = 2  # the head's acceleration, m/s^2


DRIVE_COLUMNS = len(DriveStep)

# Curvatures that differ by more at a joint jump there, 1/m.
JUMP = 1e-9
# So near a joint, as a share of the route position, rounding hides on which side a handle stands: 512
# roundings of it.
JOINT_ROUNDING = 2.0**-44
# The most handles crossing jumps in a step that are distinguished; others are bounded on both sides.
MOST_JUMPS = 3


@kernel
def lesser(a: float, b: float) -> float:
    """The lesser of two numbers; NaN if either is, so that no bound is lost."""
    return a if a <= b or math.isnan(a) else b


@kernel
def greater(a: float, b: float) -> float:
    """The greater of two numbers; NaN if either is."""
    return a if a >= b or math.isnan(a) else b


@kernel
def value_at(
    ratio: float, change: float, turn: float, bend: float, square: float, rate: float, quantity: int
) -> float:
    """A quantity's size: of a handle, or of the bench behind it, from its speed ratio and its rates.

    change = d2 s_i / dsigma^2 and turn = d heading / dsigma, 1/m; bend is the route's curvature there.
    """
    if quantity == DriveRate.SPEEDS:
        return ratio * math.sqrt(square)
    if quantity == DriveRate.TURNING:
        return abs(turn) * math.sqrt(square)
    along = abs(ratio * rate + change * square)
    if quantity == DriveRate.ALONG:
        return along
    across = ratio * ratio * square * abs(bend)
    return across if quantity == DriveRate.ACROSS else math.hypot(along, across)


@kernel
def greatest_in_slot(
    rows: FloatArray, places: Placements, change: FloatArray, turn: FloatArray, t: int, links: int,
    square: float, rate: float, quantity: int,
) -> tuple[float, int]:  # fmt: skip
    """The greatest of a quantity in slot t up to so many links, and its handle or bench.

    With the square of the head's speed and its acceleration; change = d2 s_i / dsigma^2 and turn are
    `chain.rates`'.
    """
    curved, most, where = quantity in (DriveRate.ACROSS, DriveRate.TOTAL), -1.0, 0
    for i in range(links + 1):
        bend = curvature(rows, places.row[i, t], places.u[i, t]) if curved else 0.0
        turned = turn[i, t] if i < links else 0.0  # no bench is behind the last handle
        value = value_at(places.ratio[i, t], change[i, t], turned, bend, square, rate, quantity)
        if value > most:
            most, where = value, i
    return most, where


class Scratch(NamedTuple):
    """Scratch for bounds over a step."""

    table: Table  # of `motion_bounds.bound_handles`
    bend: Table  # least and greatest curvature at each handle, 1/m, (handles, 2)
    rates: Table  # of `side_rates`, (handles, 2)
    crossing: IntVector  # of `find_jumps`
    sides: Table  # and one row of scratch
    most: Vector  # of `bound_step`, (handles,)
    beside: Vector  # how near a jump, m, rounding may hide a handle's side: at the step's ends, (2,)


@kernel
def jump_row(rows: FloatArray, first: int, last: int) -> int:
    """The first row from first on, before last, at whose end the curvature jumps; -1 without one."""
    for j in range(first, last):
        before = curvature(rows, j, rows[j, RouteRow.U_END])
        after = curvature(rows, j + 1, rows[j + 1, RouteRow.U_START])
        if abs(after - before) > JUMP:
            return j
    return -1


@kernel
def jump_beside(rows: FloatArray, j: int, u: float, near: float) -> int:
    """The row before the joint beside u of row j at which the curvature jumps; -1 without one.

    Within `near` metres, and what rounding makes of the route position there.
    """
    metres = stretch(rows, j, u)
    near = near / metres + JOINT_ROUNDING * (abs(rows[j, RouteRow.S_START]) / metres + abs(u))
    if (
        j + 1 < rows.shape[0]
        and abs(rows[j, RouteRow.U_END] - u) <= near
        and jump_row(rows, j, j + 1) == j
    ):
        return j
    if j > 0 and abs(u - rows[j, RouteRow.U_START]) <= near and jump_row(rows, j - 1, j) == j - 1:
        return j - 1
    return -1


@kernel
def way_of(
    rows: FloatArray, places: Placements, i: int, a: int, b: int, beside: FloatArray
) -> tuple[int, float, int, float]:
    """From where to where handle i may walk from slot a to slot b: row and parameter, twice.

    Where it stands within `beside`, m, of a jump of the curvature at either end, it may exactly stand
    on the other side.
    """
    first, u, last, v = places.row[i, a], places.u[i, a], places.row[i, b], places.u[i, b]
    for n in range(2):
        slot = b if n else a
        k = jump_beside(rows, places.row[i, slot], places.u[i, slot], beside[n])
        if 0 <= k < first:
            first, u = k, rows[k, RouteRow.U_END]
        if k >= last:
            last, v = k + 1, rows[k + 1, RouteRow.U_START]
    return first, u, last, v


@kernel
def find_jumps(
    rows: FloatArray, places: Placements, a: int, b: int, links: int, scratch: Scratch
) -> int:
    """How many handles cross a jump from slot a to slot b without a kink; at most MOST_JUMPS.

    Only the first `links` + 1 count. Fills scratch.crossing with them and scratch.sides with least and
    greatest curvature before it and after it. A handle so near a jump that rounding hides its side
    crosses it, too: so all orders count in which handles may cross jumps at once.
    """
    table, crossing, sides, count = scratch.table, scratch.crossing, scratch.sides, 0
    for i in range(links + 1):
        if not table[i, HandleBound.LEFT] - table[i, HandleBound.RIGHT] < math.inf:
            continue
        first, u, last, v = way_of(rows, places, i, a, b, scratch.beside)
        j, side = jump_row(rows, first, last), sides[min(count, MOST_JUMPS)]
        if j < 0:
            continue
        side[0], side[1] = bounds.curvature_range(rows, first, u, j, rows[j, RouteRow.U_END])
        side[2], side[3] = bounds.curvature_range(rows, j + 1, rows[j + 1, RouteRow.U_START], last, v)
        if count < MOST_JUMPS:
            crossing[count] = i
            count += 1
        else:
            table[i, HandleBound.RIGHT] = min(table[i, HandleBound.RIGHT], side[0], side[2])
            table[i, HandleBound.LEFT] = max(table[i, HandleBound.LEFT], side[1], side[3])
    return count


@kernel
def side_rates(links: int, table: FloatArray, bend: FloatArray, rates: FloatArray) -> None:
    """Fill rates, (handles, 2), with least and greatest d log(ds_i / dsigma) / dsigma, 1/m.

    For any moment of the step in `table` at which every handle's curvature lies within bend[i]; see
    `step_bounds.bound_rates`.
    """
    rates[0, 0], rates[0, 1] = 0.0, 0.0
    for i in range(links):
        if not table[i + 1, HandleBound.SPEED] < math.inf:
            for k in range(i + 1, links + 1):
                rates[k, 0], rates[k, 1] = -math.inf, math.inf
            return
        turn = table[i + 1, HandleBound.TURN_LOW], table[i + 1, HandleBound.TURN_HIGH]
        slow, fast = table[i, HandleBound.SLOWEST], table[i, HandleBound.SPEED]
        low, high = bounds.angle_rates(slow, fast, bend[i, 0], bend[i, 1], turn)
        front_low, front_high = bounds.product(
            table[i + 1, HandleBound.FRONT_LOW], table[i + 1, HandleBound.FRONT_HIGH], low, high
        )
        slow, fast = table[i + 1, HandleBound.SLOWEST], table[i + 1, HandleBound.SPEED]
        low, high = bounds.angle_rates(slow, fast, bend[i + 1, 0], bend[i + 1, 1], turn)
        rear_low, rear_high = bounds.product(
            table[i + 1, HandleBound.REAR_LOW], table[i + 1, HandleBound.REAR_HIGH], low, high
        )
        rates[i + 1, 0] = rates[i, 0] - front_high + rear_low
        rates[i + 1, 1] = rates[i, 1] - front_low + rear_high


@kernel
def most_of_handle(
    fast: float, low: float, high: float, bend: float, drive: FloatArray, quantity: int
) -> float:
    """Upper bound of a quantity of a handle of speed ratio at most `fast`; infinite if unbounded.

    The least and the greatest d log(ds_i / dsigma) / dsigma are low and high, 1/m, and `bend` is the
    greatest size of the curvature. Of a bench `fast` is its turning rate, rad/m.
    """
    least_square = min(drive[DriveStep.FROM], drive[DriveStep.TO])
    square = max(drive[DriveStep.FROM], drive[DriveStep.TO])
    if quantity in (DriveRate.SPEEDS, DriveRate.TURNING):
        value = fast * math.sqrt(square) if square > 0.0 else 0.0
    else:
        across = fast * fast * square * bend
        low, high = bounds.scaled(least_square, square, low, high)
        along = fast * bounds.magnitude(drive[DriveStep.RATE] + low, drive[DriveStep.RATE] + high)
        value = math.hypot(along, across)
        if quantity != DriveRate.TOTAL:
            value = along if quantity == DriveRate.ALONG else across
    return value if value < math.inf else math.inf  # an infinite rate and no speed make no number


@kernel
def bound_side(links: int, drive: FloatArray, quantity: int, scratch: Scratch) -> None:
    """Raise scratch.most to what handles do while every handle's curvature lies within bend[i].

    GROWTH_LOW and GROWTH_HIGH of the table are widened by what their rates then are.
    """
    table, bend, rates, most = scratch.table, scratch.bend, scratch.rates, scratch.most
    side_rates(links, table, bend, rates)
    for i in range(links + 1):
        low, high = rates[i, 0], rates[i, 1]
        bent = bounds.magnitude(bend[i, 0], bend[i, 1])
        value = most_of_handle(table[i, HandleBound.SPEED], low, high, bent, drive, quantity)
        most[i] = max(most[i], bounds.ROUNDED_UP * value)
        table[i, HandleBound.GROWTH_LOW] = lesser(table[i, HandleBound.GROWTH_LOW], low)
        table[i, HandleBound.GROWTH_HIGH] = greater(table[i, HandleBound.GROWTH_HIGH], high)


@kernel
def bound_sides(
    rows: FloatArray, places: Placements, a: int, b: int, links: int, drive: FloatArray, quantity: int,
    scratch: Scratch,
) -> None:  # fmt: skip
    """Fill scratch.most for an acceleration: over all sides of the jumps that are crossed."""
    table, bend, crossing, sides = scratch.table, scratch.bend, scratch.crossing, scratch.sides
    jumps = find_jumps(rows, places, a, b, links, scratch)
    for i in range(links + 1):
        bend[i, 0], bend[i, 1] = table[i, HandleBound.RIGHT], table[i, HandleBound.LEFT]
        table[i, HandleBound.GROWTH_LOW], table[i, HandleBound.GROWTH_HIGH] = math.inf, -math.inf
        scratch.most[i] = 0.0
    for side in range(1 << jumps):
        for n in range(jumps):
            after = side >> n & 1
            bend[crossing[n], 0] = sides[n, 2 * after]
            bend[crossing[n], 1] = sides[n, 2 * after + 1]
        bound_side(links, drive, quantity, scratch)


@kernel
def bound_step(
    rows: FloatArray, links: FloatArray, places: Placements, a: int, b: int, drive: FloatArray,
    quantity: int, scratch: Scratch,
) -> None:  # fmt: skip
    """Fill scratch.most with the greatest value of each handle from slot a to slot b.

    A bench's value counts at its rear handle. The table holds the handles' bounds; for accelerations
    its GROWTH_LOW and GROWTH_HIGH are drawn tighter, side by side of the jumps that are crossed.
    """
    count, table, most = links.shape[0], scratch.table, scratch.most
    if drive[DriveStep.FROM] == 0.0 and drive[DriveStep.TO] == 0.0 and drive[DriveStep.RATE] == 0.0:
        for i in range(count + 1):
            most[i] = 0.0  # a head that stands needs no bound, not even where one is infinite
        return
    bounds.bound_handles(rows, links, places, a, b, table)
    if quantity not in (DriveRate.SPEEDS, DriveRate.TURNING):
        bound_sides(rows, places, a, b, count, drive, quantity, scratch)
        return
    column = HandleBound.SPEED if quantity == DriveRate.SPEEDS else HandleBound.TURNING_RATE
    for i in range(count + 1):
        most[i] = bounds.ROUNDED_UP * most_of_handle(table[i, column], 0.0, 0.0, 0.0, drive, quantity)
