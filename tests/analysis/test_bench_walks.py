"""What each bench does, against motions looked at a hundred times a second and against shapely."""

import math
from itertools import groupby, pairwise

import numpy as np
import pytest
from shapely import Polygon

from benchdragon.analysis.bench_walks import STEP, STILL, BenchWalk, bench_walks, beside
from benchdragon.analysis.distance import boxes
from benchdragon.kernels.bench_nearness import OTHER_COIL
from benchdragon.kernels.bench_walks import SHORTEST
from benchdragon.kernels.box import Box, corner
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.curves import Line, Route
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import checked

# A line, a bend to the left, an S of clothoids that changes its side within a part, and a stop.
PLAN = checked(
    {
        "schema": 1,
        "dragon": {"benches": 9, "head_length": 3.0},
        "route": {
            "kind": "parts",
            "part": [
                {"kind": "line", "length": 30.0},
                {"kind": "arc", "radius": 2.5, "angle": 170.0},
                {"kind": "clothoid", "length": 9.0, "start_curvature": 0.3, "end_curvature": -0.3},
                {"kind": "arc", "radius": 3.0, "angle": -150.0},
                {"kind": "line", "length": 30.0},
            ],
        },
        "walk": {
            "profile": [[0, 1.0], [18, 1.0], [20, 0.0], [24, 0.0], [26, 1.6], [60, 1.0]],
            "position": 20.0, "start": 0, "end": 52,
        },
        "people": {"hurry_from": 1.15, "run_from": 1.45},
    },
    "test",
)  # fmt: skip
GATES = (STILL, 1.15, 1.45)
FINE = 0.01


@pytest.fixture(scope="module")
def walk() -> Walk:
    return PLAN.build()


@pytest.fixture(scope="module")
def told(walk: Walk) -> tuple[BenchWalk, ...]:
    return bench_walks(PLAN, walk, PLAN.span(walk))


def test_stretches_follow_one_another_and_none_is_too_short(told: tuple[BenchWalk, ...]) -> None:
    for bench in told:
        cuts = [bench.stretches[0].start, *(one.end for one in bench.stretches)]
        assert (cuts[0], cuts[-1]) == (0.0, 52.0)
        assert cuts[1:-1] == [one.start for one in bench.stretches[1:]]
        assert min(np.diff(cuts)) >= SHORTEST
        kinds = [(one.turning, one.pace) for one in bench.stretches]
        assert all(one != after for one, after in pairwise(kinds))
    assert {one.pace for bench in told for one in bench.stretches} == {"wait", "walk", "hurry", "run"}
    assert {one.turning for bench in told for one in bench.stretches} == {"left", "right", "straight"}


def test_turnings_and_paces_are_those_that_dense_sampling_sees(
    walk: Walk, told: tuple[BenchWalk, ...]
) -> None:
    times = np.arange(0.0, 52.0, FINE)
    motion = walk.motion(times)
    for bench in told:
        k = bench.bench - 1
        side = np.sign(np.round(walk.route.curvature(motion.s[:, k]), 9))
        pace = np.searchsorted(GATES, motion.speed[:, k], side="right")
        change = np.flatnonzero((np.diff(side) != 0) | (np.diff(pace) != 0))
        seen = times[change] + 0.5 * FINE
        for one in bench.stretches[1:]:
            assert np.abs(seen - one.start).min() <= FINE, (bench.bench, one)
        for one in bench.stretches:
            inside = (times >= one.start) & (times < one.end)
            # What is shorter than can be followed is joined, and no more than that.
            wanted = {"left": 1, "right": -1, "straight": 0}[one.turning]
            step = ("wait", "walk", "hurry", "run").index(one.pace)
            here = 10.0 * side[inside] + pace[inside]
            assert _longest_off(here, 10.0 * wanted + step) * FINE <= SHORTEST + FINE


def _longest_off(kinds: FloatArray, wanted: float) -> int:
    """How many samples of one kind follow one another, of kinds that are not wanted."""
    runs = [(kind, len(list(same))) for kind, same in groupby(kinds.tolist())]
    return max((count for kind, count in runs if kind != wanted), default=0)


