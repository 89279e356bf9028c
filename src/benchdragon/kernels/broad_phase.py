"""Broad phase: a hierarchy of swept oriented boxes over cells of the route, and which leaves overlap.

All benches of a group sweep over the same place while their front handle walks through a cell, so that
one box holds them all. A cell is boxed where another part of the route comes near it, and split into
parts, twice, where its box comes near another's. The leaves that a leaf comes near are its partners:
only benches in partners are candidate pairs, whatever the time and however long the dragon.
"""

import math
from typing import NamedTuple

from benchdragon.kernels import box_hierarchy as of
from benchdragon.kernels.arrays import IntVector, Vector
from benchdragon.kernels.box import Box, box_distance, box_gap, half_diagonal
from benchdragon.kernels.box_hierarchy import (
    BenchGroup,
    BoxCount,
    BoxMeasure,
    Grids,
    Hierarchy,
    Hull,
    Kinds,
    Node,
    NodeState,
    Partner,
    has_room,
    split,
)
from benchdragon.kernels.cells_to_box import add_cell, mark_behind, mark_new, may_meet
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.grid import Grid, gather, put
from benchdragon.kernels.links import link_of
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.spiral import LANES
from benchdragon.kernels.swept_boxes import sweep_cells

# If at most so many pairs of parts a cell are near, the parts are split once more: perhaps none is.
SPARSE = 40


class BoxScratch(NamedTuple):
    """Scratch for boxing: benches at up to LANES borders of cells."""

    at: Vector  # route positions of the front handle, m
    places: Placements
    slots: IntVector
    targets: IntVector
    sound: Vector
    link: Vector  # (1,)


@kernel
def count_borders(ground: Hierarchy, places: Placements, count: int) -> None:
    """Count the benches that can be placed at the first `count` borders."""
    for t in range(count):
        if not places.failed[0, t]:
            ground.counts[BoxCount.BORDERS] += 1


@kernel
def sweep_batch(
    rows: FloatArray,
    kinds: Kinds,
    ground: Hierarchy,
    sweeper: BoxScratch,
    k: int,
    slots: int,
    boxes: int,
) -> None:
    """Widen boxes by benches of kind k, whose front handles are at the sweeper's borders."""
    at, places, link, sound = sweeper.at, sweeper.places, sweeper.link, sweeper.sound
    link[0] = link_of(kinds.sizes, k)
    place_chain(rows, link, at, 0, slots, places)
    count_borders(ground, places, slots)
    some, targets = sweeper.slots[:boxes], sweeper.targets[:boxes]
    sweep_cells(rows, link, kinds.sizes, k, places, some, targets, ground.hulls, sound)
    for n in range(boxes):
        row = targets[n]
        if sound[n] == 0.0 and ground.tree[row, Node.LEVEL] == 1:
            doubt = ground.counts[BoxCount.DOUBTS]
            ground.counts[BoxCount.DOUBTS] = doubt + 1
            if doubt < ground.doubts.shape[0]:
                ground.doubts[doubt, 0] = k
                ground.doubts[doubt, 1] = ground.tree[row, Node.NUMBER]


@kernel
def box_group(rows: FloatArray, kinds: Kinds, ground: Hierarchy, sweeper: BoxScratch, k: int) -> None:
    """Widen the marked boxes of kind k's group by benches of that kind, batch by batch."""
    tree, at, low = ground.tree, sweeper.at, ground.counts[BoxCount.LOW]
    hind, end = ground.groups[kinds.group[k], BenchGroup.HIND], ground.measures[BoxMeasure.END]
    slots, boxes, last = 0, 0, -2
    for n in range(ground.counts[BoxCount.TODO]):
        row = ground.todo[n]
        if tree[row, Node.GROUP] != kinds.group[k]:
            continue
        if slots + 2 > LANES:
            sweep_batch(rows, kinds, ground, sweeper, k, slots, boxes)
            slots, boxes, last = 0, 0, -2
        level = tree[row, Node.LEVEL]
        number, size = tree[row, Node.NUMBER] + low * level, ground.measures[BoxMeasure.CELL] / level
        joined = (
            last >= 0
            and tree[last, Node.LEVEL] == level
            and tree[last, Node.NUMBER] + 1 == tree[row, Node.NUMBER]
        )
        if not joined:
            at[slots] = min(max(number * size, hind), end)
            slots += 1
        at[slots] = min(max((number + 1) * size, hind), end)
        sweeper.slots[boxes], sweeper.targets[boxes] = slots - 1, row
        slots, boxes, last = slots + 1, boxes + 1, row
    if boxes:
        sweep_batch(rows, kinds, ground, sweeper, k, slots, boxes)


