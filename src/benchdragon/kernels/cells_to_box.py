"""Broad phase, built lazily: cells are marked for boxing where benches may come near others."""

import math

from benchdragon.kernels.box import Box, offset
from benchdragon.kernels.box_hierarchy import (
    BenchGroup,
    BoxCount,
    BoxMeasure,
    Hierarchy,
    Hull,
    Node,
    NodeState,
    add_row,
    mark,
)
from benchdragon.kernels.curve import FloatArray, place
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.grid import Grid, gather
from benchdragon.kernels.route import IntArray, locate
from benchdragon.kernels.swept_boxes import EDGE


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
def add_cell(rows: FloatArray, ground: Hierarchy, hind: float) -> int:
    """Add a cell, with the place of the route in its middle; returns its number."""
    counts, cell = ground.counts, ground.measures[BoxMeasure.CELL]
    c, groups = counts[BoxCount.CELLS], counts[BoxCount.GROUPS]
    counts[BoxCount.CELLS] = c + 1
    middle = (c + counts[BoxCount.LOW] + 0.5) * cell
    j, u, _ = locate(rows, min(max(middle, hind), ground.measures[BoxMeasure.END]))
    ground.middles[c, 0], ground.middles[c, 1], _, _ = place(rows, j, u)
    find_spans(ground.spans, groups * groups, counts[BoxCount.LOW], cell, c, ground.span_of)
    for g in range(groups):
        row = g * ground.middles.shape[0] + c
        add_row(ground.tree, ground.hulls, row, g, c, 1)
    return c


@kernel
def mark_for_boxing(ground: Hierarchy, c: int, g: int) -> None:
    """Mark cell c for boxing for group g, unless it is behind where the group's last bench began."""
    if (
        ground.groups[g, BenchGroup.HIND]
        < (ground.counts[BoxCount.LOW] + c + 1) * ground.measures[BoxMeasure.CELL]
    ):
        mark(ground.counts, ground.tree, ground.todo, g * ground.middles.shape[0] + c)


@kernel
def may_meet(span_of: IntArray, c: int, d: int, pair: int) -> bool:
    """Whether no clear span keeps benches of a pair of groups apart in cells c and, behind it, d."""
    span = span_of[c, pair]
    return span < 0 or span != span_of[d, pair]


@kernel
def mark_meeting(ground: Hierarchy, grid: Grid, found: IntArray, c: int, a: int, b: int) -> None:
    """Mark cell c for boxing for group a if a bench of group b may stand in a near cell of `grid`.

    Cells that share a clear span with it do not count.
    """
    middles, span_of, pair = ground.middles, ground.span_of, a * ground.counts[BoxCount.GROUPS] + b
    x, y = middles[c, 0], middles[c, 1]
    reach = (
        ground.groups[a, BenchGroup.ARM]
        + ground.groups[b, BenchGroup.ARM]
        + ground.measures[BoxMeasure.REACH]
    )
    for n in range(gather(grid, x, y, reach, found)):
        d = found[n]
        apart = (middles[d, 0] - x) ** 2 + (middles[d, 1] - y) ** 2
        if apart <= reach * reach and may_meet(span_of, c, d, pair):
            mark_for_boxing(ground, c, a)
            return


@kernel
def mark_new(ground: Hierarchy, grid: Grid, found: IntArray, c: int) -> None:
    """Mark the latest cell, c, for boxing where its benches may meet others in earlier cells of `grid`.

    It is also marked for pairs in no clear span, so that it gets known whether benches walk through.
    """
    groups, tree, cells = ground.counts[BoxCount.GROUPS], ground.tree, ground.middles.shape[0]
    for pair in range(groups * groups):
        a, b = pair // groups, pair % groups
        if a == b and ground.groups[a, BenchGroup.ALONE] > 0.0:
            mark_for_boxing(ground, c, a)
        if ground.groups[a, BenchGroup.WAYS + b] < math.inf:
            if ground.span_of[c, pair] < 0:
                mark_for_boxing(ground, c, a)
                mark_for_boxing(ground, c, b)
            if ground.span_of[c, pair] != ground.span_of[0, pair]:
                ground.counts[BoxCount.MIXED] = 1
    for pair in range(groups * groups):
        a, b = pair // groups, pair % groups
        known = (
            ground.counts[BoxCount.MIXED] == 0 or tree[a * cells + c, Node.STATE] != NodeState.UNKNOWN
        )
        if not known and ground.groups[a, BenchGroup.WAYS + b] < math.inf:
            mark_meeting(ground, grid, found, c, a, b)


@kernel
def mark_behind(ground: Hierarchy, grid: Grid, found: IntArray, row: int) -> None:
    """Mark for boxing all cells behind in which benches may come near those in the box of cell `row`.

    `grid` holds the middles of all cells.
    """
    hulls, middles, tree, span_of = ground.hulls, ground.middles, ground.tree, ground.span_of
    groups = ground.counts[BoxCount.GROUPS]
    reach = ground.measures[BoxMeasure.REACH]
    cell = ground.measures[BoxMeasure.CELL]
    a, c, widest, table = tree[row, Node.GROUP], tree[row, Node.NUMBER], 0.0, ground.groups
    if math.isnan(hulls[row, Box.CX]):
        return
    for b in range(groups):
        widest = max(widest, table[b, BenchGroup.ARM])
    far = hulls[row, Hull.RADIUS] + widest + reach
    for n in range(gather(grid, hulls[row, Box.CX], hulls[row, Box.CY], far, found)):
        d = found[n]
        along, across = offset(hulls, row, middles[d, 0], middles[d, 1])
        ahead = max(abs(along) - hulls[row, Box.HALF_LENGTH], 0.0)
        aside = max(abs(across) - hulls[row, Box.HALF_WIDTH], 0.0)
        for b in range(groups):
            near = table[b, BenchGroup.ARM] + reach
            known = tree[b * middles.shape[0] + d, Node.STATE] != NodeState.UNKNOWN
            if known or d > c or not (c + 1 - d) * cell >= table[a, BenchGroup.WAYS + b]:
                continue
            if ahead * ahead + aside * aside <= near * near and may_meet(span_of, c, d, a * groups + b):
                mark_for_boxing(ground, d, b)
