"""Sizes, speeds, turns and random dances: the page's searches answer as Python's do."""

import json
import math
from typing import Any

import numpy as np
import pytest

from benchdragon.analysis.check import check
from benchdragon.errors import InputError, NoSolutionError
from benchdragon.explain.proposal import left_lines, proposal_lines, refusal_lines
from benchdragon.i18n import spoken_in
from benchdragon.inlining import chinese
from benchdragon.model.answer import Answer
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.solve.head_speed import greatest_head_speed, slowed, with_pace
from benchdragon.solve.proposal import TooSmall, benches_out_again, propose
from benchdragon.solve.size import limit
from benchdragon.solve.tolerance import CASES, RISKS, Deviations, tolerance
from benchdragon.solve.turn import best_turn
from benchdragon.solve.turn_goal import TurnGoal
from benchdragon.solve.wishes import Wishes
from tests.engine.recording import node
from tests.planner.random_plans import plan
from tests.planner.twins import asked, tried

pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")

NAMES = ("pitch", "disc", "width", "length")
# Numbers of two libms, as a share of 1 or of the number.
APART = 1e-11
# A pitch that a random dance needs is a border of a bracket of 1e-5 m, found along secants.
PITCHES_APART = 1e-8
# A turn may be worse than Python's by this share, as its search is another.
WORSE = 1e-6
FEW = ["disc.radius=4.5", "dragon.benches=30", "route.start_turn=11"]
SQUARE = {
    "schema": 1,
    "route": {"kind": "spiral-in", "pitch": 0.6, "start_turn": 11},
    "disc": {"radius": 4.5},
    "dragon": {"benches": 20},
    "venue": {"rectangle": [18, 17]},
    "obstacle": [{"kind": "circle", "centre": [0.5, 0.2], "radius": 2.0, "margin": 0.3}],
}
LIMITED = [
    "dragon.benches=25", "walk.end=70", "limits.total_acceleration=1.2", "limits.turning_rate=60",
]  # fmt: skip


def searched(name: str, data: Any, **options: Any) -> Any:
    """What the page answers about one plan."""
    question = {"data": data.data() if isinstance(data, Plan) else data, "name": name}
    (said,) = asked("solve_plans.mjs", {"asked": [question | {"options": options}]})
    return said["found"]


def near(one: float, other: Any, apart: float = APART) -> bool:
    """Whether two numbers are the same but for rounding."""
    if not math.isfinite(one):
        return bool(str(one).replace("inf", "Infinity").replace("nan", "NaN") == other)
    return abs(one - float(other)) <= apart * max(1.0, abs(one))


def same_answer(found: Answer, twin: dict[str, Any], *, same_benches: bool = True) -> bool:
    """Whether two answers say the same; on an arc many handles come to one acceleration."""
    numbers = (found.value, twin["value"]), (found.lower, twin["lower"]), (found.upper, twin["upper"])
    witness = None if found.witness is None else list(found.witness.benches)
    return (
        all(near(*pair) for pair in numbers)
        and found.status == twin["status"]
        and list(found.assumptions) == twin["assumptions"]
        and (not same_benches or witness == (twin["witness"] and twin["witness"]["benches"]))
    )


def plain(data: dict[str, Any]) -> Any:
    """A copy of a plan's data."""
    return json.loads(json.dumps(data))


def small(seed: int) -> dict[str, Any]:
    """A random plan of few benches."""
    data = plan(seed, 0.03)
    if "bench" not in data["dragon"]:
        data["dragon"]["benches"] = min(data["dragon"]["benches"], 20)
    return data


def test_limits_of_random_plans_are_the_same() -> None:
    # Seed 23 takes 2 GB of Python, more than the page has: its Worker says so (test_worker.py).
    plans = [(small(seed), NAMES[seed % 4]) for seed in range(23)]
    questions = [{"data": data, "name": "limit", "options": {"size": name}} for data, name in plans]
    found = 0
    for (data, name), said in zip(plans, asked("solve_plans.mjs", {"asked": questions}), strict=True):
        answer = tried(lambda data=data, name=name: limit(checked(plain(data), "plan"), name))
        if isinstance(answer, dict):
            assert said["found"] == answer
            continue
        assert same_answer(answer, said["found"]), (data, answer, said)
        found += answer.status == "found"
    assert found > 3


@pytest.mark.parametrize("name", NAMES)
def test_limits_of_a_spiral_and_beside_obstacles_are_the_same(name: str) -> None:
    for whole in (read_plan("spiral-in", FEW), checked(plain(SQUARE), "plan")):
        assert same_answer(limit(whole, name), searched("limit", whole, size=name))


