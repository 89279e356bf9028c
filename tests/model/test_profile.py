"""The head's speed over time."""

import itertools
import math
from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from benchdragon import InputError, SpeedProfile
from benchdragon.model.profile import MOST_SPEED

UNEVEN = SpeedProfile((-3.0, 2.0, 2.5, 7.0, 9.0), (1.0, 0.4, 0.0, 0.0, 2.0))


def integral(profile: SpeedProfile, t: float) -> float:
    """Of the speed from 0 to t, by quadrature between knots."""
    inner = [knot for knot in profile.times if min(0.0, t) < knot < max(0.0, t)]
    stops = sorted({0.0, t, *inner}, reverse=t < 0.0)
    return math.fsum(
        quad(lambda a: float(profile.speed(a)), a, b, epsabs=1e-13)[0]
        for a, b in itertools.pairwise(stops)
    )


@pytest.mark.parametrize("t", [-50.0, -3.0, -1.0, 0.0, 1.0, 2.0, 2.2, 2.5, 5.0, 7.0, 8.0, 9.0, 40.0])
def test_distance_is_the_integral_of_the_speed(t: float) -> None:
    assert UNEVEN.distance(t) == pytest.approx(integral(UNEVEN, t), rel=1e-13, abs=1e-13)


@pytest.mark.parametrize(
    ("t", "distance"),
    [(-5.0, "-4.55"), (-3.0, "-2.55"), (0.0, "0"), (1.0, "0.65"), (2.0, "1.2"), (2.25, "1.29375"),
     (2.5, "1.325"), (7.0, "1.325"), (8.0, "1.825"), (9.0, "3.325"), (10.5, "6.325")],
)  # fmt: skip
def test_the_exact_distance_has_no_rounding(t: float, distance: str) -> None:
    profile = SpeedProfile((-3.0, 2.0, 2.5, 7.0, 9.0), (1.0, 0.5, 0.0, 0.0, 2.0))
    assert profile.exact_distance(t) == Fraction(distance)
    assert profile.distance(t) == pytest.approx(float(distance), rel=1e-14)


@given(
    st.lists(st.floats(0.01, 20.0), min_size=1, max_size=6),
    st.lists(st.floats(0.0, 5.0), min_size=7, max_size=7),
    st.floats(-60.0, 60.0),
    st.floats(-30.0, 30.0),
)
def test_distance_is_the_integral_of_any_profile(
    gaps: list[float], speeds: list[float], first: float, t: float
) -> None:
    times = tuple(itertools.accumulate(gaps, initial=first))
    profile = SpeedProfile(times, tuple(speeds[: len(times)]))
    assert profile.distance(t) == pytest.approx(integral(profile, t), rel=1e-12, abs=1e-11)


def test_the_head_stands_still_at_a_stop() -> None:
    rest = UNEVEN.distance([2.5, 3.0, 5.0, 7.0])
    assert (rest == rest[0]).all()
    assert UNEVEN.speed(5.0) == 0.0
    assert (SpeedProfile.constant(0.0).distance([-5.0, 0.0, 5.0]) == 0.0).all()


def test_speed_is_constant_before_the_first_knot_and_after_the_last() -> None:
    assert UNEVEN.speed([-1e6, -3.0]).tolist() == [1.0, 1.0]
    assert UNEVEN.speed([9.0, 1e6]).tolist() == [2.0, 2.0]
    assert UNEVEN.distance(-13.0) - UNEVEN.distance(-3.0) == pytest.approx(-10.0, abs=1e-14)
    assert UNEVEN.distance(19.0) - UNEVEN.distance(9.0) == pytest.approx(20.0, abs=1e-13)


def test_speed_meets_its_knots_and_is_linear_between() -> None:
    assert UNEVEN.speed(UNEVEN.times).tolist() == list(UNEVEN.speeds)
    assert UNEVEN.speed(8.0) == 1.0
    assert UNEVEN.speed(-0.5) == pytest.approx(0.7, abs=1e-15)


