"""What repeats on a small route, and which spans of a way are left to be searched."""

import math

import pytest

from benchdragon import Arc, Dragon, Line, Route, Walk
from benchdragon.analysis.rounds import Rounds, repeats, returns
from benchdragon.kernels.spans import BEYOND_ROUND, RepeatSpan

HALF: list[Line | Arc] = [Line(9.0), Arc(4.0, math.pi)]
ROUND = 9.0 + 4.0 * math.pi
WALK = Walk(Dragon.uniform(3), Route.joined([*HALF * 12, Line(2.0)]))


def test_a_round_is_left_out_once_all_benches_walked_it() -> None:
    (first, last), (tail, end) = Rounds(WALK, repeats(WALK.route.rows)).new(0.0, 12.0 * ROUND + 2.0)[0]
    assert first == 0.0
    # The tail comes to the route some links after the head.
    assert 2.0 * 1.65 + ROUND < last < 8.0 + ROUND
    assert tail == pytest.approx(12.0 * ROUND - BEYOND_ROUND, abs=1e-9)
    assert end == 12.0 * ROUND + 2.0


def test_a_search_that_begins_later_looks_at_a_round_of_its_own() -> None:
    ((first, last),), missed = Rounds(WALK, repeats(WALK.route.rows)).new(100.0, 200.0)
    assert (first, missed) == (100.0, 0.0)
    assert last == pytest.approx(100.0 + ROUND, abs=1e-5)


def test_what_rounds_miss_adds_up() -> None:
    known = returns(WALK.route.rows, 2.0)
    spans, missed = Rounds(WALK, known).new(0.0, 12.0 * ROUND)
    assert spans[-1][1] < 80.0
    assert 0.0 < missed == known[known[:, RepeatSpan.MISSED] > 0.0, RepeatSpan.MISSED].sum()


def test_what_does_not_repeat_is_searched_whole() -> None:
    walk = Walk(Dragon.uniform(3), Route((Line(20.0),)))
    assert Rounds(walk, repeats(walk.route.rows)).new(9.0, 15.0) == ([(9.0, 15.0)], 0.0)
    assert Rounds(walk, repeats(walk.route.rows)).new(9.0, 9.0) == ([(9.0, 9.0)], 0.0)