def test_limits_of_a_dance_that_is_moved_beside_an_obstacle_and_of_a_programme_are_the_same() -> None:
    alone = {name: table for name, table in SQUARE.items() if name != "venue"}
    moved = checked(plain(alone), "plan").with_values(
        {"route.at": [30.0, -20.0], "route.turned": 40.0, "obstacle.0.centre": [30.5, -19.8]}
    )
    swing = {"name": "tail-swing", "swing": 2.6, "swings": 3, "run": 176.4}
    route = {"kind": "programme", "formation": [swing], "radius": 2.0}
    told = {"schema": 1, "dragon": {"benches": 3}, "route": route, "walk": {"end": 20.0}}
    for whole, name in ((moved, "disc"), (checked(told, "plan"), "length")):
        found = limit(whole, name)
        assert found.status == "found"
        assert same_answer(found, searched("limit", whole, size=name))


@pytest.mark.parametrize("sets", [[*FEW, "limits.speed=2"], LIMITED])
def test_head_speeds_are_the_same(sets: list[str]) -> None:
    whole = read_plan("spiral-in" if sets[0] == FEW[0] else "turn", sets)
    found = greatest_head_speed(whole)
    assert found.status == "found"
    assert same_answer(found, searched("speed", whole), same_benches=sets is not LIMITED)


def test_a_slowed_pace_is_the_same() -> None:
    whole = read_plan("turn", LIMITED)
    pace, twin = slowed(whole), searched("pace", whole)
    assert pace.saved > 1.0
    assert near(pace.seconds, twin["seconds"])
    assert near(pace.saved, twin["saved"], 1e-9)
    profile = with_pace(whole, pace).walk.profile
    assert np.allclose(twin["profile"]["times"], [time for time, _speed in profile], atol=1e-9)
    assert np.allclose(twin["profile"]["speeds"], [speed for _time, speed in profile], atol=1e-9)


@pytest.mark.parametrize(
    ("sets", "wish"),
    [
        (["turn.family=arc-line-arc"], {"objective": "way"}),
        (["limits.turning_rate=60", "limits.margin=0.1"], {"objective": "length", "least_radius": 1.6}),
    ],
)
def test_turns_are_as_good(sets: list[str], wish: dict[str, Any]) -> None:
    whole = read_plan("turn", ["dragon.benches=30", *sets])
    found, twin = best_turn(whole, TurnGoal(**wish)), searched("turn", whole, **wish)
    assert twin["objective"]["value"] <= found.objective.value * (1.0 + WORSE)
    # What the page says of its turn is what Python says of it.
    sizes = ("entry_radius", "exit_radius", "ratio" if twin["turn"]["radii"] is None else "radii")
    again = whole.with_values({f"turn.{size}": twin["turn"][size] for size in sizes})
    assert near(greatest_head_speed(again).value, twin["head_speed"]["value"], 1e-9)
    assert again.sha256 == twin["sha256"]


def test_random_dances_are_the_same() -> None:
    whole, deviations = read_plan("spiral-in", [*FEW, "route.pitch=0.46"]), CASES["all"].deviations
    found = tolerance(whole, deviations, 4, seed=7, own=True)
    twin = searched("margins", whole, draws=4, seed=7)
    assert near(found.exact, twin["exact"])
    assert np.abs(found.needed - twin["needed"]).max() <= PITCHES_APART
    assert found.hits == twin["hits"]


def test_what_random_dances_say_of_chances_is_the_same() -> None:
    coil = ["dragon.benches=9", "route.start_turn=8", "route.pitch=0.59", "disc.radius=2"]
    whole = read_plan("spiral-in", coil)
    found = tolerance(whole, CASES["all"].deviations, 100, own=True)
    twin = searched("page", whole, question="job/margins")
    said = [twin[name] for name in ("chance", "chance_lower", "chance_upper")]
    assert np.allclose(found.touching(), said, atol=1e-12)
    assert [one["risk"] for one in twin["pitch_for"]] == list(RISKS)
    for one in twin["pitch_for"]:
        pitch = found.pitch_for(one["risk"])
        assert one["pitch"] is None if math.isinf(pitch) else near(pitch, one["pitch"], 1e-8)


def test_a_bench_that_cannot_be_is_told_by_the_page_as_by_python() -> None:
    said = searched("margins", read_plan("spiral-in", FEW), draws=1, by=[0, 0, 0, 0, 1, 0])
    with pytest.raises(InputError) as refused:
        tolerance(read_plan("spiral-in", FEW), Deviations(length=1.0), 1)
    assert said["error"] == str(refused.value)


def test_a_search_is_given_up_where_its_progress_is_told() -> None:
    whole = read_plan("spiral-in", FEW).data()
    turn = read_plan("turn", ["dragon.benches=20"]).data()
    names = {"limit": whole, "speed": turn, "turn": turn, "margins": whole}
    options = {"limit": {"size": "pitch"}, "margins": {"draws": 5}}
    questions = [{"data": d, "name": n, "options": options.get(n, {})} for n, d in names.items()]
    for said in asked("solve_plans.mjs", {"asked": questions, "cancel": True}):
        assert said["found"] == {"error": "given up", "kind": "Cancelled"}
        assert said["held"] == 0


