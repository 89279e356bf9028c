"""The least distance of any two benches along a walk, bracketed in passes as narrowly as possible.

A low distance is sampled first; then lower ones are searched for. Passes that narrow the bracket may
take a share of a question's work, counted apart, and are given up if they cost more.
"""

import math

from benchdragon.kernels import contact_memory as told
from benchdragon.kernels import contact_steps
from benchdragon.kernels.box_hierarchy import BoxMeasure
from benchdragon.kernels.contact_memory import (
    ContactEnding,
    ContactGiven,
    ContactGoal,
    ContactTold,
    Hunt,
)
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.local_minima import MOST_SAMPLED, low_pair
from benchdragon.kernels.memory import group_at
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.question import QuestionEnding, Told
from benchdragon.kernels.search_room import RoomEnding
from benchdragon.kernels.time_of_impact import Ending, Goal, Note
from benchdragon.kernels.walk_search import WalkGoal
from benchdragon.kernels.workspace import Course


class LeastStage(Numbered):
    """The stage that LEAST is in."""

    LOOKING, THROUGH, OPENING, PASSING = range(4)


# The pass of LEAST that only lowers the distance at the start.
LOWERING = -1
# For dragons that are not sampled, pairs are searched for within this distance, m, at first, and within
# so many times more until some pair comes nearer.
FIRST_REACH, FARTHER_ON = 0.003, 6.0


@kernel
def looked(hunt: Hunt) -> bool:
    """Sample a low distance, so that the search culls what is farther apart.

    False if the dragon cannot be placed at the start.
    """
    walk, f, limits = hunt.walk, hunt.figures, hunt.limits
    start, benches = limits[ContactGiven.BEGIN], walk.benches
    still = start == limits[ContactGiven.END]
    f[ContactTold.WHERE], f[ContactTold.BEST], f[ContactTold.FLOOR_AT] = start, math.inf, 0.0
    if still or benches.kind.shape[0] > MOST_SAMPLED:
        if not contact_steps.stands(hunt, start):
            return False
        f[ContactTold.BEST] = max(contact_steps.tightest(hunt), 0.0)
        f[ContactTold.FLOOR_AT] = f[ContactTold.BEST] if still else 0.0
        return True
    for n in range(hunt.spans.shape[0]):
        apart, s, i, j = low_pair(
            walk.rows, benches.links, benches.sizes, hunt.spans[n, 0], hunt.spans[n, 1], hunt.at,
            hunt.placed, hunt.boxes,
        )  # fmt: skip
        if apart < f[ContactTold.BEST]:
            f[ContactTold.BEST] = apart
            f[ContactTold.WHERE] = s
            f[ContactTold.FIRST_BENCH] = i
            f[ContactTold.SECOND_BENCH] = j
    f[ContactTold.BEST] = max(f[ContactTold.BEST], 0.0)
    return True


@kernel
def least_told(hunt: Hunt) -> int:
    """The exit status of a step that found the least distance."""
    f = hunt.figures
    if not contact_steps.is_sharp(hunt, contact_steps.off_at(hunt, f[ContactTold.WHERE])):
        return ContactEnding.BLURRED
    f[ContactTold.EARLY] = f[ContactTold.LATE] = f[ContactTold.WHERE]
    return contact_steps.pair_told(hunt, f[ContactTold.WHERE])


@kernel
def looked_over(hunt: Hunt) -> bool:
    """Whether low distances are sampled before the search."""
    return (
        hunt.walk.benches.kind.shape[0] <= MOST_SAMPLED
        or hunt.figures[ContactTold.GOAL] == ContactGoal.BETWEEN
    )


@kernel
def started(block: int) -> int:
    """Start from a sampled or known distance: ROOMY, or the step's exit status."""
    hunt = group_at(Hunt, block + told.BASE)
    f = hunt.figures
    f[ContactTold.STAGE] = LeastStage.OPENING
    if f[ContactTold.GOAL] == ContactGoal.BETWEEN:
        return RoomEnding.ROOMY
    if not looked(hunt):
        return ContactEnding.STOPPED
    if (
        f[ContactTold.GOAL] == ContactGoal.SEEN
        or hunt.limits[ContactGiven.BEGIN] == hunt.limits[ContactGiven.END]
    ):
        return least_told(hunt)
    f[ContactTold.REACH] = f[ContactTold.BEST] if looked_over(hunt) else FIRST_REACH
    if f[ContactTold.BEST] > 0.0:
        return RoomEnding.ROOMY
    f[ContactTold.STAGE] = LeastStage.THROUGH
    return contact_steps.begun(block, 0.0)


@kernel
def tolerance_of(hunt: Hunt) -> float:
    """The width that the bracket of the current pass may have, m."""
    n = int(hunt.figures[ContactTold.PASS])
    return hunt.tolerances[n] if 0 <= n < hunt.tolerances.shape[0] else math.inf


@kernel
def pass_begun(block: int, n: int) -> int:
    """Begin pass n of LEAST: ROOMY, or the step's exit status."""
    made = RoomEnding.ROOMY if n == LOWERING else contact_steps.begun_again(block)
    hunt = group_at(Hunt, block + told.BASE)
    f, note = hunt.figures, hunt.note
    f[ContactTold.PASS] = n
    f[ContactTold.ASIDE] = 0.0
    f[ContactTold.LEFT] = hunt.limits[ContactGiven.MOST_LEAST]
    f[ContactTold.AIMED] = (
        f[ContactTold.REACH] if n == LOWERING else min(f[ContactTold.REACH], f[ContactTold.BEST])
    )
    for k in range(note.shape[0]):
        note[k] = 0.0
    note[Note.NEAREST], note[Note.FLOOR] = f[ContactTold.AIMED], math.inf
    return made


