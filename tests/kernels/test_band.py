"""Strays of benches from a straight way, and turnings of routes: bounds that hold in between."""

import math

import numpy as np
import pytest

from benchdragon.kernels.band import strays, turnings
from benchdragon.kernels.box import BOX_COLUMNS, boxes_at, corner
from benchdragon.kernels.chain import Placements, empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.step_bounds import place_chain
from benchdragon.model.curves import Arc, Clothoid, Line, Route, Spiral

SIZES = np.array([[2.2], [0.3], [0.275], [0.275]])
LINK = SIZES[0] - SIZES[2] - SIZES[3]
ROUTES = {
    "line": (Route((Line(30.0),)), 10.0),
    "arc": (Route((Line(5.0), Arc(4.0, 3.0, (5.0, 0.0)))), 12.0),
    "clothoid": (Route.joined((Line(5.0), Clothoid(9.0, 0.0, 0.3))), 8.0),
    "spiral": (Route((Spiral(1.0, 40.0, 20.0),)), 9.0),
    "kink": (Route((Line(9.0), Line(9.0, (9.0, 0.0), 0.3)), kinks=True), 9.5),
}


def placed(route: Route, at: FloatArray) -> Placements:
    places = empty_placements(2, len(at))
    assert place_chain(route.rows, LINK, at, 0, len(at), places)
    return places


def corners(places: Placements, t: int) -> FloatArray:
    table = np.empty((1, BOX_COLUMNS))
    boxes_at(SIZES, places.x, places.y, t, table)
    return np.array([corner(table, 0, k) for k in range(4)])


@pytest.mark.parametrize("name", ROUTES)
@pytest.mark.parametrize("step", [0.01, 0.3, 1.0])
def test_no_corner_strays_farther_than_is_said(name: str, step: float) -> None:
    route, start = ROUTES[name]
    at, out = np.array([start, start + step]), np.empty(1)
    ends = placed(route, at)
    strays(route.rows, LINK, SIZES, 0, ends, out)
    first, last = corners(ends, 0), corners(ends, 1)
    between = placed(route, np.linspace(start, start + step, 41))
    straight = [first + share * (last - first) for share in np.linspace(0.0, 1.0, 41)]
    off = [np.hypot(*(corners(between, t) - straight[t]).T).max() for t in range(41)]
    assert max(off) <= out[0] + 1e-12
    assert out[0] <= 0.5 * 3.0 * step


def test_a_bench_that_stays_strays_nowhere_and_one_that_may_leap_anywhere() -> None:
    route, out = Route((Spiral(0.55, 30.0, 0.0),)), np.empty(2)
    end = route.length
    at = np.array([3.0, 3.0, end - 12.0, end - 0.3])
    places = empty_placements(2, 4)
    place_chain(route.rows, LINK, at, 0, 4, places)
    strays(route.rows, LINK, SIZES, 0, places, out)
    assert out.tolist() == [0.0, math.inf]


def test_turnings_are_the_angles_that_a_route_turns_by() -> None:
    route = Route(
        (
            Line(5.0),
            Arc(4.0, 1.0, (5.0, 0.0)),
            Arc(2.0, -1.0, (5.0, 0.0)).moved(*Arc(4.0, 1.0, (5.0, 0.0)).end_pose),
        )
    )
    borders, out = np.array([0.0, 4.0, 7.0, 9.0, 11.0]), np.empty(4)
    turnings(route.rows, borders, out)
    assert out == pytest.approx([0.0, 0.5, 0.5, 1.0], abs=1e-12)
