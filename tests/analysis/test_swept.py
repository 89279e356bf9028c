"""The area that a dance covers, beside dense sampling of where its benches are."""

import math
from typing import Any

import numpy as np
import pytest
import shapely

from benchdragon.analysis.swept import (
    REACHED,
    SweptArea,
    enclosing,
    swept_area,
)
from benchdragon.analysis.swept_steps import MOST_STEPS, merged, placed_steps
from benchdragon.analysis.swept_width import _stretches
from benchdragon.errors import InputError, UnsureError, WalkError
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.ground_covered import band_sides
from benchdragon.model.curves import AnyCurve, Arc, Clothoid, Line, Route, Spiral
from benchdragon.model.dragon import Bench, Dragon
from benchdragon.model.profile import SpeedProfile
from benchdragon.model.walk import Walk

# A circle of that many segments a quarter is this much too small at most.
FINE, INSCRIBED = 32, 1.0005


def random_walk(seed: int) -> Walk:
    """A dragon of a few sizes of benches on lines, arcs and clothoids, which may cross."""
    draw = np.random.default_rng(seed)
    curves: list[AnyCurve] = [Line(6.0, (draw.uniform(-99, 99), 5.0), draw.uniform(-4, 4))]
    for _piece in range(4):
        radius, side = draw.uniform(2.5, 8.0), draw.choice([-1.0, 1.0])
        curves += [
            Arc(radius, side * draw.uniform(0.3, 3.0)),
            Clothoid(draw.uniform(2.0, 6.0), side / radius, draw.uniform(-0.3, 0.3)),
            Line(draw.uniform(1.0, 4.0)),
        ]
    sizes = Bench(2.2), Bench(1.4, 0.5, 0.1, 0.4), Bench(draw.uniform(1.2, 3.0), 0.4)
    benches = [sizes[n] for n in draw.integers(0, 3, draw.integers(1, 9))]
    profile = SpeedProfile((0.0, 5.0), (0.5, 1.5))
    return Walk(Dragon(benches), Route.joined(curves), profile, float(draw.uniform(0.0, 4.0)))


def sampled(walk: Walk, start: float, end: float, count: int) -> tuple[shapely.Geometry, float]:
    """The union of all benches at so many times, and at most how far one goes between two, m."""
    motion = walk.motion(np.linspace(start, end, count))
    corners = motion.corners()
    moved = np.hypot(*np.moveaxis(np.diff(corners, axis=0), -1, 0))
    union = shapely.union_all(shapely.polygons(corners.reshape(-1, 4, 2)))
    return union, 0.51 * float(moved.max(initial=0.0))


def farther(area: SweptArea, union: shapely.Geometry, slack: float) -> float:
    """What of the polygon is farther than its error and a slack, m, from what was sampled, m2."""
    near = shapely.buffer(union, INSCRIBED * (area.error + slack), quad_segs=FINE)
    return float(shapely.difference(area.polygon, near).area)


def assert_sound(walk: Walk, start: float, end: float, error: float, count: int = 500) -> SweptArea:
    """Hold an area to dense sampling: nothing left out, nothing too far."""
    area = swept_area(walk, start, end, error=error)
    union, slack = sampled(walk, start, end, count)
    assert shapely.difference(union, area.polygon).is_empty
    assert 0.0 < area.error <= error
    assert farther(area, union, slack) <= 1e-12
    assert area.polygon.is_valid
    return area


@pytest.mark.parametrize("seed", range(12))
def test_all_that_is_covered_is_held_and_nothing_far_from_it(seed: int) -> None:
    walk = random_walk(seed)
    last = walk.time_at(walk.route.length)
    draw = np.random.default_rng(seed)
    start, end = np.sort(draw.uniform(0.0, last, 2)).tolist()
    assert_sound(walk, start, end, float(draw.choice([0.003, 0.02, 0.2])))


