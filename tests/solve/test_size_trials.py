"""Trials of walks in which one size varies, and the search for the size that it may have."""

import math
from pathlib import Path

import numpy as np
import pytest

from benchdragon.analysis.contact import first_contact
from benchdragon.errors import BenchDragonError, InputError, UnsureError
from benchdragon.kernels.size_bracket import FAILS, PASSES, TRIALS, UNDECIDED, VALUE
from benchdragon.kernels.size_search import NOBODY
from benchdragon.plans.schema import read_plan
from benchdragon.progress import silent
from benchdragon.solve import size_trials
from benchdragon.solve.size import feasible_sizes, limit
from benchdragon.solve.size_family import Meeting, PlanFamily, kernel_family, question
from benchdragon.solve.size_trials import SizeSearch

DISC, FEW = ["disc.radius=4.5"], "dragon.benches=30"
EIGHT = str(Path(__file__).parents[2] / "examples" / "02_eight.dragon.toml")
EASED = ["turn.ease=0.8", "dragon.head_length=2.5", "turn.exit_radius=4.4"]


def test_benches_of_one_size_of_which_some_vary_are_of_two_kinds() -> None:
    plan = read_plan("spiral-in", [*DISC, FEW, "dragon.head_length=2.2"])
    family = PlanFamily(plan, question("length"), 0.0)
    _own, walk = kernel_family(family, family.walk(family.first)[0])
    assert walk.benches.kind.tolist() == [0, *[1] * 29]


@pytest.mark.parametrize(
    ("plan", "name"),
    [("spiral-in", "pitch"), ("spiral-in", "width"), ("turn", "pitch"), (EIGHT, "length")],
)
def test_a_trial_is_the_search_for_contact_of_that_walk(plan: str, name: str) -> None:
    chosen = read_plan(plan, [FEW, *(DISC if plan == "spiral-in" else [])])
    family = PlanFamily(chosen, question(name), 0.05)
    search, results = SizeSearch(family, silent), set()
    for factor in (0.6, 0.75, 0.9, 1.0, 1.15, 1.4, 2.5):
        size = factor * family.first
        result = search.trial(size)
        try:
            walk, start, end = family.walk(size)
            contact = first_contact(walk, start, end, margin=0.05)
        except BenchDragonError:
            assert result == FAILS
            continue
        results.add(result)
        assert result == (PASSES if contact is None else FAILS)
    assert results == {PASSES, FAILS}


def test_a_route_of_more_rows_than_there_is_room_for_is_laid_with_more() -> None:
    """At narrower pitches the clothoids are cut into more rows than at the plan's."""
    plan = read_plan("turn", [FEW, *EASED, "route.pitch=1.7"])
    family = PlanFamily(plan, question("pitch"), 0.0)
    search = SizeSearch(family, silent)
    wanted = len(search._walk.rows)
    search._walk = search._walk._replace(rows=search._walk.rows[:3])
    search._tables = search._made_tables()
    assert search.trial(1.7) == PASSES
    assert len(search._walk.rows) == wanted > 3


def test_a_search_may_be_asked_again_and_again() -> None:
    plan = read_plan("spiral-in", [*DISC, FEW])
    search = SizeSearch(PlanFamily(plan, question("pitch"), 0.0), silent)
    answers = []
    for _turn in range(2):
        assert search.trial(0.3) == FAILS
        search.limit(0.55)
        answers.append(search.state.tolist())
    assert not math.isnan(answers[0][VALUE])
    np.testing.assert_array_equal(answers[0], answers[1])


def test_a_walk_that_cannot_be_followed_fails_only_if_it_is_seen_to(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Round circles of 9 m a bench with 17.9 m between its handles all but stands square."""
    search = SizeSearch(PlanFamily(read_plan(EIGHT, [FEW]), question("length"), 0.0), silent)
    assert search.trial(18.6) == FAILS
    monkeypatch.setattr(size_trials, "falls_soon", lambda *_place: False)
    assert search.trial(18.6) == UNDECIDED


def test_a_walk_too_long_to_be_searched_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    search = SizeSearch(
        PlanFamily(read_plan("spiral-in", [*DISC, FEW]), question("pitch"), 0.0), silent
    )
    assert search.trial(0.6) == PASSES
    monkeypatch.setattr(size_trials, "run_search", refuse)
    assert search.trial(0.6) == UNDECIDED


def refuse(*_search: object) -> int:
    raise UnsureError("too long")


def test_a_border_beside_what_could_not_be_decided_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    def made_up(_search: SizeSearch, size: float) -> int:
        return FAILS if size < 0.43 else PASSES if size > undecided else UNDECIDED

    monkeypatch.setattr(SizeSearch, "trial", made_up)
    plan = read_plan("spiral-in", [*DISC, FEW])
    for undecided, borders in ((0.46, 0), (0.43, 1)):
        [span] = feasible_sizes(plan, "pitch", 0.3, 0.7, 5).spans
        assert span.low == pytest.approx(max(undecided, 0.43), abs=2e-2)
        assert (len(span.borders), span.high) == (borders, 0.7)


def test_a_walk_that_ends_past_its_route_fails() -> None:
    plan = read_plan("spiral-in", [FEW, *DISC, "route.pitch=1.5", "route.start_turn=6", "walk.end=60"])
    search = SizeSearch(PlanFamily(plan, question("pitch"), 0.0), silent)
    assert search.trial(1.5) == PASSES
    assert search.trial(0.9) == FAILS
    assert search._meetings[0, 2] == NOBODY


def test_what_is_near_a_meeting_is_as_far_from_the_start_or_from_the_end() -> None:
    meeting, links = Meeting(40.0, 10.0, 0, 2), np.array([2.86, 1.65, 1.65])
    near = 1.5 * 2.86
    assert list(meeting.windows(links, 0.0, 50.0)) == [(40.0 - near, 40.0 + near)]
    wider = [(40.0 - near, 40.0 + near), (50.0 - near, 50.0 + near)]
    assert list(meeting.windows(links, 0.0, 60.0)) == wider
    assert list(meeting.windows(links, 38.0, 42.0)) == [(38.0, 42.0), (38.0, 32.0 + near)]


def test_a_dragon_that_stands_still_passes_only_if_its_benches_keep_apart() -> None:
    plan = read_plan(
        "spiral-in", ["disc.radius=4.5", "walk.start=20", "walk.end=20", "walk.position=200"]
    )
    search = SizeSearch(PlanFamily(plan, question("width"), 0.0), silent)
    assert search.trial(0.3) == PASSES
    assert search.trial(0.6) == FAILS
    found = limit(plan, "width")
    assert found.status == "found"
    assert 0.3 < found.value < 0.6


@pytest.mark.parametrize("margin", [math.nan, -0.1])
def test_a_margin_that_cannot_be_is_refused(margin: float) -> None:
    with pytest.raises(InputError, match="margin"):
        limit(read_plan("spiral-in", [FEW, *DISC]), "pitch", margin=margin)


def test_a_plan_that_fails_is_mended_by_the_pair_that_met() -> None:
    """From a pitch that fails, a few trials: the pair that met there leads to the limit."""
    search = SizeSearch(
        PlanFamily(read_plan("spiral-in", [*DISC, FEW]), question("pitch"), 0.0), silent
    )
    search.limit(0.43)
    assert search.state[TRIALS] <= 3
