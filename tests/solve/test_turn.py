"""Better turns: what is found keeps its limits by brute force, and beats the paper's."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from benchdragon import BenchDragonError, InputError
from benchdragon.cli.main import run
from benchdragon.errors import NoSolutionError
from benchdragon.kernels.turn_peaks import TURN_MEASURES, TurnMeasure
from benchdragon.model.answer import Answer
from benchdragon.model.turns import TwoArcTurn
from benchdragon.model.walk import Motion
from benchdragon.paper.results import better_turns
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.plans.toml import PlanError
from benchdragon.solve import turn
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.turn import BestTurn, pareto_front, undominated
from benchdragon.solve.turn import best_turn as sought
from benchdragon.solve.turn_goal import TurnFamily, TurnGoal
from benchdragon.solve.turn_question import TurnQuestion

PAPER = TwoArcTurn(1.7)


def plan(*settings: str) -> Plan:
    return read_plan("turn", ["turn.family=arc-line-arc", "dragon.benches=45", *settings])


def sampled(best: BestTurn) -> tuple[float, float]:
    """Greatest speed ratio, each 0.1 m, and least distance, each metre, by brute force with shapely."""
    walk = best.plan.build()
    first, last = walk.route.joints[1], walk.head_where_tail(float(walk.route.joints[-2]))
    at = np.arange(first, last, 0.1)
    motion: Motion = walk.motion((at - walk.start) / best.plan.walk.speed)
    near = math.inf
    for t in range(0, len(at), 10):
        benches = motion[t].outlines()[0]
        for i in range(len(benches) - 2):
            near = min(near, float(shapely.distance(benches[i], benches[i + 2 :]).min()))
    return float(np.asarray(motion.speed_ratio).max()), near


def test_a_shorter_and_faster_turn_keeps_its_limits_by_brute_force() -> None:
    goal = TurnGoal("way", least_radius=PAPER.radii[1])
    best = sought(plan("walk.speed=1.3"), goal)
    assert best.length == pytest.approx(sum(piece[0] for piece in best.turn.pieces))
    assert best.length <= best.way < 11.5
    assert best.turn.least_radius >= PAPER.radii[1] * (1.0 - 1e-6)
    assert best.head_speed is not None
    assert best.head_speed.lower >= 1.3 * (1.0 - 1e-6)
    ratio, near = sampled(best)
    assert 1.3 * ratio <= 2.0 * (1.0 + 1e-6)
    assert near >= best.clearance.lower - 1e-12
    assert best.clearance.lower > 0.2
    assert "speed" in best.active


# Ways, m, by speed: of turns found by hand over two radii, and what the report told before.
BY_HAND = {1.52: 11.8752, 1.54: 11.9784}
TOLD_BEFORE = {
    1.26: 11.301198, 1.28: 11.323790, 1.30: 11.346395, 1.32: 11.370230, 1.34: 11.396641,
    1.36: 11.422638, 1.38: 11.450769, 1.40: 11.481658, 1.42: 11.513955, 1.44: 11.547768,
    1.46: 11.583707, 1.48: 11.630873, 1.50: 11.683972, 1.52: 11.986198, 1.54: 11.986198,
    1.56: 12.062829, 1.58: 12.143679, 1.60: 12.225620, 1.62: 12.308883, 1.64: 12.394563,
    1.66: 12.480244, 1.68: 12.569986, 1.70: 12.704565, 1.72: 13.217627,
}  # fmt: skip


@pytest.mark.parametrize("speed", BY_HAND)
def test_no_turn_that_was_found_by_hand_is_shorter(speed: float) -> None:
    whole = read_plan("turn", ["turn.family=arc-line-arc", f"walk.speed={speed}"])
    best = sought(whole)
    assert best.way < BY_HAND[speed]
    assert best.head_speed is not None
    assert best.head_speed.lower >= speed * (1.0 - 1e-6)
    assert "speed" in best.active, "it is polished until a limit binds"
    assert sought(whole).turn == best.turn, "the search is the same each time"


def test_the_front_of_the_report_is_shorter_everywhere_than_it_was() -> None:
    front = better_turns(read_plan("turn"), tuple(TOLD_BEFORE), "en")
    for best, (speed, before) in zip(front, TOLD_BEFORE.items(), strict=True):
        assert best.plan.walk.speed == speed
        assert best.way <= before
        assert best.head_speed is not None
        assert best.head_speed.lower >= speed * (1.0 - 1e-6)
        assert best.way <= BY_HAND.get(speed, math.inf)
    ways = [best.way for best in front]
    assert ways == sorted(ways)


def test_what_a_limit_is_exceeded_by_is_told() -> None:
    limited = plan("limits.acceleration=2", "limits.total_acceleration=3", "walk.speed=1.5")
    with TurnQuestion(TurnFamily(limited, TurnGoal("way", 1.6, 13.0, 14.0))) as question:
        exact = np.zeros(TURN_MEASURES)
        exact[[0, 3, 4, TurnMeasure.APART, TurnMeasure.BESIDE, TurnMeasure.REACH, TurnMeasure.BEND,
        TurnMeasure.LONG, TurnMeasure.WAY]] = (
            1.4, 1.5, 0.8, -0.15, 0.06, 4.6, 0.65, 12.0, 14.7,
        )  # fmt: skip
        found = question.exceeded(exact.tolist())
    wanted = {
        "radius": 1.6 * 0.65 - 1.0, "disc": 4.6 / 4.5 - 1.0, "length": 12.0 / 13.0 - 1.0,
        "way": 14.7 / 14.0 - 1.0, "speed": 1.5 * 1.4 / 2.0 - 1.0,
        "total_acceleration": 1.5**2 * 1.5 / 3.0 - 1.0, "acceleration": 1.5**2 * 0.8 / 2.0 - 1.0,
        "clearance": -0.15 / 0.3, "obstacles": 0.06 / 0.3,
    }  # fmt: skip
    assert found == pytest.approx(wanted)
    assert list(found) == list(wanted)


def test_a_turn_that_a_look_flattered_is_sought_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """Exact figures that are a tenth worse than what is seen narrow the limit by as much."""
    judged = turn._exact_figures

    def worse(*arguments: Any) -> tuple[list[float], Answer]:
        exact, clearance = judged(*arguments)
        exact[0] *= 1.1
        return exact, clearance

    joints = ["turn.entry_radius=4.5", "turn.exit_radius=4.5", "dragon.benches=12", "walk.speed=1.2"]
    before = sought(plan(*joints))
    monkeypatch.setattr(turn, "_exact_figures", worse)
    after = sought(plan(*joints))
    assert after.head_speed is not None
    assert after.head_speed.lower >= 1.2 * 1.1 * (1.0 - 1e-6)
    assert after.way > before.way


def test_the_fastest_turn_no_longer_than_the_paper_s() -> None:
    best = sought(plan(), TurnGoal("speed", longest=PAPER.length, longest_way=PAPER.length))
    assert best.way <= PAPER.length * (1.0 + 1e-6)
    assert best.objective.unit == "m/s"
    assert best.objective.value > 1.7
    ratio, _near = sampled(best)
    assert best.objective.value * ratio == pytest.approx(2.0, rel=2e-3)


def test_between_the_disc_s_joints_no_two_arcs_are_shorter_by_an_independent_optimiser() -> None:
    settings = ["turn.family=arc-arc", "turn.entry_radius=4.5", "turn.exit_radius=4.5"]
    best = sought(plan(*settings, "walk.speed=1.2"), TurnGoal("length"))
    assert best.length == pytest.approx(PAPER.length, abs=1e-9)
    assert best.way == pytest.approx(PAPER.length, abs=1e-9)


def test_the_front_rises_with_the_speed() -> None:
    front = pareto_front(plan(), (1.3, 1.6), TurnGoal("way"))
    assert [best.plan.walk.speed for best in front] == [1.3, 1.6]
    assert front[0].way < front[1].way < PAPER.length
    for best in front:
        exact = greatest_head_speed(best.plan)
        assert exact.lower >= best.plan.walk.speed * (1.0 - 1e-6)


def test_the_front_is_as_short_as_any_turn_known_where_it_bends() -> None:
    goal = TurnGoal("way", least_radius=PAPER.radii[1])
    front = pareto_front(plan(), (1.66, 1.683, 1.7), goal)
    slow, middle, fast = (best.way for best in front)
    assert slow < 12.49
    assert middle < 12.603
    assert fast < 12.75
    assert front[1].head_speed is not None
    assert front[1].head_speed.lower >= 1.683 * (1.0 - 1e-6)


def of_front(speed: float, way: float, allowed: float, *active: str) -> BestTurn:
    """A turn found for a head speed, with the length and the greatest head speed that it has."""
    objective = Answer(way, -math.inf, way, "m", "found")
    greatest = Answer(allowed, allowed, allowed, "m/s", "found")
    found = plan(f"walk.speed={speed}")
    turn_ = found.turn.build(1.7, 4.5)
    return BestTurn(found, turn_, objective, way, way, greatest, greatest, active)


def test_no_turn_of_a_front_is_longer_and_slower_than_another() -> None:
    """1.5415 m/s with 11.9914 m beside 1.5418 m/s with 11.9862 m: the second stands for both speeds."""
    front = undominated([
        of_front(1.48, 11.60, 1.4801, "speed", "clearance"),
        of_front(1.50, 11.80, 1.56, "clearance"),
        of_front(1.52, 11.9862, 1.5418, "speed"),
        of_front(1.54, 11.9914, 1.5415, "speed", "radius"),
        of_front(1.60, 12.20, 1.60, "speed"),
    ])  # fmt: skip
    assert [best.plan.walk.speed for best in front] == [1.48, 1.50, 1.52, 1.54, 1.60]
    assert [best.way for best in front] == [11.60, 11.80, 11.80, 11.80, 12.20]
    assert [best.active for best in front[:4]] == [("speed", "clearance"), *3 * [("clearance",)]]
    front = undominated([of_front(1.52, 11.9862, 1.5418, "speed"), of_front(1.54, 11.9914, 1.5415)])
    assert [best.way for best in front] == [11.9862, 11.9862]
    assert [best.active for best in front] == [("speed",), ("speed",)]


@pytest.mark.parametrize("seed", range(20))
def test_fronts_rise_whatever_was_found(seed: int) -> None:
    rng = np.random.default_rng(seed)
    speeds = np.sort(rng.uniform(1.2, 1.8, 8))
    found = [of_front(v, rng.uniform(11.0, 13.0), v + rng.uniform(0.0, 0.4)) for v in speeds]
    front = undominated(found)
    for best, own in zip(front, found, strict=True):
        assert best.plan.walk.speed == own.plan.walk.speed <= best.head_speed.lower  # type: ignore[union-attr]
        assert best.way <= own.way
    for one in front:
        assert not any(
            other.way < one.way and other.head_speed.lower > one.head_speed.lower  # type: ignore[union-attr]
            for other in front
        )


def test_clothoids_bound_accelerations_and_cost_length() -> None:
    plain = sought(plan("walk.speed=1.3"), TurnGoal("way"))
    eased = sought(plan("walk.speed=1.3", "turn.ease=0.8"), TurnGoal("way"))
    assert 0.1 < eased.way - plain.way < 2.0
    bends = [end for _length, *ends in eased.turn.pieces for end in ends]
    assert bends[1:-1:2] == bends[2:-1:2]
    answer = greatest_head_speed(
        eased.plan.model_copy(
            update={"limits": eased.plan.limits.model_copy(update={"acceleration": 1.0})}
        ),
        tolerance=1e-4,
    )
    assert answer.status == "found"
    assert answer.upper - answer.lower < 1e-3 * answer.value


@pytest.mark.parametrize("family", ["arc-arc", "arc-line-arc", "arc-arc-arc"])
@pytest.mark.parametrize("objective", ["way", "acceleration"])
def test_a_plan_says_the_unknowns_of_its_turn(family: str, objective: str) -> None:
    found = TurnFamily(read_plan("turn", [f"turn.family={family}"]), TurnGoal(objective))
    x = [0.5 * (low + high) for low, high in found.bounds]
    said = found.with_turn(x).turn
    own = [said.entry_radius, said.exit_radius]
    if family == "arc-arc":
        own.append(math.log(said.ratio))
    else:
        assert said.radii is not None
        middle = [said.curvature] if family == "arc-arc-arc" else []
        own += [said.radii[0], *middle, said.radii[1]]
    if objective == "acceleration":
        own.append(said.ease)
    assert own == pytest.approx(x)


@pytest.mark.parametrize(
    ("settings", "goal", "text"),
    [
        ([], TurnGoal("way", longest_way=5.0), "no turn of this family"),
        (["limits.margin=1.2"], TurnGoal("way"), "no turn of this family"),
    ],
)
def test_wishes_that_cannot_be_are_said_so(settings: list[str], goal: TurnGoal, text: str) -> None:
    with pytest.raises(NoSolutionError, match=text):
        sought(plan(*settings), goal)
    assert NoSolutionError.exit_code == 4


def test_the_smallest_disc_is_put_into_the_plan() -> None:
    best = sought(plan("walk.speed=1.0"), TurnGoal("disc"))
    assert best.objective.value < 3.5
    assert best.plan.disc.radius == best.objective.value
    best.plan.build()
    assert best.clearance.lower > 0.0


def test_only_turns_have_a_best_turn() -> None:
    with pytest.raises(BenchDragonError, match="route is a turn"):
        sought(read_plan("spiral-in"))
    with pytest.raises(InputError, match="expected one of"):
        TurnGoal("beauty")


def test_speeds_that_cannot_be_are_refused_before_any_search(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(turn, "TurnQuestion", lambda *_arguments: pytest.fail("it searched"))
    with pytest.raises(
        PlanError, match=r"^--set: walk\.profile: the times of a speed profile must incr"
    ):
        sought(read_plan("turn", ["walk.profile=[[0,1],[0,1]]"]))


def test_a_turn_that_is_not_there_ends_as_the_help_says(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["solve", "turn", "turn", "--set", "turn.family=arc-line-arc", "--longest-way", "5"]
    assert run([*words, "--set", "dragon.benches=20", "--json"]) == 4
    out, err = capsys.readouterr()
    assert (out, err) == ("", "Error: no turn of this family was found that keeps the limits\n")


def test_the_command_line_finds_writes_and_says_it(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found_before: list[BestTurn] = []

    def found_once(*arguments: Any, **options: Any) -> BestTurn:
        found_before.extend([] if found_before else [sought(*arguments, **options)])
        return found_before[0]

    monkeypatch.setattr(turn, "best_turn", found_once)
    path = tmp_path / "best.dragon.toml"
    words = ["solve", "turn", "turn", "--quiet", "--set", "turn.family=arc-line-arc"]
    words += ["--set", "walk.speed=1.3", "--set", "dragon.benches=30", "-o", str(path)]
    assert run(words) == 0
    out = capsys.readouterr().out
    assert "shortest path inside the disc" in out
    assert "arc to the right, radius" in out
    assert str(path) in out
    assert run([*words, "--json"]) == 2  # it is there already
    capsys.readouterr()
    assert run([*words, "--json", "--force"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["way"] == pytest.approx(found["value"])
    assert read_plan(str(path)).turn.radii == pytest.approx(found["turn"]["radii"])
    assert run(["check", str(path), "--quiet"]) == 0


def test_one_joint_may_stay_while_the_other_moves() -> None:
    plan = read_plan("turn", ["turn.entry_radius=4.2"])
    best = turn.best_turn(plan)
    assert best.turn.entry_radius == 4.2
    assert best.turn.exit_radius <= 4.5
    assert best.head_speed is not None
    assert best.head_speed.lower >= 1.0
