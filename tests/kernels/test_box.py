import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from benchdragon.kernels.box import (
    BOX_COLUMNS,
    box_distance,
    box_gap,
    boxes_at,
    corner,
    corner_distance,
    nearest_corner,
    nearest_each,
    nearest_pair,
    pair_distances,
)
from benchdragon.kernels.curve import FloatArray


def table(*rows: tuple[float, float, float, float, float]) -> FloatArray:
    """Boxes from (x, y, heading, length, width)."""
    return np.array(
        [[x, y, math.cos(a), math.sin(a), 0.5 * length, 0.5 * width] for x, y, a, length, width in rows]
    )


def polygon(boxes: FloatArray, i: int) -> shapely.Polygon:
    """The same box as shapely sees it."""
    return shapely.Polygon([corner(boxes, i, k) for k in range(4)])


PLACE = st.floats(-3.0, 3.0)
SIZE = st.floats(0.05, 4.0)
BOX = st.tuples(PLACE, PLACE, st.floats(-10.0, 10.0), SIZE, SIZE)


@given(BOX, BOX)
def test_distance_and_overlap_agree_with_shapely(
    a: tuple[float, float, float, float, float], b: tuple[float, float, float, float, float]
) -> None:
    boxes = table(a, b)
    first, second = polygon(boxes, 0), polygon(boxes, 1)
    gap, distance = box_gap(boxes, 0, 1), box_distance(boxes, 0, 1)
    assert gap <= distance + 1e-14
    assert max(distance, 0.0) == pytest.approx(first.distance(second), abs=1e-13)
    assert (gap < -1e-12) <= (first.intersection(second).area > 0.0)
    assert (gap > 1e-12) <= first.disjoint(second)


@given(BOX, BOX)
def test_the_order_of_two_boxes_does_not_matter(
    a: tuple[float, float, float, float, float], b: tuple[float, float, float, float, float]
) -> None:
    boxes = table(a, b)
    assert box_gap(boxes, 0, 1) == pytest.approx(box_gap(boxes, 1, 0), abs=1e-14)
    assert box_distance(boxes, 0, 1) == pytest.approx(box_distance(boxes, 1, 0), abs=1e-14)


@given(BOX, BOX)
def test_the_nearest_corner_is_as_near_as_the_boxes_when_apart(
    a: tuple[float, float, float, float, float], b: tuple[float, float, float, float, float]
) -> None:
    boxes = table(a, b)
    mine, which = nearest_corner(boxes, 0, 1)
    apart = corner_distance(boxes, 0, which, 1) if mine else corner_distance(boxes, 1, which, 0)
    if box_gap(boxes, 0, 1) > 0.0:
        assert apart == pytest.approx(box_distance(boxes, 0, 1), abs=1e-14)


@pytest.mark.parametrize("turn", [0.0, 0.5 * math.pi, math.pi, 0.3])
@pytest.mark.parametrize("hair", [1e-12, -1e-12, 1e-9, -1e-9, 1e-15, -1e-15, 0.0])
def test_boxes_a_hair_apart_or_inside_one_another_agree_with_shapely(turn: float, hair: float) -> None:
    rng = np.random.default_rng(1)
    for slide in rng.uniform(-1.0, 1.0, 20):
        # How far the second box reaches down, and where along the first its lowest corner lies.
        low = 1.1 * abs(math.sin(turn)) + 0.15 * abs(math.cos(turn))
        foot = 1.1 * math.cos(0.3) - 0.15 * math.sin(0.3) if turn == 0.3 else 0.0
        boxes = table((0.0, 0.0, 0.3, 2.2, 0.3), (0.0, 0.0, 0.3 + turn, 2.2, 0.3))
        along, across = slide + foot, 0.15 + low + hair
        boxes[1, 0] = along * math.cos(0.3) - across * math.sin(0.3)
        boxes[1, 1] = along * math.sin(0.3) + across * math.cos(0.3)
        assert box_gap(boxes, 0, 1) == pytest.approx(hair, abs=2e-15)
        expected = polygon(boxes, 0).distance(polygon(boxes, 1))
        assert max(box_distance(boxes, 0, 1), 0.0) == pytest.approx(expected, abs=2e-15)


def test_the_gap_is_the_depth_of_an_overlap_and_falls_short_of_a_diagonal_distance() -> None:
    boxes = table((0.0, 0.0, 0.0, 2.0, 1.0), (0.0, 0.9, 0.0, 2.0, 1.0), (5.0, 5.0, 0.0, 2.0, 1.0))
    assert box_gap(boxes, 0, 1) == pytest.approx(-0.1)
    assert box_distance(boxes, 0, 1) == pytest.approx(-0.1)
    assert box_gap(boxes, 0, 2) == pytest.approx(4.0)
    assert box_distance(boxes, 0, 2) == pytest.approx(5.0)


def test_crossed_boxes_overlap_though_no_corner_lies_inside() -> None:
    boxes = table((0.0, 0.0, 0.0, 4.0, 0.2), (0.0, 0.0, 0.5 * math.pi, 4.0, 0.2))
    assert box_gap(boxes, 0, 1) == pytest.approx(0.1 - 2.0 - 0.2)
    assert box_gap(boxes, 0, 1) < 0.0


