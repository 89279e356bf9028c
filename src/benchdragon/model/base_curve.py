"""What every curve can tell of itself, from the kernels' rows of it, and checks of sizes and poses."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np
import numpy.typing as npt

from benchdragon.errors import InputError, finite, positive
from benchdragon.i18n import _
from benchdragon.kernels import curve as kernel
from benchdragon.kernels import route_parts
from benchdragon.kernels.curve import MOST_METRES, FloatArray, RouteRow
from benchdragon.kernels.route import evaluate
from benchdragon.kernels.route_parts import Pose
from benchdragon.methods import Method
from benchdragon.model.arrays import as_numbers

if TYPE_CHECKING:
    from benchdragon.figures import plots

Point = tuple[float, float]
# A row of the kernels' table of parts: kind, x, y, angle, size, first, last and hand.
PartNumbers = Sequence[float]
NOWHERE = Pose(0.0, 0.0, 0.0)

# Pitches and radii, m: their inverses spoil sums where they are smaller.
LEAST_METRES = 1e-6


class Curve:
    """What every curve and every route can tell: where it runs, at any arc length.

    Attributes:
        called: what kind of curve it is, in words.
    """

    called: ClassVar[str]
    plot = plots.plot_route if TYPE_CHECKING else Method("plot_route")
    _repr_html_ = Method("as_html")

    @property
    def parts(self) -> FloatArray:
        """The curves as a plan says them, one row each: see kernels/route_parts.py."""
        raise NotImplementedError

    @cached_property
    def rows(self) -> FloatArray:
        """The curve as the kernels see it, (pieces, COLUMNS); read-only."""
        rows = laid_rows(self.parts)
        rows.flags.writeable = False
        return rows

    @property
    def length(self) -> float:
        """Exact length from start to end, m."""
        return float(self.rows[-1, RouteRow.S_START] + self.rows[-1, RouteRow.LENGTH])

    @property
    def extension(self) -> float:
        """How far the curve runs on behind its start, m: 0 or infinite.

        A line runs on straight and an inward spiral runs on outward; a dragon may stand there.
        """
        return 0.0 if math.isfinite(self.rows[0, RouteRow.U_BACK]) else math.inf

    def point(self, s: npt.ArrayLike) -> FloatArray:
        """Points at arc lengths s (m), of shape s.shape + (2,).

        Raises:
            InputError: if an s lies off the curve and its extension.
        """
        return self._evaluate(s)[..., :2]

    def heading(self, s: npt.ArrayLike) -> FloatArray:
        """Headings of the tangent at arc lengths s, rad, continuous along each curve."""
        return self._evaluate(s)[..., 2]

    def curvature(self, s: npt.ArrayLike) -> FloatArray:
        """Curvatures at arc lengths s, 1/m, left positive; at a joint that of the later curve."""
        return self._evaluate(s)[..., 3]

    def _evaluate(self, s: npt.ArrayLike) -> FloatArray:
        lengths = as_numbers("s", s)
        out = np.empty((lengths.size, 4))
        evaluate(self.rows, lengths.ravel(), out)
        off = np.isnan(out[:, 0])
        if off.any():
            raise InputError(
                _("s must lie between {low} and {high} m, not at {value} m").format(
                    low=f"{0.0 - self.extension:g}",
                    high=f"{self.length:.12g}",
                    value=f"{lengths.ravel()[off][0]:.12g}",
                )
            )
        return out.reshape(*lengths.shape, 4)

    @property
    def start_pose(self) -> tuple[Point, float]:
        """Point and heading of the start."""
        x, y, heading = route_parts.start_pose(self.rows, 0)
        return (x, y), heading

    @property
    def end_pose(self) -> tuple[Point, float]:
        """Point and heading of the end."""
        x, y, heading = route_parts.end_pose(self.rows, len(self.rows) - 1)
        return (x, y), heading


def laid_rows(parts: FloatArray, start: Pose = NOWHERE, moved: tuple[int, int] = (0, 0)) -> FloatArray:
    """The rows of a route of these parts; those from the one number to before the other are moved.

    Each of these, in `parts` as well, to where the one before it ends; the first part to `start`.
    """
    rows = np.zeros((route_parts.row_count(parts), kernel.COLUMNS))
    route_parts.lay_rows(parts, start, *moved, rows)
    return rows


@dataclass(frozen=True)
class OneCurve(Curve):
    """A curve that is no route: one part, which can be moved.

    Attributes:
        kind: the kernels' number of such curves.
    """

    kind: ClassVar[float]

    def _part(self) -> PartNumbers:
        """Its row of `parts`."""
        raise NotImplementedError

    @classmethod
    def _from(cls, part: PartNumbers) -> Self:
        """The curve of a row of `parts`."""
        raise NotImplementedError

    @property
    def parts(self) -> FloatArray:
        """The curve as a plan says it, one row: see kernels/route_parts.py."""
        return np.array([self._part()], np.float64)

    def moved(self, point: Point, heading: float) -> Self:
        """The same curve starting at `point` with `heading`."""
        check_pose(point, heading)
        parts = self.parts
        laid_rows(parts, Pose(*point, heading), (0, 1))
        return type(self)._from(parts.tolist()[0])


def kernel_pose(pose: tuple[Point, float]) -> Pose:
    """A point, m, and a heading, rad, as the kernels take them."""
    return Pose(*pose[0], pose[1])


def check_pose(point: Point, heading: float) -> None:
    """Refuse a start or centre (m) and a heading (rad) that cannot be."""
    if np.shape(point) != (2,):
        raise InputError(_("a start or centre must be a pair (x, y), not {value}").format(value=point))
    for value in point:
        if abs(finite("start", value, "m")) > MOST_METRES:
            raise InputError(_("a start or centre must lie within 1e8 m of the origin"))
    finite("heading", heading, "rad")


def checked_bend(name: str, value: float) -> float:
    """`value` if it may be a pitch or a radius, m."""
    if positive(name, value, "m") < LEAST_METRES:
        text = _("{name} must be at least {least} m, not {value} m")
        raise InputError(text.format(name=name, least=f"{LEAST_METRES:g}", value=f"{value:g}"))
    return checked_size(name, value)


def checked_size(name: str, value: float) -> float:
    """`value` if it may be a length or a radius, m."""
    if positive(name, value, "m") > MOST_METRES:
        text = _("{name} must be at most {most} m, not {value} m")
        raise InputError(text.format(name=name, most=f"{MOST_METRES:g}", value=f"{value:g}"))
    return value
