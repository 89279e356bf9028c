"""compute/scene.js: the dance that the page shows is that of player/scene.py."""

import json
from typing import Any

import numpy as np
import pytest

from benchdragon.analysis.beats import score_of
from benchdragon.errors import BenchDragonError
from benchdragon.kernels.following import NodeStretch
from benchdragon.model.obstacle import Obstacle
from benchdragon.plans.people import UNITS, called
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.player.following import following
from benchdragon.player.frames import SHARES, course, frames
from benchdragon.player.scene import AROUND, Span, plain_dance
from tests.engine.recording import node
from tests.planner.random_plans import plan
from tests.planner.twins import asked, difference

pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")

# Few looks: the answers are compared, not how careful they are.
FEW: dict[str, Any] = {"shares": [0.5], "times": 60}
# What is the same in all dances, or not here.
ELSEWHERE = {"version", "verdict", "ground", "obstacles"}
SEEDS = range(300, 330)


def told_span(read: Plan) -> Span:
    start, end = read.span(read.build())
    return Span(start, min(end, start + 60.0), shares=(0.5,), times=60)


def asked_dances(plans: list[dict[str, Any]]) -> list[tuple[Any, Any]]:
    """What Python and its twin make of plans that can be built, for a minute at most."""
    questions, own = [], []
    for data in plans:
        try:
            read = checked(json.loads(json.dumps(data)), "plan")
            span = told_span(read)
            own.append(danced(read, span))
        except BenchDragonError:
            continue
        questions.append({"plan": data, "shown": {**FEW, "start": span.start, "end": span.end}})
    return list(zip(own, asked("dances.mjs", questions), strict=True))


def danced(read: Plan, span: Span) -> dict[str, Any]:
    """A dance of Python, and its lists not yet packed."""
    walk = read.build()
    sent = plain_dance(walk, span).model_dump(mode="json")
    shot = frames(walk, span.start, span.end, 0.9 * span.most_error, span.shares)
    low = max(float(walk.motion([shot.start]).s.min()) - AROUND, -walk.route.extension)
    high = min(float(shot.places.max()) * 1e-4 + AROUND, walk.route.length)
    way = course(walk, low, high)
    return {
        "sent": sent, "nodes": way.nodes, "places": shot.places, "speeds": shot.speeds,
        "plan": read, "span": span,
    }  # fmt: skip


@pytest.fixture(scope="module")
def dances() -> list[tuple[Any, Any]]:
    """Dances of random plans and of the built-in ones."""
    found = asked_dances([plan(seed) for seed in SEEDS] + [read_plan("turn").data()])
    assert len(found) > 15
    return found


def test_frames_are_the_same(dances: list[tuple[Any, Any]]) -> None:
    for own, twin in dances:
        assert "error" not in twin
        for name in ("places", "speeds"):
            table = np.array(twin[name]).reshape(own[name].shape)
            assert np.abs(table - own[name]).max() <= 1  # rounding at a half


def test_pages_unpack_the_frames_that_python_packs(dances: list[tuple[Any, Any]]) -> None:
    read = asked("dances.mjs", [{"sent": own["sent"]} for own, _twin in dances])
    for (own, _twin), found in zip(dances, read, strict=True):
        for name in ("places", "speeds"):
            np.testing.assert_array_equal(found[name], own[name].ravel())


def test_the_route_is_the_same(dances: list[tuple[Any, Any]]) -> None:
    for own, twin in dances:
        nodes = np.array(twin["nodes"]).reshape(own["nodes"].shape)
        assert np.abs(nodes - own["nodes"]).max() < 1e-4


