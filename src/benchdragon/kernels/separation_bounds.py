"""Bounds of the separation of two moving benches over a step of the head, along separating axes.

Row i of `boxes` is bench i at the start of the step, row end + i the same bench at its end, and row i
of `sweeps` bounds its motion in between (kernels/motion_bounds.py); h is the length of the step, m.
"""

import math

from benchdragon.kernels.box import Box, box_distance, corner, half_diagonal, nearest_corner, offset
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import kernel
from benchdragon.kernels.motion_bounds import BenchBound


@kernel
def separation(boxes: FloatArray, i: int, j: int, nx: float, ny: float) -> float:
    """How far box j lies beyond box i along the unit vector (nx, ny), m; a lower bound of distance."""
    total = (boxes[j, Box.CX] - boxes[i, Box.CX]) * nx + (boxes[j, Box.CY] - boxes[i, Box.CY]) * ny
    for k in (i, j):
        ux, uy = boxes[k, Box.UX], boxes[k, Box.UY]
        total -= boxes[k, Box.HALF_LENGTH] * abs(ux * nx + uy * ny)
        total -= boxes[k, Box.HALF_WIDTH] * abs(ux * ny - uy * nx)
    return total


@kernel
def chord_loss(boxes: FloatArray, sweeps: FloatArray, i: int, j: int, h: float) -> float:
    """Bound of how far a corner's height over a face strays from the straight line, m: bench i over j.

    The height of a corner P over a face with normal N and foot Y is (P - Y) . N, with second derivative
    at most pull + 2 pace turn + |P - Y| (twist + turn^2).
    """
    along, across = offset(boxes, j, boxes[i, Box.CX], boxes[i, Box.CY])
    ahead = max(abs(along) - boxes[j, Box.HALF_LENGTH], 0.0)
    aside = max(abs(across) - boxes[j, Box.HALF_WIDTH], 0.0)
    pace = sweeps[i, BenchBound.POINT_SPEED] + sweeps[j, BenchBound.POINT_SPEED]
    far = math.hypot(ahead, aside) + half_diagonal(boxes, i)
    turn = sweeps[j, BenchBound.TURN]
    second = sweeps[i, BenchBound.POINT_ACCELERATION] + sweeps[j, BenchBound.POINT_ACCELERATION]
    second += 2.0 * pace * turn
    second += (far + pace * h) * (sweeps[j, BenchBound.ANGULAR_ACCELERATION] + turn * turn)
    return 0.125 * second * h * h


@kernel
def face_bound(boxes: FloatArray, sweeps: FloatArray, end: int, i: int, j: int, h: float) -> float:
    """Least separation that a face of bench j keeps from bench i over a step, m."""
    ib, jb = end + i, end + j
    ax, ay, bx, by = boxes[j, Box.UX], boxes[j, Box.UY], boxes[jb, Box.UX], boxes[jb, Box.UY]
    front = min(separation(boxes, j, i, ax, ay), separation(boxes, jb, ib, bx, by))
    rear = min(separation(boxes, j, i, -ax, -ay), separation(boxes, jb, ib, -bx, -by))
    left = min(separation(boxes, j, i, -ay, ax), separation(boxes, jb, ib, -by, bx))
    right = min(separation(boxes, j, i, ay, -ax), separation(boxes, jb, ib, by, -bx))
    return max(front, rear, left, right) - chord_loss(boxes, sweeps, i, j, h)


@kernel
def face_upper_bound(
    boxes: FloatArray, sweeps: FloatArray, end: int, i: int, j: int, h: float
) -> float:
    """Greatest separation that any face of bench j reaches from bench i over a step, m.

    A face is no farther off than any one corner is over it.
    """
    most = -math.inf
    for face in range(4):
        nearest = math.inf
        for k in range(4):
            height = -math.inf
            for row, base in ((i, j), (end + i, end + j)):
                x, y = corner(boxes, row, k)
                along, across = offset(boxes, base, x, y)
                out = along if face < 2 else across
                half = boxes[base, Box.HALF_LENGTH] if face < 2 else boxes[base, Box.HALF_WIDTH]
                height = max(height, (out if face % 2 == 0 else -out) - half)
            nearest = min(nearest, height)
        most = max(most, nearest)
    return most + chord_loss(boxes, sweeps, i, j, h)


@kernel
def gap_upper_bound(boxes: FloatArray, sweeps: FloatArray, end: int, i: int, j: int, h: float) -> float:
    """At least the signed gap of benches i and j anywhere in a step, m: negative if they overlap."""
    one = face_upper_bound(boxes, sweeps, end, i, j, h)
    return max(one, face_upper_bound(boxes, sweeps, end, j, i, h))


@kernel
def nearest_direction_bound(
    boxes: FloatArray, sweeps: FloatArray, end: int, i: int, j: int, h: float
) -> float:
    """Least separation of benches i and j along the direction in which they are nearest at first, m."""
    mine, which = nearest_corner(boxes, i, j)
    owner, other = (i, j) if mine else (j, i)
    x, y = corner(boxes, owner, which)
    along, across = offset(boxes, other, x, y)
    half, wide = boxes[other, Box.HALF_LENGTH], boxes[other, Box.HALF_WIDTH]
    ahead, aside = along - min(max(along, -half), half), across - min(max(across, -wide), wide)
    apart = math.hypot(ahead, aside)
    if apart == 0.0:
        return -math.inf
    ux, uy = boxes[other, Box.UX], boxes[other, Box.UY]
    nx, ny = (ahead * ux - aside * uy) / apart, (ahead * uy + aside * ux) / apart
    if mine:  # from i towards j
        nx, ny = -nx, -ny
    loss = (
        0.125
        * (sweeps[i, BenchBound.POINT_ACCELERATION] + sweeps[j, BenchBound.POINT_ACCELERATION])
        * h
        * h
    )
    return min(separation(boxes, i, j, nx, ny), separation(boxes, end + i, end + j, nx, ny)) - loss


@kernel
def separation_lower_bound(
    boxes: FloatArray, sweeps: FloatArray, end: int, i: int, j: int, h: float, wanted: float
) -> float:
    """At most the distance of benches i and j anywhere in a step, m; only as good as `wanted` needs.

    Path lengths add, so that half the distances at both ends less half the travel is one bound; the
    others follow faces and directions to second order.
    """
    before, after = box_distance(boxes, i, j), box_distance(boxes, end + i, end + j)
    best = 0.5 * (before + after - sweeps[i, BenchBound.TRAVEL] - sweeps[j, BenchBound.TRAVEL])
    smooth = math.isfinite(
        sweeps[i, BenchBound.POINT_ACCELERATION] + sweeps[j, BenchBound.POINT_ACCELERATION]
    )
    if best > wanted or not smooth:
        return best
    best = max(best, face_bound(boxes, sweeps, end, i, j, h))
    if best <= wanted:
        best = max(best, face_bound(boxes, sweeps, end, j, i, h))
    if best <= wanted:
        best = max(best, nearest_direction_bound(boxes, sweeps, end, i, j, h))
    return best
