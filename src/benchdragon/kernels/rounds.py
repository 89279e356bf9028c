"""Where a walk only repeats itself, so that no search need cover that part again.

How benches stand to one another, and what follows, depends on the route under them alone. On a line or
an arc that is the same everywhere, and where parts of a route come again in the same order it is what
it was one round before. That holds exactly, and answers are about exact places: rounding adds nothing.
Where a round leads back to where it began, obstacles are as near as before, too, up to the distance by
which the round misses that place. design/rounds.py shows what that saves.
"""

import math

import numpy as np

from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import CurveKind, FloatArray, RouteRow, heading, walks_up
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.rounding import KINK, Seam
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.spans import REPEAT, BegunRepeat, RepeatSpan, begin_repeats, new_spans

# A round leads back to where it began if it misses that by less, m; distances err by twice that.
MOST_MISSED = 1e-4
# Periods of a route that are tried: so many different ways from a row to the next of its shape, and so
# many multiples of each, as a circuit of so many equal sides needs.
MOST_GAPS, MOST_FOLD = 64, 24
TURN = 2.0 * math.pi
# Room for what repeats, beyond four times the rows.
ROOM = 64


@kernel
def same_curve(rows: FloatArray, j: int, k: int) -> bool:
    """Whether two rows are parts of curves of one kind and size."""
    return (
        rows[k, RouteRow.KIND] == rows[j, RouteRow.KIND]
        and rows[k, RouteRow.P] == rows[j, RouteRow.P]
        and rows[k, RouteRow.Q] == rows[j, RouteRow.Q]
    )


@kernel
def alike(rows: FloatArray, j: int, period: int) -> bool:
    """Whether row j has the shape of the one `period` rows before."""
    k = j - period
    return (
        k >= 0
        and rows[k, RouteRow.LENGTH] == rows[j, RouteRow.LENGTH]
        and rows[k, RouteRow.U_START] == rows[j, RouteRow.U_START]
        and rows[k, RouteRow.U_END] == rows[j, RouteRow.U_END]
        and same_curve(rows, j, k)
    )


@kernel
def wrapped(angle: float) -> float:
    """An angle, rad, within half a turn."""
    return (angle + math.pi) % TURN - math.pi


@kernel
def is_smooth(rows: FloatArray, j: int) -> bool:
    """Whether the route goes on without a kink where row j starts: rounding may have made one."""
    if j == 0:
        return True
    begun = heading(rows, j, rows[j, RouteRow.U_START])
    ended = heading(rows, j - 1, rows[j - 1, RouteRow.U_END])
    return abs(wrapped(begun - ended)) <= KINK


@kernel
def is_even(rows: FloatArray, j: int) -> bool:
    """Whether row j is the same everywhere."""
    return rows[j, RouteRow.KIND] == CurveKind.LINE or rows[j, RouteRow.KIND] == CurveKind.ARC


@kernel
def shared_way(rows: FloatArray, j: int, k: int, end: int) -> float:
    """How far, m, rows j and k have one shape after their starts, or with `end` 1 before their ends.

    That is 0 where the route has a kink there.
    """
    if k < 0 or j >= rows.shape[0] or not same_curve(rows, j, k):
        return 0.0
    u = RouteRow.U_END if end else RouteRow.U_START
    spiral = rows[j, RouteRow.KIND] == CurveKind.SPIRAL
    spiral = spiral and rows[j, u] == rows[k, u] and walks_up(rows, j) == walks_up(rows, k)
    shared = (is_even(rows, j) or spiral) and is_smooth(rows, j + end) and is_smooth(rows, k + end)
    return min(rows[j, RouteRow.LENGTH], rows[k, RouteRow.LENGTH]) if shared else 0.0


