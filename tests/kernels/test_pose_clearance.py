"""Rooms of dances at poses, beside the shapes of their boxes and of what stands there."""

import math
from typing import Any

import numpy as np
import pytest
import shapely

from benchdragon.kernels import pose_clearance as kernel
from benchdragon.kernels.box import BOX_COLUMNS
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.curves import Route, Spiral
from benchdragon.model.obstacle import Obstacle

RANDOM = np.random.default_rng(7)
ROOM = [(-20.0, -16.0), (20.0, -16.0), (20.0, 3.0), (6.0, 3.0), (6.0, 17.0), (-20.0, 17.0)]
STANDING = [
    Obstacle.venue("yard", ROOM),
    Obstacle.circle("well", (3.0, -4.0), 0.7),
    Obstacle.polygon("stage", [(-9.0, 5.0), (-2.0, 5.0), (-2.0, 9.0), (-9.0, 8.0)]),
    Obstacle.line("rope", [(-15.0, -9.0), (12.0, -11.0), (14.0, -2.0)]),
]


def laid(route: Route, low: float, high: float, count: int) -> FloatArray:
    """Boxes of benches of 2 m x 0.4 m along a route, and a row of scratch."""
    sizes = np.array([[2.0], [0.4], [0.15], [0.15]])
    boxes = np.zeros((count + 1, BOX_COLUMNS))
    at, scratch = np.linspace(low, high, count), empty_placements(2, count)
    assert kernel.lay_boxes(route.rows, np.array([1.7]), sizes, 0, at, scratch, 0, boxes)
    return boxes


BOXES = laid(Route((Spiral(1.1, 11.0 * math.pi, 3.0 * math.pi),)), 6.0, 94.0, 89)


def shape(boxes: FloatArray) -> Any:
    """What boxes cover."""
    corners = []
    for x, y, ux, uy, a, b in boxes[:-1].tolist():
        ways = [(a, b), (-a, b), (-a, -b), (a, -b)]
        corners.append([(x + p * ux - q * uy, y + p * uy + q * ux) for p, q in ways])
    return shapely.union_all([shapely.Polygon(one) for one in corners])


COVERED = shape(BOXES)


def circles(boxes: FloatArray) -> FloatArray:
    found = np.empty((math.ceil((len(boxes) - 1) / kernel.GROUP), 3))
    kernel.bound_groups(boxes, found)
    return found


CIRCLES = circles(BOXES)


def clearance(one: Obstacle, pose: tuple[float, float, float], most: float = math.inf) -> float:
    return kernel.pose_clearance(
        BOXES, CIRCLES, one.boxes, one.sort, one.outline, one.radius, *pose, most
    )


def moved(pose: tuple[float, float, float]) -> Any:
    """The dance at a pose."""
    x, y, angle = pose
    c, s = math.cos(angle), math.sin(angle)
    return shapely.affinity.affine_transform(COVERED, [c, -s, s, c, x, y])


@pytest.mark.parametrize("one", STANDING, ids=lambda one: one.name)
def test_clearance_at_a_pose_is_the_distance_of_the_shapes(one: Obstacle) -> None:
    clear = met = outside = 0
    for _try in range(60):
        pose = (*RANDOM.uniform(-30.0, 30.0, 2).tolist(), RANDOM.uniform(-4.0, 4.0))
        found, dance = clearance(one, pose), moved(pose)
        edge: Any = shapely.Point(one.outline[0])
        if one.kind == "line":
            edge = shapely.LineString(one.outline)
        elif one.kind != "circle":
            edge = shapely.LinearRing(one.outline)
        apart = shapely.distance(dance, edge) - one.radius
        if shapely.distance(dance, edge) == 0.0 or apart < 0.0:
            assert found < 1e-12
            met += 1
        elif one.kind == "venue" and not shapely.Polygon(one.outline).contains(dance):
            assert found == pytest.approx(-apart, abs=1e-9)
            outside += 1
        else:
            assert found == pytest.approx(apart, abs=1e-9)
            clear += 1
    assert clear > 2
    assert met > 0
    assert outside > 20 or one.kind != "venue"


def test_what_is_farther_than_asked_counts_as_so_far() -> None:
    far = 60.0, 0.0, 0.0
    assert clearance(STANDING[1], far) > 3.0
    assert clearance(STANDING[1], far, 3.0) == pytest.approx(3.0)
    assert clearance(STANDING[0], far, 3.0) == pytest.approx(-3.0)


def test_a_circle_about_each_group_holds_it_and_the_last_box_is_scratch() -> None:
    for g, (x, y, radius) in enumerate(CIRCLES.tolist()):
        first, end = g * kernel.GROUP, min((g + 1) * kernel.GROUP, len(BOXES) - 1)
        group = shape(BOXES[[*range(first, end), -1]])
        assert shapely.Point(x, y).buffer(radius + 1e-3, quad_segs=64).contains(group)
    before = clearance(STANDING[2], (1.0, 2.0, 0.3))
    BOXES[-1] = 99.0
    assert clearance(STANDING[2], (1.0, 2.0, 0.3)) == before


def test_extent_and_smallest_circle_hold_all_and_are_no_larger() -> None:
    for angle in (0.0, 0.4, 2.0):
        out = np.empty(4)
        kernel.extent(BOXES, angle, out)
        low_x, low_y, high_x, high_y = moved((0.0, 0.0, angle)).bounds
        assert out == pytest.approx([low_x, high_x, low_y, high_y], abs=1e-12)
    circle = np.empty(3)
    kernel.smallest_circle(BOXES, circle)
    least = shapely.minimum_bounding_radius(COVERED)
    assert least - 1e-12 <= circle[2] <= (1.0 + 1.0 / kernel.CIRCLE_STEPS) * least
    corners = shapely.get_coordinates(COVERED) - circle[:2]
    assert np.hypot(*corners.T).max() == pytest.approx(circle[2])


def test_a_bench_that_cannot_stand_is_told() -> None:
    route, boxes = Route((Spiral(1.1, 9.0 * math.pi, 3.0 * math.pi),)), np.zeros((3, BOX_COLUMNS))
    sizes = np.array([[2.0], [0.4], [0.15], [0.15]])
    for at, stands in (([3.0, 5.0], True), ([3.0, 500.0], False)):
        scratch = empty_placements(2, 2)
        link, front = np.array([1.7]), np.array(at)
        assert kernel.lay_boxes(route.rows, link, sizes, 0, front, scratch, 0, boxes) is stands
