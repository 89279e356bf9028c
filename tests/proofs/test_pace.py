"""Speeds in a cell: enclosed at every place between, and bounds as tight as they must be."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("flint")
from flint import arb

from benchdragon import Arc, Dragon, Line, Route, Walk
from benchdragon.plans.schema import read_plan
from benchdragon.proofs.ball_route import BallRoute
from benchdragon.proofs.cells import holds
from benchdragon.proofs.cover import cells, chain_at
from benchdragon.proofs.exact import Numbers
from benchdragon.proofs.pace import Pace, Still, course, greatest, paces
from tests.proofs.dances import coil, eased, hairpin
from tests.proofs.test_ball_route import ROUTES, SHARES, between

TURN = read_plan("turn", ["dragon.benches=8"]).build()
WALKS = {
    "coil": (coil(0.46).build(), 20.0, 66.0),
    "hairpin": (hairpin(), 13.0, 22.0),
    "eased": (eased(), 13.0, 24.0),
    "turn": (TURN, 98.0, 125.0),
}
# The greatest speed ratio of the contest's turn: see tests/truth/contest.json.
GREATEST, WHERE = 1.604793378966638, 114.4799695977


@pytest.mark.parametrize("route", ROUTES)
def test_headings_are_those_of_the_tangents(route: Route) -> None:
    for row in BallRoute.stored(route.rows).rows:
        for share in SHARES:
            u = between(row, share)
            _x, _y, tx, ty = row.pose(u)
            sine, cosine = row.heading(u).sin_cos()
            assert abs(sine - ty) < 1e-25
            assert abs(cosine - tx) < 1e-25


@pytest.mark.parametrize("name", list(WALKS))
@pytest.mark.parametrize("long", [1e-4, 0.02, 0.2])
def test_speeds_and_their_changes_are_enclosed(name: str, long: float) -> None:
    walk, first, last = WALKS[name]
    numbers = Numbers.stored(walk)
    dance = numbers.dance(None)
    links = dance.sizes.links
    for s in np.random.default_rng(5).uniform(first, last, 8).tolist():
        a, b = (chain_at(dance, numbers.guess, at) for at in (s, s + long))
        found = list(paces(a, b, dance.route, links))
        ends = [Still.of(chain, dance.route, links).speeds for chain in (a, b)]
        inner = [Still.of(chain_at(dance, numbers.guess, s + long * x), dance.route, links).speeds
                 for x in (0.25, 0.5, 0.75)]  # fmt: skip
        for k, pace in enumerate(found):
            most = greatest(pace, ends[0][k], ends[1][k], arb(long))
            for speeds in (*ends, *inner):
                assert pace.speed.overlaps(speeds[k])
                assert not most < speeds[k]
            rise = (ends[1][k] - ends[0][k]) / long
            assert pace.change.overlaps(rise) or not pace.change.is_finite()


def test_speeds_are_those_of_the_kernels() -> None:
    for walk, first, last in WALKS.values():
        numbers, s = Numbers.stored(walk), 0.4 * first + 0.6 * last
        dance = numbers.dance(None)
        found = Still.of(chain_at(dance, numbers.guess, s), dance.route, dance.sizes.links).speeds
        wanted = walk.placement([s]).speed_ratio[0]
        assert [float(v) for v in found] == pytest.approx(wanted.tolist(), abs=1e-11)


def test_a_bound_closes_with_the_square_of_the_length() -> None:
    numbers = Numbers.stored(TURN)
    dance, over = numbers.dance(None), []
    for long in (1e-2, 1e-3, 1e-4):
        a, b = (chain_at(dance, numbers.guess, WHERE + x * long) for x in (-0.5, 0.5))
        ends = [Still.of(chain, dance.route, dance.sizes.links).speeds for chain in (a, b)]
        found = paces(a, b, dance.route, dance.sizes.links)
        tops = [greatest(p, x, y, arb(long)) for p, x, y in zip(found, *ends, strict=True)]
        over.append(max(float(top) for top in tops) - GREATEST)
    assert over[0] < 10.0 * 1e-4
    assert over[1] < 10.0 * 1e-6
    assert 0.0 < over[2] < 10.0 * 1e-8


@pytest.mark.parametrize(("share", "whole"), [(1.0 + 1e-11, True), (1.0 - 1e-11, False)])
def test_the_greatest_speed_decides_how_far_cells_go(share: float, whole: bool) -> None:
    numbers = Numbers.stored(TURN)
    dance = replace(numbers.dance(None), most=arb(GREATEST * share))
    at = cells(dance, numbers.guess, WHERE - 0.3, WHERE + 0.3)
    assert (at[-1] == WHERE + 0.3) is whole
    assert at[-1] > WHERE - 1e-4


def test_a_greatest_speed_at_a_joint_is_bounded_from_both_sides() -> None:
    # A handle leaves the bend for the straight: there its speed is greatest, with a kink.
    walk = hairpin()
    numbers = Numbers.stored(walk)
    at = np.linspace(14.0, 24.0, 20001)
    seen = walk.placement(at).speed_ratio.max(axis=1)
    top, where = float(seen.max()), float(at[int(seen.argmax())])
    for spare, whole in ((1e-3, True), (-1e-3, False)):
        dance = replace(numbers.dance(None), most=arb(top + spare))
        found = cells(dance, numbers.guess, where - 0.2, where + 0.2)
        assert (found[-1] == where + 0.2) is whole


def test_a_speed_that_jumps_at_a_kink_is_bounded_on_both_sides() -> None:
    route = Route((Line(20.0), Line(20.0, (20.0, 0.0), 0.4)), kinks=True)
    walk = Walk(Dragon.of_sizes(np.full(3, 1.4), 0.3, 0.1, 0.1), route, start=9.0)
    numbers = Numbers.stored(walk)
    at = np.linspace(19.5, 26.0, 4001)
    top = float(walk.placement(at).speed_ratio.max())
    assert top > 1.05
    for most, whole in ((top * 1.02, True), (top * 0.98, False)):
        dance = replace(numbers.dance(None), most=arb(most))
        assert (cells(dance, numbers.guess, 19.5, 26.0)[-1] == 26.0) is whole


def test_a_tent_is_the_least_bound_that_both_ends_leave() -> None:
    rises = Pace(arb(2), arb(0.5, 2.5))  # from -2 to 3
    top = greatest(rises, arb(1), arb("1.5"), arb(1))
    at = (0.5 + 2.0) / 5.0  # 1 + 3 x = 1.5 + 2 (1 - x)
    assert float(top) == pytest.approx(1.0 + 3.0 * at, abs=1e-8)
    assert float(greatest(Pace(arb(9), arb(1.5, 1)), arb(1), arb(2), arb(1))) == 2.0
    assert float(greatest(Pace(arb(9), arb(-1.5, 1)), arb(2), arb(1), arb(1))) == 2.0
    assert float(greatest(Pace(arb(9), arb(0, np.inf)), arb(2), arb(1), arb(1))) == 9.0


def test_a_cell_with_a_faster_handle_does_not_hold() -> None:
    numbers = Numbers.stored(TURN)
    a, b = (chain_at(numbers.dance(None), numbers.guess, WHERE + x) for x in (-1e-3, 1e-3))
    assert holds(replace(numbers.dance(None), most=arb(GREATEST + 1e-4)), a, b)
    assert not holds(replace(numbers.dance(None), most=arb(GREATEST - 1e-13)), a, b)


def test_a_joint_of_headings_a_turn_apart_is_no_obstacle() -> None:
    route = Route((Arc(3.0, 1.0), Arc(3.0, 1.0).moved(Arc(3.0, 1.0).end_pose[0], 1.0 + 2.0 * np.pi)))
    walk = Walk(Dragon.of_sizes(np.full(1, 1.4), 0.3, 0.1, 0.1), route, start=2.0)
    numbers = Numbers.stored(walk)
    dance = replace(numbers.dance(None), most=arb("1.000001"))
    assert cells(dance, numbers.guess, 2.0, 5.0)[-1] == 5.0


def test_a_bend_that_jumps_at_a_joint_is_enclosed_on_both_sides() -> None:
    numbers = Numbers.stored(hairpin())
    dance = numbers.dance(None)
    a, b = (chain_at(dance, numbers.guess, s) for s in (13.99, 14.01))
    found = course(dance.route, a.handles[0], b.handles[0])
    assert found.bend.overlaps(arb(0))
    assert found.bend.overlaps(arb(1))
    assert found.heading.overlaps(arb(0.01 - 1e-12))
    assert not found.heading.overlaps(arb("0.02"))
