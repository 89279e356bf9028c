"""Outlines of obstacles as pictures and pages draw them, and of the margins about them."""

import math
from typing import Any

import numpy as np

from benchdragon.kernels.curve import FloatArray
from benchdragon.model.obstacle import Obstacle

# Corners of a quarter of a circle that is drawn.
QUARTER = 32


def drawn_rings(obstacle: Obstacle) -> list[FloatArray]:
    """The outline of an obstacle to be drawn, m, (P, 2) each; those of a line are open."""
    if obstacle.kind != "circle":
        return [obstacle.outline]
    angles = np.linspace(0.0, 2.0 * math.pi, 4 * QUARTER, endpoint=False)
    return [obstacle.outline[0] + obstacle.radius * np.column_stack([np.cos(angles), np.sin(angles)])]


def margin_rings(obstacle: Obstacle) -> list[FloatArray]:
    """Where benches are as near as they may be, to be drawn: closed rings, m, (P, 2) each; or none.

    Of the venue they lie inside its edge; none are left where its margin leaves no room.
    """
    if not obstacle.margin:
        return []
    import shapely  # only pictures of a square need it

    if obstacle.kind == "line":
        shape: Any = shapely.LineString(obstacle.outline)
    else:
        shape = shapely.Polygon(drawn_rings(obstacle)[0])
    away = -obstacle.margin if obstacle.kind == "venue" else obstacle.margin
    kept = shape.buffer(away, quad_segs=QUARTER)
    polygons = [kept] if kept.geom_type == "Polygon" else list(kept.geoms)
    rings = [ring for one in polygons if not one.is_empty for ring in (one.exterior, *one.interiors)]
    return [np.asarray(ring.coords)[:-1] for ring in rings]