def test_messages_are_the_same(dances: list[tuple[Any, Any]]) -> None:
    for own, twin in dances:
        read, sent = own["plan"], own["sent"]
        theirs = {key: value for key, value in twin["sent"].items() if key not in ELSEWHERE}
        cues = [one for one in theirs["occasions"] if one["kind"] == "cue"]
        theirs["occasions"] = [one for one in theirs["occasions"] if one["kind"] != "cue"]
        last = sent["frames"]["start"] + sent["frames"]["step"] * (sent["frames"]["count"] - 1)
        assert len(cues) == sum(own["span"].start <= one.time <= last for one in read.moments())
        expected = {key: value for key, value in sent.items() if key not in ELSEWHERE}
        expected |= {
            "plan_sha256": read.sha256, "disc": read.disc.radius, "margin": read.limits.margin,
            "speed_limit": read.limits.speed, "beats": beats(read), "village": village(read),
            "north": read.survey.north, "papers": papers(read),
            "occasions": sorted(expected["occasions"], key=lambda one: float(one["time"])),
        }  # fmt: skip
        assert difference(loose(expected), loose(theirs)) == ""


def loose(sent: dict[str, Any]) -> dict[str, Any]:
    """A message without its lists, Chinese, and what rounding decides."""
    kept = {key: value for key, value in sent.items() if key not in ("nearest", "title")}
    for table in ("frames", "course"):
        own = sent[table].items()
        kept[table] = {key: value for key, value in own if key not in ("packed", "largest_error")}
    if "names" not in (kept["village"] or {"names": []}):
        names = [kept["village"][key]["en"] for key in ("head", "tail", "between")]
        kept["village"] = {"names": names, "before": kept["village"]["before"]}
    # A joint where the dance begins is passed or not, as rounding has it.
    first = sent["frames"]["start"] + 1e-6
    said = [one | {"text": one["text"]["en"]} for one in sent["occasions"]]
    return kept | {"occasions": [one for one in said if one["time"] > first]}


def village(read: Plan) -> Any:
    """What the village calls its benches, in English."""
    people, count = read.people, len(read.build().dragon)
    if people.unit == "bench" and people.count_head:
        return None
    called_all = [called(people, bench, count) for bench in (1, count)]
    between = UNITS[people.unit]
    return {"names": [*called_all, between], "before": 0 if people.count_head else 1}


def papers(read: Plan) -> Any:
    """How the papers of a plan tell times."""
    if "people" not in read.data() and "cues" not in read.own():
        return None
    return {"said": read.cues.clock, "start": read.span(read.build())[0]}


def beats(read: Plan) -> Any:
    """The drum of a plan."""
    if "cues" not in read.own():
        return None
    score = score_of(read, *read.span(read.build()))
    runs = [run._asdict() for run in score.runs]
    return {"tempo": score.tempo, "runs": runs, "strokes": list(score.strokes)}


def test_the_nearest_benches_are_the_same(dances: list[tuple[Any, Any]]) -> None:
    for own, twin in dances:
        nearest = {"own": own["sent"]["nearest"], "twin": twin["sent"]["nearest"]}
        far = np.array(nearest["own"]["distance"]) - np.array(nearest["twin"]["distance"])
        assert np.abs(far).max(initial=0.0) < 1.1e-5


def test_a_sketch_is_of_the_whole_dance_and_ends_where_a_bench_leaps() -> None:
    sketch = {"shares": [], "times": 30, "mostError": 0.002}
    names = ("spiral-in", "turn")
    answers = asked("dances.mjs", [{"plan": read_plan(name).data(), "shown": sketch} for name in names])
    coil, turn = (answer["sent"]["frames"] for answer in answers)
    end = coil["start"] + coil["step"] * (coil["count"] - 1)
    assert 431.5 < end <= 432.85
    assert [one["kind"] for one in answers[0]["sent"]["occasions"]][-1] == "end"
    start, last = read_plan("turn").span(read_plan("turn").build())
    assert turn["start"] == start
    assert abs(turn["start"] + turn["step"] * (turn["count"] - 1) - last) < 1e-9


