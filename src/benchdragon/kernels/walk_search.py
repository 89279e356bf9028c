"""A whole search along a walk in one call: prepared stride by stride, searched step by step.

For dragons whose handles keep to the route. A call ends when something is found, when the walk is
clear to its end, when more room is wanted, or to let others work: it is then called again.
"""

from benchdragon.kernels import time_of_impact as steps
from benchdragon.kernels.arrays import Vector
from benchdragon.kernels.box_hierarchy import BORDERS, ENTRIES
from benchdragon.kernels.candidate_pairs import (
    DONE,
    LONG_STRIDE,
    NARROW,
    SHORT_STRIDE,
    STEP,
    WAIT,
    next_step,
)
from benchdragon.kernels.continuation import UNIT
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.question import MORE
from benchdragon.kernels.workspace import (
    CHAINS,
    PAIRS,
    PLACED,
    STEP_END,
    STEP_START,
    SearchProgress,
    Walk,
    Workspace,
)

# How a call ended, besides MORE and the ways of kernels/time_of_impact.py. CLEAR is of the whole walk.
CROWDED = 9  # likewise, with the room that its counts say
ASTRAY = 10  # it cannot be shown that all benches follow past SOUND
# What a call may be after, besides the goals of kernels/time_of_impact.py.
SEEK = 3
# Parts narrower than so many units in the last place of the head's position are not halved.
WIDTH_ROUNDINGS = 4.0
# Handles placed in one call: some hundredths of a second.
HANDLES_A_CALL = 200_000
# What a call of a search costs, and a handle of a chain that is searched, in handles placed; and what
# a bench at a border of a cell does, and a pair of parts.
CALL, SEARCHED = 1_000, 8
BOX_WORK, PARTNER_WORK = 64.0, 16.0


@kernel
def work_done(room: Workspace, benches: int) -> float:
    """What it took to come to know the route and to place dragons so far, in handles placed."""
    counts = room.ground.counts
    known = BOX_WORK * counts[BORDERS] + PARTNER_WORK * counts[ENTRIES]
    return known + float(room.course.tally[CHAINS] * benches)


@kernel
def left_end_is_placed(search: steps.Search, course: SearchProgress, chain: steps.Chain) -> bool:
    """Box the members at the left end of the step, if the chain stands there from the step before."""
    start = course.way[STEP_START]
    if course.tally[PLACED] < chain.links.shape[0] + 1 or search.at[0] != start:
        return False
    steps.box_slot(chain, search, 0)
    return True


@kernel
def search_open_step(
    walk: Walk, room: Workspace, goal: int, limits: steps.Limits, note: FloatArray
) -> int:
    """Search the rest of the step at hand; how that ended, or CROWDED."""
    search, course, meeting = room.search, room.course, room.meeting
    way, tally, count = course.way, course.tally, course.tally[PAIRS]
    first, second = meeting.first[:count], meeting.second[:count]
    mine, other, members = meeting.mine[:count], meeting.other[:count], meeting.members
    found = steps.number_members(first, second, members, meeting.place, mine, other)
    handles, start = members[found - 1] + 2, way[STEP_START]
    # As many as in the step before, if not far more: then the left end need not be placed anew.
    if search.at[0] == start and handles <= tally[PLACED] <= 2 * handles:
        handles = tally[PLACED]
    if (
        handles > search.handles.shape[0]
        or found > search.sweeps.shape[0]
        or count > search.alive.shape[1]
    ):
        tally[PLACED] = 0
        return CROWDED
    benches, aside, links = walk.benches, note[:0], walk.benches.links[: handles - 1]
    seams, still = room.ground.seams, search.boxes[:0]
    chain = steps.Chain(walk.rows, links, aside, benches.sizes, members[:found], still, seams)
    ready = 1 if left_end_is_placed(search, course, chain) else 0
    top = steps.open_step(search, count, start, way[STEP_END])
    before, note[steps.PAIR] = note[steps.PAIR], -1.0
    ending = steps.bisect(search, goal, chain, steps.Pairs(mine, other), top, ready, limits, note)
    tally[PLACED] = handles
    p = int(note[steps.PAIR])
    note[steps.PAIR] = before if p < 0 else float(first[p] * benches.kind.shape[0] + second[p])
    way[STEP_START] = way[STEP_END] if ending == steps.CLEAR else note[steps.UPPER]
    return ending


@entry
def search_walk(
    walk: Walk, room: Workspace, goal: int, margin: float, slack: float, width: float, most: int,
    note: Vector,
) -> int:  # fmt: skip
    """Search a walk on from where its course stands, for `goal`; how that ended.

    After FOUND or GRAZE the step goes on at note[UPPER]. note[PAIR] becomes the first bench times
    their number plus the second, from 0; the rest of `note` is that of `search.bisect`. For SEEK each
    step is FOUND in which pairs may come within reach.
    """
    way, tally, spent = room.course.way, room.course.tally, note[steps.EVALUATIONS]
    while True:
        while goal != SEEK and way[STEP_START] < way[STEP_END] and tally[PAIRS]:
            placed = (note[steps.EVALUATIONS] - spent) * tally[PLACED]
            if placed >= HANDLES_A_CALL:
                return MORE
            narrow = max(width, WIDTH_ROUNDINGS * UNIT * way[STEP_END])
            limits = steps.Limits(margin, slack, narrow, most)
            ending = search_open_step(walk, room, goal, limits, note)
            if ending != steps.CLEAR:
                return ending
        ending = next_step(walk, room, SHORT_STRIDE if goal == steps.FIRST_TOUCH else LONG_STRIDE)
        if ending == DONE:
            return steps.CLEAR
        if ending != STEP:
            return MORE if ending == WAIT else CROWDED if ending == NARROW else ASTRAY
        if goal == SEEK:
            return steps.FOUND
