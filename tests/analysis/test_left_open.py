"""Once contact is decided, a check says so, and what it could not find out besides."""

import math
from collections.abc import Callable
from typing import Any

import pytest

from benchdragon import budget
from benchdragon.analysis import check as checking
from benchdragon.analysis import contact, contact_search, obstacles, speed
from benchdragon.analysis.check import Report, check, sentence
from benchdragon.analysis.left_open import REST
from benchdragon.analysis.records import verdict_of
from benchdragon.budget import OverBudgetError
from benchdragon.errors import UnsureError
from benchdragon.i18n import use_language
from benchdragon.plans.schema import Plan, read_plan

FEW = ["disc.radius=4.5", "dragon.benches=20"]
WELL = 'obstacle=[{kind = "circle", name = "well", centre = [30, 0], radius = 1}]'
ROOM = "people={sway = 0.01, imprecision = 0.01, beside = 0.001}"
OPEN = pytest.mark.parametrize("error", [OverBudgetError("too dear"), UnsureError("too close")])


def asked(*settings: str) -> Plan:
    return read_plan("spiral-in", [*FEW, *settings])


def raising(error: Exception) -> Callable[..., Any]:
    """What raises that, when all the work is done that may be."""

    def raises(*_asked: object, **_more: object) -> None:
        budget.spend(budget.left())
        raise error

    return raises


def kinds(found: Report) -> list[tuple[str, bool]]:
    return [(one.kind, one.decided) for one in found.findings]


