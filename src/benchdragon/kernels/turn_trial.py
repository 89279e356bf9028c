"""A turn on trial, laid on the ground: its figures along it, for a search of the best.

A turn's figures are sampled along it: where one is greatest among its neighbours is a peak
(kernels/turn_peaks.py), whose place is then narrowed. Only the first benches are evaluated: later ones
walk through as they do.
"""

import math

from benchdragon.kernels import box
from benchdragon.kernels import turn_families as families
from benchdragon.kernels.box import Box, box_distance, half_diagonal, inside, nearest_pair, place_box
from benchdragon.kernels.chain import Placements, rates_in_slot
from benchdragon.kernels.curve import FloatArray, RouteRow, curvature, place, spiral_length
from benchdragon.kernels.drive import DriveRate, value_at
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.family import pieces_fit
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.obstacle_contact import centre_distance
from benchdragon.kernels.route import locate
from benchdragon.kernels.route_parts import Pose, farthest, lay_rows, row_count
from benchdragon.kernels.status import TurnStatus
from benchdragon.kernels.turn_families import TurnPiece, three_pieces, turn_parts, two_arcs
from benchdragon.kernels.turn_peaks import (
    RATES,
    TURN_MEASURES,
    ArcFamily,
    PeakRow,
    Trial,
    TurnCount,
    TurnGiven,
    TurnMeasure,
    greatest,
    keep_greatest,
    measured,
    note,
)

# Rows of a trial's route at most.
MOST_ROWS = 64
# Benches whose rates are evaluated, and whose distances: one turn farther out is some 17 benches away.
FEW, MORE = 16, 40
# Head positions that are sampled in one block, and at most; the step at which distances of benches are
# sampled, as a share of the shortest link, and that for the turn's reach, m.
LOOK_SLOTS, MOST_LOOKS, CLEAR_SHARE, REACH_STEP = 64, 4096, 0.35, 0.1
# The cost of a handle at a place in handles placed, with its rates.
JUDGED = 2
# The figure of a turn on which the dragon cannot stand.
HOPELESS = 1e4
# How often a place is narrowed by the golden section to some 1e-10 m.
SECTION, NARROWED = 0.6180339887498949, 44


@kernel
def shape_figure(trial: Trial, kind: int, n: int) -> float:
    """The curvature of piece n, the length of the turn laid, or the whole way."""
    pieces, length = trial.pieces, 0.0
    if kind == TurnMeasure.BEND:
        return max(abs(pieces[n, TurnPiece.START]), abs(pieces[n, TurnPiece.END]))
    for m in range(trial.counts[TurnCount.PIECES]):
        length += pieces[m, TurnPiece.LENGTH]
    k, disc = trial.told[TurnGiven.PITCH] / (2.0 * math.pi), trial.told[TurnGiven.DISC]
    for joint in trial.joints if kind == TurnMeasure.WAY else trial.joints[:0]:
        if disc - joint > families.NEGLIGIBLE:
            length += spiral_length(k, disc / k) - spiral_length(k, joint / k)
    return length


@kernel
def lay_trial(trial: Trial, x: FloatArray) -> bool:
    """Lay the turn of these unknowns; False if there is none."""
    told, pieces, links = trial.told, trial.pieces, trial.links
    trial.counts[TurnCount.ROUTE] = 0
    ease = told[TurnGiven.EASE] if told[TurnGiven.EASE] == told[TurnGiven.EASE] else x[x.shape[0] - 1]
    if told[TurnGiven.FAMILY] == ArcFamily.TWO_ARCS:
        count, status = two_arcs(
            told[TurnGiven.PITCH], x[0], x[1], math.exp(x[2]), ease, trial.arcs, pieces
        )
    else:
        bend, last = (0.0, x[3]) if told[TurnGiven.FAMILY] == ArcFamily.LINE_BETWEEN else (x[3], x[4])
        count, status = three_pieces(
            told[TurnGiven.PITCH], x[0], x[1], x[2], bend, last, ease, trial.arcs, pieces
        )
    whole, longest = 0.0, 0.0
    for link in links:
        whole, longest = whole + link, max(longest, link)
    if status != TurnStatus.OK or not pieces_fit(pieces, count, longest):
        return False
    parts = trial.parts[: count + 2]
    turn_parts(told[TurnGiven.PITCH], x[0], x[1], whole + 1.0, 2.0 * whole + 1.0, pieces[:count], parts)
    wanted = row_count(parts)
    if wanted > MOST_ROWS:
        return False
    lay_rows(parts, Pose(0.0, 0.0, 0.0), 1, count + 1, trial.rows[:wanted])
    trial.counts[TurnCount.ROUTE], trial.counts[TurnCount.PIECES] = wanted, count
    trial.joints[0], trial.joints[1] = x[0], x[1]
    return True


