"""Points of a route by formulas that the kernels do not use, many at a time, as complex numbers.

Arcs as e^i - 1 about their centre, clothoids by SciPy's Fresnel integrals, spirals by bisection of
their length, logarithmic spirals as powers of their radius about the pole. `first_root` looks for
the next handle by a dense scan and SciPy's brentq.
"""

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq
from scipy.special import fresnel

from benchdragon.model.curves import Arc, Clothoid, Line, LogSpiral, Route, Spiral

Complex = npt.NDArray[np.complex128]
Float = npt.NDArray[np.float64]

SAMPLES = 400  # of the scan, a link


def expi(angle: npt.ArrayLike) -> Complex:
    return np.exp(1j * np.asarray(angle))


def line_points(line: Line, s: Float) -> Complex:
    return complex(*line.start) + s * expi(line.start_heading)


def arc_points(arc: Arc, s: Float) -> Complex:
    side = 1j * np.sign(arc.sweep) * arc.radius * expi(arc.start_heading)
    return np.asarray(complex(*arc.start) - side * np.expm1(1j * np.sign(arc.sweep) * s / arc.radius))


def clothoid_points(clothoid: Clothoid, s: Float) -> Complex:
    """The integral of exp i (a + c w^2 / 2) over w = s + k / c: heading a where the curvature is 0."""
    rate = (clothoid.end_curvature - clothoid.start_curvature) / clothoid.length_m
    first = clothoid.start_curvature / rate
    turn = clothoid.start_heading - 0.5 * rate * first * first
    scale = np.sqrt(np.pi / abs(rate))
    (s0, c0), (s1, c1) = fresnel(first / scale), fresnel((first + s) / scale)
    run = (c1 - c0) + 1j * np.sign(rate) * (s1 - s0)
    return np.asarray(complex(*clothoid.start) + scale * expi(turn) * run)


def spiral_points(spiral: Spiral, s: Float) -> Complex:
    def metres(theta: Float) -> Float:
        root = np.sqrt(1.0 + theta * theta)
        return np.asarray(0.5 * spiral.k * (theta * root + np.log(theta + root)))

    way = np.sign(spiral.end_angle - spiral.start_angle)
    wanted = metres(np.asarray(spiral.start_angle)) + way * s
    low = np.zeros(np.shape(s))
    high = np.sqrt(2.0 * wanted / spiral.k) + 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        short = metres(middle) < wanted
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    theta = 0.5 * (low + high)
    hand = -1.0 if spiral.mirrored else 1.0
    return np.asarray(complex(*spiral.centre) + spiral.k * theta * expi(spiral.rotation + hand * theta))


def log_spiral_points(curve: LogSpiral, s: Float) -> Complex:
    """About its pole, from which the arm leans by one angle against the tangent, long as its radius."""
    radii = 1.0 / curve.start_curvature, 1.0 / curve.end_curvature
    lean = (radii[1] - radii[0]) / curve.length_m + 1j  # of radius and tangent
    grown = 1.0 + lean.real * s / radii[0]
    arm = radii[0] / lean * expi(curve.start_heading)
    return np.asarray(complex(*curve.start) + arm * (grown ** (1.0 + 1j / lean.real) - 1.0))


def points(route: Route, s: npt.ArrayLike) -> Complex:
    """Points of `route` at route positions s."""
    at = np.atleast_1d(np.asarray(s, dtype=np.float64))
    part = np.clip(np.searchsorted(route.joints, at, side="right") - 1, 0, len(route.curves) - 1)
    out = np.empty(at.shape, dtype=np.complex128)
    for i, curve in enumerate(route.curves):
        local = at[part == i] - route.joints[i]
        match curve:
            case Line():
                out[part == i] = line_points(curve, local)
            case Arc():
                out[part == i] = arc_points(curve, local)
            case Clothoid():
                out[part == i] = clothoid_points(curve, local)
            case LogSpiral():
                out[part == i] = log_spiral_points(curve, local)
            case Spiral():
                out[part == i] = spiral_points(curve, local)
    return out


def first_root(route: Route, front: float, link: float, back: float) -> float | None:
    """The largest position below `front`, not below `back`, one link away; None if there is none."""
    here = complex(points(route, front)[0])
    s = np.linspace(front, back, 2 + int(SAMPLES * (front - back) / link))
    long = np.flatnonzero(np.abs(points(route, s) - here) >= link)
    if not long.size:
        return None
    i = int(long[0])

    def excess(b: float) -> float:
        return abs(complex(points(route, b)[0]) - here) - link

    return float(brentq(excess, s[i], s[i - 1], xtol=1e-14, rtol=1e-15))
