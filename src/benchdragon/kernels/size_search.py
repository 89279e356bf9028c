"""The critical size of a plan, by a bracketed secant method on the separation of the active pair.

Where a walk fails, the least distance of the pair that meets there, around that moment, is a smooth
function of the size; its root is tried next, and the answer is the root at which the whole walk passes.
No walk is computed here: the caller does what is requested, and calls again with the result, be it of
the kernels' search of a walk or a test's made-up numbers.
"""

import math

from benchdragon.kernels import size_bracket as bracket
from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.size_bracket import (
    Bracket,
    SizeVerdict,
    add_doubt,
    is_over,
    next_target,
    take_result,
)


class SizeGoal(Numbered):
    """Goals; the first two go over into the last."""

    GROW = 0  # a size that passes, from SIZE on, then the limit beside it
    BORDER = 1  # the limit between GOOD and BAD, which SIZE is
    NARROW = 2


class SizeStep(Numbered):
    """What is requested, or the exit status of the search."""

    WALK = 0  # how the walk of NOW goes: PASSES, FAILS or UNDECIDED, with the meeting FAILED if two met
    LOW_PAIR = 1  # the least distance of any pair in the walk of NOW, m, with the meeting GUIDE
    # the distance of the pair ROOTED near its meeting in the walk of NOW, m; the meeting moves there
    DISTANCE = 2
    # Exit statuses of the search.
    FOUND = 3  # the bracket is what it can be
    UNLIMITED = 4  # even BAD passes
    INFEASIBLE = 5  # none passes
    EXHAUSTED = 6  # too many were tried


class SizePhase(Numbered):
    """The phase of the search: what the value that is handed in answers."""

    OPENED, AFTER_WALK, AFTER_LOW_PAIR, AFTER_FIRST, AFTER_NEXT, AFTER_BELOW = range(6)


# A meeting, a row: head position, what is left to the walk's end (m), the two benches or NO_MEETING.
NO_MEETING = -1.0


class Meet(Numbered):
    """A meeting, a row: head position, what is left to the walk's end (m), the two benches."""

    S, LEFT, FRONT, REAR = range(4)


class KnownMeeting(Numbered):
    """Rows of the meetings.

    They are the meeting of the last walk that failed, the guide of the secant method, and that of the
    root; and the pair of the guide before.
    """

    FAILED, GUIDE, ROOTED, BEFORE = range(4)


MEETINGS = len(KnownMeeting)

# A pair that comes no nearer than this, m, is no hint where the limit lies.
NEARBY = 0.1
# The secant method: its first step, the least from which a slope is taken, when it has come to rest,
# and how far it may go at once, all relative; steps at most.
FIRST_STEP, SHARP, SETTLED, LONGEST_SECANT, MOST_SECANTS = 1e-5, 1e-7, 1e-15, 1.1, 40
# A distance from a root of a pair, as a share of the bracket's width, that counts as at rest, too.
AT_REST = 1e-4


@kernel
def copy_meeting(meetings: FloatArray, source: int, target: int) -> None:
    """Copy one meeting over another."""
    for n in range(4):
        meetings[target, n] = meetings[source, n]


@kernel
def same_pair(meetings: FloatArray, one: int, two: int) -> bool:
    """Whether two meetings are of the same pair."""
    front, rear = meetings[one, Meet.FRONT], meetings[one, Meet.REAR]
    return front == meetings[two, Meet.FRONT] and rear == meetings[two, Meet.REAR]


@kernel
def ask(state: FloatArray, phase: int, task: int, size: float) -> int:
    """Request a task in the walk of a size."""
    state[Bracket.PHASE], state[Bracket.NOW] = phase, size
    return task


@kernel
def ask_for_target(state: FloatArray, doubts: FloatArray, rooted: bool) -> int:
    """Request the verdict on the walk of the next size."""
    next_target(state, doubts, rooted)
    return ask(state, SizePhase.AFTER_WALK, SizeStep.WALK, state[Bracket.SIZE])


@kernel
def ask_for_guide(state: FloatArray, meetings: FloatArray, size: float) -> int:
    """Request the pair that guides the search from now on, in the walk of a size."""
    copy_meeting(meetings, KnownMeeting.GUIDE, KnownMeeting.BEFORE)
    state[Bracket.AT], meetings[KnownMeeting.GUIDE, Meet.FRONT] = size, NO_MEETING
    return ask(state, SizePhase.AFTER_LOW_PAIR, SizeStep.LOW_PAIR, size)


