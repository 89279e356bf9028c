"""Why contact is searched with two bounds, cells of route, and the head's position instead of time.

A search that looks at times can miss a contact between them: the contest's dragon passes 0.9 mm and
3 mm clear of one before it touches, and its smallest pitch grazes for milliseconds. So each step that
is passed over needs a bound that holds for all of it. Everything below is a function of the head's
route position sigma; speed has no part in it.

1. Travel. Path lengths add: distance >= (d_start + d_end - D_i - D_j) / 2, with D what a point of a
   bench travels at most, a sum over its handles' arc lengths. It needs nothing but order along the
   route, kinks included, but loses in first order: near a contact steps shrink with the gap.
2. Faces. The height of a corner over a face of the other bench, both moving, has a second derivative of
   at most M, so that over a step h it stays within M h^2 / 8 of the straight line between its ends. M
   follows from enclosures of angles, speeds and accelerations, bench by bench down the chain. It loses
   in second order: a graze (a quadratic minimum) needs a number of looks that does not grow with
digits.
3. Cells. What all benches of one size sweep while their front handle walks through a cell of route is
   boxed once. Two benches can meet only where two such boxes come near one another, whatever the time.

Below: looks needed by either bound alone for the pair that touches first, down to brackets of several
widths; how many steps cells leave to the search; and what looking each second, each 0.1 s would
have said.
"""

import math

import numpy as np

from benchdragon import Walk, clearances, contact_windows
from benchdragon.analysis.contact_search import ContactSearch
from benchdragon.analysis.nearby import seams_of
from benchdragon.kernels import box_hierarchy, motion_bounds, search_start
from benchdragon.kernels import time_of_impact as kernel
from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.contact_memory import ContactTold
from benchdragon.kernels.motion_bounds import BenchBound
from benchdragon.kernels.time_of_impact import Ending, Goal, Note
from benchdragon.kernels.walk_search import WalkGoal
from benchdragon.plans.schema import read_plan
from benchdragon.progress import silent


def looks_for(walk: Walk, slack: float, smooth: bool) -> int:
    """Chains marched until benches 1 and 9 touch, from 412 m on, by both bounds or by travel."""
    search = kernel.empty_search(10, 2, 1)
    dragon, note = walk.dragon, np.zeros(kernel.NOTES)
    members, nothing = np.array([0, 8]), np.empty((0, BOX_COLUMNS))
    chain = kernel.Chain(
        walk.route.rows,
        dragon.links[:9],
        np.empty(0),
        dragon.sizes,
        members,
        nothing,
        seams_of(walk.route.rows),
    )
    pairs = kernel.Pairs(np.array([0]), np.array([1]))
    limits = kernel.Limits(0.0, slack, slack, 1_000_000)
    if smooth:
        top = kernel.open_step(search, 1, 412.0, 412.5)
        kernel.bisect(search, Goal.FIRST_TOUCH, chain, pairs, top, 0, limits, note)
        return int(note[Note.EVALUATIONS])
    return travel_only(walk, slack)


def travel_only(walk: Walk, slack: float) -> int:
    """The same by the travel bound alone: leftmost halves first."""
    still, evaluations = Walk(walk.dragon, walk.route), 0
    places = empty_placements(10, 2)
    handles, bench = np.empty((10, motion_bounds.HANDLE_COLUMNS)), np.empty(motion_bounds.BENCH_COLUMNS)
    stack, at = [412.5], 412.0
    while stack:
        end = stack[-1]
        evaluations += 1
        ends = np.array([at, end])
        motion_bounds.place_chain(walk.route.rows, walk.dragon.links[:9], ends, 0, 2, places)
        motion_bounds.bound_handles(walk.route.rows, walk.dragon.links[:9], places, 0, 1, handles)
        spent = 0.0
        for i in (0, 8):
            motion_bounds.bound_bench(handles, i, walk.dragon.sizes, i, bench)
            spent += bench[BenchBound.TRAVEL]
        a, b = clearances(still.motion(ends))
        if a <= slack:
            return evaluations
        if 0.5 * (a + b - spent) > 0.0:
            at = stack.pop()
        elif end - at < slack or evaluations > 20_000:
            return evaluations
        else:
            stack.append(0.5 * (at + end))
    return evaluations


def main() -> None:
    """Print the three tables."""
    walk = read_plan("spiral-in").build()
    print("bracket, m   looks by travel alone   by both bounds")
    for slack in (1e-3, 1e-5, 1e-7):
        print(f"{slack:8.0e} {looks_for(walk, slack, False):20d} {looks_for(walk, slack, True):17d}")
    for slack in (1e-10, 1e-13):
        print(f"{slack:8.0e} {'-':>20s} {looks_for(walk, slack, True):17d}")

    search, steps, from_s = ContactSearch(walk, 0.0, 413.0, 1e-6, silent), 0, math.inf
    while search.find(WalkGoal.SEEK, (1e-6,)) == Ending.FOUND:
        steps, from_s = steps + 1, min(from_s, float(search.figures[ContactTold.EARLY]))
    every = 413.0 / (search_start.CELL_SHARE * float(walk.dragon.links.min()) / box_hierarchy.PARTS)
    print(f"\nsteps of the head: {every:.0f} in all")
    print(f"in which benches may meet: {steps}, from head position {from_s:.1f} m on")

    print("\nstep, s   first sample that overlaps, s")
    for step in (1.0, 0.1, 0.01):
        times = np.arange(400.0, 420.0, step)
        low = clearances(walk.motion(times)) < 0.0
        print(f"{step:7g} {times[low][0]:17.2f}")
    (window,) = contact_windows(walk, 400.0, 413.0)
    print(f"  exact {window.opens.value:.10f}, {window.opens.evaluations} evaluations")


if __name__ == "__main__":
    main()
