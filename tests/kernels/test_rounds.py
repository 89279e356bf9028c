"""What repeats on a small route, and which spans of a way are left to be searched."""

import math

import numpy as np
import pytest

from benchdragon import Arc, Dragon, Line, Route, Walk, read_plan
from benchdragon.analysis.rounds import Rounds, repeats, returns
from benchdragon.kernels.curve import (
    CurveKind,
    FloatArray,
    RouteRow,
    heading,
    spiral_angle,
    spiral_length,
)
from benchdragon.kernels.rounding import KINK
from benchdragon.kernels.rounds import lever
from benchdragon.kernels.spans import BEYOND_ROUND, RepeatSpan

HALF: list[Line | Arc] = [Line(9.0), Arc(4.0, math.pi)]
ROUND = 9.0 + 4.0 * math.pi
WALK = Walk(Dragon.uniform(3), Route.joined([*HALF * 12, Arc(7.0, 0.3)]))


def test_a_round_is_left_out_once_all_benches_walked_it() -> None:
    (first, last), (tail, end) = Rounds(WALK, repeats(WALK.route.rows)).new(0.0, 12.0 * ROUND + 2.1)[0]
    assert first == 0.0
    # The tail comes to the route some links after the head.
    assert 2.0 * 1.65 + ROUND < last < 8.0 + ROUND
    assert tail == pytest.approx(12.0 * ROUND - BEYOND_ROUND, abs=1e-9)
    assert end == 12.0 * ROUND + 2.1


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


# Three rounds of a coil: a spiral in, the two arcs of the turn, a spiral out, and two arcs back to the
# next spiral in. The first spiral and the last are longer than those between.
ROUTE = read_plan("turn", ["route.rounds=3", "route.outer_radius=7"]).build().route
COIL, PERIOD = ROUTE.rows, 6


def of_the_coil(rows: FloatArray) -> tuple[float, float, float]:
    """From where to where a coil repeats itself, and its period, m."""
    known = repeats(rows)
    (found,) = known[known[:, RepeatSpan.PERIOD] > 0.0].tolist()
    return found[RepeatSpan.LOW], found[RepeatSpan.HIGH], found[RepeatSpan.PERIOD]


def test_rounds_of_a_coil_begin_and_end_within_longer_rows() -> None:
    low, high, period = of_the_coil(COIL)
    starts, ends = COIL[:, RouteRow.S_START], COIL[:, RouteRow.S_START] + COIL[:, RouteRow.LENGTH]
    assert COIL[0, RouteRow.LENGTH] > COIL[PERIOD, RouteRow.LENGTH] < COIL[-1, RouteRow.LENGTH]
    assert period == pytest.approx(starts[PERIOD + 1] - starts[1], abs=1e-12)
    assert low == pytest.approx(ends[0] - COIL[PERIOD, RouteRow.LENGTH], abs=1e-12)
    assert high == pytest.approx(starts[-1] + COIL[3, RouteRow.LENGTH], abs=1e-12)
    s = np.linspace(low, high - period, 200)[1:-1]
    before, after = ROUTE.curvature(s), ROUTE.curvature(s + period)
    assert before == pytest.approx(after, abs=1e-9)
    assert ROUTE.curvature(low - 1.0) != pytest.approx(ROUTE.curvature(low + period - 1.0), abs=1e-3)


@pytest.mark.parametrize(
    ("column", "value"),
    [
        (RouteRow.P, COIL[0, RouteRow.P] * (1.0 + 1e-12)),
        (RouteRow.KIND, CurveKind.LOG_SPIRAL),
        (RouteRow.ANGLE, COIL[0, RouteRow.ANGLE] + 2.0 * KINK),
    ],
)
def test_a_row_before_rounds_that_ends_otherwise_is_none_of_them(column: int, value: float) -> None:
    rows = COIL.copy()
    rows[0, column] = value
    assert of_the_coil(rows)[0] == rows[1, RouteRow.S_START]


def test_a_row_that_leads_back_by_a_kink_is_none_of_a_round() -> None:
    rows = COIL.copy()
    rows[PERIOD, RouteRow.ANGLE] += 2.0 * KINK
    known = repeats(rows)
    assert known[known[:, RepeatSpan.PERIOD] > 0.0, RepeatSpan.LOW].min() == rows[1, RouteRow.S_START]


def test_a_spiral_before_rounds_that_ends_farther_out_is_none_of_them() -> None:
    rows = COIL.copy()
    rows[0, RouteRow.U_END] += 0.1
    ended, ends = (heading(one, 0, one[0, RouteRow.U_END]) for one in (COIL, rows))
    rows[0, RouteRow.ANGLE] += ended - ends  # as if joined smoothly
    assert of_the_coil(rows)[0] == rows[1, RouteRow.S_START]


def test_a_spiral_that_is_walked_the_other_way_is_none_of_a_round() -> None:
    rows = COIL.copy()
    rows[0, RouteRow.U_START] = 0.5 * rows[0, RouteRow.U_END]
    rows[0, RouteRow.ANGLE] += math.pi
    assert of_the_coil(rows)[0] == rows[1, RouteRow.S_START]


def test_a_row_after_rounds_that_starts_otherwise_is_none_of_them() -> None:
    rows = COIL.copy()
    rows[-1, RouteRow.U_START] += 1e-9
    assert of_the_coil(rows)[1] == rows[-1, RouteRow.S_START]


def test_spirals_as_long_farther_out_do_not_repeat() -> None:
    rows = COIL.copy()
    k, u = rows[3, RouteRow.P], rows[3, RouteRow.U_START] + 0.5
    end = spiral_angle(k, spiral_length(k, u) + rows[3, RouteRow.LENGTH])
    rows[3, RouteRow.U_START], rows[3, RouteRow.U_END] = u, end
    rows[3:, RouteRow.ANGLE] += heading(COIL, 3, COIL[3, RouteRow.U_START]) - heading(rows, 3, u)
    rows[4:, RouteRow.ANGLE] += heading(rows, 3, end) - heading(rows, 4, 0.0)  # as if joined smoothly
    known = repeats(rows)
    again = known[known[:, RepeatSpan.PERIOD] > 0.0]
    amid = rows[3, RouteRow.S_START] + 0.5 * rows[3, RouteRow.LENGTH]
    assert len(again)
    assert not np.any(
        (again[:, RepeatSpan.LOW] < amid)
        & (amid < again[:, RepeatSpan.HIGH] - again[:, RepeatSpan.PERIOD])
    )


def test_a_spiral_is_turned_about_its_centre() -> None:
    assert lever(COIL, 3) == pytest.approx(7.0, abs=1e-9)
    assert COIL[1, RouteRow.LENGTH] == lever(COIL, 1)
