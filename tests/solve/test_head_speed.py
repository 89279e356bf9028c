"""The greatest constant head speed, and a pace that slows down only where it must."""

import math

import numpy as np
import pytest

from benchdragon import (
    BenchDragonError,
    Dragon,
    InputError,
    Route,
    SpeedProfile,
    Spiral,
    Walk,
    budget,
    greatest_speed,
)
from benchdragon.analysis.chalk import chalk_plan
from benchdragon.analysis.chalk_line import Trail
from benchdragon.analysis.check import check
from benchdragon.analysis.ground import Ground
from benchdragon.analysis.speed import QUANTITIES, greatest_of
from benchdragon.analysis.stops import stops_of
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.solve import head_speed as module
from benchdragon.solve.head_speed import greatest_head_speed, slowed, with_head_speed, with_pace

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
    assert found.value == found.lower <= HEAD_SPEED <= found.upper
    assert found.value == pytest.approx(HEAD_SPEED, abs=3e-12)
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
    across = walk.route.curvature(motion.s) * motion.speed**2
    values = {
        "speed": motion.speed_ratio,
        "turning_rate": motion.turning_rate,
        "lateral_acceleration": across,
        "total_acceleration": np.hypot(motion.acceleration, across),
        "acceleration": motion.acceleration,
    }[name]
    seen = float(np.abs(values).max())
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


def test_a_pace_keeps_the_limit_saves_time_and_is_a_plan() -> None:
    plan = turn("walk.speed=1.5", "dragon.benches=60")
    pace = slowed(plan)
    assert min(pace.profile.speeds) == pytest.approx(HEAD_SPEED, rel=2e-3)
    assert max(pace.profile.speeds) == 1.5
    assert pace.saved > 5.0
    walked = checked(with_pace(plan, pace).data(), "paced")
    walk = walked.build()
    assert float(walk.head_position([0.0])[0]) == pytest.approx(walk.start, abs=1e-9)
    start, end = walked.span(walk)
    assert end - start == pytest.approx(pace.seconds, abs=1e-6)
    slopes = np.diff(pace.profile.speeds) / np.diff(pace.profile.times)
    assert np.abs(slopes).max() <= plan.limits.head_acceleration * (1.0 + 1e-9)
    report = check(walked)
    assert report.safe
    assert 1.99 < report.greatest_speed.value <= 2.0


PARTS = [
    {"kind": "line", "length": 25.0},
    {"kind": "arc", "radius": 2.5, "angle": 100.0},
    {"kind": "line", "length": 3.0},
    {"kind": "clothoid", "length": 4.0, "end_curvature": -0.4},
    {"kind": "arc", "radius": 2.5, "angle": -60.0},
    {"kind": "line", "length": 30.0},
]
ALL = {
    "speed": 1.6, "acceleration": 0.4, "lateral_acceleration": 0.45, "total_acceleration": 0.5,
    "turning_rate": 25.0, "head_acceleration": 0.3,
}  # fmt: skip
PACED: dict[str, tuple[str, list[str]]] = {
    "turn": ("turn", ["dragon.benches=15"]),
    "eased": ("turn", ["dragon.benches=15", "turn.ease=1"]),
    "line between": ("turn", ["dragon.benches=15", "turn.family=arc-line-arc"]),
    "coil": ("spiral-in", ["dragon.benches=30", "disc.radius=3", "route.pitch=0.8"]),
    "parts": ("parts", []),
}


def pacing_plan(name: str, limits: dict[str, float]) -> Plan:
    source, settings = PACED[name]
    if source == "parts":
        data = {"schema": 1, "dragon": {"benches": 6}, "route": {"part": PARTS}, "limits": limits}
        return checked({**data, "walk": {"speed": 1.9, "position": 16.0}}, "parts")
    said = [f"limits.{key}={value}" for key, value in limits.items()]
    return read_plan(source, ["walk.speed=1.9", *settings, *said])


# Every plan with each limit, but for what hardly occurs there: a coil speeds nobody up.
ASKED = [
    (name, limit) for name in PACED for limit in QUANTITIES if (name, limit) != ("coil", "acceleration")
]


