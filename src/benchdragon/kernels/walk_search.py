"""A whole search along a walk in one call: prepared stride by stride, searched step by step.

For dragons whose handles keep to the route. A call ends when something is found, when the walk is clear
to its end, when arrays are too small, or to let others work: it is then called again.
"""

from benchdragon.kernels import time_of_impact as steps
from benchdragon.kernels.arrays import Vector
from benchdragon.kernels.box_hierarchy import BoxCount
from benchdragon.kernels.candidate_pairs import LONG_STRIDE, SHORT_STRIDE, NextStep, next_step
from benchdragon.kernels.continuation import UNIT
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.question import QuestionEnding
from benchdragon.kernels.time_of_impact import Ending, Goal, Note
from benchdragon.kernels.workspace import Course, SearchProgress, Walk, WalkTally, Workspace


class WalkEnding(Ending):
    """Exit status of a call, besides MORE and those of kernels/time_of_impact.py.

    CLEAR is of the whole walk.
    """

    CROWDED = 9  # call again, with room for what its counts say
    ASTRAY = 10  # past SOUND not all benches are certified to follow


class WalkGoal(Goal):
    """Goals of a call, besides those of kernels/time_of_impact.py."""

    SEEK = 3


# Parts narrower than so many units in the last place of the head's position are not halved.
WIDTH_ROUNDINGS = 4.0
# Handles placed in one call: some hundredths of a second.
HANDLES_A_CALL = 200_000
# The cost of a call of a search, and of a handle of a chain that is searched, in handles placed; and
# that of a bench at a border of a cell, and of a pair of parts.
CALL, SEARCHED = 1_000, 8
BOX_WORK, PARTNER_WORK = 64.0, 16.0


@kernel
def work_done(room: Workspace, benches: int) -> float:
    """The work of boxing the route and of placing dragons so far, in handles placed."""
    counts = room.ground.counts
    known = BOX_WORK * counts[BoxCount.BORDERS] + PARTNER_WORK * counts[BoxCount.ENTRIES]
    return known + float(room.course.tally[WalkTally.CHAINS] * benches)


@kernel
def left_end_is_placed(search: steps.Search, course: SearchProgress, chain: steps.Chain) -> bool:
    """Box the members at the left end of the step, if the chain stands there from the step before."""
    start = course.way[Course.STEP_START]
    if course.tally[WalkTally.PLACED] < chain.links.shape[0] + 1 or search.at[0] != start:
        return False
    steps.box_slot(chain, search, 0)
    return True


@kernel
def search_open_step(
    walk: Walk, room: Workspace, goal: int, limits: steps.Limits, note: FloatArray
) -> int:
    """Search the rest of the current step; returns the exit status, or CROWDED."""
    search, course, meeting = room.search, room.course, room.meeting
    way, tally, count = course.way, course.tally, course.tally[WalkTally.PAIRS]
    first, second = meeting.first[:count], meeting.second[:count]
    mine, other, members = meeting.mine[:count], meeting.other[:count], meeting.members
    found = steps.number_members(first, second, members, meeting.place, mine, other)
    handles, start = members[found - 1] + 2, way[Course.STEP_START]
    # As many as in the step before, if not far more: then the left end need not be placed again.
    if search.at[0] == start and handles <= tally[WalkTally.PLACED] <= 2 * handles:
        handles = tally[WalkTally.PLACED]
    if (
        handles > search.handles.shape[0]
        or found > search.sweeps.shape[0]
        or count > search.alive.shape[1]
    ):
        tally[WalkTally.PLACED] = 0
        return WalkEnding.CROWDED
    benches, aside, links = walk.benches, note[:0], walk.benches.links[: handles - 1]
    seams, still = room.ground.seams, search.boxes[:0]
    chain = steps.Chain(walk.rows, links, aside, benches.sizes, members[:found], still, seams)
    ready = 1 if left_end_is_placed(search, course, chain) else 0
    top = steps.open_step(search, count, start, way[Course.STEP_END])
    before, note[Note.PAIR] = note[Note.PAIR], -1.0
    ending = steps.bisect(search, goal, chain, steps.Pairs(mine, other), top, ready, limits, note)
    tally[WalkTally.PLACED] = handles
    p = int(note[Note.PAIR])
    note[Note.PAIR] = before if p < 0 else float(first[p] * benches.kind.shape[0] + second[p])
    way[Course.STEP_START] = way[Course.STEP_END] if ending == Ending.CLEAR else note[Note.UPPER]
    return ending


@entry
def search_walk(
    walk: Walk, room: Workspace, goal: int, margin: float, slack: float, width: float, most: int,
    note: Vector,
) -> int:  # fmt: skip
    """Search a walk on from where its course stands, for `goal`; returns the exit status.

    After FOUND or GRAZE the step goes on at note[UPPER]. note[PAIR] becomes the first bench times their
    number plus the second, from 0; the rest of `note` is that of `time_of_impact.bisect`. For SEEK each
    step is FOUND in which pairs may come within reach.
    """
    way, tally, spent = room.course.way, room.course.tally, note[Note.EVALUATIONS]
    while True:
        while (
            goal != WalkGoal.SEEK
            and way[Course.STEP_START] < way[Course.STEP_END]
            and tally[WalkTally.PAIRS]
        ):
            placed = (note[Note.EVALUATIONS] - spent) * tally[WalkTally.PLACED]
            if placed >= HANDLES_A_CALL:
                return QuestionEnding.MORE
            narrow = max(width, WIDTH_ROUNDINGS * UNIT * way[Course.STEP_END])
            limits = steps.Limits(margin, slack, narrow, most)
            ending = search_open_step(walk, room, goal, limits, note)
            if ending != Ending.CLEAR:
                return ending
        ending = next_step(walk, room, SHORT_STRIDE if goal == Goal.FIRST_TOUCH else LONG_STRIDE)
        if ending == NextStep.DONE:
            return Ending.CLEAR
        if ending != NextStep.STEP:
            return (
                QuestionEnding.MORE
                if ending == NextStep.WAIT
                else WalkEnding.CROWDED
                if ending == NextStep.NARROW
                else WalkEnding.ASTRAY
            )
        if goal == WalkGoal.SEEK:
            return Ending.FOUND
