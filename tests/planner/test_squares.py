"""The dance of a page has what a check found, and the obstacles of the plan."""

import json
from typing import Any

import numpy as np
import pytest

from benchdragon.analysis.check import check
from benchdragon.plans.schema import checked
from benchdragon.player.scene import Span, judged_dance
from tests.engine.recording import node
from tests.planner.twins import asked

pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")

DISC: dict[str, Any] = {"schema": 1, "route": {"kind": "spiral-in"}, "disc": {"radius": 4.5}}
STAR = [[0, 0], [6, 2], [12, 0], [9, 6], [12, 12], [6, 9], [0, 12], [3, 6]]
PLANS: dict[str, dict[str, Any]] = {
    "a contact": DISC | {"disc": {"radius": 4.4}, "route": {"kind": "spiral-in", "pitch": 0.43}},
    "clear": DISC,
    "a margin": DISC | {"limits": {"margin": 0.4}},
    "obstacles": DISC
    | {
        "limits": {"margin": 0.05, "venue_margin": 0.5},
        "venue": {"rectangle": [24, 40]},
        "event": {"entrances": [[12, 3.25], [-12, 0, 3]]},
        "obstacle": [
            {"kind": "circle", "centre": [0, 0], "radius": 1, "name": "well", "margin": 4},
            {"kind": "polygon", "points": STAR, "margin": 0.8},
            {"kind": "line", "points": [[-40, -30], [40, -31]], "margin": 1},
        ],
    },
    "a street": {
        "schema": 1,
        "dragon": {"benches": 8},
        "route": {
            "kind": "turn", "pitch": 1.7, "outer_radius": 9,
            "street": {"points": [[-60, 0], [-30, 2]], "width": 5},
        },
        "venue": {"rectangle": [40, 30], "angle": 10},
        "event": {"entrances": [[0, -15.4, 2.5]]},
    },
}  # fmt: skip


def occasions(dance: Any) -> list[Any]:
    return [[one["kind"], one["text"]["en"], one["obstacle"]] for one in dance["occasions"]]


def drawn(dance: Any) -> list[Any]:
    keys = ("kind", "points", "radius", "margin", "open", "left")
    return [[one[key] for key in keys] for one in dance["obstacles"]]


def test_what_a_check_found_is_on_the_dance() -> None:
    shown = {"shares": [0.5], "times": 60}
    twins = asked(
        "dances.mjs", [{"plan": one, "shown": shown, "judge": True} for one in PLANS.values()]
    )
    for data, twin in zip(PLANS.values(), twins, strict=True):
        read = checked(json.loads(json.dumps(data)), "plan")
        span = Span(*read.span(read.build()), shares=(0.5,), times=60)
        own = judged_dance(read, check, span).model_dump(mode="json")
        assert occasions(twin["sent"]) == occasions(own)
        assert drawn(twin["sent"]) == drawn(own)
        assert (
            twin["sent"]["entrances"] == own["entrances"] == data.get("event", {}).get("entrances", [])
        )
        for one, other in zip(own["occasions"], twin["sent"]["occasions"], strict=True):
            assert abs(one["time"] - other["time"]) < 0.02  # the tightest moment is flat
        far = np.subtract(own["nearest"]["distance"], twin["sent"]["nearest"]["distance"])
        assert np.abs(far).max() < 2e-5
