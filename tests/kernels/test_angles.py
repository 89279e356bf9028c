"""Sine and cosine of our own, against mpmath and the system's library."""

import math

import mpmath as mp
import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchdragon.kernels.angles import MOST_ANGLE, sincos, sincos_of, small_sincos


@given(st.floats(-0.25 * math.pi, 0.25 * math.pi))
def test_small_sine_and_cosine_are_right_to_two_units_of_rounding(x: float) -> None:
    sine, cosine = small_sincos(x)
    assert abs(sine - math.sin(x)) <= 2.0 * math.ulp(math.sin(x))
    assert abs(cosine - math.cos(x)) <= 2.0 * math.ulp(math.cos(x))


@given(st.floats(-MOST_ANGLE, MOST_ANGLE))
def test_sine_and_cosine_of_large_angles_are_right_to_rounding(x: float) -> None:
    sine, cosine = sincos(x)
    assert abs(sine - math.sin(x)) <= 4e-16
    assert abs(cosine - math.cos(x)) <= 4e-16


@pytest.mark.parametrize("quarters", [0, 1, 2, 3, 4, 5, 17, 1000, 636618])
@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("off", [-1e-9, 0.0, 1e-9, 0.25 * math.pi, 0.7853981633974484])
def test_sine_and_cosine_hold_at_and_between_quarter_turns(
    quarters: int, off: float, sign: float
) -> None:
    x = sign * abs(quarters * 0.5 * math.pi + off)
    sine, cosine = sincos(x)
    with mp.workdps(40):
        assert abs(mp.sin(mp.mpf(x)) - sine) <= 4e-16
        assert abs(mp.cos(mp.mpf(x)) - cosine) <= 4e-16


@pytest.mark.parametrize("x", [1.001e6, -3e7, 1e15])
def test_angles_too_large_to_be_reduced_go_to_the_library(x: float) -> None:
    assert sincos_of(x) == (math.sin(x), math.cos(x))
