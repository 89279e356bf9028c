"""Downhill among turns, step by step: the best one by slopes of all peaks within a range of trust.

At each step the goal and the limits are taken for linear functions of the unknowns, each peak for one
of its own; the excess over limits counts HARD times. The best point of these lines within a range is
found by an interior-point method. It is taken where that makes the turn better, else the range is
narrowed. At a limit or where peaks meet, such steps close in on the best turn as Newton's do.
"""

import math
from typing import NamedTuple

from benchdragon.kernels import turn_peaks
from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.turn_peaks import PeakRow, Trial, TurnCount, TurnGiven, greatest
from benchdragon.kernels.turn_trial import lay_trial, look, narrow

# How much a limit counts that is exceeded by all of itself: more than what exceeding it may gain.
HARD = 30.0
# Unknowns of a step: those of a turn, and two more.
STEP_UNKNOWNS = turn_peaks.UNKNOWNS + 2


class StepUnknown(Numbered):
    """The unknowns of a step besides those of turns.

    What is sought, and by how much limits are exceeded.
    """

    BEST = turn_peaks.UNKNOWNS
    WORST = turn_peaks.UNKNOWNS + 1


# Rows of a step's lines: the peaks, both ends of each unknown's range, and no less than no excess.
# Behind the columns: what a row must be at least, by how much it is more, and how much that counts.
MOST_LINES = turn_peaks.MOST_KEPT + 2 * turn_peaks.UNKNOWNS + 1
LINE_COLUMNS = STEP_UNKNOWNS + 3


class LineColumn(Numbered):
    """Columns of a step's lines behind those of its unknowns."""

    LEAST = STEP_UNKNOWNS
    SPARE = STEP_UNKNOWNS + 1
    DUAL = STEP_UNKNOWNS + 2


# Steps of the interior point's method at most, how far it goes towards a border, by what its gap
# shrinks, and the gap at which it ends.
INNER, TOWARDS, SHRINK, GAP_CLOSED = 60, 0.95, 0.15, 1e-13
# By what share of its range an unknown is changed for slopes; how far peaks are sought from their
# places then, m, and how often that is narrowed.
SLOPE_CHANGE, PEAK_NEARBY, NARROWINGS = 1e-5, 4e-4, 26
# Of the gain that lines promise, the share that is enough to go there, and to trust them farther.
TAKEN, TRUSTED = 0.1, 0.7
# Ranges of trust, as shares of the unknowns' ranges: the widest, and one so narrow that the search
# ends; so does it where lines promise less gain.
WIDEST_RANGE, NARROWEST_RANGE, GAIN = 0.2, 1e-9, 1e-10
# An unknown so near an end of its range, as a share of that, stands there.
AT_END = 1e-9


class Descent(NamedTuple):
    """A point, what is known of it, and where it may go."""

    x: Vector  # the unknowns
    next: Vector
    move: Vector  # shares of the unknowns' ranges, and BEST and WORST
    known: Table  # peaks of the turn at x, as trial.peaks
    slopes: Table  # how their measures change with each unknown
    lines: Table  # (MOST_LINES, LINE_COLUMNS)
    normal: Table  # (STEP_UNKNOWNS, STEP_UNKNOWNS + 1)
    state: Vector


class DescentState(Numbered):
    """The state of a descent.

    How many peaks are known, what the turn is worth, by how much it exceeds limits, how far lines are
    trusted, and whether their slopes are known.
    """

    KNOWN, MERIT, EXCESS, TRUST, SLOPED = range(5)


DESCENT_STATE = len(DescentState)


@kernel
def merit(trial: Trial) -> float:
    """What is to be small: what is sought, and HARD times the greatest excess over a limit."""
    return greatest(trial, True) + HARD * max(greatest(trial, False), 0.0)


@kernel
def begin_at(trial: Trial, descent: Descent, trust: float, step: float) -> None:
    """Begin at x, and trust lines so far."""
    state = descent.state
    state[DescentState.MERIT] = merit(trial) if look(trial, descent.x, step, True) else math.inf
    state[DescentState.TRUST], state[DescentState.SLOPED] = trust, 0.0
    learn(trial, descent)


@kernel
def learn(trial: Trial, descent: Descent) -> None:
    """Keep the peaks of the trial, which is at x."""
    descent.state[DescentState.EXCESS] = max(greatest(trial, False), 0.0)
    noted = trial.counts[TurnCount.NOTED]
    descent.state[DescentState.KNOWN] = noted if noted <= turn_peaks.MOST_KEPT else 0
    for n in range(int(descent.state[DescentState.KNOWN])):
        for k in range(turn_peaks.PEAK_COLUMNS):
            descent.known[n, k] = trial.peaks[n, k]


