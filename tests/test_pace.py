"""The greatest constant head speed, and a pace that slows down only where it must."""

import math

import numpy as np
import pytest

from benchdragon import Dragon, InputError, Route, SpeedProfile, Spiral, Walk, greatest_speed
from benchdragon.check import check
from benchdragon.pace import greatest_head_speed, slowed, with_pace
from benchdragon.plan import Plan, checked, read_plan
from benchdragon.speeds import QUANTITIES, ceilings, greatest_of

# model.md's and tests/truth/contest.json's figures, from two programs with 40 digits.
RATIO, TIME, HEAD_SPEED = 1.604793378966638, 14.4799695977, 1.246266358157487


def turn(*settings: str) -> Plan:
    return read_plan("turn", settings)


def smooth(**limits: float) -> Plan:
    parts = [
        {"kind": "line", "length": 30.0},
        {"kind": "clothoid", "length": 5.0, "end_curvature": 0.35},
        {"kind": "clothoid", "length": 5.0, "start_curvature": 0.35},
        {"kind": "line", "length": 40.0},
    ]
    data = {"schema": 1, "dragon": {"benches": 8}, "route": {"part": parts}, "limits": limits}
    return checked(data, "smooth")


def test_the_turns_greatest_head_speed_is_the_truth() -> None:
    found = greatest_head_speed(turn(), tolerance=1e-12)
    assert found.value == pytest.approx(HEAD_SPEED, abs=1e-12)
    assert found.lower <= HEAD_SPEED <= found.upper
    assert found.upper - found.lower < 3e-12
    assert found.witness is not None
    assert found.witness.time == pytest.approx(TIME, abs=1e-6)
    assert found.witness.benches[0] in range(3, 9)
    assert "2 m/s" in found.assumptions[0]


def test_the_limit_that_decides_is_named() -> None:
    both = greatest_head_speed(turn("limits.turning_rate=30"))
    assert "0.523599 rad/s" in both.assumptions[0]
    peak = greatest_of(turn().build(), QUANTITIES["turning_rate"], 100.0, 130.0, tolerance=1e-6)
    assert both.value == pytest.approx(math.radians(30.0) / peak.value, rel=1e-5)


@pytest.mark.parametrize("name", QUANTITIES)
def test_peaks_on_a_smooth_route_hold_against_sampling(name: str) -> None:
    walk = smooth(speed=2.0).build()
    quantity = QUANTITIES[name]
    peak = greatest_of(walk, quantity, 20.0, 79.0, tolerance=1e-6)
    assert peak.upper <= peak.value * (1.0 + 2e-6)
    motion = walk.motion(np.linspace(20.0, 79.0, 20_001))
    if name == "speed":
        values = motion.speed_ratio
    elif name == "turning_rate":
        values = np.abs(motion.turning_rate)
    else:
        bend = walk.route.curvature(motion.s)
        values = np.hypot(motion.acceleration, motion.speed**2 * bend)
    seen = float(values.max())
    assert seen <= peak.upper
    assert seen == pytest.approx(peak.value, rel=1e-5)


def test_limits_of_acceleration_go_with_the_square_of_speed() -> None:
    quantity = QUANTITIES["acceleration"]
    plan = smooth(acceleration=0.5)
    found = greatest_head_speed(plan, tolerance=1e-6)
    walk = plan.build()
    first, last = walk.head_position(plan.span(walk)).tolist()
    peak = greatest_of(walk, quantity, first, last, tolerance=1e-6)
    assert found.value**2 * peak.value == pytest.approx(0.5, rel=1e-5)


def test_ceilings_are_not_exceeded_and_tight() -> None:
    walk = turn("dragon.benches=30").build()
    at, bounds = ceilings(walk, QUANTITIES["speed"], 95.0, 130.0)
    assert len(at) == len(bounds) + 1
    fine = np.linspace(95.0, 130.0, 5001)
    ratio = np.asarray(walk.motion(fine - walk.start).speed_ratio).max(axis=1)
    cell = np.clip(np.searchsorted(at, fine, side="right") - 1, 0, len(bounds) - 1)
    assert (ratio <= bounds[cell]).all()
    assert (bounds.max() / ratio.max() - 1.0) < 2e-3


def test_a_pace_keeps_the_limit_saves_time_and_is_a_plan() -> None:
    plan = turn("walk.speed=1.5", "dragon.benches=60")
    pace = slowed(plan)
    assert min(pace.profile.speeds) == pytest.approx(HEAD_SPEED, rel=2e-3)
    assert max(pace.profile.speeds) == 1.5
    assert pace.saved > 5.0
    walked = checked(with_pace(plan, pace).model_dump(mode="json", by_alias=True), "paced")
    walk = walked.build()
    assert float(walk.head_position([0.0])[0]) == pytest.approx(walk.start, abs=1e-9)
    start, end = walked.span(walk)
    assert end - start == pytest.approx(pace.seconds, abs=1e-6)
    slopes = np.diff(pace.profile.speeds) / np.diff(pace.profile.times)
    assert np.abs(slopes).max() <= plan.limits.head_acceleration * (1.0 + 1e-9)
    report = check(walked)
    assert report.safe
    assert 1.99 < report.greatest_speed.value <= 2.0


def test_a_slow_walk_is_left_alone() -> None:
    pace = slowed(turn("walk.speed=1.2", "dragon.benches=20"))
    assert set(pace.profile.speeds) == {1.2}
    assert pace.saved == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("settings", "text"),
    [
        (["limits.acceleration=1"], "limits.acceleration"),
        (["walk.profile=[[0, 1], [10, 2]]"], "walk.profile"),
    ],
)
def test_what_a_pace_cannot_do_is_refused(settings: list[str], text: str) -> None:
    with pytest.raises(InputError, match=text):
        slowed(turn(*settings))


def test_a_plan_without_limits_has_no_greatest_speed() -> None:
    with pytest.raises(InputError, match=r"limits\.speed"):
        greatest_head_speed(read_plan("spiral-in"))


def test_what_a_route_never_asks_for_has_no_limit() -> None:
    data = {"schema": 1, "dragon": {"benches": 6}, "limits": {"acceleration": 1.0}}
    data["route"] = {"part": [{"kind": "line", "length": 40.0}]}
    found = greatest_head_speed(checked(data, "straight"))
    assert found.status == "unlimited"
    assert found.looks < 10_000


def test_a_head_that_stands_before_its_walk_is_not_taken_for_one_that_runs() -> None:
    profile = SpeedProfile((-19.4, -10.0, 7.0), (0.0, 0.32, 2.72))
    route = Route((Spiral(0.55, 24.0 * math.pi, 0.0),))
    for start in (-40.0, -19.4, -15.0):
        found = greatest_speed(Walk(Dragon.uniform(10), route, profile, 20.0), start, -10.0)
        assert found.value == pytest.approx(0.32, rel=1e-6)
