"""How far benches stand from an obstacle at one placement, and which of their points are nearest."""

import math

import numpy as np

from benchdragon.analysis.distance import boxes, nearness
from benchdragon.kernels import obstacle_contact as kernel
from benchdragon.kernels.box import BOX_COLUMNS, Box
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray
from benchdragon.model.base_curve import Point
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.placement import Placement


def nearest_boxes(table: FloatArray, obstacle: Obstacle) -> tuple[FloatArray, IntArray]:
    """How far each bench is from the nearest of an obstacle's boxes, m, (N,); which box, (N,).

    An obstacle's radius lies within, and whether a bench stands where none may is not asked.

    Args:
        table: boxes of benches, (N, BOX_COLUMNS) of kernels/box.py.
        obstacle: from which.
    """
    out, which = np.empty(len(table)), np.empty(len(table), dtype=np.int64)
    kernel.distances_to(table, obstacle.boxes, np.empty((2, BOX_COLUMNS)), out, which)
    return out, which


def box_distances(placed: Placement, index: int, obstacle: Obstacle) -> tuple[FloatArray, IntArray]:
    """How far each bench is from an obstacle's boxes at one placement, m, (N,); which box, (N,).

    An obstacle's radius lies within; minus infinity where a bench stands where none may.
    """
    table = boxes(placed, index)
    out, which = nearest_boxes(table, obstacle)
    out[obstacle.forbids(table[:, [Box.CX, Box.CY]])] = -math.inf
    return out, which


def nearest_points(
    placed: Placement, index: int, bench: int, obstacle: Obstacle
) -> tuple[Point, Point]:
    """The point of a bench (row, from 0) nearest to an obstacle, and the obstacle's own, m."""
    table = boxes(placed, index)[bench : bench + 1]
    _distance, which = nearest_boxes(table, obstacle)
    near = nearness(np.vstack([table, obstacle.boxes[which]]), 0, 1)
    (ax, ay), (bx, by) = near.points
    share = min(obstacle.radius / near.distance, 1.0) if near.distance > 0.0 else 0.0
    return (ax, ay), (bx + share * (ax - bx), by + share * (ay - by))
