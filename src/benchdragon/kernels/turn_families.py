"""Turns from an inward spiral to its half-turned outward twin, of each family from its few numbers.

Plain turns are found in closed form, in a frame whose x axis is the tangent where the turn begins;
those eased by clothoids by Newton's method from there.
"""

import math
from typing import NamedTuple

from benchdragon.kernels import curve
from benchdragon.kernels.angles import sincos_of
from benchdragon.kernels.arrays import Table
from benchdragon.kernels.curve import CurveKind, FloatArray, clothoid_chord, spiral_angle, spiral_length
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route_parts import PART_COLUMNS, RoutePart
from benchdragon.kernels.status import TurnStatus


class TurnPiece(Numbered):
    """A piece of a turn, one row of a table.

    Its length, m, and its curvature at both ends, 1/m, left positive. Of what is to be eased, the
    arcs: length and curvature.
    """

    LENGTH = 0
    START = 1
    END = 2


MOST_TURN_PIECES = 7  # three, and four clothoids
ARCS = 3
# Two arcs of which only the ratio of the radii is given keep the second radius, m, in this row.
RADIUS_ROW = 2

# A joint must lie at a spiral angle over this, rad.
LEAST_THETA = 0.5
# Newton's steps when curvature is eased, how near the turn's end must come to its place, m and rad, and
# by what its slopes are taken.
MOST_EASING_STEPS = 40
TURN_CLOSED = 1e-12
SLOPE_STEP = 1e-7
# Pieces shorter than this, m, are left out, and curvatures below it, 1/m, are straight.
NEGLIGIBLE = 1e-9
# An arc this near to a full turn, rad, has length 0.
FULL_TURN = 2.0 * math.pi - 1e-12
# Routes of turns go on so far before the turn, and so far behind it beyond the dragon's length, m.
LEAD, TRAIL = 100.0, 1000.0
# The distance of places at which a turn is sampled for its reach, m.
REACH_LOOK = 0.02


class Bridge(NamedTuple):
    """The end of a turn, from (0, 0) along the x axis: a point, m, and the angle turned by, rad."""

    x: float
    y: float
    swing: float


class Easing(NamedTuple):
    """The clothoids' length, m (0: none), and the spirals' curvatures at the turn's ends, 1/m."""

    length: float
    start: float
    end: float


@kernel
def spiral_curvature(pitch: float, radius: float) -> float:
    """Curvature of the outward spiral at a radius, 1/m; that of the inward one is its opposite."""
    k = pitch / (2.0 * math.pi)
    square = (radius / k) ** 2
    return (2.0 + square) / (k * (1.0 + square) * math.sqrt(1.0 + square))


@kernel
def bridge_between(pitch: float, entry_radius: float, exit_radius: float) -> Bridge:
    """The bridge of a turn between the spirals at these radii."""
    k = pitch / (2.0 * math.pi)
    a, b = entry_radius / k, exit_radius / k
    # The outward spiral is the inward one turned by half a turn, walked the other way.
    dx = -exit_radius * math.cos(b) - entry_radius * math.cos(a)
    dy = -exit_radius * math.sin(b) - entry_radius * math.sin(a)
    heading = a + math.atan(a) + math.pi
    c, s = math.cos(heading), math.sin(heading)
    return Bridge(c * dx + s * dy, c * dy - s * dx, b + math.atan(b) + math.pi - heading)


@entry
def two_arcs(
    pitch: float, entry_radius: float, exit_radius: float, ratio: float, ease: float, arcs: Table,
    pieces: Table,
) -> tuple[int, TurnStatus]:  # fmt: skip
    """Fill `pieces` with the turn of two arcs with radii r1 : r2 = ratio; how many, and the status.

    `arcs` is scratch, (ARCS, 2), `pieces` (MOST_PIECES, 3). With `ease` (m) a clothoid of that length
    stands before, between and after the arcs.
    """
    if min(entry_radius, exit_radius) * 2.0 * math.pi <= LEAST_THETA * pitch:
        return 0, TurnStatus.TOO_NEAR
    bridge = bridge_between(pitch, entry_radius, exit_radius)
    c, s = math.cos(bridge.swing), math.sin(bridge.swing)
    # The circles of radii ratio r and r touch: |chord + r arms| = (1 + ratio) r, a quadratic in 1 / r.
    square = bridge.x * bridge.x + bridge.y * bridge.y
    a = -4.0 * ratio * math.sin(0.5 * bridge.swing) ** 2
    half = bridge.y * (ratio + c) - bridge.x * s
    root = math.sqrt(max(half * half - a * square, 0.0))
    if not root > half or not square / (root - half) < math.inf:
        return 0, TurnStatus.NO_ARCS
    arcs[RADIUS_ROW, TurnPiece.LENGTH] = square / (root - half)
    set_bends(arcs, ratio)
    one, two = arcs[0, TurnPiece.START], arcs[1, TurnPiece.START]
    way = math.atan2(bridge.y + c / two - 1.0 / one, bridge.x - s / two) - 0.5 * math.pi
    arcs[0, TurnPiece.LENGTH] = swept(way, one)
    arcs[1, TurnPiece.LENGTH] = swept(bridge.swing - way, two)
    easing = easing_of(pitch, entry_radius, exit_radius, ease)
    return eased(bridge, easing, ratio, arcs, pieces)