@kernel
def distance_beside(trial: Trial, obstacle: int) -> float:
    """The distance of the bench in `boxes` from an obstacle, m; minus that on the wrong side."""
    boxes, least = trial.boxes, math.inf
    first, last = trial.border[obstacle], trial.border[obstacle + 1]
    x, y, around = boxes[0, Box.CX], boxes[0, Box.CY], half_diagonal(boxes, 0)
    for n in range(first, last):
        if centre_distance(trial.standing, n, x, y) - around < least:
            for k in range(box.BOX_COLUMNS):
                boxes[1, k] = trial.standing[n, k]
            least = min(least, box_distance(boxes, 0, 1))
    side = trial.keep[obstacle, 1]
    wrong = side != 0.0 and inside(trial.standing, first, last, x, y) == (side > 0.0)
    return -abs(least) if wrong else least


@kernel
def figure_at(trial: Trial, rows: FloatArray, kind: int, one: int, two: int, s: float) -> float:
    """A figure at a place: with the head at s, m, or of obstacles with the bench's front handle there.

    APART of bench -1 is the nearest pair of all, in counts[FIRST] and [SECOND].
    """
    alone = trial.alone
    if kind >= TurnMeasure.BEND:
        return shape_figure(trial, kind, one)
    if kind == TurnMeasure.REACH:
        j, u, _status = locate(rows, s)
        x, y, _tx, _ty = place(rows, j, u)
        return math.hypot(x, y)
    first, last = (two, two + 1) if kind == TurnMeasure.BESIDE else (0, one)
    if kind == TurnMeasure.APART:
        last = trial.links.shape[0] if one < 0 else two + 1
    elif kind == DriveRate.TURNING:  # of a bench, not of a handle
        last = one + 1
    links = trial.links[first:last]
    trial.at[0] = s
    trial.counts[TurnCount.PLACED] += last - first + 1
    if not place_chain(rows, links, trial.at, 0, 1, alone):
        return HOPELESS
    if kind in (TurnMeasure.APART, TurnMeasure.BESIDE):
        return shortfall(trial, kind, one, two)
    if kind != DriveRate.SPEEDS:
        set_rates(trial, rows, links, alone, 0)
    return known_rate(trial, rows, alone, kind, one, 0)


@kernel
def shortfall(trial: Trial, kind: int, one: int, two: int) -> float:
    """How far the distance of benches of the lone chain falls short of 0, or an obstacle's limit, m."""
    x, y, counts = trial.alone.x, trial.alone.y, trial.counts
    if kind == TurnMeasure.BESIDE:
        place_box(trial.sizes, two, 0, x, y, 0, trial.boxes, 0)
        return trial.keep[one, 0] - distance_beside(trial, one)
    if one < 0:
        distance, _time, counts[TurnCount.FIRST], counts[TurnCount.SECOND] = nearest_pair(
            trial.sizes, x, y
        )
        return -distance
    place_box(trial.sizes, one, one, x, y, 0, trial.boxes, 0)
    place_box(trial.sizes, two, two, x, y, 0, trial.boxes, 1)
    return -box_distance(trial.boxes, 0, 1)


@kernel
def set_rates(trial: Trial, rows: FloatArray, links: FloatArray, places: Placements, t: int) -> None:
    """Fill slot t of the rates' changes and turnings."""
    rates_in_slot(
        rows, links, t, places.row, places.u, places.x, places.y, places.ratio, trial.change, trial.turn
    )


@kernel
def known_rate(trial: Trial, rows: FloatArray, places: Placements, kind: int, i: int, t: int) -> float:
    """A rate of a handle, or of the bench behind it, in slot t, whose changes are known."""
    if kind == DriveRate.SPEEDS:
        return places.ratio[i, t]
    bend = curvature(rows, places.row[i, t], places.u[i, t])
    return value_at(places.ratio[i, t], trial.change[i, t], trial.turn[i, t], bend, 1.0, 0.0, kind)


@kernel
def judges(trial: Trial, kind: int) -> bool:
    """Whether a rate is limited or sought."""
    return kind == trial.told[TurnGiven.SOUGHT] or trial.told[TurnGiven.LIMIT + kind] < math.inf


