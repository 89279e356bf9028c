"""The state of a question about a size, and its layout in a block of the engine's own memory."""

import math
from typing import NamedTuple

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import COLUMNS
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.family import Family, PlanNumber, RouteKind, copy_family, family_shapes
from benchdragon.kernels.memory import (
    HEADER,
    ROW,
    Header,
    clear,
    copy_row,
    copy_table,
    drop,
    floats_at,
    group_at,
    integers_at,
    lay,
    slot_count,
    slot_of,
    take,
)
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.obstacle_memory import OBSTACLE_GIVEN, Beside
from benchdragon.kernels.question import Told
from benchdragon.kernels.rounding import SEAM_COLUMNS
from benchdragon.kernels.rounds import ROOM as REPEATS
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.search_room import (
    BEGINNINGS,
    ROOM_SIZES,
    RoomEnding,
    RoomSize,
    SearchMemory,
    lay_block,
    make_step,
    placements,
    size_workspace,
    square_side,
    walks,
)
from benchdragon.kernels.size_bracket import BRACKET_NUMBERS, MOST_GROWTHS, MOST_TRIALS
from benchdragon.kernels.size_search import MEETINGS
from benchdragon.kernels.spans import REPEAT
from benchdragon.kernels.spiral import LANES
from benchdragon.kernels.time_of_impact import NOTES
from benchdragon.kernels.workspace import TALLY, Walk, Workspace, copy_walk


class SizeGiven(Numbered):
    """What a host passes with a question, a row of floats."""

    MARGIN = 0  # distance that benches must keep, m
    LEAST_OFF = 1  # least error that is assumed of computed distances, m
    WIDTH = 2  # parts of a step narrower than this, m, are not halved
    MOST = 3  # chains marched in one step of a search
    ORIGIN_X = 4  # from where the dance is searched, m
    ORIGIN_Y = 5
    BYTES = 6  # that tables may take at most
    SAFER = 7  # +1 where larger sizes are safer, -1 where smaller ones are
    NARROW = 8  # how wide the bracket may be, m
    BEGIN = 9  # where the head of the plan's own walk begins and ends, m
    END = 10
    PLAN_SIZE = 11  # of the plan itself, m


SIZE_LIMITS = len(SizeGiven)


class Thing(Numbered):
    """Obstacles and the venue's edge, a row each.

    As in kernels/obstacle_memory.py; the number of corners, and the error of these, m.
    """

    SORT, RADIUS, KEPT_OFF, CORNERS, OFF = range(5)


THING_COLUMNS = len(Thing)


class SizeTold(Told):
    """The result, a row of floats that begins with the columns of `question.Told`."""

    MARCHED = 2  # chains, in searches of walks
    RESULT = 3  # of the last trial: PASSES, FAILS or UNDECIDED
    DOING = 4
    ONE = 5  # 1 if a single trial is requested
    LEFT = 6  # chains that may be marched in a step of the walk that is searched
    FIRST = 7  # where its head begins and ends, m
    LAST = 8
    AT_THING = 9  # the current obstacle, and whether its search has begun
    BEGUN = 10
    UNSURE = 11  # 1 if it is undecided whether benches keep clear of all obstacles
    # the last size that failed by an obstacle alone, m, the obstacle, and whether that is certain
    BLOCKED = 12
    BLOCKED_BY = 13
    SURELY = 14
    KNOWN = 15  # rows of repeats


SIZE_FIGURES = len(SizeTold)


class SizeStage(Numbered):
    """The stage of a question."""

    IDLE, SEEKING, WAITING, BESIDE, SEARCHING, BROKEN = range(6)


# The least number of head positions at which a pair is sampled at a time.
FEWEST = 4


class SizeMemory(SearchMemory):
    """The memories of the block for the rows of the route, and for all of fixed size."""

    ROWS = 0
    OWN = 3


class Square(NamedTuple):
    """Obstacles and the venue's edge."""

    things: Table  # (obstacles, THING_COLUMNS)
    outlines: Table  # all their corners, m


class Sought(NamedTuple):
    """A search for a size; the fields from `at` to `bench_off` are scratch, of all benches."""

    walk: Walk
    seams: Table  # (rows, SEAM_COLUMNS)
    room: Workspace
    family: Family
    sizes: IntVector  # of the room
    beginnings: IntVector  # of the room at first: see search_room
    at: Vector
    placed: Placements
    still: Placements  # of one slot
    boxes: Table
    lanes: Vector
    errors: Vector
    bench_off: Vector
    limits: Vector
    figures: Vector
    state: Vector
    doubts: Vector
    meetings: Table
    note: Vector
    square: Square
    repeats: Table  # where a route that stays leads back to where it was, (.., spans.REPEAT)
    asked: Vector  # of the search beside an obstacle
    beside: Beside


