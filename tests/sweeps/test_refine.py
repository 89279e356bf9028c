"""Refinement: further points lie where answers change most, and are the same after a break."""

import math
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchdragon import sweep
from benchdragon.errors import InputError, MissingExtraError, NoSolutionError
from benchdragon.model.answer import Answer
from benchdragon.parallel import threads
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.sweeps import questions
from benchdragon.sweeps.points import grid_points, listed_points
from benchdragon.sweeps.refine import ROUND, Refinement, Refiner
from benchdragon.sweeps.sweep import Sweep

PLAN = read_plan("spiral-in", ["dragon.benches=8"])
JUMP = 0.4987654
PITCHES = [0.4, 0.45, 0.5, 0.55, 0.6]


@pytest.fixture
def answer(monkeypatch: pytest.MonkeyPatch) -> Callable[[Callable[[Plan], float]], None]:
    """Makes up what the question "width" answers."""

    def made_up(value: Callable[[Plan], float]) -> None:
        def ask(plan: Plan, _dances: Any) -> Answer:
            found = value(plan)
            return Answer(found, found, found, "m", "found")

        asked = replace(questions.QUESTIONS["width"], ask=ask)
        monkeypatch.setitem(questions.QUESTIONS, "width", asked)

    return made_up


def pitch(plan: Plan) -> float:
    found = plan.model_dump()["route"]["pitch"]
    assert isinstance(found, float)
    return found


def refined(refinement: Refinement, vary: Any = None, **named: Any) -> Sweep:
    return sweep(
        PLAN,
        vary or {"route.pitch": PITCHES},
        ["width"],
        refinement=refinement,
        executor=threads(1),
        **named,
    )


def brackets(found: Sweep) -> list[tuple[float, float]]:
    """Neighbouring values of the key between which the answer jumps."""
    at = np.argsort(found.column("route.pitch"))
    keys = found.column("route.pitch")[at]
    values = np.nan_to_num(found.column("width.value")[at], nan=-100.0)
    return [(keys[n], keys[n + 1]) for n in np.flatnonzero(np.abs(np.diff(values)) > 0.5)]


@pytest.mark.parametrize(("to", "rounds"), [(1e-2, 2), (1e-4, 3), (1e-6, 5)])
def test_a_jump_is_located_as_closely_as_wanted(answer: Any, to: float, rounds: int) -> None:
    answer(lambda plan: float(pitch(plan) > JUMP))
    found = refined(Refinement(500, to))
    ((low, high),) = brackets(found)
    assert low < JUMP < high
    assert high - low < to * 0.2
    assert len(found.table) <= 5 + rounds * ROUND


def test_the_border_of_answers_is_located(answer: Any) -> None:
    def value(plan: Plan) -> float:
        if pitch(plan) > JUMP:
            raise NoSolutionError("beyond")
        return 3.0

    answer(value)
    ((low, high),) = brackets(refined(Refinement(500, 1e-4)))
    assert low < JUMP < high < low + 0.2e-4


def test_points_are_no_more_than_wanted_and_their_numbers_go_on(answer: Any) -> None:
    answer(lambda plan: math.sin(40.0 * pitch(plan)))
    for most in (1, 31, 32, 33, 70):
        found = refined(Refinement(most, 1e-9))
        assert found.table["point"].to_pylist() == list(range(5 + most))
        assert len(set(found.column("route.pitch").tolist())) == 5 + most
        assert found.column("route.pitch")[:5].tolist() == PITCHES
        assert found.complete


def test_where_answers_are_level_nothing_more_is_asked(answer: Any) -> None:
    answer(lambda _plan: 2.0)
    assert len(refined(Refinement(100)).table) == 5


def test_where_there_is_no_answer_at_all_nothing_more_is_asked(answer: Any) -> None:
    def value(_plan: Plan) -> float:
        raise NoSolutionError("nowhere")

    answer(value)
    assert len(refined(Refinement(100)).table) == 5


def test_a_curve_has_points_where_it_bends_and_rises(answer: Any) -> None:
    answer(lambda plan: math.atan(300.0 * (pitch(plan) - JUMP)))
    keys = refined(Refinement(60, 1e-3)).column("route.pitch")[5:]
    assert np.mean(np.abs(keys - JUMP) < 0.02) > 0.4  # of a range of 0.2


VARIES: list[tuple[Any, Callable[[Plan], float]]] = [
    ({"route.pitch": PITCHES}, lambda plan: math.sin(40.0 * pitch(plan))),
    (
        {"route.pitch": PITCHES, "disc.radius": [1.1, 2.3, 3.7]},
        lambda plan: float(pitch(plan) + 0.01 * plan.model_dump()["disc"]["radius"] > 0.52),
    ),
]


