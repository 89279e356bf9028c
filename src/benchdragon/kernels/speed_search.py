"""The greatest of a quantity over a walk: branch and bound over the head's place, best bound first.

Parts of the head's way wait in a heap by their upper bounds. The greatest is processed first: long
parts by the cells of the route (bench_cells.py), short ones by chains at their ends and at places in
between, whose values are what is seen. Only the links that may still exceed it go with a part. The
search is over when no bound exceeds the greatest value seen by more than the tolerance.
"""

import math
from typing import NamedTuple

from benchdragon.kernels.arrays import IntTable, IntVector, Table, Vector
from benchdragon.kernels.bench_cells import Cells, bound_by_cells
from benchdragon.kernels.chain import Placements, rates_in_slot
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.drive import DriveRate, DriveStep, Scratch, bound_step, greatest_in_slot
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.motion_bounds import place_chain
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.rate_rounding import Errors, bend_errors, rate_errors, weigh_values
from benchdragon.kernels.rounding import mark_lanes, ratio_errors
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.status import Ended


class PartSpan(Numbered):
    """Columns of a part that waits: its bound, and the head's positions that it lies between, m."""

    BOUND, START, END = range(3)


class PartFact(Numbered):
    """Facts about a part that waits, whole numbers.

    The stretch of the drive that it belongs to, the links that may exceed what is seen, and whether
    cells (1) or chains (0) bound it next.
    """

    STRETCH, LINKS, BY_CELLS = range(3)


PART_FACTS = len(PartFact)


class PartCut(Numbered):
    """Facts about a part of a batch besides: the first of its slots, and into how many it is cut."""

    SLOT, PIECES = 0, 1


class SpeedNote(Numbered):
    """The state of a search, a row of floats."""

    SEEN = 0  # the greatest value at any chain; -1 before the first
    WHERE = 1  # the head's position there, m
    UPPER = 2  # upper bound of the parts that were given up
    SURE = 3  # a value that is exactly reached or exceeded
    # the greatest value seen where rounding hides no handle's side of a jump, if sides matter
    SIDED = 4


SPEED_NOTES = len(SpeedNote)


class SpeedCount(Numbered):
    """Counts of a search, a row of whole numbers."""

    OPEN = 0  # parts that wait
    ROW = 1  # the handle or bench that was seen
    WHEN = 2  # on which stretch
    EVALUATIONS = 3  # chains placed


SPEED_COUNTS = len(SpeedCount)

# Chains that are placed at a time, and the parts into which a step is cut that is bounded again.
CHAIN_SLOTS, STEP_SHARES = 16, 2
# Parts that a long way is cut into at most, and a step of the cells at least.
MOST_PART_PIECES, CELL_SHARES = CHAIN_SLOTS - 1, 4
# The rounding error of a step's length, as a share.
LENGTH_ROUNDING = 1.0 + 1e-9
# Values up to this, in SI units, count as nothing: with the rounding errors 1e-9.
NOTHING = 0.999e-9
# The bracket's width where a limit is kept, as a share of the value, and of the limit at most.
ROUGHLY, LITTLE = 1e-2, 1e-2
# The cost of a bound on a handle by cells, in handles placed.
CELL_COST = 0.125


class SpeedAim(NamedTuple):
    """The goal of a search, and the longest steps, m, that cells and chains bound."""

    quantity: int
    tolerance: float
    limit: float
    cell_step: float
    step: float


class Drives(NamedTuple):
    """Stretches of one acceleration of the head."""

    ways: Table  # from where to where, m, (stretches, 2)
    squares: Table  # of the head's speed there, m^2/s^2
    rates: Vector  # its acceleration, m/s^2


class Heap(NamedTuple):
    """Parts that wait, the greatest bound first."""

    parts: Table  # (room, 3): PartSpan
    marks: IntTable  # (room, PART_FACTS)