@entry
def three_pieces(
    pitch: float, entry_radius: float, exit_radius: float, first_radius: float, bend: float,
    last_radius: float, ease: float, arcs: Table, pieces: Table,
) -> tuple[int, TurnStatus]:  # fmt: skip
    """Fill `pieces` with the turn of an arc to the right, a line or arc, and an arc to the left.

    `bend` is the curvature of what lies between, 1/m, left positive; all else is as in `two_arcs`.
    """
    if min(entry_radius, exit_radius) * 2.0 * math.pi <= LEAST_THETA * pitch:
        return 0, TurnStatus.TOO_NEAR
    bridge = bridge_between(pitch, entry_radius, exit_radius)
    arcs[0, TurnPiece.START] = -1.0 / first_radius
    arcs[1, TurnPiece.START] = bend
    arcs[2, TurnPiece.START] = 1.0 / last_radius
    x = bridge.x - last_radius * math.sin(bridge.swing)
    y = bridge.y + last_radius * math.cos(bridge.swing) + first_radius
    if abs(bend) < NEGLIGIBLE:
        status = line_between(bridge.swing, x, y, arcs)
    else:
        status = circle_between(bridge.swing, x, y, arcs)
    if status != TurnStatus.OK:
        return 0, status
    easing = easing_of(pitch, entry_radius, exit_radius, ease)
    return eased(bridge, easing, 0.0, arcs, pieces)


@kernel
def easing_of(pitch: float, entry_radius: float, exit_radius: float, ease: float) -> Easing:
    """The easing by clothoids of `ease` metres between spirals at these radii."""
    start = -spiral_curvature(pitch, entry_radius)
    return Easing(ease, start, spiral_curvature(pitch, exit_radius))


@kernel
def line_between(swing: float, x: float, y: float, arcs: FloatArray) -> TurnStatus:
    """Fill the lengths of `arcs` where a line leads from one to the other; (x, y): between centres."""
    first, last = arcs[0, TurnPiece.START], arcs[2, TurnPiece.START]
    far, reach = math.hypot(x, y), 1.0 / last - 1.0 / first
    if far < reach:
        return TurnStatus.NO_LINE
    straight = math.sqrt(far * far - reach * reach)
    way = math.atan2(y, x) - math.atan2(reach, straight)
    arcs[0, TurnPiece.LENGTH] = swept(way, first)
    arcs[1, TurnPiece.LENGTH] = straight
    arcs[2, TurnPiece.LENGTH] = swept(swing - way, last)
    return TurnStatus.OK


@kernel
def circle_between(swing: float, x: float, y: float, arcs: FloatArray) -> TurnStatus:
    """As `line_between` with an arc of curvature arcs[1]: the shorter of both ways, if there is one."""
    first, bend, last = arcs[0, TurnPiece.START], arcs[1, TurnPiece.START], arcs[2, TurnPiece.START]
    far, a, b = math.hypot(x, y), 1.0 / bend - 1.0 / first, 1.0 / last - 1.0 / bend
    if not abs(abs(a) - abs(b)) <= far <= abs(a) + abs(b) or a == 0.0 or b == 0.0 or far == 0.0:
        return TurnStatus.NO_CIRCLE
    along = (far * far + a * a - b * b) / (2.0 * far)
    aside = math.sqrt(max(a * a - along * along, 0.0))
    shortest = math.inf
    for side in (1.0, -1.0):
        # From the first centre by a p, then by b q to the last, p and q to the right of the tangents.
        p = math.atan2(y, x) + math.atan2(side * aside, along) - math.copysign(0.5 * math.pi, a)
        q = math.atan2(y, x) - math.atan2(side * aside, far - along) - math.copysign(0.5 * math.pi, b)
        one, two, three = swept(p, first), swept(q - p, bend), swept(swing - q, last)
        if one + two + three < shortest:
            shortest = one + two + three
            arcs[0, TurnPiece.LENGTH] = one
            arcs[1, TurnPiece.LENGTH] = two
            arcs[2, TurnPiece.LENGTH] = three
    return TurnStatus.OK


