"""Where a place of a dance is, told from things that are there while it is danced.

The peg is pulled out before, and chalk is walked off: obstacles, entrances and the venue's edges stay.
"""

import math
from collections.abc import Iterator

import numpy as np

from benchdragon.analysis.findings import named
from benchdragon.analysis.ground import Ground, way_out
from benchdragon.analysis.obstacle_distance import nearest_boxes
from benchdragon.i18n import _
from benchdragon.kernels.box import Box
from benchdragon.model.base_curve import Point
from benchdragon.model.obstacle import Obstacle
from benchdragon.plans.schema import Plan

# A thing that is so near, m, tells a place better than the venue's edges do.
BESIDE = 5.0


def whereabouts(plan: Plan, ground: Ground, place: Point) -> str:
    """Where a place is, m of the plan, in the language in use.

    From the nearest thing that stands beside it, else from the edges of the venue that it is in, else
    from the nearest thing of all; from where the peg stood only where nothing stands.
    """
    things = sorted((math.dist(at, place), n, at, name) for n, (at, name) in _things(plan, place))
    edges = _edges(plan, ground, place)
    if things and (things[0][0] <= BESIDE or not edges):
        _far, _n, at, name = things[0]
        return _("from {thing} {offset}").format(thing=name, offset=offset(ground, at, place))
    if edges:
        return edges
    return _("from where the peg stood {offset}").format(offset=offset(ground, ground.peg, place))


def offset(ground: Ground, start: Point, end: Point) -> str:
    """Where a place lies from another, m, as one measures it on the ground."""
    (x, y), (to_x, to_y) = ground.seen_at(start), ground.seen_at(end)
    right, forward, left, back = ground.way_names
    return _("{x} m {way_x} and {y} m {way_y}").format(
        x=f"{abs(to_x - x):.1f}", way_x=right if to_x >= x else left,
        y=f"{abs(to_y - y):.1f}", way_y=forward if to_y >= y else back,
    )  # fmt: skip


def venue_of(plan: Plan) -> Obstacle | None:
    """The venue, if the plan has one."""
    return next((one for one in plan.obstacles() if one.kind == "venue"), None)


def _things(plan: Plan, place: Point) -> Iterator[tuple[int, tuple[Point, str]]]:
    """Obstacles and entrances, numbered: the point of each that is nearest to a place, m, its name.

    Of what is round it is the middle.
    """
    n = 0
    for obstacle in plan.obstacles():
        if obstacle.kind != "venue":
            yield n, (_nearest_point(obstacle, place), named(obstacle))
            n += 1
    for k, (x, y) in enumerate(plan.event.places, start=1):
        yield n, ((x, y), _("entrance {n}").format(n=k))
        n += 1


def _nearest_point(obstacle: Obstacle, place: Point) -> Point:
    """The point of an obstacle's sides that is nearest to a place, m; the centre of a circle."""
    spot = np.array([[place[0], place[1], 1.0, 0.0, 0.0, 0.0]])
    _far, which = nearest_boxes(spot, obstacle)
    side = obstacle.boxes[int(which[0])].tolist()
    x, y, u, v = side[Box.CX], side[Box.CY], side[Box.UX], side[Box.UY]
    half = side[Box.HALF_LENGTH]
    along = min(max((place[0] - x) * u + (place[1] - y) * v, -half), half)
    return x + along * u, y + along * v


def _edges(plan: Plan, ground: Ground, place: Point) -> str:
    """Where a place within the venue is from its edges: the nearer one along each axis; else ""."""
    venue = venue_of(plan)
    found = [] if venue is None else [way_out(venue.outline, place, way) for way in ground.ways]
    met = [(one[0], ground.edge_name(ground.edge(one[1]))) for one in found if one is not None]
    if len(met) < len(ground.ways):
        return ""
    right, forward, left, back = met
    (x, edge_x), (y, edge_y) = min(right, left), min(forward, back)
    text = _("{x} m from the {edge_x} and {y} m from the {edge_y}")
    return text.format(x=f"{x:.1f}", edge_x=edge_x, y=f"{y:.1f}", edge_y=edge_y)
