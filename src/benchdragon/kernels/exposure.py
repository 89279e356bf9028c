"""Which cells of a route to box: where benches may come near others in no clear span with them."""

import math

from benchdragon.kernels.box import CX, CY, HALF_LENGTH, HALF_WIDTH, offset
from benchdragon.kernels.cells import (
    ALONE,
    ARM,
    CELL,
    CELLS,
    END,
    GROUP,
    GROUPS,
    HIND,
    LOW,
    MIXED,
    NUMBER,
    RADIUS,
    REACH,
    STATE,
    UNKNOWN,
    WAYS,
    Ground,
    add_row,
    want,
)
from benchdragon.kernels.curve import FloatArray, place
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.grid import Grid, gather
from benchdragon.kernels.regions import EDGE
from benchdragon.kernels.route import IntArray, locate


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
def expose(ground: Ground, c: int, g: int) -> None:
    """Want cell c boxed for group g, but behind where the group's last bench began."""
    if ground.groups[g, HIND] < (ground.counts[LOW] + c + 1) * ground.measures[CELL]:
        want(ground.counts, ground.tree, ground.todo, g * ground.middles.shape[0] + c)


@kernel
def may_meet(span_of: IntArray, c: int, d: int, pair: int) -> bool:
    """Whether no clear span keeps benches of a pair of groups apart in cells c and, behind it, d."""
    span = span_of[c, pair]
    return span < 0 or span != span_of[d, pair]


@kernel
def expose_meeting(ground: Ground, grid: Grid, found: IntArray, c: int, a: int, b: int) -> None:
    """Want cell c boxed for group a if one of group b may stand in a cell near it, in `grid`.

    And not in one clear span with it.
    """
    middles, span_of, pair = ground.middles, ground.span_of, a * ground.counts[GROUPS] + b
    x, y = middles[c, 0], middles[c, 1]
    reach = ground.groups[a, ARM] + ground.groups[b, ARM] + ground.measures[REACH]
    for n in range(gather(grid, x, y, reach, found)):
        d = found[n]
        apart = (middles[d, 0] - x) ** 2 + (middles[d, 1] - y) ** 2
        if apart <= reach * reach and may_meet(span_of, c, d, pair):
            expose(ground, c, a)
            return


@kernel
def expose_new(ground: Ground, grid: Grid, found: IntArray, c: int) -> None:
    """Want the latest cell, c, boxed where its benches may meet others of the cells before, in `grid`.

    And where they are in no clear span, that it is known whether they walk through.
    """
    groups, tree, cells = ground.counts[GROUPS], ground.tree, ground.middles.shape[0]
    for pair in range(groups * groups):
        a, b = pair // groups, pair % groups
        if a == b and ground.groups[a, ALONE] > 0.0:
            expose(ground, c, a)
        if ground.groups[a, WAYS + b] < math.inf:
            if ground.span_of[c, pair] < 0:
                expose(ground, c, a)
                expose(ground, c, b)
            if ground.span_of[c, pair] != ground.span_of[0, pair]:
                ground.counts[MIXED] = 1
    for pair in range(groups * groups):
        a, b = pair // groups, pair % groups
        known = ground.counts[MIXED] == 0 or tree[a * cells + c, STATE] != UNKNOWN
        if not known and ground.groups[a, WAYS + b] < math.inf:
            expose_meeting(ground, grid, found, c, a, b)


@kernel
def expose_behind(ground: Ground, grid: Grid, found: IntArray, row: int) -> None:
    """Want all cells behind boxed in which benches may come near those in a box of a cell.

    `grid` holds the middles of all cells.
    """
    hulls, middles, tree, span_of = ground.hulls, ground.middles, ground.tree, ground.span_of
    groups, reach, cell = ground.counts[GROUPS], ground.measures[REACH], ground.measures[CELL]
    a, c, widest, table = tree[row, GROUP], tree[row, NUMBER], 0.0, ground.groups
    if math.isnan(hulls[row, CX]):
        return
    for b in range(groups):
        widest = max(widest, table[b, ARM])
    far = hulls[row, RADIUS] + widest + reach
    for n in range(gather(grid, hulls[row, CX], hulls[row, CY], far, found)):
        d = found[n]
        along, across = offset(hulls, row, middles[d, 0], middles[d, 1])
        ahead = max(abs(along) - hulls[row, HALF_LENGTH], 0.0)
        aside = max(abs(across) - hulls[row, HALF_WIDTH], 0.0)
        for b in range(groups):
            near, known = table[b, ARM] + reach, tree[b * middles.shape[0] + d, STATE] != UNKNOWN
            if known or d > c or not (c + 1 - d) * cell >= table[a, WAYS + b]:
                continue
            if ahead * ahead + aside * aside <= near * near and may_meet(span_of, c, d, a * groups + b):
                expose(ground, d, b)
