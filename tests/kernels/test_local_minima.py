"""Low distances along a walk, against dense samples, and where the head is when the tail comes by."""

import math

import numpy as np
import pytest

from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.chain import Placements, empty_placements
from benchdragon.kernels.local_minima import SHRINKS, head_where_tail, local_minimum, low_pair
from benchdragon.model.curves import Spiral
from benchdragon.model.dragon import Dragon
from benchdragon.model.turns import TwoArcTurn
from benchdragon.model.walk import Walk

Scratch = tuple[np.ndarray, Placements, np.ndarray]
WALK = Walk(Dragon.uniform(9, 2.0), TwoArcTurn(1.7).route(lead=25.0, trail=60.0))
ROWS, LINKS, SIZES = WALK.route.rows, WALK.dragon.links, WALK.dragon.sizes


def scratch(slots: int) -> Scratch:
    return np.empty(slots), empty_placements(len(LINKS) + 1, slots), np.empty((2, BOX_COLUMNS))


@pytest.fixture(scope="module")
def dense() -> tuple[np.ndarray, dict[tuple[int, int], np.ndarray]]:
    """Head positions, and the distances there of some pairs."""
    from benchdragon.analysis.distance import pair_distances

    at = np.linspace(20.0, 60.0, 801)
    placed = WALK.placement(at)
    pairs = [(i, j) for i in range(9) for j in range(i + 2, 9)]
    return at, {pair: pair_distances(placed, *pair) for pair in pairs}


@pytest.mark.parametrize("slots", [4, 7, 32])
def test_a_pairs_low_point_is_no_higher_than_near_samples(
    dense: tuple[np.ndarray, dict[tuple[int, int], np.ndarray]], slots: int
) -> None:
    at, pairs = dense
    for i, j in ((0, 5), (0, 7), (2, 8)):
        n = int(np.argmin(pairs[i, j]))
        low, high = at[n] - 0.4, at[n] + 0.4
        least, where = local_minimum(ROWS, LINKS, SIZES, i, j, low, high, SHRINKS, *scratch(slots))
        assert least <= pairs[i, j][n] + 1e-12
        assert least >= pairs[i, j][n] - 1e-3
        fine = local_minimum(ROWS, LINKS, SIZES, i, j, low, high, SHRINKS, *scratch(64))[0]
        assert least == pytest.approx(fine, abs=1e-12)
        assert low <= where <= high


def test_a_low_pair_is_hardly_higher_than_the_least_of_dense_samples(
    dense: tuple[np.ndarray, dict[tuple[int, int], np.ndarray]],
) -> None:
    at, pairs = dense
    pair, least = min(((pair, float(far.min())) for pair, far in pairs.items()), key=lambda one: one[1])
    for slots in (5, 32):
        found, where, i, j = low_pair(ROWS, LINKS, SIZES, at[0], at[-1], *scratch(slots))
        assert (i, j) == pair
        assert found == pytest.approx(least, abs=1e-3)
        assert at[0] <= where <= at[-1]


def test_nothing_is_low_where_the_dragon_stands_nowhere_or_no_pair_counts() -> None:
    beyond = WALK.route.length + 1.0
    assert local_minimum(ROWS, LINKS, SIZES, 0, 5, beyond, beyond + 1.0, 3, *scratch(4))[0] == math.inf
    assert low_pair(ROWS, LINKS, SIZES, beyond, beyond + 1.0, *scratch(64))[0] == math.inf
    assert local_minimum(ROWS, LINKS, SIZES, 0, 5, 30.0, 30.0, 3, *scratch(4)) == (math.inf, 30.0)
    two = Walk(Dragon.uniform(2), WALK.route)
    room = np.empty(64), empty_placements(3, 64), np.empty((2, BOX_COLUMNS))
    assert low_pair(ROWS, two.dragon.links, two.dragon.sizes, 20.0, 30.0, *room)[0] == math.inf


@pytest.mark.parametrize("where", [26.0, 35.7, 60.0])
def test_the_head_is_where_the_tail_has_just_come_to_a_place(where: float) -> None:
    at, places, _boxes = scratch(1)
    head = head_where_tail(ROWS, LINKS, where, at, places)
    before, there = WALK.placement([head - 2e-9, head]).s[:, -1]
    assert before < where <= there + 1e-12


def test_a_tail_that_never_comes_there_leaves_the_head_at_the_end() -> None:
    at, places, _boxes = scratch(1)
    length = WALK.route.length
    assert head_where_tail(ROWS, LINKS, length - 3.0, at, places) == length
    narrow = Walk(Dragon.uniform(9, 2.0), WALK.route.__class__((Spiral(0.5, 60.0, 1.0),)))
    rows, length = narrow.route.rows, narrow.route.length
    assert head_where_tail(rows, LINKS, length - 0.1, at, places) == length
