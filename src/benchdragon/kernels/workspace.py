"""The state of a search along a walk: dragon, progress, dragons placed ahead, candidate pairs."""

from typing import NamedTuple

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.box_hierarchy import Grids, Hierarchy, Kinds
from benchdragon.kernels.chain import Placements, march
from benchdragon.kernels.curve import FloatArray, RouteRow, length_at
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.grid import Grid
from benchdragon.kernels.memory import copy_row, copy_table
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.time_of_impact import Search


class Course(Numbered):
    """Where a walk stands, a row of floats: head positions, m."""

    AT = 0  # all steps up to here were given
    GOAL = 1  # where the search ends
    UPTO = 2  # the route is known up to here
    KNOWN = 3  # cells name all pairs up to here
    SOUND = 4  # all benches surely follow up to here
    STEP_START = 5  # of the current step
    STEP_END = 6


COURSE = len(Course)


class WalkTally(Numbered):
    """Counts of a walk, a row of whole numbers."""

    SLOT = 0  # the next step of the block
    SLOTS = 1  # steps in it
    BENCHES = 2  # in it
    PAIRS = 3  # of the current step
    PLACED = 4  # handles in slot 0 of the search
    CHAINS = 5  # placed in blocks


TALLY = len(WalkTally)


class Benches(NamedTuple):
    """The benches of a dragon."""

    links: Vector
    sizes: Table  # (4, benches)
    kind: IntVector
    ahead: Vector  # of each, the links before it, m
    lever: Vector  # how far a point moves when handles move by 1 m, (1,)


class Walk(NamedTuple):
    """A dragon on a route."""

    rows: Table
    benches: Benches
    kinds: Kinds


@kernel
def copy_walk(own: Walk, walk: Walk) -> None:
    """Copy all of a walk."""
    benches, others = own.benches, walk.benches
    copy_table(own.rows, walk.rows)
    copy_row(benches.links, others.links)
    copy_table(benches.sizes, others.sizes)
    copy_row(benches.kind, others.kind)
    copy_row(benches.ahead, others.ahead)
    copy_row(benches.lever, others.lever)
    copy_table(own.kinds.sizes, walk.kinds.sizes)
    copy_row(own.kinds.group, walk.kinds.group)


class HeadSamples(NamedTuple):
    """Dragons at the borders of steps to come."""

    at: Vector  # head positions, m
    places: Placements
    s: Table  # route positions of the handles, m, (handles, slots)


class StepIndex(NamedTuple):
    """All benches at the start of a step, boxed, in a grid."""

    hulls: Table  # (benches, HULL_COLUMNS)
    grid: Grid
    found: IntVector


class CandidatePairs(NamedTuple):
    """The pairs of a step: of benches, then of members; the last are scratch, one for each bench."""

    first: IntVector
    second: IntVector
    mine: IntVector
    other: IntVector
    members: IntVector
    place: IntVector  # all -1


class SearchProgress(NamedTuple):
    """Where a walk stands."""

    way: Vector
    tally: IntVector


class Workspace(NamedTuple):
    """The arrays of a search along a walk: see kernels/search_room.py."""

    ground: Hierarchy
    grids: Grids
    block: HeadSamples
    crowd: StepIndex
    course: SearchProgress
    meeting: CandidatePairs
    search: Search


@kernel
def place_samples(
    rows: FloatArray, links: FloatArray, block: HeadSamples, tally: IntArray, slots: int
) -> bool:
    """Place chains with these links at the first slots; whether all stand."""
    places, s = block.places, block.s
    march(rows, links, block.at, 0, slots, places)
    for t in range(slots):
        if places.failed[0, t]:
            return False
    for i in range(links.shape[0] + 1):
        for t in range(slots):
            j = places.row[i, t]
            s[i, t] = rows[j, RouteRow.S_START] + length_at(rows, j, places.u[i, t])
    tally[WalkTally.CHAINS] += slots
    return True
