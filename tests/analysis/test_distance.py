import json
import math
from pathlib import Path

import numpy as np
import pytest
import shapely

from benchdragon import Dragon, InputError, Line, Route, Spiral, Walk, WalkError
from benchdragon.analysis.contact_search import ContactSearch
from benchdragon.analysis.distance import (
    Nearness,
    boxes,
    clearances,
    low_point,
    nearest_each,
    nearness,
    pair_distances,
    pairs_within,
    tightest_pairs,
)
from benchdragon.kernels import box
from benchdragon.kernels.box import corner
from benchdragon.kernels.contact_memory import ContactGoal, ContactTold
from benchdragon.kernels.curve import FloatArray
from benchdragon.plans.schema import read_plan
from benchdragon.progress import silent

TRUTH = json.loads((Path(__file__).parents[1] / "truth" / "contest.json").read_text("utf-8"))
SPIRAL, TURN = read_plan("spiral-in").build(), read_plan("turn").build()


def by_shapely(walk: Walk, t: float) -> list[tuple[float, int, int]]:
    """Distances of all pairs that are not neighbours, smallest first, by another method."""
    table = boxes(walk.motion([t]), 0)
    shapes = [shapely.Polygon([corner(table, i, k) for k in range(4)]) for i in range(len(table))]
    return sorted(
        (shapes[i].distance(shapes[j]), i + 1, j + 1)
        for i in range(len(shapes))
        for j in range(i + 2, len(shapes))
    )


@pytest.mark.parametrize(("walk", "t"), [(SPIRAL, 0.0), (SPIRAL, 400.0), (TURN, 14.0), (TURN, 30.15)])
def test_the_tightest_pairs_are_those_of_shapely(walk: Walk, t: float) -> None:
    expected = by_shapely(walk, t)[:30]
    found = tightest_pairs(walk.motion([t]), count=30)
    assert [pair.distance for pair in found] == pytest.approx([row[0] for row in expected], abs=1e-12)
    assert found[0].benches == expected[0][1:]


def test_the_contests_dragon_touches_when_it_should() -> None:
    moment = float(TRUTH["first_contact_s"])
    before, at, after = tightest_pairs_at(SPIRAL, [moment - 1e-6, moment, moment + 1e-6])
    assert before.distance > 1e-8
    assert at.distance == pytest.approx(0.0, abs=1e-12)
    assert after.distance < -1e-8
    assert before.benches == at.benches == after.benches == (1, 9)
    # The head's front outer corner meets the inner side of bench 9.
    assert before.features == ((1, "front left"), (9, "right"))
    assert before.points[0] == pytest.approx(before.points[1], abs=1e-6)


def tightest_pairs_at(walk: Walk, times: list[float]) -> list[Nearness]:
    """The tightest pair at each time."""
    motion = walk.motion(times)
    return [tightest_pairs(motion, i)[0] for i in range(len(times))]


def test_the_papers_turn_is_tightest_between_benches_1_and_17() -> None:
    pair = tightest_pairs(TURN.motion([30.15]))[0]
    assert pair.benches == (1, 17)
    assert pair.gap == pytest.approx(0.2791, abs=1e-4)


def test_clearances_fall_as_the_dragon_coils_in() -> None:
    found = clearances(SPIRAL.motion([0.0, 200.0, 400.0, 412.6]))
    assert (np.diff(found) < 0.0).all()
    assert found[0] > 0.1
    assert found[-1] < 0.0


def test_a_dragon_of_two_benches_has_no_pair_that_counts() -> None:
    walk = Walk(Dragon.uniform(2), Route((Line(10.0),)))
    assert tightest_pairs(walk.motion([0.0])) == []
    assert clearances(walk.motion([0.0, 1.0])).tolist() == [math.inf, math.inf]


def test_on_a_line_every_second_bench_is_one_bench_apart() -> None:
    walk = Walk(Dragon.uniform(6, head_length=2.2), Route((Line(10.0),)))
    pairs = tightest_pairs(walk.motion([0.0]), count=100)
    assert len(pairs) == 10
    assert [pair.benches for pair in pairs[:4]] == [(1, 3), (2, 4), (3, 5), (4, 6)]
    # Two links less the insets between: 2 * 1.65 - 2.2.
    assert [pair.distance for pair in pairs[:4]] == pytest.approx([1.1] * 4)
    assert pairs[-1].benches == (1, 6)


