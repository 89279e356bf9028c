"""The state of a question about contact, and its layout in a block of the engine's own memory."""

from typing import NamedTuple

from benchdragon.kernels import memory, search_room
from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import COLUMNS
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.kinds import find_kinds
from benchdragon.kernels.memory import ROW, Header
from benchdragon.kernels.nearness import NEARNESS
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.question import Told
from benchdragon.kernels.rounding import SEAM_COLUMNS, find_seams
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.search_room import (
    Beginning,
    RoomSize,
    SearchMemory,
    lay_block,
    placements,
    walks,
)
from benchdragon.kernels.spiral import LANES
from benchdragon.kernels.time_of_impact import NOTES
from benchdragon.kernels.walk_search import WalkGoal
from benchdragon.kernels.workspace import Benches, Walk, Workspace


class ContactGoal(WalkGoal):
    """Goals of a question, besides those of a search along a walk.

    Each search starts where the one before found its goal; LEAST covers the whole walk. SEEK finds the
    next step in which pairs may come within reach.
    """

    SEEN = 4  # the least distance that is sampled
    BETWEEN = 5  # the least distance between two head positions, around a known one
    NOTHING = -1


class ContactEnding(Numbered):
    """Exit statuses of steps, besides those of kernels/time_of_impact.py and kernels/question.py."""

    STOPPED = 30  # the chain cannot be followed past SOUND_TO; the reason lies before UNTIL
    UNSHOWN = 31  # the dragon could not be shown to have a place where a span begins
    ENDLESS = 32  # the route has too many cells
    BLURRED = 33  # rounding errors, OFF_BY, exceed what a search allows for
    FARTHER = 34  # LEAST: no pair comes nearer than WITHIN, nor than FLOOR_AT


class ContactGiven(Numbered):
    """What a host passes with a question, a row of floats."""

    MARGIN = 0  # distance that benches must keep, m
    LEAST_OFF = 1  # least error that is assumed of computed distances, m
    WIDTH = 2  # parts of a step narrower than this, m, are not halved
    MOST = 3  # chains marched in one step of a search
    MOST_LEAST = 4  # the same for the least distance
    BYTES = 5  # that tables may take at most
    BEGIN = 6  # head positions that are searched, m: from here
    END = 7  # to here
    MOST_KINDS = 8  # sizes of benches there may be
    REFINING = 9  # handles that may be placed to refine a bracket to the first tolerance
    REFINING_ON = 10  # and to each of the others


CONTACT_LIMITS = len(ContactGiven)


class ContactTold(Told):
    """The result of a question, a row of floats that begins with the columns of `question.Told`."""

    WALKED = 2  # the head position up to which the walk is searched, m
    EARLY = 3  # head positions that bracket what was found, m
    LATE = 4
    FIRST_BENCH = 5  # its two benches, from 0
    SECOND_BENCH = 6
    OFF_BY = 7  # the largest error bound of distances that decided, m
    MARCHED = 8  # chains, in searches
    BEST = 9  # the least distance seen, m
    FLOOR_AT = 10  # no pair is nearer, m
    SOUND_TO = 11  # where the chain cannot be followed, m, and up to where the reason lies
    UNTIL = 12
    EARLY_LEAD = 26  # how far ahead of EARLY, m, the head is placed at least, and of LATE at most
    LATE_LEAD = 27
    # What the search keeps to itself.
    GOAL, STAGE, READY, SPAN, BEGUN, NEAR, LEFT = range(13, 20)
    PASS, ASIDE, AIMED, REACH, WITHIN, WHERE = range(20, 26)


CONTACT_FIGURES = len(ContactTold)


class ContactMemory(SearchMemory):
    """The memory of the block that holds all arrays of fixed size."""

    OWN = 3


# The least number of head positions at which a pair is sampled at a time.
FEWEST = 4


class Hunt(NamedTuple):
    """A search for contacts; the fields from `at` to `bench_off` are scratch, of all benches."""

    walk: Walk
    seams: Table  # (rows, SEAM_COLUMNS)
    room: Workspace
    sizes: IntVector  # of the room
    beginnings: IntVector  # of the room at first: see search_room
    spans: Table  # of the head's way that are searched, m, (spans, 2)
    at: Vector
    placed: Placements
    boxes: Table
    lanes: Vector
    errors: Vector
    bench_off: Vector
    limits: Vector
    tolerances: Vector  # widths of brackets, m: the first one that can be reached counts
    figures: Vector
    near: Vector  # the nearness of the pair that was found: see kernels/nearness.py
    note: Vector


