"""A search beside an obstacle: the touches of benches, and their least distance from it."""

import math

from benchdragon.kernels import time_of_impact as steps
from benchdragon.kernels.arrays import Vector
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.memory import clear, copy_row, group_at
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.obstacle_contact import look_along, search_span
from benchdragon.kernels.obstacle_memory import (
    Beside,
    ObstacleFound,
    ObstacleGiven,
    ObstacleTold,
    widen_found,
)
from benchdragon.kernels.obstacle_paths import next_span, rewind
from benchdragon.kernels.obstacle_result import head_between, last_handle, put, show
from benchdragon.kernels.question import QuestionEnding, Told
from benchdragon.kernels.swept_boxes import MOST_OFF
from benchdragon.kernels.time_of_impact import Ending, Goal, Note
from benchdragon.kernels.walk_search import HANDLES_A_CALL, WalkEnding


class ObstacleEnding(Numbered):
    """Exit status of a search, besides those of kernels/question.py and ASTRAY."""

    ALL_TOLD = 0
    TOO_OFTEN = 30
    TOO_FAR_OFF = 31


# The cost of a bench beside a box of an obstacle, in handles placed.
BESIDE_WORK = 16
# Grazes of one bench that are passed over in search of a touch; along a wall there is one each STRETCH.
MOST_GRAZES = 1_000


@kernel
def searched(beside: Beside, goal: int, slack: float, most: float) -> int:
    """Search the rest of the current span; returns the exit status."""
    figures, asked, note = beside.figures, beside.asked, beside.note
    before, reach = note[Note.EVALUATIONS], asked[ObstacleGiven.MARGIN] + asked[ObstacleGiven.RADIUS]
    limits = steps.Limits(reach, slack, asked[ObstacleGiven.WIDTH], int(most))
    bench, standing, search, start, end = (
        beside.bench, beside.standing, beside.search, figures[ObstacleTold.FROM],
        figures[ObstacleTold.TO]
    )  # fmt: skip
    ending = search_span(bench, standing, search, goal, start, end, limits, note)
    made = note[Note.EVALUATIONS] - before
    figures[ObstacleTold.MADE] += made
    figures[Told.SPENT] += BESIDE_WORK * (made + 1.0) * beside.standing.boxes.shape[0]
    figures[ObstacleTold.SOUND] = note[Note.LOWER]
    if ending in (WalkEnding.ASTRAY, Ending.FALLEN):
        return WalkEnding.ASTRAY
    return ending if known_off(figures, note[Note.OFF]) else ObstacleEnding.TOO_FAR_OFF


@kernel
def known_off(figures: Vector, off: float) -> bool:
    """Record the error bound of a distance that decides, m; False if a search does not allow for it."""
    figures[ObstacleTold.ABOUT] = max(figures[ObstacleTold.ABOUT], off)
    return off <= max(figures[ObstacleTold.SOUGHT_OFF], MOST_OFF)


@kernel
def seek_beside(beside: Beside, goal: int, narrow: float) -> None:
    """Seek, from the next step on, FIRST_TOUCH, or LEAST within a bracket so narrow, m."""
    figures, note = beside.figures, beside.note
    figures[ObstacleTold.GOAL] = goal
    figures[ObstacleTold.NARROW] = narrow
    figures[ObstacleTold.SOONEST] = math.inf
    figures[ObstacleTold.COUNT] = figures[ObstacleTold.TOLD_ROWS] = 0.0
    figures[ObstacleTold.BEGINS] = 1.0
    rewind(beside)
    clear(note)
    if goal == Goal.LEAST:
        note[Note.NEAREST] = figures[ObstacleTold.NEAR]
        while figures[ObstacleTold.APART] > beside.asked[ObstacleGiven.RADIUS] and next_span(beside):
            n = int(figures[ObstacleTold.SPAN])
            look_along(beside.bench, beside.standing, beside.search, beside.spans[n - 1 : n], note)
            keep_nearest(beside)
        rewind(beside)
        note[Note.FLOOR], note[Note.PAIR], figures[ObstacleTold.CLOSED_IN] = math.inf, -1.0, 1.0


@kernel
def keep_nearest(beside: Beside) -> None:
    """Record where the current bench was nearest, if it is nearer than any before."""
    figures, note = beside.figures, beside.note
    if note[Note.NEAREST] < figures[ObstacleTold.NEAR]:
        figures[ObstacleTold.NEAR], figures[ObstacleTold.NEAR_AT] = note[Note.NEAREST], note[Note.UPPER]
        figures[ObstacleTold.NEAR_BENCH] = figures[ObstacleTold.BENCH]


