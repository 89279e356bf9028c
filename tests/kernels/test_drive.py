"""Bounds on speeds, turning rates and accelerations over steps hold, and close, whatever the drive."""

import math

import numpy as np
import pytest

from benchdragon import Arc, Clothoid, Dragon, Line, Route, Spiral
from benchdragon.kernels import chain, drive, motion_bounds
from benchdragon.kernels.chain import Placements, empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.drive import DriveRate
from benchdragon.model.placement import Placement
from tests.kernels import rooms
from tests.kernels.quantities import QUANTITIES, size_of

DRAGON = Dragon.of_sizes(np.array([1.8, 1.1, 1.4]), 0.2, 0.0, 0.0)
ROUTES = {
    "joints": Route.joined(
        [Line(8.0), Arc(1.6, 1.0), Line(0.5), Arc(2.0, -1.5), Clothoid(3.0, -0.5, 0.4), Line(9.0)]
    ),
    "spiral": Route((Spiral(0.9, 40.0, 8.0),)),
}
SPANS = {"joints": (6.0, 17.0), "spiral": (30.0, 36.0)}
# Squares of speed at both ends of the step, and the acceleration: speeding up, slowing down, even.
DRIVES = {"starting": (0.0, 0.8, 1.3), "stopping": (1.1, 0.1, -0.7), "even": (0.6, 0.6, 0.0)}


def placed(route: Route, at: FloatArray) -> Placements:
    places = empty_placements(len(DRAGON) + 1, len(at))
    assert motion_bounds.place_chain(route.rows, DRAGON.links, at, 0, len(at), places)
    return places


def bounds_over(route: Route, at: FloatArray, drives: FloatArray, quantity: int) -> FloatArray:
    """The kernel's bounds from each position to the next."""
    bounds, scratch, places = [], rooms.scratch_for(len(DRAGON) + 1), placed(route, at)
    for n, driven in enumerate(drives):
        drive.bound_step(route.rows, DRAGON.links, places, n, n + 1, driven, quantity, scratch)
        bounds.append(scratch.most.max())
    return np.array(bounds)


def seen_at(route: Route, at: FloatArray, squares: FloatArray, rate: float, name: str) -> FloatArray:
    """The greatest of a quantity with the head at these places, by the formulas alone."""
    one = Placement(DRAGON, route, at)
    return np.asarray(size_of(name, one, route, squares, rate).max(axis=1))


@pytest.mark.parametrize("name", QUANTITIES)
@pytest.mark.parametrize("driven", DRIVES)
@pytest.mark.parametrize("path", ["joints", pytest.param("spiral", marks=pytest.mark.compiled)])
def test_nothing_in_a_step_exceeds_its_bound(path: str, driven: str, name: str) -> None:
    route, (start, end, rate), parts = ROUTES[path], DRIVES[driven], 8
    first, last = SPANS[path]
    for h in (0.15, 0.02):
        at = np.asarray(first + h * np.arange(min(math.ceil((last - first) / h), 75) + 1), np.float64)
        drives = np.tile([start, end, rate], (len(at) - 1, 1))
        bounds = bounds_over(route, at, drives, QUANTITIES[name])
        share = np.linspace(0.0, 1.0, parts)
        for n, bound in enumerate(bounds):
            places = at[n] + h * share
            seen = seen_at(route, places, start + (end - start) * share, rate, name)
            assert seen.max() <= bound * (1.0 + 1e-12)


@pytest.mark.parametrize("name", ["along", "total", "across"])
@pytest.mark.parametrize("driven", DRIVES)
def test_a_short_step_over_a_joint_holds_both_sides_and_nothing_between(driven: str, name: str) -> None:
    route, (start, end, rate), h = ROUTES["joints"], DRIVES[driven], 1e-6
    square = max(start, end)
    for joint in route.joints[1:4]:
        for handle in range(len(DRAGON) + 1):
            head = joint
            for _ in range(60):  # where this handle comes to the joint
                head += joint - Placement(DRAGON, route, np.array([head])).s[0, handle]
            at = np.array([head - 0.5 * h, head + 0.5 * h])
            (bound,) = bounds_over(route, at, np.array([[square, square, rate]]), QUANTITIES[name])
            sides = seen_at(route, at, np.full(2, square), rate, name)
            assert sides.max() <= bound
            assert bound <= sides.max() + 1e-4 * square


