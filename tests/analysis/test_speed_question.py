"""The engine's question about greatest values on a small walk, which plain Python answers soon, too."""

import math

import numpy as np
import pytest

from benchdragon import (
    Arc,
    Clothoid,
    Dragon,
    Line,
    Route,
    SpeedProfile,
    Walk,
    budget,
)
from benchdragon.analysis.speed import QUANTITIES, PeakQuestion, Quantity, greatest, sought
from benchdragon.kernels.memory import held
from benchdragon.kernels.question import QuestionEnding
from benchdragon.kernels.speed_memory import SpeedTold
from benchdragon.kernels.speed_question import SpeedEnding
from benchdragon.plans.schema import checked
from benchdragon.progress import silent
from benchdragon.solve.head_speed import slowed
from tests.analysis.test_speed import with_room
from tests.solve.asked_in_python import in_python

ROUTE = Route.joined([Line(14.0), Arc(2.5, 1.2), Clothoid(3.0, 0.4, -0.3), Line(5.0)])
DRAGON = Dragon.of_sizes(np.array([1.6, 1.1, 1.1]), 0.2, 0.0, 0.0)
WALK = Walk(DRAGON, ROUTE, SpeedProfile((0.0, 2.0, 4.0), (0.5, 1.5, 1.0)), 9.0)
END = 12.0
EVEN = SpeedProfile.constant(1.0).stretches(9.0, 21.0)
SPEED, TOTAL = QUANTITIES["speed"], QUANTITIES["total_acceleration"]
TURNING, ACROSS = QUANTITIES["turning_rate"], QUANTITIES["lateral_acceleration"]


def numbers(quantity: Quantity, tolerance: float = 1e-2) -> tuple[float, float, float, int]:
    found = greatest(WALK, quantity, 0.0, END, tolerance=tolerance)
    return found.value, found.lower, found.upper, found.evaluations


def test_plain_python_answers_as_the_engine_does(monkeypatch: pytest.MonkeyPatch) -> None:
    """Within rounding, rooms made wider on the way and all."""
    with_room(monkeypatch, FIRST_OPEN=17, CELL_COST=0.0, BUDGET=400)
    answers = []
    for _asked in range(2):
        answers.append([numbers(quantity) for quantity in (SPEED, TOTAL)])
        in_python(monkeypatch)
    np.testing.assert_allclose(answers[1], answers[0], rtol=1e-12)


def test_rooms_that_grow_hold_what_was_there(monkeypatch: pytest.MonkeyPatch) -> None:
    with_room(monkeypatch, CELL_COST=0.0)
    wide = [numbers(quantity) for quantity in (SPEED, TOTAL)]
    with_room(monkeypatch, FIRST_OPEN=17)
    assert [numbers(quantity) for quantity in (SPEED, TOTAL)] == wide


@pytest.mark.parametrize("quantity", [TURNING, ACROSS], ids=["turning", "across"])
def test_every_window_is_searched(monkeypatch: pytest.MonkeyPatch, quantity: Quantity) -> None:
    value, lower, upper, _placed = numbers(quantity)
    with_room(monkeypatch, CELL_COST=0.0, MOST_CELLS=1)  # windows of a dragon's length
    _value, least, most, _placed = numbers(quantity)
    assert max(lower, least) <= min(upper, most)
    assert most <= 1.02 * value


def test_what_waits_where_too_much_does_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    value = numbers(ACROSS)[1]
    with_room(monkeypatch, FIRST_OPEN=30, MOST_OPEN=-1e9)
    seen, lower, upper, _placed = numbers(ACROSS, 1e-12)
    assert lower <= seen < value <= upper


def test_the_tightest_limit_decides_on_the_head_speed() -> None:
    limits = {"speed": 1.02, "turning_rate": 0.35, "lateral_acceleration": 9.0, "acceleration": 0.086}
    asked = [(QUANTITIES[name], 1e-3, limit) for name, limit in limits.items()]
    alone = [sought(WALK, EVEN, [one], silent, 100.0) for one in asked]
    found = sought(WALK, EVEN, asked, silent, 100.0)
    least = min(alone, key=lambda one: one.lower)
    assert found.decides is least.decides
    assert found.lower == pytest.approx(least.lower, rel=2e-3)
    assert found.lower <= found.upper <= found.lower * 1.002
    for (quantity, tolerance, limit), one in zip(asked, alone, strict=True):
        peak = sought(WALK, EVEN, [(quantity, tolerance, math.inf)], silent).peak
        assert one.lower == pytest.approx((limit / peak.upper) ** (1.0 / quantity.power), rel=2e-3)
    assert sought(WALK, EVEN, [(SPEED, 1e-3, 1e9)], silent, 100.0).decides is None


@pytest.mark.parametrize(("work", "cost"), [(800.0, 0.0), (3000.0, math.inf)])
def test_what_takes_too_much_work_is_told_as_far_as_it_was_seen(
    monkeypatch: pytest.MonkeyPatch, work: float, cost: float
) -> None:
    with_room(monkeypatch, BUDGET=500, CELL_COST=cost)
    monkeypatch.setattr(budget, "WORK", work)
    with budget.question():
        if cost == 0.0:
            with pytest.raises(budget.OverBudgetError, match="takes more work"):
                sought(WALK, EVEN, [(TOTAL, 1e-12, math.inf)], silent)
            return
        found = sought(WALK, EVEN, [(TOTAL, 1e-12, 0.3)], silent, 100.0)
    assert (found.lower, found.decides) == (0.0, TOTAL)
    assert found.peak.upper == math.inf
    assert found.upper == pytest.approx(math.sqrt(0.3 / found.peak.value))


@pytest.mark.parametrize("cost", [0.0, math.inf])
def test_a_dragon_that_cannot_stand_is_told_of(monkeypatch: pytest.MonkeyPatch, cost: float) -> None:
    with_room(monkeypatch, CELL_COST=cost)
    beyond = EVEN._replace(ways=np.array([[9.0, 30.0]]))
    with PeakQuestion(WALK, beyond, [(SPEED, 0.5, math.inf)]) as question:
        assert question.step() == SpeedEnding.FALLEN
        assert question.figures[[SpeedTold.LOW, SpeedTold.HIGH]].tolist() == [9.0, 30.0]


def test_a_question_that_is_closed_answers_no_more() -> None:
    before = held()
    with PeakQuestion(WALK, EVEN, [(SPEED, 1e-2, math.inf)]) as question:
        assert question.step() == SpeedEnding.DONE
    with pytest.raises(ValueError, match="closed"):
        question.step()
    nothing, table = np.empty(1), np.empty((1, 1, 2))
    assert question.bound(np.empty(2), 0, 1, 1.0, np.empty(6), nothing, table) == QuestionEnding.CLOSED
    assert held() == before


def test_a_pace_on_a_short_way_keeps_its_limits() -> None:
    parts = [{"kind": "line", "length": 6.0}, {"kind": "arc", "radius": 2.0, "angle": 60.0}]
    data = {
        "schema": 1, "dragon": {"benches": 2}, "limits": {"speed": 1.5, "lateral_acceleration": 0.3},
        "route": {"part": [*parts, {"kind": "line", "length": 3.0}]},
        "walk": {"speed": 1.4, "position": 5.0},
    }  # fmt: skip
    pace = slowed(checked(data, "short"))
    assert min(pace.profile.speeds) == pytest.approx(pace.steady.value, rel=0.02)
    assert max(pace.profile.speeds) > 1.1 * min(pace.profile.speeds)
    assert pace.saved > 0.0
