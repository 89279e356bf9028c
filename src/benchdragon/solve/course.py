"""A proposed dance in the few figures that people ask for first."""

import itertools
import math
from dataclasses import dataclass

from benchdragon.analysis.not_looked_at import places
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
    begun, ended = places(walk, start, end)
    x, y = plan.route.at or (0.0, 0.0)
    points = [walk.route.point(s).tolist() for s in begun]
    angles = [math.atan2(v - y, u - x) for u, v in points]
    turns = [
        math.remainder(after - before, 2.0 * math.pi) for before, after in itertools.pairwise(angles)
    ]
    out = plan.route.kind == "turn"
    rounds = abs(sum(turns)) / (2.0 * math.pi)
    inside = out and not plan.route.after_street and start >= 0.0
    return Course(rounds, ended[0] - begun[0], end - start, out, inside)
