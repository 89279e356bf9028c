"""Downhill among turns, step by step: the best one by slopes of all peaks within a range of trust.

At each step what is sought and what is limited are taken for straight lines of the unknowns, each peak
for one of its own; how far limits are exceeded counts HARD times. The best point of these lines within
a range is an interior-point method's. It is taken where that makes the turn better, else the range is
narrowed. At a limit or where peaks meet, such steps close in on the best turn as Newton's do.
"""

import math
from typing import NamedTuple

from benchdragon.kernels import turn_trial
from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.turn_trial import Trial, greatest, lay_trial, look, narrow

# How much a limit counts that is exceeded by all of itself: more than what exceeding it may gain.
HARD = 30.0
# The unknowns of a step besides those of turns: what is sought, and by how much limits are exceeded.
BEST, WORST, COLUMNS = turn_trial.UNKNOWNS, turn_trial.UNKNOWNS + 1, turn_trial.UNKNOWNS + 2
# Rows of a step's lines: the peaks, both ends of each unknown's range, and no less than no excess.
# Behind the columns: what a row must be at least, by how much it is more, and how much that counts.
MOST_LINES = turn_trial.MOST_KEPT + 2 * turn_trial.UNKNOWNS + 1
LEAST, SPARE, DUAL, LINE = COLUMNS, COLUMNS + 1, COLUMNS + 2, COLUMNS + 3
# Steps of the interior point's method at most, how far it goes towards a border, by what its gap
# shrinks, and the gap at which it ends.
INNER, TOWARDS, SHRINK, CLOSED = 60, 0.95, 0.15, 1e-13
# By what share of its range an unknown is changed for slopes; how far peaks are sought from their
# places then, m, and how often that is narrowed.
CHANGE, NEARBY, NARROWED = 1e-5, 4e-4, 26
# Of the gain that lines promise, the share that is enough to go there, and to trust them farther.
TAKEN, TRUSTED = 0.1, 0.7
# Ranges of trust, as shares of the unknowns' ranges: the widest, and one so narrow that the search
# ends; so does it where lines promise less gain.
WIDEST, NARROWEST_RANGE, GAIN = 0.2, 1e-9, 1e-10
# An unknown so near an end of its range, as a share of that, stands there.
BESIDE = 1e-9


class Descent(NamedTuple):
    """A point, what is known of it, and where it may go."""

    x: Vector  # the unknowns
    next: Vector
    move: Vector  # shares of the unknowns' ranges, and BEST and WORST
    known: Table  # peaks of the turn at x, as trial.peaks
    slopes: Table  # how their measures change with each unknown
    lines: Table  # (MOST_LINES, LINE)
    normal: Table  # (COLUMNS, COLUMNS + 1)
    state: Vector


# The state of a descent: how many peaks are known, what the turn is worth, by how much it exceeds
# limits, how far lines are trusted, and whether their slopes are known.
KNOWN, MERIT, EXCESS, TRUST, SLOPED, STATE = 0, 1, 2, 3, 4, 5


@kernel
def merit(trial: Trial) -> float:
    """What is to be small: what is sought, and HARD times what exceeds a limit most."""
    return greatest(trial, True) + HARD * max(greatest(trial, False), 0.0)


@kernel
def begin_at(trial: Trial, descent: Descent, trust: float, step: float) -> None:
    """Begin at x, and trust lines so far."""
    state = descent.state
    state[MERIT] = merit(trial) if look(trial, descent.x, step, True) else math.inf
    state[TRUST], state[SLOPED] = trust, 0.0
    learn(trial, descent)


@kernel
def learn(trial: Trial, descent: Descent) -> None:
    """Keep the peaks of the trial, which is at x."""
    descent.state[EXCESS] = max(greatest(trial, False), 0.0)
    noted = trial.counts[turn_trial.NOTED]
    descent.state[KNOWN] = noted if noted <= turn_trial.MOST_KEPT else 0
    for n in range(int(descent.state[KNOWN])):
        for k in range(turn_trial.PEAK):
            descent.known[n, k] = trial.peaks[n, k]


