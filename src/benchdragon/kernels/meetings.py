"""Which pairs of benches may meet in which steps of the head, all along a walk.

The head's walk is prepared stride by stride: cells of the route ahead (kernels/cells.py), whether all
benches surely follow through them, then step by step the benches that stand in partners. Where it is
not sure that a bench follows its way is looked at in finer and finer parts, and the last of it is
searched for all pairs that come near by their travel.
"""

import math
from typing import NamedTuple

import numpy as np

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.box import CX, CY, HALF_LENGTH, HALF_WIDTH, set_box
from benchdragon.kernels.cells import (
    CELL,
    CELLS,
    CHILD,
    DOUBTS,
    ENTRIES,
    FIRST,
    GROUP,
    GROUPS,
    LOW,
    MIXED,
    NEXT,
    NUMBER,
    PARTNER,
    PARTS,
    RADIUS,
    REACH,
    REAR,
    ROW,
    WAYS,
    Grids,
    Ground,
    Kinds,
    Sweeper,
    boxes_near,
    extend,
    log_borders,
    sweeper_for,
)
from benchdragon.kernels.chain import march
from benchdragon.kernels.curve import S_START, FloatArray, length_at
from benchdragon.kernels.grid import Grid, gather, put
from benchdragon.kernels.jit import kernel
from benchdragon.kernels.regions import EDGE, add_pair, first_behind, walks_on
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.search import log_chain
from benchdragon.kernels.step_bounds import HANDLE_COLUMNS, Placements, place_chain

# Head's walk, m, that is prepared at a time: at least so much, or this share of the route known.
LEAST_STRIDE, SHARE = 4.0, 0.01
# Cells in which it is unsure whether a bench can walk through are looked at in so many parts at first,
# then in finer ones, down to this, m: far coarser, and overlaps just before a fold would stay unknown.
CAREFUL_PARTS, FINEST = 16, 1e-9
# A unit in the last place of a number is at most this share of it.
UNIT = 2.3e-16
# Looked at between two calls: so many steps without a pair.
STEPS_A_CALL = 4096

# Where a walk stands, a row of floats: head positions, m.
AT = 0  # all steps up to here were given
GOAL = 1  # where the search ends
UPTO = 2  # the route is known up to here
KNOWN = 3  # cells name all pairs up to here
SOUND = 4  # all benches surely follow up to here
STEP_START = 5  # of the step at hand
STEP_END = 6
COURSE = 7
# What is counted of it, a row of whole numbers.
SLOT = 0  # the next step of the block
SLOTS = 1  # steps in it
BENCHES = 2  # in it
PAIRS = 3  # of the step at hand
PLACED = 4  # handles in slot 0 of the search
CHAINS = 5  # logged
TALLY = 6

# How looking for the next step ended.
STEP = 0
DONE = 1  # no pair comes near up to the end
WAIT = 2  # nothing yet: call again
STOPPED = 3  # it cannot be shown that all benches follow past SOUND
NARROW = 4  # more room is wanted, see the counts


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


class Block(NamedTuple):
    """Dragons at the borders of steps to come."""

    at: Vector  # head positions, m
    places: Placements
    s: Table  # route positions of the handles, m, (handles, slots)
    log: Table  # for a proof: see `search.log_chain`


class Crowd(NamedTuple):
    """All benches at the start of a step, boxed, in a grid."""

    hulls: Table  # (benches, cells.HULL_COLUMNS)
    grid: Grid
    found: IntVector


class Meeting(NamedTuple):
    """The pairs of a step: of benches, then of members; the last are scratch, one for each bench."""

    first: IntVector
    second: IntVector
    mine: IntVector
    other: IntVector
    members: IntVector
    place: IntVector  # all -1


class Course(NamedTuple):
    """Where a walk stands."""

    way: Vector
    tally: IntVector


@kernel
def log_block(block: Block, tally: IntArray, slots: int, handles: int) -> None:
    """Log the chains in the first slots, if there is room; they count in any case."""
    for t in range(slots):
        n = tally[CHAINS]
        tally[CHAINS] = n + 1
        if n < block.log.shape[0]:
            log_chain(block.log, n, block.at[t], handles, block.places, t)


@kernel
def place_block(rows: FloatArray, links: FloatArray, block: Block, tally: IntArray, slots: int) -> bool:
    """Place chains with these links at the first slots; whether all stand."""
    places, s = block.places, block.s
    march(
        rows, links, block.at, 0, slots, places.row, places.u, places.x, places.y, places.ratio,
        places.failed,
    )  # fmt: skip
    for t in range(slots):
        if places.failed[0, t]:
            return False
    for i in range(links.shape[0] + 1):
        for t in range(slots):
            j = places.row[i, t]
            s[i, t] = rows[j, S_START] + length_at(rows, j, places.u[i, t])
    log_block(block, tally, slots, links.shape[0] + 1)
    return True


