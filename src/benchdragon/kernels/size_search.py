"""How small or large one size of a plan may be: which walk to try next, and what to look for in it.

Where a walk fails, the pair that meets there gives a smooth function of the size, its least distance
around that moment, whose root is where the search goes next; the answer is the root at which the whole
walk passes. Nothing here walks: whoever calls does what is asked for, and calls again with what came of
it, be it the kernels' search of a walk or a test's made-up numbers.
"""

import math

from benchdragon.kernels import size_bracket as bracket
from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.size_bracket import add_doubt, is_over, next_target, take_result

# What is sought; the first two go over into the last.
GROW = 0  # a size that passes, from SIZE on, then the limit beside it
BORDER = 1  # the limit between GOOD and BAD, which SIZE is
NARROW = 2
# What is asked for.
WALK = 0  # how the walk of NOW goes: PASSES, FAILS or UNDECIDED, with the meeting FAILED if two met
LOW_PAIR = 1  # the least distance of any pair in the walk of NOW, m, with the meeting GUIDE
DISTANCE = 2  # that of the pair ROOTED near its meeting in the walk of NOW, m; the meeting moves there
# Or how the search ended.
FOUND = 3  # the bracket is what it can be
UNLIMITED = 4  # even BAD passes
INFEASIBLE = 5  # none passes
EXHAUSTED = 6  # too many were tried
# Where the search stands: what the value that is handed in answers.
OPENED, AFTER_WALK, AFTER_LOW_PAIR, AFTER_FIRST, AFTER_NEXT, AFTER_BELOW = range(6)
# A meeting, a row: head position, what is left to the walk's end (m), the two benches or NOBODY.
NOBODY = -1.0
MEET_S, MEET_LEFT, MEET_FRONT, MEET_REAR = 0, 1, 2, 3
# Meetings: of the last walk that failed, the one to go by, the one of the root; and the pair that was
# gone by before.
FAILED, GUIDE, ROOTED, BEFORE = 0, 1, 2, 3
MEETINGS = 4

# A pair that comes no nearer than this, m, is no hint where the limit lies.
NEARBY = 0.1
# The secant method: its first step, the least from which a slope is taken, when it has come to rest,
# and how far it may go at once, all relative; steps at most.
FIRST_STEP, SHARP, SETTLED, LONGEST_SECANT, MOST_SECANTS = 1e-5, 1e-7, 1e-15, 1.1, 40
# How near to a root of a pair, as a share of the bracket's width, counts likewise.
AT_REST = 1e-4


@kernel
def copy_meeting(meetings: FloatArray, source: int, target: int) -> None:
    """Copy one meeting over another."""
    for n in range(4):
        meetings[target, n] = meetings[source, n]


@kernel
def same_pair(meetings: FloatArray, one: int, two: int) -> bool:
    """Whether two meetings are of the same pair."""
    front, rear = meetings[one, MEET_FRONT], meetings[one, MEET_REAR]
    return front == meetings[two, MEET_FRONT] and rear == meetings[two, MEET_REAR]


@kernel
def ask(state: FloatArray, phase: int, task: int, size: float) -> int:
    """Ask for a task in the walk of a size."""
    state[bracket.PHASE], state[bracket.NOW] = phase, size
    return task


@kernel
def ask_for_target(state: FloatArray, doubts: FloatArray, rooted: bool) -> int:
    """Ask how the walk of the next size goes."""
    next_target(state, doubts, rooted)
    return ask(state, AFTER_WALK, WALK, state[bracket.SIZE])


@kernel
def ask_for_guide(state: FloatArray, meetings: FloatArray, size: float) -> int:
    """Ask which pair to go by from now on, seen in the walk of a size."""
    copy_meeting(meetings, GUIDE, BEFORE)
    state[bracket.AT], meetings[GUIDE, MEET_FRONT] = size, NOBODY
    return ask(state, AFTER_LOW_PAIR, LOW_PAIR, size)


