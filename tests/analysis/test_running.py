"""Where handles run: stretches by place, the fastest first."""

import numpy as np
import pytest

import benchdragon as bd
from benchdragon.analysis import running
from benchdragon.analysis.running import APART, running_stretches

# The head walks 1 m/s, and twice faster for a while: at 2.5 m/s after 10 s, at 3 m/s after 50 s.
PACE = bd.SpeedProfile(
    (0.0, 10.0, 11.0, 13.0, 14.0, 50.0, 51.0, 53.0, 54.0, 60.0),
    (1.0, 1.0, 2.5, 2.5, 1.0, 1.0, 3.0, 3.0, 1.0, 1.0),
)
WALK = bd.Walk(bd.Dragon.uniform(3, head_length=2.2), bd.Route((bd.Line(90.0),)), PACE, start=8.0)


def test_stretches_are_told_by_place_the_fastest_first() -> None:
    found = running_stretches(WALK, 0.0, 60.0, 1.8)
    assert [one.speed for one in found] == pytest.approx([3.0, 2.5])
    for one, (start, end) in zip(found, [(51.0, 53.0), (11.0, 13.0)], strict=True):
        assert start <= one.time <= end
        motion = WALK.motion([one.time])
        apart = np.hypot(motion.x[0] - one.point[0], motion.y[0] - one.point[1])
        assert apart.min() < 1e-9
        assert motion.speed[0, apart.argmin()] == pytest.approx(one.speed)
    assert [one.speed for one in running_stretches(WALK, 0.0, 60.0, 2.6)] == pytest.approx([3.0])
    assert running_stretches(WALK, 0.0, 60.0, 3.1) == ()


def test_places_close_together_are_one_stretch(monkeypatch: pytest.MonkeyPatch) -> None:
    assert len(running_stretches(WALK, 0.0, 60.0, 1.0)) == 1
    first, second = (one.point[0] for one in running_stretches(WALK, 0.0, 60.0, 1.8))
    assert abs(first - second) > APART
    monkeypatch.setattr(running, "APART", 60.0)
    assert len(running_stretches(WALK, 0.0, 60.0, 1.8)) == 1


def test_of_a_long_dance_fewer_times_are_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(running, "MOST_LOOKS", 4 * 31)
    assert [one.time % 2.0 for one in running_stretches(WALK, 0.0, 60.0, 2.2)] == [0.0, 0.0]
