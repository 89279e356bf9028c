"""Turns from an inward spiral to its half-turned outward twin: the paper's, and families of others.

The paper's: two arcs, S-shaped. With psi the angle between radius and tangent where the turn begins
(tan psi = theta there), both arcs sweep 2 psi and r1 + r2 = R / sin psi, so that the length does not
depend on r1 : r2. This no longer holds where the joints may move, or a piece lies between the arcs.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from benchdragon.errors import InputError, brief, finite, not_negative, positive
from benchdragon.i18n import N_, _
from benchdragon.kernels import turn_families
from benchdragon.kernels.curve import FloatArray, RouteRow, spiral_length
from benchdragon.kernels.route_parts import PART_COLUMNS, farthest
from benchdragon.kernels.status import TurnStatus
from benchdragon.kernels.turn_families import (
    ARCS,
    LEAD,
    LEAST_THETA,
    MOST_TURN_PIECES,
    NEGLIGIBLE,
    REACH_LOOK,
    TRAIL,
    turn_parts,
)
from benchdragon.model.arrays import as_numbers
from benchdragon.model.base_curve import Point, checked_bend, checked_size, laid_rows
from benchdragon.model.curves import AnyCurve, Arc, Route, Spiral, curves_of, joined_curves


@dataclass(frozen=True)
class TwoArcTurn:
    """Two tangent arcs between the spirals; the first turns as the inward spiral does.

    Args:
        pitch: of both spirals, m.
        entry_radius: where the turn begins and ends, m.
        ratio: r1 : r2.

    Source: the paper's equations (1) and (2), with alpha = pi / 2 - psi.

    Examples:
        >>> turn = bd.TwoArcTurn(1.7, 4.5, ratio=2.0)
        >>> [round(radius, 6) for radius in turn.radii], round(turn.length, 6)
        ([3.005418, 1.502709], 13.621245)
    """

    pitch: float
    entry_radius: float = 4.5
    ratio: float = 2.0

    def __post_init__(self) -> None:
        checked_bend("pitch", self.pitch)
        checked_size("entry_radius", self.entry_radius)
        positive("ratio", self.ratio)
        if self.theta <= 0.5:
            text = _("the turn must begin farther out than {least} m at this pitch, not at {value} m")
            raise InputError(
                text.format(least=f"{0.5 * self.pitch / (2.0 * math.pi):.3g}", value=self.entry_radius)
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

    @property
    def turn(self) -> "Turn":
        """The same as any turn, piece by piece."""
        one, two = self.radii
        pieces = (one * self.sweep, -1.0 / one, -1.0 / one), (two * self.sweep, 1.0 / two, 1.0 / two)
        return Turn(self.pitch, self.entry_radius, self.entry_radius, pieces)

    def arcs(self) -> tuple[Arc, Arc]:
        """The two arcs, in place: clockwise, then counter-clockwise."""
        first, second = (arc for arc in self.turn.curves if isinstance(arc, Arc))
        return first, second

    def route(self, lead: float = LEAD, trail: float = TRAIL) -> Route:
        """In along the spiral for `lead` metres, the turn, and out for `trail` metres."""
        return self.turn.route(lead, trail)

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


# A piece of a turn: its length, m, and its curvature at both ends, 1/m, left positive.
Piece = tuple[float, float, float]


@dataclass(frozen=True)
class Turn:
    """A turn made of lines, arcs and clothoids between the spirals.

    Args:
        pitch: of both spirals, m.
        entry_radius: where it leaves the inward spiral, m.
        exit_radius: where it joins the outward spiral, m.
        pieces: in walking order.

    Examples:
        >>> bd.Turn(1.7, 4.5, 4.5, ((1.0, 0.2, 0.2),)).length
        1.0
    """

    pitch: float
    entry_radius: float
    exit_radius: float
    pieces: tuple[Piece, ...]

    def __post_init__(self) -> None:
        checked_bend("pitch", self.pitch)
        for name in ("entry_radius", "exit_radius"):
            checked_size(name, getattr(self, name))
        if np.shape(as_numbers("pieces", self.pieces))[1:] != (3,):
            text = _("pieces must be triples (length, curvature, curvature), not {value}")
            raise InputError(text.format(value=brief(self.pieces)))
        curves_of(self._parts(self.pitch, self.pitch)[1:-1])

    def _parts(self, lead: float, trail: float) -> FloatArray:
        """Parts of the route: the first spiral is `lead` metres long, the last one `trail`."""
        parts = np.empty((len(self.pieces) + 2, PART_COLUMNS))
        pieces = np.array(self.pieces, np.float64)
        turn_parts(self.pitch, self.entry_radius, self.exit_radius, lead, trail, pieces, parts)
        return parts

    def rows(self, lead: float, trail: float) -> FloatArray:
        """The rows of `route` alone, for searches that try many turns."""
        parts = self._parts(lead, trail)
        return laid_rows(parts, moved=(1, len(parts) - 1))

    @property
    def length(self) -> float:
        """Length of the turn itself, m."""
        return sum(piece[0] for piece in self.pieces)

    @property
    def least_radius(self) -> float:
        """The radius of its tightest bend, m."""
        bend = max(max(abs(a), abs(b)) for _length, a, b in self.pieces)
        return 1.0 / bend if bend else math.inf

    def way(self, radius: float) -> float:
        """The whole way inside a disc of this radius, m: the spirals inside it, and the turn."""
        checked_size("radius", radius)
        k, spirals = self.pitch / (2.0 * math.pi), 0.0
        for joint in (self.entry_radius, self.exit_radius):
            if radius - joint > NEGLIGIBLE:
                spirals += spiral_length(k, radius / k) - spiral_length(k, joint / k)
        return spirals + self.length

    @property
    def extent(self) -> float:
        """How far its curves reach from the centre of the spirals, m, to a thousandth of a metre."""
        return reach(self.rows(self.pitch, self.pitch))

    @cached_property
    def curves(self) -> tuple[AnyCurve, ...]:
        """Its curves, in place."""
        return self.route(self.pitch, self.pitch).curves[1:-1]

    def route(self, lead: float = LEAD, trail: float = TRAIL) -> Route:
        """In along the spiral for `lead` metres, the turn, and out for `trail` metres."""
        parts = self._parts(positive("lead", lead, "m"), positive("trail", trail, "m"))
        curves = curves_of(parts)
        return Route(joined_curves(curves, 1, len(curves) - 1))

    def rounds(
        self, count: int, outer: float, bend: float, trail: float = TRAIL, begun: bool = False
    ) -> Route:
        """In and out so many times, each time round the coil to where the inward spiral begins.

        Args:
            count: how many times.
            outer: radius of both spirals at which the head turns back, m.
            bend: radius of the arc by which it does, m.
            trail: length of the last spiral out, m.
            begun: whether the route begins at the outer radius, else LEAD metres before the turn.
        """
        scale = 2.0 * math.pi / self.pitch
        start = checked_size("outer", outer) * scale
        inward = Spiral(self.pitch, start, self.entry_radius * scale)
        outward = Spiral(self.pitch, self.exit_radius * scale, start, (0.0, 0.0), math.pi)
        once = self.route(LEAD, trail).curves
        middle = once[1:-1]
        back = way_back(outward, inward, checked_bend("bend", bend))
        again = [curve for _round in range(count - 1) for curve in (*middle, outward, *back, inward)]
        return Route((inward if begun else once[0], *again, *middle, once[-1]))


def way_back(outward: Spiral, inward: Spiral, bend: float) -> tuple[Arc, Arc]:
    """From the end of a spiral out round the coil to the start of one in: two arcs to the right.

    The first has the radius `bend`, m. The other touches it from outside, and the inward spiral where
    that begins, with less curvature than that has: it lies outside the coil all the way.
    """
    (x, y), heading = outward.end_pose
    (u, v), goal = inward.start_pose
    right_x, right_y = math.sin(goal), -math.cos(goal)
    # From the start of the inward spiral to the centre of the first circle.
    dx, dy = x + bend * math.sin(heading) - u, y - bend * math.cos(heading) - v
    wide = (dx * dx + dy * dy - bend * bend) / (2.0 * (dx * right_x + dy * right_y - bend))
    joint = math.atan2(wide * right_x - dx, dy - wide * right_y)
    there = (
        x + bend * (math.sin(heading) - math.sin(joint)),
        y - bend * (math.cos(heading) - math.cos(joint)),
    )
    return (
        Arc(bend, -((heading - joint) % (2.0 * math.pi)), (x, y), heading),
        Arc(wide, -((joint - goal) % (2.0 * math.pi)), there, joint),
    )


def reach(rows: FloatArray) -> float:
    """How far a turn reaches from the centre, m, by the rows of its route: see `Turn.rows`."""
    return farthest(
        rows, float(rows[1, RouteRow.S_START]), float(rows[-1, RouteRow.S_START]), REACH_LOOK
    )


# Why there is no turn.
REASONS = {
    TurnStatus.TOO_NEAR: N_(
        "the turn must begin and end farther out than {least} m at this pitch, not at {value} m"
    ),
    TurnStatus.NO_ARCS: N_("no two arcs of this ratio join the spirals there"),
    TurnStatus.NO_LINE: N_(
        "radii of {a} m and {b} m leave no line between the arcs: smaller ones are needed"
    ),
    TurnStatus.NO_CIRCLE: N_("no circle of the middle curvature is tangent to both arcs"),
    TurnStatus.NOT_EASED: N_("no turn eased like this joins the spirals there"),
    TurnStatus.NO_ROOM: N_("clothoids of {ease} m leave no room for the arcs"),
}


def two_arcs(
    pitch: float, entry_radius: float, exit_radius: float, ratio: float, ease: float = 0.0
) -> Turn:
    """The turn of two arcs with radii r1 : r2 = ratio, the paper's if both joints have one radius.

    With `ease` (m) a clothoid of that length stands before, between and after the arcs.

    Raises:
        InputError: if there is no such turn, with the reason.

    Examples:
        >>> round(bd.two_arcs(1.7, 4.5, 4.5, 2.0).length, 6)
        13.621245
    """
    joints = _checked_joints(pitch, entry_radius, exit_radius)
    ease = not_negative("ease", ease, "m")
    arcs, pieces = np.empty((ARCS, 2)), np.empty((MOST_TURN_PIECES, 3))
    count, status = turn_families.two_arcs(*joints, positive("ratio", ratio), ease, arcs, pieces)
    return _made(joints, pieces[:count], status, ease)


def three_pieces(
    pitch: float,
    entry_radius: float,
    exit_radius: float,
    radii: tuple[float, float],
    bend: float = 0.0,
    ease: float = 0.0,
) -> Turn:
    """The turn of an arc, a line or a second arc, and a third arc.

    Args:
        pitch: of both spirals, m.
        entry_radius: where it leaves the inward spiral, m.
        exit_radius: where it joins the outward spiral, m.
        radii: of the first arc (to the right) and of the last (to the left), m.
        bend: curvature of what lies between, 1/m, left positive; 0 is a line.
        ease: length of the clothoids before, between and after these, m; 0: none.

    Raises:
        InputError: if there is no such turn, with the reason.

    Examples:
        >>> bd.three_pieces(1.7, 4.5, 4.5, (2.0, 2.0)).length < bd.TwoArcTurn(1.7).length
        True
    """
    joints = _checked_joints(pitch, entry_radius, exit_radius)
    if np.shape(as_numbers("radii", radii)) != (2,):
        raise InputError(_("radii must be a pair, not {value}").format(value=brief(radii)))
    first, last = (positive("radii", radius, "m") for radius in radii)
    bend, ease = finite("bend", bend, "1/m"), not_negative("ease", ease, "m")
    arcs, pieces = np.empty((ARCS, 2)), np.empty((MOST_TURN_PIECES, 3))
    count, status = turn_families.three_pieces(*joints, first, bend, last, ease, arcs, pieces)
    return _made(joints, pieces[:count], status, ease, (first, last))


def _checked_joints(
    pitch: float, entry_radius: float, exit_radius: float
) -> tuple[float, float, float]:
    entry, leave = checked_size("entry_radius", entry_radius), checked_size("exit_radius", exit_radius)
    return checked_bend("pitch", pitch), entry, leave


def _made(
    joints: tuple[float, float, float],
    pieces: FloatArray,
    status: TurnStatus,
    ease: float,
    radii: tuple[float, float] = (math.nan, math.nan),
) -> Turn:
    """The turn that a kernel made, or the reason why it could not."""
    if status != TurnStatus.OK:
        pitch, *ends = joints
        least = LEAST_THETA * pitch / (2.0 * math.pi)
        raise InputError(
            _(REASONS[status]).format(
                least=f"{least:.3g}", value=f"{min(ends):.6g}",
                a=f"{radii[0]:.6g}", b=f"{radii[1]:.6g}", ease=f"{ease:g}",
            )
        )  # fmt: skip
    return Turn(*joints, tuple((length, a, b) for length, a, b in pieces.tolist()))
