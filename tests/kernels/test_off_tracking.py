"""Off-tracking in plain Python: the nearest point of a route, and offsets of a few benches."""

import math

import numpy as np
import pytest

from benchdragon.kernels.chain import empty_placements, march
from benchdragon.kernels.off_tracking import OFF_COLUMNS, Off, nearest_point, see_offsets, slide
from benchdragon.kernels.status import Status
from benchdragon.model.curves import Arc, Line, Route

ROUTE = Route.joined([Line(4.0), Arc(3.0, degrees=90), Line(20.0)])


@pytest.mark.plain
@pytest.mark.parametrize("s", [-2.0, 1.0, 3.999, 5.0, 8.7, 12.0])
@pytest.mark.parametrize("offset", [-2.0, 0.4, 2.5])
def test_the_nearest_point_is_found_from_another_row(s: float, offset: float) -> None:
    heading = ROUTE.heading([s])[0]
    x, y = ROUTE.point([s])[0] + offset * np.array([-math.sin(heading), math.cos(heading)])
    for row in range(3):
        _row, _u, found = nearest_point(ROUTE.rows, row, 0.1, x, y)
        assert found == pytest.approx(offset, abs=1e-9)


@pytest.mark.plain
def test_a_way_beyond_the_route_ends_there() -> None:
    assert slide(ROUTE.rows, 2, 19.0, 5.0) == (2, 20.0)
    assert slide(ROUTE.rows, 1, 0.5, -1.0) == (0, 4.0)
    assert slide(ROUTE.rows, 0, 0.5, -1.0) == (0, -0.5)
    shut = Route((Arc(3.0, 1.0),)).rows
    assert slide(shut, 0, 0.5, -1.0) == (0, 0.0)


@pytest.mark.parametrize(("last", "status"), [(20.0, Status.OK), (40.0, Status.AFTER_ROUTE)])
def test_benches_are_seen_inside_of_the_bend(last: float, status: Status) -> None:
    links, seen = np.full(3, 1.5), np.empty((3, OFF_COLUMNS))
    places = empty_placements(4, 1)
    march(ROUTE.rows, links, np.zeros(1), 0, 1, places)
    assert see_offsets(ROUTE.rows, links, places, 0.0, last, 80, 0.3, seen) == status
    if status == Status.OK:
        assert np.all(np.diff(seen[:, Off.LEFT]) > 0.0)
        assert np.all(seen[:, Off.RIGHT] < 1e-3)
        assert np.all(seen[:, [Off.LEFT_ERROR, Off.RIGHT_ERROR]] < 1e-2)


def test_a_bench_drawn_back_over_itself_folds() -> None:
    tight = Route.joined([Line(4.0), Arc(0.7, degrees=340), Line(9.0)])
    links, seen = np.full(2, 1.6), np.empty((2, OFF_COLUMNS))
    places = empty_placements(3, 1)
    march(tight.rows, links, np.zeros(1), 0, 1, places)
    assert see_offsets(tight.rows, links, places, 0.0, 12.0, 80, 3.0, seen) == Status.FOLDED


def drawn_in(steps: int) -> np.ndarray:
    """What is seen of three benches that come ever nearer to circles of their own, farther in."""
    circle, links, seen = Route((Arc(9.0, 3.0),)), np.full(3, 1.5), np.empty((3, OFF_COLUMNS))
    places = empty_placements(4, 1)
    march(circle.rows, links, np.full(1, 7.0), 0, 1, places)
    assert see_offsets(circle.rows, links, places, 7.0, 17.0, steps, 0.3, seen) == Status.OK
    return seen


def test_steps_of_half_a_metre_are_as_good_as_order_four_makes_them() -> None:
    rough, fine = drawn_in(10), drawn_in(200)
    assert np.all(rough[:, Off.LEFT_AT] == 17.0)
    assert rough[:, Off.LEFT] == pytest.approx(fine[:, Off.LEFT], abs=2e-6)


def test_a_side_to_which_no_bench_comes_is_left_at_nothing() -> None:
    """Rounding alone would have handles on the route a little to both sides."""
    seen = drawn_in(40)
    assert np.all(seen[:, Off.LEFT] > 0.05)
    assert np.all(seen[:, [Off.RIGHT, Off.RIGHT_ERROR]] == 0.0)
    assert np.all(seen[:, Off.RIGHT_AT] == 7.0)
