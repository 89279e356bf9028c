"""Cells: what holds is so at every place between, and each bound is as tight as it must be."""

from functools import partial

import numpy as np
import pytest

pytest.importorskip("flint")
from flint import arb

from benchdragon import Arc, Dragon, Line, Route, Walk
from benchdragon.analysis.distance import nearest_each
from benchdragon.model.obstacle import Obstacle
from benchdragon.proofs.apart import Moving, along, bends, line_of
from benchdragon.proofs.boxes import Boxes, reach
from benchdragon.proofs.cells import holds
from benchdragon.proofs.chain import enclosed_chain
from benchdragon.proofs.cover import chain_at
from benchdragon.proofs.exact import guess_of, stored_dance
from benchdragon.proofs.motion import drives, follows, moves, nearest
from tests.proofs.dances import coil, eased, hairpin

WALKS = {
    "coil": (coil(0.46).build(), 20.0, 66.0),
    "hairpin": (hairpin(), 13.0, 22.0),
    "eased": (eased(), 13.0, 24.0),
}


def least(walk: Walk, low: float, high: float, count: int = 201) -> float:
    """The least distance of two benches, sampled, m."""
    found, _numbers = nearest_each(walk.placement(np.linspace(low, high, count)), reach=30.0)
    return float(found.min())


@pytest.mark.parametrize("name", list(WALKS))
@pytest.mark.parametrize("long", [1e-4, 0.01, 0.05])
def test_no_cell_holds_that_should_not_and_some_hold_that_do(name: str, long: float) -> None:
    walk, first, last = WALKS[name]
    spare = 0.01 + 3.0 * long  # what bounds may give away of a distance, m
    for s in np.random.default_rng(7).uniform(first, last, 12).tolist():
        seen = least(walk, s, s + long)
        for margin, wanted in ((seen + 1e-9, False), (max(seen - spare, 0.0), seen > spare)):
            dance, guess = stored_dance(walk, margin), guess_of(walk)
            found = holds(dance, *(chain_at(dance, guess, at) for at in (s, s + long)))
            assert found is wanted or (margin < seen and seen <= spare), (s, margin, seen)


@pytest.mark.parametrize("name", list(WALKS))
def test_chains_between_show_more_and_nothing_that_is_not_so(name: str) -> None:
    walk, first, last = WALKS[name]
    more, long = 0, 0.3
    for s in np.random.default_rng(9).uniform(first, last - long, 12).tolist():
        seen = least(walk, s, s + long)
        for margin in (seen + 1e-9, max(seen - 0.02, 0.0)):
            dance, guess = stored_dance(walk, margin), guess_of(walk)
            a, b = (chain_at(dance, guess, at) for at in (s, s + long))
            found = holds(dance, a, b, between=partial(chain_at, dance, guess))
            assert not found or margin < seen, (s, margin, seen)
            assert found >= holds(dance, a, b)
            more += found and not holds(dance, a, b)
    assert more >= 2


@pytest.mark.parametrize("name", list(WALKS))
def test_short_cells_hold_within_a_hair_of_the_distance(name: str) -> None:
    walk, first, last = WALKS[name]
    for s in np.random.default_rng(8).uniform(first, last, 6).tolist():
        seen = least(walk, s, s + 1e-6, 3)
        dance, guess = stored_dance(walk, seen - 1e-5), guess_of(walk)
        a, b = (chain_at(dance, guess, at) for at in (s, s + 1e-6))
        assert holds(dance, a, b)
        assert not holds(stored_dance(walk, seen + 1e-12), a, b)


@pytest.mark.parametrize("name", list(WALKS))
def test_no_point_moves_more_than_its_bound(name: str) -> None:
    walk, first, last = WALKS[name]
    dance, guess = stored_dance(walk, 0.0), guess_of(walk)
    for s in np.random.default_rng(9).uniform(first, last, 8).tolist():
        a, b = (chain_at(dance, guess, at) for at in (s, s + 0.08))
        room = reach(moves(a, b), dance.sizes)
        start = Boxes.of([a], dance.sizes).corners[0]
        for at in np.linspace(s, s + 0.08, 7).tolist():
            moved = np.hypot(
                *np.moveaxis(
                    Boxes.of([chain_at(dance, guess, at)], dance.sizes).corners[0] - start, 2, 0
                )
            )
            assert (moved.max(axis=1) <= room + 1e-12).all()
        assert (moved.max(axis=1) > 0.2 * room).all()  # nor is the bound far away