def test_points_and_features_lie_where_they_say() -> None:
    motion = TURN.motion([25.0])
    table = boxes(motion, 0)
    for pair in tightest_pairs(motion, count=50):
        (ax, ay), (bx, by) = pair.points
        assert math.hypot(ax - bx, ay - by) == pytest.approx(pair.distance, abs=1e-12)
        rows = [bench - 1 for bench in pair.benches]
        shapes = [shapely.Polygon([corner(table, i, k) for k in range(4)]) for i in rows]
        for shape, point in zip(shapes, pair.points, strict=True):
            assert shape.boundary.distance(shapely.Point(point)) == pytest.approx(0.0, abs=1e-12)
        again = nearness(table, pair.benches[1] - 1, pair.benches[0] - 1)
        assert again.benches == pair.benches
        assert again.distance == pytest.approx(pair.distance, abs=1e-14)


def test_the_broad_phase_misses_no_pair() -> None:
    rng = np.random.default_rng(3)
    dragon = Dragon.of_sizes(rng.uniform(0.8, 4.0, 60), rng.uniform(0.1, 0.5, 60), 0.2, 0.1)
    walk = Walk(dragon, Route((Spiral(0.9, 40.0, 5.0),)))
    table = boxes(walk.motion([5.0]), 0)
    near = {(i, j) for d, i, j in by_shapely(walk, 5.0) if d <= 0.5}
    first, second = pairs_within(table, 0.5)
    assert near <= set(zip((first + 1).tolist(), (second + 1).tolist(), strict=True))


def by_brute_force(table: FloatArray, reach: float) -> tuple[FloatArray, FloatArray]:
    """All distances of pairs that count, and each bench's least one within reach."""
    count = len(table)
    apart = np.full((count, count), math.inf)
    first, second = np.triu_indices(count, 2)
    gap, distance = np.empty(len(first)), np.empty(len(first))
    box.pair_distances(table, first, second, gap, distance)
    apart[first, second] = apart[second, first] = distance
    least = apart.min(axis=1)
    return apart, np.where(least <= reach, least, math.inf)


@pytest.mark.parametrize(
    ("walk", "times"), [(SPIRAL, [0.0, 390.0, 412.6]), (TURN, [-50.0, 14.0, 30.15, 120.0])]
)
@pytest.mark.parametrize("reach", [0.3, 1.0])
def test_each_bench_finds_its_nearest(walk: Walk, times: list[float], reach: float) -> None:
    motion = walk.motion(times)
    distance, partner = nearest_each(motion, reach)
    assert distance.shape == partner.shape == (len(times), len(walk.dragon))
    for t in range(len(times)):
        apart, least = by_brute_force(boxes(motion, t), reach)
        np.testing.assert_array_equal(distance[t], least)
        near = np.flatnonzero(partner[t])
        np.testing.assert_array_equal(near, np.flatnonzero(np.isfinite(least)))
        np.testing.assert_array_equal(apart[near, partner[t, near] - 1], least[near])


def test_uneven_benches_find_their_nearest() -> None:
    rng = np.random.default_rng(5)
    dragon = Dragon.of_sizes(rng.uniform(0.8, 4.0, 60), rng.uniform(0.1, 0.9, 60), 0.2, 0.1)
    motion = Walk(dragon, Route((Spiral(0.9, 40.0, 5.0),))).motion([0.0, 20.0])
    distance, _partner = nearest_each(motion)
    assert distance.min() < 0.0
    for t in range(2):
        least = by_brute_force(boxes(motion, t), 1.0)[1]
        np.testing.assert_array_equal(distance[t], least)


