"""Routes along drawn lines: how near they keep is a bound, and bends are as wide as is said."""

import math
from itertools import pairwise

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

from benchdragon.errors import InputError
from benchdragon.kernels.fitting import bound_to_chord, set_headings, simplified
from benchdragon.model.curves import Arc, Clothoid, Line, Route
from benchdragon.surveys.clothoids import bound_between, g1_clothoids
from benchdragon.surveys.fitting import Fit, Smooth, fitted
from benchdragon.surveys.lines import DrawnLine, corners_of

FloatArray = NDArray[np.float64]
SMOOTHS: tuple[Smooth, ...] = ("none", "G1", "G2")


def polyline(points: FloatArray, closed: bool = False) -> DrawnLine:
    return DrawnLine("", corners_of(points, closed), (), closed)


def scribble(rng: np.random.Generator, most: int = 60) -> DrawnLine:
    """A line as a hand or a receiver draws it: few or many points, sharp or smooth, open or closed."""
    count = int(rng.integers(2, most))
    kind = rng.integers(3)
    if kind == 0:
        points = rng.uniform(-20.0, 20.0, (count, 2))
    elif kind == 1:
        points = np.cumsum(rng.normal(0.0, 1.0, (count, 2)), axis=0)
    else:
        angle = np.linspace(0.0, rng.uniform(1.0, 6.2), count)
        points = 12.0 * np.column_stack([np.cos(angle), np.sin(2.0 * angle)])
        points += rng.normal(0.0, 0.03, (count, 2))
    return polyline(points, bool(rng.integers(2)) and count > 2)


def sampled(fit: Fit, line: DrawnLine) -> float:
    """The largest distance that is found from places on either to the other, m."""
    return sampled_points(fit.route, line)


def sampled_points(along: Route, line: DrawnLine) -> float:
    """The same of a route along a line."""
    joints = along.joints
    s = np.unique(np.concatenate([np.linspace(a, b, 20) for a, b in pairwise(joints)]))
    route = shapely.LineString(along.point(s))
    corners = line.points()[0]
    drawn = shapely.LineString(np.vstack([corners, corners[:1]]) if line.closed else corners)
    there = shapely.distance(shapely.points(np.asarray(route.coords)), drawn).max()
    dense = shapely.points(np.asarray(drawn.segmentize(drawn.length / 150.0).coords))
    # The sampled route is made of chords, which keep within k h^2 / 8 of it; twice that, as k varies.
    bends = np.abs(along.curvature(0.5 * (s[1:] + s[:-1])))
    off = float((bends * np.diff(s) ** 2).max()) / 4.0
    return float(max(there, shapely.distance(dense, route).max() - off))


def test_a_thousand_drawn_lines_give_a_route_within_its_bound_or_one_sentence() -> None:
    rng = np.random.default_rng(7)
    routes = refused = 0
    tightest = []
    for n in range(1000):
        line = scribble(rng)
        smooth, deviation = SMOOTHS[n % 3], float(10.0 ** rng.uniform(-2.0, 0.5))
        try:
            fit = fitted(line, smooth, deviation)
        except InputError:
            refused += 1
            continue
        routes += 1
        found = sampled(fit, line)
        assert found <= fit.deviation + 1e-9, (n, found, fit.deviation)
        assert fit.deviation <= deviation
        tightest.append(found / fit.deviation if fit.deviation > 1e-9 else 1.0)
        bends = np.abs(fit.route.curvature(np.linspace(0.0, fit.route.length, 500)))
        assert bends.max() <= (1.0 + 1e-9) / fit.least_radius
    assert routes > 700
    assert refused > 200
    # The bound is no far cry: sampling comes near to it.
    assert np.median(tightest) > 0.6


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("smooth", ["G1", "G2"])
def test_a_corner_is_rounded_as_wide_as_the_deviation_allows(smooth: Smooth, closed: bool) -> None:
    line = polyline(np.array([[0.0, 0.0], [30.0, 0.0], [30.0, 20.0], [0.0, 20.0]]), closed)
    fit = fitted(line, smooth, 0.5)
    if smooth == "G1":
        # At a right angle an arc of radius r leaves r (sqrt 2 - 1) of the corner.
        assert math.isclose(fit.least_radius, 0.5 / (math.sqrt(2.0) - 1.0), rel_tol=1e-8)
    s = float(fit.s)
    bend = np.abs(fit.route.curvature([s - 1e-9, s + 1e-9])).max()
    assert math.isclose(bend, 1.0 / fit.least_radius, rel_tol=1e-6)
    assert math.isclose(sampled(fit, line), 0.5, abs_tol=2e-3)


def test_with_g2_the_curvature_does_not_jump_and_with_g1_the_heading_does_not() -> None:
    rng = np.random.default_rng(3)
    for _n in range(30):
        line = scribble(rng)
        try:
            route = fitted(line, "G2", 2.0).route
        except InputError:
            continue
        inner = route.joints[1:-1]
        step = 1e-9
        jumps = np.abs(route.curvature(inner + step) - route.curvature(inner - step))
        change = max(
            (
                abs(c.end_curvature - c.start_curvature) / c.length_m
                for c in route
                if isinstance(c, Clothoid)
            ),
            default=0.0,
        )
        assert np.all(jumps <= 2.0 * step * change + 1e-9)


