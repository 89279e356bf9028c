"""What a question about a random dance knows, and where that lies in the engine's own memory."""

from typing import NamedTuple

from benchdragon.kernels import random_numbers
from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import COLUMNS
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.family import Family, copy_family, family_shapes
from benchdragon.kernels.memory import (
    HEADER,
    OWNED,
    ROW,
    clear,
    copy_row,
    drop,
    lay,
    slot_count,
    slot_of,
    take,
)
from benchdragon.kernels.question import TOLD
from benchdragon.kernels.random_dance_bound import FACTS, Bound
from benchdragon.kernels.random_numbers import DEVIATIONS
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.search_room import placements, searches, walks
from benchdragon.kernels.time_of_impact import NOTES, Search
from benchdragon.kernels.workspace import Walk, copy_walk

# What hosts say of a question, a row of floats.
WHAT = 0  # NEEDED: the pitch that the dance needs; TOUCHES: whether benches touch with the plan's own
MARGIN = 1  # distance that benches must keep, m
FIRST = 2  # where the head of the plan's own walk begins and ends, m
LAST = 3
GUESS = 4  # pitch from which is sought, m
SEED = 5
DANCE = 6  # its number, from 0
BYTES = 7  # that tables may take
BY = 8  # and from here on how far from exact it is: see kernels/random_numbers.py
ASIDE, STRAY = BY + random_numbers.ASIDE, BY + random_numbers.STRAY
LIMITS = BY + DEVIATIONS
NEEDED, TOUCHES = 0, 1
# What is told of it, a row of floats that begins as kernels/question.py says.
RESULT = TOLD  # the pitch needed, m, or 1 if benches touch, else 0
DOING = TOLD + 1
PITCH = TOLD + 2  # at hand, m
START = TOLD + 3  # where the head begins and ends along the line, m
END = TOLD + 4
PARTS = TOLD + 5  # of the way that must be searched
PART = TOLD + 6  # at hand
PLACE = TOLD + 7  # in it, from 0
PARTNERS = TOLD + 8  # pairs that a bench may have near it
HINTS = TOLD + 9
LOW = TOLD + 10  # the lowest distance seen, m; where the head was then, and which benches it was
LOW_AT = TOLD + 11
LOW_FRONT = TOLD + 12
LOW_REAR = TOLD + 13
SEEN = TOLD + 14  # the lowest of the places looked at here and there, m; in which part, and place
SEEN_PART = TOLD + 15
SEEN_PLACE = TOLD + 16
ROOM = TOLD + 17  # with the pitch at hand, m: NaN where a bench cannot follow
TRIALS = TOLD + 18
TOUCHING = TOLD + 19  # the greatest pitch that touches, m, and the least one that is surely clear
CLEAR = TOLD + 20
BEFORE = TOLD + 21  # the pitch of the trial before, m, and its room
ROOM_BEFORE = TOLD + 22
FIGURES = TOLD + 23
# How large is what varies with the pitch, a row of whole numbers.
ROUTE_ROWS = 0
POINTS = 1  # of the line
NUMBERS = 2  # of its noise
RADII = 3
GRIDS = 4
STRETCHES = 5
PAIRS = 6
SIZES = 7
# Of the block: rows of the route, the line, what a step is searched in, and all that keeps its size.
ROWS_MEMORY, LINE_MEMORY, STEP_MEMORY, OWN_MEMORY = 0, 1, 2, 3
# Trials of pitches at most. Steps of the head that are searched in one call.
MOST_TRIALS, STEPS = 60, 100


class Drawn(NamedTuple):
    """The benches of a dance, and how far to the left of its line handles walk, m; none: on it."""

    links: Vector
    sizes: Table
    aside: Vector


class Dance(NamedTuple):
    """A dance about which is asked; from `line` to `bound` as large as the pitch at hand wants."""

    walk: Walk  # of exact people
    family: Family
    drawn: Drawn
    at: Vector  # scratch, of one slot
    placed: Placements
    members: IntVector  # all benches
    circles: Table  # scratch, five rows; the first are radii
    hints: Table  # head's way from the start and to the end, m, and benches to be looked at
    steps: Vector  # scratch
    note: Vector
    limits: Vector
    figures: Vector
    sizes: IntVector
    line: Table  # rows that are walked on
    points: Vector  # positions along the route and along the line, m, in pairs
    along: Vector
    noise: Vector
    parts: Table  # see `random_dance_bound.fill_parts`
    bound: Bound
    first: IntVector  # pairs of a step
    second: IntVector
    search: Search


