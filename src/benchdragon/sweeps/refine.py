"""Further points where answers change most: rounds of them, found by the package `adaptive`.

Each round is a function of all that was answered before, and of nothing else, so that a sweep that was
broken off asks for the same points when it goes on.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

import numpy as np

from benchdragon.errors import InputError, brought_by, finite, whole
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.sweeps.points import MOST_LISTED, Points

# Points of a round: few beside all, many beside the workers.
ROUND = 32
# How much it weighs that there is an answer on one side and none on the other: as much as all values.
BORDER = 1.0


@dataclass(frozen=True)
class Refinement:
    """How far to refine.

    Attributes:
        most: further points.
        to: it ends where neighbouring points are nearer than this share of each key's range, or their
            answers than this share of all answers.

    Examples:
        >>> bd.Refinement(most=8, to=0.01).most
        8
    """

    most: int = 0
    to: float = 1e-3

    def __post_init__(self) -> None:
        """Check both.

        Raises:
            InputError: for a number of points or a share out of range.
        """
        object.__setattr__(self, "most", whole("refine", self.most, 0, MOST_LISTED))
        if not 1e-9 <= finite("to", self.to) <= 1.0:
            raise InputError(_("to: expected a share from 1e-9 to 1, not {to}").format(to=self.to))


def adaptive_version() -> str:
    """The version of the package `adaptive`.

    Raises:
        MissingExtraError: if it is not installed.
    """
    with brought_by("refine"):
        return version("adaptive")


class Refiner:
    """Where to ask next.

    Args:
        points: asked already.
        refinement: how far to go.
    """

    def __init__(self, points: Points, refinement: Refinement) -> None:
        if not points.numeric or len(points.keys) > 2:
            raise InputError(_("refine: expected one key or two, with numbers for values"))
        with brought_by("refine"):
            import adaptive
        self._ends = [(float(min(column)), float(max(column))) for column in points.columns]
        if any(low == high for low, high in self._ends):
            raise InputError(_("refine: each key needs a range of values"))
        self._one, self._to = len(points.keys) == 1, refinement.to
        if self._one:
            self._learner: Any = adaptive.Learner1D(None, (0.0, 1.0), loss_per_interval=self._loss)
        else:
            self._learner = adaptive.Learner2D(None, [(0.0, 1.0)] * 2, loss_per_triangle=self._loss_2d)
        self._least, self._span = np.empty(0), np.empty(0)
        # Shares of the ranges that were asked for, by the point that each became, which is rounded.
        self._asked: dict[tuple[float, ...], tuple[float, ...]] = {}

    def tell(self, points: Sequence[Sequence[float]], answers: FloatArray) -> None:
        """Take down what was answered, (points, questions); NaN where there was no answer."""
        if not self._span.size:  # the first points say what is much and what is little
            with np.errstate(all="ignore"):
                finite = np.where(np.isfinite(answers), answers, math.nan)
                empty = np.isnan(finite).all(axis=0)
                finite[:, empty] = 0.0
                self._least = np.nanmin(finite, axis=0)
                spread = np.nanmax(finite, axis=0) - self._least
            self._span = np.where(spread > 0.0, spread, 1.0)
        for point, answer in zip(points, answers, strict=True):
            known = np.isfinite(answer)
            values = np.where(known, (answer - self._least) / self._span, 0.0)
            scaled = self._asked.get(tuple(point)) or tuple(
                (one - low) / (high - low) for one, (low, high) in zip(point, self._ends, strict=True)
            )
            self._learner.tell(
                scaled[0] if self._one else scaled, np.concatenate([values, BORDER * known])
            )

    def ask(self, count: int) -> list[tuple[float, ...]]:
        """The next points, at most so many; none where all is as fine as required."""
        if self._learner.loss(real=False) == 0.0:
            return []
        found, _gains = self._learner.ask(count, tell_pending=True)
        shares = [(one,) if self._one else tuple(one) for one in found]
        points = [
            tuple(
                low + float(share) * (high - low)
                for share, (low, high) in zip(one, self._ends, strict=True)
            )
            for one in shares
        ]
        self._asked.update(zip(points, shares, strict=True))
        return points

    def _loss(self, xs: Sequence[float], ys: Sequence[Any]) -> float:
        """The loss of an interval: its length, unless it is narrow or level."""
        width, change = xs[1] - xs[0], float(np.abs(ys[1] - ys[0]).max())
        return 0.0 if min(width, change) < self._to else math.hypot(width, change)

    def _loss_2d(self, interpolator: Any) -> FloatArray:
        """The same for each triangle."""
        corners = interpolator.tri.points[interpolator.tri.simplices]
        values = interpolator.values[interpolator.tri.simplices]
        width = (corners.max(axis=1) - corners.min(axis=1)).max(axis=1)
        change = (values.max(axis=1) - values.min(axis=1)).max(axis=1)
        done: FloatArray = np.where(
            np.minimum(width, change) < self._to, 0.0, width * np.hypot(width, change)
        )
        return done
