"""What a question about a random dance knows, and where that lies in the engine's own memory."""

from typing import NamedTuple

from benchdragon.kernels import random_numbers
from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.course import Walk
from benchdragon.kernels.curve import COLUMNS
from benchdragon.kernels.dance_bound import FACTS, Bound
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.family import Family
from benchdragon.kernels.memory import (
    ADDRESS,
    HEADER,
    OWNED,
    copy_row,
    copy_table,
    drop,
    lay_from,
    lay_row,
    lay_table,
    slot_count,
    slot_of,
    take,
)
from benchdragon.kernels.own_room import lay_placements
from benchdragon.kernels.question import TOLD
from benchdragon.kernels.random_numbers import DEVIATIONS
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.search import DEPTH, NOTES, Search
from benchdragon.kernels.step_bounds import BENCH_COLUMNS, HANDLE_COLUMNS

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
SEEN = (
    TOLD + 14
)  # the lowest of the places looked at here and there, m, and in which part and place it was
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
    parts: Table  # see `dance_bound.fill_parts`
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
    beside = limits[ASIDE] > 0.0 or limits[STRAY] > 0.0
    lay_from(slots, HEADER + 3, address)
    lay_row(slots, benches)
    lay_table(slots, 4, benches)
    lay_row(slots, benches)
    lay_row(slots, benches)
    lay_row(slots, 1)
    lay_table(slots, 4, kinds)
    lay_row(slots, kinds)
    lay_row(slots, family.numbers.shape[0])
    lay_table(slots, family.parts.shape[0], family.parts.shape[1])
    lay_table(slots, family.arcs.shape[0], family.arcs.shape[1])
    lay_table(slots, family.pieces.shape[0], family.pieces.shape[1])
    lay_table(slots, 4, benches)
    lay_row(slots, benches)
    lay_row(slots, benches)
    lay_table(slots, 4, benches)
    lay_row(slots, benches + 1 if beside else 0)
    lay_row(slots, 1)
    lay_placements(slots, benches + 1, 1)
    lay_row(slots, benches)
    lay_table(slots, 5, benches)
    lay_table(slots, MOST_TRIALS + 2, 3)
    lay_row(slots, STEPS + 1)
    lay_row(slots, NOTES)
    lay_row(slots, LIMITS)
    lay_row(slots, FIGURES)
    lay_row(slots, SIZES)
    return slots[ADDRESS] - address


@kernel
def make_rows(slots: IntArray, rows: int) -> bool:
    """Make room for so many rows of the route; whether there is memory."""
    drop(slots, ROWS_MEMORY)
    if not take(slots, ROWS_MEMORY, 8 * rows * COLUMNS):
        return False
    lay_from(slots, HEADER, slots[OWNED + ROWS_MEMORY])
    lay_table(slots, rows, COLUMNS)
    return True


@kernel
def lay_line(slots: IntArray, address: int, sizes: IntVector, benches: int) -> int:
    """Lay from an address on what a pitch wants; the bytes that takes.

    The line is the route where there are no points.
    """
    points = sizes[POINTS]
    lay_from(slots, LINE_SLOT, address if points else slots[OWNED + ROWS_MEMORY])
    lay_table(slots, 2 * points - 1 if points else sizes[ROUTE_ROWS], COLUMNS)
    if points == 0:
        slots[ADDRESS] = address
    lay_row(slots, points)
    lay_row(slots, points)
    lay_row(slots, sizes[NUMBERS])
    lay_table(slots, max(sizes[STRETCHES], 1), 3)
    lay_row(slots, FACTS)
    lay_row(slots, sizes[RADII])
    lay_row(slots, sizes[GRIDS])
    lay_row(slots, sizes[GRIDS])
    bounded = benches if sizes[RADII] else 0
    for longer in (1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1):
        lay_row(slots, bounded + longer)
    return slots[ADDRESS] - address


@kernel
def lay_step(slots: IntArray, address: int, pairs: int, benches: int) -> int:
    """Lay from an address on what a step is searched in; the bytes that takes: see `search.room`."""
    lay_from(slots, STEP_SLOT, address)
    lay_row(slots, pairs)
    lay_row(slots, pairs)
    lay_row(slots, DEPTH)
    lay_placements(slots, benches + 1, DEPTH)
    lay_table(slots, benches + 1, HANDLE_COLUMNS)
    lay_table(slots, benches, BENCH_COLUMNS)
    lay_table(slots, DEPTH * benches, BOX_COLUMNS)
    lay_row(slots, DEPTH * benches)
    lay_row(slots, benches + 1)
    lay_row(slots, benches + 1)
    lay_table(slots, DEPTH, pairs)
    lay_row(slots, DEPTH)
    return slots[ADDRESS] - address


@kernel
def make_line(slots: IntArray, sizes: IntVector, benches: int, most: float) -> int:
    """Make that room, of at most so many bytes: those that would be more, -1 for no memory, else 0."""
    drop(slots, LINE_MEMORY)
    size = lay_line(slots, 0, sizes, benches)
    if size > most:
        return size
    if not take(slots, LINE_MEMORY, size):
        return -1
    lay_line(slots, slots[OWNED + LINE_MEMORY], sizes, benches)
    return 0


@kernel
def make_step(slots: IntArray, pairs: int, benches: int, most: float) -> int:
    """Make room to search steps of so many pairs in, as `make_line` does."""
    drop(slots, STEP_MEMORY)
    size = lay_step(slots, 0, pairs, benches)
    if size > most:
        return size
    if not take(slots, STEP_MEMORY, size):
        return -1
    lay_step(slots, slots[OWNED + STEP_MEMORY], pairs, benches)
    return 0


@kernel
def fill(dance: Dance, family: Family, walk: Walk, limits: Vector) -> None:
    """Copy what a host says."""
    own, benches = dance.family, dance.walk.benches
    copy_row(own.numbers, family.numbers)
    copy_table(own.parts, family.parts)
    copy_table(own.sizes, family.sizes)
    copy_row(own.share, family.share)
    copy_table(dance.walk.rows, walk.rows)
    copy_row(benches.kind, walk.benches.kind)
    copy_row(dance.walk.kinds.group, walk.kinds.group)
    copy_row(dance.limits, limits)
    for n in range(FIGURES):
        dance.figures[n] = 0.0
    for i in range(dance.members.shape[0]):
        dance.members[i] = i
