"""Curves of drawings that have no exact form here, as points whose chords keep near them."""

import math
from collections.abc import Callable

import numpy as np

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.surveys.lines import MOST_CORNERS

Points = list[tuple[float, ...]]
# Of a file's own unit, None where it says none: how near chords keep to curves, in that unit.
Fineness = Callable[[str | None], float]


class Tally:
    """Counts the points that a file's curves become, so that no more are made than are read."""

    def __init__(self, name: str, within: float) -> None:
        """Args: `name` of the file; `within`: how near chords keep to curves, in its unit."""
        self.name, self.within = name, within
        self.points = 0

    def counted(self, points: FloatArray) -> FloatArray:
        """The points.

        Raises:
            InputError: if these are too many.
        """
        self.points += len(points)
        if self.points > MOST_CORNERS:
            text = _("{file}: its curves need more than the {most} points that are read at most")
            raise InputError(text.format(file=self.name, most=MOST_CORNERS))
        return points


def bezier_points(control: FloatArray, within: float) -> tuple[FloatArray, float]:
    """Points whose chords keep `within` of a Bezier curve of control points (n + 1, 2), and how near.

    Its second derivative is at most n (n - 1) times the largest second difference of its control
    points; over a span h of the parameter it keeps within an eighth of that times h^2 of the chord.
    """
    degree = len(control) - 1
    second = np.diff(control, 2, axis=0)
    most = degree * (degree - 1) * float(np.hypot(second[:, 0], second[:, 1]).max(initial=0.0))
    count = _count(most, within)
    t = np.linspace(0.0, 1.0, count + 1)[:, None]
    weights = [math.comb(degree, k) * t**k * (1.0 - t) ** (degree - k) for k in range(degree + 1)]
    points = sum((w * p for w, p in zip(weights, control, strict=True)), np.zeros((count + 1, 2)))
    return points, 0.125 * most / count**2


def ellipse_points(
    centre: FloatArray, one: FloatArray, other: FloatArray, start: float, sweep: float, within: float
) -> tuple[FloatArray, float]:
    """The same of centre + cos t one + sin t other, for t from `start` over `sweep`, rad."""
    most = math.hypot(*one, *other) * sweep * sweep
    count = max(8, _count(most, within))
    t = (start + np.linspace(0.0, sweep, count + 1))[:, None]
    return centre + np.cos(t) * one + np.sin(t) * other, 0.125 * most / count**2


def _count(most: float, within: float) -> int:
    """Into how many chords a curve is cut; MOST_CORNERS are one too many for what is read."""
    if not math.isfinite(most):
        return 1
    return max(1, math.ceil(min(MOST_CORNERS, math.sqrt(0.125 * most / within))))


def pairs(points: FloatArray) -> Points:
    """Points as pairs."""
    return [(x, y) for x, y in points.tolist()]
