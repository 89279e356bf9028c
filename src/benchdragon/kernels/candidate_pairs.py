"""The candidate pairs of the broad phase: which benches may meet in which steps of the head.

The head's walk is prepared stride by stride: cells of the route ahead (kernels/broad_phase.py), whether
all benches are certain to follow through them (kernels/continuation.py), then step by step the benches
that stand in overlapping boxes. The rest of the way, up to a bench that may not follow, is searched for
all pairs that may meet by their travel.
"""

import math

import numpy as np

from benchdragon.kernels import box_hierarchy as of
from benchdragon.kernels.box import Box, half_diagonal, set_box
from benchdragon.kernels.box_hierarchy import (
    BenchGroup,
    BoxCount,
    BoxMeasure,
    Hierarchy,
    Hull,
    Kinds,
    Node,
    Partner,
)
from benchdragon.kernels.broad_phase import BoxScratch, boxes_near, extend_hierarchy
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.continuation import certify_stride
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import allocates, kernel
from benchdragon.kernels.grid import gather, put
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.spiral import LANES
from benchdragon.kernels.swept_boxes import EDGE, add_pair, first_behind
from benchdragon.kernels.workspace import Benches, Course, Walk, WalkTally, Workspace, place_samples

# Head's walk, m, that is prepared at a time: at least this share of the route known, or so much. A
# search that ends soon wastes less of a short stride, others fill more lanes in a long one.
SHARE, SHORT_STRIDE, LONG_STRIDE = 0.01, 4.0, 12.0
# The most steps without a pair that are passed in one call.
STEPS_A_CALL = 4096


class NextStep(Numbered):
    """Exit status of the search for the next step."""

    STEP = 0
    DONE = 1  # no pair comes near up to the end
    WAIT = 2  # nothing yet: call again
    STOPPED = 3  # past SOUND not all benches are certified to follow
    NARROW = 4  # arrays are too small: see the counts


@kernel
def group_span_end(ground: Hierarchy, a: int, b: int, s: float) -> float:
    """The end of the clear span of groups a and b that began by route position s, m; s without one."""
    groups, end = ground.counts[BoxCount.GROUPS], s
    each = ground.spans.shape[0] // (groups * groups)
    for n in range(each):
        row = (a * groups + b) * each + n
        if ground.spans[row, 0] <= s:
            end = max(end, ground.spans[row, 1])
    return end


@kernel
def clear_end(ground: Hierarchy, head: int, s: float) -> float:
    """The position up to which the head, of group `head`, at s, m, is certain to meet none; or s."""
    end = math.inf
    for b in range(ground.counts[BoxCount.GROUPS]):
        if ground.groups[head, BenchGroup.WAYS + b] < math.inf:
            end = min(end, group_span_end(ground, head, b, s))
    return end if end < math.inf else s


@kernel
def prepare(walk: Walk, room: Workspace, upto: float, whole: IntArray, numbers: FloatArray) -> int:
    """Prepare the walk up to head position `upto`, m, with scratch arrays; returns a `NextStep`."""
    way, tally = room.course.way, room.course.tally
    places = Placements(
        whole[0], numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], whole[1]
    )
    sweeper = BoxScratch(
        numbers[6, 0], places, whole[2, 0], whole[2, 1], numbers[6, 1], numbers[7, 0, :1]
    )
    if not extend_hierarchy(walk.rows, walk.kinds, room.ground, sweeper, room.grids, upto):
        return NextStep.NARROW
    way[Course.UPTO] = upto
    tally[WalkTally.SLOT] = tally[WalkTally.SLOTS] = 0
    if certify_stride(walk, room, sweeper):
        return NextStep.STEP
    way[Course.SOUND] = way[Course.AT]
    return NextStep.STOPPED


@kernel
@allocates
def next_stride(walk: Walk, room: Workspace, least: float) -> int:
    """Prepare the walk past SOUND, `least` metres or more; returns STEP, DONE, STOPPED or NARROW."""
    ground, kinds, way = room.ground, walk.kinds, room.course.way
    if way[Course.SOUND] < way[Course.UPTO]:
        return NextStep.STOPPED
    if way[Course.UPTO] >= way[Course.GOAL]:
        return NextStep.DONE
    known = way[Course.AT] - ground.counts[BoxCount.LOW] * ground.measures[BoxMeasure.CELL]
    upto = way[Course.AT] + max(least, SHARE * known)
    if ground.counts[BoxCount.MIXED] == 0:
        upto = max(upto, clear_end(ground, kinds.group[walk.benches.kind[0]], way[Course.AT]))
    upto = min(upto, way[Course.GOAL])
    return prepare(walk, room, upto, np.empty((3, 2, LANES), dtype=np.int64), np.empty((8, 2, LANES)))


