"""Turns from an inward spiral to its half-turned outward twin: the paper's, and families of others.

The paper's: two arcs, S-shaped. With psi the angle between radius and tangent where the turn begins
(tan psi = theta there), both arcs sweep 2 psi and r1 + r2 = R / sin psi, so that the length does not
depend on r1 : r2. That ends where the joints may move, or where something lies between the arcs.
"""

import cmath
import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from benchdragon.errors import InputError, positive
from benchdragon.i18n import _
from benchdragon.kernels.curve import NODES, WEIGHTS
from benchdragon.model.arrays import as_numbers
from benchdragon.model.base_curve import Point
from benchdragon.model.curves import AnyCurve, Arc, Clothoid, Line, Route, Spiral

# Newton's steps when curvature is eased; and how near the turn's end must come to its place, m and rad.
MOST_STEPS, CLOSED = 40, 1e-12
# A clothoid is integrated in parts that turn by less than this, rad (kernels/curve.py).
PART_TURN = 2.0
# Pieces shorter than this, m, are left out.
NOTHING = 1e-9


@dataclass(frozen=True)
class TwoArcTurn:
    """Two tangent arcs between the spirals; the first turns as the inward spiral does.

    Args:
        pitch: of both spirals, m.
        entry_radius: where the turn begins and ends, m.
        ratio: r1 : r2.

    Source: the paper's equations (1) and (2), with alpha = pi / 2 - psi.
    """

    pitch: float
    entry_radius: float = 4.5
    ratio: float = 2.0

    def __post_init__(self) -> None:
        positive("pitch", self.pitch, "m")
        positive("entry_radius", self.entry_radius, "m")
        positive("ratio", self.ratio)
        if self.theta <= 0.5:
            raise InputError(
                _(
                    "the turn must begin farther out than {least} m at this pitch, not at {value} m"
                ).format(least=f"{0.5 * self.pitch / (2.0 * math.pi):.3g}", value=self.entry_radius)
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

    def arcs(self) -> tuple[Arc, Arc]:
        """The two arcs, in place: clockwise, then counter-clockwise."""
        inward = self._inward(self.entry_radius + self.pitch)
        first = Arc(self.radii[0], -self.sweep).moved(*inward.end_pose)
        return first, Arc(self.radii[1], self.sweep).moved(*first.end_pose)

    def route(self, lead: float = 100.0, trail: float = 1000.0) -> Route:
        """In along the spiral for `lead` metres, the turn, and out for `trail` metres."""
        inward = self._inward(self._radius_after(positive("lead", lead, "m")))
        out_radius = self._radius_after(positive("trail", trail, "m"))
        outward = Spiral.between(self.pitch, self.entry_radius, out_radius, rotation=math.pi)
        return Route((inward, *self.arcs(), outward))

    def _inward(self, start_radius: float) -> Spiral:
        return Spiral.between(self.pitch, start_radius, self.entry_radius)

    def _radius_after(self, length: float) -> float:
        probe = Spiral(self.pitch, self.theta, self.theta + 1.0)
        return float(probe.angle(length)) * probe.k

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
    """

    pitch: float
    entry_radius: float
    exit_radius: float
    pieces: tuple[Piece, ...]

    def __post_init__(self) -> None:
        for name in ("pitch", "entry_radius", "exit_radius"):
            positive(name, getattr(self, name), "m")
        if as_numbers("pieces", self.pieces).shape[1:] != (3,):
            raise InputError(
                _("pieces must be triples (length, curvature, curvature), not {value}").format(
                    value=repr(self.pieces)[:80]
                )
            )

    @property
    def length(self) -> float:
        """Length of the turn itself, m."""
        return sum(piece[0] for piece in self.pieces)

    @property
    def least_radius(self) -> float:
        """The radius of its tightest bend, m."""
        return 1.0 / max(max(abs(a), abs(b)) for _length, a, b in self.pieces)

    def way(self, radius: float) -> float:
        """The whole way inside a disc of this radius, m: the spirals inside it, and the turn."""
        spirals = 0.0
        for joint in (self.entry_radius, self.exit_radius):
            if radius - joint > NOTHING:
                spirals += Spiral.between(self.pitch, radius, joint).length
        return spirals + self.length

    @property
    def extent(self) -> float:
        """How far its curves reach from the centre of the spirals, m, to a thousandth of a metre."""
        route = Route(self.curves)
        s = np.linspace(0.0, route.length, math.ceil(route.length / 0.02) + 2)
        return float(np.hypot(*route.point(s).T).max())

    @cached_property
    def curves(self) -> tuple[AnyCurve, ...]:
        """Its curves, in place."""
        placed: list[AnyCurve] = []
        point, heading = _entry(self.pitch, self.entry_radius)
        for length, a, b in self.pieces:
            curve = _curve(length, a, b).moved(point, heading)
            placed.append(curve)
            point, heading = curve.end_pose
        return tuple(placed)

    def route(self, lead: float = 100.0, trail: float = 1000.0) -> Route:
        """In along the spiral for `lead` metres, the turn, and out for `trail` metres."""
        start = _radius_after(self.pitch, self.entry_radius, positive("lead", lead, "m"))
        end = _radius_after(self.pitch, self.exit_radius, positive("trail", trail, "m"))
        inward = Spiral.between(self.pitch, start, self.entry_radius)
        outward = Spiral.between(self.pitch, self.exit_radius, end, rotation=math.pi)
        return Route((inward, *self.curves, outward))


def _curve(length: float, a: float, b: float) -> AnyCurve:
    if a != b:
        return Clothoid(length, a, b)
    return Arc(1.0 / abs(a), length * a) if a else Line(length)


def _radius_after(pitch: float, radius: float, length: float) -> float:
    """How far out a spiral is when `length` metres lie between that and `radius`."""
    k = pitch / (2.0 * math.pi)
    probe = Spiral(pitch, radius / k, radius / k + 1.0)
    return float(probe.angle(length)) * k


def _entry(pitch: float, radius: float) -> tuple[Point, float]:
    return Spiral.between(pitch, radius + pitch, radius).end_pose


def _exit(pitch: float, radius: float) -> tuple[Point, float]:
    return Spiral.between(pitch, radius, radius + pitch, rotation=math.pi).start_pose


def spiral_curvature(pitch: float, radius: float) -> float:
    """Curvature of the outward spiral at a radius, 1/m; that of the inward one is its opposite."""
    k = pitch / (2.0 * math.pi)
    square = (radius / k) ** 2
    return (2.0 + square) / (k * (1.0 + square) * math.sqrt(1.0 + square))


@dataclass(frozen=True)
class Gap:
    """What a turn has to bridge, in complex numbers: points and unit tangents at both joints."""

    start: complex
    start_way: complex
    end: complex
    end_way: complex

    @classmethod
    def between(cls, pitch: float, entry_radius: float, exit_radius: float) -> "Gap":
        """That between the spirals at these radii.

        Raises:
            InputError: for a pitch or radius that cannot be.
        """
        positive("pitch", pitch, "m")
        least = 0.5 * pitch / (2.0 * math.pi)
        for radius in (entry_radius, exit_radius):
            if positive("entry_radius", radius, "m") <= least:
                raise InputError(
                    _(
                        "the turn must begin and end farther out than {least} m at this pitch, not at "
                        "{value} m"
                    ).format(least=f"{least:.3g}", value=f"{radius:.6g}")
                )
        (start, a), (end, b) = _entry(pitch, entry_radius), _exit(pitch, exit_radius)
        return cls(complex(*start), cmath.rect(1.0, a), complex(*end), cmath.rect(1.0, b))

    def centres(self, first: float, last: float) -> tuple[complex, complex]:
        """Centres of circles of these curvatures (1/m) through the joints."""
        return self.start + 1j * self.start_way / first, self.end + 1j * self.end_way / last


def two_arcs(
    pitch: float, entry_radius: float, exit_radius: float, ratio: float, ease: float = 0.0
) -> Turn:
    """The turn of two arcs with radii r1 : r2 = ratio, the paper's if both joints have one radius.

    With `ease` (m) a clothoid of that length stands before, between and after the arcs.

    Raises:
        InputError: if there is no such turn, with the reason.
    """
    gap = Gap.between(pitch, entry_radius, exit_radius)
    positive("ratio", ratio)
    chord, arms = gap.start - gap.end, -1j * ratio * gap.start_way - 1j * gap.end_way
    # |chord + r arms| = (1 + ratio) r: the circles of radii ratio r and r touch.
    a = abs(arms) ** 2 - (1.0 + ratio) ** 2
    half = (chord * arms.conjugate()).real
    root = math.sqrt(max(half * half - a * abs(chord) ** 2, 0.0))
    radius = abs(chord) ** 2 / (root - half) if root > half else math.inf
    if not math.isfinite(radius):
        raise InputError(_("no two arcs of this ratio join the spirals there"))
    bends = (-1.0 / (ratio * radius), 1.0 / radius)
    lengths = _arc_lengths(gap, bends[0], math.inf, bends[1])
    plain = [lengths[0], lengths[2], radius]

    def pieces(x: Sequence[float]) -> list[Piece]:
        one, two = -1.0 / (ratio * x[2]), 1.0 / x[2]
        return [(x[0], one, one), (x[1], two, two)]

    return _eased(pitch, entry_radius, exit_radius, ease, pieces, plain, gap)


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
    """
    gap = Gap.between(pitch, entry_radius, exit_radius)
    if as_numbers("radii", radii).shape != (2,):
        raise InputError(_("radii must be a pair, not {value}").format(value=repr(radii)[:80]))
    first, last = (-1.0 / positive("radii", radii[0], "m"), 1.0 / positive("radii", radii[1], "m"))
    plain = _arc_lengths(gap, first, bend, last)

    def pieces(x: Sequence[float]) -> list[Piece]:
        return [(x[0], first, first), (x[1], bend, bend), (x[2], last, last)]

    return _eased(pitch, entry_radius, exit_radius, ease, pieces, list(plain), gap)


def _arc_lengths(gap: Gap, first: float, bend: float, last: float) -> tuple[float, float, float]:
    """Lengths of arcs of curvatures first, bend and last, m; bend infinite: nothing in between."""
    one, two = gap.centres(first, last)
    between = two - one
    reach = 1.0 / last - 1.0 / first
    ways: list[tuple[complex, complex]] = []  # tangents where the middle begins and ends
    if math.isinf(bend):
        way = between / (1j * reach)
        ways.append((way / abs(way), way / abs(way)))
    elif abs(bend) < NOTHING:
        if abs(between) < reach:
            raise InputError(
                _(
                    "radii of {a} m and {b} m leave no line between the arcs: smaller ones are needed"
                ).format(a=f"{-1.0 / first:.6g}", b=f"{1.0 / last:.6g}")
            )
        straight = math.sqrt(abs(between) ** 2 - reach * reach)
        way = between / complex(straight, reach)
        ways.append((way, way))
    else:
        ways += _middle_ways(between, 1.0 / bend - 1.0 / first, 1.0 / last - 1.0 / bend)
    found = [_lengths(gap, first, bend, last, *pair) for pair in ways]
    if not found:
        raise InputError(_("no circle of the middle curvature is tangent to both arcs"))
    return min(found, key=sum)


def _middle_ways(between: complex, a: float, b: float) -> list[tuple[complex, complex]]:
    """Unit tangents p, q with 1j (a p + b q) = between: there are two pairs, or none."""
    far = abs(between)
    if not abs(abs(a) - abs(b)) <= far <= abs(a) + abs(b) or not a or not b or not far:
        return []
    along = (far * far + a * a - b * b) / (2.0 * far)
    aside = math.sqrt(max(a * a - along * along, 0.0))
    unit = between / far
    corners = [unit * complex(along, side * aside) for side in (1.0, -1.0)]
    return [(corner / (1j * a), (between - corner) / (1j * b)) for corner in corners]


def _lengths(
    gap: Gap, first: float, bend: float, last: float, p: complex, q: complex
) -> tuple[float, float, float]:
    one = _swept(gap.start_way, p, first)
    three = _swept(q, gap.end_way, last)
    if math.isinf(bend):
        return one, 0.0, three
    if abs(bend) < NOTHING:
        ahead = (gap.centres(first, last)[1] - gap.centres(first, last)[0]) * p.conjugate()
        return one, max(ahead.real, 0.0), three
    return one, _swept(p, q, bend), three


def _swept(start: complex, end: complex, bend: float) -> float:
    """Length of an arc of a curvature from one tangent to another, m."""
    angle = cmath.phase(end / start)
    turn = angle % math.copysign(2.0 * math.pi, bend)
    return 0.0 if abs(turn) > 2.0 * math.pi - 1e-12 else turn / bend


def _eased(
    pitch: float,
    entry_radius: float,
    exit_radius: float,
    ease: float,
    pieces: Callable[[Sequence[float]], list[Piece]],
    x: list[float],
    gap: Gap,
) -> Turn:
    """The turn of `pieces`, eased by clothoids, whose unknowns, at first x, make it end in place."""
    if not 0.0 <= ease < math.inf:
        raise InputError(_("ease must not be negative, but is {value} m").format(value=ease))
    if ease:
        ends = (-spiral_curvature(pitch, entry_radius), spiral_curvature(pitch, exit_radius))
        turned = sum(length * a for length, a, _b in pieces(x))
        inner = pieces

        def pieces(x: Sequence[float]) -> list[Piece]:
            return _with_clothoids(inner(x), ends, ease)

        x = _closed(gap, pieces, [*(length - ease for length in x[:2]), x[2]], turned)
    found = tuple(piece for piece in pieces(x) if abs(piece[0]) > NOTHING)
    if min(piece[0] for piece in found) < 0.0:
        raise InputError(_("clothoids of {ease} m leave no room for the arcs").format(ease=ease))
    return Turn(pitch, entry_radius, exit_radius, found)


def _with_clothoids(pieces: Sequence[Piece], ends: tuple[float, float], ease: float) -> list[Piece]:
    """The pieces with a clothoid of `ease` metres before, between and after them."""
    bends = [ends[0], *(piece[1] for piece in pieces), ends[1]]
    clothoids = [(ease, a, b) for a, b in itertools.pairwise(bends)]
    out: list[Piece] = [clothoids[0]]
    for piece, clothoid in zip(pieces, clothoids[1:], strict=True):
        out += [piece, clothoid]
    return out


def _closed(
    gap: Gap, pieces: Callable[[Sequence[float]], list[Piece]], x: list[float], turned: float
) -> list[float]:
    """The x for which the pieces lead from the start of the gap to its end: Newton's method."""

    def miss(x: Sequence[float]) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
        end, turn = _walked(pieces(x))
        away = gap.start + gap.start_way * end - gap.end
        return np.array([away.real, away.imag, turn - turned])

    for _step in range(MOST_STEPS):
        off = miss(x)
        if float(np.abs(off).max()) < CLOSED:
            return x
        columns = [(miss([*x[:n], x[n] + 1e-7, *x[n + 1 :]]) - off) / 1e-7 for n in range(3)]
        try:
            move = np.linalg.solve(np.column_stack(columns), -off)
        except np.linalg.LinAlgError:
            break
        move *= min(1.0, 1.0 / float(np.abs(move).max()))
        x = [a + b for a, b in zip(x, move.tolist(), strict=True)]
    raise InputError(_("no turn eased like this joins the spirals there"))


def _walked(pieces: Sequence[Piece]) -> tuple[complex, float]:
    """Where pieces end that start at 0 along the x axis, m, and what they turn by, rad."""
    point, heading = 0j, 0.0
    for length, a, b in pieces:
        point += cmath.rect(1.0, heading) * _moved(length, a, b)
        heading += 0.5 * length * (a + b)
    return point, heading


def _moved(length: float, a: float, b: float) -> complex:
    if a == b:
        half = 0.5 * a * length
        sinc = math.sin(half) / half if abs(half) > 1e-8 else 1.0
        return length * sinc * cmath.rect(1.0, half)
    parts = max(1, math.ceil(max(abs(a), abs(b)) * abs(length) / PART_TURN))
    s = length * (np.arange(parts)[:, np.newaxis] + NODES) / parts
    phase = s * (a + 0.5 * (b - a) / length * s)
    return complex((np.exp(1j * phase) * WEIGHTS).sum() * length / parts)