@pytest.mark.parametrize("name", list(WALKS))
def test_speeds_and_accelerations_are_enclosed(name: str) -> None:
    walk, first, last = WALKS[name]
    dance, guess = stored_dance(walk, 0.0), guess_of(walk)
    count = len(walk.dragon) + 1
    for s in np.random.default_rng(10).uniform(first, last, 6).tolist():
        a, b = (chain_at(dance, guess, at) for at in (s, s + 1e-4))
        if any(one.j != other.j for one, other in zip(a.handles, b.handles, strict=True)):
            continue  # bends jump there: tested below
        boxes = drives(a, b, dance.route, dance.sizes.links, count)
        t = s + 0.5e-4 - walk.start
        h = 1e-5
        motion = walk.motion([t - h, t, t + h])
        for k, box in enumerate(boxes):
            for n, column in enumerate((motion.x, motion.y)):
                before, here, after = column[:, k].tolist()
                assert box.place[n].overlaps(arb(here, 1e-12))
                speed, rate = (after - before) / (2 * h), (after - 2 * here + before) / h**2
                assert float(abs(box.speed[n] - speed).lower()) < 1e-7
                assert float(box.speed[n].rad()) < 1e-2
                assert float(abs(box.acceleration[n] - rate).lower()) < 2e-2
                assert float(box.acceleration[n].rad()) < 0.2


def test_both_bends_of_a_joint_count() -> None:
    walk = hairpin()
    s = float(walk.route.joints[1])
    dance, guess = stored_dance(walk, 0.0), guess_of(walk)
    a, b = (chain_at(dance, guess, at) for at in (s - 1e-5, s + 1e-5))
    (head,) = drives(a, b, dance.route, dance.sizes.links, 1)
    assert head.acceleration[1].contains(0.0)  # on the straight
    assert float(head.acceleration[1].upper()) > 0.999  # on the arc of 1 m


def test_a_cell_in_which_a_bench_may_stand_square_does_not_hold() -> None:
    # A bench of 1.4 m in a bend of 0.71 m: it stands at 80 degrees to the route.
    route = Route.joined([Line(10.0), Arc(0.71, np.pi), Line(10.0)])
    walk = Walk(Dragon.of_sizes([1.6], 0.2, 0.1, 0.1), route, start=5.0)
    dance, guess = stored_dance(walk, None), guess_of(walk)
    s, links = 12.05, dance.sizes.numbers[0]
    a = chain_at(dance, guess, s)
    assert 79.0 < np.degrees(np.arccos(a.tangent[1] @ [a.x[0] - a.x[1], a.y[0] - a.y[1]] / 1.4)) < 81.0
    for long, wanted in ((0.1, False), (0.001, True)):
        b = chain_at(dance, guess, s + long)
        assert follows(a, b, links, moves(a, b)) is wanted
        assert holds(dance, a, b) is wanted


def test_a_cell_in_which_a_handle_goes_as_far_as_its_link_does_not_hold() -> None:
    # On a line nothing else is in doubt: the angle between bench and route alone is not bounded.
    walk = Walk(Dragon.of_sizes([1.6], 0.2, 0.1, 0.1), Route.joined([Line(20.0)]), start=5.0)
    dance, guess = stored_dance(walk, None), guess_of(walk)
    a = chain_at(dance, guess, 5.0)
    for long, wanted in ((0.69, True), (0.71, False)):
        b = chain_at(dance, guess, 5.0 + long)
        assert nearest(a, b, dance.route, dance.sizes.numbers[0], moves(a, b))
        assert holds(dance, a, b) is wanted


def test_a_handle_that_is_not_the_nearest_does_not_hold() -> None:
    # On the way out of the hairpin there are places one link behind on both of its sides.
    route = Route.joined([Line(10.0), Arc(0.6, np.pi), Line(10.0)])
    walk = Walk(Dragon.of_sizes([1.6], 0.2, 0.1, 0.1), route, start=5.0)
    dance, guess = stored_dance(walk, None), guess_of(walk)
    s = route.joints[2] + 1.45
    right = chain_at(dance, guess, s)
    rows, at = guess(s)
    far = 10.0 - 1.45 - np.sqrt(1.4**2 - 1.2**2)
    wrong = enclosed_chain(
        dance.route, dance.sizes.links, arb(s), ([rows[0], 0], np.array([at[0], far])), dance.origin
    )
    still, links = np.zeros(2), dance.sizes.numbers[0]
    assert nearest(right, right, dance.route, links, still)
    assert not nearest(wrong, wrong, dance.route, links, still)


