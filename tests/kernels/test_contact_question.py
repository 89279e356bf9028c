"""The engine's question about contact, of small dragons: passes, spans, room that grows, its work."""

import gc
import math
from collections.abc import Iterator

import numpy as np
import pytest

from benchdragon import (
    Arc,
    Dragon,
    Line,
    Route,
    Walk,
    budget,
    clearances,
    first_contact,
    least_clearance,
)
from benchdragon.analysis import contact_search, tables
from benchdragon.analysis.contact_search import TOLERANCES, ContactSearch
from benchdragon.kernels import contact_least, contact_question
from benchdragon.kernels.contact_memory import CONTACT_FIGURES, ContactEnding, ContactTold
from benchdragon.kernels.memory import held
from benchdragon.kernels.nearness import NEARNESS
from benchdragon.kernels.question import QuestionEnding, close_question
from benchdragon.kernels.time_of_impact import Ending, Goal
from benchdragon.progress import silent
from tests.kernels.tried_walks import Searched
from tests.solve.asked_in_python import in_python

# Benches 1 and 3 come nearest where the head is well in the bend, 14 m along.
BENT = Walk(Dragon.uniform(4, 2.2), Route.joined([Line(12.0), Arc(2.2, 2.0), Line(20.0)]), start=11.0)


@pytest.fixture(autouse=True)
def nothing_is_left() -> Iterator[None]:
    """All that the engine holds for questions is given back."""
    gc.collect()  # searches that other tests let go of
    before = held()
    yield
    assert held() == before


def test_a_margin_is_looked_for() -> None:
    margin = least_clearance(BENT, 1.0, 4.0).value + 0.02
    found = first_contact(BENT, 0.0, 6.0, margin=margin)
    assert found is not None
    assert found.witness is not None
    assert found.upper - found.lower < 1e-11
    low = clearances(BENT.motion([found.lower - 1e-6, found.upper + 1e-6]))
    assert low[0] > margin > low[1]


def test_a_floor_is_a_tolerance_below_what_was_seen() -> None:
    found = least_clearance(BENT, 1.0, 4.0)
    assert 1e-12 <= found.value - found.lower < 2e-12
    sampled = clearances(BENT.motion(np.linspace(1.0, 4.0, 40))).min()
    assert found.lower <= found.value <= sampled + 1e-12


def test_nothing_beyond_what_is_asked_for_is_looked_for() -> None:
    found = least_clearance(BENT, 1.0, 4.0, within=0.01)
    assert (found.value, found.upper, found.witness) == (math.inf, math.inf, None)
    assert 0.01 - 2e-12 < found.lower <= 0.01
    with ContactSearch(BENT, 12.0, 15.0, 0.0, silent, tolerances=TOLERANCES) as search:
        assert search.find(Goal.LEAST, (0.01,)) == ContactEnding.FARTHER
        assert search.figures[ContactTold.FLOOR_AT] == found.lower


def test_all_spans_are_searched_and_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """The bend comes first, and of a long dragon it is first seen by a pass; or it comes last."""
    with ContactSearch(BENT, 11.0, 30.0, 0.0, silent, tolerances=TOLERANCES[:2]) as search:
        search.find(Goal.LEAST, (math.inf,))
        whole = float(search.figures[ContactTold.BEST])
    in_python(monkeypatch)
    monkeypatch.setattr(contact_least, "MOST_SAMPLED", 3)
    for spans in ([(11.0, 18.0), (28.0, 30.0)], [(11.0, 12.0), (12.5, 30.0)]):
        with ContactSearch(
            BENT, 11.0, 30.0, 0.0, silent, spans=spans, tolerances=TOLERANCES[:2]
        ) as search:
            assert search.find(Goal.LEAST, (math.inf,)) == Ending.FOUND
            assert search.figures[ContactTold.BEST] == pytest.approx(whole, abs=1e-11)


def test_a_pass_that_is_too_dear_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    known = least_clearance(BENT, 1.0, 4.0)
    for name in ("REFINING", "REFINING_ON"):
        monkeypatch.setattr(contact_search, name, 1e-12)
    found = least_clearance(BENT, 1.0, 4.0)
    assert found.lower == 0.0 < known.lower < found.upper
    assert found.value >= known.value


def test_work_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(budget, "WORK", 1_500)
    with pytest.raises(budget.OverBudgetError, match="takes more work than a question may"):
        first_contact(BENT, 0.0, 18.0, margin=0.5)


def test_tables_take_no_more_memory_than_a_question_may(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(budget, "MEMORY", 10_000)
    with pytest.raises(budget.OverBudgetError, match="takes more memory than a question may"):
        first_contact(BENT, 0.0, 18.0, margin=0.5)


def test_little_room_is_widened_and_steps_stay_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    """In the bend far along more is wanted than on the line before it."""
    walk = Walk(Dragon.uniform(6, 2.2), Route.joined([Line(40.0), Arc(1.5, 3.0), Line(9.0)]))
    told = []
    for narrow in (False, True):
        if narrow:
            for name, least in (("A_CELL", 1), ("AT_FIRST", 4), ("PAIRS", 1), ("MEMBERS", 2)):
                monkeypatch.setattr(tables, name, least)
        search = Searched(walk, 11.0, 44.0)
        search.begin(1.2)
        told.append([(step.start, step.end, *step.first, *step.second) for step in search.steps()])
    assert told[0] == told[1] != []


def test_a_question_that_is_closed_answers_no_more() -> None:
    search = ContactSearch(BENT, 11.0, 12.0, 0.0, silent)
    handle = search._handle
    assert contact_question.step_contact(handle, math.inf) == QuestionEnding.CLOSED  # nothing is sought
    search.close()
    assert not close_question(handle)
    assert not contact_question.seek_contact(handle, Goal.FIRST_TOUCH, np.zeros(1))
    assert not contact_question.read_contact(handle, np.zeros(CONTACT_FIGURES), np.zeros(NEARNESS))
    with pytest.raises(ValueError, match="closed"):
        search.find(Goal.FIRST_TOUCH)