def test_ways_and_angles_add_up(walk: Walk, told: tuple[BenchWalk, ...]) -> None:
    ends = walk.motion([0.0, 52.0])
    assert sum(one.way for one in told[0].stretches) == pytest.approx(
        float(walk.profile.distance(52.0)), abs=1e-9
    )
    fine = walk.motion(np.arange(0.0, 52.0 + FINE, FINE).clip(max=52.0))
    for bench in told:
        k = bench.bench - 1
        ways = sum(one.way for one in bench.stretches)
        assert ways == pytest.approx(float(ends.s[1, k] - ends.s[0, k]), abs=1e-9)
        bent = walk.route.curvature(0.5 * (fine.s[1:, k] + fine.s[:-1, k]))
        turned = float(np.sum(bent * np.diff(fine.s[:, k])))
        assert sum(one.angle for one in bench.stretches) == pytest.approx(turned, abs=8e-3)
        for one in bench.stretches:
            inside = (fine.times >= one.start) & (fine.times <= one.end)
            speeds = fine.speed[inside, k]
            # Between the times looked at a speed may run on a little.
            assert one.speeds == pytest.approx((speeds.min(), speeds.max()), abs=STEP)


def test_places_headings_and_who_is_before_and_behind(walk: Walk, told: tuple[BenchWalk, ...]) -> None:
    start = walk.motion([0.0])
    for k, bench in enumerate(told):
        assert bench.place == (start.x[0, k], start.y[0, k])
        assert bench.heading == start.heading[0, k]
    assert [bench.before for bench in told] == [None, *range(1, 9)]
    assert [bench.behind for bench in told] == [*range(2, 10), None]


COIL = checked(
    {
        "schema": 1,
        "dragon": {"benches": 54, "head_length": 2.2},
        "route": {"kind": "spiral-in", "pitch": 1.5, "start_turn": 4},
        "walk": {"end": 45},
    },
    "test",
)


@pytest.fixture(scope="module")
def coiled() -> tuple[Walk, tuple[BenchWalk, ...]]:
    walk = COIL.build()
    return walk, bench_walks(COIL, walk, COIL.span(walk))


def test_the_tightest_moment_is_bracketed_and_no_one_comes_nearer(
    coiled: tuple[Walk, tuple[BenchWalk, ...]],
) -> None:
    walk, told = coiled
    motion = walk.motion(np.arange(0.0, 45.0, 0.5))
    shapes = [outlines(walk, float(t)) for t in motion.times]
    for bench in told[::4]:
        k = bench.bench - 1
        others = of_another_coil(walk, k)
        seen = min(shape[k].distance(shape[j]) for shape in shapes for j in others)
        near = bench.tightest
        assert near is not None
        assert near.bench - 1 in others
        assert near.lower <= seen + 1e-9
        assert near.upper <= seen + 2e-6
        then = outlines(walk, near.time)
        assert then[k].distance(then[near.bench - 1]) == pytest.approx(near.upper, abs=1e-6)
        assert near.upper - near.lower < 0.35


def of_another_coil(walk: Walk, k: int) -> list[int]:
    """The rows of benches that are farther than STRAIGHT from one where the dragon stands on a line."""
    line = Walk(walk.dragon, Route((Line(200.0),)))
    table = boxes(line.placement([190.0]), 0)
    shapes = [Polygon([corner(table, j, n) for n in range(4)]) for j in range(len(table))]
    return [j for j, shape in enumerate(shapes) if shape.distance(shapes[k]) > OTHER_COIL]


def outlines(walk: Walk, time: float) -> list[Polygon]:
    table = boxes(walk.motion([time]), 0)
    return [Polygon([corner(table, k, n) for n in range(4)]) for k in range(len(table))]


def test_sides_are_told_as_a_bearer_who_looks_ahead_sees_them(
    coiled: tuple[Walk, tuple[BenchWalk, ...]],
) -> None:
    walk, told = coiled
    for bench in told:
        near, k = bench.tightest, bench.bench - 1
        assert near is not None
        motion = walk.motion([near.time])
        table, heading = boxes(motion, 0), float(motion.heading[0, k])
        ahead = complex(math.cos(heading), math.sin(heading))
        apart = complex(*(table[near.bench - 1, :2] - table[k, :2])) / ahead
        if near.side in ("left", "right"):
            assert (apart.imag > 0.0) == (near.side == "left")
        else:
            assert (apart.real > 0.0) == (near.side == "front")
    # The head walks clockwise inwards: all others are on its left, and it is on their right.
    assert told[0].tightest is not None
    assert told[0].tightest.side == "left"
    assert told[0].left is not None
    assert told[0].right is None
    assert told[told[0].left - 1].right in (1, 2)


