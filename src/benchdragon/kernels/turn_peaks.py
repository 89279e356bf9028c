"""How a turn on trial compares with its limits: its figures, and the peaks that are recorded of them.

Each peak counts by itself, as the greatest of all has edges where one peak takes over from another.
"""

from typing import NamedTuple

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.drive import DriveRate
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.numbered import Numbered

RATES = len(DriveRate)


class TurnMeasure(DriveRate):
    """The figures of a turn.

    The rates of drive come first, with the head at 1 m/s; then how near benches come to one another and
    to obstacles (less than nothing, and less what they must keep, m), how far the turn reaches from the
    middle, m, how it bends, 1/m, its length, and the whole way in the disc, m.
    """

    APART, BESIDE, REACH, BEND, LONG, WAY = range(5, 11)


TURN_MEASURES = len(TurnMeasure)
# At most.
UNKNOWNS = 6


class ArcFamily(Numbered):
    """Families of turns.

    They differ in the unknowns between the joints' radii and the clothoids' length: the logarithm of
    the ratio; two radii; a radius, a curvature and a radius.
    """

    TWO_ARCS, LINE_BETWEEN, ARC_BETWEEN = range(3)


class TurnGiven(Numbered):
    """What a host passes with a question, a row of floats; EASE is NaN if it is an unknown."""

    FAMILY, EASE, PITCH, DISC, NARROWEST, LONGEST, LONGEST_WAY, HEAD, MARGIN, SOUGHT = range(10)
    LIMIT = 10  # the greatest that is allowed of each rate, infinite where anything is


TURN_GIVEN = TurnGiven.LIMIT + RATES


class PeakRow(Numbered):
    """A peak of what a turn is judged by.

    What it is of, which bench or handle (or obstacle and bench), its place, value and `measured` value.
    """

    KIND, ONE, TWO, PLACE, VALUE, MEASURE = range(6)


PEAK_COLUMNS = len(PeakRow)
# The most peaks that are recorded, and that are kept of those whose measure is so near the greatest.
MOST_NOTED, MOST_KEPT, NEAR_GREATEST = 256, 48, 0.08


class TurnCount(Numbered):
    """Counts of a trial."""

    ROUTE, PIECES, NOTED, FIRST, SECOND, PLACED = range(6)


TURN_COUNTS = len(TurnCount)


class Trial(NamedTuple):
    """Turns on trial, the last one laid, and its peaks."""

    told: Vector
    low: Vector  # ranges of the unknowns
    high: Vector
    factors: Vector  # (TURN_MEASURES,): a true one is so many times what is seen; of distances, m less
    sizes: Table  # (4, benches) of the first benches, MORE at most
    links: Vector
    standing: Table  # boxes of all obstacles, one after another, as the turn lies
    border: IntVector  # (obstacles + 1,): where those of each begin
    keep: Table  # (obstacles, 2): what benches keep from the boxes, m; 1: none inside, -1: none outside
    arcs: Table
    pieces: Table
    parts: Table
    rows: Table
    at: Vector  # (LOOK_SLOTS,)
    places: Placements  # of the first FEW benches
    change: Table
    turn: Table
    alone: Placements  # of all, at one place
    boxes: Table  # (2, BOX_COLUMNS)
    latest: Table  # (2 * RATES, handles): the rates seen before, and before that
    joints: Vector  # the radii of both, m
    peaks: Table  # (MOST_NOTED, PEAK_COLUMNS)
    counts: IntVector


@kernel
def exceeding(trial: Trial, kind: int, value: float) -> float:
    """The share by which a figure exceeds its limit; of distances, the share of a bench's width."""
    told = trial.told
    if kind < RATES:
        power = 1.0 if kind <= DriveRate.TURNING else 2.0  # of the head's speed
        return value * told[TurnGiven.HEAD] ** power / told[TurnGiven.LIMIT + kind] - 1.0
    if kind in (TurnMeasure.APART, TurnMeasure.BESIDE):
        kept = told[TurnGiven.MARGIN] if kind == TurnMeasure.APART else 0.0
        return (value + kept) / trial.sizes[1, 0]
    if kind == TurnMeasure.REACH:
        return value / told[TurnGiven.DISC] - 1.0
    if kind == TurnMeasure.BEND:
        return value * told[TurnGiven.NARROWEST] - 1.0
    longest = told[TurnGiven.LONGEST] if kind == TurnMeasure.LONG else told[TurnGiven.LONGEST_WAY]
    return value / longest - 1.0