def test_boxes_come_from_handles_and_sizes() -> None:
    sizes = np.array([[3.41, 2.2], [0.3, 0.4], [0.275, 0.1], [0.275, 0.5]])
    x, y = np.array([[0.0], [-2.86], [-2.86]]), np.array([[0.0], [0.0], [1.6]])
    boxes = np.empty((2, BOX_COLUMNS))
    boxes_at(sizes, x, y, 0, boxes)
    assert boxes[0] == pytest.approx([0.275 - 1.705, 0.0, 1.0, 0.0, 1.705, 0.15])
    assert boxes[1] == pytest.approx([-2.86, -0.1 + 1.1, 0.0, -1.0, 1.1, 0.2])
    assert corner(boxes, 0, 0) == pytest.approx((0.275, 0.15))
    assert corner(boxes, 0, 2) == pytest.approx((0.275 - 3.41, -0.15))
    gap, distance = np.empty(1), np.empty(1)
    pair_distances(boxes, np.array([0]), np.array([1]), gap, distance)
    assert gap[0] == distance[0] == pytest.approx(-0.25, abs=1e-15)


def test_nearest_each_sees_overlaps_and_leaves_out_neighbours() -> None:
    """Four benches of 1 m along a line folded back upon itself, the last on top of the first."""
    sizes = np.array([[1.0] * 4, [0.2] * 4, [0.0] * 4, [0.0] * 4])
    x = np.array([[0.0, 0.0], [-1.0, -1.0], [-2.0, -2.0], [-1.0, -3.0], [0.0, -4.0]])
    y = np.zeros_like(x)
    distance, partner = np.full((2, 4), np.nan), np.zeros((2, 4), dtype=np.int64)
    for t in range(2):
        nearest_each(sizes, x, y, t, 1.0, -math.inf, distance, partner)
    assert distance[0] == pytest.approx([-0.2, 0.0, 0.0, -0.2])
    assert partner[0].tolist() == [3, 3, 0, 0]
    assert distance[1] == pytest.approx([1.0, 1.0, 1.0, 1.0])
    assert partner[1].tolist() == [2, 3, 0, 1]


def test_nearest_each_leaves_out_those_that_are_near_in_a_straight_line_too() -> None:
    """Benches of many insets, folded up; in a line they end at 1, 2.4, 3.05 and 4.15, and the last two
    start at 2.05 and 2.65."""
    sizes = np.array([[1.0, 2.0, 1.0, 1.5], [0.2] * 4, [0.0, 0.5, 0.1, 0.2], [0.1, 0.25, 0.2, 0.0]])
    x = np.array([[0.0, -0.9, 0.35, -0.35, 0.95]]).T
    y = np.zeros_like(x)
    for straight, benches in [(0.2, [0, 1, 2, 3]), (1.04, [0, 2, 3]), (1.06, [0, 3]), (1.66, [])]:
        distance, partner = np.full((1, 4), np.nan), np.zeros((1, 4), dtype=np.int64)
        nearest_each(sizes, x, y, 0, 1.0, straight, distance, partner)
        assert np.flatnonzero(partner[0] >= 0).tolist() == benches
        assert np.flatnonzero(np.isfinite(distance[0])).tolist() == benches


def wandering(seed: int, benches: int, times: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Sizes of benches, some of them long, and handles of chains that bend at random, one cut short."""
    rng = np.random.default_rng(seed)
    length = np.where(rng.random(benches) < 0.1, 4.0, rng.uniform(0.8, 1.6, benches))
    sizes = np.array([length, rng.uniform(0.1, 0.4, benches), *rng.uniform(0.05, 0.2, (2, benches))])
    heading = np.cumsum(rng.normal(rng.uniform(-0.3, 0.3), 0.4, (benches, times)), axis=0)
    links = (sizes[0] - sizes[2] - sizes[3])[:, np.newaxis]
    x, y = (
        np.concatenate([np.zeros((1, times)), np.cumsum(-links * turn(heading), axis=0)])
        for turn in (np.cos, np.sin)
    )
    x[benches // 2 :, 0] = y[benches // 2 :, 0] = np.nan
    return sizes, x, y


@pytest.mark.compiled
@pytest.mark.parametrize("seed", range(8))
def test_the_nearest_pair_of_all_is_found_however_far_the_others_are(seed: int) -> None:
    sizes, x, y = wandering(seed, 60, 5)
    found, table_ = [], np.empty((60, BOX_COLUMNS))
    first, second = np.triu_indices(60, 2)
    gap, distance = np.empty(len(first)), np.empty(len(first))
    for t in range(5):
        boxes_at(sizes, x, y, t, table_)
        pair_distances(table_, second, first, gap, distance)
        told = zip(distance.tolist(), first.tolist(), second.tolist(), strict=True)
        found += [(apart, t, i, j) for apart, i, j in told]
    least = min(one for one in found if not math.isnan(one[0]))
    apart, t, i, j = least
    assert nearest_pair(sizes, x, y) == least
    assert nearest_pair(sizes, x[:, [t]].copy(), y[:, [t]].copy()) == (apart, 0, i, j)
