"""The start of a search along a walk: where the dragon stands, and what it asks of cells."""

import math

from benchdragon.kernels import box_hierarchy
from benchdragon.kernels.box_hierarchy import Hierarchy, Kinds
from benchdragon.kernels.curve import LENGTH, S_START, FloatArray
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.kinds import least_ways
from benchdragon.kernels.links import link_of
from benchdragon.kernels.rounding import find_seams
from benchdragon.kernels.spiral_bound import clear_spans, shape_of
from benchdragon.kernels.swept_boxes import EDGE
from benchdragon.kernels.workspace import (
    AT,
    GOAL,
    KNOWN,
    SOUND,
    STEP_END,
    STEP_START,
    TALLY,
    UPTO,
    Benches,
    SearchProgress,
    Walk,
    Workspace,
    place_samples,
)

# Cells are this share of the shortest link: shorter ones cost more boxes, longer ones looser boxes.
CELL_SHARE = 0.45
# No number of a part.
NOWHERE = 1 << 60


@kernel
def begin_group(benches: Benches, kinds: Kinds, ground: Hierarchy, s: FloatArray, g: int) -> None:
    """Fill the row of group g, of the benches whose handles stand at s[:, 0]; least_ways is there."""
    groups, counts = ground.groups, ground.counts
    arm, hind, alone = 0.0, math.inf, 1.0
    foremost, rearmost = math.inf, 0.0
    for k in range(kinds.group.shape[0]):
        if kinds.group[k] == g:
            length, width, front = kinds.sizes[0, k], kinds.sizes[1, k], kinds.sizes[2, k]
            arm = max(arm, math.hypot(max(front, length - front), 0.5 * width))
    for i in range(benches.kind.shape[0]):
        if kinds.group[benches.kind[i]] == g:
            hind = min(hind, s[i, 0])
            foremost, rearmost = min(foremost, benches.ahead[i]), benches.ahead[i]
    for b in range(counts[box_hierarchy.GROUPS]):
        if groups[g, box_hierarchy.WAYS + b] < math.inf or groups[b, box_hierarchy.WAYS + g] < math.inf:
            alone = 0.0
    groups[g, box_hierarchy.ARM], groups[g, box_hierarchy.HIND] = (
        arm + ground.measures[box_hierarchy.CELL],
        hind,
    )
    groups[g, box_hierarchy.WIDEST], groups[g, box_hierarchy.ALONE], groups[g, box_hierarchy.FIRST] = (
        0.0,
        alone,
        math.inf,
    )
    groups[g, box_hierarchy.FOREMOST], groups[g, box_hierarchy.REARMOST] = foremost, rearmost


@kernel
def find_clear_spans(rows: FloatArray, kinds: Kinds, ground: Hierarchy, shortest: float) -> None:
    """Fill the spans of the route where benches of two groups keep apart, a shortest link between."""
    groups, spans = ground.counts[box_hierarchy.GROUPS], ground.spans
    each = spans.shape[0] // (groups * groups)  # as many as rows, or more
    for n in range(spans.shape[0]):
        spans[n, 0], spans[n, 1] = math.inf, -math.inf
    for pair in range(groups * groups):
        if ground.groups[pair // groups, box_hierarchy.WAYS + pair % groups] < math.inf:
            room = 0.5 * ground.measures[box_hierarchy.REACH]
            ahead = shape_of(kinds.sizes, kinds.group, pair // groups, room)
            behind = shape_of(kinds.sizes, kinds.group, pair % groups, room)
            clear_spans(rows, ahead, behind, shortest, spans[pair * each : (pair + 1) * each])


@kernel
def begin_course(
    rows: FloatArray, ground: Hierarchy, course: SearchProgress, start: float, end: float
) -> None:
    """Let a walk be at its start, nothing known ahead; it goes no farther than the route."""
    way, last = course.way, rows.shape[0] - 1
    ground.measures[box_hierarchy.END] = rows[last, S_START] + rows[last, LENGTH]
    way[AT] = way[UPTO] = way[KNOWN] = way[SOUND] = way[STEP_START] = way[STEP_END] = start
    way[GOAL] = min(end, ground.measures[box_hierarchy.END])
    for n in range(TALLY):
        course.tally[n] = 0


@entry
def begin_walk(walk: Walk, room: Workspace, start: float, end: float, reach: float) -> bool:
    """Begin a search from head position start to end, m; False if the dragon cannot stand at start.

    Pairs of benches within `reach`, m, will be named.
    """
    rows, benches, kinds = walk.rows, walk.benches, walk.kinds
    ground, block, course = room.ground, room.block, room.course
    counts, groups, shortest = ground.counts, ground.groups.shape[0], math.inf
    for k in range(kinds.group.shape[0]):
        shortest = min(shortest, link_of(kinds.sizes, k))
    cell = CELL_SHARE * shortest
    ground.measures[box_hierarchy.REACH], ground.measures[box_hierarchy.CELL] = reach + EDGE, cell
    begin_course(rows, ground, course, start, end)
    find_seams(rows, ground.seams)
    block.at[0] = start
    if not place_samples(rows, benches.links, block, course.tally, 1):
        return False
    for n in range(box_hierarchy.COUNTS):
        counts[n] = 0
    counts[box_hierarchy.GROUPS], counts[box_hierarchy.ROWS] = groups, groups * ground.middles.shape[0]
    counts[box_hierarchy.LOW] = math.floor(block.s[benches.kind.shape[0] - 1, 0] / cell)
    counts[box_hierarchy.REAR] = NOWHERE
    least_ways(benches.links, benches.kind, kinds.group, groups, ground.groups, box_hierarchy.WAYS)
    for g in range(groups):
        begin_group(benches, kinds, ground, block.s, g)
    find_clear_spans(rows, kinds, ground, shortest)
    return True
