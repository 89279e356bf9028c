"""A plan's numbers as written, in balls: those that a proof is about.

A plan file's numbers are decimals, and pi is pi. From these sizes, curves and places are computed in
ball arithmetic; no double stands between. Where a route is found by a search (a formation, a drawing, a
turn with clothoids), or put together (a street and a coil, rounds), its curves are taken for exact as
they are stored.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

from flint import arb

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.kernels.route_parts import RoutePart
from benchdragon.kernels.turn_families import LEAD
from benchdragon.model.walk import Walk
from benchdragon.plans.routes import PartsRoute, SpiralInRoute, TurnRoute
from benchdragon.plans.schema import Plan
from benchdragon.plans.square import RectangleTable
from benchdragon.plans.tables import ArcPart, CurvePart, LinePart, SpiralPart
from benchdragon.proofs.ball_route import BallRoute, Pair
from benchdragon.proofs.exact import Numbers
from benchdragon.proofs.parts import (
    NOWHERE,
    Part,
    Start,
    as_written,
    ball,
    bridge_between,
    line_between,
    route_of,
    two_arcs,
)


class Told(NamedTuple):
    """A plan's route: parts in order, where the first begins, and where it ends, m."""

    parts: list[Part]
    start: Start = NOWHERE
    lead: arb | None = None


def refuse_rounded(plan: Plan) -> None:
    """Refuse to prove a plan some of whose numbers were rounded when it was read.

    Raises:
        InputError: naming the first, and what may be written for it.
    """
    for written, kept in plan.source.rounded:
        text = _(
            "what is proved must be what is written: {written} was rounded to {kept} (write that, "
            "if it will do)"
        )
        raise InputError(text.format(written=repr(written), kept=kept))


def numbers_of(plan: Plan, walk: Walk) -> Numbers:
    """The exact numbers of a plan, `walk` being built of it.

    Raises:
        InputError: for a number that the plan holds rounded, or a route that cannot be enclosed.
    """
    refuse_rounded(plan)
    told = _told(plan, walk)
    if told is None:
        route, start = BallRoute.stored(walk.route.rows), arb(walk.start)
    else:
        route = route_of(told.parts, walk.route.rows, told.start, *_moved(plan), told.lead)
        start = arb(0) if told.lead is None else told.lead
    if plan.cues.cue:
        start = arb(walk.start)
    elif plan.walk.position is not None:
        start = number(plan.walk.position)
    return Numbers(walk, route, start, as_written, _rectangles(plan))


def assumed_of(plan: Plan, walk: Walk) -> str:
    """The assumptions of every proof about a plan."""
    if _told(plan, walk) is None:
        return _(
            "the numbers of the plan are exact as they are written; the curves of its route as they "
            "were computed and stored, each of which begins where the one before it ends"
        )
    return _(
        "the numbers of the plan are exact as they are written, and so is what follows from them; pi "
        "is pi"
    )


def number(value: float) -> arb:
    """A number of a plan."""
    return ball(as_written(value))


def _degrees(value: float) -> arb:
    return number(value) * arb.pi() / 180


def _pair(point: tuple[float, float]) -> Pair:
    return number(point[0]), number(point[1])


def _moved(plan: Plan) -> tuple[arb, Pair]:
    """By what the whole dance is turned, rad, and then moved, m."""
    return _degrees(plan.route.turned), _pair(plan.route.at or (0.0, 0.0))


def _told(plan: Plan, walk: Walk) -> Told | None:
    """The parts of a plan's route; None where its curves are taken as they are stored."""
    route = plan.route
    if not route.once:
        return None
    if isinstance(route, SpiralInRoute):
        pitch, disc = number(route.pitch), plan.disc.radius
        end = arb(0) if disc is None else number(disc) * 2 * arb.pi() / pitch
        return Told([Part(pitch, 2 * arb.pi() * number(route.start_turn), end)])
    if isinstance(route, TurnRoute):
        return _turn(plan, route, walk)
    if isinstance(route, PartsRoute):
        point = None if route.start is None else _pair(route.start)
        heading = None if route.heading is None else _degrees(route.heading)
        return Told([_part(part) for part in route.part], Start(point, heading))
    return None


def _part(part: CurvePart) -> Part:
    """A part of a route, as its table says it."""
    if isinstance(part, LinePart):
        return Part(number(part.length))
    if isinstance(part, ArcPart):
        return Part(number(part.radius), _degrees(part.angle))
    if isinstance(part, SpiralPart):
        turns = 2 * arb.pi() / number(part.pitch)
        ends = (number(radius) * turns for radius in (part.start_radius, part.end_radius))
        return Part(number(part.pitch), *ends)
    size: Any = part  # a clothoid or a logarithmic spiral
    bends = number(size.start_curvature), number(size.end_curvature)
    return Part(number(size.length), *bends)


def _turn(plan: Plan, route: TurnRoute, walk: Walk) -> Told | None:
    """In along a spiral, arcs, out along its twin; None for turns without closed form."""
    turn, disc = plan.turn, route.disc(plan)
    entry = disc if turn.entry_radius is None else turn.entry_radius
    exit_ = entry if turn.exit_radius is None else turn.exit_radius
    pitch, ends = number(route.pitch), (number(entry), number(exit_))
    lengths = [curve.length for curve in walk.route.curves[1:-1]]
    if turn.ease > 0.0 or turn.family == "arc-arc-arc":
        return None
    bridge = bridge_between(pitch, *ends)
    pieces: Sequence[Part] = ()
    if turn.family == "arc-arc" and len(lengths) == 2:
        pieces = two_arcs(bridge, number(turn.ratio), lengths)
    elif turn.family == "arc-line-arc" and turn.radii is not None and len(lengths) == 3:
        pieces = line_between(bridge, _pair(turn.radii), lengths)
    if not pieces:
        return None
    entering, leaving = (2 * arb.pi() * radius / pitch for radius in ends)
    first, last = walk.route.parts[0], walk.route.parts[-1]  # where they begin and end decides nothing
    spirals = (
        Part(pitch, arb(first[RoutePart.FIRST]), entering),
        Part(pitch, leaving, arb(last[RoutePart.LAST])),
    )
    return Told([spirals[0], *pieces, spirals[1]], NOWHERE, arb(LEAD))


def _rectangles(plan: Plan) -> dict[str, list[Pair]]:
    """The corners of the rectangles that a plan says by centre, size and angle, m, by their names."""
    names = [obstacle.name for obstacle in plan.obstacles()]
    found: dict[str, list[Pair]] = {}
    venue = plan.venue
    if venue.rectangle is not None:
        found[names[0]] = _corners(venue.centre or (0.0, 0.0), venue.rectangle, venue.angle or 0.0)
    for name, table in zip(names[len(names) - len(plan.obstacle) :], plan.obstacle, strict=True):
        if isinstance(table, RectangleTable):
            found[name] = _corners(table.centre, table.size, table.angle)
    return found


def _corners(centre: tuple[float, float], size: tuple[float, float], angle: float) -> list[Pair]:
    (x, y), (a, b) = _pair(centre), (side / 2 for side in _pair(size))
    s, c = _degrees(angle).sin_cos()
    corners = ((a, b), (-a, b), (-a, -b), (a, -b))
    return [(x + p * c - q * s, y + p * s + q * c) for p, q in corners]
