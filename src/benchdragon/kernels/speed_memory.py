"""The state of a question about greatest values, and its layout in the engine's own memory."""

from typing import NamedTuple

from benchdragon.kernels import memory
from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.bench_cells import CELL_COLUMNS, CellKinds, Cells, Workshop
from benchdragon.kernels.curve import COLUMNS
from benchdragon.kernels.drive import DRIVE_COLUMNS, MOST_JUMPS, QUANTITIES
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.head_speed import HANDLE_HULL_COLUMNS
from benchdragon.kernels.memory import ROW, Header, Shapes
from benchdragon.kernels.motion_bounds import HANDLE_COLUMNS
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.question import Told
from benchdragon.kernels.rounding import SEAM_COLUMNS
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.search_room import placements
from benchdragon.kernels.speed_search import (
    CHAIN_SLOTS,
    PART_FACTS,
    SPEED_COUNTS,
    SPEED_NOTES,
    Batch,
    Chains,
    Drives,
    Heap,
)


class SpeedGiven(Numbered):
    """What a host passes with a question, a row of floats."""

    EXTENT = 0  # of the dragon, m
    HEAD = 1  # m/s: up to which a head speed is sought; 0 if none is
    MOST_CELLS = 2  # times links, made at a time: the way is searched in windows of so many
    FIRST_OPEN = 3  # parts of the way that there is room for at first
    MOST_OPEN = 4  # handles times parts that may wait; more are left, and the bracket stays wider
    BUDGET = 5  # handles placed, or cells made, between two readings of the clock
    CELL_COST = 6  # of a cell, in handles bounded
    COARSE_STEP = 7  # that cells bound, as a share of the shortest link
    MOST_LOSS = 8  # of the coarse bound from the head to the tail, as a share
    ALIKE = 9  # by what share of rounding speeds may differ that are the same


SPEED_NUMBERS = len(SpeedGiven)


class SpeedTold(Told):
    """The result of a question, a row of floats that begins with the columns of `question.Told`.

    It is about the greatest value, or about that of the limit that decides.
    """

    VALUE = 2
    LEAST = 3
    MOST = 4
    AT = 5  # the head's position, m
    HANDLE = 6  # or bench, from 0
    X = 7  # its place, m
    Y = 8
    STRETCH = 9  # of the drive
    PLACED = 10  # chains, in all
    LOWER = 11  # the greatest head speed that is sure, m/s, and one that exceeds a limit
    HIGHER = 12
    DECIDES = 13  # the quantity whose limit that is; -1 if none
    QUANTITY = 14  # that is sought now
    SHARE = 15  # of all that is done
    GIVEN_UP = 16  # 1 if that took more work than it may: the bracket has no upper end
    LOW = 17  # the window, m
    HIGH = 18
    # Internal: the limit of the current quantity, the work that may be spent, the loss of a cell, the
    # parts that may wait, the bracket's gap at first and the share by which it was closed; where the
    # current way begins and ends, m.
    LIMIT, LEFT, LOSS, MOST_ROWS, GAP, CLOSED_BY, BEGIN, END = range(19, 27)


SPEED_FIGURES = len(SpeedTold)


class SpeedState(Numbered):
    """The state of a question, a row of whole numbers.

    What is next, the first stretch behind the current way, its window and windows, chains placed for
    quantities before, how many of them there are in all, and were sought.
    """

    PHASE, NEXT, WINDOW, WINDOWS, BEFORE, ALL, SOUGHT = range(7)


SPEED_STATE = len(SpeedState)


class SpeedMemory(Numbered):
    """The memories of the block for parts that wait, for cells, and for all of fixed size."""

    HEAP, CELL, OWN = range(3)


class SpeedAsked(NamedTuple):
    """A question about the greatest of quantities."""

    rows: Table
    links: Vector
    group: IntVector  # the kind of each bench
    kinds: CellKinds
    drives: Drives
    batch: Batch
    chains: Chains
    shop: Workshop
    hull: Table  # of head_speed
    tolerances: Vector  # of each quantity, 0 if it is not asked for
    limits: Vector
    numbers: Vector
    notes: Vector  # of speed_search
    counts: IntVector
    state: IntVector
    figures: Vector
    reached: Vector  # of bench_cells
    cut: IntVector
    heap: Heap
    cells: Cells