@pytest.mark.parametrize(("vary", "value"), VARIES)
def test_after_a_break_the_points_are_those_of_one_go(
    answer: Any, tmp_path: Path, vary: Any, value: Any
) -> None:
    answer(value)
    whole = refined(Refinement(70, 1e-4), vary)

    class EnoughError(Exception):
        pass

    def stop(least: float) -> Callable[[float, str], None]:
        def told(share: float, _text: str) -> None:
            if share > least:
                raise EnoughError

        return told

    for least in (0.1, 0.4, 0.6, 0.9):
        with pytest.raises(EnoughError):
            refined(Refinement(70, 1e-4), vary, output=tmp_path, progress=stop(least))
    assert refined(Refinement(70, 1e-4), vary, output=tmp_path).numbers().equals(whole.numbers())
    assert len(whole.table) > 70


def test_all_rounds_have_the_same_workers(answer: Any) -> None:
    answer(VARIES[0][1])
    opened, where = 0, threads(1)

    def counted() -> Any:
        nonlocal opened
        opened += 1
        return where.opened()

    place = replace(where, opened=counted)
    found = sweep(PLAN, VARIES[0][0], ["width"], refinement=Refinement(70), executor=place)
    assert len(found.table) == 75
    assert opened == 1


def test_two_keys_are_refined_along_the_border(answer: Any) -> None:
    answer(VARIES[1][1])
    found = refined(Refinement(150, 1e-3), VARIES[1][0])
    distance = found.column("route.pitch") + 0.01 * found.column("disc.radius") - 0.52
    assert len(distance) == 165
    assert np.mean(np.abs(distance[15:]) < 0.02) > 0.6
    assert found.to_xarray().sizes == {"route.pitch": 5, "disc.radius": 3}


def test_a_list_is_refined_within_the_range_of_its_values(answer: Any) -> None:
    answer(lambda plan: float(pitch(plan) > JUMP))
    vary = listed_points({"route.pitch": [0.55, 0.42, 0.47], "disc.radius": [2.0, 1.5, 3.0]})
    found = refined(Refinement(40), vary)
    assert len(found.table) == 43
    for key, low, high in (("route.pitch", 0.42, 0.55), ("disc.radius", 1.5, 3.0)):
        assert low <= found.column(key).min() <= found.column(key).max() <= high


def test_whole_numbers_are_refined_as_numbers(answer: Any) -> None:
    answer(lambda plan: plan.model_dump()["disc"]["radius"] ** 2)
    found = refined(Refinement(9), {"disc.radius": [1, 2, 4]})
    assert len(found.table) == 12
    assert (found.column("width.value") == found.column("disc.radius") ** 2).all()
    assert any(value % 1.0 for value in found.column("disc.radius"))


def test_an_answer_is_told_where_it_was_asked_for() -> None:
    """The place that was asked for is no longer awaited, though it was rounded on its way."""
    refiner = Refiner(grid_points({"a.b": [0.1, 0.7, 0.9]}), Refinement(100))
    refiner.tell([(0.1,), (0.7,), (0.9,)], np.array([[0.0], [1.0], [3.0]]))
    for _round in range(3):
        points = refiner.ask(20)
        assert len(points) == 20
        refiner.tell(points, np.array([[math.sin(9.0 * x)] for (x,) in points]))
        assert not refiner._learner.pending_points


@pytest.mark.parametrize(
    "points",
    [
        grid_points({"a.b": [1, "x"]}),
        grid_points({"a.b": [1, 2], "a.c": [1, 2], "a.d": [1, 2]}),
    ],
)
def test_only_one_or_two_keys_with_numbers_are_refined(points: Any) -> None:
    with pytest.raises(InputError, match=r"^refine: expected one key or two, with numbers for values$"):
        Refiner(points, Refinement(5))


def test_a_key_needs_a_range() -> None:
    with pytest.raises(InputError, match=r"^refine: each key needs a range of values$"):
        Refiner(grid_points({"a.b": [1, 2], "a.c": [3]}), Refinement(5))


def test_refinements_that_cannot_be_are_refused() -> None:
    for most in (-1, 1.5, 1_000_001):
        with pytest.raises(InputError, match=r"^refine must be a whole number from 0 to 1000000, not"):
            Refinement(most)  # type: ignore[arg-type]
    for to in (0.0, 1.1, 1e-10):
        with pytest.raises(InputError, match=r"^to: expected a share from 1e-9 to 1, not"):
            Refinement(5, to)
    with pytest.raises(InputError, match=r"^to must be finite, not nan$"):
        Refinement(5, math.nan)


def test_without_the_library_its_extra_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "adaptive", None)
    with pytest.raises(MissingExtraError, match=r"benchdragon\[refine\]"):
        Refiner(grid_points({"a.b": [1, 2]}), Refinement(5))


def test_a_key_of_whole_numbers_alone_is_not_refined() -> None:
    plan = read_plan("spiral-in", ["disc.radius=4.5"])
    with pytest.raises(InputError, match=r"^refine: dragon\.benches takes no value between others: "):
        sweep(plan, {"dragon.benches": [10, 20]}, ["first_contact"], refinement=Refinement(5))
