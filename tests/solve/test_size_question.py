"""Questions about a size of a plan, asked of the engine: trials of walks, and the search among them."""

import gc
import math
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from benchdragon import budget
from benchdragon.analysis import tables
from benchdragon.analysis.contact import first_contact
from benchdragon.errors import BenchDragonError, InputError
from benchdragon.hosts.serving import VARIABLE
from benchdragon.kernels import memory, search_room, size_memory
from benchdragon.kernels import size_question as kernel
from benchdragon.kernels.curve import RouteRow
from benchdragon.kernels.memory import group_at, held
from benchdragon.kernels.question import QuestionEnding, close_question
from benchdragon.kernels.search_room import RoomEnding, RoomSize
from benchdragon.kernels.size_bracket import Bracket, SizeVerdict
from benchdragon.kernels.size_search import NO_MEETING, KnownMeeting, Meet, SizeGoal
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.progress import silent
from benchdragon.solve import size_question
from benchdragon.solve.size import feasible_sizes, limit
from benchdragon.solve.size_family import Meeting, PlanFamily, kernel_family, question
from benchdragon.solve.size_question import SizeQuestion
from tests.solve.asked_in_python import in_python

DISC, FEW = ["disc.radius=4.5"], "dragon.benches=30"
EIGHT = str(Path(__file__).parents[2] / "examples" / "02_eight.dragon.toml")
EASED = ["turn.ease=0.8", "dragon.head_length=2.5", "turn.exit_radius=4.4"]


@pytest.fixture(autouse=True)
def nothing_is_left() -> Iterator[None]:
    """All that the engine holds for questions is given back."""
    gc.collect()  # searches that other tests let go of
    before = held()
    yield
    assert held() == before


def asked(plan: Plan, name: str, margin: float = 0.0) -> SizeQuestion:
    """A question about a size of a plan."""
    return SizeQuestion(PlanFamily(plan, question(name), margin), silent)


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
    family, results = PlanFamily(chosen, question(name), 0.05), set()
    sizes = [factor * family.first for factor in (0.6, 0.75, 0.9, 1.0, 1.15, 1.4, 2.5)]
    with SizeQuestion(family, silent) as search:
        found = [search.trial(size) for size in sizes]
    for size, result in zip(sizes, found, strict=True):
        try:
            walk, start, end = family.walk(size)
            contact = first_contact(walk, start, end, margin=0.05)
        except BenchDragonError:
            assert result == SizeVerdict.FAILS
            continue
        results.add(result)
        assert result == (SizeVerdict.PASSES if contact is None else SizeVerdict.FAILS)
    assert results == {SizeVerdict.PASSES, SizeVerdict.FAILS}


