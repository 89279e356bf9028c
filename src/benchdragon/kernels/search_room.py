"""Arrays for a search along a walk in a block of the engine's own memory: made, and enlarged."""

import math
from typing import NamedTuple

from benchdragon.kernels import box_hierarchy as of
from benchdragon.kernels import memory, workspace
from benchdragon.kernels.arrays import IntVector
from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.box_hierarchy import BenchGroup, BoxCount, Grids, Hierarchy
from benchdragon.kernels.curve import RouteRow
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.grid import Grid
from benchdragon.kernels.memory import ROW, Header, Shapes
from benchdragon.kernels.motion_bounds import BENCH_COLUMNS, HANDLE_COLUMNS
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.rounding import SEAM_COLUMNS
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.search_start import CELL_SHARE, begin_walk
from benchdragon.kernels.spiral import LANES
from benchdragon.kernels.time_of_impact import DEPTH
from benchdragon.kernels.workspace import (
    Course,
    HeadSamples,
    SearchProgress,
    StepIndex,
    Walk,
    WalkTally,
    Workspace,
)


class Beginning(Numbered):
    """The sizes that a room begins with, a row of whole numbers, explained in analysis/tables.py."""

    A_CELL, AT_FIRST, FIRST_PAIRS, FIRST_MEMBERS, FIRST_DOUBTS, MOST_CELLS, PLACES = range(7)


BEGINNINGS = len(Beginning)


class RoomSize(Numbered):
    """The sizes of a room, a row of whole numbers."""

    ROUTE_ROWS = 0
    CELLS = 1
    PARTS = 2
    ENTRIES = 3
    DOUBTS = 4
    PAIRS = 5  # of benches in a step
    MEMBERS = 6
    MOST_CELLS = 7  # cells there may be


ROOM_SIZES = len(RoomSize)
# Arrays that turn out too small become so many times as large as is needed.
WIDER = 2


class RoomEnding(Numbered):
    """Exit status of making room."""

    ROOMY, UNSTEADY, TOO_LONG, TOO_LARGE, NO_MEMORY, FOR_GROUND = range(6)


class SearchMemory(Numbered):
    """The memories of the block for the ground, and for the arrays that a step is searched in."""

    GROUND, STEP = 1, 2


# Where parts of a room begin, in slots from its own first.
BLOCK = memory.slot_count(Hierarchy) + memory.slot_count(Grids)
MEETING = (
    BLOCK
    + memory.slot_count(HeadSamples)
    + memory.slot_count(StepIndex)
    + memory.slot_count(SearchProgress)
)


class Aim(NamedTuple):
    """What a search along a walk covers."""

    first: float  # head positions, m, between which it is
    last: float
    reach: float  # distance of benches, m, within which pairs are sought
    most: float  # bytes that its tables may take at most


@kernel
def placements(handles: int, count: int) -> Shapes:
    """The shapes of chains of so many handles at so many head positions."""
    one = (handles, count)
    return one, one, one, one, one, one, one, (2, count)


@kernel
def grid(places: int) -> Shapes:
    """The shapes of a grid of so many places: see `grid.empty_grid`."""
    buckets = 16
    while buckets < 2 * places:
        buckets *= 2
    return (1, ROW), (buckets, ROW), (places, ROW), (places, ROW), (places, ROW)


@kernel
def walks(benches: int, kinds: int) -> Shapes:
    """The shapes of a walk without the rows of its route."""
    row = (benches, ROW)
    return row, (4, benches), row, row, (1, ROW), (4, kinds), (kinds, ROW)


@kernel
def lay_ground(slots: IntArray, slot: int, address: int, sizes: IntVector, groups: int) -> int:
    """Lay out the tables of the route from a slot and an address on; returns the bytes they take."""
    cells, pairs, rows = sizes[RoomSize.CELLS], sizes[RoomSize.ENTRIES], sizes[RoomSize.ROUTE_ROWS]
    boxes = groups * cells + sizes[RoomSize.PARTS]
    return memory.lay(slots, slot, address, (
        (of.BOX_COUNTS, ROW), (of.MEASURES, ROW), (groups, BenchGroup.WAYS + groups),
        (groups * groups * rows, 2),
        (cells, groups * groups), (cells, 2), (boxes, of.HULL_COLUMNS), (boxes, of.TREE_COLUMNS),
        (pairs, 2), (boxes, ROW), (pairs, 2), (sizes[RoomSize.DOUBTS], 2), (rows, SEAM_COLUMNS),
        *grid(cells), *grid(groups * cells), (groups * cells, ROW),
    ))  # fmt: skip


@kernel
def ground_bytes(sizes: IntVector, groups: int) -> int:
    """Bytes of those tables that count as the memory of a question."""
    cells = sizes[RoomSize.CELLS]
    boxes = groups * cells + sizes[RoomSize.PARTS]
    columns = of.HULL_COLUMNS + of.TREE_COLUMNS + 1
    return 8 * (boxes * columns + 4 * sizes[RoomSize.ENTRIES] + cells * groups * (groups + 2))