@kernel
def group_span_end(ground: Ground, a: int, b: int, s: float) -> float:
    """The end of the clear span of groups a and b that began by route position s, m; s without one."""
    groups, end = ground.counts[GROUPS], s
    each = ground.spans.shape[0] // (groups * groups)
    for n in range(each):
        row = (a * groups + b) * each + n
        if ground.spans[row, 0] <= s:
            end = max(end, ground.spans[row, 1])
    return end


@kernel
def clear_end(ground: Ground, head: int, s: float) -> float:
    """Up to where the head, of group `head`, surely meets no other, standing at s, m; s if nowhere."""
    end = math.inf
    for b in range(ground.counts[GROUPS]):
        if ground.groups[head, WAYS + b] < math.inf:
            end = min(end, group_span_end(ground, head, b, s))
    return end if end < math.inf else s


@kernel
def arrival(
    rows: FloatArray,
    benches: Benches,
    block: Block,
    tally: IntArray,
    i: int,
    back: float,
    start: float,
    end: float,
) -> float:
    """At most the head's position in start..end at which handle i comes to `back`, m."""
    if i == 0:
        return min(max(back, start), end)
    low, high, middle = start, end, end  # it may not come so far
    while low < middle:
        block.at[0] = middle
        if place_block(rows, benches.links[:i], block, tally, 1) and block.s[i, 0] < back:
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
def follows_until(
    rows: FloatArray, kinds: Kinds, ground: Ground, sweeper: Sweeper, k: int, start: float, end: float
) -> float:
    """The place up to which benches of kind k surely follow, their front handle from start, m.

    The way is halved where it is unsure; `end`, if all the way.
    """
    at, step, handles = start, (end - start) / CAREFUL_PARTS, np.empty((2, HANDLE_COLUMNS))
    sweeper.link[0] = kinds.sizes[0, k] - kinds.sizes[2, k] - kinds.sizes[3, k]
    while at < end:
        ahead = min(end, at + step)
        sweeper.at[0], sweeper.at[1] = at, ahead
        place_chain(rows, sweeper.link, sweeper.at, 0, 2, sweeper.places)
        log_borders(ground, sweeper, 2)
        if walks_on(rows, sweeper.places, 0, sweeper.link, handles):
            at, step = ahead, 2.0 * step
        elif step > finest(at):
            step *= 0.5
        else:
            return at
    return end


@kernel
def next_of_kind(benches: Benches, s: FloatArray, t: int, k: int, ahead: float, since: int) -> int:
    """The first bench of kind k from `since` on that stands behind `ahead` in slot t; -1: none."""
    for i in range(since, benches.kind.shape[0]):
        if benches.kind[i] == k and s[i, t] < ahead:
            return i
    return -1


@kernel
def pass_doubt(
    rows: FloatArray,
    benches: Benches,
    kinds: Kinds,
    ground: Ground,
    sweeper: Sweeper,
    block: Block,
    course: Course,
    doubt: int,
) -> bool:
    """Draw KNOWN and SOUND in to where a doubtful cell lets benches pass; whether no doubt is left.

    Slot 1 of the block holds the dragon at the start of the stride. Who comes first to the cell is
    looked at, and the next, where that one stands inside: it comes through what lies behind it.
    """  # fmt: skip
    k, c, way, tally = ground.doubts[doubt, 0], ground.doubts[doubt, 1], course.way, course.tally
    cell = ground.measures[CELL]
    back, ahead = (c + ground.counts[LOW]) * cell, (c + ground.counts[LOW] + 1) * cell
    i, settled, inside = next_of_kind(benches, block.s, 1, k, ahead, 0), False, True
    for _ in range(2):
        if i < 0 or not inside:
            break
        at = block.s[i, 1]
        inside = at > back
        first = arrival(rows, benches, block, tally, i, max(back, at), way[AT], way[SOUND])
        if first < way[SOUND]:
            place = follows_until(rows, kinds, ground, sweeper, k, max(back, at), max(ahead, at))
            if place < max(ahead, at):
                way[KNOWN] = min(way[KNOWN], first)
                way[SOUND] = arrival(rows, benches, block, tally, i, place, way[AT], way[SOUND])
            else:
                settled = settled or not inside
        i = next_of_kind(benches, block.s, 1, k, ahead, i + 1)
    way[KNOWN] = min(way[KNOWN], way[SOUND])
    return settled


