"""How much nearer benches may come: never less than they do, and little where they pass alongside."""

import numpy as np
import pytest

pytest.importorskip("flint")
from flint import arb

from benchdragon.plans.schema import read_plan
from benchdragon.proofs.approach import Approach
from benchdragon.proofs.boxes import Boxes, gaps
from benchdragon.proofs.cells import holds, unsure
from benchdragon.proofs.cover import chain_at
from benchdragon.proofs.exact import guess_of, stored_dance
from benchdragon.proofs.motion import follows, moves
from tests.proofs.test_cells import WALKS


def units(chance: np.random.Generator, count: int) -> np.ndarray:
    angle = chance.uniform(0.0, 2.0 * np.pi, count)
    return np.stack([np.cos(angle), np.sin(angle)], 1)


@pytest.mark.parametrize("name", list(WALKS))
@pytest.mark.parametrize("long", [0.01, 0.1, 0.3])
def test_no_bench_goes_farther_along_lines_than_is_said(name: str, long: float) -> None:
    walk, first, last = WALKS[name]
    dance, guess, chance = stored_dance(walk, 0.0), guess_of(walk), np.random.default_rng(11)
    i = np.arange(len(walk.dragon))
    greatest = 0.0
    for s in chance.uniform(first, last, 8).tolist():
        a, b = (chain_at(dance, guess, at) for at in (s, s + long))
        way = moves(a, b)
        if not follows(a, b, dance.sizes.numbers[0], way):
            continue
        boxes = Boxes.of((a, b), dance.sizes)
        looked = [(units(chance, len(i)), units(chance, len(i))) for _lines in range(6)]
        # Random lines, and those along which two benches are looked at: nearly square to their way.
        found = gaps(boxes, boxes.at(np.roll(i, -7)))
        looked += [tuple(line) for line in np.stack([found.x, found.y], -1)]
        for at in np.linspace(s, s + long, 6).tolist():
            placed = Boxes.of([chain_at(dance, guess, at)], dance.sizes).corners[0]
            for on, back in looked:
                gone = np.einsum("nvc,nc->nv", placed - boxes.corners[0], on).max(1)
                left = np.einsum("nvc,nc->nv", placed - boxes.corners[1], back).max(1)
                x, y = np.moveaxis(np.stack([on, back]), 2, 0)
                said = Approach((a, b), boxes, dance.sizes, way).along(i, x, y)
                assert (gone + left <= said + 1e-12).all()
                greatest = max(greatest, float(((gone + left) / said).max()))
    assert greatest > 0.96 / (1.0 + 4.0 * long)  # nor is it far away


@pytest.mark.parametrize("name", list(WALKS))
def test_no_pair_comes_nearer_than_a_margin_that_it_surely_keeps(name: str) -> None:
    walk, first, last = WALKS[name]
    dance, guess = stored_dance(walk, 0.0), guess_of(walk)
    pairs = np.stack(np.triu_indices(len(walk.dragon), 2), 1)
    i, j = pairs.T
    sure = []
    for s in np.linspace(first, last, 60 // len(walk.dragon) + 1).tolist():
        chains = [chain_at(dance, guess, at) for at in np.linspace(s, s + 0.05, 7).tolist()]
        way = moves(chains[0], chains[-1])
        boxes = Boxes.of(chains, dance.sizes)
        apart = gaps(boxes.at(i), boxes.at(j)).size.max(0)
        ends = Boxes.of((chains[0], chains[-1]), dance.sizes)
        for pair, seen in zip(pairs[:, None, :], np.min(apart, axis=0).tolist(), strict=True):
            kept = [
                len(unsure((chains[0], chains[-1]), dance.sizes, ends, ends, pair, way, arb(margin)))
                == 0
                for margin in (seen + 1e-6, seen - 0.15)
            ]
            assert not kept[0]
            sure.append(kept)
    assert np.mean(sure, axis=0)[1] > 0.8  # nor is the bound far away


def test_a_long_cell_of_coils_holds() -> None:
    """Which with what benches move in any direction would take three."""
    walk = read_plan("spiral-in").build()
    dance, guess = stored_dance(walk, 0.0), guess_of(walk)
    a, b = (chain_at(dance, guess, at) for at in (10.0, 10.25))
    assert holds(dance, a, b)