@kernel
def ask_for_root(state: FloatArray, doubts: FloatArray, meetings: FloatArray) -> int:
    """Request the first distance on the way to the root of the guiding pair, if there is one."""
    if meetings[KnownMeeting.GUIDE, Meet.FRONT] == NO_MEETING:
        return ask_for_target(state, doubts, False)
    copy_meeting(meetings, KnownMeeting.GUIDE, KnownMeeting.ROOTED)
    state[Bracket.SECANTS], state[Bracket.SLOPE] = 0.0, math.nan
    return ask(state, SizePhase.AFTER_FIRST, SizeStep.DISTANCE, state[Bracket.AT])


@kernel
def after_next(state: FloatArray, doubts: FloatArray, there: float) -> int:
    """Take a step of the secant method, the distance being `there` at NOW, m."""
    a, b, fa, fb = state[Bracket.SECOND_LAST], state[Bracket.NOW], state[Bracket.VALUE_THERE], there
    if not (abs(fb) < math.inf and b > 0.0):
        return ask_for_target(state, doubts, False)
    if fb == fa or state[Bracket.SECANTS] >= MOST_SECANTS:
        state[Bracket.ROOT] = b  # where the distance is 0 up to rounding
        rooted = abs(fb) <= state[Bracket.SLACK] and abs(state[Bracket.SLOPE]) > 0.0
        return ask_for_target(state, doubts, rooted)
    if abs(b - a) > SHARP * abs(a):
        state[Bracket.SLOPE] = (fb - fa) / (b - a)
    size = min(max(b - fb / state[Bracket.SLOPE], b / LONGEST_SECANT), b * LONGEST_SECANT)
    if abs(size - b) <= max(SETTLED * abs(b), AT_REST * state[Bracket.TOLERANCE]):
        state[Bracket.ROOT] = size
        return ask_for_target(state, doubts, True)
    state[Bracket.SECOND_LAST], state[Bracket.VALUE_THERE] = b, fb
    state[Bracket.SECANTS] += 1.0
    return ask(state, SizePhase.AFTER_NEXT, SizeStep.DISTANCE, size)


@kernel
def after_growing(state: FloatArray, doubts: FloatArray, meetings: FloatArray, result: int) -> int:
    """Go on after a walk of GROW."""
    size = state[Bracket.SIZE]
    if result == SizeVerdict.PASSES:
        state[Bracket.STAGE], state[Bracket.GOOD] = SizeGoal.NARROW, size
        if state[Bracket.TRIED] > 0.0:
            return after_failure(state, doubts, meetings)
        state[Bracket.BAD] = size * bracket.FARTHEST ** -state[Bracket.SENSE]
        return ask_for_guide(state, meetings, size)
    if result == SizeVerdict.UNDECIDED:
        add_doubt(state, doubts)
    else:
        state[Bracket.BAD], state[Bracket.TRIED] = size, 1.0
    state[Bracket.GROWN] += 1.0
    state[Bracket.SIZE] = size * bracket.GROWTH ** state[Bracket.SENSE]
    if state[Bracket.GROWN] >= bracket.MOST_GROWTHS:
        return SizeStep.INFEASIBLE
    return ask(state, SizePhase.AFTER_WALK, SizeStep.WALK, state[Bracket.SIZE])


@kernel
def after_failure(state: FloatArray, doubts: FloatArray, meetings: FloatArray) -> int:
    """Go on after the walk of BAD failed: by its deepest pair, if two met at all.

    Where none met it may be that there is no such walk.
    """
    if meetings[KnownMeeting.FAILED, Meet.FRONT] != NO_MEETING:
        return ask_for_guide(state, meetings, state[Bracket.BAD])
    meetings[KnownMeeting.GUIDE, Meet.FRONT] = NO_MEETING
    return ask_for_target(state, doubts, False)


@kernel
def after_low_pair(state: FloatArray, doubts: FloatArray, meetings: FloatArray, least: float) -> int:
    """Let the nearest or deepest pair guide, `least` metres; the one met first if it did before."""
    if not least <= NEARBY:
        meetings[KnownMeeting.GUIDE, Meet.FRONT] = NO_MEETING
    failed = state[Bracket.TRIED] > 0.0 and state[Bracket.AT] == state[Bracket.BAD]
    if failed and (
        meetings[KnownMeeting.GUIDE, Meet.FRONT] == NO_MEETING
        or same_pair(meetings, KnownMeeting.GUIDE, KnownMeeting.BEFORE)
    ):
        copy_meeting(meetings, KnownMeeting.FAILED, KnownMeeting.GUIDE)
    return ask_for_root(state, doubts, meetings)


