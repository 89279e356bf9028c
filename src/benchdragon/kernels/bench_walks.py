"""What each bench of a dance does: how it turns and how fast, and which bench comes nearest to it.

A walk is processed in slices of its times. Each bench keeps a list of pieces, one for each time at
which its front handle passes a place where the route changes its side, or a speed at which another pace
begins. At the end pieces are joined into stretches that people can follow.
"""

import math
from typing import NamedTuple

import numpy as np

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.bends import turned_by
from benchdragon.kernels.box import nearest_each
from benchdragon.kernels.chain import Placements, march
from benchdragon.kernels.curve import FloatArray, RouteRow, length_at
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.numbered import Numbered

# Tolerance of the time at which something is passed, s, and the most evaluations to find it: some ten
# suffice, and after the last one the best time so far is returned.
TIME_TOLERANCE, MOST_TIME_LOOKS = 1e-6, 100
# Rounding of a time, as a share, and the smallest normal number: a root is not resolved further.
TIME_ROUNDING, LEAST = 4.0 * 2.0**-52, 2.0**-1022
# Work to time one passing, for each handle up to the one that passes: so many evaluations.
LOOKS = 8
# People cannot follow stretches shorter than this, s: each is joined to the longer of its neighbours.
SHORTEST = 1.0
# Distances that differ by less than this, m, count as equal, and the earlier one is reported: in a
# steady coil they stay the same for long, and rounding must not choose the moment.
LEVEL_DISTANCES = 1e-6


class PacePiece(Numbered):
    """Columns of pieces; the first rows are the pieces that benches begin with.

    The time at which it begins, s, the handle's position then, m, and speed, m/s, the side to which the
    route bends, the pace, the least and the greatest speed seen, and the row of the next piece; joining
    adds the row of the piece before.
    """

    TIME, WAY, SPEED, SIDE, PACE, SLOW, FAST, NEXT, BEFORE = range(9)


PACE_PIECE_COLUMNS = len(PacePiece)


class BenchRow(Numbered):
    """Columns of benches.

    The row of the last piece; the handle's last position, m, and speed, m/s; the least distance to
    another coil, m, its bench (from 0, or -1) and number of that time; a lower bound of it, m.
    """

    LAST, END_WAY, END_SPEED, NEAREST, PARTNER, AT, FLOOR = range(7)


BENCH_ROW_COLUMNS = len(BenchRow)


class PaceStretch(Numbered):
    """Columns of stretches: bench, from 0; start, end, s; side; pace; way, m; angle, rad; speeds."""

    BENCH, START, END, TURN, STEPS, FAR, ANGLE, LOW, HIGH = range(9)


PACE_STRETCH_COLUMNS = len(PaceStretch)
NOBODY = -1


class Line(NamedTuple):
    """A dragon on a route, and the places and speeds that its front handles may pass."""

    rows: Table
    links: Vector
    sizes: Table
    bends: Vector  # route positions from which the route bends to each side, m: see find_bends
    sides: IntVector  # and to which
    gates: Vector  # speeds from which each pace but the first begins, m/s


class Seen(NamedTuple):
    """A slice of a walk; tables are (handles, times). Between two times the head's speed is linear."""

    times: Vector  # s
    heads: Vector  # where the head is, m
    paces: Vector  # and how fast, m/s
    s: Table
    ratio: Table
    x: Table
    y: Table


class Known(NamedTuple):
    """What is known so far, and scratch: slots of all handles."""

    pieces: Table
    benches: Table
    tally: IntVector  # of pieces, (1,)
    at: Vector
    places: Placements


@kernel
def count_up_to(gates: FloatArray, value: float) -> int:
    """How many numbers of an increasing row are at most a value."""
    low, high = 0, gates.shape[0]
    while low < high:
        middle = (low + high) // 2
        if gates[middle] <= value:
            low = middle + 1
        else:
            high = middle
    return low


