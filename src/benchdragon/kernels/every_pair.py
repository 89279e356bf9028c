"""A search of a whole walk for all pairs of benches, step by step, without cells of the route.

For dragons of which no two benches are alike, whose handles walk beside the route: boxing what each
bench sweeps in each cell would cost more than the search (kernels/swept_boxes.py). Pairs that may come
near in a step are found by its benches' paths and faces, and searched as in kernels/time_of_impact.py.
"""

import math
from typing import NamedTuple

import numpy as np

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.box import box_gap, centres, radii
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.motion_bounds import BenchBound, HandleBound
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.separation_bounds import face_bound
from benchdragon.kernels.time_of_impact import (
    Chain,
    Ending,
    Goal,
    Limits,
    Note,
    Pairs,
    Search,
    activate_pairs,
    bisect,
    bound_members,
    close_left,
    evaluate_slot,
)


class PairsEnding(Ending):
    """Exit status of a search, besides those of `Ending`; CROWDED: room for pairs is too small."""

    CROWDED = 7


# The cost of a pair of benches at an evaluation, in handles placed.
PAIR_WORK = 0.02


class Circles(NamedTuple):
    """Circles around benches, (benches,) each, in m; all but the radii are scratch."""

    radius: Vector
    cx: Vector  # centres
    cy: Vector
    reach: Vector  # radius and travel in a step
    apart: Vector  # of one bench: squared distances to the others, less the squared reach


@kernel
def grow(circles: Circles, search: Search) -> None:
    """Fill centres and reach for the step from slot 0."""
    centres(search.boxes, circles.cx, circles.cy)
    for i in range(circles.reach.shape[0]):
        circles.reach[i] = circles.radius[i] + search.sweeps[i, BenchBound.TRAVEL]


@kernel
def near_in_step(
    search: Search, circles: Circles, wanted: float, first: IntArray, second: IntArray,
) -> int:  # fmt: skip
    """Find pairs that may come as near as `wanted`, m, in the step from slot 0 to 1; returns how many.

    Counting goes on when first and second are full. The radii of `circles` must be filled.
    """
    cx, cy, reach, apart = circles.cx, circles.cy, circles.reach, circles.apart
    count, found = reach.shape[0], 0
    boxes, sweeps, h = search.boxes, search.sweeps, search.handles[0, HandleBound.PATH]
    grow(circles, search)
    for i in range(2, count):
        most = reach[i] + wanted
        for j in range(i - 1):  # without a branch, so that it becomes SIMD
            near = max(reach[j] + most, 0.0)
            apart[j] = (cx[j] - cx[i]) ** 2 + (cy[j] - cy[i]) ** 2 - near * near
        for j in range(i - 1):
            if apart[j] <= 0.0:
                spent = sweeps[i, BenchBound.TRAVEL] + sweeps[j, BenchBound.TRAVEL]
                if box_gap(boxes, j, i) > wanted + spent:
                    continue
                if (
                    sweeps[i, BenchBound.POINT_ACCELERATION] + sweeps[j, BenchBound.POINT_ACCELERATION]
                    < math.inf
                ):
                    if face_bound(boxes, sweeps, count, j, i, h) > wanted:
                        continue
                    if face_bound(boxes, sweeps, count, i, j, h) > wanted:
                        continue
                if found < first.shape[0]:
                    first[found], second[found] = j, i
                found += 1
    return found


@kernel
def search_near(
    search: Search, goal: int, chain: Chain, circles: Circles, scratch: Pairs, limits: Limits,
    note: FloatArray,
) -> int:  # fmt: skip
    """Search the step from slot 0 to slot 1, both placed, for `goal`: see `search_all_pairs`."""
    count = chain.members.shape[0]
    bound_members(chain, search, 1)
    near = note[Note.NEAREST] - limits.slack if goal == Goal.LEAST else limits.margin + limits.slack
    found = near_in_step(search, circles, near, scratch.first, scratch.second)
    if found > scratch.first.shape[0]:
        return PairsEnding.CROWDED
    if found == 0:
        close_left(search, 1, chain.links.shape[0] + 1, count)
        return Ending.CLEAR
    activate_pairs(search, found)
    before, note[Note.PAIR] = note[Note.PAIR], -1.0
    pairs = Pairs(scratch.first[:found], scratch.second[:found])
    ending = bisect(search, goal, chain, pairs, 1, 2, limits, note)
    p = int(note[Note.PAIR])
    note[Note.PAIR] = before if p < 0 else float(pairs.first[p] * count + pairs.second[p])
    return ending


@kernel
def search_steps(
    search: Search, goal: int, rows: FloatArray, links: FloatArray, aside: FloatArray,
    sizes: FloatArray, at: FloatArray, first: IntArray, second: IntArray, limits: Limits,
    note: FloatArray, members: IntArray, scratch: FloatArray,
) -> int:  # fmt: skip
    """As `search_all_pairs`, with scratch for the members and five rows for their circles."""
    for i in range(members.shape[0]):
        members[i] = i
    n = members.shape[0]
    circles = Circles(scratch[0][:n], scratch[1][:n], scratch[2][:n], scratch[3][:n], scratch[4][:n])
    radii(sizes, circles.radius)
    chain = Chain(rows, links, aside, sizes, members, search.boxes[:0], search.boxes[:0])
    pairs, worst = Pairs(first, second), Ending.CLEAR
    search.at[0] = at[0]
    if not evaluate_slot(chain, search, 0, 0):
        return stopped(search, 0, note)
    for t in range(at.shape[0] - 1):
        search.at[1] = at[t + 1]
        if not evaluate_slot(chain, search, 1, 0):
            return stopped(search, 1, note)
        ending = search_near(search, goal, chain, circles, pairs, limits, note)
        if ending not in (Ending.CLEAR, Ending.GRAZE) or (
            ending == Ending.GRAZE and goal != Goal.LEAST
        ):
            return ending
        worst = max(worst, ending)
    return worst


@kernel
def stopped(search: Search, slot: int, note: FloatArray) -> int:
    """Record the slot at which the chain cannot be placed; returns FALLEN."""
    note[Note.UPPER] = search.at[slot]
    return Ending.FALLEN


@entry
@allocates
def search_all_pairs(
    search: Search, goal: int, rows: Table, links: Vector, aside: Vector, sizes: Table, at: Vector,
    first: IntVector, second: IntVector, margin: float, slack: float, width: float, most: int,
    note: Vector,
) -> int:  # fmt: skip
    """Search the head's steps at[t]..at[t + 1], m, for `goal` (FIRST_TOUCH or LEAST): a `PairsEnding`.

    Handle i walks aside[i] metres to the left of the route. Pair p of benches, from 0, is first[p] and
    second[p], which are scratch; note[PAIR] becomes first bench times their number plus second.
    Everything else is as in `Limits` and `bisect` of kernels/time_of_impact.py. After CROWDED the
    search must start again with longer scratch.
    """
    count, limits = sizes.shape[1], Limits(margin, slack, width, most)
    return search_steps(
        search, goal, rows, links, aside, sizes, at, first, second, limits, note,
        np.empty(count, dtype=np.int64), np.empty((5, count)),
    )  # fmt: skip
