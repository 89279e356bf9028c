"""Low points of a function of several unknowns within ranges: all over them, then nearby.

A point is a list of numbers, ranges are pairs of numbers; where both are the same the unknown stays.
"""

import itertools
from collections.abc import Callable, Sequence

import numpy as np

from benchdragon.kernels.curve import FloatArray
from benchdragon.progress import Progress

Score = Callable[[list[float]], float]
Ranges = Sequence[tuple[float, float]]

# Differential evolution: members for each unknown, generations, and the seeds of its random numbers: a
# few short searches end in more valleys than a long one.
MEMBERS, GENERATIONS, SEEDS = 10, 22, (1, 2)
# Least spread of the population, relative, at which it stops.
SPREAD = 1e-4
# Edge of the first simplex, as a share of each range.
SIMPLEX = 0.02
# Evaluations of each local search.
LOCAL = 200


def low_points(score: Score, ranges: Ranges, progress: Progress) -> list[tuple[list[float], float]]:
    """Low points that are found all over the ranges by one search after another, and their scores."""
    from scipy.optimize import Bounds, OptimizeResult, differential_evolution  # slow to import

    def value(x: FloatArray) -> float:
        return score(x.tolist())

    def callback(intermediate_result: OptimizeResult) -> None:
        del intermediate_result
        progress(next(generation) / (GENERATIONS * len(SEEDS)), "")

    generation = itertools.count(1)
    points = []
    for seed in SEEDS:
        found = differential_evolution(
            value, Bounds(*np.array(ranges).T), popsize=MEMBERS, maxiter=GENERATIONS,
            tol=SPREAD, rng=seed, polish=False, callback=callback, init="sobol",
        )  # fmt: skip
        points.append(([float(value) for value in found.x], float(found.fun)))
    return points


def constrained_point(
    score: Score,
    rooms: Callable[[list[float]], Sequence[float]],
    ranges: Ranges,
    x: Sequence[float],
    most: int,
) -> list[float]:
    """A low point near x at which none of the rooms is negative, by COBYQA, in unknowns from 0 to 1.

    It takes at most so many evaluations.
    """
    from scipy.optimize import Bounds, NonlinearConstraint, minimize  # slow to import

    low, high = np.array(ranges).T
    free = high > low

    def point(z: FloatArray) -> list[float]:
        whole = low.copy()
        whole[free] += (high - low)[free] * z
        found: list[float] = whole.tolist()
        return found

    def value(z: FloatArray) -> float:
        return score(point(z))

    result = minimize(
        value,
        ((np.asarray(x) - low)[free] / (high - low)[free]),
        method="COBYQA",
        bounds=Bounds(0.0, 1.0),
        constraints=NonlinearConstraint(lambda z: rooms(point(z)), 0.0, np.inf),
        options={"maxfev": most, "initial_tr_radius": 0.02, "final_tr_radius": 1e-7},
    )
    return point(np.clip(result.x, 0.0, 1.0))


def downhill_point(score: Score, ranges: Ranges, x: Sequence[float], most: int) -> list[float]:
    """A low point downhill from x by Nelder and Mead's simplex, which goes over edges too.

    It takes at most so many evaluations.
    """
    from scipy.optimize import minimize  # slow to import

    bounds = np.array(ranges)
    free = bounds[:, 1] > bounds[:, 0]
    low, high = bounds[free].T
    start = np.asarray(x)[free]
    step = np.where(start + SIMPLEX * (high - low) <= high, 1.0, -1.0) * SIMPLEX * (high - low)
    corners = np.vstack([start, start + np.diag(step)])

    def point(z: FloatArray) -> list[float]:
        whole = np.array(x)
        whole[free] = np.clip(z, low, high)
        return [float(value) for value in whole]

    def value(z: FloatArray) -> float:
        return score(point(z))

    result = minimize(
        value, start, method="Nelder-Mead",
        options={"initial_simplex": corners, "maxfev": most, "xatol": 1e-5, "fatol": 1e-6},
    )  # fmt: skip
    return point(result.x)
