"""The chalk plan: ticks lie where the route crosses tapes, and freehand strays no more than is said."""

import itertools
import math
from typing import Any

import numpy as np
import pytest

from benchdragon.analysis.chalk import (
    ARM,
    LEG,
    MOST_ASIDE,
    SPOKES,
    ChalkPlan,
    chalk_plan,
)
from benchdragon.analysis.chalk_line import Trail
from benchdragon.analysis.ground import Ground
from benchdragon.errors import InputError
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.curves import Line as StraightLine
from benchdragon.model.curves import Route, Spiral
from benchdragon.model.obstacle import Obstacle
from benchdragon.plans.schema import Plan, checked, read_plan

STREET = {
    "kind": "parts",
    "part": [
        {"kind": "line", "length": 70},
        {"kind": "arc", "radius": 6, "angle": 90},
        {"kind": "line", "length": 20},
        {"kind": "arc", "radius": 8, "angle": -60},
        {"kind": "line", "length": 30},
    ],
}
THEN_COIL = {
    "kind": "parts",
    "part": [
        {"kind": "line", "length": 60},
        {"kind": "arc", "radius": 9, "angle": 900},
    ],
}
# Round a bend that has no centre, within a tape of the peg.
BEAN = {
    "kind": "parts",
    "at": [0, -8],
    "part": [
        {"kind": "arc", "radius": 8, "angle": 180},
        {"kind": "line", "length": 6},
        {"kind": "arc", "radius": 8, "angle": 180},
        {"kind": "line", "length": 6},
        {"kind": "arc", "radius": 8, "angle": 90},
    ],
}


def walked(route: dict[str, Any], **more: Any) -> Plan:
    """Four benches on a route from its beginning to its end."""
    walk = {"speed": 1.0, "position": 8, "end": 400}
    data = {"schema": 1, "dragon": {"benches": 4}, "route": route, "walk": walk, **more}
    return checked(data, "plan")


def laid(plan: Plan, said: float | None = None) -> tuple[ChalkPlan, Trail, Ground]:
    """The chalk plan of a plan."""
    walk = plan.build()
    trail, ground = Trail.of(walk, *plan.span(walk)), Ground.of(plan, walk.route)
    found = chalk_plan(trail, float(walk.dragon.links.min()), ground, said or plan.chalk.stray)
    assert found is not None
    return found, trail, ground


DANCES = {
    "contest": read_plan("spiral-in"),
    "village": read_plan("pujiang", ["venue.rectangle=[40, 30]", "venue.angle=30"]),
    "street": walked(STREET),
    "street and ring": walked(THEN_COIL),
    "bean": walked(BEAN, chalk={"peg": [0, 0]}),
}


def told_place(found: ChalkPlan, ground: Ground, n: int) -> FloatArray:
    """Where a tick is by what the paper tells of it: tape, along and aside."""
    tick = found.ticks[n]
    if tick.star >= 0:
        star = found.stars[tick.star]
        angle = ground.turned + math.tau * (tick.tape - 1) / star.spokes
        start, way = np.array(star.stake), np.array([math.cos(angle), math.sin(angle)])
    else:
        leg = found.legs[tick.tape - 1]
        start, way = np.array(leg.start), np.array(leg.end) - leg.start
        way = way / np.hypot(*way)
    return np.asarray(start + tick.along * way + tick.aside * np.array([-way[1], way[0]]))


@pytest.mark.parametrize("name", DANCES)
def test_ticks_are_places_of_the_route_and_found_by_what_is_told(name: str) -> None:
    found, trail, ground = laid(DANCES[name])
    points = trail.route.point([tick.s for tick in found.ticks])
    for n, (tick, point) in enumerate(zip(found.ticks, points, strict=True)):
        assert tick.point == pytest.approx(point, abs=1e-9)
        assert told_place(found, ground, n) == pytest.approx(point, abs=1e-8)
        assert tick.along >= 0.0, "no tape is laid backwards"
    kinds = {tick.kind: tick.s for tick in found.ticks if tick.kind}
    assert kinds["tail"] == pytest.approx(trail.low, abs=0.02)
    assert kinds["end"] == pytest.approx(trail.high, abs=0.02)
    assert kinds["head"] == pytest.approx(trail.start, abs=0.02)


def test_a_spiral_crosses_spokes_where_its_equation_says() -> None:
    plan = DANCES["contest"]
    found, trail, _ground = laid(plan)
    (star,) = found.stars
    # r = 0.55 / 2 pi times the angle, wound in: between the ends of the line.
    ends = [math.hypot(*trail.route.point([s])[0]) for s in (trail.low, trail.high)]
    k = 0.55 / math.tau
    wanted = [
        (n + 1, k * (math.tau * n / star.spokes + math.tau * turn))
        for n in range(star.spokes)
        for turn in range(30)
        if min(ends) <= k * (math.tau * n / star.spokes + math.tau * turn) <= max(ends)
    ]
    crossed = sorted((tick.tape, tick.along) for tick in found.ticks if tick.aside == 0.0)
    assert len(crossed) == len(wanted) > 200
    assert [tape for tape, _along in crossed] == [tape for tape, _radius in wanted]
    assert [along for _tape, along in crossed] == pytest.approx(
        [radius for _tape, radius in wanted], abs=1e-9
    )


