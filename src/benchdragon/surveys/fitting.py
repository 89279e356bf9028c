"""A route along a drawn line, through its points or with corners rounded, and how near it keeps."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np

from benchdragon.errors import InputError, not_negative
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.curves import AnyCurve, Route
from benchdragon.surveys.alignment import GAP, KINK, Absorbed, joined_alignment, largest_misfits
from benchdragon.surveys.clothoids import bound_to_chord, circle_headings, g1_clothoids
from benchdragon.surveys.corners import MOST_CORNER, Corners, radii, rounded, shapes
from benchdragon.surveys.lines import MOST_CURVES, DrawnLine, most_bend

Smooth = Literal["none", "G1", "G2"]
# Shares of the deviation that leaving out points may take; bends take the rest. All are tried.
SHARES = (0.0, 0.125, 0.25, 0.5, 0.75)
# Share of the deviation that chords of drawn arcs may take where their corners are to be rounded.
CHORDS = 0.0625
# Places are computed to within this, m, a metre of coordinates: it is added to bounds.
ROUNDING = 1e-14
# Share of the deviation that sums of shares of it may lose.
SLACK = 1e-9


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
        fit = _through(line) if smooth == "none" else _rounded(line, smooth == "G2", deviation)
    else:
        most = kink if smooth == "none" else math.inf
        bridged, sharpest = largest_misfits(line.pieces(), line.closed, gap, most)
        if smooth != "G2" and sharpest <= kink:
            fit = _as_drawn(line, gap, kink)
        else:
            fit = _rounded(replace(line, off=line.off + bridged), smooth == "G2", deviation)
    return _checked(fit, deviation, least_radius)


def _check_line(line: DrawnLine) -> None:
    wanted = 3 if line.closed and not line.bent else 2
    if not line.curves and len(line.corners) < wanted:
        raise InputError(
            _("a drawn line needs {wanted} different points at least, not {count}").format(
                wanted=wanted, count=len(line.corners)
            )
        )
    if len(line.curves or line.corners) > MOST_CURVES:
        raise InputError(
            _("a drawn route may have {most} points at most, not {count}: leave some out").format(
                most=MOST_CURVES, count=len(line.curves or line.corners)
            )
        )


def _as_drawn(line: DrawnLine, gap: float, kink: float) -> Fit:
    curves, absorbed = joined_alignment(line.pieces(), line.closed, gap, kink)
    return _fit(curves, line.off + absorbed.shift + 0.5 * absorbed.gap, absorbed)


def _through(line: DrawnLine) -> Fit:
    """Through every point, by clothoids that meet with the headings of circles through neighbours."""
    points = line.corners[:, :2]
    poses = np.column_stack([points, circle_headings(points, line.closed)])
    if line.closed:
        poses = np.vstack([poses, poses[:1]])
    curves = g1_clothoids(poses)
    off = max(bound_to_chord(curve) for curve in curves)
    return _fit(curves, line.off + off, Absorbed(len(curves) - (not line.closed)))


def _rounded(line: DrawnLine, smooth: bool, deviation: float) -> Fit:
    """With corners rounded: of several ways to share the deviation that with the widest bends."""
    points, off = line.points(max(CHORDS * deviation, 1e-6))
    if len(points) > MOST_CURVES:
        raise InputError(_("the arcs of the drawing need too many chords: allow a larger deviation"))
    off += ROUNDING * (1.0 + float(np.abs(points).max()))
    left = (1.0 - SLACK) * (deviation - off)
    if left <= 0.0:
        raise InputError(
            _(
                "a deviation of {deviation} m leaves nothing to round corners with: the drawing "
                "itself is known to {off} m"
            ).format(deviation=f"{deviation:g}", off=f"{off:.3g}")
        )
    best: tuple[float, FloatArray, FloatArray] | None = None
    for share in SHARES:
        kept, strays = simplified(points, line.closed, share * left)
        corners = Corners.of(points[kept], line.closed)
        least = _least(corners, strays, left, smooth)
        if best is None or least > best[0]:
            best = least, kept, strays
    assert best is not None
    _least_radius, kept, strays = best
    return _round(Corners.of(points[kept], line.closed), strays, left, smooth, off)


def _allowed(strays: FloatArray, left: float) -> FloatArray:
    """What the bend at the end of each side may add to what its two sides stray already, m."""
    return np.asarray(left - np.maximum(strays, np.roll(strays, -1)))


def _least(corners: Corners, strays: FloatArray, left: float, smooth: bool) -> float:
    if np.abs(corners.turns).max(initial=0.0) > MOST_CORNER:
        return -1.0
    shape = shapes(corners.turns, smooth)
    return float(radii(corners, shape, _allowed(strays, left)).min())


def _round(corners: Corners, strays: FloatArray, left: float, smooth: bool, off: float) -> Fit:
    sharp = int(np.argmax(np.abs(corners.turns)))
    if abs(corners.turns[sharp]) > MOST_CORNER:
        x, y = corners.points[sharp + 1]
        raise InputError(
            _("at ({x}, {y}) m the drawing doubles straight back: no bend rounds that").format(
                x=f"{x:.6g}", y=f"{y:.6g}"
            )
        )
    shape = shapes(corners.turns, smooth)
    bends = radii(corners, shape, _allowed(strays, left))
    cut = np.where(np.isfinite(bends), bends, 0.0) * shape.reach
    bound = float((np.maximum(strays, np.roll(strays, -1)) + cut).max())
    curves = rounded(corners, shape, bends)
    return _fit(curves, off + bound, Absorbed(len(curves) - 1))


def simplified(points: FloatArray, closed: bool, tolerance: float) -> tuple[FloatArray, FloatArray]:
    """Which of points (P, 2) to keep, and how far each side between them strays, m, (sides,).

    Ramer, Douglas and Peucker: a side replaces what lies between its ends if every point there is
    within `tolerance` of it. The distance from a segment is convex, so that what lies between the
    points is as near; and what is replaced leads from one end of the side to the other, so that some
    point of it stands abreast of each point of the side: the bound holds either way.
    """
    ring = np.vstack([points, points[:1]]) if closed else points
    last = len(ring) - 1
    stack = [(0, last)]
    if closed:
        far = int(np.argmax(np.hypot(*(points - points[0]).T)))
        third = int(np.argmax(np.abs(_across(points, points[0], points[far]))))
        cuts = sorted({0, far, third, last})
        stack = list(pairwise(cuts))
    sides: list[tuple[int, int, float]] = []
    while stack:
        a, b = stack.pop()
        away = _distances(ring[a + 1 : b], ring[a], ring[b])
        worst = float(away.max(initial=0.0))
        if worst <= tolerance and (b - a == 1 or np.any(ring[a] != ring[b])):
            sides.append((a, b, worst))
        else:
            middle = a + 1 + int(np.argmax(away))
            stack += [(a, middle), (middle, b)]
    sides.sort()
    kept = [a for a, _b, _away in sides] + ([] if closed else [last])
    return np.array(kept), np.array([away for _a, _b, away in sides])


def _across(points: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    step = b - a
    return np.asarray((points[:, 0] - a[0]) * step[1] - (points[:, 1] - a[1]) * step[0])


def _distances(points: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    """How far points (P, 2) lie from the segment between a and b, m."""
    step = b - a
    size = float(step @ step)
    at = np.clip((points - a) @ step / size, 0.0, 1.0) if size else np.zeros(len(points))
    off = points - a - at[:, None] * step
    return np.asarray(np.hypot(off[:, 0], off[:, 1]))


def _fit(curves: Sequence[AnyCurve], deviation: float, absorbed: Absorbed) -> Fit:
    bends = [most_bend(curve) for curve in curves]
    worst = int(np.argmax(bends))
    route = Route(tuple(curves))
    radius = 1.0 / bends[worst] if bends[worst] else math.inf
    curve = curves[worst]
    later = abs(curve.curvature(curve.length)) > abs(curve.curvature(0.0))
    s = float(route.joints[worst]) + (curve.length if later else 0.0)
    return Fit(route, deviation, radius, s, absorbed)


def _checked(fit: Fit, deviation: float, least_radius: float) -> Fit:
    if fit.deviation > deviation:
        raise InputError(
            _(
                "the route keeps within {bound} m of the drawing, not within the deviation of "
                '{deviation} m: allow more, or round its corners by route.smooth = "G1"'
            ).format(bound=f"{fit.deviation:.3g}", deviation=f"{deviation:g}")
        )
    if fit.least_radius < least_radius:
        x, y = fit.route.point(min(fit.s, fit.route.length)).tolist()
        raise InputError(
            _(
                "at ({x}, {y}) m, s = {s} m, the route bends with a radius of {radius} m, and "
                "{wanted} m is wanted: allow a larger deviation than {deviation} m, or draw the "
                "bend wider"
            ).format(
                x=f"{x:.4f}", y=f"{y:.4f}", s=f"{fit.s:.4f}", radius=f"{fit.least_radius:.4g}",
                wanted=f"{least_radius:g}", deviation=f"{deviation:g}",
            )
        )  # fmt: skip
    return fit
