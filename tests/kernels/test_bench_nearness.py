"""Who is nearest to each bench over times, and on which side."""

import math

import numpy as np
import pytest

from benchdragon.analysis.distance import nearest_each as distance_each
from benchdragon.kernels.bench_nearness import NEAR_COLUMNS, NearSide, nearest_side, see_near
from benchdragon.kernels.box import BOX_COLUMNS, boxes_at, nearest_each, pair_distances
from benchdragon.plans.schema import read_plan
from tests.kernels.test_box import wandering


def test_the_first_of_the_nearest_moments_is_told_and_times_without_a_dragon_are_left_out() -> None:
    walk = read_plan("spiral-in", ["dragon.benches=24", "walk.start=360"]).build()
    motion = walk.motion([360.0, 380.0, 400.0, 400.0, 470.0], throw=False)
    assert motion.status.tolist()[:4] == [0] * 4
    assert motion.status[4] != 0
    near, least = np.tile([math.inf, 0.0, 0.0], (24, 1)), np.empty(5)
    x, y = (np.ascontiguousarray(table.T) for table in (motion.x, motion.y))
    see_near(walk.dragon.sizes, x, y, motion.times, 1.0, near, least)
    assert near.shape[1] == NEAR_COLUMNS
    distance, partner = distance_each(motion, 1.0)
    assert least[:4].tolist() == np.minimum(distance[:4].min(axis=1), 1.0).tolist()
    assert math.isnan(least[4])
    first = distance[:4].argmin(axis=0)
    seen = [distance[first[k], k] for k in range(24)]
    assert near[:, 0].tolist() == seen
    found = np.isfinite(near[:, 0])
    assert found.sum() > 10
    assert near[found, 1].tolist() == motion.times[first][found].tolist()
    assert near[found, 2].tolist() == partner[first, range(24)][found].tolist()
    assert not near[~found, 1:].any()


@pytest.mark.parametrize("seed", range(6))
def test_no_pair_is_missed_however_the_chain_winds(seed: int) -> None:
    sizes, x, y = wandering(seed, 40, 6)
    reach, boxes = 0.8, np.empty((40, BOX_COLUMNS))
    near, least = np.tile([math.inf, 0.0, 0.0], (40, 1)), np.empty(6)
    see_near(sizes, x, y, np.arange(6.0), reach, near, least)
    assert math.isnan(least[0])
    first, second = np.triu_indices(40, 2)
    expected, gap, apart = np.full(40, math.inf), np.empty(len(first)), np.empty(len(first))
    distance, partner = np.empty((6, 40)), np.empty((6, 40), dtype=np.int64)
    for t in range(1, 6):
        boxes_at(sizes, x, y, t, boxes)
        pair_distances(boxes, first, second, gap, apart)
        assert least[t] == min(apart.min(), reach)
        apart[apart > reach] = math.inf
        each = np.full(40, math.inf)
        np.minimum.at(each, first, apart)
        np.minimum.at(each, second, apart)
        nearest_each(sizes, x, y, t, reach, -math.inf, distance, partner)
        assert distance[t].tolist() == each.tolist()
        expected = np.minimum(expected, each)
    assert near[:, 0].tolist() == expected.tolist()


@pytest.mark.parametrize(
    ("x", "y", "turned", "side"),
    [
        (0.0, 1.0, 0.0, NearSide.ON_LEFT), (0.0, -1.0, 0.0, NearSide.ON_RIGHT), (3.0, 0.0, 0.0,
        NearSide.AT_FRONT),
        (-3.0, 0.1, 0.0, NearSide.AT_REAR), (0.5, 2.0, 0.5 * math.pi, NearSide.ON_LEFT), (3.0, 0.0,
        0.5, NearSide.AT_FRONT),
        (0.0, 0.3, 0.0, NearSide.ON_LEFT),
    ],
)  # fmt: skip
def test_the_nearest_point_of_another_bench_says_the_side(
    x: float, y: float, turned: float, side: int
) -> None:
    boxes = np.array(
        [[0.0, 0.0, 1.0, 0.0, 1.0, 0.15], [x, y, math.cos(turned), math.sin(turned), 1.0, 0.2]]
    )
    assert nearest_side(boxes) == side
