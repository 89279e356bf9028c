"""compute/judged.js and rings.js: the dance has what a check found, and obstacles their margins."""

import json
from typing import Any

import numpy as np
import pytest
import shapely
from shapely.geometry.base import BaseGeometry

from benchdragon.analysis.check import check
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.outline import margin_rings, shape_of
from benchdragon.plans.schema import checked
from benchdragon.player.scene import Span, judged_dance
from tests.engine.recording import node
from tests.planner.twins import asked

pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")

DISC: dict[str, Any] = {"schema": 1, "route": {"kind": "spiral-in"}, "disc": {"radius": 4.5}}
STAR = [[0, 0], [6, 2], [12, 0], [9, 6], [12, 12], [6, 9], [0, 12], [3, 6]]
LOOP = [[0, 0], [9, 0], [9, 6], [4, 6], [4, -5]]
PLANS: dict[str, dict[str, Any]] = {
    "a contact": DISC | {"disc": {"radius": 4.4}, "route": {"kind": "spiral-in", "pitch": 0.43}},
    "clear": DISC,
    "a margin": DISC | {"limits": {"margin": 0.4}},
    "obstacles": DISC
    | {
        "limits": {"margin": 0.05, "venue_margin": 0.5},
        "venue": {"rectangle": [24, 40]},
        "obstacle": [
            {"kind": "circle", "centre": [0, 0], "radius": 1, "name": "well", "margin": 4},
            {"kind": "polygon", "points": STAR, "margin": 0.8},
            {"kind": "line", "points": [[-40, -30], [40, -31]], "margin": 1},
        ],
    },
}


def occasions(dance: Any) -> list[Any]:
    return [[one["kind"], one["text"]["en"], one["obstacle"]] for one in dance["occasions"]]


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
        for one, other in zip(own["occasions"], twin["sent"]["occasions"], strict=True):
            assert abs(one["time"] - other["time"]) < 0.02  # the tightest moment is flat
        far = np.subtract(own["nearest"]["distance"], twin["sent"]["nearest"]["distance"])
        assert np.abs(far).max() < 2e-5


SHAPES: dict[str, dict[str, Any]] = {
    "circle": {"kind": "circle", "centre": [3, 1], "radius": 2, "margin": 0.7},
    "rectangle": {"kind": "rectangle", "centre": [3, 1], "size": [4, 2], "angle": 30, "margin": 1.5},
    "star": {"kind": "polygon", "points": STAR, "margin": 1.2},
    "star the other way round": {"kind": "polygon", "points": STAR[::-1], "margin": 3},
    "line": {"kind": "line", "points": [[0, 0], [9, 0], [9, 6]], "margin": 2},
    "line that closes about a hole": {"kind": "line", "points": LOOP, "margin": 1},
    "line of two points": {"kind": "line", "points": [[0, 0], [5, 1]], "margin": 0.3},
}
VENUES: dict[str, dict[str, Any]] = {
    "rectangle": {"rectangle": [30, 20], "angle": 20},
    "star": {"boundary": [[3 * x, 3 * y] for x, y in STAR]},
    "no room": {"rectangle": [3, 3]},
}


def area(rings: list[Any]) -> float:
    """The area inside an odd number of rings, m^2."""
    found: BaseGeometry = shapely.Polygon()
    for ring in rings:
        found = found.symmetric_difference(shapely.Polygon(ring))
    return float(found.area)


def test_margins_are_drawn_where_they_are() -> None:
    far = {"schema": 1, "route": {"kind": "parts", "part": [{"kind": "line", "length": 600}]}}
    plans = [far | {"obstacle": [one]} for one in SHAPES.values()]
    plans += [far | {"venue": one, "limits": {"venue_margin": 1.6}} for one in VENUES.values()]
    shown = {"shares": [], "times": 2}
    twins = asked("dances.mjs", [{"plan": one, "shown": shown} for one in plans])
    for data, twin in zip(plans, twins, strict=True):
        own: Obstacle = checked(json.loads(json.dumps(data)), "plan").obstacles()[0]
        rings = twin["sent"]["obstacles"][0]["rings"]
        expected = margin_rings(own)
        assert len(rings) == len(expected)
        assert abs(area(rings) - area(expected)) <= 2e-3 * (1.0 + area(expected))
        edge = shape_of(own) if own.kind in ("circle", "line") else shape_of(own).boundary
        away = [edge.distance(shapely.Point(point)) for ring in rings for point in ring]
        assert np.allclose(away, own.radius + own.margin, rtol=2e-3, atol=1e-3)
