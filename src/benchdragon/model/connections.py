"""Shortest connections of two poses by arcs of one radius and lines, and programmes joined by them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from benchdragon.errors import InputError, brief, of_kind, positive
from benchdragon.i18n import _
from benchdragon.kernels import connections as kernel
from benchdragon.kernels import route_parts
from benchdragon.kernels.connections import JoiningWay
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import evaluate
from benchdragon.model.arrays import as_numbers
from benchdragon.model.base_curve import Point, check_pose, kernel_pose, laid_rows
from benchdragon.model.curves import AnyCurve, Route, Spiral, curves_of
from benchdragon.model.formations import Formation

Pose = tuple[Point, float]

# A spiral is entered at one of so many places of a turn; so many places of a way to it are sampled.
ENTRIES, SAMPLES = 24, 48
LETTERS = {1.0: "L", 0.0: "S", -1.0: "R"}


@dataclass(frozen=True)
class Connection:
    """A way from one pose to another: arcs of one radius and lines.

    Attributes:
        word: its pieces, L an arc to the left, S a line, R an arc to the right.
        curves: the pieces that have a length, in place; none where the poses are the same.

    Examples:
        >>> first, *others = bd.connections(((0.0, 0.0), 0.0), ((9.0, 0.0), 1.0), 2.0)
        >>> first.word, round(first.length, 3)
        ('RSL', 9.376)
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
        end: point, m, and heading, rad.
        radius: of the arcs, m.

    Examples:
        >>> ways = bd.connections(((0.0, 0.0), 0.0), ((9.0, 0.0), 1.0), 2.0)
        >>> [way.word for way in ways]
        ['RSL', 'LRL', 'LRL', 'LSR', 'LSL', 'RSR']
    """
    for pose in (start, end):
        _check(pose)
    positive("radius", radius, "m")
    ways = np.empty((kernel.MOST_WAYS, kernel.WAY_COLUMNS))
    count = kernel.connections(kernel_pose(start), kernel_pose(end), radius, ways)
    return [_connection(start, ways, n, radius) for n in range(count)]


def _connection(start: Pose, ways: FloatArray, n: int, radius: float) -> Connection:
    parts = np.empty((kernel.PIECES, route_parts.PART_COLUMNS))
    count = kernel.way_parts(kernel_pose(start), ways, n, radius, parts)
    hands = ways[n, JoiningWay.HANDS : JoiningWay.HANDS + kernel.PIECES].tolist()
    return Connection("".join(map(LETTERS.__getitem__, hands)), curves_of(parts[:count]))


def _check(pose: object) -> None:
    """Refuse invalid poses."""
    if not isinstance(pose, tuple) or len(pose) != 2:
        raise InputError(_("a pose must be ((x, y), heading), not {value}").format(value=brief(pose)))
    as_numbers("point", pose[0])
    check_pose(*pose)


@dataclass(frozen=True)
class Step:
    """A formation of a programme, and where it is danced.

    Attributes:
        formation: what is danced.
        at: where its centre lies, m; None where it begins as the one before it ends.
        turned: by how much it is turned about its centre, rad.

    Examples:
        >>> bd.Step(bd.formation("coil-in"), at=(5.0, 0.0), turned=1.0).turned
        1.0
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
        InputError: without steps, and for invalid ones.

    Examples:
        >>> coil, swing = bd.formation("coil-in"), bd.formation("tail-swing")
        >>> steps = [bd.Step(coil), bd.Step(swing, at=(40.0, 0.0))]
        >>> bd.programme(steps, 3.0).length > 100.0
        True
    """
    _check_steps(steps)
    positive("radius", radius, "m")
    if not steps:
        raise InputError(_("a programme needs at least one formation"))
    parts = [step.formation.build().parts for step in steps]
    table = np.array([
        (len(own), *((math.nan, 0.0) if n and step.at is None else step.at or (0.0, 0.0)), step.turned)
        for n, (own, step) in enumerate(zip(parts, steps, strict=True))
    ])  # fmt: skip
    given = np.concatenate(parts)
    out = np.empty((len(given) + kernel.PIECES * len(steps), route_parts.PART_COLUMNS))
    return Route(curves_of(out[: kernel.programme(given, table, radius, out)]))


def joined(before: Route, after: Route, radius: float) -> Route:
    """Along one route, then along another, by the shortest connection between.

    Where the second begins with a spiral inwards, it begins farther out on that, by less than a turn,
    wherever the way that does not lead across its turns is shortest so. `check` tells of the rest.

    Args:
        before: the first.
        after: the second; neither is moved.
        radius: of the connection's arcs, m.
    """
    positive("radius", radius, "m")
    first = _entered(before, after.curves[0], radius)
    parts, _whole = _shortest(before.end_pose, first.start_pose, radius)
    return Route((*before.curves, *curves_of(parts), first, *after.curves[1:]))


def _entered(before: Route, curve: AnyCurve, radius: float) -> AnyCurve:
    """A curve that a route leads to; a spiral inwards from farther out, where that makes it short."""
    if not isinstance(curve, Spiral) or not curve.inward:
        return curve
    turns = [curve.start_angle + 2.0 * math.pi * n / ENTRIES for n in range(ENTRIES)]
    begun = [replace(curve, start_angle=angle) for angle in turns]
    ways = [_around(before.end_pose, one, radius) for one in begun]
    return begun[ways.index(min(ways))]


def _around(start: Pose, spiral: Spiral, radius: float) -> float:
    """Length of the shortest way to a spiral and along it, m; infinite if it leads across its turns."""
    parts, whole = _shortest(start, spiral.start_pose, radius)
    if len(parts):
        poses = np.empty((SAMPLES, 4))
        evaluate(laid_rows(parts), np.array([whole * n / SAMPLES for n in range(SAMPLES)]), poses)
        (u, v), near = spiral.centre, spiral.start_angle * spiral.k - 0.25 * spiral.pitch
        away = [math.hypot(x - u, y - v) for x, y, _heading, _bend in poses.tolist()]
        if min(away) < near:
            return math.inf
    return whole + spiral.length


def _shortest(start: Pose, end: Pose, radius: float) -> tuple[FloatArray, float]:
    """The parts of the shortest connection of two poses, and its length, m."""
    ways = np.empty((kernel.MOST_WAYS, kernel.WAY_COLUMNS))
    parts = np.empty((kernel.PIECES, route_parts.PART_COLUMNS))
    kernel.connections(kernel_pose(start), kernel_pose(end), radius, ways)
    count = kernel.way_parts(kernel_pose(start), ways, 0, radius, parts)
    return parts[:count], float(ways[0, JoiningWay.WHOLE])


def _check_steps(steps: object) -> None:
    """Refuse invalid steps."""
    if isinstance(steps, str) or not isinstance(steps, Sequence):
        text = _("steps must be a list of Step, not {value}")
        raise InputError(text.format(value=brief(steps)))
    for step in steps:
        of_kind("step", step, Step)
