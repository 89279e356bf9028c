"""Shortest connections of two poses by arcs of one radius and lines, and programmes joined by them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from benchdragon.errors import InputError, brief, of_kind, positive
from benchdragon.i18n import _
from benchdragon.kernels import connections as kernel
from benchdragon.kernels import route_parts
from benchdragon.kernels.connections import JoiningWay
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.arrays import as_numbers
from benchdragon.model.base_curve import Point, check_pose
from benchdragon.model.curves import AnyCurve, Route, curves_of
from benchdragon.model.formations import Formation

Pose = tuple[Point, float]

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
    count = kernel.connections(_pose(start), _pose(end), radius, ways)
    return [_connection(start, ways, n, radius) for n in range(count)]


def _pose(pose: Pose) -> route_parts.Pose:
    return route_parts.Pose(*pose[0], pose[1])


def _connection(start: Pose, ways: FloatArray, n: int, radius: float) -> Connection:
    parts = np.empty((kernel.PIECES, route_parts.PART_COLUMNS))
    count = kernel.way_parts(_pose(start), ways, n, radius, parts)
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


def _check_steps(steps: object) -> None:
    """Refuse invalid steps."""
    if isinstance(steps, str) or not isinstance(steps, Sequence):
        text = _("steps must be a list of Step, not {value}")
        raise InputError(text.format(value=brief(steps)))
    for step in steps:
        of_kind("step", step, Step)
