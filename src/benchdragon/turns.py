"""The paper's turn: two arcs, S-shaped, from an inward spiral to its half-turned outward twin.

With psi the angle between radius and tangent where the turn begins (tan psi = theta there), both
arcs sweep 2 psi and r1 + r2 = R / sin psi, so that the length does not depend on r1 : r2.
"""

import math
from dataclasses import dataclass

from benchdragon.curves import Arc, Point, Route, Spiral
from benchdragon.errors import InputError, positive
from benchdragon.messages import _


@dataclass(frozen=True)
class TwoArcTurn:
    """Two tangent arcs between the spirals; the first turns as the inward spiral does.

    Args:
        pitch: of both spirals, m.
        entry_radius: where the turn begins and ends, m.
        ratio: r1 : r2.

    Source: the paper's equations (1) and (2), with alpha = pi / 2 - psi.
    """

    pitch: float
    entry_radius: float = 4.5
    ratio: float = 2.0

    def __post_init__(self) -> None:
        positive("pitch", self.pitch, "m")
        positive("entry_radius", self.entry_radius, "m")
        positive("ratio", self.ratio)
        if self.theta <= 0.5:
            raise InputError(
                _(
                    "the turn must begin farther out than {least} m at this pitch, not at {value} m"
                ).format(least=f"{0.5 * self.pitch / (2.0 * math.pi):.3g}", value=self.entry_radius)
            )

    @property
    def theta(self) -> float:
        """Spiral angle where the turn begins, rad."""
        return 2.0 * math.pi * self.entry_radius / self.pitch

    @property
    def sweep(self) -> float:
        """Angle that each arc turns through, rad: 2 psi."""
        return 2.0 * math.atan(self.theta)

    @property
    def radii(self) -> tuple[float, float]:
        """r1 and r2, m."""
        total = self.entry_radius / math.sin(0.5 * self.sweep)
        return total * self.ratio / (1.0 + self.ratio), total / (1.0 + self.ratio)

    @property
    def length(self) -> float:
        """Length of both arcs, m."""
        return sum(self.radii) * self.sweep

    def arcs(self) -> tuple[Arc, Arc]:
        """The two arcs, in place: clockwise, then counter-clockwise."""
        inward = self._inward(self.entry_radius + self.pitch)
        first = Arc(self.radii[0], -self.sweep).moved(*inward.end_pose)
        return first, Arc(self.radii[1], self.sweep).moved(*first.end_pose)

    def route(self, lead: float = 100.0, trail: float = 1000.0) -> Route:
        """In along the spiral for `lead` metres, the turn, and out for `trail` metres."""
        inward = self._inward(self._radius_after(positive("lead", lead, "m")))
        out_radius = self._radius_after(positive("trail", trail, "m"))
        outward = Spiral.between(self.pitch, self.entry_radius, out_radius, rotation=math.pi)
        return Route((inward, *self.arcs(), outward))

    def _inward(self, start_radius: float) -> Spiral:
        return Spiral.between(self.pitch, start_radius, self.entry_radius)

    def _radius_after(self, length: float) -> float:
        probe = Spiral(self.pitch, self.theta, self.theta + 1.0)
        return float(probe.angle(length)) * probe.k

    def centres(self) -> tuple[Point, Point]:
        """Centres of the two arcs, m."""
        first, second = self.arcs()
        return first.centre, second.centre

    def boundary_angles(self) -> tuple[float, float, float, float]:
        """Polar angles of the arcs' ends about their centres, rad: first arc's start and end, second's.

        With pitch 1.7 m and radius 4.5 m these are the paper's 4.0055, 0.9841, -2.1575 and 0.8639.
        """
        first, second = self.arcs()
        start, end = (
            math.atan2(y - cy, x - cx)
            for (x, y), (cx, cy) in (
                (first.end_pose[0], first.centre),
                (first.end_pose[0], second.centre),
            )
        )
        return start + self.sweep, start, end, end + self.sweep
