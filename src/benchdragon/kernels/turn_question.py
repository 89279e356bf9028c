"""The best turn of a family, as a question: `open, seek, step, read, close`.

A search begins with samples spread evenly over the ranges of all unknowns, the same in every search.
From the best few of them it goes downhill, and then, with finer evaluation, from the best of where that
ends. Given a point, it goes downhill from there alone.
"""

import math
from typing import NamedTuple

from benchdragon.kernels import memory, turn_descent, turn_peaks, turn_trial
from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.curve import COLUMNS as ROUTE_COLUMNS
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.memory import ROW, Header
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.question import QuestionEnding, Told
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.route_parts import PART_COLUMNS
from benchdragon.kernels.search_room import placements
from benchdragon.kernels.turn_descent import Descent, DescentState, begin_at, descend
from benchdragon.kernels.turn_families import ARCS, MOST_TURN_PIECES
from benchdragon.kernels.turn_peaks import PeakRow, Trial, TurnCount, exceeding, greatest
from benchdragon.kernels.turn_trial import figures_of, look

# Samples for each unknown with a range; how many of the best start a descent; the least distance of
# these, as a share of ranges; the weight of a limit that is exceeded by all of itself.
STREWN, STARTS, STARTS_APART, SOFT = 300, 8, 0.1, 3.0
# The step at which rates are evaluated, as a share of the shortest link; the range of trust at first;
# the most steps: of the first descents, and of the last, finer one.
RATE_STEPS, TRUST, MOST_DESCENT_STEPS = (0.125, 0.06), (0.05, 0.01), (20, 60)
# Handles placed in one step of the question, at least.
WORK = 100_000


class TurnSought(Numbered):
    """The goal: the best turn of all, or the best near a point."""

    ALL, NEAR = 0, 1


class TurnStage(Numbered):
    """The stage of a question."""

    STREWING, DOWNHILL, CLOSELY, ENDED = range(4)


class TurnEnding(Numbered):
    """Exit status of a step when all is done."""

    DONE = 1


class TurnTold(Told):
    """The result, a row of floats that begins with the columns of `question.Told`.

    The greatest share by which limits are exceeded (infinite: there is no turn), the turns tried, and
    the share of the search that is done; besides, the stage, and how many points or steps of it.
    """

    EXCEEDS, TRIED, SHARE, DOING, NUMBER = range(2, 7)


TURN_FIGURES = len(TurnTold)


class TurnAsked(NamedTuple):
    """A question: what a host passes, the result, and all that searches need."""

    trial: Trial
    descent: Descent
    starts: Table  # (STARTS, UNKNOWNS + 1): points, and what each is worth
    figures: Vector


BASE, TURN_END_SLOT = 8 * memory.HEADER, memory.HEADER + memory.slot_count(TurnAsked)


@kernel
def lay_asked(slots: IntArray, address: int, x: int, benches: int, boxes: int, obstacles: int) -> int:
    """Lay out all of a question from an address on; returns the bytes that it takes."""
    few, slot_count, point = min(turn_trial.FEW, benches), turn_trial.LOOK_SLOTS, (x, ROW)
    return memory.lay(slots, memory.HEADER, address, (
        (turn_peaks.TURN_GIVEN, ROW), point, point, (turn_peaks.TURN_MEASURES, ROW), (4, benches),
        (benches, ROW),
        (boxes, BOX_COLUMNS), (obstacles + 1, ROW), (obstacles, 2), (ARCS, 2), (MOST_TURN_PIECES, 3),
        (MOST_TURN_PIECES + 2, PART_COLUMNS), (turn_trial.MOST_ROWS, ROUTE_COLUMNS), (slot_count, ROW),
        *placements(few + 1, slot_count), (benches + 1, slot_count), (benches + 1, slot_count),
        *placements(benches + 1, 1), (2, BOX_COLUMNS), (2 * turn_peaks.RATES, few + 1), (2, ROW),
        (turn_peaks.MOST_NOTED, turn_peaks.PEAK_COLUMNS), (turn_peaks.TURN_COUNTS, ROW), point, point,
        (turn_descent.STEP_UNKNOWNS, ROW), (turn_peaks.MOST_KEPT, turn_peaks.PEAK_COLUMNS),
        (turn_peaks.MOST_KEPT, turn_peaks.UNKNOWNS), (turn_descent.MOST_LINES,
        turn_descent.LINE_COLUMNS),
        (turn_descent.STEP_UNKNOWNS, turn_descent.STEP_UNKNOWNS + 1), (turn_descent.DESCENT_STATE, ROW),
        (STARTS, turn_peaks.UNKNOWNS + 1), (TURN_FIGURES, ROW),
    ))  # fmt: skip


