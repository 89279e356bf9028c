"""Outlines of obstacles and of the margins about them: for shapely, for pictures and for pages."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from benchdragon.kernels.curve import FloatArray
from benchdragon.model.obstacle import Obstacle

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

# Corners of a quarter of a circle that is drawn.
QUARTER = 32


def shape_of(obstacle: Obstacle) -> "BaseGeometry":
    """An obstacle as shapely has it, m: a circle as its centre, a venue as the polygon of its edge."""
    import shapely  # only squares need it

    if obstacle.kind == "circle":
        return shapely.Point(obstacle.outline[0])
    if obstacle.kind == "line":
        return shapely.LineString(obstacle.outline)
    return shapely.Polygon(obstacle.outline)


def outside_venue(obstacles: Sequence[Obstacle]) -> list[Obstacle]:
    """Which of obstacles lie wholly outside the venue among them; none where none is a venue."""
    venues = [shape_of(one) for one in obstacles if one.kind == "venue"]
    return [
        one
        for one in obstacles
        for venue in venues
        if one.kind != "venue" and venue.distance(shape_of(one)) > one.radius
    ]


def drawn_outline(obstacle: Obstacle) -> FloatArray:
    """The outline of an obstacle to be drawn, m, (P, 2); that of a line is open, all others closed."""
    if obstacle.kind != "circle":
        return obstacle.outline
    angles = np.linspace(0.0, 2.0 * math.pi, 4 * QUARTER, endpoint=False)
    ring: FloatArray = np.column_stack([np.cos(angles), np.sin(angles)])
    return np.asarray(obstacle.outline[0] + obstacle.radius * ring)


def margin_rings(obstacle: Obstacle) -> list[FloatArray]:
    """Where benches are as near as they may be, to be drawn: closed rings, m, (P, 2) each; or none.

    Of the venue they lie inside its edge; none are left where its margin leaves no room.
    """
    if not obstacle.margin:
        return []
    import shapely  # only squares need it

    away = -obstacle.margin if obstacle.kind == "venue" else obstacle.radius + obstacle.margin
    polygons = shapely.get_parts(shapely.buffer(shape_of(obstacle), away, quad_segs=QUARTER))
    rings = [ring for one in polygons if not one.is_empty for ring in (one.exterior, *one.interiors)]
    return [np.asarray(ring.coords)[:-1] for ring in rings]
