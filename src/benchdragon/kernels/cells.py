"""Where on a route benches can meet at all: cells of the route, and what benches sweep over in them.

All benches of a group sweep over the same place while their front handle walks through a cell, so that
one box holds them all. A cell is boxed where another part of the route comes near it, and cut into
parts, twice, where its box comes near another's. What comes near a part are its partners: only benches
in partners can meet, whatever the time and however long the dragon.
"""

import math
from typing import NamedTuple

import numpy as np

from benchdragon.kernels.arrays import IntTable, IntVector, Table, Vector
from benchdragon.kernels.box import (
    BOX_COLUMNS,
    CX,
    CY,
    HALF_LENGTH,
    HALF_WIDTH,
    box_distance,
    box_gap,
)
from benchdragon.kernels.curve import LENGTH, S_START, FloatArray, place
from benchdragon.kernels.grid import Grid, gather, put
from benchdragon.kernels.jit import kernel
from benchdragon.kernels.regions import EDGE, sweep_cells
from benchdragon.kernels.route import IntArray, locate
from benchdragon.kernels.spiral import LANES
from benchdragon.kernels.step_bounds import Placements, place_chain

# A box that is near another is cut into so many parts.
PARTS = 4
# Where at most so many pairs of parts a cell are near, they are cut once more: it may be none.
SPARSE = 40

# Columns of the table of boxes, after those of kernels/box.py.
RADIUS = BOX_COLUMNS
HULL_COLUMNS = BOX_COLUMNS + 1
# Columns of the tree, a row a box: rows below groups * cells are whole cells, group by group.
STATE = 0  # UNKNOWN, WANTED or BOXED
CHILD = 1  # row of the first of its parts, 0 if it was not cut
PARTNER = 2  # 1 + the number of the latest entry of its partners, 0 without one
GROUP = 3
NUMBER = 4  # counted in boxes of its level from the first cell on
LEVEL = 5  # how many of its kind a cell has
TREE_COLUMNS = 6
UNKNOWN, WANTED, BOXED = 0, 1, 2
# Columns of the list of partners.
ROW = 0  # the partner's
NEXT = 1  # as PARTNER

# What is counted, a row of whole numbers.
GROUPS = 0
CELLS = 1  # known so far
ROWS = 2  # in use
ENTRIES = 3  # partners
LOW = 4  # number of the first cell, counted from the route's start
TODO = 5  # boxes to be made
NEAR = 6  # pairs that are near
DOUBTS = 7  # kinds and cells through which it is not sure that such benches can walk
MIXED = 8  # 1 once cells lie in different clear spans
FIRST = 9  # least number of a part that has partners, in cells times PARTS
REAR = 10  # least number of a partner
LOGGED = 11  # benches at borders of cells, for a proof
COUNTS = 12
# What is measured, a row of floats, m.
REACH = 0  # nearer than this is near
CELL = 1  # length of a cell
END = 2  # of the route
MEASURES = 3
# Columns of the table of groups.
ARM = 0  # how far its benches reach from the middle of a cell that their front handle is in, m
HIND = 1  # route position of its rearmost bench at first, m: none ever comes behind that
WIDEST = 2  # greatest radius of its boxes, m
ALONE = 3  # 1 if its benches can meet no other: they must follow too, and no span spares their cells
WAYS = 4  # and on: at most the way back to a bench of each group, m
# Numbers that the log holds of a bench at a border: link, head position, then row, u, x, y of both.
LOG_COLUMNS = 10


class Kinds(NamedTuple):
    """Sizes of benches, (4, kinds), and the group of each: see kernels/kinds.py."""

    sizes: Table
    group: IntVector


class Ground(NamedTuple):
    """The cells of a route that a dragon walks; the caller's memory."""

    counts: IntVector
    measures: Vector
    groups: Table  # (groups, WAYS + groups)
    spans: (
        Table  # for each pair of groups its clear spans, m, (pairs * rows, 2); empty where end <= start
    )
    span_of: IntTable  # of each cell: for each pair of groups the span that it lies in, -1: none
    middles: Table  # where the route is in the middle of each cell, m, (cells, 2)
    hulls: Table  # (rows, HULL_COLUMNS)
    tree: IntTable  # (rows, TREE_COLUMNS)
    partners: IntTable  # (entries, 2)
    todo: IntVector  # rows to be boxed, (rows,)
    near: IntTable  # pairs of rows, (pairs, 2)
    doubts: IntTable  # kind and cell, (most, 2)
    log: Table  # for a proof: (benches, LOG_COLUMNS)


