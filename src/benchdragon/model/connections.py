"""Shortest connections of two poses by arcs of one radius and lines, and programmes joined by them.

The shortest way from one pose to another whose curvature never exceeds 1 / radius is one of six kinds
(L. E. Dubins, 1957): arc, line, arc (LSL, RSR, LSR, RSL) or three arcs (LRL, RLR).
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from benchdragon.errors import InputError, brief, of_kind, positive
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.arrays import as_numbers
from benchdragon.model.base_curve import Point, check_pose
from benchdragon.model.curves import AnyCurve, Arc, Line, Route
from benchdragon.model.formations import Formation

Pose = tuple[Point, float]

# Sweeps, rad, that are so near to a full turn are none: rounding made them. Lines, m, so short neither.
ROUNDING = 1e-13
# What crosses what is seen on polylines of chords about so long, m, and of so many at most.
CHORD, MOST_CHORDS = 0.25, 4000
# Chords of a polyline that one box bounds.
RUN = 32
FULL = 2.0 * math.pi


@dataclass(frozen=True)
class Connection:
    """A way from one pose to another: arcs of one radius and lines.

    Attributes:
        word: its pieces, L an arc to the left, S a line, R an arc to the right.
        curves: the pieces that have a length, in place; none where the poses are the same.
    """

    word: str
    curves: tuple[AnyCurve, ...]

    @property
    def length(self) -> float:
        """Length of the way, m."""
        return sum(curve.length for curve in self.curves)


def connections(start: Pose, end: Pose, radius: float) -> list[Connection]:
    """The ways of Dubins' six kinds from one pose to another, the shortest first.

    The first is the shortest of all ways whose curvature is nowhere over 1 / radius.

    Args:
        start: point, m, and heading, rad.
        end: likewise.
        radius: of the arcs, m.
    """
    for pose in (start, end):
        _check(pose)
    positive("radius", radius, "m")
    found = [
        Connection(word, _curves(start, sweeps, line, radius))
        for word, sweeps, line in (*_with_line(start, end, radius), *_of_arcs(start, end, radius))
    ]
    return sorted(found, key=lambda one: one.length)


def _check(pose: object) -> None:
    """Refuse what is no pose."""
    if not isinstance(pose, tuple) or len(pose) != 2:
        raise InputError(_("a pose must be ((x, y), heading), not {value}").format(value=brief(pose)))
    as_numbers("point", pose[0])
    check_pose(*pose)


# A word, the sweeps of its arcs, rad, left positive, and the length of its line, m, or None.
_Way = tuple[str, tuple[float, ...], float | None]


def _centre(pose: Pose, radius: float, side: float) -> tuple[float, float]:
    (x, y), heading = pose
    return x - side * radius * math.sin(heading), y + side * radius * math.cos(heading)


def _sweep(side: float, start: float, end: float) -> float:
    """From one heading to another turning to one side, rad."""
    sweep = math.fmod(side * (end - start), FULL)
    sweep += FULL if sweep < 0.0 else 0.0
    return 0.0 if sweep > FULL - ROUNDING * (1.0 + abs(start) + abs(end)) else side * sweep


def _letter(side: float) -> str:
    return "L" if side > 0.0 else "R"


def _with_line(start: Pose, end: Pose, radius: float) -> Iterator[_Way]:
    for first in (1.0, -1.0):
        for last in (1.0, -1.0):
            x, y = _centre(start, radius, first)
            to_x, to_y = _centre(end, radius, last)
            apart, toward = math.hypot(to_x - x, to_y - y), math.atan2(to_y - y, to_x - x)
            line2 = apart * apart - (0.0 if first == last else 4.0 * radius * radius)
            if line2 < 0.0:
                continue
            line = math.sqrt(line2)
            aslant = 0.0 if first == last else first * math.atan2(2.0 * radius, line)
            heading = toward + aslant
            if apart < ROUNDING * radius:
                heading = start[1]  # one circle: no line, and no heading of it
            sweeps = _sweep(first, start[1], heading), _sweep(last, heading, end[1])
            yield f"{_letter(first)}S{_letter(last)}", sweeps, line


def _of_arcs(start: Pose, end: Pose, radius: float) -> Iterator[_Way]:
    for side in (1.0, -1.0):
        x, y = _centre(start, radius, side)
        to_x, to_y = _centre(end, radius, side)
        apart, toward = math.hypot(to_x - x, to_y - y), math.atan2(to_y - y, to_x - x)
        height2 = 16.0 * radius * radius - apart * apart
        if height2 < 0.0:
            continue
        for hand in (1.0, -1.0):
            slant = hand * math.atan2(math.sqrt(height2), apart)
            # Headings where the first arc meets the second, and the second the third.
            one = toward + slant + side * 0.5 * math.pi
            two = toward + math.pi - slant + side * 0.5 * math.pi
            yield (
                _letter(side) + _letter(-side) + _letter(side),
                (_sweep(side, start[1], one), _sweep(-side, one, two), _sweep(side, two, end[1])),
                None,
            )


def _curves(
    start: Pose, sweeps: tuple[float, ...], line: float | None, radius: float
) -> tuple[AnyCurve, ...]:
    """The pieces that have a length, in place."""
    arcs = [Arc(radius, sweep) if radius * abs(sweep) > ROUNDING else None for sweep in sweeps]
    middle = Line(line) if line is not None and line > ROUNDING else None
    pieces = arcs if line is None else [arcs[0], middle, arcs[1]]
    curves = [piece for piece in pieces if piece is not None]
    if not curves:
        return ()
    return Route.joined([curves[0].moved(*start), *curves[1:]]).curves


@dataclass(frozen=True)
class Step:
    """A formation of a programme, and where it is danced.

    Attributes:
        formation: what is danced.
        at: where its centre lies, m; None where it begins as the one before it ends.
        turned: by how much it is turned about its centre, rad.
    """

    formation: Formation
    at: Point | None = None
    turned: float = 0.0

    def __post_init__(self) -> None:
        of_kind("formation", self.formation, Formation)
        _check(((0.0, 0.0) if self.at is None else self.at, self.turned))
        if self.at is None and self.turned != 0.0:
            raise InputError(
                _("turned has no effect without at: this formation begins as the one before it ends")
            )


def programme(steps: Sequence[Step], radius: float) -> Route:
    """The route of formations one after another, with connections between those that do not meet.

    Of Dubins' six kinds each connection is the shortest of those that cross the formations before
    and behind it least often (as seen on polylines); the first formation is danced about the origin
    where nothing is said. Whether a dragon walks it free of contact is for `check` to say.

    Args:
        steps: at least one.
        radius: of the connections' arcs, m.

    Raises:
        InputError: for no steps, and for what is none.
    """
    if isinstance(steps, str) or not isinstance(steps, Sequence):
        text = _("steps must be a list of Step, not {value}")
        raise InputError(text.format(value=brief(steps)))
    for step in steps:
        of_kind("step", step, Step)
    positive("radius", radius, "m")
    if not steps:
        raise InputError(_("a programme needs at least one formation"))
    routes: list[Route] = []
    for step in steps:
        own = step.formation.build()
        if step.at is None and routes:
            first, *rest = own.curves
            routes.append(Route.joined([first.moved(*routes[-1].end_pose), *rest]))
        else:
            routes.append(own.moved(step.turned, step.at or (0.0, 0.0)))
    curves = list(routes[0].curves)
    for (before, after), step in zip(pairwise(routes), steps[1:], strict=True):
        between = () if step.at is None else _fitting(before, after, radius).curves
        curves += [*between, *after.curves]
    return Route.joined(curves)


def _fitting(before: Route, after: Route, radius: float) -> Connection:
    """The connection of two routes that crosses them least often; of several the shortest."""
    found = connections(before.end_pose, after.start_pose, radius)
    others = [_polyline(route) for route in (before, after)]

    def crossed(one: Connection) -> int:
        if not one.curves:
            return 0
        way = _polyline(Route(one.curves))[1:-1]  # at its ends it touches them
        return sum(crossings(way, other) for other in others)

    return min(found, key=crossed)  # the first of the least, and they are sorted


def _polyline(route: Route) -> FloatArray:
    """Points along a route, (n, 2), m."""
    count = min(MOST_CHORDS, max(8, math.ceil(route.length / CHORD)))
    return route.point(np.linspace(0.0, route.length, count + 1))


def crossings(one: FloatArray, other: FloatArray) -> int:
    """How many chords of two polylines, (n, 2) and (m, 2), m, cross each other."""
    ours, theirs = _runs(one), _runs(other)
    boxes = [[(run.min(axis=0), run.max(axis=0)) for run in runs] for runs in (ours, theirs)]
    low, high = np.array(boxes[0]).transpose(1, 0, 2)[:, :, None]
    their_low, their_high = np.array(boxes[1]).transpose(1, 0, 2)
    # Where the boxes of two runs lie apart, no chord of the one crosses one of the other.
    near = ((low <= their_high) & (their_low <= high)).all(axis=-1)
    return sum(_crossings_of_runs(ours[i], theirs[j]) for i, j in np.argwhere(near))


def _runs(line: FloatArray) -> list[FloatArray]:
    """A polyline in parts of RUN chords; each begins at the last point of the one before it."""
    return [line[at : at + RUN + 1] for at in range(0, max(1, len(line) - 1), RUN)]


def _crossings_of_runs(one: FloatArray, other: FloatArray) -> int:
    """The crossings of two polylines, each chord of the one against each of the other."""
    a, b, start, end = one[:-1, None], one[1:, None], other[:-1], other[1:]
    along = end - start
    # Each chord's ends must lie on different sides of the other.
    across = _cross(along, a - start) * _cross(along, b - start) < 0.0
    sides = _cross(b - a, start - a) * _cross(b - a, end - a) < 0.0
    return int((across & sides).sum())


def _cross(one: FloatArray, other: FloatArray) -> FloatArray:
    return np.asarray(one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0])
