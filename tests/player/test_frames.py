"""Frames of a dance: how far off between them, what is sent of them, and where they end."""

import base64
import itertools
import math
import zlib
from functools import cache
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from benchdragon import Dragon, InputError, Line, Route, SpeedProfile, Spiral, Walk, WalkError
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.drawn_route import STRETCH_ERROR
from benchdragon.kernels.following import LONGEST
from benchdragon.kernels.frames import QUANTUM
from benchdragon.model.curves import Arc
from benchdragon.plans.schema import read_plan
from benchdragon.player import frames as door
from benchdragon.player.frames import (
    BEFORE,
    CLOSE,
    SHARES,
    STEPS,
    Course,
    Frames,
    course,
    frames,
    packed_bytes,
    packed_frames,
)

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.dragon.toml"))
ERROR = 1e-3
# A head that stands, hurries and slows down, on a route of a line, an arc and a spiral.
HASTY = SpeedProfile((0.0, 8.0, 9.0, 30.0, 50.0), (0.0, 1.8, 1.8, 0.3, 1.0))
MIXED = Route.joined([Line(60.0), Arc(7.0, 2.0), Spiral.between(1.7, 20.0, 12.0)])
WALKS = {
    "spiral-in": ("spiral-in", (), 0.0, 425.0),
    "into the disc": ("spiral-in", ("disc.radius=4.5",), 0.0, 320.0),
    "turn": ("turn", ("dragon.benches=60",), -40.0, 120.0),
    **{path.stem: (str(path), (), None, None) for path in EXAMPLES},
}


@cache
def walk_of(name: str) -> tuple[Walk, float, float]:
    """A walk and the times that are looked at."""
    source, settings, start, end = WALKS[name]
    plan = read_plan(source, settings)
    walk = plan.build()
    first, last = plan.span(walk)
    return walk, first if start is None else start, last if end is None else end


@cache
def shot(name: str) -> Frames:
    """Frames of a walk."""
    return frames(*walk_of(name), ERROR)


def exact(walk: Walk, times: FloatArray) -> FloatArray:
    """Route positions, m, (handles, times)."""
    return np.concatenate([motion.s.T for motion in walk.motions(times)], axis=1)


def between(s: FloatArray, rise: FloatArray, share: float | FloatArray) -> FloatArray:
    """Cubics through values s with slopes `rise` a frame, at a share of each step."""
    f, a, b = share, s[:, :-1], s[:, 1:]
    into = (1 + 2 * f) * (1 - f) ** 2 * a + f * f * (3 - 2 * f) * b
    return np.asarray(into + f * (1 - f) ** 2 * rise[:, :-1] - f * f * (1 - f) * rise[:, 1:])


def positions(found: Frames, share: float) -> FloatArray:
    """Route positions so far (0..1) between each frame and the next, m, (handles, frames - 1)."""
    s, rise = (np.asarray(table * QUANTUM, dtype=float) for table in (found.places, found.speeds))
    return between(s, rise * found.step, share)


def unpacked(text: str) -> bytes:
    """What `packed_bytes` packed, in its order again: written from the description of the format."""
    planes = zlib.decompress(base64.b64decode(text, validate=True), wbits=-15)
    count, rest = divmod(len(planes), 4)
    assert rest == 0
    ranks = (planes[rank * count : (rank + 1) * count] for rank in range(4))
    return bytes(itertools.chain.from_iterable(zip(*ranks, strict=True)))


def decoded(
    text: str, handles: int, count: int, step: float
) -> tuple[list[list[int]], list[list[int]]]:
    """Speeds and places in quanta, handle by handle, one number after another."""
    told = memoryview(unpacked(text)).cast("i")
    assert len(told) == 2 * handles * count
    speeds, places = [], []
    for handle in range(handles):
        mine = told[handle * count : (handle + 1) * count]
        speeds.append(list(itertools.accumulate(itertools.accumulate(mine))))
        more = told[(handles + handle) * count : (handles + handle + 1) * count]
        row = [more[0]]
        for k in range(1, count):
            walked = math.floor((speeds[-1][k - 1] + speeds[-1][k]) * (0.5 * step) + 0.5)
            row.append(row[-1] + walked + more[k])
        places.append(row)
    return speeds, places


@pytest.mark.parametrize("name", WALKS)
def test_no_place_is_farther_off_than_stated_wherever_else_one_looks(name: str) -> None:
    walk, start, end = walk_of(name)
    found = shot(name)
    assert not found.leap
    assert (found.start, found.end) == pytest.approx((start, end), abs=1e-9)
    assert found.error <= ERROR
    others = [0.06, 0.19, 0.31, 0.44, 0.56, 0.69, 0.81, 0.94]
    others += np.random.default_rng(7).uniform(0.0, 1.0, 4).tolist()
    assert not set(others) & set(SHARES)
    worst = 0.0
    before = found.start + found.step * np.arange(found.count - 1, dtype=np.float64)
    for share in others:
        off = np.abs(positions(found, share) - exact(walk, before + share * found.step))
        worst = max(worst, float(off.max()))
    # The stated error is looked for, not proved: a few hundredths more may lie between its looks.
    assert 0.0 < worst <= 1.05 * found.error


