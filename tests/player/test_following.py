"""Long dances: how handles follow the one before, what is sent of that, and where it cannot be told."""

import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from benchdragon import Dragon, InputError, Line, Route, SpeedProfile, Walk
from benchdragon.cli.main import run
from benchdragon.kernels import following as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.frames import QUANTUM
from benchdragon.model.curves import Arc
from benchdragon.plans.schema import read_plan
from benchdragon.player import following as door
from benchdragon.player import messages, scene
from benchdragon.player.following import Following, following
from benchdragon.player.frames import SHARES
from benchdragon.player.page import player_page
from benchdragon.player.scene import Span, plain_dance
from tests.player.test_frames import EXAMPLES, HASTY, MIXED, decoded, positions, unpacked

ERROR = 1e-3


def walk_of(plan: str, *settings: str) -> tuple[Walk, float, float]:
    """A walk and its span, s."""
    read = read_plan(plan, settings)
    walk = read.build()
    return walk, *read.span(walk)


@cache
def long_dance() -> tuple[Walk, messages.Dance]:
    """The turn with a thousand benches."""
    walk, start, end = walk_of("turn", "dragon.benches=1000")
    return walk, plain_dance(walk, Span(start, end))


def behind(tables: kernel.Tables, kind: int, s: FloatArray) -> FloatArray:
    """Where the handles behind those at s stand, by a table of a kind: as `kernel.behind` says."""
    rows = tables.stretches[tables.ends[kind - 1] if kind else 0 : tables.ends[kind]]
    start, step, first, count = rows[np.maximum(np.searchsorted(rows[:, 0], s, side="right") - 1, 0)].T
    k = np.minimum((s - start) // step, count - 2.0)
    (a, b), (ra, rb) = (
        row[np.add((first + k).astype(int), [[0], [1]])] * kernel.FINE for row in tables.nodes
    )
    f = (s - start) / step - k
    way = (1 + 2 * f) * (1 - f) ** 2 * a + f * f * (3 - 2 * f) * b
    return np.asarray(
        s - tables.links[kind] - way - step * (f * (1 - f) ** 2 * ra - f * f * (1 - f) * rb)
    )


def off(walk: Walk, found: Following, times: FloatArray) -> float:
    """How far any handle is off at these times, m."""
    exact, along = walk.motion(times).s.T, (times - found.head.start) / found.head.step
    k = np.minimum(along.astype(int), found.head.count - 2)
    pairs = zip(k.tolist(), along - k, strict=True)
    here = np.array([positions(found.head, share)[0, n] for n, share in pairs])
    worst = float(np.abs(here - exact[0]).max())
    for kind, s in zip(found.tables.kinds.tolist(), exact[1:], strict=True):
        here = behind(found.tables, kind, here)
        worst = max(worst, float(np.abs(here - s).max()))
    return worst


def sent_place(table: messages.FollowTable, s: float) -> float:
    """Where the handle behind one at s stands: written from the description of the format."""
    numbers = memoryview(unpacked(table.packed)).cast("i")
    nodes, first = len(numbers) // 2, 0
    for stretch in table.stretches:
        if s <= stretch.start + stretch.step * (stretch.nodes - 1) + 1e-9:
            break
        first += stretch.nodes
    k = min(max(int((s - stretch.start) / stretch.step), 0), stretch.nodes - 2)
    f = (s - stretch.start) / stretch.step - k
    w0, w1, r0, r1 = (table.fine * numbers[first + k + n] for n in (0, 1, nodes, nodes + 1))
    way = (1 + 2 * f) * (1 - f) ** 2 * w0 + f * f * (3 - 2 * f) * w1
    way += stretch.step * (f * (1 - f) ** 2 * r0 - f * f * (1 - f) * r1)
    return s - table.link - way


def test_a_thousand_benches_are_a_small_page_that_is_right_to_a_tenth_of_a_millimetre() -> None:
    walk, dance = long_dance()
    assert dance.following is not None
    assert len(player_page(dance, "en")) < 400_000
    assert dance.frames.largest_error < 2e-4
    _speeds, (places,) = decoded(dance.frames.packed, 1, dance.frames.count, dance.frames.step)
    for k in (0, dance.frames.count // 2, dance.frames.count - 1):
        motion = walk.motion([dance.frames.start + k * dance.frames.step])
        s = places[k] * QUANTUM
        for kind, exact in zip(dance.following.kinds[:40], motion.s[0, 1:41], strict=True):
            s = sent_place(dance.following.tables[kind], s)
            assert s == pytest.approx(exact, abs=dance.frames.largest_error)


def test_what_is_told_of_a_long_dance_is_what_comes_out() -> None:
    walk, dance = long_dance()
    told = dance.following
    assert told is not None
    for bench in (1, 2, 500, 1000):
        speed = walk.motion([told.when[bench - 1]]).speed[0, bench - 1]
        assert told.fastest[bench - 1] == pytest.approx(speed, abs=2e-3)
    assert told.speeds == pytest.approx((0.5404, 1.6044), abs=1e-3)
    joints = [occasion for occasion in dance.occasions if occasion.kind == "joint"]
    assert len(joints) == 5  # the tail stands at the last when the dance ends
    for occasion, handle in zip(joints, [0, 0, 0, -1, -1], strict=True):
        s = walk.motion([occasion.time]).s[0, handle]
        assert np.abs(walk.route.joints - s).min() < 0.05


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_the_stated_error_holds_wherever_else_one_looks(path: Path) -> None:
    walk, start, end = walk_of(str(path))
    found = following(walk, start, end, ERROR, SHARES)
    if found is None:
        pytest.skip("its benches follow one another in no one way")
    times = np.sort(np.random.default_rng(11).uniform(start, end, 60))
    assert found.head.error <= ERROR
    assert off(walk, found, times) <= 1.05 * found.head.error


def test_a_head_that_changes_its_speed_is_followed_past_joints() -> None:
    walk = Walk(Dragon.uniform(12), MIXED, HASTY, start=40.0)
    found = following(walk, -5.0, 60.0, ERROR, SHARES)
    assert found is not None
    assert off(walk, found, np.linspace(-5.0, 60.0, 331)) <= 1.05 * found.head.error
    speeds = walk.motion(found.times).speed
    np.testing.assert_allclose(found.fastest, speeds.max(axis=0)[:-1], rtol=0.0, atol=1e-5)
    assert found.speeds == pytest.approx((speeds.min(), speeds.max()), abs=1e-5)
    np.testing.assert_allclose(found.ends, walk.motion(found.times).s.T[[0, -1]], rtol=0.0, atol=1e-4)


def test_few_benches_follow_round_a_bend() -> None:
    walk = Walk(Dragon.uniform(3, 2.2), Route.joined([Line(9.0), Arc(2.2, 2.0)]), start=8.0)
    found = following(walk, 0.0, 3.0, ERROR, (0.5,), compared=60)
    assert found is not None
    assert off(walk, found, np.linspace(0.0, 3.0, 20)) <= 1.05 * found.head.error
    np.testing.assert_allclose(found.ends[1], walk.motion(found.times).s[:, -1], rtol=0.0, atol=1e-4)
    moved = found.tables._replace(nodes=found.tables.nodes + np.array([[500_000], [0]]))
    assert door._compared(walk, found.head, moved, 60) == pytest.approx(3 * 5e-4, abs=1e-4)


def test_benches_of_many_kinds_and_benches_that_leap_are_left_to_frames() -> None:
    links = np.linspace(1.5, 2.5, door.MOST_KINDS + 1)
    many = Walk(Dragon.of_sizes(links + 0.55, 0.3, 0.275, 0.275), Route((Line(60.0),)), start=30.0)
    assert following(many, 0.0, 20.0, ERROR, SHARES) is None
    few = Walk(many.dragon.first(door.MOST_KINDS), many.route, start=30.0)
    assert following(few, 0.0, 20.0, ERROR, SHARES) is not None
    bends = Arc(0.7, math.radians(170.0)), Arc(0.7, math.radians(-340.0)), Arc(0.7, math.radians(170.0))
    winding = Route.joined([Line(30.0), *bends, Line(30.0)])
    leaping = Walk(Dragon.uniform(1, head_length=2.75), winding, start=25.0)
    assert following(leaping, 7.6, 8.9, ERROR, SHARES) is None
    coil, start, _end = walk_of("spiral-in", "dragon.benches=5")
    assert following(coil, start, 442.0, ERROR, SHARES) is None


def test_a_walk_too_far_is_refused_and_a_head_that_jerks_is_left_to_frames() -> None:
    line = Walk(Dragon.uniform(1), Route((Line(1e6),)))
    with pytest.raises(InputError, match="shows 200000 m of a route"):
        following(line, 2.4e5, 2.5e5, ERROR, SHARES)
    jerks = SpeedProfile((0.0, 1.0, 1.001, 2.0), (0.0, 0.0, 50.0, 50.0))
    jerking = Walk(Dragon.uniform(2), Route((Line(600.0),)), jerks, start=50.0)
    assert following(jerking, 0.0, 2.0, 1e-4, SHARES) is None


def test_dances_beyond_a_border_are_long(monkeypatch: pytest.MonkeyPatch) -> None:
    walk, _start, _end = walk_of("turn", "dragon.benches=20")
    assert not scene.is_long(walk, Span(0.0, 100.0))
    assert plain_dance(walk, Span(0.0, 10.0)).following is None
    monkeypatch.setattr(scene, "LONG", 100)
    dance = plain_dance(walk, Span(0.0, 10.0))
    assert dance.following is not None
    assert len(dance.following.kinds) == 20
    assert dance.frames.largest_error <= ERROR


@pytest.mark.parametrize("most", [100, 100_000])
def test_the_page_of_a_long_dance_is_told_how_handles_follow(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, most: int
) -> None:
    monkeypatch.setattr(scene, "LONG", most)
    path = tmp_path / "dance.html"
    settings = ["--set", "dragon.benches=12", "--set", "walk.start=-5", "--set", "walk.end=5"]
    assert run(["view", "turn", *settings, "-o", str(path), "--quiet"]) == 0
    assert ('"following":null' in path.read_text("utf-8")) == (most > 100)