@kernel
def set_slopes(trial: Trial, descent: Descent) -> None:
    """Fill the slopes by differences; 0 of unknowns without a range, or with no turn on either side."""
    x, aside = descent.x, descent.next
    for k in range(x.shape[0]):
        width = trial.high[k] - trial.low[k]
        side = 0.0
        for n in range(2 if width > 0.0 else 0):
            change = CHANGE * width * (1.0 if n == 0 else -1.0)
            for m in range(x.shape[0]):
                aside[m] = x[m]
            aside[k] += change
            if side == 0.0 and trial.low[k] <= aside[k] <= trial.high[k] and lay_trial(trial, aside):
                side = 1.0 if n == 0 else -1.0
                see_again(trial, descent)
                for m in range(int(descent.state[KNOWN])):
                    rise = trial.peaks[m, turn_trial.MEASURE] - descent.known[m, turn_trial.MEASURE]
                    descent.slopes[m, k] = rise / (CHANGE * side)
        for m in range(int(descent.state[KNOWN]) if side == 0.0 else 0):
            descent.slopes[m, k] = 0.0
    descent.state[SLOPED] = 1.0


@kernel
def see_again(trial: Trial, descent: Descent) -> None:
    """Look at known peaks, near their places, in a turn that is hardly another."""
    rows = trial.rows[: trial.counts[turn_trial.ROUTE]]
    for n in range(int(descent.state[KNOWN])):
        for k in range(turn_trial.PEAK):
            trial.peaks[n, k] = descent.known[n, k]
        trial.peaks[n, turn_trial.VALUE] = -math.inf
        narrow(trial, rows, n, NEARBY, NARROWED)


@kernel
def draw_lines(trial: Trial, descent: Descent) -> int:
    """Fill what a step must keep, and begin within it; how many lines that are."""
    x, z, lines, known, trust = (
        descent.x, descent.move, descent.lines, descent.known, descent.state[TRUST],
    )  # fmt: skip
    count, peaks = 0, int(descent.state[KNOWN])
    z[BEST] = z[WORST] = 0.0
    for n in range(MOST_LINES):
        for k in range(LINE):
            lines[n, k] = 0.0
    for k in range(turn_trial.UNKNOWNS):
        z[k] = 0.0
        width = trial.high[k] - trial.low[k] if k < x.shape[0] else 0.0
        down, up = -trust, trust
        if width > 0.0:
            down = max(down, (trial.low[k] - x[k]) / width)
            up = min(up, (trial.high[k] - x[k]) / width)
        z[k] = 0.5 * (down + up)
        lines[count, k], lines[count, LEAST] = 1.0, down
        lines[count + 1, k], lines[count + 1, LEAST] = -1.0, -up
        count += 2
    lines[count, WORST] = 1.0
    count += 1
    for n in range(peaks):
        column = BEST if known[n, turn_trial.KIND] == trial.told[turn_trial.SOUGHT] else WORST
        lines[count, column], lines[count, LEAST] = 1.0, known[n, turn_trial.MEASURE]
        there = known[n, turn_trial.MEASURE]
        for k in range(x.shape[0]):
            lines[count, k] = -descent.slopes[n, k]
            there += descent.slopes[n, k] * z[k]
        z[column] = max(z[column], there)
        count += 1
    z[BEST], z[WORST] = z[BEST] + 1.0, z[WORST] + 1.0
    return count


@kernel
def spare(descent: Descent, n: int) -> float:
    """By how much line n is more than its least."""
    found = -descent.lines[n, LEAST]
    for k in range(COLUMNS):
        found += descent.lines[n, k] * descent.move[k]
    return found


