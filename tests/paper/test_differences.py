import numpy as np
import pytest

from benchdragon.paper.differences import (
    SCHEMES,
    Scheme,
    difference_errors,
    difference_speeds,
    exact_velocities,
    order,
)
from benchdragon.plans.schema import read_plan

WALK = read_plan("spiral-in").build()
TIMES = np.arange(20.0, 281.0, 20.0)


@pytest.mark.parametrize(("scheme", "expected"), [("forward", 1), ("central", 2), ("backward", 1)])
def test_the_three_formulas_have_their_orders(scheme: Scheme, expected: int) -> None:
    steps = (0.2, 0.1, 0.05)
    assert order(steps, difference_errors(WALK, TIMES, steps, scheme)) == pytest.approx(
        expected, abs=0.02
    )


@pytest.mark.parametrize("scheme", SCHEMES)
def test_the_heads_speed_from_places_falls_short_of_one_by_the_chord(scheme: Scheme) -> None:
    span = 0.2 if scheme == "central" else 0.1
    errors = 1.0 - difference_speeds(WALK, TIMES, 0.1, scheme)[:, 0]
    bends = WALK.route.curvature(WALK.head_position(TIMES))
    # The chord of an arc of length h is shorter by kappa^2 h^3 / 24.
    assert errors == pytest.approx(bends**2 * span**2 / 24.0, rel=0.02)


def test_exact_velocities_are_as_long_as_the_speeds() -> None:
    velocities = exact_velocities(WALK, TIMES)
    speeds = WALK.motion(TIMES).speed
    assert np.linalg.norm(velocities, axis=-1) == pytest.approx(speeds, abs=1e-14)
