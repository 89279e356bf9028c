"""How a dragon comes onto its line before a dance and leaves after it, in sentences for the leader."""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from benchdragon.analysis.findings import named
from benchdragon.analysis.ground import Ground, way_out
from benchdragon.analysis.not_looked_at import places
from benchdragon.analysis.obstacle_distance import nearest_boxes
from benchdragon.explain.whereabouts import offset, venue_of, whereabouts
from benchdragon.i18n import _
from benchdragon.kernels.route import evaluate
from benchdragon.model.base_curve import Point
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan

# How far ahead one looks where there is no venue, m; so near, m, something is met.
FAR, MET = 20.0, 1e-3


def coming_lines(
    plan: Plan, walk: Walk, span: tuple[float, float], ground: Ground
) -> tuple[list[str], list[str]]:
    """How to line up before a walk over a span, s, and how to leave after it, in the language in use.

    Raises:
        WalkError: if the dragon cannot stand at the start or at the end.
    """
    first, last = places(walk, *span)
    square = Square(plan, walk, ground)
    return [*_coming(square, first[-1], first[0])], [*_leaving(square, last[0], last[-1])]


class Square(NamedTuple):
    """Where one comes and leaves."""

    plan: Plan
    walk: Walk
    ground: Ground

    def pose(self, s: float) -> tuple[Point, Point]:
        """A place of the route, m along it, and the unit vector ahead there."""
        out = np.empty((1, 4))
        evaluate(self.walk.route.rows, np.array([min(s, self.walk.route.length)]), out)
        ((x, y, heading, _curvature),) = out.tolist()
        return (x, y), (math.cos(heading), math.sin(heading))

    def told(self, place: Point) -> str:
        """Where a place is, m."""
        return whereabouts(self.plan, self.ground, place)


def _coming(square: Square, tail: float, head: float) -> Iterator[str]:
    """From where to come in: along the line from where the tail starts to where the head does, m."""
    place, ahead = square.pose(tail)
    text = _(
        "To line up, the head comes to where the tail starts ({place}) and walks slowly along the line "
        "to where the head starts ({start}); the others follow. Then each bench stands where its sheet "
        "says. The check says nothing of this walk, nor of leaving."
    )
    yield text.format(place=square.told(place), start=square.told(square.pose(head)[0]))
    way, walking = head - tail, square.plan.walk
    text = _(
        "From the one place to the other it is {way} m: {minutes} min at the speed of the dance. Have "
        "all in line before it starts."
    )
    if walking.profile:
        text = _("From the one place to the other it is {way} m. Have all in line before it starts.")
    yield text.format(way=f"{way:.0f}", minutes=math.ceil(way / walking.speed / 60.0))
    blocked = _(
        "Back along the line from where the tail starts, {name} is in the way after {far} m: come to "
        "the line from the side."
    )
    free = _("Back along the line from where the tail starts it is {far} m to the {edge} of {venue}.")
    yield from _straight_on(square, place, (-ahead[0], -ahead[1]), blocked, free)
    for n, entrance in _nearest_entrance(square.plan, place):
        text = _("Entrance {n} is nearest to where the tail starts: from the entrance {far}.")
        yield text.format(n=n, far=offset(square.ground, entrance, place))


def _leaving(square: Square, head: float, tail: float) -> Iterator[str]:
    """Where one stands at the end, m along the route, and the way out from there."""
    coiled = square.plan.route.kind == "spiral-in"
    text = _("At the end the head stands here: {place}. It goes on from there.")
    if coiled:
        text = _(
            "At the end the head stands inside: {place}. Pull the pins from the tail on, and walk out "
            "bench by bench."
        )
    yield text.format(place=square.told(square.pose(head)[0]))
    place, ahead = square.pose(tail if coiled else head)
    if coiled:
        yield from _nearest_edge(square, place)
    else:
        blocked = _(
            "Straight on from there {name} is in the way, {far} m ahead: bend away before it, no more "
            "sharply than in the dance. The plan says nothing of that way."
        )
        free = _(
            "Straight on from there it is {far} m to the {edge} of {venue}, met here: {place}. The "
            "plan says nothing of that way: open the edge there, or bend before it no more sharply "
            "than in the dance."
        )
        yield from _straight_on(square, place, ahead, blocked, free)
    for n, entrance in _nearest_entrance(square.plan, place):
        text = _("Entrance {n} is then nearest to the head: {far} from it.")
        if coiled:
            text = _("Entrance {n} is then nearest to the tail: {far} from it.")
        yield text.format(n=n, far=offset(square.ground, place, entrance))


def _straight_on(square: Square, start: Point, way: Point, blocked: str, free: str) -> Iterator[str]:
    """What one meets who goes straight on from a place, m: an obstacle, else the venue's edge."""
    venue = venue_of(square.plan)
    found = None if venue is None else way_out(venue.outline, start, way)
    met = _in_the_way(square, start, way, FAR if found is None else found[0])
    if met is not None:
        yield blocked.format(name=met[1], far=f"{met[0]:.1f}")
    elif venue is not None and found is not None:
        far, out = found
        within = start[0] + (far - MET) * way[0], start[1] + (far - MET) * way[1]
        yield free.format(
            edge=square.ground.edge_name(square.ground.edge(out)), venue=named(venue),
            far=f"{far:.1f}", place=square.told(within),
        )  # fmt: skip


def _in_the_way(square: Square, start: Point, way: Point, far: float) -> tuple[float, str] | None:
    """Distance to and name of the obstacle straight ahead of a bench within so many m."""
    people, widths = square.plan.people, square.walk.dragon.width.tolist()
    aside = 0.5 * max(widths) + people.beside + people.sway + people.imprecision
    found = []
    for one in square.plan.obstacles():
        at = 0.0 if one.kind != "venue" else far
        while at < far:
            # Nothing is nearer than what is nearest: so far one may walk.
            gap = _apart(one, (start[0] + at * way[0], start[1] + at * way[1])) - aside - one.margin
            if gap <= MET:
                found.append((at, named(one)))
                break
            at += gap
    return min(found, default=None)


def _apart(obstacle: Obstacle, place: Point) -> float:
    """How far an obstacle's sides are from a place, m."""
    far, _which = nearest_boxes(np.array([[place[0], place[1], 1.0, 0.0, 0.0, 0.0]]), obstacle)
    return float(far[0]) - obstacle.radius


def _nearest_entrance(plan: Plan, place: Point) -> list[tuple[int, Point]]:
    """The plan's entrance that is nearest to a place, m, with its number from 1, if it has any."""
    known = [(math.dist(one, place), n, one) for n, one in enumerate(plan.event.places, start=1)]
    return [(n, (x, y)) for _far, n, (x, y) in sorted(known)[:1]]


def _nearest_edge(square: Square, tail: Point) -> Iterator[str]:
    """Which edge of the venue is nearest to the tail of a coil, where it stands, m."""
    venue = venue_of(square.plan)
    found = None if venue is None else way_out(venue.outline, tail)
    if venue is not None and found is not None:
        text = _("The nearest edge to the tail is then the {edge} of {venue}: {far} m away.")
        edge = square.ground.edge_name(square.ground.edge(found[1]))
        yield text.format(edge=edge, venue=named(venue), far=f"{found[0]:.1f}")