def test_acceleration_is_the_slope_and_at_a_knot_that_of_the_span_after_it() -> None:
    found = UNEVEN.acceleration([-4.0, -3.0, 0.0, 2.0, 2.4, 2.5, 5.0, 7.0, 8.0, 9.0, 10.0])
    wanted = [0.0, -0.12, -0.12, -0.8, -0.8, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0]
    np.testing.assert_allclose(found, wanted, rtol=0.0, atol=1e-15)


def test_a_constant_speed_covers_speed_times_time() -> None:
    profile = SpeedProfile.constant(1.5)
    assert profile.distance([-2.0, 0.0, 4.0]).tolist() == [-3.0, 0.0, 6.0]
    assert profile.distance(4.0).shape == ()
    assert (profile.acceleration([-1.0, 0.0, 1.0]) == 0.0).all()


def test_time_zero_may_lie_before_between_or_after_the_knots() -> None:
    for shift in (-20.0, -5.0, 0.0, 5.0, 20.0):
        moved = SpeedProfile(tuple(t + shift for t in UNEVEN.times), UNEVEN.speeds)
        assert moved.distance(0.0) == 0.0
        a, b = moved.distance([2.0 + shift, 8.0 + shift])
        assert b - a == pytest.approx(UNEVEN.distance(8.0) - UNEVEN.distance(2.0), abs=1e-13)


WRONG: list[tuple[Callable[[], object], str]] = [
    (lambda: SpeedProfile((), ()), r"at least one, not 0 and 0$"),
    (lambda: SpeedProfile((0.0,), (1.0, 2.0)), r"as many times as speeds, at least one, not 1 and 2$"),
    (lambda: SpeedProfile((0.0, math.nan), (1.0, 1.0)), r"^profile.* must be finite, not nan s$"),
    (lambda: SpeedProfile((math.inf,), (1.0,)), r"^profile.* must be finite, not inf s$"),
    (lambda: SpeedProfile(("noon",), (1.0,)), r"^times must be numbers, not .*'noon'"),  # type: ignore[arg-type]
    (lambda: SpeedProfile((0.0, 0.0), (1.0, 1.0)), r"^the times of a speed profile must increase$"),
    (lambda: SpeedProfile((2.0, 1.0), (1.0, 1.0)), r"^the times of a speed profile must increase$"),
    (lambda: SpeedProfile.constant(-1.0), r"^speed must not be negative, but is -1.0 m/s$"),
    (lambda: SpeedProfile.constant(math.nan), r"^speed must be finite, not nan m/s$"),
    (lambda: SpeedProfile.constant(math.inf), r"^speed must be finite, not inf m/s$"),
    (lambda: SpeedProfile.constant(2.0 * MOST_SPEED), r"^speed must be at most 100 m/s, not 200 m/s$"),
    (lambda: SpeedProfile.constant("fast"), r"^speeds must be numbers, not .*'fast'"),  # type: ignore[arg-type]
]


@pytest.mark.parametrize(("make", "wanted"), WRONG)
def test_a_profile_that_cannot_be_is_refused(make: Callable[[], object], wanted: str) -> None:
    with pytest.raises(InputError, match=wanted):
        make()


def test_stretches_tell_when_the_head_is_where() -> None:
    profile = SpeedProfile((0.0, 2.0, 5.0, 6.0, 7.0), (0.4, 1.2, 0.3, 0.0, 0.8))
    stretches = profile.stretches(-1.0, 8.0).moved(3.0)
    assert stretches.times.tolist() == [[-1, 0], [0, 2], [2, 5], [5, 6], [6, 7], [7, 8]]
    assert stretches.rates == pytest.approx([0.0, 0.4, -0.3, -0.3, 0.8, 0.0])
    for n, (start, end) in enumerate(stretches.times):
        for t in np.linspace(start, end, 7).tolist():
            way = 3.0 + float(profile.distance(t))
            assert stretches.time(n, way) == pytest.approx(t, abs=1e-7)
