"""Where a route bends left and right, and by how much it has turned."""

from typing import Literal, NamedTuple, Self

import numpy as np

from benchdragon.kernels.bends import Bend, find_bends
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray
from benchdragon.model.curves import Route

Turning = Literal["left", "right", "straight"]
TURNINGS: dict[int, Turning] = {Bend.LEFT: "left", Bend.RIGHT: "right"}


class Bends(NamedTuple):
    """A route cut where it changes the side to which it bends.

    Attributes:
        at: route positions from which it bends to each side, m, increasing, (n,); the first is -inf.
        sides: to which it bends from there on, of kernels/bends.py, (n,).
        turned: by how much it has turned by the start of each of its rows, rad, left positive.
    """

    at: FloatArray
    sides: IntArray
    turned: FloatArray

    @classmethod
    def of(cls, route: Route) -> Self:
        """The bends of a route."""
        rows = len(route.rows)
        at, sides, turned = np.empty(2 * rows), np.empty(2 * rows, np.int64), np.empty(rows)
        count = find_bends(route.rows, at, sides, turned)
        return cls(at[:count], sides[:count], turned)

    def turning(self, s: float) -> Turning:
        """To which side the route bends at position s, m; just behind it, if it changes there."""
        return turning_of(self.sides[np.searchsorted(self.at, s) - 1])


def turning_of(side: float) -> Turning:
    """The name of a side of kernels/bends.py."""
    return TURNINGS.get(int(side), "straight")