@pytest.mark.parametrize(("name", "limit"), [*ASKED, *((name, "all") for name in PACED)])
def test_a_paced_plan_keeps_every_limit_and_is_faster(name: str, limit: str) -> None:
    limits = ALL if limit == "all" else {key: ALL[key] for key in (limit, "head_acceleration")}
    plan = pacing_plan(name, limits)
    pace = slowed(plan)
    assert pace.saved >= 0.0
    paced = checked(with_pace(plan, pace).data(), "paced")
    report = check(paced)
    codes = {finding.kind for finding in report.findings}
    assert codes <= {"contact"}  # the way, not its pace, may bring benches together
    walk = paced.build()
    start, end = paced.span(walk)
    assert end - start == pytest.approx(pace.seconds)
    motion = walk.motion(np.linspace(start, end, 4001))
    across = np.abs(walk.route.curvature(motion.s)) * motion.speed**2
    total = np.hypot(motion.acceleration, across)
    seen = {
        "speed": motion.speed.max(),
        "acceleration": np.abs(motion.acceleration).max(),
        "lateral_acceleration": across.max(),
        "total_acceleration": total.max(),
        "turning_rate": math.degrees(np.abs(motion.turning_rate).max()),
        "head_acceleration": np.abs(walk.profile.acceleration(motion.times)).max(),
    }
    shares = {key: seen[key] / allowed for key, allowed in limits.items()}
    assert max(shares.values()) <= 1.0
    assert max(shares.values()) > 0.95  # it slows down no more than it must


@pytest.mark.parametrize(("name", "limit"), ASKED)
def test_the_greatest_head_speed_is_never_above_what_sampling_allows(name: str, limit: str) -> None:
    plan = pacing_plan(name, {limit: ALL[limit]})
    found = greatest_head_speed(plan)
    assert found.value == found.lower <= found.upper <= found.lower * (1.0 + 2e-6)
    for share, safe in ((1.0, True), (1.0 + 3e-6, False)):
        walked = plan.with_value("walk.speed", found.value * share)
        codes = {finding.kind for finding in check(walked).findings}
        assert (codes <= {"contact"}) is safe
    even = plan.with_value("walk.speed", found.value)
    walk = even.build()
    motion = walk.motion(np.linspace(*even.span(walk), 20_001))
    across = np.abs(walk.route.curvature(motion.s)) * motion.speed**2
    values = {
        "speed": motion.speed,
        "acceleration": motion.acceleration,
        "lateral_acceleration": across,
        "total_acceleration": np.hypot(motion.acceleration, across),
        "turning_rate": np.degrees(motion.turning_rate),
    }[limit]
    assert np.abs(values).max() <= ALL[limit] * (1.0 + 1e-12)


def test_of_several_limits_the_tightest_decides() -> None:
    alone = {key: greatest_head_speed(pacing_plan("turn", {key: ALL[key]})) for key in QUANTITIES}
    both = greatest_head_speed(pacing_plan("turn", ALL))
    least = min(alone, key=lambda key: alone[key].value)
    assert both.value == pytest.approx(alone[least].value, rel=2e-6)
    assert both.assumptions == alone[least].assumptions


def test_where_slowing_down_gains_nothing_the_pace_is_even(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "FINER", 1)  # loose bounds hold up the head at joints
    plan = turn("walk.speed=1.5", "dragon.benches=60", "limits.acceleration=0.3", "turn.ease=1")
    pace = slowed(plan)
    assert set(pace.profile.speeds) == {pace.steady.value}
    assert pace.saved == 0.0


def test_a_slow_walk_is_left_alone() -> None:
    pace = slowed(turn("walk.speed=1.2", "dragon.benches=20"))
    assert set(pace.profile.speeds) == {1.2}
    assert pace.saved == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("settings", "text"),
    [
        (["walk.profile=[[0, 1], [10, 2]]"], "walk.profile"),
        (["limits.lateral_acceleration=5e-324"], "expected at least 1e-06, not 5e-324"),
    ],
)
def test_what_a_pace_cannot_do_is_refused(settings: list[str], text: str) -> None:
    with pytest.raises(BenchDragonError, match=text):
        slowed(turn("dragon.benches=5", *settings))


def test_a_plan_without_limits_has_no_greatest_speed() -> None:
    with pytest.raises(InputError, match=r"limits\.speed"):
        greatest_head_speed(read_plan("spiral-in"))