@kernel
def ask_for_root(state: FloatArray, doubts: FloatArray, meetings: FloatArray) -> int:
    """Ask for the first distance on the way to the root of the pair to go by, if there is one."""
    if meetings[GUIDE, MEET_FRONT] == NOBODY:
        return ask_for_target(state, doubts, False)
    copy_meeting(meetings, GUIDE, ROOTED)
    state[bracket.SECANTS], state[bracket.SLOPE] = 0.0, math.nan
    return ask(state, AFTER_FIRST, DISTANCE, state[bracket.AT])


@kernel
def after_next(state: FloatArray, doubts: FloatArray, there: float) -> int:
    """Take a step of the secant method, the distance being `there` at NOW, m."""
    a, b, fa, fb = state[bracket.SECOND_LAST], state[bracket.NOW], state[bracket.VALUE_THERE], there
    if not (abs(fb) < math.inf and b > 0.0):
        return ask_for_target(state, doubts, False)
    if fb == fa or state[bracket.SECANTS] >= MOST_SECANTS:
        state[bracket.ROOT] = b  # where there is no distance but for rounding
        rooted = abs(fb) <= state[bracket.SLACK] and abs(state[bracket.SLOPE]) > 0.0
        return ask_for_target(state, doubts, rooted)
    if abs(b - a) > SHARP * abs(a):
        state[bracket.SLOPE] = (fb - fa) / (b - a)
    size = min(max(b - fb / state[bracket.SLOPE], b / LONGEST_SECANT), b * LONGEST_SECANT)
    if abs(size - b) <= max(SETTLED * abs(b), AT_REST * state[bracket.TOLERANCE]):
        state[bracket.ROOT] = size
        return ask_for_target(state, doubts, True)
    state[bracket.SECOND_LAST], state[bracket.VALUE_THERE] = b, fb
    state[bracket.SECANTS] += 1.0
    return ask(state, AFTER_NEXT, DISTANCE, size)


@kernel
def after_growing(state: FloatArray, doubts: FloatArray, meetings: FloatArray, result: int) -> int:
    """Go on after a walk of GROW."""
    size = state[bracket.SIZE]
    if result == bracket.PASSES:
        state[bracket.STAGE], state[bracket.GOOD] = NARROW, size
        if state[bracket.TRIED] > 0.0:
            return after_failure(state, doubts, meetings)
        state[bracket.BAD] = size * bracket.FARTHEST ** -state[bracket.SENSE]
        return ask_for_guide(state, meetings, size)
    if result == bracket.UNDECIDED:
        add_doubt(state, doubts)
    else:
        state[bracket.BAD], state[bracket.TRIED] = size, 1.0
    state[bracket.GROWN] += 1.0
    state[bracket.SIZE] = size * bracket.GROWTH ** state[bracket.SENSE]
    if state[bracket.GROWN] >= bracket.MOST_GROWTHS:
        return INFEASIBLE
    return ask(state, AFTER_WALK, WALK, state[bracket.SIZE])


@kernel
def after_failure(state: FloatArray, doubts: FloatArray, meetings: FloatArray) -> int:
    """Go on after the walk of BAD failed: by its deepest pair, if two met at all.

    Where none met it may be that there is no such walk.
    """
    if meetings[FAILED, MEET_FRONT] != NOBODY:
        return ask_for_guide(state, meetings, state[bracket.BAD])
    meetings[GUIDE, MEET_FRONT] = NOBODY
    return ask_for_target(state, doubts, False)


@kernel
def after_low_pair(state: FloatArray, doubts: FloatArray, meetings: FloatArray, least: float) -> int:
    """Go by the nearest or deepest pair, `least` metres; by the one met first if that was before."""
    if not least <= NEARBY:
        meetings[GUIDE, MEET_FRONT] = NOBODY
    failed = state[bracket.TRIED] > 0.0 and state[bracket.AT] == state[bracket.BAD]
    if failed and (meetings[GUIDE, MEET_FRONT] == NOBODY or same_pair(meetings, GUIDE, BEFORE)):
        copy_meeting(meetings, FAILED, GUIDE)
    return ask_for_root(state, doubts, meetings)


