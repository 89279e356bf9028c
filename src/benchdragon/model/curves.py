"""Line, Arc, Spiral, Clothoid, LogSpiral, and the Route that joins them: frozen records of geometry.

Every curve is walked from its start to its end, s being the arc length from the start. Metres and
radians; x right, y up, counter-clockwise positive, so that a left turn has positive curvature.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, Self

import numpy as np
import numpy.typing as npt

from benchdragon.errors import InputError, finite, not_negative, positive
from benchdragon.i18n import N_, _
from benchdragon.kernels import curve as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import evaluate
from benchdragon.model.arrays import as_numbers

Point = tuple[float, float]

# Ends that lie nearer than this, m and rad, count as joined: far above rounding, far below a hand.
JOINT_GAP = 1e-9
JOINT_KINK = 1e-9
# A clothoid or a logarithmic spiral may turn by this, rad, in all; more would fill the memory with rows
# of the one, and with the other take too long to search.
MOST_TURN = 1e4
# The curvatures at both ends of a logarithmic spiral differ by at most this factor: near its pole,
# rounding of lengths would blur its curvature.
MOST_WINDING = 1e4
# Sizes and coordinates, m: beyond it doubles no longer hold a micrometre.
MOST_METRES = 1e8
# Pitches and radii, m: their inverses spoil sums where they are smaller.
LEAST_METRES = 1e-6


class Curve:
    """What every curve and every route can tell: where it runs, at any arc length.

    Attributes:
        called: what kind of curve it is, in words.
    """

    called: ClassVar[str]

    @cached_property
    def rows(self) -> FloatArray:
        """The curve as the kernels see it, (pieces, COLUMNS); read-only."""
        rows = self._lower()
        rows[:, kernel.AXIS_X] = np.cos(rows[:, kernel.ANGLE])
        rows[:, kernel.AXIS_Y] = np.sin(rows[:, kernel.ANGLE])
        rows.flags.writeable = False
        return rows

    def _lower(self) -> FloatArray:
        raise NotImplementedError

    @property
    def length(self) -> float:
        """Exact length from start to end, m."""
        return float(self.rows[-1, kernel.S_START] + self.rows[-1, kernel.LENGTH])

    @property
    def extension(self) -> float:
        """How far the curve runs on behind its start, m: 0 or infinite.

        A line runs on straight and an inward spiral runs on outward; a dragon may stand there.
        """
        return 0.0 if math.isfinite(self.rows[0, kernel.U_BACK]) else math.inf

    def point(self, s: npt.ArrayLike) -> FloatArray:
        """Points at arc lengths s (m), of shape s.shape + (2,).

        Raises:
            InputError: if an s lies off the curve and its extension.
        """
        return self._evaluate(s)[..., :2]

    def heading(self, s: npt.ArrayLike) -> FloatArray:
        """Headings of the tangent at arc lengths s, rad, continuous along each curve."""
        return self._evaluate(s)[..., 2]

    def curvature(self, s: npt.ArrayLike) -> FloatArray:
        """Curvatures at arc lengths s, 1/m, left positive; at a joint that of the later curve."""
        return self._evaluate(s)[..., 3]

    def _evaluate(self, s: npt.ArrayLike) -> FloatArray:
        lengths = as_numbers("s", s)
        out = np.empty((lengths.size, 4))
        evaluate(self.rows, lengths.ravel(), out)
        off = np.isnan(out[:, 0])
        if off.any():
            raise InputError(
                _("s must lie between {low} and {high} m, not at {value} m").format(
                    low=f"{0.0 - self.extension:g}",
                    high=f"{self.length:.12g}",
                    value=f"{lengths.ravel()[off][0]:.12g}",
                )
            )
        return out.reshape(*lengths.shape, 4)

    @property
    def start_pose(self) -> tuple[Point, float]:
        """Point and heading of the start."""
        return self._pose(0.0)

    @property
    def end_pose(self) -> tuple[Point, float]:
        """Point and heading of the end."""
        return self._pose(self.length)

    def _pose(self, s: float) -> tuple[Point, float]:
        x, y, heading, _curvature = self._evaluate(s)
        return (float(x), float(y)), float(heading)


def _row(kind: float, length: float, start: Point, angle: float, p: float, q: float) -> FloatArray:
    row = np.zeros(kernel.COLUMNS)
    row[kernel.KIND] = kind
    row[kernel.LENGTH] = row[kernel.U_END] = length
    row[kernel.X], row[kernel.Y] = start
    row[kernel.ANGLE], row[kernel.P], row[kernel.Q] = angle, p, q
    return row


def _check_pose(point: Point, heading: float) -> None:
    if np.shape(point) != (2,):
        raise InputError(_("a start or centre must be a pair (x, y), not {value}").format(value=point))
    for value in point:
        if abs(finite("start", value, "m")) > MOST_METRES:
            raise InputError(_("a start or centre must lie within 1e8 m of the origin"))
    finite("heading", heading, "rad")


def _bend(name: str, value: float) -> float:
    """A pitch or a radius, m."""
    if positive(name, value, "m") < LEAST_METRES:
        raise InputError(
            _("{name} must be at least {least} m, not {value} m").format(
                name=name, least=f"{LEAST_METRES:g}", value=f"{value:g}"
            )
        )
    return _size(name, value)


def _size(name: str, value: float) -> float:
    if positive(name, value, "m") > MOST_METRES:
        raise InputError(
            _("{name} must be at most {most} m, not {value} m").format(
                name=name, most=f"{MOST_METRES:g}", value=f"{value:g}"
            )
        )
    return value


def _turn_bound(length: float, a: float, b: float) -> float:
    """At least the angle, rad, that a curve of `length` metres with curvatures from a to b turns by."""
    return length * max(abs(a), abs(b))


def _check_turn(called: str, length: float, a: float, b: float) -> None:
    turn = _turn_bound(length, a, b)
    if turn > MOST_TURN:
        raise InputError(
            _("{kind} may sweep at most {most} rad, not {value} rad").format(
                kind=_(called), most=f"{MOST_TURN:g}", value=f"{turn:g}"
            )
        )


def _check_bent(curve: "Clothoid | LogSpiral") -> None:
    """Check what curves share that are told by their length and the curvatures at both ends."""
    _size("length", curve.length_m)
    finite("start_curvature", curve.start_curvature, "1/m")
    finite("end_curvature", curve.end_curvature, "1/m")
    _check_pose(curve.start, curve.start_heading)


@dataclass(frozen=True)
class Line(Curve):
    """A straight line; it runs on straight behind its start.

    Args:
        length_m: its length, m.
        start: (x, y) of its start, m.
        start_heading: rad.
    """

    called: ClassVar[str] = N_("a line")

    length_m: float
    start: Point = (0.0, 0.0)
    start_heading: float = 0.0

    def __post_init__(self) -> None:
        _size("length", self.length_m)
        _check_pose(self.start, self.start_heading)

    def _lower(self) -> FloatArray:
        row = _row(kernel.LINE, self.length_m, self.start, self.start_heading, 0.0, 0.0)
        row[kernel.U_BACK] = -math.inf
        return row[np.newaxis]

    def moved(self, point: Point, heading: float) -> Self:
        """The same curve starting at `point` with `heading`."""
        return replace(self, start=point, start_heading=heading)


@dataclass(frozen=True)
class Arc(Curve):
    """A circular arc.

    Args:
        radius: m.
        sweep: angle turned through, rad, left positive; beyond a full turn is allowed.
        start: (x, y) of its start, m.
        start_heading: rad.
    """

    called: ClassVar[str] = N_("an arc")

    radius: float
    sweep: float
    start: Point = (0.0, 0.0)
    start_heading: float = 0.0

    def __post_init__(self) -> None:
        _bend("radius", self.radius)
        if finite("sweep", self.sweep, "rad") == 0.0:
            raise InputError(_("the angle of an arc must not be 0"))
        _size("length", self.radius * abs(self.sweep))
        _check_pose(self.start, self.start_heading)

    @property
    def centre(self) -> Point:
        """(x, y) of the centre, m."""
        side = self.start_heading + math.copysign(0.5 * math.pi, self.sweep)
        x, y = self.start
        return x + self.radius * math.cos(side), y + self.radius * math.sin(side)

    def _lower(self) -> FloatArray:
        bend = math.copysign(1.0 / self.radius, self.sweep)
        length = self.radius * abs(self.sweep)
        return _row(kernel.ARC, length, self.start, self.start_heading, bend, 0.0)[np.newaxis]

    def moved(self, point: Point, heading: float) -> Self:
        """The same curve starting at `point` with `heading`."""
        return replace(self, start=point, start_heading=heading)


@dataclass(frozen=True)
class Spiral(Curve):
    """An Archimedean spiral, r = pitch / 2 pi * theta; walked inward, it runs on outward behind.

    Args:
        pitch: distance between neighbouring turns, m.
        start_angle: theta at the start, rad, at least 0.
        end_angle: theta at the end; smaller walks inward, larger outward.
        centre: (x, y), m.
        rotation: direction of the polar axis theta = 0, rad.
        mirrored: whether the polar angle falls, not grows, with theta. Unmirrored, the walk inward
            is clockwise and the walk outward counter-clockwise.
    """

    called: ClassVar[str] = N_("a spiral")

    pitch: float
    start_angle: float
    end_angle: float
    centre: Point = (0.0, 0.0)
    rotation: float = 0.0
    mirrored: bool = False

    def __post_init__(self) -> None:
        _bend("pitch", self.pitch)
        for name, angle in (("start_angle", self.start_angle), ("end_angle", self.end_angle)):
            if finite(name, angle, "rad") < 0.0:
                raise InputError(
                    _("{name} must not be negative, but is {value}").format(
                        name=name, value=f"{angle:g} rad"
                    )
                )
        if self.start_angle == self.end_angle:
            raise InputError(_("a spiral must end at another angle than it starts at"))
        _size("radius", max(self.start_angle, self.end_angle) * self.k)
        # The arc to the centre is at least this, and hardly more where it matters.
        outer = max(self.start_angle, self.end_angle)
        _size("length", 0.5 * self.k * outer * outer)
        _check_pose(self.centre, self.rotation)

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
        k = _bend("pitch", pitch) / (2.0 * math.pi)
        for name, radius in (("start_radius", start_radius), ("end_radius", end_radius)):
            not_negative(name, radius, "m")
        return cls(pitch, start_radius / k, end_radius / k, centre, rotation, mirrored)

    @property
    def k(self) -> float:
        """Radius gained per radian, m."""
        return self.pitch / (2.0 * math.pi)

    def angle(self, s: npt.ArrayLike) -> FloatArray:
        """theta, rad, at arc lengths s from the start (m), on the spiral or carried on beyond it."""
        lengths = as_numbers("s", s)
        flat = [kernel.parameter_at(self.rows, 0, value) for value in lengths.ravel()]
        return np.array(flat).reshape(lengths.shape)

    def _lower(self) -> FloatArray:
        hand = -1.0 if self.mirrored else 1.0
        row = _row(kernel.SPIRAL, 0.0, self.centre, self.rotation, self.k, hand)
        row[kernel.U_START] = row[kernel.U_BACK] = self.start_angle
        row[kernel.U_END] = self.end_angle
        if self.end_angle < self.start_angle:
            row[kernel.U_BACK] = math.inf
        row[kernel.LENGTH] = kernel.length_at(row[np.newaxis], 0, self.end_angle)
        return row[np.newaxis]

    def moved(self, point: Point, heading: float) -> Self:
        """The same curve starting at `point` with `heading`."""
        (x, y), old_heading = self.start_pose
        turn = heading - old_heading
        c, s = math.cos(turn), math.sin(turn)
        dx, dy = self.centre[0] - x, self.centre[1] - y
        centre = (point[0] + c * dx - s * dy, point[1] + s * dx + c * dy)
        return replace(self, centre=centre, rotation=self.rotation + turn)


@dataclass(frozen=True)
class Clothoid(Curve):
    """A curve whose curvature changes linearly with arc length (Euler spiral).

    Args:
        length_m: its length, m.
        start_curvature: 1/m, left positive.
        end_curvature: 1/m.
        start: (x, y) of its start, m.
        start_heading: rad.
    """

    called: ClassVar[str] = N_("a clothoid")

    length_m: float
    start_curvature: float
    end_curvature: float
    start: Point = (0.0, 0.0)
    start_heading: float = 0.0

    def __post_init__(self) -> None:
        _check_bent(self)
        _check_turn(self.called, self.length_m, self.start_curvature, self.end_curvature)

    def _lower(self) -> FloatArray:
        turn = _turn_bound(self.length_m, self.start_curvature, self.end_curvature)
        count = max(1, math.ceil(turn / kernel.CLOTHOID_TURN))
        piece = self.length_m / count
        change = (self.end_curvature - self.start_curvature) / self.length_m
        point, heading, rows = self.start, self.start_heading, []
        for i in range(count):
            bend = self.start_curvature + change * piece * i
            row = _row(kernel.CLOTHOID, piece, point, heading, bend, change)
            row[kernel.S_START] = piece * i
            rows.append(row)
            point = kernel.clothoid_point(row[np.newaxis], 0, piece)
            heading = kernel.heading(row[np.newaxis], 0, piece)
        return np.array(rows)

    def moved(self, point: Point, heading: float) -> Self:
        """The same curve starting at `point` with `heading`."""
        return replace(self, start=point, start_heading=heading)


@dataclass(frozen=True)
class LogSpiral(Curve):
    """A curve whose radius of curvature changes linearly with arc length (logarithmic spiral).

    Args:
        length_m: its length, m.
        start_curvature: 1/m, left positive, not 0.
        end_curvature: 1/m, of the same sign; nearer to 0 opens the curve, farther from it winds it up.
        start: (x, y) of its start, m.
        start_heading: rad.

    Raises:
        InputError: for curvatures of different signs, or of which one is over MOST_WINDING times the
            other; and if it turns by more than MOST_TURN.
    """

    called: ClassVar[str] = N_("a logarithmic spiral")

    length_m: float
    start_curvature: float
    end_curvature: float
    start: Point = (0.0, 0.0)
    start_heading: float = 0.0

    def __post_init__(self) -> None:
        _check_bent(self)
        a, b = self.start_curvature, self.end_curvature
        if b == 0.0 or not 1.0 / MOST_WINDING <= a / b <= MOST_WINDING:
            raise InputError(
                _(
                    "the curvatures of a logarithmic spiral must have the same sign and differ by a "
                    "factor of at most {most}, not be {start} and {end} 1/m"
                ).format(most=f"{MOST_WINDING:g}", start=f"{a:g}", end=f"{b:g}")
            )
        _check_turn(self.called, self.length_m, a, b)

    def _lower(self) -> FloatArray:
        bend = self.start_curvature
        gain = (bend - self.end_curvature) / self.end_curvature / self.length_m
        row = _row(kernel.LOG_SPIRAL, self.length_m, self.start, self.start_heading, bend, gain)
        return row[np.newaxis]

    def moved(self, point: Point, heading: float) -> Self:
        """The same curve starting at `point` with `heading`."""
        return replace(self, start=point, start_heading=heading)


AnyCurve = Line | Arc | Spiral | Clothoid | LogSpiral


@dataclass(frozen=True)
class Route(Curve):
    """Curves joined end to end in walking order.

    Args:
        curves: at least one; each starts where the one before it ends.
        kinks: whether the heading may jump at a joint.

    Raises:
        InputError: for a gap, or a kink that was not asked for, naming the joint and its size.
    """

    curves: tuple[AnyCurve, ...]
    kinks: bool = False

    def __post_init__(self) -> None:
        if not isinstance(self.curves, Iterable):
            raise InputError(
                _("curves must be a list of curves, not {value}").format(value=repr(self.curves)[:80])
            )
        object.__setattr__(self, "curves", tuple(self.curves))
        for i, curve in enumerate(self.curves, start=1):
            if not isinstance(curve, AnyCurve):
                raise InputError(
                    _(
                        "curve {number} must be a Line, Arc, Spiral, Clothoid or LogSpiral, not {value}"
                    ).format(number=i, value=repr(curve)[:80])
                )
        if not self.curves:
            raise InputError(_("a route needs at least one curve"))
        for i in range(1, len(self.curves)):
            self._check_joint(i)

    def __len__(self) -> int:
        """Number of curves."""
        return len(self.curves)

    def __getitem__(self, i: int) -> AnyCurve:
        """Curve number i, from 0."""
        return self.curves[i]

    def __iter__(self) -> Iterator[AnyCurve]:
        """The curves in walking order."""
        return iter(self.curves)

    @classmethod
    def joined(cls, curves: Sequence[AnyCurve]) -> Self:
        """The route of these curves, each moved to where the one before it ends."""
        placed: list[AnyCurve] = list(curves[:1])
        for curve in curves[1:]:
            placed.append(curve.moved(*placed[-1].end_pose))
        return cls(tuple(placed))

    @cached_property
    def joints(self) -> FloatArray:
        """Route positions of the curves' ends, m, (len(curves) + 1,), from 0 to the length."""
        return np.concatenate([[0.0], np.cumsum([curve.length for curve in self.curves])])

    @property
    def centre(self) -> tuple[float, float]:
        """Centre of the first spiral, else the origin, m."""
        return next((curve.centre for curve in self.curves if isinstance(curve, Spiral)), (0.0, 0.0))

    def _check_joint(self, i: int) -> None:
        (ax, ay), a = self.curves[i - 1].end_pose
        (bx, by), b = self.curves[i].start_pose
        gap = math.hypot(bx - ax, by - ay)
        if gap > JOINT_GAP:
            raise InputError(
                _("curves {first} and {second} do not meet: they are {gap} m apart").format(
                    first=i, second=i + 1, gap=f"{gap:.6g}"
                )
            )
        kink = abs(math.remainder(b - a, 2.0 * math.pi))
        if kink > JOINT_KINK and not self.kinks:
            raise InputError(
                _(
                    "curves {first} and {second} meet at a kink of {kink} degrees; allow kinks "
                    "or rotate one of them"
                ).format(first=i, second=i + 1, kink=f"{math.degrees(kink):.6g}")
            )

    def _lower(self) -> FloatArray:
        tables = []
        for part, curve in enumerate(self.curves):
            rows = curve.rows.copy()
            rows[:, kernel.PART] = part
            rows[:, kernel.S_START] += self.joints[part]
            if part:
                rows[0, kernel.U_BACK] = rows[0, kernel.U_START]
            tables.append(rows)
        return np.concatenate(tables)