@kernel
def value_at(seen: Seen, k: int, t: int, fast: bool) -> float:
    """The speed of handle k at time number t, m/s; or its position, m."""
    return seen.ratio[k, t] * seen.paces[t] if fast else seen.s[k, t]


@entry
def count_passed(line: Line, seen: Seen) -> tuple[int, float]:
    """Count what front handles pass in a slice; return that, and the work to time it, in handles."""
    passed, work = 0, 0.0
    for k in range(line.links.shape[0]):
        was, pace = 0, 0
        for t in range(seen.times.shape[0]):
            n = count_up_to(line.bends, value_at(seen, k, t, False))
            m = count_up_to(line.gates, value_at(seen, k, t, True))
            if t > 0:
                passed += abs(n - was) + abs(m - pace)
                work += LOOKS * (k + 1.0) * (abs(n - was) + abs(m - pace))
            was, pace = n, m
    return passed, work


@kernel
def state_at(line: Line, seen: Seen, known: Known, k: int, t: int, time: float) -> tuple[float, float]:
    """Route position, m, and speed, m/s, of handle k at a time, s, after time number t."""
    at, places, ahead = known.at, known.places, time - seen.times[t]
    rate = (seen.paces[t + 1] - seen.paces[t]) / (seen.times[t + 1] - seen.times[t])
    at[0] = seen.heads[t] + (seen.paces[t] + 0.5 * rate * ahead) * ahead
    march(line.rows, line.links[: max(k, 1)], at, 0, 1, places)
    j, u = places.row[k, 0], places.u[k, 0]
    s = line.rows[j, RouteRow.S_START] + length_at(line.rows, j, u)
    return s, places.ratio[k, 0] * (seen.paces[t] + rate * ahead)


@kernel
def moment(line: Line, seen: Seen, known: Known, k: int, t: int, fast: bool, aim: float) -> float:
    """The time, s, between times number t and t + 1 at which handle k passes a place, or a speed.

    By Chandrupatla's method (Advances in Engineering Software 28, 1997). NaN if a chain has no place.
    """
    x1, x2 = seen.times[t], seen.times[t + 1]
    f1, f2 = value_at(seen, k, t, fast) - aim, value_at(seen, k, t + 1, fast) - aim
    x3, f3, best = x2, f2, x2
    for _look in range(MOST_TIME_LOOKS):
        best = x1 if abs(f1) < abs(f2) else x2
        wide, near = abs(x2 - x1), abs(best) * TIME_ROUNDING + TIME_TOLERANCE
        if min(abs(f1), abs(f2)) <= LEAST or (f1 < 0.0) == (f2 < 0.0) or wide < near:
            break
        share = 0.5
        if f3 != f1 and f3 != f2:
            xi, phi, alpha = (x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2), (x3 - x1) / (x2 - x1)
            if 1.0 - math.sqrt(1.0 - xi) < phi < math.sqrt(xi):
                share = f1 / (f1 - f2) * f3 / (f3 - f2) - alpha * f1 / (f3 - f1) * f2 / (f2 - f3)
        edge = 0.5 * near / wide
        x = x1 + min(max(share, edge), 1.0 - edge) * (x2 - x1)
        s, speed = state_at(line, seen, known, k, t, x)
        f = (speed if fast else s) - aim
        if f != f:
            return math.nan
        x3, f3 = x2, f2
        if (f < 0.0) == (f1 < 0.0):
            x3, f3 = x1, f1
        else:
            x2, f2 = x1, f1
        x1, f1 = x, f
    return best


@kernel
def add_piece(known: Known, time: float, s: float, speed: float) -> int:
    """Add a piece without side and pace; returns its row."""
    pieces, row = known.pieces, known.tally[0]
    known.tally[0] = row + 1
    pieces[row, PacePiece.TIME] = time
    pieces[row, PacePiece.WAY] = s
    pieces[row, PacePiece.SPEED] = speed
    pieces[row, PacePiece.SIDE] = pieces[row, PacePiece.PACE] = math.nan
    pieces[row, PacePiece.SLOW] = math.inf
    pieces[row, PacePiece.FAST] = -math.inf
    pieces[row, PacePiece.NEXT] = -1.0
    return row