SIZE_WALK_SLOT, SEAMS_SLOT = slot_of(Sought, "walk"), slot_of(Sought, "seams")
SIZE_ROOM_SLOT, FAMILY_SLOT = slot_of(Sought, "room"), slot_of(Sought, "family")
BESIDE_SLOT = slot_of(Sought, "beside")
SIZE_END_SLOT = HEADER + slot_count(Sought)
# The offset of the search in a block, in bytes.
BASE = 8 * HEADER


@kernel
def lay_all(
    slots: IntArray, address: int, family: Family, walk: Walk, square: Square, places: int
) -> int:
    """Lay out all arrays of fixed size from an address on; returns the bytes that they take."""
    benches, (_four, kinds) = walk.benches.kind.shape[0], walk.kinds.sizes.shape
    fixed = family.numbers[PlanNumber.ROUTE] == RouteKind.FIXED and square.things.shape[0] > 0
    repeats = 4 * walk.rows.shape[0] + REPEATS if fixed else 0
    count = max(FEWEST, min(LANES, places // (benches + 1)))
    room = address + lay(slots, SIZE_WALK_SLOT + 3, address, walks(benches, kinds))
    end = lay_block(slots, SIZE_ROOM_SLOT, room, benches, places)
    return end - address + lay(slots, FAMILY_SLOT, end, (
        *family_shapes(family), (ROOM_SIZES, ROW), (BEGINNINGS, ROW), (count, ROW),
        *placements(benches + 1, count), *placements(benches + 1, 1), (2, BOX_COLUMNS), (benches, ROW),
        (benches + 1, ROW), (benches, ROW), (SIZE_LIMITS, ROW), (SIZE_FIGURES, ROW), (BRACKET_NUMBERS,
        ROW),
        (MOST_TRIALS + MOST_GROWTHS, ROW), (MEETINGS, 4), (NOTES, ROW), (square.things.shape[0],
        THING_COLUMNS),
        (square.outlines.shape[0], 2), (repeats, REPEAT),
        (OBSTACLE_GIVEN, ROW),
    ))  # fmt: skip


@kernel
def make_route(slots: IntArray, rows: int) -> bool:
    """Make room for so many rows of the route and their seams, all 0; False without memory."""
    drop(slots, SizeMemory.ROWS)
    count = rows * (COLUMNS + SEAM_COLUMNS)
    if not take(slots, SizeMemory.ROWS, 8 * count):
        return False
    address = slots[Header.OWNED + SizeMemory.ROWS]
    address += lay(slots, SIZE_WALK_SLOT, address, ((rows, COLUMNS),))
    lay(slots, SEAMS_SLOT, address, ((rows, SEAM_COLUMNS),))
    numbers = floats_at(slots[Header.OWNED + SizeMemory.ROWS], count)
    for n in range(count):
        numbers[n] = 0.0
    return True


@kernel
def make_searches(block: int) -> bool:
    """Make room for searches of walks about as long as the plan's; False without memory."""
    sought = group_at(Sought, block + BASE)
    limits, sizes = sought.limits, sought.sizes
    drop(integers_at(block, SIZE_END_SLOT), SearchMemory.GROUND)
    sizes[RoomSize.ROUTE_ROWS] = sought.walk.rows.shape[0]
    whole = 0.0
    for i in range(sought.walk.benches.links.shape[0]):
        whole += sought.walk.benches.links[i]
    size_workspace(
        sizes,
        sought.beginnings,
        sought.walk,
        limits[SizeGiven.BEGIN] - 1.5 * whole,
        limits[SizeGiven.END],
    )
    sought.room.crowd.grid.side[0] = square_side(
        sought.walk, limits[SizeGiven.MARGIN] + limits[SizeGiven.LEAST_OFF]
    )
    return make_step(block, SIZE_ROOM_SLOT, sizes) == RoomEnding.ROOMY


@kernel
def fill(
    sought: Sought, family: Family, walk: Walk, square: Square, limits: Vector, beginnings: IntVector
) -> None:
    """Copy what a host passes."""
    copy_table(sought.square.things, square.things)
    for n in range(square.outlines.shape[0]):
        sought.square.outlines[n, 0] = square.outlines[n, 0] - limits[SizeGiven.ORIGIN_X]
        sought.square.outlines[n, 1] = square.outlines[n, 1] - limits[SizeGiven.ORIGIN_Y]
    copy_family(sought.family, family)
    copy_walk(sought.walk, walk)
    copy_row(sought.limits, limits)
    copy_row(sought.beginnings, beginnings)
    clear(sought.figures)
    sought.figures[SizeTold.BLOCKED] = math.nan
    clear(sought.state)
    clear(sought.note)
    for n in range(TALLY):
        sought.room.course.tally[n] = 0