@kernel
def lowered(hunt: Hunt, ending: int) -> bool:
    """Take over the result of a pass with this exit status; whether that closes the bracket."""
    f, note = hunt.figures, hunt.note
    if note[Note.NEAREST] < f[ContactTold.AIMED]:
        f[ContactTold.BEST], f[ContactTold.WHERE] = max(note[Note.NEAREST], 0.0), note[Note.UPPER]
        contact_steps.set_pair(hunt, note[Note.PAIR])
    f[ContactTold.FLOOR_AT] = max(min(note[Note.FLOOR], note[Note.NEAREST] - tolerance_of(hunt)), 0.0)
    return ending == Ending.CLEAR or f[ContactTold.BEST] == 0.0


@kernel
def passed_on(block: int, left: float) -> tuple[int, bool]:
    """Go on with the current pass: ROOMY at its end, or the step's status; and whether it was the last.

    A pass that costs too much is given up silently. The last pass, of any width, covers the whole walk.
    """
    hunt = group_at(Hunt, block + told.BASE)
    f, n, count = hunt.figures, int(hunt.figures[ContactTold.PASS]), hunt.tolerances.shape[0]
    share, counted, aside = left, Told.SPENT, 0 <= n < count
    if aside:
        share = hunt.limits[ContactGiven.REFINING_ON if n else ContactGiven.REFINING]
        counted = ContactTold.ASIDE
    ending = contact_steps.searched_on(block, Goal.LEAST, tolerance_of(hunt), share, counted)
    hunt = group_at(Hunt, block + told.BASE)
    f = hunt.figures
    if ending <= Ending.FALLEN:
        closed = lowered(hunt, ending)
        if n == count or (closed and n != LOWERING):
            return RoomEnding.ROOMY, True
    elif not (
        aside
        and (
            ending == QuestionEnding.OVER_MEMORY
            or (ending == QuestionEnding.MORE and f[ContactTold.ASIDE] > share)
        )
    ):
        return ending, False
    return pass_begun(block, n + 1), False


@kernel
def opened(block: int) -> int:
    """Begin the search for pairs within reach: ROOMY, or the step's exit status."""
    hunt = group_at(Hunt, block + told.BASE)
    f, made = hunt.figures, RoomEnding.ROOMY
    if f[ContactTold.GOAL] == ContactGoal.BETWEEN:
        if f[ContactTold.READY] == 0.0:
            made = contact_steps.begun(block, f[ContactTold.WITHIN])
        hunt = group_at(Hunt, block + told.BASE)
        f[ContactTold.REACH], f[ContactTold.BEGUN] = f[ContactTold.BEST], f[ContactTold.EARLY]
        hunt.room.course.way[Course.GOAL] = min(
            f[ContactTold.LATE], hunt.room.ground.measures[BoxMeasure.END]
        )
    else:
        f[ContactTold.REACH] = min(f[ContactTold.REACH], f[ContactTold.BEST], f[ContactTold.WITHIN])
        made = contact_steps.begun(block, f[ContactTold.REACH])
    f[ContactTold.STAGE] = LeastStage.PASSING
    first = 0 if looked_over(hunt) else LOWERING
    return pass_begun(block, first) if made == RoomEnding.ROOMY else made


@kernel
def walked_through(block: int, left: float) -> int:
    """Walk on after an overlap, to see that the dragon can; returns the step's exit status."""
    while True:
        ending = contact_steps.searched_on(block, WalkGoal.SEEK, 0.0, left, Told.SPENT)
        if ending != Ending.FOUND:
            return least_told(group_at(Hunt, block + told.BASE)) if ending == Ending.CLEAR else ending


@kernel
def round_over(hunt: Hunt) -> int:
    """The step's exit status once all within reach was searched; ROOMY if the reach has to grow."""
    f = hunt.figures
    if f[ContactTold.BEST] <= f[ContactTold.REACH] or f[ContactTold.GOAL] == ContactGoal.BETWEEN:
        return least_told(hunt)
    if f[ContactTold.REACH] >= f[ContactTold.WITHIN]:
        return ContactEnding.FARTHER
    f[ContactTold.REACH], f[ContactTold.STAGE] = f[ContactTold.REACH] * FARTHER_ON, LeastStage.OPENING
    return RoomEnding.ROOMY


@kernel
def least_on(block: int, left: float) -> int:
    """Search for the least distance; returns the step's exit status."""
    while True:
        hunt = group_at(Hunt, block + told.BASE)
        stage, last = hunt.figures[ContactTold.STAGE], False
        if stage == LeastStage.THROUGH:
            return walked_through(block, left)
        if stage == LeastStage.LOOKING:
            made = started(block)
        elif stage == LeastStage.OPENING:
            made = opened(block)
        else:
            made, last = passed_on(block, left)
        if last:
            made = round_over(group_at(Hunt, block + told.BASE))
        if made != RoomEnding.ROOMY:
            return made
