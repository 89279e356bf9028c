"""A route as a page draws it: cubics between nodes of single precision, and the error of these."""

import math

import numpy as np

from benchdragon.kernels.arrays import Table
from benchdragon.kernels.curve import FloatArray, heading, place
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.route import locate

# A stretch has evenly spaced nodes; its cubics are within so many metres of the route.
STRETCH_ERROR = 2e-5
# Nodes of a stretch, at most.
MOST_STRETCH_NODES = 4097


@kernel
def even(low: float, high: float, n: int, count: int) -> float:
    """Number n, from 0, of `count` numbers spread evenly from low to high."""
    return high if n == count - 1 else n * ((high - low) / (count - 1)) + low


@kernel
def single(value: float) -> float:
    """A number as single precision keeps it."""
    return float(np.float32(value))


@kernel
def cubic(a: float, b: float, rise_a: float, rise_b: float, f: float) -> float:
    """A cubic's value at a share f of a step; slopes are those of a step."""
    return a + f * f * (3.0 - 2.0 * f) * (b - a) + f * (1.0 - f) * ((1.0 - f) * rise_a - f * rise_b)


@kernel
def set_nodes(rows: FloatArray, low: float, high: float, count: int, nodes: FloatArray) -> None:
    """Fill the first columns of `nodes`: x, y, m from nodes[:2, -1], and heading, rad, unwrapped."""
    inside, before = (high - low) * 1e-9, 0.0  # headings at a joint are those of this side
    x0, y0 = nodes[0, MOST_STRETCH_NODES], nodes[1, MOST_STRETCH_NODES]
    for n in range(count):
        j, u, _status = locate(rows, even(low + inside, high - inside, n, count))
        x, y, _tx, _ty = place(rows, j, u)
        turned = heading(rows, j, u)
        if n > 0:
            turned -= math.tau * math.floor((turned - before) / math.tau + 0.5)
        nodes[0, n], nodes[1, n], nodes[2, n] = single(x - x0), single(y - y0), single(turned)
        before = turned


@kernel
def farthest_off(rows: FloatArray, low: float, high: float, count: int, nodes: FloatArray) -> float:
    """The largest sampled distance of the cubics between nodes from the route, m."""
    step, worst, looks = (high - low) / (count - 1), 0.0, 4 * (count - 1) + 1
    for i in range(looks):
        s = even(low, high, i, looks)
        n = min(max(int((s - low) / step), 0), count - 2)
        f = (s - low) / step - n
        a, b = nodes[2, n], nodes[2, n + 1]
        x = cubic(nodes[0, n], nodes[0, n + 1], step * math.cos(a), step * math.cos(b), f)
        y = cubic(nodes[1, n], nodes[1, n + 1], step * math.sin(a), step * math.sin(b), f)
        j, u, _status = locate(rows, s)
        at_x, at_y, _tx, _ty = place(rows, j, u)
        off = math.hypot(
            nodes[0, MOST_STRETCH_NODES] + x - at_x, nodes[1, MOST_STRETCH_NODES] + y - at_y
        )
        worst = max(worst, off)
    return worst


@entry
def draw_stretch(
    rows: Table, low: float, high: float, x: float, y: float, nodes: Table
) -> tuple[int, float]:
    """Fill the nodes of a stretch of route, from low to high, m; returns how many, and the error, m.

    Fills what it needs of `nodes`, (3, MOST_STRETCH_NODES + 1): x, y, m from (x, y), and heading, rad.
    """
    nodes[0, MOST_STRETCH_NODES], nodes[1, MOST_STRETCH_NODES], count = x, y, 2
    while True:
        set_nodes(rows, low, high, count, nodes)
        error = farthest_off(rows, low, high, count, nodes)
        if error <= STRETCH_ERROR or count == MOST_STRETCH_NODES:
            return count, error
        count = 2 * count - 1
