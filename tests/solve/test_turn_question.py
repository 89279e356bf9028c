"""The engine's question about the best turn: what it sees is true, and its steps are the best ones."""

import json
import math
import os
import subprocess
import sys
from collections.abc import Iterator

import numpy as np
import pytest
from scipy.optimize import linprog

from benchdragon import budget
from benchdragon.analysis.speed import QUANTITIES
from benchdragon.hosts.serving import VARIABLE
from benchdragon.kernels import turn_descent as descent
from benchdragon.kernels import turn_peaks as judged
from benchdragon.kernels import turn_question as kernel
from benchdragon.kernels import turn_trial as trial
from benchdragon.kernels.memory import held
from benchdragon.kernels.question import QuestionEnding
from benchdragon.kernels.turn_peaks import PeakRow, TurnMeasure
from benchdragon.kernels.turn_question import TurnSought
from benchdragon.model.obstacle import Obstacle
from benchdragon.plans.schema import read_plan
from benchdragon.progress import silent
from benchdragon.solve.turn import _exact_figures
from benchdragon.solve.turn_goal import TurnFamily, TurnGoal
from benchdragon.solve.turn_question import TurnQuestion

FEW = "dragon.benches=2"
BOTH = ["turn.entry_radius=4.45", "turn.exit_radius=4.45"]
POST = 'obstacle=[{kind="circle", name="post", centre=[1.2, 0.6], radius=0.2}]'


