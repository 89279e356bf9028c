"""What rounding may have moved turning rates and accelerations by: bounds that hold in balls."""

import math
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
import pytest

from benchdragon import Arc, Clothoid, Dragon, Line, Route, Walk
from benchdragon.analysis.nearby import seams_of
from benchdragon.analysis.speed import QUANTITIES, greatest_of
from benchdragon.kernels import drive
from benchdragon.kernels.chain import empty_placements, rates
from benchdragon.kernels.curve import curvature
from benchdragon.kernels.drive import DriveRate
from benchdragon.kernels.motion_bounds import bench_angles, place_chain
from benchdragon.kernels.rate_rounding import (
    bend_errors,
    rate_errors,
    turn_error,
    weigh_values,
)
from benchdragon.kernels.rounding import angle_error, mark_lanes, ratio_errors

pytest.importorskip("flint")
from flint import arb

from tests.exact_places import Motion, exact_motion, motion_by_differences
from tests.kernels import rooms
from tests.kernels.test_rounding import HAIRPINS, KINDS, Draw, hairpin, spiral_in, towards_peak

# The head's speed, its square and its acceleration, where these count.
SPEED, RATE = 1.3, -0.3
SQUARE = SPEED * SPEED


class Weighed:
    """A chain at one head position, in slot 0, and what is said of its rounding."""

    def __init__(self, walk: Walk, s: float) -> None:
        self.rows, links, handles = walk.route.rows, walk.dragon.links, len(walk.dragon) + 1
        self.places, self.errors = (
            empty_placements(handles, 1),
            rooms.errors_for(handles, 1, seams_of(self.rows)),
        )
        self.change, self.turn = np.zeros((2, handles, 1))
        assert place_chain(self.rows, links, np.array([s]), 0, 1, self.places)
        seams, lanes, along, ratio = self.errors[:4]
        mark_lanes(self.rows, links, self.places, 0, 1, lanes)
        ratio_errors(self.rows, links, seams, self.places, lanes, 0, along, ratio)
        rates(self.rows, links, *self.places[:5], self.change, self.turn[:-1])
        bend_errors(self.rows, self.places, 0, len(links), self.errors)
        rate_errors(self.rows, links, self.places, self.change, self.turn, 0, self.errors)

    @property
    def bends(self) -> list[float]:
        """The computed curvature at each handle, 1/m."""
        places = zip(self.places.row[:, 0].tolist(), self.places.u[:, 0].tolist(), strict=True)
        return [curvature(self.rows, j, u) for j, u in places]

    def shares(self, exact: Motion) -> list[float]:
        """How far changes, turns and bends are off, as shares of what is said of each, at most."""
        said = (errors[:, 0].tolist() for errors in self.errors[4:7])
        computed = self.change[:, 0].tolist(), self.turn[:-1, 0].tolist(), self.bends
        exactly = exact.change, exact.turn, exact.bend
        return [greatest_share(*three) for three in zip(computed, exactly, said, strict=True)]

    def share_of(self, exact: Motion, quantity: int) -> float:
        """The same of a quantity with the head at SPEED and RATE."""
        links, ratio = len(exact.turn), self.places.ratio[:, 0].tolist()
        weigh_values(self.rows, self.places, self.change, 0, links, SQUARE, RATE, quantity, self.errors)
        said = self.errors.sought[:, 0].tolist()
        computed, exactly = [], []
        for i in range(links + 1):
            # Of a bench what is said stands at its rear handle.
            turn, exact_turn = (self.turn[i - 1, 0], exact.turn[i - 1]) if i else (0.0, arb(0))
            change, bend = self.change[i, 0], self.bends[i]
            computed.append(drive.value_at(ratio[i], change, turn, bend, SQUARE, RATE, quantity))
            exactly.append(exact_value(exact, i, exact_turn, quantity))
        return greatest_share(computed, exactly, said)


def exact_value(exact: Motion, i: int, turn: arb, quantity: int) -> arb:
    """A quantity's exact size at handle i: see `drive.value_at`."""
    square, rate = arb(SPEED) * arb(SPEED), arb(RATE)
    if quantity == DriveRate.SPEEDS:
        return exact.ratio[i] * arb(SPEED)
    if quantity == DriveRate.TURNING:
        return abs(turn) * arb(SPEED)
    along = exact.ratio[i] * rate + exact.change[i] * square
    across = exact.ratio[i] * exact.ratio[i] * square * exact.bend[i]
    if quantity == DriveRate.TOTAL:
        return (along * along + across * across).sqrt()
    return abs(along if quantity == DriveRate.ALONG else across)