CONTACT_WALK_SLOT, CONTACT_ROOM_SLOT = memory.slot_of(Hunt, "walk"), memory.slot_of(Hunt, "room")
SIZES_SLOT = memory.slot_of(Hunt, "sizes")
KINDS_SLOT = CONTACT_WALK_SLOT + 3 + memory.slot_count(Benches)
CONTACT_END_SLOT = memory.HEADER + memory.slot_count(Hunt)
# The offset of the search in a block, in bytes.
BASE = 8 * memory.HEADER


class ContactAsked(NamedTuple):
    """What a host passes to open a question."""

    rows: Table
    links: Vector
    sizes: Table  # of benches, (4, benches)
    lever: Vector  # (1,)
    spans: Table
    limits: Vector
    tolerances: Vector
    beginnings: IntVector


@kernel
def lay_hunt(slots: IntArray, address: int, asked: ContactAsked) -> int:
    """Lay out all arrays of fixed size from an address on; returns the bytes that they take."""
    rows, benches = asked.rows.shape[0], asked.links.shape[0]
    places = asked.beginnings[Beginning.PLACES]
    kinds = min(benches, int(asked.limits[ContactGiven.MOST_KINDS]))
    count = max(FEWEST, min(LANES, places // (benches + 1)))
    memory.lay(slots, CONTACT_WALK_SLOT, address, (
        (rows, COLUMNS), *walks(benches, kinds), (rows, SEAM_COLUMNS),
    ))  # fmt: skip
    end = lay_block(slots, CONTACT_ROOM_SLOT, slots[Header.ADDRESS], benches, places)
    return end - address + memory.lay(slots, SIZES_SLOT, end, (
        (search_room.ROOM_SIZES, ROW), (search_room.BEGINNINGS, ROW), (asked.spans.shape[0], 2),
        (count, ROW), *placements(benches + 1, count), (2, BOX_COLUMNS), (benches, ROW),
        (benches + 1, ROW), (benches, ROW), (CONTACT_LIMITS, ROW), (asked.tolerances.shape[0], ROW),
        (CONTACT_FIGURES, ROW), (NEARNESS, ROW), (NOTES, ROW),
    ))  # fmt: skip


@kernel
def fill_hunt(block: int, asked: ContactAsked) -> bool:
    """Copy what a host passes; False if the benches are of too many kinds."""
    hunt = memory.group_at(Hunt, block + BASE)
    benches, kinds, ahead = hunt.walk.benches, hunt.walk.kinds, 0.0
    memory.copy_table(hunt.walk.rows, asked.rows)
    memory.copy_row(benches.links, asked.links)
    memory.copy_table(benches.sizes, asked.sizes)
    for i in range(asked.links.shape[0]):
        benches.ahead[i] = ahead
        ahead += asked.links[i]
    memory.copy_row(benches.lever, asked.lever)
    find_seams(hunt.walk.rows, hunt.seams)
    memory.copy_row(hunt.beginnings, asked.beginnings)
    memory.copy_table(hunt.spans, asked.spans)
    memory.copy_row(hunt.limits, asked.limits)
    memory.copy_row(hunt.tolerances, asked.tolerances)
    hunt.sizes[RoomSize.ROUTE_ROWS] = asked.rows.shape[0]
    for n in range(CONTACT_FIGURES):
        hunt.figures[n] = 0.0
    count = find_kinds(benches.sizes, kinds.sizes, benches.kind, kinds.group)
    most = kinds.sizes.shape[1]
    if count > most:
        return False
    for n in range(4):
        for k in range(count):  # from now on in rows of `count` numbers
            at = n * count + k
            kinds.sizes[at // most, at % most] = kinds.sizes[n, k]
    slots = memory.integers_at(block, CONTACT_END_SLOT)
    slots[KINDS_SLOT + 2] = slots[KINDS_SLOT + 4] = count
    return True