@kernel
def set_slopes(trial: Trial, descent: Descent) -> None:
    """Fill the slopes by differences; 0 of unknowns without a range, or with no turn on either side."""
    x, aside = descent.x, descent.next
    for k in range(x.shape[0]):
        width = trial.high[k] - trial.low[k]
        side = 0.0
        for n in range(2 if width > 0.0 else 0):
            change = SLOPE_CHANGE * width * (1.0 if n == 0 else -1.0)
            for m in range(x.shape[0]):
                aside[m] = x[m]
            aside[k] += change
            if side == 0.0 and trial.low[k] <= aside[k] <= trial.high[k] and lay_trial(trial, aside):
                side = 1.0 if n == 0 else -1.0
                see_again(trial, descent)
                for m in range(int(descent.state[DescentState.KNOWN])):
                    rise = trial.peaks[m, PeakRow.MEASURE] - descent.known[m, PeakRow.MEASURE]
                    descent.slopes[m, k] = rise / (SLOPE_CHANGE * side)
        for m in range(int(descent.state[DescentState.KNOWN]) if side == 0.0 else 0):
            descent.slopes[m, k] = 0.0
    descent.state[DescentState.SLOPED] = 1.0


@kernel
def see_again(trial: Trial, descent: Descent) -> None:
    """Evaluate known peaks again, near their places, in a turn that differs little."""
    rows = trial.rows[: trial.counts[TurnCount.ROUTE]]
    for n in range(int(descent.state[DescentState.KNOWN])):
        for k in range(turn_peaks.PEAK_COLUMNS):
            trial.peaks[n, k] = descent.known[n, k]
        trial.peaks[n, PeakRow.VALUE] = -math.inf
        narrow(trial, rows, n, PEAK_NEARBY, NARROWINGS)


@kernel
def draw_lines(trial: Trial, descent: Descent) -> int:
    """Fill the lines that a step must keep to, and begin within them; returns how many there are."""
    x, z, lines, known, trust = (
        descent.x, descent.move, descent.lines, descent.known, descent.state[DescentState.TRUST],
    )  # fmt: skip
    count, peaks = 0, int(descent.state[DescentState.KNOWN])
    z[StepUnknown.BEST] = z[StepUnknown.WORST] = 0.0
    for n in range(MOST_LINES):
        for k in range(LINE_COLUMNS):
            lines[n, k] = 0.0
    for k in range(turn_peaks.UNKNOWNS):
        z[k] = 0.0
        width = trial.high[k] - trial.low[k] if k < x.shape[0] else 0.0
        down, up = -trust, trust
        if width > 0.0:
            down = max(down, (trial.low[k] - x[k]) / width)
            up = min(up, (trial.high[k] - x[k]) / width)
        z[k] = 0.5 * (down + up)
        lines[count, k], lines[count, LineColumn.LEAST] = 1.0, down
        lines[count + 1, k], lines[count + 1, LineColumn.LEAST] = -1.0, -up
        count += 2
    lines[count, StepUnknown.WORST] = 1.0
    count += 1
    for n in range(peaks):
        column = (
            StepUnknown.BEST
            if known[n, PeakRow.KIND] == trial.told[TurnGiven.SOUGHT]
            else StepUnknown.WORST
        )
        lines[count, column], lines[count, LineColumn.LEAST] = 1.0, known[n, PeakRow.MEASURE]
        there = known[n, PeakRow.MEASURE]
        for k in range(x.shape[0]):
            lines[count, k] = -descent.slopes[n, k]
            there += descent.slopes[n, k] * z[k]
        z[column] = max(z[column], there)
        count += 1
    z[StepUnknown.BEST], z[StepUnknown.WORST] = z[StepUnknown.BEST] + 1.0, z[StepUnknown.WORST] + 1.0
    return count


@kernel
def spare(descent: Descent, n: int) -> float:
    """By how much line n is more than its least."""
    found = -descent.lines[n, LineColumn.LEAST]
    for k in range(STEP_UNKNOWNS):
        found += descent.lines[n, k] * descent.move[k]
    return found


