"""Error analysis of the paper's methods: orders, accumulation along the benches, steps."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from benchdragon.errors import InputError, positive
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray, spiral_length
from benchdragon.model.curves import Spiral
from benchdragon.model.walk import Motion, Walk
from benchdragon.paper.differences import SCHEMES, difference_errors, order
from benchdragon.paper.runge_kutta import head_positions
from benchdragon.paper.sensitivity import Configuration, Drift, changed, dot

# Steps, s, at which methods are compared. Runge-Kutta is fitted where rounding does not show.
DIFFERENCE_STEPS = (0.8, 0.4, 0.2, 0.1, 0.05, 0.025)
RUNGE_KUTTA_STEPS = (20.0, 10.0, 5.0, 2.5, 1.25, 0.625, 0.3125)
ROUNDING = 1e-11
# What contest programs end their search for the next handle at: an interval of theta, rad.
BISECTION = 1e-8


@dataclass(frozen=True)
class Convergence:
    """The errors of a method at several steps, and its order.

    Attributes:
        steps: s, (S,).
        errors: the largest at each step, (S,): m for places, m/s for speeds.
        fitted: which of them rounding has not spoilt, (S,).
        order: the slope of log error over log step through these.
    """

    steps: FloatArray
    errors: FloatArray
    fitted: np.ndarray[tuple[int], np.dtype[np.bool_]]
    order: float

    @classmethod
    def of(cls, steps: Sequence[float], errors: Sequence[float] | FloatArray) -> "Convergence":
        """Fit the order where errors are well above rounding."""
        size, off = np.asarray(steps, dtype=np.float64), np.asarray(errors, dtype=np.float64)
        fitted = off > ROUNDING
        return cls(size, off, fitted, order(size[fitted].tolist(), off[fitted]))


def runge_kutta_convergence(walk: Walk, end: float = 300.0) -> Convergence:
    """The head's place at time `end`, s, by classical Runge-Kutta against the closed form."""
    exact = walk.head_position([0.0, end])
    errors = [
        float(np.abs(head_positions(walk, [0.0, end], "rk4", step) - exact).max())
        for step in RUNGE_KUTTA_STEPS
    ]
    return Convergence.of(RUNGE_KUTTA_STEPS, errors)


def difference_convergence(walk: Walk, times: Sequence[float] | FloatArray) -> dict[str, Convergence]:
    """Velocities of all handles at `times` (s) by each difference formula against the exact ones."""
    return {
        scheme: Convergence.of(
            DIFFERENCE_STEPS, difference_errors(walk, times, DIFFERENCE_STEPS, scheme)
        )
        for scheme in SCHEMES
    }


def chord_residuals(motion: Motion) -> FloatArray:
    """For each bench, the largest difference of its handles' distance from its link, m, (N,)."""
    chords = np.hypot(np.diff(motion.x, axis=1), np.diff(motion.y, axis=1))
    return np.asarray(np.abs(chords - motion.walk.dragon.links).max(axis=0))


def accumulated(motion: Motion) -> FloatArray:
    """How far each handle of a motion's one time is from its exact place on the route, m, (N + 1,).

    Exact for the sizes as they are stored: 1.65 m is stored 4e-16 m off.

    The residual of every chord, in extended precision where the machine has it, is sent down the chain
    by the law that says how handles follow a link that is a little longer: what is left is of second
    order.

    Raises:
        InputError: for a route that is not one spiral.
    """
    x, y = (table[0].astype(np.longdouble) for table in (motion.x, motion.y))
    residual = np.hypot(np.diff(x), np.diff(y)) - motion.walk.dragon.links
    handles = len(x)
    sizes = np.zeros((4, handles - 1))
    sizes[0] = -residual.astype(np.float64)
    # What would put the head and the links right moves each handle by its error.
    configuration, (px, py) = Configuration.of(motion), _head_place(motion)
    apart = complex(float(px - x[0]), float(py - y[0]))
    head = dot(apart, configuration.tangent[0])
    moved = Drift(np.zeros((handles, 2)), np.zeros(handles), sizes, head)
    return np.asarray(np.abs(changed(configuration, moved).along))


def _head_place(motion: Motion) -> tuple[np.longdouble, np.longdouble]:
    """Where the head's handle should stand, m, in extended precision: Newton for theta."""
    spiral = _spiral(motion.walk)
    pi = np.arctan2(np.longdouble(0.0), np.longdouble(-1.0))
    k = np.longdouble(spiral.pitch) / (2.0 * pi)
    theta = np.longdouble(motion.state(0)[1][0])
    start = np.longdouble(spiral.start_angle)
    way = 1.0 if spiral.end_angle > spiral.start_angle else -1.0
    for _step in range(3):
        walked = way * (_metres(k, theta) - _metres(k, start)) - np.longdouble(motion.head_s[0])
        theta -= way * walked / (k * np.sqrt(1.0 + theta * theta))
    turned = (-1.0 if spiral.mirrored else 1.0) * theta + np.longdouble(spiral.rotation)
    cx, cy = spiral.centre
    return cx + k * theta * np.cos(turned), cy + k * theta * np.sin(turned)


def _metres(k: np.longdouble, theta: np.longdouble) -> np.longdouble:
    """Arc length of a spiral from its centre to theta, m."""
    root = np.sqrt(1.0 + theta * theta)
    return np.longdouble(0.5 * k * (theta * root + np.log(theta + root)))


def bisected(motion: Motion, tolerance: float = BISECTION) -> FloatArray:
    """The same for a chain whose next theta is bisected until the interval is below `tolerance`, rad.

    This is how programs for the contest place handles: every bench adds its part of the interval to
    what it inherits.
    """
    spiral = _spiral(motion.walk)
    theta = [float(motion.state(0)[1][0])]
    for link in motion.walk.dragon.links.tolist():
        theta.append(_bisected_angle(spiral.k, theta[-1], link, positive("tolerance", tolerance)))
    exact = [spiral_length(spiral.k, angle) for angle in motion.state(0)[1].tolist()]
    found = [spiral_length(spiral.k, angle) for angle in theta]
    return np.asarray(np.abs(np.array(found) - np.array(exact)))


def _bisected_angle(k: float, theta: float, link: float, tolerance: float) -> float:
    low, high = theta, theta + math.pi
    while high - low > tolerance:
        middle = 0.5 * (low + high)
        chord = k * math.hypot(
            middle - theta * math.cos(middle - theta), theta * math.sin(middle - theta)
        )
        low, high = (middle, high) if chord < link else (low, middle)
    return 0.5 * (low + high)


def _spiral(walk: Walk) -> Spiral:
    spiral = walk.route.curves[0]
    if len(walk.route.curves) != 1 or not isinstance(spiral, Spiral):
        raise InputError(_("this is known for a route of one spiral alone"))
    return spiral
