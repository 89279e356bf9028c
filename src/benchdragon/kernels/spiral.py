"""Many times at once along one spiral: the hot loop of most dances, written to become SIMD.

Handle angles a (front) and b = a + sigma h (rear) on r = k theta obey, in units of k,

    h^2 + 4 a b sin^2(h / 2) = D^2,     D = link / k,     sigma = +1 inward, -1 outward,

the stable form of the cosine theorem: no difference of large numbers. One Halley step from the
previous handle's h, rescaled, reaches rounding (design/spiral_step.py); a step that was too large
to promise that is repeated. Angles are carried as a sum of two doubles, so that a million links
add up to 1e-11 m and not 1e-7 m.
"""

import math

from benchdragon.kernels.angles import MOST_ANGLE, sincos, small_sincos
from benchdragon.kernels.curve import CurveKind, FloatArray, RouteRow, walks_up
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.numbered import Numbered

# The lanes take only steps for which design/spiral_step.py proves that F' > 0 up to the root, so that
# the root is the first: the front angle at least this, rad, and links no longer than so many radii.
LEAST_ANGLE = 4.0
MOST_LINK_INWARD = 1.4
MOST_LINK_OUTWARD = 0.9
# Under these limits h <= this * D / a, which says how much of the piece a step can use up.
STEP_INWARD = 1.12
STEP_OUTWARD = 1.30
# Near the root F grows like h^2, so a Halley step e leaves an error of e^3 / (4 h^2). A step with
# e^3 > this * h^3 might leave more than h / 4 half-units in the last place, and is repeated.
LARGE_STEP = 1.1e-16
# From any guess under the limits above 8 passes are the most ever seen.
MAX_PASSES = 30

# Lanes march abreast, 32 doubles each in one flat scratch: the fixed distances let the compiler see
# that no lane disturbs another. 32 fill SIMD registers and stay in the nearest cache.
LANES = 64


class Lane(Numbered):
    """Where the lanes' numbers lie in the scratch."""

    REST = 0  # second double of the front angle
    GUESS = 1 * LANES  # of h, to be scaled by link over previous link
    NEXT_REST = 2 * LANES
    NEXT_GUESS = 3 * LANES
    FOUND = 4 * LANES  # h


LANE_NUMBERS = 5 * LANES


@kernel
def takes_link(rows: FloatArray, j: int, least: float, most: float, link: float) -> bool:
    """Whether fronts at angles least..most on row j can take this link by `spiral_links`."""
    if rows[j, RouteRow.KIND] != CurveKind.SPIRAL or least < LEAST_ANGLE or most > MOST_ANGLE:
        return False
    d = link / rows[j, RouteRow.P]
    if walks_up(rows, j) < 0.0:
        return (
            d <= MOST_LINK_INWARD * least and most + STEP_INWARD * d / least <= rows[j, RouteRow.U_BACK]
        )
    return (
        d <= MOST_LINK_OUTWARD * least and least - STEP_OUTWARD * d / least >= rows[j, RouteRow.U_BACK]
    )


@kernel
def angles_after(
    rows: FloatArray, j: int, least: float, most: float, link: float
) -> tuple[float, float]:
    """Bounds of the rear angles for fronts at least..most, all taken by `spiral_links`."""
    d = link / rows[j, RouteRow.P]
    if walks_up(rows, j) < 0.0:
        return least, most + STEP_INWARD * d / least
    return least - STEP_OUTWARD * d / least, most


@kernel
def halley_step(a: float, h: float, sigma: float, d2: float) -> tuple[float, float, float, float]:
    """One Halley step from h: the new h, by how much it fell, and sine and cosine of its half."""
    s, c = small_sincos(0.5 * h)
    b = a + sigma * h
    s2 = s * s
    sin_h = 2.0 * s * c
    f = h * h + 4.0 * a * b * s2 - d2
    f1 = h + 2.0 * sigma * a * s2 + a * b * sin_h  # F' / 2
    f2 = 1.0 + 2.0 * sigma * a * sin_h + a * b * (1.0 - 2.0 * s2)  # F'' / 2
    change = 2.0 * f * f1 / (4.0 * f1 * f1 - f * f2)
    half = 0.5 * change
    return h - change, change, s - half * c, c + half * s