def test_kinks_of_the_route_are_walked_over() -> None:
    route = Route(
        (Line(8.0), Line(5.0, (8.0, 0.0), 0.35), Arc(4.0, 2.0, _ahead(8.0, 0.35, 5.0), 0.3499)),
        kinks=True,
    )
    assert_sound(Walk(Dragon.uniform(5), route, start=6.0), 0.0, 11.0, 0.01)


def _ahead(x: float, heading: float, length: float) -> tuple[float, float]:
    return x + length * math.cos(heading), length * math.sin(heading)


def test_one_bench_alone() -> None:
    walk = Walk(Dragon.uniform(1), Route.joined([Line(9.0), Arc(3.0, 4.0)]), start=4.0)
    assert_sound(walk, 0.0, 15.0, 0.005)


def test_an_instant_is_the_benches_themselves() -> None:
    walk = random_walk(3)
    area = assert_sound(walk, 2.0, 2.0, 0.01, 1)
    assert area.error < 0.003


def test_a_short_walk_leaves_gaps_between_the_benches() -> None:
    benches = [Bench(1.0, 0.3, 0.05, 0.05), Bench(4.0, 0.02, 0.1, 0.1)] * 3
    walk = Walk(Dragon(benches), Route((Line(60.0),)), start=40.0)
    area = swept_area(walk, 0.0, 0.5, error=0.001)
    wide = shapely.intersection(area.polygon, shapely.box(0.0, 0.1, 60.0, 0.2))
    assert len(shapely.get_parts(wide)) == 3
    assert wide.area == pytest.approx(3 * 1.5 * 0.05, abs=0.003)


def test_two_passes_and_gaps_are_counted_once() -> None:
    assert merged(np.array([[4.0, 5.0], [0.0, 1.0], [1.0, 2.0], [0.5, 0.6]])).tolist() == [
        [0.0, 2.0],
        [4.0, 5.0],
    ]


def test_a_stop_and_a_later_start_change_nothing_but_the_time() -> None:
    walk = random_walk(5)
    stopping = SpeedProfile((0.0, 1.0, 2.0, 3.0), (1.0, 0.0, 0.0, 1.0))
    waiting = Walk(walk.dragon, walk.route, stopping, walk.start)
    steady = Walk(walk.dragon, walk.route, SpeedProfile.constant(1.0), walk.start)
    a, b = swept_area(waiting, 0.0, 6.0), swept_area(steady, 0.0, waiting.profile.distance(6.0).item())
    assert a.area == pytest.approx(b.area, rel=1e-12)


ENDS = np.array([[8.0, 8.4], [9.9, 10.3], [12.0, 12.2], [14.0, 14.6]])


@pytest.mark.parametrize(
    "size", [(2.2, 0.3, 0.275, 0.275), (3.4, 0.02, 0.1, 0.1), (2.0, 1.0, 0.7, 0.1)]
)
def test_no_bench_strays_from_the_hull_of_its_ends_by_more_than_is_said(
    size: tuple[float, float, float, float],
) -> None:
    """Both bounds hold for each step by itself, and neither is far above what is seen."""
    walk = Walk(
        Dragon([Bench(*size)]), Route.joined([Line(9.0), Arc(2.2, 1.5), Clothoid(4.0, 0.4, -0.4)])
    )
    sizes = walk.dragon.sizes
    _kind, _front, _rear, corners, stray, fill = placed_steps(walk, sizes, 0, ENDS)
    shares = []
    for n, (low, high) in enumerate(ENDS):
        at = np.linspace(low, high, 400)
        between = placed_steps(walk, sizes, 0, np.column_stack([at, at]))[3][:, 0]
        hull = shapely.convex_hull(shapely.MultiPoint(corners[n].reshape(-1, 2)))
        out = float(shapely.distance(shapely.points(between.reshape(-1, 2)), hull).max())
        union = shapely.union_all(shapely.polygons(between))
        far = max(
            shapely.distance(point, union)
            for point in np.asarray(shapely.points(_grid(hull)))
            if shapely.intersects(hull, point)
        )
        assert out <= stray[n] + 1e-12
        assert far <= stray[n] + fill[n] + 0.01 * (high - low)
        shares.append((out / stray[n], far / (stray[n] + fill[n])))
    assert max(share for share, _far in shares) > 0.2
    if size[1] < 0.1:  # wide benches cover what thin ones leave
        assert max(far for _share, far in shares) > 0.4


