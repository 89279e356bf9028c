"""How far benches stray, while their front handle walks a step, from a straight way between its ends.

And how much the route turns in a stretch. Both hold for the whole step, not for places looked at.
"""

import math

import numpy as np

from benchdragon.kernels import step_bounds as bounds
from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.chain import Placements
from benchdragon.kernels.entries import allocates, entry
from benchdragon.kernels.regions import walks_on
from benchdragon.kernels.route import locate
from benchdragon.kernels.step_bounds import bound_bench, heading_bound


@entry
@allocates
def strays(rows: Table, link: Vector, sizes: Table, k: int, places: Placements, out: Vector) -> None:
    """Fill out[n] for the step from slot 2n to slot 2n + 1 of `places`, of benches of sizes k.

    It is at most how far, m, any of a bench's points is on the way from where it would be, had it gone
    straight and evenly from its place at one end to that at the other; infinite where it is not sure
    that the bench walks on without a leap. A point whose acceleration is at most M is within M h^2 / 8
    of the straight way; one that travels D, within D / 2 of its ends.
    """
    handles, bench = np.empty((2, bounds.HANDLE_COLUMNS)), np.empty(bounds.BENCH_COLUMNS)
    for n in range(out.shape[0]):
        out[n] = math.inf
        a = 2 * n
        if places.u[0, a] == places.u[0, a + 1] and places.row[0, a] == places.row[0, a + 1]:
            out[n] = 0.0
        elif walks_on(rows, places, a, link, handles):
            bound_bench(handles, 0, sizes, k, bench)
            h = handles[0, bounds.PATH]
            out[n] = min(0.125 * bench[bounds.POINT_ACCELERATION] * h * h, 0.5 * bench[bounds.TRAVEL])


@entry
def turnings(rows: Table, borders: Vector, out: Vector) -> None:
    """Fill out[n] with at least the angle, rad, that the route turns by in all from borders[n] on.

    Up to borders[n + 1]; route positions, m, ascending.
    """
    j, u, _ = locate(rows, borders[0])
    for n in range(out.shape[0]):
        next_j, next_u, _ = locate(rows, borders[n + 1])
        out[n] = heading_bound(rows, j, u, next_j, next_u)
        j, u = next_j, next_u