@kernel
def lay_block(slots: IntArray, slot: int, address: int, benches: int, places: int) -> int:
    """Lay out chains at steps to come, the crowd and the course of a room; returns where that ends."""
    count = max(2, min(LANES, places // (benches + 1)))
    return address + memory.lay(slots, slot + BLOCK, address, (
        (count, ROW), *placements(benches + 1, count), (benches + 1, count), (benches, of.HULL_COLUMNS),
        *grid(benches), (benches, ROW), (workspace.COURSE, ROW), (workspace.TALLY, ROW),
    ))  # fmt: skip


@kernel
def searches(handles: int, members: int, pairs: int) -> Shapes:
    """The shapes of the arrays that steps are searched in: see `time_of_impact.empty_search`."""
    return (
        (DEPTH, ROW), *placements(handles, DEPTH), (handles, HANDLE_COLUMNS), (members, BENCH_COLUMNS),
        (DEPTH * members, BOX_COLUMNS), (DEPTH * members, ROW), (handles, ROW), (handles, ROW),
        (DEPTH, pairs), (DEPTH, ROW),
    )  # fmt: skip


@kernel
def lay_step(slots: IntArray, slot: int, address: int, sizes: IntVector, benches: int) -> int:
    """Lay out the pairs of a step and the arrays that search it; returns the bytes that they take."""
    pairs = sizes[RoomSize.PAIRS]
    return memory.lay(slots, slot + MEETING, address, (
        (pairs, ROW), (pairs, ROW), (pairs, ROW), (pairs, ROW), (benches, ROW), (benches, ROW),
        *searches(benches + 1, sizes[RoomSize.MEMBERS], pairs),
    ))  # fmt: skip


@kernel
def group_count(walk: Walk) -> int:
    """Number of the groups of kinds of a walk."""
    most = 0
    for k in range(walk.kinds.group.shape[0]):
        most = max(most, walk.kinds.group[k])
    return most + 1


@kernel
def square_side(walk: Walk, reach: float) -> float:
    """The side of the squares of grids, m: about the range in which benches are searched for."""
    most, sizes = 0.0, walk.kinds.sizes
    for k in range(sizes.shape[1]):
        most = max(most, math.hypot(sizes[0, k], sizes[1, k]))
    return 2.0 * most + reach


@kernel
def size_workspace(
    sizes: IntVector, beginnings: IntVector, walk: Walk, tail: float, last: float
) -> None:
    """Fill the sizes of a room for a walk whose head goes on to `last`, m, with about what it needs.

    `tail` is about where its last bench begins, m, or less. The rows of the route stay.
    """
    benches, rows, shortest = walk.benches.kind.shape[0], walk.rows, math.inf
    for i in range(benches):
        shortest = min(shortest, walk.benches.links[i])
    cell, end = CELL_SHARE * shortest, rows.shape[0] - 1
    foremost = min(last, rows[end, RouteRow.S_START] + rows[end, RouteRow.LENGTH])
    wanted = max(math.floor(foremost / cell) - math.floor(tail / cell), 0) + 2
    cells = min(wanted, beginnings[Beginning.MOST_CELLS])
    most = min(beginnings[Beginning.A_CELL] * cells, beginnings[Beginning.AT_FIRST])
    sizes[RoomSize.CELLS], sizes[RoomSize.PARTS], sizes[RoomSize.ENTRIES] = cells, most, most
    sizes[RoomSize.DOUBTS] = beginnings[Beginning.FIRST_DOUBTS]
    sizes[RoomSize.PAIRS] = beginnings[Beginning.FIRST_PAIRS]
    sizes[RoomSize.MEMBERS] = min(beginnings[Beginning.FIRST_MEMBERS], benches)
    sizes[RoomSize.MOST_CELLS] = beginnings[Beginning.MOST_CELLS]


@kernel
def make_ground(slots: IntArray, slot: int, sizes: IntVector, groups: int, most: float) -> int:
    """Make room for a route of which nothing is known, of at most so many bytes; returns the status."""
    if ground_bytes(sizes, groups) > most:
        return RoomEnding.TOO_LARGE
    size = lay_ground(slots, slot, 0, sizes, groups)
    if not memory.take(slots, SearchMemory.GROUND, size):
        return RoomEnding.NO_MEMORY
    lay_ground(slots, slot, slots[Header.OWNED + SearchMemory.GROUND], sizes, groups)
    return RoomEnding.ROOMY


@kernel
def make_step(block: int, slot: int, sizes: IntVector) -> int:
    """Make room to search a step in, whose pairs of benches stay known; returns the status."""
    slots = memory.integers_at(block, memory.integers_at(block, memory.HEADER)[Header.SLOTS])
    room = memory.group_at(Workspace, block + 8 * slot)
    first, second = room.meeting.first, room.meeting.second
    before = slots[Header.OWNED + SearchMemory.STEP]
    benches, pairs = room.crowd.found.shape[0], sizes[RoomSize.PAIRS]
    address = memory.allocate(lay_step(slots, slot, 0, sizes, benches))
    if address == 0:
        return RoomEnding.NO_MEMORY
    lay_step(slots, slot, address, sizes, benches)
    slots[Header.OWNED + SearchMemory.STEP] = address
    known = memory.integers_at(address, 4 * pairs + 2 * benches)
    for p in range(min(first.shape[0], pairs)):
        known[p], known[pairs + p] = first[p], second[p]
    for i in range(benches):
        known[4 * pairs + benches + i] = -1  # `place`
    memory.release(before)
    room.course.tally[WalkTally.PLACED] = 0
    return RoomEnding.ROOMY


@kernel
def empty_grid_again(grid: Grid, side: float) -> None:
    """Empty a grid, and set the width of its cells, m."""
    grid.side[0] = side
    for b in range(grid.heads.shape[0]):
        grid.heads[b] = 0


@kernel
def begin_in(walk: Walk, room: Workspace, aim: Aim) -> int:
    """Begin a walk in a room where nothing of it is known: ROOMY, or UNSTEADY as `begin_walk` says."""
    side = square_side(walk, aim.reach)
    empty_grid_again(room.grids.middles, side)
    empty_grid_again(room.grids.boxes, side)
    return (
        RoomEnding.ROOMY
        if begin_walk(walk, room, aim.first, aim.last, aim.reach)
        else RoomEnding.UNSTEADY
    )


@kernel
def enlarge(sizes: IntVector, room: Workspace) -> int:
    """Raise sizes that were too small: FOR_GROUND, TOO_LONG, or ROOMY if they were the step's alone."""
    counts, tally, ground = room.ground.counts, room.course.tally, room.ground
    cells, before = sizes[RoomSize.CELLS], ground.middles.shape[0]
    if counts[BoxCount.CELLS] >= cells:
        if cells == sizes[RoomSize.MOST_CELLS]:
            return RoomEnding.TOO_LONG
        sizes[RoomSize.CELLS] = cells = min(WIDER * cells, sizes[RoomSize.MOST_CELLS])
    parts = counts[BoxCount.ROWS] - ground.groups.shape[0] * before
    entries, short = max(counts[BoxCount.ENTRIES], counts[BoxCount.NEAR]), cells > before
    if parts > sizes[RoomSize.PARTS]:
        sizes[RoomSize.PARTS], short = WIDER * parts, True
    if entries > sizes[RoomSize.ENTRIES]:
        sizes[RoomSize.ENTRIES], short = WIDER * entries, True
    if counts[BoxCount.DOUBTS] > sizes[RoomSize.DOUBTS]:
        sizes[RoomSize.DOUBTS], short = WIDER * counts[BoxCount.DOUBTS], True
    if short:
        return RoomEnding.FOR_GROUND
    pairs = WIDER * tally[WalkTally.PAIRS]
    sizes[RoomSize.PAIRS] = max(sizes[RoomSize.PAIRS], pairs)
    sizes[RoomSize.MEMBERS] = max(sizes[RoomSize.MEMBERS], min(pairs, room.crowd.found.shape[0]))
    return RoomEnding.ROOMY


@kernel
def begin_workspace(block: int, slot: int, sizes: IntVector, walk: Walk, aim: Aim) -> int:
    """Begin a walk in the room at a slot of a block; returns the status."""
    slots = memory.integers_at(block, memory.integers_at(block, memory.HEADER)[Header.SLOTS])
    if slots[Header.OWNED + SearchMemory.GROUND] == 0:
        ending = make_ground(slots, slot, sizes, group_count(walk), aim.most)
        if ending != RoomEnding.ROOMY:
            return ending
    return begin_in(walk, memory.group_at(Workspace, block + 8 * slot), aim)


@kernel
def grow_workspace(block: int, slot: int, sizes: IntVector, walk: Walk, aim: Aim) -> int:
    """Enlarge the arrays of the step, or else of the route, which starts again; returns the status."""
    slots = memory.integers_at(block, memory.integers_at(block, memory.HEADER)[Header.SLOTS])
    room = memory.group_at(Workspace, block + 8 * slot)
    ending = enlarge(sizes, room)
    if ending == RoomEnding.TOO_LONG:
        return ending
    if ending == RoomEnding.ROOMY:
        return make_step(block, slot, sizes)
    at, goal = room.course.way[Course.AT], room.course.way[Course.GOAL]
    memory.drop(slots, SearchMemory.GROUND)
    ending = begin_workspace(block, slot, sizes, walk, aim)
    if ending == RoomEnding.ROOMY:
        way = room.course.way
        way[Course.AT] = way[Course.UPTO] = way[Course.KNOWN] = way[Course.SOUND] = at
        way[Course.GOAL] = goal
    return ending
