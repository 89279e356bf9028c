"""Continuation of the chain: up to where all benches are certain to follow through the cells ahead.

A cell is in doubt if benches of a kind are not certain to walk through it. It is checked once such a
bench comes to it, in finer and finer parts.
"""

import numpy as np

from benchdragon.kernels.box_hierarchy import BoxCount, BoxMeasure, Hierarchy
from benchdragon.kernels.broad_phase import BoxScratch, count_borders
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import allocates, kernel
from benchdragon.kernels.links import link_of
from benchdragon.kernels.motion_bounds import HANDLE_COLUMNS, place_chain
from benchdragon.kernels.swept_boxes import walks_on
from benchdragon.kernels.workspace import Benches, Course, Walk, Workspace, place_samples

# Cells in doubt are checked in so many parts at first, then in finer ones, down to this, m: with much
# coarser ones, overlaps just before a fold would stay unknown.
CAREFUL_PARTS, FINEST = 16, 1e-9
# A unit in the last place of a number is at most this share of it.
UNIT = 2.3e-16


@kernel
def latest_arrival(walk: Walk, room: Workspace, i: int, back: float) -> float:
    """A lower bound of the head's position in AT..SOUND at which handle i comes to `back`, m."""
    block, way, links = room.block, room.course.way, walk.benches.links
    start, end = way[Course.AT], way[Course.SOUND]
    if i == 0:
        return min(max(back, start), end)
    low, high, middle = start, end, end  # it may not come so far
    while low < middle:
        block.at[0] = middle
        if place_samples(walk.rows, links[:i], block, room.course.tally, 1) and block.s[i, 0] < back:
            low = middle
        else:
            high = middle
        middle = 0.5 * (low + high) if high - low > finest(high) else low
    return low


@kernel
def finest(s: float) -> float:
    """The finest step at route position s, m, that rounding allows."""
    return max(FINEST, 4.0 * UNIT * abs(s))


@kernel
@allocates
def certified_until(
    walk: Walk, ground: Hierarchy, sweeper: BoxScratch, k: int, start: float, end: float
) -> float:
    """The position, m, up to which benches of kind k are certified to follow, front handles from start.

    Steps are halved where that is not certain; the result is `end` if it holds all the way.
    """
    at, step, handles = start, (end - start) / CAREFUL_PARTS, np.empty((2, HANDLE_COLUMNS))
    rows, sizes = walk.rows, walk.kinds.sizes
    sweeper.link[0] = link_of(sizes, k)
    while at < end:
        ahead = min(end, at + step)
        sweeper.at[0], sweeper.at[1] = at, ahead
        place_chain(rows, sweeper.link, sweeper.at, 0, 2, sweeper.places)
        count_borders(ground, sweeper.places, 2)
        if walks_on(rows, sweeper.places, 0, sweeper.link, handles):
            at, step = ahead, 2.0 * step
        elif step > finest(at):
            step *= 0.5
        else:
            return at
    return end


@kernel
def next_of_kind(benches: Benches, s: FloatArray, t: int, k: int, ahead: float, since: int) -> int:
    """The first bench of kind k from `since` on that stands behind `ahead` in slot t, or -1."""
    for i in range(since, benches.kind.shape[0]):
        if benches.kind[i] == k and s[i, t] < ahead:
            return i
    return -1


@kernel
def resolve_doubt(walk: Walk, room: Workspace, sweeper: BoxScratch, doubt: int) -> bool:
    """Lower KNOWN and SOUND to where a doubtful cell lets benches pass; whether the doubt is settled.

    Slot 1 of the block holds the dragon at the start of the stride. The first bench to come to the cell
    is checked; if it stands inside, so is the next one, which walks through the part behind it.
    """
    ground, way, benches, s = room.ground, room.course.way, walk.benches, room.block.s
    k, c, cell = ground.doubts[doubt, 0], ground.doubts[doubt, 1], ground.measures[BoxMeasure.CELL]
    back, ahead = (c + ground.counts[BoxCount.LOW]) * cell, (c + ground.counts[BoxCount.LOW] + 1) * cell
    i, settled, inside = next_of_kind(benches, s, 1, k, ahead, 0), False, True
    for _ in range(2):
        if i < 0 or not inside:
            break
        at = s[i, 1]
        inside = at > back
        first = latest_arrival(walk, room, i, max(back, at))
        if first < way[Course.SOUND]:
            place = certified_until(walk, ground, sweeper, k, max(back, at), max(ahead, at))
            if place < max(ahead, at):
                way[Course.KNOWN] = min(way[Course.KNOWN], first)
                way[Course.SOUND] = latest_arrival(walk, room, i, place)
            else:
                settled = settled or not inside
        i = next_of_kind(benches, s, 1, k, ahead, i + 1)
    way[Course.KNOWN] = min(way[Course.KNOWN], way[Course.SOUND])
    return settled


@kernel
def certify_stride(walk: Walk, room: Workspace, sweeper: BoxScratch) -> bool:
    """Fill KNOWN and SOUND for the stride from AT to UPTO; False if the chain has no place at AT."""
    way, block, counts, doubts = room.course.way, room.block, room.ground.counts, room.ground.doubts
    way[Course.KNOWN] = way[Course.SOUND] = way[Course.UPTO]
    if counts[BoxCount.DOUBTS] == 0:
        return True
    block.at[0] = block.at[1] = way[Course.AT]
    if not place_samples(walk.rows, walk.benches.links, block, room.course.tally, 2):
        return False
    n = 0
    while n < counts[BoxCount.DOUBTS]:
        if resolve_doubt(walk, room, sweeper, n):
            counts[BoxCount.DOUBTS] -= 1
            doubts[n, 0], doubts[n, 1] = (
                doubts[counts[BoxCount.DOUBTS], 0],
                doubts[counts[BoxCount.DOUBTS], 1],
            )
        else:
            n += 1
    return True
