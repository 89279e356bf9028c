"""How far benches leave the route whose bearers follow: beside closed forms and another method."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.spatial import KDTree

from benchdragon import (
    Arc,
    Bench,
    Dragon,
    InputError,
    Line,
    Route,
    Walk,
    WalkError,
    read_plan,
)
from benchdragon import off_tracking as asked
from benchdragon.analysis.off_tracking import OffTracking

LINK = 1.5


def dragon(benches: int, link: float = LINK) -> Dragon:
    return Dragon([Bench(link + 0.3, front_inset=0.15, rear_inset=0.15)] * benches)


def bend(radius: float = 5.0, turned: float = 90.0, past: float = 150.0) -> Route:
    return Route.joined([Line(20.0), Arc(radius, degrees=turned), Line(past)])


def sides(found: OffTracking) -> tuple[list[float], list[float]]:
    return [one.left for one in found.benches], [one.right for one in found.benches]


# Computed elsewhere, by a Runge-Kutta method of its own that agrees with itself to 2e-5 m.
@pytest.mark.parametrize(
    ("gain", "inside"),
    [(0.0, {1: 0.22753, 10: 1.918}), (0.2, {1: 0.17636, 10: 0.68652, 30: 0.72209, 60: 0.72218})],
)
def test_benches_cut_a_bend_as_far_as_others_computed(gain: float, inside: dict[int, float]) -> None:
    left, _right = sides(asked(Walk(dragon(max(inside)), bend()), gain))
    assert {n: left[n - 1] for n in inside} == pytest.approx(inside, abs=5e-4)


def test_who_only_follows_cuts_a_bend_as_an_integrator_of_scipy_has_it() -> None:
    """Also by more than its radius: distances are to the nearest of points 2 mm apart."""
    benches, route = 60, bend()
    found = asked(Walk(dragon(benches), route), 0.0)

    def changes(s: float, angles: np.ndarray) -> np.ndarray:
        heading = route.heading([s])[0]
        way, out = np.array([math.cos(heading), math.sin(heading)]), np.empty(benches)
        for n, angle in enumerate(angles):
            along = np.array([math.cos(angle), math.sin(angle)])
            out[n] = (along[0] * way[1] - along[1] * way[0]) / LINK
            way = along * (along @ way)
        return out

    heads = np.arange(0.0, route.length, 0.2)
    still = np.zeros(benches)
    turned = solve_ivp(changes, (0.0, heads[-1]), still, t_eval=heads, rtol=1e-8, atol=1e-8).y.T
    steps = LINK * np.stack([np.cos(turned), np.sin(turned)], axis=-1)
    places = route.point(heads)[:, None] - np.cumsum(steps, axis=1)
    line = route.point(np.arange(-benches * LINK, route.length, 0.002))
    apart = np.asarray(KDTree(line).query(places)[0])
    seen, far = sides(found)[0], apart.max(axis=0).tolist()
    assert far[-1] > 6.0
    assert seen[:20] == pytest.approx(far[:20], abs=2e-3)
    assert seen == pytest.approx(far, abs=0.08)
    errors = [one.left_error for one in found.benches]
    assert all(abs(a - b) <= error + 2e-3 for a, b, error in zip(seen, far, errors, strict=True))


@pytest.mark.parametrize("gain", [0.0, 0.3, 2.0])
def test_on_a_circle_handles_come_to_circles_of_their_own(gain: float) -> None:
    """Closed forms: a triangle of centre, front and rear handle whose rear one walks askew."""
    radius, benches = 9.0, 4
    route = Route((Arc(radius, 40.0, many=True),))
    left, right = sides(asked(Walk(dragon(benches), route, start=7.0), gain, 0.0, 350.0))
    radii = [radius]
    for _bench in range(benches):

        def front(r: float) -> float:
            askew = math.sin(math.atan(gain * (r - radius)))
            return r * r + LINK * LINK + 2.0 * r * LINK * askew - radii[-1] ** 2

        radii.append(brentq(front, 0.3 * radius, radius))
    assert left == pytest.approx([radius - one for one in radii[1:]], abs=1e-4)
    assert max(right) < 1e-6


def test_the_better_bearers_steer_the_nearer_they_keep_to_the_line() -> None:
    walk = Walk(dragon(20), bend())
    far = [asked(walk, gain).farthest(11) for gain in (0.0, 0.05, 0.1, 0.3, 1.0)]
    assert all(more > 1.2 * less for more, less in pairwise(far))


def test_a_bend_to_the_right_is_cut_to_the_right() -> None:
    mirrored = Route.joined([Line(20.0), Arc(5.0, degrees=-90), Line(150.0)])
    left, right = (sides(asked(Walk(dragon(12), route), 0.1)) for route in (bend(), mirrored))
    assert left[0] == pytest.approx(right[1], abs=1e-9)
    assert max(right[0]) < 1e-3


def test_rounding_is_not_taken_for_an_offset() -> None:
    found = asked(read_plan("spiral-in", ["dragon.benches=12"]), 0.2, 0.0, 4.0)
    assert [one.left for one in found.benches] == [0.0] * 12
    last = found.benches[-1]
    assert found.farthest(12) == last.right + last.right_error


def test_where_the_head_was_when_a_bench_was_farthest_off_is_told() -> None:
    found = asked(Walk(dragon(10), bend()), 0.2)
    ways = [one.left_at for one in found.benches]
    assert ways == sorted(ways)
    assert all(20.0 < way - n * LINK < 31.0 for n, way in enumerate(ways, start=1))


def test_the_error_told_is_no_less_than_what_finer_steps_change(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    walk = Walk(dragon(12), bend(3.0, 200.0, 60.0))
    usual = asked(walk, 0.15)
    monkeypatch.setattr("benchdragon.analysis.off_tracking.STEP", 0.02)
    fine = asked(walk, 0.15)
    for one, other in zip(usual.benches, fine.benches, strict=True):
        assert abs(one.left - other.left) <= one.left_error
        assert abs(one.right - other.right) <= one.right_error
        assert other.left_error < 0.5 * one.left_error
    assert usual.farthest() >= max(max(one.left, one.right) for one in fine.benches)


def test_a_bend_that_is_too_tight_to_be_followed_is_said_to_fold_benches() -> None:
    found = asked(read_plan("turn", ["dragon.benches=5"]), 1.0)
    assert found.benches == ()
    assert found.farthest() == math.inf


def test_wrong_input_is_refused() -> None:
    walk = Walk(dragon(12), bend(past=40.0))
    with pytest.raises(InputError, match="first must be a whole number from 1 to 12, not 0"):
        asked(walk, 0.2).farthest(0)
    with pytest.raises(InputError, match="gain must not be negative"):
        asked(walk, -0.1)


def test_a_dragon_that_cannot_stand_at_the_start_is_refused() -> None:
    with pytest.raises(WalkError):
        asked(Walk(dragon(12), Route((Arc(5.0, 3.0),)), start=1.0), 0.2)