@kernel
def link_pieces(known: Known, k: int, first: int) -> None:
    """Sort the pieces from row `first` on, all of bench k, by time, and append them to its list."""
    pieces, benches = known.pieces, known.benches
    for n in range(first, known.tally[0]):
        m = n
        while m > first and pieces[m, PacePiece.TIME] < pieces[m - 1, PacePiece.TIME]:
            for column in range(PACE_PIECE_COLUMNS):
                held = pieces[m, column]
                pieces[m, column] = pieces[m - 1, column]
                pieces[m - 1, column] = held
            m -= 1
    for n in range(first, known.tally[0]):
        last = int(benches[k, BenchRow.LAST])
        pieces[last, PacePiece.NEXT], benches[k, BenchRow.LAST] = n, n
        for column in (PacePiece.SIDE, PacePiece.PACE):
            if pieces[n, column] != pieces[n, column]:
                pieces[n, column] = pieces[last, column]


@kernel
def pass_gates(line: Line, seen: Seen, known: Known, k: int, t: int) -> bool:
    """Begin a piece at each passing of handle k between times t and t + 1; False if it has no place."""
    first, pieces = known.tally[0], known.pieces
    for fast in (False, True):
        gates = line.gates if fast else line.bends
        n = count_up_to(gates, value_at(seen, k, t, fast))
        last = count_up_to(gates, value_at(seen, k, t + 1, fast))
        while n != last:
            aim = gates[n] if n < last else gates[n - 1]
            n += 1 if n < last else -1
            time = moment(line, seen, known, k, t, fast, aim)
            if time != time:
                return False
            s, speed = state_at(line, seen, known, k, t, time)
            row = add_piece(known, time, s, speed)
            if fast:
                pieces[row, PacePiece.PACE] = n
            else:
                pieces[row, PacePiece.SIDE] = line.sides[n - 1]
    link_pieces(known, k, first)
    return True


@kernel
def see_speed(known: Known, k: int, s: float, speed: float) -> None:
    """Record the position, m, and speed, m/s, of handle k in its last piece."""
    pieces, row = known.pieces, int(known.benches[k, BenchRow.LAST])
    pieces[row, PacePiece.SLOW], pieces[row, PacePiece.FAST] = (
        min(pieces[row, PacePiece.SLOW], speed),
        max(pieces[row, PacePiece.FAST], speed),
    )
    known.benches[k, BenchRow.END_WAY], known.benches[k, BenchRow.END_SPEED] = s, speed


@entry
def look_at_benches(
    line: Line, seen: Seen, first: int, reach: float, straight: float, lever: float, known: Known
) -> bool:
    """Process a slice whose time 0 is number `first` of the walk and the last time of the slice before.

    `known` must have room for as many further pieces as `count_passed` says, and at first for one a
    bench. Other benches are searched for within `reach`, m, except those closer than `straight`, m,
    along the straightened dragon. A point of a bench moves at most `lever` times as far as its handles.
    Returns False if the dragon cannot be placed with its head at known.at[0], m.
    """
    count = line.links.shape[0]
    for k in range(count if first == 0 else 0):
        speed = value_at(seen, k, 0, True)
        row = add_piece(known, seen.times[0], seen.s[k, 0], speed)
        known.pieces[row, PacePiece.SIDE] = line.sides[count_up_to(line.bends, seen.s[k, 0]) - 1]
        known.pieces[row, PacePiece.PACE] = count_up_to(line.gates, speed)
        known.benches[k, BenchRow.LAST], known.benches[k, BenchRow.PARTNER] = row, NOBODY
        known.benches[k, BenchRow.NEAREST] = known.benches[k, BenchRow.FLOOR] = math.inf
        see_speed(known, k, seen.s[k, 0], speed)
    for k in range(count):
        for t in range(seen.times.shape[0] - 1):
            if not pass_gates(line, seen, known, k, t):
                return False
            see_speed(known, k, seen.s[k, t + 1], value_at(seen, k, t + 1, True))
    see_nearest(line, seen, first, reach, straight, lever, known.benches)
    return True