class Batch(NamedTuple):
    """Parts that are processed together."""

    parts: Table  # as in the heap, (CHAIN_SLOTS, 3)
    marks: IntTable
    slots: IntTable  # their slots and pieces, (CHAIN_SLOTS, 2)
    at: Vector  # the head's positions in all slots, m, (CHAIN_SLOTS,)
    drive: Vector


class Chains(NamedTuple):
    """Chains in slots, and the scratch of bounds on them."""

    places: Placements
    change: Table  # of `chain.rates`
    turn: Table
    scratch: Scratch
    errors: Errors


@kernel
def believed(notes: FloatArray) -> float:
    """The greatest value seen but at jumps, where it may be the other side's; -1 before the first."""
    return notes[SpeedNote.SIDED] if notes[SpeedNote.SEEN] >= 0.0 else -1.0


@kernel
def enough(seen: float, tolerance: float, limit: float) -> float:
    """The value that bounds need not fall below; before anything is seen no bound is good enough."""
    if seen < 0.0:
        return seen
    if seen > limit:
        return seen * (1.0 + tolerance)
    if limit < math.inf:
        return min(max(seen * (1.0 + ROUGHLY), LITTLE * limit), limit)
    return max(seen * (1.0 + tolerance), NOTHING)


@kernel
def before(parts: FloatArray, i: int, j: int) -> bool:
    """Whether part i is processed before part j; of equal bounds the first on the way comes first."""
    if parts[i, PartSpan.BOUND] == parts[j, PartSpan.BOUND]:
        return parts[i, PartSpan.START] < parts[j, PartSpan.START]
    return parts[i, PartSpan.BOUND] > parts[j, PartSpan.BOUND]


@kernel
def swap(parts: FloatArray, marks: IntArray, i: int, j: int) -> None:
    """Let parts i and j change places."""
    for k in range(PART_FACTS):
        parts[i, k], parts[j, k] = parts[j, k], parts[i, k]
        marks[i, k], marks[j, k] = marks[j, k], marks[i, k]