@kernel
def stands_touching(beside: Beside) -> bool:
    """Report a touch at the start, if the placement there decides; whether it does."""
    figures, asked = beside.figures, beside.asked
    reach = asked[ObstacleGiven.MARGIN] + asked[ObstacleGiven.RADIUS]
    off = figures[ObstacleTold.APART_OFF]
    head = asked[ObstacleGiven.HEAD_FIRST]
    sure = figures[ObstacleTold.APART] <= reach - off
    if not sure and (
        figures[ObstacleTold.APART] > reach + off or head < asked[ObstacleGiven.HEAD_LAST]
    ):
        return False
    put(beside, 0, head, head, figures[ObstacleTold.APART_BENCH], sure)
    figures[ObstacleTold.COUNT] = 1.0
    show(beside, 0)
    if sure:
        figures[ObstacleTold.ABOUT] = max(figures[ObstacleTold.ABOUT], off)
    return True


@kernel
def touched_on(block: int, slot: int, most: float) -> int:
    """Record touches and grazes, of each bench in its own spans; returns the step's exit status."""
    while True:
        beside = group_at(Beside, block + 8 * slot)
        figures, note = beside.figures, beside.note
        if figures[Told.SPENT] > most:
            return QuestionEnding.MORE
        if figures[ObstacleTold.GRAZES] == 0.0 and not next_span(beside):
            return settled(beside)
        clear(note)
        ending = searched(
            beside, Goal.FIRST_TOUCH, figures[ObstacleTold.SOUGHT_OFF], beside.asked[ObstacleGiven.MOST]
        )
        if ending in (WalkEnding.ASTRAY, ObstacleEnding.TOO_FAR_OFF):
            return ending
        if ending != Ending.CLEAR:
            take_down(beside, ending == Ending.FOUND)
        figures[ObstacleTold.FROM], figures[ObstacleTold.GRAZES] = (
            note[Note.UPPER],
            figures[ObstacleTold.GRAZES] + 1.0,
        )
        if ending != Ending.GRAZE or note[Note.UPPER] >= figures[ObstacleTold.TO]:
            figures[ObstacleTold.GRAZES] = 0.0
            tell_touches(beside)
        if figures[ObstacleTold.GRAZES] >= MOST_GRAZES:
            return ObstacleEnding.TOO_OFTEN
        if figures[ObstacleTold.COUNT] == beside.found.shape[0] and not widen_found(block, slot):
            return QuestionEnding.OUT_OF_MEMORY


@kernel
def take_down(beside: Beside, sure: bool) -> None:
    """Record a touch, or a graze. A graze that runs into a touch is its beginning."""
    figures = beside.figures
    note = beside.note
    found = beside.found
    n = int(beside.figures[ObstacleTold.COUNT])
    lower = note[Note.LOWER]
    if (
        figures[ObstacleTold.GRAZES] > 0.0
        and n > figures[ObstacleTold.TOLD_ROWS]
        and lower <= found[n - 1, ObstacleFound.HIGH_END]
    ):
        n, lower = n - 1, found[n - 1, ObstacleFound.LOW_END]
    put(beside, n, lower, note[Note.UPPER], figures[ObstacleTold.BENCH], sure)
    figures[ObstacleTold.COUNT] = n + 1


@kernel
def tell_touches(beside: Beside) -> None:
    """Convert what was recorded to head positions, except what comes after a sure touch."""
    figures, found, kept = beside.figures, beside.found, int(beside.figures[ObstacleTold.TOLD_ROWS])
    for n in range(kept, int(figures[ObstacleTold.COUNT])):
        bench, sure = int(found[n, ObstacleFound.WHO]), found[n, ObstacleFound.SURE] > 0.0
        if figures[ObstacleTold.SOONEST] < math.inf:
            there, _ratio = last_handle(beside, bench, figures[ObstacleTold.SOONEST])
            if found[n, ObstacleFound.LOW_END] > there + figures[ObstacleTold.ABOUT]:
                continue
        low, high = head_between(
            beside, bench, found[n, ObstacleFound.LOW_END], found[n, ObstacleFound.HIGH_END]
        )
        put(beside, kept, low, high, bench, sure)
        kept += 1
        if sure:
            figures[ObstacleTold.SOONEST] = min(figures[ObstacleTold.SOONEST], high)
    figures[ObstacleTold.TOLD_ROWS] = figures[ObstacleTold.COUNT] = kept


