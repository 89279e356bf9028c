"""The paper's way to the head's place: Runge-Kutta for d theta / dt = -v / (k sqrt(1 + theta^2)).

The closed form needs no differential equation (see `profile.SpeedProfile.distance`); the two check each
other, and what is integrated shows how errors arise.
"""

import itertools
import math
from collections.abc import Callable, Sequence
from typing import Literal

import numpy as np
import numpy.typing as npt

from benchdragon.errors import InputError, of_kind, positive
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray, spiral_length
from benchdragon.model.arrays import as_numbers
from benchdragon.model.curves import Spiral
from benchdragon.model.profile import SpeedProfile
from benchdragon.model.walk import Walk

# Fixed Runge-Kutta steps allowed in all: a minute or so of work.
MOST_STEPS = 5_000_000

Method = Literal["rk4", "adaptive"]
METHODS: tuple[Method, ...] = ("rk4", "adaptive")


def head_positions(
    walk: Walk, times: npt.ArrayLike, method: Method = "rk4", step: float = 0.1
) -> FloatArray:
    """Route positions of the head's handle at `times` (s), integrated, m, (times,).

    Args:
        walk: its head stays on one spiral at all times.
        times: in any order.
        method: "rk4", the classical one of fixed step, or "adaptive", SciPy's DOP853.
        step: of "rk4", s, at most.

    Raises:
        InputError: for a head on another curve, another method, or too many steps.

    Examples:
        >>> walk = bd.read_plan("spiral-in").build()
        >>> error = bd.head_positions(walk, [300.0], "rk4", 5.0) - walk.head_position([300.0])
        >>> bool(1e-9 < abs(error[0]) < 1e-7)
        True
    """
    of_kind("walk", walk, Walk)
    exact, route = walk.head_position(times), walk.route
    part = _only_part(walk, exact, method)
    curve = route.curves[part]
    if not isinstance(curve, Spiral):
        text = _("{method} integrates the equation of a spiral, and the head walks another curve")
        raise InputError(text.format(method=method))
    clock = np.atleast_1d(as_numbers("times", times)).tolist()
    start = walk.start - float(route.joints[part])
    theta = head_angles(curve, walk.profile, start, clock, method, step)
    ahead = np.array([spiral_length(curve.k, angle) for angle in theta])
    way = 1.0 if curve.end_angle > curve.start_angle else -1.0
    return np.asarray(route.joints[part] + way * (ahead - spiral_length(curve.k, curve.start_angle)))


def _only_part(walk: Walk, s: FloatArray, method: str) -> int:
    """The one part of the route on which the head is at positions s and at time 0."""
    last = len(walk.route.curves) - 1
    asked = np.append(s, walk.start)
    parts = np.clip(np.searchsorted(walk.route.joints, asked, side="right") - 1, 0, last)
    if np.ptp(parts):
        text = _("{method} needs the head on one spiral at all times, not on several curves")
        raise InputError(text.format(method=method))
    return int(parts[0])


def head_angles(
    spiral: Spiral, profile: SpeedProfile, start: float, times: Sequence[float], method: Method,
    step: float = 0.1,
) -> FloatArray:  # fmt: skip
    """theta of a head on `spiral` at `times` by Runge-Kutta, rad, (times,).

    Args:
        spiral: the head never leaves it (or its extension).
        profile: its speed.
        start: its arc length from the spiral's start at time 0, m.
        times: s, in any order.
        method: "rk4", the classical one of fixed step, or "adaptive", SciPy's DOP853.
        step: of "rk4", s, at most; legs between times and knots are cut into equal steps.
    """
    if method not in METHODS:
        text = _("method must be one of {known}, not {method}")
        raise InputError(text.format(known=", ".join(METHODS), method=method))
    positive("step", step, "s")
    advance, rate = _adaptive if method == "adaptive" else _rk4, _rate(spiral, profile)
    found = {0.0: float(spiral.angle(start))}
    stops = sorted({0.0, *times, *profile.times})
    if sum(abs(b - a) for a, b in itertools.pairwise(stops)) / step > MOST_STEPS:
        text = _("Runge-Kutta with a step of {step} s would take over {most} steps")
        raise InputError(text.format(step=f"{step:g}", most=MOST_STEPS))
    zero = stops.index(0.0)
    for way in (stops[zero:], stops[zero::-1]):
        for a, b in itertools.pairwise(way):
            found[b] = advance(rate, a, b, found[a], step)
    return np.array([found[float(t)] for t in times])


Rate = Callable[[float, float], float]


def _rate(spiral: Spiral, profile: SpeedProfile) -> Rate:
    """d theta / dt, rad/s, at time t and angle theta."""
    sign = 1.0 if spiral.end_angle > spiral.start_angle else -1.0

    def rate(t: float, theta: float) -> float:
        speed = float(np.interp(t, profile.times, profile.speeds))
        return sign * speed / (spiral.k * math.sqrt(1.0 + theta * theta))

    return rate


def _rk4(rate: Rate, a: float, b: float, theta: float, step: float) -> float:
    count = max(1, math.ceil(abs(b - a) / step - 1e-9))
    h = (b - a) / count
    for i in range(count):
        t = a + i * h
        k1 = rate(t, theta)
        k2 = rate(t + 0.5 * h, theta + 0.5 * h * k1)
        k3 = rate(t + 0.5 * h, theta + 0.5 * h * k2)
        k4 = rate(t + h, theta + h * k3)
        theta += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4)
    return theta


def _adaptive(rate: Rate, a: float, b: float, theta: float, _step: float) -> float:
    from scipy.integrate import solve_ivp  # slow to import, and needed by this method alone

    solution = solve_ivp(
        lambda t, y: [rate(t, y[0])], (a, b), [theta], method="DOP853", rtol=1e-13, atol=1e-13
    )
    return float(solution.y[0, -1])