@kernel
def box_marked(
    rows: FloatArray, kinds: Kinds, ground: Hierarchy, sweeper: BoxScratch, grid: Grid
) -> None:
    """Box all marked rows; boxes of whole cells are put into the grid by their centres."""
    for k in range(kinds.group.shape[0]):
        box_group(rows, kinds, ground, sweeper, k)
    hulls, tree = ground.hulls, ground.tree
    for n in range(ground.counts[BoxCount.TODO]):
        row = ground.todo[n]
        tree[row, Node.STATE] = NodeState.BOXED
        hulls[row, Hull.RADIUS] = half_diagonal(hulls, row)
        if tree[row, Node.LEVEL] == 1 and not math.isnan(hulls[row, Box.CX]):
            g = tree[row, Node.GROUP]
            ground.groups[g, BenchGroup.WIDEST] = max(
                ground.groups[g, BenchGroup.WIDEST], hulls[row, Hull.RADIUS]
            )
            put(grid, row, hulls[row, Box.CX], hulls[row, Box.CY])
    ground.counts[BoxCount.TODO] = 0


@kernel
def boxes_near(hulls: FloatArray, i: int, j: int, reach: float) -> bool:
    """Whether two boxes are within reach, m; an empty box is near nothing."""
    dx, dy = hulls[i, Box.CX] - hulls[j, Box.CX], hulls[i, Box.CY] - hulls[j, Box.CY]
    most = hulls[i, Hull.RADIUS] + hulls[j, Hull.RADIUS] + reach
    if not dx * dx + dy * dy <= most * most:
        return False
    return box_gap(hulls, i, j) <= reach and box_distance(hulls, i, j) <= reach


@kernel
def far_enough(tree: IntArray, i: int, j: int, cell: float, way: float) -> bool:
    """Whether a bench in box i may have one in box j behind it with another between them."""
    return (tree[i, Node.NUMBER] + 1 - tree[j, Node.NUMBER]) * cell / tree[i, Node.LEVEL] >= way


@kernel
def add_overlap(counts: IntArray, near: IntArray, i: int, j: int) -> None:
    """Record a pair of rows that are near; without room it is only counted."""
    n = counts[BoxCount.NEAR]
    if n < near.shape[0]:
        near[n, 0], near[n, 1] = i, j
    counts[BoxCount.NEAR] = n + 1


@kernel
def find_overlaps(ground: Hierarchy, grid: Grid, found: IntArray, i: int) -> None:
    """Record all boxes near that of row i whose cells are not ahead of its own."""
    tree, hulls, groups = ground.tree, ground.hulls, ground.counts[BoxCount.GROUPS]
    a = tree[i, Node.GROUP]
    c = tree[i, Node.NUMBER]
    reach = ground.measures[BoxMeasure.REACH]
    widest = 0.0
    if math.isnan(hulls[i, Box.CX]):
        return
    for b in range(groups):
        if ground.groups[a, BenchGroup.WAYS + b] < math.inf:
            widest = max(widest, ground.groups[b, BenchGroup.WIDEST])
    far = hulls[i, Hull.RADIUS] + widest + reach
    for n in range(gather(grid, hulls[i, Box.CX], hulls[i, Box.CY], far, found)):
        j = found[n]
        b, d = tree[j, Node.GROUP], tree[j, Node.NUMBER]
        way = ground.groups[a, BenchGroup.WAYS + b]
        if (
            d > c
            or not way < math.inf
            or not far_enough(tree, i, j, ground.measures[BoxMeasure.CELL], way)
        ):
            continue
        if may_meet(ground.span_of, c, d, a * groups + b) and boxes_near(hulls, i, j, reach):
            add_overlap(ground.counts, ground.near, i, j)


@kernel
def split_overlapping(ground: Hierarchy) -> None:
    """Split all boxes that are in pairs."""
    for n in range(ground.counts[BoxCount.NEAR]):
        for side in range(2):
            split(ground.counts, ground.tree, ground.hulls, ground.todo, ground.near[n, side])