@kernel
def ended(state: FloatArray, doubts: FloatArray, meetings: FloatArray) -> int:
    """How the search ended: the pair that decides is the one that met in the walk of BAD; or NARROW."""
    over = is_over(state, doubts)
    if not over and state[bracket.TRIALS] < bracket.MOST_TRIALS:
        return NARROW
    copy_meeting(meetings, FAILED, GUIDE)
    return FOUND if over else EXHAUSTED


@kernel
def after_narrowing(state: FloatArray, doubts: FloatArray, meetings: FloatArray, result: int) -> int:
    """Go on after a walk of NARROW."""
    size, untried = state[bracket.SIZE], state[bracket.TRIED] == 0.0
    take_result(state, doubts, result, same_pair(meetings, FAILED, ROOTED))
    state[bracket.VALUE] = state[bracket.GOOD]
    if result == bracket.PASSES and state[bracket.SHIFT] > 0.0:
        below = size - math.copysign(2.0 * state[bracket.SHIFT], state[bracket.SENSE])
        return ask(state, AFTER_BELOW, DISTANCE, below)
    if result == bracket.PASSES and untried and size == state[bracket.BAD]:
        meetings[GUIDE, MEET_FRONT] = NOBODY
        return UNLIMITED
    ending = ended(state, doubts, meetings)
    if ending != NARROW:
        return ending
    if result == bracket.PASSES:
        return ask_for_guide(state, meetings, size)
    if result == bracket.FAILS:
        return after_failure(state, doubts, meetings)
    return ask_for_root(state, doubts, meetings)


@kernel
def after_below(state: FloatArray, doubts: FloatArray, meetings: FloatArray, there: float) -> int:
    """Go on when the size near a root passed, the pair's distance beyond the root being `there`, m."""
    if there < -state[bracket.SLACK]:
        state[bracket.BAD], state[bracket.TRIED] = state[bracket.NOW], 1.0
        state[bracket.VALUE] = state[bracket.ROOT]
        copy_meeting(meetings, ROOTED, GUIDE)
        return FOUND
    meetings[GUIDE, MEET_FRONT] = NOBODY
    ending = ended(state, doubts, meetings)
    return ask_for_target(state, doubts, False) if ending == NARROW else ending


@kernel
def after_walk(state: FloatArray, doubts: FloatArray, meetings: FloatArray, result: int) -> int:
    """Go on after a walk."""
    if state[bracket.STAGE] == GROW:
        return after_growing(state, doubts, meetings, result)
    if state[bracket.STAGE] == NARROW:
        return after_narrowing(state, doubts, meetings, result)
    state[bracket.STAGE] = NARROW
    if result == bracket.FAILS:
        return after_failure(state, doubts, meetings)
    return ask_for_target(state, doubts, False)


@kernel
def next_task(state: Vector, doubts: Vector, meetings: Table, value: float) -> int:
    """What is asked for next, in the walk of size NOW, or how the search ended.

    `value` answers what was asked for before: how a walk went, or a distance less the margin wanted, m,
    NaN or infinite if there is no such walk. `doubts` holds the sizes that could not be decided. A
    search begins with PHASE 0, STAGE, SIZE (with GOOD, BAD and TRIED for a border), and no meetings.
    """
    phase = int(state[bracket.PHASE])
    if phase == OPENED:
        return ask(state, AFTER_WALK, WALK, state[bracket.SIZE])
    if phase == AFTER_WALK:
        return after_walk(state, doubts, meetings, int(value))
    if phase == AFTER_LOW_PAIR:
        return after_low_pair(state, doubts, meetings, value)
    if phase == AFTER_BELOW:
        return after_below(state, doubts, meetings, value)
    if phase == AFTER_NEXT:
        return after_next(state, doubts, value)
    state[bracket.SECOND_LAST], state[bracket.VALUE_THERE] = state[bracket.NOW], value
    size = state[bracket.NOW] * (1.0 + state[bracket.SENSE] * FIRST_STEP)
    return ask(state, AFTER_NEXT, DISTANCE, size)