HEAP_SLOT, CELLS_SLOT = memory.slot_of(SpeedAsked, "heap"), memory.slot_of(SpeedAsked, "cells")
SPEED_END_SLOT, BASE = memory.HEADER + memory.slot_count(SpeedAsked), 8 * memory.HEADER


@kernel
def errors(rows: int, handles: int, slots: int) -> Shapes:
    """The shapes of `Errors`."""
    row, one, slot = (handles, ROW), (handles, slots), (slots, ROW)
    return (rows, SEAM_COLUMNS), row, row, one, one, one, one, one, slot, slot


@kernel
def lay_all(slots: IntArray, address: int, rows: int, benches: int, kinds: int, stretches: int) -> int:
    """Lay out all arrays of fixed size from an address on; returns the bytes that they take."""
    handles, borders = benches + 1, 2 * (kinds + 1)
    part, one, two = (CHAIN_SLOTS, PART_FACTS), (handles, CHAIN_SLOTS), (2, borders)
    return memory.lay(slots, memory.HEADER, address, (
        (rows, COLUMNS), (benches, ROW), (benches, ROW), (kinds, 1), (kinds, 2),
        (stretches, 2), (stretches, 2), (stretches, ROW),
        part, part, (CHAIN_SLOTS, 2), (CHAIN_SLOTS, ROW), (DRIVE_COLUMNS, ROW),
        *placements(handles, CHAIN_SLOTS),
        one, one, (handles, HANDLE_COLUMNS), (handles, 2), (handles, 2),
        (MOST_JUMPS, ROW), (MOST_JUMPS + 1, 4), (handles, ROW), (2, ROW),
        *errors(rows, handles, CHAIN_SLOTS),
        *placements(2, borders), (2, HANDLE_COLUMNS), (borders, ROW), (kinds, ROW), two, two,
        *errors(rows, 2, borders),
        (handles, HANDLE_HULL_COLUMNS), (QUANTITIES, ROW), (QUANTITIES, ROW), (SPEED_NUMBERS, ROW),
        (SPEED_NOTES, ROW),
        (SPEED_COUNTS, ROW), (SPEED_STATE, ROW), (SPEED_FIGURES, ROW), (2, ROW), (2, ROW),
    ))  # fmt: skip


@kernel
def lay_heap(block: int, address: int, rows: int) -> None:
    """Lay out room for so many parts that wait."""
    slots = memory.integers_at(block, SPEED_END_SLOT)
    slots[Header.OWNED + SpeedMemory.HEAP] = address
    memory.lay(slots, HEAP_SLOT, address, ((rows, PART_FACTS), (rows, PART_FACTS)))


@kernel
def lay_cells(block: int, address: int, rows: int, kinds: int) -> None:
    """Lay out room for cells with so many borders."""
    slots, row = memory.integers_at(block, SPEED_END_SLOT), (rows, ROW)
    slots[Header.OWNED + SpeedMemory.CELL] = address
    memory.lay(slots, CELLS_SLOT, address, (row, row, row, row, (rows, kinds)))
    slots[slots[Header.SLOT]] = CELL_COLUMNS


@kernel
def doubled(before: int, rows: int, count: int, width: int, last: int) -> int:
    """The address of so many tables of `width` columns and one of `last`, of twice as many rows.

    They begin with those at `before`, which is given back; 0 if there is no memory.
    """
    address = memory.allocate(16 * rows * (count * width + last))
    if address != 0:
        old = memory.integers_at(before, rows * (count * width + last))
        new = memory.integers_at(address, 2 * rows * (count * width + last))
        for n in range(old.shape[0]):
            new[n + rows * width * min(n // (rows * width), count)] = old[n]
        memory.release(before)
    return address
