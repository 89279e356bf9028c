"""Kernels that pass groups of arrays about, for test_blocks.py to build; some must not be built."""

from typing import NamedTuple

import numpy as np

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.entries import allocates, kernel


class Rows(NamedTuple):
    """Some rows of a table."""

    table: Table
    which: IntVector


class Weighed(NamedTuple):
    """Rows, and what each weighs."""

    weights: Vector
    rows: Rows


class Kept(NamedTuple):
    """Numbers alone."""

    sum: float
    rounds: int


@kernel
def row_sum(rows: Rows, n: int) -> float:
    total = 0.0
    for k in range(rows.table.shape[1]):
        total += rows.table[rows.which[n], k]
    return total


@kernel
def add_up(weighed: Weighed, first: int, out: Vector) -> Kept:
    total, rounds = 0.0, 0
    for n in range(first, weighed.rows.which.shape[0]):
        total += weighed.weights[n] * row_sum(weighed.rows, n)
        out[n] = total
        rounds += 1
    return Kept(total, rounds)


@kernel
def made_and_passed(given: Weighed, out: Table) -> float:
    """Groups that kernels make: of parts of what was given, anew in each round, one inside another."""
    total = 0.0
    for n in range(out.shape[0]):
        rows = Rows(given.rows.table[n:], given.rows.which[: out.shape[0] - n])
        again = Weighed(given.weights, rows)
        total += add_up(again, 0, out[n]).sum + add_up(again, 1, out[n]).sum
        total += row_sum(again.rows, 0) * row_sum(given.rows, 0)
    return total


@kernel
def kept_for_long(given: Rows) -> Rows:
    return Rows(given.table, given.which)


@kernel
def returned(given: Rows) -> float:
    return row_sum(kept_for_long(given), 0)


@kernel
@allocates
def counted(given: Rows) -> float:
    which = np.zeros(1, dtype=np.int64)
    return row_sum(Rows(given.table, which), 0)
