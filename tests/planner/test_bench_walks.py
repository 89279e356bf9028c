"""compute/bench_walks.js: what each bench does is what analysis/bench_walks.py says."""

import json
import math
from collections.abc import Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from benchdragon.analysis.bench_walks import BenchWalk, bench_walks
from benchdragon.analysis.chalk import chalk_plan
from benchdragon.analysis.chalk_line import Trail
from benchdragon.analysis.ground import Ground
from benchdragon.analysis.timetable import Passing, timetable
from benchdragon.errors import BenchDragonError
from benchdragon.explain.bench_basis import bench_text
from benchdragon.explain.timetable_text import timetable_text
from benchdragon.i18n import LANGUAGES, spoken_in
from benchdragon.model.walk import Walk
from benchdragon.plans.people import called
from benchdragon.plans.schema import Plan, checked, read_plan
from tests.engine.recording import node
from tests.planner.random_plans import Tables, plan
from tests.planner.twins import asked, difference
from tests.planner.verdicts import words

pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")

SEEDS = range(300, 330)
# Plans that turn, coil, and have people, bounds of two sides and paces that change.
NAMED = ("turn", "spiral-in", "examples/12_village.dragon.toml")
# One in which the head waits, walks, hurries and runs.
PACED: Tables = {
    "schema": 1,
    "dragon": {"benches": 6},
    "route": {
        "kind": "parts",
        "part": [{"kind": "line", "length": 20}, {"kind": "arc", "radius": 5, "angle": -200}],
    },
    "walk": {"profile": [[0, 0], [2, 0], [6, 2.5], [9, 2.5], [11, 0], [13, 1.4]], "end": 20},
}
# One in which the head waits first: what is tightest is so from the start.
WAITING: Tables = {
    "schema": 1,
    "base": "spiral-in",
    "dragon": {"benches": 30},
    "route": {"pitch": 0.9, "start_turn": 4},
    "walk": {"profile": [[-11, 0], [13, 0.5]], "start": -20, "end": -5},
}
# One on a square that is surveyed, walked round and round, told by the time of day.
SURVEYED: Tables = {
    "schema": 1,
    "dragon": {"benches": 14},
    "route": {"kind": "parts", "part": [{"kind": "arc", "radius": 3, "angle": 1200}]},
    "walk": {"position": 40, "end": 20},
    "venue": {"rectangle": [30, 26]},
    "survey": {"crs": "EPSG:4547"},
    "people": {"count_head": False, "unit": "qiao"},
    "cues": {
        "clock": "23：59：45",
        "cue": [{"kind": "hold", "at": 5, "hold": 4, "text": "bow", "text_zh": "拜庙"}],
    },
    "chalk": {"stray": 0.2, "peg": [2, -1]},
    "event": {"entrances": [[4, 1], [-15, 0]]},
}  # fmt: skip
ROOT = Path(__file__).parents[2]
# Seconds of each dance that are looked at.
LONG = 30.0
# About a least distance time hardly counts: two libms choose moments so far apart, s.
MOMENT = 1e-5
# Benches that touch do so at a corner, of which rounding says whether it is of the flank or of the end.
TOUCHING = 1e-6


def here(data: Tables) -> tuple[list[float], Any]:
    """The span that is looked at, and what Python says of it."""
    read = checked(json.loads(json.dumps(data)), "plan")
    walk = read.build()
    start, end = read.span(walk)
    span = start, min(end, start + LONG)
    benches = bench_walks(read, walk, span)
    told: dict[str, Any] = {"benches": [asdict(one) for one in benches]}
    told["timetable"] = {}
    for spoken in LANGUAGES:
        with spoken_in(spoken):
            told[spoken] = sentences(read, walk, benches)
            passings = timetable(read, walk, *span)
            ground = Ground.of(read, walk.route)
            told["timetable"][spoken] = asdict(timetable_text(read, walk, span, ground, passings))
    told["seconds"] = [[since(time, span) for time in times(one, span[1])] for one in passings]
    told["chalk"] = chalked(read, walk, span)
    return list(span), json.loads(json.dumps(told))


def times(one: Passing, end: float) -> tuple[float | None, float | None, float | None]:
    """When the head comes to a place, when it sets out again after a stop, when the tail passes, s."""
    held = one.head is not None and one.until is not None and one.head < one.until < end
    return one.head, one.until if held else None, one.tail


def since(time: float | None, span: tuple[float, float]) -> float | None:
    """A time of the plan from the start of what is looked at, s."""
    return None if time is None else time - span[0]


