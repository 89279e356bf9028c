"""Where on an Archimedean spiral no two benches can touch, whatever the time: a bound in closed form.

On r = b theta a point has the excess sigma = r - b phi, phi counted on from turn to turn: 0 on the
spiral, and one pitch more for the same point seen from one turn farther in. Seen from its own turn, a
bench reaches up to `out` above 0 and down to `dip` below. Where out + dip of any two stays below the
pitch, neighbouring turns cannot touch. All the bounds below fall as the radius grows, so that one
radius decides (design/spiral_bound.py shows how near they come to what benches do).
"""

import math
from dataclasses import dataclass
from typing import Self

import numpy as np

from benchdragon.kernels import curve as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.regions import SQUARE
from benchdragon.model.curves import Route

# What is left below the pitch, m: far above the rounding of these few formulas.
SPARE = 1e-9
# Radii are sought up to this, m, and so often is their range halved; any that is safe will do.
FARTHEST, HALVINGS = 1e6, 30
# A link's way along a spiral on which it turns by less than SQUARE, in links, at most.
WAY = 1.0 / math.cos(0.5 * SQUARE)


@dataclass(frozen=True)
class Shape:
    """Bounds on benches with room around them, m: links, most before or behind a hole, half a width."""

    shortest: float
    link: float
    ahead: float
    aside: float

    @classmethod
    def of(cls, sizes: FloatArray, room: float) -> Self:
        """That of benches of these sizes, (4, benches), each with `room` metres all round."""
        length, width, front, rear = sizes
        links = length - front - rear
        ahead = float(np.maximum(front, rear).max()) + room
        return cls(float(links.min()), float(links.max()), ahead, 0.5 * float(width.max()) + room)

    @property
    def corner(self) -> float:
        """From a hole to the farther corner, m."""
        return math.hypot(self.ahead, self.aside)

    def angle(self, radius: float) -> float:
        """At most the polar angle, rad, between the handles, both at `radius` or farther out."""
        return 2.0 * math.asin(0.5 * self.link / radius)

    def follows(self, b: float, radius: float) -> bool:
        """Whether its rear handle surely follows the front one without a leap, outside `radius`."""
        if radius <= self.link:
            return False
        theta = radius / b
        return self.angle(radius) * (1.0 + 1.0 / (1.0 + theta * theta)) < SQUARE

    def reaches(self, b: float, radius: float) -> tuple[float, float]:
        """How far it reaches, m, above excess 0 and below, with both handles outside `radius`.

        Along the line of the handles the excess is convex, with second derivative at most `bend`, and
        0 at both handles. `shift` bounds how far apart the foot of the centre and their middle lie,
        twice, `foot` from below how far that is from the centre.
        """
        half = 0.5 * self.link
        foot = math.sqrt(radius * radius - half * half)
        shift = b * (2.0 + b * self.angle(radius) / radius) * self.angle(radius) * radius / self.link
        if foot <= self.aside or shift > self.shortest:
            return math.inf, math.inf
        bend = 1.0 / foot + b / (foot * foot)
        far = half + 0.5 * shift
        side = self.aside * (1.0 + b * (far + self.ahead) / (foot - self.aside) ** 2)
        before = math.hypot(half + self.ahead, foot) - math.hypot(half, foot)
        before += b * (math.atan((half + self.ahead) / foot) - math.atan(half / foot))
        behind = math.hypot(far + self.ahead, foot) - math.hypot(far, foot)
        return max(before, behind) + side, 0.5 * half * half * bend + side


def clear_spans(route: Route, ahead: Shape, behind: Shape, between: float) -> FloatArray:
    """Parts of a route, m, (parts, 2), in one of which two benches cannot come near each other.

    One of `ahead` and, with a link of at least `between` metres in between, one of `behind` keep apart
    by the room in their shapes while their front handles are both in the same part. They also follow
    through it without a leap.
    """
    parts = []
    for j, row in enumerate(route.rows):
        if row[kernel.KIND] == kernel.SPIRAL:
            inward = bool(row[kernel.U_END] < row[kernel.U_START])
            inner, outer = (ahead, behind) if inward else (behind, ahead)
            theta = clear_radius(float(row[kernel.P]), inner, outer, between)
            theta /= float(row[kernel.P])
            parts.append(_part(route.rows, j, theta, WAY * max(ahead.link, behind.link)))
    return np.array([part for part in parts if part[0] < part[1]]).reshape(-1, 2)


def _part(rows: FloatArray, j: int, theta: float, way: float) -> tuple[float, float]:
    """Where, on row j, a front handle has both handles of its bench on the row and outside theta."""
    row = rows[j]
    start, end = float(row[kernel.S_START]), float(row[kernel.S_START] + row[kernel.LENGTH])
    ends, endless = sorted((row[kernel.U_START], row[kernel.U_END])), math.isinf(row[kernel.U_BACK])
    if theta >= ends[1] and not (endless and math.isfinite(theta)):
        return 0.0, 0.0
    border = start + kernel.length_at(rows, j, max(theta, float(ends[0])))
    if row[kernel.U_END] > row[kernel.U_START]:
        return border + way, end
    return (-math.inf if endless else start + way), border


def clear_radius(b: float, inner: Shape, outer: Shape, between: float) -> float:
    """Benches with handles outside this radius, m, of r = b theta keep apart; infinite if nowhere.

    `inner` is the bench that may stand one turn farther in; a link of at least `between` metres lies
    between the two along the dragon.
    """
    corner, link = max(inner.corner, outer.corner), max(inner.link, outer.link)

    def safe(radius: float) -> bool:
        if radius <= corner or not (inner.follows(b, radius) and outer.follows(b, radius)):
            return False
        beside = math.asin(corner / radius)  # polar angle of a corner off its handle
        angle = max(inner.angle(radius), outer.angle(radius))
        # On one turn the link between is longer than what the two reach towards each other.
        if between / (1.0 + b * (1.0 + 3.0 * angle) / radius) <= 2.0 * radius * beside:
            return False
        # A point of both is seen a whole turn later from the outer one.
        farther = radius + b * (2.0 * math.pi - angle - 2.0 * beside)
        out, dip = inner.reaches(b, radius)[0], outer.reaches(b, farther)[1]
        return out + dip < 2.0 * math.pi * b - SPARE

    low, high = 0.0, max(corner, link)
    while not safe(high):
        low, high = high, 2.0 * high
        if high > FARTHEST:
            return math.inf
    for _halving in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if safe(middle) else (middle, high)
    return high