def greatest_share(computed: Sequence[float], exact: Sequence[arb], said: Sequence[float]) -> float:
    """How far numbers are from the exact ones, as shares of what is said of each, at most."""
    greatest = 0.0
    for one, true, most in zip(computed, exact, said, strict=False):
        off = abs(float(arb(one) - true))
        assert math.isfinite(off)
        greatest = max(greatest, off / most if off > 0.0 else 0.0)
    return greatest


def dances(kind: Callable[[Draw], Route], count: int) -> list[tuple[Weighed, Motion]]:
    """Dragons somewhere on routes of a kind."""
    rng, found = np.random.default_rng(5), []
    for _dance in range(count):
        walk = Walk(Dragon.of_sizes(rng.uniform(1.0, 3.4, 14)), kind(rng))
        low = 0.0 if walk.route.extension and kind is spiral_in else 45.0
        s = float(rng.uniform(low, walk.route.length))
        found.append((Weighed(walk, s), exact_motion(walk, s)))
    return found


@pytest.mark.parametrize("kind", KINDS)
def test_rates_are_those_of_chains_that_move(kind: Callable[[Draw], Route]) -> None:
    walk = Walk(Dragon.uniform(14), kind(np.random.default_rng(6)))
    exact, (change, turn) = exact_motion(walk, 50.0), motion_by_differences(walk, 50.0)
    np.testing.assert_allclose([float(one) for one in exact.change], change, rtol=0.0, atol=1e-13)
    np.testing.assert_allclose([float(one) for one in exact.turn], turn, rtol=0.0, atol=1e-13)


@pytest.mark.parametrize("kind", KINDS)
def test_rates_are_off_by_no_more_than_is_said(kind: Callable[[Draw], Route]) -> None:
    found = dances(kind, 6)
    change, turn, bend = np.array([chain.shares(exact) for chain, exact in found]).max(axis=0)
    # No error exceeds its bound, and bounds say something: they are no wider than they need be by far.
    assert 4e-3 < change <= 1.0
    assert 4e-3 < turn <= 1.0
    assert bend <= 1.0
    for quantity in QUANTITIES.values():
        assert 1e-3 < max(chain.share_of(exact, quantity.kind) for chain, exact in found) <= 1.0


def test_the_head_is_as_fast_as_is_said_and_others_but_for_rounding() -> None:
    chain = Weighed(Walk(Dragon.uniform(3), Route((Line(20.0),))), 15.0)
    for rate in (0.0, 0.2):
        weigh_values(
            chain.rows, chain.places, chain.change, 0, 3, 1.7, rate, DriveRate.SPEEDS, chain.errors
        )
        head, *others = chain.errors.sought[:, 0].tolist()
        assert (head > 0.0) == (rate > 0.0)
        assert min(others) > 2e-16


@pytest.mark.parametrize("sweep", np.linspace(0.4, 0.5, 12).tolist())
def test_who_stands_at_a_joint_where_a_walk_ends_may_have_passed_it(sweep: float) -> None:
    walk = Walk(Dragon.uniform(1), Route.joined([Line(20.0), Arc(1.5, sweep), Line(20.0)]))
    low, high = 20.0, 24.0
    # The last place of the head at which the tail is on the line, and the next number.
    while low < 0.5 * (low + high) < high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if walk.placement([middle]).s[0, 1] <= 20.0 else (low, middle)
    most = float(walk.placement([low + 1e-9]).speed_ratio[0, 1]) ** 2 / 1.5
    for last in (low, high):
        found = greatest_of(walk, QUANTITIES["lateral_acceleration"], last - 0.01, last)
        assert found.upper >= 0.999999 * most


@pytest.mark.parametrize(("radius", "sweep"), HAIRPINS)
def test_rates_past_a_hairpin_are_off_by_no_more_than_is_said(radius: float, sweep: float) -> None:
    walk, shares = hairpin(radius, sweep), []
    for s in towards_peak(walk, 20.0 + radius * sweep + 3.5):
        chain, exact = Weighed(walk, s), exact_motion(walk, s)
        shares.append([*chain.shares(exact), *(chain.share_of(exact, n) for n in range(5))])
    assert np.max(shares) <= 1.0
    assert np.max(shares, axis=0)[:2].min() > 0.01


