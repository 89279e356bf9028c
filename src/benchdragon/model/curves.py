"""Line, Arc, Spiral, Clothoid, LogSpiral, and the Route that joins them: frozen records of geometry.

Every curve is walked from its start to its end, s being the arc length from the start. Metres and
radians; x right, y up, counter-clockwise positive, so that a left turn has positive curvature.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import InitVar, dataclass, field
from functools import cached_property
from typing import ClassVar, Self

import numpy as np
import numpy.typing as npt

from benchdragon.errors import InputError, brief, finite, not_negative
from benchdragon.i18n import N_, _
from benchdragon.kernels import curve as kernel
from benchdragon.kernels.curve import CurveKind, FloatArray, RouteRow
from benchdragon.kernels.route_parts import misfits, move_parts, settle_rows
from benchdragon.model.arrays import as_numbers
from benchdragon.model.base_curve import (
    Curve,
    OneCurve,
    PartNumbers,
    Point,
    check_pose,
    checked_bend,
    checked_size,
    laid_rows,
)

# Ends that lie nearer than this, m and rad, count as joined: far above rounding, far below a hand.
JOINT_GAP = 1e-9
JOINT_KINK = 1e-9
# Arcs that turn more often are taken for a mistake unless they say that they are none.
FEW_TURNS = 4
# The curvatures at both ends of a logarithmic spiral differ by at most this factor: near its pole,
# rounding of lengths would blur its curvature.
MOST_WINDING = 1e4


@dataclass(frozen=True)
class Line(OneCurve):
    """A straight line; it runs on straight behind its start.

    Args:
        length_m: its length, m.
        start: (x, y) of its start, m.
        start_heading: rad.

    Examples:
        >>> bd.Line(5.0).point([0.0, 2.5])
        array([[0. , 0. ],
               [2.5, 0. ]])
    """

    called: ClassVar[str] = N_("a line")
    kind: ClassVar[float] = CurveKind.LINE

    length_m: float
    start: Point = (0.0, 0.0)
    start_heading: float = 0.0

    def __post_init__(self) -> None:
        checked_size("length", self.length_m)
        check_pose(self.start, self.start_heading)

    def _part(self) -> PartNumbers:
        return self.kind, *self.start, self.start_heading, self.length_m, 0.0, 0.0, 0.0

    @classmethod
    def _from(cls, part: PartNumbers) -> Self:
        _kind, x, y, heading, length, *_rest = part
        return cls(length, (x, y), heading)


@dataclass(frozen=True)
class Arc(OneCurve):
    """A circular arc: Arc(9.0, degrees=90), or Arc(9.0, 0.5 * math.pi).

    Args:
        radius: m.
        sweep: angle turned through, rad, left positive.
        start: (x, y) of its start, m.
        start_heading: rad.
        degrees: the sweep, in degrees instead of rad.
        many: whether a sweep in rad of more than FEW_TURNS is meant, and not degrees.

    Raises:
        InputError: for a radius or a sweep that cannot be, and a sweep that was meant in degrees.

    Examples:
        >>> round(bd.Arc(9.0, degrees=90).length, 6), round(bd.Arc(9.0, 0.5 * np.pi).length, 6)
        (14.137167, 14.137167)
        >>> bd.Arc(9.0, 90.0)
        Traceback (most recent call last):
            ...
        benchdragon.errors.InputError: an angle of 90 rad is 14.3 turns: say degrees=90 if the...
    """

    called: ClassVar[str] = N_("an arc")
    kind: ClassVar[float] = CurveKind.ARC

    radius: float
    sweep: float = 0.0
    start: Point = (0.0, 0.0)
    start_heading: float = 0.0
    degrees: InitVar[float | None] = field(default=None, kw_only=True)
    many: InitVar[bool] = field(default=False, kw_only=True)

    def __post_init__(self, degrees: float | None, many: bool) -> None:
        checked_bend("radius", self.radius)
        _check_turns(self.sweep, degrees, many)
        if degrees is not None:
            object.__setattr__(self, "sweep", math.radians(finite("degrees", degrees)))
        if finite("sweep", self.sweep, "rad") == 0.0:
            raise InputError(_("the angle of an arc must not be 0"))
        checked_size("length", self.radius * abs(self.sweep))
        check_pose(self.start, self.start_heading)

    @property
    def centre(self) -> Point:
        """(x, y) of the centre, m."""
        side = self.start_heading + math.copysign(0.5 * math.pi, self.sweep)
        x, y = self.start
        return x + self.radius * math.cos(side), y + self.radius * math.sin(side)

    def _part(self) -> PartNumbers:
        return self.kind, *self.start, self.start_heading, self.radius, self.sweep, 0.0, 0.0

    @classmethod
    def _from(cls, part: PartNumbers) -> Self:
        _kind, x, y, heading, radius, sweep, *_rest = part
        return cls(radius, sweep, (x, y), heading, many=True)


def _check_turns(sweep: float, degrees: float | None, many: bool) -> None:
    """Refuse an arc's sweep, rad, that was meant in degrees, and one said twice."""
    if degrees is not None and sweep != 0.0:
        raise InputError(_("an arc has an angle in rad, or degrees, not both"))
    if not many and abs(finite("sweep", sweep, "rad")) > 2.0 * math.pi * FEW_TURNS:
        text = _(
            "an angle of {angle} rad is {turns} turns: say degrees={angle} if these are degrees, "
            "else many=True"
        )
        raise InputError(text.format(angle=f"{sweep:g}", turns=f"{sweep / (2.0 * math.pi):.1f}"))


