"""Random dances against brute force: evaluations each 5 mm of the head."""

from collections.abc import Callable
from typing import Any

import pytest

from benchdragon import budget
from benchdragon.budget import OverBudgetError
from benchdragon.errors import InputError, UnsureError
from benchdragon.kernels import random_dance_look, random_dance_question, random_numbers
from benchdragon.kernels import random_dance_memory as told
from benchdragon.kernels.memory import held
from benchdragon.kernels.random_dance_memory import DanceGiven, DanceSought, DanceTold
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.solve.random_dance import answered
from benchdragon.solve.tolerance import CASES, Deviations, Draw, needed_pitch, touches
from tests.solve.asked_in_python import in_python
from tests.solve.dances import brute, laid

PLANS = {
    "spiral": ("spiral-in", ["disc.radius=4.5", "route.pitch=0.47", "dragon.benches=40",
                             "walk.start=215"]),
    "short": ("spiral-in", ["disc.radius=2.5", "route.pitch=0.5", "dragon.head_length=2",
                            "dragon.body_length=1.1", "dragon.benches=30", "walk.start=220"]),
    "turn": ("turn", ["route.pitch=1.18", "dragon.benches=30", "walk.start=5", "walk.end=35"]),
    "line": ("turn", ["route.pitch=1.3", "dragon.benches=25", "turn.family=arc-line-arc",
                      "walk.start=0", "walk.end=30"]),
    "tight": ("turn", ["route.pitch=1.0", "dragon.benches=30", "dragon.body_length=1.4",
                       "dragon.head_length=2.2", "disc.radius=3", "walk.start=0", "walk.end=25"]),
}  # fmt: skip
# Few benches on a short way, for plain Python; the pitch that exact people need there, about.
TINY = read_plan(
    "spiral-in", ["route.pitch=0.55", "disc.radius=2.5", "dragon.benches=14", "walk.start=400"]
)
EXACT = 0.547
# Two benches, of which none can touch, to where a spiral bends by 1.6 in a metre.
BENT = read_plan(
    "spiral-in",
    ["dragon.benches=2", "dragon.tail_length=0.9", "dragon.head_length=0.9", "disc.radius=0.62",
     "dragon.front_inset=0.1", "dragon.rear_inset=0.1", "route.pitch=1.3", "route.start_turn=3"],
)  # fmt: skip


@pytest.mark.parametrize("name", PLANS)
@pytest.mark.parametrize("case", ["aside", "stray", "all"])
def test_no_evaluation_comes_nearer_than_is_told(name: str, case: str) -> None:
    plan = read_plan(*PLANS[name])
    draw = Draw(CASES[case].deviations, 7, len(case))
    # Benches so much narrower that they overlap by 2 mm, or keep 1 mm.
    for room in (-2e-3, 1e-3):
        width = plan.value("dragon.width") + brute(laid(plan, draw), 0.05) - room
        narrow = plan.with_value("dragon.width", width)
        least = brute(laid(narrow, draw))
        assert touches(narrow.with_value("limits.margin", max(least, 0.0) + 1e-6), draw)
        clear = least - 1e-4  # by so much evaluations may be too far
        assert clear <= 0.0 or not touches(narrow.with_value("limits.margin", clear), draw)
        assert touches(narrow, draw) == (least <= 0.0)


