"""A search beside an obstacle: when benches touch it, and the least that they keep from it."""

import math

from benchdragon.kernels import obstacle_memory as of
from benchdragon.kernels import time_of_impact as steps
from benchdragon.kernels.arrays import Vector
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.memory import clear, copy_row, group_at
from benchdragon.kernels.obstacle_contact import look_along, search_span
from benchdragon.kernels.obstacle_memory import Beside, widen_found
from benchdragon.kernels.obstacle_paths import next_span, rewind
from benchdragon.kernels.obstacle_result import head_between, last_handle, put, show
from benchdragon.kernels.question import MORE, OUT_OF_MEMORY, SPENT
from benchdragon.kernels.swept_boxes import MOST_OFF
from benchdragon.kernels.walk_search import ASTRAY, HANDLES_A_CALL

# How a search ends, besides as kernels/question.py says, and ASTRAY.
ALL_TOLD, TOO_OFTEN, TOO_FAR_OFF = 0, 30, 31
# What a bench beside a box of an obstacle costs, in handles placed.
BESIDE = 16
# Grazes of one bench that are passed over to see whether it touches; along a wall one each STRETCH.
MOST_GRAZES = 1_000


@kernel
def searched(beside: Beside, goal: int, slack: float, most: float) -> int:
    """How the search of what is left of the span at hand ended."""
    figures, asked, note = beside.figures, beside.asked, beside.note
    before, reach = note[steps.EVALUATIONS], asked[of.MARGIN] + asked[of.RADIUS]
    limits = steps.Limits(reach, slack, asked[of.WIDTH], int(most))
    bench, standing, search, start, end = (
        beside.bench, beside.standing, beside.search, figures[of.FROM], figures[of.TO]
    )  # fmt: skip
    ending = search_span(bench, standing, search, goal, start, end, limits, note)
    made = note[steps.EVALUATIONS] - before
    figures[of.MADE] += made
    figures[SPENT] += BESIDE * (made + 1.0) * beside.standing.boxes.shape[0]
    figures[of.SOUND] = note[steps.LOWER]
    if ending in (ASTRAY, steps.FALLEN):
        return ASTRAY
    return ending if known_off(figures, note[steps.OFF]) else TOO_FAR_OFF


@kernel
def known_off(figures: Vector, off: float) -> bool:
    """Take note of what a distance that matters may be off by, m; False if not all is seen then."""
    figures[of.ABOUT] = max(figures[of.ABOUT], off)
    return off <= max(figures[of.SOUGHT_OFF], MOST_OFF)


@kernel
def seek_beside(beside: Beside, goal: int, narrow: float) -> None:
    """Seek, from the next step on, FIRST_TOUCH, or LEAST within a bracket so narrow, m."""
    figures, note = beside.figures, beside.note
    figures[of.GOAL], figures[of.NARROW], figures[of.SOONEST] = goal, narrow, math.inf
    figures[of.COUNT] = figures[of.TOLD_ROWS] = 0.0
    figures[of.BEGINS] = 1.0
    rewind(beside)
    clear(note)
    if goal == steps.LEAST:
        note[steps.NEAREST] = figures[of.NEAR]
        while figures[of.APART] > beside.asked[of.RADIUS] and next_span(beside):
            n = int(figures[of.SPAN])
            look_along(beside.bench, beside.standing, beside.search, beside.spans[n - 1 : n], note)
            keep_nearest(beside)
        rewind(beside)
        note[steps.FLOOR], note[steps.PAIR], figures[of.CLOSED_IN] = math.inf, -1.0, 1.0


@kernel
def keep_nearest(beside: Beside) -> None:
    """Take note of where the bench at hand was seen, if that is nearer than any was."""
    figures, note = beside.figures, beside.note
    if note[steps.NEAREST] < figures[of.NEAR]:
        figures[of.NEAR], figures[of.NEAR_AT] = note[steps.NEAREST], note[steps.UPPER]
        figures[of.NEAR_BENCH] = figures[of.BENCH]


@kernel
def stands_touching(beside: Beside) -> bool:
    """Tell of the start, if how benches stand there decides when one touches; whether it does."""
    figures, asked = beside.figures, beside.asked
    reach, off, head = asked[of.MARGIN] + asked[of.RADIUS], figures[of.APART_OFF], asked[of.HEAD_FIRST]
    sure = figures[of.APART] <= reach - off
    if not sure and (figures[of.APART] > reach + off or head < asked[of.HEAD_LAST]):
        return False
    put(beside, 0, head, head, figures[of.APART_BENCH], sure)
    figures[of.COUNT] = 1.0
    show(beside, 0)
    if sure:
        figures[of.ABOUT] = max(figures[of.ABOUT], off)
    return True


@kernel
def touched_on(block: int, slot: int, most: float) -> int:
    """Take down where benches come nearer than they may, each in its own span, and where they graze."""
    while True:
        beside = group_at(Beside, block + 8 * slot)
        figures, note = beside.figures, beside.note
        if figures[SPENT] > most:
            return MORE
        if figures[of.GRAZES] == 0.0 and not next_span(beside):
            return settled(beside)
        clear(note)
        ending = searched(beside, steps.FIRST_TOUCH, figures[of.SOUGHT_OFF], beside.asked[of.MOST])
        if ending in (ASTRAY, TOO_FAR_OFF):
            return ending
        if ending != steps.CLEAR:
            take_down(beside, ending == steps.FOUND)
        figures[of.FROM], figures[of.GRAZES] = note[steps.UPPER], figures[of.GRAZES] + 1.0
        if ending != steps.GRAZE or note[steps.UPPER] >= figures[of.TO]:
            figures[of.GRAZES] = 0.0
            tell_touches(beside)
        if figures[of.GRAZES] >= MOST_GRAZES:
            return TOO_OFTEN
        if figures[of.COUNT] == beside.found.shape[0] and not widen_found(block, slot):
            return OUT_OF_MEMORY


