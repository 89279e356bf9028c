"""What a head's drive makes of its dragon: speeds, turning rates and accelerations.

While the head's acceleration a is constant, the square q of its speed follows a straight line over
its place sigma, dq / dsigma = 2 a. With w = ds_i / dsigma and g = d log w / dsigma, handle i has the
speed w sqrt(q), the acceleration w (a + g q) along the route and w^2 q times the curvature across it.

Where a handle crosses a joint at which the curvature jumps, g jumps for all handles behind it. What
they have just before and just after counts, and nothing in between: a step over such joints is
bounded side by side, each side with its own curvatures.
"""

import math
from typing import NamedTuple

import numpy as np

from benchdragon.kernels.arrays import IntTable, IntVector, Table, Vector
from benchdragon.kernels.curve import U_END, U_START, FloatArray, curvature
from benchdragon.kernels.jit import entry, kernel
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.step_bounds import (
    FRONT_HIGH,
    FRONT_LOW,
    GROWTH_HIGH,
    GROWTH_LOW,
    HANDLE_COLUMNS,
    LEFT,
    REAR_HIGH,
    REAR_LOW,
    RIGHT,
    ROUNDED_UP,
    SLOWEST,
    SPEED,
    TURN_HIGH,
    TURN_LOW,
    TURNING_RATE,
    Placements,
    angle_rates,
    bound_handles,
    curvature_range,
    magnitude,
    product,
    scaled,
)

# What is bounded: speeds and accelerations of handles, turning rates of benches.
SPEEDS = 0
TURNING = 1
ACROSS = 2
TOTAL = 3
ALONG = 4

# Columns of a drive, one row a step of the head.
FROM = 0  # square of the head's speed at the step's start, m^2/s^2
TO = 1  # at its end
RATE = 2  # the head's acceleration, m/s^2
DRIVE_COLUMNS = 3

# Curvatures that differ by more at a joint jump there, 1/m.
JUMP = 1e-9
# Handles that cross jumps in one step and are told apart; what more of them do is bounded at once.
MOST_JUMPS = 3


@kernel
def lesser(a: float, b: float) -> float:
    """The lesser of two numbers; none if either is none, so that no bound is lost."""
    return a if a <= b or math.isnan(a) else b


@kernel
def greater(a: float, b: float) -> float:
    """The greater of two numbers; none if either is none."""
    return a if a >= b or math.isnan(a) else b


@kernel
def value_at(
    ratio: float, change: float, turn: float, bend: float, square: float, rate: float, quantity: int
) -> float:
    """A quantity's size: of a handle, or of the bench behind it, from its speed ratio and what it does.

    change = d2 s_i / dsigma^2 and turn = d heading / dsigma, 1/m; bend is the route's curvature there.
    """
    if quantity == SPEEDS:
        return ratio * math.sqrt(square)
    if quantity == TURNING:
        return abs(turn) * math.sqrt(square)
    along = abs(ratio * rate + change * square)
    if quantity == ALONG:
        return along
    across = ratio * ratio * square * abs(bend)
    return across if quantity == ACROSS else math.hypot(along, across)


@entry
def greatest_at_ends(
    rows: Table,
    places: Placements,
    change: Table,
    turn: Table,
    slots: IntVector,
    drives: Table,
    quantity: int,
    values: Table,
    where: IntTable,
) -> None:
    """Fill values, (steps, 2), with the greatest at both ends of each step, and where with its row.

    Steps go from slots[n] to the next slot; change = d2 s_i / dsigma^2 and turn are `chain.rates`'.
    """
    ratios, row, u = places.ratio, places.row, places.u
    curved = quantity in (ACROSS, TOTAL)
    for n in range(slots.shape[0]):
        values[n, 0] = values[n, 1] = -1.0
    for i in range(ratios.shape[0]):  # handle by handle, as the chains lie in memory
        for n in range(slots.shape[0]):
            for end in range(2):
                t = slots[n] + end
                bend = curvature(rows, row[i, t], u[i, t]) if curved else 0.0
                turned = turn[i, t] if i < turn.shape[0] else 0.0  # no bench is behind the last handle
                value = value_at(
                    ratios[i, t], change[i, t], turned, bend, drives[n, FROM + end], drives[n, RATE],
                    quantity,
                )  # fmt: skip
                if value > values[n, end]:
                    values[n, end], where[n, end] = value, i