def _grid(shape: shapely.Geometry) -> FloatArray:
    x0, y0, x1, y1 = shapely.bounds(shape)
    x, y = np.meshgrid(np.linspace(x0, x1, 120), np.linspace(y0, y1, 120))
    return np.column_stack([x.ravel(), y.ravel()])


def circle_walk(radius: float, benches: int = 6) -> Walk:
    return Walk(Dragon.uniform(benches), Route((Arc(radius, 6.0 * math.pi),)), start=30.0)


@pytest.mark.parametrize("radius", [2.5, 4.0, 9.0])
def test_the_widest_place_on_a_circle_is_what_geometry_says(radius: float) -> None:
    middle = math.sqrt(radius**2 - 1.43**2)  # of the head's link
    inner, outer = middle - 0.15, math.hypot(middle + 0.15, 0.5 * 3.41)
    widest = swept_area(circle_walk(radius), 0.0, 6.0, error=0.004).widest
    assert widest.width.lower <= outer - inner + 1e-9 <= widest.width.upper + 1e-9
    assert widest.width.upper - widest.width.lower < 0.03
    assert widest.left == pytest.approx(radius - inner, abs=0.01)
    assert widest.right == pytest.approx(outer - radius, abs=0.01)


@pytest.mark.parametrize("seed", range(6))
def test_no_section_is_wider_than_the_widest_place(seed: int) -> None:
    """Sections of benches sampled in time, square to the route, none of other passes of it."""
    walk = random_walk(seed)
    last = 0.9 * walk.time_at(walk.route.length)
    widest = swept_area(walk, 0.0, last, error=0.01).widest
    motion = walk.motion(np.linspace(0.0, last, 300))
    seen, outlines = 0.0, motion.outlines()
    for s in np.linspace(0.0, 0.9 * walk.route.length, 60):
        point, heading = walk.route.point(s), float(walk.route.heading(s))
        square = np.array([-math.sin(heading), math.cos(heading)])
        line = shapely.LineString([point - 1.2 * square, point + 1.2 * square])
        times, benches = np.nonzero((motion.s[:, 1:] <= s) & (motion.s[:, :-1] >= s))
        shapes = outlines[times, benches]
        if len(shapes):
            cut = shapely.intersection(shapes, line)
            aside = (shapely.get_coordinates(cut) - point) @ square
            seen = max(seen, float(np.ptp(np.append(aside, 0.0))))
    assert seen <= widest.width.upper
    assert widest.width.lower >= seen - 0.03
    assert widest.width.upper - widest.width.lower < 0.08


def test_the_smallest_rectangle_and_circle_hold_it_and_are_smallest() -> None:
    walk = random_walk(7)
    last = walk.time_at(walk.route.length)
    rectangle, circle = enclosing(walk, 0.0, last, error=0.005)
    union, _slack = sampled(walk, 0.0, last, 600)
    assert shapely.covers(shapely.Polygon(rectangle.corners).buffer(1e-9), union)
    points = shapely.get_coordinates(shapely.convex_hull(union))
    turns = np.linspace(0.0, 0.5 * math.pi, 3000)
    areas = [
        np.ptp(points @ [math.cos(a), math.sin(a)]) * np.ptp(points @ [-math.sin(a), math.cos(a)])
        for a in turns
    ]
    assert rectangle.area.lower <= min(areas) <= rectangle.area.upper * 1.001
    assert rectangle.area.upper <= min(areas) * 1.01
    assert rectangle.area.value == pytest.approx(rectangle.width * rectangle.height)
    assert rectangle.width >= rectangle.height
    side = rectangle.corners[0] - rectangle.corners[1]
    assert np.hypot(*side) == pytest.approx(rectangle.width)
    turned = (math.atan2(side[1], side[0]) - rectangle.angle) / math.pi
    assert turned == pytest.approx(round(turned), abs=1e-9)
    reach = np.hypot(*(points - circle.centre).T).max()
    assert reach <= circle.radius.upper
    assert circle.radius.lower <= float(shapely.minimum_bounding_radius(union)) <= circle.radius.upper
    assert circle.radius.upper - circle.radius.lower <= 0.006


