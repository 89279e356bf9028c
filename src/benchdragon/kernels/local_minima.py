"""Local minima of the separation along a walk, sampled and not bounded: hints where to search."""

import math

from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.box import box_distance, nearest_pair, set_box
from benchdragon.kernels.chain import Placements, march
from benchdragon.kernels.curve import FloatArray, RouteRow, length_at
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.status import Status

# Head positions at which a pair's distance is taken, at first as many as there is room for, and how
# often the range shrinks to the neighbours of the least one, unless distances are level to so many m.
SAMPLES, SHRINKS, LEVEL = 16, 13, 2e-15
# Head positions at which all pairs are sampled for a hint, and how often the range about the least
# distance is then shrunk.
HINT_PLACES, HINT_SHRINKS = 128, 4
# Dragons of more benches are not sampled for low distances.
MOST_SAMPLED = 5_000
# Tolerance of the head's position when the tail comes to a place, m.
TAIL_TOLERANCE = 1e-9


@kernel
def distance_in_slot(
    sizes: FloatArray, i: int, j: int, places: Placements, t: int, boxes: FloatArray
) -> float:
    """Distance of benches i and j in slot t, m; minus an overlap's depth, infinite without a place."""
    if places.failed[0, t] != Status.OK:
        return math.inf
    set_box(sizes, i, places.x, places.y, t, boxes, 0)
    set_box(sizes, j, places.x, places.y, t, boxes, 1)
    return box_distance(boxes, 0, 1)


@kernel
def march_even(
    rows: FloatArray, links: FloatArray, low: float, high: float, count: int, at: FloatArray,
    places: Placements,
) -> None:  # fmt: skip
    """Place chains at so many head positions, the first slots, evenly from low to high, m."""
    for t in range(count):
        at[t] = high if t == count - 1 else low + (high - low) * t / (count - 1)
    march(rows, links, at, 0, count, places)


@entry
def local_minimum(
    rows: Table, links: Vector, sizes: Table, i: int, j: int, low: float, high: float, shrinks: int,
    at: Vector, places: Placements, boxes: Table,
) -> tuple[float, float]:  # fmt: skip
    """The least sampled distance of benches i < j with the head between low and high, m; and where.

    This is no bound; infinite if the dragon can be placed nowhere, minus the depth of an overlap. `at`
    and `places` are scratch, of j + 2 handles and four slots at least; `boxes` has two rows or more.
    """
    least, where, count = math.inf, 0.5 * (low + high), at.shape[0]
    rounds = math.ceil(shrinks * math.log(SAMPLES - 1.0) / math.log(min(count, SAMPLES) - 1.0))
    for _ in range(rounds if low < high else 0):
        march_even(rows, links[: j + 1], low, high, count, at, places)
        lowest, highest, n = math.inf, -math.inf, 0
        for t in range(count):
            distance = distance_in_slot(sizes, i, j, places, t, boxes)
            highest = max(highest, distance)
            if distance < lowest:
                lowest, n = distance, t
        if lowest < least:
            least, where = lowest, at[n]
        if lowest == math.inf or highest - lowest <= LEVEL:
            break
        low, high = at[max(n - 1, 0)], at[min(n + 1, count - 1)]
        count = min(count, SAMPLES)
    return least, where


@kernel
def low_pair(
    rows: Table, links: Vector, sizes: Table, first: float, last: float, at: Vector, places: Placements,
    boxes: Table,
) -> tuple[float, float, int, int]:  # fmt: skip
    """A low distance with the head between first and last, m; where, and of which benches.

    It is sampled at HINT_PLACES head positions, and about the least of them: a hint, no bound. Minus
    the depth of an overlap; infinite if the dragon can be placed nowhere. The cost grows with the
    square of the number of benches. Scratch is as for `local_minimum`.
    """
    least, where, first_bench, second_bench = math.inf, first, 0, 0
    blocks = -(-HINT_PLACES // at.shape[0])
    step = (last - first) / (blocks * at.shape[0])
    for block in range(blocks):
        begin = first + block * at.shape[0] * step
        end = last if block == blocks - 1 else begin + (at.shape[0] - 1) * step
        march_even(rows, links, begin, end, at.shape[0], at, places)
        distance, t, i, j = nearest_pair(sizes, places.x, places.y)
        if distance < least:
            least, where, first_bench, second_bench = distance, at[t], i, j
    if least < math.inf:
        low, high = max(first, where - 1.1 * step), min(last, where + 1.1 * step)
        distance, s = local_minimum(
            rows, links, sizes, first_bench, second_bench, low, high, HINT_SHRINKS, at, places, boxes
        )
        if distance < least:
            least, where = distance, s
    return least, where, first_bench, second_bench


@entry
def head_where_tail(rows: Table, links: Vector, s: float, at: Vector, places: Placements) -> float:
    """The head's route position, m, when the last handle has come to route position s, m.

    Within TAIL_TOLERANCE, and not before; the route's end if that comes first. Slot 0 of `at` and
    `places` is scratch.
    """
    last, tail = rows.shape[0] - 1, links.shape[0]
    low, high, head = s, rows[last, RouteRow.S_START] + rows[last, RouteRow.LENGTH], s
    for i in range(tail):
        head += links[i]
    while high - low > TAIL_TOLERANCE:
        if not low < head < high:
            head = 0.5 * (low + high)
            if head in (low, high):
                break
        at[0] = head
        march(rows, links, at, 0, 1, places)
        stands = places.failed[0, 0] == Status.OK
        j = places.row[tail, 0]
        ahead = (
            rows[j, RouteRow.S_START] + length_at(rows, j, places.u[tail, 0]) - s
            if stands
            else -math.inf
        )
        if ahead >= 0.0:
            high = head
        else:
            low = head
        # Newton's step, a little to the other side of the place sought.
        side = -0.4 if ahead >= 0.0 else 0.4
        head += side * TAIL_TOLERANCE - ahead / places.ratio[tail, 0] if stands else math.inf
    return high


@entry
def whole_dragon(
    rows: Table, links: Vector, at: Vector, places: Placements
) -> tuple[float, float, int]:
    """The head's route position, m, with the last handle where the route starts; and that handle's, m.

    The third result is the `Status` of that placement. Scratch is as for `head_where_tail`.
    """
    at[0] = head_where_tail(rows, links, 0.0, at, places)
    march(rows, links, at, 0, 1, places)
    j = places.row[links.shape[0], 0]
    tail = rows[j, RouteRow.S_START] + length_at(rows, j, places.u[links.shape[0], 0])
    return at[0], tail, places.failed[0, 0]