@dataclass(frozen=True)
class Spiral(OneCurve):
    """An Archimedean spiral, r = pitch / 2 pi * theta; walked inward, it runs on outward behind.

    Args:
        pitch: distance between neighbouring turns, m.
        start_angle: theta at the start, rad, at least 0.
        end_angle: theta at the end; smaller walks inward, larger outward.
        centre: (x, y), m.
        rotation: direction of the polar axis theta = 0, rad.
        mirrored: whether the polar angle falls, not grows, with theta. Unmirrored, the walk inward
            is clockwise and the walk outward counter-clockwise.

    Examples:
        >>> coil = bd.Spiral.between(0.55, 8.8, 2.0)
        >>> round(coil.length, 3), coil.point(0.0).round(6) + 0.0
        (419.553, array([8.8, 0. ]))
    """

    called: ClassVar[str] = N_("a spiral")
    kind: ClassVar[float] = CurveKind.SPIRAL

    pitch: float
    start_angle: float
    end_angle: float
    centre: Point = (0.0, 0.0)
    rotation: float = 0.0
    mirrored: bool = False

    def __post_init__(self) -> None:
        checked_bend("pitch", self.pitch)
        for name, angle in (("start_angle", self.start_angle), ("end_angle", self.end_angle)):
            if finite(name, angle, "rad") < 0.0:
                text = _("{name} must not be negative, but is {value}")
                raise InputError(text.format(name=name, value=f"{angle:g} rad"))
        if self.start_angle == self.end_angle:
            raise InputError(_("a spiral must end at another angle than it starts at"))
        checked_size("radius", max(self.start_angle, self.end_angle) * self.k)
        # The arc to the centre is at least this, and hardly more where it matters.
        outer = max(self.start_angle, self.end_angle)
        checked_size("length", 0.5 * self.k * outer * outer)
        check_pose(self.centre, self.rotation)

    @classmethod
    def between(
        cls,
        pitch: float,
        start_radius: float,
        end_radius: float,
        centre: Point = (0.0, 0.0),
        rotation: float = 0.0,
        mirrored: bool = False,
    ) -> Self:
        """The spiral from one radius, m, to another."""
        k = checked_bend("pitch", pitch) / (2.0 * math.pi)
        for name, radius in (("start_radius", start_radius), ("end_radius", end_radius)):
            not_negative(name, radius, "m")
        return cls(pitch, start_radius / k, end_radius / k, centre, rotation, mirrored)

    @property
    def inward(self) -> bool:
        """Whether it is walked towards its centre."""
        return self.end_angle < self.start_angle

    @property
    def k(self) -> float:
        """Radius gained per radian, m."""
        return self.pitch / (2.0 * math.pi)

    def angle(self, s: npt.ArrayLike) -> FloatArray:
        """theta, rad, at arc lengths s from the start (m), on the spiral or carried on beyond it."""
        lengths = as_numbers("s", s)
        flat = [kernel.parameter_at(self.rows, 0, value) for value in lengths.ravel()]
        return np.array(flat).reshape(lengths.shape)

    def _part(self) -> PartNumbers:
        angles = self.start_angle, self.end_angle
        hand = -1.0 if self.mirrored else 1.0
        return self.kind, *self.centre, self.rotation, self.pitch, *angles, hand

    @classmethod
    def _from(cls, part: PartNumbers) -> Self:
        _kind, x, y, rotation, pitch, start, end, hand = part
        return cls(pitch, start, end, (x, y), rotation, hand < 0.0)