def test_the_spectators_line_keeps_its_margin_and_holes_are_told_apart() -> None:
    walk = circle_walk(9.0, 17)
    area = swept_area(walk, 0.0, 30.0, margin=2.0)
    union, _slack = sampled(walk, 0.0, 30.0, 400)
    assert shapely.covers(area.spectators, shapely.buffer(union, 1.999, quad_segs=FINE))
    far = shapely.buffer(union, INSCRIBED * (2.0 * REACHED + area.error + 0.06), quad_segs=FINE)
    assert shapely.covers(far, area.spectators)
    outer, holes = area.lines
    assert len(outer) == len(holes) == 1
    assert np.hypot(*outer[0].T - np.array([[0.0], [9.0]])).min() > 9.0
    assert np.hypot(*holes[0].T - np.array([[0.0], [9.0]])).max() < 9.0
    assert (outer[0][0] == outer[0][-1]).all()


def test_three_and_a_half_thousand_benches_are_outlined() -> None:
    walk = Walk(Dragon.uniform(3500), Route((Spiral.between(1.7, 30.0, 15.0),)))
    area = swept_area(walk, 0.0, 300.0, error=0.05)
    assert 2500 < len(area.steps.kind) < MOST_STEPS
    assert area.error <= 0.05


def test_what_cannot_be_is_refused() -> None:
    walk = random_walk(1)
    cases: list[tuple[dict[str, Any], str]] = [
        ({"error": 0.0}, "error must be from"),
        ({"error": 2.0}, "error must be from"),
        ({"error": math.nan}, "finite"),
        ({"margin": -1.0}, "negative"),
        ({"margin": 1e4}, "at most 1000 m"),
    ]
    for wrong, text in cases:
        with pytest.raises(InputError, match=text):
            swept_area(walk, 0.0, 1.0, **wrong)
    with pytest.raises(InputError, match="must not come before"):
        swept_area(walk, 1.0, 0.0)
    with pytest.raises(WalkError):
        swept_area(walk, 0.0, 1e4)