@OPEN
@pytest.mark.parametrize("margin", [0.0, 0.05])
def test_a_clearance_that_cannot_be_found_takes_no_verdict(
    error: Exception, margin: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = asked(f"limits.margin={margin}")
    known = check(plan)
    monkeypatch.setattr(checking, "least_clearance", raising(error))
    found = check(plan)
    assert (known.safe, found.safe) == (True, True)
    assert margin - 1e-9 <= found.clearance.lower <= margin
    assert found.clearance.lower <= known.clearance.lower
    assert known.clearance.lower <= found.clearance.value <= found.clearance.upper < math.inf


def test_a_clearance_seen_after_a_contact_has_no_least_but_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Benches that come nearer than a margin of 0.3 m may come as near as they like."""
    monkeypatch.setattr(checking, "least_clearance", raising(OverBudgetError("too dear")))
    found = check(asked("limits.margin=0.3"))
    assert kinds(found) == [("margin", True)]
    assert found.clearance.lower == 0.0
    assert found.clearance.value > 0.0


def test_a_dragon_of_two_benches_has_no_clearance_to_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checking, "least_clearance", raising(OverBudgetError("too dear")))
    assert check(asked("dragon.benches=2")).clearance.value == math.inf


@OPEN
def test_a_speed_without_a_limit_takes_no_verdict(
    error: Exception, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(checking, "greatest_speed", raising(error))
    found = check(asked())
    assert found.safe
    answer = found.greatest_speed
    assert (answer.status, answer.upper) == ("undecided", math.inf)
    assert 0.99 < answer.lower < answer.value <= 1.0
    assert verdict_of(found).greatest_speed is not None


def test_a_speed_with_a_limit_stays_open(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checking, "greatest_speed", raising(OverBudgetError("too dear")))
    found = check(asked("limits.speed=2"))
    assert kinds(found) == [("speed", False)]
    assert sentence(found).startswith("Undecided: ")


@OPEN
def test_another_limit_stays_open(error: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checking, "greatest", raising(error))
    found = check(asked("limits.turning_rate=90"))
    assert kinds(found) == [("turning_rate", False)]
    why = (
        "that takes more work than a question may"
        if error.args[0] == "too dear"
        else "rounding hides it"
    )
    assert found.findings[0].text == (
        f"whether the turning rate of a bench keeps to 1.5708 rad/s is undecided: {why}"
    )
    assert found.peaks == {}
    verdict = verdict_of(found)
    assert (verdict.safe, verdict.decided) == (False, False)
    assert verdict.findings[0].text.zh != verdict.findings[0].text.en


@OPEN
def test_an_obstacle_stays_open_and_the_others_are_told(
    error: Exception, monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = asked(WELL, "venue.rectangle=[40, 40]")
    answers = obstacles.obstacle_answers

    def but_the_well(walk: Any, obstacle: Any, *span: float, **more: Any) -> Any:
        return raising(error)() if obstacle.name == "well" else answers(walk, obstacle, *span, **more)

    monkeypatch.setattr(checking, "obstacle_answers", but_the_well)
    found = check(plan)
    assert kinds(found) == [("obstacle", False)]
    assert found.findings[0].obstacle == "well"
    assert found.findings[0].text.startswith(
        "whether benches keep their distance from well is undecided: "
    )
    assert [one.obstacle.kind for one in found.obstacles] == ["venue"]


def test_a_venue_that_stays_open_is_no_obstacle(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checking, "obstacle_answers", raising(OverBudgetError("too dear")))
    assert kinds(check(asked("venue.rectangle=[40, 40]"))) == [("venue", False)]


@OPEN
def test_levels_of_room_that_were_found_are_told(
    error: Exception, monkeypatch: pytest.MonkeyPatch
) -> None:
    search, calls = contact.first_sure_contact, list[float]()

    def twice(*walk: Any, **more: Any) -> Any:
        calls.append(0.0)
        return search(*walk, **more) if len(calls) < 2 else raising(error)()

    monkeypatch.setattr("benchdragon.analysis.room.first_sure_contact", twice)
    found = check(asked(ROOM))
    assert [level.name for level in found.room] == ["benches", "sway"]
    assert kinds(found) == [("people", False)]
    assert found.findings[0].text.startswith("whether there is room for people is undecided: ")


def test_contact_that_stays_open_has_no_report(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checking, "first_sure_contact", raising(OverBudgetError("too dear")))
    with pytest.raises(OverBudgetError, match="too dear"):
        check(asked())


def test_what_stays_open_is_not_proved(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("flint")
    plan = asked("dragon.benches=4", "walk.end=20", WELL)
    assert check(plan, prove=True).proved
    monkeypatch.setattr(checking, "obstacle_answers", raising(OverBudgetError("too dear")))
    assert not check(plan, prove=True).proved


def test_every_sentence_stands_in_both_languages(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checking, "obstacle_answers", raising(OverBudgetError("too dear")))
    found = check(asked(WELL))
    use_language("zh")
    try:
        assert "well" in found.findings[0].text
        assert "open" not in found.findings[0].text
    finally:
        use_language("en")


def test_a_check_has_work_left_for_what_comes_after_contact(monkeypatch: pytest.MonkeyPatch) -> None:
    def dear(*walk: Any, **more: Any) -> Any:
        found = contact.first_sure_contact(*walk, **more)
        budget.spend(0.999999 * budget.left())
        return found

    monkeypatch.setattr(checking, "first_sure_contact", dear)
    found = check(asked("limits.speed=2", WELL))
    assert found.safe
    assert found.clearance.upper - found.clearance.lower < 1e-11
    assert found.greatest_speed.upper < 1.001


def test_a_speed_is_told_with_the_bracket_that_was_reached(monkeypatch: pytest.MonkeyPatch) -> None:
    walk = asked().build()
    with budget.question():
        speed.greatest_speed(walk, 0.0, 100.0)
        spent = budget.WORK - budget.left()
    with budget.question():
        budget.spend(budget.left() - 0.9 * spent)
        found = speed.greatest_speed(walk, 0.0, 100.0)
    assert found.upper == math.inf
    assert 0.99 < found.lower <= found.value <= 1.0
    with budget.question():
        budget.spend(budget.left())
        with pytest.raises(OverBudgetError):
            speed.greatest_speed(walk, 0.0, 100.0)


@pytest.mark.parametrize("shares", [(1e-9, 0.05), (1e-9, 1e-9)])
def test_brackets_that_are_too_dear_are_wider(
    shares: tuple[float, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = asked(WELL)
    known = check(plan)
    for module in (contact, contact_search):
        monkeypatch.setattr(module, "REFINING", shares[0])
        monkeypatch.setattr(module, "REFINING_ON", shares[1])
    found = check(plan)
    assert found.safe
    near, well = found.clearance, found.obstacles[0].distance
    for answer, exact in ((near, known.clearance), (well, known.obstacles[0].distance)):
        assert answer.lower <= exact.lower <= exact.upper <= answer.upper + 1e-12
        if shares[1] > 1e-6:
            assert 1e-11 < answer.upper - answer.lower < 1.1e-8
        else:
            assert answer.lower == 0.0


def test_what_is_aside_is_counted_apart() -> None:
    with budget.question(2):
        with budget.aside(0.5):
            assert budget.left() == 0.5 * budget.WORK
            budget.spend(0.5 * budget.WORK)
            with pytest.raises(OverBudgetError):
                budget.spend(1.0)
        assert budget.left() == 2.0 * budget.WORK
    with budget.aside(0.5):
        assert budget.left() == math.inf


def test_a_question_is_allowed_more_and_never_less() -> None:
    with budget.question():
        budget.allow(REST)
        assert budget.left() == budget.WORK
        budget.spend(0.9 * budget.WORK)
        budget.allow(REST)
        assert budget.left() == pytest.approx(REST * budget.WORK)
    budget.allow(REST)
    assert budget.left() == math.inf
