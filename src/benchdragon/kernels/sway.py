"""A dragon whose handles do not keep to the route: each is carried so far aside, links stay rigid."""

import math

from benchdragon.kernels.curve import FloatArray, curvature, place
from benchdragon.kernels.jit import kernel
from benchdragon.kernels.route import locate

# Newton steps for the way along the route by which a handle gives; each doubles the digits, and
# with places a few centimetres aside the third ends below 1e-9 m.
STEPS = 3


@kernel
def table_at(table: FloatArray, step: float, back: float) -> tuple[float, float]:
    """Value and slope, by way, of a table whose entry n holds for `back` = n step; level outside."""
    at = back / step
    n = math.floor(at)
    if n < 0:
        return table[0], 0.0
    if n + 1 >= table.shape[0]:
        return table[-1], 0.0
    rise = table[n + 1] - table[n]
    return table[n] + (at - n) * rise, -rise / step


@kernel
def sway(
    rows: FloatArray,
    links: FloatArray,
    s: FloatArray,
    end: float,
    aside: FloatArray,
    lane: FloatArray,
    lane_step: float,
    x: FloatArray,
    y: FloatArray,
) -> None:
    """Fill x, y, (handles, times), with a dragon whose handles stand aside of route positions s.

    Handle i stands aside[i] to the left of the line, m, and the line itself lies aside of the route
    by the table `lane`, whose entries are lane_step metres apart, from route position `end` backwards.
    The head keeps its place along the route; every other handle gives along it as the one before does,
    and by d metres more, until its bench is as long as it is: near its place the route is
    P + d t + d^2 k n / 2, its normal n - d k t.
    """
    for t in range(s.shape[1]):
        fx, fy, shift = 0.0, 0.0, 0.0
        for i in range(s.shape[0]):
            at = s[i, t] + shift
            j, u, _ = locate(rows, at)
            px, py, tx, ty = place(rows, j, u)
            bend = curvature(rows, j, u)
            off, slope = table_at(lane, lane_step, end - at)
            off += aside[i]
            # Tangential and normal parts of the place: both polynomials of d.
            straight, turned = 1.0 - off * bend, 0.5 * bend
            d = 0.0
            if i > 0:
                dx, dy = px - fx, py - fy
                along, across = dx * tx + dy * ty, dy * tx - dx * ty
                for _ in range(STEPS):
                    a, b = along + d * straight, across + off + d * (slope + d * turned)
                    excess = a * a + b * b - links[i - 1] * links[i - 1]
                    d -= excess / (2.0 * (a * straight + b * (slope + 2.0 * d * turned)))
            shift += d
            a, b = d * straight, off + d * (slope + d * turned)
            fx, fy = px + a * tx - b * ty, py + a * ty + b * tx
            x[i, t], y[i, t] = fx, fy
