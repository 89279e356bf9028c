"""Runge-Kutta for the head's place: its order, and that it meets the closed form."""

import math

import numpy as np
import pytest

from benchdragon import Dragon, InputError, Line, Route, SpeedProfile, Spiral, TwoArcTurn, Walk
from benchdragon.kernels.curve import spiral_angle, spiral_length
from benchdragon.paper.runge_kutta import METHODS, MOST_STEPS, Method, head_angles, head_positions

TURN = TwoArcTurn(1.7).route()
TURNING = Walk(Dragon.uniform(3), TURN, start=float(TURN.joints[1]))
COILING = Walk(Dragon.uniform(3), Route((Spiral(0.55, 32.0 * math.pi, 4.0),)))
UNEVEN = SpeedProfile((-20.0, 10.0, 30.0, 40.0), (1.5, 0.5, 0.0, 2.0))


SPIRAL = Spiral(0.55, 32.0 * math.pi, 2.0)
OUTWARD = Spiral(1.7, 3.0, 60.0)
RAMP = SpeedProfile((-2.0, 4.0, 11.0), (0.5, 2.0, 1.2))


def closed_form(spiral: Spiral, profile: SpeedProfile, start: float, t: float) -> float:
    way = 1.0 if spiral.end_angle > spiral.start_angle else -1.0
    walked = start + float(profile.distance(t))
    return spiral_angle(spiral.k, spiral_length(spiral.k, spiral.start_angle) + way * walked)


def greatest_error(spiral: Spiral, method: Method, step: float = 0.1) -> float:
    """Distance along the spiral from the closed form, m, at its greatest."""
    times = [-7.0, 3.0, 20.0, 0.0, 11.0]
    found = head_angles(spiral, RAMP, 15.0, times, method, step)
    wanted = np.array([closed_form(spiral, RAMP, 15.0, t) for t in times])
    return float(np.abs((found - wanted) * spiral.k * np.hypot(1.0, wanted)).max())


@pytest.mark.parametrize("spiral", [SPIRAL, OUTWARD], ids=["inward", "outward"])
def test_the_adaptive_road_meets_the_closed_form(spiral: Spiral) -> None:
    assert greatest_error(spiral, "adaptive") <= 1e-9


@pytest.mark.parametrize("spiral", [SPIRAL, OUTWARD], ids=["inward", "outward"])
def test_runge_kutta_meets_the_closed_form_at_the_usual_step(spiral: Spiral) -> None:
    assert greatest_error(spiral, "rk4") <= 1e-9


def test_runge_kutta_is_of_fourth_order() -> None:
    # Near the centre theta changes fast enough for errors far above rounding.
    spiral = Spiral(0.55, 12.0, 0.5)
    length = spiral.length
    profile = SpeedProfile.constant(0.1)
    end = 0.95 * length / 0.1
    exact = closed_form(spiral, profile, 0.0, end)
    steps = end / np.array([64.0, 128.0, 256.0, 512.0])
    errors = [abs(float(head_angles(spiral, profile, 0.0, [end], "rk4", h)[0]) - exact) for h in steps]
    assert min(errors) > 1e-11
    slope = float(np.polyfit(np.log(steps), np.log(errors), 1)[0])
    assert slope == pytest.approx(4.0, abs=0.15)
    last = math.log(errors[2] / errors[3]) / math.log(2.0)
    assert last == pytest.approx(4.0, abs=0.05)


def test_runge_kutta_steps_end_at_knots_and_keep_the_order_there() -> None:
    # A knot inside a step would leave an error of second order.
    coarse, fine = greatest_error(OUTWARD, "rk4", 1.0), greatest_error(OUTWARD, "rk4", 0.5)
    assert fine < coarse / 10.0


@pytest.mark.parametrize("method", METHODS)
def test_angles_come_in_the_order_of_the_times(method: Method) -> None:
    times = [5.0, -5.0, 0.0, 2.0, 5.0]
    found = head_angles(SPIRAL, RAMP, 15.0, times, method)
    assert found.shape == (5,)
    assert found[0] == found[4]
    assert found[1] > found[2] > found[3] > found[0]
    assert found[2] == pytest.approx(float(SPIRAL.angle(15.0)), rel=1e-15)
    assert head_angles(SPIRAL, RAMP, 15.0, [], method).shape == (0,)


@pytest.mark.parametrize("step", [0.0, -0.1, math.nan, math.inf, "short"])
def test_a_step_that_cannot_be_is_refused(step: float) -> None:
    with pytest.raises(InputError, match=r"^step must be (positive|finite|a number), not "):
        head_angles(SPIRAL, RAMP, 15.0, [1.0], "rk4", step)


def test_more_steps_than_a_minute_of_work_are_refused() -> None:
    wanted = rf"^Runge-Kutta with a step of 1e-07 s would take over {MOST_STEPS} steps$"
    with pytest.raises(InputError, match=wanted):
        head_angles(SPIRAL, RAMP, 15.0, [1.0], "rk4", 1e-7)


@pytest.mark.parametrize("method", METHODS)
def test_every_road_leads_the_head_to_the_same_place(method: Method) -> None:
    times = [0.0, -3.0, 100.0, 250.0]
    exact = COILING.head_position(times)
    np.testing.assert_array_equal(exact, times)
    found = head_positions(COILING, times, method)
    np.testing.assert_allclose(found, exact, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("method", METHODS)
def test_integrating_works_outward_and_behind_other_curves(method: Method) -> None:
    route = Route.joined([Line(5.0), Spiral(1.7, 14.0, 60.0, (1.0, 2.0), 0.3, mirrored=True)])
    walk = Walk(Dragon.uniform(5), route, UNEVEN, start=40.0)
    times = [-20.0, 0.0, 35.0, 50.0]
    found = head_positions(walk, times, method)
    np.testing.assert_allclose(found, walk.head_position(times), rtol=0.0, atol=1e-9)


def test_the_step_of_runge_kutta_is_heeded() -> None:
    walk = Walk(Dragon.uniform(3), Route((Spiral(0.55, 30.0, 0.5),)))
    times = [0.9 * walk.route.length]
    exact = walk.head_position(times)
    coarse, fine = (head_positions(walk, times, "rk4", step) - exact for step in (1.0, 0.5))
    assert 0.0 < abs(fine[0]) < abs(coarse[0]) / 4.0


def test_integrating_needs_a_spiral_under_the_head() -> None:
    walk = Walk(Dragon.uniform(3), Route((Line(50.0),)), start=20.0)
    with pytest.raises(InputError, match=r"^rk4 integrates the equation of a spiral"):
        head_positions(walk, [1.0])
    with pytest.raises(InputError, match=r"^adaptive needs the head on one spiral at all times"):
        head_positions(TURNING, [-5.0, 0.0, 5.0], "adaptive")


def test_a_method_that_nobody_knows_is_refused() -> None:
    with pytest.raises(InputError, match=r"^method must be one of rk4, adaptive, not euler"):
        head_angles(SPIRAL, RAMP, 15.0, [1.0], "euler")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="euler"):
        head_positions(COILING, [0.0], "euler")  # type: ignore[arg-type]
