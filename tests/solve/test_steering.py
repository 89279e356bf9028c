"""How well a troupe steers, found again from how far benches come off the line."""

import math

import pytest

from benchdragon import InputError, NoSolutionError, Walk, steering_gain
from benchdragon import off_tracking as asked
from tests.analysis.test_off_tracking import bend, dragon


def test_a_gain_is_found_again_from_what_a_troupe_measures() -> None:
    walk = Walk(dragon(12), bend(past=40.0))
    for gain in (0.05, 0.4):
        offset = asked(walk, gain).benches[9].left
        assert steering_gain(walk, 10, offset) == pytest.approx(gain, abs=1e-5)


def test_a_gain_is_not_told_from_a_bench_that_had_not_left_the_bend() -> None:
    short = Walk(dragon(12), bend(past=10.0))
    with pytest.raises(NoSolutionError, match="the walk ends before bench 12 has left the bend"):
        steering_gain(short, 12, 0.3)


def test_a_gain_is_found_where_bearers_who_steer_less_would_fold() -> None:
    tight = Walk(dragon(4), bend(1.2, 200.0, 40.0))
    assert asked(tight, 0.0).farthest() == math.inf
    offset = asked(tight, 6.0).benches[1].left
    assert steering_gain(tight, 2, offset) == pytest.approx(6.0, rel=1e-3)


def test_what_no_gain_explains_is_refused() -> None:
    walk = Walk(dragon(12), bend(past=40.0))
    for offset in (4.0, 1e-4):
        with pytest.raises(NoSolutionError, match="no steering gain from 0 to 10 per metre"):
            steering_gain(walk, 10, offset)
    with pytest.raises(InputError, match="bench must be a whole number from 1 to 12, not 13"):
        steering_gain(walk, 13, 0.5)