@kernel
def look_through(
    rows: FloatArray,
    benches: Benches,
    kinds: Kinds,
    ground: Ground,
    sweeper: Sweeper,
    block: Block,
    course: Course,
) -> bool:
    """Fill KNOWN and SOUND for the stride from AT to UPTO; False if none can stand at AT."""
    way, counts, doubts = course.way, ground.counts, ground.doubts
    way[KNOWN] = way[SOUND] = way[UPTO]
    if counts[DOUBTS] == 0:
        return True
    block.at[0] = block.at[1] = way[AT]
    if not place_block(rows, benches.links, block, course.tally, 2):
        return False
    n = 0
    while n < counts[DOUBTS]:
        if pass_doubt(rows, benches, kinds, ground, sweeper, block, course, n):
            counts[DOUBTS] -= 1
            doubts[n, 0], doubts[n, 1] = doubts[counts[DOUBTS], 0], doubts[counts[DOUBTS], 1]
        else:
            n += 1
    return True


@kernel
def next_stride(
    rows: FloatArray,
    benches: Benches,
    kinds: Kinds,
    ground: Ground,
    grids: Grids,
    block: Block,
    course: Course,
) -> int:
    """Prepare the walk past SOUND; STEP if there is more of it, DONE, STOPPED or NARROW."""
    way, tally = course.way, course.tally
    if way[SOUND] < way[UPTO]:
        return STOPPED
    if way[UPTO] >= way[GOAL]:
        return DONE
    known = way[AT] - ground.counts[LOW] * ground.measures[CELL]
    stride = max(LEAST_STRIDE, SHARE * known)
    upto = way[AT] + stride
    if ground.counts[MIXED] == 0:
        upto = max(upto, clear_end(ground, kinds.group[benches.kind[0]], way[AT]))
    upto = min(upto, way[GOAL])
    sweeper = sweeper_for()
    if not extend(rows, kinds, ground, sweeper, grids, upto):
        return NARROW
    way[UPTO] = upto
    tally[SLOT] = tally[SLOTS] = 0
    if look_through(rows, benches, kinds, ground, sweeper, block, course):
        return STEP
    way[SOUND] = way[AT]
    return STOPPED


@kernel
def benches_reaching(benches: Benches, head: float, back: float) -> int:
    """How many benches may stand ahead of route position `back` with the head at `head`, m.

    The way along the route from handle to handle is never shorter than the link between them.
    """
    low, high = 0, benches.ahead.shape[0]
    while low < high:
        middle = (low + high) // 2
        if head - benches.ahead[middle] >= back:
            low = middle + 1
        else:
            high = middle
    return low


@kernel
def next_block(rows: FloatArray, benches: Benches, ground: Ground, block: Block, course: Course) -> int:
    """Place dragons at the borders of the next steps; STEP, or STOPPED if they do not stand."""
    way, tally, counts = course.way, course.tally, ground.counts
    cells = way[AT] < way[KNOWN]
    end = way[KNOWN] if cells else way[SOUND]
    size, slots = ground.measures[CELL] / PARTS, 1
    count = block.at.shape[0]
    block.at[0] = way[AT]
    while slots < count and block.at[slots - 1] < end:
        at = way[AT] + slots * size
        # What rounding leaves of the last step is joined to it.
        block.at[slots] = end if at > end - 1e-3 * size else at
        slots += 1
    back = (counts[REAR] + counts[LOW] * PARTS) * size - EDGE if cells else -math.inf
    tally[BENCHES] = benches_reaching(benches, block.at[slots - 1], back)
    tally[SLOT], tally[SLOTS] = 0, slots - 1
    if tally[BENCHES] < 3:
        return STEP
    links = benches.links if not cells else benches.links[: tally[BENCHES] - 1]
    return STEP if place_block(rows, links, block, tally, slots) else STOPPED