@kernel
def jump_row(rows: FloatArray, first: int, last: int) -> int:
    """The first row from first on, before last, at whose end the curvature jumps; -1 without one."""
    for j in range(first, last):
        before, after = curvature(rows, j, rows[j, U_END]), curvature(rows, j + 1, rows[j + 1, U_START])
        if abs(after - before) > JUMP:
            return j
    return -1


@kernel
def find_jumps(
    rows: FloatArray,
    places: Placements,
    a: int,
    b: int,
    table: FloatArray,
    crossing: IntArray,
    sides: FloatArray,
) -> int:
    """How many handles cross a jump from slot a to slot b without a kink; at most MOST_JUMPS.

    Fills crossing with them and sides, (jumps, 4), with least and greatest curvature before it and
    after it.
    """
    count = 0
    for i in range(table.shape[0]):
        ja, jb = places.row[i, a], places.row[i, b]
        if ja == jb or count == MOST_JUMPS or not table[i, LEFT] - table[i, RIGHT] < math.inf:
            continue
        j = jump_row(rows, ja, jb)
        if j < 0:
            continue
        end, start = rows[j, U_END], rows[j + 1, U_START]
        crossing[count] = i
        sides[count, 0], sides[count, 1] = curvature_range(rows, ja, places.u[i, a], j, end)
        sides[count, 2], sides[count, 3] = curvature_range(rows, j + 1, start, jb, places.u[i, b])
        count += 1
    return count


@kernel
def side_rates(table: FloatArray, bend: FloatArray, rates: FloatArray) -> None:
    """Fill rates, (handles, 2), with least and greatest d log(ds_i / dsigma) / dsigma, 1/m.

    For any moment of the step in `table` at which every handle's curvature lies within bend[i]; see
    `step_bounds.bound_rates`.
    """
    rates[0, 0], rates[0, 1] = 0.0, 0.0
    for i in range(table.shape[0] - 1):
        if not table[i + 1, SPEED] < math.inf:
            for k in range(i + 1, table.shape[0]):
                rates[k, 0], rates[k, 1] = -math.inf, math.inf
            return
        turn = table[i + 1, TURN_LOW], table[i + 1, TURN_HIGH]
        slow, fast = table[i, SLOWEST], table[i, SPEED]
        low, high = angle_rates(slow, fast, bend[i, 0], bend[i, 1], turn)
        front_low, front_high = product(table[i + 1, FRONT_LOW], table[i + 1, FRONT_HIGH], low, high)
        slow, fast = table[i + 1, SLOWEST], table[i + 1, SPEED]
        low, high = angle_rates(slow, fast, bend[i + 1, 0], bend[i + 1, 1], turn)
        rear_low, rear_high = product(table[i + 1, REAR_LOW], table[i + 1, REAR_HIGH], low, high)
        rates[i + 1, 0] = rates[i, 0] - front_high + rear_low
        rates[i + 1, 1] = rates[i, 1] - front_low + rear_high


@kernel
def most_speed(table: FloatArray, drive: FloatArray, quantity: int) -> float:
    """At most the quantity, a speed or a turning rate, in a step with these bounds on handles."""
    column, square = SPEED if quantity == SPEEDS else TURNING_RATE, max(drive[FROM], drive[TO])
    most = 0.0
    for i in range(table.shape[0]):
        most = greater(most, table[i, column])
    return most * math.sqrt(square) if square > 0.0 else 0.0