@pytest.mark.parametrize("name", ["village", "street and ring", "bean"])
def test_crossings_are_where_a_dense_polygon_crosses_the_spokes(name: str) -> None:
    found, trail, ground = laid(DANCES[name])
    s = np.arange(trail.low, trail.high, 0.002)
    points = trail.route.point(s)
    for star in found.stars:
        off = points - star.stake
        ticks = np.array([tick.point for tick in found.ticks]) - star.stake
        for tape in range(1, star.spokes + 1):
            angle = ground.turned + math.tau * (tape - 1) / star.spokes
            along, across = [math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]
            ahead, side = off @ along, off @ across
            crossed = (side[:-1] < 0) != (side[1:] < 0)
            reached = ahead[:-1][crossed & (ahead[:-1] > 0.0)]
            reached = np.array([one for one in reached if one <= star.reach + 0.01])
            told = (ticks @ along)[(np.abs(ticks @ across) < 1e-6) & (ticks @ along > 0.0)]
            told = told[told <= star.reach + 0.01]
            assert len(told) > 0
            for radius in reached:
                assert np.abs(told - radius).min() < 0.005
            for radius in told:
                assert np.abs(reached - radius).min() < 0.005


def _strayed(trail: Trail, a: float, b: float) -> float:
    """How far the route is from the straight line between two of its places, m: seen densely."""
    points = trail.route.point(np.linspace(a, b, 400))
    start, way = points[0], points[-1] - points[0]
    share = np.clip(((points - start) @ way) / max(way @ way, 1e-12), 0.0, 1.0)
    return float(np.hypot(*(points - start - share[:, np.newaxis] * way).T).max())


@pytest.mark.parametrize("said", [None, 0.1])
@pytest.mark.parametrize("name", ["contest", "village", "street", "bean"])
def test_lines_from_tick_to_tick_stray_no_farther_than_is_said(name: str, said: float | None) -> None:
    found, trail, _ground = laid(DANCES[name], said)
    links = DANCES[name].build().dragon.links
    assert found.allowed == pytest.approx(said or 0.5 * links.min())
    # Of a line that is walked again the first round alone.
    round_long = 2.0 * math.pi * 8.0 + 12.0 if name == "bean" else math.inf
    gaps = [_strayed(trail, a.s, b.s) for a, b in itertools.pairwise(found.ticks) if b.s < round_long]
    assert max(gaps) <= found.stray <= found.allowed * (1.0 + 1e-9)
    assert max(gaps) > 0.5 * found.stray, "what is said is near what is so"


def test_the_fewest_spokes_that_suffice_are_taken() -> None:
    for said in (1.5, 0.8, 0.3, 0.05):
        found, _trail, _ground = laid(DANCES["contest"], said)
        (star,) = found.stars
        needed = [n for n in SPOKES if star.reach * (math.tau / n) ** 2 / 8.0 <= said]
        assert star.spokes == (needed or SPOKES[-1:])[0]
    assert sum(bool(tick.aside) for tick in found.ticks) > 100, "what spokes miss stands beside them"


def test_spokes_are_set_out_by_chords_of_a_circle_that_the_tape_draws() -> None:
    found, _trail, ground = laid(DANCES["village"])
    (star,) = found.stars
    assert star.place == pytest.approx((0.0, 0.0), abs=1e-12)
    assert star.wheel == min(math.floor(star.reach), 10.0)
    angles = ground.turned + math.tau * np.arange(star.spokes) / star.spokes
    rim = star.wheel * np.column_stack([np.cos(angles), np.sin(angles)])
    apart = np.hypot(*(np.roll(rim, -1, axis=0) - rim).T)
    assert apart == pytest.approx(np.full(star.spokes, star.chord))


def test_a_village_needs_some_dozens_of_ticks_and_a_street_a_few_at_its_bends() -> None:
    assert len(laid(DANCES["village"])[0].ticks) < 50
    found, trail, _ground = laid(DANCES["street"])
    assert found.stars == ()
    assert len(found.ticks) < 12
    joints = trail.route.joints[1:-1]
    bends = [tick.s for tick in found.ticks if tick.kind != "head"]
    for joint in joints:
        assert min(abs(s - joint) for s in bends) < 1e-6


def test_tapes_along_a_street_are_short_and_each_is_found_from_the_one_before() -> None:
    found, _trail, ground = laid(DANCES["street"])
    assert len(found.legs) > 2
    for one, after in itertools.pairwise(found.legs):
        assert after.start == one.end
        on = np.array(one.place) + (one.length + ARM) * np.array(one.way)
        there = np.array(after.place) + ARM * np.array(after.way)
        assert abs(after.swing) == pytest.approx(float(np.hypot(*(there - on))), abs=1e-9)
        left = one.way[0] * after.way[1] - one.way[1] * after.way[0]
        assert (after.swing > 0.0) == (left > 0.0)
    for leg in found.legs:
        assert leg.length == pytest.approx(math.dist(leg.start, leg.end))
        assert leg.length <= LEG
        assert ground.seen_at(leg.start) == pytest.approx(leg.place)
    assert max(abs(tick.aside) for tick in found.ticks) <= MOST_ASIDE
    assert math.isnan(found.legs[0].swing)


