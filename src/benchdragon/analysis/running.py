"""Where on the ground handles run: places of a walk that lie close together are one stretch."""

import math
from typing import NamedTuple

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from benchdragon import budget
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.base_curve import Point
from benchdragon.model.walk import Walk

# Time step of samples, s; larger where handles x samples would exceed the limit.
STEP, MOST_LOOKS = 0.25, 5_000_000
# Places where handles run are kept once a square of so many m; those no farther apart than the second
# are one stretch.
SQUARE, APART = 1.0, 5.0


class Running(NamedTuple):
    """The fastest handle seen on a stretch where handles run: where, m, how fast, m/s, and when, s."""

    point: Point
    speed: float
    time: float


@budget.question()
def running_stretches(walk: Walk, start: float, end: float, run_from: float) -> tuple[Running, ...]:
    """Stretches of the ground on which handles go at a speed, m/s, or faster; the fastest first.

    Speeds are those at times STEP apart, so that a shorter run of a single handle may be overlooked.

    Raises:
        WalkError: if the dragon cannot stand at some time.
    """
    seen = _seen(walk, start, end, run_from)
    if not len(seen):
        return ()
    points = shapely.get_parts(shapely.MultiPoint(seen[:, :2]))
    one, other = shapely.STRtree(points).query(points, predicate="dwithin", distance=APART)
    near = coo_array((np.ones(len(one), dtype=bool), (one, other)), shape=(len(seen), len(seen)))
    _count, stretch = connected_components(near, directed=False)
    _stretches, first = np.unique(stretch, return_index=True)
    return tuple(Running((x, y), speed, time) for x, y, speed, time in seen[np.sort(first)].tolist())


def _seen(walk: Walk, start: float, end: float, run_from: float) -> FloatArray:
    """x, y, m, speed, m/s, and time, s, of the fastest handle in each square, (n, 4), fastest first."""
    most = max(MOST_LOOKS // (len(walk.dragon) + 1), 2)
    times = np.linspace(start, end, min(math.ceil((end - start) / STEP) + 1, most))
    rows = np.empty((0, 4))
    for motion in walk.motions(times):
        time, handle = np.nonzero(motion.speed >= run_from)
        columns = (motion.x, motion.y, motion.speed)
        found = (*(column[time, handle] for column in columns), motion.times[time])
        rows = np.concatenate([rows, np.column_stack(found)])
        rows = rows[np.argsort(-rows[:, 2], kind="stable")]
        _squares, first = np.unique(np.floor(rows[:, :2] / SQUARE), axis=0, return_index=True)
        rows = rows[np.sort(first)]
    return rows