@kernel
def swept(turn: float, bend: float) -> float:
    """Length, m, of an arc of this curvature that turns by `turn`, rad, up to full turns."""
    full = math.copysign(2.0 * math.pi, bend)
    angle = turn - full * math.floor(turn / full)
    return 0.0 if abs(angle) > FULL_TURN else angle / bend


@kernel
def set_bends(arcs: FloatArray, ratio: float) -> None:
    """Fill the curvatures of two arcs of a ratio from the second radius."""
    arcs[0, TurnPiece.START] = -1.0 / (ratio * arcs[RADIUS_ROW, TurnPiece.LENGTH])
    arcs[1, TurnPiece.START] = 1.0 / arcs[RADIUS_ROW, TurnPiece.LENGTH]


@kernel
def eased(
    bridge: Bridge, easing: Easing, ratio: float, arcs: FloatArray, pieces: FloatArray
) -> tuple[int, TurnStatus]:
    """Fill `pieces` from the arcs (two if there is a ratio), eased if `easing` has a length."""
    if easing.length > 0.0:
        turn = 0.0
        for n in range(2 if ratio > 0.0 else ARCS):
            turn += arcs[n, TurnPiece.LENGTH] * arcs[n, TurnPiece.START]
        arcs[0, TurnPiece.LENGTH] -= easing.length
        arcs[1, TurnPiece.LENGTH] -= easing.length
        if not closed(Bridge(bridge.x, bridge.y, turn), easing, ratio, arcs, pieces):
            return 0, TurnStatus.NOT_EASED
    count = lay_pieces(easing, ratio, arcs, pieces)
    kept = 0
    for n in range(count):
        if pieces[n, TurnPiece.LENGTH] < -NEGLIGIBLE:
            return 0, TurnStatus.NO_ROOM
        if pieces[n, TurnPiece.LENGTH] > NEGLIGIBLE:
            for column in range(3):
                pieces[kept, column] = pieces[n, column]
            kept += 1
    return kept, TurnStatus.OK


@kernel
def lay_pieces(easing: Easing, ratio: float, arcs: FloatArray, pieces: FloatArray) -> int:
    """Fill `pieces` with the arcs, and clothoids before, between and after them; returns how many."""
    if ratio > 0.0:
        set_bends(arcs, ratio)
    count = 0
    before = easing.start
    for n in range(2 if ratio > 0.0 else ARCS):
        bend = arcs[n, TurnPiece.START]
        if easing.length > 0.0:
            set_piece(pieces, count, easing.length, before, bend)
            count += 1
        set_piece(pieces, count, arcs[n, TurnPiece.LENGTH], bend, bend)
        count += 1
        before = bend
    if easing.length > 0.0:
        set_piece(pieces, count, easing.length, before, easing.end)
        count += 1
    return count


@kernel
def set_piece(pieces: FloatArray, n: int, length: float, start: float, end: float) -> None:
    """Let piece n be of this length, m, and these curvatures, 1/m."""
    pieces[n, TurnPiece.LENGTH] = length
    pieces[n, TurnPiece.START] = start
    pieces[n, TurnPiece.END] = end


@kernel
def closed(bridge: Bridge, easing: Easing, ratio: float, arcs: FloatArray, pieces: FloatArray) -> bool:
    """Change the lengths in `arcs` until the eased pieces lead over the bridge: Newton's method."""
    for _ in range(MOST_EASING_STEPS):
        x, y, turn = missed(bridge, easing, ratio, arcs, pieces)
        if max(abs(x), abs(y), abs(turn)) < TURN_CLOSED:
            return True
        ax, ay, a = slopes(bridge, easing, ratio, arcs, pieces, 0, x, y, turn)
        bx, by, b = slopes(bridge, easing, ratio, arcs, pieces, 1, x, y, turn)
        cx, cy, c = slopes(bridge, easing, ratio, arcs, pieces, 2, x, y, turn)
        whole = determinant(ax, ay, a, bx, by, b, cx, cy, c)
        if whole == 0.0 or not abs(whole) < math.inf:
            return False
        one = -determinant(x, y, turn, bx, by, b, cx, cy, c) / whole
        two = -determinant(ax, ay, a, x, y, turn, cx, cy, c) / whole
        three = -determinant(ax, ay, a, bx, by, b, x, y, turn) / whole
        share = 1.0 / max(abs(one), abs(two), abs(three), 1.0)  # a metre at most
        arcs[0, TurnPiece.LENGTH] += share * one
        arcs[1, TurnPiece.LENGTH] += share * two
        arcs[2, TurnPiece.LENGTH] += share * three
    return False