@dataclass(frozen=True)
class BentCurve(OneCurve):
    """A curve that its length and the curvatures at both ends tell."""

    length_m: float
    start_curvature: float
    end_curvature: float
    start: Point = (0.0, 0.0)
    start_heading: float = 0.0

    def __post_init__(self) -> None:
        checked_size("length", self.length_m)
        finite("start_curvature", self.start_curvature, "1/m")
        finite("end_curvature", self.end_curvature, "1/m")
        check_pose(self.start, self.start_heading)

    def _check_turn(self) -> None:
        turn = self.length_m * max(abs(self.start_curvature), abs(self.end_curvature))  # or less
        if turn > kernel.MOST_TURN:
            text = _("{kind} may sweep at most {most} rad, not {value} rad")
            raise InputError(
                text.format(kind=_(self.called), most=f"{kernel.MOST_TURN:g}", value=f"{turn:g}")
            )

    def _part(self) -> PartNumbers:
        bends = self.start_curvature, self.end_curvature
        return self.kind, *self.start, self.start_heading, self.length_m, *bends, 0.0

    @classmethod
    def _from(cls, part: PartNumbers) -> Self:
        _kind, x, y, heading, length, start, end, _hand = part
        return cls(length, start, end, (x, y), heading)


@dataclass(frozen=True)
class Clothoid(BentCurve):
    """A curve whose curvature changes linearly with arc length (Euler spiral).

    Args:
        length_m: its length, m.
        start_curvature: 1/m, left positive.
        end_curvature: 1/m.
        start: (x, y) of its start, m.
        start_heading: rad.

    Examples:
        >>> bend = bd.Clothoid(10.0, 0.0, 0.2)
        >>> round(float(bend.heading(10.0)), 6)
        1.0
    """

    called: ClassVar[str] = N_("a clothoid")
    kind: ClassVar[float] = CurveKind.CLOTHOID

    def __post_init__(self) -> None:
        super().__post_init__()
        self._check_turn()


@dataclass(frozen=True)
class LogSpiral(BentCurve):
    """A curve whose radius of curvature changes linearly with arc length (logarithmic spiral).

    Args:
        length_m: its length, m.
        start_curvature: 1/m, left positive, not 0.
        end_curvature: 1/m, of the same sign; nearer to 0 opens the curve, farther from it winds it up.
        start: (x, y) of its start, m.
        start_heading: rad.

    Raises:
        InputError: for curvatures of different signs, or of which one is over MOST_WINDING times the
            other; and if it turns by more than kernels.curve.MOST_TURN.

    Examples:
        >>> bd.LogSpiral(5.0, 0.2, 0.1).curvature([0.0, 5.0]).round(6)
        array([0.2, 0.1])
    """

    called: ClassVar[str] = N_("a logarithmic spiral")
    kind: ClassVar[float] = CurveKind.LOG_SPIRAL

    def __post_init__(self) -> None:
        super().__post_init__()
        a, b = self.start_curvature, self.end_curvature
        if b == 0.0 or not 1.0 / MOST_WINDING <= a / b <= MOST_WINDING:
            text = _(
                "the curvatures of a logarithmic spiral must have the same sign and differ by a "
                "factor of at most {most}, not be {start} and {end} 1/m"
            )
            raise InputError(text.format(most=f"{MOST_WINDING:g}", start=f"{a:g}", end=f"{b:g}"))
        self._check_turn()


AnyCurve = Line | Arc | Spiral | Clothoid | LogSpiral
CURVES: dict[float, type[AnyCurve]] = {
    curve.kind: curve for curve in (Line, Arc, Spiral, Clothoid, LogSpiral)
}


def curves_of(parts: FloatArray) -> tuple[AnyCurve, ...]:
    """The curves of rows of `parts`.

    Raises:
        InputError: for sizes that no such curve has.
    """
    return tuple(CURVES[part[0]]._from(part) for part in parts.tolist())


def _checked_curves(curves: object) -> tuple[AnyCurve, ...]:
    if not isinstance(curves, Iterable):
        raise InputError(_("curves must be a list of curves, not {value}").format(value=brief(curves)))
    checked = tuple(curves)
    for i, curve in enumerate(checked, start=1):
        if not isinstance(curve, AnyCurve):
            text = _("curve {number} must be a Line, Arc, Spiral, Clothoid or LogSpiral, not {value}")
            raise InputError(text.format(number=i, value=brief(curve)))
    if not checked:
        raise InputError(_("a route needs at least one curve"))
    return checked


