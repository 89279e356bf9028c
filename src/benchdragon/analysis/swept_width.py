"""Where the band that a dance covers along its route is widest, across the route.

At a place of the route, the band is what is covered of the line square to the route there, as far as a
bench can reach from its own route, by benches that stand there: the place lies between their ends.
"""

from dataclasses import dataclass

import numpy as np

from benchdragon.analysis.swept_steps import SLACK, Steps, placed_steps
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.ground_covered import band_sides
from benchdragon.model.answer import Answer
from benchdragon.model.base_curve import Point
from benchdragon.model.walk import Walk

# Cells of the route in which the band is bounded: their length at first, m; how many there may be.
CELL, MOST_CELLS = 0.25, 20_000
# How often those that may hold the widest place are halved; unless pairs of cell and hull were more.
HALVINGS, MOST_PAIRS = 7, 1_500_000
# Cells in which the band is measured in full, and places of each kind of bench there.
TRIED, PLACES = 4, 512


@dataclass(frozen=True)
class Widest:
    """The widest place of a band.

    Attributes:
        width: m, with a bracket; its value was seen at `s`.
        s: route position, m.
        point: of the route there, m.
        left: how far the band reaches to the left of the route there, m.
        right: to the right.

    Examples:
        >>> area = bd.read_plan("spiral-in", {"dragon.benches": 5}).swept_area(0.0, 10.0)
        >>> round(area.widest.width.value, 3)
        0.465
    """

    width: Answer
    s: float
    point: Point
    left: float
    right: float


def widest_place(walk: Walk, steps: Steps) -> Widest:
    """Where the band is widest: cells that cannot hold that place are left out, the others halved.

    The bracket closes with the error of the steps, unless the band is as wide almost everywhere.
    """
    stretches = _stretches(steps.sizes[:, steps.kind], steps.front, steps.rear)
    low, high = float(steps.rear.min()), min(float(steps.front.max()), walk.route.length)
    count = int(min(max(np.ceil((high - low) / CELL), 1), MOST_CELLS))
    borders = np.linspace(low, high, count + 1)
    ends, best, most = np.column_stack([borders[:-1], borders[1:]]), (0.0, 0.0, low), np.inf
    for _halving in range(HALVINGS + 1):
        sides, pairs = _sides(walk, steps, ends, steps.corners, stretches, steps.widest_stray + SLACK)
        bounds = sides.sum(axis=1)
        most = min(most, float(bounds.max()))
        tried = ends[np.argsort(-bounds)[:TRIED]].mean(axis=1)
        best = max([best, *(_measured(walk, steps, s) for s in tried.tolist())], key=_width)
        low_ends, high_ends = ends[bounds > _width(best)].T
        if not len(low_ends) or pairs > MOST_PAIRS:
            break
        middle = 0.5 * (low_ends + high_ends)
        ends = np.column_stack([low_ends, middle, middle, high_ends]).reshape(-1, 2)
    (left, right, s), wide = best, _width(best)
    x, y = walk.route.point(s).tolist()
    return Widest(Answer(wide, wide, max(wide, most), "m", "found"), s, (x, y), left, right)


def _width(measured: tuple[float, float, float]) -> float:
    return measured[0] + measured[1]


def _stretches(sizes: FloatArray, front: FloatArray, rear: FloatArray) -> FloatArray:
    """From where to where along the route the bench of each step may stand, m, (n, 2)."""
    _length, width, nose, end = sizes
    return np.column_stack([rear[:, 0] - end - width, front[:, 1] + nose + width])


def _sides(
    walk: Walk, steps: Steps, ends: FloatArray, corners: FloatArray, stretches: FloatArray, near: float
) -> tuple[FloatArray, int]:
    """How far the band reaches at most beside cells of the route, m, (n, 2): see `band_sides`."""
    length, width, front, rear = steps.sizes
    ahead = np.maximum(0.5 * (length - front - rear), np.maximum(front, rear))
    out = float(np.hypot(ahead, 0.5 * width).max()) + SLACK  # of a bench from the nearer handle
    sides = np.empty((len(ends), 2))
    hulls = corners.reshape(len(corners), -1)
    return sides, band_sides(walk.route.rows, ends, hulls, stretches, near, out, sides)


def _measured(walk: Walk, steps: Steps, s: float) -> tuple[float, float, float]:
    """How far benches that really stand at route position s, m, reach to the left and right; and s."""
    reached = np.zeros(2)
    for k, spans in enumerate(steps.spans):
        length, width, front, rear = steps.sizes[:, k]
        low, high = s - front - width, s + rear + width + 2.0 * length
        held = spans[(spans[:, 1] >= low) & (spans[:, 0] <= high)]
        if not len(held):
            continue
        clipped = np.clip(held, low, high)[:TRIED]
        at = np.unique(np.concatenate([np.linspace(a, b, PLACES) for a, b in clipped.tolist()]))
        _k, ends, back, corners, _stray, _fill = placed_steps(
            walk, steps.sizes, k, np.column_stack([at, at])
        )
        stretches = _stretches(steps.sizes[:, k], ends, back)
        sides, _pairs = _sides(walk, steps, np.array([[s, s]]), corners, stretches, 0.0)
        reached = np.maximum(reached, sides[0])
    return float(reached[0]), float(reached[1]), s