@kernel
def benches_reaching(benches: Benches, head: float, back: float) -> int:
    """How many benches may stand ahead of route position `back` with the head at `head`, m.

    The route from handle to handle is never shorter than the link between them.
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
def next_block(walk: Walk, room: Workspace) -> int:
    """Place chains at the borders of the next steps; STEP, or STOPPED if they cannot be placed."""
    way, tally, counts = room.course.way, room.course.tally, room.ground.counts
    block, benches = room.block, walk.benches
    cells = way[Course.AT] < way[Course.KNOWN]
    end = way[Course.KNOWN] if cells else way[Course.SOUND]
    size, slots, count = room.ground.measures[BoxMeasure.CELL] / of.PARTS, 1, block.at.shape[0]
    block.at[0] = way[Course.AT]
    while slots < count and block.at[slots - 1] < end:
        at = way[Course.AT] + slots * size
        # A remainder due to rounding is joined to the last step.
        block.at[slots] = end if at > end - 1e-3 * size else at
        slots += 1
    back = (
        (counts[BoxCount.REAR] + counts[BoxCount.LOW] * of.PARTS) * size - EDGE if cells else -math.inf
    )
    tally[WalkTally.BENCHES] = benches_reaching(benches, block.at[slots - 1], back)
    tally[WalkTally.SLOT], tally[WalkTally.SLOTS] = 0, slots - 1
    if tally[WalkTally.BENCHES] < 3:
        return NextStep.STEP
    links = benches.links if not cells else benches.links[: tally[WalkTally.BENCHES] - 1]
    return NextStep.STEP if place_samples(walk.rows, links, block, tally, slots) else NextStep.STOPPED


@kernel
def candidates_of_step(
    benches: Benches, kinds: Kinds, ground: Hierarchy, s: FloatArray, t: int, count: int,
    first: IntArray, second: IntArray,
) -> int:  # fmt: skip
    """Find pairs of the first benches that may meet between slots t and t + 1; returns how many.

    s[i, t] are their front handles' route positions, m. Beyond the room, pairs are only counted.
    """  # fmt: skip
    counts, tree, partners = ground.counts, ground.tree, ground.partners
    size = ground.measures[BoxMeasure.CELL] / of.PARTS
    low, most = counts[BoxCount.LOW] * of.PARTS, counts[BoxCount.CELLS] * of.PARTS
    cells, found = ground.middles.shape[0], 0
    for i in range(count - 2):
        since, g = found, kinds.group[benches.kind[i]]
        a = math.floor((s[i, t] - EDGE) / size) - low
        b = math.floor((s[i, t + 1] + EDGE) / size) - low
        for c in range(max(a, 0), min(b, most - 1) + 1):
            child = tree[g * cells + c // of.PARTS, Node.CHILD]
            n = tree[child + c % of.PARTS, Node.PARTNER] if child else 0
            while n:
                row, n = partners[n - 1, Partner.ROW], partners[n - 1, Partner.NEXT]
                back = (tree[row, Node.NUMBER] + low) * size - EDGE
                j = first_behind(s, t, back + size + 2.0 * EDGE, i + 2, count)
                while j < count and s[j, t + 1] >= back:
                    if kinds.group[benches.kind[j]] == tree[row, Node.GROUP]:
                        found = add_pair(first, second, since, found, i, j)
                    j += 1
    return found


@kernel
def candidates_by_grid(benches: Benches, room: Workspace, t: int) -> int:
    """Find pairs of all benches that may come within reach between slots t and t + 1; returns how many.

    No point moves farther than the lever times the longest way of any handle.
    """
    block, crowd, first, second = room.block, room.crowd, room.meeting.first, room.meeting.second
    hulls, count, travel, found = crowd.hulls, benches.kind.shape[0], 0.0, 0
    for i in range(count + 1):
        travel = max(travel, block.s[i, t + 1] - block.s[i, t])
    near, widest = room.ground.measures[BoxMeasure.REACH] + 2.0 * benches.lever[0] * travel, 0.0
    for b in range(crowd.grid.heads.shape[0]):
        crowd.grid.heads[b] = 0
    for i in range(count):
        set_box(benches.sizes, i, block.places.x, block.places.y, t, hulls, i)
        hulls[i, Hull.RADIUS] = half_diagonal(hulls, i)
        widest = max(widest, hulls[i, Hull.RADIUS])
    for j in range(2, count):
        put(crowd.grid, j - 2, hulls[j - 2, Box.CX], hulls[j - 2, Box.CY])
        far = hulls[j, Hull.RADIUS] + widest + near
        for n in range(gather(crowd.grid, hulls[j, Box.CX], hulls[j, Box.CY], far, crowd.found)):
            i = crowd.found[n]
            if boxes_near(hulls, i, j, near):
                if found < first.shape[0]:
                    first[found], second[found] = i, j
                found += 1
    return found


@kernel
def step_pairs(walk: Walk, room: Workspace) -> int:
    """Find the candidate pairs of the next step of the block; returns how many."""
    way, tally, s, meeting = room.course.way, room.course.tally, room.block.s, room.meeting
    t, count = tally[WalkTally.SLOT], tally[WalkTally.BENCHES]
    if count < 3:
        return 0
    if way[Course.AT] >= way[Course.KNOWN]:
        return candidates_by_grid(walk.benches, room, t)
    return candidates_of_step(
        walk.benches, walk.kinds, room.ground, s, t, count, meeting.first, meeting.second
    )


@kernel
def next_step(walk: Walk, room: Workspace, stride: float) -> int:
    """Find the next step in which pairs may come within reach; returns a `NextStep`.

    The walk ahead is prepared in strides of `stride` metres or more.
    """
    way, tally, at = room.course.way, room.course.tally, room.block.at
    for _ in range(STEPS_A_CALL):
        if tally[WalkTally.SLOT] >= tally[WalkTally.SLOTS]:
            ending = NextStep.STEP
            if way[Course.AT] >= way[Course.SOUND]:
                ending = next_stride(walk, room, stride)
            elif way[Course.AT] >= way[Course.KNOWN] or not skip_to_partners(room.ground, way):
                ending = next_block(walk, room)
            if ending != NextStep.STEP:
                return ending
            continue
        t, found = tally[WalkTally.SLOT], step_pairs(walk, room)
        tally[WalkTally.PAIRS] = found
        if found > room.meeting.first.shape[0]:
            return NextStep.NARROW
        way[Course.STEP_START] = at[t]
        way[Course.STEP_END] = at[t + 1]
        way[Course.AT] = at[t + 1]
        tally[WalkTally.SLOT] = t + 1
        if found:
            return NextStep.STEP
    return NextStep.WAIT


@kernel
def partners_ahead(ground: Hierarchy, g: int, s: float) -> float:
    """The start of group g's first part with partners that ends past s, m; infinite without one."""
    tree, cells, low = ground.tree, ground.middles.shape[0], ground.counts[BoxCount.LOW] * of.PARTS
    size, most = ground.measures[BoxMeasure.CELL] / of.PARTS, ground.counts[BoxCount.CELLS] * of.PARTS
    c = max(math.floor(s / size) - low, 0)
    while c < most:
        child = tree[g * cells + c // of.PARTS, Node.CHILD]
        if child and tree[child + c % of.PARTS, Node.PARTNER]:
            return (c + low) * size
        c = c + 1 if child else (c // of.PARTS + 1) * of.PARTS
    return math.inf


@kernel
def skip_to_partners(ground: Hierarchy, way: FloatArray) -> bool:
    """Move AT past the way on which no bench can meet another, up to KNOWN; whether it gets there.

    Only the head's position, AT, is known here: other benches are at most as far on as the links before
    them allow, and the last of them may be anywhere behind.
    """
    begin, groups, edge = math.inf, ground.groups, 2.0 * EDGE
    for g in range(ground.counts[BoxCount.GROUPS]):
        if groups[g, BenchGroup.REARMOST] == 0.0:
            begin = min(begin, partners_ahead(ground, g, way[Course.AT] - edge))
        else:
            begin = min(begin, groups[g, BenchGroup.FIRST] + groups[g, BenchGroup.FOREMOST])
    way[Course.AT] = max(way[Course.AT], min(begin - edge, way[Course.KNOWN]))
    return way[Course.AT] >= way[Course.KNOWN]
