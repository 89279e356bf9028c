"""Clothoids between poses: one from each point and heading to the next."""

import math

import numpy as np

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.curves import AnyCurve, Clothoid, Line

# Newton's method for the shape of a clothoid: 4 steps are usual; half steps where it would overshoot.
MOST_STEPS = 60
# What is left of the ordinate of the end, as a share of the chord.
CLOSE = 1e-14
# Headings that are off their chord by less, rad, are those of a line.
STRAIGHT = 1e-12
# Nodes of the quadrature over one clothoid, which turns by some 10 rad at most.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(40)
NODES = 0.5 * (1.0 + _NODES)
WEIGHTS = 0.5 * _WEIGHTS
# A point of a clothoid lies within this of where it should, as a share of its length: rounding.
ROUNDING = 1e-13
# Steps at which two curves are compared; what may lie between them is added.
STEPS = 64


def folded(angle: FloatArray) -> FloatArray:
    """Angles, rad, folded into -pi..pi."""
    return angle - 2.0 * np.pi * np.round(angle / (2.0 * np.pi))


def g1_clothoids(poses: FloatArray) -> tuple[AnyCurve, ...]:
    """A clothoid from each pose (x, y, heading) to the next, of poses (P, 3) in metres and radians.

    One that is straight is a line.

    Of the many that meet both poses it is the one that winds least (Bertolazzi and Frego, G1 fitting
    with clothoids, 2015): with phi0 and phi1 the headings from the chord, the heading along it is
    A t^2 + (phi1 - phi0 - A) t + phi0 for t from 0 to 1, and the integral of its sine is 0.

    Raises:
        InputError: for poses in one place, and for headings that look back along the chord.
    """
    start, end = poses[:-1], poses[1:]
    step = end[:, :2] - start[:, :2]
    chord = np.hypot(step[:, 0], step[:, 1])
    if not np.all(chord > 0.0):
        n = int(np.argmin(chord > 0.0))
        raise InputError(
            _("points {first} and {second} are in one place").format(first=n + 1, second=n + 2)
        )
    along = np.arctan2(step[:, 1], step[:, 0])
    phi0, phi1 = folded(start[:, 2] - along), folded(end[:, 2] - along)
    bend = _shape(phi0, phi1)
    change = phi1 - phi0
    headings = bend[:, None] * NODES**2 + (change - bend)[:, None] * NODES + phi0[:, None]
    share = np.cos(headings) @ WEIGHTS
    length = chord / share
    first, last = (change - bend) / length, (change + bend) / length
    rows = np.column_stack([length, first, last, start])
    straight = (np.maximum(np.abs(phi0), np.abs(phi1)) <= STRAIGHT).tolist()
    return tuple(
        Line(n, (x, y), angle) if plain else Clothoid(n, a, b, (x, y), angle)
        for plain, (n, a, b, x, y, angle) in zip(straight, rows.tolist(), strict=True)
    )


def _shape(phi0: FloatArray, phi1: FloatArray) -> FloatArray:
    """A of each clothoid: Newton's method from the shape of a gentle one."""
    a = 3.0 * (phi0 + phi1)
    change = phi1 - phi0
    left = _ordinate(a, change, phi0)
    for _step in range(MOST_STEPS):
        open_ = np.abs(left) > CLOSE
        if not open_.any():
            break
        slope = _slope(a, change, phi0)
        move = np.where(open_, -left / np.where(slope == 0.0, 1.0, slope), 0.0)
        for _half in range(MOST_STEPS):
            tried = _ordinate(a + move, change, phi0)
            worse = np.abs(tried) > np.abs(left)
            if not worse.any():
                break
            move = np.where(worse, 0.5 * move, move)
        a, left = a + move, tried
    share = np.cos(a[:, None] * (NODES**2 - NODES) + change[:, None] * NODES + phi0[:, None]) @ WEIGHTS
    bad = (np.abs(left) > 1e-12) | (share < 1e-3)
    if bad.any():
        n = int(np.argmax(bad))
        raise InputError(
            _(
                "no gentle curve leads from point {first} to point {second}: the line doubles back "
                "there"
            ).format(first=n + 1, second=n + 2)
        )
    return a


