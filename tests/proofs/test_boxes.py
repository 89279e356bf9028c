"""How far apart rectangles are: as their corners and shapely have it."""

import numpy as np
import pytest

pytest.importorskip("flint")
import shapely
from flint import arb

from benchdragon.proofs.boxes import LINES, Boxes, gaps, near_pairs, near_sides
from benchdragon.proofs.chain import Chain
from benchdragon.proofs.sizes import Sizes

COUNT = 400


def rectangles(chance: np.random.Generator) -> Boxes:
    """Long and short ones, some of them lines, on a ground of 6 m by 6 m."""
    x, y = chance.uniform(0.0, 6.0, (2, COUNT))
    angle = chance.uniform(0.0, 2.0 * np.pi, COUNT)
    long, wide = chance.uniform(0.2, 1.6, COUNT), chance.choice([0.0, 0.15, 0.8], COUNT)
    return Boxes(x, y, np.cos(angle), np.sin(angle), long, wide)


def test_gaps_are_those_of_corners_along_lines_and_the_greatest_is_the_distance() -> None:
    chance = np.random.default_rng(5)
    one, other = rectangles(chance), rectangles(chance)
    found = gaps(one, other)
    line = np.stack([found.x, found.y], -1)
    assert np.allclose(np.hypot(found.x, found.y), 1.0)
    a, b = (np.einsum("nvc,lnc->lnv", boxes.corners, line) for boxes in (one, other))
    assert np.allclose(b.min(-1) - a.max(-1), found.size, atol=1e-12)
    apart = shapely.distance(shapely.polygons(one.corners), shapely.polygons(other.corners))
    assert np.allclose(np.maximum(found.size.max(0), 0.0), apart, atol=1e-12)
    assert 0.2 * COUNT < np.count_nonzero(apart) < 0.9 * COUNT
    # Each line is needed: it alone shows how far some are apart.
    best = found.size[:, apart > 0.0].argmax(0)
    assert set(best.tolist()) == set(range(len(LINES)))


def test_near_are_all_that_could_come_within_the_margin() -> None:
    chance = np.random.default_rng(6)
    one, room = rectangles(chance), chance.uniform(0.0, 0.2, COUNT)
    sides, margin = Boxes.between(*rectangles(chance).ends), 0.3
    shapes = np.asarray(shapely.polygons(one.corners))
    lines = np.asarray(shapely.linestrings(np.stack(sides.ends, 1)))
    apart = shapely.distance(shapes[:, None], shapes)
    pairs = near_pairs(one, room, margin)
    assert (pairs[:, 1] > pairs[:, 0] + 1).all()
    wanted = np.argwhere(np.triu(apart <= room + room[:, None] + margin, 2))
    assert set(map(tuple, wanted.tolist())) <= set(map(tuple, pairs.tolist()))
    assert len(pairs) < 6 * len(wanted)
    apart = shapely.distance(shapes[:, None], lines)
    wanted = np.argwhere(apart <= room[:, None] + margin)
    found = near_sides(one, sides, room, margin)
    assert set(map(tuple, wanted.tolist())) <= set(map(tuple, found.tolist()))
    assert len(found) < 6 * len(wanted)


def test_a_side_without_length_has_a_direction() -> None:
    point = np.array([[1.0, 2.0]])
    side = Boxes.between(point, point)
    assert (side.ahead_x.item(), side.ahead_y.item(), side.long.item()) == (1.0, 0.0, 0.0)


def test_lines_are_unit_vectors_though_places_are_rounded() -> None:
    """Longer ones would take benches for farther apart than they are."""
    sizes = Sizes.of([arb(2)], [arb(0.3)], [arb(0.5)], [arb(0.5)])
    place = np.array([1.0 + 1e-6, 0.0])  # a micrometre farther apart than the link
    chain = Chain((), (0.0, 0.0), place, place, place, 0.0 * place, np.zeros((2, 2)))
    boxes = Boxes.of([chain], sizes)
    assert np.hypot(boxes.ahead_x, boxes.ahead_y).item() == 1.0
    assert (boxes.long.item(), boxes.wide.item()) == (1.0, 0.15)
