"""A route along a drawn line, through its points or with corners rounded, and how near it keeps."""

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from benchdragon.errors import InputError, not_negative
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.fitting import fit_points
from benchdragon.kernels.route_parts import PART_COLUMNS, tightest_bend
from benchdragon.kernels.status import FitStatus, Smoothing
from benchdragon.model.curves import AnyCurve, Route, curves_of
from benchdragon.surveys.alignment import GAP, KINK, Absorbed, joined_alignment, largest_misfits
from benchdragon.surveys.clothoids import unfit
from benchdragon.surveys.lines import MOST_CURVES, DrawnLine

Smooth = Literal["none", "G1", "G2"]
# Share of the deviation that chords of drawn arcs may take where their corners are to be rounded.
CHORDS = 0.0625


@dataclass(frozen=True)
class Fit:
    """A route along a drawn line.

    Attributes:
        route: it.
        deviation: a bound on how far any point of it lies from the line, and any of the line from
            it, m.
        least_radius: of its tightest bend, m; infinite where there is none.
        s: where on the route that bend is, m.
        absorbed: what it took to make parts of the drawing meet.
    """

    route: Route
    deviation: float
    least_radius: float
    s: float
    absorbed: Absorbed


def fitted(
    line: DrawnLine,
    smooth: Smooth = "G1",
    deviation: float = 0.1,
    least_radius: float = 0.0,
    gap: float = GAP,
    kink: float = KINK,
) -> Fit:
    """The route along a line.

    Args:
        line: as it was drawn.
        smooth: "none": as it is, a line of points through every one by clothoids, any other with no
            more than small gaps and kinks absorbed; "G1": corners rounded by arcs; "G2": by clothoids
            with an arc between, so that the curvature does not jump. A line that needs no rounding
            stays as it is with "G1".
        deviation: the most by which route and line may differ, m.
        least_radius: that every bend must have, m.
        gap: the largest gap that is absorbed, m.
        kink: the largest kink that is absorbed, rad.

    Raises:
        InputError: where a bend is tighter, the line too far off, or a joint too wide: which place.
    """
    not_negative("deviation", deviation, "m")
    not_negative("least_radius", least_radius, "m")
    _check_line(line)
    if not line.bent:
        fit = _fitted(line, smooth, deviation)
    else:
        most = kink if smooth == "none" else math.inf
        bridged, sharpest = largest_misfits(line.pieces(), line.closed, gap, most)
        if smooth != "G2" and sharpest <= kink:
            fit = _as_drawn(line, gap, kink)
        else:
            fit = _fitted(replace(line, off=line.off + bridged), smooth, deviation)
    return checked_fit(fit, deviation, least_radius)


def check_fewest(count: int, closed: bool) -> None:
    """Refuse fewer points than a line has."""
    wanted = 3 if closed else 2
    if count < wanted:
        text = _("a drawn line needs {wanted} different points at least, not {count}")
        raise InputError(text.format(wanted=wanted, count=count))


def _check_line(line: DrawnLine) -> None:
    if not line.curves:
        check_fewest(len(line.corners), line.closed and not line.bent)
    if len(line.curves or line.corners) > MOST_CURVES:
        text = _("a drawn route may have {most} points at most, not {count}: leave some out")
        raise InputError(text.format(most=MOST_CURVES, count=len(line.curves or line.corners)))


def _as_drawn(line: DrawnLine, gap: float, kink: float) -> Fit:
    curves, absorbed = joined_alignment(line.pieces(), line.closed, gap, kink)
    return _fit(curves, line.off + absorbed.shift + 0.5 * absorbed.gap, absorbed)


def _fitted(line: DrawnLine, smooth: Smooth, deviation: float) -> Fit:
    """The route along the corners of a line, or of chords of what is bent."""
    points, off = line.points(max(CHORDS * deviation, 1e-6))
    if len(points) > MOST_CURVES:
        raise InputError(_("the arcs of the drawing need too many chords: allow a larger deviation"))
    return rounded(points, off, line.closed, smooth, deviation)


def rounded(points: FloatArray, off: float, closed: bool, smooth: Smooth, deviation: float) -> Fit:
    """The route along points, m, (P, 2), that may lie `off`, m, from what was drawn: see `fitted`."""
    parts = np.empty((4 * len(points), PART_COLUMNS))
    how = Smoothing[smooth.upper()]
    status, n, bound = fit_points(points, closed, how, deviation, off, parts)
    if status in (FitStatus.ONE_PLACE, FitStatus.DOUBLES_BACK):
        raise unfit(status, n)
    if status == FitStatus.NO_ROOM:
        text = _(
            "a deviation of {deviation} m leaves nothing to round corners with: the drawing "
            "itself is known to {off} m"
        )
        raise InputError(text.format(deviation=f"{deviation:g}", off=f"{bound:.3g}"))
    if status == FitStatus.HAIRPIN:
        x, y = points.tolist()[n]
        text = _("at ({x}, {y}) m the drawing doubles straight back: no bend rounds that")
        raise InputError(text.format(x=f"{x:.6g}", y=f"{y:.6g}"))
    joints = n - 1 if smooth != "none" or not closed else n
    return _fit(curves_of(parts[:n]), bound, Absorbed(joints))


def _fit(curves: tuple[AnyCurve, ...], deviation: float, absorbed: Absorbed) -> Fit:
    route = Route(curves)
    bend, s = tightest_bend(route.rows)
    return Fit(route, deviation, 1.0 / bend if bend else math.inf, s, absorbed)


def checked_fit(fit: Fit, deviation: float, least_radius: float) -> Fit:
    """A fit, if its deviation and its tightest bend are within the limits."""
    if fit.deviation > deviation:
        text = _(
            "the route keeps within {bound} m of the drawing, not within the deviation of "
            '{deviation} m: allow more, or round its corners by route.smooth = "G1"'
        )
        raise InputError(text.format(bound=f"{fit.deviation:.3g}", deviation=f"{deviation:g}"))
    if fit.least_radius < least_radius:
        x, y = fit.route.point(min(fit.s, fit.route.length)).tolist()
        raise InputError(
            _(
                "at ({x}, {y}) m, s = {s} m, the route bends with a radius of {radius} m, and "
                "{wanted} m is required: allow a larger deviation than {deviation} m, or draw the "
                "bend wider"
            ).format(
                x=f"{x:.4f}", y=f"{y:.4f}", s=f"{fit.s:.4f}", radius=f"{fit.least_radius:.4g}",
                wanted=f"{least_radius:g}", deviation=f"{deviation:g}",
            )
        )  # fmt: skip
    return fit
