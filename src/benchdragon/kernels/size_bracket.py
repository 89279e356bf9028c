"""The bracket of a size: which value is tried next, and when it is narrow enough.

No walk is computed here. Trials give a verdict on a value, and roots, near which a pair just touches.
"""

import math

from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.numbered import Numbered


class SizeVerdict(Numbered):
    """The verdict of a trial."""

    PASSES, FAILS, UNDECIDED = range(3)


class Bracket(Numbered):
    """The state of the bracket, a row of floats."""

    SENSE = 0  # +1 where larger sizes are safer, -1 where smaller ones are
    TOLERANCE = 1  # how wide the bracket may be, m
    SLACK = 2  # the error bound of computed distances, m
    STAGE = 3  # the goal: see kernels/size_search.py
    SIZE = 4  # on trial, m
    GOOD = 5  # one that passes
    BAD = 6  # one that does not, or the farthest that is of interest
    TRIED = 7  # whether BAD was tried
    ROOT = 8  # near which the size on trial lies
    SHIFT = 9  # by how much on the safe side of it; 0: near no root
    SLOPE = 10  # of the pair's distance there
    CAUTION = 11  # how many times the slack the shift allows for
    FAILURES = 12  # roots that failed one after another
    BESIDE = 13  # sizes tried beside undecided ones
    TRIALS = 14
    GROWN = 15  # sizes tried before one passed
    DOUBTS = 16  # undecided sizes
    VALUE = 17  # the answer
    AT = 18  # the size at which the guiding pair was found
    PHASE = 19  # what the next value answers
    NOW = 20  # the size of the walk that is requested
    SECOND_LAST = 21  # of the secant method, the size before
    VALUE_THERE = 22  # and the distance there, m
    SECANTS = 23  # steps taken


BRACKET_NUMBERS = len(Bracket)

# How much wider than the tolerance or rounding a bracket may be.
ULPS = 4.0
UNIT = 2.3e-16
# The factor by which a size grows, and how often at most, until a walk passes; and how many times
# smaller (or larger) than that sizes are of interest.
GROWTH, MOST_GROWTHS, FARTHEST = 1.25, 40, 100.0
# Roots of a pair that fail one after another, because another pair decides, before halving.
MOST_FAILURES = 2
# Sizes tried beside some that could not be decided, on both sides in turn, before giving up.
MOST_BESIDE = 12
# Sizes tried at most; the contest's pitch takes 2.
MOST_TRIALS = 80
# By how much a root is passed at first, in slacks, and how much more after each failure.
FIRST_CAUTION, MORE_CAUTION = 2.5, 4.0


@kernel
def is_between(state: FloatArray, size: float) -> bool:
    """Whether a size lies strictly inside the bracket."""
    return (
        min(state[Bracket.GOOD], state[Bracket.BAD])
        < size
        < max(state[Bracket.GOOD], state[Bracket.BAD])
    )


@kernel
def doubt_next_to(state: FloatArray, doubts: FloatArray, end: float) -> float:
    """The undecided size in the bracket that is nearest to one of its ends; NaN if there is none."""
    nearest = math.nan
    for n in range(int(state[Bracket.DOUBTS])):
        if is_between(state, doubts[n]) and not abs(nearest - end) <= abs(doubts[n] - end):
            nearest = doubts[n]
    return nearest


@kernel
def ahead(state: FloatArray, size: float) -> float:
    """A size from `size` on towards the one that does not pass."""
    if state[Bracket.TRIED] > 0.0:
        return math.sqrt(size * state[Bracket.BAD])
    further = size * GROWTH ** -state[Bracket.SENSE]
    return further if is_between(state, further) else state[Bracket.BAD]


@kernel
def beside_doubts(state: FloatArray, doubts: FloatArray) -> float:
    """A size on the one side, then on the other, of those that could not be decided."""
    state[Bracket.BESIDE] += 1.0
    if state[Bracket.BESIDE] % 2.0 == 1.0:
        return ahead(state, doubt_next_to(state, doubts, state[Bracket.BAD]))
    return math.sqrt(doubt_next_to(state, doubts, state[Bracket.GOOD]) * state[Bracket.GOOD])


@kernel
def next_target(state: FloatArray, doubts: FloatArray, rooted: bool) -> None:
    """Choose the SIZE to try next, and SHIFT; `rooted`: ROOT and SLOPE are those of a pair."""
    state[Bracket.SHIFT] = 0.0
    if not math.isnan(doubt_next_to(state, doubts, state[Bracket.BAD])):
        state[Bracket.SIZE] = beside_doubts(state, doubts)
        return
    if rooted and state[Bracket.FAILURES] < MOST_FAILURES:
        size = state[Bracket.ROOT]
        shift = (
            state[Bracket.CAUTION] * state[Bracket.SLACK] / abs(state[Bracket.SLOPE])
            + ULPS * UNIT * size
        )
        shift = max(shift, 0.25 * state[Bracket.TOLERANCE])
        target = size + math.copysign(shift, state[Bracket.SENSE])
        if is_between(state, target):
            state[Bracket.SIZE], state[Bracket.SHIFT] = target, shift
            return
    state[Bracket.FAILURES] = 0.0
    state[Bracket.SIZE] = ahead(state, state[Bracket.GOOD])


@kernel
def is_closed(state: FloatArray) -> bool:
    """Whether the bracket is as narrow as required, or as doubles allow."""
    width = abs(state[Bracket.GOOD] - state[Bracket.BAD])
    return state[Bracket.TRIED] > 0.0 and width <= max(
        state[Bracket.TOLERANCE], ULPS * UNIT * state[Bracket.GOOD]
    )


@kernel
def add_doubt(state: FloatArray, doubts: FloatArray) -> None:
    """Add SIZE to those that could not be decided."""
    doubts[int(state[Bracket.DOUBTS])] = state[Bracket.SIZE]
    state[Bracket.DOUBTS] += 1.0


@kernel
def take_result(state: FloatArray, doubts: FloatArray, result: int, same: bool) -> None:
    """Narrow the bracket by the verdict on SIZE; `same`: the pair of its root failed again."""
    size = state[Bracket.SIZE]
    state[Bracket.TRIALS] += 1.0
    if result == SizeVerdict.UNDECIDED:
        add_doubt(state, doubts)
    elif result == SizeVerdict.PASSES:
        state[Bracket.GOOD], state[Bracket.FAILURES] = size, 0.0
    else:
        if state[Bracket.SHIFT] > 0.0 and same:
            state[Bracket.CAUTION] *= MORE_CAUTION
        state[Bracket.BAD], state[Bracket.TRIED] = size, 1.0
        state[Bracket.FAILURES] += 1.0


@kernel
def is_over(state: FloatArray, doubts: FloatArray) -> bool:
    """Whether no other size is to be tried: the bracket is closed, or doubts stay."""
    doubtful = not math.isnan(doubt_next_to(state, doubts, state[Bracket.BAD]))
    return is_closed(state) or (doubtful and state[Bracket.BESIDE] >= MOST_BESIDE)
