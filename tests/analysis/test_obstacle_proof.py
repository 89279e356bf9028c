"""Touches of what stands still, proved, or refused."""

import math
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("flint")

from benchdragon import Answer, Arc, Dragon, Line, Route, UnsureError, Walk
from benchdragon.analysis import proof
from benchdragon.analysis.check import Report, check
from benchdragon.analysis.obstacles import first_touch, obstacle_answers
from benchdragon.analysis.proof import Claim, Question, prove_obstacle
from benchdragon.model.obstacle import Obstacle
from benchdragon.plans.schema import checked
from tests.analysis.straights import ONE, east, kerb, wall

CASES = Path(__file__).parents[1] / "cases" / "check"


@pytest.fixture(scope="module")
def bend() -> Walk:
    route = Route.joined([Line(12.0), Arc(3.0, 2.0), Line(10.0)])
    return Walk(Dragon.of_sizes([1.6, 1.2, 1.2, 1.0], 0.4, 0.1, 0.1), route, start=6.0)


def proved(walk: Walk, obstacle: Obstacle, end: float) -> Answer | None:
    return prove_obstacle(walk, obstacle_answers(walk, obstacle, 0.0, end), 0.0, end).contact


def test_a_touch_is_proved(bend: Walk) -> None:
    post = Obstacle.circle("post", (14.0, 0.5), 0.1)
    plain, found = first_touch(bend, post, 0.0, 14.0), proved(bend, post, 14.0)
    assert plain is not None
    assert found is not None
    assert found.status == "proved"
    assert found.lower <= plain.upper
    assert plain.lower <= found.upper


def test_a_touch_of_a_bench_behind_is_proved(bend: Walk) -> None:
    # Within the bend, where the chords of later benches cut deeper than their fronts do.
    walk = replace(bend, dragon=Dragon.of_sizes([1.0, 1.0, 2.4, 1.0], 0.4, 0.1, 0.1))
    post = Obstacle.circle(
        "post", (12.0 + 3.0 * math.sin(1.0) * 0.86, 3.0 - 3.0 * math.cos(1.0) * 0.86), 0.1
    )
    found = proved(walk, post, 14.0)
    assert found is not None
    assert found.status == "proved"
    assert found.witness is not None
    assert found.witness.benches == (3,)


def test_that_no_bench_touches_is_proved(bend: Walk) -> None:
    venue = Obstacle.venue("square", [(-20, -4), (25, -4), (25, 25), (-20, 25)], 0.2)
    assert proved(bend, venue, 14.0) is None


def test_a_graze_is_not_proved() -> None:
    found = proved(east(ONE), kerb(0.25), 4.0)
    assert found is not None
    assert found.status == "undecided"


HALLS = [
    Obstacle.venue("hall", [(-30, -30), (-20, -30), (-20, -20), (-30, -20)]),
    Obstacle.rectangle("stage", (5.0, 0.0), (30.0, 8.0)),
]


@pytest.mark.parametrize("hall", HALLS)
def test_what_stands_where_none_may_is_a_contact_at_the_start(bend: Walk, hall: Obstacle) -> None:
    claims: list[Claim] = []
    answers = obstacle_answers(bend, hall, 0.0, 2.0)
    found = prove_obstacle(bend, answers, 0.0, 2.0, claims=claims).contact
    assert found is not None
    assert (found.status, found.upper) == ("proved", 0.0)
    Question(bend, None, hall).verify(claims[0])
    with pytest.raises(UnsureError, match="may stand at the start"):
        Question(bend, None, hall).verify(Claim("hall", (6.0, 6.1), 0.0, 0.05))


def test_a_wall_that_is_crossed_is_met(bend: Walk) -> None:
    found, plain = proved(bend, wall(14.0), 9.0), first_touch(bend, wall(14.0), 0.0, 9.0)
    assert found is not None
    assert plain is not None
    assert found.status == "proved"
    assert found.lower <= plain.upper
    assert plain.lower <= found.upper
    assert found.upper - found.lower < 1e-12


def test_what_the_search_overlooks_is_no_proof(bend: Walk, monkeypatch: pytest.MonkeyPatch) -> None:
    answers = obstacle_answers(bend, wall(14.0), 0.0, 9.0)
    monkeypatch.setattr(proof, "touching", lambda *_asked: [])
    with pytest.raises(UnsureError, match="could not be shown"):
        prove_obstacle(bend, answers, 0.0, 9.0)


# What stands along a bench's side, or just where a walk ends: it is touched, or it is not.

FLUSH = [
    {"kind": "rectangle", "centre": [15, 0.65], "size": [2, 1]},
    {"kind": "polygon", "points": [[14, 0.15], [16, 0.15], [16, 1.15], [14, 1.15]]},
    {"kind": "circle", "centre": [15, 1.15], "radius": 1},
    {"kind": "line", "points": [[14, 0.15], [16, 0.15]]},
    {"kind": "venue", "rectangle": [60, 0.3]},
]


def _walked(stands: dict[str, Any], **walk: float) -> Report:
    data = tomllib.loads((CASES / "end_touch.dragon.toml").read_text("utf-8"))
    data["walk"] |= walk
    kind = stands["kind"]
    rest = {key: value for key, value in stands.items() if key != "kind"}
    data |= {"obstacle": [], "venue": rest} if kind == "venue" else {"obstacle": [stands]}
    return check(checked(data, kind), prove=True)


@pytest.mark.parametrize("stands", FLUSH, ids=lambda stands: str(stands["kind"]))
def test_what_lies_along_a_benchs_side_is_left_open_with_a_whole_report(stands: dict[str, Any]) -> None:
    report = _walked(stands)
    assert not report.decided
    assert [finding.decided for finding in report.findings] == [False]
    assert not report.proved


@pytest.mark.parametrize("stands", [FLUSH[0], FLUSH[1]], ids=lambda stands: str(stands["kind"]))
def test_a_bench_level_with_a_side_is_shown_to_stand_outside(stands: dict[str, Any]) -> None:
    assert _walked(stands, end=13.5).safe


WALL = {"kind": "line", "points": [[15.25, -3], [15.25, 3]]}


@pytest.mark.parametrize("late", [-1e-9, 0.0, 1e-9])
def test_a_touch_is_proved_within_the_walk_alone(late: float) -> None:
    report = _walked(WALL, end=15.0 + late)
    if late < 0.0:
        assert report.safe
        return
    assert report.decided is (late > 0.0)
    (answers,) = report.obstacles
    assert answers.contact is not None
    assert answers.contact.upper <= report.end
    assert answers.contact.status == ("proved" if late else "undecided")
    assert all(claim.contact is None or claim.contact <= report.end for claim in report.claims)
