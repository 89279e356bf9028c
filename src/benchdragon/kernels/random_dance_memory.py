"""The state of a question about a random dance, and its layout in the engine's own memory."""

from typing import NamedTuple

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import COLUMNS
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.family import Family, copy_family, family_shapes
from benchdragon.kernels.memory import (
    HEADER,
    ROW,
    Header,
    clear,
    copy_row,
    drop,
    lay,
    slot_count,
    slot_of,
    take,
)
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.question import Told
from benchdragon.kernels.random_dance_bound import FACTS, Bound
from benchdragon.kernels.random_numbers import DEVIATIONS, Random
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.search_room import placements, searches, walks
from benchdragon.kernels.time_of_impact import NOTES, Search
from benchdragon.kernels.workspace import Walk, copy_walk


class DanceGiven(Numbered):
    """What a host passes with a question, a row of floats."""

    # NEEDED: the pitch that the dance needs; TOUCHES: whether benches touch with the plan's own
    WHAT = 0
    MARGIN = 1  # distance that benches must keep, m
    FIRST = 2  # where the head of the plan's own walk begins and ends, m
    LAST = 3
    GUESS = 4  # the first guess of the pitch, m
    SEED = 5
    DANCE = 6  # its number, from 0
    BYTES = 7  # that tables may take at most
    BY = 8  # and from here on standard deviations: see kernels/random_numbers.py
    ASIDE = BY + Random.ASIDE
    STRAY = BY + Random.STRAY


DANCE_LIMITS = DanceGiven.BY + DEVIATIONS


class DanceSought(Numbered):
    """Goals: the pitch that a dance needs, or whether its benches touch."""

    NEEDED, TOUCHES = 0, 1


class DanceTold(Told):
    """The result, a row of floats that begins with the columns of `question.Told`."""

    RESULT = 2  # the pitch needed, m, or 1 if benches touch, else 0
    DOING = 3
    PITCH = 4  # on trial, m
    START = 5  # where the head begins and ends along the line, m
    END = 6
    PARTS = 7  # of the way that must be searched
    PART = 8  # the current one
    PLACE = 9  # in it, from 0
    PARTNERS = 10  # pairs that a bench may have near it
    HINTS = 11
    LOW = 12  # the lowest sampled distance, m; the head's position there, and the two benches
    LOW_AT = 13
    LOW_FRONT = 14
    LOW_REAR = 15
    SEEN = 16  # the lowest of the evenly spaced samples, m; its part, and place
    SEEN_PART = 17
    SEEN_PLACE = 18
    ROOM = 19  # with the pitch on trial, m: NaN where a bench cannot follow
    TRIALS = 20
    TOUCHING = 21  # the greatest pitch that touches, m, and the least one that is surely clear
    CLEAR = 22
    BEFORE = 23  # the pitch of the trial before, m, and its room
    ROOM_BEFORE = 24


DANCE_FIGURES = len(DanceTold)


class DanceSize(Numbered):
    """Sizes of what varies with the pitch, a row of whole numbers."""

    ROUTE_ROWS = 0
    POINTS = 1  # of the line
    NUMBERS = 2  # of its noise
    RADII = 3
    GRIDS = 4
    STRETCHES = 5
    PAIRS = 6


DANCE_SIZES = len(DanceSize)


class DanceMemory(Numbered):
    """Memories of the block.

    They hold rows of the route, the line, the arrays that a step is searched in, and all of fixed size.
    """

    ROWS, LINE, STEP, OWN = range(4)


# The most trials of pitches; steps of the head that are searched in one call.
MOST_PITCHES, STEPS_TOGETHER = 60, 100


class Drawn(NamedTuple):
    """The benches of a dance, and how far to the left of its line handles walk, m; none: on it."""

    links: Vector
    sizes: Table
    aside: Vector


class Dance(NamedTuple):
    """The dance of a question; fields from `line` to `bound` are as large as the pitch needs."""

    walk: Walk  # of exact people
    family: Family
    drawn: Drawn
    at: Vector  # scratch, of one slot
    placed: Placements
    members: IntVector  # all benches
    circles: Table  # scratch, five rows; the first are radii
    hints: Table  # head's way from the start and to the end, m, and how many benches to sample
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
DANCE_END_SLOT = HEADER + slot_count(Dance)
BASE = 8 * HEADER


