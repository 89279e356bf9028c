"""A head that stands still at places or times: the knots of its walk, from its walk without holds.

Squared speeds are linear along the way, so all of it is exact. Near a hold the head is no faster than
braking and starting at one rate allow; else it has at each place the speed of the walk without.
"""

import math
from typing import NamedTuple

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.numbered import Numbered


class HoldPiece(Numbered):
    """Columns of a piece of the way, along which the squared speed changes evenly.

    Its ends, m, the squared speeds there, and the seconds of a rest; the last piece has no end.
    """

    FIRST, LAST, BEFORE, AFTER, REST = range(5)


HOLD_PIECE_COLUMNS = len(HoldPiece)


class Knot(Numbered):
    """Of a knot: its time, s, its place, m from where the walk begins, and the speed, m/s."""

    TIME, WAY, SPEED = range(3)


KNOT_COLUMNS = len(Knot)


class HoldRow(Numbered):
    """Of a hold: its place, m, or its time, s, infinite if the other is given; its duration, s."""

    WAY, AT, SECONDS = range(3)


HOLD_COLUMNS = len(HoldRow)


class Stood(Numbered):
    """Of a hold that took place: its number, its place, m, and its start and end, s."""

    NUMBER, WAY, START, END = range(4)


STOOD_COLUMNS = len(Stood)


class HoldCount(Numbered):
    """What is counted of holds.

    Knots and holds stood so far, the hold with a trouble, and whether there was no room for a knot.
    """

    KNOTS, STOOD, TOLD, SHORT = range(4)


HOLD_COUNTS = len(HoldCount)


class HoldTrouble(Numbered):
    """The trouble with a hold that is impossible; FINE: none."""

    FINE, OVERLAP, ROOM, UNREACHABLE, OUTSIDE, OVER = range(6)


# Places nearer to one another than this are one, m; rounding of ways is far below.
SAME_PLACE = 1e-9


class Held(NamedTuple):
    """A walk with holds."""

    pieces: Table
    starts: Vector  # times at which a head starts that stands until then, s, ascending
    holds: Table  # in any order
    knots: Table
    stood: Table  # (holds, STOOD_COLUMNS)
    waiting: IntVector  # 1 for each hold that has not come yet
    counts: IntVector


@kernel
def square_at(pieces: FloatArray, p: int, way: float) -> float:
    """The squared speed at a place on piece p."""
    before, after = pieces[p, HoldPiece.BEFORE], pieces[p, HoldPiece.AFTER]
    if before == after:
        return before
    return before + (way - pieces[p, HoldPiece.FIRST]) / (
        pieces[p, HoldPiece.LAST] - pieces[p, HoldPiece.FIRST]
    ) * (after - before)


@kernel
def meets(pieces: FloatArray, p: int, way: float, slope: float) -> float:
    """Where the squared speed is that of a head which stands at `way` and gains `slope` a metre."""
    own, change = 0.0, pieces[p, HoldPiece.AFTER] - pieces[p, HoldPiece.BEFORE]
    if change != 0.0:
        own = change / (pieces[p, HoldPiece.LAST] - pieces[p, HoldPiece.FIRST])
    return math.inf if own == slope else way + square_at(pieces, p, way) / (slope - own)


@kernel
def add_knot(held: Held, n: int, time: float, way: float, speed: float) -> int:
    """Put a knot behind n others, if there is room; how many there are then."""
    if n >= held.knots.shape[0]:
        held.counts[HoldCount.SHORT] = 1
        return n
    held.knots[n, Knot.TIME], held.knots[n, Knot.WAY], held.knots[n, Knot.SPEED] = time, way, speed
    return n + 1


@kernel
def reach(held: Held, n: int, way: float, speed: float) -> int:
    """Go on from the last of n knots to a place; no knot is added where it is no later."""
    ahead, pace = way - held.knots[n - 1, Knot.WAY], 0.5 * (held.knots[n - 1, Knot.SPEED] + speed)
    time = held.knots[n - 1, Knot.TIME] + (ahead / pace if pace != 0.0 else math.inf)
    return add_knot(held, n, time, way, speed) if time > held.knots[n - 1, Knot.TIME] else n


