"""The search of a walk for benches that come near one obstacle, in a block of the engine's memory.

The place of a bench follows from the route position of its own front handle alone. So each size of
bench is searched once, along the stretches of route that its benches walk: of a bench that follows
another of its size, only the way up to that one's place at the start is new
(kernels/obstacle_contact.py). What is found there is then converted to head positions.
"""

from typing import NamedTuple

from benchdragon.kernels import memory
from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import COLUMNS
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.kinds import same_size
from benchdragon.kernels.memory import ROW, Header
from benchdragon.kernels.nearness import NEARNESS
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.obstacle import fill_boxes, sides
from benchdragon.kernels.obstacle_contact import Bench, Standing
from benchdragon.kernels.question import Told
from benchdragon.kernels.rounding import SEAM_COLUMNS, find_seams
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.search_room import WIDER, placements, searches
from benchdragon.kernels.spans import REPEAT, BegunRepeat, RepeatSpan
from benchdragon.kernels.time_of_impact import NOTES, Search


class ObstacleGiven(Numbered):
    """What a host passes of an obstacle and of the walk, a row of floats."""

    SORT = 0  # of what kind: see kernels/obstacle.py
    RADIUS = 1  # of a circle, m
    MARGIN = 2  # distance that benches must keep, m
    HEAD_FIRST = 3  # head positions, m, at which the walk begins and ends
    HEAD_LAST = 4
    LEAST_OFF = 5  # least error that is assumed of computed distances, m
    WIDTH = 6  # parts of a step narrower than this, m, are not halved
    MOST = 7  # benches placed in one stretch of a search for touches, at most
    MOST_LEAST = 8  # and for the least distance


OBSTACLE_GIVEN = len(ObstacleGiven)


class ObstacleTold(Told):
    """The result, a row of floats that begins with the columns of `question.Told`."""

    MADE = 2  # benches placed in searches
    ABOUT = 3  # the largest error bound of distances that decided, m
    SOUND = 4  # the route position past which a bench may not follow, m
    CLOSED_IN = 5  # 1 if the least distance is bracketed as narrowly as required
    COUNT = 6  # rows of what was found
    # From here on internal: the goal, the bracket's width, m, and 1 as the search begins.
    GOAL, NARROW, BEGINS = range(7, 10)
    SOUGHT_OFF = 10  # least error that is assumed of distances, m
    APART, APART_BENCH, APART_OFF = range(11, 14)  # at the start
    NEAR, NEAR_BENCH, NEAR_AT = range(14, 17)  # the least distance seen; NEAR_AT is NaN if at the start
    # The current size, by its first bench; the bench, and where the one before it stood at the start,
    # m; its spans, the number of the next, and the rest of the current one; how often it was grazed.
    SIZE, REPEATS, BENCH, AHEAD, SPANS, SPAN, FROM, TO, GRAZES = range(17, 26)
    TOLD_ROWS, SOONEST = 26, 27  # rows that are converted to head positions; that of a sure touch, m


OBSTACLE_FIGURES = len(ObstacleTold)


class ObstacleFound(Numbered):
    """Results, a row each.

    Of touches, head positions that bracket one, m; of the least distance, its bracket, m; the bench
    (from 0) and the head position, HEAD; there the point of the bench that is nearest to the obstacle,
    or farthest outside the venue, its distance, m, and its feature (kernels/nearness.py).
    """

    VALUE, LOW_END, HIGH_END, WHO, HEAD, SURE, AT_X, AT_Y, GAP, FEATURE = range(10)


FOUND_COLUMNS = len(ObstacleFound)


class SizeWay(Numbered):
    """The way that benches of each size walk.

    Its first bench, how many, from where to where it leads, m, and how much of it is searched, m.
    """

    BENCH, COUNT, LOW, HIGH, LENGTH = range(5)


SIZE_WAY_COLUMNS = len(SizeWay)
# Rows of what a search finds, at first.
FIRST_ROWS = 64


class ObstacleMemory(Numbered):
    """Memories of the block: of a search, and of what it finds."""

    BESIDE, FOUND = 4, 5


class Beside(NamedTuple):
    """A search beside one obstacle; the fields from `at` to `box` are scratch."""

    found: Table  # (.., FOUND_COLUMNS)
    bench: Bench  # of the current size, on the rows of the route
    standing: Standing
    search: Search
    links: Vector
    sizes: Table
    alike: IntVector  # the first bench of the size of each
    outline: Table
    repeats: Table  # (.., spans.REPEAT)
    begun: Table  # those that spare some of the current size's way
    skips: Table
    spans: Table  # of the current bench
    placed: Placements  # at the start and at the end
    s: Table  # route positions there, m, (handles, 2)
    ways: Table  # (benches, SIZE_WAY_COLUMNS)
    at: Vector
    chain: Placements
    lanes: Vector
    errors: Vector
    off: Vector
    nearest: Vector
    which: IntVector
    box: Table  # (2, BOX_COLUMNS)
    asked: Vector
    figures: Vector
    note: Vector


# The slot, from the first, at which the fields after `found` begin.
AFTER_FOUND = 3


