"""Whether benches keep from what stands on the square, in the walk of a size that is tried."""

import math

from benchdragon.kernels import obstacle_memory as of
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.memory import group_at
from benchdragon.kernels.obstacle_memory import Beside, begin_beside
from benchdragon.kernels.obstacle_paths import stands
from benchdragon.kernels.obstacle_search import ALL_TOLD, seek_beside, step_beside
from benchdragon.kernels.question import MORE, OUT_OF_MEMORY, SPENT
from benchdragon.kernels.rounding import find_seams
from benchdragon.kernels.rounds import find_repeats
from benchdragon.kernels.size_bracket import FAILS, NOW, UNDECIDED
from benchdragon.kernels.size_memory import (
    AT_THING,
    BASE,
    BEGUN,
    BESIDE_SLOT,
    BLOCKED,
    BLOCKED_BY,
    BROKEN,
    CORNERS,
    DOING,
    FIRST,
    KEPT_OFF,
    KNOWN,
    LAST,
    LEAST_OFF,
    MARCHED,
    MOST,
    OFF,
    RADIUS,
    SORT,
    SURELY,
    UNSURE,
    WIDTH,
    Sought,
)
from benchdragon.kernels.time_of_impact import FIRST_TOUCH
from benchdragon.kernels.walk_search import ASTRAY, HANDLES_A_CALL

# How a walk stands that is to be searched on.
GOES_ON = -2


@kernel
def begin_square(sought: Sought) -> None:
    """Begin to look at obstacles, the first of them next: where the route of NOW leads back."""
    walk, figures, reach = sought.walk, sought.figures, 0.0
    figures[AT_THING] = figures[BEGUN] = figures[UNSURE] = figures[KNOWN] = 0.0
    if sought.repeats.shape[0]:
        for i in range(walk.benches.links.shape[0]):
            reach = max(reach, math.hypot(walk.benches.sizes[0, i], walk.benches.sizes[1, i]))
        find_seams(walk.rows, sought.seams)
        figures[KNOWN] = find_repeats(walk.rows, sought.seams, reach, sought.repeats)


@kernel
def begin_thing(block: int) -> bool:
    """Begin to look at the obstacle at hand; whether there is memory."""
    sought = group_at(Sought, block + BASE)
    figures, limits, asked, walk = sought.figures, sought.limits, sought.asked, sought.walk
    n, things, corner = int(figures[AT_THING]), sought.square.things, 0
    for m in range(n):
        corner += int(things[m, CORNERS])
    outline = sought.square.outlines[corner : corner + int(things[n, CORNERS])]
    asked[of.SORT], asked[of.RADIUS], asked[of.MARGIN] = (
        things[n, SORT], things[n, RADIUS], things[n, KEPT_OFF]
    )  # fmt: skip
    asked[of.HEAD_FIRST], asked[of.HEAD_LAST] = figures[FIRST], figures[LAST]
    asked[of.LEAST_OFF], asked[of.WIDTH] = limits[LEAST_OFF] + things[n, OFF], limits[WIDTH]
    asked[of.MOST] = limits[MOST]
    benches, repeats = walk.benches, sought.repeats[: int(figures[KNOWN])]
    return begin_beside(
        block, BESIDE_SLOT, walk.rows, benches.links, benches.sizes, outline, repeats, asked
    )


@kernel
def stepped(block: int, left: float) -> int:
    """How a step of the search beside the obstacle at hand ended."""
    figures = group_at(Sought, block + BASE).figures
    if figures[BEGUN] == 0.0:
        if not begin_thing(block):
            return OUT_OF_MEMORY
        figures[BEGUN] = 1.0
        beside = group_at(Beside, block + 8 * BESIDE_SLOT)
        if not stands(beside):
            return ASTRAY
        seek_beside(beside, FIRST_TOUCH, 0.0)
    own = group_at(Beside, block + 8 * BESIDE_SLOT).figures
    own[SPENT] = 0.0
    ending = step_beside(block, BESIDE_SLOT, left - figures[SPENT])
    figures[SPENT] += own[SPENT]
    return ending


@kernel
def looked_beside(block: int, left: float) -> int:
    """GOES_ON once no bench comes near an obstacle in the walk of NOW, FAILS where one does; or MORE.

    Or UNDECIDED where there is no memory. What cannot be told is UNSURE: then no such walk passes.
    """
    sought = group_at(Sought, block + BASE)
    figures = sought.figures
    while figures[AT_THING] < sought.square.things.shape[0]:
        if figures[SPENT] > min(left, HANDLES_A_CALL):
            return MORE
        ending = stepped(block, left)
        if ending == MORE:
            continue
        if ending == OUT_OF_MEMORY:
            figures[DOING] = BROKEN
            return UNDECIDED
        beside = group_at(Beside, block + 8 * BESIDE_SLOT)
        figures[MARCHED] += beside.figures[of.MADE]
        figures[BEGUN], count = 0.0, int(beside.figures[of.COUNT])
        if ending == ALL_TOLD and count:
            figures[BLOCKED], figures[BLOCKED_BY] = sought.state[NOW], figures[AT_THING]
            figures[SURELY] = beside.found[count - 1, of.SURE]
            return FAILS
        figures[UNSURE] = figures[UNSURE] if ending == ALL_TOLD else 1.0
        figures[AT_THING] += 1.0
    return GOES_ON
