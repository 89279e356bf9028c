"""Lines that stray: as far as they should, smoothly, and drawn by arcs within what is said."""

import math
from itertools import pairwise

import numpy as np
import pytest

from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import FloatArray, RouteRow
from benchdragon.kernels.motion_bounds import curvature_range
from benchdragon.kernels.stray_chain import place_along
from benchdragon.kernels.stray_line import (
    LATTICE,
    LATTICE_REACH,
    STRAY_LENGTH,
    between,
    lay_points,
    noise_count,
    offset_at,
)
from benchdragon.model.curves import Arc, Clothoid, Line, Route, Spiral
from benchdragon.solve.tolerance import Deviations, Draw
from tests.solve.dances import line_beside, noise_of

ROUTES = {
    "spiral": Route((Spiral.between(0.9, 14.0, 6.0),)),
    "turn": Route.joined([Line(16.0), Arc(1.8, 2.8), Arc(0.9, -2.8), Line(6.0)]),
    "clothoids": Route.joined([Line(16.0), Clothoid(2.5, 0.0, 0.8), Arc(1.25, 2.0), Line(6.0)]),
}


def points_on(rows: FloatArray, at: FloatArray) -> FloatArray:
    """Points of a line given as rows, at positions along it."""
    places = empty_placements(1, len(at))
    assert place_along(rows, np.empty(0), np.zeros(1), at, places) == len(at)
    return np.asarray(places.x[0] + 1j * places.y[0])


@pytest.mark.parametrize("name", ROUTES)
def test_a_line_that_does_not_stray_is_the_route(name: str) -> None:
    route = ROUTES[name]
    line = line_beside(route, Draw(Deviations(), 1, 0), 1.0, route.length)
    assert line.points[[0, -1]] == pytest.approx([1.0, route.length])
    s = np.linspace(1.0, route.length, 3001)
    points = points_on(line.rows, np.interp(s, line.points, line.along))
    exact = route.point(s) @ [1.0, 1j]
    # Along the line the positions are those of arcs of one length between points.
    beside = np.array([np.abs(points[max(n - 40, 0) : n + 41] - exact[n]).min() for n in range(3001)])
    assert np.abs(points - exact).max() < 2e-3
    tangent = np.gradient(exact)
    across = ((points - exact) * (tangent / np.abs(tangent)).conj()).imag
    assert np.abs(across).max() < 2e-5
    assert beside.max() < 5e-3


@pytest.mark.parametrize("name", ROUTES)
def test_a_line_that_strays_is_smooth_and_as_far_aside_as_it_should(name: str) -> None:
    route, draw = ROUTES[name], Draw(Deviations(stray=0.03), 1, 0)
    end = route.length - 1.0
    line = line_beside(route, draw, 2.0, end)
    rows, drawn = line.rows, line.points
    nodes = points_on(
        rows,
        np.append(rows[1::2, RouteRow.S_START], rows[-1, RouteRow.S_START] + rows[-1, RouteRow.LENGTH]),
    )
    exact, heading = route.point(drawn) @ [1.0, 1j], route.heading(drawn)
    noise = noise_of(draw, end)
    off = 0.03 * np.array([offset_at(noise, end - s) for s in drawn])
    assert np.abs(nodes - exact - 1j * np.exp(1j * heading) * off[:, 0]).max() < 1e-10
    # With the heading that this gives it: that of arcs from point to point.
    turned = heading + np.arctan2(off[:, 1], 1.0 - off[:, 0] * route.curvature(drawn))
    apart = [math.remainder(a, math.tau) for a in rows[1::2, RouteRow.ANGLE] - turned[:-1]]
    assert np.abs(apart).max() < 1e-9
    for j in range(1, len(rows) - 1):
        low, high = curvature_range(rows, j, 0.0, j + 1, 0.0)
        assert high - low < 3.0  # infinite at a kink or a gap
    assert all(a < b for a, b in pairwise(drawn))
    assert (np.diff(drawn) < 2.0 + 1e-9).all()
    joints = route.joints[(route.joints > 2.0) & (route.joints < end)]
    assert set(joints.tolist()) <= set(drawn.tolist())


def test_offsets_have_the_deviation_and_correlation_that_are_said() -> None:
    """Exactly: each is a sum of independent numbers, whose factors are asked for one by one."""
    ends = 5.3, 5.3 + 0.5 * STRAY_LENGTH, 5.3 + 2.0 * STRAY_LENGTH
    unit = np.eye(noise_count(ends[-1]))
    factors = np.array([[offset_at(row, back)[0] for row in unit] for back in ends])
    apart = np.subtract.outer(ends, ends) / STRAY_LENGTH
    np.testing.assert_allclose(factors @ factors.T, np.exp(-0.5 * apart**2), atol=1e-9)


def test_offsets_are_smooth_and_their_slopes_true() -> None:
    noise = noise_of(Draw(Deviations(stray=1.0), 3, 1), 90.0)
    back, step = np.linspace(0.1, 80.0, 1600), 1e-4
    found = np.array([offset_at(noise, s) for s in back])
    ahead = np.array([offset_at(noise, s - step)[0] for s in back])
    assert np.abs((ahead - found[:, 0]) / step - found[:, 1]).max() < 1e-4
    assert 0.1 < np.abs(found[:, 1]).max() < 1.0
    seam = 7 * LATTICE  # where one number comes in and another goes
    assert abs(offset_at(noise, seam - 1e-12)[0] - offset_at(noise, seam + 1e-12)[0]) < 1e-9
    # A route that goes farther back has the same line, whose numbers go on.
    longer = noise_of(Draw(Deviations(stray=1.0), 3, 1), 400.0)
    assert longer.size > noise.size > 2 * LATTICE_REACH
    np.testing.assert_array_equal(longer[: noise.size], noise)


def test_points_end_where_there_may_be_no_more() -> None:
    rows = ROUTES["turn"].rows
    whole = lay_points(rows, 0.0, 20.0, np.empty(0), 1000)
    assert lay_points(rows, 0.0, 20.0, np.empty(0), whole - 3) == whole - 3
    short = Route.joined([Line(10.0), Line(5e-4), Line(10.0)])  # not told apart
    points = np.empty(lay_points(short.rows, 0.0, 20.0, np.empty(0), 1000))
    lay_points(short.rows, 0.0, 20.0, points, 1000)
    assert np.diff(points).min() > 9e-4
    assert points[[0, -1]].tolist() == [0.0, 20.0]


def test_what_lies_between_points_is_on_the_line_through_them() -> None:
    places, values = np.array([1.0, 2.0, 4.0, 8.0]), np.array([3.0, 5.0, 4.0, 9.0])
    at = np.array([0.0, 1.0, 1.5, 2.0, 3.9, 4.0, 7.0, 8.0, 9.0])
    found = [between(x, places, values) for x in at]
    np.testing.assert_allclose(found, np.interp(at, places, values), atol=1e-15)


def test_a_line_bends_little_more_than_its_route() -> None:
    route = Route((Spiral.between(0.5, 8.8, 4.5),))
    rows = line_beside(route, Draw(Deviations(stray=0.05), 3, 1), 0.0, route.length).rows
    assert (np.abs(rows[1:, RouteRow.P]) < 0.25).all()
    assert np.isfinite(rows[:, [RouteRow.X, RouteRow.Y, RouteRow.ANGLE]]).all()
