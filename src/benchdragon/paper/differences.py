"""Speeds from differences of places, the paper's way, compared with the exact ones: error analysis."""

from collections.abc import Sequence
from typing import Literal

import numpy as np

from benchdragon.errors import positive
from benchdragon.i18n import N_
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.walk import Walk

Scheme = Literal["forward", "central", "backward"]
SCHEMES: tuple[Scheme, ...] = ("forward", "central", "backward")
# Their names.
SCHEME_NAMES = {"forward": N_("forward"), "central": N_("central"), "backward": N_("backward")}
# Offsets of the two places, in steps.
ENDS = {"forward": (0.0, 1.0), "central": (-1.0, 1.0), "backward": (-1.0, 0.0)}


def difference_velocities(
    walk: Walk, times: Sequence[float] | FloatArray, step: float, scheme: Scheme
) -> FloatArray:
    """Velocities of every handle from two places `step` or 2 `step` (s) apart, m/s, (T, N + 1, 2)."""
    clock = np.asarray(times, dtype=np.float64)
    before, after = (offset * positive("step", step, "s") for offset in ENDS[scheme])
    ends = walk.motion(np.concatenate([clock + before, clock + after]))
    places = np.stack([ends.x, ends.y], axis=-1)
    return np.asarray((places[clock.size :] - places[: clock.size]) / (after - before))


def difference_speeds(
    walk: Walk, times: Sequence[float] | FloatArray, step: float, scheme: Scheme
) -> FloatArray:
    """Speeds of every handle from differences of places, as the paper takes them, m/s, (T, N + 1)."""
    return np.asarray(np.linalg.norm(difference_velocities(walk, times, step, scheme), axis=-1))


def exact_velocities(walk: Walk, times: Sequence[float] | FloatArray) -> FloatArray:
    """Velocities of every handle from exact speeds and tangents, m/s, (T, N + 1, 2)."""
    motion = walk.motion(times)
    heading = walk.route.heading(motion.s)
    tangent = np.stack([np.cos(heading), np.sin(heading)], axis=-1)
    return np.asarray(motion.speed[..., np.newaxis] * tangent)


def difference_errors(
    walk: Walk, times: Sequence[float] | FloatArray, steps: Sequence[float], scheme: Scheme
) -> FloatArray:
    """Largest error of the difference velocities over times and handles, m/s, one for each step."""
    exact = exact_velocities(walk, times)
    errors = [
        np.linalg.norm(difference_velocities(walk, times, step, scheme) - exact, axis=-1).max()
        for step in steps
    ]
    return np.array(errors)


def order(steps: Sequence[float], errors: FloatArray) -> float:
    """Order of convergence: the slope of log error over log step, by least squares."""
    return float(np.polyfit(np.log(steps), np.log(errors), 1)[0])
