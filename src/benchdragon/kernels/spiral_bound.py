"""Where on an Archimedean spiral no two benches can touch, whatever the time: a bound in closed form.

On r = b theta a point has the excess sigma = r - b phi, phi counted on from turn to turn: 0 on the
spiral, and one pitch more for the same point seen from one turn farther in. Seen from its own turn, a
bench reaches up to `out` above 0 and down to `dip` below. Where out + dip of any two stays below the
pitch, neighbouring turns cannot touch. All the bounds below fall as the radius grows, so that one
radius decides (design/spiral_bound.py shows how near they come to what benches do).
"""

import math
from typing import NamedTuple

from benchdragon.kernels.arrays import Table
from benchdragon.kernels.curve import CurveKind, FloatArray, RouteRow, length_at
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.links import link_of
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.swept_boxes import SQUARE

# The allowance below the pitch, m: far above the rounding of these few formulas.
SPARE_PITCH = 1e-9
# Radii are sought up to this, m, and so often is their range halved; any that is safe will do.
FARTHEST_RADIUS, RADIUS_HALVINGS = 1e6, 30
# A link's way along a spiral on which it turns by less than SQUARE, in links, at most.
WAY = 1.0 / math.cos(0.5 * SQUARE)


class Shape(NamedTuple):
    """Bounds on benches with room around them, m: links, most before or behind a hole, half a width."""

    shortest: float
    link: float
    ahead: float
    aside: float


@kernel
def shape_of(sizes: FloatArray, group: IntArray, g: int, room: float) -> Shape:
    """The shape of the benches of group g, of sizes (4, kinds), each with `room` metres all round."""
    shape = Shape(math.inf, 0.0, 0.0, 0.0)
    for k in range(sizes.shape[1]):
        if group[k] == g:
            shape = widened(shape, sizes, k, room)
    return shape


@kernel
def widened(shape: Shape, sizes: FloatArray, k: int, room: float) -> Shape:
    """Bounds that hold for a bench of the sizes in column k as well."""
    front, rear = sizes[2, k], sizes[3, k]
    length = link_of(sizes, k)
    return Shape(
        min(shape.shortest, length),
        max(shape.link, length),
        max(shape.ahead, max(front, rear) + room),
        max(shape.aside, 0.5 * sizes[1, k] + room),
    )


@kernel
def corner_reach(shape: Shape) -> float:
    """From a hole to the farther corner, m."""
    return math.hypot(shape.ahead, shape.aside)


@kernel
def polar_angle(shape: Shape, radius: float) -> float:
    """At most the polar angle, rad, between the handles, both at `radius` or farther out."""
    return 2.0 * math.asin(0.5 * shape.link / radius)


@kernel
def follows_outside(shape: Shape, b: float, radius: float) -> bool:
    """Whether its rear handle surely follows the front one without a leap, outside `radius`."""
    if radius <= shape.link:
        return False
    theta = radius / b
    return polar_angle(shape, radius) * (1.0 + 1.0 / (1.0 + theta * theta)) < SQUARE


@kernel
def reaches(shape: Shape, b: float, radius: float) -> tuple[float, float]:
    """How far a shape reaches, m, above excess 0 and below, with both handles outside `radius`.

    Along the line of the handles the excess is convex, with second derivative at most `bend`, and
    0 at both handles. `shift` bounds how far apart the foot of the centre and their middle lie,
    twice, `foot` from below how far that is from the centre.
    """
    half, ahead, angle = 0.5 * shape.link, shape.ahead, polar_angle(shape, radius)
    foot = math.sqrt(radius * radius - half * half)
    shift = b * (2.0 + b * angle / radius) * angle * radius / shape.link
    if foot <= shape.aside or shift > shape.shortest:
        return math.inf, math.inf
    bend = 1.0 / foot + b / (foot * foot)
    far = half + 0.5 * shift
    side = shape.aside * (1.0 + b * (far + ahead) / (foot - shape.aside) ** 2)
    before = math.hypot(half + ahead, foot) - math.hypot(half, foot)
    before += b * (math.atan((half + ahead) / foot) - math.atan(half / foot))
    behind = math.hypot(far + ahead, foot) - math.hypot(far, foot)
    return max(before, behind) + side, 0.5 * half * half * bend + side


