"""Greatest speeds with and without what cells of the route say beforehand."""

import numpy as np
import pytest

from benchdragon import Dragon, SpeedProfile, Walk, WalkError, speeds
from benchdragon.answer import Answer
from benchdragon.plan import read_plan
from benchdragon.speeds import greatest_speed

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


def unsieved(walk: Walk, start: float, end: float, tolerance: float) -> Answer:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(speeds, "sieve_pays", lambda _walk, _way: False)
        return greatest_speed(walk, start, end, tolerance=tolerance)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-9])
@pytest.mark.parametrize("name", [*PLANS, "uneven"])
def test_a_sieve_changes_no_answer(name: str, tolerance: float) -> None:
    walk, start, end = walk_of(name)
    assert speeds.sieve_pays(walk, float(np.ptp(walk.head_position([start, end]))))
    found, plain = (way(walk, start, end, tolerance=tolerance) for way in (greatest_speed, unsieved))
    assert found.upper <= found.lower * (1.0 + 1.01 * tolerance)
    assert max(found.lower, plain.lower) <= min(found.upper, plain.upper)
    assert found.looks < plain.looks
    assert found.witness is not None
    assert found.witness.time is not None
    motion = walk.motion([found.witness.time])
    assert motion.speed.max() == pytest.approx(found.value, rel=1e-9)


def test_a_sieve_heeds_a_head_whose_speed_changes() -> None:
    walk, _start, _end = walk_of("turn")
    profile = SpeedProfile((-60.0, 0.0, 20.0, 30.0, 60.0), (0.0, 1.0, 0.4, 1.9, 0.3))
    changing = Walk(walk.dragon, walk.route, profile, walk.start)
    found = greatest_speed(changing, -60.0, 90.0, tolerance=1e-6)
    plain = unsieved(changing, -60.0, 90.0, 1e-6)
    assert found.value == pytest.approx(plain.value, rel=1e-6)
    assert found.upper <= found.lower * (1.0 + 1e-5)
    sampled = changing.motion(np.linspace(-60.0, 90.0, 20_001)).speed.max()
    assert sampled <= found.upper


def test_a_walk_that_falls_says_so_through_a_sieve() -> None:
    walk = read_plan("spiral-in", ["dragon.benches=60"]).build()
    with pytest.raises(WalkError):
        greatest_speed(walk, 0.0, walk.route.length + 5.0)


def test_short_walks_of_uneven_dragons_need_no_sieve() -> None:
    walk, _start, _end = walk_of("coil")
    lengths = np.random.default_rng(2).uniform(2.0, 2.4, len(walk.dragon))
    assert speeds.sieve_pays(walk, 200.0)
    assert not speeds.sieve_pays(walk, 1.0)
    assert not speeds.sieve_pays(Walk(Dragon.of_sizes(lengths, 0.3, 0.2, 0.2), walk.route), 200.0)