@kernel
def most_acceleration(
    table: FloatArray, bend: FloatArray, rates: FloatArray, drive: FloatArray, quantity: int
) -> float:
    """At most the acceleration while every handle's curvature lies within bend[i].

    Infinite where nothing bounds it.
    """
    most = 0.0
    least_square, square = min(drive[FROM], drive[TO]), max(drive[FROM], drive[TO])
    for i in range(table.shape[0]):
        fast = table[i, SPEED]
        if not fast < math.inf:
            return math.inf
        across = fast * fast * square * magnitude(bend[i, 0], bend[i, 1])
        low, high = scaled(least_square, square, rates[i, 0], rates[i, 1])
        along = fast * magnitude(drive[RATE] + low, drive[RATE] + high)
        value = math.hypot(along, across)
        if quantity != TOTAL:
            value = along if quantity == ALONG else across
        if not value < math.inf:  # an infinite rate and no speed make no number
            return math.inf
        most = max(most, value)
    return most


class Scratch(NamedTuple):
    """What bounds over a step are worked out in."""

    bend: FloatArray  # least and greatest curvature at each handle, 1/m, (handles, 2)
    rates: FloatArray  # of `side_rates`, (handles, 2)
    crossing: IntArray  # of `find_jumps`
    sides: FloatArray


@kernel
def scratch_for(handles: int) -> Scratch:
    """Scratch for a chain of so many handles."""
    return Scratch(
        np.empty((handles, 2)),
        np.empty((handles, 2)),
        np.empty(MOST_JUMPS, dtype=np.int64),
        np.empty((MOST_JUMPS, 4)),
    )


@kernel
def most_in_step(
    rows: FloatArray,
    places: Placements,
    a: int,
    b: int,
    table: FloatArray,
    drive: FloatArray,
    quantity: int,
    scratch: Scratch,
) -> float:
    """At most a quantity from slot a to slot b; `table` holds the handles' bounds.

    GROWTH_LOW and GROWTH_HIGH of the table are drawn tighter, over all sides of the jumps that are
    crossed.
    """
    if quantity in (SPEEDS, TURNING):
        return most_speed(table, drive, quantity)
    bend, rates, crossing, sides = scratch
    jumps = find_jumps(rows, places, a, b, table, crossing, sides)
    for i in range(table.shape[0]):
        bend[i, 0], bend[i, 1] = table[i, RIGHT], table[i, LEFT]
        table[i, GROWTH_LOW], table[i, GROWTH_HIGH] = math.inf, -math.inf
    most = 0.0
    for side in range(1 << jumps):
        for n in range(jumps):
            after = side >> n & 1
            bend[crossing[n], 0] = sides[n, 2 * after]
            bend[crossing[n], 1] = sides[n, 2 * after + 1]
        side_rates(table, bend, rates)
        most = max(most, most_acceleration(table, bend, rates, drive, quantity))
        for i in range(table.shape[0]):
            table[i, GROWTH_LOW] = lesser(table[i, GROWTH_LOW], rates[i, 0])
            table[i, GROWTH_HIGH] = greater(table[i, GROWTH_HIGH], rates[i, 1])
    return most


@entry
def ceilings(
    rows: Table,
    links: Vector,
    places: Placements,
    slots: IntVector,
    drives: Table,
    quantity: int,
    bounds: Vector,
) -> None:
    """Fill bounds[n] with the most that any handle or bench reaches from slots[n] to the next."""
    handles = links.shape[0] + 1
    table = np.empty((handles, HANDLE_COLUMNS))
    scratch = scratch_for(handles)
    for n in range(slots.shape[0]):
        bounds[n] = 0.0
        if drives[n, FROM] == 0.0 and drives[n, TO] == 0.0 and drives[n, RATE] == 0.0:
            continue  # who stands needs no bound, not even where one is infinite
        a, b = slots[n], slots[n] + 1
        bound_handles(rows, links, places, a, b, table)
        most = most_in_step(rows, places, a, b, table, drives[n], quantity, scratch)
        bounds[n] = ROUNDED_UP * most
