"""A hash grid: which of many places lie near one another, without comparing all pairs."""

import math
from typing import NamedTuple

import numpy as np

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.route import IntArray

# Room for so many pairs a place is made at first, and for so many in all (64 MB); more are counted
# first.
PAIRS_A_PLACE, PAIRS_AT_FIRST = 64, 4_000_000
# Factors that spread the columns and rows of square cells over the buckets.
COLUMN_FACTOR, ROW_FACTOR = 73856093, 19349663


class Grid(NamedTuple):
    """Places in square cells, chained by the hash of their cell; numbers of places count from 0.

    `side` is that of the cells, m, (1,). heads[b] is 1 + the last place put into bucket b, or 0, with a
    power of two of buckets; nexts[i] is 1 + the place put there before place i, or 0.
    """

    side: Vector
    heads: IntVector
    nexts: IntVector
    columns: IntVector
    rows: IntVector


def empty_grid(places: int, side: float) -> Grid:
    """A grid of cells `side` metres wide with room for so many places, none of them put in yet."""
    buckets = 1 << max(4, (2 * places - 1).bit_length())
    heads = np.zeros(buckets, dtype=np.int64)
    nexts, columns, rows = (np.empty(places, dtype=np.int64) for _array in range(3))
    return Grid(np.array([side]), heads, nexts, columns, rows)


def filled_grid(places: FloatArray, side: float) -> Grid:
    """A grid of cells `side` metres wide with all places, (count, 2), except those at NaN."""
    grid = empty_grid(len(places), side)
    put_known(grid, places)
    return grid


def pairs_near(
    grid: Grid, others: FloatArray, places: FloatArray, start: int, reach: float
) -> tuple[IntArray, IntArray]:
    """Pairs of places, from number `start` on, and others that are within reach: see `pairs_within`."""
    found = np.empty(len(others), dtype=np.int64)
    most = min(PAIRS_A_PLACE * (len(places) - start), PAIRS_AT_FIRST)
    while True:
        first, second = np.empty(most, dtype=np.int64), np.empty(most, dtype=np.int64)
        count = pairs_within(grid, others, places, start, reach, found, first, second)
        if count <= most:
            return first[:count], second[:count]
        most = count


@kernel
def bucket_of(grid: Grid, column: int, row: int) -> int:
    """The bucket of a square cell."""
    return (column * COLUMN_FACTOR ^ row * ROW_FACTOR) & (grid.heads.shape[0] - 1)


@kernel
def put(grid: Grid, i: int, x: float, y: float) -> None:
    """Put place i, which is not in yet, at (x, y), m."""
    column, row = math.floor(x / grid.side[0]), math.floor(y / grid.side[0])
    b = bucket_of(grid, column, row)
    grid.columns[i], grid.rows[i], grid.nexts[i] = column, row, grid.heads[b]
    grid.heads[b] = i + 1


@kernel
def gather(grid: Grid, x: float, y: float, reach: float, found: IntArray) -> int:
    """Fill `found` with places in cells within `reach` of (x, y), m, along each axis; returns how many.

    It is a superset of the places within reach, each once; `found` has room for all places.
    """
    side, count = grid.side[0], 0
    low, high = math.floor((x - reach) / side), math.floor((x + reach) / side)
    for row in range(math.floor((y - reach) / side), math.floor((y + reach) / side) + 1):
        for column in range(low, high + 1):
            i = grid.heads[bucket_of(grid, column, row)] - 1
            while i >= 0:
                if grid.columns[i] == column and grid.rows[i] == row:
                    found[count] = i
                    count += 1
                i = grid.nexts[i] - 1
    return count


@entry
def put_known(grid: Grid, places: Table) -> None:
    """Put all places, (count, 2), into an empty grid but those at NaN."""
    for i in range(places.shape[0]):
        if not math.isnan(places[i, 0]):
            put(grid, i, places[i, 0], places[i, 1])


@entry
def pairs_within(
    grid: Grid, others: Table, places: Table, start: int, reach: float, found: IntVector,
    first: IntVector, second: IntVector,
) -> int:  # fmt: skip
    """Fill first, second with the pairs of places[start..] and others no farther apart than reach, m.

    `grid` holds the others. Places at NaN do not count. Returns the number of pairs; counting goes on
    when first and second are full.
    """
    count = 0
    for i in range(start, places.shape[0]):
        x, y = places[i, 0], places[i, 1]
        if math.isnan(x):
            continue
        for n in range(gather(grid, x, y, reach, found)):
            j = found[n]
            if (others[j, 0] - x) ** 2 + (others[j, 1] - y) ** 2 <= reach * reach:
                if count < first.shape[0]:
                    first[count], second[count] = i, j
                count += 1
    return count
