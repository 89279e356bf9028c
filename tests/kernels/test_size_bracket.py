"""The bracket of a size, by trials whose results are made up."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from benchdragon.kernels import size_bracket as bracket
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.size_bracket import Bracket, SizeVerdict


def opened(
    good: float, bad: float, *, tried: bool, sense: float = 1.0
) -> tuple[FloatArray, FloatArray]:
    """A bracket from one size to another, and room for doubts."""
    state = np.zeros(bracket.BRACKET_NUMBERS)
    state[[Bracket.SENSE, Bracket.TOLERANCE, Bracket.SLACK]] = sense, 1e-9, 1e-13
    state[[Bracket.CAUTION, Bracket.GOOD, Bracket.BAD]] = bracket.FIRST_CAUTION, good, bad
    state[Bracket.TRIED] = float(tried)
    return state, np.empty(bracket.MOST_TRIALS + bracket.MOST_GROWTHS)


def narrowed(
    state: FloatArray, doubts: FloatArray, result: Callable[[float], int], root: float = math.nan
) -> list[float]:
    """Try sizes until it is over; which."""
    tried: list[float] = []
    while not bracket.is_over(state, doubts):
        assert len(tried) < bracket.MOST_TRIALS
        state[[Bracket.ROOT, Bracket.SLOPE]] = root, 1.0
        bracket.next_target(state, doubts, not math.isnan(root))
        tried.append(float(state[Bracket.SIZE]))
        bracket.take_result(state, doubts, result(tried[-1]), False)
    return tried


@pytest.mark.parametrize(("good", "bad", "sense"), [(2.0, 0.02, 1.0), (2.0, 200.0, -1.0)])
@pytest.mark.parametrize("tried", [True, False])
def test_a_bracket_is_halved_without_roots(good: float, bad: float, sense: float, tried: bool) -> None:
    state, doubts = opened(good, bad, tried=tried, sense=sense)
    truth = 0.7 if sense > 0.0 else 7.0
    narrowed(
        state,
        doubts,
        lambda size: SizeVerdict.PASSES if (size - truth) * sense >= 0.0 else SizeVerdict.FAILS,
    )
    assert abs(state[Bracket.GOOD] - state[Bracket.BAD]) <= 1e-9
    assert min(state[[Bracket.GOOD, Bracket.BAD]]) <= truth <= max(state[[Bracket.GOOD, Bracket.BAD]])


def test_a_root_is_passed_on_the_safe_side_by_what_rounding_and_tolerance_allow() -> None:
    for sense in (1.0, -1.0):
        for slope, caution in ((1.0, 2.5), (1e-6, 2.5), (1e-6, 40.0)):
            state, doubts = opened(2.0, 1.0 if sense > 0.0 else 3.0, tried=True, sense=sense)
            state[[Bracket.ROOT, Bracket.SLOPE, Bracket.CAUTION]] = 2.0 - 0.4 * sense, slope, caution
            bracket.next_target(state, doubts, True)
            shift = state[Bracket.SHIFT]
            assert shift >= max(0.25e-9, caution * 1e-13 / slope)
            assert state[Bracket.SIZE] == 2.0 - 0.4 * sense + sense * shift


def test_roots_outside_of_the_bracket_and_those_that_failed_twice_are_not_gone_by() -> None:
    state, doubts = opened(2.0, 1.0, tried=True)
    for root, failures in ((0.9, 0.0), (2.1, 0.0), (1.4, bracket.MOST_FAILURES)):
        state[[Bracket.ROOT, Bracket.SLOPE, Bracket.FAILURES]] = root, 1.0, failures
        bracket.next_target(state, doubts, True)
        assert state[Bracket.SHIFT] == 0.0
        assert state[Bracket.SIZE] == pytest.approx(math.sqrt(2.0))
        assert state[Bracket.FAILURES] == 0.0


def test_a_pair_that_fails_again_beyond_its_root_makes_the_next_shift_longer() -> None:
    state, doubts = opened(2.0, 1.0, tried=True)
    for shift, same, more in ((0.0, True, 1.0), (1e-9, False, 1.0), (1e-9, True, bracket.MORE_CAUTION)):
        state[[Bracket.SIZE, Bracket.SHIFT, Bracket.CAUTION]] = 1.5, shift, 2.5
        bracket.take_result(state, doubts, SizeVerdict.FAILS, same)
        assert state[Bracket.CAUTION] == 2.5 * more


@pytest.mark.parametrize("band", [(0.69, 0.71), (0.6, 0.9), (0.1, 0.3), (0.8, 1.9)])
def test_undecided_sizes_are_looked_at_from_both_sides(band: tuple[float, float]) -> None:
    state, doubts = opened(2.0, 0.02, tried=True)

    def result(size: float) -> int:
        if band[0] < size < band[1]:
            return SizeVerdict.UNDECIDED
        return SizeVerdict.PASSES if size >= 0.7 else SizeVerdict.FAILS

    narrowed(state, doubts, result)
    good, bad = state[Bracket.GOOD], state[Bracket.BAD]
    if band[0] < 0.7 < band[1]:
        assert bad <= band[0]
        assert band[1] <= good
        assert good - bad < 1.2 * (band[1] - band[0])
        assert state[Bracket.BESIDE] == bracket.MOST_BESIDE
    else:
        assert bad <= 0.7 <= good <= bad + 1e-9


def test_a_bracket_without_doubts_goes_on_though_enough_were_tried_beside_others() -> None:
    state, doubts = opened(2.0, 1.0, tried=True)
    state[Bracket.BESIDE] = bracket.MOST_BESIDE
    assert not bracket.is_over(state, doubts)
    doubts[0], state[Bracket.DOUBTS] = 1.5, 1.0
    assert bracket.is_over(state, doubts)
    doubts[0] = 2.5  # outside
    assert not bracket.is_over(state, doubts)


def test_the_doubt_next_to_an_end_is_the_nearest_inside() -> None:
    state, doubts = opened(2.0, 1.0, tried=True)
    doubts[:5], state[Bracket.DOUBTS] = (1.4, 1.2, 1.9, 2.5, 0.5), 5.0
    assert bracket.doubt_next_to(state, doubts, 1.0) == 1.2
    assert bracket.doubt_next_to(state, doubts, 2.0) == 1.9
    state[Bracket.DOUBTS] = 0.0
    assert math.isnan(bracket.doubt_next_to(state, doubts, 1.0))
