"""Questions of a sweep: each gives what the library gives, and each failure its status."""

import math
import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import click
import pytest

from benchdragon import budget
from benchdragon.analysis.contact import first_contact, least_clearance
from benchdragon.analysis.speed import greatest_speed
from benchdragon.cli.sweep import METHODS
from benchdragon.cli.sweep import sweep as verb
from benchdragon.errors import (
    BenchDragonError,
    InputError,
    MachineError,
    MissingExtraError,
    NoSolutionError,
    UnsureError,
    WalkError,
)
from benchdragon.i18n import _, spoken_in
from benchdragon.kernels.status import Status
from benchdragon.model.answer import Answer
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.size import limit
from benchdragon.solve.tolerance import CASES, Draw, chance, touches
from benchdragon.solve.turn import best_turn
from benchdragon.sweeps import points
from benchdragon.sweeps.questions import QUESTIONS, Question, RandomDances, outcome, questions

FEW = RandomDances(draws=6, deviations=CASES["aside"].deviations, seed=5)


def dance(*settings: str) -> Plan:
    return read_plan("spiral-in", ["dragon.benches=8", *settings])


TO_DISC = dance("disc.radius=4.5", "limits.speed=2", "limits.margin=0.001")
MEETS = dance("route.pitch=0.45", "limits.margin=0.02")
BY_HAND: dict[str, tuple[Plan, Callable[[Plan], Answer | None]]] = {
    "first_contact": (
        MEETS, lambda plan: first_contact(plan.build(), *plan.span(plan.build()), margin=0.02)
    ),
    "clearance": (TO_DISC, lambda plan: least_clearance(plan.build(), *plan.span(plan.build()))),
    "greatest_speed": (TO_DISC, lambda plan: greatest_speed(plan.build(), *plan.span(plan.build()))),
    "greatest_head_speed": (TO_DISC, greatest_head_speed),
    "smallest_pitch": (TO_DISC, lambda plan: limit(plan, "pitch")),
    "disc": (TO_DISC, lambda plan: limit(plan, "disc")),
    "width": (TO_DISC, lambda plan: limit(plan, "width")),
    "length": (TO_DISC, lambda plan: limit(plan, "length")),
    "turn": (read_plan("turn", ["dragon.benches=8"]), lambda plan: best_turn(plan).objective),
}  # fmt: skip


def numbers(answer: Answer | None) -> Any:
    """An answer without how long it took."""
    assert answer is not None
    return replace(answer, seconds=0.0)


@pytest.mark.parametrize("name", BY_HAND)
def test_a_question_gives_what_the_library_gives(name: str) -> None:
    plan, ask = BY_HAND[name]
    expected = numbers(ask(plan))
    found = outcome(QUESTIONS[name], plan, FEW)
    assert numbers(found.answer) == expected
    assert (found.status, found.message) == (expected.status, None)
    assert math.isnan(found.clear_until)
    assert expected.lower <= expected.value <= expected.upper


def test_every_question_was_asked_by_hand() -> None:
    assert {*BY_HAND, "tolerance"} == set(QUESTIONS)


def test_answers_by_hand_tell_margins_apart() -> None:
    exact = first_contact(MEETS.build(), *MEETS.span(MEETS.build()))
    assert exact is not None
    assert exact.value > numbers(BY_HAND["first_contact"][1](MEETS)).value


def test_tolerance_counts_the_dances_that_touch() -> None:
    plan = dance("disc.radius=2.0")
    dances = replace(FEW, draws=12, seed=6)
    hits = sum(touches(plan, Draw(dances.deviations, 6, number)) for number in range(12))
    assert 0 < hits < 12
    found = outcome(QUESTIONS["tolerance"], plan, dances)
    assert found.answer is not None
    assert (found.answer.value, found.answer.lower, found.answer.upper) == chance(hits, 12)
    assert found.status == "found"


def test_where_no_benches_touch_it_is_clear_until_the_end() -> None:
    found = outcome(QUESTIONS["first_contact"], TO_DISC, FEW)
    assert (found.status, found.answer, found.message) == ("clear", None, None)
    assert found.clear_until == TO_DISC.span(TO_DISC.build())[1]


