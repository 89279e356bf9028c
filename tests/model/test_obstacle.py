"""Obstacles: what they are made of, and what cannot be one."""

import math
from collections.abc import Callable

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from benchdragon.errors import InputError
from benchdragon.model.obstacle import MOST_CORNERS, Obstacle

SQUARE = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
COORDINATES = st.integers(-20_000, 20_000).map(lambda millimetres: 1e-3 * millimetres)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: Obstacle.circle("well", (0, 0), 0.0), "radius must be positive"),
        (lambda: Obstacle.circle("well", (0, math.nan), 1.0), "within 1e8 m"),
        (lambda: Obstacle.circle("well", (0,), 1.0), "expected a list of points"),  # type: ignore[arg-type]
        (lambda: Obstacle.rectangle("car", (0, 0), (1, 0)), "car: size must be positive"),
        (lambda: Obstacle.rectangle("car", (0, 0), (1, math.nan)), "car: size"),
        (lambda: Obstacle.rectangle("car", (0, 0), (1, 1, 1)), "car: size"),  # type: ignore[arg-type]
        (lambda: Obstacle.rectangle("car", (0, 0), (1, 1), math.nan), "car: angle must be finite"),
        (lambda: Obstacle.rectangle("car", (0, 0), (1, 1), math.inf), "car: angle must be finite"),
        (lambda: Obstacle.rectangle("car", (1e7, 0), (1e-9, 1)), "car: points 1 and 2 are the same"),
        (lambda: Obstacle.polygon("house", SQUARE[:2]), "expected 3 to"),
        (
            lambda: Obstacle.polygon("house", [(0, 0), (1, 1), (2, 2)]),
            "sides 1 and 2|no area|meet itself",
        ),
        (
            lambda: Obstacle.polygon("house", [(0, 0), (4, 4), (4, 0), (0, 4)]),
            "house: its sides 1 and 3 cross or touch",
        ),
        (
            lambda: Obstacle.polygon("house", [(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)]),
            "house: its sides .* cross or touch",
        ),
        (lambda: Obstacle.polygon("house", [(0, 0), (4, 0), (2, 0), (2, 3)]), "cross or touch"),
        (
            lambda: Obstacle.venue("venue", [(0, 0), (0, 0), (4, 0), (4, 4)]),
            "points 1 and 2 are the same",
        ),
        (lambda: Obstacle.line("rope", [(0, 0)]), "expected 2 to"),
        (lambda: Obstacle.line("rope", [(0, 0), (1, 1), (1, 1)]), "points 2 and 3 are the same"),
        (lambda: Obstacle.line("rope", "abc"), "must be numbers"),
        (lambda: Obstacle.line("rope", [(0, 0), (1e9, 0)]), "within 1e8 m"),
        (lambda: Obstacle.line("rope", np.zeros((MOST_CORNERS + 1, 2))), "to 5000 points, not 5001"),
        (lambda: Obstacle.line("rope", SQUARE, margin=-1.0), "margin must not be negative"),
    ],
)
def test_what_cannot_be_an_obstacle_is_refused_in_one_sentence(
    make: Callable[[], Obstacle], sentence: str
) -> None:
    with pytest.raises(InputError, match=sentence) as caught:
        make()
    assert "\n" not in str(caught.value)


def test_a_closed_outline_may_repeat_its_first_corner() -> None:
    assert Obstacle.polygon("house", [*SQUARE, SQUARE[0]]) == Obstacle.polygon("house", SQUARE)
    assert len(Obstacle.line("rope", [*SQUARE, SQUARE[0]]).boxes) == 4


def test_its_boxes_are_its_sides() -> None:
    for obstacle, count in (
        (Obstacle.polygon("house", SQUARE), 4),
        (Obstacle.line("rope", SQUARE), 3),
        (Obstacle.circle("well", (3, 1), 0.6), 1),
    ):
        boxes = obstacle.boxes
        assert len(boxes) == count
        assert np.hypot(boxes[:, 2], boxes[:, 3]) == pytest.approx(np.ones(count), abs=1e-15)
        assert not boxes[:, 5].any()
    assert Obstacle.polygon("house", SQUARE).boxes[1].tolist() == [4.0, 2.0, 0.0, 1.0, 2.0, 0.0]


@given(st.lists(st.tuples(COORDINATES, COORDINATES), min_size=3, max_size=7), st.data())
def test_what_an_outline_forbids_is_what_shapely_says(
    corners: list[tuple[float, float]], data: st.DataObject
) -> None:
    polygon = shapely.Polygon(corners)
    try:
        obstacle = Obstacle.polygon("house", corners)
    except InputError:
        tiny = polygon.area < 1e-9 or min(map(math.dist, corners, [*corners[1:], corners[0]])) < 1e-5
        assert tiny or not polygon.is_valid
        return
    assert polygon.is_valid
    points = np.array(data.draw(st.lists(st.tuples(COORDINATES, COORDINATES), min_size=1, max_size=9)))
    for point, inside in zip(points, obstacle.forbids(points), strict=True):
        if polygon.exterior.distance(shapely.Point(point)) > 1e-9:
            assert inside == polygon.contains(shapely.Point(point))
    outside = Obstacle.venue("venue", corners).forbids(points)
    assert (outside != obstacle.forbids(points)).all()


def test_moving_is_turning_about_the_origin_and_then_shifting() -> None:
    moved = Obstacle.polygon("house", SQUARE, 0.3).moved(0.5 * math.pi, (1.0, 2.0))
    assert moved.outline == pytest.approx(np.array([(1, 2), (1, 6), (-3, 6), (-3, 2)]), abs=1e-15)
    assert (moved.name, moved.kind, moved.margin) == ("house", "polygon", 0.3)
