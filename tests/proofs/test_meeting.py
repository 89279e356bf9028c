"""Meetings: what surely overlaps, and on which side of a line a point surely lies."""

import functools

import numpy as np
import pytest
import shapely

pytest.importorskip("flint")
from flint import arb

from benchdragon.proofs import meeting
from benchdragon.proofs.apart import Bench, Moving, Side
from benchdragon.proofs.boxes import Boxes
from benchdragon.proofs.cells import Standing
from benchdragon.proofs.chain import Chain
from benchdragon.proofs.cover import chain_at
from benchdragon.proofs.exact import guess_of, stored_dance
from benchdragon.proofs.meeting import belongs, lies_inside, nearer
from benchdragon.proofs.sizes import Sizes
from tests.proofs.dances import coil

STAR = [(0.0, 3.0), (1.0, 1.0), (3.0, 0.5), (1.2, -0.6), (1.5, -3.0), (-0.4, -1.0), (-3.0, 0.2)]


def sides(points: list[tuple[float, float]]) -> list[Side]:
    ends = zip(points, [*points[1:], points[0]], strict=True)
    return [Side((arb(a), arb(b)), (arb(c), arb(d))) for (a, b), (c, d) in ends]


def test_points_are_inside_as_shapely_has_it() -> None:
    shape, star = shapely.Polygon(STAR), sides(STAR)
    count = 0
    for x, y in np.random.default_rng(4).uniform(-3.5, 3.5, (400, 2)).tolist():
        found = lies_inside((arb(x), arb(y)), star)
        assert found is shape.contains(shapely.Point(x, y))
        count += bool(found)
    assert 40 < count < 360


@pytest.mark.parametrize("point", [(1.0, 1.0), (0.5, 2.0), (2.0, 0.75)])
def test_a_point_on_the_edge_is_left_open(point: tuple[float, float]) -> None:
    x, y = (arb(value) + arb(0, 1e-30) for value in point)
    assert lies_inside((x, y), sides(STAR)) is None


def test_benches_are_nearer_as_shapely_has_it() -> None:
    walk = coil(0.55, dragon__width=0.7).build()
    seen = set()
    for s in np.linspace(5.0, 60.0, 6).tolist():
        dance, guess = stored_dance(walk, 0.0), guess_of(walk)
        chain = chain_at(dance, guess, s)
        boxes = [shapely.Polygon(box) for box in Boxes.of([chain], dance.sizes).corners[0]]
        for i, j in zip(*np.triu_indices(30, 2), strict=True):
            if i % 3:
                continue
            apart = boxes[i].distance(boxes[j])
            pair = Moving(int(i)), Moving(int(j))
            found = nearer(chain, dance.sizes, pair, arb(0))
            assert found is (apart == 0.0)
            assert nearer(chain, dance.sizes, pair, arb(apart + 1e-6))
            assert apart < 1e-5 or not nearer(chain, dance.sizes, pair, arb(apart - 1e-6))
            seen.add(found)
    assert seen == {True, False}


class Upright(Side):
    """A bench between two corners, with its sides along the axes: all its numbers are exact."""

    def place(self, _chain: Chain, _sizes: Sizes) -> Bench:
        (left, low), (right, high) = self.start, self.end
        return Bench((arb(1), arb(0)), [(right, high), (right, low), (left, low), (left, high)])


@functools.cache
def any_chain() -> tuple[Chain, Sizes]:
    """One that what stands does not ask for."""
    walk = coil(0.55).build()
    dance = stored_dance(walk, 0.0)
    return chain_at(dance, guess_of(walk), 20.0), dance.sizes


def upright(left: float, low: float, right: float, high: float) -> Upright:
    return Upright((arb(left), arb(low)), (arb(right), arb(high)))


@pytest.mark.parametrize(
    ("one", "other", "margin", "wanted"),
    [
        ((-1, -1, 1, 1), (-0.25, -0.25, 0.25, 0.25), 0.0, True),  # one within the other: no sides cross
        ((-1, -1, 1, 1), (0.0, 0.0, 2.0, 2.0), 0.0, True),
        ((-2, -0.5, 2, 0.5), (-0.5, -2, 0.5, 2), 0.0, True),  # crossed: no corner lies within
        ((-0.25, -0.0625, 0.25, 0.0625), (-0.0625, -0.25, 0.0625, 0.25), 0.0, True),  # small ones, too
        ((0, 0, 1, 1), (1, 0, 2, 1), 0.0, False),  # that touch are not nearer than 0
        ((0, 0, 1, 1), (1.5, 0, 2, 1), 0.5, False),  # as far as asked is not nearer
        ((0, 0, 1, 1), (1.5, 0, 2, 1), 0.5625, True),
        ((0, 0, 1, 1), (0, 1.5, 1, 2), 0.5, False),
        ((0, 0, 1, 1), (0, 1.5, 1, 2), 0.5625, True),
        ((0, 0, 1, 1), (4, 5, 6, 7), 5.0, False),  # from corner to corner: 3, 4, 5
        ((0, 0, 1, 1), (4, 5, 6, 7), 5.0625, True),
    ],
)
def test_what_is_nearer_is_so_to_the_last_bit(
    one: tuple[float, ...], other: tuple[float, ...], margin: float, wanted: bool
) -> None:
    pair = upright(*one), upright(*other)
    for bodies in (pair, pair[::-1]):
        assert nearer(*any_chain(), bodies, arb(margin)) is wanted


@pytest.mark.parametrize(
    ("point", "wanted"),
    [
        ((0.5, 0.5), True),
        ((1.5, 0.5), False),
        ((-0.5, 0.5), False),
        ((0.5, 1.5), False),
        ((0.5, -0.5), False),
        ((1.0, 0.5), None),
        ((0.5, 1.0), None),
        ((0.0, 0.5), None),
        ((2.0, 2.0), False),
        ((-1.0, -1.0), False),
        ((0.0, 0.0), None),
        ((1.0, 1.0), None),
    ],
)
def test_exact_points_are_inside_a_square_outside_or_on_its_edge(
    point: tuple[float, float], wanted: bool | None
) -> None:
    square = sides([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    for polygon in (square, [Side(one.end, one.start) for one in reversed(square)]):
        assert lies_inside((arb(point[0]), arb(point[1])), polygon) is wanted


@pytest.mark.parametrize(
    ("x", "wanted"), [(-1.0, False), (0.5, True), (2.5, False), (4.5, True), (6.0, False)]
)
def test_a_ray_may_cross_many_sides(x: float, wanted: bool) -> None:
    u = [(0.0, 0.0), (5.0, 0.0), (5.0, 3.0), (4.0, 3.0), (4.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)]
    assert lies_inside((arb(x), arb(2)), sides(u)) is wanted


@pytest.mark.parametrize(("inside", "wanted"), [(True, True), (False, False), (None, True)])
def test_a_bench_with_all_corners_on_the_edge_is_where_its_middle_is(
    monkeypatch: pytest.MonkeyPatch, inside: bool | None, wanted: bool
) -> None:
    monkeypatch.setattr(meeting, "Moving", lambda _number: upright(3.0, 4.0, 5.0, 6.0))
    edge = sides([(3.0, 4.0), (5.0, 4.0), (5.0, 6.0), (3.0, 6.0)])
    standing = Standing(edge, arb(0), Boxes.between(*np.empty((2, 0, 2))), inside)
    assert belongs(*any_chain(), 0, standing) is wanted