@kernel
def best_move(trial: Trial, descent: Descent) -> float:
    """Fill `move` with the best point of the lines; the merit that they promise there.

    By the primal-dual method: the lines' spare times their duals goes to 0, from a point within them.
    """
    lines, normal, z, count = descent.lines, descent.normal, descent.move, draw_lines(trial, descent)
    for n in range(count):
        lines[n, LineColumn.SPARE] = spare(descent, n)
        lines[n, LineColumn.DUAL] = 1.0 / lines[n, LineColumn.SPARE]
    for _ in range(INNER):
        gap = 0.0
        for n in range(count):
            gap += lines[n, LineColumn.SPARE] * lines[n, LineColumn.DUAL] / count
        if gap < GAP_CLOSED:
            break
        for i in range(STEP_UNKNOWNS):
            for j in range(STEP_UNKNOWNS + 1):
                normal[i, j] = 0.0
            normal[i, i] = 1e-13
        normal[StepUnknown.BEST, STEP_UNKNOWNS], normal[StepUnknown.WORST, STEP_UNKNOWNS] = -1.0, -HARD
        for n in range(count):
            add_line(descent, n, SHRINK * gap)
        solve(normal)
        length = share_inside(descent, count, SHRINK * gap)
        for n in range(count):
            rise, fall = line_changes(descent, n, SHRINK * gap)
            lines[n, LineColumn.SPARE] += length * rise
            lines[n, LineColumn.DUAL] += length * fall
        for k in range(STEP_UNKNOWNS):
            z[k] += length * normal[k, STEP_UNKNOWNS]
    return z[StepUnknown.BEST] + HARD * z[StepUnknown.WORST]


@kernel
def add_line(descent: Descent, n: int, aim: float) -> None:
    """Add to the normal equations what a line gives, whose spare times dual is to be `aim`."""
    line, normal = descent.lines[n], descent.normal
    weight = line[LineColumn.DUAL] / line[LineColumn.SPARE]
    for i in range(STEP_UNKNOWNS):
        if line[i] != 0.0:
            normal[i, STEP_UNKNOWNS] += line[i] * aim / line[LineColumn.SPARE]
            for j in range(STEP_UNKNOWNS):
                normal[i, j] += weight * line[i] * line[j]


@kernel
def line_changes(descent: Descent, n: int, aim: float) -> tuple[float, float]:
    """By how much a line's spare and dual are to change."""
    line = descent.lines[n]
    rise = 0.0
    for k in range(STEP_UNKNOWNS):
        rise += line[k] * descent.normal[k, STEP_UNKNOWNS]
    return rise, (
        aim - line[LineColumn.DUAL] * line[LineColumn.SPARE] - line[LineColumn.DUAL] * rise
    ) / line[LineColumn.SPARE]


@kernel
def share_inside(descent: Descent, count: int, aim: float) -> float:
    """The share of all changes at which no line's spare or dual comes nearer than allowed to 0."""
    share = 1.0
    for n in range(count):
        rise, fall = line_changes(descent, n, aim)
        if rise < 0.0:
            share = min(share, -TOWARDS * descent.lines[n, LineColumn.SPARE] / rise)
        if fall < 0.0:
            share = min(share, -TOWARDS * descent.lines[n, LineColumn.DUAL] / fall)
    return share


@kernel
def solve(table: FloatArray) -> None:
    """Let the last column of a table be the solution of its equations, by elimination."""
    size = table.shape[0]
    for k in range(size):
        top = k
        for i in range(k + 1, size):
            if abs(table[i, k]) > abs(table[top, k]):
                top = i
        for j in range(size + 1):
            table[k, j], table[top, j] = table[top, j], table[k, j]
        for i in range(size):
            if i != k and table[k, k] != 0.0:
                share = table[i, k] / table[k, k]
                for j in range(k, size + 1):
                    table[i, j] -= share * table[k, j]
    for k in range(size):
        table[k, size] = table[k, size] / table[k, k] if table[k, k] != 0.0 else 0.0


@kernel
def descend(trial: Trial, descent: Descent, step: float) -> bool:
    """Try one step from x; whether another may be worth while."""
    state, x, aside = descent.state, descent.x, descent.next
    if not state[DescentState.MERIT] < math.inf:
        return False
    if state[DescentState.SLOPED] == 0.0:
        set_slopes(trial, descent)
    promised, far = state[DescentState.MERIT] - best_move(trial, descent), 0.0
    if not promised > GAIN:
        return False
    for k in range(x.shape[0]):
        width = trial.high[k] - trial.low[k]
        aside[k] = x[k] + width * descent.move[k]
        if aside[k] < trial.low[k] + AT_END * width:
            aside[k] = trial.low[k]
        elif aside[k] > trial.high[k] - AT_END * width:
            aside[k] = trial.high[k]
        far = max(far, abs(descent.move[k])) if width > 0.0 else far
    found = merit(trial) if look(trial, aside, step, True) else math.inf
    if not state[DescentState.MERIT] - found >= TAKEN * promised:
        state[DescentState.TRUST] = min(0.5 * state[DescentState.TRUST], 0.4 * far)
        return state[DescentState.TRUST] > NARROWEST_RANGE
    if state[DescentState.MERIT] - found > TRUSTED * promised:
        state[DescentState.TRUST] = min(2.0 * state[DescentState.TRUST], WIDEST_RANGE)
    for k in range(x.shape[0]):
        x[k] = aside[k]
    state[DescentState.MERIT], state[DescentState.SLOPED] = found, 0.0
    learn(trial, descent)
    return True