@entry
def open_turn(
    told: Vector, low: Vector, high: Vector, sizes: Table, links: Vector, standing: Table,
    border: IntVector, keep: Table,
) -> int:  # fmt: skip
    """Open a question about turns with unknowns from low to high; returns its handle, 0 without memory.

    `told` is a row of TurnGiven, sizes (4, benches) and links are those of the first MORE benches.
    `standing` has the boxes of all obstacles, border[o] the first of each and last their number, `keep`
    (obstacles, 2) the distance that benches keep from each, m, and 1 if its inside is forbidden, -1 if
    its outside.
    """
    block = memory.new_block(TURN_END_SLOT - memory.HEADER)
    if block == 0:
        return 0
    slots, x, benches = memory.integers_at(block, TURN_END_SLOT), low.shape[0], links.shape[0]
    boxes, obstacles = standing.shape[0], keep.shape[0]
    size = lay_asked(slots, 0, x, benches, boxes, obstacles)
    if memory.take(slots, 0, size):
        address = slots[Header.OWNED]
        lay_asked(slots, address, x, benches, boxes, obstacles)
        everything = memory.floats_at(address, size // 8)
        for n in range(size // 8):
            everything[n] = 0.0
        trial = memory.group_at(TurnAsked, block + BASE).trial
        memory.copy_row(trial.told, told)
        memory.copy_row(trial.low, low)
        memory.copy_row(trial.high, high)
        memory.copy_table(trial.sizes, sizes)
        memory.copy_row(trial.links, links)
        memory.copy_table(trial.standing, standing)
        memory.copy_row(trial.border, border)
        memory.copy_table(trial.keep, keep)
        handle = memory.remember(block)
        if handle:
            return handle
    memory.release_block(block)
    return 0


@entry
def seek_turn(handle: int, what: int, x: Vector, factors: Vector) -> bool:
    """Seek ALL or NEAR x, from the next step on; False if there is no such question.

    True figures are `factors`, one for each TurnMeasure, times what is seen, distances so many m less.
    """
    block = memory.recall(handle)
    if block == 0:
        return False
    asked = memory.group_at(TurnAsked, block + BASE)
    memory.copy_row(asked.trial.factors, factors)
    memory.copy_row(asked.descent.x, x)
    asked.figures[TurnTold.NUMBER], asked.figures[TurnTold.SHARE] = 0.0, 0.0
    asked.figures[TurnTold.DOING] = TurnStage.STREWING if what == TurnSought.ALL else TurnStage.CLOSELY
    for n in range(STARTS):
        asked.starts[n, turn_peaks.UNKNOWNS] = math.inf
    return True


@entry
def step_turn(handle: int, left: float) -> int:
    """Go on for some hundredths of a second, or `left` handles: MORE, DONE, or CLOSED."""
    block = memory.recall(handle)
    if block == 0:
        return QuestionEnding.CLOSED
    asked = memory.group_at(TurnAsked, block + BASE)
    figures, counts = asked.figures, asked.trial.counts
    counts[TurnCount.PLACED] = 0
    while counts[TurnCount.PLACED] < min(WORK, left) and figures[TurnTold.DOING] != TurnStage.ENDED:
        if figures[TurnTold.DOING] == TurnStage.STREWING:
            strew(asked)
        else:
            go_down(asked)
    figures[Told.SPENT] = counts[TurnCount.PLACED]
    return TurnEnding.DONE if figures[TurnTold.DOING] == TurnStage.ENDED else QuestionEnding.MORE


@entry
def read_turn(handle: int, figures: Vector, x: Vector, seen: Vector) -> bool:
    """Fill what was found: the unknowns, and the greatest value seen of each TurnMeasure.

    It is NaN if none was seen. False if there is no such question.
    """
    block = memory.recall(handle)
    if block == 0:
        return False
    asked = memory.group_at(TurnAsked, block + BASE)
    memory.copy_row(figures, asked.figures)
    memory.copy_row(x, asked.descent.x)
    for kind in range(turn_peaks.TURN_MEASURES):
        seen[kind] = math.nan
    if asked.figures[TurnTold.DOING] == TurnStage.ENDED and asked.figures[TurnTold.EXCEEDS] < math.inf:
        figures_of(asked.trial, x, seen)
        peaks = asked.descent.known
        for n in range(int(asked.descent.state[DescentState.KNOWN])):
            kind = int(peaks[n, PeakRow.KIND])
            if not seen[kind] >= peaks[n, PeakRow.VALUE]:
                seen[kind] = peaks[n, PeakRow.VALUE]
    return True


@entry
def judge_turn(handle: int, exact: Vector, exceeds: Vector) -> bool:
    """Fill the shares by which the exact figures of a turn, by TurnMeasure, exceed their limits.

    NaN where a figure is. False if there is no such question.
    """
    block = memory.recall(handle)
    if block == 0:
        return False
    for kind in range(turn_peaks.TURN_MEASURES):
        exceeds[kind] = exceeding(memory.group_at(TurnAsked, block + BASE).trial, kind, exact[kind])
    return True


@kernel
def spread(unknowns: int) -> float:
    """The root of y^(unknowns + 1) = y + 1, whose inverse powers spread points evenly."""
    y = 2.0
    for _ in range(60):
        y = (1.0 + y) ** (1.0 / (unknowns + 1))
    return y


@kernel
def strew(asked: TurnAsked) -> None:
    """Try the next sample; after the last of them, go on downhill from the best."""
    trial, x, figures = asked.trial, asked.descent.x, asked.figures
    free = 0
    for k in range(x.shape[0]):
        free += 1 if trial.high[k] > trial.low[k] else 0
    number, base, power = figures[TurnTold.NUMBER], spread(free), 1.0
    for k in range(x.shape[0]):
        if trial.high[k] > trial.low[k]:
            power /= base
        share = (0.5 + number * power) % 1.0
        x[k] = trial.low[k] + (trial.high[k] - trial.low[k]) * share
    figures[TurnTold.TRIED] += 1.0
    if look(trial, x, RATE_STEPS[0], False):
        worth = greatest(trial, True) + SOFT * max(greatest(trial, False), 0.0)
        enlist(asked, worth)
    figures[TurnTold.NUMBER] += 1.0
    figures[TurnTold.SHARE] = 0.5 * figures[TurnTold.NUMBER] / (STREWN * max(free, 1))
    if figures[TurnTold.NUMBER] >= STREWN * max(free, 1) or free == 0:
        figures[TurnTold.DOING], figures[TurnTold.NUMBER] = TurnStage.DOWNHILL, 0.0


@kernel
def enlist(asked: TurnAsked, worth: float) -> None:
    """Make x a start instead of one near it that is worse, or instead of the worst."""
    trial, x, starts = asked.trial, asked.descent.x, asked.starts
    place, unknowns = STARTS - 1, x.shape[0]
    for n in range(STARTS):
        apart = 0.0
        for k in range(unknowns):
            width = max(trial.high[k] - trial.low[k], 1e-9)
            apart = max(apart, abs(starts[n, k] - x[k]) / width)
        if apart < STARTS_APART and starts[n, turn_peaks.UNKNOWNS] < math.inf:
            if starts[n, turn_peaks.UNKNOWNS] <= worth:
                return
            place = n
            break
    if worth < starts[place, turn_peaks.UNKNOWNS]:
        for k in range(unknowns):
            starts[place, k] = x[k]
        starts[place, turn_peaks.UNKNOWNS] = worth
        sort_starts(starts)


@kernel
def sort_starts(starts: Table) -> None:
    """Let the best start be the first."""
    for n in range(1, STARTS):
        for m in range(n, 0, -1):
            if starts[m, turn_peaks.UNKNOWNS] < starts[m - 1, turn_peaks.UNKNOWNS]:
                for k in range(turn_peaks.UNKNOWNS + 1):
                    starts[m, k], starts[m - 1, k] = starts[m - 1, k], starts[m, k]


@kernel
def go_down(asked: TurnAsked) -> None:
    """Go one step downhill; at the end of a descent go on to the next start, or to finer evaluation."""
    figures, descent, trial, starts = asked.figures, asked.descent, asked.trial, asked.starts
    fine = 1 if figures[TurnTold.DOING] == TurnStage.CLOSELY else 0
    start = int(figures[TurnTold.NUMBER]) // (MOST_DESCENT_STEPS[1] + 2)
    steps = int(figures[TurnTold.NUMBER]) % (MOST_DESCENT_STEPS[1] + 2)
    figures[TurnTold.TRIED] += 1.0
    figures[TurnTold.NUMBER] += 1.0
    if steps == 0:
        descent.state[DescentState.MERIT] = math.inf
        if fine == 0 and not starts[start, turn_peaks.UNKNOWNS] < math.inf:
            return
        if fine == 0:
            for k in range(descent.x.shape[0]):
                descent.x[k] = starts[start, k]
        begin_at(trial, descent, TRUST[fine], RATE_STEPS[fine])
        return
    if steps <= MOST_DESCENT_STEPS[fine] and descend(trial, descent, RATE_STEPS[fine]):
        return
    if fine == 1:
        figures[TurnTold.DOING], figures[TurnTold.SHARE] = TurnStage.ENDED, 1.0
        worth = descent.state[DescentState.MERIT]
        figures[TurnTold.EXCEEDS] = descent.state[DescentState.EXCESS] if worth < math.inf else math.inf
        return
    for k in range(descent.x.shape[0]):
        starts[start, k] = descent.x[k]
    starts[start, turn_peaks.UNKNOWNS] = descent.state[DescentState.MERIT]
    figures[TurnTold.NUMBER] = (start + 1) * (MOST_DESCENT_STEPS[1] + 2)
    figures[TurnTold.SHARE] = 0.5 + 0.4 * (start + 1) / STARTS
    if start + 1 == STARTS:
        sort_starts(starts)
        figures[TurnTold.DOING], figures[TurnTold.NUMBER] = TurnStage.CLOSELY, 0.0
        for k in range(descent.x.shape[0]):
            descent.x[k] = starts[0, k]