@pytest.mark.parametrize("stray", [0.0, 0.01])
def test_a_dance_in_which_a_bench_cannot_follow_touches(
    stray: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    in_python(monkeypatch)
    draw_benches, draw = random_numbers.draw_benches, Draw(Deviations(0.1, stray), 1, 0)
    for aside, touch in ((0.3, False), (-0.6, True)):  # on the outer side; where no curve is left

        def drawn(*given: Any, aside: float = aside) -> None:
            draw_benches(*given)
            given[-1].fill(aside)

        monkeypatch.setattr(random_dance_question, "draw_benches", drawn)
        assert touches(BENT, draw) is touch


def test_a_line_that_strays_goes_no_farther_than_its_route() -> None:
    limits = {
        DanceGiven.WHAT: DanceSought.TOUCHES,
        DanceGiven.GUESS: 1.0,
        DanceGiven.SEED: 1,
        DanceGiven.DANCE: 0,
    }
    limits |= dict.fromkeys(range(DanceGiven.BY, told.DANCE_LIMITS), 0.0) | {DanceGiven.STRAY: 0.01}
    length = BENT.build().route.length
    assert not answered(BENT, limits | {DanceGiven.LAST: length})
    assert answered(BENT, limits | {DanceGiven.LAST: length + 1e-6})


def test_a_dance_too_long_to_be_searched_is_refused() -> None:
    plan = read_plan("spiral-in", ["disc.radius=4.5", "dragon.benches=20000"])
    with pytest.raises(InputError, match="too long"):
        touches(plan, Draw(Deviations(), 1, 0))


@pytest.mark.parametrize("deviations", [Deviations(stray=0.02), Deviations(aside=0.02)])
def test_a_walk_of_many_kilometres_is_refused_before_room_is_made_for_it(
    deviations: Deviations, monkeypatch: pytest.MonkeyPatch
) -> None:
    in_python(monkeypatch)
    monkeypatch.setattr(random_dance_question, "lay_points", lambda *_given: pytest.fail("it began"))
    plan = read_plan("turn", ["walk.end=1e8", "walk.start=-1e7", "dragon.benches=3"])
    with budget.question(), pytest.raises(InputError, match="too long"):
        touches(plan, Draw(deviations, 1, 0))


def test_tables_that_take_too_much_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    plan, draw = read_plan(*PLANS["spiral"]), Draw(CASES["all"].deviations, 1, 0)
    held_before = held()
    for share in (1e-5, 1e-3):  # that of the line; that of pairs
        monkeypatch.setenv(budget.VARIABLE, str(share))
        monkeypatch.setattr(budget, "WORK", 1e12)
        with pytest.raises(OverBudgetError, match="memory"):
            touches(plan, draw)
    assert held() == held_before


MOST = budget.WORK


@pytest.mark.parametrize("question", [touches, lambda plan, draw: needed_pitch(plan, draw, 0.5)])
def test_a_dance_is_counted_and_refused_where_it_takes_too_much(
    question: Callable[[Plan, Draw], object], monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = read_plan(*PLANS["spiral"])
    draw = Draw(CASES["all"].deviations, 1, 0)
    with budget.question():
        question(plan, draw)
        spent = MOST - budget.left()
    assert spent > 1e3
    monkeypatch.setattr(budget, "MEMORY", 1e12)
    monkeypatch.setenv(budget.VARIABLE, str(0.9 * spent / MOST))
    with pytest.raises(OverBudgetError):
        question(plan, draw)


def test_no_pitch_near_the_guess_is_told() -> None:
    plan = read_plan("spiral-in", ["disc.radius=4.5", "dragon.benches=30", "limits.margin=3"])
    with pytest.raises(UnsureError, match=r"no pitch near 0\.47 m .* dance 8 "):
        needed_pitch(plan, Draw(Deviations(aside=0.01), 1, 7), 0.47)


def test_plain_python_in_blocks_of_any_size_answers_as_the_engine_does(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of 7 steps or 100, a step of a question or one of the walk at a time; with room for few pairs."""
    draws = [Draw(CASES[case].deviations, 1, 2) for case in ("aside", "all")]
    wanted = [(needed_pitch(TINY, draw, EXACT), touches(TINY, draw)) for draw in draws]
    assert all(0.5 < pitch < 0.8 for pitch, _touch in wanted)
    in_python(monkeypatch)
    widened: list[float] = []
    widen = random_dance_question.widen

    def spied(block: int, partners: float) -> int:
        widened.append(partners)
        return widen(block, partners)

    monkeypatch.setattr(random_dance_question, "widen", spied)
    monkeypatch.setattr(random_dance_question, "FEW_PARTNERS", 0.2)
    monkeypatch.setattr(random_dance_question, "MORE_PARTNERS", 64)
    for steps, work in ((100, 200_000), (7, 0.0)):
        monkeypatch.setattr(told, "STEPS_TOGETHER", steps)
        monkeypatch.setattr(random_dance_question, "STEP_WORK", work)
        for draw, (pitch, touch) in zip(draws, wanted, strict=True):
            assert needed_pitch(TINY, draw, EXACT) == pytest.approx(pitch, abs=1e-7)
            assert touches(TINY, draw) == touch
    assert max(widened) > 0.2


def test_a_graze_between_evaluations_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Evaluations so far apart that they see nothing: the search decides alone."""
    draw = Draw(Deviations(), 1, 0)
    needed = needed_pitch(TINY, draw, EXACT)
    in_python(monkeypatch)
    monkeypatch.setattr(random_dance_look, "LOOK", 12.0)
    monkeypatch.setattr(random_dance_question, "LOOK", 12.0)
    monkeypatch.setattr(random_dance_look, "LOOK_SHRINKS", 0)
    found: list[float] = []
    weigh = random_dance_look.weigh

    def spied(dance: Any) -> None:
        found.append(dance.figures[DanceTold.LOW])
        weigh(dance)

    monkeypatch.setattr(random_dance_look, "weigh", spied)
    tight = TINY.with_value("route.pitch", needed - 2e-3)
    assert touches(tight, draw)
    assert found[0] > 0.0
    assert not touches(TINY.with_value("route.pitch", needed + 1e-5), draw)
    assert needed_pitch(TINY, draw, EXACT) == pytest.approx(needed, abs=1.1e-5)
