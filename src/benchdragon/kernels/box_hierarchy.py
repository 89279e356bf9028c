"""The hierarchy of bounding boxes over the cells of a route, as tables.

A box holds what benches sweep over while their front handle walks through a cell, or a part of one.
Boxes make a tree: of whole cells, of the parts that these are split into, and of parts of parts.
"""

import math
from typing import NamedTuple

from benchdragon.kernels.arrays import IntTable, IntVector, Table, Vector
from benchdragon.kernels.box import BOX_COLUMNS, Box
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.grid import Grid
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import IntArray

# A box that is near another is split into so many parts.
PARTS = 4


class Hull(Box):
    """Columns of the table of boxes, after those of kernels/box.py."""

    RADIUS = BOX_COLUMNS


HULL_COLUMNS = len(Hull)


class Node(Numbered):
    """Columns of the tree, a row a box.

    Rows below groups * cells are whole cells, group by group.
    """

    STATE = 0  # a NodeState
    CHILD = 1  # row of the first of its parts, 0 if it was not cut
    PARTNER = 2  # 1 + the number of the latest entry of its partners, 0 without one
    GROUP = 3
    NUMBER = 4  # counted in boxes of its level from the first cell on
    LEVEL = 5  # how many of its kind a cell has


TREE_COLUMNS = len(Node)


class NodeState(Numbered):
    """The state of a box of the tree."""

    UNKNOWN, WANTED, BOXED = range(3)


class Partner(Numbered):
    """Columns of the list of partners."""

    ROW = 0  # the partner's
    NEXT = 1  # as PARTNER


class BoxCount(Numbered):
    """Counts, a row of whole numbers."""

    GROUPS = 0
    CELLS = 1  # known so far
    ROWS = 2  # in use
    ENTRIES = 3  # partners
    LOW = 4  # number of the first cell, counted from the route's start
    TODO = 5  # boxes to be made
    NEAR = 6  # pairs that are near
    DOUBTS = 7  # kinds and cells through which such benches are not certain to walk
    MIXED = 8  # 1 once cells lie in different clear spans
    REAR = 9  # least number of a partner, in cells times PARTS
    BORDERS = 10  # benches placed at borders of cells


BOX_COUNTS = len(BoxCount)


class BoxMeasure(Numbered):
    """Measures, a row of floats, m."""

    REACH = 0  # nearer than this is near
    CELL = 1  # length of a cell
    END = 2  # of the route


MEASURES = len(BoxMeasure)


class BenchGroup(Numbered):
    """Columns of the table of groups."""

    ARM = 0  # how far its benches reach from the middle of a cell that their front handle is in, m
    HIND = 1  # route position of its rearmost bench at first, m: none ever comes behind that
    WIDEST = 2  # greatest radius of its boxes, m
    # 1 if its benches can meet no other: they must follow too, and no span spares their cells
    ALONE = 3
    FOREMOST = 4  # the links before its first bench, m
    REARMOST = 5  # those before its last: none, if only the head is of it
    FIRST = 6  # route position of the first of its parts that have partners, m
    WAYS = 7  # and on: at most the way back to a bench of each group, m


class Kinds(NamedTuple):
    """Sizes of benches, (4, kinds), and the group of each: see kernels/kinds.py."""

    sizes: Table
    group: IntVector


class Hierarchy(NamedTuple):
    """The cells of a route that a dragon walks; the caller's memory."""

    counts: IntVector
    measures: Vector
    groups: Table  # (groups, BenchGroup.WAYS + groups)
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
    seams: Table  # of `rounding.find_seams`, (rows, SEAM_COLUMNS)


class Grids(NamedTuple):
    """The middles of cells, and the boxes of whole cells; `found` has room for all of either."""

    middles: Grid
    boxes: Grid
    found: IntVector


@kernel
def has_room(ground: Hierarchy) -> bool:
    """Whether all rows, entries, pairs and doubts that were counted fit into their arrays."""
    counts = ground.counts
    return (
        counts[BoxCount.ROWS] <= ground.tree.shape[0]
        and counts[BoxCount.ENTRIES] <= ground.partners.shape[0]
        and counts[BoxCount.NEAR] <= ground.near.shape[0]
        and counts[BoxCount.DOUBTS] <= ground.doubts.shape[0]
    )


@kernel
def add_row(tree: IntArray, hulls: FloatArray, row: int, group: int, number: int, level: int) -> None:
    """Begin a row of the tree, not boxed yet."""
    if row < tree.shape[0]:
        tree[row, Node.STATE], tree[row, Node.CHILD], tree[row, Node.PARTNER] = NodeState.UNKNOWN, 0, 0
        tree[row, Node.GROUP], tree[row, Node.NUMBER], tree[row, Node.LEVEL] = group, number, level
        hulls[row, Box.CX] = hulls[row, Box.CY] = math.nan


@kernel
def mark(counts: IntArray, tree: IntArray, todo: IntArray, row: int) -> None:
    """Put a row on the list of boxes to be made, once."""
    if tree[row, Node.STATE] == NodeState.UNKNOWN:
        tree[row, Node.STATE], todo[counts[BoxCount.TODO]] = NodeState.WANTED, row
        counts[BoxCount.TODO] += 1


@kernel
def split(counts: IntArray, tree: IntArray, hulls: FloatArray, todo: IntArray, row: int) -> None:
    """Split a box into its parts, once, and mark these for boxing; beyond the room they are counted."""
    if tree[row, Node.CHILD]:
        return
    base = counts[BoxCount.ROWS]
    counts[BoxCount.ROWS] = base + PARTS
    if base + PARTS > tree.shape[0]:
        return
    tree[row, Node.CHILD] = base
    for n in range(PARTS):
        number = tree[row, Node.NUMBER] * PARTS + n
        add_row(tree, hulls, base + n, tree[row, Node.GROUP], number, tree[row, Node.LEVEL] * PARTS)
        mark(counts, tree, todo, base + n)