@kernel
def push(
    heap: Heap, counts: IntArray, bound: float, a: float, b: float, stretch: int, links: int, cells: int
) -> None:
    """Let a part from a to b, m, wait."""
    parts, marks, i = heap.parts, heap.marks, counts[SpeedCount.OPEN]
    parts[i, PartSpan.BOUND], parts[i, PartSpan.START], parts[i, PartSpan.END] = bound, a, b
    marks[i, PartFact.STRETCH] = stretch
    marks[i, PartFact.LINKS] = links
    marks[i, PartFact.BY_CELLS] = cells
    counts[SpeedCount.OPEN] = i + 1
    while i > 0 and before(parts, i, (i - 1) // 2):
        swap(parts, marks, i, (i - 1) // 2)
        i = (i - 1) // 2


@kernel
def take(heap: Heap, counts: IntArray, batch: Batch, n: int) -> None:
    """Take the first part off the heap, to be number n of the batch."""
    parts, marks, i = heap.parts, heap.marks, 0
    for k in range(PART_FACTS):
        batch.parts[n, k], batch.marks[n, k] = parts[0, k], marks[0, k]
    counts[SpeedCount.OPEN] -= 1
    count = counts[SpeedCount.OPEN]
    swap(parts, marks, 0, count)
    while 2 * i + 1 < count:
        child = 2 * i + 1
        if child + 1 < count and before(parts, child + 1, child):
            child += 1
        if not before(parts, child, i):
            break
        swap(parts, marks, i, child)
        i = child


@kernel
def square_at(squares: FloatArray, n: int, share: float) -> float:
    """The square of the head's speed at so great a share of stretch n, at its ends as it is said."""
    if share == 1.0:
        return squares[n, 1]
    return squares[n, 0] + share * (squares[n, 1] - squares[n, 0])


@kernel
def set_drive(drives: Drives, n: int, a: float, b: float, drive: FloatArray) -> None:
    """Fill `drive` with that of the head from a to b, m, on stretch n."""
    start, length = drives.ways[n, 0], drives.ways[n, 1] - drives.ways[n, 0]
    from_share, to_share = 0.0, 1.0
    if length > 0.0:
        from_share = min(max((a - start) / length, 0.0), 1.0)
        to_share = min(max((b - start) / length, 0.0), 1.0)
    drive[DriveStep.FROM] = square_at(drives.squares, n, from_share)
    drive[DriveStep.TO] = square_at(drives.squares, n, to_share)
    drive[DriveStep.RATE] = drives.rates[n]


@kernel
def ends_apart(a: float, b: float) -> bool:
    """Whether there is a number between a and b."""
    return a < 0.5 * (a + b) < b


@kernel
def divide(heap: Heap, counts: IntArray, batch: Batch, step: float) -> None:
    """Cut the batch's first part, longer than so many steps, m, and let the pieces wait as it did."""
    a, b = batch.parts[0, PartSpan.START], batch.parts[0, PartSpan.END]
    pieces = int(min(math.ceil((b - a) / step), MOST_PART_PIECES))
    for k in range(pieces):
        p, q = a + (b - a) * (k / pieces), b if k + 1 == pieces else a + (b - a) * ((k + 1) / pieces)
        stretch = batch.marks[0, PartFact.STRETCH]
        links = batch.marks[0, PartFact.LINKS]
        cells = batch.marks[0, PartFact.BY_CELLS]
        push(heap, counts, batch.parts[0, PartSpan.BOUND], p, q, stretch, links, cells)


@kernel
def look_by_cells(
    cells: Cells, group: IntArray, aim: SpeedAim, drives: Drives, heap: Heap, batch: Batch,
    notes: FloatArray, counts: IntArray,
) -> None:  # fmt: skip
    """Bound steps of the batch's first part by cells, and let those wait that stay undecided."""
    a = batch.parts[0, PartSpan.START]
    b = batch.parts[0, PartSpan.END]
    stretch = batch.marks[0, PartFact.STRETCH]
    wanted = enough(believed(notes), aim.tolerance, aim.limit)
    pieces = int(min(max(math.ceil((b - a) / aim.cell_step), CELL_SHARES), MOST_PART_PIECES))
    for k in range(pieces):
        p, q = a + (b - a) * (k / pieces), b if k + 1 == pieces else a + (b - a) * ((k + 1) / pieces)
        set_drive(drives, stretch, p, q, batch.drive)
        bound, settled, links = bound_by_cells(
            cells, group, batch.marks[0, PartFact.LINKS], p, q, batch.drive, aim.quantity, wanted
        )
        notes[SpeedNote.UPPER] = max(notes[SpeedNote.UPPER], settled)
        if links >= 0:
            again = 1 if q - p > aim.step * LENGTH_ROUNDING and bound < math.inf else 0
            bound = min(bound, batch.parts[0, PartSpan.BOUND])
            push(heap, counts, bound, p, q, stretch, max(links, 1), again)


@kernel
def pieces_of(a: float, b: float, step: float) -> int:
    """The number of pieces into which a part from a to b, m, is cut for chains."""
    if b - a > step * LENGTH_ROUNDING:
        return math.ceil((b - a) / step)
    return STEP_SHARES if ends_apart(a, b) else 1


@kernel
def take_batch(
    heap: Heap, counts: IntArray, batch: Batch, wanted: float, step: float
) -> tuple[int, int, int]:
    """Take parts for chains off the heap: how many, the slots they take, and the links."""
    count, slots, links = 0, 0, 1
    while (
        counts[SpeedCount.OPEN] > 0
        and heap.marks[0, PartFact.BY_CELLS] == 0
        and heap.parts[0, PartSpan.BOUND] > wanted
    ):
        a, b = heap.parts[0, PartSpan.START], heap.parts[0, PartSpan.END]
        pieces = pieces_of(a, b, step)
        if slots + pieces + 1 > CHAIN_SLOTS:
            break
        take(heap, counts, batch, count)
        batch.slots[count, PartCut.SLOT], batch.slots[count, PartCut.PIECES] = slots, pieces
        for k in range(pieces):
            batch.at[slots + k] = a + (b - a) * (k / pieces)
        batch.at[slots + pieces] = b
        links = max(links, batch.marks[count, PartFact.LINKS])
        count, slots = count + 1, slots + pieces + 1
    return count, slots, links


@kernel
def place_batch(
    rows: FloatArray, links: FloatArray, at: FloatArray, slots: int, chains: Chains, quantity: int
) -> bool:
    """Place the chain in so many slots; whether it can stand in all of them."""
    places, errors = chains.places, chains.errors
    if not place_chain(rows, links, at, 0, slots, places):
        return False
    mark_lanes(rows, links, places, 0, slots, errors.lanes)
    for t in range(slots):
        ratio_errors(rows, links, errors.seams, places, errors.lanes, t, errors.along, errors.ratio)
        if quantity != DriveRate.SPEEDS:
            bend_errors(rows, places, t, links.shape[0], errors)
        if quantity not in (DriveRate.SPEEDS, DriveRate.ACROSS):
            rates_in_slot(
                rows, links, t, places.row, places.u, places.x, places.y, places.ratio,
                chains.change, chains.turn,
            )  # fmt: skip
            rate_errors(rows, links, places, chains.change, chains.turn, t, errors)
    return True


@kernel
def keep(
    aim: SpeedAim, heap: Heap, batch: Batch, n: int, t: int, most: FloatArray, off: FloatArray,
    notes: FloatArray, counts: IntArray,
) -> None:  # fmt: skip
    """Let the piece of the batch's part n that begins in slot t wait, if it may exceed what is seen.

    `most` bounds its handles as they were computed; exactly they may do more by the errors `off` at its
    two ends, which no refinement takes away.
    """
    wanted = enough(believed(notes), aim.tolerance, aim.limit)
    bound, settled, links = 0.0, 0.0, -1
    for i in range(batch.marks[n, PartFact.LINKS] + 1):
        exactly = most[i] + max(off[i, t], off[i, t + 1])
        bound = max(bound, exactly)
        if most[i] > wanted:
            links = i
        else:
            settled = max(settled, exactly)
    notes[SpeedNote.UPPER] = max(notes[SpeedNote.UPPER], settled)
    a, b, bound = batch.at[t], batch.at[t + 1], min(bound, batch.parts[n, PartSpan.BOUND])
    if links >= 0 and ends_apart(a, b):
        push(heap, counts, bound, a, b, batch.marks[n, PartFact.STRETCH], max(links, 1), 0)
    elif links >= 0:
        notes[SpeedNote.UPPER] = max(notes[SpeedNote.UPPER], bound)


@kernel
def see(
    rows: FloatArray, links: int, quantity: int, drives: Drives, batch: Batch, n: int, chains: Chains,
    notes: FloatArray, counts: IntArray,
) -> None:  # fmt: skip
    """Keep the greatest value at the ends of the pieces of the batch's part n.

    What is seen of handles at a jump of the curvature may belong to its other side: it is not sure.
    """
    first, stretch, drive = batch.slots[n, PartCut.SLOT], batch.marks[n, PartFact.STRETCH], batch.drive
    last = first + batch.slots[n, PartCut.PIECES]
    for t in range(first, last + 1):
        set_drive(drives, stretch, batch.at[min(t, last - 1)], batch.at[min(t, last - 1) + 1], drive)
        square = drive[DriveStep.FROM] if t < last else drive[DriveStep.TO]
        value, row = greatest_in_slot(
            rows, chains.places, chains.change, chains.turn, t, links,
            square, drive[DriveStep.RATE], quantity,
        )  # fmt: skip
        weigh_values(
            rows,
            chains.places,
            chains.change,
            t,
            links,
            square,
            drive[DriveStep.RATE],
            quantity,
            chains.errors,
        )
        own = row + 1 if quantity == DriveRate.TURNING else row
        if quantity in (DriveRate.SPEEDS, DriveRate.TURNING) or chains.errors.sided[t] > 0.0:
            notes[SpeedNote.SURE] = max(notes[SpeedNote.SURE], value - chains.errors.sought[own, t])
            notes[SpeedNote.SIDED] = max(notes[SpeedNote.SIDED], value)
        if value > notes[SpeedNote.SEEN]:
            notes[SpeedNote.SEEN], notes[SpeedNote.WHERE] = value, batch.at[t]
            counts[SpeedCount.ROW], counts[SpeedCount.WHEN] = row, stretch


@kernel
def look_by_chains(
    rows: FloatArray, links: FloatArray, aim: SpeedAim, drives: Drives, heap: Heap, batch: Batch,
    n: int,
    chains: Chains, notes: FloatArray, counts: IntArray,
) -> None:  # fmt: skip
    """Bound the pieces of the batch's part n, whose chains are placed; let the undecided ones wait."""
    first, stretch, drive = batch.slots[n, PartCut.SLOT], batch.marks[n, PartFact.STRETCH], batch.drive
    scratch = chains.scratch
    for t in range(first, first + batch.slots[n, PartCut.PIECES]):
        set_drive(drives, stretch, batch.at[t], batch.at[t + 1], drive)
        scratch.beside[0], scratch.beside[1] = chains.errors.most[t], chains.errors.most[t + 1]
        bound_step(rows, links, chains.places, t, t + 1, drive, aim.quantity, scratch)
        keep(aim, heap, batch, n, t, scratch.most, chains.errors.sought, notes, counts)


@kernel
def seek_peak(
    rows: Table, links: Vector, group: IntVector, cells: Cells, aim: SpeedAim, drives: Drives,
    heap: Heap, batch: Batch, chains: Chains, notes: Vector, counts: IntVector, budget: int,
) -> Ended:  # fmt: skip
    """Process the parts that wait; notes and counts receive what was found.

    Call it again, after MORE (about so many handles as `budget` were placed) as it is, after ROOM with
    a larger heap. What waits then bounds the quantity, with notes[UPPER]. FALLEN: the chain has no
    place at one of the batch's positions.
    """
    spent, wanted = 0.0, enough(believed(notes), aim.tolerance, aim.limit)
    while counts[SpeedCount.OPEN] > 0 and heap.parts[0, PartSpan.BOUND] > wanted:
        if counts[SpeedCount.OPEN] + CHAIN_SLOTS > heap.parts.shape[0]:
            return Ended.ROOM
        if spent >= budget:
            return Ended.MORE
        by_cells = heap.marks[0, PartFact.BY_CELLS] > 0
        step = aim.cell_step if by_cells else aim.step
        wide = heap.parts[0, PartSpan.END] - heap.parts[0, PartSpan.START]
        if wide > step * LENGTH_ROUNDING * MOST_PART_PIECES:
            take(heap, counts, batch, 0)
            divide(heap, counts, batch, step)
        elif by_cells:
            take(heap, counts, batch, 0)
            spent += CELL_COST * MOST_PART_PIECES * batch.marks[0, PartFact.LINKS]
            look_by_cells(cells, group, aim, drives, heap, batch, notes, counts)
        else:
            count, slots, most = take_batch(heap, counts, batch, wanted, step)
            counts[SpeedCount.EVALUATIONS] += slots
            spent += slots * (most + 1.0)
            if not place_batch(rows, links[:most], batch.at, slots, chains, aim.quantity):
                return Ended.FALLEN
            for n in range(count):
                see(rows, most, aim.quantity, drives, batch, n, chains, notes, counts)
            for n in range(count):
                look_by_chains(rows, links[:most], aim, drives, heap, batch, n, chains, notes, counts)
        wanted = enough(believed(notes), aim.tolerance, aim.limit)
    if counts[SpeedCount.OPEN] > 0:
        notes[SpeedNote.UPPER] = max(notes[SpeedNote.UPPER], heap.parts[0, PartSpan.BOUND])
    return Ended.DONE
