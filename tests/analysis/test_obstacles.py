"""Benches and what stands still: first touches, least distances, grazes; and what cannot be."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from benchdragon import (
    Answer,
    Arc,
    Clothoid,
    Dragon,
    InputError,
    Line,
    Route,
    SpeedProfile,
    UnsureError,
    Walk,
    WalkError,
)
from benchdragon.analysis import obstacle_search
from benchdragon.analysis.obstacle_search import ObstacleSearch
from benchdragon.analysis.obstacles import first_touch, least_distance, obstacle_answers, touching
from benchdragon.kernels import obstacle_memory
from benchdragon.kernels import obstacle_search as kernel
from benchdragon.kernels.memory import group_at, recall
from benchdragon.kernels.obstacle_memory import Beside
from benchdragon.kernels.obstacle_question import BASE
from benchdragon.kernels.obstacle_result import head_between
from benchdragon.model.obstacle import MOST_CORNERS, Obstacle
from benchdragon.plans.schema import read_plan
from tests.analysis.straights import EAST, FIVE, ONE, east, kerb, wall
from tests.solve.asked_in_python import in_python

TRUTH = json.loads((Path(__file__).parents[1] / "truth" / "contest.json").read_text("utf-8"))
# Five benches of mixed sizes: 1.5 m from handle to handle, widths of 0.5, 0.7, 0.9 m.
MIXED = Dragon.of_sizes([2.0] * 5, [0.5, 0.7, 0.5, 0.7, 0.9], 0.25, 0.25)


def sure(found: Answer | None, time: float, bench: int, within: float = 1e-12) -> Answer:
    """The answer, which is a touch by a bench at a time, its bracket narrower than `within`, s."""
    assert found is not None
    assert found.status == "found"
    assert found.lower <= time <= found.upper <= found.lower + within
    assert found.lower <= found.value <= found.upper
    assert found.witness is not None
    assert found.witness.benches == (bench,)
    return found


# What is met, and when.


def test_the_contests_dragon_touches_a_box_when_the_second_road_says() -> None:
    walk = read_plan("spiral-in").build()
    box = Obstacle.rectangle("box", (3.0, 1.0), (0.5, 0.3), math.radians(30.0))
    kept = TRUTH["box_touch"]
    found = sure(first_touch(walk, box, 0.0, 412.0), float(kept["s"]), int(kept["bench"]), 3e-12)
    assert found.value == pytest.approx(float(kept["s"]), abs=1e-12)
    assert found.witness is not None
    assert found.witness.features == ((1, "front right"),)
    assert found.witness.obstacle == "box"


@pytest.mark.parametrize("x", [10.3, 14.0, 14.25, 18.25, 22.25, 37.1])
def test_a_wall_across_the_route_is_met_by_the_front_of_bench_1(x: float) -> None:
    # At 14.25, 18.25 and 22.25 the front comes to it just where a stretch of 4 m of route ends.
    sure(first_touch(east(), wall(x), 0.0, 40.0), x - 10.25, 1)
    sure(obstacle_answers(east(), wall(x), 0.0, 40.0).contact, x - 10.25, 1)
    sure(first_touch(east(ONE), wall(x), 0.0, 40.0), x - 10.25, 1)


def test_a_margin_and_a_radius_are_met_so_much_sooner() -> None:
    sure(first_touch(east(), wall(20.0, margin=0.5), 0.0, 40.0), 9.25, 1)
    sure(first_touch(east(), Obstacle.circle("post", (20.0, 0.1), 1.0), 0.0, 40.0), 8.75, 1)
    post = Obstacle.circle("post", (20.0, 0.1), 1.0, 0.5)
    found = sure(first_touch(east(), post, 0.0, 40.0), 8.25, 1)
    assert found.witness is not None
    assert found.witness.gap == pytest.approx(0.5, abs=1e-12)


def test_only_the_wider_benches_meet_what_the_first_passes() -> None:
    # Half widths of 0.25, 0.35, 0.25, 0.35, 0.45 m: fronts of benches start 0, 1.5, 3, ... m behind.
    sure(first_touch(east(MIXED), wall(30.0, 0.3), 0.0, 60.0), 21.25, 2)
    sure(first_touch(east(MIXED), wall(30.0, 0.4), 0.0, 60.0), 25.75, 5)
    assert first_touch(east(MIXED), wall(30.0, 0.5), 0.0, 60.0) is None
    found = least_distance(east(MIXED), wall(30.0, 0.5), 0.0, 60.0)
    assert found.value == pytest.approx(0.05, abs=1e-12)
    assert found.lower <= 0.05 <= found.upper
    assert found.witness is not None
    assert found.witness.benches == (5,)


def test_a_bench_meets_what_those_before_have_passed_already() -> None:
    # The third stands at a kink, and its side swings inward as it goes on; two are past it.
    route = Route((Line(9.0), Line(20.0).moved((9.0, 0.0), 0.5)), kinks=True)
    walk = Walk(FIVE, route, start=12.2)
    found = first_touch(walk, Obstacle.circle("post", (9.0, 0.4), 0.001), 0.0, 8.0)
    assert found is not None
    sure(found, found.value, 3, 3e-12)
    assert 0.1 < found.value < 0.75
    # What only those before have walked over is met by none.
    assert first_touch(east(start=20.0), Obstacle.circle("post", (25.0, 0.9), 0.5), 0.0, 9.0) is None


def test_what_starts_inside_touches_at_once() -> None:
    house = Obstacle.rectangle("house", (0.0, 0.0), (60.0, 60.0))
    venue = Obstacle.venue("square", [(50, 50), (60, 50), (60, 60)])
    pond = Obstacle.circle("pond", (5.0, 0.0), 30.0)
    speck = Obstacle.rectangle("speck", (9.0, 0.0), (0.01, 0.01))
    for obstacle in (house, venue, pond, speck):
        told = obstacle_answers(east(), obstacle, 0.0, 1.0)
        found = sure(told.contact, 0.0, told.contact.witness.benches[0], 0.0)  # type: ignore[union-attr]
        assert found.witness is not None
        assert found.witness.gap < 0.0
        assert (told.distance.lower, told.distance.value, told.distance.upper) == (0.0, 0.0, 0.0)
    late = obstacle_answers(east(), house, 3.0, 4.0).contact
    sure(late, 3.0, 1, 0.0)


def test_a_venue_is_left_where_a_bench_crosses_its_edge() -> None:
    venue = Obstacle.venue("square", [(-10, -5), (30, -5), (30, 5), (-10, 5)])
    sure(first_touch(east(), venue, 0.0, 40.0), 19.75, 1)
    told = obstacle_answers(east(), venue, 0.0, 10.0)
    assert told.contact is None
    assert told.distance.value == pytest.approx(4.75, abs=1e-12)


def test_a_chain_of_lines_has_no_inside() -> None:
    ring = [(-90, -9), (190, -9), (190, 9), (-90, 9), (-90, -9)]
    told = obstacle_answers(east(), Obstacle.line("rope", ring), 0.0, 80.0)
    assert told.contact is None
    assert told.distance.value == pytest.approx(8.75, abs=1e-12)


@pytest.mark.parametrize("first", range(4))
def test_a_dance_meets_each_side_of_an_outline(first: int) -> None:
    corners = [(20.0, -3.0), (26.0, -3.0), (26.0, 3.0), (20.0, 3.0)]
    turned = corners[first:] + corners[:first]
    sure(first_touch(east(ONE), Obstacle.polygon("house", turned), 0.0, 40.0), 9.75, 1)
    # From within a venue it is left at the far side.
    sure(first_touch(east(ONE, 23.0), Obstacle.venue("square", turned), 0.0, 40.0), 2.75, 1)


def test_the_soonest_of_several_touches_is_told() -> None:
    # Bench 1 comes to its wall 30 m on; the wider ones to theirs sooner, each by itself.
    pegs = Obstacle.line("pegs", [(40.25, 0.2), (40.25, 0.5), (12.0, 0.5), (12.0, 0.4)])
    sure(first_touch(east(MIXED), pegs, 0.0, 60.0), 7.75, 5)
    both = Obstacle.line("pegs", [(20.25, 0.2), (20.25, 0.5), (12.0, 0.5), (12.0, 0.4)])
    dragon = Dragon.of_sizes([2.0, 2.0], [0.5, 0.9], 0.25, 0.25)
    sure(first_touch(east(dragon), both, 0.0, 60.0), 3.25, 2)


@pytest.mark.parametrize(("widths", "time", "bench"), [((0.5, 0.9), 3.25, 2), ((0.9, 0.5), 1.75, 1)])
def test_the_soonest_touch_is_told_in_whatever_order_they_are_found(
    widths: tuple[float, float], time: float, bench: int
) -> None:
    pegs = Obstacle.line("pegs", [(20.25, 0.2), (20.25, 0.5), (12.0, 0.5), (12.0, 0.4)])
    dragon = Dragon.of_sizes([2.0, 2.0], widths, 0.25, 0.25)
    sure(touching(east(dragon), pegs, 0.0, 60.0)[-1], time, bench)


def test_a_coarse_least_distance_is_told_as_such() -> None:
    post = Obstacle.circle("post", (20.0, 3.0), 1.0)
    found = least_distance(east(), post, 0.0, 40.0, tolerances=(1e-3,))
    assert found.lower <= 1.75 <= found.upper
    assert found.upper - found.lower == pytest.approx(1e-3, rel=1e-6)


def test_a_dance_within_a_ring_of_walls_touches_none() -> None:
    ring = Obstacle.polygon("yard", [(-90, -9), (190, -9), (190, -8), (-90, -8)])
    told = obstacle_answers(east(), ring, 0.0, 80.0)
    assert told.contact is None
    assert told.distance.value == pytest.approx(7.75, abs=1e-12)


# Grazes: undecided only within rounding, and never late.


@pytest.mark.parametrize("margin", [0.0, 0.25])
@pytest.mark.parametrize("off", [-1e-11, 0.0, 1e-11])
def test_a_kerb_along_the_route_is_undecided_only_within_rounding(margin: float, off: float) -> None:
    told = obstacle_answers(east(), kerb(0.25 + margin + off, margin=margin), 0.0, 40.0)
    if off > 0.0:
        assert told.contact is None
    else:
        assert told.contact is not None
        assert told.contact.status == ("undecided" if off == 0.0 else "found")
        assert told.contact.lower == 0.0
    if off == 0.0 and not margin:
        assert told.distance.value == 0.0
    assert told.distance.value == pytest.approx(margin + max(off, 0.0), abs=2e-11)
    assert told.distance.lower <= max(margin + off, 0.0) + 1e-15
    assert told.distance.upper >= margin + off - 1e-15
    assert (told.distance.upper > 0.0) is (margin + off >= 0.0)


def test_a_touch_behind_a_graze_is_found() -> None:
    # Flush along 20 m, then 5 cm in the way: bench 1 comes to that with its left front corner.
    steps = [(20, 0.25), (40, 0.25), (40, 0.2), (41, 0.2), (41, 3), (20, 3)]
    told = obstacle_answers(east(), Obstacle.polygon("kerb", steps), 0.0, 40.0)
    assert told.contact is not None
    assert told.contact.status == "found"
    assert told.contact.lower == pytest.approx(9.75, abs=1e-12)
    assert told.contact.upper == pytest.approx(29.75, abs=1e-12)


def test_grazes_apart_from_a_touch_are_told_before_it() -> None:
    apart = Obstacle.line("pegs", [(20.0, 0.25), (20.0, 1.0), (33.0, 1.0), (33.0, 0.2)])
    found = touching(east(), apart, 0.0, 40.0)
    assert [answer.status for answer in found] == ["undecided", "found"]
    assert found[0].lower <= 9.75 <= found[0].upper <= 12.0
    sure(found[1], 22.75, 1)
    first = first_touch(east(), apart, 0.0, 40.0)
    assert first is not None
    assert first.status == "undecided"
    sure(obstacle_answers(east(), apart, 0.0, 40.0).contact, 22.75, 1)


def test_no_more_grazes_are_passed_over_than_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    apart = Obstacle.line("pegs", [(20.0, 0.25), (20.0, 1.0), (33.0, 1.0), (33.0, 0.2)])
    in_python(monkeypatch)
    monkeypatch.setattr(kernel, "MOST_GRAZES", 1)
    with pytest.raises(UnsureError, match="benches come within rounding of pegs too often"):
        touching(east(), apart, 0.0, 40.0)


def test_grazes_beyond_what_there_is_room_for_are_all_told(monkeypatch: pytest.MonkeyPatch) -> None:
    apart = Obstacle.line("pegs", [(20.0, 0.25), (20.0, 1.0), (33.0, 1.0), (33.0, 0.2)])
    roomy = touching(east(), apart, 0.0, 40.0)
    in_python(monkeypatch)
    monkeypatch.setattr(obstacle_memory, "FIRST_ROWS", 1)
    told = [touching(east(), apart, 0.0, 40.0), roomy]
    ends = [[(one.status, one.lower, one.upper) for one in each] for each in told]
    assert ends[0] == ends[1]
    assert len(roomy) == 2


def test_what_takes_too_many_evaluations_is_undecided_and_hides_no_other_bench(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(obstacle_search, "MOST_EVALUATIONS", 1)
    found = touching(east(MIXED), wall(30.0, 0.3), 0.0, 60.0)
    assert found
    assert all(answer.status == "undecided" for answer in found)
    assert found[0].lower <= 21.25
    house = Obstacle.polygon("house", [(14.0, 0.2), (60.0, 0.2), (60.0, 1.0), (14.0, 1.0)])
    told = touching(east(FIVE, 13.9), house, 0.0, 1.0)
    assert all(0.0 <= touch.lower <= touch.upper <= 1.0 for touch in told)
    assert {touch.witness.benches for touch in told if touch.witness} >= {(1,)}


def test_a_circle_about_the_centre_of_a_bend_is_kept_at_one_distance() -> None:
    route = Route((Arc(5.0, 6.0),))
    walk = Walk(Dragon.of_sizes([1.0] * 4, 0.3, 0.1, 0.1), route, start=8.0)
    kept = math.sqrt(25.0 - 0.16) - 0.15
    told = least_distance(walk, Obstacle.circle("well", (0.0, 5.0), 1.0), 0.0, 4.0)
    assert told.lower <= kept - 1.0 <= told.upper + 1e-13
    assert told.upper - told.lower <= 1.1e-5
    near = replace(Obstacle.circle("well", (0.0, 5.0), 1.0), margin=kept - 1.0 - 1e-8)
    assert first_touch(walk, near, 0.0, 4.0) is None
    found = first_touch(walk, replace(near, margin=kept - 1.0 + 1e-8), 0.0, 4.0)
    assert found is not None
    assert (found.status, found.lower, found.upper) == ("found", 0.0, 0.0)


# Walks that stand still, begin late, or cannot go on.


@pytest.mark.parametrize("end", [0.0, 5.0])
def test_a_walk_that_stands_still_touches_what_it_stands_at(end: float) -> None:
    still = Walk(FIVE, EAST, SpeedProfile((0.0, 10.0, 20.0), (0.0, 0.0, 1.0)), 10.0)
    for off, status in ((-1e-11, "found"), (0.0, "undecided"), (1e-11, None)):
        told = obstacle_answers(still, kerb(0.25 + off), 0.0, end)
        assert (told.contact.status if told.contact else None) == status
        assert told.distance.lower <= max(off, 0.0) <= told.distance.upper
    told = obstacle_answers(still, wall(20.0), 0.0, end)
    assert told.contact is None
    assert told.distance.value == pytest.approx(9.75, abs=1e-12)


def test_times_are_those_of_the_profile_and_of_the_search() -> None:
    profile = SpeedProfile((0.0, 4.0, 6.0, 9.0), (1.0, 1.0, 0.0, 0.0))
    walk = Walk(FIVE, EAST, profile, 10.0)  # 5 m until 6 s, then it stands
    sure(first_touch(walk, wall(12.25), 0.0, 9.0), 2.0, 1)
    sure(first_touch(walk, wall(12.25), 2.5, 9.0), 2.5, 1, 0.0)
    assert first_touch(walk, wall(15.26), 0.0, 9.0) is None
    # Behind the start of the search nothing counts: the post is between benches then.
    assert first_touch(east(ONE), wall(10.0), 6.0, 20.0) is None
    sure(first_touch(east(), wall(20.0), 9.0, 20.0), 9.75, 1)


def test_a_walk_past_the_end_of_its_route_is_refused() -> None:
    for ask in (first_touch, least_distance):
        with pytest.raises(WalkError, match="past the end of the route"):
            ask(east(), wall(20.0), 0.0, 200.0)


@pytest.mark.parametrize("ask", [first_touch, least_distance, obstacle_answers])
def test_a_bench_that_cannot_follow_is_told_of(ask: object) -> None:
    # Narrower than the bench is long: it cannot round this though it stands at both ends.
    hairpin = Route.joined([Line(20.0), Arc(0.5, math.pi), Line(20.0)])
    assert callable(ask)
    with pytest.raises((WalkError, UnsureError)):
        ask(Walk(ONE, hairpin, start=10.0), wall(60.0, 50.0, 51.0), 0.0, 25.0)


def test_wrong_questions_are_refused_in_one_sentence() -> None:
    for start, end, text in (
        (5.0, 1.0, "must not come before the start"),
        (math.nan, 1.0, "start must be finite"),
        (0.0, math.inf, "end must be finite"),
    ):
        with pytest.raises(InputError, match=text):
            first_touch(east(), wall(20.0), start, end)
    with pytest.raises(InputError, match="obstacle must be"):
        first_touch(east(), "wall", 0.0, 1.0)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="walk must be"):
        first_touch(EAST, wall(20.0), 0.0, 1.0)  # type: ignore[arg-type]
    for margin in (math.nan, math.inf, -1.0):
        with pytest.raises(InputError, match="margin must"):
            wall(20.0, margin=margin)


# Odd sizes.


def test_an_obstacle_of_thousands_of_corners_is_met_as_what_it_draws() -> None:
    turns = np.linspace(0.0, 2.0 * math.pi, MOST_CORNERS, endpoint=False)
    ring = np.column_stack([20.0 + np.cos(turns), 0.1 + np.sin(turns)])
    found = first_touch(east(), Obstacle.polygon("pond", ring), 0.0, 40.0)
    other = first_touch(east(), Obstacle.circle("pond", (20.0, 0.1), 1.0), 0.0, 40.0)
    assert found is not None
    assert other is not None
    # The polygon's sides lie up to r (1 - cos(pi / n)) inside of the circle.
    assert other.lower <= found.upper
    assert found.lower <= other.upper + (1.0 - math.cos(math.pi / MOST_CORNERS)) + 1e-12


@pytest.mark.parametrize("far", [1e5, -3e6])
def test_far_from_the_origin_brackets_are_as_wide_as_coordinates_allow(far: float) -> None:
    route = EAST.moved(0.3, (far, 0.7 * far))
    walk = Walk(FIVE, route, start=10.0)
    met = wall(20.0).moved(0.3, (far, 0.7 * far))
    found = first_touch(walk, met, 0.0, 40.0)
    assert found is not None
    assert found.lower <= 9.75 + 4.0 * math.ulp(far)
    assert found.upper >= 9.75 - 4.0 * math.ulp(far)
    assert found.upper - found.lower <= 1e-13 * abs(far)
    near = least_distance(walk, wall(20.0, 1.25, 3.0).moved(0.3, (far, 0.7 * far)), 0.0, 40.0)
    assert near.lower <= 1.0 + 4.0 * math.ulp(far)
    assert near.upper >= 1.0 - 4.0 * math.ulp(far)
    assert near.upper - near.lower <= 1e-13 * abs(far)


def test_benches_far_longer_than_a_stretch_of_route_sweep_all_that_is_beside_them() -> None:
    long = Dragon.of_sizes([40.0, 2.0], 0.5, 0.25, 0.25)
    route = Route((Line(60.0), Line(90.0).moved((60.0, 0.0), 0.4)), kinks=True)
    walk = Walk(long, route, start=59.0)
    # The middle of bench 1 swings over the inside of the kink.
    middle = Obstacle.circle("post", (50.0, 1.5), 0.1)
    found = first_touch(walk, middle, 0.0, 40.0)
    assert found is not None
    sampled = walk.motion(np.linspace(0.0, 40.0, 4001))
    x, y = sampled.x[:, :2], sampled.y[:, :2]
    ahead = np.stack([x[:, 0] - x[:, 1], y[:, 0] - y[:, 1]]) / np.hypot(
        *(x[:, 0] - x[:, 1], y[:, 0] - y[:, 1])
    )
    across = ahead[0] * (1.5 - y[:, 1]) - ahead[1] * (50.0 - x[:, 1])
    touched = np.flatnonzero(np.abs(across) <= 0.25 + 0.1)
    assert sampled.times[touched[0] - 1] <= found.upper
    assert found.lower <= sampled.times[touched[0]]


def test_the_size_of_each_bench_is_searched_along_its_own_stretch() -> None:
    with ObstacleSearch(east(MIXED), wall(30.0), 0.0, 4.0) as search:
        ways = search.ways().tolist()
    # A bench stops where the one of its size before it stood: benches 1 and 3 start 3 m apart.
    assert ways == [[0, 2, 7.0, 14.0, 7.0], [1, 2, 5.5, 12.5, 7.0], [4, 1, 4.0, 8.0, 4.0]]


def test_heads_enclose_the_handle_they_are_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    in_python(monkeypatch)
    route = Route.joined([Line(12.0), Arc(3.0, 2.0), Clothoid(3.0, 1.0 / 3.0, 0.0), Line(20.0)])
    walk = Walk(MIXED, route, start=14.0)
    with ObstacleSearch(walk, wall(90.0), 0.0, 12.0) as search:
        known = group_at(Beside, recall(search._handle) + BASE)
        for bench in range(5):
            first, last = known.s[bench].tolist()
            for s in np.linspace(first, last, 7)[1:-1].tolist():
                before, after = head_between(known, bench, s, s)
                at = walk.placement([before, after]).s[:, bench]
                assert at[0] <= s <= at[1]
                assert after - before <= 1e-11


def test_of_a_bench_outside_the_venue_the_corner_that_is_farthest_out_is_told() -> None:
    edge = Obstacle.venue("hall", [(0.0, -3.0), (30.0, -3.0), (30.0, 3.0), (0.0, 3.0)])
    walk = east(start=5.0)
    found = first_touch(walk, edge, 0.0, 9.0)
    assert found is not None
    assert found.witness is not None
    (bench,) = found.witness.benches
    placed = walk.motion([0.0])
    front = float(placed.x[0, bench - 1] + 0.25), float(placed.x[0, bench] - 0.25)
    assert found.witness.point[0] == pytest.approx(min(front), abs=1e-9)
    assert found.witness.gap == pytest.approx(min(front), abs=1e-9)
    assert found.witness.gap < 0.0
