"""Whether benches keep clear of obstacles and of the venue's edge, in the walk of a size on trial."""

import math

from benchdragon.kernels.entries import kernel
from benchdragon.kernels.memory import group_at
from benchdragon.kernels.obstacle_memory import (
    Beside,
    ObstacleFound,
    ObstacleGiven,
    ObstacleTold,
    begin_beside,
)
from benchdragon.kernels.obstacle_paths import stands
from benchdragon.kernels.obstacle_search import ObstacleEnding, seek_beside, step_beside
from benchdragon.kernels.question import QuestionEnding, Told
from benchdragon.kernels.rounding import find_seams
from benchdragon.kernels.rounds import find_repeats
from benchdragon.kernels.size_bracket import Bracket, SizeVerdict
from benchdragon.kernels.size_memory import (
    BASE,
    BESIDE_SLOT,
    SizeGiven,
    SizeStage,
    SizeTold,
    Sought,
    Thing,
)
from benchdragon.kernels.time_of_impact import Goal
from benchdragon.kernels.walk_search import HANDLES_A_CALL, WalkEnding

# No verdict on a walk yet: it is to be searched on.
GOES_ON = -2


@kernel
def begin_square(sought: Sought) -> None:
    """Begin with the first obstacle, and find where the route of NOW leads back."""
    walk, figures, reach = sought.walk, sought.figures, 0.0
    figures[SizeTold.AT_THING] = figures[SizeTold.BEGUN] = figures[SizeTold.UNSURE] = figures[
        SizeTold.KNOWN
    ] = 0.0
    if sought.repeats.shape[0]:
        for i in range(walk.benches.links.shape[0]):
            reach = max(reach, math.hypot(walk.benches.sizes[0, i], walk.benches.sizes[1, i]))
        find_seams(walk.rows, sought.seams)
        figures[SizeTold.KNOWN] = find_repeats(walk.rows, sought.seams, reach, sought.repeats)


@kernel
def begin_thing(block: int) -> bool:
    """Begin the search beside the current obstacle; False without memory."""
    sought = group_at(Sought, block + BASE)
    figures, limits, asked, walk = sought.figures, sought.limits, sought.asked, sought.walk
    n, things, corner = int(figures[SizeTold.AT_THING]), sought.square.things, 0
    for m in range(n):
        corner += int(things[m, Thing.CORNERS])
    outline = sought.square.outlines[corner : corner + int(things[n, Thing.CORNERS])]
    asked[ObstacleGiven.SORT], asked[ObstacleGiven.RADIUS], asked[ObstacleGiven.MARGIN] = (
        things[n, Thing.SORT], things[n, Thing.RADIUS], things[n, Thing.KEPT_OFF]
    )  # fmt: skip
    asked[ObstacleGiven.HEAD_FIRST] = figures[SizeTold.FIRST]
    asked[ObstacleGiven.HEAD_LAST] = figures[SizeTold.LAST]
    asked[ObstacleGiven.LEAST_OFF] = limits[SizeGiven.LEAST_OFF] + things[n, Thing.OFF]
    asked[ObstacleGiven.WIDTH] = limits[SizeGiven.WIDTH]
    asked[ObstacleGiven.MOST] = limits[SizeGiven.MOST]
    benches, repeats = walk.benches, sought.repeats[: int(figures[SizeTold.KNOWN])]
    return begin_beside(
        block, BESIDE_SLOT, walk.rows, benches.links, benches.sizes, outline, repeats, asked
    )


@kernel
def stepped(block: int, left: float) -> int:
    """Step the search beside the current obstacle; returns its exit status."""
    figures = group_at(Sought, block + BASE).figures
    if figures[SizeTold.BEGUN] == 0.0:
        if not begin_thing(block):
            return QuestionEnding.OUT_OF_MEMORY
        figures[SizeTold.BEGUN] = 1.0
        beside = group_at(Beside, block + 8 * BESIDE_SLOT)
        if not stands(beside):
            return WalkEnding.ASTRAY
        seek_beside(beside, Goal.FIRST_TOUCH, 0.0)
    own = group_at(Beside, block + 8 * BESIDE_SLOT).figures
    own[Told.SPENT] = 0.0
    ending = step_beside(block, BESIDE_SLOT, left - figures[Told.SPENT])
    figures[Told.SPENT] += own[Told.SPENT]
    return ending


@kernel
def looked_beside(block: int, left: float) -> int:
    """GOES_ON once no bench comes near an obstacle in the walk of NOW, FAILS where one does; or MORE.

    Or UNDECIDED without memory. An obstacle that is undecided sets UNSURE: then no such walk passes.
    """
    sought = group_at(Sought, block + BASE)
    figures = sought.figures
    while figures[SizeTold.AT_THING] < sought.square.things.shape[0]:
        if figures[Told.SPENT] > min(left, HANDLES_A_CALL):
            return QuestionEnding.MORE
        ending = stepped(block, left)
        if ending == QuestionEnding.MORE:
            continue
        if ending == QuestionEnding.OUT_OF_MEMORY:
            figures[SizeTold.DOING] = SizeStage.BROKEN
            return SizeVerdict.UNDECIDED
        beside = group_at(Beside, block + 8 * BESIDE_SLOT)
        figures[SizeTold.MARCHED] += beside.figures[ObstacleTold.MADE]
        figures[SizeTold.BEGUN], count = 0.0, int(beside.figures[ObstacleTold.COUNT])
        if ending == ObstacleEnding.ALL_TOLD and count:
            figures[SizeTold.BLOCKED], figures[SizeTold.BLOCKED_BY] = (
                sought.state[Bracket.NOW],
                figures[SizeTold.AT_THING],
            )
            figures[SizeTold.SURELY] = beside.found[count - 1, ObstacleFound.SURE]
            return SizeVerdict.FAILS
        figures[SizeTold.UNSURE] = (
            figures[SizeTold.UNSURE] if ending == ObstacleEnding.ALL_TOLD else 1.0
        )
        figures[SizeTold.AT_THING] += 1.0
    return GOES_ON
