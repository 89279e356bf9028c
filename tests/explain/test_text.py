"""Explanations: a pocket calculator gets what they say, and they say what the program answers."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from benchdragon import Dragon, Line, LogSpiral, Route
from benchdragon.analysis.check import check
from benchdragon.analysis.distance import pair_distances, tightest_pairs
from benchdragon.cli.main import run
from benchdragon.explain.answers import limit_lines, speed_lines, turn_lines
from benchdragon.explain.contact import check_lines, gap_lines
from benchdragon.explain.text import motion_lines, number
from benchdragon.i18n import spoken_in
from benchdragon.model.answer import Answer
from benchdragon.model.walk import Walk
from benchdragon.plans.routes import TurnRoute
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.solve import turn
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.size import limit
from benchdragon.solve.turn import BestTurn
from tests.calculator import agree, chinese_or_not, sums

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.dragon.toml"))
PLANS = ["spiral-in", "turn", *(str(path) for path in EXAMPLES)]
# A few seconds' work instead of minutes: the turn's first benches.
SHORT = ["--set", "dragon.benches=25"]


def numbers_after(mark: str, lines: list[str]) -> list[float]:
    """The last number of each line that holds a mark."""
    return [
        float(re.findall(r"-?[0-9][0-9.]*[0-9]|-?[0-9]", line)[-1]) for line in lines if mark in line
    ]


def stated(name: str, lines: list[str]) -> float:
    """What the first line that gives a name in metres gives it as."""
    found = [re.search(rf"{name} =(?:[^=;；≈]*=)* (-?[0-9.]+) m", line) for line in lines]
    return float(next(match for match in found if match).group(1))


def json_of(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, object]:
    """The one object that a command line prints with --json --explain."""
    run([*arguments, "--json", "--explain", "--quiet"])
    found: dict[str, object] = json.loads(capsys.readouterr().out)
    return found


def lines_of(capsys: pytest.CaptureFixture[str], *arguments: str) -> list[str]:
    """The explanation in the JSON of one command line."""
    lines = json_of(capsys, *arguments)["explanation"]
    assert isinstance(lines, list)
    return [str(line) for line in lines]


def test_a_calculator_of_this_kind_finds_a_wrong_sum() -> None:
    with pytest.raises(AssertionError):
        agree(["x = 1 + 1 = 3"], 1)
    lines = ["x0 = xC + r0·cos(φ0) = 1 + 2·cos(0) = 3 m", "c·u0²/2 = 0.5·2²/2 = 1 and no more"]
    assert sums(lines) == [
        ("1 + 2·cos(0)", 3.0, 3.0), ("0.5·2²/2", 1.0, 1.0),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("value", "text"),
    [(60.0, "60"), (-0.0, "0"), (412.47383768211, "412.473838"), (0.0875352187, "0.087535219"),
     (1.5, "1.5"), (-4e-17, "0"), (0.0, "0"), (7.4567578, "7.4567578"), (1e-5, "0.00001")],
)  # fmt: skip
def test_numbers_are_short_and_plain(value: float, text: str) -> None:
    assert number(value) == text


def halfway(plan: Plan) -> list[float]:
    """Times all over a plan's walk, every part of its route under the head among them."""
    walk = plan.build()
    start, end = plan.span(walk)
    at = (walk.route.joints[:-1] + walk.route.joints[1:]) / 2.0
    times = [walk.profile.time(float(s) - walk.start) for s in at]
    return [t for t in (start, *times, 0.5 * (start + end)) if start <= t <= end]


@pytest.mark.parametrize("name", PLANS, ids=lambda name: Path(name).name)
def test_motion_is_explained_on_every_part_of_every_plan(name: str, spoken: str) -> None:
    plan = read_plan(name)
    walk = plan.build()
    for time in halfway(plan):
        motion = walk.motion([time])
        lines = motion_lines(motion)
        agree(lines, 8)
        chinese_or_not(lines, spoken)
        (v1,) = numbers_after("v1 = ", lines)
        assert v1 == pytest.approx(motion.speed[0, 1], abs=1e-7)
        for i, (x, y) in enumerate(zip(motion.x[0, :2], motion.y[0, :2], strict=True)):
            assert stated(f"x{i}", lines) == pytest.approx(x, abs=1e-6)
            assert stated(f"y{i}", lines) == pytest.approx(y, abs=1e-6)