def test_a_dance_that_cannot_be_walked_says_where() -> None:
    plan = dance("route.pitch=0.2")
    with pytest.raises(WalkError) as told:
        least_clearance(plan.build(), *plan.span(plan.build()))
    found = outcome(QUESTIONS["clearance"], plan, FEW)
    assert (found.status, found.answer, found.message) == ("unwalkable", None, str(told.value))
    assert "folds" in str(told.value)


def test_a_plan_that_lacks_what_is_asked_of_it_is_refused_in_the_language_in_use() -> None:
    for language in ("en", "zh"):
        with spoken_in(language):
            found = outcome(QUESTIONS["smallest_pitch"], dance(), FEW)
            said = _("say how far in the head comes: set disc.radius=4.5, for example")
            assert (found.status, found.message) == ("refused", said)


def failing(error: BaseException) -> Question:
    def ask(_plan: Plan, _dances: RandomDances) -> Answer:
        raise error

    return Question("failing", "failing", "m", ask)


@pytest.mark.parametrize(
    ("error", "status", "message"),
    [
        (WalkError(Status.FOLDED, 3, 1.5, 2.5, "2.86 m"), "unwalkable", None),
        (NoSolutionError("no turn"), "infeasible", "no turn"),
        (UnsureError("too hard"), "undecided", "too hard"),
        (MemoryError(), "lost", "memory ran out"),
        (InputError("not so"), "refused", "not so"),
    ],
)
def test_each_failure_has_its_status(error: Exception, status: str, message: str | None) -> None:
    found = outcome(failing(error), dance(), FEW)
    assert (found.status, found.answer) == (status, None)
    assert found.message == (message or str(error))
    assert found.seconds >= 0.0


def test_an_answer_has_its_own_status() -> None:
    answer = Answer(math.nan, 1.0, math.inf, "m", "infeasible")
    asked = Question("made", "made", "m", lambda _plan, _dances: answer)
    found = outcome(asked, dance(), FEW)
    assert (found.status, found.answer, found.message) == ("infeasible", answer, None)


def test_what_is_no_failure_of_ours_goes_on() -> None:
    with pytest.raises(ZeroDivisionError):
        outcome(failing(ZeroDivisionError()), dance(), FEW)


def test_questions_are_found_by_name() -> None:
    assert [found.name for found in questions(["width", "turn"])] == ["width", "turn"]
    assert all(name == question.name for name, question in QUESTIONS.items())
    known = ", ".join(QUESTIONS)
    for names, said in (
        (["wide"], "['wide']"),
        (["width", "width"], "['width', 'width']"),
        ([], "[]"),
        ("width", "'width'"),
        ([["width"]], "[['width']]"),
    ):
        with pytest.raises(InputError) as refused:
            questions(names)  # type: ignore[arg-type]
        assert str(refused.value) == f"ask: expected some of {known}, each once, not {said}"
        assert issubclass(refused.type, BenchDragonError)


@pytest.mark.parametrize("error", [MachineError("no file"), MissingExtraError("data")])
def test_a_fault_of_the_machine_is_none_of_the_plan(error: BenchDragonError) -> None:
    with pytest.raises(type(error)):
        outcome(failing(error), dance(), RandomDances())


def test_a_dragon_without_a_pair_that_counts_has_no_contact() -> None:
    plan = read_plan("spiral-in", ["dragon.benches=2", "walk.end=1"])
    found = outcome(QUESTIONS["clearance"], plan, RandomDances())
    assert (found.status, found.answer) == ("clear", None)
    assert math.isnan(found.clear_until)


def test_the_command_line_knows_every_question_and_every_way_to_draw() -> None:
    ask = next(option for option in verb.params if option.name == "ask")
    assert isinstance(ask, click.Option)
    assert re.findall(r"[a-z_]+", str(ask.help).partition(":")[2]) == list(QUESTIONS)
    assert METHODS == points.METHODS


def test_a_point_that_takes_too_much_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(budget.VARIABLE, "1e-6")
    found = outcome(QUESTIONS["first_contact"], TO_DISC, FEW)
    assert found.status == "undecided"
    assert found.message is not None
    assert re.match(r"this takes more (work|memory) than a question may", found.message)