def test_memory_is_given_back() -> None:
    question = {"data": SQUARE, "name": "limit", "options": {"size": "pitch", "tolerance": 1e-5}}
    (said,) = asked("solve_plans.mjs", {"asked": [question], "rounds": 6})
    assert said["bytes"][-1] == said["bytes"][1]
    assert said["held"] == 0


REFUSED = [
    {"benches": 200, "rectangle": [4, 4]},
    {"rectangle": [1, 1.2]},
    # Behind their holes benches are so near to the next but one that they bend at no pitch.
    {"width": 0.3, "inset": 0.275, "kind": "spiral-in"},
]


@pytest.mark.parametrize("few", REFUSED)
def test_the_page_refuses_as_python_does_what_cannot_be(few: dict[str, Any]) -> None:
    wishes = YARD | few
    with pytest.raises((NoSolutionError, InputError)) as refused:
        propose(Wishes(**{key: _tuples(value) for key, value in wishes.items()}))
    assert told("propose", wishes, "en")["error"] == str(refused.value)


YARD: dict[str, Any] = {"benches": 9, "length": 1.5, "width": 0.15, "rectangle": [16, 15]}
WELL = {"kind": "circle", "name": "well", "centre": [5, 5], "radius": 0.6, "margin": 0.2}
HOUSE = [[-9, -8], [9, -8], [9, 8], [0, 8], [0, 10], [-9, 10]]
WISHED: dict[str, dict[str, Any]] = {
    "out again, beside a well": {"obstacles": [WELL], "carry": "under"},
    "coiling in": {"kind": "spiral-in", "sway": 0.02, "measured": ["sway"]},
    "within corners": {"rectangle": None, "boundary": HOUSE, "head_length": 2.4, "most_speed": 0.9},
    "in rounds": {"benches": 6, "carry": "under", "rounds": 3},
    "in more rounds than fit": {"rounds": 2, "rectangle": [14, 12]},
    "by a street": {
        "street": {"points": [[-40, 0], [-20, 2], [-9, 5]]},
        "rounds": 2,
        "rectangle": [24, 24],
    },
    "by a street of bends too tight": {"street": {"points": [[-40, 0], [-9, 5]], "radius": 0.2}},
    "round, and too small": {"rectangle": None, "radius": 4.5, "bearers": 1},
}


@pytest.mark.parametrize(
    ("name", "language"), [*zip(WISHED, ["en", "zh", "zh", "zh", "en", "zh", "en", "en"], strict=True)]
)
def test_the_page_proposes_what_python_does(name: str, language: str) -> None:
    wishes = YARD | WISHED[name]
    said = told("propose", wishes, language)
    listed = {key: _tuples(value) for key, value in wishes.items()}
    asked_for = Wishes(**listed | {"measured": frozenset(wishes.get("measured", ()))})
    with spoken_in(language):
        found = propose(asked_for)
        if isinstance(found, TooSmall):
            assert (said["plan"], said["benches"]) == (None, found.benches)
            assert said["said"] == refusal_lines(asked_for, found)
            return
        out = asked_for.kind or found.plan.route.kind == "turn"
        again = 0 if out else benches_out_again(asked_for)
        assert said["said"] == proposal_lines(found, asked_for, again)
        assert said["left"] == left_lines(found, asked_for)
    ours, theirs = found.plan, checked(said["plan"], "page")
    assert ours.route.at is not None
    assert theirs.route.at == pytest.approx(ours.route.at, abs=2e-3)
    same = {"route.at": list(ours.route.at), "route.turned": ours.route.turned}
    assert theirs.with_values(same).data() == ours.data()


def test_the_page_places_a_dance_where_it_is_found_to_be_safe() -> None:
    whole = checked(plain(SQUARE), "plan").with_values({"route.at": [6.0, 5.0], "route.turned": 10.0})
    assert not check(whole).safe
    said = told("place", None, "en", whole)
    there = checked(said["plan"], "page")
    report = check(there)
    assert report.safe
    kept = min(one.distance.value - one.obstacle.margin for one in report.obstacles)
    assert said["room"] == pytest.approx(kept, abs=0.03)


def told(question: str, wishes: Any, language: str, whole: Plan | None = None) -> Any:
    """What the page answers to a question in a language."""
    options = {"question": question, "wishes": wishes}
    asking = {"data": (whole or read_plan("spiral-in")).data(), "name": "page", "options": options}
    words = chinese("compute/worker.js")
    (said,) = asked("solve_plans.mjs", {"asked": [asking], "words": words, "language": language})
    return said["found"]


def _tuples(value: Any) -> Any:
    return tuple(map(_tuples, value)) if isinstance(value, list) else value
