"""Brackets hold wherever a dance is, however long its route or its dragon."""

import dataclasses
import math
from fractions import Fraction

import numpy as np
import pytest

from benchdragon import (
    Arc,
    Clothoid,
    Dragon,
    Line,
    Route,
    Spiral,
    UnsureError,
    Walk,
    first_contact,
    first_touch,
    least_clearance,
)
from benchdragon.analysis.check import check
from benchdragon.analysis.head_times import HeadTimes
from benchdragon.analysis.nearby import NOWHERE, checked_off, errors_at, origin_of, seen_from
from benchdragon.kernels.double_double import head_drift
from benchdragon.kernels.swept_boxes import MOST_OFF
from benchdragon.model.obstacle import Obstacle
from benchdragon.plans.schema import checked
from benchdragon.plans.toml import parsed
from benchdragon.solve.size import limit

TURN = 2.0 * math.pi
LOOP = Clothoid(8.0, 0.0, 0.5), Arc(2.0, 7.0)
TWENTY = Dragon.uniform(20)
LOOPED = """
schema = 1
[dragon]
benches = 12

[route]
kind = "parts"

[[route.part]]
kind = "line"
length = {length}

[[route.part]]
kind = "arc"
radius = 2.6
angle = 380

[walk]
start = {start}
end = {end}
"""
CIRCLE = """
schema = 1
[dragon]
benches = 6

[route]
kind = "parts"

[[route.part]]
kind = "arc"
radius = {radius}
angle = 350

[walk]
start = 13
end = 16

[limits]
speed = 1.0
"""


def looped(straight: float, x: float = 0.0, y: float = 0.0, heading: float = 0.0) -> Walk:
    """Twenty benches that walk straight on and then in a loop, where bench 1 meets bench 7."""
    line = Line(straight + 60.0, (x, y), heading)
    return Walk(TWENTY, Route.joined([line, *LOOP]), start=straight + 40.0)


# Straights along which one allowance for rounding, whatever the way, left the contact out.
@pytest.mark.parametrize(
    ("straight", "heading", "ease"),
    [
        (1043941.4007634982, 5.41329047829593, 6.908614095356825),
        (1442803.6791291672, 3.9939445017945205, 5.5335830218067725),
        (991725.2846124766, 4.054805189601155, 6.904155641901608),
        (716980.0264219951, 4.155312268263364, 8.082521932366975),
        (50.0, 0.0, 8.0),
    ],
)
def test_after_a_long_straight_the_bracket_holds_the_contact(
    straight: float, heading: float, ease: float
) -> None:
    pytest.importorskip("flint")
    from tests.exact_places import exact_contact

    start = -straight * math.cos(heading), -straight * math.sin(heading)
    pieces = Line(straight, start, heading), Clothoid(ease, 0.0, 0.5), Arc(2.0, 7.0)
    walk = Walk(TWENTY, Route.joined(pieces), start=straight - 20.0)
    found = first_contact(walk, 0.0, 40.0)
    assert found is not None
    assert found.witness is not None
    i, j = (number - 1 for number in found.witness.benches)
    after = exact_contact(walk, found.witness.s, i, j) - walk.start
    assert found.lower <= after <= found.upper
    assert found.upper - found.lower <= 8.0 * math.ulp(straight) + 3e-12


@pytest.mark.parametrize("far", [1e5, 1e6, 1e7])
def test_a_dance_far_away_is_searched_as_at_home(far: float) -> None:
    home, away = looped(0.0), looped(0.0, far, -0.3 * far)
    a, b = first_contact(home, 0.0, 40.0), first_contact(away, 0.0, 40.0)
    assert a is not None
    assert b is not None
    assert (b.lower, b.upper) == pytest.approx((a.lower, a.upper), rel=0.0, abs=4e-12)
    assert b.upper - b.lower < 1e-11
    c, d = (least_clearance(walk, 0.0, a.lower - 0.2) for walk in (home, away))
    assert (d.lower, d.upper) == pytest.approx((c.lower, c.upper), rel=0.0, abs=4e-12)
    assert d.upper - d.lower < 1e-11
    assert a.witness is not None
    assert b.witness is not None
    x, y = a.witness.point
    assert b.witness.point == pytest.approx((x + far, y - 0.3 * far), rel=0.0, abs=1e-6)


