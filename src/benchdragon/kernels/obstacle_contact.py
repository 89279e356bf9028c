"""Benches and obstacles: the first touch, and the least distance, along a stretch of route.

The place of a bench follows from the route position of its own front handle alone, so that all benches
of one size pass an obstacle in the same way: it is searched once for each size, over route positions,
and not once for each bench over time. An obstacle is boxes without width, or without length either (the
sides of a polygon, the centre of a circle), which the search takes for benches that do not move.
"""

import math
from typing import NamedTuple

from benchdragon.kernels import box
from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.box import Box, box_distance, half_diagonal, offset, place_box
from benchdragon.kernels.continuation import UNIT, finest
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.motion_bounds import BenchBound, bound_bench, place_chain
from benchdragon.kernels.swept_boxes import EDGE, walks_on
from benchdragon.kernels.time_of_impact import (
    Chain,
    Ending,
    Goal,
    Limits,
    Note,
    Pairs,
    Search,
    bisect,
    box_slot,
    open_step,
)
from benchdragon.kernels.walk_search import WIDTH_ROUNDINGS, WalkEnding

# Stretches of route, m, for each of which distant boxes are culled at once: longer stretches cull fewer
# boxes, shorter ones are more in number.
STRETCH = 4.0


class Bench(NamedTuple):
    """One bench on a route."""

    rows: Table
    link: Vector  # (1,)
    sizes: Table  # (4, 1): length, width, front inset, rear inset, m
    seams: Table  # of `rounding.find_seams`


class Standing(NamedTuple):
    """Boxes of an obstacle, and scratch for as many."""

    boxes: Table  # (boxes, BOX_COLUMNS)
    near: Table  # scratch: those near, (boxes, BOX_COLUMNS)
    number: IntVector  # which they are
    first: IntVector  # pairs of the bench and these
    second: IntVector
    members: IntVector  # (1,): bench 0


@kernel
def walks_step(bench: Bench, search: Search) -> bool:
    """Place the bench at both ends of the step in slots 0 and 1; whether it surely walks through it."""
    placed = place_chain(bench.rows, bench.link, search.at, 0, 2, search.places)
    return placed and walks_on(bench.rows, search.places, 0, bench.link, search.handles)


@kernel
def centre_distance(boxes: FloatArray, n: int, x: float, y: float) -> float:
    """Distance of point (x, y) from box n, m; 0 inside."""
    along, across = offset(boxes, n, x, y)
    ahead, aside = abs(along) - boxes[n, Box.HALF_LENGTH], abs(across) - boxes[n, Box.HALF_WIDTH]
    return math.hypot(max(ahead, 0.0), max(aside, 0.0))


@kernel
def gather_near(bench: Bench, standing: Standing, search: Search, wanted: float) -> int:
    """Fill `near` with the boxes that the bench may come as near to as `wanted`, m; returns how many.

    EDGE covers the rounding errors.
    """
    bound_bench(search.handles, 0, bench.sizes, 0, search.sweeps[0])
    place_box(bench.sizes, 0, 0, search.places.x, search.places.y, 0, search.boxes, 0)
    x, y = search.boxes[0, Box.CX], search.boxes[0, Box.CY]
    reach = half_diagonal(search.boxes, 0)
    reach += search.sweeps[0, BenchBound.TRAVEL] + wanted + EDGE
    count = 0
    for n in range(standing.boxes.shape[0]):
        if not centre_distance(standing.boxes, n, x, y) > reach:
            standing.number[count] = n
            for k in range(box.BOX_COLUMNS):
                standing.near[count, k] = standing.boxes[n, k]
            standing.first[count], standing.second[count] = 0, count + 1
            count += 1
    return count