@kernel
def rear_ratio(
    ratio: float, a: float, b: float, shift: float, sigma: float, s: float, c: float
) -> tuple[float, float]:
    """The rear's speed ratio behind a front of `ratio`; and 1 / b, from the same division.

    db/da = -F_a / F_b; times the arc per angle at b over that at a, the ratio of speeds. `shift` is
    sigma h; s and c are sine and cosine of h / 2.
    """
    s2 = s * s
    common = shift + a * b * sigma * (2.0 * s * c)
    arc_a, arc_b = 1.0 + a * a, 1.0 + b * b
    below = (common + 2.0 * a * s2) * arc_a
    shared = 1.0 / (below * b)
    geared = (common - 2.0 * b * s2) * math.sqrt(arc_a * arc_b)
    return ratio * geared * (b * shared), below * shared


@kernel
def halley_pass(
    rows: FloatArray, j: int, link: float, scale: float, i: int, start: int, end: int,
    state: FloatArray, u: FloatArray, x: FloatArray, y: FloatArray, ratio: FloatArray,
) -> int:  # fmt: skip
    """One Halley pass over the lanes of times start..end: handle i + 1 behind handle i on row j.

    Reads u[i], ratio[i] and the lanes' REST and GUESS (of h / scale); writes the rest. Returns how
    many lanes still took a large step.
    """
    k, hand, sigma = rows[j, RouteRow.P], rows[j, RouteRow.Q], -walks_up(rows, j)
    axis_x, axis_y = rows[j, RouteRow.AXIS_X], rows[j, RouteRow.AXIS_Y]
    centre_x, centre_y = rows[j, RouteRow.X], rows[j, RouteRow.Y]
    d2 = (link / k) * (link / k)
    large, i, start = 0, max(i, 0), max(start, 0)
    for lane in range(end - start):
        t = start + lane
        a = u[i, t]
        h, change, s, c = halley_step(a, state[Lane.GUESS + lane] * scale, sigma, d2)
        large += 1 if abs(change * change * change) > LARGE_STEP * h * h * h else 0
        shift = sigma * h + state[Lane.REST + lane]
        b = a + shift
        tail = shift - (b - a)
        ratio[i + 1, t], inverse = rear_ratio(ratio[i, t], a, b, sigma * h, sigma, s, c)
        state[Lane.NEXT_REST + lane], state[Lane.FOUND + lane] = tail, h
        state[Lane.NEXT_GUESS + lane] = h * a * inverse
        sine, cosine = sincos(b)
        cos_b, sin_b = cosine - tail * sine, hand * (sine + tail * cosine)
        u[i + 1, t] = b
        x[i + 1, t] = centre_x + k * b * (axis_x * cos_b - axis_y * sin_b)
        y[i + 1, t] = centre_y + k * b * (axis_y * cos_b + axis_x * sin_b)
    return large


@kernel
def spiral_links(
    rows: FloatArray, j: int, link: float, scale: float, i: int, start: int, end: int,
    state: FloatArray, u: FloatArray, x: FloatArray, y: FloatArray, ratio: FloatArray,
) -> bool:  # fmt: skip
    """Place handle i + 1 at times start..end along spiral row j; False if a lane would not settle."""
    for _ in range(MAX_PASSES):
        if halley_pass(rows, j, link, scale, i, start, end, state, u, x, y, ratio) == 0:
            for lane in range(LANES):
                state[Lane.REST + lane] = state[Lane.NEXT_REST + lane]
                state[Lane.GUESS + lane] = state[Lane.NEXT_GUESS + lane]
            return True
        for lane in range(LANES):
            state[Lane.GUESS + lane] = state[Lane.FOUND + lane]
        scale = 1.0
    return False
