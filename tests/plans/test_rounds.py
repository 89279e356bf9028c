"""Rounds in and out, a street before a dance, and rests by place and round: from plan files."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchdragon.analysis.check import check
from benchdragon.analysis.timetable import timetable
from benchdragon.errors import InputError
from benchdragon.model.curves import Spiral
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.plans.toml import PlanError
from benchdragon.progress import silent
from benchdragon.solve.size import limit
from benchdragon.solve.square import Square
from benchdragon.solve.turn import best_turn

STREET = [[-60.0, -30.0], [-30.0, -30.0], [-25.0, -12.0]]
SQUARE = {"rectangle": [44, 44], "name": "yard"}


def dance(*cues: dict[str, Any], venue: dict[str, Any] | None = None, **route: Any) -> Plan:
    """Thirty benches in and out, thrice where nothing else is said."""
    data = read_plan("pujiang").said()
    data["dragon"]["benches"] = 30
    data["route"] |= {"rounds": 3, **route}
    data |= {"cues": {"cue": list(cues)}} if cues else {}
    return checked(data | ({"venue": venue} if venue else {}), "dance")


def street(points: list[list[float]] = STREET, **more: Any) -> dict[str, Any]:
    return {"street": {"points": points, **more}}


def test_three_rounds_are_safe_and_take_three_times_the_way_and_the_ways_back() -> None:
    plan = dance()
    report = check(plan)
    assert report.safe
    walk = report.walk
    inward = [curve for curve in walk.route if isinstance(curve, Spiral) and curve.inward]
    assert len(inward) == 3
    assert len({(one.centre, one.end_angle, one.mirrored) for one in inward}) == 1
    once = dance(rounds=1)
    way = plan.span(walk)[1] - once.span(once.build())[1]
    back = sum(curve.length for curve in walk.route.curves[4:6])
    round_ = sum(curve.length for curve in walk.route.curves[4:9])
    assert back > math.pi * inward[1].start_angle * inward[1].k
    last_in_once = float(once.build().route.joints[-2])
    # All rounds but one are one more way in, turn, way out and way back.
    out = walk.route.curves[3].length
    assert way * plan.walk.speed == pytest.approx(2.0 * (round_ + out), abs=1e-6)
    assert last_in_once < float(walk.route.joints[-2])


def test_the_way_back_lies_outside_the_coil_as_far_as_in_it_rounds_lie_apart() -> None:
    walk = dance().build()
    joints, spiral = walk.route.joints, walk.route[6]
    assert isinstance(spiral, Spiral)
    x, y = walk.route.point(np.linspace(joints[5], joints[6], 2000)).T
    around = np.unwrap(np.arctan2(y, x)[::-1]) - math.atan2(y[-1], x[-1])
    assert around[-1] == pytest.approx(math.pi, abs=0.3)
    # The outward spiral lies half a pitch within the inward one, walked on outwards.
    outward = spiral.k * (spiral.start_angle + around - math.pi)
    assert (np.hypot(x, y)[::-1] - outward).min() > 0.5 * 1.8 - 1e-9
    assert walk.route[4].curvature(0.0) == pytest.approx(-1.0 / walk.route[2].radius)  # type: ignore[union-attr]


def test_a_dance_that_turns_back_too_soon_runs_into_its_own_tail() -> None:
    assert check(dance(outer_radius=9.5)).safe
    report = check(dance(outer_radius=5.6))
    assert not report.safe
    assert report.first_contact is not None


def test_plans_without_rounds_keep_their_hashes_and_one_round_is_as_none() -> None:
    plan = read_plan("pujiang")
    assert plan.sha256 == "d8d47f44890ae20345f0e7080a14a85fad1cf753e7771666ba680642a61b6e3b"
    assert plan.with_value("route.rounds", 1).sha256 == plan.sha256
    assert plan.with_value("route.rounds", 2).sha256 != plan.sha256


def test_a_street_leads_to_the_coil_and_stays_where_it_is_when_that_is_moved() -> None:
    plan = dance(**street(), at=[2.0, -1.0])
    walk = plan.build()
    assert plan.span(walk)[0] == 0.0
    assert walk.route.point(walk.start) == pytest.approx(STREET[0])
    for x, y in STREET:
        at = np.linspace(0.0, 100.0, 2001)
        assert np.hypot(*(walk.route.point(at) - [x, y]).T).min() <= 1.01
    moved = dance(**street(), at=[4.0, 3.0]).build()
    assert moved.route.point(moved.start) == pytest.approx(STREET[0])
    inward = next(curve for curve in moved.route if isinstance(curve, Spiral))
    assert inward.centre == (4.0, 3.0)
    assert check(plan).safe


def test_a_square_s_edge_is_open_where_the_street_leads_in_and_nowhere_else() -> None:
    plan = dance(venue=SQUARE, **street())
    (edge,) = plan.obstacles()
    assert edge.kind == "venue"
    assert edge.open is not None
    ends = edge.open[[0, -1]]
    assert np.hypot(*(ends[1] - ends[0])) == pytest.approx(6.0, abs=0.5)
    way = plan.build().route.point(np.linspace(0.0, 100.0, 1001))
    assert np.hypot(*(way - ends.mean(axis=0)).T).min() < 0.2
    assert check(plan).safe
    assert not check(dance(venue=SQUARE, **street(width=0.4))).safe  # too narrow for a bench's corners
    assert not check(dance(venue={"rectangle": [44, 22]}, **street())).safe  # the coil crosses the edge
    inside = dance(venue={"rectangle": [300, 80]}, **street())
    assert inside.obstacles()[0].open is None
    (aside,) = dance(venue=SQUARE, **street([[-60.0, -30.0], [-30.0, -30.0]])).obstacles()
    assert aside.open is not None  # the bends to the coil lead in


def test_streets_come_from_files_beside_the_plan(tmp_path: Path) -> None:
    (tmp_path / "street.csv").write_text("x,y\n-60,-30\n-30,-30\n-25,-12\n", "utf-8")
    data = '[route]\nkind = "turn"\nrounds = 2\n[route.street]\nfile = "street.csv"\n'
    (tmp_path / "a.dragon.toml").write_text(f"schema = 1\n{data}", "utf-8")
    plan = read_plan(str(tmp_path / "a.dragon.toml"))
    assert plan.data()["route"]["street"]["points"] == STREET
    again = checked(plan.data(), "again")
    assert again.sha256 == plan.sha256
    (tmp_path / "b.dragon.toml").write_text(f"schema = 1\n{data}points = [[0, 0], [9, 0]]\n", "utf-8")
    with pytest.raises(PlanError, match=r"street\.file has no effect beside route.street.points"):
        read_plan(str(tmp_path / "b.dragon.toml"))


def test_rests_are_told_by_place_and_by_round() -> None:
    cues = [
        {"kind": "hold", "place": [-40.0, -29.0], "hold": 30},
        {"kind": "hold", "round": 2, "hold": 20},
        {"kind": "note", "place": [12.0, 0.0], "round": 3},
    ]
    plan = dance(*cues, **street())
    walk = plan.build()
    table, second, third = plan.moments()
    first = float(walk.head_position([0.0])[0])
    assert walk.route.point(first + table.way) == pytest.approx([-40.0, -30.0], abs=1e-4)
    assert table.until - table.time == pytest.approx(30.0)
    begun = [
        float(s) for s, curve in zip(walk.route.joints, walk.route, strict=False)
        if isinstance(curve, Spiral) and curve.inward
    ]  # fmt: skip
    assert first + second.way == pytest.approx(begun[1], abs=1e-9)
    assert first + third.way > begun[2]
    end = float(walk.head_position([plan.span(walk)[1]])[0])
    around = walk.route.point(np.linspace(begun[2], end, 20_000))
    nearest = np.hypot(*(around - [12.0, 0.0]).T).min()
    there = walk.route.point(first + third.way)
    assert math.dist(there, (12.0, 0.0)) <= nearest + 1e-9
    without = dance(**street())
    longer = plan.span(walk)[1] - without.span(without.build())[1]
    assert 50.0 < longer < 60.0
    names = [one.name for one in timetable(plan, walk, *plan.span(walk))]
    assert [names.count(f"round {n} begins") for n in (1, 2, 3)] == [1, 1, 1]
    for name, count in (("the head goes back", 2), ("the turn begins", 3), ("the turn ends", 3)):
        assert sum(one.startswith(name) for one in names) == count


def test_of_a_place_that_is_passed_in_each_round_the_first_passing_is_meant() -> None:
    plan = dance({"kind": "note", "place": [6.0, 2.0]})
    again = dance({"kind": "note", "place": [6.0, 2.0], "round": 3})
    (first,), (last,) = plan.moments(), again.moments()
    walk = plan.build()
    assert first.way < 150.0 < last.way
    points = walk.route.point([walk.start + first.way, walk.start + last.way])
    assert np.hypot(*(points - [6.0, 2.0]).T) == pytest.approx([0.4, 0.4], abs=0.5)


@pytest.mark.parametrize(
    ("route", "text"),
    [
        ({"rounds": 0}, "route.rounds: expected at least 1, not 0"),
        ({"rounds": 21}, "at most 20"),
        ({"rounds": 1, "outer_radius": 9}, "no effect without one of route.rounds, route.street"),
        ({"rounds": 1, "back_radius": 2, **street()}, "route.back_radius has no effect"),
        ({"outer_radius": 4}, r"\(4 m\) must be larger than that of the turn, 5 m"),
        ({"back_radius": 0.5}, "make route.back_radius larger"),
        (street(radius=0.5), "make route.street.radius larger"),
        (street([[0, 0]]), "a drawn line needs 2 different points"),
        (street([[0, 0], [30, 0], [30, 30]], deviation=0.1), "draw the bend wider"),
        (street(deviaton=1), "did you mean route.street.deviation"),
        ({"street": {}}, "needs points"),
    ],
)
def test_what_cannot_be_walked_is_said_in_a_sentence(route: dict[str, Any], text: str) -> None:
    with pytest.raises(PlanError, match=text):
        dance(**route).build()


@pytest.mark.parametrize(
    ("cue", "text"),
    [
        ({"round": 4}, "cues.cue.0.round: the dance has 3 rounds"),
        ({"place": [90.0, 0.0]}, r"cues.cue.0.place: the head comes no nearer to that place than \d"),
        ({"place": [6.0, 2.0], "at": 3}, "a cue needs one of these"),
        ({}, "a cue needs one of these"),
    ],
)
def test_cues_at_places_that_cannot_be_are_refused(cue: dict[str, Any], text: str) -> None:
    with pytest.raises(PlanError, match=text):
        dance({"kind": "note", **cue}).moments()


def test_a_place_in_a_round_that_the_walk_does_not_reach_is_refused() -> None:
    data = dance({"kind": "note", "round": 3, "place": [6.0, 2.0]}).said()
    data["walk"] = {"start": 0.0, "end": 20.0}
    with pytest.raises(PlanError, match=r"cues\.cue\.0\.round: the walk ends before round 3 begins"):
        checked(data, "dance").build()


def test_searches_of_one_coil_refuse_rounds_and_others_know_them() -> None:
    plan = dance()
    for question in ("pitch", "disc"):
        with pytest.raises(InputError, match="walked once"):
            limit(plan, question)
    with pytest.raises(InputError, match="walked once"):
        best_turn(plan)
    wide = limit(plan, "width")
    assert wide.status == "found"
    assert check(plan.with_value("dragon.width", wide.lower - 1e-3)).safe
    assert not check(plan.with_value("dragon.width", wide.upper + 1e-3)).safe


def test_a_dance_with_a_street_is_placed_without_moving_that() -> None:
    square = Square(dance(venue=SQUARE, at=[0.0, 0.0], **street()))
    found = square.at(square.roomiest(silent))
    assert found.route.street == square.plan.route.street  # type: ignore[union-attr]
    assert math.hypot(*found.route.at or (9.0, 9.0)) < 3.0
    assert check(found).safe