def test_a_route_of_more_rows_than_there_is_room_for_is_laid_with_more(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """At narrower pitches the clothoids are cut into more rows than at the plan's."""
    plan = read_plan("turn", [FEW, *EASED, "route.pitch=1.7"])
    with asked(plan, "pitch") as search:
        result = search.trial(1.7)

    def short(*of: object) -> object:
        family, walk = kernel_family(*of)  # type: ignore[arg-type]
        return family, walk._replace(rows=walk.rows[:3])

    monkeypatch.setattr(size_question, "kernel_family", short)
    with asked(plan, "pitch") as search:
        before = held()
        assert search.trial(1.7) == result == SizeVerdict.PASSES
        assert before < held()


def test_a_search_may_be_asked_again_and_again() -> None:
    answers = []
    with asked(read_plan("spiral-in", [*DISC, FEW]), "pitch") as search:
        for _turn in range(2):
            assert search.trial(0.3) == SizeVerdict.FAILS
            search.limit(0.55)
            answers.append(search.state.tolist())
    assert not math.isnan(answers[0][Bracket.VALUE])
    np.testing.assert_array_equal(answers[0], answers[1])


def test_a_walk_that_cannot_be_followed_fails_only_if_it_is_seen_to(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Round circles of 9 m a bench with 17.9 m between its handles all but stands square."""
    plan = read_plan(EIGHT, ["dragon.benches=3"])
    with asked(plan, "length") as search:
        assert search.trial(18.6) == SizeVerdict.FAILS
    in_python(monkeypatch)
    monkeypatch.setattr(kernel, "falls_soon", lambda *_place: False)
    with asked(plan, "length") as search:
        assert search.trial(18.6) == SizeVerdict.UNDECIDED


def test_a_walk_too_long_to_be_searched_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    plan = read_plan("spiral-in", [*DISC, "dragon.benches=3", "walk.end=40"])
    with asked(plan, "pitch") as search:
        assert search.trial(0.6) == SizeVerdict.PASSES
    monkeypatch.setattr(tables, "MOST_CELLS", 20)
    with asked(plan, "pitch") as search:
        assert search.trial(0.6) == SizeVerdict.UNDECIDED


def test_a_border_beside_what_could_not_be_decided_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    def made_up(block: int, _left: float) -> int:
        size = group_at(size_memory.Sought, block + size_memory.BASE).state[Bracket.NOW]
        return (
            SizeVerdict.FAILS
            if size < 0.43
            else SizeVerdict.PASSES
            if size > undecided
            else SizeVerdict.UNDECIDED
        )

    in_python(monkeypatch)
    monkeypatch.setattr(kernel, "gone_on", made_up)
    plan = read_plan("spiral-in", [*DISC, FEW])
    for undecided, borders in ((0.46, 0), (0.43, 1)):
        [span] = feasible_sizes(plan, "pitch", 0.3, 0.7, 5).spans
        assert span.low == pytest.approx(max(undecided, 0.43), abs=2e-2)
        assert (len(span.borders), span.high) == (borders, 0.7)


def test_a_walk_that_ends_past_its_route_fails() -> None:
    plan = read_plan("spiral-in", [FEW, *DISC, "route.pitch=1.5", "route.start_turn=6", "walk.end=60"])
    with asked(plan, "pitch") as search:
        assert search.trial(1.5) == SizeVerdict.PASSES
        assert search.trial(0.9) == SizeVerdict.FAILS
        assert search._meetings[KnownMeeting.FAILED, Meet.FRONT] == NO_MEETING


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
    with asked(plan, "width") as search:
        assert search.trial(0.3) == SizeVerdict.PASSES
        assert search.trial(0.6) == SizeVerdict.FAILS
    found = limit(plan, "width")
    assert found.status == "found"
    assert 0.3 < found.value < 0.6


@pytest.mark.parametrize("margin", [math.nan, -0.1])
def test_a_margin_that_cannot_be_is_refused(margin: float) -> None:
    with pytest.raises(InputError, match="margin"):
        limit(read_plan("spiral-in", [FEW, *DISC]), "pitch", margin=margin)


def test_a_plan_that_fails_is_mended_by_the_pair_that_met() -> None:
    """From a pitch that fails, a few trials: the pair that met there leads to the limit."""
    with asked(read_plan("spiral-in", [*DISC, FEW]), "pitch") as search:
        search.limit(0.43)
    assert search.state[Bracket.TRIALS] <= 3


SMALL = [*DISC, "dragon.benches=5", "route.start_turn=10", "walk.end=12", "dragon.width=1.5"]
NARROW = (("A_CELL", 1), ("AT_FIRST", 4), ("PAIRS", 1), ("MEMBERS", 2), ("DOUBTS", 1))


def narrow(monkeypatch: pytest.MonkeyPatch) -> None:
    """Room for next to nothing at first."""
    for name, least in NARROW:
        monkeypatch.setattr(tables, name, least)


def test_room_grows_within_the_engine_and_answers_stay_the_same(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    plan, answers, most = read_plan("spiral-in", SMALL), [], []
    for wide in (True, False):
        if not wide:
            narrow(monkeypatch)
        with asked(plan, "width") as search:
            before = held()
            found = [search.trial(size) for size in (1.5, 3.6)]
            answers.append((found, search._meetings[KnownMeeting.FAILED].tolist()))
            most.append((before, held()))
    assert answers[0] == answers[1]
    assert answers[0][0] == [SizeVerdict.PASSES, SizeVerdict.FAILS]
    assert most[1][0] < 0.2 * most[0][0]
    assert most[1][1] > 2 * most[1][0]


def test_plain_python_answers_as_the_engine_does(monkeypatch: pytest.MonkeyPatch) -> None:
    """To the last bit, rooms made wider on the way and all."""
    narrow(monkeypatch)
    told = []
    for _asked in range(2):
        with asked(read_plan("spiral-in", SMALL), "width") as search:
            ending = search.limit(2.5)
            told.append((ending, search.state.tolist(), search.guide, search.evaluations))
        in_python(monkeypatch)
    assert told[0] == told[1]


def test_a_question_that_is_closed_answers_no_more() -> None:
    with (
        asked(read_plan("spiral-in", SMALL), "width") as search,
        asked(read_plan("spiral-in", SMALL), "width") as other,
    ):
        handle = search._handle
        assert handle != other._handle
        assert close_question(handle)
        for stale in (handle, 0, -1, 10**9 * handle + 7):
            assert not close_question(stale)
            assert not kernel.seek_size(stale, SizeGoal.GROW, 0.3, 0.0)
            assert kernel.step_size(stale, math.inf) == QuestionEnding.CLOSED
        assert other.trial(1.5) == SizeVerdict.PASSES  # it is another's, still
        assert kernel.step_size(other._handle, math.inf) == QuestionEnding.CLOSED
        with pytest.raises(ValueError, match="closed"):
            search.trial(1.5)


@pytest.mark.parametrize("share", ["0.00001", "0.001"])
def test_what_takes_too_much_is_refused_and_given_back(
    monkeypatch: pytest.MonkeyPatch, share: str
) -> None:
    monkeypatch.setenv(budget.VARIABLE, share)
    with pytest.raises(budget.OverBudgetError, match=r"takes more (work|memory) than a question may"):
        limit(read_plan("spiral-in", [*DISC, FEW]), "pitch")


def test_work_within_the_engine_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(budget, "WORK", 5_000)
    with pytest.raises(budget.OverBudgetError, match="takes more work than a question may"):
        limit(read_plan("spiral-in", SMALL), "width")


def test_a_question_that_nobody_knows_any_more_is_given_back() -> None:
    before, search = held(), asked(read_plan("spiral-in", SMALL), "width")
    assert held() > before
    del search
    assert held() == before


def test_a_question_that_is_broken_off_is_given_back() -> None:
    def told(_share: float, _text: str) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        limit(read_plan("spiral-in", SMALL), "width", progress=told)


def test_a_route_far_from_the_origin_is_the_same_however_often_it_is_walked(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """One that stays was moved at each trial, and 90 km away a bracket was 8 mm wide."""
    in_python(monkeypatch)
    plan = read_plan(EIGHT, ["dragon.benches=3", "route.at=[90000, 0]", "walk.end=62"])
    with asked(plan, "width") as search:
        rows = sought_by(search).walk.rows
        before = rows.copy()
        assert np.abs(before[:, [RouteRow.X, RouteRow.Y]]).max() < 1_000.0
        assert [search.trial(size) for size in (0.2, 0.3)] == [SizeVerdict.PASSES, SizeVerdict.PASSES]
        np.testing.assert_array_equal(rows, before)


def sought_by(search: SizeQuestion) -> size_memory.Sought:
    """What lies in the block of a question that plain Python answers."""
    return memory.group_at(size_memory.Sought, memory.recall(search._handle) + size_memory.BASE)


def test_pairs_of_a_step_stay_known_when_room_is_made(monkeypatch: pytest.MonkeyPatch) -> None:
    in_python(monkeypatch)
    with asked(read_plan("spiral-in", SMALL), "width") as search:
        sought, block = sought_by(search), memory.recall(search._handle)
        meeting, sizes = sought.room.meeting, sought.sizes
        meeting.first[:2], meeting.second[:2] = (1, 0), (3, 4)
        sizes[RoomSize.PAIRS] *= 3
        assert search_room.make_step(block, size_memory.SIZE_ROOM_SLOT, sizes) == RoomEnding.ROOMY
        wider = sought_by(search).room.meeting
        assert len(wider.first) == len(wider.other) == sizes[RoomSize.PAIRS]
        assert (wider.first[:2].tolist(), wider.second[:2].tolist()) == ([1, 0], [3, 4])
        assert (wider.place == -1).all()


WASM = """
import sys
from benchdragon.kernels.memory import group_at, held
from benchdragon.kernels.question import QuestionEnding, close_question
from benchdragon.plans.schema import read_plan
from benchdragon.solve.size import limit
found = limit(read_plan("spiral-in", sys.argv[1:]), "width")
numbers = map(repr, (found.value, found.lower, found.upper))
print(*numbers, found.status, found.witness.benches, held())
"""


def test_the_module_answers_as_whoever_serves() -> None:
    command = [sys.executable, "-c", WASM, *SMALL]
    done = subprocess.run(
        command, capture_output=True, text=True, check=True, env={**os.environ, VARIABLE: "wasm"}
    )
    value, lower, upper, *told = done.stdout.split()
    found = limit(read_plan("spiral-in", SMALL), "width")
    numbers = pytest.approx((found.value, found.lower, found.upper), abs=1e-11)
    assert (float(value), float(lower), float(upper)) == numbers
    assert found.witness is not None
    assert told == [found.status, *str(found.witness.benches).split(), "0"]