@kernel
def best_move(trial: Trial, descent: Descent) -> float:
    """Fill `move` with the best point of the lines; the merit that they promise there.

    By the primal-dual method: the lines' spare times their duals goes to 0, from a point within them.
    """
    lines, normal, z, count = descent.lines, descent.normal, descent.move, draw_lines(trial, descent)
    for n in range(count):
        lines[n, SPARE] = spare(descent, n)
        lines[n, DUAL] = 1.0 / lines[n, SPARE]
    for _ in range(INNER):
        gap = 0.0
        for n in range(count):
            gap += lines[n, SPARE] * lines[n, DUAL] / count
        if gap < CLOSED:
            break
        for i in range(COLUMNS):
            for j in range(COLUMNS + 1):
                normal[i, j] = 0.0
            normal[i, i] = 1e-13
        normal[BEST, COLUMNS], normal[WORST, COLUMNS] = -1.0, -HARD
        for n in range(count):
            add_line(descent, n, SHRINK * gap)
        solve(normal)
        length = share_inside(descent, count, SHRINK * gap)
        for n in range(count):
            rise, fall = line_changes(descent, n, SHRINK * gap)
            lines[n, SPARE] += length * rise
            lines[n, DUAL] += length * fall
        for k in range(COLUMNS):
            z[k] += length * normal[k, COLUMNS]
    return z[BEST] + HARD * z[WORST]


@kernel
def add_line(descent: Descent, n: int, aim: float) -> None:
    """Add to the normal equations what a line gives, whose spare times dual is to be `aim`."""
    line, normal = descent.lines[n], descent.normal
    weight = line[DUAL] / line[SPARE]
    for i in range(COLUMNS):
        if line[i] != 0.0:
            normal[i, COLUMNS] += line[i] * aim / line[SPARE]
            for j in range(COLUMNS):
                normal[i, j] += weight * line[i] * line[j]


@kernel
def line_changes(descent: Descent, n: int, aim: float) -> tuple[float, float]:
    """By how much a line's spare and dual are to change."""
    line = descent.lines[n]
    rise = 0.0
    for k in range(COLUMNS):
        rise += line[k] * descent.normal[k, COLUMNS]
    return rise, (aim - line[DUAL] * line[SPARE] - line[DUAL] * rise) / line[SPARE]


@kernel
def share_inside(descent: Descent, count: int, aim: float) -> float:
    """The share of all changes at which no line's spare or dual comes nearer than allowed to 0."""
    share = 1.0
    for n in range(count):
        rise, fall = line_changes(descent, n, aim)
        if rise < 0.0:
            share = min(share, -TOWARDS * descent.lines[n, SPARE] / rise)
        if fall < 0.0:
            share = min(share, -TOWARDS * descent.lines[n, DUAL] / fall)
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
    if not state[MERIT] < math.inf:
        return False
    if state[SLOPED] == 0.0:
        set_slopes(trial, descent)
    promised, far = state[MERIT] - best_move(trial, descent), 0.0
    if not promised > GAIN:
        return False
    for k in range(x.shape[0]):
        width = trial.high[k] - trial.low[k]
        aside[k] = x[k] + width * descent.move[k]
        if aside[k] < trial.low[k] + BESIDE * width:
            aside[k] = trial.low[k]
        elif aside[k] > trial.high[k] - BESIDE * width:
            aside[k] = trial.high[k]
        far = max(far, abs(descent.move[k])) if width > 0.0 else far
    found = merit(trial) if look(trial, aside, step, True) else math.inf
    if not state[MERIT] - found >= TAKEN * promised:
        state[TRUST] = min(0.5 * state[TRUST], 0.4 * far)
        return state[TRUST] > NARROWEST_RANGE
    if state[MERIT] - found > TRUSTED * promised:
        state[TRUST] = min(2.0 * state[TRUST], WIDEST)
    for k in range(x.shape[0]):
        x[k] = aside[k]
    state[MERIT], state[SLOPED] = found, 0.0
    learn(trial, descent)
    return True