def test_an_area_of_too_many_steps_is_refused_before_it_is_begun(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("benchdragon.analysis.swept_steps.placed_steps", None)
    walk = Walk(Dragon.uniform(3), Route((Line(1e6),)), SpeedProfile.constant(50.0))
    with pytest.raises(InputError, match="200000 steps"):
        swept_area(walk, 0.0, 2e4)


def test_a_bench_that_leaps_is_told() -> None:
    """The rear handle is still before a spike of the route, then all at once at its tip."""
    up, down = math.hypot(0.3, 0.6), math.hypot(0.6, 0.6)
    spike = Line(up, (6.0, 0.0), math.atan2(0.6, -0.3)), Line(down, (5.7, 0.6), -0.25 * math.pi)
    route = Route((Line(6.0), *spike, Line(9.0, (6.3, 0.0))), kinks=True)
    walk = Walk(Dragon([Bench(2.2)]), route, start=8.0)
    leap = 6.0 + up + down + math.sqrt(1.65**2 - 0.36) - 0.6  # when the tip is one link away
    with pytest.raises(UnsureError, match=rf"s = {leap:.3f}\d* m of the route: use gentler"):
        swept_area(walk, 0.0, 2.0)


def test_a_bench_that_cannot_stand_is_told() -> None:
    """Around a hairpin whose sides are nearer than a link it cannot follow."""
    route = Route.joined([Line(9.0), Arc(0.7, math.pi), Line(9.0)])
    walk = Walk(Dragon([Bench(2.2)]), route, start=5.0)
    with pytest.raises(WalkError, match=r"folds|cannot follow"):
        swept_area(walk, 0.0, 12.0)


def test_across_a_kink_a_bench_strays_by_what_it_travels_at_most() -> None:
    route = Route((Line(8.0), Line(5.0, (8.0, 0.0), 0.6)), kinks=True)
    walk = Walk(Dragon([Bench(2.2)]), route)
    ends = np.array([[7.9, 8.1], [9.6, 9.8]])  # the front handle's kink, then the rear one's
    *_rest, corners, stray, _fill = placed_steps(walk, walk.dragon.sizes, 0, ends)
    for n, (low, high) in enumerate(ends):
        at = np.linspace(low, high, 200)
        between = placed_steps(walk, walk.dragon.sizes, 0, np.column_stack([at, at]))[3][:, 0]
        hull = shapely.convex_hull(shapely.MultiPoint(corners[n].reshape(-1, 2)))
        out = float(shapely.distance(shapely.points(between.reshape(-1, 2)), hull).max())
        assert 0.15 * stray[n] < out <= stray[n] <= 0.2


def test_the_polygon_is_widened_by_the_stray_and_the_smoothing() -> None:
    """Every point that the bounds allow is held: all within the stray of any hull."""
    walk = random_walk(2)
    area = swept_area(walk, 0.0, 12.0, error=0.1)
    hulls = shapely.union_all(shapely.convex_hull(shapely.multipoints(_corners(area))))
    allowed = shapely.buffer(hulls, area.steps.widest_stray, quad_segs=FINE)
    assert shapely.covers(area.polygon, allowed)
    assert shapely.hausdorff_distance(area.polygon, allowed) < 0.1 * 0.3


def _corners(area: SweptArea) -> FloatArray:
    return area.steps.corners.reshape(len(area.steps.kind), -1, 2)


def test_the_error_is_told_with_all_of_its_parts() -> None:
    """What a hull covers needlessly and how far the polygon is outside of hulls add up."""
    walk = random_walk(2)
    area = swept_area(walk, 0.0, 12.0, error=0.05)
    hulls = shapely.union_all(shapely.convex_hull(shapely.multipoints(_corners(area))))
    outside = float(shapely.hausdorff_distance(area.polygon, shapely.union(hulls, area.polygon)))
    boundary = shapely.points(shapely.get_coordinates(area.polygon))
    outside += float(shapely.distance(boundary, hulls).max())
    assert area.error >= float((area.steps.stray + area.steps.fill).max()) + outside
    assert area.error <= 0.05


def test_each_cell_is_bounded_as_a_whole() -> None:
    """Where the band is wide at one end of a cell alone, the whole cell's bound says so."""
    benches = [Bench(2.0, 0.2, 0.1, 0.1), Bench(1.0, 1.4, 0.1, 0.1)]
    walk = Walk(Dragon(benches), Route((Line(30.0),)), start=10.0)
    steps = swept_area(walk, 0.0, 0.0).steps
    ends = np.array([[8.0, 8.4], [6.9, 7.4], [7.05, 8.2]])  # the wide bench: 7.3 to 8.3 m
    ends = ends[np.argsort(ends[:, 0])]
    stretches = _stretches(steps.sizes[:, steps.kind], steps.front, steps.rear)
    sides = np.empty((3, 2))
    hulls = steps.corners.reshape(-1, 16)
    band_sides(walk.route.rows, ends, hulls, stretches, steps.widest_stray, 1.2, sides)
    bounds = sides.sum(axis=1)
    assert (bounds >= 1.4).all()
    assert (bounds <= 1.41).all()
