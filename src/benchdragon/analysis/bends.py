"""Where a route bends left and right, and by how much it has turned."""

from dataclasses import dataclass
from typing import Literal, Self

import numpy as np

from benchdragon.kernels.curve import FloatArray
from benchdragon.model.curves import Route

Turning = Literal["left", "right", "straight"]

# Curvatures below this, 1/m, are straight: what rounding leaves of a line.
STRAIGHT = 1e-6


@dataclass(frozen=True)
class Bends:
    """A route cut where it changes the side to which it bends.

    Attributes:
        at: route positions at which it does, m, increasing, (n,).
        turnings: to which side it bends before, between and behind these, n + 1 of them.
        joints: where its parts start, m.
        starts: its heading there, rad, that of the part.
        turned: by how much it has turned by then, rad, left positive, kinks included.
    """

    route: Route
    at: FloatArray
    turnings: tuple[Turning, ...]
    joints: FloatArray
    starts: FloatArray
    turned: FloatArray

    @classmethod
    def of(cls, route: Route) -> Self:
        """The bends of a route."""
        joints = route.joints[:-1]
        at, turnings, ends = list[float](), list[Turning](), list[tuple[float, float]]()
        for start, curve in zip(joints.tolist(), route, strict=True):
            length = curve.length
            bent, faced = curve.curvature([0.0, length]), curve.heading([0.0, length])
            ends.append((float(faced[0]), float(faced[1])))
            for way, turning in _sides(float(bent[0]), float(bent[1]), length):
                if not turnings or turning != turnings[-1]:
                    at += [start + way] if turnings else []
                    turnings.append(turning)
        faced = np.array(ends)
        kinks = faced[1:, 0] - faced[:-1, 1]
        kinks -= 2.0 * np.pi * np.round(kinks / (2.0 * np.pi))
        turned = np.concatenate([[0.0], np.cumsum(faced[:-1, 1] - faced[:-1, 0] + kinks)])
        return cls(route, np.array(at), tuple(turnings), joints, route.heading(joints), turned)

    def angle(self, s: FloatArray) -> FloatArray:
        """By how much the route has turned from its start to positions s, m: rad, left positive."""
        part = np.maximum(np.searchsorted(self.joints, s, side="right") - 1, 0)
        return self.turned[part] + self.route.heading(s) - self.starts[part]


def _sides(first: float, last: float, length: float) -> list[tuple[float, Turning]]:
    """To which side a part bends, of these curvatures at its ends, and from where on, m.

    The curvature of no part changes its sign but a clothoid's, which is linear.
    """
    if first * last < 0.0 and min(abs(first), abs(last)) > STRAIGHT:
        return [(0.0, _side(first)), (length * first / (first - last), _side(last))]
    return [(0.0, _side(first if abs(first) > abs(last) else last))]


def _side(curvature: float) -> Turning:
    if abs(curvature) <= STRAIGHT:
        return "straight"
    return "left" if curvature > 0.0 else "right"