def test_values_at_both_ends_are_the_formulas() -> None:
    route, at = ROUTES["joints"], np.linspace(7.0, 16.0, 31)
    places = placed(route, at)
    change, turn = np.empty(places.u.shape), np.empty((len(DRAGON), len(at)))
    chain.rates(route.rows, DRAGON.links, *places[:5], change, turn)
    few = len(DRAGON)
    for name, quantity in QUANTITIES.items():
        for square in (0.3, 0.9):
            seen = seen_at(route, at, np.full(31, square), -0.4, name)
            for t in range(31):
                value, where = drive.greatest_in_slot(
                    route.rows, places, change, turn, t, few, square, -0.4, quantity
                )
                assert value == pytest.approx(seen[t], rel=1e-9)
                assert 0 <= where <= few
                # What the first links hold is the greatest of all, as far as it stands there.
                less = [
                    drive.greatest_in_slot(
                        route.rows, places, change, turn, t, n, square, -0.4, quantity
                    )[0]
                    for n in range(1, few)
                ]
                assert max(less) <= value


def test_who_stands_asks_for_nothing_and_a_kink_for_everything() -> None:
    at = np.array([8.9, 9.1])
    for bent in (Line(9.0, (9.0, 0.0), 0.3), Arc(3.0, 1.0, (9.0, 0.0), 0.3)):
        route = Route((Line(9.0), bent), kinks=True)
        for quantity in (DriveRate.ALONG, DriveRate.TOTAL):
            assert bounds_over(route, at, np.zeros((1, 3)), quantity) == [0.0]
            for driven in ([0.5, 0.5, 0.0], [0.0, 0.5, 0.3], [0.0, 0.0, 0.3]):
                with np.errstate(invalid="ignore"):  # no speed times an infinite rate
                    assert bounds_over(route, at, np.array([driven]), quantity) == [math.inf]
    standing = np.array([[0.0, 0.0, 2.0]])  # a jolt that ends before anything moves
    assert bounds_over(ROUTES["joints"], np.array([7.0, 7.0]), standing, DriveRate.SPEEDS) == [0.0]
    (jolt,) = bounds_over(ROUTES["joints"], np.array([7.0, 7.0]), standing, DriveRate.ALONG)
    assert jolt == pytest.approx(2.0)


@pytest.mark.parametrize("side", [-5e-7, 5e-7])
def test_handles_beside_jumps_count_as_crossing(side: float) -> None:
    route = Route.joined([Line(8.0), Arc(1.6, 1.0), Line(9.0)])
    scratch, links, joint = rooms.scratch_for(len(DRAGON) + 1), len(DRAGON), 1
    head = float(route.joints[2]) + side
    for heads, slot in (([head - 0.01, head], 1), ([head, head + 0.01], 0)):
        places = placed(route, np.array(heads))
        motion_bounds.bound_handles(route.rows, DRAGON.links, places, 0, 1, scratch.table)
        here = route.rows, int(places.row[0, slot]), float(places.u[0, slot])
        assert drive.jump_beside(*here, 1e-6) == joint
        assert drive.jump_beside(*here, 1e-7) == -1
        scratch.beside[:] = 0.0
        crosses = (side > 0.0) == (slot == 1)
        assert drive.find_jumps(route.rows, places, 0, 1, links, scratch) == crosses
        scratch.beside[slot] = 1e-6
        assert drive.find_jumps(route.rows, places, 0, 1, links, scratch) == 1
        assert scratch.sides[0].tolist() == pytest.approx([1.0 / 1.6] * 2 + [0.0] * 2)


def test_more_jumps_at_once_than_are_told_apart_are_bounded_together() -> None:
    bends = [Arc(2.0, 0.05 if n % 2 else -0.05) for n in range(60)]
    route = Route.joined([Line(6.0), *bends])
    at, scratch = np.array([9.0, 9.6]), rooms.scratch_for(len(DRAGON) + 1)
    places = placed(route, at)
    motion_bounds.bound_handles(route.rows, DRAGON.links, places, 0, 1, scratch.table)
    assert drive.find_jumps(route.rows, places, 0, 1, len(DRAGON), scratch) == drive.MOST_JUMPS
    drives = np.array([[0.5, 0.9, 0.4]])
    share = np.linspace(0.0, 1.0, 200)
    for name in ("along", "total"):
        (bound,) = bounds_over(route, at, drives, QUANTITIES[name])
        seen = seen_at(route, 9.0 + 0.6 * share, 0.5 + 0.4 * share, 0.4, name)
        assert seen.max() <= bound
