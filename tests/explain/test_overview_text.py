"""What the leader's overview says above its table, and how to come in and leave."""

import math
import re
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from benchdragon.analysis.bench_walks import BenchWalk, Tightest, bench_walks
from benchdragon.analysis.check import Report, check, kept
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.ground import Ground
from benchdragon.explain.bench_text import tightest_line
from benchdragon.explain.overview_text import OverviewText, overview_text
from benchdragon.explain.whereabouts import whereabouts
from benchdragon.i18n import spoken_in
from benchdragon.plans.people import called
from benchdragon.plans.schema import checked

COIL = {
    "schema": 1, "base": "spiral-in", "dragon": {"benches": 8},
    "route": {"pitch": 1.2, "start_turn": 4}, "walk": {"end": 12},
    "people": {"count_head": False, "unit": "qiao"},
}  # fmt: skip
TURN = {**COIL, "base": "turn", "route": {}}
ENTRANCES = [[39, 0], [-39, 29]]
SQUARE = {"venue": {"rectangle": [80, 60]}, "event": {"entrances": ENTRANCES}}


def reported(data: dict[str, object]) -> tuple[Report, tuple[BenchWalk, ...], Ground]:
    """A plan's check, what its benches do, and from where papers measure."""
    report = check(checked(data, "dance"))
    benches = bench_walks(report.plan, report.walk, (report.start, report.end))
    return report, benches, Ground.of(report.plan, report.walk.route)


def told(data: dict[str, object]) -> OverviewText:
    return overview_text(*reported(data))


@pytest.fixture(scope="module")
def coil() -> tuple[Report, tuple[BenchWalk, ...], Ground]:
    return reported(COIL)


def test_the_verdict_says_how_long_the_dance_is_and_tells_numbers_as_the_check_does(
    coil: tuple[Report, tuple[BenchWalk, ...], Ground],
) -> None:
    first, second, third = overview_text(*coil).verdict
    report = coil[0]
    assert first == "Safe for the whole dance: 12 s."
    clock = Clock("", report.start)
    assert second[1:-1] == kept(report, clock)[1:]
    assert third == clock.legend
    with spoken_in("zh"):
        assert overview_text(*coil).verdict[0] == "安全：整场 12 秒。"


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_tightest_three_of_different_benches_come_first_each_with_its_place(
    coil: tuple[Report, tuple[BenchWalk, ...], Ground], language: str
) -> None:
    report, benches, ground = coil
    gaps = {2: (0.9, 6), 6: (0.9, 2), 3: (0.7, 7), 4: (0.8, 8), 5: (0.95, 1)}
    near = {
        n: Tightest(float(n), other, "left", gap, gap, (10.0 * n, 0.0))
        for n, (gap, other) in gaps.items()
    }
    name, clock = partial(called, report.plan.people, count=8), Clock("", report.start)

    def lines() -> tuple[str, ...]:
        given = tuple(replace(one, tightest=near.get(one.bench)) for one in benches)
        return overview_text(report, given, ground).tightest

    with spoken_in(language):
        for line, bench in zip(lines(), (3, 4, 2), strict=True):
            assert tightest_line(near[bench], clock, name, its=True) in line
            assert name(bench) in line
            assert whereabouts(report.plan, ground, near[bench].place) in line
        near[4] = replace(near[4], place=(32.0, 0.0))  # 2 m from the tightest: one place to look at
        said = str(lines())
        for bench, listed in {3: True, 4: False, 2: True, 5: True}.items():
            assert (tightest_line(near[bench], clock, name, its=True) in said) == listed


def test_it_is_said_where_nobody_need_watch(coil: tuple[Report, tuple[BenchWalk, ...], Ground]) -> None:
    report, benches, ground = coil
    alone = tuple(replace(one, tightest=None) for one in benches)
    (line,) = overview_text(report, alone, ground).tightest
    assert "No bench of another coil comes within about 1.5 m of any" in line


def test_the_levels_of_room_are_told_without_keys_of_the_plan() -> None:
    people = {"sway": 0.05, "beside": 0.01, "source": {"sway": "measured"}}
    said = str(told({**COIL, "people": people}).room)
    assert "people." not in said
    assert "5 cm to each side, measured" in said
    assert "1 cm on each side of a bench, assumption" in said


