"""What a question about contact knows, and where that lies in a block of the engine's own memory."""

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
    """What may be sought, besides what a walk is searched for.

    Each is sought from where the one before was found, LEAST of the whole; SEEK seeks the next step in
    which pairs may come within reach.
    """

    SEEN = 4  # the least distance that is seen here and there
    BETWEEN = 5  # the least between two head positions, about one that is known
    NOTHING = -1


class ContactEnding(Numbered):
    """How steps end, besides the ways of kernels/time_of_impact.py and kernels/question.py."""

    STOPPED = 30  # the walk could not be followed past SOUND_TO: why may be seen up to UNTIL
    UNSHOWN = 31  # it could not be shown that the dragon stands where a span begins
    ENDLESS = 32  # the route has too many cells
    BLURRED = 33  # rounding may hide more than a search allows for, OFF_BY
    FARTHER = 34  # LEAST: no pair comes nearer than WITHIN, nor than FLOOR_AT


class ContactGiven(Numbered):
    """What hosts say of a question, a row of floats."""

    MARGIN = 0  # distance that benches must keep, m
    LEAST_OFF = 1  # what computed distances count as off by at least, m
    WIDTH = 2  # parts of a step narrower than this, m, are not halved
    MOST = 3  # chains marched in one step of a search
    MOST_LEAST = 4  # likewise for the least distance
    BYTES = 5  # that tables may take
    BEGIN = 6  # between which head positions it is, m
    END = 7
    MOST_KINDS = 8  # sizes of benches there may be
    REFINING = 9  # handles that a bracket may be refined with to the first tolerance
    REFINING_ON = 10  # and to each of the others


CONTACT_LIMITS = len(ContactGiven)


class ContactTold(Told):
    """What is told of it, a row of floats that begins as kernels/question.py says."""

    WALKED = 2  # the head position up to which it has come, m
    EARLY = 3  # between which head positions it was found, m
    LATE = 4
    FIRST_BENCH = 5  # of which benches, from 0
    SECOND_BENCH = 6
    OFF_BY = 7  # what distances that mattered may be off by, m
    MARCHED = 8  # chains, in searches
    BEST = 9  # the least distance seen, m
    FLOOR_AT = 10  # no pair is nearer, m
    SOUND_TO = 11  # where the walk could not be followed, m, and up to where that may be looked for
    UNTIL = 12
    EARLY_LEAD = 26  # how far ahead of EARLY, m, the head is placed at least, and of LATE at most
    LATE_LEAD = 27
    # What is its own.
    GOAL, STAGE, READY, SPAN, BEGUN, NEAR, LEFT = range(13, 20)
    PASS, ASIDE, AIMED, REACH, WITHIN, WHERE = range(20, 26)


CONTACT_FIGURES = len(ContactTold)


class ContactMemory(SearchMemory):
    """The memory of the block that all lies in that keeps its size."""

    OWN = 3


# Head positions at which a pair is looked at, at least.
FEWEST = 4


class Hunt(NamedTuple):
    """A search for contacts; what stands from `at` to `bench_off` is scratch, of all benches."""

    walk: Walk
    seams: Table  # (rows, SEAM_COLUMNS)
    room: Workspace
    sizes: IntVector  # of the room
    beginnings: IntVector  # likewise: see search_room
    spans: Table  # of the head's way, m, (spans, 2)
    at: Vector
    placed: Placements
    boxes: Table
    lanes: Vector
    errors: Vector
    bench_off: Vector
    limits: Vector
    tolerances: Vector  # widths of brackets, m: the first that can be
    figures: Vector
    near: Vector  # how near the pair is that was found: see kernels/nearness.py
    note: Vector


CONTACT_WALK_SLOT, CONTACT_ROOM_SLOT = memory.slot_of(Hunt, "walk"), memory.slot_of(Hunt, "room")
SIZES_SLOT = memory.slot_of(Hunt, "sizes")
KINDS_SLOT = CONTACT_WALK_SLOT + 3 + memory.slot_count(Benches)
CONTACT_END_SLOT = memory.HEADER + memory.slot_count(Hunt)
# Where it begins in a block, in bytes.
BASE = 8 * memory.HEADER


class ContactAsked(NamedTuple):
    """What a host hands over."""

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
    """Lay all from an address on that keeps its size; the bytes that takes."""
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
    """Copy what a host says; whether the benches are not of too many kinds."""
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
        for k in range(count):  # in rows of as many as there are, from now on
            at = n * count + k
            kinds.sizes[at // most, at % most] = kinds.sizes[n, k]
    slots = memory.integers_at(block, CONTACT_END_SLOT)
    slots[KINDS_SLOT + 2] = slots[KINDS_SLOT + 4] = count
    return True
