"""The new parts of a way, on a route of which parts repeat: see kernels/rounds.py."""

import math

from benchdragon.kernels.arrays import Vector
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.local_minima import head_where_tail
from benchdragon.kernels.numbered import Numbered

# The way that is searched beyond a whole round, m: more than rounding moves its end.
BEYOND_ROUND = 1e-6
# A part that is left out is at least so many times as long as the benches: restarts have their cost.
WORTH = 2.0
# The error of one bench beside an obstacle, m: roundings of its place, a thousandfold where it is all
# but folded.
PLACED = 1e-10


class RepeatSpan(Numbered):
    """A repeat: the route from LOW to HIGH, m, is what it was PERIOD before, up to MISSED, m."""

    LOW, HIGH, PERIOD, MISSED = range(4)


REPEAT = len(RepeatSpan)


class BegunRepeat(RepeatSpan):
    """A repeat that is begun: from where on the head stands where all benches do."""

    BEGINS, BEGUN = 4, 5  # of one that is begun: from where on the head stands where all benches do


@kernel
def begin_repeats(
    rows: FloatArray, links: Vector, repeats: FloatArray, at: Vector, places: Placements,
    begun: FloatArray,
) -> int:  # fmt: skip
    """Fill `begun` with the repeats that spare benches of these links some way; returns how many.

    Those that spare most come first; one whose part an earlier one spares is left out.
    """
    count, length = 0, 0.0
    for i in range(links.shape[0]):
        length += links[i]
    for n in range(repeats.shape[0]):
        low = repeats[n, RepeatSpan.LOW]
        high = repeats[n, RepeatSpan.HIGH]
        period = repeats[n, RepeatSpan.PERIOD]
        wanted = high - low - period > WORTH * length
        for m in range(count):
            soonest = begun[m, BegunRepeat.BEGINS] + begun[m, RepeatSpan.PERIOD]
            wanted = wanted and not (
                soonest <= low + length + period and high <= begun[m, RepeatSpan.HIGH]
            )
        if wanted:
            for k in range(REPEAT):
                begun[count, k] = repeats[n, k]
            begun[count, BegunRepeat.BEGINS] = low
            if not math.isinf(low):
                begun[count, BegunRepeat.BEGINS] = head_where_tail(
                    rows, links, low + BEYOND_ROUND, at, places
                )
            count += 1
    return count


@kernel
def new_spans(
    begun: FloatArray, count: int, length: float, first: float, last: float, skips: FloatArray,
    spans: FloatArray,
) -> tuple[int, float]:  # fmt: skip
    """Fill `spans` with those of a way from first to last, m, that repeat nothing before them there.

    Returns how many, and the error of places against those some rounds before, m. `skips` is scratch.
    """
    skipped, missed = 0, 0.0
    for n in range(count):
        start = max(begun[n, BegunRepeat.BEGINS], first) + begun[n, RepeatSpan.PERIOD] + BEYOND_ROUND
        end = min(begun[n, RepeatSpan.HIGH], last)
        if end - start > WORTH * length:
            m = skipped
            while m > 0 and skips[m - 1, 0] > start:
                skips[m, 0], skips[m, 1] = skips[m - 1, 0], skips[m - 1, 1]
                m -= 1
            skips[m, 0], skips[m, 1] = start, end
            skipped, missed = skipped + 1, missed + begun[n, RepeatSpan.MISSED]
    found, at = 0, first
    for m in range(skipped):
        start, end = skips[m, 0], skips[m, 1]
        if start > at:
            spans[found, 0], spans[found, 1] = at, start
            found += 1
        at = max(at, end if end >= last else end - BEYOND_ROUND)
    if at < last or found == 0:
        spans[found, 0], spans[found, 1] = at, last
        found += 1
    return found, missed