@pytest.mark.parametrize("name", ["turn", "02_eight.dragon", "05_stop_and_go.dragon"])
def test_frames_are_no_more_than_needed(name: str) -> None:
    walk, start, end = walk_of(name)
    found = shot(name)
    coarser = min(step for step in STEPS if step > 1.5 * found.step)
    count = math.ceil((end - start) / coarser - 1e-9) + 1
    times = np.linspace(start, end, count)
    s = np.rint(exact(walk, times) / QUANTUM) * QUANTUM
    step = times[1] - times[0]
    rise = np.concatenate([motion.speed.T for motion in walk.motions(times)], axis=1) * step
    middle = between(s, rise, 0.5) - exact(walk, times[:-1] + 0.5 * step)
    quarter = between(s, rise, 0.25) - exact(walk, times[:-1] + 0.25 * step)
    assert max(np.abs(middle).max(), np.abs(quarter).max()) > 0.9 * ERROR


def placed(way: Course, s: FloatArray) -> FloatArray:
    """Points at route positions s, m, (..., 2), as a page finds them."""
    starts, steps, firsts, counts = way.stretches.T
    stretch = np.clip(np.searchsorted(starts, s, side="right") - 1, 0, None)
    step = steps[stretch]
    along = (s - starts[stretch]) / step
    node = np.clip(along.astype(np.int64), 0, counts[stretch].astype(np.int64) - 2)
    f, first = along - node, firsts[stretch].astype(np.int64) + node
    x, y, heading = way.nodes.astype(np.float64)
    out = [
        base
        + p[first]
        + f * f * (3.0 - 2.0 * f) * (p[first + 1] - p[first])
        + step * f * (1.0 - f) * ((1.0 - f) * t[first] - f * t[first + 1])
        for base, p, t in zip(way.origin, (x, y), (np.cos(heading), np.sin(heading)), strict=True)
    ]
    return np.stack(out, axis=-1)


@pytest.mark.parametrize("name", WALKS)
def test_what_is_sent_puts_every_handle_within_a_millimetre_of_its_place(name: str) -> None:
    walk, start, end = walk_of(name)
    found = shot(name)
    handles = len(walk.dragon) + 1
    speeds, places = decoded(packed_frames(found), handles, found.count, found.step)
    np.testing.assert_array_equal(speeds, found.speeds)
    np.testing.assert_array_equal(places, found.places)
    low, high = np.min(places) * QUANTUM, np.max(places) * QUANTUM
    way = course(
        walk, low - min(1.0, low + walk.route.extension), high + min(1.0, walk.route.length - high)
    )
    times = np.sort(np.random.default_rng(3).uniform(start, end, 40))
    k = np.minimum(((times - start) / found.step).astype(int), found.count - 2)
    f = (times - start) / found.step - k
    s0, s1 = (np.array(places)[:, k + n] * QUANTUM for n in (0, 1))
    v0, v1 = (np.array(speeds)[:, k + n] * QUANTUM * found.step for n in (0, 1))
    hermite = (1 + 2 * f) * (1 - f) ** 2 * s0 + f * (1 - f) ** 2 * v0 + f**2 * (3 - 2 * f) * s1
    here = placed(way, hermite - f**2 * (1 - f) * v1)
    motion = walk.motion(times)
    off = np.hypot(here[..., 0] - motion.x.T, here[..., 1] - motion.y.T)
    assert off.max() <= min(1.05 * found.error + way.error, ERROR)


def test_bytes_of_one_rank_stand_together() -> None:
    numbers = np.array([1, -1, 256, 2**31 - 1], dtype="<i4")
    assert unpacked(packed_bytes(numbers)) == numbers.tobytes()
    planes = zlib.decompress(base64.b64decode(packed_bytes(numbers)), wbits=-15)
    assert planes[:4] == bytes([1, 255, 0, 255])
    nodes: npt.NDArray[np.float32] = np.array([0.5, -3.25], dtype="<f4")
    assert memoryview(unpacked(packed_bytes(nodes))).cast("f").tolist() == [0.5, -3.25]


def test_cubics_meet_their_ends_and_are_exact_for_cubics() -> None:
    t = np.array([[0.0, 1.0, 2.0, 3.0]])
    s, rise = t**3 - 2.0 * t, 3.0 * t**2 - 2.0
    for share in (0.0, 0.3, 0.5, 1.0):
        at = t[:, :-1] + share
        np.testing.assert_allclose(between(s, rise, share), at**3 - 2.0 * at, rtol=0.0, atol=1e-13)


def test_a_head_that_changes_its_speed_is_followed() -> None:
    walk = Walk(Dragon.uniform(12), MIXED, HASTY, start=40.0)
    found = frames(walk, -5.0, 60.0, ERROR)
    assert not found.leap
    times = np.linspace(found.start, found.end, 997)[:-1]
    share = (times - found.start) / found.step
    k = share.astype(int)
    table = np.array([positions(found, f)[:, n] for n, f in zip(k, share - k, strict=True)]).T
    assert np.abs(table - exact(walk, times)).max() <= 1.05 * found.error
    # Before it sets out, and at its knots, the head is exactly as fast as its profile says.
    speeds = found.speeds * QUANTUM
    frame_times = found.start + found.step * np.arange(found.count)
    np.testing.assert_allclose(speeds[0], HASTY.speed(frame_times), rtol=0.0, atol=0.6 * QUANTUM)
    standing = frame_times < 0.0
    assert np.ptp(found.places[:, standing], axis=1).max() == 0


