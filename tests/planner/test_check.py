"""compute/check.js: verdicts are those of Python, in both languages, and leave no memory behind."""

import tomllib
from pathlib import Path

import pytest

from benchdragon.plans.presets import presets
from tests.analysis.rounds import circle, random_rounds, stadium
from tests.engine.recording import node
from tests.planner.random_plans import Tables
from tests.planner.verdicts import fault, here, limited, there

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")

# A walk that comes back to where it was, past things that stand there.
SQUARE: Tables = {
    "schema": 1,
    "route": {"kind": "parts", "part": [{"kind": "line", "length": 40}]},
    "dragon": {"benches": 8},
    "walk": {"position": 20, "end": 15},
}
CIRCLE = {"kind": "circle", "centre": [30.0, 1.15], "radius": 1.0}
# What random plans seldom hold: an edge just met, a start inside, a name, needs that are not met.
SPECIAL: dict[str, Tables] = {
    "grazed": {"obstacle": [CIRCLE]},
    "touched": {"obstacle": [{**CIRCLE, "radius": 1.01}]},
    "nearer than the margin": {"obstacle": [{**CIRCLE, "centre": [30, 1.2], "margin": 0.1}]},
    "touched, with a margin": {"obstacle": [{**CIRCLE, "radius": 1.1, "margin": 0.1}]},
    "named": {"obstacle": [{**CIRCLE, "name": "well {a}", "radius": 2}, CIRCLE]},
    "inside from the start on": {"obstacle": [{**CIRCLE, "centre": [15, 0], "radius": 9}]},
    "left from the start on": {"venue": {"rectangle": [12, 12], "centre": [30, 0]}},
    "left": {"venue": {"rectangle": [60, 12], "centre": [2, 0]}},
    "near the edge": {
        "venue": {"rectangle": [200, 0.5], "name": "yard"}, "limits": {"venue_margin": 0.2},
    },
    "no room at a thing": {
        "obstacle": [{**CIRCLE, "centre": [30, 1.3]}],
        "people": {"sway": 0.1, "imprecision": 0.05, "beside": 0.4, "ahead": 0.3},
    },
    "too fast to be carried": {"people": {"most_speed": 0.9}},
    "faster than both limits": {"limits": {"speed": 0.95}, "people": {"most_speed": 0.9}},
    "just at the limit": {"limits": {"speed": 1.0, "turning_rate": 1}},
    "a head that starts too fast": {"walk": {"profile": [[0, 0], [1, 2]], "position": 20, "end": 8}},
    "one bench": {"dragon": {"benches": 1}},
    "a stop": {"cues": {"cue": [{"kind": "hold", "at": 9, "hold": 3}]}},
    "past the end": {"walk": {"position": 20, "end": 30}},
    "shorter than its dragon": {
        "route": {"kind": "parts", "part": [{"kind": "line", "length": 12}]}, "walk": {"end": 9},
    },
    "behind the start": {"walk": {"end": 5}},
    "drawn, with a bend at once": {
        "route": {"kind": "drawn", "smooth": "none", "points": [[0, 0], [9, 0], [18, 3], [40, 3]]},
        "walk": {"end": 9},
    },
}  # fmt: skip


def wrong(plans: dict[str, Tables]) -> dict[str, str]:
    """What is wrong with the page's verdicts, by the plans' names."""
    twins = there(list(plans.values()))
    pairs = zip(plans.items(), twins, strict=True)
    found = {name: fault(here(data), twin["found"]) for (name, data), twin in pairs}
    return {name: text for name, text in found.items() if text}


def known() -> dict[str, Tables]:
    """The presets and the examples, but what a page cannot build."""
    files = (ROOT / "examples").glob("*.toml")
    read = {path.name: tomllib.loads(path.read_text("utf-8")) for path in files}
    plans = {one.name: one.plan.data() for one in presets()}
    return plans | {name: data for name, data in read.items() if "drawn" not in name}


def test_presets_and_examples_get_the_same_verdict() -> None:
    plans = known()
    assert len(plans) > 20
    assert wrong(plans) == {}


def test_what_stands_in_the_way_is_told_alike() -> None:
    assert wrong({name: SQUARE | data for name, data in SPECIAL.items()}) == {}


def test_a_dance_that_ends_before_its_tail_is_out_is_told_alike() -> None:
    turn: Tables = {"schema": 1, "route": {"kind": "turn"}, "dragon": {"benches": 9}}
    plans = {
        "too early": turn | {"walk": {"speed": 0.7, "start": -5, "end": 20}},
        "for good": turn | {"walk": {"profile": [[0, 1], [9, 1], [11, 0]], "end": 30}},
        "late enough": turn | {"walk": {"start": -5, "end": 90}},
    }
    assert wrong(plans) == {}
    twins = [twin["found"] for twin in there(list(plans.values()))]
    for found in ([here(data) for data in plans.values()], twins):
        told = [one["verdict"]["sentence"]["en"] for one in found]
        assert ["before the tail is out" in text for text in told] == [True, True, False]


def test_rounds_are_told_alike() -> None:
    limits = {"speed": 1.5, "turning_rate": 60}
    people = {"sway": 0.05, "beside": 0.1}
    thing = {"kind": "circle", "centre": [4.0, 4.0], "radius": 1.0}
    asked: Tables = {"limits": limits, "people": people, "obstacle": [thing]}
    walk: Tables = {"profile": [[0, 0.5], [9, 1.0], [200, 1.0], [202, 1.2], [220, 1.2], [300, 1.2]]}
    cut = {"kind": "circle", "centre": [9.0, 0.0], "radius": 1.0}
    plans: dict[str, Tables] = {
        "a circle": circle(7).data(),
        "a circle with all": circle(7, **asked).data(),
        "a circuit": stadium(9).data(),
        "a circuit with all": stadium(9, **asked).data(),
        "a circuit at many speeds": stadium(9, **asked, walk=walk).data(),
        "a circuit through a thing": stadium(9, obstacle=[cut]).data(),
        "a margin that is not kept": stadium(9, limits={"margin": 1.06}).data(),
        **{f"{seed}": random_rounds(seed).data() for seed in range(8)},
    }
    assert wrong(plans) == {}


def test_random_plans_get_the_same_verdict() -> None:
    assert wrong({f"{seed}": limited(seed) for seed in range(30)}) == {}


def test_checks_leave_no_memory_behind() -> None:
    plans = [SQUARE | SPECIAL["no room at a thing"], {"schema": 1, "route": {"kind": "turn"}}]
    for twin in there(plans, rounds=12):
        assert "verdict" in twin["found"]
        assert twin["bytes"][2] == twin["bytes"][-1]


def test_a_check_that_is_given_up_ends_and_leaves_no_memory_behind() -> None:
    plans = [SQUARE | SPECIAL["no room at a thing"], {"schema": 1, "route": {"kind": "spiral-in"}}]
    whole = [twin["told"] for twin in there(plans)]
    assert min(whole) >= 5
    for time in (1, 3, 5):
        for twin in there(plans, rounds=12, cancel=time):
            assert twin["found"] == {"kind": "Cancelled", "error": "given up"}
            assert twin["bytes"][2] == twin["bytes"][-1]
