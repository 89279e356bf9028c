"""Chains in ball arithmetic: links are kept, and guesses decide nothing."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("flint")
from flint import arb

from benchdragon import Walk
from benchdragon.kernels.curve import FloatArray
from benchdragon.plans.schema import read_plan
from benchdragon.proofs.cells import Dance
from benchdragon.proofs.chain import Chain, UnprovedError, enclosed_chain, follower
from benchdragon.proofs.cover import chain_at
from benchdragon.proofs.exact import guess_of, stored_dance
from tests.proofs.dances import COIL, eased, hairpin

WALKS = [
    (COIL.build(), 30.0),
    (hairpin(), 16.0),
    (eased(), 17.5),
    (read_plan("turn", ["dragon.benches=20"]).build(), 108.0),
]


def chains(walk: Walk, s: float) -> tuple[Dance, Chain]:
    dance = stored_dance(walk, 0.0)
    return dance, chain_at(dance, guess_of(walk), s)


@pytest.mark.parametrize(("walk", "s"), WALKS)
def test_handles_are_where_the_walk_has_them(walk: Walk, s: float) -> None:
    dance, chain = chains(walk, s)
    placed = walk.placement(s)
    assert np.abs(chain.x + dance.origin[0] - placed.x[0]).max() < 1e-11
    assert np.abs(chain.y + dance.origin[1] - placed.y[0]).max() < 1e-11
    assert np.abs(chain.s - placed.s[0]).max() < 1e-11


@pytest.mark.parametrize(("walk", "s"), WALKS)
def test_links_are_kept_to_the_errors_told(walk: Walk, s: float) -> None:
    dance, chain = chains(walk, s)
    assert abs(chain.handles[0].s - s) <= chain.handles[0].error + 1e-30
    pairs = zip(chain.handles, chain.handles[1:], dance.sizes.links, strict=False)
    for front, rear, link in pairs:
        dx, dy = (front.pose[n] - rear.pose[n] for n in (0, 1))
        assert abs((dx * dx + dy * dy).sqrt() - link) < 1e-24
        assert rear.error < 1e-20


@pytest.mark.parametrize(("walk", "s"), WALKS)
def test_an_error_of_the_head_is_one_of_every_handle(walk: Walk, s: float) -> None:
    dance, chain = chains(walk, s)
    _dance, moved = chains(walk, s + 1e-6)
    front = replace(chain.handles[0], error=1e-16)
    for link, rear, later in zip(dance.sizes.links, chain.handles[1:], moved.handles[1:], strict=True):
        front = follower(dance.route, front, link, rear.j, float(rear.u))
        wanted = float(later.s - rear.s) / 1e-6 * 1e-16
        assert 0.999 * wanted < front.error < 1.01 * wanted


@pytest.mark.parametrize(("walk", "s"), WALKS)
def test_a_guess_that_is_off_changes_nothing(walk: Walk, s: float) -> None:
    dance, chain = chains(walk, s)
    rows, at = guess_of(walk)(s)
    off = np.random.default_rng(3).normal(0.0, 1e-5, len(at))
    other = enclosed_chain(dance.route, dance.sizes.links, arb(s), (rows, at + off), dance.origin)
    for one, again in zip(chain.handles, other.handles, strict=True):
        assert abs(one.s - again.s) <= one.error + again.error + 1e-24


def test_a_guess_on_the_row_beside_is_followed_over() -> None:
    walk, _s = WALKS[1]
    s = walk.route.joints[1] + float(walk.dragon.links[0]) - 0.01  # the second handle is before a joint
    dance, chain = chains(walk, s)
    rows, at = guess_of(walk)(s)
    assert rows[1] == 0
    beside = [rows[0], 1, *rows[2:]]
    guess = np.array([at[0], 0.0, *at[2:]])
    other = enclosed_chain(dance.route, dance.sizes.links, arb(s), (beside, guess), (0.0, 0.0))
    assert [handle.j for handle in other.handles] == [handle.j for handle in chain.handles]
    for one, again in zip(chain.handles, other.handles, strict=True):
        assert abs(one.s - again.s) < 1e-20


def test_no_chain_is_made_where_there_is_none() -> None:
    walk, _s = WALKS[1]
    dance, guess = stored_dance(walk, 0.0), guess_of(walk)
    with pytest.raises(UnprovedError):  # the tail would stand before the start
        enclosed_chain(
            dance.route, [*dance.sizes.links] * 4, arb(12.0), _longer(guess(12.0)), (0.0, 0.0)
        )


def _longer(guess: tuple[Sequence[int], FloatArray]) -> tuple[list[int], FloatArray]:
    rows, at = guess
    more = 3 * (len(rows) - 1)
    return [*rows, *[0] * more], np.concatenate([at, np.zeros(more)])