@pytest.mark.parametrize("coiled", [True, False])
def test_it_is_said_where_to_come_in_and_which_edge_is_on_the_way_out(coiled: bool) -> None:
    report, benches, ground = reported({**(COIL if coiled else TURN), **SQUARE})
    text = overview_text(report, benches, ground)
    walk = report.walk
    first, last = walk.motion([report.start]), walk.motion([report.end])
    tail, head = (first.x[0, -1], first.y[0, -1]), (first.x[0, 0], first.y[0, 0])
    way = float(first.s[0, 0] - first.s[0, -1])
    for place in (tail, head):
        assert whereabouts(report.plan, ground, place) in text.coming[0]
    assert (
        f" it is {way:.0f} m: {math.ceil(way / 60.0 / report.plan.walk.speed)} min at" in text.coming[1]
    )
    away = [math.dist(tail, one) for one in ENTRANCES]
    assert (
        f"Entrance {1 + away.index(min(away))} is nearest to where the tail starts" in text.coming[-1]
    )
    assert whereabouts(report.plan, ground, (last.x[0, 0], last.y[0, 0])) in text.leaving[0]
    assert ("Pull the pins" in text.leaving[0]) == coiled
    leader = -1 if coiled else 0
    x, y = float(last.x[0, leader]), float(last.y[0, leader])
    heading = float(walk.route.heading([last.s[0, leader]])[0])
    ways = [(math.cos(heading), math.sin(heading))]
    ways = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] if coiled else ways
    sides = (
        ("right edge", 40.0, 1, 0), ("far edge", 30.0, 0, 1),
        ("left edge", 40.0, -1, 0), ("near edge", 30.0, 0, -1),
    )  # fmt: skip
    far, name = min(
        ((to - (a * x + b * y)) / (u * a + v * b), side)
        for u, v in ways
        for side, to, a, b in sides
        if u * a + v * b > 1e-9
    )
    said = (
        r"then the ([a-z ]*) of the venue: ([0-9.]+) m away"
        if coiled
        else r"([0-9.]+) m to the ([a-z ]*) of"
    )
    found = re.search(said, text.leaving[1])
    assert found is not None
    assert {name, f"{far:.1f}"} == set(found.groups())
    away = [math.dist((x, y), one) for one in ENTRANCES]
    n = away.index(min(away))
    assert text.leaving[-1].startswith(f"Entrance {n + 1} is then nearest")
    assert f": {abs(ENTRANCES[n][0] - x):.1f} m to the " in text.leaving[-1]


def test_it_is_said_what_stands_in_the_way_in_and_out() -> None:
    free, walk = told({**TURN, **SQUARE}), check(checked({**TURN, **SQUARE}, "dance")).walk
    said = str((free.coming, free.leaving))
    assert "Straight on from there it is" in said
    assert "Back along the line from where the tail starts it is" in said
    assert "in the way" not in said
    start, end = checked(TURN, "dance").span(walk)
    first, last = walk.motion([start]), walk.motion([end])
    ends = (
        (last.x[0, 0], last.y[0, 0], walk.route.heading([last.s[0, 0]])[0], "Straight on from there"),
        (
            first.x[0, -1], first.y[0, -1], walk.route.heading([first.s[0, -1]])[0] + math.pi,
            "Back along the line from where the tail starts,",
        ),
    )  # fmt: skip
    wide = float(walk.dragon.width.max())
    for x, y, heading, words in ends:
        for aside, met in ((0.0, True), (0.5 * wide + 0.29, True), (0.5 * wide + 0.31, False)):
            u, v = np.cos(heading), np.sin(heading)
            at = [float(x + 6.0 * u - (1.0 + aside) * v), float(y + 6.0 * v + (1.0 + aside) * u)]
            well = {"kind": "circle", "name": "well", "centre": at, "radius": 1.0, "margin": 0.3}
            text = told({**TURN, **SQUARE, "obstacle": [well]})
            assert (f"{words} well is in the way" in str((text.coming, text.leaving))) is met
            if met and aside == 0.0:
                far = re.search(r"well is in the way(?:,| after) ([0-9.]+) m", str(text))
                assert far is not None
                wanted = 6.0 - math.sqrt((1.3 + 0.5 * wide) ** 2 - 1.0)
                assert float(far[1]) == pytest.approx(wanted, abs=0.052)


def test_each_bench_starts_where_papers_say(coil: tuple[Report, tuple[BenchWalk, ...], Ground]) -> None:
    report, benches, ground = coil
    starts = overview_text(*coil).starts
    assert starts == tuple(whereabouts(report.plan, ground, one.place) for one in benches)
