"""Where marks stand along a route: each so many metres, at joints, where dragons start and end."""

import math

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.curve import CurveKind, FloatArray, RouteRow, heading, place
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import IntArray, locate

# Marks that would be nearer than this along the route, m, are one.
SAME_MARK = 1e-6
# Marks nearer than this along the route, m, or than this share of the usual distance, are one, but for
# start and ends.
CLOSE_MARKS, CLOSE_SHARE = 0.2, 0.4


class MarkKind(Numbered):
    """What a mark is for.

    Of two in one place the greater is kept; from END on always, unless another such is in the same
    place.
    """

    STEP, JOINT, END, START = range(4)


@kernel
def put_mark(s: FloatArray, kinds: IntArray, count: int, at: float, kind: int) -> int:
    """Put a mark among others in their order; how many there are."""
    n = count
    while n > 0 and s[n - 1] > at:
        n -= 1
    if n > 0 and s[n - 1] == at:
        kinds[n - 1] = max(kinds[n - 1], kind)
        return count
    for m in range(count, n, -1):
        s[m], kinds[m] = s[m - 1], kinds[m - 1]
    s[n], kinds[n] = at, kind
    return count + 1


@kernel
def apart(rows: FloatArray, one: float, other: float) -> float:
    """How far apart two positions are on the ground, m, and in heading, rad: the greater."""
    i, u, _status = locate(rows, one)
    j, v, _status = locate(rows, other)
    ax, ay, _tx, _ty = place(rows, i, u)
    bx, by, _tx, _ty = place(rows, j, v)
    turned = heading(rows, i, u) - heading(rows, j, v)
    turned -= math.tau * math.floor(turned / math.tau + 0.5)
    return max(math.hypot(ax - bx, ay - by), abs(turned))


@kernel
def add_lag(lags: FloatArray, count: int, lag: float) -> int:
    """Note a lag unless it is known; how many there are."""
    for n in range(count):
        if abs(lags[n] - lag) < 1e-9:
            return count
    lags[count] = lag
    return count + 1


@kernel
def find_lags(rows: FloatArray, lags: FloatArray) -> int:
    """After how many m a place may come again: whole circles, or between joints in one place."""
    count, last = 0, rows.shape[0] - 1
    for j in range(rows.shape[0]):
        bend = abs(rows[j, RouteRow.P])
        if rows[j, RouteRow.KIND] == CurveKind.ARC and rows[j, RouteRow.LENGTH] * bend > math.tau:
            count = add_lag(lags, count, math.tau / bend)
        if j > 0 and rows[j, RouteRow.PART] == rows[j - 1, RouteRow.PART]:
            continue
        x, y, _tx, _ty = place_at(rows, rows[j, RouteRow.S_START])
        for i in range(j + 1, rows.shape[0] + 1):
            if i <= last and rows[i, RouteRow.PART] == rows[i - 1, RouteRow.PART]:
                continue
            s = (
                rows[i, RouteRow.S_START]
                if i <= last
                else rows[last, RouteRow.S_START] + rows[last, RouteRow.LENGTH]
            )
            to_x, to_y, _tx, _ty = place_at(rows, s)
            if (
                s - rows[j, RouteRow.S_START] > SAME_MARK
                and math.hypot(to_x - x, to_y - y) <= SAME_MARK
            ):
                count = add_lag(lags, count, s - rows[j, RouteRow.S_START])
                break
    return count


@kernel
def place_at(rows: FloatArray, s: float) -> tuple[float, float, float, float]:
    """Point, m, and tangent at a route position, m."""
    j, u, _status = locate(rows, s)
    return place(rows, j, u)


@kernel
def is_again(rows: FloatArray, lags: FloatArray, count: int, low: float, s: float) -> bool:
    """Whether the ground at a position, m, was walked the same way before, from `low` on."""
    n = 0
    while n < count and not (s - lags[n] >= low and apart(rows, s, s - lags[n]) <= SAME_MARK):
        n += 1
    return n < count


@entry
def lay_marks(
    rows: Table, low: float, start: float, high: float, every: float, lags: Vector, s: Vector,
    kinds: IntVector,
) -> int:  # fmt: skip
    """Fill s with positions of marks from low to high, m, ascending, and what each is for; how many.

    From `start` each way, joints, start and ends besides. Of two that are CLOSE together one is kept.
    Where a closed line is walked again, the marks of the first round serve again, but for start and
    ends. There must be room for a mark each so many metres, and for each row of the route, and three;
    `lags` is scratch, of two numbers a row.
    """
    count, first = 0, math.ceil((low - start) / every)
    for n in range(first, math.floor((high - start) / every) + 1):
        count = put_mark(s, kinds, count, start + every * n, MarkKind.STEP)
    for j in range(1, rows.shape[0]):
        if (
            rows[j, RouteRow.PART] != rows[j - 1, RouteRow.PART]
            and low < rows[j, RouteRow.S_START] < high
        ):
            count = put_mark(s, kinds, count, rows[j, RouteRow.S_START], MarkKind.JOINT)
    if low < 0.0 < high:
        count = put_mark(s, kinds, count, 0.0, MarkKind.JOINT)
    count = put_mark(s, kinds, count, low, MarkKind.END)
    count = put_mark(s, kinds, count, high, MarkKind.END)
    count = put_mark(s, kinds, count, start, MarkKind.START)
    close, known, kept = min(CLOSE_MARKS, CLOSE_SHARE * every), find_lags(rows, lags), 0
    for n in range(count):
        if kinds[n] < MarkKind.END and is_again(rows, lags, known, low, s[n]):
            continue
        if kept > 0:
            least = min(kinds[n], kinds[kept - 1])
            # Round numbers of a plan put marks CLOSE together to the digit: rounding must not choose.
            if s[n] - s[kept - 1] <= SAME_MARK + (0.0 if least >= MarkKind.END else close):
                if kinds[n] <= kinds[kept - 1]:
                    continue
                kept -= 1
        s[kept], kinds[kept] = s[n], kinds[n]
        kept += 1
    return kept