LINE_SLOT, STEP_SLOT = slot_of(Dance, "line"), slot_of(Dance, "first")
END_SLOT = HEADER + slot_count(Dance)
BASE = 8 * HEADER


@kernel
def lay_own(slots: IntArray, address: int, family: Family, walk: Walk, limits: Vector) -> int:
    """Lay from an address on all that keeps its size; the bytes that takes."""
    benches, (_four, kinds) = walk.benches.kind.shape[0], walk.kinds.sizes.shape
    aside = benches + 1 if limits[ASIDE] > 0.0 or limits[STRAY] > 0.0 else 0
    row = (benches, ROW)
    return lay(slots, HEADER + 3, address, (
        *walks(benches, kinds), *family_shapes(family), row, (4, benches),
        (aside, ROW), (1, ROW), *placements(benches + 1, 1), row, (5, benches),
        (MOST_TRIALS + 2, 3), (STEPS + 1, ROW), (NOTES, ROW), (LIMITS, ROW), (FIGURES, ROW),
        (SIZES, ROW),
    ))  # fmt: skip


@kernel
def make_rows(slots: IntArray, rows: int) -> bool:
    """Make room for so many rows of the route; whether there is memory."""
    drop(slots, ROWS_MEMORY)
    if not take(slots, ROWS_MEMORY, 8 * rows * COLUMNS):
        return False
    lay(slots, HEADER, slots[OWNED + ROWS_MEMORY], ((rows, COLUMNS),))
    return True


@kernel
def lay_line(slots: IntArray, address: int, sizes: IntVector, benches: int) -> int:
    """Lay from an address on what a pitch wants; the bytes that takes.

    The line is the route where there are no points.
    """
    points, bounded = sizes[POINTS], benches if sizes[RADII] else 0
    own, after = 0, address
    if points:
        own = lay(slots, LINE_SLOT, address, ((2 * points - 1, COLUMNS),))
        after += own
    else:
        lay(slots, LINE_SLOT, slots[OWNED + ROWS_MEMORY], ((sizes[ROUTE_ROWS], COLUMNS),))
    one, more = (bounded, ROW), (bounded + 1, ROW)
    return own + lay(slots, LINE_SLOT + 3, after, (
        (points, ROW), (points, ROW), (sizes[NUMBERS], ROW), (max(sizes[STRETCHES], 1), 3),
        (FACTS, ROW), (sizes[RADII], ROW), (sizes[GRIDS], ROW), (sizes[GRIDS], ROW),
        more, one, one, more, more, one, one, one, one, more, more,
    ))  # fmt: skip


@kernel
def lay_step(slots: IntArray, address: int, pairs: int, benches: int) -> int:
    """Lay from an address on what a step is searched in; the bytes that takes."""
    row = (pairs, ROW)
    return lay(slots, STEP_SLOT, address, (row, row, *searches(benches + 1, benches, pairs)))


@kernel
def roomy(slots: IntArray, memory: int, size: int, most: float) -> int:
    """Take so many bytes anew, at most so many: those that would be more, -1 for no memory, else 0."""
    drop(slots, memory)
    if size > most:
        return size
    return 0 if take(slots, memory, size) else -1


@kernel
def make_line(slots: IntArray, sizes: IntVector, benches: int, most: float) -> int:
    """Make that room, as `roomy` does."""
    ending = roomy(slots, LINE_MEMORY, lay_line(slots, 0, sizes, benches), most)
    if ending == 0:
        lay_line(slots, slots[OWNED + LINE_MEMORY], sizes, benches)
    return ending


@kernel
def make_step(slots: IntArray, pairs: int, benches: int, most: float) -> int:
    """Make room to search steps of so many pairs in, as `roomy` does."""
    ending = roomy(slots, STEP_MEMORY, lay_step(slots, 0, pairs, benches), most)
    if ending == 0:
        lay_step(slots, slots[OWNED + STEP_MEMORY], pairs, benches)
    return ending


@kernel
def fill(dance: Dance, family: Family, walk: Walk, limits: Vector) -> None:
    """Copy what a host says."""
    copy_family(dance.family, family)
    copy_walk(dance.walk, walk)
    copy_row(dance.limits, limits)
    clear(dance.figures)
    for i in range(dance.members.shape[0]):
        dance.members[i] = i
