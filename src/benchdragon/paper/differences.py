"""Speeds from differences of places, the paper's way, compared with the exact ones: error analysis."""

from collections.abc import Sequence
from typing import Literal

import numpy as np
import numpy.typing as npt

from benchdragon.analysis.asked import asked_of
from benchdragon.errors import InputError, brief, positive
from benchdragon.i18n import N_, _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.arrays import as_numbers
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan

Scheme = Literal["forward", "central", "backward"]
SCHEMES: tuple[Scheme, ...] = ("forward", "central", "backward")
# Their names.
SCHEME_NAMES = {"forward": N_("forward"), "central": N_("central"), "backward": N_("backward")}
# Offsets of the two places, in steps.
ENDS = {"forward": (0.0, 1.0), "central": (-1.0, 1.0), "backward": (-1.0, 0.0)}


def difference_velocities(
    walk: Walk | Plan, times: npt.ArrayLike, step: float, scheme: Scheme = "central"
) -> FloatArray:
    """Velocities of every handle by differences of its positions, m/s, (T, N + 1, 2).

    They are off by an error of order 1 in the step, central ones of order 2; `motion.speed` has none.

    Args:
        walk: what moves, or a plan of it.
        times: s, (T,).
        step: between positions, s; central differences span two of it.
        scheme: "forward", "central" or "backward".

    Raises:
        InputError: for what is neither a walk nor a plan, a step that is not positive, another scheme.
        WalkError: if the dragon cannot stand at a time that is needed.

    Examples:
        >>> plan = bd.read_plan("spiral-in")
        >>> velocity = bd.difference_velocities(plan, [100.0], 0.1, "forward")
        >>> error = np.linalg.norm(velocity, axis=-1) - plan.motion(100.0).speed
        >>> f"{abs(error).max():.0e} m/s"
        '7e-06 m/s'
    """
    walk, _start, _end = asked_of(walk, 0.0, 0.0)
    if not isinstance(scheme, str) or scheme not in SCHEMES:
        text = _("expected one of {known}, not {name}")
        raise InputError(text.format(known=", ".join(SCHEMES), name=brief(scheme)))
    clock = as_numbers("times", times)
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