@kernel
@allocates
def see_nearest(
    line: Line, seen: Seen, first: int, reach: float, straight: float, lever: float, benches: FloatArray
) -> None:
    """Update the nearest bench to each in a slice, and lower bounds of distances between its times.

    Two benches that are a and b apart at two times, and whose points move by at most p and q in
    between, come no nearer to one another than (a + b - p - q)/2.
    """
    count, times, s = line.links.shape[0], seen.times.shape[0], seen.s
    distance, partner = np.empty((times, count)), np.empty((times, count), dtype=np.int64)
    moved = np.empty(count)
    for t in range(times):
        nearest_each(line.sizes, seen.x, seen.y, t, reach, straight, distance, partner)
        farthest = 0.0
        for k in range(count if t > 0 else 0):
            moved[k] = lever * max(s[k, t] - s[k, t - 1], s[k + 1, t] - s[k + 1, t - 1])
            farthest = max(farthest, moved[k])
        for k in range(count):
            near = distance[t, k]
            if near < benches[k, BenchRow.NEAREST] - LEVEL_DISTANCES:
                benches[k, BenchRow.NEAREST], benches[k, BenchRow.PARTNER] = near, partner[t, k]
                benches[k, BenchRow.AT] = first + t
            floor = min(near, reach)
            if t > 0:
                floor = 0.5 * (floor + min(distance[t - 1, k], reach) - moved[k] - farthest)
            if t > 0 or times == 1:
                benches[k, BenchRow.FLOOR] = min(benches[k, BenchRow.FLOOR], floor)


@kernel
def set_least(tree: FloatArray, n: int, value: float) -> None:
    """Set leaf n of a segment tree of minima, whose leaves are the second half of the array."""
    n += tree.shape[0] // 2
    tree[n] = value
    while n > 1:
        n //= 2
        tree[n] = min(tree[2 * n], tree[2 * n + 1])


@kernel
def place_of_least(tree: FloatArray) -> int:
    """The number of the first leaf that holds the least value of a tree."""
    n = 1
    while n < tree.shape[0] // 2:
        n = 2 * n if tree[2 * n] <= tree[2 * n + 1] else 2 * n + 1
    return n - tree.shape[0] // 2


@kernel
def alike(line: FloatArray, one: int, other: int) -> bool:
    """Whether two pieces are of one side and one pace."""
    return bool(
        line[one, PacePiece.SIDE] == line[other, PacePiece.SIDE]
        and line[one, PacePiece.PACE] == line[other, PacePiece.PACE]
    )


@kernel
def absorb(line: FloatArray, tree: FloatArray, n: int) -> None:
    """Join the piece after piece n to it."""
    gone = int(line[n, PacePiece.NEXT])
    after = int(line[gone, PacePiece.NEXT])
    line[n, PacePiece.NEXT], line[after, PacePiece.BEFORE] = after, n
    line[n, PacePiece.SLOW] = min(line[n, PacePiece.SLOW], line[gone, PacePiece.SLOW])
    line[n, PacePiece.FAST] = max(line[n, PacePiece.FAST], line[gone, PacePiece.FAST])
    set_least(tree, gone, math.inf)
    set_least(tree, n, line[after, PacePiece.TIME] - line[n, PacePiece.TIME])


