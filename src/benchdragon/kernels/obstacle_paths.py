"""What a search beside an obstacle goes along: each size of bench once; and where all stand."""

import math

from benchdragon.kernels import obstacle_memory as of
from benchdragon.kernels.box import CX, CY, place_box
from benchdragon.kernels.chain import march
from benchdragon.kernels.curve import S_START, length_at
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.obstacle import forbids
from benchdragon.kernels.obstacle_contact import distances_to
from benchdragon.kernels.obstacle_memory import Beside
from benchdragon.kernels.rounding import bench_errors, still_error
from benchdragon.kernels.spans import PLACED, begin_repeats, new_spans
from benchdragon.kernels.status import Status


@kernel
def stands(beside: Beside) -> bool:
    """Whether the dragon stands at both ends of its walk; if so, how it does, and the ways of sizes."""
    figures, placed, rows, asked = beside.figures, beside.placed, beside.bench.rows, beside.asked
    beside.at[0], beside.at[1] = asked[of.HEAD_FIRST], asked[of.HEAD_LAST]
    march(rows, beside.links, beside.at, 0, 2, placed)
    if placed.failed[0, 0] != Status.OK or placed.failed[0, 1] != Status.OK:
        return False
    for i in range(beside.s.shape[0]):
        for t in range(2):
            j = placed.row[i, t]
            beside.s[i, t] = rows[j, S_START] + length_at(rows, j, placed.u[i, t])
    rewind(beside)
    while next_span(beside):
        way, first = beside.ways[int(figures[of.SIZE])], figures[of.FROM]
        if way[of.WAY_COUNT] == 0.0:
            way[of.WAY_BENCH], way[of.WAY_LOW], way[of.WAY_HIGH] = figures[of.SIZE], first, first
            way[of.WAY_LENGTH] = 0.0
        way[of.WAY_COUNT] += 1.0 if figures[of.SPAN] == 1.0 else 0.0
        way[of.WAY_LOW] = min(way[of.WAY_LOW], first)
        way[of.WAY_HIGH] = max(way[of.WAY_HIGH], figures[of.TO])
        way[of.WAY_LENGTH] += figures[of.TO] - first
    stand_at_start(beside)
    figures[of.ABOUT] = figures[of.SOUGHT_OFF]
    figures[of.NEAR], figures[of.NEAR_AT] = figures[of.APART], math.nan
    figures[of.NEAR_BENCH] = figures[of.APART_BENCH]
    return True


@kernel
def stand_at_start(beside: Beside) -> None:
    """Find how near benches are at the start: minus infinity where one stands where none may."""
    figures, asked, links, still = beside.figures, beside.asked, beside.links, 0.0
    boxes, box, sort = beside.standing.boxes, beside.box, int(asked[of.SORT])
    figures[of.APART] = math.inf
    for i in range(links.shape[0]):
        place_box(beside.sizes, i, i, beside.placed.x, beside.placed.y, 0, box, 0)
        distances_to(box[:1], boxes, beside.standing.near, beside.nearest, beside.which)
        apart = beside.nearest[0]
        if forbids(sort, beside.outline, asked[of.RADIUS], box[0, CX], box[0, CY]):
            apart = -math.inf
        if apart < figures[of.APART]:
            figures[of.APART], figures[of.APART_BENCH] = apart, i
    rows, sizes, seams, chain = beside.bench.rows, beside.sizes, beside.bench.seams, beside.chain
    beside.at[0] = asked[of.HEAD_FIRST]
    if place_chain(rows, links, beside.at, 0, 1, chain):
        bench_errors(rows, links, sizes, seams, chain, 0, 0, beside.lanes, beside.errors, beside.off)
        for i in range(links.shape[0]):
            figures[of.APART_OFF] = max(figures[of.APART_OFF], beside.off[i])
    for n in range(boxes.shape[0]):
        still = max(still, still_error(boxes, n))
    figures[of.APART_OFF] = max(figures[of.SOUGHT_OFF], figures[of.APART_OFF] + still)


@kernel
def rewind(beside: Beside) -> None:
    """Let the first span come next."""
    figures = beside.figures
    figures[of.SPANS] = figures[of.SPAN] = figures[of.GRAZES] = 0.0
    begin_size(beside, 0)


@kernel
def begin_size(beside: Beside, k: int) -> None:
    """Turn to the benches of the size of bench k, the first of these."""
    bench, figures = beside.bench, beside.figures
    bench.link[0] = beside.links[k]
    for n in range(4):
        bench.sizes[n, 0] = beside.sizes[n, k]
    figures[of.SIZE], figures[of.BENCH], figures[of.AHEAD] = k, k - 1, math.inf
    figures[of.REPEATS] = begin_repeats(
        bench.rows, bench.link, beside.repeats, beside.at, beside.chain, beside.begun
    )


@kernel
def next_bench(beside: Beside) -> bool:
    """Turn to the next bench, and to what of its way is new; whether there is one."""
    figures, alike, benches = beside.figures, beside.alike, beside.alike.shape[0]
    k, i = int(figures[of.SIZE]), int(figures[of.BENCH]) + 1
    while i < benches and alike[i] != k:
        i += 1
    while i == benches:
        k += 1
        if k == benches:
            return False
        if alike[k] == k:
            begin_size(beside, k)
            i = k
    figures[of.BENCH], figures[of.SPANS], figures[of.SPAN] = i, 0.0, 0.0
    start, end = beside.s[i, 0], min(beside.s[i, 1], figures[of.AHEAD])
    figures[of.AHEAD] = start
    if end > start:
        count, missed = new_spans(
            beside.begun, int(figures[of.REPEATS]), beside.bench.link[0], start, end, beside.skips,
            beside.spans,
        )  # fmt: skip
        figures[of.SPANS] = count
        if missed > 0.0:
            figures[of.SOUGHT_OFF] = max(figures[of.SOUGHT_OFF], 2.0 * missed + PLACED)
    return True


@kernel
def next_span(beside: Beside) -> bool:
    """Turn to the next span of route of a bench; whether there is one."""
    figures = beside.figures
    while figures[of.SPAN] == figures[of.SPANS]:
        if not next_bench(beside):
            return False
    n = int(figures[of.SPAN])
    figures[of.FROM], figures[of.TO], figures[of.SPAN] = beside.spans[n, 0], beside.spans[n, 1], n + 1
    return True