def test_a_place_on_a_curve_without_formulas_here_is_told_all_the_same(spoken: str) -> None:
    route = Route.joined([Line(60.0), LogSpiral(20.0, 0.1, 0.3)])
    motion = Walk(Dragon.uniform(4, 2.2), route).motion([61.0, 75.0])
    lines = motion_lines(motion)
    agree(lines, 8)
    chinese_or_not(lines, spoken)
    for t, head in enumerate((1.0, 15.0)):
        here = motion_lines(Walk(Dragon.uniform(4, 2.2), route).motion([60.0 + head]))
        kind = {"en": "on a logarithmic spiral, part 2 of 2", "zh": "对数螺线"}[spoken]
        assert kind in "\n".join(here)
        for i in range(2):
            assert stated(f"x{i}", here) == pytest.approx(motion.x[t, i], abs=1e-6)
            assert stated(f"y{i}", here) == pytest.approx(motion.y[t, i], abs=1e-6)


def test_the_first_sound_time_is_explained_and_a_dragon_that_never_stands_is_said_so() -> None:
    walk = read_plan("spiral-in").build()
    later = motion_lines(walk.motion([500.0, 60.0], throw=False))
    assert later[:-1] == motion_lines(walk.motion([60.0]))[:-1]
    assert len(motion_lines(walk.motion([500.0], throw=False))) == 1


def test_a_profile_is_written_out_as_areas() -> None:
    plan = read_plan(next(str(path) for path in EXAMPLES if "stop_and_go" in path.name))
    walk = plan.build()
    assert len(plan.walk.profile) > 2
    for time in (-50.0, 0.0, 24.0):
        (written, value, stated), *_others = sums(motion_lines(walk.motion([time]))[:1])
        assert value == pytest.approx(float(walk.head_position([time])[0]), abs=1e-6), written
        assert stated == pytest.approx(value, abs=1e-6)


def test_the_head_by_runge_kutta_is_set_beside(capsys: pytest.CaptureFixture[str]) -> None:
    plain = ("motion", "spiral-in", "--at", "300")
    with_rk4 = lines_of(capsys, *plain, "--leader", "rk4", "--step", "1")
    (more,) = set(with_rk4) - set(lines_of(capsys, *plain)) - {with_rk4[-1]}
    assert more.startswith("rk4 ")


def test_the_screen_numbers_the_lines_that_json_holds(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, spoken: str
) -> None:
    plain = ["motion", str(EXAMPLES[0]), "--at", "205"]
    assert run([*plain, "--explain"]) == 0
    printed = capsys.readouterr().out.splitlines()
    lines = lines_of(capsys, *plain)
    numbered = [f"{n:3}. {line}" for n, line in enumerate(lines, start=1)]
    assert printed[-len(lines) :] == numbered
    assert run([*plain, "-o", str(tmp_path), "--format", "csv", "--explain"]) == 0
    assert capsys.readouterr().out.splitlines()[-len(lines) :] == numbered
    assert run(plain) == 0
    assert numbered[0] not in capsys.readouterr().out