def joined_curves(curves: Sequence[AnyCurve], first: int, stop: int) -> tuple[AnyCurve, ...]:
    """These curves, those from number `first` to before `stop` moved to where the one before ends."""
    parts = np.array([curve._part() for curve in curves], np.float64)
    laid_rows(parts, moved=(first, stop))
    return (*curves[:first], *curves_of(parts[first:stop]), *curves[stop:])


@dataclass(frozen=True)
class Route(Curve):
    """Curves joined end to end in walking order.

    Args:
        curves: at least one; each starts where the one before it ends.
        kinks: whether the heading may jump at a joint.

    Raises:
        InputError: for a gap, or a kink that was not asked for, naming the joint and its size.

    Examples:
        >>> route = bd.Route.joined([bd.Line(20.0), bd.Arc(6.0, degrees=180), bd.Line(20.0)])
        >>> route
        <Route of 3 curves, 58.8496 m>
        >>> route.point(30.0).round(4), float(route.curvature(30.0).round(4))
        (array([25.9724,  6.5743]), 0.1667)
    """

    curves: tuple[AnyCurve, ...]
    kinks: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "curves", _checked_curves(self.curves))
        self._check_joints()

    def __len__(self) -> int:
        """Number of curves."""
        return len(self.curves)

    def __getitem__(self, i: int) -> AnyCurve:
        """Curve number i, from 0."""
        return self.curves[i]

    def __iter__(self) -> Iterator[AnyCurve]:
        """The curves in walking order."""
        return iter(self.curves)

    def __repr__(self) -> str:
        return f"<Route of {len(self)} curves, {self.length:.6g} m>"

    @classmethod
    def joined(cls, curves: Sequence[AnyCurve]) -> Self:
        """The route of these curves, each moved to where the one before it ends."""
        checked = _checked_curves(curves)
        return cls(joined_curves(checked, 1, len(checked)))

    def moved(self, turned: float, by: Point) -> "Route":
        """The same route turned about the origin by an angle, rad, and then moved, m."""
        check_pose(by, turned)
        parts = self.parts
        move_parts(parts, turned, *by)
        return Route(curves_of(parts), self.kinks)

    def seen_from(self, origin: Point) -> "Route":
        """The same route, the numbers that kernels see counted from an origin, m, near the dance.

        Its curves keep their coordinates. Far from the origin, gaps at joints from rounding are closed.
        """
        near = Route(self.curves, self.kinks)
        near.__dict__["rows"] = rows = self.rows.copy()
        settle_rows(rows, *origin)
        rows.flags.writeable = False
        return near

    @property
    def parts(self) -> FloatArray:
        """The curves as a plan says them, one row each: see kernels/route_parts.py."""
        return np.array([curve._part() for curve in self.curves], np.float64)

    @cached_property
    def joints(self) -> FloatArray:
        """Route positions of the curves' ends, m, (len(curves) + 1,), from 0 to the length."""
        rows = self.rows.tolist()
        others = zip(rows[1:], rows, strict=False)
        starts = [
            row[RouteRow.S_START] for row, last in others if row[RouteRow.PART] != last[RouteRow.PART]
        ]
        return np.array([0.0, *starts, self.length])

    @property
    def centre(self) -> tuple[float, float]:
        """Centre of the first spiral, else the origin, m."""
        return next((curve.centre for curve in self.curves if isinstance(curve, Spiral)), (0.0, 0.0))

    def _check_joints(self) -> None:
        off = np.zeros((len(self.curves) - 1, 2))
        misfits(self.rows, off)
        for i, (gap, kink) in enumerate(off.tolist(), start=1):
            if gap > JOINT_GAP:
                text = _(
                    "curves {first} and {second} do not meet: they are {gap} m apart; "
                    "Route.joined moves each to where the one before it ends"
                )
                raise InputError(text.format(first=i, second=i + 1, gap=f"{gap:.6g}"))
            if kink > JOINT_KINK and not self.kinks:
                text = _(
                    "curves {first} and {second} meet at a kink of {kink} degrees; allow kinks "
                    "or rotate one of them, as Route.joined does"
                )
                raise InputError(text.format(first=i, second=i + 1, kink=f"{math.degrees(kink):.6g}"))