@pytest.mark.parametrize("straight", [100.0, 1e3, 1e5])
def test_rates_past_a_sharp_bend_after_a_long_straight_are_off_by_no_more_than_is_said(
    straight: float,
) -> None:
    shares = []
    for radius in (0.02, 0.1, 0.3):
        for sweep in (1.5, 1.55, 1.565):
            route = Route.joined([Line(straight, (-straight, 0.0)), Arc(radius, sweep), Line(5.0)])
            for ahead in np.linspace(0.01, 0.4, 7).tolist():
                s = straight + radius * sweep + ahead
                walk = Walk(Dragon.uniform(1), route)
                chain, exact = Weighed(walk, s), exact_motion(walk, s)
                shares.append([*chain.shares(exact), *(chain.share_of(exact, n) for n in range(5))])
    assert 0.05 < np.max(shares) <= 1.0


@pytest.mark.parametrize("name", ["acceleration", "total_acceleration", "turning_rate"])
@pytest.mark.parametrize(("radius", "sweep"), HAIRPINS[1:3])
def test_nothing_past_a_hairpin_exceeds_its_bracket(radius: float, sweep: float, name: str) -> None:
    walk, quantity = hairpin(radius, sweep), QUANTITIES[name]
    with np.errstate(invalid="ignore"):  # what is unbounded, times nothing
        found = greatest_of(walk, quantity, 20.0, 20.0 + radius * sweep + 3.5, tolerance=1e-11)

    def exactly(s: float) -> float:
        exact = exact_motion(walk, s)
        along, across = exact.change[1], exact.ratio[1] * exact.ratio[1] * exact.bend[1]
        total = (along * along + across * across).sqrt()
        values = {
            DriveRate.ALONG: abs(along),
            DriveRate.TOTAL: total,
            DriveRate.TURNING: abs(exact.turn[0]),
        }
        return float(values[quantity.kind])

    low, high = found.s - 1e-7, found.s + 1e-7
    for _closer in range(25):
        one, other = low + 0.382 * (high - low), low + 0.618 * (high - low)
        low, high = (low, other) if exactly(one) > exactly(other) else (one, high)
    most = max(exactly(low), exactly(found.s))
    assert found.least <= most <= found.upper
    assert found.upper - found.least < 1e-5 * found.value


def test_nobody_knows_on_which_side_of_a_joint_a_handle_at_it_stands() -> None:
    walk = Walk(Dragon.uniform(2), Route.joined([Line(20.0), Arc(3.0, 2.0), Line(20.0)]))
    for ahead, sided in ((0.0, 0.0), (1e-9, 1.0), (-1e-9, 1.0)):
        assert Weighed(walk, 20.0 + ahead).errors.sided[0] == sided
    found = greatest_of(walk, QUANTITIES["lateral_acceleration"], 20.0, 20.0)
    assert found.value == pytest.approx(1.0 / 3.0)  # as just past the joint
    assert found.least == 0.0
    assert found.value <= found.upper < 0.34


@pytest.mark.parametrize("last", [20.6, 21.5])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-6])
def test_a_peak_that_stands_at_a_jump_is_seen_beside_it(last: float, tolerance: float) -> None:
    route = Route.joined([Line(20.0), Clothoid(3.0, 1.0 / 1.5, 0.0), Line(20.0)])
    walk, quantity = Walk(Dragon.uniform(2), route), QUANTITIES["lateral_acceleration"]
    for first in (19.0, 20.0):
        found = greatest_of(walk, quantity, first, last, tolerance=tolerance)
        assert found.value == pytest.approx(1.0 / 1.5, rel=tolerance)
        assert found.least >= found.value * (1.0 - 1.01 * tolerance)
        assert 1.0 / 1.5 <= found.upper * (1.0 + 1e-14)