@kernel
def join_short(line: FloatArray, tree: FloatArray, count: int) -> int:
    """Join pieces too short for people to follow; returns how many are left, linked from the first on.

    The shortest piece, of several the first, is joined to the longer of its neighbours, again and
    again. No two neighbours are alike before and after. line[count] is the end of all.
    """
    for n in range(tree.shape[0]):
        tree[n] = math.inf
    for n in range(count):
        line[n, PacePiece.NEXT], line[n, PacePiece.BEFORE] = n + 1, n - 1
        set_least(tree, n, line[n + 1, PacePiece.TIME] - line[n, PacePiece.TIME])
    left, leaves = count, tree.shape[0] // 2
    while left > 1 and tree[1] < SHORTEST:
        n = place_of_least(tree)
        low, high = int(line[n, PacePiece.BEFORE]), int(line[n, PacePiece.NEXT])
        if low < 0 or (high < count and tree[leaves + high] > tree[leaves + low]):
            line[n, PacePiece.SIDE], line[n, PacePiece.PACE] = (
                line[high, PacePiece.SIDE],
                line[high, PacePiece.PACE],
            )
        else:
            n = low
        absorb(line, tree, n)
        left -= 1
        # The joined piece may now be like its neighbour on the other side.
        low, high = int(line[n, PacePiece.BEFORE]), int(line[n, PacePiece.NEXT])
        if low >= 0 and alike(line, low, n):
            n, high = low, n
        if high < count and alike(line, n, high):
            absorb(line, tree, n)
            left -= 1
    return left


@kernel
def line_of(known: Known, k: int, end: float, line: FloatArray) -> int:
    """Fill a line with the pieces of bench k, like ones joined, and its end; returns their number."""
    pieces, count, row = known.pieces, 0, k
    while row >= 0:
        for column in range(PACE_PIECE_COLUMNS):
            line[count, column] = pieces[row, column]
        if count > 0 and alike(line, count - 1, count):
            line[count - 1, PacePiece.SLOW] = min(
                line[count - 1, PacePiece.SLOW], line[count, PacePiece.SLOW]
            )
            line[count - 1, PacePiece.FAST] = max(
                line[count - 1, PacePiece.FAST], line[count, PacePiece.FAST]
            )
        else:
            count += 1
        row = int(pieces[row, PacePiece.NEXT])
    line[count, PacePiece.TIME], line[count, PacePiece.WAY] = end, known.benches[k, BenchRow.END_WAY]
    line[count, PacePiece.SPEED] = known.benches[k, BenchRow.END_SPEED]
    return count


@entry
@allocates
def tell_stretches(rows: Table, turned: Vector, end: float, known: Known, out: Table) -> int:
    """Fill rows of `out` with the stretches of all benches, the head's first; returns their number.

    They are no more than pieces. `turned` is that of `find_bends`; the dance ends at `end`, s.
    """
    most, told = known.tally[0] - known.benches.shape[0] + 1, 0
    line = np.empty((most + 2, PACE_PIECE_COLUMNS))
    for k in range(known.benches.shape[0]):
        count, leaves = line_of(known, k, end, line), 1
        while leaves < count:
            leaves *= 2
        left = join_short(line, np.empty(2 * leaves), count)
        n, angle = 0, turned_by(rows, turned, line[0, PacePiece.WAY])
        for _piece in range(left):
            after = int(line[n, PacePiece.NEXT])
            turned_to = turned_by(rows, turned, line[after, PacePiece.WAY])
            out[told, PaceStretch.BENCH] = k
            out[told, PaceStretch.START] = line[n, PacePiece.TIME]
            out[told, PaceStretch.END] = line[after, PacePiece.TIME]
            out[told, PaceStretch.TURN] = line[n, PacePiece.SIDE]
            out[told, PaceStretch.STEPS] = line[n, PacePiece.PACE]
            out[told, PaceStretch.FAR] = line[after, PacePiece.WAY] - line[n, PacePiece.WAY]
            out[told, PaceStretch.ANGLE] = turned_to - angle
            out[told, PaceStretch.LOW] = min(
                line[n, PacePiece.SLOW], line[n, PacePiece.SPEED], line[after, PacePiece.SPEED]
            )
            out[told, PaceStretch.HIGH] = max(
                line[n, PacePiece.FAST], line[n, PacePiece.SPEED], line[after, PacePiece.SPEED]
            )
            n, angle, told = after, turned_to, told + 1
    return told
