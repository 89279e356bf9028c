"""Where the heading jumps, distances have no second derivative."""

import numpy as np
import pytest

from benchdragon import Dragon, Line, Route, Walk
from benchdragon.model.obstacle import Obstacle
from benchdragon.proofs.cells import holds
from benchdragon.proofs.cover import chain_at
from benchdragon.proofs.exact import guess_of, stored_dance

# The head walks up to a corner of 60 degrees and away from it, past a wall.
TURN, CORNER = np.radians(-60.0), 10.0
WALK = Walk(
    Dragon.of_sizes([1.6], 0.02, 0.1, 0.1),
    Route((Line(CORNER, (0.0, 0.0), 0.0), Line(10.0, (CORNER, 0.0), TURN)), kinks=True),
    start=5.0,
)


def _wall(beyond: float) -> Obstacle:
    """A wall square to the way that halves the corner, so far from the bench's front at the corner."""
    normal, front = np.array([0.5, np.sqrt(0.75)]), np.array([CORNER + 0.1, 0.01])
    middle, long = (front @ normal + beyond) * normal, np.array([-normal[1], normal[0]])
    return Obstacle.line("wall", [middle - 30.0 * long, middle + 30.0 * long])


@pytest.mark.parametrize("half", [1e-3, 1e-2])
@pytest.mark.parametrize(("share", "wanted"), [(-0.01, False), (10.0, True)])
def test_a_wall_that_is_touched_at_a_kink_alone_is_not_passed_over(
    half: float, share: float, wanted: bool
) -> None:
    dance, guess = stored_dance(WALK, None, [_wall(share * half)]), guess_of(WALK)
    a, here, b = (chain_at(dance, guess, CORNER + off) for off in (-half, 0.0, half))
    assert holds(dance, a, a)
    assert holds(dance, b, b)
    assert holds(dance, here, here) is wanted
    assert holds(dance, a, b) is wanted
