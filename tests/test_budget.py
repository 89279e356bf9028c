"""What a question may take: counted, estimated before it begins, and told in one sentence."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from benchdragon import budget
from benchdragon.analysis.check import check
from benchdragon.analysis.contact import first_contact
from benchdragon.analysis.speed import greatest_speed
from benchdragon.budget import OverBudgetError
from benchdragon.cli.main import run
from benchdragon.errors import InputError
from benchdragon.i18n import use_language
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import checked, read_plan
from benchdragon.progress import silent
from benchdragon.solve import head_speed
from benchdragon.solve.size import limit
from benchdragon.sweeps.questions import RandomDances, outcome, questions
from tests.planner.test_solve import small

FEW = ["disc.radius=4.5", "dragon.benches=20"]
WORK = (
    r"^this takes more work than a question may: at least [\d.e+]+ million positions of handles, where "
    r"[\d.]+ million are allowed; take fewer benches or a shorter walk \(walk.start, walk.end\), or "
    r"allow (\S+) times as much on the command line by BENCHDRAGON_BUDGET=\1$"
)
MEMORY = (
    r"^this takes more memory than a question may: at least [\d.e+]+ MB, where [\d.]+ MB are allowed; "
    r"take fewer benches, fewer sizes of benches or a shorter walk \(walk.start, walk.end\), or "
    r"allow (\S+) times as much on the command line by BENCHDRAGON_BUDGET=\1$"
)


@pytest.fixture
def small_budget(monkeypatch: pytest.MonkeyPatch) -> None:
    """A thousandth of work and of memory."""
    monkeypatch.setenv(budget.VARIABLE, "0.001")


def test_work_is_counted_and_refused_when_it_is_used_up() -> None:
    with budget.question():
        assert budget.left() == budget.WORK
        budget.spend(budget.WORK - 10.0)
        budget.expect(10.0)
        with pytest.raises(OverBudgetError, match=WORK):
            budget.expect(11.0)
        assert budget.left() == 10.0
        with pytest.raises(OverBudgetError, match=WORK):
            budget.spend(11.0)
        assert budget.left() == 0.0


def test_tables_are_refused_before_they_are_made() -> None:
    with budget.question():
        budget.hold(budget.MEMORY)
        with pytest.raises(OverBudgetError, match=MEMORY):
            budget.hold(budget.MEMORY + 1.0)


def test_a_question_within_a_question_is_a_part_of_it() -> None:
    with budget.question():
        budget.spend(7.0)
        with budget.question(100):
            assert budget.left() == budget.WORK - 7.0
            budget.spend(3.0)
        assert budget.left() == budget.WORK - 10.0
    with budget.question(3):
        assert budget.left() == 3 * budget.WORK


def test_outside_of_questions_nothing_is_counted() -> None:
    budget.spend(2.0 * budget.WORK)
    budget.hold(2.0 * budget.MEMORY)
    assert budget.left() == float("inf")


@pytest.mark.parametrize("value", ["", "x", "nan", "-1", "1e7", "inf"])
def test_a_budget_that_is_no_number_is_refused(monkeypatch: pytest.MonkeyPatch, value: str) -> None:
    monkeypatch.setenv(budget.VARIABLE, value)
    with pytest.raises(InputError, match=r"BENCHDRAGON_BUDGET must be a number from 0 to 1e\+06, not "):
        check(read_plan("spiral-in", FEW))


@pytest.mark.usefixtures("small_budget")
@pytest.mark.parametrize(("language", "word"), [("en", "take fewer benches"), ("zh", "请减少板凳")])
def test_the_command_line_says_what_would_make_it_smaller(
    capsys: pytest.CaptureFixture[str], language: str, word: str
) -> None:
    use_language(language)
    code = run(["check", "turn", "--quiet"])
    use_language("en")
    said = capsys.readouterr()
    assert (code, said.out) == (OverBudgetError.exit_code, "")
    assert word in said.err
    assert len(said.err.splitlines()) == 1


@pytest.mark.usefixtures("small_budget")
@pytest.mark.parametrize(
    "asked", ["first_contact", "clearance", "greatest_speed", "greatest_head_speed", "smallest_pitch"]
)
def test_a_sweep_goes_on_beside_a_point_that_takes_too_much(asked: str) -> None:
    plan = read_plan("spiral-in", ["disc.radius=4.5", "limits.speed=3"])
    found = outcome(questions([asked])[0], plan, RandomDances())
    assert found.status == "undecided"
    assert found.message is not None
    assert found.message.startswith("this takes more ")


def test_a_small_odd_plan_that_took_two_gigabytes_is_refused() -> None:
    with pytest.raises(OverBudgetError, match=MEMORY):
        limit(checked(small(23), "plan"), "length")


def test_a_greater_budget_answers(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "a.dragon.toml"
    path.write_text('schema = 1\nbase = "turn"\n[dragon]\nbenches = 40\n', encoding="utf-8")
    codes = []
    for times in ("0.0005", "1"):
        monkeypatch.setenv(budget.VARIABLE, times)
        codes.append(run(["check", str(path), "--json", "--quiet"]))
    assert codes == [5, 0]
    assert json.loads(capsys.readouterr().out)["safe"]


@pytest.mark.parametrize("language", ["en", "zh"])
def test_what_is_stated_is_what_is_kept(language: str) -> None:
    said = (Path(__file__).parents[1] / "docs" / language / "exact.md").read_text(encoding="utf-8")
    for number in (f"{budget.WORK / 1e6:,.0f}", f"{budget.MEMORY / 1e6:.0f} MB", budget.VARIABLE):
        assert number in said


SEARCHES: dict[str, tuple[str, int, Callable[[Walk], object], float]] = {
    "contact": ("spiral-in", 30, lambda walk: first_contact(walk, 0.0, 100.0), 500.0),
    "speed of many": ("spiral-in", 30, lambda walk: greatest_speed(walk, 0.0, 100.0), 100_000.0),
    "speed of few": ("turn", 6, lambda walk: greatest_speed(walk, -5.0, 20.0), 100_000.0),
}


@pytest.mark.parametrize("name", list(SEARCHES))
def test_searches_count_what_kernels_place(name: str) -> None:
    plan, benches, search, least = SEARCHES[name]
    walk = read_plan(plan, [f"dragon.benches={benches}"]).build()
    with budget.question():
        search(walk)
        assert budget.WORK - budget.left() > least


def test_bounds_of_a_pace_are_refused_before_they_are_begun(monkeypatch: pytest.MonkeyPatch) -> None:
    plan = read_plan("spiral-in", ["dragon.benches=30", "limits.speed=2"])
    monkeypatch.setattr(head_speed, "PeakQuestion", lambda *_arguments: pytest.fail("it began"))
    monkeypatch.setenv(budget.VARIABLE, "0.0001")
    with budget.question(), pytest.raises(OverBudgetError, match=WORK):
        head_speed._fastest(plan, plan.build(), 0.0, 100.0, silent)


@pytest.mark.parametrize("share", ["0.02", "0.01", "0.005"])
def test_a_search_goes_on_after_a_pass_whose_room_was_too_large(
    monkeypatch: pytest.MonkeyPatch, share: str
) -> None:
    """The pass gave its tables back: what comes after makes its own, and tells a wider bracket."""
    plan = read_plan(
        "spiral-in",
        {
            "route.pitch": 0.87, "route.start_turn": 10.24, "route.clockwise": True,
            "dragon.benches": 24, "dragon.width": 0.53, "dragon.front_inset": 0.23,
            "dragon.tail_length": 1.267, "disc.radius": 4.5, "walk.start": 5.84, "walk.end": 70,
            "walk.profile": [[-20, 0.5], [-3, 0], [4, 0.766], [10, 1]],
        },
    )  # fmt: skip
    whole = check(plan).clearance
    monkeypatch.setenv(budget.VARIABLE, share)
    found = check(plan).clearance
    assert found.lower < whole.lower - 0.1
    assert found.lower <= whole.upper
    assert found.upper >= whole.lower