@kernel
def settled(beside: Beside) -> int:
    """Keep of all touches the soonest sure one, after grazes before it; fill in places: ALL_TOLD."""
    figures, found = beside.figures, beside.found
    clear_to, last, who, count = math.inf, math.inf, -1.0, 0
    for n in range(int(figures[ObstacleTold.COUNT])):
        if found[n, ObstacleFound.SURE] > 0.0:
            clear_to = min(clear_to, found[n, ObstacleFound.LOW_END])
            if found[n, ObstacleFound.HIGH_END] < last:
                last, who = found[n, ObstacleFound.HIGH_END], found[n, ObstacleFound.WHO]
    for n in range(int(figures[ObstacleTold.COUNT])):
        low = found[n, ObstacleFound.LOW_END]
        high = found[n, ObstacleFound.HIGH_END]
        bench = found[n, ObstacleFound.WHO]
        if found[n, ObstacleFound.SURE] > 0.0 or low >= clear_to:
            continue
        m = count
        while m > 0 and comes_before(low, high, bench, found[m - 1]):
            copy_row(found[m], found[m - 1])
            m -= 1
        put(beside, m, low, high, bench, False)
        count += 1
    if who >= 0.0:
        put(beside, count, clear_to, last, who, True)
        count += 1
    for n in range(count):
        show(beside, n)
    figures[ObstacleTold.COUNT] = count
    return ObstacleEnding.ALL_TOLD


@kernel
def comes_before(low: float, high: float, bench: float, row: Vector) -> bool:
    """Whether a graze is listed before that of a row."""
    if low != row[ObstacleFound.LOW_END]:
        return low < row[ObstacleFound.LOW_END]
    return (
        high < row[ObstacleFound.HIGH_END]
        if high != row[ObstacleFound.HIGH_END]
        else bench < row[ObstacleFound.WHO]
    )


@kernel
def lowered_on(beside: Beside, most: float) -> int:
    """Lower the least distance until none is nearer, up to NARROW and rounding; the exit status."""
    figures = beside.figures
    slack = (
        figures[ObstacleTold.NARROW]
        if figures[ObstacleTold.NARROW] > 0.0
        else figures[ObstacleTold.SOUGHT_OFF]
    )
    while figures[ObstacleTold.APART] > beside.asked[ObstacleGiven.RADIUS]:
        if figures[Told.SPENT] > most:
            return QuestionEnding.MORE
        if not next_span(beside):
            return tell_least(beside)
        ending = searched(beside, Goal.LEAST, slack, beside.asked[ObstacleGiven.MOST_LEAST])
        if ending in (WalkEnding.ASTRAY, ObstacleEnding.TOO_FAR_OFF):
            return ending
        keep_nearest(beside)
        if ending != Ending.CLEAR:
            figures[ObstacleTold.CLOSED_IN] = 0.0
        if ending == Ending.FOUND:  # no other bench of this size
            figures[ObstacleTold.BENCH], figures[ObstacleTold.SPAN] = (
                beside.links.shape[0] - 1,
                figures[ObstacleTold.SPANS],
            )
    return tell_least(beside)


@kernel
def tell_least(beside: Beside) -> int:
    """Report the least distance from the obstacle's edges, with the head's position; ALL_TOLD."""
    figures, row, bench = beside.figures, beside.found[0], int(beside.figures[ObstacleTold.NEAR_BENCH])
    near = figures[ObstacleTold.NEAR]
    radius = beside.asked[ObstacleGiven.RADIUS]
    head = beside.asked[ObstacleGiven.HEAD_FIRST]
    if not known_off(figures, figures[ObstacleTold.APART_OFF]):
        return ObstacleEnding.TOO_FAR_OFF
    if not math.isnan(figures[ObstacleTold.NEAR_AT]):
        _before, head = head_between(
            beside, bench, figures[ObstacleTold.NEAR_AT], figures[ObstacleTold.NEAR_AT]
        )
    off, gap = figures[ObstacleTold.ABOUT], near - radius
    floor = min(beside.note[Note.FLOOR], near - figures[ObstacleTold.NARROW])
    if near <= radius:
        figures[ObstacleTold.CLOSED_IN] = 1.0
    low = max(min(floor, near) - radius - off, 0.0)
    high = gap + off if gap > 0.0 else max(gap + math.sqrt(2.0) * off, 0.0)
    put(beside, 0, low, high, bench, True)
    row[ObstacleFound.VALUE] = max(gap, 0.0)
    row[ObstacleFound.HEAD] = head
    figures[ObstacleTold.COUNT] = 1.0
    show(beside, 0)
    return ObstacleEnding.ALL_TOLD


@kernel
def step_beside(block: int, slot: int, left: float) -> int:
    """Search for some hundredths of a second, or about `left` handles: ALL_TOLD, MORE, or a failure."""
    beside, most = group_at(Beside, block + 8 * slot), min(left, HANDLES_A_CALL)
    figures = beside.figures
    if figures[ObstacleTold.GOAL] == Goal.LEAST:
        return lowered_on(beside, most)
    if figures[ObstacleTold.BEGINS] > 0.0 and stands_touching(beside):
        return (
            ObstacleEnding.ALL_TOLD
            if known_off(figures, figures[ObstacleTold.ABOUT])
            else ObstacleEnding.TOO_FAR_OFF
        )
    figures[ObstacleTold.BEGINS] = 0.0
    return touched_on(block, slot, most)