class Grids(NamedTuple):
    """The middles of cells, and the boxes of whole cells; `found` has room for all of either."""

    middles: Grid
    boxes: Grid
    found: IntVector


@kernel
def has_room(ground: Ground) -> bool:
    """Whether all that was counted found room."""
    counts = ground.counts
    return (
        counts[ROWS] <= ground.tree.shape[0]
        and counts[ENTRIES] <= ground.partners.shape[0]
        and counts[NEAR] <= ground.near.shape[0]
        and counts[DOUBTS] <= ground.doubts.shape[0]
        and (ground.log.shape[0] == 0 or counts[LOGGED] <= ground.log.shape[0])
    )


@kernel
def add_row(tree: IntArray, hulls: FloatArray, row: int, group: int, number: int, level: int) -> None:
    """Begin a row of the tree, not boxed yet."""
    if row < tree.shape[0]:
        tree[row, STATE], tree[row, CHILD], tree[row, PARTNER] = UNKNOWN, 0, 0
        tree[row, GROUP], tree[row, NUMBER], tree[row, LEVEL] = group, number, level
        hulls[row, CX] = hulls[row, CY] = math.nan


@kernel
def want(counts: IntArray, tree: IntArray, todo: IntArray, row: int) -> None:
    """Put a row on the list of boxes to be made, once."""
    if tree[row, STATE] == UNKNOWN:
        tree[row, STATE], todo[counts[TODO]] = WANTED, row
        counts[TODO] += 1


@kernel
def cut(counts: IntArray, tree: IntArray, hulls: FloatArray, todo: IntArray, row: int) -> None:
    """Give a box its parts, once, and want them boxed; beyond the room they are only counted."""
    if tree[row, CHILD]:
        return
    base = counts[ROWS]
    counts[ROWS] = base + PARTS
    if base + PARTS > tree.shape[0]:
        return
    tree[row, CHILD] = base
    for n in range(PARTS):
        number = tree[row, NUMBER] * PARTS + n
        add_row(tree, hulls, base + n, tree[row, GROUP], number, tree[row, LEVEL] * PARTS)
        want(counts, tree, todo, base + n)


@kernel
def find_spans(spans: FloatArray, pairs: int, low: int, cell: float, c: int, span_of: IntArray) -> None:
    """Fill row c of span_of with the clear spans that the cell lies in, borders included."""
    each = spans.shape[0] // pairs
    back, ahead = (low + c) * cell - EDGE, (low + c + 1) * cell + EDGE
    for pair in range(pairs):
        span_of[c, pair] = -1
        for n in range(each):
            if spans[pair * each + n, 0] <= back and ahead <= spans[pair * each + n, 1]:
                span_of[c, pair] = n


@kernel
def add_cell(rows: FloatArray, ground: Ground, hind: float) -> int:
    """Know one cell more, and where the route is in its middle; its number."""
    counts, cell = ground.counts, ground.measures[CELL]
    c, groups = counts[CELLS], counts[GROUPS]
    counts[CELLS] = c + 1
    middle = (c + counts[LOW] + 0.5) * cell
    j, u, _ = locate(rows, min(max(middle, hind), ground.measures[END]))
    ground.middles[c, 0], ground.middles[c, 1], _, _ = place(rows, j, u)
    find_spans(ground.spans, groups * groups, counts[LOW], cell, c, ground.span_of)
    for g in range(groups):
        row = g * ground.middles.shape[0] + c
        add_row(ground.tree, ground.hulls, row, g, c, 1)
    return c