@kernel
def next_cut(held: Held, p: int, at: float, last: float, target: float, slope: float) -> float:
    """The next place on piece p at which the squared speed bends, or where it ends."""
    now = held.knots[held.counts[HoldCount.KNOTS] - 1, Knot.WAY]
    cut = last
    bends = held.counts[HoldCount.STOOD] > 0
    if bends:
        place = meets(held.pieces, p, now, slope)
        cut = place if at < place < cut else cut
    if target < math.inf:
        place = meets(held.pieces, p, target, -slope)
        cut = place if at < place < cut else cut
        middle = 0.5 * (now + target)
        cut = middle if bends and at < middle < cut else cut
    return cut


@kernel
def go_ahead(held: Held, target: float, slope: float) -> int:
    """Lay the knots from now to a place where the head is to stand, or for ever on; their number.

    The last is at an infinite time where the head never comes to that place.
    """
    pieces, knots, n = held.pieces, held.knots, held.counts[HoldCount.KNOTS]
    now = knots[n - 1, Knot.WAY]
    if target - now <= SAME_PLACE:
        return n
    for p in range(pieces.shape[0]):
        at, last = max(pieces[p, HoldPiece.FIRST], now), min(pieces[p, HoldPiece.LAST], target)
        if pieces[p, HoldPiece.REST] != 0.0 and now < pieces[p, HoldPiece.FIRST] < target:
            n = add_knot(
                held,
                n,
                knots[n - 1, Knot.TIME] + pieces[p, HoldPiece.REST],
                pieces[p, HoldPiece.FIRST],
                0.0,
            )
        while at < last:
            at = next_cut(held, p, at, last, target, slope)
            if at == math.inf:
                break
            square = min(square_at(pieces, p, at), slope * (target - at))
            if held.counts[HoldCount.STOOD] > 0:
                square = min(square, slope * (at - now))
            n = reach(held, n, at, math.sqrt(max(square, 0.0)))
    return n


@kernel
def brake(held: Held, at: float, rate: float, end: int) -> bool:
    """Keep of the knots up to `end` those until the head stands at a time; False if there is no room.

    It brakes before as late as it can.
    """
    knots, counts = held.knots, held.counts
    now = last = counts[HoldCount.KNOTS] - 1
    while last + 1 < end and knots[last + 1, Knot.TIME] < at:
        last += 1
    t, fast = knots[last, Knot.TIME], knots[last, Knot.SPEED]
    if at == t and counts[HoldCount.STOOD] == 0:
        return True
    if last + 1 < end and knots[last + 1, Knot.TIME] < math.inf:
        fast += (at - t) / (knots[last + 1, Knot.TIME] - t) * (knots[last + 1, Knot.SPEED] - fast)
    u, w = at, fast
    for n in range(last, now - 1, -1):
        t, v = knots[n, Knot.TIME], knots[n, Knot.SPEED]
        early, late = v - rate * (at - t), w - rate * (at - u)
        if early <= 0.0:
            brakes = t if early == 0.0 else t + (u - t) * early / (early - late)
            speed = rate * (at - brakes)
            place = knots[n, Knot.WAY] + 0.5 * (v + speed) * (brakes - t)
            stops = place + 0.5 * speed * (at - brakes)
            count = add_knot(held, n + 1, brakes, place, speed) if t < brakes < at else n + 1
            counts[HoldCount.KNOTS] = add_knot(held, count, at, stops, 0.0)
            return True
        u, w = t, v
    return False


