"""The ways that a search beside an obstacle covers, each size of bench once; and where all stand."""

import math

from benchdragon.kernels.box import Box, place_box
from benchdragon.kernels.chain import march
from benchdragon.kernels.curve import RouteRow, length_at
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.obstacle import forbids
from benchdragon.kernels.obstacle_contact import distances_to
from benchdragon.kernels.obstacle_memory import Beside, ObstacleGiven, ObstacleTold, SizeWay
from benchdragon.kernels.rounding import bench_errors, still_error
from benchdragon.kernels.spans import PLACED, begin_repeats, new_spans
from benchdragon.kernels.status import Status


@kernel
def stands(beside: Beside) -> bool:
    """Whether the dragon stands at both ends of its walk; if so, fill its places and sizes' ways."""
    figures, placed, rows, asked = beside.figures, beside.placed, beside.bench.rows, beside.asked
    beside.at[0], beside.at[1] = asked[ObstacleGiven.HEAD_FIRST], asked[ObstacleGiven.HEAD_LAST]
    march(rows, beside.links, beside.at, 0, 2, placed)
    if placed.failed[0, 0] != Status.OK or placed.failed[0, 1] != Status.OK:
        return False
    for i in range(beside.s.shape[0]):
        for t in range(2):
            j = placed.row[i, t]
            beside.s[i, t] = rows[j, RouteRow.S_START] + length_at(rows, j, placed.u[i, t])
    rewind(beside)
    while next_span(beside):
        way, first = beside.ways[int(figures[ObstacleTold.SIZE])], figures[ObstacleTold.FROM]
        if way[SizeWay.COUNT] == 0.0:
            way[SizeWay.BENCH] = figures[ObstacleTold.SIZE]
            way[SizeWay.LOW] = first
            way[SizeWay.HIGH] = first
            way[SizeWay.LENGTH] = 0.0
        way[SizeWay.COUNT] += 1.0 if figures[ObstacleTold.SPAN] == 1.0 else 0.0
        way[SizeWay.LOW] = min(way[SizeWay.LOW], first)
        way[SizeWay.HIGH] = max(way[SizeWay.HIGH], figures[ObstacleTold.TO])
        way[SizeWay.LENGTH] += figures[ObstacleTold.TO] - first
    stand_at_start(beside)
    figures[ObstacleTold.ABOUT] = figures[ObstacleTold.SOUGHT_OFF]
    figures[ObstacleTold.NEAR], figures[ObstacleTold.NEAR_AT] = figures[ObstacleTold.APART], math.nan
    figures[ObstacleTold.NEAR_BENCH] = figures[ObstacleTold.APART_BENCH]
    return True


@kernel
def stand_at_start(beside: Beside) -> None:
    """Find how near benches are at the start: minus infinity if one stands where no bench may be."""
    figures, asked, links, still = beside.figures, beside.asked, beside.links, 0.0
    boxes, box, sort = beside.standing.boxes, beside.box, int(asked[ObstacleGiven.SORT])
    figures[ObstacleTold.APART] = math.inf
    for i in range(links.shape[0]):
        place_box(beside.sizes, i, i, beside.placed.x, beside.placed.y, 0, box, 0)
        distances_to(box[:1], boxes, beside.standing.near, beside.nearest, beside.which)
        apart = beside.nearest[0]
        if forbids(sort, beside.outline, asked[ObstacleGiven.RADIUS], box[0, Box.CX], box[0, Box.CY]):
            apart = -math.inf
        if apart < figures[ObstacleTold.APART]:
            figures[ObstacleTold.APART], figures[ObstacleTold.APART_BENCH] = apart, i
    rows, sizes, seams, chain = beside.bench.rows, beside.sizes, beside.bench.seams, beside.chain
    beside.at[0] = asked[ObstacleGiven.HEAD_FIRST]
    if place_chain(rows, links, beside.at, 0, 1, chain):
        bench_errors(rows, links, sizes, seams, chain, 0, 0, beside.lanes, beside.errors, beside.off)
        for i in range(links.shape[0]):
            figures[ObstacleTold.APART_OFF] = max(figures[ObstacleTold.APART_OFF], beside.off[i])
    for n in range(boxes.shape[0]):
        still = max(still, still_error(boxes, n))
    figures[ObstacleTold.APART_OFF] = max(
        figures[ObstacleTold.SOUGHT_OFF], figures[ObstacleTold.APART_OFF] + still
    )


@kernel
def rewind(beside: Beside) -> None:
    """Let the first span come next."""
    figures = beside.figures
    figures[ObstacleTold.SPANS] = figures[ObstacleTold.SPAN] = figures[ObstacleTold.GRAZES] = 0.0
    begin_size(beside, 0)


@kernel
def begin_size(beside: Beside, k: int) -> None:
    """Turn to the benches of the size of bench k, the first of these."""
    bench, figures = beside.bench, beside.figures
    bench.link[0] = beside.links[k]
    for n in range(4):
        bench.sizes[n, 0] = beside.sizes[n, k]
    figures[ObstacleTold.SIZE] = k
    figures[ObstacleTold.BENCH] = k - 1
    figures[ObstacleTold.AHEAD] = math.inf
    figures[ObstacleTold.REPEATS] = begin_repeats(
        bench.rows, bench.link, beside.repeats, beside.at, beside.chain, beside.begun
    )


@kernel
def next_bench(beside: Beside) -> bool:
    """Turn to the next bench, and to the new part of its way; False if there is none."""
    figures, alike, benches = beside.figures, beside.alike, beside.alike.shape[0]
    k, i = int(figures[ObstacleTold.SIZE]), int(figures[ObstacleTold.BENCH]) + 1
    while i < benches and alike[i] != k:
        i += 1
    while i == benches:
        k += 1
        if k == benches:
            return False
        if alike[k] == k:
            begin_size(beside, k)
            i = k
    figures[ObstacleTold.BENCH], figures[ObstacleTold.SPANS], figures[ObstacleTold.SPAN] = i, 0.0, 0.0
    start, end = beside.s[i, 0], min(beside.s[i, 1], figures[ObstacleTold.AHEAD])
    figures[ObstacleTold.AHEAD] = start
    if end > start:
        count, missed = new_spans(
            beside.begun, int(figures[ObstacleTold.REPEATS]), beside.bench.link[0], start, end,
            beside.skips,
            beside.spans,
        )  # fmt: skip
        figures[ObstacleTold.SPANS] = count
        if missed > 0.0:
            figures[ObstacleTold.SOUGHT_OFF] = max(
                figures[ObstacleTold.SOUGHT_OFF], 2.0 * missed + PLACED
            )
    return True


@kernel
def next_span(beside: Beside) -> bool:
    """Turn to the next span of route of a bench; False if there is none."""
    figures = beside.figures
    while figures[ObstacleTold.SPAN] == figures[ObstacleTold.SPANS]:
        if not next_bench(beside):
            return False
    n = int(figures[ObstacleTold.SPAN])
    figures[ObstacleTold.FROM] = beside.spans[n, 0]
    figures[ObstacleTold.TO] = beside.spans[n, 1]
    figures[ObstacleTold.SPAN] = n + 1
    return True