@kernel
def measured(trial: Trial, kind: int, value: float) -> float:
    """The measure of what is sought, about 1; of others, the share by which they exceed a limit."""
    told, factor = trial.told, trial.factors[kind]
    if kind != told[TurnGiven.SOUGHT]:
        apart = kind in (TurnMeasure.APART, TurnMeasure.BESIDE)
        return exceeding(trial, kind, value + factor if apart else value * factor)
    scale = 1.0 / told[TurnGiven.DISC]
    if kind == DriveRate.TOTAL:
        scale = told[TurnGiven.NARROWEST]
    elif kind == DriveRate.SPEEDS:
        scale = 1.0
    return factor * value * scale


@kernel
def note(trial: Trial, kind: int, one: int, two: int, s: float, value: float) -> None:
    """Record a peak, in the place of the least one if there is no room."""
    peaks, counts, measure = trial.peaks, trial.counts, measured(trial, kind, value)
    if kind != trial.told[TurnGiven.SOUGHT] and not measure > -2.0 * NEAR_GREATEST:
        return
    n = counts[TurnCount.NOTED]
    if n < MOST_NOTED:
        counts[TurnCount.NOTED] += 1
    else:
        n = 0
        for m in range(1, MOST_NOTED):
            if peaks[m, PeakRow.MEASURE] < peaks[n, PeakRow.MEASURE]:
                n = m
        if measure <= peaks[n, PeakRow.MEASURE]:
            return
    peaks[n, PeakRow.KIND] = kind
    peaks[n, PeakRow.ONE] = one
    peaks[n, PeakRow.TWO] = two
    peaks[n, PeakRow.PLACE] = s
    peaks[n, PeakRow.VALUE], peaks[n, PeakRow.MEASURE] = value, measure


@kernel
def greatest(trial: Trial, sought: bool) -> float:
    """The greatest measure recorded: of what is sought, or of what is limited, -1 or more."""
    most = -1.0
    for n in range(trial.counts[TurnCount.NOTED]):
        if (trial.peaks[n, PeakRow.KIND] == trial.told[TurnGiven.SOUGHT]) == sought:
            most = max(most, trial.peaks[n, PeakRow.MEASURE])
    return most


@kernel
def keep_greatest(trial: Trial) -> None:
    """Drop peaks that are far less than the greatest, and all but MOST_KEPT."""
    peaks, counts, kept = trial.peaks, trial.counts, 0
    best, worst = greatest(trial, True), max(greatest(trial, False), 0.0)
    for n in range(counts[TurnCount.NOTED]):
        sought = peaks[n, PeakRow.KIND] == trial.told[TurnGiven.SOUGHT]
        near = best * (1.0 - NEAR_GREATEST) if sought else worst - NEAR_GREATEST
        if peaks[n, PeakRow.MEASURE] >= near:
            swap(peaks, kept, n)
            for m in range(kept, 0, -1):
                if rank(trial, m) > rank(trial, m - 1):
                    swap(peaks, m, m - 1)
            kept += 1
    counts[TurnCount.NOTED] = min(kept, MOST_KEPT)


@kernel
def rank(trial: Trial, n: int) -> float:
    """The rank of a peak for being kept: what is sought comes first."""
    first = MOST_NOTED if trial.peaks[n, PeakRow.KIND] == trial.told[TurnGiven.SOUGHT] else 0
    return first + trial.peaks[n, PeakRow.MEASURE]


@kernel
def swap(table: FloatArray, i: int, j: int) -> None:
    """Change two rows for one another."""
    for k in range(table.shape[1]):
        table[i, k], table[j, k] = table[j, k], table[i, k]