@kernel
def stand(held: Held, hold: int) -> int:
    """Stand from now on, for as long as a hold says; FINE."""
    counts = held.counts
    now = held.counts[HoldCount.KNOTS] - 1
    seconds = held.holds[hold, HoldRow.SECONDS]
    held.knots[now, Knot.SPEED], time, way = 0.0, held.knots[now, Knot.TIME], held.knots[now, Knot.WAY]
    end = time + seconds
    for start in held.starts:
        if seconds == math.inf and start >= time:
            end = min(end, start)
    row = counts[HoldCount.STOOD]
    counts[HoldCount.STOOD] = counts[HoldCount.STOOD] + 1
    held.waiting[hold] = 0
    held.stood[row, Stood.NUMBER], held.stood[row, Stood.WAY] = hold, way
    held.stood[row, Stood.START], held.stood[row, Stood.END] = time, end
    if time < end < math.inf:
        counts[HoldCount.KNOTS] = add_knot(held, now + 1, end, way, 0.0)
    return HoldTrouble.FINE


@kernel
def told(held: Held, hold: int, trouble: int) -> int:
    """The trouble, with its hold recorded."""
    held.counts[HoldCount.TOLD] = hold
    return trouble


@kernel
def stand_next(held: Held, rate: float) -> int:
    """Go on to the hold that comes first of those waiting, and stand; FINE, or what is wrong."""
    holds, counts, now = held.holds, held.counts, held.counts[HoldCount.KNOTS] - 1
    first = placed = timed = -1
    for n in range(holds.shape[0]):
        if held.waiting[n] > 0:
            first = n if first < 0 else first
            placed = n if placed < 0 or holds[n, HoldRow.WAY] < holds[placed, HoldRow.WAY] else placed
            timed = n if timed < 0 or holds[n, HoldRow.AT] < holds[timed, HoldRow.AT] else timed
    way, at, stood = holds[placed, HoldRow.WAY], holds[timed, HoldRow.AT], counts[HoldCount.STOOD] > 0
    time = held.knots[now, Knot.TIME]
    ahead = way - held.knots[now, Knot.WAY]
    speed = held.knots[now, Knot.SPEED]
    if is_over(held):
        return told(held, first, HoldTrouble.OVER)
    if stood and way <= held.knots[now, Knot.WAY] + SAME_PLACE:
        return told(held, placed, HoldTrouble.OVERLAP)
    if at < time or (stood and at == time < math.inf):
        return told(held, timed, HoldTrouble.OVERLAP if stood else HoldTrouble.OUTSIDE)
    if way > SAME_PLACE and speed * speed > 2.0 * rate * ahead:
        return told(held, placed, HoldTrouble.ROOM)
    end = go_ahead(held, way, 2.0 * rate)
    reached = held.knots[end - 1, Knot.TIME] if way < math.inf else math.inf
    if at < reached:
        return stand(held, timed) if brake(held, at, rate, end) else told(held, timed, HoldTrouble.ROOM)
    if reached == math.inf:
        return told(held, placed, HoldTrouble.UNREACHABLE)
    counts[HoldCount.KNOTS] = end
    return stand(held, placed)


@kernel
def is_over(held: Held) -> bool:
    """Whether the head stands for good."""
    count = held.counts[HoldCount.STOOD]
    return count > 0 and held.stood[count - 1, Stood.END] == math.inf


@entry
def hold_head(held: Held, start: float, rate: float) -> int:
    """Fill counts[KNOTS] knots and counts[STOOD] rows of stood; returns FINE, or the trouble.

    The trouble is that of hold counts[TOLD]. The walk begins at `start`, s; the head brakes at `rate`,
    m/s^2. If counts[SHORT] is set, knots did not fit: call again with more room.
    """
    for n in range(HOLD_COUNTS):
        held.counts[n] = 0
    for n in range(held.holds.shape[0]):
        held.waiting[n] = 1
    held.counts[HoldCount.KNOTS] = add_knot(
        held, 0, start, 0.0, math.sqrt(held.pieces[0, HoldPiece.BEFORE])
    )
    for _hold in range(held.holds.shape[0]):
        trouble = stand_next(held, rate)
        if trouble != HoldTrouble.FINE:
            return trouble
    if not is_over(held):
        held.counts[HoldCount.KNOTS] = go_ahead(held, math.inf, 2.0 * rate)
    return HoldTrouble.FINE
