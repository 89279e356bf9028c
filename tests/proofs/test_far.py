"""Where doubles no longer hold what a cell rests on, none holds."""

import numpy as np
import pytest

from benchdragon import Dragon, Line, Route, Walk
from benchdragon.model.obstacle import Obstacle
from benchdragon.proofs.cells import holds
from benchdragon.proofs.cover import chain_at
from benchdragon.proofs.exact import guess_of, stored_dance

# On a straight line benches 1 and 3 are exactly their link less two insets apart, m.
APART, TOO_MUCH = 1.2, 2e-8


def test_far_from_its_start_a_dragon_is_not_shown_apart_by_roundings() -> None:
    heading = np.radians(25.623704617266952)
    route = Route((Line(1e8, (0.0, 0.0), heading),))
    walk = Walk(Dragon.of_sizes(np.full(3, 1.6), 0.2, 0.1, 0.1), route)
    dance, guess = stored_dance(walk, APART + TOO_MUCH), guess_of(walk)
    chain = chain_at(dance, guess, 81776814.0)
    assert not holds(dance, chain, chain)


@pytest.mark.parametrize(("far", "wanted"), [(10.0, True), (1000.0, False)])
def test_a_bench_far_behind_a_short_link_is_not_placed_by_roundings(far: float, wanted: bool) -> None:
    route = Route((Line(2.0 * far, (0.0, 0.0), 0.7),))
    inset, link = (10.0, 1.0) if wanted else (9000.0, 0.002)
    walk = Walk(Dragon.of_sizes([link + inset], 1e-3, inset, 0.0), route, start=1.0)
    along, left = np.array([np.cos(0.7), np.sin(0.7)]), np.array([-np.sin(0.7), np.cos(0.7)])
    post = Obstacle.circle("post", tuple((far + inset) * along + 5.0 * left), 1.0)
    dance, guess = stored_dance(walk, None, [post]), guess_of(walk)
    chain = chain_at(dance, guess, far)
    assert holds(dance, chain, chain) is wanted