@pytest.mark.parametrize("verb", [["schema"], ["doctor"]])
def test_what_computes_nothing_explains_nothing(
    verb: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([*verb, "--explain"]) == 2
    assert "--explain" in capsys.readouterr().err


@pytest.mark.parametrize("name", PLANS, ids=lambda name: Path(name).name)
def test_a_check_is_explained_for_every_plan(
    name: str, spoken: str, capsys: pytest.CaptureFixture[str]
) -> None:
    settings = [] if "own_benches" in name else ["dragon.benches=40"]
    report = check(read_plan(name, settings))
    lines = check_lines(report)
    for obstacle in report.plan.obstacles():  # whose names are in both languages
        lines = [line.replace(obstacle.name, "") for line in lines]
    agree(lines, 10)
    chinese_or_not(lines, spoken)
    answer = report.clearance if report.first_contact is None else report.first_contact
    assert answer.witness is not None
    walk = Walk(report.plan.build().dragon, report.plan.build().route)
    one = walk.motion([answer.witness.s])
    near = tightest_pairs(one)[0]
    assert near.benches == answer.witness.benches
    gaps = numbers_after("|q", lines)
    assert max(gaps) == pytest.approx(near.gap, abs=1e-6)
    speed = [line for line in lines if " m/s" in line and "v = " in line]
    assert float(re.findall(r"= ([0-9.]+) m/s", speed[0])[0]) == pytest.approx(
        report.greatest_speed.value, abs=1e-6
    )


def test_the_bound_of_the_example_is_a_bound() -> None:
    report = check(read_plan("spiral-in"))
    lines = check_lines(report)
    (place,) = re.findall(r"head at ([0-9.]+) m benches 1 and 9 are", " ".join(lines))
    (step,) = re.findall(r"goes on by ([0-9.]+) m", " ".join(lines))
    (bound,) = re.findall(r"\)/2 = ([0-9.]+) m\.", " ".join(lines))
    walk = Walk(report.plan.build().dragon, report.plan.build().route)
    motion = walk.motion(np.linspace(float(place), float(place) + float(step), 50))
    assert 0.0 < float(bound) <= pair_distances(motion, 0, 8).min()


def test_a_contact_with_a_margin_and_one_that_is_broken_say_so(spoken: str) -> None:
    report = check(read_plan("turn", ["dragon.benches=40", "limits.margin=0.3", "limits.speed=1.5"]))
    lines = check_lines(report)
    agree(lines, 12)
    assert any("0.3 m" in line for line in lines)
    assert max(numbers_after("|q", lines)) == pytest.approx(0.3, abs=1e-6)
    assert lines[-1] == {
        "en": "The limit is 1.5 m/s; it is exceeded.", "zh": "限值是 1.5 m/s，已超过。",
    }[spoken]  # fmt: skip


@pytest.mark.parametrize("benches", [1, 2, 3])
def test_dragons_without_pairs_and_with_one_are_explained(benches: int) -> None:
    report = check(read_plan("spiral-in", [f"dragon.benches={benches}", "disc.radius=4.5"]))
    lines = check_lines(report)
    assert bool(numbers_after("|q", lines)) == (benches == 3)
    agree(lines, 3)


def test_the_gap_law_has_four_directions() -> None:
    motion = read_plan("turn").build().motion([30.0])
    lines = gap_lines(motion, 0, 16)
    assert len(numbers_after("|q", lines)) == 4
    agree(lines, 6)


@pytest.mark.parametrize("what", ["pitch", "disc", "width", "length"])
def test_a_limit_is_explained(what: str, spoken: str, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["solve", what, "spiral-in", "--set", "disc.radius=4.5", *SHORT]
    found = json_of(capsys, *arguments)
    lines: list[str] = found["explanation"]  # type: ignore[assignment]
    agree(lines, 7)
    chinese_or_not(lines, spoken)
    value = float(str(found["value"]))
    (root,) = re.findall(r"·?[0-9.)]+ = ([0-9.]+) m[.。]", next(x for x in lines if "f/" in x))
    assert float(root) == pytest.approx(value, abs=2e-4)
    assert f"{value:.13g}" in " ".join(lines)
    assert max(numbers_after("|q", lines)) == pytest.approx(0.0, abs=1e-6)
    plan = read_plan("spiral-in", ["disc.radius=4.5", "dragon.benches=25"])
    assert limit_lines(plan, what, limit(plan, what), ["1 m"])[2:] == lines[2:]


def test_limits_that_are_none_are_explained() -> None:
    plan = read_plan("spiral-in", ["disc.radius=4.5", "dragon.benches=2"])
    found = limit(plan, "width")
    assert found.status == "unlimited"
    assert len(limit_lines(plan, "width", found, ["0.3 m"])) == 3
    assert limit_lines(plan, "width", replace(found, status="infeasible"), ["0.3 m"])[-1].startswith(
        "None"
    )


def test_the_traversal_and_the_range_are_explained(
    spoken: str, capsys: pytest.CaptureFixture[str]
) -> None:
    plain = ["solve", "pitch", "spiral-in", "--set", "disc.radius=4.5", *SHORT]
    lines = lines_of(capsys, *plain, "--method", "traversal", "--pitch-step", "0.01")
    agree(lines, 1)
    chinese_or_not(lines, spoken)
    assert "0.46" in lines[1]
    found = json_of(capsys, *plain, "--range", "0.44..0.47", "--count", "4")
    spans, lines = found["safe"], lines_of(capsys, *plain, "--range", "0.44..0.47", "--count", "4")
    agree(lines, 2)
    chinese_or_not(lines, spoken)
    assert isinstance(spans, list)
    assert f"{spans[0][0]:.6f}" in lines[1]


@pytest.mark.parametrize("name", ["speed", "acceleration", "turning_rate"])
def test_a_head_speed_is_explained_whatever_decides(
    name: str, spoken: str, capsys: pytest.CaptureFixture[str]
) -> None:
    limits = {"speed": 2.0, "acceleration": 1.0, "turning_rate": 20.0}
    settings = ["--set", f"limits.{name}={limits[name]}", *SHORT]
    if name != "speed":
        settings += ["--set", "limits.speed=100"]
    found = json_of(capsys, "solve", "speed", "turn", *settings)
    lines = [str(line) for line in found["explanation"]]  # type: ignore[attr-defined]
    agree(lines, 1)
    chinese_or_not(lines, spoken)
    (stated,) = (float(x) for x in re.findall(r"v = .*= ([0-9.]+) m/s", " ".join(lines)))
    assert stated == pytest.approx(float(str(found["value"])), rel=1e-6)


def test_a_pace_is_explained_after_its_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], spoken: str
) -> None:
    path = tmp_path / "paced.dragon.toml"
    plain = ["solve", "speed", "turn", "--set", "walk.speed=1.5", *SHORT, "--pace", "-o", str(path)]
    found = json_of(capsys, *plain)
    lines = [str(line) for line in found["explanation"]]  # type: ignore[attr-defined]
    agree(lines, 4)
    chinese_or_not(lines, spoken)
    pace = found["pace"]
    assert isinstance(pace, dict)
    assert f"= {number(pace['seconds'])} s" in lines[-1]
    assert run([*plain, "--force", "--explain"]) == 0
    assert capsys.readouterr().out.rstrip().endswith(lines[-1])


