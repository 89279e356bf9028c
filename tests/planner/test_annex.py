"""compute/annex.js: the ground, the crowd, posts and the chance are what Python says of them."""

import json
import math
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from benchdragon.analysis.check import check, sentence
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.crowd import (
    crowd_of,
    distance_of,
    entrances_of,
    event_findings,
    outer_lines,
    shut_text,
    ways_out,
    within_lines,
)
from benchdragon.analysis.distance import boxes
from benchdragon.analysis.off_tracking import LEAST_GAIN, MOST_GAIN, off_tracking
from benchdragon.analysis.posts import JOINED, marshal_posts
from benchdragon.analysis.swept import SweptArea, swept_area
from benchdragon.i18n import LANGUAGES, spoken_in
from benchdragon.kernels.box import corner
from benchdragon.model.rings import length_of
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.solve.imprecise import chance_of
from tests.engine.recording import node
from tests.planner.twins import asked
from tests.planner.verdicts import words

pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")

ROOT = Path(__file__).parents[2]
SMALL = ("dragon.benches=8", "route.pitch=1.2", "route.start_turn=4", "walk.end=12")
SQUARE = ("venue.rectangle=[40, 30]", 'obstacle=[{kind="circle", centre=[12, 9], radius=1}]')
# One with all that the annex tells of, one that comes to the edge of its square, one without a square
# that halts, one in which imprecise people come too near, one that coils round free ground, one whose
# first and last bench alone are long.
PLANS = {
    "said": (
        "spiral-in", *SMALL, *SQUARE, "event.spectators=2500",
        "event.entrances=[[8, 6, 9], [20, 5, 4], [0, 15]]", "event.distance=3.25",
        "cues.clock=18:30", "limits.speed=1.73", "people.sway=0.013",
    ),
    "edge": (str(ROOT / "examples/12_village.dragon.toml"), "event.spectators=800"),
    "halts": ("spiral-in", *SMALL, 'cues.cue=[{kind="hold", at=4, hold=3}]', "people.steering=0.3"),
    "runs": (
        "spiral-in", *SMALL, "dragon.benches=2", "walk.end=15", "limits.head_acceleration=10",
        "walk.profile=[[0, 1], [1, 1], [1.5, 2.6], [2, 1], [12, 1], [12.5, 2.4], [13, 1]]",
    ),
    "tight": (
        "spiral-in", "dragon.benches=24", "route.pitch=0.6", "route.start_turn=3.5", "walk.end=6",
    ),
    "street": (str(ROOT / "examples/11_drawn_walk.dragon.toml"), "dragon.benches=12"),
    "ends": (
        "spiral-in", *SMALL[1:3], "walk.end=4",
        "dragon.bench=[{length=3}, {length=2.2, count=8}, {length=3}]",
    ),
}  # fmt: skip
# Two lines about the same ground differ by what either may err, m, and posts along them by more.
APART, ALONG = 0.1, JOINED + 0.1


def plan_of(name: str) -> Plan:
    source, *settings = PLANS[name]
    return read_plan(source, settings)


@pytest.fixture(scope="module")
def twins() -> dict[str, Any]:
    """What the page says of all plans."""
    data = [plan_of(name).data() for name in PLANS]
    found = asked("annex.mjs", {"plans": data, "words": words()})
    return dict(zip(PLANS, found, strict=True))


@pytest.fixture(scope="module", params=list(PLANS))
def pair(request: pytest.FixtureRequest, twins: dict[str, Any]) -> tuple[Plan, Any]:
    """A plan, and what the page says of it."""
    told = twins[request.param]
    assert "error" not in told, told["error"]
    return checked(json.loads(json.dumps(plan_of(request.param).data())), "plan"), told


def true_ground(plan: Plan) -> SweptArea:
    walk = plan.build()
    return swept_area(walk, *plan.span(walk), margin=distance_of(plan), error=0.005)


def test_the_ground_holds_all_benches_and_little_else(pair: tuple[Plan, Any]) -> None:
    plan, told = pair
    ground, swept = told["ground"], true_ground(plan)
    page = shapely.build_area(shapely.multilinestrings([*map(shapely.LineString, ground["outlines"])]))
    assert ground["error"] <= 0.05
    assert swept.polygon.buffer(ground["error"]).covers(page)
    walk = plan.build()
    for time in np.linspace(*plan.span(walk), 60).tolist():
        table = boxes(walk.motion([time]), 0)
        benches = [shapely.Polygon([corner(table, n, k) for k in range(4)]) for n in range(len(table))]
        assert page.covers(shapely.MultiPolygon(benches))
    assert ground["area"] == pytest.approx(page.area, rel=1e-6)
    sides = ground["rectangle"]
    box = swept.enclosing.rectangle
    assert sides["width"] == pytest.approx(box.width, abs=APART)
    assert sides["height"] == pytest.approx(box.height, abs=APART)
    inside = swept.polygon.buffer(-swept.error).minimum_rotated_rectangle
    assert sides["width"] * sides["height"] >= inside.area


def test_the_spectators_line_keeps_its_distance(pair: tuple[Plan, Any]) -> None:
    plan, told = pair
    ground, swept = told["ground"], true_ground(plan)
    margin = distance_of(plan)
    covered = swept.polygon.buffer(-swept.error)
    places = shapely.points([place for ring in ground["lines"] for place in ring])
    away = shapely.distance(covered, places)
    assert away.min() >= margin
    assert away.max() <= 1.005 * margin + APART
    lines = outer_lines(swept)
    assert ground["within"] == pytest.approx(within_lines(lines), rel=0.01)
    assert ground["length"] == pytest.approx(sum(map(length_of, lines)), rel=0.01)
    assert ground["given"] == (plan.event.distance is not None)