@kernel
def lay_beside(
    slots: IntArray, slot: int, address: int, rows: int, benches: int, corners: int, boxes: int,
    known: int,
) -> int:  # fmt: skip
    """Lay out a search without `found` from a slot and an address on; returns the bytes it takes."""
    row, each, one, near = (benches, ROW), (boxes, ROW), (1, ROW), max(boxes, 2)
    return memory.lay(slots, slot + AFTER_FOUND, address, (
        (rows, COLUMNS), one, (4, 1), (rows, SEAM_COLUMNS), (boxes, BOX_COLUMNS), (near, BOX_COLUMNS),
        each, each, each, one, *searches(2, boxes + 1, boxes + 1), row, (4, benches), row, (corners, 2),
        (known, REPEAT), (known, BegunRepeat.BEGUN), (known, 2), (known + 1, 2),
        *placements(benches + 1, 2),
        (benches + 1, 2), (benches, SIZE_WAY_COLUMNS), (2, ROW), *placements(benches + 1, 1), row,
        (benches + 1, ROW), row, (NEARNESS, ROW), one, (2, BOX_COLUMNS), (OBSTACLE_GIVEN, ROW),
        (OBSTACLE_FIGURES, ROW), (NOTES, ROW),
    ))  # fmt: skip


@kernel
def make_beside(
    block: int, slot: int, rows: int, benches: int, corners: int, boxes: int, known: int
) -> bool:
    """Make room for a search at a slot of a block, which may hold one already; False without memory."""
    slots = memory.integers_at(block, memory.integers_at(block, memory.HEADER)[Header.SLOTS])
    memory.drop(slots, ObstacleMemory.BESIDE)
    if slots[Header.OWNED + ObstacleMemory.FOUND] == 0:
        if not memory.take(slots, ObstacleMemory.FOUND, 8 * FIRST_ROWS * FOUND_COLUMNS):
            return False
        memory.lay_from(slots, slot, slots[Header.OWNED + ObstacleMemory.FOUND])
        memory.lay_table(slots, FIRST_ROWS, FOUND_COLUMNS)
    size = lay_beside(slots, slot, 0, rows, benches, corners, boxes, known)
    if not memory.take(slots, ObstacleMemory.BESIDE, size):
        return False
    lay_beside(
        slots, slot, slots[Header.OWNED + ObstacleMemory.BESIDE], rows, benches, corners, boxes, known
    )
    return True


@kernel
def widen_found(block: int, slot: int) -> bool:
    """Make room for more rows of `found`; False without memory."""
    slots = memory.integers_at(block, memory.integers_at(block, memory.HEADER)[Header.SLOTS])
    before, rows = slots[Header.OWNED + ObstacleMemory.FOUND], slots[slot + 1]
    known, count = memory.integers_at(before, rows * FOUND_COLUMNS), WIDER * rows
    address = memory.allocate(8 * count * FOUND_COLUMNS)
    if address == 0:
        return False
    memory.copy_row(memory.integers_at(address, rows * FOUND_COLUMNS), known)
    memory.release(before)
    slots[Header.OWNED + ObstacleMemory.FOUND] = address
    memory.lay_from(slots, slot, address)
    memory.lay_table(slots, count, FOUND_COLUMNS)
    return True


@kernel
def begin_beside(
    block: int, slot: int, rows: Table, links: Vector, sizes: Table, outline: Table, repeats: Table,
    asked: Vector,
) -> bool:  # fmt: skip
    """Begin a search at a slot of a block for a walk and an obstacle; False without memory."""
    boxes = sides(int(asked[ObstacleGiven.SORT]), outline.shape[0])
    benches, known = links.shape[0], repeats.shape[0]
    if not make_beside(block, slot, rows.shape[0], benches, outline.shape[0], boxes, known):
        return False
    fill_beside(memory.group_at(Beside, block + 8 * slot), rows, links, sizes, outline, repeats, asked)
    return True


@kernel
def fill_beside(
    beside: Beside, rows: Table, links: Vector, sizes: Table, outline: Table, repeats: Table,
    asked: Vector,
) -> None:  # fmt: skip
    """Copy what a host passes, and derive the rest from it."""
    memory.copy_table(beside.bench.rows, rows)
    memory.copy_row(beside.links, links)
    memory.copy_table(beside.sizes, sizes)
    memory.copy_table(beside.outline, outline)
    memory.copy_row(beside.asked, asked)
    memory.clear(beside.figures)
    beside.standing.members[0] = 0
    for i in range(links.shape[0]):
        beside.ways[i, SizeWay.COUNT] = 0.0
    fill_boxes(int(asked[ObstacleGiven.SORT]), outline, beside.standing.boxes)
    find_seams(rows, beside.bench.seams)
    sort_repeats(repeats, beside.repeats)
    for i in range(links.shape[0]):
        k = beside.alike[i - 1] if i and same_size(sizes, i, sizes, beside.alike[i - 1]) else 0
        while k < i and not same_size(sizes, i, sizes, k):
            k += 1
        beside.alike[i] = k
    beside.figures[ObstacleTold.SOUGHT_OFF] = asked[ObstacleGiven.LEAST_OFF]


@kernel
def sort_repeats(repeats: Table, out: Table) -> None:
    """Copy repeats, those first that spare most of the way."""
    for n in range(repeats.shape[0]):
        m = n
        way = repeats[n, RepeatSpan.LOW] - repeats[n, RepeatSpan.HIGH] + repeats[n, RepeatSpan.PERIOD]
        while (
            m > 0
            and out[m - 1, RepeatSpan.LOW] - out[m - 1, RepeatSpan.HIGH] + out[m - 1, RepeatSpan.PERIOD]
            > way
        ):
            memory.copy_row(out[m], out[m - 1])
            m -= 1
        memory.copy_row(out[m], repeats[n])