@kernel
def find_periods(rows: FloatArray, gaps: IntArray, periods: IntArray) -> None:
    """Let periods[n] be 1 where a route may come again after n rows; gaps is scratch, both all 0."""
    count, found = rows.shape[0], 0
    for j in range(count):
        gap = 1
        while gap <= count // 2 and not alike(rows, j, gap):
            gap += 1
        if gap <= count // 2:
            gaps[gap] = 1
    for gap in range(1, count // 2 + 1):
        if gaps[gap] and found < MOST_GAPS:
            found += 1
            for fold in range(1, min(MOST_FOLD, count // 2 // gap) + 1):
                periods[gap * fold] = 1


@kernel
def add_repeat(
    known: FloatArray, count: int, low: float, high: float, period: float, missed: float
) -> int:
    """Record a repeat, if there is room; returns the number of repeats."""
    if count == known.shape[0]:
        return count
    known[count, RepeatSpan.LOW], known[count, RepeatSpan.HIGH] = low, high
    known[count, RepeatSpan.PERIOD], known[count, RepeatSpan.MISSED] = period, missed
    return count + 1


@kernel
def lever(rows: FloatArray, j: int) -> float:
    """How far a row leads from the point about which its angle turns it, at most, m."""
    if rows[j, RouteRow.KIND] == CurveKind.SPIRAL:
        return rows[j, RouteRow.P] * max(rows[j, RouteRow.U_START], rows[j, RouteRow.U_END])
    return rows[j, RouteRow.LENGTH]


@kernel
def returned(
    rows: FloatArray, seams: FloatArray, reach: float, first: int, last: int, period: int
) -> tuple[int, float]:
    """The last row up to which a run of `period` rows from `first` on leads back; its miss, m."""
    missed = 0.0
    for copy in range(first + period, last + 1):
        before = first + (copy - first) % period
        turned = abs(wrapped(rows[copy, RouteRow.ANGLE] - rows[before, RouteRow.ANGLE]))
        joint = seams[copy, Seam.GAP] + seams[copy, Seam.TILT] * (
            rows[copy, RouteRow.S_START] + rows[copy, RouteRow.LENGTH] + reach
        )
        other = rows[before, RouteRow.S_START] + rows[before, RouteRow.LENGTH] + reach
        off = abs(rows[copy, RouteRow.X] - rows[before, RouteRow.X]) + abs(
            rows[copy, RouteRow.Y] - rows[before, RouteRow.Y]
        )
        other = seams[before, Seam.GAP] + seams[before, Seam.TILT] * other
        off += turned * (lever(rows, copy) + reach) + joint + other
        if off > MOST_MISSED:
            return copy - 1, missed
        missed = max(missed, off)
    return last, missed


@kernel
def find_bends(rows: FloatArray, back: bool, known: FloatArray) -> int:
    """Record rows that are the same everywhere, or with `back` lead back round a circle; how many."""
    count = 0
    for j in range(rows.shape[0]):
        arc = rows[j, RouteRow.KIND] == CurveKind.ARC
        low, high = rows[j, RouteRow.S_START], rows[j, RouteRow.S_START] + rows[j, RouteRow.LENGTH]
        if back and arc and rows[j, RouteRow.P] != 0.0:
            count = add_repeat(known, count, low, high, TURN / abs(rows[j, RouteRow.P]), 0.0)
        elif not back and is_even(rows, j):
            low = -math.inf if j == 0 and math.isinf(rows[0, RouteRow.U_BACK]) else low
            count = add_repeat(known, count, low, high, 0.0, 0.0)
    return count


@kernel
def add_run(
    rows: FloatArray, seams: FloatArray, reach: float, run: tuple[int, int, int], used: IntArray,
    known: FloatArray, count: int,
) -> int:  # fmt: skip
    """Record a run, (first row, last row, period), of rows that recur; the number of repeats.

    Where it need not lead back, it may begin and end within rows that differ in length alone: whether
    it leads back is seen of whole rows.
    """
    begin, end, period = run
    first, missed = begin + period, 0.0
    if seams.shape[0]:
        end, missed = returned(rows, seams, reach, begin, end, period)
    if end < first:
        return count
    for k in range(first, end + 1):
        used[k] = 1
    low, high = rows[begin, RouteRow.S_START], rows[end, RouteRow.S_START] + rows[end, RouteRow.LENGTH]
    way = rows[first, RouteRow.S_START] - low
    if not seams.shape[0]:
        low -= shared_way(rows, first - 1, begin - 1, 1)
        high += shared_way(rows, end + 1, end + 1 - period, 0)
    return add_repeat(known, count, low, high, way, missed)


@kernel
def has_news(rows: FloatArray, period: int, used: IntArray) -> bool:
    """Whether rows come again after so many that were not recorded yet."""
    j = period
    while j < rows.shape[0] and (used[j] or not alike(rows, j, period)):
        j += 1
    return j < rows.shape[0]


@entry
@allocates
def find_repeats(rows: Table, seams: Table, reach: float, known: Table) -> int:
    """Fill `known` with where a route repeats its shape, the shortest rounds first; returns how many.

    With seams, those of `rounding.find_seams`, these parts lead back to where the route was, for points
    up to `reach` from it, m. Rows that were recorded with a shorter round are not recorded again.
    """
    total, count = rows.shape[0], find_bends(rows, seams.shape[0] > 0, known)
    used, gaps = np.zeros(total, dtype=np.int64), np.zeros(total, dtype=np.int64)
    periods = np.zeros(total, dtype=np.int64)
    find_periods(rows, gaps, periods)
    for period in range(1, total):
        first = -1
        again = periods[period] == 1 and has_news(rows, period, used)
        for j in range(period, total + 1 if again else 0):
            goes = j < total and alike(rows, j, period)
            joined = goes and first >= 0 and is_smooth(rows, j) and is_smooth(rows, j - period)
            if first >= 0 and not joined:
                run = (first - period, j - 1, period)
                count = add_run(rows, seams, reach, run, used, known, count)
            if not joined:
                first = j if goes else -1
    return count


@kernel
def put_in_order(values: FloatArray, count: int, chosen: IntArray) -> None:
    """Put the last of so many numbers of rows in its place by their values, the least first."""
    n, k = chosen[count - 1], count - 1
    while k > 0 and values[n] < values[chosen[k - 1]]:
        chosen[k] = chosen[k - 1]
        k -= 1
    chosen[k] = n


@entry
@allocates
def spans_left(
    rows: Table, links: Vector, known: Table, first: float, last: float, at: Vector, places: Placements,
    spans: Table,
) -> tuple[int, float]:  # fmt: skip
    """Fill `spans` with those of the head's way from first to last, m, that repeat nothing before them.

    Returns how many, at most one more than `known` repeats, and the error of places against those some
    rounds before, m. Slot 0 of `at` and `places` is scratch.
    """
    total, length = known.shape[0], 0.0
    for i in range(links.shape[0]):
        length += links[i]
    order, kept = np.empty(total, dtype=np.int64), np.empty(total)
    for n in range(total):
        order[n] = n
        kept[n] = known[n, RepeatSpan.LOW] - known[n, RepeatSpan.HIGH] + known[n, RepeatSpan.PERIOD]
        put_in_order(kept, n + 1, order)
    ordered = np.empty((total, REPEAT))
    begun = np.empty((total, BegunRepeat.BEGUN))
    skips = np.empty((total, 2))
    for n in range(total):
        for k in range(REPEAT):
            ordered[n, k] = known[order[n], k]
    count = begin_repeats(rows, links, ordered, at, places, begun)
    return new_spans(begun, count, length, first, last, skips, spans)