@kernel
def search_step(
    bench: Bench, standing: Standing, search: Search, goal: int, limits: Limits, note: FloatArray
) -> int:
    """Search the step whose ends are placed in slots 0 and 1 for `goal`; returns the exit status."""
    wanted = note[Note.NEAREST] - limits.slack if goal == Goal.LEAST else limits.margin + limits.slack
    start, end = search.at[0], search.at[1]
    count = gather_near(bench, standing, search, wanted)
    if count == 0:
        note[Note.LOWER] = end
        return Ending.CLEAR
    near, members = standing.near[:count], standing.members
    chain = Chain(bench.rows, bench.link, note[:0], bench.sizes, members, near, bench.seams)
    box_slot(chain, search, 0)
    box_slot(chain, search, 1)
    top = open_step(search, count, start, end)
    before, note[Note.PAIR] = note[Note.PAIR], -1.0
    pairs = Pairs(standing.first[:count], standing.second[:count])
    ending = bisect(search, goal, chain, pairs, top, 2, limits, note)
    p = int(note[Note.PAIR])
    note[Note.PAIR] = before if p < 0 else float(standing.number[p])
    return ending


@kernel
def search_span(
    bench: Bench, standing: Standing, search: Search, goal: int, start: float, end: float,
    limits: Limits, note: FloatArray,
) -> int:  # fmt: skip
    """Search from route position start to end, m, for `goal`; returns the exit status, or ASTRAY.

    ASTRAY: past note[LOWER] the bench could not be shown to walk on.
    """
    at, step, worst = start, STRETCH, Ending.CLEAR
    while at < end:
        ahead = end if at + step >= end else at + step
        search.at[0], search.at[1] = at, ahead
        note[Note.EVALUATIONS] += 2.0
        if not walks_step(bench, search):
            step = 0.5 * min(step, end - at)
            if step < finest(at):
                note[Note.LOWER], note[Note.UPPER] = at, ahead
                return WalkEnding.ASTRAY
            continue
        narrow = max(limits.width, WIDTH_ROUNDINGS * UNIT * abs(ahead))
        fitting = Limits(limits.margin, limits.slack, narrow, limits.most)
        ending = search_step(bench, standing, search, goal, fitting, note)
        if ending not in (Ending.CLEAR, Ending.GRAZE) or (
            ending == Ending.GRAZE and goal != Goal.LEAST
        ):
            return ending
        worst = max(worst, ending)
        at, step = ahead, min(2.0 * step, STRETCH)
    return worst


@kernel
def look_along(bench: Bench, standing: Standing, search: Search, spans: Table, note: Vector) -> None:
    """Lower note[NEAREST] to the least distance at the ends of spans, m, with its place and box.

    This is a hint, no bound: ends at which the bench cannot be placed are skipped.
    """
    for t in range(2 * spans.shape[0]):
        search.at[0] = spans[t // 2, t % 2]
        if not place_chain(bench.rows, bench.link, search.at, 0, 1, search.places):
            continue
        place_box(bench.sizes, 0, 0, search.places.x, search.places.y, 0, standing.near, 0)
        near = standing.near
        x, y = near[0, Box.CX], near[0, Box.CY]
        around = half_diagonal(near, 0)
        for n in range(standing.boxes.shape[0]):
            if centre_distance(standing.boxes, n, x, y) - around < note[Note.NEAREST]:
                for k in range(box.BOX_COLUMNS):
                    near[1, k] = standing.boxes[n, k]
                apart = box_distance(near, 0, 1)
                if apart < note[Note.NEAREST]:
                    note[Note.NEAREST], note[Note.UPPER], note[Note.PAIR] = apart, search.at[0], n


@entry
def distances_to(boxes: Table, standing: Table, near: Table, out: Vector, which: IntVector) -> None:
    """Fill `out` with each box's distance to the nearest of `standing`, m, and `which` with its row.

    It is minus the depth of an overlap. `near` is scratch, (2, BOX_COLUMNS).
    """
    for i in range(boxes.shape[0]):
        out[i], which[i] = math.inf, -1
        for k in range(box.BOX_COLUMNS):
            near[0, k] = boxes[i, k]
        around = half_diagonal(boxes, i)
        for n in range(standing.shape[0]):
            if centre_distance(standing, n, boxes[i, Box.CX], boxes[i, Box.CY]) - around < out[i]:
                for k in range(box.BOX_COLUMNS):
                    near[1, k] = standing[n, k]
                apart = box_distance(near, 0, 1)
                if apart < out[i]:
                    out[i], which[i] = apart, n