def test_a_street_that_leads_into_a_ring_has_tapes_and_then_spokes() -> None:
    found, trail, _ground = laid(DANCES["street and ring"])
    (star,) = found.stars
    assert star.stake == pytest.approx((60.0, 9.0))
    assert {tick.star for tick in found.ticks} == {-1, 0}
    around = [tick for tick in found.ticks if tick.star == 0]
    assert len(around) < 2 * star.spokes, "two rounds and a half lie on one circle"
    assert {round(math.dist(tick.point, star.stake), 6) for tick in around} == {9.0}
    assert trail.high - trail.low > 2.0 * math.tau * 9.0


def test_what_turns_about_the_peg_without_a_centre_has_spokes_there_and_a_bend_has_none() -> None:
    assert laid(DANCES["bean"])[0].stars[0].stake == (0.0, 0.0)
    half = {"kind": "parts", "part": [{"kind": "arc", "radius": 8, "angle": 200}]}
    assert laid(walked(half))[0].stars == ()


def test_of_a_way_in_and_out_again_the_way_out_is_noted_and_of_a_way_in_nothing() -> None:
    found, _trail, _ground = laid(DANCES["village"])
    nearest = min(found.ticks, key=lambda tick: math.hypot(*tick.point))
    assert [tick.out for tick in found.ticks] == [tick.s > nearest.s for tick in found.ticks]
    assert not any(tick.out for tick in laid(DANCES["contest"])[0].ticks)


def test_it_is_told_which_tapes_meet_what_stands_on_the_ground() -> None:
    walk = DANCES["village"].build()
    trail = Trail.of(walk, *DANCES["village"].span(walk))
    ground = Ground((0.0, 0.0))
    standing = [
        Obstacle.venue("edge", [(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)]),
        Obstacle.circle("post", (0.3, 3.0), 0.31),
        Obstacle.circle("far post", (0.4, 3.0), 0.39),
        Obstacle.polygon("stage", [(-4.0, -1.0), (-3.0, -1.0), (-3.0, 4.0), (-4.0, 4.0)]),
        Obstacle.line("rope", [(1.0, -0.5), (1.0, 0.4), (2.0, 0.4)]),
        Obstacle.circle("pole", (0.1, 0.0), 0.2),
    ]
    found = chalk_plan(trail, 2.0, ground, None, standing)
    assert found is not None
    assert found.stars[0].spokes == 8
    assert [(one.obstacle, one.star, one.tapes) for one in found.met] == [
        (1, 0, (3,)), (3, 0, (4, 5)), (4, 0, (1,)), (5, 0, (1, 2, 3, 4, 5, 6, 7, 8)),
    ]  # fmt: skip
    street = DANCES["street"].build()
    line = Trail.of(street, *DANCES["street"].span(street))
    wall = Obstacle.line("wall", [(20.0, -1.0), (20.0, 1.0)])
    along = chalk_plan(line, 1.65, ground, None, [wall])
    assert along is not None
    assert [(one.obstacle, one.star, one.tapes) for one in along.met] == [(0, -1, (1,))]


def test_kinks_have_ticks_for_no_bend_is_known_there() -> None:
    corner = StraightLine(10.0), StraightLine(10.0, (10.0, 0.0), 1.2)
    trail = Trail(Route(corner, kinks=True), 0.0, 2.0, 20.0)
    found = chalk_plan(trail, 1.65, Ground((0.0, 0.0)))
    assert found is not None
    assert [tick.s for tick in found.ticks] == [0.0, 2.0, 10.0, 20.0]


def test_more_ticks_than_a_morning_allows_are_none() -> None:
    for turns, many in ((60, False), (190, True)):
        wound = Route((Spiral(0.1, math.tau * (turns + 5), math.tau * 5),))
        trail = Trail(wound, 0.0, 1.0, wound.length)
        found = chalk_plan(trail, 1.65, Ground((0.0, 0.0)), 0.05)
        assert (found is None) == many
    vast = Route((StraightLine(1e6),))
    assert chalk_plan(Trail(vast, 0.0, 1.0, 1e6), 1.65, Ground((0.0, 0.0))) is None


def test_a_line_that_may_hardly_stray_is_refused_in_a_sentence() -> None:
    trail = Trail(Route((StraightLine(10.0),)), 0.0, 1.0, 10.0)
    with pytest.raises(InputError, match=r"at least 0\.05 m between ticks, not 0\.01 m"):
        chalk_plan(trail, 1.65, Ground((0.0, 0.0)), 0.01)