def test_points_are_met_and_clothoids_are_those_of_an_independent_solver() -> None:
    pyclothoids = pytest.importorskip("pyclothoids")
    rng = np.random.default_rng(11)
    points = np.cumsum(rng.normal(0.0, 3.0, (300, 2)), axis=0)
    poses = np.column_stack([points, rng.uniform(-math.pi, math.pi, 300)])
    for curve, start, end in zip(g1_clothoids(poses), poses[:-1], poses[1:], strict=True):
        (x, y), heading = curve.end_pose
        assert np.allclose((x, y), end[:2], atol=1e-11 * max(1.0, curve.length))
        assert abs(math.remainder(heading - end[2], 2.0 * math.pi)) < 1e-12 * max(1.0, curve.length)
        other = pyclothoids.Clothoid.G1Hermite(*start, *end)
        assert math.isclose(curve.length, other.length, rel_tol=1e-9)
        assert math.isclose(curve.curvature(0.0), other.KappaStart, rel_tol=1e-6, abs_tol=1e-7)
    fit = fitted(polyline(points), "none", 100.0)
    assert np.allclose(fit.route.point(fit.route.joints), points, atol=1e-9)


def test_points_of_a_circle_give_that_circle() -> None:
    angle = np.linspace(0.0, 2.0 * math.pi, 13)[:-1]
    points = 7.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    poses = np.empty((13, 3))
    set_headings(points, True, poses)
    off = poses[:-1, 2] - angle - 0.5 * math.pi
    assert np.allclose(np.remainder(off + 1.0, 2.0 * math.pi), 1.0, atol=1e-12)
    assert poses[-1, 2] == poses[0, 2]
    fit = fitted(polyline(points, True), "none", 1.0)
    assert math.isclose(fit.least_radius, 7.0, rel_tol=1e-12)
    assert math.isclose(fit.route.length, 14.0 * math.pi, rel_tol=1e-12)


def test_bounds_hold_between_the_places_that_are_looked_at() -> None:
    arc = Arc(2.0, 3.0)
    (x, y), _heading = arc.end_pose
    # The farthest point of an arc from its chord is r (1 - cos(sweep / 2)).
    assert (
        2.0 * (1.0 - math.cos(1.5)) <= bound_to_chord(arc.parts) <= 2.0 * (1.0 - math.cos(1.5)) + 2e-3
    )
    line = Line(math.hypot(x, y), (0.0, 0.0), math.atan2(y, x))
    s = np.linspace(0.0, 1.0, 20001)
    apart = np.hypot(*(arc.point(s * arc.length) - line.point(s * line.length)).T).max()
    assert apart <= bound_between(arc, line) <= 1.01 * apart


def test_what_is_simplified_stays_near_either_way() -> None:
    rng = np.random.default_rng(5)
    for n in range(100):
        points = np.cumsum(rng.normal(0.0, 1.0, (80, 2)), axis=0)
        closed = bool(n % 2)
        kept, strays = np.empty(81, np.int64), np.empty(81)
        count = simplified(points, closed, 0.8, kept, strays)
        kept, strays = kept[: count + 1], strays[:count]
        ring = np.vstack([points, points[:1]]) if closed else points
        whole = shapely.LineString(ring)
        fewer = shapely.LineString(ring[kept])
        assert kept[-1] == len(ring) - 1
        assert (
            shapely.hausdorff_distance(whole, fewer, densify=0.05)
            <= strays.max() + 1e-12
            <= 0.8 + 1e-12
        )


def test_surveyed_parts_stay_as_they_are_unless_a_corner_or_g2_wants_more() -> None:
    parts = (Line(10.0), Arc(5.0, 1.0, (10.0, 0.0), 0.0))
    line = DrawnLine("", np.zeros((0, 3)), parts)
    assert fitted(line, "G1", 0.01).route.curves == parts
    assert fitted(line, "none", 0.01).route.curves == parts
    smooth = fitted(line, "G2", 0.05)
    assert sampled(smooth, line) <= smooth.deviation + 1e-3 <= 0.051
    kinked = DrawnLine("", np.zeros((0, 3)), (Line(10.0), Arc(5.0, 1.0, (10.0, 0.0), 0.3)))
    assert sampled(fitted(kinked, "G1", 0.1), kinked) <= 0.101
    with pytest.raises(InputError, match=r"at \(10, 0\) m the drawing has a kink of 17\.19 degrees"):
        fitted(kinked, "none", 0.1)
    apart = DrawnLine("", np.zeros((0, 3)), (Line(10.0), Line(5.0, (10.0, 0.1), 0.0)))
    with pytest.raises(InputError, match=r"at \(10, 0\) m two parts of the drawing are 0\.1 m apart"):
        fitted(apart, "G1", 1.0)


def test_the_tightest_place_is_named() -> None:
    line = polyline(np.array([[0.0, 0.0], [20.0, 0.0], [40.0, 20.0], [40.0, 30.0], [0.0, 30.0]]))
    with pytest.raises(InputError) as caught:
        fitted(line, "G1", 0.3, least_radius=3.0)
    text = str(caught.value)
    assert "with a radius of 0.7243 m, and 3 m is required" in text
    fit = fitted(line, "G1", 0.3)
    x, y = fit.route.point(fit.s)
    assert f"at ({x:.4f}, {y:.4f}) m, s = {fit.s:.4f} m" in text


def test_a_route_is_whole() -> None:
    fit = fitted(polyline(np.array([[0.0, 0.0], [20.0, 0.0], [20.0, 20.0]])), "G2", 0.5)
    assert isinstance(fit.route, Route)
    assert [type(curve) for curve in fit.route] == [Line, Clothoid, Arc, Clothoid, Line]
