"""Greatest speeds, accelerations, turning rates: against dense sampling, and by the coarse bound."""

import json
import math
from collections.abc import Iterator

import numpy as np
import numpy.typing as npt
import pytest

from benchdragon import Arc, Clothoid, Dragon, Line, Route, SpeedProfile, Spiral, Walk, WalkError
from benchdragon.analysis import speed
from benchdragon.analysis.speed import QUANTITIES, Quantity, greatest, greatest_speed
from benchdragon.kernels.speed_memory import SpeedGiven
from benchdragon.model.answer import Answer
from benchdragon.model.curves import AnyCurve
from benchdragon.plans.schema import read_plan

PLANS = {
    "coil": ["spiral-in", "disc.radius=6", "dragon.benches=120"],
    "turn": ["turn", "dragon.benches=60"],
    "three arcs": ["turn", "dragon.benches=60", "turn.family=arc-arc-arc", "turn.curvature=0.1"],
    "alike": ["turn", "dragon.benches=40", "dragon.head_length=2.2"],
    "far out": ["spiral-in", "route.start_turn=40", "disc.radius=20", "dragon.benches=60"],
    "eased": ["turn", "dragon.benches=60", "turn.ease=0.3"],
}
UNEVEN = Dragon.of_sizes(np.repeat([3.0, 2.2, 1.4, 2.6], [1, 30, 30, 1]), 0.3, 0.2, 0.2)


def walk_of(name: str) -> tuple[Walk, float, float]:
    """A walk, and its start and end, s."""
    source, *settings = PLANS["turn" if name == "uneven" else name]
    plan = read_plan(source, settings)
    walk = plan.build()
    span = plan.span(walk)
    return Walk(UNEVEN, walk.route, walk.profile, walk.start) if name == "uneven" else walk, *span


def with_room(patch: pytest.MonkeyPatch, **numbers: float) -> None:
    """Let the engine go by other numbers: see kernels/speed_memory.py."""
    room = list(speed.ROOM)
    for name, value in numbers.items():
        room[getattr(SpeedGiven, name) - SpeedGiven.MOST_CELLS] = value
    patch.setattr(speed, "ROOM", tuple(room))


def without_coarse_bound(walk: Walk, start: float, end: float, tolerance: float) -> Answer:
    with pytest.MonkeyPatch.context() as patch:
        with_room(patch, CELL_COST=math.inf)
        return greatest_speed(walk, start, end, tolerance=tolerance)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-9])
@pytest.mark.parametrize("name", [*PLANS, "uneven"])
def test_the_coarse_bound_changes_no_answer(name: str, tolerance: float) -> None:
    walk, start, end = walk_of(name)
    found, plain = (
        way(walk, start, end, tolerance=tolerance) for way in (greatest_speed, without_coarse_bound)
    )
    assert found.upper <= found.lower * (1.0 + 1.01 * tolerance)
    assert max(found.lower, plain.lower) <= min(found.upper, plain.upper)
    assert found.evaluations < plain.evaluations
    assert found.witness is not None
    assert found.witness.time is not None
    motion = walk.motion([found.witness.time])
    assert motion.speed.max() == pytest.approx(found.value, rel=1e-9)


def test_a_way_searched_in_windows_gives_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    walk, start, end = walk_of("turn")
    whole = {
        name: greatest(walk, kind, start, end, tolerance=1e-4) for name, kind in QUANTITIES.items()
    }
    with_room(monkeypatch, MOST_CELLS=1)  # windows of a dragon's length
    for name, kind in QUANTITIES.items():
        found = greatest(walk, kind, start, end, tolerance=1e-4)
        assert max(found.lower, whole[name].lower) <= min(found.upper, whole[name].upper)
        assert found.upper <= found.lower * (1.0 + 1.1e-4)


def test_where_too_much_waits_the_bracket_stays_wide_and_sound(monkeypatch: pytest.MonkeyPatch) -> None:
    walk = Walk(Dragon.uniform(5), Route((Arc(6.0, 10.0),)), start=20.0)
    fine = greatest(walk, QUANTITIES["total_acceleration"], 0.0, 35.0, tolerance=1e-4)
    with_room(monkeypatch, MOST_OPEN=0, FIRST_OPEN=20)
    wide = greatest(walk, QUANTITIES["total_acceleration"], 0.0, 35.0, tolerance=1e-12)
    assert wide.lower <= fine.upper
    assert fine.lower <= wide.upper < math.inf
    assert wide.upper > wide.lower * (1.0 + 1e-12)