def test_a_head_speed_that_nothing_limits_is_explained() -> None:
    plan = read_plan(str(EXAMPLES[0]), ["limits.turning_rate=1e9"])
    assert len(speed_lines(plan, greatest_head_speed(plan))) == 1


@pytest.mark.parametrize("family", ["arc-arc", "arc-line-arc"])
def test_a_turn_is_explained(family: str) -> None:
    plan = read_plan("turn", ["dragon.benches=25", f"turn.family={family}"])
    best = turn.best_turn(plan)
    for spoken in ("en", "zh"):
        with spoken_in(spoken):
            lines = turn_lines(best)
        agree(lines, 8)
        chinese_or_not(lines, spoken)
        text = " ".join(lines)
        assert f"= {number(best.length)} m" in text
        assert f"= {number(best.way)} m" in text


def built(*settings: str) -> BestTurn:
    """The turn of a plan as if it had been found."""
    plan = read_plan("turn", settings)
    turn = TurnRoute(kind="turn").turn(plan)
    judged = Answer(turn.length, turn.length, turn.length, "m", "found")
    return BestTurn(plan, turn, judged, turn.length, turn.way(4.5), None, judged, ())


def test_clothoids_of_a_turn_are_explained() -> None:
    best = built("turn.ease=0.5")
    lines = turn_lines(best)
    agree(lines, 4 + len(best.turn.pieces))
    assert len([line for line in lines if "clothoid" in line]) == 3


def test_spirals_inside_the_disc_are_explained(spoken: str) -> None:
    best = built("turn.entry_radius=4.3", "turn.exit_radius=4.2", "turn.ratio=1")
    lines = turn_lines(best)
    agree(lines, 4 + len(best.turn.pieces) + 4)
    chinese_or_not(lines, spoken)
    assert f"= {number(best.way)} m" in " ".join(lines)
