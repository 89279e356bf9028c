"""The square as a page gets it: outlines, margins, and what happens at obstacles."""

import numpy as np
import shapely

from benchdragon.analysis.check import check
from benchdragon.analysis.swept import drawn_ground, swept_area
from benchdragon.model.curves import Arc, Line, Route
from benchdragon.model.dragon import Dragon
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.outline import margin_rings
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import read_plan
from benchdragon.player.scene import checked_dance
from tests.figures.test_square import NEAR, PLAN


def test_a_page_gets_each_obstacle_with_its_margin() -> None:
    venue, well, rope = checked_dance(check(PLAN)).obstacles
    assert (venue.kind, venue.name.en, venue.name.zh) == ("venue", "the venue", "场地")
    assert (well.kind, well.name.zh, well.radius, well.margin) == ("circle", "well", 0.6, 0.3)
    assert well.points == [(9.0, -6.0)]
    assert rope.points == [(-20.0, 12.0), (20.0, 12.0)]
    assert rope.margin == 0.0


def test_a_margin_that_leaves_no_room_has_no_ring() -> None:
    square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
    assert margin_rings(Obstacle.venue("v", square, 2.5)) == []
    assert len(margin_rings(Obstacle.venue("v", square, 1.5))) == 1
    assert margin_rings(Obstacle.polygon("p", square)) == []
    ring = [(0, 0), (9, 0), (9, 9), (0, 9), (0, 8), (8, 8), (8, 1), (0, 1)]
    assert len(margin_rings(Obstacle.line("fence", [*ring, (0, 8)], 0.25))) == 2


def test_of_obstacles_that_are_clear_the_nearest_moment_is_told() -> None:
    report = check(PLAN)
    (told,) = (one for one in checked_dance(report).occasions if one.obstacle is not None)
    distance = report.obstacles[1].distance
    assert distance.witness is not None
    assert (told.kind, told.obstacle, told.time) == ("obstacle", 1, distance.witness.time)
    assert told.text.en == f"nearest to well: {distance.shown(up=False)} m"


def test_coming_near_and_touching_are_told() -> None:
    report = check(NEAR)
    contact, distance = report.obstacles[1].contact, report.obstacles[1].distance
    assert contact is not None
    assert distance.value == 0.0
    assert distance.witness is not None
    told = [one for one in checked_dance(report).occasions if one.obstacle == 1]
    assert [(one.text.en, one.benches, one.time) for one in told] == [
        ("margin from well not kept", [1], contact.value),
        ("bench 1 touches well", [1], distance.witness.time),
    ]


def test_leaving_the_venue_is_told_of_the_venue() -> None:
    plan = read_plan("turn", ["dragon.benches=20", "walk.end=60", "venue.rectangle=[16, 16]"])
    told = [one for one in checked_dance(check(plan)).occasions if one.obstacle == 0]
    assert [one.kind for one in told] == ["venue"]
    assert told[0].text.zh.endswith("越出场地")


def test_a_page_of_a_square_gets_the_ground_that_the_dance_covers() -> None:
    dance = checked_dance(check(PLAN))
    outer, *holes = sorted((shapely.Polygon(ring) for ring in dance.ground), key=lambda one: -one.area)
    ground = outer.difference(shapely.union_all(holes))
    walk = PLAN.build()
    motion = walk.motion(np.linspace(*PLAN.span(walk), 40))
    for n in range(40):
        for corners in motion[n].corners()[0]:
            assert ground.buffer(1e-3).covers(shapely.Polygon(corners))
    assert ground.area < 1.2 * float(swept_area(walk, *PLAN.span(walk)).area)
    assert checked_dance(check(PLAN.without_square())).ground == []


def test_rings_of_the_ground_go_round_what_is_covered() -> None:
    round_and_round = Walk(
        Dragon.uniform(4), Route((Line(20.0), Arc(8.0, 14.0, (20.0, 0.0)))), start=20.0
    )
    ground = drawn_ground(round_and_round, 0.0, 100.0)
    assert all((ring[0] == ring[-1]).all() for ring in ground)
    assert [shapely.LinearRing(ring).is_ccw for ring in ground] == [True, False]
    assert shapely.Polygon(ground[1]).contains(shapely.Point(20.0, 8.0))