@pytest.mark.parametrize("benches", [1, 3, 223])
def test_frames_end_before_a_bench_finds_no_place(benches: int) -> None:
    walk = read_plan("spiral-in", [f"dragon.benches={benches}"]).build()
    still = walk.motion(np.arange(420.0, 442.0, 0.01), throw=False)
    failure = float(still.times[np.flatnonzero(still.status)[0]])
    found = frames(walk, 400.0, 442.0, ERROR)
    assert found.leap
    assert failure - BEFORE - CLOSE - 0.01 <= found.end < failure
    assert exact(walk, np.linspace(found.start, found.end, 50)).shape == (benches + 1, 50)


def test_frames_end_before_a_bench_leaps() -> None:
    # Where the route winds, a bench comes to fit in nearer places, and then its rear handle leaps.
    bends = Arc(0.7, math.radians(170.0)), Arc(0.7, math.radians(-340.0)), Arc(0.7, math.radians(170.0))
    walk = Walk(
        Dragon.uniform(1, head_length=2.75), Route.joined([Line(30.0), *bends, Line(30.0)]), start=25.0
    )
    motion = walk.motion(np.arange(7.6, 8.9, 0.002))
    leaps = np.flatnonzero(np.abs(np.diff(motion.s[:, 1])) > 1.0)
    leap = float(motion.times[leaps[0]])
    for end in (8.9, 8.8, 8.7):
        found = frames(walk, 7.6, end, ERROR)
        assert found.leap
        assert leap - BEFORE - CLOSE - 0.002 <= found.end <= leap - BEFORE + 0.002
    before = frames(walk, 7.6, leap - 0.25, ERROR)
    assert not before.leap
    assert before.end == pytest.approx(leap - 0.25)


def test_limits_refuse_with_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    walk, start, end = walk_of("turn")
    with monkeypatch.context() as patch:
        patch.setattr(door, "MOST_PLACES", 5000)
        with pytest.raises(InputError, match=r"60 benches from -40 s to 120 s .* fill more than 5000"):
            frames(walk, start, end, ERROR)
    with pytest.raises(InputError, match="off by more than 1e-07 m"):
        frames(walk, 0.0, 1.0, 1e-7)
    line = Walk(Dragon.uniform(1), Route((Line(1e6),)))
    with pytest.raises(InputError, match="shows 200000 m of a route, and this walk goes to 250000 m"):
        frames(line, 2.4e5, 2.5e5, ERROR)


def test_a_walk_that_cannot_begin_is_refused() -> None:
    walk = Walk(Dragon.uniform(3), Route((Line(30.0),)))
    with pytest.raises(
        WalkError, match="at t = 40 s the head would walk past the end of the route, which is 30 m"
    ):
        frames(walk, 40.0, 50.0, ERROR)


def test_the_route_is_drawn_within_its_error_and_through_its_joints() -> None:
    walk = Walk(Dragon.uniform(3), MIXED)
    low, high = -12.0, MIXED.length
    way = course(walk, low, high)
    assert way.error <= STRETCH_ERROR
    s = np.sort(np.random.default_rng(5).uniform(low, high, 5000))
    assert np.hypot(*(placed(way, s) - MIXED.point(s)).T).max() <= 1.2 * STRETCH_ERROR
    starts, steps, _firsts, counts = way.stretches.T
    ends = starts + steps * (counts - 1)
    np.testing.assert_allclose(ends[:-1], starts[1:], rtol=0.0, atol=1e-9)
    assert (ends[-1], (ends - starts).max()) == (
        pytest.approx(high),
        pytest.approx(LONGEST, abs=1e-6),
    )
    for joint in MIXED.joints[1:-1].tolist():
        assert np.abs(starts - joint).min() == 0.0
    beside = placed(way, np.nextafter(MIXED.joints[1:-1], -np.inf))
    np.testing.assert_allclose(beside, MIXED.point(MIXED.joints[1:-1]), rtol=0.0, atol=STRETCH_ERROR)


def test_a_corner_of_the_route_stays_a_corner() -> None:
    corner = Route((Line(10.0), Line(10.0).moved((10.0, 0.0), 0.5 * math.pi)), kinks=True)
    way = course(Walk(Dragon.uniform(1), corner), 0.0, 20.0)
    corners = placed(way, np.array([5.0, 10.0, 15.0]))
    np.testing.assert_allclose(corners, [[5.0, 0.0], [10.0, 0.0], [10.0, 5.0]], rtol=0.0, atol=1e-7)
    for n in (0, 1):  # neither line is bent by the other
        line = placed(way, np.linspace(10.0 * n, 10.0 * n + 10.0, 101))
        assert np.ptp(line[1:-1, 1 - n]) < 1e-7
