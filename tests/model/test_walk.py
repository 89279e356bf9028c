"""A dragon on a route: against the reference values, and what may be asked of it."""

import hashlib
import json
import math
from pathlib import Path

import mpmath as mp
import numpy as np
import numpy.typing as npt
import pytest

from benchdragon import (
    Arc,
    Dragon,
    InputError,
    Line,
    Motion,
    Route,
    SpeedProfile,
    Spiral,
    Status,
    TwoArcTurn,
    Walk,
    WalkError,
)
from benchdragon.hosts.serving import PLAIN, serving
from benchdragon.kernels.curve import RouteRow
from benchdragon.model.walk import MOST_PLACES, SLICE_PLACES
from benchdragon.plans.schema import read_plan

TRUTH = json.loads((Path(__file__).parents[1] / "truth" / "contest.json").read_text(encoding="utf-8"))
TABLES = (
    "x", "y", "s", "speed_ratio", "speed", "acceleration", "heading", "turning_rate", "status",
    "failed_bench", "head_s",
)  # fmt: skip

COILING = Walk(Dragon.uniform(), Route((Spiral(0.55, 32.0 * math.pi, 4.0),)))
TURN = TwoArcTurn(1.7).route()
TURNING = Walk(Dragon.uniform(), TURN, start=float(TURN.joints[1]))
UNEVEN = SpeedProfile((-20.0, 10.0, 30.0, 40.0), (1.5, 0.5, 0.0, 2.0))
UNEVEN_TURNING = Walk(Dragon.uniform(30), TURN, UNEVEN, float(TURN.joints[1]))


def differences(motion: Motion, truth: dict[str, list[str]], row: int) -> list[float]:
    """Of x, y and speed from the reference values, one row of the motion."""
    found = (motion.x, motion.y, motion.speed)
    return [
        abs(float(table[row, int(handle)]) - float(value))
        for handle, values in truth.items()
        for table, value in zip(found, values, strict=True)
    ]


@pytest.mark.parametrize(
    ("walk", "part"), [(COILING, "spiral_in_055"), (TURNING, "two_arc_motion")], ids=["coil", "turn"]
)
def test_both_parts_of_the_contest_meet_the_reference_values(walk: Walk, part: str) -> None:
    truth = TRUTH[part]
    motion = walk.motion([float(t) for t in truth])
    for row, values in enumerate(truth.values()):
        assert len(values) == 7
        assert max(differences(motion, values, row)) <= 1e-11
    assert motion.chord_error <= 1e-12


def test_the_dragon_of_the_first_contact_meets_the_reference_values() -> None:
    motion = COILING.motion(float(TRUTH["first_contact_s"]))
    assert max(differences(motion, TRUTH["at_first_contact"], 0)) <= 1e-11


def test_the_greatest_ratio_is_met_where_the_reference_has_it() -> None:
    at = float(TRUTH["greatest_ratio_at_s"])
    motion = TURNING.motion([at - 1e-4, at, at + 1e-4])
    greatest = motion.speed_ratio.max(axis=1)
    assert greatest[1] == pytest.approx(float(TRUTH["greatest_ratio"]), abs=1e-12)
    assert greatest[1] > max(greatest[0], greatest[2])
    wanted = [float(value) for value in TRUTH["ratios_there"]]
    np.testing.assert_allclose(motion.speed_ratio[1, : len(wanted)], wanted, rtol=0.0, atol=1e-12)


def test_chords_keep_their_links_through_the_whole_turn() -> None:
    motion = TURNING.motion(np.linspace(-100.0, 400.0, 501))
    assert motion.chord_error <= 1e-12
    chords = np.hypot(np.diff(motion.x, axis=1), np.diff(motion.y, axis=1))
    np.testing.assert_allclose(chords, np.tile(TURNING.dragon.links, (501, 1)), rtol=0.0, atol=1e-12)


def test_every_handle_stands_on_the_route_at_its_position() -> None:
    motion = TURNING.motion(np.linspace(-50.0, 100.0, 31))
    points = TURN.point(motion.s)
    np.testing.assert_allclose(points[..., 0], motion.x, rtol=0.0, atol=2e-12)
    np.testing.assert_allclose(points[..., 1], motion.y, rtol=0.0, atol=2e-12)
    np.testing.assert_allclose(motion.s[:, 0], motion.head_s, rtol=0.0, atol=1e-12)


