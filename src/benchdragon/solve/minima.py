"""Low points of a function of several unknowns within ranges: all over them, then nearby.

A point is a list of numbers, ranges are pairs of numbers; where both are the same the unknown stays.
"""

from collections.abc import Callable, Sequence

import numpy as np

from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.turn_question import spread
from benchdragon.progress import Progress

Score = Callable[[list[float]], float]
Ranges = Sequence[tuple[float, float]]

# Points that are strewn for each unknown, the lowest of them that are gone on from, and how far apart
# those are, as a share of ranges.
STREWN, STARTS, APART = 200, 4, 0.1
# Edge of the first simplex, as a share of each range.
SIMPLEX = 0.02
# Evaluations of each local search.
LOCAL = 200


def low_points(score: Score, ranges: Ranges, progress: Progress) -> list[tuple[list[float], float]]:
    """Low points downhill from the lowest of points strewn evenly over the ranges, and their scores."""
    low, high = np.array(ranges).T
    count = STREWN * len(ranges)
    powers = spread(len(ranges)) ** -np.arange(1.0, len(ranges) + 1.0)
    shares = (0.5 + np.arange(count)[:, np.newaxis] * powers) % 1.0
    found = []
    for n, point in enumerate(low + (high - low) * shares):
        found.append((point.tolist(), score(point.tolist())))
        progress(0.5 * (n + 1) / count, "")
    starts: list[int] = []
    for n in sorted(range(count), key=lambda n: found[n][1]):
        if len(starts) < STARTS and all(np.abs(shares[n] - shares[m]).max() > APART for m in starts):
            starts.append(n)
    ends = []
    for n in starts:
        end = downhill_point(score, ranges, found[n][0], LOCAL)
        ends.append((end, score(end)))
        progress(0.5 + 0.5 * len(ends) / STARTS, "")
    return ends


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