def test_benches_that_are_near_in_a_straight_line_are_left_out() -> None:
    rng = np.random.default_rng(6)
    dragon = Dragon.of_sizes(rng.uniform(0.8, 4.0, 60), rng.uniform(0.1, 0.9, 60), 0.2, 0.1)
    line = boxes(Walk(dragon, Route((Line(200.0),))).placement([190.0]), 0)
    lined = by_brute_force(line, 0.0)[0]
    motion = Walk(dragon, Route((Spiral(0.9, 40.0, 5.0),))).motion([0.0, 20.0])
    for straight in (0.5, 2.0, 6.0):
        distance, partner = nearest_each(motion, 1.0, straight)
        for t in range(2):
            apart = by_brute_force(boxes(motion, t), 1.0)[0]
            least = np.where(lined > straight, apart, math.inf).min(axis=1)
            np.testing.assert_array_equal(distance[t], np.where(least <= 1.0, least, math.inf))
            near = np.flatnonzero(partner[t])
            np.testing.assert_array_equal(apart[near, partner[t, near] - 1], least[near])
    assert (nearest_each(motion, 1.0, 6.0)[0] > nearest_each(motion, 1.0)[0]).any()


def test_who_does_not_stand_has_no_nearest() -> None:
    distance, partner = nearest_each(SPIRAL.motion([0.0, 900.0], throw=False))
    assert np.isfinite(distance[0]).all()
    assert np.isnan(distance[1]).all()
    assert not partner[1].any()
    with pytest.raises(InputError, match="reach must not be negative"):
        nearest_each(SPIRAL.motion([0.0]), -1.0)


def test_two_benches_have_no_others() -> None:
    distance, partner = nearest_each(Walk(Dragon.uniform(2), Route((Line(10.0),))).motion([0.0]))
    assert np.isposinf(distance).all()
    assert not partner.any()


def low_pair(walk: Walk, first: float, last: float) -> tuple[float, float, int, int]:
    """A low distance seen with the head between first and last, m, 0 at least; where, and of which."""
    with ContactSearch(Walk(walk.dragon, walk.route), first, last, 0.0, silent) as search:
        search.find(ContactGoal.SEEN)
        distance, where, i, j = search.figures[
            [ContactTold.BEST, ContactTold.WHERE, ContactTold.FIRST_BENCH, ContactTold.SECOND_BENCH]
        ].tolist()
    return distance, where, int(i), int(j)


@pytest.mark.parametrize("walk", [SPIRAL, TURN])
def test_a_low_pair_is_as_near_as_it_says_and_no_sample_is_much_nearer(walk: Walk) -> None:
    first, last = 150.0, 400.0
    distance, where, i, j = low_pair(walk, first, last)
    still = Walk(walk.dragon, walk.route)
    motion = still.motion([where])
    assert first <= where <= last
    assert pair_distances(motion, i, j)[0] == pytest.approx(distance, abs=1e-12)
    assert distance == pytest.approx(clearances(motion)[0], abs=1e-12)
    assert distance <= clearances(still.motion(np.linspace(first, last, 128))).min()


def test_a_low_pair_is_sought_where_the_dragon_stands() -> None:
    length = SPIRAL.route.length
    assert low_pair(SPIRAL, 400.0, length + 500.0)[0] == 0.0
    with pytest.raises(WalkError, match="past the end"):
        low_pair(SPIRAL, length + 1.0, length + 2.0)
    assert low_pair(SPIRAL, 100.0, 100.0)[0] == pytest.approx(clearances(SPIRAL.motion([100.0]))[0])


def test_a_pairs_low_point_is_that_of_dense_samples() -> None:
    least, where = low_point(TURN, 0, 16, 135.0, 165.0)
    still = Walk(TURN.dragon, TURN.route)
    dense = pair_distances(still.motion(np.linspace(135.0, 165.0, 3001)), 0, 16)
    assert dense.min() - 1e-3 < least <= dense.min()
    assert pair_distances(still.motion([where]), 0, 16)[0] == pytest.approx(least, abs=1e-12)
    assert low_point(TURN, 0, 16, 1e7, 2e7)[0] == math.inf


def test_wrong_counts_and_failed_times_are_refused() -> None:
    with pytest.raises(InputError, match="count must be a whole number from 1 to 100000, not 0"):
        tightest_pairs(SPIRAL.motion([0.0]), count=0)
    with pytest.raises(WalkError, match="past the end of the route"):
        clearances(SPIRAL.motion([900.0], throw=False))