@pytest.mark.parametrize("end", [0, 1])
def test_both_sides_of_a_joint_that_a_handle_stands_at_count_in_its_angle(end: int) -> None:
    route = Route.joined([Line(30.0), Arc(1.5, 2.0), Line(9.0)])
    dragon, joint, off = Dragon.uniform(1), float(route.joints[2]), 1e-5
    walk, link = Walk(dragon, route), float(dragon.links[0])
    at = walk.head_where_tail(joint) if end else joint
    for ahead in (-1e-6, 1e-6):
        chain = Weighed(walk, at + ahead)
        follows, turn = float(chain.places.ratio[1, 0]), float(chain.turn[0, 0])
        said = partial(angle_error, route.rows, chain.errors.seams, chain.places, 0, 0, link)
        for bend in (0.0, 1.0 / 1.5):  # of the line or the arc, whichever it exactly is
            rate = (follows if end else 1.0) * bend - turn
            assert said(np.array([off, follows * off]))[end] >= 0.999 * abs(rate) * off
            assert said(np.array([0.0, off]))[end] >= 0.999 * end * bend * off


def moved_pose(seed: int) -> tuple[Weighed, Weighed, float]:
    """One bench on arcs, and the same a little further on; how far, m."""
    rng, ahead = np.random.default_rng(seed), 1e-5
    radius, other = rng.uniform(2.0, 6.0, 2)
    route = Route.joined([Line(9.0), Arc(float(radius), 2.0), Arc(float(other), -2.0), Line(9.0)])
    s = 9.0 + 2.0 * radius + rng.uniform(0.2, 2.5)
    walk = Walk(Dragon.uniform(1), route)
    return Weighed(walk, s), Weighed(walk, s + ahead), ahead


@pytest.mark.parametrize("seed", range(8))
def test_a_bench_that_is_moved_on_turns_as_its_angle_error_says(seed: int) -> None:
    chain, other, ahead = moved_pose(seed)
    link = 2.86
    assert chain.places.row[1, 0] != chain.places.row[0, 0]
    follows = chain.places.ratio[1, 0]
    off = np.array([ahead, follows * ahead])
    said = angle_error(chain.rows, chain.errors.seams, chain.places, 0, 0, link, off)
    exact = np.arcsin(bench_angles(other.places, 0, 0, link)[::2])
    exact -= np.arcsin(bench_angles(chain.places, 0, 0, link)[::2])
    np.testing.assert_allclose(said, np.abs(exact), rtol=1e-3, atol=1e-9)


@pytest.mark.parametrize("seed", range(8))
def test_a_turning_rate_is_off_by_what_its_angles_are(seed: int) -> None:
    chain, _other, _ahead = moved_pose(seed)
    link, ratio = 2.86, chain.places.ratio[:, 0]
    _sine, cosine, _rear_sine, rear_cosine = bench_angles(chain.places, 0, 0, link)
    for angles in ((1e-5, 0.0), (0.0, 1e-5)):
        said = turn_error(chain.places, chain.turn, 0, 0, link, angles, 0.0, chain.errors)
        exact = (ratio[0] * cosine * angles[0] + ratio[1] * rear_cosine * angles[1]) / link
        assert said == pytest.approx(exact, rel=1e-6)


@pytest.mark.compiled
@pytest.mark.parametrize("off", [0.0, 4e-16, -4e-16, 1e-6, -1e-6])
def test_handles_that_cross_joints_at_once_may_do_so_in_either_order(off: float) -> None:
    # The link is the arc's chord but for `off`: with both ends on lines it is pulled twice as hard.
    dragon, radius = Dragon.uniform(1), 2.0
    sweep = 2.0 * math.asin(0.5 * float(dragon.links[0]) / radius) + off
    walk = Walk(dragon, Route.joined([Line(20.0), Arc(radius, sweep), Line(20.0)]))
    at = float(walk.route.joints[2])
    once = float(Weighed(walk, at - 1e-5).change[1, 0])
    found = greatest_of(walk, QUANTITIES["acceleration"], at - 0.5, at + 0.5, tolerance=1e-6)
    assert (found.least < 1.01 * once) == (off > -1e-9)
    assert (found.upper > 1.99 * once) == (off < 1e-9)
    if abs(off) < 1e-9:  # where a walk ends or begins there, too
        for first, last in ((at - 0.5, at), (at - 0.5, at - 1e-13), (at, at + 0.5)):
            part = greatest_of(walk, QUANTITIES["acceleration"], first, last, tolerance=1e-6)
            assert part.upper > 1.99 * once
