"""Continuous-collision queries about pairs of benches, many in one call: each pair over its own span.

A query is two benches of one chain and a span of the head's arc length; its goal is one of
kernels/time_of_impact.py: the time of impact, or the least separation.
"""

import math

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.entries import entry
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.time_of_impact import (
    NOTES,
    Chain,
    Limits,
    Note,
    Pairs,
    Search,
    bisect,
    open_step,
)


class PairAnswer(Numbered):
    """Columns of the answers."""

    ENDING = 0  # the exit status: see kernels/time_of_impact.py
    SOUGHT_LOW = 1  # the bracket of the time of impact, m of the head's arc length
    SOUGHT_HIGH = 2
    SEPARATION = 3  # the least separation seen, m, where it was the goal


ANSWER_COLUMNS = len(PairAnswer)
# Scratch of integers: the two benches, and the pair by their places among these.
NUMBERS = 4


@entry
def search_pairs(
    search: Search, goal: int, rows: Table, links: Vector, sizes: Table, seams: Table, first: IntVector,
    second: IntVector, width: Vector, spans: Table, slack: float, narrow: float, most: int,
    numbers: IntVector, note: Vector, out: Table,
) -> None:  # fmt: skip
    """Answer queries: benches first[q] < second[q], width[q] m wide, the head along spans[q], m.

    Fills `out`, (queries, ANSWER_COLUMNS). No bench may leap in a span: none does whose link times the
    greatest curvature of the route is at most 1. Widths in `sizes` are overwritten; `numbers` (NUMBERS)
    and `note` (time_of_impact.NOTES) are scratch; slack, narrow and most are those of its Limits.
    """
    members, mine, other = numbers[:2], numbers[2:3], numbers[3:4]
    mine[0], other[0] = 0, 1
    for q in range(first.shape[0]):
        members[0], members[1] = first[q], second[q]
        sizes[1, first[q]] = sizes[1, second[q]] = width[q]
        for n in range(NOTES):
            note[n] = 0.0
        note[Note.NEAREST] = math.inf
        limits = Limits(0.0, slack, narrow, most)
        chain = Chain(rows, links[: second[q] + 1], note[:0], sizes, members, sizes[:0], seams)
        top = open_step(search, 1, spans[q, 0], spans[q, 1])
        out[q, PairAnswer.ENDING] = bisect(
            search, goal, chain, Pairs(mine, other), top, 0, limits, note
        )
        out[q, PairAnswer.SOUGHT_LOW] = note[Note.LOWER]
        out[q, PairAnswer.SOUGHT_HIGH] = note[Note.UPPER]
        out[q, PairAnswer.SEPARATION] = note[Note.NEAREST]
