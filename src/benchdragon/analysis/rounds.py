"""Parts of a walk that repeat earlier ones, so that searches may skip them: see kernels/rounds.py."""

import numpy as np

from benchdragon.analysis.nearby import seams_of
from benchdragon.kernels import rounds as kernel
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.spans import REPEAT
from benchdragon.model.walk import Walk

Span = tuple[float, float]


def repeats(rows: FloatArray) -> FloatArray:
    """Where a route of these rows has one shape again and again, wherever that leads.

    Rows with the columns of kernels/rounds.py.
    """
    return _repeats(rows, np.empty((0, 2)), 0.0)


def returns(rows: FloatArray, reach: float) -> FloatArray:
    """The same where it leads back to where it was, for what reaches so far from it, m."""
    return _repeats(rows, seams_of(rows), reach)


def _repeats(rows: FloatArray, seams: FloatArray, reach: float) -> FloatArray:
    known = np.empty((4 * len(rows) + kernel.ROOM, REPEAT))
    return known[: kernel.find_repeats(rows, seams, reach, known)]


class Rounds:
    """The new parts of a dragon's ways, on a route of which the `known` parts repeat."""

    def __init__(self, walk: Walk, known: FloatArray) -> None:
        self._walk, self._known = walk, known

    def new(self, first: float, last: float) -> tuple[list[Span], float]:
        """The spans of the head's way from first to last, m, that repeat nothing before them there.

        And by how much positions may differ from those some rounds before, m.
        """
        rows, links, spans = (
            self._walk.route.rows, self._walk.dragon.links, np.empty((len(self._known) + 1, 2)),
        )  # fmt: skip
        at, places = np.empty(1), empty_placements(len(links) + 1, 1)
        count, missed = kernel.spans_left(rows, links, self._known, first, last, at, places, spans)
        return [(start, end) for start, end in spans[:count].tolist()], missed