def test_a_limit_that_nothing_bounds_leaves_the_speed_undecided(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    limits = ["limits.turning_rate=30", "limits.total_acceleration=0.4"]
    monkeypatch.setenv(budget.VARIABLE, "0.002")  # the bracket of the first stays open
    found = greatest_head_speed(turn(*limits))
    assert (found.status, found.lower) == ("undecided", 0.0)
    assert math.isnan(found.value)
    assert found.upper == pytest.approx(HEAD_SPEED)


def test_what_a_route_never_asks_for_has_no_limit() -> None:
    data = {"schema": 1, "dragon": {"benches": 6}, "limits": {"acceleration": 1.0}}
    data["route"] = {"part": [{"kind": "line", "length": 40.0}]}
    found = greatest_head_speed(checked(data, "straight"))
    assert found.status == "unlimited"
    assert found.evaluations < 10_000


def test_a_head_that_stands_before_its_walk_is_not_taken_for_one_that_runs() -> None:
    profile = SpeedProfile((-19.4, -10.0, 7.0), (0.0, 0.32, 2.72))
    route = Route((Spiral(0.55, 24.0 * math.pi, 0.0),))
    for start in (-40.0, -19.4, -15.0):
        found = greatest_speed(Walk(Dragon.uniform(10), route, profile, 20.0), start, -10.0)
        assert found.value == pytest.approx(0.32, rel=1e-6)


def test_a_walk_of_no_length_has_no_pace() -> None:
    with pytest.raises(InputError, match="the walk has no length"):
        slowed(read_plan("turn", ["walk.start=5", "walk.end=5"]))


@pytest.mark.parametrize(
    "settings",
    [
        ["walk.start=-96", "walk.end=157", "walk.speed=0.8"],
        ["walk.speed=0.8", 'cues.cue=[{kind="hold", head=174, hold=20}]', "walk.end=350"],
        ["walk.speed=1.3"],
    ],
)
@pytest.mark.parametrize("speed", [0.6, 1.1])
def test_the_same_dance_at_another_speed_has_its_ticks_where_they_were(
    settings: list[str], speed: float
) -> None:
    plan = read_plan("turn", settings)
    other = with_head_speed(plan, speed)
    assert other.walk.speed == speed
    marks, seconds = [], []
    for one in (plan, other):
        walk = one.build()
        span = one.span(walk)
        trail = Trail.of(walk, *span)
        chalk = chalk_plan(trail, 1.65, Ground.of(one, walk.route))
        assert chalk is not None
        marks.append(chalk.ticks)
        held = sum(stop.end - stop.start for stop in stops_of(walk, *span))
        seconds.append((trail.high - trail.start, span[1] - span[0], held))
    ticks, others = marks
    assert [one.kind for one in ticks] == [one.kind for one in others]
    assert [one.s for one in others] == pytest.approx([one.s for one in ticks], abs=1e-9)
    (way, _lasts, held), (other_way, lasts, other_held) = seconds
    assert other_way == pytest.approx(way, abs=1e-9)
    assert other_held == pytest.approx(held, abs=1e-9)
    braking = 2.0 * speed / plan.limits.head_acceleration if held else 0.0
    assert lasts == pytest.approx(way / speed + held + 0.5 * braking, abs=1e-6)


@pytest.mark.parametrize("speed", [0.3, 0.6, 1.1])
@pytest.mark.parametrize(
    ("kind", "end", "stands"), [('"hold", hold=20', 25.0, 14.0), ('"stop"', 60.0, 49.0)]
)
def test_a_head_that_stands_when_the_dance_ends_stands_as_long_at_another_speed(
    speed: float, kind: str, end: float, stands: float
) -> None:
    cue = f"cues.cue=[{{kind={kind}, head=30}}]"
    plan = read_plan("turn", ["walk.start=-20", cue, f"walk.end={end}"])
    for one in (plan, with_head_speed(plan, speed)):
        walk = one.build()
        (stop,) = stops_of(walk, *one.span(walk))
        assert stop.end - stop.start == pytest.approx(stands, abs=0.1 if one is plan else 1e-6)
        stands = stop.end - stop.start


def test_what_cannot_be_walked_at_another_speed_is_refused() -> None:
    plan = read_plan("turn", ['cues.cue=[{kind="beat", at=5}]'])
    with pytest.raises(InputError, match="write head instead"):
        with_head_speed(plan, 0.5)
    with pytest.raises(InputError, match="profile of its own"):
        with_head_speed(read_plan("turn", ["walk.profile=[[0, 1], [9, 2]]"]), 0.5)
    with pytest.raises(InputError, match="speed must be"):
        with_head_speed(read_plan("turn"), 0.0)
    with pytest.raises(InputError, match="at most 100 m/s"):
        with_head_speed(read_plan("turn"), 101.0)
