"""Posts for marshals on the line around a dance, and the reason for each."""

import math

import shapely

from benchdragon.analysis.check import Report, check
from benchdragon.analysis.crowd import outer_lines
from benchdragon.analysis.posts import EVERY, JOINED, Post, Reason, _spaced, marshal_posts
from benchdragon.analysis.swept import swept_area
from benchdragon.model.rings import Ring
from benchdragon.plans.schema import read_plan

SMALL = ("dragon.benches=8", "route.pitch=1.2", "route.start_turn=4", "walk.end=12")
SQUARE = "venue.rectangle=[40, 30]"
ENTRANCE = (20.0, 5.0)


def checked(*settings: str) -> tuple[Report, list[Ring]]:
    """The check of a small dance, and the spectators' lines about it."""
    report = check(read_plan("spiral-in", [*SMALL, *settings]))
    swept = swept_area(report.walk, report.start, report.end, margin=2.0, error=0.05)
    return report, outer_lines(swept)


def reasons(posts: tuple[Post, ...]) -> dict[str, Reason]:
    return {one.why: one for post in posts for one in post.reasons}


def test_places_on_both_sides_of_a_rings_seam_are_one_post() -> None:
    wanted = [(0.5, Reason("entrance")), (99.8, Reason("fastest")), (96.0, Reason("tightest"))]
    found = [(along, [one.why for one in why]) for along, why in _spaced(wanted, 100.0)]
    kept = [one for one in found if one[1] != ["line"]]
    assert kept == [(0.5, ["entrance", "fastest"]), (96.0, ["tightest"])]


def test_a_line_on_which_nothing_is_wanted_has_posts_all_the_same() -> None:
    places = [along for along, _reasons in _spaced([], 90.0)]
    assert places == [0.0, 22.5, 45.0, 67.5]


def test_posts_stand_on_the_line_and_are_never_farther_apart_than_stated() -> None:
    report, lines = checked(SQUARE)
    posts = marshal_posts(report, lines, [ENTRANCE])
    (line,) = map(shapely.LinearRing, lines)
    along = sorted(line.project(shapely.Point(post.point)) for post in posts)
    assert all(line.distance(shapely.Point(post.point)) < 1e-6 for post in posts)
    gaps = [b - a for a, b in zip(along, [*along[1:], along[0] + line.length], strict=True)]
    assert max(gaps) <= EVERY + 1e-6
    why = reasons(posts).keys()
    assert {"venue", "entrance", "tightest"} <= why
    assert "fastest" not in why, "all handles are as fast as the head"
    (entrance,) = [p for p in posts if "entrance" in [one.why for one in p.reasons]]
    nearest = line.distance(shapely.Point(ENTRANCE))
    assert shapely.Point(entrance.point).distance(shapely.Point(ENTRANCE)) <= nearest + JOINED


def test_posts_tell_the_distances_that_the_check_found() -> None:
    report, lines = checked(SQUARE)
    found = reasons(marshal_posts(report, lines))
    (venue,) = [one for one in report.obstacles if one.obstacle.kind == "venue"]
    assert found["venue"].value == venue.distance.sure(up=False)
    assert found["tightest"].value == report.clearance.sure(up=False)
    assert math.isnan(found["venue"].time)


def test_where_handles_run_there_are_posts_but_not_again_at_the_fastest() -> None:
    # Two rushes, 10 m apart; only the faster one is where the fastest handle is.
    rushes = "[[0, 1], [1, 1], [1.5, 2.6], [2, 1], [12, 1], [12.5, 2.4], [13, 1]]"
    pace = f"walk.profile={rushes}", "walk.end=15", "dragon.benches=2"
    asked = []
    for run_from in (1.8, 2.5, 3.0):
        posts = marshal_posts(*checked(*pace, f"people.run_from={run_from}"))
        asked.append([one for post in posts for one in post.reasons if one.why == "run"])
        assert "fastest" in reasons(posts)
    assert [len(some) for some in asked] == [1, 0, 0]
    assert 12.0 <= asked[0][0].time <= 13.0
    assert 1.8 <= asked[0][0].value <= 2.5


def test_a_stop_of_the_head_makes_no_place_the_fastest() -> None:
    report, lines = checked(SQUARE, 'cues.cue=[{kind="hold", at=4, hold=3}]')
    assert report.walk.profile.stretches(report.start, report.end).speeds.min() == 0.0
    assert "fastest" not in reasons(marshal_posts(report, lines))
