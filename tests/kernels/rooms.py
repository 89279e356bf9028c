"""Room for kernels that lay it in the engine's own memory by themselves."""

import numpy as np

from benchdragon.kernels import bench_cells as cells
from benchdragon.kernels import box, drive, obstacle_contact, rate_rounding
from benchdragon.kernels import speed_search as peak
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.motion_bounds import HANDLE_COLUMNS


def scratch_for(handles: int) -> drive.Scratch:
    """drive.Scratch for a chain of so many handles."""
    return drive.Scratch(
        np.empty((handles, HANDLE_COLUMNS)),
        np.empty((handles, 2)),
        np.empty((handles, 2)),
        np.empty(drive.MOST_JUMPS, dtype=np.int64),
        np.empty((drive.MOST_JUMPS + 1, 4)),
        np.empty(handles),
        np.zeros(2),
    )


def errors_for(handles: int, slots: int, seams: FloatArray) -> rate_rounding.Errors:
    """Room for so many handles in so many slots, on a route with these seams."""
    lanes, along = np.zeros((2, handles))
    ratio, change, turn, bend, sought = np.zeros((5, handles, slots))
    sided, most = np.ones(slots), np.zeros(slots)
    return rate_rounding.Errors(seams, lanes, along, ratio, change, turn, bend, sought, sided, most)


def empty_cells(count: int, kinds: int) -> cells.Cells:
    """Room for so many cells."""
    rows = count + 1
    borders, bends, fastest, off = np.empty((4, rows))
    return cells.Cells(borders, bends, fastest, off, np.empty((rows, kinds, cells.CELL_COLUMNS)))


def workshop_for(kinds: int, seams: FloatArray) -> cells.Workshop:
    """A workshop for so many links, on a route with these seams."""
    slots = 2 * (kinds + 1)
    change, turn = np.zeros((2, 2, slots))
    return cells.Workshop(
        empty_placements(2, slots),
        np.empty((2, HANDLE_COLUMNS)),
        np.empty(slots),
        np.zeros(kinds, dtype=np.int64),
        change,
        turn,
        errors_for(2, slots, seams),
    )


def empty_heap(room: int) -> peak.Heap:
    """Room for so many parts."""
    return peak.Heap(
        np.empty((room, peak.PART_FACTS)),
        np.empty((room, peak.PART_FACTS), dtype=np.int64),
    )


def empty_batch() -> peak.Batch:
    """Room for a batch."""
    return peak.Batch(
        np.empty((peak.CHAIN_SLOTS, peak.PART_FACTS)),
        np.empty((peak.CHAIN_SLOTS, peak.PART_FACTS), dtype=np.int64),
        np.empty((peak.CHAIN_SLOTS, 2), dtype=np.int64),
        np.empty(peak.CHAIN_SLOTS),
        np.empty(drive.DRIVE_COLUMNS),
    )


def chains_for(handles: int, seams: FloatArray) -> peak.Chains:
    """Room for a batch's chains of so many handles, on a route with these seams."""
    change, turn = np.zeros((2, handles, peak.CHAIN_SLOTS))
    errors = errors_for(handles, peak.CHAIN_SLOTS, seams)
    return peak.Chains(
        empty_placements(handles, peak.CHAIN_SLOTS), change, turn, scratch_for(handles), errors
    )


def beside(boxes: FloatArray) -> obstacle_contact.Standing:
    """Boxes that stand, with scratch for as many."""
    count = len(boxes)
    first, second, number = (np.empty(count, dtype=np.int64) for _list in range(3))
    near = np.empty((max(count, 2), box.BOX_COLUMNS))
    return obstacle_contact.Standing(boxes, near, number, first, second, np.zeros(1, dtype=np.int64))