@kernel
def lay_own(slots: IntArray, address: int, family: Family, walk: Walk, limits: Vector) -> int:
    """Lay out all arrays of fixed size from an address on; returns the bytes that they take."""
    benches, (_four, kinds) = walk.benches.kind.shape[0], walk.kinds.sizes.shape
    aside = benches + 1 if limits[DanceGiven.ASIDE] > 0.0 or limits[DanceGiven.STRAY] > 0.0 else 0
    row = (benches, ROW)
    return lay(slots, HEADER + 3, address, (
        *walks(benches, kinds), *family_shapes(family), row, (4, benches),
        (aside, ROW), (1, ROW), *placements(benches + 1, 1), row, (5, benches),
        (MOST_PITCHES + 2, 3), (STEPS_TOGETHER + 1, ROW), (NOTES, ROW), (DANCE_LIMITS, ROW),
        (DANCE_FIGURES, ROW),
        (DANCE_SIZES, ROW),
    ))  # fmt: skip


@kernel
def make_rows(slots: IntArray, rows: int) -> bool:
    """Make room for so many rows of the route; False without memory."""
    drop(slots, DanceMemory.ROWS)
    if not take(slots, DanceMemory.ROWS, 8 * rows * COLUMNS):
        return False
    lay(slots, HEADER, slots[Header.OWNED + DanceMemory.ROWS], ((rows, COLUMNS),))
    return True


@kernel
def lay_line(slots: IntArray, address: int, sizes: IntVector, benches: int) -> int:
    """Lay out from an address on the arrays of a pitch; returns the bytes that they take.

    Without points the line is the route.
    """
    points, bounded = sizes[DanceSize.POINTS], benches if sizes[DanceSize.RADII] else 0
    own, after = 0, address
    if points:
        own = lay(slots, LINE_SLOT, address, ((2 * points - 1, COLUMNS),))
        after += own
    else:
        lay(
            slots,
            LINE_SLOT,
            slots[Header.OWNED + DanceMemory.ROWS],
            ((sizes[DanceSize.ROUTE_ROWS], COLUMNS),),
        )
    one, more = (bounded, ROW), (bounded + 1, ROW)
    return own + lay(slots, LINE_SLOT + 3, after, (
        (points, ROW), (points, ROW), (sizes[DanceSize.NUMBERS], ROW), (max(sizes[DanceSize.STRETCHES],
        1), 3),
        (FACTS, ROW), (sizes[DanceSize.RADII], ROW), (sizes[DanceSize.GRIDS], ROW),
        (sizes[DanceSize.GRIDS], ROW),
        more, one, one, more, more, one, one, one, one, more, more,
    ))  # fmt: skip


@kernel
def lay_step(slots: IntArray, address: int, pairs: int, benches: int) -> int:
    """Lay out from an address on the arrays that a step is searched in; returns the bytes they take."""
    row = (pairs, ROW)
    return lay(slots, STEP_SLOT, address, (row, row, *searches(benches + 1, benches, pairs)))


@kernel
def roomy(slots: IntArray, memory: int, size: int, most: float) -> int:
    """Let a memory have `size` bytes: 0, `size` if that is over `most`, or -1 without memory."""
    drop(slots, memory)
    if size > most:
        return size
    return 0 if take(slots, memory, size) else -1


@kernel
def make_line(slots: IntArray, sizes: IntVector, benches: int, most: float) -> int:
    """Make room for the arrays of a pitch, as `roomy` does."""
    ending = roomy(slots, DanceMemory.LINE, lay_line(slots, 0, sizes, benches), most)
    if ending == 0:
        lay_line(slots, slots[Header.OWNED + DanceMemory.LINE], sizes, benches)
    return ending


@kernel
def make_step(slots: IntArray, pairs: int, benches: int, most: float) -> int:
    """Make room to search steps of so many pairs in, as `roomy` does."""
    ending = roomy(slots, DanceMemory.STEP, lay_step(slots, 0, pairs, benches), most)
    if ending == 0:
        lay_step(slots, slots[Header.OWNED + DanceMemory.STEP], pairs, benches)
    return ending


@kernel
def fill(dance: Dance, family: Family, walk: Walk, limits: Vector) -> None:
    """Copy what a host passes."""
    copy_family(dance.family, family)
    copy_walk(dance.walk, walk)
    copy_row(dance.limits, limits)
    clear(dance.figures)
    for i in range(dance.members.shape[0]):
        dance.members[i] = i