def chalked(read: Plan, walk: Walk, span: tuple[float, float]) -> Any:
    """The chalk plan as a page has it."""
    trail, ground = Trail.of(walk, *span), Ground.of(read, walk.route)
    link = float(walk.dragon.links.min())
    found = chalk_plan(trail, link, ground, read.chalk.stray, read.obstacles())
    if found is None:
        return None
    legs = [
        {**asdict(leg), "swing": None if math.isnan(leg.swing) else leg.swing} for leg in found.legs
    ]
    return {
        **asdict(found),
        "legs": legs,
        "ticks": [tick._asdict() for tick in found.ticks],
        "met": [one._asdict() for one in found.met],
    }


def sentences(read: Plan, walk: Walk, benches: Sequence[BenchWalk]) -> Any:
    """What stands on the sheets of all benches, in the language in use."""
    ground = Ground.of(read, walk.route)
    name = partial(called, read.people, count=len(benches))
    return [asdict(bench_text(read, one, name, ground)) for one in benches]


def compared(plans: list[Tables]) -> list[tuple[Any, Any]]:
    """What Python and its twin say of the plans that can be walked."""
    questions, own = [], []
    for data in plans:
        try:
            span, told = here(data)
        except BenchDragonError:
            continue
        questions.append({"plan": data, "span": span})
        own.append(told)
    twins = asked("bench_walks.mjs", {"plans": questions, "words": words()})
    return list(zip(own, twins, strict=True))


def fault(own: Any, twin: Any) -> str:
    """Where the two differ, by more than rounding decides; "" where they do not."""
    if "error" in twin or len(own["benches"]) != len(twin["benches"]):
        return str(twin)[:300]
    for one, other in zip(own["seconds"], twin["seconds"], strict=True):
        pairs = zip(one, other, strict=True)
        other[:] = [a if a and b and abs(a - b) <= MOMENT else b for a, b in pairs]
    for k, (one, other) in enumerate(zip(own["benches"], twin["benches"], strict=True)):
        near, its = one["tightest"], other["tightest"]
        if near is None or its is None:
            continue
        if abs(near["time"] - its["time"]) <= MOMENT:
            its["time"] = near["time"]
        if math.dist(near["place"], its["place"]) <= 10.0 * MOMENT:
            its["place"] = near["place"]
        if near["upper"] <= TOUCHING and near["side"] != its["side"]:
            its["side"] = near["side"]
            for spoken in LANGUAGES:
                twin[spoken][k]["tightest"] = own[spoken][k]["tightest"]
    return difference(own, twin)


@pytest.fixture(scope="module")
def found() -> list[tuple[Any, Any]]:
    """Random plans and named ones that can be walked, as Python and its twin tell them."""
    named = [read_plan(str(ROOT / name) if "/" in name else name).data() for name in NAMED]
    plans = [plan(seed, 0.0) for seed in SEEDS]
    return compared([*plans, PACED, WAITING, SURVEYED, *named])


def test_benches_do_the_same_and_it_is_said_in_the_same_sentences(found: list[tuple[Any, Any]]) -> None:
    assert len(found) > 15 + len(NAMED)
    assert [fault(*each) for each in found if fault(*each)] == []


def test_timetables_of_all_kinds_are_compared(found: list[tuple[Any, Any]]) -> None:
    texts = [own["timetable"]["en"] for own, _twin in found]
    rows = [row for text in texts for row in text["rows"]]
    for said in ("the head nearest to", "becomes", "nearest to entrance", "the turn begins"):
        assert any(said in row[0] for row in rows), said
    for said in (" edge and ", "from where the peg stood", "from entrance"):
        assert any(said in row[1] for row in rows), said
    assert any(seconds[1] is not None for own, _twin in found for seconds in own["seconds"])
    assert any(seconds[2] is not None for own, _twin in found for seconds in own["seconds"])


def test_plans_of_all_kinds_are_compared(found: list[tuple[Any, Any]]) -> None:
    benches = [bench for own, _twin in found for bench in own["benches"]]
    stretches = [one for bench in benches for one in bench["stretches"]]
    assert {one["pace"] for one in stretches} == {"wait", "walk", "hurry", "run"}
    assert {one["turning"] for one in stretches} == {"left", "right", "straight"}
    assert {one["tightest"]["side"] for one in benches if one["tightest"]} >= {"left", "right"}
    told = [line for own, _twin in found for text in own["en"] for line in text["place"]]
    for said in (" edge of ", "(north) from the peg"):
        assert any(said in line for line in told), said
    waits = [line for own, _twin in found for text in own["zh"] for line in text["stretches"]]
    assert any(line.endswith("等：拜庙。") for line in waits)
    chalk = [own["chalk"] for own, _twin in found]
    assert {len(one["stars"]) for one in chalk} >= {0, 1}
    assert any(leg["swing"] for one in chalk for leg in one["legs"])
    ticks = [tick for one in chalk for tick in one["ticks"]]
    assert any(tick["out"] for tick in ticks)
    assert any(tick["aside"] for tick in ticks if tick["star"] >= 0)
