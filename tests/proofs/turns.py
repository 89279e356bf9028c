"""Boxes of turns for proofs, and the turns in them as doubles know them."""

import math
from collections.abc import Sequence

import numpy as np

from benchdragon import InputError
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.turns import Turn, three_pieces, two_arcs

PITCH, DISC = 1.7, 4.5
# The middle of a box of each family: both joints, m, and the ratio's logarithm or both radii, m.
MIDDLES = {"arc-arc": (4.45, 4.15, 0.4), "arc-line-arc": (4.4, 4.45, 1.55, 1.7)}


def turn_of(family: str, numbers: Sequence[float]) -> Turn | None:
    """The turn of a family's numbers; None if there is none."""
    entry, leave, *inner = (float(number) for number in numbers)
    try:
        if family == "arc-arc":
            return two_arcs(PITCH, entry, leave, math.exp(inner[0]))
        return three_pieces(PITCH, entry, leave, (inner[0], inner[1]))
    except InputError:
        return None


def ends(family: str, half: float, middle: Sequence[float] = ()) -> tuple[list[float], list[float]]:
    """The box about a middle: joints within a tenth of `half` of it, all else within half, m."""
    about = np.array(middle or MIDDLES[family])
    halves = np.full(len(about), half)
    halves[:2] *= 0.1
    return (about - halves).tolist(), (about + halves).tolist()


def some(low: Sequence[float], high: Sequence[float], count: int) -> FloatArray:
    """Points of a box, its corners' neighbourhood among them, (count, numbers)."""
    rng = np.random.default_rng(7)
    shares = rng.random((count, len(low)))
    shares[::3] = np.round(shares[::3])
    found: FloatArray = np.array(low) + shares * (np.array(high) - np.array(low))
    return found
