"""Strays of benches from a straight way, and sides of the band that they cover: bounds in between."""

import math

import numpy as np
import pytest
import shapely

from benchdragon.kernels.box import BOX_COLUMNS, boxes_at, corner
from benchdragon.kernels.chain import Placements, empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.ground_covered import band_sides, strays
from benchdragon.kernels.motion_bounds import place_chain
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


BENCHES = np.array(
    [[0.4, 0.3, -0.9, 0.1, -0.8, -0.4, 0.5, -0.2], [0.6, 0.5, 0.1, 0.7, 0.2, 0.2, 0.7, 0.1]]
)


def sides(route: Route, ends: FloatArray, hulls: FloatArray, near: float) -> tuple[FloatArray, int]:
    """How far hulls that count everywhere reach beside cells, at most 0.9 m, and pairs looked at."""
    found, everywhere = np.empty((len(ends), 2)), np.tile([-np.inf, np.inf], (len(hulls), 1))
    pairs = band_sides(route.rows, ends, hulls, everywhere, near, 0.9, found)
    return found, pairs


def hulls_at(route: Route, s: float) -> FloatArray:
    """Two hulls about a point of a route: x and y of corners, m, (2, 16)."""
    corners = np.stack([BENCHES, np.roll(BENCHES, 3, axis=1)], axis=-1) + route.point(s)
    return np.ascontiguousarray(corners).reshape(2, 16)


@pytest.mark.parametrize("name", ROUTES)
def test_beside_a_place_the_band_is_what_hulls_cover_of_the_line_square_to_the_route(name: str) -> None:
    route, start = ROUTES[name]
    hulls = hulls_at(route, start)
    for s in np.linspace(start - 0.8, start + 0.8, 7).tolist():
        found, pairs = sides(route, np.array([[s, s]]), hulls, 0.0)
        heading = float(route.heading(s))
        square = 0.9 * np.array([-math.sin(heading), math.cos(heading)])
        line = shapely.LineString([route.point(s) - square, route.point(s) + square])
        shapes = shapely.convex_hull(shapely.multipoints(hulls.reshape(2, 8, 2)))
        cut = shapely.get_coordinates(shapely.intersection(shapes, line)) - route.point(s)
        aside = np.append(cut @ square / 0.9, 0.0)
        assert pairs == 2
        assert found[0] == pytest.approx([aside.max(), -aside.min()], abs=1e-12)


@pytest.mark.parametrize("name", ROUTES)
def test_no_place_of_a_cell_has_a_wider_band_than_is_said_of_the_cell(name: str) -> None:
    """Where the route turns in a cell, squares swing: at a kink by all of its angle."""
    route, start = ROUTES[name]
    hulls = hulls_at(route, start)
    borders = start + np.array([-0.7, -0.2, 0.35, 0.9])
    cells = np.column_stack([borders[:-1], borders[1:]])
    most, _pairs = sides(route, cells, hulls, 0.01)
    for bound, (low, high) in zip(most, cells.tolist(), strict=True):
        at = np.linspace(low, high, 60)
        seen, _pairs = sides(route, np.column_stack([at, at]), hulls, 0.0)
        assert (seen.max(axis=0) + 0.01 <= bound).all()
        assert (bound <= seen.max(axis=0) + 0.65).all()


def test_a_hull_counts_where_its_bench_stands_alone() -> None:
    route, _start = ROUTES["line"]
    cells = np.array([[9.0, 10.0], [10.0, 11.0], [11.0, 12.0]])
    found = np.empty((3, 2))
    hull = hulls_at(route, 10.5)[:1]
    assert band_sides(route.rows, cells, hull, np.array([[9.5, 10.0]]), 0.0, 0.9, found) == 2
    assert (found[:2] > 0.0).all()
    assert found[2].tolist() == [0.0, 0.0]
