"""Spectators about a dance: their ground, the way past it, and entrances that it shuts."""

import math

import numpy as np
import pytest
import shapely

from benchdragon.analysis.check import Report, check
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.crowd import (
    Crowd,
    Entrance,
    crowd_of,
    density_text,
    distance_of,
    entrances_of,
    event_findings,
    outer_lines,
    ways_out,
    within_lines,
)
from benchdragon.analysis.distance import boxes
from benchdragon.analysis.entrances import gates_of
from benchdragon.analysis.swept import rings, swept_area
from benchdragon.kernels.box import corner
from benchdragon.model.rings import Ring
from benchdragon.plans.schema import read_plan
from benchdragon.plans.toml import PlanError

SMALL = ("dragon.benches=8", "route.pitch=1.2", "route.start_turn=4", "walk.end=12")
SAID = ("event.spectators=813", "event.distance=3.25", "venue.rectangle=[40, 30]", "cues.clock=18:30")
# One that the dance goes by, and one that it does not.
ENTRANCES = "event.entrances=[[3, 0], [20, 5]]"


@pytest.fixture(scope="module")
def report() -> Report:
    return check(read_plan("spiral-in", [*SMALL, *SAID, ENTRANCES]))


@pytest.fixture(scope="module")
def lines(report: Report) -> list[Ring]:
    margin = distance_of(report.plan)
    return outer_lines(swept_area(report.walk, report.start, report.end, margin=margin, error=0.05))


@pytest.fixture(scope="module")
def crowd(report: Report, lines: list[Ring]) -> Crowd:
    return crowd_of(report.plan, lines, edge_of(report))


@pytest.fixture(scope="module")
def entrances(report: Report, lines: list[Ring]) -> list[Entrance]:
    span = report.start, report.end
    return entrances_of(report.plan, report.walk, span, lines, report.greatest_speed.upper)


def edge_of(report: Report) -> float:
    (venue,) = [one for one in report.obstacles if one.obstacle.kind == "venue"]
    return venue.distance.sure(up=False)


def benches(report: Report, time: float) -> list[shapely.Polygon]:
    """The rectangles of all benches at a time, s."""
    table = boxes(report.walk.motion([time]), 0)
    count = len(report.walk.dragon)
    return [shapely.Polygon([corner(table, n, k) for k in range(4)]) for n in range(count)]


@pytest.fixture(scope="module")
def boards(report: Report) -> list[tuple[float, shapely.MultiPolygon]]:
    """Where the benches are at many times."""
    times = np.linspace(report.start, report.end, 241).tolist()
    return [(time, shapely.MultiPolygon(benches(report, time))) for time in times]


def test_ground_for_spectators_is_what_lies_outside_the_line(
    report: Report, lines: list[Ring], crowd: Crowd, boards: list[tuple[float, shapely.MultiPolygon]]
) -> None:
    """Beside random places, each looked at from where the benches are at many times."""
    dice = np.random.default_rng(36)
    edge = next(one.outline for one in report.plan.obstacles() if one.kind == "venue")
    places = shapely.points(dice.uniform(edge.min(axis=0), edge.max(axis=0), (4000, 2)))
    near = shapely.union_all([one for _time, one in boards]).buffer(3.25, quad_segs=32)
    line = shapely.union_all([shapely.Polygon(ring) for ring in rings(near).outer])
    free = float(np.mean(~shapely.contains(line, places)))
    venue = shapely.Polygon(edge)
    assert crowd.ground == pytest.approx(free * venue.area, abs=0.03 * venue.area)
    assert crowd.way is not None
    assert crowd.way == pytest.approx(line.distance(venue.boundary), abs=0.02)
    assert crowd.way <= line.distance(venue.boundary)
    assert crowd.ground is not None
    assert crowd.density == 813 / crowd.ground
    assert within_lines(lines) == pytest.approx(line.area, abs=2.0)
    assert within_lines(lines) >= line.area


def test_what_stands_on_the_square_takes_ground_from_spectators(
    report: Report, lines: list[Ring], crowd: Crowd
) -> None:
    settings = [*SMALL, *SAID, 'obstacle=[{kind="circle", centre=[17, 12], radius=1}]']
    plan = read_plan("spiral-in", settings)
    less = crowd_of(plan, lines, edge_of(report))
    assert crowd.ground is not None
    assert less.ground is not None
    assert crowd.ground - less.ground == pytest.approx(math.pi, rel=0.01)
    assert crowd.ground - less.ground >= math.pi


def test_entrances_are_shut_while_benches_are_near(
    report: Report, entrances: list[Entrance], boards: list[tuple[float, shapely.MultiPolygon]]
) -> None:
    inner, outer = entrances
    assert (inner.inside, outer.inside) == (True, False)
    assert outer.shut == ()
    for one in entrances:
        place = shapely.Point(one.gate.place)
        seen = [board.distance(place) for _time, board in boards]
        assert one.nearest.value == pytest.approx(min(seen), abs=0.05)
        near = one.nearest.witness
        assert near is not None
        assert near.time is not None
        bench = benches(report, near.time)[near.benches[0] - 1]
        assert bench.distance(place) == pytest.approx(one.nearest.value, abs=5e-3)
    place = shapely.Point(inner.gate.place)
    shut = [time for time, board in boards if board.distance(place) <= 3.25]
    assert shut
    for time in shut:
        assert any(since <= time <= until for since, until in inner.shut)
    told = sum(until - since for since, until in inner.shut)
    assert told <= len(shut) * 0.05 + 2.0


