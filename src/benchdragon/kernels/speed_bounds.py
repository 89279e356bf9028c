"""Bounds on speed ratios from cells of the route, whatever the time.

The ratio of the speeds at a bench's two handles depends on its link and on where its front handle
stands, and on nothing else. The greatest in each cell of the route is found once; the product down a
chain then bounds all of its speeds over a long step of the head. That is looser than a chain's own
bounds, but far cheaper, and sees where a greatest speed cannot be (design/coarse_bound.py).
"""

import math

import numpy as np

from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.jit import entry
from benchdragon.kernels.regions import EDGE
from benchdragon.kernels.status import Status
from benchdragon.kernels.step_bounds import HANDLE_COLUMNS, SPEED, Placements, bound_handles

# Columns of what is known of a step of the head.
MOST = 0  # no handle has a greater speed ratio
SETTLED = 1  # nor has any whose bound lies below the limit
OPEN = 2  # handles from the head to the last one whose bound does not; 0: none
STEP_COLUMNS = 3


@entry
def cell_ratios(rows: Table, links: Vector, places: Placements, out: Vector) -> None:
    """Fill out[n] with the greatest ratio of speeds, rear handle over front handle, in cell n.

    `links` is one link, `places` its two handles with the front one at each border. A bench that
    cannot stand or may stand square to the route has an infinite one.
    """
    table = np.empty((2, HANDLE_COLUMNS))
    for n in range(out.shape[0]):
        out[n] = math.inf
        if places.failed[0, n] == Status.OK and places.failed[0, n + 1] == Status.OK:
            bound_handles(rows, links, places, n, n + 1, table)
            out[n] = table[1, SPEED]


@entry
def bound_steps(
    s: Table,
    group: IntVector,
    ratios: Table,
    cell: float,
    low: int,
    limits: Vector,
    steps: Table,
) -> None:
    """Fill steps, (steps, STEP_COLUMNS), with what the cells say of the handles' speed ratios.

    s[i, t] are route positions of the handles, m, before and after each step; ratios[g, c] the greatest
    ratio for benches of group g in cell c, of `cell` metres, counted from number `low`; limits[t] the
    ratio that is not of interest.
    """
    last = ratios.shape[1] - 1
    for t in range(steps.shape[0]):
        bound = steps[t, MOST] = steps[t, SETTLED] = 1.0
        steps[t, OPEN] = 1.0 if limits[t] < 1.0 else 0.0
        for i in range(group.shape[0]):
            a = max(math.floor((s[i, t] - EDGE) / cell) - low, 0)
            b = min(math.floor((s[i, t + 1] + EDGE) / cell) - low, last)
            greatest = ratios[group[i], a]
            for c in range(a + 1, b + 1):
                greatest = max(greatest, ratios[group[i], c])
            bound *= greatest
            steps[t, MOST] = max(steps[t, MOST], bound)
            if bound > limits[t]:
                steps[t, OPEN] = i + 2
            else:
                steps[t, SETTLED] = max(steps[t, SETTLED], bound)
