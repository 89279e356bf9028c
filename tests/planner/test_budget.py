"""compute/budget.js: the page counts what a question takes as Python does, and refuses the same."""

import re
from collections.abc import Callable
from typing import Any

import pytest

from benchdragon import budget
from benchdragon.analysis.check import check
from benchdragon.errors import BenchDragonError
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.player.scene import Span, plain_dance
from benchdragon.solve.head_speed import greatest_head_speed, slowed
from benchdragon.solve.size import limit
from benchdragon.solve.tolerance import CASES, Draw, needed_pitch, touches
from tests.engine.recording import node
from tests.planner.test_solve import small
from tests.planner.twins import asked
from tests.test_budget import WORK

pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")

ENOUGH: dict[str, float] = {"work": budget.WORK, "memory": budget.MEMORY}
COIL = read_plan("spiral-in", ["disc.radius=4.5", "dragon.benches=60", "limits.speed=3"])
SQUARE = read_plan(
    "turn", ["dragon.benches=60", "obstacle=[{kind='circle', centre=[3.0, 30.0], radius=0.5}]"]
)


def _dance(plan: Plan) -> object:
    walk = plan.build()
    return plain_dance(walk, Span(*plan.span(walk)))


QUESTIONS: dict[str, tuple[Plan, Callable[[Plan], object]]] = {
    "verdict": (SQUARE, check),
    "dance": (COIL, _dance),
    "limit/pitch": (COIL, lambda plan: limit(plan, "pitch", tolerance=1e-6)),
    "job/speed": (COIL, greatest_head_speed),
    "job/pace": (COIL, slowed),
}
# What the page computes in other portions than Python counts otherwise by up to this share.
APART = 0.05


def page(question: str, plan: Plan, most: dict[str, float]) -> Any:
    """What the page answers where a question may take so much."""
    one = {"data": plan.data(), "name": "page", "options": {"question": question}, "most": most}
    (said,) = asked("solve_plans.mjs", {"asked": [one]})
    return said


@pytest.mark.parametrize("question", QUESTIONS)
def test_the_page_counts_as_python_does(question: str) -> None:
    plan, ask = QUESTIONS[question]
    with budget.question():
        ask(plan)
        spent = budget.WORK - budget.left()
    said = page(question, plan, ENOUGH)
    assert "error" not in said["found"]
    assert said["spent"] == pytest.approx(spent, rel=APART)


@pytest.mark.parametrize("question", [*QUESTIONS, "job/turn", "sheets"])
def test_a_question_of_the_page_that_takes_too_much_work_is_refused(question: str) -> None:
    plan = SQUARE if question in ("job/turn", "sheets") else COIL
    found = page(question, plan, ENOUGH | {"work": 10_000.0})["found"]
    assert found["kind"] == "OverBudgetError"
    assert re.fullmatch(WORK, found["error"])


def test_the_page_refuses_in_the_words_of_python(monkeypatch: pytest.MonkeyPatch) -> None:
    odd = checked(small(23), "plan")
    said = page("limit/length", odd, ENOUGH)["found"]
    with pytest.raises(BenchDragonError) as refused:
        limit(odd, "length", tolerance=1e-6)
    assert said["error"] == str(refused.value)
    monkeypatch.setenv(budget.VARIABLE, "0.001")
    said = page("limit/pitch", COIL, {"work": 1e-3 * budget.WORK, "memory": 1e-3 * budget.MEMORY})
    with pytest.raises(BenchDragonError) as refused:
        limit(COIL, "pitch", tolerance=1e-6)
    assert said["found"]["error"] == str(refused.value)


def test_each_random_dance_of_the_page_is_a_question_of_its_own() -> None:
    one = {"data": COIL.data(), "name": "margins", "options": {"draws": 2}}
    (said,) = asked("solve_plans.mjs", {"asked": [one]})
    assert "error" not in said["found"]
    with budget.question():
        exact = limit(COIL, "pitch").value
        for number in range(2):
            draw = Draw(CASES["all"].deviations, 1, number)
            needed_pitch(COIL, draw, exact)
            touches(COIL, draw)
        spent = budget.WORK - budget.left()
    (said,) = asked("solve_plans.mjs", {"asked": [one | {"most": ENOUGH}]})
    assert said["spent"] == pytest.approx(spent, rel=APART)
    (said,) = asked("solve_plans.mjs", {"asked": [one | {"most": ENOUGH | {"work": 0.9 * spent}}]})
    assert re.fullmatch(WORK, said["found"]["error"])


def test_each_question_of_the_page_has_a_budget_of_its_own() -> None:
    one = {"data": COIL.data(), "name": "page", "options": {"question": "limit/pitch"}}
    (first,) = asked("solve_plans.mjs", {"asked": [one | {"most": ENOUGH}]})
    most = ENOUGH | {"work": 1.5 * first["spent"]}
    for said in asked("solve_plans.mjs", {"asked": [one | {"most": most}] * 2}):
        assert "error" not in said["found"]
        assert said["spent"] == first["spent"]
