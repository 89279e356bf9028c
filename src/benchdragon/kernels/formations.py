"""Formations as parts of a route about the origin, from their sizes: see model/formations.py."""

import math
from enum import IntEnum

import numpy as np

from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.curve import COLUMNS, CurveKind, FloatArray
from benchdragon.kernels.entries import allocates, entry, kernel
from benchdragon.kernels.route_parts import RoutePart, move_parts, part_end, put_part

# Parts of the longest formation: three plum blossoms, walked round 20 times, have 121.
MOST_PARTS = 128


class FormationKind(IntEnum):
    """Which formation."""

    COIL_IN = 0
    COIL_OUT = 1
    FIGURE_EIGHT = 2
    THREE_PLUM_BLOSSOMS = 3
    DOUBLE_DOOR = 4
    STRAIGHT_DRAGON = 5
    TAIL_SWING = 6


@kernel
def add(parts: FloatArray, n: int, kind: float, size: float, first: float) -> int:
    """Let part n be a line of a length, or an arc of a radius, m, and a sweep, rad; n + 1."""
    parts[n] = 0.0
    parts[n, RoutePart.KIND], parts[n, RoutePart.SIZE], parts[n, RoutePart.FIRST] = kind, size, first
    return n + 1


@kernel
def add_coil(parts: FloatArray, n: int, pitch: float, start: float, end: float, clockwise: bool) -> int:
    """Let part n be a coil between two radii, m, whose outer end lies on the axis of x; n + 1."""
    mirrored = (end < start) != clockwise
    winding = max(start, end) * 2.0 * math.pi / pitch
    k = pitch / (2.0 * math.pi)
    add(parts, n, CurveKind.SPIRAL, pitch, start / k)
    parts[n, RoutePart.LAST] = end / k
    parts[n, RoutePart.ANGLE] = winding if mirrored else -winding
    parts[n, RoutePart.HAND] = -1.0 if mirrored else 1.0
    return n + 1


@entry
@allocates
def formation_parts(kind: FormationKind, sizes: Vector, clockwise: bool, parts: Table) -> int:
    """Fill `parts`, MOST_PARTS rows, with those of a formation; how many.

    Its sizes, m, are in the order in which the formation names them.
    """
    row, n = np.empty((1, COLUMNS)), 0
    side = -1.0 if clockwise else 1.0
    if kind == FormationKind.COIL_IN or kind == FormationKind.COIL_OUT:
        return add_coil(parts, 0, sizes[0], sizes[1], sizes[2], clockwise)
    if kind == FormationKind.STRAIGHT_DRAGON:
        n = add(parts, 0, CurveKind.LINE, sizes[0], 0.0)
        parts[0, RoutePart.X] = -0.5 * sizes[0]
    elif kind == FormationKind.DOUBLE_DOOR:
        n = double_door(parts, sizes, clockwise, row)
    elif kind == FormationKind.FIGURE_EIGHT:
        n = figure_eight(parts, side, sizes[0], int(sizes[1]))
    elif kind == FormationKind.THREE_PLUM_BLOSSOMS:
        n = three_plum_blossoms(parts, side, sizes[0], sizes[1], int(sizes[2]))
    else:
        n = tail_swing(parts, side, sizes[0], sizes[1], int(sizes[2]), sizes[3])
    pose = part_end(parts, 0, row)
    for i in range(1, n):
        pose = put_part(parts, i, pose, row)
    return n


@kernel
def double_door(parts: FloatArray, sizes: FloatArray, clockwise: bool, row: FloatArray) -> int:
    """Out of one coil, straight across, into its mirror image; centres on the axis of x."""
    pitch, outer, inner, between = sizes[0], sizes[1], sizes[2], sizes[3]
    add_coil(parts, 0, pitch, inner, outer, clockwise)
    # Turned about its centre so that it leaves along the axis of x, then moved to the left.
    move_parts(parts[:1], -part_end(parts, 0, row).heading, -(outer + 0.5 * between), 0.0)
    add(parts, 1, CurveKind.LINE, -2.0 * part_end(parts, 0, row).x, 0.0)
    return add_coil(parts, 2, pitch, outer, inner, clockwise)


@kernel
def figure_eight(parts: FloatArray, side: float, r: float, rounds: int) -> int:
    """Two loops joined by straight lines that cross at right angles at the origin."""
    half, whole = 0.75 * math.pi * side, -1.5 * math.pi * side
    n = add(parts, 0, CurveKind.ARC, r, half)
    parts[0, RoutePart.X], parts[0, RoutePart.ANGLE] = (1.0 + math.sqrt(2.0)) * r, 0.5 * math.pi * side
    for loop in range(2 * rounds):
        n = add(parts, n, CurveKind.LINE, 2.0 * r, 0.0)
        n = add(parts, n, CurveKind.ARC, r, -whole if loop % 2 else whole)
    parts[n - 1, RoutePart.FIRST] = half
    return n


@kernel
def three_plum_blossoms(parts: FloatArray, side: float, r: float, waist: float, rounds: int) -> int:
    """The outline of three round petals, with bends the other way between them."""
    third = 120.0 * (math.pi / 180.0) * side
    n = add(parts, 0, CurveKind.ARC, r, third)
    parts[0, RoutePart.X], parts[0, RoutePart.ANGLE] = 2.0 * r + waist, 0.5 * math.pi * side
    for _petal in range(3 * rounds):
        n = add(parts, n, CurveKind.ARC, waist, -third)
        n = add(parts, n, CurveKind.ARC, r, 2.0 * third)
    parts[n - 1, RoutePart.FIRST] = third
    return n


@kernel
def tail_swing(parts: FloatArray, side: float, swing: float, r: float, swings: int, run: float) -> int:
    """A line, alternating bends, and a line, along the x axis; the middle is the origin."""
    angle, n = math.acos(1.0 - 0.5 * swing / r), 0
    if run > 0.0:
        n = add(parts, n, CurveKind.LINE, run, 0.0)
    for bend in range(swings + 1):
        half = 1.0 if bend in (0, swings) else 2.0
        n = add(parts, n, CurveKind.ARC, r, half * angle * (-side if bend % 2 else side))
    if run > 0.0:
        n = add(parts, n, CurveKind.LINE, run, 0.0)
    parts[0, RoutePart.X] = -swings * r * math.sin(angle) - run
    parts[0, RoutePart.Y] = -0.5 * side * swing
    return n