@kernel
def ended(state: FloatArray, doubts: FloatArray, meetings: FloatArray) -> int:
    """The exit status: the pair that decides is the one that met in the walk of BAD; or NARROW."""
    over = is_over(state, doubts)
    if not over and state[Bracket.TRIALS] < bracket.MOST_TRIALS:
        return SizeGoal.NARROW
    copy_meeting(meetings, KnownMeeting.FAILED, KnownMeeting.GUIDE)
    return SizeStep.FOUND if over else SizeStep.EXHAUSTED


@kernel
def after_narrowing(state: FloatArray, doubts: FloatArray, meetings: FloatArray, result: int) -> int:
    """Go on after a walk of NARROW."""
    size, untried = state[Bracket.SIZE], state[Bracket.TRIED] == 0.0
    take_result(state, doubts, result, same_pair(meetings, KnownMeeting.FAILED, KnownMeeting.ROOTED))
    state[Bracket.VALUE] = state[Bracket.GOOD]
    if result == SizeVerdict.PASSES and state[Bracket.SHIFT] > 0.0:
        below = size - math.copysign(2.0 * state[Bracket.SHIFT], state[Bracket.SENSE])
        return ask(state, SizePhase.AFTER_BELOW, SizeStep.DISTANCE, below)
    if result == SizeVerdict.PASSES and untried and size == state[Bracket.BAD]:
        meetings[KnownMeeting.GUIDE, Meet.FRONT] = NO_MEETING
        return SizeStep.UNLIMITED
    ending = ended(state, doubts, meetings)
    if ending != SizeGoal.NARROW:
        return ending
    if result == SizeVerdict.PASSES:
        return ask_for_guide(state, meetings, size)
    if result == SizeVerdict.FAILS:
        return after_failure(state, doubts, meetings)
    return ask_for_root(state, doubts, meetings)


@kernel
def after_below(state: FloatArray, doubts: FloatArray, meetings: FloatArray, there: float) -> int:
    """Go on when the size near a root passed, the pair's distance beyond the root being `there`, m."""
    if there < -state[Bracket.SLACK]:
        state[Bracket.BAD], state[Bracket.TRIED] = state[Bracket.NOW], 1.0
        state[Bracket.VALUE] = state[Bracket.ROOT]
        copy_meeting(meetings, KnownMeeting.ROOTED, KnownMeeting.GUIDE)
        return SizeStep.FOUND
    meetings[KnownMeeting.GUIDE, Meet.FRONT] = NO_MEETING
    ending = ended(state, doubts, meetings)
    return ask_for_target(state, doubts, False) if ending == SizeGoal.NARROW else ending


@kernel
def after_walk(state: FloatArray, doubts: FloatArray, meetings: FloatArray, result: int) -> int:
    """Go on after a walk."""
    if state[Bracket.STAGE] == SizeGoal.GROW:
        return after_growing(state, doubts, meetings, result)
    if state[Bracket.STAGE] == SizeGoal.NARROW:
        return after_narrowing(state, doubts, meetings, result)
    state[Bracket.STAGE] = SizeGoal.NARROW
    if result == SizeVerdict.FAILS:
        return after_failure(state, doubts, meetings)
    return ask_for_target(state, doubts, False)


@kernel
def next_task(state: Vector, doubts: Vector, meetings: Table, value: float) -> int:
    """The next request, in the walk of size NOW, or the exit status of the search.

    `value` answers the request before: a verdict on a walk, or a distance less the required margin, m,
    NaN or infinite if there is no such walk. `doubts` holds the sizes that could not be decided. A
    search begins with PHASE 0, STAGE, SIZE (with GOOD, BAD and TRIED for a border), and no meetings.
    """
    phase = int(state[Bracket.PHASE])
    if phase == SizePhase.OPENED:
        return ask(state, SizePhase.AFTER_WALK, SizeStep.WALK, state[Bracket.SIZE])
    if phase == SizePhase.AFTER_WALK:
        return after_walk(state, doubts, meetings, int(value))
    if phase == SizePhase.AFTER_LOW_PAIR:
        return after_low_pair(state, doubts, meetings, value)
    if phase == SizePhase.AFTER_BELOW:
        return after_below(state, doubts, meetings, value)
    if phase == SizePhase.AFTER_NEXT:
        return after_next(state, doubts, value)
    state[Bracket.SECOND_LAST], state[Bracket.VALUE_THERE] = state[Bracket.NOW], value
    size = state[Bracket.NOW] * (1.0 + state[Bracket.SENSE] * FIRST_STEP)
    return ask(state, SizePhase.AFTER_NEXT, SizeStep.DISTANCE, size)