@pytest.mark.parametrize(("name", "more"), [("spiral-in", 1.05), ("turn", 4.0)])
def test_a_sketch_is_about_as_far_off_as_stated_and_no_finer(name: str, more: float) -> None:
    shown = {"shares": [], "times": 30, "mostError": 0.002}
    (twin,) = asked("dances.mjs", [{"plan": read_plan(name).data(), "shown": shown}])
    told, walk = twin["sent"]["frames"], read_plan(name).build()
    s, v = (np.reshape(twin[key], (len(walk.dragon) + 1, -1)) * 1e-4 for key in ("places", "speeds"))
    times = told["start"] + told["step"] * (np.arange(told["count"] - 1) + 0.5)
    exact = np.concatenate([motion.s.T for motion in walk.motions(times)], axis=1)
    middle = (s[:, :-1] + s[:, 1:]) / 2.0 + told["step"] * (v[:, :-1] - v[:, 1:]) / 8.0
    worst = np.abs(middle - exact).max()
    # Few frames are tried, and joints of the turn lie between others; twice the step is 16 times off.
    assert 0.002 / 16.0 < worst < more * told["largest_error"]
    assert not told["everywhere"]  # which the page says


def test_a_sketch_takes_no_short_run_of_the_head_for_a_leap() -> None:
    burst = [[0, 0.5], [300.3, 0.5], [301, 3], [301.7, 0.5]]
    data = {
        "schema": 1,
        "dragon": {"benches": 5},
        "route": {"kind": "parts", "part": [{"kind": "line", "length": 400}]},
        "walk": {"profile": burst, "end": 600},
    }
    (answer,) = asked("dances.mjs", [{"plan": data}])
    frames = answer["sent"]["frames"]
    assert abs(frames["step"] * (frames["count"] - 1) - 600.0) < 1e-9
    assert "end" not in [one["kind"] for one in answer["sent"]["occasions"]]


def test_memory_does_not_grow_from_dance_to_dance() -> None:
    shown = {"shares": [], "times": 30}
    data = read_plan("turn").data()
    few, many = asked(
        "dances.mjs", [{"plan": data, "shown": shown, "rounds": rounds} for rounds in (3, 30)]
    )
    assert few["memory"] == many["memory"]


def test_obstacles_are_drawn_where_they_stand() -> None:
    data = read_plan("turn").data() | {
        "obstacle": [{"kind": "circle", "centre": [30, 1], "radius": 2}],
        "venue": {"rectangle": [90, 80]},
    }
    (answer,) = asked("dances.mjs", [{"plan": data, "shown": FEW}])
    own: tuple[Obstacle, ...] = checked(data, "plan").obstacles()
    shown = answer["sent"]["obstacles"]
    assert [one["points"] for one in shown] == [one.outline.tolist() for one in own]
    assert [one["name"]["en"] for one in shown] == ["the venue", "obstacle 1"]


def test_a_long_dance_is_the_heads_and_how_all_follow() -> None:
    settings = ["dragon.benches=1000", "dragon.tail_length=3", "walk.start=0"]
    read = read_plan("turn", settings)
    walk, at = read.build(), 1234.5
    sketch = {"mostError": 0.002, "shares": [], "times": 60}
    shown = sketch | {"care": {"compared": 20_000, "looks": 60_000_000}}
    (twin,) = asked("dances.mjs", [{"plan": read.data(), "at": at, "shown": shown}])
    start, end = read.span(walk)
    assert len(walk.dragon) * (end - start) > 500_000
    told = twin["sent"]["following"]
    assert told["kinds"] == [2] + [0] * 998 + [1]  # a kind for each length of link, shortest first
    motion = walk.motion([at])
    assert np.abs(np.array(twin["s"]) - motion.s[0]).max() < 2e-3
    assert np.abs(np.array(twin["x"]) - motion.x[0]).max() < 2e-3
    assert np.abs(np.array(twin["v"]) - motion.speed[0]).max() < 2e-3
    own = following(walk, start, end, 1.8e-3, SHARES)
    assert own is not None
    assert [table["link"] for table in told["tables"]] == own.tables.links.tolist()
    for nodes, first in zip(twin["followed"], [0, *own.tables.ends.tolist()[:-1]], strict=True):
        begin = int(own.tables.stretches[first, NodeStretch.FIRST])
        expected = own.tables.nodes[:, begin : begin + len(nodes) // 2]
        assert np.abs(np.array(nodes) - expected.ravel()).max() <= 50  # 5e-8 m: Newton's last digits
    assert np.abs(np.array(told["fastest"]) - own.fastest).max() < 1e-3
