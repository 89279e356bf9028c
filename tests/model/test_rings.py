"""Closed lines: measured, and their nearest points found, as Shapely does."""

import numpy as np
import pytest
import shapely
from shapely.ops import substring

from benchdragon.model.rings import (
    area_of,
    gate_in,
    holds,
    length_of,
    nearest_on,
    outermost,
    place_on,
    ring_of,
    round_ring,
    stretch,
)

# A star with hollows between its arms, not about the origin.
DICE = np.random.default_rng(40)
TURNS = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
REACH = np.where(np.arange(24) % 2, 3.0, 8.0) + DICE.uniform(0.0, 1.0, 24)
STAR = [(100.0 + r * np.cos(t), -40.0 + r * np.sin(t)) for r, t in zip(REACH, TURNS, strict=True)]
RING = [*STAR, STAR[0]]
PLACES = [(100.0 + x, -40.0 + y) for x, y in DICE.uniform(-10.0, 10.0, (500, 2))]


@pytest.mark.parametrize("ring", [RING, RING[::-1]], ids=["left", "right"])
def test_rings_are_measured_as_shapely_measures_them(ring: list[tuple[float, float]]) -> None:
    true, line = shapely.Polygon(ring), shapely.LinearRing(ring)
    assert area_of(ring) == pytest.approx(true.area, rel=1e-12)
    assert length_of(ring) == pytest.approx(true.length, rel=1e-12)
    inside = [holds(ring, place) for place in PLACES]
    assert inside == [true.contains(shapely.Point(place)) for place in PLACES]
    assert 50 < sum(inside) < 450
    for place in PLACES:
        away, along = nearest_on(ring, place)
        assert away == pytest.approx(line.distance(shapely.Point(place)), abs=1e-11)
        foot = place_on(ring, along)
        assert np.hypot(foot[0] - place[0], foot[1] - place[1]) == pytest.approx(away, abs=1e-9)


def test_a_place_at_the_end_of_a_ring_is_its_beginning() -> None:
    assert place_on(RING, 0.0) == RING[0]
    assert place_on(RING, length_of(RING) + 1e-9) == RING[-1]


def test_a_stretch_of_a_ring_goes_from_one_way_along_it_to_another() -> None:
    whole = length_of(RING)
    twice = shapely.LineString([*RING, *RING[1:]])  # from one round before its beginning on
    for begin, size in DICE.uniform([-0.9 * whole, 0.01], [0.9 * whole, 0.9 * whole], (60, 2)):
        part = shapely.LineString(stretch(RING, begin, begin + size))
        at = begin % whole
        true = substring(twice, at, at + size)
        assert part.length == pytest.approx(size)
        assert part.hausdorff_distance(true) < 1e-9
        assert part.coords[0] == pytest.approx(true.coords[0])
    assert stretch(RING, 0.0, whole) == [*STAR, STAR[0]]
    assert ring_of(STAR) == RING


def test_rings_within_others_are_left_out() -> None:
    within = [(100.0 + 0.1 * (x - 100.0), -40.0 + 0.1 * (y + 40.0)) for x, y in RING]
    beside = [(x + 50.0, y) for x, y in RING]
    assert outermost([within, RING, beside]) == [RING, beside]


def test_the_ring_about_a_circle_holds_it_and_hardly_more() -> None:
    ring = shapely.Polygon(round_ring((3.0, -2.0), 4.0))
    circle = shapely.Point(3.0, -2.0).buffer(4.0 - 1e-9, 256)
    assert ring.covers(circle)
    assert ring.area < 1.001 * circle.area


YARD = ring_of([(0.0, 0.0), (20.0, 0.0), (20.0, 10.0), (0.0, 10.0)])


def test_a_gate_is_where_a_way_from_outside_first_crosses_a_ring() -> None:
    through = [(-5.0, 4.0), (10.0, 4.0), (30.0, 4.0), (10.0, 20.0)]
    assert gate_in(YARD, through, 3.0) == pytest.approx((54.5, 57.5))
    assert gate_in(YARD, through[1:], 3.0) is None  # it comes from within
    assert gate_in(YARD, [(-5.0, 4.0), (-5.0, 20.0)], 3.0) is None
    assert gate_in(YARD, through, 60.0) is None  # as long as the ring