@pytest.mark.parametrize("pitch", [1.5, 0.7])
def test_the_bench_beside_is_the_one_most_abreast_of_the_nearest_coil(pitch: float) -> None:
    walk = COIL.model_copy(update={"route": COIL.route.model_copy(update={"pitch": pitch})}).build()
    placed = walk.motion([0.0])
    table, seen = boxes(placed, 0), 0
    for k, sides in enumerate(beside(placed)):
        turned = complex(*table[k, [Box.UX, Box.UY]])
        apart = (
            table[:, Box.CX] + 1j * table[:, Box.CY] - complex(*table[k, [Box.CX, Box.CY]])
        ) / turned
        for other, sign in zip(sides, (1.0, -1.0), strict=True):
            if other is None:
                continue
            mine = apart[other - 1]
            # Nobody stands between: of the next coil, not of the one after it.
            between = (np.abs(apart.real) < 0.6) & (sign * apart.imag > 0.1)
            between &= sign * apart.imag < sign * mine.imag - 0.5 * pitch
            assert sign * mine.imag > 0.0
            assert not between.any()
            coil = [j for j in (other - 2, other) if 0 <= j < len(table) and abs(j - k) > 1]
            assert all(abs(apart[j].real) >= abs(mine.real) for j in coil if sign * apart[j].imag > 0.0)
            seen += 1
    assert seen > 40


def test_what_is_known_to_be_kept_narrows_the_bracket(
    coiled: tuple[Walk, tuple[BenchWalk, ...]],
) -> None:
    walk, told = coiled
    least = min(bench.tightest.upper for bench in told if bench.tightest is not None)
    again = bench_walks(COIL, walk, COIL.span(walk), apart=least - 1e-4)
    lows = [bench.tightest.lower for bench in again if bench.tightest is not None]
    assert min(lows) == pytest.approx(least - 1e-4)


def test_nobody_near_is_said_so(walk: Walk) -> None:
    told = bench_walks(PLAN, walk, (0.0, 3.0))  # on the line, where the next but one is a bench away
    assert [bench.tightest for bench in told] == [None] * 9
    short = checked(
        {**COIL.model_dump(by_alias=True, exclude_unset=True), "dragon": {"benches": 2}}, "test"
    )
    two = short.build()
    assert [bench.tightest for bench in bench_walks(short, two, (0.0, 2.0))] == [None, None]


@pytest.mark.parametrize("per", [3, 50])
def test_slices_of_time_change_nothing(
    walk: Walk, told: tuple[BenchWalk, ...], per: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("benchdragon.analysis.bench_walks.SLICE_PLACES", per * 10)
    again = bench_walks(PLAN, walk, PLAN.span(walk))
    assert [bench.stretches for bench in again] == [bench.stretches for bench in told]


def test_the_bracket_holds_when_looked_at_seldom(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every 6 s a bench is looked at: in between others come nearer, and the bracket still holds."""
    monkeypatch.setattr("benchdragon.analysis.bench_walks.STEP", 6.0)
    monkeypatch.setattr("benchdragon.analysis.bench_walks.REACH", 30.0)
    walk = PLAN.build()
    motion = walk.motion(np.arange(0.0, 52.0, 0.25))
    shapes = [outlines(walk, float(t)) for t in motion.times]
    for bench in bench_walks(PLAN, walk, PLAN.span(walk)):
        k = bench.bench - 1
        seen = min(shape[k].distance(shape[j]) for shape in shapes for j in of_another_coil(walk, k))
        assert bench.tightest is not None
        assert bench.tightest.lower <= seen + 1e-9


def test_thresholds_that_are_met_just_when_speeds_are_looked_at_are_told_then() -> None:
    """Times of the knots and thresholds lie on the grid: neither end of a bracket is past its root."""
    plan = checked(
        {
            "schema": 1,
            "dragon": {"benches": 2},
            "route": {"kind": "parts", "part": [{"kind": "line", "length": 80}]},
            "walk": {"profile": [[0, 0], [8, 2], [16, 0], [20, 0]], "position": 20, "end": 20},
            "people": {"hurry_from": 1.0, "run_from": 1.5},
        },
        "even",
    )
    walk = plan.build()
    for bench in bench_walks(plan, walk, plan.span(walk)):
        paces = [one.pace for one in bench.stretches]
        assert paces == ["walk", "hurry", "run", "hurry", "walk", "wait"]
        starts = [one.start for one in bench.stretches]
        assert starts == pytest.approx([0.0, 4.0, 6.0, 10.0, 12.0, 15.8], abs=1e-6)


def test_what_is_tightest_while_the_head_waits_to_start_is_told_within_the_dance() -> None:
    data = {
        "schema": 1, "base": "spiral-in", "dragon": {"benches": 40},
        "route": {"pitch": 0.9, "start_turn": 5},
        "walk": {"profile": [[-11, 0], [13, 0.5]], "start": -20, "end": -10},
    }  # fmt: skip
    plan = checked(data, "test")
    found = [one.tightest for one in bench_walks(plan, plan.build(), (-20.0, -10.0)) if one.tightest]
    assert len(found) > 10
    assert all(-20.0 <= one.time <= -10.0 for one in found)