@kernel
def determinant(
    ax: float, ay: float, az: float, bx: float, by: float, bz: float, cx: float, cy: float, cz: float
) -> float:
    """The determinant of three columns."""
    return ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)


@kernel
def slopes(
    bridge: Bridge, easing: Easing, ratio: float, arcs: FloatArray, pieces: FloatArray,
    n: int, x: float, y: float, turn: float,
) -> tuple[float, float, float]:  # fmt: skip
    """The change of what `missed` returns, (x, y, turn) now, with length n of `arcs`, per metre."""
    length = arcs[n, TurnPiece.LENGTH]
    arcs[n, TurnPiece.LENGTH] = length + SLOPE_STEP
    x1, y1, turn1 = missed(bridge, easing, ratio, arcs, pieces)
    arcs[n, TurnPiece.LENGTH] = length
    return (x1 - x) / SLOPE_STEP, (y1 - y) / SLOPE_STEP, (turn1 - turn) / SLOPE_STEP


@kernel
def missed(
    bridge: Bridge, easing: Easing, ratio: float, arcs: FloatArray, pieces: FloatArray
) -> tuple[float, float, float]:
    """The pieces' end less the bridge's, along x and y, m, and in the angle turned by, rad."""
    x, y, heading = 0.0, 0.0, 0.0
    for n in range(lay_pieces(easing, ratio, arcs, pieces)):
        length = pieces[n, TurnPiece.LENGTH]
        start = pieces[n, TurnPiece.START]
        end = pieces[n, TurnPiece.END]
        turn = max(abs(start), abs(end)) * abs(length)
        if not turn < curve.MOST_TURN:
            return math.nan, math.nan, math.nan
        cuts = max(1, math.ceil(turn / curve.CLOTHOID_TURN))
        cut = length / cuts
        for i in range(cuts):
            bend = start + (end - start) * i / cuts
            change = (end - start) / cuts
            dx, dy = clothoid_chord(cut, bend, change / cut if change != 0.0 else 0.0)
            s, c = sincos_of(heading)
            x += c * dx - s * dy
            y += s * dx + c * dy
            heading += cut * (bend + 0.5 * change)
    return x - bridge.x, y - bridge.y, heading - bridge.swing


@entry
def turn_parts(
    pitch: float, entry_radius: float, exit_radius: float, lead: float, trail: float, pieces: Table,
    parts: Table,
) -> None:  # fmt: skip
    """Fill the parts of a route, two more than pieces: a spiral in, the pieces, a spiral out.

    The spirals are `lead` and `trail` metres long. The pieces are not yet in place: `lay_rows` moves
    them, parts 1 to the last but one.
    """
    k = pitch / (2.0 * math.pi)
    last = pieces.shape[0] + 1
    for i in range(last + 1):
        for column in range(PART_COLUMNS):
            parts[i, column] = 0.0
    set_spiral(parts, 0, pitch, 0.0, theta_after(k, entry_radius / k, lead), entry_radius / k)
    set_spiral(parts, last, pitch, math.pi, exit_radius / k, theta_after(k, exit_radius / k, trail))
    for n in range(last - 1):
        length = pieces[n, TurnPiece.LENGTH]
        start = pieces[n, TurnPiece.START]
        end = pieces[n, TurnPiece.END]
        parts[n + 1, RoutePart.KIND] = CurveKind.LINE
        parts[n + 1, RoutePart.SIZE] = length
        if start != end:
            parts[n + 1, RoutePart.KIND] = CurveKind.CLOTHOID
            parts[n + 1, RoutePart.FIRST] = start
            parts[n + 1, RoutePart.LAST] = end
        elif start != 0.0:
            parts[n + 1, RoutePart.KIND] = CurveKind.ARC
            parts[n + 1, RoutePart.SIZE] = 1.0 / abs(start)
            parts[n + 1, RoutePart.FIRST] = length * start


@kernel
def set_spiral(
    parts: FloatArray, i: int, pitch: float, rotation: float, first: float, last: float
) -> None:
    """Let part i be a spiral about the origin between these angles, rad."""
    parts[i, RoutePart.KIND] = CurveKind.SPIRAL
    parts[i, RoutePart.ANGLE] = rotation
    parts[i, RoutePart.SIZE] = pitch
    parts[i, RoutePart.FIRST] = first
    parts[i, RoutePart.LAST] = last
    parts[i, RoutePart.HAND] = 1.0


@kernel
def theta_after(k: float, theta: float, length: float) -> float:
    """The angle, rad, to which a spiral has come `length` metres farther out than theta."""
    return spiral_angle(k, spiral_length(k, theta) + length)