@kernel
def meeting_pairs(
    benches: Benches,
    kinds: Kinds,
    ground: Ground,
    s: FloatArray,
    t: int,
    count: int,
    first: IntArray,
    second: IntArray,
) -> int:
    """Pairs of the first benches that may meet between slots t and t + 1; how many.

    s[i, t] are their front handles' route positions, m. Counts on where first, second are full.
    """  # fmt: skip
    counts, tree, partners = ground.counts, ground.tree, ground.partners
    size, low, most = ground.measures[CELL] / PARTS, counts[LOW] * PARTS, counts[CELLS] * PARTS
    cells, found = ground.middles.shape[0], 0
    for i in range(count - 2):
        since, g = found, kinds.group[benches.kind[i]]
        a = math.floor((s[i, t] - EDGE) / size) - low
        b = math.floor((s[i, t + 1] + EDGE) / size) - low
        for c in range(max(a, 0), min(b, most - 1) + 1):
            child = tree[g * cells + c // PARTS, CHILD]
            n = tree[child + c % PARTS, PARTNER] if child else 0
            while n:
                row, n = partners[n - 1, ROW], partners[n - 1, NEXT]
                back = (tree[row, NUMBER] + low) * size - EDGE
                j = first_behind(s, t, back + size + 2.0 * EDGE, i + 2, count)
                while j < count and s[j, t + 1] >= back:
                    if kinds.group[benches.kind[j]] == tree[row, GROUP]:
                        found = add_pair(first, second, since, found, i, j)
                    j += 1
    return found


@kernel
def crowd_pairs(
    benches: Benches,
    block: Block,
    t: int,
    crowd: Crowd,
    reach: float,
    first: IntArray,
    second: IntArray,
) -> int:
    """Pairs of all benches that may come within reach between slots t and t + 1; how many.

    No point moves farther than the lever times the farthest way of any handle.
    """  # fmt: skip
    hulls, count, travel, found = crowd.hulls, benches.kind.shape[0], 0.0, 0
    for i in range(count + 1):
        travel = max(travel, block.s[i, t + 1] - block.s[i, t])
    near, widest = reach + 2.0 * benches.lever[0] * travel, 0.0
    for b in range(crowd.grid.heads.shape[0]):
        crowd.grid.heads[b] = 0
    for i in range(count):
        set_box(benches.sizes, i, block.places.x, block.places.y, t, hulls, i)
        hulls[i, RADIUS] = math.hypot(hulls[i, HALF_LENGTH], hulls[i, HALF_WIDTH])
        widest = max(widest, hulls[i, RADIUS])
    for j in range(2, count):
        put(crowd.grid, j - 2, hulls[j - 2, CX], hulls[j - 2, CY])
        far = hulls[j, RADIUS] + widest + near
        for n in range(gather(crowd.grid, hulls[j, CX], hulls[j, CY], far, crowd.found)):
            i = crowd.found[n]
            if boxes_near(hulls, i, j, near):
                if found < first.shape[0]:
                    first[found], second[found] = i, j
                found += 1
    return found


@kernel
def step_pairs(
    benches: Benches,
    kinds: Kinds,
    ground: Ground,
    block: Block,
    crowd: Crowd,
    course: Course,
    meeting: Meeting,
) -> int:
    """Pairs of the next step of the block; how many."""  # fmt: skip
    way, tally, t = course.way, course.tally, course.tally[SLOT]
    if way[AT] >= way[KNOWN]:
        reach = ground.measures[REACH]
        return crowd_pairs(benches, block, t, crowd, reach, meeting.first, meeting.second)
    return meeting_pairs(
        benches, kinds, ground, block.s, t, tally[BENCHES], meeting.first, meeting.second
    )


@kernel
def next_step(
    rows: FloatArray,
    benches: Benches,
    kinds: Kinds,
    ground: Ground,
    grids: Grids,
    block: Block,
    crowd: Crowd,
    course: Course,
    meeting: Meeting,
) -> int:
    """Find the next step in which pairs may come within reach; how that ended, as above."""
    way, tally, size = course.way, course.tally, ground.measures[CELL] / PARTS
    for _ in range(STEPS_A_CALL):
        if tally[SLOT] >= tally[SLOTS]:
            ending = STEP
            if way[AT] >= way[SOUND]:
                ending = next_stride(rows, benches, kinds, ground, grids, block, course)
            elif way[AT] >= way[KNOWN] or not skip_to_partners(ground, way, size):
                ending = next_block(rows, benches, ground, block, course)
            if ending != STEP:
                return ending
            continue
        t, found = tally[SLOT], 0
        if tally[BENCHES] >= 3:
            found = step_pairs(benches, kinds, ground, block, crowd, course, meeting)
        if found > meeting.first.shape[0]:
            tally[PAIRS] = found
            return NARROW
        way[STEP_START], way[STEP_END] = block.at[t], block.at[t + 1]
        way[AT], tally[SLOT], tally[PAIRS] = block.at[t + 1], t + 1, found
        if found:
            return STEP
    return WAIT


@kernel
def skip_to_partners(ground: Ground, way: FloatArray, size: float) -> bool:
    """Pass over what no bench can meet another in, up to KNOWN; whether that is all."""
    begin = way[KNOWN]
    if ground.counts[ENTRIES]:
        begin = (ground.counts[FIRST] + ground.counts[LOW] * PARTS - 1) * size
    if begin > way[AT]:
        way[AT] = min(begin, way[KNOWN])
    return way[AT] >= way[KNOWN]