def test_tables_have_one_row_a_time_and_one_column_a_handle_or_bench() -> None:
    motion = UNEVEN_TURNING.motion([0.0, 5.0, 7.0])
    for name in ("x", "y", "s", "speed_ratio", "speed", "acceleration"):
        assert getattr(motion, name).shape == (3, 31), name
    for name in ("heading", "turning_rate"):
        assert getattr(motion, name).shape == (3, 30), name
    for name in ("status", "failed_bench", "head_s", "head_speed", "times"):
        assert getattr(motion, name).shape == (3,), name
    assert repr(motion) == "<Motion of 31 handles at 3 times>"
    assert (motion.status == Status.OK).all()
    assert (motion.failed_bench == 0).all()


def test_one_number_is_a_list_of_one_time_and_no_time_is_none() -> None:
    assert UNEVEN_TURNING.motion(3.0).x.shape == (1, 31)
    nothing = UNEVEN_TURNING.motion([])
    assert nothing.x.shape == nothing.acceleration.shape == (0, 31)
    assert nothing.chord_error == 0.0
    nothing.check()


def test_the_head_walks_the_distance_of_its_profile() -> None:
    times = np.array([-30.0, 0.0, 12.0, 30.0, 35.0, 60.0])
    motion = UNEVEN_TURNING.motion(times)
    np.testing.assert_array_equal(motion.head_s, UNEVEN_TURNING.start + UNEVEN.distance(times))
    np.testing.assert_array_equal(motion.head_speed, UNEVEN.speed(times))
    np.testing.assert_array_equal(motion.speed[:, 0], UNEVEN.speed(times))
    np.testing.assert_array_equal(motion.acceleration[:, 0], UNEVEN.acceleration(times))


def test_a_stop_stops_every_bench() -> None:
    motion = UNEVEN_TURNING.motion([30.0])
    assert (motion.speed == 0.0).all()
    assert (motion.turning_rate == 0.0).all()
    assert (motion.speed_ratio > 0.0).all()


def test_on_a_circle_every_handle_is_pulled_to_the_head_s_speed() -> None:
    walk = Walk(Dragon.uniform(6), Route((Arc(5.0, 9.0),)), UNEVEN, 30.0)
    motion = walk.motion([0.0, 8.0])
    np.testing.assert_allclose(motion.speed_ratio, 1.0, rtol=1e-14)
    turning = np.tile(motion.head_speed / 5.0, (6, 1))
    np.testing.assert_allclose(motion.turning_rate.T, turning, rtol=1e-13)
    rates = UNEVEN.acceleration([0.0, 8.0])
    np.testing.assert_allclose(motion.acceleration.T, np.tile(rates, (7, 1)), rtol=0.0, atol=1e-13)


def test_speeds_accelerations_and_turning_rates_are_derivatives_over_time() -> None:
    # Times at which no handle is about to cross a joint, nor the head a knot.
    h, times = 1e-3, np.array([-10.0, 3.1, 20.3, 35.9])
    motions = [UNEVEN_TURNING.motion(times + i * h) for i in (-2, -1, 0, 1, 2)]
    parts = [np.searchsorted(TURN.joints, motion.s) for motion in motions]
    assert all((part == parts[0]).all() for part in parts)

    def slope(name: str) -> npt.NDArray[np.float64]:
        a, b, _, d, e = (getattr(motion, name) for motion in motions)
        near, far = d - b, e - a
        if name == "heading":
            near, far = (np.remainder(v + math.pi, 2.0 * math.pi) - math.pi for v in (near, far))
        return np.asarray((8.0 * near - far) / (12.0 * h))

    for name, rate in (("s", "speed"), ("speed", "acceleration"), ("heading", "turning_rate")):
        wanted = getattr(motions[2], rate)
        np.testing.assert_allclose(slope(name), wanted, rtol=0.0, atol=1e-8, err_msg=rate)


@pytest.mark.parametrize("walk", [COILING, TURNING, UNEVEN_TURNING], ids=["coil", "turn", "uneven"])
def test_results_do_not_depend_on_the_number_of_workers(walk: Walk) -> None:
    times = np.linspace(-30.0, 50.0, 300)
    alone = walk.motion(times, workers=1)
    for workers in (2, 3, 4):
        together = walk.motion(times, workers=workers)
        for name in TABLES:
            a, b = getattr(alone, name), getattr(together, name)
            np.testing.assert_array_equal(a, b, err_msg=name)


# Of x, y, speed of every handle at seven times. Six decimals: no value is so near to the middle between
# two of them that another machine's sines could round it the other way.
RECORDED = {
    "spiral-in": "e5274c666a33607c1186fd52739051b0610c32ced32c78f7b8b9875d240a0705",
    "turn": "6efa0e13bdee3588c22377a7c7e4d484159e3790de3212f296e14b443731b6be",
}


