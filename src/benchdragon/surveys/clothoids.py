"""Clothoids between poses: one from each point and heading to the next."""

import numpy as np

from benchdragon.errors import InputError
from benchdragon.i18n import N_, _
from benchdragon.kernels import fitting as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.fitting import CLOTHOID_ROUNDING, CURVE_STEPS
from benchdragon.kernels.route_parts import PART_COLUMNS
from benchdragon.kernels.status import FitStatus
from benchdragon.model.curves import AnyCurve, curves_of


def folded(angle: FloatArray) -> FloatArray:
    """Angles, rad, folded into -pi..pi."""
    return angle - 2.0 * np.pi * np.round(angle / (2.0 * np.pi))


def g1_clothoids(poses: FloatArray) -> tuple[AnyCurve, ...]:
    """A clothoid from each pose (x, y, heading) to the next, of poses (P, 3) in metres and radians.

    One that is straight is a line: see kernels/fitting.py.

    Raises:
        InputError: for poses in one place, and for headings that look back along the chord.
    """
    parts = np.empty((len(poses) - 1, PART_COLUMNS))
    status, n = kernel.g1_clothoids(poses, parts)
    if status != FitStatus.OK:
        raise unfit(status, n)
    return curves_of(parts)


def unfit(status: FitStatus, n: int) -> InputError:
    """That no clothoid leads from pose number n to the next, and why."""
    text = {
        FitStatus.ONE_PLACE: N_("points {first} and {second} are in one place"),
        FitStatus.DOUBLES_BACK: N_(
            "no gentle curve leads from point {first} to point {second}: the line doubles back there"
        ),
    }[status]
    return InputError(_(text).format(first=n + 1, second=n + 2))


def bound_between(one: AnyCurve, other: AnyCurve) -> float:
    """A bound on how far two curves lie from each other at equal shares of their lengths, m.

    With curvature k, heading w and length L, both functions of the share t, the second derivative of
    a curve is L^2 k times its normal. That of the difference is therefore at most the difference of
    L^2 k, which is linear in t, plus L^2 k of one times the angle between the headings, which is
    quadratic. Between two places the difference keeps within an eighth of that times their distance
    squared of a straight line between them.
    """
    shares = np.linspace(0.0, 1.0, CURVE_STEPS + 1)
    apart = one.point(shares * one.length) - other.point(shares * other.length)
    ends = np.array([0.0, 0.5, 1.0])
    a, b = (one.length**2 * one.curvature(ends * one.length),
            other.length**2 * other.curvature(ends * other.length))  # fmt: skip
    angle = np.abs(folded(one.heading(ends * one.length) - other.heading(ends * other.length)))
    skew = float(angle.max() + 0.5 * abs(angle[0] + angle[2]) + angle[1])
    second = float(np.abs(a - b).max() + np.abs(b).max() * skew)
    rounding = CLOTHOID_ROUNDING * (one.length + other.length)
    return float(np.hypot(apart[:, 0], apart[:, 1]).max()) + 0.125 * second / CURVE_STEPS**2 + rounding