@kernel
def take_down(beside: Beside, sure: bool) -> None:
    """Take down a touch, or a graze. A graze that runs into a touch is its beginning."""
    figures, note, found, n = beside.figures, beside.note, beside.found, int(beside.figures[of.COUNT])
    lower = note[steps.LOWER]
    if figures[of.GRAZES] > 0.0 and n > figures[of.TOLD_ROWS] and lower <= found[n - 1, of.HIGH_END]:
        n, lower = n - 1, found[n - 1, of.LOW_END]
    put(beside, n, lower, note[steps.UPPER], figures[of.BENCH], sure)
    figures[of.COUNT] = n + 1


@kernel
def tell_touches(beside: Beside) -> None:
    """Tell of the head what was taken down, but for what comes after a sure touch."""
    figures, found, kept = beside.figures, beside.found, int(beside.figures[of.TOLD_ROWS])
    for n in range(kept, int(figures[of.COUNT])):
        bench, sure = int(found[n, of.WHO]), found[n, of.SURE] > 0.0
        if figures[of.SOONEST] < math.inf:
            there, _ratio = last_handle(beside, bench, figures[of.SOONEST])
            if found[n, of.LOW_END] > there + figures[of.ABOUT]:
                continue
        low, high = head_between(beside, bench, found[n, of.LOW_END], found[n, of.HIGH_END])
        put(beside, kept, low, high, bench, sure)
        kept += 1
        if sure:
            figures[of.SOONEST] = min(figures[of.SOONEST], high)
    figures[of.TOLD_ROWS] = figures[of.COUNT] = kept


@kernel
def settled(beside: Beside) -> int:
    """Leave of all touches the soonest sure one, after the grazes before it; show them: ALL_TOLD."""
    figures, found = beside.figures, beside.found
    clear_to, last, who, count = math.inf, math.inf, -1.0, 0
    for n in range(int(figures[of.COUNT])):
        if found[n, of.SURE] > 0.0:
            clear_to = min(clear_to, found[n, of.LOW_END])
            if found[n, of.HIGH_END] < last:
                last, who = found[n, of.HIGH_END], found[n, of.WHO]
    for n in range(int(figures[of.COUNT])):
        low, high, bench = found[n, of.LOW_END], found[n, of.HIGH_END], found[n, of.WHO]
        if found[n, of.SURE] > 0.0 or low >= clear_to:
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
    figures[of.COUNT] = count
    return ALL_TOLD


@kernel
def comes_before(low: float, high: float, bench: float, row: Vector) -> bool:
    """Whether a graze is told before that of a row."""
    if low != row[of.LOW_END]:
        return low < row[of.LOW_END]
    return high < row[of.HIGH_END] if high != row[of.HIGH_END] else bench < row[of.WHO]


@kernel
def lowered_on(beside: Beside, most: float) -> int:
    """Lower the least distance seen until nothing is nearer, but for NARROW and what cannot be told."""
    figures = beside.figures
    slack = figures[of.NARROW] if figures[of.NARROW] > 0.0 else figures[of.SOUGHT_OFF]
    while figures[of.APART] > beside.asked[of.RADIUS]:
        if figures[SPENT] > most:
            return MORE
        if not next_span(beside):
            return tell_least(beside)
        ending = searched(beside, steps.LEAST, slack, beside.asked[of.MOST_LEAST])
        if ending in (ASTRAY, TOO_FAR_OFF):
            return ending
        keep_nearest(beside)
        if ending != steps.CLEAR:
            figures[of.CLOSED_IN] = 0.0
        if ending == steps.FOUND:  # no other bench of this size
            figures[of.BENCH], figures[of.SPAN] = beside.links.shape[0] - 1, figures[of.SPANS]
    return tell_least(beside)


@kernel
def tell_least(beside: Beside) -> int:
    """Tell the least distance: from the edges of what stands still, and of the head."""
    figures, row, bench = beside.figures, beside.found[0], int(beside.figures[of.NEAR_BENCH])
    near, radius, head = figures[of.NEAR], beside.asked[of.RADIUS], beside.asked[of.HEAD_FIRST]
    if not known_off(figures, figures[of.APART_OFF]):
        return TOO_FAR_OFF
    if not math.isnan(figures[of.NEAR_AT]):
        _before, head = head_between(beside, bench, figures[of.NEAR_AT], figures[of.NEAR_AT])
    off, gap = figures[of.ABOUT], near - radius
    floor = min(beside.note[steps.FLOOR], near - figures[of.NARROW])
    if near <= radius:
        figures[of.CLOSED_IN] = 1.0
    low = max(min(floor, near) - radius - off, 0.0)
    high = gap + off if gap > 0.0 else max(gap + math.sqrt(2.0) * off, 0.0)
    put(beside, 0, low, high, bench, True)
    row[of.VALUE], row[of.HEAD], figures[of.COUNT] = max(gap, 0.0), head, 1.0
    show(beside, 0)
    return ALL_TOLD


@kernel
def step_beside(block: int, slot: int, left: float) -> int:
    """Go on for some hundredths of a second, or so many handles: ALL_TOLD, MORE, or how it ended."""
    beside, most = group_at(Beside, block + 8 * slot), min(left, HANDLES_A_CALL)
    figures = beside.figures
    if figures[of.GOAL] == steps.LEAST:
        return lowered_on(beside, most)
    if figures[of.BEGINS] > 0.0 and stands_touching(beside):
        return ALL_TOLD if known_off(figures, figures[of.ABOUT]) else TOO_FAR_OFF
    figures[of.BEGINS] = 0.0
    return touched_on(block, slot, most)