@kernel
def expose(ground: Ground, c: int, pair: int) -> None:
    """Want cell c boxed for both groups of a pair, but behind where the group's last bench began."""
    counts, groups = ground.counts, ground.counts[GROUPS]
    for g in (pair // groups, pair % groups):
        behind = ground.groups[g, HIND] >= (counts[LOW] + c + 1) * ground.measures[CELL]
        if not behind:
            want(counts, ground.tree, ground.todo, g * ground.middles.shape[0] + c)


@kernel
def expose_near(ground: Ground, grid: Grid, found: IntArray, c: int) -> None:
    """Want all cells boxed in which a bench may come near one in another span, one of them in cell c.

    `grid` holds the middles of the cells before.
    """
    groups, span_of, middles = ground.counts[GROUPS], ground.span_of, ground.middles
    x, y, widest = middles[c, 0], middles[c, 1], 0.0
    for g in range(groups):
        if ground.groups[g, ALONE] > 0.0:
            expose(ground, c, g * groups + g)
    mixed = ground.counts[MIXED] > 0
    for pair in range(groups * groups):
        a, b = pair // groups, pair % groups
        if not ground.groups[a, WAYS + b] < math.inf:
            continue
        if span_of[c, pair] < 0:
            expose(ground, c, pair)
        mixed = mixed or (c > 0 and span_of[c, pair] != span_of[0, pair])
        widest = max(widest, ground.groups[a, ARM] + ground.groups[b, ARM] + ground.measures[REACH])
    ground.counts[MIXED] = 1 if mixed else 0
    if not mixed:
        return
    for n in range(gather(grid, x, y, widest, found)):
        d = found[n]
        apart = (middles[d, 0] - x) ** 2 + (middles[d, 1] - y) ** 2
        for pair in range(groups * groups):
            a, b = pair // groups, pair % groups
            reach = ground.groups[a, ARM] + ground.groups[b, ARM] + ground.measures[REACH]
            finite = ground.groups[a, WAYS + b] < math.inf
            if finite and span_of[c, pair] != span_of[d, pair] and apart <= reach * reach:
                expose(ground, c, pair)
                expose(ground, d, pair)


class Sweeper(NamedTuple):
    """What boxing works in: benches at up to LANES borders."""

    at: FloatArray  # route positions of the front handle, m
    places: Placements
    slots: IntArray
    targets: IntArray
    sound: FloatArray
    link: FloatArray  # (1,)


@kernel
def log_borders(ground: Ground, sweeper: Sweeper, count: int) -> None:
    """Log the benches at the first borders, where they stand; beyond the room they are only counted."""
    places, log = sweeper.places, ground.log
    for t in range(count):
        if places.failed[0, t]:
            continue
        n = ground.counts[LOGGED]
        ground.counts[LOGGED] = n + 1
        if n < log.shape[0]:
            log[n, 0], log[n, 1] = sweeper.link[0], sweeper.at[t]
            for i in range(2):
                log[n, 2 + 4 * i], log[n, 3 + 4 * i] = places.row[i, t], places.u[i, t]
                log[n, 4 + 4 * i], log[n, 5 + 4 * i] = places.x[i, t], places.y[i, t]


@kernel
def sweep_batch(
    rows: FloatArray, kinds: Kinds, ground: Ground, sweeper: Sweeper, k: int, slots: int, boxes: int
) -> None:
    """Widen boxes by benches of kind k, whose front handles are at the sweeper's borders."""
    at, places, link, sound = sweeper.at, sweeper.places, sweeper.link, sweeper.sound
    link[0] = kinds.sizes[0, k] - kinds.sizes[2, k] - kinds.sizes[3, k]
    place_chain(rows, link, at, 0, slots, places)
    log_borders(ground, sweeper, slots)
    some, targets = sweeper.slots[:boxes], sweeper.targets[:boxes]
    sweep_cells(rows, link, kinds.sizes, k, places, some, targets, ground.hulls, sound)
    for n in range(boxes):
        row = targets[n]
        if sound[n] == 0.0 and ground.tree[row, LEVEL] == 1:
            doubt = ground.counts[DOUBTS]
            ground.counts[DOUBTS] = doubt + 1
            if doubt < ground.doubts.shape[0]:
                ground.doubts[doubt, 0] = k
                ground.doubts[doubt, 1] = ground.tree[row, NUMBER]


@kernel
def box_group(rows: FloatArray, kinds: Kinds, ground: Ground, sweeper: Sweeper, k: int) -> None:
    """Widen what is wanted of the group of kind k by benches of that kind, some borders at a time."""
    tree, at, low = ground.tree, sweeper.at, ground.counts[LOW]
    hind, end = ground.groups[kinds.group[k], HIND], ground.measures[END]
    slots, boxes, last = 0, 0, -2
    for n in range(ground.counts[TODO]):
        row = ground.todo[n]
        if tree[row, GROUP] != kinds.group[k]:
            continue
        if slots + 2 > LANES:
            sweep_batch(rows, kinds, ground, sweeper, k, slots, boxes)
            slots, boxes, last = 0, 0, -2
        level = tree[row, LEVEL]
        number, size = tree[row, NUMBER] + low * level, ground.measures[CELL] / level
        joined = (
            last >= 0 and tree[last, LEVEL] == level and tree[last, NUMBER] + 1 == tree[row, NUMBER]
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
def make_boxes(rows: FloatArray, kinds: Kinds, ground: Ground, sweeper: Sweeper, grid: Grid) -> None:
    """Box all that is wanted; whole cells go into the grid of boxes by the centre of theirs."""
    for k in range(kinds.group.shape[0]):
        box_group(rows, kinds, ground, sweeper, k)
    hulls, tree = ground.hulls, ground.tree
    for n in range(ground.counts[TODO]):
        row = ground.todo[n]
        tree[row, STATE] = BOXED
        hulls[row, RADIUS] = math.hypot(hulls[row, HALF_LENGTH], hulls[row, HALF_WIDTH])
        if tree[row, LEVEL] == 1 and not math.isnan(hulls[row, CX]):
            g = tree[row, GROUP]
            ground.groups[g, WIDEST] = max(ground.groups[g, WIDEST], hulls[row, RADIUS])
            put(grid, row, hulls[row, CX], hulls[row, CY])
    ground.counts[TODO] = 0


@kernel
def boxes_near(hulls: FloatArray, i: int, j: int, reach: float) -> bool:
    """Whether two boxes are within reach, m; no box is near anything."""
    dx, dy = hulls[i, CX] - hulls[j, CX], hulls[i, CY] - hulls[j, CY]
    most = hulls[i, RADIUS] + hulls[j, RADIUS] + reach
    if not dx * dx + dy * dy <= most * most:
        return False
    return box_gap(hulls, i, j) <= reach and box_distance(hulls, i, j) <= reach


@kernel
def far_enough(tree: IntArray, i: int, j: int, cell: float, way: float) -> bool:
    """Whether a bench in box i may have one in box j behind it with another between them."""
    return (tree[i, NUMBER] + 1 - tree[j, NUMBER]) * cell / tree[i, LEVEL] >= way


@kernel
def add_near(counts: IntArray, near: IntArray, i: int, j: int) -> None:
    """Note a pair of rows that are near; beyond the room it is only counted."""
    n = counts[NEAR]
    if n < near.shape[0]:
        near[n, 0], near[n, 1] = i, j
    counts[NEAR] = n + 1


@kernel
def find_near(ground: Ground, grid: Grid, found: IntArray, i: int) -> None:
    """Note all boxes of cells not beyond that of row i that are near it."""
    tree, hulls, groups = ground.tree, ground.hulls, ground.counts[GROUPS]
    a, c, reach, widest = tree[i, GROUP], tree[i, NUMBER], ground.measures[REACH], 0.0
    if math.isnan(hulls[i, CX]):
        return
    for b in range(groups):
        if ground.groups[a, WAYS + b] < math.inf:
            widest = max(widest, ground.groups[b, WIDEST])
    far = hulls[i, RADIUS] + widest + reach
    for n in range(gather(grid, hulls[i, CX], hulls[i, CY], far, found)):
        j = found[n]
        b, d = tree[j, GROUP], tree[j, NUMBER]
        way = ground.groups[a, WAYS + b]
        if d > c or not way < math.inf or not far_enough(tree, i, j, ground.measures[CELL], way):
            continue
        span = ground.span_of[c, a * groups + b]
        if (span < 0 or span != ground.span_of[d, a * groups + b]) and boxes_near(hulls, i, j, reach):
            add_near(ground.counts, ground.near, i, j)


@kernel
def cut_near(ground: Ground) -> None:
    """Cut all boxes that are in pairs."""
    for n in range(ground.counts[NEAR]):
        for side in range(2):
            cut(ground.counts, ground.tree, ground.hulls, ground.todo, ground.near[n, side])


@kernel
def near_parts(ground: Ground, i: int, j: int, every: bool) -> bool:
    """Whether any parts of boxes i and j are near; if `every`, all such pairs are noted."""
    tree, reach = ground.tree, ground.measures[REACH]
    way, found = ground.groups[tree[i, GROUP], WAYS + tree[j, GROUP]], False
    for p in range(tree[i, CHILD], tree[i, CHILD] + PARTS):
        for q in range(tree[j, CHILD], tree[j, CHILD] + PARTS):
            if far_enough(tree, p, q, ground.measures[CELL], way) and boxes_near(
                ground.hulls, p, q, reach
            ):
                if not every:
                    return True
                found = True
                add_near(ground.counts, ground.near, p, q)
    return found


@kernel
def add_partners(ground: Ground, i: int, j: int) -> None:
    """Make part j a partner of part i."""
    counts, tree = ground.counts, ground.tree
    n = counts[ENTRIES]
    counts[ENTRIES] = n + 1
    counts[FIRST] = min(counts[FIRST], tree[i, NUMBER])
    counts[REAR] = min(counts[REAR], tree[j, NUMBER])
    if n < ground.partners.shape[0]:
        ground.partners[n, ROW], ground.partners[n, NEXT] = j, tree[i, PARTNER]
        tree[i, PARTNER] = n + 1


@kernel
def sweeper_for() -> Sweeper:
    """Room to box in."""
    whole = np.empty((2, 2, LANES), dtype=np.int64)
    floats = np.empty((6, 2, LANES))
    places = Placements(
        whole[0], floats[0], floats[1], floats[2], floats[3], floats[4], floats[5], whole[1]
    )
    lists = np.empty((2, LANES), dtype=np.int64)
    return Sweeper(np.empty(LANES), places, lists[0], lists[1], np.empty(LANES), np.empty(1))


@kernel
def extend(
    rows: FloatArray, kinds: Kinds, ground: Ground, sweeper: Sweeper, grids: Grids, upto: float
) -> bool:
    """Know the route up to position `upto`, m, and all partners there; False for want of room."""
    counts, old = ground.counts, ground.counts[CELLS]
    wanted = math.floor(upto / ground.measures[CELL]) + 1 - counts[LOW]
    hind = math.inf
    for g in range(counts[GROUPS]):
        hind = min(hind, ground.groups[g, HIND])
    if wanted <= old:
        return True
    for _ in range(old, wanted):
        if counts[CELLS] == ground.middles.shape[0]:
            return False
        c = add_cell(rows, ground, hind)
        expose_near(ground, grids.middles, grids.found, c)
        put(grids.middles, c, ground.middles[c, 0], ground.middles[c, 1])
    make_boxes(rows, kinds, ground, sweeper, grids.boxes)
    counts[NEAR] = 0
    for g in range(counts[GROUPS]):
        for c in range(old, wanted):
            find_near(ground, grids.boxes, grids.found, g * ground.middles.shape[0] + c)
    return has_room(ground) and refine(rows, kinds, ground, sweeper, grids.boxes, wanted - old)


@kernel
def refine(
    rows: FloatArray, kinds: Kinds, ground: Ground, sweeper: Sweeper, centres: Grid, fresh: int
) -> bool:
    """From pairs of cells that are near to partners; False for want of room. So many cells are new."""
    counts, near = ground.counts, ground.near
    cells = counts[NEAR]
    cut_near(ground)
    if not has_room(ground):
        return False
    make_boxes(rows, kinds, ground, sweeper, centres)
    for n in range(cells):
        near_parts(ground, near[n, 0], near[n, 1], True)
    if not has_room(ground):
        return False
    pairs = counts[NEAR] - cells
    for n in range(pairs):
        near[n, 0], near[n, 1] = near[cells + n, 0], near[cells + n, 1]
    counts[NEAR] = pairs
    finer = 0 < pairs <= SPARSE * fresh
    if finer:
        cut_near(ground)
        if not has_room(ground):
            return False
        make_boxes(rows, kinds, ground, sweeper, centres)
    for n in range(pairs):
        if not finer or near_parts(ground, near[n, 0], near[n, 1], False):
            add_partners(ground, near[n, 0], near[n, 1])
    counts[NEAR] = 0
    return has_room(ground)


@kernel
def route_end(rows: FloatArray) -> float:
    """The route's length, m."""
    last = rows.shape[0] - 1
    return rows[last, S_START] + rows[last, LENGTH]