@kernel
def keeps_apart(b: float, inner: Shape, outer: Shape, between: float, radius: float) -> bool:
    """Whether benches with handles outside this radius surely keep apart: see `clear_radius`."""
    corner = max(corner_reach(inner), corner_reach(outer))
    if radius <= corner or not (
        follows_outside(inner, b, radius) and follows_outside(outer, b, radius)
    ):
        return False
    beside = math.asin(corner / radius)  # polar angle of a corner off its handle
    angle = max(polar_angle(inner, radius), polar_angle(outer, radius))
    # On one turn the link between is longer than what the two reach towards each other.
    if between / (1.0 + b * (1.0 + 3.0 * angle) / radius) <= 2.0 * radius * beside:
        return False
    # A point of both is seen a whole turn later from the outer one.
    farther = radius + b * (2.0 * math.pi - angle - 2.0 * beside)
    out, _ = reaches(inner, b, radius)
    _, dip = reaches(outer, b, farther)
    return out + dip < 2.0 * math.pi * b - SPARE_PITCH


@kernel
def clear_radius(b: float, inner: Shape, outer: Shape, between: float) -> float:
    """Benches with handles outside this radius, m, of r = b theta keep apart; infinite if nowhere.

    `inner` is the bench that may stand one turn farther in; a link of at least `between` metres lies
    between the two along the dragon.
    """
    low = 0.0
    high = max(corner_reach(inner), corner_reach(outer), inner.link, outer.link)
    while not keeps_apart(b, inner, outer, between, high):
        low, high = high, 2.0 * high
        if high > FARTHEST_RADIUS:
            return math.inf
    for _halving in range(RADIUS_HALVINGS):
        middle = 0.5 * (low + high)
        if keeps_apart(b, inner, outer, between, middle):
            high = middle
        else:
            low = middle
    return high


@kernel
def clear_part(rows: FloatArray, j: int, theta: float, way: float) -> tuple[float, float]:
    """Where, on row j, a front handle has both handles of its bench on the row and outside theta."""
    start, end = rows[j, RouteRow.S_START], rows[j, RouteRow.S_START] + rows[j, RouteRow.LENGTH]
    inmost = min(rows[j, RouteRow.U_START], rows[j, RouteRow.U_END])
    outmost = max(rows[j, RouteRow.U_START], rows[j, RouteRow.U_END])
    endless = math.isinf(rows[j, RouteRow.U_BACK])
    if theta >= outmost and not (endless and math.isfinite(theta)):
        return 0.0, 0.0
    border = start + length_at(rows, j, max(theta, inmost))
    if rows[j, RouteRow.U_END] > rows[j, RouteRow.U_START]:
        return border + way, end
    return (-math.inf if endless else start + way), border


@kernel
def clear_spans(rows: Table, ahead: Shape, behind: Shape, between: float, spans: Table) -> int:
    """Fill spans, (rows, 2), with parts of a route, m, where two benches cannot meet; returns how many.

    One of `ahead` and, with a link of at least `between` metres in between, one of `behind` keep apart
    by the room in their shapes while their front handles are both in the same part. They also follow
    through it without a leap.
    """
    count = 0
    for j in range(rows.shape[0]):
        if rows[j, RouteRow.KIND] != CurveKind.SPIRAL:
            continue
        inward = rows[j, RouteRow.U_END] < rows[j, RouteRow.U_START]
        inner, outer = (ahead, behind) if inward else (behind, ahead)
        theta = clear_radius(rows[j, RouteRow.P], inner, outer, between) / rows[j, RouteRow.P]
        start, end = clear_part(rows, j, theta, WAY * max(ahead.link, behind.link))
        if start < end:
            spans[count, 0], spans[count, 1] = start, end
            count += 1
    return count