def test_crowd_entrances_and_findings_are_pythons(pair: tuple[Plan, Any]) -> None:
    plan, told = pair
    report, lines = check(plan), outer_lines(true_ground(plan))
    edges = [one.distance for one in report.obstacles if one.obstacle.kind == "venue"]
    crowd = crowd_of(plan, lines, edges[0].sure(up=False) if edges else 0.0)
    span, clock = (report.start, report.end), Clock(plan.cues.clock, report.start)
    entrances = entrances_of(plan, report.walk, span, lines, report.greatest_speed.upper)
    out = asdict(ways_out(entrances, plan.event.spectators))
    endless = [None if one == math.inf else one for one in out["minutes"] or ()]
    assert told["exits"] == json.loads(json.dumps(out | {"minutes": out["minutes"] and endless}))
    assert told["crowd"]["people"] == crowd.people
    assert told["crowd"]["way"] == (crowd.way and pytest.approx(crowd.way, abs=1e-9))
    if crowd.ground is None:
        assert told["crowd"]["ground"] is None
    else:
        assert told["crowd"]["ground"] == pytest.approx(crowd.ground, rel=0.01)
        assert told["crowd"]["ground"] <= crowd.ground + 1.0
    for one, other in zip(entrances, told["entrances"], strict=True):
        assert other["away"] == pytest.approx(one.nearest.sure(up=False), abs=1e-3)
        assert other["width"] == one.gate.width
        assert (other["inside"], other["shut"]) == (one.inside, shut_text(one, clock))
        assert one.nearest.witness is not None
        assert other["bench"] == one.nearest.witness.benches[0]
    found = event_findings(plan, crowd, entrances, clock)
    assert [one["code"] for one in told["findings"]] == [one.code for one in found]
    for spoken in LANGUAGES:
        with spoken_in(spoken):
            assert told["verdict"][spoken] == sentence(report, clock)
            if found and found[0].kind == "entrance":
                assert told["findings"][0]["text"][spoken] == found[0].text


def test_posts_stand_where_pythons_do_for_the_same_reasons(pair: tuple[Plan, Any]) -> None:
    plan, told = pair
    report, lines = check(plan), outer_lines(true_ground(plan))
    wanted = [one for one in marshal_posts(report, lines, plan.event.places) if needed(one.reasons)]
    posts = [one for one in told["posts"] if [why["why"] for why in one["reasons"]] != ["line"]]
    assert len(posts) == len(wanted)
    for own in wanted:
        away = [math.dist(one["point"], own.point) for one in posts]
        near = posts[away.index(min(away))]
        assert math.dist(near["point"], own.point) <= ALONG
        assert {why["why"] for why in near["reasons"]} == {why.why for why in own.reasons}
        for why in own.reasons:
            value = next(one["value"] for one in near["reasons"] if one["why"] == why.why)
            assert (
                math.isnan(why.value) if value is None else value == pytest.approx(why.value, abs=1e-6)
            )


def needed(reasons: tuple[Any, ...]) -> bool:
    return [one.why for one in reasons] != ["line"]


def test_the_chance_of_random_dances_is_pythons(pair: tuple[Plan, Any]) -> None:
    plan, told = pair
    own, chance = chance_of(plan), told["chance"]
    assert (chance["draws"], chance["hits"], chance["shown"]) == (own.draws, own.hits, own.shown)
    assert chance["most"] == pytest.approx(own.most, rel=1e-9)
    assert chance["deviations"] == vars(own.deviations)
    assert told["shares"] == sorted(told["shares"])
    assert told["shares"][-1] <= 1.0


def test_benches_leave_the_line_as_far_as_python_says(pair: tuple[Plan, Any]) -> None:
    plan, told = pair
    walk = plan.build()
    first = max(len(walk.dragon) - 10, 0) + 1
    gains = (LEAST_GAIN, MOST_GAIN) if plan.people.steering is None else (plan.people.steering,)
    far = [off_tracking(walk, gain, *plan.span(walk)).farthest() for gain in gains]
    assert told["tail"]["first"] == first
    assert [one["gain"] for one in told["tail"]["off"]] == list(gains)
    # JSON has no infinite numbers.
    seen = [math.inf if one["far"] is None else one["far"] for one in told["tail"]["off"]]
    assert seen == pytest.approx(far, rel=1e-9)


def test_plans_of_all_kinds_are_told_of(twins: dict[str, Any]) -> None:
    assert [one["code"] for one in twins["said"]["findings"]] == ["BD401"]
    assert twins["edge"]["crowd"]["way"] == 0
    assert not twins["tight"]["chance"]["shown"]
    why = {one["why"] for twin in twins.values() for post in twin["posts"] for one in post["reasons"]}
    assert why == {"venue", "entrance", "tightest", "fastest", "run", "line"}
    assert twins["edge"]["ground"]["round"]
    assert not twins["street"]["ground"]["round"]
    assert "18:30" in twins["said"]["entrances"][0]["shut"]


def test_a_dance_that_is_not_safe_has_no_annex() -> None:
    plan = read_plan("spiral-in", [*SMALL, "limits.speed=0.5"])
    (told,) = asked("annex.mjs", {"plans": [plan.data()], "words": words()})
    assert told["error"].startswith("Sheets are made of a plan that is safe alone. Not safe: ")