OBSTACLES = {
    "post": Obstacle.circle("post", (15.3, 1.0), 0.1, 0.05),
    "wall": Obstacle.line("wall", [(15.25, -3.0), (15.25, 5.0)], 0.1),
    "venue": Obstacle.venue("square", [(-9, -4), (15.2, -4), (15.2, 9), (-9, 9)], 0.02),
}


@pytest.mark.parametrize("name", list(OBSTACLES))
def test_obstacles_are_kept_off_as_sampling_has_it(name: str) -> None:
    walk, obstacle = hairpin(), OBSTACLES[name]
    sides = stored_dance(walk, None, [obstacle]).standing[0].boxes.corners
    held = touched = 0
    for s in np.random.default_rng(11).uniform(12.0, 19.0, 60).tolist():
        dance, guess = stored_dance(walk, None, [obstacle]), guess_of(walk)
        seen = min(_to_sides(Boxes.of([chain_at(dance, guess, at)], dance.sizes).corners[0], sides)
                   for at in np.linspace(s, s + 0.01, 5).tolist())  # fmt: skip
        wanted = seen - obstacle.margin - obstacle.radius
        found = holds(dance, *(chain_at(dance, guess, at) for at in (s, s + 0.01)))
        assert found is (wanted > 0.0) or abs(wanted) < 0.04
        held, touched = held + found, touched + (not found)
    assert held >= 5
    assert touched >= 2


def _to_sides(boxes: np.ndarray, sides: np.ndarray) -> float:
    import shapely

    lines = [shapely.LineString(side[[0, 3]]) for side in sides]
    return min(shapely.Polygon(box).distance(line) for box in boxes for line in lines)


@pytest.mark.parametrize(
    ("name", "s", "long", "share", "wanted"),
    [("coil", 65.68, 0.02, 0.3, False), ("hairpin", 17.865, 0.01, -100.0, True)],
)
def test_a_distance_that_dips_between_the_ends_is_not_overlooked(
    name: str, s: float, long: float, share: float, wanted: bool
) -> None:
    walk, _first, _last = WALKS[name]
    dip, ends = (
        least(walk, s - long, s + long),
        min(least(walk, at, at, 1) for at in (s - long, s + long)),
    )
    assert ends > dip + 1e-7
    dance, guess = stored_dance(walk, dip + share * (ends - dip)), guess_of(walk)
    assert holds(dance, *(chain_at(dance, guess, at) for at in (s - long, s + long))) is wanted


@pytest.mark.parametrize("name", list(WALKS))
def test_second_derivatives_of_distances_are_enclosed(name: str) -> None:
    walk, first, last = WALKS[name]
    dance, guess = stored_dance(walk, 0.0), guess_of(walk)
    seen, h = 0, 1e-3
    for s in np.random.default_rng(12).uniform(first, last, 8).tolist():
        before, here, after = (chain_at(dance, guess, at) for at in (s - h, s, s + h))
        rows = [[handle.j for handle in chain.handles] for chain in (before, here, after)]
        if rows[0] != rows[2]:
            continue  # bends jump there
        pair = Moving(0), Moving(3)
        line = line_of([body.place(here, dance.sizes) for body in pair])
        apart = [
            along(line, [body.place(chain, dance.sizes) for body in pair])
            for chain in (before, here, after)
        ]
        boxes = drives(before, after, dance.route, dance.sizes.links, 5)
        moving = zip(*(body.drive(boxes, dance.sizes) for body in pair), strict=True)
        for a, b, c, bend in zip(*apart, bends(line, *moving), strict=True):
            second = float((a - 2 * b + c) / (h * h))
            assert float(bend.lower()) - 1e-6 <= second <= float(bend.upper()) + 1e-6
            assert float(bend.rad()) < 2.0
            seen += 1
    assert seen >= 32
