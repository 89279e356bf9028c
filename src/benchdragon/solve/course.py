"""A proposed dance in the few figures that people ask for first."""

import math
from dataclasses import dataclass

import numpy as np

from benchdragon.plans.schema import Plan

# A shorter dance, s, is reported as too short.
SHORT = 60.0


@dataclass(frozen=True)
class Course:
    """A dance of one spiral or two, in short.

    Attributes:
        rounds: of the coil in which the dragon stands when it begins.
        way: that the head walks, m.
        seconds: that it walks.
        out: whether it comes out again.
        inside: whether it stands coiled inside at first, the head where its turn begins or beyond.
    """

    rounds: float
    way: float
    seconds: float
    out: bool
    inside: bool

    @property
    def short(self) -> bool:
        """Whether it is too short for a dance."""
        return self.seconds < SHORT


def course_of(plan: Plan) -> Course:
    """The course of a dance that coils in, or in and out again.

    Raises:
        WalkError: if the dragon has no place on its route at the start or the end.
    """
    walk = plan.build()
    start, end = plan.span(walk)
    motion = walk.motion([start, end])
    x, y = plan.route.at or (0.0, 0.0)
    angles = np.unwrap(np.arctan2(motion.y[0] - y, motion.x[0] - x))
    rounds = float(abs(angles[-1] - angles[0])) / (2.0 * math.pi)
    way = float(motion.s[1, 0] - motion.s[0, 0])
    out = plan.route.kind == "turn"
    return Course(rounds, way, end - start, out, out and start >= 0.0)