@pytest.mark.parametrize("name", RECORDED)
def test_a_built_in_dance_is_the_recorded_one_with_any_number_of_workers(name: str) -> None:
    plan = read_plan(name)
    walk = plan.build()
    few = serving().name == PLAIN  # which takes a second for ten times
    times = np.linspace(*plan.span(walk), 7 if few else 301)
    motions = [walk.motion(times, workers=workers) for workers in ((1, 2) if few else (1, 2, 4))]
    for table in TABLES:
        assert len({getattr(motion, table).tobytes() for motion in motions}) == 1, table
    seven = slice(None, None, len(times) // 6)
    some = np.stack([motions[0].x[seven], motions[0].y[seven], motions[0].speed[seven]])
    assert some.shape == (3, 7, 224)
    rounded = np.round(some * 1e6)
    assert np.abs(np.abs(some * 1e6 - rounded) - 0.5).min() > 1e-5
    assert hashlib.sha256(rounded.astype("<i8").tobytes()).hexdigest() == RECORDED[name]


def test_failures_do_not_depend_on_the_number_of_workers() -> None:
    walk = Walk(Dragon.uniform(20), Route.joined([Arc(30.0, 2.0), Line(50.0)]), start=20.0)
    times = np.linspace(-30.0, 100.0, 300)
    alone, together = (walk.motion(times, throw=False, workers=n) for n in (1, 4))
    assert set(alone.status.tolist()) == {
        Status.OK, Status.BEFORE_ROUTE, Status.AFTER_ROUTE, Status.ROUTE_TOO_SHORT,
    }  # fmt: skip
    for name in TABLES:
        np.testing.assert_array_equal(getattr(alone, name), getattr(together, name), err_msg=name)


@pytest.mark.parametrize("walk", [COILING, TURNING], ids=["coil", "turn"])
def test_times_in_any_order_give_what_each_gives_alone(walk: Walk) -> None:
    times = np.random.default_rng(3).permutation(np.linspace(-60.0, 120.0, 130))
    motion = walk.motion(times)
    np.testing.assert_array_equal(motion.times, times)
    for i in range(0, 130, 9):
        alone = walk.motion(times[i])
        for name in ("x", "y", "s", "speed", "acceleration", "turning_rate"):
            one, among = getattr(alone, name)[0], getattr(motion, name)[i]
            np.testing.assert_allclose(one, among, rtol=0.0, atol=1e-11, err_msg=name)


def test_slices_of_time_add_up_to_the_motion() -> None:
    walk = Walk(Dragon.uniform(999), COILING.route)
    times = np.random.default_rng(4).uniform(-100.0, 400.0, 2300)
    slices = list(walk.motions(times))
    assert len(slices) > 2
    assert max(part.x.size for part in slices) <= SLICE_PLACES
    whole = walk.motion(times)
    for name in ("times", "x", "y", "s", "speed"):
        joined = np.concatenate([getattr(part, name) for part in slices])
        np.testing.assert_array_equal(joined, getattr(whole, name), err_msg=name)


def test_no_times_make_no_slices() -> None:
    assert list(COILING.motions([])) == []


def test_slices_raise_and_keep_quiet_as_the_motion_does() -> None:
    walk = Walk(Dragon.uniform(3), Route((Line(9.0),)))
    with pytest.raises(WalkError):
        list(walk.motions([1.0, 20.0]))
    [part] = walk.motions([1.0, 20.0], throw=False)
    assert part.status.tolist() == [Status.OK, Status.AFTER_ROUTE]


@pytest.mark.skipif(serving().name == PLAIN, reason="too many places for plain Python")
@pytest.mark.parametrize("benches", [100_000, 800_000])
def test_slices_of_a_very_long_dragon_stay_within_their_memory(benches: int) -> None:
    walk = Walk(Dragon.of_sizes(np.full(benches, 2.2)), Route((Line(100.0),)))
    part = next(walk.motions(np.linspace(0.0, 10.0, 64)))
    assert part.x.size <= SLICE_PLACES


@pytest.mark.skipif(serving().name == PLAIN, reason="too many places for plain Python")
def test_a_million_benches_keep_their_chords_and_their_places() -> None:
    links = np.random.default_rng(5).uniform(0.4, 3.0, 1_000_000)
    dragon = Dragon.of_sizes(links + 0.55)
    walk = Walk(dragon, Route((Spiral(0.55, 200.0, 4.0),)), start=1000.0)
    motion = walk.motion(0.0)
    assert motion.chord_error <= 1e-12
    assert (np.diff(motion.s) < 0.0).all()
    # Positions are kept as angles, of which neighbours lie 1e-9 m apart at the tail.
    points = walk.route.point(motion.s[0, ::997])
    off = np.hypot(points[:, 0] - motion.x[0, ::997], points[:, 1] - motion.y[0, ::997])
    assert off.max() <= 4e-9


def test_thousands_of_links_add_up_without_loss() -> None:
    # The angles of plain doubles would be off by some 1e-10 m at the last of these handles.
    link, count, first = 1.65, 20_000, 200.0
    walk = Walk(Dragon.of_sizes(np.full(count, link + 0.55)), Route((Spiral(0.55, first, 4.0),)))
    motion = walk.motion(0.0)
    with mp.workdps(30):
        k = mp.mpf(walk.route.rows[0, RouteRow.P])
        chord2 = (mp.mpf(walk.dragon.links[0]) / k) ** 2
        a, h = mp.mpf(first), mp.mpf(link) / (k * first)
        for _ in range(count):
            b = a + h
            for _step in range(2):
                cosine, sine = mp.cos_sin(b - a)
                excess = a * a + b * b - 2 * a * b * cosine - chord2
                b -= excess / (2 * b - 2 * a * cosine + 2 * a * b * sine)
            a, h = b, b - a
        last = k * a * mp.expj(a)
    off = abs(complex(motion.x[0, -1], motion.y[0, -1]) - complex(last))
    assert off <= 1e-11


RING = Route((Arc(30.0, 2.0),))
FAILURES = {
    # walk, time, status, bench, s of its front handle
    "before": (Walk(Dragon.uniform(5), RING, start=20.0), -21.0, Status.BEFORE_ROUTE, 0, -1.0),
    "after": (Walk(Dragon.uniform(5), RING, start=20.0), 41.0, Status.AFTER_ROUTE, 0, 61.0),
    "short": (Walk(Dragon.uniform(5), RING, start=20.0), -14.5, Status.ROUTE_TOO_SHORT, 3, None),
    "folded": (
        Walk(
            Dragon.uniform(5),
            Route((Line(20.0), Line(20.0, (20.0, 0.0), 2.8)), kinks=True),
            start=19.0,
        ),
        4.0, Status.FOLDED, 2, None,
    ),
    "diameter": (
        Walk(
            Dragon.uniform(5, head_length=0.85),
            Route.joined([Line(20.0), Arc(0.6, 9.0)]),
            start=20.0,
        ),
        2.1, Status.LINK_OVER_DIAMETER, 2, None,
    ),
}  # fmt: skip
each_failure = pytest.mark.parametrize("name", FAILURES)


@each_failure
def test_a_dragon_that_cannot_stand_raises_what_befell_which_bench_where_and_when(name: str) -> None:
    walk, t, status, bench, s = FAILURES[name]
    with pytest.raises(WalkError) as caught:
        walk.motion(t)
    error = caught.value
    assert (error.status, error.bench, error.t) == (status, bench, t)
    sound = walk.motion(t, throw=False)
    wanted = s if s is not None else sound.s[0, bench - 1]
    assert error.s == pytest.approx(wanted, abs=1e-12)
    assert f"t = {t:g} s" in str(error)
    assert f"s = {wanted:.6g} m" in str(error)
    if bench:
        assert f"bench {bench} " in str(error)
        assert f"{walk.dragon.links[bench - 1]:.6g} m" in str(error)


@each_failure
def test_without_throwing_the_sound_part_of_the_dragon_is_kept(name: str) -> None:
    walk, t, status, bench, _s = FAILURES[name]
    motion = walk.motion(t, throw=False)
    assert motion.status.tolist() == [status]
    assert motion.failed_bench.tolist() == [bench]
    for table in ("x", "y", "s", "speed_ratio", "speed", "acceleration"):
        values = getattr(motion, table)[0]
        assert np.isfinite(values[:bench]).all(), table
        assert np.isnan(values[bench:]).all(), table
    for table in ("heading", "turning_rate"):
        values = getattr(motion, table)[0]
        assert np.isfinite(values[: max(bench - 1, 0)]).all(), table
        assert np.isnan(values[max(bench - 1, 0) :]).all(), table
    assert motion.chord_error <= 1e-12
    error = motion.failure(0)
    assert (error.status, error.bench, error.t) == (status, bench, t)


def test_the_first_failing_time_in_the_list_is_raised() -> None:
    walk = FAILURES["before"][0]
    times = [0.0, 5.0, 41.0, -21.0]
    with pytest.raises(WalkError) as caught:
        walk.motion(times)
    assert caught.value.t == 41.0
    motion = walk.motion(times, throw=False)
    assert motion.status.tolist() == [Status.OK, Status.OK, Status.AFTER_ROUTE, Status.BEFORE_ROUTE]
    assert np.isfinite(motion.x[:2]).all()
    with pytest.raises(WalkError) as again:
        motion.check()
    assert again.value.t == 41.0
    assert motion.failure(3).status == Status.BEFORE_ROUTE


def test_a_dragon_may_stand_near_the_origin_at_the_end_of_a_long_line() -> None:
    for length in (10.0, 100.0, 1000.0):
        walk = Walk(Dragon.uniform(30), Route((Line(length, (-length, 0.0)),)), start=length - 0.03)
        motion = walk.motion(np.linspace(-5.0, 0.0, 20), throw=False)
        assert (motion.status == Status.OK).all()
        np.testing.assert_allclose(motion.speed, 1.0, rtol=1e-12)


def test_a_dragon_with_sizes_of_its_own_keeps_every_link() -> None:
    links = np.random.default_rng(6).uniform(0.3, 3.0, 25)
    walk = Walk(Dragon.of_sizes(links + 0.55), TURN, start=float(TURN.joints[1]))
    motion = walk.motion(np.linspace(-20.0, 60.0, 41))
    chords = np.hypot(np.diff(motion.x, axis=1), np.diff(motion.y, axis=1))
    np.testing.assert_allclose(chords, np.tile(walk.dragon.links, (41, 1)), rtol=0.0, atol=1e-12)


@pytest.mark.parametrize(
    ("times", "wanted"),
    [
        (math.nan, r"^times must be finite, not nan s$"),
        ([0.0, math.inf], r"^times must be finite, not inf s$"),
        ([0.0, -math.inf, math.nan], r"^times must be finite, not -inf s$"),
        (None, r"^times must be "),
        ([[0.0, 1.0], [2.0, 3.0]], r"^times must be one list, not a table of shape \(2, 2\)$"),
        (np.zeros((1, 1, 1)), r"^times must be one list, not a table of shape \(1, 1, 1\)$"),
        ([[0.0], [1.0, 2.0]], r"^times must be numbers, not "),
        ("soon", r"^times must be numbers, not 'soon'$"),
        (["now", "then"], r"^times must be numbers, not \['now', 'then'\]$"),
        ({"t": 1.0}, r"^times must be numbers, not \{'t': 1.0\}$"),
    ],
)
def test_times_that_cannot_be_are_refused(times: float, wanted: str) -> None:
    with pytest.raises(InputError, match=wanted):
        COILING.motion(times)
    with pytest.raises(InputError, match=wanted):
        list(COILING.motions(times))
    with pytest.raises(InputError, match=wanted):
        COILING.head_position(times)


def test_more_places_than_memory_holds_are_refused() -> None:
    times = np.zeros(MOST_PLACES // 224 + 1)
    wanted = rf"^{times.size * 224} .* than one motion may hold \({MOST_PLACES}\)$"
    with pytest.raises(InputError, match=wanted):
        COILING.motion(times)


@pytest.mark.parametrize("start", [math.nan, math.inf, "here"])
def test_a_start_that_cannot_be_is_refused(start: float) -> None:
    with pytest.raises(InputError, match=r"^start must be (finite|a number), not "):
        Walk(Dragon.uniform(), TURN, start=start)


@pytest.mark.parametrize("workers", [0, -2])
@pytest.mark.parametrize("count", [3, 300])
def test_fewer_than_one_worker_is_refused(workers: int, count: int) -> None:
    with pytest.raises(InputError):
        UNEVEN_TURNING.motion(np.linspace(0.0, 1.0, count), workers=workers)


def test_a_dataset_holds_the_tables_with_their_units() -> None:
    pytest.importorskip("xarray")
    motion = UNEVEN_TURNING.motion([0.0, 5.0])
    data = motion.to_xarray()
    assert dict(data.sizes) == {"time": 2, "handle": 31, "bench": 30}
    for name in ("x", "y", "s", "speed", "acceleration", "heading", "turning_rate", "status"):
        np.testing.assert_array_equal(data[name].values, getattr(motion, name))
        assert data[name].attrs["units"]
        assert data[name].attrs["long_name"]
    assert data["time"].values.tolist() == [0.0, 5.0]
    assert data["handle"].values.tolist() == list(range(31))
    assert data["bench"].values.tolist() == list(range(1, 31))
