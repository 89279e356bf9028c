"""Small dances for proofs."""

import numpy as np

from benchdragon import Arc, Clothoid, Dragon, Line, Route, Walk
from benchdragon.plans.schema import Plan, read_plan

# The contest's dragon, short, coiling in to a disc; its smallest pitch is this, m, to the last digit.
COIL = read_plan("spiral-in", ["disc.radius=4.5", "dragon.benches=30", "route.start_turn=12"])
SMALLEST_PITCH = 0.4503373930272


def coil(pitch: float, **sizes: float) -> Plan:
    """COIL with another pitch, m, and other sizes by the names of their keys, dots as `__`."""
    plan = COIL.with_value("route.pitch", pitch)
    for name, value in sizes.items():
        plan = plan.with_value(name.replace("__", "."), value)
    return plan


def hairpin(radius: float = 1.0, width: float = 0.3) -> Walk:
    """A bend of half a turn between straights, and a dragon of six benches before it."""
    route = Route.joined([Line(14.0), Arc(radius, np.pi), Line(14.0)])
    return Walk(Dragon.of_sizes(np.full(6, 1.4), width, 0.1, 0.1), route, start=9.0)


def eased() -> Walk:
    """The same with clothoids."""
    parts: list[Line | Clothoid | Arc] = [
        Line(14.0),
        Clothoid(2.0, 0.0, 0.8),
        Arc(1.25, 1.5),
        Clothoid(2.0, 0.8, 0.0),
        Line(12.0),
    ]
    return Walk(Dragon.of_sizes(np.full(6, 1.4), 0.3, 0.1, 0.1), Route.joined(parts), start=9.0)