@kernel
def overlapping_parts(ground: Hierarchy, i: int, j: int, every: bool) -> bool:
    """Whether any parts of boxes i and j are near; with `every`, all such pairs are recorded."""
    tree, reach = ground.tree, ground.measures[BoxMeasure.REACH]
    way, found = ground.groups[tree[i, Node.GROUP], BenchGroup.WAYS + tree[j, Node.GROUP]], False
    for p in range(tree[i, Node.CHILD], tree[i, Node.CHILD] + of.PARTS):
        for q in range(tree[j, Node.CHILD], tree[j, Node.CHILD] + of.PARTS):
            if far_enough(tree, p, q, ground.measures[BoxMeasure.CELL], way) and boxes_near(
                ground.hulls, p, q, reach
            ):
                if not every:
                    return True
                found = True
                add_overlap(ground.counts, ground.near, p, q)
    return found


@kernel
def add_candidates(ground: Hierarchy, i: int, j: int) -> None:
    """Make part j a partner of part i."""
    counts, tree, groups = ground.counts, ground.tree, ground.groups
    n = counts[BoxCount.ENTRIES]
    g = tree[i, Node.GROUP]
    size = ground.measures[BoxMeasure.CELL] / of.PARTS
    counts[BoxCount.ENTRIES] = n + 1
    begin = (tree[i, Node.NUMBER] + counts[BoxCount.LOW] * of.PARTS) * size
    groups[g, BenchGroup.FIRST] = min(groups[g, BenchGroup.FIRST], begin)
    counts[BoxCount.REAR] = min(counts[BoxCount.REAR], tree[j, Node.NUMBER])
    if n < ground.partners.shape[0]:
        ground.partners[n, Partner.ROW], ground.partners[n, Partner.NEXT] = j, tree[i, Node.PARTNER]
        tree[i, Node.PARTNER] = n + 1


@kernel
def extend_hierarchy(
    rows: FloatArray, kinds: Kinds, ground: Hierarchy, sweeper: BoxScratch, grids: Grids, upto: float
) -> bool:
    """Extend the hierarchy, with all partners, to route position `upto`, m; False if room runs out."""
    counts, old = ground.counts, ground.counts[BoxCount.CELLS]
    wanted = math.floor(upto / ground.measures[BoxMeasure.CELL]) + 1 - counts[BoxCount.LOW]
    hind = math.inf
    for g in range(counts[BoxCount.GROUPS]):
        hind = min(hind, ground.groups[g, BenchGroup.HIND])
    if wanted <= old:
        return True
    for _ in range(old, wanted):
        if counts[BoxCount.CELLS] == ground.middles.shape[0]:
            return False
        c = add_cell(rows, ground, hind)
        mark_new(ground, grids.middles, grids.found, c)
        put(grids.middles, c, ground.middles[c, 0], ground.middles[c, 1])
    box_marked(rows, kinds, ground, sweeper, grids.boxes)
    for g in range(counts[BoxCount.GROUPS]):
        for c in range(old, wanted):
            if ground.tree[g * ground.middles.shape[0] + c, Node.STATE] == NodeState.BOXED:
                mark_behind(ground, grids.middles, grids.found, g * ground.middles.shape[0] + c)
    box_marked(rows, kinds, ground, sweeper, grids.boxes)
    counts[BoxCount.NEAR] = 0
    for g in range(counts[BoxCount.GROUPS]):
        for c in range(old, wanted):
            find_overlaps(ground, grids.boxes, grids.found, g * ground.middles.shape[0] + c)
    return has_room(ground) and refine_hierarchy(
        rows, kinds, ground, sweeper, grids.boxes, wanted - old
    )


@kernel
def refine_hierarchy(
    rows: FloatArray, kinds: Kinds, ground: Hierarchy, sweeper: BoxScratch, centres: Grid, fresh: int
) -> bool:
    """Refine near pairs of cells to partners; False if room runs out. `fresh` cells are new."""
    counts, near = ground.counts, ground.near
    cells = counts[BoxCount.NEAR]
    split_overlapping(ground)
    if not has_room(ground):
        return False
    box_marked(rows, kinds, ground, sweeper, centres)
    for n in range(cells):
        overlapping_parts(ground, near[n, 0], near[n, 1], True)
    if not has_room(ground):
        return False
    pairs = counts[BoxCount.NEAR] - cells
    for n in range(pairs):
        near[n, 0], near[n, 1] = near[cells + n, 0], near[cells + n, 1]
    counts[BoxCount.NEAR] = pairs
    finer = 0 < pairs <= SPARSE * fresh
    if finer:
        split_overlapping(ground)
        if not has_room(ground):
            return False
        box_marked(rows, kinds, ground, sweeper, centres)
    for n in range(pairs):
        if not finer or overlapping_parts(ground, near[n, 0], near[n, 1], False):
            add_candidates(ground, near[n, 0], near[n, 1])
    counts[BoxCount.NEAR] = 0
    return has_room(ground)