@kernel
def look_at_rates(trial: Trial, rows: FloatArray, first: float, last: float, step: float) -> bool:
    """Record peaks of rates with the head from first to last, m; whether the dragon can stand there."""
    places, at, latest = trial.places, trial.at, trial.latest
    handles = places.x.shape[0]
    links, count, curved = trial.links[: handles - 1], looks(first, last, step), False
    for kind in range(1, RATES):
        curved = curved or judges(trial, kind)
    for n in range(2 * RATES):
        for i in range(handles):
            latest[n, i] = -math.inf
    for start in range(0, count, LOOK_SLOTS):
        stop = min(LOOK_SLOTS, count - start)
        for t in range(stop):
            at[t] = first + (last - first) * (start + t) / (count - 1)
        trial.counts[TurnCount.PLACED] += stop * handles * (JUDGED if curved else 1)
        if not place_chain(rows, links, at, 0, stop, places):
            return False
        for t in range(stop):
            if curved:
                set_rates(trial, rows, links, places, t)
            before = first + (last - first) * (start + t - 1) / (count - 1)
            note_rates(trial, rows, t, before)
    return True


@kernel
def looks(first: float, last: float, step: float) -> int:
    """The number of samples from first to last, m, about a step apart."""
    return int(min(math.ceil((last - first) / step) + 2, MOST_LOOKS))


@kernel
def note_rates(trial: Trial, rows: FloatArray, t: int, before: float) -> None:
    """Record peaks of rates at the place before that of slot t, m."""
    places, latest = trial.places, trial.latest
    handles = places.x.shape[0]
    for kind in range(RATES):
        if judges(trial, kind):
            for i in range(handles - 1 if kind == DriveRate.TURNING else handles):
                value = (
                    places.ratio[i, t]
                    if kind == DriveRate.SPEEDS
                    else known_rate(trial, rows, places, kind, i, t)
                )
                if latest[2 * kind, i] >= max(latest[2 * kind + 1, i], value):
                    note(trial, kind, i, 0, before, latest[2 * kind, i])
                latest[2 * kind + 1, i], latest[2 * kind, i] = latest[2 * kind, i], value


@kernel
def look_along(
    trial: Trial, rows: FloatArray, kind: int, one: int, two: int, first: float, last: float,
    step: float,
) -> float:  # fmt: skip
    """Record peaks of a figure from first to last, m; returns the greatest sample."""
    count, before, value, at, i, j = looks(first, last, step), -math.inf, -math.inf, first, one, two
    most = -math.inf
    for n in range(count + 1):
        s = first + (last - first) * n / (count - 1)
        ahead = figure_at(trial, rows, kind, one, two, s) if n < count else -math.inf
        if value >= max(before, ahead) and value > -math.inf:
            note(trial, kind, i, j, at, value)
        before, value, at, most = value, ahead, s, max(most, ahead)
        if kind == TurnMeasure.APART:
            i, j = trial.counts[TurnCount.FIRST], trial.counts[TurnCount.SECOND]
    return most


@kernel
def narrow(trial: Trial, rows: FloatArray, n: int, half: float, times: int) -> None:
    """Let peak n be the greatest that a golden section finds up to `half` metres from its place."""
    peaks = trial.peaks
    kind, one, two = int(peaks[n, PeakRow.KIND]), int(peaks[n, PeakRow.ONE]), int(peaks[n, PeakRow.TWO])
    if kind >= TurnMeasure.BEND:
        half, times = 0.0, 0
    low, high = peaks[n, PeakRow.PLACE] - half, peaks[n, PeakRow.PLACE] + half
    if kind == TurnMeasure.REACH:
        low = max(low, rows[1, RouteRow.S_START])
        high = min(high, rows[rows.shape[0] - 1, RouteRow.S_START])
    a, b = high - SECTION * (high - low), low + SECTION * (high - low)
    at_a, at_b = figure_at(trial, rows, kind, one, two, a), figure_at(trial, rows, kind, one, two, b)
    for _ in range(times):
        if at_a >= at_b:
            high, b, at_b = b, a, at_a
            a = high - SECTION * (high - low)
            at_a = figure_at(trial, rows, kind, one, two, a)
        else:
            low, a, at_a = a, b, at_b
            b = low + SECTION * (high - low)
            at_b = figure_at(trial, rows, kind, one, two, b)
    if max(at_a, at_b) >= peaks[n, PeakRow.VALUE]:
        peaks[n, PeakRow.PLACE] = a if at_a >= at_b else b
    peaks[n, PeakRow.VALUE] = max(at_a, at_b, peaks[n, PeakRow.VALUE])
    peaks[n, PeakRow.MEASURE] = measured(trial, kind, peaks[n, PeakRow.VALUE])


