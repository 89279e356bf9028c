"""The hash grid against all pairs looked at one by one."""

import itertools
import math

import numpy as np
import pytest

from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.grid import filled_grid, gather, pairs_near


def places(seed: int, count: int, wide: float) -> FloatArray:
    """Random places about the origin, some of them the same."""
    rng = np.random.default_rng(seed)
    found = rng.uniform(-wide, wide, (count, 2))
    found[count // 2] = found[0]
    return found


SIDES, REACHES = (0.2, 1.0, 30.0), (0.0, 0.3, 2.5, 40.0)
# So many small squares take long without compiling.
MANY = pytest.param(0.2, 40.0, marks=pytest.mark.compiled)
SOME = [case for case in itertools.product(SIDES, REACHES) if case != MANY.values]


@pytest.mark.parametrize(("side", "reach"), [*SOME, MANY])
def test_the_pairs_within_reach_are_those_of_brute_force(side: float, reach: float) -> None:
    some, others = places(1, 60, 8.0), places(2, 50, 9.0)
    others[7], others[11] = some[3], math.nan
    some[5] = math.nan
    first, second = pairs_near(filled_grid(others, side), others, some, 4, reach)
    apart = np.hypot(*(some[:, np.newaxis] - others).transpose(2, 0, 1))
    wanted = [(i, j) for i, j in np.argwhere(apart <= reach).tolist() if i >= 4]
    assert sorted(zip(first.tolist(), second.tolist(), strict=True)) == wanted
    assert len(wanted) > 0 or reach < 0.3


def test_more_pairs_than_there_was_room_for_are_all_found() -> None:
    here = np.zeros((200, 2))
    first, second = pairs_near(filled_grid(here, 1.0), here, here, 0, 0.0)
    assert len(set(zip(first.tolist(), second.tolist(), strict=True))) == len(first) == 200 * 200


def test_a_place_whose_squares_share_a_bucket_is_found_once() -> None:
    here = np.array([[0.5, 0.5]])
    grid, found = filled_grid(here, 1e-3), np.empty(1, dtype=np.int64)
    assert gather(grid, 0.5, 0.5, 0.2, found) == 1  # 160,000 squares in 16 buckets