@pytest.fixture(autouse=True)
def short(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Plain Python searches less; and all that the engine holds for questions is given back."""
    for name, value in {
        "STREWN": 3,
        "STARTS": 2,
        "MOST_DESCENT_STEPS": (1, 1),
        "RATE_STEPS": (0.3, 0.15),
    }.items():
        monkeypatch.setattr(kernel, name, value)
    monkeypatch.setattr(trial, "NARROWED", 22)
    monkeypatch.setattr(descent, "NARROWINGS", 12)
    before = held()
    yield
    assert held() == before


@pytest.mark.parametrize(
    ("settings", "goal"),
    [
        (["turn.family=arc-line-arc", "walk.speed=1.3", FEW], TurnGoal("way")),
        (["limits.total_acceleration=0.9", "turn.ease=0.3", FEW, *BOTH], TurnGoal("length")),
        (["turn.family=arc-line-arc", "limits.turning_rate=60", FEW, *BOTH], TurnGoal("speed")),
        (["dragon.benches=4", "limits.margin=0.3", *BOTH], TurnGoal("disc")),
        ([FEW, POST, "venue.rectangle=[30, 30]", *BOTH], TurnGoal("way")),
    ],
)
def test_what_is_seen_of_a_turn_is_what_exact_figures_say(settings: list[str], goal: TurnGoal) -> None:
    family = TurnFamily(read_plan("turn", settings), goal)
    with TurnQuestion(family) as question:
        inner = [0.0] if len(family.bounds) == 3 else [1.6, 1.6]
        seen = question.near([4.45, 4.45, *inner], silent, "")
        assert math.isfinite(seen.exceeds)
        exact, _clearance = _exact_figures(family.with_turn(seen.x), seen.figures, list(QUANTITIES))
        for kind in range(TurnMeasure.BESIDE + 1):
            near = 1e-5 if kind < judged.RATES else 1e-4
            if kind != TurnMeasure.APART and np.isfinite(seen.figures[kind] + exact[kind]):
                assert seen.figures[kind] == pytest.approx(exact[kind], abs=near)
        turn = family.turn(seen.x)
        assert seen.figures[TurnMeasure.LONG] == pytest.approx(turn.length, abs=1e-12)
        assert seen.figures[TurnMeasure.WAY] == pytest.approx(turn.way(family.disc), abs=1e-12)
        assert seen.figures[TurnMeasure.BEND] == pytest.approx(1.0 / turn.least_radius, abs=1e-12)
        reach = max(turn.extent, turn.entry_radius, turn.exit_radius)
        assert seen.figures[TurnMeasure.REACH] == pytest.approx(reach, abs=1e-4)
        found = question.exceeded(seen.figures)
        assert found["radius"] == pytest.approx(family.narrowest / turn.least_radius - 1.0, abs=1e-12)
        found.pop(goal.objective, None)
        assert max(*found.values(), 0.0) == pytest.approx(seen.exceeds, abs=1e-4)


@pytest.mark.parametrize("kind", ["venue", "polygon", "line", "circle"])
def test_benches_on_the_wrong_side_of_an_obstacle_are_too_near_by_all_of_that(kind: str) -> None:
    points = [(-30.0, -30.0), (30.0, -30.0), (30.0, 30.0), (-30.0, 30.0)]
    made = {
        "venue": Obstacle.venue("", points), "polygon": Obstacle.polygon("", points),
        "line": Obstacle.line("", points), "circle": Obstacle.circle("", (0.0, 0.0), 1.0),
    }[kind]  # fmt: skip
    family = TurnFamily(read_plan("turn", [FEW, *BOTH]), TurnGoal())
    family.obstacles = [made]
    with TurnQuestion(family) as question:
        seen = question.near([4.45, 4.45, 0.0], silent, "")
        nearest = seen.figures[TurnMeasure.BESIDE]
    if kind == "circle":
        assert 1.0 < nearest < 1.5, "a bench is over its middle"
    elif kind == "polygon":
        assert nearest > 25.0, "all of the turn is inside"
    else:
        assert math.isnan(nearest), "nothing is near"


@pytest.mark.parametrize("seed", range(12))
def test_a_step_goes_to_the_best_point_of_all_lines(seed: int) -> None:
    """By SciPy's HiGHS: lines of peaks within a range of trust, what exceeds a limit counting HARD."""
    rng = np.random.default_rng(seed)
    unknowns, peaks = int(rng.integers(1, 6)), int(rng.integers(2, 30))
    low, x = np.zeros(unknowns), rng.uniform(0.0, 1.0, unknowns)
    x[0] = 0.0
    told = np.array([0.0] * 9 + [TurnMeasure.WAY] + [1.0] * judged.RATES)
    known = np.zeros((judged.MOST_KEPT, judged.PEAK_COLUMNS))
    known[:peaks, PeakRow.KIND] = rng.choice([TurnMeasure.WAY, 0], peaks)
    known[0, PeakRow.KIND] = TurnMeasure.WAY
    known[:peaks, PeakRow.MEASURE] = rng.normal(0.0, 0.05, peaks)
    slopes = rng.normal(0.0, 1.0, (judged.MOST_KEPT, judged.UNKNOWNS))
    state = np.array([peaks, 0.0, 0.0, 0.05, 1.0])
    size = descent.STEP_UNKNOWNS
    point = descent.Descent(
        x, x.copy(), np.zeros(size), known, slopes, np.zeros((descent.MOST_LINES,
        descent.LINE_COLUMNS)),
        np.zeros((size, size + 1)), state,
    )  # fmt: skip
    tried = Limits(told, low, np.ones(unknowns))
    promised = descent.best_move(tried, point)  # type: ignore[arg-type]
    above, least = [], []
    for n in range(peaks):
        best = known[n, PeakRow.KIND] == TurnMeasure.WAY
        above.append([*slopes[n, :unknowns], -1.0 * best, -1.0 * (not best)])
        least.append(-known[n, PeakRow.MEASURE])
    ranges = [(max(-0.05, -at), min(0.05, 1.0 - at)) for at in x]
    bounds = [*ranges, (None, None), (0.0, None)]
    solved = linprog([0.0] * unknowns + [1.0, descent.HARD], above, least, bounds=bounds)
    assert promised == pytest.approx(solved.fun, abs=1e-8)
    assert all(a - 1e-9 <= move <= b + 1e-9 for move, (a, b) in zip(point.move, ranges, strict=False))


class Limits:
    """As much of a trial as steps ask for."""

    def __init__(self, told: np.ndarray, low: np.ndarray, high: np.ndarray) -> None:
        self.told, self.low, self.high = told, low, high


def test_points_are_strewn_evenly_and_starts_lie_apart() -> None:
    for unknowns in range(1, 7):
        base = kernel.spread(unknowns)
        assert base ** (unknowns + 1) == pytest.approx(base + 1.0)
        shares = (0.5 + np.arange(512)[:, np.newaxis] / base ** np.arange(1.0, unknowns + 1.0)) % 1.0
        for column in shares.T:
            counts, _edges = np.histogram(column, bins=16, range=(0.0, 1.0))
            assert counts.min() > 20


def test_work_is_counted_and_may_be_too_much(monkeypatch: pytest.MonkeyPatch) -> None:
    family = TurnFamily(read_plan("turn", [FEW, *BOTH]), TurnGoal())
    with budget.question(), TurnQuestion(family) as question:
        before = budget.left()
        question.best(silent, "")
        assert before - budget.left() > 100.0
        assert question.tried > 4
    monkeypatch.setattr(budget, "WORK", 50)
    with (
        pytest.raises(budget.OverBudgetError, match="takes more work than a question may"),
        budget.question(),
        TurnQuestion(family) as question,
    ):
        question.best(silent, "")


def test_a_question_that_is_closed_answers_no_more() -> None:
    family = TurnFamily(read_plan("turn", [FEW, *BOTH]), TurnGoal())
    question = TurnQuestion(family)
    handle = question._handle
    question.close()
    some = [np.zeros(count) for count in (kernel.TURN_FIGURES, 3, judged.TURN_MEASURES)]
    assert not kernel.read_turn(handle, *some)
    assert not kernel.seek_turn(handle, TurnSought.NEAR, some[1], some[2])
    assert not kernel.judge_turn(handle, some[2], some[2])
    assert kernel.step_turn(handle, math.inf) == QuestionEnding.CLOSED


ASKED = """
from benchdragon.plans.schema import read_plan
from benchdragon.progress import silent
from benchdragon.solve.turn_goal import TurnFamily, TurnGoal
from benchdragon.solve.turn_question import TurnQuestion
plan = read_plan("turn", ["dragon.benches=2", "turn.entry_radius=4.5", "turn.exit_radius=4.5"])
with TurnQuestion(TurnFamily(plan, TurnGoal("speed"))) as question:
    seen = question.near([4.5, 4.5, 0.3], silent, "")
print([seen.x, seen.figures, seen.exceeds])
"""


def test_plain_python_answers_as_the_engine_does() -> None:
    told = []
    for engine in ({}, {VARIABLE: "plain"}):
        done = subprocess.run(
            [sys.executable, "-c", ASKED],
            env={**os.environ, **engine},
            check=True,
            stdout=subprocess.PIPE,
        )
        told.append(json.loads(done.stdout.replace(b"nan", b"NaN").replace(b"inf", b"Infinity")))
    for one, other in zip(*told, strict=True):
        assert one == pytest.approx(other, rel=1e-7, nan_ok=True)