@pytest.mark.parametrize("venue", ["[40, 30]", "[16, 30]"], ids=["round", "in the edge"])
def test_all_of_a_wide_entrance_counts(
    report: Report, lines: list[Ring], boards: list[tuple[float, shapely.MultiPolygon]], venue: str
) -> None:
    """One whose middle lies outside the line, and what is in the venue's edge of another."""
    plan = read_plan("spiral-in", [*SMALL, f"venue.rectangle={venue}", "event.entrances=[[8, 6, 9]]"])
    plan = plan.with_value("event.distance", 3.25)
    span, fastest = (report.start, report.end), report.greatest_speed.upper
    (one,) = entrances_of(plan, report.walk, span, lines, fastest)
    gate = shapely.LineString([(8.0, 1.5), (8.0, 10.5)])
    shape = gate if venue == "[16, 30]" else shapely.Point(8.0, 6.0).buffer(4.5, 64)
    line = shapely.union_all([shapely.Polygon(ring) for ring in lines])
    assert not line.contains(shapely.Point(8.0, 6.0))
    assert line.intersects(shape)
    assert one.inside
    seen = [board.distance(shape) for _time, board in boards]
    assert one.nearest.value == pytest.approx(min(seen), abs=0.05)
    shut = [time for (time, _board), away in zip(boards, seen, strict=True) if away <= 3.25]
    assert shut
    for time in shut:
        assert any(since <= time <= until for since, until in one.shut)
    assert sum(until - since for since, until in one.shut) <= len(shut) * 0.05 + 2.0


def test_ways_out_are_as_wide_as_the_plan_says_and_those_that_are_shut_do_not_count(
    report: Report, entrances: list[Entrance]
) -> None:
    plan = report.plan.with_value("event.entrances", [[3, 0, 2], [20, 5, 4], [-20, 5, 1.5], [0, 15]])
    near = entrances[0].nearest
    some = [Entrance(gate, near, inside=n == 0, shut=()) for n, gate in enumerate(gates_of(plan))]
    found = ways_out(some, 813)
    assert (found.width, found.free, found.unknown) == (7.5, 5.5, (4,))
    assert found.flows == (5.5 * 60.0, 5.5 * 82.0)
    assert found.minutes == pytest.approx((813 / (5.5 * 60.0), 813 / (5.5 * 82.0)))
    assert ways_out(some, None).minutes is None
    assert ways_out(some[:1], 813).minutes == (math.inf, math.inf)
    bare = ways_out(some[3:], 813)
    assert (bare.width, bare.free, bare.unknown) == (None, 0.0, (1,))


def test_an_entrance_inside_the_line_is_a_finding_with_its_times(
    report: Report, entrances: list[Entrance], crowd: Crowd
) -> None:
    clock = Clock("18:30", report.start)
    (found,) = event_findings(report.plan, crowd, entrances, clock)
    assert found.code == "BD401"
    since, until = entrances[0].shut[0]
    assert f"and is shut by them ({clock.tell(since)}–{clock.tell(until)})" in found.text
    assert "entrance 1 lies inside the spectators' line" in found.text
    free = Entrance(entrances[0].gate, entrances[0].nearest, inside=True, shut=())
    (found,) = event_findings(report.plan, crowd, [free], clock)
    assert "which goes round it" in found.text


def test_too_many_people_on_the_ground_are_a_finding(
    report: Report, lines: list[Ring], crowd: Crowd
) -> None:
    ground, clock = crowd.ground or 0.0, Clock("", 0.0)
    for people, codes in ((int(3.59 * ground), []), (int(3.61 * ground), ["BD402"])):
        plan = report.plan.with_value("event.spectators", people)
        found = event_findings(plan, crowd_of(plan, lines, edge_of(report)), [], clock)
        assert [one.code for one in found] == codes
    said = ["people can walk about", "walking is slowed", "people are touched against their will"]
    said += ["dangerous forces begin", "critical even where nobody moves"]
    assert [density_text(one) for one in (1.99, 2.0, 3.6, 5.6, 7.1)] == said
    full = Crowd(20_000, 0.0, 0.0)
    assert full.density == math.inf
    (one,) = event_findings(read_plan("spiral-in"), full, [], clock)
    assert one.text.startswith("there is no ground for 20000 spectators")
    assert Crowd(0, 0.0, 0.0).density == 0.0
    assert Crowd(5, None, None).density is None


def test_a_plan_without_a_venue_knows_of_no_ground(lines: list[Ring]) -> None:
    plan = read_plan("spiral-in", [*SMALL, "event.spectators=20000"])
    assert crowd_of(plan, lines, 0.0) == Crowd(20_000, None, None)


def test_the_line_keeps_two_metres_unless_the_plan_says_otherwise() -> None:
    assert distance_of(read_plan("spiral-in")) == 2.0
    assert distance_of(read_plan("spiral-in", ["event.distance=3.25"])) == 3.25


@pytest.mark.parametrize("setting", ['event.place="a\\nb"', "event.spectators=-1", "event.distance=0"])
def test_what_cannot_be_of_an_event_is_refused(setting: str) -> None:
    with pytest.raises(PlanError, match="event"):
        read_plan("spiral-in", [setting])


def test_the_event_does_not_change_the_name_of_a_plan() -> None:
    plain = read_plan("spiral-in")
    assert read_plan("spiral-in", ["event.spectators=5"]).sha256 == plain.sha256
    assert "event" not in plain.data()
