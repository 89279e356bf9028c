"""A dragon beside its route: places by SciPy on the parallel curve, links as long as ever."""

import numpy as np
import pytest
from scipy.optimize import brentq

from benchdragon.clearance import boxes
from benchdragon.curves import Arc, Clothoid, Line, Route, Spiral
from benchdragon.dragon import Dragon
from benchdragon.kernels.box import box_distance, least_distance
from benchdragon.kernels.sway import sway, table_at
from benchdragon.motion import Walk
from tests.kernels.second_road import Complex, Float, points

ROUTES = {
    "spiral": Route((Spiral.between(0.9, 9.0, 3.0),)),
    "arcs": Route.joined([Line(40.0), Arc(6.0, 2.0), Arc(5.0, -1.5), Line(10.0)]),
    "clothoids": Route.joined([Line(30.0), Clothoid(9.0, 0.0, 0.2), Clothoid(9.0, 0.2, -0.1)]),
}


def swayed(walk: Walk, s: float, aside: Float, lane: list[float]) -> Complex:
    motion = walk.motion([s])
    at = np.ascontiguousarray(motion.s.T)
    x, y = np.empty(at.shape), np.empty(at.shape)
    sway(walk.route.rows, walk.dragon.links, at, s, aside, np.array(lane), 30.0, x, y)
    return np.asarray(x[:, 0] + 1j * y[:, 0])


@pytest.mark.parametrize("name", ROUTES)
def test_handles_stand_aside_of_the_route_and_links_keep_their_lengths(name: str) -> None:
    route = ROUTES[name]
    walk = Walk(Dragon.uniform(9, head_length=2.4), route)
    aside = 0.02 * np.random.default_rng(7).standard_normal(10)
    s = route.length - 1.0
    found = swayed(walk, s, aside, [0.0, 0.0])
    assert np.abs(np.diff(found)) == pytest.approx(walk.dragon.links, abs=1e-9)
    # Each lies on the curve parallel to the route by its own offset: the nearest place tells.
    for i, place in enumerate(found):
        at = float(walk.motion([s]).s[0, i])
        near = np.linspace(at - 0.5, at + 0.5, 4001)
        reach = np.abs(points(route, near) - place)
        # The route is followed by its curvature: to third order in a few centimetres.
        assert reach.min() == pytest.approx(abs(aside[i]), abs=2e-5)


def test_a_straight_line_is_solved_by_hand() -> None:
    walk = Walk(Dragon.uniform(1, tail_length=2.2, head_length=2.2), Route((Line(10.0),)))
    found = swayed(walk, 5.0, np.array([0.3, -0.2]), [0.0, 0.0])
    along = np.sqrt(1.65**2 - 0.5**2)
    assert found == pytest.approx(np.array([5.0 + 0.3j, 5.0 - along - 0.2j]), abs=1e-9)


def test_a_lane_that_slopes_is_solved_by_hand() -> None:
    """The line lies 0.01 m aside for each metre behind the head: handles stand on a slanted line."""
    walk = Walk(Dragon.uniform(1, tail_length=2.2, head_length=2.2), Route((Line(10.0),)))
    found = swayed(walk, 5.0, np.zeros(2), [0.0, 0.3])

    def excess(back: float) -> float:
        return float(np.hypot(back, 0.01 * back)) - 1.65

    back = brentq(excess, 1.0, 2.0)
    assert found[1] == pytest.approx(5.0 - back + 0.01j * back, abs=1e-9)


def test_a_table_is_linear_between_its_entries_and_level_outside() -> None:
    table = np.array([1.0, 3.0, 2.0])
    assert table_at(table, 0.5, -0.1) == (1.0, 0.0)
    assert table_at(table, 0.5, 0.25) == (2.0, -4.0)
    assert table_at(table, 0.5, 0.75) == (2.5, 2.0)
    assert table_at(table, 0.5, 1.0) == (2.0, 0.0)
    assert table_at(table, 0.5, 9.0) == (2.0, 0.0)


def test_the_least_distance_is_that_of_all_pairs_at_all_times() -> None:
    walk = Walk(Dragon.uniform(60), Route((Spiral.between(0.6, 6.0, 2.6),)))
    motion = walk.motion([0.0, 55.0, walk.route.length])
    for count in (1, 2, 3):
        x, y = (np.ascontiguousarray(table[:count].T) for table in (motion.x, motion.y))
        found = least_distance(walk.dragon.sizes, x, y)
        tables = [boxes(motion, t) for t in range(count)]
        assert found == min(
            box_distance(table, i, j) for table in tables for j in range(2, 60) for i in range(j - 1)
        )