def _ordinate(a: FloatArray, change: FloatArray, phi0: FloatArray) -> FloatArray:
    """Integral of the sine of the heading, over the chord."""
    headings = a[:, None] * (NODES**2 - NODES) + change[:, None] * NODES + phi0[:, None]
    return np.asarray(np.sin(headings) @ WEIGHTS)


def _slope(a: FloatArray, change: FloatArray, phi0: FloatArray) -> FloatArray:
    """Its derivative by A."""
    headings = a[:, None] * (NODES**2 - NODES) + change[:, None] * NODES + phi0[:, None]
    return np.asarray((np.cos(headings) * (NODES**2 - NODES)) @ WEIGHTS)


def circle_headings(points: FloatArray, closed: bool) -> FloatArray:
    """At each of points (P, 2) the heading, rad, of the circle through it and both its neighbours.

    At the ends of an open line it is that of the circle of the point beside it.
    """
    ring = np.vstack([points[-1:], points, points[:1]]) if closed else points
    step = np.diff(ring, axis=0)
    along = np.arctan2(step[:, 1], step[:, 0])
    if len(along) == 1:
        return np.repeat(along, 2)
    turn = folded(np.diff(along))
    # The angle between a chord and the tangent at its end is the one at the far point over that chord.
    far = ring[2:] - ring[:-2]
    over = np.arctan2(far[:, 1], far[:, 0])
    inner = along[:-1] + np.where(np.abs(turn) < math.pi, folded(along[1:] - over), 0.0)
    if closed:
        return np.asarray(inner)
    return np.concatenate([[2.0 * along[0] - inner[0]], inner, [2.0 * along[-1] - inner[-1]]])


def bound_to_chord(curve: AnyCurve) -> float:
    """A bound on how far a curve and the chord between its ends lie from each other, either way, m.

    Between two places h metres apart the curve keeps within k h^2 / 8 of its own chord, if its
    curvature is at most k, and on that chord the distance from a segment is greatest at an end. And
    since the curve leads from one end of the segment to the other, some point of it stands abreast
    of each point of the segment.
    """
    points = curve.point(np.linspace(0.0, curve.length, STEPS + 1))
    step = points[-1] - points[0]
    size = float(step @ step)
    at = np.clip((points - points[0]) @ step / size, 0.0, 1.0)
    off = points - points[0] - at[:, None] * step
    bend = float(np.abs(curve.curvature([0.0, curve.length])).max())
    between = 0.125 * bend * (curve.length / STEPS) ** 2
    return float(np.hypot(off[:, 0], off[:, 1]).max()) + between + ROUNDING * curve.length


def bound_between(one: AnyCurve, other: AnyCurve) -> float:
    """A bound on how far two curves lie from each other at equal shares of their lengths, m.

    With curvature k, heading w and length L, both functions of the share t, the second derivative of
    a curve is L^2 k times its normal. That of the difference is therefore at most the difference of
    L^2 k, which is linear in t, plus L^2 k of one times the angle between the headings, which is
    quadratic. Between two places the difference keeps within an eighth of that times their distance
    squared of a straight line between them.
    """
    shares = np.linspace(0.0, 1.0, STEPS + 1)
    apart = one.point(shares * one.length) - other.point(shares * other.length)
    ends = np.array([0.0, 0.5, 1.0])
    a, b = (one.length**2 * one.curvature(ends * one.length),
            other.length**2 * other.curvature(ends * other.length))  # fmt: skip
    angle = np.abs(folded(one.heading(ends * one.length) - other.heading(ends * other.length)))
    skew = float(angle.max() + 0.5 * abs(angle[0] + angle[2]) + angle[1])
    second = float(np.abs(a - b).max() + np.abs(b).max() * skew)
    rounding = ROUNDING * (one.length + other.length)
    return float(np.hypot(apart[:, 0], apart[:, 1]).max()) + 0.125 * second / STEPS**2 + rounding