@kernel
def same_before(sizes: FloatArray, i: int) -> bool:
    """Whether a bench before bench i has its sizes."""
    for j in range(i):
        same = 0
        for n in range(4):
            same += 1 if sizes[n, i] == sizes[n, j] else 0
        if same == 4:
            return True
    return False


@kernel
def measures(links: FloatArray) -> tuple[float, float]:
    """The sum of some links, and the shortest, m."""
    whole, shortest = 0.0, math.inf
    for link in links:
        whole, shortest = whole + link, min(shortest, link)
    return whole, shortest


@kernel
def look_apart(trial: Trial, rows: FloatArray) -> float:
    """Record where benches come near one another; minus the least sampled distance, m."""
    first, last = rows[1, RouteRow.S_START], rows[rows.shape[0] - 1, RouteRow.S_START]
    whole, shortest = measures(trial.links)
    return look_along(
        trial, rows, TurnMeasure.APART, -1, 0, first, last + whole, CLEAR_SHARE * shortest
    )


@kernel
def figures_of(trial: Trial, x: FloatArray, seen: FloatArray) -> None:
    """Fill the figures of the turn of these unknowns that need no rates, sampled: see `TurnMeasure`."""
    if lay_trial(trial, x):
        rows = trial.rows[: trial.counts[TurnCount.ROUTE]]
        trial.counts[TurnCount.NOTED] = 0
        seen[TurnMeasure.BEND] = 0.0
        first, last = rows[1, RouteRow.S_START], rows[rows.shape[0] - 1, RouteRow.S_START]
        for n in range(trial.counts[TurnCount.PIECES]):
            seen[TurnMeasure.BEND] = max(
                seen[TurnMeasure.BEND], shape_figure(trial, TurnMeasure.BEND, n)
            )
        seen[TurnMeasure.LONG], seen[TurnMeasure.WAY] = (
            shape_figure(trial, TurnMeasure.LONG, 0),
            shape_figure(trial, TurnMeasure.WAY, 0),
        )
        seen[TurnMeasure.REACH] = farthest(rows, first, last, families.REACH_LOOK)
        seen[TurnMeasure.APART] = look_apart(trial, rows)


@kernel
def look_at_distances(trial: Trial, rows: FloatArray) -> None:
    """Record where benches come near one another, and obstacles."""
    first = rows[1, RouteRow.S_START]
    last = rows[rows.shape[0] - 1, RouteRow.S_START]
    few = trial.places.x.shape[0] - 1
    fore, shortest = measures(trial.links[:few])
    look_apart(trial, rows)
    for obstacle in range(trial.keep.shape[0]):
        for i in range(few):
            if not same_before(trial.sizes, i):
                step = CLEAR_SHARE * shortest
                look_along(trial, rows, TurnMeasure.BESIDE, obstacle, i, first - fore, last, step)


@kernel
def look(trial: Trial, x: FloatArray, step: float, whole: bool) -> bool:
    """Record the peaks of the turn of these unknowns; whether the dragon can walk through it.

    Rates are evaluated each `step` of the shortest link. With `whole`, peaks are narrowed; otherwise
    distances are sampled only where all other limits are kept.
    """
    if not lay_trial(trial, x):
        return False
    rows = trial.rows[: trial.counts[TurnCount.ROUTE]]
    peaks = trial.peaks
    trial.counts[TurnCount.NOTED] = 0
    first, last = rows[1, RouteRow.S_START], rows[rows.shape[0] - 1, RouteRow.S_START]
    fore, shortest = measures(trial.links[: trial.places.x.shape[0] - 1])
    for kind in range(TurnMeasure.BEND, TURN_MEASURES):
        for n in range(trial.counts[TurnCount.PIECES] if kind == TurnMeasure.BEND else 1):
            note(trial, kind, n, 0, first, shape_figure(trial, kind, n))
    look_along(trial, rows, TurnMeasure.REACH, 0, 0, first, last, REACH_STEP)
    if not look_at_rates(trial, rows, first, last + fore, step * shortest):
        return False
    if whole or greatest(trial, False) <= 0.0:
        look_at_distances(trial, rows)
    if whole:
        keep_greatest(trial)
        for n in range(trial.counts[TurnCount.NOTED]):
            half = (step if peaks[n, PeakRow.KIND] < RATES else CLEAR_SHARE) * shortest
            narrow(
                trial,
                rows,
                n,
                REACH_STEP if peaks[n, PeakRow.KIND] == TurnMeasure.REACH else half,
                NARROWED,
            )
    return True