def test_progress_only_grows_and_ends_at_one(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[float] = []
    with_room(monkeypatch, BUDGET=1_000)
    walk, start, end = walk_of("turn")
    greatest(
        walk, QUANTITIES["total_acceleration"], start, end, tolerance=1e-9,
        progress=lambda share, _text: told.append(share),
    )  # fmt: skip
    assert len(told) > 5
    assert told == sorted(told)
    assert 0.0 <= told[0] < told[-2] <= told[-1] == 1.0


def test_the_coarse_bound_heeds_a_head_whose_speed_changes() -> None:
    walk, _start, _end = walk_of("turn")
    profile = SpeedProfile((-60.0, 0.0, 20.0, 30.0, 60.0), (0.0, 1.0, 0.4, 1.9, 0.3))
    changing = Walk(walk.dragon, walk.route, profile, walk.start)
    found = greatest_speed(changing, -60.0, 90.0, tolerance=1e-6)
    plain = without_coarse_bound(changing, -60.0, 90.0, 1e-6)
    assert found.value == pytest.approx(plain.value, rel=1e-6)
    assert found.upper <= found.lower * (1.0 + 1e-5)
    sampled = changing.motion(np.linspace(-60.0, 90.0, 20_001)).speed.max()
    assert sampled <= found.upper


def test_a_walk_that_falls_says_so_through_the_coarse_bound() -> None:
    walk = read_plan("spiral-in", ["dragon.benches=60"]).build()
    with pytest.raises(WalkError):
        greatest_speed(walk, 0.0, walk.route.length + 5.0)


def test_short_walks_of_uneven_dragons_need_no_coarse_bound() -> None:
    walk, _start, _end = walk_of("coil")
    lengths = np.random.default_rng(2).uniform(2.0, 2.4, len(walk.dragon))
    uneven = Walk(Dragon.of_sizes(lengths, 0.3, 0.2, 0.2), walk.route, walk.profile, walk.start)
    for tried, way, pays in ((walk, 200.0, True), (walk, 1.0, False), (uneven, 200.0, False)):
        found = greatest_speed(tried, 0.0, way, tolerance=1e-6)
        plain = without_coarse_bound(tried, 0.0, way, 1e-6)
        assert (found.evaluations < plain.evaluations) == pays


Float = npt.NDArray[np.float64]
Knots = list[tuple[float, float]]
# Just before and just after, s.
BESIDE = 1e-8

JOINTS: list[AnyCurve] = [
    Line(20.0),
    Arc(2.5, 1.2),
    Line(3.0),
    Arc(4.0, -2.0),
    Clothoid(4.0, -0.25, 0.3),
    Line(20.0),
]
# Plans, and heads that start and stop: some stand for a while, some jump from slowing down to starting.
STARTS_AND_STOPS: dict[str, tuple[list[str], Knots]] = {
    "coil": (
        ["spiral-in", "dragon.benches=40", "disc.radius=6", "walk.end=60"],
        [(0, 0), (4, 1.2), (20, 1.2), (23, 0), (30, 0), (30.5, 0.9), (60, 0.2)],
    ),
    "turn": (
        ["turn", "dragon.benches=15", "walk.start=-22", "walk.end=40"],
        [(-20, 0), (-17, 1.1), (3, 1.1), (5, 0), (9, 0), (11, 1.3), (30, 0.7), (33, 0.7)],
    ),
    "eased": (
        ["turn", "dragon.benches=15", "turn.ease=1", "walk.start=-8", "walk.end=30"],
        [(-5, 0.4), (4, 1.3), (12, 0), (14, 1)],
    ),
    "joints": ([], [(2, 0.5), (9, 1.5), (13, 0), (16, 0), (18, 1.2), (40, 1.2)]),
}


def starting_and_stopping(name: str) -> tuple[Walk, float, float]:
    """A walk whose head starts and stops, and its start and end, s."""
    settings, knots = STARTS_AND_STOPS[name]
    if settings:
        source, *sizes = settings
        plan = read_plan(source, [*sizes, f"walk.profile={json.dumps(knots)}"])
        walk = plan.build()
        return walk, *plan.span(walk)
    times, speeds_ = zip(*knots, strict=True)
    dragon = Dragon.of_sizes(np.array([2.6, *[1.9] * 5]), 0.3, 0.2, 0.2)
    return Walk(dragon, Route.joined(JOINTS), SpeedProfile(times, speeds_), 14.0), 0.0, 26.0


def sampled(walk: Walk, name: str, times: Float) -> Float:
    """A quantity's size at these times, of the handle or bench that has most of it."""
    motion = walk.motion(times)
    along, speeds = motion.acceleration, motion.speed
    across = walk.route.curvature(motion.s) * speeds**2
    values = {
        "speed": speeds,
        "turning_rate": motion.turning_rate,
        "lateral_acceleration": across,
        "total_acceleration": np.hypot(along, across),
        "acceleration": along,
    }[name]
    return np.asarray(np.abs(values).max(axis=1))


def most_sampled(walk: Walk, name: str, start: float, end: float, count: int = 4000) -> float:
    """The most that dense sampling sees, also beside every knot, and ever nearer the best."""
    knots = np.array([t for t in walk.profile.times if start < t < end])
    times = np.concatenate([np.linspace(start, end, count), knots - BESIDE, knots + BESIDE])
    times = np.sort(np.clip(times, start, end))
    most = 0.0
    for _zoom in range(5):
        values = sampled(walk, name, times)
        best = int(np.argmax(values))
        most = max(most, float(values[best]))
        times = np.linspace(times[max(best - 1, 0)], times[min(best + 1, len(times) - 1)], 40)
    return most


@pytest.mark.parametrize("quantity", QUANTITIES.values(), ids=QUANTITIES)
@pytest.mark.parametrize("name", STARTS_AND_STOPS)
def test_what_starts_and_stops_ask_for_is_what_sampling_sees(name: str, quantity: Quantity) -> None:
    walk, start, end = starting_and_stopping(name)
    found = greatest(walk, quantity, start, end, tolerance=1e-5)
    seen = most_sampled(walk, quantity.name, start, end)
    assert found.value * (1.0 - 1e-11) <= found.lower <= found.value
    assert found.value <= found.upper <= found.value * (1.0 + 1.1e-5)
    assert seen <= found.upper * (1.0 + 1e-9)
    assert found.value <= seen * (1.0 + 1e-4)
    assert found.unit == quantity.unit
    assert found.evaluations > 0
    near = found.witness
    assert near is not None
    assert near.time is not None
    assert walk.head_position([near.time]) == pytest.approx([near.s], abs=1e-9)
    beside = np.clip(near.time + np.array([-BESIDE, 0.0, BESIDE]), start, end)
    assert sampled(walk, quantity.name, beside).max() == pytest.approx(found.value, rel=1e-5)


def random_walk(rng: np.random.Generator) -> tuple[Walk, float, float]:
    """Some benches on some curves, the head starting, stopping and standing as chance will."""
    links = rng.uniform(0.5, 2.5, rng.integers(1, 9))
    widest = float(links.max())
    bends = rng.uniform(0.05, 0.7, 4) / widest * rng.choice([-1.0, 1.0], 4)
    middle: list[AnyCurve] = [
        Arc(1.0 / abs(bends[0]), float(np.sign(bends[0]) * rng.uniform(0.2, 2.0))),
        Line(rng.uniform(0.5, 5.0)),
        Clothoid(rng.uniform(1.0, 6.0), float(bends[1]), float(bends[2])),
        Arc(1.0 / abs(bends[3]), float(np.sign(bends[3]) * rng.uniform(0.2, 2.0))),
        Spiral.between(rng.uniform(0.5, 2.0), 9.0, rng.uniform(3.0, 8.0) + widest),
    ]
    parts = [
        Line(float(links.sum()) + 0.5),
        *(middle[i] for i in rng.permutation(5)[: rng.integers(1, 5)]),
    ]
    route = Route.joined([*parts, Line(20.0)])
    first = float(links.sum()) + 0.1
    times = np.cumsum(rng.uniform(0.05, 6.0, rng.integers(1, 9)))
    speeds_ = rng.choice([0.0, 1.0], len(times), p=[0.3, 0.7]) * rng.uniform(0.05, 2.0, len(times))
    profile = SpeedProfile(tuple(times), tuple(speeds_))
    walk = Walk(Dragon.of_sizes(links, 0.2, 0.0, 0.0), route, profile, first)
    end = float(times[-1] + 5.0)
    while walk.head_position([end])[0] > route.length or walk.motion([end], throw=False).status.any():
        end *= 0.8
    return walk, 0.0, end


def random_walks(count: int, seed: int) -> Iterator[tuple[Walk, float, float]]:
    """So many of them that can be walked."""
    rng = np.random.default_rng(seed)
    while count:
        walk, start, end = random_walk(rng)
        if walk.motion(np.linspace(start, end, 500), throw=False).status.any():
            continue
        count -= 1
        yield walk, start, end


def seen_at(walk: Walk, quantity: Quantity, found: Answer, span: tuple[float, float]) -> float:
    """The most that is seen at the witness of an answer, and just beside it; 0 without one."""
    near = found.witness
    if near is None or near.time is None:
        return 0.0
    beside = np.clip(near.time + np.array([-BESIDE, 0.0, BESIDE]), *span)
    return float(sampled(walk, quantity.name, beside).max())


@pytest.mark.parametrize("seed", range(4))
def test_random_starts_and_stops_exceed_no_bound(seed: int) -> None:
    for walk, start, end in random_walks(30, seed):
        for quantity in QUANTITIES.values():
            found = greatest(walk, quantity, start, end, tolerance=1e-3)
            seen = most_sampled(walk, quantity.name, start, end, 1000)
            assert seen <= found.upper * (1.0 + 1e-9) + 1e-9
            assert (
                found.value <= max(seen, seen_at(walk, quantity, found, (start, end))) * 1.00001 + 1e-9
            )
            assert found.upper <= found.value * (1.0 + 1.1e-3) + 1e-9


@pytest.mark.parametrize("name", QUANTITIES)
def test_a_limit_is_decided_by_as_narrow_a_bracket_as_that_takes(name: str) -> None:
    walk, start, end = starting_and_stopping("turn")
    fine = greatest(walk, QUANTITIES[name], start, end, tolerance=1e-8)
    for share in (1e-7, 1e-3, 1.0, 1e3):
        limit = fine.upper * (1.0 + share)
        kept = greatest(walk, QUANTITIES[name], start, end, tolerance=1e-6, limit=limit)
        assert fine.lower * (1.0 - 2e-2) - 0.01 * limit <= kept.lower <= fine.upper
        assert fine.lower <= kept.upper <= limit
        limit = fine.lower * (1.0 - share / (1.0 + share))
        broken = greatest(walk, QUANTITIES[name], start, end, tolerance=1e-6, limit=limit)
        assert broken.lower > limit
        assert broken.lower == pytest.approx(fine.lower, rel=2e-6)


def test_a_head_that_only_stands_asks_for_nothing() -> None:
    walk, _start, _end = starting_and_stopping("turn")
    for quantity in QUANTITIES.values():
        found = greatest(walk, quantity, 6.0, 8.0)
        assert (found.value, found.upper) == (0.0, 0.0)


def test_a_jolt_too_short_to_walk_a_nanometre_counts() -> None:
    profile = SpeedProfile((0.0, 1.0, 1.0 + 1e-12, 5.0), (0.0, 0.0, 1e-6, 1e-6))
    walk = Walk(Dragon.uniform(3), Route((Line(40.0),)), profile, 20.0)
    found = greatest(walk, QUANTITIES["acceleration"], 0.0, 5.0)
    assert found.value == pytest.approx(1e6, rel=1e-3)
    assert found.witness is not None
    assert found.witness.time == pytest.approx(1.0)


def test_a_kink_asks_for_more_than_any_bound() -> None:
    route = Route((Line(30.0), Line(30.0, (30.0, 0.0), 0.3)), kinks=True)
    walk = Walk(Dragon.uniform(3), route, start=20.0)
    for name in ("acceleration", "total_acceleration"):
        assert greatest(walk, QUANTITIES[name], 0.0, 30.0, tolerance=1e-2).upper == math.inf


def test_a_walk_that_ends_while_the_head_speeds_up_counts_to_its_end() -> None:
    route = Route.joined([Line(20.0), Arc(4.0, 6.0)])
    walk = Walk(Dragon.uniform(2), route, SpeedProfile((0.0, 10.0), (0.0, 2.0)), 24.0)
    assert greatest(walk, QUANTITIES["speed"], 0.0, 5.0).value == pytest.approx(1.0, rel=1e-12)
    across = greatest(walk, QUANTITIES["lateral_acceleration"], 0.0, 5.0)
    assert across.value == pytest.approx(0.25, rel=1e-12)
    assert across.witness is not None
    assert across.witness.time == pytest.approx(5.0)