@pytest.mark.parametrize("far", [1e5, 1e6])
def test_obstacles_far_away_are_met_as_at_home(far: float) -> None:
    post = Obstacle.circle("post", (65.75, 3.5), 0.375)
    there = dataclasses.replace(post, outline=post.outline + np.array([far, -0.25 * far]))
    a = first_touch(looped(0.0), post, 0.0, 40.0)
    b = first_touch(looped(0.0, far, -0.25 * far), there, 0.0, 40.0)
    assert a is not None
    assert b is not None
    assert (b.lower, b.upper) == pytest.approx((a.lower, a.upper), rel=0.0, abs=1e-11)
    assert b.upper - b.lower < 1e-10


def test_sizes_are_sought_near_the_dance() -> None:
    plans = (
        LOOPED.format(length=length, start=length - 20.0, end=length + 15.0) for length in (60.0, 2e5)
    )
    home, away = (limit(checked(parsed(plan, "plan"), "plan"), "width") for plan in plans)
    assert away.value == pytest.approx(home.value, rel=0.0, abs=1e-9)
    # Along a line of 2e5 m doubles tell places 3e-11 m apart.
    assert away.lower <= home.upper
    assert home.lower <= away.upper
    assert away.upper - away.lower < 1e-6


def test_origins_are_whole_metres_and_only_where_it_pays() -> None:
    x = np.array([3.2e5 + 0.4, 3.2e5 - 5.0])
    assert origin_of(x, np.array([7.6, 8.0])) == (320000.0, 8.0)
    assert origin_of(np.array([90.0, 60.0]), np.array([3.0, 3.0])) == NOWHERE
    assert origin_of(np.array([500.0, -300.0]), np.array([3.0, 3.0])) == NOWHERE  # as wide as far
    assert origin_of(np.array([math.nan]), np.array([math.nan])) == NOWHERE
    walk = looped(0.0)
    assert seen_from(walk, NOWHERE) is walk


def test_a_route_seen_from_elsewhere_has_no_gaps() -> None:
    far = looped(0.0, 1e7, 3e6, 0.7).route
    near = far.seen_from((1e7, 3e6))
    assert near.rows[0, [7, 8]].tolist() == [0.0, 0.0]
    home = looped(0.0, 0.0, 0.0, 0.7).route
    s = np.linspace(0.0, home.length, 50)
    np.testing.assert_allclose(near.point(s), home.point(s), rtol=0.0, atol=1e-13)
    assert far.rows[0, 7] == 1e7  # as it was


def test_times_are_told_of_where_heads_exactly_stand() -> None:
    walk, drifts = Walk(TWENTY, Route((Spiral(1.7, TURN * 700.0, TURN * 20.0),))), []
    times = HeadTimes(walk, 0.0, 0.0)
    for s in np.linspace(1e5, 0.9 * walk.route.length, 20).tolist():
        drift, doubt = head_drift(walk.route.rows, s)
        _about, early, late = times.bracketed(s, s)
        # The head walks at 1 m/s.
        assert Fraction(early) <= Fraction(s) + Fraction(drift) - Fraction(doubt)
        assert Fraction(late) >= Fraction(s) + Fraction(drift) + Fraction(doubt)
        assert late - early <= 2.0 * abs(drift) + 4.0 * math.ulp(s)
        drifts.append(drift)
    assert max(drifts) > 5e-10  # what the length of 5000 km is rounded to


def test_what_rounding_hides_is_never_passed_over() -> None:
    assert checked_off(MOST_OFF) == MOST_OFF
    with pytest.raises(UnsureError, match=r"^rounding may hide 1\.0e-07 m of distances"):
        checked_off(1e-7)


def test_at_a_hundred_thousand_benches_the_tail_is_within_what_is_said() -> None:
    pytest.importorskip("flint")
    from tests.exact_places import exact_chain

    dragon = Dragon.uniform(100_000)
    route = Route((Spiral(1.7, TURN * 700.0, TURN * 20.0),))
    walk = Walk(dragon, route)
    s = 0.99 * route.length
    tail, placed = exact_chain(walk, s).handles[-1].pose, walk.placement(s)
    errors, _off = errors_at(walk, s)
    off = math.hypot(float(tail[0] - placed.x[0, -1]), float(tail[1] - placed.y[0, -1]))
    assert off <= errors[-1] + 1e-12  # the place itself is rounded as well
    assert off < 5e-12  # links rounded twice made 2e-11 of it
    assert errors[-1] < 3e-10


@pytest.mark.parametrize("radius", [5.0, 8.0, 10.0, 12.3])
def test_a_circle_walked_at_its_limit_is_safe(radius: float) -> None:
    plan = checked(parsed(CIRCLE.format(radius=radius), "plan"), "plan")
    report = check(plan)
    assert report.safe is not False
