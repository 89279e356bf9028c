"""The start of a search along a walk: where the dragon stands, and what it asks of cells."""

import math

from benchdragon.kernels import box_hierarchy
from benchdragon.kernels.box_hierarchy import BenchGroup, BoxCount, BoxMeasure, Hierarchy, Kinds
from benchdragon.kernels.curve import FloatArray, RouteRow
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.kinds import least_ways
from benchdragon.kernels.links import link_of
from benchdragon.kernels.rounding import find_seams
from benchdragon.kernels.spiral_bound import clear_spans, shape_of
from benchdragon.kernels.swept_boxes import EDGE
from benchdragon.kernels.workspace import (
    TALLY,
    Benches,
    Course,
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
    for b in range(counts[BoxCount.GROUPS]):
        if groups[g, BenchGroup.WAYS + b] < math.inf or groups[b, BenchGroup.WAYS + g] < math.inf:
            alone = 0.0
    groups[g, BenchGroup.ARM] = arm + ground.measures[BoxMeasure.CELL]
    groups[g, BenchGroup.HIND] = hind
    groups[g, BenchGroup.WIDEST] = 0.0
    groups[g, BenchGroup.ALONE] = alone
    groups[g, BenchGroup.FIRST] = math.inf
    groups[g, BenchGroup.FOREMOST], groups[g, BenchGroup.REARMOST] = foremost, rearmost


@kernel
def find_clear_spans(rows: FloatArray, kinds: Kinds, ground: Hierarchy, shortest: float) -> None:
    """Fill the spans of the route where benches of two groups keep apart, a shortest link between."""
    groups, spans = ground.counts[BoxCount.GROUPS], ground.spans
    each = spans.shape[0] // (groups * groups)  # as many as rows, or more
    for n in range(spans.shape[0]):
        spans[n, 0], spans[n, 1] = math.inf, -math.inf
    for pair in range(groups * groups):
        if ground.groups[pair // groups, BenchGroup.WAYS + pair % groups] < math.inf:
            room = 0.5 * ground.measures[BoxMeasure.REACH]
            ahead = shape_of(kinds.sizes, kinds.group, pair // groups, room)
            behind = shape_of(kinds.sizes, kinds.group, pair % groups, room)
            clear_spans(rows, ahead, behind, shortest, spans[pair * each : (pair + 1) * each])


@kernel
def begin_course(
    rows: FloatArray, ground: Hierarchy, course: SearchProgress, start: float, end: float
) -> None:
    """Put a walk at its start, with nothing known ahead; it ends no later than the route."""
    way, last = course.way, rows.shape[0] - 1
    ground.measures[BoxMeasure.END] = rows[last, RouteRow.S_START] + rows[last, RouteRow.LENGTH]
    way[Course.AT] = way[Course.UPTO] = way[Course.KNOWN] = way[Course.SOUND] = way[
        Course.STEP_START
    ] = way[Course.STEP_END] = start
    way[Course.GOAL] = min(end, ground.measures[BoxMeasure.END])
    for n in range(TALLY):
        course.tally[n] = 0


@entry
def begin_walk(walk: Walk, room: Workspace, start: float, end: float, reach: float) -> bool:
    """Begin a search from head position start to end, m; False if the dragon cannot stand at start.

    It finds pairs of benches within `reach`, m.
    """
    rows, benches, kinds = walk.rows, walk.benches, walk.kinds
    ground, block, course = room.ground, room.block, room.course
    counts, groups, shortest = ground.counts, ground.groups.shape[0], math.inf
    for k in range(kinds.group.shape[0]):
        shortest = min(shortest, link_of(kinds.sizes, k))
    cell = CELL_SHARE * shortest
    ground.measures[BoxMeasure.REACH], ground.measures[BoxMeasure.CELL] = reach + EDGE, cell
    begin_course(rows, ground, course, start, end)
    find_seams(rows, ground.seams)
    block.at[0] = start
    if not place_samples(rows, benches.links, block, course.tally, 1):
        return False
    for n in range(box_hierarchy.BOX_COUNTS):
        counts[n] = 0
    counts[BoxCount.GROUPS], counts[BoxCount.ROWS] = groups, groups * ground.middles.shape[0]
    counts[BoxCount.LOW] = math.floor(block.s[benches.kind.shape[0] - 1, 0] / cell)
    counts[BoxCount.REAR] = NOWHERE
    least_ways(benches.links, benches.kind, kinds.group, groups, ground.groups, BenchGroup.WAYS)
    for g in range(groups):
        begin_group(benches, kinds, ground, block.s, g)
    find_clear_spans(rows, kinds, ground, shortest)
    return True
